// gear-jump-map: where the primary resonance has two branches, and what the teeth then carry, for a series of dampings.
//
// Reads   params (stage parameters of a scene: damping, inertia, fidelity, time), static-params (stage parameters:
//         mesh, contact), body.h5 of both gears
// Writes  jump_map.h5    per damping: ends of the branches, speeds that lose contact, tooth loads, jumps; the responses
// Equations: as gear-static and gear-sweep; damping ratios are those of the slowest eigenvalue with two pairs in contact
//            and the contact frozen under the static load (Eq. 21 for eta)
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "gear/body_inertia.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "results/jump_map.h"
#include "studies/jump_map.h"

namespace {
using namespace whine;

CornerRule corner_rule(const std::string& word) {
  if (word == "true" || word == "false") return {word == "true", std::numeric_limits<double>::infinity()};
  const double degrees = number_option("--corner-contact", word);
  if (!(degrees >= 0 && degrees <= 90))
    fail(Failure::usage, "--corner-contact is ", degrees,
         "; it must be true, false or an angle from 0 to 90 degrees");
  return {true, degrees * std::numbers::pi / 180};
}

void body(int argc, char** argv) {
  Options options{"Jumps, contact loss and tooth loads of the primary resonance against damping",
                  "gear-jump-map"};
  JumpMapPlan plan;
  std::string params, static_params, output, corner, contact;
  std::vector<std::string> bodies;
  std::optional<double> from, to, at;
  double torque = 0;
  options.add("--params", params, "stage parameters of the scene: out/<scene>/params/map.toml").required();
  options
      .add("--static-params", static_params, "stage parameters of the scene: out/<scene>/params/static.toml")
      .required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--torque", torque, "torque on the driver in N m, above 0").required();
  options.add("--corner-contact", corner, "true, false or degrees, instead of the scene's");
  options.add("--contact", contact, "line or strips, instead of the scene's").one_of({"line", "strips"});
  options
      .add("--damping-ratio", plan.damping_ratio,
           "ratios with two pairs in contact, to find the eta of Eq. 21 for")
      .separated_by(',');
  options
      .add("--rayleigh-stiffness", plan.rayleigh_stiffness,
           "etas of Eq. 21 in s, as they are; cases before the ratios")
      .separated_by(',');
  options.add("--from", from, "least speed in Hz (default: 0.57 of the rigid gears' frequency)");
  options.add("--to", to, "largest speed in Hz (default: 1.2 of it)");
  options.add("--step", plan.step, "step of the speeds in Hz").show_default();
  options.add("--loads-at", at, "speed in Hz whose tooth loads are stored apart; speeds fall on it");
  options.add("--output", output, "jump_map.h5 to write").required();
  options.footer(
      "Example:\n"
      "  gear-jump-map --params out/parker2000/params/map.toml --static-params out/parker2000/params/static.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --torque 150 --corner-contact false --damping-ratio 0.05,0.07 --loads-at 2400 --output jump_map.h5");
  options.parse(argc, argv);

  for (const auto& [name, value] :
       {std::pair{"--step", std::optional(plan.step)}, {"--from", from}, {"--to", to}, {"--loads-at", at}})
    if (value && !(*value > 0)) fail(Failure::usage, name, " is ", *value, " Hz; it must be above 0");
  plan.from = from.value_or(plan.from);
  plan.to = to.value_or(plan.to);
  plan.load_frequency = at.value_or(plan.load_frequency);
  const NamedFiles files("--body", bodies);
  const Provenance provenance =
      made_by(argc, argv, files.and_inputs({"params=" + params, "static_params=" + static_params}));
  SweepParameters settings = read_map_parameters(params);
  StaticParameters statics = read_static_parameters(static_params);
  if (!corner.empty()) statics.mesh.corner = corner_rule(corner);
  if (!contact.empty())
    statics.fidelity.contact = settings.fidelity.contact = choice_of<ContactModel>(contact).value();
  const auto [first, second] = read_bodies(files, statics);
  as_drawn(settings, {first.inertia, second.inertia});

  const JumpMapResult result =
      jump_map(first, second, statics, torque, settings, plan, StepsDone("gear-jump-map"));
  write(output, result, provenance);
  log_line("gear-jump-map: ", torque, " N m, ", result.two_branches.sum(), " of ", result.two_branches.size(),
           " dampings with two branches, ", (result.loss_to.array() > 0).count(), " with contact loss -> ",
           output);
  if (result.unsteady.sum() > 0)
    log_line("gear-jump-map: warning: no steady motion at ", result.unsteady.sum(), " speeds of ",
             2 * result.two_branches.size() * result.mesh_frequency.size(), "; their last periods are taken");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
