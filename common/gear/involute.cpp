#include "gear/involute.h"

#include <cmath>

#include "base/error.h"
#include "base/format.h"
#include "base/units.h"

namespace whine {

namespace {
Vec2 polar(double r, double angle) {
  return {r * std::cos(angle), r * std::sin(angle)};
}
}  // namespace

ToothGeometry::ToothGeometry(const GearDesign& design) : design_(design) {
  const double m = design.module, alpha = design.pressure_angle, z = design.teeth, x = design.profile_shift;
  rp_ = 0.5 * m * z;
  rb_ = rp_ * std::cos(alpha);
  pb_ = 2 * kPi * rb_ / z;
  ra_ = rp_ + outwards() * m * (x + design.addendum);
  rf_ = rp_ - outwards() * m * (design.dedendum - x);
  tool_radius_ = m * design.rack_tip_radius;

  if (ra_ <= rb_)
    fail(
        Failure::input, "tip radius ", millimetres(ra_), " lies below the base radius ", millimetres(rb_),
        internal()
            ? ": the tips of an internal gear would have no involute; lower addendum or profile_shift, or raise teeth or pressure_angle_deg"
            : ": there is no involute; raise addendum or profile_shift");
  const double thickness = m * (0.5 * kPi + 2 * x * std::tan(alpha)) - design.tooth_thinning;  // pitch circle
  half_base_ = thickness / (2 * rp_) + outwards() * involute_function(alpha);
  xi_tip_ = roll_angle_at_radius(ra_);
  if (internal())
    round_root_of_ring();
  else
    cut_by_rack();
  require_body();
}

void ToothGeometry::cut_by_rack() {
  const GearDesign& design = design_;
  const double m = design.module, alpha = design.pressure_angle, x = design.profile_shift;
  // The rack tip is a circle; lateral distances from the middle of its tooth, depths from the rolling line.
  tip_centre_depth_ = rp_ - rf_ - tool_radius_;
  const double half_width =
      0.25 * kPi * m + 0.5 * design.tooth_thinning - (tip_centre_depth_ + x * m) * std::tan(alpha);
  tip_centre_side_ = half_width - tool_radius_ / std::cos(alpha);
  if (tip_centre_side_ < 0)
    fail(Failure::input, "rack_tip_radius ", design.rack_tip_radius, " modules does not fit the rack tooth (",
         millimetres(-tip_centre_side_), " too wide); lower rack_tip_radius or dedendum");

  // The straight part of the rack ends at this depth; what it cuts there is the lowest involute point.
  const double straight_depth = tip_centre_depth_ + tool_radius_ * std::sin(alpha);
  const double form_curvature = rp_ * std::sin(alpha) - straight_depth / std::sin(alpha);
  trochoid_end_ = 0.5 * kPi - alpha;
  xi_form_ = form_curvature / rb_;
  if (form_curvature < 0) {
    undercut_ = -form_curvature;
    undercut_flank();
  }
  if (xi_form_ >= xi_tip_)
    fail(Failure::input, "no involute is left: the root ends at radius ",
         millimetres(rb_ * std::sqrt(1 + xi_form_ * xi_form_)), ", the tip is at ", millimetres(ra_),
         undercut_ > 0
             ? "; the rack undercuts the whole flank: raise profile_shift or teeth, or lower dedendum"
             : "; raise addendum or lower dedendum");

  double length = 0;
  constexpr int kPieces = 200;
  Vec2 last = trochoid(0);
  for (int i = 0; i < kPieces; ++i) {
    const Vec2 next = trochoid(trochoid_end_ * (i + 1) / kPieces);
    length += (next - last).norm();
    last = next;
  }
  t_arc_ = length / (length + rf_ * tip_centre_side_ / rp_);
}

// The trochoid starts inside the tooth and leaves it through the involute, once: at its end it touches the involute's other
// branch, which lies in the space. Its radius grows on the way.
void ToothGeometry::undercut_flank() {
  const auto in_tooth = [&](double angle) {
    const Vec2 p = trochoid(angle);
    const double r = p.norm();
    return r <= rb_ || std::atan2(-p.x(), p.y()) <= 0.5 * thickness_at_radius(r) / r;
  };
  double low = 0, high = trochoid_end_;
  for (double middle = 0.5 * high; middle > low && middle < high; middle = 0.5 * (low + high))
    (in_tooth(middle) ? low : high) = middle;
  trochoid_end_ = high;
  const Vec2 edge = trochoid(high);
  xi_form_ = roll_angle_at_radius(std::max(edge.norm(), rb_));
  const double miss = (flank_point(xi_form_) - edge).norm();
  if (!(miss <= 1e-14 * ra_))
    fail(Failure::numerical, "the trochoid of the undercut tooth meets its involute with an error of ", miss,
         " m, at most ", 1e-14 * ra_, " m is allowed");
}

void ToothGeometry::round_root_of_ring() {
  const double centre_radius = rf_ - tool_radius_;
  const double string = centre_radius > rb_ ? std::sqrt((centre_radius - rb_) * (centre_radius + rb_)) : 0.0;
  xi_form_ = (string + tool_radius_) / rb_;
  if (xi_form_ <= xi_tip_)
    fail(Failure::input, "no involute is left: the fillet ends at radius ",
         millimetres(rb_ * std::sqrt(1 + xi_form_ * xi_form_)), ", the tip of the ring is at ",
         millimetres(ra_), "; raise addendum or dedendum, or lower rack_tip_radius");
  const double pressure_angle = std::atan2(string, rb_);  // at the fillet's centre
  fillet_angle_ = 0.5 * kPi + half_base_ + xi_form_ - pressure_angle;
  fillet_sweep_ = 0.5 * kPi - pressure_angle;
  const double land = 0.5 * kPi + kPi / design_.teeth - fillet_angle_;
  if (land < 0)
    fail(Failure::input, "rack_tip_radius ", design_.rack_tip_radius,
         " modules does not fit the space between the teeth of the ring (its two fillets overlap by ",
         millimetres(-2 * land * rf_), "); lower rack_tip_radius or dedendum");
  const double arc = tool_radius_ * fillet_sweep_;
  t_arc_ = arc / (arc + rf_ * land);
}

// Tip thickness, and what carries the teeth.
void ToothGeometry::require_body() const {
  if (thickness_at_radius(ra_) <= 0)
    fail(Failure::input, "tip thickness is ", millimetres(thickness_at_radius(ra_)),
         internal() ? ", below zero: the flanks cross before they reach the tip circle; lower addendum"
                    : ", below zero: the flanks cross under the tip circle; lower addendum or profile_shift");
  if (internal()) {
    if (design_.rim_outer_radius <= rf_)
      fail(Failure::input, "rim_outer_radius_mm = ", shown_number(design_.rim_outer_radius * 1e3),
           " is not above the root radius of the internal gear, ", millimetres(rf_), "; raise it");
  } else if (undercut_ > 0 && !(neck() > 0)) {
    fail(Failure::input, "the rack cuts the tooth off: with teeth = ", design_.teeth,
         " and profile_shift = ", shown_number(design_.profile_shift),
         " its undercuts meet (width of the neck ", millimetres(neck()),
         "); raise profile_shift or teeth, or lower dedendum");
  } else if (design_.bore_radius >= rf_) {
    fail(Failure::input, "bore_radius_mm = ", shown_number(design_.bore_radius * 1e3),
         " is not below the root radius ", millimetres(rf_), "; lower it");
  }
}

double shift_without_undercut(const GearDesign& design) {
  const double sine = std::sin(design.pressure_angle);
  return design.dedendum - design.rack_tip_radius * (1 - sine) - 0.5 * design.teeth * sine * sine;
}

double ToothGeometry::roll_angle_at_radius(double r) const {
  if (r < rb_)
    fail(Failure::input, "radius ", millimetres(r), " lies below the base radius ", millimetres(rb_),
         ": no involute there");
  return std::sqrt((r / rb_) * (r / rb_) - 1);
}

double ToothGeometry::thickness_at_radius(double r) const {
  const double xi = roll_angle_at_radius(r);
  return 2 * r * (half_base_ - outwards() * (xi - std::atan(xi)));
}

double ToothGeometry::half_span(double r) const {
  if (r <= rf_) return kPi / design_.teeth;
  if (r >= rb_ * std::hypot(1.0, xi_form_)) return 0.5 * thickness_at_radius(r) / r;
  double low = 0, high = trochoid_end_;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (trochoid(middle).norm() < r ? low : high) = middle;
  }
  const Vec2 p = trochoid(0.5 * (low + high));
  return std::atan2(-p.x(), p.y());
}

double ToothGeometry::neck() const {
  constexpr int kPieces = 1000;
  double least = 2 * std::abs(flank_point(xi_form_).x());
  for (int i = 0; i <= kPieces; ++i) least = std::min(least, -2 * trochoid(trochoid_end_ * i / kPieces).x());
  return least;
}

Vec2 ToothGeometry::flank_point(double xi) const {
  return polar(rb_ * std::sqrt(1 + xi * xi), 0.5 * kPi + half_base_ - outwards() * (xi - std::atan(xi)));
}

Vec2 ToothGeometry::flank_normal(double xi) const {
  // The normal is tangent to the base circle; the tangent point stands at polar angle 90 deg + half_base - xi, of a ring
  // + xi.
  const double angle = 0.5 * kPi + half_base_ - outwards() * xi;
  return {-std::sin(angle), std::cos(angle)};
}

Vec2 ToothGeometry::trochoid(double angle) const {
  // The normal through the pitch point and the rack-tip centre meets the rack where it cuts.
  const double pitch_point = tip_centre_side_ - tip_centre_depth_ * std::tan(angle);
  const double lateral = tip_centre_side_ - pitch_point + tool_radius_ * std::sin(angle);
  const double depth = tip_centre_depth_ + tool_radius_ * std::cos(angle);
  const double from_space = pitch_point / rp_ + std::atan2(lateral, rp_ - depth);
  return polar(std::hypot(rp_ - depth, lateral), 0.5 * kPi + kPi / design_.teeth - from_space);
}

Vec2 ToothGeometry::fillet(double angle) const {
  const double from = fillet_angle_ - fillet_sweep_;
  return polar(rf_ - tool_radius_, fillet_angle_) + polar(tool_radius_, from + angle);
}

Vec2 ToothGeometry::root_point(double t) const {
  if (internal()) {
    if (t <= t_arc_) return fillet(t_arc_ > 0 ? fillet_sweep_ * t / t_arc_ : 0.0);
    const double land = 0.5 * kPi + kPi / design_.teeth - fillet_angle_;
    return polar(rf_, fillet_angle_ + land * (t - t_arc_) / (1 - t_arc_));
  }
  if (t <= t_arc_) return trochoid(trochoid_end_ * (1 - t / t_arc_));
  const double from_space = tip_centre_side_ / rp_ * (1 - t) / (1 - t_arc_);
  return polar(rf_, 0.5 * kPi + kPi / design_.teeth - from_space);
}

}  // namespace whine
