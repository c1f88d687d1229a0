#include "system/loaded_pair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "model/capabilities.h"
#include "solid/loaded_gear.h"
#include "system/loaded_view.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// Largest principal stress at the nodes between root circle and involute on the driving flank's side of a tooth.
double largest_root_stress(const SectorGrid& mesh, const Material& material, const LoadedGear& loaded,
                           int tooth) {
  const ToothGeometry geometry(mesh.design);
  const double form = geometry.flank_point(geometry.form_roll_angle()).norm();
  double largest = 0;
  for (Index i = 0; i < mesh.node_position.rows(); ++i) {
    const Vec2 p = mesh.node_position.row(i);
    if (p.x() > 0 || p.norm() > form || p.norm() < geometry.root_radius() * (1 - 1e-9)) continue;
    const Eigen::Vector3d stress = loaded.stress.row(loaded.gear.node(tooth, i)).transpose();
    largest = std::max(largest, stress_measures(stress, material).largest);
  }
  return largest;
}

// m: (strip) what the plane state and the width of the contact add to the inward displacement of a flank of gear g.
VectorXd surface_change(const ElasticGear& gear, int g, const ContactZone& zone) {
  const PairStrips& s = zone.strips;
  VectorXd change = VectorXd::Zero(s.size());
  if (gear.concentration() > 1) {
    Eigen::MatrixXd nodes(kZoneNodes, gear.table_size());
    for (int k = 0; k < kZoneNodes; ++k)
      nodes.row(k) = gear.table().weights(s.node_roll[static_cast<size_t>(g)][k]);
    const Eigen::MatrixXd reading = s.interpolation * nodes;
    change = reading * gear.narrow_change() * reading.transpose() * zone.force;
  }
  for (int i = 0; i < s.size(); ++i)
    for (int j = 0; j < s.size(); ++j)
      if (zone.force[j] > 0)
        change[i] +=
            zone.force[j] * gear.plane_change(s.middle(i) - s.middle(j), 0.5 * s.width(j), 0.5 * s.width(i));
  return change;
}

// Rows of both gears' parts, one below the other.
template <class Matrix>
void append(Matrix& to, const Matrix& rows) {
  const Index before = to.rows();
  to.conservativeResize(before + rows.rows(), rows.cols());
  to.bottomRows(rows.rows()) = rows;
}

// A gear's part of the grid: its nodes, then two points for each strip.
struct GridPart {
  MatrixRM point, displacement, elastic;  // (point, 2) m
  MatrixRM stress;                        // (point, 3) Pa: xx, yy, xy
  MatrixRM pressure;                      // (point, 2) Pa: along the outward normal of the strip, 0 at nodes
};

// The strips of the pairs that carry force, pair after pair. (strip, gear and end) rad: roll angles of their ends.
MatrixRM take_strips(const std::vector<const ContactZone*>& loaded, const GearPair& gears, int period,
                     LoadedResult& out) {
  const auto pairs = static_cast<Index>(loaded.size());
  Index strips = 0;
  for (const ContactZone* zone : loaded) strips += zone->force.size();
  out.pair.resize(pairs);
  out.tooth_load.resize(pairs);
  out.tooth.resize(pairs, 2);
  out.root_stress.resize(pairs, 2);
  out.strip_pair.resize(strips);
  for (VectorXd* v : {&out.strip_width, &out.strip_force, &out.strip_pressure, &out.strip_separation})
    v->resize(strips);
  out.strip_roll.resize(strips, 2);
  out.strip_deflection = MatrixRM::Zero(strips, 2);
  MatrixRM border(strips, 4);  // rad: roll angles of the strips' ends on both gears
  Index at = 0;
  for (Index j = 0; j < pairs; ++j) {
    const ContactZone& zone = *loaded[static_cast<size_t>(j)];
    out.pair[j] = zone.strips.pair;
    out.tooth_load[j] = zone.force.sum();
    for (int g = 0; g < kSides; ++g) {
      const int teeth = gears.gear(g).design().teeth;
      out.tooth(j, g) = (GearMeshModel::tooth(g, zone.strips.pair - period) % teeth + teeth) % teeth;
    }
    for (int i = 0; i < zone.strips.size(); ++i, ++at) {
      out.strip_pair[at] = zone.strips.pair;
      out.strip_width[at] = zone.strips.width(i);
      out.strip_force[at] = zone.force[i];
      out.strip_pressure[at] = zone.force[i] / (zone.strips.width(i) * out.face_width());
      out.strip_separation[at] = zone.separation[i];
      const auto roll_at = [&](double x) { return gears.gap_at(zone.strips.contact, x).roll; };
      const auto middle = roll_at(zone.strips.middle(i)), low = roll_at(zone.strips.border[i]),
                 high = roll_at(zone.strips.border[i + 1]);
      for (int g = 0; g < kSides; ++g) {
        out.strip_roll(at, g) = middle[static_cast<size_t>(g)];
        border(at, 2 * g) = low[static_cast<size_t>(g)];
        border(at, 2 * g + 1) = high[static_cast<size_t>(g)];
      }
    }
  }
  return border;
}

}  // namespace

// NOLINTNEXTLINE(readability-function-size): one field after the other on the grid of both gears
LoadedResult loaded_pair(const SectorGrid& driver_mesh, const SectorGrid& driven_mesh,
                         const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                         double phase, int period) {
  require_able("loaded", traits(statics.mesh, statics.gear[0].design, statics.gear[1].design));
  const std::vector<ContactZone> zones = contact_zones(driver, driven, statics, phase, period);
  const GearPair gears(statics);
  const SectorGrid* const mesh[2] = {&driver_mesh, &driven_mesh};
  const ReducedBody* const body[2] = {&driver, &driven};

  LoadedResult out;
  static_cast<GearPairParameters&>(out) = statics;
  out.torque = statics.torque;
  out.mesh_phase = phase + period;
  out.transmission_error = zones.empty() ? 0 : zones.front().approach;

  std::vector<const ContactZone*> loaded;
  for (const ContactZone& zone : zones)
    if (zone.force.sum() > 0) loaded.push_back(&zone);
  const MatrixRM border = take_strips(loaded, gears, period, out);
  const auto pairs = static_cast<Index>(loaded.size()), strips = border.rows();

  // Fields of both gears, in their places.
  MatrixRM measures[3];  // largest, least principal stress, von Mises
  GridPart grid;
  MatrixRM cell_gear, cell_tooth;  // (cell, 1)
  MatrixRM line_gear, line_tooth, line_pressure;
  for (int g = 0; g < kSides; ++g) {
    const ToothGeometry& tooth = gears.gear(g);
    const Material& material = body[g]->material;
    const int teeth = tooth.design().teeth;
    std::vector<StripLoad> loads;
    std::vector<int> tooth_of;
    Index at = 0;
    for (Index j = 0; j < pairs; ++j)
      for (int i = 0; i < loaded[static_cast<size_t>(j)]->strips.size(); ++i, ++at)
        loads.push_back({out.tooth(j, g), out.strip_roll(at, g), out.strip_width[at], out.strip_force[at]});
    LoadedGear gear = loaded_gear(*mesh[g], material, loads);
    // Of the whole field only what the flanks do knows of the contact's own plane state and width, and the stress of the width that
    // carries.
    const ElasticGear own = ElasticGear(*body[g], statics.mesh.contact_plane).in_mesh(out.face_width());
    gear.stress *= own.concentration();
    VectorXd change(strips);
    at = 0;
    for (const ContactZone* zone : loaded) {
      change.segment(at, zone->force.size()) = surface_change(own, g, *zone);
      at += zone->force.size();
    }
    out.strip_deflection.col(g) = gear.deflection + change;
    out.contact_work[g] = 0.5 * out.strip_force.dot(gear.deflection);
    out.contact_torque[g] = out.strip_force.sum() * tooth.base_radius();
    out.hub_torque[g] = gear.hub_torque;
    out.strain_energy[g] = gear.strain_energy;
    for (Index j = 0; j < pairs; ++j)
      out.root_stress(j, g) = largest_root_stress(*mesh[g], material, gear, out.tooth(j, g));

    const Placement place = placed(gears, g, phase + period);
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(place.angle).toRotationMatrix();
    const double hub =
        g == 0 ? out.transmission_error / tooth.base_radius() : 0;  // rad: the driven hub is held
    const Index nodes = gear.gear.node_position.rows(), points = nodes + 2 * strips;
    GridPart part{MatrixRM(points, 2), MatrixRM(points, 2), MatrixRM(points, 2), MatrixRM::Zero(points, 3),
                  MatrixRM::Zero(points, 2)};
    const auto put = [&](Index row, const Vec2& p, const Vec2& u) {  // in the gear's own frame
      const Vec2 r = turn * p;
      part.point.row(row) = (place.centre + r).transpose();
      part.elastic.row(row) = (turn * u).transpose();
      part.displacement.row(row) = part.elastic.row(row) + hub * Eigen::RowVector2d(-r.y(), r.x());
    };
    for (Index i = 0; i < nodes; ++i) {
      put(i, gear.gear.node_position.row(i), gear.displacement.row(i));
      Eigen::Matrix2d tensor;
      tensor << gear.stress(i, 0), gear.stress(i, 2), gear.stress(i, 2), gear.stress(i, 1);
      tensor = (turn * tensor * turn.transpose()).eval();
      part.stress.row(i) << tensor(0, 0), tensor(1, 1), tensor(0, 1);
    }
    MatrixRMi line(strips, 2);
    for (Index i = 0; i < strips; ++i) {
      const StripLoad& load = loads[static_cast<size_t>(i)];
      const Eigen::Matrix2d at_tooth = Eigen::Rotation2Dd(2 * std::numbers::pi * load.tooth / teeth).matrix();
      const Vec2 moved =
          Vec2(gear.strip_displacement.row(i)) - change[i] * (at_tooth * tooth.flank_normal(load.roll));
      for (int end = 0; end < 2; ++end) {
        const Index row = nodes + 2 * i + end;
        put(row, at_tooth * tooth.flank_point(border(i, 2 * g + end)), moved);
        part.pressure.row(row) =
            out.strip_pressure[i] * (turn * at_tooth * tooth.flank_normal(load.roll)).transpose();
        line(i, end) = static_cast<int>(grid.point.rows() + row);
      }
    }
    MatrixRM of_part(points, 3);
    for (Index i = 0; i < points; ++i) {
      const StressMeasures m = stress_measures(part.stress.row(i).transpose(), material);
      of_part.row(i) << m.largest, m.least, m.von_mises;
    }
    for (int k = 0; k < 3; ++k) append(measures[k], MatrixRM(of_part.col(k)));
    const MatrixRMi cell = gear.gear.element_node.array() + static_cast<int>(grid.point.rows());
    if (g == 1 && cell.cols() != out.vtk_cell.cols())
      fail(Failure::input, "the driver's elements have ", out.vtk_cell.cols(), " nodes, the driven gear's ",
           cell.cols(), ": one picture needs the same element_order");
    append(out.vtk_cell, cell);
    append(out.vtk_line, line);
    append(grid.point, part.point);
    append(grid.displacement, part.displacement);
    append(grid.elastic, part.elastic);
    append(grid.stress, part.stress);
    append(grid.pressure, part.pressure);
    const Index per_tooth = mesh[g]->element_node.rows();
    MatrixRM numbers(cell.rows(), 1);
    for (Index e = 0; e < cell.rows(); ++e) {
      const Index tooth = e / per_tooth;
      numbers(e, 0) = static_cast<double>(tooth);
    }
    append(cell_tooth, numbers);
    append(cell_gear, MatrixRM(MatrixRM::Constant(cell.rows(), 1, g + 1)));
    MatrixRM of_lines(strips, 1);
    for (Index i = 0; i < strips; ++i) of_lines(i, 0) = loads[static_cast<size_t>(i)].tooth;
    append(line_tooth, of_lines);
    append(line_gear, MatrixRM(MatrixRM::Constant(strips, 1, g + 1)));
    append(line_pressure, MatrixRM(out.strip_pressure));
  }
  const MatrixRM no_pressure = MatrixRM::Zero(out.vtk_cell.rows(), 1);
  const MatrixRM is_line = MatrixRM::Ones(out.vtk_line.rows(), 1);
  const auto cells_and_lines = [](MatrixRM of_cells, const MatrixRM& of_lines) {
    append(of_cells, of_lines);
    return of_cells;
  };
  out.vtk_point = grid.point;
  out.vtk_point_data = {
      {"displacement", "m", grid.displacement},         {"elastic_displacement", "m", grid.elastic},
      {"contact_pressure_vector", "Pa", grid.pressure}, {"stress_xx_yy_xy", "Pa", grid.stress},
      {"principal_stress_largest", "Pa", measures[0]},  {"principal_stress_least", "Pa", measures[1]},
      {"von_mises_stress", "Pa", measures[2]}};
  out.vtk_cell_data = {{"gear", "1", cells_and_lines(cell_gear, line_gear)},
                       {"tooth", "1", cells_and_lines(cell_tooth, line_tooth)},
                       {"contact_strip", "1", cells_and_lines(no_pressure, is_line)},
                       {"contact_pressure", "Pa", cells_and_lines(no_pressure, line_pressure)}};
  thin_view(out);
  return out;
}

}  // namespace whine
