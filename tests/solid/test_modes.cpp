// solid/: elements, assembly, factorisation, cyclic symmetry and eigensolver on whole bodies with known
// answers: a cantilever, a free disc, a free annulus and a thin ring. Values and orders of convergence.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "gear/involute.h"
#include "relative.h"
#include "solid/elements.h"
#include "solid/factor.h"
#include "solid/modes.h"
#include "solid/rim_support.h"
#include "solid/sector.h"

namespace {

using namespace whine;
constexpr double kPi = std::numbers::pi;

const Material kSteel{207e9, 0.3, 7600, true};
const Material kSteelStrain{207e9, 0.3, 7600, false};
// E / (rho (1 - nu^2)) = 1: a body of outer radius 1 vibrates at omega = lambda, lambda = omega R
// sqrt(rho (1 - nu^2) / E). The values below are the roots of the frequency equation of the plane disc (A. E. H.
// Love, A Treatise on the Mathematical Theory of Elasticity, 4th ed., chapter on plates), a determinant of
// Bessel functions, with rows for the stress-free bore of an annulus; right to all digits given.
const Material kUnit{0.91, 0.3, 1, true};

// A body of mapped blocks; nodes at one place are one node. order: 1 (4-node elements) or 2 (9-node).
class Blocks {
 public:
  Blocks(int order, double length) : order_(order), grain_(1e-9 * length) {}

  // columns x rows elements; place maps the unit square, positively oriented. Returns the node numbers, (row,
  // column) of nodes.
  Eigen::MatrixXi add(int columns, int rows, const std::function<Vec2(double s, double t)>& place) {
    const int o = order_;
    Eigen::MatrixXi number(o * rows + 1, o * columns + 1);
    for (int j = 0; j < number.rows(); ++j)
      for (int i = 0; i < number.cols(); ++i)
        number(j, i) = node_at(place(1.0 * i / (o * columns), 1.0 * j / (o * rows)));
    for (int j = 0; j < o * rows; j += o)
      for (int i = 0; i < o * columns; i += o) {
        std::vector<int> n{number(j, i), number(j, i + o), number(j + o, i + o), number(j + o, i)};
        if (o == 2)
          for (auto [y, x] :
               {std::pair{j, i + 1}, {j + 1, i + 2}, {j + 2, i + 1}, {j + 1, i}, {j + 1, i + 1}})
            n.push_back(number(y, x));
        element_.push_back(n);
      }
    return number;
  }

  SectorGrid mesh() const {
    SectorGrid mesh;
    mesh.node_position.resize(static_cast<int>(node_.size()), 2);
    for (size_t i = 0; i < node_.size(); ++i) mesh.node_position.row(static_cast<int>(i)) = node_[i];
    mesh.element_node.resize(static_cast<int>(element_.size()), order_ == 1 ? 4 : 9);
    for (size_t e = 0; e < element_.size(); ++e)
      for (size_t k = 0; k < element_[e].size(); ++k)
        mesh.element_node(static_cast<int>(e), static_cast<int>(k)) = element_[e][k];
    return mesh;
  }

 private:
  int node_at(const Vec2& p) {
    const auto key = std::pair{std::lround(p.x() / grain_), std::lround(p.y() / grain_)};
    const auto [found, added] = at_.emplace(key, static_cast<int>(node_.size()));
    if (added) node_.push_back(p);
    return found->second;
  }
  int order_;
  double grain_;
  std::vector<Vec2> node_;
  std::vector<std::vector<int>> element_;
  std::map<std::pair<long, long>, int> at_;
};

// Rows and columns of `a` that are free. number: of an unknown among them, -1 if it is fixed.
SparseComplex restricted(const SparseReal& a, const std::vector<int>& number, int size) {
  std::vector<Eigen::Triplet<std::complex<double>>> entries;
  for (int column = 0; column < a.outerSize(); ++column)
    for (SparseReal::InnerIterator it(a, column); it; ++it)
      if (number[static_cast<size_t>(it.row())] >= 0 && number[static_cast<size_t>(column)] >= 0)
        entries.emplace_back(number[static_cast<size_t>(it.row())], number[static_cast<size_t>(column)],
                             it.value());
  SparseComplex result(size, size);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

// Numbers the unknowns that are not fixed; the second is how many they are.
std::pair<std::vector<int>, int> number_free(const std::vector<char>& fixed) {
  std::vector<int> number(fixed.size(), -1);
  int size = 0;
  for (size_t i = 0; i < fixed.size(); ++i)
    if (!fixed[i]) number[i] = size++;
  return {number, size};
}

// s-1: the lowest frequencies of K u = omega^2 M u. K may be singular: K + shift M is factorised, shift > 0.
// A rigid motion comes out as 0, for omega^2 within the round-off of a shifted problem.
Eigen::VectorXd frequencies(const SparseComplex& stiffness, const SparseComplex& mass, int count,
                            double shift) {
  SparseComplex shifted = stiffness + shift * mass;
  shifted.makeCompressed();
  HermitianFactor factor(shifted);
  factor.factorise(shifted, "a shifted test body");
  Eigen::VectorXd squared =
      lowest_modes(shifted, mass, factor, count, "a test body").omega_squared.array() - shift;
  for (double& value : squared) {
    if (std::abs(value) < 1e-9 * shift) value = 0;
    REQUIRE(value >= 0);
  }
  return squared.cwiseSqrt();
}

// 1: slope of log(error) over log(size) by least squares.
double measured_order(const std::vector<double>& size, const std::vector<double>& error) {
  Eigen::MatrixX2d a(static_cast<int>(size.size()), 2);
  Eigen::VectorXd b(a.rows());
  for (int i = 0; i < a.rows(); ++i) {
    a.row(i) << std::log(size[static_cast<size_t>(i)]), 1;
    b[i] = std::log(error[static_cast<size_t>(i)]);
  }
  return (a.transpose() * a).inverse().row(0).dot(a.transpose() * b);
}

// Cantilever under a parabolic end shear, S. Timoshenko and J. N. Goodier, Theory of Elasticity, 3rd ed.,
// article 21; the root is at x = 0, |y| <= depth / 2.
struct Cantilever {
  double length = 48, depth = 12, force = 1000;
  Material material{3e7, 0.3, 1, true};
  double tip = 0.0089, energy = 4.474666667;  // deflection downwards; energy to the digits given

  double rigidity() const { return material.youngs_modulus * depth * depth * depth / 12; }  // E I
  Vec2 displacement(double x, double y) const {
    const double nu = material.poisson_ratio, l = length, d2 = depth * depth;
    return force / (6 * rigidity()) *
           Vec2(y * ((6 * l - 3 * x) * x + (2 + nu) * (y * y - d2 / 4)),
                -(3 * nu * y * y * (l - x) + (4 + 5 * nu) * d2 * x / 4 + (3 * l - x) * x * x));
  }
  Eigen::Vector3d stress(double x, double y) const {  // xx, yy, xy
    const double scale = force * material.youngs_modulus / rigidity();
    return {scale * (length - x) * y, 0, -0.5 * scale * (depth * depth / 4 - y * y)};
  }
};

struct CantileverResult {
  double tip, energy;     // downwards; of the discrete solution
  double error;           // 1/2 integral of (strain error) . D (strain error)
  double reaction;        // sum of the absolute forces at the supports over the force
  double external_twice;  // f . u
};

// Square elements, `rows` of them over the depth. Tractions are exact at the tip. At the root they are exact,
// too, and three supports without reaction hold the beam (`traction_root`), or the exact displacement is
// prescribed.
CantileverResult solve(const Cantilever& beam, int order, int rows, bool traction_root) {
  Blocks blocks(order, beam.length);
  const Eigen::MatrixXi grid = blocks.add(
      4 * rows, rows, [&](double s, double t) { return Vec2(beam.length * s, beam.depth * (t - 0.5)); });
  const SectorGrid mesh = blocks.mesh();
  const SparseReal stiffness = assemble(mesh.node_position, mesh.element_node, beam.material, 1).stiffness;
  const auto unknowns = static_cast<size_t>(stiffness.rows());

  Eigen::VectorXd load = Eigen::VectorXd::Zero(stiffness.rows()), u = load;
  const GaussRule rule = gauss_rule(4);
  const double side = beam.depth / rows;
  for (bool tip : {false, true})
    for (int row = 0; row < rows && (tip || traction_root); ++row)
      for (int g = 0; g < 4; ++g) {
        const double y = beam.depth * ((row + 0.5 * (1 + rule.point[g])) / rows - 0.5);
        const Eigen::Vector3d stress = beam.stress(tip ? beam.length : 0, y);
        const Vec2 traction = (tip ? 1 : -1) * Vec2(stress[0], stress[2]);
        const SideShape shape = side_shape(static_cast<size_t>(order + 1), rule.point[g]);
        for (int k = 0; k <= order; ++k) {
          const int along = order * row + (k == 0 ? 0 : k == 1 ? order : 1);
          load.segment<2>(2 * grid(along, tip ? grid.cols() - 1 : 0)) +=
              0.5 * side * rule.weight[g] * shape.value[k] * traction;
        }
      }

  std::vector<char> fixed(unknowns, 0);
  for (int j = 0; j < grid.rows(); ++j) {
    const int node = grid(j, 0);
    const bool middle = 2 * j == grid.rows() - 1;
    fixed[static_cast<size_t>(2 * node)] = !traction_root || middle || j == 0;
    fixed[static_cast<size_t>(2 * node + 1)] = !traction_root || middle;
    if (!traction_root) u.segment<2>(2 * node) = beam.displacement(0, mesh.node_position(node, 1));
  }
  const auto [number, size] = number_free(fixed);
  const Eigen::VectorXd right = load - stiffness * u;
  Eigen::VectorXcd reduced(size);
  for (size_t i = 0; i < unknowns; ++i)
    if (number[i] >= 0) reduced[number[i]] = right[static_cast<int>(i)];
  const SparseComplex matrix = restricted(stiffness, number, size);
  HermitianFactor factor(matrix);
  factor.factorise(matrix, "a cantilever");
  const Eigen::MatrixXcd solution = factor.solve(reduced);
  for (size_t i = 0; i < unknowns; ++i)
    if (number[i] >= 0) u[static_cast<int>(i)] = solution(number[i], 0).real();

  CantileverResult result{};
  REQUIRE((grid.rows() - 1) % 2 == 0);  // there is a node on the axis
  result.tip = -u[2 * grid((grid.rows() - 1) / 2, grid.cols() - 1) + 1];
  result.energy = 0.5 * u.dot(stiffness * u);
  result.external_twice = load.dot(u);
  const Eigen::VectorXd force = stiffness * u - load;
  for (size_t i = 0; i < unknowns; ++i)
    if (fixed[i]) result.reaction += std::abs(force[static_cast<int>(i)]) / beam.force;
  const Eigen::Matrix3d compliance = plane_elasticity(beam.material).inverse();
  for (int e = 0; e < mesh.element_node.rows(); ++e)
    for (int g = 0; g < 4; ++g)
      for (int h = 0; h < 4; ++h) {
        const Shape shape =
            shape_functions(static_cast<int>(mesh.element_node.cols()), rule.point[g], rule.point[h]);
        Vec2 p(0, 0);
        Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();  // (component, coordinate)
        for (int k = 0; k < mesh.element_node.cols(); ++k) {
          const int node = mesh.element_node(e, k);
          p += shape.value[k] * mesh.node_position.row(node).transpose();
          gradient +=
              u.segment<2>(2 * node) * shape.slope.row(k) * (2 / side);  // squares: no Jacobian needed
        }
        const Eigen::Vector3d stress =
            plane_elasticity(beam.material) *
                Eigen::Vector3d(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0)) -
            beam.stress(p.x(), p.y());
        result.error +=
            0.5 * rule.weight[g] * rule.weight[h] * side * side / 4 * stress.dot(compliance * stress);
      }
  return result;
}

// A quarter of a disc, x and y >= 0: a core and two blocks around it, k x k elements each.
SectorGrid quarter_disc(int order, int k, double radius) {
  Blocks blocks(order, radius);
  const Vec2 right(0.5 * radius, 0), corner(0.4 * radius, 0.4 * radius), top(0, 0.5 * radius);
  blocks.add(k, k, [&](double s, double t) -> Vec2 {
    return s * (1 - t) * right + s * t * corner + (1 - s) * t * top;
  });
  for (int block : {0, 1}) {
    const Vec2 &from = block ? corner : right, &to = block ? top : corner;
    blocks.add(k, k, [&](double s, double t) -> Vec2 {
      const double angle = kPi / 4 * (block + t);
      return (1 - s) * ((1 - t) * from + t * to) + s * radius * Vec2(std::cos(angle), std::sin(angle));
    });
  }
  return blocks.mesh();
}

// Frequencies of the disc's modes that are even or odd in the mirror y -> -y and in x -> -x. Such a family
// holds each frequency once (see modes.h): cos(n phi) fields with n even (both even), sin with n even (both odd), cos with
// n odd (even, odd).
Eigen::VectorXd disc_frequencies(const SectorGrid& mesh, const Material& material, bool even_y, bool even_x,
                                 int count, double shift) {
  const PlaneSystem system = assemble(mesh.node_position, mesh.element_node, material, 1);
  std::vector<char> fixed(static_cast<size_t>(system.mass.rows()), 0);
  const double near = 1e-9 * mesh.node_position.cwiseAbs().maxCoeff();
  for (int i = 0; i < mesh.node_position.rows(); ++i) {
    if (mesh.node_position(i, 1) < near) fixed[static_cast<size_t>(2 * i + (even_y ? 1 : 0))] = 1;
    if (mesh.node_position(i, 0) < near) fixed[static_cast<size_t>(2 * i + (even_x ? 0 : 1))] = 1;
  }
  const auto [number, size] = number_free(fixed);
  return frequencies(restricted(system.stiffness, number, size), restricted(system.mass, number, size), count,
                     shift);
}

// One of `sectors` equal sectors of a free annulus: columns x rows elements, rows over the thickness.
SectorGrid annulus_sector(int order, int sectors, double inner, double outer, int columns, int rows) {
  Blocks blocks(order, outer);
  const Eigen::MatrixXi number = blocks.add(rows, columns, [&](double s, double t) {
    // Rings in geometric progression: the fields of the bore fall like powers of the radius.
    const double radius = inner * std::pow(outer / inner, s), angle = kPi / 2 + (2 * t - 1) * kPi / sectors;
    return Vec2(radius * std::cos(angle), radius * std::sin(angle));
  });
  SectorGrid mesh = blocks.mesh();
  mesh.design.teeth = sectors;
  mesh.side_node.resize(number.cols(), 2);
  mesh.side_node << number.row(0).transpose(), number.row(number.rows() - 1).transpose();
  return mesh;
}

Eigen::VectorXd annulus_frequencies(const SectorGrid& mesh, const Material& material, int harmonic, int count,
                                    double shift) {
  const CyclicSector sector(mesh, assemble(mesh.node_position, mesh.element_node, material, 1));
  return frequencies(sector.stiffness(harmonic), sector.mass(harmonic), count, shift);
}

// Frequencies expected of one family of modes, ascending and complete, rigid motions as 0.
struct Family {
  std::string name;
  std::vector<double> lambda;
};

// Solves a family on each refinement. Every frequency of the finest must be right to 2e-3 or 1e-4 (the worst,
// n = 5, is found to 1.6e-3 and 5e-5), and its error be of order 2 or 4, twice the order of the elements,
// within 0.05 or 0.15: the coarsest meshes have six or two elements in the shortest half wave.
void check_convergence(const Family& family, const std::vector<int>& refinements,
                       const std::function<Eigen::VectorXd(int refinement, int count)>& solve_at, int order) {
  std::vector<double> size;
  std::vector<std::vector<double>> error(family.lambda.size());
  for (int k : refinements) {
    size.push_back(1.0 / k);
    const Eigen::VectorXd found = solve_at(k, static_cast<int>(family.lambda.size()));
    for (size_t i = 0; i < family.lambda.size(); ++i) {
      const double expected = family.lambda[i], value = found[static_cast<int>(i)];
      INFO(family.name, ", refinement ", k, ": expected ", expected, ", found ", value);
      if (expected == 0) {
        CHECK(value == 0);
        continue;
      }
      error[i].push_back(std::abs(value / expected - 1));
      if (k == refinements.back()) CHECK(error[i].back() < (order == 1 ? 2e-3 : 1e-4));
    }
  }
  for (size_t i = 0; i < family.lambda.size(); ++i) {
    if (family.lambda[i] == 0) continue;
    const double measured = measured_order(size, error[i]);
    INFO(family.name, ", lambda = ", family.lambda[i], ": order ", measured, ", error of the finest ",
         error[i].back());
    CHECK(std::abs(measured - 2 * order) < (order == 1 ? 0.05 : 0.15));
  }
}

}  // namespace

TEST_CASE("cantilever of Timoshenko and Goodier: tip, energy and its order") {
  const Cantilever beam;
  CHECK(-beam.displacement(beam.length, 0).y() == relative(beam.tip, 1e-12));
  for (bool traction_root : {true, false})
    for (int order : {1, 2}) {
      std::vector<double> size, error;
      CantileverResult finest{};
      for (int rows : {4, 6, 8, 12, 16}) {
        finest = solve(beam, order, rows, traction_root);
        size.push_back(1.0 / rows);
        error.push_back(finest.error);
        INFO("order ", order, ", traction at the root ", traction_root, ", ", rows, " rows: energy ",
             finest.energy, ", of its error ", finest.error, ", tip ", finest.tip);
        if (traction_root) {
          // Galerkin: the discrete energy is low by the energy of the error. 1e-9: digits of the exact value.
          CHECK(std::abs(beam.energy - finest.energy - finest.error) < 1e-9);
          CHECK(finest.external_twice == relative(2 * finest.energy, 1e-10));
          // The end loads balance: the supports carry round-off only.
          CHECK(finest.reaction < 1e-8);
        }
      }
      INFO("elements of order ", order, ", tip ", finest.tip / beam.tip - 1, " relative, energy ",
           finest.energy, " of ", beam.energy, ", order ", measured_order(size, error));
      CHECK(measured_order(size, error) == relative(2 * order, 0.02));
      CHECK(std::abs(finest.energy / beam.energy - 1) < (order == 1 ? 5e-3 : 1e-6));
      CHECK(std::abs(finest.tip / beam.tip - 1) < (order == 1 ? 5e-3 : 1e-6));
    }
}

TEST_CASE("free solid disc: all frequencies of each symmetry and their order") {
  struct Mirror {
    bool even_y, even_x;
    Family family;
  };
  const std::vector<Mirror> mirrors{
      {true, true, {"n = 2, 0 radial, 2, 4", {1.387652528, 2.048850204, 2.511178878, 2.774004231}}},
      {false,
       false,
       {"rotation, n = 2, 2, 4, 0 torsional", {0, 1.387652528, 2.511178878, 2.774004231, 3.038275127}}},
      {true,
       false,
       {"translation, n = 1, 3, 5, 3, 1",
        {0, 1.617558131, 2.130399069, 3.377384400, 3.451674582, 3.529116066}}}};
  for (const Mirror& mirror : mirrors)
    for (int order : {1, 2}) {
      CAPTURE(order);
      check_convergence(
          mirror.family, order == 1 ? std::vector{8, 12, 16, 24} : std::vector{3, 4, 6, 8},
          [&](int k, int count) {
            return disc_frequencies(quarter_disc(order, k, 1), kUnit, mirror.even_y, mirror.even_x, count, 1);
          },
          order);
    }
}

TEST_CASE("free steel disc of 75 mm: plane stress and plane strain, in hertz") {
  const SectorGrid mesh = quarter_disc(2, 8, 75e-3);
  const double shift = std::pow(2 * kPi * 1e4, 2);
  auto hertz = [&](const Material& material, bool even_x, int mode) {
    return disc_frequencies(mesh, material, true, even_x, mode + 1, shift)[mode] / (2 * kPi);
  };
  const double stress2 = hertz(kSteel, true, 0), stress1 = hertz(kSteel, false, 1);
  const double strain2 = hertz(kSteelStrain, true, 0), strain1 = hertz(kSteelStrain, false, 1);
  const double strain0 = hertz(kSteelStrain, true, 1);
  CAPTURE(stress2);
  CAPTURE(stress1);
  CAPTURE(strain2);
  CAPTURE(strain1);
  CAPTURE(strain0);
  CHECK(stress2 == relative(16110.06, 1e-5));
  CHECK(stress1 == relative(18779.17, 1e-5));
  CHECK(strain2 == relative(16126.35, 1e-5));
  CHECK(strain1 == relative(19348.48, 1e-5));
  CHECK(strain0 == relative(27314.71, 1e-5));
}

TEST_CASE("free annulus, bore a fifth of the rim: frequencies of harmonics 0 to 3 and their order") {
  const std::vector<Family> harmonics{{"n = 0: rotation, radial, torsional", {0, 1.801465381, 3.089239770}},
                                      {"n = 1: translation, elastic", {0, 1.651171306, 3.841592058}},
                                      {"n = 2", {1.109950109, 2.402391894, 4.015222442}},
                                      {"n = 3", {2.070719920, 3.399804091}}};
  for (int n = 0; n < 4; ++n)
    for (int order : {1, 2}) {
      CAPTURE(order);
      check_convergence(
          harmonics[static_cast<size_t>(n)], order == 1 ? std::vector{4, 6, 8, 12} : std::vector{2, 3, 4, 6},
          [&](int k, int count) {
            return annulus_frequencies(annulus_sector(order, 12, 0.2, 1, k, 3 * k), kUnit, n, count, 1);
          },
          order);
    }
}

TEST_CASE("thin ring: 4-node elements lock, 9-node elements give 514.321 Hz") {
  // Mean radius 50 mm, thickness 2 mm, n = 2: the root of Love's determinant; the formula of the thin ring,
  // sqrt(E I / (rho A R^4) n^2 (n^2 - 1)^2 / (n^2 + 1)), gives 514.712 Hz.
  const double exact = 514.321;
  auto error = [&](int order, int around, int through) {
    const SectorGrid mesh = annulus_sector(order, 12, 49e-3, 51e-3, around / 12, through);
    return annulus_frequencies(mesh, kSteel, 2, 1, std::pow(2 * kPi * 500, 2))[0] / (2 * kPi * exact) - 1;
  };
  const double nine = error(2, 96, 1), nine_fine = error(2, 144, 2);
  INFO("relative errors, 9 nodes: 96 x 1 elements ", nine, ", 144 x 2 ", nine_fine);
  CHECK(std::abs(nine) < 1e-3);
  CHECK(std::abs(nine_fine) < 2e-4);
  // A bilinear element bends only by shearing (and, curved, by stretching): far too stiff until it is shorter
  // than the ring is thick. Layers do not help, and with the same nodes as the 9-node mesh of 96 x 1 the
  // error is two hundred times as large.
  const double coarse = error(1, 36, 1), layer = error(1, 96, 1), layers = error(1, 96, 4);
  const double same_nodes = error(1, 192, 2), short_elements = error(1, 1440, 4);
  INFO("4 nodes: 36 x 1 ", coarse, ", 96 x 1 ", layer, ", 96 x 4 ", layers, ", 192 x 2 ", same_nodes,
       ", 1440 x 4 ", short_elements);
  CHECK(coarse > 1.5);
  CHECK(layer > 0.4);
  CHECK(layers > 0.4);
  CHECK(same_nodes > 100 * std::abs(nine));
  CHECK(std::abs(short_elements) < 1e-2);  // it locks, but it converges
}

TEST_CASE("thin ring on an even elastic support of its outside: frequencies of harmonics 0 to 5") {
  // Energies of a thin ring, u = a cos(n phi) outwards, v = b sin(n phi) along it, c from the middle to the outside R + c:
  //   U = E A / R (a + n b)^2 + E I / R^3 (1 - n^2)^2 a^2 + (R + c) (k_r a^2 + k_t (b (1 + c / R) + n c a / R)^2)
  //   T = rho A R (a^2 + b^2)
  // The theory is right to (n thickness / R)^2.
  const double radius = 50e-3, half = 1e-3, section = 2 * half, bending = std::pow(section, 3) / 12;
  for (const auto [radial, across] : {std::array{2e7, 2e7}, {5e8, 3e7}, {3e7, 5e8}}) {
    SectorGrid mesh = annulus_sector(2, 12, radius - half, radius + half, 8, 1);
    mesh.design.internal = true;
    mesh.design.rim_radial_stiffness = radial;
    mesh.design.rim_tangential_stiffness = across;
    std::vector<int> outside;
    for (int i = 0; i < mesh.node_position.rows(); ++i)
      if (mesh.node_position.row(i).norm() > radius + 0.99 * half) outside.push_back(i);
    mesh.bore_node = Eigen::Map<Eigen::VectorXi>(outside.data(), static_cast<Eigen::Index>(outside.size()));
    PlaneSystem system = assemble(mesh.node_position, mesh.element_node, kSteel, 1);
    add_rim_support(mesh, system.stiffness);
    const CyclicSector sector(mesh, system);
    for (int n = 0; n <= 5; ++n) {
      const double lever = n * half / radius, length = radius + half, arm = length / radius;
      const double stretch = kSteel.youngs_modulus * section / radius,
                   bend = kSteel.youngs_modulus * bending / std::pow(radius, 3) * std::pow(1.0 - n * n, 2);
      Eigen::Matrix2d k;
      k(0, 0) = stretch + bend + length * (radial + across * lever * lever);
      k(0, 1) = k(1, 0) = n * stretch + length * across * lever * arm;
      k(1, 1) = n * n * stretch + length * across * arm * arm;
      const Eigen::Vector2d expected = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(k).eigenvalues() /
                                       (kSteel.density * section * radius);
      // Above n = 0 the next frequency of the harmonic is that of 12 - n diameters.
      const int count = n == 0 ? 2 : 1;
      const Eigen::VectorXd found = frequencies(sector.stiffness(n), sector.mass(n), count, 0);
      CAPTURE(n);
      CAPTURE(radial);
      const double near = 1e-3 + 0.15 * std::pow(n * section / radius, 2);
      for (int i = 0; i < count; ++i) CHECK(found[i] == relative(std::sqrt(expected[i]), near));
    }
  }
}
