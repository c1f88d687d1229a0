// gear-import: a scene from one spur stage or one planetary stage of a REXS model.
//
// Reads      a REXS model (.rexs, .rexsj, .rexsz; versions 1.0 to 2.0)
// Writes     a scene (TOML): each value with its origin, what was assumed, what the model says beside it; never over a file
// Equations  none; units of the model to those of the keys
#include <filesystem>

#include "base/error.h"
#include "base/tool.h"
#include "gear/scene_geometry.h"
#include "io/publish.h"
#include "io/rexs/scene.h"
#include "io/scene.h"
#include "io/scene_place.h"

namespace {

using namespace whine;

// What gear-scene asks of a scene.
void check(const std::string& path) {
  const ScenePlace where = [&](const std::vector<std::string>& sections, const std::string& words) {
    return scene_place(path, sections, words);
  };
  const Scene scene = read_scene(path);
  const System layout = layout_in(scene, path);
  check_geometry(scene, where);
  check_at_rest_in(scene, layout, path);
}

void body(int argc, char** argv) {
  Options options{"Writes a scene from one spur or planetary stage of a REXS model", "gear-import"};
  std::string input, output, stage;
  int load_case = 1;
  options.add("--input", input, "REXS model: .rexs, .rexsj or .rexsz").required();
  options.add("--output", output, "scene to write; must not exist").required();
  options.add("--stage", stage, "id or name of the stage, where the model has several");
  options.add("--load-case", load_case, "number of the load case whose torque and speed count")
      .show_default();
  options.footer(
      "Example:\n"
      "  gear-import --input data/examples/first-pair.rexs --stage \"First stage\" --output my-pair.toml");
  options.parse(argc, argv);
  if (std::filesystem::exists(output))
    fail(Failure::usage, output, " exists; an import replaces no scene: name another --output or remove it");

  const RexsScene scene = scene_of_rexs(read_rexs(input), stage, load_case);
  publish(output, scene.text);
  for (const std::string& assumed : scene.assumed) log_line("gear-import: assumed: ", assumed);
  log_line("gear-import: ", scene.stage, ": ", scene.assumed.size(), " values assumed, ",
           scene.ignored.size(), " remarks on what is not in the scene -> ", output);

  // What is written stays, to be changed; the status says whether it can be computed as it is.
  check(output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
