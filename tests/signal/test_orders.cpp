// Orders and spectra of records whose speed changes, and even samples of uneven instants, against signals of known amplitudes.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "refusal.h"
#include "relative.h"
#include "signal/orders.h"
#include "signal/uniform_sampler.h"

using namespace whine;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi, kRate = 48000;

// A ramp of the mesh frequency with orders 1 to 3, each of an amplitude that varies with the speed.
struct Chirp {
  double from, acceleration, seconds;
  double frequency(double t) const { return from + acceleration * t; }
  double phase(double t) const { return t * (from + 0.5 * acceleration * t); }
  double time(double phase) const {
    return 2 * phase / (from + std::sqrt(from * from + 2 * acceleration * phase));
  }
  double amplitude(int n, double t) const {
    const double away = (n * frequency(t) - 2900) / 600;  // as a resonance of the pair
    return (n == 2 ? 0.3 : 1.0 / n) * (0.2 + 1 / (1 + away * away));
  }
  double at(double t) const {
    double sum = 5;
    for (int n = 1; n <= 3; ++n) sum += amplitude(n, t) * std::cos(kTwoPi * n * phase(t) + 0.4 * n);
    return sum;
  }
};

}  // namespace

TEST_CASE("orders of a chirp of known amplitudes to 3e-6 (slow), 6e-5 and 2e-4 (fast ramp) of the largest") {
  for (const auto& [chirp, bound] :
       {std::pair{Chirp{1500, 83.3, 6}, 3e-6}, std::pair{Chirp{1500, 833, 2}, 6e-5},
        std::pair{Chirp{4000, -8330, 0.3}, 2e-4}}) {
    const auto samples = static_cast<Index>(chirp.seconds * kRate);
    VectorXd x(samples), phase(samples);
    for (Index k = 0; k < samples; ++k) {
      x[k] = chirp.at(static_cast<double>(k) / kRate);
      phase[k] = chirp.phase(static_cast<double>(k) / kRate);
    }
    const double middle = chirp.frequency(chirp.seconds / 2);
    const int width = order_width(middle, chirp.acceleration);
    const OrderCuts cuts = order_cuts(x, phase, 4, width);
    CHECK(cuts.phase.size() > 20);
    double worst = 0;
    for (Index c = 0; c < cuts.phase.size(); ++c)
      for (int n = 1; n <= 4; ++n) {
        const double known = n == 4 ? 0 : chirp.amplitude(n, chirp.time(cuts.phase[c]));
        worst = std::max(worst, std::abs(cuts.amplitude(c, n - 1) - known));
      }
    INFO("acceleration " << chirp.acceleration << " Hz/s, window " << width << " periods: " << worst);
    CHECK(worst < bound);
  }
}

TEST_CASE("an amplitude that varies over the angle is averaged by the Hann window: A + 0.0163 width^2 A''") {
  const double a = 0.5 * 3e-4;  // half of A''
  constexpr int kWidth = 32;
  const VectorXd phase = VectorXd::LinSpaced(48001, 0, 400);  // 120 samples a mesh period
  const auto amplitude = [&](double p) { return 3 + a * (p - 200) * (p - 200); };
  const VectorXd x = phase.unaryExpr([&](double p) { return amplitude(p) * std::cos(kTwoPi * p + 0.4); });
  const OrderCuts cuts = order_cuts(x, phase, 1, kWidth);
  const double half_moment = 0.5 * (1.0 / 12 - 0.5 / (std::numbers::pi * std::numbers::pi));
  CHECK(half_moment == relative(0.0163, 3e-3));
  for (Index c = 0; c < cuts.phase.size(); ++c)
    CHECK(cuts.amplitude(c, 0) - amplitude(cuts.phase[c]) ==
          relative(half_moment * kWidth * kWidth * 2 * a, 1e-2));
}

TEST_CASE("orders of constant amplitude: to 2e-6 of the mean beside them, in windows of 150 samples") {
  const Chirp chirp{2000, 5000, 0.2};
  constexpr double kMean = 1e3;
  const auto samples = static_cast<Index>(chirp.seconds * kRate);
  VectorXd x(samples), phase(samples);
  for (Index k = 0; k < samples; ++k) {
    phase[k] = chirp.phase(static_cast<double>(k) / kRate);
    x[k] = kMean + 100 * std::cos(kTwoPi * phase[k]) + 0.5 * std::sin(3 * kTwoPi * phase[k]);
  }
  const OrderCuts cuts = order_cuts(x, phase, 3, 8);
  for (Index c = 0; c < cuts.phase.size(); ++c) {
    CHECK(std::abs(cuts.amplitude(c, 0) - 100) < 2e-6 * kMean);
    CHECK(std::abs(cuts.amplitude(c, 1)) < 2e-6 * kMean);
    CHECK(std::abs(cuts.amplitude(c, 2) - 0.5) < 2e-6 * kMean);
  }
}

TEST_CASE("a spectrogram has a tone's amplitude on its bin, and the window follows the ramp") {
  VectorXd x(48000);
  for (Index k = 0; k < x.size(); ++k) x[k] = 2 * std::cos(kTwoPi * 3000 * static_cast<double>(k) / kRate);
  const Spectrogram s = spectrogram(x, kRate, 1024, 7, 5000);
  CHECK(s.amplitude.rows() == 7);
  for (Index i = 0; i < 7; ++i) CHECK(s.amplitude(i, 64) == relative(2, 1e-9));
  CHECK(s.frequency[64] == relative(3000, 1e-12));
  CHECK(spectrogram_length(kRate, 83.3) == 4096);
  CHECK(spectrogram_length(kRate, 8333) == 512);
}

TEST_CASE("records too short, orders too high are rejected") {
  const VectorXd phase = VectorXd::LinSpaced(100, 0, 3), x = VectorXd::Ones(100);
  CHECK(failure_of([&] { order_cuts(x, phase, 2, 4); }) == Failure::input);
  CHECK(failure_of([&] { order_cuts(x, 10 * phase, 2, 4); }) == Failure::input);
  CHECK(failure_of([&] { spectrogram(x, kRate, 1024, 3, 5000); }) == Failure::input);
}

TEST_CASE("even samples of uneven instants, also where the number of steps changes") {
  // Instants at even phases of a ramp, 128 a period, and 64 from a period on; weights as a run-up has them.
  const double f0 = 2000, a = 6000;
  const auto time = [&](double phase) { return 2 * phase / (f0 + std::sqrt(f0 * f0 + 2 * a * phase)); };
  constexpr Index kSamples = 4000;
  for (const double tone : {0.0, 500.0, 5000.0, 18000.0}) {
    UniformSampler sampler(kRate, kSamples, 2);
    const auto signal = [&](double t) { return 1 + std::cos(kTwoPi * tone * t + 0.3); };
    constexpr int kSwitch = 80;
    for (int period = -3; !sampler.complete(); ++period) {
      const int steps = period < kSwitch ? 128 : 64;
      for (int i = 0; i < steps; ++i) {
        const double share = static_cast<double>(i) / steps, phase = period + share;
        const double t = phase < 0 ? phase / f0 : time(phase);
        double weight = 1 / ((f0 + a * std::max(t, 0.0)) * steps);
        if (period == kSwitch - 1) {
          const double fine = 0.5 + 0.5 * std::cos(std::numbers::pi * share);
          weight *= fine + (i % 2 == 0 ? 2 * (1 - fine) : 0);
        }
        const double x[2] = {signal(t), 3 * signal(t)};
        sampler.push(t, weight, x);
      }
    }
    const MatrixRM y = sampler.take();
    REQUIRE(y.rows() == kSamples);
    double worst = 0;
    for (Index k = 0; k < kSamples; ++k)
      worst = std::max(worst, std::abs(y(k, 0) - signal(static_cast<double>(k) / kRate)));
    INFO("tone of " << tone << " Hz: " << worst);
    CHECK(worst < 1e-4);
    CHECK((y.col(1) - 3 * y.col(0)).cwiseAbs().maxCoeff() < 1e-13);
  }
}
