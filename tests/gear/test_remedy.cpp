// What a drawing is told: one remedy that all checks accept, the sign of a ring's shift, a rack tip that fits, contacts that come too
// near to the root.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "gear/handbook_sign.h"
#include "gear/pair.h"
#include "gear/rack_tip.h"
#include "gear/remedy.h"
#include "gear/scene_geometry.h"
#include "gear/system_layout.h"
#include "internal_pair.h"
#include "planetary_train.h"
#include "refusal.h"
#include "relative.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "system/near_interference.h"
#include "system/statics.h"

using namespace whine;

namespace {

constexpr double kDegree = std::numbers::pi / 180, kModule = 2.5e-3;

GearDesign gear(int teeth, double shift = 0, double dedendum = 1.25, double angle_deg = 20) {
  GearDesign d;
  d.teeth = teeth;
  d.module = kModule;
  d.pressure_angle = angle_deg * kDegree;
  d.profile_shift = shift;
  d.dedendum = dedendum;
  d.face_width = 20e-3;
  d.bore_radius = 0.2 * kModule * teeth;
  d.rack_tip_radius = default_rack_tip_radius(d);
  return d;
}

DrawnGears pair_of(const GearDesign& a, const GearDesign& b) {
  DrawnGears out;
  out.name = {"pinion", "wheel"};
  out.design = {a, b};
  out.mesh = {{0, 1, 0.5 * kModule * (b.internal ? b.teeth - a.teeth : a.teeth + b.teeth)}};
  return out;
}

GearDesign ring_of(int teeth, double shift) {
  GearDesign d = gear(teeth, shift);
  d.internal = true;
  d.addendum = 0.8;
  d.bore_radius = 0;
  d.rim_outer_radius = kModule * (0.5 * teeth + 5);
  d.rack_tip_radius = default_rack_tip_radius(d);
  return d;
}

}  // namespace

TEST_CASE("the remedy of a drawing that is rejected, followed once, ends in gears that mesh") {
  int faults = 0;
  const auto follow = [&](DrawnGears gears) {
    const std::string before = fault(gears);
    if (before.empty()) return;
    ++faults;
    INFO(before);
    const std::vector<Change> changes = remedy(gears);
    REQUIRE(!changes.empty());
    CHECK(changes.size() <= 4);
    const std::string said = with_remedy(before, gears);
    CHECK(names(said, {"checks", "pass"}));
    CHECK(contains(said, changes[0].key));
    CHECK(!contains(said, "raise "));  // no advice beside it
    change(gears, changes);
    CHECK(fault(gears).empty());
  };
  for (const int teeth : {8, 14, 30})
    for (const double shift : {-0.5, 0.0, 0.8})
      for (const double dedendum : {1.0, 1.4}) follow(pair_of(gear(teeth, shift, dedendum), gear(40)));
  for (const double angle : {14.5, 25.0}) follow(pair_of(gear(12, 0, 1.25, angle), gear(60, 0, 1.0, angle)));
  for (const double addendum : {0.3, 2.5}) {
    DrawnGears odd = pair_of(gear(30), gear(45));
    odd.design[1].addendum = addendum;
    follow(odd);
  }
  DrawnGears bored = pair_of(gear(30), gear(45));
  bored.design[0].bore_radius = 40e-3;
  follow(bored);
  for (const double distance : {-2.0, 1.0, 2.2}) {
    DrawnGears apart = pair_of(gear(30), gear(45));
    apart.mesh[0].centre_distance += distance * kModule;
    follow(apart);
  }
  for (const int teeth : {40, 50}) follow(pair_of(gear(20), ring_of(teeth, 0.2)));
  CHECK(faults >= 6);
  // What no such number mends keeps its own words.
  DrawnGears other = pair_of(gear(30), gear(45));
  other.design[1].module *= 1.01;
  CHECK(remedy(other).empty());
  CHECK(with_remedy("a; b", other) == "a; b");
  CHECK(remedy(pair_of(gear(30), gear(45))).empty());
}

TEST_CASE("a remedy changes what is wrong: bores, low dedenda, undercut gears") {
  const auto said = [](const DrawnGears& gears) { return with_remedy(fault(gears), gears); };
  DrawnGears bored = pair_of(gear(30), gear(45));
  bored.design[0].bore_radius = 36e-3;  // root 34.375
  CHECK(names(said(bored), {"bore_radius_mm", "31.87", "[gear.pinion]", 36}));
  DrawnGears thin = pair_of(gear(20), ring_of(60, 0));
  thin.design[1].rim_outer_radius = ToothGeometry(thin.design[1]).root_radius() - 1e-3;
  const std::vector<Change> rim = remedy(thin);
  REQUIRE(rim.size() == 1);
  CHECK(rim[0].value - ToothGeometry(ring_of(60, 0)).root_radius() == relative(kModule, 1e-2));

  DrawnGears low = pair_of(gear(30, 0, 1), gear(45, 0, 1));
  for (GearDesign& own : low.design) own.rack_tip_radius = 0.2;
  low.mesh[0].centre_distance -= 1e-15;  // the round-off of other numbers
  CHECK(names(fault(low), {"clearance", "root"}));
  CHECK(names(said(low), {"1.25", "[gear.pinion]", "root_diameter_mm", "68.75", "[gear.wheel]"}));

  const DrawnGears small = pair_of(gear(10), gear(10));
  REQUIRE(!fault(small).empty());
  const std::vector<Change> shifts = remedy(small);
  REQUIRE(shifts.size() >= 2);
  for (size_t g = 0; g < 2; ++g) {
    CHECK(shifts[g].member == &GearDesign::profile_shift);
    CHECK(shifts[g].value > 0);
  }
}

TEST_CASE(
    "more backlash than drawings have is warned of, with the shift of the other sign where it is ordinary") {
  const auto where = [](const std::vector<std::string>& sections, const std::string&) {
    return "x.toml: " + sections.front();
  };
  const auto said = [&](const GearDesign& a, const GearDesign& b, double distance) {
    Scene scene;
    scene.gears.resize(2);
    scene.gears[0].name = "pinion";
    scene.gears[1].name = "wheel";
    scene.gears[0].design = a;
    scene.gears[1].design = b;
    scene.meshes.resize(1);
    scene.meshes[0].spec.gear = {"pinion", "wheel"};
    scene.meshes[0].spec.centre_distance = distance;
    std::string out;
    for (const std::string& line : scene_warnings(scene, where))
      if (contains(line, "backlash")) out += line;
    return out;
  };
  const std::string wrong = said(gear(17, -0.4), gear(60), 97.2e-3);
  CHECK(wrong.find("x.toml: gear.pinion: the backlash of pinion-wheel is 1.3") == 0);
  CHECK(names(wrong, {"profile_shift", "0.4", "[gear.pinion]", "-0.0107881"}));
  CHECK(said(gear(17, 0.4), gear(60), 97.23e-3).empty());
  // One that is not of a sign.
  GearDesign thinned = gear(30);
  thinned.tooth_thinning = 0.3e-3;
  CHECK(names(said(thinned, thinned, 30 * kModule),
              {"centre_distance_mm", "profile_shift", "tooth_thinning_mm"}));
  thinned.tooth_thinning = 0.1e-3;
  CHECK(said(thinned, thinned, 30 * kModule).empty());
  CHECK(names(said(gear(20), ring_of(60, -0.5), 20 * kModule), {"0.34202", "modules"}));
}

TEST_CASE("a ring whose shift has the sign of handbooks is told so, one with the sign of ISO 21771 is not") {
  const double distance = 0.5 * kModule * 40;
  for (const double shift : {0.3, -0.2}) {
    // One shift against the other: no backlash at the reference centre distance.
    const GearDesign pinion = gear(30, shift), right = ring_of(70, -shift), wrong = ring_of(70, shift);
    CHECK(std::abs(GearPair(pinion, right, distance).backlash()) < 1e-12);
    CHECK(!shift_of_other_sign(pinion, right, distance));
    REQUIRE(shift_of_other_sign(pinion, wrong, distance));
    CHECK(*shift_of_other_sign(pinion, wrong, distance) == -shift);
    CHECK(shift_of_other_sign(wrong, pinion, distance).value() == -shift);
    // By its diameters, which stay.
    GearDesign drawn = right;
    drawn.profile_shift = shift;
    drawn.addendum -= 2 * shift;
    drawn.dedendum += 2 * shift;
    CHECK(shift_of_other_sign(pinion, drawn, distance).value() == -shift);
  }
  const DrawnGears jammed = pair_of(gear(20, 0.3), ring_of(60, 0.3));
  CHECK(names(with_remedy(fault(jammed), jammed), {"profile_shift", "-0.3"}));
  CHECK(!shift_of_other_sign(gear(20, 0.3), gear(60, 0.3), 0.1));
  CHECK(!shift_of_other_sign(planet_gear(), ring_gear(), kInternalDistance));
}

TEST_CASE("the default rack tip is the standard one or the largest that fits, of racks and of rings") {
  CHECK(gear(30).rack_tip_radius == 0.38);
  CHECK(gear(30, 0, 1.25, 25).rack_tip_radius == 0.317);
  CHECK(largest_rack_tip_radius(gear(30, 0, 1.25, 25)) == relative(0.31788, 1e-4));
  for (const int teeth : {30, 60, 100})
    for (const double angle : {20.0, 22.5, 25.0}) {
      GearDesign ring = ring_of(teeth, 0);
      ring.pressure_angle = angle * kDegree;
      const double largest = largest_rack_tip_radius(ring);
      CHECK(default_rack_tip_radius(ring) == std::min(0.38, std::floor(1000 * largest) / 1000));
      ring.rack_tip_radius = largest * (1 - 1e-9);
      CHECK_NOTHROW(ToothGeometry{ring});
      ring.rack_tip_radius = largest * (1 + 1e-9);
      CHECK(names(message_of_input([&] { ToothGeometry{ring}; }), {"space", "fit"}));
    }
}

TEST_CASE("what the drawing says of pressure that reaches the root is what statics find") {
  SceneGear pinion, wheel;
  pinion.name = "pinion";
  wheel.name = "wheel";
  pinion.design = gear(20, 0, 1.4);
  wheel.design = gear(60);
  for (SceneGear* own : {&pinion, &wheel}) {
    own->design.module = 3e-3;
    own->design.face_width = 24e-3;
    own->design.bore_radius = 0.25 * own->design.module * own->design.teeth;
    own->material = {207e9, 0.3, 7850, true};
  }
  StaticParameters settings;
  settings.mesh.gear = {"pinion", "wheel"};
  settings.mesh.centre_distance = 120e-3;
  settings.mesh.contact_plane = ContactPlane::strain;
  settings.contact.positions = 64;
  BodyDiscretisation coarse;
  coarse.element_size = 0.8e-3;
  coarse.modes = 5;
  const auto body = [&](const SceneGear& own) {
    return reduce(make_sector_mesh(own.design, coarse), own.material, coarse.modes);
  };
  const ReducedBody of_pinion = body(pinion);
  const double torque = 200, load = torque / ToothGeometry(pinion.design).base_radius();
  const auto told = [&](ForceBound force) {
    return near_interference(pinion, wheel, settings.mesh, load, force);
  };
  const auto found = [&]() -> std::string {
    return message_of([&] { static_transmission(of_pinion, body(wheel), settings, torque); });
  };
  wheel.design.addendum = 1.2;
  CHECK(contains(told(ForceBound::least), "reaches the start of the involute of 'pinion'"));
  CHECK(contains(found(), "the pressure reaches the start of the involute of 'pinion'"));
  // What touches is the common width.
  SceneGear wide = pinion;
  wide.design.face_width *= 2;
  for (const ForceBound force : {ForceBound::least, ForceBound::largest})
    CHECK(near_interference(wide, wheel, settings.mesh, load, force) == told(force));
  // Its remedy passes all the way.
  CHECK(contains(told(ForceBound::least), "; addendum = 1.05 in [gear.wheel] is short enough"));
  wheel.design.addendum = 1.05;
  CHECK(told(ForceBound::largest).empty());
  CHECK(found().empty());
  // Between the bounds the drawing alone cannot tell.
  wheel.design.addendum = 1.12;
  CHECK(told(ForceBound::least).empty());
  CHECK(!told(ForceBound::largest).empty());
  // Teeth of polymer bend away: statics of this pair run up to 6 N m and further.
  pinion.design = gear(25);
  wheel.design = gear(60);
  for (SceneGear* own : {&pinion, &wheel}) {
    own->design.module = 1e-3;
    own->design.face_width = 10e-3;
    own->design.bore_radius = 0.25 * own->design.module * own->design.teeth;
  }
  wheel.material = {2.8e9, 0.37, 1410, true};
  settings.mesh.centre_distance = 42.5e-3;
  for (const double torque_of_pom : {1.0, 2.0, 6.0})
    CHECK(near_interference(pinion, wheel, settings.mesh,
                            torque_of_pom / ToothGeometry(pinion.design).base_radius(), ForceBound::least)
              .empty());
}

TEST_CASE("gears that share a shaft are told that this is not computed, others to follow the flow of power") {
  Scene scene;
  for (const char* name : {"a", "b", "c", "d"}) {
    SceneGear own;
    own.name = name;
    own.design = gear(30);
    scene.gears.push_back(own);
  }
  const auto mesh = [&](const char* driver, const char* driven) {
    Scene::Mesh out;
    out.spec.gear = {driver, driven};
    out.spec.centre_distance = 30 * kModule;
    scene.meshes.push_back(out);
  };
  const auto said = [&] { return message_of_input([&] { layout_of(scene); }); };
  mesh("a", "b");
  mesh("c", "d");
  CHECK(names(said(), {"[[mesh]]", "c", "d", "'a'"}));
  mesh("b", "c");
  CHECK(names(said(), {"gears", "order"}));
}

TEST_CASE("a mesh phase of 0 is 0, not 1, whatever round-off the angles have") {
  for (const int planets : {3, 4, 5}) {
    const System train = layout_of(planetary_train(planets));
    // Teeth of sun and ring are multiples of the planets' number: all planets are in phase with the first.
    for (const System::Mesh& mesh : train.meshes) {
      CHECK(mesh.phase >= 0);
      CHECK(mesh.phase < 1 - 1e-9);
    }
  }
}
