// Complementarity with friction: A of d = A p + e, p >= 0, d >= 0, p . d = 0 is not symmetric, because forces act along
// N + mu s T and gaps are read along N.
//
// A = S + E: S is symmetric positive definite, E is what friction adds. Fixed-point iteration: p_k+1 solves the problem of S
// with e + E p_k. The gaps of the whole problem are then off by E (p_k+1 - p_k), and the iteration stops when that is below
// 1e-14 of the scale of e. It contracts by about the norm of E over that of S: mu times the lever arm of friction over the
// base radius, or less.
#pragma once
#include <Eigen/Core>
#include <cmath>

#include "base/error.h"
#include "contact/complementarity.h"

namespace whine {

inline constexpr int kMostFrictionSteps = 60;
inline constexpr double kFrictionTolerance = 1e-14;  // of the scale: change of E p that counts as none

// shift: E p in whatever coordinates; start (0: none) and result. scale: m, the size of e. solve(shift) solves the
// symmetric problem under a shift; shift_of_forces() is E p of the forces found. The certificate is that of the last solve, its
// gaps are off by `coupling`; iterations and fallbacks are those of all solves. Throws Error(numerical) unless the change of
// the shift comes below the tolerance.
template <class Shift, class Solve, class ShiftOfForces>
Certificate solve_with_friction(Shift& shift, double scale, Solve&& solve, ShiftOfForces&& shift_of_forces) {
  double change = 0;
  int step = 0, iterations = 0;
  bool fallback = false;
  while (step < kMostFrictionSteps && std::isfinite(change)) {
    ++step;
    Certificate certificate = solve(shift);
    const Shift next = shift_of_forces();
    iterations += certificate.iterations;
    fallback = fallback || certificate.fallback;
    change = next.size() > 0 ? (next - shift).cwiseAbs().maxCoeff() : 0.0;
    if (change <= kFrictionTolerance * scale) {
      certificate.coupling = change;
      certificate.iterations = iterations;
      certificate.fallback = fallback;
      return certificate;
    }
    shift = next;
  }
  fail(Failure::numerical, "contact with friction has no certified solution: after ", step,
       " steps friction still moves gaps by ", change, " m, ", kFrictionTolerance * scale,
       " m is allowed; lower the coefficient of friction, or stiffen bearings that are soft beside the mesh");
}

}  // namespace whine
