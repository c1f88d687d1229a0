#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"

namespace whine {
namespace {

using namespace ranges;

const char* const kDecayFrequency =
    "frequency Im s / 2 pi of the decaying transmission error (damped natural frequency)";
const char* const kDecayRatio = "damping ratio -Re s / |s| of the decaying transmission error";

void describe_states(Codec& c, ImpactResult& a) {
  c(a.contact_state, "/contact_state", "contact_state",
    "number of loaded tooth pairs, held amid the longest part of the period that has it; mean: over the whole period");
  if (c.in() && a.contact_state.size() < 2) c.in()->reject("/contact_state names no state");
  c(a.natural_frequency, "/natural_frequency", "Hz", kFrequency, "contact_state", kDecayFrequency);
  c(a.damping_ratio, "/damping_ratio", "1", kSigned, "contact_state", kDecayRatio);
  c(a.undamped_frequency, "/undamped_frequency", "Hz", kFrequency, "contact_state",
    "natural frequency with the contact frozen and no damping");
  c.axis("ring_down/mesh_phase", c.length("contact_state") - 1);
  c(a.state_phase, "/ring_down/mesh_phase", "1", kShare, "ring_down/mesh_phase",
    "mesh phase of the contact states, the mean left out");
  c(a.time, "/ring_down/time", "s", kTime, "ring_down/time", "time since the torque step was let go");
  c(a.transmission_error, "/ring_down/transmission_error", "m", kLength,
    "ring_down/mesh_phase ring_down/time", "transmission error less its static value",
    "r1 theta1 + r2 theta2");
}

void describe_phases(Codec& c, ImpactResult& a) {
  const std::string at = "/by_phase/";
  c(a.mesh_phase, "/mesh_phase", "1", kPhase, "mesh_phase", "fixed mesh phase of the gears");
  c(a.loaded_pairs, at + "loaded_pairs", "1", {0, 1000}, "mesh_phase",
    "tooth pairs that carry load in static equilibrium");
  c(a.phase_natural_frequency, at + "natural_frequency", "Hz", kFrequency, "mesh_phase", kDecayFrequency);
  c(a.phase_damping_ratio, at + "damping_ratio", "1", kSigned, "mesh_phase", kDecayRatio);
  c(a.phase_undamped_frequency, at + "undamped_frequency", "Hz", kFrequency, "mesh_phase",
    "natural frequency with the contact frozen and no damping");
  c(a.eigen_frequency, at + "eigen_frequency", "Hz", kFrequency, "mesh_phase",
    "frequency Im s / 2 pi of the eigenvalue with the contact frozen");
  c(a.eigen_damping_ratio, at + "eigen_damping_ratio", "1", kSigned, "mesh_phase",
    "damping ratio -Re s / |s| of the eigenvalue with the contact frozen");
  c(a.fit_residual, at + "fit_residual", "1", kPositive, "mesh_phase",
    "RMS of decay less fit over RMS of decay");
  if (c.optional(at + "frozen_frequency", a.frozen_frequency.size() > 0))
    c(a.frozen_frequency, at + "frozen_frequency", "Hz", kFrequency, "mesh_phase mode",
      "lowest natural frequencies with the contact frozen and no damping, hubs on their bearings included");
}

}  // namespace

void describe(Codec& c, ImpactResult& a) {
  describe_pair(c, a);
  describe_motion(c, a, false);
  describe_bearing_dampers(c, a.mean_stiffness, a.bearing_damper);
  describe_torque(c, a.torque);
  c(a.torque_step, "/parameters/operation/torque_step", "1", kShare, "",
    "torque that is let go at the start of a decay, over the torque");
  describe_states(c, a);
  describe_phases(c, a);
  c(a.least_mesh_force, "/certificate/least_mesh_force", "1", kSigned, "",
    "least mesh force of all decays over the static one; teeth part at 0");
}

std::string title(const ImpactResult& a) {
  return "Ring-down: " + pair_title(a.mesh, a.torque);
}

template struct ArtifactFile<ImpactResult>;

}  // namespace whine
