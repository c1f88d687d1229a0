// Friction between the flanks: kinematics, Schlenk's formula, complementarity, statics.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>

#include "base/error.h"
#include "contact/friction.h"
#include "gear/iso6336_strength.h"
#include "internal_pair.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
#include "own_folder.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "results/static.h"
#include "scene_file.h"
#include "system/mesh_record.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const ReducedBody& coarse_body() {
  return paper_body(40e-3, 1.2e-3, 12);
}

StaticParameters statics_with(double coefficient, ContactModel contact, bool corner,
                              double smoothing = 0.01) {
  StaticParameters settings = paper_statics(32);
  settings.fidelity.contact = contact;
  settings.mesh.corner.enabled = corner;
  settings.mesh.friction.coefficient = coefficient;
  settings.mesh.friction.smoothing = smoothing;
  return settings;
}

StaticResult at_rest(const StaticParameters& settings, double torque = 150) {
  return static_transmission(coarse_body(), coarse_body(), settings, torque);
}

// As it is stored.
SystemStaticResult whole_at_rest(const StaticParameters& settings) {
  SystemStaticResult out = pair_at_rest(coarse_body(), coarse_body(), settings, 150);
  add_harmonics(out.mesh[0]);
  return out;
}

// The other way round: the moment is that of the swapped gear, a mesh phase before the pitch point for one after it.
GearPair unequal(bool swapped) {
  GearDesign pinion = paper_gear(30), wheel = paper_gear(45);
  pinion.bore_radius = wheel.bore_radius = 20e-3;
  return swapped ? GearPair(wheel, pinion, 0.1125) : GearPair(pinion, wheel, 0.1125);
}

}  // namespace

TEST_CASE("friction: sliding on the line of action is that of the kinematics, whichever gear drives") {
  for (const GearPair& pair : {unequal(false), unequal(true), GearPair(paper_gear(), paper_gear(), 0.150)})
    for (double phase = -0.8; phase <= 0.8; phase += 0.1) {
      const double path = phase * pair.base_pitch();
      if (path < pair.path_start() || path > pair.path_end()) continue;
      const PairSliding s = sliding_of(pair, pair.contact(phase), 1e-6);
      CHECK(std::abs(s.speed - pair.sliding(path)) < 1e-15);
      const double tangent = std::tan(pair.working_pressure_angle());
      CHECK(s.lever[0] == relative(pair.gear(0).base_radius() * tangent + path, 1e-12));
      CHECK(s.lever[1] == relative(pair.gear(1).base_radius() * tangent - path, 1e-12));
      CHECK(s.loss() >= 0);
      if (std::abs(phase) > 0.05) CHECK(s.direction == relative(phase > 0 ? 1 : -1, 1e-6));
    }
  // A tip edge that touches early or late slides faster than the end of the path.
  const GearPair pair = unequal(false);
  const double end = pair.path_end() / pair.base_pitch(), start = pair.path_start() / pair.base_pitch();
  CHECK(sliding_of(pair, pair.contact(end + 0.02), 1e-6).speed > pair.sliding(pair.path_end()));
  CHECK(sliding_of(pair, pair.contact(start - 0.02), 1e-6).speed < pair.sliding(pair.path_start()));
}

TEST_CASE("friction: lever arms are those of the tangent about the axes, of external and internal pairs") {
  const GearPair pairs[] = {unequal(false), unequal(true),
                            GearPair(planet_gear(), ring_gear(), kInternalDistance),
                            GearPair(ring_gear(), planet_gear(), kInternalDistance)};
  for (const GearPair& pair : pairs)
    for (const double share : {0.1, 0.4, 0.6, 0.9}) {
      const double path = pair.path_start() + share * (pair.path_end() - pair.path_start());
      const PairSliding s = sliding_of(pair, pair.contact(path / pair.base_pitch()), 0.01);
      const Vec2 normal = contact_normal(pair),
                 point = Vec2(0, pair.gear(0).base_radius() / std::cos(pair.working_pressure_angle())) +
                         path * normal,
                 tangent(-normal.y(), normal.x());
      for (int g = 0; g < 2; ++g) {
        const Vec2 arm = point - placed(pair, g).centre;
        const double turns = g == 1 && !pair.internal() ? -1 : 1;  // counter-clockwise
        CHECK(s.lever[static_cast<size_t>(g)] ==
              relative(turns * (arm.x() * tangent.y() - arm.y() * tangent.x()), 1e-9));
        CHECK(turns * (arm.x() * normal.y() - arm.y() * normal.x()) ==
              relative(pair.gear(g).base_radius(), 1e-9));
      }
      CHECK(std::abs(s.speed) == relative(std::abs(pair.sliding(path)), 1e-9));
    }
}

TEST_CASE("friction: with the driver driven, levers change places and the sliding its sign") {
  const GearPair pair = unequal(false), swapped = unequal(true);
  for (const double phase : {-0.83, -0.6, -0.2, 0.1, 0.4, 0.7, 0.82}) {
    const PairSliding a = sliding_of(pair, pair.contact(phase), 0.01),
                      b = sliding_of(swapped, swapped.contact(-phase), 0.01);
    for (size_t g = 0; g < 2; ++g) CHECK(a.lever[g] == relative(b.lever[1 - g], 1e-9));
    CHECK(a.direction == relative(-b.direction, 1e-9));
    CHECK(a.speed == relative(-b.speed * 30 / 45, 1e-9));  // per angle of the other gear
  }
}

TEST_CASE("friction: Schlenk's formula by hand, and what it needs") {
  const GearPair pair = unequal(false);
  Friction friction;
  friction.law = FrictionLaw::schlenk;
  friction.viscosity = 0.015;
  friction.roughness = 0.4e-6;
  friction.lubricant_factor = 0.9;
  const double rb = pair.gear(0).base_radius(), alpha = 20 * std::numbers::pi / 180;
  const double force = 300 / rb / 20,
               speed = 2 * (2 * std::numbers::pi * 1000 / 30) * 45e-3 * std::sin(alpha),
               rho = 1 / (1 / (45 * std::sin(alpha)) + 1 / (67.5 * std::sin(alpha)));
  CHECK(force > 150);
  CHECK(
      friction_coefficient(pair, 20e-3, friction, 300, 1000) ==
      relative(0.048 * std::pow(force / (speed * rho), 0.2) * std::pow(15, -0.05) * std::pow(0.4, 0.25) * 0.9,
               1e-12));
  CHECK(friction_coefficient(pair, 20e-3, friction, 1, 1000) ==
        relative(friction_coefficient(pair, 20e-3, friction, 2, 1000), 1e-12));  // below 150 N/mm
  // Beyond 1 and 50 m/s on the pitch line the coefficient is that of the bound.
  const double to_speed = 30 / (2 * std::numbers::pi * 45e-3);  // Hz of 1 m/s
  CHECK(pitch_line_speed(pair, to_speed) == relative(1, 1e-12));
  const auto at = [&](double speed) {
    return friction_coefficient(pair, 20e-3, friction, 300, speed * to_speed);
  };
  CHECK(at(0.01) == relative(at(1), 1e-12));
  CHECK(at(100) == relative(at(50), 1e-12));
  CHECK(at(2) < 0.9 * at(1));
  CHECK(at(50) < 0.9 * at(25));
  Friction rough = friction;
  rough.roughness = 100e-6;
  rough.lubricant_factor = 10;
  CHECK(names(message_of([&] { friction_coefficient(pair, 20e-3, rough, 300, 1000); }), {"0.3", "allowed"}));
  rough.roughness = 0;
  CHECK(names(message_of([&] { friction_coefficient(pair, 20e-3, rough, 300, 1000); }), {"roughness_um"}));
  CHECK(names(message_of([&] { friction_coefficient(pair, 20e-3, friction, 300, 0); }),
              {"static_frequency_Hz"}));
}

namespace {

// Random problems: a certificate that holds for the whole problem, or a refusal. Returns how many were refused.
int solve_random(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  ComplementaritySolver solver;
  int refused = 0;
  for (int i = 0; i < count; ++i) {
    const Index n = 1 + static_cast<Index>(12 * uniform(random));
    const auto matrix = [&] { return MatrixXd::NullaryExpr(n, n, [&] { return normal(random); }); };
    const MatrixXd root = matrix(), a = root * root.transpose() + 0.1 * MatrixXd::Identity(n, n);
    const double size = 1.5 * uniform(random) * uniform(random);
    MatrixXd added = matrix();
    added *= size * a.norm() / (10 * added.norm());
    const VectorXd e = VectorXd::NullaryExpr(n, [&] { return normal(random) - 0.5; });
    ActiveSet active;
    VectorXd p = VectorXd::Zero(n), d = p, shift = p;
    try {
      solve_with_friction(
          shift, e.cwiseAbs().maxCoeff(),
          [&](const VectorXd& by) { return solver.solve(a, e + by, active, p, d); },
          [&] { return VectorXd(added * p); });
    } catch (const Error& error) {
      CHECK(error.kind() == Failure::numerical);
      ++refused;
      continue;
    }
    const VectorXd whole = (a + added) * p + e;
    const double scale = e.cwiseAbs().maxCoeff() + (a * p).cwiseAbs().maxCoeff();
    REQUIRE(p.minCoeff() >= 0);
    REQUIRE(whole.minCoeff() > -1e-9 * scale);
    REQUIRE(std::abs(p.dot(whole)) < 1e-9 * scale * p.sum() + 1e-300);
  }
  return refused;
}

}  // namespace

TEST_CASE("friction: 1000 random complementarity problems are certified or refused") {
  const int refused = solve_random(1000, 1);
  INFO(refused << " refused");
  CHECK(refused > 0);  // some do not contract
  CHECK(refused < 300);
}

TEST_CASE("friction: 1e5 random complementarity problems are certified or refused") {
  CHECK(solve_random(100000, 2) < 30000);
}

TEST_CASE("friction at rest: work put in less work given is the integral of mu s N v, and moments balance") {
  for (const auto contact : {ContactModel::strips, ContactModel::line})
    for (const bool corner : {false, true}) {
      const StaticResult s = at_rest(statics_with(0.06, contact, corner));
      const GearPair pair(s);
      INFO(contact << ", corner contact " << corner);
      double given = 0;  // N m per angle of the driver
      for (Index i = 0; i < s.mesh_phase.size(); ++i) {
        double driver = 0, driven = 0, loss = 0, moment[2] = {};
        for (Index k = 0; k < s.pair.size(); ++k) {
          const double force = s.tooth_load(i, k);
          if (!(force > 0)) continue;
          const PairContact at = pair.contact(s.mesh_phase[i] + s.pair[k]);
          const PairSliding slides = sliding_of(pair, at, 0.01);
          driver += force * at.lever[0];
          driven += force * at.lever[1];
          loss += 0.06 * force * slides.loss();
          for (size_t g = 0; g < 2; ++g) moment[g] += 0.06 * force * slides.direction * slides.lever[g];
        }
        CHECK(std::abs(s.friction_loss[i] - loss) < 1e-12);
        for (size_t g = 0; g < 2; ++g) CHECK(std::abs(s.friction_moment[g][i] - moment[g]) < 1e-12 * 150);
        CHECK(driver + moment[0] == relative(150, 1e-10));
        // In motion at these phases and loads; off the line of action the levers differ, and springs are wound and unwound.
        CHECK(std::abs(150 - (driven + moment[1]) - loss - (driver - driven)) < 1e-9 * 150);
        given += driven + moment[1];
      }
      if (!corner)
        CHECK(given / static_cast<double>(s.mesh_phase.size()) == relative(150 * s.efficiency, 1e-9));
      CHECK(s.efficiency == relative(1 - s.friction_loss.mean() / 150, 1e-12));
      CHECK(s.efficiency > 0.99);
      CHECK(s.efficiency < 0.997);
    }
}

TEST_CASE("friction: a published loss factor of 16 and 24 teeth is the trapezoidal rule on 99 points") {
  GearDesign pinion = paper_gear(16, 15e-3), wheel = paper_gear(24, 15e-3);
  pinion.module = wheel.module = 4.5e-3;
  pinion.profile_shift = 0.1817;
  wheel.profile_shift = 0.1715;
  pinion.addendum = wheel.addendum = 1;
  const GearPair pair(pinion, wheel, 91.5e-3);
  CHECK(pair.contact_ratio() == relative(1.4625, 2e-4));
  // mean of |sliding| over the pairs that share evenly, A to E on `points`; all but the last are used.
  const auto rule = [&](int points) {
    const double step = (pair.path_end() - pair.path_start()) / (points - 1);
    const auto integrand = [&](int i) {
      const double path = pair.path_start() + i * step;
      int sharing = 0;
      for (int k = -2; k <= 2; ++k) {
        const double other = path + k * pair.base_pitch();
        sharing += other >= pair.path_start() - 1e-15 && other < pair.path_end() - 1e-15;
      }
      return std::abs(pair.sliding(path)) / sharing;
    };
    double sum = 0;
    for (int i = 0; i + 2 < points; ++i) sum += 0.5 * step * (integrand(i) + integrand(i + 1));
    return sum / pair.base_pitch() / pair.gear(0).base_radius();
  };
  CHECK(rule(100) == relative(0.1946, 1e-3));
  CHECK(rule(100000) == relative(loss_factor_of_rigid_teeth(pair), 1e-4));
}

TEST_CASE("friction at rest: losses over mu tend to the loss factor, of first order in mu") {
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    const double exact = at_rest(statics_with(0, contact, false)).loss_factor;
    const auto off = [&](double mu) {
      return (1 - at_rest(statics_with(mu, contact, false, 1e-6)).efficiency) / mu - exact;
    };
    const double coarse = off(0.02), fine = off(0.01);
    INFO(contact << ": H_V " << exact << ", off by " << coarse << ", " << fine);
    CHECK(std::abs(fine) < 2e-3 * exact);
    CHECK(coarse / fine == relative(2, 0.05));
  }
}

TEST_CASE(
    "friction at rest: equal gears see each other's moment with the opposite sign as the phase runs back") {
  const StaticResult s = at_rest(statics_with(1e-4, ContactModel::strips, false));
  const Index n = s.mesh_phase.size();
  const double most = s.friction_moment[0].cwiseAbs().maxCoeff();
  for (Index i = 1; i < n; ++i)
    CHECK(std::abs(s.friction_moment[0][i] + s.friction_moment[1][n - i]) < 2e-3 * most);
  CHECK(s.friction_moment[0].minCoeff() < -0.2 * most);
}

// Between pairs on the line of action n . tau = 0, so that what friction adds by way of bearings vanishes but for round-off. Tip
// edges have other normals.
TEST_CASE(
    "friction at rest on elastic bearings: the whole problem holds, and its force lies off the line of action") {
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    StaticParameters settings = statics_with(0.2, contact, true);
    settings.mesh.bearing = {Bearing{60e6}, Bearing{40e6}};
    SystemModel system(coarse_body(), coarse_body(), settings.mesh);
    system.layout.drives.push_back({0, System::DriveKind::torque, 300});
    system.friction = {0.2};
    SystemStatics statics(system, contact, static_zones(system, 8, 1, 1.6));
    double moved = 0;  // m: largest by what friction adds
    for (double phase = 0; phase < 1; phase += 0.0625) {
      const SystemSolution& solution = statics.solve(phase, 0, VectorXd::Zero(2));
      const SystemPosition& at = statics.position();
      const VectorXd& p = solution.equilibrium.p;
      const MatrixXd friction = friction_compliance(system, at);
      REQUIRE(friction.size() > 0);
      moved = std::max(moved, (friction * p).cwiseAbs().maxCoeff());
      CHECK(solution.equilibrium.certificate.coupling < 1e-17);
      CHECK(solution.equilibrium.residual < 1e-10);
      CHECK(at.load.rotation.col(0).dot(p) == relative(300 / system.base_radius(0), 1e-9));
      // What friction adds stands in the deflection: with it gaps of strips with force are closed.
      if (contact == ContactModel::strips) {
        const std::vector<std::vector<ContactZone>> zones = statics.zones();
        double worst = 0;
        for (const ContactZone& zone : zones[0])
          for (Index i = 0; i < zone.force.size(); ++i)
            if (zone.force[i] > 0) worst = std::max(worst, std::abs(zone.separation[i]));
        CHECK(worst < 1e-14);
      }
      Vec2 along(0, 0), across(0, 0);
      for (const ContactSegment& segment : at.segment) {
        const double force = p.segment(segment.first_strip, segment.strips).sum();
        along -= force * segment.normal;
        across -= 0.2 * force * segment.sliding.direction * Vec2(-segment.normal.y(), segment.normal.x());
      }
      CHECK((solution.bearing_force[0] - along - across).norm() < 1e-12 * along.norm());
      CHECK((solution.bearing_force[0] + solution.bearing_force[1]).norm() < 1e-12 * along.norm());
    }
    // The iteration has had something to find: 1e5 times what a gap may be off.
    INFO(contact << ": friction moves gaps by up to " << moved << " m by way of bearings");
    CHECK(moved > 1e-9);
  }
}

TEST_CASE("friction: without it nothing changes, and static.h5 keeps it") {
  const StaticResult without = at_rest(statics_with(0, ContactModel::strips, true)),
                     with = at_rest(statics_with(0.05, ContactModel::strips, true));
  CHECK(without.friction_loss.size() == 0);
  CHECK(without.efficiency == 1);
  // Bits, whatever else the section holds; of a small coefficient the results tend to them.
  const StaticResult none = at_rest(statics_with(0, ContactModel::strips, true, 0.5)),
                     little = at_rest(statics_with(1e-9, ContactModel::strips, true));
  CHECK(none.tooth_load == without.tooth_load);
  CHECK(none.transmission_error == without.transmission_error);
  CHECK(none.stiffness_tangent == without.stiffness_tangent);
  CHECK((little.tooth_load - without.tooth_load).norm() < 1e-7 * without.tooth_load.norm());
  CHECK((little.transmission_error - without.transmission_error).norm() <
        1e-7 * without.transmission_error.norm());
  CHECK(with.friction_coefficient == 0.05);
  CHECK((with.tooth_load - without.tooth_load).norm() > 1e-4 * without.tooth_load.norm());
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  const SystemStaticResult stored = whole_at_rest(statics_with(0.05, ContactModel::strips, true));
  write(path, stored, Provenance());
  const StaticResult read = whine::read_pair_statics(path);
  CHECK(read.friction_loss == with.friction_loss);
  CHECK(read.friction_moment[1] == with.friction_moment[1]);
  CHECK(read.efficiency == with.efficiency);
  CHECK(read.friction_coupling == with.friction_coupling);
  CHECK(read.mesh.friction.coefficient == 0.05);
  write(path, whole_at_rest(statics_with(0, ContactModel::strips, true)), Provenance());
  CHECK(whine::read_pair_statics(path).friction_loss.size() == 0);
  // What is left out is said, and where Schlenk's formula ends.
  const auto said = [](const std::vector<Remark>& remarks) {
    std::string all;
    for (const Remark& remark : remarks) all += remark.words + "; ";
    return all;
  };
  CHECK(friction_remarks(without, 150).empty());
  CHECK(contains(said(remarks(with)), "it bends no teeth here"));
  StaticResult schlenk = with;
  schlenk.mesh.friction.law = FrictionLaw::schlenk;
  CHECK(schlenk_speed_remarks(with, 1, 1e5).empty());
  CHECK(!contains(said(schlenk_speed_remarks(schlenk, 1000, 4000)), "m/s"));
  CHECK(contains(said(schlenk_speed_remarks(schlenk, 50, 4000)), "tests of Schlenk's formula begin"));
  CHECK(contains(said(schlenk_speed_remarks(schlenk, 1000, 7500)), "tests of Schlenk's formula end"));
  const double least = kSchlenkLoad * 1e3 * GearPair(with).gear(0).base_radius() * with.face_width();
  CHECK(!contains(said(friction_remarks(schlenk, 1.001 * least)), "N/mm"));
  CHECK(contains(said(friction_remarks(schlenk, 0.5 * least)), "the line load is 75 N/mm"));
}

TEST_CASE("friction: the section of a scene, and what it is rejected with") {
  const SceneFile file;
  CHECK(!file.read(kScene).mesh().friction.acts());
  const Scene scene = file.read(with_section("[friction]\ncoefficient = 0.05\nsmoothing = 0.02\n"));
  CHECK(scene.mesh().friction.coefficient == 0.05);
  CHECK(scene.mesh().friction.smoothing == 0.02);
  const std::string stage = static_parameters(scene);
  CHECK(contains(stage, "[friction]"));
  CHECK(read_static_parameters(file.path(stage)).mesh.friction.coefficient == 0.05);
  // No friction: the stage parameters of a scene without the section.
  CHECK(static_parameters(file.read(with_section("[friction]\ncoefficient = 0\n"))) ==
        static_parameters(file.read(kScene)));
  const Scene oil = file.read(with_section(
      "[friction]\nlaw = \"schlenk\"\nviscosity_mPas = 15\nroughness_um = 0.4\nstatic_frequency_Hz = 600\n"));
  CHECK(oil.mesh().friction.viscosity == relative(0.015, 1e-12));
  CHECK(oil.mesh().friction.roughness == relative(0.4e-6, 1e-12));
}
