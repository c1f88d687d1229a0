#include "signal/response.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "signal/branches.h"
#include "signal/jumps.h"
#include "signal/spectrum.h"

namespace whine {
namespace {

void require_length(const char* what, Eigen::Index length, Eigen::Index speeds) {
  if (length != speeds)
    fail(Failure::input, "sweep: ", what, " has ", length, " rows, mesh_frequency has ", speeds);
}

void require_shapes(const SweepResult& s) {
  const Eigen::Index speeds = s.mesh_frequency.size();
  if (speeds == 0) fail(Failure::input, "sweep: it holds no speed; 1 is the least");
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
  if (s.time.steps_per_period < 1 || s.transmission_error.cols() % s.time.steps_per_period != 0)
    fail(Failure::input, "sweep: ", s.transmission_error.cols(),
         " samples are no whole number of periods of ", s.time.steps_per_period, " steps");
  if (s.hunting_periods < 1 || s.transmission_error.cols() / s.time.steps_per_period % s.hunting_periods != 0)
    fail(Failure::input, "sweep: ", s.transmission_error.cols() / s.time.steps_per_period,
         " mesh periods are no whole number of hunting periods of ", s.hunting_periods);
  if (s.jump_width.size() != s.jump_frequency.size())
    fail(Failure::input, "sweep: ", s.jump_frequency.size(), " jumps, but ", s.jump_width.size(), " widths");
  for (Eigen::Index f = 0; f < speeds; ++f) {
    if (s.period_multiple[f] < 0 ||
        s.period_multiple[f] * s.time.steps_per_period > s.transmission_error.cols())
      fail(Failure::input, "sweep: period_multiple is ", s.period_multiple[f], " at ", s.mesh_frequency[f],
           " Hz; 0 is the least, and ", s.transmission_error.cols(), " samples of ", s.time.steps_per_period,
           " per period the most");
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
    sweep.push_back({r.mesh_frequency[i], r.dte_rms[i], r.period_multiple[i]});
  std::vector<Eigen::Index> rows;
  for (const double f : r.jump_frequency) {
    const Eigen::Index last = row_before(r.mesh_frequency, f);
    rows.push_back(last);
    if (last < 0 || may_break(sweep, static_cast<size_t>(last) + 1)) continue;
    for (Eigen::Index i = last; i >= 0 && i > last - kEarly; --i)
      if (like_a_jump(r.dte_rms[i], r.dte_rms[i + 1])) {
        rows.back() = i;
        break;
      }
  }
  return rows;
}

namespace {

// Root stress over speed, and with it the loads that are sustained for 1/64 of a mesh period.
void add_root_stress(const SweepResult& s, ResponseResult& r) {
  const Eigen::Index speeds = s.mesh_frequency.size();
  for (size_t g = 0; g < kSides; ++g)
    if (s.root_stress[g].size() > 0) {
      r.root_stress_max[g] = s.root_stress[g].rowwise().maxCoeff();
      r.root_stress_sustained[g].resize(speeds);
      r.root_stress_angle[g] = s.root_stress_angle[g];
      r.root_stress_phase[g] = s.root_stress_phase[g];
    }
  if (s.root_stress[0].size() > 0) {
    for (Eigen::VectorXd* v : {&r.tooth_load_sustained, &r.mesh_force_sustained}) v->resize(speeds);
    const int steps = s.time.steps_per_period;
    for (Eigen::Index f = 0; f < speeds; ++f) {
      r.tooth_load_sustained[f] = sustained_load(s.tooth_load[f], steps);
      r.mesh_force_sustained[f] =
          sustained_load(s.mesh_force.row(f).transpose(), steps, s.period_multiple[f]);
      for (size_t g = 0; g < kSides; ++g)
        if (s.root_stress[g].size() > 0)
          r.root_stress_sustained[g][f] =
              sustained_load(s.root_stress[g].row(f).transpose(), steps, s.period_multiple[f]);
    }
  }
}

}  // namespace

ResponseResult response(const SweepResult& s) {
  require_shapes(s);
  const Eigen::Index speeds = s.mesh_frequency.size();
  // What one orbit fills of its row; a motion that is not periodic fills it all.
  const Eigen::Index per_period = s.time.steps_per_period;
  const auto stored = [&](Eigen::Index f) {
    return s.period_multiple[f] > 0 ? s.period_multiple[f]
                                    : static_cast<int>(s.transmission_error.cols() / per_period);
  };
  const int count = resolved_harmonics(per_period, kResponseHarmonics);
  if (count < 1)
    fail(Failure::input, "sweep: ", per_period,
         " samples per mesh period do not resolve the mesh frequency; raise steps_per_period");

  ResponseResult r;
  r.torque = s.torque;
  r.direction = s.direction;
  r.model = s.model;
  static_cast<MotionParameters&>(r) = s;
  r.natural_frequency = s.natural_frequency;
  r.mesh_frequency = s.mesh_frequency;
  r.jump_frequency = s.jump_frequency;
  r.jump_width = s.jump_width;
  r.period_multiple = s.period_multiple;
  r.backlash_left = s.backlash_left;
  r.remarks = s.remarks;
  r.dte_rms.resize(speeds);
  r.dte_mean.resize(speeds);
  r.dte_harmonic.resize(speeds, count);
  r.hunting_periods = s.hunting_periods;
  if (s.hunting_periods > 1) r.dte_order.resize(speeds, count * s.hunting_periods);
  r.tooth_load_max.resize(speeds);
  r.mesh_force_max.resize(speeds);
  for (size_t g = 0; g < kSides; ++g)
    if (!s.bearing_force[g].empty())
      for (Eigen::VectorXd* v : {&r.bearing_force_max[g], &r.bearing_force_rms[g]}) v->resize(speeds);
  add_root_stress(s, r);
  r.separation_fraction.resize(speeds);
  r.separations_per_period.resize(speeds);
  for (Eigen::Index f = 0; f < speeds; ++f) {
    const int periods = stored(f);
    const Eigen::Index samples = periods * per_period;
    const Harmonics dte = harmonics(s.transmission_error.row(f).head(samples).transpose(), count, periods);
    const Separations apart = separations(s.mesh_force.row(f).head(samples).transpose());
    r.dte_rms[f] = dte.rms;
    r.dte_mean[f] = dte.mean;
    r.dte_harmonic.row(f) = dte.amplitude.transpose();
    if (s.hunting_periods > 1)
      r.dte_order.row(f) = harmonics(s.transmission_error.row(f).head(samples).transpose(),
                                     count * s.hunting_periods, periods / s.hunting_periods)
                               .amplitude.transpose();
    r.tooth_load_max[f] = s.tooth_load[f].maxCoeff();
    r.mesh_force_max[f] = s.mesh_force.row(f).maxCoeff();
    for (size_t g = 0; g < kSides; ++g) {
      if (s.bearing_force[g].empty()) continue;
      const auto force = s.bearing_force[g][f].topRows(samples);
      r.bearing_force_max[g][f] = force.rowwise().norm().maxCoeff();
      r.bearing_force_rms[g][f] =
          std::sqrt((force.rowwise() - force.colwise().mean()).rowwise().squaredNorm().mean());
    }
    r.separation_fraction[f] = apart.fraction;
    r.separations_per_period[f] = static_cast<double>(apart.intervals) / periods;
  }
  return r;
}

}  // namespace whine
