// gear-lumped: the one-degree-of-freedom model of Eq. 23 at a series of speeds, each started from the state of the one
// before.
//
// Reads   static.h5 of the torque (gears, mesh stiffness), static.h5 of the reference torque if the rectangular wave is not
//         to depend on the torque, params (slice of a scene: speeds, samples)
// Writes  sweep.h5, of the schema of gear-sweep: transmission error, mesh force, energy, jumps; with --map jump_map.h5, of
//         that of gear-jump-map: branches, contact loss and loads for a series of damping ratios
// Equation: m x'' + c x' + F(t) = T / r, F(t) = k(t) x for x >= 0 and 0 for x < 0 (Eq. 23), integrated exactly from event to
//         event (or by Newmark's method, Eq. 8); k(t) constant in cells of the mesh period;
//         pairs: the sum of unilateral springs, with --hertz each a polygon of 16 chords of Hertz's law
#include <cmath>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "gear/body_inertia.h"
#include "io/fit.h"
#include "io/jump_map_codec.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "io/static_codec.h"
#include "io/sweep_codec.h"
#include "lumped/stiffness.h"
#include "lumped/sweep.h"

namespace {

constexpr int kHertzChords = 16;  // 4e-4 from the law itself over two mesh periods with contact loss

int count_option(const std::string& name, const std::string& word) {
  const double value = whine::number_option(name, word);
  if (!(value >= 8 && value <= 65536 && value == std::floor(value)))
    whine::fail(whine::Failure::usage, name, " is ", word, "; it is a whole number from 8 to 65536");
  return static_cast<int>(value);
}

void require_same_pair(const std::string& one, const std::string& other) {
  for (const auto& input : whine::read_origin(one).inputs)
    if (input.role.starts_with("body ") && input.sha256 != whine::recorded_input(other, input.role))
      whine::fail(whine::Failure::input, other, ": is of another ", input.role, " than ", one,
                  "; give two results of one scene, or ", whine::rebuild_advice(other));
}

void body(int argc, char** argv) {
  whine::Options options{"Speed sweep of a lumped model with one degree of freedom (Eq. 23)", "gear-lumped"};
  whine::LumpedOptions o;
  std::string statics, reference, params, output, levels, duty, torque, cells, steps, from, to, step;
  std::string mass, at;
  std::vector<std::string> ratios{"0.08"};
  bool map = false, hertz = false;
  options
      .add("--model", o.model,
           "k(t): rectangular (two levels), secant or tangent (curve of the statics), pairs (a spring "
           "per pair)")
      .required()
      .one_of({"rectangular", "secant", "tangent", "pairs"});
  options.add("--static", statics, "static.h5 of the torque to run").required();
  options.add("--reference-static", reference,
              "static.h5 that the levels of the rectangular wave are read from, instead of --static");
  options.flag(
      "--hertz", hertz,
      "pairs: each spring follows Hertz's law of a line contact through its static load and deflection, as a "
      "polygon of 16 chords; without it springs are linear, with the stiffness at the static load");
  options.add("--levels", levels,
              "other levels of the rectangular wave, N/m: fewer pairs, more pairs (k1,k2), k2 not below k1");
  options.add("--duty", duty, "share of the mesh period with the second level, in (0, 1)");
  options.add("--torque", torque, "torque in N m; must be that of --static");
  options.add("--mass", mass, "mass in kg; default: I1 I2 / (I1 r2^2 + I2 r1^2) of the gears of --params");
  options.add("--damping-ratio", ratios, "c / (2 sqrt(mean stiffness x mass)); with --map several")
      .separated_by(',')
      .show_default();
  options.add("--damper", o.damper_acts, "always, as in Eq. 23, or in contact only")
      .show_default()
      .one_of({"always", "contact"});
  options.add("--integrator", o.integrator, "exact: from event to event; newmark: Eq. 8")
      .show_default()
      .one_of({"exact", "newmark"});
  options.add(
      "--cells", cells,
      "cells of constant stiffness in a period; default: a multiple of the static positions, 1024 or more");
  options.add(
      "--steps", steps,
      "stored samples per mesh period, and least steps of newmark; default: as --params says, or 128");
  options.add("--params", params,
              "stage parameters of the scene, with speeds and samples: out/<scene>/params/lumped.toml");
  options.add("--from", from,
              "lowest mesh frequency in Hz; with --to and --step in place of those of --params");
  options.add("--to", to, "highest mesh frequency in Hz");
  options.add("--step", step, "step of the mesh frequency in Hz");
  options.add("--direction", o.direction, "up or down").one_of({"up", "down"});
  options.flag("--map", map,
               "a map of jumps over the damping ratios instead of one sweep; --params is then "
               "out/<scene>/params/lumped_map.toml, each of --from, --to and --step has a default");
  options.add("--loads-at", at, "with --map: speed in Hz whose loads are stored apart; speeds fall on it");
  options.add("--output", output, "sweep.h5 to write, with --map jump_map.h5").required();
  options.footer(
      "Example:\n"
      "  gear-lumped --model rectangular --static out/parker2000/T150/static.h5 --reference-static "
      "out/parker2000/T100/static.h5 --params out/parker2000/params/lumped.toml --direction up "
      "--output lumped_sweep.h5");
  options.parse(argc, argv);

  const auto usage = [](const auto&... words) { whine::fail(whine::Failure::usage, words...); };
  const bool speeds = !from.empty() || !to.empty() || !step.empty(), stated = !levels.empty();
  if (map != o.direction.empty()) usage("--direction is needed for a sweep, and not taken by --map");
  if (!map && ratios.size() > 1)
    usage("--damping-ratio: a sweep has one, ", ratios.size(), " are given; --map takes several");
  if (!map && !at.empty()) usage("--loads-at goes with --map");
  if (!map && speeds && (from.empty() || to.empty() || step.empty()))
    usage("--from, --to and --step go together");
  if (!map && !speeds && params.empty())
    usage("--params or --from, --to and --step are needed, for the speeds");
  if (stated != !duty.empty()) usage("--levels and --duty go together");
  if (stated && o.model != "rectangular")
    usage("--levels and --duty are of the rectangular model, not of ", o.model);
  if (stated && !reference.empty())
    usage("--reference-static gives levels, --levels states them; give one of both");
  if (!reference.empty() && o.model != "rectangular")
    usage("--reference-static is of the rectangular model; ", o.model,
          " takes the stiffness at its own torque");
  if (!cells.empty() && o.model == "rectangular")
    usage("--cells: the rectangular model has two levels and no cells");
  if (hertz && o.model != "pairs") usage("--hertz is of the model pairs, not of ", o.model);
  if (mass.empty() && params.empty()) usage("--mass is needed without --params, which has the inertias");
  std::vector<double> damping_ratio;
  damping_ratio.reserve(ratios.size());
  for (const std::string& word : ratios)
    damping_ratio.push_back(whine::number_option("--damping-ratio", word));
  o.damping_ratio = damping_ratio.front();
  whine::MapSpeeds map_speeds;
  if (map)
    for (const auto& [name, word, value] :
         {std::tuple{"--from", &from, &map_speeds.from}, std::tuple{"--to", &to, &map_speeds.to},
          std::tuple{"--step", &step, &map_speeds.step},
          std::tuple{"--loads-at", &at, &map_speeds.load_frequency}}) {
      if (word->empty()) continue;
      *value = whine::number_option(name, *word);
      if (!(*value > 0)) usage(name, " is ", *value, " Hz; it must be above 0");
    }

  std::vector<std::string> inputs = {"static=" + statics};
  if (!reference.empty()) inputs.push_back("reference_static=" + reference);
  if (!params.empty()) inputs.push_back("params=" + params);
  const whine::Provenance provenance = whine::made_by(argc, argv, std::move(inputs));
  const whine::StaticArtifact at_torque = whine::read_static(statics);
  if (!torque.empty() && whine::number_option("--torque", torque) != at_torque.torque)
    whine::fail(whine::Failure::input, statics, " is at ", at_torque.torque, " N m, --torque says ", torque,
                "; give the static.h5 of that torque");
  whine::require_like_teeth(at_torque.mesh, "a lumped model");
  whine::require_rigid_bearings(at_torque.mesh, "a lumped model");
  if (at_torque.hunting_periods > 1)
    whine::fail(whine::Failure::input, statics, " holds ", at_torque.hunting_periods,
                " mesh periods, because a tooth is cracked: a lumped model takes teeth that are all alike; "
                "use a scene "
                "without [gear.<name>.crack]");
  const whine::StaticArtifact at_reference = reference.empty() ? at_torque : whine::read_static(reference);
  if (!params.empty()) {
    whine::SweepSlice slice = whine::read_lumped_slice(params, !map);
    whine::as_outlined(slice, at_torque);
    whine::require_contact(at_torque, slice.fidelity, statics);
    o.time = slice.time;
    o.mass = whine::reduced_mass(at_torque, slice.driver_inertia, slice.driven_inertia);
    o.frequency_from = slice.frequency_from;
    o.frequency_to = slice.frequency_to;
    o.frequency_step = slice.frequency_step;
    if (!reference.empty() && at_reference.torque != slice.reference_torque)
      whine::fail(whine::Failure::input, reference, " is at ", at_reference.torque,
                  " N m, but the scene's first torque is ", slice.reference_torque,
                  " N m; give the static.h5 of that torque");
  }
  if (!map && speeds) {
    o.frequency_from = whine::number_option("--from", from);
    o.frequency_to = whine::number_option("--to", to);
    o.frequency_step = whine::number_option("--step", step);
  }
  if (!mass.empty()) o.mass = whine::number_option("--mass", mass);
  if (!steps.empty()) o.time.steps_per_period = count_option("--steps", steps);

  const int positions = static_cast<int>(at_torque.mesh_phase.size());
  const int cell_count =
      cells.empty() ? positions * ((1023 + positions) / positions) : count_option("--cells", cells);
  whine::LumpedParameters springs;
  Eigen::VectorXi numbers = Eigen::VectorXi::Zero(1);
  if (o.model == "rectangular") {
    if (!reference.empty()) require_same_pair(statics, reference);
    whine::RectangularWave wave = whine::rectangular_wave(at_reference);
    if (stated) {
      const size_t comma = levels.find(',');
      if (comma == std::string::npos)
        usage("--levels is '", levels, "'; two numbers with a comma between are needed");
      wave = whine::stated_wave(at_torque, whine::number_option("--levels", levels.substr(0, comma)),
                                whine::number_option("--levels", levels.substr(comma + 1)),
                                whine::number_option("--duty", duty));
    }
    springs = whine::cells_of(wave);
  } else if (o.model == "pairs") {
    springs = whine::cells_of_pairs(at_torque, cell_count, numbers, hertz ? kHertzChords : 0);
    if (hertz) o.model += "-hertz";
  } else {
    springs = whine::cells_of(o.model == "secant" ? at_torque.stiffness_secant : at_torque.stiffness_tangent,
                              cell_count, at_torque.unloaded_error);
  }

  std::optional<whine::Progress> progress;
  const auto report = [&](long done, long total, const std::string& note) {
    if (!progress) progress.emplace("gear-lumped " + o.model + " " + (map ? "map" : o.direction), total);
    progress->update(done, note);
  };
  if (map) {
    const whine::JumpMapArtifact result =
        whine::lumped_jump_map(at_torque, springs, numbers, o, map_speeds, damping_ratio, report);
    progress.reset();
    whine::write(output, result, provenance);
    whine::tell("gear-lumped: ", result.model, ", ", result.torque, " N m, ", result.two_branches.sum(),
                " of ", result.two_branches.size(), " dampings with two branches, ",
                (result.loss_to.array() > 0).count(), " with contact loss -> ", output);
    if (result.unsteady.sum() > 0)
      whine::tell("gear-lumped: warning: no steady motion at ", result.unsteady.sum(), " speeds of ",
                  2 * result.two_branches.size() * result.mesh_frequency.size(),
                  "; their last periods are taken");
    return;
  }
  const whine::SweepArtifact result = whine::lumped_sweep(at_torque, springs, numbers, o, report);
  whine::write(output, result, provenance);
  std::string jumps;
  for (double f : result.jump_frequency) jumps += whine::text(jumps.empty() ? ", jumps at " : ", ", f, " Hz");
  whine::tell("gear-lumped: ", o.model, ", ", result.torque, " N m ", o.direction, ", mean stiffness ",
              result.mean_stiffness * 1e-6, "e6 N/m, mass ", o.mass, " kg, natural frequency ",
              result.natural_frequency, " Hz, damping ratio ", o.damping_ratio, ", ",
              result.mesh_frequency.size(), " speeds, ", result.periods.sum(), " mesh periods",
              jumps.empty() ? ", no jump" : jumps, " -> ", output);
  for (Eigen::Index i = 0; i < result.mesh_frequency.size(); ++i)
    if (result.period_multiple[i] == 0)
      whine::tell("gear-lumped: warning: at ", result.mesh_frequency[i],
                  " Hz the motion is not periodic after ", result.periods[i],
                  " mesh periods; the state still changes by ", result.residual[i], " per period");
  if (result.backlash_margin <= 0)
    whine::tell("gear-lumped: warning: the motion goes ", -result.backlash_margin * 1e6,
                " µm beyond the backlash; back flanks would touch, which is not modelled");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
