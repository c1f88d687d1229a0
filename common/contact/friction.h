// Complementarity with friction: A of d = A p + e, p >= 0, d >= 0, p . d = 0 is not symmetric, because forces act along
// N + mu s T and gaps are read along N.
//
// A = S + E, S the symmetric positive definite part without friction, E what friction adds. The problem of S is solved with
// e + E p of the last p, again and again. d is then right for the p before, so that what is wrong with the whole problem is
// E (p - p before): the iteration ends when that is round-off, and its certificate is that of the whole problem. It contracts
// by about the norm of E over that of S: mu times the lever arm of friction over the base radius, or less.
#pragma once
#include <Eigen/Core>
#include <cmath>

#include "base/error.h"
#include "contact/complementarity.h"

namespace whine {

inline constexpr int kMostFrictionSteps = 60;
inline constexpr double kFrictionTolerance = 1e-14;  // of the scale: change of E p that counts as none

// shift: E p in whatever coordinates; start (0: none) and result. scale: m, what e is large as. solve(shift) solves the
// symmetric problem under a shift; shift_of_forces() is E p of the forces found. Throws Error(numerical) unless the change
// of the shift comes below the tolerance. The certificate's gaps hold but for `coupling`, which is below it.
template <class Shift, class Solve, class ShiftOfForces>
Certificate solve_with_friction(Shift& shift, double scale, Solve&& solve, ShiftOfForces&& shift_of_forces) {
  double change = 0;
  for (int step = 0; step < kMostFrictionSteps; ++step) {
    Certificate certificate = solve(shift);
    const Shift next = shift_of_forces();
    change = (next - shift).cwiseAbs().maxCoeff();
    if (!std::isfinite(change)) break;
    if (change <= kFrictionTolerance * scale) {
      certificate.coupling = change;
      return certificate;
    }
    shift = next;
  }
  fail(Failure::numerical, "contact with friction has no certified solution: after ", kMostFrictionSteps,
       " steps friction still moves gaps by ", change, " m, ", kFrictionTolerance * scale,
       " m is allowed; lower the coefficient of friction, or stiffen the bearings");
}

}  // namespace whine
