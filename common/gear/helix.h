// Helical gears: from the normal section, in which drawings give them, to the transverse one, which rolls (ISO 21771:2007, 4.2 to 5.3).
//
//   m_t = m_n / cos beta,  tan alpha_t = tan alpha_n / cos beta,  x_t = x cos beta, heights in transverse modules likewise,
//   sin beta_b = sin beta cos alpha_n,  tan beta_b = tan beta cos alpha_t,  kappa = tan beta_b / r_b,
//   eps_beta = b sin beta / (pi m_n) = b tan beta_b / p_bt.
// The transverse section of a helical gear is an ordinary involute gear. Its root is cut by the transverse section of the rack with a tip
// of the same radius, a circle in place of an ellipse.
#pragma once
#include <string>

#include "model/gear.h"

namespace whine {

// The spur gear whose section is the transverse section of `design`; a spur gear is its own.
GearDesign transverse_section(const GearDesign& design);

// rad: beta_b, positive of a right-hand helix, negative of a left-hand one.
double base_helix_angle(const GearDesign& design);

// Why the helices of two gears do not mesh, with a remedy; "" if they do.
std::string helix_fault(const GearDesign& driver, const GearDesign& driven);

// rad m-1: kappa, turn of the section per length of face, counter-clockwise, of the same sign.
double helix_twist(const GearDesign& design);

}  // namespace whine
