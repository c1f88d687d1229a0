#include "io/pair_inputs.h"

#include <utility>

#include "base/error.h"
#include "gear/body_inertia.h"
#include "io/artifact_kinds.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/provenance.h"
#include "results/reduced_body.h"
#include "results/static.h"

namespace whine {
namespace {

// Gears that are alike share a file, which is read once.
PairBodies read_both(const std::vector<std::string>& paths) {
  PairBodies body{read<ReducedBody>(paths[0]), {}};
  body[1] = paths[1] == paths[0] ? body[0] : read<ReducedBody>(paths[1]);
  return body;
}

template <class Motion>
Motion read_of_pair(const std::string& path) {
  Motion out = read<Motion>(path);
  if (out.of_train())
    fail(Failure::input, path, ": is of a train, ", out.meshes(), " meshes; give the ",
         kind_of<Motion>().file, " of a pair of gears");
  return out;
}

}  // namespace

PairBodies read_bodies(const NamedFiles& files, const StaticParameters& settings) {
  const std::vector<std::string> paths = files.of(settings.mesh);
  PairBodies body = read_both(paths);
  for (size_t g = 0; g < kSides; ++g)
    require_body(body[g], settings.body[g], settings.mesh.gear[g], paths[g]);
  return body;
}

PairInputs read_pair_inputs(const NamedFiles& files, const std::string& statics, const std::string& reference,
                            ImpactParameters& settings) {
  PairInputs inputs;
  inputs.at_torque = read_pair_statics(statics);
  inputs.at_reference = read_pair_statics(reference);
  const GearMeshSpec& mesh = inputs.at_torque.mesh;
  const std::vector<std::string> paths = files.of(mesh);
  for (size_t g = 0; g < kSides; ++g)
    for (const std::string& file : {statics, reference})
      require_made_from(file, files.role(mesh.gear[g]), paths[g]);
  require_contact(inputs.at_torque, settings.fidelity, statics);
  require_contact(inputs.at_reference, settings.fidelity, reference);
  if (inputs.at_reference.torque != settings.reference_torque)
    fail(Failure::input, reference, " is at ", inputs.at_reference.torque,
         " N m, but the scene's first torque, which sets the bearing dampers, is ", settings.reference_torque,
         " N m; give the static.h5 of that torque");
  inputs.body = read_both(paths);
  as_drawn(settings, {inputs.body[0].inertia, inputs.body[1].inertia});
  return inputs;
}

StaticResult read_pair_statics(const std::string& path) {
  SystemStaticResult out = read<SystemStaticResult>(path);
  if (out.of_train())
    fail(Failure::input, path, ": is of a train, ", out.mesh.size(),
         " meshes; give the static.h5 of a pair of gears");
  return std::move(out.mesh[0]);
}

ResponseResult read_pair_response(const std::string& path) {
  return read_of_pair<ResponseResult>(path);
}

SweepResult read_pair_sweep(const std::string& path) {
  return read_of_pair<SweepResult>(path);
}

ImpactResult read_pair_impact(const std::string& path) {
  return read_of_pair<ImpactResult>(path);
}

BranchResult read_pair_branch(const std::string& path) {
  return read_of_pair<BranchResult>(path);
}

}  // namespace whine
