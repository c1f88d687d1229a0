#include "gear/remedy.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/error.h"
#include "base/format.h"
#include "gear/handbook_sign.h"
#include "gear/helix.h"
#include "gear/pair.h"

namespace whine {
namespace {

constexpr double kStep = 0.01;  // modules, of a single change
constexpr double kLeastHeight = 0.5,
                 kLargestHeight = 2;  // modules, of the addenda and dedenda that are proposed
constexpr double kLeastShift = -1, kLargestShift = 1.5;  // modules
constexpr double kRound = 1e5;                           // m-1: centre distances and radii to 0.01 mm

// A number of a drawing, or two that go together, and what a step of it costs against one of a profile shift.
struct Lever {
  double cost = 1;
  // The changes that a step (modules) makes; none if it leads out of the ordinary.
  std::function<std::vector<Change>(double)> at;
};

std::vector<Change> within(const Change& change, double least, double most) {
  if (change.value < least || change.value > most) return {};
  return {change};
}

double to_step(double modules) {
  return std::round(modules * 1e4) / 1e4;
}

Change shift(const DrawnGears& gears, size_t g, double step) {
  return {false, g, "profile_shift", &GearDesign::profile_shift,
          to_step(gears.design[g].profile_shift + step)};
}

bool ordinary(const Change& shifted) {
  return shifted.value >= kLeastShift && shifted.value <= kLargestShift;
}

double root_radius(const GearDesign& drawn) {
  const GearDesign d = transverse_section(drawn);
  return d.module * (0.5 * d.teeth + (d.internal ? 1 : -1) * (d.dedendum - d.profile_shift));
}

// What holds the body: of an external gear its bore, of an internal one the outside of its rim.
std::vector<Change> held(const GearDesign& d, size_t g, double step) {
  const double radius = root_radius(d) + (d.internal ? 1 : -1) * std::abs(step) * d.module;
  if (!(radius > 0)) return {};
  return {{false, g, d.internal ? "rim_outer_radius_mm" : "bore_radius_mm",
           d.internal ? &GearDesign::rim_outer_radius : &GearDesign::bore_radius,
           (d.internal ? std::ceil(radius * kRound - 1e-6) : std::floor(radius * kRound + 1e-6)) / kRound}};
}

// Bores beyond their roots and rims within them: nothing of the teeth is wrong. A rim of one module.
std::vector<Change> misheld(const DrawnGears& gears) {
  std::vector<Change> out;
  for (size_t g = 0; g < gears.design.size(); ++g) {
    const GearDesign& d = gears.design[g];
    if (d.clamped_radius() == 0 ||
        (d.internal ? d.rim_outer_radius > root_radius(d) : d.bore_radius < root_radius(d)))
      continue;
    for (const Change& one : held(d, g, 1)) out.push_back(one);
  }
  return out;
}

void add_gear_levers(const DrawnGears& gears, size_t g, std::vector<Lever>& out) {
  const GearDesign& d = gears.design[g];
  out.push_back(
      {1, [&gears, g](double step) { return within(shift(gears, g, step), kLeastShift, kLargestShift); }});
  out.push_back({1, [&d, g](double step) {
                   return within({false, g, "addendum", &GearDesign::addendum, to_step(d.addendum + step)},
                                 kLeastHeight, kLargestHeight);
                 }});
  out.push_back({1.3, [&d, g](double step) {
                   return within({false, g, "dedendum", &GearDesign::dedendum, to_step(d.dedendum + step)},
                                 kLeastHeight, kLargestHeight);
                 }});
  out.push_back({0.5, [&d, g](double step) {
                   return step < 0 ? within({false, g, "rack_tip_radius", &GearDesign::rack_tip_radius,
                                             to_step(d.rack_tip_radius + step)},
                                            0, 1)
                                   : std::vector<Change>{};
                 }});
  const bool fits = d.internal ? d.rim_outer_radius > 0 : d.bore_radius > 0;
  if (fits)
    out.push_back(
        {0.5, [&d, g](double step) { return step > 1 ? held(d, g, step) : std::vector<Change>{}; }});
}

// Of both gears, below 0 of an internal one.
double teeth_of(const GearDesign& a, const GearDesign& b) {
  return (a.internal ? -1 : 1) * a.teeth + (b.internal ? -1 : 1) * b.teeth;
}

// m: of the axes, at a working pressure angle of 0.
double base_distance(const GearDesign& drawn, const GearDesign& b) {
  const GearDesign a = transverse_section(drawn);
  return 0.5 * std::abs(teeth_of(drawn, b)) * a.module * std::cos(a.pressure_angle);
}

// m: of the axes, where the involute function of the working pressure angle is `wanted`, above 0; rounded to the side on which there is more
// backlash.
double distance_at(const GearDesign& a, const GearDesign& b, double wanted) {
  double low = 0, high = 1.5;  // rad
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (involute_function(middle) < wanted ? low : high) = middle;
  }
  const double exact = base_distance(a, b) / std::cos(low) * kRound;
  return (teeth_of(a, b) > 0 ? std::ceil(exact - 1e-6) : std::floor(exact + 1e-6)) / kRound;
}

// Of a pair: one shift against the other, the distance of the axes, a shift with the distance that keeps the backlash.
void add_pair_levers(const DrawnGears& gears, std::vector<Lever>& out) {
  const DrawnGears::Mesh& mesh = gears.mesh[0];
  const GearDesign &a = gears.design[mesh.first], &b = gears.design[mesh.second];
  const auto distance = [&mesh](double metres) {
    return Change{true, 0, "centre_distance_mm", nullptr, std::round(metres * kRound) / kRound};
  };
  out.push_back({1.2, [&gears, &mesh](double step) {
                   const Change up = shift(gears, mesh.first, step), down = shift(gears, mesh.second, -step);
                   return ordinary(up) && ordinary(down) ? std::vector{up, down} : std::vector<Change>{};
                 }});
  out.push_back({0.8, [&a, &mesh, distance](double step) {
                   return std::vector{distance(mesh.centre_distance + step * a.module)};
                 }});
  for (const size_t g : {mesh.first, mesh.second})
    out.push_back({1.4, [&gears, &mesh, &a, &b, g, distance](double step) -> std::vector<Change> {
                     const double cosine = base_distance(a, b) / mesh.centre_distance;
                     if (!(cosine < 1)) return {};
                     const double wanted = involute_function(std::acos(cosine)) +
                                           2 * step * std::tan(a.pressure_angle) / teeth_of(a, b);
                     const Change shifted = shift(gears, g, step);
                     if (!(wanted > 0) || !ordinary(shifted)) return {};
                     return {shifted, distance(distance_at(a, b, wanted))};
                   }});
}

struct Try {
  double cost;
  std::vector<Change> changes;
};

// Roots that the mate's tips reach since the dedendum is low: that with a clearance of a quarter of a module, of all of them.
std::vector<Change> deeper_roots(const DrawnGears& gears) {
  constexpr double kOrdinary = 1.25, kClearance = 0.25, kNone = 1e-6;  // modules
  std::vector<Change> out;
  for (const DrawnGears::Mesh& mesh : gears.mesh)
    for (const auto& [own, mate] : {std::pair{mesh.first, mesh.second}, std::pair{mesh.second, mesh.first}}) {
      const GearDesign &d = gears.design[own], other = transverse_section(gears.design[mate]);
      const double tip = other.module * (0.5 * other.teeth +
                                         (other.internal ? -1 : 1) * (other.addendum + other.profile_shift));
      const double clearance = (d.internal       ? root_radius(d) - mesh.centre_distance - tip
                                : other.internal ? tip - mesh.centre_distance - root_radius(d)
                                                 : mesh.centre_distance - tip - root_radius(d)) /
                               d.module;
      const Change deeper{false, own, "dedendum", &GearDesign::dedendum,
                          to_step(d.dedendum + kClearance - clearance)};
      if (d.dedendum < kOrdinary && clearance < kNone && deeper.value <= kLargestHeight &&
          std::none_of(out.begin(), out.end(), [own = own](const Change& one) { return one.number == own; }))
        out.push_back(deeper);
    }
  return out;
}

// Gears of a pair that are undercut get the shifts that undo it: against each other, or both with the distance of the axes that keeps
// the backlash.
void add_shifts_of_undercut(const DrawnGears& gears, std::vector<Try>& tries) {
  const DrawnGears::Mesh& mesh = gears.mesh[0];
  const GearDesign &a = gears.design[mesh.first], &b = gears.design[mesh.second];
  std::vector<size_t> undercut;
  for (const size_t g : {mesh.first, mesh.second})
    if (!gears.design[g].internal && shift_without_undercut(gears.design[g]) > gears.design[g].profile_shift)
      undercut.push_back(g);
  constexpr int kMost = 60;
  const double cosine = base_distance(a, b) / mesh.centre_distance;
  for (int n = 1; n <= kMost && !undercut.empty() && cosine < 1; ++n) {
    std::vector<Change> changes;
    changes.reserve(undercut.size() + 1);
    for (const size_t g : undercut) changes.push_back(shift(gears, g, n * kStep));
    if (undercut.size() == 1)
      changes.push_back(shift(gears, undercut[0] == mesh.first ? mesh.second : mesh.first, -n * kStep));
    if (!std::all_of(changes.begin(), changes.end(), ordinary)) break;
    if (undercut.size() == 2) {
      const double wanted =
          involute_function(std::acos(cosine)) + 4 * n * kStep * std::tan(a.pressure_angle) / teeth_of(a, b);
      changes.push_back({true, 0, "centre_distance_mm", nullptr, distance_at(a, b, wanted)});
    }
    tries.push_back({n * 1.0, changes});
  }
}

// The distance of the axes without backlash, where it is further away than steps lead: a distance of another pair, or in another unit.
void add_far_distance(const DrawnGears& gears, double farthest, std::vector<Try>& tries) {
  const DrawnGears::Mesh& mesh = gears.mesh[0];
  const GearDesign &a = gears.design[mesh.first], &b = gears.design[mesh.second];
  const double wanted = involute_function(transverse_section(a).pressure_angle) +
                        2 * (a.profile_shift + b.profile_shift) * std::tan(a.pressure_angle) / teeth_of(a, b);
  if (!(wanted > 0)) return;
  const double distance = distance_at(a, b, wanted), away = std::abs(distance - mesh.centre_distance);
  if (away > farthest * a.module)
    tries.push_back({away / (a.module * kStep), {{true, 0, "centre_distance_mm", nullptr, distance}}});
}

bool is_rejected(const std::function<void()>& make) {
  try {
    make();
    return false;
  } catch (const Error&) {
    return true;
  }
}

void make_mesh(const DrawnGears& gears, const DrawnGears::Mesh& mesh) {
  const GearPair pair(gears.design[mesh.first], gears.design[mesh.second], mesh.centre_distance);
}

// What is rejected by itself: a gear, or a mesh of gears that exist. Each wants a change of its own, and the check of one is cheap beside
// that of all.
struct Fault {
  std::vector<size_t> gears;  // one of which a change must be of
  size_t mesh = 0;            // or of this mesh
  bool of_mesh = false;

  bool touched(const std::vector<Change>& changes) const {
    return std::any_of(changes.begin(), changes.end(), [&](const Change& one) {
      return one.of_mesh ? of_mesh && one.number == mesh
                         : std::find(gears.begin(), gears.end(), one.number) != gears.end();
    });
  }
  bool mended(const DrawnGears& changed) const {
    return !is_rejected([&] {
      if (of_mesh)
        make_mesh(changed, changed.mesh[mesh]);
      else
        const ToothGeometry tooth(changed.design[gears[0]]);
    });
  }
};

std::vector<Fault> faults_of(const DrawnGears& gears) {
  std::vector<Fault> out;
  std::vector<char> exists(gears.design.size(), 1);
  for (size_t g = 0; g < gears.design.size(); ++g)
    if (is_rejected([&] { const ToothGeometry tooth(gears.design[g]); })) {
      exists[g] = 0;
      out.push_back({{g}});
    }
  for (size_t m = 0; m < gears.mesh.size(); ++m) {
    const DrawnGears::Mesh& mesh = gears.mesh[m];
    if (exists[mesh.first] && exists[mesh.second] && is_rejected([&] { make_mesh(gears, mesh); }))
      out.push_back({{mesh.first, mesh.second}, m, true});
  }
  return out;
}

std::vector<Change> cheapest(const DrawnGears& gears, const std::vector<Fault>& faults,
                             std::vector<Try>& tries) {
  constexpr size_t kMost = 60000;
  std::stable_sort(tries.begin(), tries.end(), [](const Try& a, const Try& b) { return a.cost < b.cost; });
  for (size_t i = 0; i < std::min(kMost, tries.size()); ++i) {
    const std::vector<Change>& changes = tries[i].changes;
    if (!std::all_of(faults.begin(), faults.end(), [&](const Fault& one) { return one.touched(changes); }))
      continue;
    DrawnGears changed = gears;
    change(changed, changes);
    if (std::all_of(faults.begin(), faults.end(), [&](const Fault& one) { return one.mended(changed); }) &&
        fault(changed).empty())
      return changes;
  }
  return {};
}

// What no change of these numbers mends.
bool beyond_help(const DrawnGears& gears) {
  return std::any_of(gears.mesh.begin(), gears.mesh.end(), [&](const DrawnGears::Mesh& mesh) {
    const GearDesign &a = gears.design[mesh.first], &b = gears.design[mesh.second];
    const GearDesign &ring = a.internal ? a : b, &pinion = a.internal ? b : a;
    const double base = a.module * std::cos(a.pressure_angle);
    return !helix_fault(a, b).empty() || (a.internal && b.internal) ||
           (ring.internal && ring.teeth <= pinion.teeth) ||
           std::abs(b.module * std::cos(b.pressure_angle) - base) > 1e-9 * base;
  });
}

void add_mesh(DrawnGears& out, const GearMeshSpec& mesh) {
  const auto number = [&](const std::string& name) {
    return static_cast<size_t>(std::find(out.name.begin(), out.name.end(), name) - out.name.begin());
  };
  const size_t first = number(mesh.gear[0]), second = number(mesh.gear[1]);
  if (first < out.name.size() && second < out.name.size())
    out.mesh.push_back({first, second, mesh.centre_distance});
}

}  // namespace

DrawnGears drawn_gears(const Scene& scene) {
  DrawnGears out;
  const auto add = [&](const SceneGear& gear) {
    out.name.push_back(gear.name);
    out.design.push_back(gear.design);
  };
  if (scene.pair())
    for (const std::string& name : scene.mesh().gear) add(scene.gear(name));
  else
    for (const SceneGear& gear : scene.gears) add(gear);
  for (const Scene::Mesh& mesh : scene.meshes) add_mesh(out, mesh.spec);
  return out;
}

std::string fault(const DrawnGears& gears) {
  try {
    for (const GearDesign& design : gears.design) const ToothGeometry tooth(design);
    for (const DrawnGears::Mesh& mesh : gears.mesh)
      const GearPair pair(gears.design[mesh.first], gears.design[mesh.second], mesh.centre_distance);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void change(DrawnGears& gears, const std::vector<Change>& changes) {
  for (const Change& one : changes)
    (one.of_mesh ? gears.mesh[one.number].centre_distance : gears.design[one.number].*one.member) = one.value;
}

std::vector<Change> remedy(const DrawnGears& gears) {
  if (std::vector<Change> holds = misheld(gears); !holds.empty()) {
    DrawnGears held_right = gears;
    change(held_right, holds);
    if (fault(held_right).empty()) return holds;
    const std::vector<Change> others = remedy(held_right);
    if (!others.empty()) holds.insert(holds.end(), others.begin(), others.end());
    return others.empty() ? others : holds;
  }
  const std::vector<Fault> faults = faults_of(gears);
  if (faults.empty() || beyond_help(gears)) return {};
  // What a designer does comes before the smallest change.
  std::vector<Try> usual;
  if (const std::vector<Change> deeper = deeper_roots(gears); !deeper.empty()) usual.push_back({0, deeper});
  if (gears.mesh.size() == 1) add_shifts_of_undercut(gears, usual);
  if (std::vector<Change> found = cheapest(gears, faults, usual); !found.empty()) return found;
  std::vector<Lever> levers;
  for (size_t g = 0; g < gears.design.size(); ++g) add_gear_levers(gears, g, levers);
  if (gears.mesh.size() == 1) add_pair_levers(gears, levers);

  std::vector<Try> tries;
  const auto add = [&](double cost, const std::vector<Change>& changes) {
    if (!changes.empty()) tries.push_back({cost, changes});
  };
  constexpr int kSteps = 150;
  for (const Lever& lever : levers)
    for (int n = -kSteps; n <= kSteps; ++n)
      if (n != 0) add(lever.cost * std::abs(n), lever.at(n * kStep));
  if (gears.mesh.size() == 1) add_far_distance(gears, kSteps * kStep, tries);
  if (std::vector<Change> one = cheapest(gears, faults, tries); !one.empty()) return one;

  // Two of them at once, in coarser steps.
  constexpr int kCoarse = 10, kCoarseSteps = 12;
  tries.clear();
  for (size_t i = 0; i < levers.size(); ++i)
    for (size_t j = i + 1; j < levers.size(); ++j)
      for (int n = -kCoarseSteps; n <= kCoarseSteps; ++n)
        for (int k = -kCoarseSteps; k <= kCoarseSteps; ++k) {
          std::vector<Change> first = n ? levers[i].at(n * kCoarse * kStep) : std::vector<Change>{},
                              second = k ? levers[j].at(k * kCoarse * kStep) : std::vector<Change>{};
          if (first.empty() || second.empty()) continue;
          const bool twice = std::any_of(first.begin(), first.end(), [&](const Change& a) {
            return std::any_of(second.begin(), second.end(), [&](const Change& b) {
              return a.of_mesh == b.of_mesh && a.number == b.number && a.member == b.member;
            });
          });
          if (twice) continue;
          first.insert(first.end(), second.begin(), second.end());
          add(levers[i].cost * std::abs(n) + levers[j].cost * std::abs(k), first);
        }
  return cheapest(gears, faults, tries);
}

std::string with_remedy(const std::string& words, const DrawnGears& gears) {
  if (fault(gears).empty()) return words;
  const std::string what = words.substr(0, words.rfind("; "));
  for (const DrawnGears::Mesh& mesh : gears.mesh)
    if (const auto shift =
            shift_of_other_sign(gears.design[mesh.first], gears.design[mesh.second], mesh.centre_distance))
      return what + "; " + other_sign_words(*shift);
  const std::vector<Change> changes = remedy(gears);
  if (changes.empty()) return words;
  DrawnGears changed = gears;
  change(changed, changes);
  std::string out;
  for (const Change& one : changes) {
    out += out.empty() ? "; all checks pass with " : " and ";
    if (one.of_mesh) {
      out += text(one.key, " = ", shown_number(one.value * 1e3), " in [[mesh]]");
      continue;
    }
    const bool length = std::string(one.key).ends_with("_mm"), bore = one.member == &GearDesign::bore_radius;
    out += text(one.key, " = ", shown_number(length ? one.value * 1e3 : one.value), bore ? " or less" : "",
                " in [gear.", gears.name[one.number], "]");
    const double given = gears.design[one.number].bore_radius;
    if (bore && given > one.value && given / 2 <= one.value)
      out += text(" (a rim of one module; ", shown_number(given * 1e3), " may be a diameter)");
    const GearDesign& d = changed.design[one.number];
    const double side = d.internal ? -1 : 1,
                 middle = d.teeth / std::cos(d.helix_angle) + 2 * side * d.profile_shift;
    const bool shifted = one.member == &GearDesign::profile_shift;
    std::string diameters;
    if (shifted || one.member == &GearDesign::addendum)
      diameters = text("tip_diameter_mm = ", shown_number(1e3 * d.module * (middle + 2 * side * d.addendum)));
    if (shifted || one.member == &GearDesign::dedendum)
      diameters +=
          text(diameters.empty() ? "" : ", ",
               "root_diameter_mm = ", shown_number(1e3 * d.module * (middle - 2 * side * d.dedendum)));
    if (!diameters.empty()) out += " (" + diameters + ")";
  }
  return what + out;
}

}  // namespace whine
