// Complementarity: hard matrices with known solutions, an independent solver, recorded strips, memory.
#include "contact/complementarity.h"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "base/dense.h"
#include "base/error.h"
#include "memory.h"
#include "peer/strip_problems.h"
#include "peer/window_problem.h"
#include "refusal.h"
#include "relative.h"
#include "solved_strips.h"

using namespace whine;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

Solved solve(const MatrixXd& a, const VectorXd& e, std::vector<int> start = {}) {
  return solved(a, e, std::move(start), Singular::shift);
}

// max over i of |min(d_i, p_i A_ii)| / max |e|, from scratch
double kkt_residual(const MatrixXd& a, const VectorXd& e, const VectorXd& p) {
  const VectorXd d = a * p + e;
  double worst = 0;
  for (int i = 0; i < e.size(); ++i) worst = std::max(worst, std::abs(std::min(d[i], p[i] * a(i, i))));
  const double scale = e.size() > 0 ? e.cwiseAbs().maxCoeff() : 0;
  return scale > 0 ? worst / scale : worst;
}

MatrixXd hilbert(int n) {
  MatrixXd a(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) a(i, j) = 1.0 / (i + j + 1);
  return a;
}

MatrixXd random_bodies(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const int nodes = ZoneProblem::kPairs * kZoneNodes;
  const MatrixXd root = MatrixXd::NullaryExpr(nodes, nodes, [&] { return normal(random); });
  return 1e-10 * (root * root.transpose() + MatrixXd::Identity(nodes, nodes));
}
ZoneProblem random_zones(std::mt19937& random) {
  const double phase = std::uniform_real_distribution<double>(-0.3, 0.3)(random);
  return {phase, random_bodies(random)};
}

// Projected Gauss-Seidel until a sweep moves no force by more than 1e-13 of the largest; linear convergence,
// nothing in common with pivoting.
VectorXd gauss_seidel(const MatrixXd& a, const VectorXd& e) {
  VectorXd p = VectorXd::Zero(e.size());
  for (int sweep = 0; sweep < 100000; ++sweep) {
    double change = 0;
    for (int i = 0; i < e.size(); ++i) {
      const double next = std::max(0.0, p[i] - (a.col(i).dot(p) + e[i]) / a(i, i));
      change = std::max(change, std::abs(next - p[i]));
      p[i] = next;
    }
    if (change <= 1e-13 * p.maxCoeff()) return p;
  }
  FAIL("Gauss-Seidel did not converge");
  return p;
}

// Every active set, one after the other; the only one whose forces and gaps have no wrong sign.
VectorXd enumerate(const MatrixXd& a, const VectorXd& e) {
  const int n = static_cast<int>(e.size());
  VectorXd best = VectorXd::Zero(n);
  double least = 1e300;
  for (unsigned set = 0; set < 1u << n; ++set) {
    std::vector<int> f;
    for (int i = 0; i < n; ++i)
      if (set >> i & 1) f.push_back(i);
    VectorXd p = VectorXd::Zero(n);
    if (!f.empty()) p(f) = -lu_solve(a(f, f), e(f));
    if (const double residual = kkt_residual(a, e, p); residual < least) least = residual, best = p;
  }
  return best;
}

struct Problem {
  MatrixXd a;
  VectorXd e;
};
Problem random_problem(std::mt19937& random, int n, double floor) {
  std::normal_distribution<double> normal;
  Problem problem{MatrixXd(n, n), VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    problem.e[i] = normal(random);
    for (int j = 0; j < n; ++j) problem.a(i, j) = normal(random);
  }
  problem.a = (problem.a * problem.a.transpose() / n + floor * MatrixXd::Identity(n, n)).eval();
  return problem;
}

}  // namespace

TEST_CASE("complementarity: Fathi's matrices take n block steps from all strips and no fallback") {
  for (int n : {6, 10, 14, 18, 20}) {
    MatrixXd l = MatrixXd::Identity(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < i; ++j) l(i, j) = 2;
    const Solved nothing = solve(l * l.transpose(), VectorXd::Constant(n, -1));
    CHECK((nothing.p - VectorXd::Unit(n, 0)).norm() < 1e-12);
    CHECK(nothing.certificate.iterations == 1);
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    const Solved s = solve(l * l.transpose(), VectorXd::Constant(n, -1), all);
    CHECK((s.p - VectorXd::Unit(n, 0)).norm() < 1e-12);
    CHECK((s.d - (VectorXd::Ones(n) - VectorXd::Unit(n, 0))).norm() < 1e-11);
    // Least-index pivoting alone takes 8, 65, 457, 5186 and 12536.
    INFO("n = ", n);
    CHECK(s.certificate.iterations == n);
    CHECK(!s.certificate.fallback);
  }
}

TEST_CASE("complementarity: one contact point twice is singular, reported and solved") {
  const MatrixXd a{{1, 2}, {2, 4}};
  const VectorXd e{{-1, -2}};
  for (const std::vector<int>& start : {std::vector<int>{}, {0}, {1}, {0, 1}}) {
    const Solved s = solve(a, e, start);
    CHECK(std::abs(s.p[0] + 2 * s.p[1] - 1) < 1e-12);
    CHECK(s.p.minCoeff() >= 0);
    CHECK(s.d.cwiseAbs().maxCoeff() < 1e-12);
    CHECK(s.certificate.residual < 1e-12);
    CHECK(s.certificate.shifted == (s.active.strips.size() == 2));
  }
  // The shift selects the solution of least norm, (0.2, 0.4), as far as round-off over shift allows: 1e-16 / 1e-13.
  CHECK((solve(a, e, {0, 1}).p - VectorXd{{0.2, 0.4}}).norm() < 1e-2);
  // A kept inverse of a shifted block says so.
  ComplementaritySolver solver(Singular::shift);
  ActiveSet active;
  active.strips = {0, 1};
  VectorXd p(2), d(2);
  solver.solve(a, e, active, p, d);
  CHECK(solver.solve(a, 1.5 * e, active, p, d).shifted);
  CHECK(std::abs(p[0] + 2 * p[1] - 1.5) < 1e-12);
}

TEST_CASE(
    "complementarity: stages reject forces that the problem does not determine, or digits that are lost") {
  const MatrixXd a{{1, 2}, {2, 4}};
  const VectorXd e{{-1, -2}};
  VectorXd p(2), d(2);
  ComplementaritySolver solver;
  // From the set alone, or with the kept inverse of the shifted block.
  for (const bool kept : {false, true}) {
    ActiveSet both;
    both.strips = {0, 1};
    if (kept) ComplementaritySolver(Singular::shift).solve(a, e, both, p, d);
    CHECK(both.known == kept);
    CHECK(names(message_of([&] { solver.solve(a, e, both, p, d); }), {2, "round-off"}));
  }
  // One of them alone carries it as well: the set that block pivoting finds needs no shift.
  ActiveSet one;
  one.strips = {1};
  CHECK(!solver.solve(a, e, one, p, d).shifted);
  CHECK(p[1] == relative(0.5, 1e-14));

  // Two strips that pull against each other carry 1e9 times what closes their gaps: 7 digits of the gap are left.
  const double close = 1e-9 / 3;
  const MatrixXd pull{{1, close - 1}, {close - 1, 1}};
  ActiveSet active;
  CHECK(names(message_of([&] { solver.solve(pull, VectorXd{{-1.0 / 3, -0.7}}, active, p, d); }), {"1e-10"}));
  Certificate certificate;
  certificate.residual = kMostResidual;
  CHECK_NOTHROW(require_residual(certificate));
  certificate.residual = std::nan("");
  CHECK_THROWS_AS(require_residual(certificate), Error);
}

TEST_CASE("complementarity: a number that is none, anywhere, from any set: rejected, or of no account") {
  const StripProblem problem = strip_problem(0.3, 8);
  const int n = static_cast<int>(problem.gap.size());
  const VectorXd e = problem.gap.array() - 3e-6;
  const Solved sound = solve(problem.a, e);
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  const int touching = static_cast<int>((sound.p.array() > 0).count());
  REQUIRE(touching > 2);
  REQUIRE(touching < n);
  int rejected = 0, solved = 0;
  for (const double bad : {std::nan(""), double(INFINITY), -double(INFINITY)})
    for (const std::vector<int>& start : {std::vector<int>{}, {0, n - 1}, all}) {
      for (int i = 0; i < n; ++i) {
        VectorXd f = e;
        f[i] = bad;
        CHECK_THROWS_AS(solve(problem.a, f, start), Error);
        for (int j = 0; j <= i; ++j) {
          MatrixXd a = problem.a;
          a(i, j) = a(j, i) = bad;
          try {
            // Only what no strip that touches reads may be wrong without being found.
            const Solved s = solve(a, e, start);
            CHECK(sound.p[i] + sound.p[j] == 0);
            CHECK((s.p - sound.p).norm() < 1e-10 * sound.p.norm());
            ++solved;
          } catch (const Error& error) {
            CHECK(error.kind() == Failure::numerical);
            ++rejected;
          }
        }
      }
    }
  CHECK(rejected > solved);
  // With a kept inverse, too.
  ComplementaritySolver solver;
  ActiveSet active;
  VectorXd p(n), d(n), f = e;
  solver.solve(problem.a, e, active, p, d);
  MatrixXd a = problem.a;
  a(active.strips[0], active.strips[1]) = a(active.strips[1], active.strips[0]) = std::nan("");
  CHECK_THROWS_AS(solver.solve(a, e, active, p, d), Error);
}

TEST_CASE("complementarity: nothing to carry, and exactly touching") {
  for (int n : {1, 2, 9}) {
    const MatrixXd a = MatrixXd::Identity(n, n) + MatrixXd::Constant(n, n, 0.5);
    const Solved open = solve(a, VectorXd::Constant(n, 1)), touching = solve(a, VectorXd::Zero(n));
    CHECK(open.p.norm() == 0);
    CHECK(open.certificate.degenerate == 0);
    CHECK(open.certificate.least_gap == 1);
    CHECK(touching.p.norm() == 0);
    CHECK(touching.certificate.degenerate == n);
    VectorXd one = VectorXd::Constant(n, 1);
    one[n / 2] = 0;
    CHECK(solve(a, one).p.norm() == 0);
    CHECK(solve(a, one).certificate.degenerate == 1);
  }
  CHECK(solve(MatrixXd(0, 0), VectorXd(0)).certificate.residual == 0);
}

TEST_CASE("complementarity: Hilbert matrices up to condition 1e17 keep their residual") {
  // p = 1 in exact arithmetic; in double only the residual can be asked for. From 12 on Cholesky breaks down.
  for (int n = 1; n <= 16; ++n) {
    const MatrixXd a = hilbert(n);
    const VectorXd e = -a * VectorXd::Ones(n);
    for (int start = 0; start < 3; ++start) {
      std::vector<int> guess;
      for (int i = 0; i < n; ++i)
        if (start == 1 || (start == 2 && i % 2)) guess.push_back(i);
      const Solved s = solve(a, e, guess);
      INFO("n = ", n, ", start ", start);
      CHECK(kkt_residual(a, e, s.p) <= 1e-12);
      CHECK(s.certificate.residual <= 1e-12);
      CHECK(s.p.allFinite());
      if (n == 8) CHECK(!s.certificate.shifted);
    }
  }
  std::vector<int> all(14);
  std::iota(all.begin(), all.end(), 0);
  CHECK(solve(hilbert(14), -hilbert(14) * VectorXd::Ones(14), all).certificate.shifted);
}

TEST_CASE("complementarity: two strips in place of one carry its force, in any order") {
  std::mt19937 random(11);
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 2 + trial % 20;
    const Problem whole = random_problem(random, n, 0.2);
    const VectorXd p = solve(whole.a, whole.e).p;
    // Strip 0 cut into equal halves: each sees, and is seen by, the others as the whole.
    std::vector<int> of(n + 1);
    std::iota(of.begin(), of.end(), 0);
    of[n] = 0;
    std::shuffle(of.begin(), of.end(), random);
    const MatrixXd a = whole.a(of, of);
    const VectorXd e = whole.e(of);
    const Solved s = solve(a, e);
    VectorXd sum = VectorXd::Zero(n);
    for (int i = 0; i <= n; ++i) sum[of[i]] += s.p[i];
    CHECK((sum - p).cwiseAbs().maxCoeff() < 1e-10 * (1 + p.maxCoeff()));
    // A permutation alone, also with the neighbour's active set as guess.
    std::vector<int> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    const MatrixXd b = whole.a(order, order);
    const VectorXd f = whole.e(order);
    CHECK((solve(b, f, {0, n - 1}).p - p(order)).cwiseAbs().maxCoeff() < 1e-10 * (1 + p.maxCoeff()));
  }
}

TEST_CASE("complementarity: 10 000 random problems against projected Gauss-Seidel and enumeration") {
  std::mt19937 random(3);
  ComplementaritySolver shared;  // of problems of all sizes
  double worst = 0, worst_residual = 0;
  int fallbacks = 0;
  for (int trial = 0; trial < 10000; ++trial) {
    const int n = 1 + trial % 24;
    const Problem problem = random_problem(random, n, 0.5);
    VectorXd p(n), d(n);
    ActiveSet active;
    const Certificate c = shared.solve(problem.a, problem.e, active, p, d);
    const VectorXd other = n <= 4 ? enumerate(problem.a, problem.e) : gauss_seidel(problem.a, problem.e);
    worst = std::max(worst, (p - other).cwiseAbs().maxCoeff() / (1 + other.maxCoeff()));
    worst_residual = std::max({worst_residual, kkt_residual(problem.a, problem.e, p), c.residual});
    fallbacks += c.fallback;
  }
  CHECK(worst < 1e-11);  // Gauss-Seidel stops at steps of 1e-13; its rate here is 0.9 at worst
  CHECK(worst_residual < 1e-12);
  CHECK(fallbacks == 0);
}

TEST_CASE("complementarity: strips that come and go border the inverse without losing digits") {
  // Rolling strips with a kept set, beside a solve from nothing at every load.
  int factorisations = 0, cold_factorisations = 0;
  double worst = 0, worst_inverse = 0;
  for (double phase : {-0.6, -0.2, 0.3, 0.8}) {
    const StripProblem problem = strip_problem(phase, 24);
    ComplementaritySolver solver;
    ActiveSet active;
    const int n = static_cast<int>(problem.gap.size());
    VectorXd p(n), d(n);
    for (int step = 0; step < 400; ++step) {
      const double approach = 3e-6 * (1 + 0.9 * std::sin(0.03 * step));
      const VectorXd e = problem.gap.array() - approach;
      factorisations += solver.solve(problem.a, e, active, p, d).factorisations;
      const Solved cold = solve(problem.a, e);
      cold_factorisations += cold.certificate.factorisations;
      worst = std::max(worst, (p - cold.p).cwiseAbs().maxCoeff() / cold.p.maxCoeff());
      CHECK(active.strips == cold.active.strips);
      const int k = active.inverse.rows();
      REQUIRE(k == static_cast<int>(active.strips.size()));
      const MatrixXd block = problem.a(active.strips, active.strips);
      worst_inverse = std::max(
          worst_inverse, (active.inverse.block() * block - MatrixXd::Identity(k, k)).cwiseAbs().maxCoeff());
    }
  }
  CHECK(worst < 1e-11);          // condition of the strips, 1e3, and round-off
  CHECK(worst_inverse < 1e-10);  // the same, with the round-off of 50 updates
  CHECK(factorisations * 20 < cold_factorisations);
}

TEST_CASE("complementarity: no memory is taken once the size is known") {
  if (!counts_memory) MESSAGE("not counted: this program brings its own malloc");
  const StripProblem problem = strip_problem(0.1, 20);
  const int n = static_cast<int>(problem.gap.size());
  ComplementaritySolver solver;
  ActiveSet active;
  VectorXd e(n), p(n), d(n);
  e = problem.gap.array() - 1e-7;
  solver.solve(problem.a, e, active, p, d);
  long before = memory_requests;
  {
    VectorXd witness(100);
    CHECK(witness.size() == 100);
  }
  CHECK((!counts_memory || memory_requests > before));  // the counter counts
  int factorisations = 0, sets = 0;
  before = memory_requests;
  for (int step = 0; step < 1000; ++step) {
    e.array() = problem.gap.array() - 4e-6 * (1 + std::sin(0.37 * step));
    if (step % 7 == 0) active.forget();
    if (step % 11 == 0) active.strips.clear();
    const Certificate c = solver.solve(problem.a, e, active, p, d);
    factorisations += c.factorisations;
    sets += c.iterations;
  }
  const long taken = memory_requests - before;
  CHECK(taken == 0);
  CHECK(factorisations > 100);  // the loop went through all the ways to a set
  CHECK(sets > 1500);

  std::mt19937 random(8);
  const ZoneProblem zones = random_zones(random);
  VectorXd gaps(zones.parts.size()), force(gaps.size()), open(gaps.size()),
      nodes(ZoneProblem::kPairs * ZoneProblem::kNodes);
  ActiveSet set;
  gaps = zones.gap.array() - 1e-7;
  solver.solve(zones.parts, gaps, set, force, open, nodes.data());
  factorisations = sets = 0;
  before = memory_requests;
  for (int step = 0; step < 1000; ++step) {
    gaps.array() = zones.gap.array() - 4e-6 * (1 + std::sin(0.37 * step));
    if (step % 7 == 0) set.forget();
    if (step % 11 == 0) set.strips.clear();
    const Certificate c = solver.solve(zones.parts, gaps, set, force, open, nodes.data());
    factorisations += c.factorisations;
    sets += c.iterations;
  }
  const long taken_in_parts = memory_requests - before;
  CHECK(taken_in_parts == 0);
  CHECK(factorisations > 100);
  CHECK(sets > 1500);
}

TEST_CASE("complementarity: what has no solution is rejected with its numbers") {
  const auto says = [](const MatrixXd& a, const VectorXd& e, std::vector<int> start = {}) -> std::string {
    return message_of([&] { solve(a, e, std::move(start)); });
  };
  for (double coupling : {2.0, -2.0})
    for (const std::vector<int>& start : {std::vector<int>{}, {0, 1}})
      CHECK(names(says(MatrixXd{{1, coupling}, {coupling, 1}}, VectorXd{{-1, -1}}, start),
                  {"not positive definite"}));
  // With coupling 2, forces (1, 0), (0, 1) and (1/3, 1/3) all meet the signs. Here forces (1, 1, 0) do, and the strip
  // that makes A indefinite stays open.
  for (double gap : {0.5, 100.0})
    CHECK(names(says(MatrixXd{{1, 0, 0}, {0, 1, 2}, {0, 2, 1}}, VectorXd{{-1, -1, gap}}),
                {"not positive definite"}));
  CHECK(names(says(MatrixXd{{0.0}}, VectorXd{{-1.0}}), {"not positive definite"}));
  // Singular, and no force closes both gaps: d1 + d2 = -2 whatever p is.
  CHECK(says(MatrixXd{{1, -1}, {-1, 1}}, VectorXd{{-1, -1}}) != "");
  CHECK(names(says(MatrixXd::Identity(2, 2), VectorXd{{-1, std::nan("")}}), {"finite"}));
  CHECK(says(MatrixXd{{1, std::nan("")}, {std::nan(""), 1}}, VectorXd{{-1, 1}}) != "");
  CHECK(names(says(MatrixXd::Identity(3, 3), VectorXd{{-1, -1}}), {"3 x 3", 2}));
}

TEST_CASE("complementarity: a problem that fails leaves nothing to the next one with its set") {
  ComplementaritySolver solver;
  ActiveSet active;
  VectorXd p(3), d(3);
  const MatrixXd good{{2, 1, 0}, {1, 2, 1}, {0, 1, 2}}, bad{{2, 0, 0}, {0, 1, 2}, {0, 2, 1}};
  const VectorXd gaps{{-1, -1, -3}};
  // The last strip is the first to touch: the set that is half made is not in order.
  CHECK_THROWS_AS(solver.solve(bad, gaps, active, p, d), Error);
  solver.solve(good, gaps, active, p, d);
  CHECK((good * p + gaps).cwiseMin(p).cwiseAbs().maxCoeff() < 1e-15);
  // Gaps that are no numbers, from a set that is known.
  CHECK_THROWS_AS(solver.solve(good, VectorXd::Constant(3, std::nan("")), active, p, d), Error);
  solver.solve(good, gaps, active, p, d);
  CHECK((good * p + gaps).cwiseMin(p).cwiseAbs().maxCoeff() < 1e-15);
  // A set on which a compliance cannot be factorised.
  active.strips = {0, 1, 2};
  active.forget();
  CHECK_THROWS_AS(solver.solve(bad, gaps, active, p, d), Error);
  solver.solve(good, gaps, active, p, d);
  CHECK((good * p + gaps).cwiseMin(p).cwiseAbs().maxCoeff() < 1e-15);
}

TEST_CASE("compliance in parts: product, matrix and columns are those of the matrix put together") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> force(0, 1);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const ZoneProblem problem = random_zones(random);
    const int n = problem.parts.size();
    MatrixXd whole(n, n);
    problem.parts.assemble(whole.data());
    CHECK((whole - problem.a).cwiseAbs().maxCoeff() <= 1e-15 * problem.a.cwiseAbs().maxCoeff());
    VectorXd p = VectorXd::NullaryExpr(n, [&] { return force(random) < 0.5 ? 0.0 : force(random); });
    if (repeat % 4 == 0) p.segment(20, 20).setZero();
    VectorXd d = problem.gap, nodes = VectorXd::Constant(ZoneProblem::kPairs * ZoneProblem::kNodes, -1);
    problem.parts.add_product(p.data(), nodes.data(), d.data());
    const VectorXd expected = problem.a * p + problem.gap;
    CHECK((d - expected).cwiseAbs().maxCoeff() <= 1e-14 * expected.cwiseAbs().maxCoeff());
    CHECK(std::abs(nodes.sum() - p.sum()) <= 1e-12 * p.sum());  // weights of a strip sum to 1
    std::vector<int> some;
    for (int i = 0; i < n; ++i)
      if (p[i] > 0) some.push_back(i);
    MatrixXd columns = MatrixXd::Constant(n, n, std::numeric_limits<double>::quiet_NaN());
    problem.parts.assemble_columns(some, some, columns.data());
    CHECK(columns(some, some) == whole(some, some));
  }
}

TEST_CASE("strips in parts: the solution of the matrix, whatever set they start from") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> approach(-2e-6, 12e-6), share(0, 1);
  for (int repeat = 0; repeat < 200; ++repeat) {
    const ZoneProblem problem = random_zones(random);
    const int n = problem.parts.size();
    ComplementaritySolver solver;
    ActiveSet active, generic;
    VectorXd p(n), d(n), nodes(ZoneProblem::kPairs * ZoneProblem::kNodes), expected(n), gaps(n);
    for (int step = 0; step < 6; ++step) {
      // Steps move on a little, jump, start from a set that is wrong, or from one without its inverse.
      const VectorXd e = problem.gap.array() - approach(random);
      if (step == 3) active.forget();
      if (step == 4) {
        active.forget();
        active.strips.clear();
        for (int i = 0; i < n; ++i)
          if (share(random) < 0.3) active.strips.push_back(i);
      }
      const Certificate certificate = solver.solve(problem.parts, e, active, p, d, nodes.data());
      const Certificate reference = solver.solve(problem.a, e, generic, expected, gaps);
      const double largest = std::max(1e-300, expected.maxCoeff());
      CHECK((p - expected).cwiseAbs().maxCoeff() <= 1e-8 * largest);
      CHECK(kkt_residual(problem.a, e, p) <= 1e-11);
      CHECK(certificate.residual <= 1e-11);
      CHECK(certificate.least_gap >= -1e-17);
      CHECK(p.minCoeff() >= 0);
      CHECK(certificate.degenerate == reference.degenerate);
      CHECK(std::abs(nodes.sum() - p.sum()) <= 1e-12 * p.sum());
      std::vector<int> touching;
      for (int i = 0; i < n; ++i)
        if (p[i] > 0) touching.push_back(i);
      CHECK(active.strips == touching);
      // The same again needs no other set.
      const Certificate again = solver.solve(problem.parts, e, active, p, d, nodes.data());
      if (reference.degenerate == 0) {
        CHECK(again.factorisations == 0);
        CHECK(again.iterations == 1);
      }
    }
  }
}

TEST_CASE("strips in parts: a number that is none is rejected, wherever it stands") {
  std::mt19937 random(7);
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (int strip : {0, 27, 33, 59}) {
      ZoneProblem problem = random_zones(random);
      const int n = problem.parts.size();
      ComplementaritySolver solver;
      ActiveSet active;
      VectorXd p(n), d(n), nodes(ZoneProblem::kPairs * ZoneProblem::kNodes);
      VectorXd e = problem.gap.array() - 5e-6;
      solver.solve(problem.parts, e, active, p, d, nodes.data());
      e[strip] = bad;
      CHECK(failure_of([&] { solver.solve(problem.parts, e, active, p, d, nodes.data()); }) ==
            Failure::numerical);
      e = problem.gap.array() - 5e-6;
      problem.half_plane[strip / 20][static_cast<size_t>(strip % 20 * 21)] = bad;
      active.forget();
      bool rejected = false;
      try {
        solver.solve(problem.parts, e, active, p, d, nodes.data());
      } catch (const Error& error) {
        CHECK(error.kind() == Failure::numerical);
        rejected = true;
      }
      // A column that is not looked at may stand as it likes as long as its strip carries nothing.
      if (!rejected) CHECK(p[strip] == 0);
    }
}

TEST_CASE(
    "strips in parts that do not say how they share the load are rejected, or shared as their matrix is") {
  std::mt19937 random(9);
  ZoneProblem problem = random_zones(random);
  const int n = problem.parts.size();
  // Nothing but three rigid bodies in a row: every strip of a candidate zone gives way as the others.
  for (auto& half_plane : problem.half_plane) std::fill(half_plane.begin(), half_plane.end(), 1e-9);
  std::fill(problem.at_nodes.begin(), problem.at_nodes.end(), 0.0);
  MatrixXd a(n, n);
  problem.parts.assemble(a.data());
  const VectorXd e = VectorXd::Constant(n, -1e-6);
  VectorXd p(n), d(n), nodes(ZoneProblem::kPairs * ZoneProblem::kNodes);
  std::vector<int> all(static_cast<size_t>(n));
  std::iota(all.begin(), all.end(), 0);
  for (const std::vector<int>& start : {std::vector<int>{}, std::vector<int>{3, 25}, all}) {
    ActiveSet active;
    active.strips = start;
    ComplementaritySolver shifting(Singular::shift);
    const Certificate certificate = shifting.solve(problem.parts, e, active, p, d, nodes.data());
    CHECK(certificate.residual <= 1e-10);
    CHECK(kkt_residual(a, e, p) <= 1e-9);
    for (int j = 0; j < ZoneProblem::kPairs; ++j)
      CHECK(p.segment(j * ZoneProblem::kStrips, ZoneProblem::kStrips).sum() == relative(1000, 1e-6));
  }
  ActiveSet active;
  active.strips = all;
  ComplementaritySolver rejecting;
  CHECK(failure_of([&] { rejecting.solve(problem.parts, e, active, p, d, nodes.data()); }) ==
        Failure::numerical);
  active.strips = {5, 1000, 3};
  active.forget();
  CHECK(failure_of([&] { rejecting.solve(problem.parts, e, active, p, d, nodes.data()); }) ==
        Failure::numerical);
}
