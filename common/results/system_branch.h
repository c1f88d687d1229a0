// A branch of periodic orbits of a system of elastic gears.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "model/system_stages.h"

namespace whine {

// branch.h5 of a system: periodic orbits along their branch, stable or not, points in the order of its arc
struct SystemBranchResult {
  SystemSweepParameters settings;  // with the inertias and masses that were used
  Eigen::VectorXd torque;          // (body) N m of its drive; 0 where none gives a torque
  double axis_frequency = 0;       // Hz, see axis_frequency()
  Eigen::VectorXd mesh_frequency;  // (point) Hz
  // As in sweep.h5 of a system: (point, mesh)
  MatrixRM dte_rms, dte_mean;                // m
  MatrixRM mesh_force_max, tooth_force_max;  // N
  MatrixRM separation_fraction;              // 1
  MatrixRM bearing_force_rms;                // (point, body) N
  std::vector<MatrixRM>
      floquet_multiplier;  // (point) (multiplier, 2) 1: real and imaginary part, largest modulus first
  Eigen::VectorXi stable;  // (point) 1: all multipliers lie inside the unit circle
  Eigen::VectorXi steps;   // (point) 1: time steps per mesh period
  // (point) 1: mesh periods after which the orbit repeats; number of its part, as in branch.h5
  Eigen::VectorXi period_multiple, part;
  Eigen::VectorXd residual;          // (point) 1: change of the state over the orbit, relative
  Eigen::VectorXd segment_mismatch;  // (change of steps) 1: relative change of the orbit there
  Eigen::VectorXd fold_frequency;    // (fold) Hz: where the branch turns
  Eigen::VectorXi fold_smooth;       // (fold) 1: a multiplier is 1; 0: at a kink
  MatrixRM fold_multiplier;          // (fold, 2) 1: the real multiplier nearest to 1 before and after it
  // (fold), (flip), (torus) Hz: of the interval in which it lies, see SpecialPoint::width
  Eigen::VectorXd fold_width, flip_width, torus_width;
  Eigen::VectorXd flip_frequency, torus_frequency;   // Hz
  Eigen::VectorXd grazing_frequency, grazing_phase;  // (grazing) Hz, share of the mesh period
  Eigen::VectorXi grazing_mesh, grazing_pair,
      grazing_closes;  // (grazing) mesh, from 1, and pair that comes into, or out of, contact; 1: it closes
  std::string end;     // why the branch was followed no further
};

}  // namespace whine
