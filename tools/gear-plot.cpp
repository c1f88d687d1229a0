// gear-plot: a figure of the paper as numbers and as pictures.
//
// Reads      artifacts, which ones `gear-plot --help` says for each figure; table1 besides --published FILE, frequencies to
//            compare with; <plots>/<figure>.gp, the template
// Writes     <output>.tsv, <output>.svg, <output>.png, each whole or not at all; for table1 <output>.tsv and, to read,
//            <output>.txt
// Equations  k = (T / r_b) / STE
// Example    gear-plot fig05 --output out/figures/fig05 out/parker2000/T150/up/response.h5
//                      out/parker2000/T150/down/response.h5
#include <CLI/CLI.hpp>
#include <map>

#include "base/error.h"
#include "base/tool.h"
#include "files/provenance.h"
#include "files/publish.h"
#include "files/schemas.h"
#include "plot/figures.h"
#include "plot/gnuplot.h"
#include "plot/map_figures.h"

namespace {

using Paths = std::vector<std::string>;

struct Drawing {
  const char* shows;
  const char* inputs;
  size_t count;  // of inputs; 0: any number
  whine::Figure (*draw)(const Paths& inputs, double mesh_frequency);
};

template <class Artifact>
std::vector<Artifact> read_all(const Paths& inputs, Artifact (*read)(const std::string&)) {
  std::vector<Artifact> artifacts;
  for (const std::string& path : inputs) artifacts.push_back(read(path));
  return artifacts;
}

const std::map<std::string, Drawing>& drawings() {
  static const std::map<std::string, Drawing> all{
      {"fig01",
       {"finite element mesh", "mesh.h5 of driver and driven gear, static.h5", 3,
        [](const Paths& in, double) {
          return whine::mesh_figure(whine::read_mesh(in[0]), whine::read_mesh(in[1]),
                                    whine::read_static(in[2]));
        }}},
      {"fig03",
       {"contact zone: candidate pairs, inner and outer region, pressure",
        "mesh.h5 of driver and driven gear, body.h5 of driver and driven gear, static.h5", 5,
        [](const Paths& in, double) {
          const whine::StaticArtifact pair = whine::read_static(in[4]);
          return whine::contact_zone_figure(
              whine::read_mesh(in[0]), whine::read_mesh(in[1]), pair,
              whine::contact_zone(whine::read_body(in[2]), whine::read_body(in[3]), pair));
        }}},
      {"fig05",
       {"RMS of the dynamic transmission error against mesh frequency",
        "response.h5 of sweeps up and down, any torques; a panel for each set of choices", 0,
        [](const Paths& in, double) { return whine::response_figure(read_all(in, whine::read_response)); }}},
      {"fig08",
       {"dynamic transmission error over time and its spectrum, both branches at one speed",
        "sweep.h5 of sweeps up and down of one torque, any choices", 0,
        [](const Paths& in, double f) {
          return whine::vibration_figure(read_all(in, whine::read_sweep), f);
        }}},
      {"fig10",
       {"tooth loads over the mesh phase, both branches at one speed", "as fig08", 0,
        [](const Paths& in, double f) {
          return whine::tooth_load_figure(read_all(in, whine::read_sweep), f);
        }}},
      {"fig12",
       {"static transmission error and its spectrum", "static.h5, one per torque", 0,
        [](const Paths& in, double) {
          return whine::transmission_error_figure(read_all(in, whine::read_static));
        }}},
      {"fig13",
       {"mesh stiffness and its spectrum", "as fig12", 0,
        [](const Paths& in, double) {
          return whine::mesh_stiffness_figure(read_all(in, whine::read_static));
        }}},
      {"fig14-elastic",
       {"RMS and mean of the dynamic transmission error against mesh frequency", "as fig05", 0,
        [](const Paths& in, double) { return whine::response_figure(read_all(in, whine::read_response)); }}},
      {"fig15",
       {"net mesh force of a lumped model", "sweep.h5 of lumped models at one torque", 0,
        [](const Paths& in, double) { return whine::mesh_force_figure(read_all(in, whine::read_sweep)); }}},
      {"fig16",
       {"RMS and mean of the transmission error of a lumped model",
        "response.h5 of one lumped model, up and down, per torque", 0,
        [](const Paths& in, double) {
          return whine::lumped_response_figure(read_all(in, whine::read_response));
        }}},
      {"error-budget",
       {"what refining each discretisation alone changes, and what other choices change", "error_budget.h5",
        1,
        [](const Paths& in, double) { return whine::error_budget_figure(whine::read_error_budget(in[0])); }}},
      {"jump-map",
       {"two branches, contact loss and tooth loads against torque, damping and corner rule",
        "jump_map.h5, one per torque and corner rule", 0,
        [](const Paths& in, double) { return whine::jump_map_figure(read_all(in, whine::read_jump_map)); }}},
      {"jump-map-lumped",
       {"the same of lumped models, and in how much they agree with the elastic pair",
        "jump_map.h5 of lumped models and of the elastic pair, one per torque and model or corner rule", 0,
        [](const Paths& in, double) {
          return whine::lumped_jump_map_figure(read_all(in, whine::read_jump_map));
        }}},
      {"sensitivity",
       {"what each variant of a scene changes", "jump_map.h5 of the scene, then of each variant", 0,
        [](const Paths& in, double) {
          std::vector<whine::JumpMapArtifact> maps = read_all(in, whine::read_jump_map);
          const whine::JumpMapArtifact base = maps.front();
          maps.erase(maps.begin());
          return whine::sensitivity_figure(base, maps);
        }}},
  };
  return all;
}

constexpr const char* kTable = "table1";

std::string known() {
  std::string names;
  for (const auto& [name, drawing] : drawings()) names += name + ", ";
  return names + kTable;
}

std::string footer() {
  std::string lines = "Figures, and the artifacts that they are drawn from:\n";
  for (const auto& [name, drawing] : drawings())
    lines += "  " + name + ": " + drawing.shows + ". From " + drawing.inputs + "\n";
  return lines + "  " + kTable + ": natural frequencies, as a table. From impact.h5, one per torque\n";
}

whine::Figure figure_of(const std::string& name, const Paths& inputs, double mesh_frequency) {
  const auto found = drawings().find(name);
  if (found == drawings().end())
    whine::fail(whine::Failure::usage, "unknown figure '", name, "'; known are ", known());
  const Drawing& drawing = found->second;
  if (drawing.count != 0 && inputs.size() != drawing.count)
    whine::fail(whine::Failure::usage, name, " needs ", drawing.count, " inputs, ", drawing.inputs, "; ",
                inputs.size(), " given");
  if ((name == "fig08" || name == "fig10") && !(mesh_frequency > 0))
    whine::fail(whine::Failure::usage, name, " needs --mesh-frequency, in Hz, above 0");
  return drawing.draw(inputs, mesh_frequency);
}

void body(int argc, char** argv) {
  CLI::App app{"Draws a figure of the paper from artifacts", "gear-plot"};
  std::string name, output, published, plots = "pipelines/plots";
  Paths inputs;
  double mesh_frequency = 0;
  app.add_option("figure", name, known())->required();
  app.add_option("inputs", inputs, "artifacts, for each figure below")->required();
  app.add_option("--output", output, "path of the results without extension")->required();
  app.add_option("--mesh-frequency", mesh_frequency, "speed of fig08 and fig10 in Hz, one of the sweeps'");
  app.add_option("--published", published, "file of frequencies that table1 compares with");
  app.add_option("--plots", plots, "folder of the gnuplot templates")->capture_default_str();
  app.footer(footer());
  whine::parse(app, argc, argv);

  Paths sources;
  for (const std::string& path : inputs) sources.push_back(whine::recorded_path(path));
  if (name == kTable) {
    const whine::Figure table =
        whine::natural_frequency_table(read_all(inputs, whine::read_impact), published);
    const std::string words = whine::natural_frequency_text(table);
    for (const std::string& path : inputs) whine::require_fresh(path);
    whine::publish(output + ".tsv", whine::tsv(table, sources));
    whine::publish(output + ".txt", words);
    whine::tell("gear-plot: ", table.title, " -> ", output, ".{tsv,txt}");
    return;
  }
  const whine::Figure figure = figure_of(name, inputs, mesh_frequency);
  for (const std::string& path : inputs) whine::require_fresh(path);
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
