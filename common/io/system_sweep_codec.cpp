#include "io/artifacts.h"

#include "io/system_motion_codec.h"

#include "base/error.h"
#include "gear/layout.h"
#include "io/artifact_file.h"
#include "io/keys.h"
#include "io/layout_codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr const char* kAxis = "mesh_frequency";

void describe_meshes(Codec& c, SystemSweepResult& a) {
  const std::string axes = std::string(kAxis) + " sample mesh_number";
  c(a.transmission_error, "/transmission_error", "m", kLength, axes,
    "dynamic transmission error of each mesh from phase 0, positive when the driver is ahead; the first period_multiple mesh periods are one motion, shorter motions repeat to fill the row",
    "r1 theta1 - r2 theta2, each in its own sense");
  c(a.mesh_deflection, "/mesh_deflection", "m", kLength, axes,
    "what the flanks of each mesh close by over the same, the motion of the hubs included",
    "sum over both sides of (row on r) r");
  c(a.mesh_force, "/mesh_force", "N", kForce, axes,
    "torque on the driving body over its base radius, over the same");
  c(a.largest_tooth_load, "/largest_tooth_load", "N", kLoad, axes,
    "normal force of the pair of teeth that carries most, over the same");
}

void describe_bodies(Codec& c, SystemSweepResult& a) {
  const std::string axes = std::string(kAxis) + " body_number";
  c(a.holding_torque, "/holding_torque", "N m", kMoment, axes,
    "mean torque that holds the body, in its sense: of a gear against its contact forces, of a carrier against the forces on its pins; 0 of bodies that turn");
  a.bearing_force.resize(c.lists() ? 1 : a.settings.layout.bodies.size());
  for (size_t b = 0; b < a.bearing_force.size(); ++b)
    c(a.bearing_force[b],
      "/body/" + (c.lists() ? "<body>" : a.settings.layout.bodies[b].name) + "/bearing_force", "N", kForce,
      std::string(kAxis) + " sample xy",
      text(
          "force of the body on its bearing or pin over the same; on a rigid axis the sum of its contact forces",
          c.lists() || on_rigid_moving_pin(a.settings.layout, static_cast<int>(b))
              ? ", on a rigid pin of a carrier that moves less the rate of its momentum"
              : "",
          "; of a carrier the sum of its pins"));
}

void describe_solution(Codec& c, SystemSweepResult& a) {
  c(a.periods, "/periods", "1", kNumber, kAxis, "mesh periods run to steady state");
  c(a.period_multiple, "/period_multiple", "1", kMultiple, kAxis,
    "mesh periods after which the motion repeats; 0: not within the limit");
  c(a.jump_frequency, "/jump_frequency", "Hz", kFrequency, "jump",
    "middle of the interval in which the response jumps, of teeth that are alike");
  c(a.jump_width, "/jump_width", "Hz", kFrequency, "jump",
    "width of the interval in which the response jumps");
  c(a.residual, "/residual", "1", kImbalance, kAxis, "relative change of the state over them");
  c(a.energy_imbalance, "/energy_imbalance", "1", kImbalance, kAxis,
    "energy not accounted for, relative to the throughput");
  constexpr auto kLines = static_cast<Eigen::Index>(kSystemEnergyLines.size());
  if (c.out() && a.energy.cols() != kLines)
    fail(Failure::numerical, "the energy balance has ", a.energy.cols(), " lines instead of ", kLines);
  for (Eigen::Index i = 0; i < kLines; ++i) {
    const SystemEnergyLine& line = kSystemEnergyLines[static_cast<size_t>(i)];
    c.column(
        {text("/energy/", line.name), "J", text(line.meaning, ", over the recorded periods"), kAxis, kEnergy},
        a.energy, i, kLines);
  }
  c(a.rolling, "/energy/rolling_of_mesh", "J", kEnergy, std::string(kAxis) + " mesh_number",
    "work of the prescribed rolling of each mesh");
  c(a.bearing_damping, "/energy/damping_of_bearing", "J", kEnergy, std::string(kAxis) + " body_number",
    "taken by the damper of each bearing or pin");
  c(a.drift_force, "/drift_force", "N", kForce, kAxis,
    "largest force that must be supplied to hold the mean speed");
  c(a.least_gap, "/certificate/least_gap", "m", kLength, "",
    "least gap of a pair without force, over all recorded steps", "d >= 0 where p = 0 (Eq. 18)");
  c(a.least_force, "/certificate/least_force", "N", kForce, "", "least force of a pair in contact, 0 at most",
    "p >= 0 where d = 0 (Eq. 18)");
}

}  // namespace

void describe_system(Codec& c, SystemSweepParameters& s, Eigen::VectorXd& torque, const LayoutPlace& place) {
  describe_layout(c, s.layout, place);
  c(torque, place.group + "/body/torque", "N m", kMoment, "body" + place.axis_end,
    "torque of the drive in the body's sense; 0 where none gives a torque");
  c.parameters("fidelity", keys(s.fidelity));
  c.parameters("damping", keys(s.damping));
}

void describe_system_motion(Codec& c, SystemSweepParameters& s, Eigen::VectorXd& torque,
                            double& axis_frequency) {
  describe_system(c, s, torque);
  c(axis_frequency, "/axis_frequency", "Hz", kFrequency, "",
    "highest natural frequency of the rigid train on its mean stiffnesses, to which the dampers of the axes refer");
}

void describe_names(Codec& c, bool of_train, std::vector<std::string>& meshes,
                    std::vector<std::string>& bodies) {
  if (!of_train && !c.lists()) {
    c.axis("mesh", 1);
    c.axis("body", kSides);
  }
  c(meshes, "/mesh", "mesh", "meshes by the names of their bodies, driving-driven");
  c(bodies, "/body", "body", "bodies by name; of a pair the driver, then the driven gear");
}

void describe_time_steps(Codec& c, TimeDiscretisation& time) {
  c.parameters("discretisation", keys(time));
}

void describe(Codec& c, SystemSweepResult& a) {
  describe_system_motion(c, a.settings, a.torque, a.axis_frequency);
  describe_sections(c, a.settings.section);
  describe_errors(c, a.settings);
  describe_hunting(c, a.hunting_periods);
  describe_time_steps(c, a.settings.time);
  c(a.direction, "/parameters/operation/direction", "", "direction in which the speeds are run through");
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, kAxis,
    "mesh frequency, in the order in which they were computed");
  describe_meshes(c, a);
  describe_bodies(c, a);
  describe_solution(c, a);
  describe_remarks(c, a.remarks);
  if (!c.in()) return;
  if (a.mesh_frequency.size() == 0) c.in()->reject("dataset /mesh_frequency holds no speed");
  if (a.settings.layout.meshes.empty()) c.in()->reject("dataset /mesh/phase holds no mesh");
}

std::string title(const SystemSweepResult& a) {
  return text("Sweep ", a.direction, " of a system: ", a.settings.layout.bodies.size(), " bodies, ",
              a.settings.layout.meshes.size(), " meshes");
}

template struct ArtifactFile<SystemSweepResult>;

}  // namespace whine
