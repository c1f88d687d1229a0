#include "lumped/inputs.h"

#include "base/error.h"
#include "files/fit.h"
#include "files/provenance.h"
#include "files/scene.h"
#include "gear/scene_geometry.h"
#include "lumped/stiffness.h"

namespace whine {
namespace {

constexpr int kHertzChords = 16;  // 4e-4 from the law itself over two mesh periods with contact loss

void require_same_pair(const std::string& one, const std::string& other) {
  for (const auto& input : read_origin(one).inputs)
    if (input.role.starts_with("body ") && input.sha256 != recorded_input(other, input.role))
      fail(Failure::input, other, ": is of another ", input.role, " than ", one,
           "; give two results of one scene, or ", rebuild_advice(other));
}

}  // namespace

LumpedInputs read_lumped_inputs(const std::string& statics, const std::string& reference,
                                const std::string& params, bool with_speeds, LumpedOptions& options) {
  LumpedInputs inputs;
  inputs.at_torque = read_static(statics);
  const StaticArtifact& at_torque = inputs.at_torque;
  require_like_teeth(at_torque.mesh, "a lumped model");
  require_rigid_bearings(at_torque.mesh, "a lumped model");
  if (at_torque.hunting_periods > 1)
    fail(Failure::input, statics, " holds ", at_torque.hunting_periods,
         " mesh periods, because a tooth is cracked: a lumped model takes teeth that are all alike; use a "
         "scene "
         "without [gear.<name>.crack]");
  inputs.at_reference = reference.empty() ? at_torque : read_static(reference);
  if (params.empty()) {
    if (!reference.empty()) require_same_pair(statics, reference);
    return inputs;
  }
  SweepSlice slice = read_lumped_slice(params, with_speeds);
  as_drawn(slice, at_torque);
  require_contact(at_torque, slice.fidelity, statics);
  options.time = slice.time;
  options.mass = reduced_mass(at_torque, slice.driver_inertia, slice.driven_inertia);
  options.frequency_from = slice.frequency_from;
  options.frequency_to = slice.frequency_to;
  options.frequency_step = slice.frequency_step;
  if (!reference.empty() && inputs.at_reference.torque != slice.reference_torque)
    fail(Failure::input, reference, " is at ", inputs.at_reference.torque,
         " N m, but the scene's first torque is ", slice.reference_torque,
         " N m; give the static.h5 of that torque");
  if (!reference.empty()) require_same_pair(statics, reference);
  return inputs;
}

LumpedParameters springs_of(const LumpedInputs& inputs, const SpringChoice& choice,
                            Eigen::VectorXi& numbers) {
  const StaticArtifact& pair = inputs.at_torque;
  numbers = Eigen::VectorXi::Zero(1);
  if (choice.model == "rectangular")
    return cells_of(choice.stated ? stated_wave(pair, choice.fewer, choice.more, choice.duty)
                                  : rectangular_wave(inputs.at_reference));
  const int positions = static_cast<int>(pair.mesh_phase.size());
  const int cells = choice.cells > 0 ? choice.cells : positions * ((1023 + positions) / positions);
  if (choice.model == "pairs") return cells_of_pairs(pair, cells, numbers, choice.hertz ? kHertzChords : 0);
  return cells_of(choice.model == "secant" ? pair.stiffness_secant : pair.stiffness_tangent, cells,
                  pair.unloaded_error);
}

}  // namespace whine
