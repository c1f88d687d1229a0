#include "solid/flank_loads.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/units.h"
#include "contact/half_plane.h"
#include "solid/exact_boundary.h"

namespace whine {
namespace {

// A side of an element on the boundary of the tooth region, node order counter-clockwise around the region.
struct RegionSide {
  std::vector<int> node;  // 2, or 3: start, end, middle
  bool cut = false;       // borders on the rest of the gear; otherwise free
  bool flank = false;     // on the driving flank
};

std::vector<RegionSide> sides_of_tooth_region(const SectorGrid& mesh) {
  const std::set<int> flank(mesh.flank_node.begin(), mesh.flank_node.end());
  std::set<int> edge;
  for (Eigen::Index i = 0; i < mesh.side_node.size(); ++i) edge.insert(mesh.side_node.data()[i]);
  auto element_side = [&](Eigen::Index e, int k) {
    std::vector<int> node{mesh.element_node(e, k), mesh.element_node(e, (k + 1) % 4)};
    if (mesh.element_node.cols() == 9) node.push_back(mesh.element_node(e, 4 + k));
    return node;
  };
  std::map<std::pair<int, int>, std::pair<int, int>> count;  // tooth elements, other elements at a side
  for (Eigen::Index e = 0; e < mesh.element_node.rows(); ++e)
    for (int k = 0; k < 4; ++k) {
      const auto node = element_side(e, k);
      if (node[0] == node[1]) continue;  // of a triangle
      auto& [tooth, rest] = count[std::minmax(node[0], node[1])];
      ++(mesh.element_region[e] == 1 ? tooth : rest);
    }
  std::vector<RegionSide> sides;
  for (Eigen::Index e = 0; e < mesh.element_node.rows(); ++e) {
    if (mesh.element_region[e] != 1) continue;
    for (int k = 0; k < 4; ++k) {
      RegionSide side{element_side(e, k)};
      if (side.node[0] == side.node[1]) continue;
      const auto [tooth, rest] = count.at(std::minmax(side.node[0], side.node[1]));
      if (tooth == 2) continue;
      auto all_in = [&side](const std::set<int>& set) {
        return std::all_of(side.node.begin(), side.node.end(), [&set](int i) { return set.contains(i); });
      };
      side.cut = rest > 0 || all_in(edge);
      side.flank = all_in(flank);
      sides.push_back(side);
    }
  }
  return sides;
}

// Adds the integral of N^T t_hs over one side; sides that are long against their distance to the load are
// halved.
class TractionIntegral {
 public:
  TractionIntegral(const SectorGrid& mesh, const ToothGeometry& tooth) : mesh_(mesh), tooth_(tooth) {
    for (Eigen::Index i = 0; i < mesh.flank_node.size(); ++i)
      roll_[mesh.flank_node[i]] = mesh.flank_roll_angle[i];
  }

  void add(const RegionSide& side, const Vec2& load, const LineLoadField& field,
           Eigen::Ref<Eigen::VectorXd> force) const {
    add(side, load, field, -1, 1, 0, force);
  }

 private:
  struct Place {
    Vec2 point, outward;  // outward: times the length per unit of a
  };
  Place place(const RegionSide& side, double a) const {
    const size_t n = side.node.size();
    if (side.flank) {  // the exact involute: the half-plane's traction next to the load knows the difference
      const double from = roll_.at(side.node[0]), to = roll_.at(side.node[1]);
      const double xi = roll_angle_between(from, to, a);
      return {tooth_.flank_point(xi),
              tooth_.flank_normal(xi) * (0.5 * std::abs(tooth_.arc_length(to) - tooth_.arc_length(from)))};
    }
    const SideShape shape = side_shape(n, a);
    Vec2 point = Vec2::Zero(), along = Vec2::Zero();
    for (size_t k = 0; k < n; ++k) {
      const Vec2 p = mesh_.node_position.row(side.node[k]);
      point += shape.value[k] * p;
      along += shape.slope[k] * p;
    }
    return {point, {along.y(), -along.x()}};
  }
  void add(const RegionSide& side, const Vec2& load, const LineLoadField& field, double from, double to,
           int depth, Eigen::Ref<Eigen::VectorXd> force) const {
    const Vec2 start = place(side, from).point, end = place(side, to).point,
               middle = place(side, 0.5 * (from + to)).point;
    const double length = (end - start).norm();
    const double distance = std::min({(start - load).norm(), (end - load).norm(), (middle - load).norm()});
    constexpr int kDeepest = 24;  // 2e-8 of a side: beyond it the exact involute is flat to round-off
    if (length > distance && depth < kDeepest) {
      add(side, load, field, from, 0.5 * (from + to), depth + 1, force);
      add(side, load, field, 0.5 * (from + to), to, depth + 1, force);
      return;
    }
    if (length > distance) return;  // traction is bounded on a flank, the piece is nothing
    static const GaussRule rule = gauss_rule(10);
    for (Eigen::Index g = 0; g < rule.point.size(); ++g) {
      const double a = 0.5 * (from + to) + 0.5 * (to - from) * rule.point[g];
      const Place at = place(side, a);
      const Vec2 traction = 0.5 * (to - from) * rule.weight[g] * field.traction(at.point, at.outward);
      const SideShape shape = side_shape(side.node.size(), a);
      for (size_t k = 0; k < side.node.size(); ++k)
        force.segment<2>(2 * side.node[k]) += shape.value[k] * traction;
    }
  }

  const SectorGrid& mesh_;
  const ToothGeometry& tooth_;
  std::map<int, double> roll_;  // rad, of flank nodes
};

// Inward displacement of the flank at roll angle xi by the half-plane that is loaded at `load`, less that of a flat
// surface at the same arc length. m N-1
double beside_flat_surface(const LineLoadField& field, const ToothGeometry& tooth, const PlaneModuli& moduli,
                           double thickness, double xi, double load) {
  if (xi == load) return 0;  // on the surface under the load both parts have the same limit
  return -tooth.flank_normal(xi).dot(field.displacement(tooth.flank_point(xi))) -
         flat_surface_displacement(tooth.arc_length(xi) - tooth.arc_length(load), moduli, thickness,
                                   kReferenceDepth);
}

// Of a point or a normal of the driving flank of tooth 0: that of its other flank.
Vec2 mirrored(const Vec2& v) {
  return {-v.x(), v.y()};
}

}  // namespace

FlankReader::FlankReader(const SectorGrid& mesh) : mesh_(mesh), tooth_(mesh.design) {
  const Eigen::Index step = mesh.element_node.cols() == 9 ? 2 : 1;
  if (mesh.flank_node.size() < step + 1 || (mesh.flank_node.size() - 1) % step != 0 ||
      mesh.flank_roll_angle.size() != mesh.flank_node.size())
    fail(Failure::input, "the mesh has ", mesh.flank_node.size(), " flank nodes and ",
         mesh.flank_roll_angle.size(),
         " roll angles, which do not make whole element sides; rebuild the mesh");
}

SparseReal FlankReader::displacement(const Eigen::VectorXd& xi) const {
  const Eigen::Index step = mesh_.element_node.cols() == 9 ? 2 : 1, last = mesh_.flank_node.size() - 1;
  SparseReal reading(2 * xi.size(), 2 * mesh_.node_position.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < xi.size(); ++i) {
    const double lowest = mesh_.flank_roll_angle[0], highest = mesh_.flank_roll_angle[last];
    if (!(xi[i] >= lowest - 1e-9 && xi[i] <= highest + 1e-9))
      fail(Failure::numerical, "no displacement can be read at roll angle ", xi[i],
           " rad: the flank of the mesh goes from ", lowest, " to ", highest, " rad");
    Eigen::Index side = 0;
    while (side + step < last && mesh_.flank_roll_angle[side + step] < xi[i]) side += step;
    const double from = mesh_.flank_roll_angle[side], to = mesh_.flank_roll_angle[side + step];
    const double share = (xi[i] * xi[i] - from * from) / (to * to - from * from);  // of the side's arc length
    const SideShape shape = side_shape(static_cast<size_t>(step + 1), 2 * share - 1);
    const Eigen::Index node[3] = {side, side + step, side + 1};
    for (int k = 0; k < step + 1; ++k)
      for (int c = 0; c < 2; ++c)
        entries.emplace_back(static_cast<int>(2 * i + c), 2 * mesh_.flank_node[node[k]] + c, shape.value[k]);
  }
  reading.setFromTriplets(entries.begin(), entries.end());
  return reading;
}

SparseReal FlankReader::outward(const Eigen::VectorXd& xi) const {
  SparseReal normal(xi.size(), 2 * xi.size());
  for (Eigen::Index i = 0; i < xi.size(); ++i)
    for (int c = 0; c < 2; ++c) normal.insert(i, 2 * i + c) = tooth_.flank_normal(xi[i])[c];
  return normal * displacement(xi);
}

Eigen::Index FlankReader::element_at(const Vec2& p, Vec2& reference) const {
  Eigen::MatrixX2d nodes(mesh_.element_node.cols(), 2);
  for (Eigen::Index e = 0; e < mesh_.element_node.rows(); ++e) {
    if (mesh_.element_region[e] != 1) continue;
    for (Eigen::Index k = 0; k < nodes.rows(); ++k)
      nodes.row(k) = mesh_.node_position.row(mesh_.element_node(e, k));
    const Vec2 low = nodes.colwise().minCoeff(), high = nodes.colwise().maxCoeff();
    const Vec2 slack = 0.2 * (high - low);  // a curved side bulges beyond its nodes
    if ((p - low + slack).minCoeff() < 0 || (high + slack - p).minCoeff() < 0) continue;
    if (invert_map(nodes, p, reference) && reference.cwiseAbs().maxCoeff() < 1 + 1e-6) return e;
  }
  return -1;
}

SparseReal FlankReader::outward_below(const Eigen::VectorXd& xi, double depth) const {
  SparseReal reading(xi.size(), 2 * mesh_.node_position.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < xi.size(); ++i) {
    const Vec2 normal = tooth_.flank_normal(xi[i]), surface = tooth_.flank_point(xi[i]);
    Vec2 at;
    const Eigen::Index e = element_at(surface - depth * normal, at);
    if (e < 0) {
      double inside = 0, outside = depth;  // a depth that is inside, one that is not
      while (outside - inside > 1e-3 * depth) {
        const double middle = 0.5 * (inside + outside);
        (element_at(surface - middle * normal, at) < 0 ? outside : inside) = middle;
      }
      fail(Failure::input, "matching_depth_mm = ", depth * 1e3, " leaves the tooth: ", inside * 1e3,
           " mm below the flank at roll angle ", xi[i] * 180 / kPi, " deg (",
           std::abs(tooth_.arc_length(tooth_.tip_roll_angle()) - tooth_.arc_length(xi[i])) * 1e3,
           " mm from the tip edge) the material ends; lower it, or use near_field = \"subtraction\"");
    }
    const int nodes = static_cast<int>(mesh_.element_node.cols());
    const Shape shape = shape_functions(nodes, at[0], at[1]);
    for (int k = 0; k < nodes; ++k)
      for (int c = 0; c < 2; ++c)
        entries.emplace_back(static_cast<int>(i), 2 * mesh_.element_node(e, k) + c,
                             shape.value[k] * normal[c]);
  }
  reading.setFromTriplets(entries.begin(), entries.end());
  return reading;
}

SparseReal FlankReader::back_outward(const Eigen::VectorXd& xi) const {
  const SparseReal front = outward(xi);
  std::map<int, int> image;
  for (const int node : mesh_.flank_node) {
    const Vec2 mirrored(-mesh_.node_position(node, 0), mesh_.node_position(node, 1));
    Eigen::Index nearest = 0;
    const double miss =
        (mesh_.node_position.rowwise() - mirrored.transpose()).rowwise().norm().minCoeff(&nearest);
    if (miss > 1e-9 * mirrored.norm())
      fail(Failure::input, "the mesh has no mirror image of its flank node ", node, " (the nearest node is ",
           miss * 1e3, " mm off); rebuild the mesh");
    image[node] = static_cast<int>(nearest);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < front.outerSize(); ++column)
    for (SparseReal::InnerIterator it(front, column); it; ++it) {
      const int xy = static_cast<int>(it.col()) % 2;
      entries.emplace_back(static_cast<int>(it.row()), 2 * image.at(static_cast<int>(it.col()) / 2) + xy,
                           xy == 0 ? -it.value() : it.value());
    }
  SparseReal reading(front.rows(), front.cols());
  reading.setFromTriplets(entries.begin(), entries.end());
  return reading;
}

FlankLoads make_matched_loads(const SectorGrid& mesh, const Material& material, const Eigen::VectorXd& xi,
                              double depth) {
  const ToothGeometry tooth(mesh.design);
  const PlaneModuli moduli = plane_strain_equivalent(material);
  const double thickness = mesh.design.face_width;
  const Eigen::Index size = 2 * mesh.node_position.rows(), loads = xi.size();
  FlankLoads result{-Eigen::MatrixXd(FlankReader(mesh).outward(xi)).transpose(),
                    Eigen::MatrixXd::Zero(size, loads),
                    std::vector<char>(static_cast<size_t>(mesh.node_position.rows()), 0),
                    MatrixRM::Zero(loads, loads), MatrixRM::Zero(loads, loads)};
  for (Eigen::Index j = 0; j < loads; ++j) {
    const LineLoadField field(tooth.flank_point(xi[j]), tooth.flank_normal(xi[j]), moduli, thickness,
                              kReferenceDepth);
    for (Eigen::Index i = 0; i < loads; ++i) {
      const Vec2 normal = tooth.flank_normal(xi[i]), surface = tooth.flank_point(xi[i]);
      result.subtracted(i, j) = beside_flat_surface(field, tooth, moduli, thickness, xi[i], xi[j]) +
                                normal.dot(field.displacement(surface - depth * normal));
    }
  }
  return result;
}

FlankLoads make_flank_loads(const SectorGrid& mesh, const Material& material, const Eigen::VectorXd& xi) {
  const ToothGeometry tooth(mesh.design);
  const PlaneModuli moduli = plane_strain_equivalent(material);
  const double thickness = mesh.design.face_width;
  const Eigen::Index nodes = mesh.node_position.rows(), loads = xi.size();

  const std::vector<RegionSide> sides = sides_of_tooth_region(mesh);
  std::vector<char> in_region(static_cast<size_t>(mesh.element_node.rows()));
  std::vector<char> holds_rest(static_cast<size_t>(nodes), 0);  // nodes where the unknown is w
  std::vector<char> on_cut(static_cast<size_t>(nodes), 0);
  for (Eigen::Index e = 0; e < mesh.element_node.rows(); ++e) {
    in_region[static_cast<size_t>(e)] = mesh.element_region[e] == 1;
    if (mesh.element_region[e] == 1)
      for (Eigen::Index k = 0; k < mesh.element_node.cols(); ++k)
        holds_rest[static_cast<size_t>(mesh.element_node(e, k))] = 1;
  }
  for (const RegionSide& side : sides)
    if (side.cut)
      for (int node : side.node) {
        on_cut[static_cast<size_t>(node)] = 1;
        holds_rest[static_cast<size_t>(node)] = 0;
      }
  const SparseReal region_stiffness =
      assemble(mesh.node_position, mesh.element_node, material, thickness, in_region).stiffness;
  const TractionIntegral integral(mesh, tooth);

  FlankLoads result{Eigen::MatrixXd::Zero(2 * nodes, loads), Eigen::MatrixXd::Zero(2 * nodes, loads),
                    holds_rest, MatrixRM::Zero(loads, loads), MatrixRM::Zero(loads, loads)};
  for (Eigen::Index j = 0; j < loads; ++j) {
    const Vec2 load = tooth.flank_point(xi[j]);
    const LineLoadField field(load, tooth.flank_normal(xi[j]), moduli, thickness, kReferenceDepth);
    Eigen::VectorXd traction = Eigen::VectorXd::Zero(2 * nodes), cut = Eigen::VectorXd::Zero(2 * nodes);
    for (const RegionSide& side : sides) integral.add(side, load, field, traction);
    for (Eigen::Index i = 0; i < nodes; ++i) {
      const Vec2 p = mesh.node_position.row(i);
      if (on_cut[static_cast<size_t>(i)]) cut.segment<2>(2 * i) = field.displacement(p);
      if (holds_rest[static_cast<size_t>(i)]) {
        // A node on the loaded point itself has no finite half-plane displacement: it is read a micrometre
        // below.
        const Vec2 away = (p - load).norm() > 1e-6 ? p : Vec2(load - 1e-6 * tooth.flank_normal(xi[j]));
        result.half_plane.col(j).segment<2>(2 * i) = field.displacement(away);
      }
    }
    result.force.col(j) = region_stiffness * cut - traction;
    for (Eigen::Index i = 0; i < loads; ++i) {
      result.subtracted(i, j) = beside_flat_surface(field, tooth, moduli, thickness, xi[i], xi[j]);
      result.across(i, j) =
          -mirrored(tooth.flank_normal(xi[i])).dot(field.displacement(mirrored(tooth.flank_point(xi[i]))));
    }
  }
  return result;
}

}  // namespace whine
