#include "io/system_impact_codec.h"

#include "base/error.h"
#include "io/codec.h"
#include "io/system_sweep_codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kSystemImpactSchema{"system_impact", 1};
constexpr Range kRatio{-1, 1};

}  // namespace

void describe(Codec& c, SystemImpactResult& a) {
  const char* const axes = "mesh_phase mode";
  describe_system_motion(c, a.settings, a.torque, a.axis_frequency);
  c.dataset({"/parameters/impulse", "1",
             "root of the kinetic energy of the impulse over what the equilibrium stores", "", kShare},
            &a.impulse);
  c.dataset(
      {"/rigid_frequency", "Hz",
       "natural frequencies of rigid gears on the mean stiffnesses of the meshes, free motions left out",
       "rigid_mode", kFrequency},
      &a.rigid_frequency);
  c.dataset({"/mesh_phase", "1", "mesh phase at which the gears stay", "mesh_phase", kPhase}, &a.mesh_phase);
  c.dataset({"/loaded_pairs", "1", "pairs of teeth that carry force", "mesh_phase mesh_number", kNumber},
            &a.loaded_pairs);
  c.dataset({"/undamped_frequency", "Hz", "natural frequency with contact frozen, without damping", axes,
             kFrequency},
            &a.undamped_frequency);
  c.dataset({"/rayleigh_damping_ratio", "1",
             "damping ratio of Rayleigh's damping alone at that frequency, as if it damped all that deforms",
             axes, kPositive, "(mu + eta w^2) / (2 w)"},
            &a.rayleigh_damping_ratio);
  c.dataset(
      {"/eigen_frequency", "Hz",
       "frequency of the damped eigenvalue with contact frozen; 0: damped above critical", axes, kFrequency},
      &a.eigen_frequency);
  c.dataset({"/eigen_damping_ratio", "1", "damping ratio of that eigenvalue", axes, kRatio},
            &a.eigen_damping_ratio);
  c.dataset(
      {"/natural_frequency", "Hz",
       "frequency of the decay after an impulse along the mode; 0: damped above critical", axes, kFrequency},
      &a.natural_frequency);
  c.dataset({"/damping_ratio", "1", "damping ratio of that decay", axes, kRatio}, &a.damping_ratio);
  c.dataset({"/fit_residual",
             "1",
             "RMS of what no damped exponentials explain of the decay, over that of the decay",
             axes,
             {0, 1e300}},
            &a.fit_residual);
  c.dataset({"/contact_changes", "1", "steps of the decay at which other pairs carry force than before", axes,
             kNumber},
            &a.contact_changes);
}

void write(const std::string& path, const SystemImpactResult& a, const Provenance& provenance) {
  write_artifact(path, kSystemImpactSchema,
                 text("Ring-down of a system: ", a.settings.layout.bodies.size(), " bodies, ",
                      a.settings.layout.meshes.size(), " meshes"),
                 a, provenance);
}

SystemImpactResult read_system_impact(const std::string& path) {
  return read_artifact<SystemImpactResult>(path, kSystemImpactSchema);
}

}  // namespace whine
