#include "signal/decay.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/dense.h"
#include "base/error.h"

namespace whine {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {
constexpr double kRoundOff = 1e-9;  // singular values below this share of the largest are round-off
// The largest singular value of noise over the smallest: (1 + q) / (1 - q) = 6 for independent entries, q^2 = 1/2 columns a row
// (Marchenko and Pastur, 1967). Entries of a Hankel matrix repeat, which spreads them further.
constexpr double kNoiseSpread = 20;
constexpr double kStrong = 0.1;  // share of the strongest pair's energy that makes a pair count
constexpr double kThere = 1e-6;  // the same where the frequency is known
constexpr int kLeastSamples = 16;
}  // namespace

namespace {

// As many exponentials as there are singular values (falling) above round-off and noise, whose level the smallest one shows.
Eigen::Index exponentials(const VectorXd& sigma) {
  const double noise = std::max(kRoundOff * sigma[0], kNoiseSpread * sigma[sigma.size() - 1]);
  return std::max<Eigen::Index>((sigma.array() > noise).count(), 1);
}

}  // namespace

Decay fit_decay(const Eigen::Ref<const VectorXd>& samples, double step, double near, int most) {
  const Eigen::Index n = samples.size(), pencil = n / 3;
  if (n < kLeastSamples)
    fail(Failure::input, "a decay of ", n, " samples is too short, ", kLeastSamples, " are needed");
  if (!samples.allFinite()) fail(Failure::input, "a sample of the decay is not finite");
  const double norm = samples.norm();
  if (!(norm > 0) || !(step > 0))
    fail(Failure::input, "the decay holds no signal, or its step is not above 0");

  MatrixXd hankel(n - pencil, pencil + 1);
  for (Eigen::Index j = 0; j <= pencil; ++j) hankel.col(j) = samples.segment(j, n - pencil);
  const SingularValues svd = singular_values(hankel);
  const VectorXd& sigma = svd.values;
  if (!svd.converged || !sigma.allFinite())
    fail(Failure::numerical, "the decay of ", n, " samples with a norm of ", norm, " has no singular values");
  const auto roots = std::min<Eigen::Index>(exponentials(sigma), most);
  const MatrixXd rows = svd.right.leftCols(roots);
  const MatrixXd shift = least_squares(MatrixXd(rows.topRows(pencil)), MatrixXd(rows.bottomRows(pencil)));
  const GeneralEigenvalues eigen = general_eigenvalues(shift);
  if (!eigen.converged)
    fail(Failure::numerical, "the ", roots, " roots of the decay of ", n,
         " samples were not found: the shift between its rows has a norm of ", shift.norm());
  const VectorXcd& z = eigen.values;

  MatrixXcd powers(n, roots);
  powers.row(0).setOnes();
  for (Eigen::Index i = 1; i < n; ++i) powers.row(i) = powers.row(i - 1).cwiseProduct(z.transpose());
  const VectorXcd amplitude = least_squares(powers, MatrixXcd(samples.cast<std::complex<double>>()));

  // Round-off may let an undamped one grow.
  const auto swings = [&](Eigen::Index k) {
    return z[k].imag() > 0 && std::abs(z[k]) < 1 + 1e-3 / static_cast<double>(n);
  };
  const VectorXd energy = (powers * amplitude.asDiagonal()).colwise().squaredNorm();
  double strongest = 0;
  for (Eigen::Index k = 0; k < roots; ++k)
    if (swings(k)) strongest = std::max(strongest, energy[k]);
  Decay decay;
  decay.exponentials = static_cast<int>(roots);
  double least = 0;
  for (Eigen::Index k = 0; k < roots; ++k) {
    if (!swings(k) || energy[k] < (near > 0 ? kThere : kStrong) * strongest) continue;
    const std::complex<double> s = std::log(z[k]) / step;
    const double frequency = s.imag() / (2 * std::numbers::pi),
                 away = near > 0 ? std::abs(std::abs(s) / (2 * std::numbers::pi) - near) : frequency;
    if (decay.root.frequency != 0 && away >= least) continue;
    least = away;
    decay.root = {frequency, -s.real() / std::abs(s)};
  }
  if (decay.root.frequency == 0)
    fail(Failure::numerical, "nothing oscillates in the decay: it is damped above critical, or grows");
  decay.residual = (samples.cast<std::complex<double>>() - powers * amplitude).norm() / norm;
  return decay;
}

}  // namespace whine
