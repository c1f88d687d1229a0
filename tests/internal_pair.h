// The planet of 35 teeth in the ring of 99 of data/scenes/internal-pair.toml.
#pragma once
#include <numbers>

#include "model/gear.h"

namespace whine {

inline constexpr double kInternalDistance = 88.9e-3;  // m

inline GearDesign planet_gear() {
  GearDesign d;
  d.teeth = 35;
  d.module = kInternalDistance / 32;
  d.pressure_angle = 20.19 * std::numbers::pi / 180;
  d.tooth_thinning = 0.03e-3;
  d.face_width = 25.4e-3;
  d.bore_radius = 28e-3;
  return d;
}

inline GearDesign ring_gear() {
  GearDesign d = planet_gear();
  d.teeth = 99;
  d.addendum = 0.8;
  d.rack_tip_radius = 0.3;
  d.bore_radius = 0;
  d.internal = true;
  d.rim_outer_radius = 155e-3;
  return d;
}

}  // namespace whine
