// The inertia of a gear's body, by its drawing, against that of all that turns with the gear.
#pragma once
#include <array>
#include <string>

#include "model/stages.h"

namespace whine {

class ToothGeometry;

// kg m2: what the body of a gear has at least, from the bore to the tip, its fillets left out.
double least_body_inertia(const ToothGeometry& tooth, const Material& material);

// Inertias of a stage that the scene leaves to the drawing (0) become those of the bodies (kg m2; driver, driven gear), 0.1 %
// more: what the body lacks is lumped on the hub, and a finer mesh of the body must not be heavier than all that turns.
void as_drawn(SweepParameters& settings, const std::array<double, 2>& body_inertia);

// The same for a stage that has no bodies, by the outline of the gears; fillets make it 2 % off at most.
void as_outlined(SweepParameters& settings, const GearPairParameters& pair);

// ModelRangeError that names section, key and limit unless the gears' total inertias (kg m2) are above those of their bodies,
// which a stage knows that has them.
void require_inertia(const GearMeshSpec& mesh, const std::array<double, 2>& body_inertia,
                     const std::array<double, 2>& inertia);

// Why a total inertia (kg m2) is too small; least: words for the body's own, without the unit.
std::string too_light(double inertia, const std::string& least);

}  // namespace whine
