#include "io/response_codec.h"

#include "base/error.h"
#include "io/codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kResponseSchema{"response", 8};

void describe_bearings(Codec& c, ResponseResult& a, int g) {
  if (!c.optional(of_body(c, a.mesh, g, "bearing_force_max"), a.bearing_force_max[g].size() > 0)) return;
  c.dataset({of_body(c, a.mesh, g, "bearing_force_max"), "N", "largest force of the gear on its bearing",
             "mesh_frequency", kForce},
            &a.bearing_force_max[g]);
  c.dataset({of_body(c, a.mesh, g, "bearing_force_rms"), "N",
             "RMS of the oscillating part of the force of the gear on its bearing, x and y together",
             "mesh_frequency", kForce},
            &a.bearing_force_rms[g]);
}

// Flank pressure and what tip edges carry.
void describe_pressure(Codec& c, ResponseResult& a) {
  if (!c.optional("/flank_pressure", a.flank_pressure.size() > 0)) return;
  c.dataset(
      {"/pair_phase", "1",
       "places of the flanks by the phase of the pair that touches there, in mesh periods from the pitch point",
       "pair_phase", kSigned},
      &a.pair_phase);
  c.dataset({"/flank_roll", "rad", "roll angles of both gears there", "pair_phase gear", kRoll},
            &a.flank_roll);
  c.dataset(
      {"/flank_pressure", "Pa",
       "largest pressure over the mesh periods at a place of the flanks, by Hertz's law of the load that a pair holds there inside its flanks; 0: it holds none, or over a tip edge, where pressure is singular: see edge_load_there",
       "mesh_frequency pair_phase", kPressure, "sqrt(F E* / (pi b R))"},
      &a.flank_pressure);
  c.dataset(
      {"/edge_load_there", "N",
       "largest load over the mesh periods that a pair holds at a place of the flanks over a tip edge; 0: it holds none, or inside its flanks: see flank_pressure",
       "mesh_frequency pair_phase", kLoad},
      &a.edge_load_there);
  c.dataset(
      {"/flank_pressure_sustained", "Pa",
       "largest pressure that a pair sustains inside its flanks for 1/64 of a mesh period; 0: no pair holds load there",
       "mesh_frequency", kPressure},
      &a.flank_pressure_sustained);
  for (int g = 0; g < (c.lists() ? 1 : kSides); ++g)
    c.dataset(
        {of_body(c, a.mesh, g, "edge_load"), "N",
         "largest load that a pair sustains over the tip edge of the gear for 1/64 of a mesh period; 0: no pair does",
         "mesh_frequency", kLoad},
        &a.edge_load[static_cast<size_t>(g)]);
}

}  // namespace

void describe(Codec& c, ResponseResult& a) {
  const char* const axis = "mesh_frequency";
  describe_pair(c, a);
  describe_motion(c, a);
  describe_torque(c, a.torque);
  c.choice({"/parameters/operation/direction", "1", "direction in which the speeds are run through", ""},
           a.direction);
  c.dataset({"/parameters/fidelity/model", "1", "finite elements, or the name of a lumped model", ""},
            &a.model);
  describe_natural_frequency(c, a.natural_frequency);
  c.dataset(
      {"/mesh_frequency", "Hz", "mesh frequency, in the order in which they were computed", axis, kSpeed},
      &a.mesh_frequency);
  c.dataset({"/dte_rms", "m", "RMS of the oscillating part of the dynamic transmission error", axis, kSize},
            &a.dte_rms);
  c.dataset({"/dte_mean", "m", "mean of the dynamic transmission error", axis, kLength}, &a.dte_mean);
  c.dataset({"/dte_harmonic", "m", "amplitude of the harmonics 1, 2, ... of the mesh frequency",
             "mesh_frequency harmonic", kSize},
            &a.dte_harmonic);
  c.numbers("harmonic", 1, "number of the harmonic of the mesh frequency");
  describe_hunting(c, a.hunting_periods);
  if (c.lists() || a.hunting_periods > 1) {
    c.dataset({"/dte_order", "m", "amplitude of the harmonics 1, 2, ... of the hunting frequency",
               "mesh_frequency order", kSize},
              &a.dte_order);
    c.numbers("order", 1, "number of the harmonic of the hunting frequency");
  }
  c.dataset({"/tooth_load_max", "N", "largest normal force of one tooth pair", axis, kLoad},
            &a.tooth_load_max);
  c.dataset({"/mesh_force_max", "N", "largest normal force of all pairs together", axis, kLoad},
            &a.mesh_force_max);
  for (int g = 0; g < (c.lists() ? 1 : 2); ++g) {
    describe_bearings(c, a, g);
    if (c.optional(of_body(c, a.mesh, g, "root_stress_max"), a.root_stress_max[g].size() > 0)) {
      c.dataset(
          {of_body(c, a.mesh, g, "root_stress_max"), "Pa",
           "largest tangential stress along the roots beside the loaded flanks, quasi-static in the tooth loads: the inertia of the body adds none",
           axis, kStress},
          &a.root_stress_max[g]);
      c.dataset(
          {of_body(c, a.mesh, g, "root_stress_sustained"), "Pa",
           "the same, sustained for 1/64 of a mesh period: without spikes whose height depends on the time step",
           axis, kStress},
          &a.root_stress_sustained[g]);
      describe_root_place(c, a.mesh, g, axis, a.root_stress_angle, a.root_stress_phase);
    }
  }
  if (c.optional("/tooth_load_sustained", a.tooth_load_sustained.size() > 0)) {
    c.dataset({"/tooth_load_sustained", "N",
               "largest normal force that one pair sustains for 1/64 of a mesh period", axis, kLoad},
              &a.tooth_load_sustained);
    c.dataset({"/mesh_force_sustained", "N", "the same of all pairs together", axis, kLoad},
              &a.mesh_force_sustained);
  }
  if (c.optional("/loss_factor", a.loss_factor.size() > 0))
    c.dataset({"/loss_factor", "1",
               "mean power lost by sliding over the power carried, per unit coefficient of friction", axis,
               kPositive},
              &a.loss_factor);
  describe_pressure(c, a);
  describe_friction(c, a.mesh, a.friction);
  c.dataset({"/separation_fraction", "1", "share of the period without force", axis, kShare},
            &a.separation_fraction);
  c.dataset({"/separations_per_period", "1", "losses of contact per mesh period", axis, kPositive},
            &a.separations_per_period);
  c.dataset(
      {"/jump_frequency", "Hz", "middle of the interval in which the response jumps", "jump", kFrequency},
      &a.jump_frequency);
  c.dataset({"/jump_width", "Hz", "width of the interval in which the response jumps", "jump", kFrequency},
            &a.jump_width);
  c.dataset(
      {"/period_multiple", "1",
       "mesh periods after which the motion repeats; 0: not periodic within the limit", axis, kMultiple},
      &a.period_multiple);
}

void write(const std::string& path, const ResponseResult& a, const Provenance& provenance) {
  write_artifact(path, kResponseSchema,
                 text("Response, sweep ", a.direction, ": ", pair_title(a.mesh, a.torque)), a, provenance);
}

ResponseResult read_response(const std::string& path) {
  return read_artifact<ResponseResult>(path, kResponseSchema);
}

}  // namespace whine
