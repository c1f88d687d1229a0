#include "report/report_content.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <set>

#include "base/error.h"
#include "gear/drawing_quantities.h"
#include "gear/pair.h"
#include "io/summary.h"
#include "report/figure_words.h"
#include "report/figures.h"
#include "signal/response.h"
#include "signal/spectrum.h"

namespace whine {

using Eigen::Index;

const ResponseResult* sweep_of(const ReportContent& c, double torque, Direction direction) {
  for (const ResponseResult& s : c.sweeps)
    if (s.torque == torque && s.direction == direction) return &s;
  return nullptr;
}

const ImpactResult* impact_of(const ReportContent& c, double torque) {
  for (const ImpactResult& a : c.impacts)
    if (a.torque == torque) return &a;
  return nullptr;
}

void require_one_pair(const ReportContent& c) {
  if (c.statics.empty()) return;
  const StaticResult& first = c.statics[0];
  const auto same_gear = [](const GearDesign& a, const GearDesign& b) {
    return a.teeth == b.teeth && a.module == b.module && a.pressure_angle == b.pressure_angle &&
           a.profile_shift == b.profile_shift && a.face_width == b.face_width;
  };
  std::set<std::pair<std::string, double>> seen;
  const auto take = [&](const auto& a, const std::string& what) {
    if (!same_gear(a.gear[0].design, first.gear[0].design) ||
        !same_gear(a.gear[1].design, first.gear[1].design) ||
        a.mesh.centre_distance != first.mesh.centre_distance ||
        a.mesh.modification != first.mesh.modification)
      fail(Failure::input, what, " at ", torque_words(a.torque), " is of another pair than the static.h5 at ",
           torque_words(first.torque), "; give artifacts of one scene");
    if (!seen.emplace(what, a.torque).second)
      fail(Failure::input, what, " at ", torque_words(a.torque), " is given twice; give one of each torque");
  };
  for (const auto& s : c.statics) take(s, "a static.h5");
  for (const auto& a : c.impacts) take(a, "an impact.h5");
  for (const auto& s : c.sweeps) take(s, text("a response.h5 ", s.direction));
  if (c.budget) take(*c.budget, "the error_budget.h5");
  for (const auto& errors : c.errors) take(errors, text("a sweep_errors.h5 ", errors.direction));
}

TurningMember driver_of(const ReportContent& c) {
  if (c.statics.empty()) return {};
  return {c.statics[0].mesh.gear[0], 1.0 / c.statics[0].gear[0].design.teeth};
}

double static_force(const StaticResult& s) {
  return normal_force(s.gear[0].design, s.torque);
}

std::string plain_force_name(const StaticResult& s) {
  return rest_force_name(s.gear[0].design);
}

double peak_to_peak(const Eigen::VectorXd& v) {
  return v.maxCoeff() - v.minCoeff();
}

double tip_edge_load(const StaticResult& mesh) {
  return (mesh.contact_pressure.array() == 0).select(mesh.tooth_load, 0.0).maxCoeff();
}

double first_order_of_force(const MatrixRM& force, int periods) {
  if (resolved_harmonics(force.rows(), 1, periods) < 1) return 0;
  return std::hypot(harmonics(force.col(0), 1, periods).amplitude[0],
                    harmonics(force.col(1), 1, periods).amplitude[0]);
}

Eigen::VectorXd first_order_of(const std::vector<MatrixRM>& harmonic, Index column) {
  Eigen::VectorXd out(static_cast<Index>(harmonic.size()));
  for (size_t f = 0; f < harmonic.size(); ++f) {
    if (harmonic[f].rows() == 0 || column >= harmonic[f].cols()) return {};
    out[static_cast<Index>(f)] = harmonic[f](0, column);
  }
  return out;
}

std::string decibels(double amplitude) {
  return fixed(20 * std::log10(amplitude / std::numbers::sqrt2), 1);
}

std::string hertz(double f) {
  return fixed(f, 0);
}

std::string jumps_of(const ResponseResult& r, double scale) {
  std::vector<double> jumps(r.jump_frequency.begin(), r.jump_frequency.end());
  std::sort(jumps.begin(), jumps.end());
  std::string out;
  for (const double f : jumps) out += (out.empty() ? "" : ", ") + hertz(f * scale);
  return out.empty() ? "none" : out;
}

std::string way_words(const ResponseResult& s) {
  return s.direction == Direction::up ? "speed rising" : "speed falling";
}

std::string listed(const std::vector<std::string>& words) {
  std::string out;
  for (size_t i = 0; i < words.size(); ++i)
    out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return out;
}

std::string significant(double value, int digits) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%#.*g", digits, value);
  std::string out = buffer;
  if (out.back() == '.') out.pop_back();
  return out;
}

std::vector<Index> resonances(const ResponseResult& r) {
  return resonances(r.mesh_frequency, r.dte_rms.col(0));
}

std::vector<Index> resonances(const Eigen::VectorXd& mesh_frequency, const Eigen::VectorXd& dte_rms) {
  constexpr double kHigher = 1.2;
  constexpr size_t kMost = 5;
  const Index n = mesh_frequency.size();
  std::vector<Index> order(static_cast<size_t>(n)), peaks;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return mesh_frequency[a] < mesh_frequency[b]; });
  const auto rms = [&](Index k) { return dte_rms[order[static_cast<size_t>(k)]]; };
  // Least RMS on the way to a higher one, or to the end of the sweep.
  const auto foot = [&](Index k, Index step) {
    double least = rms(k);
    for (Index i = k + step; i >= 0 && i < n && rms(i) <= rms(k); i += step) least = std::min(least, rms(i));
    return least;
  };
  for (Index k = 1; k + 1 < n; ++k)
    if (rms(k) > rms(k - 1) && rms(k) >= rms(k + 1) && rms(k) > kHigher * std::max(foot(k, -1), foot(k, 1)))
      peaks.push_back(k);
  std::sort(peaks.begin(), peaks.end(), [&](Index a, Index b) { return rms(a) > rms(b); });
  peaks.resize(std::min(peaks.size(), kMost));
  std::sort(peaks.begin(), peaks.end());
  for (Index& k : peaks) k = order[static_cast<size_t>(k)];
  return peaks;
}

}  // namespace whine
