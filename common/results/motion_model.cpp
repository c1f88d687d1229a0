#include "results/motion_model.h"

#include <array>

namespace whine {
namespace {

constexpr std::array<const char*, 6> kMotionModels{"finite elements", "rectangular", "secant",
                                                   "tangent",         "pairs",       "pairs-hertz"};

}  // namespace

std::string name_of(MotionModel model) {
  return kMotionModels.at(static_cast<std::size_t>(model));
}

std::optional<MotionModel> motion_model_of(const std::string& name) {
  for (std::size_t i = 0; i < kMotionModels.size(); ++i)
    if (name == kMotionModels[i]) return static_cast<MotionModel>(i);
  return std::nullopt;
}

std::ostream& operator<<(std::ostream& out, MotionModel model) {
  return out << name_of(model);
}

std::string name_of(MotionModel model, DamperActs damper_acts) {
  return name_of(model) + (damper_acts == DamperActs::contact ? "-contact" : "");
}

}  // namespace whine
