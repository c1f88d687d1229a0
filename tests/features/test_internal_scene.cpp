// Internal gears in scenes, stage parameters and artifacts.
#include <doctest/doctest.h>

#include <cmath>

#include "gear/pair.h"
#include "gear/scene_geometry.h"
#include "internal_pair.h"
#include "io/artifacts.h"
#include "refusal.h"
#include "relative.h"
#include "results/reduced_body.h"
#include "results/sector_grid.h"
#include "scene_file.h"
#include "solid/mesher.h"
#include "solid/reduce.h"

using namespace whine;

namespace {

const std::string kRing =
    "like = \"pinion\"\nteeth = 120\ninternal = true\naddendum = 0.8\nrim_outer_radius_mm = 200\n";

std::string with_ring(const std::string& ring = kRing) {
  std::string scene = scene_with("like = \"pinion\"\n", ring);
  return scene.replace(scene.find("centre_distance_mm = 150"), 24, "centre_distance_mm = 105");
}

// kRing with one line replaced.
std::string ring_with(const std::string& old, const std::string& now) {
  std::string ring = kRing;
  return with_ring(ring.replace(ring.find(old), old.size(), now));
}

}  // namespace

TEST_CASE("a scene with an internal gear: what it takes over, what its parameters say, that it meshes") {
  const SceneFile file;
  const Scene scene = file.read(with_ring());
  const GearDesign &pinion = scene.gears[0].design, &ring = scene.gears[1].design;
  CHECK_FALSE(pinion.internal);
  CHECK(ring.internal);
  CHECK(ring.rim_outer_radius == 0.2);
  CHECK(ring.bore_radius == 0);
  CHECK(ring.module == pinion.module);
  check_geometry(scene, [](const std::vector<std::string>&, const std::string&) { return std::string(); });

  const std::string of_pinion = body_parameters(scene, "pinion"), of_ring = body_parameters(scene, "wheel");
  CHECK(contains(of_pinion, "\nbore_radius = 0.04"));
  CHECK(!contains(of_pinion, "rim"));
  CHECK(contains(of_ring, "\n[rim]\ninternal = true\nrim_outer_radius = 0.2  # m\n"));
  CHECK(!contains(of_ring, "bore"));
  const GearDesign read = read_body_parameters(file.path(of_ring, "body.toml")).design;
  CHECK(read.internal);
  CHECK(read.rim_outer_radius == ring.rim_outer_radius);
  CHECK(body_parameters({read, scene.gears[1].material, scene.body}) == of_ring);

  // Diameters as the drawing of a ring has them.
  const Scene drawn = file.read(
      ring_with("addendum = 0.8\n", "profile_shift = 0.1\ntip_diameter_mm = 354\nroot_diameter_mm = 367\n"));
  const ToothGeometry tooth(drawn.gears[1].design);
  CHECK(2 * tooth.tip_radius() == relative(0.354, 1e-13));
  CHECK(2 * tooth.root_radius() == relative(0.367, 1e-13));
}

TEST_CASE("what makes no sense in an internal gear is rejected with its line and a remedy") {
  const SceneFile file;
  CHECK(names(file.rejection(with_ring(kRing + "bore_radius_mm = 30\n")),
              {"x.toml:15", "[gear.wheel]", "bore_radius_mm", "rim_outer_radius_mm"}));
  CHECK(names(file.rejection(ring_with("rim_outer_radius_mm = 200\n", "")),
              {"[gear.wheel]", "rim_outer_radius_mm"}));
  CHECK(names(file.rejection(ring_with("internal = true\n", "")), {"[gear.wheel]", "rim_outer_radius_mm"}));
  CHECK(names(file.rejection(ring_with("internal = true", "internal = \"yes\"")), {"false", "true"}));
  CHECK(names(file.rejection(ring_with("internal = true", "internal = 1")), {"false", "true"}));
  CHECK(names(file.rejection(scene_with("bore_radius_mm = 40\n", "")), {"[gear.pinion]", "bore_radius_mm"}));
  CHECK(names(file.rejection(ring_with("addendum = 0.8\n", "tip_diameter_mm = 370\n")), {"tip_diameter_mm"}));
  CHECK(names(file.rejection(ring_with("rim_outer_radius_mm", "ring_outer_radius_mm")),
              {"rim_outer_radius_mm"}));
  const auto unmeshed = [&](const std::string& text) {
    return message_of([&] {
      check_geometry(file.read(text),
                     [](const std::vector<std::string>&, const std::string&) { return std::string(); });
    });
  };
  CHECK(unmeshed(with_ring()).empty());
  CHECK(names(unmeshed(ring_with("rim_outer_radius_mm = 200", "rim_outer_radius_mm = 180")),
              {"internal", "radius"}));
  CHECK(names(unmeshed(with_ring(kRing + "[gear.wheel.crack]\ndepth_mm = 1\n")), {"crack"}));
  CHECK(unmeshed(with_ring(kRing + "[gear.wheel.error]\neccentricity_um = 10\n")).empty());
}

TEST_CASE(
    "the elastic support of a rim: its parameters come back, a rigid one has none, half a support is rejected") {
  const SceneFile file;
  const std::string radial = "rim_radial_stiffness_N_mm2 = 300\n",
                    tangential = "rim_tangential_stiffness_N_mm2 = 700\n";
  const Scene scene = file.read(with_ring(kRing + radial + tangential));
  const GearDesign& ring = scene.gears[1].design;
  CHECK(ring.elastic_rim());
  CHECK(ring.rim_radial_stiffness == 3e8);
  CHECK(ring.rim_tangential_stiffness == 7e8);
  const std::string parameters = body_parameters(scene, "wheel");
  CHECK(contains(parameters, "\nrim_radial_stiffness = 3e+08  # N m-2\n"));
  const GearDesign read = read_body_parameters(file.path(parameters, "body.toml")).design;
  CHECK(read.rim_radial_stiffness == ring.rim_radial_stiffness);
  CHECK(read.rim_tangential_stiffness == ring.rim_tangential_stiffness);
  CHECK(body_parameters({read, scene.gears[1].material, scene.body}) == parameters);

  BodyDiscretisation coarse;
  coarse.element_size = 2.7e-3;
  coarse.element_order = 1;
  GearDesign supported = ring_gear();
  supported.rim_radial_stiffness = 3e8;
  supported.rim_tangential_stiffness = 7e8;
  const std::string path = file.path("", "mesh.h5");
  write(path, make_sector_mesh(supported, coarse), Provenance());
  CHECK(whine::read<SectorGrid>(path).design.rim_tangential_stiffness == 7e8);

  // As a file of parameters before there were supports.
  CHECK(!contains(body_parameters(file.read(with_ring()), "wheel"), "stiffness"));
  CHECK(body_parameters(file.read(with_ring(kRing + "rim_radial_stiffness_N_mm2 = 0\n")), "wheel") ==
        body_parameters(file.read(with_ring()), "wheel"));

  CHECK(names(file.rejection(with_ring(kRing + radial)),
              {"[gear.wheel]", "rim_radial_stiffness_N_mm2", "rim_tangential_stiffness_N_mm2", 0}));
  CHECK(names(file.rejection(with_ring(kRing + tangential)),
              {"[gear.wheel]", "rim_tangential_stiffness_N_mm2", "rim_radial_stiffness_N_mm2", 0}));
  CHECK(names(file.rejection(scene_with("bore_radius_mm = 40\n", "bore_radius_mm = 40\n" + radial)),
              {"x.toml:7", "[gear.pinion]", "rim_radial_stiffness_N_mm2"}));
  CHECK(names(file.rejection(with_ring(kRing + "rim_radial_stiffness_N_mm2 = 19\n" + tangential)),
              {"x.toml:15", "rim_radial_stiffness_N_mm2", "[gear.wheel]", 19, 20}));
  CHECK(names(file.rejection(with_ring(kRing + "rim_radial_stiffness_N_mm2 = -1\n" + tangential)),
              {"rim_radial_stiffness_N_mm2"}));
}

TEST_CASE("artifacts of an internal gear come back as they were; those of external ones know of no rim") {
  const SceneFile file;
  BodyDiscretisation coarse;
  coarse.element_size = 2.7e-3;
  coarse.element_order = 1;
  const SectorGrid mesh = make_sector_mesh(ring_gear(), coarse);
  const std::string path = file.path("", "mesh.h5");
  write(path, mesh, Provenance());
  const SectorGrid back = whine::read<SectorGrid>(path);
  CHECK(back.design.internal);
  CHECK(back.design.rim_outer_radius == mesh.design.rim_outer_radius);
  CHECK(back.design.bore_radius == 0);
  CHECK(back.node_position == mesh.node_position);
  CHECK(back.bore_node == mesh.bore_node);

  const ReducedBody body = reduce(mesh, {206e9, 0.3, 7850, true}, 1);
  const std::string body_path = file.path("", "body.h5");
  write(body_path, body, Provenance());
  const ReducedBody body_back = whine::read<ReducedBody>(body_path);
  CHECK(body_back.design.internal);
  CHECK(body_back.design.rim_outer_radius == mesh.design.rim_outer_radius);
  CHECK(body_back.flank_position == body.flank_position);

  const std::string external = file.path("", "planet.h5");
  write(external, make_sector_mesh(planet_gear(), coarse), Provenance());
  CHECK_FALSE(whine::read<SectorGrid>(external).design.internal);
  CHECK(whine::read<SectorGrid>(external).design.bore_radius == planet_gear().bore_radius);
}
