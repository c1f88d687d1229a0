// Motions of a pair over its speeds, of elastic bodies or of a lumped model.
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "model/stages.h"
#include "results/friction_losses.h"
#include "results/motion_model.h"
#include "results/remark.h"

namespace whine {

// Lines of a sweep's energy balance: the changes of what is stored and what dampers take equal the works less
// averaging.
struct EnergyLine {
  const char *name, *meaning;
};
inline constexpr std::array<EnergyLine, 12> kEnergyLines{
    {{"kinetic", "change of the energy of motion"},
     {"modal", "change of the energy in the springs of the kept modes and of bearings"},
     {"residual", "change of the energy in the residual flexibility"},
     {"local", "change of the energy in the half-planes and all that is instantaneous"},
     {"drive", "work of the constant torques on the vibration"},
     {"rolling", "work of the prescribed rolling"},
     {"modal_damping", "taken by the Rayleigh and bearing dampers of the kept coordinates"},
     {"relaxation_damping", "taken by the Rayleigh damping of the residual flexibility"},
     {"switching", "work of the scheme itself where strips open or close within a step"},
     {"cutting", "work where a corner rule takes out or lets in a pair that carries force"},
     {"averaging", "mean load times change of the relaxed load, less the exact work: of the scheme itself"},
     {"dropped", "taken out with the relaxed loads of teeth that are no longer followed"}}};

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

// sweep.h5: rows in the order in which they were computed
struct SweepResult : MotionParameters {
  // Of a lumped model the fields of the bodies say where its stiffness comes from, and its damping is that of `lumped` alone.
  MotionModel model = MotionModel::finite_elements;
  LumpedParameters lumped;
  double torque = 0;                               // N m on the driver
  double mean_stiffness = 0;                       // N m-1 that sets the bearing dampers
  std::array<double, kSides> bearing_damper = {};  // N m s
  double natural_frequency = 0;  // Hz: mean over the period with the contact frozen under the static load
  int hunting_periods = 1;       // mesh periods after which the same teeth meet, as far as teeth differ
  Direction direction = Direction::up;
  Eigen::VectorXd mesh_frequency;  // (speed) Hz
  // (speed, sample) m: the first period_multiple mesh periods are one orbit, repeated to fill the row
  MatrixRM transmission_error;
  MatrixRM mesh_force;               // (speed, sample) N
  Eigen::VectorXi pair;              // (pair)
  std::vector<MatrixRM> tooth_load;  // [speed] (sample, pair) N
  // [gear][speed] (sample, xy) N: as in static.h5, with the bearing's damper; empty for a rigid bearing
  std::array<std::vector<MatrixRM>, 2> bearing_force;
  // [gear] (speed, sample) Pa: largest tangential stress of the teeth that carry load, along the root beside the loaded flank,
  // quasi-static in their loads; empty for lumped models
  std::array<MatrixRM, 2> root_stress;
  // [gear] (speed) where it is largest as it is sustained for 1/64 of a mesh period (sustained_row() of signal/branches.h): rad, of the
  // root's tangent there against the centre line of the tooth; 1, mesh phase of the tooth's pair then, 0 at the pitch point
  std::array<Eigen::VectorXd, 2> root_stress_angle, root_stress_phase;
  Eigen::VectorXi periods;   // (speed) mesh periods run
  Eigen::VectorXd residual;  // (speed) relative change of the state over a period at the end
  // (speed) mesh periods of the orbit: hunting_periods unless subharmonic; 0: not periodic within the limit
  Eigen::VectorXi period_multiple;
  Eigen::VectorXd energy_imbalance;  // (speed) relative to the input energy of the stored periods
  MatrixRM energy;                   // (speed, line of kEnergyLines) J over the stored periods
  FrictionLosses friction;
  // (speed) J over the stored periods: work of the prescribed rolling against friction, and all that friction takes; they are kept
  // beside the works and the dampers of `energy`. Empty without friction.
  Eigen::VectorXd friction_rolling, friction_work;
  double friction_coupling = 0;  // m, by how much gaps are off for what friction of the last forces moves
  // (speed) N: largest force that the output must supply to hold the mean speed
  Eigen::VectorXd drift_force;
  Eigen::VectorXd jump_frequency, jump_width;  // (jump) Hz
  // certificate: worst over all steps of the stored periods
  double least_gap = 0;        // m, of strips without force
  double least_force = 0;      // N, of strips with force
  int fallbacks = 0;           // contact solutions that needed Lawson and Hanson's method
  double backlash_margin = 0;  // m left on the line of action; infinite backlash is not stored
  // (speed) m: backlash that the motion leaves, below 0 where back flanks would touch, which is not modelled; infinite where
  // the scene counts no backlash. Empty for a lumped model, infinite as its file is read.
  Eigen::VectorXd backlash_left;
  std::vector<Remark> remarks;  // none for a lumped model
};

}  // namespace whine
