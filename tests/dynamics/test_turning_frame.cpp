// Motions in the frame of a carrier that turns: closed forms, order of the step, rest, energy, tangent, forces on pins.
#include "dynamics/turning_frame.h"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

#include "dynamics/newmark.h"
#include "dynamics/system_dynamics.h"
#include "dynamics/system_period_map.h"
#include "elastic_train.h"
#include "gear/layout.h"
#include "orbits/periodic_motion.h"
#include "refusal.h"
#include "relative.h"
#include "system/system_rest.h"
#include "system/turning_modes.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSteps = 48;
constexpr std::array<int, 3> kTeeth{26, 37, 100};
constexpr size_t kRing = 4, kCarrier = 5;

// A body of one x and y on a bearing with a damper c (s-1): a planet on a carrier that is held, or a central member.
struct OneBody {
  OneBody(bool planet, double mass, double w, double c) {
    System::Body carrier, body;
    carrier.kind = System::BodyKind::carrier;
    carrier.radius = 0.1;
    body.on = planet ? 1 : System::kGround;
    body.centre = {planet ? 0.1 : 0.0, 0};
    body.bearing = {mass * w * w, mass * c, mass};
    layout.bodies = {body, carrier};
    coordinates.body.resize(2);
    coordinates.body[0].count = coordinates.body[0].swaying = 2;
    coordinates.body[0].shift = Eigen::Matrix2d::Identity() / std::sqrt(mass);
    coordinates.mass = Eigen::Vector2d(mass, 0);
    coordinates.frequency = Eigen::Vector2d(w, w);
    coordinates.damping = Eigen::Vector2d(c, c);
  }
  System layout;
  SystemCoordinates coordinates;
};

// z" + c z' + w^2 z = force of the frame: its matrix for (z, v), and one step of it.
MatrixXd exact_matrix(const SystemCoordinates& c, const TurningFrame& frame) {
  const Index n = c.frequency.size();
  MatrixXd w = MatrixXd::Zero(n, frame.constant().size());
  frame.add(MatrixXd::Identity(w.cols(), w.cols()), w);
  MatrixXd out = MatrixXd::Zero(2 * n, 2 * n);
  out.topRightCorner(n, n).setIdentity();
  out.bottomLeftCorner(n, n) = w * frame.stiffness() * w.transpose();
  out.bottomLeftCorner(n, n).diagonal() -= c.frequency.cwiseAbs2();
  for (Index i = 0; i < n; ++i)
    out.bottomRightCorner(n, n).col(i) = -w * frame.coriolis(VectorXd::Unit(n, i));
  out.bottomRightCorner(n, n).diagonal() -= c.damping;
  return out;
}
MatrixXd step_matrix(const SystemCoordinates& c, TurningFrame& frame, double seconds) {
  const Index n = c.frequency.size();
  VectorXd bq(n), bv(n), a11(n), a12(n), a21(n), a22(n);
  for (Index i = 0; i < n; ++i) {
    const Propagator a = exact_propagator(c.frequency[i], c.damping[i], seconds);
    bq[i] = a.bq, bv[i] = a.bv, a11[i] = a.a11, a12[i] = a.a12, a21[i] = a.a21, a22[i] = a.a22;
  }
  frame.set_step(seconds, bq);
  const MatrixXd one = MatrixXd::Identity(2 * n, 2 * n);
  MatrixXd z = one.topRows(n), v = one.bottomRows(n);
  MatrixXd force = MatrixXd::Zero(n, 2 * n);
  frame.add(frame.stiffness() * frame.motions(z), force);
  frame.turn(v);
  const MatrixXd old = z;
  z = a11.asDiagonal() * old + a12.asDiagonal() * v + (0.5 * bq).asDiagonal() * force;
  v = (a21.asDiagonal() * old + a22.asDiagonal() * v + (0.5 * bv).asDiagonal() * force).eval();
  const MatrixXd half = 0.5 * frame.closing(frame.motions(z));
  frame.add(half, bq, z);
  frame.add(half, bv, v);
  frame.turn(v);
  MatrixXd out(2 * n, 2 * n);
  out << z, v;
  return out;
}
// Of (w z, v), whose squares are energies.
MatrixXd balanced(const SystemCoordinates& c, const MatrixXd& of) {
  VectorXd unit = VectorXd::Ones(of.rows());
  unit.head(c.frequency.size()) = c.frequency;
  return unit.asDiagonal() * of * unit.cwiseInverse().asDiagonal();
}

SystemModel turning_train(double stiffness_of_carrier = 2e8, bool elastic_pins = true, bool corner = true,
                          const Bearing& of_ring = {}) {
  return train(kTeeth, 3, of_ring, [&](Scene& scene) {
    const auto torque = System::DriveKind::torque, held = System::DriveKind::held;
    scene.drives = {{"sun", torque, kTrainTorque, 0},
                    {"ring", held, 0, 0},
                    {"carrier", torque, -kTrainTorque * 126 / 26, 0}};
    if (stiffness_of_carrier > 0) scene.carriers[0].bearing = {stiffness_of_carrier, 4000, 5.43};
    if (!elastic_pins) scene.gears[1].bearing = {};
    for (Scene::Mesh& mesh : scene.meshes) mesh.spec.corner.enabled = corner;
  });
}

struct Turning {
  explicit Turning(SystemModel of, double eta = 1e-6, int steps = kSteps, double faster = 1)
      : system(std::move(of)), dynamics(system, motion(eta, faster)) {
    dynamics.set_positions(std::vector<double>(6, 60e-6), steps);
  }
  SystemMotion motion(double eta, double faster) const {
    SystemMotion out = motion_of(system, 4e8, eta);
    out.frame_turns = faster * frame_turns(system.layout);
    return out;
  }
  SystemModel system;
  SystemDynamics dynamics;
};

}  // namespace

TEST_CASE(
    "steps of a planet alone and of a central member: sqrt(k / m) plus and minus Omega, of second order") {
  constexpr double kMass = 0.7, kOmega = 150, kDamping = 200;
  const double w = 2 * kPi * 1600;
  for (const bool planet : {true, false})
    for (const double c : {0.0, kDamping}) {
      CAPTURE(planet);
      CAPTURE(c);
      OneBody one(planet, kMass, w, c);
      TurningFrame frame(one.layout, one.coordinates, kOmega);
      // On the ground the damper sees the frame go by, and its motion is that of the fixed frame, turned. On the pin it does not.
      const Eigen::VectorXcd exact = exact_matrix(one.coordinates, frame).eigenvalues();
      const double free = std::sqrt(w * w - c * c / 4);
      std::array<double, 2> fast{1e300, 1e300};
      for (const std::complex<double> s : exact)
        for (size_t way = 0; way < 2; ++way) {
          const double wanted = way == 0 ? free + kOmega : free - kOmega;
          fast[way] = std::min(fast[way], std::abs(s - std::complex<double>(-c / 2, wanted)));
        }
      const double within = planet && c > 0 ? c * kOmega / w : 1e-9 * w;
      for (const double off : fast) CHECK(off < within);
      const auto error = [&](double seconds) {
        const Eigen::VectorXcd step = step_matrix(one.coordinates, frame, seconds).eigenvalues();
        double worst = 0;
        for (const std::complex<double> s : exact) {
          double least = 1e300;
          for (const std::complex<double> multiplier : step)
            least = std::min(least, std::abs(std::log(multiplier) / seconds - s));
          worst = std::max(worst, least);
        }
        return worst;
      };
      // At 128 steps an oscillation the split is off by 1e-4 of what the frame changes.
      const double one_step = 1 / (1600 * 128.0), coarse = error(one_step), fine = error(one_step / 2);
      CHECK(coarse < 3e-4 * kOmega);
      CHECK(fine == relative(coarse / 4, 0.02));
      // Nothing is lost or won without a damper, however coarse the step.
      if (c == 0)
        for (const double steps : {1.3, 8.0, 128.0})
          for (const std::complex<double> m :
               balanced(one.coordinates, step_matrix(one.coordinates, frame, 1 / (1600 * steps)))
                   .eigenvalues())
            CHECK(std::abs(std::abs(m) - 1) < 1e-12);
    }
}

TEST_CASE("coordinates of a train without contact: the step against the exact exponential, of second order") {
  for (const bool pins : {true, false}) {
    CAPTURE(pins);
    const Turning rig(turning_train(2e8, pins));
    const SystemCoordinates& c = rig.dynamics.coordinates();
    constexpr double kOmega = 190;
    TurningFrame frame(rig.system.layout, c, kOmega);
    const MatrixXd a = exact_matrix(c, frame);
    // In unit modal mass Coriolis forces are skew.
    const MatrixXd skew = a.bottomRightCorner(c.size(), c.size()) + MatrixXd(c.damping.asDiagonal());
    CHECK((skew + skew.transpose()).norm() < 1e-12 * skew.norm());
    // Over a mesh period at 3 kHz, with velocities that go with the frequencies up to 3 kHz.
    VectorXd start = VectorXd::Zero(2 * c.size());
    for (Index i = 0; i < c.size(); ++i)
      if (c.frequency[i] < 2 * kPi * 3000) start[c.size() + i] = std::sin(1.0 + static_cast<double>(i));
    const VectorXd wanted = MatrixXd(a / 3000).exp() * start;
    TurningFrame still;
    const auto scaled = [&](const VectorXd& y) {
      VectorXd out = y;
      out.head(c.size()).array() *= c.frequency.array().max(1000);
      return out.norm();
    };
    VectorXd at_rest = start;
    {
      const Index n = c.size();
      for (Index i = 0; i < n; ++i) {
        const Propagator p = exact_propagator(c.frequency[i], c.damping[i], 1 / 3000.0);
        at_rest[i] = p.a11 * start[i] + p.a12 * start[n + i];
        at_rest[n + i] = p.a21 * start[i] + p.a22 * start[n + i];
      }
    }
    const double effect = scaled(at_rest - wanted) / scaled(wanted);
    const auto off = [&](int steps) {
      const MatrixXd step = step_matrix(c, frame, 1 / (3000.0 * steps));
      VectorXd y = start;
      for (int i = 0; i < steps; ++i) y = (step * y).eval();
      return scaled(y - wanted) / scaled(wanted);
    };
    const double coarse = off(64), middle = off(128), fine = off(256);
    MESSAGE("effect of the frame ", effect, ", error of 64, 128, 256 steps a period ", coarse, " ", middle,
            " ", fine);
    CHECK(effect > 0.02);
    CHECK(middle < 2e-3 * effect);
    CHECK(middle == relative(coarse / 4, 0.1));
    CHECK(fine == relative(middle / 4, 0.1));
  }
}

TEST_CASE(
    "frozen contact of an elastic train: what the turning of its carrier changes is that of rigid bodies") {
  Turning rig(turning_train(2e8, true, false));
  const std::vector<SystemSolution> statics = rest_over_period(rig.system, ContactModel::line, 8, 16);
  const SystemCoordinates& c = rig.dynamics.coordinates();
  const FixedPhaseMesh mesh = rig.dynamics.frozen(0);
  const MatrixXd stiffness =
      mesh.participation.transpose() * MatrixXd(mesh.local + mesh.residual).ldlt().solve(mesh.participation);
  const RigidSystem rigid = rigid_system(rig.system.layout, statics[0].mesh_stiffness);
  SystemCoordinates undamped = c;
  undamped.damping.setZero();
  const auto own = [&](double omega) {
    TurningFrame frame(rig.system.layout, undamped, omega);
    MatrixXd a = exact_matrix(undamped, frame);
    // Dampers on the ground left out as well.
    a.bottomLeftCorner(c.size(), c.size()) =
        (0.5 * (a.bottomLeftCorner(c.size(), c.size()) + a.bottomLeftCorner(c.size(), c.size()).transpose()))
            .eval() -
        stiffness;
    std::vector<double> f;
    for (const std::complex<double> s : a.eigenvalues())
      if (s.imag() > 1) f.push_back(s.imag() / (2 * kPi));
    std::sort(f.begin(), f.end());
    return f;
  };
  constexpr double kOmega = 190;
  const std::vector<double> still = own(1e-6), turns = own(kOmega);
  const VectorXd rest = turning_frequencies(rigid, 0), turning = turning_frequencies(rigid, kOmega);
  const Index free = (rest.array() == 0).count();
  CHECK(free == 1);
  CHECK((turning.array() == 0).count() == 1);
  // The seven lowest, by 0.6 % those of rigid bodies; of these the shift is within a tenth of the largest one.
  const double largest = (turning - rest).segment(free, 7).cwiseAbs().maxCoeff();
  CHECK(largest > 0.3 * kOmega / (2 * kPi));
  for (Index n = 0; n < 7; ++n) {
    const auto at = static_cast<size_t>(n);
    CAPTURE(n);
    CHECK(turns[at] == relative(turning[n + free], 0.008));
    CHECK(std::abs((turns[at] - still[at]) - (turning[n + free] - rest[n + free])) < 0.1 * largest);
  }
}

TEST_CASE("a frame that does not turn changes no bit of the motion") {
  SystemModel system = turning_train();
  SystemMotion motion = motion_of(system, 4e8, 1e-6);
  SystemDynamics one(system, motion);
  motion.frame_turns = frame_turns(system.layout);
  CHECK(motion.frame_turns == 0.01);
  SystemDynamics other(system, motion);
  for (SystemDynamics* d : {&one, &other}) d->set_positions(std::vector<double>(6, 60e-6), kSteps);
  const SystemDynamics::State a = one.rest(), b = other.rest();
  CHECK(a.z == b.z);
  CHECK(a.p == b.p);
  one.set_speed(2600, kSteps);
  other.set_speed(2600, kSteps);
  CHECK(one.rest().z == a.z);
  CHECK(other.rest().z != a.z);
}

TEST_CASE(
    "rest in a frame that turns: centrifugal forces are on the pins, and nothing moves that contact does not move") {
  for (const bool pins : {true, false}) {
    CAPTURE(pins);
    Turning rig(turning_train(2e8, pins, false));
    SystemDynamics& dynamics = rig.dynamics;
    const SystemDynamics::State still = dynamics.rest();
    dynamics.set_speed(2600, kSteps);
    const SystemDynamics::State turns = dynamics.rest();
    const SystemCoordinates& c = dynamics.coordinates();
    const double omega = dynamics.frame().omega();
    CHECK(omega == relative(2 * kPi * 26, 1e-12));
    if (!pins) continue;
    const System::Body& carrier = rig.system.layout.bodies[kCarrier];
    for (int b = 1; b < static_cast<int>(kRing); ++b) {
      const System::Body& planet = rig.system.layout.bodies[static_cast<size_t>(b)];
      const double mass = rig.system.body[static_cast<size_t>(b)]->body().mass;
      CHECK(c.mass[b] == mass);
      const Vec2 out(planet.centre[0] - carrier.centre[0], planet.centre[1] - carrier.centre[1]);
      const Vec2 force =
          planet.bearing.stiffness * (c.bearing_deflection(b, turns.z) - c.bearing_deflection(b, still.z));
      // The loads of its meshes follow from the torques, so that the pin alone holds it, over the way by which it gives way, too.
      const double part = force.dot(out.normalized()) / (mass * omega * omega * out.norm());
      CHECK(part == relative(1 + mass * omega * omega / planet.bearing.stiffness, 1e-5));
    }
  }
}

TEST_CASE(
    "forces on pins of a periodic motion: centrifugal forces come to the mean, nothing to bearings of central members") {
  for (const bool pins : {true, false}) {
    CAPTURE(pins);
    const auto means = [&](double faster) {
      Turning rig(turning_train(2e8, pins, false), 1e-6, kSteps, faster);
      SystemPeriodMap map(rig.dynamics, kSteps);
      map.set_parameter(2600);
      const PeriodicMotion motion = iterate_to_orbit(map, map.flat(rig.dynamics.rest()), {1e-11, 3000, true});
      REQUIRE(motion.multiple == 1);
      map.apply(motion.state);
      std::vector<Vec2> out;
      for (const Eigen::Matrix2Xd& force : map.period().bearing_force)
        out.emplace_back(force.rowwise().mean());
      return out;
    };
    const std::vector<Vec2> still = means(0), turns = means(1);
    const SystemModel system = turning_train(2e8, pins);
    const System::Body& carrier = system.layout.bodies[kCarrier];
    const double omega = 2 * kPi * 26;
    for (size_t b = 1; b < kRing; ++b) {
      const System::Body& planet = system.layout.bodies[b];
      const Vec2 place(planet.centre[0] - carrier.centre[0], planet.centre[1] - carrier.centre[1]),
          wanted = system.body[b]->body().mass * omega * omega * place;
      CHECK((turns[b] - still[b] - wanted).norm() < 2e-3 * wanted.norm());
    }
    for (const size_t b : {size_t{0}, kCarrier}) CHECK(turns[b].norm() < 1e-3 * turns[1].norm());
  }
}

TEST_CASE(
    "energy in a frame that turns: closes with contact loss, centrifugal work comes back, dampers on the ground drag") {
  for (const bool pins : {true, false}) {
    CAPTURE(pins);
    Turning rig(turning_train(2e8, pins), 1e-6, kSteps, 3);
    SystemDynamics& dynamics = rig.dynamics;
    SystemDynamics::Period period;
    EnergyBalance energy;
    dynamics.set_speed(7000, kSteps);
    SystemDynamics::State state = dynamics.rest();
    for (int n = 0; n < 20; ++n) REQUIRE(dynamics.integrate(state, period));
    int parted = 0;
    for (int n = 0; n < 5; ++n) {
      energy = {};
      REQUIRE(dynamics.integrate(state, period, &energy));
      parted += static_cast<int>((period.mesh_force.array() == 0).count());
      CHECK(energy.imbalance < 1e-11 * energy.throughput);
      CHECK(std::abs(energy.centrifugal) > 1e-9 * energy.throughput);
      CHECK(std::abs(energy.dragging[0]) > 0);
      CHECK(std::abs(energy.dragging[kCarrier]) > 0);
      CHECK(energy.dragging.segment(1, 3).norm() == 0);
      CHECK(energy.dragging[kRing] == 0);
    }
    CHECK((parted > 0) == pins);
    // A periodic motion gets back what centrifugal forces took.
    SystemPeriodMap map(dynamics, kSteps);
    map.set_parameter(2600);
    const PeriodicMotion motion = iterate_to_orbit(map, map.flat(dynamics.rest()), {1e-11, 3000, true});
    REQUIRE(motion.multiple == 1);
    state = map.state(motion.state);
    energy = {};
    REQUIRE(dynamics.integrate(state, period, &energy));
    CHECK(energy.imbalance < 1e-11 * energy.throughput);
    CHECK(std::abs(energy.centrifugal) < 1e-8 * energy.throughput);
  }
}

TEST_CASE("the tangent of the period map has the forces of the frame") {
  for (const bool pins : {true, false}) {
    CAPTURE(pins);
    Turning rig(turning_train(2e8, pins), 1e-6, kSteps, 5);
    SystemPeriodMap map(rig.dynamics, kSteps);
    map.set_parameter(2600);
    const PeriodicMotion motion = iterate_to_orbit(map, map.flat(rig.dynamics.rest()), {1e-10, 3000, true});
    REQUIRE(motion.multiple == 1);
    check_tangent(map, motion.state, 2 * rig.dynamics.coordinates().size());
  }
}

TEST_CASE(
    "Coriolis forces move what they should: harmonics of a central member change by the first order of Omega") {
  const auto moved = [](double faster) {
    Turning rig(turning_train(2e8, true, false), 1e-6, kSteps, faster);
    SystemPeriodMap map(rig.dynamics, kSteps);
    map.set_parameter(2600);
    const PeriodicMotion motion = iterate_to_orbit(map, map.flat(rig.dynamics.rest()), {1e-11, 3000, true});
    REQUIRE(motion.multiple == 1);
    map.apply(motion.state);
    return map.period().bearing_force[0];
  };
  const Eigen::Matrix2Xd still = moved(0), one = moved(0.5), two = moved(1), back = moved(-1);
  const double first = (one - still).norm(), second = (two - still).norm();
  CHECK(first > 1e-3 * still.norm());
  CHECK(second == relative(2 * first, 0.1));
  CHECK(((two - still) + (back - still)).norm() < 0.2 * second);
}

TEST_CASE("bearings that do not hold their bodies in the frame are named by the speed") {
  Turning rig(turning_train(2e8, true), 1e-6, kSteps, 400);
  rig.dynamics.set_speed(2600, kSteps);
  CHECK(names(message_of([&] { rig.dynamics.rest(); }), {"2600", "bearing"}));
}
