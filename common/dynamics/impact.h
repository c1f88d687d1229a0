// Natural frequency and damping by ring-down, as P2000 measures them: the gears at a fixed mesh phase in static
// equilibrium, a small part of the torque is let go, and the transmission error decays. The time steps are those
// of a sweep, with contact solved at every one, but nothing rolls.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "dynamics/dynamics.h"
#include "dynamics/ring_down.h"
#include "results/reduced_body.h"
#include "results/static.h"

namespace whine {

// Where and how far the pair is disturbed.
struct ImpactPlan {
  // 1: what is let go, over the torque. One strip that opens or closes within a decay changes the damping ratio by up
  // to 13 %; the chance that one is that near to it falls with what is let go.
  double torque_step = 1e-6;
  int phases = 256;  // even: the mean over the period is off by up to half a phase of one pair for two
};

struct RingDown {
  Eigen::VectorXd transmission_error;  // (sample 0..) m, less its static value
  double least_mesh_force = 0;         // 1: over the static one
  int contact_changes = 0;             // steps at whose end other strips carry load than at their start
};

// Free motion after the pair was in equilibrium under (1 + torque_step) of its torque; steps of `step` s, of which
// every `stride`-th is kept. Throws Error(input) for a torque step outside (0, 0.5], or one that parts the teeth;
// Error(numerical) if contact comes to the end of a candidate zone or to a tip edge that the mesh does not hold.
RingDown ring_down(const FixedPhaseMesh& mesh, double torque_step, double step, int samples, int stride);

// Lowest oscillating eigenvalue of the pair in static equilibrium with its contact frozen, see frozen_roots(). Throws
// Error(numerical) if none oscillates, or if the contact has no stiffness.
DampedRoot frozen_root(const FixedPhaseMesh& mesh);

// The pair at the phase amid each contact state, fewest loaded pairs first, without Rayleigh stiffness damping.
struct FixedPhaseState {
  ContactState contact_state = ContactState::one;  // never the mean
  double undamped_frequency = 0;                   // Hz, contact frozen
  FixedPhaseMesh mesh;
};
// phases: even, at which states are looked for. Other arguments and errors as impact().
std::vector<FixedPhaseState> fixed_phase_states(const ReducedBody& driver, const ReducedBody& driven,
                                                const StaticResult& statics, double mean_stiffness,
                                                const SweepParameters& settings, int phases);

// The same with eta (s) of Eq. 21. body: the model level of [fidelity].
FixedPhaseMesh with_rayleigh_stiffness(FixedPhaseMesh mesh, double eta, BodyModel body);

// statics: of the same torque; it gives mesh, contact discretisation and torque. mean_stiffness: N m-1, sets the
// bearing dampers. report(done, total) is called after each phase. Errors as ring_down and fit_decay; Error(input)
// for a contact level other than strips, Error(numerical) if damped exponentials leave more than 1e-5 of a decay.
ImpactResult impact(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                    double mean_stiffness, const SweepParameters& settings, const ImpactPlan& plan,
                    const std::function<void(long, long)>& report);

// The same from eigenvalues of the frozen contact, without decays, for searches: amid each contact state, and as the mean
// over the period. What decays and eigenvalues give at each phase stays 0, and the decays of the states are empty. The ring-down
// of impact() differs by less than 0.002 % in frequency and damping of the states.
ImpactResult frozen_impact(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                           double mean_stiffness, const SweepParameters& settings, int phases);

// The same at the Rayleigh stiffness factor (settings.damping.rayleigh_stiffness of the result) that gives a damping
// ratio in one contact state, to 1e-7 of it. Throws Error(input) if the state does not
// occur, or if no factor gives the ratio.
ImpactResult calibrate(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                       double mean_stiffness, const SweepParameters& settings, const ImpactPlan& plan,
                       double damping_ratio, ContactState contact_state,
                       const std::function<void(long, long)>& report);

}  // namespace whine
