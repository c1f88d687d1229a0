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

void require_length(const char* what, Eigen::Index length, Eigen::Index speeds) {
  if (length != speeds)
    fail(Failure::input, "sweep: ", what, " has ", length, " rows, mesh_frequency has ", speeds);
}

template <class Sweep>
void require_speeds(const Sweep& s) {
  if (s.mesh_frequency.size() == 0) fail(Failure::input, "sweep: it holds no speed; 1 is the least");
}

// samples: of a row, steps: of a mesh period.
template <class Sweep>
void require_periods(const Sweep& s, Eigen::Index samples, int steps) {
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

void require_shapes(const SweepResult& s) {
  const Eigen::Index speeds = s.mesh_frequency.size();
  require_speeds(s);
  require_length("transmission_error", s.transmission_error.rows(), speeds);
  require_length("mesh_force", s.mesh_force.rows(), speeds);
  require_length("tooth_load", static_cast<Eigen::Index>(s.tooth_load.size()), speeds);
  for (const MatrixRM& stress : s.root_stress)
    if (stress.size() > 0 && (stress.rows() != speeds || stress.cols() != s.transmission_error.cols()))
      fail(Failure::input, "sweep: root_stress is ", stress.rows(), " x ", stress.cols(), ", expected ",
           speeds, " x ", s.transmission_error.cols());
  for (size_t g = 0; g < kSides; ++g)
    for (const Eigen::VectorXd* place : {&s.root_stress_angle[g], &s.root_stress_phase[g]})
      if (s.root_stress[g].size() > 0) require_length("the place of the root stress", place->size(), speeds);
  require_length("period_multiple", s.period_multiple.size(), speeds);
  if (s.mesh_force.cols() != s.transmission_error.cols())
    fail(Failure::input, "sweep: mesh_force has ", s.mesh_force.cols(), " samples, transmission_error ",
         s.transmission_error.cols());
  require_periods(s, s.transmission_error.cols(), s.time.steps_per_period);
  for (Eigen::Index f = 0; f < speeds; ++f) {
    for (const auto& force : s.bearing_force)
      if (!force.empty() && (static_cast<Eigen::Index>(force.size()) != speeds || force[f].cols() != 2 ||
                             force[f].rows() != s.transmission_error.cols()))
        fail(Failure::input, "sweep: bearing_force does not fit ", s.transmission_error.cols(),
             " samples of ", speeds, " speeds");
    const MatrixRM& load = s.tooth_load[f];
    if (load.rows() != s.transmission_error.cols() || load.cols() < 1)
      fail(Failure::input, "sweep: tooth_load is ", load.rows(), " x ", load.cols(), " at ",
           s.mesh_frequency[f], " Hz; ", s.transmission_error.cols(),
           " samples of 1 pair at least are needed");
    if (!load.allFinite())
      fail(Failure::input, "sweep: tooth_load is not finite at ", s.mesh_frequency[f], " Hz");
  }
}

void require_shapes(const SystemSweepResult& s) {
  const Eigen::Index speeds = s.mesh_frequency.size(),
                     meshes = static_cast<Eigen::Index>(s.settings.layout.meshes.size());
  require_speeds(s);
  require_length("period_multiple", s.period_multiple.size(), speeds);
  if (meshes == 0 || s.settings.section.size() != s.settings.layout.meshes.size())
    fail(Failure::input, "sweep: ", meshes, " meshes, of which ", s.settings.section.size(),
         " have a number of their [[mesh]]; 1 is the least, and all need one");
  if (*std::min_element(s.settings.section.begin(), s.settings.section.end()) < 0)
    fail(Failure::input, "sweep: a mesh is of [[mesh]] number ",
         *std::min_element(s.settings.section.begin(), s.settings.section.end()), "; 0 is the least");
  require_length("transmission_error", static_cast<Eigen::Index>(s.transmission_error.size()), speeds);
  const Eigen::Index samples = s.transmission_error[0].rows();
  const auto require_rows = [&](const char* what, const std::vector<MatrixRM>& rows, Eigen::Index columns) {
    require_length(what, static_cast<Eigen::Index>(rows.size()), speeds);
    for (const MatrixRM& one : rows)
      if (one.rows() != samples || one.cols() != columns)
        fail(Failure::input, "sweep: ", what, " is ", one.rows(), " x ", one.cols(), ", expected ", samples,
             " x ", columns);
  };
  for (const auto& [what, rows] :
       {std::pair{"transmission_error", &s.transmission_error}, std::pair{"mesh_force", &s.mesh_force},
        std::pair{"largest_tooth_load", &s.largest_tooth_load}})
    require_rows(what, *rows, meshes);
  if (s.bearing_force.size() != s.settings.layout.bodies.size())
    fail(Failure::input, "sweep: bearing_force is of ", s.bearing_force.size(), " bodies, expected ",
         s.settings.layout.bodies.size());
  for (const auto& rows : s.bearing_force) require_rows("bearing_force", rows, 2);
  require_periods(s, samples, s.settings.time.steps_per_period);
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
  if (r.hunting_periods > 1)
    r.dte_order[at].col(m) =
        harmonics(transmission_error, count * r.hunting_periods, periods / r.hunting_periods).amplitude;
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

// Root stress over speed, and with it the loads that are sustained for 1/64 of a mesh period.
void add_root_stress(const SweepResult& s, ResponseResult& r) {
  const Index speeds = s.mesh_frequency.size();
  if (s.root_stress[0].size() == 0 && s.root_stress[1].size() == 0) return;
  for (MatrixRM* x :
       {&r.root_stress_max, &r.root_stress_sustained, &r.root_stress_angle, &r.root_stress_phase})
    x->setZero(speeds, kSides);
  const int steps = s.time.steps_per_period;
  for (Index g = 0; g < kSides; ++g) {
    const auto gear = static_cast<size_t>(g);
    const MatrixRM& stress = s.root_stress[gear];
    if (stress.size() == 0) continue;
    r.root_stress_max.col(g) = stress.rowwise().maxCoeff();
    r.root_stress_angle.col(g) = s.root_stress_angle[gear];
    r.root_stress_phase.col(g) = s.root_stress_phase[gear];
    for (Index f = 0; f < speeds; ++f)
      r.root_stress_sustained(f, g) = sustained_load(stress.row(f).transpose(), steps, s.period_multiple[f]);
  }
  if (s.root_stress[0].size() == 0) return;
  for (MatrixRM* x : {&r.tooth_load_sustained, &r.mesh_force_sustained}) x->resize(speeds, 1);
  for (Index f = 0; f < speeds; ++f) {
    r.tooth_load_sustained(f, 0) = sustained_load(s.tooth_load[static_cast<size_t>(f)], steps);
    r.mesh_force_sustained(f, 0) =
        sustained_load(s.mesh_force.row(f).transpose(), steps, s.period_multiple[f]);
  }
}

// Of a train: largest share of each mesh in what those of its [[mesh]] carry together.
void add_load_share(const SystemSweepResult& s, const MatrixRM& force, Index f, ResponseResult& r) {
  const std::vector<int>& section = s.settings.section;
  VectorXd together(1 + *std::max_element(section.begin(), section.end()));
  for (Index n = 0; n < force.rows(); ++n) {
    together.setZero();
    for (Index m = 0; m < force.cols(); ++m) together[section[static_cast<size_t>(m)]] += force(n, m);
    for (Index m = 0; m < force.cols(); ++m)
      if (const double all = together[section[static_cast<size_t>(m)]]; all > 0)
        r.load_share_max(f, m) = std::max(r.load_share_max(f, m), std::min(1.0, force(n, m) / all));
  }
}

// What pairs and trains have in common.
template <class Sweep>
void take_over(const Sweep& s, ResponseResult& r) {
  r.direction = s.direction;
  r.mesh_frequency = s.mesh_frequency;
  r.hunting_periods = s.hunting_periods;
  r.jump_frequency = s.jump_frequency;
  r.jump_width = s.jump_width;
  r.periods = s.periods;
  r.period_multiple = s.period_multiple;
  r.energy_imbalance = s.energy_imbalance;
  r.remarks = s.remarks;
}

}  // namespace

ResponseResult response(const SweepResult& s) {
  require_shapes(s);
  const Index speeds = s.mesh_frequency.size();
  const Index per_period = s.time.steps_per_period;
  ResponseResult r;
  take_over(s, r);
  static_cast<MotionParameters&>(r) = s;
  r.mesh_names = {s.mesh.gear[0] + "-" + s.mesh.gear[1]};
  r.body_names = {s.mesh.gear[0], s.mesh.gear[1]};
  r.torque = s.torque;
  r.model = s.model;
  r.natural_frequency = s.natural_frequency;
  r.backlash_left = s.backlash_left;
  size_meshes(per_period, speeds, 1, r);
  if (!s.bearing_force[0].empty() || !s.bearing_force[1].empty()) size_bearings(kSides, r);
  add_root_stress(s, r);
  for (Index f = 0; f < speeds; ++f) {
    // What one orbit fills of its row; a motion that is not periodic fills it all.
    const int periods = s.period_multiple[f] > 0 ? s.period_multiple[f]
                                                 : static_cast<int>(s.transmission_error.cols() / per_period);
    const Index samples = periods * per_period;
    add_mesh(s.transmission_error.row(f).head(samples).transpose(),
             s.mesh_force.row(f).head(samples).transpose(), periods, f, 0, r);
    r.tooth_load_max(f, 0) = s.tooth_load[static_cast<size_t>(f)].maxCoeff();
    for (size_t g = 0; g < kSides; ++g)
      if (!s.bearing_force[g].empty())
        add_bearing(s.bearing_force[g][static_cast<size_t>(f)].topRows(samples), periods, f,
                    static_cast<Index>(g), r);
  }
  return r;
}

ResponseResult response(const SystemSweepResult& s) {
  require_shapes(s);
  const System& layout = s.settings.layout;
  const Index speeds = s.mesh_frequency.size(), per_period = s.settings.time.steps_per_period,
              bodies = static_cast<Index>(layout.bodies.size()),
              meshes = static_cast<Index>(layout.meshes.size());
  ResponseResult r;
  take_over(s, r);
  r.train = s.settings;
  r.drive = s.torque;
  for (Index m = 0; m < meshes; ++m) r.mesh_names.push_back(mesh_name(layout, static_cast<size_t>(m)));
  for (const System::Body& body : layout.bodies) r.body_names.push_back(body.name);
  size_meshes(per_period, speeds, meshes, r);
  size_bearings(bodies, r);
  // Of the meshes of one [[mesh]].
  const std::set<int> sections(s.settings.section.begin(), s.settings.section.end());
  if (static_cast<Index>(sections.size()) < meshes) r.load_share_max.setZero(speeds, meshes);
  for (Index f = 0; f < speeds; ++f) {
    const auto at = static_cast<size_t>(f);
    const Index stored = s.transmission_error[at].rows(),
                samples = s.period_multiple[f] > 0 ? s.period_multiple[f] * per_period : stored;
    for (Index m = 0; m < meshes; ++m) {
      add_mesh(s.transmission_error[at].col(m).head(samples), s.mesh_force[at].col(m).head(samples),
               static_cast<int>(samples / per_period), f, m, r);
      r.tooth_load_max(f, m) = s.largest_tooth_load[at].col(m).maxCoeff();
    }
    if (r.load_share_max.size() > 0) add_load_share(s, s.mesh_force[at], f, r);
    for (Index b = 0; b < bodies; ++b)
      add_bearing(s.bearing_force[static_cast<size_t>(b)][at].topRows(samples),
                  static_cast<int>(samples / per_period), f, b, r);
  }
  return r;
}

}  // namespace whine
