// Folds over a second parameter: of the lumped pair against its exact folds and its own maps, of a kinked map in closed form.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "lumped/period_map.h"
#include "lumped/stiffness.h"
#include "lumped_wave.h"
#include "orbits/branch.h"
#include "orbits/fold_curve.h"
#include "orbits/monodromy_matrix.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "studies/branch.h"
#include "studies/fold_curves.h"

using namespace whine;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// The lumped pair of a damping ratio, alive as long as its map.
class LumpedPair : public PeriodMap {
 public:
  explicit LumpedPair(double ratio) : oscillator_(paper_wave(ratio), kPaperForce, 64), map_(oscillator_) {}
  int size() const override { return map_.size(); }
  void set_parameter(double value) override { map_.set_parameter(value); }
  double parameter() const override { return map_.parameter(); }
  VectorXd apply(const VectorXd& y) override { return map_.apply(y); }
  MatrixXd tangent() override { return map_.tangent(); }
  std::vector<ContactEvent> events() const override { return map_.events(); }
  VectorXd observable() const override { return map_.observable(); }
  VectorXd rest() const { return map_.flat(oscillator_.rest()); }

 private:
  LumpedOscillator oscillator_;
  LumpedPeriodMap map_;
};

std::vector<SpecialPoint> folds_at(double ratio) {
  LumpedPair pair(ratio);
  pair.set_parameter(3400);
  VectorXd y = pair.rest();
  for (int i = 0; i < 100; ++i) y = pair.apply(y);
  BranchSettings settings;
  settings.low = 2000;
  settings.high = 3500;
  settings.scale = 2900;
  const OrbitSearch search = newton_orbit(pair, y);
  REQUIRE(search.found());
  std::vector<SpecialPoint> folds;
  for (const SpecialPoint& p : follow_branch(pair, search.orbit, -1, settings).special)
    if (p.kind == Special::fold) folds.push_back(p);
  return folds;
}

// y -> 0.5 y below 0, 1.5 y above, and p - 1 + q: fixed points for p < 1 - q, which turn at the kink.
class Kinked : public PeriodMap {
 public:
  explicit Kinked(double q) : q_(q) {}
  int size() const override { return 1; }
  void set_parameter(double value) override { p_ = value; }
  double parameter() const override { return p_; }
  VectorXd apply(const VectorXd& y) override {
    slope_ = y[0] < 0 ? 0.5 : 1.5;
    return VectorXd::Constant(1, slope_ * y[0] + p_ - 1 + q_);
  }
  MatrixXd tangent() override { return MatrixXd::Constant(1, 1, slope_); }
  std::vector<ContactEvent> events() const override { return {}; }
  VectorXd observable() const override { return VectorXd::Zero(1); }

 private:
  double q_, p_ = 0, slope_ = 0;
};

}  // namespace

TEST_CASE("fold curves: of the lumped pair over damping, through its exact folds, to the cusp") {
  const std::vector<SpecialPoint> begin = folds_at(0.07);
  REQUIRE(begin.size() == 2);
  Fold folds[2];
  for (int side = 0; side < 2; ++side) {
    folds[side].value = 0.07;
    folds[side].parameter = begin[side].parameter;
    folds[side].start = begin[side].start;
  }
  FoldCurveSettings settings;
  settings.scale = 2900;
  settings.tolerance = 1e-11;
  const MapFamily family = [](double ratio, double) { return std::make_unique<LumpedPair>(ratio); };
  for (Fold& fold : folds) {
    std::string failure;
    const auto found = find_turn(*family(0.07, 0), fold, settings, failure);
    INFO(failure);
    REQUIRE(found);
    fold = *found;
  }
  CHECK(std::min(folds[0].parameter, folds[1].parameter) == relative(2464.654182, 1e-9));
  CHECK(std::max(folds[0].parameter, folds[1].parameter) == relative(2638.199272, 1e-9));
  const FoldPair pair =
      follow_folds(family, folds[0], folds[1], {0.072, 0.074, 0.076, 0.078, 0.08, 0.09}, settings);
  INFO(pair.end);
  REQUIRE(pair.cusp);
  int at_eight = -1;
  for (size_t i = 0; i < pair.low.size(); ++i) {
    if (std::abs(pair.low[i].value - 0.08) < 1e-12) at_eight = static_cast<int>(i);
    // Multipliers of both folds pass 1, and between them there is room.
    for (const Fold* fold : {&pair.low[i], &pair.high[i]}) {
      CHECK(fold->before == relative(1, 1e-4));
      CHECK(fold->after == relative(1, 1e-4));
    }
    CHECK(pair.low[i].parameter < pair.high[i].parameter);
  }
  REQUIRE(at_eight > 0);
  CHECK(pair.low[at_eight].parameter == relative(2662.046924, 1e-9));
  CHECK(pair.high[at_eight].parameter == relative(2679.466389, 1e-9));
  // Independent of the curves: branches on either side of the cusp.
  MESSAGE("cusp at a damping ratio of " << pair.cusp_value << " and " << pair.cusp_parameter << " Hz");
  CHECK(folds_at(pair.cusp_value * 0.999).size() == 2);
  CHECK(folds_at(pair.cusp_value * 1.001).empty());
}

namespace {

// The two folds at a damping ratio of 0.07.
std::array<Fold, 2> turns_at_7_per_cent(const FoldCurveSettings& settings) {
  const auto begin = folds_at(0.07);
  REQUIRE(begin.size() == 2);
  std::array<Fold, 2> folds;
  for (size_t side = 0; side < 2; ++side) {
    folds[side].value = 0.07;
    folds[side].parameter = begin[side].parameter;
    folds[side].start = begin[side].start;
    std::string failure;
    LumpedPair pair(0.07);
    const auto found = find_turn(pair, folds[side], settings, failure);
    REQUIRE(found);
    folds[side] = *found;
  }
  return folds;
}

}  // namespace

TEST_CASE("fold curves: folds beyond the followed parameters are not reported") {
  FoldCurveSettings settings;
  settings.scale = 2900;
  settings.high = 2660;
  const std::array<Fold, 2> folds = turns_at_7_per_cent(settings);
  const MapFamily family = [](double ratio, double) { return std::make_unique<LumpedPair>(ratio); };
  // The upper one comes to 2660 Hz between 0.07 and 0.08, where it stands at 2679 Hz.
  const FoldPair pair = follow_folds(family, folds[0], folds[1], {0.072, 0.08}, settings);
  INFO(pair.end);
  CHECK(!pair.cusp);
  CHECK(pair.low.size() == pair.high.size());
  CHECK(pair.high.size() > 2);
  for (const Fold& fold : pair.high) CHECK(fold.parameter <= 2660);
  CHECK(pair.high.back().parameter > 2655);
  CHECK(contains(pair.end, "lies outside of 0 to 2660"));
  // One that already lies beyond is none.
  settings.high = 2600;
  std::string failure;
  LumpedPair there(0.07);
  const bool upper = folds[1].parameter > folds[0].parameter;
  CHECK(!find_turn(there, folds[upper ? 1 : 0], settings, failure));
  CHECK(contains(failure, "lies outside of 0 to 2600"));
}

TEST_CASE("fold curves: a fold belongs to the map of its own parameter, not to that of the guess") {
  // Below 2550 Hz a pair with other damping, as the elastic pair has other steps per period at other speeds.
  const MapFamily family = [](double ratio, double at) {
    return std::make_unique<LumpedPair>(at < 2550 ? ratio - 0.0005 : ratio);
  };
  FoldCurveSettings settings;
  settings.scale = 2900;
  settings.tolerance = 1e-11;
  const std::array<Fold, 2> folds = turns_at_7_per_cent(settings);
  const auto low_at = [&](double value) {
    const FoldPair pair = follow_folds(family, folds[0], folds[1], {value}, settings);
    INFO(pair.end);
    REQUIRE(!pair.low.empty());
    CHECK(pair.low.back().value == relative(value, 1e-12));
    return pair.low.back().parameter;
  };
  const double of_guess = low_at(0.076);
  settings.one_map = [](double one, double other) { return (one < 2550) == (other < 2550); };
  const double own = low_at(0.076);
  CHECK(of_guess < own - 1);
  CHECK(own == relative(std::min(folds_at(0.076)[0].parameter, folds_at(0.076)[1].parameter), 1e-9));
}

TEST_CASE("fold curves: at a kink, where no multiplier is 1") {
  FoldCurveSettings settings;
  settings.tolerance = 1e-10;
  std::string failure;
  Fold fold;
  fold.start = VectorXd::Constant(1, -0.05);
  fold.parameter = 0.95;
  for (const double q : {0.0, 0.1, 0.2, -0.3}) {
    Kinked map(q);
    fold.value = q;
    const auto found = find_turn(map, fold, settings, failure);
    INFO(q << ": " << failure);
    REQUIRE(found);
    CHECK(found->parameter == relative(1 - q, 1e-9));
    CHECK(found->before == relative(0.5, 1e-12));
    CHECK(found->after == relative(1.5, 1e-12));
    CHECK(found->bend < 0);
    fold = *found;
    fold.parameter -= 0.02;
  }
}

TEST_CASE("slow tangent: the largest multipliers of a long state are those of its tangent") {
  // A tangent without symmetry, of known eigenvalues: a shear of a diagonal with one pair that turns.
  constexpr int kSize = 60;
  MatrixXd diagonal = MatrixXd::Zero(kSize, kSize), shear = MatrixXd::Identity(kSize, kSize);
  for (int i = 0; i < kSize; ++i) {
    diagonal(i, i) = (i % 3 == 1 ? -1 : 1) * 1.2 * std::pow(0.8, i);
    for (int j = i + 1; j < kSize; ++j) shear(i, j) = 0.3 * std::sin(1.7 * i + 0.4 * j) / (1 + j - i);
  }
  diagonal.block(0, 0, 2, 2) << 0.9, -0.8, 0.8, 0.9;
  const MatrixXd tangent = shear * diagonal * shear.inverse();
  int products = 0;
  const auto times = [&](const MatrixXd& directions) {
    ++products;
    return MatrixXd(tangent * directions);
  };
  const MonodromyMatrix first = slow_tangent(kSize, {}, {}, 1e-9, times);
  const Eigen::VectorXcd multipliers = first.multipliers();
  CHECK(std::abs(multipliers[0]) == relative(std::hypot(0.9, 0.8), 1e-8));
  CHECK(multipliers[2].real() == relative(1.2 * 0.64, 1e-3));
  CHECK((first.basis.transpose() * first.basis - MatrixXd::Identity(first.basis.cols(), first.basis.cols()))
            .norm() < 1e-12);
  // As many directions as leave none out above 0.2.
  CHECK(first.basis.cols() >= 9);
  CHECK(first.basis.cols() <= 24);
  const int before = products;
  const MonodromyMatrix again = slow_tangent(kSize, first, {}, 1e-9, times);
  CHECK(products - before <= 2);
}

TEST_CASE(
    "slow tangent: a subspace that ends among multipliers of one modulus grows until it ends behind them") {
  // As of a gear with many double modes: 14 directions that a period keeps, then 8 that turn at one modulus just below the limit.
  constexpr int kSize = 40, kKept = 14, kAlike = 8;
  MatrixXd turns = MatrixXd::Zero(kSize, kSize), shear = MatrixXd::Identity(kSize, kSize);
  for (int i = 0; i < kSize; i += 2) {
    const double modulus = i < kKept ? 0.95 - 0.05 * i : i < kKept + kAlike ? 0.19 : 0.02;
    const double angle = 0.3 + 0.7 * i;
    turns.block(i, i, 2, 2) << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    turns.block(i, i, 2, 2) *= modulus;
    for (int j = i + 2; j < kSize; ++j) {
      shear(i, j) = 0.3 * std::sin(1.7 * i + 0.4 * j) / (1 + j - i);
      shear(i + 1, j) = 0.3 * std::cos(1.3 * i + 0.6 * j) / (1 + j - i);
    }
  }
  const MatrixXd tangent = shear * turns * shear.inverse();
  const auto times = [&](const MatrixXd& directions) { return MatrixXd(tangent * directions); };
  const MonodromyMatrix t = slow_tangent(kSize, {}, {}, 1e-8, times);
  CHECK(t.basis.cols() >= kKept + kAlike);
  const Eigen::VectorXcd multipliers = t.multipliers();
  CHECK(std::abs(multipliers[0]) == relative(0.95, 1e-7));
  CHECK(std::abs(multipliers[kKept - 1]) == relative(0.95 - 0.05 * (kKept - 2), 1e-6));
}

TEST_CASE(
    "slow tangent: where all multipliers have one modulus, as damping by mass gives them, all directions are kept") {
  constexpr int kSize = 120;
  MatrixXd turns = MatrixXd::Zero(kSize, kSize), shear = MatrixXd::Identity(kSize, kSize);
  for (int i = 0; i < kSize; i += 2) {
    const double angle = 0.3 + 0.7 * i;
    turns.block(i, i, 2, 2) << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    for (int j = i + 2; j < kSize; ++j) shear(i, j) = 0.3 * std::sin(1.7 * i + 0.4 * j) / (1 + j - i);
  }
  const MatrixXd tangent = 0.8 * shear * turns * shear.inverse();
  const MonodromyMatrix t = slow_tangent(
      kSize, {}, {}, 1e-8, [&](const MatrixXd& directions) { return MatrixXd(tangent * directions); });
  CHECK(t.whole());
  CHECK((t.matrix() - tangent).norm() < 1e-12 * tangent.norm());
  const Eigen::VectorXcd multipliers = t.multipliers();
  CHECK(std::abs(multipliers[0]) == relative(0.8, 1e-9));
  CHECK(std::abs(multipliers[kSize - 1]) == relative(0.8, 1e-9));
}

// Independent of the curve: the whole branch at each torque, from rest.
TEST_CASE("fold curves: of an elastic pair over torque they are the folds of its branch at each torque") {
  const ReducedBody& body = paper_body();
  StaticParameters at_rest = paper_statics(128);
  at_rest.contact.strips = 8;
  SweepParameters settings = paper_sweep(1700, 2950, 50);
  settings.damping.rayleigh_stiffness = 5.5e-6;
  settings.time.steps_per_period = 128;
  settings.time.min_sample_rate = 0;
  settings.reference_torque = 100;
  FoldCurvesPlan plan;
  plan.quantity = FoldQuantity::torque;
  plan.first = 150;
  plan.values = {140, 150, 165};
  plan.from = 1700;
  plan.to = 2950;
  const FoldCurvesResult a = fold_curves(body, body, at_rest, 150, settings, plan, no_report);
  INFO(a.end);
  const auto torques = static_cast<Eigen::Index>(plan.values.size());
  REQUIRE(a.value.size() >= 2 * torques);
  const double dampers = static_transmission(body, body, at_rest, 100).mean_stiffness;
  for (const double torque : plan.values) {
    const BranchResult branch = pair_branch(body, body, static_transmission(body, body, at_rest, torque),
                                            dampers, settings, no_report);
    REQUIRE(branch.fold_frequency.size() >= 2);
    for (Eigen::Index i = 0; i < a.value.size(); ++i) {
      if (a.value[i] != torque) continue;
      const double nearest = (branch.fold_frequency.array() - a.fold_frequency[i]).abs().minCoeff();
      CAPTURE(torque);
      CAPTURE(a.fold_frequency[i]);
      // Of these 8 strips a zone; they stand elsewhere in the wider zone of the curve, which moves a fold by up to 0.3 Hz.
      CHECK(nearest < 2.5e-4 * a.fold_frequency[i]);
    }
  }
  plan.values = {150, 150};
  CHECK(names(message_of([&] { fold_curves(body, body, at_rest, 150, settings, plan, no_report); }),
              {"values", "torque"}));
}
