// Block pivoting beside Lemke's method of Siconos: 10 000 random problems and 10 000 of rolling strips.
// Prints `ok: ...` or `FAILED: ...` for each, as tests/run counts them.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include "contact/complementarity.h"
#include "peer/lemke.h"
#include "peer/strip_problems.h"

using namespace whine;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct Comparison {
  ComplementaritySolver solver;
  Lemke lemke;
  int problems = 0, given_up = 0, fallbacks = 0;
  double worst = 0, worst_residual = 0, lemke_residual = 0;

  static double residual(const MatrixXd& a, const VectorXd& e, const VectorXd& p) {
    const VectorXd d = a * p + e;
    return d.cwiseMin(p.cwiseProduct(a.diagonal())).cwiseAbs().maxCoeff() / e.cwiseAbs().maxCoeff();
  }

  void add(const MatrixXd& a, const VectorXd& e, ActiveSet& active) {
    VectorXd p(e.size()), d(e.size()), peer, peer_d;
    fallbacks += solver.solve(a, e, active, p, d).fallback;
    worst_residual = std::max(worst_residual, residual(a, e, p));
    ++problems;
    try {
      lemke.solve(a, e, peer, peer_d);
    } catch (const std::exception&) {
      ++given_up;
      return;
    }
    lemke_residual = std::max(lemke_residual, residual(a, e, peer));
    const double largest = std::max(peer.maxCoeff(), p.maxCoeff());
    if (largest > 0) worst = std::max(worst, (p - peer).cwiseAbs().maxCoeff() / largest);
  }

  bool report(const char* name, double tolerance) const {
    const bool good = problems == 10000 && worst < tolerance && worst_residual < 1e-12 && given_up == 0;
    std::cout << (good ? "ok: " : "FAILED: ") << name << ": " << problems
              << " problems, forces differ from Siconos by " << worst << " of the largest (tolerance "
              << tolerance << "), residual " << worst_residual << ", that of Siconos " << lemke_residual
              << ", " << fallbacks << " fallbacks, Siconos gave up on " << given_up << "\n";
    return good;
  }
};

}  // namespace

int main() {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Comparison drawn, recorded;
  for (int trial = 0; trial < 10000; ++trial) {
    const int n = 1 + trial % 40;
    MatrixXd a(n, n);
    VectorXd e(n);
    for (int i = 0; i < n; ++i) {
      e[i] = normal(random);
      for (int j = 0; j < n; ++j) a(i, j) = normal(random);
    }
    a = (a * a.transpose() / n + 0.1 * MatrixXd::Identity(n, n)).eval();
    ActiveSet active;
    drawn.add(a, e, active);
  }
  // 250 places of the mesh, 40 loads at each one after the other, with the active set of the load before.
  for (int place = 0; place < 250; ++place) {
    const StripProblem problem = strip_problem(-0.95 + 1.9 * (place + 0.5) / 250, 4 + place % 17);
    ActiveSet active;
    for (int load = 0; load < 40; ++load) {
      const double approach = 4e-6 * (1.001 + std::sin(0.5 * load + place));
      recorded.add(problem.a, problem.gap.array() - approach, active);
    }
  }
  // The random matrices' condition is below 50, the strips' below 1e4; Lemke's tableau loses that much.
  const bool first = drawn.report("random problems beside Siconos", 1e-10);
  const bool second = recorded.report("rolling strips beside Siconos", 1e-9);
  return first && second ? 0 : 1;
}
