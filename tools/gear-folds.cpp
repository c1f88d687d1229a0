// gear-folds: the folds of the pair's branches over damping, torque or tip relief, and the cusps in which they end.
//
// Reads   params (that of sweeps: damping, inertia, fidelity, time), static-params (stage parameters: mesh, contact), body.h5 of
//         both gears
// Writes  fold_curves.h5   along each curve: value, damping ratio, mesh frequency, multipliers on either side; cusps
// Equations: y = P(y; f) and a vertical tangent of the branch; a sweep jumps where it meets a fold, and beyond a cusp there is
//            one motion.
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "gear/body_inertia.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "results/fold_curves.h"
#include "studies/fold_curves.h"

namespace {

whine::FoldQuantity quantity_of(const std::string& word) {
  const auto quantity = whine::choice_of<whine::FoldQuantity>(word);
  if (!quantity)
    whine::fail(whine::Failure::usage, "--over is ", word, "; it must be damping, torque or tip_relief");
  return *quantity;
}

void body(int argc, char** argv) {
  whine::Options options{"Folds of the branches over damping, torque or tip relief, with their cusps",
                         "gear-folds"};
  whine::FoldCurvesPlan plan;
  std::string params, static_params, output, torque, over, first, from, to;
  std::vector<std::string> bodies, values;
  options.add("--params", params, "stage parameters of the scene: out/<scene>/params/sweep.toml").required();
  options
      .add("--static-params", static_params, "stage parameters of the scene: out/<scene>/params/static.toml")
      .required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--torque", torque, "torque on the driver in N m; where it varies --first counts").required();
  options.add("--over", over, "damping, torque or tip_relief").required();
  options
      .add("--first", first,
           "value at which a branch gives the folds: damping ratio with two pairs in contact, N m, um")
      .required();
  options.add("--values", values, "values to go through on either side of it, ascending")
      .separated_by(',')
      .required();
  options.add("--from", from, "least speed in Hz (default: 0.57 of the rigid gears' frequency)");
  options.add("--to", to, "largest speed in Hz (default: 1.2 of it)");
  options.add("--output", output, "fold_curves.h5 to write").required();
  options.footer(
      "Example:\n"
      "  gear-folds --params out/parker2000/params/sweep.toml --static-params out/parker2000/params/static.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --torque 150 --over damping --first 0.07 --values 0.06,0.065,0.07,0.075,0.08,0.09,0.1 --output fold_curves.h5");
  options.parse(argc, argv);

  plan.quantity = quantity_of(over);
  const double unit = plan.quantity == whine::FoldQuantity::tip_relief ? 1e-6 : 1;
  plan.first = unit * whine::number_option("--first", first);
  for (const std::string& word : values) plan.values.push_back(unit * whine::number_option("--values", word));
  if (!from.empty()) plan.from = whine::number_option("--from", from);
  if (!to.empty()) plan.to = whine::number_option("--to", to);
  const whine::NamedFiles files("--body", bodies);
  const whine::Provenance provenance =
      whine::made_by(argc, argv, files.and_inputs({"params=" + params, "static_params=" + static_params}));
  whine::SweepParameters settings = whine::read_sweep_parameters(params);
  const whine::StaticParameters statics = whine::read_static_parameters(static_params);
  const auto [driver, driven] = whine::read_bodies(files, statics);
  whine::as_drawn(settings, {driver.inertia, driven.inertia});

  std::optional<whine::Progress> progress;
  const whine::FoldCurvesResult result =
      whine::fold_curves(driver, driven, statics, whine::number_option("--torque", torque), settings, plan,
                         [&](long done, long total, const std::string& note) {
                           if (!progress) progress.emplace("gear-folds", total);
                           progress->update(done, note);
                         });
  progress.reset();
  whine::write(output, result, provenance);
  std::string cusps;
  for (Eigen::Index i = 0; i < result.cusp_value.size(); ++i)
    cusps += whine::text(", cusp at ", result.cusp_value[i], " (damping ratio ", result.cusp_damping_ratio[i],
                         ") and ", result.cusp_frequency[i], " Hz");
  whine::log_line("gear-folds: ", result.torque, " N m, ", result.value.size(), " folds over ",
                  result.quantity, cusps.empty() ? ", no cusp" : cusps, " (", result.end, ") -> ", output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
