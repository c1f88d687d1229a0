// Gears of unequal face widths: contact over the common one, teeth on what carries, bodies and modes in their own.
#include <doctest/doctest.h>

#include <cmath>

#include "elastic_train.h"
#include "gear/face_width.h"
#include "gear/scene_geometry.h"
#include "lumped/stiffness.h"
#include "paper_pair.h"
#include "relative.h"
#include "system/loaded_pair.h"

using namespace whine;
using Eigen::MatrixXd;

namespace {

// The same gear of another width: a plane body's stiffness, mass and inertia go with it.
ReducedBody of_width(ReducedBody body, double width) {
  const double wider = width / body.design.face_width, root = std::sqrt(wider);
  body.design.face_width = width;
  for (double* x : {&body.inertia, &body.mass}) *x *= wider;
  for (MatrixRM& r : body.compliance) r /= wider;
  for (MatrixRM& r : body.root_stress) r /= wider;
  body.far_compliance /= wider;
  body.back_compliance /= wider;
  body.flank_mode /= root;
  body.back_flank_mode /= root;
  body.inertia_coupling *= root;
  body.translation_coupling *= root;
  return body;
}

constexpr double kNarrow = 15e-3, kWide = 40e-3, kCarries = kNarrow + 2 * 3e-3;  // m; module 3 mm

ReducedBody paper_body_of(double width) {
  return of_width(paper_body(40e-3, 1.2e-3, 12), width);
}

StaticResult at_rest(double driver, double driven, ContactModel contact = ContactModel::line) {
  StaticParameters settings = paper_statics(8);
  settings.fidelity.contact = contact;
  return static_transmission(paper_body_of(driver), paper_body_of(driven), settings, 150);
}

}  // namespace

TEST_CASE("face widths: a body of another width is the one that is reduced in it") {
  BodyDiscretisation coarse;
  coarse.element_size = 1.2e-3;
  coarse.modes = 12;
  GearDesign design = paper_gear();
  design.face_width = kWide;
  const ReducedBody drawn = reduce(make_sector_mesh(design, coarse), paper_steel(), coarse.modes),
                    scaled = paper_body_of(kWide);
  CHECK((drawn.compliance[1] - scaled.compliance[1]).norm() < 1e-9 * scaled.compliance[1].norm());
  CHECK((drawn.root_stress[3] - scaled.root_stress[3]).norm() < 1e-9 * scaled.root_stress[3].norm());
  CHECK(drawn.inertia == relative(scaled.inertia, 1e-9));
}

TEST_CASE("unequal face widths: pressure and width of the contact are those of the narrower gear's pair") {
  const StaticResult even = at_rest(kNarrow, kNarrow), wide = at_rest(kWide, kNarrow);
  for (Eigen::Index i = 0; i < even.tooth_load.rows(); ++i)
    for (Eigen::Index k = 0; k < even.tooth_load.cols(); ++k) {
      if (!(wide.contact_pressure(i, k) > 0)) continue;
      // Hertz: p^2 goes with the load, w with the load over p.
      const double ratio = wide.tooth_load(i, k) / even.tooth_load(i, k);
      CHECK(wide.contact_pressure(i, k) / even.contact_pressure(i, k) == relative(std::sqrt(ratio), 1e-9));
      CHECK(wide.contact_half_width(i, k) / even.contact_half_width(i, k) ==
            relative(std::sqrt(ratio), 1e-9));
    }
  // One pair at the pitch point carries all.
  CHECK(wide.contact_pressure(0, 1) == relative(even.contact_pressure(0, 1), 1e-9));
}

TEST_CASE("unequal face widths: the mesh is as stiff whichever gear drives, between what bounds it") {
  for (const ContactModel contact : {ContactModel::line, ContactModel::strips}) {
    const auto stiffness = [&](double driver, double driven) {
      return at_rest(driver, driven, contact).mean_stiffness;
    };
    const double wide = stiffness(kWide, kNarrow);
    CHECK(wide == relative(stiffness(kNarrow, kWide), contact == ContactModel::line ? 1e-9 : 1e-4));
    CHECK(wide > 1.1 * stiffness(kNarrow, kNarrow));
    CHECK(wide < stiffness(kCarries, kCarries));
    // The body under the teeth has the whole width, which a gear as wide as what carries has not.
    const double carries = stiffness(kCarries, kNarrow);
    CHECK(wide > carries);
    CHECK(wide < 1.08 * carries);
    CHECK(stiffness(2 * kWide, kNarrow) > wide);
  }
}

TEST_CASE("unequal face widths: nothing jumps where the widths become equal, and equal ones change no bit") {
  const ElasticGear whole(paper_body_of(kWide));
  CHECK(whole.in_mesh(kWide).compliance(0, 1e-3) == whole.compliance(0, 1e-3));
  CHECK(whole.in_mesh(kWide).concentration() == 1);
  CHECK(whole.in_mesh(0.9999 * kWide).compliance(0, 1e-3)(3, 4) ==
        relative(whole.compliance(0, 1e-3)(3, 4), 1e-3));
  CHECK(whole.in_mesh(kWide - 2 * 3e-3).concentration() == relative(1, 1e-12));
  CHECK(whole.in_mesh(kNarrow).concentration() == relative(kWide / kCarries, 1e-12));
  CHECK(at_rest(kWide, 0.9999 * kWide).mean_stiffness ==
        relative(at_rest(kWide, kWide).mean_stiffness, 2e-4));
}

TEST_CASE("unequal face widths: roots carry on a module more to either side, as in ISO 6336-3") {
  const StaticResult even = at_rest(kNarrow, kNarrow), wide = at_rest(kWide, kNarrow);
  // One pair at the pitch point.
  CHECK(wide.root_stress[0](0, 1) * kCarries == relative(even.root_stress[0](0, 1) * kNarrow, 1e-9));
  CHECK(wide.root_stress[1](0, 1) == relative(even.root_stress[1](0, 1), 1e-9));
}

TEST_CASE("unequal face widths: what a narrow contact adds to a tooth stands in the residual, modes stay") {
  const ElasticGear whole(paper_body_of(kWide)), seen = whole.in_mesh(kNarrow);
  const std::vector<int> kept{0, 1, 2};
  const MatrixXd more = seen.compliance(0, 1e-3) - whole.compliance(0, 1e-3);
  CHECK((seen.residual(0, 1e-3, kept) - whole.residual(0, 1e-3, kept) - more).norm() < 1e-12 * more.norm());
  CHECK(seen.residual(1, 1e-3, kept) == whole.residual(1, 1e-3, kept));
  // With the half-plane of the contact down to the depth it is a flexibility.
  const MatrixXd local = seen.narrow_change();
  CHECK(local == MatrixXd(local.transpose()));
  CHECK(local.diagonal().minCoeff() > 0);
}

TEST_CASE("unequal face widths: chords of Hertz's law in a lumped model are those of the common width") {
  Eigen::VectorXi numbers;
  const StaticResult wide = at_rest(kWide, kNarrow);
  StaticResult as_narrow = wide;
  as_narrow.gear[0].design.face_width = kNarrow;
  CHECK(cells_of_pairs(wide, 8, numbers, 4).stiffness == cells_of_pairs(as_narrow, 8, numbers, 4).stiffness);
}

TEST_CASE("unequal face widths: flanks of the loaded gears close by the whole field") {
  BodyDiscretisation coarse;
  coarse.element_size = 0.8e-3;
  GearDesign narrow = paper_gear(), wide = paper_gear();
  narrow.face_width = kNarrow;
  wide.face_width = kWide;
  const SectorGrid mesh[2] = {make_sector_mesh(wide, coarse), make_sector_mesh(narrow, coarse)};
  const ReducedBody body = reduce(mesh[0], paper_steel(), 0), other = of_width(body, kNarrow);
  const StaticResult statics = static_transmission(body, other, paper_statics(4), 150);
  for (const double phase : {0.0, 0.5}) {
    const LoadedResult at = loaded_pair(mesh[0], mesh[1], body, other, statics, phase, 0);
    Eigen::Index i = 0;
    for (const ContactZone& zone : contact_zones(body, other, statics, phase, 0)) {
      if (!(zone.force.sum() > 0)) continue;
      for (int k = 0; k < zone.strips.size(); ++k, ++i) {
        const double gap = zone.strips.gap[k] + at.strip_deflection.row(i).sum() -
                           zone.approach * zone.strips.contact.lever[0] / ToothGeometry(narrow).base_radius();
        CHECK(std::abs(gap - at.strip_separation[i]) < 0.005 * at.transmission_error);
      }
    }
  }
}

TEST_CASE("a planetary train of three face widths: forces at rest are those of its statics") {
  const SystemModel even = train({26, 37, 100});
  const std::array<int, 3> teeth{26, 37, 100};
  const std::array<double, 3> width{60e-3, 25e-3, 12e-3};
  std::vector<ReducedBody> bodies;
  for (const System::Body& body : even.layout.bodies)
    for (size_t g = 0; g < 3; ++g)
      if (body.kind == System::BodyKind::gear && body.teeth == teeth[g])
        bodies.push_back(of_width(train_body(teeth[g], g == 2), width[g]));
  GearMeshSpec spec;
  spec.centre_distance = 0.5 * (teeth[0] + teeth[1]) * kTrainModule;
  System layout = even.layout;
  for (System::Body& body : layout.bodies)
    if (body.teeth == teeth[0] || body.teeth == teeth[1]) {
      const size_t g = body.teeth == teeth[0] ? 0 : 1;
      body.inertia = 1.02 * of_width(train_body(teeth[g], false), width[g]).inertia;
      body.bearing.mass = of_width(train_body(teeth[g], false), width[g]).mass;
    }
  const SystemModel system(layout, bodies, std::vector<GearMeshSpec>(layout.meshes.size(), spec));
  // The planet, in one mesh with the sun over its own width and in another with the narrow ring.
  for (const GearMeshModel& mesh : system.mesh) {
    const bool at_ring = mesh.gear[1].body().design.internal;
    CHECK(mesh.face_width() == (at_ring ? width[2] : width[1]));
    CHECK((mesh.gear[0].concentration() > 1));
    CHECK(mesh.gear[1].concentration() == 1);
  }
  SystemDynamics dynamics(system, motion_of(system, 3e8));
  dynamics.set_positions(std::vector<double>(6, 60e-6), 48);
  check_rest(dynamics, rest_over_period(system, ContactModel::line, 8, 16));
}

namespace {

Scene two_gears(double module) {
  Scene scene;
  for (const char* name : {"pinion", "wheel"}) {
    SceneGear gear;
    gear.name = name;
    gear.design = paper_gear();
    gear.design.module = module;
    scene.gears.push_back(gear);
  }
  scene.meshes.resize(1);
  scene.mesh().gear = {"pinion", "wheel"};
  return scene;
}

}  // namespace

TEST_CASE("unequal face widths are remarked with both and the common one") {
  Scene scene = two_gears(3e-3);
  CHECK(scene_remarks(scene).empty());
  scene.gears[1].design.face_width = 12e-3;
  const std::vector<std::string> said = scene_remarks(scene);
  REQUIRE(said.size() == 1);
  CHECK(
      said[0] ==
      "the faces of pinion and wheel are 25.4 and 12 mm wide: contact is over the common 12 mm, and the teeth of pinion carry it on 18 mm (at most a module more on either side)");
}

TEST_CASE("elements that are long beside the smallest module are remarked, those left open are not") {
  Scene scene = two_gears(4e-3);
  CHECK(scene_remarks(scene).empty());
  scene.body.element_size = 1.14e-3;
  CHECK(scene_remarks(scene).empty());
  scene.body.element_size = 2e-3;
  const std::vector<std::string> said = scene_remarks(scene);
  REQUIRE(said.size() == 1);
  CHECK(
      said[0] ==
      "element_mm = 2 puts 2 elements of order 2 on a module of [gear.pinion]: with fewer than 3.5 root stress is off by more than 1 %; leave it out");
  scene.body.element_size = 0.57e-3;
  scene.body.element_order = 1;
  CHECK(scene_remarks(scene).empty());
  scene.body.element_size = 0.58e-3;
  CHECK(scene_remarks(scene).size() == 1);
  Scene system;
  system.gears = scene.gears;
  system.gears[1].design.module = 1e-3;
  system.body.element_size = 0.28e-3;
  CHECK(scene_remarks(system).empty());
  system.body.element_size = 0.4e-3;
  REQUIRE(scene_remarks(system).size() == 1);
  CHECK(scene_remarks(system)[0].starts_with(
      "element_mm = 0.4 puts 2.5 elements of order 2 on a module of [gear.wheel]"));
}
