// Sections that scenes of pairs and of systems share.
//
// Private to the layer io/.
#pragma once
#include <string>
#include <vector>

#include "io/section_reader.h"
#include "model/scene.h"

namespace whine {

// [gear.<name>] with all below it, and [material.<name>]. rigid: gears of a rigid system, which need no material and no blank.
void read_gears(const Source& source, Scene& scene, bool rigid);

// "; did you mean 'pinion'?" or what there is.
std::string advice_for(const std::string& word, const std::vector<std::string>& known);

// Whether a scene has several meshes, carriers or drives.
bool is_system(const Source& source);

}  // namespace whine
