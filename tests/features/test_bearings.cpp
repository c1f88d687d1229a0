// Gears on elastic bearings: statics in series, natural frequencies of the lumped pair, motion, energy, limits.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "base/dense.h"
#include "base/error.h"
#include "base/model_range.h"
#include "dynamics/impact.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "signal/response.h"

using namespace whine;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLoad = 150 / 70.476944e-3;  // N, of 150 N m: rounded

const ReducedBody& coarse_body() {
  return paper_body(40e-3, 1.2e-3, 12);
}

// Different bearings of the two gears, so that no symmetry hides an exchange.
std::array<Bearing, 2> soft(double damping = 0, double factor = 1) {
  return {Bearing{200e6 * factor, damping, 0}, Bearing{120e6 * factor, 1.5 * damping, 0}};
}

StaticParameters statics_on(const std::array<Bearing, 2>& bearing, bool corner,
                            ContactModel contact = ContactModel::strips) {
  StaticParameters settings = paper_statics(16);
  settings.mesh.bearing = bearing;
  settings.mesh.corner.enabled = corner;
  settings.fidelity.contact = contact;
  return settings;
}

StaticResult at_rest(const StaticParameters& settings, const ReducedBody& body = coarse_body()) {
  return static_transmission(body, body, settings, 150);
}

double force_along(const GearMeshModel& model) {
  return 150 / model.kinematics.gear(0).base_radius();
}

// A pair in motion on a range that holds several times the load.
struct Rig {
  Rig(const StaticParameters& settings, const DynamicParameters& parameters, int steps = 64,
      const ReducedBody& body = coarse_body())
      : model(body, body, settings.mesh), dynamics(model, parameters) {
    const double load = force_along(model);
    dynamics.set_zone(candidate_zone(model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(),
                                     8, load / model.kinematics.contact_ratio(), 3 * load, 20e-6),
                      steps);
    state = dynamics.rest();
  }
  GearMeshModel model;
  RollingDynamics dynamics;
  RollingDynamics::State state;
};

DynamicParameters parameters_of(BodyModel body, ContactModel contact = ContactModel::strips) {
  DynamicParameters p = paper_parameters(463e6, body, contact);
  p.inertia = {0.0148, 0.0260};
  return p;
}

// Hz, ascending: torsion and two translations of each gear, a mesh of stiffness k between them.
VectorXd lumped_frequencies(const GearMeshModel& model, const std::vector<double>& inertia,
                            const std::array<double, 2>& mass, double k) {
  MatrixXd m = MatrixXd::Zero(6, 6), stiffness = MatrixXd::Zero(6, 6);
  VectorXd row(6);
  const double a = model.kinematics.working_pressure_angle();
  for (int g = 0; g < kSides; ++g) {
    const double sign = g == 0 ? 1 : -1;
    row.segment<3>(3 * g) << model.kinematics.gear(g).base_radius(), -sign * std::cos(a), sign * std::sin(a);
    m.diagonal().segment<3>(3 * g) << inertia[g], mass[g], mass[g];
    for (int i = 1; i < 3; ++i) stiffness(3 * g + i, 3 * g + i) = model.bearing[g].stiffness;
  }
  stiffness += k * row * row.transpose();
  return symmetric_eigen(stiffness, m).values.cwiseMax(0).cwiseSqrt() / (2 * kPi);
}

}  // namespace

TEST_CASE(
    "bearings at rest stand in series with the mesh, press as the load does, and are rigid in the limit") {
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    const StaticResult rigid = at_rest(statics_on({}, false, contact)),
                       on = at_rest(statics_on(soft(), false, contact)),
                       stiff = at_rest(statics_on(soft(0, 1e8), false, contact));
    const GearMeshModel model(coarse_body(), coarse_body(), on.mesh);
    const double load = force_along(model), give = load / 200e6 + load / 120e6;
    CHECK(rigid.bearing_force[0].size() == 0);
    const double a = model.kinematics.working_pressure_angle();
    for (int i = 0; i < 16; ++i) {
      CHECK(on.transmission_error[i] == relative(rigid.transmission_error[i] + give, 1e-10));
      CHECK(on.stiffness_secant[i] == relative(rigid.stiffness_secant[i], 1e-9));
      CHECK(on.stiffness_tangent[i] == relative(rigid.stiffness_tangent[i], 1e-8));
      CHECK(stiff.transmission_error[i] == relative(rigid.transmission_error[i], 1e-6));
      CHECK(stiff.transmission_error[i] > rigid.transmission_error[i]);
      // The driver turns counter-clockwise below the driven gear: it is pushed to the right and down.
      CHECK(on.bearing_force[0](i, 0) == relative(load * std::cos(a), 1e-11));
      CHECK(on.bearing_force[0](i, 1) == relative(-load * std::sin(a), 1e-11));
      CHECK((on.bearing_force[0] + on.bearing_force[1]).cwiseAbs().maxCoeff() < 1e-11 * load);
    }
  }
  // With corners, whose normals are tilted, the forces still are those of the teeth: nearly along the line of action.
  const StaticResult on = at_rest(statics_on(soft(), true)), rigid = at_rest(statics_on({}, true));
  for (int i = 0; i < 16; ++i) {
    CHECK(on.bearing_force[0].row(i).norm() == relative(kLoad, 3e-3));
    // Hubs that give way along the line of action part a tilted corner by a little less.
    CHECK(on.stiffness_secant[i] == relative(rigid.stiffness_secant[i], 0.03));
  }
}

TEST_CASE(
    "rigid bodies on bearings have the six natural frequencies of the lumped pair with the same stiffness") {
  const DynamicParameters parameters = parameters_of(BodyModel::rigid);
  const StaticParameters settings = statics_on(soft(), false);
  Rig on(settings, parameters), rigid(statics_on({}, false), parameters);
  const std::array<double, 2> mass{coarse_body().mass, coarse_body().mass};
  const double r = on.model.kinematics.gear(0).base_radius();
  for (const int phase : {0, 20, 40}) {
    const double w = 2 * kPi * rigid.dynamics.frozen_frequency(phase),
                 stiffness = w * w / (r * r / parameters.inertia[0] + r * r / parameters.inertia[1]);
    const VectorXd lumped = lumped_frequencies(on.model, parameters.inertia, mass, stiffness),
                   found = on.dynamics.frozen_frequencies(phase);
    REQUIRE(found.size() == 5);
    CHECK(lumped[0] < 1e-2);  // the rolling of the pair, which is projected out
    for (int i = 0; i < 5; ++i) CHECK(found[i] == relative(lumped[i + 1], 1e-9));
    // Across the line of action nothing couples.
    for (const double alone :
         {std::sqrt(200e6 / mass[0]) / (2 * kPi), std::sqrt(120e6 / mass[1]) / (2 * kPi)})
      CHECK((found.array() / alone - 1).abs().minCoeff() < 1e-9);
    CHECK(found[4] ==
          relative(on.dynamics.frozen_frequency(phase), 1e-12));  // the mesh is the stiffest spring
  }
}

TEST_CASE(
    "elastic bodies without mass of their own on bearings: the lumped pair again, with their compliance") {
  // All mass and inertia on the hubs. A body of a hundred thousandth of the density has modes at 300 times the frequency.
  Material light = paper_steel();
  light.density *= 1e-5;
  BodyDiscretisation discretisation;
  discretisation.element_size = 1.2e-3;
  discretisation.modes = 12;
  const ReducedBody body = reduce(make_sector_mesh(paper_gear(), discretisation), light, 12);
  std::array<Bearing, 2> bearing = soft();
  bearing[0].mass = 2.5;
  bearing[1].mass = 3.5;
  const DynamicParameters parameters = parameters_of(BodyModel::modal);
  Rig on(statics_on(bearing, false), parameters, 64, body),
      rigid(statics_on({}, false), parameters, 64, body);
  const double r = on.model.kinematics.gear(0).base_radius();
  for (const int phase : {0, 20, 40}) {
    const double w = 2 * kPi * rigid.dynamics.frozen_frequency(phase),
                 stiffness = w * w / (r * r / parameters.inertia[0] + r * r / parameters.inertia[1]);
    const VectorXd lumped = lumped_frequencies(on.model, parameters.inertia, {2.5, 3.5}, stiffness),
                   found = on.dynamics.frozen_frequencies(phase);
    for (int i = 0; i < 5; ++i) CHECK(found[i] == relative(lumped[i + 1], 1e-6));
    CHECK(found[5] > 100 * found[4]);
  }
}

TEST_CASE("at rest all levels of body give the transmission error of rigid axes and the bearings in series") {
  for (const auto level : {BodyModel::rigid, BodyModel::quasi_static, BodyModel::relaxed, BodyModel::modal})
    for (const auto contact : {ContactModel::strips, ContactModel::line}) {
      const DynamicParameters parameters = parameters_of(level, contact);
      const auto settings = [&](const std::array<Bearing, 2>& bearing) {
        return statics_on(bearing, false, contact);
      };
      const auto settled = [&](const StaticParameters& of) {
        const GearMeshModel model(coarse_body(), coarse_body(), of.mesh);
        RollingDynamics dynamics(model, parameters);
        const StaticResult statics = at_rest(of);
        dynamics.set_zone(candidate_zone(model, statics, MotionBounds(model, statics)), 16);
        dynamics.rest();
        return dynamics.static_deflection();
      };
      const double load = 150 / ToothGeometry(paper_gear()).base_radius();
      CHECK(settled(settings(soft())) - settled(settings({})) == relative(load / 200e6 + load / 120e6, 1e-8));
    }
}

TEST_CASE("a period on bearings closes its energy balance; the mean bearing force is the load") {
  for (const auto level : {BodyModel::rigid, BodyModel::quasi_static, BodyModel::modal})
    for (const auto contact : {ContactModel::strips, ContactModel::line})
      for (const auto integrator : {Integrator::exact, Integrator::newmark}) {
        DynamicParameters parameters = parameters_of(level, contact);
        parameters.fidelity.integrator = integrator;
        Rig rig(statics_on(soft(4000), true, contact), parameters);
        rig.dynamics.set_speed(900, 64);
        RollingDynamics::Period period;
        EnergyBalance energy_balance;
        REQUIRE(rig.dynamics.integrate(rig.state, period));
        for (int i = 0; i < 3; ++i) REQUIRE(rig.dynamics.integrate(rig.state, period, &energy_balance));
        CHECK(energy_balance.imbalance < 1e-9 * energy_balance.throughput);
        CHECK(energy_balance.modal_damping > 0);
      }
}

TEST_CASE(
    "a sweep on bearings: forces on the bearings balance those of the teeth, response, stiff bearings") {
  const auto swept = [](BodyModel level, const std::array<Bearing, 2>& bearing) {
    StaticParameters rest = statics_on(bearing, false);
    rest.contact.positions = 32;
    const StaticResult statics = at_rest(rest);
    SweepParameters settings = paper_sweep(1200, 1400, 200);
    settings.fidelity.body = level;
    settings.time.steps_per_period = 32;
    settings.time.min_sample_rate = 60e3;
    settings.time.periodicity = 1e-9;
    settings.damping.rayleigh_mass = 3000;  // of rigid bodies nothing else is damped
    return sweep(coarse_body(), coarse_body(), statics, statics.mean_stiffness, settings, Direction::up,
                 no_report);
  };
  const SweepResult on = swept(BodyModel::modal, soft(4000));
  const double load = 150 / ToothGeometry(paper_gear()).base_radius();
  const ResponseResult heard = response(on);
  for (int g = 0; g < kSides; ++g)
    for (int f = 0; f < 2; ++f) {
      const MatrixRM& force = on.bearing_force[g][f];
      REQUIRE(force.rows() == on.samples());
      const Eigen::RowVector2d mean = force.colwise().mean();
      const double a = 20 * kPi / 180, sign = g == 0 ? 1 : -1;
      CHECK((mean - sign * load * Eigen::RowVector2d(std::cos(a), -std::sin(a))).norm() < 1e-6 * load);
      CHECK(heard.bearing_force_max(f, g) == relative(force.rowwise().norm().maxCoeff(), 1e-14));
      CHECK(heard.bearing_force_rms(f, g) ==
            relative(std::sqrt((force.rowwise() - mean).rowwise().squaredNorm().mean()), 1e-12));
      CHECK(heard.bearing_force_rms(f, g) > 0.01 * load);
      CHECK(std::abs(on.energy_imbalance[f]) < 1e-8);
      // All on the line of action: nothing moves across it.
      const VectorXd across = force * Eigen::Vector2d(std::sin(a), std::cos(a));
      CHECK(across.cwiseAbs().maxCoeff() < 0.02 * load);
    }
  // Rigid axes are the limit, of first order in the flexibility of the bearings. With them one-diameter modes stand in another
  // frame, see dynamics.h, which leaves 3e-7 here.
  for (const auto level : {BodyModel::rigid, BodyModel::modal}) {
    const SweepResult rigid = swept(level, {});
    const auto off = [&](double factor) {
      const SweepResult soft_axes = swept(level, soft(0, factor));
      double most = 0, largest = 0;
      for (size_t f = 0; f < rigid.transmission_error.size(); ++f) {
        const MatrixRM& error = rigid.transmission_error[f];
        most = std::max(most, (soft_axes.transmission_error[f] - error).cwiseAbs().maxCoeff());
        largest = std::max(largest, error.cwiseAbs().maxCoeff());
      }
      return most / largest;
    };
    CHECK(off(1e9) < 1e-6);
    CHECK(off(1e5) / off(1e6) == relative(10, 0.1));
  }
}

TEST_CASE("ring-down on bearings: the decay has the eigenvalue that the frozen contact says") {
  StaticParameters rest = statics_on(soft(2000), true);
  rest.contact.positions = 64;
  rest.contact.strips = 15;
  const StaticResult statics = at_rest(rest);
  SweepParameters settings;
  settings.inertia[0] = settings.inertia[1] = 0.0148;
  settings.damping.rayleigh_stiffness = 7.7e-6;
  settings.reference_torque = 100;
  const ImpactResult result = impact(coarse_body(), coarse_body(), statics, 463e6, settings,
                                     {ImpactPlan().torque_step, 16}, no_report);
  for (int i = 0; i < 16; ++i) {
    CHECK(result.natural_frequency(i, 0) == relative(result.eigen_frequency(i, 0), 1e-4));
    CHECK(result.damping_ratio(i, 0) == relative(result.eigen_damping_ratio(i, 0), 1e-3));
    CHECK(result.eigen_frequency(i, 0) == relative(result.undamped_frequency(i, 0), 0.02));
    REQUIRE(result.frozen_frequency.cols() == 5);
    CHECK(result.frozen_frequency(i, 4) == relative(result.undamped_frequency(i, 0), 1e-12));
  }
}

TEST_CASE(
    "what is left out of a bearing's damper is second order in it, and nothing where it is proportional") {
  // z'' + C z' + W z = 0 of the pair without contact: all of C, and its diagonal, which steps use.
  struct Roots {
    Eigen::VectorXcd all, diagonal;
  };
  const auto roots = [](double damping, double eta) {
    DynamicParameters parameters = parameters_of(BodyModel::modal);
    parameters.damping.rayleigh_stiffness = eta;
    const StaticParameters settings =
        statics_on({Bearing{200e6, damping, 0}, Bearing{200e6, damping, 0}}, false);
    const GearMeshModel model(coarse_body(), coarse_body(), settings.mesh);
    RollingDynamics dynamics(model, parameters);
    dynamics.set_zone(candidate_zone(model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(),
                                     8, 1000, 4000, 20e-6),
                      16);
    const VectorXd w2 = dynamics.hold(0).frequency_squared;
    const MatrixXd c = dynamics.bearing_damping();
    const Eigen::Index n = w2.size();
    const auto sorted = [&](const MatrixXd& damper) {
      // In z and v / w0, of one size.
      const double w0 = 1e4;
      MatrixXd a = MatrixXd::Zero(2 * n, 2 * n);
      a.topRightCorner(n, n).diagonal().setConstant(w0);
      a.bottomLeftCorner(n, n).diagonal() = -w2 / w0;
      a.bottomRightCorner(n, n) = -damper;
      Eigen::VectorXcd s = general_eigenvalues(a).values;
      std::vector<std::complex<double>> up;
      for (const auto& root : s)
        if (root.imag() > 1) up.push_back(root);
      std::sort(up.begin(), up.end(), [](const auto& x, const auto& y) { return std::abs(x) < std::abs(y); });
      return Eigen::VectorXcd(Eigen::Map<Eigen::VectorXcd>(up.data(), static_cast<Eigen::Index>(up.size())));
    };
    return Roots{sorted(c), sorted(c.diagonal().asDiagonal())};
  };
  const auto off = [](const Roots& r) {  // of the two lowest, hub on bearing, of each gear
    return std::abs(r.all[0] / r.diagonal[0] - 1.0);
  };
  const double small = off(roots(2000, 1e-6)), twice = off(roots(4000, 1e-6));
  INFO(small << " " << twice);
  CHECK(twice < 1e-4);  // 4000 N s/m: 9 % of critical damping on the bearing
  CHECK(twice / small == relative(4, 0.5));
  CHECK(off(roots(200e6 * 7.7e-6, 7.7e-6)) < 1e-12);
}

TEST_CASE(
    "a bearing that lets teeth stand beside their places is refused, with what it moves and the limit") {
  const auto said = [](double stiffness) {
    return message_of([&] {
      at_rest(statics_on({Bearing{stiffness, 0, 0}, Bearing{stiffness, 0, 0}}, true));
    });
  };
  CHECK(said(1e7).empty());
  CHECK(names(said(1e6), {"4.26*", "0.75", "quarter", "stiffness_N_um", "[[bearing]]"}));
}

TEST_CASE("bearings are rejected where they cannot be: a mass below the body's, too few modes, every mode") {
  const auto rejection = [](const Bearing& bearing, const ReducedBody& body, BodyModel level) {
    const GearMeshModel model(body, body, statics_on({bearing, {}}, true).mesh);
    return message_of_input([&] { RollingDynamics(model, parameters_of(level)); });
  };
  CHECK(rejection({1e8, 0, 0}, coarse_body(), BodyModel::modal).empty());
  CHECK(rejection({1e8, 0, 0.5}, coarse_body(), BodyModel::rigid)
            .find("mass_kg = 0.5 in the [[bearing]] of the driver") == 0);
  CHECK(names(rejection({1e8, 0, 0}, coarse_body(), BodyModel::full),
              {"body", "full", "[fidelity]", "modal", "[[bearing]]"}));
  ReducedBody torsion = paper_body(40e-3, 1.2e-3, 0);
  CHECK(names(rejection({1e8, 0, 0}, torsion, BodyModel::relaxed), {"diameter", "nodal"}));
  CHECK(rejection({1e8, 0, 0}, torsion, BodyModel::rigid).empty());
}
