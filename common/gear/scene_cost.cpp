#include "gear/scene_cost.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/format.h"
#include "gear/accuracy.h"
#include "gear/face_width.h"
#include "gear/tooth_errors.h"

namespace whine {
namespace {

constexpr double kMinute = 60, kStart = 0.5, kMemory = 2e8;  // s; s: reading bodies, tables; bytes

// 0.24 s for 30 teeth, 4 elements in a module and 21 modes; 71 s for 12 elements and 121 modes: unknowns grow with the square of
// 1 / element_mm, factors and modes with the cube of that.
void add_reductions(const Scene& scene, std::vector<StageCost>& out) {
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
    const double size_of_element = relative_element_size(scene.body, gear.design.module),
                 elements = 1 / size_of_element, size = gear.design.teeth * elements * elements;
    out.push_back(
        {"gear-reduce, " + gear.name,
         size * (kElements + kModes * scene.body.modes) * std::max(1.0, std::sqrt(elements / kDefault)),
         kLeast + kBytes * size, 1,
         text("element_mm = ", shown_number(size_of_element * gear.design.module * 1e3), " is ",
              shown_number(size_of_element), " modules, and has modes = ", scene.body.modes)});
  }
}

// Of one slice, or a contact line of several points: tooth pairs that an instant looks at, corners included.
double pairs_in_reach(const GearDesign& a, const GearDesign& b) {
  constexpr double kOfSpurs = 2.1;
  return kOfSpurs + contact_width(a, b) * std::sin(std::abs(a.helix_angle)) / (std::numbers::pi * a.module);
}

// What the laws of statics and motion are of.
struct Work {
  const Fidelity& fidelity;
  const ContactDiscretisation& contact;
  const Operation& operation;
  const TimeDiscretisation& time;
  bool train;
  int torques;
  double meshes = 0, contacts = 0;  // forces that an instant looks at: of lines, or points of them
  double periods = 1,
         positions = 0;  // mesh periods after which the same teeth meet, positions at rest in one of them

  bool on_strips() const { return fidelity.contact == ContactModel::strips && !sliced(); }
  bool sliced() const { return fidelity.width != WidthModel::one; }
  double speeds() const {
    return operation.frequency_step > 0
               ? std::floor((operation.frequency_to - operation.frequency_from) / operation.frequency_step) +
                     1
               : 0;
  }
  double steps_at(double frequency) const {
    double steps = time.steps_per_period;
    while (steps * frequency < time.min_sample_rate) steps *= 2;
    return steps;
  }
  double steps() const { return steps_at(0.5 * (operation.frequency_from + operation.frequency_to)); }
  std::string hunting() const {
    return periods > 1 ? text(" over the ", periods, " mesh periods after which the same teeth meet") : "";
  }
  std::string at_rest() const {
    return text(on_strips() ? text("strips = ", contact.strips, ", ") : "", positions * periods, " positions",
                meshes > 1 ? text(" of ", meshes, " meshes") : "", hunting());
  }
  std::string in_motion() const {
    return text(speeds(), " speeds of ", steps(), " steps in a mesh period at the middle speed", hunting(),
                "; fewer speeds, a higher lowest one or a lower min_sample_rate_kHz take less");
  }
};

Work work_of(const Scene& scene) {
  Work out{scene.fidelity, scene.contact, scene.operation,
           scene.time,     !scene.pair(), std::max(1, static_cast<int>(scene.operation.torques.size()))};
  const double points = !out.sliced()                   ? 1
                        : scene.contact.face_points > 0 ? scene.contact.face_points
                                                        : kFacePoints;
  for (const GearMeshSpec& mesh : scene.specs()) {
    size_t times = 1;
    for (const Scene::Carrier& carrier : scene.carriers)
      if (carrier.planet == mesh.gear[0] || carrier.planet == mesh.gear[1])
        times = carrier.planets > 0 ? static_cast<size_t>(carrier.planets) : carrier.positions.size();
    const auto meshes = static_cast<double>(times);
    out.meshes += meshes;
    out.contacts +=
        meshes * points * pairs_in_reach(scene.gear(mesh.gear[0]).design, scene.gear(mesh.gear[1]).design);
  }
  out.periods = hunting_periods(scene);
  out.positions = static_positions(scene);
  return out;
}

// At rest 0.16 ms a position of a pair, on strips with the 2.3th power of their number; of a train, whose meshes share bodies, more.
StageCost statics_of(const Work& work) {
  constexpr double kPair = 0.02 / 128, kMesh = 1e-3, kMeshOnLines = 1e-4,
                   kPoints = 1.5e-6;  // s; s of two points
  constexpr double kDefaultStrips = 8, kGrowth = 2.3;
  const double strips = work.on_strips() ? std::pow(work.contact.strips / kDefaultStrips, kGrowth) : 1,
               mesh = !work.train        ? kPair
                      : work.on_strips() ? kMesh
                                         : kMeshOnLines,
               each = work.sliced() ? kPoints * work.contacts * work.contacts : mesh * work.meshes * strips;
  return {"gear-static", kStart + each * work.positions * work.periods, kMemory, work.torques,
          work.at_rest()};
}

// Of a step, with its share of the positions that a number of steps has: three gears in line, 5 us; oh58-planetary, 15 us;
// helical-planetary with 4 and 8 points on a line, 80 and 570 us.
double step_of(const Work& work) {
  constexpr double kStrips = 0.08e-6, kStrip = 0.01e-6, kPoint = 0.14e-6, kContact = 0.85e-6,
                   kSolved = 1.2e-10;  // s
  const double n = work.contacts;
  if (work.train) return kContact * n + kSolved * n * n * n;
  return work.sliced() ? kPoint * n : kStrips + (work.on_strips() ? kStrip * work.contact.strips : 0);
}

// A speed settles in some mesh periods, where teeth differ in some of the periods after which the same meet, of which one is stored.
StageCost sweep_of(const Work& work) {
  constexpr double kStored = 8e-3, kBytes = 96;  // s; of two points and a step
  constexpr double kSettlingPeriods = 20, kSettlingTurns = 8;
  const double periods = std::max(kSettlingPeriods, work.periods > 1 ? kSettlingTurns * work.periods : 0),
               points = work.train && work.sliced() ? work.contacts : 0;
  return {"gear-sweep",
          kStart + work.speeds() * (kStored * work.periods + step_of(work) * periods * work.steps()),
          kMemory + kBytes * points * points * work.steps_at(work.operation.frequency_from), 2 * work.torques,
          work.in_motion()};
}

}  // namespace

std::vector<StageCost> stage_costs(const Scene& scene) {
  std::vector<StageCost> out;
  add_reductions(scene, out);
  const Work work = work_of(scene);
  out.push_back(statics_of(work));
  if (work.speeds() > 0 && work.fidelity.width != WidthModel::body) out.push_back(sweep_of(work));
  return out;
}

std::vector<std::string> costs(const Scene& scene) {
  std::vector<std::string> out;
  if (scene.rigid()) return out;
  for (const StageCost& stage : stage_costs(scene))
    if (const double s = stage.seconds; s > (stage.stage == "gear-sweep" ? 10 : 1) * kMinute) {
      const double all = s / kMinute, digit = std::pow(10, std::floor(std::log10(all)));
      out.push_back(text(stage.stage, " takes about ", std::round(all / digit) * digit, " min: ", stage.by));
    }
  if (scene.fidelity.body == BodyModel::full)
    out.push_back(
        "body = \"full\" finds all modes by dense algebra: about a minute a gear for a thousand unknowns a sector, eight times that for twice as many");
  return out;
}

}  // namespace whine
