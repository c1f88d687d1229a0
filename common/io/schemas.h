// The artifacts that stages hand to each other: one struct and one read/write pair each.
//
// All values SI. Shapes are given with the axes in index order. Writers refuse values that are not finite,
// add units, long_name and axes to every dataset, /parameters and /provenance, and publish the file whole:
// temporary name in the same folder, fsync, rename. Readers check the content hash before HDF5 sees the file, then
// schema, version, shapes and finiteness, and throw Error(input) or Error(io) with the make target that rebuilds it.
#pragma once
#include <string>
#include <vector>

#include "motion/branch_result.h"
#include "motion/error_budget_result.h"
#include "motion/harris_result.h"
#include "motion/impact_result.h"
#include "motion/loaded_result.h"
#include "signal/jump_map_result.h"
#include "signal/response_result.h"
#include "signal/static_result.h"
#include "signal/sweep_result.h"
#include "solid/reduced_body.h"
#include "solid/sector_mesh.h"

namespace whine {

// Where an artifact comes from; filled by the tool, completed by the writer.
struct Provenance {
  std::string tool;     // program name
  std::string command;  // as typed, paths relative to the working folder
  // "role=path"; each is hashed (SHA-256 of the file) and its history copied
  std::vector<std::string> inputs;
  // of the inputs before they were read; a writer refuses to publish what was made while one of them changed.
  // Empty: not known
  std::vector<std::string> sha256 = {};
};

void write(const std::string& path, const MeshArtifact&, const Provenance&);
void write(const std::string& path, const BodyArtifact&, const Provenance&);
void write(const std::string& path, const StaticArtifact&, const Provenance&);
void write(const std::string& path, const ErrorBudgetArtifact&, const Provenance&);
void write(const std::string& path, const LoadedArtifact&, const Provenance&);
void write(const std::string& path, const ImpactArtifact&, const Provenance&);
void write(const std::string& path, const SweepArtifact&, const Provenance&);
void write(const std::string& path, const ResponseArtifact&, const Provenance&);
void write(const std::string& path, const BranchArtifact&, const Provenance&);
void write(const std::string& path, const JumpMapArtifact&, const Provenance&);
void write(const std::string& path, const HarrisMapArtifact&, const Provenance&);
MeshArtifact read_mesh(const std::string& path);
BodyArtifact read_body(const std::string& path);
StaticArtifact read_static(const std::string& path);
ErrorBudgetArtifact read_error_budget(const std::string& path);
LoadedArtifact read_loaded(const std::string& path);
ImpactArtifact read_impact(const std::string& path);
SweepArtifact read_sweep(const std::string& path);
ResponseArtifact read_response(const std::string& path);
BranchArtifact read_branch(const std::string& path);
JumpMapArtifact read_jump_map(const std::string& path);
HarrisMapArtifact read_harris_map(const std::string& path);

// A key of a scene with its value as a scene would have it, in the unit of its name. Keys of gears and materials have a value
// for driver and driven gear each, others one.
struct SceneKey {
  std::string section, name, driver, driven, meaning;
};

// What an artifact was made from, but for torques and speeds; of a static.h5 without what concerns motion. Sections that
// neither gear has (modification, error, crack) are left out.
std::vector<SceneKey> scene_keys_of(const StaticArtifact& artifact);
std::vector<SceneKey> scene_keys_of(const ResponseArtifact& artifact);

// What two maps were made from that differs, in a scene's keys and units: "bore_radius_mm 40 -> 35"; "" if nothing
// does. Gears by the driver's, if both gears changed alike.
std::string changed_keys(const JumpMapArtifact& from, const JumpMapArtifact& to);

}  // namespace whine
