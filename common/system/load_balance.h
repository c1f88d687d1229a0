// Torques of a system: which loads they put on its meshes, whether they are in balance, and what would bring them there.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/system.h"

namespace whine {

// Bodies that no drive holds.
std::vector<int> free_bodies(const System& layout);

// (body, mesh) 1: by how much a unit x = r theta of the body closes the mesh along its line of action; of a carrier by way of its
// planets' axes.
Eigen::MatrixXd closing_of(const System& layout);

// Whether the train can turn as a whole with all its meshes closed.
bool can_roll(const System& layout);

// The balance of torques alone: sum over the meshes of a free body of closing sign times load = T / r.
struct LoadBalance {
  Eigen::VectorXd load;  // (mesh) N, mean force along the line of action; below 0: pulled
  Eigen::VectorXd
      force;  // (body) N: T / r of free bodies that is in balance, unbalance of typed digits taken out
  bool balanced = true;   // no torque of a free body is left that no mesh carries, beyond kTypedDigits
  int pulled_apart = -1;  // the first mesh that would be; -1: none
};
// Torques that are unbalanced by less than this share of the largest T / r were typed with few digits: -466.6667 N m in place of
// -1400 / 3. What is left is taken out.
inline constexpr double kTypedDigits = 1e-6;
// Throws Error(input) if every body is held.
LoadBalance load_balance(const System& layout);

// What is wrong with torques that are not balanced and what to do, in the words of errors: the torque that would balance the others.
std::string unbalanced_words(const System& layout);
inline constexpr const char* kFlowOfPower =
    "name the gears in the order of the flow of power, or give torque_Nm the other sign";
inline constexpr const char* kNoTorque =
    "no drive of the system has a torque that a mesh carries; give one a torque_Nm above 0";

}  // namespace whine
