// Error against CPU time: each numerical choice of a sweep varied alone about the scene's own settings, for the pair at a
// damping at which two branches of motion exist.
//
// Observables: RMS, mean and peak tooth load of five steady motions, on both branches, and the two speeds at which a branch
// ends. The errors of a choice are against its finest setting, those of the time steps against the other integrator. A
// reference in which everything is finer at once says what all of them make together; the same one level coarser says what
// that reference is worth.
//
// Motions settle and branches are followed to their ends as in a sweep, but by smaller last steps; each speed records one orbit
// with its energy balance.
//
// Reads   params of the static and of the sweep stage, body.h5 of both gears (for their design and material)
// Writes  <output>.{tsv,svg,png}, and the same table in words on standard output
// Example: whine-work-precision --static-params out/parker2000-deep-root/params/static.toml --sweep-params
//            out/parker2000-deep-root/params/sweep.toml --body pinion=out/parker2000-deep-root/pinion/body.h5
//            --body wheel=out/parker2000-deep-root/wheel/body.h5 --output out/figures/work-precision
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "bench/work_precision_panels.h"
#include "dynamics/dynamics.h"
#include "dynamics/steady_state.h"
#include "io/artifacts.h"
#include "io/named_files.h"
#include "io/publish.h"
#include "io/scene.h"
#include "report/figures.h"
#include "report/gnuplot.h"
#include "report/plot_file.h"
#include "results/reduced_body.h"
#include "signal/jumps.h"
#include "signal/response.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "system/statics.h"

namespace {

using namespace whine;

constexpr double kFollowStep = 50;   // Hz, along a branch
constexpr int kFineness = 4096;      // part of it to which the end of a branch is enclosed: 0.012 Hz
constexpr double kLeastSeconds = 1;  // of CPU per setting: shorter ones are run again
constexpr int kMostRuns = 3;
constexpr int kMostRunsToEnd = 500;
constexpr double kLowest = 1000, kHighest = 4000;  // Hz, in which branches are followed

// Steady motions that are compared. Up to 2400 Hz and at 3300 Hz rest leads to them, to the upper branch only a sweep down.
enum Motion { k1350, k3300, kLower2400, kUpper2400, kUpper2000, kMotions };
constexpr double kRestAt = 2900;  // Hz: one branch only, the upper one begins here

struct Setting {
  int steps = 0;           // per mesh period
  double sample_rate = 0;  // Hz, steps are doubled until it is reached
  int strips = 0, modes = 0, flank_points = 0;
  double element = 0;  // m
  double periodicity = 0;
  SteadyState steady_state;
  Integrator integrator;
  BodyModel body;
  ContactModel contact;
};

struct Outcome {
  std::array<double, kMotions> rms, mean, peak;  // m, m, N; below 0 (RMS): there is no such motion
  double down = -1, up = -1;          // Hz: ends of the upper and the lower branch; below 0: none found
  double deflection = 0;              // m, static
  double seconds = 0, reduction = 0;  // CPU: integration, mesh and reduction of both gears
  Outcome() {
    rms.fill(-1);
    mean.fill(0);
    peak.fill(0);
  }
};

struct Errors {
  // Largest over the motions: relative, over the static deflection, relative; Hz. Below 0: not to be had.
  double rms = 0, mean = 0, peak = 0, down = 0, up = 0;
};

Errors errors(const Outcome& a, const Outcome& b) {
  Errors e;
  for (int i = 0; i < kMotions; ++i) {
    if (a.rms[i] < 0 || b.rms[i] < 0) {
      e.rms = e.mean = e.peak = -1;
      break;
    }
    e.rms = std::max(e.rms, std::abs(a.rms[i] / b.rms[i] - 1));
    e.mean = std::max(e.mean, std::abs(a.mean[i] - b.mean[i]) / b.deflection);
    e.peak = std::max(e.peak, std::abs(a.peak[i] / b.peak[i] - 1));
  }
  const auto apart = [](double x, double y) { return x < 0 || y < 0 ? -1 : std::abs(x - y); };
  e.down = apart(a.down, b.down);
  e.up = apart(a.up, b.up);
  return e;
}

double cpu_seconds(std::clock_t since) {
  return static_cast<double>(std::clock() - since) / CLOCKS_PER_SEC;
}

// A pair integrated with one setting.
class Rig {
 public:
  Rig(const GearMeshModel& model, const DynamicParameters& parameters, const StaticResult& statics,
      const Setting& setting)
      : model_(model), statics_(statics), dynamics_(model, parameters), setting_(setting) {
    set_zone();
  }

  Outcome observe() {
    Outcome outcome;
    RollingDynamics::State state = dynamics_.rest();
    outcome.deflection = dynamics_.static_deflection();
    for (const auto& [motion, at] : {std::pair{k1350, 1350.0}, std::pair{k3300, 3300.0}}) {
      state = dynamics_.rest();
      note(motion, run(state, at), outcome);
    }
    outcome.down = follow(kRestAt, -1, [&](double f, const Orbit& orbit) {
      if (f == 2400) note(kUpper2400, orbit, outcome);
      if (f == 2000) note(kUpper2000, orbit, outcome);
    });
    outcome.up = follow(2400, 1, [&](double f, const Orbit& orbit) {
      if (f == 2400) note(kLower2400, orbit, outcome);
    });
    return outcome;
  }

 private:
  int steps_at(double mesh_frequency) const {
    int steps = setting_.steps;
    while (steps * mesh_frequency < setting_.sample_rate) steps *= 2;
    return steps;
  }

  void set_zone() {
    dynamics_.set_zone(
        candidate_zone(model_, statics_, MotionBounds(model_, statics_, std::pow(1.6, widened_))),
        steps_at(kLowest));
  }

  Orbit run(RollingDynamics::State& state, double mesh_frequency) {
    const RollingDynamics::State start = state;
    for (;;) {
      dynamics_.set_speed(mesh_frequency, steps_at(mesh_frequency));
      if (auto orbit = iterate_to_orbit(dynamics_, state, setting_.periodicity, setting_.steady_state))
        return *orbit;
      if (++widened_ > 8) fail(Failure::numerical, "at ", mesh_frequency, " Hz contact leaves the flanks");
      set_zone();
      state = start;
    }
  }

  static void note(Motion motion, const Orbit& orbit, Outcome& outcome) {
    if (orbit.multiple != 1) return;
    const RollingDynamics::Period& period = orbit.record[0];
    outcome.rms[motion] = orbit.rms;
    outcome.mean[motion] = period.transmission_error.mean();
    outcome.peak[motion] = period.tooth_pair_load.maxCoeff();
  }

  // Hz: where the branch ends that rest leads to at a speed; below 0 if it does not within the limits. visit: of the motions
  // on it.
  template <class Visit>
  double follow(double from, int direction, Visit visit) {
    struct Run {
      double mesh_frequency;
      Orbit orbit;
      RollingDynamics::State end;
    };
    std::vector<Run> sweep, runs;
    std::vector<BranchMotion> motions;
    RollingDynamics::State state = dynamics_.rest();
    const auto run_at = [&](double f, std::vector<Run>& to) {
      const Orbit orbit = run(state, f);
      to.push_back({f, orbit, state});
      return BranchMotion{f, orbit.rms, orbit.multiple};
    };
    for (double f = from; f >= kLowest && f <= kHighest; f += direction * kFollowStep) {
      motions.push_back(run_at(f, sweep));
      const size_t i = motions.size() - 1;
      if (i > 0 && may_break(motions, i)) {
        const Run* kept = &sweep[i - 1];
        BranchWalk walk;
        walk.step = direction * kFollowStep;
        walk.limit = direction > 0 ? kHighest : kLowest;
        walk.fineness = kFineness;
        runs.clear();
        runs.reserve(kMostRunsToEnd);
        walk.run = [&](double at, double) {
          if (runs.size() == runs.capacity())
            fail(Failure::numerical, "the branch at ", sweep[i - 1].mesh_frequency,
                 " Hz was not followed to its end in ", runs.size(), " runs");
          state = kept->end;
          return run_at(at, runs);
        };
        walk.keep = [&](int n) {
          kept = &runs[n];
          visit(kept->mesh_frequency, kept->orbit);
        };
        if (const auto end = branch_end(walk, motions, i))
          return end->outlived ? -1 : 0.5 * (end->last + end->next);
        state = sweep[i].end;
      }
      visit(f, sweep[i].orbit);
    }
    return -1;
  }

  const GearMeshModel& model_;
  const StaticResult& statics_;
  RollingDynamics dynamics_;
  Setting setting_;
  int widened_ = 0;
};

// The pair and its load; reduces a body anew for each discretisation and keeps it.
class Bench {
 public:
  Bench(ReducedBody driver, ReducedBody driven, StaticParameters statics, SweepParameters settings,
        double torque)
      : driver_(std::move(driver)),
        driven_(std::move(driven)),
        statics_(std::move(statics)),
        settings_(std::move(settings)),
        torque_(torque) {}

  Setting usual() const {
    return {settings_.time.steps_per_period,
            settings_.time.min_sample_rate,
            statics_.contact.strips,
            driver_.discretisation.modes,
            static_cast<int>(driver_.flank_position.size()),
            driver_.discretisation.element_size,
            settings_.time.periodicity,
            settings_.time.steady_state,
            settings_.fidelity.integrator,
            settings_.fidelity.body,
            settings_.fidelity.contact};
  }

  Outcome run(const Setting& setting, const std::string& name) {
    const Bodies& bodies = reduced(setting);
    StaticParameters settings = statics_;
    settings.contact.strips = setting.strips;
    const StaticResult statics = static_transmission(bodies.driver, bodies.driven, settings, torque_);
    DynamicParameters parameters;
    parameters.torque = torque_;
    parameters.inertia = {settings_.inertia.begin(), settings_.inertia.end()};
    parameters.mean_stiffness =
        static_transmission(bodies.driver, bodies.driven, settings, settings_.reference_torque)
            .mean_stiffness;
    parameters.damping = settings_.damping;
    parameters.fidelity = settings_.fidelity;
    parameters.fidelity.integrator = setting.integrator;
    parameters.fidelity.body = setting.body;
    parameters.fidelity.contact = setting.contact;
    const GearMeshModel model(bodies.driver, bodies.driven, settings.mesh);
    Outcome outcome;
    double least = 0, all = 0;
    for (int i = 0; i < kMostRuns && (i == 0 || all < kLeastSeconds); ++i) {
      const std::clock_t start = std::clock();
      outcome = Rig(model, parameters, statics, setting).observe();
      const double seconds = cpu_seconds(start);
      least = i == 0 ? seconds : std::min(least, seconds);
      all += seconds;
    }
    outcome.seconds = least;
    outcome.reduction = bodies.seconds;
    const auto found = [](double value) { return value < 0 ? "none" : text(value); };
    log_line("work-precision: ", name, ": ", least, " s; RMS at 2400 Hz ", found(outcome.rms[kUpper2400]),
             " and ", found(outcome.rms[kLower2400]), " m, branches end at ", found(outcome.down), " and ",
             found(outcome.up), " Hz");
    return outcome;
  }

 private:
  struct Bodies {
    ReducedBody driver, driven;
    double seconds = 0;  // of CPU, mesh and reduction
  };

  const Bodies& reduced(const Setting& setting) {
    const auto key = std::make_tuple(setting.element, setting.modes, setting.flank_points);
    const auto found = bodies_.find(key);
    if (found != bodies_.end()) return found->second;
    const auto again = [&](const ReducedBody& body) {
      BodyDiscretisation discretisation = body.discretisation;
      discretisation.element_size = setting.element;
      discretisation.modes = setting.modes;
      return reduce(make_sector_mesh(body.design, discretisation), body.material, setting.modes,
                    setting.flank_points);
    };
    const std::clock_t start = std::clock();
    Bodies bodies;
    bodies.driver = again(driver_);
    bodies.driven = driver_.compliance == driven_.compliance ? bodies.driver : again(driven_);
    bodies.seconds = cpu_seconds(start);
    log_line("work-precision: bodies with ", setting.modes, " modes, ", setting.element * 1e3, " mm, ",
             setting.flank_points, " points: ", bodies.seconds, " s");
    return bodies_.emplace(key, std::move(bodies)).first->second;
  }

  ReducedBody driver_, driven_;
  StaticParameters statics_;
  SweepParameters settings_;
  double torque_;
  std::map<std::tuple<double, int, int>, Bodies> bodies_;
};

// One choice: its settings, from the coarsest; what they are measured against comes last.
struct Axis {
  std::string name, column;
  bool of_bodies = false;  // its price is in mesh and reduction, too
  struct Point {
    double shown;
    Setting setting;
  };
  std::vector<Point> points;
  Setting reference;
  std::string against;
};

std::vector<Axis> axes(const Setting& usual) {
  std::vector<Axis> all;
  const auto vary = [&](const std::string& name, const std::string& column, const std::vector<double>& values,
                        double finest, auto set) {
    Axis axis{name, column, false, {}, usual, ""};
    for (double value : values) {
      axis.points.push_back({value, usual});
      set(axis.points.back().setting, value);
    }
    set(axis.reference, finest);
    axis.against = text(finest, " (", column, ")");
    all.push_back(axis);
  };
  const auto of_steps = [](Integrator integrator) {
    return [integrator](Setting& s, double n) {
      s.steps = static_cast<int>(n);
      s.sample_rate = 1;
      s.integrator = integrator;
    };
  };
  // Each integrator against the other.
  vary("steps, exact", "steps per period", {32, 64, 128, 256, 512}, 1024, of_steps(Integrator::exact));
  of_steps(Integrator::newmark)(all.back().reference, 1024);
  all.back().against += ", Newmark";
  vary("steps, Newmark", "steps per period", {32, 64, 128, 256, 512}, 1024, of_steps(Integrator::newmark));
  of_steps(Integrator::exact)(all.back().reference, 1024);
  all.back().against += ", exact";
  vary("strips", "strips", {4, 6, 8, 10, 15, 30}, 60,
       [](Setting& s, double n) { s.strips = static_cast<int>(n); });
  vary("modes", "elastic modes, the torsional one always", {0, 5, 21, 61}, 121,
       [](Setting& s, double n) { s.modes = static_cast<int>(n); });
  all.back().of_bodies = true;
  vary("flank table", "points", {16, 24}, 36,
       [](Setting& s, double n) { s.flank_points = static_cast<int>(n); });
  all.back().of_bodies = true;
  vary("elements", "mm", {1.2, 0.8, 0.4}, 0.2, [](Setting& s, double mm) { s.element = mm * 1e-3; });
  all.back().of_bodies = true;
  vary("periodicity", "change of the state per period", {1e-4, 1e-5, 1e-6, 1e-7}, 1e-9,
       [](Setting& s, double change) { s.periodicity = change; });
  // Not "rigid": nothing but the bearings would damp it, and it has no steady motion at most of these speeds.
  constexpr BodyModel kLevels[] = {BodyModel::quasi_static, BodyModel::relaxed, BodyModel::modal};
  vary("body", "0 quasi-static, 1 relaxed", {0, 1}, 2,
       [&](Setting& s, double level) { s.body = kLevels[static_cast<int>(level)]; });
  all.back().against = "modal";
  vary("contact", "0 line", {0}, 1,
       [](Setting& s, double level) { s.contact = level == 0 ? ContactModel::line : ContactModel::strips; });
  all.back().against = "strips";
  return all;
}

std::vector<double> row(double shown, bool of_bodies, const Outcome& outcome, const Errors& e) {
  return {shown,
          outcome.seconds + (of_bodies ? outcome.reduction : 0),
          outcome.seconds,
          outcome.reduction,
          e.rms,
          e.mean,
          e.peak,
          e.down,
          e.up};
}
std::vector<std::string> columns(const std::string& setting) {
  return {"setting [" + setting + "]",     "CPU drawn [s]",  "CPU of the integration [s]",
          "CPU of mesh and reduction [s]", "RMS [1]",        "mean [static deflection]",
          "peak tooth load [1]",           "jump down [Hz]", "jump up [Hz]"};
}
void print(const FigureBlock& block, const std::string& against) {
  std::printf("%s, against %s\n  %10s %8s %9s %10s %10s %10s %10s %10s\n", block.name.c_str(),
              against.c_str(), "", "integration s", "bodies s", "RMS", "mean", "peak load", "down Hz",
              "up Hz");
  for (const auto& values : block.rows) {
    std::printf("  %10g %8.2f %9.2f", values[0], values[2], values[3]);
    for (size_t c = 4; c < values.size(); ++c)
      if (values[c] < 0)
        std::printf(" %10s", "-");
      else
        std::printf(" %10.1e", values[c]);
    std::printf("\n");
  }
  std::fflush(stdout);
}

void body(int argc, char** argv) {
  whine::Options options{"Error against CPU time of each numerical choice", "whine-work-precision"};
  std::string statics, sweeps, output, torque = "150", damping = "5.5e-6", plots = "pipelines/plots";
  std::vector<std::string> bodies;
  options.add("--static-params", statics, "stage parameters of the scene: out/<scene>/params/static.toml")
      .required();
  options.add("--sweep-params", sweeps, "stage parameters of the scene: out/<scene>/params/sweep.toml")
      .required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--output", output, "path of the results without extension").required();
  options.add("--torque", torque, "torque on the driver in N m, above 0").show_default();
  options.add("--rayleigh-stiffness", damping, "in s; small enough for two branches at 2400 Hz")
      .show_default();
  options.add("--plots", plots, "folder of the gnuplot templates").show_default();
  options.parse(argc, argv);

  SweepParameters settings = read_sweep_parameters(sweeps);
  settings.damping.rayleigh_stiffness = number_option("--rayleigh-stiffness", damping);
  if (!(settings.damping.rayleigh_stiffness > 0))
    fail(Failure::usage, "--rayleigh-stiffness = ", damping, " must be above 0");
  const double load = number_option("--torque", torque);
  const StaticParameters rest = read_static_parameters(statics);
  const std::vector<std::string> paths = NamedFiles("--body", bodies).of(rest.mesh);
  Bench bench(read<ReducedBody>(paths[0]), read<ReducedBody>(paths[1]), rest, settings, load);
  const Setting usual = bench.usual();
  const Outcome present = bench.run(usual, "the scene's settings");
  if (*std::min_element(present.rms.begin(), present.rms.end()) < 0 || present.down < 0 || present.up < 0 ||
      !like_a_jump(present.rms[kUpper2400], present.rms[kLower2400]))
    fail(Failure::input, "at ", load, " N m and a Rayleigh stiffness of ", damping,
         " s there are no two branches at 2400 Hz; lower --rayleigh-stiffness");

  Figure figure;
  figure.title = text("Error against CPU time, ", torque, " N m, η = ", damping, " s");
  figure.notes = {
      "one choice varied at a time about the scene's settings (ring), against its finest; tooth loads and transmission error: worst of five steady motions",
      "3300 and 1350 Hz, 2400 Hz on both branches, 2000 Hz on the upper one; jumps: ends of the branches; CPU of the integration, for modes, flank table and elements with mesh and reduction"};
  FigureBlock circles{"scene", columns("axis"), {}};
  std::vector<Axis> choices = axes(usual);
  for (size_t i = 0; i < choices.size(); ++i) {
    const Axis& axis = choices[i];
    const Outcome reference = bench.run(axis.reference, axis.name + " against " + axis.against);
    FigureBlock block{axis.name, columns(axis.column), {}};
    for (const Axis::Point& point : axis.points) {
      const Outcome outcome = bench.run(point.setting, text(axis.name, " ", point.shown));
      block.rows.push_back(row(point.shown, axis.of_bodies, outcome, errors(outcome, reference)));
    }
    if (axis.name != "body" && axis.name != "contact")  // measured against the scene's own model level
      circles.rows.push_back(
          row(static_cast<double>(i), axis.of_bodies, present, errors(present, reference)));
    print(block, axis.against);
    figure.blocks.push_back(block);
  }
  print(circles, "the finest of each of the above by number: the scene's settings");

  Setting fine = usual, coarser = usual;
  fine.sample_rate = coarser.sample_rate = 1;
  fine.steps = 512, coarser.steps = 256;
  fine.integrator = Integrator::newmark, coarser.integrator = Integrator::exact;
  fine.strips = 20, coarser.strips = 15;
  fine.modes = 121, coarser.modes = 91;
  fine.flank_points = 36, coarser.flank_points = 30;
  fine.element = 0.2e-3, coarser.element = 0.3e-3;
  fine.periodicity = 1e-8, coarser.periodicity = 1e-7;
  const Outcome best = bench.run(fine, "all finer, Newmark"),
                second = bench.run(coarser, "one level coarser");
  FigureBlock together{"together", columns("0 scene, 1 reference one level coarser"), {}};
  together.rows = {row(0, false, present, errors(present, best)),
                   row(1, false, second, errors(second, best))};
  print(together,
        "all finer at once, by Newmark; 0: the scene's settings, 1: the reference one level coarser");
  figure.blocks.push_back(circles);
  figure.blocks.push_back(together);
  add_work_precision_panels(choices.size(), kFollowStep / kFineness, figure);

  const std::string recipe = template_of(figure, plots, "work-precision");
  const PlotFile data(figure);
  std::vector<FileBytes> files = table_files(
      figure, output,
      {recorded_path(statics), recorded_path(sweeps), recorded_path(paths[0]), recorded_path(paths[1])});
  files.push_back({output + ".svg", draw(figure, data.path(), recipe, Picture::svg)});
  files.push_back({output + ".png", draw(figure, data.path(), recipe, Picture::png)});
  publish_all(files);
  log_line("work-precision -> ", output, ".{tsv,svg,png}");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
