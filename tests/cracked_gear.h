// Gears with a crack in one tooth, as several tests make them.
#pragma once
#include <numbers>

#include "kept_body.h"

namespace whine {

inline constexpr double kPi = std::numbers::pi;
inline const Material kSteel{207e9, 0.3, 7600, true};

inline GearDesign cracked_gear(double depth, int teeth = 50, double bore = 40e-3) {
  GearDesign d;
  d.teeth = teeth;
  d.module = 3e-3;
  d.pressure_angle = 20 * kPi / 180;
  d.face_width = 25.4e-3;
  d.bore_radius = bore;
  d.crack.depth = depth;
  return d;
}

inline SectorGrid sector_of(const GearDesign& design, double element, int order = 2) {
  BodyDiscretisation discretisation;
  discretisation.element_size = element;
  discretisation.element_order = order;
  return make_sector_mesh(design, discretisation);
}

// With elements of 1 mm.
inline const ReducedBody& cracked_body(double depth, int tooth = 0) {
  GearDesign design = cracked_gear(depth);
  design.crack.tooth = tooth;
  return kept_body(design, kSteel, 1e-3, 1);
}

}  // namespace whine
