// Pairs in slices over the face in motion: one slice and statics as limits, hands, energy, tangent, convergence, contact loss by overlap.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "dynamics/lines_motion.h"
#include "dynamics/system_dynamics.h"
#include "dynamics/system_period_map.h"
#include "elastic_train.h"
#include "gear/helix.h"
#include "gear/train.h"
#include "orbits/periodic_motion.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "system/face_mesh.h"
#include "system/statics.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kTorque = 150, kStiffness = 400e6, kDepth = 0.5e-3;  // N m; N m-1; m, undamped

// P2000's gear with the helix of an overlap ratio, of its face width.
GearDesign helical_gear(double overlap, Hand hand) {
  GearDesign d = paper_gear();
  d.helix_angle = std::asin(overlap * std::numbers::pi * d.module / d.face_width);
  d.hand = hand;
  return d;
}

const ReducedBody& body_of_overlap(double overlap, Hand hand) {
  Material steel = paper_steel();
  steel.plane_stress = false;
  return kept_body(helical_gear(overlap, hand), steel, 1.2e-3, 12);
}

struct Design {
  double overlap = 0;
  Hand of_driver = Hand::right;
  double misalignment = 0;  // m
  int points = 8;           // 0: one slice
};

Hand other(Hand hand) {
  return hand == Hand::right ? Hand::left : Hand::right;
}

GearMeshSpec mesh_of(const Design& d) {
  GearMeshSpec mesh = paper_statics(16).mesh;
  mesh.centre_distance = 0.150 / std::cos(helical_gear(d.overlap, d.of_driver).helix_angle);
  mesh.misalignment = d.misalignment;
  return mesh;
}

// The pair with both gears free to turn, ready to move.
struct Pair {
  explicit Pair(const Design& d, int positions = 64, double eta = 7.7e-6) : system(model(d)) {
    motion = motion_of(system, kStiffness, eta);
    dynamics = std::make_unique<SystemDynamics>(system, motion);
    dynamics->set_positions({40e-6}, positions);
  }
  static SystemModel model(const Design& d) {
    const ReducedBody &driver = body_of_overlap(d.overlap, d.of_driver),
                      &driven = body_of_overlap(d.overlap, other(d.of_driver));
    const GearMeshSpec mesh = mesh_of(d);
    System layout =
        pair_system(even(mesh), transverse_section(driver.design), transverse_section(driven.design));
    layout.drives = {{0, System::DriveKind::torque, kTorque}, {1, System::DriveKind::torque, -kTorque}};
    for (System::Body& body : layout.bodies) body.inertia = 0.0148;
    if (d.points == 0) return {layout, {driver, driven}, {mesh}};
    return sliced_system(layout, {driver, driven}, {mesh}, {0}, WidthModel::slices, d.points, kDepth);
  }
  void run(double frequency, int steps, int periods) {
    dynamics->set_speed(frequency, steps);
    if (state.z.size() == 0) state = dynamics->rest();
    for (int n = 0; n < periods; ++n) REQUIRE(dynamics->integrate(state, period));
  }
  // m
  double rms() const {
    const VectorXd x = period.transmission_error.row(0);
    return std::sqrt((x.array() - x.mean()).square().mean());
  }
  double settled_rms(double frequency, int steps) {
    SystemPeriodMap map(*dynamics, steps);
    map.set_parameter(frequency);
    const PeriodicMotion found = iterate_to_orbit(map, map.rest(), {1e-8, 2000, true});
    REQUIRE(found.multiple > 0);
    map.apply(found.state);
    period = map.period();
    return rms();
  }
  SystemModel system;
  SystemMotion motion;
  std::unique_ptr<SystemDynamics> dynamics;
  SystemDynamics::State state;
  SystemDynamics::Period period;
};

StaticResult at_rest(const Design& d, int positions) {
  StaticParameters settings = paper_statics(positions);
  settings.mesh = mesh_of(d);
  settings.fidelity.width = WidthModel::slices;
  settings.fidelity.contact = ContactModel::line;
  settings.contact.face_points = d.points;
  return static_transmission(body_of_overlap(d.overlap, d.of_driver),
                             body_of_overlap(d.overlap, other(d.of_driver)), settings, kTorque);
}

double peak_to_peak(const VectorXd& x) {
  return x.maxCoeff() - x.minCoeff();
}

constexpr Design kHelical{0.5, Hand::right, 0, 6}, kUneven{0.5, Hand::right, 15e-6, 6};

}  // namespace

TEST_CASE("slices of a spur pair under even load move as one slice") {
  Pair one({0, Hand::right, 0, 0}), four({0, Hand::right, 0, 4});
  CHECK(four.dynamics->points() == 4);
  for (const double frequency : {2900.0, 1300.0}) {
    EnergyBalance a, b;
    for (Pair* pair : {&one, &four}) {
      pair->run(frequency, 64, 15);
      REQUIRE(pair->dynamics->integrate(pair->state, pair->period, pair == &one ? &a : &b));
    }
    const VectorXd x = one.period.transmission_error.row(0), y = four.period.transmission_error.row(0);
    CHECK((x - y).cwiseAbs().maxCoeff() < 1e-9 * peak_to_peak(x));
    CHECK((one.dynamics->tooth_forces() - four.dynamics->tooth_forces()).cwiseAbs().maxCoeff() <
          1e-8 * one.dynamics->tooth_forces().maxCoeff());
    CHECK(four.period.face[0].load_factor == relative(1, 1e-8));
    CHECK(b.relaxation_damping == relative(a.relaxation_damping, 1e-7));
    CHECK(b.modal_damping == relative(a.modal_damping, 1e-7));
    CHECK(b.imbalance < 1e-9 * b.throughput);
  }
}

TEST_CASE("slices at rest are those of statics, and slow motion tends to them") {
  constexpr int kPositions = 64;
  for (const Design& design : {kHelical, kUneven}) {
    const StaticResult rest = at_rest(design, kPositions);
    Pair pair(design, kPositions);
    SystemDynamics& dynamics = *pair.dynamics;
    dynamics.set_speed(20, kPositions);
    for (const int i : {0, 5, 17, 40, 63}) {
      const SystemDynamics::State state = dynamics.rest(i);
      const double x = dynamics.coordinates().rotation_of(0, state.z) * pair.system.base_radius(0) -
                       dynamics.coordinates().rotation_of(1, state.z) * pair.system.base_radius(1);
      CHECK(x == relative(rest.transmission_error[i], 1e-9));
      const VectorXd load = dynamics.rest_forces(i);
      CHECK(load.sum() == relative(rest.tooth_load.row(i).sum(), 1e-9));
      CHECK(load.maxCoeff() == relative((rest.face.line_load[static_cast<size_t>(i)].array() *
                                         rest.face.width[static_cast<size_t>(i)].array())
                                            .maxCoeff(),
                                        1e-8));
    }
    pair.run(20, kPositions, 3);
    const VectorXd x = pair.period.transmission_error.row(0);
    CHECK((x - rest.transmission_error).cwiseAbs().maxCoeff() < 0.01 * peak_to_peak(rest.transmission_error));
    CHECK(pair.period.face[0].line_load == relative(rest.face.line_load_max, 0.01));
  }
}

TEST_CASE("the other hand and the other sign of misalignment move alike") {
  Pair right(kUneven), left({0.5, Hand::left, -15e-6, 6});
  for (Pair* pair : {&right, &left}) pair->run(2500, 64, 40);
  const VectorXd x = right.period.transmission_error.row(0), y = left.period.transmission_error.row(0);
  CHECK((x - y).cwiseAbs().maxCoeff() < 1e-9 * peak_to_peak(x));
  CHECK(right.period.face[0].load_factor == relative(left.period.face[0].load_factor, 1e-8));
  CHECK(right.period.face[0].load_factor > 1.1);
}

TEST_CASE("bodies in three dimensions are of pairs at rest: trains and motion refuse them by their key") {
  const ReducedBody& gear = body_of_overlap(0, Hand::right);
  System layout;
  layout.meshes.resize(2);
  CHECK(names(message_of_input([&] {
                sliced_system(layout, {gear, gear}, {{}, {}}, {0, 1}, WidthModel::body, 3);
              }),
              {"width = \"body\"", "slices"}));
  SystemSweepParameters moving;
  moving.fidelity.width = WidthModel::body;
  CHECK(names(message_of_input([&] {
                LinesMotion(moving, {gear, gear}, 16);
              }),
              {"width = \"body\"", "slices"}));
}

TEST_CASE("energy of slices in motion closes, with and without loss of contact") {
  for (const double overlap : {0.2, 0.5})
    for (const double frequency : {2900.0, 900.0}) {
      CAPTURE(overlap);
      CAPTURE(frequency);
      // Misaligned teeth come in so softly that they do not part.
      Pair pair({overlap, Hand::right, overlap < 0.4 ? 0 : 15e-6, 6}, 64, 2e-6);
      pair.run(frequency, 64, 20);
      EnergyBalance energy;
      for (int n = 0; n < 3; ++n) {
        energy = {};
        REQUIRE(pair.dynamics->integrate(pair.state, pair.period, &energy));
        CHECK(energy.imbalance < 1e-9 * energy.throughput);
      }
      CHECK(energy.relaxation_damping > 0);
      if (overlap < 0.4 && frequency == 2900.0) CHECK(pair.period.mesh_force.minCoeff() == 0);
    }
}

TEST_CASE("the tangent of a period in slices is that of central differences") {
  Pair pair(kUneven, 48);
  SystemPeriodMap map(*pair.dynamics, 48);
  map.set_parameter(2400);
  const PeriodicMotion motion = iterate_to_orbit(map, map.rest(), {1e-9, 3000, true});
  REQUIRE(motion.multiple == 1);
  check_tangent(map, motion.state, 2 * pair.dynamics->coordinates().size());
}

TEST_CASE("the motion converges in the number of points, and overlap takes the loss of contact away") {
  const double fine = Pair({0.5, Hand::right, 0, 12}).settled_rms(2500, 64);
  std::vector<double> off;
  for (const int points : {3, 8}) {
    off.push_back(std::abs(Pair({0.5, Hand::right, 0, points}).settled_rms(2500, 64) / fine - 1));
    MESSAGE(points << " points: RMS off by " << off.back());
  }
  CHECK(off.back() < 2e-3);
  CHECK(off.back() < 0.5 * off.front());
  for (const double overlap : {0.0, 0.5, 1.0}) {
    Pair pair({overlap, Hand::right, 0, 6}, 64, 2e-6);
    pair.settled_rms(2900, 64);
    CAPTURE(overlap);
    CHECK((pair.period.mesh_force.minCoeff() > 0) == (overlap > 0.9));
  }
}
