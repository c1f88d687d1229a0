#include "io/scene_goals.h"

#include "base/error.h"
#include "io/make_request.h"

namespace whine {

SceneAbilities abilities(const Scene& scene) {
  SceneAbilities out;
  for (const std::string& gear : scene.mesh.gear) {
    out.teeth_differ |= !scene.gear(gear).errors.none();
    out.cracked |= scene.gear(gear).design.crack.depth > 0;
  }
  return out;
}

SceneAbilities abilities(const SystemScene& scene, const System& layout) {
  return {.pair = false,
          .elastic = !scene.rigid(),
          .planets = layout.meshes.size() > scene.meshes.size(),
          .moves = scene.operation.frequency_to > 0};
}

void check_goals(const SceneGoals& goals, const SceneAbilities& scene, const std::string& path) {
  const std::string which = "SCENE=" + path;
  if (scene.pair) {
    if (!goals.of_systems.empty()) {
      const std::string& goal = goals.of_systems.front();
      fail(Failure::input, which, ": it is a pair; ",
           goal.starts_with("mode") ? std::string("modes are") : goal + " is",
           " of systems, scenes of several meshes, carriers or drives");
    }
    if (listed_in(goals.of_pairs, "teeth") && (scene.teeth_differ || scene.cracked))
      fail(
          Failure::input, "teeth: ", which, " has teeth that ", scene.teeth_differ ? "differ" : "are cracked",
          ", and root stress, load sharing and error budget are of intact, equal teeth; for it there is: make ",
          which, " ",
          !scene.cracked       ? "tooth-loads sidebands"
          : scene.teeth_differ ? "fig01"
                               : "crack");
    return;
  }
  for (const std::string& goal : goals.of_systems) {
    if (goal.starts_with("mode")) continue;
    if (!scene.elastic)
      fail(Failure::input, which, ": its gears are rigid; ", goal,
           " needs elastic ones, for it there is: make ", which, " modes");
    if (goal != "system-static" && !scene.moves)
      fail(
          Failure::input, which,
          ": it says no speeds; write [operation] with mesh_frequency_Hz = { from = 500, to = 5000, step = 50 } into it");
  }
  for (const std::string& goal : goals.of_pairs) {
    const bool in_motion = scene.elastic && scene.moves;
    if (goal == "report" || (goal == "load-sharing" && scene.elastic && scene.planets) ||
        (goal == "order-cuts" && in_motion))
      continue;
    if (goal == "load-sharing")
      fail(Failure::input, "load-sharing: ", which,
           scene.elastic ? " has no planets that share a load"
                         : " has rigid gears, of which there are natural modes alone",
           ", use make ", which, " report");
    if (goal == "compare")
      fail(
          Failure::input, "SCENES: ", path,
          " is a system of several meshes, and compare sets pairs side by side; `make SCENE=... report` of each makes their own pages");
    fail(Failure::input, goal, ": ", which,
         " is a system of several meshes, carriers or drives; for it there is: make ", which,
         " report, or of it ", scene.elastic ? "system-static " : "",
         in_motion ? "system-sweep system-ringdown system-branch order-cuts " : "", "modes");
  }
}

}  // namespace whine
