// The free decay of the transmission error about the static equilibrium.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "base/choice.h"
#include "base/matrix.h"
#include "model/stages.h"

namespace whine {

// The number of tooth pairs that carry load, or the mean over the mesh period.
enum class ContactState { none, one, two, three, four, five, six, seven, mean };
template <>
inline constexpr const char* kWordsOf<ContactState> = "no one two three four five six seven mean";

// impact.h5: free decay of the transmission error about the static equilibrium, gears at a fixed mesh phase. A
// natural frequency is Im s / 2 pi, that of the decaying oscillation, and a damping ratio -Re s / |s| of the lowest
// oscillating root s.
struct ImpactResult : MotionParameters {
  double torque = 0;                               // N m on the driver
  double torque_step = 0;                          // 1: what is let go at the start, over the torque
  double mean_stiffness = 0;                       // N m-1 that sets the bearing dampers
  std::array<double, kSides> bearing_damper = {};  // N m s
  // (state) fewest loaded pairs first, each amid the longest part of the period that has it; the mean last
  std::vector<ContactState> contact_state;
  Eigen::VectorXd natural_frequency, damping_ratio;              // (state) Hz, 1
  Eigen::VectorXd undamped_frequency;                            // (state) Hz: contact frozen, no damping
  Eigen::VectorXd state_phase;                                   // (state but the mean) 1: mesh phase
  Eigen::VectorXd time;                                          // (time) s
  MatrixRM transmission_error;                                   // (state but the mean, time) m
  Eigen::VectorXd mesh_phase;                                    // (phase) 1
  Eigen::VectorXi loaded_pairs;                                  // (phase) in static equilibrium
  Eigen::VectorXd phase_natural_frequency, phase_damping_ratio;  // (phase) Hz, 1: of the decay
  Eigen::VectorXd phase_undamped_frequency;                      // (phase) Hz: contact frozen, no damping
  Eigen::VectorXd eigen_frequency, eigen_damping_ratio;  // (phase) Hz, 1: eigenvalues with contact frozen
  Eigen::VectorXd fit_residual;                          // (phase) RMS of decay less fit over RMS of decay
  // (phase, mode) Hz, ascending: of gears on bearings the lowest natural frequencies with the contact frozen, no damping: those
  // of the hubs on their bearings, and the mesh's, which is phase_undamped_frequency. Empty for rigid axes
  MatrixRM frozen_frequency;
  double least_mesh_force = 0;  // 1: least mesh force of all decays, over the static one

  // The place of a state on the axis (state); nothing if no phase has it.
  std::optional<Eigen::Index> row_of(ContactState state) const {
    const auto found = std::find(contact_state.begin(), contact_state.end(), state);
    if (found == contact_state.end()) return std::nullopt;
    return found - contact_state.begin();
  }
};

}  // namespace whine
