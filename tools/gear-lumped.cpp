// gear-lumped: the one-degree-of-freedom model of Eq. 23 at a series of speeds, each started from the state of the one
// before.
//
// Reads   static.h5 of the torque (gears, mesh stiffness), static.h5 of the reference torque if the rectangular wave is not
//         to depend on the torque, params (stage parameters of a scene: speeds, samples)
// Writes  sweep.h5, of the schema of gear-sweep: transmission error, mesh force, energy, jumps; with --map jump_map.h5, of
//         that of gear-jump-map: branches, contact loss and loads for a series of damping ratios
// Equation: m x'' + c x' + F(t) = T / r, F(t) = k(t) x for x >= 0 and 0 for x < 0 (Eq. 23), integrated exactly from event to
//         event (or by Newmark's method, Eq. 8); k(t) constant in cells of the mesh period;
//         pairs: the sum of unilateral springs, with --hertz each a polygon of 16 chords of Hertz's law
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/lumped_inputs.h"
#include "io/provenance.h"
#include "results/jump_map.h"
#include "results/sweep.h"
#include "signal/jump_words.h"

namespace {
using namespace whine;

struct Given {
  LumpedOptions o;
  std::string model, integrator = name_of(o.integrator), damper = name_of(o.damper_acts), direction;
  std::string statics, reference, params, output;
  std::vector<double> levels, ratios{o.damping_ratio};
  std::optional<double> duty, torque, mass, from, to, step, at;
  int cells = 0, steps = 0;
  bool map = false, hertz = false;
};

void declare(Options& options, Given& given) {
  constexpr int kFewest = 8, kMost = 65536;
  options
      .add(
          "--model", given.model,
          "k(t): rectangular (two levels), secant or tangent (curve of the statics), pairs (a spring per pair)")
      .required()
      .one_of({"rectangular", "secant", "tangent", "pairs"});
  options.add("--static", given.statics, "static.h5 of the torque to run").required();
  Option reference =
      options.add("--reference-static", given.reference,
                  "static.h5 that the levels of the rectangular wave are read from, instead of --static");
  options.flag(
      "--hertz", given.hertz,
      "pairs: each spring follows Hertz's law of a line contact through its static load and deflection, as a polygon of 16 chords; without it springs are linear, with the stiffness at the static load");
  Option levels =
      options
          .add("--levels", given.levels,
               "other levels of the rectangular wave, N/m: fewer pairs, more pairs (k1,k2), k2 not below k1")
          .separated_by(',')
          .excludes(reference);
  levels.needs(options.add("--duty", given.duty, "share of the mesh period with the second level, in (0, 1)")
                   .needs(levels));
  options.add("--torque", given.torque, "torque in N m; must be that of --static");
  options.add("--mass", given.mass,
              "mass in kg; default: I1 I2 / (I1 r2^2 + I2 r1^2) of the gears of --params");
  options.add("--damping-ratio", given.ratios, "c / (2 sqrt(mean stiffness x mass)); with --map several")
      .separated_by(',')
      .show_default();
  options.add("--damper", given.damper, "always, as in Eq. 23, or in contact only")
      .show_default()
      .one_of({"always", "contact"});
  options.add("--integrator", given.integrator, "exact: from event to event; newmark: Eq. 8")
      .show_default()
      .one_of({"exact", "newmark"});
  options
      .add(
          "--cells", given.cells,
          "cells of constant stiffness in a period; default: a multiple of the static positions, 1024 or more")
      .within(kFewest, kMost);
  options
      .add("--steps", given.steps,
           "stored samples per mesh period, and least steps of newmark; default: as --params says, or 128")
      .within(kFewest, kMost);
  options.add("--params", given.params,
              "stage parameters of the scene, with speeds and samples: out/<scene>/params/lumped.toml");
  options.add("--from", given.from,
              "lowest mesh frequency in Hz; with --to and --step in place of those of --params");
  options.add("--to", given.to, "highest mesh frequency in Hz");
  options.add("--step", given.step, "step of the mesh frequency in Hz");
  Option direction = options.add("--direction", given.direction, "up or down").one_of({"up", "down"});
  Option map =
      options
          .flag(
              "--map", given.map,
              "a map of jumps over the damping ratios instead of one sweep; --params is then out/<scene>/params/lumped_map.toml, each of --from, --to and --step has a default")
          .excludes(direction);
  options
      .add("--loads-at", given.at, "with --map: speed in Hz whose loads are stored apart; speeds fall on it")
      .needs(map);
  options.add("--output", given.output, "sweep.h5 to write, with --map jump_map.h5").required();
  options.footer(
      "Example:\n"
      "  gear-lumped --model rectangular --static out/parker2000/T150/static.h5 --reference-static out/parker2000/T100/static.h5 --params out/parker2000/params/lumped.toml --direction up --output lumped_sweep.h5");
}

// Which options go with which model, and with a sweep.
void check(const Given& given) {
  const auto usage = [](const auto&... words) { fail(Failure::usage, words...); };
  const bool rectangular = given.model == "rectangular";
  if (!given.levels.empty() && !rectangular)
    usage("--levels and --duty are of the rectangular model, not of ", given.model);
  if (!given.levels.empty() && given.levels.size() != 2)
    usage("--levels has ", given.levels.size(), ": ", given.levels[0],
          "; two numbers with a comma between are needed");
  if (!given.reference.empty() && !rectangular)
    usage("--reference-static is of the rectangular model; ", given.model,
          " takes the stiffness at its own torque");
  if (given.cells > 0 && rectangular) usage("--cells: the rectangular model has two levels and no cells");
  if (given.hertz && given.model != "pairs") usage("--hertz is of the model pairs, not of ", given.model);
  const int ends = given.from.has_value() + given.to.has_value() + given.step.has_value();
  if (!given.map && ends == 0 && given.params.empty())
    usage("--params or --from, --to and --step are needed, for the speeds");
  if (!given.mass && given.params.empty()) usage("--mass is needed without --params, which has the inertias");
  if (given.map) return;
  if (given.direction.empty()) usage("--direction is needed for a sweep, and not taken by --map");
  if (given.ratios.size() > 1)
    usage("--damping-ratio: a sweep has one, ", given.ratios.size(), " are given; --map takes several");
  if (ends != 0 && ends != 3) usage("--from, --to and --step go together");
}

MapSpeeds map_speeds_of(const Given& given) {
  MapSpeeds speeds;
  for (const auto& [name, value, target] :
       {std::tuple{"--from", given.from, &speeds.from}, std::tuple{"--to", given.to, &speeds.to},
        std::tuple{"--step", given.step, &speeds.step},
        std::tuple{"--loads-at", given.at, &speeds.load_frequency}}) {
    if (value && !(*value > 0)) fail(Failure::usage, name, " is ", *value, " Hz; it must be above 0");
    *target = value.value_or(*target);
  }
  return speeds;
}

SpringChoice springs_chosen(const Given& given) {
  SpringChoice choice{.model = given.o.model, .stated = !given.levels.empty(), .cells = given.cells};
  if (choice.stated) {
    choice.fewer = given.levels[0];
    choice.more = given.levels[1];
    choice.duty = *given.duty;
  }
  return choice;
}

void tell_map(const JumpMapResult& result, const std::string& output) {
  log_line("gear-lumped: ", name_of(result.model, result.damper_acts), ", ", result.torque, " N m, ",
           result.two_branches.sum(), " of ", result.two_branches.size(), " dampings with two branches, ",
           (result.loss_to.array() > 0).count(), " with contact loss -> ", output);
  if (result.unsteady.sum() > 0)
    log_line("gear-lumped: warning: no steady motion at ", result.unsteady.sum(), " speeds of ",
             2 * result.two_branches.size() * result.mesh_frequency.size(), "; their last periods are taken");
}

void tell_sweep(const SweepResult& result, const LumpedOptions& o, const std::string& output) {
  log_line("gear-lumped: ", o.model, ", ", result.torque, " N m ", o.direction, ", mean stiffness ",
           result.mean_stiffness * 1e-6, " N/µm, mass ", o.mass, " kg, natural frequency ",
           result.natural_frequency, " Hz, damping ratio ", o.damping_ratio,
           o.damping_ratio == LumpedOptions().damping_ratio
               ? " (that of P2000 for its pair; [damping] of the scene is not read), "
               : ", ",
           result.mesh_frequency.size(), " speeds, ", result.periods.sum(), " mesh periods, ",
           result.jump_frequency.size() > 0
               ? "jumps at " + jump_words(result.jump_frequency, result.jump_width)
               : "no jump",
           " -> ", output);
  for (Eigen::Index i = 0; i < result.mesh_frequency.size(); ++i)
    if (result.period_multiple[i] == 0)
      log_line("gear-lumped: warning: at ", result.mesh_frequency[i], " Hz the motion is not periodic after ",
               result.periods[i], " mesh periods; the state still changes by ", result.residual[i],
               " per period");
  if (result.backlash_margin <= 0)
    log_line("gear-lumped: warning: the motion goes ", -result.backlash_margin * 1e6,
             " µm beyond the backlash; back flanks would touch, which is not modelled");
}

void body(int argc, char** argv) {
  Options options{"Speed sweep of a lumped model with one degree of freedom (Eq. 23)", "gear-lumped"};
  Given given;
  declare(options, given);
  options.parse(argc, argv);
  check(given);
  LumpedOptions& o = given.o;
  o.model = motion_model_of(given.model + (given.hertz ? "-hertz" : "")).value();
  o.integrator = choice_of<Integrator>(given.integrator).value();
  o.damper_acts = choice_of<DamperActs>(given.damper).value();
  if (!given.map) o.direction = choice_of<Direction>(given.direction).value();
  o.damping_ratio = given.ratios.front();
  const MapSpeeds map_speeds = given.map ? map_speeds_of(given) : MapSpeeds{};

  std::vector<std::string> paths = {"static=" + given.statics};
  if (!given.reference.empty()) paths.push_back("reference_static=" + given.reference);
  if (!given.params.empty()) paths.push_back("params=" + given.params);
  const Provenance provenance = made_by(argc, argv, std::move(paths));
  const LumpedInputs inputs = read_lumped_inputs(given.statics, given.reference, given.params, !given.map, o);
  const StaticResult& at_torque = inputs.at_torque;
  if (given.torque && *given.torque != at_torque.torque)
    fail(Failure::input, given.statics, " is at ", at_torque.torque, " N m, --torque says ", *given.torque,
         "; give the static.h5 of that torque");
  if (!given.map && given.from) {
    o.frequency_from = *given.from;
    o.frequency_to = *given.to;
    o.frequency_step = *given.step;
  }
  o.mass = given.mass.value_or(o.mass);
  if (given.steps > 0) o.time.steps_per_period = given.steps;
  Eigen::VectorXi numbers;
  const LumpedParameters springs = springs_of(inputs, springs_chosen(given), numbers);

  const StepsDone report(text("gear-lumped ", o.model, " ", given.map ? "map" : given.direction));
  if (given.map) {
    const JumpMapResult result =
        lumped_jump_map(at_torque, springs, numbers, o, map_speeds, given.ratios, report);
    write(given.output, result, provenance);
    tell_map(result, given.output);
    return;
  }
  const SweepResult result = lumped_sweep(at_torque, springs, numbers, o, report);
  write(given.output, result, provenance);
  tell_sweep(result, o, given.output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
