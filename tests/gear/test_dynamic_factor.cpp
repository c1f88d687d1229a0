// The dynamic factor of ISO 6336-1 against its formulas, by hand.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "gear/dynamic_factor.h"
#include "refusal.h"
#include "relative.h"

using namespace whine;

TEST_CASE("ISO 6336-1 method B: the dynamic factor of each range of speed, by hand") {
  // c' = 14e9, F_t / b = 200e3 N/m: 7 % per micrometre
  IsoDynamics gears{1.6, 200e3, 14e9, 2e-6, 3e-6, 0};
  const double pitch = 0.14, profile = 0.21;
  CHECK(iso_6336_dynamic_factor(gears, 0) == 1);
  CHECK(iso_6336_dynamic_factor(gears, 0.5) ==
        relative(1 + 0.5 * (0.32 * pitch + 0.34 * profile + 0.23), 1e-12));
  CHECK(iso_6336_dynamic_factor(gears, 1) == relative(1 + 0.32 * pitch + 0.34 * profile + 0.9, 1e-12));
  const double beyond = 0.47 * (pitch + profile) + 0.125 * std::sin(std::numbers::pi * -0.4) + 0.875;
  CHECK(iso_6336_dynamic_factor(gears, 2) == relative(beyond, 1e-12));
  // continuous where the ranges of its last three formulas meet
  CHECK(iso_6336_dynamic_factor(gears, 1.15 + 1e-12) ==
        relative(iso_6336_dynamic_factor(gears, 1.15), 1e-10));
  CHECK(iso_6336_dynamic_factor(gears, 1.5 - 1e-12) == relative(beyond, 1e-10));
  gears.relief = 200e3 / 14e9;  // takes up the deflection
  CHECK(iso_6336_dynamic_factor(gears, 1) == relative(1 + 0.32 * pitch + 0.34 * profile, 1e-12));
  // the wider resonance of little load: N_S = 0.5 + 0.35 / 2
  gears.line_load = 25e3;
  CHECK(iso_6336_dynamic_factor(gears, 0.67) < iso_6336_dynamic_factor(gears, 0.68));
  gears.contact_ratio = 0.9;
  CHECK(names(message_of([&] { iso_6336_dynamic_factor(gears, 1); }), {0.9, 1, "contact"}));
}
