// One cylindrical stage of a REXS model: its two gears, the driver first, the distance of their axes and their profile shifts.
//
// Private to the layer io/.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "io/rexs/reader.h"
#include "model/gear.h"

namespace whine {

struct RexsStage {
  int id = -1;
  std::array<int, kSides> gear = {-1, -1};  // driver, driven
  std::string driver_assumed;               // why the driver is the one that it is; empty: the model says so
};

// The cylindrical_stage or planetary_stage of an id or name; of "" the only one, where the meshes of a planetary_stage do not count.
// Throws Error(input) with the stages that there are.
int chosen_stage(const RexsReader& reader, const std::string& wanted);

// Throws Error(input) for a stage without two gears, and where both drive.
RexsStage stage_of(RexsReader& reader, int id);

// The planetary_stage that a cylindrical_stage is a mesh of; -1: none.
int planetary_stage_of(const RexsReader& reader, int stage);

// A ring_gear, or a gear with a number of teeth below 0.
bool is_internal(RexsReader& reader, int gear);
// Above 0, also of internal gears. Throws Error(input) for what is no number of teeth.
RexsNumber teeth_of(RexsReader& reader, int gear);

// mm: that of the stage; else, assumed, that of the positions of its gears or shafts. Throws Error(input) where neither is there.
RexsNumber centre_distance(RexsReader& reader, const RexsStage& stage);

// Where the axis of a gear stands, in its own position or that of its shaft: mm, and the component that it is in coordinates of.
struct RexsPlace {
  std::array<double, 3> at, axis;  // mm, 1
  std::string reference, origin;
};
std::optional<RexsPlace> place_of(RexsReader& reader, int gear);

// In modules, with the signs of ISO 21771 (x1 + x2 of the pair without backlash, an internal gear with its teeth below 0):
//   x1 + x2 = (z1 + z2) (inv alpha_wt - inv alpha_t) / (2 tan alpha_n), cos alpha_wt = |z1 + z2| m_t cos alpha_t / (2 a).
RexsNumber shift_sum(RexsReader& reader, const RexsStage& stage);
// As the flanks say; empty: they say none.
std::optional<RexsNumber> shift_of(RexsReader& reader, int gear);
// [side of the stage] What is not said follows, assumed, from the centre distance; where neither is said both have one half.
std::array<RexsNumber, kSides> profile_shifts(RexsReader& reader, const RexsStage& stage);

RexsNumber pressure_angle_of(RexsReader& reader, int gear);  // deg; Error(input) where no flank says it
RexsNumber helix_of(RexsReader& reader,
                    int gear);  // deg at the reference circle, positive: right-hand; 0: a spur gear

}  // namespace whine
