#include "io/compatibility.h"

#include <filesystem>

#include "base/error.h"
#include "io/artifacts.h"
#include "io/keys.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "results/reduced_body.h"

namespace whine {
namespace {

const std::string kRecord = "/params/scene.txt";

}  // namespace

void require_mesh(const SectorGrid& mesh, const BodyParameters& settings, const std::string& path) {
  // Keys that either may lack are compared, too.
  const auto all_of = [&](GearDesign design, BodyDiscretisation body) {
    body.modes = settings.discretisation.modes;
    std::vector<Parameter> out;
    for (const KeyList& list : {keys(design).all(), keys(body).plain()})
      for (const Key& key : list)
        for (const Parameter& parameter : parameters_of(key)) out.push_back(parameter);
    return out;
  };
  const auto have = all_of(mesh.design, mesh.discretisation),
             want = all_of(settings.design, settings.discretisation);
  for (std::size_t i = 0; i < want.size(); ++i) {
    if (have[i].value == want[i].value) continue;
    const auto shown = [](const Parameter& parameter) {
      return std::visit([](const auto& value) { return text(value); }, parameter.value);
    };
    fail(Failure::input, path, ": is the mesh of another gear: its ", want[i].name, " is ", shown(have[i]),
         ", the stage parameters of the scene say ", shown(want[i]),
         want[i].units == "1" ? "" : " " + want[i].units, "; ", rebuild_advice(path));
  }
}

void require_body(const ReducedBody& body, const std::string& hash, const std::string& role,
                  const std::string& path) {
  const std::string found = body_hash(body_parameters({body.design, body.material, body.discretisation}));
  if (hash.empty() || found == hash) return;
  fail(Failure::input, path, ": is the body ", found, ", but the ", role, " of this scene is ", hash,
       ": it is of other gear values, or driver and driven are swapped; give out/bodies/", hash,
       "/body.h5 (make out/bodies/", hash, "/body.h5)");
}

std::vector<ReducedBody> read_bodies(const NamedFiles& files, const SystemStaticParameters& settings) {
  std::vector<ReducedBody> out;
  const std::vector<std::string> paths = files.of(settings.gears(), "system");
  out.reserve(paths.size());
  for (size_t g = 0; g < paths.size(); ++g) {
    out.push_back(read<ReducedBody>(paths[g]));
    require_body(out.back(), settings.body[g].second, settings.body[g].first, paths[g]);
  }
  return out;
}

void require_contact(const StaticResult& statics, const Fidelity& wanted, const std::string& path) {
  if (statics.fidelity.contact == wanted.contact) return;
  fail(Failure::input, path, ": was made with contact = \"", statics.fidelity.contact,
       "\", the parameters of this stage say \"", wanted.contact, "\"; ", rebuild_advice(path));
}

std::string recorded_scene(const std::string& home) {
  const std::string path = home + kRecord;
  if (!std::filesystem::is_regular_file(path)) return "";
  const std::string line = read_bytes(path);
  return line.substr(0, line.find('\n'));
}

void record_scene(const std::string& home, const std::string& scene) {
  namespace fs = std::filesystem;
  std::error_code gone;
  const std::string before = recorded_scene(home);
  if (!before.empty() && fs::is_regular_file(before, gone) && !fs::equivalent(before, scene, gone)) {
    if (read_bytes(before) != read_bytes(scene))
      fail(Failure::input, scene, ": ", home, " is of ", before,
           ", which says otherwise; rename one of the two, or delete ", home);
    return;  // a copy: the folder stays that of the first
  }
  const fs::path path = fs::absolute(scene).lexically_normal().lexically_relative(fs::current_path());
  publish_if_changed(home + kRecord, path.generic_string() + "\n");
}

}  // namespace whine
