#include "orbits/branch.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "orbits/curve.h"

namespace whine {

using Eigen::VectorXcd;
using Eigen::VectorXd;

const char* name(Special kind) {
  switch (kind) {
    case Special::fold:
      return "fold";
    case Special::flip:
      return "flip";
    case Special::torus:
      return "torus";
    case Special::crossing:
      return "crossing";
    case Special::grazing:
      return "grazing";
  }
  return "";
}

namespace {

VectorXd of_kind(const std::vector<SpecialPoint>& special, Special kind, double SpecialPoint::*member) {
  std::vector<double> found;
  for (const SpecialPoint& p : special)
    if (p.kind == kind) found.push_back(p.*member);
  return Eigen::Map<const VectorXd>(found.data(), static_cast<Eigen::Index>(found.size()));
}

}  // namespace

VectorXd parameters_of(const std::vector<SpecialPoint>& special, Special kind) {
  return of_kind(special, kind, &SpecialPoint::parameter);
}
VectorXd widths_of(const std::vector<SpecialPoint>& special, Special kind, double least) {
  return of_kind(special, kind, &SpecialPoint::width).cwiseMax(least * parameters_of(special, kind));
}

namespace {

// What is written of a point.
BranchPosition position(const Curve& curve, const CurvePoint& p, double arc) {
  BranchPosition b;
  b.parameter = curve.parameter(p.u);
  b.arc = arc;
  b.start = curve.state(p.u);
  b.residual = p.residual;
  b.turn = p.tangent[curve.size() - 1];
  b.multipliers = p.slow.multipliers();
  b.events = p.passed.events;
  b.observable = p.passed.observable;
  b.peaks = p.passed.peaks;
  return b;
}

// Along the branch the sign of det [dF; t^T] stays. Where it does not although the tangent goes straight on, a branch
// crosses; at a sharp kink the tangent that fits points the other way.
void orient(const CurvePoint& from, CurvePoint& next) {
  constexpr double kStraight = 0.7;
  if (next.orientation == from.orientation || next.tangent.dot(from.tangent) > kStraight) return;
  next.tangent = -next.tangent;
  next.orientation = -next.orientation;
}

// On to the curve from beside it, in the plane across `across`; with the parameter kept where the branch goes on evenly, because
// periods cost the least at one parameter, unless that leads further away than `far`.
std::optional<CurvePoint> onto(Curve& curve, const VectorXd& predicted, const VectorXd& across,
                               const CurvePoint& from, bool even, double far) {
  if (even) {
    auto p = curve.correct(predicted, VectorXd::Unit(curve.size(), curve.size() - 1), &from);
    if (p && (p->u - predicted).norm() < far) return p;
  }
  return curve.correct(predicted, across, &from);
}

// The next point, a step along the branch; oriented as `from`.
std::optional<CurvePoint> step(Curve& curve, const CurvePoint& from, double length) {
  constexpr double kEven = 0.5;  // of the tangent's parameter component may change
  const double turn = std::abs(from.tangent[curve.size() - 1]);
  const bool even = !from.slow.whole() && 2 * length * std::abs(from.bend) < kEven * turn;
  auto next = onto(curve, from.u + length * from.tangent, from.tangent, from, even, 0.5 * length);
  if (!next || !curve.linearise(*next, from.tangent)) return std::nullopt;
  orient(from, *next);
  return next;
}

// Beyond a kink at which the branch turns back: along the tangent of the piece that begins there.
std::optional<CurvePoint> around(Curve& curve, const CurvePoint& from, double length) {
  constexpr double kClear = 4;  // steps away from the kink
  CurvePoint ahead = from;
  ahead.u = from.u + length * from.tangent;
  if (!curve.linearise(ahead, from.tangent)) return std::nullopt;
  if (ahead.orientation != from.orientation) ahead.tangent = -ahead.tangent;
  auto next = curve.correct(ahead.u + kClear * length * ahead.tangent, ahead.tangent, &ahead);
  if (!next || !curve.linearise(*next, ahead.tangent)) return std::nullopt;
  if (next->orientation != from.orientation) return std::nullopt;
  return next;
}

// Of a period from a point that need not be an orbit. False where the model does not hold.
bool events_at(Curve& curve, const VectorXd& u, std::vector<ContactEvent>& events) {
  try {
    PeriodicOrbit passed;
    curve.residual(u, &passed);
    events = passed.events;
    return true;
  } catch (const Error& error) {
    if (error.kind() != Failure::numerical) throw;
    return false;
  }
}

bool is_real(const std::complex<double>& x) {
  return std::abs(x.imag()) <= 1e-10 * std::max(1e-3, std::abs(x));
}

// det(I - at M), at = 1 or -1, scaled so that it does not overflow. Multipliers near 0, of which more are known at one point than
// at another, leave its sign as it is.
double determinant_at(const VectorXcd& multipliers, double at) {
  std::complex<double> product = 1;
  for (const auto& x : multipliers) product *= (1.0 - at * x) / std::max(1.0, std::abs(x));
  return product.real();
}

double largest_complex(const VectorXcd& multipliers) {
  double largest = 0;
  for (const auto& x : multipliers)
    if (!is_real(x)) largest = std::max(largest, std::abs(x));
  return largest - 1;
}

int complex_outside(const VectorXcd& multipliers) {
  int count = 0;
  for (const auto& x : multipliers) count += !is_real(x) && std::abs(x) > 1;
  return count;
}

// Of the real ones, or of the complex ones, that nearest to `at`, or to the unit circle; of all if there is none of them.
std::complex<double> nearest(const VectorXcd& multipliers, double at, bool real) {
  const auto away = [&](const std::complex<double>& m) {
    return real ? std::abs(m - at) : std::abs(std::abs(m) - 1);
  };
  const auto best_of = [&](bool all) {
    std::complex<double> best(std::numeric_limits<double>::infinity(), 0);
    for (const auto& x : multipliers)
      if ((all || is_real(x) == real) && (!std::isfinite(best.real()) || away(x) < away(best))) best = x;
    return best;
  };
  const std::complex<double> best = best_of(false);
  return std::isfinite(best.real()) ? best : best_of(true);
}

// The first event of the longer sequence that the other does not have.
ContactEvent additional(const std::vector<ContactEvent>& a, const std::vector<ContactEvent>& b) {
  const auto &longer = a.size() >= b.size() ? a : b, &other = a.size() >= b.size() ? b : a;
  size_t i = 0;
  while (i < other.size() && other[i].contact == longer[i].contact && other[i].closes == longer[i].closes)
    ++i;
  return i < longer.size() ? longer[i] : ContactEvent{};
}

// A point between two neighbours of a branch.
struct Between {
  CurvePoint point;
  BranchPosition position;
  double share = 0;  // of the arc from one neighbour to the other
};

// Two points on the arc between which a test changes its sign, brought together.
class Locator {
 public:
  Locator(Curve& curve, const BranchSettings& settings, const CurvePoint& from, const CurvePoint& to)
      : curve_(curve), settings_(settings), from_(from), across_((to.u - from.u).normalized()) {}

  using Test = std::function<double(const BranchPosition&)>;
  struct Bracket {
    Between low, high;
    double value_low, value_high;
    bool smooth = false;  // the test passes through zero
    // The nearest points that were found on either side, of a kink those from which the steps of a tangent do not reach beyond it.
    BranchPosition before = {}, after = {};
    bool low_is_nearer() const { return std::abs(value_low) < std::abs(value_high); }
  };
  // Regula falsi (Illinois), bisection where that does not halve the interval in two steps. turns: the test is the turn of the
  // branch, so that what it leaves of the parameter is bounded.
  Bracket between(const Between& low, const Between& high, const Test& test, bool turns) {
    Bracket b{low, high, test(low.position), test(high.position)};
    std::vector<Between> lows{low}, highs{high};
    const double whole = std::abs(b.value_high - b.value_low), width = high.share - low.share;
    double fa = b.value_low, fc = b.value_high, two_before = width, before = width;
    int last_side = 0;
    constexpr int kMost = 100;
    const double arc_before = (high.point.u - low.point.u).norm();
    for (int i = 0; i < kMost; ++i) {
      const double a = b.low.share, c = b.high.share;
      const double arc = (b.high.point.u - b.low.point.u).norm(),
                   parameter = b.low.point.u[curve_.size() - 1];
      if (turns &&
          std::max(std::abs(b.value_low), std::abs(b.value_high)) * arc < settings_.fold_location * parameter)
        break;
      if (arc < settings_.location * arc_before) break;
      if (!b.low.point.slow.whole() && arc < kClear * Curve::kParameterSideStep * parameter) break;
      const bool halve = i > 1 && c - a > 0.5 * two_before;
      const double at = halve ? 0.5 * (a + c) : a + (c - a) * fa / (fa - fc);
      two_before = before;
      before = c - a;
      if (!(at > a && at < c)) break;
      auto here = find(b.low, b.high, at, true);
      if (!here) break;
      const double value = test(here->position);
      if ((value < 0) == (b.value_low < 0)) {
        lows.push_back(*here);
        b.low = std::move(*here);
        fa = b.value_low = value;
        if (last_side < 0) fc *= 0.5;
        last_side = -1;
      } else {
        highs.push_back(*here);
        b.high = std::move(*here);
        fc = b.value_high = value;
        if (last_side > 0) fa *= 0.5;
        last_side = 1;
      }
      constexpr double kZero = 1e-14;
      if (std::abs(value) <= kZero * whole) break;
    }
    b.smooth = std::min(std::abs(b.value_low), std::abs(b.value_high)) < 1e-6 * whole ||
               std::abs(b.value_high - b.value_low) < 1e-3 * whole;
    const double reach =
        b.smooth ? 0
                 : kClear * Curve::kParameterSideStep * low.point.u[curve_.size() - 1] * width / arc_before;
    b.before = last_beyond(lows, b.low.share, reach);
    b.after = last_beyond(highs, b.high.share, reach);
    return b;
  }
  // Where the sequence of contacts of `low` ends, by bisection.
  Bracket change(const Between& low, const Between& high) {
    Bracket b{low, high, -1, 1};
    while (b.high.share - b.low.share > settings_.grazing_location) {
      auto here = find(b.low, b.high, 0.5 * (b.low.share + b.high.share), false);
      if (!here) break;
      const bool as_low = same_sequence(here->position.events, b.low.position.events);
      (as_low ? b.low : b.high) = std::move(*here);
    }
    return b;
  }

 private:
  static constexpr double kClear = 100;  // steps of a tangent, nearer than which a kink may be in it
  static BranchPosition last_beyond(const std::vector<Between>& found, double end, double reach) {
    const auto clear = std::find_if(found.rbegin(), found.rend(),
                                    [&](const Between& p) { return std::abs(p.share - end) >= reach; });
    return (clear == found.rend() ? found.front() : *clear).position;
  }
  // On the arc between two points. The sequence of contacts needs no tangent.
  std::optional<Between> find(const Between& low, const Between& high, double share, bool tangent) {
    constexpr double kEven = 0.5;  // ratio of the tangents' parameter components
    const auto last = curve_.size() - 1;
    const double part = (share - low.share) / (high.share - low.share);
    const CurvePoint &a = low.point, &c = high.point, &near = part < 0.5 ? a : c;
    const VectorXd chord = c.u - a.u;
    // Of a short bracket its direction is round-off.
    constexpr double kShort = 1e-5;
    if (chord.norm() > kShort) across_ = chord.normalized();
    const double ta = a.tangent[last], tc = c.tangent[last];
    const bool even = !a.slow.whole() && ta * tc > 0 && std::min(ta / tc, tc / ta) > kEven;
    auto point = onto(curve_, a.u + part * chord, across_, near, even, chord.norm());
    if (!point) return std::nullopt;
    Between b;
    b.share = share;
    const double arc = low.position.arc + (high.position.arc - low.position.arc) * part;
    if (tangent) {
      if (!curve_.linearise(*point, across_)) return std::nullopt;
      orient(from_, *point);
      b.position = position(curve_, *point, arc);
    } else {
      point->tangent = near.tangent;
      point->slow = near.slow;
      point->jacobian = near.jacobian;
      b.position.parameter = curve_.parameter(point->u);
      b.position.arc = arc;
      b.position.start = curve_.state(point->u);
      b.position.events = point->passed.events;
    }
    b.point = std::move(*point);
    return b;
  }

  Curve& curve_;
  const BranchSettings& settings_;
  const CurvePoint& from_;
  VectorXd across_;  // the chord between the neighbours
};

SpecialPoint special_at(Special kind, const BranchPosition& at, const BranchPosition& low,
                        const BranchPosition& high, size_t after_point) {
  SpecialPoint p;
  p.kind = kind;
  p.parameter = at.parameter;
  p.arc = at.arc;
  p.start = at.start;
  p.after_point = after_point;
  if (kind == Special::grazing) {
    p.event = additional(low.events, high.events);
    p.comes = high.events.size() > low.events.size();
    return p;
  }
  const double unit = kind == Special::flip ? -1 : 1;
  p.before = nearest(low.multipliers, unit, kind != Special::torus);
  p.after = nearest(high.multipliers, unit, kind != Special::torus);
  return p;
}

// SpecialPoint::width. Between the branch's two points the test changes by `change` over an interval of the parameter and an arc.
// scale: of the parameter, of a fold; 0 of others.
double width_of(const Locator::Bracket& b, double interval, double arc, double change, double scale) {
  constexpr double kRoundOff = 1e-10;
  const double least = kRoundOff * b.low.position.parameter,
               width = std::max(std::abs(b.high.position.parameter - b.low.position.parameter), least),
               step = std::abs(b.value_high - b.value_low), low = std::abs(b.value_low),
               high = std::abs(b.value_high);
  if (!(step > 0) || !(change > 0)) return width;
  // A secant from the nearer side; of a fold the bracket is what is left of the parameter.
  if (b.smooth) return scale > 0 ? width : std::max(width * std::min(low, high) / step, least);
  // The step at the kink as a part of the change, over which a smooth test would pass through zero. Over that arc the parameter of
  // a fold changes by the turn.
  return std::max(width, step / change * (scale > 0 ? 0.5 * std::max(low, high) * arc * scale : interval));
}

// What happens between two neighbouring points of a branch.
void look_between(Curve& curve, const CurvePoint& from, const CurvePoint& to, const BranchPosition& a,
                  const BranchPosition& b, const BranchSettings& settings, std::vector<SpecialPoint>& found,
                  size_t after_point) {
  Locator locator(curve, settings, from, to);
  Between low{from, a, 0};
  const Between high{to, b, 1};
  const auto crosses = [&](const Locator::Test& test) { return (test(a) < 0) != (test(b) < 0); };
  const auto add = [&](Special kind, const Locator::Test& test) {
    const Locator::Bracket bracket = locator.between(low, high, test, kind == Special::fold);
    const BranchPosition &l = bracket.low.position, &h = bracket.high.position;
    found.push_back(
        special_at(kind, bracket.low_is_nearer() ? l : h, bracket.before, bracket.after, after_point));
    found.back().smooth = bracket.smooth;
    found.back().width = width_of(bracket, std::abs(b.parameter - a.parameter), b.arc - a.arc,
                                  std::abs(test(b) - test(a)), kind == Special::fold ? settings.scale : 0);
  };
  const Locator::Test turn = [](const BranchPosition&p) { return p.turn; },
                      flip = [](const BranchPosition&p) { return determinant_at(p.multipliers, -1); },
                      crossing = [](const BranchPosition&p) { return determinant_at(p.multipliers, 1); },
                      torus = [](const BranchPosition&p) { return largest_complex(p.multipliers); };
  if (crosses(turn))
    add(Special::fold, turn);
  else if (crosses(crossing))
    add(Special::crossing, crossing);
  if (crosses(flip)) add(Special::flip, flip);
  if (complex_outside(a.multipliers) != complex_outside(b.multipliers) && crosses(torus))
    add(Special::torus, torus);
  // Several contacts may come or go in a step, one after the other.
  constexpr int kMostChanges = 6;
  for (int i = 0;
       i < kMostChanges && settings.grazing_location < 1 && !same_sequence(low.position.events, b.events);
       ++i) {
    const Locator::Bracket bracket = locator.change(low, high);
    const BranchPosition& at = bracket.low.position;
    found.push_back(special_at(Special::grazing, at, at, bracket.high.position, after_point));
    low = bracket.high;
  }
}

// Folds, flips and grazing orbits between the last two points of a branch, in the order of the arc.
void add_special_points(Curve& curve, const CurvePoint& here, const CurvePoint& next,
                        const BranchSettings& settings, OrbitBranch& branch) {
  const size_t index = branch.points.size() - 2;
  const BranchPosition a = branch.points[index], b = branch.points[index + 1];
  std::vector<SpecialPoint> found;
  // The plane across the tangent at `here` in which the point lies.
  const double ahead = (next.u - here.u).dot(here.tangent);
  if (ahead > 0) {
    look_between(curve, here, next, a, b, settings, found, index);
  } else if ((a.turn < 0) != (b.turn < 0)) {  // back from a kink
    found.push_back(special_at(Special::fold, a, a, b, index));
    found.back().smooth = false;
    if (!same_sequence(a.events, b.events)) found.push_back(special_at(Special::grazing, a, a, b, index));
  }
  std::sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.arc < y.arc; });
  branch.special.insert(branch.special.end(), found.begin(), found.end());
}

// A branch that finds no orbit a step further may end at a contact that comes there.
void note_contact_ahead(Curve& curve, const CurvePoint& here, double length, OrbitBranch& branch) {
  const BranchPosition& last = branch.points.back();
  BranchPosition ahead = last;
  if (!events_at(curve, here.u + length * here.tangent, ahead.events) ||
      same_sequence(last.events, ahead.events))
    return;
  branch.special.push_back(special_at(Special::grazing, last, last, ahead, branch.points.size() - 1));
  branch.special.back().smooth = false;
}

// The point between `here` and `next` at which the branch comes through `limit` first, in a direction of the parameter; none if it
// is not found. Where the branch turns beyond the limit and comes back, Newton's method may find the point of its return.
std::optional<CurvePoint> at_limit(Curve& curve, const CurvePoint& here, const CurvePoint& next, double limit,
                                   int direction, double scale) {
  const Eigen::Index n = curve.size() - 1;
  const double share = (limit / scale - here.u[n]) / (next.u[n] - here.u[n]);
  VectorXd u = here.u + share * (next.u - here.u);
  u[n] = limit / scale;
  const VectorXd up = VectorXd::Unit(n + 1, n);
  auto point = curve.correct(u, up, &here);
  if (!point || !curve.linearise(*point, up)) return std::nullopt;
  if (point->tangent.dot(here.tangent) < 0) {
    point->tangent = -point->tangent;
    point->orientation = -point->orientation;
  }
  orient(here, *point);
  if (point->tangent[n] * direction < 0) return std::nullopt;
  return point;
}

// From an orbit, in a direction of the parameter.
CurvePoint first_point(Curve& curve, const PeriodicOrbit& from, int direction) {
  const int n = curve.size() - 1;
  const VectorXd up = VectorXd::Unit(n + 1, n);
  CurvePoint near;
  near.slow = from.slow;
  auto here = curve.correct(curve.point(from.start, from.parameter), up, &near);
  if (!here || !curve.linearise(*here, up))
    fail(Failure::numerical, "no branch begins at ", from.parameter, ": ", curve.failure(),
         "; start from an orbit");
  if (here->tangent[n] * direction < 0) {
    here->tangent = -here->tangent;
    here->orientation = -here->orientation;
  }
  return *here;
}

// Whether a special point from number `first` on lies beyond the parameters.
bool any_beyond(const std::vector<SpecialPoint>& special, size_t first, const BranchSettings& settings) {
  constexpr double kRoundOff = 1e-12;
  return std::any_of(
      special.begin() + static_cast<std::ptrdiff_t>(first), special.end(), [&](const SpecialPoint& p) {
        return p.parameter < settings.low * (1 - kRoundOff) || p.parameter > settings.high * (1 + kRoundOff);
      });
}

}  // namespace

OrbitBranch follow_branch(PeriodMap& map, const PeriodicOrbit& from, int direction,
                          const BranchSettings& settings,
                          const std::function<void(const BranchPosition&)>& report) {
  Curve curve(map, settings.multiple, settings.scale, settings.orbit);
  OrbitBranch branch;
  const int n = map.size();
  std::optional<CurvePoint> here = first_point(curve, from, direction);
  branch.points.push_back(position(curve, *here, 0));
  if (report) report(branch.points.back());
  double length = settings.first_step;
  constexpr int kFew = 6, kMany = 9;  // corrections
  // Cosine between tangents, below which the step is too long, unless there is a kink.
  constexpr double kSharp = 0.8;
  while (static_cast<int>(branch.points.size()) < settings.most_points) {
    auto next = step(curve, *here, length);
    const bool sharp = next && next->tangent.dot(here->tangent) < kSharp;
    // A model does not hold further by a shorter step, but a long one may lead away.
    constexpr double kLeavesRange = 0.02;
    const double least =
        !next && curve.left_range() ? kLeavesRange * settings.first_step : settings.least_step;
    if ((!next || sharp) && length > least && (!next || length > 1e-2 * settings.first_step)) {
      length = std::max(0.5 * length, least);
      continue;
    }
    if (!next) {
      next = around(curve, *here, length);
      if (!next) {
        branch.end = text("at ", settings.parameter.words(branch.points.back().parameter), " a step of ",
                          shown_number(length), " along the branch finds no orbit: ", curve.failure());
        note_contact_ahead(curve, *here, length, branch);
        return branch;
      }
    }
    const double parameter = curve.parameter(next->u);
    const int beyond = parameter < settings.low ? -1 : parameter > settings.high ? 1 : 0;
    if (beyond != 0) {
      const double limit = beyond < 0 ? settings.low : settings.high;
      next = at_limit(curve, *here, *next, limit, beyond, settings.scale);
      if (!next && length > settings.least_step) {
        length = std::max(0.5 * length, settings.least_step);
        continue;
      }
      if (!next) {
        branch.end =
            text("the branch is followed to ", settings.parameter.words(branch.points.back().parameter),
                 ": no orbit of it is found where it leaves the range, at ", settings.parameter.words(limit));
        return branch;
      }
    }
    const double passed = (next->u - here->u).norm();
    next->bend = (next->tangent[n] - here->tangent[n]) / passed;
    const size_t known = branch.special.size();
    branch.points.push_back(position(curve, *next, branch.points.back().arc + passed));
    add_special_points(curve, *here, *next, settings, branch);
    // A step over a fold beyond the parameters and back: a shorter one ends at the limit.
    if (any_beyond(branch.special, known, settings) && length > settings.least_step) {
      branch.points.pop_back();
      branch.special.resize(known);
      length = std::max(0.5 * length, settings.least_step);
      continue;
    }
    if (report) report(branch.points.back());
    if (settings.stop)
      branch.end = settings.stop(branch.points[branch.points.size() - 2], branch.points.back());
    branch.stopped = !branch.end.empty();
    if (branch.stopped) return branch;
    if (beyond != 0) {
      branch.reached_limit = beyond;
      branch.end = text("the ", settings.parameter.name, " reached ",
                        settings.parameter.words(branch.points.back().parameter));
      return branch;
    }
    if (!sharp && next->corrections <= kFew && next->tangent.dot(here->tangent) > settings.straight)
      length *= 1.4;
    if (next->corrections > kMany || 1 - next->tangent.dot(here->tangent) > 2.7 * (1 - settings.straight))
      length *= 0.7;
    length = std::clamp(length, settings.least_step, settings.largest_step);
    here = next;
  }
  branch.end = text(settings.most_points, " points were taken");
  return branch;
}

}  // namespace whine
