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
  // A quantity over speed: (speed, mesh).
  struct Judged {
    MatrixRM value;                // m, N
    std::vector<MatrixRM> change;  // [entry] 1; 0 where `compared` is 0
    MatrixRM error;  // 1: sum over the entries of |change| / (1 - 2^-p), or of |change| where no order shows
  };

  Direction direction = Direction::up;
  double natural_frequency = 0;    // Hz, of a pair: as in sweep.h5
  Eigen::VectorXd mesh_frequency;  // (speed) Hz: some of those of the scene, from end to end
  // RMS and first order of the dynamic transmission error; largest load of a tooth pair and of a mesh; the former as it is sustained for
  // 1/64 of a mesh period, 0 where it is not known.
  Judged dte_rms, dte_first_order, tooth_load_max, tooth_load_sustained, mesh_force_max;
  Eigen::VectorXd jump_frequency;  // (jump) Hz

  std::vector<std::string> entry;  // what was refined, and from which value to which: "steps 128 to 256"
  Eigen::VectorXd
      order;  // (entry) p, if the change of the RMS goes with the power p of the size that is refined; 0: none shows
  // (entry, speed) 1: both motions repeat after as many periods and are on one branch; else 0, and there is no change to tell
  MatrixRMi compared;
  MatrixRM jump_change;  // (entry, jump) Hz; 0 where `jump_found` is 0
  MatrixRMi jump_found;  // (entry, jump) 1: the refined sweep jumps near by; else 0

  Eigen::VectorXd jump_error;                // (jump) Hz, of the changes as of Judged::error
  Eigen::VectorXd natural_frequency_change;  // (entry) 1; 0 of a train
  double natural_frequency_error = 0;        // 1
};

}  // namespace whine
