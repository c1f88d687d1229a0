// A pair at rest over its mesh phase.
#pragma once
#include <Eigen/Core>
#include <array>

#include "base/matrix.h"
#include "model/stages.h"

namespace whine {

// static.h5
struct StaticResult : GearPairParameters {
  double torque = 0;  // N m on the driver
  double contact_ratio = 0;
  int hunting_periods =
      1;  // mesh periods after which the same teeth meet, as far as teeth differ; all are here
  Eigen::VectorXd mesh_phase;          // (phase) 1, 0 to hunting_periods
  Eigen::VectorXd transmission_error;  // (phase) m
  Eigen::VectorXd unloaded_error;      // (phase) m: the same without load, 0 for flanks as they are designed
  // (phase) N m-1, of the mesh without bearings; the secant is the load over what it adds to the transmission error; the
  // tangent of contact "line" is off by up to 0.6 % where contact comes near a tip edge
  Eigen::VectorXd stiffness_secant, stiffness_tangent;
  Eigen::VectorXi pair;  // (pair)
  MatrixRM tooth_load;   // (phase, pair) N
  // [gear] (phase, xy) N: what a gear presses its bearing with; empty for a rigid one. The driver's centre is at the
  // origin, the driven gear's above it, the driver turns counter-clockwise.
  std::array<MatrixRM, 2> bearing_force;
  // (phase, pair) Pa, m: of contacts that stay inside the flank, 0 elsewhere
  MatrixRM contact_pressure, contact_half_width;
  // [gear] (phase, pair) Pa: largest tangential stress along the root beside the loaded flank of each pair's tooth, tension
  // positive
  std::array<MatrixRM, 2> root_stress;
  Eigen::VectorXd root_stress_max;  // (gear) Pa: largest of these
  Eigen::VectorXd
      root_stress_angle;  // (gear) rad: of the root's tangent there against the centre line of the tooth
  Eigen::VectorXd root_stress_phase;  // (gear) 1: mesh phase of the loaded pair then, 0 at the pitch point
  Eigen::VectorXi
      root_stress_tooth;  // (gear): of which tooth, counter-clockwise from tooth 0; empty for teeth that are all alike
  double loss_factor = 0;           // H_V: mean power lost by sliding, over mu times the power carried
  double friction_coefficient = 0;  // 1; 0: no friction, and what follows is empty
  // (phase) N m: work that friction takes per angle of the driver; [gear] (phase) N m: moment of friction about its axis, positive
  // where it acts as the normal force does: against the rotation of the driver, with that of the driven gear
  Eigen::VectorXd friction_loss;
  std::array<Eigen::VectorXd, 2> friction_moment;
  double efficiency = 1;                        // 1 - mean friction_loss / torque
  Eigen::VectorXd transmission_error_harmonic;  // (harmonic 0..) m: mean, then amplitudes
  Eigen::VectorXd stiffness_harmonic;           // (harmonic 0..) N m-1, of the secant stiffness
  // (order 0..) m: mean, then amplitudes of the harmonics of the hunting frequency, up to those above; empty for teeth that
  // are all alike
  Eigen::VectorXd transmission_error_order;
  double mean_stiffness = 0;  // N m-1: mean over the period of the secant stiffness
  // certificate: worst over all positions
  double least_gap = 0;          // m, of strips without force
  double least_force = 0;        // N, of strips with force
  double torque_residual = 0;    // relative, |sum a p - T| / T
  double friction_coupling = 0;  // m, by how much gaps are off for what friction of the last forces moves
  double backlash_margin = 0;    // m left on the line of action; infinite backlash is not stored
};

}  // namespace whine
