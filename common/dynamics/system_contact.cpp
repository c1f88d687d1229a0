#include "dynamics/system_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/friction.h"
#include "contact/line_contact.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kRoundOff = 16 * std::numeric_limits<double>::epsilon();
constexpr int kMostLaws = 6;  // visits of the laws before a set is given up
// From so many of one visit on, or after so many visits that took one, the next starts from the solution of this one.
constexpr int kLawsToRenew = 3, kVisitsToRenew = 8;
constexpr int kMostSets = 5;

// y[0..rows) = start + sum over j of f[j] * column number[j] of c, and likewise of the sizes of the terms.
template <class Columns>
void add_forces(double* y, const double* start, const MatrixXd& c, const Columns& number, const double* f,
                int count) {
  const auto rows = static_cast<int>(c.rows());
  for (int i = 0; i < rows; i += kLanes) {
    Lanes even = lanes(start + i), odd{};
    int j = 0;
    for (; j + 2 <= count; j += 2) {
      even += f[j] * lanes(c.data() + number[j] * c.rows() + i);
      odd += f[j + 1] * lanes(c.data() + number[j + 1] * c.rows() + i);
    }
    if (j < count) even += f[j] * lanes(c.data() + number[j] * c.rows() + i);
    lanes(y + i) = even + odd;
  }
}

}  // namespace

// All that is of one solution; of each list only what belongs to the pairs that carry, or to all, is ever set.
struct FollowedContact::Work {
  double f[kMost];            // N
  double left[kMost];         // m: bound of what d of these forces differs from 0 by
  double gap[kMostContacts];  // m: d without the laws
  int laws;
};

void FollowedContact::reserve(int pairs) {
  const int most = std::min(pairs, kMost);
  inverse_.assign(static_cast<size_t>(padded(most)) * static_cast<size_t>(most), 0);
}

void FollowedContact::take(const Eigen::Ref<const VectorXd>& force) {
  count_ = 0;
  linear_ = false;
  for (int i = 0; i < force.size(); ++i) {
    if (!(force[i] > 0)) continue;
    if (count_ == kMost || !std::isfinite(force[i])) {
      count_ = -1;
      return;
    }
    of_[count_].at = force[i];
    carrying_[count_++] = i;
  }
}

// At at_: all that a Newton step from there needs but e. False where the tangent is not positive definite.
bool FollowedContact::linearise(const MatrixXd& c, std::span<const HertzLine> law) {
  const int apart = stride();
  std::fill_n(inverse_.begin(), apart * count_, 0.0);
  for (int j = 0; j < count_; ++j) {
    const double* column = c.data() + carrying_[j] * c.rows();
    for (int i = 0; i < count_; ++i) inverse_.data()[j * apart + i] = column[carrying_[i]];
  }
  for (int i = 0; i < count_; ++i) {
    const HertzLine& law_of = law[static_cast<size_t>(carrying_[i])];
    const HertzLine::Point own = law_of.at(of_[i].at);
    of_[i] = {of_[i].at, own.indentation, std::abs(own.indentation), own.slope, 0.5 * law_of.coefficient()};
    for (int j = 0; j < count_; ++j) {
      const double shared = inverse_.data()[j * apart + i] * of_[j].at;
      of_[i].d += shared;
      of_[i].size += std::abs(shared);
    }
    inverse_.data()[i * apart + i] += own.slope;
  }
  bent_ = 0;
  return linear_ = invert();
}

// Gauss and Jordan in place, without a choice of pivots, which matrices with a positive definite symmetric part do not need.
bool FollowedContact::invert() {
  const int apart = stride();
  double* m = inverse_.data();
  for (int k = 0; k < count_; ++k) {
    double* pivot = m + k * apart;
    if (!(pivot[k] > 0)) return false;
    const double unit = 1 / pivot[k];
    pivot[k] = 1;
    for (int i = 0; i < apart; i += kLanes) lanes(pivot + i) *= unit;
    for (int j = 0; j < count_; ++j) {
      if (j == k) continue;
      double* column = m + j * apart;
      const double factor = column[k];
      column[k] = 0;
      for (int i = 0; i < apart; i += kLanes) lanes(column + i) -= factor * lanes(pivot + i);
    }
  }
  return true;
}

// Forces of the present set in work.f, and the bounds of their gaps. False where no force is left or they do not settle.
bool FollowedContact::approach(const MatrixXd& c, std::span<const HertzLine> law, const VectorXd& e,
                               Work& work) {
  const int apart = stride();
  double right[kMost], change[kMost], bent[kMost], stiffer[kMost], before[kMost];
  for (int i = 0; i < count_; ++i) {
    before[i] = of_[i].at;
    right[i] = of_[i].d + e[carrying_[i]];
    bent[i] = stiffer[i] = 0;
  }
  const auto solved = [&](double* out) {  // T^-1 right
    std::fill_n(out, apart, 0.0);
    if (apart > kLanes) return add_columns(out, inverse_.data(), apart, right, count_, 0, apart);
    for (int j = 0; j < count_; ++j) lanes(out) += right[j] * lanes(inverse_.data() + j * kLanes);
  };
  for (;; ++work.laws) {
    solved(change);
    if (work.laws > 0) {
      for (int i = 0; i < count_; ++i) right[i] = stiffer[i] * change[i];
      solved(bent);
    }
    bool met = true, inside = true;
    for (int i = 0; i < count_; ++i) {
      const double moved = change[i] - bent[i], least = std::min(before[i], before[i] - moved);
      work.f[i] = before[i] - moved;
      inside = inside && work.f[i] > 0;
      work.left[i] = std::abs(stiffer[i] * bent[i]) + of_[i].bend * moved * moved / least;
      met = met && work.left[i] <= kRoundOff * (of_[i].size + std::abs(e[carrying_[i]]));
    }
    if (!inside) return false;
    if (met) return true;
    if (work.laws == kMostLaws) return false;
    add_forces(work.gap, e.data(), c, carrying_, work.f, count_);
    for (int i = 0; i < count_; ++i) {
      const HertzLine::Point own = law[static_cast<size_t>(carrying_[i])].at(work.f[i]);
      right[i] = work.gap[carrying_[i]] + own.indentation;
      stiffer[i] = own.slope - of_[i].slope;
      before[i] = work.f[i];
    }
  }
}

void FollowedContact::start_from(const Work& work) {
  for (int i = 0; i < count_; ++i) of_[i].at = work.f[i];
}

// True if no other pair comes in; otherwise the one that penetrates most joins the set.
bool FollowedContact::look_at_others(const MatrixXd& c, std::span<const HertzLine> law, const VectorXd& e,
                                     Work& work, Certificate& certificate) {
  add_forces(work.gap, e.data(), c, carrying_, work.f, count_);
  const auto n = static_cast<int>(law.size());
  int incoming = -1, place = 0;
  double least = 0, scale = 0, sum = 0;
  certificate.least_gap = count_ < n ? std::numeric_limits<double>::infinity() : 0;
  for (int i = 0, k = 0; i < n; ++i) {
    scale = std::max(scale, std::abs(e[i]));
    sum += work.gap[i];
    if (k < count_ && carrying_[k] == i) {
      ++k;
      continue;
    }
    // Compliances between teeth are below those of their own, so the sizes of the terms are not summed where they do not matter.
    double size = std::abs(e[i]);
    if (!(work.gap[i] > kRoundOff * size))
      for (int j = 0; j < count_; ++j) size += std::abs(c(i, carrying_[j])) * work.f[j];
    certificate.degenerate += std::abs(work.gap[i]) <= kRoundOff * size;
    certificate.least_gap = std::min(certificate.least_gap, work.gap[i]);
    certificate.residual = std::max(certificate.residual, -work.gap[i]);
    if (work.gap[i] < std::min(least, -kRoundOff * size)) least = work.gap[i], incoming = i, place = k;
  }
  if (!std::isfinite(sum) || (incoming >= 0 && count_ == kMost)) {
    restart();
    return false;
  }
  if (incoming < 0) {
    certificate.least_force = count_ > 0 ? *std::min_element(work.f, work.f + count_) : 0;
    for (int i = 0; i < count_; ++i) certificate.residual = std::max(certificate.residual, work.left[i]);
    if (scale > 0) certificate.residual /= scale;
    return true;
  }
  std::copy_backward(carrying_ + place, carrying_ + count_, carrying_ + count_ + 1);
  start_from(work);
  std::copy_backward(of_ + place, of_ + count_, of_ + count_ + 1);
  carrying_[place] = incoming;
  constexpr double kSlope = 12;  // of a law, in its coefficient, under forces that teeth carry
  of_[place].at =
      -least / (c(incoming, incoming) + kSlope * law[static_cast<size_t>(incoming)].coefficient());
  ++count_;
  return linear_ = false;
}

Certificate FollowedContact::solve(const MatrixXd& c, std::span<const HertzLine> law, const VectorXd& e,
                                   Eigen::Ref<VectorXd> force, VectorXd& d, const MatrixXd& friction) {
  const auto n = static_cast<Eigen::Index>(law.size());
  if (count_ < 0 && n <= kMostContacts) take(force);
  Work work;
  for (int set = 0; set < kMostSets && count_ >= 0; ++set) {
    Certificate certificate;
    certificate.factorisations = set;
    if (!linear_ && !linearise(c, law)) break;
    work.laws = 0;
    if (!approach(c, law, e, work)) {
      // Pairs whose force falls below zero leave; if they should not have, they come in again.
      int kept = 0;
      for (int i = 0; i < count_; ++i)
        if (work.f[i] > 0) carrying_[kept] = carrying_[i], of_[kept++].at = work.f[i];
      linear_ = false;
      if (kept == count_) break;
      count_ = kept;
      continue;
    }
    if (!look_at_others(c, law, e, work, certificate)) continue;
    certificate.iterations = work.laws + 1;
    force.setZero();
    d.head(c.rows()) = Eigen::Map<const VectorXd>(work.gap, c.rows());
    for (int i = 0; i < count_; ++i) {
      force[carrying_[i]] = work.f[i];
      d[carrying_[i]] = 0;
    }
    bent_ += work.laws > 0;
    if (set > 0 || work.laws >= kLawsToRenew || bent_ >= kVisitsToRenew) {
      start_from(work);
      linear_ = false;
    }
    return certificate;
  }
  const auto symmetric = [&](const Eigen::Ref<const MatrixXd>& still, const Eigen::Ref<const VectorXd>& gap) {
    return solve_line_contact(still, law, gap, force, d.head(n));
  };
  VectorXd shift;
  if (friction.size() > 0) shift = friction * force;
  const Certificate certificate =
      friction.size() == 0
          ? symmetric(c.topRows(n), e.head(n))
          : solve_with_friction(
                shift, e.cwiseAbs().maxCoeff(),
                [&](const VectorXd& by) { return symmetric(c.topRows(n) - friction, e.head(n) + by); },
                [&] { return VectorXd(friction * force); });
  if (n <= kMostContacts) take(force);
  return certificate;
}

}  // namespace whine
