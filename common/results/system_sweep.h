// Periodic motions of a system of elastic gears over its speeds.
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "base/matrix.h"
#include "model/stages.h"
#include "model/system_stages.h"
#include "results/remark.h"

namespace whine {

// Lines of the energy balance over the bodies and meshes: (name, meaning), as SystemEnergyBalance.
struct SystemEnergyLine {
  const char *name, *meaning;
};
inline constexpr std::array<SystemEnergyLine, 12> kSystemEnergyLines{
    {{"storage", "change of all that is stored"},
     {"drive", "work of the constant torques on the vibration"},
     {"rolling", "work of the prescribed rolling"},
     {"frame", "work of centrifugal forces, and of dampers on the ground by the turning of the frame"},
     {"modal_damping", "taken by the Rayleigh dampers of the kept coordinates and the dampers of the axes"},
     {"bearing_damping", "taken by the dampers of bearings and pins"},
     {"relaxation_damping", "taken by the Rayleigh damping of the residual flexibility"},
     {"switching", "work of the scheme itself where teeth part or touch within a step"},
     {"cutting", "work where a corner rule removes or adds a pair while it carries force"},
     {"averaging", "mean load times change of the relaxed load, less the exact work: of the scheme itself"},
     {"dropped", "taken out with the relaxed loads of teeth that are no longer followed"},
     {"throughput", "sum of the sizes of the works of drives and rolling over the steps"}}};

inline constexpr int kThroughputLine = 11;

// sweep.h5 of a system: rows in the order in which they were computed.
struct SystemSweepResult {
  SystemSweepParameters settings;  // with the inertias and masses that were used
  Direction direction = Direction::up;
  Eigen::VectorXd torque;          // (body) N m of its drive; 0 where none gives a torque
  double axis_frequency = 0;       // Hz, see axis_frequency(): of the rigid train on its mean stiffnesses
  int hunting_periods = 1;         // mesh periods after which the same teeth meet, as far as teeth differ
  Eigen::VectorXd mesh_frequency;  // (speed) Hz
  MatrixRM holding_torque;         // (speed, body) N m: mean, of what holds the body; 0 of free ones
  // From phase 0: the first period_multiple mesh periods are one motion; shorter ones repeat to fill the row. Of a motion that is
  // not periodic its last periods.
  std::vector<MatrixRM> transmission_error;  // [speed] (sample, mesh) m: of rotations
  std::vector<MatrixRM> mesh_deflection;     // [speed] (sample, mesh) m: with the motion of the hubs
  std::vector<MatrixRM> mesh_force;          // [speed] (sample, mesh) N
  std::vector<MatrixRM>
      largest_tooth_load;  // [speed] (sample, mesh) N: of the pair of teeth that carries most
  std::vector<std::vector<MatrixRM>> bearing_force;  // [body][speed] (sample, xy) N
  Eigen::VectorXi periods;                           // (speed) mesh periods run
  Eigen::VectorXi
      period_multiple;  // (speed) mesh periods after which the motion repeats; 0: it does not within the limit
  // (jump) Hz: where the RMS of the meshes steps along the sweep, of teeth that are alike; of the interval in which it does
  Eigen::VectorXd jump_frequency, jump_width;
  Eigen::VectorXd residual;               // (speed) relative change of the state over them
  Eigen::VectorXd energy_imbalance;       // (speed) relative to the throughput
  MatrixRM energy;                        // (speed, line of kSystemEnergyLines) J over the recorded periods
  MatrixRM rolling;                       // (speed, mesh) J
  MatrixRM bearing_damping;               // (speed, body) J
  Eigen::VectorXd drift_force;            // (speed) N
  double least_gap = 0, least_force = 0;  // m, N: worst certificate
  std::vector<Remark> remarks;            // on a carrier that turns
};

}  // namespace whine
