// Times complementarity and static solves. Methods take turns within each repeat, so that a slow spell of the machine
// hits all of them; minimum and median over the repeats. A time stands beside the error at which it was reached.
//
// Reads   optionally params and two body.h5 for the static position; writes a table on standard output.
// Example: whine-bench --params out/parker2000/params/static.toml --driver out/parker2000/pinion/body.h5
//            --driven out/parker2000/wheel/body.h5 --torque 150
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "base/tool.h"
#include "contact/complementarity.h"
#include "files/scene.h"
#include "files/schemas.h"
#include "motion/rolling_mesh.h"
#if __has_include(<siconos/numerics/lcp_cst.h>)
#include "../peer/lemke.h"
#define WHINE_HAS_SICONOS 1
#endif

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRepeats = 21;

struct Times {
  double least = 0, median = 0;  // s per solve
};

// Seconds per solve of each method; a method runs `count` solves per turn.
std::vector<Times> take_turns(const std::vector<std::function<void()>>& methods,
                              const std::vector<int>& counts) {
  std::vector<std::vector<double>> seconds(methods.size());
  for (int repeat = -1; repeat < kRepeats; ++repeat)  // the first one warms up
    for (size_t m = 0; m < methods.size(); ++m) {
      const auto start = std::chrono::steady_clock::now();
      methods[m]();
      const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (repeat >= 0) seconds[m].push_back(taken / counts[m]);
    }
  std::vector<Times> times;
  for (auto& s : seconds) {
    std::sort(s.begin(), s.end());
    times.push_back({s.front(), s[s.size() / 2]});
  }
  return times;
}

// Two tooth pairs of n / 2 strips, Hertz gaps that wander under them while the load breathes; numbers about 1.
struct Family {
  MatrixXd a;
  std::vector<VectorXd> e;
};
Family rolling_strips(int n, int problems) {
  const whine::HalfPlaneSurface surface({207e9, 0.3, 7600, false}, 25.4e-3);
  const int m = n / 2;
  const double width = 4e-4 / m, radius = 12.8e-3;
  Family family{MatrixXd::Constant(n, n, 4e-10), {}};
  for (int pair = 0; pair < 2; ++pair)
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j)
        family.a(pair * m + i, pair * m + j) = 2e-9 + 2 * surface.strip((i - j) * width, width / 2, 1e-3);
  const double scale = family.a.maxCoeff();
  family.a /= scale;
  for (int t = 0; t < problems; ++t) {
    const double phase = 2 * std::acos(-1.0) * t / 1000;
    VectorXd e(n);
    for (int pair = 0; pair < 2; ++pair) {
      const double middle = 1.2e-4 * std::sin(0.3 * phase + pair);
      const double approach = 3e-6 * (1 + 0.5 * std::sin(phase + 2 * pair));
      for (int i = 0; i < m; ++i) {
        const double x = (i - 0.5 * (m - 1)) * width - middle;
        e[pair * m + i] = (0.5 * x * x / radius - approach) / 1e-6;
      }
    }
    family.e.push_back(e);
  }
  return family;
}

void complementarity(int n) {
  constexpr int kProblems = 4000, kStride = 20;  // cold methods take every 20th
  Family family = rolling_strips(n, kProblems);
  whine::ComplementaritySolver solver;
  VectorXd p(n), d(n), peer_p(n), peer_d(n);
  whine::ActiveSet active;
  double residual = 0;
  long factorisations = 0;
  const auto solve = [&](const VectorXd& e) {
    const whine::Certificate c = solver.solve(family.a, e, active, p, d);
    residual = std::max(residual, c.residual);
    factorisations += c.factorisations;
  };
  std::vector<std::function<void()>> methods = {[&] {
                                                  for (const VectorXd& e : family.e) solve(e);
                                                },
                                                [&] {
                                                  for (const VectorXd& e : family.e)
                                                    active.forget(), solve(e);
                                                },
                                                [&] {
                                                  for (int t = 0; t < kProblems; t += kStride)
                                                    active.forget(), active.strips.clear(),
                                                        solve(family.e[t]);
                                                }};
  std::vector<int> counts = {kProblems, kProblems, kProblems / kStride};
  std::vector<const char*> names = {"kept A, warm", "new A, warm", "new A, cold"};
#ifdef WHINE_HAS_SICONOS
  whine::Lemke lemke;
  methods.push_back([&] {
    for (int t = 0; t < kProblems; t += kStride) lemke.solve_scaled(family.a, family.e[t], peer_p, peer_d);
  });
  counts.push_back(kProblems / kStride);
  names.push_back("Siconos LEMKE");
#endif
  const std::vector<Times> times = take_turns(methods, counts);
  double difference = 0;
#ifdef WHINE_HAS_SICONOS
  for (int t = 0; t < kProblems; t += kStride) {
    solve(family.e[t]);
    lemke.solve_scaled(family.a, family.e[t], peer_p, peer_d);
    difference = std::max(difference, (p - peer_p).cwiseAbs().maxCoeff() / peer_p.maxCoeff());
  }
#endif
  for (size_t m = 0; m < times.size(); ++m) {
    std::printf("  %3d  %-14s %10.3f %10.3f %12.0f", n, names[m], times[m].least * 1e6, times[m].median * 1e6,
                1 / times[m].median);
    if (times.size() > 3)
      std::printf(" %9.1f %9.1f", times[3].least / times[m].least, times[3].median / times[m].median);
    std::printf("\n");
  }
  std::printf("       largest residual %.1e", residual);
  if (times.size() > 3)
    std::printf(", largest difference of forces from Siconos %.1e of the largest", difference);
  std::printf("\n");
}

void static_position(const std::string& params, const std::string& driver, const std::string& driven,
                     double torque) {
  using namespace whine;
  const StaticSlice slice = read_static_slice(params);
  const GearMeshModel model(read_body(driver), read_body(driven), slice.mesh);
  const double load = torque / model.kinematics.gear(0).base_radius(), depth = 1e-3;
  const ContactRange range = contact_range(
      model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(), slice.contact.strips,
      load / model.kinematics.contact_ratio(), 1.1 * load, 1e-6 + 8e-9 * load);
  std::vector<MatrixXd> tables[2];
  for (int g = 0; g < 2; ++g)
    for (int offset = -model.gear[g].body().offsets; offset <= model.gear[g].body().offsets; ++offset)
      tables[g].push_back(model.gear[g].compliance(offset, depth));
  ComplementaritySolver solver;
  ActiveSet active;
  double residual = 0, warm_start = 0;
  const auto prepare = [&](double phase, MeshPosition& position, MatrixXd& a) {
    position = make_position(model, phase, range);
    a = local_compliance(model, position, depth);
    position.add_to_strips(body_compliance(position, 0, tables[0]) + body_compliance(position, 1, tables[1]),
                           a);
  };
  MeshPosition position;
  MatrixXd a;
  prepare(0.25, position, a);
  const VectorXd approach = position.strip_lever[0] / model.kinematics.gear(0).base_radius();
  const auto rest = [&](double force, double start) {
    const Equilibrium e = equilibrium(a, position.gap, approach, force, start, active, solver);
    residual = std::max({residual, e.residual, e.certificate.residual});
    return e.x;
  };
  constexpr int kCount = 200;
  const std::vector<Times> times = take_turns({[&] {
                                                 for (int i = 0; i < kCount; ++i)
                                                   warm_start = rest(load * (1 + 0.01 * (i % 2)), warm_start);
                                               },
                                               [&] {
                                                 for (int i = 0; i < kCount; ++i)
                                                   active = ActiveSet(), rest(load, 0);
                                               },
                                               [&] {
                                                 for (int i = 0; i < kCount; ++i)
                                                   prepare(0.25, position, a), active = ActiveSet(),
                                                                               rest(load, 0);
                                               }},
                                              {kCount, kCount, kCount});
  const char* names[] = {"warm, 1 % other load", "cold", "cold, with its compliance"};
  std::printf("Static solves at one position: %s, %g N m, %d strips; microseconds\n", params.c_str(), torque,
              position.strips());
  std::printf("  %-26s %10s %10s %12s\n", "", "minimum", "median", "per second");
  for (int m = 0; m < 3; ++m)
    std::printf("  %-26s %10.2f %10.2f %12.0f\n", names[m], times[m].least * 1e6, times[m].median * 1e6,
                1 / times[m].median);
  std::printf("  largest residual of load and contact %.1e\n", residual);
}

void body(int argc, char** argv) {
  CLI::App app{"Times complementarity and static solves", "whine-bench"};
  std::string params, driver, driven, torque = "150";
  CLI::Option* slice =
      app.add_option("--params", params, "slice of the scene: out/<scene>/params/static.toml");
  CLI::Option* first = app.add_option("--driver", driver, "body.h5 of the driving gear")->needs(slice);
  CLI::Option* second = app.add_option("--driven", driven, "body.h5 of the driven gear")->needs(first);
  slice->needs(second);
  app.add_option("--torque", torque, "torque on the driver in N m, above 0");
  whine::parse(app, argc, argv);

  std::printf(
      "Complementarity: two pairs of n / 2 strips, gaps that move; microseconds, %d repeats in turn\n",
      kRepeats);
  std::printf("  %3s  %-14s %10s %10s %12s", "n", "", "minimum", "median", "per second");
#ifdef WHINE_HAS_SICONOS
  std::printf(" %19s", "LEMKE's time over it");
#else
  std::printf("  (no Siconos to compare with: make deps-bench)");
#endif
  std::printf("\n");
  for (int n : {10, 20, 40, 80}) complementarity(n);
  if (!params.empty()) static_position(params, driver, driven, whine::number_option("--torque", torque));
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
