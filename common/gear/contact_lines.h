// Contact lines of two gears over their common face: where each pair of teeth touches, and how long all of them are.
//
// z: m, along the axes from the middle of the common face, width b, towards the viewer who sees the driver turn counter-clockwise. In the
// plane of action pair j touches at mesh phase f along
//   s(z) = (f + j) p_bt + tan(beta_b) z,   path_start <= s <= path_end,   |z| <= b / 2,
// a straight line whose length is that along z over cos beta_b. Tip edges that touch off the line of action are no part of it.
#pragma once
#include <vector>

#include "gear/pair.h"
#include "model/gear.h"

namespace whine {

struct ContactLine {
  int pair = 0;                                // -1 following, 0 reference, 1 preceding
  double from = 0, to = 0;                     // m: ends of it, z
  double length() const { return to - from; }  // m, along z
};

// m from the pitch point along the path of contact: s(z), of a pair whose middle of the face is at `phase` (mesh periods).
inline double path_at(const GearPair& pair, double phase, double z) {
  return phase * pair.base_pitch() + std::tan(pair.base_helix_angle()) * z;
}

// In the order of their numbers; phase: mesh periods, any.
std::vector<ContactLine> contact_lines(const GearPair& pair, double phase);

// m: L of all of them together, along the lines.
double contact_line_length(const GearPair& pair, double phase);

// 1: first harmonic over the mean of L over a mesh period, 2 |sinc(eps_alpha) sinc(eps_beta)| with sinc(x) = sin(pi x) / (pi x), of the
// contact ratio and the overlap ratio (above or equal 0). One degree of freedom on a stiffness that goes with L loses contact where it is
// above about twice the damping ratio.
double contact_line_harmonic(double contact_ratio, double overlap_ratio);

// Forces of a helical pair under a torque (N m) on the driver: transverse along the line of action, normal to the flanks, and along the
// axis of the driver, positive along z; those on the driven gear are opposite.
struct HelicalForces {
  double transverse = 0, normal = 0, axial = 0;  // N: F_bt, F_bn, F_bx
};
HelicalForces helical_forces(const GearPair& pair, double torque);

// What lead modifications take off, as a function of z alone.
class LeadDeviation {
 public:
  LeadDeviation() = default;  // none
  // face_width: m, of the gear itself. Throws Error(input) for an end relief longer than half of it.
  LeadDeviation(const LeadModification& modification, double face_width);
  double at(double z) const;  // m

 private:
  LeadModification lead_;
  double width_ = 1;
};

}  // namespace whine
