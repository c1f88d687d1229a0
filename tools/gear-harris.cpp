// gear-harris: peak-to-peak transmission error and its first harmonics against torque and tip relief (Harris map).
//
// Reads   static-params (stage parameters of a scene: mesh with modifications, contact), body.h5 of both gears; with --dynamic
//         params (stage parameters: damping, inertia, speeds, time), too. Of a train: body.h5 of all gears, and --mesh, of which the two
//         gears are taken as a pair on rigid bearings under what the mesh carries
// Writes  harris_map.h5   the map at rest, the optimum for the design torque, its curve over torque (the Harris cusp), and
//                         what a finer solution of some points differs by; with --dynamic the RMS at the worst speed
// Equations: as gear-static; with --dynamic as gear-sweep
#include <ctime>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/number_list.h"
#include "base/progress.h"
#include "base/tool.h"
#include "gear/body_inertia.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "io/static_words.h"
#include "results/harris_map.h"
#include "studies/harris_plan.h"

namespace {

using namespace whine;

// The map at rest, checked at so many points; with params (of sweeps) in motion, too. took: s of this processor.
HarrisMapResult computed(const ReducedBody& first, const ReducedBody& second,
                         const StaticParameters& settings, const HarrisPlan& plan, int checks,
                         const std::string& params, const std::string& reference, double& took) {
  std::optional<Progress> progress;
  const auto report = [&](long done, long total, const std::string& note) {
    if (!progress) progress.emplace("gear-harris", total);
    progress->update(done, note);
  };
  const std::clock_t begin = std::clock();
  HarrisMapResult map = harris_map(first, second, settings, plan, report);
  took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  progress.reset();
  if (checks > 0) check(map, first, second, plan.positions, checks);
  if (!params.empty()) {
    SweepParameters moving = read_sweep_parameters(params);
    as_drawn(moving, {first.inertia, second.inertia});
    add_dynamics(map, first, second, moving, read_pair_statics(reference).mean_stiffness, report);
    progress.reset();
  }
  return map;
}

void body(int argc, char** argv) {
  Options options{"Transmission error against torque and tip relief", "gear-harris"};
  HarrisPlan plan;
  std::string params, static_params, output, torque, relief, start, length, design,
      points = "0", reference, mesh, shape = name_of(plan.shape), relieved = name_of(plan.relieved);
  std::vector<std::string> bodies;
  bool dynamic = false;
  options
      .add("--static-params", static_params, "stage parameters of the scene: out/<scene>/params/static.toml")
      .required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add(
      "--torque", torque,
      "torques on the driver in N m, from:to:count or with commas (default: 60 up to twice the design torque)");
  options.add(
      "--relief-um", relief,
      "tip reliefs in micrometres, in the same way (default: 40 up to 1.2 times what the teeth bend under the largest torque)");
  Option start_option = options.add(
      "--start-deg", start,
      "roll angles of the driver at which they start, largest first, with commas; the driven gear's relief has the same length of roll (default: as in the scene, or the highest point of single-pair contact)");
  options.add("--length-mm", length, "the same as lengths of roll to the tip, smallest first")
      .excludes(start_option);
  options.add("--shape", shape, "how the relief grows").show_default().one_of({"linear", "parabolic"});
  options.add("--relieved", relieved, "whose tips").show_default().one_of({"driver", "driven", "both"});
  options.add(
      "--design-torque", design,
      "torque in N m for which the optimum is sought (default: midway; of a train what the mesh carries)");
  options.add("--mesh", mesh,
              "of a train: the mesh, sun-planet1 for example; torques are those on its driving gear");
  options.add("--positions", plan.positions, "mesh positions").show_default();
  options.add("--strips", plan.strips, "strips across the contact at the least load of a range of torques")
      .show_default();
  options
      .add("--check", points,
           "points to solve again with 3 times the strips and positions, beside the optimum")
      .show_default();
  Option dynamic_option =
      options.flag("--dynamic", dynamic, "sweep up and down at every point: minutes to hours");
  options.add("--params", params, "with --dynamic: out/<scene>/params/sweep.toml").needs(dynamic_option);
  options.add("--reference-static", reference, "with --dynamic: static.h5 that sets the bearing dampers")
      .needs(dynamic_option);
  options.add("--output", output, "harris_map.h5 to write").required();
  options.footer(
      "Example:\n"
      "  gear-harris --static-params out/parker2000/params/static.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --torque 5:300:60 --relief-um 0:20:40 --design-torque 150 --output harris_map.h5");
  options.parse(argc, argv);
  plan.shape = choice_of<ReliefShape>(shape).value();
  plan.relieved = choice_of<Relieved>(relieved).value();
  if (dynamic && (params.empty() || reference.empty()))
    fail(Failure::usage, "--dynamic needs --params and --reference-static");
  const NamedFiles files("--body", bodies);
  const bool train = is_system_scene(static_params);
  if (train && dynamic) fail(Failure::usage, "--dynamic: the map of a train is at rest; leave it out");
  const MeshInputs mapped = read_mesh_inputs(static_params, mesh, files);
  const StaticParameters& settings = mapped.settings;
  const ReducedBody &first = mapped.body[0], &second = mapped.body[1];
  if (!design.empty()) plan.design_torque = number_option("--design-torque", design);
  if (design.empty() && train) plan.design_torque = mapped.torque;
  if (torque.empty() && !(plan.design_torque > 0))
    fail(Failure::usage,
         train ? "--torque is needed: the mesh carries no load" : "--torque or --design-torque is needed");
  plan.torque = number_list("--torque", torque);
  if (torque.empty()) plan.torque = default_torques(plan.design_torque);
  if (design.empty() && !train) plan.design_torque = 0.5 * (plan.torque.front() + plan.torque.back());
  const double checks = number_option("--check", points);
  std::vector<std::string> inputs = files.and_inputs({"static_params=" + static_params});
  if (dynamic) inputs.insert(inputs.end(), {"params=" + params, "reference_static=" + reference});
  const Provenance provenance = made_by(argc, argv, std::move(inputs));
  plan.length = relief_lengths(number_list("--start-deg", start), number_list("--length-mm", length), first,
                               second, settings.mesh, plan.relieved);
  for (const double um : number_list("--relief-um", relief)) plan.relief.push_back(um * 1e-6);
  if (relief.empty()) plan.relief = default_reliefs(first, second, settings, plan.torque.back());
  double took = 0;
  const HarrisMapResult map = computed(first, second, settings, plan, static_cast<int>(checks),
                                       dynamic ? params : "", reference, took);
  write(output, map, provenance);
  for (const std::string& line : harris_words(map)) log_line("gear-harris: ", line);
  log_line("gear-harris: ", took, " s of CPU -> ", output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
