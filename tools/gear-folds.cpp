// gear-folds: the folds of the branches of a pair or a train over a second quantity, and the cusps in which they end.
//
// Reads   params (that of sweeps: damping, inertia, fidelity, time; of a train meshes and layout, too), body.h5 of every gear; of a
//         pair static-params (stage parameters: mesh, contact)
// Writes  fold_curves.h5   along each curve: value, damping ratio, mesh frequency, multipliers on either side; cusps
// Equations: y = P(y; f) and a vertical tangent of the branch; a sweep jumps where it meets a fold, and beyond a cusp there is
//            one motion.
#include <string>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "gear/body_inertia.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/pair_inputs.h"
#include "io/scene.h"
#include "io/stage_command.h"
#include "results/fold_curves.h"
#include "studies/fold_curves.h"

namespace {
using namespace whine;

FoldCurvesResult folds_of(const StageCommand& stage, double torque, const FoldCurvesPlan& plan) {
  const StepsDone report("gear-folds");
  if (stage.of_train()) {
    const SystemSweepParameters settings = read_system_sweep_parameters(stage.params());
    return fold_curves(settings, read_bodies(stage.bodies(), settings), plan, report);
  }
  SweepParameters settings = read_sweep_parameters(stage.params());
  const StaticParameters statics = read_static_parameters(stage.static_params());
  const auto [driver, driven] = read_bodies(stage.bodies(), statics);
  as_drawn(settings, {driver.inertia, driven.inertia});
  return fold_curves(driver, driven, statics, torque, settings, plan, report);
}

void body(int argc, char** argv) {
  Options options{"Folds of the branches over a second quantity, with their cusps", "gear-folds"};
  StageCommand stage(options, "sweep.toml", StageCommand::Reads::bodies_and_parameters);
  FoldCurvesPlan plan;
  std::string over, first;
  std::vector<std::string> values;
  double torque = 0;
  stage.add("--torque", torque, "torque on the driver in N m; where it varies --first counts");
  options
      .add("--over", over,
           "damping, torque, bearing_stiffness (of elastic bearings) or, of pairs, tip_relief")
      .required()
      .one_of({"damping", "torque", "bearing_stiffness", "tip_relief"});
  options
      .add(
          "--first", first,
          "value at which a branch gives the folds: damping ratio; N m, of a train on the body whose torque drives it; 1, bearing stiffness over that of the scene; um")
      .required();
  options.add("--values", values, "values to go through on either side of it, ascending")
      .separated_by(',')
      .required();
  options.add(
      "--from", plan.from,
      "least speed in Hz (default: 0.57 of the rigid gears' frequency, of a train that of the scene)");
  options.add("--to", plan.to, "largest speed in Hz (default: 1.2 of it, of a train that of the scene)");
  stage.add_output("fold_curves.h5").required();
  options.footer(
      "Examples:\n"
      "  gear-folds --params out/parker2000/params/sweep.toml --static-params out/parker2000/params/static.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --torque 150 --over damping --first 0.07 --values 0.06,0.065,0.07,0.075,0.08,0.09,0.1 --output fold_curves.h5\n"
      "  gear-folds --params out/three-in-line/params/sweep.toml --body pinion=out/three-in-line/pinion/body.h5 --body idler=out/three-in-line/idler/body.h5 --body wheel=out/three-in-line/wheel/body.h5 --over bearing_stiffness --first 1 --values 0.8,0.9,1,1.1,1.25 --output train.h5");
  options.parse(argc, argv);

  plan.quantity = choice_of<FoldQuantity>(over).value();
  const double unit = plan.quantity == FoldQuantity::tip_relief ? 1e-6 : 1;
  plan.first = unit * number_option("--first", first);
  plan.values.reserve(values.size());
  for (const std::string& word : values) plan.values.push_back(unit * number_option("--values", word));
  const Provenance made = stage.made_by(argc, argv);
  const FoldCurvesResult result = folds_of(stage, torque, plan);
  write(stage.output(), result, made);
  std::string cusps;
  for (Eigen::Index i = 0; i < result.cusp_value.size(); ++i)
    cusps += text(", cusp at ", result.cusp_value[i], " (damping ratio ", result.cusp_damping_ratio[i],
                  ") and ", result.cusp_frequency[i], " Hz");
  log_line("gear-folds: ", result.of_train() ? "" : text(result.torque, " N m, "), result.value.size(),
           " folds over ", result.quantity, cusps.empty() ? ", no cusp" : cusps, " (", result.end, ") -> ",
           stage.output());
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
