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
#include <iostream>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifact_place.h"
#include "io/compatibility.h"
#include "io/datasets.h"
#include "io/freshness.h"
#include "io/provenance.h"
#include "io/summary.h"

namespace {

using namespace whine;

void line(const std::string& name, const std::string& words) {
  std::cout << "  " << name << std::string(name.size() < 22 ? 22 - name.size() : 1, ' ') << printable(words)
            << "\n";
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

// The number of faults, each told in a line.
int check(const std::string& path, const std::string& scene) {
  int faults = 0;
  const auto tell_fault = [&](const std::string& words) {
    log_line("gear-inspect: ", words);
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
  options.add(
      "--scene", scene,
      "compare stage parameters with this scene; default: the one that out/<scene>/ was made of, if it is there");
  bool datasets = false;
  options.flag("--datasets", datasets,
               "print the datasets of all artifacts, a line each: axes, unit, meaning");
  options.footer(
      "Example:\n"
      "  gear-inspect out/parker2000/T150/static.h5 out/parker2000/T150/up/response.h5");
  options.parse(argc, argv);
  if (datasets) {
    std::cout << dataset_list();
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
