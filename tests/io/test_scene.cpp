// Scenes: every wrong one is rejected with the line, the key and the limit; stage parameters follow values and nothing
// else.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <set>
#include <sstream>

#include "base/error.h"
#include "gear/scene_geometry.h"
#include "io/publish.h"
#include "io/scene.h"
#include "io/scene_place.h"
#include "io/scene_remarks.h"
#include "refusal.h"
#include "relative.h"
#include "scene_file.h"
#include "system/near_interference.h"

using namespace whine;
namespace fs = std::filesystem;

TEST_CASE("the standard tooth of P2000 reads as it stands, in SI") {
  const fs::path file =
      fs::path(__FILE__).parent_path().parent_path() / "data/scenes/parker2000-standard-tooth.toml";
  const Scene s = read_scene(fs::exists(file) ? file.string() : "data/scenes/parker2000-standard-tooth.toml");
  REQUIRE(s.gears.size() == 2);
  CHECK(s.gears[0].name == "pinion");
  CHECK(s.gears[1].name == "wheel");
  CHECK(s.gears[1].design.teeth == 50);
  CHECK(s.gears[1].total_inertia == 0.0148);
  CHECK(s.gears[0].design.module == 0.003);  // 3.0 / 1000 rounds to the double nearest to 0.003
  CHECK(s.gears[0].design.pressure_angle == relative(20 * std::numbers::pi / 180, 1e-15));
  CHECK(s.gears[0].design.bore_radius == 0.04);
  CHECK(s.gears[0].material.youngs_modulus == 207e9);
  CHECK(s.gears[0].material.plane_stress);
  CHECK(s.mesh().centre_distance == 0.15);
  CHECK(s.mesh().corner.enabled);
  CHECK(s.mesh().contact_plane ==
        ContactPlane::body);  // its stage parameters, and so its results, are those of one plane state
  CHECK(!contains(static_parameters(s), "contact_plane"));
  CHECK(std::isinf(s.mesh().corner.largest_angle));
  CHECK(s.damping.rayleigh_stiffness == 7.7e-6);
  CHECK(s.operation.torques == std::vector<double>{100, 150, 200, 300});
  CHECK(s.operation.frequency_to == 4000);
  CHECK(s.fidelity.integrator == Integrator::exact);
  CHECK(s.body.modes == 61);
  CHECK(s.body.element_size == relative(0.0004, 1e-15));
  CHECK(s.contact.strips == 8);
  CHECK(s.time.min_sample_rate == 250e3);
}

TEST_CASE(
    "bearings: of a gear by its name, in SI, in the stage parameters of statics; rejected with their line") {
  const SceneFile file;
  const std::string one =
      "[[bearing]]\ngear = \"wheel\"\nstiffness_N_um = 100\ndamping_Ns_m = 900\nmass_kg = 5.5\n";
  const Scene s = file.read(with_section(one));
  CHECK(!s.gear("pinion").bearing.elastic());
  CHECK(!s.mesh().bearing[0].elastic());
  CHECK(s.mesh().bearing[1].stiffness == 1e8);
  CHECK(s.mesh().bearing[1].damping == 900);
  CHECK(s.mesh().bearing[1].mass == 5.5);
  const std::string settings = static_parameters(s);
  CHECK(contains(
      settings,
      "[driven_bearing]\nstiffness = 1e+08  # N m-1\ndamping = 900.0  # N s m-1\nmass = 5.5  # kg\n"));
  CHECK(!contains(settings, "driver_bearing"));
  CHECK(read_static_parameters(file.path(settings, "static.toml")).mesh.bearing[1].stiffness == 1e8);
  CHECK(!read_static_parameters(file.path(settings, "static.toml")).mesh.bearing[0].elastic());
  CHECK(!contains(static_parameters(file.read(kScene)), "bearing"));

  const auto said = [&](const std::string& section, const std::string& part) {
    const std::string message = file.rejection(with_section(section));
    CHECK(contains(message, part));
    CHECK(message.rfind("x.toml:2", 0) == 0);  // the sections begin in line 23
  };
  said("[[bearing]]\ngear = \"wheel\"\n", "lacks 'stiffness_N_um'");
  said("[[bearing]]\ngear = \"whel\"\nstiffness_N_um = 1\n",
       "names no [gear.<name>] section; did you mean 'wheel'");
  said("[[bearing]]\ngear = \"wheel\"\nstiffness_N_um = 0\n", "must be greater than 0 N/µm");
  said("[[bearing]]\ngear = \"wheel\"\nstiffness_N_um = 1e7\n", "must be at most 1000000 N/µm");
  said("[[bearing]]\ngear = \"wheel\"\nstiffnes_N_um = 100\n", "did you mean 'stiffness_N_um'?");
  said("[bearing]\ngear = \"wheel\"\nstiffness_N_um = 100\n", "write [[bearing]]");
  said(one + "[[bearing]]\ngear = \"wheel\"\nstiffness_N_um = 1\n", "has a bearing already");
}

TEST_CASE("keys left out take the defaults of the structs") {
  const SceneFile file;
  const Scene s = file.read(kScene);
  const GearDesign design;
  CHECK(s.gears[0].design.addendum == design.addendum);
  CHECK(s.gears[0].design.dedendum == design.dedendum);
  CHECK(s.gears[0].design.rack_tip_radius == design.rack_tip_radius);
  CHECK(s.damping.undamped_depth == relative(Damping{}.undamped_depth, 1e-15));
  CHECK(s.damping.bearing_ratio == Damping{}.bearing_ratio);
  CHECK(s.fidelity.body == Fidelity{}.body);
  CHECK(s.fidelity.contact == Fidelity{}.contact);
  CHECK(s.fidelity.integrator == Fidelity{}.integrator);
  CHECK(s.body.element_order == BodyDiscretisation{}.element_order);
  CHECK(s.contact.positions == ContactDiscretisation{}.positions);
  CHECK(s.time.steady_state == TimeDiscretisation{}.steady_state);
  CHECK(s.title == "x");
  // Of those that an accepted error chooses, for none.
  const Scene coarse = file.read(with_section("[accuracy]\nrms_percent = 0\n"));
  CHECK(coarse.time.accepted_error == 0);
  CHECK(coarse.body.modes == BodyDiscretisation{}.modes);
  CHECK(coarse.contact.strips == ContactDiscretisation{}.strips);
  CHECK(coarse.time.steps_per_period == TimeDiscretisation{}.steps_per_period);
  CHECK(coarse.time.min_sample_rate == TimeDiscretisation{}.min_sample_rate);
  CHECK(coarse.time.periodicity == TimeDiscretisation{}.periodicity);
  // A scene that says nothing of it accepts 1 %.
  const Scene told = file.read(with_section("[accuracy]\nrms_percent = 1\n"));
  CHECK(s.time.accepted_error == told.time.accepted_error);
  CHECK(s.body.modes == relative(told.body.modes, 0.1));
  CHECK(sweep_parameters(s) != sweep_parameters(coarse));
}

TEST_CASE("lengths that a scene leaves open go with the module of the gear, those that it gives stay") {
  const SceneFile file;
  const auto element = [&](const Scene& s, const std::string& gear) {
    return read_body_parameters(file.path(body_parameters(s, gear), "body.toml")).discretisation;
  };
  const auto of_module = [&](const std::string& module, const std::string& sections = "") {
    return file.read(scene_with("module_mm = 3", "module_mm = " + module) + sections +
                     "[accuracy]\nrms_percent = 0\n");
  };
  const std::string matching = "[discretisation]\nnear_field = \"matching\"\n";
  // Those of the pair of P2000, to the last bit.
  CHECK(element(of_module("3"), "wheel").element_size == 0.4 / 1000);
  CHECK(of_module("3").damping.undamped_depth == 0.5 / 1000);
  CHECK(element(of_module("3", matching), "wheel").matching_depth == 1.0 / 1000);
  for (const double module : {0.4, 20.0}) {
    const std::string word = module < 1 ? "0.4" : "20";
    CHECK(element(of_module(word), "pinion").element_size == relative(module * 1e-3 / 7.5, 1e-14));
    CHECK(element(of_module(word, matching), "pinion").matching_depth == relative(module * 1e-3 / 3, 1e-14));
    // Without matching it is what an error budget tries.
    CHECK(element(of_module(word), "pinion").matching_depth == relative(module * 1e-3 / 3, 1e-14));
    CHECK(of_module(word).damping.undamped_depth == relative(module * 1e-3 / 6, 1e-14));
    const Scene given = of_module(word, matching +
                                            "matching_depth_mm = 0.8\nelement_mm = 0.3\n[damping]\n"
                                            "undamped_depth_mm = 0.7\n");
    CHECK(element(given, "wheel").element_size == relative(0.3e-3, 1e-14));
    CHECK(element(given, "wheel").matching_depth == relative(0.8e-3, 1e-14));
    CHECK(given.damping.undamped_depth == relative(0.7e-3, 1e-14));
  }
  // Each gear by its own module, under an accepted error as well.
  const std::string two = scene_with("like = \"pinion\"", "like = \"pinion\"\nmodule_mm = 6");
  const Scene open = file.read(two + "[accuracy]\nrms_percent = 0\n"), accepting = file.read(two);
  CHECK(element(open, "pinion").element_size == relative(0.4e-3, 1e-14));
  CHECK(element(open, "wheel").element_size == relative(0.8e-3, 1e-14));
  CHECK(element(accepting, "pinion").element_size == relative(3e-3 * accepting.body.element_modules, 1e-14));
  CHECK(element(accepting, "wheel").element_size == relative(6e-3 * accepting.body.element_modules, 1e-14));
}

TEST_CASE("the default rack tip is cut to what fits, a given one is not, nor one taken over") {
  const SceneFile file;
  const auto radius = [&](const std::string& lines, size_t gear) {
    const std::string path =
        file.path(scene_with("pressure_angle_deg = 20", "pressure_angle_deg = 25\n" + lines));
    return std::pair{read_scene(path).gears[gear].design.rack_tip_radius,
                     scene_gives(path, gear ? "gear.wheel" : "gear.pinion", "rack_tip_radius")};
  };
  for (const size_t gear : {0, 1}) {
    CHECK(radius("", gear) == std::pair{0.317, false});
    CHECK(radius("rack_tip_radius = 0.38\n", gear) == std::pair{0.38, true});
  }
}

TEST_CASE("words of other programs that have no key of their own lead to the right one") {
  const SceneFile file;
  const auto said = [&](const std::string& line) {
    return file.rejection(scene_with("face_width_mm", line + " = 1\nface_width_mm"));
  };
  for (const auto& [word, meant] :
       {std::pair{"web_thickness_mm", "did you mean 'bore_radius_mm' (there are no webs"},
        std::pair{"inertia_kgm2", "did you mean 'total_inertia_kgm2'?"},
        std::pair{"inertia_kgmm2", "did you mean 'total_inertia_kgm2' (1 kg mm2 is 1e-6 kg m2)?"},
        std::pair{"profile_shift_mm", "did you mean 'profile_shift' (in modules)?"},
        std::pair{"addendum_mm", "did you mean 'addendum' (in modules)?"},
        std::pair{"dedendum_mm", "did you mean 'dedendum' (in modules)?"},
        std::pair{"hob_tip_radius_mm", "did you mean 'rack_tip_radius' (in modules)?"},
        std::pair{"rim_thickness_mm", "did you mean 'rim_outer_radius_mm' (of an internal gear"},
        std::pair{"undercut", "follows from teeth, profile_shift"},
        std::pair{"shaft", "those that share a shaft are not computed"},
        std::pair{"span_width_mm", "did you mean 'tooth_thinning_mm'"},
        std::pair{"tip_clearance", "did you mean 'dedendum'"},
        std::pair{"name", "it belongs into [[carrier]]"}}) {
    INFO(said(word));
    CHECK(contains(said(word), meant));
  }
}

TEST_CASE("a gear at the top of a scene is told its section, one in no mesh is warned of with its line") {
  const SceneFile file;
  const std::string path = file.path(with_section("[gear.wheel2]\nlike = \"pinion\"\n"));
  const Scene scene = read_scene(path);
  std::string said;
  for (const std::string& line : scene_lines(scene, {}, path)) said += line + "\n";
  CHECK(contains(
      said,
      path +
          ":23: [gear.wheel2] is in no [[mesh]] and carries nothing; gears that share a shaft are not computed"));
}

TEST_CASE("a torque in N mm is named where a thousandth of it passes") {
  const SceneFile file;
  for (const double torque : {80000.0, 200000.0}) {
    const std::string path = file.path(scene_with("[100, 150]", text("[", torque, "]")));
    const std::string said = message_of([&] { check_scene(read_scene(path), {}, path); });
    CHECK(names(said, {"torque_Nm", torque, torque / 1000}));
  }
  const std::string path = file.path(scene_with("[100, 150]", "[200]"));
  CHECK(near_interferences(read_scene(path), {}, ForceBound::least).empty());
}

TEST_CASE("a ring whose diameters ask for the shift of the other sign is told so") {
  const SceneFile file;
  // The tip circle of x = -1.2 by ISO 21771, with handbook sign: the addendum would be 0.8 - 2.4.
  const std::string ring =
      "like = \"pinion\"\nteeth = 120\ninternal = true\nrim_outer_radius_mm = 200\nprofile_shift = 1.2\n"
      "tip_diameter_mm = 362.4\n";
  const std::string said = file.rejection(scene_with("like = \"pinion\"\n", ring));
  CHECK(names(said, {"tip_diameter_mm", "[gear.wheel]", "362.4*"}));
  CHECK(names(said, {"profile_shift", "-1.2"}));
}

TEST_CASE("an empty scene is told what a scene needs") {
  const SceneFile file;
  const std::string said = file.rejection("");
  for (const char* section : {"[gear.<name>]", "[material.<name>]", "[[mesh]]", "[operation]"}) {
    CHECK(contains(said, section));
  }
  CHECK(names(said, {"data/scenes/first-pair.toml"}));
  CHECK(names(file.rejection("# only a comment\n"), {"x.toml", "[gear.<name>]"}));
  CHECK_THROWS_AS(read_scene("/nowhere/x.toml"), Error);
}

TEST_CASE("a missing key is rejected, all of a section in one line") {
  const SceneFile file;
  CHECK(file.read(scene_with("total_inertia_kgm2 = 0.0148", "")).gears[0].total_inertia == 0);  // as drawn
  for (const char* key :
       {"teeth = 50", "pressure_angle_deg = 20", "face_width_mm = 25.4", "bore_radius_mm = 40",
        "material = \"steel\"", "youngs_modulus_GPa = 207", "poisson_ratio = 0.3", "density_kgm3 = 7600",
        "plane = \"stress\"", "driver = \"pinion\"", "driven = \"wheel\"", "centre_distance_mm = 150",
        "torque_Nm = [100, 150]", "mesh_frequency_Hz = { from = 600, to = 4000, step = 20 }",
        ", step = 20"}) {
    const std::string word = std::string(key).substr(key[0] == ',' ? 2 : 0);
    CHECK(names(file.rejection(scene_with(key, "")), {word.substr(0, word.find(' '))}));
  }
}

TEST_CASE("a value outside its range is rejected with value and limit") {
  const SceneFile file;
  CHECK(file.read(scene_with("step = 20", "step = 0.5")).operation.frequency_step == 0.5);
  CHECK(file.read(with_section("[fidelity]\ncontact = \"line\"\n")).fidelity.contact == ContactModel::line);
  for (const char* near_field : {"", "near_field = \"subtraction\"\n"})
    CHECK(contains(
        file.rejection(
            with_section("[discretisation]\n" + std::string(near_field) + "matching_depth_mm = 2.0\n")),
        std::string(*near_field ? "x.toml:25:" : "x.toml:24:") +
            " 'matching_depth_mm' in [discretisation] = 2: near_field is \"subtraction\", which has no depth"));
  CHECK(file.read(with_section("[discretisation]\nmatching_depth_mm = 2.0\nnear_field = \"matching\"\n"))
            .body.matching_depth == 2e-3);
}

TEST_CASE("nan, inf and values of another type are rejected") {
  const SceneFile file;
  for (const char* value : {"nan", "inf", "-inf", "+nan"}) {
    INFO(value);
    CHECK(names(file.rejection(scene_with("module_mm = 3", std::string("module_mm = ") + value)),
                {"finite", "number"}));
    CHECK(names(file.rejection(scene_with("[100, 150]", std::string("[") + value + "]")),
                {"finite", "number"}));
  }
  CHECK(names(file.rejection(std::string("damping = 3\n") + kScene), {"damping"}));
}

TEST_CASE("broken TOML and keys given twice are rejected with the line") {
  const SceneFile file;
  CHECK(names(file.rejection("\xff\xfe"), {"valid", "TOML"}));
}

TEST_CASE("letters beyond ASCII stand in texts and comments, elsewhere they are rejected with the line") {
  const SceneFile file;
  const std::string stray = "is not valid TOML: a character beyond ASCII";
  CHECK(contains(file.rejection(scene_with("teeth = 50", "teeth = 50 µ")), "x.toml:2: " + stray));
  for (const std::string title : {R"("µ" # µ)", R"('\' # "µ)", R"("\"µ" # "µ)", "\"\"\"µ\n\"µ\"\"\"\"\" # µ",
                                  "'''µ\n''' # µ", R"("")"}) {
    CHECK_FALSE(contains(file.rejection("title = " + title + "\n" + kScene), stray));
    CHECK(contains(file.rejection("title = " + title + "\nµ\n" + kScene), stray));
  }
  // Where a text goes on after a backslash at the end of a line.
  CHECK(
      contains(file.rejection("title = \"\"\"a\\\n  µ\"\"\"\n" + std::string(kScene)), "x.toml:2: " + stray));
}

TEST_CASE("names must lead somewhere: gears, materials, like") {
  const SceneFile file;
  for (const std::string place : {"params", "report", "variants", "teeth", "up", "down"})
    CHECK(names(file.rejection(scene_with("[gear.wheel]", "[gear." + place + "]")), {place, "folder"}));
  CHECK(
      names(file.rejection(scene_with("[gear.wheel]", "[gear." + std::string(101, 'w') + "]")), {101, 100}));
  CHECK(names(file.rejection(scene_with("[gear.wheel]", "[gear." + std::string(100, 'w') + "]")),
              {"wheel", "[gear.<name>]"}));
  CHECK(names(file.rejection(with_section(
                  "[[mesh]]\ndriver = \"pinion\"\ndriven = \"wheel\"\ncentre_distance_mm = 150\n")),
              {2, "[[mesh]]"}));
}

TEST_CASE("a torque must survive the name of its folder") {
  const SceneFile file;
  CHECK(file.read(scene_with("[100, 150]", "62.5")).operation.torques == std::vector<double>{62.5});
}

TEST_CASE("like takes over every key and lets own keys override") {
  const SceneFile file;
  const Scene s =
      file.read(scene_with("like = \"pinion\"", "like = \"pinion\"\nteeth = 35\nprofile_shift = 0.25"));
  CHECK(s.gear("wheel").design.teeth == 35);
  CHECK(s.gear("wheel").design.profile_shift == 0.25);
  CHECK(s.gear("wheel").design.module == s.gear("pinion").design.module);
  CHECK(s.gear("pinion").design.teeth == 50);
  CHECK(body_parameters(s, "wheel") != body_parameters(s, "pinion"));
  const Scene twins = file.read(kScene);
  CHECK(body_parameters(twins, "wheel") == body_parameters(twins, "pinion"));
  CHECK_THROWS_AS(twins.gear("idler"), Error);
}

TEST_CASE("the corner rule is on, off, or an angle") {
  const SceneFile file;
  const auto rule = [&](const std::string& value) {
    return file.read(scene_with("driver = \"pinion\"", "driver = \"pinion\"\ncorner_contact = " + value))
        .mesh()
        .corner;
  };
  CHECK(rule("true").enabled);
  CHECK(std::isinf(rule("true").largest_angle));
  CHECK_FALSE(rule("false").enabled);
  CHECK(rule("2.5").largest_angle == relative(2.5 * std::numbers::pi / 180, 1e-15));
}

TEST_CASE("stage parameters depend on values, not on comments, order, spelling or defaults written out") {
  const SceneFile file;
  const Scene plain = file.read(kScene);
  const std::string dressed =
      "# comment\n[discretisation]\nstrips = 8\nelement_order = 2\n[operation]\nmesh_frequency_Hz = { step = 20.0, to = 4e3, from = 600 }\n"
      "torque_Nm = [100.0, 150]\n[[mesh]]\ncentre_distance_mm = 150.0 # c\ndriven = \"wheel\"\ndriver = 'pinion'\n"
      "[material.steel]\nplane = \"stress\"\ndensity_kgm3 = 7.6e3\npoisson_ratio = 0.3\nyoungs_modulus_GPa = 207.0\n"
      "[gear.wheel]\nlike = \"pinion\"\n[gear.pinion]\nmaterial = \"steel\"\naddendum = 1\ntotal_inertia_kgm2 = 0.0148\n"
      "bore_radius_mm = 40.0\nface_width_mm = 25.4\npressure_angle_deg = 20.0\nmodule_mm = 3.0\nteeth = 50\n"
      "[damping]\nbearing_ratio = 5e-3\n";
  const Scene other = file.read(dressed);
  CHECK(body_parameters(plain, "pinion") == body_parameters(other, "pinion"));
  CHECK(static_parameters(plain) == static_parameters(other));
  CHECK(impact_parameters(plain) == impact_parameters(other));
  CHECK(sweep_parameters(plain) == sweep_parameters(other));
}

TEST_CASE("each key moves the stage parameters of the stages that depend on it and no other") {
  const SceneFile file;
  const Scene base = file.read(kScene);
  struct Change {
    std::string scene;
    bool body, statics, impact, sweep;
    bool lumped, lumped_map;
  };
  const auto section = [](const std::string& text) { return with_section(text); };
  const auto mesh_key = [](const std::string& line) {
    return scene_with("driver = \"pinion\"", "driver = \"pinion\"\n" + line);
  };
  // A body that changes redoes the statics by their prerequisites and by the hash in their stage parameters.
  const std::vector<Change> changes = {
      {scene_with("bore_radius_mm = 40", "bore_radius_mm = 39.999999"), true, true, false, false, false,
       false},
      {scene_with("youngs_modulus_GPa = 207", "youngs_modulus_GPa = 206"), true, true, false, true, true,
       true},  // another rate of time steps
      {scene_with("plane = \"stress\"", "plane = \"strain\""), true, true, false, false, false, false},
      {section("[discretisation]\nelement_mm = 0.5\n"), true, true, false, false, false, false},
      {section("[fidelity]\nmodes = 9\n"), true, true, false, false, false, false},
      {section("[fidelity]\nbody = \"relaxed\"\n"), false, false, true, true, false, false},
      {section("[fidelity]\nbody = \"full\"\n"), true, true, true, true, false, false},
      {section("[discretisation]\nnear_field = \"matching\"\n"), true, true, false, false, false, false},
      {mesh_key("corner_contact = false"), false, true, false, false, false, false},
      {mesh_key("contact_plane = \"body\""), false, true, false, false, false, false},
      {mesh_key("contact_plane = \"strain\""), false, false, false, false, false, false},
      {scene_with("centre_distance_mm = 150", "centre_distance_mm = 150.1"), false, true, false, false, false,
       false},
      {section("[gear.pinion.modification]\ncrowning_um = 3\n"), false, true, false, false, false, false},
      {section("[gear.pinion.modification]\ntip_relief_um = 0\n"), false, false, false, false, false, false},
      {section("[discretisation]\nstrips = 21\n"), false, true, false, false, false, false},
      {section("[discretisation]\npositions = 256\n"), false, true, false, false, false, false},
      {scene_with("total_inertia_kgm2 = 0.0148", "total_inertia_kgm2 = 0.02"), false, false, true, true, true,
       true},
      {section("[damping]\nrayleigh_stiffness_s = 5.5e-6\n"), false, false, true, true, false, false},
      {section("[fidelity]\nintegrator = \"newmark\"\n"), false, false, true, true, true,
       true},  // whose rate of time steps has no law
      {section("[fidelity]\ncontact = \"line\"\n"), false, true, true, true, true, true},
      {section("[discretisation]\nperiodicity = 1e-8\n"), false, false, false, true, true, true},
      {section("[discretisation]\nsteady_state = \"integrate\"\n"), false, false, false, true, true, true},
      {scene_with("step = 20", "step = 10"), false, false, false, true, true, false},
      {scene_with("[100, 150]", "[150, 100]"), false, false, true, true, true,
       true},  // another reference torque
      {scene_with("[100, 150]", "[100, 200, 300]"), false, false, false, false, false,
       false},  // torques are paths, not parameters
      {std::string("title = \"other\"\n") + kScene, false, false, false, false, false, false},
  };
  for (const Change& change : changes) {
    INFO(change.scene);
    const Scene s = file.read(change.scene);
    CHECK((body_parameters(s, "pinion") != body_parameters(base, "pinion")) == change.body);
    CHECK((static_parameters(s) != static_parameters(base)) == change.statics);
    CHECK((impact_parameters(s) != impact_parameters(base)) == change.impact);
    CHECK((sweep_parameters(s) != sweep_parameters(base)) == change.sweep);
    CHECK((lumped_parameters(s, true) != lumped_parameters(base, true)) == change.lumped);
    CHECK((lumped_parameters(s, false) != lumped_parameters(base, false)) == change.lumped_map);
  }
}

TEST_CASE("body = \"full\" takes every mode, whatever 'modes' says; the ladder ends there") {
  const SceneFile file;
  const Scene many = file.read(with_section("[fidelity]\nbody = \"full\"\nmodes = 9\n"));
  CHECK(many.body.modes == kAllModes);
  CHECK(body_parameters(many, "wheel") ==
        body_parameters(file.read(with_section("[fidelity]\nbody = \"full\"\nmodes = 61\n")), "wheel"));
  CHECK(read_body_parameters(file.path(body_parameters(many, "wheel"), "body.toml")).discretisation.modes ==
        kAllModes);
  std::string ladder;
  for (std::optional level = BodyModel::rigid; level; level = next_of(*level))
    ladder += name_of(*level) + " ";
  CHECK(ladder == "rigid quasi-static relaxed modal full ");
  CHECK(next_of(ContactModel::line) == ContactModel::strips);
  CHECK(!next_of(ContactModel::strips));
  CHECK(choice_of<ContactModel>("line") == ContactModel::line);
  CHECK(!choice_of<ContactModel>("glue"));
}

TEST_CASE("stage parameters read back bit by bit") {
  const SceneFile file;
  const Scene s = file.read(
      scene_with("driver = \"pinion\"", "driver = \"pinion\"\ncorner_contact = 1.7") +
      "[damping]\nrayleigh_mass_per_s = 0.7\nrayleigh_stiffness_s = 5.55555e-6\nundamped_depth_mm = 0.37\n"
      "[fidelity]\nbody = \"relaxed\"\nintegrator = \"newmark\"\nmodes = 11\n"
      "[discretisation]\nelement_mm = 0.37\nmin_sample_rate_kHz = 333.3\nsteps_per_period = 200\n"
      "near_field = \"matching\"\nmatching_depth_mm = 0.77\n");
  const BodyParameters body = read_body_parameters(file.path(body_parameters(s, "wheel"), "body.toml"));
  const SceneGear& wheel = s.gear("wheel");
  CHECK(body.design.teeth == wheel.design.teeth);
  CHECK(body.design.module == wheel.design.module);
  CHECK(body.design.pressure_angle == wheel.design.pressure_angle);
  CHECK(body.design.face_width == wheel.design.face_width);
  CHECK(body.design.bore_radius == wheel.design.bore_radius);
  CHECK(body.design.rack_tip_radius == wheel.design.rack_tip_radius);
  CHECK(body.material.youngs_modulus == wheel.material.youngs_modulus);
  CHECK(body.material.density == wheel.material.density);
  CHECK(body.material.plane_stress);
  CHECK(body.discretisation.element_size == s.body.element_size);
  CHECK(body.discretisation.element_order == 2);
  CHECK(body.discretisation.modes == 11);
  CHECK(body.discretisation.near_field == NearField::matching);
  CHECK(body.discretisation.matching_depth == s.body.matching_depth);

  const StaticParameters statics = read_static_parameters(file.path(static_parameters(s), "static.toml"));
  CHECK(statics.mesh.gear[0] == "pinion");
  CHECK(statics.mesh.gear[1] == "wheel");
  CHECK(statics.mesh.centre_distance == s.mesh().centre_distance);
  CHECK(statics.mesh.corner.enabled);
  CHECK(statics.mesh.corner.largest_angle == s.mesh().corner.largest_angle);
  CHECK(statics.mesh.contact_plane == ContactPlane::strain);  // the default
  CHECK(statics.fidelity.contact == ContactModel::strips);
  CHECK(statics.contact.strips == 8);
  CHECK(statics.body[0] == body_hash(body_parameters(s, "pinion")));
  CHECK(statics.body[1] == body_hash(body_parameters(s, "wheel")));
  CHECK(statics.body[0] == body_hash(body_parameters(
                               BodyParameters{s.gear("pinion").design, s.gear("pinion").material, s.body})));
  CHECK(statics.contact.positions == 200);  // resolved: as steps_per_period, which is above 128

  const SweepParameters sweep = read_sweep_parameters(file.path(sweep_parameters(s), "sweep.toml"));
  CHECK(sweep.inertia[0] == 0.0148);
  CHECK(sweep.inertia[1] == 0.0148);
  CHECK(sweep.damping.rayleigh_mass == 0.7);
  CHECK(sweep.damping.rayleigh_stiffness == s.damping.rayleigh_stiffness);
  CHECK(sweep.damping.undamped_depth == s.damping.undamped_depth);
  CHECK(sweep.damping.bearing_ratio == s.damping.bearing_ratio);
  CHECK(sweep.reference_torque == 100);
  CHECK(sweep.frequency_from == 600);
  CHECK(sweep.frequency_to == 4000);
  CHECK(sweep.frequency_step == 20);
  CHECK(sweep.fidelity.body == BodyModel::relaxed);
  CHECK(sweep.fidelity.integrator == Integrator::newmark);
  CHECK(sweep.time.steps_per_period == 200);
  CHECK(sweep.time.min_sample_rate == s.time.min_sample_rate);
  CHECK(sweep.time.periodicity == s.time.periodicity);
  CHECK(sweep.time.steady_state == s.time.steady_state);

  const SweepParameters impact = read_impact_parameters(file.path(impact_parameters(s), "impact.toml"));
  CHECK(impact.inertia[0] == 0.0148);
  CHECK(impact.inertia[1] == 0.0148);
  CHECK(impact.damping.rayleigh_mass == 0.7);
  CHECK(impact.damping.rayleigh_stiffness == s.damping.rayleigh_stiffness);
  CHECK(impact.damping.undamped_depth == s.damping.undamped_depth);
  CHECK(impact.damping.bearing_ratio == s.damping.bearing_ratio);
  CHECK(impact.reference_torque == 100);
  CHECK(impact.fidelity.body == BodyModel::relaxed);
  CHECK(impact.fidelity.integrator == Integrator::newmark);

  const SweepParameters lumped =
      read_lumped_parameters(file.path(lumped_parameters(s, true), "lumped.toml"), true);
  CHECK(lumped.inertia[0] == 0.0148);
  CHECK(lumped.inertia[1] == 0.0148);
  CHECK(lumped.reference_torque == 100);
  CHECK(lumped.frequency_to == 4000);
  CHECK(lumped.fidelity.contact == ContactModel::strips);
  CHECK(lumped.time.steps_per_period == 200);
  CHECK(
      read_lumped_parameters(file.path(lumped_parameters(s, false), "lumped_map.toml"), false).frequency_to ==
      0);
  // stage parameters of an elastic sweep holds all of it
  CHECK(read_lumped_parameters(file.path(sweep_parameters(s), "sweep.toml"), true).frequency_step == 20);
  CHECK_THROWS_AS(read_lumped_parameters(file.path(lumped_parameters(s, false), "lumped_map.toml"), true),
                  Error);
  const std::string said = message_of([&] { read_static_parameters(file.path(kScene, "whole.toml")); });
  CHECK(names(said, {"whole", "scene"}));
  CHECK(names(said, {"out/whole/params/static.toml"}));

  CHECK_THROWS_AS(read_sweep_parameters(file.path(static_parameters(s), "wrong.toml")), Error);
  // That of a sweep has all keys of a ring-down's, and that of a map another damping.
  CHECK(names(message_of([&] { read_impact_parameters(file.path(sweep_parameters(s), "sweep.toml")); }),
              {"depends", "sweep"}));
  CHECK(names(message_of([&] { read_impact_parameters(file.path(map_parameters(s), "map.toml")); }),
              {"/params/impact.toml"}));
  CHECK_THROWS_AS(read_map_parameters(file.path(sweep_parameters(s), "sweep.toml")), Error);
  CHECK_THROWS_AS(read_sweep_parameters(file.path(lumped_parameters(s, true), "lumped.toml")), Error);
  CHECK_THROWS_AS(read_impact_parameters(file.path(static_parameters(s), "wrong.toml")), Error);
  CHECK(body_hash(body_parameters(s, "wheel")).size() == 16);
  CHECK(body_hash(body_parameters(s, "wheel")) == sha256(body_parameters(s, "wheel")).substr(0, 16));
}

TEST_CASE("modifications of flanks: units, taken over by like, own starts take the place of others") {
  const SceneFile file;
  const std::string relief =
      "[gear.pinion.modification]\ntip_relief_um = 10\ntip_relief_start_deg = 20.9\nroot_relief_um = 4\n"
      "root_relief_length_mm = 1.5\nroot_relief_shape = \"parabolic\"\nslope_um = -2\n"
      "points = [[15, 0], [20.5, 1.25], [27, -3]]\n";
  const Scene s =
      file.read(kScene + relief + "[gear.wheel.modification]\ntip_relief_start_radius_mm = 76.5\n");
  const FlankModification& pinion = s.gear("pinion").modification;
  CHECK(pinion.tip.amount == 10e-6);
  CHECK(pinion.tip.start_roll == 20.9 * std::numbers::pi / 180);
  CHECK(pinion.tip.shape == ReliefShape::linear);
  CHECK(pinion.root.amount == 4e-6);
  CHECK(pinion.root.length == 1.5e-3);
  CHECK(pinion.root.shape == ReliefShape::parabolic);
  CHECK(pinion.slope == -2e-6);
  REQUIRE(pinion.points.size() == 3);
  CHECK(pinion.points[1] == std::array<double, 2>{20.5 * std::numbers::pi / 180, 1.25e-6});
  FlankModification wheel = pinion;
  wheel.tip.start_roll = 0;
  wheel.tip.start_radius = 76.5 / 1000;
  CHECK(s.gear("wheel").modification == wheel);
  CHECK(s.mesh().modification[0] == pinion);
  CHECK(s.mesh().modification[1] == wheel);
  const StaticParameters settings = read_static_parameters(file.path(static_parameters(s), "static.toml"));
  CHECK(settings.mesh.modification == s.mesh().modification);
  CHECK(body_parameters(s, "wheel") == body_parameters(file.read(kScene), "wheel"));
  CHECK(!contains(static_parameters(file.read(kScene)), "modification"));
}

TEST_CASE("modifications of flanks are rejected with key, value and limit") {
  const SceneFile file;
  const auto rejection = [&](const std::string& keys) {
    return file.rejection(kScene + ("[gear.pinion.modification]\n" + keys + "\n"));
  };
  CHECK(names(rejection("tip_relief_um = 10"), {"tip_relief_um", 10}));
  CHECK(names(rejection("tip_relief_um = -1\ntip_relief_start_deg = 22"),
              {"tip_relief_um", "[gear.pinion.modification]", "-1", 0}));
  CHECK(names(rejection("tip_relief_um = 5\ntip_relief_start_deg = 22\ntip_relief_length_mm = 2"),
              {"tip_relief", 2}));
  CHECK(names(rejection("tip_relief_um = 5\ntip_relief_start_deg = 22\ntip_relief_shape = \"cubic\""),
              {"parabolic", "linear"}));
  CHECK(names(rejection("points = [[20, 0], [19, 1]]"), {"points", "ascend"}));
  CHECK(names(rejection("points = [[20, 0]]"), {"points", "least"}));
  CHECK(names(rejection("points = [[20, 0, 1], [21, 1]]"), {"degrees", "point"}));
  CHECK(names(rejection("points = [[20, 0], [21, 2000]]"), {"-1000", 1000}));
  CHECK(names(rejection("points = 3"), {"points", "list"}));
  CHECK(names(rejection("crowning_mm = 3"), {"crowning_um"}));
}

TEST_CASE("the key table holds every key once, with its meaning") {
  const std::string table = scene_key_table();
  for (const char* key : {"teeth", "module_mm", "corner_contact", "rayleigh_stiffness_s", "torque_Nm",
                          "mesh_frequency_Hz", "periodicity", "like"}) {
    INFO(key);
    CHECK(contains(table, std::string("`") + key + "` |"));
  }
  std::set<std::string> seen;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    INFO(line);
    CHECK(std::count(line.begin(), line.end(), '|') == 6);
    CHECK(seen.insert(line.substr(0, line.find('|', line.find('|', 1) + 1))).second);
  }
}

namespace {

// [gear.wheel.error] with a list of 50 numbers, the first three as given, and other lines.
std::string with_errors(const std::string& key, const std::string& first_three,
                        const std::string& lines = "") {
  std::string zeros;
  for (int i = 3; i < 50; ++i) zeros += ", 0";
  return with_section("[gear.wheel.error]\n" +
                      (key.empty() ? "" : key + " = [" + first_three + zeros + "]\n") + lines);
}

}  // namespace

TEST_CASE("errors of teeth: lists in SI, a gear's own, in the static stage parameters and in no body") {
  const SceneFile file;
  const Scene plain = file.read(kScene),
              scene = file.read(with_errors("single_pitch_um", "1, -1.5, 0.5", "iso_class = 5\nseed = 7\n"));
  const ToothErrors& errors = scene.gear("wheel").errors;
  REQUIRE(errors.single_pitch.size() == 50);
  CHECK(errors.single_pitch[1] == -1.5e-6);
  CHECK(errors.iso_class == 5);
  CHECK(errors.seed == 7);
  CHECK(errors.profile_form_waves == 3);
  CHECK(scene.gear("pinion").errors.none());
  CHECK(scene.mesh().errors[1].single_pitch == errors.single_pitch);
  CHECK(body_parameters(scene, "wheel") == body_parameters(plain, "wheel"));
  CHECK(static_parameters(scene) != static_parameters(plain));
  const StaticParameters back = read_static_parameters(file.path(static_parameters(scene), "static.toml"));
  CHECK(back.mesh.errors[1].single_pitch == errors.single_pitch);
  CHECK(back.mesh.errors[1].iso_class == 5);
  CHECK(back.mesh.errors[1].iso_share == 1);
  CHECK(back.mesh.errors[0].none());
  CHECK(back.contact.positions == 128);
  CHECK(static_parameters(file.read(with_errors("single_pitch_um", "0, 0, 0"))) == static_parameters(plain));
  // 29 and 50 teeth: 1450 mesh periods.
  const std::string uneven = scene_with("like = \"pinion\"", "like = \"pinion\"\nteeth = 29") +
                             "[gear.pinion.error]\niso_class = 5\n[gear.wheel.error]\niso_class = 5\n";
  CHECK(read_static_parameters(file.path(static_parameters(file.read(uneven)), "static.toml"))
            .contact.positions == 16);
  // A gear that is like another has errors of its own.
  CHECK(file.read(with_section("[gear.pinion.error]\niso_class = 5\n")).gear("wheel").errors.none());
}

TEST_CASE("errors of teeth: what is wrong with them is rejected by name") {
  const SceneFile file;
  CHECK(names(file.rejection(with_errors("profile_slope_um", "0, 2000, 0")), {1000, "most"}));
}

TEST_CASE("errors of teeth from a measured file, as TOML and as CSV, beside the scene") {
  const SceneFile file;
  const std::string small = scene_with("teeth = 50", "teeth = 5"), names = "[gear.wheel.error]\nfile = ";
  file.path("cumulative_pitch_um = [0, 1.5, -2, 3, 0.5]\nprofile_slope_um = [1, 1, 1, 1, 1]\n", "teeth.toml");
  file.path(
      "# measured\ntooth, cumulative_pitch_um, profile_slope_um\n0, 0, 1\n1, 1.5, 1\n2, -2, 1\n3, 3, 1\n4, 0.5, 1\n",
      "teeth.csv");
  for (const char* name : {"teeth.toml", "teeth.csv"}) {
    const ToothErrors errors =
        file.read(small + names + "\"" + name + "\"\neccentricity_um = 4\n").gear("wheel").errors;
    CHECK(errors.cumulative_pitch == std::vector<double>{0, 1.5e-6, -2e-6, 3e-6, 0.5e-6});
    CHECK(errors.profile_slope == std::vector<double>(5, 1e-6));
    CHECK(errors.eccentricity == 4e-6);
  }
  const auto rejected = [&](const std::string& bytes, const std::string& name = "bad.csv") {
    file.path(bytes, name);
    return file.rejection(small + names + "\"" + name + "\"\n");
  };
  CHECK(whine::names(rejected("number, profile_slope_um\n"), {"bad.csv:1"}));
  CHECK(whine::names(rejected("tooth, profile_slope_um\n0, 1\n2, 1\n"), {"bad.csv:3", 2, 1}));
  CHECK(whine::names(rejected("tooth, profile_slope_um\n0, 1, 5\n"), {"bad.csv:2", 3, 2}));
  CHECK(whine::names(rejected("tooth, profile_slope_um\n0, x\n"), {"bad.csv:2", "x"}));
  CHECK(
      whine::names(rejected("# sheet 7\ntooth, profil_slope_um\n0, 1\n"), {"bad.csv:2", "profil_slope_um"}));
  CHECK(whine::names(rejected("tooth, profile_slope_um\n0, 1\n\n1, 5000\n"), {"bad.csv:4"}));
  CHECK(whine::names(rejected("tooth, profile_slop_um\n0, 1\n"), {"profile_slope_um"}));
  CHECK(whine::names(rejected("tooth, profile_slope_um\n0, 1\n"), {1, 5}));
  CHECK(whine::names(rejected("1", "bad.txt"), {".toml", ".csv"}));
  CHECK_THROWS_AS(file.read(small + names + "\"none.csv\"\n"), Error);
}

TEST_CASE("what only the geometry rejects is named with the line of its key, through like, too") {
  SceneFile file;
  const auto rejected = [&](const std::string& scene, bool is_file = true) {
    const std::string path = file.path(scene);
    return message_of_input([&] {
      const auto where = [&](const std::vector<std::string>& sections, const std::string& words) {
        return is_file ? scene_place(path, sections, words) : path;
      };
      check_geometry(read_scene(path), where);
      check_inertia(read_scene(path), where);
    });
  };
  CHECK(rejected(kScene).empty());
  CHECK(names(rejected(scene_with("bore_radius_mm = 40", "bore_radius_mm = 74")),
              {"x.toml:6", "[gear.pinion]", "bore_radius_mm", 74, "root radius"}));
  const std::string jammed = scene_with("centre_distance_mm = 150", "centre_distance_mm = 149");
  CHECK(names(rejected(jammed), {"x.toml:19", "[[mesh]]", "jam"}));
  CHECK(names(rejected(jammed, false), {"x.toml: [[mesh]]", "jam"}));
  // Of the wheel its own section, not that of the pinion, which it is like.
  const std::string like = "like = \"pinion\"";
  CHECK(names(rejected(scene_with(like, like + "\nmodule_mm = 3.02")),
              {"x.toml:11", "[[mesh]]", "base pitches"}));
  CHECK(names(rejected(scene_with(like, like + "\ntotal_inertia_kgm2 = 0.001")),
              {"x.toml:11", "[gear.wheel]", "total_inertia_kgm2", "0.001"}));
  CHECK(names(rejected(scene_with("total_inertia_kgm2 = 0.0148", "total_inertia_kgm2 = 0.001")),
              {"x.toml:7", "[gear.pinion]", "total_inertia_kgm2", "0.001"}));
  // Undercut is remarked, and 8 teeth have a root below the bore.
  CHECK(names(rejected(scene_with("teeth = 50", "teeth = 8")),
              {"x.toml:6", "[gear.pinion]", "bore_radius_mm", 40}));

  const std::string path = file.path(kScene);
  CHECK(scene_place(path, {"gear.wheel"}, "raise face_width_mm") == path + ":5");  // by like
  CHECK(scene_place(path, {"gear.wheel"}, "no key of it") == path + ":9");
  CHECK(scene_place(path, {"gear.hub"}, "teeth") == path);
  CHECK(scene_place("no/such.toml", {"gear.hub"}, "teeth") == "no/such.toml");
}
