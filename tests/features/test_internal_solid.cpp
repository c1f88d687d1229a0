// The elastic ring: its mesh, its reduction, and a pinion at rest in it.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/dense.h"
#include "base/error.h"
#include "contact/half_plane_strip.h"
#include "gear/system_layout.h"
#include "internal_pair.h"
#include "refusal.h"
#include "relative.h"
#include "solid/flank_loads.h"
#include "solid/flank_table.h"
#include "solid/loaded_gear.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "solid/sector.h"
#include "system/statics.h"
#include "system/system_statics.h"
#include "whole_ring.h"

using namespace whine;

namespace {

constexpr double kPi = std::numbers::pi;
using Complex = std::complex<double>;

const Material kSteel{206e9, 0.3, 7850, true};

PlaneSystem system_of(const SectorGrid& mesh) {
  return assemble(mesh.node_position, mesh.element_node, kSteel, mesh.design.face_width);
}

}  // namespace

TEST_CASE("sector of a ring: exact boundary, images, orientation and area for many rings") {
  for (const GearDesign& design : {ring_gear(), ring_of(60, 3e-3, 110e-3), ring_of(200, 1e-3, 104e-3, 0.2),
                                   ring_of(99, 3e-3, 300e-3), ring_of(40, 5e-3, 108.5e-3, 0.1)})
    for (const int order : {1, 2}) {
      CAPTURE(design.teeth);
      CAPTURE(order);
      const SectorGrid mesh = make_sector_mesh(design, elements(0.2 * design.module, order));
      const ToothGeometry tooth(design);
      CHECK(least_jacobian(mesh.node_position, mesh.element_node) > 0.05);
      double off = 0, image = 0;
      for (int i = 0; i < mesh.flank_node.size(); ++i)
        off = std::max(off, (mesh.node_position.row(mesh.flank_node[i]).transpose() -
                             tooth.flank_point(mesh.flank_roll_angle[i]))
                                .norm());
      CHECK(off < 1e-15);
      CHECK(mesh.flank_roll_angle[0] == relative(tooth.tip_roll_angle(), 1e-13));
      CHECK(mesh.flank_roll_angle[mesh.flank_roll_angle.size() - 1] ==
            relative(tooth.form_roll_angle(), 1e-14));
      const Eigen::Rotation2D<double> turn(2 * kPi / design.teeth);
      for (int i = 0; i < mesh.side_node.rows(); ++i)
        image = std::max(image, (turn * Vec2(mesh.node_position.row(mesh.side_node(i, 0))) -
                                 Vec2(mesh.node_position.row(mesh.side_node(i, 1))))
                                    .norm());
      CHECK(image < 2e-15 * design.rim_outer_radius);
      for (int i : mesh.bore_node)
        CHECK(mesh.node_position.row(i).norm() == relative(design.rim_outer_radius, 1e-14));
      CHECK(std::abs(mesh_area(mesh.node_position, mesh.element_node) / exact_sector_area(design) - 1) <
            (order == 1 ? 2e-3 : 1e-5));
    }
}

TEST_CASE(
    "area of a ring's sector: a sector of the rim less half of an external tooth's space and less its fillets") {
  // Without fillet the space is bounded by two involutes, whose area has a closed form: from the centre, the involute from
  // roll angle 0 to xi sweeps r_b^2 xi^3 / 6.
  GearDesign design = ring_gear();
  design.rack_tip_radius = 0;
  const ToothGeometry ring(design);
  const double rb = ring.base_radius(), ra = ring.tip_radius(), rf = ring.root_radius();
  const auto swept = [&](double xi) { return rb * rb * xi * xi * xi / 6; };
  const double pitch = 2 * kPi / design.teeth, top = ring.thickness_at_radius(ra) / ra,
               root = pitch - ring.thickness_at_radius(rf) / rf;
  const double hollow = 0.5 * ra * ra * top + 0.5 * rf * rf * root +
                        2 * (swept(ring.form_roll_angle()) - swept(ring.tip_roll_angle()));
  const double rim = 0.5 * pitch * std::pow(design.rim_outer_radius, 2);
  CHECK(exact_sector_area(design) == relative(rim - hollow, 1e-9));
}

TEST_CASE("all modes of a ring together: its rigid rotation about the rim moves every flank point by r_b") {
  const SectorGrid mesh = make_sector_mesh(ring_of(99, 3e-3, 165e-3), elements(1.2e-3, 1));
  const ToothGeometry tooth(mesh.design);
  const PlaneSystem system = system_of(mesh);
  const CyclicSector sector(mesh, system);
  const Eigen::MatrixXd k = Eigen::MatrixXcd(sector.stiffness(0)).real(),
                        m = Eigen::MatrixXcd(sector.mass(0)).real();
  const SymmetricEigen dense = symmetric_eigen(k, m);
  const double teeth = mesh.design.teeth;
  const Eigen::MatrixXd shape = sector.expand(0, dense.vectors.cast<Complex>()).real() / std::sqrt(teeth);
  const Eigen::VectorXd rotation = rotation_field(mesh.node_position);
  const Eigen::VectorXd gamma = teeth * shape.transpose() * (system.mass * rotation);
  const Eigen::VectorXd arm = FlankReader(mesh).outward(FlankTable(tooth, 10).points()) * (shape * gamma);
  for (double r : arm) CHECK(r == relative(tooth.base_radius(), 1e-3));  // sag of chords
}

TEST_CASE(
    "reduced ring: compliance positive and symmetric, both flanks reciprocal, inertia of its drawing, refined") {
  const GearDesign design = ring_gear();
  const ReducedBody body = reduce(make_sector_mesh(design, elements(1.6e-3)), kSteel, 4);
  const ToothGeometry ring(design);
  for (Eigen::Index i = 1; i < body.flank_position.size(); ++i)
    CHECK(body.flank_position[i] > body.flank_position[i - 1]);
  CHECK(body.asymmetry < 1e-3);
  CHECK(body.least_eigenvalue > -0.02 * body.compliance[0].cwiseAbs().maxCoeff());
  const double disc = kSteel.density * design.face_width * kPi;
  CHECK(body.mass < disc * (std::pow(design.rim_outer_radius, 2) - std::pow(ring.tip_radius(), 2)));
  CHECK(body.mass > disc * (std::pow(design.rim_outer_radius, 2) - std::pow(ring.root_radius(), 2)));
  // The tip gives way more than the root.
  CHECK(body.compliance[0](0, 0) > body.compliance[0](23, 23));
  // A force on one tooth turns all others in its own sense: a rigid rim alone would leave them still.
  const ReducedBody finer = reduce(make_sector_mesh(design, elements(0.8e-3)), kSteel, 4);
  const double change = (body.compliance[0] - finer.compliance[0]).norm() / finer.compliance[0].norm();
  CHECK(change < 1.5e-3);
  for (int i = 0; i < 4; ++i) CHECK(body.eigenfrequency[i] == relative(finer.eigenfrequency[i], 1e-3));
}

TEST_CASE(
    "a ring whose teeth are all loaded alike: between two rim radii it is a thick ring under torsion and pressure") {
  // Equal unit forces on all teeth are harmonic 0, the sum of the tables of all offsets. From a narrow rim to a wider one the
  // teeth cancel. Per unit normal force, of which cos(alpha) turns the rim and sin(alpha) presses on it (alpha: pressure angle
  // at the flank point), remain
  //   r_b^2 / (4 pi G b) (1 / r_1^2 - 1 / r_2^2)   and   sin^2(alpha) (U(r_2) - U(r_1)) / (2 pi r_f b),
  // U(r) = u / p of Lame's ring with pressure p at the root circle r_f and its outside r held.
  const double narrow = 152e-3, wide = 180e-3, nu = kSteel.poisson_ratio, e = kSteel.youngs_modulus;
  const ReducedBody a = reduce(make_sector_mesh(ring_of(99, 2.778e-3, narrow), elements(1.6e-3)), kSteel, 1),
                    b = reduce(make_sector_mesh(ring_of(99, 2.778e-3, wide), elements(1.6e-3)), kSteel, 1);
  const ToothGeometry ring(a.design);
  const double rb = ring.base_radius(), rf = ring.root_radius(), width = a.design.face_width;
  const double twist =
      99 * rb * rb * (1 + nu) / (2 * kPi * e * width) * (1 / (narrow * narrow) - 1 / (wide * wide));
  // u = B (r / r_2^2 - 1 / r), sigma_r = E B / (1 - nu^2) ((1 + nu) / r_2^2 + (1 - nu) / r^2) = -p at r_f.
  const auto lame = [&](double outer) {
    const double inner2 = rf * rf, outer2 = outer * outer;
    return (1 - nu * nu) / e * (1 / rf - rf / outer2) / ((1 + nu) / outer2 + (1 - nu) / inner2);
  };
  const double pressed = 99 * (lame(wide) - lame(narrow)) / (2 * kPi * rf * width);
  const Eigen::MatrixXd more = all_teeth(b) - all_teeth(a);
  for (const int i : {2, 7, 12, 17, 22}) {
    const double sine = std::sin(std::atan(a.flank_position[i]));
    CAPTURE(i);
    CHECK(more(i, i) == relative(twist + sine * sine * pressed, 0.01));
  }
}

namespace {

const ReducedBody& planet_body() {
  return kept_body(planet_gear(), kSteel, 1.2e-3, 1);
}
const ReducedBody& ring_body() {
  return kept_body(ring_gear(), kSteel, 1.2e-3, 1);
}

StaticParameters at_rest(int positions, ContactModel contact = ContactModel::strips) {
  StaticParameters settings;
  settings.mesh.gear = {"a", "b"};
  settings.mesh.centre_distance = kInternalDistance;
  settings.contact.positions = positions;
  settings.fidelity.contact = contact;
  return settings;
}

constexpr double kTorque = 200;  // N m on the planet

}  // namespace

TEST_CASE(
    "a planet in its ring with hardly any load: no transmission error, as many pairs as the contact ratio") {
  for (const bool ring_drives : {false, true}) {
    CAPTURE(ring_drives);
    const int positions = 64;
    const StaticResult s =
        static_transmission(ring_drives ? ring_body() : planet_body(),
                            ring_drives ? planet_body() : ring_body(), at_rest(positions), 1e-6);
    CHECK(s.transmission_error.cwiseAbs().maxCoeff() < 1e-12);
    CHECK(s.unloaded_error.cwiseAbs().maxCoeff() == 0);
    const double pairs = static_cast<double>((s.tooth_load.array() > 0).count()) / positions;
    CHECK(std::abs(pairs - s.contact_ratio) <= 2.0 / positions);
    CHECK(s.contact_ratio ==
          relative(GearPair(planet_gear(), ring_gear(), kInternalDistance).contact_ratio(), 1e-12));
  }
}

TEST_CASE(
    "a planet in its ring: Hertz with the difference of curvatures, shares of the load, torque balance") {
  StaticParameters settings = at_rest(32);
  settings.contact.strips = 16;
  const StaticResult s = static_transmission(planet_body(), ring_body(), settings, kTorque);
  const GearPair pair(planet_gear(), ring_gear(), kInternalDistance);
  const double force = kTorque / pair.gear(0).base_radius();
  int inside = 0;
  for (Eigen::Index i = 0; i < s.tooth_load.rows(); ++i) {
    const double carried = s.tooth_load.row(i).sum();
    CHECK(carried == relative(force, 0.02));  // tip edges have other lever arms
    for (Eigen::Index j = 0; j < s.pair.size(); ++j) {
      if (!(s.contact_half_width(i, j) > 0) || s.tooth_load(i, j) < 0.2 * force) continue;
      const double path = (s.mesh_phase[i] + s.pair[j]) * pair.base_pitch();
      const double rho1 = pair.gear(0).base_radius() * pair.nominal_roll(0, path),
                   rho2 = pair.gear(1).base_radius() * pair.nominal_roll(1, path);
      const double radius = 1 / (1 / rho1 - 1 / rho2), width = planet_gear().face_width;
      const double modulus = 0.5 * kSteel.youngs_modulus;  // plane stress, as the bodies
      const double load = s.tooth_load(i, j) / width,
                   half_width = std::sqrt(4 * load * radius / (kPi * modulus));
      const double edge = std::min(pair.edge_distance(pair.contact(s.mesh_phase[i] + s.pair[j]), 0),
                                   pair.edge_distance(pair.contact(s.mesh_phase[i] + s.pair[j]), 1));
      if (edge < 3 * half_width) continue;
      ++inside;
      CHECK(s.contact_half_width(i, j) == relative(half_width, 0.02));
      CHECK(s.contact_pressure(i, j) == relative(2 * load / (kPi * half_width), 0.02));
    }
  }
  CHECK(inside > 20);
  CHECK(s.torque_residual < 1e-10);
  CHECK(s.least_gap > -1e-15);
  CHECK(s.least_force >= 0);
  // Teeth that bend bring in the next pair at its tip edge, so that no pair ever carries all.
  CHECK(s.tooth_load.maxCoeff() < force);
  CHECK(s.tooth_load.maxCoeff() > 0.75 * force);
  CHECK(s.transmission_error.minCoeff() > 0);
  CHECK(s.stiffness_secant.minCoeff() > 100e6);
  CHECK(s.stiffness_secant.maxCoeff() < 1000e6);
}

TEST_CASE("a ring that drives its planet is the planet that drives the ring, backwards") {
  const double ratio = 99.0 / 35;
  StaticParameters settings = at_rest(32, ContactModel::line);
  settings.mesh.corner.enabled = false;  // at a tip edge the lever arms of the two gears differ
  const StaticResult forward = static_transmission(planet_body(), ring_body(), settings, kTorque),
                     backward = static_transmission(ring_body(), planet_body(), settings, kTorque * ratio);
  const Eigen::Index n = forward.transmission_error.size();
  for (Eigen::Index i = 0; i < n; ++i)
    CHECK(backward.transmission_error[i] == relative(forward.transmission_error[(n - i) % n], 1e-9));
}

namespace {

GearDesign sun_gear() {
  GearDesign d = planet_gear();
  d.teeth = 27;
  d.profile_shift =
      1.05;  // at the planet's distance from the ring's axis, which is not that of unshifted teeth
  d.addendum = 0.8;
  d.bore_radius = 20e-3;
  return d;
}

const ReducedBody& sun_body() {
  return kept_body(sun_gear(), kSteel, 1.2e-3, 1);
}

}  // namespace

TEST_CASE(
    "sun, planet, ring on fixed axes: forces and torques of every body balance at every phase, in both senses") {
  constexpr double kSunTorque = 120;
  Bearing soft;
  soft.stiffness = 300e6;
  GearMeshSpec outer, inner;
  outer.gear = {"sun", "planet"};
  inner.gear = {"planet", "ring"};
  outer.centre_distance = inner.centre_distance = kInternalDistance;
  outer.corner.enabled = inner.corner.enabled = false;
  const GearPair at_sun(sun_gear(), planet_gear(), kInternalDistance),
      at_ring(planet_gear(), ring_gear(), kInternalDistance);
  const double force = kSunTorque / at_sun.gear(0).base_radius();
  std::vector<double> error[2];
  for (const int sense : {1, -1}) {
    System layout;
    add_input_gear(layout, "sun", sun_gear());
    layout.bodies[0].sense = sense;
    add_driven_gear(layout, 0, sun_gear(), "planet", planet_gear(), kInternalDistance, 0.5 * kPi, soft);
    add_driven_gear(layout, 1, planet_gear(), "ring", ring_gear(), kInternalDistance, 0.5 * kPi);
    CHECK(layout.bodies[1].sense == -sense);
    CHECK(layout.bodies[2].sense == -sense);
    CHECK(std::hypot(layout.bodies[2].centre[0], layout.bodies[2].centre[1]) < 1e-15);
    layout.drives = {{0, System::DriveKind::torque, kSunTorque}, {2, System::DriveKind::held, 0}};
    const SystemModel system(layout, {sun_body(), planet_body(), ring_body()}, {outer, inner});
    for (const SystemSolution& answer : rest_over_period(system, ContactModel::line, 8, 8)) {
      double carried[2] = {0, 0};
      for (const LoadedSegment& pair : answer.loads) carried[pair.mesh] += pair.force;
      CHECK(carried[0] == relative(force, 1e-9));
      CHECK(carried[1] == relative(force, 1e-9));  // on the planet's other flanks
      // The tangential parts add up on the planet's bearing, the radial ones are the difference of two.
      const double sun = at_sun.working_pressure_angle(), ring = at_ring.working_pressure_angle();
      const Vec2 expected =
          force * Vec2(-sense * (std::cos(sun) + std::cos(ring)), std::sin(sun) - std::sin(ring));
      CHECK((answer.bearing_force[1] - expected).norm() < 1e-8 * force);
      CHECK(answer.transmission_error[0] > 0);
      CHECK(answer.transmission_error[1] > 0);
      error[sense < 0].push_back(answer.transmission_error[0] + answer.transmission_error[1]);
    }
  }
  // Turned backwards the train is its own mirror image, if its teeth stand so at phase 0.
  for (size_t i = 0; i < error[0].size(); ++i) CHECK(error[1][i] == relative(error[0][i], 1e-8));
}

TEST_CASE(
    "a ring under pressure on one tooth: its field, by another way, gives way as its tables say, and its rim holds the torque") {
  const SectorGrid mesh = make_sector_mesh(ring_gear(), elements(1.2e-3));
  const ToothGeometry ring(mesh.design);
  const FlankTable table(ring, BodyDiscretisation{}.flank_points);
  const double roll = 0.5 * (ring.tip_roll_angle() + ring.form_roll_angle()), width = 0.1e-3, force = 1000;
  const LoadedGear loaded = loaded_gear(mesh, kSteel, {{0, roll, width, force}});
  CHECK(loaded.hub_torque == relative(force * ring.base_radius(), 2e-3));
  CHECK(loaded.strain_energy == relative(0.5 * force * loaded.deflection[0], 0.02));
  // The table is less the half-plane relative to the reference depth.
  const HalfPlaneSurface surface(kSteel, mesh.design.face_width);
  const Eigen::RowVectorXd weights = table.weights(roll);
  const double expected = force * (weights.dot(ring_body().compliance[0] * weights.transpose()) +
                                   surface.mean_over_strip(0, 0.5 * width, 0.5 * width, kReferenceDepth));
  CHECK(loaded.deflection[0] == relative(expected, 1e-3));
}

TEST_CASE("a ring by matching at a depth gives way as by subtraction, but for the tip edge") {
  BodyDiscretisation discretisation = elements(1.2e-3);
  discretisation.near_field = NearField::matching;
  discretisation.matching_depth = 0.8e-3;
  const ReducedBody matched = reduce(make_sector_mesh(ring_gear(), discretisation), kSteel, 1);
  // Both less the half-plane relative to the reference depth. The tip comes first.
  const MatrixRM &found = matched.compliance[0], &exact = ring_body().compliance[0];
  for (const int i : {12, 16, 20}) CHECK(found(i, i) == relative(exact(i, i), 0.05));
}

TEST_CASE("a result says where a pinion cannot be put into its ring by a radial movement") {
  StaticResult s;
  s.gear[1].design = ring_gear();
  for (BodyParameters& gear : s.gear) gear.material = kSteel;
  s.mean_stiffness = 5e8;
  s.torque = 1;
  for (const int teeth : {35, 88}) {
    GearDesign& pinion = s.gear[0].design;
    pinion = planet_gear();
    pinion.teeth = teeth;
    pinion.addendum = 0.8;
    s.mesh.centre_distance = 0.5 * (99 - teeth) * pinion.module;
    bool warned = false;
    for (const Remark& remark : remarks(s))
      warned |= remark.warning && contains(remark.words, "trimming interference");
    CHECK(warned == (teeth == 88));
  }
}

namespace {

constexpr double kPlanetTorque = 300;  // N m on the sun

// Sun of 27, planets of 35 and ring of 99 teeth at rest; the sun carries the torque, ring and carrier are held. The sun floats on a
// soft bearing, planets stand on elastic pins.
SystemModel elastic_train(const std::vector<int>& steps) {
  Scene scene;
  for (const auto& [name, design, stiffness] :
       {std::tuple{"sun", sun_gear(), 1e7}, std::tuple{"planet", planet_gear(), 3e8},
        std::tuple{"ring", ring_gear(), 0.0}}) {
    SceneGear gear;
    gear.name = name;
    gear.design = design;
    gear.bearing.stiffness = stiffness;
    scene.gears.push_back(gear);
  }
  Scene::Carrier carrier;
  carrier.name = "carrier";
  carrier.planet = "planet";
  for (const int step : steps) carrier.positions.push_back(2 * kPi * step / 126);
  scene.carriers = {carrier};
  for (const auto& gears :
       {std::array<std::string, 2>{"sun", "planet"}, std::array<std::string, 2>{"planet", "ring"}}) {
    Scene::Mesh mesh;
    mesh.spec.gear = gears;
    mesh.spec.centre_distance = kInternalDistance;
    mesh.spec.corner.enabled = false;
    scene.meshes.push_back(mesh);
  }
  scene.drives = {{"sun", System::DriveKind::torque, kPlanetTorque, 0},
                  {"ring", System::DriveKind::held, 0, 0},
                  {"carrier", System::DriveKind::held, 0, 0}};
  const System layout = layout_of(scene);
  std::vector<ReducedBody> bodies;
  for (const System::Body& body : layout.bodies)
    if (body.kind == System::BodyKind::gear)
      bodies.push_back(body.teeth == 27 ? sun_body() : body.teeth == 35 ? planet_body() : ring_body());
  std::vector<GearMeshSpec> specs;
  for (size_t m = 0; m < layout.meshes.size(); ++m) specs.push_back(scene.meshes[m / steps.size()].spec);
  return {layout, bodies, specs};
}

}  // namespace

TEST_CASE(
    "elastic planetary train: equal phases share the load equally, pins carry it, every body balances") {
  for (const bool equal : {true, false}) {
    CAPTURE(equal);
    const SystemModel system = elastic_train(equal ? std::vector{0, 42, 84} : std::vector{0, 41, 84});
    const size_t planets = 3;
    for (size_t n = 1; n < planets && equal; ++n)
      for (const size_t first : {size_t{0}, planets})
        CHECK(std::abs(std::remainder(
                  system.layout.meshes[first + n].phase - system.layout.meshes[first].phase, 1)) < 1e-9);
    const double force = kPlanetTorque / system.base_radius(0);
    double least = 1, most = 0;
    for (const SystemSolution& at : rest_over_period(system, ContactModel::strips, 4, 4)) {
      std::vector<double> carried(2 * planets, 0.0);
      for (const LoadedSegment& load : at.loads) carried[static_cast<size_t>(load.mesh)] += load.force;
      double sum = 0;
      Vec2 pins = Vec2::Zero();
      for (size_t n = 0; n < planets; ++n) {
        sum += carried[n];
        pins += at.bearing_force[1 + n];
        CHECK(carried[planets + n] == relative(carried[n], 1e-8));  // torque of the planet
        CHECK(at.transmission_error[n] > 0);
        least = std::min(least, carried[n] / force);
        most = std::max(most, carried[n] / force);
        if (equal) {
          CHECK(carried[n] == relative(force / 3, 1e-8));
          CHECK(at.transmission_error[n] == relative(at.transmission_error[0], 1e-8));
          CHECK(at.transmission_error[planets + n] == relative(at.transmission_error[planets], 1e-8));
          CHECK(at.bearing_force[1 + n].norm() == relative(at.bearing_force[1].norm(), 1e-8));
        }
      }
      CHECK(sum == relative(force, 1e-8));
      if (equal) {
        CHECK(pins.norm() < 1e-7 * force);
        CHECK(at.bearing_force[0].norm() < 1e-7 * force);
      }
    }
    // Planets that stand unequally pass through their mesh periods one after the other.
    if (!equal) {
      CHECK(most - least > 0.01);
      CHECK(most < 0.5);
    }
  }
}
