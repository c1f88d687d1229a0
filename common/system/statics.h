// Static equilibrium over a mesh period: transmission error, stiffness and tooth loads (Eq. 7).
#pragma once
#include <string>
#include <vector>

#include "results/reduced_body.h"
#include "results/remark.h"
#include "results/static.h"
#include "system/system_statics.h"

namespace whine {

// The driven hub is held, the driver carries torque (N m, > 0). All but the harmonics and the contact of the reference pair.
// zone_factor: the strips' candidate zone is this many times as wide as the load alone asks for. The tangent stiffness of
// contact = "line" is off by 0.6 % at most where half the load would reach a tip edge, because the flank tables are read at
// one place whatever the pair carries (make_line_position). Throws Error(input) for a torque that is not positive,
// Error(numerical) where no equilibrium within the flanks exists or a tip edge would leave the other's involute.
SystemStaticResult pair_at_rest(const ReducedBody& driver, const ReducedBody& driven,
                                const StaticParameters& settings, double torque, double zone_factor = 1);

// Its mesh.
StaticResult static_transmission(const ReducedBody& driver, const ReducedBody& driven,
                                 const StaticParameters& settings, double torque, double zone_factor = 1);

// Of statics that are complete but for them: teeth that differ, no corner contact, backlash used up, a pressure that no steel carries.
std::vector<Remark> remarks(const StaticResult& statics);

// What slices over the face hold.
Remark remark_on_slices();

// Of a pair with friction under a torque (N m, on the driver): what is left out of it, and where Schlenk's formula is beyond what it
// is fit to. Of its speeds between mesh frequencies (Hz) alone; nothing of a constant coefficient.
std::vector<Remark> friction_remarks(const GearPairParameters& pair, double torque);
std::vector<Remark> schlenk_speed_remarks(const GearPairParameters& pair, double from, double to);

// Of all pairs in reach at a mesh phase (0 to 1) of a mesh period, with the strips of `statics`, whose contact may also be
// lines: the equilibrium is solved again. Throws as static_transmission, and Error(input) for a phase or a period that is
// none of `statics`.
std::vector<ContactZone> contact_zones(const ReducedBody& driver, const ReducedBody& driven,
                                       const StaticResult& statics, double phase, int period);

// Of the reference pair at mesh phase 0; nothing where it is out of reach, or where strips find no equilibrium, which lines may have.
ReferenceContact reference_contact(const ReducedBody& driver, const ReducedBody& driven,
                                   const StaticResult& statics);

}  // namespace whine
