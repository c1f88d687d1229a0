// Friction of unequal gears and of internal pairs: work put in less work given against the integral of mu N v, by vectors and by
// the motion of the gears; what its tangential forces would do to the bodies.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "friction_motion.h"
#include "gear/internal_mesh.h"
#include "gear/losses.h"
#include "internal_pair.h"
#include "paper_pair.h"
#include "relative.h"
#include "solid/loaded_gear.h"
#include "system/system_statics.h"

using namespace whine;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kFriction = 0.06;
constexpr double kSmoothing = 0.01;

GearDesign external(int teeth) {
  return paper_gear(teeth, teeth < 25 ? 15e-3 : 25e-3);
}

const ReducedBody& body_of(const GearDesign& design) {
  return kept_body(design, paper_steel(), 1.2e-3, 7);
}

// Two gears in mesh, the driver first.
struct Gears {
  GearDesign driver, driven;
  double distance;  // m
};
const Gears kDown{external(20), external(30), 75e-3}, kUp{external(30), external(20), 75e-3},
    kPlanetDrives{planet_gear(), ring_gear(), kInternalDistance},
    kRingDrives{ring_gear(), planet_gear(), kInternalDistance};

StaticParameters settings_of(const Gears& gears, double coefficient, ContactModel contact, bool corner) {
  StaticParameters settings = paper_statics(32);
  settings.mesh.centre_distance = gears.distance;
  settings.mesh.corner.enabled = corner;
  settings.mesh.friction.coefficient = coefficient;
  settings.mesh.friction.smoothing = kSmoothing;
  settings.fidelity.contact = contact;
  return settings;
}

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// By vectors in the plane, of pairs on the line of action.
struct Books {
  double in = 0, out = 0,
         loss = 0;  // N m per angle of the driver: from the driver, to the driven gear, mu N v
};
Books books(const GearPair& pair, const SystemPosition& position, const VectorXd& p) {
  Books sum;
  const double ratio = static_cast<double>(pair.gear(0).design().teeth) / pair.gear(1).design().teeth,
               radius = pair.gear(0).base_radius() / std::cos(pair.working_pressure_angle());
  const double speed[] = {1, pair.internal() ? ratio : -ratio};  // counter-clockwise
  const Vec2 normal = contact_normal(pair), tangent(-normal.y(), normal.x());
  for (const ContactSegment& segment : position.segment) {
    const double force = p.segment(segment.first_strip, segment.strips).sum();
    if (!(force > 0)) continue;
    const Vec2 point = Vec2(0, radius) + segment.phase * pair.base_pitch() * normal;
    Vec2 arm[2];
    double slides = 0;  // m rad-1: driver over driven gear
    for (int g = 0; g < 2; ++g) {
      arm[g] = point - placed(pair, g).centre;
      slides += (g == 0 ? 1 : -1) * speed[g] * Vec2(-arm[g].y(), arm[g].x()).dot(tangent);
    }
    const double share = kFriction * slides / std::hypot(slides, kSmoothing * radius);
    const Vec2 push = force * (normal + share * tangent);  // on the driven gear
    sum.in += speed[0] * cross(arm[0], push);
    sum.out += speed[1] * cross(arm[1], push);
    sum.loss += force * share * slides;
  }
  return sum;
}

}  // namespace

TEST_CASE(
    "friction at rest: work put in less work given is mu N v by vectors, of unequal gears and internal pairs") {
  constexpr double kTorque = 100;
  for (const Gears* gears : {&kDown, &kUp, &kPlanetDrives, &kRingDrives})
    for (const auto contact : {ContactModel::strips, ContactModel::line}) {
      INFO(gears->driver.teeth << " drives " << gears->driven.teeth << ", " << contact);
      SystemModel system(body_of(gears->driver), body_of(gears->driven),
                         settings_of(*gears, kFriction, contact, false).mesh);
      system.layout.drives.push_back({0, System::DriveKind::torque, kTorque});
      system.friction = {kFriction};
      SystemStatics statics(system, contact, static_zones(system, 8, 1, 1.6));
      const GearPair& pair = system.mesh[0].kinematics;
      const double ratio = static_cast<double>(gears->driver.teeth) / gears->driven.teeth;
      double least = 1, most = -1;
      for (const double phase : {0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95}) {
        const SystemSolution& solution = statics.solve(phase, 0, VectorXd::Zero(2));
        const Books by_vectors = books(pair, statics.position(), solution.equilibrium.p);
        // The equilibrium has the torque, and the driven gear what is left of it.
        const double given = solution.driven_force[0] * system.base_radius(1) * ratio;
        CHECK(by_vectors.in == relative(kTorque, 1e-9));
        CHECK(by_vectors.out == relative(given, 1e-9));
        CHECK(std::abs(kTorque - given - by_vectors.loss) < 1e-9 * kTorque);
        CHECK(by_vectors.loss > 0);
        const double first = solution.driving_force[0], second = solution.driven_force[0];
        least = std::min(least, second / first);
        most = std::max(most, second / first);
      }
      CHECK(least > 0.95);
      CHECK(most < 1);
    }
}

TEST_CASE("friction at rest: with driver and driven gear exchanged moments change places and sign") {
  const StaticResult a = static_transmission(body_of(kDown.driver), body_of(kDown.driven),
                                             settings_of(kDown, 1e-4, ContactModel::strips, false), 100),
                     b = static_transmission(body_of(kUp.driver), body_of(kUp.driven),
                                             settings_of(kUp, 1e-4, ContactModel::strips, false), 150);
  const Index n = a.mesh_phase.size();
  const double most = a.friction_moment[1].cwiseAbs().maxCoeff();
  for (Index i = 1; i < n; ++i)
    for (size_t g = 0; g < 2; ++g)
      CHECK(std::abs(a.friction_moment[g][i] + b.friction_moment[1 - g][n - i]) < 2e-3 * most);
  // Per angle of the other gear.
  CHECK(a.friction_loss.mean() * 1.5 == relative(b.friction_loss.mean(), 2e-3));
  CHECK(a.efficiency == relative(b.efficiency, 1e-6));
  CHECK(1 - a.efficiency == relative(1e-4 * a.loss_factor, 5e-3));
}

namespace {

FrictionMotion motion_of(const Gears& gears, double torque, ContactModel contact, BodyModel body,
                         bool bearings = false) {
  StaticParameters settings = settings_of(gears, kFriction, contact, true);
  if (bearings) settings.mesh.bearing = {Bearing{200e6, 500, 0}, Bearing{120e6, 700, 0}};
  const ReducedBody &driver = body_of(gears.driver), &driven = body_of(gears.driven);
  const StaticResult statics = static_transmission(driver, driven, settings, torque);
  const std::array<double, kSides> inertia{3 * driver.inertia, 2 * driven.inertia};
  const double eta = 0.03 / (2 * std::numbers::pi * natural_frequency(statics, inertia));
  return FrictionMotion(driver, driven, statics, inertia, body, body == BodyModel::rigid ? 0 : eta);
}

// At a share of the natural frequency.
void start(FrictionMotion& motion, double share, int steps, int periods) {
  motion.start(share * natural_frequency(motion.statics, motion.inertia), steps, periods);
}

struct Moments {
  double normal[2] = {}, friction[2] = {};  // [gear] N m
};
// load: (pair -reach..reach) N.
Moments moments_of(const GearPair& pair, double phase, const VectorXd& load) {
  Moments m;
  const int reach = static_cast<int>(load.size()) / 2;
  for (int slot = 0; slot < load.size(); ++slot) {
    if (!(load[slot] > 0)) continue;
    const PairContact touch = pair.contact(phase + slot - reach);
    const PairSliding slides = sliding_of(pair, touch, kSmoothing);
    for (size_t g = 0; g < 2; ++g) {
      m.normal[g] += load[slot] * touch.lever[g];
      m.friction[g] += kFriction * load[slot] * slides.direction * slides.lever[g];
    }
  }
  return m;
}

}  // namespace

// What friction takes is the sliding of the kinematics in one line, torques and angular momentum in the other: a wrong lever,
// sliding speed, torque of the driven gear or inertia leaves the balance open.
TEST_CASE("friction in motion: torques and angular momentum of unequal gears leave what sliding takes") {
  for (const Gears* gears : {&kDown, &kUp})
    for (const auto contact : {ContactModel::strips, ContactModel::line})
      for (const bool bearings : {false, true}) {
        if (bearings && contact == ContactModel::line) continue;
        FrictionMotion motion = motion_of(*gears, 60, contact, BodyModel::modal, bearings);
        start(motion, 0.93, 96, 40);
        EnergyBalance l;
        double least = 1;
        for (int i = 0; i < 10; ++i) {
          REQUIRE(motion.dynamics.integrate(motion.state, motion.period, &l));
          least = std::min(least, motion.period.tooth_pair_load.colwise().sum().minCoeff());
        }
        INFO(gears->driver.teeth << " drives " << gears->driven.teeth << ", " << contact << ", bearings "
                                 << bearings << ": friction " << l.friction.sum() << " J, rolling "
                                 << l.friction_rolling << " J, imbalance " << l.imbalance
                                 << " J, least mesh force " << least << " N");
        if (!bearings) CHECK(least == 0);
        CHECK(l.friction.sum() > 0);
        CHECK(std::abs(l.left_over()) < 1e-9 * l.friction.sum());
        CHECK(l.imbalance < 1e-9 * l.friction.sum());
      }
}

TEST_CASE(
    "friction in motion: of rigid unequal gears, work put in less work given by the motion that is shown") {
  constexpr int kSteps = 128;
  for (const Gears* gears : {&kDown, &kUp})
    for (const auto contact : {ContactModel::strips, ContactModel::line}) {
      FrictionMotion motion = motion_of(*gears, 60, contact, BodyModel::rigid);
      start(motion, 0.8, kSteps, 30);
      const GearPair& pair = motion.model.kinematics;
      EnergyBalance balance;
      const RollingDynamics::Period before = motion.period;
      RollingDynamics::Period now;
      REQUIRE(motion.dynamics.integrate(motion.state, now, &balance));
      // Sample 0 of a period is its end, in the names of the next; the turns of rigid gears go as r / I.
      const auto load = [&](int step) -> VectorXd {
        return step == 0 ? VectorXd(before.tooth_pair_load.col(0))
                         : VectorXd(now.tooth_pair_load.col(step % kSteps));
      };
      const auto error = [&](int step) {
        return step == 0 ? before.transmission_error[0] : now.transmission_error[step % kSteps];
      };
      const double turn = 2 * std::numbers::pi / gears->driver.teeth / kSteps,
                   ratio = static_cast<double>(gears->driver.teeth) / gears->driven.teeth;
      double share[2], whole = 0;
      for (int g = 0; g < 2; ++g) {
        const double r = pair.gear(g).base_radius();
        share[g] = r / motion.inertia[static_cast<size_t>(g)];
        whole += r * share[g];
      }
      const auto moments = [&](int step) {
        return moments_of(pair, static_cast<double>(step % kSteps) / kSteps, load(step));
      };
      double in = 0, out = 0, loss = 0, corner = 0;
      for (int step = 1; step <= kSteps; ++step) {
        const Moments a = moments(step - 1), b = moments(step);
        const double ahead = (error(step) - error(step - 1)) / whole;
        const double angle[] = {turn + share[0] * ahead, turn * ratio - share[1] * ahead};
        double normal[2], friction[2];
        for (int g = 0; g < 2; ++g) {
          normal[g] = 0.5 * (a.normal[g] + b.normal[g]);
          friction[g] = 0.5 * (a.friction[g] + b.friction[g]);
        }
        in += (normal[0] + friction[0]) * angle[0];
        out += (normal[1] + friction[1]) * angle[1];
        loss += friction[0] * angle[0] - friction[1] * angle[1];
        corner += normal[0] * turn - normal[1] * turn * ratio;
      }
      INFO(gears->driver.teeth << " drives " << gears->driven.teeth << ", " << contact << ": "
                               << balance.friction.sum() << " J, by the motion " << loss << " J of "
                               << in - out << " J");
      CHECK(balance.friction.sum() == relative(loss, 1e-9));
      // The rest is what normal forces do on gaps that close and open: what torques put into the vibration and it does not keep.
      const double by_energy =
          corner + balance.drive.sum() - balance.kinetic - balance.modal_damping + balance.friction_rolling;
      CHECK(std::abs(in - out - by_energy) < 1e-9 * in);
    }
}

TEST_CASE("friction in motion: losses of unequal gears are mu times the loss factor of their loads") {
  for (const Gears* gears : {&kDown, &kUp}) {
    FrictionMotion motion = motion_of(*gears, 60, ContactModel::line, BodyModel::relaxed);
    start(motion, 0.13, 256, 60);
    EnergyBalance balance;
    REQUIRE(motion.dynamics.integrate(motion.state, motion.period, &balance));
    const Index steps = motion.period.tooth_pair_load.cols(),
                reach = motion.period.tooth_pair_load.rows() / 2;
    const auto last = static_cast<int>(reach);
    const double factor =
        loss_factor(motion.model.kinematics, Eigen::VectorXi::LinSpaced(2 * reach + 1, -last, last),
                    VectorXd::LinSpaced(steps, 0, 1 - 1 / static_cast<double>(steps)),
                    MatrixRM(motion.period.tooth_pair_load.transpose()), 60);
    const double taken = balance.friction.sum() / (60 * 2 * std::numbers::pi / gears->driver.teeth);
    INFO(gears->driver.teeth << " drives " << gears->driven.teeth << ": " << taken << ", mu H_V "
                             << kFriction * factor);
    CHECK(taken == relative(kFriction * factor, 0.01));
  }
}

namespace {

// m N-1 of total force: what the loaded flank point moves along the tangent that friction pushes along, under a normal force
// there. By Maxwell and Betti it is also the inward displacement that a unit of friction adds.
double cross_compliance(const GearDesign& design, double roll, double& normal) {
  BodyDiscretisation discretisation;
  discretisation.element_size = 1.2e-3;
  const LoadedGear gear =
      loaded_gear(make_sector_mesh(design, discretisation), paper_steel(), {{0, roll, 0.3e-3, 1000}});
  const Vec2 outward = ToothGeometry(design).flank_normal(roll), tangent(-outward.y(), outward.x());
  normal = gear.deflection[0] / 1000;
  return -Vec2(gear.strip_displacement.row(0)).dot(tangent) / 1000;
}

}  // namespace

// Friction turns by mu s from the normal force towards the tangent: its moments are in the model, the bending of the teeth by it
// is not. To first order in mu and for a pair's own tooth: a deflection mu s N (c_1 + c_2), shared as the pairs share load.
TEST_CASE("friction at rest: what its forces would bend, beside what its moments change" * doctest::skip()) {
  const GearDesign design = paper_gear(50, 40e-3);
  const GearPair pair(design, design, 0.150);
  const ToothGeometry tooth(design);
  constexpr int kPoints = 9;
  const double low = tooth.form_roll_angle(), high = tooth.tip_roll_angle();
  VectorXd compliance(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double share = 0.1 + 0.85 * i / (kPoints - 1);
    double normal = 0;
    compliance[i] = cross_compliance(design, low + share * (high - low), normal);
    MESSAGE("roll " << share << " of the flank: " << compliance[i] * 1e9 << " nm/N across, "
                    << compliance[i] / normal << " of the normal deflection");
    CHECK(compliance[i] > 0);
  }
  const auto at = [&](double roll) {
    const double place =
        std::clamp(((roll - low) / (high - low) - 0.1) / 0.85 * (kPoints - 1), 0.0, kPoints - 1.001);
    const auto i = static_cast<Index>(place);
    return compliance[i] + (place - static_cast<double>(i)) * (compliance[i + 1] - compliance[i]);
  };
  StaticParameters settings = paper_statics(64);
  settings.mesh.friction.smoothing = kSmoothing;
  const StaticResult without =
      static_transmission(paper_body(40e-3, 1.2e-3, 12), paper_body(40e-3, 1.2e-3, 12), settings, 150);
  settings.mesh.friction.coefficient = 0.05;
  const StaticResult with =
      static_transmission(paper_body(40e-3, 1.2e-3, 12), paper_body(40e-3, 1.2e-3, 12), settings, 150);
  const VectorXd moments = with.transmission_error - without.transmission_error;
  VectorXd bending = VectorXd::Zero(moments.size());
  for (Index i = 0; i < moments.size(); ++i) {
    double sum = 0;
    for (Index k = 0; k < with.pair.size(); ++k) {
      const double force = with.tooth_load(i, k);
      if (!(force > 0)) continue;
      const PairContact contact = pair.contact(with.mesh_phase[i] + with.pair[k]);
      const double share = 0.05 * sliding_of(pair, contact, kSmoothing).direction;
      bending[i] += force * share * force * (at(contact.roll[0]) + at(contact.roll[1]));
      sum += force;
    }
    bending[i] /= sum;
  }
  const auto spread = [](const VectorXd& x) { return (x.maxCoeff() - x.minCoeff()) * 1e9; };
  MESSAGE("peak to peak: transmission error "
          << spread(without.transmission_error) << " nm; change by moments " << spread(moments)
          << " nm, by bending " << spread(bending) << " nm, by both " << spread(moments + bending) << " nm");
  const double cosine = moments.dot(bending) / (moments.norm() * bending.norm());
  MESSAGE("cosine of the two changes: " << cosine);
  CHECK(cosine < -0.8);
  CHECK(spread(moments + bending) < 0.5 * spread(moments));
  const auto first = [](const VectorXd& x) {
    std::complex<double> sum = 0;
    for (Index i = 0; i < x.size(); ++i)
      sum += x[i] *
             std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(x.size()));
    return 2 * std::abs(sum) / static_cast<double>(x.size()) * 1e9;
  };
  MESSAGE("first harmonic: " << first(without.transmission_error) << " nm without friction, "
                             << first(with.transmission_error) << " nm with its moments, "
                             << first(with.transmission_error + bending) << " nm with the bending as well");
}
