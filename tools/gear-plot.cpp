// gear-plot: a figure of the paper as numbers and as pictures.
//
// Reads      fig01    mesh.h5 of the driver, mesh.h5 of the driven gear, static.h5
//            fig05    response.h5 of the up and of the down sweep
//            fig12    static.h5, one per torque
//            fig13    static.h5, one per torque
//            fig14    response.h5 of a lumped model, up and down, per torque
//            fig15    sweep.h5 of lumped models, one torque
//            fig16    as fig14
//            error-budget    error_budget.h5
//            <plots>/<figure>.gp, the template
// Writes     <output>.tsv, <output>.svg, <output>.png, each whole or not at all
//            fig01    the finite element mesh
//            fig05    RMS of the dynamic transmission error against mesh frequency
//            fig12    static transmission error (STE)
//            fig13    mesh stiffness
//            fig14    RMS and mean of the DTE of a lumped model, rectangular stiffness
//            fig15    net mesh force of a lumped model
//            fig16    as fig14, stiffness of the statics at each torque
//            error-budget    what refining each discretisation alone changes, and what other choices change
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
  if (name == "fig14" || name == "fig16") {
    std::vector<whine::ResponseArtifact> responses;
    for (const std::string& path : inputs) responses.push_back(whine::read_response(path));
    return whine::lumped_response_figure(responses);
  }
  if (name == "fig15") {
    std::vector<whine::SweepArtifact> sweeps;
    for (const std::string& path : inputs) sweeps.push_back(whine::read_sweep(path));
    return whine::mesh_force_figure(sweeps);
  }
  if (name != "fig12" && name != "fig13")
    whine::fail(whine::Failure::usage, "unknown figure '", name,
                "'; known are fig01, fig05, fig12, fig13, fig14, fig15, fig16, error-budget");
  std::vector<whine::StaticArtifact> statics;
  for (const std::string& path : inputs) statics.push_back(whine::read_static(path));
  return name == "fig12" ? whine::transmission_error_figure(statics) : whine::mesh_stiffness_figure(statics);
}

void body(int argc, char** argv) {
  CLI::App app{"Draws a figure of the paper from artifacts", "gear-plot"};
  std::string name, output, plots = "pipelines/plots";
  std::vector<std::string> inputs;
  app.add_option("figure", name, "fig01, fig05, fig12 to fig16 or error-budget")->required();
  app.add_option(
         "inputs", inputs,
         "artifacts. fig01: mesh.h5 of the driver, mesh.h5 of the driven gear, static.h5; fig05: "
         "response.h5 up and down; fig12, fig13: static.h5, one per torque; fig14, fig16: response.h5 of a "
         "lumped model, up and down, per torque; fig15: sweep.h5 of lumped models; error-budget: "
         "error_budget.h5")
      ->required();
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
