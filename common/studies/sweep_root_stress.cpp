#include "studies/sweep_root_stress.h"

#include <algorithm>
#include <vector>

#include "signal/branches.h"
#include "system/root_stress.h"

namespace whine {

using Eigen::Index;

namespace {

// Of one side of a mesh at one speed, into its columns; orbits shorter than the row repeat in it. instant: [sample] of the mesh.
void add_side(RootStresses& roots, const std::vector<MeshInstant>& instant, int side, Index m, Index speed,
              SweepResult& a) {
  const auto samples = static_cast<Index>(instant.size());
  const Index width = a.samples(), column = m * kSides + side, multiple = a.period_multiple[speed],
              orbit = multiple > 0 ? std::min<Index>(width, multiple * samples) : width;
  const auto loads = a.loads_of(speed, m);
  auto out = a.root_stress[static_cast<size_t>(speed)].col(column);
  std::vector<RootStress> along(static_cast<size_t>(width));
  for (Index n = 0; n < width; ++n) {
    RootStress& at = along[static_cast<size_t>(n)];
    const auto sample = static_cast<size_t>(n % samples);
    at = n < orbit ? roots.largest(side, sample, a.pair, loads.row(n).transpose(),
                                   instant[sample].period + static_cast<int>(n / samples))
                   : along[static_cast<size_t>(n - orbit)];
    out[n] = at.stress;
  }
  const auto top =
      static_cast<size_t>(sustained_row(out, static_cast<int>(samples), static_cast<int>(multiple)));
  a.root_stress_angle(speed, column) = along[top].angle;
  a.root_stress_phase(speed, column) = instant[top % instant.size()].phase + along[top].pair;
}

}  // namespace

void add_root_stress(const SystemModel& system, SweepResult& a) {
  const int samples = a.steps_per_period();
  const Index speeds = a.mesh_frequency.size(), columns = a.meshes() * kSides;
  for (Index m = 0; m < a.meshes(); ++m) {
    std::vector<MeshInstant> instant;
    std::vector<double> phases;
    instant.reserve(static_cast<size_t>(samples));
    phases.reserve(static_cast<size_t>(samples));
    for (int n = 0; n < samples; ++n) {
      instant.push_back(mesh_instant(system, static_cast<int>(m), static_cast<double>(n) / samples, 0));
      phases.push_back(instant.back().phase);
    }
    RootStresses roots(system.mesh[static_cast<size_t>(m)], phases);
    if (!roots.known()) continue;
    if (a.root_stress.empty()) {
      a.root_stress.assign(static_cast<size_t>(speeds), MatrixRM::Zero(a.samples(), columns));
      for (MatrixRM* x : {&a.root_stress_angle, &a.root_stress_phase}) x->setZero(speeds, columns);
    }
    for (int side = 0; side < kSides; ++side)
      for (Index f = 0; f < speeds; ++f) add_side(roots, instant, side, m, f, a);
  }
}

}  // namespace whine
