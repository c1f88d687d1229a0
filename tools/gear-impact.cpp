// gear-impact: natural frequencies and damping by ring-down, at a series of fixed mesh phases.
//
// Reads   params (stage parameters of a scene: damping, inertia, fidelity; of a train meshes and layout, too), body.h5 of every gear;
//         of a pair static.h5 of the torque (mesh, contact discretisation) and of the reference torque (mean stiffness of the dampers)
// Writes  impact.h5   of a pair frequency, damping ratio and decay per contact state, after a step of the torque; of a train those of
//                     the lowest modes, after an impulse along each, beside the natural frequencies of rigid gears; both with the
//                     eigenvalues, per mesh phase
// Equations: Eq. 1-6 in modes of the hub-fixed gears, Eq. 13-20 at every step, Eq. 21; Table 1 of P2000.
// Of a pair, with --calibrate: the eta of Eq. 21 that gives a damping ratio in one contact state, on standard output; no file.
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

#include "base/error.h"
#include "base/tool.h"
#include "dynamics/impact.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/pair_inputs.h"
#include "io/scene.h"
#include "io/stage_command.h"
#include "results/impact.h"
#include "studies/sweep.h"
#include "studies/system_impact.h"

namespace {
using namespace whine;

std::string states(const ContactStateDecays& a) {
  std::ostringstream out;
  out << std::fixed;
  for (Eigen::Index i = 0; i < a.natural_frequency.size(); ++i)
    out << (i ? ", " : "") << a.contact_state[i] << std::setprecision(1) << " " << a.natural_frequency[i]
        << " Hz " << std::setprecision(3) << a.damping_ratio[i] * 100 << " %";
  return out.str();
}

// A line for a scene, with all that the number belongs to.
void print_calibration(const ImpactResult& a, double ratio, ContactState state) {
  std::cout << "rayleigh_stiffness_s = " << std::setprecision(5) << a.damping.rayleigh_stiffness
            << "  # damping ratio " << ratio << " by ring-down, loaded pairs: " << state << ", at "
            << a.torque << " N m, bearing_ratio " << a.damping.bearing_ratio << ", rayleigh_mass_per_s "
            << a.damping.rayleigh_mass << ", undamped_depth_mm " << a.damping.undamped_depth * 1e3
            << ", body " << a.fidelity.body << "; in all: " << states(a.states) << "\n";
}

constexpr const char* kWithoutFriction =
    "gear-impact: [friction] is left out: teeth do not slide at a fixed mesh phase";

void impact_of_train(const StageCommand& stage, const Provenance& made, const SystemImpactPlan& plan) {
  const SystemSweepParameters settings = read_system_impact_parameters(stage.params());
  const std::vector<ReducedBody> gears = read_bodies(stage.bodies(), settings);
  const ImpactResult result = system_impact(settings, gears, plan, StepsDone("gear-impact"));
  write(stage.output(), result, made);
  const Eigen::VectorXd lowest = result.natural_frequency.col(0), ratio = result.damping_ratio.col(0);
  log_line("gear-impact: ", result.mesh_phase.size(), " phases, ", result.damping_ratio.cols(),
           " modes, the lowest at ", lowest.minCoeff(), " to ", lowest.maxCoeff(), " Hz with ",
           ratio.minCoeff() * 100, " to ", ratio.maxCoeff() * 100, " % -> ", stage.output());
  if (settings.friction().acts()) log_line(kWithoutFriction);
  constexpr double kUnresolved = 1e-4;  // a ratio is then off by some of its digits
  if (const auto rough = (result.fit_residual.array() > kUnresolved).count(); rough > 0)
    log_line(
        "gear-impact: warning: ", rough, " of ", result.fit_residual.size(),
        " decays are no sum of exponentials (/fit_residual); take a smaller --impulse, or the eigenvalues (/eigen_damping_ratio)");
}

// ratio: to calibrate for, in place of a file.
void impact_of_pair(const StageCommand& stage, const Provenance& made, const ImpactPlan& plan,
                    std::optional<double> ratio, ContactState state) {
  SweepParameters settings = read_impact_parameters(stage.params());
  const auto [pair, at_torque, at_reference] =
      read_pair_inputs(stage.bodies(), stage.statics(), stage.reference(), settings);
  const auto& [driver, driven] = pair;
  if (ratio) {
    print_calibration(calibrate(driver, driven, at_torque, at_reference.mean_stiffness, settings, plan,
                                *ratio, state, StepsDone("gear-impact")),
                      *ratio, state);
    return;
  }
  const ImpactResult result = impact(driver, driven, at_torque, at_reference.mean_stiffness, settings, plan,
                                     StepsDone("gear-impact"));
  write(stage.output(), result, made);
  log_line("gear-impact: ", result.torque, " N m, loaded pairs: ", states(result.states), " -> ",
           stage.output());
  if (result.mesh.friction.acts()) log_line(kWithoutFriction);
  for (const Remark& remark : setup_remarks(at_torque, result.inertia, result.damping, result.fidelity))
    log_line("gear-impact: warning: ", remark.words);
}

void body(int argc, char** argv) {
  Options options{"Natural frequencies and damping at fixed mesh phases by ring-down", "gear-impact"};
  ImpactPlan plan;
  SystemImpactPlan of_train;
  std::string step_word = text(plan.torque_step), impulse = text(of_train.impulse), ratio_word,
              state_word = "two";
  StageCommand stage(options, "impact.toml", StageCommand::Reads::bodies_and_rest);
  stage
      .add("--torque-step", step_word, "step of the torque that starts the decay, over the torque, up to 0.5")
      .show_default();
  Option calibrates =
      stage.add("--calibrate", ratio_word, "damping ratio to find the eta of Eq. 21 for; prints");
  stage.add("--contact-state", state_word, "where that ratio holds: loaded pairs in words, or mean")
      .needs(calibrates)
      .show_default();
  stage.add("--modes", of_train.modes, "modes of the lowest frequencies").show_default();
  stage.add("--phases", of_train.phases, "mesh phases at which the gears stay").show_default();
  stage
      .add("--impulse", impulse,
           "size of the vibration over the deflection at rest, by the roots of their energies, up to 0.1")
      .show_default();
  stage.add_output("impact.h5").excludes(calibrates);
  options.footer(
      "Examples:\n"
      "  gear-impact --params out/parker2000/params/impact.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --static out/parker2000/T150/static.h5 --reference-static out/parker2000/T100/static.h5 --output impact.h5\n"
      "  gear-impact --params out/three-in-line/params/impact.toml --body pinion=out/three-in-line/pinion/body.h5 --body idler=out/three-in-line/idler/body.h5 --body wheel=out/three-in-line/wheel/body.h5 --output train.h5");
  options.parse(argc, argv);
  if (stage.output().empty() && ratio_word.empty())
    fail(Failure::usage, "--output or --calibrate is needed; see --help");

  const bool train = stage.of_train();
  const Provenance made = stage.made_by(argc, argv);
  of_train.impulse = number_option("--impulse", impulse);
  if (train) return impact_of_train(stage, made, of_train);
  plan.torque_step = number_option("--torque-step", step_word);
  std::optional<double> ratio;
  if (!ratio_word.empty()) ratio = number_option("--calibrate", ratio_word);
  const auto state = choice_of<ContactState>(state_word);
  if (!state)
    fail(Failure::usage, "--contact-state is '", state_word,
         "', which is none of: one, two, three, ..., mean");
  impact_of_pair(stage, made, plan, ratio, *state);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
