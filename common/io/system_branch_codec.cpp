#include "io/system_branch_codec.h"

#include "base/error.h"
#include "io/branch_parts.h"
#include "io/codec.h"
#include "io/system_sweep_codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kSystemBranchSchema{"system_branch", 2};

void describe_points(Codec& c, SystemBranchResult& a) {
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
  describe_stability(c, a);
}

}  // namespace

void describe(Codec& c, SystemBranchResult& a) {
  describe_system_motion(c, a.settings, a.torque, a.axis_frequency);
  describe_time_steps(c, a.settings.time);
  describe_points(c, a);
  describe_folds(c, a);
  c.dataset({"/end", "1", "why the branch was followed no further", ""}, &a.end);
}

void write(const std::string& path, const SystemBranchResult& a, const Provenance& provenance) {
  write_artifact(path, kSystemBranchSchema,
                 text("Branch of periodic orbits of a system: ", a.settings.layout.bodies.size(), " bodies, ",
                      a.settings.layout.meshes.size(), " meshes"),
                 a, provenance);
}

SystemBranchResult read_system_branch(const std::string& path) {
  return read_artifact<SystemBranchResult>(path, kSystemBranchSchema);
}

}  // namespace whine
