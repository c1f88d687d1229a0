// Contact problems by the thousand: each ends with a certificate that extended precision confirms, or with an error that says
// why.
//
//   whine-stress-contact PROBLEMS [SEED]
//
// Random, ill-conditioned (up to 1e14), degenerate, singular and badly scaled matrices with known solutions, strips of gears,
// and the steps of an integration, from nothing, from the set before and from sets that are wrong. Status 1 if an answer is
// wrong or a problem that is none of the hard ones is rejected.
#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

#include "base/error.h"
#include "contact/complementarity.h"
#include "paper_pair.h"
#include "peer/strip_problems.h"
#include "peer/window_problem.h"

namespace {

using namespace whine;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Problem {
  MatrixXd a;
  VectorXd e;
  VectorXd known;     // a solution, to round-off of e; empty: none is known
  bool hard = false;  // may be rejected
  std::vector<int> start;
  std::shared_ptr<ZoneProblem> zones;  // the same in parts, to be solved so; null: there are none
};

class Problems {
 public:
  explicit Problems(unsigned seed) : random_(seed) { record(); }

  // kind: 0 to kKinds - 1
  Problem make(int kind) {
    switch (kind) {
      case 0:
        return with_solution(spectrum(order(), uniform(0, 3)), false);
      case 1:
        return with_solution(spectrum(order(), uniform(8, 14)), true);
      case 2:
        return degenerate();
      case 3:
        return singular();
      case 4:
        return scaled();
      case 5:
        return strips();
      case 6:
        return recorded_step();
      case 7:
        return zones_of_three();
      default:
        return cornered();
    }
  }
  static constexpr int kKinds = 9;
  static const char* name(int kind) {
    static const char* const names[kKinds] = {"condition up to 1e3",
                                              "condition 1e8 to 1e14",
                                              "degenerate: gap and force 0",
                                              "singular, strips that coincide",
                                              "badly scaled, all open, all closed",
                                              "strips of a gear pair, any phase",
                                              "steps of an integration, moved gaps",
                                              "three candidate zones in parts",
                                              "Hilbert and Fathi"};
    return names[kind];
  }
  std::mt19937& random() { return random_; }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  double normal() { return std::normal_distribution<double>()(random_); }

 private:
  int order() { return whole(1, 28); }
  VectorXd normals(int n) {
    return VectorXd::NullaryExpr(n, [&] { return normal(); });
  }
  // Symmetric with eigenvalues from 1 to 10^-decades.
  MatrixXd spectrum(int n, double decades) {
    MatrixXd a = MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i) a(i, i) = std::pow(10, n > 1 ? -decades * i / (n - 1) : 0.0);
    for (int turn = 0; turn < 3; ++turn) {
      const VectorXd v = normals(n).normalized();
      a -= 2 * v * (v.transpose() * a);
      a -= 2 * (a * v) * v.transpose();
    }
    return 0.5 * (a + a.transpose());
  }
  Problem with_solution(MatrixXd a, bool hard) {
    const int n = static_cast<int>(a.rows());
    VectorXd p = VectorXd::Zero(n), d = VectorXd::Zero(n);
    for (int i = 0; i < n; ++i) (whole(0, 1) ? p : d)[i] = std::abs(normal());
    return {a, d - a * p, p, hard, some(n), nullptr};
  }
  std::vector<int> some(int n) {
    std::vector<int> set;
    if (whole(0, 2) == 0)
      for (int i = 0; i < n; ++i)
        if (whole(0, 1)) set.push_back(i);
    return set;
  }
  Problem degenerate() {
    Problem problem = with_solution(spectrum(order(), uniform(0, 6)), true);
    const int n = static_cast<int>(problem.e.size());
    VectorXd p = problem.known, d = problem.a * p + problem.e;
    for (int i = 0; i < n; ++i)
      if (whole(0, 1))
        p[i] = 0, d[i] = 0;
      else if (p[i] > 0)
        d[i] = 0;
    problem.e = d - problem.a * p;
    problem.known = p;
    return problem;
  }
  Problem singular() {
    const int n = whole(2, 24), rank = whole(1, n);
    const MatrixXd b = MatrixXd::NullaryExpr(n, rank, [&] { return normal(); });
    Problem problem = with_solution(b * b.transpose() / rank, true);
    if (whole(0, 1)) {  // a strip twice, with the same gap or another
      problem.a.row(n - 1) = problem.a.row(0).eval();
      problem.a.col(n - 1) = problem.a.col(0).eval();
      problem.a(n - 1, n - 1) = problem.a(0, 0);
      problem.e[n - 1] = problem.e[0] * (whole(0, 1) ? 1 : 1 + 1e-6 * normal());
      problem.known.resize(0);
    }
    return problem;
  }
  Problem scaled() {
    Problem problem = with_solution(spectrum(order(), uniform(0, 3)), true);
    const double stretch = std::pow(10, uniform(-30, 30)), shift = std::pow(10, uniform(-30, 30));
    const int n = static_cast<int>(problem.e.size());
    switch (whole(0, 4)) {
      case 0:
        problem.e = problem.e.cwiseAbs(), problem.known = VectorXd::Zero(n);
        break;
      case 1:
        problem.e.setZero(), problem.known = VectorXd::Zero(n);
        break;
      case 2: {  // rows of very different size
        const VectorXd rows = VectorXd::NullaryExpr(n, [&] { return std::pow(10, uniform(-4, 4)); });
        problem.a = (rows.asDiagonal() * problem.a * rows.asDiagonal()).eval();
        problem.e = problem.e.cwiseProduct(rows);
        problem.known = problem.known.cwiseQuotient(rows);
        break;
      }
      default:
        break;
    }
    problem.a *= stretch;
    problem.e *= shift;
    if (problem.known.size() > 0) problem.known *= shift / stretch;
    return problem;
  }
  Problem strips() {
    const StripProblem strips = strip_problem(uniform(-0.95, 0.95), 4 * whole(1, 6));
    const int n = static_cast<int>(strips.gap.size());
    return {strips.a, strips.gap.array() - std::pow(10, uniform(-8, -4.5)), {}, false, some(n), nullptr};
  }
  void record() {
    const SweepParameters settings = paper_sweep(2900, 2900, 1);
    DynamicParameters parameters = paper_parameters(463e6);
    parameters.inertia.assign(settings.inertia.begin(), settings.inertia.end());
    parameters.damping.rayleigh_stiffness = 5.5e-6;  // contact is lost
    const GearMeshModel model(paper_body(40e-3, 1.5e-3), paper_body(40e-3, 1.5e-3), paper_statics(128).mesh);
    RollingDynamics dynamics(model, parameters);
    const double load = 150 / model.kinematics.gear(0).base_radius();
    dynamics.set_zone(candidate_zone(model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(),
                                     8, load / model.kinematics.contact_ratio(), 10 * load, 60e-6),
                      128);
    RollingDynamics::State state = dynamics.rest();
    dynamics.set_speed(2900, 128);
    for (int period = 0; period < 40; ++period) {
      const auto steps = dynamics.contact_problems(state);
      if (period % 8 == 7) recorded_.insert(recorded_.end(), steps.begin(), steps.end());
    }
  }
  Problem recorded_step() {
    const auto& step = recorded_[static_cast<size_t>(whole(0, static_cast<int>(recorded_.size()) - 1))];
    const double size = step.offset.cwiseAbs().maxCoeff(),
                 move = whole(0, 3) ? std::pow(10, uniform(-6, 0)) * size : 0;
    Problem problem{step.compliance, step.offset, {}, false, step.active.strips, nullptr};
    for (double& e : problem.e) e += move * normal();
    if (whole(0, 2) == 0) problem.start = some(static_cast<int>(problem.e.size()));
    return problem;
  }
  // Bodies from stiff to soft beside the half-planes, whole or between few of their nodes; gaps of gears, or with a solution
  // that is known and may be degenerate.
  Problem zones_of_three() {
    constexpr int kNodes = ZoneProblem::kPairs * kZoneNodes;
    const double decades = uniform(0, 14);
    const MatrixXd c = std::pow(10, uniform(-13, -8)) * spectrum(kNodes, decades);
    const auto zones = std::make_shared<ZoneProblem>(uniform(-0.45, 0.45), c);
    if (whole(0, 1)) {
      const int n = static_cast<int>(zones->gap.size());
      return {zones->a, zones->gap.array() - std::pow(10, uniform(-8, -4.5)), {}, false, some(n), zones};
    }
    Problem problem = with_solution(zones->a, false);
    if (whole(0, 2) == 0) {  // what neither carries nor gapes
      VectorXd d = problem.a * problem.known + problem.e;
      for (double& gap : d) gap *= whole(0, 3) > 0;
      for (double& force : problem.known) force *= whole(0, 3) > 0;
      for (Eigen::Index i = 0; i < d.size(); ++i)
        if (problem.known[i] > 0) d[i] = 0;
      problem.e = d - problem.a * problem.known;
    }
    problem.zones = zones;
    return problem;
  }
  Problem cornered() {
    const int n = whole(2, 16);
    MatrixXd a(n, n);
    if (whole(0, 1)) {
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) a(i, j) = 1.0 / (i + j + 1);
    } else {
      MatrixXd l = MatrixXd::Identity(n, n);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j) l(i, j) = 2;
      a = l * l.transpose();
    }
    return with_solution(a, true);
  }

  std::mt19937 random_;
  std::vector<RollingDynamics::ContactProblem> recorded_;
};

// What is wrong with an answer, in extended precision; null if nothing is.
const char* fault(const Problem& problem, const VectorXd& p, const VectorXd& d,
                  const Certificate& certificate) {
  const int n = static_cast<int>(p.size());
  const long double scale = problem.e.cwiseAbs().maxCoeff();
  long double worst = 0, apart = 0, round_off = 0, loads = 0;
  std::vector<long double> gap(static_cast<size_t>(n));
  for (int i = 0; i < n; ++i) {
    long double sum = problem.e[i], size = std::abs(sum);
    for (int j = 0; j < n; ++j) {
      const long double term = static_cast<long double>(problem.a(i, j)) * p[j];
      sum += term;
      size += std::abs(term);
    }
    gap[static_cast<size_t>(i)] = sum;
    worst = std::max(worst, std::abs(std::min(sum, static_cast<long double>(p[i]) * problem.a(i, i))));
    apart = std::max(apart, std::abs(sum - static_cast<long double>(d[i])));
    round_off = std::max(round_off, size * 1e-15L * n);
    loads += std::abs(p[i]);
  }
  if (!p.allFinite() || !d.allFinite()) return "not finite";
  // One number in ten digits is what a certificate promises; what double precision cannot know of A p is on top.
  const long double allowed = static_cast<long double>(kMostResidual) * scale + round_off;
  if (worst > allowed) return "gap and force do not complement each other";
  if (apart > allowed) return "the gaps given are not those of the forces";
  if (!(certificate.residual <= kMostResidual)) return "a certificate that does not hold was handed out";
  if (problem.known.size() == 0) return nullptr;
  // (p - q)' A (p - q) = (p - q)' (d - d_q) is at most what gaps and forces miss; q solves it to round-off.
  long double energy = 0, known_loads = 0, known_round_off = 0;
  for (int i = 0; i < n; ++i) {
    long double row = 0, size = std::abs(problem.e[i]);
    for (int j = 0; j < n; ++j) {
      row += static_cast<long double>(problem.a(i, j)) * (static_cast<long double>(p[j]) - problem.known[j]);
      size += std::abs(static_cast<long double>(problem.a(i, j)) * problem.known[j]);
    }
    energy += row * (static_cast<long double>(p[i]) - problem.known[i]);
    known_loads += problem.known[i];
    known_round_off = std::max(known_round_off, size * 1e-15L * n);
  }
  return energy > 4 * (allowed + known_round_off) * (loads + known_loads) ? "not the known solution"
                                                                          : nullptr;
}

// Whether an answer that is off by 1e-4 of a force is found to be.
bool judge_finds(Problems& problems) {
  ComplementaritySolver solver;
  for (int found = 0; found < 100;) {
    const Problem problem = problems.make(0);
    const int n = static_cast<int>(problem.e.size());
    VectorXd p(n), d(n);
    ActiveSet active;
    const Certificate certificate = solver.solve(problem.a, problem.e, active, p, d);
    Eigen::Index most = 0;
    if (!(p.maxCoeff(&most) > 0)) continue;
    if (fault(problem, p, d, certificate)) return false;
    p[most] *= 1 + 1e-4;
    if (!fault(problem, p, d, certificate)) return false;
    ++found;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const long count = argc > 1 ? std::atol(argv[1]) : 1000000;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atol(argv[2])) : 1;
  Problems problems(seed);
  if (!judge_finds(problems)) {
    std::puts("the judge does not find an answer that is wrong");
    return 1;
  }
  long certified[Problems::kKinds] = {}, rejected[Problems::kKinds] = {}, wrong = 0, needless = 0,
       fallbacks = 0;
  ComplementaritySolver solver;  // one for all: what a problem leaves behind is no business of the next
  for (long done = 0; done < count;) {
    const int kind = static_cast<int>(problems.random()() % Problems::kKinds);
    Problem problem = problems.make(kind);
    const int n = static_cast<int>(problem.e.size());
    ActiveSet active;
    active.strips = problem.start;
    // The same A with other gaps uses the kept inverse.
    for (int again = problems.whole(1, 4); again > 0 && done < count; --again, ++done) {
      VectorXd p(n), d(n), nodes(ZoneProblem::kPairs * ZoneProblem::kNodes);
      try {
        const Certificate certificate =
            problem.zones ? solver.solve(problem.zones->parts, problem.e, active, p, d, nodes.data())
                          : solver.solve(problem.a, problem.e, active, p, d);
        ++certified[kind];
        fallbacks += certificate.fallback;
        if (const char* what = fault(problem, p, d, certificate)) {
          if (++wrong <= 20)
            std::printf("wrong answer %ld, %s, %d strips: %s\n", done, Problems::name(kind), n, what);
        }
      } catch (const Error& error) {
        ++rejected[kind];
        if (!problem.hard && ++needless <= 20)
          std::printf("rejected %ld, %s, %d strips: %s\n", done, Problems::name(kind), n, error.what());
        break;
      }
      problem.known.resize(0);
      const double size = problem.e.cwiseAbs().maxCoeff() * std::pow(10, problems.uniform(-8, 0));
      for (double& e : problem.e) e += size * problems.normal();
    }
  }
  long all = 0, none = 0;
  for (int kind = 0; kind < Problems::kKinds; ++kind) {
    std::printf("  %-36s %8ld certified %8ld rejected\n", Problems::name(kind), certified[kind],
                rejected[kind]);
    all += certified[kind];
    none += rejected[kind];
  }
  std::printf(
      "%ld contact problems, seed %u: %ld with a certificate (%ld by Lawson and Hanson's method), %ld rejected, %ld wrong, %ld rejected without need\n",
      all + none, seed, all, fallbacks, none, wrong, needless);
  return wrong + needless > 0;
}
