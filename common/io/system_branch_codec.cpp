#include "io/system_branch_codec.h"

#include "base/error.h"
#include "io/codec.h"
#include "io/system_sweep_codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kSchema{"system_branch", 1};

void describe_points(Codec& c, SystemBranchArtifact& a) {
  const char* const of_mesh = "point mesh_number";
  c.dataset({"/mesh_frequency", "Hz", "mesh frequency along the branch", "point", kSpeed}, &a.mesh_frequency);
  c.dataset({"/dte_rms", "m", "RMS of the oscillating part of the dynamic transmission error of each mesh",
             of_mesh, kSize},
            &a.dte_rms);
  c.dataset({"/dte_mean", "m", "mean of the dynamic transmission error of each mesh", of_mesh, kLength},
            &a.dte_mean);
  c.dataset(
      {"/mesh_force_max", "N", "largest torque on the driving body over its base radius", of_mesh, kForce},
      &a.mesh_force_max);
  c.dataset({"/tooth_force_max", "N", "largest normal force of one pair of teeth", of_mesh, kLoad},
            &a.tooth_force_max);
  c.dataset({"/separation_fraction", "1",
             "share of the time steps at which no pair of the mesh carries force", of_mesh, kShare},
            &a.separation_fraction);
  c.dataset({"/bearing_force_rms", "N",
             "RMS of the oscillating part of the force of each body on its bearing, pin or axis",
             "point body_number", kLoad},
            &a.bearing_force_rms);
  c.dataset({"/floquet_multiplier", "1",
             "multipliers over the orbit, largest modulus first: real and imaginary part",
             "point multiplier part", kMultiplier},
            &a.floquet_multiplier);
  c.dataset({"/stable", "1", "1: all multipliers lie inside the unit circle", "point", kFlag}, &a.stable);
  c.dataset({"/steps", "1", "time steps per mesh period", "point", kNumber}, &a.steps);
  c.dataset({"/residual", "1", "relative change of the state over the orbit", "point", {0, 1e300}},
            &a.residual);
  c.dataset({"/segment_mismatch", "1", "relative change of the orbit where the number of steps changes",
             "segment", kPositive},
            &a.segment_mismatch);
}

}  // namespace

void describe(Codec& c, SystemBranchArtifact& a) {
  describe_system_motion(c, a.settings, a.torque, a.axis_frequency);
  describe_time_steps(c, a.settings.time);
  describe_points(c, a);
  c.dataset({"/fold_frequency", "Hz", "mesh frequency at which the branch turns", "fold", kFrequency},
            &a.fold_frequency);
  c.dataset({"/fold_smooth", "1", "1: a multiplier is 1 there; 0: at a kink, where contacts of a step change",
             "fold", kFlag},
            &a.fold_smooth);
  c.dataset({"/fold_multiplier", "1", "real multiplier nearest to 1, before and after the fold", "fold side",
             kMultiplier},
            &a.fold_multiplier);
  c.dataset({"/flip_frequency", "Hz", "mesh frequency at which a multiplier passes -1", "flip", kFrequency},
            &a.flip_frequency);
  c.dataset(
      {"/torus_frequency", "Hz",
       "mesh frequency at which the modulus of a complex pair of multipliers passes 1", "torus", kFrequency},
      &a.torus_frequency);
  c.dataset({"/end", "1", "why the branch was followed no further", ""}, &a.end);
}

void write(const std::string& path, const SystemBranchArtifact& a, const Provenance& provenance) {
  write_artifact(path, kSchema,
                 text("Branch of periodic orbits of a system: ", a.settings.layout.bodies.size(), " bodies, ",
                      a.settings.layout.meshes.size(), " meshes"),
                 a, provenance);
}

SystemBranchArtifact read_system_branch(const std::string& path) {
  return read_artifact<SystemBranchArtifact>(path, kSchema);
}

}  // namespace whine
