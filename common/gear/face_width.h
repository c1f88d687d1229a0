// Which part of two face widths that differ carries the load of their teeth.
//
//   b_c = min(b_1, b_2)             width of the contact, of both flanks
//   b_e = min(b, b_c + 2 m)         width of a tooth that takes part
// m the module: ISO 6336-3 counts at most one module of a wider gear beyond either end of the contact. The body keeps its whole
// width b, and so do its mass and inertia.
#pragma once
#include <algorithm>
#include <string>

#include "base/error.h"
#include "base/format.h"
#include "model/gear.h"

namespace whine {

inline double contact_width(const GearDesign& a, const GearDesign& b) {  // m
  return std::min(a.face_width, b.face_width);
}

inline double carrying_width(const GearDesign& gear, double contact) {  // m; contact: m, of the mesh
  return std::min(gear.face_width, contact + 2 * gear.module);
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
