#include "gear/scene_geometry.h"

#include <vector>

#include "base/error.h"
#include "gear/body_inertia.h"
#include "gear/crack.h"
#include "gear/numbers.h"
#include "gear/pair.h"

namespace whine {
namespace {

// What `make` throws, with the place and the heading of a section before it.
template <class Make>
void in_section(const ScenePlace& where, const std::string& heading, const std::vector<std::string>& sections,
                const Make& make) {
  try {
    make();
  } catch (const Error& error) {
    fail(error.kind(), where(sections, error.what()), ": ", heading, ": ", error.what());
  }
}

}  // namespace

void check_geometry(const Scene& scene, const ScenePlace& where) {
  const auto in = [&](const std::string& heading, const std::vector<std::string>& sections,
                      const auto& make) { in_section(where, heading, sections, make); };
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
  in("[[mesh]]", {"mesh", "gear." + scene.mesh.gear[1], "gear." + scene.mesh.gear[0]}, [&] {
    GearPair pair(scene.gear(scene.mesh.gear[0]).design, scene.gear(scene.mesh.gear[1]).design,
                  scene.mesh.centre_distance);
  });
}

void check_inertia(const Scene& scene, const ScenePlace& where) {
  for (const SceneGear& gear : scene.gears) {
    const std::string section = "gear." + gear.name;
    in_section(where, "[" + section + "]", {section}, [&] {
      const double least = least_body_inertia(ToothGeometry(gear.design), gear.material);
      if (gear.total_inertia != 0 && gear.total_inertia < least)
        fail(Failure::input, too_light(gear.total_inertia, "by its drawing at least " + shown_number(least)));
    });
  }
}

}  // namespace whine
