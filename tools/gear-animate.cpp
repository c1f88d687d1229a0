// gear-animate: a steady motion over its mesh period as pictures: teeth that roll, bend, part and touch again.
//
// Reads      mesh.h5 of driver and driven gear, sweep.h5; params/title.txt in the folder of the scene, if there is one;
//            <plots>/animation.gp, the template
// Writes     <output>.tsv, <output>.gif, and <output>-001.png .., a picture for each frame; each whole or not at all
// Equations  none: the motion is the sweep's, deflections are K x = f under its tooth loads
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/named_files.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/scene_words.h"
#include "report/animation.h"
#include "report/gnuplot.h"
#include "report/plot_file.h"
#include "results/sector_grid.h"
#include "results/sweep.h"
#include "solid/tooth_bending.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"Animation of a steady motion over its mesh period", "gear-animate"};
  std::vector<std::string> meshes;
  std::string sweep, output, plots = "pipelines/plots";
  std::optional<double> speed;
  int frames = 48;
  options.add("--mesh", meshes, "mesh.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--sweep", sweep, "sweep.h5 of an elastic pair, up or down").required();
  options.add("--mesh-frequency", speed,
              "speed in Hz, one of the sweep's; default: the one with the largest RMS");
  options.add("--frames", frames, "number of pictures").show_default();
  options.add("--plots", plots, "folder of the gnuplot templates").show_default();
  options.add("--output", output, "path of the results without extension").required();
  options.footer(
      "Example:\n"
      "  gear-animate --mesh pinion=out/parker2000/pinion/mesh.h5 --mesh wheel=out/parker2000/wheel/mesh.h5 --sweep out/parker2000/T150/down/sweep.h5 --frames 4 --output animation");
  options.parse(argc, argv);

  if (speed && !(*speed > 0))
    whine::fail(whine::Failure::usage, "--mesh-frequency ", *speed, ": it is in Hz, above 0");
  const whine::NamedFiles files("--mesh", meshes);
  const whine::SweepResult motion = whine::read_pair_sweep(sweep);
  const std::vector<std::string> paths = files.of(motion.mesh);
  whine::Figure figure = whine::animation_figure(whine::read<whine::SectorGrid>(paths[0]),
                                                 whine::read<whine::SectorGrid>(paths[1]), motion,
                                                 whine::tooth_bending, speed.value_or(0), frames);
  const std::string scene = whine::scene_words(sweep);
  if (!scene.empty()) figure.scenes = {scene};
  for (const std::string& path : {paths[0], paths[1], sweep}) whine::require_fresh(path);

  const std::string recipe = plots + "/animation.gp";
  const whine::PlotFile data(figure);
  std::vector<whine::FileBytes> results = whine::table_files(
      figure, output,
      {whine::recorded_path(paths[0]), whine::recorded_path(paths[1]), whine::recorded_path(sweep)});
  const auto of_frames = [&figure](int first, int last) {
    whine::Figure part = figure;
    part.numbers.emplace_back("first_frame", first);
    part.numbers.emplace_back("last_frame", last);
    return part;
  };
  for (int frame = 0; frame < frames; ++frame) {
    char name[16];
    std::snprintf(name, sizeof name, "-%03d.png", frame + 1);
    results.push_back(
        {output + name, whine::draw(of_frames(frame, frame), data.path(), recipe, whine::Picture::png)});
  }
  results.push_back(
      {output + ".gif", whine::draw(of_frames(0, frames - 1), data.path(), recipe, whine::Picture::gif)});
  whine::publish_all(results);
  whine::log_line("gear-animate: ", figure.title, ", ", frames, " frames -> ", output, ".{tsv,gif}, ", output,
                  "-001.png ..");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
