#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "gear/train.h"
#include "refusal.h"
#include "relative.h"
#include "signal/jumps.h"
#include "signal/response.h"
#include "signal/spectrum.h"

using namespace whine;

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

// Samples of f over `periods` periods of length 1, end point left out.
template <class F>
Eigen::VectorXd sampled(int n, double periods, F f) {
  Eigen::VectorXd x(n);
  for (int j = 0; j < n; ++j) x[j] = f(periods * j / n);
  return x;
}

// A signal with harmonics 0..12 of known amplitude and phase; micrometres, as a transmission error.
double known_amplitude(int k) {
  return 1e-6 / (k * std::sqrt(k));
}
double known_signal(double t) {
  double x = 4e-6;
  for (int k = 1; k <= 12; ++k) x += known_amplitude(k) * std::cos(kTwoPi * k * t + 0.7 * k * k);
  return x;
}

SweepResult small_sweep() {
  SweepResult s;
  s.gear[0].design.teeth = s.gear[1].design.teeth = 50;
  s.gear[0].design.module = s.gear[1].design.module = 3e-3;
  s.gear[0].design.pressure_angle = s.gear[1].design.pressure_angle = 20.0 * std::numbers::pi / 180.0;
  s.inertia[0] = s.inertia[1] = 0.0148;
  s.mean_stiffness = 462.1e6;
  s.natural_frequency = 2950;
  s.time.steps_per_period = 32;  // rows of two periods, as long as the longest orbit
  s.torque = 150;
  s.mesh.gear = {"pinion", "wheel"};
  s.mesh.centre_distance = 0.15;
  s.place_pair(pair_system(s));
  s.direction = Direction::down;
  const int n = 64;
  s.mesh_frequency = Eigen::VectorXd{{2000, 1900}};
  s.transmission_error.assign(2, MatrixRM(n, 1));
  s.mesh_force = s.transmission_error;
  s.period_multiple = Eigen::VectorXi{{1, 2}};
  s.pair = Eigen::VectorXi{{-1, 0}};
  for (int j = 0; j < n; ++j) {
    s.transmission_error[0](j, 0) =
        5e-6 + 2e-6 * std::cos(kTwoPi * 2 * j / n) + 1e-6 * std::sin(kTwoPi * 6 * j / n);
    // Period 2: a subharmonic of 3e-6 beside 4e-6 at the mesh frequency.
    s.transmission_error[1](j, 0) = 3e-6 * std::cos(kTwoPi * j / n) + 4e-6 * std::cos(kTwoPi * 2 * j / n);
    s.mesh_force[0](j, 0) = 2000 + j % 32;
    s.mesh_force[1](j, 0) = j < 8 || j >= 60 ? 0.0 : 3000.0;
  }
  for (int f = 0; f < 2; ++f) {
    MatrixRM load(n, 2);
    load.col(0) = 0.25 * s.mesh_force[static_cast<size_t>(f)].col(0);
    load.col(1) = 0.75 * s.mesh_force[static_cast<size_t>(f)].col(0);
    s.tooth_load.push_back(load);
  }
  s.jump_frequency = Eigen::VectorXd::Constant(1, 1950.0);
  s.jump_width = Eigen::VectorXd::Constant(1, 1.25);
  return s;
}

}  // namespace

TEST_CASE("harmonics: known mean and amplitudes come back to 1e-14 of the largest, at odd and even lengths") {
  for (int n : {64, 101, 128}) {
    CAPTURE(n);
    const Harmonics h = harmonics(sampled(n, 1, known_signal), 12);
    // Round-off of the samples themselves is 4e-6 * 2.2e-16 each; 1e-14 of the mean leaves ten of those.
    CHECK(std::abs(h.mean - 4e-6) < 1e-14 * 4e-6);
    for (int k = 1; k <= 12; ++k) CHECK(std::abs(h.amplitude[k - 1] - known_amplitude(k)) < 1e-14 * 4e-6);
  }
}

TEST_CASE("harmonics: Parseval, the RMS of the samples is that of all amplitudes") {
  const Harmonics h = harmonics(sampled(64, 1, known_signal), 31);
  CHECK(h.rms == relative(std::sqrt(0.5 * h.amplitude.squaredNorm()), 1e-14));
  double exact = 0;
  for (int k = 1; k <= 12; ++k) exact += 0.5 * known_amplitude(k) * known_amplitude(k);
  CHECK(h.rms == relative(std::sqrt(exact), 1e-13));
}

TEST_CASE("harmonics: where the period starts changes nothing") {
  const Harmonics a = harmonics(sampled(128, 1, known_signal), 10);
  const Harmonics b = harmonics(sampled(128, 1, [](double t) { return known_signal(t + 0.3141); }), 10);
  CHECK((a.amplitude - b.amplitude).cwiseAbs().maxCoeff() < 1e-13 * 4e-6);
  CHECK(b.rms == relative(a.rms, 1e-13));
  CHECK(b.mean == relative(a.mean, 1e-14));
}

TEST_CASE("harmonics: several periods give the harmonics of one; a subharmonic counts in the RMS only") {
  const Harmonics one = harmonics(sampled(96, 1, known_signal), 10);
  const Harmonics three = harmonics(sampled(288, 3, known_signal), 10, 3);
  CHECK((one.amplitude - three.amplitude).cwiseAbs().maxCoeff() < 1e-13 * 4e-6);
  CHECK(three.rms == relative(one.rms, 1e-13));

  const auto sub = [](double t) { return 3.0 * std::cos(0.5 * kTwoPi * t) + 4.0 * std::cos(kTwoPi * t); };
  const Harmonics two = harmonics(sampled(128, 2, sub), 5, 2);
  CHECK(two.amplitude[0] == relative(4.0, 1e-14));
  CHECK(two.amplitude.tail(4).maxCoeff() < 1e-14);
  CHECK(two.rms == relative(std::sqrt(12.5), 1e-14));
}

TEST_CASE("harmonics: a constant has no oscillation at all") {
  const Harmonics h = harmonics(Eigen::VectorXd::Constant(17, 3.0), 5);
  CHECK(h.mean == 3.0);
  CHECK(h.rms == 0.0);
  CHECK(h.amplitude.maxCoeff() == 0.0);
}

TEST_CASE("harmonics: a record of n + 1/4 periods is wrong by the known amounts, a whole number is not") {
  // Mean square of sin(2 pi t + phase) over n + 1/4 periods: 1/2 + sin(2 phase) / (4 pi (n + 1/4)). Worst at
  // a phase of -45 degrees, where the record's mean happens to vanish. Tolerance: half a unit of the last
  // digit quoted.
  const struct {
    int n;
    double error, tolerance;
  } known[] = {{1, 0.066, 5e-4}, {5, 0.015, 5e-4}, {20, 0.0039, 5e-5}, {100, 0.00079, 5e-6}};
  for (const auto& [n, error, tolerance] : known) {
    CAPTURE(n);
    const int samples = 400 * n + 100;
    const auto sine = [](double t) { return std::sin(kTwoPi * (t - 0.125)); };
    CHECK(harmonics(sampled(samples, n, sine), 1, n).rms == relative(std::sqrt(0.5), 1e-13));
    const double rms = harmonics(sampled(samples, n + 0.25, sine), 0).rms;
    CHECK(std::abs(1.0 - rms / std::sqrt(0.5) - error) < tolerance);
  }
  // Half a bin off: the line keeps 2/pi of its amplitude (0.6366), here for 20.5 periods at bin 20; the other
  // line's leakage is 1/41 of it.
  const Harmonics half = harmonics(sampled(8192, 20.5, [](double t) { return std::cos(kTwoPi * t); }), 1, 20);
  CHECK(half.amplitude[0] == relative(2.0 / std::numbers::pi, 1.5 / 41));
}

TEST_CASE("harmonics: records that cannot be answered are rejected") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(failure_of([] { harmonics(Eigen::VectorXd(), 1); }) == Failure::input);
  CHECK(failure_of([] { harmonics(Eigen::VectorXd::Ones(1), 0); }) == Failure::input);
  CHECK(failure_of([] { harmonics(Eigen::VectorXd::Ones(20), 10); }) == Failure::input);  // Nyquist
  CHECK(failure_of([] { harmonics(Eigen::VectorXd::Ones(64), 10, 4); }) == Failure::input);
  CHECK(failure_of([] { harmonics(Eigen::VectorXd::Ones(64), 1, 0); }) == Failure::input);
  CHECK(failure_of([] { harmonics(Eigen::VectorXd::Ones(64), -1); }) == Failure::input);
  CHECK(failure_of([nan] { harmonics(Eigen::Vector4d(1, 2, nan, 3), 1); }) == Failure::input);
  CHECK_NOTHROW(harmonics(Eigen::VectorXd::Ones(21), 10));
  CHECK(resolved_harmonics(20, 10) == 9);
  CHECK(resolved_harmonics(21, 10) == 10);
  CHECK(resolved_harmonics(128, 10, 8) == 7);
}

TEST_CASE("separations: intervals are counted on the cyclic period, one that wraps round the end once") {
  using V = Eigen::VectorXd;
  const auto of = [](std::initializer_list<double> f) {
    return separations(Eigen::Map<const V>(f.begin(), static_cast<Eigen::Index>(f.size())));
  };
  CHECK(of({1, 2, 3}).intervals == 0);
  CHECK(of({1, 2, 3}).fraction == 0.0);
  CHECK(of({1, 0, 0, 3, 0, 2}).intervals == 2);
  CHECK(of({1, 0, 0, 3, 0, 2}).fraction == 0.5);
  CHECK(of({0, 0, 5, 5, 0}).intervals == 1);  // wraps
  CHECK(of({0, 5, 0, 5, 0}).intervals == 2);  // one wraps, one does not
  CHECK(of({0, 0, 0}).intervals == 1);        // never in contact
  CHECK(of({0, 0, 0}).fraction == 1.0);
  CHECK(failure_of([&] { of({}); }) == Failure::input);
  CHECK(failure_of([&] { of({1, -1e-9, 2}); }) == Failure::input);
}

TEST_CASE("response: mean, RMS, harmonics, loads and separations of a sweep made by hand") {
  const ResponseResult r = response(small_sweep());
  CHECK(r.torque == 150);
  CHECK(r.direction == Direction::down);
  CHECK(elastic(r));
  CHECK(r.mesh_frequency == Eigen::VectorXd(Eigen::Vector2d(2000, 1900)));
  // 1e-13: round-off of 64 samples
  CHECK(r.dte_mean(0, 0) == relative(5e-6, 1e-13));
  CHECK(r.dte_rms(0, 0) == relative(std::sqrt(2.5) * 1e-6, 1e-13));
  CHECK(r.dte_rms(1, 0) == relative(std::sqrt(12.5) * 1e-6, 1e-13));
  CHECK(std::abs(r.dte_mean(1, 0)) < 1e-19);
  REQUIRE(r.harmonics() == 10);
  CHECK(r.dte_harmonic[0](0, 0) == relative(2e-6, 1e-13));
  CHECK(r.dte_harmonic[0](2, 0) == relative(1e-6, 1e-13));
  CHECK(r.dte_harmonic[1](0, 0) == relative(4e-6, 1e-13));  // of the mesh frequency, not of its half
  CHECK(r.dte_harmonic[0](1, 0) < 1e-19);
  CHECK(r.mesh_force_max(0, 0) == 2031);
  CHECK(r.tooth_load_max(0, 0) == 0.75 * 2031);
  CHECK(r.separation_fraction(0, 0) == 0.0);
  CHECK(r.separation_fraction(1, 0) == 12.0 / 64);
  CHECK(r.separations_per_period(1, 0) == 0.5);  // one in two mesh periods
  CHECK(r.jump_frequency[0] == 1950);
  CHECK(r.jump_width[0] == 1.25);
  CHECK(r.natural_frequency == 2950);
}

TEST_CASE(
    "response: a fundamental orbit in rows made long by another speed's subharmonic keeps its harmonics") {
  SweepResult s = small_sweep();
  const ResponseResult wide = response(s);
  s.transmission_error = {MatrixRM(s.transmission_error[0].topRows(32))};
  s.mesh_force = {MatrixRM(s.mesh_force[0].topRows(32))};
  s.tooth_load = {MatrixRM(s.tooth_load[0].topRows(32))};
  s.mesh_frequency.conservativeResize(1);
  s.period_multiple.conservativeResize(1);
  const ResponseResult narrow = response(s);
  CHECK((wide.dte_harmonic[0] - narrow.dte_harmonic[0]).norm() < 1e-19);
  CHECK(wide.dte_rms(0, 0) == relative(narrow.dte_rms(0, 0), 1e-14));
  CHECK(wide.separations_per_period(0, 0) == narrow.separations_per_period(0, 0));
}

TEST_CASE("response: first orders of the mesh force and of the force on a bearing, x and y together") {
  SweepResult s = small_sweep();
  const int samples = static_cast<int>(s.samples()), steps = s.time.steps_per_period;
  s.bearing_force[1].clear();
  for (MatrixRM& force : s.mesh_force) {
    MatrixRM bearing(samples, 2);
    for (int t = 0; t < samples; ++t) {
      const double phase = 2 * std::numbers::pi * t / steps;
      force(t, 0) = 1000 + 30 * std::cos(phase + 0.3) + 5 * std::cos(2 * phase);
      bearing(t, 0) = 100 + 3 * std::cos(phase);
      bearing(t, 1) = 4 * std::sin(phase + 1);
    }
    s.bearing_force[1].push_back(bearing);
  }
  const ResponseResult r = response(s);
  for (size_t f = 0; f < 2; ++f) {
    CHECK(r.mesh_force_harmonic[f](0, 0) == relative(30, 1e-12));
    CHECK(r.mesh_force_harmonic[f](1, 0) == relative(5, 1e-12));
    CHECK(r.bearing_force_harmonic[f](0, 1) == relative(5, 1e-12));  // 3, 4
    CHECK(r.bearing_force_harmonic[f](0, 0) == 0);                   // on a rigid bearing
  }
}

TEST_CASE("response: a motion that is not periodic counts with all that is stored of it") {
  SweepResult s = small_sweep();
  s.period_multiple[1] = 0;
  const ResponseResult r = response(s);
  CHECK(r.period_multiple[1] == 0);
  CHECK(r.dte_rms(1, 0) == relative(std::sqrt(12.5) * 1e-6, 1e-13));
  CHECK(r.separation_fraction(1, 0) == 12.0 / 64);
}

TEST_CASE("response: fewer harmonics where a period has few samples, rejected where none is left") {
  SweepResult s = small_sweep();
  s.time.steps_per_period = 8;
  CHECK(response(s).harmonics() == 3);  // below half of 8
  s.time.steps_per_period = 2;
  CHECK(failure_of([&] { response(s); }) == Failure::input);
  s = small_sweep();
  s.period_multiple[1] = 3;  // more than a row holds
  CHECK(failure_of([&] { response(s); }) == Failure::input);
}

TEST_CASE("response: sweeps whose arrays disagree or hold impossible values are rejected") {
  const auto rejected = [](auto change) {
    SweepResult s = small_sweep();
    change(s);
    return failure_of([&] { response(s); }) == Failure::input;
  };
  CHECK(rejected([](SweepResult& s) { s.mesh_frequency.resize(0); }));
  CHECK(rejected([](SweepResult& s) { s.mesh_force.pop_back(); }));
  CHECK(rejected([](SweepResult& s) { s.mesh_force[1].conservativeResize(63, 1); }));
  CHECK(rejected([](SweepResult& s) { s.tooth_load.pop_back(); }));
  CHECK(rejected([](SweepResult& s) { s.tooth_load[0](3, 1) = std::numeric_limits<double>::infinity(); }));
  CHECK(rejected([](SweepResult& s) { s.period_multiple[0] = -1; }));
  CHECK(rejected([](SweepResult& s) { s.mesh_force[0](5, 0) = -1; }));
  CHECK(rejected(
      [](SweepResult& s) { s.transmission_error[1](5, 0) = std::numeric_limits<double>::quiet_NaN(); }));
  CHECK(rejected([](SweepResult& s) { s.jump_width.resize(0); }));
  CHECK(rejected([](SweepResult& s) { s.time.steps_per_period = 0; }));
}

namespace {

// Motions of a cusp: level x with x^3 - b x = 0.1 (f - 1000), log RMS 0.1 x. Two branches for b > 0, whose ends lie where
// 3 x^2 = b; for b < 0 one, with its steepest flank at 1000 Hz.
struct Cusp {
  double b;
  // Where x flows to from `start`.
  double settled(double f, double start) const {
    double x = start;
    for (int i = 0; i < 100000; ++i) {
      const double rate = 0.1 * (f - 1000) - x * x * x + b * x;
      x += 0.5 * rate / (1 + 3 * x * x + std::abs(b));
      if (std::abs(rate) < 1e-13) break;
    }
    return x;
  }
};

struct FoundEnds {
  std::vector<BranchEnd> ends;
  int runs = 0;
};
FoundEnds ends_of(const Cusp& cusp, double first, double last, double step) {
  FoundEnds found;
  std::vector<BranchMotion> sweep;
  std::vector<double> x;
  const double direction = last > first ? 1 : -1;
  const auto motion = [](double f, double at) { return BranchMotion{f, std::exp(0.1 * at), 1}; };
  for (double f = first; direction * (last - f) >= 0; f += direction * step) {
    x.push_back(cusp.settled(f, x.empty() ? -3 * direction : x.back()));
    sweep.push_back(motion(f, x.back()));
  }
  for (size_t i = 1; i < sweep.size(); ++i) {
    if (!may_break(sweep, i)) continue;
    double kept = x[i - 1];
    std::vector<double> tried;
    BranchWalk walk;
    walk.step = direction * step;
    walk.limit = sweep.back().mesh_frequency;
    walk.run = [&](double f, double) {
      ++found.runs;
      tried.push_back(cusp.settled(f, kept));
      return motion(f, tried.back());
    };
    walk.keep = [&](int n) { kept = tried.at(n); };
    if (const auto end = branch_end(walk, sweep, i)) found.ends.push_back(*end);
  }
  return found;
}

}  // namespace

TEST_CASE(
    "ends of branches: a jump is what stays as the speed step shrinks, however small; a steep flank is none") {
  // From one branch to the other x goes by 3 sqrt(b / 3): 15, 30 and 55 % of RMS.
  for (const double b : {0.8, 3.0, 10.0})
    for (const double step : {5.0, 20.0, 50.0})
      for (const double direction : {1.0, -1.0}) {
        const Cusp cusp{b};
        const FoundEnds found = ends_of(cusp, 1000 - 203 * direction, 1000 + 197 * direction, step);
        INFO("b " << b << ", steps of " << step << " Hz, direction " << direction << ", runs " << found.runs);
        REQUIRE(found.ends.size() == 1);
        const BranchEnd& end = found.ends[0];
        CHECK(!end.outlived);
        CHECK(std::abs(end.next - end.last) <= step / 64 * (1 + 1e-9));
        const double fold = 1000 + direction * 20 * std::pow(b / 3, 1.5);
        CHECK(std::abs(0.5 * (end.last + end.next) - fold) <= step / 64);
      }
  for (const double b : {-0.5, -2.0})
    for (const double step : {5.0, 20.0, 50.0}) CHECK(ends_of(Cusp{b}, 803, 1203, step).ends.empty());
}

TEST_CASE("ends of branches: another multiple of the mesh period, a branch that outlives the sweep") {
  const std::vector<BranchMotion> sweep = {{100, 1, 1}, {110, 1, 1}, {120, 1, 2}, {130, 1, 2}};
  CHECK(!may_break(sweep, 1));
  CHECK(may_break(sweep, 2));
  BranchWalk walk;
  walk.step = 10;
  walk.limit = 130;
  walk.run = [](double f, double) { return BranchMotion{f, 1, f < 113.3 ? 1 : 2}; };
  walk.keep = [](int) {};
  const auto doubling = branch_end(walk, sweep, 2);
  REQUIRE(doubling);
  CHECK(doubling->last < 113.3);
  CHECK(doubling->next >= 113.3);
  CHECK(doubling->next - doubling->last == relative(10.0 / 64, 1e-9));
  walk.run = [](double f, double) { return BranchMotion{f, 1, 1}; };  // the sweep left it too early
  const auto beyond = branch_end(walk, sweep, 2);
  REQUIRE(beyond);
  CHECK(beyond->outlived);
  // Motions that do not repeat are not compared.
  CHECK(!may_break({{100, 1, 0}, {110, 3, 0}}, 1));
  // One that did not settle among others that did is no jump where its RMS goes on, and one where it does not.
  const std::vector<BranchMotion> slow{{100, 1, 1}, {110, 1.05, 1}, {120, 1.1025, 0}, {130, 1.157625, 1}};
  for (size_t i = 1; i < slow.size(); ++i) CHECK(!may_break(slow, i));
  CHECK(may_break({{100, 1, 1}, {110, 1, 1}, {120, 2, 0}, {130, 2, 0}}, 2));
}
