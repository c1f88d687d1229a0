#include "signal/jump_words.h"

#include <cmath>

#include "base/error.h"

namespace whine {

std::string jump_words(const Eigen::VectorXd& frequency, const Eigen::VectorXd& width) {
  std::string out;
  for (Eigen::Index j = 0; j < frequency.size(); ++j) {
    // To the digits of the width's first one, to 0.1 Hz at most.
    const double half = 0.5 * width[j];
    const int digits = half > 0 && half < 0.1 ? static_cast<int>(std::ceil(-std::log10(half))) : 1;
    const double unit = std::pow(10, digits), own = digits > 1 ? 10 * unit : 1;
    out += text(j ? ", " : "", std::round(frequency[j] * own) / own, " ± ", std::round(half * unit) / unit,
                " Hz");
  }
  return out.empty() ? "none" : out;
}

}  // namespace whine
