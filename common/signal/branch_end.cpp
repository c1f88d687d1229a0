#include "signal/branch_end.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace whine {

namespace {

// Of the RMS. On the resonance flanks of P2000's pair at 7 % damping speeds 20 Hz apart foretell it within 4.3 %.
constexpr double kBreak = 0.04;

double level(const BranchMotion& m) {
  return std::log(std::max(m.rms, std::numeric_limits<double>::min()));
}

// How far the RMS steps between a and b for all that the motions beside them lead to, as a share of it; infinite if orbits
// repeat otherwise. Without one after, those before are to lead to b itself.
double departure(const BranchMotion* before, const BranchMotion& a, const BranchMotion& b,
                 const BranchMotion* after) {
  if (a.multiple != b.multiple) return std::numeric_limits<double>::infinity();
  const double width = b.mesh_frequency - a.mesh_frequency, change = level(b) - level(a);
  const auto foretold = [&](const BranchMotion& c, const BranchMotion& d) {
    return c.multiple != d.multiple || c.mesh_frequency == d.mesh_frequency
               ? 0
               : (level(d) - level(c)) / (d.mesh_frequency - c.mesh_frequency) * width;
  };
  const double on = before ? foretold(*before, a) : 0;
  if (!after) return std::abs(change - on);
  // What is beside counts for no more than twice the change: it may be a jump itself.
  const double most = 2 * std::abs(change), back = foretold(b, *after);
  return std::abs(change - 0.5 * (std::clamp(on, -most, most) + std::clamp(back, -most, most)));
}

const BranchMotion* at_or_none(const std::vector<BranchMotion>& sweep, size_t i) {
  return i < sweep.size() ? &sweep[i] : nullptr;
}

}  // namespace

bool may_break(const std::vector<BranchMotion>& sweep, size_t i) {
  const BranchMotion &a = sweep[i - 1], &b = sweep[i];
  if (a.multiple == 0 && b.multiple == 0)
    return false;  // the RMS of a motion that does not repeat differs from stretch to stretch
  const BranchMotion* after = at_or_none(sweep, i + 1);
  return departure(at_or_none(sweep, i - 2), a, b, after ? after : &b) > kBreak;
}

std::optional<BranchEnd> branch_end(const BranchWalk& walk, const std::vector<BranchMotion>& sweep,
                                    size_t i) {
  constexpr int kShrinking = 4;  // steps, in the finest, over which a flank is told from a jump
  const double finest = walk.step / walk.fineness;
  const BranchMotion &from = sweep[i - 1], *swept = at_or_none(sweep, i);
  const int widest = swept ? walk.fineness / 2 : walk.fineness;
  std::optional<BranchMotion> earlier;
  if (const BranchMotion* before = at_or_none(sweep, i - 2)) earlier = *before;
  BranchMotion at = from;
  double largest = 0;  // departure at steps of kShrinking finest ones or fewer
  for (int place = 0, stride = widest;;) {
    const double next = from.mesh_frequency + (place + stride) * finest;
    if ((next - walk.limit) / finest > 1e-6) {
      if (stride == 1) return BranchEnd{at.mesh_frequency, walk.limit, true};
      stride /= 2;
      continue;
    }
    const BranchMotion found = walk.run(next);
    const BranchMotion* after = !swept || place + stride > walk.fineness ? nullptr
                                : place + stride < walk.fineness         ? swept
                                                                         : at_or_none(sweep, i + 1);
    const double off = departure(earlier ? &*earlier : nullptr, at, found, after);
    if (off > kBreak) {
      if (stride <= kShrinking && std::isfinite(off)) largest = std::max(largest, off);
      if (stride > 1) {
        stride /= 2;
        continue;
      }
      if (off > 0.5 * largest || !std::isfinite(off)) return BranchEnd{at.mesh_frequency, next, false};
    }
    walk.keep();
    earlier = at;
    at = found;
    place += stride;
    if (swept && place == walk.fineness && departure(nullptr, *swept, at, nullptr) <= kBreak)
      return std::nullopt;
    // The rest at one go, if the step before was as long: slopes next to a jump lead too far.
    const BranchMotion* beyond = at_or_none(sweep, i + 1);
    if (swept && place < walk.fineness && walk.fineness - place <= stride &&
        departure(&*earlier, at, *swept, beyond ? beyond : swept) <= kBreak)
      return std::nullopt;
    if (off < kBreak / 4 && 2 * stride <= widest && place % (2 * stride) == 0) {
      stride *= 2;
      if (stride > kShrinking) largest = 0;
    }
  }
}

}  // namespace whine
