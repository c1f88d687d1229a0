#include "gear/involute.h"

#include <cmath>

#include "base/error.h"
#include "base/format.h"
#include "base/units.h"
#include "gear/helix.h"

namespace whine {

ToothGeometry::ToothGeometry(const GearDesign& drawn) : design_(drawn), section_(transverse_section(drawn)) {
  const GearDesign& design = section_;
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

double shift_without_undercut(const GearDesign& drawn) {
  const GearDesign design = transverse_section(drawn);
  const double sine = std::sin(design.pressure_angle), in_drawing = design.module / drawn.module;
  return in_drawing *
         (design.dedendum - design.rack_tip_radius * (1 - sine) - 0.5 * design.teeth * sine * sine);
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
  return polar_point(rb_ * std::sqrt(1 + xi * xi),
                     0.5 * kPi + half_base_ - outwards() * (xi - std::atan(xi)));
}

Vec2 ToothGeometry::flank_normal(double xi) const {
  // The normal is tangent to the base circle; the tangent point stands at polar angle 90 deg + half_base - xi, of a ring
  // + xi.
  const double angle = 0.5 * kPi + half_base_ - outwards() * xi;
  return {-std::sin(angle), std::cos(angle)};
}

}  // namespace whine
