#include "studies/face_sweep.h"

#include <limits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "gear/body_inertia.h"
#include "gear/helix.h"
#include "gear/train.h"
#include "studies/sweep.h"
#include "studies/system_sweep.h"
#include "studies/train_in_motion.h"
#include "system/face_contact.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// Hz: mean over the period, contact frozen as it is under the static load, of the mode that gives way most to a torque on the driver.
double natural_frequency(SystemDynamics& dynamics, int positions) {
  const VectorXd turning = dynamics.coordinates().turning(0);
  double sum = 0;
  for (int i = 0; i < positions; ++i) {
    const SystemDynamics::FrozenModes modes = dynamics.frozen_modes(i);
    Index softest = 0;
    (turning.transpose() * modes.shape)
        .transpose()
        .cwiseQuotient(modes.frequency)
        .cwiseAbs()
        .maxCoeff(&softest);
    sum += modes.frequency[softest] / positions;
  }
  return sum;
}

}  // namespace

SystemSweepParameters train_of_slices(const ReducedBody& driver, const ReducedBody& driven,
                                      const StaticResult& statics, double mean_stiffness,
                                      const SweepParameters& settings) {
  SystemSweepParameters out;
  const GearDesign first = transverse_section(driver.design), second = transverse_section(driven.design);
  out.mesh = {statics.mesh};
  out.layout = pair_system(even(statics.mesh), first, second);
  const double ratio = static_cast<double>(second.teeth) / first.teeth;
  out.layout.drives = {{0, System::DriveKind::torque, statics.torque},
                       {1, System::DriveKind::torque, -statics.torque * ratio}};
  for (size_t g = 0; g < kSides; ++g) {
    out.layout.bodies[g].inertia = settings.inertia[g];
    out.gear.push_back(statics.mesh.gear[g]);
    out.body.emplace_back(statics.mesh.gear[g], "");
  }
  out.section = {0};
  out.errors.resize(kSides);
  out.fidelity = settings.fidelity;
  out.contact = statics.contact;
  out.damping = settings.damping;
  out.frequency_from = settings.frequency_from;
  out.frequency_to = settings.frequency_to;
  out.frequency_step = settings.frequency_step;
  out.time = settings.time;
  out.axis_stiffness = mean_stiffness;
  return out;
}

SliceAxes axes_of_slices(const SystemSweepParameters& train, const std::vector<ReducedBody>& bodies) {
  constexpr int kPositions = 16;
  TrainInMotion still(train, bodies, kPositions);
  SliceAxes out;
  out.natural_frequency = natural_frequency(still.dynamics(), kPositions);
  for (size_t g = 0; g < kSides; ++g)
    out.bearing_damper[g] =
        2 * train.damping.bearing_ratio * train.layout.bodies[g].inertia * still.motion().axis_frequency;
  return out;
}

SweepResult face_sweep(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                       double mean_stiffness, const SweepParameters& settings, Direction direction,
                       const std::function<void(long, long, const std::string&)>& report, double jump_width) {
  require_inertia(statics.mesh, {driver.inertia, driven.inertia}, settings.inertia);
  const SystemSweepParameters train = train_of_slices(driver, driven, statics, mean_stiffness, settings);
  const std::vector<ReducedBody> bodies{driver, driven};
  SweepResult out = system_sweep(train, bodies, direction, report, jump_width);
  const SliceAxes axes = axes_of_slices(train, bodies);
  out.natural_frequency = axes.natural_frequency;
  out.bearing_damper = axes.bearing_damper;
  set_motion(out, {driver, driven}, statics, settings);
  out.fidelity.contact = ContactModel::line;
  out.time = settings.time;
  out.torque = statics.torque;
  out.mean_stiffness = mean_stiffness;
  // What only trains have.
  out.train = {};
  out.drive.resize(0);
  out.axis_frequency = 0;
  out.name_parts();
  out.mesh_deflection.clear();
  for (MatrixRM* x : {&out.holding_torque, &out.rolling, &out.bearing_damping}) x->resize(0, 0);
  out.bearing_force.assign(kSides, {});
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < out.tooth_load.size(); ++i) {
    out.mesh_force[i] = out.tooth_load[i].rowwise().sum();
    least = std::min(least, out.transmission_error[i].minCoeff());
  }
  out.backlash_margin =
      out.tooth_thinning() > 0 ? GearPair(out).backlash() + least : std::numeric_limits<double>::infinity();
  out.backlash_left = backlash_left(out);
  out.remarks = remarks(out, statics);
  return out;
}

}  // namespace whine
