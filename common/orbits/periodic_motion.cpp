#include "orbits/periodic_motion.h"

#include <algorithm>
#include <deque>
#include <optional>

#include "base/dense.h"
#include "base/error.h"
#include "base/progress.h"
#include "orbits/recurrence.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kColumns = 4;        // differences, as many multipliers go at once
constexpr double kClose = 1e-2;    // change per period below which the motion counts as close
constexpr int kLongestPause = 64;  // periods of plain iteration after proposals that gained nothing

class Acceleration {
 public:
  void take(const VectorXd& start, const VectorXd& end) {
    in_a_row_ = known_ && start == end_ ? in_a_row_ + 1 : 1;
    if (known_) {
      starts_.push_back(start - start_);
      ends_.push_back(end - end_);
      if (static_cast<int>(starts_.size()) > kColumns) {
        starts_.pop_front();
        ends_.pop_front();
      }
    }
    start_ = start;
    end_ = end;
    known_ = true;
  }
  void forget() { *this = {}; }
  bool ready() const { return static_cast<int>(starts_.size()) == kColumns; }
  std::optional<VectorXd> propose() const {
    constexpr double kAlike = 1e-3;  // columns of unit length that differ by less are linearly dependent
    // Periods in a row come to show the largest multipliers; of others one may seem smaller than it is, by some hundredths.
    constexpr double kSurelyInside = 0.9;
    const double most = in_a_row_ > kColumns ? 1 : kSurelyInside;
    MatrixXd start(start_.size(), kColumns), end = start;
    for (Index i = 0; i < kColumns; ++i) {
      const double length = (ends_[static_cast<size_t>(i)] - starts_[static_cast<size_t>(i)]).norm();
      if (!(length > 0)) return std::nullopt;
      start.col(i) = starts_[static_cast<size_t>(i)] / length;
      end.col(i) = ends_[static_cast<size_t>(i)] / length;
    }
    const GeneralEigenvalues multipliers = general_eigenvalues(least_squares(start, end, kAlike));
    if (!multipliers.converged || !(multipliers.values.cwiseAbs().maxCoeff() < most)) return std::nullopt;
    return end_ - end * least_squares(end - start, end_ - start_, kAlike);
  }

 private:
  bool known_ = false;
  int in_a_row_ = 0;  // periods, each from the end of the one before
  VectorXd start_, end_;
  std::deque<VectorXd> starts_, ends_;
};

}  // namespace

PeriodicMotion iterate_to_orbit(PeriodMap& map, const VectorXd& start, const PeriodicMotionOptions& options) {
  PeriodicMotion out;
  VectorXd y = start, integrated;
  Acceleration acceleration;
  Recurrence<VectorXd> recurrence(options.periodicity, y);
  bool pending = false;       // y descends from a proposal
  bool extrapolated = false;  // y may descend from one, also where another one was rejected since
  double change_before = 0;
  int pause = 0, patience = 0;
  const auto distance = [](const VectorXd& a, const VectorXd& b) { return (a - b).norm(); };
  const auto iterate_on = [&] {
    pause = patience = std::min(2 * patience + kColumns, kLongestPause);
    acceleration.forget();
  };
  const auto reject = [&] {
    iterate_on();
    pending = false;
    y = integrated;
    recurrence.restart(y);
  };
  for (int n = 1;; ++n) {
    report_step("period", n, options.most_periods);
    const VectorXd from = y;
    try {
      y = map.apply(from);
    } catch (const Error& error) {  // a proposal may lie where no motion does
      if (!pending || error.kind() != Failure::numerical) throw;
      reject();
      continue;
    }
    recurrence.compare(y, n, distance);
    const double change = recurrence.change(1);
    if (pending && change > change_before) {
      reject();
      continue;
    }
    const int multiple = recurrence.multiple();
    if (extrapolated && multiple == 1 && n < options.most_periods && change > 0) {
      // A proposal may have hit an unstable motion: then the next period is a step away from it.
      recurrence.keep(y, n++);
      y = map.apply(y);
      recurrence.compare(y, n, distance);
      if (recurrence.change(1) > change) {
        recurrence.keep(y, n);
        iterate_on();
        pending = false;
        continue;
      }
      out.state = y;
      out.multiple = 1;
      out.periods = n;
      out.residual = recurrence.change(1);
      return out;
    }
    if (multiple > 0 || n >= options.most_periods) {
      out.state = y;
      out.multiple = multiple;
      out.periods = n;
      out.residual = recurrence.change(std::max(multiple, 1));
      return out;
    }
    recurrence.keep(y, n);
    if (!options.accelerate) continue;
    if (pause > 0) {
      --pause;
      continue;
    }
    acceleration.take(from, y);
    if (!acceleration.ready() || change >= kClose) continue;
    if (const auto proposed = acceleration.propose()) {
      integrated = y;
      change_before = change;
      pending = extrapolated = true;
      y = *proposed;
      recurrence.restart(y);
    }
  }
}

}  // namespace whine
