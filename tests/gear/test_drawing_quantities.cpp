// What drawings and inspection sheets state, against handbook values and sums by hand.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "gear/drawing_quantities.h"
#include "gear/path_points.h"
#include "gear/tooth_errors.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"

using namespace whine;

namespace {

// FZG type C (ISO 14635-2): 16 and 24 teeth, module 4.5 mm, shifts 0.1817 and 0.1715, 91.5 mm apart.
GearDesign fzg(int teeth, double shift, double thinning = 0) {
  GearDesign d = paper_gear(teeth, 15e-3);
  d.module = 4.5e-3;
  d.profile_shift = shift;
  d.addendum = 0.98;
  d.tooth_thinning = thinning;
  d.face_width = 14e-3;
  return d;
}

GearDesign ring_of_99() {
  GearDesign d = paper_gear(99);
  d.internal = true;
  d.addendum = 0.8;
  d.rack_tip_radius = 0.3;
  d.tooth_thinning = 30e-6;
  d.rim_outer_radius = 0.17;
  return d;
}

}  // namespace

TEST_CASE("tooth thickness on the reference circle: m (pi / 2 + 2 x tan alpha) - thinning") {
  CHECK(reference_thickness(ToothGeometry(paper_gear())) == relative(4.712388980e-3, 1e-9));
  // 4.5 (1.570796327 + 2 x 0.1817 x 0.3639702343) - 0.07
  CHECK(reference_thickness(ToothGeometry(fzg(16, 0.1817, 70e-6))) == relative(7.593783995e-3, 1e-9));
  CHECK(reference_thickness(ToothGeometry(ring_of_99())) == relative(4.682388980e-3, 1e-9));
}

TEST_CASE("span over k teeth: tables of handbooks, with profile shift and thinning") {
  // Handbooks have W = 16.9370 mm of module 1, 50 teeth, 20 degrees, over 6 teeth.
  const auto paper = span_measurement(ToothGeometry(paper_gear()));
  REQUIRE(paper);
  CHECK(paper->teeth == 6);
  CHECK(paper->length == relative(3 * 16.9370e-3, 2e-6));
  // m cos alpha (pi (k - 1/2) + z inv alpha) + 2 x m sin alpha - thinning cos alpha over 3 teeth, by hand.
  const auto pinion = span_measurement(ToothGeometry(fzg(16, 0.1817))),
             thinned = span_measurement(ToothGeometry(fzg(16, 0.1817, 70e-6))),
             wheel = span_measurement(ToothGeometry(fzg(24, 0.1715)));
  REQUIRE(pinion);
  REQUIRE(wheel);
  CHECK(pinion->teeth == 3);
  CHECK(pinion->length == relative(34.779183021e-3, 1e-9));
  CHECK(pinion->length - thinned->length == relative(70e-6 * 0.9396926208, 1e-9));
  CHECK(wheel->teeth == 3);
  CHECK(wheel->length == relative(35.251984995e-3, 1e-9));
  // The anvils touch on the involute.
  for (const auto& span : {paper, pinion, wheel}) CHECK(span->diameter > span->length);
  CHECK(paper->diameter == relative(149.832432e-3, 1e-8));
  CHECK(!span_measurement(ToothGeometry(ring_of_99())));
}

TEST_CASE("clearances and backlash: sums of a drawing") {
  GearDesign thin = paper_gear();
  thin.tooth_thinning = 50e-6;
  const GearPair pair(paper_gear(), thin, 0.1502);
  // 150.2 - 78 - (75 - 1.25 x 3)
  CHECK(tip_clearance_to_root(pair, 0) == relative(0.95e-3, 1e-9));
  CHECK(tip_clearance_to_root(pair, 1) == relative(0.95e-3, 1e-9));
  // cos a_w = 140.9538931 / 150.2: a_w = 20.20916 deg; j = 2 a (inv a_w - inv alpha) + thinning on the working circles.
  const double working = std::acos(140.9538931178627 / 150.2),
               inv = std::tan(working) - working - (std::tan(std::numbers::pi / 9) - std::numbers::pi / 9);
  CHECK(circumferential_backlash(pair) == relative(2 * 0.1502 * inv + 50e-6 * 150.2 / 150, 1e-9));
  CHECK(pair.backlash() == relative(circumferential_backlash(pair) * std::cos(working), 1e-12));
  // A planet of 35 in a ring of 99 teeth of module 3, 96 mm apart: 148.5 + 3.75 - 96 - 55.5; 148.5 - 2.4 - 96 - 48.75.
  GearDesign planet = paper_gear(35, 28e-3);
  planet.tooth_thinning = 30e-6;
  const GearPair inside(planet, ring_of_99(), 0.096), outside(ring_of_99(), planet, 0.096);
  CHECK(tip_clearance_to_root(inside, 0) == relative(0.75e-3, 1e-9));
  CHECK(tip_clearance_to_root(inside, 1) == relative(1.35e-3, 1e-9));
  CHECK(tip_clearance_to_root(outside, 1) == relative(0.75e-3, 1e-9));
  CHECK(tip_clearance_to_root(outside, 0) == relative(1.35e-3, 1e-9));
}

TEST_CASE(
    "specific sliding: sliding over the rolling speed, of external and internal pairs, either way round") {
  // 50 and 50 teeth: radii of curvature at the ends 17.881472 and 33.421550 mm.
  const GearPair equal(paper_gear(), paper_gear(), 0.150);
  const auto first = specific_sliding(equal, equal.path_start()),
             last = specific_sliding(equal, equal.path_end());
  CHECK(*first[0] == relative(-0.869060383, 1e-8));
  CHECK(*first[1] == relative(0.464971807, 1e-8));
  CHECK(*last[0] == relative(0.464971807, 1e-8));
  CHECK(*last[1] == relative(-0.869060383, 1e-8));
  GearDesign planet = paper_gear(35, 28e-3);
  planet.tooth_thinning = 30e-6;
  for (const GearPair& pair : {GearPair(fzg(16, 0.1817), fzg(24, 0.1715), 91.5e-3),
                               GearPair(planet, ring_of_99(), 0.096), GearPair(ring_of_99(), planet, 0.096)})
    for (const PathPoint& p : path_points(pair)) {
      const auto found = specific_sliding(pair, p.path);
      // Velocities of the flanks per turn of the driver, rho times 1 and z1 / z2; their difference is sliding().
      const double ratio = static_cast<double>(pair.gear(0).design().teeth) / pair.gear(1).design().teeth,
                   slip = pair.sliding(p.path),
                   v1 = pair.gear(0).base_radius() * pair.nominal_roll(0, p.path),
                   v2 = ratio * pair.gear(1).base_radius() * pair.nominal_roll(1, p.path);
      if (p.name == 'C') {
        CHECK(std::abs(*found[0]) < 1e-12);
        continue;
      }
      CHECK(std::abs(slip) == relative(std::abs(v1 - v2), 1e-9));
      CHECK(*found[0] * v1 == relative(v1 - v2, 1e-9));
      CHECK(*found[1] * v2 == relative(v2 - v1, 1e-9));
    }
  // At the tangent point of the base circle a flank does not roll at all.
  CHECK(!specific_sliding(equal, -0.075 * std::sin(std::numbers::pi / 9))[0]);
}

TEST_CASE("ISO 1328: the most that a class adds to the peak-to-peak transmission error") {
  const GearPair pair(paper_gear(), paper_gear(), 0.150);
  // Class 5, m = 3 mm, d = 150 mm, in um: f_pT = 0.001 d + 0.4 m + 5 = 6.35, f_HalphaT = 0.4 m + 0.001 d + 4 = 5.35,
  // f_falphaT = 0.55 m + 5 = 6.65, F_alphaT = 8.535 (root of the squares). Contact ratio 1.755: one step of pitch.
  CHECK(most_error_of_class(pair, 5) ==
        relative((2 * 6.35 * 0.9396926208 + 2 * std::hypot(5.35, 6.65)) * 1e-6, 1e-9));
  CHECK(most_error_of_class(pair, 7) == relative(2 * most_error_of_class(pair, 5), 1e-9));
  CHECK(failure_of([&] { most_error_of_class(pair, 12); }) == Failure::input);
}
