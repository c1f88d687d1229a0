#include "gear/internal_mesh.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace whine {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

double involute_of_roll(double roll) {
  return roll - std::atan(roll);
}

struct Edges {
  explicit Edges(const GearPair& pair)
      : pinion(pair.gear(1 - pair.ring())), ring(pair.gear(pair.ring())), a(pair.centre_distance()) {
    const double working = involute_of_roll(std::tan(pair.working_pressure_angle()));
    ratio = static_cast<double>(pinion.design().teeth) / ring.design().teeth;
    of_pinion = involute_of_roll(pinion.tip_roll_angle()) - working;
    of_ring = working - involute_of_roll(ring.tip_roll_angle());
  }
  // rad: the ring's edge, where the pinion's stands at eta.
  double ring_angle(double eta) const { return (eta + of_pinion) * ratio + of_ring; }

  const ToothGeometry &pinion, &ring;
  double a, ratio = 0, of_pinion = 0, of_ring = 0;
};

}  // namespace

double tip_clearance(const GearPair& pair) {
  if (!pair.internal()) return kNone;
  const Edges e(pair);
  const double r1 = e.pinion.tip_radius(), r2 = e.ring.tip_radius();
  const double about_pinion = (r2 * r2 - e.a * e.a - r1 * r1) / (2 * e.a * r1),
               about_ring = (e.a * e.a + r2 * r2 - r1 * r1) / (2 * e.a * r2);
  if (!(std::abs(about_pinion) < 1 && std::abs(about_ring) < 1)) return kNone;
  return r2 * (e.ring_angle(std::acos(about_pinion)) - std::acos(about_ring));
}

double radial_assembly_clearance(const GearPair& pair) {
  if (!pair.internal()) return kNone;
  const Edges e(pair);
  constexpr int kPlaces = 2000;
  double least = kNone;
  for (int i = 0; i <= kPlaces; ++i) {  // teeth beyond a quarter turn come out first
    const double eta = 0.5 * std::numbers::pi * i / kPlaces;
    least = std::min(
        least, e.ring.tip_radius() * std::sin(e.ring_angle(eta)) - e.pinion.tip_radius() * std::sin(eta));
  }
  return least;
}

}  // namespace whine
