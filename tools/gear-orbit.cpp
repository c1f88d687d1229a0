// gear-orbit: the branch of periodic orbits of the pair over the mesh frequency, stable or not, and where it turns.
//
// Reads   params (that of sweeps: damping, inertia, speeds, fidelity, time), body.h5 of both gears, static.h5 of the torque,
//         static.h5 of the reference torque (mean stiffness of the dampers)
// Writes  branch.h5   along the branch: mesh frequency, RMS, mean and harmonics of the transmission error, Floquet multipliers,
//                     stability; folds, period doublings, tori, and where contacts begin to come or go
// Equations: y = P(y; f) over one mesh period, by Newton's method with the exact tangent of P; pseudo-arclength continuation.
//            A sweep jumps where the branch folds.
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "results/branch.h"
#include "signal/jump_words.h"
#include "studies/pair_branch.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"Branch of periodic orbits over the mesh frequency, stable or not, with its folds",
                         "gear-orbit"};
  std::string params, statics, reference, output;
  std::vector<std::string> bodies;
  std::string way;
  whine::BranchPlan plan;
  options.add("--params", params, "stage parameters of the scene: out/<scene>/params/sweep.toml").required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--static", statics, "static.h5 of the torque to run").required();
  options.add("--reference-static", reference, "static.h5 whose mean stiffness sets the bearing dampers")
      .required();
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
  options.add("--output", output, "branch.h5 to write").required();
  options.footer(
      "Example:\n"
      "  gear-orbit --params out/parker2000/params/sweep.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --static out/parker2000/T150/static.h5 --reference-static out/parker2000/T100/static.h5 --output branch.h5");
  options.parse(argc, argv);
  if (way.empty() != (plan.at == 0))
    whine::fail(whine::Failure::usage,
                "--from-sweep and --at go together: the sweep and the speed of its motion");
  if (!way.empty()) plan.sweep = whine::choice_of<whine::Direction>(way);

  const whine::NamedFiles files("--body", bodies);
  const whine::Provenance provenance = whine::made_by(
      argc, argv,
      files.and_inputs({"params=" + params, "static=" + statics, "reference_static=" + reference}));
  whine::SweepParameters settings = whine::read_sweep_parameters(params);
  const auto [pair, at_torque, at_reference] = whine::read_pair_inputs(files, statics, reference, settings);
  const auto& [driver, driven] = pair;

  std::optional<whine::Progress> progress;
  const whine::BranchResult result = whine::pair_branch(
      driver, driven, at_torque, at_reference.mean_stiffness, settings,
      [&](long done, long total, const std::string& note) {
        if (!progress) progress.emplace("gear-orbit", total);
        progress->update(done, note);
      },
      plan);
  whine::write(output, result, provenance);
  whine::log_line("gear-orbit: ", result.torque, " N m, ", result.mesh_frequency.size(), " orbits, ",
                  result.mesh_frequency.size() - result.stable.sum(), " of them unstable",
                  ", folds: ", whine::jump_words(result.fold_frequency, result.fold_width), " -> ", output);
  constexpr double kRoundOff = 1e-9;
  if (result.mesh_frequency.minCoeff() > settings.frequency_from * (1 + kRoundOff))
    whine::log_line("gear-orbit: warning: the branch does not reach the lowest speed: ", result.end);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
