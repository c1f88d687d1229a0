// A pair at rest over a mesh period, in slices along its contact lines: helical, misaligned, with lead modifications.
#pragma once
#include "results/reduced_body.h"
#include "results/static.h"

namespace whine {

// With settings.fidelity.width = slices; as pair_at_rest(), which calls it. Throws Error(input) for what slices do not take
// (system/face_contact.h), and Error(numerical) where contact leaves the flanks. Contact is that of Hertz's lines, whatever
// settings.fidelity.contact is, and the result says so.
SystemStaticResult face_at_rest(const ReducedBody& driver, const ReducedBody& driven,
                                const StaticParameters& settings, double torque);

// Its mesh.
StaticResult face_transmission(const ReducedBody& driver, const ReducedBody& driven,
                               const StaticParameters& settings, double torque);

}  // namespace whine
