#include "gear/flank_deviation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/units.h"
#include "gear/flank_kink.h"

namespace whine {

using Eigen::Vector2d;

namespace {

std::string degrees(double roll) {
  return text(roll / kOneDegree, " deg");
}

double degrees_of(const GearDesign& design) {
  return design.helix_angle / kOneDegree;
}

// rad: where a relief starts. end: "tip" or "root"; `towards`: its end on the flank.
double start_of(const ToothGeometry& gear, const Relief& relief, const std::string& end, double towards) {
  const double rb = gear.base_radius(), form = gear.form_roll_angle(), tip = gear.tip_roll_angle();
  const std::string from = text(degrees(form), " (radius ", rb * std::hypot(1, form) * 1e3, " mm) to ",
                                degrees(tip), " (radius ", gear.tip_radius() * 1e3, " mm)");
  if (relief.start_radius > 0) {
    const double foot = rb * std::hypot(1, form);
    if (!(relief.start_radius >= std::min(foot, gear.tip_radius()) &&
          relief.start_radius <= std::max(foot, gear.tip_radius())))
      fail(Failure::input, end, "_relief_start_radius_mm = ", relief.start_radius * 1e3,
           " does not lie on the involute, which goes from roll angle ", from, "; start the relief on it");
    return gear.roll_angle_at_radius(relief.start_radius);
  }
  if (relief.length > 0) {
    if (!(relief.length <= rb * std::abs(tip - form)))
      fail(Failure::input, end, "_relief_length_mm = ", relief.length * 1e3,
           " is longer than the involute, whose length of roll is ", rb * std::abs(tip - form) * 1e3,
           " mm; shorten it");
    return towards + (towards == gear.largest_roll_angle() ? -1 : 1) * relief.length / rb;
  }
  if (!(relief.start_roll >= gear.least_roll_angle() && relief.start_roll <= gear.largest_roll_angle()))
    fail(Failure::input, end, "_relief_start_deg = ", relief.start_roll / kOneDegree,
         " does not lie on the involute, which goes from roll angle ", from, "; start the relief on it");
  return relief.start_roll;
}

}  // namespace

MonotoneCubic::MonotoneCubic(const std::vector<std::array<double, 2>>& points) {
  if (points.size() < 2) fail(Failure::input, "a table needs two points at least, given are ", points.size());
  for (const auto& [x, y] : points) {
    if (!x_.empty() && !(x > x_.back()))
      fail(Failure::input, "points are not in order: ", x, " after ", x_.back(), "; sort them");
    x_.push_back(x);
    y_.push_back(y);
  }
  const std::size_t n = x_.size();
  std::vector<double> h(n - 1), secant(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    h[i] = x_[i + 1] - x_[i];
    secant[i] = (y_[i + 1] - y_[i]) / h[i];
  }
  slope_.assign(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (!(secant[i - 1] * secant[i] > 0)) continue;
    const double w = (h[i - 1] + 2 * h[i]) / (3 * (h[i - 1] + h[i]));
    slope_[i] = secant[i - 1] * secant[i] / (w * secant[i] + (1 - w) * secant[i - 1]);
  }
  // Ends: the parabola through three points, held within what keeps the cubic monotone.
  const auto end = [&](std::size_t first, std::size_t second) {
    const double d = secant[first];
    const double s = ((2 * h[first] + h[second]) * d - h[first] * secant[second]) / (h[first] + h[second]);
    if (!(s * d > 0)) return 0.0;
    return secant[second] * d < 0 && std::abs(s) > 3 * std::abs(d) ? 3 * d : s;
  };
  slope_[0] = n == 2 ? secant[0] : end(0, 1);
  slope_[n - 1] = n == 2 ? secant[0] : end(n - 2, n - 3);
}

Vector2d MonotoneCubic::at(double x) const {
  if (x_.empty()) return {0, 0};
  if (x < x_.front()) return {y_.front(), 0};
  if (x > x_.back()) return {y_.back(), 0};
  const auto after = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  const std::size_t i = static_cast<std::size_t>(after - x_.begin()) - 1;
  const double h = x_[i + 1] - x_[i], t = (x - x_[i]) / h, rise = y_[i + 1] - y_[i];
  const double a = slope_[i] * h - rise, b = rise - slope_[i + 1] * h;
  // y_i + rise t + t (1 - t) (a (1 - t) + b t)
  return {y_[i] + t * (rise + (1 - t) * (a * (1 - t) + b * t)),
          (rise + (1 - 2 * t) * (a * (1 - t) + b * t) + t * (1 - t) * (b - a)) / h};
}

FlankDeviation::FlankDeviation(const ToothGeometry& gear, const FlankModification& m,
                               const ToothErrors& errors, FlankSide side)
    : form_(gear.form_roll_angle()),
      tip_(gear.tip_roll_angle()),
      middle_(0.5 * (form_ + tip_)),
      crowning_(m.crowning),
      slope_(m.slope) {
  if (m.tip.amount > 0)
    parts_.push_back(
        {start_of(gear, m.tip, "tip", tip_), tip_, m.tip.amount, m.tip.shape == ReliefShape::parabolic});
  if (m.root.amount > 0)
    parts_.push_back({start_of(gear, m.root, "root", form_), form_, m.root.amount,
                      m.root.shape == ReliefShape::parabolic});
  for (const Part& part : parts_)
    if (part.start == part.end)
      fail(Failure::input, part.end == tip_ ? "tip" : "root", "_relief_um = ", part.amount * 1e6,
           " starts at the very end of the involute, ", degrees(part.end), "; start it before");
  if (!m.points.empty()) {
    constexpr double kRounding = 0.01 * kOneDegree;  // of tables that are printed
    for (const auto& [roll, removed] : m.points)
      if (roll < gear.least_roll_angle() - kRounding || roll > gear.largest_roll_angle() + kRounding)
        fail(Failure::input, "points: the roll angle ", degrees(roll),
             " lies beyond the involute, which goes from ", degrees(form_), " to ", degrees(tip_),
             "; leave such points out");
    points_ = MonotoneCubic(m.points);
  }

  none_ = parts_.empty() && crowning_ == 0 && slope_ == 0 &&
          std::all_of(m.points.begin(), m.points.end(), [](const auto& point) { return point[1] == 0; });
  modified_ = !none_;
  if (!errors.none()) {
    const GearDesign& design = gear.design();
    if (design.helical())
      fail(Failure::input,
           "errors of teeth are those of spur gears, and this one has helix_angle_deg = ", degrees_of(design),
           "; take [gear.<name>.error] out");
    repeats_ = design.teeth;
    none_ = false;
    base_radius_ = gear.base_radius();
    reference_roll_ = std::tan(design.pressure_angle);
    outwards_ = gear.outwards();
    waves_ = errors.profile_form_waves;
    // Seen from behind, a trailing flank is a leading one, and teeth count the other way.
    const double seen = side == FlankSide::leading ? 1 : -1;
    tooth_angle_ = seen * 2 * std::numbers::pi / design.teeth;
    eccentricity_ = errors.eccentricity;
    eccentric_angle_ = 0.5 * std::numbers::pi + tooth_angle_ * errors.eccentric_tooth;
    const Vec2 normal = gear.flank_normal(0);
    normal_angle_ = std::atan2(normal.y(), normal.x());
    const ToothDeviations d = tooth_deviations(design, errors, side);
    for (int i = 0; i < repeats_; ++i)
      teeth_.push_back({-seen * d.cumulative_pitch[i] * base_radius_ / gear.pitch_radius(),
                        -d.profile_slope[i], -d.profile_form[i]});
  }
  if (none_) return;
  std::vector<double> places{form_, tip_};
  constexpr int kPlaces = 400;
  for (int i = 1; i < kPlaces; ++i) places.push_back(form_ + (tip_ - form_) * i / kPlaces);
  for (const auto& point : m.points) places.push_back(within(point[0]));
  least_ = largest_ = at(form_, 0);
  std::vector<double> low(places.size()), high(places.size());  // of all teeth
  for (int tooth = -1; tooth < (repeats_ > 1 ? repeats_ : 0); ++tooth) {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (size_t i = 0; i < places.size(); ++i) {
      const double roll = places[i];
      const Vector2d here = value_and_slope(roll, tooth < 0 ? kEveryTooth : tooth);
      const double radius = gear.base_radius() * std::hypot(1, roll);
      if (!(here[0] < 0.5 * gear.thickness_at_radius(radius)))
        fail(Failure::input, "the modification takes ", here[0] * 1e6, " micrometres off the flank at ",
             degrees(roll), ", where half of the tooth is ", 0.5e6 * gear.thickness_at_radius(radius),
             " micrometres thick; take off less");
      lowest = std::min(lowest, here[0]);
      highest = std::max(highest, here[0]);
      low[i] = tooth < 0 ? here[0] : std::min(low[i], here[0]);
      high[i] = tooth < 0 ? here[0] : std::max(high[i], here[0]);
      between_teeth_ = std::max(between_teeth_, high[i] - low[i]);
      if (tooth < 0 && repeats_ > 1) continue;
      least_ = std::min(least_, here[0]);
      largest_ = std::max(largest_, here[0]);
      steepest_ = std::max(steepest_, std::abs(here[1]) / (gear.base_radius() * roll));
    }
    spread_ = std::max(spread_, highest - lowest);
  }
}

// What sets one tooth apart; roll: within the flank.
Vector2d FlankDeviation::of_tooth(double roll, int tooth) const {
  const Tooth& own = teeth_[static_cast<size_t>(((tooth % repeats_) + repeats_) % repeats_)];
  const double span = tip_ - form_, from = (roll - reference_roll_) / span;
  const double rate = 2 * std::numbers::pi * waves_;
  Vector2d sum(own.offset + own.slope * from + 0.5 * own.form * std::sin(rate * from),
               (own.slope + 0.5 * own.form * rate * std::cos(rate * from)) / span);
  if (eccentricity_ == 0) return sum;
  // The displacement along the flank's normal brings it nearer; that along the tangent moves a flank of this curvature away, a concave
  // one nearer.
  constexpr double kLeastRoll = 0.02;
  const double angle = normal_angle_ - outwards_ * roll + tooth_angle_ * tooth - eccentric_angle_;
  const double along = eccentricity_ * std::cos(angle), across = eccentricity_ * std::sin(angle);
  const double radius = base_radius_ * std::max(roll, kLeastRoll);
  sum[0] += -along + 0.5 * outwards_ * across * across / radius;
  sum[1] += -outwards_ * across - across * along / radius -
            0.5 * outwards_ * across * across / (radius * std::max(roll, kLeastRoll));
  return sum;
}

Vector2d FlankDeviation::value_and_slope(double roll, int tooth) const {
  if (none_) return {0, 0};
  const double on = within(roll), span = tip_ - form_;
  Vector2d sum = points_.at(on);
  for (const Part& part : parts_) {
    const double t = (on - part.start) / (part.end - part.start),
                 rate = part.amount / (part.end - part.start);
    if (t <= 0) continue;
    sum += part.parabolic ? Vector2d(part.amount * t * t, 2 * rate * t) : Vector2d(part.amount * t, rate);
  }
  const double off = 2 * (on - middle_) / span;
  sum +=
      Vector2d(crowning_ * off * off + slope_ * (on - form_) / span, (4 * crowning_ * off + slope_) / span);
  if (repeats_ > 1 && tooth != kEveryTooth) sum += of_tooth(on, tooth);
  sum[0] += sum[1] * (roll - on);
  return sum;
}

std::vector<FlankRidge> flank_ridges(const ToothGeometry& gear, const FlankModification& m) {
  std::vector<FlankRidge> ridges;
  const auto add = [&](double roll, double per_roll, const char* cause) {
    if (per_roll > 0 && roll > 0) ridges.push_back({roll, per_roll / (gear.base_radius() * roll), cause});
  };
  const double form = gear.form_roll_angle(), tip = gear.tip_roll_angle();
  if (m.tip.amount > 0 && m.tip.shape == ReliefShape::linear) {
    const double start = start_of(gear, m.tip, "tip", tip);
    add(start, m.tip.amount / std::abs(tip - start), "linear tip relief");
  }
  if (m.root.amount > 0 && m.root.shape == ReliefShape::linear) {
    const double start = start_of(gear, m.root, "root", form);
    add(start, m.root.amount / std::abs(start - form), "linear root relief");
  }
  if (!m.points.empty()) {
    const MonotoneCubic points(m.points);
    const double first = m.points.front()[0], last = m.points.back()[0];
    add(first, points.at(first)[1], "table of points");
    add(last, -points.at(last)[1], "table of points");
  }
  return ridges;
}

}  // namespace whine
