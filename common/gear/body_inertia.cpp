#include "gear/body_inertia.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/format.h"
#include "base/model_range.h"
#include "gear/involute.h"

namespace whine {

std::string too_light(double inertia, const std::string& least) {
  return text(
      "total_inertia_kgm2 = ", shown_number(inertia), " lies below the inertia of its own body, ", least,
      " kg m2: it is that of all that turns with the gear; raise it, or take the line out: the gear as drawn is used then");
}

double least_body_inertia(const ToothGeometry& tooth, const Material& material) {
  constexpr int kSteps = 400;
  // Chords of a coarse mesh cut off less.
  constexpr double kSafe = 0.995;
  const GearDesign& design = tooth.design();
  const double root = tooth.root_radius(), tip = tooth.tip_radius(), held = design.clamped_radius();
  const double form = tooth.base_radius() * std::hypot(1.0, tooth.form_roll_angle());
  // Towards the root a tooth that is not undercut only widens from the involute on.
  const auto angle = [&](double r) {
    if (tooth.undercut() > 0) return 2 * tooth.half_span(r);
    const double within = tooth.internal() ? std::min(r, form) : std::max(r, form);
    return tooth.thickness_at_radius(within) / within;
  };
  double teeth = 0;
  const double step = (tip - root) / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double r = root + (i + 0.5) * step;
    teeth += design.teeth * angle(r) * r * r * r * std::abs(step);
  }
  return kSafe * material.density * design.face_width *
         (0.5 * std::numbers::pi * std::abs(std::pow(root, 4) - std::pow(held, 4)) + teeth);
}

void as_drawn(SweepParameters& settings, const std::array<double, 2>& body_inertia) {
  constexpr double kMore = 1.001;
  for (int g = 0; g < kSides; ++g)
    if (settings.inertia[g] == 0) settings.inertia[g] = kMore * body_inertia[g];
}

void as_outlined(SweepParameters& settings, const GearPairParameters& pair) {
  constexpr double kFillets = 1.015;
  for (int g = 0; g < kSides; ++g)
    if (settings.inertia[g] == 0)
      settings.inertia[g] =
          kFillets * least_body_inertia(ToothGeometry(pair.gear[g].design), pair.gear[g].material);
}

void require_inertia(const GearMeshSpec& mesh, const std::array<double, 2>& body_inertia,
                     const std::array<double, 2>& inertia) {
  for (int g = 0; g < kSides; ++g)
    if (!(inertia[g] > body_inertia[g]))
      fail_outside_range(Failure::input, "[gear.", mesh.gear[g],
                         "] of the scene: ", too_light(inertia[g], shown_number(body_inertia[g])));
}

}  // namespace whine
