// REXS models, written here after the published schema: what is read of them, scenes made from them, foreign and damaged files.
#include <doctest/doctest.h>
#include <zip.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"
#include "gear/scene_geometry.h"
#include "io/rexs/rexs.h"
#include "io/rexs/scene.h"
#include "io/scene.h"
#include "refusal.h"
#include "relative.h"
#include "rexs_models.h"

using namespace whine;

TEST_CASE("REXS: a model in XML, JSON and zip gives the gears of the scene that it describes") {
  const Folder folder;
  const Scene expected = read_scene("data/scenes/first-pair.toml");
  const Gearbox box = first_pair();
  for (const std::string& path :
       {folder.file("pair.rexs", xml(box)), folder.file("bom.rexs", "\xef\xbb\xbf" + xml(box)),
        folder.file("pair.rexsj", json(box)),
        folder.zipped("pair.rexsz", {{"pair.rexs", xml(box)}, {"picture.png", "?"}}),
        folder.zipped("json.rexsz", {{"pair.rexsj", json(box)}})}) {
    CAPTURE(path);
    const Scene scene = imported(folder, path);
    REQUIRE(scene.gears.size() == 2);
    for (size_t g = 0; g < 2; ++g) {
      const GearDesign &a = scene.gears[g].design, &b = expected.gears[g].design;
      CHECK(a.teeth == b.teeth);
      CHECK(a.module == b.module);
      CHECK(a.pressure_angle == b.pressure_angle);
      CHECK(a.profile_shift == b.profile_shift);
      CHECK(a.addendum == b.addendum);
      CHECK(a.dedendum == b.dedendum);
      CHECK(a.rack_tip_radius == b.rack_tip_radius);
      CHECK(a.face_width == b.face_width);
      CHECK(a.bore_radius == b.bore_radius);
      CHECK(scene.gears[g].material.youngs_modulus == expected.gears[g].material.youngs_modulus);
      CHECK(scene.gears[g].material.density == expected.gears[g].material.density);
    }
    CHECK(scene.gears[0].name == "pinion_a");
    CHECK(scene.mesh().gear[0] == "pinion_a");
    CHECK(scene.mesh().centre_distance == expected.mesh().centre_distance);
    CHECK(scene.operation.torques == std::vector<double>{60});
    // 6000 1/min of 30 teeth: 3000 Hz, from a fifth of it to half beyond
    CHECK(scene.operation.frequency_from == 600);
    CHECK(scene.operation.frequency_to == 4500);
  }
}

TEST_CASE("REXS: units, reliefs, the generating shift and the flank that works") {
  const Folder folder;
  Gearbox box = first_pair();
  box.version = "2.0";
  set(box, 10, "normal_module", "m", "0.0025");
  set(box, 20, "normal_pressure_angle", "rad", "0.3490658503988659");
  set(box, 21, "normal_pressure_angle", "rad", "0.3490658503988659");
  set(box, 31, "elastic_modulus", "GPa", "206");
  set(box, 10, "tip_diameter", "mm", "81.25");
  box.parts.push_back({50,
                       "tip_relief",
                       "",
                       {{"tip_relief_depth", "mm", "0.02"},
                        {"tip_relief_datum_diameter", "mm", "79"},
                        {"shape_of_relief", "", "parabolic"}}});
  add_tip_relief(box, 51, "7", "79.5", {});
  box.parts.push_back({52, "cylindrical_stage_gear_data", "", {{"loaded_tooth_flank", "", "right"}}});
  box.parts.push_back({53,
                       "cylindrical_gear_manufacturing_settings",
                       "",
                       {{"generated_addendum_modification_coefficient", "", "0.23"}}});
  box.parts.push_back(
      {54,
       "profile_crowning",
       "",
       {{"profile_crowning_at_tip", "mm", "0.003"}, {"profile_crowning_at_root", "mm", "0.003"}}});
  box.links.push_back({"reference", {{"origin", 20}, {"referenced", 50}}});
  box.links.push_back({"reference", {{"origin", 21}, {"referenced", 51}}});
  box.links.push_back({"reference", {{"origin", 21}, {"referenced", 54}}});
  box.links.push_back({"stage_gear_data", {{"stage", 12}, {"gear", 10}, {"stage_gear_data", 52}}});
  box.links.push_back({"manufacturing_step", {{"workpiece", 10}, {"manufacturing_settings", 53}}});
  const Scene scene = imported(folder, folder.file("pair.rexs", xml(box)));
  const SceneGear& pinion = scene.gears[0];
  CHECK(pinion.design.module == 2.5e-3);
  CHECK(pinion.design.pressure_angle == relative(std::numbers::pi / 9, 1e-14));
  CHECK(pinion.material.youngs_modulus == 206e9);
  CHECK(pinion.design.addendum == relative(1.0, 1e-12));
  CHECK(pinion.modification.tip.amount == relative(7e-6, 1e-14));  // of the right flank
  CHECK(pinion.modification.tip.start_radius == relative(39.75e-3, 1e-14));
  CHECK(pinion.modification.tip.shape == ReliefShape::linear);
  CHECK(pinion.modification.crowning == relative(3e-6, 1e-14));
  CHECK(pinion.design.tooth_thinning == relative(2 * 2.5e-3 * 0.02 * std::tan(std::numbers::pi / 9), 1e-12));
  CHECK(scene.gears[1].modification == FlankModification{});
}

TEST_CASE(
    "REXS: one of several stages, driven by its second gear; what the model lacks is assumed and said") {
  const Folder folder;
  Gearbox box = first_pair();
  for (const auto& [id, name] : {std::pair{60, "Third"}, std::pair{61, "Fourth"}})
    box.parts.push_back(
        {id,
         "cylindrical_gear",
         name,
         {{"number_of_teeth", "", "25"}, {"normal_module", "mm", "3"}, {"face_width", "mm", "30"}}});
  box.parts.push_back({62, "cylindrical_stage", "Second stage", {{"center_distance", "mm", "76"}}});
  for (int id : {63, 64})
    box.parts.push_back(
        {id,
         "cylindrical_gear_flank",
         "",
         {{"normal_pressure_angle", "deg", "20"}, {"addendum_modification_coefficient", "", "0.2"}}});
  box.parts.push_back({65, "cylindrical_stage_gear_data", "", {{"is_driving_gear", "", "true"}}});
  box.links.push_back({"stage", {{"stage", 62}, {"gear_1", 60}, {"gear_2", 61}}});
  box.links.push_back({"flank", {{"gear", 60}, {"left", 63}}});
  box.links.push_back({"flank", {{"gear", 61}, {"left", 64}}});
  box.links.push_back({"stage_gear_data", {{"stage", 62}, {"gear", 61}, {"stage_gear_data", 65}}});
  const std::string path = folder.file("box.rexs", xml(box));
  CHECK(names(message_of_input([&] { scene_of_rexs(read_rexs(path), "", 1); }), {2, "--stage"}));
  CHECK(names(message_of_input([&] { scene_of_rexs(read_rexs(path), "Fifth", 1); }), {"Fifth"}));
  for (const char* stage : {"62", "Second stage"}) {
    const Scene scene = imported(folder, path, stage);
    CHECK(scene.mesh().gear[0] == "fourth");
    CHECK(scene.mesh().gear[1] == "third");
    CHECK(scene.mesh().centre_distance == 76e-3);
    CHECK(scene.gears[0].design.dedendum == 1.25);
    CHECK(scene.gears[0].material.youngs_modulus == 206e9);
  }
  const RexsScene scene = scene_of_rexs(read_rexs(path), "62", 1);
  for (const char* key : {"gear.third.dedendum", "gear.fourth.bore_radius_mm", "youngs_modulus_GPa",
                          "torque_Nm", "rayleigh_stiffness_s"})
    CHECK_MESSAGE(says(scene.assumed, key), key);
  CHECK(!says(scene.assumed, "mesh.driver"));
}

TEST_CASE(
    "REXS: the driver is the gear that the model or its load case names; else the first, and that is said") {
  const Folder folder;
  struct Case {
    const char *one, *two, *two_in_load;  // is_driving_gear; empty: not there
    const char* driver;
    const char* assumed;  // empty: nothing
  };
  for (const Case& c : {Case{"true", "", "", "pinion_a", ""}, Case{"", "true", "", "wheel_b", ""},
                        Case{" false\n", "", "", "wheel_b", ""}, Case{"", "false", "", "pinion_a", ""},
                        Case{"false", "true", "", "wheel_b", ""}, Case{"", "", "true", "wheel_b", ""},
                        Case{"", "false", "true", "wheel_b", ""}, Case{"", "true", "false", "pinion_a", ""},
                        Case{"", "", "", "pinion_a", "the model has no is_driving_gear"},
                        Case{"false", "false", "", "pinion_a", "is_driving_gear is false of both gears"}}) {
    CAPTURE(c.one);
    CAPTURE(c.two);
    CAPTURE(c.two_in_load);
    Gearbox box = first_pair();
    set_stage_gear_data(box, 50, 10);
    set_stage_gear_data(box, 51, 11);
    if (*c.one) set(box, 50, "is_driving_gear", "", c.one);
    if (*c.two) set(box, 51, "is_driving_gear", "", c.two);
    if (*c.two_in_load)
      box.load.push_back({51, "cylindrical_stage_gear_data", "", {{"is_driving_gear", "", c.two_in_load}}});
    for (const std::string& path :
         {folder.file("pair.rexs", xml(box)), folder.file("pair.rexsj", json(box))}) {
      const RexsScene scene = scene_of_rexs(read_rexs(path), "", 1);
      CHECK(read_scene(folder.file("scene.toml", scene.text)).mesh().gear[0] == c.driver);
      CHECK(says(scene.assumed, "mesh.driver") == (*c.assumed != 0));
      CHECK(says(scene.assumed, c.assumed));
      CHECK((contains(scene.text, "# ASSUMED: gear_1 of the stage")) == (*c.assumed != 0));
    }
  }
  Gearbox box = first_pair();
  for (const int id : {50, 51}) {
    set_stage_gear_data(box, id, id - 40);
    set(box, id, "is_driving_gear", "", "true");
  }
  const auto said = [&] {
    return message_of_input([&] { scene_of_rexs(read_rexs(folder.file("bad.rexs", xml(box))), "", 1); });
  };
  CHECK(names(said(), {"is_driving_gear", "cylindrical_stage", 12, "First stage"}));
  set(box, 51, "is_driving_gear", "", "perhaps");
  CHECK(names(said(), {"is_driving_gear", "cylindrical_stage_gear_data", 51, "perhaps"}));
}

TEST_CASE(
    "REXS: the flank that carries load is that of the load case; where none is said the left one, and that is said") {
  const Folder folder;
  Gearbox box = first_pair();
  add_tip_relief(box, 50, "4", "79.5", {20});
  add_tip_relief(box, 51, "7", "79.5", {21});
  set_stage_gear_data(box, 52, 10);
  const auto scene = [&] { return scene_of_rexs(read_rexs(folder.file("pair.rexs", xml(box))), "", 1); };
  const auto relief = [&](const RexsScene& s) {
    return read_scene(folder.file("scene.toml", s.text)).gears[0].modification.tip.amount;
  };
  CHECK(relief(scene()) == relative(4e-6, 1e-14));
  CHECK(says(scene().assumed,
             "gear.pinion_a.modification: of the left flank: the model has no loaded_tooth_flank"));
  CHECK(says(scene().ignored, "tip_relief 51 of cylindrical_gear_flank 21: that flank carries no load"));
  CHECK(contains(scene().text, "# ASSUMED: [gear.pinion_a.modification] of the left flank"));
  // The wheel's flanks are alike: nothing is assumed of them.
  CHECK(!says(scene().assumed, "gear.wheel_b.modification"));
  set(box, 52, "loaded_tooth_flank", "", "left");
  CHECK(relief(scene()) == relative(4e-6, 1e-14));
  CHECK(!says(scene().assumed, "modification: of"));
  box.load.push_back({52, "cylindrical_stage_gear_data", "", {{"loaded_tooth_flank", "", "right"}}});
  CHECK(relief(scene()) == relative(7e-6, 1e-14));
  CHECK(!says(scene().assumed, "modification: of"));
  box.load.back().attributes = {{"loaded_tooth_flank", "", "both"}, {"mesh_misalignment", "mum", "3"}};
  CHECK(says(scene().assumed, "of the left flank: the model says loaded_tooth_flank = 'both'"));
  CHECK(says(scene().ignored, "load case, cylindrical_stage_gear_data 52: mesh_misalignment"));
  // A second relief of one flank is not written twice.
  box.links.push_back({"reference", {{"origin", 20}, {"referenced", 51}}});
  CHECK(relief(scene()) == relative(4e-6, 1e-14));
  CHECK(says(scene().ignored,
             "tip_relief 51 of cylindrical_gear_flank 20: a flank of a scene has one tip_relief"));
}

TEST_CASE(
    "REXS: a helical stage: angle, hands, tips and shifts of the normal section, crowning of the lead") {
  const Folder folder;
  Gearbox box = first_pair();
  const double beta = 20 * std::acos(-1.0) / 180, distance = 94.5 / std::cos(beta);
  set(box, 10, "helix_angle_reference_diameter", "deg", "20");
  set(box, 11, "helix_angle_reference_diameter", "deg", "-20");
  set(box, 12, "center_distance", "mm", text(distance));
  // Reference diameter, 0.25 of shift and an addendum of 1.
  set(box, 10, "tip_diameter", "mm", text(2.5 * (30 / std::cos(beta) + 2.5)));
  box.parts.push_back({50,
                       "helix_crowning",
                       "",
                       {{"helix_crowning_amount_datum_face", "mum", "6"},
                        {"helix_crowning_amount_non_datum_face", "mum", "6"}}});
  for (const int flank : {20, 21})
    box.links.push_back({"reference", {{"origin", flank}, {"referenced", 50}}});
  const auto imported = [&] { return scene_of_rexs(read_rexs(folder.file("pair.rexs", xml(box))), "", 1); };
  const auto read = [&] { return read_scene(folder.file("pair.toml", imported().text)); };
  const Scene scene = read();
  const GearDesign& pinion = scene.gears[0].design;
  CHECK(pinion.helix_angle == relative(beta, 1e-12));
  CHECK(pinion.hand == Hand::right);
  CHECK(scene.gears[1].design.hand == Hand::left);
  CHECK(pinion.addendum == relative(1, 1e-4));
  CHECK(!scene.gears[0].material.plane_stress);
  CHECK(scene.gears[0].modification.lead.crowning == relative(6e-6, 1e-12));
  CHECK(scene.fidelity.width == WidthModel::body);
  CHECK(contains(imported().text, "# width = \"slices\""));
  CHECK(!contains(imported().text, "calibrate"));  // which helical pairs do not have
  // Angles without their hand.
  set(box, 11, "helix_angle_reference_diameter", "deg", "20");
  CHECK(read().gears[1].design.hand == Hand::left);
  CHECK(contains(imported().text, "ASSUMED: the other hand of its mate"));
}

TEST_CASE("REXS: what a model says and a scene cannot hold is listed; texts of the model are data") {
  const Folder folder;
  Gearbox box = first_pair();
  set(box, 10, "single_pitch_deviation_iso_1328_2013", "mum", "5");
  box.parts.push_back({50, "helix_crowning", "", {}});
  box.links.push_back({"reference", {{"origin", 20}, {"referenced", 50}}});
  for (ModelPart& part : box.parts)
    if (part.id == 11) part.name = "&quot;]&#10;[material.evil]&#10;x = `touch x`";
  const RexsScene scene = scene_of_rexs(read_rexs(folder.file("pair.rexs", xml(box))), "", 1);
  CHECK(contains(scene.text, "single_pitch_deviation_iso_1328_2013"));
  CHECK(contains(scene.text, "helix_crowning 50"));
  CHECK(!contains(scene.text, "\n[material.evil]"));
  CHECK(read_scene(folder.file("scene.toml", scene.text)).gears.size() == 2);
  // A type stands in the same comments: of what is read, of what is not, and of what is beside a flank.
  for (const int id : {30, 31, 40, 50}) {
    CAPTURE(id);
    for (ModelPart& part : box.parts)
      if (part.id == id) {
        const std::string type = part.type;
        part.type = "x&#10;[material.evil]&#10;y = 1";
        const RexsScene changed = scene_of_rexs(read_rexs(folder.file("type.rexs", xml(box))), "", 1);
        CHECK(!contains(changed.text, "\n[material.evil]"));
        CHECK(read_scene(folder.file("scene.toml", changed.text)).gears.size() == 2);
        part.type = type;
      }
  }
  for (ModelPart& part : box.parts) {
    if (part.id == 11) part.name = "]\n[material.evil]\nx = 1";
    if (part.id == 50) part.type = "x\n[material.evil]\ny = 1";
  }
  const RexsScene of_json = scene_of_rexs(read_rexs(folder.file("pair.rexsj", json(box))), "", 1);
  CHECK(contains(of_json.text, "x [material.evil] y = 1 50"));
  CHECK(!contains(of_json.text, "\n[material.evil]"));
  CHECK(read_scene(folder.file("scene.toml", of_json.text)).gears.size() == 2);
}

TEST_CASE(
    "REXS: names that are cut, of folders of results, and bytes that are no UTF-8 give a scene that its own reader accepts") {
  const Folder folder;
  Gearbox box = first_pair();
  for (size_t letters = 0; letters < 4; ++letters)
    for (const char* letter : {"ü", "€", "𝛽", "\xfc", "\xe2\x82"}) {
      std::string name(letters, 'x');
      for (int i = 0; i < 60; ++i) name += letter;
      CAPTURE(letters);
      CAPTURE(letter);
      box.parts[1].name = name;
      set(box, 10, name, "mm", "1");
      const RexsScene scene = scene_of_rexs(read_rexs(folder.file("pair.rexs", xml(box))), "", 1);
      CHECK(read_scene(folder.file("scene.toml", scene.text)).gears.size() == 2);
      unset(box, 10, name);
    }
  for (const char* place : {"Report", "Up", "Teeth"}) {
    box.parts[1].name = place;
    const RexsScene scene = scene_of_rexs(read_rexs(folder.file("pair.rexs", xml(box))), "", 1);
    CHECK(contains(scene.text, "\n[gear.gear_"));
    CHECK(read_scene(folder.file("scene.toml", scene.text)).gears.size() == 2);
  }
}

TEST_CASE("REXS: a damaged archive is rejected, whatever byte is damaged and however the model is packed") {
  const Folder folder;
  const std::string good = xml(first_pair());
  for (const int method : {ZIP_CM_STORE, ZIP_CM_DEFLATE}) {
    CAPTURE(method);
    const std::string whole = bytes_of(folder.zipped("whole.rexsz", {{"pair.rexs", good}}, method));
    CHECK(read_rexs(folder.file("same.rexsz", whole)).components.size() == 12);
    // The data stand between the local header (30 bytes and the name) and the central directory. The first bit of a deflated
    // stream says that it has no further block, and changes nothing that is read.
    const size_t begin = 30 + 9 + 1, end = whole.find("PK\x01\x02");
    REQUIRE(end != std::string::npos);
    for (size_t at = begin; at < end; at += method == ZIP_CM_STORE ? 97 : 7) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ 1);
      const std::string path = folder.file("damaged.rexsz", bytes);
      CHECK_MESSAGE(names(message_of_input([&] { read_rexs(path); }), {"encrypted", "damaged"}), at);
    }
    // A length that is less than that of the data, in both headers: the rest would be dropped.
    std::string bytes = whole;
    for (const size_t at : {size_t{22}, end + 24}) {
      const size_t length = good.size() - 20;
      for (size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<char>(length >> (8 * k));
    }
    const std::string path = folder.file("short.rexsz", bytes);
    CHECK(names(message_of_input([&] { read_rexs(path); }), {"archive", "zip"}));
  }
}

TEST_CASE("REXS: foreign and damaged files are rejected with the reason") {
  const Folder folder;
  const std::string good = xml(first_pair()), good_json = json(first_pair());
  const auto changed = [](const auto& change) {
    Gearbox box = first_pair();
    change(box);
    return xml(box);
  };
  const auto without = [&](const std::string& bytes, const std::string& word, const std::string& with) {
    std::string out = bytes;
    const size_t at = out.find(word);
    REQUIRE(at != std::string::npos);
    return out.replace(at, word.size(), with);
  };
  struct Case {
    const char* what;
    std::string bytes;
    std::vector<Field> fields;
  };
  const std::vector<Case> cases = {
      {"empty", "", {"empty"}},
      {"blank", " \n\t", {"empty"}},
      {"a text", "teeth = 30\n", {"neither", "JSON"}},
      {"XML cut off", good.substr(0, good.size() / 2), {"broken", "line"}},
      {"other XML", "<?xml version=\"1.0\"?><html><body/></html>", {"<html>"}},
      {"JSON cut off", good_json.substr(0, good_json.size() / 2), {"broken", "JSON"}},
      {"other JSON", "{\"scene\": 1}", {"model", "holds"}},
      {"JSON with a number for its components",
       "{\"model\": {\"version\": \"1.4\", \"components\": 5}}",
       {"cylindrical_stage"}},
      {"JSON with components that are numbers",
       "{\"model\": {\"version\": \"1.4\", \"components\": [1, 2]}}",
       {"model"}},
      {"JSON nested deeply", std::string(100000, '['), {"neither", "JSON"}},
      {"JSON nested deeply in a model", "{\"model\":" + std::string(100000, '['), {"JSON"}},
      {"zip cut off", "PK\x03\x04 and nothing else", {"archive", "opened"}},
      {"no version", without(good, " version=\"1.4\"", ""), {"version", "names"}},
      {"version 3.0", without(good, "version=\"1.4\"", "version=\"3.0\""), {"version", "3.0"}},
      {"an id twice", without(good, "component id=\"11\"", "component id=\"10\""), {10, "components"}},
      {"an id that is a word", without(good, "component id=\"11\"", "component id=\"x\""), {0, "number"}},
      {"a relation to nothing", without(good, "ref id=\"11\"", "ref id=\"99\""), {99, "component"}},
      {"no stage",
       without(good, "type=\"cylindrical_stage\"", "type=\"bevel_stage\""),
       {"cylindrical_stage"}},
      {"a stage without gears",
       without(good, "role=\"gear_2\"", "role=\"gear_3\""),
       {"stage", "gear_1", "gear_2"}},
      {"helical",
       changed([](Gearbox& b) { set(b, 10, "helix_angle_reference_diameter", "deg", "15"); }),
       {"helix angles differ"}},
      {"a bevel gear",
       without(good, "\"11\" type=\"cylindrical_gear\"", "\"11\" type=\"bevel_gear\""),
       {"cylindrical_gear", "ring_gear"}},
      {"teeth missing", changed([](Gearbox& b) { unset(b, 10, "number_of_teeth"); }), {"number_of_teeth"}},
      {"half a tooth",
       changed([](Gearbox& b) { set(b, 10, "number_of_teeth", "", "30.5"); }),
       {"number_of_teeth", "30.5"}},
      {"a number that is none",
       changed([](Gearbox& b) { set(b, 10, "normal_module", "mm", "2,5"); }),
       {"normal_module", "2,5"}},
      {"an infinite number",
       changed([](Gearbox& b) { set(b, 10, "normal_module", "mm", "inf"); }),
       {"normal_module", "inf"}},
      {"a unit of something else",
       changed([](Gearbox& b) { set(b, 10, "normal_module", "deg", "2.5"); }),
       {"normal_module", "deg"}},
      {"a list",
       changed([](Gearbox& b) { set(b, 12, "center_distance", "mm", "<array><c>94</c><c>95</c></array>"); }),
       {"center_distance"}},
      {"flanks that differ",
       changed([](Gearbox& b) { set(b, 21, "normal_pressure_angle", "deg", "25"); }),
       {"normal_pressure_angle"}},
      {"no centre distance",
       changed([](Gearbox& b) { unset(b, 12, "center_distance"); }),
       {"center_distance", "support_vector"}},
  };
  for (const Case& c : cases) {
    CAPTURE(c.what);
    const std::string path = folder.file("bad.rexs", c.bytes);
    const std::string said = message_of_input([&] { scene_of_rexs(read_rexs(path), "", 1); });
    CHECK(names(said, c.fields));
    CHECK(said.starts_with(path));
  }
  using Entries = std::vector<std::pair<std::string, std::string>>;
  for (const Entries& entries : {Entries{{"readme.txt", "x"}}, Entries{{"a.rexs", good}, {"b.rexs", good}}}) {
    const std::string path = folder.zipped("bad.rexsz", entries);
    CHECK(names(message_of_input([&] { read_rexs(path); }), {entries.size() == 1 ? 0 : 2, "models"}));
    std::filesystem::remove(path);
  }
  CHECK(names(message_of_input([&] { scene_of_rexs(read_rexs(folder.file("pair.rexs", good)), "", 2); }),
              {2, "load"}));
}

TEST_CASE("REXS: what is said twice is rejected with both values, in XML and in JSON") {
  const Folder folder;
  struct Case {
    std::vector<Field> fields;
    void (*change)(Gearbox&);
  };
  for (const Case& c : {Case{{"normal_module", "cylindrical_gear", 10, "Pinion A", "2.5", "3*"},
                             [](Gearbox& b) {
                               b.parts[1].attributes.push_back({"normal_module", "mm", "3"});
                             }},
                        Case{{"torque_around_u_axis", "external_load", 41, "Load", "-60*"},
                             [](Gearbox& b) {
                               b.load[1].attributes.push_back({"torque_around_u_axis", "N m", "70"});
                             }},
                        Case{{10, "cylindrical_gear", "Pinion A", "Other"},
                             [](Gearbox& b) {
                               b.parts.push_back({10, "cylindrical_gear", "Other", {}});
                             }},
                        Case{{"stage", "cylindrical_stage", 12, "First stage", "gear_1", "cylindrical_gear",
                              10, "Pinion A", "gear_2"},
                             [](Gearbox& b) { b.links[0].refs[2].second = 10; }},
                        Case{{"stage", "gear_1", "cylindrical_gear", 10, "Pinion A", 11},
                             [](Gearbox& b) { b.links[0].refs[2].first = "gear_1"; }},
                        Case{{"stage", "cylindrical_stage", 12, "First stage", "gear_1", "cylindrical_gear",
                              10, "Pinion A", "gear_2", 11, "Wheel B"},
                             [](Gearbox& b) {
                               b.links.push_back({"stage", {{"stage", 12}, {"gear_1", 11}, {"gear_2", 10}}});
                             }},
                        Case{{"flank", "cylindrical_gear", 10, "Pinion A", "cylindrical_gear_flank", 20},
                             [](Gearbox& b) {
                               b.links.push_back({"flank", {{"gear", 10}, {"left", 22}, {"right", 23}}});
                             }},
                        Case{{"stage_gear_data"},
                             [](Gearbox& b) {
                               set_stage_gear_data(b, 50, 10);
                               set_stage_gear_data(b, 51, 10);
                             }},
                        Case{{"cylindrical_gear", 10, "Pinion A", 31, "Steel", 32, "Bronze"}, [](Gearbox& b) {
                               b.parts.push_back({32, "material", "Bronze", {}});
                               b.links.push_back({"reference", {{"origin", 10}, {"referenced", 32}}});
                             }}}) {
    Gearbox box = first_pair();
    c.change(box);
    for (const std::string& path : {folder.file("m.rexs", xml(box)), folder.file("m.rexsj", json(box))}) {
      const std::string said = message_of_input([&] { scene_of_rexs(read_rexs(path), "", 1); });
      CHECK(names(said, c.fields));
    }
  }
  const auto changed = [](std::string in, const std::string& what, const std::string& with) {
    const size_t at = in.find(what);
    REQUIRE(at != std::string::npos);
    return in.replace(at, what.size(), with);
  };
  const std::string good = xml(first_pair()), good_json = json(first_pair());
  for (const auto& [bytes, fields] :
       {std::pair{changed(good, "relation id=\"101\"", "relation id=\"100\""),
                  std::vector<Field>{"stage", "cylindrical_stage", 12}},
        std::pair{changed(good, "component id=\"11\"", "component id=\"11\" id=\"99\""),
                  std::vector<Field>{"id", 11, 99}},
        std::pair{changed(good, "</components>", "</components><components/>"),
                  std::vector<Field>{"components", "model"}},
        std::pair{changed(good_json, "\"version\" : \"1.4\"", "\"version\": \"1.4\", \"version\": \"1.5\""),
                  std::vector<Field>{"version"}},
        std::pair{changed(good_json, "\"floating_point\" : 2.5", "\"floating_point\" : 2.5, \"integer\": 3"),
                  std::vector<Field>{"floating_point", "2.5", 3}},
        std::pair{std::string(
                      R"({"model": {"version": "1.4", "components": [{"id": 1, "attributes": {"a": 1}}]}})"),
                  std::vector<Field>{"attributes", 1, "list"}}}) {
    CHECK(names(message_of_input([&, text = bytes] { read_rexs(folder.file("bad", text)); }), fields));
  }
}

TEST_CASE("REXS: depth and number of nodes are bounded, in XML, in JSON and in archives") {
  const Folder folder;
  const auto said = [&](const std::string& path) { return message_of_input([&] { read_rexs(path); }); };
  const auto nested = [](size_t depth, const std::string& open, const std::string& close) {
    std::string out;
    for (size_t n = 0; n < depth; ++n) out += open;
    for (size_t n = 0; n < depth; ++n) out += close;
    return out;
  };
  const auto xml_with = [](const std::string& inside) {
    return "<model version=\"1.4\"><components><component id=\"1\"><attribute id=\"custom_whine_x\">" +
           inside + "</attribute></component></components></model>";
  };
  const auto json_with = [](const std::string& inside) {
    return R"({"model": {"version": "1.4", "components": [], "x": )" + inside + "}}";
  };
  CHECK(said(folder.file("a.rexs", xml_with(nested(60, "<a>", "</a>")))) == "");
  CHECK(names(said(folder.file("a.rexs", xml_with(nested(61, "<a>", "</a>")))), {64, "nested"}));
  // Comments do not hide the depth, nor do quoted ends of tags.
  CHECK(names(said(folder.file("a.rexs", xml_with(nested(120000, "<a b='</a>'>", "</a>")))), {64, "deeper"}));
  CHECK(said(folder.file("a.rexsj", json_with(nested(60, "[", "]")))) == "");
  CHECK(names(said(folder.file("a.rexsj", json_with(nested(63, "[", "]")))), {64, "nested"}));
  std::string wide = "[0", tall;
  for (size_t n = 0; n < kMostRexsNodes; ++n) wide += ",0", tall += "<a/>";
  CHECK(names(said(folder.file("a.rexsj", json_with(wide + "]"))), {2000000}));
  CHECK(names(said(folder.zipped("a.rexsz", {{"a.rexsj", json_with(wide + "]")}})), {2000000}));
  CHECK(names(said(folder.file("a.rexs", xml_with(tall))), {2000000}));
  std::string entries = "PK\x03\x04";
  for (int n = 0; n < 10001; ++n) entries += "PK\x01\x02";
  CHECK(names(said(folder.file("a.rexsz", entries)), {10001, 10000}));
}

TEST_CASE("REXS: the models of data/examples give scenes whose gears exist and mesh") {
  const Folder folder;
  for (const char* model : {"data/examples/first-pair.rexs", "data/examples/parker2000.rexsj"}) {
    CAPTURE(model);
    check_geometry(imported(folder, model), [](const auto&, const auto&) { return std::string(); });
  }
  const RexsScene scene = scene_of_rexs(read_rexs("data/examples/parker2000.rexsj"), "", 1);
  // Dedendum 1.75: the rack has no room for a tip of 0.38.
  CHECK(says(scene.assumed, "gear.pinion.rack_tip_radius = 0.212: the largest that fits"));
}
