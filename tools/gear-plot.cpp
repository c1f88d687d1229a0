// gear-plot: a figure of the paper as numbers and as pictures.
//
// Reads      fig01    mesh.h5 of the driver, mesh.h5 of the driven gear, static.h5
//            fig03    mesh.h5 of driver and driven gear, body.h5 of driver and driven gear, static.h5
//            fig05    response.h5 of sweeps up and down, any torques and choices; a panel for each set of choices
//            fig14-elastic    the same
//            fig08, fig10    sweep.h5 of sweeps up and down of one torque, any choices
//            fig12    static.h5, one per torque
//            fig13    static.h5, one per torque
//            error-budget    error_budget.h5
//            table1    impact.h5, one per torque; --published FILE: frequencies to compare with
//            <plots>/<figure>.gp, the template
// Writes     <output>.tsv, <output>.svg, <output>.png, each whole or not at all
//            fig01    the finite element mesh
//            fig03    the contact zone: candidate pairs, inner and outer region, pressure
//            fig05    RMS of the dynamic transmission error against mesh frequency
//            fig14-elastic    RMS and mean of the same
//            fig08    oscillating dynamic transmission error over time and its spectrum, both branches at one speed
//            fig10    tooth loads over the mesh phase, both branches at one speed
//            fig12    static transmission error (STE)
//            fig13    mesh stiffness
//            table1    natural frequencies: <output>.tsv and, to read, <output>.txt
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

template <class Artifact>
std::vector<Artifact> read_all(const std::vector<std::string>& inputs, Artifact (*read)(const std::string&)) {
  std::vector<Artifact> artifacts;
  for (const std::string& path : inputs) artifacts.push_back(read(path));
  return artifacts;
}

whine::Figure figure_of(const std::string& name, const std::vector<std::string>& inputs,
                        double mesh_frequency) {
  if (name == "fig01") {
    require_inputs(name, inputs, 3, "mesh.h5 of the driver, mesh.h5 of the driven gear, static.h5");
    return whine::mesh_figure(whine::read_mesh(inputs[0]), whine::read_mesh(inputs[1]),
                              whine::read_static(inputs[2]));
  }
  if (name == "fig03") {
    require_inputs(name, inputs, 5,
                   "mesh.h5 of driver and driven gear, body.h5 of driver and driven gear, static.h5");
    const whine::StaticArtifact pair = whine::read_static(inputs[4]);
    return whine::contact_zone_figure(
        whine::read_mesh(inputs[0]), whine::read_mesh(inputs[1]), pair,
        whine::contact_zone(whine::read_body(inputs[2]), whine::read_body(inputs[3]), pair));
  }
  if (name == "fig05" || name == "fig14-elastic")
    return whine::response_figure(read_all(inputs, whine::read_response));
  if (name == "fig08" || name == "fig10") {
    if (!(mesh_frequency > 0))
      whine::fail(whine::Failure::usage, name, " needs --mesh-frequency, in Hz, above 0");
    const auto sweeps = read_all(inputs, whine::read_sweep);
    return name == "fig08" ? whine::vibration_figure(sweeps, mesh_frequency)
                           : whine::tooth_load_figure(sweeps, mesh_frequency);
  }
  if (name == "error-budget") {
    require_inputs(name, inputs, 1, "error_budget.h5");
    return whine::error_budget_figure(whine::read_error_budget(inputs[0]));
  }
  if (name != "fig12" && name != "fig13")
    whine::fail(
        whine::Failure::usage, "unknown figure '", name,
        "'; known are fig01, fig03, fig05, fig08, fig10, fig12, fig13, fig14-elastic, error-budget, table1");
  const std::vector<whine::StaticArtifact> statics = read_all(inputs, whine::read_static);
  return name == "fig12" ? whine::transmission_error_figure(statics) : whine::mesh_stiffness_figure(statics);
}

std::vector<std::string> recorded(const std::vector<std::string>& inputs) {
  std::vector<std::string> sources;
  for (const std::string& path : inputs) sources.push_back(whine::recorded_path(path));
  return sources;
}

void body(int argc, char** argv) {
  CLI::App app{"Draws a figure of the paper from artifacts", "gear-plot"};
  std::string name, output, published, plots = "pipelines/plots";
  std::vector<std::string> inputs;
  double mesh_frequency = 0;
  app.add_option("figure", name,
                 "fig01, fig03, fig05, fig08, fig10, fig12, fig13, fig14-elastic, error-budget or table1")
      ->required();
  app.add_option("inputs", inputs, "artifacts, see above")->required();
  app.add_option("--output", output, "path of the results without extension")->required();
  app.add_option("--mesh-frequency", mesh_frequency, "speed of fig08 and fig10 in Hz, one of the sweeps'");
  app.add_option("--published", published, "file of frequencies that table1 compares with");
  app.add_option("--plots", plots, "folder of the gnuplot templates")->capture_default_str();
  whine::parse(app, argc, argv);

  if (name == "table1") {
    const whine::Figure table =
        whine::natural_frequency_table(read_all(inputs, whine::read_impact), published);
    const std::string words = whine::natural_frequency_text(table);
    whine::publish(output + ".tsv", whine::tsv(table, recorded(inputs)));
    whine::publish(output + ".txt", words);
    whine::tell("gear-plot: ", table.title, " -> ", output, ".{tsv,txt}");
    return;
  }
  const whine::Figure figure = figure_of(name, inputs, mesh_frequency);
  const std::string table = output + ".tsv", recipe = plots + "/" + name + ".gp";
  whine::publish(table, whine::tsv(figure, recorded(inputs)));
  whine::publish(output + ".svg", whine::draw(figure, table, recipe, whine::Picture::svg));
  whine::publish(output + ".png", whine::draw(figure, table, recipe, whine::Picture::png));
  whine::tell("gear-plot: ", figure.title, " -> ", output, ".{tsv,svg,png}");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
