// Motions of a pair or a train over its speeds, of elastic bodies or of a lumped model of a pair.
#pragma once
#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "base/matrix.h"
#include "results/friction_losses.h"
#include "results/motion_model.h"
#include "results/motion_source.h"
#include "results/remark.h"

namespace whine {

// Lines of the energy balance of a motion; a line that a kind of motion does not have is 0.
//   kinetic + modal + residual + local + modal_damping + bearing_damping + relaxation_damping + friction
//     = drive + rolling + friction_rolling + frame + switching + cutting + dropped - averaging
struct EnergyLine {
  std::string_view name, meaning;
};
inline constexpr std::array<EnergyLine, 17> kEnergyLines{
    {{"kinetic", "change of the energy of motion"},
     {"modal", "change of the energy in the springs of the kept modes and of bearings"},
     {"residual", "change of the energy in the residual flexibility"},
     {"local", "change of the energy in the half-planes, in Hertz's laws and all that is instantaneous"},
     {"drive", "work of the constant torques on the vibration"},
     {"rolling", "work of the prescribed rolling"},
     {"friction_rolling", "work of the prescribed rolling against friction; 0 without [friction]"},
     {"frame",
      "work of centrifugal forces, and of dampers on the ground by the turning of the frame; 0 of a frame that stands still"},
     {"modal_damping", "taken by the Rayleigh dampers of the kept coordinates and the dampers of the axes"},
     {"bearing_damping",
      "taken by the dampers of bearings and pins; of a pair they are in modal_damping, and this is 0"},
     {"relaxation_damping", "taken by the Rayleigh damping of the residual flexibility"},
     {"friction", "taken by friction; 0 without [friction]"},
     {"switching", "work of the scheme itself where strips or teeth part or touch within a step"},
     {"cutting", "work where a corner rule takes out or lets in a pair that carries force"},
     {"averaging", "mean load times change of the relaxed load, less the exact work: of the scheme itself"},
     {"dropped", "taken out with the relaxed loads of teeth that are no longer followed"},
     {"throughput", "sum of the sizes of the works of drive and rolling over the steps"}}};

// The column of a line in SweepResult::energy. A name that is none does not compile.
consteval Eigen::Index energy_line(std::string_view name) {
  for (size_t line = 0; line < kEnergyLines.size(); ++line)
    if (kEnergyLines[line].name == name) return static_cast<Eigen::Index>(line);
  throw "no line of the energy balance has this name";
}

// What a lumped model (Eq. 23) is made of, in place of elastic bodies: m x'' + c x' + sum_i k_i max(x - g_i, 0) = T / r,
// k_i and g_i constant in each cell of the mesh period.
struct LumpedParameters {
  double mass = 0;           // kg
  double damping_ratio = 0;  // 1: c / 2 sqrt(mean stiffness x mass)
  double damper = 0;         // N s m-1
  DamperActs damper_acts = DamperActs::always;
  Eigen::VectorXd cell_end;  // (cell) mesh phase, ascending, last 1
  MatrixRM stiffness, gap;   // (cell, spring) N m-1, m; one spring for the whole mesh, or one per tooth pair
};

// sweep.h5: rows in the order in which they were computed. A pair has one mesh and two bodies, driver and driven.
struct SweepResult : MotionSource {
  std::vector<int> section;         // [mesh] of a train: number of its [[mesh]]
  std::vector<ToothErrors> errors;  // [body] of a train; of a pair they are in `mesh`
  // Of a lumped model the fields of the bodies say where its stiffness comes from, and its damping is that of `lumped` alone.
  MotionModel model = MotionModel::finite_elements;
  LumpedParameters lumped;
  double mean_stiffness = 0;                       // N m-1 that sets the bearing dampers of a pair
  std::array<double, kSides> bearing_damper = {};  // N m s
  double natural_frequency =
      0;  // Hz, of a pair: mean over the period with the contact frozen under the static load
  int hunting_periods = 1;  // mesh periods after which the same teeth meet, as far as teeth differ
  Direction direction = Direction::up;
  Eigen::VectorXd mesh_frequency;  // (speed) Hz
  // [speed] (sample, mesh) m, N. From phase 0: the first period_multiple mesh periods are one motion; shorter ones repeat to fill the
  // row. Of a motion that is not periodic its last periods. The transmission error is that of rotations; the force of a mesh is that of its
  // pairs together, of a train the torque on the driving body over its base radius.
  std::vector<MatrixRM> transmission_error, mesh_force;
  std::vector<MatrixRM> mesh_deflection;  // the same of a train, with the motion of the hubs; empty of pairs
  Eigen::VectorXi pair;                   // (tooth_pair) -1 following, 0 reference, +1 preceding
  std::vector<MatrixRM> tooth_load;       // [speed] (sample, mesh and within it tooth_pair) N
  // [body][speed] (sample, xy) N: as in static.h5, with the bearing's damper; empty for a rigid bearing of a pair
  std::vector<std::vector<MatrixRM>> bearing_force = std::vector<std::vector<MatrixRM>>(kSides);
  // In slices over the face, (speed, mesh), else empty; over all steps. 1: K_Hbeta = w_max / w_mean of the tooth pair and the instant of the
  // largest tooth load, as face_load_factor() of system/face_points.h reads it; N m-1: largest line load w in the inner 90 % of face and path
  MatrixRM face_load_factor, line_load_max;
  MatrixRM holding_torque;  // (speed, body) N m, of a train: mean, of what holds the body; 0 of free ones
  // [speed] (sample, mesh and within it side) Pa: largest tangential stress of the teeth that carry load, along the root beside the
  // loaded flank, quasi-static in the loads of their mesh; 0 of a mesh of which it is not known, empty if it is of none
  std::vector<MatrixRM> root_stress;
  // (speed, mesh and within it side) where it is largest as it is sustained for 1/64 of a mesh period (sustained_row() of
  // signal/branches.h): rad, of the root's tangent there against the centre line of the tooth; 1, phase of the tooth's pair in its mesh
  // then, 0 at the pitch point
  MatrixRM root_stress_angle, root_stress_phase;
  Eigen::VectorXi periods;   // (speed) mesh periods run
  Eigen::VectorXd residual;  // (speed) relative change of the state over a period at the end
  // (speed) mesh periods of the orbit: hunting_periods unless subharmonic; 0: not periodic within the limit
  Eigen::VectorXi period_multiple;
  Eigen::VectorXd
      energy_imbalance;  // (speed) largest sum of what the lines leave, relative to the throughput
  MatrixRM energy;       // (speed, line of kEnergyLines) J over the stored periods
  // Of a train: what of the lines `rolling` and `bearing_damping` is of each mesh, (speed, mesh) J, and body, (speed, body) J
  MatrixRM rolling, bearing_damping;
  FrictionLosses friction;
  double friction_coupling = 0;  // m, by how much gaps are off for what friction of the last forces moves
  // (speed) N: largest force that the output must supply to hold the mean speed
  Eigen::VectorXd drift_force;
  Eigen::VectorXd jump_frequency,
      jump_width;  // (jump) Hz; of trains whose teeth differ jumps are not looked for
  // certificate: worst over all steps of the stored periods
  double least_gap = 0;        // m, of strips or teeth without force
  double least_force = 0;      // N, of those with force
  int fallbacks = 0;           // contact solutions that needed Lawson and Hanson's method
  double backlash_margin = 0;  // m left on the line of action of a pair; infinite backlash is not stored
  // (speed) m: backlash that the motion leaves, below 0 where back flanks would touch, which is not modelled; infinite where
  // the scene counts no backlash. Empty for a lumped model and trains, infinite as its file is read.
  Eigen::VectorXd backlash_left;
  std::vector<Remark> remarks;  // none for a lumped model

  Eigen::Index samples() const { return transmission_error.empty() ? 0 : transmission_error[0].rows(); }
  // Loads (sample, tooth_pair) N of a mesh at a speed.
  auto loads_of(Eigen::Index speed, Eigen::Index of_mesh) const {
    return tooth_load[static_cast<size_t>(speed)].middleCols(of_mesh * pair.size(), pair.size());
  }
};

}  // namespace whine
