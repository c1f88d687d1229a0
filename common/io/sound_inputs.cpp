#include "io/sound_inputs.h"

#include <algorithm>
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

// Where a force stands that is asked for: on the bearing of a body, in one direction, or in a mesh; and in words.
struct Place {
  bool on_bearing = false;
  Index body = 0, axis = 0, mesh = 0;
  std::string words = {};
};

// has_bearing(b): whether the artifact holds the force on the bearing of a body.
template <class HasBearing>
Place place_of(const std::string& path, const HeardForce& wanted, const std::vector<std::string>& meshes,
               const std::vector<std::string>& bodies, const HasBearing& has_bearing) {
  const auto listed = [](const std::vector<std::string>& names) {
    std::string out;
    for (const std::string& name : names) out += (out.empty() ? "" : ", ") + printable(name, 80);
    return out;
  };
  if (!wanted.bearing.empty()) {
    for (size_t b = 0; b < bodies.size(); ++b)
      for (const int axis : {0, 1})
        if (has_bearing(b) && wanted.bearing == bodies[b] + (axis == 0 ? ":x" : ":y"))
          return {true, static_cast<Index>(b), axis, 0,
                  "force on the bearing of " + bodies[b] + (axis == 0 ? ", x" : ", y")};
    fail(Failure::usage, "--bearing ", printable(wanted.bearing, 80),
         ": wanted is <body>:x or <body>:y of a body on an elastic bearing; ", path, " is of ",
         listed(bodies));
  }
  for (size_t m = 0; m < meshes.size(); ++m)
    if (wanted.mesh.empty() || wanted.mesh == meshes[m])
      return {false, 0, 0, static_cast<Index>(m), "mesh force of " + meshes[m]};
  fail(Failure::usage, "--mesh ", printable(wanted.mesh, 80), ": there is no such mesh; ", path, " has ",
       listed(meshes));
}

Index speed_row(const std::string& path, const VectorXd& speeds, const Eigen::VectorXi& period_multiple,
                double frequency) {
  Index row = 0;
  const double off = (speeds.array() - frequency).abs().minCoeff(&row);
  if (!(off <= 1e-9 * frequency))
    fail(Failure::input, path, ": holds no speed of ", frequency, " Hz; the nearest is ", speeds[row], " Hz");
  if (period_multiple[row] == 0)
    fail(Failure::input, path, ": the motion at ", frequency, " Hz is not periodic; choose another speed");
  return row;
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

HeardMotion heard_motion(const std::string& path, double frequency, const HeardForce& force) {
  const SweepResult sweep = read<SweepResult>(path);
  const Index row = speed_row(path, sweep.mesh_frequency, sweep.period_multiple, frequency);
  const auto of = static_cast<size_t>(row);
  // One motion; behind it the row repeats.
  const Index periods = sweep.period_multiple[row],
              samples = std::min<Index>(periods * sweep.time.steps_per_period, sweep.samples());
  const Place at = place_of(path, force, sweep.mesh_names, sweep.body_names,
                            [&](size_t b) { return !sweep.bearing_force[b].empty(); });
  HeardMotion out{
      name_of(sweep.direction), at.words, sweep.mesh_frequency[row] / static_cast<double>(periods), {}};
  out.record = at.on_bearing ? VectorXd(sweep.bearing_force[static_cast<size_t>(at.body)][of].col(at.axis))
                             : VectorXd(sweep.mesh_force[of].col(at.mesh));
  out.record.conservativeResize(samples);
  return out;
}

HeardRunup heard_runup(const std::string& path, const HeardForce& force) {
  const RunupResult a = read<RunupResult>(path);
  if (a.sample_rate != std::round(a.sample_rate))
    fail(Failure::input, path, ": has ", a.sample_rate,
         " samples a second, a sound a whole number; make the run-up with --sample-rate 48000");
  const Place at =
      place_of(path, force, a.mesh_names, a.body_names, [&](size_t b) { return a.has_bearing(b); });
  return {name_of(a.direction), at.words, static_cast<int>(a.sample_rate), a.samples.mesh_frequency,
          at.on_bearing ? a.samples.bearing_force[static_cast<size_t>(at.body)].col(at.axis)
                        : a.samples.mesh_force.col(at.mesh)};
}

void number_names(const std::vector<std::string*>& names) {
  std::map<std::string, std::vector<std::string*>> named;
  for (std::string* name : names) named[*name].push_back(name);
  for (const auto& [name, same] : named)
    for (size_t i = 0; same.size() > 1 && i < same.size(); ++i) *same[i] += text("_", i + 1);
}

}  // namespace whine
