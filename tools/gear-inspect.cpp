// gear-inspect: what an artifact is, from what it was made, its key numbers, and whether its inputs changed.
//
// Reads      any artifacts (HDF5); their inputs at the paths recorded in /provenance, relative to the
//            working folder; the scene (--scene, or the one that out/<scene>/params/scene.txt names)
//            With --check: every artifact (.h5) below the folders given, out/ if none is
//            With --datasets: nothing
// Writes     nothing; prints on standard output. Exit status 3 if an input has changed or is missing
//            With --check: a line on standard error for each fault, nothing if all is well. Exit status 3 if an
//            artifact is damaged, of another version, not finite, or made from other files than those beside it
// Equations  none
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifact_place.h"
#include "io/datasets.h"
#include "io/fit.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/summary.h"

namespace {

using namespace whine;

void line(const std::string& name, const std::string& words) {
  std::cout << "  " << name << std::string(name.size() < 22 ? 22 - name.size() : 1, ' ') << printable(words)
            << "\n";
}

// The scene that a slice out/<scene>/params/... was cut from; empty if it is not known, or not there any more.
std::string scene_of(const std::string& slice) {
  const std::filesystem::path folder = std::filesystem::path(slice).parent_path();
  if (folder.filename() != "params") return "";
  const std::filesystem::path home = folder.parent_path();
  for (const std::string& scene :
       {recorded_scene(home.generic_string()), "data/scenes/" + home.filename().string() + ".toml"})
    if (std::filesystem::is_regular_file(scene)) return scene;
  return "";
}

// Whether a slice, which is the file it was, is what its scene says today, in words; clears fresh if not.
std::string against_scene(const std::string& artifact, const InputRecord& input, std::string scene,
                          bool& fresh) {
  if (scene.empty()) scene = scene_of(input.path);
  const std::string now = scene.empty() ? "" : slice_for(read_scene(scene), input.path);
  if (now.empty())
    return text("fresh: the slice is what it was; not compared with a scene",
                scene.empty() ? ", give --scene" : "");
  if (sha256(now) == input.sha256) return text("fresh: as the slice and as ", scene);
  fresh = false;
  return text("STALE: ", scene, " says otherwise now; ", rebuild_advice(artifact));
}

// What has become of an input since, in words; clears fresh if it is not what it was, or not there to tell.
std::string state_of(const std::string& path, const InputRecord& input, const std::string& scene,
                     bool& fresh) {
  if (std::filesystem::exists(input.path) && sha256_of_file(input.path) == input.sha256)
    return input.role == "params" ? against_scene(path, input, scene, fresh)
                                  : "fresh: the file is what it was";
  fresh = false;
  return std::filesystem::exists(input.path) ? text("STALE; ", rebuild_advice(path))
                                             : text("MISSING; ", rebuild_advice(input.path));
}

// False if an input is not what it was, or not there to tell.
bool show_origin(const std::string& path, const Origin& origin, const std::string& scene) {
  line("made by", text(origin.tool, " ", origin.version, ": ", origin.command));
  const std::string wrong = misplaced(path, origin);
  if (!wrong.empty()) line("place", text("WRONG: ", wrong, "; ", rebuild_advice(path)));
  bool fresh = wrong.empty();
  for (const InputRecord& input : origin.inputs) {
    const std::string state = state_of(path, input, scene, fresh);
    line("input " + input.role, text(input.path, " (", input.sha256.substr(0, 12), ") ", state));
  }
  for (const std::string& stage : origin.history) line("earlier", stage);
  return fresh;
}

// All artifacts below a folder, links not followed, in the order of the alphabet; a path to a file is that file.
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

// The number of faults, each told in a line.
int check(const std::string& path, const std::string& scene) {
  int faults = 0;
  const auto tell_fault = [&](const std::string& words) {
    tell("gear-inspect: ", words);
    ++faults;
  };
  try {
    const Origin origin = read_origin(path);
    summary(path, origin.schema);
    if (const std::string wrong = misplaced(path, origin); !wrong.empty())
      tell_fault(text(path, ": ", wrong, "; ", rebuild_advice(path)));
    for (const InputRecord& input : origin.inputs) {
      bool fresh = true;
      const std::string state = state_of(path, input, scene, fresh);
      if (!fresh) tell_fault(text(path, ": input ", input.role, ", ", input.path, ": ", state));
    }
  } catch (const Error& error) {
    tell_fault(error.what());
  }
  return faults;
}

int body(int argc, char** argv) {
  std::vector<std::string> paths;
  whine::Options options{"Says what artifacts are, from what they were made, and whether they are stale",
                         "gear-inspect"};
  options.add("artifact", paths, "artifacts (HDF5); with --check folders as well");
  bool checked = false;
  options.flag("--check", checked,
               "say only what is wrong with the artifacts, those below folders included (default: out)");
  std::string scene;
  options.add("--scene", scene,
              "compare stage parameters with this scene; default: the one that out/<scene>/ was made of, if "
              "it is there");
  bool datasets = false;
  options.flag("--datasets", datasets, "print the table of the datasets of all artifacts (Markdown)");
  options.footer(
      "Example:\n"
      "  gear-inspect out/parker2000/T150/static.h5 out/parker2000/T150/up/response.h5");
  options.parse(argc, argv);
  if (datasets) {
    std::cout << dataset_table();
    return 0;
  }
  if (checked) {
    if (paths.empty()) paths = {"out"};
    int faults = 0;
    for (const std::string& place : paths)
      for (const std::string& path : artifacts_below(place)) faults += check(path, scene);
    return faults == 0 ? 0 : static_cast<int>(Failure::input);
  }
  if (paths.empty()) fail(Failure::usage, "give artifacts to inspect, or --check for all below out");
  bool fresh = true;
  std::cout << kSummaryUnits << "\n";
  for (const std::string& path : paths) {
    const Origin origin = read_origin(path);
    std::cout << printable(path + ": " + origin.title) << "\n";
    line("schema", text(origin.schema, ", version ", origin.schema_version));
    for (const auto& [name, words] : summary(path, origin.schema)) line(name, words);
    fresh = show_origin(path, origin, scene) && fresh;
  }
  return fresh ? 0 : static_cast<int>(Failure::input);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
