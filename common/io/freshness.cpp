#include "io/freshness.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/tool.h"
#include "io/compatibility.h"
#include "io/publish.h"
#include "io/scene.h"

namespace whine {
namespace {

// The scene that the stage parameters out/<scene>/params/... were written from; empty if it is not known, or not there any
// more.
std::string scene_of_settings(const std::string& settings) {
  const std::filesystem::path folder = std::filesystem::path(settings).parent_path();
  if (folder.filename() != "params") return "";
  const std::filesystem::path home = folder.parent_path();
  for (const std::string& scene :
       {recorded_scene(home.generic_string()), "data/scenes/" + home.filename().string() + ".toml"})
    if (std::filesystem::is_regular_file(scene)) return scene;
  return "";
}

// Whether stage parameters, whose file is what it was, are what its scene says today, in words; clears fresh if not.
std::string against_scene(const std::string& artifact, const InputRecord& input, std::string scene,
                          bool& fresh) {
  if (scene.empty()) scene = scene_of_settings(input.path);
  const std::string now = scene.empty() ? "" : parameters_for(scene, input.path);
  if (now.empty())
    return text("fresh: the stage parameters are what they were; not compared with a scene",
                scene.empty() ? ", give --scene" : "");
  if (sha256(now) == input.sha256) return text("fresh: as the stage parameters and as ", scene);
  fresh = false;
  return text("STALE: ", scene, " says otherwise now; ", rebuild_advice(artifact));
}

}  // namespace

std::string state_of(const std::string& path, const InputRecord& input, const std::string& scene,
                     bool& fresh) {
  if (std::filesystem::exists(input.path) && sha256_of_file(input.path) == input.sha256)
    return input.role == "params" ? against_scene(path, input, scene, fresh)
                                  : "fresh: the file is what it was";
  fresh = false;
  return std::filesystem::exists(input.path) ? text("STALE; ", rebuild_advice(path))
                                             : text("MISSING; ", rebuild_advice(input.path));
}

std::vector<std::string> artifacts_below(const std::string& place) {
  namespace fs = std::filesystem;
  std::error_code code;
  if (!fs::is_directory(place, code)) return {place};
  std::vector<std::string> out;
  fs::recursive_directory_iterator entry(place, code);
  for (; !code && entry != fs::recursive_directory_iterator(); entry.increment(code))
    if (entry->path().extension() == ".h5") out.push_back(entry->path().generic_string());
  if (code) fail(Failure::io, place, ": cannot be searched: ", code.message(), "; check its permissions");
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace whine
