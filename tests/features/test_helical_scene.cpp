// Scenes of helical, misaligned and lead-modified gears: what they hold, what they are refused with, and that a spur scene says nothing of
// it.
#include <doctest/doctest.h>

#include <numbers>

#include "gear/scene_geometry.h"
#include "io/scene.h"
#include "io/scene_goals.h"
#include "io/scene_remarks.h"
#include "scene_file.h"

using namespace whine;

namespace {

constexpr double kDegreeOfScene = std::numbers::pi / 180;

// A scene of kScene's gears made helical; centre distance 150 / cos 12 deg.
std::string helical_scene(const std::string& hand_of_wheel = "left") {
  std::string out =
      scene_with("pressure_angle_deg = 20\n", "pressure_angle_deg = 20\nhelix_angle_deg = 12\n");
  out.replace(out.find("like = \"pinion\""), 15, "like = \"pinion\"\nhand = \"" + hand_of_wheel + "\"");
  out.replace(out.find("= 150\n"), 6, "= 153.351\n");
  return out + "[fidelity]\nwidth = \"slices\"\n";
}

}  // namespace

TEST_CASE("a helical scene: helix, hand and level, in the scene and in stage parameters") {
  const SceneFile file;
  const Scene scene = file.read(helical_scene() + "[gear.pinion.modification]\nlead_crowning_um = 5\n" +
                                "end_relief_um = 10\nend_relief_length_mm = 2\n");
  CHECK(scene.gear("pinion").design.helix_angle == relative(12 * kDegreeOfScene, 1e-14));
  CHECK(scene.gear("pinion").design.hand == Hand::right);
  CHECK(scene.gear("wheel").design.hand == Hand::left);
  CHECK(scene.gear("pinion").modification.lead.crowning == relative(5e-6, 1e-14));
  const std::string path = file.path(static_parameters(scene), "static.toml");
  const StaticParameters read = read_static_parameters(path);
  CHECK(read.fidelity.width == WidthModel::slices);
  CHECK(read.mesh.modification[0] == scene.mesh().modification[0]);
  CHECK(!read.mesh.modification[0].of_profile());
  const std::string body = file.path(body_parameters(scene, "wheel"), "body.toml");
  CHECK(read_body_parameters(body).design.hand == Hand::left);
  CHECK(read_body_parameters(body).design.helix_angle == scene.gear("wheel").design.helix_angle);
}

TEST_CASE("a scene that leaves the level over the face open: one slice, or bodies in three dimensions") {
  const SceneFile file;
  CHECK(file.read(kScene).fidelity.width == WidthModel::one);
  CHECK(file.read(kScene).body.width.degree == 0);
  std::string helical = helical_scene();
  CHECK(file.read(helical).body.width.degree == 0);
  helical.erase(helical.find("[fidelity]"));
  const Scene open = file.read(helical);
  CHECK(open.fidelity.width == WidthModel::body);
  CHECK(open.body.width.degree == 8);
  const Scene given = file.read(helical + "[discretisation]\nwidth_degree = 5\n");
  CHECK(given.body.width.degree == 5);
  const Scene askew =
      file.read(scene_with("centre_distance_mm = 150", "centre_distance_mm = 150\nmisalignment_um = 10"));
  CHECK(askew.fidelity.width == WidthModel::body);
}

TEST_CASE("a tip diameter of a helical gear is that of its transverse section") {
  const SceneFile file;
  std::string scene = helical_scene();
  scene.replace(scene.find("face_width_mm"), 13, "tip_diameter_mm = 159.3511\nface_width_mm");
  CHECK(file.read(scene).gear("pinion").design.addendum == relative(1, 1e-4));
}

TEST_CASE("a spur scene says nothing of helix, leads or slices") {
  const SceneFile file;
  const Scene scene = file.read(kScene);
  for (const std::string& words :
       {static_parameters(scene), body_parameters(scene, "pinion"), sweep_parameters(scene)})
    for (const char* word : {"helix", "hand", "lead", "width =", "misalignment", "face_points"})
      CHECK(words.find(std::string("\n") + word) == std::string::npos);
}

TEST_CASE(
    "keys of the face width at nothing, or of levels that are not taken, leave the texts of a spur scene") {
  const SceneFile file;
  const Scene bare = file.read(kScene);
  std::string keys =
      scene_with("pressure_angle_deg = 20\n", "pressure_angle_deg = 20\nhelix_angle_deg = 0\n");
  keys.replace(keys.find("driver = "), 9, "misalignment_um = 0\nface_offset_mm = 0\ndriver = ");
  const Scene scene = file.read(
      keys +
      "[gear.wheel.modification]\nlead_crowning_um = 0\nlead_slope_um = 0\nend_relief_um = 0\nend_relief_length_mm = 0\n" +
      "[fidelity]\nwidth = \"one\"\n[discretisation]\nface_points = 12\nsection_element_mm = 2\nwidth_degree = 0\n");
  CHECK(static_parameters(scene) == static_parameters(bare));
  CHECK(sweep_parameters(scene) == sweep_parameters(bare));
  CHECK(impact_parameters(scene) == impact_parameters(bare));
  for (const char* gear : {"pinion", "wheel"})
    CHECK(body_parameters(scene, gear) == body_parameters(bare, gear));
}

TEST_CASE("what helical scenes are refused with") {
  const SceneFile file;
  const auto check = [&](const std::string& text) {
    return message_of_input([&] {
      const std::string path = file.path(text);
      check_scene(read_scene(path), {}, path);
    });
  };
  CHECK(check(helical_scene()).empty());
  CHECK(names(check(helical_scene("right")), {"hand", "left"}));
  CHECK(names(file.rejection(scene_with("bore_radius_mm = 40", "bore_radius_mm = 40\nhand = \"left\"")),
              {"helix_angle_deg"}));
  CHECK(names(file.rejection(std::string(kScene) + "[gear.pinion.modification]\nend_relief_um = 4\n"),
              {"end_relief_length_mm"}));
  CHECK(names(check(helical_scene() + "[gear.pinion.error]\neccentricity_um = 4\n"), {"helix_angle_deg"}));
  CHECK(names(check(helical_scene() + "[gear.pinion.crack]\ndepth_mm = 1\n"), {"helical"}));
}

TEST_CASE("goals of make that a helical or misaligned scene does not reach are named") {
  const SceneFile file;
  const Traits helical = traits(file.read(helical_scene()), {});
  check_goals({"mesh", "reduce", "static", "report", "error-budget", "sweep", "face-load"}, helical,
              "x.toml");
  CHECK(names(message_of_input([&] { check_goals({"teeth"}, helical, "x.toml"); }),
              {"teeth", "[gear.pinion]", 12, "report", "face-load"}));
  for (const char* goal : {"impact", "calibrate", "modes"})
    CHECK(names(message_of_input([&] { check_goals({goal}, helical, "x.toml"); }),
                {goal, "as a train", "torque_Nm", "[[drive]]", "slices"}));
  const Traits askew = traits(
      file.read(scene_with("centre_distance_mm = 150", "centre_distance_mm = 150\nmisalignment_um = 10")),
      {});
  check_goals({"report", "flank-load"}, askew, "x.toml");
  const std::string unmoved = message_of_input([&] { check_goals({"sweep"}, askew, "x.toml"); });
  CHECK(names(unmoved, {"sweep", "misalignment_um = 10", "width = \"slices\"", "static"}));
  CHECK(unmoved.find("face-load") == std::string::npos);
  check_goals({"sweep"}, traits(file.read(kScene), {}), "x.toml");
}

TEST_CASE("sweeps take slices, a ring-down does not; of systems slices alone") {
  const SceneFile file;
  const Scene scene = file.read(std::string(kScene) + "[fidelity]\nwidth = \"slices\"\n");
  CHECK(read_sweep_parameters(file.path(sweep_parameters(scene), "sweep.toml")).fidelity.contact ==
        ContactModel::line);
  const std::string path = file.path(impact_parameters(scene), "impact.toml");
  CHECK(names(message_of_input([&] { read_impact_parameters(path); }), {"width = \"slices\"", "[[drive]]"}));
  const std::string drive = "[[drive]]\ngear = \"pinion\"\nkind = \"torque\"\ntorque_Nm = 1\n";
  std::string train = helical_scene() + drive + "[[drive]]\ngear = \"wheel\"\nkind = \"held\"\n";
  train.erase(train.find("[operation]"), train.find("[fidelity]") - train.find("[operation]"));
  train.replace(train.find("plane = \"stress\""), 16, "plane = \"strain\"");
  const auto system = [&](const std::string& text) {
    return message_of_input([&] { read_scene(file.path(text)); });
  };
  CHECK(system(train).empty());
  CHECK(read_scene(file.path(train)).fidelity.contact == ContactModel::line);
  const auto with = [&](const std::string& what, const std::string& other) {
    std::string out = train;
    out.replace(out.find(what), what.size(), other);
    return out;
  };
  std::string open = train;
  open.erase(open.find("width = "), 17);
  CHECK(read_scene(file.path(open)).fidelity.width == WidthModel::slices);
  CHECK(names(system(with("width = \"slices\"", "width = \"one\"")),
              {"width = \"one\"", "[gear.pinion]", 12, "slices"}));
  CHECK(names(system(with("width = \"slices\"", "width = \"body\"")), {"width = \"body\"", "slices"}));
  CHECK(names(system(with("plane = \"strain\"", "plane = \"stress\"")),
              {"[gear.pinion]", "plane = \"strain\""}));
  CHECK(names(system(train + "[friction]\ncoefficient = 0.05\n"), {"[friction]", "slices", "[gear.pinion]"}));
  CHECK(
      names(system(train + "[gear.pinion.error]\neccentricity_um = 4\n"), {"[gear.pinion.error]", "slices"}));
  CHECK(names(system(with("driver = ", "face_offset_mm = 1\ndriver = ")), {"face_offset_mm", "plane"}));
  const std::string same = message_of_input([&] {
    const std::string at = file.path(with("hand = \"left\"", "hand = \"right\""));
    layout_in(read_scene(at), at);
  });
  CHECK(names(same, {"same hand", "\"right\"", "hand = \"left\""}));
  // What stage parameters hold of it comes back.
  std::string uneven =
      with("driver = ", "misalignment_um = 7\ndriver = ") + "[gear.wheel.modification]\nlead_slope_um = 3\n";
  const std::string path_of_uneven = file.path(uneven);
  const Scene read = read_scene(path_of_uneven);
  const SystemStaticParameters own = static_parameters_of(read, layout_in(read, path_of_uneven)),
                               back = read_system_static_parameters(
                                   file.path(system_static_parameters(own), "static.toml"));
  CHECK(back.fidelity.width == WidthModel::slices);
  CHECK(back.mesh[0].misalignment == own.mesh[0].misalignment);
  CHECK(back.modification("wheel").lead.slope == relative(3e-6, 1e-12));
  CHECK(!back.modification("wheel").of_profile());
}
