#include "io/artifacts.h"

#include "base/error.h"
#include "gear/layout.h"
#include "io/artifact_file.h"
#include "io/system_motion_codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr const char* kAxis = "mesh_frequency";

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

void describe_meshes(Codec& c, SweepResult& a) {
  const std::string axes = "mesh_frequency sample mesh";
  c(a.transmission_error, "/transmission_error", "m", kLength, axes,
    "dynamic transmission error of each mesh from phase 0, positive when the driver is ahead; the first period_multiple mesh periods are one motion, shorter motions repeat to fill the row",
    "r1 theta1 + r2 theta2");
  c(a.mesh_force, "/mesh_force", "N", kForce, axes,
    "normal force of all tooth pairs of the mesh together; of trains torque on the driving body over its base radius");
  c(a.pair, "/tooth_pair", "1", kPair, "tooth_pair",
    "number of the tooth pair: -1 following, 0 reference, +1 preceding");
  c(a.tooth_load, "/tooth_load", "N", kForce, axes + " tooth_pair", "normal force of each tooth pair");
  if (c.lists() || a.of_train())
    c(a.mesh_deflection, "/mesh_deflection", "m", kLength, axes,
      "what the flanks of each mesh close by over the same, the motion of the hubs included; left out of pairs",
      "sum over both sides of (row on r) r");
}

void describe_bodies(Codec& c, SweepResult& a, const std::vector<std::string>& names, bool lumped) {
  a.bearing_force.resize(names.size());
  for (size_t b = 0; b < names.size(); ++b)
    if (c.lists() || a.of_train() || (a.mesh.bearing[b].elastic() && !lumped))
      c(a.bearing_force[b], "/bearing_force/" + names[b], "N", kForce, "mesh_frequency sample xy",
        text(
            "force of the body on its bearing or pin over the same; of a train on a rigid axis the sum of its contact forces",
            c.lists() || (a.of_train() && on_rigid_moving_pin(a.layout, static_cast<int>(b)))
                ? ", on a rigid pin of a carrier that moves less the rate of its momentum"
                : "",
            ", of a carrier the sum of its pins; x, y: of a pair the driven gear stands above the driver, which turns counter-clockwise"));
  if (c.lists() || a.of_train())
    c(a.holding_torque, "/holding_torque", "N m", kMoment, "mesh_frequency body",
      "of a train: mean torque that holds the body, in its sense: of a gear against its contact forces, of a carrier against the forces on its pins; 0 of bodies that turn");
}

void describe_root_stress(Codec& c, SweepResult& a) {
  if (!c.optional("/root_stress", !a.root_stress.empty())) return;
  const std::string side = "mesh_frequency mesh side";
  c(a.root_stress, "/root_stress", "Pa", kStress, "mesh_frequency sample mesh side",
    "largest tangential stress of the teeth that carry load along the root beside the loaded flank, tension positive, under the loads of the mesh; quasi-static in them: the inertia of the body adds none; 0 of a mesh of which it is not known");
  c(a.root_stress_angle, "/root_stress_angle", "1", kRoll, side, kRootAngle);
  c(a.root_stress_phase, "/root_stress_phase", "1", kPlace, side, kRootPhase);
}

void describe_energy(Codec& c, SweepResult& a) {
  c(a.energy_imbalance, "/energy_imbalance", "1", {-1e300, 1e300}, kAxis,
    "energy not accounted for, relative to the throughput of the stored periods");
  constexpr auto kLines = static_cast<Eigen::Index>(kEnergyLines.size());
  if (c.out() && a.energy.cols() != kLines)
    fail(Failure::numerical, "the energy balance has ", a.energy.cols(), " lines instead of ", kLines);
  for (Eigen::Index i = 0; i < kLines; ++i) {
    const EnergyLine& line = kEnergyLines[static_cast<size_t>(i)];
    c.column(
        {text("/energy/", line.name), "J", text(line.meaning, ", over the stored periods"), kAxis, kEnergy},
        a.energy, i, kLines);
  }
  if (!c.lists() && !a.of_train()) return;
  c(a.rolling, "/energy/rolling_of_mesh", "J", kEnergy, "mesh_frequency mesh",
    "of a train: work of the prescribed rolling of each mesh");
  c(a.bearing_damping, "/energy/damping_of_bearing", "J", kEnergy, "mesh_frequency body",
    "of a train: taken by the damper of each bearing or pin");
}

void describe_speed_by_speed(Codec& c, SweepResult& a) {
  c(a.periods, "/periods", "1", kNumber, kAxis, "mesh periods run to steady state");
  c(a.residual, "/residual", "1", {0, 1e300}, kAxis,
    "relative change of the state over the last mesh period");
  c(a.period_multiple, "/period_multiple", "1", kMultiple, kAxis,
    "mesh periods after which the motion repeats; 0: not periodic within the limit");
  describe_energy(c, a);
  c(a.drift_force, "/drift_force", "N", kForce, kAxis,
    "largest force that the output must supply to hold the mean speed");
  describe_certificate(c, a.least_gap, a.least_force, a.fallbacks);
  const bool slides = a.friction_coupling > 0 || a.friction.power.size() > 0 || a.mesh.friction.acts();
  if (c.optional("/certificate/friction_coupling", slides))
    c(a.friction_coupling, "/certificate/friction_coupling", "m", kSize, "",
      "largest change of a gap by what friction of the last forces moves, over all steps",
      "iteration for d = (A + E) p + e, E of friction: E times the last change of p");
  describe_hunting(c, a.hunting_periods);
  c(a.jump_frequency, "/jump_frequency", "Hz", kFrequency, "jump",
    "middle of the interval in which the response jumps; of trains whose teeth differ jumps are not looked for");
  c(a.jump_width, "/jump_width", "Hz", kFrequency, "jump",
    "width of the interval in which the response jumps");
  describe_remarks(c, a.remarks);
}

// What pairs alone have, but for their samples; whether the motion is of a lumped model.
bool describe_source_of_pair(Codec& c, SweepResult& a) {
  describe_bearing_dampers(c, a.mean_stiffness, a.bearing_damper);
  describe_natural_frequency(c, a.natural_frequency);
  const bool lumped = c.optional("/parameters/fidelity/model", a.lumped.cell_end.size() > 0);
  if (lumped) describe_lumped(c, a.model, a.lumped);
  return lumped;
}

}  // namespace

void describe(Codec& c, SweepResult& a) {
  describe_source(c, a);
  if (c.lists() || a.of_train()) {
    describe_sections(c, a.section, {"/layout", ""});
    describe_errors(c, a.layout, a.errors, {"/layout", ""});
  }
  const bool lumped = !a.of_train() && describe_source_of_pair(c, a);
  c(a.direction, "/parameters/operation/direction", "", "direction in which the speeds are run through");
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, kAxis,
    "mesh frequency, in the order in which they were computed");
  describe_meshes(c, a);
  describe_bodies(c, a, c.lists() ? std::vector<std::string>{"<body>"} : a.body_names, lumped);
  describe_root_stress(c, a);
  describe_face_load(c, a.face_load_factor, a.line_load_max);
  describe_speed_by_speed(c, a);
  describe_friction(c, a.friction);
  if (!a.of_train()) {
    describe_backlash(c, a.backlash_margin);
    describe_backlash_left(c, a.backlash_left);
  }
  if (!c.in()) return;
  if (a.mesh_frequency.size() == 0) c.in()->reject("dataset /mesh_frequency holds no speed");
  if (a.of_train() && a.layout.meshes.empty()) c.in()->reject("dataset /layout/mesh/phase holds no mesh");
}

std::string title(const SweepResult& a) {
  if (a.of_train())
    return text("Sweep ", a.direction, " of a system: ", a.bodies(), " bodies, ", a.meshes(), " meshes");
  const bool lumped = a.lumped.cell_end.size() > 0;
  return text("Sweep ", a.direction, lumped ? ", lumped model " + name_of(a.model) : "", ": ",
              pair_title(a.mesh, a.torque));
}

template struct ArtifactFile<SweepResult>;

}  // namespace whine
