#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"
#include "io/branch_parts.h"
#include "io/system_motion_codec.h"

namespace whine {
namespace {

using namespace ranges;

void describe_points(Codec& c, SystemBranchResult& a) {
  const char* const of_mesh = "point mesh_number";
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, "point", "mesh frequency along the branch");
  c(a.dte_rms, "/dte_rms", "m", kSize, of_mesh,
    "RMS of the oscillating part of the dynamic transmission error of each mesh");
  c(a.dte_mean, "/dte_mean", "m", kLength, of_mesh, "mean of the dynamic transmission error of each mesh");
  c(a.mesh_force_max, "/mesh_force_max", "N", kForce, of_mesh,
    "largest torque on the driving body over its base radius");
  c(a.tooth_force_max, "/tooth_force_max", "N", kLoad, of_mesh, "largest normal force of one pair of teeth");
  c(a.separation_fraction, "/separation_fraction", "1", kShare, of_mesh,
    "share of the time steps at which no pair of the mesh carries force");
  c(a.bearing_force_rms, "/bearing_force_rms", "N", kLoad, "point body_number",
    "RMS of the oscillating part of the force of each body on its bearing, pin or axis");
  describe_stability(c, a);
}

}  // namespace

void describe(Codec& c, SystemBranchResult& a) {
  describe_system_motion(c, a.settings, a.torque, a.axis_frequency);
  describe_time_steps(c, a.settings.time);
  describe_points(c, a);
  describe_folds(c, a);
  c(a.end, "/end", "", "why the branch was followed no further");
}

std::string title(const SystemBranchResult& a) {
  return text("Branch of periodic orbits of a system: ", a.settings.layout.bodies.size(), " bodies, ",
              a.settings.layout.meshes.size(), " meshes");
}

template struct ArtifactFile<SystemBranchResult>;

}  // namespace whine
