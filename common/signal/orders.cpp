#include "signal/orders.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/error.h"
#include "base/units.h"
#include "signal/spectrum.h"

namespace whine {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Ref = Eigen::Ref<const VectorXd>;

double hann(double share) {  // 0 to 1 over the window
  return 0.5 - 0.5 * std::cos(kTwoPi * share);
}

}  // namespace

OrderCuts order_cuts(const Ref& x, const Ref& phase, int orders, int width) {
  constexpr int kLeastWidth = 4;
  if (x.size() != phase.size() || x.size() < 3 || orders < 1 || width < kLeastWidth)
    fail(Failure::input, "orders of ", x.size(), " samples with ", phase.size(), " phases, ", orders,
         " orders in ", width, " mesh periods: give as many phases as samples, an order, ", kLeastWidth,
         " mesh periods");
  const Index last = x.size() - 1;
  const auto spacing = [&](Index k) { return 0.5 * (phase[k + 1] - phase[k - 1]); };
  const double steepest = std::max(spacing(1), spacing(last - 1));
  if (!(orders * steepest < 0.5))
    fail(Failure::input, "order ", orders, " reaches ", orders * steepest,
         " of the sample rate, which is above one half; ask for fewer orders");
  const double half = 0.5 * width, begin = phase[1] + half, end = phase[last - 1] - half;
  if (!(begin <= end))
    fail(Failure::input, "the record holds ", phase[last] - phase[0], " mesh periods, less than a window of ",
         width, "; take a longer ramp or fewer mesh periods");
  const Index cuts = static_cast<Index>((end - begin) / half) + 1;
  OrderCuts out{VectorXd(cuts), MatrixRM(cuts, orders)};
  Index first = 1;
  for (Index c = 0; c < cuts; ++c) {
    const double centre = begin + static_cast<double>(c) * half;
    while (phase[first] < centre - half) ++first;
    Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(orders);
    double weights = 0;
    for (Index k = first; k < last && phase[k] < centre + half; ++k) {
      const double weight = hann((phase[k] - centre + half) / width) * spacing(k);
      const std::complex<double> turn = std::polar(1.0, -kTwoPi * std::fmod(phase[k], 1.0));
      std::complex<double> power = 1;
      for (int n = 0; n < orders; ++n) sum[n] += weight * x[k] * (power *= turn);
      weights += weight;
    }
    out.phase[c] = centre;
    out.amplitude.row(c) = 2 * sum.cwiseAbs().transpose() / weights;
  }
  return out;
}

int order_width(double mesh_frequency, double acceleration) {
  constexpr double kChange = 5e-3;
  int width = 64;
  while (width > 4 && std::abs(acceleration) * width > kChange * mesh_frequency * mesh_frequency) width /= 2;
  return width;
}

Spectrogram spectrogram(const Ref& x, double rate, Index length, Index slices, double most) {
  if (x.size() < length || length < 4 || slices < 1)
    fail(Failure::input, "the record has ", x.size(), " samples, a window of its spectrogram ", length,
         "; take a longer ramp");
  const auto bins =
      std::min(length / 2 - 1, static_cast<Index>(std::floor(most / rate * static_cast<double>(length)))) + 1;
  const VectorXd window = VectorXd::NullaryExpr(
      length, [&](Index k) { return hann(static_cast<double>(k) / static_cast<double>(length)); });
  const double scale = 2 * static_cast<double>(length) / window.sum();
  Spectrogram out{VectorXd(slices), VectorXd(bins), MatrixRM(slices, bins)};
  for (Index i = 0; i < bins; ++i)
    out.frequency[i] = static_cast<double>(i) * rate / static_cast<double>(length);
  for (Index s = 0; s < slices; ++s) {
    const Index at = slices == 1 ? 0 : (x.size() - length) * s / (slices - 1);
    const VectorXd part = x.segment(at, length).cwiseProduct(window);
    out.time[s] = (static_cast<double>(at) + 0.5 * static_cast<double>(length)) / rate;
    out.amplitude.row(s) =
        scale * fourier_coefficients(part, static_cast<int>(bins) - 1).cwiseAbs().transpose();
  }
  return out;
}

Index spectrogram_length(double rate, double sweep) {
  Index length = 64;
  while (length < 65536 &&
         static_cast<double>(length) * std::numbers::sqrt2 < rate / std::sqrt(2 * std::abs(sweep)))
    length *= 2;
  return length;
}

}  // namespace whine
