#include "solid/elements.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/error.h"

namespace whine {
namespace {

// Indices into the shape functions of a side, of each node of the element: (along a, along b).
constexpr int kNodeLine[9][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {1, 2}, {2, 1}, {0, 2}, {2, 2}};

// Shape functions at the Gauss points of an element type, tabulated once.
struct Quadrature {
  std::vector<Shape> shape;
  std::vector<double> weight;
};

Quadrature make_quadrature(int nodes) {
  const GaussRule rule = gauss_rule(nodes == 4 ? 2 : 3);
  Quadrature q;
  for (int i = 0; i < rule.point.size(); ++i)
    for (int j = 0; j < rule.point.size(); ++j) {
      q.shape.push_back(shape_functions(nodes, rule.point[i], rule.point[j]));
      q.weight.push_back(rule.weight[i] * rule.weight[j]);
    }
  return q;
}

const Quadrature& quadrature(int nodes) {
  static const Quadrature four = make_quadrature(4), nine = make_quadrature(9);
  return nodes == 4 ? four : nine;
}

// Jacobian matrix: rows reference directions, columns x and y.
Eigen::Matrix2d jacobian(const Shape& shape, const Eigen::MatrixX2d& nodes) {
  return shape.slope.transpose() * nodes;
}

double checked_determinant(const Eigen::Matrix2d& j, const Eigen::MatrixX2d& nodes) {
  const double det = j.determinant();
  if (!(det > 0))
    fail(Failure::numerical, "element near (", nodes(0, 0), ", ", nodes(0, 1),
         ") m has Jacobian determinant ", det,
         " m2, it must be above 0: the element is folded; change element_mm");
  return det;
}

Eigen::MatrixX2d element_nodes(const MatrixRM& position, const MatrixRMi& element_node, Eigen::Index e) {
  Eigen::MatrixX2d nodes(element_node.cols(), 2);
  for (Eigen::Index k = 0; k < element_node.cols(); ++k) nodes.row(k) = position.row(element_node(e, k));
  return nodes;
}

// Stress (xx, yy, zz, xy, yz, zx) from strain, shear as engineering strain. (6, 6) Pa
Eigen::Matrix<double, 6, 6> solid_elasticity(const Material& material) {
  const double nu = material.poisson_ratio, shear = material.youngs_modulus / (2 * (1 + nu)),
               lame = 2 * shear * nu / (1 - 2 * nu);
  Eigen::Matrix<double, 6, 6> c = Eigen::Matrix<double, 6, 6>::Zero();
  c.topLeftCorner<3, 3>().setConstant(lame);
  c.diagonal() << Eigen::Vector3d::Constant(lame + 2 * shear), Eigen::Vector3d::Constant(shear);
  return c;
}

}  // namespace

SideShape side_shape(std::size_t nodes, double a) {
  if (nodes == 2) return {{0.5 * (1 - a), 0.5 * (1 + a), 0}, {-0.5, 0.5, 0}};
  return {{0.5 * a * (a - 1), 0.5 * a * (a + 1), 1 - a * a}, {a - 0.5, a + 0.5, -2 * a}};
}

Shape shape_functions(int nodes, double a, double b) {
  if (nodes != 4 && nodes != 9) fail(Failure::input, "an element has 4 or 9 nodes, not ", nodes);
  const std::size_t order = nodes == 9 ? 3 : 2;
  const SideShape along_a = side_shape(order, a), along_b = side_shape(order, b);
  Shape shape{Eigen::VectorXd(nodes), Eigen::MatrixX2d(nodes, 2)};
  for (int k = 0; k < nodes; ++k) {
    const int i = kNodeLine[k][0], j = kNodeLine[k][1];
    shape.value[k] = along_a.value[i] * along_b.value[j];
    shape.slope(k, 0) = along_a.slope[i] * along_b.value[j];
    shape.slope(k, 1) = along_a.value[i] * along_b.slope[j];
  }
  return shape;
}

bool invert_map(const Eigen::MatrixX2d& nodes, const Eigen::Vector2d& p, Eigen::Vector2d& reference) {
  reference.setZero();
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Shape shape = shape_functions(static_cast<int>(nodes.rows()), reference[0], reference[1]);
    const Eigen::Matrix2d j = jacobian(shape, nodes);
    if (!(j.determinant() > 0)) return false;
    const Eigen::Vector2d miss = p - nodes.transpose() * shape.value;
    const Eigen::Vector2d step = j.transpose().inverse() * miss;
    reference += step;
    if (!(reference.cwiseAbs().maxCoeff() < 10)) return false;
    // Quadratic: the next step would be round-off, which is 1e-11 in an element of a micrometre.
    if (step.cwiseAbs().maxCoeff() < 1e-8) return true;
  }
  return false;
}

GaussRule gauss_rule(int points) {
  if (points < 1) fail(Failure::input, "a Gauss rule needs 1 point or more, not ", points);
  GaussRule rule{Eigen::VectorXd(points), Eigen::VectorXd(points)};
  for (int i = 0; i < points; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (points + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {  // Newton on the Legendre polynomial
      double p = x, previous = 1;
      for (int k = 2; k <= points; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
        previous = p;
        p = next;
      }
      slope = points * (previous - x * p) / (1 - x * x);
      const double step = p / slope;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    rule.point[i] = -x;
    rule.weight[i] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

Eigen::Vector2d reference_node(int k) {
  constexpr double kPlace[3] = {-1, 1, 0};  // of start, end, middle
  return {kPlace[kNodeLine[k][0]], kPlace[kNodeLine[k][1]]};
}

Eigen::Vector3d element_strain(const Eigen::MatrixX2d& nodes, const Eigen::MatrixX2d& displacement, double a,
                               double b) {
  const Shape shape = shape_functions(static_cast<int>(nodes.rows()), a, b);
  const Eigen::Matrix2d j = jacobian(shape, nodes);
  checked_determinant(j, nodes);
  // rows: directions of the derivative
  const Eigen::Matrix2d gradient = j.inverse() * (shape.slope.transpose() * displacement);
  return {gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0)};
}

Eigen::MatrixXd element_stiffness(const Eigen::MatrixX2d& nodes, const Material& material, double thickness) {
  const Quadrature& q = quadrature(static_cast<int>(nodes.rows()));
  const Eigen::Matrix3d d = thickness * plane_elasticity(material);
  const Eigen::Index n = nodes.rows();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(2 * n, 2 * n), b = Eigen::MatrixXd::Zero(3, 2 * n);
  for (size_t g = 0; g < q.shape.size(); ++g) {
    const Eigen::Matrix2d j = jacobian(q.shape[g], nodes);
    const double det = checked_determinant(j, nodes);
    const Eigen::MatrixX2d slope = q.shape[g].slope * j.inverse().transpose();
    for (Eigen::Index a = 0; a < n; ++a) {
      b(0, 2 * a) = b(2, 2 * a + 1) = slope(a, 0);
      b(1, 2 * a + 1) = b(2, 2 * a) = slope(a, 1);
    }
    k.noalias() += (q.weight[g] * det) * (b.transpose() * (d * b));
  }
  return 0.5 * (k + k.transpose());
}

Eigen::MatrixXd element_mass(const Eigen::MatrixX2d& nodes, double density, double thickness) {
  const Quadrature& q = quadrature(static_cast<int>(nodes.rows()));
  const Eigen::Index n = nodes.rows();
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (size_t g = 0; g < q.shape.size(); ++g) {
    const double det = checked_determinant(jacobian(q.shape[g], nodes), nodes);
    const Eigen::VectorXd& value = q.shape[g].value;
    for (Eigen::Index a = 0; a < n; ++a)
      for (Eigen::Index c = 0; c < n; ++c) {
        const double entry = density * thickness * q.weight[g] * det * value[a] * value[c];
        m(2 * a, 2 * c) += entry;
        m(2 * a + 1, 2 * c + 1) += entry;
      }
  }
  return m;
}

SectionStiffness section_stiffness(const Eigen::MatrixX2d& nodes, const Material& material, double helix) {
  const Quadrature& q = quadrature(static_cast<int>(nodes.rows()));
  const Eigen::Matrix<double, 6, 6> c = solid_elasticity(material);
  const Eigen::Index n = nodes.rows();
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  SectionStiffness k{zero, zero, zero};
  Eigen::MatrixXd b0 = Eigen::MatrixXd::Zero(6, 3 * n), bz = b0;
  for (size_t g = 0; g < q.shape.size(); ++g) {
    const Eigen::Matrix2d j = jacobian(q.shape[g], nodes);
    const double weight = q.weight[g] * checked_determinant(j, nodes);
    const Eigen::VectorXd& value = q.shape[g].value;
    const Eigen::MatrixX2d slope = q.shape[g].slope * j.inverse().transpose();
    const Eigen::Vector2d at = nodes.transpose() * value;
    for (Eigen::Index a = 0; a < n; ++a) {
      const double x = slope(a, 0), y = slope(a, 1), turn = helix * (at.y() * x - at.x() * y);
      b0.middleCols<3>(3 * a) << x, 0, 0, 0, y, 0, 0, 0, turn, y, x, 0, helix * value[a], turn, y, turn,
          -helix * value[a], x;
      bz(2, 3 * a + 2) = bz(4, 3 * a + 1) = bz(5, 3 * a) = value[a];
    }
    const Eigen::MatrixXd c0 = weight * c * b0, cz = weight * c * bz;
    k.k00.noalias() += b0.transpose() * c0;
    k.k01.noalias() += b0.transpose() * cz;
    k.k11.noalias() += bz.transpose() * cz;
  }
  k.k00 = (0.5 * (k.k00 + k.k00.transpose())).eval();
  k.k11 = (0.5 * (k.k11 + k.k11.transpose())).eval();
  return k;
}

SectionSystem assemble_section(const MatrixRM& node_position, const MatrixRMi& element_node,
                               const Material& material, double helix, const Eigen::VectorXi& number,
                               int count) {
  const Eigen::Index n = 3 * element_node.cols();
  std::array<std::vector<Eigen::Triplet<double>>, 4> entries;
  for (auto& list : entries) list.reserve(static_cast<size_t>(element_node.rows() * n * n));
  for (Eigen::Index e = 0; e < element_node.rows(); ++e) {
    const SectionStiffness k =
        section_stiffness(element_nodes(node_position, element_node, e), material, helix);
    for (Eigen::Index a = 0; a < n; ++a)
      for (Eigen::Index b = 0; b < n; ++b) {
        const int row = number[element_node(e, a / 3)], column = number[element_node(e, b / 3)];
        if (row < 0 || column < 0) continue;
        const int r = 3 * row + static_cast<int>(a % 3), s = 3 * column + static_cast<int>(b % 3);
        entries[0].emplace_back(r, s, k.k00(a, b));
        entries[1].emplace_back(r, s, k.k01(a, b));
        entries[2].emplace_back(r, s, k.k01(b, a));
        entries[3].emplace_back(r, s, k.k11(a, b));
      }
  }
  SectionSystem system;
  SparseReal* const sums[] = {&system.k00, &system.k01, &system.k10, &system.k11};
  for (size_t i = 0; i < entries.size(); ++i) {
    sums[i]->resize(3 * count, 3 * count);
    sums[i]->setFromTriplets(entries[i].begin(), entries[i].end());
  }
  return system;
}

double least_jacobian(const MatrixRM& node_position, const MatrixRMi& element_node) {
  const int n = static_cast<int>(element_node.cols());
  std::vector<Shape> corners;
  corners.reserve(4);
  for (int k = 0; k < 4; ++k)
    corners.push_back(shape_functions(n, kNodeLine[k][0] ? 1 : -1, kNodeLine[k][1] ? 1 : -1));
  const Quadrature& q = quadrature(n);
  double least = 1;
  for (Eigen::Index e = 0; e < element_node.rows(); ++e) {
    const Eigen::MatrixX2d nodes = element_nodes(node_position, element_node, e);
    double mean = 0, smallest = std::numeric_limits<double>::infinity();
    for (size_t g = 0; g < q.shape.size(); ++g) {
      const double det = jacobian(q.shape[g], nodes).determinant();
      mean += 0.25 * q.weight[g] * det;
      smallest = std::min(smallest, det);
    }
    for (const Shape& shape : corners) smallest = std::min(smallest, jacobian(shape, nodes).determinant());
    least = std::min(least, mean > 0 ? smallest / mean : -1.0);
  }
  return least;
}

double mesh_area(const MatrixRM& node_position, const MatrixRMi& element_node) {
  const Quadrature& q = quadrature(static_cast<int>(element_node.cols()));
  double area = 0;
  for (Eigen::Index e = 0; e < element_node.rows(); ++e) {
    const Eigen::MatrixX2d nodes = element_nodes(node_position, element_node, e);
    for (size_t g = 0; g < q.shape.size(); ++g)
      area += q.weight[g] * jacobian(q.shape[g], nodes).determinant();
  }
  return area;
}

PlaneSystem assemble(const MatrixRM& node_position, const MatrixRMi& element_node, const Material& material,
                     double thickness, const std::vector<char>& keep) {
  const Eigen::Index n = element_node.cols(), size = 2 * node_position.rows();
  std::vector<Eigen::Triplet<double>> stiffness, mass;
  stiffness.reserve(static_cast<size_t>(element_node.rows() * 4 * n * n));
  mass.reserve(static_cast<size_t>(element_node.rows() * 2 * n * n));
  for (Eigen::Index e = 0; e < element_node.rows(); ++e) {
    if (!keep.empty() && !keep[static_cast<size_t>(e)]) continue;
    const Eigen::MatrixX2d nodes = element_nodes(node_position, element_node, e);
    const Eigen::MatrixXd k = element_stiffness(nodes, material, thickness);
    const Eigen::MatrixXd m = element_mass(nodes, material.density, thickness);
    for (Eigen::Index a = 0; a < 2 * n; ++a)
      for (Eigen::Index b = 0; b < 2 * n; ++b) {
        const int row = 2 * element_node(e, a / 2) + static_cast<int>(a % 2);
        const int column = 2 * element_node(e, b / 2) + static_cast<int>(b % 2);
        stiffness.emplace_back(row, column, k(a, b));
        if (a % 2 == b % 2) mass.emplace_back(row, column, m(a, b));
      }
  }
  PlaneSystem system{SparseReal(size, size), SparseReal(size, size)};
  system.stiffness.setFromTriplets(stiffness.begin(), stiffness.end());
  system.mass.setFromTriplets(mass.begin(), mass.end());
  return system;
}

Eigen::VectorXd rotation_field(const MatrixRM& node_position) {
  Eigen::VectorXd field(2 * node_position.rows());
  for (Eigen::Index i = 0; i < node_position.rows(); ++i) {
    field[2 * i] = -node_position(i, 1);
    field[2 * i + 1] = node_position(i, 0);
  }
  return field;
}

}  // namespace whine
