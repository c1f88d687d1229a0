#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"
#include "io/keys.h"
#include "io/system_motion_codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr const char* kSpeeds = "mesh_frequency";
constexpr const char* kOfMesh = "mesh_frequency mesh";
constexpr const char* kOfBody = "mesh_frequency body";

// Flank pressure and what tip edges carry.
void describe_pressure(Codec& c, ResponseResult& a) {
  if (!c.optional("/flank_pressure", a.flank_pressure.size() > 0)) return;
  c(a.pair_phase, "/pair_phase", "1", kSigned, "pair_phase",
    "places of the flanks by the phase of the pair that touches there, in mesh periods from the pitch point");
  c(a.flank_roll, "/flank_roll", "rad", kRoll, "pair_phase gear", "roll angles of both gears there");
  c(a.flank_pressure, "/flank_pressure", "Pa", kPressure, "mesh_frequency pair_phase",
    "largest pressure over the mesh periods at a place of the flanks, by Hertz's law of the load that a pair holds there inside its flanks; 0: it holds none, or over a tip edge, where pressure is singular: see edge_load_there",
    "sqrt(F E* / (pi b R))");
  c(a.edge_load_there, "/edge_load_there", "N", kLoad, "mesh_frequency pair_phase",
    "largest load over the mesh periods that a pair holds at a place of the flanks over a tip edge; 0: it holds none, or inside its flanks: see flank_pressure");
  c(a.flank_pressure_sustained, "/flank_pressure_sustained", "Pa", kPressure, kSpeeds,
    "largest pressure that a pair sustains inside its flanks for 1/64 of a mesh period; 0: no pair holds load there");
  c(a.edge_load, "/edge_load", "N", kLoad, kOfBody,
    "largest load that a pair sustains over the tip edge of the gear for 1/64 of a mesh period; 0: no pair does");
}

void describe_vibration(Codec& c, ResponseResult& a) {
  c(a.dte_rms, "/dte_rms", "m", kSize, kOfMesh,
    "RMS of the oscillating part of the dynamic transmission error");
  c(a.dte_mean, "/dte_mean", "m", kLength, kOfMesh, "mean of the dynamic transmission error");
  c(a.dte_harmonic, "/dte_harmonic", "m", kSize, "mesh_frequency harmonic mesh",
    "amplitude of the harmonics 1, 2, ... of the mesh frequency");
  c.numbers("harmonic", 1, "number of the harmonic of the mesh frequency");
  describe_hunting(c, a.hunting_periods);
  if (!c.lists() && a.hunting_periods == 1) return;
  c(a.dte_order, "/dte_order", "m", kSize, "mesh_frequency order mesh",
    "amplitude of the harmonics 1, 2, ... of the hunting frequency");
  c.numbers("order", 1, "number of the harmonic of the hunting frequency");
  c(a.residual_rms, "/residual_rms", "m", kSize, kOfMesh,
    "RMS of the residual signal: the dynamic transmission error less the mean of its mesh periods, without mesh harmonics");
  c(a.residual_kurtosis, "/residual_kurtosis", "1", kPositive, kOfMesh,
    "kurtosis of the residual signal: 3 of noise, the more the fewer teeth make it",
    "mean of y^4 / (mean of y^2)^2");
}

void describe_loads(Codec& c, ResponseResult& a) {
  c(a.tooth_load_max, "/tooth_load_max", "N", kLoad, kOfMesh, "largest normal force of one tooth pair");
  c(a.mesh_force_max, "/mesh_force_max", "N", kLoad, kOfMesh,
    "largest normal force of all pairs together; of trains largest torque on the driving body over its base radius");
  if (c.optional("/mesh_force_harmonic", !a.mesh_force_harmonic.empty()))
    c(a.mesh_force_harmonic, "/mesh_force_harmonic", "N", kLoad, "mesh_frequency harmonic mesh",
      "amplitude of the harmonics 1, 2, ... of the mesh frequency in the mesh force");
  if (c.optional("/load_share_max", a.load_share_max.size() > 0))
    c(a.load_share_max, "/load_share_max", "1", kShare, kOfMesh,
      "largest share, at one instant, of the meshes that come from one [[mesh]]: of planets the load sharing; left out where no [[mesh]] has several");
  if (c.optional("/bearing_force_max", a.bearing_force_max.size() > 0)) {
    c(a.bearing_force_max, "/bearing_force_max", "N", kLoad, kOfBody,
      "largest force of the body on its bearing, pin or axis; 0 of a gear of a pair whose bearing is rigid");
    c(a.bearing_force_rms, "/bearing_force_rms", "N", kLoad, kOfBody,
      "RMS of the oscillating part of that force, x and y together");
  }
  if (c.optional("/bearing_force_harmonic", !a.bearing_force_harmonic.empty()))
    c(a.bearing_force_harmonic, "/bearing_force_harmonic", "N", kLoad, "mesh_frequency harmonic body",
      "amplitude of the harmonics 1, 2, ... of the mesh frequency in the force on the bearing, x and y together",
      "sqrt(x^2 + y^2)");
  if (c.optional("/root_stress_max", a.root_stress_max.size() > 0)) {
    const std::string side = "mesh_frequency mesh side";
    c(a.root_stress_max, "/root_stress_max", "Pa", kStress, side,
      "largest tangential stress along the roots beside the loaded flanks under the loads of the mesh, quasi-static in them: the inertia of the body adds none; 0 of a mesh of which it is not known");
    c(a.root_stress_sustained, "/root_stress_sustained", "Pa", kStress, side,
      "the same, sustained for 1/64 of a mesh period: without spikes whose height depends on the time step");
    c(a.root_stress_angle, "/root_stress_angle", "1", kRoll, side, kRootAngle);
    c(a.root_stress_phase, "/root_stress_phase", "1", kPlace, side, kRootPhase);
  }
  if (c.optional("/tooth_load_sustained", a.tooth_load_sustained.size() > 0)) {
    c(a.tooth_load_sustained, "/tooth_load_sustained", "N", kLoad, kOfMesh,
      "largest normal force that one pair sustains for 1/64 of a mesh period");
    c(a.mesh_force_sustained, "/mesh_force_sustained", "N", kLoad, kOfMesh, "the same of all pairs together");
  }
}

}  // namespace

void describe(Codec& c, ResponseResult& a) {
  describe_source(c, a);
  if (!a.of_train()) {
    describe_model(c, a.model, "finite elements, or the name of a lumped model");
    describe_natural_frequency(c, a.natural_frequency);
  }
  c(a.direction, "/parameters/operation/direction", "", "direction in which the speeds are run through");
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, kSpeeds,
    "mesh frequency, in the order in which they were computed");
  describe_vibration(c, a);
  describe_loads(c, a);
  describe_face_load(c, a.face_load_factor, a.line_load_max);
  if (c.optional("/loss_factor", a.loss_factor.size() > 0))
    c(a.loss_factor, "/loss_factor", "1", kPositive, kSpeeds,
      "mean power lost by sliding over the power carried, per unit coefficient of friction");
  describe_pressure(c, a);
  describe_friction(c, a.friction);
  c(a.separation_fraction, "/separation_fraction", "1", kShare, kOfMesh, "share of the period without force");
  c(a.separations_per_period, "/separations_per_period", "1", kPositive, kOfMesh,
    "losses of contact per mesh period");
  c(a.jump_frequency, "/jump_frequency", "Hz", kFrequency, "jump",
    "middle of the interval in which the response jumps");
  c(a.jump_width, "/jump_width", "Hz", kFrequency, "jump",
    "width of the interval in which the response jumps");
  c(a.periods, "/periods", "1", kNumber, kSpeeds, "mesh periods run to steady state");
  c(a.period_multiple, "/period_multiple", "1", kMultiple, kSpeeds,
    "mesh periods after which the motion repeats; 0: not periodic within the limit");
  c(a.energy_imbalance, "/energy_imbalance", "1", {-1e300, 1e300}, kSpeeds,
    "energy not accounted for, relative to the throughput of the stored periods");
  describe_backlash_left(c, a.backlash_left);
  describe_remarks(c, a.remarks);
  if (c.in() && a.mesh_frequency.size() == 0) c.in()->reject("dataset /mesh_frequency holds no speed");
}

std::string title(const ResponseResult& a) {
  if (a.of_train())
    return text("Response, sweep ", a.direction, " of a system: ", a.body_names.size(), " bodies, ",
                a.mesh_names.size(), " meshes");
  return text("Response, sweep ", a.direction, ": ", pair_title(a.mesh, a.torque));
}

template struct ArtifactFile<ResponseResult>;

}  // namespace whine
