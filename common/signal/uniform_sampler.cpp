#include "signal/uniform_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace whine {
namespace {

using Eigen::Index;

constexpr int kPerSample = 1024;  // table entries; a straight line between them is 1.2e-6 off

// Kaiser's beta for 80 dB: 0.1102 (80 - 8.7).
constexpr double kBeta = 7.857;

// Kaiser's window, I0 the modified Bessel function of order 0.
double window(double u) {
  const auto bessel_i0 = [](double x) { return std::cyl_bessel_i(0, x); };
  return u >= 1 ? 0 : bessel_i0(kBeta * std::sqrt(1 - u * u)) / bessel_i0(kBeta);
}

}  // namespace

UniformSampler::UniformSampler(double rate, Index count, int channels)
    : rate_(rate), count_(count), channels_(channels), rows_(2 * kHalfWidth + 3) {
  if (!(rate > 0) || count < 1 || channels < 1)
    fail(Failure::numerical, "a record of ", count, " samples at ", rate, " Hz is empty");
  for (int i = 0; i <= kHalfWidth * kPerSample + 1; ++i) {
    const double u = static_cast<double>(i) / kPerSample, angle = std::numbers::pi * u;
    table_.push_back((i == 0 ? 1 : std::sin(angle) / angle) * window(u / kHalfWidth));
  }
  sums_.assign(static_cast<size_t>(rows_) * static_cast<size_t>(channels_ + 1), 0.0);
}

void UniformSampler::push(double t, double weight, const double* x) {
  const double at = t * rate_;
  for (; first_ < count_ && static_cast<double>(first_) + kHalfWidth <= at; ++first_) {
    double* sum = row(first_);
    if (!(std::abs(sum[channels_]) > 0))
      fail(Failure::numerical, "no instant within ", kHalfWidth, " samples of ",
           static_cast<double>(first_) / rate_, " s");
    for (int c = 0; c < channels_; ++c) ready_.push_back(sum[c] / sum[channels_]);
    std::fill(sum, sum + channels_ + 1, 0.0);
  }
  const Index low = std::max(first_, static_cast<Index>(std::floor(at)) - kHalfWidth + 1),
              high = std::min(count_ - 1, static_cast<Index>(std::floor(at)) + kHalfWidth);
  for (Index k = low; k <= high; ++k) {
    const double place = std::abs(static_cast<double>(k) - at) * kPerSample;
    const auto entry = static_cast<size_t>(place);
    if (entry + 1 >= table_.size()) continue;
    const double rest = place - static_cast<double>(entry),
                 h = weight * (table_[entry] + rest * (table_[entry + 1] - table_[entry]));
    double* sum = row(k);
    for (int c = 0; c < channels_; ++c) sum[c] += h * x[c];
    sum[channels_] += h;
  }
}

MatrixRM UniformSampler::take() {
  const auto rows = static_cast<Index>(ready_.size()) / channels_;
  MatrixRM out = Eigen::Map<const MatrixRM>(ready_.data(), rows, channels_);
  ready_.clear();
  return out;
}

}  // namespace whine
