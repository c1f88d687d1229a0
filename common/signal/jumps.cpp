#include "signal/jumps.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace whine {

namespace {

// Of the RMS. On the resonance flanks of P2000's pair at 7 % damping extrapolation from speeds 20 Hz apart gives it within 4.3 %.
constexpr double kBreak = 0.04;

// Of a motion that did not settle the RMS alone tells: it may be a slow one of the same kind.
bool of_other_kind(const BranchMotion& a, const BranchMotion& b) {
  return a.multiple > 0 && b.multiple > 0 && a.multiple != b.multiple;
}

double motion_level(const BranchMotion& m) {
  return std::log(std::max(m.rms, std::numeric_limits<double>::min()));
}

// How far the RMS steps between a and b for all that the motions beside them lead to, as a share of it; infinite if orbits
// repeat otherwise. Without one after, those before are to lead to b itself.
double departure(const BranchMotion* before, const BranchMotion& a, const BranchMotion& b,
                 const BranchMotion* after) {
  if (of_other_kind(a, b)) return std::numeric_limits<double>::infinity();
  const double width = b.mesh_frequency - a.mesh_frequency, change = motion_level(b) - motion_level(a);
  const auto predicted = [&](const BranchMotion& c, const BranchMotion& d) {
    return of_other_kind(c, d) || c.mesh_frequency == d.mesh_frequency
               ? 0
               : (motion_level(d) - motion_level(c)) / (d.mesh_frequency - c.mesh_frequency) * width;
  };
  const double on = before ? predicted(*before, a) : 0;
  if (!after) return std::abs(change - on);
  // What is beside counts for no more than twice the change: it may be a jump itself.
  const double most = 2 * std::abs(change), back = predicted(b, *after);
  return std::abs(change - 0.5 * (std::clamp(on, -most, most) + std::clamp(back, -most, most)));
}

const BranchMotion* at_or_none(const std::vector<BranchMotion>& sweep, size_t i) {
  return i < sweep.size() ? &sweep[i] : nullptr;
}

// True if the change of level between the motions i - 1 and i is, to kBreak, what the two changes before and the two after it
// have half-way between them, as cubic interpolation has it: a resonance whose width is a few steps. False where they are not
// all there, of one orbit and one step.
bool is_smooth(const std::vector<BranchMotion>& sweep, size_t i) {
  if (i < 3 || i + 2 >= sweep.size()) return false;
  const double step = sweep[i].mesh_frequency - sweep[i - 1].mesh_frequency;
  double change[5];
  for (size_t k = 0; k < 5; ++k) {
    const BranchMotion &a = sweep[i + k - 3], &b = sweep[i + k - 2];
    if (of_other_kind(a, b) ||
        !(std::abs(b.mesh_frequency - a.mesh_frequency - step) < 1e-6 * std::abs(step)))
      return false;
    change[k] = motion_level(b) - motion_level(a);
  }
  // As in departure().
  const double most = 2 * std::abs(change[2]), on = (4 * change[1] - change[0]) / 3,
               back = (4 * change[3] - change[4]) / 3;
  return std::abs(change[2] - 0.5 * (std::clamp(on, -most, most) + std::clamp(back, -most, most))) <= kBreak;
}

// Hz: where the branch of three motions folds back, if they point to one: the speed as a quadratic of the level has its
// end ahead.
std::optional<double> fold_ahead(const BranchMotion& a, const BranchMotion& b, const BranchMotion& c) {
  const double step = motion_level(c) - motion_level(b), before = motion_level(b) - motion_level(a);
  if (!(step * before > 0)) return std::nullopt;
  const double rate = (c.mesh_frequency - b.mesh_frequency) / step,
               bend = (rate - (b.mesh_frequency - a.mesh_frequency) / before) / (step + before);
  const double at_c = rate + bend * step;  // of the speed by the level
  if (!(at_c * rate > 0) || !(at_c * bend * step < 0)) return std::nullopt;
  return c.mesh_frequency - at_c * at_c / (4 * bend);
}

}  // namespace

bool may_break(const std::vector<BranchMotion>& sweep, size_t i) {
  const BranchMotion &a = sweep[i - 1], &b = sweep[i];
  if (a.multiple == 0 && b.multiple == 0)
    return false;  // the RMS of a motion that does not repeat differs from stretch to stretch
  const BranchMotion* after = at_or_none(sweep, i + 1);
  return departure(at_or_none(sweep, i - 2), a, b, after ? after : &b) > kBreak && !is_smooth(sweep, i);
}

// NOLINTNEXTLINE(readability-function-size): one search, whose steps share what is known ahead and behind
std::optional<BranchEnd> branch_end(const BranchWalk& walk, const std::vector<BranchMotion>& sweep,
                                    size_t i) {
  constexpr int kShrinking = 4;      // steps, in the finest, over which a flank is told from a jump
  constexpr double kLost = 1.25;     // change of RMS of a step that is halved whatever it leads to
  constexpr double kSurelyLost = 2;  // the same for kShrinking finest steps and fewer
  constexpr double kToFold = 0.75;   // of the way to a fold that is predicted
  // Places count finest steps of 1e-7 Hz and less over all of the sweep: more than an int holds.
  const double finest = walk.step / walk.fineness;
  const BranchMotion from = sweep[i - 1];
  const BranchMotion* const swept = at_or_none(sweep, i);
  const long widest = swept ? walk.fineness / 2 : walk.fineness;

  // What stands ahead, nearest last: the sweep's next speed, and runs that left the branch or were too long to tell.
  constexpr int kSwept = -1;
  struct Known {
    BranchMotion motion;
    long place, from;  // in finest steps from motion i - 1; where its run began
    int run;           // or kSwept
  };
  std::vector<Known> ahead;
  if (swept) ahead.push_back({*swept, walk.fineness, 0, kSwept});
  std::vector<BranchMotion> trail(sweep.begin() + static_cast<std::ptrdiff_t>(i < 3 ? 0 : i - 3),
                                  sweep.begin() + static_cast<std::ptrdiff_t>(i));  // on the branch
  long place = 0, stride = widest;
  int runs = 0;
  double largest = 0;  // departure over kShrinking finest steps or fewer

  const auto beyond = [&](size_t n) -> const BranchMotion* {
    const long there = ahead[n].place;
    while (n-- > 0)
      if (ahead[n].motion.multiple > 0) return &ahead[n].motion;
    return swept && there == walk.fineness ? at_or_none(sweep, i + 1) : nullptr;
  };
  const auto to_fold = [&] {  // in finest steps
    const size_t n = trail.size();
    const auto fold = n < 3 ? std::nullopt : fold_ahead(trail[n - 3], trail[n - 2], trail[n - 1]);
    return fold ? (*fold - trail.back().mesh_frequency) / finest : std::numeric_limits<double>::infinity();
  };

  for (;;) {
    long reach = stride;
    bool again = false;  // from nearer to what is known ahead
    if (!ahead.empty()) {
      const Known& next = ahead.back();
      const long gap = next.place - place;
      const BranchMotion* before = trail.size() > 1 ? &trail[trail.size() - 2] : nullptr;
      // A run that gave up has left the branch.
      const double off = next.run != kSwept && next.motion.multiple == 0
                             ? std::numeric_limits<double>::infinity()
                             : departure(before, trail.back(), next.motion, beyond(ahead.size() - 1));
      if (gap > kShrinking)
        largest = 0;
      else if (std::isfinite(off))
        largest = std::max(largest, off);
      const bool nearest = gap == 1 && next.from == place;
      if (off <= kBreak || (nearest && off <= 0.5 * largest)) {
        if (next.run == kSwept) return std::nullopt;
        walk.keep(next.run);
        trail.push_back(next.motion);
        place = next.place;
        ahead.pop_back();
        stride = off < kBreak / 4 && 2 * gap <= widest && place % (2 * gap) == 0 ? 2 * gap : gap;
        continue;
      }
      if (nearest) return BranchEnd{trail.back().mesh_frequency, next.motion.mesh_frequency, false};
      again = gap == 1 || (next.run == kSwept && next.from == 0 && place > 0 && to_fold() > gap);
      reach = again ? gap : std::max(1L, gap / 2);
    } else if ((from.mesh_frequency + (place + stride) * finest - walk.limit) / finest > 1e-6) {
      if (stride == 1) return BranchEnd{trail.back().mesh_frequency, walk.limit, true};
      stride /= 2;
      continue;
    }
    if (const double fold = to_fold(); !again && place > 0 && fold < 2 * reach)
      reach = std::clamp(static_cast<long>(kToFold * fold), std::max(1L, reach / 4), reach);
    const Known found{
        walk.run(from.mesh_frequency + (place + reach) * finest, reach > kShrinking ? kLost : kSurelyLost),
        place + reach, place, runs++};
    if (!again) {
      ahead.push_back(found);
      continue;
    }
    Known& next = ahead.back();
    next.from = place;
    const bool same = departure(nullptr, next.motion, found.motion, nullptr) <= kBreak;
    if (found.motion.multiple > 0 && !(next.run == kSwept && same)) next = found;
  }
}

std::optional<BranchJump> find_jump(const std::vector<BranchMotion>& sweep, size_t i,
                                    const std::function<BranchContinuation()>& follower,
                                    std::vector<BranchPoint>* left_early) {
  const double from = sweep[i - 1].mesh_frequency, to = sweep[i].mesh_frequency;
  const BranchJump whole{0.5 * (from + to), std::abs(to - from)};
  if (sweep[i - 1].multiple == 0) return whole;
  const BranchContinuation follow = follower();
  std::vector<BranchPoint> points;
  BranchWalk walk;
  walk.step = to - from;
  walk.limit = sweep.back().mesh_frequency;
  constexpr int kMostFineness = 1 << 30;
  while (walk.fineness < kMostFineness && follow.finest > 0 &&
         std::abs(walk.step) > follow.finest * walk.fineness)
    walk.fineness *= 2;
  walk.run = follow.run;
  walk.keep = [&](int n) { points.push_back(follow.keep(n)); };
  const auto end = branch_end(walk, sweep, i);
  if (!end) return std::nullopt;
  if (left_early) left_early->insert(left_early->end(), points.begin(), points.end());
  if (end->outlived) return whole;
  return BranchJump{0.5 * (end->last + end->next), std::abs(end->next - end->last), true, end->last};
}

}  // namespace whine
