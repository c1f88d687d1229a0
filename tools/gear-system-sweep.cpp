// gear-system-sweep: the dynamic response of a system of elastic gears at a series of speeds, each started from the state of the
// one before.
//
// Reads   params (the system as laid out, meshes, damping, speeds, fidelity, time), body.h5 of every gear
// Writes  system_sweep.h5   transmission error and forces of each mesh, forces on bearings and pins, energy
// Equations: common/dynamics/system_dynamics.h (Eq. 1-6 in modes of the hub-fixed bodies, Eq. 18 at the end of each step)
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/named_files.h"
#include "io/provenance.h"
#include "io/system_scene.h"
#include "results/system_sweep.h"
#include "signal/jump_words.h"
#include "studies/system_sweep.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"Speed sweep of a system of elastic gears, with contact solved at every step",
                         "gear-system-sweep"};
  std::string params, way, output;
  std::vector<std::string> bodies;
  double jump_width = 0;
  options.add("--params", params, "stage parameters of the scene: out/<scene>/params/system_sweep.toml")
      .required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--direction", way, "up or down").required().one_of({"up", "down"});
  options.add("--output", output, "system_sweep.h5 to write").required();
  options.add("--jump-width", jump_width,
              "enclose jumps to this width in Hz or less (default: 1/64 of the step of the speeds)");
  options.footer(
      "Example:\n"
      "  gear-system-sweep --params out/three-in-line/params/system_sweep.toml --body pinion=out/three-in-line/pinion/body.h5 --body idler=out/three-in-line/idler/body.h5 --body wheel=out/three-in-line/wheel/body.h5 --direction up --output system_sweep.h5");
  options.parse(argc, argv);
  const whine::Direction direction = whine::choice_of<whine::Direction>(way).value();

  const whine::NamedFiles files("--body", bodies);
  const whine::Provenance provenance = whine::made_by(argc, argv, files.and_inputs({"params=" + params}));
  const whine::SystemSweepParameters settings = whine::read_system_sweep_parameters(params);
  const std::vector<whine::ReducedBody> gears = whine::read_bodies(files, settings);
  std::optional<whine::Progress> progress;
  const whine::SystemSweepResult result = whine::system_sweep(
      settings, gears, direction,
      [&](long done, long total, const std::string& note) {
        if (!progress) progress.emplace(whine::text("gear-system-sweep ", direction), total);
        progress->update(done, note);
      },
      jump_width);
  progress.reset();

  whine::write(output, result, provenance);
  whine::log_line("gear-system-sweep: ", direction, ", ", result.mesh_frequency.size(), " speeds, ",
                  result.periods.sum(), " mesh periods, jumps: ",
                  result.hunting_periods > 1 ? "not looked for, since teeth differ"
                                             : whine::jump_words(result.jump_frequency, result.jump_width),
                  " -> ", output);
  std::string speeds;
  for (Eigen::Index i = 0; i < result.mesh_frequency.size(); ++i)
    if (result.period_multiple[i] == 0)
      speeds += whine::text(speeds.empty() ? "" : ", ", result.mesh_frequency[i]);
  for (const whine::Remark& remark : result.remarks)
    whine::log_line("gear-system-sweep: ", remark.warning ? "warning: " : "", remark.words);
  if (!speeds.empty())
    whine::log_line("gear-system-sweep: the motion does not become periodic at ", speeds,
                    " Hz; raise damping, or periodicity in [discretisation]");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
