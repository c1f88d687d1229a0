#include "io/sound_inputs.h"

#include <array>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "results/sweep.h"
#include "studies/runup.h"

namespace whine {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Gear and axis of a bearing whose force an artifact holds.
template <class Mesh, class Held>
std::pair<size_t, int> bearing_of(const std::string& path, const std::string& wanted, const Mesh& mesh,
                                  const Held& held) {
  for (size_t g = 0; g < kSides; ++g)
    for (const int axis : {0, 1})
      if (held(g) && wanted == mesh.gear[g] + (axis == 0 ? ":x" : ":y")) return {g, axis};
  fail(Failure::usage, "--bearing ", printable(wanted, 80),
       ": wanted is <gear>:x or <gear>:y of a gear on an elastic bearing; ", path, " is of ", mesh.gear[0],
       " and ", mesh.gear[1]);
}

}  // namespace

void require_sound_inputs(const std::vector<std::string>& paths) {
  std::map<std::string, std::string> known;  // path by SHA-256
  for (const std::string& path : paths) {
    require_fresh(path);
    const auto [same, first] = known.try_emplace(sha256_of_file(path), path);
    if (!first)
      fail(Failure::usage, path, ": is the same as ", same->second,
           ", which is heard already; give each branch once");
  }
}

HeardMotion heard_motion(const std::string& path, double frequency, const std::string& bearing) {
  const SweepResult sweep = read<SweepResult>(path);
  Index row = 0;
  const double off = (sweep.mesh_frequency.array() - frequency).abs().minCoeff(&row);
  if (!(off <= 1e-9 * frequency))
    fail(Failure::input, path, ": holds no speed of ", frequency, " Hz; the nearest is ",
         sweep.mesh_frequency[row], " Hz");
  if (sweep.period_multiple[row] == 0)
    fail(Failure::input, path, ": the motion at ", frequency, " Hz is not periodic; choose another speed");
  // One orbit; behind it the row repeats.
  const Index periods = sweep.period_multiple[row], samples = periods * sweep.time.steps_per_period;
  HeardMotion out{name_of(sweep.direction), sweep.mesh_frequency[row] / static_cast<double>(periods),
                  sweep.mesh_force.row(row).head(samples)};
  if (bearing.empty()) return out;
  const auto [g, axis] =
      bearing_of(path, bearing, sweep.mesh, [&](size_t side) { return !sweep.bearing_force[side].empty(); });
  out.record = sweep.bearing_force[g][static_cast<size_t>(row)].col(axis).head(samples);
  return out;
}

HeardRunup heard_runup(const std::string& path, const std::string& bearing) {
  const RunupResult a = read<RunupResult>(path);
  if (a.sample_rate != std::round(a.sample_rate))
    fail(Failure::input, path, ": has ", a.sample_rate,
         " samples a second, a sound a whole number; make the run-up with --sample-rate 48000");
  HeardRunup out{name_of(a.direction), static_cast<int>(a.sample_rate), a.samples.mesh_frequency,
                 a.samples.mesh_force};
  if (bearing.empty()) return out;
  const auto [g, axis] = bearing_of(path, bearing, a.mesh,
                                    [&](size_t side) { return a.samples.bearing_force[side].size() > 0; });
  out.record = a.samples.bearing_force[g].col(axis);
  return out;
}

void number_names(const std::vector<std::string*>& names) {
  std::map<std::string, std::vector<std::string*>> named;
  for (std::string* name : names) named[*name].push_back(name);
  for (const auto& [name, same] : named)
    for (size_t i = 0; same.size() > 1 && i < same.size(); ++i) *same[i] += text("_", i + 1);
}

}  // namespace whine
