#include "orbits/fold_curve.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace whine {

using Eigen::VectorXd;

namespace {

// The real multiplier nearest to 1; 0 if none is real.
double nearest_to_one(const Eigen::VectorXcd& multipliers) {
  double best = 0;
  bool any = false;
  for (const auto& m : multipliers)
    if (std::abs(m.imag()) <= 1e-10 && (!any || std::abs(m.real() - 1) < std::abs(best - 1))) {
      best = m.real();
      any = true;
    }
  return best;
}

// Two folds: the one from which values go on, and the one before it, for a prediction.
Fold predicted(const std::vector<Fold>& known, double value) {
  Fold guess = known.back();
  guess.value = value;
  if (known.size() < 2) return guess;
  const Fold &a = known[known.size() - 2], &b = known.back();
  if (a.start.size() != b.start.size()) return guess;
  const double share = (value - b.value) / (b.value - a.value);
  guess.start += share * (b.start - a.start);
  guess.parameter += share * (b.parameter - a.parameter);
  return guess;
}

double squared_distance(const Fold& a, const Fold& b) {
  return a.start.size() == b.start.size() ? (a.start - b.start).squaredNorm() : 0;
}

// The point of the branch near a guess, across the guess's tangent where it has one. Nothing, with the reason, if there is none.
std::optional<CurvePoint> point_near(Curve& curve, const Fold& guess, std::string& failure) {
  const Eigen::Index all = curve.size();
  if (guess.start.size() + 1 != all) {
    failure = text("the guess has ", guess.start.size(), " numbers, a state of the map ", all - 1,
                   ": it is of another candidate zone");
    return std::nullopt;
  }
  const VectorXd begin = curve.point(guess.start, guess.parameter);
  VectorXd across = guess.tangent;
  if (across.size() != all) {
    CurvePoint first;
    first.u = begin;
    if (!curve.linearise(first, VectorXd::Constant(all, 1 / std::sqrt(static_cast<double>(all))))) {
      failure = curve.failure();
      return std::nullopt;
    }
    across = first.tangent;
  }
  auto here = curve.correct(begin, across, nullptr);
  if (here && curve.linearise(*here, across)) return here;
  failure = curve.failure();
  return std::nullopt;
}

// The value at which the arc between two folds goes to 0; the square of it is linear in the value.
std::optional<double> cusp_ahead(const FoldPair& pair) {
  const size_t k = pair.low.size();
  if (k < 2) return std::nullopt;
  const double a = squared_distance(pair.low[k - 2], pair.high[k - 2]),
               b = squared_distance(pair.low[k - 1], pair.high[k - 1]);
  if (!(b < a) || !(b > 0)) return std::nullopt;
  return pair.low[k - 1].value + b / (a - b) * (pair.low[k - 1].value - pair.low[k - 2].value);
}

void meet(FoldPair& pair, double cusp, const NamedParameter& value) {
  const size_t k = pair.low.size();
  const auto middle = [&](size_t i) { return 0.5 * (pair.low[i].parameter + pair.high[i].parameter); };
  const double at = pair.low[k - 1].value;
  pair.cusp = true;
  pair.cusp_value = cusp;
  pair.cusp_parameter =
      middle(k - 1) + (cusp - at) / (at - pair.low[k - 2].value) * (middle(k - 1) - middle(k - 2));
  pair.end = text("the folds meet at ", value.name, " ", value.words(cusp), ", followed to ",
                  shown_number(100 * std::abs(cusp / at - 1)), " % of it");
}

// Whether a parameter is one at which folds are looked for; if not `why` says so.
bool within(const FoldCurveSettings& settings, double parameter, std::string& why) {
  if (parameter > 0 && parameter >= settings.low && parameter <= settings.high) return true;
  why = text("a fold at ", settings.parameter.words(parameter), " lies outside of ",
             shown_number(settings.low), " to ", settings.parameter.words(settings.high));
  return false;
}

}  // namespace

std::optional<Fold> find_turn(PeriodMap& map, const Fold& guess, const FoldCurveSettings& settings,
                              std::string& failure) {
  constexpr int kMost = 60;
  constexpr double kTrial = 0.02;  // arc of the first step without a bend
  constexpr double kBeyond = 1.3;  // of the way to the fold, so that the next point brackets it
  constexpr double kSteady = 0.9;  // share of a turn that is left where it hardly changes
  constexpr double kEdge = 0.02;   // of a bracket that is kept away from
  constexpr double kLeastBend = 1e-6;
  constexpr double kReadable = 1e-2;  // arc over which a bend is read off
  Curve curve(map, settings.multiple, settings.scale, settings.orbit);
  const int n = map.size();
  auto here = point_near(curve, guess, failure);
  if (!here) return std::nullopt;
  double bend = guess.bend;
  std::optional<CurvePoint> rising, falling;  // nearest to the fold on either side
  const auto size = [&](const CurvePoint& p) { return std::abs(p.tangent[n]); };
  bool halve = false;
  int steady = 0;      // steps in which the turn hardly changed
  VectorXd bracketed;  // direction of the bracket
  for (int i = 0; i < kMost; ++i) {
    const double turn = here->tangent[n];
    if (i > 0 && (turn > 0 ? rising : falling))
      halve = !halve && size(*here) > 0.5 * size(*(turn > 0 ? rising : falling));
    (turn > 0 ? rising : falling) = *here;
    VectorXd next_from, direction;
    const CurvePoint* near = &*here;
    if (rising && falling) {
      const VectorXd chord = falling->u - rising->u;
      const bool first = size(*rising) < size(*falling);
      near = first ? &*rising : &*falling;
      // The parameter is extremal: what is left of it is at most the turn times the arc.
      if (std::max(size(*rising), size(*falling)) * chord.norm() < settings.tolerance * here->u[n]) {
        const double towards = chord.dot(rising->tangent) > 0 ? -1 : 1;
        if (guess.bend * towards < 0) {
          failure = text("at ", curve.parameter(near->u), " the branch bends the other way");
          return std::nullopt;
        }
        Fold fold;
        if (!within(settings, curve.parameter(near->u), failure)) return std::nullopt;
        fold.value = guess.value;
        fold.parameter = curve.parameter(near->u);
        fold.start = curve.state(near->u);
        fold.tangent = near->tangent;
        fold.bend = bend * towards > 0 ? bend : towards * (size(*rising) + size(*falling)) / kReadable;
        fold.before = nearest_to_one(rising->slow.multipliers());
        fold.after = nearest_to_one(falling->slow.multipliers());
        return fold;
      }
      const double share = halve ? 0.5 : size(*rising) / (size(*rising) + size(*falling));
      next_from = rising->u + std::clamp(share, kEdge, 1 - kEdge) * chord;
      // The direction of a short bracket is round-off.
      constexpr double kShort = 1e-5;
      if (bracketed.size() == 0 || chord.norm() > kShort) bracketed = chord.normalized();
      if (bracketed.dot(here->tangent) < 0) bracketed = -bracketed;
      direction = bracketed;
    } else {
      // A little beyond the fold that the bend predicts; farther each time that the turn has hardly changed, as it does on one
      // piece of a piecewise affine map.
      const double length = bend == 0 ? kTrial : -kBeyond * std::exp2(steady) * turn / bend;
      next_from = here->u + std::clamp(length, -settings.farthest, settings.farthest) * here->tangent;
      direction = here->tangent;
    }
    const CurvePoint before = *here;
    auto next = curve.correct(next_from, direction, near);
    if (!next || !curve.linearise(*next, direction)) {
      failure = curve.failure();
      return std::nullopt;
    }
    const double arc = (next->u - before.u).dot(before.tangent), change = (next->tangent[n] - turn) / arc;
    // Between neighbouring pieces the turn steps, on one it hardly changes: a bend shows over longer arcs.
    if (std::isfinite(change) && std::abs(change) > kLeastBend && (bend == 0 || std::abs(arc) > kReadable))
      bend = change;
    if (turn * next->tangent[n] > kSteady * turn * turn) ++steady;
    here = std::move(next);
  }
  failure = text("the turn is ", here->tangent[n], " after ", kMost, " steps");
  return std::nullopt;
}

FoldPair follow_folds(const MapFamily& family, const Fold& one, const Fold& other,
                      const std::vector<double>& values, const FoldCurveSettings& settings,
                      const std::function<void(double)>& report) {
  constexpr int kMostHalvings = 5, kMostSteps = 60;  // between two values
  constexpr double kAtCusp = 2e-3, kNearCusp = 0.02, kTowards = 0.7;
  FoldPair pair;
  const bool ordered = one.parameter < other.parameter;
  pair.low.push_back(ordered ? one : other);
  pair.high.push_back(ordered ? other : one);
  const auto found_at = [&](double value) {
    Fold found[2];
    for (int side = 0; side < 2; ++side) {
      const std::vector<Fold>& known = side == 0 ? pair.low : pair.high;
      const Fold guess = predicted(known, value);
      if (!within(settings, guess.parameter, pair.end)) return false;
      auto fold = find_turn(*family(value, guess.parameter), guess, settings, pair.end);
      // The fold may lie where the family has another map than at the guess.
      if (fold && settings.one_map && !settings.one_map(guess.parameter, fold->parameter))
        fold = find_turn(*family(value, fold->parameter), *fold, settings, pair.end);
      if (!fold) return false;
      found[side] = std::move(*fold);
    }
    if (found[0].bend * found[1].bend > 0) {
      pair.end = "both folds bend the same way";
      return false;
    }
    pair.low.push_back(std::move(found[0]));
    pair.high.push_back(std::move(found[1]));
    if (report) report(value);
    return true;
  };
  // A value of which there is no map ends the curve.
  const auto take = [&](double value) {
    try {
      return found_at(value);
    } catch (const Error& error) {
      if (error.kind() != Failure::numerical) throw;
      pair.end = error.what();
      return false;
    }
  };
  for (const double value : values) {
    double to = value;
    for (int halvings = 0, steps = 0;; ++steps) {
      const double at = pair.low.back().value;
      const auto cusp = cusp_ahead(pair);
      // Ahead of `to`: no further than a part of the way, so that both folds are there.
      const double towards = value > at ? 1 : -1;
      if (cusp && (*cusp - at) * towards > 0 && (*cusp - to) * towards <= 0) {
        if (std::abs(*cusp - at) < kAtCusp * std::abs(*cusp)) {
          meet(pair, *cusp, settings.value);
          return pair;
        }
        to = at + kTowards * (*cusp - at);
      }
      if (take(to)) {
        if (to == value) break;
        if (steps == kMostSteps) {
          pair.end = text("followed to ", settings.value.words(to),
                          ": a cusp seems to lie ahead and is not reached in ", kMostSteps, " steps");
          return pair;
        }
        to = value;
        continue;
      }
      if (++halvings > kMostHalvings) {
        pair.end =
            text("followed to ", settings.value.words(at), "; at ", settings.value.words(to), ": ", pair.end);
        // Kinks part the last folds in front of a cusp.
        if (cusp && (*cusp - at) * towards > 0 && std::abs(*cusp - at) < kNearCusp * std::abs(*cusp))
          meet(pair, *cusp, settings.value);
        return pair;
      }
      to = at + 0.5 * (to - at);
    }
  }
  pair.end = "followed through all values";
  return pair;
}

}  // namespace whine
