#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"

namespace whine {
namespace {

using namespace ranges;

// Left out of finite element sweeps, which have no such part.
void describe_lumped(Codec& c, MotionModel& model, LumpedParameters& a) {
  const std::string at = "/parameters/lumped/";
  describe_model(c, model, "name of the lumped model");
  if (c.in() && model == MotionModel::finite_elements)
    c.in()->reject("dataset /parameters/fidelity/model names no lumped model");
  c(a.mass, at + "mass", "kg", kMass, "", "mass of the one degree of freedom", "m of Eq. 23");
  c(a.damping_ratio, at + "damping_ratio", "1", kPositive, "", "damping ratio about the mean stiffness",
    "c / (2 sqrt(mean_stiffness m))");
  c(a.damper, at + "damper", "N s m-1", {0, 1e15}, "", "viscous damper at the mesh", "c of Eq. 23");
  c(a.damper_acts, at + "damper_acts", "", "always (Eq. 23), or in contact only");
  c(a.cell_end, at + "cell_end", "1", kShare, "cell", "mesh phase at which a cell of constant springs ends");
  c(a.stiffness, at + "stiffness", "N m-1", kStiff, "cell spring", "stiffness of the springs",
    "k(t) of Eq. 23");
  c(a.gap, at + "gap", "m", {-1e9, 1e9}, "cell spring", "transmission error at which a spring touches");
}

void describe_motions(Codec& c, SweepResult& a, bool lumped) {
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, "mesh_frequency",
    "mesh frequency, in the order in which they were computed");
  c(a.transmission_error, "/transmission_error", "m", kLength, "mesh_frequency sample",
    "dynamic transmission error from phase 0; the first period_multiple mesh periods are one orbit; shorter orbits repeat to fill the row",
    "r1 theta1 + r2 theta2");
  c(a.mesh_force, "/mesh_force", "N", kForce, "mesh_frequency sample",
    "normal force of all tooth pairs together");
  c(a.pair, "/pair", "1", kPair, "pair", "number of the tooth pair: -1 following, 0 reference, +1 preceding");
  c(a.tooth_load, "/tooth_load", "N", kForce, "mesh_frequency sample pair",
    "normal force of each tooth pair");
  for (int g = 0; g < (c.lists() ? 1 : 2); ++g)
    if (c.lists() || (a.mesh.bearing[g].elastic() && !lumped))
      c(a.bearing_force[g], of_body(c, a.mesh, g, "bearing_force"), "N", kForce, "mesh_frequency sample xy",
        "force of the gear on its bearing; x, y: the driven gear stands above the driver, which turns counter-clockwise");
  for (int g = 0; g < (c.lists() ? 1 : 2); ++g)
    if (c.optional(of_body(c, a.mesh, g, "root_stress"), a.root_stress[g].size() > 0)) {
      c(a.root_stress[g], of_body(c, a.mesh, g, "root_stress"), "Pa", kStress, "mesh_frequency sample",
        "largest tangential stress of the teeth that carry load along the root beside the loaded flank, tension positive; quasi-static in the tooth loads: the inertia of the body adds none");
      describe_root_place(c, a.mesh, g, "mesh_frequency", a.root_stress_angle, a.root_stress_phase);
    }
}

void describe_speed_by_speed(Codec& c, SweepResult& a) {
  const char* const axis = "mesh_frequency";
  c(a.periods, "/periods", "1", kNumber, axis, "mesh periods run to steady state");
  c(a.residual, "/residual", "1", {0, 1e300}, axis, "relative change of the state over the last mesh period");
  c(a.period_multiple, "/period_multiple", "1", kMultiple, axis,
    "mesh periods after which the motion repeats; 0: not periodic within the limit");
  c(a.energy_imbalance, "/energy_imbalance", "1", {-1e300, 1e300}, axis,
    "energy not accounted for, relative to the input of the stored periods");
  constexpr auto kLines = static_cast<Eigen::Index>(kEnergyLines.size());
  if (c.out() && a.energy.cols() != kLines)
    fail(Failure::numerical, "the energy balance has ", a.energy.cols(), " lines instead of ", kLines);
  for (Eigen::Index i = 0; i < kLines; ++i)
    c.column({text("/energy/", kEnergyLines[i].name), "J",
              text(kEnergyLines[i].meaning, ", over the stored periods"), axis, kEnergy},
             a.energy, i, kLines);
  describe_friction(c, a.mesh, a.friction);
  if (c.lists() || a.mesh.friction.acts()) {
    c(a.friction_rolling, "/energy/friction_rolling", "J", kEnergy, axis,
      "work of the prescribed rolling against friction, over the stored periods");
    c(a.friction_work, "/energy/friction", "J", kEnergy, axis, "taken by friction, over the stored periods");
    c(a.friction_coupling, "/certificate/friction_coupling", "m", kSize, "",
      "largest change of a gap by what friction of the last forces moves, over all steps",
      "iteration for d = (A + E) p + e, E of friction: E times the last change of p");
  }
  c(a.drift_force, "/drift_force", "N", kForce, axis,
    "largest force that the output must supply to hold the mean speed");
}

}  // namespace

void describe(Codec& c, SweepResult& a) {
  describe_pair(c, a);
  describe_motion(c, a);
  describe_bearing_dampers(c, a.mean_stiffness, a.bearing_damper);
  const bool lumped = c.optional("/parameters/fidelity/model", a.lumped.cell_end.size() > 0);
  if (lumped) describe_lumped(c, a.model, a.lumped);
  describe_torque(c, a.torque);
  c(a.direction, "/parameters/operation/direction", "", "direction in which the speeds are run through");
  describe_motions(c, a, lumped);
  describe_speed_by_speed(c, a);
  describe_natural_frequency(c, a.natural_frequency);
  describe_hunting(c, a.hunting_periods);
  describe_certificate(c, a.least_gap, a.least_force, a.fallbacks);
  describe_backlash(c, a.backlash_margin);
  describe_backlash_left(c, a.backlash_left);
  describe_remarks(c, a.remarks);
  c(a.jump_frequency, "/jump_frequency", "Hz", kFrequency, "jump",
    "middle of the interval in which the response jumps");
  c(a.jump_width, "/jump_width", "Hz", kFrequency, "jump",
    "width of the interval in which the response jumps");
}

std::string title(const SweepResult& a) {
  const bool lumped = a.lumped.cell_end.size() > 0;
  return text("Sweep ", a.direction, lumped ? ", lumped model " + name_of(a.model) : "", ": ",
              pair_title(a.mesh, a.torque));
}

template struct ArtifactFile<SweepResult>;

}  // namespace whine
