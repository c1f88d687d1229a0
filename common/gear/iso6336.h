// Tooth stiffness by ISO 6336-1:2006, method B (section 9): closed formulas for spur gears of a basic rack, solid discs or with
// a rim of full stiffness, by which results of the elastic model can be set beside what practice uses.
//
//   q'     = 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 x1 - 0.11654 x1 / z1 - 0.00193 x2 - 0.24188 x2 / z2
//            + 0.00529 x1^2 + 0.00182 x2^2                                           mm um / N, teeth, profile shifts
//   c'_th  = 1 / q'                                                                  theoretical, N / (mm um)
//   c'     = c'_th C_M C_R C_B,   C_M = 0.8, C_R = 1 (solid disc)
//   C_B    = [1 + 0.5 (1.2 - h_fP / m)] [1 - 0.02 (20 deg - alpha_P)]                basic rack: mean of both gears
//   c_gamma_alpha = c' (0.75 epsilon_alpha + 0.25)                                   mean of a mesh period
// Below a load of 100 N/mm c' falls as (load / 100)^0.25; other materials than steel scale by their moduli,
// 2 E1 E2 / (E1 + E2) over 206 GPa. Of shafts and bores it knows nothing.
#pragma once
#include "model/gear.h"

namespace whine {

struct IsoStiffness {
  double single = 0;     // N m-1 per m of face width: c', largest stiffness of one pair
  double mesh = 0;       // N m-1 per m: c_gamma_alpha, mean over a mesh period
  double line_load = 0;  // N m-1: tangential force at the pitch circle over the face width, K_A = 1
  bool in_range =
      true;  // the formula is for -0.5 <= x1 + x2 <= 2, contact ratio 1.2 to 1.9 (5 % there), external gears
};

// torque: N m on the driver, > 0; contact_ratio: 1.
IsoStiffness iso_6336_stiffness(const GearDesign& driver, const Material& driver_material,
                                const GearDesign& driven, const Material& driven_material, double torque,
                                double contact_ratio);

}  // namespace whine
