// Whether a scene's gears can exist and run together, told before minutes of work.
#pragma once
#include <array>
#include <string>

#include "files/scene.h"
#include "files/schemas.h"

namespace whine {

class ToothGeometry;

// Throws what ToothGeometry, crack_slit, FlankDeviation and GearPair throw, with the section of the scene before it and `where`
// before that: the file and the line of the key that it is about if `is_file`, else as it stands.
void check_geometry(const Scene& scene, const std::string& where, bool is_file);

// Error(input), in the same words, for a gear whose total inertia lies below least_body_inertia; of gears that check_geometry
// has passed. Statics do not depend on it.
void check_inertia(const Scene& scene, const std::string& where, bool is_file);

// kg m2: what the body of a gear has at least, from the bore to the tip, its fillets left out.
double least_body_inertia(const ToothGeometry& tooth, const Material& material);

// Inertias of a slice that the scene leaves to the drawing (0) become those of the bodies, 0.1 % more: what the body lacks is
// lumped on the hub, and a finer mesh of the body must not be heavier than all that turns.
void as_drawn(ImpactSlice& slice, const BodyArtifact& driver, const BodyArtifact& driven);

// The same for a stage that has no bodies, by the outline of the gears; fillets make it 2 % off at most.
void as_drawn(ImpactSlice& slice, const StaticArtifact& statics);

// Refusal that names section, key and limit unless the gears' total inertias (kg m2) are above those of their bodies, which a
// stage knows that has them.
void require_inertia(const GearMeshSpec& mesh, const std::array<const BodyArtifact*, 2>& bodies,
                     const std::array<double, 2>& inertia);

}  // namespace whine
