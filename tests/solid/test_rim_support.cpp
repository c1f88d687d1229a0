// A ring on an even elastic support of its rim; the thin ring on one is in test_modes.cpp.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "relative.h"
#include "solid/elements.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "solid/rim_support.h"
#include "system/statics.h"
#include "whole_ring.h"

using namespace whine;

namespace {

constexpr double kPi = std::numbers::pi;
const Material kSteel{206e9, 0.3, 7850, true};

// On the outside of its rim, N m-1 per m of circumference.
GearDesign supported(GearDesign ring, double radial, double tangential) {
  ring.rim_radial_stiffness = radial;
  ring.rim_tangential_stiffness = tangential;
  return ring;
}

}  // namespace

TEST_CASE("elastic support of a rim: stiffness of a whole rim that turns or moves, none of a rigid one") {
  const double radial = 3e8, across = 7e8;
  for (const int order : {1, 2}) {
    const SectorGrid mesh = make_sector_mesh(supported(ring_gear(), radial, across), elements(1.6e-3, order));
    SparseReal support(2 * mesh.node_position.rows(), 2 * mesh.node_position.rows());
    add_rim_support(mesh, support);
    CHECK((support - SparseReal(support.transpose())).norm() <= 1e-15 * support.norm());
    const double r = mesh.design.rim_outer_radius, teeth = mesh.design.teeth, near = order == 1 ? 2e-4 : 1e-8;
    const Eigen::VectorXd turned = rotation_field(mesh.node_position);
    CHECK(teeth * turned.dot(support * turned) == relative(2 * kPi * r * r * r * across, near));
    // Of one sector, both directions together: all sectors share alike.
    double moved = 0;
    for (const Eigen::Vector2d& way : {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)}) {
      const Eigen::VectorXd field = way.replicate(mesh.node_position.rows(), 1);
      moved += field.dot(support * field);
    }
    CHECK(0.5 * teeth * moved == relative(kPi * r * (radial + across), near));
    SparseReal none(support.rows(), support.cols());
    add_rim_support(make_sector_mesh(ring_gear(), elements(1.6e-3, order)), none);
    CHECK(none.nonZeros() == 0);
  }
}

TEST_CASE(
    "a ring on a stiff support is one whose rim is rigid, to the first order of its flexibility; on a soft one it turns and moves as a rigid body") {
  const ReducedBody rigid = reduce(make_sector_mesh(ring_gear(), elements(2.4e-3, 1)), kSteel, 4);
  const auto on = [](double stiffness) {
    return reduce(make_sector_mesh(supported(ring_gear(), stiffness, 2 * stiffness), elements(2.4e-3, 1)),
                  kSteel, 4);
  };
  const ReducedBody stiff = on(1e14), half = on(5e13);
  const Eigen::MatrixXd once = stiff.compliance[0] - rigid.compliance[0],
                        twice = half.compliance[0] - rigid.compliance[0];
  CHECK(once.norm() < 0.05 * rigid.compliance[0].norm());
  CHECK((twice - 2 * once).norm() < 0.05 * twice.norm());
  CHECK(stiff.eigenfrequency[0] == relative(rigid.eigenfrequency[0], 0.02));
  CHECK(stiff.mass == relative(rigid.mass, 1e-12));

  // N m-1 per m; the softer the support, the more the lowest modes are motions of a rigid ring.
  const double soft = 1e6, r = ring_gear().rim_outer_radius;
  const ReducedBody floats = on(soft);
  const double turning = std::sqrt(2 * kPi * r * r * r * 2 * soft / floats.inertia) / (2 * kPi),
               moving = std::sqrt(kPi * r * 3 * soft / floats.mass) / (2 * kPi);
  // Two of its translation, one of its rotation.
  CHECK(floats.eigenfrequency[0] == relative(moving, 1e-3));
  CHECK(floats.eigenfrequency[1] == relative(moving, 1e-3));
  CHECK(floats.eigenfrequency[2] == relative(turning, 1e-3));
  CHECK(std::pow(floats.inertia_coupling[2], 2) == relative(floats.inertia, 1e-3));
}

TEST_CASE(
    "all teeth of a ring on an elastic support loaded alike: twist and widening of a thick ring on springs") {
  const double nu = kSteel.poisson_ratio, e = kSteel.youngs_modulus;
  const GearDesign ring = ring_gear();
  const std::array<std::array<double, 2>, 3> support{
      {{1e11, 3e9}, {1e11, 3e10}, {1e12, 3e9}}};  // radial, tangential
  std::vector<ReducedBody> body;
  for (const auto& [radial, across] : support)
    body.push_back(reduce(make_sector_mesh(supported(ring, radial, across), elements(2.4e-3, 1)), kSteel, 1));
  const ToothGeometry tooth(ring);
  const double rb = tooth.base_radius(), rf = tooth.root_radius(), out = ring.rim_outer_radius,
               width = ring.face_width, teeth = ring.teeth;
  // u = A r + B / r, sigma_r = E / (1 - nu^2) ((1 + nu) A - (1 - nu) B / r^2), -p at r_f and -k_r u / b outside. u(r_f) / p.
  const auto widening = [&](double radial) {
    const double plane = e / (1 - nu * nu);
    Eigen::Matrix2d k;
    k << plane * (1 + nu), -plane * (1 - nu) / (rf * rf), plane * (1 + nu) + radial * out / width,
        -plane * (1 - nu) / (out * out) + radial / (out * width);
    const Eigen::Vector2d a = k.inverse() * Eigen::Vector2d(-1, 0);
    return a[0] * rf + a[1] / rf;
  };
  for (const size_t other : {1, 2}) {
    const Eigen::MatrixXd less = all_teeth(body[0]) - all_teeth(body[other]);
    const double twist = rb * rb / (2 * kPi * std::pow(out, 3)) * (1 / support[0][1] - 1 / support[other][1]),
                 pressed = (widening(support[0][0]) - widening(support[other][0])) / (2 * kPi * rf * width);
    for (const int i : {2, 7, 12, 17, 22}) {
      // Between a tooth that widens with the rim and a rigid one, which moves along its own centre line.
      const double roll = body[0].flank_position[i], r = rb * std::hypot(1, roll),
                   half_tooth = 0.5 * tooth.thickness_at_radius(r) / r;
      const auto expected = [&](double angle) {
        return teeth * (twist + std::pow(std::sin(angle), 2) * pressed);
      };
      CAPTURE(other);
      CAPTURE(i);
      CHECK(less(i, i) > 0.99 * expected(std::atan(roll)));
      CHECK(less(i, i) < 1.01 * expected(std::atan(roll) + half_tooth));
    }
  }
}

TEST_CASE(
    "a planet in a ring on a soft support: the ring gives way as a rigid body on springs, teeth far apart alike") {
  // Along the line of action, per force: r_b^2 / (2 pi r^3 k_t) + 1 / (pi r (k_r + k_t)).
  const double radial = 2e6, across = 1e6, torque = 0.2;
  const GearDesign design = supported(ring_of(99, kInternalDistance / 32, 200e-3), radial, across);
  const ReducedBody ring = reduce(make_sector_mesh(design, elements(2.4e-3, 1)), kSteel, 1);
  const double rb = ToothGeometry(design).base_radius(), r = design.rim_outer_radius;
  const double springs = rb * rb / (2 * kPi * r * r * r * across) + 1 / (kPi * r * (radial + across));
  const ReducedBody planet = reduce(make_sector_mesh(planet_gear(), elements(2.4e-3, 1)), kSteel, 1),
                    held = reduce(make_sector_mesh(ring_gear(), elements(2.4e-3, 1)), kSteel, 1);
  StaticParameters settings;
  settings.mesh.gear = {"planet", "ring"};
  settings.mesh.centre_distance = kInternalDistance;
  settings.contact.positions = 8;
  const StaticResult soft = static_transmission(planet, ring, settings, torque),
                     rigid = static_transmission(planet, held, settings, torque);
  const double force = torque / ToothGeometry(planet_gear()).base_radius();
  CHECK((soft.transmission_error.mean() - rigid.transmission_error.mean()) / force ==
        relative(springs, 0.01));
  // The support carries what one tooth bears to all others.
  const ElasticGear gear(ring, ContactPlane{});
  const Eigen::Index n = ring.flank_position.size();
  CHECK(gear.compliance(4, 0) == Eigen::MatrixXd(ring.far_compliance.topRows(n)));
  CHECK(gear.compliance(-5, 0) == Eigen::MatrixXd(ring.far_compliance.middleRows(n, n).transpose()));
  CHECK(gear.compliance(4, 0).mean() == relative(gear.compliance(0, 1e-3).mean(), 0.05));
  CHECK(gear.compliance(50, 0).isZero(0));
}
