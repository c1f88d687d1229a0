// Whether a scene's gears can exist and run together, checked before minutes of work.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "model/scene.h"

namespace whine {

// Where a scene says what a message is about: "pair.toml:14" from the sections ("gear.pinion", "mesh") in which the key may
// stand and the words of the message, which name it.
using ScenePlace =
    std::function<std::string(const std::vector<std::string>& sections, const std::string& words)>;

// Throws what ToothGeometry, crack_slit, FlankDeviation and GearPair throw, with the section of the scene before it and `where`
// before that. Of a train the gears alone; its meshes are checked where it is laid out.
void check_geometry(const Scene& scene, const ScenePlace& where);

// Error(input), in the same words, for a gear whose total inertia lies below least_body_inertia; of gears that check_geometry
// has passed. Statics do not depend on it.
void check_inertia(const Scene& scene, const ScenePlace& where);

// What a scene may mean but hardly does, each with its place before it: more backlash than 0.2 modules, gears in no mesh, thin rims, inertias of flywheels, undercut and what it takes
// of the path of contact. Nothing is computed for it.
std::vector<std::string> scene_warnings(const Scene& scene, const ScenePlace& where);

// What to know of a scene that is as it should be: gears of unequal face widths, elements long beside the module.
std::vector<std::string> scene_remarks(const Scene& scene);

// Less than a module between the bore and the root circle of [gear.<name>], in words; "" if there is more.
std::string thin_rim(const GearDesign& design, const std::string& name);

// A total inertia (kg m2) above 100 times that of the gear as drawn, which no shaft or coupling adds, in words; "" below.
std::string flywheel(const GearDesign& design, const Material& material, double inertia,
                     const std::string& name);

}  // namespace whine
