// Natural frequency and damping of each mode of a system by ring-down, at a series of fixed mesh phases.
//
// The gears stay at the phase, in static equilibrium. An impulse along a natural mode of the frozen contact gives it a velocity, and
// the coordinate of the mode decays; the time steps are those of a sweep, with contact solved at each, but nothing rolls.
// Damped exponentials are fitted to the decay. The result also holds the eigenvalues of the frozen contact, and the natural
// frequencies of rigid gears on the mean stiffnesses of the meshes.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "dynamics/system_dynamics.h"
#include "results/impact.h"
#include "results/reduced_body.h"

namespace whine {

struct SystemImpactPlan {
  int modes = 12;   // of the lowest frequencies
  int phases = 12;  // of a mesh period
  // 1: kinetic energy of the impulse over what the equilibrium stores, its root: about the vibration over the deflection at rest
  double impulse = 1e-4;
};

struct SystemRingDown {
  Eigen::VectorXd samples;  // (sample 0..) kg^1/2 m: coordinate of the mode, less its value at rest
  int contact_changes = 0;  // steps at whose end other pairs carry force than at their start
};

// From rest with the velocity `speed` (kg^1/2 m s-1) along `shape` (coordinate) at phase i / positions; steps of `seconds`, of which
// every `stride`-th is kept. Throws Error(numerical) where tip edges that are left out would touch, and as integrate_fixed().
SystemRingDown ring_down(SystemDynamics& dynamics, int i, const Eigen::VectorXd& shape, double speed,
                         double seconds, int samples, int stride);

// bodies: [gear] of settings.body. report(done, total) is called after each phase. Throws Error(input) for a plan without modes or
// phases, or an impulse outside (0, 0.1]; else as LinesMotion and ring_down().
ImpactResult system_impact(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                           const SystemImpactPlan& plan, const std::function<void(long, long)>& report);

}  // namespace whine
