// Whether a motion that is integrated period by period has become periodic: its states at the ends of periods against those of
// the last periods.
//
// A subharmonic of order m is a motion whose state repeats after m periods but, long since and without getting any nearer, not
// after a divisor of m: a slow transient may look like one for a while.
#pragma once
#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <utility>

namespace whine {

template <class State>
class Recurrence {
 public:
  static constexpr int kMostMultiple = 8;  // longest subharmonic looked for, in periods
  static constexpr int kWatched =
      50;  // periods over which a subharmonic must not come nearer to a shorter one

  // periodicity: relative change of a state below which it repeats.
  Recurrence(double periodicity, State start) : periodicity_(periodicity) { restart(std::move(start)); }
  // The motion goes on from another state.
  void restart(State from) {
    past_.assign(1, std::move(from));
    history_.clear();
  }
  // The end of period n (from 1), of all that were integrated. distance(a, b): relative change of a state from b to a.
  template <class Distance>
  void compare(const State& now, int n, const Distance& distance) {
    change_.fill(std::numeric_limits<double>::infinity());
    known_ = n < kWatched ? 1 : std::min(static_cast<int>(past_.size()), kMostMultiple);
    for (int m = 1; m <= known_; ++m)
      change_[m] = distance(now, past_[past_.size() - static_cast<size_t>(m)]);
  }
  void keep(State now, int n) {
    past_.push_back(std::move(now));
    if (static_cast<int>(past_.size()) > kMostMultiple) past_.pop_front();
    if (n >= kWatched) history_.push_back(change_);
    if (static_cast<int>(history_.size()) > kWatched) history_.pop_front();
  }
  int known() const { return known_; }               // orders that are known
  double change(int m) const { return change_[m]; }  // over m periods; infinite: not known
  bool repeats(int m) const { return change_[m] < periodicity_; }
  // Over m periods the state is not that of before, by more than a subharmonic's states may be alike.
  bool apart(int m) const { return change_[m] > kApart * periodicity_; }
  // Nor does it come any nearer to it, or go farther from it, as beside an unstable orbit whose multiplier is a little below -1.
  bool stagnates(int m) const {
    if (static_cast<int>(history_.size()) < kWatched || !apart(m)) return false;
    const double before = history_.front()[m];
    return change_[m] > kNoNearer * before && change_[m] < kNoFarther * before;
  }
  // Whether no divisor of m is a period: by what a subharmonic of order m does over each, if asked for for so long.
  bool primitive(int m, bool for_long) const {
    for (int d = 1; d < m; ++d)
      if (m % d == 0 && !(for_long ? stagnates(d) : apart(d))) return false;
    return true;
  }
  // Periods after which the motion repeats; 0: it does not yet.
  int multiple() const {
    if (change_[1] == 0) return 1;
    for (int m = 1; m <= known_; ++m)
      if (repeats(m) && primitive(m, true)) return m;
    return 0;
  }

 private:
  static constexpr double kApart = 10;                           // times periodicity
  static constexpr double kNoNearer = 0.999, kNoFarther = 1.01;  // times the change kWatched periods ago
  using Changes = std::array<double, kMostMultiple + 1>;

  double periodicity_;
  int known_ = 0;
  Changes change_{};
  std::deque<State> past_;
  std::deque<Changes> history_;
};

}  // namespace whine
