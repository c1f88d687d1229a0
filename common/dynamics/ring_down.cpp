#include "dynamics/ring_down.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/dense.h"
#include "base/error.h"
#include "base/units.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Where a strip opens or closes, the decay is no sum of exponentials; 80 of them fit it to 1e-7 with ratios that are meaningless. Of
// 30000 such decays (100 to 300 N m, 1e-6 to 0.5 of it let go) those that this many fit to the same bound had the damping ratio
// of the eigenvalue within 0.5 %, the others were up to 31 % off.
constexpr int kMostExponentials = 12;
// Im s / |s| below which a root counts as real: the equal real roots of the relaxed loads, -1/eta, come out as pairs, by the
// root of round-off (1.5e-8) at most. A pair that does oscillate is then within 1e-10 of critical damping.
constexpr double kReal = 1e-5;

}  // namespace

Eigen::VectorXcd frozen_roots(const FixedPhaseMesh& mesh, const std::vector<int>& touching) {
  const MatrixXd h = mesh.participation(touching, Eigen::all), r = mesh.residual(touching, touching);
  MatrixXd a = mesh.local(touching, touching);
  const auto n = h.cols(), k = h.rows();
  const bool relaxes = mesh.relaxation > 0;
  if (!relaxes) a += r;
  const Eigen::LDLT<MatrixXd> factor(a);
  const double least = factor.vectorD().minCoeff();
  if (factor.info() != Eigen::Success || !(least > 0))
    fail(Failure::numerical, "at mesh phase ", mesh.phase, " the compliance of the ", k,
         " strips that touch is not positive definite: pivot ", least,
         " m/N; raise undamped_depth_mm or rebuild body.h5");
  const MatrixXd coupling = factor.solve(h);
  // In z, v / w and A P, which are of one size.
  const double w = std::sqrt(h.col(0).dot(coupling.col(0)));
  MatrixXd system = MatrixXd::Zero(2 * n + (relaxes ? k : 0), 2 * n + (relaxes ? k : 0));
  system.block(0, n, n, n).diagonal().setConstant(w);
  system.block(n, 0, n, n) = -h.transpose() * coupling / w;
  system.block(n, 0, n, n).diagonal() -= mesh.frequency_squared / w;
  system.block(n, n, n, n).diagonal() = -mesh.damping;
  if (relaxes) {
    const MatrixXd follow = r * factor.solve(MatrixXd::Identity(k, k));  // R P per A P
    system.block(n, 2 * n, n, k) = coupling.transpose() * follow / w;
    system.block(2 * n, 0, k, n) = h / mesh.relaxation;
    system.block(2 * n, 2 * n, k, k) = -follow / mesh.relaxation;
    system.block(2 * n, 2 * n, k, k).diagonal().array() -= 1 / mesh.relaxation;
  }
  const GeneralEigenvalues eigen = general_eigenvalues(system);
  if (!eigen.converged)
    fail(Failure::numerical, "at mesh phase ", mesh.phase, " the ", system.rows(),
         " eigenvalues of the gears at a fixed phase were not found: its matrix has a norm of ",
         system.norm(), " 1/s");
  return eigen.values;
}

std::vector<std::complex<double>> oscillating_roots(const FixedPhaseMesh& mesh,
                                                    const std::vector<int>& touching) {
  const Eigen::VectorXcd all = frozen_roots(mesh, touching);
  std::vector<std::complex<double>> out;
  out.reserve(static_cast<size_t>(all.size()));
  for (const std::complex<double>& s : all)
    if (s.imag() > kReal * std::abs(s)) out.push_back(s);
  return out;
}

std::vector<std::complex<double>>::iterator nearest_root(std::vector<std::complex<double>>& roots,
                                                         double frequency) {
  const auto away = [&](const std::complex<double>& s) { return std::abs(std::abs(s) - kTwoPi * frequency); };
  return std::min_element(roots.begin(), roots.end(),
                          [&](const auto& a, const auto& b) { return away(a) < away(b); });
}

DampedRoot damped_root(const std::complex<double>& s) {
  return {s.imag() / kTwoPi, -s.real() / std::abs(s)};
}

std::vector<DampedRoot> damped_roots(const FixedPhaseMesh& mesh, const VectorXd& frequency) {
  constexpr double kNear = 1.0 / 3;  // of the undamped frequency
  std::vector<int> all(static_cast<size_t>(mesh.gap.size()));
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::complex<double>> roots = oscillating_roots(mesh, all);
  std::vector<DampedRoot> out;
  out.reserve(static_cast<size_t>(frequency.size()));
  for (const double f : frequency) {
    const auto nearest = nearest_root(roots, f);
    if (nearest == roots.end() || std::abs(std::abs(*nearest) - kTwoPi * f) > kNear * kTwoPi * f) {
      out.push_back({0, 1});
      continue;
    }
    out.push_back(damped_root(*nearest));
    roots.erase(nearest);
  }
  return out;
}

Decay fit_ring_down(const Eigen::Ref<const VectorXd>& samples, double step, double near,
                    int contact_changes) {
  return fit_decay(samples, step, near,
                   contact_changes > 0 ? kMostExponentials : std::numeric_limits<int>::max());
}

void set_decay(const Decay& fit, int contact_changes, Index phase, Index mode, ImpactResult& out) {
  out.natural_frequency(phase, mode) = fit.root.frequency;
  out.damping_ratio(phase, mode) = fit.root.damping_ratio;
  out.fit_residual(phase, mode) = fit.residual;
  out.contact_changes(phase, mode) = contact_changes;
}

void set_root(const DampedRoot& root, Index phase, Index mode, ImpactResult& out) {
  out.eigen_frequency(phase, mode) = root.frequency;
  out.eigen_damping_ratio(phase, mode) = root.damping_ratio;
  out.rayleigh_damping_ratio(phase, mode) = rayleigh_ratio(out.damping, out.undamped_frequency(phase, mode));
}

}  // namespace whine
