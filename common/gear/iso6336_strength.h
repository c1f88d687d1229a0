// What a tooth carries by closed formulas: ISO 6336-2 and -3 (2006), method B, for external spur gears, and the loss factor of
// Niemann and Winter, to set beside computed stresses and losses.
//
// Root of the rack (ISO 6336-3, section 6), load at the outer point of single pair contact, lengths in modules:
//   x_E  = x - A / (2 m tan alpha)                    generating shift, A the thinning of the tooth at the pitch circle
//   E    = pi / 4 - h_fP tan alpha - (1 - sin alpha) rho_fP / cos alpha,   G = rho_fP - h_fP + x_E
//   H    = 2 / z (pi / 2 - E) - pi / 3,               theta = 2 G / z tan theta - H
//   s_Fn = z sin(pi / 3 - theta) + sqrt(3) (G / cos theta - rho_fP)
//   rho_F = rho_fP + 2 G^2 / (cos theta (z cos^2 theta - 2 G))
//   h_Fe = 0.5 ((cos gamma - sin gamma tan a_Fe) d_e / m - z cos(pi / 3 - theta) - G / cos theta + rho_fP)
//   Y_F  = 6 h_Fe cos a_Fe / (s_Fn^2 cos alpha),      Y_S = (1.2 + 0.13 L) q_s^(1 / (1.21 + 2.3 / L))
// with L = s_Fn / h_Fe, q_s = s_Fn / (2 rho_F), d_e the diameter of the load, cos a_e = d_b / d_e,
// gamma = (pi / 2 + 2 x_E tan alpha) / z + inv alpha - inv a_e, a_Fe = a_e - gamma.
//   sigma_F0 = F_t / (b m) Y_F Y_S,   b = min(own face width, common one + 2 m), face_width.h
//   sigma_H0 = Z_H Z_E Z_eps sqrt(F_t / (d_1 b) (u + 1) / u),   Z_H = sqrt(2 cos a_w / (cos^2 alpha sin a_w)),
//   Z_E = 1 / sqrt(pi ((1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2)),   Z_eps = sqrt((4 - eps_alpha) / 3)
// Y_S holds for 1 <= q_s < 8. Tooth fillets cut by a rack without protuberance. All are for contact ratios below 2: above there
// is no single pair contact, and more than two pairs share the load.
#pragma once
#include <array>

#include "gear/pair.h"

namespace whine {

// The critical section of a tooth, where the tangent of its fillet is at 30 degrees to its centre line.
struct IsoRoot {
  double thickness = 0;          // m: s_Fn
  double form = 0;               // Y_F
  double stress_correction = 0;  // Y_S
  bool in_range = true;          // 1 <= q_s < 8
};

// pair: of external gears. g: 0 the driver, 1 the driven gear. Throws Error(input) for an internal pair and for a contact ratio of 2
// or more, for helical gears, Error(numerical) if the section is not found.
IsoRoot iso_6336_root(const GearPair& pair, int g);

// Pa, sigma_F0 of gear g. tangential_force: N, F_t.
double iso_6336_root_stress(const GearPair& pair, int g, double tangential_force);

// Pa, sigma_H0 at the pitch point, of an external pair with a contact ratio below 2; throws as iso_6336_root() for others.
// material: of driver and driven gear. tangential_force: N, F_t.
double iso_6336_flank_pressure(const GearPair& pair, const std::array<Material, 2>& material,
                               double tangential_force);

// H_V of Ohlendorf, rigid teeth, two pairs share the load evenly:
//   H_V = pi (u + 1) / (z_1 u cos beta_b) (1 - eps_alpha + eps_1^2 + eps_2^2)
// so that the mean power lost is mu H_V times the power carried. eps_1, eps_2: addendum contact ratios. An internal pair has
// u - 1 in place of u + 1 with teeth of both counted positive. Throws Error(input) for a contact ratio of 2 or more.
double loss_factor_of_rigid_teeth(const GearPair& pair);

}  // namespace whine
