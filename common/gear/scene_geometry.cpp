#include "gear/scene_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "base/refusal.h"
#include "files/scene_place.h"
#include "gear/crack.h"
#include "gear/numbers.h"
#include "gear/pair.h"

namespace whine {
namespace {

// least: words for the body's own, without the unit.
std::string too_light(double inertia, const std::string& least) {
  return text("total_inertia_kgm2 = ", shown_number(inertia), " lies below the inertia of its own body, ",
              least, " kg m2: it is that of all that turns with the gear; raise it");
}

// What `make` throws, with the place and the heading of a section before it.
template <class Make>
void in_section(const std::string& where, bool is_file, const std::string& heading,
                const std::vector<std::string>& sections, const Make& make) {
  try {
    make();
  } catch (const Error& error) {
    fail(error.kind(), is_file ? scene_place(where, sections, error.what()) : where, ": ", heading, ": ",
         error.what());
  }
}

}  // namespace

void check_geometry(const Scene& scene, const std::string& where, bool is_file) {
  const auto in = [&](const std::string& heading, const std::vector<std::string>& sections,
                      const auto& make) { in_section(where, is_file, heading, sections, make); };
  for (const SceneGear& gear : scene.gears) {
    const auto in_part = [&](const std::string& part, const auto& make) {
      const std::string section = "gear." + gear.name + part;
      in("[" + section + "]", {section, "gear." + gear.name}, make);
    };
    in_part("", [&] {
      const ToothGeometry tooth(gear.design);
      if (gear.design.crack.depth > 0) crack_slit(tooth);
    });
    in_part(".modification", [&] { FlankDeviation(ToothGeometry(gear.design), gear.modification); });
    in_part(".error", [&] { FlankDeviation(ToothGeometry(gear.design), gear.modification, gear.errors); });
  }
  in("[[mesh]]", {"mesh", "gear." + scene.mesh.driven, "gear." + scene.mesh.driver}, [&] {
    GearPair pair(scene.gear(scene.mesh.driver).design, scene.gear(scene.mesh.driven).design,
                  scene.mesh.centre_distance);
  });
}

void check_inertia(const Scene& scene, const std::string& where, bool is_file) {
  for (const SceneGear& gear : scene.gears) {
    const std::string section = "gear." + gear.name;
    in_section(where, is_file, "[" + section + "]", {section}, [&] {
      const double least = least_body_inertia(ToothGeometry(gear.design), gear.material);
      if (gear.total_inertia != 0 && gear.total_inertia < least)
        fail(Failure::input, too_light(gear.total_inertia, "by its drawing at least " + shown_number(least)));
    });
  }
}

double least_body_inertia(const ToothGeometry& tooth, const Material& material) {
  constexpr int kSteps = 400;
  // Chords of a coarse mesh cut off less.
  constexpr double kSafe = 0.995;
  const GearDesign& design = tooth.design();
  const double root = tooth.root_radius(), tip = tooth.tip_radius(), bore = design.bore_radius;
  const double form = tooth.base_radius() * std::hypot(1.0, tooth.form_roll_angle());
  // Below the involute a tooth only widens.
  const auto angle = [&](double r) {
    const double within = std::max(r, form);
    return tooth.thickness_at_radius(within) / within;
  };
  double teeth = 0;
  const double step = (tip - root) / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double r = root + (i + 0.5) * step;
    teeth += design.teeth * angle(r) * r * r * r * step;
  }
  return kSafe * material.density * design.face_width *
         (0.5 * std::numbers::pi * (std::pow(root, 4) - std::pow(bore, 4)) + teeth);
}

void as_drawn(ImpactSlice& slice, const BodyArtifact& driver, const BodyArtifact& driven) {
  constexpr double kMore = 1.001;
  if (slice.driver_inertia == 0) slice.driver_inertia = kMore * driver.inertia;
  if (slice.driven_inertia == 0) slice.driven_inertia = kMore * driven.inertia;
}

void as_drawn(ImpactSlice& slice, const StaticArtifact& s) {
  constexpr double kFillets = 1.015;
  const auto drawn = [&](const GearDesign& design, const Material& material) {
    return kFillets * least_body_inertia(ToothGeometry(design), material);
  };
  if (slice.driver_inertia == 0) slice.driver_inertia = drawn(s.driver, s.driver_material);
  if (slice.driven_inertia == 0) slice.driven_inertia = drawn(s.driven, s.driven_material);
}

void require_inertia(const GearMeshSpec& mesh, const std::array<const BodyArtifact*, 2>& bodies,
                     const std::array<double, 2>& inertia) {
  for (size_t g = 0; g < kSides; ++g)
    if (!(inertia[g] > bodies[g]->inertia))
      refuse(Failure::input, "[gear.", mesh.gear(static_cast<int>(g)),
             "] of the scene: ", too_light(inertia[g], shown_number(bodies[g]->inertia)));
}

}  // namespace whine
