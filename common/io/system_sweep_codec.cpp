#include "io/system_sweep_codec.h"

#include "base/error.h"
#include "dynamics/system_coordinates.h"
#include "io/codec.h"
#include "io/keys.h"
#include "io/layout_codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kSystemSweepSchema{"system_sweep", 2};
constexpr const char* kAxis = "mesh_frequency";

void describe_meshes(Codec& c, SystemSweepResult& a) {
  const std::string axes = std::string(kAxis) + " mesh_number";
  c.dataset({"/dte_rms", "m", "RMS of the oscillating part of the dynamic transmission error of each mesh",
             axes, kSize},
            &a.dte_rms);
  c.dataset({"/dte_mean", "m", "mean of the dynamic transmission error of each mesh", axes, kLength},
            &a.dte_mean);
  c.dataset({"/mesh_force_max", "N", "largest torque on the driving body over its base radius", axes, kLoad},
            &a.mesh_force_max);
  c.dataset({"/tooth_force_max", "N", "largest normal force of one pair of teeth", axes, kLoad},
            &a.tooth_force_max);
  c.dataset(
      {"/load_share_max", "1",
       "largest share, at one instant, of the meshes that come from one [[mesh]]: of planets the load sharing",
       axes, kShare},
      &a.load_share_max);
  c.dataset({"/separation_fraction", "1",
             "share of the time steps at which no pair of the mesh carries force", axes, kShare},
            &a.separation_fraction);
  c.dataset(
      {"/transmission_error", "m",
       "dynamic transmission error of each mesh over the last mesh period, of teeth that differ the last hunting period, positive when the driver is ahead",
       std::string(kAxis) + " sample mesh_number", kLength, "r1 theta1 - r2 theta2, each in its own sense"},
      &a.transmission_error);
  c.dataset({"/mesh_deflection", "m",
             "what the flanks of each mesh close by over the same, the motion of the hubs included",
             std::string(kAxis) + " sample mesh_number", kLength, "sum over both sides of (row on r) r"},
            &a.mesh_deflection);
  c.dataset({"/mesh_force", "N", "torque on the driving body over its base radius, over the same",
             std::string(kAxis) + " sample mesh_number", kForce},
            &a.mesh_force);
}

void describe_bodies(Codec& c, SystemSweepResult& a) {
  const std::string axes = std::string(kAxis) + " body_number";
  c.dataset(
      {"/bearing_force_max", "N", "largest force of each body on its bearing, pin or axis", axes, kLoad},
      &a.bearing_force_max);
  c.dataset({"/bearing_force_rms", "N", "RMS of the oscillating part of that force", axes, kLoad},
            &a.bearing_force_rms);
  c.dataset(
      {"/holding_torque", "N m",
       "mean torque that holds the body, in its sense: of a gear against its contact forces, of a carrier against the forces on its pins; 0 of bodies that turn",
       axes, kMoment},
      &a.holding_torque);
  a.bearing_force.resize(c.lists() ? 1 : a.settings.layout.bodies.size());
  for (size_t b = 0; b < a.bearing_force.size(); ++b)
    c.dataset(
        {"/body/" + (c.lists() ? "<body>" : a.settings.layout.bodies[b].name) + "/bearing_force", "N",
         text(
             "force of the body on its bearing or pin over the last mesh or hunting period; on a rigid axis the sum of its contact forces",
             c.lists() || on_rigid_moving_pin(a.settings.layout, static_cast<int>(b))
                 ? ", on a rigid pin of a carrier that moves less the rate of its momentum"
                 : "",
             "; of a carrier the sum of its pins"),
         std::string(kAxis) + " sample xy", kForce},
        &a.bearing_force[b]);
}

void describe_solution(Codec& c, SystemSweepResult& a) {
  c.dataset({"/periods", "1", "mesh periods run to steady state", kAxis, kNumber}, &a.periods);
  c.dataset({"/period_multiple", "1", "mesh periods after which the motion repeats; 0: not within the limit",
             kAxis, kMultiple},
            &a.period_multiple);
  c.dataset({"/residual", "1", "relative change of the state over them", kAxis, kImbalance}, &a.residual);
  c.dataset(
      {"/energy_imbalance", "1", "energy not accounted for, relative to the throughput", kAxis, kImbalance},
      &a.energy_imbalance);
  constexpr auto kLines = static_cast<Eigen::Index>(kSystemEnergyLines.size());
  if (c.out() && a.energy.cols() != kLines)
    fail(Failure::numerical, "the energy balance has ", a.energy.cols(), " lines instead of ", kLines);
  for (Eigen::Index i = 0; i < kLines; ++i) {
    const SystemEnergyLine& line = kSystemEnergyLines[static_cast<size_t>(i)];
    c.column(
        {text("/energy/", line.name), "J", text(line.meaning, ", over the recorded periods"), kAxis, kEnergy},
        a.energy, i, kLines);
  }
  c.dataset({"/energy/rolling_of_mesh", "J", "work of the prescribed rolling of each mesh",
             std::string(kAxis) + " mesh_number", kEnergy},
            &a.rolling);
  c.dataset({"/energy/damping_of_bearing", "J", "taken by the damper of each bearing or pin",
             std::string(kAxis) + " body_number", kEnergy},
            &a.bearing_damping);
  c.dataset(
      {"/drift_force", "N", "largest force that must be supplied to hold the mean speed", kAxis, kForce},
      &a.drift_force);
  c.dataset({"/certificate/least_gap", "m", "least gap of a pair without force, over all recorded steps", "",
             kLength, "d >= 0 where p = 0 (Eq. 18)"},
            &a.least_gap);
  c.dataset({"/certificate/least_force", "N", "least force of a pair in contact, 0 at most", "", kForce,
             "p >= 0 where d = 0 (Eq. 18)"},
            &a.least_force);
}

}  // namespace

void describe_system_motion(Codec& c, SystemSweepParameters& s, Eigen::VectorXd& torque,
                            double& axis_frequency) {
  describe_layout(c, s.layout);
  c.dataset({"/body/torque", "N m", "torque of the drive in the body's sense; 0 where none gives a torque",
             "body_number", kMoment},
            &torque);
  SceneParameters values;
  values.fidelity = s.fidelity;
  values.damping = s.damping;
  c.parameters("fidelity", values, KeyGroup::level);
  c.parameters("fidelity", values, KeyGroup::contact_level);
  c.parameters("damping", values, KeyGroup::damping);
  c.dataset(
      {"/axis_frequency", "Hz",
       "highest natural frequency of the rigid train on its mean stiffnesses, to which the dampers of the axes refer",
       "", kFrequency},
      &axis_frequency);
  if (!c.in()) return;
  s.fidelity = values.fidelity;
  s.damping = values.damping;
}

void describe_time_steps(Codec& c, TimeDiscretisation& time) {
  SceneParameters values;
  values.time = time;
  c.parameters("discretisation", values, KeyGroup::time);
  if (c.in()) time = values.time;
}

void describe(Codec& c, SystemSweepResult& a) {
  describe_system_motion(c, a.settings, a.torque, a.axis_frequency);
  describe_errors(c, a.settings);
  describe_hunting(c, a.hunting_periods);
  describe_time_steps(c, a.settings.time);
  c.choice({"/parameters/operation/direction", "1", "direction in which the speeds are run through", ""},
           a.direction);
  c.dataset(
      {"/mesh_frequency", "Hz", "mesh frequency, in the order in which they were computed", kAxis, kSpeed},
      &a.mesh_frequency);
  describe_meshes(c, a);
  describe_bodies(c, a);
  describe_solution(c, a);
  if (!c.in()) return;
  if (a.mesh_frequency.size() == 0) c.in()->file().reject("dataset /mesh_frequency holds no speed");
  if (a.settings.layout.meshes.empty()) c.in()->file().reject("dataset /mesh/phase holds no mesh");
}

void write(const std::string& path, const SystemSweepResult& a, const Provenance& provenance) {
  write_artifact(path, kSystemSweepSchema,
                 text("Sweep ", a.direction, " of a system: ", a.settings.layout.bodies.size(), " bodies, ",
                      a.settings.layout.meshes.size(), " meshes"),
                 a, provenance);
}

SystemSweepResult read_system_sweep(const std::string& path) {
  return read_artifact<SystemSweepResult>(path, kSystemSweepSchema);
}

}  // namespace whine
