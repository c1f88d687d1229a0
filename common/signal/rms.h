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

#include "base/matrix.h"

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

// Of a vector, (sample, component): of its components together.
inline double oscillating_vector_rms(const Eigen::Ref<const MatrixRM>& vector) {
  return std::sqrt((vector.rowwise() - vector.colwise().mean()).rowwise().squaredNorm().mean());
}

}  // namespace whine
