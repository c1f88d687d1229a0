#include "io/branch_codec.h"

#include "io/branch_parts.h"
#include "io/codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kBranchSchema{"branch", 6};

void describe_points(Codec& c, BranchResult& a) {
  c.dataset({"/mesh_frequency", "Hz", "mesh frequency along the branch", "point", kSpeed}, &a.mesh_frequency);
  c.dataset(
      {"/dte_rms", "m", "RMS of the oscillating part of the dynamic transmission error", "point", kSize},
      &a.dte_rms);
  c.dataset({"/dte_mean", "m", "mean of the dynamic transmission error", "point", kLength}, &a.dte_mean);
  c.dataset({"/dte_harmonic", "m", "amplitude of the harmonics 1, 2, ... of the mesh frequency",
             "point harmonic", kSize},
            &a.dte_harmonic);
  c.numbers("harmonic", 1, "number of the harmonic of the mesh frequency");
  c.dataset({"/mesh_force_sustained", "N",
             "largest normal force of all pairs together that is sustained for 1/64 of a mesh period",
             "point", kLoad},
            &a.mesh_force_sustained);
  c.dataset({"/tooth_load_sustained", "N", "the same of one pair", "point", kLoad}, &a.tooth_load_sustained);
  for (int g = 0; g < (c.lists() ? 1 : kSides); ++g)
    if (Eigen::VectorXd& stress = a.root_stress_sustained[static_cast<size_t>(g)];
        c.optional(of_body(c, a.mesh, g, "root_stress_sustained"), stress.size() > 0)) {
      c.dataset(
          {of_body(c, a.mesh, g, "root_stress_sustained"), "Pa",
           "the same of the tangential stress along the roots beside the loaded flanks, quasi-static in the tooth loads",
           "point", kStress},
          &stress);
      describe_root_place(c, a.mesh, g, "point", a.root_stress_angle, a.root_stress_phase);
    }
  describe_stability(c, a);
}

void describe_events(Codec& c, BranchResult& a) {
  describe_folds(c, a);
  c.dataset({"/grazing_frequency", "Hz", "mesh frequency at which the sequence of contacts changes",
             "grazing", kFrequency},
            &a.grazing_frequency);
  c.dataset({"/grazing_phase", "1", "mesh phase of the contact that comes or goes", "grazing", kShare},
            &a.grazing_phase);
  c.dataset({"/grazing_pair", "1", "its tooth pair", "grazing", kPair}, &a.grazing_pair);
  c.dataset({"/grazing_closes", "1", "1: it closes, 0: it opens", "grazing", kFlag}, &a.grazing_closes);
}

}  // namespace

void describe(Codec& c, BranchResult& a) {
  describe_pair(c, a);
  describe_motion(c, a);
  describe_torque(c, a.torque);
  describe_points(c, a);
  describe_events(c, a);
  c.dataset({"/end", "1", "why the branch was followed no further", ""}, &a.end);
}

void write(const std::string& path, const BranchResult& a, const Provenance& provenance) {
  write_artifact(path, kBranchSchema, "Branch of periodic orbits: " + pair_title(a.mesh, a.torque), a,
                 provenance);
}

BranchResult read_branch(const std::string& path) {
  return read_artifact<BranchResult>(path, kBranchSchema);
}

}  // namespace whine
