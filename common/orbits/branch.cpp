#include "orbits/branch.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"

namespace whine {

using Eigen::MatrixXd;
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

bool same_sequence(const std::vector<ContactEvent>& a, const std::vector<ContactEvent>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
           return x.contact == y.contact && x.closes == y.closes;
         });
}

// The curve F(u) = P^m(y) - y = 0 in u = (y, parameter / scale).
class Curve {
 public:
  Curve(PeriodMap& map, int multiple, double scale) : map_(map), multiple_(multiple), scale_(scale) {}

  int size() const { return map_.size() + 1; }
  VectorXd residual(const VectorXd& u, PeriodicOrbit* passed = nullptr) {
    place(u);
    return image(map_, u.head(map_.size()), multiple_, nullptr, passed) - u.head(map_.size());
  }
  // (size - 1, size); passed: what the period does there.
  MatrixXd jacobian(const VectorXd& u, PeriodicOrbit* passed = nullptr) {
    constexpr double kStep = 1e-6;  // of the parameter; the third derivative leaves its square
    const int n = map_.size();
    MatrixXd j(n, n + 1);
    VectorXd plus = u, minus = u;
    plus[n] *= 1 + kStep;
    minus[n] *= 1 - kStep;
    PeriodicOrbit of_plus, of_minus, own;
    VectorXd above = residual(plus, &of_plus), below = residual(minus, &of_minus);
    place(u);
    MatrixXd tangent;
    if (!passed) passed = &own;
    const VectorXd here = image(map_, u.head(n), multiple_, &tangent, passed) - u.head(n);
    // From one side only where a contact comes or goes on the other.
    const bool of_above = same_sequence(passed->events, of_plus.events),
               of_below = same_sequence(passed->events, of_minus.events);
    if (of_above && !of_below) {
      minus = u;
      below = here;
    } else if (of_below && !of_above) {
      plus = u;
      above = here;
    }
    j.col(n) = (above - below) / (plus[n] - minus[n]);
    j.leftCols(n) = tangent - MatrixXd::Identity(n, n);
    return j;
  }
  double parameter(const VectorXd& u) const { return u[map_.size()] * scale_; }
  VectorXd point(const VectorXd& y, double parameter) const {
    VectorXd u(y.size() + 1);
    u << y, parameter / scale_;
    return u;
  }

 private:
  void place(const VectorXd& u) {
    const double parameter = this->parameter(u);
    if (parameter != map_.parameter()) map_.set_parameter(parameter);
  }
  PeriodMap& map_;
  int multiple_;
  double scale_;
};

// [jacobian; across^T], factorised.
class Bordered {
 public:
  Bordered(const MatrixXd& jacobian, const VectorXd& across) {
    MatrixXd b(jacobian.cols(), jacobian.cols());
    b << jacobian, across.transpose();
    lu_.compute(b);
  }
  VectorXd solve(const VectorXd& right, double last) const {
    VectorXd r(right.size() + 1);
    r << right, last;
    return lu_.solve(r);
  }
  VectorXd tangent() const {
    const auto n = lu_.rows();
    const VectorXd t = lu_.solve(VectorXd::Unit(n, n - 1));
    return t / t.norm();
  }
  // Sign of its determinant.
  int sign() const {
    int sign = static_cast<int>(lu_.permutationP().determinant());
    for (Eigen::Index i = 0; i < lu_.rows(); ++i)
      if (lu_.matrixLU()(i, i) < 0) sign = -sign;
    return sign;
  }

 private:
  Eigen::PartialPivLU<MatrixXd> lu_;
};

struct Point {
  VectorXd u, tangent;
  int orientation = 1;  // of det [dF; tangent^T]
  MatrixXd monodromy;
  PeriodicOrbit passed;
  double residual = 0;
  int corrections = 0;
};

class Follower {
 public:
  Follower(PeriodMap& map, const BranchSettings& settings)
      : map_(map), settings_(settings), curve_(map, settings.multiple, settings.scale) {}

  // On the curve, in the plane across `direction` through `predicted`. failure() says why there is none.
  std::optional<Point> correct(const VectorXd& predicted, const VectorXd& direction) {
    constexpr int kMost = 12;
    Point p;
    p.u = predicted;
    const double tolerance = settings_.orbit.tolerance;
    double last = std::numeric_limits<double>::infinity();
    try {
      for (;; ++p.corrections) {
        const VectorXd value = curve_.residual(p.u);
        p.residual = value.norm() / std::max(1.0, p.u.norm());
        if (!std::isfinite(p.residual) || !(curve_.parameter(p.u) > 0)) {
          failure_ = "the correction diverged";
          return std::nullopt;
        }
        const bool met =
            p.residual <= tolerance || (p.residual <= 1e3 * tolerance && !(p.residual < 0.5 * last));
        if (!met && p.corrections == kMost) {
          failure_ = text("no convergence in ", kMost, " corrections: residual ", p.residual);
          return std::nullopt;
        }
        if (!met && p.corrections > 3 && p.residual > 10 * last) {
          failure_ = text("the corrections diverge: residual ", p.residual);
          return std::nullopt;
        }
        last = std::min(last, p.residual);
        const MatrixXd jacobian = curve_.jacobian(p.u, &p.passed);
        const Bordered bordered(jacobian, direction);
        if (met) {
          p.tangent = bordered.tangent();
          p.orientation = bordered.sign();
          const Eigen::Index n = map_.size();
          p.monodromy = jacobian.leftCols(n) + MatrixXd::Identity(n, n);
          return p;
        }
        p.u += bordered.solve(-value, 0);
      }
    } catch (const Error& error) {
      if (error.kind() != Failure::numerical) throw;
      failure_ = error.what();
      return std::nullopt;
    }
  }

  // The next point, a step along the branch; oriented as `from`.
  std::optional<Point> step(const Point& from, double length) {
    auto next = correct(from.u + length * from.tangent, from.tangent);
    if (!next) return std::nullopt;
    orient(from, *next);
    return next;
  }

  // Beyond a kink at which the branch turns back: along the tangent of the piece that begins there.
  std::optional<Point> around(const Point& from, double length) {
    try {
      constexpr double kClear = 4;  // steps away from the kink
      const VectorXd ahead = from.u + length * from.tangent;
      const Bordered beyond(curve_.jacobian(ahead), from.tangent);
      VectorXd tangent = beyond.tangent();
      if (beyond.sign() != from.orientation) tangent = -tangent;
      auto next = correct(ahead + kClear * length * tangent, tangent);
      if (!next) return std::nullopt;
      if (next->orientation != from.orientation) return std::nullopt;
      return next;
    } catch (const Error& error) {
      if (error.kind() != Failure::numerical) throw;
      failure_ = error.what();
      return std::nullopt;
    }
  }

  BranchPosition position(const Point& p, double arc) const {
    BranchPosition b;
    b.parameter = curve_.parameter(p.u);
    b.arc = arc;
    b.start = p.u.head(map_.size());
    b.residual = p.residual;
    b.turn = p.tangent[map_.size()];
    b.multipliers = sorted_multipliers(p.monodromy);
    b.events = p.passed.events;
    b.observable = p.passed.observable;
    return b;
  }
  // Of a period from a point that need not be an orbit. False where the model does not hold.
  bool events_at(const VectorXd& u, std::vector<ContactEvent>& events) {
    try {
      PeriodicOrbit passed;
      curve_.residual(u, &passed);
      events = passed.events;
      return true;
    } catch (const Error& error) {
      if (error.kind() != Failure::numerical) throw;
      return false;
    }
  }
  Curve& curve() { return curve_; }
  const std::string& failure() const { return failure_; }

 private:
  // Along the branch the sign of det [dF; t^T] stays. Where it does not although the tangent goes straight on, a branch
  // crosses; at a sharp kink the tangent that fits points the other way.
  static void orient(const Point& from, Point& next) {
    constexpr double kStraight = 0.7;
    if (next.orientation == from.orientation || next.tangent.dot(from.tangent) > kStraight) return;
    next.tangent = -next.tangent;
    next.orientation = -next.orientation;
  }

  PeriodMap& map_;
  const BranchSettings& settings_;
  Curve curve_;
  std::string failure_;
};

bool is_real(const std::complex<double>& x) {
  return std::abs(x.imag()) <= 1e-10 * std::max(1e-3, std::abs(x));
}

// det(M - at I), at = 1 or -1, scaled so that it does not overflow.
double determinant_at(const VectorXcd& multipliers, double at) {
  std::complex<double> product = 1;
  for (const auto& x : multipliers) product *= (x - at) / std::max(1.0, std::abs(x));
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

std::complex<double> nearest(const VectorXcd& multipliers, double at, bool real) {
  std::complex<double> best(std::numeric_limits<double>::infinity(), 0);
  for (const auto& x : multipliers)
    if (is_real(x) == real) {
      const auto away = [&](const std::complex<double>& m) {
        return real ? std::abs(m - at) : std::abs(std::abs(m) - 1);
      };
      if (!std::isfinite(best.real()) || away(x) < away(best)) best = x;
    }
  return best;
}

// The first event of the longer sequence that the other does not have.
ContactEvent additional(const std::vector<ContactEvent>& a, const std::vector<ContactEvent>& b) {
  const auto &longer = a.size() >= b.size() ? a : b, &other = a.size() >= b.size() ? b : a;
  size_t i = 0;
  while (i < other.size() && other[i].contact == longer[i].contact && other[i].closes == longer[i].closes)
    ++i;
  return i < longer.size() ? longer[i] : ContactEvent{};
}

// Two points on the arc between which a test changes its sign, brought together.
class Locator {
 public:
  // length: of the step from `from`, to whose planes all points between belong.
  Locator(Follower& follower, const Point& from, double length, double precision)
      : follower_(follower), from_(from), length_(length), precision_(precision) {}

  using Test = std::function<double(const BranchPosition&)>;
  struct Bracket {
    BranchPosition low, high;
    double value_low, value_high;
    double share_high;    // of the step, at which `high` stands
    bool smooth = false;  // the test passes through zero
    bool low_is_nearer() const { return std::abs(value_low) < std::abs(value_high); }
  };
  // Between the shares a and c of the step. Regula falsi (Illinois), bisection where that does not halve the interval in two
  // steps, or of a test that only has a sign.
  Bracket between(const BranchPosition& low, const BranchPosition& high, double a, double c, const Test& test,
                  bool sign_only = false) {
    Bracket b{low, high, test(low), test(high), c};
    const double whole = std::abs(b.value_high - b.value_low);
    double fa = b.value_low, fc = b.value_high, two_before = c - a, before = c - a;
    int last_side = 0;
    constexpr int kMost = 100;
    for (int i = 0; i < kMost && c - a > precision_; ++i) {
      const bool halve = sign_only || (i > 1 && c - a > 0.5 * two_before);
      const double at = halve ? 0.5 * (a + c) : a + (c - a) * fa / (fa - fc);
      two_before = before;
      before = c - a;
      if (!(at > a && at < c)) break;
      const auto point = follower_.step(from_, at * length_);
      if (!point) break;
      const BranchPosition here = follower_.position(*point, low.arc + (high.arc - low.arc) * at);
      const double value = test(here);
      if ((value < 0) == (b.value_low < 0)) {
        a = at;
        fa = value;
        b.low = here;
        b.value_low = value;
        if (last_side < 0) fc *= 0.5;
        last_side = -1;
      } else {
        c = b.share_high = at;
        fc = value;
        b.high = here;
        b.value_high = value;
        if (last_side > 0) fa *= 0.5;
        last_side = 1;
      }
      constexpr double kZero = 1e-14;
      if (std::abs(value) <= kZero * whole) break;
    }
    b.smooth = std::min(std::abs(b.value_low), std::abs(b.value_high)) < 1e-6 * whole ||
               std::abs(b.value_high - b.value_low) < 1e-3 * whole;
    return b;
  }

 private:
  Follower& follower_;
  const Point& from_;
  double length_, precision_;
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

// What happens between two neighbouring points of a branch.
void look_between(Follower& follower, const Point& from, const BranchPosition& a, const BranchPosition& b,
                  double length, double precision, std::vector<SpecialPoint>& found, size_t after_point) {
  Locator locator(follower, from, length, precision);
  const auto crosses = [&](const Locator::Test& test) { return (test(a) < 0) != (test(b) < 0); };
  const auto add = [&](Special kind, const Locator::Test& test) {
    const Locator::Bracket bracket = locator.between(a, b, 0, 1, test);
    found.push_back(special_at(kind, bracket.low_is_nearer() ? bracket.low : bracket.high, bracket.low,
                               bracket.high, after_point));
    found.back().smooth = bracket.smooth;
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
  BranchPosition low = a;
  double share = 0;
  for (int i = 0; i < kMostChanges && !same_sequence(low.events, b.events); ++i) {
    const std::vector<ContactEvent> events = low.events;
    const Locator::Bracket bracket = locator.between(
        low, b, share, 1,
        [&](const BranchPosition& p) { return same_sequence(p.events, events) ? -1.0 : 1.0; }, true);
    found.push_back(special_at(Special::grazing, bracket.low, bracket.low, bracket.high, after_point));
    low = bracket.high;
    share = bracket.share_high;
  }
}

// Folds, flips and grazing orbits between the last two points of a branch, in the order of the arc.
void add_special_points(Follower& follower, const Point& here, const Point& next, double location,
                        OrbitBranch& branch) {
  const size_t index = branch.points.size() - 2;
  const BranchPosition a = branch.points[index], b = branch.points[index + 1];
  std::vector<SpecialPoint> found;
  // The plane across the tangent at `here` in which the point lies.
  const double ahead = (next.u - here.u).dot(here.tangent);
  if (ahead > 0) {
    look_between(follower, here, a, b, ahead, location, found, index);
  } else if ((a.turn < 0) != (b.turn < 0)) {  // back from a kink
    found.push_back(special_at(Special::fold, a, a, b, index));
    found.back().smooth = false;
    if (!same_sequence(a.events, b.events)) found.push_back(special_at(Special::grazing, a, a, b, index));
  }
  std::sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.arc < y.arc; });
  branch.special.insert(branch.special.end(), found.begin(), found.end());
}

}  // namespace

OrbitBranch follow_branch(PeriodMap& map, const PeriodicOrbit& from, int direction,
                          const BranchSettings& settings,
                          const std::function<void(const BranchPosition&)>& report) {
  Follower follower(map, settings);
  OrbitBranch branch;
  const int n = map.size();
  const VectorXd up = VectorXd::Unit(n + 1, n);
  auto here = follower.correct(follower.curve().point(from.start, from.parameter), up);
  if (!here)
    fail(Failure::numerical, "no branch begins at ", from.parameter, ": ", follower.failure(),
         "; start from an orbit");
  if (here->tangent[n] * direction < 0) {
    here->tangent = -here->tangent;
    here->orientation = -here->orientation;
  }
  const auto take = [&](const Point& p, double arc) {
    branch.points.push_back(follower.position(p, arc));
    if (report) report(branch.points.back());
  };
  take(*here, 0);
  double step = settings.first_step;
  constexpr double kSharp =
      0.8;  // cosine between tangents, below which the step is too long, unless there is a kink
  while (static_cast<int>(branch.points.size()) < settings.most_points) {
    auto next = follower.step(*here, step);
    const bool sharp = next && next->tangent.dot(here->tangent) < kSharp;
    if ((!next || sharp) && step > settings.least_step && (!next || step > 1e-2 * settings.first_step)) {
      step = std::max(0.5 * step, settings.least_step);
      continue;
    }
    if (!next) {
      next = follower.around(*here, step);
      if (!next) {
        const BranchPosition& last = branch.points.back();
        branch.end = text("at ", last.parameter, " a step of ", step,
                          " along the branch finds no orbit: ", follower.failure());
        // A contact that comes there may end it.
        BranchPosition ahead = last;
        if (follower.events_at(here->u + step * here->tangent, ahead.events) &&
            !same_sequence(last.events, ahead.events)) {
          branch.special.push_back(special_at(Special::grazing, last, last, ahead, branch.points.size() - 1));
          branch.special.back().smooth = false;
        }
        return branch;
      }
    }
    const BranchPosition& last = branch.points.back();
    const double length = (next->u - here->u).norm();
    double parameter = follower.curve().parameter(next->u);
    const bool beyond = parameter < settings.low || parameter > settings.high;
    if (beyond) {
      // The last point stands on the limit, where the branch has one there.
      const double limit = parameter < settings.low ? settings.low : settings.high,
                   share = (limit - last.parameter) / (parameter - last.parameter);
      VectorXd u = here->u + share * (next->u - here->u);
      u[n] = limit / settings.scale;
      auto at_limit = follower.correct(u, up);
      if (at_limit && at_limit->tangent.dot(next->tangent) < 0) {
        at_limit->tangent = -at_limit->tangent;
        at_limit->orientation = -at_limit->orientation;
      }
      if (at_limit) next = at_limit;
    }
    take(*next, last.arc + length);
    add_special_points(follower, *here, *next, settings.location, branch);
    if (beyond) {
      branch.reached_limit = true;
      branch.end = text("the parameter reached ", branch.points.back().parameter);
      return branch;
    }
    if (!sharp && next->corrections <= 4 && next->tangent.dot(here->tangent) > 0.97) step *= 1.4;
    if (next->corrections > 6 || next->tangent.dot(here->tangent) < 0.92) step *= 0.7;
    step = std::clamp(step, settings.least_step, settings.largest_step);
    here = next;
  }
  branch.end = text(settings.most_points, " points were taken");
  return branch;
}

FoldSearch locate_fold(PeriodMap& map, const VectorXd& start, int multiple, double scale) {
  FoldSearch search;
  Curve curve(map, multiple, scale);
  const int n = map.size();
  VectorXd u = curve.point(start, map.parameter());
  VectorXd across = VectorXd::Constant(n + 1, 1 / std::sqrt(n + 1.0));
  const auto tangent_at = [&](const VectorXd& at) {
    VectorXd t = Bordered(curve.jacobian(at), across).tangent();
    if (t.dot(across) < 0) t = -t;
    return t;
  };
  try {
    across = tangent_at(u);
    double last = std::numeric_limits<double>::infinity();
    constexpr int kMost = 40;
    for (int i = 0; i < kMost; ++i) {
      const VectorXd value = curve.residual(u), back = Bordered(curve.jacobian(u), across).solve(-value, 0);
      u += back;
      const VectorXd t = tangent_at(u);
      across = t;
      // The turn of the tangent per arc, at points off the curve by its square only.
      constexpr double kStep = 1e-5;
      const double rate = (tangent_at(u + kStep * t)[n] - tangent_at(u - kStep * t)[n]) / (2 * kStep);
      constexpr double kFarthest = 0.05;
      const double along = std::clamp(-t[n] / rate, -kFarthest, kFarthest);
      if (!u.allFinite() || !std::isfinite(along)) {
        search.failure = "the tangent does not turn";
        return search;
      }
      u += along * t;
      const double size = std::hypot(back.norm(), along);
      if (size < 1e-12 || (size < 1e-8 && size > 0.5 * last)) {
        search.start = u.head(n);
        search.parameter = curve.parameter(u);
        map.set_parameter(search.parameter);
        return search;
      }
      last = size;
    }
    search.failure = text("no convergence: the last step was ", last);
  } catch (const Error& error) {
    if (error.kind() != Failure::numerical) throw;
    search.failure = error.what();
  }
  return search;
}

}  // namespace whine
