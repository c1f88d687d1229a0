// gear-sweep: the dynamic response of the pair at a series of speeds, each started from the state of the one before.
//
// Reads   params (stage parameters of a scene: damping, inertia, speeds, fidelity, time), body.h5 of both gears,
//         static.h5 of the torque (mesh, contact discretisation), static.h5 of the reference torque (mean stiffness of
//         the dampers)
// Writes  sweep.h5    transmission error and tooth loads over one orbit at every speed, energy, certificate, jumps
// Equations: Eq. 1-6 in modes of the hub-fixed gears, Newmark (Eq. 8) or exact propagators, Eq. 13-20 at every step
// With --next-level: beside sweep.h5, in words, what the same sweep gives on the next model level of contact and on that of
// body.
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "results/sweep.h"
#include "signal/jump_words.h"
#include "studies/next_level.h"
#include "studies/sweep.h"

namespace {

std::string in_words(const whine::LevelChange& change) {
  std::ostringstream out;
  out << change.largest * 100 << " % at most (" << change.at << " Hz), " << change.rms * 100 << " % RMS";
  return out.str();
}

void tell_change(const whine::NextSweep& next, const whine::SweepResult& here,
                 const whine::SweepResult& there) {
  const whine::SweepChange change = whine::sweep_change(here, there);
  const std::string level =
      whine::text("gear-sweep: ", next.key, " = \"", next.from, "\" against \"", next.to, "\"");
  whine::log_line(level, " at ", change.compared, " speeds: RMS of the transmission error off by ",
                  in_words(change.dte_rms), "; its mean by ", in_words(change.dte_mean),
                  "; peak tooth load by ", in_words(change.tooth_load));
  whine::log_line(level, ": jumps ", whine::jump_words(here.jump_frequency, here.jump_width), " against ",
                  whine::jump_words(there.jump_frequency, there.jump_width), "; on different branches at ",
                  change.apart, " speeds, with other periods or none at ", change.uneven);
}

void body(int argc, char** argv) {
  whine::Options options{"Speed sweep of the dynamic response, with contact solved at every step",
                         "gear-sweep"};
  std::string params, statics, reference, way, output;
  std::vector<std::string> bodies;
  bool next_level = false;
  double jump_width = 0;
  options.add("--params", params, "stage parameters of the scene: out/<scene>/params/sweep.toml").required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--static", statics, "static.h5 of the torque to run").required();
  options.add("--reference-static", reference, "static.h5 whose mean stiffness sets the bearing dampers")
      .required();
  options.add("--direction", way, "up or down").required().one_of({"up", "down"});
  options.add("--output", output, "sweep.h5 to write").required();
  options.add("--jump-width", jump_width,
              "enclose jumps to this width in Hz or less (default: 1/64 of the step of the speeds)");
  options.flag(
      "--next-level", next_level,
      "sweep with the next level of [fidelity] contact and with that of body as well, and say what they change");
  options.footer(
      "Example:\n"
      "  gear-sweep --params out/parker2000/params/sweep.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --static out/parker2000/T150/static.h5 --reference-static out/parker2000/T100/static.h5 --direction up --output sweep.h5");
  options.parse(argc, argv);
  const whine::Direction direction = whine::choice_of<whine::Direction>(way).value();

  const whine::NamedFiles files("--body", bodies);
  const whine::Provenance provenance = whine::made_by(
      argc, argv,
      files.and_inputs({"params=" + params, "static=" + statics, "reference_static=" + reference}));
  whine::SweepParameters settings = whine::read_sweep_parameters(params);
  const auto [pair, at_torque, at_reference] = whine::read_pair_inputs(files, statics, reference, settings);
  const auto& [driver, driven] = pair;
  std::vector<whine::NextSweep> next;
  if (next_level) next = whine::next_sweeps(driver, driven, at_torque, at_reference, settings);
  const auto run = [&](const whine::ReducedBody& a, const whine::ReducedBody& b,
                       const whine::StaticResult& at, double mean_stiffness, const whine::SweepParameters& s,
                       const std::string& name) {
    std::optional<whine::Progress> progress;
    return whine::sweep(
        a, b, at, mean_stiffness, s, direction,
        [&](long done, long total, const std::string& note) {
          if (!progress) progress.emplace(whine::text("gear-sweep ", direction, name), total);
          progress->update(done, note);
        },
        nullptr, jump_width);
  };
  const whine::SweepResult result = run(driver, driven, at_torque, at_reference.mean_stiffness, settings, "");

  whine::write(output, result, provenance);
  whine::log_line("gear-sweep: ", result.torque, " N m ", direction, ", ", result.mesh_frequency.size(),
                  " speeds, ", result.periods.sum(), " mesh periods, ",
                  result.jump_frequency.size() > 0
                      ? "jumps at " + whine::jump_words(result.jump_frequency, result.jump_width)
                      : "no jump",
                  " -> ", output);
  for (const whine::Remark& remark : result.remarks)
    whine::log_line("gear-sweep: ", remark.warning ? "warning: " : "", remark.words);
  for (const whine::NextSweep& s : next)
    if (s.missing.empty())
      tell_change(s, result, run(s.body[0], s.body[1], s.statics, s.mean_stiffness, s.settings, " " + s.to));
    else
      whine::log_line("gear-sweep: ", s.key, " = \"", s.from, "\" against \"", s.to,
                      "\" is not compared: ", s.missing);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
