// Helical trains in slices, at rest and in motion: limits of one slice and of a pair, hands, balance of axial forces and tilting moments,
// planets alike, faces of unequal width, convergence in the number of points, slow motion, energy.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "dynamics/system_dynamics.h"
#include "dynamics/system_period_map.h"
#include "elastic_train.h"
#include "gear/contact_lines.h"
#include "gear/drawing_quantities.h"
#include "gear/helix.h"
#include "gear/layout.h"
#include "io/scene.h"
#include "orbits/periodic_motion.h"
#include "system/face_mesh.h"
#include "system/statics.h"
#include "system/system_rest.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kPositions = 16;
constexpr double kOneDegreeOfHelix = std::numbers::pi / 180, kMicro = 1e-6;
const Material kSteel{206e9, 0.3, 7850, false};

// The drawing whose transverse section is a spur gear.
GearDesign with_section(const GearDesign& section, double beta, Hand hand) {
  GearDesign d = section;
  const double cosine = std::cos(beta);
  d.module *= cosine;
  d.pressure_angle = std::atan(std::tan(section.pressure_angle) * cosine);
  for (double* in_modules : {&d.profile_shift, &d.addendum, &d.dedendum, &d.rack_tip_radius})
    *in_modules /= cosine;
  d.helix_angle = beta;
  if (beta > 0) d.hand = hand;
  return d;
}

struct Design {
  std::array<int, 3> teeth{27, 36, 99};
  double beta = 0;
  Hand of_sun = Hand::right;
  int points = 4;                        // 0: one slice
  double misalignment = 0;               // m, of the meshes of the sun
  std::array<double, 3> wider{1, 1, 1};  // faces of sun, planets, ring over 25 mm
  bool corner = true;
};

Hand other(Hand hand) {
  return hand == Hand::right ? Hand::left : Hand::right;
}

// Three planets; ring and carrier are held, the sun floats, planets stand on elastic pins.
struct Train {
  explicit Train(const Design& d) {
    scene = planetary_train(3);
    const std::array stiffness{2e7, 3e8, 0.0};
    for (size_t g = 0; g < 3; ++g) {
      SceneGear& gear = scene.gears[g];
      GearDesign section = rigid_gear(d.teeth[g], g == 2);
      if (g < 2) section.bore_radius = (0.5 * d.teeth[g] - 5) * kTrainModule;
      section.face_width *= d.wider[g];
      gear.design = with_section(section, d.beta, g == 0 ? d.of_sun : other(d.of_sun));
      gear.material = kSteel;
      gear.equivalent_mass = 0;
      gear.bearing = {stiffness[g], g == 0 ? 500.0 : 2000.0, 0};
      // The plane body is that of the transverse section.
      bodies.push_back(kept_body(section, kSteel, 2.5e-3, 15));
      bodies.back().design = gear.design;
    }
    scene.gears[2].bearing = scene.carriers[0].bearing = {};
    for (Scene::Mesh& mesh : scene.meshes) {
      mesh.spec.centre_distance = 0.5 * (d.teeth[0] + d.teeth[1]) * kTrainModule;
      mesh.spec.corner.enabled = d.corner;
    }
    scene.meshes[0].spec.misalignment = d.misalignment;
    scene.drives = {{"sun", System::DriveKind::torque, kTrainTorque, 0},
                    {"ring", System::DriveKind::held, 0, 0},
                    {"carrier", System::DriveKind::held, 0, 0}};
    scene.fidelity = {BodyModel::modal, ContactModel::line, Integrator::exact,
                      d.points > 0 ? WidthModel::slices : WidthModel::one};
    scene.contact = {4, kPositions, d.points};
    settings = static_parameters_of(scene, layout_of(scene));
  }
  SystemStaticResult at_rest() const { return system_at_rest(settings, bodies); }
  Scene scene;
  SystemStaticParameters settings;
  std::vector<ReducedBody> bodies;  // [gear]
};

// Ready to move.
struct Moving {
  explicit Moving(const Design& d, int positions, double eta = 7.7e-6) {
    const Train train(d);
    system = std::make_unique<SystemModel>(elastic_system(train.settings, train.bodies, 0.5e-3));
    take_masses(train.settings, train.bodies, system->layout);
    motion = motion_of(*system, 5e8, eta);
    dynamics = std::make_unique<SystemDynamics>(*system, motion);
    dynamics->set_positions(std::vector<double>(system->mesh.size(), 40e-6), positions);
  }
  void run(double frequency, int steps, int periods) {
    dynamics->set_speed(frequency, steps);
    if (state.z.size() == 0) state = dynamics->rest();
    for (int n = 0; n < periods; ++n) REQUIRE(dynamics->integrate(state, period));
  }
  std::unique_ptr<SystemModel> system;
  SystemMotion motion;
  std::unique_ptr<SystemDynamics> dynamics;
  SystemDynamics::State state;
  SystemDynamics::Period period;
};

double peak_to_peak(const VectorXd& x) {
  return x.maxCoeff() - x.minCoeff();
}

// m
double largest_change(const SystemStaticResult& a, const SystemStaticResult& b) {
  double out = 0;
  for (size_t m = 0; m < a.mesh.size(); ++m)
    out = std::max(out, (a.mesh[m].transmission_error - b.mesh[m].transmission_error).cwiseAbs().maxCoeff());
  return out;
}

constexpr double kTwelve = 12 * kOneDegreeOfHelix;
constexpr Index kRing = 4, kCarrier = 5;
const Design kHelical{.beta = kTwelve}, kUneven{.beta = kTwelve, .points = 6, .misalignment = 15 * kMicro};

}  // namespace

TEST_CASE("a train in slices under even load is that of one slice, with faces of any width") {
  for (const std::array<double, 3>& wider : {std::array{1.0, 1.0, 1.0}, std::array{1.2, 1.0, 1.4}}) {
    const SystemStaticResult one = Train({.points = 0, .wider = wider}).at_rest(),
                             slices = Train({.wider = wider}).at_rest();
    CHECK(largest_change(one, slices) < 1e-9 * one.mesh[0].transmission_error.maxCoeff());
    for (size_t m = 0; m < one.mesh.size(); ++m) {
      const StaticResult &a = one.mesh[m], &b = slices.mesh[m];
      for (Index k = 0; k < a.pair.size(); ++k) {
        const Index own = a.pair[k] - b.pair[0];
        REQUIRE(own >= 0);
        CHECK((a.tooth_load.col(k) - b.tooth_load.col(own)).cwiseAbs().maxCoeff() <
              1e-8 * a.tooth_load.maxCoeff());
      }
      CHECK(b.face.load_factor == relative(1, 1e-8));
      CHECK(b.mean_stiffness == relative(a.mean_stiffness, 1e-9));
      CHECK(b.loss_factor == relative(a.loss_factor, 1e-3));  // tip edges slide elsewhere
    }
    CHECK(slices.axial_force.cwiseAbs().maxCoeff() == 0);
    CHECK(slices.tilting_moment[3].cwiseAbs().maxCoeff() < 1e-9 * kTrainTorque);
  }
}

TEST_CASE("the helix to 0 is the spur train, linear in its angle") {
  // Helical lines know no tip edges.
  const Design spur{.teeth = {26, 37, 100}, .corner = false};
  const SystemStaticResult a = Train(spur).at_rest();
  const double scale = a.mesh[0].transmission_error.maxCoeff();
  std::vector<double> change;
  for (const double beta : {1e-4, 1e-6}) {
    Design d = spur;
    d.beta = beta;
    change.push_back(largest_change(Train(d).at_rest(), a) / scale);
  }
  MESSAGE("transmission errors at 1e-4 and 1e-6 rad: off by " << change[0] << ", " << change[1]);
  CHECK(change[1] < 1e-6);
  CHECK(change[1] < 0.02 * change[0]);
}

TEST_CASE("axial forces are F_t tan(beta_b), balance over the train, and tilt the planets") {
  const SystemStaticResult a = Train(kHelical).at_rest();
  const Train train(kHelical);
  const double sine = std::sin(base_helix_angle(train.scene.gears[0].design));
  CHECK(sine > 0);
  const auto& bodies = a.settings.layout.bodies;
  const double force = a.mesh_force.row(0).head(3).sum();
  for (Index i = 0; i < kPositions; ++i) {
    const VectorXd axial = a.axial_force.row(i).transpose();
    CHECK(axial[0] == relative(sine * a.mesh_force.row(i).head(3).sum(), 1e-12));
    CHECK(axial[kRing] == relative(-sine * a.mesh_force.row(i).tail(3).sum(), 1e-12));
    for (Index n = 1; n < 4; ++n) {
      // Sun and ring push a planet to either side.
      CHECK(std::abs(axial[n]) < 1e-9 * force);
      // About the tangent of the pin circle, with the arm between its two pitch points.
      const MatrixRM& moment = a.tilting_moment[static_cast<size_t>(i)];
      const System::Body& planet = bodies[static_cast<size_t>(n)];
      const Vec2 radial = Vec2(planet.centre[0], planet.centre[1]).normalized();
      const double arm = 2 * 0.5 * 36 * kTrainModule;
      CHECK(moment.row(n).dot(Vec2(-radial.y(), radial.x())) ==
            relative(-sine * a.mesh_force(i, n - 1) * arm, 0.15));
    }
    CHECK(std::abs(axial.head(5).sum()) < 1e-12 * force);
    CHECK(std::abs(axial[kCarrier] - axial.segment(1, 3).sum()) < 1e-12 * force);
    // Contact forces come in pairs at one place.
    Vec2 sum(0, 0);
    for (Index b = 0; b < 5; ++b) {
      const auto& centre = bodies[static_cast<size_t>(b)].centre;
      sum += Vec2(a.tilting_moment[static_cast<size_t>(i)].row(b)) +
             Vec2(centre[1] * axial[b], -centre[0] * axial[b]);
    }
    CHECK(sum.norm() < 1e-12 * force);
    // Equal phases: a third each.
    for (Index m = 0; m < 3; ++m) CHECK(a.load_share(i, m) == relative(1.0 / 3, 1e-9));
  }
  for (size_t m : {1, 2}) CHECK(a.mesh[m].face.load_factor == relative(a.mesh[0].face.load_factor, 1e-8));
  for (size_t m = 0; m < a.mesh.size(); ++m) {
    const StaticResult& mesh = a.mesh[m];
    CHECK((a.mesh_force.col(static_cast<Index>(m)) - mesh.tooth_load.rowwise().sum()).cwiseAbs().maxCoeff() <
          1e-9 * force);
    CHECK(std::abs(mesh.face.axial_force) ==
          relative(sine * normal_force(mesh.gear[0].design, mesh.torque), 1e-12));
    for (Index i = 0; i < kPositions; ++i) {
      const FaceLoad& face = mesh.face;
      const auto at = static_cast<size_t>(i);
      CHECK(face.line_load[at].cwiseProduct(face.width[at]).sum() ==
            relative(mesh.tooth_load.row(i).sum(), 1e-12));
      CHECK(face.contact_line_length[i] ==
            relative(contact_line_length(GearPair(mesh), mesh.mesh_phase[i]), 1e-9));
    }
  }
}

TEST_CASE("the other hands: the same answers, axial forces reversed, loads mirrored in z") {
  Design left = kUneven;
  left.of_sun = Hand::left;
  left.misalignment = -left.misalignment;
  const SystemStaticResult a = Train(kUneven).at_rest(), b = Train(left).at_rest();
  CHECK(largest_change(a, b) < 1e-11 * a.mesh[0].transmission_error.maxCoeff() + 1e-15);
  CHECK((a.axial_force + b.axial_force).cwiseAbs().maxCoeff() < 1e-9 * a.axial_force.maxCoeff());
  for (size_t m = 0; m < a.mesh.size(); ++m) {
    CHECK(a.mesh[m].face.load_factor == relative(b.mesh[m].face.load_factor, 1e-9));
    const MatrixRM mirrored = b.mesh[m].face.line_load[3].rowwise().reverse();
    CHECK((a.mesh[m].face.line_load[3] - mirrored).cwiseAbs().maxCoeff() < 1e-8 * mirrored.maxCoeff());
  }
  CHECK(a.mesh[0].face.load_factor > 1.1);
  for (size_t i : {0, 5})
    CHECK((a.tilting_moment[i] + b.tilting_moment[i]).cwiseAbs().maxCoeff() <
          1e-9 * a.tilting_moment[i].cwiseAbs().maxCoeff());
}

TEST_CASE(
    "what sections of a planet do to each other between its meshes: nothing under even load, symmetric, no work below 0") {
  const auto uneven = [](const Design& d) {
    const Train train(d);
    const SystemModel system = elastic_system(train.settings, train.bodies);
    SystemStatics statics(system, ContactModel::line, static_zones(system, 4, 1, 1));
    statics.solve(0.3, 0, VectorXd::Zero(6));
    const SystemPosition& position = statics.position();
    MatrixXd between = MatrixXd::Zero(position.strips(), position.strips());
    add_uneven_between(system, position, between);
    MatrixXd whole = between;
    VectorXd width(position.strips());
    for (size_t m = 0; m < position.mesh.size(); ++m) {
      whole(position.strips_of(m), position.strips_of(m)) = position.mesh[m].face->uneven;
      width(position.strips_of(m)) = position.mesh[m].face->points.weight;
    }
    return std::tuple{between, whole, width};
  };
  const auto [spur, spur_whole, width] = uneven({});
  CHECK(spur.norm() > 0);
  CHECK((spur * width).cwiseAbs().maxCoeff() < 1e-10 * spur.cwiseAbs().maxCoeff() * width.maxCoeff());
  const auto [between, whole, weight] = uneven(kHelical);
  CHECK((between - between.transpose()).cwiseAbs().maxCoeff() < 1e-10 * between.cwiseAbs().maxCoeff());
  const MatrixXd of_lines = weight.asDiagonal() * whole * weight.asDiagonal();
  const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(of_lines).eigenvalues();
  CHECK(eigenvalues[0] > -1e-3 * eigenvalues.maxCoeff());
}

TEST_CASE("a helical pair told as a train is the pair") {
  const Train train(kUneven);
  Scene scene = train.scene;
  scene.carriers.clear();
  scene.gears.pop_back();
  scene.meshes.pop_back();
  for (SceneGear& gear : scene.gears) gear.bearing = {};
  scene.drives = {{"sun", System::DriveKind::torque, kTrainTorque, 0},
                  {"planet", System::DriveKind::held, 0, 0}};
  const std::vector<ReducedBody> bodies{train.bodies[0], train.bodies[1]};
  const SystemStaticResult a = system_at_rest(static_parameters_of(scene, layout_of(scene)), bodies);
  StaticParameters settings{scene.meshes[0].spec, scene.fidelity, scene.contact};
  const SystemStaticResult b = pair_at_rest(bodies[0], bodies[1], settings, kTrainTorque);
  CHECK(largest_change(a, b) < 1e-9 * b.mesh[0].transmission_error.maxCoeff());
  CHECK(a.mesh[0].face.load_factor == relative(b.mesh[0].face.load_factor, 1e-9));
  CHECK(a.mesh[0].face.least_eigenvalue == relative(b.mesh[0].face.least_eigenvalue, 1e-9));
  CHECK(a.axial_force(2, 0) == relative(b.axial_force(2, 0), 1e-9));
  CHECK(a.axial_force(2, 0) == relative(b.mesh[0].face.axial_force, 1e-9));
  CHECK(a.mesh[0].loss_factor == relative(b.mesh[0].loss_factor, 1e-9));
  // The pair stands on a line along y, the train along x.
  for (const Index body : {0, 1}) {
    const auto &of_train = a.tilting_moment[2], &of_pair = b.tilting_moment[2];
    CHECK(of_train(body, 0) == relative(of_pair(body, 1), 1e-9));
    CHECK(of_train(body, 1) == relative(-of_pair(body, 0), 1e-9));
  }
}

TEST_CASE("three helical gears in line: the idler's meshes push it to one side each and tilt it") {
  const Train train(kHelical);
  Scene scene = train.scene;
  scene.carriers.clear();
  scene.gears[2] = scene.gears[0];
  scene.gears[2].name = "ring";  // an external gear like the sun
  for (SceneGear& gear : scene.gears) gear.bearing = {};
  scene.drives = {{"sun", System::DriveKind::torque, kTrainTorque, 0},
                  {"ring", System::DriveKind::held, 0, 0}};
  const SystemStaticResult a = system_at_rest(static_parameters_of(scene, layout_of(scene)),
                                              {train.bodies[0], train.bodies[1], train.bodies[0]});
  for (Index i = 0; i < kPositions; ++i) {
    CHECK(a.axial_force(i, 0) > 0);
    CHECK(std::abs(a.axial_force(i, 1)) < 1e-9 * a.axial_force(i, 0));
    CHECK(a.axial_force(i, 2) == relative(-a.axial_force(i, 0), 1e-9));
    // The gears stand on a line along x, so that the planet's moment is about y.
    CHECK(std::abs(a.tilting_moment[static_cast<size_t>(i)](1, 1)) ==
          relative(a.axial_force(i, 0) * 36 * kTrainModule, 0.15));
  }
}

TEST_CASE("statics of a train converge in the number of points") {
  Design d = kHelical;
  d.points = 16;
  const SystemStaticResult fine = Train(d).at_rest();
  const double scale = peak_to_peak(fine.mesh[0].transmission_error);
  std::vector<double> off;
  for (const int points : {2, 4, 8}) {
    d.points = points;
    off.push_back(largest_change(Train(d).at_rest(), fine) / scale);
    MESSAGE(points << " points: off by " << off.back() << " of the peak to peak, " << scale * 1e9 << " nm");
  }
  CHECK(off[1] < 0.4 * off[0]);
  CHECK(off[2] < 0.6 * off[1]);  // kinks where lines come in
  CHECK(off[2] < 1e-3);
}

TEST_CASE(
    "an overlap ratio near 1 and whole, two points, a line that ends in a corner: forces stay continuous") {
  // b tan(beta_b) = p_bt at beta_1; beside it by 1e-6.
  const GearDesign section = rigid_gear(27);
  const double pitch = std::numbers::pi * section.module * std::cos(section.pressure_angle),
               tangent = pitch / section.face_width;
  // tan(beta_b) = tan(beta) cos(alpha_t)
  const double whole = std::atan(tangent / std::cos(section.pressure_angle));
  SystemStaticResult first;
  for (const double beta : {whole, whole * (1 + 1e-6), whole * (1 - 1e-6)}) {
    const SystemStaticResult a = Train({.beta = beta, .points = 2}).at_rest();
    CHECK(a.mesh[0].face.overlap_ratio == relative(1, 1e-5));
    CHECK(a.torque_residual < 1e-10);
    if (first.mesh.empty()) first = a;
    CHECK(largest_change(a, first) < 1e-4 * first.mesh[0].transmission_error.maxCoeff());
  }
}

TEST_CASE("a helical train at a slow speed is that at rest, its energy closes, and hands do not matter") {
  constexpr int kSteps = 48;
  const Design design{.beta = kTwelve, .points = 3, .misalignment = 15 * kMicro};
  Moving a(design, kSteps);
  SystemModel still = *a.system;
  SystemStatics statics(still, ContactModel::line, static_zones(still, 4, 1, 1));
  a.dynamics->set_speed(20, kSteps);
  for (const int i : {0, 7, 31}) {
    const SystemSolution& rest = statics.solve(static_cast<double>(i) / kSteps, 0, VectorXd::Zero(6));
    const VectorXd p = a.dynamics->rest_forces(i);
    CHECK(p.sum() == relative(rest.equilibrium.p.sum(), 1e-8));
    CHECK(p.maxCoeff() == relative(rest.equilibrium.p.maxCoeff(), 1e-7));
  }
  a.run(20, kSteps, 2);
  VectorXd at_rest(kSteps);
  for (int i = 0; i < kSteps; ++i)
    at_rest[i] = statics.solve(static_cast<double>(i) / kSteps, 0, VectorXd::Zero(6)).transmission_error[0];
  const VectorXd slow = a.period.transmission_error.row(0);
  CHECK((slow - at_rest).cwiseAbs().maxCoeff() < 0.05 * peak_to_peak(at_rest));
  // Forces of both are along the normals.
  CHECK(a.period.mesh_force.topRows(3).colwise().sum().mean() ==
        relative(Train(design).at_rest().mesh_force.leftCols(3).rowwise().sum().mean(), 1e-3));
  a.state = {};
  Design left = design;
  left.of_sun = Hand::left;
  left.misalignment = -design.misalignment;
  Moving b(left, kSteps);
  for (Moving* train : {&a, &b}) train->run(2500, kSteps, 12);
  CHECK((a.period.transmission_error - b.period.transmission_error).cwiseAbs().maxCoeff() <
        1e-8 * a.period.transmission_error.cwiseAbs().maxCoeff());
  CHECK(a.period.face[0].load_factor == relative(b.period.face[0].load_factor, 1e-7));
  EnergyBalance energy;
  REQUIRE(a.dynamics->integrate(a.state, a.period, &energy));
  CHECK(energy.imbalance < 1e-9 * energy.throughput);
  CHECK(energy.relaxation_damping > 0);
}

TEST_CASE("the tangent of a period of a helical train is that of central differences") {
  constexpr int kSteps = 32;
  Moving train({.beta = kTwelve, .points = 2, .misalignment = 5 * kMicro}, kSteps);
  SystemPeriodMap map(*train.dynamics, kSteps);
  map.set_parameter(1500);
  const PeriodicMotion motion = iterate_to_orbit(map, map.rest(), {1e-9, 3000, true});
  REQUIRE(motion.multiple == 1);
  check_tangent(map, motion.state, 2 * train.dynamics->coordinates().size());
}
