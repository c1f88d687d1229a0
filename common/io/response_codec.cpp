#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"

namespace whine {
namespace {

using namespace ranges;

void describe_bearings(Codec& c, ResponseResult& a, int g) {
  if (!c.optional(of_body(c, a.mesh, g, "bearing_force_max"), a.bearing_force_max[g].size() > 0)) return;
  c(a.bearing_force_max[g], of_body(c, a.mesh, g, "bearing_force_max"), "N", kForce, "mesh_frequency",
    "largest force of the gear on its bearing");
  c(a.bearing_force_rms[g], of_body(c, a.mesh, g, "bearing_force_rms"), "N", kForce, "mesh_frequency",
    "RMS of the oscillating part of the force of the gear on its bearing, x and y together");
}

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
  c(a.flank_pressure_sustained, "/flank_pressure_sustained", "Pa", kPressure, "mesh_frequency",
    "largest pressure that a pair sustains inside its flanks for 1/64 of a mesh period; 0: no pair holds load there");
  for (int g = 0; g < (c.lists() ? 1 : kSides); ++g)
    c(a.edge_load[static_cast<size_t>(g)], of_body(c, a.mesh, g, "edge_load"), "N", kLoad, "mesh_frequency",
      "largest load that a pair sustains over the tip edge of the gear for 1/64 of a mesh period; 0: no pair does");
}

}  // namespace

void describe(Codec& c, ResponseResult& a) {
  const char* const axis = "mesh_frequency";
  describe_pair(c, a);
  describe_motion(c, a);
  describe_torque(c, a.torque);
  c(a.direction, "/parameters/operation/direction", "", "direction in which the speeds are run through");
  describe_model(c, a.model, "finite elements, or the name of a lumped model");
  describe_natural_frequency(c, a.natural_frequency);
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, axis,
    "mesh frequency, in the order in which they were computed");
  c(a.dte_rms, "/dte_rms", "m", kSize, axis, "RMS of the oscillating part of the dynamic transmission error");
  c(a.dte_mean, "/dte_mean", "m", kLength, axis, "mean of the dynamic transmission error");
  c(a.dte_harmonic, "/dte_harmonic", "m", kSize, "mesh_frequency harmonic",
    "amplitude of the harmonics 1, 2, ... of the mesh frequency");
  c.numbers("harmonic", 1, "number of the harmonic of the mesh frequency");
  describe_hunting(c, a.hunting_periods);
  if (c.lists() || a.hunting_periods > 1) {
    c(a.dte_order, "/dte_order", "m", kSize, "mesh_frequency order",
      "amplitude of the harmonics 1, 2, ... of the hunting frequency");
    c.numbers("order", 1, "number of the harmonic of the hunting frequency");
  }
  c(a.tooth_load_max, "/tooth_load_max", "N", kLoad, axis, "largest normal force of one tooth pair");
  c(a.mesh_force_max, "/mesh_force_max", "N", kLoad, axis, "largest normal force of all pairs together");
  for (int g = 0; g < (c.lists() ? 1 : 2); ++g) {
    describe_bearings(c, a, g);
    if (c.optional(of_body(c, a.mesh, g, "root_stress_max"), a.root_stress_max[g].size() > 0)) {
      c(a.root_stress_max[g], of_body(c, a.mesh, g, "root_stress_max"), "Pa", kStress, axis,
        "largest tangential stress along the roots beside the loaded flanks, quasi-static in the tooth loads: the inertia of the body adds none");
      c(a.root_stress_sustained[g], of_body(c, a.mesh, g, "root_stress_sustained"), "Pa", kStress, axis,
        "the same, sustained for 1/64 of a mesh period: without spikes whose height depends on the time step");
      describe_root_place(c, a.mesh, g, axis, a.root_stress_angle, a.root_stress_phase);
    }
  }
  if (c.optional("/tooth_load_sustained", a.tooth_load_sustained.size() > 0)) {
    c(a.tooth_load_sustained, "/tooth_load_sustained", "N", kLoad, axis,
      "largest normal force that one pair sustains for 1/64 of a mesh period");
    c(a.mesh_force_sustained, "/mesh_force_sustained", "N", kLoad, axis, "the same of all pairs together");
  }
  if (c.optional("/loss_factor", a.loss_factor.size() > 0))
    c(a.loss_factor, "/loss_factor", "1", kPositive, axis,
      "mean power lost by sliding over the power carried, per unit coefficient of friction");
  describe_pressure(c, a);
  describe_friction(c, a.mesh, a.friction);
  c(a.separation_fraction, "/separation_fraction", "1", kShare, axis, "share of the period without force");
  c(a.separations_per_period, "/separations_per_period", "1", kPositive, axis,
    "losses of contact per mesh period");
  c(a.jump_frequency, "/jump_frequency", "Hz", kFrequency, "jump",
    "middle of the interval in which the response jumps");
  c(a.jump_width, "/jump_width", "Hz", kFrequency, "jump",
    "width of the interval in which the response jumps");
  c(a.period_multiple, "/period_multiple", "1", kMultiple, axis,
    "mesh periods after which the motion repeats; 0: not periodic within the limit");
  describe_backlash_left(c, a.backlash_left);
  describe_remarks(c, a.remarks);
}

std::string title(const ResponseResult& a) {
  return text("Response, sweep ", a.direction, ": ", pair_title(a.mesh, a.torque));
}

template struct ArtifactFile<ResponseResult>;

}  // namespace whine
