#include "signal/sound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "signal/spectrum.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

}  // namespace

Transfer::Transfer(const TransferFunction& rows) : rows_(rows) {
  const Index n = rows_.frequency.size();
  if (n < 2) fail(Failure::input, "transfer function: ", n, " rows; 2 are the least");
  for (Index i = 0; i < n; ++i) {
    if (!std::isfinite(rows_.frequency[i]) || !std::isfinite(rows_.magnitude[i]) ||
        !std::isfinite(rows_.phase[i]) || rows_.magnitude[i] < 0)
      fail(Failure::input, "transfer function: row ", i + 1, " is ", rows_.frequency[i], " Hz, ",
           rows_.magnitude[i], ", ", rows_.phase[i],
           " rad; finite numbers and a magnitude from 0 on are wanted");
    if (i > 0 && !(rows_.frequency[i] > rows_.frequency[i - 1]))
      fail(Failure::input, "transfer function: row ", i + 1, ": ", rows_.frequency[i], " Hz follows ",
           rows_.frequency[i - 1], " Hz; frequencies ascend");
    if (i > 0) rows_.phase[i] -= kTwoPi * std::round((rows_.phase[i] - rows_.phase[i - 1]) / kTwoPi);
  }
}

std::complex<double> Transfer::at(double frequency) const {
  const VectorXd& f = rows_.frequency;
  if (frequency < f[0] || frequency > f[f.size() - 1]) return 0;
  const Index above =
      std::clamp<Index>(std::upper_bound(f.begin(), f.end(), frequency) - f.begin(), 1, f.size() - 1);
  const double share = (frequency - f[above - 1]) / (f[above] - f[above - 1]);
  const auto between = [&](const VectorXd& v) { return v[above - 1] + share * (v[above] - v[above - 1]); };
  return std::polar(between(rows_.magnitude), between(rows_.phase));
}

VectorXd sound(const Eigen::Ref<const VectorXd>& record, double fundamental, const Transfer* transfer,
               double rate, Index samples) {
  // Below half of both rates: that of the record and that of the sound.
  const Index most = static_cast<Index>(std::ceil(0.5 * rate / fundamental)) - 1;
  const Index count = std::min<Index>(resolved_harmonics(record.size(), 1 << 20), most);
  const Eigen::VectorXcd c = fourier_coefficients(record, static_cast<int>(count));
  VectorXd out = VectorXd::Zero(samples);
  for (Index k = 1; k <= count; ++k) {
    const std::complex<double> tone =
        2.0 * c[k] * (transfer ? transfer->at(static_cast<double>(k) * fundamental) : 1.0);
    if (tone == 0.0) continue;
    const double turns = static_cast<double>(k) * fundamental / rate;  // per sample
    for (Index n = 0; n < samples; ++n) {
      const double angle = kTwoPi * std::fmod(turns * static_cast<double>(n), 1.0);
      out[n] += tone.real() * std::cos(angle) - tone.imag() * std::sin(angle);
    }
  }
  return out;
}

void fade(Eigen::Ref<VectorXd> signal, Index samples) {
  samples = std::min(samples, signal.size() / 2);
  for (Index n = 0; n < samples; ++n) {
    const double share =
        0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(n) / static_cast<double>(samples));
    signal[n] *= share;
    signal[signal.size() - 1 - n] *= share;
  }
}

double level(double rms, double reference) {
  return rms > 0 ? 20 * std::log10(rms / reference) : -std::numeric_limits<double>::infinity();
}

}  // namespace whine
