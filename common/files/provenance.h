// Where an artifact comes from: who made it with which command from which inputs, and whether those still are
// what they were.
#pragma once
#include <string>
#include <vector>

namespace whine {

struct InputRecord {
  std::string role, path, sha256;  // path relative to the working folder of the run
};

struct Origin {
  std::string schema;  // "whine/static"
  int schema_version = 0;
  std::string title, tool, version, command;
  std::vector<InputRecord> inputs;
  std::vector<std::string> history;  // one line per earlier stage: "tool version: command"
};

// Reads root attributes and /provenance of any artifact, whatever its schema or version.
// Error(io): no such file, no HDF5, truncated; Error(input): not an artifact of this program.
Origin read_origin(const std::string& path);

// SHA-256 under which `artifact` recorded its input `role`. Error(input) if it has no such input.
std::string recorded_input(const std::string& artifact, const std::string& role);

// Error(input), with the make target, unless `artifact` was made from this very content of `input` in this
// role: keeps a sweep from mixing a static result with a body that it was not computed from.
void require_made_from(const std::string& artifact, const std::string& role, const std::string& input);

// "rebuild it with: make <path>"; for a path outside the working folder, or not below out/, that there is no such target.
std::string rebuild_advice(const std::string& path);

}  // namespace whine
