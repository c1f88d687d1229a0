#include "gear/scene_geometry.h"

#include "base/error.h"
#include "gear/crack.h"
#include "gear/pair.h"

namespace whine {

void check_geometry(const Scene& scene, const std::string& path) {
  const auto in = [&](const std::string& section, const auto& make) {
    try {
      make();
    } catch (const Error& error) {
      fail(error.kind(), path, ": ", section, ": ", error.what());
    }
  };
  for (const SceneGear& gear : scene.gears) {
    in("[gear." + gear.name + "]", [&] {
      const ToothGeometry tooth(gear.design);
      if (gear.design.crack.depth > 0) crack_slit(tooth);
    });
    in("[gear." + gear.name + ".modification]",
       [&] { FlankDeviation(ToothGeometry(gear.design), gear.modification); });
    in("[gear." + gear.name + ".error]",
       [&] { FlankDeviation(ToothGeometry(gear.design), gear.modification, gear.errors); });
  }
  in("[[mesh]]", [&] {
    GearPair pair(scene.gear(scene.mesh.driver).design, scene.gear(scene.mesh.driven).design,
                  scene.mesh.centre_distance);
  });
}

}  // namespace whine
