#include "signal/spectrum.h"

#include <fftw3.h>

#include <cmath>
#include <complex>
#include <memory>

#include "base/error.h"
#include "signal/rms.h"

namespace whine {
namespace {

// Real-to-complex transform of fixed length. FFTW_ESTIMATE: the other planners choose the algorithm by
// timing, and two runs would then differ in the last digits.
class RealTransform {
 public:
  explicit RealTransform(int n) : n_(n), in_(fftw_alloc_real(n)), out_(fftw_alloc_complex(n / 2 + 1)) {
    if (in_ && out_) plan_.reset(fftw_plan_dft_r2c_1d(n, in_.get(), out_.get(), FFTW_ESTIMATE));
    if (!plan_) fail(Failure::numerical, "FFTW made no plan for ", n, " samples: out of memory?");
  }
  double* input() { return in_.get(); }
  void execute() { fftw_execute(plan_.get()); }
  std::complex<double> bin(int k) const { return {out_.get()[k][0], out_.get()[k][1]}; }
  double magnitude(int k) const { return std::hypot(out_.get()[k][0], out_.get()[k][1]); }

 private:
  struct Free {
    void operator()(void* p) const { fftw_free(p); }
  };
  struct Destroy {
    void operator()(fftw_plan p) const { fftw_destroy_plan(p); }
  };
  int n_;
  std::unique_ptr<double, Free> in_;
  std::unique_ptr<fftw_complex, Free> out_;
  std::unique_ptr<std::remove_pointer_t<fftw_plan>, Destroy> plan_;
};

void require_finite(const Eigen::Ref<const Eigen::VectorXd>& x, const char* what) {
  for (Eigen::Index j = 0; j < x.size(); ++j)
    if (!std::isfinite(x[j]))
      fail(Failure::input, what, ": sample ", j, " is ", x[j], ", not a finite number");
}

}  // namespace

Harmonics harmonics(const Eigen::Ref<const Eigen::VectorXd>& samples, int count, int periods) {
  const int n = static_cast<int>(samples.size());
  if (n < 2) fail(Failure::input, "harmonics: ", n, " samples; a period needs 2 at least");
  if (periods < 1) fail(Failure::input, "harmonics: ", periods, " periods in the record; 1 is the least");
  if (count < 0) fail(Failure::input, "harmonics: ", count, " harmonics wanted; 0 is the least");
  if (count > resolved_harmonics(n, count, periods))
    fail(Failure::input, "harmonics: harmonic ", count, " of ", periods, " period(s) needs more than ",
         2L * count * periods, " samples, the record has ", n);
  require_finite(samples, "harmonics");

  Harmonics result;
  result.mean = samples.mean();
  const Eigen::VectorXd oscillating = samples.array() - result.mean;
  result.rms = oscillating_rms({samples});
  result.amplitude.resize(count);
  if (count == 0) return result;
  // The mean is taken off first: otherwise its round-off would sit in every bin.
  RealTransform transform(n);
  Eigen::Map<Eigen::VectorXd>(transform.input(), n) = oscillating;
  transform.execute();
  for (int k = 1; k <= count; ++k) result.amplitude[k - 1] = 2.0 * transform.magnitude(k * periods) / n;
  return result;
}

Eigen::VectorXcd fourier_coefficients(const Eigen::Ref<const Eigen::VectorXd>& samples, int count) {
  const int n = static_cast<int>(samples.size());
  if (n < 2 || count < 0 || count > resolved_harmonics(n, count))
    fail(Failure::input, "Fourier coefficients: ", n, " samples do not resolve ", count, " harmonics");
  require_finite(samples, "Fourier coefficients");
  RealTransform transform(n);
  Eigen::Map<Eigen::VectorXd>(transform.input(), n) = samples;
  transform.execute();
  Eigen::VectorXcd c(count + 1);
  for (int k = 0; k <= count; ++k) c[k] = transform.bin(k) / static_cast<double>(n);
  return c;
}

int resolved_harmonics(Eigen::Index samples, int wanted, int periods) {
  // Strictly below the Nyquist bin: there amplitude and phase cannot be told apart.
  const Eigen::Index limit = samples < 1 || periods < 1 ? 0 : (samples - 1) / 2 / periods;
  return static_cast<int>(std::min<Eigen::Index>(wanted, limit));
}

VectorXd residual_signal(const Eigen::Ref<const VectorXd>& samples, int periods) {
  if (periods < 1 || samples.size() % periods != 0)
    fail(Failure::input, samples.size(), " samples are no whole number of ", periods, " periods");
  const Eigen::Index length = samples.size() / periods;
  const Eigen::VectorXd mean = samples.reshaped(length, periods).rowwise().mean();
  return samples - mean.replicate(periods, 1);
}

double kurtosis(const Eigen::Ref<const VectorXd>& samples) {
  const double square = samples.squaredNorm() / static_cast<double>(samples.size());
  return square > 0 ? samples.array().square().square().mean() / (square * square) : 0;
}

double at_phase(const Eigen::VectorXd& phase, const Eigen::VectorXd& value, double at) {
  const double p = at - std::floor(at);
  const Eigen::Index n = phase.size();
  Eigen::Index i = n - 1;
  while (i > 0 && phase[i] > p) --i;
  const double right = i + 1 < n ? phase[i + 1] : phase[0] + 1.0;
  const double share = (p - phase[i]) / (right - phase[i]);
  return (1.0 - share) * value[i] + share * value[(i + 1) % n];
}

Separations separations(const Eigen::Ref<const Eigen::VectorXd>& force) {
  const Eigen::Index n = force.size();
  if (n < 1) fail(Failure::input, "separations: no force samples");
  require_finite(force, "separations");
  if (force.minCoeff() < 0)
    fail(Failure::input, "separations: a contact force of ", force.minCoeff(),
         " N; teeth do not pull, 0 is the least");
  Eigen::Index apart = 0, begins = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    if (force[j] > 0) continue;
    ++apart;
    if (force[(j + n - 1) % n] > 0) ++begins;  // counts an interval that wraps round the end once
  }
  Separations result;
  result.fraction = static_cast<double>(apart) / static_cast<double>(n);
  result.intervals = apart == n ? 1 : static_cast<int>(begins);
  return result;
}

Eigen::VectorXd multiplied_spectrum(const Eigen::Ref<const Eigen::VectorXd>& x,
                                    const std::function<std::complex<double>(double)>& h) {
  const int n = static_cast<int>(x.size()), bins = n / 2 + 1;
  Eigen::VectorXd out = x;
  Eigen::VectorXcd spectrum(bins);
  const auto raw = [&] { return reinterpret_cast<fftw_complex*>(spectrum.data()); };
  // FFTW_ESTIMATE leaves what it plans for as it is.
  const fftw_plan forth = fftw_plan_dft_r2c_1d(n, out.data(), raw(), FFTW_ESTIMATE);
  const fftw_plan back = fftw_plan_dft_c2r_1d(n, raw(), out.data(), FFTW_ESTIMATE);
  if (!forth || !back) fail(Failure::numerical, "FFTW made no plan for ", n, " samples: out of memory?");
  fftw_execute(forth);
  for (int k = 0; k < bins; ++k) spectrum[k] *= h(static_cast<double>(k) / n) / static_cast<double>(n);
  fftw_execute(back);
  fftw_destroy_plan(forth);
  fftw_destroy_plan(back);
  return out;
}

}  // namespace whine
