#include "io/artifacts.h"

#include "io/artifact_file.h"
#include "io/branch_parts.h"

namespace whine {
namespace {

using namespace ranges;

void describe_points(Codec& c, BranchResult& a) {
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, "point", "mesh frequency along the branch");
  c(a.dte_rms, "/dte_rms", "m", kSize, "point",
    "RMS of the oscillating part of the dynamic transmission error");
  c(a.dte_mean, "/dte_mean", "m", kLength, "point", "mean of the dynamic transmission error");
  c(a.dte_harmonic, "/dte_harmonic", "m", kSize, "point harmonic",
    "amplitude of the harmonics 1, 2, ... of the mesh frequency");
  c.numbers("harmonic", 1, "number of the harmonic of the mesh frequency");
  c(a.mesh_force_sustained, "/mesh_force_sustained", "N", kLoad, "point",
    "largest normal force of all pairs together that is sustained for 1/64 of a mesh period");
  c(a.tooth_load_sustained, "/tooth_load_sustained", "N", kLoad, "point", "the same of one pair");
  for (int g = 0; g < (c.lists() ? 1 : kSides); ++g)
    if (Eigen::VectorXd& stress = a.root_stress_sustained[static_cast<size_t>(g)];
        c.optional(of_body(c, a.mesh, g, "root_stress_sustained"), stress.size() > 0)) {
      c(stress, of_body(c, a.mesh, g, "root_stress_sustained"), "Pa", kStress, "point",
        "the same of the tangential stress along the roots beside the loaded flanks, quasi-static in the tooth loads");
      const auto gear = static_cast<size_t>(g);
      describe_root_place(c, of_body(c, a.mesh, g, "root_stress_angle"), a.root_stress_angle[gear],
                          of_body(c, a.mesh, g, "root_stress_phase"), a.root_stress_phase[gear], "point");
    }
  describe_stability(c, a);
}

}  // namespace

void describe(Codec& c, BranchResult& a) {
  describe_pair(c, a);
  describe_motion(c, a);
  describe_torque(c, a.torque);
  describe_points(c, a);
  describe_folds(c, a);
  c(a.end, "/end", "", "why the branch was followed no further");
}

std::string title(const BranchResult& a) {
  return "Branch of periodic orbits: " + pair_title(a.mesh, a.torque);
}

template struct ArtifactFile<BranchResult>;

}  // namespace whine
