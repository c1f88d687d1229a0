// gear-static: transmission error, mesh stiffness and tooth loads of two gears at rest, over one mesh period.
//
// Reads   params (stage parameters of a scene: mesh, contact discretisation), body.h5 of driver and driven gear
// Writes  static.h5   transmission error, secant and tangent stiffness, load of each pair, harmonics, certificate
// Equations: d = A p + C q + e >= 0, p >= 0, p . d = 0 (Eq. 18) with B p = lambda (Eq. 20); k = (T / r_b) / STE.
// With --error-budget: error_budget.h5, the changes of mean stiffness, peak to peak and harmonics by each refinement, and
// for information those by the other near field and the other contact.
// With --next-level: beside static.h5, in words, what contact = "strips" would change in the result of contact = "line".
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "results/error_budget.h"
#include "results/static.h"
#include "signal/spectrum.h"
#include "studies/error_budget.h"
#include "system/statics.h"

namespace {

// periods: mesh periods that the samples are of; those of `base` periods are its harmonics.
Eigen::VectorXd mean_and_harmonics(const Eigen::VectorXd& samples, int periods, int base) {
  const int count = whine::resolved_harmonics(samples.size(), 40, periods) * (periods / base);
  const whine::Harmonics h = whine::harmonics(samples, count, base);
  Eigen::VectorXd out(count + 1);
  out << h.mean, h.amplitude;
  return out;
}

void tell_change(const std::string& where, const whine::StaticDifference& change, int strips) {
  if (change.positions == 0) return;
  whine::log_line("gear-static: ", strips, " strips change, ", where, " (", change.positions,
                  " positions): transmission error by ", change.error_largest * 100, " % at most, ",
                  change.error_rms * 100, " % RMS; pair loads by ", change.load_largest * 100, " % at most, ",
                  change.load_rms * 100, " % RMS of the load");
}

// What each halving of the elements on the root changes, and the order at last where the changes show one.
void tell_root_stress(const std::array<std::string, whine::kSides>& gears,
                      const whine::RootConvergence& root) {
  for (int g = 0; g < whine::kSides; ++g) {
    std::string changes;
    for (Eigen::Index k = 0; k < root.change.rows(); ++k)
      changes += whine::text(k > 0 ? ", " : "", std::round(1e5 * root.change(k, g)) / 1e3 + 0.0);
    const double order = whine::resolved_order(root, root.order.rows() - 1, g);
    whine::log_line("gear-static: largest root stress of ", gears[static_cast<size_t>(g)], " changes by ",
                    changes, " % each time the elements on the root are halved",
                    !std::isfinite(order) ? ""
                    : order > 0           ? whine::text("; order at last ", std::round(10 * order) / 10)
                                          : "; the last changes do not shrink");
  }
}

void body(int argc, char** argv) {
  whine::Options options{"Static transmission error, mesh stiffness and tooth loads over a mesh period",
                         "gear-static"};
  std::string params, output;
  std::vector<std::string> bodies;
  std::string torque_word;
  bool budget = false, next_level = false;
  options.add("--params", params, "stage parameters of the scene: out/<scene>/params/static.toml").required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--torque", torque_word, "torque on the driver in N m, above 0").required();
  options.add("--output", output, "static.h5 to write").required();
  whine::Option of_budget = options.flag(
      "--error-budget", budget, "refine one discretisation at a time and write error_budget.h5 instead");
  options.flag("--next-level", next_level, "for contact = \"line\": say what \"strips\" would change")
      .excludes(of_budget);
  options.footer(
      "Example:\n"
      "  gear-static --params out/parker2000/params/static.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --torque 150 --output static.h5");
  options.parse(argc, argv);

  const double torque = whine::number_option("--torque", torque_word);
  const whine::NamedFiles files("--body", bodies);
  const whine::Provenance provenance = whine::made_by(argc, argv, files.and_inputs({"params=" + params}));
  const whine::StaticParameters settings = whine::read_static_parameters(params);
  const auto [driver, driven] = whine::read_bodies(files, settings);
  std::optional<whine::StepsShown> steps(std::in_place, "gear-static");
  if (budget) {
    const whine::ErrorBudgetResult errors = whine::error_budget(driver, driven, settings, torque);
    steps.reset();
    whine::write(output, errors, provenance);
    whine::log_line("gear-static: error budget at ", torque, " N m (", errors.refinement.entry,
                    "): mean stiffness to ", errors.refinement.mean_stiffness_change.cwiseAbs().sum() * 100,
                    " % in all -> ", output);
    const whine::RootConvergence root = whine::convergence(errors.root);
    if (root.order.rows() > 0) tell_root_stress(errors.mesh.gear, root);
    if (!errors.choice_missing.empty())
      whine::log_line("gear-static: warning: no other choice to compare with: ", errors.choice_missing);
    return;
  }
  whine::StaticResult result = whine::static_transmission(driver, driven, settings, torque);
  std::optional<whine::NextLevel> change;
  if (next_level) change = whine::next_contact_level(driver, driven, settings, result);
  const int periods = result.hunting_periods;
  result.transmission_error_harmonic = mean_and_harmonics(result.transmission_error, periods, periods);
  result.stiffness_harmonic = mean_and_harmonics(result.stiffness_secant, periods, periods);
  if (periods > 1)
    result.transmission_error_order = mean_and_harmonics(result.transmission_error, periods, 1);
  result.reference_contact = whine::reference_contact(driver, driven, result);
  steps.reset();

  whine::write(output, result, provenance);
  const auto& te = result.transmission_error;
  whine::log_line("gear-static: ", torque, " N m, contact ratio ", result.contact_ratio, ", mean stiffness ",
                  result.mean_stiffness * 1e-6, " N/µm, transmission error ", te.minCoeff() * 1e6, " to ",
                  te.maxCoeff() * 1e6, " µm -> ", output);
  if (change) {
    tell_change("where a pair carries load off the line of action", change->corner, settings.contact.strips);
    tell_change("elsewhere", change->elsewhere, settings.contact.strips);
  }
  for (const whine::Remark& remark : result.remarks)
    whine::log_line("gear-static: ", remark.warning ? "warning: " : "", remark.words);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
