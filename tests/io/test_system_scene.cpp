// Scenes of several meshes: what they say, what is rejected and where, and the stage parameters that are cut from them.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <numeric>
#include <sstream>
#include <vector>

#include "gear/scene_cost.h"
#include "gear/scene_geometry.h"
#include "gear/system_layout.h"
#include "gear/tooth_errors.h"
#include "io/scene.h"
#include "planetary_train.h"
#include "refusal.h"
#include "relative.h"
#include "scene_file.h"
#include "system/natural_modes.h"

using namespace whine;

namespace {

const char* const kShipped = "data/scenes/lin-parker-planetary.toml";

std::string shipped() {
  std::ifstream file(kShipped);
  std::ostringstream out;
  out << file.rdbuf();
  return out.str();
}

std::string edited(const std::string& from, const std::string& to) {
  std::string text = shipped();
  const size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

// The line of the shipped scene that is `words`, from the n-th on.
int line_of(const std::string& words, int n = 1) {
  std::istringstream in(shipped());
  int line = 0;
  for (std::string text; std::getline(in, text);) {
    ++line;
    if (text == words && --n == 0) return line;
  }
  FAIL("no line ", words);
  return 0;
}

void rejects(const std::string& text, int line, const std::vector<Field>& fields) {
  const SceneFile file;
  const std::string path = file.path(text);
  const std::string said = message_of_input([&] { natural_modes(layout_in(read_scene(path), path)); });
  CHECK(said.starts_with(path + ":" + std::to_string(line) + ": "));
  CHECK(names(said, fields));
}

}  // namespace

TEST_CASE("the planetary train that ships has the frequencies of the table, whatever its teeth") {
  CHECK(is_system_scene(kShipped));
  CHECK(!is_system_scene("data/scenes/first-pair.toml"));
  const ModesResult a = natural_modes(layout_in(read_scene(kShipped), kShipped)),
                    b = natural_modes(layout_of(planetary_train(4)));
  REQUIRE(a.natural_frequency.size() == b.natural_frequency.size());
  CHECK(a.natural_frequency[0] == 0);
  for (Eigen::Index i = 1; i < a.natural_frequency.size(); ++i)
    CHECK(a.natural_frequency[i] == relative(b.natural_frequency[i], 1e-9));
  // A planet at psi: its sun mesh is ahead by -z_s psi / 2 pi, its ring mesh by z_r psi / 2 pi of those of the planet at 0. Both are
  // whole at equal spacing, 28 / 4 and 100 / 4. Planets at other steps of 360 / 128 degrees have other phases and the same sum.
  const auto ahead = [](const System& layout, size_t first, double turns) {
    const std::vector<System::Mesh>& mesh = layout.meshes;
    return std::remainder(mesh[first].phase - mesh[first - first % 4].phase - turns, 1);
  };
  for (size_t m = 0; m < 8; ++m) CHECK(std::abs(ahead(a.layout, m, 0)) < 1e-9);
  const SceneFile file;
  const System moved = layout_in(
      read_scene(file.path(edited("planets = 4", "positions_deg = [0, 92.8125, 180, 267.1875]"))), "");
  const std::array steps{0.0, 33.0, 64.0, 95.0};
  for (size_t n = 0; n < 4; ++n) {
    CHECK(std::abs(ahead(moved, n, -28 * steps[n] / 128)) < 1e-9);
    CHECK(std::abs(ahead(moved, 4 + n, 100 * steps[n] / 128)) < 1e-9);
  }
  CHECK(std::abs(ahead(moved, 1, 28 * steps[1] / 128)) > 0.4);
}

TEST_CASE("mesh phases of planets follow from tooth numbers") {
  const System three = layout_of([] {
    Scene scene = planetary_train(3);
    for (size_t g = 0; g < 3; ++g) scene.gears[g].design = rigid_gear(std::array{26, 37, 100}[g], g == 2);
    for (Scene::Mesh& mesh : scene.meshes) mesh.spec.centre_distance = 0.5 * 63 * 2.776e-3;
    return scene;
  }());
  for (size_t n = 0; n < 3; ++n) {
    const double turns = static_cast<double>(n) / 3;
    // The sun turns counter-clockwise, so planets that stand farther on are met later.
    CHECK(std::abs(std::remainder(three.meshes[n].phase - three.meshes[0].phase + 26 * turns, 1)) < 1e-9);
    CHECK(std::abs(std::remainder(three.meshes[3 + n].phase - three.meshes[3].phase - 100 * turns, 1)) <
          1e-9);
  }
}

TEST_CASE("stage parameters of a system: read as written, the same modes to the last bit") {
  const SceneFile file;
  const System layout = layout_in(read_scene(kShipped), kShipped);
  const std::string text = system_parameters(layout);
  const System again = read_system_parameters(file.path(text));
  CHECK(system_parameters(again) == text);
  CHECK(natural_modes(again).shape == natural_modes(layout).shape);
  // A comment, the title and the order of sections change nothing.
  CHECK(system_parameters(
            layout_in(read_scene(file.path("# a comment\n" + edited("title", "# title"))), "")) == text);
  const auto said = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return message_of([&] { read_system_parameters(file.path(changed)); });
  };
  CHECK(names(said("stands_on = 6", "stands_on = 1"), {"carrier"}));
  // The carrier is body 6 and comes last: on itself, then the planets on a carrier that does not stand on the ground.
  const std::string last = text.substr(text.find("name = \"carrier\""));
  const std::string carrier = last.substr(0, last.find("stands_on = -1")) + "stands_on = ";
  CHECK(names(said(carrier + "-1", carrier + "6"), {"carrier", "ground"}));
  CHECK(names(said("kind = \"held\"", "kind = \"hold\""), {"kind", "[drive]"}));
  CHECK(names(said("driven_body = 1", "driven_body = 9"), {"body_number", 9}));
  CHECK(names(said("radius = ", "radius = nan # "), {"number"}));
  CHECK(names(said("sense = 1", "sense = 0.5"), {"number", "whole"}));
  CHECK_THROWS_AS(read_system_parameters(kShipped), Error);
}

TEST_CASE("stages on one shaft are told so before anything else that their scene lacks") {
  const SceneFile file;
  const std::string second =
      "[gear.pinion2]\nlike = \"pinion\"\n[gear.wheel2]\nlike = \"pinion\"\n[[mesh]]\ndriver = \"pinion2\"\ndriven = \"wheel2\"\ncentre_distance_mm = 150\n";
  const std::string path = file.path(with_section(second));
  const std::string said = message_of([&] { read_scene(path); });
  CHECK(names(said, {path + ":27", "[[mesh]]", "pinion2", "wheel2", "pinion"}));
}

TEST_CASE("faults of a scene of a system are rejected with their line") {
  const int carrier = line_of("[[carrier]]"), second = line_of("[[mesh]]", 2),
            pin = line_of("[[bearing]]", 2);
  rejects(edited("planets = 4", "planets = 5"), carrier, {5, "divide"});
  rejects(edited("planets = 4", "positions_deg = [0, 91, 180, 270]"), carrier, {0, 90, 180, 270});
  rejects(edited("planets = 4", "planets = 4\npositions_deg = [0]"), carrier, {"either", "needs"});
  rejects(edited("driven = \"ring\"", "driven = \"rim\""), line_of("driven = \"ring\""),
          {"rim", "ring", "driven"});
  rejects(edited("88.448", "88.4482"), second, {"distance", "meshes"});
  rejects(edited("mass_kg = 0.66\n", ""), pin, {"mass_kg"});
  rejects(edited("gear = \"carrier\"", "gear = \"carier\""), line_of("gear = \"carrier\""), {"carrier"});
  rejects(edited("kind = \"held\"", "kind = \"torque\""), line_of("kind = \"held\"") + 1,
          {"belongs", "kind"});
  rejects(edited("stiffness_N_um = 500.0", ""), line_of("[[mesh]]"), {"stiffness_N_um"});
  // Elastic gears have other keys.
  rejects(edited("body = \"rigid\"", "body = \"modal\""), line_of("equivalent_mass_kg = 0.39      # I / r^2"),
          {"equivalent_mass_kg"});
  rejects(shipped() + "[operation]\n", line_of("body = \"rigid\"") + 1, {"belongs", "elastic"});
  rejects(edited("equivalent_mass_kg = 0.61", "equivalent_mass_kg = 0.61\ntotal_inertia_kgm2 = 1"),
          line_of("[gear.planet]"), {"same"});
  // Sections that only elastic gears follow, of a gear and of one that another is like.
  const int end = line_of("body = \"rigid\"") + 1;
  rejects(shipped() + "[gear.planet.crack]\ntooth = 1\ndepth_mm = 0.5\n", end, {"crack"});
  rejects(shipped() + "[gear.sun.modification]\ncrowning_um = 5\n", end, {"modification"});
  rejects(shipped() + "[gear.ring.error]\neccentricity_um = 5\n", end, {"error"});
  const SceneFile file;
  CHECK_THROWS_AS(read_pair_scene(kShipped), Error);
}

TEST_CASE("elastic systems: what their rest needs is checked with its line before bodies are made") {
  const char* const kElastic = "data/scenes/oh58-planetary.toml";
  std::ostringstream whole;
  whole << std::ifstream(kElastic).rdbuf();
  const SceneFile file;
  // The scene with each `from` replaced, its fault and the place of `at` in it.
  struct Edit {
    const char *from, *to;
  };
  const auto check = [&](const std::vector<Edit>& edits, const char* at, const std::vector<Field>& fields) {
    std::string text = whole.str();
    for (const auto& [from, to] : edits) {
      const size_t place = text.find(from);
      REQUIRE(place != std::string::npos);
      text.replace(place, std::string(from).size(), to);
    }
    const std::string path = file.path(text);
    const std::string said = message_of_input([&] {
      const Scene scene = read_scene(path);
      const System layout = layout_in(scene, path);
      check_inertia(scene, [&](const auto&, const auto&) { return path; });
      check_at_rest_in(scene, layout, path);
    });
    CHECK(said.empty() == fields.empty());
    if (fields.empty()) return;
    CHECK(names(said, fields));
    if (!at) return;
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(text.find(at)), '\n');
    CHECK(said.starts_with(path + ":" + std::to_string(line) + ": "));
  };
  check({}, nullptr, {});
  const char* const sun = "[[drive]]\ngear = \"sun\"";
  const std::string held = "[[drive]]\ngear = \"ring\"\nkind = \"held\"\n";
  check({{held.c_str(), ""}}, sun, {"balanced", "hold"});
  check({{"torque_Nm = 400.0", "torque_Nm = 0.0"}}, sun, {"system", "torque"});
  check({{"torque_Nm = 400.0", "torque_Nm = -400.0"}}, "[[mesh]]\ndriver = \"sun\"",
        {"[[mesh]]", "sun", "planet"});
  check({{"kind = \"torque\"\ntorque_Nm = 400.0", "kind = \"held\""}}, sun, {"system", "torque"});
  check(
      {{"[[drive]]\ngear = \"carrier\"               # the frame in which the train is at rest\nkind = \"held\"",
        ""}},
      "[[carrier]]", {"carrier"});
  check({{"driver = \"planet\"", "contact_plane = \"stress\"\ndriver = \"planet\""}},
        "[[mesh]]\ncontact_plane", {"meshes", "same"});
  // Before remedies are looked for, which see each mesh by itself.
  check({{"centre_distance_mm = 88.9", "centre_distance_mm = 86.1"}}, "[[mesh]]\ndriver = \"planet\"",
        {"distance", "meshes"});
  check(
      {{"[[bearing]]\ngear = \"sun\"",
        "[[mesh]]\ndriven = \"planet\"\ndriver = \"sun\"\ncentre_distance_mm = 88.9\n[[bearing]]\ngear = \"sun\""}},
      "[[mesh]]\ndriven", {"[[mesh]]", "sun", "planet"});
  check(
      {{"[[bearing]]\ngear = \"sun\"",
        "[[mesh]]\ndriver = \"ring\"\ndriven = \"planet\"\ncentre_distance_mm = 88.9\n[[bearing]]\ngear = \"sun\""}},
      "[[mesh]]\ndriver = \"ring\"", {"[[mesh]]", "ring", "planet"});
  // Opposite planets stay opposite: 31.5 and 94.5 steps of 360 / 126 degrees are both rounded down.
  check({{"positions_deg = [0.0, 88.5714, 180.0, 268.5714]", "planets = 4"}}, "[[carrier]]",
        {"positions_deg", 0, "88.5714", 180, "268.5714"});
  // Of its motion, before minutes of work.
  check({{"[damping]", "[fidelity]\nbody = \"full\"\n[damping]"}}, "body = \"full\"",
        {"quasi-static", "trains"});
  check({{"[damping]", "[fidelity]\nintegrator = \"newmark\"\n[damping]"}}, nullptr, {});
  // A ring may float.
  check({{"[[drive]]\ngear = \"ring\"",
          "[[bearing]]\ngear = \"ring\"\nstiffness_N_um = 100\n[[drive]]\ngear = \"ring\""}},
        nullptr, {});
  check({{"[damping]", "[discretisation]\nsteps_per_period = 64\n[damping]"}}, nullptr, {});
  check({{"bore_radius_mm = 20.0", "bore_radius_mm = 20.0\ntotal_inertia_kgm2 = 1e-4"}}, nullptr,
        {"drawing", "least"});
}

TEST_CASE(
    "keys that the table marks as those of pairs are rejected in a system, by the reader that knows them") {
  const std::string table = scene_key_table();
  const size_t at = table.find("| `[[mesh]]` | `face_offset_mm`");
  REQUIRE(at != std::string::npos);
  CHECK(contains(table.substr(at, table.find('\n', at) - at), "of pairs alone: "));
  std::ifstream elastic("data/scenes/three-in-line.toml");
  std::ostringstream whole;
  whole << elastic.rdbuf();
  const SceneFile file;
  const auto said = [&](const std::string& added) {
    const std::string path = file.path(whole.str() + added);
    return message_of([&] { read_scene(path); });
  };
  CHECK(said("").empty());
  // Friction acts in all meshes, at rest and in motion.
  const std::string path = file.path(whole.str() + "\n[friction]\ncoefficient = 0.05\n");
  const Scene scene = read_scene(path);
  const System layout = layout_in(scene, path);
  const std::string still = file.path(system_static_parameters(static_parameters_of(scene, layout)));
  for (const GearMeshSpec& mesh : read_system_static_parameters(still).mesh)
    CHECK(mesh.friction.coefficient == 0.05);
  const std::string moving = file.path(system_sweep_parameters(sweep_parameters_of(scene, layout)));
  for (const GearMeshSpec& mesh : read_system_sweep_parameters(moving).mesh)
    CHECK(mesh.friction.coefficient == 0.05);
  CHECK(said("[gear.idler.error]\neccentricity_um = 5\n").empty());
  CHECK(said("[gear.idler.crack]\ndepth_mm = 0.5\n").empty());
  CHECK(names(said("[gear.idler.crack]\ntooth = 300\ndepth_mm = 0.5\n"), {"tooth", 300}));
  CHECK(names(said("[gear.idler.error]\nprofile_slope_um = [1.0, 2.0]\n"), {60, "teeth"}));
  // A multiple beyond 64 bits.
  std::string primes;
  std::string differ;
  for (const int teeth : {31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73}) {
    primes += text("[gear.g", teeth, "]\nlike = \"pinion\"\nteeth = ", teeth, "\n");
    differ += text("[gear.g", teeth, ".error]\neccentricity_um = 5\n");
  }
  CHECK(said(primes).empty());
  CHECK(names(said(primes + differ), {"[gear.g41.error]", 47027}));
}

TEST_CASE("what a system makes expensive is said with the key that makes it so, nothing of an ordinary one") {
  const Scene ordinary = read_scene("data/scenes/three-in-line.toml");
  CHECK(costs(ordinary).empty());
  const auto said = [&](const auto& change) {
    Scene scene = ordinary;
    change(scene);
    std::string out;
    for (const std::string& cost : costs(scene)) out += cost + "\n";
    INFO(out);
    return out;
  };
  CHECK(
      contains(said([](Scene& s) { s.contact.strips = 1001; }), "strips = 1001, 128 positions of 2 meshes"));
  const std::string fine = said([](Scene& s) { s.body.element_size = 0.05e-3; });
  for (const char* gear : {"pinion", "idler", "wheel"})
    CHECK(contains(fine, text("gear-reduce, ", gear, " takes about ")));
  CHECK(contains(fine, "element_mm = 0.05 is 0.025 modules"));
  CHECK(contains(said([](Scene& s) { s.time.min_sample_rate = 1e9; }), "min_sample_rate_kHz"));
}

TEST_CASE(
    "what a sweep costs, within a factor of 2.5 of seconds of CPU that were measured: a pair, trains, slices") {
  const auto seconds = [](const auto& scene) { return stage_costs(scene).back().seconds; };
  const auto told = [](double of, double measured) {
    CAPTURE(of);
    CHECK(of > measured / 2.5);
    CHECK(of < measured * 2.5);
  };
  told(seconds(read_scene("data/scenes/parker2000.toml")), 2.9);
  told(seconds(read_scene("data/scenes/helical-17-67.toml")), 3.0);
  told(seconds(read_scene("data/scenes/three-in-line.toml")), 2.5);
  told(seconds(read_scene("data/scenes/oh58-planetary.toml")), 8.9);
  Scene helical = read_scene("data/scenes/helical-planetary.toml");
  told(seconds(helical), 38);
  told(stage_costs(helical).back().memory, 760e6);
  helical.contact.face_points = 8;
  helical.operation.frequency_from = 3250;
  helical.operation.frequency_to = 3700;
  told(seconds(helical), 30);
}

TEST_CASE("mesh periods after which the same teeth meet: errors and cracks count, of pairs and of trains") {
  Scene pair = read_scene("data/scenes/parker2000.toml");
  CHECK(hunting_periods(pair) == 1);
  CHECK(static_positions(pair) == 512);  // as steps_per_period
  pair.gears[1].design.teeth = 51;
  for (SceneGear& gear : pair.gears) gear.design.crack.depth = 1e-3;
  CHECK(hunting_periods(pair) == 2550);
  CHECK(static_positions(pair) == 16);
  CHECK(contains(static_parameters(pair), "positions = 16"));
  Scene train = read_scene("data/scenes/three-in-line.toml");
  train.gears[0].design.crack.depth = 1e-3;
  train.gears[1].errors.iso_class = 5;
  CHECK(hunting_periods(train) == std::lcm(train.gears[0].design.teeth, train.gears[1].design.teeth));
  CHECK(static_parameters_of(train, layout_of(train)).contact.positions == static_positions(train));
}

TEST_CASE("remarks on the motion of a system: contact on lines, a damping that nobody chose") {
  Scene scene = read_scene("data/scenes/three-in-line.toml");
  scene.fidelity.contact = ContactModel::line;
  CHECK(motion_remarks(scene).empty());
  scene.fidelity.contact = ContactModel::strips;
  REQUIRE(motion_remarks(scene).size() == 1);
  CHECK(contains(motion_remarks(scene)[0], "in motion a system has contact = \"line\""));
  scene.damping.rayleigh_stiffness = kDefaultRayleighStiffness;
  REQUIRE(motion_remarks(scene).size() == 2);
  CHECK(contains(motion_remarks(scene)[1], "is for the gears of P2000"));
  scene.operation.frequency_to = 0;
  CHECK(motion_remarks(scene).empty());
}

TEST_CASE(
    "gears without a mesh that run into each other are rejected with their distance and what it has to be") {
  Scene line = read_scene("data/scenes/three-in-line.toml");
  CHECK_NOTHROW(layout_of(line));
  line.meshes[1].direction = 3.14159265358979;
  // Tip circles of 30 and 120 teeth of module 2: 32 and 122 mm.
  CHECK(names(message_of_input([&] { layout_of(line); }),
              {"'pinion'", "'wheel'", "90 mm", "154 mm", "direction_deg"}));
  // A further gear that meshes with the sun of a planetary train: a small one has room midway between planets, but where the carrier
  // is free they come round to it.
  const auto beside = [](int teeth, double degrees, bool free) {
    Scene scene = planetary_train(3);
    SceneGear gear = scene.gears[0];
    gear.name = "pump";
    gear.design = rigid_gear(teeth);
    scene.gears.push_back(gear);
    Scene::Mesh mesh = scene.meshes[0];
    mesh.spec.gear = {"sun", "pump"};
    mesh.spec.centre_distance = 0.5 * (scene.gears[0].design.teeth + teeth) * gear.design.module;
    mesh.direction = degrees * 3.14159265358979 / 180;
    scene.meshes.push_back(mesh);
    if (!free) scene.drives.push_back({"carrier", System::DriveKind::held, 0, 1e9});
    return message_of([&] { layout_of(scene); });
  };
  CHECK(beside(10, 60, false).empty());
  CHECK(names(beside(10, 0, false), {"'pump'", "'planet1'", "positions"}));
  CHECK(names(beside(60, 60, false), {"'pump'", "'planet1'"}));
  CHECK(names(beside(10, 60, true), {"'pump'", "'planet1'"}));
}

TEST_CASE("planets of one carrier that run into each other are told how far apart they have to be") {
  Scene scene = read_scene("data/scenes/oh58-planetary.toml");
  const double step = 2 * 3.14159265358979 / 126;
  // Two tip circles of 102.79 mm on one of 88.9 mm: 2 asin(102.79 / 177.8) = 70.64 degrees.
  scene.carriers[0].positions = {0, 15 * step, 63 * step, 78 * step};
  CHECK(names(message_of_input([&] { layout_of(scene); }),
              {"planets 1 and 2", "carrier", "64.9576 mm", "102.791 mm", "70.6375"}));
}

TEST_CASE("a thin rim of a gear of a train is warned of, with its place; shipped trains have none") {
  const auto where = [](const std::vector<std::string>& sections, const std::string&) {
    return "x.toml: " + sections.front();
  };
  Scene scene = read_scene("data/scenes/oh58-planetary.toml");
  CHECK(scene_warnings(scene, where).empty());
  for (SceneGear& gear : scene.gears)
    if (gear.design.internal)
      gear.design.rim_outer_radius = ToothGeometry(gear.design).root_radius() + 0.5e-3;
  const std::vector<std::string> said = scene_warnings(scene, where);
  REQUIRE(said.size() == 1);
  CHECK(
      said[0].find(
          "x.toml: gear.ring: between the outside of the rim and the root circle of [gear.ring] are 0.5 mm") ==
      0);
}
