// gear-harris: peak-to-peak transmission error and its first harmonics against torque and tip relief (Harris map).
//
// Reads   static-params (slice of a scene: mesh with modifications, contact), body.h5 of driver and driven gear; with
//         --dynamic params (slice: damping, inertia, speeds, time), too
// Writes  harris_map.h5   the map at rest, the optimum for the design torque, its curve over torque (the Harris cusp), and
//                         what a finer solution of some points differs by; with --dynamic the RMS at the worst speed
// Equations: as gear-static; with --dynamic as gear-sweep
#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "gear/body_inertia.h"
#include "gear/pair.h"
#include "io/body_codec.h"
#include "io/fit.h"
#include "io/harris_map_codec.h"
#include "io/named_files.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "io/static_codec.h"
#include "motion/harris_map.h"
#include "motion/statics.h"

namespace {

// "5:300:60": 60 numbers from 5 to 300; "5,10,20": these.
std::vector<double> numbers(const std::string& name, const std::string& word) {
  const bool range = word.find(':') != std::string::npos;
  std::vector<double> values;
  for (size_t at = 0; at <= word.size();) {
    const size_t end = std::min(word.find(range ? ':' : ',', at), word.size());
    values.push_back(whine::number_option(name, word.substr(at, end - at)));
    at = end + 1;
  }
  if (!range) return values;
  if (values.size() != 3 || values[2] != std::floor(values[2]) || values[2] < 2 || values[2] > 10000)
    whine::fail(whine::Failure::usage, name, " is ", word,
                "; write from:to:count, as in 5:300:60, or numbers with commas");
  std::vector<double> out;
  out.reserve(static_cast<size_t>(values[2]));
  for (int i = 0; i < values[2]; ++i)
    out.push_back(values[0] + (values[1] - values[0]) * i / (values[2] - 1));
  return out;
}

// Lengths of roll to the tip edge, m, of starts given as roll angles of the driver. What does not fit a flank that is relieved is
// refused in degrees, as it was given.
std::vector<double> lengths_of(const std::string& word, const whine::GearDesign& driver,
                               const whine::GearDesign& driven, const std::string& relieved) {
  const double degree = std::numbers::pi / 180;
  const whine::ToothGeometry gear(driver), other(driven);
  const auto involute = [](const whine::ToothGeometry& g) {
    return g.base_radius() * (g.tip_roll_angle() - g.form_roll_angle());
  };
  const double longest = relieved == "driver"   ? involute(gear)
                         : relieved == "driven" ? involute(other)
                                                : std::min(involute(gear), involute(other));
  const double tip = gear.tip_roll_angle() / degree, least = tip - longest / gear.base_radius() / degree;
  std::vector<double> lengths;
  double before = tip;
  for (const double start : numbers("--start-deg", word)) {
    if (!(start >= least && start < tip))
      whine::fail(whine::Failure::usage, "--start-deg is ", start, " deg; a relief starts between ", least,
                  " deg, where the involute begins, and the tip edge at ", tip,
                  " deg (roll angles of the driver)");
    if (start >= before)
      whine::fail(whine::Failure::usage, "--start-deg is ", start, " deg after ", before,
                  " deg; the largest comes first");
    before = start;
    lengths.push_back(gear.base_radius() * (tip - start) * degree);
  }
  return lengths;
}

void body(int argc, char** argv) {
  whine::Options options{"Transmission error against torque and tip relief", "gear-harris"};
  whine::HarrisPlan plan;
  std::string params, static_params, output, torque, relief, start, length, design, points = "0", reference;
  std::vector<std::string> bodies;
  bool dynamic = false;
  options
      .add("--static-params", static_params, "stage parameters of the scene: out/<scene>/params/static.toml")
      .required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--torque", torque,
              "torques on the driver in N m, from:to:count or with commas (default: 60 up to twice the "
              "design torque)");
  options.add("--relief-um", relief,
              "tip reliefs in micrometres, in the same way (default: 40 up to 1.2 times what the teeth "
              "bend under the largest torque)");
  whine::Option start_option = options.add(
      "--start-deg", start,
      "roll angles of the driver at which they start, largest first, with commas; the driven gear's "
      "relief has the same length of roll (default: as in the scene, or the highest point of single-pair "
      "contact)");
  options.add("--length-mm", length, "the same as lengths of roll to the tip, smallest first")
      .excludes(start_option);
  options.add("--shape", plan.shape, "how the relief grows").show_default().one_of({"linear", "parabolic"});
  options.add("--relieved", plan.relieved, "whose tips").show_default().one_of({"driver", "driven", "both"});
  options.add("--design-torque", design, "torque in N m for which the optimum is sought (default: midway)");
  options.add("--positions", plan.positions, "mesh positions").show_default();
  options.add("--strips", plan.strips, "strips across the contact at the least load of a range of torques")
      .show_default();
  options
      .add("--check", points,
           "points to solve again with 3 times the strips and positions, beside the optimum")
      .show_default();
  whine::Option dynamic_option =
      options.flag("--dynamic", dynamic, "sweep up and down at every point: minutes to hours");
  options.add("--params", params, "with --dynamic: out/<scene>/params/sweep.toml").needs(dynamic_option);
  options.add("--reference-static", reference, "with --dynamic: static.h5 that sets the bearing dampers")
      .needs(dynamic_option);
  options.add("--output", output, "harris_map.h5 to write").required();
  options.footer(
      "Example:\n"
      "  gear-harris --static-params out/parker2000/params/static.toml --body "
      "pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --torque 5:300:60 "
      "--relief-um 0:20:40 --design-torque 150 --output harris_map.h5");
  options.parse(argc, argv);

  if (dynamic && (params.empty() || reference.empty()))
    whine::fail(whine::Failure::usage, "--dynamic needs --params and --reference-static");
  if (torque.empty() && design.empty())
    whine::fail(whine::Failure::usage, "--torque or --design-torque is needed");
  if (!design.empty()) plan.design_torque = whine::number_option("--design-torque", design);
  constexpr int kTorques = 60, kReliefs = 40;
  if (torque.empty())
    for (int t = 1; t <= kTorques; ++t) plan.torque.push_back(2 * plan.design_torque * t / kTorques);
  else
    plan.torque = numbers("--torque", torque);
  if (design.empty()) plan.design_torque = 0.5 * (plan.torque.front() + plan.torque.back());
  const double checks = whine::number_option("--check", points);
  const whine::NamedFiles files("--body", bodies);
  std::vector<std::string> inputs = files.and_inputs({"static_params=" + static_params});
  if (dynamic) inputs.insert(inputs.end(), {"params=" + params, "reference_static=" + reference});
  const whine::Provenance provenance = whine::made_by(argc, argv, std::move(inputs));
  const whine::StaticSlice slice = whine::read_static_slice(static_params);
  const std::vector<std::string> paths = files.of(slice.mesh);
  const whine::BodyArtifact first = whine::read_body(paths[0]), second = whine::read_body(paths[1]);
  whine::require_body(first, slice.driver_body, slice.mesh.driver, paths[0]);
  whine::require_body(second, slice.driven_body, slice.mesh.driven, paths[1]);
  if (!start.empty()) {
    plan.length = lengths_of(start, first.design, second.design, plan.relieved);
  } else if (!length.empty()) {
    for (double mm : numbers("--length-mm", length)) plan.length.push_back(mm * 1e-3);
  } else {
    plan.length = {whine::single_pair_relief_length(first, second, slice.mesh)};
    // The scene's own relief, if it has one.
    const whine::ToothGeometry gear(first.design);
    const whine::Relief& own = slice.mesh.modification[0].tip;
    const double start_roll =
        own.start_radius > 0 ? gear.roll_angle_at_radius(own.start_radius) : own.start_roll;
    if (start_roll > 0) plan.length = {gear.base_radius() * (gear.tip_roll_angle() - start_roll)};
    if (own.length > 0) plan.length = {own.length};
  }
  if (relief.empty()) {
    whine::StaticSlice rest = slice;
    for (whine::FlankModification& m : rest.mesh.modification) m.tip = {};
    constexpr int kCoarse = 32;
    rest.contact.positions = kCoarse;
    const double bent =
        whine::static_transmission(first, second, rest, plan.torque.back()).transmission_error.maxCoeff();
    const double largest = std::ceil(1.2 * bent * 1e6) * 1e-6;
    for (int r = 0; r < kReliefs; ++r) plan.relief.push_back(largest * r / (kReliefs - 1));
  } else {
    for (const double um : numbers("--relief-um", relief)) plan.relief.push_back(um * 1e-6);
  }

  std::optional<whine::Progress> progress;
  const auto report = [&](long done, long total, const std::string& note) {
    if (!progress) progress.emplace("gear-harris", total);
    progress->update(done, note);
  };
  const std::clock_t begin = std::clock();
  whine::HarrisMapArtifact map = whine::harris_map(first, second, slice, plan, report);
  const double took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;  // s of this processor
  progress.reset();
  if (checks > 0) whine::check(map, first, second, plan.positions, static_cast<int>(checks));
  if (dynamic) {
    whine::SweepSlice moving = whine::read_sweep_slice(params);
    whine::as_drawn(moving, {first.inertia, second.inertia});
    whine::add_dynamics(map, first, second, moving, whine::read_static(reference).mean_stiffness, report);
    progress.reset();
  }
  whine::write(output, map, provenance);
  whine::tell("gear-harris: ", plan.torque.size(), " torques x ", plan.relief.size(), " reliefs x ",
              plan.length.size(), " starts in ", took, " s of CPU -> ", output);
  for (Eigen::Index s = 0; s < map.length.size(); ++s) {
    const bool at_edge = plan.relief.size() > 1 && map.optimum_relief[s] >= plan.relief.back();
    whine::tell(
        "gear-harris: start ", map.start_roll(s, 0) * 180 / std::numbers::pi, " deg: at ", map.design_torque,
        " N m ", map.optimum_relief[s] * 1e6, " um leave ", map.optimum_peak_to_peak[s] * 1e6,
        " um peak to peak",
        at_edge ? "; that is the edge of the map: more relief may leave less, widen --relief-um" : "");
  }
  if (map.checked > 0)
    whine::tell("gear-harris: ", map.checked,
                " points solved again with 3 times the strips and positions differ by ",
                map.largest_error * 100, " % of the peak to peak at most");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
