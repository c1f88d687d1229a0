// What friction between the flanks takes of a motion, per speed.
#pragma once
#include <Eigen/Core>

namespace whine {

// Of a pair with friction; of others all are empty.
struct FrictionLosses {
  Eigen::VectorXd coefficient;  // (speed) 1
  Eigen::VectorXd power;        // (speed) W: mean of mu s N v, the vibration in v
  Eigen::VectorXd efficiency;   // (speed) 1 - power / (torque times the mean speed of the driver)
};

}  // namespace whine
