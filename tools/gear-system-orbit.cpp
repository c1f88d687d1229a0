// gear-system-orbit: the branch of periodic orbits of a system of elastic gears over the mesh frequency, stable or not, and where
// it turns.
//
// Reads   params (those of sweeps: the system as laid out, meshes, damping, speeds, fidelity, time), body.h5 of every gear
// Writes  system_branch.h5   along the branch: mesh frequency, RMS and mean of the transmission error, forces and contact loss of
//                            each mesh, forces on bearings, Floquet multipliers, stability; folds, period doublings, tori
// Equations: y = P(y; f) over one mesh period, by Newton's method with the exact tangent of P; pseudo-arclength continuation.
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
#include "results/system_branch.h"
#include "signal/jump_words.h"
#include "studies/system_branch.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"Branch of periodic orbits of a system, stable or not, with its folds",
                         "gear-system-orbit"};
  std::string params, output;
  std::vector<std::string> bodies;
  std::string way;
  whine::BranchPlan plan;
  options.add("--params", params, "stage parameters of the scene: out/<scene>/params/system_sweep.toml")
      .required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options
      .add(
          "--from-sweep", way,
          "begin with the motion that a sweep in this direction has at the speed --at, in place of the one at rest at the highest speed")
      .one_of({"up", "down"});
  options.add("--at", plan.at, "mesh frequency of that motion in Hz");
  options.add("--periods", plan.most_periods,
              "1, 2 or 4: beyond period doublings follow orbits of up to so many mesh periods (default: 1)");
  options.add("--tolerance", plan.tolerance,
              "relative change of the state over an orbit, 1e-12 to 1e-3 (default: 1e-9)");
  options.add("--output", output, "system_branch.h5 to write").required();
  options.footer(
      "Example:\n"
      "  gear-system-orbit --params out/three-in-line/params/system_sweep.toml --body pinion=out/three-in-line/pinion/body.h5 --body idler=out/three-in-line/idler/body.h5 --body wheel=out/three-in-line/wheel/body.h5 --output system_branch.h5");
  options.parse(argc, argv);
  if (way.empty() != (plan.at == 0))
    whine::fail(whine::Failure::usage,
                "--from-sweep and --at go together: the sweep and the speed of its motion");
  if (!way.empty()) plan.sweep = whine::choice_of<whine::Direction>(way);

  const whine::NamedFiles files("--body", bodies);
  const whine::Provenance provenance = whine::made_by(argc, argv, files.and_inputs({"params=" + params}));
  const whine::SystemSweepParameters settings = whine::read_system_sweep_parameters(params);
  const std::vector<whine::ReducedBody> gears = whine::read_bodies(files, settings);
  std::optional<whine::Progress> progress;
  const whine::SystemBranchResult result = whine::system_branch(
      settings, gears,
      [&](long done, long total, const std::string& note) {
        if (!progress) progress.emplace("gear-system-orbit", total);
        progress->update(done, note);
      },
      plan);
  progress.reset();

  whine::write(output, result, provenance);
  whine::log_line("gear-system-orbit: ", result.mesh_frequency.size(), " orbits, ",
                  result.mesh_frequency.size() - result.stable.sum(), " of them unstable",
                  ", folds: ", whine::jump_words(result.fold_frequency, result.fold_width), " -> ", output);
  constexpr double kRoundOff = 1e-9;
  if (result.mesh_frequency.minCoeff() > settings.frequency_from * (1 + kRoundOff))
    whine::log_line("gear-system-orbit: warning: the branch does not reach the lowest speed: ", result.end);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
