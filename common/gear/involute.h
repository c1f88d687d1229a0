// The exact tooth: involute flank and root curve, of external and of internal gears, in the transverse section (gear/helix.h).
//
// Body frame: gear centre at the origin, tooth 0 centred on +y, teeth counted counter-clockwise. The driving
// flank is the one that leads in counter-clockwise rotation (x < 0). A flank point is named by its roll angle
// xi: radius of curvature r_b xi, arc length r_b xi^2 / 2 from the base circle, radius r_b sqrt(1 + xi^2).
//
// An internal gear has its teeth on the inside of a ring. Its flanks are the involutes of the spaces between them, concave, with
// the material outside; roll angles ascend from the tip to the root. With the signs of ISO 21771 a positive profile shift
// makes the teeth thicker and moves them towards their tips, that is inwards:
//   r_a = r - m (x + addendum), r_f = r + m (dedendum - x), thickness at the pitch circle m (pi / 2 + 2 x tan alpha) - thinning.
//
// Roots. External: the trochoid that a rounded rack cuts. Where the rack reaches beyond the base circle's tangent point, it undercuts:
// the trochoid crosses the involute, whose part below the crossing is gone, and the tooth has an edge there. Internal: an arc that touches the involute and the root circle, in
// place of the trochoid that the rounded tip of a pinion-type cutter makes, whose number of teeth drawings seldom state. The arc
// of radius rho touches the flank at r_b xi = sqrt((r_f - rho)^2 - r_b^2) + rho, since its centre lies on the same involute,
// turned by rho / r_b.
#pragma once
#include <Eigen/Core>
#include <algorithm>

#include "model/gear.h"

namespace whine {

using Vec2 = Eigen::Vector2d;

// m; angle: rad from the x axis.
inline Vec2 polar_point(double r, double angle) {
  return {r * std::cos(angle), r * std::sin(angle)};
}

// inv alpha.
inline double involute_function(double angle) {
  return std::tan(angle) - angle;
}

class ToothGeometry {
 public:
  // Throws Error(input) for a gear that cannot exist: undercut that leaves no involute or cuts the tooth off, tip thickness below
  // zero, bore above the root, rack tip or fillet that does not fit the tooth space, tip or rim of an internal gear on the wrong
  // side of its base circle or root.
  explicit ToothGeometry(const GearDesign& design);

  const GearDesign& design() const { return design_; }
  const GearDesign& section() const { return section_; }  // transverse; of a spur gear the design
  double base_radius() const { return rb_; }              // m
  double pitch_radius() const { return rp_; }             // m, generating: transverse module teeth / 2
  double tip_radius() const { return ra_; }               // m
  double root_radius() const { return rf_; }              // m
  double base_pitch() const { return pb_; }               // m, transverse
  double tip_roll_angle() const { return xi_tip_; }       // rad
  double form_roll_angle() const {
    return xi_form_;
  }  // rad: where the root curve ends and the involute begins
  double least_roll_angle() const { return std::min(xi_form_, xi_tip_); }    // rad
  double largest_roll_angle() const { return std::max(xi_form_, xi_tip_); }  // rad
  // m: how far the rack reaches beyond the base circle's tangent point, along the line of action; 0: no undercut.
  double undercut() const { return undercut_; }
  bool internal() const { return design_.internal; }
  int outwards() const { return design_.internal ? -1 : 1; }  // 1: from root to tip the radius grows

  double roll_angle_at_radius(double r) const;  // rad; r >= base radius
  double thickness_at_radius(double r) const;   // m, arc; r >= base radius
  // rad: half the angle that a tooth of an external gear spans at r, its root curve included; half a pitch below the root circle.
  double half_span(double r) const;
  double neck() const;  // m: least width of the tooth below its involute
  double arc_length(double xi) const { return 0.5 * rb_ * xi * xi; }  // m

  Vec2 flank_point(double xi) const;   // m, driving flank of tooth 0
  Vec2 flank_normal(double xi) const;  // 1, outward from the material

  // Root curve of the driving-flank side, from the flank (t = 0, the form point) to the middle of the tooth
  // space (t = 1, on the sector edge at angle 90 + 180/teeth deg): trochoid or fillet, then an arc of the root circle.
  Vec2 root_point(double t) const;
  double root_corner() const {
    return t_arc_;
  }  // t where trochoid or fillet and root arc join (tangent); 1 if there is no arc

 private:
  void cut_by_rack();
  void undercut_flank();
  void round_root_of_ring();
  void require_body() const;
  Vec2 trochoid(double angle) const;  // angle of the rack-tip normal against the radial, rad
  Vec2 fillet(double angle) const;    // angle from its contact with the involute, rad
  GearDesign design_, section_;
  // rad: half the tooth is half_base_ + inv(angle at r) of a ring, half_base_ - inv(angle at r) else, at any radius r
  double rb_, rp_, ra_, rf_, pb_, xi_tip_, xi_form_ = 0, half_base_, t_arc_ = 1;
  double undercut_ = 0, trochoid_end_ = 0;             // m; rad: angle of the rack-tip normal at the flank
  double tip_centre_depth_ = 0, tip_centre_side_ = 0;  // m: rack-tip circle in the rack, see trochoid()
  double tool_radius_;                                 // m: of the rack's tip; of a ring's fillet
  double fillet_angle_ = 0, fillet_sweep_ = 0;         // rad: polar angle of its centre; its whole arc
};

// In modules: the least profile shift at which the rack that cuts the root does not undercut,
//   x = dedendum - rho (1 - sin alpha) - teeth / 2 sin^2 alpha.
double shift_without_undercut(const GearDesign& design);

}  // namespace whine
