// What friction between the flanks takes of a motion, per speed.
#pragma once
#include <Eigen/Core>

namespace whine {

// With friction; of others all are empty.
struct FrictionLosses {
  // (speed) 1; of a train the mean over its meshes, weighted with what friction takes in each
  Eigen::VectorXd coefficient;
  Eigen::VectorXd power;  // (speed) W: mean of mu s N v of all meshes, the vibration in v
  // (speed) 1 - power / sum of T omega > 0 of the drives at the mean speeds of their bodies on the ground, and of what holds a body
  // that turns there; of a pair torque times speed of the driver
  Eigen::VectorXd efficiency;
};

}  // namespace whine
