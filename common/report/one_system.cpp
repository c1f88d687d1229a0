#include "report/one_system.h"

#include <algorithm>

#include <cmath>

#include "base/error.h"
#include "gear/system_layout.h"
#include "signal/jump_words.h"

namespace whine {
namespace {

bool agree(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

bool one_source(const MotionSource& a, const MotionSource& b) {
  bool same = a.of_train() == b.of_train() && one_system(a.layout, b.layout);
  for (size_t g = 0; same && g < kSides; ++g)
    same = a.gear[g].design.teeth == b.gear[g].design.teeth &&
           a.gear[g].design.module == b.gear[g].design.module;
  return same;
}

// N m: on each body, of a pair on the driver.
Eigen::VectorXd torques_of(const MotionSource& a) {
  return a.of_train() ? a.drive : Eigen::VectorXd::Constant(1, a.torque);
}

}  // namespace

bool one_system(const System& a, const System& b) {
  bool same = a.bodies.size() == b.bodies.size() && a.meshes.size() == b.meshes.size();
  for (size_t i = 0; same && i < a.bodies.size(); ++i)
    same = a.bodies[i].name == b.bodies[i].name && a.bodies[i].teeth == b.bodies[i].teeth;
  return same;
}

void add_shafts(const System& system, Figure& figure) {
  try {
    figure.shafts = shafts_of(system);
  } catch (const Error& error) {
    if (error.kind() != Failure::input) throw;
    figure.no_shafts = error.what();
  }
}

void add_shafts(const MotionSource& source, Figure& figure) {
  if (source.of_train())
    add_shafts(source.layout, figure);
  else
    figure.shafts = shafts_of(source);
}

void require_one_system(const std::string& what, const MotionSource& source,
                        const std::vector<ResponseResult>& sweeps) {
  const Eigen::VectorXd torque = torques_of(source);
  for (size_t i = 0; i < sweeps.size(); ++i) {
    const ResponseResult& sweep = sweeps[i];
    const std::string of = text("the sweep ", name_of(sweep.direction));
    if (!one_source(sweep, source))
      fail(Failure::input, "figure: ", what, " and ", of,
           " are of two systems, with other bodies, teeth or meshes; give those of one scene");
    const Eigen::VectorXd other_torque = torques_of(sweep);
    for (Eigen::Index b = 0; b < torque.size(); ++b)
      if (!agree(other_torque[b], torque[b]))
        fail(Failure::input, "figure: the torque on '", source.body_names[static_cast<size_t>(b)], "' is ",
             torque[b], " N m in ", what, " and ", other_torque[b], " N m in ", of,
             "; give those of one scene");
    const Damping &own = source.damping, &other = sweep.damping;
    if (!agree(own.rayleigh_stiffness, other.rayleigh_stiffness) ||
        !agree(own.rayleigh_mass, other.rayleigh_mass))
      fail(Failure::input, "figure: the damping is ", own.rayleigh_stiffness, " s x stiffness + ",
           own.rayleigh_mass, " 1/s x mass in ", what, " and ", other.rayleigh_stiffness, " and ",
           other.rayleigh_mass, " in ", of, "; give those of one scene");
    for (size_t j = 0; j < i; ++j)
      if (sweeps[j].direction == sweep.direction)
        fail(Failure::input, "figure: two sweeps in the direction '", name_of(sweep.direction),
             "' are given; give one of each direction");
  }
}

bool jumps_between(const ResponseResult& sweep, double from, double to) {
  return std::any_of(sweep.jump_frequency.begin(), sweep.jump_frequency.end(),
                     [&](double jump) { return (jump - from) * (jump - to) <= 0; });
}

std::string jump_note(const std::vector<ResponseResult>& sweeps) {
  std::string words;
  for (const ResponseResult& sweep : sweeps)
    if (sweep.jump_frequency.size() > 0)
      words += text(words.empty() ? "jumps: " : "; ",
                    sweep.direction == Direction::up ? "speed rising " : "speed falling ",
                    jump_words(sweep.jump_frequency, sweep.jump_width));
  return words;
}

}  // namespace whine
