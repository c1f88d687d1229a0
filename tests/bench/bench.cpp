// Times complementarity, static positions, time steps, sweeps and reductions. Methods take turns within each repeat,
// so that a slow spell of the machine hits all of them; minimum and median over the repeats. What takes seconds is
// run once, by its CPU time. A time stands beside the error at which it was reached. Times are of CPU.
//
// Reads   optionally params and two body.h5 for the static position; writes a table on standard output.
// Example: whine-bench --params out/parker2000/params/static.toml --body pinion=out/parker2000/pinion/body.h5
//            --body wheel=out/parker2000/wheel/body.h5 --torque 150
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/tool.h"
#include "calculix.h"
#include "contact/complementarity.h"
#include "io/artifacts.h"
#include "io/named_files.h"
#include "io/scene.h"
#include "results/reduced_body.h"
#include "results/sector_grid.h"
#include "results/static.h"
#include "results/sweep.h"
#include "rolling.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "system/rolling_mesh.h"
#if __has_include(<siconos/numerics/lcp_cst.h>)
#define WHINE_HAS_SICONOS 1
#include "../peer/lemke.h"
#endif

// Eigen takes memory by malloc, the standard library by operator new, which calls malloc.
static std::atomic<long> memory_requests{0};
extern "C" void* __libc_malloc(size_t);
extern "C" void* malloc(size_t size) noexcept {
  memory_requests.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRepeats = 21;
constexpr double kPhase = 0.25;       // two pairs of teeth in contact
constexpr double kElement = 0.06e-3;  // m, of CalculiX where the flanks touch

struct Times {
  double least = 0, median = 0;  // s per solve
};

// Seconds per solve of each method; a method runs `count` solves per turn.
std::vector<Times> take_turns(const std::vector<std::function<void()>>& methods,
                              const std::vector<int>& counts) {
  std::vector<std::vector<double>> seconds(methods.size());
  for (int repeat = -1; repeat < kRepeats; ++repeat)  // the first one warms up
    for (size_t m = 0; m < methods.size(); ++m) {
      const double start = whine::cpu_now();
      methods[m]();
      const double taken = whine::cpu_now() - start;
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
        family.a(pair * m + i, pair * m + j) =
            2e-9 + 2 * surface.mean_over_strip((i - j) * width, width / 2, width / 2, 1e-3);
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

// A static position needs no modes; a body of the default scene, with 61, takes 14 s at 0.4 mm.
constexpr int kModes = 5;

// A body reduced in a process of its own, so that its peak of memory is its own.
struct Reduction {
  double compliance = 0;  // m N-1: at the pitch point, half-plane to 1 mm included
  int nodes = 0;          // of a sector
  whine::Usage usage;     // mesh and reduction
};
Reduction reduce_apart(const whine::ReducedBody& like, double element_size) {
  using namespace whine;
  int ends[2];
  if (pipe(ends) != 0) fail(Failure::io, "no pipe to a child process");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    try {
      BodyDiscretisation discretisation = like.discretisation;
      discretisation.element_size = element_size;
      const SectorGrid mesh = make_sector_mesh(like.design, discretisation);
      const ReducedBody body = reduce(mesh, like.material, kModes);
      const ElasticGear gear(body);
      const ToothGeometry tooth(body.design);
      const auto weights = gear.table().weights(tooth.roll_angle_at_radius(tooth.pitch_radius()));
      const double values[2] = {weights.dot(gear.compliance(0, 1e-3) * weights.transpose()),
                                double(mesh.node_position.rows())};
      _exit(write(ends[1], values, sizeof values) == sizeof values ? 0 : 1);
    } catch (const std::exception& error) {
      log_line("reduction at ", element_size * 1e3, " mm: ", error.what());
    }
    _exit(1);
  }
  close(ends[1]);
  double values[2] = {};
  const bool whole = read(ends[0], values, sizeof values) == sizeof values;
  close(ends[0]);
  Reduction result;
  result.usage = wait_for(child, text("the reduction with elements of ", element_size * 1e3, " mm"));
  if (!whole) fail(Failure::io, "a reduction handed back no result");
  result.compliance = values[0];
  result.nodes = static_cast<int>(values[1]);
  return result;
}

void reductions(const whine::ReducedBody& body) {
  constexpr double kElements[] = {0.8e-3, 0.4e-3, 0.2e-3, 0.1e-3};
  std::vector<Reduction> results;
  for (double element : kElements) results.push_back(reduce_apart(body, element));
  std::printf("Mesh and reduction of one gear (%d teeth, order %d, %d modes), in a process each\n",
              body.design.teeth, body.discretisation.element_order, kModes);
  std::printf("  %10s %14s %8s %8s %28s\n", "element mm", "nodes a sector", "CPU s", "peak MB",
              "compliance at the pitch point");
  for (size_t i = 0; i < results.size(); ++i) {
    std::printf("  %10g %14d %8.2f %8.0f ", kElements[i] * 1e3, results[i].nodes, results[i].usage.seconds,
                results[i].usage.megabytes);
    if (i + 1 < results.size())
      std::printf("%20.1e off\n", results[i].compliance / results.back().compliance - 1);
    else
      std::printf("%15.5e m/N\n", results[i].compliance);
  }
}

struct PositionTimes {
  Times warm, cold, cold_with_compliance;
  whine::Equilibrium rest;
};
PositionTimes static_position(const whine::GearMeshModel& model, const whine::StaticParameters& settings,
                              double torque, double phase, const char* what) {
  using namespace whine;
  const double load = torque / model.kinematics.gear(0).base_radius(), depth = 1e-3;
  const CandidateZone range = candidate_zone(
      model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(), settings.contact.strips,
      load / model.kinematics.contact_ratio(), 1.1 * load, 1e-6 + 8e-9 * load);
  std::vector<MatrixXd> tables[2];
  for (int g = 0; g < kSides; ++g)
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
  prepare(phase, position, a);
  const VectorXd approach = position.strip_lever[0] / model.kinematics.gear(0).base_radius();
  const auto rest = [&](double force, double start) {
    const Equilibrium e = equilibrium(a, position.gap, approach, force, start, active, solver);
    residual = std::max({residual, e.residual, e.certificate.residual});
    return e;
  };
  constexpr int kCount = 200;
  const std::vector<Times> times =
      take_turns({[&] {
                    for (int i = 0; i < kCount; ++i)
                      warm_start = rest(load * (1 + 0.01 * (i % 2)), warm_start).x;
                  },
                  [&] {
                    for (int i = 0; i < kCount; ++i) active = ActiveSet(), rest(load, 0);
                  },
                  [&] {
                    for (int i = 0; i < kCount; ++i)
                      prepare(phase, position, a), active = ActiveSet(), rest(load, 0);
                  }},
                 {kCount, kCount, kCount});
  const char* names[] = {"warm, 1 % other load", "cold", "cold, with its compliance"};
  std::printf("Static solves at mesh phase %g, %s: %g N m, %d strips; microseconds\n", phase, what, torque,
              position.strips());
  std::printf("  %-26s %10s %10s %12s\n", "", "minimum", "median", "per second");
  for (int m = 0; m < 3; ++m)
    std::printf("  %-26s %10.2f %10.2f %12.0f\n", names[m], times[m].least * 1e6, times[m].median * 1e6,
                1 / times[m].median);
  std::printf("  largest residual of load and contact %.1e\n", residual);
  active = ActiveSet();
  return {times[0], times[1], times[2], rest(load, 0)};
}

// The same position by CalculiX, in plane strain: its elements in plane stress change their thickness.
void beside_calculix(const whine::ReducedBody& driver, const whine::ReducedBody& driven,
                     const whine::StaticParameters& settings, double torque, double phase, double element) {
  using namespace whine;
  if (driver.material.youngs_modulus != driven.material.youngs_modulus ||
      driver.material.poisson_ratio != driven.material.poisson_ratio)
    fail(Failure::input, "the gears are of different materials; the comparison with CalculiX knows one");
  double reduction = std::numeric_limits<double>::infinity();  // s of CPU
  const auto in_plane_strain = [&](const ReducedBody& body) {
    const std::clock_t start = std::clock();
    Material material = body.material;
    material.plane_stress = false;
    const ReducedBody result = reduce(make_sector_mesh(body.design, body.discretisation), material, kModes);
    reduction = std::min(reduction, double(std::clock() - start) / CLOCKS_PER_SEC);
    return result;
  };
  const GearMeshModel model(in_plane_strain(driver), in_plane_strain(driven), settings.mesh);
  const PositionTimes whine = static_position(model, settings, torque, phase, "plane strain");
  std::printf("The same position by CalculiX\n");
  if (!calculix_installed()) {
    std::printf("  (no CalculiX to compare with: make deps-bench)\n");
    return;
  }
  const double base_radius = model.kinematics.gear(0).base_radius();
  const CalculixPosition peer =
      CalculixPair(model.kinematics, driver.material, phase, element).solve(whine.rest.x / base_radius);
  const double force = torque / base_radius, of_peer = peer.torque / model.kinematics.gear(1).base_radius();
  const double off = (force - of_peer) / whine.rest.stiffness / whine.rest.x;
  std::printf("  both gears whole, %d nodes of quadratic triangles, %g mm where the flanks touch\n",
              peer.nodes, element * 1e3);
  std::printf("  CPU %.1f s, peak %.0f MB\n", peer.usage.seconds, peer.usage.megabytes);
  std::printf("  transmission error: Whine %.4f micrometres, CalculiX %+.3f %%\n", whine.rest.x * 1e6,
              100 * off);
  std::printf("  its CPU over Whine's: %.1e warm, %.1e cold, %.1e cold with its compliance\n",
              peer.usage.seconds / whine.warm.least, peer.usage.seconds / whine.cold.least,
              peer.usage.seconds / whine.cold_with_compliance.least);
  std::printf("  mesh and reduction of one gear take %.2f s of CPU, %.2f of this\n", reduction,
              reduction / peer.usage.seconds);
}

// One speed of one contact; the least times of the repeats, the methods in turn. reference: the same pair by the other
// integrator in finer steps, which says at what error of the RMS these times were taken.
void rolling_steps(whine::RollingRig& rig, whine::RollingRig& reference, double frequency, bool strips,
                   double peak) {
  using namespace whine;
  constexpr int kCount = 8;  // periods a turn
  rig.run_to_orbit(frequency);
  reference.run_to_orbit(frequency);
  const auto rms = [](const VectorXd& x) { return std::sqrt((x.array() - x.mean()).square().mean()); };
  const double error = rms(rig.period.transmission_error) / rms(reference.period.transmission_error) - 1;
  const int steps = rig.steps;
  std::vector<RollingDynamics::ContactProblem> problems;
  std::vector<ActiveSet> active;
  double touching = 0, strips_mean = 0;
  if (strips) {
    problems = rig.dynamics().contact_problems(rig.state);
    for (const auto& problem : problems) {
      active.push_back(problem.active);
      touching += static_cast<double>(problem.active.strips.size()) / steps;
      strips_mean += static_cast<double>(problem.offset.size()) / steps;
    }
  }
  StepWork work;
  for (int i = 0; i < steps; ++i) {  // problem i is that of sample i + 1
    const int k = strips ? static_cast<int>(problems[(i + steps - 1) % steps].active.strips.size()) : 0;
    const int loaded = static_cast<int>((rig.period.tooth_pair_load.col(i).array() > 0).count());
    const StepWork one = counted_work(rig.sizes(i), loaded, k);
    work.flops += one.flops / steps;
    work.bytes += one.bytes / steps;
  }

  EnergyBalance energy_balance;
  ComplementaritySolver solver;
  VectorXd p, d;
  std::vector<std::function<void()>> methods = {[&] {
                                                  for (int i = 0; i < kCount; ++i) rig.integrate(nullptr);
                                                },
                                                [&] {
                                                  for (int i = 0; i < kCount; ++i)
                                                    rig.integrate(&energy_balance);
                                                }};
  std::vector<int> counts = {kCount * steps, kCount * steps};
  if (strips) {
    methods.push_back([&] {
      for (int i = 0; i < kCount; ++i)
        for (size_t k = 0; k < problems.size(); ++k) {
          p.resize(problems[k].offset.size());
          d.resize(p.size());
          solver.solve(problems[k].compliance, problems[k].offset, active[k], p, d);
        }
    });
    counts.push_back(kCount * steps);
#ifdef WHINE_HAS_SICONOS
    static Lemke lemke;
    methods.push_back([&] {
      for (size_t k = 0; k < problems.size(); k += 8) {
        RollingDynamics::ContactProblem& problem = problems[k];
        lemke.solve(problem.compliance, problem.offset, p, d);
      }
    });
    counts.push_back((static_cast<int>(problems.size()) + 7) / 8);
#endif
  }
  const std::vector<Times> times = take_turns(methods, counts);
  long requests[2];
  for (int kept : {0, 1}) {
    const long before = memory_requests;
    rig.integrate(kept ? &energy_balance : nullptr);
    requests[kept] = memory_requests - before;
  }
  std::printf("  %-6s %5.0f %6d %8.0f %8.0f %6.2f", strips ? "strips" : "line", frequency, steps,
              times[0].least * 1e9, times[1].least * 1e9, times[1].least / times[0].least);
  std::printf(" %7.2f %8.0f %8.1f %7.1f %7.1f %6.3f %5ld %ld", 100 * error, work.flops, work.bytes / 1024,
              work.flops / times[0].least * 1e-9, work.bytes / times[0].least * 1e-9,
              work.flops / times[0].least / peak, requests[0], requests[1]);
  if (strips) {
    std::printf("   %6.0f", times[2].least * 1e9);
    if (times.size() > 3) std::printf(" %8.1f", times[3].least / times[2].least);
    std::printf("  (%.1f of %.1f strips touch)", touching, strips_mean);
  }
  std::printf("\n");
}

// Figure 5 of P2000 on one core, reading and writing apart.
void rolling_sweep(const whine::ReducedBody& driver, const whine::ReducedBody& driven,
                   const whine::StaticResult& statics, double mean_stiffness, whine::SweepParameters settings,
                   double eta, whine::SteadyState method) {
  using namespace whine;
  settings.damping.rayleigh_stiffness = eta;
  settings.time.steady_state = method;
  long periods = 0;
  double imbalance = 0;
  const double seconds = least_seconds(5, [&] {
    periods = 0;
    for (const Direction direction : {Direction::up, Direction::down}) {
      const SweepResult result = sweep(driver, driven, statics, mean_stiffness, settings, direction,
                                       [](long, long, const std::string&) {});
      periods += result.periods.sum();
      imbalance = std::max(imbalance, result.energy_imbalance.maxCoeff());
    }
  });
  std::printf("  %-6s %9.2g  %-11s %7.2f %8ld  %.0e\n", name_of(settings.fidelity.contact).c_str(), eta,
              name_of(method).c_str(), seconds, periods, imbalance);
}

void rolling(const whine::ReducedBody& driver, const whine::ReducedBody& driven,
             whine::StaticParameters settings, whine::SweepParameters sweep_parameters, double torque) {
  using namespace whine;
  const double peak = peak_flops();
  std::printf(
      "Rolling dynamics: %g N m, Rayleigh %g s, %d modes a gear; least of %d repeats in turn; per step; RMS against Newmark, 1024 steps a period\n",
      torque, sweep_parameters.damping.rayleigh_stiffness, static_cast<int>(driver.eigenfrequency.size()),
      kRepeats);
  std::printf(
      "  machine in this run: %.1f Gflop/s of multiply-adds in registers; reads %.0f, %.0f, %.0f GB/s from 16 kB, 512 kB, 8 MB\n",
      peak * 1e-9, load_bandwidth(16u << 10) * 1e-9, load_bandwidth(512u << 10) * 1e-9,
      load_bandwidth(8u << 20) * 1e-9);
  std::printf("  %-6s %5s %6s %8s %8s %6s %7s %8s %8s %7s %7s %6s %7s   %s\n", "", "Hz", "steps", "ns",
              "balance", "over", "RMS %", "flops", "kB", "Gflop/s", "GB/s", "limit", "mallocs",
              "its contact problem as a matrix, warm: ns, LEMKE's time over it");
  std::vector<StaticResult> at_torque, at_reference;
  for (const auto contact : {ContactModel::strips, ContactModel::line}) {
    settings.fidelity.contact = sweep_parameters.fidelity.contact = contact;
    at_torque.push_back(static_transmission(driver, driven, settings, torque));
    at_reference.push_back(static_transmission(driver, driven, settings, sweep_parameters.reference_torque));
    const GearMeshModel model(driver, driven, settings.mesh);
    SweepParameters finer = sweep_parameters;
    finer.fidelity.integrator = Integrator::newmark;
    finer.time.steps_per_period = 1024;
    RollingRig rig(model, at_torque.back(), sweep_parameters), reference(model, at_torque.back(), finer);
    for (double frequency : {1350.0, 2400.0, 3300.0})
      rolling_steps(rig, reference, frequency, settings.fidelity.contact == ContactModel::strips, peak);
  }
  std::printf(
      "Sweeps up and down on one core, %g to %g Hz in steps of %g Hz; CPU without reading and writing\n",
      sweep_parameters.frequency_from, sweep_parameters.frequency_to, sweep_parameters.frequency_step);
  std::printf("  %-6s %9s  %-11s %7s %8s  %s\n", "", "Rayleigh s", "", "CPU s", "periods", "balance");
  for (size_t c = 0; c < at_torque.size(); ++c)
    for (double eta : {sweep_parameters.damping.rayleigh_stiffness, 5.5e-6})
      for (const auto method : {SteadyState::extrapolate, SteadyState::integrate}) {
        sweep_parameters.fidelity.contact = c == 0 ? ContactModel::strips : ContactModel::line;
        rolling_sweep(driver, driven, at_torque[c], at_reference[c].mean_stiffness, sweep_parameters, eta,
                      method);
      }
}

void positions_beside_calculix(const std::string& params, const std::vector<std::string>& bodies,
                               double torque, const std::vector<double>& phases, double element) {
  const whine::StaticParameters read = whine::read_static_parameters(params);
  const std::vector<std::string> paths = whine::NamedFiles("--body", bodies).of(read.mesh);
  const whine::ReducedBody driving = whine::read<whine::ReducedBody>(paths[0]),
                           following = whine::read<whine::ReducedBody>(paths[1]);
  for (const double phase : phases) beside_calculix(driving, following, read, torque, phase, element);
}

void body(int argc, char** argv) {
  whine::Options options{"Times complementarity, static positions and reductions", "whine-bench"};
  std::string params, torque = "150";
  std::vector<std::string> bodies;
  whine::Option settings =
      options.add("--params", params, "stage parameters of the scene: out/<scene>/params/static.toml");
  whine::Option files =
      options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").needs(settings);
  settings.needs(files);
  std::string sweep_params;
  options.add("--sweep-params", sweep_params, "stage parameters of the scene: out/<scene>/params/sweep.toml")
      .needs(settings);
  options.add("--torque", torque, "torque on the driver in N m, above 0");
  std::vector<double> phases;
  double element = kElement * 1e3;
  options
      .add(
          "--position", phases,
          "mesh phases, 0 up to 1, with a pair on the line of action: the static position there beside CalculiX, nothing else")
      .needs(settings);
  options.add("--element", element, "mm, side of its triangles where the flanks touch, of --position")
      .needs(settings);
  options.parse(argc, argv);
  if (!(element > 0)) whine::fail(whine::Failure::usage, "--element = ", element, ": a length above 0");
  for (const double phase : phases)
    if (!(phase >= 0 && phase < 1))
      whine::fail(whine::Failure::usage, "--position = ", phase, ": a mesh phase from 0 up to 1");
  if (!phases.empty()) {
    positions_beside_calculix(params, bodies, whine::number_option("--torque", torque), phases,
                              element * 1e-3);
    return;
  }

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
  if (params.empty()) return;
  const double load = whine::number_option("--torque", torque);
  const whine::StaticParameters read = whine::read_static_parameters(params);
  const std::vector<std::string> paths = whine::NamedFiles("--body", bodies).of(read.mesh);
  const whine::ReducedBody driving = whine::read<whine::ReducedBody>(paths[0]),
                           following = whine::read<whine::ReducedBody>(paths[1]);
  static_position(whine::GearMeshModel(driving, following, read.mesh), read, load, kPhase, params.c_str());
  if (!sweep_params.empty())
    rolling(driving, following, read, whine::read_sweep_parameters(sweep_params), load);
  reductions(driving);
  beside_calculix(driving, following, read, load, kPhase, kElement);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
