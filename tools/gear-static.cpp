// gear-static: gears at rest, over one mesh period, or over the hunting period of teeth that differ.
//
// Reads   params (stage parameters of a scene: meshes, of a train its layout, contact discretisation), body.h5 of every gear
// Writes  static.h5   transmission error, loads, harmonics, certificate; of a pair secant and tangent stiffness, load of each pair
//                     of teeth; of a train load sharing, bearing forces, torques
// Equations: d = A p + C q + e >= 0, p >= 0, p . d = 0 (Eq. 18) with B p = lambda (Eq. 20), of a train for every body that is not
// held (common/system/system.h); k = (T / r_b) / STE.
// Of a pair, with --error-budget: error_budget.h5, the changes of mean stiffness, peak to peak and harmonics by each refinement, and
// for information those by the other near field and the other contact.
// Of a pair, with --next-level: beside static.h5, in words, what contact = "strips" would change in the result of contact = "line".
#include <algorithm>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/pair_inputs.h"
#include "io/stage_command.h"
#include "io/static_words.h"
#include "io/system_scene.h"
#include "results/error_budget.h"
#include "results/static.h"
#include "results/system_static.h"
#include "signal/spectrum.h"
#include "studies/error_budget.h"
#include "system/statics.h"
#include "system/system_rest.h"

namespace {
using namespace whine;

// periods: mesh periods that the samples are of; those of `base` periods are its harmonics.
Eigen::VectorXd mean_and_harmonics(const Eigen::VectorXd& samples, int periods, int base) {
  const int count = resolved_harmonics(samples.size(), 40, periods) * (periods / base);
  const Harmonics h = harmonics(samples, count, base);
  Eigen::VectorXd out(count + 1);
  out << h.mean, h.amplitude;
  return out;
}

void tell(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) log_line("gear-static: ", line);
}

void tell_remarks(const std::vector<Remark>& remarks) {
  for (const Remark& remark : remarks)
    log_line("gear-static: ", remark.warning ? "warning: " : "", remark.words);
}

void train_at_rest(const StageCommand& stage, const Provenance& made) {
  const SystemStaticParameters settings = read_system_static_parameters(stage.params());
  const std::vector<ReducedBody> gears = read_bodies(stage.bodies(), settings);
  std::optional<StepsShown> steps(std::in_place, "gear-static");
  const SystemStaticResult result = system_at_rest(settings, gears);
  steps.reset();
  write(stage.output(), result, made);
  const auto& te = result.transmission_error_harmonic;
  double most = 0;
  for (const MatrixRM& force : result.bearing_force) most = std::max(most, force.rowwise().norm().maxCoeff());
  if (result.hunting_periods > 1)
    log_line("gear-static: teeth differ: ", result.hunting_periods,
             " mesh periods, after which the same ones meet, of ", settings.contact.positions,
             " positions each");
  log_line("gear-static: ", settings.layout.bodies.size(), " bodies, ", te.cols(),
           " meshes, mean transmission errors ", te.row(0).minCoeff() * 1e6, " to ",
           te.row(0).maxCoeff() * 1e6, " µm, shares of the load up to ", result.load_share.maxCoeff() * 100,
           " %, bearing forces up to ", most, " N -> ", stage.output());
  tell_remarks(result.remarks);
}

void error_budget_of(const StageCommand& stage, const Provenance& made, double torque) {
  const StaticParameters settings = read_static_parameters(stage.params());
  const auto [driver, driven] = read_bodies(stage.bodies(), settings);
  std::optional<StepsShown> steps(std::in_place, "gear-static");
  const ErrorBudgetResult errors = error_budget(driver, driven, settings, torque);
  steps.reset();
  write(stage.output(), errors, made);
  log_line("gear-static: error budget at ", torque, " N m (", errors.refinement.entry,
           "): mean stiffness to ", errors.refinement.mean_stiffness_change.cwiseAbs().sum() * 100,
           " % in all -> ", stage.output());
  tell(root_stress_words(errors));
  if (!errors.choice_missing.empty())
    log_line("gear-static: warning: no other choice to compare with: ", errors.choice_missing);
}

void pair_at_rest(const StageCommand& stage, const Provenance& made, double torque, bool next_level) {
  const StaticParameters settings = read_static_parameters(stage.params());
  const auto [driver, driven] = read_bodies(stage.bodies(), settings);
  std::optional<StepsShown> steps(std::in_place, "gear-static");
  StaticResult result = static_transmission(driver, driven, settings, torque);
  std::optional<NextLevel> change;
  if (next_level) change = next_contact_level(driver, driven, settings, result);
  const int periods = result.hunting_periods;
  result.transmission_error_harmonic = mean_and_harmonics(result.transmission_error, periods, periods);
  result.stiffness_harmonic = mean_and_harmonics(result.stiffness_secant, periods, periods);
  if (periods > 1)
    result.transmission_error_order = mean_and_harmonics(result.transmission_error, periods, 1);
  result.reference_contact = reference_contact(driver, driven, result);
  steps.reset();
  write(stage.output(), result, made);
  const auto& te = result.transmission_error;
  log_line("gear-static: ", torque, " N m, contact ratio ", result.contact_ratio, ", mean stiffness ",
           result.mean_stiffness * 1e-6, " N/µm, transmission error ", te.minCoeff() * 1e6, " to ",
           te.maxCoeff() * 1e6, " µm -> ", stage.output());
  if (change) {
    const int strips = settings.contact.strips;
    tell(change_words("where a pair carries load off the line of action", change->corner, strips));
    tell(change_words("elsewhere", change->elsewhere, strips));
  }
  tell_remarks(result.remarks);
}

void body(int argc, char** argv) {
  Options options{"Gears at rest over a mesh period: transmission error, mesh stiffness, loads",
                  "gear-static"};
  StageCommand stage(options, "static.toml", StageCommand::Reads::bodies);
  std::string torque_word;
  bool budget = false, next_level = false;
  stage.add("--torque", torque_word, "torque on the driver in N m, above 0");
  const Option of_budget = stage.flag(
      "--error-budget", budget, "refine one discretisation at a time and write error_budget.h5 instead");
  stage.flag("--next-level", next_level, "for contact = \"line\": say what \"strips\" would change")
      .excludes(of_budget);
  stage.add_output("static.h5").required();
  options.footer(
      "Examples:\n"
      "  gear-static --params out/parker2000/params/static.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --torque 150 --output static.h5\n"
      "  gear-static --params out/three-in-line/params/static.toml --body pinion=out/three-in-line/pinion/body.h5 --body idler=out/three-in-line/idler/body.h5 --body wheel=out/three-in-line/wheel/body.h5 --output train.h5");
  options.parse(argc, argv);
  const bool train = stage.of_train();
  const double torque = train ? 0 : number_option("--torque", torque_word);
  const Provenance made = stage.made_by(argc, argv);
  if (train) return train_at_rest(stage, made);
  if (budget) return error_budget_of(stage, made, torque);
  pair_at_rest(stage, made, torque, next_level);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
