// The ladder of [fidelity]: each model level against the next one, and what says how far they are apart.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "base/error.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "solid/sector.h"
#include "studies/next_level.h"

using namespace whine;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi;

// 20 teeth on a thin rim, four-node elements as coarse as they get; reduced once per number of modes.
const ReducedBody& coarse_body(int modes) {
  BodyDiscretisation discretisation;
  discretisation.element_size = 3e-3;
  discretisation.element_order = 1;
  discretisation.modes = modes;
  return kept_body(paper_gear(20, 20e-3), paper_steel(), discretisation);
}

StaticParameters coarse_statics(ContactModel contact) {
  StaticParameters settings = paper_statics(128);
  settings.mesh.centre_distance = 60e-3;
  settings.contact.strips = 8;
  settings.fidelity.contact = contact;
  return settings;
}

SweepParameters coarse_sweep(double from, double to, double step, BodyModel body, ContactModel contact) {
  SweepParameters settings = paper_sweep(from, to, step);
  settings.inertia[0] = settings.inertia[1] = 1e-3;
  settings.damping.rayleigh_stiffness = 4e-6;
  settings.time.min_sample_rate = 1;
  settings.fidelity.body = body;
  settings.fidelity.contact = contact;
  return settings;
}

}  // namespace

TEST_CASE("every mode: their sum is the flexibility of the mesh, solved for on the whole gear, to 1e-9" *
          doctest::skip()) {
  const ReducedBody& body = coarse_body(kAllModes);
  const SectorGrid mesh = make_sector_mesh(body.design, body.discretisation);
  const WholeGear whole = replicate(mesh);
  const PlaneSystem full =
      assemble(whole.node_position, whole.element_node, body.material, body.design.face_width);
  const int teeth = body.design.teeth;
  std::vector<int> unknown(static_cast<size_t>(2 * whole.node_position.rows()), 0);
  for (int j = 0; j < teeth; ++j)
    for (int i : mesh.bore_node) unknown[2 * whole.node(j, i)] = unknown[2 * whole.node(j, i) + 1] = -1;
  int size = 0;
  for (int& u : unknown)
    if (u == 0) u = size++;
  CHECK(body.eigenfrequency.size() == size);
  std::vector<Eigen::Triplet<std::complex<double>>> entries;
  for (int c = 0; c < full.stiffness.outerSize(); ++c)
    for (SparseReal::InnerIterator it(full.stiffness, c); it; ++it)
      if (unknown[it.row()] >= 0 && unknown[c] >= 0)
        entries.emplace_back(unknown[it.row()], unknown[c], it.value());
  SparseComplex stiffness(size, size);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  HermitianFactor factor(stiffness);
  factor.factorise(stiffness, "whole gear");

  // Unit normal forces at the table points of tooth 0 as the elements take them, read on all teeth.
  const MatrixXd outward = MatrixXd(FlankReader(mesh).outward(body.flank_position));
  const auto on_tooth = [&](int tooth) {  // (unknown, point)
    const MatrixXd turn = Eigen::Rotation2Dd(2 * kPi * tooth / teeth).toRotationMatrix();
    Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(size, outward.rows());
    for (int i = 0; i < mesh.node_position.rows(); ++i)
      if (const int u = unknown[2 * whole.node(tooth, i)]; u >= 0)
        result.middleRows(u, 2) +=
            (turn * outward.middleCols(2 * i, 2).transpose()).cast<std::complex<double>>();
    return result;
  };
  const Eigen::MatrixXcd solution = factor.solve(on_tooth(0));
  const ElasticGear gear(body);
  const double norm = (on_tooth(0).transpose() * solution).real().norm();
  for (int tooth : {0, 1, 2, 7, 10, 19}) {
    MatrixXd sum = MatrixXd::Zero(outward.rows(), outward.rows());
    for (int c = 0; c < body.eigenfrequency.size(); ++c) {
      const double w = 2 * kPi * body.eigenfrequency[c];
      sum += gear.mode_on_tooth(c, tooth) * gear.mode_on_tooth(c, 0).transpose() / (w * w);
    }
    CHECK((sum - (on_tooth(tooth).transpose() * solution).real()).norm() < 1e-9 * norm);
  }
  // The lowest are those that the sparse eigensolver finds, in the same order.
  const ReducedBody& few = coarse_body(21);
  for (int c = 0; c < few.eigenfrequency.size(); ++c)
    CHECK(body.eigenfrequency[c] == relative(few.eigenfrequency[c], 1e-9));
  CHECK((body.flank_mode.leftCols(21).cwiseAbs() - few.flank_mode.leftCols(21).cwiseAbs()).norm() <
        1e-6 * few.flank_mode.leftCols(21).norm());
  for (size_t d = 0; d < body.compliance.size(); ++d) CHECK(body.compliance[d] == few.compliance[d]);
}

TEST_CASE("every mode: a mesh that is too fine is rejected with its numbers and with one that is not") {
  BodyDiscretisation fine;
  fine.element_size = 0.4e-3;
  const SectorGrid mesh = make_sector_mesh(coarse_body(21).design, fine);
  const std::string message = message_of_input([&] { reduce(mesh, coarse_body(21).material, kAllModes); });
  INFO(message);
  CHECK(names(message, {1500, "unknowns"}));
  CHECK(names(message, {"element_order", 1, "element_mm"}));
  // Other model levels know no such limit, and "full" does not go without.
  const ReducedBody& few = coarse_body(21);
  const StaticResult statics = static_transmission(few, few, coarse_statics(ContactModel::line), 50);
  const std::string lacking = message_of_input([&] {
    sweep(few, few, statics, statics.mean_stiffness,
          coarse_sweep(3000, 3000, 1, BodyModel::full, ContactModel::line), Direction::up, no_report);
  });
  CHECK(contains(lacking, "holds " + std::to_string(few.eigenfrequency.size()) + " modes"));
  // Steps of stage parameters that somebody edited: no number that is doubled until it is large enough.
  for (int steps : {0, -128}) {
    SweepParameters none = coarse_sweep(3000, 3000, 1, BodyModel::modal, ContactModel::line);
    none.time.steps_per_period = steps;
    CHECK(contains(message_of_input([&] {
                     sweep(few, few, statics, statics.mean_stiffness, none, Direction::up, no_report);
                   }),
                   "steps_per_period = " + std::to_string(steps)));
  }
}

TEST_CASE("every mode: at rest the static transmission error, on lines and strips") {
  const ReducedBody& body = coarse_body(kAllModes);
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    const StaticResult statics = static_transmission(body, body, coarse_statics(contact), 50, 2);
    const GearMeshModel model(body, body, statics.mesh);
    const double load = 50 / model.kinematics.gear(0).base_radius();
    DynamicParameters parameters = paper_parameters(statics.mean_stiffness, BodyModel::full, contact);
    parameters.torque = 50;
    parameters.inertia = {1e-3, 1e-3};
    RollingDynamics dynamics(model, parameters);
    dynamics.set_zone(candidate_zone(model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(),
                                     8, load / model.kinematics.contact_ratio(), 4 * 1.1 * load,
                                     3 * statics.transmission_error.maxCoeff()),
                      1);
    dynamics.rest();
    // Of what the torques bend within a candidate zone modes keep mean and slope: 1.4e-6 is left out.
    CHECK(dynamics.static_deflection() ==
          relative(statics.transmission_error[0], contact == ContactModel::line ? 1e-8 : 5e-6));
  }
}

TEST_CASE("every mode against 61 modes and relaxed loads on the same mesh, both integrators" *
          doctest::skip()) {
  const ReducedBody &all = coarse_body(kAllModes), &some = coarse_body(61);
  const StaticResult statics = static_transmission(all, all, coarse_statics(ContactModel::line), 50);
  for (const double frequency : {2500.0, 4000.0, 6000.0})
    for (const auto integrator : {Integrator::exact, Integrator::newmark}) {
      SweepParameters settings = coarse_sweep(frequency, frequency, 1, BodyModel::full, ContactModel::line);
      settings.fidelity.integrator = integrator;
      const SweepResult full =
          sweep(all, all, statics, statics.mean_stiffness, settings, Direction::up, no_report);
      settings.fidelity.body = BodyModel::modal;
      const SweepResult modal =
          sweep(some, some, statics, statics.mean_stiffness, settings, Direction::up, no_report);
      INFO(frequency << " Hz, " << integrator);
      CHECK(rms(full, 0) == relative(rms(modal, 0), 0.03));  // 2.1, 0.2, 0.3 %
      CHECK(rms(full, 0) != rms(modal, 0));
      const auto peak = [](const SweepResult& of) { return of.tooth_load[0].maxCoeff(); };
      if (frequency < 5000) {
        CHECK(peak(full) == relative(peak(modal), 0.03));
      } else {
        // The largest load is that of a pair that comes in, and the higher the less of the compliance is undamped: 1583 N
        // at a depth of 0.5 mm, 1882 N at 0.1 mm, 2056 N with every mode; with 512 steps 1598, 1859, 2075 N.
        settings.damping.undamped_depth = 0.1e-3;
        const SweepResult shallow =
            sweep(some, some, statics, statics.mean_stiffness, settings, Direction::up, no_report);
        CHECK(peak(shallow) > 1.1 * peak(modal));
        CHECK(peak(full) > 1.05 * peak(shallow));
        CHECK(peak(full) < 1.2 * peak(shallow));
      }
      CHECK(full.natural_frequency == relative(modal.natural_frequency, 1e-5));
      CHECK(full.energy_imbalance[0] < 1e-9);
    }
}

TEST_CASE(
    "relaxed loads: a Rayleigh time above a quarter of a mesh period is rejected before anything is computed") {
  Damping damping;
  damping.rayleigh_stiffness = 1e-3;
  const std::string message =
      message_of_input([&] { require_relaxation_range(damping, BodyModel::modal, 4000); });
  for (const char* words : {"rayleigh_stiffness_s = 0.001", "4 of a mesh period at 4000 Hz", "at most 0.25",
                            "lower it to 6.25e-05", "mesh_frequency_Hz to 250 Hz"}) {
    CAPTURE(words);
    CHECK(contains(message, words));
  }
  CHECK_THROWS_AS(require_relaxation_range(damping, BodyModel::relaxed, 251), Error);
  // Nothing rolls, nothing relaxes, or every mode has its own damping.
  CHECK_NOTHROW(require_relaxation_range(damping, BodyModel::modal, 0));
  for (const BodyModel body : {BodyModel::rigid, BodyModel::quasi_static, BodyModel::full})
    CHECK_NOTHROW(require_relaxation_range(damping, body, 4000));
  SweepParameters settings = coarse_sweep(2000, 4000, 100, BodyModel::modal, ContactModel::line);
  CHECK_NOTHROW(dynamic_parameters(StaticResult(), 4e8, settings, settings.frequency_to));
  settings.damping = damping;
  CHECK_THROWS_AS(dynamic_parameters(StaticResult(), 4e8, settings, settings.frequency_to), Error);
}

TEST_CASE("model levels of the body: each is nearer to the one with the most modes than the level below it") {
  const ReducedBody& body = paper_body(40e-3, 0.8e-3, 61);
  StaticParameters statics_parameters = paper_statics(128);
  statics_parameters.fidelity.contact = ContactModel::line;
  const StaticResult statics = static_transmission(body, body, statics_parameters, 150);
  // At 3500 Hz the rigid gears, which next to nothing damps, wander through hundreds of periods before they settle: the last
  // digits of a start decide on which motion, and one start in twenty comes upon loads beyond Hertz's law on the way.
  for (const double frequency : {1350.0, 3300.0}) {
    SweepParameters settings = paper_sweep(frequency, frequency, 1);
    settings.fidelity.contact = ContactModel::line;
    const auto with = [&](BodyModel level) {
      settings.fidelity.body = level;
      return rms(sweep(body, body, statics, statics.mean_stiffness, settings, Direction::up, no_report), 0);
    };
    const double modal = with(BodyModel::modal), relaxed = std::abs(with(BodyModel::relaxed) / modal - 1),
                 at_once = std::abs(with(BodyModel::quasi_static) / modal - 1),
                 rigid = std::abs(with(BodyModel::rigid) / modal - 1);
    CHECK(relaxed > 0);
    CHECK(relaxed < 0.03);
    CHECK(relaxed < at_once);
    CHECK(at_once < 0.5 * rigid);
  }
}

TEST_CASE("what the next model level changes: its sweeps are those of a scene one model level up") {
  const ReducedBody& body = paper_body();
  StaticParameters line = paper_statics(128);
  line.contact.strips = 8;
  line.fidelity.contact = ContactModel::line;
  const StaticResult statics = static_transmission(body, body, line, 150),
                     reference = static_transmission(body, body, line, 100);
  SweepParameters settings = paper_sweep(1300, 1400, 50);
  settings.fidelity.contact = ContactModel::line;
  settings.fidelity.body = BodyModel::relaxed;
  const std::vector<NextSweep> next = next_sweeps(body, body, statics, reference, settings);
  REQUIRE(next.size() == 2);
  CHECK(next[0].key == "contact");
  CHECK(next[0].to == "strips");
  CHECK(next[0].settings.fidelity.contact == ContactModel::strips);
  CHECK(next[0].settings.fidelity.body == BodyModel::relaxed);
  line.fidelity.contact = ContactModel::strips;
  CHECK(next[0].statics.transmission_error == static_transmission(body, body, line, 150).transmission_error);
  CHECK(next[0].mean_stiffness == static_transmission(body, body, line, 100).mean_stiffness);
  CHECK(next[1].key == "body");
  CHECK(next[1].to == "modal");
  CHECK(next[1].settings.fidelity.contact == ContactModel::line);
  CHECK(next[1].mean_stiffness == reference.mean_stiffness);

  const SweepResult here =
      sweep(body, body, statics, reference.mean_stiffness, settings, Direction::up, no_report);
  SweepResult there = here;
  const SweepChange none = sweep_change(here, there);
  CHECK(none.compared == 3);
  CHECK(none.apart + none.uneven == 0);
  CHECK(none.dte_rms.largest == 0);
  CHECK(none.tooth_load.rms == 0);
  // One row of three twice as far from its mean, no jump: compared.
  const VectorXd row = here.transmission_error[1].col(0);
  there.transmission_error[1].col(0) = 2 * (row.array() - row.mean()) + row.mean();
  SweepChange change = sweep_change(here, there);
  CHECK(change.compared == 3);
  CHECK(change.dte_rms.largest == relative(0.5, 1e-9));
  CHECK(change.dte_rms.rms == relative(0.5 / std::sqrt(3), 1e-9));
  CHECK(change.dte_rms.at == 1350);
  CHECK(change.dte_mean.largest < 1e-12);
  // The same across a jump: apart until the two meet again.
  there.jump_frequency = there.jump_width = VectorXd::Constant(1, 1325);
  change = sweep_change(here, there);
  CHECK(change.compared == 2);
  CHECK(change.apart == 1);
  CHECK(change.dte_rms.largest == 0);
  there.period_multiple[2] = 0;
  CHECK(sweep_change(here, there).uneven == 1);
  there.mesh_frequency[0] += 1;
  CHECK_THROWS_AS(sweep_change(here, there), Error);
}

TEST_CASE("what the next model level changes: after the last one, and where the mesh is too fine for it" *
          doctest::skip()) {
  const ReducedBody& fine = paper_body();
  const StaticResult statics = static_transmission(fine, fine, paper_statics(16), 150);
  const std::string both =
      message_of_input([&] { next_sweeps(fine, fine, statics, statics, paper_sweep(2000, 2000, 1)); });
  INFO(both);
  CHECK(contains(both, "contact = \"strips\" is the last model level of contact"));
  CHECK(contains(both, "body = \"modal\" is followed by \"full\": body = \"full\" wants all "));
  SweepParameters last = paper_sweep(2000, 2000, 1);
  last.fidelity.body = BodyModel::full;
  CHECK(
      names(message_of_input([&] { next_sweeps(fine, fine, statics, statics, last); }), {"model", "level"}));

  const ReducedBody& coarse = coarse_body(61);
  const StaticResult at = static_transmission(coarse, coarse, coarse_statics(ContactModel::strips), 50);
  const std::vector<NextSweep> next = next_sweeps(
      coarse, coarse, at, at, coarse_sweep(4000, 4000, 1, BodyModel::modal, ContactModel::strips));
  REQUIRE(next.size() == 1);
  CHECK(next[0].missing == "");
  CHECK(next[0].body[0].eigenfrequency.size() == coarse_body(kAllModes).eigenfrequency.size());
  CHECK(next[0].body[0].eigenfrequency == coarse_body(kAllModes).eigenfrequency);
}
