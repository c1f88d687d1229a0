#include "io/scene_goals.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "io/make_request.h"

namespace whine {
namespace {

// Over the face of a pair: one slice alone, of spur gears under even load; any level, at rest; slices, in motion.
enum class Width { one, rest, motion };
// What a system must have.
enum class Needs { no_system, nothing, elastic_gears, speeds, planets, slices };

struct Goal {
  const char* name;
  Width width;
  Needs system;
  bool of_pairs = true, like_teeth = false;
};

// What each kind of scene can reach. Goals that do not stand here are of pairs in one slice alone.
constexpr std::array kGoals{Goal{"report", Width::rest, Needs::nothing},
                            Goal{"mesh", Width::rest, Needs::elastic_gears},
                            Goal{"reduce", Width::rest, Needs::elastic_gears},
                            Goal{"static", Width::rest, Needs::elastic_gears},
                            Goal{"flank-load", Width::rest, Needs::slices},
                            Goal{"fig01", Width::rest, Needs::no_system},
                            Goal{"fig12", Width::rest, Needs::no_system},
                            Goal{"fig13", Width::rest, Needs::no_system},
                            Goal{"profile-chart", Width::rest, Needs::no_system},
                            Goal{"error-budget", Width::rest, Needs::no_system},
                            Goal{"load-sharing", Width::rest, Needs::planets},
                            Goal{"sweep", Width::motion, Needs::speeds},
                            Goal{"face-load", Width::motion, Needs::no_system},
                            Goal{"fig05", Width::motion, Needs::no_system},
                            Goal{"fig07", Width::motion, Needs::no_system},
                            Goal{"fig14-elastic", Width::motion, Needs::no_system},
                            Goal{"tooth-loads", Width::motion, Needs::no_system},
                            Goal{"order-cuts", Width::motion, Needs::speeds},
                            Goal{"waterfall", Width::motion, Needs::no_system},
                            Goal{"histories", Width::motion, Needs::no_system},
                            Goal{"sound", Width::motion, Needs::speeds},
                            Goal{"runup", Width::motion, Needs::speeds},
                            Goal{"branches", Width::motion, Needs::speeds},
                            Goal{"fig05-branches", Width::motion, Needs::no_system},
                            Goal{"fig07-branches", Width::motion, Needs::no_system},
                            Goal{"multipliers", Width::motion, Needs::speeds},
                            Goal{"fold-curves", Width::motion, Needs::speeds},
                            Goal{"impact", Width::one, Needs::speeds},
                            Goal{"sidebands", Width::one, Needs::no_system},
                            Goal{"crack", Width::one, Needs::no_system},
                            Goal{"residual-signal", Width::one, Needs::speeds},
                            Goal{"teeth", Width::one, Needs::elastic_gears, true, true},
                            Goal{"harris-map", Width::one, Needs::elastic_gears},
                            Goal{"compare", Width::one, Needs::elastic_gears},
                            Goal{"modes", Width::one, Needs::nothing, false},
                            Goal{"mode-shapes", Width::one, Needs::nothing, false}};

// What the pair is that the goal does not take, in words; "": nothing.
std::string pair_lacks(const Goal& goal, const SceneAbilities& pair) {
  if (!goal.of_pairs)
    return "is a pair, and natural modes are of systems, scenes of several meshes, carriers or drives";
  if (!pair.face.empty() && goal.width == Width::one)
    return text("is more than one slice over the face: ", pair.face, ", and ", goal.name,
                " is of spur gears under even load");
  if (!pair.pair_moves() && goal.width == Width::motion)
    return text("has bodies in three dimensions over the face (", pair.face, "), and ", goal.name,
                " is of motion, which takes slices: write width = \"slices\" in [fidelity]");
  if (goal.like_teeth && (pair.teeth_differ || pair.cracked))
    return text("has teeth that ", pair.teeth_differ ? "differ" : "are cracked",
                ", and root stress, load sharing and error budget are of intact, equal teeth");
  return "";
}

std::string system_lacks(const Goal& goal, const SceneAbilities& system) {
  if (goal.system == Needs::no_system) return "is a system of several meshes, carriers or drives";
  if (goal.system == Needs::nothing) return "";
  if (!system.elastic) return "is of rigid gears, which have natural modes alone";
  if (!system.face.empty() && goal.width == Width::one && goal.system == Needs::elastic_gears)
    return text("is more than one slice over the face: ", system.face, ", and ", goal.name,
                " is of spur gears under even load");
  if (goal.system == Needs::slices && !system.slices)
    return "is of one slice over the face, whose load is the same all over it";
  if (goal.system == Needs::planets && !system.planets) return "is without planets that share a load";
  if (goal.system == Needs::speeds && !system.moves)
    return "is without speeds, [operation] with mesh_frequency_Hz = { from = 500, to = 5000, step = 50 }";
  return "";
}

std::string lacks(const Goal& goal, const SceneAbilities& scene) {
  return scene.pair ? pair_lacks(goal, scene) : system_lacks(goal, scene);
}

// "report, or of it static ..."
std::string instead(const SceneAbilities& scene) {
  std::string out;
  for (const Goal& goal : kGoals)
    if (lacks(goal, scene).empty())
      out += text(out.empty() ? "" : out == kGoals.front().name ? ", or of it " : " ", goal.name);
  return out;
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
  const bool slices = scene.fidelity.width != WidthModel::one;
  return {.pair = false,
          .teeth_differ = any([](const SystemScene::Gear& gear) { return !gear.errors.none(); }),
          .cracked = any([](const SystemScene::Gear& gear) { return gear.design.crack.depth > 0; }),
          .face = slices ? text("[fidelity] has width = \"", scene.fidelity.width, "\"") : std::string(),
          .slices = slices,
          .elastic = !scene.rigid(),
          .planets = layout.meshes.size() > scene.meshes.size(),
          .moves = scene.operation.frequency_to > 0};
}

void check_goals(const std::vector<std::string>& goals, const SceneAbilities& scene,
                 const std::string& path) {
  const std::string which = "SCENE=" + path;
  for (const std::string& name : goals) {
    const auto* const known =
        std::find_if(kGoals.begin(), kGoals.end(), [&](const Goal& own) { return name == own.name; });
    const Goal goal = known != kGoals.end() ? *known : Goal{name.c_str(), Width::one, Needs::no_system};
    if (const std::string why = lacks(goal, scene); !why.empty())
      fail(Failure::input, name, ": ", which, " ", why, "; for it there is: make ", which, " ",
           instead(scene));
  }
}

}  // namespace whine
