// What is heard of artifacts: forces of periodic motions and of run-ups.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "signal/sound.h"

namespace whine {

// Throws Error(input) for an artifact that is stale or lies where another belongs (require_fresh), Error(usage) for one that is given
// twice.
void require_sound_inputs(const std::vector<std::string>& paths);

// Which force is heard: the mesh force of the first mesh unless one of these is given.
struct HeardForce {
  std::string mesh;     // "sun-planet1"
  std::string bearing;  // "<body>:x" or "<body>:y" of a body whose force on its bearing the artifact holds
};

// One whole period of a motion.
struct HeardMotion {
  std::string name;        // direction of its sweep
  std::string force;       // "mesh force of sun-planet1"
  double fundamental;      // Hz
  Eigen::VectorXd record;  // (sample) N
};

// A sweep of a pair or of a train at one of its speeds (Hz). Throws Error(input) for a speed that the sweep does not have or a motion
// that is not periodic, Error(usage) for a mesh or a bearing that there is not.
HeardMotion heard_motion(const std::string& path, double mesh_frequency, const HeardForce& force);

struct HeardRunup {
  std::string name;                        // direction of its ramp
  std::string force;                       // as that of a motion
  int rate;                                // Hz of the samples
  Eigen::VectorXd mesh_frequency, record;  // (sample) Hz, N
};

// runup.h5. Throws Error(input) for a sample rate that is no whole number, else as heard_motion.
HeardRunup heard_runup(const std::string& path, const HeardForce& force);

// Names that occur several times get numbers in their order: up_1, up_2.
void number_names(const std::vector<std::string*>& names);

}  // namespace whine
