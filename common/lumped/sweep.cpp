#include "lumped/sweep.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/progress.h"
#include "gear/pair.h"
#include "gear/train.h"
#include "lumped/period_map.h"
#include "lumped/stiffness.h"
#include "orbits/branch.h"
#include "orbits/recurrence.h"
#include "signal/jumps.h"
#include "signal/rms.h"

namespace whine {

using State = LumpedOscillator::State;
using Matrix = LumpedOscillator::Matrix;

namespace {

constexpr double kClose = 1e-2;         // change per period from which Newton's method is tried
constexpr double kFarthestStart = 0.1;  // that it may lead away
constexpr double kRoundOff = 1e-13;     // of the state
constexpr int kLongestPause = 64;    // periods of plain integration after a Newton's method that led nowhere
constexpr int kFollowPeriods = 500;  // where a branch is followed, before it counts as ended
constexpr double kFinest = 1e-7;     // Hz: steps of that are halved down to this

double modulus(const Matrix& m) {
  const double half = 0.5 * m.trace(), det = m.determinant(), root = half * half - det;
  return root > 0 ? std::abs(half) + std::sqrt(root) : std::sqrt(det);
}

State image_after(LumpedOscillator& oscillator, State y, int multiple, Matrix* derivative) {
  if (derivative) derivative->setIdentity();
  for (int i = 0; i < multiple; ++i) oscillator.integrate(y, derivative);
  return y;
}

// Newton's method on P^multiple(y) = y. False if it does not converge.
bool solve_orbit(LumpedOscillator& oscillator, LumpedOrbit& orbit, int multiple) {
  constexpr int kMostIterations = 12;
  LumpedPeriodMap map(oscillator);
  const OrbitSearch search =
      newton_orbit(map, map.flat(orbit.start), multiple, OrbitSettings{kRoundOff, kMostIterations});
  orbit.periods += multiple * (search.orbit.iterations + 1);
  if (!search.found()) return false;
  orbit.start = map.state(search.orbit.start);
  orbit.residual = search.orbit.residual;
  const State unit = oscillator.unit();
  orbit.monodromy = unit.asDiagonal() * search.orbit.slow.matrix() * unit.cwiseInverse().asDiagonal();
  orbit.multiple = multiple;
  return true;
}

void record(LumpedOscillator& oscillator, LumpedOrbit& orbit) {
  State y = orbit.start;
  orbit.record.clear();
  orbit.energy_balance = {};
  double mean = 0, square = 0;
  const int periods = orbit.multiple > 0 ? orbit.multiple : Recurrence<State>::kMostMultiple;
  for (int i = 0; i < periods; ++i) {
    orbit.record.push_back(oscillator.record(y, orbit.energy_balance));
    mean += orbit.record.back().mean / periods;
    square += orbit.record.back().mean_square / periods;
  }
  orbit.mean = mean;
  orbit.rms = oscillating_rms(mean - oscillator.reference(), square);
}

BranchPoint branch_point(double mesh_frequency, const LumpedOrbit& orbit) {
  BranchPoint point{mesh_frequency, orbit.rms, 0, 0, false};
  for (const LumpedRecord& period : orbit.record) {
    point.tooth_load_max = std::max(point.tooth_load_max, period.load.maxCoeff());
    point.sustained_load =
        std::max(point.sustained_load, sustained_load(period.load, static_cast<int>(period.load.rows())));
    point.parted = point.parted || !(period.load.rowwise().sum().minCoeff() > 0);
  }
  return point;
}

BranchMotion branch_motion(double mesh_frequency, const LumpedOrbit& orbit) {
  return {mesh_frequency, orbit.rms, orbit.multiple};
}

// Between the speeds i - 1 and i of a sweep; kept: the orbit at speed i - 1.
std::optional<LumpedJump> jump_from(LumpedOscillator& oscillator, const std::vector<BranchMotion>& motions,
                                    size_t i, const LumpedOrbit& kept, double periodicity,
                                    bool integrate_only, std::vector<BranchPoint>& left_early) {
  LumpedOrbit branch = kept;
  std::vector<std::pair<double, LumpedOrbit>> runs;  // by speed, Hz
  BranchContinuation follower;
  follower.finest = kFinest;
  follower.run = [&](double mesh_frequency, double) {
    oscillator.set_speed(mesh_frequency);
    runs.emplace_back(mesh_frequency, iterate_to_orbit(oscillator, branch.start, periodicity, integrate_only,
                                                       kFollowPeriods));
    return branch_motion(mesh_frequency, runs.back().second);
  };
  follower.keep = [&](int n) {
    branch = runs[n].second;
    return branch_point(runs[n].first, branch);
  };
  const auto jump = find_jump(
      motions, i, [&] { return follower; }, &left_early);
  if (!jump) return std::nullopt;
  if (jump->located)
    if (const auto fold = find_fold(oscillator, branch.start, jump->last, branch.multiple))
      if (std::abs(fold->mesh_frequency - jump->last) < 1e3 * jump->width)
        return LumpedJump{fold->mesh_frequency, jump->width, true, fold->start};
  return LumpedJump{jump->frequency, jump->width, false, jump->located ? branch.start : kept.start};
}

}  // namespace

double LumpedOrbit::largest_multiplier() const {
  return modulus(monodromy);
}

LumpedOrbit iterate_to_orbit(LumpedOscillator& oscillator, const State& start, double periodicity,
                             bool integrate_only, int most_periods) {
  LumpedOrbit orbit;
  State y = start;
  Recurrence<State> recurrence(periodicity, y);
  int pause = 0, patience = 1;
  const auto away = [&](const State& a, const State& b) {
    return oscillator.size(a - b) / std::max(1e-300, oscillator.size(b));
  };
  // Newton's method on P^m(y) = y, if it leads to an orbit nearby that is stable and no shorter one's.
  const auto newton = [&](int m) -> std::optional<LumpedOrbit> {
    const double change = recurrence.change(m);
    LumpedOrbit tried = orbit;
    tried.start = y;
    const bool found = solve_orbit(oscillator, tried, m);
    orbit.periods = tried.periods;
    if (!found) return std::nullopt;
    const double rho = modulus(tried.monodromy), moved = away(tried.start, y);
    for (int d = 1; d < m; ++d)
      if (m % d == 0 && away(image_after(oscillator, tried.start, d, nullptr), tried.start) < 1e-6)
        return std::nullopt;
    if (!(rho < 1 && moved < kFarthestStart && moved * (1 - rho) < 10 * change + kRoundOff))
      return std::nullopt;
    return tried;
  };
  for (int n = 1; n <= most_periods; ++n) {
    report_step("mesh period", n, most_periods);
    oscillator.integrate(y);
    ++orbit.periods;
    recurrence.compare(y, n, away);
    for (int m = 1; m <= recurrence.known(); ++m) {
      if (!recurrence.primitive(m, integrate_only)) continue;
      const double change = recurrence.change(m);
      if (!integrate_only && change < kClose && pause == 0) {
        if (auto found = newton(m)) {
          record(oscillator, *found);
          return *found;
        }
        pause = patience = std::min(2 * patience, kLongestPause);
      }
      if (change < (integrate_only ? periodicity : std::min(periodicity, 10 * kRoundOff))) {
        orbit.start = y;
        orbit.multiple = m;
        orbit.residual = change;
        image_after(oscillator, y, m, &orbit.monodromy);
        record(oscillator, orbit);
        return orbit;
      }
    }
    pause = std::max(0, pause - 1);
    recurrence.keep(y, n);
  }
  orbit.start = y;
  orbit.residual = recurrence.change(1);
  record(oscillator, orbit);
  return orbit;
}

std::optional<LumpedFold> find_fold(LumpedOscillator& oscillator, const State& start, double mesh_frequency,
                                    int multiple) {
  LumpedPeriodMap map(oscillator);
  map.set_parameter(mesh_frequency);
  const FoldSearch fold = locate_fold(map, map.flat(start), multiple, mesh_frequency);
  if (!fold.found()) return std::nullopt;
  return LumpedFold{fold.parameter, map.state(fold.start)};
}

LumpedSpeeds integrate_speeds(LumpedOscillator& oscillator, const std::vector<double>& speeds,
                              double periodicity, bool integrate_only,
                              const std::function<void(long, long, const std::string&)>& report) {
  LumpedSpeeds out;
  State state = oscillator.rest();
  std::vector<BranchMotion> motions;
  const long total = static_cast<long>(speeds.size());
  for (long i = 0; i < total; ++i) {
    report(i, total, text(speeds[i], " Hz"));
    oscillator.set_speed(speeds[i]);
    out.orbits.push_back(iterate_to_orbit(oscillator, state, periodicity, integrate_only));
    const LumpedOrbit& orbit = out.orbits.back();
    state = orbit.start;
    motions.push_back(branch_motion(speeds[i], orbit));
    report(i + 1, total, text(speeds[i], " Hz, ", orbit.periods, " periods"));
  }
  for (size_t i = 1; i < motions.size(); ++i)
    if (may_break(motions, i))
      if (const auto jump = jump_from(oscillator, motions, i, out.orbits[i - 1], periodicity, integrate_only,
                                      out.left_early))
        out.jumps.push_back(*jump);
  return out;
}

double reduced_mass(const StaticResult& statics, const std::array<double, kSides>& inertia) {
  const double r1 = ToothGeometry(statics.gear[0].design).base_radius(),
               r2 = ToothGeometry(statics.gear[1].design).base_radius();
  return inertia[0] * inertia[1] / (inertia[0] * r2 * r2 + inertia[1] * r1 * r1);
}

namespace {

// Throws Error(input) for values that make no model. Speeds (Hz) in the order of the sweep.
std::vector<double> checked_speeds(const LumpedOptions& o) {
  if (!(o.mass > 0) || !std::isfinite(o.mass))
    fail(Failure::input, "lumped model: the mass is ", o.mass, " kg; it must be above 0");
  if (!(o.damping_ratio >= 0 && o.damping_ratio < 1))
    fail(Failure::input, "lumped model: the damping ratio is ", o.damping_ratio,
         "; it must be 0 or above and below 1 (0.08 for 8 %)");
  return swept_speeds(o, o.direction);
}

// A sweep without its motions.
SweepResult described(const StaticResult& statics, const LumpedParameters& springs, const GearPair& pair,
                      const LumpedOptions& o) {
  SweepResult a;
  a.model = o.model;
  a.lumped = springs;
  static_cast<GearPairParameters&>(a) = statics;
  a.fidelity.body = BodyModel::rigid;
  a.fidelity.integrator = o.integrator;
  a.time = o.time;
  a.time.min_sample_rate = 0;
  a.damping = {};
  a.damping.rayleigh_stiffness = a.damping.bearing_ratio = 0;
  a.torque = statics.torque;
  // m = I1 I2 / (I1 r2^2 + I2 r1^2) with equal shares.
  for (int g = 0; g < kSides; ++g) a.inertia[g] = 2 * o.mass * std::pow(pair.gear(g).base_radius(), 2);
  a.place_pair(pair_system(a));
  a.direction = o.direction;
  return a;
}

// The motions of all speeds. m: the least transmission error.
double store_motions(const LumpedSpeeds& run, const Eigen::VectorXi& numbers, SweepResult& a) {
  const int count = static_cast<int>(run.orbits.size()), samples = a.time.steps_per_period;
  // Several springs may stand for one pair.
  std::vector<int> pairs(numbers.data(), numbers.data() + numbers.size());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  a.pair = Eigen::Map<const Eigen::VectorXi>(pairs.data(), static_cast<Eigen::Index>(pairs.size()));
  a.periods.resize(count);
  a.residual.resize(count);
  a.period_multiple.resize(count);
  a.energy_imbalance.resize(count);
  a.energy = MatrixRM::Zero(count, static_cast<Eigen::Index>(kEnergyLines.size()));
  a.drift_force = Eigen::VectorXd::Zero(count);
  std::size_t longest = 1;
  for (const LumpedOrbit& orbit : run.orbits) longest = std::max(longest, orbit.record.size());
  const auto width = static_cast<Eigen::Index>(longest) * samples;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i) {
    const LumpedOrbit& orbit = run.orbits[i];
    a.periods[i] = orbit.periods;
    a.residual[i] = orbit.residual;
    a.period_multiple[i] = orbit.multiple;
    const LumpedEnergyBalance& l = orbit.energy_balance;
    a.energy_imbalance[i] = l.imbalance() / l.throughput;
    a.energy(i, energy_line("kinetic")) = l.kinetic;
    a.energy(i, energy_line("local")) = l.spring;
    a.energy(i, energy_line("drive")) = l.force;
    a.energy(i, energy_line("rolling")) = l.switching;
    a.energy(i, energy_line("modal_damping")) = l.damping;
    a.energy(i, energy_line("throughput")) = l.throughput;
    MatrixRM error(width, 1), loads = MatrixRM::Zero(width, a.pair.size());
    for (std::size_t k = 0; k < longest; ++k) {
      const LumpedRecord& r = orbit.record[k % orbit.record.size()];
      error.col(0).segment(static_cast<Eigen::Index>(k) * samples, samples) = r.x;
      for (Eigen::Index spring = 0, pair = 0; spring < numbers.size(); ++spring) {
        pair += spring > 0 && numbers[spring] != numbers[spring - 1];
        loads.col(pair).segment(static_cast<Eigen::Index>(k) * samples, samples) += r.load.col(spring);
      }
      least = std::min(least, r.least);
      a.least_gap = std::min(a.least_gap, -r.largest_exit);
    }
    a.transmission_error.push_back(std::move(error));
    a.mesh_force.emplace_back(loads.rowwise().sum());
    a.tooth_load.push_back(std::move(loads));
  }
  return least;
}

}  // namespace

SweepResult lumped_sweep(const StaticResult& statics, LumpedParameters springs,
                         const Eigen::VectorXi& numbers, const LumpedOptions& o,
                         const std::function<void(long, long, const std::string&)>& report,
                         std::vector<BranchPoint>* left_early) {
  const std::vector<double> speeds = checked_speeds(o);
  const GearPair pair(statics);
  const double force = statics.torque / pair.gear(0).base_radius();
  const int samples = o.time.steps_per_period, steps = o.integrator == Integrator::newmark ? samples : 0;
  springs.mass = o.mass;
  springs.damping_ratio = o.damping_ratio;
  springs.damper_acts = o.damper_acts;
  springs.damper = 0;
  const double stiffness = LumpedOscillator(springs, force, samples).mean_stiffness();
  springs.damper = 2 * o.damping_ratio * std::sqrt(stiffness * o.mass);
  LumpedOscillator oscillator(springs, force, samples, steps);

  const LumpedSpeeds run = integrate_speeds(oscillator, speeds, o.time.periodicity,
                                            o.time.steady_state == SteadyState::integrate, report);

  if (left_early) *left_early = run.left_early;

  SweepResult a = described(statics, springs, pair, o);
  a.mean_stiffness = stiffness;
  a.natural_frequency = oscillator.mean_frequency();
  a.mesh_frequency =
      Eigen::Map<const Eigen::VectorXd>(speeds.data(), static_cast<Eigen::Index>(speeds.size()));
  const double least = store_motions(run, numbers, a);
  a.backlash_margin =
      statics.tooth_thinning() > 0 ? pair.backlash() + least : std::numeric_limits<double>::infinity();
  a.jump_frequency.resize(static_cast<Eigen::Index>(run.jumps.size()));
  a.jump_width.resize(a.jump_frequency.size());
  for (std::size_t j = 0; j < run.jumps.size(); ++j) {
    a.jump_frequency[static_cast<Eigen::Index>(j)] = run.jumps[j].mesh_frequency;
    a.jump_width[static_cast<Eigen::Index>(j)] = run.jumps[j].width;
  }
  return a;
}

JumpMapResult lumped_jump_map(const StaticResult& statics, LumpedParameters springs,
                              const Eigen::VectorXi& numbers, LumpedOptions options, const MapSpeeds& speeds,
                              const std::vector<double>& damping_ratio,
                              const std::function<void(long, long, const std::string&)>& report) {
  if (damping_ratio.empty()) fail(Failure::input, "no case: give one damping ratio at least");
  for (double ratio : damping_ratio)
    if (!(ratio > 0 && ratio < 1))
      fail(Failure::input, "a damping ratio of ", ratio, "; it must be above 0 and below 1");
  springs.mass = options.mass;
  springs.damper = 0;
  springs.damper_acts = options.damper_acts;
  const GearPair pair(statics);
  const LumpedOscillator at_rest(springs, statics.torque / pair.gear(0).base_radius(),
                                 options.time.steps_per_period);
  const Eigen::VectorXd speed = map_speeds(speeds, at_rest.natural_frequency());
  options.frequency_from = speed[0];
  options.frequency_to = speed[speed.size() - 1];
  options.frequency_step = speeds.step;

  JumpMapResult map;
  map.model = options.model;
  map.damper_acts = options.damper_acts;
  static_cast<GearPairParameters&>(map) = statics;
  map.torque = statics.torque;
  map.mean_stiffness = at_rest.mean_stiffness();
  map.first_harmonic = at_rest.first_harmonic();
  const RectangularWave& zones = statics.rectangular_wave;
  const double middle = 0.5 * (zones.high_begin + zones.high_end);
  map.two_pair_frequency = at_rest.frequency_at(middle);
  if (((statics.tooth_load.array() > 0).rowwise().count() == 1).any())
    map.one_pair_frequency = at_rest.frequency_at(middle + 0.5);
  const auto n = static_cast<Eigen::Index>(damping_ratio.size());
  start_cases(map, n, speed, speeds.load_frequency);
  for (Eigen::Index c = 0; c < n; ++c) {
    options.damping_ratio = map.damping_ratio[c] = damping_ratio[c];
    map.excitation[c] = map.first_harmonic / map.mean_stiffness / (2 * damping_ratio[c]);
    add_case(map, c, speeds.step, [&](Direction direction, std::vector<BranchPoint>& beyond) {
      options.direction = direction;
      const SweepResult swept = lumped_sweep(
          statics, springs, numbers, options, [](long, long, const std::string&) {}, &beyond);
      static_cast<MotionParameters&>(map) = swept;
      report(2 * c + (direction == Direction::up ? 1 : 2), 2 * n, text("damping ratio ", damping_ratio[c]));
      return swept;
    });
  }
  return map;
}

}  // namespace whine
