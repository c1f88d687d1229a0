// What drawings and inspection sheets state of spur gears, beside the diameters of path_points.h, in closed form.
//
//   s    = m (pi / 2 + 2 x tan alpha) - A_s          tooth thickness, arc of the reference circle
//   W_k  = (k - 1) p_b + s_b                         span over k teeth, s_b the thickness on the base circle
//   c    = a - r_a - r_f,mate                        clearance of the tips; of a pinion in a ring r_f,ring - a - r_a,
//                                                    of the ring r_a,ring - a - r_f,pinion
//   zeta = 1 - (rho_mate / z_mate) / (rho / z)       specific sliding: sliding over the rolling speed of the flank
// The transverse and the normal section of a spur gear are one.
#pragma once
#include <array>
#include <optional>

#include "gear/pair.h"

namespace whine {

// m, arc of the reference circle, transverse and normal.
double reference_thickness(const ToothGeometry& gear);

struct Span {
  int teeth = 0;        // k
  double length = 0;    // m: W_k
  double diameter = 0;  // m: of the circle on which the anvils touch
};
// Of the k whose circle is nearest to the reference diameter + 2 x m, between form and tip circle. None of an internal gear, and where no k
// touches the involute.
std::optional<Span> span_measurement(const ToothGeometry& gear);

// m: from the tips of gear g to the root circle of its mate; it is the root clearance of the mate.
double tip_clearance_to_root(const GearPair& pair, int g);

// N: of all tooth pairs at rest along their normals, T / (r_b cos beta_b). torque: N m on the driver.
double normal_force(const GearDesign& driver, double torque);

// m: backlash along the normal of the flanks; on the working pitch circles.
double normal_backlash(const GearPair& pair);
double circumferential_backlash(const GearPair& pair);

// [gear] 1, at a place on the line of action (m from the pitch point): 0 at the pitch point, below 0 where the mate's flank is the faster
// one. None for a gear that is touched at its base circle, where it is infinite.
std::array<std::optional<double>, 2> specific_sliding(const GearPair& pair, double path);

// m: the most by which deviations within a class of ISO 1328-1 change the peak-to-peak transmission error of a mesh period,
//   n (f_pT,1 + f_pT,2) cos alpha + F_alphaT,1 + F_alphaT,2,   n = ceil(contact ratio) - 1
// At each instant the change of the transmission error lies between the least and the largest deviation of the tooth pairs in contact. A
// mesh period that begins as a pair comes into contact has n steps of pitch between its pairs. Run-out and cumulative pitch change over many
// periods and are left out. Throws as iso_1328_tolerances().
double most_error_of_class(const GearPair& pair, int iso_class);

}  // namespace whine
