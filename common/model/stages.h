// What each stage depends on of a scene, and what results say of it.
#pragma once
#include <string>
#include <vector>

#include "model/scene.h"

namespace whine {

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
  std::string driver_body,
      driven_body;  // hashes of the bodies' stage parameters; empty: the stage parameters name none
};

// For gear-impact.
struct ImpactParameters {
  double driver_inertia = 0, driven_inertia = 0;  // kg m2, total
  Damping damping;
  double reference_torque = 0;  // N m: first torque listed, whose mean stiffness sets the bearing dampers
  Fidelity fidelity;
};

// For gear-sweep.
struct SweepParameters : ImpactParameters {
  double frequency_from = 0, frequency_to = 0, frequency_step = 0;  // mesh frequency, Hz
  TimeDiscretisation time;
};

// What gear-variant reads: the stage parameters of one variant.
struct VariantParameters {
  StaticParameters statics;
  double torque = 0;                    // N m on the driver
  std::vector<std::string> directions;  // of sweeps: "up", "down"; none: the pair at rest, `motion` is empty
  SweepParameters motion;               // its reference torque may be another than `torque`
};

// What a result of a pair says of what it was computed from.
struct PairParameters {
  GearDesign driver, driven;
  Material driver_material, driven_material;
  BodyDiscretisation driver_body, driven_body;
  GearMeshSpec mesh;
  Fidelity fidelity;  // of a pair at rest the model level of the contact alone
  ContactDiscretisation contact;
};

// The same of a pair in motion.
struct MotionParameters : PairParameters {
  TimeDiscretisation time;
  Damping damping;
  double driver_inertia = 0, driven_inertia = 0;  // kg m2
};

}  // namespace whine
