#include "gear/scene_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "base/error.h"
#include "base/format.h"
#include "gear/body_inertia.h"
#include "gear/contact_lines.h"
#include "gear/crack.h"
#include "gear/face_width.h"
#include "gear/handbook_sign.h"
#include "gear/pair.h"
#include "gear/remedy.h"
#include "gear/system_layout.h"
#include "gear/undercut.h"

namespace whine {
namespace {

// What `make` throws, with the place and the heading of a section before it. The remedy is one of all gears of the scene.
template <class Make>
void in_section(const ScenePlace& where, const std::string& heading, const std::vector<std::string>& sections,
                const DrawnGears& gears, const Make& make) {
  try {
    make();
  } catch (const Error& error) {
    fail(error.kind(), where(sections, error.what()), ": ", heading, ": ", with_remedy(error.what(), gears));
  }
}

void check_gear(const SceneGear& gear, const DrawnGears& gears, const ScenePlace& where) {
  const auto in_part = [&](const std::string& part, const auto& make) {
    const std::string section = "gear." + gear.name + part;
    in_section(where, "[" + section + "]", {section, "gear." + gear.name}, gears, make);
  };
  in_part("", [&] {
    const ToothGeometry tooth(gear.design);
    if (gear.design.crack.depth > 0) crack_slit(tooth);
  });
  in_part(".modification", [&] {
    [[maybe_unused]] const FlankDeviation flank(ToothGeometry(gear.design), gear.modification);
    [[maybe_unused]] const LeadDeviation lead(gear.modification.lead, gear.design.face_width);
  });
  in_part(".error", [&] {
    [[maybe_unused]] const FlankDeviation flank(ToothGeometry(gear.design), gear.modification, gear.errors);
  });
}

}  // namespace

void check_geometry(const Scene& scene, const ScenePlace& where) {
  const DrawnGears gears = drawn_gears(scene);
  for (const SceneGear& gear : scene.gears) check_gear(gear, gears, where);
  if (!scene.pair()) return;
  const std::string &driver = scene.mesh().gear[0], &driven = scene.mesh().gear[1];
  in_section(where, "[[mesh]]", {"mesh", "gear." + driven, "gear." + driver}, gears, [&] {
    GearPair(scene.gear(driver).design, scene.gear(driven).design, scene.mesh().centre_distance);
  });
}

void check_inertia(const Scene& scene, const ScenePlace& where) {
  for (const SceneGear& gear : scene.gears) {
    const std::string section = "gear." + gear.name;
    in_section(where, "[" + section + "]", {section}, {}, [&] {
      const double least = least_body_inertia(ToothGeometry(gear.design), gear.material);
      if (gear.total_inertia != 0 && gear.total_inertia < least)
        fail(Failure::input, too_light(gear.total_inertia, "by its drawing at least " + shown_number(least)));
    });
  }
}

std::string thin_rim(const GearDesign& design, const std::string& name) {
  const double rim = std::abs(ToothGeometry(design).root_radius() - design.clamped_radius());
  if (rim >= design.module || design.elastic_rim()) return "";
  const char* const key = design.internal ? "rim_outer_radius_mm" : "bore_radius_mm";
  return text(
      "between the ", design.internal ? "outside of the rim" : "bore", " and the root circle of [gear.", name,
      "] are ", rim * 1e3, " mm, less than a module: ", key, " is the radius ",
      design.internal ? "outside" : "inside",
      " which the gear is rigid, so a thin rim makes the teeth stiffer here than on a real rim. Check ", key);
}

std::string flywheel(const GearDesign& design, const Material& material, double inertia,
                     const std::string& name) {
  constexpr double kMost = 100;  // times the inertia of the drawing: more than what shafts and couplings add
  const double own = least_body_inertia(ToothGeometry(design), material);
  if (inertia <= kMost * own) return "";
  return text("total_inertia_kgm2 = ", inertia, " of [gear.", name, "] is ", std::round(inertia / own),
              " times that of the gear as drawn, ", shown_number(own), "; check its unit, kg m2");
}

namespace {

constexpr double kOrdinaryBacklash = 0.1, kLargestBacklash = 0.2;  // modules, on the line of action

double backlash_of(const DrawnGears& gears, const DrawnGears::Mesh& mesh) {
  return GearPair(gears.design[mesh.first], gears.design[mesh.second], mesh.centre_distance).backlash();
}

// The shift of a gear of the mesh that has the other sign in a drawing with an ordinary backlash; "" if there is none.
std::string ordinary_with_other_sign(const DrawnGears& gears, const DrawnGears::Mesh& mesh) {
  for (const size_t g : {mesh.first, mesh.second}) {
    if (gears.design[g].profile_shift == 0) continue;
    DrawnGears other = gears;
    GearDesign& design = other.design[g];
    design.profile_shift = -design.profile_shift;
    // Distances of axes are rounded: a little less than none is meant as none.
    constexpr double kRounded = 0.02;  // modules
    design.tooth_thinning += kRounded * design.module;
    if (!fault(other).empty()) continue;
    const double backlash =
        backlash_of(other, mesh) - kRounded * design.module * std::cos(design.pressure_angle);
    if (backlash <= kOrdinaryBacklash * design.module)
      return text("with profile_shift = ", shown_number(design.profile_shift), " in [gear.", gears.name[g],
                  "] it would be ", millimetres(backlash), backlash < 0 ? ", about none" : "");
  }
  return "";
}

// Gears that mesh with more backlash than drawings have: an error of sign or of the distance of the axes leaves them so.
void warn_of_backlash(const DrawnGears& gears, const ScenePlace& where, std::vector<std::string>& out) {
  for (const DrawnGears::Mesh& mesh : gears.mesh) {
    const GearDesign &first = gears.design[mesh.first], &second = gears.design[mesh.second];
    const double backlash = backlash_of(gears, mesh), modules = backlash / first.module;
    const std::string is = text("the backlash of ", gears.name[mesh.first], "-", gears.name[mesh.second],
                                " is ", millimetres(backlash), " (", shown_number(modules), " modules)");
    if (const auto shift = shift_of_other_sign(first, second, mesh.centre_distance)) {
      const std::string section = "gear." + gears.name[first.internal ? mesh.first : mesh.second];
      out.push_back(where({section}, "profile_shift") + ": [" + section + "]: " + is + "; " +
                    other_sign_words(*shift));
    } else if (modules > kLargestBacklash) {
      const std::string other = ordinary_with_other_sign(gears, mesh);
      out.push_back(
          where({"gear." + gears.name[mesh.first], "gear." + gears.name[mesh.second]}, "profile_shift") +
          ": " + is + " along the line of action, above " + shown_number(kLargestBacklash) +
          ": drawings have below " + shown_number(kOrdinaryBacklash) + "; " +
          (other.empty() ? "check centre_distance_mm, profile_shift and tooth_thinning_mm" : other));
    }
  }
}

}  // namespace

std::vector<std::string> scene_warnings(const Scene& scene, const ScenePlace& where) {
  std::vector<std::string> out;
  warn_of_backlash(drawn_gears(scene), where, out);
  if (scene.rigid()) return out;
  for (const SceneGear& gear : scene.gears)
    for (const std::string& words : {undercut_words(gear.design, gear.name), thin_rim(gear.design, gear.name),
                                     flywheel(gear.design, gear.material, gear.total_inertia, gear.name)})
      if (!words.empty()) out.push_back(where({"gear." + gear.name}, words) + ": " + words);
  std::set<std::string> meshed;
  for (const auto& [mesh, direction, stiffness] : scene.meshes) {
    meshed.insert(mesh.gear.begin(), mesh.gear.end());
    const std::string words = shortened_path_words(
        {scene.gear(mesh.gear[0]).design, scene.gear(mesh.gear[1]).design, mesh.centre_distance}, mesh.gear);
    if (!words.empty()) out.push_back(where({"mesh"}, words) + ": " + words);
  }
  for (const SceneGear& gear : scene.gears)
    if (!meshed.contains(gear.name))
      out.push_back(text(where({"gear." + gear.name}, ""), ": [gear.", gear.name,
                         "] is in no [[mesh]] and carries nothing; ", kOneShaft));
  return out;
}

std::vector<std::string> scene_remarks(const Scene& scene) {
  std::vector<std::string> out;
  if (scene.rigid() || scene.gears.empty()) return out;
  for (const GearMeshSpec& mesh : scene.specs()) {
    const auto& [driver, driven] = mesh.gear;
    const std::string words =
        width_words(scene.gear(driver).design, driver, scene.gear(driven).design, driven);
    if (!words.empty()) out.push_back(words);
  }
  const double fewest =
      scene.body.element_order == 1 ? 7 : 3.5;  // a module, measured: common/solid/README.md
  const auto gear =
      std::min_element(scene.gears.begin(), scene.gears.end(),
                       [](const auto& a, const auto& b) { return a.design.module < b.design.module; });
  const double elements = gear->design.module / scene.body.element_size;  // infinite: left open
  if (elements < fewest)
    out.push_back(text("element_mm = ", scene.body.element_size * 1e3, " puts ", shown_number(elements),
                       " elements of order ", scene.body.element_order, " on a module of [gear.", gear->name,
                       "]: with fewer than ", fewest, " root stress is off by more than 1 %; leave it out"));
  return out;
}

}  // namespace whine
