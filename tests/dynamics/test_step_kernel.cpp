// The time step on lanes against its equations in plain matrices: periods of the paper's pair in every variant, random data.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "dynamics/step_kernel.h"
#include "paper_pair.h"
#include "step_kernel_reference.h"

using namespace whine;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kSteps = 64;

struct Kind {
  BodyModel body;
  ContactModel contact;
  Integrator integrator;
  bool bearings = false;
  double frequency = 2600;  // Hz
  double friction = 0;      // 1
};

// The paper's pair at 150 N m.
struct Rig {
  explicit Rig(const Kind& kind)
      : statics(static_transmission(body(), body(), settings(kind), 150)),
        model(body(), body(), statics.mesh),
        dynamics(model, parameters(statics, kind)) {
    dynamics.set_zone(candidate_zone(model, statics, MotionBounds(model, statics, 2.56)), 2 * kSteps);
    dynamics.set_speed(kind.frequency, kSteps);
  }
  static const ReducedBody& body() { return paper_body(40e-3, 1.2e-3, 12); }
  static StaticParameters settings(const Kind& kind) {
    StaticParameters s = paper_statics(16);
    s.fidelity.contact = kind.contact;
    s.mesh.friction.coefficient = kind.friction;
    if (kind.bearings) {
      s.mesh.bearing[0] = Bearing{200e6, 3e3, 0};
      s.mesh.bearing[1] = Bearing{120e6, 5e3, 0};
    }
    return s;
  }
  static DynamicParameters parameters(const StaticResult& statics, const Kind& kind) {
    DynamicParameters p = paper_parameters(statics.mean_stiffness, kind.body, kind.contact);
    p.damping.rayleigh_stiffness = 5.5e-6;
    p.fidelity.integrator = kind.integrator;
    if (kind.friction > 0) p.loss_per_friction = (1 - statics.efficiency) / kind.friction;
    return p;
  }
  StaticResult statics;
  GearMeshModel model;
  RollingDynamics dynamics;
};

double off(const MatrixXd& found, const MatrixXd& expected) {
  if (found.rows() != expected.rows() || found.cols() != expected.cols() || !found.allFinite())
    return std::numeric_limits<double>::infinity();
  const double size = expected.cwiseAbs().maxCoeff();
  return size > 0 ? (found - expected).cwiseAbs().maxCoeff() / size : found.cwiseAbs().maxCoeff();
}

double off(const std::vector<MatrixXd>& found, const std::vector<MatrixXd>& expected) {
  if (found.size() != expected.size()) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (size_t i = 0; i < expected.size(); ++i) worst = std::max(worst, off(found[i], expected[i]));
  return worst;
}

// Of all that a state is, each part relative to its largest number.
double off(const StepState& found, const StepState& expected) {
  return std::max({off(found.z, expected.z), off(found.v, expected.v), off(found.force, expected.force),
                   off(found.p, expected.p), off(found.relaxed, expected.relaxed),
                   off(found.load, expected.load)});
}

const Kind kKinds[] = {{BodyModel::modal, ContactModel::strips, Integrator::exact},
                       {BodyModel::modal, ContactModel::strips, Integrator::newmark},
                       {BodyModel::modal, ContactModel::line, Integrator::exact},
                       {BodyModel::modal, ContactModel::line, Integrator::newmark},
                       {BodyModel::relaxed, ContactModel::strips, Integrator::exact},
                       {BodyModel::relaxed, ContactModel::line, Integrator::newmark},
                       {BodyModel::quasi_static, ContactModel::strips, Integrator::exact},
                       {BodyModel::quasi_static, ContactModel::line, Integrator::exact},
                       {BodyModel::rigid, ContactModel::strips, Integrator::exact},
                       {BodyModel::rigid, ContactModel::line, Integrator::newmark},
                       {BodyModel::modal, ContactModel::strips, Integrator::exact, true},
                       {BodyModel::modal, ContactModel::line, Integrator::newmark, true},
                       {BodyModel::modal, ContactModel::strips, Integrator::exact, false, 1400},
                       {BodyModel::modal, ContactModel::strips, Integrator::exact, true, 2600, 0.1},
                       {BodyModel::modal, ContactModel::line, Integrator::newmark, true, 2600, 0.1},
                       {BodyModel::relaxed, ContactModel::line, Integrator::exact, false, 2600, 0.1}};

// Random numbers that are the same on every machine.
struct Random {
  std::mt19937 engine{20001};
  double operator()() { return static_cast<double>(engine()) / 0x1p31 - 1; }  // -1 to 1
  VectorXd vector(Eigen::Index n, double size) { return matrix(n, 1, size); }
  MatrixXd matrix(Eigen::Index rows, Eigen::Index columns, double size) {
    MatrixXd m(rows, columns);
    for (double& x : m.reshaped()) x = size * (*this)();
    return m;
  }
  MatrixXd definite(Eigen::Index n, double size) {
    const MatrixXd m = matrix(n, n, 1);
    return size * (m * m.transpose() / static_cast<double>(n) + 0.1 * MatrixXd::Identity(n, n));
  }
};

// Positions of the paper's pair, all of whose matrices are random, of any number of coordinates.
struct RandomSteps {
  RandomSteps(const RollingDynamics& like, int coordinates, Random& random)
      : system(like.kernel().system()), positions(like.positions()) {
    constexpr double kCompliance = 1e-9;  // m N-1
    constexpr int kFields = StepKernel::kFields;
    system.torque_force = random.vector(coordinates, 0);
    system.error_weight = system.torque_force;
    for (const int i : {0, 1, coordinates - 2}) {
      system.torque_force[i] = 500 * random();
      system.error_weight[i] = random();
    }
    system.torque_force[0] = 4000;
    system.turns = {{2, 3, std::cos(0.7), std::sin(0.7)}, {4, -1, -1, 0}};
    for (auto& side : system.coupling)
      for (MatrixXd& block : side) block = random.matrix(block.rows(), block.cols(), 0.1 * kCompliance);
    for (MatrixXd& m : system.half_plane) m = random.definite(m.rows(), kCompliance);
    const StepKernel::ShapeBasis& basis = StepKernel::shape_basis();
    for (StepPosition& position : positions) {
      const int nodes = position.mesh.nodes();
      position.instantaneous_compliance = random.definite(nodes, kCompliance);
      position.relaxed = random.definite(nodes, kCompliance);
      position.participation = random.matrix(nodes, coordinates, 1);
      position.participation.col(0).setConstant(2);
      for (size_t j = 0; !system.lines && j < position.mesh.pairs.size(); ++j) {
        auto rows = position.participation.middleRows<kZoneNodes>(static_cast<int>(j) * kZoneNodes);
        rows = (basis * (basis.transpose() * rows)).eval();
      }
      for (MatrixXd& weight : position.field_weight) weight = random.matrix(nodes, kFields, 1);
      for (PairStrips& s : position.mesh.pairs)
        s.low_is_edge = s.high_is_edge = true;  // force may stand there
      position.mesh.gap = random.vector(position.mesh.gap.size(), 1e-6);
    }
    for (int i = 0; i < coordinates; ++i)
      propagators.push_back(exact_propagator(1e4 * (1.5 + random()), 1e3 * (1 + random()), 1e-5));
    relaxed = relaxation_step(2e-5, 1e-5);
    state.z = random.vector(coordinates, 1e-6);
    state.v = random.vector(coordinates, 1e-2);
    state.force = system.torque_force + random.vector(coordinates, 1000);
    for (int side = 0; side < StepKernel::kSides; ++side) {
      state.relaxed.push_back(random.matrix(kFields, system.teeth(), 100));
      state.load.push_back(random.matrix(kFields, system.teeth(), 100));
    }
  }
  StepSystem system;
  std::vector<StepPosition> positions;
  std::vector<Propagator> propagators;
  Relaxation relaxed;
  StepState state;
};

}  // namespace

TEST_CASE("step kernel: a mesh period of the paper's pair is that of the equations in plain matrices") {
  for (const Kind& kind : kKinds) {
    INFO(kind.body << " " << kind.contact << " " << kind.integrator << (kind.bearings ? " on bearings" : "")
                   << ", friction " << kind.friction);
    Rig rig(kind);
    RollingDynamics& dynamics = rig.dynamics;
    RollingDynamics::State state = dynamics.rest(), balanced;
    RollingDynamics::Period period;
    for (int i = 0; i < 4; ++i) REQUIRE(dynamics.integrate(state, period));
    StepState plain = state;
    balanced = state;
    const StepReference reference(dynamics.kernel().system(), dynamics.kernel().propagators(),
                                  dynamics.kernel().relaxed(), dynamics.friction());
    VectorXd error(kSteps);
    for (int i = 1; i <= kSteps; ++i) {
      if (i == kSteps) reference.rename(plain);
      error[i % kSteps] = reference.step(plain, dynamics.positions()[static_cast<size_t>(i % kSteps * 2)]);
    }
    // Pipelined, and with each instant looked at.
    EnergyBalance energy_balance;
    REQUIRE(dynamics.integrate(balanced, period, &energy_balance));
    REQUIRE(dynamics.integrate(state, period));
    CHECK(off(period.transmission_error, error) < 1e-12);
    CHECK(off(state, plain) < 1e-11);
    CHECK(off(balanced, plain) < 1e-11);
    CHECK(state.p.sum() > 0);
  }
}

TEST_CASE(
    "step kernel: on random data each step is that of the equations, whatever the number of coordinates") {
  Random random;
  for (const ContactModel contact : {ContactModel::strips, ContactModel::line}) {
    Rig rig({BodyModel::modal, contact, Integrator::exact});
    for (const int coordinates : {7, 12, 41}) {
      INFO(contact << " " << coordinates);
      const RandomSteps data(rig.dynamics, coordinates, random);
      StepKernel kernel;
      kernel.set_zone(data.system, data.positions);
      kernel.set_speed(data.propagators, data.relaxed, kSteps, data.positions);
      const StepReference reference(kernel.system(), data.propagators, data.relaxed);
      StepState found = data.state, expected = data.state;
      kernel.load_state(found);
      int touched = 0, parted = 0;
      double worst = 0;
      for (int i = 1; i < kSteps; ++i) {
        const StepPosition& position = data.positions[static_cast<size_t>(2 * i)];
        // From the same state, so that what is compared is one step; a renaming every tenth.
        if (i % 10 == 0) {
          kernel.rename();
          reference.rename(expected);
        }
        kernel.predict(i);
        const StepKernel::End end = kernel.correct(i, -1);
        REQUIRE(end.contact != StepKernel::Contact::zone_end);
        kernel.store_state(found, position.mesh.strips());
        const double error = reference.step(expected, position);
        REQUIRE(std::isfinite(end.error));
        const double terms = data.system.error_weight.cwiseAbs().dot(expected.z.cwiseAbs());
        worst = std::max({worst, off(found, expected), std::abs(end.error - error) / terms});
        touched += (expected.p.array() > 0).any();
        parted += (expected.p.array() == 0).any();
        found = expected;
        kernel.load_state(found);
      }
      CHECK(worst < 1e-12);
      // Steps that begin in the pass that ends the one before, of as many pairs as there are.
      expected = data.state;
      kernel.load_state(expected);
      kernel.predict(1);
      double drift = 0;
      for (int i = 1; i < kSteps; ++i) {
        const StepKernel::End end = kernel.correct(i, i + 1 < kSteps ? i + 1 : -1);
        const double error = reference.step(expected, data.positions[static_cast<size_t>(2 * i)]);
        REQUIRE(std::isfinite(end.error));
        const double terms = data.system.error_weight.cwiseAbs().dot(expected.z.cwiseAbs());
        drift = std::max(drift, std::abs(end.error - error) / terms);
      }
      kernel.store_state(found, static_cast<int>(expected.p.size()));
      CHECK(drift < 1e-10);
      CHECK(off(found, expected) < 1e-10);
      CHECK(touched > 10);
      CHECK(parted > 10);
    }
  }
}
