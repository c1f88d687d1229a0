#include "studies/pair_in_motion.h"

#include "dynamics/lines_motion.h"
#include "dynamics/strips_motion.h"
#include "gear/body_inertia.h"
#include "gear/helix.h"
#include "gear/train.h"
#include "studies/sweep.h"
#include "system/face_contact.h"

namespace whine {

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
  static_cast<MotionSettings&>(out) = settings;
  out.axis_stiffness = mean_stiffness;
  return out;
}

PairInMotion::PairInMotion(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                           double stiffness, const SweepParameters& settings)
    : mean_stiffness(stiffness) {
  require_inertia(statics.mesh, {driver.inertia, driven.inertia}, settings.inertia);
  const int positions = steps_at(settings.time, settings.frequency_from);
  set_motion(source, {driver, driven}, statics, settings);
  source.torque = statics.torque;
  source.place_pair(pair_system(source));
  if (settings.fidelity.width == WidthModel::one) {
    motion = std::make_unique<StripsMotion>(
        driver, driven, statics, dynamic_parameters(statics, mean_stiffness, settings, settings.frequency_to),
        positions);
    return;
  }
  source.fidelity.contact = ContactModel::line;
  const SystemSweepParameters train = train_of_slices(driver, driven, statics, mean_stiffness, settings);
  require_relaxation_range(train.damping, train.fidelity.body, train.frequency_to);
  motion = std::make_unique<LinesMotion>(train, std::vector<ReducedBody>{driver, driven}, positions);
}

}  // namespace whine
