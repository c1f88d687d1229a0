#include "io/sweep_codec.h"

#include "base/error.h"
#include "io/codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kSweepSchema{"sweep", 7};

// Left out of finite element sweeps, which have no such part.
void describe_lumped(Codec& c, std::string& model, LumpedParameters& a) {
  const std::string at = "/parameters/lumped/";
  c.dataset({"/parameters/fidelity/model", "1", "name of the lumped model", ""}, &model);
  c.dataset({at + "mass", "kg", "mass of the one degree of freedom", "", kMass, "m of Eq. 23"}, &a.mass);
  c.dataset({at + "damping_ratio", "1", "damping ratio about the mean stiffness", "", kPositive,
             "c / (2 sqrt(mean_stiffness m))"},
            &a.damping_ratio);
  c.dataset({at + "damper", "N s m-1", "viscous damper at the mesh", "", {0, 1e15}, "c of Eq. 23"},
            &a.damper);
  c.choice({at + "damper_acts", "1", "always (Eq. 23), or in contact only", ""}, a.damper_acts);
  c.dataset({at + "cell_end", "1", "mesh phase at which a cell of constant springs ends", "cell", kShare},
            &a.cell_end);
  c.dataset({at + "stiffness", "N m-1", "stiffness of the springs", "cell spring", kStiff, "k(t) of Eq. 23"},
            &a.stiffness);
  c.dataset({at + "gap", "m", "transmission error at which a spring touches", "cell spring", {-1e9, 1e9}},
            &a.gap);
}

void describe_motions(Codec& c, SweepResult& a, bool lumped) {
  c.dataset({"/mesh_frequency", "Hz", "mesh frequency, in the order in which they were computed",
             "mesh_frequency", kSpeed},
            &a.mesh_frequency);
  c.dataset(
      {"/transmission_error", "m",
       "dynamic transmission error from phase 0; the first period_multiple mesh periods are one orbit; shorter orbits repeat to fill the row",
       "mesh_frequency sample", kLength, "r1 theta1 + r2 theta2"},
      &a.transmission_error);
  c.dataset({"/mesh_force", "N", "normal force of all tooth pairs together", "mesh_frequency sample", kForce},
            &a.mesh_force);
  c.dataset(
      {"/pair", "1", "number of the tooth pair: -1 following, 0 reference, +1 preceding", "pair", kPair},
      &a.pair);
  c.dataset({"/tooth_load", "N", "normal force of each tooth pair", "mesh_frequency sample pair", kForce},
            &a.tooth_load);
  for (int g = 0; g < (c.lists() ? 1 : 2); ++g)
    if (c.lists() || (a.mesh.bearing[g].elastic() && !lumped))
      c.dataset(
          {of_body(c, a.mesh, g, "bearing_force"), "N",
           "force of the gear on its bearing; x, y: the driven gear stands above the driver, which turns counter-clockwise",
           "mesh_frequency sample xy", kForce},
          &a.bearing_force[g]);
  for (int g = 0; g < (c.lists() ? 1 : 2); ++g)
    if (c.optional(of_body(c, a.mesh, g, "root_stress"), a.root_stress[g].size() > 0)) {
      c.dataset(
          {of_body(c, a.mesh, g, "root_stress"), "Pa",
           "largest tangential stress of the teeth that carry load along the root beside the loaded flank, tension positive; quasi-static in the tooth loads: the inertia of the body adds none",
           "mesh_frequency sample", kStress},
          &a.root_stress[g]);
      describe_root_place(c, a.mesh, g, "mesh_frequency", a.root_stress_angle, a.root_stress_phase);
    }
}

void describe_speed_by_speed(Codec& c, SweepResult& a) {
  const char* const axis = "mesh_frequency";
  c.dataset({"/periods", "1", "mesh periods run to steady state", axis, kNumber}, &a.periods);
  c.dataset({"/residual", "1", "relative change of the state over the last mesh period", axis, {0, 1e300}},
            &a.residual);
  c.dataset(
      {"/period_multiple", "1",
       "mesh periods after which the motion repeats; 0: not periodic within the limit", axis, kMultiple},
      &a.period_multiple);
  c.dataset({"/energy_imbalance",
             "1",
             "energy not accounted for, relative to the input of the stored periods",
             axis,
             {-1e300, 1e300}},
            &a.energy_imbalance);
  constexpr auto kLines = static_cast<Eigen::Index>(kEnergyLines.size());
  if (c.out() && a.energy.cols() != kLines)
    fail(Failure::numerical, "the energy balance has ", a.energy.cols(), " lines instead of ", kLines);
  for (Eigen::Index i = 0; i < kLines; ++i)
    c.column({text("/energy/", kEnergyLines[i].name), "J",
              text(kEnergyLines[i].meaning, ", over the stored periods"), axis, kEnergy},
             a.energy, i, kLines);
  describe_friction(c, a.mesh, a.friction);
  if (c.lists() || a.mesh.friction.acts()) {
    c.dataset({"/energy/friction_rolling", "J",
               "work of the prescribed rolling against friction, over the stored periods", axis, kEnergy},
              &a.friction_rolling);
    c.dataset({"/energy/friction", "J", "taken by friction, over the stored periods", axis, kEnergy},
              &a.friction_work);
    c.dataset({"/certificate/friction_coupling", "m",
               "largest change of a gap by what friction of the last forces moves, over all steps", "", kSize,
               "iteration for d = (A + E) p + e, E of friction: E times the last change of p"},
              &a.friction_coupling);
  }
  c.dataset(
      {"/drift_force", "N", "largest force that the output must supply to hold the mean speed", axis, kForce},
      &a.drift_force);
}

}  // namespace

void describe(Codec& c, SweepResult& a) {
  describe_pair(c, a);
  describe_motion(c, a);
  describe_bearing_dampers(c, a.mean_stiffness, a.bearing_damper);
  const bool lumped = c.optional("/parameters/fidelity/model", a.lumped.cell_end.size() > 0);
  if (lumped) describe_lumped(c, a.model, a.lumped);
  describe_torque(c, a.torque);
  c.choice({"/parameters/operation/direction", "1", "direction in which the speeds are run through", ""},
           a.direction);
  describe_motions(c, a, lumped);
  describe_speed_by_speed(c, a);
  describe_natural_frequency(c, a.natural_frequency);
  describe_hunting(c, a.hunting_periods);
  describe_certificate(c, a.least_gap, a.least_force, a.fallbacks);
  describe_backlash(c, a.backlash_margin);
  c.dataset(
      {"/jump_frequency", "Hz", "middle of the interval in which the response jumps", "jump", kFrequency},
      &a.jump_frequency);
  c.dataset({"/jump_width", "Hz", "width of the interval in which the response jumps", "jump", kFrequency},
            &a.jump_width);
}

void write(const std::string& path, const SweepResult& a, const Provenance& provenance) {
  const bool lumped = a.lumped.cell_end.size() > 0;
  write_artifact(path, kSweepSchema,
                 text("Sweep ", a.direction, lumped ? ", lumped model " + a.model : "", ": ",
                      pair_title(a.mesh, a.torque)),
                 a, provenance);
}

SweepResult read_sweep(const std::string& path) {
  return read_artifact<SweepResult>(path, kSweepSchema);
}

}  // namespace whine
