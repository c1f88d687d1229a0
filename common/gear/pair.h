// Kinematics of two gears in mesh: path of contact, phases, and the exact gaps between their driving flanks.
//
// Both gears' driving flanks lead in counter-clockwise rotation, so one construction serves both. Lengths
// along the line of action are counted from the pitch point in the direction of motion; a pair at phase f (in
// mesh periods from the pitch point) touches at f base pitches. Off the path of contact the tip edge of one
// gear can still touch the flank of the other ("corner contact"). A flank that is undercut begins with an edge, too: where the
// other gear's tip reaches below it, the path of contact begins or ends at that edge.
//
// One of the two may be an internal gear, the ring; the other one, the pinion, then lies in it. Both turn counter-clockwise, the
// ring works with its leading flanks where it drives and with its trailing ones where it is driven, and as its teeth are their
// own mirror images all that is said of a flank holds for either. With rho = r_b tan(alpha_w) +- path of each gear
//   cos(alpha_w) = |r_b1 - r_b2| / a,   1 / R = |1 / rho_1 - 1 / rho_2|,
//   contact ratio = (sqrt(r_a1^2 - r_b1^2) - sqrt(r_a2^2 - r_b2^2) + a sin(alpha_w)) / p_b, 1 the pinion, 2 the ring.
#pragma once
#include <array>
#include <cmath>

#include "gear/face_width.h"
#include "gear/flank_deviation.h"
#include "gear/involute.h"
#include "model/stages.h"

namespace whine {

// Gear 0 is the driver, gear 1 the driven gear.
// One pair of teeth at one phase, both gears in their unloaded conjugate positions.
struct PairContact {
  bool corner = false;      // an edge off the line of action
  int tip_gear = 0;         // whose edge touches, if corner: its tip edge
  bool undercut = false;    // or that at which its flank, undercut, begins
  bool on_flank = true;     // false: the touched point lies beyond the involute (in the root or past the tip)
  double gap = 0;           // m, separation of the nominal points along the contact normal
  double normal_angle = 0;  // rad between the two flanks' normals (0 on the line of action)
  std::array<double, 2> roll{};   // rad, roll angles of the touching points
  std::array<double, 2> lever{};  // m, lever arms of the contact force about the two axes
  double x_min = 0, x_max = 0;    // m: range of the tangential coordinate in which both involutes exist
  // Frame of the contact in the frame of the nominal point: origin and direction of the normal.
  Vec2 origin = Vec2::Zero();
  double tilt = 0;                  // rad
  std::array<double, 2> nominal{};  // rad, nominal roll angles (may lie beyond an edge)

  // End of the flanks' common range that is the edge, if corner: 0 at x_max, 1 at x_min.
  int end() const { return undercut ? 1 - tip_gear : tip_gear; }
};

// A point on each flank at the same tangential coordinate.
struct FlankGap {
  double gap = 0;                // m along the contact normal
  std::array<double, 2> roll{};  // rad
};

class GearPair {
 public:
  // Throws Error(input) if the pair does not reach, jams (backlash below -1 micrometre, tip in root, tip
  // beyond the other's involute, tip in an undercut root), has helices that do not fit, unequal base pitches or a contact ratio below 1; of an internal pair also for two rings,
  // a ring that has no more teeth than its pinion, and tips that run into each other beside the mesh (trochoid
  // interference).
  GearPair(const GearDesign& driver, const GearDesign& driven, double centre_distance);
  explicit GearPair(const GearPairParameters& pair)
      : GearPair(pair.gear[0].design, pair.gear[1].design, pair.mesh.centre_distance) {}

  const ToothGeometry& gear(int g) const { return gear_[g]; }
  double centre_distance() const { return centre_distance_; }  // m
  bool internal() const { return ring_ >= 0; }
  int ring() const { return ring_; }  // which gear is internal; -1: none
  // 1 if the flank of gear g is touched farther from its base circle as the gears move on, -1 if nearer to it.
  int rolls_outwards(int g) const { return along_[static_cast<size_t>(g)]; }
  // rad: of the flank point of gear g on the line of action, `path` (m) from the pitch point.
  double nominal_roll(int g, double path) const;
  // m: from the driver's centre towards the pitch point: place of the driven gear's centre. Below 0 where a pinion drives a
  // ring.
  double driven_centre_offset() const { return ring_ == 1 ? -centre_distance_ : centre_distance_; }
  double working_pressure_angle() const { return alpha_; }     // rad
  double base_pitch() const { return gear_[0].base_pitch(); }  // m
  double contact_ratio() const { return (path_end_ - path_start_) / base_pitch(); }
  double path_start() const { return path_start_; }  // m, driven gear's tip comes into contact (negative)
  double path_end() const { return path_end_; }      // m, driver's tip leaves
  // m: by how much the undercut of gear g shortens the path of contact, at its start that of the driver, at its end that of the
  // driven gear.
  double path_lost(int g) const { return path_lost_[static_cast<size_t>(g)]; }
  // rad: beta_b, positive where the driver is right-hand: a contact line lies at path + tan(beta_b) z along the face (gear/contact_lines.h).
  double base_helix_angle() const { return helix_; }
  double face_width() const { return contact_width(gear_[0].design(), gear_[1].design()); }  // m, common
  double overlap_ratio() const {
    return face_width() * std::tan(std::abs(helix_)) / base_pitch();
  }                                              // eps_beta; 0 of spur gears
  double backlash() const { return backlash_; }  // m along the line of action, both gears unloaded
  double relative_curvature_radius(
      double path) const;  // m, rho1 rho2 / (rho1 + rho2), of a ring / (rho2 - rho1)
  double largest_relative_curvature_radius() const;  // m, on the path of contact
  // m rad-1: sliding of the driven gear's flank over the driver's, towards the driver's tip, per angle by which the driver turns:
  // path (1 + z1 / z2), of an internal pair path |1 - z1 / z2|.
  double sliding(double path) const;
  // m: 1 / second derivative of the gap along x at the touching point. At a corner the derivative is the one from
  // the side where both flanks exist: 1 / rho_flank + 1 / (rho_tip cos^3 psi), psi the angle between the normals,
  // by which the tip's flank runs off the other's tangent (curvature kappa at slope tan psi: y'' = kappa /
  // cos^3 psi). The slope tan psi itself, and the tooth that ends at the edge, are no part of it.
  double relative_curvature_radius(const PairContact& contact) const;

  // Whether the flanks of a pair at this phase can touch: of internal pairs where the nominal point lies between the base circles' tangent
  // points. A tip edge of an external gear touches its mate's flank on past that point.
  bool in_reach(double phase) const;
  // phase: mesh periods from the pitch point, any value that is in reach (throws Error(numerical) beyond).
  PairContact contact(double phase) const;

  // x: m, tangential coordinate of the contact frame, growing to the driver's tip (of a ring: inwards), 0 at the nominal touching
  // point, in [x_min, x_max]. The separation e of the unloaded flanks in d = e + delta (Eq. 13). Exact: both involutes are
  // intersected with the line parallel to the contact normal.
  FlankGap gap_at(const PairContact& contact, double x) const;
  // m: the same with what the two flanks deviate by.
  double gap_at(const PairContact& contact, double x, const PairDeviation& deviation) const {
    const FlankGap exact = gap_at(contact, x);
    return deviation.none() ? exact.gap : exact.gap + deviation.at(exact.roll);
  }

  // m: tangential coordinate at which two flanks that deviate come nearest to each other; where they do not, 0. Found to
  // 1e-11 m, which is 1e-13 m of gap at a slope of 10 mrad. Between two dips of the gap that are less than a 32nd of the
  // range apart in which it can be least, either may be taken.
  double nearest(const PairContact& contact, const PairDeviation& deviation) const;

  // m, >= 0: from the nominal touching point to the edge at an end of the flanks' common range, 0 x_max, where the driver's tip edge
  // or that of a driven flank that is undercut stands, 1 x_min, the other way round; infinity if it ends at a root.
  double edge_distance(const PairContact& contact, int end) const;
  // The gear whose edge it is.
  int edge_gear(const PairContact& contact, int end) const;

 private:
  void require_reach() const;
  void require_no_interference() const;
  double signed_curvature(int g, double radius) const;  // m-1: of a flank with this radius of curvature (m)
  bool ends_at(const PairContact& contact, int end, int g, double roll) const;
  PairContact on_edge(const std::array<double, 2>& nominal, int tip, bool undercut,
                      bool passing = false) const;
  Vec2 flank_in_nominal_frame(int g, double nominal, double roll) const;
  double roll_at(int g, const PairContact& contact, double x) const;
  std::array<ToothGeometry, 2> gear_;
  int ring_;                  // -1: none
  std::array<int, 2> along_;  // see rolls_outwards()
  double centre_distance_, helix_, alpha_, path_start_, path_end_, backlash_;
  std::array<double, 2> path_lost_{};
};

// Components of v along the tangent (cos, -sin) and the normal (sin, cos); tilt: rad.
inline Vec2 rotated(const Vec2& v, double tilt) {
  return {v.x() * std::cos(tilt) - v.y() * std::sin(tilt), v.x() * std::sin(tilt) + v.y() * std::cos(tilt)};
}

// Position of a gear: its body frame is turned counter-clockwise by angle, then moved to centre.
struct Placement {
  double angle = 0;            // rad
  Vec2 centre = Vec2::Zero();  // m

  Vec2 operator()(const Vec2& p) const;
};

// The unloaded gears of a pair with the driver's centre at the origin and the pitch point above it, `phase` mesh periods after
// tooth 0 of both met at the pitch point; the driver turns counter-clockwise. The driven gear's centre lies above, too, but for
// that of a ring, which lies below.
Placement placed(const GearPair& pair, int g, double phase = 0);

// Unit vector from the driver's flank to the driven gear's along the normal of a contact of gears placed so. On the line of
// action it is (-cos a, sin a), of a ring that drives (-cos a, -sin a), a the working pressure angle, at every phase; a corner's
// normal is tilted against that.
Vec2 contact_normal(const GearPair& pair, const PairContact& contact = {});

}  // namespace whine
