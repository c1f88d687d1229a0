// Samples as a WAV file: one channel, 24 bits, no dates.
#pragma once
#include <Eigen/Core>
#include <string>

namespace whine {

// The bytes of the file. signal: (sample) in shares of the full scale. Throws Error(input) for a sample beyond -1 to 1, which a
// file would clip, Error(numerical) if the library fails.
std::string wav_bytes(const Eigen::Ref<const Eigen::VectorXd>& signal, int rate);

}  // namespace whine
