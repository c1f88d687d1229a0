// Scenes of systems (several meshes, carriers, drives), and the stage parameters that are cut from them.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "model/system_stages.h"

namespace whine {

// Whether a scene is one of a system; false if it cannot be read or is no TOML.
bool is_system_scene(const std::string& path);

// Errors as read_scene.
SystemScene read_system_scene(const std::string& path);
// As read_variant_of() of pairs.
SystemScene read_system_variant_of(const std::string& path, const std::string& variant);

// layout_of(scene), with file:line of the section that is wrong.
System layout_in(const SystemScene& scene, const std::string& path);

// check_at_rest(scene, layout), likewise.
void check_at_rest_in(const SystemScene& scene, const System& layout, const std::string& path);

// What to know of an elastic system in motion before it is computed: contact on lines whatever [fidelity] says, and a damping that
// nobody chose. Empty of scenes without [operation].
std::vector<std::string> motion_remarks(const SystemScene& scene);

// Canonical text of the stage parameters of the modes of a system, and back: bodies, meshes and drives as they stand, in SI.
std::string system_parameters(const System& layout);
System read_system_parameters(const std::string& path);

// Gears and the stage parameters of their bodies, in the order of the scene; none of rigid ones.
using BodySettings = std::vector<std::pair<std::string, std::string>>;
BodySettings body_parameters_of(const SystemScene& scene);

// Of elastic systems: what their statics depend on, as text and back.
SystemStaticParameters static_parameters_of(const SystemScene& scene, const System& layout);
std::string system_static_parameters(const SystemStaticParameters& parameters);
SystemStaticParameters read_system_static_parameters(const std::string& path);
// Of elastic systems in motion: the same with damping, speeds and time steps. Only of scenes with [operation].
SystemSweepParameters sweep_parameters_of(const SystemScene& scene, const System& layout);
std::string system_sweep_parameters(const SystemSweepParameters& parameters);
SystemSweepParameters read_system_sweep_parameters(const std::string& path);
// Of its ring-down: the same without speeds, which are 0 when read.
std::string system_impact_parameters(const SystemSweepParameters& parameters);
SystemSweepParameters read_system_impact_parameters(const std::string& path);

// Of a variant of a study: those of its statics and, with directions, of its sweeps.
std::string system_variant_parameters(const SystemScene& scene, const System& layout,
                                      const std::vector<Direction>& directions);
VariantParameters read_system_variant_parameters(const std::string& path);

// Names and texts of all stage parameters: of rigid gears of the modes, else of the statics and, with [operation], of the motions.
std::vector<std::pair<std::string, std::string>> stage_parameters_of(const SystemScene& scene,
                                                                     const System& layout);

// The stage parameters that the scene gives now for the path of earlier ones; empty if none of it stand there.
std::string system_parameters_for(const std::string& scene, const std::string& path);

}  // namespace whine
