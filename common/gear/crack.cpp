#include "gear/crack.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/error.h"
#include "base/units.h"

namespace whine {
namespace {

// rad: of the root curve's tangent against the centre line.
double tangent_angle(const ToothGeometry& gear, double t) {
  constexpr double kStep = 1e-5;
  const Vec2 along = gear.root_point(t + kStep) - gear.root_point(t - kStep);
  return std::atan2(-along.x(), -along.y());
}

// Where a point lies that is not in the tooth; empty if it is.
std::string outside(const ToothGeometry& gear, const Vec2& p) {
  const double radius = p.norm();
  if (radius < gear.design().bore_radius) return "the bore";
  if (radius > gear.tip_radius()) return "the tip";
  if (std::atan2(std::abs(p.x()), p.y()) <= gear.half_span(radius)) return "";
  if (radius <= gear.root_radius()) return "the sector of the next tooth";
  return p.x() > 0 ? "the other side of the tooth" : "the side that it starts from";
}

}  // namespace

Slit crack_slit(const ToothGeometry& gear) {
  if (gear.internal())
    fail(Failure::input, "crack: a cracked tooth of an internal gear is not modelled; take the section out");
  if (gear.design().helical())
    fail(Failure::input, "crack: a cracked tooth of a helical gear is not modelled; take the section out");
  const Crack& crack = gear.design().crack;
  if (crack.tooth < 0 || crack.tooth >= gear.design().teeth)
    fail(Failure::input, "crack: tooth = ", crack.tooth, ", but the gear has the teeth 0 to ",
         gear.design().teeth - 1);
  // Elements about a tip that lies next to the surface would have no size left.
  constexpr double kShortest = 0.01;  // modules
  if (crack.depth < kShortest * gear.design().module)
    fail(Failure::input, "crack: depth_mm = ", crack.depth * 1e3, " is too short to be meshed: at least ",
         kShortest, " modules, ", kShortest * gear.design().module * 1e3, " mm; 0 says that there is none");
  double low = 1e-4, high = gear.root_corner() - 1e-4;
  const double first = tangent_angle(gear, low), last = tangent_angle(gear, high);
  if (!(crack.start > first && crack.start < last))
    fail(Failure::input, "crack: start_deg = ", crack.start * kInDegrees,
         " is not on the fillet of this tooth, whose tangent makes ", first * kInDegrees, " to ",
         last * kInDegrees, " deg with the centre line");
  for (int i = 0; i < 60; ++i) {
    const double t = 0.5 * (low + high);
    (tangent_angle(gear, t) < crack.start ? low : high) = t;
  }
  Slit slit;
  slit.mouth_at = 0.5 * (low + high);
  slit.mouth = gear.root_point(slit.mouth_at);

  const Vec2 direction(std::sin(crack.angle), -std::cos(crack.angle));
  const double module = gear.design().module, step = 0.01 * module;
  double inside = 0, beyond = step;
  while (outside(gear, slit.mouth + beyond * direction).empty()) {
    inside = beyond;
    beyond += step;
  }
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (inside + beyond);
    (outside(gear, slit.mouth + middle * direction).empty() ? inside : beyond) = middle;
  }
  const std::string where = outside(gear, slit.mouth + beyond * direction);
  if (inside < step)
    fail(Failure::input, "crack: angle_deg = ", crack.angle * kInDegrees,
         " does not lead into the tooth at start_deg = ", crack.start * kInDegrees,
         "; 90 - start_deg = ", 90 - crack.start * kInDegrees, " is square to the fillet");
  const double longest = inside - 0.25 * module;
  if (crack.depth > longest)
    fail(Failure::input, "crack: depth_mm = ", crack.depth * 1e3, " is ",
         crack.depth >= inside ? "longer than the tooth: " : "too long: ", "at angle_deg = ",
         crack.angle * kInDegrees, " the slit comes to ", where, " after ", inside * 1e3,
         " mm, and a quarter of a module must be left; at most ", longest * 1e3, " mm");
  slit.tip = slit.mouth + crack.depth * direction;
  return slit;
}

}  // namespace whine
