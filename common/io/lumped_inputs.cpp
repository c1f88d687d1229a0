#include "io/lumped_inputs.h"

#include "base/error.h"
#include "gear/body_inertia.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "model/capabilities.h"
#include "results/static.h"

namespace whine {
namespace {

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
  inputs.at_torque = read_pair_statics(statics);
  const StaticResult& at_torque = inputs.at_torque;
  require_able("lumped", traits(at_torque.mesh, at_torque.gear[0].design, at_torque.gear[1].design));
  inputs.at_reference = reference.empty() ? at_torque : read_pair_statics(reference);
  if (params.empty()) {
    if (!reference.empty()) require_same_pair(statics, reference);
    return inputs;
  }
  SweepParameters settings = read_lumped_parameters(params, with_speeds);
  as_outlined(settings, at_torque);
  require_contact(at_torque, settings.fidelity, statics);
  options.time = settings.time;
  options.mass = reduced_mass(at_torque, settings.inertia);
  static_cast<MeshSpeeds&>(options) = settings;
  if (!reference.empty() && inputs.at_reference.torque != settings.reference_torque)
    fail(Failure::input, reference, " is at ", inputs.at_reference.torque,
         " N m, but the scene's first torque is ", settings.reference_torque,
         " N m; give the static.h5 of that torque");
  if (!reference.empty()) require_same_pair(statics, reference);
  return inputs;
}

}  // namespace whine
