#include "signal/mode_excitation.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace whine {

double excitation_left(const ModesResult& modes, Eigen::Index mode, int order,
                       const std::vector<size_t>& meshes) {
  std::complex<double> sum = 0;
  for (const size_t m : meshes)
    sum += std::polar(1.0, 2 * std::numbers::pi * order * modes.layout.meshes[m].phase) *
           modes.mesh_deflection(mode, static_cast<Eigen::Index>(m));
  const double all = modes.mesh_deflection.row(mode).cwiseAbs().sum();
  return all > 0 ? std::abs(sum) / all : 0;
}

}  // namespace whine
