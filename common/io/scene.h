// A scene: every number that a user may change, read from TOML with checked keys and turned into SI.
//
// Each key is declared once, in keys.cpp, with name, unit, range, default and one line of documentation;
// the reader, the canonical stage parameters that make compares, /parameters in the artifacts and `--help` all come
// from that declaration.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "model/system_stages.h"

namespace whine {

// Whether a scene is one of a train (several meshes, carriers or drives); false if it cannot be read or is no TOML.
bool is_system_scene(const std::string& path);

// Reads and checks a whole scene. Error(input) names file:line, key, value and limit, and for an unknown key
// or section the nearest known one; Error(io) if the file cannot be read.
Scene read_scene(const std::string& path);
// Error(input) for the scene of a train.
Scene read_pair_scene(const std::string& path);

// Of a train layout_of(scene), with file:line of the section that is wrong; of a pair no bodies.
System layout_in(const Scene& scene, const std::string& path);

// check_at_rest(scene, layout), likewise.
void check_at_rest_in(const Scene& scene, const System& layout, const std::string& path);

// What to know of an elastic train in motion before it is computed: contact on lines whatever [fidelity] says, and a damping that
// nobody chose. Empty of scenes without [operation].
std::vector<std::string> motion_remarks(const Scene& scene);

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

// Gears and the stage parameters of their bodies, in the order of the scene; none of rigid ones.
using BodySettings = std::vector<std::pair<std::string, std::string>>;
BodySettings body_parameters_of(const Scene& scene);

// Names ("static.toml") and texts of all stage parameters of a scene: of rigid gears of the modes, else of the statics and of the
// motions. layout: of a train.
std::vector<std::pair<std::string, std::string>> stage_parameters_of(const Scene& scene,
                                                                     const System& layout);

// The stage parameters that the scene of a file gives now for the path of earlier ones, .../params/<stage>.toml or .../<gear or
// hash>/body.toml; empty if none of it stand there.
std::string parameters_for(const std::string& scene, const std::string& path);

// First 16 hexadecimal digits of the SHA-256 of the stage parameters of a body: the folder out/bodies/<hash>/.
std::string body_hash(const std::string& settings);

// Read what the functions above wrote; errors as read_scene.
BodyParameters read_body_parameters(const std::string& path);
StaticParameters read_static_parameters(const std::string& path);
SweepParameters read_impact_parameters(const std::string& path);
SweepParameters read_sweep_parameters(const std::string& path);

// Canonical text of the stage parameters of the modes of a train, and back: bodies, meshes and drives as they stand, in SI.
std::string system_parameters(const System& layout);
System read_system_parameters(const std::string& path);

// Of elastic trains: what their statics depend on, as text and back.
SystemStaticParameters static_parameters_of(const Scene& scene, const System& layout);
std::string system_static_parameters(const SystemStaticParameters& parameters);
SystemStaticParameters read_system_static_parameters(const std::string& path);
// Of elastic trains in motion: the same with damping, speeds and time steps. Only of scenes with [operation].
SystemSweepParameters sweep_parameters_of(const Scene& scene, const System& layout);
std::string system_sweep_parameters(const SystemSweepParameters& parameters);
SystemSweepParameters read_system_sweep_parameters(const std::string& path);
// Of its ring-down: the same without speeds, which are 0 when read.
std::string system_impact_parameters(const SystemSweepParameters& parameters);
SystemSweepParameters read_system_impact_parameters(const std::string& path);

// Of a variant of a study: those of its statics and, with directions, of its sweeps.
std::string system_variant_parameters(const Scene& scene, const System& layout,
                                      const std::vector<Direction>& directions);
VariantParameters read_system_variant_parameters(const std::string& path);

// The table of keys as Markdown: section, key, range, default, meaning.
std::string scene_key_table();

}  // namespace whine
