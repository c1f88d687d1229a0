// One step of a damped oscillator q'' + c q' + w^2 q = g whose force enters as the mean of its values at both
// ends.
//
// q+ = a11 q + a12 v + bq (g + g+)/2, v+ = a21 q + a22 v + bv (g + g+)/2. With the mean force, the work of
// the contact on undamped modes is exact for any step, and persistent contact is unconditionally stable.
#pragma once

namespace whine {

struct Propagator {
  double a11, a12, a21, a22;
  double bq, bv;

  // Change of q and v at the end of the next step per half unit of a new force that is kept constant: push_z = a11 bq + a12^2 + bq,
  // push_v = a21 bq + a22 a12 + a12. At the end of this step the changes are bq and bv = a12.
  double push_z() const { return a11 * bq + a12 * a12 + bq; }
  double push_v() const { return a21 * bq + a22 * a12 + a12; }
};

// frequency w: rad s-1, >= 0; damping c: s-1, >= 0; step h: s, > 0.
// Exact solution for the mean force, any damping.
Propagator exact_propagator(double frequency, double damping, double step);

// Newmark with gamma = 1/2, beta = 1/4 (Eq. 8 in one-step form, between the instants of Eq. 9; the three-point
// form has the same roots).
Propagator newmark_propagator(double frequency, double damping, double step);

// First-order relaxation eta U' + U = g under a force that is linear in the step: U+ = decay U + from_old g +
// from_new g+. relaxation eta: s, >= 0; 0 gives U+ = g+.
struct Relaxation {
  double decay, from_old, from_new;
};
Relaxation relaxation_step(double relaxation, double step);

}  // namespace whine
