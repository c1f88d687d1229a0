#include "gear/friction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace whine {

PairSliding sliding_of(const GearPair& pair, const PairContact& contact, double smoothing) {
  PairSliding out;
  for (int g = 0; g < kSides; ++g) {
    const auto side = static_cast<size_t>(g);
    const double base = pair.gear(g).base_radius(), lever = contact.lever[side],
                 radius = base * std::hypot(1.0, contact.roll[side]);
    // On the line of action r_b xi, without the round-off of the root.
    const double along = contact.corner ? std::sqrt(std::max(0.0, radius * radius - lever * lever))
                                        : base * contact.roll[side];
    const int turns = g == 1 && !pair.internal() ? -1 : 1;  // against the driver
    out.lever[side] = turns * pair.rolls_outwards(g) * along;
  }
  const double ratio = static_cast<double>(pair.gear(0).design().teeth) / pair.gear(1).design().teeth;
  out.speed = out.lever[0] - ratio * out.lever[1];
  const double smooth = smoothing * pair.gear(0).base_radius() / std::cos(pair.working_pressure_angle());
  out.direction = out.speed / std::hypot(out.speed, smooth);
  return out;
}

double pitch_line_speed(const GearPair& pair, double mesh_frequency) {
  return 2 * std::numbers::pi * mesh_frequency / pair.gear(0).design().teeth * pair.gear(0).base_radius() /
         std::cos(pair.working_pressure_angle());
}

double line_load(const GearPair& pair, double face_width, double torque) {
  return torque / pair.gear(0).base_radius() / face_width * 1e-3;
}

double friction_coefficient(const GearPair& pair, double face_width, const Friction& friction, double torque,
                            double mesh_frequency) {
  if (friction.law == FrictionLaw::constant) return friction.coefficient;
  if (!(mesh_frequency > 0) || !(torque > 0))
    fail(Failure::input,
         "Schlenk's coefficient of friction needs a torque and a mesh frequency above 0, given are ", torque,
         " N m and ", mesh_frequency, " Hz; set static_frequency_Hz in [friction]");
  if (!(friction.viscosity > 0) || !(friction.roughness > 0))
    fail(Failure::input,
         "Schlenk's coefficient of friction needs a viscosity and a roughness above 0, given are ",
         friction.viscosity * 1e3, " mPa s and ", friction.roughness * 1e6,
         " µm; set viscosity_mPas and roughness_um in [friction]");
  const double speed =
      std::clamp(pitch_line_speed(pair, mesh_frequency), kSchlenkSpeeds[0], kSchlenkSpeeds[1]);
  const double load = std::max(kSchlenkLoad, line_load(pair, face_width, torque)),
               sum_of_speeds = 2 * speed * std::sin(pair.working_pressure_angle()),  // m s-1
      curvature = pair.relative_curvature_radius(0.0) * 1e3;                         // mm
  const double coefficient = 0.048 * std::pow(load / (sum_of_speeds * curvature), 0.2) *
                             std::pow(friction.viscosity * 1e3, -0.05) *
                             std::pow(friction.roughness * 1e6, 0.25) * friction.lubricant_factor;
  constexpr double kMost = 0.3;  // as of a coefficient that a scene gives
  if (!(coefficient <= kMost))
    fail(
        Failure::input, "Schlenk's formula gives a coefficient of friction of ", coefficient, " at ",
        mesh_frequency, " Hz, at most ", kMost,
        " is allowed; check viscosity_mPas, roughness_um, lubricant_factor and static_frequency_Hz of [friction], or raise the speed");
  return coefficient;
}

std::string in_words(const Friction& f) {
  return text(f.law == FrictionLaw::constant ? text("coefficient ", f.coefficient)
                                             : text("Schlenk's formula, ", f.viscosity * 1e3, " mPa s, Ra ",
                                                    f.roughness * 1e6, " µm, X_L ", f.lubricant_factor),
              ", smoothed over ", f.smoothing * 100, " % of the speed of the pitch line");
}

}  // namespace whine
