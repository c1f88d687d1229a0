// What a response.h5 holds of a pair, which has one mesh.
#pragma once
#include <vector>

#include "base/matrix.h"

// [speed] (harmonic, mesh) of amplitudes (speed, harmonic).
inline std::vector<whine::MatrixRM> of_one_mesh(const whine::MatrixRM& amplitude) {
  std::vector<whine::MatrixRM> out;
  out.reserve(static_cast<size_t>(amplitude.rows()));
  for (const auto& row : amplitude.rowwise()) out.emplace_back(row.transpose());
  return out;
}
