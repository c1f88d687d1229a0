#include "io/pair_inputs.h"

#include <utility>

#include "base/error.h"
#include "dynamics/lines_motion.h"
#include "gear/body_inertia.h"
#include "io/artifact_kinds.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "results/reduced_body.h"
#include "results/static.h"
#include "system/load_balance.h"

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

namespace {

size_t mesh_called(const std::string& name, const System& layout) {
  std::string known;
  for (size_t m = 0; m < layout.meshes.size(); ++m) {
    const std::string own = mesh_name(layout, m);
    if (own == name) return m;
    known += (known.empty() ? "" : ", ") + own;
  }
  fail(Failure::usage, "--mesh ",
       name.empty() ? "is needed of a train" : name + ": the train has no such mesh", "; there are ", known);
}

}  // namespace

MeshInputs read_mesh_inputs(const std::string& params, const std::string& name, const NamedFiles& files) {
  if (!is_system_scene(params)) {
    if (!name.empty()) fail(Failure::usage, "--mesh ", name, ": ", params, " is of a pair");
    const StaticParameters settings = read_static_parameters(params);
    return {settings, read_bodies(files, settings)};
  }
  const SystemStaticParameters train = read_system_static_parameters(params);
  const size_t m = mesh_called(name, train.layout);
  const System::Mesh& mesh = train.layout.meshes[m];
  MeshInputs out{{train.mesh[static_cast<size_t>(train.section[m])], train.fidelity, train.contact}, {}};
  const std::vector<ReducedBody> bodies = read_bodies(files, train);
  require_able("harris-map", traits(train, bodies));
  for (size_t g = 0; g < kSides; ++g)
    for (size_t b = 0; b < train.body.size(); ++b)
      if (train.body[b].first == out.settings.mesh.gear[g]) {
        out.settings.body[g] = train.body[b].second;
        out.body[g] = bodies[b];
      }
  out.settings.mesh.centre_distance = mesh.centre_distance;
  out.torque = load_balance(train.layout).load[static_cast<Eigen::Index>(m)] *
               train.layout.bodies[static_cast<size_t>(mesh.side[0].body)].radius;
  return out;
}

PairInputs read_pair_inputs(const NamedFiles& files, const std::string& statics, const std::string& reference,
                            SweepParameters& settings) {
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
