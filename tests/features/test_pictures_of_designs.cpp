// No text in the pictures of designs, maps and studies is cut at an edge or lies on other text.
#include <doctest/doctest.h>

#include "bench/work_precision_panels.h"
#include "gear/contact_lines.h"
#include "gear/train.h"
#include "paper/reading_figure.h"
#include "picture_inputs.h"
#include "refusal.h"
#include "relative.h"
#include "report/animation.h"
#include "report/compare_figures.h"
#include "report/engineering_axes.h"
#include "report/figure_list.h"
#include "report/response_figures.h"
#include "results/harris_map.h"
#include "small_system.h"
#include "solid/tooth_bending.h"
#include "system/statics.h"

using namespace whine;
using namespace whine::pictures;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

JumpMapResult map_at(double torque, bool corner) {
  JumpMapResult a;
  set_motions(a);
  a.mesh.corner.enabled = corner;
  a.torque = torque;
  a.bearing_stiffness = a.mean_stiffness = 460e6;
  a.first_harmonic = 46e6;
  a.one_pair_frequency = 2480;
  a.two_pair_frequency = 3040;
  a.damping_ratio = VectorXd::LinSpaced(6, 0.02, 0.1);
  a.rayleigh_stiffness = a.damping_ratio * 1.1e-4;
  a.excitation = 0.05 * a.damping_ratio.cwiseInverse();
  a.two_branches = Eigen::VectorXi{{1, 1, 1, 0, 0, 0}};
  a.open_below = a.unsteady = Eigen::VectorXi::Zero(6);
  a.branches_from = 1900 * a.two_branches.cast<double>();
  a.branches_to = 2800 * a.two_branches.cast<double>();
  a.loss_from = 1500 * a.two_branches.cast<double>();
  a.loss_to = 3000 * a.two_branches.cast<double>();
  a.peak_tooth_load = a.sustained_tooth_load = MatrixRM::Constant(6, 2, torque / 0.04);
  a.mesh_frequency = VectorXd::LinSpaced(5, 1500, 3500);
  for (int d = 0; d < 2; ++d) {
    a.dte_rms[d] = MatrixRM::Constant(6, 5, 1e-6);
    a.tooth_load_max[d] = MatrixRM::Constant(6, 5, torque / 0.04);
    a.separation_fraction[d] = MatrixRM::Constant(6, 5, 0.1);
  }
  return a;
}

}  // namespace

TEST_CASE("pictures of teeth that differ, cracks, bearings, relief: no text is cut or lies on other text") {
  StaticResult differ = at_rest(9999);
  constexpr int kPeriods = 50;
  differ.hunting_periods = kPeriods;
  differ.contact.positions = 8;
  differ.mesh_phase = VectorXd::LinSpaced(8 * kPeriods, 0, kPeriods - 0.125);
  differ.transmission_error = 1e-4 * (1 + 0.1 * (0.1 * differ.mesh_phase.array()).sin());
  differ.transmission_error[100] += 3e-5;
  differ.transmission_error_order = VectorXd::Constant(4 * kPeriods, 1e-6);
  ResponseResult moving = response_at(9999, Direction::up);
  moving.hunting_periods = kPeriods;
  moving.dte_order.assign(static_cast<size_t>(moving.mesh_frequency.size()),
                          MatrixRM::Constant(4 * kPeriods, 1, 1e-6));
  check(sidebands_figure(differ, moving), "sidebands");
  SweepResult swept = sweep_at(9999, Direction::up);
  swept.mesh_frequency = moving.mesh_frequency;
  swept.mesh_names = moving.mesh_names = {"pinion-wheel"};
  swept.hunting_periods = kPeriods;
  swept.transmission_error.assign(
      static_cast<size_t>(moving.mesh_frequency.size()),
      MatrixRM(1e-4 * VectorXd::LinSpaced(kPeriods * swept.time.steps_per_period, 0, 300).array().sin()));
  moving.residual_rms = 0.1 * moving.dte_rms;
  moving.residual_kurtosis = MatrixRM::Constant(moving.mesh_frequency.size(), 1, 73.21);
  check(residual_figure(swept, moving), "residual-signal");
  for (int g = 0; g < kSides; ++g) differ.gear[g].design.crack = {12, 1.2345e-3};
  differ.tooth_load = MatrixRM::Constant(8 * kPeriods, 3, 1e4);
  differ.root_stress = {MatrixRM::Constant(8 * kPeriods, 3, 123e6),
                        MatrixRM::Constant(8 * kPeriods, 3, 1234e6)};
  check(crack_figure(differ), "crack");
  std::vector<ResponseResult> on_bearings = both_ways(9999);
  for (ResponseResult& r : on_bearings) r.mesh.bearing = {Bearing{1234.5e6, 0, 0}, Bearing{2345.6e6, 0, 0}};
  check(bearing_force_figure(on_bearings, background_of(on_bearings)), "bearing-forces");
  std::vector<ResponseResult> in_slices = both_ways(9999);
  for (ResponseResult& r : in_slices) {
    r.face_load_factor = MatrixRM::Constant(r.mesh_frequency.size(), 1, 1.2345);
    r.line_load_max = MatrixRM::Constant(r.mesh_frequency.size(), 1, 1.2345e6);
  }
  check(face_load_figure(in_slices, background_of(in_slices)), "face-load");
  StaticResult relieved = at_rest(9999);
  for (FlankModification& m : relieved.mesh.modification) m.tip = {123e-6, 0, 0, 2e-3};
  check(profile_figure(relieved), "profile");
}

TEST_CASE("pictures of designs and of an error budget: no text is cut or lies on other text") {
  std::vector<RestCurve> rest;
  std::vector<OfDesign<ResponseResult>> motion;
  for (const char* name :
       {"gearbox_of_the_first_variant_a", "gearbox_of_the_first_variant_b", "gearbox_of_the_third_variant",
        "d", "fifth_variant_of_the_gearbox", "gearbox_of_the_sixth_variant"}) {
    rest.push_back(rest_curve(name, at_rest(9999)));
    for (const ResponseResult& r : both_ways(9999)) motion.push_back({name, r});
  }
  check(compared_rest_figure(rest), "compare-rest");
  std::vector<RestCurve> trains = rest_curves("gearbox_of_the_first_variant", small_system());
  for (RestCurve& curve : rest_curves("gearbox_of_the_second_variant", small_system()))
    trains.push_back(curve);
  check(compared_rest_figure(trains), "compare-rest");
  check(compared_motion_figure(motion), "compare-motion");
  Figure turned = compared_motion_figure(motion);
  apply({"rpm:driver", 1e-6}, turned);
  check(turned, "compare-motion");
  ErrorBudgetResult budget;
  set_gears(budget);
  budget.torque = 9999;
  budget.refinement = {"strips, flank table, elements, positions",
                       VectorXd::Constant(4, 1e-4),
                       VectorXd::Constant(4, 3e-4),
                       VectorXd::Constant(4, 5e-4),
                       MatrixRM::Constant(4, 5, 2e-4),
                       VectorXd::Constant(4, 7e-3)};
  budget.choice = {"matching at 1 mm, contact line", VectorXd::Constant(2, 1e-2),
                   VectorXd::Constant(2, 0.3),       VectorXd::Constant(2, 0.2),
                   MatrixRM::Constant(2, 5, 2e-2),   VectorXd::Constant(2, 7e-3)};
  budget.gear_names = {budget.mesh.gear[0], budget.mesh.gear[1]};
  budget.root = {Eigen::Vector4d(0.4e-3, 0.2e-3, 0.1e-3, 0.05e-3), MatrixRM(4, 2)};
  budget.root.stress << 9e8, 8e8, 9.5e8, 8.5e8, 9.7e8, 8.7e8, 9.75e8, 8.75e8;
  check(error_budget_figure(budget), "error-budget");
}

TEST_CASE("pictures of the errors of motions: no text is cut or lies on other text") {
  std::vector<SweepErrorsResult> sweeps(2);
  for (SweepErrorsResult& a : sweeps) {
    constexpr int kSpeeds = 24;
    set_gears(a);
    a.torque = 9999;
    a.mesh_names = {"pinion-wheel"};
    a.natural_frequency = 5432.1;
    a.mesh_frequency = VectorXd::LinSpaced(kSpeeds, 1000, 9000);
    a.dte_rms.value = MatrixRM::Constant(kSpeeds, 1, 12e-6);
    a.tooth_load_max.value = MatrixRM::Constant(kSpeeds, 1, 12345);
    a.jump_frequency = a.jump_error = Eigen::Vector4d(2345.6, 3456.7, 5678.9, 7890.1);
    a.entry = {"steps 128 to 256", "elements 0.333 to 0.167 mm", "flank table 401 to 802 points",
               "modes 61 to 92",   "periodicity 1e-05 to 1e-06", "strips 8 to 16"};
    const auto entries = static_cast<Index>(a.entry.size());
    a.order = VectorXd::Constant(entries, 1.98);
    a.compared = MatrixRMi::Ones(entries, kSpeeds);
    a.jump_found = MatrixRMi::Zero(entries, 4);
    a.jump_change = MatrixRM::Constant(entries, 4, 12.3);
    for (Index e = 0; e < entries; ++e)
      a.dte_rms.change.push_back(MatrixRM::Constant(kSpeeds, 1, std::pow(10, -6.0 + static_cast<double>(e))));
    a.dte_rms.error = MatrixRM::Constant(kSpeeds, 1, 0.3);
  }
  sweeps[1].direction = Direction::down;
  check(sweep_errors_figure(sweeps), "motion-errors");
  check(sweep_errors_figure({sweeps[0]}), "motion-errors");
}

TEST_CASE("pictures of a run-up: no text is cut or lies on other text") {
  RunupResult run;
  set_motions(run);
  run.body_names = {run.mesh.gear[0], run.mesh.gear[1]};
  run.mesh_names = {run.mesh.gear[0] + "-" + run.mesh.gear[1]};
  run.input = run.mesh.gear[0];
  run.torque = 9999;
  run.natural_frequency = 5432.1;
  run.ramp = {1000, 9000, 12345};
  run.mesh_acceleration = 12345 / 60.0 * 50;
  run.sample_rate = 48000;
  run.pair = Eigen::Vector3i(-1, 0, 1);
  const double seconds = 8000 / run.mesh_acceleration;
  const auto samples = static_cast<Index>(seconds * run.sample_rate), periods = static_cast<Index>(200);
  run.samples.time = VectorXd::LinSpaced(samples, 0, seconds);
  run.samples.mesh_frequency = 1000 + run.mesh_acceleration * run.samples.time.array();
  run.samples.mesh_force = run.samples.transmission_error = MatrixRM(samples, 1);
  for (Index i = 0; i < samples; ++i) {
    const double wave = std::cos(kTwoPi * run.mesh_phase(run.samples.time[i]));
    run.samples.mesh_force(i, 0) = 1.4e5 * (1 + 0.5 * wave);
    run.samples.transmission_error(i, 0) = 123e-6 * (1 + wave);
  }
  run.samples.tooth_load = MatrixRM::Constant(samples, 3, 1e5);
  run.periods.time = VectorXd::LinSpaced(periods, 0, seconds);
  run.periods.mesh_frequency = VectorXd::LinSpaced(periods, 1000, 9000);
  run.periods.dte_rms = run.periods.dte_mean = MatrixRM::Constant(periods, 1, 1e-4);
  run.periods.tooth_load_max = MatrixRM::Constant(periods, 1, 5e5);
  run.periods.separation_fraction = MatrixRM::Constant(periods, 1, 0.3);
  check(runup_figure(run, both_ways(9999)), "runup");
}

TEST_CASE("pictures of maps, branches and studies: no text is cut or lies on other text") {
  HarrisMapResult map;
  set_motions(map);
  map.torque = VectorXd::LinSpaced(12, 1000, 9999);
  map.relief = VectorXd::LinSpaced(30, 0, 150e-6);
  map.design_torque = 5000;
  map.length = VectorXd::LinSpaced(6, 1e-3, 4e-3);
  map.optimum_relief = map.optimum_peak_to_peak = VectorXd::Constant(6, 30e-6);
  map.start_roll = MatrixRM::Constant(6, 2, 0.4);
  map.cusp = MatrixRM::Constant(6, 12, 12e-6);
  map.unrelieved = VectorXd::LinSpaced(12, 30e-6, 200e-6);
  MatrixRM values(12, 30);
  for (Index t = 0; t < 12; ++t)
    for (Index r = 0; r < 30; ++r) values(t, r) = 1e-6 + std::abs(map.relief[r] - 12e-9 * map.torque[t]);
  map.peak_to_peak.assign(6, values);
  for (auto& harmonic : map.harmonic) harmonic.assign(6, values);
  check(harris_map_figure(map), "harris-map");
  map.dynamic_rms.assign(6, values);
  map.worst_frequency.assign(6, MatrixRM::Constant(12, 30, 5432));
  map.torque *= 10;
  map.design_torque *= 10;
  check(harris_map_figure(map), "harris-map");
  BranchResult branch;
  set_motions(branch);
  branch.torque = 9999;
  constexpr Index n = 61;
  branch.mesh_frequency = VectorXd::LinSpaced(n, 1000, 9000);
  branch.place_pair(pair_system(branch));
  branch.dte_rms = branch.dte_mean = VectorXd::LinSpaced(n, 1e-6, 300e-6);
  branch.stable = Eigen::VectorXi::Ones(n);
  branch.stable.segment(20, 20).setZero();
  branch.floquet_multiplier.assign(n, MatrixRM::Constant(4, 2, 0.6));
  branch.steps = branch.period_multiple = Eigen::VectorXi::Ones(n);
  branch.part = Eigen::VectorXi::Zero(n);
  branch.fold_frequency = Eigen::Vector3d(4321.12, 5432.12, 6543.12);
  branch.fold_width = Eigen::Vector3d::Constant(0.4);
  branch.fold_rms = Eigen::Vector3d::Constant(1e-4);
  branch.fold_smooth = Eigen::Vector3i(1, 0, 1);
  branch.fold_multiplier = MatrixRM::Ones(3, 2);
  branch.mesh_force_sustained = branch.tooth_load_sustained = VectorXd::LinSpaced(n, 1e5, 3e5);
  branch.root_stress_sustained = VectorXd::LinSpaced(n, 1e9, 3e9).replicate(1, 2);
  branch.root_stress_angle = branch.root_stress_phase = MatrixRM::Zero(n, 2);
  branch.end = "leaves the speeds of the scene";
  check(multiplier_figure(branch), "multipliers");
  const std::vector<ResponseResult> one = both_ways(9999);
  check(branch_figure(branch, one), "branch");
  CaptionSources tell = background_of(one);
  tell.branches = {branch};
  check(response_figure(one, tell), "fig05");
  check(root_stress_figure(at_rest(9999), one, {branch}), "root-stress");

  std::vector<JumpMapResult> maps;
  std::vector<FoldCurvesResult> curves;
  for (const double torque : {1250.0, 2500.0, 5000.0, 9999.0})
    for (const bool corner : {true, false}) {
      maps.push_back(map_at(torque, corner));
      if (!corner) continue;
      FoldCurvesResult f;
      set_motions(f);
      f.torque = torque;
      f.curve = Eigen::Vector3i::Zero();
      f.value = Eigen::Vector3d(4e-6, 5e-6, 6e-6);
      f.damping_ratio = Eigen::Vector3d(0.05, 0.06, 0.07);
      f.fold_frequency = Eigen::Vector3d(2400, 2500, 2600);
      f.fold_multiplier = MatrixRM::Ones(3, 2);
      f.highest = Eigen::Vector3i::Ones();
      f.cusp_value = f.cusp_frequency = VectorXd::Constant(1, 2600);
      f.cusp_damping_ratio = VectorXd::Constant(1, 0.07);
      f.cusp_curve = Eigen::VectorXi::Zero(1);
      f.end = "leaves the range";
      curves.push_back(f);
    }
  check(jump_map_figure(maps, curves), "jump-map");
  check(fold_curve_figure(curves, {maps[0], maps[2]}), "fold-curves");
}

TEST_CASE("pictures of lumped models and of variants: no text is cut or lies on other text") {
  std::vector<SweepResult> sweeps;
  for (const auto model : {MotionModel::rectangular, MotionModel::pairs_hertz, MotionModel::secant})
    for (const Direction direction : {Direction::up, Direction::down}) {
      SweepResult s = sweep_at(9999, direction);
      s.model = model;
      s.lumped.mass = 1.2345;
      s.lumped.damping_ratio = 0.0765;
      s.lumped.cell_end = VectorXd::Ones(1);
      s.lumped.stiffness = MatrixRM::Constant(1, 2, 293.9e6);
      s.lumped.stiffness(0, 1) = 516.7e6;
      s.lumped.gap = MatrixRM::Zero(1, 2);
      s.mean_stiffness = 460e6;
      s.jump_frequency = Eigen::Vector2d(4567.8, 5678.9);
      sweeps.push_back(s);
    }
  check(mesh_force_figure(sweeps, {5500, 4500}), "fig15");
  std::vector<JumpMapResult> lumped, variants;
  for (const double torque : {1250.0, 2500.0, 5000.0, 9999.0}) {
    JumpMapResult a = map_at(torque, true);
    lumped.push_back(a);
    for (const auto model : {MotionModel::secant, MotionModel::pairs_hertz, MotionModel::rectangular}) {
      a.model = model;
      lumped.push_back(a);
    }
    a.damper_acts = DamperActs::contact;
    lumped.push_back(a);
  }
  check(lumped_jump_map_figure(lumped), "jump-map-lumped");
  const JumpMapResult base = map_at(9999, true);
  for (int i = 0; i < 12; ++i) {
    JumpMapResult v = base;
    v.gear[0].design.bore_radius += (1.2345 + i) * 1e-4;
    v.inertia[1] *= 1.1;
    v.mean_stiffness *= 1 + 0.01 * (i - 5);
    v.one_pair_frequency += 123.4 * (i - 5);
    v.branches_from *= 1 + 0.05 * i;
    variants.push_back(v);
  }
  check(sensitivity_figure(base, variants), "sensitivity");
}

TEST_CASE("pictures of studies: no text is cut or lies on other text") {
  const TemporaryFolder folder;
  StudyResult a;
  a.plan = read_study(folder.file(
      "study.toml", "scene = '" +
                        std::filesystem::absolute("data/scenes/parker2000-standard-tooth.toml").string() +
                        "'\nstage = 'sweep'\ntitle = 'Tip relief and damping of the second variant'\n"
                        "[[vary]]\nkey = 'damping.rayleigh_stiffness_s'\nvalues = [4e-6, 5.5e-6, 7e-6]\n"
                        "[[vary]]\nkey = 'operation.torque_Nm'\nvalues = [1250, 5000, 9999]\n"
                        "[[vary]]\nkey = 'gear.pinion.modification.tip_relief_um'\nvalues = [0, 5, 12.5]\n"
                        "[[vary]]\nkey = 'gear.wheel.modification.tip_relief_um'\nvalues = [0, 5, 12.5]\n"));
  for (int i = 0; i < 81; ++i) {
    std::vector<std::string> values;
    int rest = i;
    for (const VariedKey& key : a.plan.keys) {
      values.push_back(key.values[static_cast<size_t>(rest % 3)]);
      rest /= 3;
    }
    a.variants.push_back({text("ab", i), values});
  }
  a.rejection.assign(81, "");
  a.unsteady = Eigen::VectorXi::Zero(81);
  a.quantity = 1e-3 * (MatrixRM::Random(81, static_cast<Index>(a.plan.quantities.size())).array() + 1);
  for (size_t q = 0; q < a.plan.quantities.size(); ++q)
    a.quantity.col(static_cast<Index>(q)) *= a.plan.quantities[q] == "mean_stiffness"  ? 5e11
                                             : a.plan.quantities[q] == "contact_ratio" ? 1e3
                                                                                       : 1;
  check(study_figure(a), "study");
  a.plan.random = true;
  check(study_figure(a), "study");
}

TEST_CASE(
    "picture of a study as a map of cells: they tile, limits of contact loss; no text is cut or lies on other text") {
  const TemporaryFolder folder;
  StudyResult a;
  const Study study = read_study(folder.file(
      "study.toml",
      "scene = '" + std::filesystem::absolute("data/scenes/parker2000-helical-0_5.toml").string() +
          "'\nstage = 'sweep'\ntitle = 'Contact loss over overlap ratio and damping ratio of the second variant'\n"
          "quantities = ['contact_ratio', 'overlap_ratio', 'rayleigh_damping_ratio', 'te_mean', 'te_harmonic_1',\n"
          "  'separation_max_up', 'separation_max_down']\n"
          "[[vary]]\nkey = 'gear.pinion.face_width_mm'\nvalues = [12.5, 25, 50]\n"
          "[[vary]]\nkey = 'damping.rayleigh_stiffness_s'\nvalues = [4e-6, 2e-6]\n"
          "[figure]\nquantities = ['separation_max_up', 'separation_max_down']\n"
          "map = ['overlap_ratio', 'rayleigh_damping_ratio']\n"));
  a.plan = study;
  a.quantity.resize(6, 7);
  for (long v = 0; v < 6; ++v) {
    a.variants.push_back({text("ab", v), variant_values(study, v)});
    const double overlap = 0.25 * std::pow(2, v / 2);
    a.quantity.row(v) << 1.5, overlap, v % 2 ? 0.02 : 0.04, 4e-6, 1e-7, v == 1 ? 0.123 : 0,
        v == 1 ? 0.456 : 0;
  }
  a.rejection.assign(6, "");
  a.unsteady = Eigen::VectorXi::Zero(6);
  a.unsteady[1] = 3;
  const Figure figure = study_figure(a);
  check(figure, "study");
  const auto rows = [&](const std::string& name) {
    for (const FigureBlock& block : figure.blocks)
      if (block.name == name) return block.rows;
    return std::vector<std::vector<double>>();
  };
  const auto cells = rows("map separation_max_up"), lines = rows("contact lines"), still = rows("static TE");
  REQUIRE(cells.size() == 6);
  const double edge[] = {0.125, 0.375, 0.75, 1.25};
  for (size_t v = 0; v < 6; ++v) {
    CHECK(cells[v][3] == relative(edge[v / 2], 1e-12));
    CHECK(cells[v][4] == relative(edge[v / 2 + 1], 1e-12));
    CHECK(cells[v][5] == relative(v % 2 ? 0.01 : 0.03, 1e-12));
    CHECK(cells[v][6] == relative(v % 2 ? 0.03 : 0.05, 1e-12));
  }
  CHECK(cells[1][2] == 0.123);
  REQUIRE(lines.size() > 2);
  CHECK(lines.front()[1] == relative(0.5 * contact_line_harmonic(1.5, 0.125), 1e-12));
  REQUIRE(still.size() == 3);
  CHECK(still[0][1] == relative(0.0125, 1e-12));
  a.plan.figure_map = {"overlap_ratio", "contact_ratio"};
  CHECK(names(message_of([&] { study_figure(a); }), {"contact_ratio", "map", "[figure]"}));
}

TEST_CASE("pictures of readings and of work and precision: no text is cut or lies on other text") {
  ReadingsResult readings;
  Consistency found;
  for (int i = 0; i < 40; ++i) {
    Reading r;
    r.choices.corner = {i % 4 > 0, (i % 4 == 1 ? 0.3 : i % 4 == 2 ? 2.0 : 90.0) * std::numbers::pi / 180};
    r.level_ratio = 1.4 + 0.01 * i;
    readings.readings.push_back(r);
    found.order.push_back(static_cast<size_t>(i));
    found.agreeing.push_back(20 + i % 30);
  }
  for (const ClaimSet& set : read_claim_sets("data/published/claim_sets.toml"))
    found.sets.push_back({set, found.sets.empty() ? 1234 : 0, 0, 12, {"a", "b", "c"}});
  check(reading_figure(readings, found), "reading");
  Figure work;
  work.title = "Error against CPU time: 9999 teeth";
  work.notes = {
      "errors: against settings for 0.075 % (9999 s of CPU), largest of 48 rising speeds, here at 12345 to 23456 Hz",
      "one setting alone: half and twice as fine as chosen; elements by their number, periodicity 8 times"};
  for (const char* name :
       {"settings for an accepted error", "elements alone", "modes alone", "least rate of time steps alone",
        "strips alone", "periodicity alone", "chosen for 0.25 %", "the scene as it stands"}) {
    FigureBlock block{name, {"setting", "s", "%", "%"}, {}};
    for (int k = 1; k < 5; ++k) block.rows.push_back({1.0 * k, std::pow(10, k - 1), std::pow(10, 1 - k), 1});
    work.blocks.push_back(block);
  }
  add_work_precision_panel(work);
  check(work, "work-precision");
}

TEST_CASE("pictures of gears as they are drawn and of their motion: no text is cut or lies on other text") {
  BodyDiscretisation coarse;
  coarse.element_size = 2e-3;
  const SectorGrid mesh = make_sector_mesh(paper_gear(), coarse);
  StaticResult rest = at_rest(9999);
  for (auto& gear : rest.gear) gear.design.tooth_thinning = 0;
  check(mesh_figure(mesh, mesh, rest), "fig01");
  SweepResult moving = sweep_at(9999, Direction::up);
  for (auto& gear : moving.gear) gear.design.tooth_thinning = 0;
  Figure frames = animation_figure(mesh, mesh, moving, tooth_bending, 0, 4);
  frames.numbers.emplace_back("first_frame", 1);
  frames.numbers.emplace_back("last_frame", 1);
  check(frames, "animation");
}

TEST_CASE("pictures of the contact zone: no text is cut or lies on other text") {
  const ReducedBody& body = paper_body(40e-3, 1.2e-3, 1);
  const SectorGrid mesh = make_sector_mesh(body.design, body.discretisation);
  StaticResult loaded = static_transmission(body, body, paper_statics(2), 9999);
  loaded.reference_contact = reference_contact(body, body, loaded);
  check(contact_zone_figure(mesh, mesh, loaded), "fig03");
}

TEST_CASE("pictures of the load over the face: no text is cut or lies on other text") {
  StaticParameters settings = paper_statics(8);
  settings.fidelity.width = WidthModel::slices;
  settings.mesh.misalignment = 15e-6;
  const ReducedBody& body = paper_body(40e-3, 1.2e-3, 1);
  SystemStaticResult pair = pair_at_rest(body, body, settings, 600);
  check(flank_load_figure(pair), "flank-load");
  // With root stresses as bodies in three dimensions have them.
  StaticResult& mesh = pair.mesh[0];
  mesh.root_stress_max = Eigen::Vector2d(438.2e6, 379.1e6);
  mesh.face.load_factor_root = Eigen::Vector2d(1.803, 1.276);
  mesh.face.root_stress_error = Eigen::Vector2d(15e6, 3.2e6);
  for (size_t g = 0; g < kSides; ++g) {
    const Eigen::VectorXd z = Eigen::VectorXd::LinSpaced(41, -20e-3, g == 0 ? 20e-3 : 24e-3);
    mesh.face.root_position[g] = z;
    const Eigen::VectorXd stress = mesh.root_stress_max[static_cast<Eigen::Index>(g)] *
                                   (1 + z.array() * 40 - 1e3 * z.array().square()) / 1.5;
    mesh.face.root_stress[g].assign(8, stress.transpose().replicate(mesh.pair.size(), 1));
  }
  check(flank_load_figure(pair), "flank-load-roots");
  // Told as a train with two [[mesh]]: a row each.
  SystemStaticResult train = pair;
  train.mesh.push_back(pair.mesh[0]);
  train.mesh_names = {"sun-planet1", "planet1-ring"};
  train.settings.section = {0, 1};
  train.settings.layout.load = System::Load::drives;
  REQUIRE(train.of_train());
  check(flank_load_figure(train), "flank-load");
}
