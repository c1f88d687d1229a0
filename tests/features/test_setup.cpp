// What is said of numbers that a scene leaves out or gets wrong by a power of ten; where a mesh's compliance comes from.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "base/format.h"
#include "gear/body_inertia.h"
#include "gear/iso6336.h"
#include "gear/scene_geometry.h"
#include "io/scene_keys.h"
#include "io/study.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "studies/study_variant.h"
#include "system/compliance_split.h"

using namespace whine;

namespace {

StaticResult at_rest(double bore) {
  const ReducedBody& body = paper_body(bore, 0.8e-3);
  return static_transmission(body, body, paper_statics(32), 150);
}

bool says(const std::vector<Remark>& remarks, const std::string& words) {
  return std::any_of(remarks.begin(), remarks.end(),
                     [&](const Remark& r) { return r.warning && contains(r.words, words); });
}

}  // namespace

TEST_CASE(
    "compliance: the parts add up, and a wider bore changes the mesh by what the ring between twists less") {
  const StaticResult narrow = at_rest(25e-3), wide = at_rest(27.5e-3);
  const ComplianceSplit& split = narrow.compliance;
  CHECK(split.body[0] + split.body[1] + split.contact + split.teeth() ==
        relative(1 / narrow.mean_stiffness, 1e-12));
  // The twist alone against the whole elastic bodies, both bores a tenth larger: that the ring also moves sideways is the rest.
  const double ring =
      split.body[0] + split.body[1] - 2 * body_twist(narrow.gear[0].design, narrow.gear[0].material, 27.5e-3);
  const double change = 1 / narrow.mean_stiffness - 1 / wide.mean_stiffness;
  CHECK(ring < change);
  CHECK(ring > 0.8 * change);
  CHECK(split.with_wider_bore(0) == relative(0.5 * ring / (split.whole - 0.5 * ring), 1e-9));
  CHECK(split.body_share() > 0.2);
  CHECK(says(remarks(narrow), "of the compliance of the mesh"));
  CHECK_FALSE(says(remarks(at_rest(40e-3)), "of the compliance of the mesh"));
  // Bodies that do not twist: within the 10 % that ISO 6336's own formula claims.
  const auto& [gear, mate] = narrow.gear;
  CHECK(split.single_teeth() ==
        relative(25.4e-3 * iso_6336_stiffness(gear.design, gear.material, mate.design, mate.material, 150,
                                              narrow.contact_ratio)
                               .single,
                 0.15));
}

TEST_CASE("a rim thinner than a module is warned of") {
  StaticResult s = at_rest(40e-3);
  CHECK_FALSE(says(body_remarks(s), "less than a module"));
  s.gear[1].design.bore_radius = ToothGeometry(s.gear[1].design).root_radius() - 0.5e-3;
  CHECK(says(body_remarks(s), "[gear.wheel] are 0.5 mm, less than a module"));
}

TEST_CASE(
    "a thin rim and the inertia of a flywheel are warned of where the scene is read, with their places") {
  Scene scene;
  scene.gears.resize(2);
  scene.gears[0].name = "pinion";
  scene.gears[1].name = "wheel";
  for (SceneGear& gear : scene.gears) {
    gear.design = paper_gear();
    gear.material = paper_steel();
    gear.total_inertia = 0.0148;
  }
  scene.meshes.resize(1);
  scene.mesh().gear = {"pinion", "wheel"};
  scene.mesh().centre_distance = 150e-3;
  std::string section, key;
  const auto where = [&](const std::vector<std::string>& sections, const std::string& words) {
    section = sections.front();
    key = words;
    return std::string("x.toml:7");
  };
  CHECK(scene_warnings(scene, where).empty());
  scene.gears[1].total_inertia = 700;
  scene.gears[0].design.bore_radius = ToothGeometry(paper_gear()).root_radius() - 0.5e-3;
  const std::vector<std::string> said = scene_warnings(scene, where);
  REQUIRE(said.size() == 2);
  CHECK(said[0].find("x.toml:7: between the bore and the root circle of [gear.pinion] are 0.5 mm") == 0);
  CHECK(said[1].find("x.toml:7: total_inertia_kgm2 = 700 of [gear.wheel] is ") == 0);
  CHECK(section == "gear.wheel");
  // 0: as drawn.
  scene.gears[1].total_inertia = 0;
  CHECK(scene_warnings(scene, where).size() == 1);
}

TEST_CASE("torques are told as they were read: a decimal comma makes two of one") {
  CHECK(torques_in_words({1624, 77}) == "torques 1624, 77 N m");
  CHECK(torques_in_words({62.5}) == "torque 62.5 N m");
  CHECK(torques_in_words({1, 2, 3, 4, 5, 6, 7, 8, 9}) == "torques 1, 2, 3, 4, 5, 6, 7, 8, ... N m");
}

TEST_CASE("a face too wide for plane stress is warned of, by gear") {
  StaticResult s = at_rest(40e-3);
  const auto of_face = [&] {
    std::string all;
    for (const Remark& remark : body_remarks(s))
      if (contains(remark.words, "plane = ")) all += remark.words + "; ";
    return all;
  };
  for (auto& gear : s.gear) gear.material.plane_stress = true;
  s.gear[1].design.face_width = 10.1 * s.gear[1].design.module;
  CHECK(of_face().find("the face of wheel is 10.1 modules wide") == 0);
  CHECK(!contains(of_face(), "pinion"));
  s.gear[1].material.plane_stress = false;
  CHECK(of_face().empty());
}

TEST_CASE("the keys of a result hold the tip and root diameters that addendum and dedendum gave") {
  std::map<std::string, std::string> values;
  for (const SceneKeys::Row& key : scene_keys_of(at_rest(40e-3)).rows) values[key.name] = key.value[0];
  CHECK(values["tip_diameter_mm"] == "156");
  CHECK(values["root_diameter_mm"] == "142.5");
  CHECK(values["addendum"] == "1");
}

TEST_CASE(
    "inertias out of all proportion and a damping that nobody chose are warned of; as drawn is the body's own") {
  StaticResult s = at_rest(40e-3);
  const Damping damping;  // eta 0, which somebody chose
  CHECK(setup_remarks(s, {0.0148, 0.0148}, damping, {}).empty());
  CHECK(says(setup_remarks(s, {0.0148, 700}, damping, {}), "total_inertia_kgm2 = 700 of [gear.wheel]"));
  Damping left_out;
  left_out.rayleigh_stiffness = 7.7e-6;
  CHECK(setup_remarks(s, {0.0148, 0.0148}, left_out, {}).empty());  // the pair that it is for
  s.gear[0].design.teeth = 49;
  CHECK(says(setup_remarks(s, {0.0148, 0.0148}, left_out, {}), "the default, is for the gears of P2000"));

  const ReducedBody& body = paper_body(40e-3, 0.8e-3);
  SweepParameters settings;
  settings.inertia[1] = 0.0148;
  as_drawn(settings, {body.inertia, body.inertia});
  CHECK(settings.inertia[0] == relative(1.001 * body.inertia, 1e-12));
  CHECK(settings.inertia[1] == 0.0148);
  SweepParameters by_outline;
  as_outlined(by_outline, at_rest(40e-3));
  CHECK(by_outline.inertia[0] == relative(body.inertia, 0.01));
}

TEST_CASE("a study answers the peak to peak within a mesh period beside that over the hunting period") {
  const ReducedBody& body = paper_body(40e-3, 0.8e-3);
  const auto quantities = [&](double eccentricity) {
    VariantParameters settings;
    settings.statics = paper_statics(16);
    settings.statics.mesh.errors[0].eccentricity = eccentricity;
    settings.torque = 150;
    const Eigen::VectorXd all = variant_response({body, body}, settings, no_report).quantity;
    std::map<std::string, double> out;
    const auto kinds = response_quantities({});
    for (size_t i = 0; i < kinds.size(); ++i) out[kinds[i].name] = all[static_cast<Eigen::Index>(i)];
    return out;
  };
  auto exact = quantities(0), off = quantities(20e-6);
  CHECK(exact["te_peak_to_peak_mesh"] == exact["te_peak_to_peak"]);
  // The run-out swings by 40 micrometres over a turn, by 40 pi / 50 within one of 50 mesh periods, beside what the mesh does.
  CHECK(off["te_peak_to_peak"] > 35e-6);
  CHECK(off["te_peak_to_peak_mesh"] < exact["te_peak_to_peak"] + 1.3 * 40e-6 * std::numbers::pi / 50);
  CHECK(off["te_peak_to_peak_mesh"] > exact["te_peak_to_peak"]);
}
