#include "system/near_interference.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/format.h"
#include "base/units.h"
#include "contact/half_plane_strip.h"
#include "gear/face_width.h"
#include "gear/involute_start.h"
#include "gear/system_layout.h"
#include "system/load_balance.h"
#include "system/undamped_depth.h"

namespace whine {
namespace {

constexpr double kSlopeAtTip = 17;  // of a tooth: times load / (E b m)

struct NearEnd {
  int side = -1;          // whose involute ends within the pressure; -1: none
  double half_width = 0;  // m
};

// Share of the load that a pair has at a place (m) of its path.
double share(const GearPair& gears, double path, ForceBound force) {
  if (force == ForceBound::largest) return 1;
  const double pairs = std::ceil(gears.contact_ratio()), least = 1 / (2 * pairs - 1),
               from_end = std::min(path - gears.path_start(), gears.path_end() - path),
               shared = (gears.contact_ratio() - pairs + 1) * gears.base_pitch();
  return least * (1 + std::min(1.0, from_end / shared));
}

// slope: of the teeth of either gear loaded at their tips, N-1.
NearEnd near_end(const GearPair& gears, double coefficient, const std::array<double, kSides>& slope,
                 double load, ForceBound force) {
  constexpr int kPlaces = 400;
  for (int i = 0; i <= kPlaces; ++i) {
    const double path = gears.path_start() + (gears.path_end() - gears.path_start()) * i / kPlaces;
    const double radius = gears.relative_curvature_radius(path), own = load * share(gears, path, force),
                 half_width = std::sqrt(2 * radius * coefficient * own),
                 moved = force == ForceBound::least ? radius * own : 0;
    const int side = side_at_root(gears, gears.contact(path / gears.base_pitch()),
                                  moved * slope[1] - half_width, half_width - moved * slope[0]);
    if (side >= 0) return {side, half_width};
  }
  return {};
}

}  // namespace

std::string near_interference(const SceneGear& driver, const SceneGear& driven, const GearMeshSpec& mesh,
                              double load, ForceBound force) {
  std::array<GearDesign, kSides> design{driver.design, driven.design};
  const std::array<std::string, kSides> name{driver.name, driven.name};
  const double width = contact_width(driver.design, driven.design);
  double coefficient = 0;
  std::array<double, kSides> slope{};
  for (const SceneGear* gear : {&driver, &driven}) {
    coefficient +=
        HalfPlaneSurface(in_contact_plane(gear->material, mesh.contact_plane), width).coefficient();
    slope[gear == &driver ? 0 : 1] =
        kSlopeAtTip / (gear->material.youngs_modulus * gear->design.face_width * gear->design.module);
  }
  const GearPair gears(design[0], design[1], mesh.centre_distance);
  // Teeth bend away in proportion to the load, pressure spreads by its root: what touches under a part of it counts.
  const double least_part = force == ForceBound::least ? 1e-4 : 1;
  double under = load;
  NearEnd end = near_end(gears, coefficient, slope, under, force);
  for (; end.side < 0 && under > least_part * load; under /= 2)
    end = near_end(gears, coefficient, slope, under / 2, force);
  if (end.side < 0) return "";
  const auto own = static_cast<size_t>(end.side), mate = 1 - own;
  const double reached = gears.nominal_roll(end.side, end.side == 0 ? gears.path_start() : gears.path_end());
  // The highest addendum of the mate that leaves room.
  constexpr double kStep = 0.01, kLeast = 0.5;
  double room = 0;
  while (room == 0 && design[mate].addendum > kLeast) {
    design[mate].addendum = std::round((design[mate].addendum - kStep) * 1e4) / 1e4;
    try {
      if (near_end(GearPair(design[0], design[1], mesh.centre_distance), coefficient, slope, load,
                   ForceBound::largest)
              .side < 0)
        room = design[mate].addendum;
    } catch (const Error&) {
      break;
    }
  }
  return text(
      "under ", shown_number(under), " N", under < load ? ", a part of the load," : "", " the pressure, ",
      shown_number(end.half_width * 1e3), " mm to each side, reaches the start of the involute of '",
      name[own], "' at roll angle ", shown_number(gears.gear(end.side).form_roll_angle() * kInDegrees),
      " deg: the tip of '", name[mate], "' comes to ", shown_number(reached * kInDegrees), " deg; ",
      room > 0 ? text("addendum = ", shown_number(room), " in [gear.", name[mate], "] is short enough")
               : text("shorten that tip or deepen the root (dedendum)"),
      ", or lower the torque");
}

std::vector<std::pair<size_t, std::string>> near_interferences(const Scene& scene, const System& layout,
                                                               ForceBound force) {
  const auto under = [&](const GearMeshSpec& mesh, double load, ForceBound bound) {
    return near_interference(scene.gear(mesh.gear[0]), scene.gear(mesh.gear[1]), mesh, load, bound);
  };
  std::vector<std::pair<size_t, std::string>> out;
  if (scene.pair()) {
    const double torque = *std::max_element(scene.operation.torques.begin(), scene.operation.torques.end()),
                 radius = ToothGeometry(scene.gear(scene.mesh().gear[0]).design).base_radius();
    const std::string words = under(scene.mesh(), torque / radius, force);
    if (!words.empty())
      out.emplace_back(0, words + torque_in_n_mm(torque, [&](double less) {
                            return under(scene.mesh(), less / radius, ForceBound::largest).empty();
                          }));
    return out;
  }
  const std::vector<GearMeshSpec> specs = scene.specs();
  const std::vector<int> sections = sections_of(specs, gears_of(scene, layout), layout);
  const LoadBalance balance = load_balance(layout);
  for (size_t m = 0; m < layout.meshes.size(); ++m) {
    const auto section = static_cast<size_t>(sections[m]);
    // Planets are alike.
    if (!out.empty() && out.back().first == section) continue;
    const std::string words =
        under(specs[section], std::max(0.0, balance.load[static_cast<Eigen::Index>(m)]), force);
    if (!words.empty()) out.emplace_back(section, words);
  }
  return out;
}

}  // namespace whine
