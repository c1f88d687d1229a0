// solid/: the third dimension of a body. Section matrices, rigid motions and constant strains of a prism that turns; flexibility of a gear
// against the whole gear in one piece, printed values and CalculiX.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/dense.h"
#include "base/legendre.h"
#include "base/units.h"
#include "io/artifacts.h"
#include "io/scene.h"
#include "own_folder.h"
#include "refusal.h"
#include "relative.h"
#include "scene_file.h"
#include "solid/flank_loads.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "solid/root_stress.h"
#include "solid/sector.h"
#include "solid/width_body.h"
#include "solid/width_tables.h"

namespace {

using namespace whine;

const Material kSteel{207e9, 0.3, 7850, true};
constexpr double kWidth = 20e-3;  // m
constexpr double kScale = 1e-12;  // m2 N-1: 1e-6 mm2 N-1

// Of 50 teeth, bore radius 40 mm, normal module 3 mm, normal pressure angle 20 degrees, the rack's depths 3 and 3.75 mm, its tip radius
// 1.14 mm in the transverse section. beta: rad.
GearDesign gear(double beta) {
  GearDesign design;
  const double c = std::cos(beta);
  design.teeth = 50;
  design.module = 3e-3 / c;
  design.pressure_angle = std::atan(std::tan(20 * kPi / 180) / c);
  design.addendum = c;
  design.dedendum = 1.25 * c;
  design.rack_tip_radius = 0.38 * c;
  design.face_width = kWidth;
  design.bore_radius = 40e-3;
  return design;
}

SectorGrid section(const GearDesign& design, double modules, int order = 2) {
  BodyDiscretisation how;
  how.element_size = modules * design.module;
  how.element_order = order;
  return make_sector_mesh(design, how);
}

// A block of 2 x 2 elements of 9 nodes on [75, 77] x [-1, 1] mm, one of its inner nodes moved.
SectorGrid block() {
  SectorGrid mesh;
  mesh.node_position.resize(25, 2);
  for (int i = 0; i < 25; ++i) mesh.node_position.row(i) << 75e-3 + i % 5 * 0.5e-3, -1e-3 + i / 5 * 0.5e-3;
  mesh.element_node.resize(4, 9);
  for (int e = 0; e < 4; ++e) {
    const int first = e % 2 * 2 + e / 2 * 10;
    mesh.element_node.row(e) << first, first + 2, first + 12, first + 10, first + 1, first + 7, first + 11,
        first + 5, first + 6;
  }
  return mesh;
}

// (node component polynomial): the whole stiffness matrix of a prism.
Eigen::MatrixXd prism_stiffness(const SectorGrid& mesh, const Material& material, double helix, int degree) {
  const int nodes = static_cast<int>(mesh.node_position.rows()), all = degree + 1;
  const SectionSystem s = assemble_section(mesh.node_position, mesh.element_node, material, helix,
                                           Eigen::VectorXi::LinSpaced(nodes, 0, nodes - 1), nodes);
  const Eigen::MatrixXd k00 = s.k00, k01 = s.k01, k11 = s.k11;
  Eigen::MatrixXd k(3 * nodes * all, 3 * nodes * all);
  for (int a = 0; a < 3 * nodes; ++a)
    for (int b = 0; b < 3 * nodes; ++b)
      for (int i = 0; i < all; ++i)
        for (int j = 0; j < all; ++j)
          k(a * all + i, b * all + j) =
              (i == j ? k00(a, b) : 0) + value_times_slope(i, j, kWidth) * k01(a, b) +
              value_times_slope(j, i, kWidth) * k01(b, a) + slope_times_slope(i, j, kWidth) * k11(a, b);
  return k;
}

// (node component polynomial) m: coefficients of a field of fixed axes, u(x, y, z), in turned ones.
template <class Field>
Eigen::VectorXd projected(const SectorGrid& mesh, double helix, int degree, const Field& field) {
  const GaussRule rule = gauss_rule(30);
  const Eigen::Index all = degree + 1;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * all * mesh.node_position.rows());
  for (Eigen::Index g = 0; g < rule.point.size(); ++g) {
    const double z = 0.5 * kWidth * rule.point[g];
    const Eigen::VectorXd p = 0.5 * kWidth * rule.weight[g] * face_polynomials(z, kWidth, degree);
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() << std::cos(helix * z), -std::sin(helix * z), std::sin(helix * z),
        std::cos(helix * z);
    for (Eigen::Index n = 0; n < mesh.node_position.rows(); ++n) {
      const Eigen::Vector3d at =
          turn * Eigen::Vector3d(mesh.node_position(n, 0), mesh.node_position(n, 1), 0) +
          Eigen::Vector3d(0, 0, z);
      const Eigen::Vector3d value = turn.transpose() * field(at);
      for (int c = 0; c < 3; ++c) u.segment((3 * n + c) * all, all) += value[c] * p;
    }
  }
  return u;
}

}  // namespace

TEST_CASE(
    "Polynomials over the face width are orthonormal, and so are the printed integrals of their slopes") {
  const GaussRule rule = gauss_rule(20);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(9, 9);
  for (int g = 0; g < 20; ++g) {
    const Eigen::VectorXd p = face_polynomials(0.5 * kWidth * rule.point[g], kWidth, 8);
    products += 0.5 * kWidth * rule.weight[g] * p * p.transpose();
  }
  CHECK((products - Eigen::MatrixXd::Identity(9, 9)).norm() < 1e-13);
  const auto rounded = [](double value, double printed) { CHECK(std::abs(value - printed) < 6e-7); };
  rounded(value_times_slope(0, 1, 20), 0.173205);
  rounded(value_times_slope(0, 3, 20), 0.264575);
  rounded(value_times_slope(1, 2, 20), 0.387298);
  rounded(value_times_slope(2, 3, 20), 0.591608);
  rounded(slope_times_slope(1, 1, 20), 0.03);
  rounded(slope_times_slope(1, 3, 20), 0.0458258);
  rounded(slope_times_slope(2, 2, 20), 0.15);
  rounded(slope_times_slope(2, 4, 20), 0.201246);
  rounded(slope_times_slope(3, 3, 20), 0.42);
  CHECK(value_times_slope(1, 0, 20) == 0);
  CHECK(value_times_slope(0, 2, 20) == 0);
  CHECK(slope_times_slope(1, 2, 20) == 0);
}

TEST_CASE("Section matrices of one element have the values of an independent program") {
  Eigen::MatrixX2d nodes(9, 2);
  for (int k = 0; k < 9; ++k)
    nodes.row(k) = Eigen::RowVector2d(10.5, 0.5) + 0.5 * reference_node(k).transpose();
  const Material unit{1, 0.3, 1, true};
  const auto near = [](double value, double printed) { CHECK(std::abs(value - printed) < 6e-7); };
  const SectionStiffness spur = section_stiffness(nodes, unit, 0);
  near(spur.k00.trace(), 33.846154);
  near(spur.k11.trace(), 1.353846);
  near(spur.k00.norm(), 11.043977);
  near(spur.k01.norm(), 0.873396);
  near(spur.k11.norm(), 0.493643);
  near(spur.k00(0, 0), 0.538462);
  near(spur.k00(0, 1), 0.240385);
  near(spur.k01(0, 2), -0.038462);
  near(spur.k01(2, 0), -0.025641);
  near(spur.k11(2, 2), 0.023932);
  const SectionStiffness helical = section_stiffness(nodes, unit, 0.1);
  near(helical.k00.trace(), 52.573218);
  near(helical.k00.norm(), 17.788677);
  near(helical.k01.norm(), 1.616143);
  near(helical.k11.norm(), 0.493643);
  near(helical.k00(0, 0), 0.658641);
  near(helical.k01.trace(), 0);
  CHECK((helical.k11 - spur.k11).norm() == 0);
}

TEST_CASE(
    "A prism that does not turn moves as a rigid body without energy from degree 1 on, and in six ways only") {
  const SectorGrid mesh = block();
  const Eigen::MatrixXd k = prism_stiffness(mesh, kSteel, 0, 1);
  const double strained = [&] {
    const Eigen::VectorXd u =
        projected(mesh, 0, 1, [](const Eigen::Vector3d& at) { return Eigen::Vector3d(0, 0, at.z()); });
    return u.dot(k * u);
  }();
  for (int c = 0; c < 3; ++c) {
    const Eigen::VectorXd shift = projected(
        mesh, 0, 1, [c](const Eigen::Vector3d&) -> Eigen::Vector3d { return Eigen::Vector3d::Unit(c); });
    CHECK(shift.dot(k * shift) < 1e-9 * strained);  // a shift of a metre
    const Eigen::VectorXd tilt = projected(mesh, 0, 1, [c](const Eigen::Vector3d& at) -> Eigen::Vector3d {
      return Eigen::Vector3d::Unit(c).cross(at);
    });
    CHECK(std::abs(tilt.dot(k * tilt)) < 1e-11 * strained);
  }
  const Eigen::VectorXd values = symmetric_eigenvalues(k).values;
  const double largest = values[values.size() - 1];
  CHECK(std::abs(values[0]) < 1e-12 * largest);
  CHECK(std::abs(values[5]) < 1e-12 * largest);
  CHECK(values[6] > 1e-7 * largest);
}

TEST_CASE(
    "Rigid motions of a prism that turns: exact along the axis, across it an error of high order in the degree") {
  const SectorGrid mesh = block();
  const double helix = 4.56027;  // rad m-1
  double shift_before = 1e300, tilt_before = 1e300;
  for (int degree = 0; degree <= 4; ++degree) {
    const Eigen::MatrixXd k = prism_stiffness(mesh, kSteel, helix, degree);
    const auto energy = [&](auto&& field) {
      const Eigen::VectorXd u = projected(mesh, helix, degree, field);
      return std::abs(u.dot(k * u));
    };
    const double along =
        energy([](const Eigen::Vector3d&) -> Eigen::Vector3d { return Eigen::Vector3d::UnitZ(); });
    const double about = energy(
        [](const Eigen::Vector3d& at) -> Eigen::Vector3d { return Eigen::Vector3d::UnitZ().cross(at); });
    const double shift =
        energy([](const Eigen::Vector3d&) -> Eigen::Vector3d { return Eigen::Vector3d::UnitX(); });
    const double tilt = energy(
        [](const Eigen::Vector3d& at) -> Eigen::Vector3d { return Eigen::Vector3d::UnitX().cross(at); });
    // J: a unit strain of this block stores 207e9 0.00008 m2 0.02 m.
    const double unit = kSteel.youngs_modulus * 4e-6 * kWidth;
    CHECK(along < 1e-8 * unit);
    CHECK(about < 1e-10 * unit);
    // (helix b / 2)^(2 p + 2) / ((p + 1)!)^2 and its like
    if (degree > 0 && degree < 4) CHECK(shift < 0.02 * shift_before);
    if (degree > 0) CHECK(tilt < 0.02 * tilt_before);
    if (degree == 4) {
      CHECK(shift < 1e-7 * unit);
      CHECK(tilt < 1e-11 * unit);
    }
    shift_before = shift;
    tilt_before = tilt;
  }
}

TEST_CASE(
    "Six constant strains of a prism leave no force inside, with the tractions of its ends on the right-hand side") {
  const SectorGrid mesh = block();
  const int degree = 3, all = degree + 1;
  const Eigen::MatrixXd k = prism_stiffness(mesh, kSteel, 0, degree);
  const SectionSystem s = assemble_section(mesh.node_position, mesh.element_node, kSteel, 0,
                                           Eigen::VectorXi::LinSpaced(25, 0, 24), 25);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c <= r; ++c) {
      Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
      strain(r, c) = strain(c, r) = 1;
      const double shear = kSteel.youngs_modulus / (2 * 1.3);
      const Eigen::Matrix3d stress =
          2 * shear * (strain + Eigen::Matrix3d::Identity() * strain.trace() * 0.3 / 0.4);
      const Eigen::VectorXd force =
          k * projected(mesh, 0, degree,
                        [&](const Eigen::Vector3d& at) -> Eigen::Vector3d { return strain * at; });
      const Eigen::VectorXd jump =
          face_polynomials(0.5 * kWidth, kWidth, degree) - face_polynomials(-0.5 * kWidth, kWidth, degree);
      double worst = 0;
      for (const int node : {6, 7, 8, 11, 12, 13, 16, 17, 18}) {
        // The area of the node: the traction of the ends is that of the k11 of u_z, divided by its modulus.
        double area = 0;
        for (int other = 0; other < 25; ++other) area += s.k11.coeff(3 * node, 3 * other) / shear;
        for (int component = 0; component < 3; ++component) {
          const Eigen::VectorXd left =
              force.segment((3 * node + component) * all, all) - stress(component, 2) * area * jump;
          worst = std::max(worst, left.cwiseAbs().maxCoeff());
        }
      }
      CHECK(worst < 1e-11 * force.cwiseAbs().maxCoeff());
    }
}

TEST_CASE("Condensed sectors give the flexibility of the whole gear in one piece, spur and helical") {
  GearDesign design = gear(0);
  design.teeth = 9;
  design.bore_radius = 5e-3;
  const SectorGrid mesh = section(design, 1.5, 1);
  const WholeGear whole = replicate(mesh);
  const int nodes = static_cast<int>(whole.node_position.rows());
  const double pitch = 2 * kPi / design.teeth;
  Eigen::VectorXi number = Eigen::VectorXi::Zero(nodes);
  for (int j = 0; j < design.teeth; ++j)
    for (const int node : mesh.bore_node) number[whole.node(j, node)] = -1;
  int count = 0;
  for (int& n : number)
    if (n == 0) n = count++;
  const ToothGeometry tooth(design);
  const Eigen::Vector2d flank(tooth.tip_roll_angle() * 0.75 + tooth.form_roll_angle() * 0.25,
                              tooth.tip_roll_angle());
  for (const double helix : {0.0, 9.0}) {
    const int degree = helix == 0 ? 1 : 2, all = degree + 1;
    const SectionSystem s =
        assemble_section(whole.node_position, whole.element_node, kSteel, helix, number, count);
    std::vector<Eigen::Triplet<double>> entries;
    for (int b = 0; b < 3 * count; ++b)
      for (int at = s.k00.outerIndexPtr()[b]; at < s.k00.outerIndexPtr()[b + 1]; ++at)
        for (int i = 0; i < all; ++i)
          for (int j = 0; j < all; ++j)
            entries.emplace_back(s.k00.innerIndexPtr()[at] * all + i, b * all + j,
                                 (i == j ? s.k00.valuePtr()[at] : 0) +
                                     value_times_slope(i, j, kWidth) * s.k01.valuePtr()[at] +
                                     value_times_slope(j, i, kWidth) * s.k10.valuePtr()[at] +
                                     slope_times_slope(i, j, kWidth) * s.k11.valuePtr()[at]);
    SparseReal k(3 * count * all, 3 * count * all);
    k.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<SparseReal> factor(k);
    REQUIRE(factor.info() == Eigen::Success);
    const SparseReal normal = inward_normal(mesh, helix, flank);
    const auto on_tooth = [&](int t) {
      const double angle = pitch * t;
      Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3 * count * all, 2 * all);
      for (int p = 0; p < 2; ++p)
        for (SparseReal::InnerIterator it(normal, p); it; ++it) {
          const int n = 3 * number[whole.node(t, it.row() / 3)], c = static_cast<int>(it.row() % 3);
          const double x[2][2] = {{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
          for (int j = 0; j < all; ++j) {
            if (c == 2) force((n + 2) * all + j, p * all + j) += it.value();
            if (c < 2)
              for (int d = 0; d < 2; ++d) force((n + d) * all + j, p * all + j) += x[c][d] * it.value();
          }
        }
      return force;
    };
    const Eigen::MatrixXd u = factor.solve(on_tooth(0));
    const auto tables = width_flexibility(mesh, kSteel, helix, degree, {normal, {}}, 2);
    for (int t = 0; t <= 2; ++t) {
      const Eigen::MatrixXd expected = on_tooth(t).transpose() * u;
      CHECK((tables[static_cast<size_t>(t)] - expected).norm() < 1e-10 * expected.norm());
    }
    CHECK((tables[0] - tables[0].transpose()).norm() < 1e-13 * tables[0].norm());
  }
}

TEST_CASE(
    "The flexibility of a gear goes over into that of a spur gear, and that of the other hand is its image") {
  const GearDesign design = gear(0);
  const SectorGrid mesh = section(design, 1, 1);
  const ToothGeometry tooth(design);
  const FlankTable flank(tooth, 5);
  const auto tables = [&](double helix) {
    return make_width_tables(mesh, kSteel, helix, 4, flank.points(), 1).flexibility;
  };
  const auto spur = tables(0), near = tables(1e-4), right = tables(4.5), left = tables(-4.5);
  for (size_t d = 0; d < 2; ++d) {
    const double size = spur[d].norm();
    CHECK((near[d] - spur[d]).norm() < 1e-4 * size);
    CHECK((near[d] - spur[d]).norm() > 1e-9 * size);
    CHECK((right[d] - spur[d]).norm() > 1e-2 * size);
    MatrixRM image = right[d];
    double uneven = 0;
    for (int a = 0; a < image.rows(); ++a)
      for (int b = 0; b < image.cols(); ++b) {
        if ((a % 5 + b % 5) % 2 == 0) continue;
        uneven = std::max(uneven, std::abs(spur[d](a, b)));
        image(a, b) = -image(a, b);
      }
    CHECK(uneven == 0);
    CHECK((image - left[d]).norm() < 1e-10 * size);
  }
  // A body of degree 0 is the plane one, to rounding.
  CHECK(make_width_tables(mesh, kSteel, 0, 0, flank.points(), 0).flexibility[0].norm() <
        1e-13 * spur[1].norm());
}

TEST_CASE(
    "The difference kernel of a helical gear does not depend on the mesh of its section: the plane part counts cos beta") {
  const GearDesign design = gear(20 * kPi / 180);
  const ToothGeometry tooth(design);
  const double pitch = tooth.roll_angle_at_radius(tooth.pitch_radius()),
               helix = std::tan(20 * kPi / 180) / tooth.pitch_radius();
  const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, pitch);
  CHECK(plane_share(tooth.base_radius(), helix, at)[0] == relative(std::cos(20 * kPi / 180), 1e-12));
  CHECK(plane_share(tooth.base_radius(), 0, at)[0] == 1);
  std::array<double, 2> whole{}, difference{};
  for (size_t k = 0; k < 2; ++k) {
    const SectorGrid mesh = section(design, k ? 0.3 : 1);
    whole[k] =
        width_flexibility(mesh, kSteel, helix, 4, {inward_normal(mesh, helix, at), {}}, 0)[0](4, 4) / kScale;
    difference[k] = make_width_tables(mesh, kSteel, helix, 4, at, 0).flexibility[0](4, 4) / kScale;
  }
  CHECK(std::abs(whole[1] - whole[0]) > 1.5);
  CHECK(std::abs(difference[1] - difference[0]) < 0.08);  // 0.25 % of the plane part
}

TEST_CASE(
    "A spur gear of 50 teeth has the printed difference kernel and neighbours, within 0.06 % of the plane flexibility") {
  const GearDesign design = gear(0);
  const ToothGeometry tooth(design);
  const double pitch = tooth.roll_angle_at_radius(tooth.pitch_radius()), mm = 1e-3 / tooth.base_radius();
  Eigen::Vector3d place(pitch - 3 * mm, pitch, pitch + 4 * mm);
  const WidthTables tables = make_width_tables(section(design, 0.3), kSteel, 0, 8, place, 2);
  struct Printed {
    int offset, read, load;
    double plane, d00, d11, d22, d02, d20, d44;
  };
  constexpr int kRoot = 0, kPitch = 1, kTip = 2;
  // Offsets: dC less the printed plane flexibility.
  const std::array<Printed, 9> printed{
      {{0, kPitch, kPitch, 36.624, 1.28010, -9.69591, -17.2848, -0.03063, -0.03063, -23.0383},
       {0, kTip, kTip, 45.464, 1.91110, -13.4095, -25.4894, -0.32942, -0.32942, -34.139},
       {0, kRoot, kRoot, 28.796, 1.01103, -8.15864, -13.8258, 0.06051, 0.06051, -18.284},
       {0, kPitch, kTip, 28.4803, 1.44000, -11.3395, -20.5015, -0.12751, -0.54072, -26.625},
       {0, kPitch, kRoot, 22.2546, 1.07140, -8.92055, -15.3307, -0.17253, -0.00930, -19.927},
       {0, kTip, kRoot, 22.9254, 1.17575, -10.0830, -17.4066, -0.61591, -0.07551, -21.971},
       {1, kPitch, kPitch, 7.59314, 0.30831, -6.09242, -7.53547, 0.00617, 0.00287, -7.5905},
       {1, kTip, kTip, 7.13974, 0.29221, -5.89360, -7.12885, 0.00510, 0.02715, -7.1394},
       {2, kPitch, kPitch, 5.93005, 0.11055, -5.27969, -5.93490, 0.01342, 0.03840, -5.9298}}};
  for (const Printed& p : printed) {
    const auto value = [&](int i, int j) {
      return tables.flexibility[static_cast<size_t>(p.offset)](p.read * 9 + i, p.load * 9 + j) / kScale -
             (p.offset > 0 && i == j ? p.plane : 0);
    };
    const double allowed = (p.offset == 0 ? 6e-4 : 1e-3) * p.plane;
    CAPTURE(p.offset);
    CAPTURE(p.read);
    CAPTURE(p.load);
    CHECK(std::abs(value(0, 0) - p.d00) < allowed);
    CHECK(std::abs(value(1, 1) - p.d11) < allowed);
    CHECK(std::abs(value(2, 2) - p.d22) < allowed);
    CHECK(std::abs(value(0, 2) - p.d02) < allowed);
    CHECK(std::abs(value(2, 0) - p.d20) < allowed);
    CHECK(std::abs(value(4, 4) - p.d44) < allowed);
  }
  const auto inner = [&](int i, int j) {
    return tables.flexibility[0](kPitch * 9 + i, kPitch * 9 + j) / kScale;
  };
  for (const auto& [value, expected] :
       {std::pair{inner(1, 3), -0.24816}, {inner(2, 4), -0.55712}, {inner(0, 4), 0.10841}})
    CHECK(std::abs(value - expected) < 0.02);
  // The last two terms on the diagonal; the mesh moves them by 0.4 %.
  CHECK(inner(7, 7) == relative(-26.07, 1e-2));
  CHECK(inner(8, 8) == relative(-26.73, 1e-2));
}

namespace {

// Inward displacement (um) 1.5 mm below the flank at five places over the width, on the pitch helix and below the contact line, under 100 N/mm
// on the contact line through the pitch point, and under 100 (1 + z / 10 mm) N/mm.
struct Fields {
  std::array<double, 5> pitch_helix, below_line;
};
std::array<Fields, 2> fields_below(double beta, double modules) {
  const GearDesign design = gear(beta);
  const SectorGrid mesh = section(design, modules);
  const ToothGeometry tooth(design);
  const double helix = std::tan(beta) / tooth.pitch_radius(), axial = -helix * tooth.base_radius(),
               length = std::hypot(1, axial);
  const double pitch = tooth.roll_angle_at_radius(tooth.pitch_radius());
  constexpr std::array<double, 5> kPlace{-10e-3, -6e-3, 0, 6e-3, 10e-3};
  const FlankTable flank(tooth, 16);
  const int points = flank.size(), degree = 8, all = degree + 1;
  Eigen::VectorXd at(6);
  at[0] = pitch;
  for (int i = 0; i < 5; ++i) at[i + 1] = pitch + helix * kPlace[static_cast<size_t>(i)];
  const SparseReal below = FlankReader(mesh).outward_below(at, 1.5e-3),
                   normal = inward_normal(mesh, helix, flank.points());
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < points; ++k)
    for (SparseReal::InnerIterator it(normal, k); it; ++it) entries.emplace_back(it.row(), k, it.value());
  for (int column = 0; column < below.outerSize(); ++column)
    for (SparseReal::InnerIterator it(below, column); it; ++it) {
      const int k = static_cast<int>(it.row()), node = column / 2, c = column % 2;
      entries.emplace_back(3 * node + c, points + k, -it.value() / length);
      if (c == 0 && helix != 0)
        entries.emplace_back(3 * node + 2, points + k,
                             -it.value() / tooth.flank_normal(at[k]).x() * axial / length);
    }
  SparseReal functional(3 * mesh.node_position.rows(), points + 6);
  functional.setFromTriplets(entries.begin(), entries.end());
  const MatrixRM table = width_flexibility(mesh, kSteel, helix, degree, {functional, {}}, 0)[0];
  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(table.cols(), 2);
  const GaussRule rule = gauss_rule(24);
  for (Eigen::Index g = 0; g < rule.point.size(); ++g) {
    const double z = 0.5 * kWidth * rule.point[g], force = 100e3 * 0.5 * kWidth * rule.weight[g];
    const Eigen::RowVectorXd weights = flank.weights(pitch + helix * z);
    const Eigen::VectorXd over = face_polynomials(z, kWidth, degree);
    for (int p = 0; p < points; ++p)
      load.middleRows(p * all, all) += weights[p] * force * over * Eigen::RowVector2d(1, 1 + z / 10e-3);
  }
  const Eigen::MatrixXd u = 1e6 * (table * load);
  std::array<Fields, 2> result{};
  for (size_t i = 0; i < 5; ++i) {
    const Eigen::VectorXd p = face_polynomials(kPlace[i], kWidth, degree);
    for (int k = 0; k < 2; ++k) {
      const auto read = [&](int point) { return p.dot(u.col(k).segment((points + point) * all, all)); };
      result[static_cast<size_t>(k)].pitch_helix[i] = read(0);
      result[static_cast<size_t>(k)].below_line[i] = read(1 + static_cast<int>(i));
    }
  }
  return result;
}

double largest_difference(const std::array<double, 5>& a, const std::array<double, 5>& b) {
  double difference = 0;
  for (size_t i = 0; i < 5; ++i) difference = std::max(difference, std::abs(a[i] - b[i]));
  return difference / b[4];
}

}  // namespace

TEST_CASE(
    "Below the flank of a spur gear the displacement over the width is that of CalculiX, even and tilted load") {
  // Finest mesh, C3D20R, whole gear; 0.05 % more for its straight-sided far teeth.
  const std::array<double, 5> even{2.64713, 2.66552, 2.67874, 2.66552, 2.64713},
      tilted{1.12471, 1.69807, 2.67874, 3.63297, 4.16956};
  const std::array<Fields, 2> fields = fields_below(0, 0.3);
  CHECK(largest_difference(fields[0].pitch_helix, even) < 2e-3);
  CHECK(largest_difference(fields[1].pitch_helix, tilted) < 2e-3);
}

TEST_CASE(
    "Below the flank of a helical gear the displacement over the width is that of an independent program") {
  const Fields fields = fields_below(20 * kPi / 180, 0.3)[0];
  CHECK(largest_difference(fields.pitch_helix, {2.1544, 2.7234, 3.2460, 3.6616, 4.0875}) < 3e-3);
  CHECK(largest_difference(fields.below_line, {2.0095, 2.6212, 3.2460, 4.0882, 5.2002}) < 3e-3);
}

TEST_CASE(
    "Under a uniform strain the stress across the helix at the root is that in closed form, and a turn has none") {
  Material steel = kSteel;
  steel.plane_stress = false;
  for (const double helix : {0.0, 4.56, 20.0}) {
    CAPTURE(helix);
    const SectorGrid mesh = section(gear(0), 0.5);
    const FaceFunctional root = RootReader(mesh, steel, Roots::driving).over_face(helix);
    const RootPoints points = root_points(ToothGeometry(mesh.design));
    // A round bar pulled by E: contraction nu in the section, the same in axes that turn, and u_z = z.
    Eigen::VectorXd constant = Eigen::VectorXd::Zero(root.value.rows()), linear = constant, turn = constant;
    for (Eigen::Index n = 0; n < mesh.node_position.rows(); ++n) {
      const Vec2 at = mesh.node_position.row(n);
      constant.segment<2>(3 * n) = -steel.poisson_ratio * at;
      linear[3 * n + 2] = 1;
      turn.segment<2>(3 * n) = Vec2(-at.y(), at.x());
    }
    // Coefficients of 1 and z: sqrt(b) P_0 and sqrt(b^3 / 12) P_1.
    const double one = std::sqrt(kWidth), z = std::sqrt(kWidth * kWidth * kWidth / 12);
    const Eigen::VectorXd stress = (root.value.transpose() * constant * one +
                                    value_times_slope(0, 1, kWidth) * z * (root.slope.transpose() * linear)) /
                                   one;
    for (Eigen::Index i = 0; i < points.angle.size(); ++i) {
      const double step = 1e-5, s = points.parameter[i];
      const ToothGeometry tooth(mesh.design);
      const Vec2 at = tooth.root_point(s),
                 d = tooth.root_point(std::min(1.0, s + step)) - tooth.root_point(s - step);
      const Vec2 t = d.normalized();
      // p = (t - m / l h) / |...|; strains -nu in the section and 1 along the axis, read as on a free surface; the fit along
      // the root is of degree 8.
      const double l = 1 + helix * helix * at.squaredNorm(), m = helix * (at.x() * t.y() - at.y() * t.x()),
                   axial = m / l / std::sqrt(1 - m * m / l);
      const double nu = steel.poisson_ratio, across = (1 + nu) * axial * axial - nu,
                   along = (1 + nu) / l - nu;
      CHECK(std::abs(stress[i] - steel.youngs_modulus / (1 - nu * nu) * (across + nu * along)) <
            6e-3 * steel.youngs_modulus);
    }
    CHECK((root.value.transpose() * turn).cwiseAbs().maxCoeff() < 1e-9 * steel.youngs_modulus);
  }
}

TEST_CASE(
    "Root stress over the width: of degree 0 the plane sector's, of a wide face in the middle as well, of the other hand the image") {
  GearDesign design = gear(0);
  Material steel = kSteel;
  steel.plane_stress = false;
  const SectorGrid mesh = section(design, 0.25);
  const FlankTable flank(ToothGeometry(design), 8);
  SectorGrid whole = mesh;
  whole.discretisation.flank_points = 8;
  const ReducedBody plane = reduce(whole, steel, 1);
  const WidthTables flat = make_width_tables(mesh, steel, 0, 0, flank.points(), plane.offsets);
  REQUIRE(flat.root_stress.size() == plane.root_stress.size());
  // Per force on the whole face in place of per force on its unit; the near field alone is found otherwise.
  for (size_t k = 0; k < flat.root_stress.size(); ++k) {
    CAPTURE(k);
    const MatrixRM own = plane.root_stress[k].topRows(flat.root_stress[k].rows()) * kWidth;
    const double off =
        (flat.root_stress[k] - own).rightCols(4).cwiseAbs().maxCoeff() / own.cwiseAbs().maxCoeff();
    MESSAGE("offset ", static_cast<int>(k) - plane.offsets, ": root stress off by ", off);
    CHECK(off < 5e-3);
  }
  // Saint-Venant: far from the ends of a face of 40 modules under an even load.
  design.face_width = 120e-3;
  const SectorGrid wide = section(design, 1, 1);
  const auto largest = [&](int degree, double place) {
    const WidthTables tables = make_width_tables(wide, steel, 0, degree, flank.points().segment(6, 1), 0);
    const Eigen::VectorXd p = face_polynomials(place * design.face_width, design.face_width, degree);
    double most = 0;
    for (Eigen::Index i = 0; i < kRootPoints; ++i)
      most = std::max(most, p.dot(tables.root_stress[0].block(i * (degree + 1), 0, degree + 1, 1).col(0)) *
                                std::sqrt(design.face_width));
    return most;
  };
  const double strain = largest(0, 0), middle = largest(16, 0), end = largest(16, 0.5),
               rough = largest(12, 0.5);
  MESSAGE("middle over plane strain ", middle / strain, ", end ", end / strain, ", of degree 12 ",
          rough / strain);
  CHECK(middle == relative(strain, 1e-2));
  CHECK(end < 0.8 * strain);
  CHECK(end == relative(rough, 5e-2));
  // Coefficient i under polynomial j changes its sign with i + j in the mirror.
  const SectorGrid coarse = section(gear(0), 1, 1);
  const auto hand = [&](double helix) {
    return make_width_tables(coarse, steel, helix, 3, flank.points(), 1).root_stress;
  };
  const auto right = hand(4.5), left = hand(-4.5);
  for (size_t k = 0; k < right.size(); ++k) {
    MatrixRM image = right[k];
    for (Eigen::Index a = 0; a < image.rows(); ++a)
      for (Eigen::Index b = 0; b < image.cols(); ++b)
        if ((a % 4 + b % 4) % 2 == 1) image(a, b) = -image(a, b);
    CHECK((image - left[k]).norm() < 1e-9 * left[k].norm());
  }
}

TEST_CASE("The kernel of a body interpolates its tables and completes them") {
  const GearDesign design = gear(0);
  const ToothGeometry tooth(design);
  const FlankTable flank(tooth, 6);
  const int degree = 3, all = degree + 1;
  const WidthTables tables = make_width_tables(section(design, 1, 1), kSteel, 4.5, degree, flank.points(), 2);
  const WidthKernel kernel(tooth, tables);
  const double a = flank.points()[1], b = flank.points()[4];
  CHECK((kernel.coupling(a, b, 0) - tables.flexibility[0].block(all, 4 * all, all, all)).norm() <
        1e-12 * tables.flexibility[0].norm());
  CHECK((kernel.coupling(a, b, 1) - tables.flexibility[1].block(all, 4 * all, all, all)).norm() <
        1e-12 * tables.flexibility[1].norm());
  // Reciprocity: tooth -1 read under a load on 0 is tooth 0 read under a load on 1.
  CHECK((kernel.coupling(a, b, -1) - kernel.coupling(b, a, 1).transpose()).norm() <
        1e-12 * tables.flexibility[1].norm());
  const Eigen::MatrixXd own = kernel.coupling(a, a, 0);
  CHECK(kernel.completion(a, a) == relative(0.5 * (own(3, 3) + own(2, 2)), 1e-12));
  // Two points of a helical line, by functionals: sum of P_i (dC_ij - delta_ij c) P_j.
  const double x = 0.3 * a + 0.7 * b, z = 4e-3;
  const Eigen::VectorXd here = kernel.point(x, z), there = kernel.point(b, -z);
  const Eigen::VectorXd p = face_polynomials(z, kWidth, degree), q = face_polynomials(-z, kWidth, degree);
  const double expected = p.dot(kernel.coupling(x, b, 0) * q) - kernel.completion(x, b) * p.dot(q);
  CHECK(kernel.between(here, there, 0)(0, 0) == relative(expected, 1e-10));
  CHECK(refused([&] { kernel.coupling(a, b, 3); }, Failure::input, {2, 3}));
  GearDesign other = design;
  other.addendum = 0.9;
  CHECK(refused([&] { WidthKernel(ToothGeometry(other), tables); }, Failure::input,
                {6, 3, "not of this tooth"}));
  CHECK(refused([&] { make_width_tables(section(design, 1, 1), kSteel, 0, 25, flank.points(), 0); },
                Failure::input, {"degree", 25, "0 to 24"}));
}

TEST_CASE("A body with width_degree holds its tables over the face width, and all else as the plane body") {
  GearDesign design = gear(0);
  design.teeth = 20;
  design.bore_radius = 15e-3;
  SectorGrid mesh = section(design, 1, 1);
  Material steel = kSteel;
  const WidthDiscretisation width{3, 3e-3};
  mesh.discretisation.width = width;
  CHECK(refused([&] { reduce(mesh, steel, 1); }, Failure::input, {"width_degree", 3, "plane", "strain"}));
  steel.plane_stress = false;
  const ReducedBody body = reduce(mesh, steel, 1);
  mesh.discretisation.width = {};
  const ReducedBody plane = reduce(mesh, steel, 1);
  CHECK(plane.width.flexibility.empty());
  for (int d = 0; d <= kOffsets; ++d)
    CHECK(body.compliance[static_cast<size_t>(d)] == plane.compliance[static_cast<size_t>(d)]);
  REQUIRE(body.width.flexibility.size() == kOffsets + 1);
  // A load that is even over the face bends a tooth on a rim that gives way more than in plane strain.
  const WidthKernel kernel(ToothGeometry(design), body.width);
  const double middle = body.flank_position[body.flank_position.size() / 2];
  CHECK(kernel.coupling(middle, middle, 0)(0, 0) > 0);

  const TemporaryFolder folder;
  write(folder / "body.h5", body, {"test", "test", {}});
  write(folder / "plane.h5", plane, {"test", "test", {}});
  const ReducedBody back = read<ReducedBody>(folder / "body.h5");
  CHECK(back.width.degree == 3);
  CHECK(back.width.face_width == kWidth);
  CHECK(back.width.flank_position == body.width.flank_position);
  CHECK(back.width.flexibility == body.width.flexibility);
  CHECK(back.discretisation.width.section_size == 3e-3);
  CHECK(read<ReducedBody>(folder / "plane.h5").width.flexibility.empty());
  CHECK(body_hash(body_parameters({back.design, back.material, back.discretisation})) ==
        body_hash(body_parameters({body.design, body.material, body.discretisation})));
}

TEST_CASE("The degree over the face width is a key of a scene that plane bodies say nothing of") {
  const SceneFile file;
  const std::string plane = body_parameters(file.read(kScene), "pinion");
  CHECK(plane.find("width") == plane.find("face_width") + 5);
  CHECK(body_parameters(file.read(with_section("[discretisation]\nsection_element_mm = 2")), "pinion") ==
        plane);
  const Scene scene = file.read(with_section("[discretisation]\nwidth_degree = 8"));
  const std::string text = body_parameters(scene, "pinion");
  const BodyParameters back = read_body_parameters(file.path(text, "body.toml"));
  CHECK(back.discretisation.width.degree == 8);
  CHECK(back.discretisation.width.section_size == relative(1e-3, 1e-12));
  CHECK(body_parameters(back) == text);
  CHECK(names(file.rejection(with_section("[discretisation]\nwidth_degree = 25")), {"width_degree", 25, 24}));
}
