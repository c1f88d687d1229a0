// Error against CPU time of a scene: with the settings that accepted errors choose, with each setting of those for one accepted error
// made coarser and finer alone, and as the scene has them.
//
// Errors are of the RMS of the transmission error, largest over the speeds of bench/accuracy_runs.h, against its reference.
//
// Reads   a scene
// Writes  <output>.{tsv,svg,png}, and the same table in words on standard output
// Example: whine-work-precision --scene data/scenes/first-pair.toml --output out/figures/work-precision
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/format.h"
#include "base/tool.h"
#include "bench/accuracy_runs.h"
#include "bench/work_precision_panels.h"
#include "io/publish.h"
#include "report/figures.h"
#include "report/gnuplot.h"
#include "report/plot_file.h"
#include "studies/sweep.h"

namespace {

using namespace whine;

constexpr double kPercent = 100, kDefaultAccepted = 0.01;
constexpr std::array kLevels{0.08, 0.04, 0.02, 0.01, 0.005, 0.003};

class Front {
 public:
  Front(const Scene& scene, double least_accepted) : fine_(run_scene(reference_of(scene, least_accepted))) {
    log_line("work-precision: the reference took ", shown(fine_.seconds, 3), " s");
  }

  // {setting, CPU (s), error (%), bound (%)}
  std::vector<double> row(const std::string& name, double setting, const Scene& scene) {
    const SceneRun own = run_scene(scene);
    const RmsDifference off = difference(own.response, fine_.response);
    slowest_ = std::min(slowest_, off.mesh_frequency);
    fastest_ = std::max(fastest_, off.mesh_frequency);
    std::vector<double> out{setting, own.seconds, off.most * kPercent,
                            discretisation_plan(scene, no_key).error() * kPercent};
    std::printf("%-44s %10.4g %9.2f %9.3f %9.3f   %.0f Hz, %d speeds\n", name.c_str(), setting, out[1],
                out[2], out[3], off.mesh_frequency, off.compared);
    std::fflush(stdout);
    return out;
  }

  std::string note(const Scene& scene) const {
    const double bound = discretisation_plan(reference_of(scene, kLevels.back()), no_key).error();
    return text("errors: against settings for ", shown(bound * kPercent, 2), " % (",
                std::lround(fine_.seconds), " s of CPU), largest of ", kJudgedSpeedsOfScene,
                " rising speeds, here at ", shown(slowest_, 4),
                slowest_ < fastest_ ? text(" to ", shown(fastest_, 4)) : "", " Hz");
  }

 private:
  SceneRun fine_;
  double slowest_ = std::numeric_limits<double>::infinity(), fastest_ = 0;  // Hz: where errors are largest
};

FigureBlock block_of(const std::string& name, const std::string& setting) {
  return {name, {"setting [" + setting + "]", "CPU [s]", "error of the RMS [%]", "its bound [%]"}, {}};
}

// A setting that is made coarser and finer by a factor alone.
struct Alone {
  std::string name, unit;
  std::function<double(Scene&, double)> scale;  // gives the setting, in the unit
  bool acts;
};
std::vector<Alone> alone_of(const Scene& scene) {
  const bool sliced = scene.fidelity.width != WidthModel::one;
  const auto whole = [](int& n, double factor, int step) {
    n = std::max(step, step * static_cast<int>(std::lround(n * factor / step)));
    return static_cast<double>(n);
  };
  return {{"elements", "of a module",
           [](Scene& s, double finer) { return s.body.element_modules /= std::sqrt(finer); }, true},
          {"modes", "1", [whole](Scene& s, double finer) { return whole(s.body.modes, finer, 1); },
           scene.fidelity.body == BodyModel::modal},
          {"least rate of time steps", "kHz",
           [](Scene& s, double finer) { return 1e-3 * (s.time.min_sample_rate *= finer); }, true},
          {"strips", "1", [whole](Scene& s, double finer) { return whole(s.contact.strips, finer, 4); },
           scene.pair() && !sliced && scene.fidelity.contact == ContactModel::strips},
          {"points of a face", "1",
           [whole](Scene& s, double finer) { return whole(s.contact.face_points, finer, 2); }, sliced},
          {"periodicity", "1",
           [](Scene& s, double finer) { return s.time.periodicity /= finer * finer * finer; }, true}};
}

void measure(const Scene& whole, Figure& figure) {
  const Scene scene = at_few_speeds(whole);
  Front front(scene, kLevels.back());
  std::printf("%-44s %10s %9s %9s %9s\n", "", "setting", "CPU (s)", "error (%)", "bound (%)");
  const double accepted = scene.time.accepted_error > 0 ? scene.time.accepted_error : kDefaultAccepted;
  const Scene chosen = accepting(scene, accepted);
  FigureBlock all = block_of("settings for an accepted error", "%"),
              ring = block_of(text("chosen for ", shown(accepted * kPercent, 3), " %"), "%"),
              own = block_of("the scene as it stands", "1");
  ring.rows = {front.row(ring.name, accepted * kPercent, chosen)};
  for (const double error : kLevels)
    all.rows.push_back(error == accepted ? ring.rows.front()
                                         : front.row(all.name, error * kPercent, accepting(scene, error)));
  figure.blocks.push_back(all);
  for (const Alone& one : alone_of(chosen)) {
    if (!one.acts) continue;
    FigureBlock block = block_of(one.name + " alone", one.unit);
    for (const double finer : {0.5, 1.0, 2.0}) {
      Scene other = chosen;
      const double setting = one.scale(other, finer);
      if (finer == 1) {  // what was measured once stands once in the figure: times scatter
        block.rows.push_back(ring.rows.front());
        block.rows.back()[0] = setting;
      } else {
        block.rows.push_back(front.row(block.name, setting, other));
      }
    }
    figure.blocks.push_back(block);
  }
  own.rows = {front.row(own.name, 0, scene)};
  figure.blocks.push_back(ring);
  figure.blocks.push_back(own);
  figure.notes = {
      front.note(scene),
      "one setting alone: half and twice as fine as chosen; elements by their number, periodicity 8 times"};
}

void body(int argc, char** argv) {
  whine::Options options{"Error against CPU time of the settings of a scene", "whine-work-precision"};
  std::string path, output, plots = "pipelines/plots";
  options.add("--scene", path, "scene of elastic gears in motion (TOML)").required();
  options.add("--output", output, "path of the results without extension").required();
  options.add("--plots", plots, "folder of the gnuplot templates").show_default();
  options.parse(argc, argv);

  Figure figure;
  const Scene scene = read_scene(path);
  if (scene.rigid() || !(scene.operation.frequency_to > 0))
    fail(Failure::input, path, ": work-precision is of elastic gears in motion; give [operation] speeds");
  figure.title = "Error against CPU time: " + scene.title;
  measure(scene, figure);
  add_work_precision_panel(figure);
  const std::string recipe = template_of(figure, plots, "work-precision");
  const PlotFile data(figure);
  std::vector<FileBytes> files = table_files(figure, output, {recorded_path(path)});
  files.push_back({output + ".svg", draw(figure, data.path(), recipe, Picture::svg)});
  files.push_back({output + ".png", draw(figure, data.path(), recipe, Picture::png)});
  publish_all(files);
  log_line("work-precision -> ", output, ".{tsv,svg,png}");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
