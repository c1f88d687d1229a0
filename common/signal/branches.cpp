#include "signal/branches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "signal/response.h"

namespace whine {

using Eigen::VectorXd;

namespace {

constexpr double kLeastSpeed = 0.57, kMostSpeed = 1.2;  // of the frequency between rigid gears

// A jump of a sweep; outlived: the branch goes on beyond the last speed, its end is not known.
struct End {
  double frequency = 0;  // Hz
  bool outlived = false;
};

End nearest_to(const std::vector<End>& jumps, double frequency) {
  return *std::min_element(jumps.begin(), jumps.end(), [&](const End& a, const End& b) {
    return std::abs(a.frequency - frequency) < std::abs(b.frequency - frequency);
  });
}

// The branch at f between points of it that a sweep had left before; nothing if they do not reach that far. Points stand
// half a step of the sweep apart or less.
std::optional<BranchPoint> between(std::vector<BranchPoint> points, double f) {
  std::sort(points.begin(), points.end(),
            [](const BranchPoint& a, const BranchPoint& b) { return a.mesh_frequency < b.mesh_frequency; });
  for (size_t i = 1; i < points.size(); ++i) {
    const BranchPoint &a = points[i - 1], &b = points[i];
    if (f < a.mesh_frequency || f > b.mesh_frequency || like_a_jump(a.dte_rms, b.dte_rms)) continue;
    const double width = b.mesh_frequency - a.mesh_frequency,
                 share = width > 0 ? (f - a.mesh_frequency) / width : 0;
    const auto at = [&](double BranchPoint::*value) { return a.*value + share * (b.*value - a.*value); };
    return BranchPoint{f, at(&BranchPoint::dte_rms), at(&BranchPoint::tooth_load_max),
                       at(&BranchPoint::sustained_load), a.parted || b.parted};
  }
  return std::nullopt;
}

struct Branches {
  double from = 0, to = 0;
  bool open_below = false;
};

// The widest range of speeds at which the two sweeps differ as across a jump. up, down: (speed) RMS, speeds ascending. A
// range between two speeds shows by its jumps alone: rising speed jumps above the jump of falling speed.
std::optional<Branches> widest(const VectorXd& speed, const VectorXd& up, const VectorXd& down,
                               const std::vector<End>& jumps_up, const std::vector<End>& jumps_down) {
  Eigen::Index best = -1, length = 0;
  for (Eigen::Index i = 0; i < speed.size();) {
    Eigen::Index end = i;
    while (end < speed.size() && like_a_jump(up[end], down[end])) ++end;
    if (end - i > length) {
      best = i;
      length = end - i;
    }
    i = std::max(end, i + 1);
  }
  Branches found;
  if (best >= 0) {
    found.from = speed[best];
    found.to = speed[best + length - 1];
    if (best == 0) {
      found.open_below = true;
    } else if (!jumps_down.empty()) {
      const End end = nearest_to(jumps_down, found.from);
      found.open_below = end.outlived;
      found.from = end.outlived ? speed[0] : end.frequency;
    }
    if (!jumps_up.empty()) {
      const End end = nearest_to(jumps_up, found.to);
      found.to = end.outlived ? speed[speed.size() - 1] : end.frequency;
    }
    return found;
  }
  for (const End& above : jumps_up)
    for (const End& below : jumps_down)
      if (above.frequency > below.frequency && above.frequency - below.frequency > found.to - found.from)
        found = {below.outlived ? speed[0] : below.frequency, above.frequency, below.outlived};
  if (found.to > 0) return found;
  return std::nullopt;
}

// Least of `window` samples from row i on; the end of `rows` is followed by their begin.
template <typename Column>
double least_from(const Column& load, Eigen::Index i, Eigen::Index window, Eigen::Index rows) {
  double least = load[i];
  for (Eigen::Index n = 1; n < window; ++n) least = std::min(least, load[(i + n) % rows]);
  return least;
}

}  // namespace

double sustained_load(const Eigen::Ref<const MatrixRM>& load, int samples, int multiple) {
  const Eigen::Index window = sustained_samples(samples);
  const Eigen::Index rows =
      multiple > 0 ? std::min(load.rows(), static_cast<Eigen::Index>(multiple) * samples) : load.rows();
  double sustained = 0;
  for (Eigen::Index pair = 0; pair < load.cols(); ++pair)
    for (Eigen::Index i = 0; i + (multiple > 0 ? 1 : window) <= rows; ++i)
      sustained = std::max(sustained, least_from(load.col(pair), i, window, rows));
  return sustained;
}

Eigen::Index sustained_row(const Eigen::Ref<const VectorXd>& load, int samples, int multiple) {
  const Eigen::Index window = sustained_samples(samples);
  const Eigen::Index rows =
      multiple > 0 ? std::min(load.size(), static_cast<Eigen::Index>(multiple) * samples) : load.size();
  double sustained = -1;
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i + (multiple > 0 ? 1 : window) <= rows; ++i) {
    const double least = least_from(load, i, window, rows);
    if (!(least > sustained)) continue;
    sustained = least;
    row = i;
    for (Eigen::Index n = 1; n < window; ++n)
      if (const Eigen::Index other = (i + n) % rows; load[other] > load[row]) row = other;
  }
  return row;
}

VectorXd map_speeds(const MapSpeeds& plan, double natural_frequency) {
  const double from = plan.from > 0 ? plan.from : kLeastSpeed * natural_frequency,
               to = plan.to > 0 ? plan.to : kMostSpeed * natural_frequency;
  if (!(plan.step > 0) || !std::isfinite(plan.step))
    fail(Failure::input, "a step of ", plan.step, " Hz between the speeds; it must be above 0");
  if (!(to >= from) || !std::isfinite(to))
    fail(Failure::input, "the speeds from ", from, " to ", to, " Hz are no range");
  const double anchor = plan.load_frequency > 0 ? plan.load_frequency : from;
  if (anchor < from || anchor > to)
    fail(Failure::input, "the loads are wanted at ", anchor, " Hz, but the speeds run from ", from, " to ",
         to, " Hz; change --loads-at, --from or --to");
  const double first = std::ceil((from - anchor) / plan.step - 1e-9),
               last = std::floor((to - anchor) / plan.step + 1e-9);
  if (last - first > 1e5)
    fail(Failure::input, "the speeds from ", from, " to ", to, " Hz in steps of ", plan.step,
         " Hz are more than 100000; a larger step makes fewer");
  const auto count = static_cast<Eigen::Index>(last - first) + 1;
  return VectorXd::LinSpaced(count, anchor + first * plan.step, anchor + last * plan.step);
}

void start_cases(JumpMapResult& map, Eigen::Index cases, const VectorXd& speeds, double load_frequency) {
  map.load_frequency = load_frequency;
  map.mesh_frequency = speeds;
  for (VectorXd* v : {&map.rayleigh_stiffness, &map.damping_ratio, &map.branches_from, &map.branches_to,
                      &map.loss_from, &map.loss_to, &map.excitation})
    *v = VectorXd::Zero(cases);
  for (Eigen::VectorXi* v : {&map.two_branches, &map.open_below, &map.unsteady})
    *v = Eigen::VectorXi::Zero(cases);
  map.peak_tooth_load.resize(cases, 2);
  map.sustained_tooth_load.resize(cases, 2);
  if (load_frequency > 0)
    for (MatrixRM* at : {&map.tooth_load, &map.sustained_load_there, &map.dte_rms_there})
      at->resize(cases, 2);
  for (int d = 0; d < 2; ++d)
    for (auto* curve : {&map.dte_rms, &map.tooth_load_max, &map.separation_fraction})
      (*curve)[d].resize(cases, speeds.size());
}

void add_case(JumpMapResult& map, Eigen::Index c, double step,
              const std::function<SweepResult(Direction, std::vector<BranchPoint>&)>& sweep) {
  const VectorXd& speed = map.mesh_frequency;
  std::array<std::vector<End>, 2> jumps;
  const auto note_loss = [&](double f) {
    map.loss_from[c] = map.loss_to[c] > 0 ? std::min(map.loss_from[c], f) : f;
    map.loss_to[c] = std::max(map.loss_to[c], f);
  };
  for (int d = 0; d < 2; ++d) {
    std::vector<BranchPoint> beyond;
    const SweepResult swept = sweep(d == 0 ? Direction::up : Direction::down, beyond);
    const ResponseResult r = response(swept);
    VectorXd sustained(speed.size());
    for (Eigen::Index i = 0; i < speed.size(); ++i)
      sustained[i] = sustained_load(swept.tooth_load[i], swept.time.steps_per_period);
    const auto ascending = [&](const VectorXd& row) { return d == 0 ? row : VectorXd(row.reverse()); };
    map.dte_rms[d].row(c) = ascending(r.dte_rms.col(0)).transpose();
    map.tooth_load_max[d].row(c) = ascending(r.tooth_load_max.col(0)).transpose();
    map.separation_fraction[d].row(c) = ascending(r.separation_fraction.col(0)).transpose();
    map.peak_tooth_load(c, d) = r.tooth_load_max.maxCoeff();
    map.sustained_tooth_load(c, d) = sustained.maxCoeff();
    for (Eigen::Index i = 0; i < speed.size(); ++i)
      if (map.separation_fraction[d](c, i) > 0) note_loss(speed[i]);
    for (const BranchPoint& point : beyond) {
      map.peak_tooth_load(c, d) = std::max(map.peak_tooth_load(c, d), point.tooth_load_max);
      map.sustained_tooth_load(c, d) = std::max(map.sustained_tooth_load(c, d), point.sustained_load);
      if (point.parted) note_loss(point.mesh_frequency);
    }
    map.unsteady[c] += static_cast<int>((r.period_multiple.array() == 0).count());
    if (map.load_frequency > 0) {
      Eigen::Index row = 0;
      (speed.array() - map.load_frequency).abs().minCoeff(&row);
      map.tooth_load(c, d) = map.tooth_load_max[d](c, row);
      map.dte_rms_there(c, d) = map.dte_rms[d](c, row);
      map.sustained_load_there(c, d) = ascending(sustained)[row];
      if (const auto found = between(beyond, map.load_frequency)) {
        map.tooth_load(c, d) = found->tooth_load_max;
        map.sustained_load_there(c, d) = found->sustained_load;
        map.dte_rms_there(c, d) = found->dte_rms;
      }
    }
    const Eigen::Index before = map.jump_frequency.size(), now = before + r.jump_frequency.size();
    for (VectorXd* v : {&map.jump_frequency, &map.jump_width}) v->conservativeResize(now);
    for (Eigen::VectorXi* v : {&map.jump_case, &map.jump_direction}) v->conservativeResize(now);
    for (Eigen::Index j = before; j < now; ++j) {
      map.jump_case[j] = static_cast<int>(c);
      map.jump_direction[j] = d;
      map.jump_frequency[j] = r.jump_frequency[j - before];
      map.jump_width[j] = r.jump_width[j - before];
      // A jump whose end was found is as wide as the finest step, one that was not as the sweep's own.
      jumps[d].push_back({map.jump_frequency[j], map.jump_width[j] > 0.75 * step});
    }
  }
  if (const auto found = widest(speed, map.dte_rms[0].row(c), map.dte_rms[1].row(c), jumps[0], jumps[1])) {
    map.two_branches[c] = 1;
    map.branches_from[c] = found->from;
    map.branches_to[c] = found->to;
    map.open_below[c] = found->open_below;
  }
}

}  // namespace whine
