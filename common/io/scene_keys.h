// What an artifact was made from, in the keys and units of a scene.
#pragma once
#include <string>
#include <vector>

#include "model/system_stages.h"
#include "results/jump_map.h"
#include "results/response.h"
#include "results/static.h"

namespace whine {

// Keys of a scene with their values as a scene would have them, in the unit of their names: keys of gears and materials have a value
// for each gear, "" where it has none, others one. Sections of a mesh of a train are "mesh sun-planet".
struct SceneKeys {
  std::vector<std::string> gears;  // of a pair driver and driven gear
  struct Row {
    std::string section, name;
    std::vector<std::string> value;  // [gear], or one
    std::string meaning;
  };
  std::vector<Row> rows;
};

// What an artifact was made from, but for torques and speeds; of a static.h5 without what concerns motion. Sections that
// no gear has (modification, error, crack) are left out.
SceneKeys scene_keys_of(const StaticResult& artifact);
SceneKeys scene_keys_of(const ResponseResult& artifact);
// moving: with what concerns motion; nullptr: without. Positions, torques and what is held are left out.
SceneKeys scene_keys_of(const SystemStaticResult& artifact, const MotionSource* moving);

// What two maps were made from that differs, in a scene's keys and units: "bore_radius_mm 40 -> 35"; "" if nothing
// does. Gears by the driver's, if both gears changed alike.
std::string changed_keys(const JumpMapResult& from, const JumpMapResult& to);

}  // namespace whine
