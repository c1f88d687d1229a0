// Closed formulas of ISO 6336 for strength and of losses, against published numbers and their own definitions.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "gear/iso6336_strength.h"
#include "gear/losses.h"
#include "internal_pair.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"

using namespace whine;

namespace {

// The FZG type C gears of a public calculation program: 16 and 24 teeth of module 4.5 mm.
GearDesign fzg_c(int teeth, double shift, double tip_diameter) {
  GearDesign d = paper_gear(teeth, 10e-3);
  d.module = 4.5e-3;
  d.profile_shift = shift;
  d.rack_tip_radius = 0.375;
  d.addendum = (tip_diameter / 2 - 0.5 * d.module * teeth) / d.module - shift;
  d.face_width = 14e-3;
  return d;
}

GearPair fzg_c_pair(double tip_1 = 82.636e-3, double tip_2 = 118.544e-3) {
  return GearPair(fzg_c(16, 0.1817, tip_1), fzg_c(24, 0.1715, tip_2), 91.5e-3);
}

// N: of 300 N m on the wheel at its working pitch radius, as the program has it: 54.898 mm of the centre distance by x1 + x2.
constexpr double kForce = 300 / 54.898e-3;

}  // namespace

TEST_CASE("ISO 6336-3 method B: form and stress correction factors of 16 and 24 teeth as published") {
  const GearPair pair = fzg_c_pair();
  CHECK(pair.contact_ratio() == relative(1.4625, 1e-4));
  const IsoRoot pinion = iso_6336_root(pair, 0), wheel = iso_6336_root(pair, 1);
  CHECK(pinion.form == relative(1.68863, 5e-6));
  CHECK(wheel.form == relative(1.58298, 5e-6));
  CHECK(pinion.stress_correction == relative(1.85146, 5e-6));
  CHECK(wheel.stress_correction == relative(1.91659, 5e-6));
  CHECK(iso_6336_root_stress(pair, 0, kForce) == relative(271.19e6, 5e-5));
  CHECK(iso_6336_root_stress(pair, 1, kForce) == relative(263.17e6, 5e-5));
  CHECK(pinion.in_range);
}

TEST_CASE("ISO 6336-2: nominal flank pressure of 16 and 24 teeth as published") {
  const Material steel{206e9, 0.3, 7850, true};
  CHECK(iso_6336_flank_pressure(fzg_c_pair(), {steel, steel}, kForce) == relative(1228.89e6, 2e-4));
}

TEST_CASE(
    "ISO 6336-3: the critical section lies on the tooth, its tangent at 30 degrees to the centre line") {
  for (const int g : {0, 1}) {
    const GearPair pair = fzg_c_pair();
    const ToothGeometry& tooth = pair.gear(g);
    const IsoRoot root = iso_6336_root(pair, g);
    double low = 0, high = tooth.root_corner();
    const auto tangent = [&](double t) {
      const Vec2 d = tooth.root_point(t + 1e-6) - tooth.root_point(t - 1e-6);
      return std::atan2(std::abs(d.x()), std::abs(d.y()));
    };
    for (int i = 0; i < 60; ++i) {
      const double t = 0.5 * (low + high);
      (tangent(t) < std::numbers::pi / 6 ? low : high) = t;
    }
    CHECK(2 * std::abs(tooth.root_point(low).x()) == relative(root.thickness, 1e-6));
  }
}

TEST_CASE("ISO 6336-3: thinning of the tooth by the tool enters the generating shift") {
  GearDesign thin = fzg_c(16, 0.1817, 82.636e-3), shifted = thin;
  thin.tooth_thinning = 0.1e-3;
  shifted.profile_shift -= 0.1e-3 / (2 * thin.module * std::tan(thin.pressure_angle));
  shifted.addendum += thin.profile_shift - shifted.profile_shift;
  const GearDesign wheel = fzg_c(24, 0.1715, 118.544e-3);
  const IsoRoot a = iso_6336_root(GearPair(thin, wheel, 91.5e-3), 0),
                b = iso_6336_root(GearPair(shifted, wheel, 91.5e-3), 0);
  CHECK(a.form == relative(b.form, 1e-12));
  CHECK(a.stress_correction == relative(b.stress_correction, 1e-12));
  CHECK(a.form > iso_6336_root(fzg_c_pair(), 0).form);
}

TEST_CASE("ISO 6336: an internal pair is rejected by its name") {
  const GearPair pair(planet_gear(), ring_gear(), kInternalDistance);
  CHECK(names(message_of([&] { iso_6336_root(pair, 0); }), {"internal"}));
}

TEST_CASE("ISO 6336: more than a module of a wider gear's overhang on either side carries nothing") {
  GearDesign wide = fzg_c(16, 0.1817, 82.636e-3), narrow = fzg_c(24, 0.1715, 118.544e-3);
  const double even = iso_6336_root_stress(GearPair(wide, narrow, 91.5e-3), 0, kForce);
  wide.face_width = narrow.face_width + 0.5 * wide.module;
  CHECK(iso_6336_root_stress(GearPair(wide, narrow, 91.5e-3), 0, kForce) ==
        relative(even * narrow.face_width / wide.face_width, 1e-12));
  wide.face_width = 3 * narrow.face_width;
  const GearPair pair(wide, narrow, 91.5e-3);
  CHECK(iso_6336_root_stress(pair, 0, kForce) ==
        relative(even * narrow.face_width / (narrow.face_width + 2 * wide.module), 1e-12));
  CHECK(iso_6336_root_stress(pair, 1, kForce) ==
        relative(iso_6336_root_stress(fzg_c_pair(), 1, kForce), 1e-12));
}

TEST_CASE("ISO 6336 and losses of rigid teeth: a contact ratio of 2 or more is rejected with its number") {
  GearDesign tall = paper_gear();
  tall.addendum = 1.35;
  tall.dedendum = 1.6;
  tall.rack_tip_radius = 0.2;
  const GearPair pair(tall, tall, 0.150);
  REQUIRE(pair.contact_ratio() > 2);
  const Material steel = paper_steel();
  CHECK(names(message_of([&] { iso_6336_root(pair, 0); }), {2, "contact"}));
  CHECK(names(message_of([&] { iso_6336_flank_pressure(pair, {steel, steel}, kForce); }), {2, "contact"}));
  CHECK(names(message_of([&] { loss_factor_of_rigid_teeth(pair); }), {2, "contact"}));
}

TEST_CASE("loss factor of rigid teeth: 16 and 24 teeth, the pair of the paper, and its definition") {
  CHECK(loss_factor_of_rigid_teeth(fzg_c_pair()) == relative(0.1986, 3e-4));
  const GearPair shorter = fzg_c_pair(82.46e-3, 118.36e-3);
  CHECK(shorter.contact_ratio() == relative(1.43754, 1e-5));
  CHECK(loss_factor_of_rigid_teeth(shorter) == relative(0.19496, 5e-5));
  const GearPair paper(paper_gear(), paper_gear(), 0.150);
  CHECK(loss_factor_of_rigid_teeth(paper) == relative(0.0986, 1e-3));
  // The definition: pairs in contact share the force T / r_b evenly, whichever of the two drives.
  constexpr int kSamples = 20000;
  const Eigen::VectorXd phase = Eigen::VectorXd::LinSpaced(kSamples, 0.5 / kSamples, 1 - 0.5 / kSamples);
  const Eigen::VectorXi number = Eigen::VectorXi::LinSpaced(3, -1, 1);
  const GearPair swapped(fzg_c(24, 0.1715, 118.544e-3), fzg_c(16, 0.1817, 82.636e-3), 91.5e-3);
  for (const GearPair& pair : {paper, fzg_c_pair(), swapped}) {
    MatrixRM load = MatrixRM::Zero(kSamples, 3);
    for (int i = 0; i < kSamples; ++i) {
      for (int k = 0; k < 3; ++k) {
        const double path = (phase[i] + number[k]) * pair.base_pitch();
        load(i, k) = path > pair.path_start() && path < pair.path_end() ? 1 : 0;
      }
      load.row(i) *= 150 / pair.gear(0).base_radius() / load.row(i).sum();
    }
    CHECK(loss_factor(pair, number, phase, load, 150) == relative(loss_factor_of_rigid_teeth(pair), 1e-4));
    CHECK(loss_factor(pair, number, phase, 2 * load, 300) ==
          relative(loss_factor(pair, number, phase, load, 150), 1e-12));
  }
}
