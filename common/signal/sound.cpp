#include "signal/sound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/units.h"
#include "signal/spectrum.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

void require_record(const Eigen::Ref<const VectorXd>& record) {
  if (record.size() < 2) fail(Failure::input, "sound: ", record.size(), " samples; two are the least");
  for (Index n = 0; n < record.size(); ++n)
    if (!std::isfinite(record[n]))
      fail(Failure::input, "sound: sample ", n, " of ", record.size(), " is ", record[n],
           "; finite forces are wanted: make the artifact again");
}

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

VectorXd filtered(const Eigen::Ref<const VectorXd>& record, double rate, const Transfer* transfer) {
  require_record(record);
  const VectorXd oscillating = record.array() - record.mean();
  if (!transfer) return oscillating;
  const Index n = record.size() + std::lround(rate);
  VectorXd padded = VectorXd::Zero(n);
  padded.head(record.size()) = oscillating;
  return multiplied_spectrum(padded, [&](double turns) { return transfer->at(turns * rate); })
      .head(record.size());
}

VectorXd band_rms(const Eigen::Ref<const VectorXd>& signal, const Eigen::Ref<const VectorXd>& speed,
                  const VectorXd& edges, Index least) {
  const Index bands = edges.size() - 1;
  VectorXd squares = VectorXd::Zero(bands);
  Eigen::VectorXi count = Eigen::VectorXi::Zero(static_cast<int>(bands));
  for (Index i = 0; i < signal.size(); ++i) {
    const Index band = std::upper_bound(edges.begin(), edges.end(), speed[i]) - edges.begin() - 1;
    if (band < 0 || band >= bands) continue;
    squares[band] += signal[i] * signal[i];
    ++count[band];
  }
  for (Index b = 0; b < bands; ++b)
    squares[b] =
        count[b] < least ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(squares[b] / count[b]);
  return squares;
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
