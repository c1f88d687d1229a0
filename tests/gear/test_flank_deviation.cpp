#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "contact/load_path.h"
#include "gear/flank_deviation.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "studies/harris_map.h"

using namespace whine;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

Relief relief(double micrometres, double start_deg, ReliefShape shape = ReliefShape::linear) {
  Relief r;
  r.amount = micrometres * 1e-6;
  r.start_roll = start_deg * kDegree;
  r.shape = shape;
  return r;
}

FlankModification tip_relief(double micrometres, double start_deg, ReliefShape shape = ReliefShape::linear) {
  FlankModification m;
  m.tip = relief(micrometres, start_deg, shape);
  return m;
}

GearMeshSpec paper_mesh(const FlankModification& driver, const FlankModification& driven) {
  GearMeshSpec mesh = paper_statics(64).mesh;
  mesh.modification = {driver, driven};
  return mesh;
}

// Two involutes of the paper's pair and linear tip reliefs, from the closed form of the involute alone, in long double.
struct ClosedForm {
  long double rb, alpha, pitch, tip;
  long double start[2], amount[2];

  // Tangential and normal coordinate of the point at roll angle xi of a gear's flank, about its point `at`, the tangent
  // towards its own tip.
  void point(long double at, long double xi, long double& x, long double& y) const {
    const long double d = xi - at;
    x = rb * (std::cos(d) + xi * std::sin(d)) - rb;
    y = rb * (xi * std::cos(d) - std::sin(d)) - rb * at;
  }
  long double height(long double at, long double x, int g) const {  // with what is taken off
    long double low = at - 0.2L, high = at + 0.2L;
    for (int i = 0; i < 120; ++i) {
      const long double xi = 0.5L * (low + high);
      long double px, py;
      point(at, xi, px, py);
      (px < x ? low : high) = xi;
    }
    long double px, py;
    point(at, 0.5L * (low + high), px, py);
    return py - amount[g] * std::max(0.0L, (low - start[g]) / (tip - start[g]));
  }
  // Least gap of a pair whose nominal point lies `path` beyond the pitch point.
  long double least_gap(long double path) const {
    const long double t = std::tan(alpha), at[2] = {t + path / rb, t - path / rb};
    const auto gap = [&](long double x) { return -height(at[0], x, 0) - height(at[1], -x, 1); };
    // Between the tips: x of each flank's end.
    long double end[2], y;
    for (int g = 0; g < kSides; ++g) point(at[g], tip, end[g], y);
    long double low = std::max(-end[1], -5e-4L), high = std::min(end[0], 5e-4L);
    for (int i = 0; i < 160; ++i) {
      const long double a = low + (high - low) / 3, b = high - (high - low) / 3;
      if (gap(a) <= gap(b))
        high = b;
      else
        low = a;
    }
    return gap(0.5L * (low + high));
  }
};

ClosedForm closed_form(const GearPair& pair, const FlankModification& driver,
                       const FlankModification& driven) {
  ClosedForm c{};
  c.rb = pair.gear(0).base_radius();
  c.alpha = pair.working_pressure_angle();
  c.pitch = pair.base_pitch();
  c.tip = pair.gear(0).tip_roll_angle();
  const FlankModification* m[2] = {&driver, &driven};
  for (int g = 0; g < kSides; ++g) {
    c.start[g] = m[g]->tip.start_roll;
    c.amount[g] = m[g]->tip.amount;
  }
  return c;
}

}  // namespace

TEST_CASE("flank deviations: closed forms of each part, starts said in three ways, slopes by differences") {
  const ToothGeometry gear(paper_gear());
  const double form = gear.form_roll_angle(), tip = gear.tip_roll_angle(), rb = gear.base_radius();
  const double start = 22.2 * kDegree;
  const FlankDeviation linear(gear, tip_relief(10, 22.2)),
      parabolic(gear, tip_relief(10, 22.2, ReliefShape::parabolic));
  for (int i = 0; i <= 40; ++i) {
    const double roll = form + (tip - form) * i / 40, t = std::max(0.0, (roll - start) / (tip - start));
    CHECK(std::abs(linear.at(roll, 3) - 10e-6 * t) < 1e-20);
    CHECK(std::abs(parabolic.at(roll, -7) - 10e-6 * t * t) < 1e-20);
  }
  CHECK(linear.largest() == relative(10e-6, 1e-14));
  CHECK(linear.least() == 0);
  CHECK(linear.steepest() == relative(10e-6 / ((tip - start) * rb * start), 0.01));

  FlankModification by_radius = tip_relief(10, 0), by_length = by_radius;
  by_radius.tip.start_radius = rb * std::hypot(1, start);
  by_length.tip.length = rb * (tip - start);
  for (const FlankModification& m : {by_radius, by_length})
    for (const double roll : {form, start, 0.5 * (start + tip), tip})
      CHECK(std::abs(FlankDeviation(gear, m).at(roll, 0) - linear.at(roll, 0)) < 1e-19);

  FlankModification all = tip_relief(8, 23, ReliefShape::parabolic);
  all.root = relief(5, 17);
  all.crowning = 3e-6;
  all.slope = -2e-6;
  all.points = {
      {{15 * kDegree, 1e-6}}, {{18 * kDegree, 0.5e-6}}, {{21 * kDegree, 0}}, {{27 * kDegree, 4e-6}}};
  const FlankDeviation whole(gear, all);
  CHECK(whole.at(form, 0) == relative(5e-6 + 3e-6 + 0 + 1e-6, 1e-12));
  CHECK(whole.at(tip, 0) == relative(8e-6 + 3e-6 - 2e-6 + 4e-6, 1e-12));
  for (int i = 0; i <= 200; ++i) {
    const double roll = form - 0.01 + (tip - form + 0.02) * i / 200, h = 1e-7;
    const double kinks[] = {form, tip, 17 * kDegree, 15 * kDegree, 27 * kDegree};
    if (std::any_of(std::begin(kinks), std::end(kinks), [&](double k) { return std::abs(k - roll) < 2 * h; }))
      continue;
    const double slope = (whole.at(roll + h, 0) - whole.at(roll - h, 0)) / (2 * h);
    CHECK(std::abs(whole.value_and_slope(roll, 0)[1] - slope) < 1e-9);
  }
  CHECK(FlankDeviation().none());
  CHECK(FlankDeviation(gear, tip_relief(0, 22.2)).none());
  CHECK(!linear.none());
}

TEST_CASE(
    "monotone cubic: through its points, monotone where they are, one slope from either side, a parabola's values") {
  const std::vector<std::array<double, 2>> points{{{0, 0}}, {{1, 0}},   {{1.5, 3}},
                                                  {{2, 8}}, {{4, 8.1}}, {{5, 2}}};
  const MonotoneCubic curve(points);
  for (const auto& [x, y] : points) {
    CHECK(std::abs(curve.at(x)[0] - y) <= 1e-14 * std::abs(y));
    if (x == points.front()[0] || x == points.back()[0]) continue;
    CHECK(std::abs(curve.at(std::nextafter(x, -1))[1] - curve.at(std::nextafter(x, 9))[1]) <= 1e-9);
  }
  double before = curve.at(0)[0];
  for (int i = 1; i <= 500; ++i) {
    const double x = 0.01 * i, here = curve.at(x)[0];
    CHECK((x <= 4 ? here >= before - 1e-14 : here <= before + 1e-14));
    before = here;
  }
  CHECK(curve.at(-1)[0] == 0);
  CHECK(curve.at(6)[0] == 2);
  // Third order: halving the spacing of a smooth monotone curve divides the error by 4 at least.
  const auto error = [](int n) {
    std::vector<std::array<double, 2>> p;
    for (int i = 0; i <= n; ++i) p.push_back({1.0 * i / n, std::exp(1.0 * i / n)});
    const MonotoneCubic c(p);
    double worst = 0;
    for (int i = 0; i <= 1000; ++i) worst = std::max(worst, std::abs(c.at(i / 1e3)[0] - std::exp(i / 1e3)));
    return worst;
  };
  CHECK(error(20) < error(10) / 4);
  CHECK(error(80) < 1e-5);
}

TEST_CASE("flank deviations reject a relief that starts off the flank or is longer, and points beyond it") {
  const ToothGeometry gear(paper_gear());
  const auto message = [&](const FlankModification& m) {
    return message_of_input([&] { FlankDeviation(gear, m); });
  };
  CHECK(names(message(tip_relief(10, 28)), {"tip_relief_start_deg", 28}));
  CHECK(names(message(tip_relief(10, 5)), {"relief", "start"}));
  FlankModification m = tip_relief(10, 0);
  m.tip.length = 30e-3;
  CHECK(names(message(m), {"tip_relief_length_mm", 30}));
  m.tip.length = 0;
  m.tip.start_radius = 80e-3;
  CHECK(names(message(m), {"tip_relief_start_radius_mm", 80}));
  m = {};
  m.root = relief(5, 30);
  CHECK(names(message(m), {"root_relief_start_deg", 30}));
  m = tip_relief(1000, 20);
  m.slope = 900e-6;
  CHECK(names(message(m), {"take", "less"}));
  m = {};
  m.points = {{{20 * kDegree, 0}}, {{29 * kDegree, 1e-6}}};
  CHECK(names(message(m), {29, "involute"}));
  m.points = {{{20 * kDegree, 0}}, {{20 * kDegree, 1e-6}}};
  CHECK(names(message(m), {"order"}));
}

TEST_CASE(
    "unloaded transmission error of relieved pairs is the envelope of the pairs' least gaps, from closed forms") {
  struct Case {
    FlankModification driver, driven;
  };
  for (const Case& c :
       {Case{tip_relief(10, 20.9), tip_relief(10, 20.9)}, Case{tip_relief(10, 20), tip_relief(4, 18)},
        Case{tip_relief(20, 22), tip_relief(10, 18)}}) {
    const GearMeshModel model(paper_body(), paper_body(), paper_mesh(c.driver, c.driven));
    const GearPair& pair = model.kinematics;
    const ClosedForm exact = closed_form(pair, c.driver, c.driven);
    double worst = 0, largest = 0;
    for (int i = 0; i < 40; ++i) {
      const double phase = (i + 0.3) / 40;
      long double least = 1;
      for (int n = -2; n <= 2; ++n) {
        const double path = (phase + n) * pair.base_pitch();
        if (path < pair.path_start() || path > pair.path_end()) continue;
        least = std::min(least, exact.least_gap(path));
      }
      const double error = unloaded_transmission_error(model, phase);
      worst = std::max(worst, std::abs(error - static_cast<double>(least)));
      largest = std::max(largest, error);
    }
    MESSAGE("largest unloaded error ", largest * 1e6, " um, off by ", worst, " m");
    CHECK(worst < 1e-12);
    CHECK(largest > 1e-6);
  }
}

TEST_CASE(
    "flanks that begin near the base circle: their points are found on them, and reliefs have bounded gaps") {
  // 16 and 24 teeth: the pinion's involute begins 0.046 rad from its base circle, where the roll angle grows with the root of the length.
  GearDesign pinion = paper_gear(16, 10e-3), wheel = paper_gear(24, 15e-3);
  for (GearDesign* gear : {&pinion, &wheel}) {
    gear->module = 4.5e-3;
    gear->face_width = 14e-3;
    gear->rack_tip_radius = 0.38;
  }
  pinion.profile_shift = 0.1817;
  pinion.addendum = 0.98052;
  wheel.profile_shift = 0.1715;
  wheel.addendum = 0.97961;
  FlankModification relieved = tip_relief(20, 0);
  relieved.tip.start_roll = 0;
  relieved.tip.length = 3e-3;
  for (const bool turned : {false, true}) {
    const GearDesign &first = turned ? wheel : pinion, &second = turned ? pinion : wheel;
    const GearPair pair(first, second, 91.5e-3);
    const FlankDeviation driver(pair.gear(0), relieved), driven(pair.gear(1), relieved);
    const PairDeviation flanks{{&driver, &driven}, {}};
    int corners = 0;
    double worst = 0;
    for (double phase = -1.1; phase < 1.1; phase += 0.001) {
      const double path = phase * pair.base_pitch();
      if (pair.nominal_roll(0, path) <= 0 || pair.nominal_roll(1, path) <= 0) continue;
      const PairContact contact = pair.contact(phase);
      if (!contact.on_flank || !(contact.x_max > contact.x_min)) continue;
      corners += contact.corner;
      for (int i = 0; i <= 20; ++i) {
        const FlankGap place = pair.gap_at(contact, contact.x_min + i * (contact.x_max - contact.x_min) / 20);
        for (int g = 0; g < kSides; ++g) {
          const double roll = place.roll[static_cast<size_t>(g)];
          worst =
              std::max({worst, pair.gear(g).form_roll_angle() - roll, roll - pair.gear(g).tip_roll_angle()});
        }
      }
      const double x = pair.nearest(contact, flanks), gap = pair.gap_at(contact, x, flanks);
      const bool bounded = gap > contact.gap - 1e-12 && gap < contact.gap + 41e-6;
      if (!bounded) CHECK_MESSAGE(bounded, phase, ": ", gap, " for ", contact.gap);
    }
    CHECK(corners > 100);
    CHECK(worst < 1e-9);
  }
}

TEST_CASE("statics of a relieved pair under a vanishing load have its unloaded transmission error") {
  StaticParameters settings = paper_statics(24);
  struct Case {
    FlankModification driver, driven;
    ContactModel contact;
  };
  // Relief that starts low on one gear: there a tip edge off the line of action touches first.
  for (const Case& c : {Case{tip_relief(10, 20.9), tip_relief(10, 20.9), ContactModel::strips},
                        Case{tip_relief(10, 20.9), tip_relief(10, 20.9), ContactModel::line},
                        Case{tip_relief(20, 16), {}, ContactModel::strips}}) {
    settings.mesh = paper_mesh(c.driver, c.driven);
    settings.fidelity.contact = c.contact;
    const double parabola =
        c.contact == ContactModel::line ? 6e-11 : 0;  // m: error of what lines take for the gap
    double before = 0;
    for (const double torque : {1.0, 1e-2, 1e-3}) {
      const StaticResult s = static_transmission(paper_body(), paper_body(), settings, torque);
      const Eigen::VectorXd off = s.transmission_error - s.unloaded_error;
      CHECK(off.minCoeff() > -parabola);
      // The deflection goes with the load, but for Hertz's logarithm.
      if (before > 0) CHECK(off.maxCoeff() < (torque < 1e-2 ? 0.12 : 0.013) * before + parabola);
      before = off.maxCoeff();
    }
    CHECK(before < 1.5e-10 + parabola);
  }
}

TEST_CASE("a relief split over both flanks is the same relief on one flank, at the same contact points") {
  // The driver's tip touches where the driven flank is at its foot: reliefs that mirror each other about the pitch point.
  const ToothGeometry gear(paper_gear());
  const double pitch = std::tan(20 * kDegree), tip = gear.tip_roll_angle();
  FlankModification one, half_driver, half_driven;
  for (int i = 0; i <= 20; ++i) {
    const double roll = pitch + (tip - pitch) * i / 20, removed = 12e-6 * std::pow(i / 20.0, 1.5);
    one.points.push_back({roll, removed});
    half_driver.points.push_back({roll, 0.5 * removed});
  }
  for (int i = 20; i >= 0; --i)
    half_driven.points.push_back({2 * pitch - half_driver.points[i][0], half_driver.points[i][1]});
  const GearMeshModel whole(paper_body(), paper_body(), paper_mesh(one, {})),
      halves(paper_body(), paper_body(), paper_mesh(half_driver, half_driven));
  for (int i = 0; i <= 60; ++i) {
    const double phase = -0.8 + 1.6 * i / 60;
    const PairContact contact = whole.kinematics.contact(phase);
    const double gap = whole.kinematics.gap_at(contact, 0, whole.flanks());
    CHECK(std::abs(gap - halves.kinematics.gap_at(contact, 0, halves.flanks())) < 1e-12);
    CHECK((phase > 0.05 ? gap > 1e-8 : true));
  }
}

TEST_CASE("modifications of nothing leave every number as it is") {
  StaticParameters settings = paper_statics(16);
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    settings.fidelity.contact = contact;
    settings.mesh.modification = {};
    const StaticResult plain = static_transmission(paper_body(), paper_body(), settings, 150);
    FlankModification nothing = tip_relief(0, 22);
    nothing.points = {{{20 * kDegree, 0}}, {{25 * kDegree, 0}}};
    settings.mesh.modification = {nothing, nothing};
    const StaticResult same = static_transmission(paper_body(), paper_body(), settings, 150);
    CHECK(plain.transmission_error == same.transmission_error);
    CHECK(plain.stiffness_secant == same.stiffness_secant);
    CHECK(plain.stiffness_tangent == same.stiffness_tangent);
    CHECK(plain.tooth_load == same.tooth_load);
    CHECK(plain.unloaded_error.isZero(0));
  }
}

TEST_CASE("contact lines of relieved pairs against fine strips: 0.15 % of the mean transmission error") {
  for (const FlankModification& both :
       {tip_relief(10, 20.9), tip_relief(10, 23.6), tip_relief(10, 22.2, ReliefShape::parabolic)}) {
    StaticParameters settings = paper_statics(64);
    settings.mesh = paper_mesh(both, both);
    for (const double torque : {50.0, 150.0, 300.0}) {
      settings.fidelity.contact = ContactModel::line;
      settings.contact.strips = 8;
      const StaticResult line = static_transmission(paper_body(), paper_body(), settings, torque);
      settings.fidelity.contact = ContactModel::strips;
      settings.contact.strips = 24;
      const StaticResult strips = static_transmission(paper_body(), paper_body(), settings, torque);
      const Eigen::VectorXd off = line.transmission_error - strips.transmission_error;
      const double range = strips.transmission_error.maxCoeff() - strips.transmission_error.minCoeff();
      MESSAGE(torque, " N m: lines off by ", off.cwiseAbs().maxCoeff() * 1e9, " nm at most, ",
              std::sqrt(off.squaredNorm() / off.size()) * 1e9, " RMS of ",
              strips.transmission_error.mean() * 1e6, " um, peak to peak ", range * 1e6, " um");
      CHECK(off.cwiseAbs().maxCoeff() < 1.5e-3 * strips.transmission_error.mean());
    }
  }
}

TEST_CASE("a contact followed through all loads has the forces and approaches of one load at a time") {
  const GearMeshModel model(paper_body(), paper_body(), paper_mesh(tip_relief(6, 21), {}));
  const double rb = model.kinematics.gear(0).base_radius();
  const std::array tables{compliance_tables(model.gear[0], 1e-3), compliance_tables(model.gear[1], 1e-3)};
  const Eigen::VectorXd load = Eigen::VectorXd::LinSpaced(17, 10, 300) / rb;
  const CandidateZone range =
      candidate_zone(model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(), 8, load[0],
                     1.1 * load[16], 40e-6, model.flanks());
  ComplementaritySolver solver;
  LoadPath path;
  Eigen::VectorXd x(load.size());
  for (const double phase : {0.0, 0.12, 0.3, 0.5, 0.88}) {
    const MeshPosition position = make_position(model, phase, range);
    const Eigen::MatrixXd a = contact_compliance(model, position, tables, 1e-3);
    const Eigen::VectorXd approach = position.strip_lever[0] / rb;
    path.follow(a, position.gap, approach, load, x);
    CHECK(path.pivots() < 2 * position.strips());
    for (int i = 0; i < load.size(); ++i) {
      ActiveSet active;
      const Equilibrium e = equilibrium(a, position.gap, approach, load[i], 0, active, solver);
      CHECK(x[i] == relative(e.x, 1e-11));
      if (i + 1 == load.size()) CHECK((path.force() - e.p).cwiseAbs().maxCoeff() < 1e-8 * load[i]);
    }
  }
  // A minus sign on the diagonal: no solution under any load.
  Eigen::MatrixXd bad = -Eigen::MatrixXd::Identity(2, 2);
  CHECK_THROWS_AS(path.follow(bad, Eigen::VectorXd::Zero(2), Eigen::VectorXd::Ones(2), load, x), Error);
}

TEST_CASE(
    "Harris map: within 0.5 % of finer strips and positions; relief that makes up for the deflection leaves a third; the cusp at the design torque") {
  StaticParameters settings = paper_statics(128);
  HarrisPlan plan;
  plan.torque = {20, 60, 90, 150, 225, 300};
  plan.design_torque = 150;
  plan.length = {single_pair_relief_length(paper_body(), paper_body(), settings.mesh)};

  // What a relief has to make up for: when the driver's tooth is at its highest point of single-pair contact and carries all,
  // the next pair is where it comes into contact, unloaded, and overlaps by this.
  const GearMeshModel model(paper_body(), paper_body(), settings.mesh);
  const GearPair& pair = model.kinematics;
  const double rb = pair.gear(0).base_radius(), load = 150 / rb;
  const std::array tables{compliance_tables(model.gear[0], 1e-3), compliance_tables(model.gear[1], 1e-3)};
  const double phase = (pair.path_start() + pair.base_pitch()) / pair.base_pitch();
  MeshPosition position = make_position(
      model, phase,
      candidate_zone(pair, model.gear[0].half_plane(), model.gear[1].half_plane(), 8, load, 2 * load, 15e-6));
  const Eigen::MatrixXd a = contact_compliance(model, position, tables, 1e-3);
  const Eigen::VectorXd approach = position.strip_lever[0] / rb;
  Eigen::VectorXd alone = position.gap;
  for (size_t j = 0; j < position.pairs.size(); ++j)
    if (position.pairs[j].pair != 0)
      alone.segment(position.first_strip[j], position.pairs[j].size()).array() += 1e-3;
  ComplementaritySolver solver;
  ActiveSet active;
  const Equilibrium e = equilibrium(a, alone, approach, load, 0, active, solver);
  const Eigen::VectorXd overlap = e.x * approach - a * e.p - position.gap;
  double deflection = 0;
  for (size_t j = 0; j < position.pairs.size(); ++j)
    if (position.pairs[j].pair == -1)
      deflection = overlap.segment(position.first_strip[j], position.pairs[j].size()).maxCoeff();
  MESSAGE("overlap of the next pair ", deflection * 1e6, " um");
  CHECK(deflection > 2e-6);

  plan.relief = {0, 0.5 * deflection, deflection, 1.5 * deflection};
  HarrisMapResult map = harris_map(paper_body(), paper_body(), settings, plan, no_report);
  const auto at = [&](int t, int r) { return map.peak_to_peak[0](t, r); };
  MESSAGE("at 150 N m ", at(3, 0) * 1e6, " um without relief, ", at(3, 2) * 1e6, " with; optimum ",
          map.optimum_relief[0] * 1e6, " um leave ", map.optimum_peak_to_peak[0] * 1e6);
  CHECK(at(3, 2) < at(3, 0) / 3);
  for (int t = 0; t < 3; ++t) CHECK(at(t, 2) > 1.2 * at(t + 1, 2));
  for (int t = 3; t < 5; ++t) CHECK(at(t + 1, 2) > 1.2 * at(t, 2));
  for (int t = 0; t < 3; ++t) CHECK(map.cusp(0, t) > 1.2 * map.cusp(0, t + 1));
  for (int t = 3; t < 5; ++t) CHECK(map.cusp(0, t + 1) > 1.2 * map.cusp(0, t));
  CHECK(map.cusp(0, 3) == relative(map.optimum_peak_to_peak[0], 5e-3));
  CHECK(map.optimum_peak_to_peak[0] <= map.peak_to_peak[0].row(3).minCoeff());
  CHECK((map.unrelieved - map.peak_to_peak[0].col(0)).norm() == 0);

  check(map, paper_body(), paper_body(), plan.positions, 6);
  CHECK(map.checked == 7);
  MESSAGE("off by ", map.largest_error, " of finer solutions");
  CHECK(map.largest_error > 0);
  CHECK(map.largest_error < 5e-3);
}

TEST_CASE("Harris map rejects plans out of order, reliefs that do not fit, a design torque outside") {
  HarrisPlan good;
  good.torque = {50, 100};
  good.relief = {0, 1e-6};
  good.length = {2e-3};
  good.design_torque = 60;
  good.positions = 8;
  const auto rejected = [&](const auto& change) {
    HarrisPlan plan = good;
    change(plan);
    return message_of_input(
        [&] { harris_map(paper_body(), paper_body(), paper_statics(8), plan, no_report); });
  };
  CHECK(rejected([](HarrisPlan&) {}).empty());
  CHECK(names(rejected([](HarrisPlan& p) { p.torque = {100, 50}; }), {50, 100}));
  CHECK(names(rejected([](HarrisPlan& p) { p.relief = {-1e-6}; }), {0, "least"}));
  CHECK(names(rejected([](HarrisPlan& p) { p.length = {}; }), {"length"}));
  CHECK(names(rejected([](HarrisPlan& p) { p.length = {50e-3}; }), {"involute", "longer"}));
  CHECK(names(rejected([](HarrisPlan& p) { p.design_torque = 200; }), {200, "outside"}));
}
