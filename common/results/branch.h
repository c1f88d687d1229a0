// A branch of periodic orbits of a pair or of a train.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "results/motion_source.h"

namespace whine {

// branch.h5: periodic orbits along their branch, stable or not, points in the order of its arc. What a mesh, a body or a tooth shows over
// an orbit is what response.h5 says of the motion of a sweep.
struct BranchResult : MotionSource {
  Eigen::VectorXd mesh_frequency;           // (point) Hz
  MatrixRM dte_rms, dte_mean;               // (point, mesh) m
  std::vector<MatrixRM> dte_harmonic;       // [point] (harmonic 1.., mesh) m, amplitude
  MatrixRM mesh_force_max, tooth_load_max;  // (point, mesh) N
  // (point, mesh) N: largest that the mesh, and that one tooth pair, sustains for 1/64 of a mesh period
  MatrixRM mesh_force_sustained, tooth_load_sustained;
  MatrixRM separation_fraction;  // (point, mesh) 1
  // (point, body) N: RMS of what oscillates of the force on its bearing; 0 of a gear of a pair on a rigid bearing, empty if both are
  MatrixRM bearing_force_rms;
  // (point, mesh and within it side) Pa: the root stress that is sustained likewise, quasi-static in the tooth loads; 0 of a mesh of which
  // it is not known, empty if it is of none
  MatrixRM root_stress_sustained;
  MatrixRM root_stress_angle, root_stress_phase;  // the same: where, as in the sweep
  std::vector<MatrixRM>
      floquet_multiplier;  // (point) (multiplier, 2) 1: real and imaginary part, largest modulus first
  Eigen::VectorXi stable;  // (point) 1: all multipliers lie inside the unit circle
  Eigen::VectorXi steps;   // (point) 1: time steps per mesh period
  // (point) 1: mesh periods after which the orbit repeats; number of its part, from 0: points of one part follow each other along
  // the arc. Parts begin at one orbit, which is followed both ways, or beside a period doubling.
  Eigen::VectorXi period_multiple, part;
  Eigen::VectorXd residual;          // (point) 1: change of the state over the orbit, relative
  Eigen::VectorXd segment_mismatch;  // (change of steps) 1: relative change of the orbit there
  Eigen::VectorXd fold_frequency;    // (fold) Hz: where the branch turns
  MatrixRM fold_rms;                 // (fold, mesh) m
  Eigen::VectorXi fold_smooth;       // (fold) 1: a multiplier is 1; 0: at a kink
  MatrixRM fold_multiplier;          // (fold, 2) 1: the real multiplier nearest to 1 before and after it
  // (fold), (flip), (torus) Hz: of the interval in which it lies, see SpecialPoint::width
  Eigen::VectorXd fold_width, flip_width, torus_width;
  Eigen::VectorXd flip_frequency, torus_frequency;   // Hz
  Eigen::VectorXd grazing_frequency, grazing_phase;  // (grazing) Hz, share of the mesh period
  // (grazing) place of the mesh on its axis, from 0, and tooth pair that comes into, or out of, contact; 1: it closes
  Eigen::VectorXi grazing_mesh, grazing_pair, grazing_closes;
  std::string end;  // why the branch was followed no further
};

}  // namespace whine
