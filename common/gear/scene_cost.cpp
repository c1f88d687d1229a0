#include "gear/scene_cost.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "gear/accuracy.h"
#include "gear/tooth_errors.h"

namespace whine {
namespace {

constexpr double kMinute = 60;  // s

std::string minutes(double seconds) {
  const double all = seconds / kMinute, digit = std::pow(10, std::floor(std::log10(all)));
  return text("about ", std::round(all / digit) * digit, " min");
}

// Mesh periods after which the same teeth meet, as far as they differ.
double hunting(const Scene& scene) {
  long periods = 1;
  for (const std::string& name : scene.mesh.gear) {
    const SceneGear& gear = scene.gear(name);
    if (!gear.errors.none() || gear.design.crack.depth > 0)
      periods = std::lcm(periods, static_cast<long>(gear.design.teeth));
  }
  return static_cast<double>(periods);
}

// Bodies: unknowns grow with the square of 1 / element_mm, factors and modes with the cube of that.
void tell_of_body(std::vector<std::string>& out, const std::string& gear, const BodyDiscretisation& body,
                  const GearDesign& design) {
  const double coarseness = body.element_size / design.module;  // 0: by the module, which takes seconds
  if (coarseness > 0 && coarseness < 0.04)
    out.push_back(text(
        "[gear.", gear, "]: element_mm = ", body.element_size * 1e3, " is ", coarseness,
        " modules; mesh and modes take minutes and gigabytes below 0.04, and eight times the unknowns for a third of it"));
}

// 0.24 s for 30 teeth, 4 elements in a module and 21 modes; 71 s for 12 elements and 121 modes.
template <class AnyScene>
void add_reductions(const AnyScene& scene, std::vector<StageCost>& out) {
  constexpr double kElements = 2.5e-3, kModes = 8.7e-5, kBytes = 8e4,
                   kLeast = 7e7;  // s, s, of a tooth and the square of elements
  constexpr double kDefault = 7.5;
  std::vector<const GearDesign*> known;
  for (const auto& gear : scene.gears) {
    const auto alike = [&own = gear.design](const GearDesign* other) {
      return other->teeth == own.teeth && other->module == own.module &&
             other->bore_radius == own.bore_radius && other->profile_shift == own.profile_shift;
    };
    if (std::any_of(known.begin(), known.end(), alike)) continue;
    known.push_back(&gear.design);
    const double elements = 1 / relative_element_size(scene.body, gear.design.module);
    const double size = gear.design.teeth * elements * elements;
    out.push_back(
        {"gear-reduce, " + gear.name,
         size * (kElements + kModes * scene.body.modes) * std::max(1.0, std::sqrt(elements / kDefault)),
         kLeast + kBytes * size});
  }
}

double speeds_of(const Operation& operation) {
  return operation.frequency_step > 0
             ? std::floor((operation.frequency_to - operation.frequency_from) / operation.frequency_step) + 1
             : 0;
}

// Steps of a mesh period at the middle speed.
double steps_of(const Operation& operation, const TimeDiscretisation& time) {
  const double middle = 0.5 * (operation.frequency_from + operation.frequency_to);
  double steps = time.steps_per_period;
  while (steps * middle < time.min_sample_rate) steps *= 2;
  return steps;
}

constexpr double kStart = 0.5, kSpeed = 5e-3;  // s: reading bodies, tables; of a speed, beside its steps
constexpr double kSettlingPeriods = 25;        // mesh periods at a speed

}  // namespace

std::vector<StageCost> stage_costs(const Scene& scene) {
  std::vector<StageCost> out;
  add_reductions(scene, out);
  constexpr double kMemory = 1.6e8;
  const bool strips = scene.fidelity.contact == ContactModel::strips;
  const auto torques = static_cast<int>(scene.operation.torques.size());
  const bool sliced = scene.fidelity.width != WidthModel::one;
  // A point of a face costs 0.15 us for each of 2.5 tooth pairs, a step of strips 0.16 us with 8 of them.
  const double points = scene.contact.face_points > 0 ? scene.contact.face_points : kFacePoints,
               step = sliced ? 0.42e-6 * points : 0.08e-6 + (strips ? 0.01e-6 * scene.contact.strips : 0);
  out.push_back({"gear-static", kStart + 0.02 * (strips ? std::pow(scene.contact.strips / 8.0, 2.3) : 1),
                 kMemory, torques});
  out.push_back({"gear-sweep",
                 kStart + kSpeed * speeds_of(scene.operation) +
                     step * speeds_of(scene.operation) * kSettlingPeriods * hunting(scene) *
                         steps_of(scene.operation, scene.time),
                 kMemory, 2 * torques});
  return out;
}

std::vector<StageCost> stage_costs(const SystemScene& scene) {
  std::vector<StageCost> out;
  add_reductions(scene, out);
  constexpr double kMemory = 2e8, kStep = 4e-6;  // of a mesh
  const auto meshes = static_cast<double>(scene.meshes.size());
  out.push_back({"gear-static", kStart + 0.13 * meshes, kMemory});
  if (const double speeds = speeds_of(scene.operation); speeds > 0)
    out.push_back(
        {"gear-sweep",
         kStart + kStep * meshes * speeds * kSettlingPeriods * steps_of(scene.operation, scene.time), kMemory,
         2});
  return out;
}

std::vector<std::string> costs(const Scene& scene) {
  std::vector<std::string> out;
  // Statics: 20 ms for 128 positions with 8 strips, 25 min with 1001.
  constexpr double kPosition = 0.02 / 128, kDefaultStrips = 8, kGrowth = 2.3, kFewestPositions = 16;
  const double periods = hunting(scene), strips = scene.contact.strips;
  const double each = scene.contact.positions > 0 ? scene.contact.positions
                      : periods > 1               ? std::clamp(16384 / periods, kFewestPositions, 128.0)
                                                  : std::max(128, scene.time.steps_per_period);
  const bool on_strips = scene.fidelity.contact == ContactModel::strips;
  const double statics =
      kPosition * each * periods * (on_strips ? std::pow(strips / kDefaultStrips, kGrowth) : 1);
  if (statics > kMinute)
    out.push_back(text("statics take ", minutes(statics), " at each torque: strips = ", strips, ", ",
                       each * periods, " positions",
                       periods > 1 ? text(" over ", periods, " mesh periods") : ""));
  // Motion: 3 ms a mesh period, some 170 of them, and not less than two hunting periods.
  constexpr double kPeriod = 3e-3, kTransient = 170;
  const double speeds = std::floor((scene.operation.frequency_to - scene.operation.frequency_from) /
                                   std::max(scene.operation.frequency_step, 1e-9)) +
                        1;
  const double speed = kPeriod * std::max(kTransient, 2 * periods);
  if (periods > 1 && speed * speeds > 10 * kMinute)
    out.push_back(text("a sweep takes ", minutes(speed * speeds), ": the same teeth meet after ", periods,
                       " mesh periods, and it has ", speeds,
                       " speeds; fewer speeds or contact = \"line\" take less"));
  for (const SceneGear& gear : scene.gears) tell_of_body(out, gear.name, scene.body, gear.design);
  if (scene.fidelity.body == BodyModel::full)
    out.push_back(
        "body = \"full\" finds all modes by dense algebra: about a minute a gear for a thousand unknowns a sector, eight times that for twice as many");
  return out;
}

std::vector<std::string> costs(const SystemScene& scene, size_t meshes) {
  std::vector<std::string> out;
  if (scene.rigid()) return out;
  for (const SystemScene::Gear& gear : scene.gears) tell_of_body(out, gear.name, scene.body, gear.design);
  std::vector<int> teeth;
  for (const SystemScene::Gear& gear : scene.gears)
    if (!gear.errors.none()) teeth.push_back(gear.design.teeth);
  const double periods = hunting_periods_of(teeth), of_meshes = static_cast<double>(meshes);
  // At rest: 1 ms for a position of a mesh with 8 strips, where eight meshes share bodies; fewer take less.
  constexpr double kPosition = 1e-3, kDefaultStrips = 8, kGrowth = 2.3, kFewestPositions = 16;
  const double each = scene.contact.positions > 0 ? scene.contact.positions
                                                  : std::clamp(16384 / periods, kFewestPositions, 128.0);
  const bool on_strips = scene.fidelity.contact == ContactModel::strips;
  const double strips = scene.contact.strips,
               statics = kPosition * each * periods * of_meshes *
                         (on_strips ? std::pow(strips / kDefaultStrips, kGrowth) : 0.1);
  if (statics > kMinute)
    out.push_back(text(
        "the system at rest takes ", minutes(statics), ": ", on_strips ? text("strips = ", strips, ", ") : "",
        each * periods, " positions of ", meshes, " meshes",
        periods > 1 ? text(" over the ", periods, " mesh periods after which the same teeth meet") : ""));
  // In motion: a step takes 4 microseconds for each mesh; some 30 mesh periods a speed, and not less than eight hunting periods.
  constexpr double kStep = 4e-6, kTransient = 30;
  const Operation& speeds = scene.operation;
  if (!(speeds.frequency_from > 0) || !(speeds.frequency_step > 0)) return out;
  const double middle = 0.5 * (speeds.frequency_from + speeds.frequency_to),
               count = std::floor((speeds.frequency_to - speeds.frequency_from) / speeds.frequency_step) + 1;
  double steps = scene.time.steps_per_period;
  while (steps * middle < scene.time.min_sample_rate) steps *= 2;
  const double sweep = kStep * of_meshes * steps * std::max(kTransient, 8 * periods) * count;
  if (sweep > 10 * kMinute)
    out.push_back(
        text("a sweep takes ", minutes(sweep), ": ", count, " speeds of ", steps,
             " steps in a mesh period at its middle speed",
             periods > 1 ? text(", over the ", periods, " mesh periods after which the same teeth meet") : "",
             "; fewer speeds, a higher lowest one or a lower min_sample_rate_kHz take less"));
  return out;
}

}  // namespace whine
