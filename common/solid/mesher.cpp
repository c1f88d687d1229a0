#include "solid/mesher.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/units.h"
#include "gear/involute.h"
#include "solid/crack.h"
#include "solid/elements.h"
#include "solid/exact_boundary.h"

namespace whine {
namespace {

using Elements = std::vector<std::array<int, 9>>;  // of four nodes the first four

int nodes_of(const SectorGrid& mesh) {
  return mesh.discretisation.element_order == 2 ? 9 : 4;
}

// Nodes, elements and regions of the half sector and its mirror image. (node of the half) its image; of nodes on the centre
// line themselves.
std::vector<int> add_both_halves(const HalfGrid& half, const Elements& elements, SectorGrid& mesh) {
  const int count = static_cast<int>(half.node.size()), per_element = nodes_of(mesh);
  std::vector<int> image(half.node.size());
  std::vector<Vec2> node = half.node;
  for (int i = 0; i < count; ++i) {
    const Vec2 p = half.node[static_cast<size_t>(i)];
    if (p.x() == 0) {
      image[static_cast<size_t>(i)] = i;
    } else {
      image[static_cast<size_t>(i)] = static_cast<int>(node.size());
      node.emplace_back(-p.x(), p.y());
    }
  }

  mesh.node_position.resize(static_cast<Eigen::Index>(node.size()), 2);
  for (size_t i = 0; i < node.size(); ++i) mesh.node_position.row(static_cast<Eigen::Index>(i)) = node[i];
  const Eigen::Index half_elements = static_cast<Eigen::Index>(elements.size());
  mesh.element_node.resize(2 * half_elements, per_element);
  mesh.element_region.resize(2 * half_elements);
  constexpr int kMirrored[9] = {0, 3, 2, 1, 7, 6, 5, 4, 8};  // counter-clockwise again
  for (Eigen::Index e = 0; e < half_elements; ++e) {
    for (int k = 0; k < per_element; ++k) {
      mesh.element_node(e, k) = elements[static_cast<size_t>(e)][static_cast<size_t>(k)];
      mesh.element_node(half_elements + e, k) =
          image[static_cast<size_t>(elements[static_cast<size_t>(e)][static_cast<size_t>(kMirrored[k])])];
    }
    mesh.element_region[e] = mesh.element_region[half_elements + e] = half.region[static_cast<size_t>(e)];
  }
  return image;
}

// Nodes on the flank, the sector edges and the bore, from the edges of the elements that lie on a curve.
void add_node_sets(const HalfGrid& half, const Elements& elements, const ExactBoundary& exact,
                   const std::vector<int>& image, SectorGrid& mesh) {
  std::map<int, double> flank, side, bore;  // node of the half sector: roll angle, radius, polar angle
  for (const auto& element : elements)
    for (size_t k = 0; k < 4; ++k) {
      const auto edge = half.edge.find(std::minmax(element[k], element[(k + 1) % 4]));
      if (edge == half.edge.end()) continue;
      std::vector<int> on{element[k], element[(k + 1) % 4]};
      if (nodes_of(mesh) == 9) on.push_back(element[4 + k]);
      for (int i : on) {
        const Vec2 p = half.node[static_cast<size_t>(i)];
        if (edge->second == Curve::flank) flank[i] = exact.roll_angle(p);
        if (edge->second == Curve::sector_edge) side[i] = p.norm();
        if (edge->second == Curve::bore) bore[i] = p.x();
      }
    }
  auto sorted = [](const std::map<int, double>& set) {
    std::vector<std::pair<double, int>> list;
    list.reserve(set.size());
    for (const auto& [i, value] : set) list.emplace_back(value, i);
    std::sort(list.begin(), list.end());
    return list;
  };
  const auto flank_list = sorted(flank), side_list = sorted(side), bore_list = sorted(bore);
  mesh.flank_node.resize(static_cast<Eigen::Index>(flank_list.size()));
  mesh.flank_roll_angle.resize(mesh.flank_node.size());
  for (size_t i = 0; i < flank_list.size(); ++i) {
    mesh.flank_node[static_cast<Eigen::Index>(i)] = flank_list[i].second;
    mesh.flank_roll_angle[static_cast<Eigen::Index>(i)] = flank_list[i].first;
  }
  mesh.side_node.resize(static_cast<Eigen::Index>(side_list.size()), 2);
  for (size_t i = 0; i < side_list.size(); ++i) {
    mesh.side_node(static_cast<Eigen::Index>(i), 0) = image[static_cast<size_t>(side_list[i].second)];
    mesh.side_node(static_cast<Eigen::Index>(i), 1) = side_list[i].second;
  }
  std::vector<int> bore_nodes;
  for (const auto& [x, i] : bore_list) {
    bore_nodes.push_back(i);
    if (image[static_cast<size_t>(i)] != i) bore_nodes.push_back(image[static_cast<size_t>(i)]);
  }
  mesh.bore_node =
      Eigen::Map<Eigen::VectorXi>(bore_nodes.data(), static_cast<Eigen::Index>(bore_nodes.size()));
}

}  // namespace

double exact_sector_area(const GearDesign& design) {
  const ToothGeometry tooth(design);
  const GaussRule rule = gauss_rule(8);
  // Half of the boundary integral of r^2 dangle; edges through the centre give nothing.
  auto swept = [&](const std::function<Vec2(double)>& curve, double from, double to, int pieces) {
    double sum = 0;
    for (int i = 0; i < pieces; ++i)
      for (int g = 0; g < 8; ++g) {
        const double width = (to - from) / pieces, t = from + width * (i + 0.5 + 0.5 * rule.point[g]);
        const double step = 1e-5 * width;
        const Vec2 p = curve(t), d = (curve(t + step) - curve(t - step)) / (2 * step);
        sum += 0.25 * width * rule.weight[g] * (p.x() * d.y() - p.y() * d.x());
      }
    return sum;
  };
  const double half_top = 0.5 * tooth.thickness_at_radius(tooth.tip_radius()) / tooth.tip_radius();
  double half = 0.5 * half_top * tooth.tip_radius() * tooth.tip_radius();
  half += swept([&](double xi) { return tooth.flank_point(xi); }, tooth.tip_roll_angle(),
                tooth.form_roll_angle(), 20);
  // The root curve has a corner in its curvature where the trochoid meets the root circle.
  auto root = [&](double t) { return tooth.root_point(t); };
  if (tooth.root_corner() > 0) half += swept(root, 0, tooth.root_corner(), 40);
  if (tooth.root_corner() < 1) half += swept(root, tooth.root_corner(), 1, 1);
  half -= 0.5 * kPi / design.teeth * design.clamped_radius() * design.clamped_radius();
  return tooth.outwards() * 2 * half;
}

void check_sector_mesh(const SectorGrid& mesh) {
  const double least = least_jacobian(mesh.node_position, mesh.element_node);
  constexpr double kLeastJacobian = 0.01;
  if (!(least > kLeastJacobian))
    fail(Failure::numerical, "sector mesh: least Jacobian determinant is ", least,
         " of the element's mean, at least ", kLeastJacobian,
         " is needed: elements are folded or taper too much; change element_mm or raise bore_radius_mm");
  const double angle = 2 * kPi / mesh.design.teeth;
  const Eigen::Rotation2Dd turn(angle);
  const double scale = mesh.node_position.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < mesh.side_node.rows(); ++i) {
    const Vec2 low = mesh.node_position.row(mesh.side_node(i, 0)),
               high = mesh.node_position.row(mesh.side_node(i, 1));
    const double gap = (turn * low - high).norm();
    if (!(gap <= 1e-14 * scale))
      fail(Failure::numerical, "sector mesh: side node ", mesh.side_node(i, 1), " lies ", gap,
           " m off the image of its partner, at most ", 1e-14 * scale, " m is allowed");
  }
  const double area = mesh_area(mesh.node_position, mesh.element_node),
               exact = exact_sector_area(mesh.design);
  const double allowed = mesh.element_node.cols() == 4 ? 5e-3 : 2e-4;  // chords cut off more than parabolas
  if (!(std::abs(area - exact) <= allowed * exact))
    fail(Failure::numerical, "sector mesh: area ", area, " m2 against ", exact,
         " m2 of the exact sector, relative difference ", area / exact - 1, ", at most ", allowed,
         " is allowed; lower element_mm");
}

SectorGrid make_sector_mesh(const GearDesign& design, const BodyDiscretisation& discretisation,
                            double root_element) {
  const ToothGeometry tooth(design);
  const double h = discretisation.element_size;
  if (discretisation.element_order != 1 && discretisation.element_order != 2)
    fail(Failure::input, "element_order = ", discretisation.element_order, " is not 1 or 2");
  // The limits themselves are allowed, however they are rounded.
  constexpr double kRoundOff = 1e-9;
  if (!(h >= (0.01 - kRoundOff) * design.module && h <= (2 + kRoundOff) * design.module))
    fail(Failure::input, "element_mm = ", h * 1e3, " is not between 0.01 and 2 modules (",
         1e1 * design.module, " to ", 2e3 * design.module, " mm)");
  if (!design.internal && !(design.bore_radius > 0))
    fail(Failure::input, "bore_radius_mm = ", design.bore_radius * 1e3,
         " is not above 0: the hub on which the gear turns needs a radius");

  HalfGrid half = half_sector_mesh(tooth, h, root_element > 0 ? std::min(root_element, h) : h);
  const ExactBoundary exact(tooth);
  make_exact(half, tooth, exact);

  const bool second = discretisation.element_order == 2;
  Elements elements;
  if (second) {
    elements = raise_order(half, exact);
  } else {
    for (const auto& corner : half.element) elements.push_back({corner[0], corner[1], corner[2], corner[3]});
  }

  SectorGrid mesh;
  mesh.design = design;
  mesh.discretisation = discretisation;
  const std::vector<int> image = add_both_halves(half, elements, mesh);
  add_node_sets(half, elements, exact, image, mesh);
  check_sector_mesh(mesh);
  if (design.crack.depth > 0) mesh.cracked_tooth.push_back(make_cracked_sector(mesh));
  return mesh;
}

}  // namespace whine
