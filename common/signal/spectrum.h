// Mean, RMS and harmonics of a sampled periodic signal, and its intervals of zero force.
//
// The samples x_j = x(j P / n), j = 0 .. n-1, cover a whole number of periods: the end point is left out.
// Then
//   mean = sum x_j / n,   rms^2 = sum (x_j - mean)^2 / n,   a_k = 2 |sum x_j exp(-2 pi i j k m / n)| / n
// are exact for every signal whose content lies below the Nyquist frequency; there is no window and no
// leakage. A record that is a quarter of a period too long is wrong by 6.6 % in RMS after one period and 0.08
// % after a hundred.
#pragma once
#include <Eigen/Core>
#include <complex>
#include <functional>

namespace whine {

struct Harmonics {
  double mean = 0;            // unit of the samples
  double rms = 0;             // of samples - mean: everything that oscillates, subharmonics included
  Eigen::VectorXd amplitude;  // (harmonic 1..count) one-sided: a cos(2 pi k t + phase) has amplitude a
};

// samples: (sample) over `periods` whole base periods; harmonic k is k * periods bins from the mean.
// Throws Error(input) for fewer than 2 samples, values that are not finite, periods < 1, count < 0, or a
// harmonic that the samples do not resolve (count * periods must stay below half the number of samples).
Harmonics harmonics(const Eigen::Ref<const Eigen::VectorXd>& samples, int count, int periods = 1);

// (harmonic 0..count) unit of the samples: c_k = sum x_j exp(-2 pi i j k / n) / n of one period. Throws as harmonics().
Eigen::VectorXcd fourier_coefficients(const Eigen::Ref<const Eigen::VectorXd>& samples, int count);

// The number of harmonics, `wanted` at most, that `samples` over `periods` base periods resolve; may be 0.
int resolved_harmonics(Eigen::Index samples, int wanted, int periods = 1);

// The residual signal of gear diagnostics, in which mesh harmonics are not: samples over `periods` whole periods less the mean of
// these, sample by sample. Throws Error(input) for samples that are no multiple of `periods`.
Eigen::VectorXd residual_signal(const Eigen::Ref<const Eigen::VectorXd>& samples, int periods);
// 1: mean fourth power over the squared mean square of samples whose mean is 0; 0 of nothing but zeros.
double kurtosis(const Eigen::Ref<const Eigen::VectorXd>& samples);

// At a phase, any, of a periodic curve: linear between its samples at these phases, ascending within one period.
double at_phase(const Eigen::VectorXd& phase, const Eigen::VectorXd& value, double at);

struct Separations {
  double fraction = 0;  // share of the samples without force
  int intervals =
      0;  // contiguous intervals without force on the cyclic record; 1 if there is never any force
};

// force: (sample) N, >= 0, over whole periods, so that the last sample is followed by the first. Zero means
// exactly zero: the complementarity solution has no small forces. Throws Error(input) for no samples,
// negative or non-finite.
Separations separations(const Eigen::Ref<const Eigen::VectorXd>& force);

// (sample) in the unit of x times h: the signal whose spectrum is that of x times h(turns per sample), from 0 to 1/2, both periodic
// over their length. Throws Error(numerical) if FFTW makes no plan.
Eigen::VectorXd multiplied_spectrum(const Eigen::Ref<const Eigen::VectorXd>& x,
                                    const std::function<std::complex<double>(double)>& h);

}  // namespace whine
