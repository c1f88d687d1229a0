// The pair of P2000 told as a train of two gears, contact on lines in both: its sweeps jump, its branches fold and its orbits double
// their period at the same speeds. Only the fields of the residual flexibility differ, 12 in place of 8 a tooth.
#include <doctest/doctest.h>

#include <cmath>

#include "gear/system_layout.h"
#include "io/scene.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "signal/response.h"
#include "studies/branch.h"
#include "studies/error_budget.h"
#include "studies/fold_curves.h"
#include "studies/runup.h"
#include "studies/sweep.h"
#include "system/statics.h"
#include "system/system_rest.h"

using namespace whine;

namespace {

constexpr double kAlike = 2e-3;  // of a speed; seen: 6e-4

const ReducedBody& body() {
  return paper_body(40e-3, 1.2e-3, 12);
}

// Both of one speed range and damping (s).
struct Both {
  Both(double from, double to, double rayleigh_stiffness) : pair(paper_sweep(from, to, 50)) {
    pair.damping.rayleigh_stiffness = rayleigh_stiffness;
    pair.fidelity = {BodyModel::modal, ContactModel::line, Integrator::exact};
    pair.time.steps_per_period = 64;
    pair.time.min_sample_rate = 0;
    pair.reference_torque = 150;
    Scene scene;
    scene.gears = {paper_scene_gear("pinion"), paper_scene_gear("wheel")};
    scene.meshes.resize(1);
    scene.meshes[0].spec = paper_statics(64).mesh;
    scene.drives = {{"pinion", System::DriveKind::torque, 150, 0},
                    {"wheel", System::DriveKind::torque, -150, 0}};
    scene.operation.frequency_from = from;
    scene.operation.frequency_to = to;
    scene.operation.frequency_step = 50;
    scene.fidelity = pair.fidelity;
    scene.contact = {17, 64};
    scene.damping = pair.damping;
    scene.time = pair.time;
    train = sweep_parameters_of(scene, layout_of(scene));
  }
  SweepParameters pair;
  SystemSweepParameters train;

  static const StaticResult& statics() {
    static const StaticResult out = [] {
      StaticParameters settings = paper_statics(64);
      settings.fidelity.contact = ContactModel::line;
      return static_transmission(body(), body(), settings, 150);
    }();
    return out;
  }
  SweepResult pair_sweep(Direction direction) const {
    return sweep(body(), body(), statics(), statics().mean_stiffness, pair, direction, no_report);
  }
  SweepResult train_sweep(Direction direction) const {
    return system_sweep(train, {body(), body()}, direction, no_report);
  }
  BranchResult pair_along(const BranchPlan& plan) const {
    return pair_branch(body(), body(), statics(), statics().mean_stiffness, pair, no_report, plan);
  }
  BranchResult train_along(const BranchPlan& plan) const {
    return system_branch(train, {body(), body()}, no_report, plan);
  }
};

void check_alike(const Eigen::VectorXd& train, const Eigen::VectorXd& pair) {
  REQUIRE(train.size() == pair.size());
  for (Eigen::Index i = 0; i < pair.size(); ++i) CHECK(train[i] == relative(pair[i], kAlike));
}

}  // namespace

TEST_CASE("a pair as a train: the sweep jumps where that of the pair does, and where its branch folds") {
  const Both both(2300, 3000, 5.5e-6);
  const SweepResult pair = both.pair_sweep(Direction::up);
  const SweepResult train = both.train_sweep(Direction::up);
  REQUIRE(pair.jump_frequency.size() == 1);
  check_alike(train.jump_frequency, pair.jump_frequency);
  CHECK(train.jump_width[0] == relative(pair.jump_width[0], 1e-9));
  // Loads of the same teeth, and the same balance, whose dampers of bearings a train has apart.
  const double load = pair.tooth_load[0].maxCoeff();
  for (Eigen::Index p = 0; p < pair.pair.size(); ++p) {
    const Eigen::Index own = pair.pair[p] - train.pair[0];
    const Eigen::VectorXd known = pair.loads_of(0, 0).col(p);
    const Eigen::VectorXd found = own >= 0 && own < train.pair.size()
                                      ? Eigen::VectorXd(train.loads_of(0, 0).col(own))
                                      : Eigen::VectorXd(Eigen::VectorXd::Zero(known.size()));
    CHECK((found - known).cwiseAbs().maxCoeff() < 0.02 * load);
  }
  const ResponseResult train_response = response(train), pair_response = response(pair);
  for (Eigen::Index side = 0; side < kSides; ++side) {
    CHECK(train_response.root_stress_sustained(0, side) ==
          relative(pair_response.root_stress_sustained(0, side), 0.01));
    CHECK(train_response.root_stress_angle(0, side) ==
          relative(pair_response.root_stress_angle(0, side), 0.01));
    CHECK(std::abs(train_response.root_stress_phase(0, side) - pair_response.root_stress_phase(0, side)) <
          0.04);
  }
  for (const Eigen::Index line :
       {energy_line("rolling"), energy_line("relaxation_damping"), energy_line("throughput")})
    CHECK(train.energy(0, line) == relative(pair.energy(0, line), 0.02));
  CHECK(train.energy(0, energy_line("modal_damping")) + train.energy(0, energy_line("bearing_damping")) ==
        relative(pair.energy(0, energy_line("modal_damping")), 0.02));
  const BranchPlan from_sweep{.sweep = Direction::up, .at = 2500};
  const BranchResult branch = both.train_along(from_sweep);
  const BranchResult of_pair = both.pair_along(from_sweep);
  check_alike(branch.fold_frequency, of_pair.fold_frequency);
  // What orbits show at the speed of the sweep, which both begin at.
  const auto alike = [&](const MatrixRM& own, const MatrixRM& known) {
    CHECK(own(0, 0) == relative(known(0, 0), 0.02));
  };
  alike(branch.dte_rms, of_pair.dte_rms);
  alike(branch.dte_harmonic[0], of_pair.dte_harmonic[0]);
  alike(branch.mesh_force_max, of_pair.mesh_force_max);
  alike(branch.tooth_load_max, of_pair.tooth_load_max);
  alike(branch.mesh_force_sustained, of_pair.mesh_force_sustained);
  alike(branch.tooth_load_sustained, of_pair.tooth_load_sustained);
  CHECK(branch.separation_fraction(0, 0) == of_pair.separation_fraction(0, 0));
  // Root stress of the orbit is that of the sweep, within the sweep's periodicity.
  const Eigen::Index speed = 4;
  REQUIRE(train.mesh_frequency[speed] == relative(branch.mesh_frequency[0], 1e-9));
  for (const auto& [sustained, known] :
       {std::pair{&branch, &train_response}, std::pair{&of_pair, &pair_response}})
    for (Eigen::Index side = 0; side < kSides; ++side) {
      CHECK(sustained->root_stress_sustained(0, side) ==
            relative(known->root_stress_sustained(speed, side), 1e-4));
      CHECK(sustained->root_stress_angle(0, side) == relative(known->root_stress_angle(speed, side), 1e-3));
      CHECK(sustained->root_stress_phase(0, side) == known->root_stress_phase(speed, side));
    }
  // A sweep in steps ends at the fold, or at a kink a little before.
  CHECK(std::abs(train.jump_frequency[0] - branch.fold_frequency[0]) <
        branch.fold_width[0] + train.jump_width[0]);
}

namespace {

struct KeptPeriods : RunupSink {
  RunupPeriods periods;
  MatrixRM force;
  void begin(const RunupResult&, Eigen::Index, Eigen::Index) override {}
  void take(const RunupSamples& samples) override { force = samples.mesh_force; }  // one block
  void take(const RunupPeriods& all) override { periods = all; }
  void end(const RunupResult&) override {}
};

}  // namespace

TEST_CASE("a pair as a train: run-ups lose contact in the same mesh periods and carry the same loads") {
  const Both both(2740, 2900, 5.5e-6);
  RunupSettings wanted;
  wanted.ramp = {2740, 2900, 2000};
  KeptPeriods pair, train;
  runup(body(), body(), Both::statics(), Both::statics().mean_stiffness, both.pair, wanted, pair, no_report);
  runup(both.train, {body(), body()}, wanted, train, no_report);
  REQUIRE(pair.periods.size() == train.periods.size());
  REQUIRE(pair.periods.separation_fraction.maxCoeff() > 0.1);
  CHECK(train.periods.time == pair.periods.time);
  // The fold is passed 2 Hz apart, and after it the vibration grows by the same law.
  const auto first_parted = [](const RunupPeriods& periods) {
    Eigen::Index at = 0;
    while (!(periods.separation_fraction(at, 0) > 0)) ++at;
    return periods.mesh_frequency[at];
  };
  CHECK(first_parted(train.periods) == relative(first_parted(pair.periods), kAlike));
  const auto off = [](const MatrixRM& x, const MatrixRM& y) { return (x - y).norm() / y.norm(); };
  CHECK(off(train.periods.dte_rms, pair.periods.dte_rms) < 0.02);
  CHECK(off(train.periods.tooth_load_max, pair.periods.tooth_load_max) < 0.02);
  CHECK(off(train.periods.root_stress_sustained, pair.periods.root_stress_sustained) < 0.02);
  CHECK(off(train.force, pair.force) < 0.02);
}

TEST_CASE("a pair as a train: orbits of two mesh periods begin at the same speeds") {
  const Both both(5300, 6300, 2e-6);
  const BranchPlan plan{.most_periods = 2};
  const BranchResult pair = both.pair_along(plan);
  const BranchResult train = both.train_along(plan);
  REQUIRE(pair.flip_frequency.size() >= 1);
  check_alike(train.flip_frequency, pair.flip_frequency);
  CHECK(train.period_multiple.maxCoeff() == 2);
  CHECK(train.residual.maxCoeff() < 1e-6);
}

// The lower fold is where 1 % of damping moves the end of the branch by 40 Hz; the two damp by other fields.
TEST_CASE(
    "a pair as a train: its folds go over the torque as those of the pair, and are those of its branches") {
  Both both(2400, 3000, 6.5e-6);
  both.pair.time.steps_per_period = both.train.time.steps_per_period = 128;
  FoldCurvesPlan plan{.quantity = FoldQuantity::torque, .first = 150, .values = {150, 160}};
  plan.from = 2400;
  plan.to = 3000;
  StaticParameters at_rest = paper_statics(64);
  at_rest.fidelity.contact = ContactModel::line;
  const FoldCurvesResult pair = fold_curves(body(), body(), at_rest, 150, both.pair, plan, no_report);
  const FoldCurvesResult train = fold_curves(both.train, {body(), body()}, plan, no_report);
  INFO(pair.end, "; ", train.end);
  REQUIRE(pair.value.size() >= 4);
  REQUIRE(train.value.size() >= 4);
  SystemSweepParameters at_160 = both.train;
  for (System::Drive& drive : at_160.layout.drives) drive.torque *= 160.0 / 150;
  const BranchResult branch = system_branch(at_160, {body(), body()}, no_report);
  REQUIRE(branch.fold_frequency.size() == 2);
  // Values that are gone through on the way to one may differ.
  const auto fold_at = [](const FoldCurvesResult& of, double torque, int highest) {
    for (Eigen::Index i = 0; i < of.value.size(); ++i)
      if (of.value[i] == torque && of.highest[i] == highest) return of.fold_frequency[i];
    return 0.0;
  };
  for (const double torque : {150.0, 160.0})
    for (const int highest : {0, 1}) {
      CAPTURE(torque);
      CAPTURE(highest);
      const double own = fold_at(train, torque, highest);
      CHECK(own == relative(fold_at(pair, torque, highest), highest == 1 ? 1e-3 : 1e-2));
      if (torque == 160) CHECK((branch.fold_frequency.array() - own).abs().minCoeff() < 1e-4 * own);
    }
  // The factor of a damping ratio is Rayleigh's, an estimate from above.
  CHECK(train.damping_ratio[0] > pair.damping_ratio[0]);
  CHECK(train.damping_ratio[0] < 1.3 * pair.damping_ratio[0]);
  const auto refusal = [&](FoldQuantity quantity) {
    plan.quantity = quantity;
    return message_of([&] { fold_curves(both.train, {body(), body()}, plan, no_report); });
  };
  CHECK(names(refusal(FoldQuantity::tip_relief), {"tip_relief", "pairs"}));
  CHECK(names(refusal(FoldQuantity::bearing_stiffness), {"bearing_stiffness", "stiffness_N_um"}));
}

TEST_CASE("a pair as a train: its error budget is that of the pair, and names its gears") {
  const Both both(2300, 3000, 5.5e-6);
  StaticParameters settings = paper_statics(64);
  settings.fidelity.contact = ContactModel::line;
  settings.contact = both.train.contact;
  // The driven hub of a pair is held: off the line of action the levers of its teeth are not in the ratio of the torques.
  SystemStaticParameters held = both.train;
  held.layout.drives[1].kind = System::DriveKind::held;
  const ErrorBudgetResult pair = error_budget(body(), body(), settings, 150),
                          train = error_budget(held, {body(), body()});
  CHECK(train.torque == 150);
  CHECK(train.gear_names == std::vector<std::string>{"pinion", "wheel"});
  for (const auto part : {&ErrorBudgetResult::refinement, &ErrorBudgetResult::choice}) {
    const StaticChanges &one = pair.*part, &other = train.*part;
    REQUIRE(other.entry == one.entry);
    REQUIRE(one.mean_stiffness_change.size() > 2);
    constexpr double kRoundOff = 1e-8;  // of statics that are solved to 1e-9
    for (const auto change : {&StaticChanges::mean_stiffness_change, &StaticChanges::peak_to_peak_change,
                              &StaticChanges::pressure_change, &StaticChanges::root_stress_change})
      CHECK((other.*change - one.*change).cwiseAbs().maxCoeff() < kRoundOff);
    CHECK((other.harmonic_change - one.harmonic_change).cwiseAbs().maxCoeff() < kRoundOff);
  }
  CHECK((train.root.stress - pair.root.stress).cwiseAbs().maxCoeff() < 1e-8 * pair.root.stress.maxCoeff());
}

TEST_CASE("three gears in line: changes of the error budget are the largest of both meshes") {
  Scene scene;
  for (const char* name : {"first", "idler", "last"}) scene.gears.push_back(paper_scene_gear(name));
  scene.meshes.resize(2);
  for (size_t m = 0; m < 2; ++m) {
    scene.meshes[m].spec = paper_statics(16).mesh;
    scene.meshes[m].spec.gear = {scene.gears[m].name, scene.gears[m + 1].name};
  }
  scene.meshes[1].spec.modification[1].crowning = 5e-6;
  scene.drives = {{"first", System::DriveKind::torque, 150, 0}, {"last", System::DriveKind::held, 0, 0}};
  scene.contact = {8, 16};
  SystemStaticParameters settings = static_parameters_of(scene, layout_of(scene));
  settings.fidelity.contact = ContactModel::strips;
  const std::vector<ReducedBody> bodies(3, body());
  const ErrorBudgetResult budget = error_budget(settings, bodies);
  CHECK(budget.gear_names == std::vector<std::string>{"first", "idler", "last"});
  CHECK(budget.root.stress.cols() == 3);
  REQUIRE(budget.refinement.entry.starts_with("strips 8 to 16, "));
  REQUIRE(budget.refinement.entry.find("search range 1 to 2 times") != std::string::npos);
  const SystemStaticResult base = system_at_rest(settings, bodies);
  settings.contact.strips = 16;
  const SystemStaticResult finer = system_at_rest(settings, bodies);
  double most = 0;
  for (size_t m = 0; m < 2; ++m) {
    const double change = finer.mesh[m].mean_stiffness / base.mesh[m].mean_stiffness - 1;
    if (std::abs(change) > std::abs(most)) most = change;
  }
  CHECK(budget.refinement.mean_stiffness_change[0] == relative(most, 1e-9));
}
