// gear-static: gears at rest, over one mesh period, or over the hunting period of teeth that differ.
//
// Reads   params (stage parameters of a scene: meshes, of a train its layout, contact discretisation), body.h5 of every gear
// Writes  static.h5   of each mesh transmission error, secant and tangent stiffness, harmonics, load, pressure and root stress of each
//                     pair of teeth, compliance, losses; of each body bearing force and torque; load sharing; certificate
// Equations: d = A p + C q + e >= 0, p >= 0, p . d = 0 (Eq. 18) with B p = lambda (Eq. 20), of a train for every body that is not
// held (common/system/system.h); k = (T / r_b) / STE.
// With --error-budget: error_budget.h5, the changes of mean stiffness, peak to peak and harmonics by each refinement, and
// for information those by the other near field and the other contact.
// Of a pair, with --next-level: beside static.h5, in words, what contact = "strips" would change in the result of contact = "line", and of
// helical, misaligned and lead-modified pairs what bodies in three dimensions would change in slices, or two degrees less in such bodies.
#include <algorithm>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/pair_inputs.h"
#include "io/scene.h"
#include "io/stage_command.h"
#include "io/static_words.h"
#include "results/error_budget.h"
#include "results/static.h"
#include "studies/error_budget.h"
#include "studies/width_levels.h"
#include "system/mesh_record.h"
#include "system/statics.h"
#include "system/system_rest.h"

namespace {
using namespace whine;

void tell(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) log_line("gear-static: ", line);
}

void tell_remarks(const std::vector<Remark>& remarks) {
  for (const Remark& remark : remarks)
    log_line("gear-static: ", remark.warning ? "warning: " : "", remark.words);
}

// Of a pair what the next level of contact, or over the face, would change beside.
struct AtRest {
  SystemStaticResult result;
  std::optional<NextLevel> change = {};
  std::optional<WidthChange> over_face = {};
};

AtRest pair_results(const StageCommand& stage, double torque, bool next_level) {
  const StaticParameters settings = read_static_parameters(stage.params());
  const bool one_slice = settings.fidelity.width == WidthModel::one;
  const auto [driver, driven] = read_bodies(stage.bodies(), settings);
  AtRest out{pair_at_rest(driver, driven, settings, torque)};
  StaticResult& mesh = out.result.mesh[0];
  if (next_level && one_slice) out.change = next_contact_level(driver, driven, settings, mesh);
  if (next_level && !one_slice)
    out.over_face = width_change(mesh, next_width_level(driver, driven, settings, mesh));
  add_harmonics(mesh);
  if (one_slice) mesh.reference_contact = reference_contact(driver, driven, mesh);
  return out;
}

AtRest train_results(const StageCommand& stage) {
  const SystemStaticParameters settings = read_system_static_parameters(stage.params());
  return {system_at_rest(settings, read_bodies(stage.bodies(), settings))};
}

void at_rest(const StageCommand& stage, const Provenance& made, double torque, bool next_level) {
  std::optional<StepsShown> steps(std::in_place, "gear-static");
  const AtRest rest = stage.of_train() ? train_results(stage) : pair_results(stage, torque, next_level);
  steps.reset();
  write(stage.output(), rest.result, made);
  std::vector<std::string> summary = summary_words(rest.result);
  summary.back() += " -> " + stage.output();
  tell(summary);
  tell(face_load_words(rest.result));
  if (rest.change) {
    const int strips = rest.result.mesh[0].contact.strips;
    tell(change_words("where a pair carries load off the line of action", rest.change->corner, strips));
    tell(change_words("elsewhere", rest.change->elsewhere, strips));
  }
  if (rest.over_face) tell({change_words(*rest.over_face)});
  tell_remarks(rest.result.remarks);
}

ErrorBudgetResult errors_of(const StageCommand& stage, double torque) {
  if (stage.of_train()) {
    const SystemStaticParameters settings = read_system_static_parameters(stage.params());
    return error_budget(settings, read_bodies(stage.bodies(), settings));
  }
  const StaticParameters settings = read_static_parameters(stage.params());
  const auto [driver, driven] = read_bodies(stage.bodies(), settings);
  return error_budget(driver, driven, settings, torque);
}

void error_budget_of(const StageCommand& stage, const Provenance& made, double torque) {
  std::optional<StepsShown> steps(std::in_place, "gear-static");
  const ErrorBudgetResult errors = errors_of(stage, torque);
  steps.reset();
  write(stage.output(), errors, made);
  log_line("gear-static: error budget at ", errors.torque, " N m (", errors.refinement.entry,
           "): mean stiffness to ", errors.refinement.mean_stiffness_change.cwiseAbs().sum() * 100,
           " % in all -> ", stage.output());
  tell(root_stress_words(errors));
  if (!errors.choice_missing.empty())
    log_line("gear-static: warning: no other choice to compare with: ", errors.choice_missing);
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
  stage
      .flag(
          "--next-level", next_level,
          "say what the next model level would change: strips for contact = \"line\", bodies in three dimensions for slices over the face, two degrees less for such bodies")
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
  if (budget) return error_budget_of(stage, made, torque);
  at_rest(stage, made, torque, next_level);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
