// Parts of the reader of scenes.
//
// Private to the layer io/.
#pragma once
#include <string>
#include <vector>

#include "gear/accuracy.h"
#include "io/section_reader.h"
#include "model/scene.h"

namespace whine {

// [gear.<name>] with all below it, and [material.<name>]. rigid: gears of a rigid train, which need no material and no blank.
void read_gears(const Source& source, Scene& scene, bool rigid);

// Whether the scene gives a key of [fidelity] or [discretisation].
KeyGiven keys_given(const Source& source);

// "; did you mean 'pinion'?" or what there is.
std::string advice_for(const std::string& word, const std::vector<std::string>& known);

}  // namespace whine
