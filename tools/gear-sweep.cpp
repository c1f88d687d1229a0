// gear-sweep: the dynamic response of gears at a series of speeds, each started from the state of the one before.
//
// Reads   params (stage parameters of a scene: damping, inertia, speeds, fidelity, time; of a train meshes and layout, too), body.h5
//         of every gear; of a pair static.h5 of the torque (mesh, contact discretisation) and of the reference torque (mean stiffness
//         of the dampers)
// Writes  sweep.h5    transmission error and loads over one orbit at every speed, energy, certificate, jumps; of a train
//                     forces on bearings and pins, too
// Equations: Eq. 1-6 in modes of the hub-fixed gears, Newmark (Eq. 8) or exact propagators, Eq. 13-20 at every step
// Of a pair, with --next-level: beside sweep.h5, in words, what the same sweep gives on the next model level of contact and on that
// of body. With --errors, in place of sweep.h5, sweep_errors.h5: what refining each discretisation alone changes.
#include <string>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/pair_inputs.h"
#include "io/scene.h"
#include "io/stage_command.h"
#include "io/sweep_words.h"
#include "results/sweep.h"
#include "signal/jump_words.h"
#include "studies/next_level.h"
#include "studies/sweep.h"
#include "studies/sweep_errors.h"

namespace {
using namespace whine;

void tell_remarks(const std::vector<Remark>& remarks) {
  for (const Remark& remark : remarks)
    log_line("gear-sweep: ", remark.warning ? "warning: " : "", remark.words);
}

void sweep_train(const StageCommand& stage, const Provenance& made, Direction direction, double jump_width) {
  const SystemSweepParameters settings = read_system_sweep_parameters(stage.params());
  const std::vector<ReducedBody> gears = read_bodies(stage.bodies(), settings);
  const SweepResult result =
      system_sweep(settings, gears, direction, StepsDone(text("gear-sweep ", direction)), jump_width);
  write(stage.output(), result, made);
  log_line("gear-sweep: ", direction, ", ", result.mesh_frequency.size(), " speeds, ", result.periods.sum(),
           " mesh periods, jumps: ",
           result.hunting_periods > 1 ? "not looked for, since teeth differ"
                                      : jump_words(result.jump_frequency, result.jump_width),
           " -> ", stage.output());
  std::string speeds;
  for (Eigen::Index i = 0; i < result.mesh_frequency.size(); ++i)
    if (result.period_multiple[i] == 0) speeds += text(speeds.empty() ? "" : ", ", result.mesh_frequency[i]);
  tell_remarks(result.remarks);
  if (!speeds.empty())
    log_line("gear-sweep: the motion does not become periodic at ", speeds,
             " Hz; raise damping, or periodicity in [discretisation]");
}

void sweep_pair(const StageCommand& stage, const Provenance& made, Direction direction, double jump_width,
                bool next_level) {
  SweepParameters settings = read_sweep_parameters(stage.params());
  const auto [pair, at_torque, at_reference] =
      read_pair_inputs(stage.bodies(), stage.statics(), stage.reference(), settings);
  const auto& [driver, driven] = pair;
  std::vector<NextSweep> next;
  if (next_level) next = next_sweeps(driver, driven, at_torque, at_reference, settings);
  const auto run = [&](const ReducedBody& a, const ReducedBody& b, const StaticResult& at,
                       double mean_stiffness, const SweepParameters& s, const std::string& name) {
    return sweep(a, b, at, mean_stiffness, s, direction, StepsDone(text("gear-sweep ", direction, name)),
                 nullptr, jump_width);
  };
  const SweepResult result = run(driver, driven, at_torque, at_reference.mean_stiffness, settings, "");
  write(stage.output(), result, made);
  log_line("gear-sweep: ", result.torque, " N m ", direction, ", ", result.mesh_frequency.size(), " speeds, ",
           result.periods.sum(), " mesh periods, ",
           result.jump_frequency.size() > 0
               ? "jumps at " + jump_words(result.jump_frequency, result.jump_width)
               : "no jump",
           " -> ", stage.output());
  tell_remarks(result.remarks);
  for (const NextSweep& s : next)
    if (s.missing.empty())
      for (const std::string& line : change_words(
               s, result, run(s.body[0], s.body[1], s.statics, s.mean_stiffness, s.settings, " " + s.to)))
        log_line("gear-sweep: ", line);
    else
      log_line("gear-sweep: ", s.key, " = \"", s.from, "\" against \"", s.to,
               "\" is not compared: ", s.missing);
}

SweepErrorsResult errors_of(const StageCommand& stage, Direction direction) {
  const StepsDone steps(text("gear-sweep ", direction, " errors"));
  if (stage.of_train()) {
    const SystemSweepParameters settings = read_system_sweep_parameters(stage.params());
    return sweep_errors(settings, read_bodies(stage.bodies(), settings), direction, steps);
  }
  SweepParameters settings = read_sweep_parameters(stage.params());
  const auto [pair, at_torque, at_reference] =
      read_pair_inputs(stage.bodies(), stage.statics(), stage.reference(), settings);
  return sweep_errors(pair[0], pair[1], at_torque, at_reference, settings, direction, steps);
}

void body(int argc, char** argv) {
  Options options{"Speed sweep of the dynamic response, with contact solved at every step", "gear-sweep"};
  StageCommand stage(options, "sweep.toml", StageCommand::Reads::bodies_and_rest);
  std::string way;
  bool next_level = false, errors = false;
  double jump_width = 0;
  options.add("--direction", way, "up or down").required().one_of({"up", "down"});
  options.add("--jump-width", jump_width,
              "enclose jumps to this width in Hz or less (default: 1/64 of the step of the speeds)");
  const Option of_errors =
      stage.flag("--errors", errors, "refine one discretisation at a time and write sweep_errors.h5 instead");
  stage
      .flag(
          "--next-level", next_level,
          "sweep with the next level of [fidelity] contact and with that of body as well, and say what they change")
      .excludes(of_errors);
  stage.add_output("sweep.h5").required();
  options.footer(
      "Examples:\n"
      "  gear-sweep --params out/parker2000/params/sweep.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --static out/parker2000/T150/static.h5 --reference-static out/parker2000/T100/static.h5 --direction up --output sweep.h5\n"
      "  gear-sweep --params out/three-in-line/params/sweep.toml --body pinion=out/three-in-line/pinion/body.h5 --body idler=out/three-in-line/idler/body.h5 --body wheel=out/three-in-line/wheel/body.h5 --direction up --output train.h5");
  options.parse(argc, argv);
  const Direction direction = choice_of<Direction>(way).value();
  const bool train = stage.of_train();
  const Provenance made = stage.made_by(argc, argv);
  if (errors) {
    const SweepErrorsResult result = errors_of(stage, direction);
    write(stage.output(), result, made);
    return log_line("gear-sweep: ", sweep_errors_words(result), " -> ", stage.output());
  }
  if (train) return sweep_train(stage, made, direction, jump_width);
  sweep_pair(stage, made, direction, jump_width, next_level);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
