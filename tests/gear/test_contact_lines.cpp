// Helical gears: normal and transverse section, contact lines over the common face, lead modifications.
#include "gear/contact_lines.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "gear/drawing_quantities.h"
#include "gear/helix.h"
#include "gear/iso6336.h"
#include "refusal.h"
#include "relative.h"

using namespace whine;

namespace {

constexpr double kDegreeInRad = std::numbers::pi / 180;

GearDesign helical_gear(int teeth, double module, double beta, Hand hand, double width) {
  GearDesign d;
  d.teeth = teeth;
  d.module = module;
  d.pressure_angle = 20 * kDegreeInRad;
  d.helix_angle = beta * kDegreeInRad;
  d.hand = hand;
  d.face_width = width;
  d.bore_radius = 0.3 * teeth * module;
  return d;
}

GearPair helical_pair(double beta, double width, int teeth = 50, double module = 3e-3) {
  const GearDesign a = helical_gear(teeth, module, beta, Hand::right, width),
                   b = helical_gear(teeth, module, beta, Hand::left, width);
  return {a, b, teeth * module / std::cos(beta * kDegreeInRad)};
}

// m: face width of helical_pair with this overlap ratio.
double width_of_overlap(double overlap, double beta, double module = 3e-3) {
  return overlap * std::numbers::pi * module / std::sin(beta * kDegreeInRad);
}

}  // namespace

TEST_CASE("transverse section of a helical gear: ISO 21771, a 50-tooth gear of 20 degrees") {
  const GearDesign drawn = helical_gear(50, 3e-3, 20, Hand::right, 20e-3);
  const ToothGeometry tooth(drawn);
  CHECK(tooth.section().module * 1e3 == relative(3.19253, 2e-6));
  CHECK(tooth.section().pressure_angle / kDegreeInRad == relative(21.1728, 2e-6));
  CHECK(tooth.pitch_radius() * 1e3 == relative(79.8133, 1e-6));
  CHECK(tooth.base_radius() * 1e3 == relative(74.4255, 1e-6));
  CHECK(tooth.tip_radius() * 1e3 == relative(82.8133, 1e-6));
  CHECK(tooth.root_radius() * 1e3 == relative(76.0633, 1e-6));
  CHECK(helix_twist(drawn) * 1e-3 == relative(4.56027e-3, 2e-6));
  CHECK(std::tan(base_helix_angle(drawn)) == relative(0.339400, 2e-6));
  GearDesign other = drawn;
  other.hand = Hand::left;
  CHECK(base_helix_angle(other) == -base_helix_angle(drawn));
  // Of a spur gear not a bit changes.
  GearDesign spur = drawn;
  spur.helix_angle = 0;
  CHECK(ToothGeometry(spur).section().module == spur.module);
  CHECK(base_helix_angle(spur) == 0);
}

TEST_CASE("a span over helical teeth is measured along their normal") {
  // W = m_n cos alpha_n (pi (k - 1/2) + z inv alpha_t) without shift.
  const GearDesign drawn = helical_gear(50, 3e-3, 20, Hand::right, 40e-3);
  const auto span = span_measurement(ToothGeometry(drawn));
  REQUIRE(span);
  const double alpha_t = transverse_section(drawn).pressure_angle;
  CHECK(span->length ==
        relative(3e-3 * std::cos(20 * kDegreeInRad) *
                     (std::numbers::pi * (span->teeth - 0.5) + 50 * involute_function(alpha_t)),
                 1e-12));
}

TEST_CASE("geometry and forces of test 001 of RIKOR") {
  GearDesign pinion = helical_gear(14, 8e-3, 11, Hand::right, 137e-3),
             wheel = helical_gear(59, 8e-3, 11, Hand::left, 127e-3);
  pinion.profile_shift = 0.4713;
  pinion.bore_radius = 20e-3;
  const double reference = 0.5 * (14 + 59) * 8e-3 / std::cos(11 * kDegreeInRad);
  const GearPair pair(pinion, wheel, reference + 0.4713 * 8e-3);
  CHECK(2e3 * pair.gear(0).base_radius() == relative(106.979, 1e-5));
  CHECK(pair.base_helix_angle() / kDegreeInRad == relative(10.3291, 1e-5));
  CHECK(pair.overlap_ratio() == relative(0.96419, 1e-5));
  const HelicalForces force = helical_forces(pair, 8962.5);
  CHECK(force.transverse == relative(167555.8, 1e-6));
  CHECK(force.normal == relative(170316, 1e-5));
  CHECK(force.axial == relative(30538, 1e-5));
}

TEST_CASE("contact lines: their length over the mesh period is that of the closed form") {
  const double beta = 20;
  for (const double overlap : {0.5, 1.0, 1.25}) {
    const GearPair pair = helical_pair(beta, width_of_overlap(overlap, beta));
    CHECK(pair.overlap_ratio() == relative(overlap, 1e-12));
    const double along = pair.face_width() / std::cos(pair.base_helix_angle()),
                 profile = pair.contact_ratio();
    for (int i = 0; i < 40; ++i) {
      const double phase = i / 40.0;
      // tau: base pitches from the corner in which a line comes in.
      const double tau = phase - pair.path_start() / pair.base_pitch() + 0.5 * overlap;
      double sum = 0;
      for (int j = -6; j <= 6; ++j)
        sum += std::max(0.0, std::min(tau + j, overlap) - std::max(0.0, tau + j - profile)) / overlap;
      CHECK(contact_line_length(pair, phase) == relative(along * sum, 1e-9));
    }
  }
}

TEST_CASE("contact lines: extremes of the length at a transverse contact ratio of 1.754673") {
  // A pair of P2000's rack, at the centre distance that has just this contact ratio; the whole length counts, not the helix.
  const double beta = 10, wanted = 1.754673;
  const auto pair_of = [&](double addendum, double overlap) {
    GearDesign a = helical_gear(50, 3e-3, beta, Hand::right, width_of_overlap(overlap, beta)),
               b = helical_gear(50, 3e-3, beta, Hand::left, width_of_overlap(overlap, beta));
    a.addendum = b.addendum = addendum;
    return GearPair(a, b, 50 * 3e-3 / std::cos(beta * kDegreeInRad));
  };
  double low = 0.9, high = 1.2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (pair_of(middle, 1).contact_ratio() < wanted ? low : high) = middle;
  }
  const auto extremes = [&](double overlap) {
    const GearPair pair = pair_of(low, overlap);
    double least = 1e9, most = 0;
    for (int i = 0; i < 20000; ++i) {
      const double length =
          contact_line_length(pair, i / 20000.0) * std::cos(pair.base_helix_angle()) / pair.face_width();
      least = std::min(least, length);
      most = std::max(most, length);
    }
    return std::array{least, most};
  };
  CHECK(extremes(0.5)[0] == relative(1.509346, 1e-6));
  CHECK(extremes(0.5)[1] == relative(2.0, 1e-6));
  CHECK(extremes(1)[0] == relative(wanted, 1e-9));
  CHECK(extremes(1)[1] == relative(wanted, 1e-9));
  CHECK(extremes(1.25)[0] == relative(1.607477, 1e-6));
  CHECK(extremes(1.25)[1] == relative(1.803738, 1e-6));
}

TEST_CASE("the other hand mirrors the contact lines in the middle of the face") {
  const GearPair right = helical_pair(15, 30e-3);
  const GearPair left(right.gear(1).design(), right.gear(0).design(), right.centre_distance());
  for (const double phase : {0.0, 0.3, 0.81}) {
    const auto a = contact_lines(right, phase), b = contact_lines(left, phase);
    REQUIRE(a.size() == b.size());
    for (size_t i = 0; i < a.size(); ++i) {
      CHECK(a[i].pair == b[i].pair);
      CHECK(a[i].from == relative(-b[i].to, 1e-12));
    }
  }
}

TEST_CASE("helices that do not mesh are refused with a remedy") {
  const GearDesign right = helical_gear(50, 3e-3, 20, Hand::right, 20e-3);
  GearDesign left = right;
  left.hand = Hand::left;
  const double distance = 50 * 3e-3 / std::cos(20 * kDegreeInRad);
  CHECK(refused([&] { GearPair(right, right, distance); }, Failure::input, {"hand", "\"left\""}));
  left.helix_angle = 21 * kDegreeInRad;
  CHECK(refused([&] { GearPair(right, left, distance); }, Failure::input, {20, 21, "helix_angle_deg"}));
}

TEST_CASE("lead modifications over the face") {
  LeadModification m;
  m.crowning = 8e-6;
  m.slope = 6e-6;
  const LeadDeviation lead(m, 20e-3);
  CHECK(lead.at(-10e-3) == relative(8e-6, 1e-12));
  CHECK(lead.at(0) == relative(3e-6, 1e-12));
  CHECK(lead.at(10e-3) == relative(14e-6, 1e-12));
  m = {};
  m.end_relief = 20e-6;
  m.end_relief_length = 1e-3;
  const LeadDeviation ends(m, 20e-3);
  CHECK(std::abs(ends.at(9e-3)) < 1e-18);
  CHECK(ends.at(-9.5e-3) == relative(10e-6, 1e-12));
  CHECK(ends.at(10e-3) == relative(20e-6, 1e-12));
  m.end_relief_length = 11e-3;
  CHECK(refused([&] { LeadDeviation(m, 20e-3); }, Failure::input, {"end_relief_length_mm", 11, 10}));
}

TEST_CASE("ISO 6336-1 method B of a helical pair: example 1 of ISO/TR 6336-30") {
  GearDesign a = helical_gear(17, 8e-3, 15.8, Hand::right, 100e-3),
             b = helical_gear(103, 8e-3, 15.8, Hand::left, 100e-3);
  a.profile_shift = 0.145;
  for (GearDesign* d : {&a, &b}) {
    d->addendum = 1;
    d->dedendum = 1.4;  // rack D
    d->rack_tip_radius = 0.39;
    d->bore_radius = 30e-3;
  }
  const Material steel{206e9, 0.3, 7830, false};
  const GearPair pair(a, b, 0.5);
  const IsoStiffness iso = iso_6336_stiffness(a, steel, b, steel, 9000, pair.contact_ratio());
  CHECK(iso.single * 1e-9 == relative(12.370, 5e-4));
  CHECK(iso.mesh * 1e-9 == relative(17.465, 2e-3));
  CHECK(iso.line_load * 0.1 == relative(127352, 1e-4));
}

TEST_CASE("first harmonic of the contact lines: by hand, and of their length over a mesh period") {
  // sinc(1.5) = -2 / (3 pi), sinc(0.5) = 2 / pi.
  CHECK(contact_line_harmonic(1.5, 0.5) == relative(8 / (3 * std::numbers::pi * std::numbers::pi), 1e-14));
  CHECK(contact_line_harmonic(1.5, 0) == relative(4 / (3 * std::numbers::pi), 1e-14));
  CHECK(contact_line_harmonic(1.5, 1) < 1e-15);
  CHECK(contact_line_harmonic(2, 0.3) < 1e-15);
  for (const double overlap : {0.25, 0.5, 1.3}) {
    const GearPair pair = helical_pair(20, width_of_overlap(overlap, 20));
    constexpr int kPhases = 4096;
    double mean = 0, cosine = 0, sine = 0;
    for (int i = 0; i < kPhases; ++i) {
      const double turn = 2 * std::numbers::pi * i / kPhases,
                   length = contact_line_length(pair, static_cast<double>(i) / kPhases);
      mean += length / kPhases;
      cosine += 2 * length * std::cos(turn) / kPhases;
      sine += 2 * length * std::sin(turn) / kPhases;
    }
    CHECK(std::hypot(cosine, sine) / mean ==
          relative(contact_line_harmonic(pair.contact_ratio(), pair.overlap_ratio()), 1e-5));
  }
}
