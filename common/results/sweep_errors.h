// What refining one discretisation at a time changes in a sweep, and the error that follows.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "model/stages.h"
#include "results/motion_source.h"

namespace whine {

// sweep_errors.h5. Changes are of the sweep with the settings of the scene, relative to the refined one.
struct SweepErrorsResult : MotionSource {
  Direction direction = Direction::up;
  double natural_frequency = 0;    // Hz, of a pair: as in sweep.h5
  Eigen::VectorXd mesh_frequency;  // (speed) Hz: some of those of the scene, from end to end
  MatrixRM dte_rms;                // (speed, mesh) m
  MatrixRM tooth_load_max;         // (speed, mesh) N
  Eigen::VectorXd jump_frequency;  // (jump) Hz

  std::vector<std::string> entry;  // what was refined, and from which value to which: "steps 128 to 256"
  Eigen::VectorXd
      order;  // (entry) p, if the change of the RMS goes with the power p of the size that is refined; 0: none shows
  // [entry] (speed, mesh) 1; 0 where `compared` is 0
  std::vector<MatrixRM> dte_rms_change, tooth_load_change;
  // (entry, speed) 1: both motions repeat after as many periods and are on one branch; else 0, and there is no change to tell
  MatrixRMi compared;
  MatrixRM jump_change;  // (entry, jump) Hz; 0 where `jump_found` is 0
  MatrixRMi jump_found;  // (entry, jump) 1: the refined sweep jumps near by; else 0

  // The errors that follow: sum over the entries of |change| / (1 - 2^-p), or of |change| where no order shows.
  MatrixRM dte_rms_error, tooth_load_error;  // (speed, mesh) 1
  Eigen::VectorXd jump_error;                // (jump) Hz
};

}  // namespace whine
