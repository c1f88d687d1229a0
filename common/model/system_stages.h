// What the stages of a system depend on of its scene.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "model/scene.h"
#include "model/stages.h"

namespace whine {

// For gear-static; `contact.positions` is resolved (never 0), `fidelity` holds the contact level only.
struct SystemStaticParameters {
  System layout;                   // with its carriers
  std::vector<std::string> gear;   // [body] the [gear.<name>] that it is; "" of a carrier
  std::vector<GearMeshSpec> mesh;  // [[mesh]] of the scene: that of one planet is for all planets
  std::vector<int> section;        // [mesh of the layout] its number in `mesh`
  Fidelity fidelity;
  ContactDiscretisation contact;
  std::vector<std::pair<std::string, std::string>>
      body;  // gears, and hashes of the stage parameters of their bodies
  std::vector<ToothErrors>
      errors;  // [body] of its teeth; those of `mesh` are none. Fewer: the others have none

  bool has_errors(size_t of_body) const { return of_body < errors.size() && !errors[of_body].none(); }

  // The gears, each once, in the order of the bodies.
  std::vector<std::string> gears() const {
    std::vector<std::string> out;
    out.reserve(body.size());
    for (const auto& [name, hash] : body) out.push_back(name);
    return out;
  }
  // Of all meshes.
  Friction friction() const { return mesh.empty() ? Friction{} : mesh[0].friction; }
  void set_friction(const Friction& friction) {
    for (GearMeshSpec& pair : mesh) pair.friction = friction;
  }
  // Of a gear's flanks, which all its meshes have alike.
  FlankModification modification(const std::string& of) const {
    for (const GearMeshSpec& pair : mesh)
      for (size_t g = 0; g < kSides; ++g)
        if (pair.gear[g] == of) return pair.modification[g];
    return {};
  }
  void modify(const std::string& which, const FlankModification& modification) {
    for (GearMeshSpec& pair : mesh)
      for (size_t g = 0; g < kSides; ++g)
        if (pair.gear[g] == which) pair.modification[g] = modification;
  }
};

// For gear-sweep, gear-impact and gear-orbit; `fidelity` holds the level of the bodies as well. Contact in motion is of lines.
struct SystemSweepParameters : SystemStaticParameters, MotionSettings {
  // N m-1 of a pair in slices, to which the dampers of its axes refer: mean mesh stiffness at the reference torque; 0: of its own statics.
  double axis_stiffness = 0;
};

// What gear-variant reads: the stage parameters of one variant.
struct VariantParameters {
  StaticParameters statics;
  double torque = 0;                  // N m on the driver
  std::vector<Direction> directions;  // of sweeps; none: the pair at rest, `motion` is empty
  SweepParameters motion;             // its reference torque may be another than `torque`
  // Of a train in place of all but the directions; without them `damping`, speeds and `time` are empty. Of a pair no bodies.
  SystemSweepParameters train;
  bool of_train() const { return !train.layout.bodies.empty(); }
};

}  // namespace whine
