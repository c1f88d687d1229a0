#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"
#include "io/system_motion_codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Range kRatio{-1, 1};

}  // namespace

void describe(Codec& c, SystemImpactResult& a) {
  const char* const axes = "mesh_phase mode";
  describe_system_motion(c, a.settings, a.torque, a.axis_frequency);
  c(a.impulse, "/parameters/impulse", "1", kShare, "",
    "root of the kinetic energy of the impulse over what the equilibrium stores");
  c(a.rigid_frequency, "/rigid_frequency", "Hz", kFrequency, "rigid_mode",
    "natural frequencies of rigid gears on the mean stiffnesses of the meshes, free motions left out");
  c(a.mesh_phase, "/mesh_phase", "1", kPhase, "mesh_phase", "mesh phase at which the gears stay");
  c(a.loaded_pairs, "/loaded_pairs", "1", kNumber, "mesh_phase mesh_number",
    "pairs of teeth that carry force");
  c(a.undamped_frequency, "/undamped_frequency", "Hz", kFrequency, axes,
    "natural frequency with contact frozen, without damping");
  c(a.rayleigh_damping_ratio, "/rayleigh_damping_ratio", "1", kPositive, axes,
    "damping ratio of Rayleigh's damping alone at that frequency, as if it damped all that deforms",
    "(mu + eta w^2) / (2 w)");
  c(a.eigen_frequency, "/eigen_frequency", "Hz", kFrequency, axes,
    "frequency of the damped eigenvalue with contact frozen; 0: damped above critical");
  c(a.eigen_damping_ratio, "/eigen_damping_ratio", "1", kRatio, axes, "damping ratio of that eigenvalue");
  c(a.natural_frequency, "/natural_frequency", "Hz", kFrequency, axes,
    "frequency of the decay after an impulse along the mode; 0: damped above critical");
  c(a.damping_ratio, "/damping_ratio", "1", kRatio, axes, "damping ratio of that decay");
  c(a.fit_residual, "/fit_residual", "1", {0, 1e300}, axes,
    "RMS of what no damped exponentials explain of the decay, over that of the decay");
  c(a.contact_changes, "/contact_changes", "1", kNumber, axes,
    "steps of the decay at which other pairs carry force than before");
}

std::string title(const SystemImpactResult& a) {
  return text("Ring-down of a system: ", a.settings.layout.bodies.size(), " bodies, ",
              a.settings.layout.meshes.size(), " meshes");
}

template struct ArtifactFile<SystemImpactResult>;

}  // namespace whine
