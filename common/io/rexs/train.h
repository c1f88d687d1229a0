// One planetary stage of a REXS model: sun, planets, ring, carrier; which member is held and which drives; torque and speed.
//
// With T_s, T_r, T_c the torques on sun, ring and carrier and z the numbers of teeth, T_s : T_r : T_c = z_s : z_r : -(z_s + z_r),
// shared equally by N planets. Speeds obey (n_s - n_c) z_s = -(n_r - n_c) z_r, and the mesh frequency is |n_s - n_c| z_s.
//
// Private to the layer io/.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/rexs/stage.h"

namespace whine {

enum class RexsMember { sun, ring, carrier };
inline constexpr std::array kRexsMembers{RexsMember::sun, RexsMember::ring, RexsMember::carrier};
const char* name_of(RexsMember member);

struct RexsTrain {
  struct Planet {
    int gear = -1;
    RexsStage sun_mesh, ring_mesh;
    double angle =
        0;  // deg, 0 to 360, from the first planet, counter-clockwise where the first driver turns so
  };
  int stage = -1, sun = -1, ring = -1;
  std::vector<Planet> planets;     // angles ascend from 0
  std::string positions;           // where angles are from
  bool positions_assumed = false;  // equal spacing
  double sun_teeth = 0, ring_teeth = 0;
  RexsMember held = RexsMember::ring, input = RexsMember::sun;
  std::string held_origin, input_origin;  // why
  bool held_assumed = false, input_assumed = false;
  RexsNumber sun_torque;                     // N m, above 0; of all meshes of the sun
  std::optional<RexsNumber> mesh_frequency;  // Hz
  std::vector<std::string> remarks;          // what the model says beside it and what does not agree

  // In the frame of the carrier, where all meshes are: whether the sun drives the planets, or the ring.
  bool sun_drives() const;
  RexsMember output() const;
  // N m: share of a member in all torques, of that on the sun.
  double torque_of(RexsMember member) const;
};

// Throws Error(input) where there is not one sun, one ring and planets that mesh with both, where no or several members are held,
// and where speeds contradict each other.
RexsTrain train_of(RexsReader& reader, int planetary_stage);

}  // namespace whine
