// A scene: every number that a user may change, read from TOML with checked keys and turned into SI.
//
// Each key is declared once, in keys.cpp, with name, unit, range, default and one line of documentation;
// the reader, the canonical slices that make compares, /parameters in the artifacts and `--help` all come
// from that declaration.
#pragma once
#include <string>

#include "model/stages.h"

namespace whine {

// Reads and checks a whole scene. Error(input) names file:line, key, value and limit, and for an unknown key
// or section the nearest known one; Error(io) if the file cannot be read.
Scene read_scene(const std::string& path);

// For gear-jump-map: a sweep whose speeds and Rayleigh stiffness factor the map chooses; both are 0.
SweepSlice read_map_slice(const std::string& path);

// For gear-lumped: a sweep of which nothing is read that only elastic bodies have; damping, body and integrator are defaults.
// speeds: false leaves those of the scene out, for a map of jumps, which chooses its own.
SweepSlice read_lumped_slice(const std::string& path, bool speeds);

// Canonical text of a slice: TOML in SI, keys in a fixed order, numbers with all digits. Depends on values
// only, not on comments, order or defaults left out. Errors: Error(input) for a gear that does not exist.
std::string body_slice(const Scene& scene, const std::string& gear);
std::string body_slice(const BodySlice& values);
std::string static_slice(const Scene& scene);
std::string impact_slice(const Scene& scene);
std::string sweep_slice(const Scene& scene);
std::string map_slice(const Scene& scene);
std::string lumped_slice(const Scene& scene, bool speeds);

// First 16 hexadecimal digits of the SHA-256 of a body slice: the folder out/bodies/<hash>/.
std::string body_hash(const std::string& slice);

// Read what the functions above wrote; errors as read_scene.
BodySlice read_body_slice(const std::string& path);
StaticSlice read_static_slice(const std::string& path);
ImpactSlice read_impact_slice(const std::string& path);
SweepSlice read_sweep_slice(const std::string& path);

// The table of keys as Markdown: section, key, range, default, meaning.
std::string scene_key_table();

}  // namespace whine
