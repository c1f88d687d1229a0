#include "signal/response.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/error.h"
#include "signal/branches.h"
#include "signal/jumps.h"
#include "signal/rms.h"
#include "signal/spectrum.h"

namespace whine {
namespace {

void require_length(const char* what, size_t length, Eigen::Index speeds) {
  if (static_cast<Eigen::Index>(length) != speeds)
    fail(Failure::input, "sweep: ", what, " has ", length, " rows, mesh_frequency has ", speeds);
}

void require_periods(const SweepResult& s) {
  const int steps = s.time.steps_per_period;
  const Eigen::Index samples = s.samples();
  if (steps < 1 || samples % steps != 0)
    fail(Failure::input, "sweep: ", samples, " samples are no whole number of periods of ", steps, " steps");
  if (s.hunting_periods < 1 || samples / steps % s.hunting_periods != 0)
    fail(Failure::input, "sweep: ", samples / steps,
         " mesh periods are no whole number of hunting periods of ", s.hunting_periods);
  if (s.jump_width.size() != s.jump_frequency.size())
    fail(Failure::input, "sweep: ", s.jump_frequency.size(), " jumps, but ", s.jump_width.size(), " widths");
  for (Eigen::Index f = 0; f < s.mesh_frequency.size(); ++f)
    if (s.period_multiple[f] < 0 || s.period_multiple[f] * steps > samples)
      fail(Failure::input, "sweep: period_multiple is ", s.period_multiple[f], " at ", s.mesh_frequency[f],
           " Hz; 0 is the least, and ", samples, " samples of ", steps, " per period the most");
}

// Of the meshes of a train, each of which is of one [[mesh]].
void require_sections(const SweepResult& s) {
  const std::vector<int>& section = s.section;
  if (s.meshes() == 0 || section.size() != s.layout.meshes.size())
    fail(Failure::input, "sweep: ", s.meshes(), " meshes, of which ", section.size(),
         " have a number of their [[mesh]]; 1 is the least, and all need one");
  if (const int least = *std::min_element(section.begin(), section.end()); least < 0)
    fail(Failure::input, "sweep: a mesh is of [[mesh]] number ", least, "; 0 is the least");
}

void require_shapes(const SweepResult& s) {
  const Eigen::Index speeds = s.mesh_frequency.size(), samples = s.samples();
  if (speeds == 0) fail(Failure::input, "sweep: it holds no speed; 1 is the least");
  require_length("period_multiple", static_cast<size_t>(s.period_multiple.size()), speeds);
  if (s.of_train()) require_sections(s);
  const auto require_rows = [&](const char* what, const std::vector<MatrixRM>& rows, Eigen::Index columns) {
    require_length(what, rows.size(), speeds);
    for (const MatrixRM& one : rows) {
      if (one.rows() != samples || one.cols() != columns)
        fail(Failure::input, "sweep: ", what, " is ", one.rows(), " x ", one.cols(), ", expected ", samples,
             " x ", columns);
      if (!one.allFinite()) fail(Failure::input, "sweep: ", what, " holds a number that is not finite");
    }
  };
  if (s.pair.size() == 0) fail(Failure::input, "sweep: tooth_load is of no pair; 1 is the least");
  require_rows("transmission_error", s.transmission_error, s.meshes());
  require_rows("mesh_force", s.mesh_force, s.meshes());
  require_rows("tooth_load", s.tooth_load, s.meshes() * s.pair.size());
  if (static_cast<Eigen::Index>(s.bearing_force.size()) != s.bodies())
    fail(Failure::input, "sweep: bearing_force is of ", s.bearing_force.size(), " bodies, expected ",
         s.bodies());
  for (const auto& rows : s.bearing_force)
    if (s.of_train() || !rows.empty()) require_rows("bearing_force", rows, 2);
  if (!s.root_stress.empty()) {
    require_rows("root_stress", s.root_stress, s.meshes() * kSides);
    for (const MatrixRM* place : {&s.root_stress_angle, &s.root_stress_phase})
      if (place->rows() != speeds || place->cols() != s.meshes() * kSides)
        fail(Failure::input, "sweep: the place of the root stress is ", place->rows(), " x ", place->cols(),
             ", expected ", speeds, " x ", s.meshes() * kSides);
  }
  require_periods(s);
}

}  // namespace

bool like_a_jump(double rms, double other) {
  constexpr double kRatio = 1.2;
  return std::max(rms, other) > kRatio * std::min(rms, other);
}

std::string speed_ranges(const std::map<double, bool>& speeds) {
  std::string ranges;
  for (auto first = speeds.begin(); first != speeds.end(); ++first) {
    if (!first->second) continue;
    auto last = first;
    while (std::next(last) != speeds.end() && std::next(last)->second) ++last;
    ranges += text(ranges.empty() ? "" : ", ", std::lround(first->first));
    if (last != first) ranges += text(" to ", std::lround(last->first));
    first = last;
  }
  return ranges;
}

Eigen::Index row_before(const Eigen::VectorXd& frequency, double f) {
  for (Eigen::Index i = 0; i + 1 < frequency.size(); ++i)
    if ((frequency[i] - f) * (frequency[i + 1] - f) <= 0) return i;
  return -1;
}

std::vector<Eigen::Index> rows_before_jumps(const ResponseResult& r) {
  constexpr Eigen::Index kEarly = 10;  // steps that a sweep may leave a branch before its end
  std::vector<BranchMotion> sweep;
  for (Eigen::Index i = 0; i < r.mesh_frequency.size(); ++i)
    sweep.push_back({r.mesh_frequency[i], r.dte_rms.row(i).norm(), r.period_multiple[i]});
  std::vector<Eigen::Index> rows;
  for (const double f : r.jump_frequency) {
    const Eigen::Index last = row_before(r.mesh_frequency, f);
    rows.push_back(last);
    if (last < 0 || may_break(sweep, static_cast<size_t>(last) + 1)) continue;
    for (Eigen::Index i = last; i >= 0 && i > last - kEarly; --i)
      if (like_a_jump(sweep[static_cast<size_t>(i)].rms, sweep[static_cast<size_t>(i) + 1].rms)) {
        rows.back() = i;
        break;
      }
  }
  return rows;
}

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Samples = Eigen::Ref<const VectorXd>;

// What a result holds of each mesh; samples: of a mesh period, hence how many harmonics.
void size_meshes(Index samples, Index speeds, Index meshes, ResponseResult& r) {
  const int count = resolved_harmonics(samples, kResponseHarmonics);
  if (count < 1)
    fail(Failure::input, "sweep: ", samples,
         " samples per mesh period do not resolve the mesh frequency; raise steps_per_period");
  for (MatrixRM* x : {&r.dte_rms, &r.dte_mean, &r.tooth_load_max, &r.mesh_force_max, &r.separation_fraction,
                      &r.separations_per_period})
    x->resize(speeds, meshes);
  r.dte_harmonic.assign(static_cast<size_t>(speeds), MatrixRM(count, meshes));
  r.mesh_force_harmonic = r.dte_harmonic;
  if (r.hunting_periods > 1)
    for (MatrixRM* x : {&r.residual_rms, &r.residual_kurtosis}) x->resize(speeds, meshes);
  if (r.hunting_periods > 1)
    r.dte_order.assign(static_cast<size_t>(speeds), MatrixRM(count * r.hunting_periods, meshes));
}

void size_bearings(Index bodies, ResponseResult& r) {
  for (MatrixRM* x : {&r.bearing_force_max, &r.bearing_force_rms})
    x->setZero(r.mesh_frequency.size(), bodies);
  r.bearing_force_harmonic.assign(r.dte_harmonic.size(), MatrixRM::Zero(r.dte_harmonic[0].rows(), bodies));
}

// Of a mesh at a speed, over `periods` mesh periods after which its motion repeats.
void add_mesh(const Samples& transmission_error, const Samples& force, int periods, Index f, Index m,
              ResponseResult& r) {
  const auto at = static_cast<size_t>(f);
  const auto count = static_cast<int>(r.dte_harmonic[at].rows());
  const Harmonics dte = harmonics(transmission_error, count, periods);
  r.dte_rms(f, m) = dte.rms;
  r.dte_mean(f, m) = dte.mean;
  r.dte_harmonic[at].col(m) = dte.amplitude;
  r.mesh_force_harmonic[at].col(m) = harmonics(force, count, periods).amplitude;
  if (r.hunting_periods > 1) {
    r.dte_order[at].col(m) =
        harmonics(transmission_error, count * r.hunting_periods, periods / r.hunting_periods).amplitude;
    const VectorXd residual = residual_signal(transmission_error, periods);
    r.residual_rms(f, m) = oscillating_rms({residual});
    r.residual_kurtosis(f, m) = kurtosis(residual);
  }
  const Separations apart = separations(force);
  r.mesh_force_max(f, m) = force.maxCoeff();
  r.separation_fraction(f, m) = apart.fraction;
  r.separations_per_period(f, m) = static_cast<double>(apart.intervals) / periods;
}

// force: (sample, xy) over the same periods.
void add_bearing(const Eigen::Ref<const MatrixRM>& force, int periods, Index f, Index body,
                 ResponseResult& r) {
  MatrixRM& amplitude = r.bearing_force_harmonic[static_cast<size_t>(f)];
  const auto count = static_cast<int>(amplitude.rows());
  const VectorXd x = harmonics(force.col(0), count, periods).amplitude,
                 y = harmonics(force.col(1), count, periods).amplitude;
  amplitude.col(body) = (x.array().square() + y.array().square()).sqrt();
  r.bearing_force_max(f, body) = force.rowwise().norm().maxCoeff();
  r.bearing_force_rms(f, body) = oscillating_vector_rms(force);
}

// Root stress over speed.
void add_root_stress(const SweepResult& s, ResponseResult& r) {
  if (s.root_stress.empty()) return;
  r.root_stress_angle = s.root_stress_angle;
  r.root_stress_phase = s.root_stress_phase;
  for (MatrixRM* x : {&r.root_stress_max, &r.root_stress_sustained})
    x->resize(s.mesh_frequency.size(), s.meshes() * kSides);
  for (Index f = 0; f < s.mesh_frequency.size(); ++f) {
    const MatrixRM& stress = s.root_stress[static_cast<size_t>(f)];
    r.root_stress_max.row(f) = stress.colwise().maxCoeff();
    for (Index side = 0; side < stress.cols(); ++side)
      r.root_stress_sustained(f, side) =
          sustained_load(stress.col(side), s.time.steps_per_period, s.period_multiple[f]);
  }
}

// Of a train: largest share of each mesh in what those of its [[mesh]] carry together.
void add_load_share(const SweepResult& s, const MatrixRM& force, Index f, ResponseResult& r) {
  const std::vector<int>& section = s.section;
  VectorXd together(1 + *std::max_element(section.begin(), section.end()));
  for (Index n = 0; n < force.rows(); ++n) {
    together.setZero();
    for (Index m = 0; m < force.cols(); ++m) together[section[static_cast<size_t>(m)]] += force(n, m);
    for (Index m = 0; m < force.cols(); ++m)
      if (const double all = together[section[static_cast<size_t>(m)]]; all > 0)
        r.load_share_max(f, m) = std::max(r.load_share_max(f, m), std::min(1.0, force(n, m) / all));
  }
}

// Loads of the tooth pairs of a mesh at a speed, and what is sustained of them for 1/64 of a mesh period.
void add_tooth_loads(const SweepResult& s, Index f, Index m, ResponseResult& r) {
  const auto loads = s.loads_of(f, m);
  r.tooth_load_max(f, m) = loads.maxCoeff();
  if (r.tooth_load_sustained.size() == 0) return;
  r.tooth_load_sustained(f, m) = sustained_load(loads, s.time.steps_per_period);
  r.mesh_force_sustained(f, m) = sustained_load(s.mesh_force[static_cast<size_t>(f)].col(m),
                                                s.time.steps_per_period, s.period_multiple[f]);
}

}  // namespace

ResponseResult response(const SweepResult& s) {
  require_shapes(s);
  const Index speeds = s.mesh_frequency.size(), per_period = s.time.steps_per_period, meshes = s.meshes();
  ResponseResult r;
  static_cast<MotionSource&>(r) = s;
  r.name_parts();
  r.direction = s.direction;
  r.model = s.model;
  r.mesh_frequency = s.mesh_frequency;
  r.hunting_periods = s.hunting_periods;
  r.jump_frequency = s.jump_frequency;
  r.jump_width = s.jump_width;
  r.periods = s.periods;
  r.period_multiple = s.period_multiple;
  r.energy_imbalance = s.energy_imbalance;
  r.remarks = s.remarks;
  r.natural_frequency = s.natural_frequency;
  r.backlash_left = s.backlash_left;
  r.face_load_factor = s.face_load_factor;
  r.line_load_max = s.line_load_max;
  size_meshes(per_period, speeds, meshes, r);
  const auto borne = [](const std::vector<MatrixRM>& force) { return !force.empty(); };
  if (std::any_of(s.bearing_force.begin(), s.bearing_force.end(), borne)) size_bearings(s.bodies(), r);
  add_root_stress(s, r);
  if (s.of_train() || !s.root_stress.empty() || s.face_load_factor.size() > 0)
    for (MatrixRM* x : {&r.tooth_load_sustained, &r.mesh_force_sustained}) x->resize(speeds, meshes);
  // Of the meshes of one [[mesh]].
  const std::set<int> sections(s.section.begin(), s.section.end());
  if (s.of_train() && static_cast<Index>(sections.size()) < meshes) r.load_share_max.setZero(speeds, meshes);
  for (Index f = 0; f < speeds; ++f) {
    const auto at = static_cast<size_t>(f);
    // What one motion fills of its row; one that is not periodic fills it all.
    const Index samples = s.period_multiple[f] > 0 ? s.period_multiple[f] * per_period : s.samples();
    const auto periods = static_cast<int>(samples / per_period);
    for (Index m = 0; m < meshes; ++m) {
      add_mesh(s.transmission_error[at].col(m).head(samples), s.mesh_force[at].col(m).head(samples), periods,
               f, m, r);
      add_tooth_loads(s, f, m, r);
    }
    if (r.load_share_max.size() > 0) add_load_share(s, s.mesh_force[at], f, r);
    for (size_t b = 0; b < s.bearing_force.size(); ++b)
      if (borne(s.bearing_force[b]))
        add_bearing(s.bearing_force[b][at].topRows(samples), periods, f, static_cast<Index>(b), r);
  }
  return r;
}

}  // namespace whine
