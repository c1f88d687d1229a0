// Hard cases of the dynamics with known answers.
//
// Expected values are closed forms, published formulas or the same quantity computed another way. The numbers H7 ... H32
// are those of a longer list of cases, the rest of which stands in tests/*/test_*.cpp.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/dense.h"
#include "base/error.h"
#include "contact/complementarity.h"
#include "dynamics/dynamics.h"
#include "dynamics/fixed_phase_motion.h"
#include "dynamics/newmark.h"
#include "hard_cases/gears.h"
#include "hard_cases/table.h"
#include "lumped_wave.h"
#include "signal/spectrum.h"
#include "solid/elements.h"
#include "solid/mesher.h"
#include "solid/reduce.h"

using namespace whine;
using namespace whine::hard_cases;
using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi;

// --- systems with known answers

// A unit mass against one strip: contact compliance `local` is instantaneous, `residual` with relaxation.
FixedPhaseMesh one_mass(double torque, double local, double residual = 0, double relaxation = 0) {
  FixedPhaseMesh mesh;
  mesh.frequency_squared = mesh.damping = VectorXd::Zero(1);
  mesh.torque = VectorXd::Constant(1, torque);
  mesh.error_weight = VectorXd::Ones(1);
  mesh.participation = MatrixXd::Ones(1, 1);
  mesh.local = MatrixXd::Constant(1, 1, local);
  mesh.residual = MatrixXd::Constant(1, 1, residual);
  mesh.gap = VectorXd::Zero(1);
  mesh.first_strip = {0, 1};
  mesh.relaxation = relaxation;
  return mesh;
}

// --- the cases

void rigid_rotation(Table& table) {
  const SectorGrid& mesh = coarse_mesh();
  const PlaneSystem system = assemble(mesh.node_position, mesh.element_node, steel(true), kFaceWidth);
  const VectorXd turn = rotation_field(mesh.node_position);
  table.at_most("rigid rotation makes no force: |K phi| / (|K| |phi|)", 1e-13,
                (system.stiffness * turn).norm() / (system.stiffness.norm() * turn.norm()));
  const VectorXd roll = Eigen::Vector3d(0.30, 0.36, 0.45);
  const VectorXd matched = make_matched_loads(mesh, steel(true), roll, 0.5e-3).force.transpose() * turn;
  const VectorXd subtracted = make_flank_loads(mesh, steel(true), roll).force.transpose() * turn;
  // Sides are parabolas through points of the involute.
  table.relative("torque of a unit flank force: base radius, m (nodal forces)", -kBaseRadius, matched[1],
                 1e-6);
  const double worst = std::max(
      std::abs(subtracted[0] / kBaseRadius + 1),
      std::max(std::abs(subtracted[1] / kBaseRadius + 1), std::abs(subtracted[2] / kBaseRadius + 1)));
  table.at_most("the same of the singularity-subtracted load at three roll angles, relative error", 1e-8,
                worst);

  // Polar moment by a finer rule than the mass matrix has.
  const GaussRule rule = gauss_rule(6);
  double moment = 0;
  for (Eigen::Index e = 0; e < mesh.element_node.rows(); ++e) {
    const auto count = mesh.element_node.cols();
    Eigen::MatrixX2d nodes(count, 2);
    for (Eigen::Index k = 0; k < count; ++k) nodes.row(k) = mesh.node_position.row(mesh.element_node(e, k));
    for (int i = 0; i < rule.point.size(); ++i)
      for (int j = 0; j < rule.point.size(); ++j) {
        const Shape shape = shape_functions(static_cast<int>(count), rule.point[i], rule.point[j]);
        moment += rule.weight[i] * rule.weight[j] * (nodes.transpose() * shape.slope).determinant() *
                  (nodes.transpose() * shape.value).squaredNorm();
      }
  }
  table.relative("energy of spin at 1 rad/s, J: half the polar moment by quadrature",
                 0.5 * 50 * 7600 * kFaceWidth * moment, 0.5 * 50 * turn.dot(system.mass * turn), 1e-8);
  table.relative("inertia that the reduced body reports, kg m2", 50 * 7600 * kFaceWidth * moment,
                 coarse_body().inertia, 1e-8);
}

// A clamped block of 3 x 4 elements pushed against a wall that two of its top nodes can touch.
void all_modes(Table& table) {
  constexpr int kColumns = 3, kRows = 4, kSteps = 10000;
  MatrixRM position((kColumns + 1) * (kRows + 1), 2);
  MatrixRMi element(kColumns * kRows, 4);
  const auto node = [](int i, int j) { return j * (kColumns + 1) + i; };
  for (int j = 0; j <= kRows; ++j)
    for (int i = 0; i <= kColumns; ++i) position.row(node(i, j)) << 1.3e-3 * i, 1.5e-3 * j;
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i)
      element.row(j * kColumns + i) << node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1);
  const PlaneSystem system = assemble(position, element, steel(false), kFaceWidth);
  const int clamped = 2 * (kColumns + 1), n = static_cast<int>(system.mass.rows()) - clamped;
  const MatrixXd k = MatrixXd(system.stiffness).bottomRightCorner(n, n),
                 m = MatrixXd(system.mass).bottomRightCorner(n, n);
  const double eta = 1e-6, mu = 3e3, step = 2e-6;
  const MatrixXd c = mu * m + eta * k;
  MatrixXd touching = MatrixXd::Zero(2, n);  // outward displacement of the two
  touching(0, 2 * node(1, kRows) + 1 - clamped) = touching(1, 2 * node(2, kRows) + 1 - clamped) = 1;
  MatrixXd local(2, 2);
  local << 4e-11, 1e-11, 1e-11, 5e-11;
  const Vector2d gap(1e-7, 2e-7);
  VectorXd push = VectorXd::Zero(n);
  for (int i = 0; i <= kColumns; ++i) push[2 * node(i, kRows) + 1 - clamped] = 1;
  const auto amplitude = [&](int s) { return 900 * (1 + 1.7 * std::sin(2 * kPi * 9e3 * s * step)); };

  // By modes, as the library steps.
  const SymmetricEigen eigen = symmetric_eigen(k, m);
  FixedPhaseMesh mesh;
  mesh.frequency_squared = eigen.values;
  mesh.damping = mu + eta * eigen.values.array();
  mesh.participation = touching * eigen.vectors;
  mesh.local = local;
  mesh.residual = MatrixXd::Zero(2, 2);
  mesh.gap = gap;
  mesh.newmark = true;
  mesh.torque = amplitude(0) * eigen.vectors.transpose() * push;
  FixedPhaseMotion modes(mesh, step);

  // In full space, with the sets of contact tried one by one.
  const MatrixXd effective = m + 0.5 * step * c + 0.25 * step * step * k;
  const Eigen::LDLT<MatrixXd> factor(effective), mass(m);
  const MatrixXd response = factor.solve(touching.transpose());
  const Eigen::Matrix2d contact = local + 0.25 * step * step * touching * response;
  const auto forces = [&](const Matrix2d& a, const Vector2d& e) {
    for (int set = 0; set < 4; ++set) {
      Vector2d p(0, 0);
      if (set == 1) p[0] = -e[0] / a(0, 0);
      if (set == 2) p[1] = -e[1] / a(1, 1);
      if (set == 3) p = a.inverse() * -e;
      const Vector2d d = a * p + e;
      if (p.minCoeff() >= 0 && d.minCoeff() >= -1e-12 * e.cwiseAbs().maxCoeff()) return p;
    }
    fail(Failure::numerical, "no set of contact fits");
  };
  // P2000 (8) with beta 1/4, gamma 1/2: old and older displacements and loads; and the same in one-step form.
  VectorXd older, old = VectorXd::Zero(n), load_older, load_old;
  VectorXd u = VectorXd::Zero(n), v = u, a = mass.solve(amplitude(0) * push);
  load_old = amplitude(0) * push;
  double three_point = 0, one_step = 0, size = 0;
  int apart = 0;
  for (int s = 1; s <= kSteps; ++s) {
    modes.set_torque(amplitude(s) * eigen.vectors.transpose() * push);
    modes.advance();
    {
      const VectorXd u0 = u + step * v + 0.25 * step * step * a, v0 = v + 0.5 * step * a;
      const VectorXd free = factor.solve(amplitude(s) * push - c * v0 - k * u0);
      const Vector2d e = gap - touching * (u0 + 0.25 * step * step * free);
      a = free - response * forces(contact, e);
      u = u0 + 0.25 * step * step * a;
      v = v0 + 0.5 * step * a;
    }
    VectorXd now;
    if (s == 1) {
      now = u;
      load_older = load_old;
      load_old = amplitude(s) * push - touching.transpose() * modes.p;
    } else {
      const VectorXd right = 0.25 * step * step * (amplitude(s) * push + 2 * load_old + load_older) +
                             (2 * m - 0.5 * step * step * k) * old -
                             (m - 0.5 * step * c + 0.25 * step * step * k) * older;
      const VectorXd free = factor.solve(right);
      const Vector2d p = forces(contact, gap - touching * free);
      now = free - 0.25 * step * step * response * p;
      load_older = load_old;
      load_old = amplitude(s) * push - touching.transpose() * p;
    }
    older = old;
    old = now;
    const VectorXd by_modes = eigen.vectors * modes.z;
    three_point = std::max(three_point, (now - by_modes).norm());
    one_step = std::max(one_step, (u - by_modes).norm());
    size = std::max(size, by_modes.norm());
    apart += modes.p.maxCoeff() == 0;
  }
  table.at_most("32 modes against full space, Newmark one-step, 1e4 steps with contact: rel. difference",
                1e-10, one_step / size);
  table.at_most("the same against the three-point form of Eq. 8", 1e-10, three_point / size);
  table.at_least("steps of these without contact (contact came and went)", 500, apart);
}

void wide_contact(Table& table) {
  const ReducedBody strain = reduce(coarse_mesh(), steel(false), 1);
  // 1 / R: pitch point, both flanks r_b tan 20 deg.
  const double radius = 0.5 * 75e-3 * std::sin(20 * kPi / 180),
               modulus = kYoung / (2 * (1 - kPoisson * kPoisson));
  const double line = 1e-6 * kPi * modulus / (4 * radius), torque = line * kFaceWidth * kBaseRadius;
  table.relative("torque for a half-width of 1 mm at the pitch point, one pair, plane strain, N m", 12467.7,
                 torque, 1e-5);
  const StaticResult one = static_transmission(strain, strain, static_parameters(8, false), torque);
  table.relative("half-width that strips find there, mm (curvature changes over the contact)", 1,
                 1e3 * one.contact_half_width(0, 1), 0.03);
  table.relative("largest pressure, GPa", 1e-9 * 2 * line / (kPi * 1e-3), 1e-9 * one.contact_pressure(0, 1),
                 0.03);
  table.rejected("50000 N m at 128 positions, some of whose contacts are wider than the flanks",
                 "at 50000 N m the transmission error",
                 [&] { static_transmission(strain, strain, static_parameters(128, true), 5e4); });
}

void torque_without_size(Table& table) {
  for (double torque : {0.0, -150.0})
    table.rejected(text("statics at ", torque, " N m"), text("torque_Nm = ", torque),
                   [&] { statics(torque, 8); });
  // One pair: half-planes add 2 / (pi E' b) ln(torque ratio) to the compliance, E' of plane stress, both bodies.
  const double tiny = statics(1e-6, 8, false).transmission_error[0] / (1e-6 / kBaseRadius),
               small = statics(1e-2, 8, false).transmission_error[0] / (1e-2 / kBaseRadius);
  table.relative("compliance at 1e-6 less that at 1e-2 N m, one pair, 1e-9 m/N: Hertz's logarithm",
                 1e9 * 2 / (kPi * kYoung * kFaceWidth) * std::log(1e4), 1e9 * (tiny - small), 1e-7);

  // Torque that vanishes: gears that just touch stay there. Torque that turns round: they part for good.
  Rolling before(150, 128);
  FixedPhaseMesh fixed_pair = before.dynamics.hold(0);
  fixed_pair.torque.setZero();
  FixedPhaseMotion still(fixed_pair, 3e-6);
  for (int i = 0; i < 1000; ++i) still.advance();
  table.at_most("no torque, gears that just touch, 1000 steps: |z| + |p|", 0,
                still.z.norm() + still.p.norm());

  Rolling forward(150, 128, 7.7e-6, 0), backward(-150, 128, 7.7e-6, 0);
  forward.dynamics.set_speed(2500, 128);
  backward.dynamics.set_speed(2500, 128);
  RollingDynamics::State state = forward.dynamics.rest();
  RollingDynamics::Period period;
  for (int i = 0; i < 2; ++i) backward.dynamics.integrate(state, period);
  const double speed = state.v[0];
  double attraction = 0;
  for (int i = 0; i < 3; ++i) {
    backward.dynamics.integrate(state, period);
    attraction = std::max(attraction, period.tooth_pair_load.cwiseAbs().maxCoeff());
  }
  table.at_most("torque turned round while rolling: tooth load after two mesh periods, N", 0, attraction);
  const double root_mass = 1 / std::sqrt(2 * kBaseRadius * kBaseRadius / 0.0148);
  table.relative("free flight: change of relative speed over three mesh periods, m/s",
                 -150 / kBaseRadius / (root_mass * root_mass) * 3 / 2500, (state.v[0] - speed) / root_mass,
                 1e-9);
}

// E 900, density 1, length 10, unit section; flies at 10 towards a wall 5 away.
struct BarImpact {
  double force = 0, force_deviation = 0;  // over the middle of the contact
  double duration = 0, energy = 0, gain = 0, speed = 0;
  double step = 0;
};
BarImpact bar_impact(int n, double courant) {
  const double element = 10.0 / n, stiffness = 900 / element;
  // The node at the wall has no mass: its element is a compliance, its mass goes to the next node.
  VectorXd mass = VectorXd::Constant(n, element);
  mass[0] *= 1.5;
  mass[n - 1] *= 0.5;
  MatrixXd k = MatrixXd::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    k(i, i) += stiffness;
    k(i + 1, i + 1) += stiffness;
    k(i, i + 1) = k(i + 1, i) = -stiffness;
  }
  const VectorXd root = mass.cwiseSqrt().cwiseInverse();
  const SymmetricEigen eigen = symmetric_eigen(root.asDiagonal() * k * root.asDiagonal());
  const MatrixXd shape = root.asDiagonal() * eigen.vectors;
  FixedPhaseMesh mesh;
  mesh.frequency_squared = eigen.values;
  mesh.frequency_squared[0] = 0;
  mesh.damping = mesh.torque = VectorXd::Zero(n);
  mesh.participation = shape.row(0);
  mesh.local = MatrixXd::Constant(1, 1, 1 / stiffness);
  mesh.residual = MatrixXd::Zero(1, 1);
  mesh.gap = VectorXd::Constant(1, 5);
  BarImpact result;
  result.step = courant * element / 30;
  FixedPhaseMotion bar(mesh, result.step);
  bar.v = shape.transpose() * mass.asDiagonal() * VectorXd::Constant(n, 10);
  const auto energy = [&] {
    return 0.5 * (bar.v.squaredNorm() + mesh.frequency_squared.dot(bar.z.cwiseAbs2()) +
                  bar.p[0] * bar.p[0] / stiffness);
  };
  const double before = energy();
  std::vector<double> middle;
  for (int i = 1; i * result.step < 1.5; ++i) {
    bar.advance();
    if (bar.p[0] > 0) result.duration += result.step;
    if (i * result.step > 0.55 && i * result.step < 1.12) middle.push_back(bar.p[0]);
    result.gain = std::max(result.gain, energy() / before - 1);
  }
  const auto force = Eigen::Map<VectorXd>(middle.data(), static_cast<Eigen::Index>(middle.size()));
  result.force = force.mean();
  result.force_deviation = rms(force);
  result.energy = energy() / before;
  result.speed = bar.v[0] * shape(0, 0);  // of the centre of mass
  return result;
}

void elastic_bar(Table& table) {
  for (double courant : {2.0, 0.5, 0.1}) {
    const BarImpact bar = bar_impact(100, courant);
    const std::string at = text(", Courant number ", courant);
    table.relative("elastic bar on a wall, 100 elements: mean contact force" + at, 300, bar.force, 2e-4);
    table.at_most("standard deviation of the force in contact over 300" + at, 2e-3,
                  bar.force_deviation / 300);
    table.absolute("contact lasts 2 L / c" + at, 2.0 / 3, bar.duration, 2 * bar.step + 0.006);
    table.absolute("energy after it over that before" + at, 1, bar.energy, 2e-3);
    table.at_most("largest gain of energy at any step, relative" + at, 2e-3, bar.gain);
  }
  // Short waves lag behind in a chain and stay in the bar as vibration.
  const double coarse = bar_impact(100, 0.5).speed, fine = bar_impact(400, 0.5).speed;
  table.relative("it leaves with the speed it came with (100 elements keep 1 % in vibration)", -10, coarse,
                 0.015);
  table.relative("the same with 400 elements", -10, fine, 0.006);
  table.at_least("order of that in the element", 0.5, std::log2((10 + coarse) / (10 + fine)) / 2);
}

// x'' = 1 - x+ from x = 3 at rest.
void undamped_bounce(Table& table) {
  constexpr int kPerPeriod = 200, kSteps = 1000000;
  const double step = 2 * kPi / kPerPeriod;
  FixedPhaseMotion motion(one_mass(1, 1), step);
  motion.z[0] = 3;
  motion.touch();
  double first = 0, last = 0, drift = 0, before = 0;
  int crossings = 0;
  for (int i = 1; i <= kSteps; ++i) {
    before = motion.v[0];
    motion.advance();
    const double x = motion.z[0], v = motion.v[0], contact = std::max(x, 0.0);
    drift = std::max(drift, std::abs((0.5 * v * v - x + 0.5 * contact * contact) / 1.5 - 1));
    if (before > 0 && v <= 0 && x > 1) {  // at the far end of the contact
      last = (i - v / (v - before)) * step;
      if (++crossings == 1) first = last;
    }
  }
  // A = 2 x0: pi / (acos(-1/2) + sqrt 3).
  const double exact = kPi / (std::acos(-0.5) + std::sqrt(3.0));
  table.relative("undamped bounce, 1e6 steps of 1/200 linear period: frequency over the linear one", exact,
                 2 * kPi * (crossings - 1) / (last - first), 1.2e-4);
  table.at_most("largest error of the energy in these, relative", 5e-4, drift);
}

void step_lengths(Table& table) {
  const double period = 1 / 2500.0;
  Rolling more(150 * 1.01, 1), at(150, 1);
  const RollingDynamics::State start = more.dynamics.rest();
  at.dynamics.rest();
  const auto released = [&](double step, int steps) {
    FixedPhaseMotion motion(at.dynamics.hold(0), step);
    motion.start(start.z, start.p);
    for (int i = 0; i < steps; ++i) motion.advance();
    return motion;
  };
  const FixedPhaseMotion tiny = released(1e-6 * period, 2000), finer = released(0.25e-6 * period, 8000),
                         usual = released(period / 128, 0);
  table.at_most("steps of T / 1e6, 1 % of the torque let go: forces against steps of T / 4e6, relative",
                1e-11, (tiny.p - finer.p).norm() / finer.p.norm());
  const SymmetricEigen shortest = symmetric_eigenvalues(tiny.compliance()),
                       local = symmetric_eigenvalues(tiny.mesh().local);
  table.relative("their compliance: least eigenvalue, m/N, against that of what is instantaneous",
                 local.values[0], shortest.values[0], 1e-3);
  table.at_least("and at steps of T / 128 it is no smaller, over the same", 1,
                 symmetric_eigenvalues(usual.compliance()).values[0] / local.values[0]);

  const double static_error = 1e6 * at.dynamics.static_deflection();
  const RollingDynamics::State rest = at.dynamics.rest();
  FixedPhaseMotion huge(at.dynamics.hold(0), 10 * period);
  const auto deviation = [&] { return std::abs(1e6 * huge.transmission_error() / static_error - 1); };
  const auto largest_of = [&](int steps) {
    double largest = 0;
    for (int i = 0; i < steps; ++i) {
      huge.advance();
      largest = std::max(largest, deviation());
    }
    return largest;
  };
  huge.start(start.z, start.p);
  const double let_go = deviation();
  table.at_most("5000 steps of 10 T, held, 1 % of the torque let go: largest deviation of DTE over the first",
                1 + 1e-9, largest_of(5000) / let_go);
  table.at_most("and at the end DTE against static transmission error, relative", 1e-8, deviation());
  table.at_most("and relaxed against present loads, relative", 1e-9,
                (huge.relaxed - huge.p).norm() / huge.p.norm());
  // A force that relaxes in eta counts for half of the first step.
  huge.z[0] *= 1.05;
  huge.touch();
  table.at_most(
      "the same from a jump of 5 % that the relaxed load does not know of: largest deviation of DTE", 1,
      largest_of(5000));
  table.at_most("and at the end", 1e-8, deviation());

  // Rolling, one step of 10 T per mesh period, always at phase 0: one pair takes the load over from another within a
  // step, and the relaxed load of both is eta / step behind.
  at.dynamics.set_speed(250, 1);
  RollingDynamics::State state = rest;
  state.z[0] *= 1.05;
  RollingDynamics::Period integrated;
  double largest = 0;
  for (int i = 0; i < 5000; ++i) {
    if (!at.dynamics.integrate(state, integrated)) fail(Failure::numerical, "contact left the range");
    largest = std::max(largest, std::abs(1e6 * integrated.transmission_error[0] / static_error - 1));
  }
  table.at_most("rolling, one such step per mesh period, from 5 % off: largest deviation of DTE", 0.003,
                largest);
  table.relative("at the end relaxed less present loads, relative: sqrt 2 eta / step",
                 std::sqrt(2.0) * 7.7e-6 * 250,
                 (state.relaxed[0] - state.load[0]).norm() / state.load[0].norm(), 1e-6);

  SweepParameters slow = sweep_parameters(5, 5, 1, 7.7e-6);
  slow.time.min_sample_rate = 1;
  const StaticResult fixed = statics(150);
  const SweepResult crawl = run_sweep(slow, 150);
  table.at_most("rolling at 5 Hz in 128 steps of 4 T: DTE less static, over its mean", 3.5e-3,
                (crawl.transmission_error[0].col(0) - fixed.transmission_error).cwiseAbs().maxCoeff() /
                    fixed.transmission_error.mean());
}

void stiff_mode(Table& table) {
  const double w = 2 * kPi * 1e6, eta = 0.07 / (kPi * 2900), step = 2e-6, c = eta * w * w;
  const auto roots = [](const Propagator& p) {
    const double half = 0.5 * (p.a11 + p.a22), det = p.a11 * p.a22 - p.a12 * p.a21,
                 root = std::sqrt(half * half - det);
    return Vector2d(half + root, half - root);
  };
  // s^2 + c s + w^2 without cancellation.
  const double fast = 0.5 * c + std::sqrt(0.25 * c * c - w * w), slow = w * w / fast;
  const Propagator exact = exact_propagator(w, c, step);
  table.relative("1 MHz mode, 7 % at 2900 Hz by stiffness, 2 us: slow root, exact", std::exp(-slow * step),
                 roots(exact)[0], 1e-12);
  table.absolute("its fast root", std::exp(-fast * step), roots(exact)[1], 1e-12);
  table.relative("massless limit: what the relaxed load leaves after the step", std::exp(-step / eta),
                 relaxation_step(eta, step).decay, 1e-14);
  table.absolute("Newmark, the reference option: slow root", 0.769586,
                 roots(newmark_propagator(w, c, step))[0], 1e-6);
  table.absolute("Newmark, its ringing root (known defect of the method)", -0.99343,
                 roots(newmark_propagator(w, c, step))[1], 1e-5);
  Vector2d y(1, 0);
  for (int i = 0; i < 10; ++i)
    y = Vector2d(exact.a11 * y[0] + exact.a12 * y[1], exact.a21 * y[0] + exact.a22 * y[1]);
  const double t = 10 * step;
  table.relative("released from 1: displacement after 10 steps, exact",
                 (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow), y[0], 1e-10);
}

// Spring and dashpot in parallel are a flexibility that relaxes; release where the force is zero.
FixedPhaseMesh spring_dashpot(double torque, double frequency, double ratio) {
  return one_mass(torque, 0, 1 / (frequency * frequency), 2 * ratio / frequency);
}
double restitution(double ratio) {
  return std::exp(-ratio / std::sqrt(1 - ratio * ratio) * (kPi - 2 * std::asin(ratio)));
}

void restitution_of_dashpot(Table& table) {
  const double ratio = 0.07;
  double errors[2], duration = 0;
  const double step[2] = {2 * kPi / 1000, 2 * kPi / 2000};
  double found = 0;
  for (int k = 0; k < 2; ++k) {
    FixedPhaseMotion motion(spring_dashpot(0, 1, ratio), step[k]);
    motion.v[0] = 1;
    int steps = 0;
    do {
      motion.advance();
      ++steps;
    } while (motion.p[0] > 0 || steps < 10);
    duration = steps * step[k];
    found = -motion.v[0];
    errors[k] = std::abs(found - restitution(ratio));
  }
  table.relative("impact on spring and dashpot, 7 %: restitution in 1000 steps a contact", 0.81008174, found,
                 1e-4);
  table.absolute("duration of contact times w", (kPi - 2 * std::asin(ratio)) / std::sqrt(1 - ratio * ratio),
                 duration, 1.5 * step[1]);
  table.at_least("order of the error in the step (force jumps at first touch)", 0.9,
                 std::log2(errors[0] / errors[1]));
}

void bouncing_ball(Table& table) {
  const double gravity = 9.81, height = 1, frequency = kPi / 1e-4, step = 1e-6;
  for (double e : {0.5, 0.8, 0.9}) {
    double low = 0, high = 0.9;
    for (int i = 0; i < 60; ++i) (restitution(0.5 * (low + high)) > e ? low : high) = 0.5 * (low + high);
    FixedPhaseMotion ball(spring_dashpot(gravity, frequency, low), step);
    ball.z[0] = -height;
    const double zeno = std::sqrt(2 * height / gravity) * (1 + e) / (1 - e);
    int flying = 0;
    for (int i = 1; i * step < 1.1 * zeno; ++i) {
      ball.advance();
      flying += ball.p[0] == 0;
    }
    table.relative(
        text("bouncing ball, restitution ", e, ", 100 steps a contact: time in flight before it rests, s"),
        zeno, flying * step, 1e-3);
    table.relative("it then rests under its weight: force / m g", 1, ball.p[0] / gravity, 1e-6);
  }
}

void preload(Table& table) {
  const double ratio = 0.08;
  constexpr int kPerPeriod = 1024, kPeriods = 60;
  const auto loses = [&](double share) {
    FixedPhaseMesh mesh = one_mass(1, 1);
    mesh.damping[0] = 2 * ratio;
    FixedPhaseMotion motion(mesh, 2 * kPi / kPerPeriod);
    motion.z[0] = 1;
    motion.touch();
    double least = 1;
    for (int i = 1; i <= kPeriods * kPerPeriod; ++i) {
      motion.set_torque(VectorXd::Constant(1, 1 + share * std::sin(2 * kPi * i / kPerPeriod)));
      motion.advance();
      if (i > (kPeriods - 1) * kPerPeriod) least = std::min(least, motion.p[0]);
    }
    return least == 0;
  };
  double low = 0.1, high = 0.2;
  for (int i = 0; i < 22; ++i) (loses(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
  table.relative("preloaded mass at resonance, 8 %: F1 / F0 where contact is first lost", 0.16, low, 1e-4);
}

void meissner(Table& table) {
  const double mass = 1.4, k1 = 335596523.71, k2 = 504267825.43, natural = std::sqrt(462.1e6 / mass);
  const auto growth = [&](double mesh_frequency, double ratio) {
    const auto matrix = [&](double k, double t) {
      const Propagator p = exact_propagator(std::sqrt(k / mass), 2 * ratio * natural, t);
      Matrix2d a;
      a << p.a11, p.a12, p.a21, p.a22;
      return a;
    };
    const Matrix2d monodromy = matrix(k2, 0.75 / mesh_frequency) * matrix(k1, 0.25 / mesh_frequency);
    const double half = 0.5 * monodromy.trace(), det = monodromy.determinant();
    return half * half > det ? std::abs(half) + std::sqrt(half * half - det) : std::sqrt(det);
  };
  // Below and above of a band lies det = 1, |multiplier| = 1.
  const auto& edge = kTongue;
  for (int band = 0; band < 5; ++band) {
    const double middle = 0.5 * (edge[band][0] + edge[band][1]), width = edge[band][1] - edge[band][0];
    double ends[2];
    for (int side = 0; side < 2; ++side) {
      double inside = middle, outside = edge[band][side] + (side ? 0.3 : -0.3) * width;
      for (int i = 0; i < 60; ++i) {
        const double f = 0.5 * (inside + outside);
        (growth(f, 0) > 1 + 1e-9 ? inside : outside) = f;
      }
      ends[side] = inside;
    }
    table.absolute(text("Meissner, rectangular stiffness: band ", band + 1, " of instability begins, Hz"),
                   edge[band][0], ends[0], 1e-4);
    table.absolute("and ends, Hz", edge[band][1], ends[1], 1e-4);
    double unstable = 0, stable = 0.1;
    for (int i = 0; i < 30; ++i) {
      const double ratio = 0.5 * (unstable + stable);
      double largest = 0;
      for (int j = 0; j <= 2000; ++j)
        largest = std::max(largest, growth(edge[band][0] + width * j / 2000, ratio));
      (largest > 1 ? unstable : stable) = ratio;
    }
    table.absolute("damping ratio that closes it", kTongueCloses[band], stable, 6e-6);
  }
}

// Eq. 23 with rectangular stiffness: oscillating RMS of x, m, over the last of `periods`, and steps without contact.
std::pair<double, int> one_degree(double torque, double mesh_frequency, double ratio, double start) {
  constexpr int kPerPeriod = 1024, kPeriods = 250;
  const double mass = 1.4, k1 = 335596523.71, k2 = 504267825.43, force = torque / kBaseRadius;
  FixedPhaseMesh mesh = one_mass(force / std::sqrt(mass), 1 / k2);
  mesh.participation /= std::sqrt(mass);
  mesh.damping[0] = 2 * ratio * std::sqrt(462.1e6 / mass);
  FixedPhaseMotion motion(mesh, 1 / (mesh_frequency * kPerPeriod));
  motion.z[0] = start * force / 462.1e6 * std::sqrt(mass);
  motion.touch();
  VectorXd last(kPerPeriod);
  int apart = 0;
  for (int period = 0; period < kPeriods; ++period)
    for (int i = 0; i < kPerPeriod; ++i) {
      if (i == 0 || i == kPerPeriod / 4 * 3) {
        motion.set_local(MatrixXd::Constant(1, 1, 1 / (i == 0 ? k2 : k1)));
        motion.touch();
      }
      motion.advance();
      if (period == kPeriods - 1) {
        last[i] = motion.z[0] / std::sqrt(mass);
        apart += motion.p[0] == 0;
      }
    }
  return {rms(last), apart};
}

void scale_invariance(Table& table) {
  const auto at = one_degree(150, 2550, 0.07, 3), more = one_degree(1050, 2550, 0.07, 3);
  table.absolute("one mass, Eq. 23, 2550 Hz, contact lost: RMS at 7 times the torque over 7 RMS", 1,
                 more.first / (7 * at.first), 1e-10);
  table.at_least("steps of 1024 without contact in these", 50, at.second);
  table.relative("RMS of Eq. 23 at 2400 Hz, 8 %, um, against event-exact pieces", 1.85201323,
                 1e6 * one_degree(150, 2400, 0.08, 1).first, 1e-4);
  table.relative("the same at 1350 Hz", 2.64137209, 1e6 * one_degree(150, 1350, 0.08, 1).first, 1e-4);

  // Gears: STE / force at twice the torque. One pair loses all of Hertz's logarithm, two that share half of it.
  const double hertz = 2 / (kPi * kYoung * kFaceWidth) * std::log(2.0);
  const auto lost = [&](bool corner) -> VectorXd {
    return (statics(150, 128, corner).transmission_error / 150 -
            statics(300, 128, corner).transmission_error / 300) *
           kBaseRadius / hertz;
  };
  const VectorXd smooth = lost(false), corner = lost(true);
  table.absolute("gears at 300 less at 150 N m, one pair: loss of compliance over Hertz's logarithm", 1,
                 smooth[0], 0.003);
  table.absolute("two pairs, no corner contact: the same", 0.5, smooth[64], 0.005);
  table.at_least("no corner contact: least of it over the period", 0.5, smooth.minCoeff());
  table.at_most("no corner contact: largest", 1, smooth.maxCoeff());
  table.at_least("with corner contact, which begins earlier at more torque: largest", 3, corner.maxCoeff());
}

void uneven_records(Table& table) {
  const auto sine = [](double periods, double phase) {
    const int n = 40000;
    VectorXd x(n);
    for (int i = 0; i < n; ++i) x[i] = std::sin(2 * kPi * periods * i / n + phase);
    return x;
  };
  const double expected[] = {0.066, 0.015, 0.0039, 0.00079};
  const int whole[] = {1, 5, 20, 100};
  for (int k = 0; k < 4; ++k) {
    double worst = 0;
    for (int i = 0; i < 32; ++i)
      worst = std::max(worst,
                       std::abs(harmonics(sine(whole[k] + 0.25, kPi * i / 32), 0).rms * std::sqrt(2.0) - 1));
    table.relative(text("RMS of a sine over ", whole[k], ".25 periods, error at the worst phase"),
                   expected[k], worst, 0.03);
    table.absolute("over whole periods", 0, harmonics(sine(whole[k], 0.3), 0).rms * std::sqrt(2.0) - 1,
                   1e-13);
  }
  table.relative("amplitude of a line half-way between two bins: 2 / pi", 2 / kPi,
                 harmonics(sine(1000.5, 0.3), 1000).amplitude[999], 1e-3);
  table.absolute("amplitude of a line on a bin", 1, harmonics(sine(1000, 0.3), 1000).amplitude[999], 1e-12);
}

void perturbation(Table& table) {
  Rolling pair(150, 128);
  RollingDynamics& dynamics = pair.dynamics;
  RollingDynamics::State state = dynamics.rest();
  dynamics.set_speed(3200, 128);
  RollingDynamics::Period period;
  for (int i = 0; i < 150; ++i) dynamics.integrate(state, period);
  RollingDynamics::State steady = state;
  dynamics.integrate(steady, period);
  table.at_most("gears at 3200 Hz after 150 mesh periods: change over one period", 1e-12,
                dynamics.distance(state, steady));

  const double multiplier = largest_multiplier(pair, steady, 1e-7);
  RollingDynamics::State a = steady, b = steady;
  b.z[0] *= 1 + 1e-10;
  const double begins = dynamics.distance(a, b);
  constexpr int kSkip = 2, kPeriods = 12;
  double at_skip = 0;
  for (int i = 1; i <= kPeriods; ++i) {
    dynamics.integrate(a, period);
    dynamics.integrate(b, period);
    if (i == kSkip) at_skip = dynamics.distance(a, b);
  }
  const double end = dynamics.distance(a, b);
  table.at_most("largest multiplier of the mesh period there, by differences of 1e-7", 0.999, multiplier);
  table.relative(
      "two runs that differ by 1e-10: decay per period", multiplier,
      std::pow(end / at_skip, 1.0 / (kPeriods - kSkip)),
      0.02);  // what starts at 1e-12 ends at round-off: up to 0.023, by how the program is compiled
  table.at_most("their difference after 12 periods, over that at the start",
                3 * std::pow(multiplier, kPeriods), end / begins);
}

void near_fold(Table& table) {
  const SweepResult up = run_sweep(sweep_parameters(2760, 2810, 10, 5.5e-6), 150);
  table.absolute("gears at 150 N m, 5.5e-6 s, up: jumps found between 2760 and 2810 Hz", 1,
                 static_cast<double>(up.jump_frequency.size()), 0);
  if (up.jump_frequency.size() != 1) return;
  const double jump = up.jump_frequency[0];
  SweepParameters other = sweep_parameters(2760, 2810, 10, 5.5e-6);
  other.fidelity.integrator = Integrator::newmark;
  other.time.steps_per_period = 512;
  const SweepResult newmark = run_sweep(other, 150);
  // 128 exact steps leave 0.1 Hz, Newmark with 512 as much, and the search 0.16 Hz.
  table.absolute("the jump, Hz, against Newmark with 512 steps a period",
                 newmark.jump_frequency.size() == 1 ? newmark.jump_frequency[0] : 0, jump, 0.5);
  table.at_most("its width, Hz", 1, up.jump_width[0]);
  // Steps that go just past it.
  const double fine = std::floor(jump) - 2;
  const SweepResult past = run_sweep(sweep_parameters(fine, fine + 6, 1, 5.5e-6), 150);
  SweepParameters plain = sweep_parameters(fine, fine + 6, 1, 5.5e-6);
  plain.time.steady_state = SteadyState::integrate;
  const SweepResult integrated = run_sweep(plain, 150);
  double largest = 0;
  for (int i = 0; i < past.period_multiple.size(); ++i)
    largest = std::max(
        largest,
        std::abs(rms(past.transmission_error[i].col(0)) / rms(integrated.transmission_error[i].col(0)) - 1));
  table.at_most("steps of 1 Hz across it: RMS of extrapolated orbits against integrated ones, relative", 2e-4,
                largest);
  table.at_least("of these 7 speeds steady", 7, (past.period_multiple.array() > 0).count());
  table.at_least("RMS past it over RMS before it (what counts as a jump)", 1.2,
                 rms(past.transmission_error[6].col(0)) / rms(past.transmission_error[0].col(0)));
  table.at_most("energy balance across it, relative", 1e-9, past.energy_imbalance.maxCoeff());
}

void stiff_damping(Table& table) {
  const auto dropped = [](double eta, double frequency) {  // energy, of the orbit's work of the rolling
    const SweepResult result = run_sweep(sweep_parameters(frequency, frequency, 1, eta), 150);
    return result.energy(0, energy_line("dropped")) / result.energy(0, energy_line("rolling"));
  };
  for (double eta : {3e-5, 1e-4}) {
    SweepParameters settings = sweep_parameters(2500, 2500, 1, eta), finer = settings;
    finer.time.steps_per_period = 512;
    const SweepResult usual = run_sweep(settings, 150), fine = run_sweep(finer, 150);
    const std::string at = text("Rayleigh stiffness factor ", eta, " s, 2500 Hz: ");
    table.at_least(at + "period multiple (0: not steady)", 1, usual.period_multiple[0]);
    table.relative(at + "RMS, um, against 512 steps a period", 1e6 * rms(fine.transmission_error[0].col(0)),
                   1e6 * rms(usual.transmission_error[0].col(0)), 0.0015);
    table.at_most(at + "energy balance, relative", 1e-9, usual.energy_imbalance[0]);
  }
  table.rejected("Rayleigh stiffness factor 0.001 s, 2500 Hz: beyond a quarter of the mesh period",
                 "is 2.5 of a mesh period at 2500 Hz",
                 [&] { run_sweep(sweep_parameters(2500, 2500, 1, 1e-3), 150); });
  table.at_least("1e-4 s, 2500 Hz: energy in the relaxed loads of dropped teeth, over the work of rolling",
                 1e-8, std::abs(dropped(1e-4, 2500)));
  table.at_most("that at 1250 over 2500 Hz, falls with exp(-2 T / eta)", std::exp(-8.0),
                std::abs(dropped(1e-4, 1250) / dropped(1e-4, 2500)));
}

void ten_times_the_torque(Table& table) {
  const SweepResult result = run_sweep(sweep_parameters(2600, 3000, 200, 7.7e-6), 1500);
  table.at_least("1500 N m, 2600 to 3000 Hz: least period multiple (0: not steady)", 1,
                 result.period_multiple.minCoeff());
  table.at_most("energy balance, relative", 1e-9, result.energy_imbalance.maxCoeff());
  SweepParameters other = sweep_parameters(2600, 3000, 200, 7.7e-6);
  other.fidelity.integrator = Integrator::newmark;
  other.time.steps_per_period = 512;
  const SweepResult newmark = run_sweep(other, 1500);
  for (int i = 0; i < 3; ++i)
    table.relative(
        text("RMS at ", result.mesh_frequency[i], " Hz, um, against Newmark with 512 steps a period"),
        1e6 * rms(newmark.transmission_error[i].col(0)), 1e6 * rms(result.transmission_error[i].col(0)),
        0.002);
  table.at_most("strips that overlap, m", 1e-14, -result.least_gap);
  SweepParameters slow = sweep_parameters(5, 5, 1, 7.7e-6);
  slow.time.min_sample_rate = 1;
  const StaticResult fixed = statics(1500);
  // The slope of the static error steps where a pair comes in, which rings at f_n: 0.0033 at either torque.
  table.at_most(
      "rolling at 5 Hz: DTE less static, over its mean", 3.5e-3,
      (run_sweep(slow, 1500).transmission_error[0].col(0) - fixed.transmission_error).cwiseAbs().maxCoeff() /
          fixed.transmission_error.mean());
}

void many_modes(Table& table) {
  const ReducedBody body = reduce(coarse_mesh(), steel(true), 61);
  table.at_least("body with 61 modes: modes", 61, static_cast<double>(body.eigenfrequency.size()));
  SweepParameters settings = sweep_parameters(2800, 2900, 100, 5.5e-6);
  const SweepResult many = run_sweep(settings, 150, Direction::down, body),
                    few = run_sweep(settings, 150, Direction::down);
  table.at_most("61 modes a gear, contact lost at 2900 Hz: energy balance, relative", 1e-9,
                many.energy_imbalance.maxCoeff());
  table.at_most("least mesh force, N", 0,
                std::min(many.mesh_force[0].minCoeff(), many.mesh_force[1].minCoeff()));
  table.relative("RMS at 2900 Hz, um, against 5 modes a gear", 1e6 * rms(few.transmission_error[0].col(0)),
                 1e6 * rms(many.transmission_error[0].col(0)), 0.005);
}

}  // namespace

std::vector<HardCase> whine::known_answers() {
  return {{"H7", rigid_rotation},       {"H13", all_modes},         {"H18", wide_contact},
          {"H19", torque_without_size}, {"H20", elastic_bar},       {"H21", undamped_bounce},
          {"H22", step_lengths},        {"H23", stiff_mode},        {"H24", restitution_of_dashpot},
          {"H25", bouncing_ball},       {"H26", preload},           {"H27", meissner},
          {"H30", scale_invariance},    {"H31", uneven_records},    {"H32", perturbation},
          {"fold", near_fold},          {"damping", stiff_damping}, {"torque", ten_times_the_torque},
          {"modes", many_modes}};
}
