// gear-inspect: what an artifact is, from what it was made, its key numbers, and whether its inputs changed.
//
// Reads      any artifacts (HDF5); their inputs at the paths recorded in /provenance, relative to the
//            working folder
// Writes     nothing; prints on standard output. Exit status 3 if an input has changed or is missing
// Equations  none
// Example    gear-inspect out/parker2000/T150/static.h5 out/parker2000/T150/up/response.h5
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "files/provenance.h"
#include "files/publish.h"
#include "files/summary.h"

namespace {

using namespace whine;

void line(const std::string& name, const std::string& words) {
  std::cout << "  " << name << std::string(name.size() < 22 ? 22 - name.size() : 1, ' ') << words << "\n";
}

// False if an input is not what it was, or not there to tell.
bool show_origin(const std::string& path, const Origin& origin) {
  line("made by", text(origin.tool, " ", origin.version, ": ", origin.command));
  bool fresh = true;
  for (const InputRecord& input : origin.inputs) {
    std::string state = "fresh";
    if (!std::filesystem::exists(input.path)) {
      state = text("MISSING; ", rebuild_advice(input.path));
      fresh = false;
    } else if (sha256_of_file(input.path) != input.sha256) {
      state = text("STALE; ", rebuild_advice(path));
      fresh = false;
    }
    line("input " + input.role, text(input.path, " (", input.sha256.substr(0, 12), ") ", state));
  }
  for (const std::string& stage : origin.history) line("earlier", stage);
  return fresh;
}

int body(int argc, char** argv) {
  std::vector<std::string> paths;
  CLI::App app{"Says what artifacts are, from what they were made, and whether they are stale",
               "gear-inspect"};
  app.add_option("artifact", paths, "artifacts (HDF5)")->required();
  parse(app, argc, argv);
  bool fresh = true;
  for (const std::string& path : paths) {
    const Origin origin = read_origin(path);
    std::cout << path << ": " << origin.title << "\n";
    line("schema", text(origin.schema, ", version ", origin.schema_version));
    for (const auto& [name, words] : summary(path, origin.schema)) line(name, words);
    fresh = show_origin(path, origin) && fresh;
  }
  return fresh ? 0 : static_cast<int>(Failure::input);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
