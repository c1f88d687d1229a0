// A branch of periodic orbits.
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "model/stages.h"

namespace whine {

// branch.h5: periodic orbits along their branch, stable or not, points in the order of its arc
struct BranchResult : MotionParameters {
  double torque = 0;                                  // N m on the driver
  Eigen::VectorXd mesh_frequency, dte_rms, dte_mean;  // (point) Hz, m, m
  MatrixRM dte_harmonic;                              // (point, harmonic 1..) m, amplitude
  // (point) N: largest that the mesh, and that one pair, sustains for 1/64 of a mesh period
  Eigen::VectorXd mesh_force_sustained, tooth_load_sustained;
  // [gear] (point) Pa: the same of the root stress, quasi-static in the tooth loads; empty where bodies have no tables
  std::array<Eigen::VectorXd, 2> root_stress_sustained;
  std::array<Eigen::VectorXd, 2> root_stress_angle,
      root_stress_phase;  // [gear] (point) where, as in the sweep
  std::vector<MatrixRM>
      floquet_multiplier;  // (point) (multiplier, 2) 1: real and imaginary part, largest modulus first
  Eigen::VectorXi stable;  // (point) 1: all multipliers lie inside the unit circle
  Eigen::VectorXi steps;   // (point) 1: time steps per mesh period
  // (point) 1: mesh periods after which the orbit repeats; number of its part, from 0: points of one part follow each other along
  // the arc. Parts begin at one orbit, which is followed both ways, or beside a period doubling.
  Eigen::VectorXi period_multiple, part;
  Eigen::VectorXd residual;                  // (point) 1: change of the state over a period, relative
  Eigen::VectorXd segment_mismatch;          // (change of steps) 1: relative change of the orbit there
  Eigen::VectorXd fold_frequency, fold_rms;  // (fold) Hz, m: where the branch turns
  Eigen::VectorXi fold_smooth;               // (fold) 1: a multiplier is 1; 0: at a kink
  MatrixRM fold_multiplier;  // (fold, 2) 1: the real multiplier nearest to 1 before and after it
  // (fold), (flip), (torus) Hz: of the interval in which it lies, see SpecialPoint::width
  Eigen::VectorXd fold_width, flip_width, torus_width;
  Eigen::VectorXd flip_frequency, torus_frequency;   // Hz
  Eigen::VectorXd grazing_frequency, grazing_phase;  // (grazing) Hz, share of the mesh period
  Eigen::VectorXi grazing_pair,
      grazing_closes;  // (grazing) pair that comes into, or out of, contact; 1: it closes
  std::string end;     // why the branch was followed no further
};

}  // namespace whine
