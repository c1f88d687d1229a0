// Sounds of motions and of run-ups, one for each branch, with the table of their levels.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "io/sound_inputs.h"
#include "signal/sound.h"

namespace whine {

inline constexpr int kSoundRate = 48000;  // Hz

struct Sounds {
  std::vector<Eigen::VectorXd> sounds;  // [branch] (sample) N, or what the transfer function makes of it
  int rate = kSoundRate;                // Hz
  std::string table;                    // TSV
};

// Of sweep.h5 at one speed (Hz), `seconds` of each: RMS and level of each branch, and how far it is above the first. transfer:
// nullptr: 1. force and errors: as heard_motion; Error(input) for a branch of which nothing is heard.
Sounds sounds_of_motions(const std::vector<std::string>& paths, double mesh_frequency,
                         const HeardForce& force, const Transfer* transfer, double seconds);

// Of runup.h5: levels in bands of the mesh frequency that all of them pass, and how far they are above the first. Errors as
// heard_runup, and Error(input) for run-ups of different sample rates, without a common speed or of less than 2 ms over the common
// ones. 100 bands, of short run-ups as many as have 2 ms each.
Sounds sounds_of_runups(const std::vector<std::string>& paths, const HeardForce& force,
                        const Transfer* transfer);

}  // namespace whine
