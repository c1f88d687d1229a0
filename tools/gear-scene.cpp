// gear-scene: checks a scene and writes what each stage needs of it.
//
// Reads      a scene (TOML)
// Writes     <out>/<scene>/params/{static,impact,sweep,map,lumped,lumped_map}.toml
//                                                        stage parameters in SI, replaced only if they change
//                                                        of trains static.toml, with speeds sweep.toml, impact.toml; of rigid gears modes.toml
//            <out>/<scene>/params/{title,scene}.txt      what figures call it; path of the scene, from the working folder
//            <out>/bodies/<hash>/body.toml               one per distinct gear
//            <out>/<scene>/<gear> -> ../bodies/<hash>    relative links
//            --output                                    make fragment: gears, bodies, torques of the scene
//            --variant: a scene with the changes of --set, and nothing else; --keys, --features: print the tables of scene keys and of what is not taken;
//            --plan: prints what a scene will compute with: settings, their errors, expected times and memory; writes nothing
//            --goals: prints what is wrong with goals and variables of make, nothing if all is right
#include <filesystem>
#include <iostream>
#include <vector>

#include "base/error.h"
#include "base/format.h"
#include "base/tool.h"
#include "base/visible.h"
#include "io/compatibility.h"
#include "io/make_request.h"
#include "io/publish.h"
#include "io/scene.h"
#include "io/scene_fragment.h"
#include "io/scene_goals.h"
#include "io/scene_plan.h"
#include "io/scene_remarks.h"
#include "io/variant.h"

namespace {
using namespace whine;

// "2 gears, 1 body, 150 N m"
std::string parts_in_words(const Scene& scene, const System& layout, const BodyHashes& bodies) {
  if (!scene.pair()) return text(layout.bodies.size(), " bodies, ", layout.meshes.size(), " meshes");
  const size_t count = different(bodies).size();
  return text(scene.gears.size(), " gears, ", count, count == 1 ? " body, " : " bodies, ",
              torques_in_words(scene.operation.torques));
}

void cut(const std::string& path, const std::string& folder, const SceneRequest& asked,
         const std::string& ids, const std::string& output) {
  const std::string stem = checked_scene_stem(path), home = folder + "/" + stem;
  const Scene scene = read_scene(path);  // 1. The whole scene is checked before anything is written.
  const System layout = layout_in(scene, path);
  check_scene(scene, layout, path);
  check_asked(asked, scene, layout, path);
  record_scene(home, path);
  // Together: program ids, results and stage parameters keep their order.
  if (const int moved = bring_to_present({home, folder + "/bodies", ids}); moved > 0)
    log_line("gear-scene: ", home, ": ", moved,
             " files had times in the future and have those of now instead");
  // 2. Stage parameters and links; unchanged ones are left alone, so that make sees what did change.
  const BodyHashes bodies = publish_bodies(home, folder, body_parameters_of(scene));
  for (const auto& [name, words] : stage_parameters_of(scene, layout))
    publish_if_changed(home + "/params/" + name, words);
  publish_if_changed(home + "/params/title.txt", visible(scene.title) + "\n");
  // 3. The fragment, always written.
  publish(output, scene_fragment(scene, layout, path, stem, bodies));
  for (const std::string& line : scene_lines(scene, layout, path)) log_line("gear-scene: ", line);
  log_line("gear-scene: ", path, ": ", parts_in_words(scene, layout, bodies));
}

void body(int argc, char** argv) {
  std::string path, output, variant, ids, goals, folder = "out";
  std::vector<std::string> changes, given;
  SceneRequest asked;
  bool keys = false, plan = false, features = false;
  whine::Options options{"Checks a scene and writes what each stage needs of it", "gear-scene"};
  Option scene_option = options.add("--scene", path, "scene file (TOML)");
  Option output_option = options.add(
      "--output", output, "file to write that make includes: gears, bodies and torques of the scene");
  options.add("--out", folder, "folder of the artifacts").show_default();
  options.add(
      "--ids", ids,
      "folder of the files that tell make which programs have changed: those with a time in the future get the time of now");
  Option keys_option = options.flag("--keys", keys, "print the table of scene keys and end");
  options.flag("--features", features, "print what goals and stages do not take, and why, and end");
  Option variant_option = options.add("--variant", variant, "scene to write with the changes of --set");
  Option set_option = options.add("--set", changes, "key=value, any number of times");
  Option goals_option = options.add(
      "--goals", goals, "goals of make, with blanks between: prints what is wrong with them and --given");
  options.add("--given", given, "NAME=value, a variable of make, any number of times").needs(goals_option);
  options.add("--goal", asked.goals, "a goal of make, any number of times: one that can be reached");
  options.add("--axis", asked.axis, "AXIS of make: of a gear or carrier that turns");
  options.add("--mesh", asked.mesh, "MESH of make: one that there is");
  options.add("--at", asked.at, "AT of make, Hz: a speed of the sweeps");
  Option plan_option = options.flag(
      "--plan", plan, "print settings, their errors, expected CPU time and memory of a scene and end");
  plan_option.needs(scene_option).excludes(output_option).excludes(variant_option);
  scene_option.excludes(keys_option).excludes(goals_option);
  output_option.needs(scene_option).excludes(variant_option);
  variant_option.needs(scene_option).needs(set_option);
  set_option.needs(variant_option);
  options.footer(
      "Examples:\n"
      "  gear-scene --scene data/scenes/parker2000.toml --output build/scenes/parker2000.mk --out out\n"
      "  gear-scene --scene data/scenes/parker2000.toml --set bore_radius_mm=35 --variant out/parker2000/variants/bore35.toml\n"
      "  gear-scene --scene data/scenes/lin-parker-planetary.toml --output build/scenes/lin-parker-planetary.mk --out out\n"
      "  gear-scene --plan --scene data/scenes/parker2000.toml");
  options.parse(argc, argv);
  if (keys || features || !goals.empty()) {
    std::cout << (keys ? scene_key_table() : features ? capability_table() : wrong_with(goals, given));
    return;
  }
  if (plan) {
    std::cout << plan_words(path);
    return;
  }
  if (!variant.empty()) return static_cast<void>(publish_if_changed(variant, scene_variant(path, changes)));
  if (path.empty() || output.empty())
    fail(Failure::usage, "--scene and --output are needed, or --keys; see --help");
  cut(path, folder, asked, ids, output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
