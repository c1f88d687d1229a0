// The exact tooth: involute flank and the trochoid that a rounded rack cuts at its root.
//
// Body frame: gear centre at the origin, tooth 0 centred on +y, teeth counted counter-clockwise. The driving
// flank is the one that leads in counter-clockwise rotation (x < 0). A flank point is named by its roll angle
// xi: radius of curvature r_b xi, arc length r_b xi^2 / 2 from the base circle, radius r_b sqrt(1 + xi^2).
#pragma once
#include <Eigen/Core>

#include "model/gear.h"

namespace whine {

using Vec2 = Eigen::Vector2d;

class ToothGeometry {
 public:
  // Throws Error(input) for a gear that cannot exist: undercut into the flank, tip thickness below zero, bore
  // above the root, rack tip that does not fit its tooth space.
  explicit ToothGeometry(const GearDesign& design);

  const GearDesign& design() const { return design_; }
  double base_radius() const { return rb_; }           // m
  double pitch_radius() const { return rp_; }          // m, generating: module teeth / 2
  double tip_radius() const { return ra_; }            // m
  double root_radius() const { return rf_; }           // m
  double base_pitch() const { return pb_; }            // m
  double tip_roll_angle() const { return xi_tip_; }    // rad
  double form_roll_angle() const { return xi_form_; }  // rad: where the trochoid ends and the involute begins

  double roll_angle_at_radius(double r) const;                        // rad; r >= base radius
  double thickness_at_radius(double r) const;                         // m, arc; r >= base radius
  double arc_length(double xi) const { return 0.5 * rb_ * xi * xi; }  // m

  Vec2 flank_point(double xi) const;   // m, driving flank of tooth 0
  Vec2 flank_normal(double xi) const;  // 1, outward from the material

  // Root curve of the driving-flank side, from the flank (t = 0, the form point) to the middle of the tooth
  // space (t = 1, on the sector edge at angle 90 + 180/teeth deg): trochoid, then an arc of the root circle.
  Vec2 root_point(double t) const;
  double root_corner() const {
    return t_arc_;
  }  // t where trochoid and root arc join (tangent); 1 if there is no arc

 private:
  Vec2 trochoid(double angle) const;  // angle of the rack-tip normal against the radial, rad
  GearDesign design_;
  double rb_, rp_, ra_, rf_, pb_, xi_tip_, xi_form_, half_base_, t_arc_ = 1;
  double tip_centre_depth_, tip_centre_side_, rack_radius_;  // m: rack-tip circle in the rack, see trochoid()
};

}  // namespace whine
