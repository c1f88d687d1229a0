// Where an artifact of the pipeline has to lie: out/<scene>/T<torque>/[<model>/][up|down/]<kind>.h5, bodies in
// out/bodies/<hash of their stage parameters>, variants of studies under the hash of theirs. Freshness is judged at the paths
// of the inputs that an artifact records, so a file that was copied from elsewhere is fresh, and of another scene, torque or
// direction.
#pragma once
#include <string>

#include "io/provenance.h"

namespace whine {

// What the artifact says of itself that its place below out/ contradicts, such as "is at 100 N m, but lies in T200"; "" if
// nothing, or if it lies elsewhere.
std::string misplaced(const std::string& path, const Origin& origin);

}  // namespace whine
