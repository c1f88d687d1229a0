// Dynamic factor K_v of ISO 6336-1:2006, method B (section 6.5), to set beside computed tooth loads, with N the mesh
// frequency over the resonance of the reduced mass m_red on c_gamma_alpha:
//   N <= N_S          1 + N (C_v1 B_p + C_v2 B_f + C_v3 B_k)
//   N_S < N <= 1.15   1 + C_v1 B_p + C_v2 B_f + C_v4 B_k
//   N >= 1.5          C_v5 B_p + C_v6 B_f + C_v7,              linear between 1.15 and 1.5
//   B_p = c' f_pb / (F_t / b),  B_f = c' f_f / (F_t / b),  B_k = |1 - c' C_a / (F_t / b)|,   K_A = 1
// N_S = 0.85, or 0.5 + 0.35 sqrt(F_t / b / (100 N/mm)) below that load.
#pragma once

namespace whine {

struct IsoDynamics {
  double contact_ratio = 0;      // eps_gamma, of spur gears eps_alpha
  double line_load = 0;          // N m-1: F_t / b
  double single_stiffness = 0;   // N m-1 per m: c'
  double pitch_deviation = 0;    // m: f_pb, effective
  double profile_deviation = 0;  // m: f_f, effective
  double relief = 0;             // m: C_a, design value or by running-in
};
// ratio: N, >= 0. Throws Error(input) for a contact ratio below 1, a load or a stiffness that is not above 0.
double iso_6336_dynamic_factor(const IsoDynamics& gears, double ratio);

}  // namespace whine
