// The five lines that open a report, from numbers that are given; the same numbers from content.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "base/format.h"
#include "refusal.h"
#include "report/opening.h"
#include "report/speed_words.h"

using namespace whine;

namespace {

const TurningMember kPinion{"pinion", 1.0 / 50};  // 60 / 50 = 1.2 rpm for 1 Hz

}  // namespace

TEST_CASE("speeds: rpm of a gear beside Hz, ranges of what is marked, Hz alone where no rotation is known") {
  CHECK(speed_words(kPinion, 2640) == "3168 rpm (2640 Hz)");
  CHECK(speed_words(TurningMember{"ring", 0}, 2640) == "2640 Hz");
  CHECK(speed_words(kPinion, {{1000, 2640}, {3000, 3000}}) ==
        "1200 to 3168 rpm (1000 to 2640 Hz) and 3600 rpm (3000 Hz)");
  const auto ranges = marked_ranges({{1000, false}, {1100, true}, {1200, true}, {1300, false}, {1400, true}});
  REQUIRE(ranges.size() == 2);
  CHECK(ranges[0].from == 1100);
  CHECK(ranges[0].to == 1200);
  CHECK(ranges[1].from == 1400);
  CHECK(ranges[1].to == 1400);
  CHECK(marked_ranges({}).empty());
  const auto left =
      marked_ranges(but_not({{1000, true}, {1100, true}, {1200, true}}, {{1100, true}, {1200, false}}));
  REQUIRE(left.size() == 2);
  CHECK(left[1].from == 1200);
  // Of many ranges the widest four, in their order.
  CHECK(speed_words(kPinion, {{100, 100}, {200, 300}, {400, 500}, {600, 700}, {800, 900}, {950, 951}}) ==
        "240 to 360 rpm (200 to 300 Hz), 480 to 600 rpm (400 to 500 Hz), 720 to 840 rpm (600 to 700 Hz), "
        "960 to 1080 rpm (800 to 900 Hz) and 2 narrower ranges");
}

TEST_CASE("speeds in words get their rotation once, whatever the list") {
  const auto with = [](const std::string& words) { return with_rpm(kPinion, words); };
  CHECK(with("jumps at 1000 Hz.") == "jumps at 1000 Hz (1200 rpm).");
  CHECK(with("f_n = 2900.5 Hz: 1000, 1100 to 1200 and 1500 Hz") ==
        "f_n = 2900.5 Hz (3481 rpm): 1000, 1100 to 1200 and 1500 Hz (1200, 1320 to 1440 and 1800 rpm)");
  CHECK(with("3168 rpm (2640 Hz)") == "3168 rpm (2640 Hz)");
  CHECK(with("2645 ± 0.4 Hz") == "2645 ± 0.4 Hz (3174 rpm)");
  CHECK(with("mesh_frequency_Hz, gear7 Hz") == "mesh_frequency_Hz, gear7 Hz");
  CHECK(with_rpm(TurningMember{}, "1000 Hz") == "1000 Hz");
}

TEST_CASE("excitation: peak to peak and first order, of meshes that are alike the least and the largest") {
  CHECK(excitation_line("150 N m", {{"", {2.743e-6, 2.743e-6}, {0.9041e-6, 0.9041e-6}}}) ==
        "At 150 N m the transmission error swings from peak to peak by 2.74 µm (first order 0.904 µm).");
  CHECK(
      excitation_line("400 N m on sun", {{"sun-planet", {2e-6, 2.5e-6}, {1e-6, 1e-6}},
                                         {"planet-ring", {3e-6, 3e-6}, {0.5e-6, 0.75e-6}}}) ==
      "At 400 N m on sun the transmission error swings from peak to peak by 2.00 to 2.50 µm of sun-planet (first order "
      "1.00 µm) and 3.00 µm of planet-ring (first order 0.500 to 0.750 µm).");
  CHECK(contains(excitation_line("", {}), "rigid"));
}

TEST_CASE("numbers with errors: no digit more than the error allows, errors rounded up") {
  const auto words = [](double value, double error) { return told(value, error, 6).words(); };
  CHECK(words(369.977, 0.0131) == "369.977 ± 0.014");
  CHECK(words(369.977, 0.13) == "369.98 ± 0.13");
  CHECK(words(369.977, 0.131) == "369.98 ± 0.14");
  CHECK(words(369.977, 0.26) == "370.0 ± 0.3");
  CHECK(words(369.977, 0.197) == "370.0 ± 0.2");
  CHECK(words(1234, 87) == "1230 ± 90");
  CHECK(words(1234, 130) == "1230 ± 130");
  CHECK(words(0.0123, 0.5) == "0.0 ± 0.5");
  CHECK(words(2.5, 1e-9) == "2.50000 ± 0.00001");
  CHECK(words(2.5, 0) == "2.50000 ± 0.00001");
  CHECK(words(-4.56, 0.1) == "-4.56 ± 0.10");
  CHECK(words(0, 0.02) == "0.00 ± 0.02");
  CHECK(words(2.5, -1) == "2.50000");
  CHECK(words(2.5, std::nan("")) == "2.50000");
  CHECK(
      excitation_line("150 N m", {{"", {2.743e-6, 2.743e-6, 0.004e-6}, {0.9041e-6, 0.9041e-6}}}) ==
      "At 150 N m the transmission error swings from peak to peak by 2.743 ± 0.004 µm (first order 0.904 µm).");
}

TEST_CASE(
    "critical speeds: orders 1 to 3 where they lie within the speeds, and the peaks that are computed") {
  CriticalSpeeds c{kPinion, SpeedRange{1000, 3000}, {{2900, "the natural frequency"}}, {1400, 2640}};
  CHECK(
      critical_speed_line(c) ==
      "The natural frequency (2900 Hz) is met by order 1 at 3480 rpm (2900 Hz) and order 2 at 1740 rpm (1450 Hz); the "
      "computed vibration peaks at 1680 rpm (1400 Hz) and 3168 rpm (2640 Hz). Speeds are those of pinion.");
  c.speeds = SpeedRange{4000, 5000};
  c.peaks.clear();
  CHECK(
      critical_speed_line(c) ==
      "No order up to 3 meets the natural frequency (2900 Hz) within 4800 to 6000 rpm (4000 to 5000 Hz); the computed "
      "vibration has no peak within the speeds. Speeds are those of pinion.");
  // At rest all three orders; without rotation Hz.
  c.speeds.reset();
  c.member.turns = 0;
  CHECK(
      critical_speed_line(c) ==
      "The natural frequency (2900 Hz) is met by order 1 at 2900 Hz, order 2 at 1450 Hz and order 3 at 967 Hz.");
  c.natural.clear();
  CHECK(contains(critical_speed_line(c), "No natural frequency"));
}

TEST_CASE("contact: which way teeth part, whether a drive from rest gets there, by a jump or not") {
  Parting p;
  p.member = kPinion;
  CHECK(contains(parting_line(p), "not known"));
  p.speeds = SpeedRange{1000, 4000};
  p.rising.emplace();
  p.falling.emplace();
  CHECK(parting_line(p) ==
        "From 1200 to 4800 rpm (1000 to 4000 Hz) teeth do not part, with speed rising or falling.");
  p.falling->apart = p.only_falling = {{2200, 2600}};
  CHECK(
      parting_line(p) ==
      "From 1200 to 4800 rpm (1000 to 4000 Hz) teeth part: with speed falling at 2640 to 3120 rpm (2200 to 2600 Hz). A "
      "drive that starts from rest keeps contact; one that comes from a higher speed does not.");
  p.rising->apart = {{2600, 3000}};
  p.rising->jumps = {2590};
  p.falling->apart = {{2200, 3000}};
  p.only_falling = {{2200, 2550}};
  p.parts_at = {"100 N m"};
  p.holds_at = {"300 N m"};
  CHECK(
      parting_line(p) ==
      "From 1200 to 4800 rpm (1000 to 4000 Hz) teeth part: with speed rising at 3120 to 3600 rpm (2600 to 3000 Hz); "
      "with speed falling at 2640 to 3600 rpm (2200 to 3000 Hz). A drive that starts from rest gets there at 3120 rpm "
      "(2600 Hz), by a jump; at 2640 to 3060 rpm (2200 to 2550 Hz) only one that comes from a higher speed does. At 100 "
      "N m teeth part, too. At 300 N m they do not.");
  p.rising->jumps = {1000};
  CHECK(!contains(parting_line(p), "by a jump"));
  p.falling.reset();
  p.rising->apart.clear();
  CHECK(contains(parting_line(p), "teeth do not part, with speed rising."));
}

TEST_CASE("dynamic factor: beside K_v, or why there is none") {
  CHECK(
      dynamic_factor_line(kPinion, {{"", 3.849, 2200, 1.897}}, "") ==
      "The mesh force reaches 3.85 times its mean at rest, at 2640 rpm (2200 Hz), where K_v of ISO 6336-1 (method B, "
      "gears without deviations) is 1.90.");
  CHECK(
      dynamic_factor_line(kPinion, {{"a-b", 1.5, 1000, {}}, {"b-c", 1.25, 2000, {}}},
                          "its formulas are of one mesh") ==
      "The mesh force reaches 1.50 times its mean at rest in a-b, at 1200 rpm (1000 Hz) and 1.25 times its mean at rest in "
      "b-c, at 2400 rpm (2000 Hz). K_v of ISO 6336-1 has no value here: its formulas are of one mesh.");
  CHECK(contains(dynamic_factor_line(kPinion, {}, ""), "No motion is computed"));
}

TEST_CASE("what to change: relief of tips that carry, speeds to keep out of, damping and stiffness") {
  Advice a;
  a.member = kPinion;
  CHECK(advice_line(a) ==
        "Nothing stands out: no tip edge carries load, and the vibration has no peak within the speeds.");
  a.moves = false;
  CHECK(advice_line(a) == "Nothing stands out: no tip edge carries load. No motion is computed.");
  a.edges = false;
  CHECK(advice_line(a) == "Nothing stands out. No motion is computed.");
  a.avoid = {{2200, 2600}};
  CHECK(
      advice_line(a) ==
      "Keep the speed of pinion out of 2640 to 3120 rpm (2200 to 2600 Hz), where the vibration is largest.");
  a.relief = {{"both gears", 7.4e-6, 881.2}};
  a.parts = true;
  a.stiffness_swing = 0.153;
  a.damping_ratio = 0.0573;
  CHECK(
      advice_line(a) ==
      "Relieve the tips of both gears by about 7 µm, the deflection under this load: their edges carry up to 881 N. Keep "
      "the speed of pinion out of 2640 to 3120 rpm (2200 to 2600 Hz), where teeth part. Contact is lost where the first "
      "harmonic of the mesh stiffness over its mean, 15.3 %, is above about 1.7 times the damping ratio, 9.7 % here: lower "
      "the one by relief, contact ratio or torque, or raise the other.");
  CHECK(contains(opening_html({"a < b", "c"}, "<figure>"), "<strong>Excitation.</strong> a &lt; b</li>"));
}
