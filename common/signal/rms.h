// RMS of what of a signal oscillates: of the transmission error, of forces.
//
//   rms² = sum (x_j - mean)² / n = mean of x² - mean²
//
// over whole periods. Inline, so that it rounds as the layer that calls it.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace whine {

// Of samples in parts, one after the other.
inline double oscillating_rms(const std::vector<Eigen::Ref<const Eigen::VectorXd>>& parts) {
  double sum = 0, square = 0;
  Eigen::Index count = 0;
  for (const auto& part : parts) {
    sum += part.sum();
    count += part.size();
  }
  const double mean = sum / static_cast<double>(count);
  for (const auto& part : parts) square += (part.array() - mean).square().sum();
  return std::sqrt(square / static_cast<double>(count));
}

// Of the means of x and x².
inline double oscillating_rms(double mean, double mean_square) {
  return std::sqrt(std::max(0.0, mean_square - mean * mean));
}

// Of several signals, from the sums of x and x² over `count` samples.
inline Eigen::VectorXd oscillating_rms(const Eigen::VectorXd& sum, const Eigen::VectorXd& squares,
                                       double count) {
  return (squares / count - (sum / count).cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
}

}  // namespace whine
