#include "io/scene_goals.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/format.h"
#include "gear/shafts.h"
#include "studies/sweep.h"

namespace whine {

namespace {

Traits traits_of_pair(const Scene& scene) {
  Traits out = traits(scene.mesh(), scene.gear(scene.mesh().gear[0]).design,
                      scene.gear(scene.mesh().gear[1]).design, scene.fidelity.width);
  const auto lacks = [&](bool trait, Trait without) {
    if (!trait) out.emplace_back(without, "");
  };
  const bool cracked = has(out, Trait::cracked);
  lacks(!has(out, Trait::pair), Trait::one_slice);
  lacks(has(out, Trait::friction), Trait::no_friction);
  lacks(has(out, Trait::bearings), Trait::no_bearings);
  if (cracked) out.emplace_back(Trait::unlike_pair, "");
  for (const std::string& gear : scene.mesh().gear)
    if (!scene.gear(gear).errors.none())
      for (const Trait own : {Trait::unlike_pair, Trait::differing})
        out.emplace_back(own, "[gear." + gear + ".error]");
  lacks(cracked, Trait::no_crack);
  lacks(has(out, Trait::differing), Trait::no_errors);
  lacks(cracked || has(out, Trait::differing), Trait::like_teeth);
  return out;
}

}  // namespace

Traits traits(const Scene& scene, const System& layout) {
  if (scene.pair()) return traits_of_pair(scene);
  const bool slices = scene.fidelity.width != WidthModel::one;
  Traits out{{scene.rigid() ? Trait::rigid_gears
              : slices      ? Trait::train_in_slices
                            : Trait::train,
              slices ? text("[fidelity] has width = \"", scene.fidelity.width, "\"") : ""}};
  if (!(scene.operation.frequency_to > 0))
    out.emplace_back(Trait::no_speeds,
                     "[operation] mesh_frequency_Hz = { from = 500, to = 5000, step = 50 }");
  if (layout.meshes.size() <= scene.meshes.size()) out.emplace_back(Trait::no_planets, "");
  for (const SceneGear& gear : scene.gears) {
    if (!gear.errors.none()) out.emplace_back(Trait::differing, "[gear." + gear.name + ".error]");
    if (gear.design.crack.depth > 0) out.emplace_back(Trait::cracked, "[gear." + gear.name + ".crack]");
  }
  if (!slices) out.emplace_back(Trait::one_slice, "");
  if (!has(out, Trait::differing) && !has(out, Trait::cracked)) out.emplace_back(Trait::like_teeth, "");
  return out;
}

void check_goals(const std::vector<std::string>& goals, const Traits& scene, const std::string& path) {
  const std::string which = "SCENE=" + path;
  std::string instead;  // "report, or of it static ..."
  int many = 0;
  for (const std::string& goal : known_goals())
    if (not_taken(goal, scene).empty())
      instead += (++many == 1 ? "" : many == 2 ? ", or of it " : " ") + goal;
  for (const std::string& goal : goals)
    if (const std::string words = refusal(goal, scene); !words.empty())
      fail(Failure::input, which, ": ", words, "; for it there is: make ", which, " ", instead);
}

namespace {

void check_speed(double at, const Operation& speeds, const std::string& path) {
  if (!(at > 0) || !(speeds.frequency_to > 0)) return;
  double nearest = speeds.frequency_from;
  for (const double f : swept_speeds(speeds, Direction::up))
    if (std::abs(f - at) < std::abs(nearest - at)) nearest = f;
  if (std::abs(nearest - at) > 1e-9 * at)
    fail(Failure::input, "AT=", shown_number(at), ": the sweeps of ", path,
         " hold no such speed; the nearest is ", shown_number(nearest), " Hz: mesh_frequency_Hz goes from ",
         shown_number(speeds.frequency_from), " to ", shown_number(speeds.frequency_to), " in steps of ",
         shown_number(speeds.frequency_step));
}

void check_mesh(const std::string& mesh, const std::vector<std::string>& known) {
  if (mesh.empty() || std::find(known.begin(), known.end(), mesh) != known.end()) return;
  std::string there;
  for (const std::string& name : known) there += (there.empty() ? "" : ", ") + name;
  fail(Failure::input, "MESH=", mesh, ": there is no such mesh; there ", known.size() == 1 ? "is " : "are ",
       there);
}

}  // namespace

void check_asked(const SceneRequest& asked, const Scene& scene, const System& layout,
                 const std::string& path) {
  check_goals(asked.goals, traits(scene, layout), path);
  check_speed(asked.at, scene.operation, path);
  std::vector<std::string> meshes;
  for (size_t m = 0; m < layout.meshes.size(); ++m) meshes.push_back(mesh_name(layout, m));
  if (scene.pair()) meshes = {scene.mesh().gear[0] + "-" + scene.mesh().gear[1]};
  check_mesh(asked.mesh, meshes);
  if (asked.axis.empty()) return;
  const auto teeth = [&](size_t g) { return scene.gear(scene.mesh().gear[g]).design.teeth; };
  shaft_called(asked.axis,
               scene.pair() ? shafts_of(scene.mesh().gear, {teeth(0), teeth(1)}) : shafts_of(layout),
               "AXIS=" + asked.axis);
}

}  // namespace whine
