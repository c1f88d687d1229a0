// What is heard of a periodic force: its Fourier series behind a transfer function, as samples at a constant rate.
//
//   y(t_n) = sum over k of Re(2 c_k H(k f) exp(2 pi i k f t_n)),   t_n = n / rate,   0 < k f < rate / 2,
// with c_k the Fourier coefficients of one record of the force and f one over its length. The mean is left out. No harmonic is
// folded back and nothing is interpolated: the series is evaluated where the samples are.
#pragma once
#include <Eigen/Core>
#include <complex>

namespace whine {

// Rows of a measured or computed transfer function, frequencies ascending.
struct TransferFunction {
  Eigen::VectorXd frequency;  // Hz
  Eigen::VectorXd magnitude;  // output per N
  Eigen::VectorXd phase;      // rad, as a phase meter has it: jumps of 2 pi are undone
};

// Magnitude and phase linear between the rows; 0 outside of them. Throws Error(input) for fewer than two rows, frequencies that
// do not ascend, magnitudes below 0 or what is not finite.
class Transfer {
 public:
  explicit Transfer(const TransferFunction& rows);
  std::complex<double> at(double frequency) const;

 private:
  TransferFunction rows_;
};

// record: (sample) N over one whole period of the motion; fundamental: Hz, one over its length; transfer: nullptr: 1.
// (sample) in N, or what the transfer function makes of it. Throws Error(input) for no samples or what is not finite.
Eigen::VectorXd sound(const Eigen::Ref<const Eigen::VectorXd>& record, double fundamental,
                      const Transfer* transfer, double rate, Eigen::Index samples);

// (sample) record at `rate` (Hz), such as a force while the speed changes, behind a transfer function: its spectrum times H, a second
// of silence behind it so that what H draws out does not come back at the beginning. Same length, the mean is left out; without a
// transfer function the record less its mean. Throws Error(input) for less than two samples or what is not finite.
Eigen::VectorXd filtered(const Eigen::Ref<const Eigen::VectorXd>& record, double rate,
                         const Transfer* transfer);

// (band) RMS of the samples whose speed lies in the bands between `edges` (ascending); NaN for a band of less than `least` samples.
Eigen::VectorXd band_rms(const Eigen::Ref<const Eigen::VectorXd>& signal,
                         const Eigen::Ref<const Eigen::VectorXd>& speed, const Eigen::VectorXd& edges,
                         Eigen::Index least);

// Raises the beginning and lowers the end over `samples` of a half cosine, so that neither clicks.
void fade(Eigen::Ref<Eigen::VectorXd> signal, Eigen::Index samples);

// dB: 20 log10(rms / reference); -infinity for silence.
double level(double rms, double reference);

}  // namespace whine
