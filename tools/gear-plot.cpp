// gear-plot: a figure of the paper as numbers and as pictures.
//
// Reads      artifacts, which ones `gear-plot --help` says for each figure; params/title.txt in the folder of their scene, if
//            there is one; table1 besides --published FILE, frequencies to compare with; <plots>/<figure>.gp, the template
// Writes     <output>.tsv (further tables of the figure: <output>-<table>.tsv), <output>.svg, <output>.png, each whole or not at
//            all; for table1 <output>.tsv and, to read,
//            <output>.txt
// Equations  k = (T / r_b) / STE
#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/tool.h"
#include "io/body_codec.h"
#include "io/branch_codec.h"
#include "io/error_budget_codec.h"
#include "io/harris_map_codec.h"
#include "io/impact_codec.h"
#include "io/jump_map_codec.h"
#include "io/mesh_codec.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/response_codec.h"
#include "io/static_codec.h"
#include "io/summary.h"
#include "io/sweep_codec.h"
#include "paper/reading_figure.h"
#include "plot/gear_figures.h"
#include "plot/gnuplot.h"
#include "plot/map_figures.h"
#include "plot/motion_figures.h"
#include "plot/plot_file.h"
#include "plot/static_figures.h"
#include "plot/study_figure.h"
#include "signal/response.h"

namespace {

using Paths = std::vector<std::string>;

using Frequencies = std::vector<double>;

struct Drawing {
  const char* shows;
  const char* inputs;
  size_t count;        // of inputs; 0: any number
  size_t frequencies;  // most that --mesh-frequency may give; 0: none, else one is needed
  whine::Figure (*draw)(const Paths& inputs, const Frequencies& mesh_frequencies);
};

template <class Artifact>
std::vector<Artifact> read_all(const Paths& inputs, Artifact (*read)(const std::string&)) {
  std::vector<Artifact> artifacts;
  for (const std::string& path : inputs) artifacts.push_back(read(path));
  return artifacts;
}

// Sweeps of one kind among the inputs, with what other inputs and their scenes tell of them.
template <class Sweep>
struct Told {
  std::vector<Sweep> sweeps;
  whine::Background background;

  void add(const std::string& path, Sweep sweep, const whine::LumpedParameters& lumped) {
    sweeps.push_back(std::move(sweep));
    background.scenes.push_back(whine::scene_words(path));
    background.lumped.push_back(lumped);
  }
};

bool is_a(const char* schema, const std::string& path) {
  return whine::read_origin(path).schema == schema;
}

Told<whine::ResponseArtifact> read_responses(const Paths& inputs) {
  Told<whine::ResponseArtifact> told;
  for (const std::string& path : inputs) {
    if (is_a("whine/impact", path)) {
      told.background.impacts.push_back(whine::read_impact(path));
    } else if (is_a("whine/branch", path)) {
      told.background.branches.push_back(whine::read_branch(path));
    } else if (is_a("whine/sweep", path)) {
      const whine::SweepArtifact sweep = whine::read_sweep(path);
      told.add(path, whine::response(sweep), sweep.lumped);
    } else {
      told.add(path, whine::read_response(path), {});
    }
  }
  return told;
}

Told<whine::SweepArtifact> read_sweeps(const Paths& inputs) {
  Told<whine::SweepArtifact> told;
  for (const std::string& path : inputs) {
    if (is_a("whine/impact", path)) {
      told.background.impacts.push_back(whine::read_impact(path));
    } else {
      const whine::SweepArtifact sweep = whine::read_sweep(path);
      told.add(path, sweep, sweep.lumped);
    }
  }
  return told;
}

whine::Figure draw_responses(const Paths& inputs, const Frequencies&) {
  const auto told = read_responses(inputs);
  return whine::response_figure(told.sweeps, told.background);
}

const std::map<std::string, Drawing>& drawings() {
  static const std::map<std::string, Drawing> all{
      {"fig01",
       {"finite element mesh", "mesh.h5 of driver and driven gear, static.h5", 3, 0,
        [](const Paths& in, const Frequencies&) {
          return whine::mesh_figure(whine::read_mesh(in[0]), whine::read_mesh(in[1]),
                                    whine::read_static(in[2]));
        }}},
      {"fig03",
       {"contact zone: candidate pairs, inner and outer region, pressure",
        "mesh.h5 of driver and driven gear, body.h5 of driver and driven gear, static.h5", 5, 0,
        [](const Paths& in, const Frequencies&) {
          const whine::StaticArtifact pair = whine::read_static(in[4]);
          return whine::contact_zone_figure(
              whine::read_mesh(in[0]), whine::read_mesh(in[1]), pair,
              whine::contact_zone(whine::read_body(in[2]), whine::read_body(in[3]), pair));
        }}},
      {"fig05",
       {"RMS of the dynamic transmission error against mesh frequency",
        "response.h5 of sweeps up and down, any torques, or their sweep.h5 (lumped models: with mass and "
        "damping ratio); "
        "a panel for each set of choices; impact.h5 of the same torques, for damping ratios; branch.h5, for "
        "unstable orbits and "
        "folds",
        0, 0, draw_responses}},
      {"fig08",
       {"dynamic transmission error over time and its spectrum, both branches at one speed",
        "sweep.h5 of sweeps up and down of one torque, any choices; impact.h5 of that torque, for damping "
        "ratios",
        0, 1,
        [](const Paths& in, const Frequencies& f) {
          const auto told = read_sweeps(in);
          return whine::vibration_figure(told.sweeps, f[0], told.background);
        }}},
      {"fig10",
       {"tooth loads over the mesh phase, both branches at one speed", "as fig08", 0, 1,
        [](const Paths& in, const Frequencies& f) {
          const auto told = read_sweeps(in);
          return whine::tooth_load_figure(told.sweeps, f[0], told.background);
        }}},
      {"fig12",
       {"static transmission error and its spectrum", "static.h5, one per torque", 0, 0,
        [](const Paths& in, const Frequencies&) {
          return whine::transmission_error_figure(read_all(in, whine::read_static));
        }}},
      {"fig13",
       {"mesh stiffness and its spectrum", "as fig12", 0, 0,
        [](const Paths& in, const Frequencies&) {
          return whine::mesh_stiffness_figure(read_all(in, whine::read_static));
        }}},
      {"load-sharing",
       {"the share of the load that a tooth pair carries on its way through the mesh", "as fig12", 0, 0,
        [](const Paths& in, const Frequencies&) {
          return whine::load_sharing_figure(read_all(in, whine::read_static));
        }}},
      {"waterfall",
       {"spectra of the dynamic transmission error against mesh frequency, and its first orders",
        "sweep.h5 of a sweep, or of those up and down of one torque", 0, 0,
        [](const Paths& in, const Frequencies&) {
          return whine::waterfall_figure(read_all(in, whine::read_sweep));
        }}},
      {"tooth-loads",
       {"tooth loads against mesh frequency, and over the mesh period at the speed with the largest RMS",
        "sweep.h5 of sweeps up and down of one torque; impact.h5 of that torque, for damping ratios", 0, 0,
        [](const Paths& in, const Frequencies&) {
          const auto told = read_sweeps(in);
          return whine::dynamic_load_figure(told.sweeps, told.background);
        }}},
      {"bearing-forces",
       {"forces on elastic bearings against mesh frequency",
        "response.h5 of sweeps up and down of one torque; impact.h5 of that torque, for damping ratios", 0, 0,
        [](const Paths& in, const Frequencies&) {
          const auto told = read_responses(in);
          return whine::bearing_force_figure(told.sweeps, told.background);
        }}},
      {"fig15",
       {"net mesh force of lumped models at one or two speeds", "sweep.h5 of lumped models at one torque", 0,
        2,
        [](const Paths& in, const Frequencies& f) {
          return whine::mesh_force_figure(read_all(in, whine::read_sweep), f);
        }}},
      {"fig16", {"RMS and mean of the dynamic transmission error", "as fig05", 0, 0, draw_responses}},
      {"error-budget",
       {"what refining each discretisation alone changes, and what other choices change", "error_budget.h5",
        1, 0,
        [](const Paths& in, const Frequencies&) {
          return whine::error_budget_figure(whine::read_error_budget(in[0]));
        }}},
      {"profile",
       {"profile charts of the driving flanks, as an inspection sheet shows them", "static.h5", 1, 0,
        [](const Paths& in, const Frequencies&) {
          return whine::profile_figure(whine::read_static(in[0]));
        }}},
      {"harris-map",
       {"peak-to-peak transmission error against torque and tip relief, and the Harris cusp", "harris_map.h5",
        1, 0,
        [](const Paths& in, const Frequencies&) {
          return whine::harris_map_figure(whine::read_harris_map(in[0]));
        }}},
      {"jump-map",
       {"two branches, contact loss and tooth loads against torque, damping and corner rule",
        "jump_map.h5, one per torque and corner rule", 0, 0,
        [](const Paths& in, const Frequencies&) {
          return whine::jump_map_figure(read_all(in, whine::read_jump_map));
        }}},
      {"jump-map-lumped",
       {"the same of lumped models, and in how much they agree with the elastic pair",
        "jump_map.h5 of lumped models and of the elastic pair, one per torque and model or corner rule", 0, 0,
        [](const Paths& in, const Frequencies&) {
          return whine::lumped_jump_map_figure(read_all(in, whine::read_jump_map));
        }}},
      {"crack",
       {"the mark of a cracked tooth in the static transmission error, and its orders",
        "static.h5 of a pair with a crack", 1, 0,
        [](const Paths& in, const Frequencies&) { return whine::crack_figure(whine::read_static(in[0])); }}},
      {"study",
       {"response quantities of the variants of a study against the keys that vary", "study.h5", 1, 0,
        [](const Paths& in, const Frequencies&) {
          return whine::study_figure(whine::read_study_artifact(in[0]));
        }}},
      {"sidebands",
       {"teeth that differ: transmission error over the hunting period, shaft orders and sidebands",
        "static.h5 and response.h5 of one torque", 2, 0,
        [](const Paths& in, const Frequencies&) {
          return whine::sidebands_figure(whine::read_static(in[0]), whine::read_response(in[1]));
        }}},
      {"sensitivity",
       {"what each variant of a scene changes", "jump_map.h5 of the scene, then of each variant", 0, 0,
        [](const Paths& in, const Frequencies&) {
          std::vector<whine::JumpMapArtifact> maps = read_all(in, whine::read_jump_map);
          const whine::JumpMapArtifact base = maps.front();
          maps.erase(maps.begin());
          return whine::sensitivity_figure(base, maps);
        }}},
  };
  return all;
}

constexpr const char *kTable = "table1", *kReading = "reading";

std::string known() {
  std::string names;
  for (const auto& [name, drawing] : drawings()) names += name + ", ";
  return names + kReading + ", " + kTable;
}

std::string footer() {
  std::string lines = "Figures, and the artifacts that they are drawn from:\n";
  for (const auto& [name, drawing] : drawings())
    lines += "  " + name + ": " + drawing.shows + ". From " + drawing.inputs + "\n";
  lines += whine::text("  ", kReading, ": readings of P2000. From readings.h5, with --claim-sets\n");
  return lines + "  " + kTable + ": natural frequencies, as a table. From impact.h5, one per torque\n" +
         "Example:\n"
         "  gear-plot fig05 --output fig05 out/parker2000/T150/up/response.h5 "
         "out/parker2000/T150/down/response.h5";
}

// Scenes that all of a figure shows: not those that stand at their panels, nor variants of the first.
Paths scenes_of(const std::string& name, const Paths& inputs, const whine::Figure& figure) {
  Paths scenes;
  for (const std::string& path : inputs) {
    const std::string words = whine::scene_words(path);
    bool at_panel = words.empty() || (name == "sensitivity" && !scenes.empty());
    for (const std::string& note : figure.notes) at_panel = at_panel || note.find(words) != std::string::npos;
    if (!at_panel && std::find(scenes.begin(), scenes.end(), words) == scenes.end()) scenes.push_back(words);
  }
  return scenes;
}

// `beside`: the figure of the paper that shows the same, as fig07; empty: of a pair of one's own, whose title names none.
whine::Figure figure_of(const std::string& name, const Paths& inputs, const Frequencies& mesh_frequencies,
                        const std::string& beside) {
  const auto found = drawings().find(name);
  if (found == drawings().end())
    whine::fail(whine::Failure::usage, "unknown figure '", name, "'; known are ", known());
  const Drawing& drawing = found->second;
  if (drawing.count != 0 && inputs.size() != drawing.count)
    whine::fail(whine::Failure::usage, name, " needs ", drawing.count, " inputs, ", drawing.inputs, "; ",
                inputs.size(), " given");
  if (drawing.frequencies == 0 && !mesh_frequencies.empty())
    whine::fail(whine::Failure::usage, name, " takes no --mesh-frequency: it is not of single speeds");
  if (drawing.frequencies > 0 && (mesh_frequencies.empty() || mesh_frequencies.size() > drawing.frequencies))
    whine::fail(whine::Failure::usage, name, " needs --mesh-frequency, in Hz, ",
                drawing.frequencies == 1 ? "one" : "one or two; two as in 2200,2150", "; ",
                mesh_frequencies.size(), " given");
  for (double f : mesh_frequencies)
    if (!(f > 0) || !std::isfinite(f))
      whine::fail(whine::Failure::usage, name, ": --mesh-frequency ", f, "; it is in Hz, above 0");
  whine::Figure figure = drawing.draw(inputs, mesh_frequencies);
  if (const std::string paper = whine::paper_figure(beside); !paper.empty())
    figure.title += ", as " + paper + " of P2000";
  figure.scenes = scenes_of(name, inputs, figure);
  return figure;
}

void publish_figure(const whine::Figure& figure, const Paths& inputs, const Paths& sources,
                    const std::string& output, const std::string& recipe) {
  for (const std::string& path : inputs) whine::require_fresh(path);
  const whine::PlotFile data(figure);
  whine::publish_tables(figure, output, sources);
  whine::publish(output + ".svg", whine::draw(figure, data.path(), recipe, whine::Picture::svg));
  whine::publish(output + ".png", whine::draw(figure, data.path(), recipe, whine::Picture::png));
  whine::tell("gear-plot: ", figure.title, " -> ", output, ".{tsv,svg,png}");
}

void body(int argc, char** argv) {
  whine::Options options{"Draws a figure of the paper from artifacts", "gear-plot"};
  std::string name, output, published, beside, claim_sets, plots = "pipelines/plots";
  Paths inputs;
  Frequencies mesh_frequencies;
  options.add("figure", name, known()).required();
  options.add("inputs", inputs, "artifacts, for each figure below").required();
  options.add("--output", output, "path of the results without extension").required();
  options
      .add("--mesh-frequency", mesh_frequencies,
           "speed of fig08 and fig10 in Hz, one of the sweeps'; one or two of fig15, of its panels "
           "(the sweeps' nearest)")
      .separated_by(',');
  options.add("--published", published, "file of frequencies that table1 compares with");
  options.add("--claim-sets", claim_sets, "sets of claims that the figure of readings shows");
  options.add("--paper-figure", beside,
              "for pairs of P2000: the title says which figure of it shows the same, as in fig07");
  options.add("--plots", plots, "folder of the gnuplot templates").show_default();
  options.footer(footer());
  options.parse(argc, argv);

  Paths sources;
  for (const std::string& path : inputs) sources.push_back(whine::recorded_path(path));
  if (name == kReading) {
    if (inputs.size() != 1 || claim_sets.empty())
      whine::fail(whine::Failure::usage, "reading needs one readings.h5 and --claim-sets");
    const whine::ReadingsArtifact readings = whine::read_readings(inputs.front());
    publish_figure(
        whine::reading_figure(readings, whine::consistency(readings, whine::read_claim_sets(claim_sets))),
        inputs, sources, output, plots + "/" + name + ".gp");
    return;
  }
  if (name == kTable) {
    const whine::Figure table =
        whine::natural_frequency_table(read_all(inputs, whine::read_impact), published);
    const std::string words = whine::natural_frequency_text(table);
    for (const std::string& path : inputs) whine::require_fresh(path);
    whine::publish_tables(table, output, sources);
    whine::publish(output + ".txt", words);
    whine::tell("gear-plot: ", table.title, " -> ", output, ".{tsv,txt}");
    return;
  }
  publish_figure(figure_of(name, inputs, mesh_frequencies, beside), inputs, sources, output,
                 plots + "/" + name + ".gp");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
