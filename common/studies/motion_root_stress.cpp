#include "studies/motion_root_stress.h"

#include <algorithm>

#include "signal/branches.h"

namespace whine {

using Eigen::Index;

namespace {

std::vector<MeshInstant> instants(const SystemModel& system, Index mesh, int samples) {
  std::vector<MeshInstant> out;
  out.reserve(static_cast<size_t>(samples));
  for (int n = 0; n < samples; ++n)
    out.push_back(mesh_instant(system, static_cast<int>(mesh), static_cast<double>(n) / samples, 0));
  return out;
}

std::vector<double> phases(const std::vector<MeshInstant>& instants) {
  std::vector<double> out;
  out.reserve(instants.size());
  for (const MeshInstant& instant : instants) out.push_back(instant.phase);
  return out;
}

// Of one side of a mesh at one speed, into its columns; orbits shorter than the row repeat in it.
void add_side(MotionRootStress& roots, int side, Index m, Index speed, SweepResult& a) {
  const int samples = a.time.steps_per_period;
  const Index width = a.samples(), column = m * kSides + side, multiple = a.period_multiple[speed],
              orbit = multiple > 0 ? std::min<Index>(width, multiple * samples) : width;
  const auto loads = a.loads_of(speed, m);
  auto out = a.root_stress[static_cast<size_t>(speed)].col(column);
  std::vector<RootStress> along(static_cast<size_t>(width));
  for (Index n = 0; n < width; ++n) {
    RootStress& at = along[static_cast<size_t>(n)];
    at = n < orbit ? roots.largest(side, n, a.pair, loads.row(n).transpose())
                   : along[static_cast<size_t>(n - orbit)];
    out[n] = at.stress;
  }
  const Index top = sustained_row(out, samples, static_cast<int>(multiple));
  a.root_stress_angle(speed, column) = along[static_cast<size_t>(top)].angle;
  a.root_stress_phase(speed, column) = roots.phase(top, along[static_cast<size_t>(top)]);
}

}  // namespace

MotionRootStress::MotionRootStress(const SystemModel& system, Index mesh, int samples)
    : instant_(instants(system, mesh, samples)),
      roots_(system.mesh[static_cast<size_t>(mesh)], phases(instant_)),
      known_(system.face.empty() && roots_.known()) {}

RootStress MotionRootStress::largest(int side, Index sample, const Eigen::VectorXi& numbers,
                                     const Eigen::Ref<const Eigen::VectorXd>& load) {
  const auto period = static_cast<int>(sample / static_cast<Index>(instant_.size()));
  return roots_.largest(side, at(sample), numbers, load, ahead(sample) + period);
}

void add_root_stress(const SystemModel& system, SweepResult& a) {
  const Index speeds = a.mesh_frequency.size(), columns = a.meshes() * kSides;
  for (Index m = 0; m < a.meshes(); ++m) {
    MotionRootStress roots(system, m, a.time.steps_per_period);
    if (!roots.known()) continue;
    if (a.root_stress.empty()) {
      a.root_stress.assign(static_cast<size_t>(speeds), MatrixRM::Zero(a.samples(), columns));
      for (MatrixRM* x : {&a.root_stress_angle, &a.root_stress_phase}) x->setZero(speeds, columns);
    }
    for (int side = 0; side < kSides; ++side)
      for (Index f = 0; f < speeds; ++f) add_side(roots, side, m, f, a);
  }
}

}  // namespace whine
