// What an artifact was made from, in the keys and units of a scene.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "model/system_stages.h"
#include "results/jump_map.h"
#include "results/response.h"
#include "results/static.h"

namespace whine {

// A key of a scene with its value as a scene would have it, in the unit of its name. Keys of gears and materials have a value
// for driver and driven gear each, others one.
struct SceneKey {
  std::string section, name;
  std::array<std::string, kSides> value;  // of driver and driven gear
  std::string meaning;
};

// What an artifact was made from, but for torques and speeds; of a static.h5 without what concerns motion. Sections that
// neither gear has (modification, error, crack) are left out.
std::vector<SceneKey> scene_keys_of(const StaticResult& artifact);
std::vector<SceneKey> scene_keys_of(const ResponseResult& artifact);

// The same of a system: a value for each gear, or one of all. Sections of a mesh are "mesh sun-planet".
struct SystemKeys {
  std::vector<std::string> gears;
  struct Row {
    std::string section, name;
    std::vector<std::string> value;  // [gear], or one
    std::string meaning;
  };
  std::vector<Row> rows;
};
// moving: with what concerns motion; nullptr: without. Positions, torques and what is held are left out.
SystemKeys scene_keys_of(const SystemStaticResult& artifact, const SystemSweepParameters* moving);

// What two maps were made from that differs, in a scene's keys and units: "bore_radius_mm 40 -> 35"; "" if nothing
// does. Gears by the driver's, if both gears changed alike.
std::string changed_keys(const JumpMapResult& from, const JumpMapResult& to);

}  // namespace whine
