// gear-impact: natural frequency and damping of the pair by ring-down, at a series of fixed mesh phases.
//
// Reads   params (stage parameters of a scene: damping, inertia, fidelity), body.h5 of both gears, static.h5 of the
//         torque (mesh, contact discretisation), static.h5 of the reference torque (mean stiffness of the dampers)
// Writes  impact.h5   frequency, damping ratio and decay per contact state; both, with the eigenvalues, per mesh phase
// Equations: Eq. 1-6 in modes of the hub-fixed gears, Eq. 13-20 at every step, Eq. 21; Table 1 of P2000.
// With --calibrate: the eta of Eq. 21 that gives a damping ratio in one contact state, on standard output; no file.
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "dynamics/impact.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "results/impact.h"
#include "studies/sweep.h"

namespace {

std::string states(const whine::ImpactResult& a) {
  std::ostringstream out;
  out << std::fixed;
  for (Eigen::Index i = 0; i < a.natural_frequency.size(); ++i)
    out << (i ? ", " : "") << a.contact_state[i] << std::setprecision(1) << " " << a.natural_frequency[i]
        << " Hz " << std::setprecision(3) << a.damping_ratio[i] * 100 << " %";
  return out.str();
}

// A line for a scene, with all that the number belongs to.
void print_calibration(const whine::ImpactResult& a, double ratio, whine::ContactState state) {
  std::cout << "rayleigh_stiffness_s = " << std::setprecision(5) << a.damping.rayleigh_stiffness
            << "  # damping ratio " << ratio << " by ring-down, loaded pairs: " << state << ", at "
            << a.torque << " N m, bearing_ratio " << a.damping.bearing_ratio << ", rayleigh_mass_per_s "
            << a.damping.rayleigh_mass << ", undamped_depth_mm " << a.damping.undamped_depth * 1e3
            << ", body " << a.fidelity.body << "; in all: " << states(a) << "\n";
}

void body(int argc, char** argv) {
  whine::Options options{"Natural frequency and damping of the pair at fixed mesh phases by ring-down",
                         "gear-impact"};
  whine::ImpactPlan plan;
  std::string params, statics, reference, output, step_word = whine::text(plan.torque_step), ratio_word,
                                                  state_word = "two";
  std::vector<std::string> bodies;
  options.add("--params", params, "stage parameters of the scene: out/<scene>/params/impact.toml").required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--static", statics, "static.h5 of the torque").required();
  options.add("--reference-static", reference, "static.h5 whose mean stiffness sets the bearing dampers")
      .required();
  options
      .add("--torque-step", step_word, "step of the torque that starts the decay, over the torque, up to 0.5")
      .show_default();
  whine::Option write = options.add("--output", output, "impact.h5 to write");
  whine::Option calibrate =
      options.add("--calibrate", ratio_word, "damping ratio to find the eta of Eq. 21 for; prints");
  options.add("--contact-state", state_word, "where that ratio holds: loaded pairs in words, or mean")
      .needs(calibrate)
      .show_default();
  write.excludes(calibrate);
  options.footer(
      "Example:\n"
      "  gear-impact --params out/parker2000/params/impact.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --static out/parker2000/T150/static.h5 --reference-static out/parker2000/T100/static.h5 --output impact.h5");
  options.parse(argc, argv);
  if (output.empty() && ratio_word.empty())
    whine::fail(whine::Failure::usage, "--output or --calibrate is needed; see --help");

  plan.torque_step = whine::number_option("--torque-step", step_word);
  const whine::NamedFiles files("--body", bodies);
  const whine::Provenance provenance = whine::made_by(
      argc, argv,
      files.and_inputs({"params=" + params, "static=" + statics, "reference_static=" + reference}));
  whine::ImpactParameters settings = whine::read_impact_parameters(params);
  const auto [pair, at_torque, at_reference] = whine::read_pair_inputs(files, statics, reference, settings);
  const auto& [driver, driven] = pair;
  std::optional<whine::Progress> progress;
  const auto report = [&](long done, long total) {
    if (!progress) progress.emplace("gear-impact", total);
    progress->update(done, "");
  };
  if (!ratio_word.empty()) {
    const double ratio = whine::number_option("--calibrate", ratio_word);
    const auto state = whine::choice_of<whine::ContactState>(state_word);
    if (!state)
      whine::fail(whine::Failure::usage, "--contact-state is '", state_word,
                  "', which is none of: one, two, three, ..., mean");
    const whine::ImpactResult result = whine::calibrate(
        driver, driven, at_torque, at_reference.mean_stiffness, settings, plan, ratio, *state, report);
    progress.reset();
    print_calibration(result, ratio, *state);
    return;
  }
  const whine::ImpactResult result =
      whine::impact(driver, driven, at_torque, at_reference.mean_stiffness, settings, plan, report);
  progress.reset();
  whine::write(output, result, provenance);
  whine::log_line("gear-impact: ", result.torque, " N m, loaded pairs: ", states(result), " -> ", output);
  if (result.mesh.friction.acts())
    whine::log_line("gear-impact: [friction] is left out: teeth do not slide at a fixed mesh phase");
  for (const whine::Remark& remark :
       whine::setup_remarks(at_torque, result.inertia, result.damping, result.fidelity))
    whine::log_line("gear-impact: warning: ", remark.words);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
