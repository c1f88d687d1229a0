#include "gear/involute.h"

#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "gear/numbers.h"

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
    fail(Failure::input, "tip radius ", millimetres(ra_), " lies below the base radius ", millimetres(rb_),
         internal() ? ": the tips of an internal gear would have no involute; lower addendum or "
                      "profile_shift, or raise "
                      "teeth or pressure_angle_deg"
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
  if (form_curvature <= 0)
    fail(Failure::input, "the rack undercuts the flank: with teeth = ", design.teeth,
         " and profile_shift = ", x, " it reaches ", millimetres(-form_curvature),
         " beyond the base circle's tangent point; raise profile_shift or teeth, or lower dedendum");
  xi_form_ = form_curvature / rb_;
  if (xi_form_ >= xi_tip_)
    fail(Failure::input, "no involute is left: the root ends at radius ",
         millimetres(rb_ * std::sqrt(1 + xi_form_ * xi_form_)), ", the tip is at ", millimetres(ra_),
         "; raise addendum or lower dedendum");

  double length = 0;
  constexpr int kPieces = 200;
  const double end = 0.5 * kPi - alpha;
  for (int i = 0; i < kPieces; ++i)
    length += (trochoid(end * (i + 1) / kPieces) - trochoid(end * i / kPieces)).norm();
  t_arc_ = length / (length + rf_ * tip_centre_side_ / rp_);
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
  } else if (design_.bore_radius >= rf_) {
    fail(Failure::input, "bore_radius_mm = ", shown_number(design_.bore_radius * 1e3),
         " is not below the root radius ", millimetres(rf_), "; lower it");
  }
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
  const double end = 0.5 * kPi - design_.pressure_angle;
  if (t <= t_arc_) return trochoid(end * (1 - t / t_arc_));
  const double from_space = tip_centre_side_ / rp_ * (1 - t) / (1 - t_arc_);
  return polar(rf_, 0.5 * kPi + kPi / design_.teeth - from_space);
}

}  // namespace whine
