// The root of a tooth: the trochoid that a rack cuts, with its undercut, and the circular fillet of an internal gear.
#include "gear/involute.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/format.h"
#include "base/units.h"

namespace whine {

void ToothGeometry::cut_by_rack() {
  const GearDesign& design = section_;
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

Vec2 ToothGeometry::trochoid(double angle) const {
  // The normal through the pitch point and the rack-tip centre meets the rack where it cuts.
  const double pitch_point = tip_centre_side_ - tip_centre_depth_ * std::tan(angle);
  const double lateral = tip_centre_side_ - pitch_point + tool_radius_ * std::sin(angle);
  const double depth = tip_centre_depth_ + tool_radius_ * std::cos(angle);
  const double from_space = pitch_point / rp_ + std::atan2(lateral, rp_ - depth);
  return polar_point(std::hypot(rp_ - depth, lateral), 0.5 * kPi + kPi / design_.teeth - from_space);
}

Vec2 ToothGeometry::fillet(double angle) const {
  const double from = fillet_angle_ - fillet_sweep_;
  return polar_point(rf_ - tool_radius_, fillet_angle_) + polar_point(tool_radius_, from + angle);
}

Vec2 ToothGeometry::root_point(double t) const {
  if (internal()) {
    if (t <= t_arc_) return fillet(t_arc_ > 0 ? fillet_sweep_ * t / t_arc_ : 0.0);
    const double land = 0.5 * kPi + kPi / design_.teeth - fillet_angle_;
    return polar_point(rf_, fillet_angle_ + land * (t - t_arc_) / (1 - t_arc_));
  }
  if (t <= t_arc_) return trochoid(trochoid_end_ * (1 - t / t_arc_));
  const double from_space = tip_centre_side_ / rp_ * (1 - t) / (1 - t_arc_);
  return polar_point(rf_, 0.5 * kPi + kPi / design_.teeth - from_space);
}

}  // namespace whine
