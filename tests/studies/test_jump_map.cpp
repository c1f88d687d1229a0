// Maps of jumps: their branches against separate sweeps, their damping ratios against ring-downs; variants of scenes; what
// the figures say in words.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "dynamics/impact.h"
#include "figure_block.h"
#include "io/artifacts.h"
#include "io/scene.h"
#include "io/scene_keys.h"
#include "io/variant.h"
#include "own_folder.h"
#include "paper/beside.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "report/figure_list.h"
#include "results/impact.h"
#include "results/jump_map.h"
#include "results/static.h"
#include "studies/jump_map.h"

using namespace whine;

namespace {

const ReducedBody& coarse() {
  return paper_body(40e-3, 0.8e-3);
}

SweepParameters motion() {
  SweepParameters settings = paper_sweep(0, 0, 0);
  settings.damping.rayleigh_stiffness = 0;
  settings.fidelity.contact = ContactModel::line;
  settings.reference_torque = 150;
  return settings;
}

StaticParameters rest() {
  StaticParameters settings = paper_statics(128);
  settings.fidelity.contact = ContactModel::line;
  return settings;
}

JumpMapPlan plan(double from, double to, double step) {
  JumpMapPlan plan;
  plan.from = from;
  plan.to = to;
  plan.step = step;
  return plan;
}

JumpMapResult small_map(double torque, bool corner, std::vector<double> ratios, double lost_below) {
  JumpMapResult a;
  a.gear[0].design = a.gear[1].design = coarse().design;
  a.gear[0].material = a.gear[1].material = {207e9, 0.3, 7600, true};
  a.gear[0].discretisation = a.gear[1].discretisation = coarse().discretisation;
  a.inertia[0] = a.inertia[1] = 0.0148;
  a.mesh = paper_statics(128).mesh;
  a.mesh.corner.enabled = corner;
  a.torque = torque;
  a.bearing_stiffness = a.mean_stiffness = 460e6;
  a.first_harmonic = 0.1 * a.mean_stiffness;
  a.one_pair_frequency = 2480;
  a.two_pair_frequency = 3040;
  const auto n = static_cast<Eigen::Index>(ratios.size());
  a.damping_ratio = Eigen::Map<Eigen::VectorXd>(ratios.data(), n);
  a.rayleigh_stiffness = a.damping_ratio * 1.1e-4;
  a.excitation = 0.05 * a.damping_ratio.cwiseInverse();
  a.two_branches = (a.damping_ratio.array() < 0.5 * lost_below).cast<int>();
  a.open_below = a.unsteady = Eigen::VectorXi::Zero(n);
  a.branches_from = 1900 * a.two_branches.cast<double>();
  a.branches_to = 2800 * a.two_branches.cast<double>();
  a.loss_to = 3000 * (a.damping_ratio.array() < lost_below).cast<double>();
  a.loss_from = 0.9 * a.loss_to;
  a.peak_tooth_load = MatrixRM::Constant(n, 2, 40 * torque);
  a.sustained_tooth_load = MatrixRM::Constant(n, 2, 32 * torque);
  a.mesh_frequency = Eigen::VectorXd{{2000, 2400, 2800}};
  a.load_frequency = 2400;
  a.tooth_load = MatrixRM::Constant(n, 2, 20 * torque);
  a.sustained_load_there = MatrixRM::Constant(n, 2, 16 * torque);
  a.dte_rms_there = MatrixRM::Constant(n, 2, 1e-6);
  for (int d = 0; d < 2; ++d) {
    a.dte_rms[d] = MatrixRM::Constant(n, 3, 1e-6);
    a.tooth_load_max[d] = MatrixRM::Constant(n, 3, 40 * torque);
    a.separation_fraction[d] = MatrixRM::Zero(n, 3);
  }
  a.jump_case = a.jump_direction = Eigen::VectorXi::Zero(1);
  a.jump_frequency = Eigen::VectorXd::Constant(1, 2800);
  a.jump_width = Eigen::VectorXd::Constant(1, 0.3);
  return a;
}

bool says(const Figure& figure, const std::string& words) {
  for (const std::string& note : figure.notes)
    if (contains(note, words)) return true;
  return false;
}

}  // namespace

TEST_CASE(
    "a map's branches are the jumps of separate sweeps, its loads theirs, its damping that of a ring-down") {
  JumpMapPlan cases = plan(1700, 3000, 100);
  cases.rayleigh_stiffness = {5.5e-6};
  cases.damping_ratio = {0.10};
  cases.load_frequency = 2400;
  long reports = 0;
  const JumpMapResult map = jump_map(coarse(), coarse(), rest(), 150, motion(), cases,
                                     [&](long done, long total, const std::string&) {
                                       CHECK(done == ++reports);
                                       CHECK(total == 4);
                                     });
  CHECK(reports == 4);
  REQUIRE(map.mesh_frequency.size() == 14);
  const StaticResult statics = static_transmission(coarse(), coarse(), rest(), 150);
  SweepParameters settings = motion();
  settings.frequency_from = 1700;
  settings.frequency_to = 3000;
  settings.frequency_step = 100;
  settings.damping.rayleigh_stiffness = 5.5e-6;
  for (const Direction direction : {Direction::up, Direction::down}) {
    const SweepResult alone =
        sweep(coarse(), coarse(), statics, statics.mean_stiffness, settings, direction, no_report);
    REQUIRE(alone.jump_frequency.size() == 1);
    const int d = direction == Direction::up ? 0 : 1;
    CHECK((d == 0 ? map.branches_to : map.branches_from)[0] == alone.jump_frequency[0]);
    const int row = d == 0 ? 7 : 6;  // 2400 Hz
    REQUIRE(alone.mesh_frequency[row] == 2400);
    CHECK(map.tooth_load(0, d) == alone.tooth_load[row].maxCoeff());
    CHECK(map.sustained_load_there(0, d) == sustained_load(alone.tooth_load[row], 128));
    CHECK(map.sustained_load_there(0, d) == relative(map.tooth_load(0, d), 2e-2));
    CHECK(map.dte_rms_there(0, d) == relative(rms(alone, row), 1e-12));
  }
  CHECK(map.two_branches[0] == 1);
  CHECK(map.open_below[0] == 0);
  CHECK(map.peak_tooth_load(0, 1) > 1.3 * map.tooth_load(0, 0));
  CHECK(map.loss_to[0] > map.branches_to[0]);  // contact parts above the jump, on the one branch there is
  CHECK(map.two_branches[1] == 0);
  CHECK(map.loss_to[1] == 0);
  CHECK(map.excitation[0] ==
        relative(map.first_harmonic / map.mean_stiffness / (2 * map.damping_ratio[0]), 1e-12));
  // Where the branches go on below the least speed.
  JumpMapPlan cut = plan(2200, 2900, 100);
  cut.rayleigh_stiffness = {5.5e-6};
  const JumpMapResult open = jump_map(coarse(), coarse(), rest(), 150, motion(), cut, no_report);
  CHECK(open.two_branches[0] == 1);
  CHECK(open.open_below[0] == 1);
  CHECK(open.branches_from[0] == 2200);
  CHECK(std::abs(open.branches_to[0] - map.branches_to[0]) < 2);

  StaticParameters on_strips = rest();
  on_strips.fidelity.contact = ContactModel::strips;
  const StaticResult fixed = static_transmission(coarse(), coarse(), on_strips, 150);
  ImpactPlan impact_plan;
  impact_plan.phases = 16;
  for (int c = 0; c < 2; ++c) {
    SweepParameters ring = motion();
    ring.fidelity.contact = ContactModel::strips;
    ring.damping.rayleigh_stiffness = map.rayleigh_stiffness[c];
    const ImpactResult decay =
        impact(coarse(), coarse(), fixed, map.bearing_stiffness, ring, impact_plan, [](long, long) {});
    const auto two = decay.states.row_of(ContactState::two);
    REQUIRE(two);
    CHECK(map.damping_ratio[c] == relative(decay.states.damping_ratio[*two], 5e-3));
    CHECK(map.two_pair_frequency == relative(decay.states.undamped_frequency[*two], 1e-3));
  }
  CHECK(map.damping_ratio[1] == relative(0.10, 1e-8));
}

TEST_CASE(
    "a sustained load leaves out what lasts no longer than 1/64 of a period, in one pair as in the other") {
  MatrixRM load = MatrixRM::Constant(128, 2, 10);
  load.col(1).setConstant(5);
  load(40, 1) = load(41, 1) = 100;
  CHECK(sustained_load(load, 128) == 10);
  load(42, 1) = 50;
  CHECK(sustained_load(load, 128) == 50);
  load(127, 0) = load(126, 0) = 200;  // whatever stands at the ends
  CHECK(sustained_load(load, 128) == 50);
  CHECK(sustained_load(load.topRows(64), 64) == 100);  // two samples of 64 are as long
  // Where the motion repeats its end is followed by its begin; what stands behind it is not looked at.
  load(0, 0) = 150;
  CHECK(sustained_load(load, 128) == 50);
  CHECK(sustained_load(load, 128, 1) == 150);
  CHECK(sustained_load(load, 64, 1) == 100);
  // 64 does not divide 100: three samples span 0.02 of a period, two would span less than 1/64.
  MatrixRM other = MatrixRM::Constant(100, 1, 10);
  other(30, 0) = other(31, 0) = 100;
  CHECK(sustained_load(other, 100) == 10);
  other(32, 0) = 70;
  CHECK(sustained_load(other, 100) == 70);
}

TEST_CASE("maps that cannot be are rejected with what, value and limit") {
  const auto rejected = [&](const JumpMapPlan& p, const std::vector<Field>& fields, double torque = 150) {
    CHECK(
        names(message_of_input([&] { jump_map(coarse(), coarse(), rest(), torque, motion(), p, no_report); }),
              fields));
  };
  JumpMapPlan p = plan(2000, 2200, 100);
  rejected(p, {"case"});
  p.damping_ratio = {-0.05};
  rejected(p, {"ratio", "-0.05"});
  p.damping_ratio = {0.001};
  rejected(p, {"alone", "ratio", "0.00*"});
  p.damping_ratio = {0.9};
  rejected(p, {"rayleigh_stiffness_s", "0.9"});
  p.damping_ratio = {0.05};
  p.load_frequency = 2400;
  rejected(p, {2400, 2000, 2200});
  p.load_frequency = 0;
  p.step = 0;
  rejected(p, {0, "step"});
  p.step = 100;
  p.to = 1900;
  rejected(p, {2000, 1900});
  p.to = 2200;
  rejected(p, {"torque_Nm", "-5"}, -5);
}

TEST_CASE("a map that was written reads back, and tells what differs from another") {
  const JumpMapResult a = small_map(150, true, {0.04, 0.06}, 0.05);
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  write(path, a, {"test", "test", {}});
  JumpMapResult b = read<JumpMapResult>(path);
  CHECK(a.damping_ratio == b.damping_ratio);
  CHECK(a.two_branches == b.two_branches);
  CHECK(a.tooth_load == b.tooth_load);
  CHECK(a.sustained_load_there == b.sustained_load_there);
  CHECK(a.sustained_tooth_load == b.sustained_tooth_load);
  CHECK(a.separation_fraction[1] == b.separation_fraction[1]);
  CHECK(a.jump_frequency == b.jump_frequency);
  CHECK(a.gear[0].design.bore_radius == b.gear[0].design.bore_radius);
  CHECK(changed_keys(a, b).empty());
  b.gear[0].design.bore_radius = b.gear[1].design.bore_radius = 35e-3;
  CHECK(changed_keys(a, b) == "bore_radius_mm 40 → 35");
  b.gear[1].design.bore_radius = 40e-3;
  CHECK(changed_keys(a, b) == "driver: bore_radius_mm 40 → 35; driven: ");
  b.gear[0].design.bore_radius = 40e-3;
  b.mesh.corner.enabled = false;
  CHECK(changed_keys(a, b) == "corner_contact true → false");
}

TEST_CASE("the map's figure says what its data say") {
  std::vector<JumpMapResult> maps;
  for (const double torque : {100.0, 150.0, 600.0}) {
    maps.push_back(small_map(torque, true, {0.05, 0.07, 0.09}, torque < 150 ? 0.08 : 0.06));
    maps.push_back(small_map(torque, false, {0.05, 0.07, 0.09}, 0.15));
  }
  Figure figure = jump_map_figure(maps, {}, jumps_of_paper());
  CHECK(says(figure, "at 7 %, corner contact: two branches at no torque, contact lost at 100 N m"));
  CHECK(says(
      figure,
      "at 7 %, no corner contact: two branches at every torque from 100 to 600 N m, contact lost at every torque from 100 to 600 N m"));
  CHECK(says(figure, "contact is lost at every torque with: no corner contact; P2000"));
  CHECK(says(figure, "single samples reach 1.25 times as much"));
  CHECK(says(figure, "P2000 prints 3.00 and 4.85; corner contact 2.4; no corner contact 2.4 and 2.4"));
  // First harmonic 0.1 of the mean; loss ends between 7 and 9 % at one torque, between 5 and 7 % at two.
  CHECK(says(figure, "above 1.67 (median of 3 limits"));
  CHECK(block(figure, "panel1").rows.size() == 11);
  CHECK(block(figure, "panel2").rows[0][6] == 2);
  for (JumpMapResult& a : maps)
    if (!a.mesh.corner.enabled && a.torque == 600) a.loss_to.setZero();
  figure = jump_map_figure(maps, {}, jumps_of_paper());
  CHECK(says(figure, "contact is lost at every torque with: none of these"));
  std::vector<JumpMapResult> split = maps;
  for (JumpMapResult& a : split) a.damping.rayleigh_mass = 1337;
  CHECK(says(jump_map_figure(split), "no corner contact, mu 1337 1/s: two branches"));
  for (JumpMapResult& a : maps) a.gear[0].design.teeth = 40;
  figure = jump_map_figure(maps, {}, jumps_of_paper());
  CHECK(!says(figure, "P2000"));
  CHECK(says(figure, "tooth loads in kN at 100 N m, 7 %"));
  maps.push_back(maps[0]);
  CHECK(names(message_of([&] { jump_map_figure(maps, {}, jumps_of_paper()); }), {"two", 100}));
  maps.back() = small_map(300, true, {0.05, 0.07, 0.09}, 0.1);
  CHECK(names(message_of([&] { jump_map_figure(maps, {}, jumps_of_paper()); }), {"torques"}));
  maps.back() = small_map(300, true, {0.05, 0.07, 0.08}, 0.1);
  CHECK(names(message_of([&] { jump_map_figure(maps, {}, jumps_of_paper()); }), {"damping ratios"}));
}

TEST_CASE("the figure of lumped models tells which keep contact, and how they agree with the elastic pair") {
  std::vector<JumpMapResult> maps;
  for (const double torque : {100.0, 200.0, 300.0}) {
    JumpMapResult elastic = small_map(torque, true, {0.06, 0.08, 0.10}, torque < 150 ? 0.09 : 0.07);
    maps.push_back(elastic);
    maps.push_back(small_map(torque, false, {0.06, 0.08, 0.10}, 0.15));  // another corner rule: left out
    JumpMapResult secant = elastic;
    secant.model = MotionModel::secant;
    if (torque == 300) secant.loss_to.setZero();  // one cell of nine differs
    maps.push_back(secant);
    secant.model = MotionModel::rectangular;
    secant.damper_acts = DamperActs::contact;
    secant.loss_to.setConstant(3000);
    secant.two_branches.setOnes();
    maps.push_back(secant);
  }
  Figure figure = lumped_jump_map_figure(maps, jumps_of_paper());
  for (const std::string& note : figure.notes) INFO(note);
  CHECK(figure.blocks.size() == 3);
  CHECK(says(
      figure,
      "two branches at every torque: rectangular, damper in contact; contact lost at every torque: rectangular, damper in contact"));
  CHECK(says(figure, "kept at 200 and 300 N m: elastic pair, corner contact; secant"));
  // Lost in 4 cells of 9 of the elastic pair, 3 of secant, 9 of the other; two branches in 0, 0 and 9. First harmonic 0.1 of
  // the mean; 6 % is kept by secant alone.
  CHECK(says(
      figure,
      "elastic pair, corner contact: at 8 % two branches at no torque, contact lost at 100 N m; (a) 1.25/1.25; (c) 8 %"));
  CHECK(says(
      figure,
      "secant: at 8 % two branches at no torque, contact lost at 100 N m; (a) 1.25/1.67; (b) 89/100 %; (c) 8 %"));
  CHECK(says(figure, "at every torque from 100 to 300 N m; (a) 1/-; (b) 44/0 %; (c) none"));
  for (JumpMapResult& a : maps) a.gear[0].design.teeth = 40;
  CHECK(!says(lumped_jump_map_figure(maps, jumps_of_paper()), "P2000's second"));
  std::erase_if(maps, elastic<JumpMapResult>);
  figure = lumped_jump_map_figure(maps, jumps_of_paper());
  CHECK(figure.blocks.size() == 2);
  CHECK(!says(figure, "as the elastic pair"));
  maps.push_back(maps[0]);
  CHECK(names(message_of([&] { lumped_jump_map_figure(maps, jumps_of_paper()); }), {"two", 100}));
  CHECK(names(message_of([&] { lumped_jump_map_figure({small_map(100, true, {0.05}, 0.1)}); }), {"one"}));
}

TEST_CASE("sensitivity: changes against the base, rows of one key together") {
  const JumpMapResult base = small_map(150, true, {0.05}, 0.2);
  JumpMapResult bore = base, stiff = base, corner = base;
  bore.gear[0].design.bore_radius = bore.gear[1].design.bore_radius = 35e-3;
  bore.mean_stiffness = 437e6;
  bore.branches_from[0] = 1850;
  stiff.gear[0].material.poisson_ratio = stiff.gear[1].material.poisson_ratio = 0.27;
  stiff.two_pair_frequency = 3050;
  corner.mesh.corner.enabled = false;
  corner.two_branches[0] = 0;
  const Figure figure = sensitivity_figure(base, {stiff, bore, corner});
  const auto& rows = figure.blocks[0].rows;
  REQUIRE(rows.size() == 3);
  CHECK(says(figure, "variant 0: corner_contact true → false"));
  CHECK(says(figure, "variant 1: bore_radius_mm 40 → 35"));
  CHECK(rows[0][7] == 0);
  CHECK(rows[1][1] == relative(-5.0, 1e-9));
  CHECK(rows[1][4] == -50);
  CHECK(rows[2][3] == 10);
  CHECK(names(message_of([&] { sensitivity_figure(base, {base}); }), {"same", "keys"}));
  CHECK(names(message_of([&] { sensitivity_figure(base, {}); }), {"one", "variant"}));
}

TEST_CASE("a variant of a scene has the changed keys and nothing else changed") {
  const std::string path = "data/scenes/parker2000-standard-tooth.toml";
  const auto folder = std::filesystem::temp_directory_path();
  const std::string variant = (folder / "whine_variant.toml").string();
  std::ofstream(variant) << scene_variant(
      path, {"bore_radius_mm=35", "plane=strain", "corner_contact=false", "steps_per_period=256"});
  const Scene from = read_scene(path), to = read_scene(variant);
  std::filesystem::remove(variant);
  for (const char* gear : {"pinion", "wheel"}) {
    CHECK(to.gear(gear).design.bore_radius == 0.035);
    CHECK(to.gear(gear).design.dedendum == from.gear(gear).design.dedendum);
    CHECK(!to.gear(gear).material.plane_stress);
  }
  CHECK(!to.mesh().corner.enabled);
  CHECK(to.time.steps_per_period == 256);
  CHECK(to.operation.torques == from.operation.torques);
  CHECK(to.damping.rayleigh_stiffness == from.damping.rayleigh_stiffness);
  std::ofstream(variant) << scene_variant(path, {"strips=8"});
  CHECK(static_parameters(read_scene(variant)) == static_parameters(from));
  CHECK(sweep_parameters(read_scene(variant)) == sweep_parameters(from));
  std::filesystem::remove(variant);
  const auto rejected = [&](const char* change) {
    return refusal_of([&] { scene_variant(path, {change}); });
  };
  CHECK(names(rejected("bore_radius=35").message, {"bore_radius_mm"}));
  CHECK(rejected("bore_radius_mm").kind == Failure::usage);
  CHECK(rejected("=3").kind == Failure::usage);
}
