// What each stage depends on of a scene, and what results say of it.
#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "model/scene.h"

namespace whine {

// How the speed of a sweep goes.
enum class Direction { up, down };
template <>
inline constexpr const char* kWordsOf<Direction> = "up down";

// The parts of a scene that a stage depends on, and nothing else, so that `make` redoes a stage only if one of
// its own numbers changed. SI units throughout.

// For gear-mesh and gear-reduce: the gear without name, inertia, torque or motion.
struct BodyParameters {
  GearDesign design;
  Material material;
  BodyDiscretisation discretisation;
};

// For gear-static; `contact.positions` is resolved (never 0), `fidelity` holds the contact level only.
struct StaticParameters {
  GearMeshSpec mesh;
  Fidelity fidelity;
  ContactDiscretisation contact;
  std::array<std::string, kSides> body = {};  // hashes of their stage parameters; empty: these name none
};

// Speeds in their order. Throws Error(input) where there are none.
std::vector<double> swept_speeds(const MeshSpeeds& speeds, Direction direction);

// Of whatever moves, pair or train; a ring-down has no speeds.
struct MotionSettings : MeshSpeeds {
  Damping damping;
  TimeDiscretisation time;
};
MotionSettings motion_settings(const Scene& scene);

// For gear-sweep, gear-impact and gear-orbit of a pair.
struct SweepParameters : MotionSettings {
  std::array<double, kSides> inertia = {};  // kg m2, total
  double reference_torque = 0;  // N m: first torque listed, whose mean stiffness sets the bearing dampers
  Fidelity fidelity;
};

// What a result of a pair says of what it was computed from.
struct GearPairParameters {
  std::array<BodyParameters, kSides> gear;  // driver, driven
  GearMeshSpec mesh;
  Fidelity fidelity;  // of a pair at rest the model level of the contact alone
  ContactDiscretisation contact;

  double face_width() const {
    return std::min(gear[0].design.face_width, gear[1].design.face_width);
  }  // m, on which teeth meet
  double tooth_thinning() const {
    return gear[0].design.tooth_thinning + gear[1].design.tooth_thinning;
  }  // m; 0: no backlash is counted
};

// The same of a pair in motion.
struct MotionParameters : GearPairParameters {
  TimeDiscretisation time;
  Damping damping;
  std::array<double, kSides> inertia = {};  // kg m2, total
};

// What a result of a pair of these bodies says of it, at rest and in motion.
void set_pair(GearPairParameters& pair, const std::array<BodyParameters, kSides>& gear,
              const StaticParameters& settings);
void set_motion(MotionParameters& motion, const std::array<BodyParameters, kSides>& gear,
                const GearPairParameters& rest, const SweepParameters& settings);

}  // namespace whine
