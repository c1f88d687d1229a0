// The section of a whole gear in quadratic triangles by gmsh, for CalculiX: fine around given points, nodes of the flanks on the involutes.
#pragma once
#include <gmsh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <vector>

#include "gear/involute.h"

namespace whine {

// Triangles with sides of `size` (m) within `even` (m) of these points of the turned gear (m).
struct FineAround {
  std::vector<Vec2> point;
  double size = 0, even = 0;
};

struct GearMeshPlan {
  double turned = 0;      // rad, counter-clockwise: of tooth 0 from the y axis
  bool trailing = false;  // the gear works with the mirror images of ToothGeometry::flank_point()
  std::vector<FineAround> fine;
  double coarse = 0;    // m: sides of the other triangles
  double growth = 0.2;  // 1: of the sides over the distance from the fine ones
  // On the flank of tooth 0 that works: `sides` equal arcs of triangles on `reach` (m) of arc to either side of the roll angle `middle` (rad);
  // not for trailing flanks.
  double middle = 0, reach = 0;
  int sides = 0;
};

struct FlankNode {
  std::size_t tag;
  double roll;  // rad
};

struct GearMesh {
  std::map<std::size_t, Vec2> node;                 // m, the gear's centre at the origin
  std::vector<std::array<std::size_t, 6>> element;  // corners counter-clockwise, mid-sides
  std::vector<std::size_t> bore;                    // ascending
  // [0: flanks that work, 1: the others][tooth] ascending in roll: corners of triangles and mid-sides in turn
  std::array<std::vector<std::vector<FlankNode>>, 2> flank;
  std::vector<std::size_t> root;  // on the root curve of tooth 0 beside the flank that leads
};

// A point or a normal of a flank as it works: with trailing flanks its mirror image.
inline Vec2 as_it_works(bool trailing, const Vec2& p) {
  return {trailing ? -p.x() : p.x(), p.y()};
}

class GearMesher {
 public:
  GearMesher(const ToothGeometry& tooth, GearMeshPlan plan) : tooth_(tooth), plan_(std::move(plan)) {}

  // A point of tooth j as it is drawn, or mirrored, in the turned gear.
  Vec2 placed(int j, const Vec2& p, bool mirrored) const {
    return Eigen::Rotation2Dd(plan_.turned + 2 * std::numbers::pi * j / tooth_.design().teeth) *
           as_it_works(mirrored, p);
  }
  Vec2 on_flank(double roll) const {
    return tooth_.flank_point(std::clamp(roll, tooth_.least_roll_angle(), tooth_.largest_roll_angle()));
  }

  // Both flanks of tooth 0 and its neighbours.
  FineAround flanks_of_three(double size) const {
    FineAround out{{}, size, size};
    const double from = tooth_.form_roll_angle(), step = 0.25 * (tooth_.tip_roll_angle() - from);
    for (const int j : {-1, 0, 1})
      for (const bool mirrored : {false, true})
        for (int i = 0; i <= 4; ++i)
          out.point.push_back(placed(j, tooth_.flank_point(from + i * step), mirrored));
    return out;
  }

  GearMesh mesh() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::model::add("gear");
    draw();
    gmsh::model::geo::synchronize();
    if (!arcs_.empty()) gmsh::model::mesh::setTransfiniteCurve(arcs_[0], plan_.sides + 1);
    set_sizes();
    gmsh::model::mesh::generate(2);
    gmsh::model::mesh::setOrder(2);
    GearMesh out = read();
    gmsh::finalize();
    return out;
  }

 private:
  static constexpr double kScale = 1e3;  // gmsh's tolerances are meant for numbers near 1

  static int point(const Vec2& p) { return gmsh::model::geo::addPoint(p.x() * kScale, p.y() * kScale, 0); }
  static int spline(int from, int to, int pieces, const std::function<Vec2(double)>& curve) {
    std::vector<int> points{from};
    for (int i = 1; i < pieces; ++i) points.push_back(point(curve(double(i) / pieces)));
    points.push_back(to);
    return gmsh::model::geo::addSpline(points);
  }
  double roll_at_arc(double arc) const {  // rad; arc: m from `middle`
    return std::sqrt(plan_.middle * plan_.middle + 2 * arc / tooth_.base_radius());
  }

  // The flank of tooth j that leads, from the tip c to the form point d.
  void draw_leading(int j, int c, int d, std::vector<int>& outer) {
    std::vector<double> roll{tooth_.tip_roll_angle(), tooth_.form_roll_angle()};
    std::vector<int> end{c, d};
    const bool patch = j == 0 && plan_.sides > 0;
    if (patch)
      for (const double arc : {-plan_.reach, plan_.reach}) {
        roll.insert(roll.begin() + 1, roll_at_arc(arc));
        end.insert(end.begin() + 1, point(placed(j, tooth_.flank_point(roll[1]), false)));
      }
    for (std::size_t i = 0; i + 1 < roll.size(); ++i) {
      const double from = roll[i], to = roll[i + 1];
      outer.push_back(spline(end[i], end[i + 1], 60, [&](double t) {
        return placed(j, tooth_.flank_point(from + (to - from) * t), false);
      }));
      curves_[plan_.trailing][static_cast<std::size_t>(j)].push_back(outer.back());
      if (patch && i == 1) arcs_.push_back(outer.back());
    }
  }

  void draw() {
    const int teeth = tooth_.design().teeth;
    const double form = tooth_.form_roll_angle(), tip = tooth_.tip_roll_angle();
    for (auto& of : curves_) of.resize(static_cast<std::size_t>(teeth));
    std::vector<int> outer,
        first(static_cast<std::size_t>(teeth));  // point in the tooth space clockwise of the tooth
    for (int j = 0; j < teeth; ++j)
      first[static_cast<std::size_t>(j)] = point(placed(j, tooth_.root_point(1), true));
    const int axis = point({0, 0});
    for (int j = 0; j < teeth; ++j) {
      const int a = point(placed(j, tooth_.flank_point(form), true)),
                b = point(placed(j, tooth_.flank_point(tip), true)),
                c = point(placed(j, tooth_.flank_point(tip), false)),
                d = point(placed(j, tooth_.flank_point(form), false));
      outer.push_back(spline(first[static_cast<std::size_t>(j)], a, 30,
                             [&](double t) { return placed(j, tooth_.root_point(1 - t), true); }));
      outer.push_back(spline(
          a, b, 60, [&](double t) { return placed(j, tooth_.flank_point(form + (tip - form) * t), true); }));
      curves_[!plan_.trailing][static_cast<std::size_t>(j)].push_back(outer.back());
      outer.push_back(gmsh::model::geo::addCircleArc(b, axis, c));
      draw_leading(j, c, d, outer);
      outer.push_back(spline(d, first[static_cast<std::size_t>((j + 1) % teeth)], 200,
                             [&](double t) { return placed(j, tooth_.root_point(t), false); }));
      if (j == 0) root_ = outer.back();
    }
    std::vector<int> quarter;
    for (int k = 0; k < 4; ++k)
      quarter.push_back(point(polar_point(tooth_.design().clamped_radius(), k * std::numbers::pi / 2)));
    for (std::size_t k = 0; k < 4; ++k)
      bore_.push_back(gmsh::model::geo::addCircleArc(quarter[k], axis, quarter[(k + 1) % 4]));
    std::vector<int> loops{gmsh::model::geo::addCurveLoop(outer), gmsh::model::geo::addCurveLoop(bore_)};
    if (tooth_.internal()) std::swap(loops[0], loops[1]);
    surface_ = gmsh::model::geo::addPlaneSurface(loops);
    gmsh::model::geo::remove({{0, axis}});
    for (const FineAround& fine : plan_.fine) {
      centres_.emplace_back();
      for (const Vec2& p : fine.point) centres_.back().push_back(point(p));
    }
  }

  void set_sizes() const {
    namespace field = gmsh::model::mesh::field;
    std::vector<double> sizes;
    for (std::size_t i = 0; i < plan_.fine.size(); ++i) {
      const FineAround& fine = plan_.fine[i];
      const int distance = field::add("Distance"), threshold = field::add("Threshold");
      field::setNumbers(distance, "PointsList", centres_[i]);
      field::setNumber(threshold, "InField", distance);
      field::setNumber(threshold, "SizeMin", fine.size * kScale);
      field::setNumber(threshold, "DistMin", fine.even * kScale);
      field::setNumber(threshold, "SizeMax", plan_.coarse * kScale);
      field::setNumber(threshold, "DistMax",
                       (fine.even + (plan_.coarse - fine.size) / plan_.growth) * kScale);
      sizes.push_back(threshold);
    }
    const int least = field::add("Min");
    field::setNumbers(least, "FieldsList", sizes);
    field::setAsBackgroundMesh(least);
    for (const char* off :
         {"Mesh.MeshSizeExtendFromBoundary", "Mesh.MeshSizeFromPoints", "Mesh.MeshSizeFromCurvature"})
      gmsh::option::setNumber(off, 0);
    gmsh::option::setNumber("Mesh.Algorithm", 6);
  }

  GearMesh read() const {
    GearMesh out;
    std::vector<std::size_t> tags;
    std::vector<double> at, parameters;
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> element_tags, element_nodes;
    gmsh::model::mesh::getElements(types, element_tags, element_nodes, 2, surface_);
    for (std::size_t t = 0; t < types.size(); ++t)
      for (std::size_t e = 0; e < element_tags[t].size(); ++e)
        std::copy_n(element_nodes[t].begin() + static_cast<std::ptrdiff_t>(6 * e), 6,
                    out.element.emplace_back().begin());
    gmsh::model::mesh::getNodes(tags, at, parameters, 2, surface_, true, false);
    for (std::size_t i = 0; i < tags.size(); ++i) out.node[tags[i]] = Vec2(at[3 * i], at[3 * i + 1]) / kScale;
    const auto on = [&](const std::vector<int>& curves) {
      std::vector<std::size_t> found;
      for (const int curve : curves) {
        gmsh::model::mesh::getNodes(tags, at, parameters, 1, curve, true, false);
        found.insert(found.end(), tags.begin(), tags.end());
      }
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());
      return found;
    };
    out.bore = on(bore_);
    out.root = on({root_});
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t j = 0; j < curves_[side].size(); ++j) {
        std::vector<FlankNode>& flank = out.flank[side].emplace_back();
        for (const std::size_t tag : on(curves_[side][j]))
          flank.push_back(
              {tag, tooth_.roll_angle_at_radius(std::max(out.node.at(tag).norm(), tooth_.base_radius()))});
        std::sort(flank.begin(), flank.end(),
                  [](const FlankNode& a, const FlankNode& b) { return a.roll < b.roll; });
        if (side == 0 && j == 0) set_arcs(flank);
        for (const FlankNode& node : flank)  // from the spline onto the involute
          out.node.at(node.tag) =
              placed(static_cast<int>(j), on_flank(node.roll), (side == 0) == plan_.trailing);
      }
    return out;
  }

  void set_arcs(std::vector<FlankNode>& flank) const {
    if (plan_.sides == 0) return;
    const auto first =
        std::min_element(flank.begin(), flank.end(), [&](const FlankNode& a, const FlankNode& b) {
          return std::abs(a.roll - roll_at_arc(-plan_.reach)) < std::abs(b.roll - roll_at_arc(-plan_.reach));
        });
    for (int i = 0; i <= 2 * plan_.sides; ++i)
      first[i].roll = roll_at_arc(plan_.reach * (static_cast<double>(i) / plan_.sides - 1));
  }

  const ToothGeometry& tooth_;
  GearMeshPlan plan_;
  // Curves of gmsh.
  std::array<std::vector<std::vector<int>>, 2> curves_;  // as GearMesh::flank
  std::vector<int> bore_, arcs_;
  std::vector<std::vector<double>> centres_;
  int root_ = 0, surface_ = 0;
};

}  // namespace whine
