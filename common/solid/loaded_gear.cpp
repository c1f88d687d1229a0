#include "solid/loaded_gear.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/error.h"
#include "base/units.h"
#include "contact/half_plane.h"
#include "solid/reduce.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

using Complex = std::complex<double>;

// What presses on one tooth, and the half-planes' field of all of it.
struct LoadedTooth {
  std::vector<Index> strip;  // numbers among the gear's loads
  std::vector<StripLoadField> field;
  VectorXd force;  // (strip) N

  Vec2 displacement(const Vec2& p) const {
    Vec2 sum = Vec2::Zero();
    for (size_t i = 0; i < field.size(); ++i) sum += force[static_cast<Index>(i)] * field[i].displacement(p);
    return sum;
  }
  // m: to the nearest strip
  double nearest(const Vec2& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const StripLoadField& strip : field) least = std::min(least, (p - strip.point()).norm());
    return least;
  }
  Vector3d stress(const Vec2& p) const {
    Vector3d sum = Vector3d::Zero();
    for (size_t i = 0; i < field.size(); ++i) sum += force[static_cast<Index>(i)] * field[i].stress(p);
    return sum;
  }
};

// Gauss points a side for the energy of an element in a loaded tooth: stresses are steep about the strips.
constexpr int kNearPoints = 24, kFarPoints = 4;

// (2 node) of one tooth -> (node of an element, 2)
Eigen::MatrixX2d of_element(const VectorXd& field, const MatrixRMi& element_node, Index e) {
  Eigen::MatrixX2d out(element_node.cols(), 2);
  for (Index k = 0; k < out.rows(); ++k) out.row(k) = field.segment<2>(2 * element_node(e, k)).transpose();
  return out;
}

}  // namespace

StressMeasures stress_measures(const Vector3d& s, const Material& material) {
  const double middle = 0.5 * (s[0] + s[1]), radius = std::hypot(0.5 * (s[0] - s[1]), s[2]);
  const double across = material.plane_stress ? 0 : material.poisson_ratio * (s[0] + s[1]);
  const double a = middle + radius, b = middle - radius;
  return {a, b,
          std::sqrt(0.5 * ((a - b) * (a - b) + (b - across) * (b - across) + (across - a) * (across - a)))};
}

std::vector<MatrixXd> teeth_under(const SectorGrid& mesh, const Material& material, const MatrixXd& force) {
  const int teeth = mesh.design.teeth;
  const CyclicSector sector(
      mesh, assemble(mesh.node_position, mesh.element_node, material, mesh.design.face_width));
  std::vector<MatrixXd> out(static_cast<size_t>(teeth), MatrixXd::Zero(force.rows(), force.cols()));
  HermitianFactor factor(sector.stiffness(0));
  for (int n = 0; n < sector.harmonics(); ++n) {
    factor.factorise(sector.stiffness(n), text("sector stiffness, harmonic ", n, " of ", teeth, " teeth"));
    const Eigen::MatrixXcd solution = sector.expand(n, factor.solve(sector.gather(n, force)));
    const double weight = (sector.single(n) ? 1.0 : 2.0) / teeth;
    for (int d = 0; d < teeth; ++d)
      out[static_cast<size_t>(d)] += weight * (std::polar(1.0, sector.phase(n) * d) * solution).real();
  }
  return out;
}

namespace {

// Loads by tooth, all strips of a tooth in one right-hand side.
struct ToothLoads {
  std::map<int, LoadedTooth> tooth;
  MatrixXd force;                // (2 node, loaded tooth)
  std::vector<char> holds_rest;  // (node) as FlankLoads
};

ToothLoads loads_by_tooth(const SectorGrid& mesh, const Material& material, const ToothGeometry& tooth,
                          const std::vector<StripLoad>& loads) {
  const int teeth = mesh.design.teeth;
  const PlaneModuli moduli = plane_strain_equivalent(material);
  const double thickness = mesh.design.face_width;
  const Index nodes = mesh.node_position.rows();
  ToothLoads out;
  for (size_t i = 0; i < loads.size(); ++i)
    out.tooth[((loads[i].tooth % teeth) + teeth) % teeth].strip.push_back(static_cast<Index>(i));
  out.force.resize(2 * nodes, static_cast<Index>(out.tooth.size()));
  Index column = 0;
  for (auto& [number, at] : out.tooth) {
    const auto strips = static_cast<Index>(at.strip.size());
    VectorXd roll(strips);
    at.force.resize(strips);
    for (Index i = 0; i < strips; ++i) {
      const StripLoad& load = loads[static_cast<size_t>(at.strip[static_cast<size_t>(i)])];
      if (!(load.width > 0)) fail(Failure::input, "a loaded strip is ", load.width, " m wide");
      roll[i] = load.roll;
      at.force[i] = load.force;
      at.field.emplace_back(tooth.flank_point(load.roll), tooth.flank_normal(load.roll), load.width, moduli,
                            thickness, kReferenceDepth);
    }
    const FlankLoads unit = make_flank_loads(mesh, material, roll);
    out.force.col(column++) = unit.force * at.force;
    out.holds_rest = unit.holds_rest;
  }
  return out;
}

// The unknowns x of each tooth, in its own frame.
std::vector<VectorXd> unknowns_of(const SectorGrid& mesh, const Material& material, const ToothLoads& loads) {
  const int teeth = mesh.design.teeth;
  const std::vector<MatrixXd> under = teeth_under(mesh, material, loads.force);
  std::vector<VectorXd> unknown(static_cast<size_t>(teeth), VectorXd::Zero(2 * mesh.node_position.rows()));
  Index column = 0;
  for (const auto& [number, at] : loads.tooth) {
    for (int j = 0; j < teeth; ++j)
      unknown[static_cast<size_t>(j)] += under[static_cast<size_t>((j - number + teeth) % teeth)].col(column);
    ++column;
  }
  return unknown;
}

// What holds the hub: the torque of the elements' forces on the nodes of the bore.
double hub_torque(const SectorGrid& mesh, const Material& material, const ToothLoads& loads,
                  const std::vector<VectorXd>& unknown) {
  const SparseReal stiffness =
      assemble(mesh.node_position, mesh.element_node, material, mesh.design.face_width).stiffness;
  double torque = 0;
  Index column = 0;
  for (int j = 0; j < mesh.design.teeth; ++j) {
    VectorXd reaction = stiffness * unknown[static_cast<size_t>(j)];
    if (loads.tooth.contains(j)) reaction -= loads.force.col(column++);
    for (Index i = 0; i < mesh.bore_node.size(); ++i) {
      const int node = mesh.bore_node[i];
      torque += mesh.node_position(node, 0) * reaction[2 * node + 1] -
                mesh.node_position(node, 1) * reaction[2 * node];
    }
  }
  return torque;
}

// One tooth of the gear with what the half-planes under its strips add; at: nullptr for a tooth without load.
struct ToothField {
  const LoadedTooth* at;
  const VectorXd& x;     // (2 node) the unknowns
  VectorXd rest, near;   // (2 node) m: w and the half-planes in the tooth; u and 0 elsewhere
  MatrixRM near_stress;  // (node, 3) Pa
};

ToothField field_of(const SectorGrid& mesh, const LoadedTooth* at, const VectorXd& x,
                    const std::vector<char>& holds_rest) {
  const Index nodes = mesh.node_position.rows();
  ToothField field{at, x, x, VectorXd::Zero(2 * nodes), MatrixRM::Zero(nodes, 3)};
  if (!at) return field;
  std::vector<char> in_tooth(static_cast<size_t>(nodes), 0);
  for (Index e = 0; e < mesh.element_node.rows(); ++e)
    if (mesh.element_region[e] == 1)
      for (Index k = 0; k < mesh.element_node.cols(); ++k)
        in_tooth[static_cast<size_t>(mesh.element_node(e, k))] = 1;
  for (Index i = 0; i < nodes; ++i) {
    if (!in_tooth[static_cast<size_t>(i)]) continue;
    const Vec2 p = mesh.node_position.row(i);
    field.near.segment<2>(2 * i) = at->displacement(p);
    field.near_stress.row(i) = at->stress(p).transpose();
    if (!holds_rest[static_cast<size_t>(i)]) field.rest.segment<2>(2 * i) -= field.near.segment<2>(2 * i);
  }
  return field;
}

// Stresses and strain energy, element by element. Stresses of the elements are taken at 2 x 2 Gauss points, where they are
// best, and carried on to the nodes.
class ElementStress {
 public:
  ElementStress(const SectorGrid& mesh, const Material& material)
      : mesh_(mesh),
        elasticity_(plane_elasticity(material)),
        compliance_(elasticity_.inverse()),
        two_(gauss_rule(2)),
        fine_(gauss_rule(kNearPoints)),
        coarse_(gauss_rule(kFarPoints)),
        per_element_(static_cast<int>(mesh.element_node.cols())),
        to_nodes_(per_element_, 4) {
    for (int k = 0; k < per_element_; ++k) {
      const Vec2 at = reference_node(k);
      to_nodes_.row(k) = shape_functions(4, at[0] / two_.point[1], at[1] / two_.point[1]).value.transpose();
    }
  }
  // Element e of tooth j, turned by `turn`; adds its strain energy, and its stress to those of its nodes.
  void add(Index e, int j, const Eigen::Matrix2d& turn, const ToothField& field, VectorXd& elements_about,
           LoadedGear& out) const;

 private:
  const SectorGrid& mesh_;
  Eigen::Matrix3d elasticity_, compliance_;
  GaussRule two_, fine_, coarse_;
  int per_element_;
  MatrixXd to_nodes_;
};

void ElementStress::add(Index e, int j, const Eigen::Matrix2d& turn, const ToothField& field,
                        VectorXd& elements_about, LoadedGear& out) const {
  static constexpr double kCorner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const bool split = field.at && mesh_.element_region[e] == 1;
  const Eigen::MatrixX2d place = [&] {
    Eigen::MatrixX2d p(per_element_, 2);
    for (Index k = 0; k < per_element_; ++k) p.row(k) = mesh_.node_position.row(mesh_.element_node(e, k));
    return p;
  }();
  const Eigen::MatrixX2d moved = of_element(split ? field.rest : field.x, mesh_.element_node, e);
  Eigen::Matrix<double, 4, 3> at_gauss;
  for (int g = 0; g < 4; ++g)
    at_gauss.row(g) = (elasticity_ * element_strain(place, moved, kCorner[g][0] * two_.point[1],
                                                    kCorner[g][1] * two_.point[1]))
                          .transpose();
  const bool near_strip = split && field.at->nearest((place.row(0) + place.row(2)).transpose() / 2) <
                                       3 * (place.row(0) - place.row(2)).norm();
  const GaussRule& rule = near_strip ? fine_ : coarse_;
  for (Index m = 0; m < rule.point.size(); ++m)
    for (Index n = 0; n < rule.point.size(); ++n) {
      const Shape shape = shape_functions(per_element_, rule.point[m], rule.point[n]);
      Vector3d s = elasticity_ * element_strain(place, moved, rule.point[m], rule.point[n]);
      if (split) s += field.at->stress(place.transpose() * shape.value);
      out.strain_energy += 0.5 * mesh_.design.face_width * rule.weight[m] * rule.weight[n] *
                           (shape.slope.transpose() * place).determinant() * s.dot(compliance_ * s);
    }
  const Eigen::Matrix<double, Eigen::Dynamic, 3> at_node = to_nodes_ * at_gauss;
  for (Index k = 0; k < per_element_; ++k) {
    const int node = mesh_.element_node(e, k);
    Vector3d s = at_node.row(k).transpose();
    if (split) s += field.near_stress.row(node).transpose();
    Eigen::Matrix2d tensor;
    tensor << s[0], s[2], s[2], s[1];
    tensor = (turn * tensor * turn.transpose()).eval();
    const Index shown = out.gear.node(j, node);
    out.stress.row(shown) += Eigen::RowVector3d(tensor(0, 0), tensor(1, 1), tensor(0, 1));
    elements_about[shown] += 1;
  }
}

// How far the loaded flank of a tooth gives way, strip by strip.
void add_deflections(const SectorGrid& mesh, const ToothGeometry& tooth, const std::vector<StripLoad>& loads,
                     const ToothField& field, const Eigen::Matrix2d& turn, LoadedGear& out) {
  const LoadedTooth* at = field.at;
  const auto strips = static_cast<Index>(at->strip.size());
  VectorXd roll(strips);
  for (Index i = 0; i < strips; ++i)
    roll[i] = loads[static_cast<size_t>(at->strip[static_cast<size_t>(i)])].roll;
  const VectorXd smooth = FlankReader(mesh).displacement(roll) * field.x;
  const GaussRule rule = gauss_rule(8);
  for (Index i = 0; i < strips; ++i) {
    const Index number = at->strip[static_cast<size_t>(i)];
    const StripLoad& load = loads[static_cast<size_t>(number)];
    Vec2 mean = smooth.segment<2>(2 * i);
    for (Index g = 0; g < rule.point.size(); ++g) {
      const double xi = load.roll + 0.5 * rule.point[g] * load.width / (tooth.base_radius() * load.roll);
      mean += 0.5 * rule.weight[g] * at->displacement(tooth.flank_point(xi));
    }
    out.deflection[number] = -tooth.flank_normal(load.roll).dot(mean);
    out.strip_displacement.row(number) = turn * mean;
  }
}

}  // namespace

LoadedGear loaded_gear(const SectorGrid& mesh, const Material& material,
                       const std::vector<StripLoad>& loads) {
  const int teeth = mesh.design.teeth;
  if (loads.empty()) fail(Failure::input, "a gear without load has no deformed shape");
  if (mesh.design.crack.depth > 0)
    fail(Failure::input, "the gear has a crack in tooth ", mesh.design.crack.tooth,
         ": its loaded shape is not available; set depth_mm = 0 in [gear.<name>.crack]");
  const ToothGeometry tooth(mesh.design);
  const Index nodes = mesh.node_position.rows();
  const ToothLoads by_tooth = loads_by_tooth(mesh, material, tooth, loads);
  const std::vector<VectorXd> unknown = unknowns_of(mesh, material, by_tooth);

  LoadedGear out;
  out.gear = replicate(mesh);
  out.displacement = MatrixRM::Zero(out.gear.node_position.rows(), 2);
  out.stress = MatrixRM::Zero(out.gear.node_position.rows(), 3);
  out.deflection = VectorXd::Zero(static_cast<Index>(loads.size()));
  out.strip_displacement = MatrixRM::Zero(static_cast<Index>(loads.size()), 2);
  VectorXd elements_about = VectorXd::Zero(out.gear.node_position.rows());
  out.hub_torque = hub_torque(mesh, material, by_tooth, unknown);

  const ElementStress stress(mesh, material);
  for (int j = 0; j < teeth; ++j) {
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(2 * kPi * j / teeth).toRotationMatrix();
    const VectorXd& x = unknown[static_cast<size_t>(j)];
    const auto found = by_tooth.tooth.find(j);
    const ToothField field =
        field_of(mesh, found == by_tooth.tooth.end() ? nullptr : &found->second, x, by_tooth.holds_rest);
    for (Index i = 0; i < nodes; ++i) {
      Vec2 u = x.segment<2>(2 * i);
      if (field.at && by_tooth.holds_rest[static_cast<size_t>(i)]) u += field.near.segment<2>(2 * i);
      out.displacement.row(out.gear.node(j, i)) = turn * u;
    }
    for (Index e = 0; e < mesh.element_node.rows(); ++e) stress.add(e, j, turn, field, elements_about, out);
    if (field.at) add_deflections(mesh, tooth, loads, field, turn, out);
  }
  out.stress.array().colwise() /= elements_about.array();
  return out;
}

}  // namespace whine
