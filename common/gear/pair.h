// Kinematics of two gears in mesh: path of contact, phases, and the exact gaps between their driving flanks.
//
// Both gears' driving flanks lead in counter-clockwise rotation, so one construction serves both. Lengths
// along the line of action are counted from the pitch point in the direction of motion; a pair at phase f (in
// mesh periods from the pitch point) touches at f base pitches. Off the path of contact the tip edge of one
// gear can still touch the flank of the other ("corner contact").
#pragma once
#include <array>

#include "gear/flank_deviation.h"
#include "gear/involute.h"
#include "model/stages.h"

namespace whine {

// Gear 0 is the driver, gear 1 the driven gear.
// One pair of teeth at one phase, both gears in their unloaded conjugate positions.
struct PairContact {
  bool corner = false;      // a tip edge off the line of action
  int tip_gear = 0;         // whose tip edge touches, if corner
  bool on_flank = true;     // false: the touched point lies beyond the involute (in the root or past the tip)
  double gap = 0;           // m, separation of the nominal points along the contact normal
  double normal_angle = 0;  // rad between the two flanks' normals (0 on the line of action)
  std::array<double, 2> roll{};   // rad, roll angles of the touching points
  std::array<double, 2> lever{};  // m, lever arms of the contact force about the two axes
  double x_min = 0, x_max = 0;    // m: range of the tangential coordinate in which both involutes exist
  // Frame of the contact in the frame of the nominal point: origin and direction of the normal.
  Vec2 origin = Vec2::Zero();
  double tilt = 0;                  // rad
  std::array<double, 2> nominal{};  // rad, nominal roll angles (may lie beyond a tip)
};

// A point on each flank at the same tangential coordinate.
struct FlankGap {
  double gap = 0;                // m along the contact normal
  std::array<double, 2> roll{};  // rad
};

class GearPair {
 public:
  // Throws Error(input) if the pair does not reach, jams (backlash below -1 micrometre, tip in root, tip
  // beyond the other's involute), has unequal base pitches or a contact ratio below 1.
  GearPair(const GearDesign& driver, const GearDesign& driven, double centre_distance);
  explicit GearPair(const PairParameters& pair)
      : GearPair(pair.gear[0].design, pair.gear[1].design, pair.mesh.centre_distance) {}

  const ToothGeometry& gear(int g) const { return gear_[g]; }
  double centre_distance() const { return centre_distance_; }  // m
  double working_pressure_angle() const { return alpha_; }     // rad
  double base_pitch() const { return gear_[0].base_pitch(); }  // m
  double contact_ratio() const { return (path_end_ - path_start_) / base_pitch(); }
  double path_start() const { return path_start_; }     // m, driven gear's tip comes into contact (negative)
  double path_end() const { return path_end_; }         // m, driver's tip leaves
  double backlash() const { return backlash_; }         // m along the line of action, both gears unloaded
  double relative_curvature_radius(double path) const;  // m, rho1 rho2 / (rho1 + rho2)
  // m: 1 / second derivative of the gap along x at the touching point. At a corner the derivative is the one from
  // the side where both flanks exist: 1 / rho_flank + 1 / (rho_tip cos^3 psi), psi the angle between the normals,
  // by which the tip's flank runs off the other's tangent (curvature kappa at slope tan psi: y'' = kappa /
  // cos^3 psi). The slope tan psi itself, and the tooth that ends at the edge, are no part of it.
  double relative_curvature_radius(const PairContact& contact) const;

  // phase: mesh periods from the pitch point, any value for which the nominal point lies between the base
  // circles' tangent points (throws Error(numerical) beyond).
  PairContact contact(double phase) const;

  // x: m, tangential coordinate of the contact frame, growing to the driver's tip, 0 at the nominal touching
  // point, in [x_min, x_max]. Exact: both involutes are intersected with the line parallel to the contact
  // normal.
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

  // m, >= 0: from the nominal touching point to gear g's tip edge, the driver's at x_max, the driven gear's at x_min;
  // infinity if the flanks' common range ends before it.
  double tip_distance(const PairContact& contact, int g) const;

 private:
  Vec2 flank_in_nominal_frame(int g, double nominal, double roll) const;
  double roll_at(int g, const PairContact& contact, double x) const;
  std::array<ToothGeometry, 2> gear_;
  double centre_distance_, alpha_, path_start_, path_end_, backlash_;
};

// Where a gear stands: its body frame is turned counter-clockwise by angle, then moved to centre.
struct Placement {
  double angle = 0;            // rad
  Vec2 centre = Vec2::Zero();  // m

  Vec2 operator()(const Vec2& p) const;
};

// The unloaded gears of a pair with the driver's centre at the origin, the driven gear's above it, `phase` mesh periods after
// tooth 0 of both met at the pitch point; the driver turns counter-clockwise.
Placement placed(const GearPair& pair, int g, double phase = 0);

// Unit vector from the driver's flank to the driven gear's along the normal of a contact of gears placed so. On the line of
// action it is (-cos a, sin a), a the working pressure angle, at every phase; a corner's normal is tilted against that.
Vec2 contact_normal(const GearPair& pair, const PairContact& contact = {});

}  // namespace whine
