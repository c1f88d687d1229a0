// What each discretisation of the static stage is worth: one is refined alone, and the change of the answer is its entry.
#pragma once
#include "files/schemas.h"

namespace whine {

// The bodies are meshed and reduced again where an entry needs it. Entries: strips (twice as many), flank table (twice
// the points), elements (half the size), order (only for first-order elements: second), window (twice as wide).
// Errors as static_transmission, make_sector_mesh and reduce.
ErrorBudgetArtifact error_budget(const BodyArtifact& driver, const BodyArtifact& driven,
                                 const StaticSlice& slice, double torque);

}  // namespace whine
