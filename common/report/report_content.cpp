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
#include "report/one_system.h"
#include "report/system_picture.h"
#include "signal/response.h"
#include "signal/spectrum.h"

namespace whine {

using Eigen::Index;

namespace {

bool one_pair(const GearPairParameters& a, const GearPairParameters& b) {
  const auto same_gear = [](const GearDesign& x, const GearDesign& y) {
    return x.teeth == y.teeth && x.module == y.module && x.pressure_angle == y.pressure_angle &&
           x.profile_shift == y.profile_shift && x.face_width == y.face_width;
  };
  return same_gear(a.gear[0].design, b.gear[0].design) && same_gear(a.gear[1].design, b.gear[1].design) &&
         a.mesh.centre_distance == b.mesh.centre_distance && a.mesh.modification == b.mesh.modification;
}

// Whether an artifact is of the pair or train of the statics.
bool one_scene(const SystemStaticResult& first, const SystemStaticResult& a) {
  return first.of_train() == a.of_train() && first.hunting_periods == a.hunting_periods &&
         (a.of_train() ? one_system(a.settings.layout, first.settings.layout)
                       : one_pair(a.mesh[0], first.mesh[0]));
}
bool one_scene(const SystemStaticResult& first, const MotionSource& a) {
  return first.of_train() == a.of_train() &&
         (a.of_train() ? one_system(a.layout, first.settings.layout) : one_pair(a, first.mesh[0]));
}

}  // namespace

bool one_torque(double a, double b) {
  constexpr double kRounded = 1e-6;  // N m, by torque_of()
  return std::abs(a - b) <= 1e-9 * std::abs(b) + kRounded;
}

double torque_of(const MotionSource& motion) {
  return motion.of_train() && motion.drive.size() > 0 ? motion.drive.maxCoeff() : motion.torque;
}

System layout_of(const ReportContent& c) {
  if (c.statics.empty()) return c.modes ? c.modes->layout : System{};
  if (c.of_train()) return c.statics[0].settings.layout;
  const StaticResult& s = c.pair();
  System out = layout_of_pair(s);
  out.drives.push_back({0, System::DriveKind::torque, s.torque});
  const MotionSource* motion = !c.sweeps.empty()    ? static_cast<const MotionSource*>(&c.sweeps[0])
                               : !c.impacts.empty() ? &c.impacts[0]
                                                    : nullptr;
  for (size_t g = 0; g < kSides && motion; ++g) out.bodies[g].inertia = motion->inertia[g];
  return out;
}

bool has_planets(const System& system) {
  return std::any_of(system.bodies.begin(), system.bodies.end(),
                     [](const System::Body& body) { return body.on != System::kGround; });
}

const SystemStaticResult* rest_of(const ReportContent& c) {
  return c.statics.empty() ? nullptr : &c.statics[0];
}

const ResponseResult* sweep_of(const ReportContent& c, double torque, Direction direction) {
  for (const ResponseResult& s : c.sweeps)
    if (one_torque(torque_of(s), torque) && s.direction == direction) return &s;
  return nullptr;
}

const ImpactResult* impact_of(const ReportContent& c, double torque) {
  for (const ImpactResult& a : c.impacts)
    if (one_torque(torque_of(a), torque)) return &a;
  return nullptr;
}

void require_one_scene(const ReportContent& c) {
  if (c.statics.empty() && (!c.modes || !c.sweeps.empty()))
    fail(Failure::input, "report: no static.h5 given; that of the scene's first torque is the least");
  if (c.statics.empty()) return;
  const SystemStaticResult& first = c.statics[0];
  if (c.modes && !one_system(first.settings.layout, c.modes->layout))
    fail(Failure::input, "report: static.h5 and modes.h5 are of two systems; give artifacts of one scene");
  std::set<std::pair<std::string, double>> seen;
  const auto take = [&](bool same, double torque, const std::string& what) {
    if (!same)
      fail(Failure::input, what, " at ", torque_words(torque), " is of other gears than the static.h5 at ",
           torque_words(torque_of(first)), "; give artifacts of one scene");
    if (!seen.emplace(what, torque).second)
      fail(Failure::input, what, " at ", torque_words(torque), " is given twice; give one of each torque");
  };
  for (const SystemStaticResult& s : c.statics) take(one_scene(first, s), torque_of(s), "a static.h5");
  const auto take_motion = [&](const MotionSource& a, const std::string& what) {
    const double torque = torque_of(a);
    take(one_scene(first, a), torque, what);
    if (std::none_of(c.statics.begin(), c.statics.end(),
                     [&](const auto& s) { return one_torque(torque, torque_of(s)); }))
      fail(Failure::input, what, " is at ", torque_words(torque), " on '", driver_of(c).name,
           "', at which no static.h5 is given; give it, too");
  };
  for (const ImpactResult& a : c.impacts) take_motion(a, "an impact.h5");
  for (const ResponseResult& s : c.sweeps) {
    take_motion(s, text("a response.h5 ", s.direction));
    if (s.hunting_periods != first.hunting_periods)
      fail(Failure::input, "report: the same teeth meet again after ", s.hunting_periods,
           " mesh periods in response.h5 and after ", first.hunting_periods,
           " in static.h5; give artifacts of one scene");
  }
  if (c.budget)
    take(one_pair(*c.budget, first.mesh[0]) && c.budget->gear_names == first.settings.gears(),
         c.budget->torque, "the error_budget.h5");
  for (const SweepErrorsResult& a : c.errors) take_motion(a, text("a sweep_errors.h5 ", a.direction));
}

TurningMember driver_of(const ReportContent& c) {
  const System s = layout_of(c);
  if (s.bodies.empty()) return {};
  const SystemStaticResult* rest = rest_of(c);
  size_t driver = 0;
  double most = 0;
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    if (s.held(static_cast<int>(b))) continue;
    const double torque = rest && rest->of_train() ? rest->torque.col(static_cast<Index>(b)).mean()
                                                   : s.torque(static_cast<int>(b));
    if (torque > most) {
      most = torque;
      driver = b;
    }
  }
  Figure speeds;
  add_shafts(s, speeds);
  if (speeds.shafts.empty()) return {s.bodies[driver].name, 0};
  return {s.bodies[driver].name, std::abs(speeds.shafts[driver].turns), speeds.shafts[driver].with};
}

double static_force(const StaticResult& s) {
  return normal_force(s.gear[0].design, s.torque);
}

double rest_force(const SystemStaticResult& rest, size_t mesh) {
  return rest.mesh_force.col(static_cast<Index>(mesh)).mean();
}

std::string plain_force_name(const StaticResult& s) {
  return rest_force_name(s.gear[0].design);
}

double peak_to_peak(const Eigen::VectorXd& v) {
  return v.maxCoeff() - v.minCoeff();
}

double tip_edge_load(const StaticResult& mesh) {
  // Tip edges of helical gears count on the line of action alone.
  if (mesh.contact_pressure.size() == 0 || mesh.gear[0].design.helical()) return 0;
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
