// Orders and spectra of a record whose speed changes: amplitudes over the angle, and over time and frequency.
//
// Order n of a record x(t) with the phase phi(t) (mesh periods), in a Hann window w of `width` mesh periods about a centre:
//
//   a_n = 2 | sum w(phi_k) x_k exp(-2 pi i n phi_k) dphi_k | / sum w(phi_k) dphi_k,   dphi_k = (dphi/dt)_k / rate
//
// This is order tracking by resampling to even angles, without the interpolation: the transform over the angle is an integral,
// taken over the samples where they are (time variant discrete Fourier transform; Blough et al., SAE 971878 (1997)). Record and
// order below half the rate make its integrand smooth, and the sum exact but for the window's side lobes at the rate, 1e-6
// of neighbouring content in a window of 150 samples. Other whole orders of constant amplitude are zero exactly.
// An amplitude that varies is averaged by the window: A + A'' <u^2> / 2 = A + 0.0163 width^2 A'' in mesh periods,
// <u^2> = (1/12 - 1/(2 pi^2)) width^2 of the Hann window.
#pragma once
#include <Eigen/Core>

#include "base/matrix.h"

namespace whine {

struct OrderCuts {
  Eigen::VectorXd phase;  // (cut) mesh periods, centre of its window
  MatrixRM amplitude;     // (cut, order 1..) unit of the record
};

// x, phase: (sample), phase ascending; orders: 1 to `orders`; width: mesh periods, >= 4; cuts half a window apart, of those
// windows that lie within the record. Throws Error(input) if there is none, or an order reaches half the rate.
OrderCuts order_cuts(const Eigen::Ref<const Eigen::VectorXd>& x,
                     const Eigen::Ref<const Eigen::VectorXd>& phase, int orders, int width);

// Mesh periods: the widest window, a power of two from 4 to 64, within which the speed f (Hz) at the acceleration a (Hz s-1)
// changes by no more than 0.5 %.
int order_width(double mesh_frequency, double acceleration);

struct Spectrogram {
  Eigen::VectorXd time;       // (slice) s, middle of its window
  Eigen::VectorXd frequency;  // (bin) Hz
  MatrixRM amplitude;         // (slice, bin) unit of the record: a cos(2 pi f t) on a bin has a
};

// Short-time spectra in Hann windows of `length` samples, `slices` of them over the record, bins up to `most` Hz. Throws
// Error(input) for a record shorter than a window or what is not finite.
Spectrogram spectrogram(const Eigen::Ref<const Eigen::VectorXd>& x, double rate, Eigen::Index length,
                        Eigen::Index slices, double most);

// Samples, a power of two of 64 to 65536: the window in which a tone that moves by `sweep` (Hz s-1) widens as much by its
// movement as by the window, rate / sqrt(2 sweep).
Eigen::Index spectrogram_length(double rate, double sweep);

}  // namespace whine
