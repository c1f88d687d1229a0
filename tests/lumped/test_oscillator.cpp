// The lumped models of Eq. 23 against closed forms (Meissner's equation, free bounce), folds and RMS found by another
// program with exact pieces, Newmark's method and finite differences.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "figure_block.h"
#include "lumped/oscillator.h"
#include "lumped/stiffness.h"
#include "lumped/sweep.h"
#include "lumped_wave.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "report/figure_list.h"
#include "report/response_figures.h"
#include "signal/response.h"
#include "system/rectangular_wave.h"

using namespace whine;
using State = LumpedOscillator::State;
using Matrix = LumpedOscillator::Matrix;

namespace {

constexpr double kMass = 1.4, kMean = 462.1e6, kRadius = 0.0704769466;
constexpr double kLow = 335596523.71,
                 kHigh = 504267825.43;  // k2 / k1 = (3040 / 2480)^2, mean 462.1e6 at duty 0.75

LumpedParameters wave(double low, double high, double duty, double ratio) {
  LumpedParameters p = cells_of(RectangularWave{low, high, 0, duty});
  p.mass = kMass;
  p.damping_ratio = ratio;
  p.damper = 2 * ratio * std::sqrt((low + (high - low) * duty) * kMass);
  p.damper_acts = DamperActs::always;
  return p;
}

LumpedOscillator oscillator(double low, double high, double duty, double ratio, double torque = 150,
                            int newmark = 0) {
  return {wave(low, high, duty, ratio), torque / kRadius, 64, newmark};
}

std::vector<double> speeds(double from, double to, double step) {
  std::vector<double> out;
  for (double f = from; step > 0 ? f < to + 0.5 * step : f > to + 0.5 * step; f += step) out.push_back(f);
  return out;
}

LumpedOrbit steady(LumpedOscillator& o, double mesh_frequency) {
  o.set_speed(mesh_frequency);
  return iterate_to_orbit(o, o.rest(), 1e-6, false);
}

// Ends of the two branches: where a sweep down and a sweep up leave theirs.
std::array<double, 2> folds(LumpedOscillator& o, double from, double to) {
  std::array<double, 2> found{};
  for (int up = 0; up < 2; ++up) {
    const auto list = up ? speeds(from, to, 20) : speeds(to, from, -20);
    const LumpedSpeeds integrate = integrate_speeds(o, list, 1e-6, false, no_report);
    REQUIRE(integrate.jumps.size() == 1);
    CHECK(integrate.jumps[0].width < 1e-3);
    found[up] = integrate.jumps[0].mesh_frequency;
  }
  return found;
}

// Ends of the upper branch, which there is only with contact loss, by bisection with plain integration alone.
double end_by_integration(LumpedOscillator& o, double with, double without, const LumpedOrbit& branch) {
  State state = branch.start;
  while (std::abs(with - without) > 1e-3) {
    const double f = 0.5 * (with + without);
    o.set_speed(f);
    State y = state;
    for (int i = 0; i < 6000; ++i) o.integrate(y);
    LumpedEnergyBalance energy_balance;
    State last = y;
    const bool upper = o.record(last, energy_balance).separations > 0;
    (upper ? with : without) = f;
    if (upper) state = y;
  }
  return 0.5 * (with + without);
}

double slope(const std::vector<double>& step, const std::vector<double>& error) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = static_cast<double>(step.size());
  for (size_t i = 0; i < step.size(); ++i) {
    const double x = std::log(step[i]), y = std::log(error[i]);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

TEST_CASE("lumped: trace of the exact monodromy meets 2 at the bounds of Meissner's instability") {
  LumpedOscillator o = oscillator(kLow, kHigh, 0.75, 0);
  CHECK(o.natural_frequency() == relative(2891.50600, 1e-8));
  const auto trace = [&](LumpedOscillator& any, double f) {
    any.set_speed(f);
    State y = any.rest();
    Matrix m = Matrix::Identity();
    any.integrate(y, &m);
    return m;
  };
  const auto& edge = kTongue;
  for (int band = 0; band < 5; ++band) {
    const double width = edge[band][1] - edge[band][0];
    for (int side = 0; side < 2; ++side) {
      double in = 0.5 * (edge[band][0] + edge[band][1]), out = edge[band][side] + (side ? 0.3 : -0.3) * width;
      for (int i = 0; i < 60; ++i) {
        const double f = 0.5 * (in + out);
        const Matrix m = trace(o, f);
        CHECK(m.determinant() == relative(1, 1e-12));
        (std::abs(m.trace()) > 2 ? in : out) = f;
      }
      CHECK(in == relative(edge[band][side], 1e-4 / edge[band][side]));
    }
    double unstable = 0, stable = 0.1;
    while (stable - unstable > 1e-6) {
      const double ratio = 0.5 * (unstable + stable);
      LumpedOscillator damped = oscillator(kLow, kHigh, 0.75, ratio);
      double largest = 0;
      for (int j = 0; j <= 400; ++j) {
        LumpedOrbit orbit;
        orbit.monodromy = trace(damped, edge[band][0] + width * j / 400);
        largest = std::max(largest, orbit.largest_multiplier());
      }
      (largest > 1 ? unstable : stable) = ratio;
    }
    CHECK(stable == relative(kTongueCloses[band], 6e-6 / kTongueCloses[band]));
  }
}

TEST_CASE("lumped: steady states and folds of the rectangular wave at 8 and 7 % damping") {
  LumpedOscillator o = oscillator(kLow, kHigh, 0.75, 0.08);
  const double rms[4][2] = {{2000, 1.14249855}, {2400, 1.85201323}, {3200, 1.58850265}, {1350, 2.64137209}};
  for (const auto& [f, expected] : rms) {
    const LumpedOrbit orbit = steady(o, f);
    CHECK(orbit.multiple == 1);
    CHECK(orbit.residual < 1e-13);
    CHECK(orbit.rms * 1e6 == relative(expected, 1e-8));
    // 64 samples of the same orbit.
    const Eigen::VectorXd x = orbit.record[0].x;
    CHECK(std::sqrt((x.array() - x.mean()).square().mean()) == relative(orbit.rms, 1e-5));
  }
  const auto ends = folds(o, 2500, 2800);
  const double expected[2][3] = {{2662.046924, 4.527986, 4.662014}, {2679.466389, 3.705375, 4.872935}};
  for (int up = 0; up < 2; ++up) {
    CHECK(ends[up] == relative(expected[up][0], 1e-6 / expected[up][0]));
    // The orbit at the fold itself, where a multiplier is 1.
    const LumpedSpeeds integrate =
        integrate_speeds(o, up ? speeds(2600, 2700, 20) : speeds(2800, 2640, -20), 1e-6, false, no_report);
    REQUIRE(integrate.jumps.size() == 1);
    CHECK(integrate.jumps[0].fold);
    const auto fold = find_fold(o, integrate.jumps[0].start, integrate.jumps[0].mesh_frequency + 1e-4, 1);
    REQUIRE(fold);
    CHECK(fold->mesh_frequency == relative(expected[up][0], 1e-6 / expected[up][0]));
    State end = fold->start;
    Matrix m = Matrix::Identity();
    o.integrate(end, &m);
    CHECK(o.size(end - fold->start) < 1e-12);
    CHECK(std::abs((m - Matrix::Identity()).determinant()) < 1e-9);
    end = fold->start;
    LumpedEnergyBalance energy_balance;
    const LumpedRecord r = o.record(end, energy_balance);
    const double off = r.mean - o.reference();
    CHECK(std::sqrt(r.mean_square - off * off) * 1e6 == relative(expected[up][1], 1e-6));
    CHECK(r.mean * 1e6 == relative(expected[up][2], 1e-6));
  }
  LumpedOscillator less = oscillator(kLow, kHigh, 0.75, 0.07);
  const auto wider = folds(less, 2300, 2800);
  CHECK(wider[0] == relative(2464.654182, 1e-6 / 2464));
  CHECK(wider[1] == relative(2638.199272, 1e-6 / 2638));
}

TEST_CASE("lumped: folds at level ratios 1.6 and 1.7575, the second beside Newmark's method") {
  const double low = kMean / (0.25 + 0.75 * 1.6);
  LumpedOscillator o = oscillator(low, 1.6 * low, 0.75, 0.08);
  const auto ends = folds(o, 2300, 2800);
  CHECK(ends[0] == relative(2458.77, 0.005 / 2458));
  CHECK(ends[1] == relative(2605.21, 0.005 / 2605));

  // Levels at which the branches of P2000's Fig. 15 stand where its caption says: upper at 2200, lower at 2150 Hz.
  LumpedOscillator figure = oscillator(2.93973e8, 5.16658e8, 0.755, 0.08);
  const auto wide = folds(figure, 2000, 2800);
  CHECK(wide[0] == relative(2171.615284, 1e-6 / 2171));
  CHECK(wide[1] == relative(2525.315708, 1e-6 / 2525));
  // The same by plain integration with Newmark's steps: errors fall with their square.
  std::vector<double> step, error;
  for (int steps : {128, 256, 512, 1024}) {
    LumpedOscillator newmark = oscillator(2.93973e8, 5.16658e8, 0.755, 0.08, 150, steps);
    const LumpedSpeeds integrate = integrate_speeds(newmark, speeds(2800, 2200, -20), 1e-9, true, no_report);
    const double end = end_by_integration(newmark, 2200, 2140, integrate.orbits.back());
    step.push_back(1.0 / steps);
    error.push_back(std::abs(end - wide[0]));
    MESSAGE("upper branch ends by Newmark, ", steps, " steps: ", end, " Hz, exact ", wide[0]);
  }
  CHECK(error.back() < 0.1);
  CHECK(slope(step, error) > 1.7);
}

TEST_CASE("lumped: a slow transient near twice its natural frequency is no subharmonic") {
  // It turns by half a circle a mesh period and dies slowly: two periods bring it near its beginning, one does not.
  LumpedOscillator light = oscillator(4e8, 4.1e8, 0.75, 0.02);
  const double twice = 2 * light.natural_frequency();
  for (double periodicity : {1e-5, 1e-6})
    for (double f : {0.99 * twice, 0.997 * twice, twice, 1.003 * twice}) {
      light.set_speed(f);
      const LumpedOrbit orbit = iterate_to_orbit(light, light.rest(), periodicity, true);
      INFO((f / twice) << " of twice, " << orbit.periods << " periods");
      CHECK(orbit.multiple == 1);
    }
}

TEST_CASE("lumped: motions scale with the torque") {
  LumpedOscillator one = oscillator(kLow, kHigh, 0.75, 0.07),
                   seven = oscillator(kLow, kHigh, 0.75, 0.07, 1050);
  for (double f : {1350.0, 2400.0, 3000.0}) {
    const LumpedOrbit a = steady(one, f), b = steady(seven, f);
    CHECK(b.rms == relative(7 * a.rms, 1e-10));
    CHECK(b.mean == relative(7 * a.mean, 1e-10));
  }
  const auto a = folds(one, 2400, 2800), b = folds(seven, 2400, 2800);
  for (int i = 0; i < 2; ++i) CHECK(b[i] == relative(a[i], 1e-10));
}

TEST_CASE("lumped: an undamped bounce keeps its energy and its period") {
  LumpedParameters p = wave(kMean, kMean, 0.5, 0);
  const double force = 150 / kRadius, rest = force / kMean;
  LumpedOscillator o(p, force, 16);
  const auto energy = [&](const State& y) {
    const double x = std::max(0.0, y[0]);
    return 0.5 * kMass * y[1] * y[1] + 0.5 * kMean * x * x - force * y[0];
  };
  // Amplitude 2 rests about rest; frequency over the natural one: pi / (acos(-1/2) + sqrt(3)).
  const double ratio = std::numbers::pi / (std::acos(-0.5) + std::sqrt(3.0));
  CHECK(ratio == relative(0.821021054, 1e-9));
  o.set_speed(ratio * std::sqrt(kMean / kMass) / (2 * std::numbers::pi));
  const State start(3 * rest, 0);
  State y = start;
  for (int i = 0; i < 1000; ++i) o.integrate(y);
  CHECK(o.size(y - start) < 1e-9);

  o.set_speed(1777);  // now events fall anywhere in the period
  y = start;
  LumpedEnergyBalance energy_balance;
  const LumpedRecord r = o.record(y, energy_balance);
  CHECK(r.separations >= 1);
  double largest = 0;
  for (int i = 0; i < 100000; ++i) {
    o.integrate(y);
    largest = std::max(largest, std::abs(energy(y) - energy(start)));
  }
  CHECK(largest / (energy(start) + 0.5 * force * rest) < 1e-10);
}

TEST_CASE("lumped: works and stored energies balance, with contact loss and without") {
  LumpedOscillator o = oscillator(2.93973e8, 5.16658e8, 0.755, 0.08);
  const LumpedSpeeds integrate = integrate_speeds(o, speeds(3400, 2180, -20), 1e-6, false, no_report);
  int apart = 0;
  for (const LumpedOrbit& orbit : integrate.orbits) {
    CHECK(std::abs(orbit.energy_balance.imbalance()) < 1e-12 * orbit.energy_balance.throughput);
    CHECK(orbit.energy_balance.damping > 0);
    apart += orbit.record[0].separations;
  }
  CHECK(apart > 20);
}

TEST_CASE("lumped: the derivative of the period map is that of finite differences") {
  LumpedParameters base = wave(kLow, kHigh, 0.75, 0.07);
  LumpedParameters contact = base;
  contact.damper_acts = DamperActs::contact;
  LumpedParameters pairs = base;
  pairs.stiffness.resize(2, 2);
  pairs.gap.resize(2, 2);
  pairs.stiffness << kLow, 0.5 * kLow, 0.7 * kLow, 0.7 * kLow;
  pairs.gap << 0, 3e-6, 0, 0.5e-6;
  for (const LumpedParameters& p : {base, contact, pairs})
    for (int newmark : {0, 256}) {
      if (newmark > 0 && p.damper_acts == DamperActs::contact) continue;
      LumpedOscillator o(p, 150 / kRadius, 64, newmark);
      o.set_speed(2550);
      const State y(6 * o.reference(), -1e-3);  // parts within the period
      State end = y;
      Matrix m = Matrix::Identity(), differences;
      o.integrate(end, &m);
      const State unit(o.reference(), o.reference() * 2 * std::numbers::pi * o.natural_frequency());
      for (int k = 0; k < 2; ++k) {
        State plus = y, minus = y;
        plus[k] += 1e-6 * unit[k];
        minus[k] -= 1e-6 * unit[k];
        o.integrate(plus);
        o.integrate(minus);
        differences.col(k) = (plus - minus) / (2e-6 * unit[k]);
      }
      const Matrix scale = unit.cwiseInverse().asDiagonal() * (m - differences) * unit.asDiagonal();
      CHECK(scale.cwiseAbs().maxCoeff() < 1e-6);
      LumpedEnergyBalance energy_balance;
      end = y;
      CHECK(o.record(end, energy_balance).separations > 0);
    }
}

TEST_CASE("lumped: a damper in contact only lets a mass bounce with the restitution of half an oscillation") {
  LumpedParameters p = wave(kMean, kMean, 0.5, 0.07);
  const double force = 1e-6, natural = std::sqrt(kMean / kMass);
  const auto leaves = [&](DamperActs acts) {
    p.damper_acts = acts;
    LumpedOscillator o(p, force, 16);
    o.set_speed(natural / (2 * std::numbers::pi) / 0.8);
    State y(0, 1);
    o.integrate(y);
    CHECK(y[0] < 0);
    return std::sqrt(y[1] * y[1] - 2 * force / kMass * y[0]);
  };
  CHECK(leaves(DamperActs::contact) ==
        relative(std::exp(-std::numbers::pi * 0.07 / std::sqrt(1 - 0.07 * 0.07)), 1e-9));
  CHECK(leaves(DamperActs::always) < 0.79);

  // Less is damped than by Eq. 23, so that the upper branch is longer.
  LumpedParameters q = wave(kLow, kHigh, 0.75, 0.08);
  q.damper_acts = DamperActs::contact;
  LumpedOscillator o(q, 150 / kRadius, 64);
  const auto ends = folds(o, 1800, 2800);
  CHECK(ends[0] < 2200);
  CHECK(ends[1] == relative(2679.466389, 3e-3));
}

TEST_CASE("lumped: Newmark's method is of second order against the exact motion") {
  const double at[2] = {3200, 2300};  // contact kept; lost
  for (const double f : at) {
    std::vector<double> step, error;
    LumpedOscillator exact = oscillator(2.93973e8, 5.16658e8, 0.755, 0.08);
    const LumpedSpeeds integrate = integrate_speeds(exact, speeds(3400, f, -20), 1e-6, false, no_report);
    const State start = integrate.orbits.back().start;
    for (int steps : {64, 128, 256, 512, 1024, 2048}) {
      LumpedOscillator newmark = oscillator(2.93973e8, 5.16658e8, 0.755, 0.08, 150, steps);
      exact.set_speed(f);
      newmark.set_speed(f);
      State a = start, b = start;
      for (int i = 0; i < 5; ++i) {
        exact.integrate(a);
        newmark.integrate(b);
      }
      step.push_back(1.0 / steps);
      error.push_back(exact.size(b - a));
    }
    const double order = slope(step, error);
    CHECK(order > 1.9);
    CHECK(order < 2.3);
    CHECK(error.back() < 1e-4);
  }
}

TEST_CASE("lumped: cells that carry the means of a curve converge with their square") {
  const int n = 4096;
  Eigen::VectorXd curve(n);
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n;
    curve[i] = kMean * (1 + 0.25 * std::cos(t) + 0.1 * std::sin(2 * t));
  }
  const auto rms = [&](int cells, int newmark) {
    LumpedParameters p = cells_of(curve, cells);
    CHECK(p.cell_end.size() == cells + 1);
    p.mass = kMass;
    p.damper = 2 * 0.08 * std::sqrt(kMean * kMass);
    p.damper_acts = DamperActs::always;
    LumpedOscillator o(p, 150 / kRadius, 8, newmark);
    CHECK(o.mean_stiffness() == relative(kMean, 1e-12));
    return steady(o, 2500).rms;
  };
  const double finest = rms(n, 0);
  std::vector<double> step, error;
  for (int cells : {16, 32, 64, 128, 256}) {
    step.push_back(1.0 / cells);
    error.push_back(std::abs(rms(cells, 0) / finest - 1));
  }
  CHECK(slope(step, error) == relative(2, 0.1));
  CHECK(error[3] < 1e-3);
  CHECK(rms(n, n) == relative(finest, 1e-5));
}

TEST_CASE("lumped: models from a static result") {
  const StaticResult s = static_transmission(paper_body(), paper_body(), paper_statics(128), 150);
  const double force = 150 / kRadius;
  // A spring per pair: at rest at the static positions.
  Eigen::VectorXi numbers;
  LumpedParameters pairs = cells_of_pairs(s, 128, numbers);
  REQUIRE(pairs.stiffness.cols() == numbers.size());
  double worst = 0;
  for (int i = 0; i < 128; ++i) {
    double sum = 0;
    for (Eigen::Index n = 0; n < numbers.size(); ++n)
      sum += pairs.stiffness(i, n) * std::max(0.0, s.transmission_error[i] - pairs.gap(i, n));
    worst = std::max(worst, std::abs(sum / force - 1));
  }
  CHECK(worst < 1e-9);
  // The two halves of the cell about phase 0 are one cell with its pairs counted anew.
  for (Eigen::Index n = 1; n < numbers.size(); ++n)
    CHECK(std::abs(pairs.gap(128, n - 1) - pairs.gap(0, n)) < 1e-15);

  LumpedOptions o;
  o.mass = 1.4;
  o.direction = Direction::down;
  o.frequency_from = 2000;
  o.frequency_to = 2200;
  o.frequency_step = 100;
  for (const auto model :
       {MotionModel::secant, MotionModel::tangent, MotionModel::pairs, MotionModel::rectangular}) {
    o.model = model;
    const LumpedParameters springs =
        model == MotionModel::pairs ? pairs
        : model == MotionModel::rectangular
            ? cells_of(s.rectangular_wave)
            : cells_of(model == MotionModel::secant ? s.stiffness_secant : s.stiffness_tangent, 128);
    const SweepResult a = lumped_sweep(
        s, springs, model == MotionModel::pairs ? numbers : Eigen::VectorXi::Zero(1).eval(), o, no_report);
    CHECK(a.mesh_frequency[0] == 2200);
    CHECK(a.period_multiple.minCoeff() == 1);
    CHECK(a.residual.maxCoeff() < 1e-12);
    CHECK(a.energy_imbalance.cwiseAbs().maxCoeff() < 1e-12);
    for (const MatrixRM& one : a.mesh_force) CHECK(one.minCoeff() >= 0);
    if (model == MotionModel::secant || model == MotionModel::pairs)
      CHECK(a.mean_stiffness == relative(s.mean_stiffness, 1e-4));
    // The mean force over an orbit is the static one: the mass gains nothing and the damper's mean is 0.
    CHECK(a.mesh_force[0].mean() == relative(force, 2e-3));
    const ResponseResult r = response(a);
    CHECK(r.model == model);
    CHECK(r.separation_fraction.maxCoeff() == 0);
  }
  // A spring per pair and the whole mesh's secant agree where pairs neither come nor go earlier than at rest.
  const auto at_rest = [&](const LumpedParameters& p) {
    LumpedParameters q = p;
    q.mass = kMass;
    q.damper_acts = DamperActs::always;
    return LumpedOscillator(q, force, 8).rest()[0];
  };
  CHECK(at_rest(pairs) == relative(s.transmission_error[0], 1e-9));
  CHECK(at_rest(cells_of(s.stiffness_secant, 128)) == relative(s.transmission_error[0], 1e-4));
}

TEST_CASE(
    "lumped: pairs under Hertz's law, as a polygon, against Runge and Kutta's method on the law itself") {
  const int cells = 128;
  const StaticResult s = static_transmission(paper_body(), paper_body(), paper_statics(cells), 150);
  const double force = 150 / kRadius;
  Eigen::VectorXi pair_numbers, spring_numbers;
  const LumpedParameters linear = cells_of_pairs(s, cells, pair_numbers);

  // The law of each pair in each cell, from loads and deflections of the linear springs at rest; a pair that is not loaded
  // there has that of the nearest of its phases at which it is.
  const Eigen::Index pairs = pair_numbers.size();
  MatrixRM rest = MatrixRM::Zero(cells + 1, pairs);
  std::vector<std::array<double, 2>> loaded;  // own phase, load
  for (int j = 0; j < cells; ++j)
    for (Eigen::Index n = 0; n < pairs; ++n) {
      rest(j, n) = linear.stiffness(j, n) * (s.transmission_error[j] - linear.gap(j, n));
      if (rest(j, n) > 1e-9 * force) loaded.push_back({double(j) / cells + pair_numbers[n], rest(j, n)});
    }
  for (int j = 0; j <= cells; ++j)
    for (Eigen::Index n = 0; n < pairs; ++n) {
      const double phase = double(j) / cells + pair_numbers[n];
      if (j < cells && rest(j, n) > 1e-9 * force) continue;
      rest(j, n) = (*std::min_element(loaded.begin(), loaded.end(), [&](const auto& a, const auto& b) {
        return std::abs(a[0] - phase) < std::abs(b[0] - phase);
      }))[1];
    }
  // Of each pair of surfaces in plane stress: Johnson (1985), Eq. (5.57) and its constants apart.
  const double coefficient = 2 * 2 / (std::numbers::pi * 207e9 * 0.0254);
  const auto law = [&](int cell, Eigen::Index n, double x) {
    const double k = linear.stiffness(cell, n), deflection = x - linear.gap(cell, n);
    if (k == 0 || deflection <= 0) return 0.0;
    double low = 0, high = 4 * k * deflection;
    for (int i = 0; i < 60; ++i) {
      const double f = 0.5 * (low + high);
      (f * (1 / k + 0.5 * coefficient * std::log(rest(cell, n) / f)) < deflection ? low : high) = f;
    }
    return 0.5 * (low + high);
  };

  const double mesh_frequency = 2400, damper = 2 * 0.07 * std::sqrt(kMean * kMass);
  const State start(2.2 * s.transmission_error[0], 0);
  // x at 64 samples of two periods, integrated by the oscillator
  const auto polygon = [&](int chords) {
    LumpedParameters p = cells_of_pairs(s, cells, spring_numbers, chords);
    p.mass = kMass;
    p.damper = damper;
    p.damper_acts = DamperActs::always;
    LumpedOscillator o(p, force, 32);
    CHECK(o.rest()[0] == relative(s.transmission_error[0], 1e-9));
    o.set_speed(mesh_frequency);
    State y = start;
    LumpedEnergyBalance energy_balance;
    Eigen::VectorXd x(64);
    double least = 1;
    for (int period = 0; period < 2; ++period) {
      const LumpedRecord r = o.record(y, energy_balance);
      x.segment(32 * period, 32) = r.x;
      least = std::min(least, r.least);
    }
    CHECK(std::abs(energy_balance.imbalance()) < 1e-12 * energy_balance.throughput);
    CHECK(least < 0);  // contact is lost on the way
    return x;
  };
  Eigen::VectorXd exact(64);
  {
    const int parts = 8;  // steps in half a cell, where cells end
    const double h = 1 / (mesh_frequency * 2 * cells * parts);
    State y = start;
    for (int i = 0; i < 2 * 2 * cells * parts; ++i) {
      const int half = i / parts % (2 * cells), cell = (half + 1) / 2;
      const auto rate = [&](const State& at) {
        double f = force - damper * at[1];
        for (Eigen::Index n = 0; n < pairs; ++n) f -= law(cell, n, at[0]);
        return State(at[1], f / kMass);
      };
      if (i % (2 * cells * parts / 32) == 0) exact[i / (2 * cells * parts / 32)] = y[0];
      const State a = rate(y), b = rate(y + 0.5 * h * a), c = rate(y + 0.5 * h * b), d = rate(y + h * c);
      y += h / 6 * (a + 2 * b + 2 * c + d);
    }
  }
  const double size = exact.cwiseAbs().maxCoeff();
  const auto apart = [&](const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
    return (one - other).cwiseAbs().maxCoeff() / size;
  };
  const Eigen::VectorXd coarse = polygon(16), fine = polygon(32), finest = polygon(64);
  MESSAGE("16 chords are off by ", apart(coarse, exact), ", from 32 by ", apart(coarse, fine),
          ", these from 64 by ", apart(fine, finest), "; linear springs are off by ",
          apart(polygon(0), exact));
  CHECK(apart(coarse, exact) < 1e-3);
  CHECK(apart(polygon(0), exact) > 0.02);
  CHECK(apart(fine, finest) < 0.4 * apart(coarse, fine));

  // Springs of one pair are one pair in the sweep.
  LumpedOptions o;
  o.model = MotionModel::pairs_hertz;
  o.mass = kMass;
  o.direction = Direction::up;
  o.frequency_from = o.frequency_to = 2000;
  o.frequency_step = 100;
  const LumpedParameters springs = cells_of_pairs(s, cells, spring_numbers, 16);
  const SweepResult a = lumped_sweep(s, springs, spring_numbers, o, no_report);
  REQUIRE(a.pair == pair_numbers);
  REQUIRE(a.tooth_load[0].cols() == pairs);
  CHECK(a.mesh_force[0].mean() == relative(force, 2e-3));
}

TEST_CASE("lumped: figures hold the numbers of their sweeps") {
  const StaticResult s = static_transmission(paper_body(), paper_body(), paper_statics(128), 150);
  const RectangularWave wave = stated_wave(s, 2.93973e8, 5.16658e8, 0.755);
  LumpedOptions o;
  o.mass = 1.4;
  o.model = MotionModel::rectangular;
  o.frequency_from = 2100;
  o.frequency_to = 2600;
  o.frequency_step = 50;
  std::vector<SweepResult> sweeps;
  std::vector<ResponseResult> responses;
  for (const Direction direction : {Direction::down, Direction::up}) {
    o.direction = direction;
    sweeps.push_back(lumped_sweep(s, cells_of(wave), Eigen::VectorXi::Zero(1), o, no_report));
    responses.push_back(response(sweeps.back()));
  }
  const Figure forces = mesh_force_figure({sweeps[0], sweeps[1]}, {2200, 2160});
  REQUIRE(forces.blocks.size() == 4);
  CHECK(forces.blocks[2].name == "a 2");
  CHECK(forces.blocks[2].rows.size() == 257);
  CHECK(forces.blocks[2].rows[128 + 5][1] == relative(sweeps[1].mesh_force[2](5, 0), 1e-12));  // 2200 Hz
  CHECK(forces.blocks[3].rows[5][1] == relative(sweeps[1].mesh_force[1](5, 0), 1e-12));        // 2150 Hz
  CHECK(!contains(forces.notes[0], "dashed"));
  CHECK(contains(forces.notes[0], "rectangular stiffness, 294.0 to 516.7"));
  CHECK(contains(forces.notes[1], "jump at 2525.3 Hz"));
  REQUIRE(forces.panels.size() == 2);
  const char* const labels[2][2] = {{"2200 Hz, ratio 1.758, before its jump at 2172 Hz",
                                     "2200 Hz, ratio 1.758, before its jump at 2525 Hz"},
                                    {"2150 Hz, ratio 1.758, after its jump at 2172 Hz",
                                     "2150 Hz, ratio 1.758, before its jump at 2525 Hz"}};
  for (size_t panel : {0, 1})
    for (const char* label : labels[panel]) CHECK(has_label(forces.panels[panel], label));

  const CaptionSources captions{{}, {sweeps[0].lumped, sweeps[1].lumped}, {}};
  const Figure curves = response_figure(responses, captions);
  REQUIRE(curves.blocks.size() == 4);
  CHECK(curves.blocks[0].name == "a 150 N m up");
  CHECK(curves.blocks[0].rows[0][1] == relative(1e6 * responses[1].dte_rms(0, 0), 1e-12));
  CHECK(curves.blocks[2].name == "a 150 N m down");
  REQUIRE(curves.blocks[3].rows.size() == 1);
  CHECK(curves.blocks[3].rows[0][0] == relative(2171.615284, 1e-6));
  REQUIRE(curves.blocks[1].rows.size() == 1);
  CHECK(curves.blocks[1].rows[0][0] == relative(2525.315708, 1e-6));
  CHECK(contains(curves.notes[1], "mass 1.4 kg, damping ratio 8 %"));
  CHECK(curves.notes[2].find("(a) 150 N m: jumps rising 2525, falling 2172 Hz; ") == 0);
  CHECK_THROWS_AS(mesh_force_figure({}, {2200}), Error);
  CHECK_THROWS_AS(mesh_force_figure({sweeps[0]}, {}), Error);
  CHECK_THROWS_AS(mesh_force_figure({SweepResult{}}, {2200}), Error);
}

TEST_CASE("lumped: what is no model is rejected by name") {
  const auto rejects = [&](const std::function<void(LumpedParameters&)>& change,
                           const std::vector<Field>& fields, double force = 2000, int newmark = 0) {
    LumpedParameters p = wave(kLow, kHigh, 0.75, 0.08);
    change(p);
    CHECK(names(message_of_input([&] { LumpedOscillator(p, force, 16, newmark); }), fields));
  };
  rejects([](auto& p) { p.mass = 0; }, {"mass", 0});
  rejects([](auto& p) { p.mass = NAN; }, {"mass", "nan"});
  rejects([](auto& p) { p.damper = -1; }, {"damper", "-1"});
  rejects([](auto& p) { p.damper_acts = DamperActs::contact; }, {"exact", "integrator"}, 2000, 64);
  rejects([](auto& p) { p.stiffness(0, 0) = -1; }, {"stiffness", 0});
  rejects([](auto& p) { p.stiffness.setZero(); }, {"spring"});
  rejects([](auto& p) { p.cell_end[1] = 0.9; }, {"phase", "0.9"});
  rejects([](auto& p) { p.cell_end[0] = 1.2; }, {"ascend"});
  rejects([](auto& p) { p.gap.resize(1, 1); }, {"gaps"});
  rejects([](auto&) {}, {"force", 0}, 0);
  StaticResult place;
  place.gear[0].design = place.gear[1].design = paper_gear();
  place.mesh.centre_distance = 0.15;
  place.torque = 150;
  place.mesh_phase = Eigen::VectorXd::LinSpaced(2, 0, 0.5);
  place.stiffness_secant = Eigen::Vector2d(kLow, kHigh);
  CHECK(names(message_of_input([&] { stated_wave(place, -1, 1e8, 0.5); }), {"-1", "level"}));
  CHECK(names(message_of_input([&] { stated_wave(place, 1e8, 0, 0.5); }), {0, "level"}));
  CHECK(names(message_of_input([&] { stated_wave(place, 1e-3, 1e8, 0.5); }), {"0.001", "709451*"}));
  CHECK(names(message_of_input([&] { stated_wave(place, 2e8, 1e8, 0.5); }), {100000000, "stiffness"}));
  CHECK(names(message_of_input([&] { stated_wave(place, 1e8, 1e8, 1); }), {"duty"}));
  CHECK(names(message_of_input([&] { stated_wave(place, 1e8, 1e8, 0); }), {"duty"}));
  CHECK(names(message_of_input([&] { cells_of(Eigen::VectorXd::Zero(8), 8); }), {0, "least"}));
  CHECK(names(message_of_input([&] { cells_of(Eigen::VectorXd::Ones(8), 0); }), {0, "cells"}));
  LumpedOscillator o = oscillator(kLow, kHigh, 0.75, 0.08);
  CHECK(names(message_of_input([&] { o.set_speed(0); }), {0, "frequency"}));
}

TEST_CASE("lumped: a cell of a map of jumps is what sweeps up and down of that model say") {
  StaticResult statics;
  statics.gear[0].design = statics.gear[1].design = paper_body(40e-3, 0.8e-3).design;
  statics.mesh = paper_statics(128).mesh;
  statics.torque = 150;
  statics.mesh_phase = Eigen::VectorXd::LinSpaced(8, 0, 0.875);
  statics.stiffness_secant = Eigen::VectorXd::Constant(8, kMean);
  statics.rectangular_wave = rectangular_wave(statics);
  LumpedOptions o;
  o.model = MotionModel::rectangular;
  o.mass = kMass;
  o.time.steps_per_period = 128;
  MapSpeeds range;
  range.from = 2200;
  range.to = 3000;
  range.step = 40;
  range.load_frequency = 2640;
  const LumpedParameters springs = wave(kLow, kHigh, 0.75, 0.07);
  const Eigen::VectorXi numbers = Eigen::VectorXi::Zero(1);
  long reports = 0;
  const JumpMapResult map = lumped_jump_map(statics, springs, numbers, o, range, {0.07, 0.2},
                                            [&](long done, long total, const std::string&) {
                                              CHECK(done == ++reports);
                                              CHECK(total == 4);
                                            });
  CHECK(reports == 4);
  CHECK(map.model == MotionModel::rectangular);
  // Folds at 7 % from another program, see above; at 20 % contact is kept.
  CHECK(map.branches_from[0] == relative(2464.654182, 1e-8));
  CHECK(map.branches_to[0] == relative(2638.199272, 1e-8));
  CHECK(map.two_branches[1] == 0);
  CHECK(map.loss_to[1] == 0);
  // Fourier: 2 (k2 - k1) sin(pi d) / pi.
  CHECK(map.first_harmonic ==
        relative(2 * (kHigh - kLow) * std::sin(0.75 * std::numbers::pi) / std::numbers::pi, 1e-9));
  CHECK(map.mean_stiffness == relative(kMean, 1e-6));
  o.frequency_from = 2200;
  o.frequency_to = 3000;
  o.frequency_step = 40;
  o.damping_ratio = 0.07;
  for (const Direction direction : {Direction::up, Direction::down}) {
    o.direction = direction;
    const SweepResult alone = lumped_sweep(statics, springs, numbers, o, no_report);
    REQUIRE(alone.jump_frequency.size() == 1);
    const int d = direction == Direction::up ? 0 : 1;
    CHECK((d == 0 ? map.branches_to : map.branches_from)[0] == alone.jump_frequency[0]);
    for (Eigen::Index i = 0; i < alone.mesh_frequency.size(); ++i) {
      const Eigen::Index row = d == 0 ? i : alone.mesh_frequency.size() - 1 - i;
      REQUIRE(map.mesh_frequency[row] == relative(alone.mesh_frequency[i], 1e-12));
      CHECK(map.dte_rms[d](0, row) == relative(rms(alone, i), 1e-12));
      CHECK(map.tooth_load_max[d](0, row) == alone.tooth_load[i].maxCoeff());
    }
  }
  o.damper_acts = DamperActs::contact;
  CHECK(lumped_jump_map(statics, springs, numbers, o, range, {0.07}, no_report).damper_acts ==
        DamperActs::contact);
  const auto rejected = [&](const MapSpeeds& speeds, const std::vector<double>& ratios,
                            const std::vector<Field>& fields) {
    CHECK(names(
        message_of_input([&] { lumped_jump_map(statics, springs, numbers, o, speeds, ratios, no_report); }),
        fields));
  };
  rejected(range, {}, {"case"});
  rejected(range, {0.07, 1.5}, {"damping", "1.5"});
  range.load_frequency = 3200;
  rejected(range, {0.07}, {3200});
}

TEST_CASE("lumped: jumps of a helical pair, its stiffness as the length of its contact lines") {
  // Found by another program, exact in its events.
  constexpr double kAcross = 1.754673;  // transverse contact ratio
  const double known[][3] = {{0.25, 1811.5251, 2469.6429}, {0.5, 2578.9977, 2695.5741}};
  for (const auto& [overlap, down, up] : known) {
    constexpr int kCells = 1024;
    Eigen::VectorXd stiffness(kCells);
    for (int i = 0; i < kCells; ++i) {
      double length = 0;  // of all pairs, over that of a whole line
      for (int j = -1; j < 4; ++j) {
        const double at = static_cast<double>(i) / kCells + j;
        length += std::max(0.0, std::min(at, overlap) - std::max(0.0, at - kAcross)) / overlap;
      }
      stiffness[i] = kMean * length / kAcross;
    }
    LumpedParameters p = cells_of(stiffness, kCells);
    p.mass = kMass;
    p.damping_ratio = 0.05;
    p.damper = 2 * p.damping_ratio * std::sqrt(kMean * kMass);
    p.damper_acts = DamperActs::always;
    LumpedOscillator o(p, 150 / kRadius, 64, 0);
    const std::array<double, 2> found = folds(o, 1750, 2950);
    CHECK(found[0] == relative(down, 0.1 / down));
    CHECK(found[1] == relative(up, 0.1 / up));
  }
}
