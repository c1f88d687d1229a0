// Sections that scenes of pairs and of systems share.
//
// Private to the layer io/.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gear/accuracy.h"
#include "io/section_reader.h"
#include "model/scene.h"

namespace whine {

// [gear.<name>] with all below it, and [material.<name>]. rigid: gears of a rigid system, which need no material and no blank.
void read_gears(const Source& source, Scene& scene, bool rigid);

// [[bearing]] of these hubs, by their names; `unknown` names what others are not; check: what else one of them must be.
void read_bearings(
    const Source& source, const std::vector<std::pair<std::string, Bearing*>>& of, const std::string& unknown,
    const std::function<void(const SectionReader&, const Bearing&, size_t)>& check = [](auto&&...) {});

// [fidelity], [discretisation], [damping], [operation], [accuracy], each of which may be left out; check: before what it says is read.
void read_levels(
    const Source& source, const KeyList& keys,
    const std::function<void(const SectionReader&)>& check = [](auto&&...) {});

// Whether the scene gives a key of [fidelity] or [discretisation].
KeyGiven keys_given(const Source& source);

// What [accuracy] asks for, see gear/accuracy.h; its errors at the key.
template <class AnyScene>
void take_accuracy(const Source& source, AnyScene& scene) {
  const toml::node* asked = source.root().at_path("accuracy.rms_percent").node();
  if (!asked) return choose_by_default(scene, keys_given(source));
  try {
    choose_discretisation(scene, keys_given(source));
  } catch (const Error& error) {
    source.reject_value("rms_percent", *asked, error.what());
  }
}

// [friction], which may be left out.
void read_friction(const Source& source, Friction& friction);

// "; did you mean 'pinion'?" or what there is.
std::string advice_for(const std::string& word, const std::vector<std::string>& known);

// Whether a scene has several meshes, carriers or drives.
bool is_system(const Source& source);

}  // namespace whine
