// What a motion was computed with: elastic gears, or a model with one degree of freedom.
#pragma once
#include <optional>
#include <ostream>
#include <string>

#include "base/choice.h"

namespace whine {

// Finite elements, or a lumped model (Eq. 23), called by the stiffness of its mesh.
enum class MotionModel { finite_elements, rectangular, secant, tangent, pairs, pairs_hertz };

// As artifacts, folders and messages have it: "finite elements", "pairs-hertz".
std::string name_of(MotionModel model);
std::optional<MotionModel> motion_model_of(const std::string& name);
std::ostream& operator<<(std::ostream& out, MotionModel model);

// When the damper of a lumped model acts: always as in Eq. 23, or while the teeth touch.
enum class DamperActs { always, contact };
template <>
inline constexpr const char* kWordsOf<DamperActs> = "always contact";

// With the damper: "secant-contact" where it acts in contact only.
std::string name_of(MotionModel model, DamperActs damper_acts);

template <class Result>
bool elastic(const Result& r) {
  return r.model == MotionModel::finite_elements;
}

}  // namespace whine
