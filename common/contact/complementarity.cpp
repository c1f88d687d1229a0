#include "contact/complementarity.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "base/error.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::Ref;
using Eigen::VectorXd;

void ComplementaritySolver::reserve(int n) {
  if (e_active_.size() >= n) return;
  in_.resize(n);
  wrong_.reserve(n);
  e_active_.resize(n);
  p_active_.resize(n);
}

void ComplementaritySolver::factorise(const Ref<const MatrixXd>& a, ActiveSet& active) {
  const int k = static_cast<int>(active.strips.size());
  active.inverse.resize(k, k);
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < k; ++i) active.inverse(i, j) = a(active.strips[i], active.strips[j]);
  if (k > 0) {
    const Eigen::LLT<MatrixXd> cholesky(active.inverse);
    if (cholesky.info() != Eigen::Success)
      fail(Failure::numerical, "the compliance of ", k,
           " active strips is not positive definite; their smallest diagonal is ",
           active.inverse.diagonal().minCoeff(), " m/N: strips coincide or the body's table is wrong");
    active.inverse = cholesky.solve(MatrixXd::Identity(k, k));
  }
  active.known = true;
}

// Fills p and d for the set and lists in wrong_ what breaks a sign. True if nothing does.
bool ComplementaritySolver::verify(const Ref<const MatrixXd>& a, const Ref<const VectorXd>& e,
                                   const std::vector<int>& strips, Ref<VectorXd> p, Ref<VectorXd> d,
                                   Certificate& certificate) {
  const int n = static_cast<int>(e.size()), k = static_cast<int>(strips.size());
  p.setZero();
  d = e;
  for (int i = 0; i < k; ++i) {
    p[strips[i]] = p_active_[i];
    d.noalias() += p_active_[i] * a.col(strips[i]);
  }
  for (int i : strips) d[i] = 0;  // exact by the solve, round-off otherwise
  certificate.least_gap = certificate.least_force = 0;
  bool first_gap = true, first_force = true;
  wrong_.clear();
  for (int i = 0, next = 0; i < n; ++i) {
    if (next < k && strips[next] == i) {
      ++next;
      certificate.least_force = first_force ? p[i] : std::min(certificate.least_force, p[i]);
      first_force = false;
      if (p[i] < -gap_tolerance_ / a(i, i)) wrong_.push_back(i);
    } else {
      certificate.least_gap = first_gap ? d[i] : std::min(certificate.least_gap, d[i]);
      first_gap = false;
      if (d[i] < -gap_tolerance_) wrong_.push_back(i);
    }
  }
  return wrong_.empty();
}

Certificate ComplementaritySolver::solve(const Ref<const MatrixXd>& a, const Ref<const VectorXd>& e,
                                         ActiveSet& active, Ref<VectorXd> p, Ref<VectorXd> d) {
  const int n = static_cast<int>(e.size());
  reserve(n);
  gap_tolerance_ = 1e-12 * (n > 0 ? e.cwiseAbs().maxCoeff() : 0.0);
  Certificate certificate;
  const auto try_set = [&] {
    const int k = static_cast<int>(active.strips.size());
    for (int i = 0; i < k; ++i) e_active_[i] = -e[active.strips[i]];
    p_active_.head(k).noalias() = active.inverse.topLeftCorner(k, k) * e_active_.head(k);
    return verify(a, e, active.strips, p, d, certificate);
  };
  if (active.known && try_set()) return certificate;

  std::fill(in_.begin(), in_.begin() + n, 0);
  for (int i : active.strips) in_[i] = 1;
  constexpr int kPatience = 10;  // block steps that may fail to improve before least-index steps begin
  int fewest = n + 1, patience = kPatience;
  const int limit = 20 * n + 100;
  for (int iteration = 0; iteration < limit; ++iteration) {
    if (iteration > 0 || !active.known) {
      active.strips.clear();
      for (int i = 0; i < n; ++i)
        if (in_[i]) active.strips.push_back(i);
      factorise(a, active);
      ++certificate.factorisations;
      if (try_set()) return certificate;
    }
    const int count = static_cast<int>(wrong_.size());
    if (count < fewest) {
      fewest = count;
      patience = kPatience;
    } else if (patience > 0) {
      --patience;
    } else {
      in_[wrong_.back()] ^=
          1;  // Murty's rule: one index, always the same end; finite for positive definite A
      continue;
    }
    for (int i : wrong_) in_[i] ^= 1;
  }
  lawson_hanson(a, e, active);
  certificate.fallback = true;
  if (!try_set())
    fail(Failure::numerical, "the contact problem of ", n, " strips has no certified solution: least gap ",
         certificate.least_gap, " m, least force ", certificate.least_force, " N");
  return certificate;
}

// min 1/2 p'Ap + e'p, p >= 0: the objective falls with every outer step, so no set returns.
void ComplementaritySolver::lawson_hanson(const Ref<const MatrixXd>& a, const Ref<const VectorXd>& e,
                                          ActiveSet& active) {
  const int n = static_cast<int>(e.size());
  VectorXd p = VectorXd::Zero(n), gradient(n), target = VectorXd::Zero(n);
  std::fill(in_.begin(), in_.begin() + n, 0);
  for (int outer = 0; outer < 30 * n + 30; ++outer) {
    gradient = a * p + e;
    int enter = -1;
    double least = -gap_tolerance_;
    for (int i = 0; i < n; ++i)
      if (!in_[i] && gradient[i] < least) least = gradient[i], enter = i;
    if (enter < 0) break;
    in_[enter] = 1;
    for (;;) {
      active.strips.clear();
      for (int i = 0; i < n; ++i)
        if (in_[i]) active.strips.push_back(i);
      factorise(a, active);
      const int k = static_cast<int>(active.strips.size());
      for (int i = 0; i < k; ++i) e_active_[i] = -e[active.strips[i]];
      p_active_.head(k).noalias() = active.inverse * e_active_.head(k);
      double step = 1;
      for (int i = 0; i < k; ++i)
        if (p_active_[i] <= 0)
          step = std::min(step, p[active.strips[i]] / (p[active.strips[i]] - p_active_[i]));
      target.setZero();
      for (int i = 0; i < k; ++i) target[active.strips[i]] = p_active_[i];
      if (step >= 1) {
        p = target;
        break;
      }
      p += step * (target - p);
      for (int i = 0; i < n; ++i)
        if (in_[i] && p[i] <= 0) in_[i] = 0, p[i] = 0;
    }
  }
  active.strips.clear();
  for (int i = 0; i < n; ++i)
    if (in_[i]) active.strips.push_back(i);
  factorise(a, active);
}

}  // namespace whine
