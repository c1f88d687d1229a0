// Free decays at fixed mesh phases: of a pair that of the transmission error after a step of the torque, of a train those of its lowest
// modes, each after an impulse along it.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <vector>

#include "base/choice.h"
#include "base/matrix.h"
#include "results/motion_source.h"

namespace whine {

// The number of tooth pairs that carry load, or the mean over the mesh period.
enum class ContactState { none, one, two, three, four, five, six, seven, mean };
template <>
inline constexpr const char* kWordsOf<ContactState> = "no one two three four five six seven mean";

// The decays of a pair by its contact: fewest loaded tooth pairs first, each amid the longest part of the period that has it; the mean
// last.
struct ContactStateDecays {
  std::vector<ContactState> contact_state;           // (state)
  Eigen::VectorXd natural_frequency, damping_ratio;  // (state) Hz, 1
  Eigen::VectorXd undamped_frequency;                // (state) Hz: contact frozen, no damping
  Eigen::VectorXd mesh_phase;                        // (state but the mean) 1
  Eigen::VectorXd time;                              // (time) s
  MatrixRM transmission_error;                       // (state but the mean, time) m

  // The place of a state on the axis (state); nothing if no phase has it.
  std::optional<Eigen::Index> row_of(ContactState state) const {
    const auto found = std::find(contact_state.begin(), contact_state.end(), state);
    if (found == contact_state.end()) return std::nullopt;
    return found - contact_state.begin();
  }
};

// impact.h5. A natural frequency is Im s / 2 pi, that of the decaying oscillation, and a damping ratio -Re s / |s| of a root s. A pair
// has one mode, the lowest oscillation of its mesh. Modes of a train stand by rising undamped frequency at each phase: two that are near
// may change places between phases. There is no time discretisation: steps are shares of the period of a mode.
struct ImpactResult : MotionSource {
  double torque_step = 0;     // 1, of a pair: what is let go at the start, over the torque
  double impulse = 0;         // 1, of a train: see SystemImpactPlan
  double mean_stiffness = 0;  // N m-1 that sets the bearing dampers of a pair
  std::array<double, kSides> bearing_damper = {};  // N m s
  // (rigid_mode) Hz: of rigid gears on the mean stiffnesses of the meshes, free motions left out
  Eigen::VectorXd rigid_frequency;
  Eigen::VectorXd mesh_phase;   // (phase) 1
  MatrixRMi loaded_pairs;       // (phase, mesh) tooth pairs that carry load in static equilibrium
  MatrixRM undamped_frequency;  // (phase, mode) Hz: contact frozen, no damping
  // (phase, mode) 1: (mu + eta w^2) / (2 w) at the undamped frequency, as if all that deforms were damped by Eq. 21 and nothing else
  MatrixRM rayleigh_damping_ratio;
  // (phase, mode) Hz, 1: eigenvalues of the frozen contact; 0 and 1 where the mode is damped above critical
  MatrixRM eigen_frequency, eigen_damping_ratio;
  MatrixRM natural_frequency, damping_ratio;  // (phase, mode) Hz, 1: of the decays; 0 and 1 likewise
  MatrixRM
      fit_residual;  // (phase, mode) 1: RMS of what no damped exponentials explain over that of the decay
  MatrixRM
      contact_changes;  // (phase, mode) 1: steps of the decay at which other contacts carry force than before
  // (phase, frozen_mode) Hz, ascending: of a pair on bearings the lowest natural frequencies with the contact frozen, no damping: those of
  // the hubs on their bearings, and the mesh's, which is undamped_frequency. Empty for rigid axes
  MatrixRM frozen_frequency;
  ContactStateDecays states;    // of a pair
  double least_mesh_force = 0;  // 1, of a pair: least mesh force of all decays, over the static one

  // Sizes what is known of each mode at each phase, all 0.
  void size_modes(Eigen::Index phases, Eigen::Index modes) {
    for (MatrixRM* x : {&undamped_frequency, &rayleigh_damping_ratio, &eigen_frequency, &eigen_damping_ratio,
                        &natural_frequency, &damping_ratio, &fit_residual, &contact_changes})
      x->setZero(phases, modes);
  }
};

// Damping ratio of Eq. 21 alone at a frequency (Hz).
inline double rayleigh_ratio(const Damping& damping, double frequency) {
  const double w = 2 * std::numbers::pi * frequency;
  return (damping.rayleigh_mass + damping.rayleigh_stiffness * w * w) / (2 * w);
}

}  // namespace whine
