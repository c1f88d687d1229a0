// gear-plot: a figure of the paper as numbers and as pictures.
//
// Reads      fig01    mesh.h5 of the driver, mesh.h5 of the driven gear, static.h5
//            fig05    response.h5 of the up and of the down sweep
//            fig12    static.h5, one per torque
//            fig13    static.h5, one per torque
//            error-budget    error_budget.h5
//            jump-map    jump_map.h5, one per torque and corner rule
//            sensitivity    jump_map.h5 of the scene, then of each variant
//            <plots>/<figure>.gp, the template
// Writes     <output>.tsv, <output>.svg, <output>.png, each whole or not at all
//            fig01    the finite element mesh
//            fig05    RMS of the dynamic transmission error against mesh frequency
//            fig12    static transmission error (STE)
//            fig13    mesh stiffness
//            error-budget    what refining each discretisation alone changes, and what other choices change
//            jump-map    two branches, contact loss and tooth loads against torque, damping and corner rule
//            sensitivity    what each variant of a scene changes
// Equations  k = (T / r_b) / STE
// Example    gear-plot fig05 --output out/figures/fig05 out/parker2000/T150/up/response.h5
//                      out/parker2000/T150/down/response.h5
#include <CLI/CLI.hpp>

#include "base/error.h"
#include "base/tool.h"
#include "files/publish.h"
#include "files/schemas.h"
#include "plot/figures.h"
#include "plot/gnuplot.h"
#include "plot/map_figures.h"

namespace {

void require_inputs(const std::string& name, const std::vector<std::string>& inputs, size_t count,
                    const char* what) {
  if (inputs.size() != count)
    whine::fail(whine::Failure::usage, name, " needs ", count, " inputs, ", what, "; ", inputs.size(),
                " given");
}

whine::Figure figure_of(const std::string& name, const std::vector<std::string>& inputs) {
  if (name == "fig01") {
    require_inputs(name, inputs, 3, "mesh.h5 of the driver, mesh.h5 of the driven gear, static.h5");
    return whine::mesh_figure(whine::read_mesh(inputs[0]), whine::read_mesh(inputs[1]),
                              whine::read_static(inputs[2]));
  }
  if (name == "fig05") {
    require_inputs(name, inputs, 2, "response.h5 of the up and of the down sweep");
    return whine::response_figure(whine::read_response(inputs[0]), whine::read_response(inputs[1]));
  }
  if (name == "error-budget") {
    require_inputs(name, inputs, 1, "error_budget.h5");
    return whine::error_budget_figure(whine::read_error_budget(inputs[0]));
  }
  if (name == "jump-map" || name == "sensitivity") {
    if (inputs.empty()) require_inputs(name, inputs, 1, "one jump_map.h5 at least");
    std::vector<whine::JumpMapArtifact> maps;
    for (const std::string& path : inputs) maps.push_back(whine::read_jump_map(path));
    if (name == "jump-map") return whine::jump_map_figure(maps);
    const whine::JumpMapArtifact base = maps.front();
    maps.erase(maps.begin());
    return whine::sensitivity_figure(base, maps);
  }
  if (name != "fig12" && name != "fig13")
    whine::fail(whine::Failure::usage, "unknown figure '", name,
                "'; known are fig01, fig05, fig12, fig13, error-budget, jump-map, sensitivity");
  std::vector<whine::StaticArtifact> statics;
  for (const std::string& path : inputs) statics.push_back(whine::read_static(path));
  return name == "fig12" ? whine::transmission_error_figure(statics) : whine::mesh_stiffness_figure(statics);
}

void body(int argc, char** argv) {
  CLI::App app{"Draws a figure of the paper from artifacts", "gear-plot"};
  std::string name, output, plots = "pipelines/plots";
  std::vector<std::string> inputs;
  app.add_option("figure", name, "fig01, fig05, fig12, fig13, error-budget, jump-map or sensitivity")
      ->required();
  app.add_option("inputs", inputs, "artifacts, see above")->required();
  app.add_option("--output", output, "path of the results without extension")->required();
  app.add_option("--plots", plots, "folder of the gnuplot templates")->capture_default_str();
  whine::parse(app, argc, argv);

  const whine::Figure figure = figure_of(name, inputs);
  std::vector<std::string> sources;
  for (const std::string& path : inputs) sources.push_back(whine::recorded_path(path));
  const std::string table = output + ".tsv", recipe = plots + "/" + name + ".gp";
  whine::publish(table, whine::tsv(figure, sources));
  whine::publish(output + ".svg", whine::draw(figure, table, recipe, whine::Picture::svg));
  whine::publish(output + ".png", whine::draw(figure, table, recipe, whine::Picture::png));
  whine::tell("gear-plot: ", figure.title, " -> ", output, ".{tsv,svg,png}");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
