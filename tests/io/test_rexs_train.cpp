// Planetary stages of REXS models: the system that they give, single meshes of them, what they do not say, what cannot be a scene.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "gear/pair.h"
#include "gear/scene_geometry.h"
#include "gear/system_layout.h"
#include "io/scene.h"
#include "refusal.h"
#include "relative.h"
#include "rexs_models.h"
#include "system/load_balance.h"
#include "system/system_rest.h"

using namespace whine;

namespace {

RexsScene scene_in(const Folder& folder, const Gearbox& box, const std::string& stage = "") {
  return scene_of_rexs(read_rexs(folder.file("model.rexs", xml(box))), stage, 1);
}

struct Train {
  RexsScene text;
  Scene scene;
  System layout;

  const Scene::Drive& drive(const std::string& gear) const {
    for (const Scene::Drive& d : scene.drives)
      if (d.gear == gear) return d;
    FAIL("no drive of ", gear);
    return scene.drives[0];
  }
};

Train train_in(const Folder& folder, const Gearbox& box) {
  Train out{scene_in(folder, box), {}, {}};
  const std::string path = folder.file("train.toml", out.text.text);
  out.scene = read_scene(path);
  out.layout = layout_in(out.scene, path);
  check_at_rest_in(out.scene, out.layout, path);
  return out;
}

std::string said(const Folder& folder, const Gearbox& box, const std::string& stage = "") {
  return message_of_input([&] { scene_in(folder, box, stage); });
}

void remove_links(Gearbox& box, const std::string& type) {
  std::erase_if(box.links, [&](const Link& link) { return link.type == type; });
}

void place(Gearbox& box, int id, double v, double w) {
  set(box, id, "support_vector", "mm",
      "<array><c>12</c><c>" + std::to_string(v) + "</c><c>" + std::to_string(w) + "</c></array>");
}

}  // namespace

TEST_CASE(
    "REXS: a planetary stage gives a system with its torques, its held ring and the mesh frequency against the carrier") {
  const Folder folder;
  const Gearbox box = planetary();
  const Train train = train_in(folder, box);
  CHECK(train.text.text == scene_of_rexs(read_rexs(folder.file("model.rexsj", json(box))), "9", 1).text);
  CHECK(train.text.stage == "planetary_stage 9 'Planetary stage'");
  REQUIRE(train.scene.gears.size() == 3);
  CHECK(train.scene.gears[0].design.teeth == 20);
  CHECK(train.scene.gears[1].design.teeth == 28);
  CHECK(train.scene.gears[2].design.teeth == 76);
  CHECK(train.scene.gears[2].design.internal);
  REQUIRE(train.scene.carriers.size() == 1);
  CHECK(train.scene.carriers[0].planets == 3);
  CHECK(train.drive("sun").torque == 300);
  CHECK(train.drive("ring").kind == System::DriveKind::held);
  CHECK(train.drive("carrier").torque == relative(-300 * 96.0 / 20, 1e-12));
  CHECK(contains(train.text.text, "about 395.833 Hz"));
  CHECK(contains(train.text.text, "carrier 312.5 1/min"));
  CHECK(contains(train.text.text, "# of it 100 N m in each of 3 meshes"));
  CHECK(train.scene.operation.frequency_from == 80);
  CHECK(train.scene.operation.frequency_to == 594);
  // All six meshes carry one force, a third of the sun's torque over its base radius.
  const double base = 25e-3 * std::cos(std::numbers::pi / 9);
  for (const double load : load_balance(train.layout).load) CHECK(load == relative(100 / base, 1e-9));
  // The coupling that is not engaged holds nothing: the ring is then assumed to be held.
  Gearbox open = box;
  set(open, 8, "is_engaged", "", "false");
  CHECK(says(train_in(folder, open).text.assumed, "drive.ring.kind = \"held\": the model holds none"));
  CHECK(!says(train.text.assumed, "drive."));
}

TEST_CASE(
    "REXS: torques and mesh frequency of a planetary stage whichever member is held and whichever drives") {
  const Folder folder;
  // Torques 300 N m of the sun : 1140 of the ring : 1440 of the carrier; speeds of the input of 960 1/min.
  struct Case {
    int held, input;    // shafts: 40 of the sun, 41 of the ring, 42 of the carrier
    const char* first;  // that drives in the frame of the carrier
    double input_torque, output_torque, frequency;
  };
  for (const Case& c :
       {Case{41, 40, "sun", 300, -1440, 960.0 / 60 * 20 * 76 / 96},
        Case{41, 42, "ring", 1440, -300, 960.0 / 60 * 76},
        Case{40, 41, "ring", 1140, -1440, 960.0 / 60 * 20 * 76 / 96},
        Case{40, 42, "sun", 1440, -1140, 960.0 / 60 * 20}, Case{42, 40, "sun", 300, -1140, 960.0 / 60 * 20},
        Case{42, 41, "ring", 1140, -300, 960.0 / 60 * 76}}) {
    CAPTURE(c.held);
    CAPTURE(c.input);
    for (const bool power : {false, true}) {
      Gearbox box = planetary();
      unset(box, 40, "rotational_speed");
      unset(box, 7, "torque_around_u_axis");
      for (Link& link : box.links)
        for (auto& [role, id] : link.refs) {
          if (link.type == "side" && role == "inner_part") id = c.held;
          if (link.type == "assembly" && role == "assembly" && link.refs[1].second == 7) id = c.input;
        }
      set(box, c.input, "rotational_speed", "1 / min", "-960");
      if (power)
        set(box, 7, "power", "kW", std::to_string(c.input_torque * 960 * 2 * std::numbers::pi / 60 * 1e-3));
      else
        set(box, 7, "torque_around_u_axis", "N m", std::to_string(-c.input_torque));
      const Train train = train_in(folder, box);
      const std::string frequency = train.text.text.substr(train.text.text.find("# about ") + 8, 12);
      CHECK(std::stod(frequency) == relative(c.frequency, 1e-5));
      CHECK(train.scene.meshes[0].spec.gear[0] == c.first);
      CHECK(!says(train.text.assumed, "drive."));
      const std::string member[] = {"sun", "ring", "carrier"};
      const int output = 40 + 41 + 42 - c.held - c.input;
      // In the frame of the carrier a torque has the sense of its body there: the first driver's alone is above 0.
      const auto torque = [&](int shaft, double size) {
        return member[shaft - 40] == c.first ? std::abs(size) : -std::abs(size);
      };
      CHECK(train.drive(member[c.held - 40]).kind == System::DriveKind::held);
      CHECK(train.drive(member[c.input - 40]).torque == relative(torque(c.input, c.input_torque), 1e-5));
      CHECK(train.drive(member[output - 40]).torque == relative(torque(output, c.output_torque), 1e-5));
      const double base = 25e-3 * std::cos(std::numbers::pi / 9);
      for (const double load : load_balance(train.layout).load) CHECK(load == relative(100 / base, 1e-5));
    }
  }
}

TEST_CASE(
    "REXS: a single mesh of a planetary stage has its share of the torque and its speed against the carrier") {
  const Folder folder;
  struct Case {
    const char *stage, *driver;
    double torque;
  };
  for (const Case& c : {Case{"Sun 1", "sun", 100}, Case{"Ring 2", "planet_2", 140}}) {
    CAPTURE(c.stage);
    const RexsScene text = scene_in(folder, planetary(), c.stage);
    const Scene scene = read_scene(folder.file("mesh.toml", text.text));
    check_geometry(scene, [](const auto&, const auto&) { return std::string(); });
    CHECK(scene.mesh().gear[0] == c.driver);
    CHECK(scene.operation.torques == std::vector<double>{c.torque});
    CHECK(scene.operation.frequency_to == 594);
    CHECK(says(text.assumed, "of 3 planets that share 300 N m on the sun equally one"));
    CHECK(contains(text.text, "about 395.833 Hz: against the carrier"));
    CHECK(contains(text.text, "# One mesh of planetary_stage 9 'Planetary stage'"));
  }
  // The other way round: the carrier drives, and with the held ring so do the planets the sun.
  Gearbox box = planetary();
  set(box, 7, "torque_around_u_axis", "N m", "-300");
  CHECK(read_scene(folder.file("mesh.toml", scene_in(folder, box, "Sun 0").text)).mesh().gear[0] ==
        "planet_0");
  // A gear of several stages without a planetary stage: its share is not known.
  box = planetary();
  std::erase_if(box.links,
                [](const Link& link) { return link.type == "assembly" && link.refs[0].second == 9; });
  CHECK(says(scene_in(folder, box, "Sun 0").assumed,
             "torque_Nm = 300.0: the whole torque, and cylindrical_gear 10 'Sun' takes part in 3 stages"));
  // A stage of two suns is no train; its meshes can be imported, and what is not known of them is said.
  box = planetary();
  box.parts.push_back(box.parts[7]);
  box.parts.back().id = 12;
  for (ModelPart& part : box.parts)
    if (part.id == 12) part.name = "Second sun", part.type = "cylindrical_gear";
  for (Link& link : box.links)
    if (link.type == "stage" && link.refs[0].second == 51) link.refs[1].second = 12;
  CHECK(names(said(folder, box), {2, 1, 3, 6}));
  CHECK(says(scene_in(folder, box, "Sun 0").assumed,
             "torque_Nm = 100.0: its share of the torque and its speed are not known"));
}

TEST_CASE("REXS: the dedendum of a hob is not the addendum of its gear; tip circles end at their chamfers") {
  const Folder folder;
  Gearbox box = planetary();
  // As drawn, whatever its pressure reaches under load.
  const auto gear = [&](size_t g) {
    return read_scene(folder.file("train.toml", scene_in(folder, box).text)).gears[g].design;
  };
  CHECK(gear(0).addendum == 1.0);
  CHECK(gear(0).dedendum == 1.25);
  CHECK(says(train_in(folder, box).text.assumed, "gear.sun.addendum = 1.0: ISO 53"));
  // An assumed height of the ring is one that runs, and not just so: with 0.9 its tips reach below the involute of the planet.
  CHECK(gear(2).addendum == relative(0.8, 1e-12));
  CHECK(says(train_in(folder, box).text.assumed,
             "1.0 leaves its tips no room at the 28 teeth that it meshes with"));
  set(box, 10, "tip_diameter", "mm", "55.2");
  set(box, 11, "tip_diameter", "mm", "-185.2");
  for (const int flank : {510, 610}) set(box, flank, "tooth_tip_chamfer", "mm", "0.1");
  for (const int flank : {511, 611}) set(box, flank, "tooth_tip_chamfer", "mm", "0.2");
  CHECK(gear(0).addendum == relative(1.0, 1e-12));   // 55.2 - 2 0.1
  CHECK(gear(2).addendum == relative(0.88, 1e-12));  // 185.2 + 2 0.2
  set(box, 11, "tip_form_diameter", "mm", "186");
  CHECK(gear(2).addendum == relative(0.8, 1e-12));
  // A cutter wheel's addendum is the ring's dedendum only as a rack's is.
  box.parts.push_back(
      {31,
       "cutter_wheel_tool",
       "",
       {{"addendum_coefficient_reference_profile", "", "1.2"}, {"tip_radius_factor", "", "0"}}});
  box.links.push_back({"manufacturing_step", {{"workpiece", 511}, {"tool", 31}}});
  CHECK(gear(2).dedendum == 1.2);
  CHECK(gear(2).rack_tip_radius == 0.38);
  CHECK(says(train_in(folder, box).text.assumed, "gear.ring.dedendum = 1.2: as a rack would cut it"));
}

TEST_CASE(
    "REXS: centre distance from positions and shifts from the centre distance, by the equation of ISO 21771") {
  const Folder folder;
  Gearbox box = first_pair();
  unset(box, 12, "center_distance");
  for (const auto& [id, v, w] : {std::tuple{10, 100.0, 0.0}, std::tuple{11, 100 + 94.5 * 0.6, 94.5 * 0.8}})
    place(box, id, v, w);
  const auto pair = [&] { return read_scene(folder.file("pair.toml", scene_in(folder, box).text)); };
  CHECK(pair().mesh().centre_distance == 94.5e-3);
  CHECK(says(
      scene_in(folder, box).assumed,
      "mesh.centre_distance_mm = 94.5: the model has no center_distance; from cylindrical_gear 10 'Pinion A', support_vector"));
  set(box, 11, "reference_component_for_position", "", "40");
  CHECK(names(said(folder, box), {"support_vector"}));

  // A pair without backlash: what is not said of one gear, or of both.
  const auto backlash = [](const Scene& scene) {
    return GearPair(scene.gears[0].design, scene.gears[1].design, scene.mesh().centre_distance).backlash();
  };
  box = first_pair();
  for (const int flank : {20, 21}) unset(box, flank, "addendum_modification_coefficient");
  CHECK(std::abs(backlash(pair())) < 1e-9);
  CHECK(pair().gears[1].design.profile_shift == 0.05);
  CHECK(says(scene_in(folder, box).assumed, "gear.pinion_a.profile_shift = "));
  for (const int flank : {22, 23}) unset(box, flank, "addendum_modification_coefficient");
  CHECK(std::abs(backlash(pair())) < 1e-9);
  CHECK(pair().gears[1].design.profile_shift == pair().gears[0].design.profile_shift);

  // An internal pair on fixed axes; 59.8 mm in place of 60 mm; then a shift with the sign of handbooks.
  Gearbox ring = planetary();
  remove_links(ring, "assembly");
  set(ring, 60, "center_distance", "mm", "-59.8");
  const auto internal = [&] {
    return read_scene(folder.file("ring.toml", scene_in(folder, ring, "60").text));
  };
  CHECK(std::abs(backlash(internal())) < 1e-9);
  const double shift = internal().gears[1].design.profile_shift;
  CHECK(shift > 0.05);
  for (const double sign : {1.0, -1.0}) {
    for (const int flank : {511, 611})
      set(ring, flank, "addendum_modification_coefficient", "", std::to_string(sign * shift));
    CHECK(internal().gears[1].design.profile_shift == relative(shift, 1e-5));
    CHECK(says(scene_in(folder, ring, "60").assumed,
               "with the other sign, which the centre distance needs") == (sign < 0));
  }
  // Of a train all of it.
  Gearbox box2 = planetary();
  for (const int n : {0, 1, 2}) {
    set(box2, 50 + n, "center_distance", "mm", "59.8");
    set(box2, 60 + n, "center_distance", "mm", "59.8");
  }
  const Train train = train_in(folder, box2);
  for (size_t m : {0, 1}) {
    const GearPair of(train.scene.gears[m].design, train.scene.gears[m + 1].design, 59.8e-3);
    CHECK(std::abs(of.backlash()) < 1e-9);
  }
}

TEST_CASE("REXS: assumed tips of a pair with large shifts leave the other's root room") {
  const Folder folder;
  Gearbox box = first_pair();
  for (const int flank : {20, 21, 22, 23}) set(box, flank, "addendum_modification_coefficient", "", "0.8");
  // x1 + x2 = 1.6 moves the axes by 3.55 mm in place of 1.6 modules: 0.18 modules of the clearance are gone.
  set(box, 12, "center_distance", "mm", "97.3");
  set(box, 30, "addendum_coefficient_reference_profile", "", "1.05");
  const Scene scene = read_scene(folder.file("pair.toml", scene_in(folder, box).text));
  check_geometry(scene, [](const auto&, const auto&) { return std::string(); });
  // The largest: with 0.05 more they jam.
  GearDesign one = scene.gears[0].design, two = scene.gears[1].design;
  CHECK(one.addendum == two.addendum);
  CHECK(one.addendum < 1);
  one.addendum = two.addendum += 0.05;
  CHECK(names(message_of_input([&] { GearPair(one, two, scene.mesh().centre_distance); }), {"gears", "jam"}));
}

TEST_CASE("REXS: planets stand where positions or angles say; equal spacing is found in them") {
  const Folder folder;
  const auto degrees = [](const Train& train) {
    std::vector<double> out;
    for (const double angle : train.scene.carriers[0].positions)
      out.push_back(std::round(angle * 180 / std::numbers::pi * 1e4) / 1e4);
    return out;
  };
  CHECK(train_in(folder, planetary(4, 17)).scene.carriers[0].planets == 4);
  Gearbox box = planetary(3);
  for (const auto& [n, angle] : {std::pair{0, 0.0}, std::pair{1, 112.5}, std::pair{2, 225.0}})
    set(box, 50 + n, "rotating_angle_around_neg_u_axis", "deg", std::to_string(-angle));
  CHECK(degrees(train_in(folder, box)) == std::vector<double>{0, 112.5, 225});
  // The sun turns the other way: seen from behind.
  set(box, 40, "rotational_speed", "1 / min", "-1500");
  set(box, 7, "torque_around_u_axis", "N m", "-300");
  CHECK(degrees(train_in(folder, box)) == std::vector<double>{0, 135, 247.5});
  // Positions go before angles: v to the right, w up.
  set(box, 40, "rotational_speed", "1 / min", "1500");
  set(box, 7, "torque_around_u_axis", "N m", "300");
  for (const auto& [id, angle] : {std::pair{20, 10.0}, std::pair{21, 145.0}, std::pair{22, 257.5}})
    place(box, id, 60 * std::cos(angle * std::numbers::pi / 180),
          60 * std::sin(angle * std::numbers::pi / 180));
  place(box, 10, 0, 0);
  CHECK(degrees(train_in(folder, box)) == std::vector<double>{0, 135, 247.5});
  for (const int n : {0, 1, 2}) {
    unset(box, 50 + n, "rotating_angle_around_neg_u_axis");
    unset(box, 20 + n, "support_vector");
  }
  CHECK(says(train_in(folder, box).text.assumed,
             "carrier.planets = 3: the model does not say where the planets stand"));
}

TEST_CASE("REXS: a planetary stage that cannot be a scene is rejected with both values that contradict") {
  const Folder folder;
  struct Case {
    const char* message;
    void (*change)(Gearbox&);
  };
  for (
      const Case& c : {
          Case{
              "the planets differ, and a scene has one gear for all of them: cylindrical_gear 20 'Planet 0' has face_width_mm = 20.0, cylindrical_gear 21 'Planet 1' has face_width_mm = 22.0",
              [](Gearbox& b) { set(b, 21, "face_width", "mm", "22"); }},
          Case{
              "cannot turn: ring: switchable_coupling 8 'Brake' holds it in gear_casing 2 'Casing', and carrier: shaft 42 'Carrier shaft', rotational_speed = 0",
              [](Gearbox& b) { set(b, 42, "rotational_speed", "1 / min", "0"); }},
          Case{
              "rotational_speed = 1500 1/min and shaft 42 'Carrier shaft', rotational_speed = 300 1/min, which would be 312.5 1/min",
              [](Gearbox& b) { set(b, 42, "rotational_speed", "1 / min", "300"); }},
          Case{"holds no member in its gear_casing (sun 1500 1/min, carrier 300 1/min)",
               [](Gearbox& b) {
                 set(b, 42, "rotational_speed", "1 / min", "300");
                 set(b, 8, "is_engaged", "", "false");
               }},
          Case{"59 mm from the sun (cylindrical_stage 50 'Sun 0', center_distance) and 60 mm from the ring",
               [](Gearbox& b) { set(b, 50, "center_distance", "mm", "59"); }},
          Case{"is helical", [](Gearbox& b) { set(b, 22, "helix_angle_reference_diameter", "deg", "9"); }},
      }) {
    CAPTURE(c.message);
    Gearbox box = planetary();
    c.change(box);
    const std::string message = said(folder, box);
    CHECK_MESSAGE(contains(message, c.message), message);
  }
  // A torque of another member that does not agree is told, not taken.
  Gearbox box = planetary();
  box.parts.push_back({6, "external_load", "Output", {{"torque_around_u_axis", "N m", "-1400"}}});
  box.links.push_back({"assembly", {{"assembly", 42}, {"part", 6}}});
  const Train train = train_in(folder, box);
  CHECK(train.drive("carrier").torque == relative(-1440, 1e-12));
  CHECK(says(train.text.ignored, "makes it 1440 N m without losses"));
}

TEST_CASE("REXS: a torque from a power has six digits, as scenes have") {
  const Folder folder;
  Gearbox box = first_pair();
  box.load = {{40, "shaft", "Input", {{"rotational_speed", "1 / min", "-1500"}}},
              {41, "external_load", "Load", {{"power", "kW", "100"}}}};
  const RexsScene scene = scene_in(folder, box);
  CHECK(read_scene(folder.file("pair.toml", scene.text)).operation.torques == std::vector<double>{636.62});
  CHECK(contains(scene.text, "power = 100 kW at -1500 1/min; six digits of 636.6197723675"));
  box.load[1].attributes = {{"torque_around_u_axis", "N m", "1591.5494309189535"}};
  CHECK(read_scene(folder.file("pair.toml", scene_in(folder, box).text)).operation.torques ==
        std::vector<double>{1591.55});
}
