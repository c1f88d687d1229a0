// gear-compare: designs side by side as one HTML page, from their artifacts and the figures that show them on common axes.
//
// Reads      static.h5, of pairs impact.h5, and response.h5 of two to six scenes of pairs and trains, each in the folder of its scene (params/title.txt tells them
//            apart); figures that gear-plot has drawn, as .png
// Writes     --output: the page; compare.tsv beside it, what differs
// Equations  change = value / value of the first design - 1
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "base/tool.h"
#include "io/publish.h"
#include "io/scene_words.h"
#include "report/compare.h"
#include "report/report_inputs.h"

namespace {

using namespace whine;

struct Inputs {
  std::string name;
  std::vector<std::string> paths;
};

void body(int argc, char** argv) {
  Options options{"Writes designs side by side from their artifacts and figures", "gear-compare"};
  std::vector<std::string> inputs;
  std::string output;
  options.add("inputs", inputs, "artifacts (.h5) of several scenes and figures (.png) of them").required();
  options.add("--output", output, "page to write (.html); compare.tsv stands beside it").required();
  options.footer(
      "Example:\n"
      "  gear-compare --output compare/index.html out/parker2000/T150/static.h5 out/parker2000-longer/T150/static.h5");
  options.parse(argc, argv);

  std::vector<Inputs> scenes;
  std::vector<std::string> pictures;
  for (const std::string& path : inputs) {
    if (path.ends_with(".png")) {
      pictures.push_back(path);
      continue;
    }
    const std::string name = design_name(path);
    auto found = std::find_if(scenes.begin(), scenes.end(), [&](const Inputs& s) { return s.name == name; });
    if (found == scenes.end()) found = scenes.insert(scenes.end(), Inputs{name, {}});
    found->paths.push_back(path);
  }
  std::vector<Design> designs;
  designs.reserve(scenes.size());
  for (const Inputs& scene : scenes) {
    designs.push_back({scene.name, read_report_content(scene.paths)});
    require_one_scene(designs.back().content);
  }

  const std::string page = compare_html(designs, read_report_content(pictures).pictures),
                    table = compare_tsv(designs);
  publish_all(
      {{(std::filesystem::path(output).parent_path() / "compare.tsv").string(), table}, {output, page}});
  log_line("gear-compare: ", designs.size(), " designs, ", pictures.size(), " figures, ",
           differences(designs).size(), " differences -> ", output);
}

}  // namespace

int main(int argc, char** argv) {
  return run_tool(argc, argv, body);
}
