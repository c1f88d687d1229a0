// Period maps: that of two elastic gears is what integrate() does; tangents against central differences; multipliers that do
// not depend on where the period is cut; Newton's method on both.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "base/dense.h"
#include "dynamics/period_map.h"
#include "lumped/period_map.h"
#include "lumped/stiffness.h"
#include "orbits/branch.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"

using namespace whine;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using State = RollingDynamics::State;

namespace {

struct Kind {
  BodyModel body;
  ContactModel contact;
  Integrator integrator;
};

// The paper's pair at 150 N m, 7 % of damping, 128 steps.
struct Rig {
  explicit Rig(const Kind& kind, double eta = 5.5e-6)
      : statics(static_transmission(paper_body(), paper_body(), paper_statics(128), 150)),
        model(paper_body(), paper_body(), statics.mesh),
        dynamics(model, parameters(statics, kind, eta)) {
    dynamics.set_zone(candidate_zone(model, statics, MotionBounds(model, statics, 2.56)), 128);
  }
  static DynamicParameters parameters(const StaticResult& statics, const Kind& kind, double eta) {
    DynamicParameters p = paper_parameters(statics.mean_stiffness, kind.body, kind.contact);
    p.damping.rayleigh_stiffness = eta;
    p.fidelity.integrator = kind.integrator;
    return p;
  }
  // After so many periods from rest.
  State after(int periods) {
    State state = dynamics.rest();
    for (int i = 0; i < periods; ++i) REQUIRE(dynamics.integrate(state, period));
    return state;
  }
  StaticResult statics;
  GearMeshModel model;
  RollingDynamics dynamics;
  RollingDynamics::Period period;
};

// A direction of unit length, the same in every run.
VectorXd direction(int size, int which) {
  VectorXd d(size);
  for (int i = 0; i < size; ++i) d[i] = std::sin(1.0 + 2.3 * i * (which + 1) + which);
  return d / d.norm();
}

std::vector<std::complex<double>> largest(const MatrixXd& tangent, int count) {
  const Eigen::VectorXcd values = general_eigenvalues(tangent).values;
  std::vector<std::complex<double>> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end(), [](auto a, auto b) {
    return std::abs(a) != std::abs(b) ? std::abs(a) > std::abs(b) : a.imag() > b.imag();
  });
  sorted.resize(count);
  return sorted;
}

// Newton's method on y = P(y): residuals.
std::vector<double> newton(PeriodMap& map, VectorXd& y, int steps) {
  std::vector<double> residual;
  for (int i = 0; i < steps; ++i) {
    const VectorXd change = map.apply(y) - y;
    residual.push_back(change.norm());
    y += lu_solve(MatrixXd::Identity(map.size(), map.size()) - map.tangent(), change);
  }
  return residual;
}

const Kind kKinds[] = {{BodyModel::modal, ContactModel::strips, Integrator::exact},
                       {BodyModel::modal, ContactModel::strips, Integrator::newmark},
                       {BodyModel::modal, ContactModel::line, Integrator::exact},
                       {BodyModel::relaxed, ContactModel::strips, Integrator::exact},
                       {BodyModel::relaxed, ContactModel::line, Integrator::newmark},
                       {BodyModel::quasi_static, ContactModel::strips, Integrator::exact},
                       {BodyModel::rigid, ContactModel::strips, Integrator::exact}};

}  // namespace

TEST_CASE("period map: of two gears it is integrate(), whatever period it starts with") {
  for (const Kind& kind : kKinds) {
    Rig rig(kind);
    RollingPeriodMap map(rig.dynamics, 128);
    map.set_parameter(2400);
    for (int periods : {0, 1, 5}) {
      State state = rig.after(periods);
      VectorXd y = map.flat(state);
      for (int i = 0; i < 3; ++i) {
        REQUIRE(rig.dynamics.integrate(state, rig.period));
        y = map.apply(y);
      }
      INFO(kind.body << ", " << kind.contact << ", after " << periods << " periods: " << y.size()
                     << " numbers");
      CHECK((map.flat(state) - y).norm() < 1e-11 * y.norm());
      CHECK(y.norm() > 0.5);
      CHECK(y.norm() < 50);
    }
  }
}

TEST_CASE("period map: the tangent of two gears is that of central differences where no set changes") {
  for (const Kind& kind : kKinds)
    for (const double f : {2400.0, 1100.0}) {
      Rig rig(kind);
      RollingPeriodMap map(rig.dynamics, 128);
      map.set_parameter(f);
      const VectorXd y = map.flat(rig.after(4));
      map.apply(y);
      const auto sets = map.active_sets();
      const MatrixXd tangent = map.tangent();
      REQUIRE(tangent.rows() == map.size());
      double worst = 0;
      int compared = 0;
      const int n = map.size();
      const auto compare = [&](const VectorXd& d) {
        // Sets that are right beyond doubt stay in some neighbourhood.
        for (double step = 1e-3; step > 1e-8; step *= 0.3) {
          const VectorXd plus = map.apply(y + step * d);
          if (map.active_sets() != sets) continue;
          const VectorXd minus = map.apply(y - step * d);
          if (map.active_sets() != sets) continue;
          // Hertz's law bends.
          if (kind.contact == ContactModel::line && step > 2e-6) continue;
          const VectorXd own = tangent * d;
          worst = std::max(worst, ((plus - minus) / (2 * step) - own).norm() / own.norm());
          ++compared;
          return;
        }
      };
      for (int i = 0; i < 6; ++i) compare(direction(n, i));
      for (const int i : {0, 1, n / 4, n / 2, n / 2 + 1, n - 8, n - 1})
        if (tangent.col(i).norm() > 1e-3) compare(VectorXd::Unit(n, i));
      INFO(kind.body << ", " << kind.contact << ", " << kind.integrator << " at " << f << " Hz: " << n
                     << " numbers, worst of " << compared << " directions " << worst);
      CHECK(compared >= 6);
      CHECK(worst < 1e-6);
    }
}

TEST_CASE("period map: Newton's method converges on orbits, of lines quadratically") {
  for (const Kind& kind : kKinds) {
    // Without relaxation hardly anything damps the pair.
    if (kind.body == BodyModel::quasi_static || kind.body == BodyModel::rigid) continue;
    Rig rig(kind, 1e-5);
    RollingPeriodMap map(rig.dynamics, 128);
    for (const double f : {2000.0, 3100.0}) {
      map.set_parameter(f);
      VectorXd y = map.flat(rig.after(60));
      const std::vector<double> residual = newton(map, y, 8);
      std::string all;
      for (double r : residual) all += text(" ", r);
      INFO(kind.body << ", " << kind.contact << ", " << kind.integrator << " at " << f << " Hz:" << all);
      CHECK(residual.back() < 1e-11);
      // Quadratic while the sets stay: of lines from any step that is small enough to the next.
      if (kind.contact == ContactModel::line)
        for (size_t i = 0; i + 1 < residual.size(); ++i)
          if (residual[i] < 1e-3 && residual[i] > 1e-9) CHECK(residual[i + 1] < 1e-3 * residual[i]);
    }
  }
}

TEST_CASE("period map: multipliers of an orbit do not depend on where its period is cut") {
  for (const Kind& kind : {kKinds[0], kKinds[2], kKinds[5]}) {
    Rig rig(kind);
    RollingPeriodMap map(rig.dynamics, 128);
    map.set_parameter(2000);
    VectorXd y = map.flat(rig.after(60));
    newton(map, y, 8);
    map.apply(y);
    const auto whole = largest(map.tangent(), 4);
    CHECK(std::abs(whole[0]) > 0.05);
    for (const int cut : {1, 17, 64, 127}) {
      const auto other = largest(map.tangent_from(cut), 4);
      for (size_t k = 0; k < whole.size(); ++k) {
        INFO(kind.body << ", " << kind.contact << ", cut at step " << cut << ": " << other[k].real() << " "
                       << other[k].imag() << " i beside " << whole[k].real() << " " << whole[k].imag()
                       << " i");
        CHECK(std::abs(other[k] - whole[k]) < 1e-8);
      }
    }
  }
}

TEST_CASE("period map: the verdict is that of any cut at 50 orbits of a branch") {
  Rig rig(kKinds[0], 5.5e-6);
  RollingPeriodMap map(rig.dynamics, 128);
  map.set_parameter(2900);
  const OrbitSearch first = newton_orbit(map, map.flat(rig.after(60)));
  REQUIRE(first.found());
  BranchSettings settings;
  settings.low = 1700;
  settings.high = 2950;
  settings.scale = 2400;
  settings.largest_step = 0.15;
  settings.grazing_location = 1;
  settings.location = 1e-3;
  const OrbitBranch branch = follow_branch(map, first.orbit, -1, settings);
  int unstable = 0, compared = 0;
  for (const BranchPosition& p : branch.points) {
    if (compared == 40) break;
    map.set_parameter(p.parameter);
    map.apply(p.start);
    // Where cuts of the period in 2, 3 and 5 begin.
    for (const int cut : {64, 43, 85, 26, 77}) {
      const auto other = largest(map.tangent_from(cut), 1)[0];
      CHECK(std::abs(std::abs(other) - std::abs(p.multipliers[0])) < 1e-5);
      CHECK((std::abs(other) < 1) == p.stable());
    }
    unstable += !p.stable();
    ++compared;
  }
  MESSAGE(unstable << " of " << compared << " orbits are unstable");
  CHECK(compared == 40);
  CHECK(unstable >= 5);
}

TEST_CASE("period map: the tangent times directions is the tangent's product") {
  for (const Kind& kind : kKinds) {
    Rig rig(kind);
    RollingPeriodMap map(rig.dynamics, 128);
    map.set_parameter(2400);
    map.apply(map.flat(rig.after(4)));
    MatrixXd directions(map.size(), 11);
    for (int k = 0; k < 11; ++k) directions.col(k) = direction(map.size(), k);
    const MatrixXd product = map.tangent() * directions;
    CHECK((map.tangent_times(directions) - product).norm() < 1e-12 * product.norm());
  }
}

TEST_CASE("period map: contact that leaves its zone is rejected") {
  Rig rig(kKinds[0]);
  RollingPeriodMap map(rig.dynamics, 128);
  map.set_parameter(2400);
  VectorXd y = map.flat(rig.after(1));
  y[0] *= 20;
  CHECK(failure_of([&] { map.apply(y); }) == Failure::numerical);
  CHECK(map.take_left_zone());
  CHECK(!map.take_left_zone());
}

// With tip edges that touch at any angle, pairs beside the line of action come into a wider zone.
TEST_CASE("period map: a state is of the zone of its map, and goes into a wider one decoded") {
  StaticParameters at_rest = paper_statics(128);
  at_rest.mesh.corner = {};
  const StaticResult statics = static_transmission(paper_body(), paper_body(), at_rest, 50);
  const GearMeshModel model(paper_body(), paper_body(), statics.mesh);
  RollingDynamics dynamics(model, Rig::parameters(statics, kKinds[0], 5.5e-6));
  const auto widen = [&](double by) {
    dynamics.set_zone(candidate_zone(model, statics, MotionBounds(model, statics, by)), 128);
  };
  widen(1);
  RollingPeriodMap map(dynamics, 128);
  map.set_parameter(1000);
  const VectorXd y = map.flat(dynamics.rest());
  State state = map.state(y);
  CHECK(failure_of([&] { map.state(y.head(y.size() - 1)); }) == Failure::numerical);
  widen(6);
  CHECK(failure_of([&] { map.state(y); }) == Failure::numerical);
  RollingPeriodMap wider(dynamics, 128);
  wider.set_parameter(1000);
  CHECK(wider.size() > map.size());
  RollingDynamics::Period period;
  REQUIRE(dynamics.integrate(state, period));
  CHECK(wider.flat(state).allFinite());
}

TEST_CASE("period map: of a lumped oscillator, its tangent and the borders that it crosses") {
  LumpedParameters p = cells_of(RectangularWave{335596523.71, 504267825.43, 0, 0.75});
  p.mass = 1.4;
  p.damping_ratio = 0.08;
  p.damper = 2 * 0.08 * std::sqrt(462.1e6 * 1.4);
  p.damper_acts = DamperActs::always;
  LumpedOscillator oscillator(p, 150 / 0.0704769466, 64);
  LumpedPeriodMap map(oscillator);
  map.set_parameter(2700);
  // The branch with contact loss.
  VectorXd y = Eigen::Vector2d(4, 0);
  for (int i = 0; i < 60; ++i) y = map.apply(y);
  const auto residual = newton(map, y, 6);
  CHECK(residual.back() < 1e-13);
  map.apply(y);
  const MatrixXd tangent = map.tangent();
  const auto events = map.events();
  REQUIRE(events.size() == 2);
  CHECK(events[0].closes != events[1].closes);
  CHECK(events[0].phase < events[1].phase);
  const VectorXd x = map.observable();
  // Apart from the sample after it parts to that before it touches again.
  for (const ContactEvent& event : events) {
    const int i = static_cast<int>(event.phase * 64);
    CHECK((x[i] > 0) == !event.closes);
    CHECK((x[(i + 1) % 64] > 0) == event.closes);
  }
  for (int k = 0; k < 2; ++k) {
    const VectorXd d = 1e-6 * VectorXd::Unit(2, k);
    const VectorXd difference = (map.apply(y + d) - map.apply(y - d)) / 2e-6;
    CHECK((difference - tangent.col(k)).norm() < 1e-7 * tangent.norm());
  }
}
