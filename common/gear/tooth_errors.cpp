#include "gear/tooth_errors.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <string>

#include "base/error.h"

namespace whine {

namespace {

constexpr double kResolution = 1e-9;  // m: last digits of cos differ between machines, those kept do not

double in_range(const char* what, double value, double least, double most, const char* unit) {
  if (!(value >= least && value <= most))
    fail(Failure::input, "iso_class: ", what, " of ", value, unit, " is outside the range of ISO 1328-1, ",
         least, " to ", most, unit, "; give lists of deviations instead");
  return value;
}

// Numbers of (-1, 1), the same on every machine: those of std::uniform_real_distribution are the library's.
class Draw {
 public:
  explicit Draw(int seed) : engine_(static_cast<std::uint64_t>(seed)) {}
  double operator()() { return 2 * (static_cast<double>(engine_() >> 11) * 0x1p-53) - 1; }

 private:
  std::mt19937_64 engine_;
};

double towards_zero(double value) {
  return std::trunc(value / kResolution) * kResolution;
}

double range(const std::vector<double>& values) {
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  return *largest - *least;
}

double largest_of(const std::vector<double>& values) {
  double most = 0;
  for (double value : values) most = std::max(most, std::abs(value));
  return most;
}

// Radial run-out of flanks that the first harmonic of their cumulative deviation leaves, m: a toothing that is displaced by e
// moves flanks by e / cos(pressure angle) along the circle, and a ball in the tooth spaces by 2 e.
double run_out(const std::vector<double>& cumulative, double pressure_angle) {
  std::complex<double> sum = 0;
  const double n = static_cast<double>(cumulative.size());
  for (size_t i = 0; i < cumulative.size(); ++i)
    sum += cumulative[i] * std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(i) / n);
  return 2 * (2 / n) * std::abs(sum) * std::cos(pressure_angle);
}

ToothDeviations drawn(const GearDesign& design, int iso_class, double share, int seed, FlankSide flank) {
  const FlankTolerances limit = iso_1328_tolerances(design, iso_class);
  const int teeth = design.teeth;
  Draw draw(seed);
  ToothDeviations d;
  // Eccentric clamping turns once per revolution, the rest varies from tooth to tooth; in these shares both kinds come near
  // their limits.
  constexpr double kEccentric = 0.35, kScatter = 0.5;
  const double leading = std::numbers::pi * draw();
  const auto take = [&](double phase) {
    d = {};
    for (int i = 0; i < teeth; ++i)
      d.cumulative_pitch.push_back(kEccentric * limit.cumulative_pitch *
                                       std::cos(2 * std::numbers::pi * i / teeth - phase) +
                                   kScatter * limit.single_pitch * draw());
    for (int i = 0; i < teeth; ++i) d.profile_slope.push_back(limit.profile_slope * draw());
    for (int i = 0; i < teeth; ++i) d.profile_form.push_back(limit.profile_form * draw());
  };
  take(leading);
  // A toothing that is displaced by e towards A moves flanks at the angle t along the circle by e sin(A - t) + e tan(alpha) cos(A - t),
  // trailing ones by e sin(A - t) - e tan(alpha) cos(A - t). Those of a ring look inwards: the other way about.
  if (flank == FlankSide::trailing) take(leading + (design.internal ? 2 : -2) * design.pressure_angle);

  // Up to the share of what is used most; what is cut off below a nanometre keeps within it.
  const double pitch_use = std::max({largest_of(single_pitch(d.cumulative_pitch)) / limit.single_pitch,
                                     range(d.cumulative_pitch) / limit.cumulative_pitch,
                                     run_out(d.cumulative_pitch, design.pressure_angle) / limit.run_out});
  double profile_use = 0;
  for (int i = 0; i < teeth; ++i) {
    const double slope = std::abs(d.profile_slope[i]), form = std::abs(d.profile_form[i]);
    profile_use = std::max({profile_use, slope / limit.profile_slope, form / limit.profile_form,
                            (slope + form) / limit.profile_total});
  }
  const double spare = 2 * kResolution / std::min(limit.single_pitch, limit.profile_slope);
  for (double& x : d.cumulative_pitch) x = towards_zero(x * (share - spare) / pitch_use);
  for (auto* profile : {&d.profile_slope, &d.profile_form})
    for (double& x : *profile) x = towards_zero(x * (share - spare) / profile_use);
  return d;
}

}  // namespace

FlankTolerances iso_1328_tolerances(const GearDesign& design, int iso_class) {
  if (iso_class < 1 || iso_class > 11)
    fail(Failure::input, "iso_class = ", iso_class, " is no class of ISO 1328-1, which has 1 to 11");
  in_range("a number of teeth", design.teeth, 5, 1000, "");
  const double m = in_range("a module", design.module * 1e3, 0.5, 70, " mm");
  const double d = in_range("a reference diameter", m * design.teeth, 5, 15000, " mm");
  in_range("a face width", design.face_width * 1e3, 4, 1200, " mm");
  const double q = 1e-6 * std::pow(std::numbers::sqrt2, iso_class - 5);
  FlankTolerances t;
  t.single_pitch = (0.001 * d + 0.4 * m + 5) * q;                             // eq. 5
  t.cumulative_pitch = (0.002 * d + 0.55 * std::sqrt(d) + 0.7 * m + 12) * q;  // eq. 6
  t.profile_slope = (0.4 * m + 0.001 * d + 4) * q;                            // eq. 7
  t.profile_form = (0.55 * m + 5) * q;                                        // eq. 8
  t.profile_total = std::hypot(t.profile_slope, t.profile_form);              // eq. 9
  t.run_out = 0.9 * t.cumulative_pitch;
  return t;
}

std::vector<double> single_pitch(const std::vector<double>& cumulative) {
  std::vector<double> pitch;
  for (size_t i = 0; i < cumulative.size(); ++i)
    pitch.push_back(cumulative[i] - cumulative[(i + cumulative.size() - 1) % cumulative.size()]);
  return pitch;
}

ToothDeviations tooth_deviations(const GearDesign& design, const ToothErrors& errors, FlankSide flank) {
  const auto teeth = static_cast<size_t>(design.teeth);
  for (const auto& [key, list] : {std::pair{"single_pitch_um", &errors.single_pitch},
                                  std::pair{"cumulative_pitch_um", &errors.cumulative_pitch},
                                  std::pair{"profile_slope_um", &errors.profile_slope},
                                  std::pair{"profile_form_um", &errors.profile_form}})
    if (!list->empty() && list->size() != teeth)
      fail(Failure::input, key, " holds ", list->size(), " numbers, the gear has ", teeth,
           " teeth; give one for each");
  ToothDeviations d;
  if (errors.iso_class != 0) {
    d = drawn(design, errors.iso_class, errors.iso_share, errors.seed, flank);
  } else {
    for (auto* list : {&d.cumulative_pitch, &d.profile_slope, &d.profile_form}) list->assign(teeth, 0.0);
  }
  if (!errors.single_pitch.empty()) {
    const double sum = std::accumulate(errors.single_pitch.begin(), errors.single_pitch.end(), 0.0);
    const double most = kClosure * static_cast<double>(teeth);
    if (std::abs(sum) > most)
      fail(Failure::input, "single_pitch_um sums up to ", sum * 1e6,
           " over a turn, but pitches of a whole gear close to 0 (limit ", most * 1e6,
           ", for printed digits); correct them or give cumulative_pitch_um");
    double at = 0;  // tooth 0 is the reference
    for (size_t i = 1; i < teeth; ++i) {
      at += errors.single_pitch[i] - sum / static_cast<double>(teeth);
      d.cumulative_pitch[i] += at;
    }
  }
  const auto add = [](const std::vector<double>& list, std::vector<double>& to) {
    for (size_t i = 0; i < list.size(); ++i) to[i] += list[i];
  };
  add(errors.cumulative_pitch, d.cumulative_pitch);
  add(errors.profile_slope, d.profile_slope);
  add(errors.profile_form, d.profile_form);
  return d;
}

int hunting_periods_of(std::vector<int> teeth) {
  std::sort(teeth.begin(), teeth.end());
  teeth.erase(std::unique(teeth.begin(), teeth.end()), teeth.end());
  constexpr long kMostTold = 1000000000;  // eleven prime numbers of teeth have one beyond 64 bits
  long periods = 1;
  std::string numbers;
  for (const int own : teeth) {
    if (own == 1) continue;
    numbers += text(numbers.empty() ? "" : ", ", own);
    const long factor = std::max(1L, own / std::gcd(periods, static_cast<long>(own)));
    periods = periods > kMostTold / factor ? kMostTold + 1 : periods * factor;
  }
  if (periods > kMostHuntingPeriods)
    fail(Failure::input, "the same teeth meet again after ",
         periods > kMostTold ? text("more than ", kMostTold) : text(periods),
         " mesh periods, the least common multiple of the numbers of teeth of the gears whose teeth differ (",
         numbers, "); a system is computed over ", kMostHuntingPeriods,
         " at most: give errors to fewer gears, or to gears with a common divisor");
  return static_cast<int>(periods);
}

int hunting_periods(const Scene& scene) {
  if (scene.pair()) {
    const SceneGear &a = scene.gear(scene.mesh().gear[0]), &b = scene.gear(scene.mesh().gear[1]);
    return std::lcm(a.teeth_differ() ? a.design.teeth : 1, b.teeth_differ() ? b.design.teeth : 1);
  }
  std::vector<int> teeth;
  teeth.reserve(scene.gears.size());
  for (const SceneGear& gear : scene.gears)
    if (gear.teeth_differ()) teeth.push_back(gear.design.teeth);
  return hunting_periods_of(teeth);
}

int static_positions(const Scene& scene) {
  constexpr int kMostInAll = 16384, kLeast = 16, kUsual = 128;
  if (scene.contact.positions > 0) return scene.contact.positions;
  const int periods = hunting_periods(scene),
            most = scene.pair() ? std::max(kUsual, scene.time.steps_per_period) : kUsual;
  return periods > 1 ? std::clamp(kMostInAll / periods, kLeast, most) : most;
}

}  // namespace whine
