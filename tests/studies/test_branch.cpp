// Orbits and branches over small maps with known answers, over the lumped pair with its exact folds, and over the elastic pair:
// stable orbits against integration, unstable ones against the residual and differences of the map.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"
#include "dynamics/period_map.h"
#include "dynamics/steady_state.h"
#include "io/artifacts.h"
#include "lumped/period_map.h"
#include "lumped/stiffness.h"
#include "lumped_wave.h"
#include "orbits/branch.h"
#include "own_folder.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "results/branch.h"
#include "results/response.h"
#include "results/static.h"
#include "signal/jump_cause.h"
#include "signal/response.h"
#include "studies/branch.h"
#include "studies/branch_follower.h"
#include "studies/sweep.h"

using namespace whine;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// A map given by functions.
class SmallMap : public PeriodMap {
 public:
  using Image = std::function<VectorXd(const VectorXd& y, double parameter, MatrixXd& tangent,
                                       std::vector<ContactEvent>& events)>;
  SmallMap(int size, Image image) : size_(size), image_(std::move(image)) {}
  int size() const override { return size_; }
  void set_parameter(double value) override { parameter_ = value; }
  double parameter() const override { return parameter_; }
  VectorXd apply(const VectorXd& y) override {
    events_.clear();
    observable_ = y.head(1);
    return image_(y, parameter_, tangent_, events_);
  }
  MatrixXd tangent() override { return tangent_; }
  std::vector<ContactEvent> events() const override { return events_; }
  VectorXd observable() const override { return observable_; }

 private:
  int size_;
  Image image_;
  double parameter_ = 0;
  MatrixXd tangent_;
  VectorXd observable_;
  std::vector<ContactEvent> events_;
};

// One step of Runge and Kutta's method of x' = f(x) and of its tangent.
template <class Field, class Slope>
void runge_kutta(VectorXd& x, MatrixXd& phi, double h, const Field& f, const Slope& slope) {
  const VectorXd k1 = f(x), k2 = f(x + 0.5 * h * k1), k3 = f(x + 0.5 * h * k2), k4 = f(x + h * k3);
  const MatrixXd p1 = slope(x) * phi, p2 = slope(x + 0.5 * h * k1) * (phi + 0.5 * h * p1),
                 p3 = slope(x + 0.5 * h * k2) * (phi + 0.5 * h * p2), p4 = slope(x + h * k3) * (phi + h * p3);
  x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  phi += h / 6 * (p1 + 2 * p2 + 2 * p3 + p4);
}

// Lur'e's oscillator x''' = -a x'' - x' - x + x^2, from one rise of x' through 0 to the next: (x, x'').
SmallMap lure() {
  return {2, [](const VectorXd& y, double a, MatrixXd& tangent, std::vector<ContactEvent>&) {
            const auto field = [a](const VectorXd& s) -> VectorXd {
              return Eigen::Vector3d(s[1], s[2], -a * s[2] - s[1] - s[0] + s[0] * s[0]);
            };
            const auto slope = [a](const VectorXd& s) -> MatrixXd {
              Eigen::Matrix3d m;
              m << 0, 1, 0, 0, 0, 1, -1 + 2 * s[0], -1, -a;
              return m;
            };
            VectorXd s = Eigen::Vector3d(y[0], 0, y[1]);
            MatrixXd phi = MatrixXd::Identity(3, 3);
            constexpr double kStep = 0.004;
            for (int i = 0; i < 5000; ++i) {
              const VectorXd before = s;
              const MatrixXd phi_before = phi;
              runge_kutta(s, phi, kStep, field, slope);
              if (!s.allFinite() || s.norm() > 100) fail(Failure::numerical, "the oscillator runs away");
              if (i < 100 || !(before[1] < 0 && s[1] >= 0)) continue;
              double h = kStep * before[1] / (before[1] - s[1]);
              for (int k = 0; k < 20; ++k) {
                s = before;
                phi = phi_before;
                runge_kutta(s, phi, h, field, slope);
                h -= s[1] / s[2];
              }
              const Eigen::Vector3d f = field(s);
              const MatrixXd on_section = phi - f * phi.row(1) / f[1];
              tangent.resize(2, 2);
              tangent << on_section(0, 0), on_section(0, 2), on_section(2, 0), on_section(2, 2);
              return VectorXd(Eigen::Vector2d(s[0], s[2]));
            }
            fail(Failure::numerical, "no return to the section");
          }};
}

// x'' + c x' + x = A cos t with a wall at x = 1 that gives back 0.8 of the velocity: over 2 pi, parameter A.
SmallMap impact_oscillator(double c) {
  return {2, [c](const VectorXd& y, double a, MatrixXd& tangent, std::vector<ContactEvent>& events) {
            constexpr double kBack = 0.8, kPeriod = 2 * std::numbers::pi;
            const double s = 0.5 * c, w = std::sqrt(1 - s * s);
            // A particular motion is A / c sin t.
            const auto flow = [&](const Eigen::Vector2d& from, double t0, double t, Eigen::Matrix2d* phi) {
              const Eigen::Vector2d at(a / c * std::sin(t0), a / c * std::cos(t0)),
                  next(a / c * std::sin(t0 + t), a / c * std::cos(t0 + t));
              const double e = std::exp(-s * t), co = e * std::cos(w * t), si = e * std::sin(w * t) / w;
              Eigen::Matrix2d m;
              m << co + s * si, si, -si, co - s * si;
              if (phi) *phi = m;
              return Eigen::Vector2d(m * (from - at) + next);
            };
            Eigen::Vector2d x = y;
            Eigen::Matrix2d whole = Eigen::Matrix2d::Identity(), phi;
            constexpr int kParts = 2000;
            constexpr double kStep = kPeriod / kParts;
            double t = 0;
            for (int i = 0; i < kParts; ++i) {
              double left = (i + 1) * kStep - t;
              // The highest point of the part, where its velocity changes its sign, tells a grazing contact.
              const auto time_of = [&](auto value, double low, double high) {
                for (int k = 0; k < 60; ++k) {
                  const double mid = 0.5 * (low + high);
                  (value(flow(x, t, mid, nullptr)) > 0 ? low : high) = mid;
                }
                return high;
              };
              for (int n = 0;; ++n) {
                if (n > 100) fail(Failure::numerical, "it chatters");
                const Eigen::Vector2d end = flow(x, t, left, nullptr);
                double top = left;
                if (x[1] > 0 && end[1] < 0) top = time_of([](const auto& z) { return z[1]; }, 0, left);
                if (!(flow(x, t, top, nullptr)[0] > 1) || !(x[1] > 0)) break;
                const double hit = time_of([](const auto& z) { return 1 - z[0]; }, 0, top);
                Eigen::Vector2d at = flow(x, t, hit, &phi);
                t += hit;
                left -= hit;
                const double force = a * std::cos(t), before = at[1], after = -kBack * before;
                Eigen::Matrix2d saltation;
                saltation << -kBack, 0,
                    ((force - c * after - at[0]) + kBack * (force - c * before - at[0])) / before, -kBack;
                whole = saltation * phi * whole;
                x = Eigen::Vector2d(1, after);
                events.push_back({1, true, t / kPeriod});
              }
              x = flow(x, t, left, &phi);
              whole = phi * whole;
              t = (i + 1) * kStep;
            }
            tangent = whole;
            return VectorXd(x);
          }};
}

PeriodicOrbit orbit_at(PeriodMap& map, const VectorXd& start, double parameter, int multiple = 1) {
  map.set_parameter(parameter);
  const OrbitSearch search = newton_orbit(map, start, multiple);
  INFO(search.failure);
  REQUIRE(search.found());
  return search.orbit;
}

std::vector<SpecialPoint> of_kind(const OrbitBranch& branch, Special kind) {
  std::vector<SpecialPoint> all;
  for (const SpecialPoint& p : branch.special)
    if (p.kind == kind) all.push_back(p);
  return all;
}

}  // namespace

TEST_CASE("orbits: Lur'e's oscillator doubles its period where its multiplier is -1") {
  SmallMap map = lure();
  const PeriodicOrbit orbit = orbit_at(map, Eigen::Vector2d(-0.3744950861, 0.5887162919), 0.66);
  CHECK(orbit.residual < 1e-11);
  BranchSettings settings;
  settings.low = 0.6;
  settings.high = 0.7;
  const OrbitBranch branch = follow_branch(map, orbit, -1, settings);
  INFO(branch.end);
  CHECK(branch.reached_limit);
  CHECK(branch.points.back().parameter == relative(0.6, 1e-12));
  CHECK(of_kind(branch, Special::fold).empty());
  const auto flips = of_kind(branch, Special::flip);
  REQUIRE(flips.size() == 1);
  CHECK(flips[0].smooth);
  CHECK(flips[0].parameter == relative(0.6303020062, 2e-10));
  CHECK(flips[0].width < 1e-8);
  CHECK(flips[0].start[0] == relative(-0.3744950861, 1e-8));
  CHECK(flips[0].start[1] == relative(0.5887162919, 1e-8));
  CHECK(branch.points.front().stable());
  CHECK(!branch.points.back().stable());
  const PeriodicOrbit at = orbit_at(map, flips[0].start, flips[0].parameter);
  const Eigen::VectorXcd multipliers = at.multipliers();
  CHECK(multipliers[0].real() == relative(-1, 1e-8));
  // Of all three multipliers the product is e^(-a T), T = 6.3640713394 (Liouville); those of the orbit itself are 1 and -1.
  CHECK(multipliers[1].real() == relative(-std::exp(-flips[0].parameter * 6.3640713394), 1e-7));
  CHECK(multipliers[1].real() == relative(-0.0181100738, 1e-7));
  // Beyond it there is an orbit of two periods, and it is stable.
  map.set_parameter(0.62);
  VectorXd y = branch.points.back().start;
  for (int i = 0; i < 400; ++i) y = map.apply(y);
  const PeriodicOrbit twice = orbit_at(map, y, 0.62, 2);
  CHECK(std::abs(twice.multipliers()[0]) < 1);
  CHECK((map.apply(twice.start) - twice.start).norm() > 1e-2);
}

TEST_CASE(
    "orbits: at a flip the branch of twice the periods is switched to, and at its flip that of four times") {
  // The logistic map y -> p y (1 - y): flips at 3 and at 1 + sqrt(6); orbits of two periods in closed form.
  SmallMap map(1, [](const VectorXd& y, double p, MatrixXd& tangent, std::vector<ContactEvent>&) {
    tangent = MatrixXd::Constant(1, 1, p * (1 - 2 * y[0]));
    return VectorXd(VectorXd::Constant(1, p * y[0] * (1 - y[0])));
  });
  BranchSettings settings;
  settings.low = 2.5;
  settings.high = 3.5;
  const OrbitBranch once = follow_branch(map, orbit_at(map, VectorXd::Constant(1, 0.6), 2.5), 1, settings);
  const auto first = of_kind(once, Special::flip);
  REQUIRE(first.size() == 1);
  CHECK(first[0].parameter == relative(3, 1e-9));
  const OrbitSearch two = orbit_beyond_flip(map, first[0], 1, 1);
  INFO(two.failure);
  REQUIRE(two.found());
  settings.multiple = 2;
  const OrbitBranch twice = follow_branch(map, two.orbit, 1, settings);
  for (const BranchPosition& at : twice.points) {
    const double p = at.parameter, y = at.start[0];
    CHECK(std::abs(p * p * y * y - p * (p + 1) * y + p + 1) < 1e-8);
    // The product of both slopes.
    CHECK(at.multipliers[0].real() == relative(4 + 2 * p - p * p, 1e-6));
  }
  const auto second = of_kind(twice, Special::flip);
  REQUIRE(second.size() == 1);
  CHECK(second[0].parameter == relative(1 + std::sqrt(6.0), 1e-8));
  const OrbitSearch four = orbit_beyond_flip(map, second[0], 2, 1);
  INFO(four.failure);
  REQUIRE(four.found());
  CHECK(four.orbit.multiple == 4);
  CHECK(std::abs(four.orbit.multipliers()[0]) < 1);
  CHECK((image(map, four.orbit.start, 2) - four.orbit.start).norm() > 1e-3);
  // Lur'e's oscillator: the orbit of two turns is the one that integration settles into.
  SmallMap oscillator = lure();
  BranchSettings turns;
  turns.low = 0.6;
  turns.high = 0.7;
  const OrbitBranch turn = follow_branch(
      oscillator, orbit_at(oscillator, Eigen::Vector2d(-0.3744950861, 0.5887162919), 0.66), -1, turns);
  const auto flips = of_kind(turn, Special::flip);
  REQUIRE(flips.size() == 1);
  const OrbitSearch doubled = orbit_beyond_flip(oscillator, flips[0], 1, 1);
  INFO(doubled.failure);
  REQUIRE(doubled.found());
  CHECK(doubled.orbit.parameter < flips[0].parameter);
  CHECK(std::abs(doubled.orbit.multipliers()[0]) < 1);
}

TEST_CASE("orbits: a branch that closes on itself ends there, with both folds of the isola") {
  // Fixed points y^2 + (p - 1)^2 = 0.04, stable below 0.
  SmallMap map(1, [](const VectorXd& y, double p, MatrixXd& tangent, std::vector<ContactEvent>&) {
    tangent = MatrixXd::Constant(1, 1, 1 + 0.6 * y[0]);
    return VectorXd(VectorXd::Constant(1, y[0] + 0.3 * (y[0] * y[0] + (p - 1) * (p - 1) - 0.04)));
  });
  const PeriodicOrbit from = orbit_at(map, VectorXd::Constant(1, -0.2), 1);
  BranchSettings settings;
  settings.low = 0.5;
  settings.high = 1.5;
  settings.stop = [&](const BranchPosition& last, const BranchPosition& next) {
    return std::string(passes(last, next, from.start, from.parameter, settings.scale) ? "closed" : "");
  };
  const OrbitBranch branch = follow_branch(map, from, 1, settings);
  CHECK(branch.stopped);
  CHECK(branch.end == "closed");
  // Once round, the last step beyond the start.
  const double round = 2 * std::numbers::pi * 0.2;
  CHECK(branch.points.back().arc > 0.97 * round);
  CHECK(branch.points.back().arc < round + settings.largest_step);
  const auto folds = of_kind(branch, Special::fold);
  REQUIRE(folds.size() == 2);
  CHECK(folds[0].parameter == relative(1.2, 1e-9));
  CHECK(folds[1].parameter == relative(0.8, 1e-9));
  for (const BranchPosition& p : branch.points) CHECK(p.stable() == (p.start[0] < 0));
}

TEST_CASE("orbits: the branch of twice the periods between two flips ends at the other one") {
  // y -> m y + y^3 with m = (p - 1)^2 - 1.1: orbits +-y with y^2 + (p - 1)^2 = 0.1, whose multiplier is (3 + 2 m)^2.
  SmallMap map(1, [](const VectorXd& y, double p, MatrixXd& tangent, std::vector<ContactEvent>&) {
    const double m = (p - 1) * (p - 1) - 1.1;
    tangent = MatrixXd::Constant(1, 1, m + 3 * y[0] * y[0]);
    return VectorXd(VectorXd::Constant(1, m * y[0] + std::pow(y[0], 3)));
  });
  BranchSettings settings;
  settings.low = 0.5;
  settings.high = 1.5;
  const OrbitBranch once = follow_branch(map, orbit_at(map, VectorXd::Zero(1), 0.5), 1, settings);
  const auto flips = of_kind(once, Special::flip);
  REQUIRE(flips.size() == 2);
  CHECK(flips[0].parameter == relative(1 - std::sqrt(0.1), 1e-9));
  const OrbitSearch beside = orbit_beyond_flip(map, flips[0], 1, 1);
  REQUIRE(beside.found());
  settings.multiple = 2;
  settings.stop = [](const BranchPosition& last, const BranchPosition& next) {
    return std::string(becomes_half(last, next) ? "half" : "");
  };
  const OrbitBranch twice = follow_branch(map, beside.orbit, 1, settings);
  CHECK(twice.end == "half");
  CHECK(twice.points.back().parameter == relative(flips[1].parameter, 0.02));
  for (const BranchPosition& p : twice.points) {
    const double off = p.parameter - 1, m = off * off - 1.1;
    CHECK(std::abs(p.start[0] * p.start[0] + off * off - 0.1) < 1e-8);
    CHECK(p.multipliers[0].real() == relative(std::pow(3 + 2 * m, 2), 1e-5));
  }
}

TEST_CASE("orbits: an oscillator grazes its wall where its free motion reaches it") {
  SmallMap map = impact_oscillator(0.1);
  const PeriodicOrbit orbit = orbit_at(map, Eigen::Vector2d(0, 0.5), 0.05);
  CHECK(orbit.start[1] == relative(0.5, 1e-12));
  CHECK(orbit.events.empty());
  BranchSettings settings;
  settings.low = 0.04;
  settings.high = 0.12;
  const OrbitBranch branch = follow_branch(map, orbit, 1, settings);
  const auto grazing = of_kind(branch, Special::grazing);
  INFO(branch.end);
  REQUIRE(!grazing.empty());
  CHECK(grazing[0].parameter == relative(0.1, 1e-6));
  CHECK(grazing[0].comes);
  CHECK(grazing[0].event.contact == 1);
  CHECK(grazing[0].event.phase == relative(0.25, 1e-3));
  for (const BranchPosition& p : branch.points)
    if (p.parameter < 0.0999) CHECK(p.stable());
}

TEST_CASE("orbits: Mathieu's first tongue, between two characteristic values") {
  // x'' + (a - 2 q cos 2 t) x = 0 over pi; on the tongue's bounds a multiplier is -1.
  constexpr double q = 0.1;
  SmallMap map(2, [](const VectorXd& y, double a, MatrixXd& tangent, std::vector<ContactEvent>&) {
    VectorXd s = VectorXd::Zero(3);
    MatrixXd phi = MatrixXd::Identity(3, 3);
    const auto slope = [a](const VectorXd& at) -> MatrixXd {
      Eigen::Matrix3d m;
      m << 0, 1, 0, -(a - 2 * q * std::cos(2 * at[2])), 0, 0, 0, 0, 0;
      return m;
    };
    const auto field = [](const VectorXd&) -> VectorXd { return Eigen::Vector3d(0, 0, 1); };
    constexpr int kSteps = 1000;
    for (int i = 0; i < kSteps; ++i) runge_kutta(s, phi, std::numbers::pi / kSteps, field, slope);
    tangent = phi.topLeftCorner(2, 2);
    return VectorXd(tangent * y);
  });
  const PeriodicOrbit orbit = orbit_at(map, VectorXd::Zero(2), 0.7);
  BranchSettings settings;
  settings.low = 0.6;
  settings.high = 1.3;
  const OrbitBranch branch = follow_branch(map, orbit, 1, settings);
  CHECK(branch.reached_limit);
  const auto series = [](double x) {
    return 1 + x - x * x / 8 - std::pow(x, 3) / 64 - std::pow(x, 4) / 1536 + 11 * std::pow(x, 5) / 36864;
  };
  const auto flips = of_kind(branch, Special::flip);
  REQUIRE(flips.size() == 2);
  CHECK(flips[0].parameter == relative(series(-q), 1e-9));
  CHECK(flips[1].parameter == relative(series(q), 1e-9));
  for (const BranchPosition& p : branch.points) {
    CHECK((std::abs(p.multipliers[0]) > 1 + 1e-9) ==
          (p.parameter > flips[0].parameter && p.parameter < flips[1].parameter));
  }
}

TEST_CASE("orbits: a complex pair of multipliers that leaves the unit circle is a torus") {
  // A turn by 1 rad and growth by the parameter, bounded by a cubic term.
  SmallMap map(2, [](const VectorXd& y, double p, MatrixXd& tangent, std::vector<ContactEvent>&) {
    Eigen::Matrix2d turn;
    turn << std::cos(1.0), -std::sin(1.0), std::sin(1.0), std::cos(1.0);
    tangent = p * turn;
    return VectorXd(tangent * y);
  });
  const PeriodicOrbit orbit = orbit_at(map, VectorXd::Zero(2), 0.8);
  BranchSettings settings;
  settings.low = 0.5;
  settings.high = 1.2;
  const OrbitBranch branch = follow_branch(map, orbit, 1, settings);
  REQUIRE(branch.special.size() == 1);
  CHECK(branch.special[0].kind == Special::torus);
  CHECK(branch.special[0].parameter == relative(1, 1e-9));
}

TEST_CASE("orbits: a piecewise linear map turns at its kink, where no multiplier is 1") {
  // y -> s y + p - 1 with slope 0.5 below 0 and `steep` above: fixed points for p < 1 only.
  for (const double steep : {1.5, 3.0, 40.0}) {
    SmallMap map(1,
                 [steep](const VectorXd& y, double p, MatrixXd& tangent, std::vector<ContactEvent>& events) {
                   const double s = y[0] < 0 ? 0.5 : steep;
                   tangent = MatrixXd::Constant(1, 1, s);
                   if (y[0] > 0) events.push_back({1, true, 0});
                   return VectorXd(VectorXd::Constant(1, s * y[0] + p - 1));
                 });
    const PeriodicOrbit orbit = orbit_at(map, VectorXd::Constant(1, -0.8), 0.6);
    CHECK(orbit.start[0] == relative(-0.8, 1e-12));
    BranchSettings settings;
    settings.low = 0.5;
    settings.high = 1.5;
    const OrbitBranch branch = follow_branch(map, orbit, 1, settings);
    INFO(steep << ": " << branch.end);
    CHECK(branch.reached_limit);
    CHECK(branch.points.back().parameter == relative(0.5, 1e-12));
    CHECK(branch.points.back().start[0] == relative(0.5 / (steep - 1), 1e-9));
    const auto folds = of_kind(branch, Special::fold);
    REQUIRE(folds.size() == 1);
    CHECK(!folds[0].smooth);
    CHECK(folds[0].parameter == relative(1, 1e-6));
    CHECK(folds[0].before.real() == relative(0.5, 1e-12));
    CHECK(folds[0].after.real() == relative(steep, 1e-12));
    CHECK(of_kind(branch, Special::grazing).size() == 1);
  }
}

// y^2 = p - 1: a fold at 1, where the branch comes back. Steps land on either side of it, wherever they begin.
TEST_CASE("orbits: a branch that folds just beyond a limit ends at the limit, where it comes to it first") {
  SmallMap map(1, [](const VectorXd& y, double p, MatrixXd& tangent, std::vector<ContactEvent>&) {
    tangent = MatrixXd::Constant(1, 1, 1 - 0.4 * y[0]);
    return VectorXd(VectorXd::Constant(1, y[0] + 0.2 * (p - 1 - y[0] * y[0])));
  });
  for (const double dip : {1e-6, 1e-4, 1e-3})
    for (int i = 0; i < 20; ++i) {
      const double start = 0.3 + 0.01 * i;
      BranchSettings settings;
      settings.low = 1 + dip;
      settings.high = 2;
      settings.largest_step = 0.25;
      const PeriodicOrbit from = orbit_at(map, VectorXd::Constant(1, start), 1 + start * start);
      const OrbitBranch branch = follow_branch(map, from, -1, settings);
      INFO(dip << ", " << start << ": " << branch.end);
      CHECK(branch.reached_limit == -1);
      CHECK(branch.special.empty());
      CHECK(branch.points.back().parameter == relative(settings.low, 1e-12));
      CHECK(branch.points.back().start[0] == relative(std::sqrt(dip), 1e-4));
      CHECK(branch.points.back().turn < 0);
    }
}

TEST_CASE("orbits: the next segment of a branch has as many steps as the speeds beyond its limit want") {
  TimeDiscretisation time;
  time.steps_per_period = 32;
  time.min_sample_rate = 250e3;
  OrbitBranch down, up;
  down.reached_limit = -1;
  up.reached_limit = 1;
  const auto next = [&](int steps, const OrbitBranch& branch) {
    return steps_beyond(time, 1000, 8500, steps, branch).value_or(0);
  };
  CHECK(next(128, down) == 256);  // 1953 to 3906 Hz
  CHECK(next(128, up) == 64);
  CHECK(next(256, down) == 0);  // it would go on to 977 Hz
  CHECK(next(32, down) == 64);  // 7812 Hz on
  CHECK(next(32, up) == 0);
  time.min_sample_rate = 1e9;
  time.steps_per_period = 65536;
  CHECK(names(message_of([&] { steps_at(time, 1e-3); }), {65536, "most"}));
}

// The multiplier is -(a + b y) but for a step at y = 0: without the step it passes -1 at y = (1 - a) / b.
TEST_CASE("orbits: a period doubling at a kink is known to the step of the multiplier there") {
  constexpr double kA = 1.005, kB = 0.5;
  for (const double step : {0.0, 0.04}) {
    SmallMap map(1, [step](const VectorXd& y, double p, MatrixXd& tangent, std::vector<ContactEvent>&) {
      const double half = y[0] < 0 ? -0.5 * step : 0.5 * step;
      tangent = MatrixXd::Constant(1, 1, -(kA + kB * y[0] + half));
      return VectorXd(VectorXd::Constant(1, p - 1 - (kA + 0.5 * kB * y[0] + half) * y[0]));
    });
    const double smooth = (1 - kA) / kB, at_smooth = 1 + smooth + kA * smooth + 0.5 * kB * smooth * smooth;
    BranchSettings settings;
    settings.low = 0.5;
    settings.high = 1.5;
    map.set_parameter(1.4);
    const OrbitSearch search = newton_orbit(map, VectorXd::Constant(1, 0.19));
    REQUIRE(search.found());
    const auto flips = of_kind(follow_branch(map, search.orbit, -1, settings), Special::flip);
    REQUIRE(flips.size() == 1);
    CAPTURE(step);
    CHECK(flips[0].parameter == relative(step > 0 ? 1 : at_smooth, 1e-9));
    if (step > 0) {
      CHECK(std::abs(at_smooth - flips[0].parameter) < flips[0].width);
      CHECK(flips[0].width < 0.2);
    } else {
      CHECK(flips[0].width < 1e-9);
    }
  }
}

TEST_CASE("orbits: what cannot be found says why") {
  SmallMap map(1, [](const VectorXd& y, double p, MatrixXd& tangent, std::vector<ContactEvent>&) {
    tangent = MatrixXd::Constant(1, 1, 1 + 2 * y[0]);
    return VectorXd(VectorXd::Constant(1, y[0] + y[0] * y[0] + p));
  });
  map.set_parameter(0.1);
  const OrbitSearch search = newton_orbit(map, VectorXd::Constant(1, 1));
  CHECK(!search.found());
  CHECK(contains(search.failure, "residual"));
  CHECK(search.orbit.residual >= 0.1);
}

namespace {

// From the motion at 3400 Hz down to 2000 Hz.
OrbitBranch branch_of(LumpedPeriodMap& map, const LumpedOscillator& oscillator) {
  map.set_parameter(3400);
  VectorXd y = map.flat(oscillator.rest());
  for (int i = 0; i < 100; ++i) y = map.apply(y);
  BranchSettings settings;
  settings.low = 2000;
  settings.high = 3500;
  settings.scale = 2900;
  return follow_branch(map, orbit_at(map, y, 3400), -1, settings);
}

}  // namespace

TEST_CASE("orbits: the branch of the rectangular lumped pair through its exact folds") {
  const double expected[2][3] = {{0.08, 2662.046924, 2679.466389}, {0.07, 2464.654182, 2638.199272}};
  for (const auto& [ratio, down, up] : expected) {
    LumpedOscillator oscillator(paper_wave(ratio), kPaperForce, 64);
    LumpedPeriodMap map(oscillator);
    const OrbitBranch branch = branch_of(map, oscillator);
    INFO(ratio << ": " << branch.end << ", " << branch.points.size() << " points");
    CHECK(branch.reached_limit);
    CHECK(branch.points.back().parameter == relative(2000, 1e-12));
    const auto folds = of_kind(branch, Special::fold);
    REQUIRE(folds.size() == 2);
    CHECK(folds[0].parameter == relative(down, 1e-9));
    CHECK(folds[1].parameter == relative(up, 1e-9));
    for (const SpecialPoint& fold : folds) {
      CHECK(fold.smooth);
      const PeriodicOrbit at = orbit_at(map, fold.start, fold.parameter);
      CHECK(at.multipliers()[0].real() == relative(1, 1e-4));
      // By bordering the orbit is that of the fold to round-off, and so is its multiplier.
      map.set_parameter(fold.parameter);
      const FoldSearch exact = locate_fold(map, fold.start, 1, 2900);
      REQUIRE(exact.found());
      map.apply(exact.start);
      const MonodromyMatrix tangent{MatrixXd::Identity(2, 2), map.tangent()};
      CHECK(tangent.multipliers()[0].real() == relative(1, 1e-8));
    }
    // The part between the folds is unstable, and it alone.
    for (const BranchPosition& p : branch.points) CHECK(p.stable() == (p.turn < 0));
    // Contact is lost on the upper branch, and on the lower one as far as it grazes.
    const auto grazing = of_kind(branch, Special::grazing);
    CHECK(grazing.size() >= 2);
    // Orbits on the way repeat, the unstable ones as well.
    for (const BranchPosition& p : branch.points) {
      map.set_parameter(p.parameter);
      CHECK((map.apply(p.start) - p.start).norm() < 1e-10 * p.start.norm());
    }
    // A fold from nearby, on either side of it.
    for (const double away : {-0.01, 0.01}) {
      map.set_parameter(folds[0].parameter + away);
      const FoldSearch fold = locate_fold(map, folds[0].start, 1, 2900);
      INFO(fold.failure);
      REQUIRE(fold.found());
      CHECK(fold.parameter == relative(down, 1e-9));
    }
  }
}

TEST_CASE("orbits: the verdict on a lumped orbit does not depend on where its period is cut") {
  LumpedOscillator oscillator(paper_wave(0.07), kPaperForce, 64);
  LumpedPeriodMap map(oscillator);
  const OrbitBranch branch = branch_of(map, oscillator);
  for (const double f : {2000.0, 2550.0, 3400.0}) {
    const BranchPosition* nearest = nullptr;
    for (const BranchPosition& p : branch.points)
      if ((f != 2550 || p.turn > 0) &&
          (!nearest || std::abs(p.parameter - f) < std::abs(nearest->parameter - f)))
        nearest = &p;
    const PeriodicOrbit orbit = orbit_at(map, nearest->start, nearest->parameter);
    const Eigen::VectorXcd whole = orbit.multipliers();
    CHECK((std::abs(whole[0]) > 1) == (f == 2550));
    for (const double phase : {0.1, 0.4, 0.75, 0.9}) {
      // The cells, turned so that the period begins at `phase`; the state there, by the same motion in finer cells.
      LumpedOscillator turned(paper_wave(0.07, 1 - phase), kPaperForce, 64);
      LumpedPeriodMap other(turned);
      other.set_parameter(nearest->parameter);
      LumpedParameters cut = paper_wave(0.07);
      // Samples of a record stand at phases: the state at one is x, and x' by the orbit of the turned cells from there.
      LumpedOscillator recorder(cut, kPaperForce, 20);
      recorder.set_speed(nearest->parameter);
      LumpedOscillator::State at = map.state(orbit.start);
      LumpedEnergyBalance energy_balance;
      const Eigen::VectorXd x = recorder.record(at, energy_balance).x;
      const int sample = static_cast<int>(std::lround(phase * 20));
      LumpedOscillator fine(cut, kPaperForce, 20000);
      fine.set_speed(nearest->parameter);
      at = map.state(orbit.start);
      const Eigen::VectorXd close = fine.record(at, energy_balance).x;
      const double slope =
          (close[(1000 * sample + 1) % 20000] - close[1000 * sample - 1]) * 0.5 * 20000 * nearest->parameter;
      const OrbitSearch found = newton_orbit(other, other.flat({x[sample], slope}));
      REQUIRE(found.found());
      CHECK(other.state(found.orbit.start)[0] == relative(x[sample], 1e-9));
      const Eigen::VectorXcd multipliers = found.orbit.multipliers();
      for (int k = 0; k < 2; ++k) CHECK(std::abs(multipliers[k] - whole[k]) < 1e-8);
    }
  }
}

TEST_CASE("orbits: the branch of the elastic pair through both folds, beside integration") {
  const StaticResult statics = static_transmission(paper_body(), paper_body(), paper_statics(128), 150);
  const GearMeshModel model(paper_body(), paper_body(), statics.mesh);
  DynamicParameters parameters = paper_parameters(statics.mean_stiffness);
  parameters.damping.rayleigh_stiffness = 5.5e-6;
  RollingDynamics dynamics(model, parameters);
  dynamics.set_zone(candidate_zone(model, statics, MotionBounds(model, statics, 4.1)), 128);
  RollingPeriodMap map(dynamics, 128);
  map.set_parameter(2900);
  RollingDynamics::State state = dynamics.rest();
  REQUIRE(iterate_to_orbit(dynamics, state, 1e-8, SteadyState::extrapolate));
  BranchSettings settings;
  settings.low = 1700;
  settings.high = 2950;
  settings.scale = 2400;
  settings.location = 1e-7;
  settings.largest_step = 0.3;
  const OrbitBranch branch = follow_branch(map, orbit_at(map, map.flat(state), 2900), -1, settings);
  std::string path;
  for (const SpecialPoint& p : branch.special)
    path += text("\n", name(p.kind), " at ", p.parameter, " Hz, ", p.smooth ? "smooth" : "kink",
                 ", multipliers ", p.before.real(), " and ", p.after.real(), ", contact ", p.event.contact,
                 p.event.closes ? " closes" : " opens");
  MESSAGE(branch.points.size() << " points, " << branch.end << path);
  CHECK(branch.reached_limit);
  CHECK(branch.points.back().parameter == relative(1700, 1e-12));
  const auto folds = of_kind(branch, Special::fold);
  REQUIRE(folds.size() == 2);
  CHECK(folds[0].parameter < folds[1].parameter);
  for (const SpecialPoint& fold : folds)
    CHECK((fold.smooth || (fold.before.real() - 1) * (fold.after.real() - 1) < 0));
  int integrated = 0, unstable = 0;
  for (size_t i = 0; i < branch.points.size(); ++i) {
    const BranchPosition& p = branch.points[i];
    const bool between = p.turn > 0;
    CHECK(p.stable() == !between);
    CHECK(p.residual < 1e-8);
    if (i % 8 != 0) continue;
    map.set_parameter(p.parameter);
    if (!between) {
      // Integration stays.
      VectorXd y = p.start;
      for (int k = 0; k < 60; ++k) y = map.apply(y);
      CHECK((y - p.start).norm() < 1e-7 * p.start.norm());
      ++integrated;
      continue;
    }
    // Integration leaves it by its multiplier a period, and differences of the map see that, too.
    CHECK((map.apply(p.start) - p.start).norm() < 1e-8 * p.start.norm());
    const MatrixXd tangent = map.tangent();
    VectorXd along = VectorXd::Ones(map.size());
    for (int k = 0; k < 200; ++k) along = (tangent * along).normalized();
    constexpr double kStep = 1e-6;
    const VectorXd difference =
        (map.apply(p.start + kStep * along) - map.apply(p.start - kStep * along)) / (2 * kStep);
    CHECK(difference.dot(along) == relative(p.multipliers[0].real(), 1e-3));
    ++unstable;
  }
  CHECK(integrated >= 2);
  CHECK(unstable >= 2);
}

// (f / scale) scale is not f in these ranges; what is left points along the branch.
TEST_CASE("orbits: a branch does not close on the orbit that it begins with") {
  const ReducedBody& body = paper_body();
  StaticParameters coarse = paper_statics(128);
  coarse.contact.strips = 8;
  const StaticResult statics = static_transmission(body, body, coarse, 150);
  for (const double from : {2600.0, 2750.0}) {
    SweepParameters settings = paper_sweep(from, 3600, 50);
    settings.fidelity.contact = ContactModel::line;
    settings.time.steps_per_period = 64;
    settings.time.min_sample_rate = 0;
    const BranchResult branch = pair_branch(body, body, statics, 463e6, settings, no_report);
    CAPTURE(from);
    CAPTURE(branch.end);
    CHECK(branch.mesh_frequency.tail(1)[0] == relative(from, 1e-9));
  }
}

TEST_CASE("orbits: a sweep jumps where the branch folds, also across a change of steps") {
  const ReducedBody& body = paper_body();
  StaticParameters coarse = paper_statics(128);
  coarse.contact.strips = 8;
  const StaticResult statics = static_transmission(body, body, coarse, 150);
  SweepParameters stage_settings = paper_sweep(1700, 2950, 50);
  stage_settings.damping.rayleigh_stiffness = 5.5e-6;
  stage_settings.time.periodicity = 1e-6;
  // 64 steps above 2400 Hz, 128 below.
  stage_settings.time.steps_per_period = 64;
  stage_settings.time.min_sample_rate = 64 * 2400;
  const BranchResult branch = pair_branch(body, body, statics, 463e6, stage_settings, no_report);
  INFO(branch.end);
  CHECK(branch.mesh_frequency[0] == relative(2950, 1e-12));
  CHECK(branch.mesh_frequency.tail(1)[0] == relative(1700, 1e-12));
  CHECK(branch.steps.minCoeff() == 64);
  CHECK(branch.steps.maxCoeff() == 128);
  // On the upper branch down, on the unstable one up, and on the lower one down again.
  CHECK(branch.segment_mismatch.size() == 3);
  CHECK(branch.segment_mismatch.maxCoeff() < 0.1);
  REQUIRE(branch.fold_frequency.size() == 2);
  CHECK(branch.fold_width.minCoeff() >= kStepError * branch.fold_frequency.minCoeff());
  CHECK((branch.stable.array() == 0).any());
  for (const Direction direction : {Direction::down, Direction::up}) {
    const SweepResult swept =
        sweep(body, body, statics, 463e6, stage_settings, direction, no_report, nullptr, 0.02);
    REQUIRE(swept.jump_frequency.size() == 1);
    const double fold = branch.fold_frequency[direction == Direction::down ? 0 : 1];
    MESSAGE(direction << ": jump at " << swept.jump_frequency[0] << " Hz, fold at " << fold << " Hz");
    CHECK(swept.jump_width[0] <= 0.02);
    // To the lower branch's end the orbits come with the wider contact zone of the upper one, the sweep does not.
    CHECK(std::abs(swept.jump_frequency[0] - fold) < (direction == Direction::down ? 0.02 : 0.1));
    const CausedJump cause = cause_of_jump(branch, swept.jump_frequency[0], swept.jump_width[0]);
    CHECK(cause.cause == JumpCause::fold);
    CHECK(cause.frequency == fold);
    CHECK(cause_of_jump(branch, fold + 50, 1).cause == JumpCause::basin);
    // Stable orbits are the sweep's.
    const ResponseResult response = whine::response(swept);
    double apart = 0, sustained = 0;
    Eigen::Array2d place = Eigen::Array2d::Zero();  // rad; mesh periods
    int compared = 0;
    for (Eigen::Index i = 0; i < response.mesh_frequency.size(); ++i)
      for (Eigen::Index k = 0; k + 1 < branch.mesh_frequency.size(); ++k) {
        const double share = (response.mesh_frequency[i] - branch.mesh_frequency[k]) /
                             (branch.mesh_frequency[k + 1] - branch.mesh_frequency[k]);
        if (!(share >= 0 && share < 1) || !branch.stable[k] || !branch.stable[k + 1]) continue;
        const double own = (1 - share) * branch.dte_rms(k, 0) + share * branch.dte_rms(k + 1, 0);
        if (std::abs(own / response.dte_rms(i, 0) - 1) > 0.2) continue;  // the other branch
        apart = std::max(apart, std::abs(own / response.dte_rms(i, 0) - 1));
        const auto sustained_apart = [&](const VectorXd& along, double swept_value) {
          sustained = std::max(sustained,
                               std::abs(((1 - share) * along[k] + share * along[k + 1]) / swept_value - 1));
        };
        for (Eigen::Index g = 0; g < kSides; ++g)
          sustained_apart(branch.root_stress_sustained.col(g), response.root_stress_sustained(i, g));
        // Where that stress stands: at the nearer orbit, as the largest may go over to another tooth.
        const Eigen::Index near = share < 0.5 ? k : k + 1;
        for (Eigen::Index g = 0; g < kSides; ++g)
          place = place.max(
              Eigen::Array2d(std::abs(branch.root_stress_angle(near, g) - response.root_stress_angle(i, g)),
                             std::abs(branch.root_stress_phase(near, g) - response.root_stress_phase(i, g))));
        sustained_apart(branch.tooth_load_sustained.col(0), response.tooth_load_sustained(i, 0));
        sustained_apart(branch.mesh_force_sustained.col(0), response.mesh_force_sustained(i, 0));
        ++compared;
        break;
      }
    CHECK(compared > 20);
    CHECK(apart < 1e-2);
    MESSAGE("sustained loads and root stress: " << sustained);
    CHECK(sustained < 2e-2);
    MESSAGE("place of the root stress: " << place[0] << " rad, " << place[1] << " mesh periods");
    CHECK(place[0] < 0.02);
    CHECK(place[1] < 3.0 / 64);
  }
  // What is written is read.
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  write(path, branch, {});
  const BranchResult again = read<BranchResult>(path);
  CHECK(again.mesh_frequency == branch.mesh_frequency);
  CHECK(again.floquet_multiplier.back() == branch.floquet_multiplier.back());
  CHECK(again.fold_multiplier == branch.fold_multiplier);
  CHECK(again.grazing_pair == branch.grazing_pair);
  CHECK(again.end == branch.end);
}
