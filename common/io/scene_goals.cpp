#include "io/scene_goals.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "io/make_request.h"

namespace whine {
namespace {

// Goals of pairs that take more than one slice over the face: helices, misalignment, lead modifications, width = "slices".
constexpr std::array kGoalsOfFace{"mesh", "reduce", "static", "flank-load"};
// And in motion, where width in [fidelity] asks for them.
constexpr std::array kGoalsOfSlices{
    "sweep",     "fig05", "fig07", "fig14-elastic", "order-cuts",     "waterfall",      "tooth-loads",
    "face-load", "sound", "runup", "branches",      "fig05-branches", "fig07-branches", "multipliers"};

// What a system must have for a goal; goals that do not stand here are of pairs alone.
enum class Needs { nothing, elastic_gears, speeds, planets };
struct SystemGoal {
  const char* name;
  Needs needs;
  bool of_pairs;
};
constexpr std::array kSystemGoals{SystemGoal{"report", Needs::nothing, true},
                                  SystemGoal{"mesh", Needs::elastic_gears, true},
                                  SystemGoal{"reduce", Needs::elastic_gears, true},
                                  SystemGoal{"static", Needs::elastic_gears, true},
                                  SystemGoal{"sweep", Needs::speeds, true},
                                  SystemGoal{"impact", Needs::speeds, true},
                                  SystemGoal{"branches", Needs::speeds, true},
                                  SystemGoal{"multipliers", Needs::speeds, true},
                                  SystemGoal{"order-cuts", Needs::speeds, true},
                                  SystemGoal{"runup", Needs::speeds, true},
                                  SystemGoal{"residual-signal", Needs::speeds, true},
                                  SystemGoal{"sound", Needs::speeds, true},
                                  SystemGoal{"teeth", Needs::elastic_gears, true},
                                  SystemGoal{"load-sharing", Needs::planets, true},
                                  SystemGoal{"harris-map", Needs::elastic_gears, true},
                                  SystemGoal{"compare", Needs::elastic_gears, true},
                                  SystemGoal{"modes", Needs::nothing, false},
                                  SystemGoal{"mode-shapes", Needs::nothing, false}};

bool has(const SceneAbilities& system, Needs needs) {
  return needs == Needs::nothing ||
         (system.elastic &&
          (needs == Needs::elastic_gears || (needs == Needs::speeds ? system.moves : system.planets)));
}

// "report, or of it static ..."
std::string of_system(const SceneAbilities& system) {
  std::string out;
  for (const SystemGoal& goal : kSystemGoals)
    if (has(system, goal.needs))
      out += text(out.empty() ? "" : out == kSystemGoals.front().name ? ", or of it " : " ", goal.name);
  return out;
}

void check_teeth(const SceneAbilities& pair, const std::string& which) {
  if (!pair.teeth_differ && !pair.cracked) return;
  fail(Failure::input, "teeth: ", which, " has teeth that ", pair.teeth_differ ? "differ" : "are cracked",
       ", and root stress, load sharing and error budget are of intact, equal teeth; for it there is: make ",
       which, " ", pair.teeth_differ ? "tooth-loads sidebands" : "crack", " residual-signal");
}

void check_face(const std::string& goal, const SceneAbilities& pair, const std::string& which) {
  if (pair.face.empty()) return;
  std::vector<std::string> goals(kGoalsOfFace.begin(), kGoalsOfFace.end());
  if (pair.slices) goals.insert(goals.end(), kGoalsOfSlices.begin(), kGoalsOfSlices.end());
  if (std::find(goals.begin(), goals.end(), goal) != goals.end()) return;
  std::string others;
  for (const std::string& own : goals) others += " " + own;
  fail(Failure::input, goal, ": in ", which, " ", pair.face, ", and ", goal,
       " is computed in one slice over the face, of spur gears under even load; for it there is: make ",
       which, others, pair.slices ? "" : "; with width = \"slices\" in [fidelity] also its sweep");
}

}  // namespace

SceneAbilities abilities(const Scene& scene) {
  SceneAbilities out;
  out.face =
      face_words(scene.mesh, scene.gear(scene.mesh.gear[0]).design, scene.gear(scene.mesh.gear[1]).design);
  out.slices = scene.fidelity.width == WidthModel::slices;
  if (out.face.empty() && scene.fidelity.width != WidthModel::one)
    out.face = text("[fidelity] has width = \"", scene.fidelity.width, "\"");
  for (const std::string& gear : scene.mesh.gear) {
    out.teeth_differ |= !scene.gear(gear).errors.none();
    out.cracked |= scene.gear(gear).design.crack.depth > 0;
  }
  return out;
}

SceneAbilities abilities(const SystemScene& scene, const System& layout) {
  const auto any = [&](const auto& of) { return std::any_of(scene.gears.begin(), scene.gears.end(), of); };
  return {.pair = false,
          .teeth_differ = any([](const SystemScene::Gear& gear) { return !gear.errors.none(); }),
          .cracked = any([](const SystemScene::Gear& gear) { return gear.design.crack.depth > 0; }),
          .elastic = !scene.rigid(),
          .planets = layout.meshes.size() > scene.meshes.size(),
          .moves = scene.operation.frequency_to > 0};
}

void check_goals(const std::vector<std::string>& goals, const SceneAbilities& scene,
                 const std::string& path) {
  const std::string which = "SCENE=" + path;
  for (const std::string& goal : goals) {
    const auto* const known = std::find_if(kSystemGoals.begin(), kSystemGoals.end(),
                                           [&](const SystemGoal& own) { return goal == own.name; });
    if (scene.pair) {
      if (known != kSystemGoals.end() && !known->of_pairs)
        fail(Failure::input, goal, ": ", which,
             " is a pair, and natural modes are of systems, scenes of several meshes, carriers or drives");
      check_face(goal, scene, which);
      if (goal == "teeth") check_teeth(scene, which);
      continue;
    }
    const char* const lacks =
        known == kSystemGoals.end() ? "a system of several meshes, carriers or drives"
        : has(scene, known->needs)  ? ""
        : !scene.elastic            ? "of rigid gears, which have natural modes alone"
        : known->needs == Needs::planets
            ? "without planets that share a load"
            : "without speeds, [operation] with mesh_frequency_Hz = { from = 500, to = 5000, step = 50 }";
    if (*lacks)
      fail(Failure::input, goal, ": ", which, " is ", lacks, "; for it there is: make ", which, " ",
           of_system(scene));
  }
}

}  // namespace whine
