// gear-orbit: the branch of periodic orbits of gears over the mesh frequency, stable or not, and where it turns.
//
// Reads   params (those of sweeps: damping, inertia, speeds, fidelity, time; of a train meshes and layout, too), body.h5 of every
//         gear; of a pair static.h5 of the torque and of the reference torque (mean stiffness of the dampers)
// Writes  branch.h5   along the branch: mesh frequency, RMS, mean and harmonics of the transmission error, Floquet multipliers,
//                     stability; folds, period doublings, tori, and where contacts begin to come or go; forces and contact loss of
//                     each mesh, forces on bearings
// Equations: y = P(y; f) over one mesh period, by Newton's method with the exact tangent of P; pseudo-arclength continuation.
//            A sweep jumps where the branch folds.
#include <string>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/pair_inputs.h"
#include "io/scene.h"
#include "io/stage_command.h"
#include "results/branch.h"
#include "signal/jump_words.h"
#include "studies/branch.h"

namespace {
using namespace whine;

// from: lowest speed of the scene, Hz.
void finish(const StageCommand& stage, const Provenance& made, const BranchResult& result, double from) {
  write(stage.output(), result, made);
  log_line("gear-orbit: ", result.of_train() ? "" : text(result.torque, " N m, "),
           result.mesh_frequency.size(), " orbits, ", result.mesh_frequency.size() - result.stable.sum(),
           " of them unstable", ", folds: ", jump_words(result.fold_frequency, result.fold_width), " -> ",
           stage.output());
  constexpr double kRoundOff = 1e-9;
  if (result.mesh_frequency.minCoeff() > from * (1 + kRoundOff))
    log_line("gear-orbit: warning: the branch does not reach the lowest speed: ", result.end);
}

void body(int argc, char** argv) {
  Options options{"Branch of periodic orbits over the mesh frequency, stable or not, with its folds",
                  "gear-orbit"};
  StageCommand stage(options, "sweep.toml", StageCommand::Reads::bodies_and_rest);
  std::string way;
  BranchPlan plan;
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
  stage.add_output("branch.h5").required();
  options.footer(
      "Examples:\n"
      "  gear-orbit --params out/parker2000/params/sweep.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --static out/parker2000/T150/static.h5 --reference-static out/parker2000/T100/static.h5 --output branch.h5\n"
      "  gear-orbit --params out/three-in-line/params/sweep.toml --body pinion=out/three-in-line/pinion/body.h5 --body idler=out/three-in-line/idler/body.h5 --body wheel=out/three-in-line/wheel/body.h5 --output train.h5");
  options.parse(argc, argv);
  if (way.empty() != (plan.at == 0))
    fail(Failure::usage, "--from-sweep and --at go together: the sweep and the speed of its motion");
  if (!way.empty()) plan.sweep = choice_of<Direction>(way);

  const bool train = stage.of_train();
  const Provenance made = stage.made_by(argc, argv);
  if (train) {
    const SystemSweepParameters settings = read_system_sweep_parameters(stage.params());
    const std::vector<ReducedBody> gears = read_bodies(stage.bodies(), settings);
    const BranchResult result = system_branch(settings, gears, StepsDone("gear-orbit"), plan);
    return finish(stage, made, result, settings.frequency_from);
  }
  SweepParameters settings = read_sweep_parameters(stage.params());
  const auto [pair, at_torque, at_reference] =
      read_pair_inputs(stage.bodies(), stage.statics(), stage.reference(), settings);
  const auto& [driver, driven] = pair;
  const BranchResult result = pair_branch(driver, driven, at_torque, at_reference.mean_stiffness, settings,
                                          StepsDone("gear-orbit"), plan);
  finish(stage, made, result, settings.frequency_from);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
