// Which part of two face widths that differ carries the load of their teeth.
//
//   b_c = min(b_1, b_2)             width of the contact, of both flanks
//   b_e = min(b, b_c + 2 m)         width of a tooth that takes part
// m the module: ISO 6336-3 counts at most one module of a wider gear beyond either end of the contact. The body keeps its whole
// width b, and so do its mass and inertia.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/format.h"
#include "model/gear.h"

namespace whine {

inline double contact_width(const GearDesign& a, const GearDesign& b) {  // m
  return std::min(a.face_width, b.face_width);
}

// m: z of the middle of the contact in the face of each gear, from its own middle; offset: GearMeshSpec::face_offset. Throws
// Error(input) where the narrower face does not stand inside the wider one.
inline std::array<double, 2> contact_middle(const GearDesign& driver, const GearDesign& driven,
                                            double offset) {
  const double room = 0.5 * std::abs(driver.face_width - driven.face_width);
  if (std::abs(offset) > room + 1e-9)
    fail(Failure::input, "face_offset_mm = ", shown_number(offset * 1e3), ": faces of ",
         shown_number(driver.face_width * 1e3), " and ", shown_number(driven.face_width * 1e3),
         " mm leave room for ", shown_number(room * 1e3),
         " mm to either side, within which the narrower face stands inside the wider one");
  if (driver.face_width <= driven.face_width) return {0, -offset};
  return {offset, 0};
}

inline double carrying_width(const GearDesign& gear, double contact) {  // m; contact: m, of the mesh
  return std::min(gear.face_width, contact + 2 * gear.module);
}

// Degree of the polynomials over the faces that holds smooth loads to 0.1 % of the largest displacement: 8 up to a width of 10 modules, 12 up
// to 15, then 0.8 widths in modules, at most 24.
inline int degree_of_width(const GearDesign& a, const GearDesign& b) {
  constexpr double kRoundOff = 1e-9;
  const double modules = std::max(a.face_width / a.module, b.face_width / b.module);
  if (modules <= 10 + kRoundOff) return 8;
  if (modules <= 15 + kRoundOff) return 12;
  return static_cast<int>(std::min(24.0, std::ceil(0.8 * modules - kRoundOff)));
}

// Of a mesh of two gears whose widths differ, in words; "" of equal ones.
inline std::string width_words(const GearDesign& a, const std::string& name_a, const GearDesign& b,
                               const std::string& name_b) {
  if (a.face_width == b.face_width) return "";
  const bool first = a.face_width > b.face_width;
  const GearDesign& wider = first ? a : b;
  const double common = contact_width(a, b);
  const auto shown = [](double width) { return shown_number(width * 1e3); };
  return text("the faces of ", name_a, " and ", name_b, " are ", shown(a.face_width), " and ",
              shown(b.face_width), " mm wide: contact is over the common ", shown(common),
              " mm, and the teeth of ", first ? name_a : name_b, " carry it on ",
              shown(carrying_width(wider, common)), " mm (at most a module more on either side)");
}

}  // namespace whine
