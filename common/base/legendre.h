// Legendre polynomials over the face width: L_0 = 1, L_1 = t, (j + 1) L_j+1 = (2 j + 1) t L_j - j L_j-1.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace whine {

// (degree + 1) m^-1/2: P_j(z) = sqrt((2 j + 1) / b) L_j(2 z / b), orthonormal over -b/2 <= z <= b/2, b the face width. z, b: m.
inline Eigen::VectorXd face_polynomials(double z, double face_width, int degree) {
  const double t = 2 * z / face_width;
  Eigen::VectorXd value(degree + 1);
  double previous = 0, current = 1;
  for (int j = 0; j <= degree; ++j) {
    value[j] = std::sqrt((2 * j + 1) / face_width) * current;
    const double next = ((2 * j + 1) * t * current - j * previous) / (j + 1);
    previous = current;
    current = next;
  }
  return value;
}

// m-1: integral over the width of P_i P_j', the slope's polynomial second.
inline double value_times_slope(int i, int j, double face_width) {
  return j > i && (i + j) % 2 == 1 ? 2 / face_width * std::sqrt((2 * i + 1) * (2 * j + 1)) : 0;
}
// m-2: integral over the width of P_i' P_j'.
inline double slope_times_slope(int i, int j, double face_width) {
  const int least = std::min(i, j);
  return (i + j) % 2 == 0
             ? 2 / (face_width * face_width) * std::sqrt((2 * i + 1) * (2 * j + 1)) * least * (least + 1)
             : 0;
}

}  // namespace whine
