// Coulomb friction between the flanks of a pair, its direction and its size known from the kinematics.
//
// Where two flanks touch with the normal force N, the friction force mu s N acts across the normal. With n the normal from
// the driver's flank to the driven gear's and tau = n turned by 90 degrees counter-clockwise, it acts on the driver along
// -tau, on the driven gear along tau:
//   v = (t_1 omega_1 - t_2 omega_2) the driver's flank over the driven gear's along tau,   s = v / sqrt(v^2 + v_0^2),
//   v_0 = smoothing times the speed of the pitch line, r_b1 / cos(alpha_w) omega_1.
// t_g is the lever arm of tau about the axis of gear g, counted in its sense of rotation: on the line of action its radius of
// curvature there. v and v_0 go with the speed, so s does not depend on it. Moments about the axes are N (a_g + mu s t_g),
// a_g the lever arm of the normal; the power that friction takes is mu s N v.
#pragma once
#include <array>
#include <string>

#include "gear/pair.h"

namespace whine {

// Of one pair of teeth at one phase.
struct PairSliding {
  std::array<double, 2> lever{};  // m: t_g
  double speed = 0;               // m rad-1: v per angle of the driver
  double direction = 0;           // 1, -1 to 1: s

  double loss() const { return direction * speed; }  // m rad-1, >= 0: work per mu N and angle of the driver
};
// Touched points that are no corner lie on the line of action. smoothing: 1, above 0.
PairSliding sliding_of(const GearPair& pair, const PairContact& contact, double smoothing);

// 1: mu of a scene under `torque` (N m, on the driver) at a mesh frequency (Hz). Schlenk's formula:
//   mu = 0.048 (F_bt / b / (v_sum rho))^0.2 eta^-0.05 Ra^0.25 X_L
// with F_bt = T / r_b1 over the face width b on which the teeth meet in N/mm, v_sum = 2 v_t sin(alpha_w) in m/s and the
// relative radius of curvature rho in mm, both at the pitch point, eta in mPa s and Ra in micrometres. It is a fit to tests of
// external gears at pitch-line speeds v_t of about 1 to 50 m/s and with 150 N/mm or more. Beyond, the nearest of these values
// replaces it. Source: Schlenk, dissertation, TU Muenchen 1994, as Niemann and Winter, Maschinenelemente 2, give it.
// Throws Error(input) if torque, speed, viscosity or roughness of Schlenk's formula is not above 0 or the coefficient above 0.3.
double friction_coefficient(const GearPair& pair, double face_width, const Friction& friction, double torque,
                            double mesh_frequency);

// m s-1: pitch-line speeds that Schlenk's formula is fit to, and v_t of a pair at a mesh frequency (Hz).
inline constexpr double kSchlenkSpeeds[] = {1, 50};
double pitch_line_speed(const GearPair& pair, double mesh_frequency);
// N mm-1: least line load of the formula, and that of a pair, F_bt / b.
inline constexpr double kSchlenkLoad = 150;
double line_load(const GearPair& pair, double face_width, double torque);

// "coefficient 0.05, smoothed over 1 % of the speed of the pitch line"
std::string in_words(const Friction& friction);

}  // namespace whine
