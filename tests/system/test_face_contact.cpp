// A pair in slices over the face: closed forms of independent slices, identities of elastic gears, convergence in the number of points.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "gear/face_width.h"
#include "own_folder.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "system/face_contact.h"
#include "system/statics.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kOneDegreeOfFace = std::numbers::pi / 180;

// A gear of P2000's rack with a helix.
GearDesign gear_with_helix(double beta, Hand hand, double width) {
  GearDesign d = paper_gear();
  d.helix_angle = beta * kOneDegreeOfFace;
  d.hand = hand;
  d.face_width = width;
  return d;
}

GearPair pair_with_helix(double beta, double width) {
  return {gear_with_helix(beta, Hand::right, width), gear_with_helix(beta, Hand::left, width),
          0.150 / std::cos(beta * kOneDegreeOfFace)};
}

// Points on springs of c N m-1 per m of face, one beside the other; stiffness(path).
Equilibrium on_springs(const GearPair& pair, const FacePoints& points, const auto& stiffness, double load) {
  MatrixXd a = MatrixXd::Zero(points.size(), points.size());
  for (int q = 0; q < points.size(); ++q) a(q, q) = 1 / (stiffness(points.path[q]) * points.weight[q]);
  ActiveSet active;
  ComplementaritySolver solver;
  const VectorXd approach = VectorXd::Constant(points.size(), std::cos(pair.base_helix_angle()));
  return equilibrium(a, points.gap, approach, load, 0, active, solver);
}

struct Spread {
  double factor, share;  // K_Hbeta; length of face that carries over b
};

// One line of a spur pair of 20 mm on even springs.
Spread one_line(const GearMeshSpec& mesh, int n, double load, double c) {
  const GearPair pair = pair_with_helix(0, 20e-3);
  const std::vector<ContactLine> line{{0, -10e-3, 10e-3}};
  const FacePoints points = face_points(pair, FaceGap(pair, mesh), line, 0, gauss_rule(n));
  const Equilibrium e = on_springs(
      pair, points, [&](double) { return c; }, load);
  double carrying = 0;
  for (int q = 0; q < points.size(); ++q) carrying += e.p[q] > 0 ? points.weight[q] : 0;
  return {face_load_factor(points.z, points.weight, e.p.array() / points.weight.array(), line[0]),
          carrying / 20e-3};
}

// m: transmission error of helical lines on springs at `positions` phases; c(s) N m-2 of a pair.
VectorXd error_on_springs(const GearPair& pair, const GearMeshSpec& mesh, int n, double load, int positions,
                          const auto& stiffness) {
  VectorXd out(positions);
  for (int i = 0; i < positions; ++i) {
    const double phase = static_cast<double>(i) / positions;
    const FacePoints points =
        face_points(pair, FaceGap(pair, mesh), contact_lines(pair, phase), phase, gauss_rule(n));
    out[i] = on_springs(pair, points, stiffness, load).x;
  }
  return out;
}

double peak_to_peak(const VectorXd& x) {
  return x.maxCoeff() - x.minCoeff();
}

// m: root mean square of the harmonics from `first` on.
double high_harmonics(const VectorXd& x, int first) {
  const Harmonics h = harmonics(x, static_cast<int>(x.size() / 2 - 1));
  return std::sqrt(0.5 * h.amplitude.tail(h.amplitude.size() - (first - 1)).squaredNorm());
}

// Of the section; of degree > 0 in three dimensions.
const ReducedBody& strained_body(const GearDesign& design, int degree = 0, double section = 1e-3) {
  BodyDiscretisation coarse;
  coarse.element_size = 1e-3;
  coarse.modes = 1;
  if (degree > 0) coarse.width = {degree, section};
  Material steel = paper_steel();
  steel.plane_stress = false;
  return kept_body(design, steel, coarse);
}

const ReducedBody& helical_body(Hand hand, double beta = 20) {
  return strained_body(gear_with_helix(beta, hand, 20e-3));
}

StaticParameters slices(int positions, int points, double distance = 0.150) {
  StaticParameters settings = paper_statics(positions);
  settings.mesh.centre_distance = distance;
  settings.fidelity.width = WidthModel::slices;
  settings.fidelity.contact = ContactModel::line;
  settings.contact.face_points = points;
  return settings;
}

const double kHelicalDistance = 0.150 / std::cos(20 * kOneDegreeOfFace);

}  // namespace

TEST_CASE(
    "K_Hbeta of bodies: a cubic over the loaded part of a face is carried to its end, a ripple hardly is") {
  const GaussRule rule = gauss_rule(12);
  const double half = 10e-3;
  const ContactLine line{0, -half, half};
  const VectorXd z = half * rule.point, weight = half * rule.weight;
  const auto factor = [&](const auto& load) {
    VectorXd w(z.size());
    for (Index i = 0; i < z.size(); ++i) w[i] = load(z[i] / half);
    return face_load_factor(z, weight, w, line, kInnerFace);
  };
  // Means of 100 and 105.
  CHECK(factor([](double t) { return 100 - 50 * t; }) == relative(1.5, 1e-12));
  CHECK(factor([](double t) { return 100 - 30 * t + 15 * t * t - 20 * t * t * t; }) ==
        relative(165.0 / 105, 1e-12));
  // The end without load does not count, and the load at the very end is not read.
  const auto part = [](double t) { return std::max(0.0, 60 - 100 * t); };
  double mean = 0;
  for (Index i = 0; i < z.size(); ++i) mean += 0.5 * rule.weight[i] * part(rule.point[i]);
  CHECK(factor(part) == relative(160 / mean, 1e-12));
  CHECK(factor([](double t) { return t < -0.9 ? 90 - 50 * t : 100 - 50 * t; }) == relative(1.5, 0.02));
  // A ripple of 1 % at the end of the inner part.
  const auto rippled = [](double t) { return 100 - 50 * t + 1.4 * std::cos(12 * (t + 0.8)); };
  CHECK(factor(rippled) == relative(1.5, 0.01));
}

TEST_CASE("independent slices under misalignment: K = 1 + q, then 2 sqrt(q) with the share 1 / sqrt(q)") {
  const double load = 2000, c = 14e9, b = 20e-3;
  for (const double q : {0.2, 0.7, 1.0}) {
    GearMeshSpec mesh;
    mesh.misalignment = q * 2 * load / (c * b);
    CHECK(one_line(mesh, 8, load, c).factor == relative(1 + q, 1e-9));
  }
  for (const double q : {2.0, 4.0}) {
    GearMeshSpec mesh;
    mesh.misalignment = q * 2 * load / (c * b);
    const Spread coarse = one_line(mesh, 12, load, c), fine = one_line(mesh, 64, load, c);
    MESSAGE("q " << q << ": K " << coarse.factor << " of 12 points, " << fine.factor << " of 64, exact "
                 << 2 * std::sqrt(q) << "; share " << fine.share << ", exact " << 1 / std::sqrt(q));
    CHECK(coarse.factor == relative(2 * std::sqrt(q), 0.05));
    CHECK(fine.factor == relative(2 * std::sqrt(q), 2e-3));
    CHECK(fine.share == relative(1 / std::sqrt(q), 0.03));
  }
}

TEST_CASE("independent slices with a crown: K = 1 + r / 3, then 1.5 (r / 1.5)^(1/3)") {
  const double load = 2000, c = 14e9, b = 20e-3;
  for (const double r : {0.6, 1.4, 3.0, 6.0}) {
    GearMeshSpec mesh;
    mesh.modification[0].lead.crowning = r * load / (c * b);
    const double exact = r <= 1.5 ? 1 + r / 3 : 1.5 * std::cbrt(r / 1.5);
    const Spread fine = one_line(mesh, 64, load, c);
    MESSAGE("r " << r << ": K " << fine.factor << ", exact " << exact << "; share " << fine.share);
    // The largest is in the middle, between two points.
    CHECK(fine.factor == relative(exact, 2e-3));
    CHECK(fine.share == relative(std::min(1.0, std::cbrt(1.5 / r)), 0.03));
  }
}

TEST_CASE(
    "even springs: the transmission error is F / (c cos^2 beta_b L cos beta_b), and still at a whole overlap") {
  const double load = 2000, c = 14e9, beta = 20;
  for (const double overlap : {0.5, 1.0, 2.0}) {
    const GearPair pair =
        pair_with_helix(beta, overlap * std::numbers::pi * 3e-3 / std::sin(beta * kOneDegreeOfFace));
    const VectorXd x = error_on_springs(pair, {}, 8, load, 64, [&](double) { return c; });
    const double cosine = std::cos(pair.base_helix_angle());
    for (int i = 0; i < 64; ++i)
      CHECK(x[i] ==
            relative(load / (c * cosine * cosine * cosine * contact_line_length(pair, i / 64.0)), 1e-9));
    if (overlap >= 1) CHECK(peak_to_peak(x) < 1e-9 * x.mean());
  }
}

TEST_CASE("springs that soften to the tips: peak to peak and high harmonics over the number of points") {
  // c(s) = 14e3 (1 - 0.3 (s / s_tip)^2) N/mm per mm; 2000 N along the normal; lines end at the tips.
  const GearPair pair = pair_with_helix(20, 20e-3);
  CHECK(pair.contact_ratio() == relative(1.6015, 1e-4));
  CHECK(pair.overlap_ratio() == relative(0.7258, 1e-4));
  const double cosine = std::cos(pair.base_helix_angle()), load = 2000 * cosine;
  const auto c = [&](double s) { return 14e9 * (1 - 0.3 * std::pow(s / pair.path_end(), 2)); };
  struct Case {
    double crown, lead, peak, high, off_8,
        off_12;  // um, um, um, nm; relative errors of the table, with what positions add
  };
  for (const Case& own : {Case{0, 0, 0.97061, 6.9, 1e-4, 1e-4}, Case{4, 0, 1.4261, 3.3, 1e-3, 1e-4},
                          Case{4, 10, 2.2579, 8.1, 0.012, 0.006}}) {
    GearMeshSpec mesh;
    mesh.modification[0].lead.crowning = own.crown * 1e-6;
    mesh.misalignment = own.lead * 1e-6;
    // Along the normal.
    const auto error = [&](int n) {
      return VectorXd(cosine * error_on_springs(pair, mesh, n, load, 256, c));
    };
    const VectorXd exact = error(48), eight = error(8), twelve = error(12);
    const double peak = peak_to_peak(exact);
    MESSAGE("crown " << own.crown << ", lead " << own.lead << " um: peak to peak " << peak * 1e6
                     << " (printed " << own.peak << ") um, harmonics from 8 on "
                     << high_harmonics(exact, 8) * 1e9 << " (printed " << own.high
                     << ") nm; 8 points: off by " << (eight - exact).cwiseAbs().maxCoeff() / peak << ", "
                     << high_harmonics(eight, 8) * 1e9 << " nm; 12 points: off by "
                     << (twelve - exact).cwiseAbs().maxCoeff() / peak << ", "
                     << high_harmonics(twelve, 8) * 1e9 << " nm");
    CHECK(peak * 1e6 == relative(own.peak, 2e-3));
    CHECK((eight - exact).cwiseAbs().maxCoeff() < own.off_8 * peak);
    CHECK((twelve - exact).cwiseAbs().maxCoeff() < own.off_12 * peak);
    CHECK(high_harmonics(eight, 8) == relative(high_harmonics(exact, 8), 0.12));
  }
}

TEST_CASE("points of a spur pair under even load are one slice, whatever their number") {
  StaticParameters one = paper_statics(24);
  one.fidelity.contact = ContactModel::line;
  const StaticResult whole = static_transmission(paper_body(), paper_body(), one, 150);
  for (const int n : {2, 5, 8}) {
    const StaticResult cut = static_transmission(paper_body(), paper_body(), slices(24, n), 150);
    REQUIRE(cut.pair.size() == whole.pair.size());
    const double off = (cut.transmission_error - whole.transmission_error).cwiseAbs().maxCoeff() /
                       whole.transmission_error.mean(),
                 loads =
                     (cut.tooth_load - whole.tooth_load).cwiseAbs().maxCoeff() / whole.tooth_load.maxCoeff();
    MESSAGE(n << " points: transmission error off by " << off << ", loads by " << loads << ", K_Hbeta - 1 "
              << cut.face.load_factor - 1);
    CHECK(off < 1e-9);
    CHECK(loads < 1e-8);
    CHECK(cut.face.load_factor == relative(1, 1e-8));
    CHECK(cut.stiffness_tangent[0] == relative(whole.stiffness_tangent[0], 1e-6));
    CHECK(cut.loss_factor == relative(whole.loss_factor, 1e-6));
    CHECK(cut.compliance.contact == whole.compliance.contact);
  }
}

TEST_CASE("a spur pair in one slice has the bits of the plane body, on bodies in three dimensions too") {
  const GearDesign design = gear_with_helix(0, Hand::right, 20e-3);
  const ReducedBody &plane = strained_body(design), &wide = strained_body(design, 4, 3e-3);
  StaticParameters settings = paper_statics(24);
  for (const ContactModel contact : {ContactModel::strips, ContactModel::line}) {
    settings.fidelity.contact = contact;
    const StaticResult a = static_transmission(wide, wide, settings, 150),
                       b = static_transmission(plane, plane, settings, 150);
    CHECK(a.transmission_error == b.transmission_error);
    CHECK(a.tooth_load == b.tooth_load);
    CHECK(a.stiffness_tangent == b.stiffness_tangent);
    CHECK(a.contact_half_width == b.contact_half_width);
    // One point over the face is that slice, but for the order of a sum.
    if (contact == ContactModel::line)
      CHECK((static_transmission(plane, plane, slices(24, 1), 150).transmission_error - b.transmission_error)
                .cwiseAbs()
                .maxCoeff() < 1e-14 * b.transmission_error.mean());
  }
}

TEST_CASE("a helical pair: equilibrium, axial force, certificate; the other hand is its mirror image") {
  StaticParameters settings = slices(16, 8, kHelicalDistance);
  settings.mesh.modification[0].lead.crowning = 3e-6;
  settings.mesh.misalignment = 4e-6;
  const StaticResult right =
      static_transmission(helical_body(Hand::right), helical_body(Hand::left), settings, 150);
  settings.mesh.misalignment = -4e-6;
  const StaticResult left =
      static_transmission(helical_body(Hand::left), helical_body(Hand::right), settings, 150);
  const GearPair pair(right);
  const HelicalForces force = helical_forces(pair, 150);
  CHECK(right.face.axial_force == relative(force.axial, 1e-12));
  CHECK(left.face.axial_force == relative(-force.axial, 1e-12));
  CHECK(right.least_gap >= -1e-12);
  CHECK(right.torque_residual < 1e-10);
  for (Index i = 0; i < 16; ++i) {
    const auto at = static_cast<size_t>(i);
    CHECK(right.tooth_load.row(i).sum() == relative(force.normal, 1e-10));
    CHECK(left.transmission_error[i] == relative(right.transmission_error[i], 1e-11));
    // Slices in the order of z: mirrored, the order turns round.
    const MatrixRM mirrored = left.face.line_load[at].rowwise().reverse();
    CHECK((mirrored - right.face.line_load[at]).cwiseAbs().maxCoeff() < 1e-8 * right.face.line_load_max);
    const MatrixRM back = -left.face.position[at].rowwise().reverse();
    CHECK((back - right.face.position[at]).cwiseAbs().maxCoeff() < 1e-15);
    CHECK((right.face.line_load[at].cwiseProduct(right.face.width[at])).sum() ==
          relative(force.normal, 1e-10));
  }
}

TEST_CASE("the elastic helical pair: convergence in the number of points") {
  struct Case {
    double crown, lead, off;  // um, um, of the peak to peak with 8 points
  };
  for (const Case& own : {Case{0, 0, 0.01}, Case{4, 0, 0.01}, Case{4, 10, 0.03}}) {
    const auto error = [&](int n) {
      StaticParameters settings = slices(64, n, kHelicalDistance);
      settings.mesh.modification[0].lead.crowning = own.crown * 1e-6;
      settings.mesh.misalignment = own.lead * 1e-6;
      return static_transmission(helical_body(Hand::right), helical_body(Hand::left), settings, 150)
          .transmission_error;
    };
    const VectorXd exact = error(16), eight = error(8), twelve = error(12);
    const double peak = peak_to_peak(exact);
    MESSAGE("crown " << own.crown << ", lead " << own.lead << " um: peak to peak " << peak * 1e6
                     << " um, harmonics from 8 on " << high_harmonics(exact, 8) * 1e9
                     << " nm; 8 points: off by " << (eight - exact).cwiseAbs().maxCoeff() / peak << ", "
                     << high_harmonics(eight, 8) * 1e9 << " nm; 12 points: off by "
                     << (twelve - exact).cwiseAbs().maxCoeff() / peak);
    CHECK((eight - exact).cwiseAbs().maxCoeff() < own.off * peak);
  }
}

TEST_CASE("pressures of a helical pair are of the inner 90 % of face and path, where they have a limit") {
  const auto of = [](int points) {
    return static_transmission(helical_body(Hand::right), helical_body(Hand::left),
                               slices(64, points, kHelicalDistance), 150);
  };
  const StaticResult a = of(8);
  // Hertz's law at the widest contact, whose line load is the largest.
  const double cosine = std::cos(GearPair(a).base_helix_angle());
  CHECK(a.flank_pressure.smooth ==
        relative(2 * a.face.line_load_max * cosine / (std::numbers::pi * a.face.half_width_max), 0.05));
  CHECK(a.flank_pressure.smooth == relative(of(16).flank_pressure.smooth, 0.01));
}

TEST_CASE("a small helix is the spur pair") {
  const auto error = [&](double beta) {
    StaticParameters settings = slices(8, 8, 0.150 / std::cos(beta * kOneDegreeOfFace));
    settings.mesh.corner.enabled = false;
    return static_transmission(helical_body(Hand::right, beta), helical_body(Hand::left, beta), settings, 150)
        .transmission_error;
  };
  const VectorXd spur = error(0), slight = error(0.05);
  // Away from the ends of the path, at which a spur line comes and goes as a whole.
  for (const int i : {0, 2, 4, 6}) CHECK(slight[i] == relative(spur[i], 1e-4));
}

TEST_CASE("points of a spur pair on elastic bearings under even load are one slice there") {
  StaticParameters settings = slices(8, 4);
  settings.mesh.bearing = {Bearing{2e8}, Bearing{1e8}};
  const StaticResult a = static_transmission(paper_body(), paper_body(), settings, 150);
  settings.fidelity.width = WidthModel::one;
  settings.fidelity.contact = ContactModel::line;
  const StaticResult b = static_transmission(paper_body(), paper_body(), settings, 150);
  CHECK((a.transmission_error - b.transmission_error).norm() < 1e-9 * b.transmission_error.norm());
  CHECK((a.bearing_force[1] - b.bearing_force[1]).norm() < 1e-9 * b.bearing_force[1].norm());
}

TEST_CASE("what slices do not take is refused") {
  StaticParameters settings = slices(8, 4);
  settings.mesh.friction.coefficient = 0.05;
  const auto run = [&] { static_transmission(paper_body(), paper_body(), settings, 150); };
  CHECK(refused(run, Failure::input, {"friction"}));
  settings.mesh.friction = {};
  settings.mesh.misalignment = 5e-6;
  settings.fidelity.width = WidthModel::one;
  CHECK(refused(run, Failure::input, {"misalignment_um", 5, "slices"}));
}

namespace {

// P2000's gear with a deep root (140.68 mm), 20 mm wide, in three dimensions of this degree; 0: in plane strain.
const ReducedBody& wide_body(int degree) {
  GearDesign design = paper_gear();
  design.dedendum = (75 - 70.34) / 3;
  design.rack_tip_radius = 0.05;
  design.face_width = 20e-3;
  return strained_body(design, degree);
}

}  // namespace

TEST_CASE(
    "a misaligned spur pair: sections alone, and bodies in three dimensions, which level the load less") {
  const ReducedBody& body = wide_body(8);
  StaticParameters settings = slices(8, 12);
  settings.mesh.corner.enabled = false;
  settings.mesh.misalignment = 10e-6;
  const StaticResult sections = static_transmission(body, body, settings, 150);
  settings.fidelity.width = WidthModel::body;
  const StaticResult whole = static_transmission(body, body, settings, 150);
  MESSAGE("K_Hbeta at the pitch point: slices "
          << sections.face.load_factor << " (1.545), bodies " << whole.face.load_factor
          << " (1.985 finite elements, 1.980 coupled slices); least eigenvalue "
          << whole.face.least_eigenvalue << " m2/N");
  // The printed values are of a linear contact and of teeth without fillets.
  CHECK(sections.face.load_factor == relative(1.545, 0.04));
  const double ratio = (whole.face.load_factor - 1) / (sections.face.load_factor - 1);
  CHECK(ratio > 1.75);
  CHECK(ratio < 2.1);
  CHECK(whole.face.least_eigenvalue > 0);
  CHECK(whole.least_gap >= -1e-12);
  // Under even load the third dimension changes the stiffness by a few per cent.
  settings.mesh.misalignment = 0;
  settings.contact.face_points = 8;
  const StaticResult even = static_transmission(body, body, settings, 150);
  settings.fidelity.width = WidthModel::slices;
  const StaticResult even_sections = static_transmission(body, body, settings, 150);
  MESSAGE("even load: mean stiffness of bodies over that of slices "
          << even.mean_stiffness / even_sections.mean_stiffness << ", K_Hbeta " << even.face.load_factor);
  CHECK(even.mean_stiffness / even_sections.mean_stiffness == relative(0.97, 0.02));
}

TEST_CASE("bodies in three dimensions are asked for by name") {
  StaticParameters settings = slices(8, 4);
  settings.fidelity.width = WidthModel::body;
  CHECK(refused([&] { static_transmission(paper_body(), paper_body(), settings, 150); }, Failure::input,
                {"plane = \"stress\"", "strain"}));
  settings.mesh.centre_distance = kHelicalDistance;
  CHECK(refused(
      [&] { static_transmission(helical_body(Hand::right), helical_body(Hand::left), settings, 150); },
      Failure::input, {"plane body", "width_degree"}));
}

namespace {

// A body in plane strain and three dimensions, 20 mm wide or as wide as is said.
const ReducedBody& body_3d(double beta, Hand hand, int degree = 4, double width = 20e-3) {
  return strained_body(gear_with_helix(beta, hand, width), degree, 3e-3);
}

const ReducedBody& helical_3d(Hand hand) {
  return body_3d(20, hand);
}

const ReducedBody& spur_3d(int degree = 4) {
  return body_3d(0, Hand::right, degree);
}

StaticParameters on_bodies(int positions, int points, double distance = 0.150) {
  StaticParameters settings = slices(positions, points, distance);
  settings.fidelity.width = WidthModel::body;
  return settings;
}

// Largest difference of two results over the period: transmission errors over the mean, line loads and root stresses over the largest.
struct Apart {
  double error, load, root;
};
Apart apart(const StaticResult& a, const StaticResult& b, bool mirrored) {
  Apart out{(a.transmission_error - b.transmission_error).cwiseAbs().maxCoeff() / a.transmission_error.mean(),
            0, 0};
  for (size_t g = 0; g < kSides; ++g)
    for (size_t i = 0; i < a.face.root_stress[g].size(); ++i) {
      const MatrixRM &here = a.face.root_stress[g][i], &there = b.face.root_stress[g][i];
      const MatrixRM other = mirrored ? MatrixRM(there.rowwise().reverse()) : there;
      out.root = std::max(out.root, (here - other).cwiseAbs().maxCoeff() / a.root_stress_max.maxCoeff());
    }
  for (size_t i = 0; i < a.face.line_load.size(); ++i) {
    const MatrixRM other = mirrored ? MatrixRM(b.face.line_load[i].rowwise().reverse()) : b.face.line_load[i];
    out.load = std::max(out.load, (a.face.line_load[i] - other).cwiseAbs().maxCoeff() / a.face.line_load_max);
  }
  return out;
}

}  // namespace

TEST_CASE(
    "helical bodies in three dimensions: the other hand is the mirror image, exchanged gears give the same") {
  StaticParameters settings = on_bodies(8, 8, kHelicalDistance);
  settings.mesh.modification[0].lead.crowning = 3e-6;
  settings.mesh.misalignment = 4e-6;
  const ReducedBody &right = helical_3d(Hand::right), &left = helical_3d(Hand::left);
  const StaticResult here = static_transmission(right, left, settings, 150);
  settings.mesh.misalignment = -4e-6;
  const Apart mirrored = apart(here, static_transmission(left, right, settings, 150), true);
  MESSAGE("other hand: transmission error off by " << mirrored.error << ", line loads by " << mirrored.load
                                                   << ", root stresses by " << mirrored.root);
  CHECK(mirrored.error < 1e-11);
  CHECK(mirrored.load < 1e-9);
  CHECK(here.root_stress_max.minCoeff() > 0);
  CHECK(mirrored.root < 1e-9);
  CHECK(here.face.degree == 4);
  CHECK(here.face.least_eigenvalue > 0);
  CHECK(here.least_gap >= -1e-12);
  const HelicalForces force = helical_forces(GearPair(here), 150);
  for (Index i = 0; i < 8; ++i) CHECK(here.tooth_load.row(i).sum() == relative(force.normal, 1e-10));
  // Buttressing: the ends of a helical tooth differ, and they change places with the hand. At the pitch point both gears are alike, and
  // half a turn exchanges them.
  settings.mesh.misalignment = 0;
  const StaticResult even = static_transmission(right, left, settings, 150),
                     other = static_transmission(left, right, settings, 150);
  const auto ends = [](const StaticResult& s, size_t phase) {  // of the reference line
    const auto row = s.face.line_load[phase].row(-s.pair[0]);
    return row[0] / row[row.size() - 1];
  };
  MESSAGE("load at one end of the line over that at the other: " << ends(even, 1) << ", of the other hand "
                                                                 << ends(other, 1) << ", at the pitch point "
                                                                 << ends(even, 0));
  CHECK(ends(even, 0) == relative(1, 1e-9));
  CHECK(std::abs(ends(even, 1) - 1) > 0.01);
  CHECK(ends(even, 1) * ends(other, 1) == relative(1, 1e-9));
}

TEST_CASE("bodies in three dimensions: a small helix is the spur pair") {
  const double beta = 0.05;
  StaticParameters settings = on_bodies(8, 8);
  settings.mesh.corner.enabled = false;
  settings.mesh.misalignment = 5e-6;
  const VectorXd spur = static_transmission(spur_3d(), spur_3d(), settings, 150).transmission_error;
  settings.mesh.centre_distance = 0.150 / std::cos(beta * kOneDegreeOfFace);
  const VectorXd slight =
      static_transmission(body_3d(beta, Hand::right), body_3d(beta, Hand::left), settings, 150)
          .transmission_error;
  // Away from the ends of the path, at which a spur line comes and goes as a whole.
  for (const int i : {0, 2, 4, 6}) CHECK(slight[i] == relative(spur[i], 1e-4));
}

TEST_CASE(
    "bodies in three dimensions: degree and points against finer ones, and the error that stands beside K_Hbeta") {
  for (const bool helical : {false, true}) {
    const double lead = 10e-6;
    StaticParameters settings = on_bodies(helical ? 16 : 4, 12, helical ? kHelicalDistance : 0.150);
    settings.mesh.misalignment = lead;
    settings.mesh.corner.enabled = false;
    const auto result = [&](int degree) {
      const ReducedBody& a = helical ? body_3d(20, Hand::right, degree) : body_3d(0, Hand::right, degree);
      return static_transmission(a, helical ? body_3d(20, Hand::left, degree) : a, settings, 150);
    };
    const StaticResult six = result(6), eight = result(8), ten = result(10);
    const auto off = [&](const StaticResult& s) {
      return (s.transmission_error - ten.transmission_error).cwiseAbs().maxCoeff() /
             ten.transmission_error.mean();
    };
    MESSAGE((helical ? "helical" : "spur")
            << ": K_Hbeta of degrees 6, 8, " << ten.face.degree << ": " << six.face.load_factor << ", "
            << eight.face.load_factor << " ± " << eight.face.load_factor_error << ", " << ten.face.load_factor
            << "; transmission error off by " << off(six) << ", " << off(eight));
    CHECK(off(eight) < 2e-3);
    CHECK(std::abs(eight.face.load_factor - ten.face.load_factor) < eight.face.load_factor_error);
    CHECK(eight.face.load_factor_error < 0.15 * eight.face.load_factor);
  }
}

TEST_CASE("polynomials over the face are no finer than the contact is wide") {
  StaticParameters settings = on_bodies(4, 8);
  settings.mesh.corner.enabled = false;
  const StaticResult light = static_transmission(spur_3d(8), spur_3d(8), settings, 150),
                     heavy = static_transmission(spur_3d(8), spur_3d(8), settings, 1200);
  CHECK(light.face.degree == 8);
  const double a = heavy.contact_half_width.maxCoeff();
  MESSAGE("degree " << heavy.face.degree << " at half-widths up to " << a * 1e3 << " mm");
  CHECK(heavy.face.degree < 8);
  CHECK(heavy.face.degree == degree_of_contact(20e-3, a));
  CHECK(std::any_of(heavy.remarks.begin(), heavy.remarks.end(),
                    [](const Remark& r) { return r.words.find("P <= sqrt(b / 2a)") != std::string::npos; }));
  CHECK(degree_of_contact(20e-3, 0.15e-3) == 8);
  for (const auto& [modules, degree] : {std::pair{8.5, 8}, std::pair{15.0, 12}, std::pair{20.0, 16}})
    CHECK(degree_of_width(gear_with_helix(0, Hand::right, 3e-3 * modules), paper_gear()) == degree);
}

TEST_CASE(
    "faces of unequal width: what stands beyond the contact stiffens the ends of the wider gear's teeth") {
  const ReducedBody& wide = body_3d(0, Hand::right, 4, 26e-3);
  StaticParameters settings = on_bodies(4, 8);
  settings.mesh.corner.enabled = false;
  const auto ends = [](const StaticResult& s) {
    const auto row = s.face.line_load[0].row(-s.pair[0]);
    return std::array{row[0], row[row.size() - 1]};
  };
  const StaticResult equal = static_transmission(spur_3d(), spur_3d(), settings, 150),
                     middle = static_transmission(wide, spur_3d(), settings, 150);
  settings.mesh.face_offset = 3e-3;  // the driven, narrower gear at the end of the driver's face
  const StaticResult end = static_transmission(wide, spur_3d(), settings, 150);
  settings.mesh.face_offset = -3e-3;
  const StaticResult other_end = static_transmission(wide, spur_3d(), settings, 150);
  const std::array even = ends(equal), both = ends(middle), one = ends(end), two = ends(other_end);
  MESSAGE("line loads at the two ends, N/mm: equal faces "
          << even[0] * 1e-3 << ", " << even[1] * 1e-3 << "; wider by 3 mm on either side " << both[0] * 1e-3
          << ", " << both[1] * 1e-3 << "; by 6 mm on one " << one[0] * 1e-3 << ", " << one[1] * 1e-3
          << "; mean stiffness " << middle.mean_stiffness / equal.mean_stiffness << ", "
          << end.mean_stiffness / equal.mean_stiffness << " of that of equal faces");
  CHECK(both[0] == relative(both[1], 1e-9));
  CHECK(both[0] > even[0]);
  CHECK(middle.mean_stiffness > equal.mean_stiffness);
  // z = -10 mm then has 6 mm of tooth beyond it, z = +10 mm none.
  CHECK(one[0] > one[1]);
  CHECK(one[0] == relative(two[1], 1e-9));
  // The gears exchanged: a wider driven gear, whose overhang is on the other side of the same offset.
  const StaticResult exchanged = static_transmission(spur_3d(), wide, settings, 150);
  CHECK(exchanged.transmission_error[0] == relative(end.transmission_error[0], 1e-6));
  settings.mesh.face_offset = 3.5e-3;
  CHECK(refused([&] { static_transmission(wide, spur_3d(), settings, 150); }, Failure::input,
                {"face_offset_mm", 3.5, 3}));
}

TEST_CASE(
    "bodies in three dimensions: the turn of a small gear with a steep helix is read as it was written") {
  const TemporaryFolder folder;
  ReducedBody body = helical_3d(Hand::right);
  body.width.helix = -20.63469945;  // m-1: 17 teeth of module 1.95 mm, 20 degrees
  write(folder / "body.h5", body, Provenance());
  CHECK(read<ReducedBody>(folder / "body.h5").width.helix == body.width.helix);
}
