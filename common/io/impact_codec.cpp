#include "io/impact_codec.h"

#include "base/error.h"
#include "io/codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kImpactSchema{"impact", 1};

const char* const kDecayFrequency =
    "frequency Im s / 2 pi of the decaying transmission error (damped natural frequency)";
const char* const kDecayRatio = "damping ratio -Re s / |s| of the decaying transmission error";

void describe_states(Codec& c, ImpactResult& a) {
  c.column_of_choices(
      {"/contact_state", "1",
       "number of loaded tooth pairs, held amid the longest part of the period that has it; mean: over the whole period",
       "contact_state"},
      a.contact_state);
  if (c.in() && a.contact_state.size() < 2) c.in()->file().reject("/contact_state names no state");
  c.dataset({"/natural_frequency", "Hz", kDecayFrequency, "contact_state", kFrequency}, &a.natural_frequency);
  c.dataset({"/damping_ratio", "1", kDecayRatio, "contact_state", kSigned}, &a.damping_ratio);
  c.dataset({"/undamped_frequency", "Hz", "natural frequency with the contact frozen and no damping",
             "contact_state", kFrequency},
            &a.undamped_frequency);
  c.axis("ring_down/mesh_phase", c.length("contact_state") - 1);
  c.dataset({"/ring_down/mesh_phase", "1", "mesh phase of the contact states, the mean left out",
             "ring_down/mesh_phase", kShare},
            &a.state_phase);
  c.dataset({"/ring_down/time", "s", "time since the torque step was let go", "ring_down/time", kTime},
            &a.time);
  c.dataset({"/ring_down/transmission_error", "m", "transmission error less its static value",
             "ring_down/mesh_phase ring_down/time", kLength, "r1 theta1 + r2 theta2"},
            &a.transmission_error);
}

void describe_phases(Codec& c, ImpactResult& a) {
  const std::string at = "/by_phase/";
  c.dataset({"/mesh_phase", "1", "fixed mesh phase of the gears", "mesh_phase", kPhase}, &a.mesh_phase);
  c.dataset({at + "loaded_pairs",
             "1",
             "tooth pairs that carry load in static equilibrium",
             "mesh_phase",
             {0, 1000}},
            &a.loaded_pairs);
  c.dataset({at + "natural_frequency", "Hz", kDecayFrequency, "mesh_phase", kFrequency},
            &a.phase_natural_frequency);
  c.dataset({at + "damping_ratio", "1", kDecayRatio, "mesh_phase", kSigned}, &a.phase_damping_ratio);
  c.dataset({at + "undamped_frequency", "Hz", "natural frequency with the contact frozen and no damping",
             "mesh_phase", kFrequency},
            &a.phase_undamped_frequency);
  c.dataset({at + "eigen_frequency", "Hz", "frequency Im s / 2 pi of the eigenvalue with the contact frozen",
             "mesh_phase", kFrequency},
            &a.eigen_frequency);
  c.dataset({at + "eigen_damping_ratio", "1",
             "damping ratio -Re s / |s| of the eigenvalue with the contact frozen", "mesh_phase", kSigned},
            &a.eigen_damping_ratio);
  c.dataset({at + "fit_residual", "1", "RMS of decay less fit over RMS of decay", "mesh_phase", kPositive},
            &a.fit_residual);
  if (c.optional(at + "frozen_frequency", a.frozen_frequency.size() > 0))
    c.dataset(
        {at + "frozen_frequency", "Hz",
         "lowest natural frequencies with the contact frozen and no damping, hubs on their bearings included",
         "mesh_phase mode", kFrequency},
        &a.frozen_frequency);
}

}  // namespace

void describe(Codec& c, ImpactResult& a) {
  describe_pair(c, a);
  describe_motion(c, a, false);
  describe_bearing_dampers(c, a.mean_stiffness, a.bearing_damper);
  describe_torque(c, a.torque);
  c.dataset({"/parameters/operation/torque_step", "1",
             "torque that is let go at the start of a decay, over the torque", "", kShare},
            &a.torque_step);
  describe_states(c, a);
  describe_phases(c, a);
  c.dataset({"/certificate/least_mesh_force", "1",
             "least mesh force of all decays over the static one; teeth part at 0", "", kSigned},
            &a.least_mesh_force);
}

void write(const std::string& path, const ImpactResult& a, const Provenance& provenance) {
  write_artifact(path, kImpactSchema, "Ring-down: " + pair_title(a.mesh, a.torque), a, provenance);
}

ImpactResult read_impact(const std::string& path) {
  return read_artifact<ImpactResult>(path, kImpactSchema);
}

}  // namespace whine
