// Where a response jumps, in words.
#pragma once
#include <Eigen/Core>
#include <string>

namespace whine {

// "1326.4 +- 0.1 Hz, 2575.3 +- 0.1 Hz", to the digits of the widths; "none".
std::string jump_words(const Eigen::VectorXd& frequency, const Eigen::VectorXd& width);

}  // namespace whine
