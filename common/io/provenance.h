// Where an artifact comes from: who made it with which command from which inputs, and whether those still are
// what they were.
#pragma once
#include <string>
#include <vector>

namespace whine {

// Where an artifact comes from; filled by the tool, completed by the writer.
struct Provenance {
  std::string tool;     // program name
  std::string command;  // as typed, paths relative to the working folder
  // "role=path"; each is hashed (SHA-256 of the file) and its history copied
  std::vector<std::string> inputs;
  // of the inputs before they were read; a writer does not publish what was made while one of them changed.
  // Empty: not known
  std::vector<std::string> sha256 = {};
};

struct InputRecord {
  std::string role, path, sha256;  // path relative to the working folder of the run
};

struct Origin {
  std::string schema;  // "whine/static"
  int schema_version = 0;
  std::string title, tool, version, command;
  std::vector<InputRecord> inputs;
  std::vector<std::string> history;  // one line per earlier stage: "tool version: command"
  // Where there is one: of sweeps and what is made from them direction and lumped model ("": the elastic pair) as well.
  bool has_torque = false;
  double torque = 0;  // N m
  std::string direction, model;
};

// Reads root attributes and /provenance of any artifact, whatever its schema or version.
// Error(io): no such file, no HDF5, truncated; Error(input): not an artifact of this program.
Origin read_origin(const std::string& path);

// SHA-256 under which `artifact` recorded its input `role`. Error(input) if it has no such input.
std::string recorded_input(const std::string& artifact, const std::string& role);

// Error(input), with the make target, unless `artifact` was made from this very content of `input` in this
// role: keeps a sweep from mixing a static result with a body that it was not computed from.
void require_made_from(const std::string& artifact, const std::string& role, const std::string& input);

// Of a tool, before it reads its inputs ("role=path"): their hashes are taken here, and each that is an artifact is
// rejected by require_fresh, so that nothing is computed from files that do not belong together.
Provenance made_by(int argc, char** argv, std::vector<std::string> inputs);

// Error(input), with the make target, if a file from which `artifact` was made lies where it was recorded (relative
// to the working folder) with another content, or if the artifact lies where another belongs (io/artifact_place.h). A
// file that is not there any more leaves the artifact what it is.
void require_fresh(const std::string& artifact);

// "rebuild it with: make <path>", after "delete it" where something stands there, which make would take for made; for a path
// outside the working folder, or not below out/, that there is no such target.
std::string rebuild_advice(const std::string& path);

}  // namespace whine
