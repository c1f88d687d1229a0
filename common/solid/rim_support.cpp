#include "solid/rim_support.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"

namespace whine {

void add_rim_support(const SectorGrid& mesh, SparseReal& stiffness) {
  const GearDesign& design = mesh.design;
  if (!design.elastic_rim()) return;
  const std::size_t side = mesh.element_node.cols() == 9 ? 3 : 2;  // nodes
  std::vector<int> outside(mesh.bore_node.begin(), mesh.bore_node.end());
  const auto position = [&](int node) { return Eigen::Vector2d(mesh.node_position.row(node)); };
  // From the radius through the middle of the sector, of which no point is half a turn away.
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const int node : outside) middle += position(node);
  const auto angle = [&](int node) {
    const Eigen::Vector2d p = position(node);
    return std::atan2(middle.x() * p.y() - middle.y() * p.x(), middle.dot(p));
  };
  std::sort(outside.begin(), outside.end(), [&](int a, int b) { return angle(a) < angle(b); });
  if (outside.size() < side || (outside.size() - 1) % (side - 1) != 0)
    fail(Failure::input, "the mesh has ", outside.size(),
         " nodes on the outside of its rim, which are no whole sides of ", side, " nodes; rebuild it");

  const GaussRule rule = gauss_rule(static_cast<int>(side) + 1);
  std::vector<Eigen::Triplet<double>> added;
  for (std::size_t first = 0; first + 1 < outside.size(); first += side - 1) {
    // As SideShape has them: start, end, middle.
    int node[3] = {outside[first], outside[first + side - 1], outside[first + 1]};
    for (Eigen::Index g = 0; g < rule.point.size(); ++g) {
      const SideShape shape = side_shape(side, rule.point[g]);
      Eigen::Vector2d point = Eigen::Vector2d::Zero(), tangent = Eigen::Vector2d::Zero();
      for (std::size_t k = 0; k < side; ++k) {
        point += shape.value[k] * position(node[k]);
        tangent += shape.slope[k] * position(node[k]);
      }
      const Eigen::Vector2d radial = point.normalized(), across(-radial.y(), radial.x());
      const Eigen::Matrix2d spring = rule.weight[g] * tangent.norm() *
                                     (design.rim_radial_stiffness * radial * radial.transpose() +
                                      design.rim_tangential_stiffness * across * across.transpose());
      for (std::size_t i = 0; i < side; ++i)
        for (std::size_t j = 0; j < side; ++j)
          for (int r = 0; r < 2; ++r)
            for (int c = 0; c < 2; ++c)
              added.emplace_back(2 * node[i] + r, 2 * node[j] + c,
                                 shape.value[i] * shape.value[j] * spring(r, c));
    }
  }
  SparseReal support(stiffness.rows(), stiffness.cols());
  support.setFromTriplets(added.begin(), added.end());
  stiffness += support;
}

}  // namespace whine
