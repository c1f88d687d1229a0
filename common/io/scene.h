// A scene: every number that a user may change, read from TOML with checked keys and turned into SI.
//
// Each key is declared once, in keys.cpp, with name, unit, range, default and one line of documentation;
// the reader, the canonical stage parameters that make compares, /parameters in the artifacts and `--help` all come
// from that declaration.
#pragma once
#include <string>

#include "model/stages.h"

namespace whine {

// Reads and checks a whole scene. Error(input) names file:line, key, value and limit, and for an unknown key
// or section the nearest known one; Error(io) if the file cannot be read.
Scene read_scene(const std::string& path);

// For gear-jump-map: a sweep whose speeds and Rayleigh stiffness factor the map chooses; both are 0.
SweepParameters read_map_parameters(const std::string& path);

// For gear-lumped: a sweep of which nothing is read that only elastic bodies have; damping, body and integrator are defaults.
// speeds: false leaves those of the scene out, for a map of jumps, which chooses its own.
SweepParameters read_lumped_parameters(const std::string& path, bool speeds);

// Canonical text of stage parameters: TOML in SI, keys in a fixed order, numbers with all digits. Depends on values
// only, not on comments, order or defaults left out. Errors: Error(input) for a gear that does not exist.
std::string body_parameters(const Scene& scene, const std::string& gear);
std::string body_parameters(const BodyParameters& values);
std::string static_parameters(const Scene& scene);
std::string impact_parameters(const Scene& scene);
std::string sweep_parameters(const Scene& scene);
std::string map_parameters(const Scene& scene);
std::string lumped_parameters(const Scene& scene, bool speeds);

// First 16 hexadecimal digits of the SHA-256 of the stage parameters of a body: the folder out/bodies/<hash>/.
std::string body_hash(const std::string& settings);

// Read what the functions above wrote; errors as read_scene.
BodyParameters read_body_parameters(const std::string& path);
StaticParameters read_static_parameters(const std::string& path);
ImpactParameters read_impact_parameters(const std::string& path);
SweepParameters read_sweep_parameters(const std::string& path);

// The table of keys as Markdown: section, key, range, default, meaning.
std::string scene_key_table();

}  // namespace whine
