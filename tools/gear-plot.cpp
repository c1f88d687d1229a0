// gear-plot: a figure of the paper as numbers and as pictures.
//
// Reads      artifacts, which ones `gear-plot --help` says for each figure; params/title.txt in the folder of their scene, if
//            there is one; table1 besides --printed FILE, what P2000 prints; <plots>/<figure>.gp, the template
// Writes     <output>.tsv (further tables of the figure: <output>-<table>.tsv), <output>.svg, <output>.png, all of
//            them or none; for table1 <output>.tsv and, to read, <output>.txt
// Equations  k = (T / r_b) / STE
#include "base/error.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
#include "io/picture_sources.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/readings_result.h"
#include "paper/beside.h"
#include "paper/reading_figure.h"
#include "paper/table1.h"
#include "report/engineering_axes.h"
#include "report/figure_registry.h"
#include "report/gnuplot.h"
#include "report/plot_file.h"
#include "results/impact.h"

namespace {

using Paths = std::vector<std::string>;

constexpr const char *kTable = "table1", *kReading = "reading";

std::string footer() {
  std::string lines = "Figures, and the artifacts that they are drawn from:\n";
  for (const auto& [name, drawing] : whine::drawings())
    lines += "  " + name + ": " + drawing.shows + ". From " + drawing.inputs + "\n";
  lines += whine::text("  ", kReading, ": readings of P2000. From readings.h5, with --claim-sets\n");
  return lines + "  " + kTable + ": natural frequencies, as a table. From impact.h5, one per torque\n" +
         "Example:\n"
         "  gear-plot fig05 --output fig05 out/parker2000/T150/up/response.h5 out/parker2000/T150/down/response.h5";
}

void publish_figure(const whine::Figure& figure, const Paths& inputs, const Paths& sources,
                    const std::string& output, const std::string& plots, const std::string& name) {
  const std::string recipe = whine::template_of(figure, plots, name);
  for (const std::string& path : inputs) whine::require_fresh(path);
  const whine::PlotFile data(figure);
  std::vector<whine::FileBytes> files = whine::table_files(figure, output, sources);
  files.push_back({output + ".svg", whine::draw(figure, data.path(), recipe, whine::Picture::svg)});
  files.push_back(
      {output + ".png",
       whine::with_sources(whine::draw(figure, data.path(), recipe, whine::Picture::png), inputs)});
  whine::publish_all(files);
  whine::log_line("gear-plot: ", figure.title, " -> ", output, ".{tsv,svg,png}");
}

void body(int argc, char** argv) {
  whine::Options options{"Draws a figure of the paper from artifacts", "gear-plot"};
  std::string name, output, printed, beside, claim_sets, plots = "pipelines/plots";
  Paths inputs;
  const std::string others = std::string(kReading) + ", " + kTable;
  std::vector<double> mesh_frequencies;
  options.add("figure", name, whine::figure_names() + others).required();
  options.add("inputs", inputs, "artifacts, for each figure below").required();
  options.add("--output", output, "path of the results without extension").required();
  options
      .add(
          "--mesh-frequency", mesh_frequencies,
          "speed of fig08 and fig10 in Hz, one of the sweeps'; one or two of fig15, of its panels (the sweeps' nearest)")
      .separated_by(',');
  options.add("--printed", printed,
              "what P2000 prints, which table1 compares with: data/published/claims.toml");
  options.add("--claim-sets", claim_sets, "sets of claims that the figure of readings shows");
  options.add("--paper-figure", beside,
              "for pairs of P2000: the title says which figure of it shows the same, as in fig07");
  whine::EngineeringAxes axes;
  double reference = 0;
  options.add(
      "--axis", axes.speed,
      "figures against speed: rpm:<gear> in place of the mesh frequency; of a pair also rpm:driver, rpm:driven, of a train rpm:<carrier>");
  const whine::Option level = options.add(
      "--db", reference,
      "order-cuts, compare-motion, runup, system-sweep, branch: RMS (of an order its amplitude / sqrt 2) in dB re this length in m, as 1e-6");
  options.add("--plots", plots, "folder of the gnuplot templates").show_default();
  options.footer(footer());
  options.parse(argc, argv);

  Paths sources;
  for (const std::string& path : inputs) sources.push_back(whine::recorded_path(path));
  if (name == kReading) {
    if (inputs.size() != 1 || claim_sets.empty())
      whine::fail(whine::Failure::usage, "reading needs one readings.h5 and --claim-sets");
    const whine::ReadingsResult readings = whine::read<whine::ReadingsResult>(inputs.front());
    publish_figure(
        whine::reading_figure(readings, whine::consistency(readings, whine::read_claim_sets(claim_sets))),
        inputs, sources, output, plots, name);
    return;
  }
  if (name == kTable) {
    std::vector<whine::ImpactResult> impacts;
    for (const std::string& path : inputs) impacts.push_back(whine::read_pair_impact(path));
    const whine::Figure table = whine::natural_frequency_table(
        impacts, printed.empty() ? std::vector<whine::PrintedClaim>{} : whine::read_printed_claims(printed));
    const std::string words = whine::natural_frequency_text(table);
    for (const std::string& path : inputs) whine::require_fresh(path);
    std::vector<whine::FileBytes> files = whine::table_files(table, output, sources);
    files.push_back({output + ".txt", words});
    whine::publish_all(files);
    whine::log_line("gear-plot: ", table.title, " -> ", output, ".{tsv,txt}");
    return;
  }
  whine::Figure figure = whine::figure_of(name, inputs, mesh_frequencies, others, whine::jumps_of_paper());
  if (const std::string paper = whine::paper_figure(beside); !paper.empty())
    figure.title += ", as " + paper + " of P2000";
  if (level.given()) axes.level_reference = reference;
  whine::apply(axes, figure);
  publish_figure(figure, inputs, sources, output, plots, name);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
