#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"
#include "io/system_motion_codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Range kRatio{-1, 1};

// Of a pair.
void describe_states(Codec& c, ContactStateDecays& a) {
  c(a.contact_state, "/contact_state", "contact_state",
    "of a pair: number of loaded tooth pairs, held amid the longest part of the period that has it; mean: over the whole period");
  if (c.in() && a.contact_state.size() < 2) c.in()->reject("/contact_state names no state");
  const std::string at = "/by_contact_state/";
  c(a.natural_frequency, at + "natural_frequency", "Hz", kFrequency, "contact_state",
    "frequency of the decay at the phase of the state, and the mean");
  c(a.damping_ratio, at + "damping_ratio", "1", kSigned, "contact_state", "damping ratio of that decay");
  c(a.undamped_frequency, at + "undamped_frequency", "Hz", kFrequency, "contact_state",
    "natural frequency with the contact frozen and no damping");
  c.axis("ring_down/mesh_phase", c.length("contact_state") - 1);
  c(a.mesh_phase, "/ring_down/mesh_phase", "1", kShare, "ring_down/mesh_phase",
    "mesh phase of the contact states, the mean left out");
  c(a.time, "/ring_down/time", "s", kTime, "ring_down/time", "time since the torque step was let go");
  c(a.transmission_error, "/ring_down/transmission_error", "m", kLength,
    "ring_down/mesh_phase ring_down/time", "transmission error less its static value",
    "r1 theta1 + r2 theta2");
}

void describe_modes(Codec& c, ImpactResult& a) {
  const char* const axes = "mesh_phase mode";
  c(a.mesh_phase, "/mesh_phase", "1", kPhase, "mesh_phase", "fixed mesh phase of the gears");
  c(a.loaded_pairs, "/loaded_pairs", "1", {0, 1000}, "mesh_phase mesh",
    "tooth pairs that carry load in static equilibrium");
  c(a.undamped_frequency, "/undamped_frequency", "Hz", kFrequency, axes,
    "natural frequency with the contact frozen and no damping: of a pair that of the mesh, of a train of its lowest modes");
  c(a.rayleigh_damping_ratio, "/rayleigh_damping_ratio", "1", kPositive, axes,
    "damping ratio of Rayleigh's damping alone at that frequency, as if it damped all that deforms",
    "(mu + eta w^2) / (2 w)");
  c(a.eigen_frequency, "/eigen_frequency", "Hz", kFrequency, axes,
    "frequency Im s / 2 pi of the eigenvalue with the contact frozen; 0: damped above critical");
  c(a.eigen_damping_ratio, "/eigen_damping_ratio", "1", kRatio, axes,
    "damping ratio -Re s / |s| of that eigenvalue");
  c(a.natural_frequency, "/natural_frequency", "Hz", kFrequency, axes,
    "frequency Im s / 2 pi of the decay (damped natural frequency): of a pair after a step of the torque, of a train after an impulse along the mode; 0: damped above critical");
  c(a.damping_ratio, "/damping_ratio", "1", kRatio, axes, "damping ratio -Re s / |s| of that decay");
  c(a.fit_residual, "/fit_residual", "1", {0, 1e300}, axes,
    "RMS of what no damped exponentials explain of the decay, over that of the decay");
  c(a.contact_changes, "/contact_changes", "1", kNumber, axes,
    "steps of the decay at which other contacts carry force than before");
  if (c.optional("/frozen_frequency", a.frozen_frequency.size() > 0))
    c(a.frozen_frequency, "/frozen_frequency", "Hz", kFrequency, "mesh_phase frozen_mode",
      "of a pair on bearings: lowest natural frequencies with the contact frozen and no damping, hubs on their bearings included");
}

}  // namespace

void describe(Codec& c, ImpactResult& a) {
  describe_source(c, a, false);
  describe_modes(c, a);
  c(a.rigid_frequency, "/rigid_frequency", "Hz", kFrequency, "rigid_mode",
    "natural frequencies of rigid gears on the mean stiffnesses of the meshes, free motions left out");
  if (c.lists() || a.of_train())
    c(a.impulse, "/parameters/impulse", "1", kShare, "",
      "root of the kinetic energy of the impulse over what the equilibrium stores");
  if (a.of_train()) return;
  describe_bearing_dampers(c, a.mean_stiffness, a.bearing_damper);
  c(a.torque_step, "/parameters/operation/torque_step", "1", kShare, "",
    "torque that is let go at the start of a decay, over the torque");
  describe_states(c, a.states);
  c(a.least_mesh_force, "/certificate/least_mesh_force", "1", kSigned, "",
    "of a pair: least mesh force of all decays over the static one; teeth part at 0");
}

std::string title(const ImpactResult& a) {
  if (a.of_train())
    return text("Ring-down of a system: ", a.body_names.size(), " bodies, ", a.mesh_names.size(), " meshes");
  return "Ring-down: " + pair_title(a.mesh, a.torque);
}

template struct ArtifactFile<ImpactResult>;

}  // namespace whine
