#include "report/report_results.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/error.h"
#include "base/format.h"
#include "gear/friction.h"
#include "gear/hertz.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/iso_comparison.h"
#include "report/measured_errors.h"
#include "report/response_figures.h"

namespace whine {
namespace {

using Eigen::Index;
using Numbers = std::vector<ReportNumber>;

// One definition at rest and in motion, so that the two can be compared.
const std::string kNominalPressure =
    "nominal contact pressure of the largest tooth load (Hertz, at the pitch point)";
constexpr const char* kBeyond = "beyond the backlash";

constexpr const char* kExcitation = "Excitation, at rest";
constexpr const char* kNatural = "Natural frequencies and damping";
constexpr const char* kSpeeds = "Speeds";
constexpr const char* kVibration = "Vibration";
constexpr const char* kLoads = "Loads";
constexpr const char* kFace = "Load over the face";
constexpr const char* kBearings = "Forces on the bearings";
constexpr const char* kStress = "Stress";
constexpr const char* kLosses = "Losses";
// In the order of the page.
constexpr std::array kGroups{kExcitation, kNatural,  kSpeeds, kVibration, kLoads,
                             kFace,       kBearings, kStress, kLosses};

// Adds numbers of one torque to a group.
struct Adder {
  double torque;         // N m
  double rpm_per_hertz;  // of the driver
  Numbers& out;
  size_t column = 0;
  const char* group = "";
  std::string way = "";

  void operator()(const std::string& quantity, const std::string& unit, const std::string& value,
                  const std::string& remark = "") const {
    out.push_back({group, torque, quantity + way, unit, value, remark, way, "", column});
  }
  // With an absolute error in this unit or, below 0, without and as `plain`.
  void told(const std::string& quantity, const std::string& unit, double value, double error,
            const std::string& plain, const std::string& remark = "") const {
    const ToldNumber with = whine::told(value, error, kToldDigits);
    (*this)(quantity, unit, with.error.empty() ? plain : with.value, remark);
    out.back().error = with.error;
  }
  // With a relative error, of values above 0.
  void judged(const std::string& quantity, const std::string& unit, double value, double error,
              const std::string& plain, const std::string& remark = "") const {
    told(quantity, unit, value, error * value, plain, remark);
  }
  // error: relative
  void speed(const std::string& quantity, double mesh_frequency, const std::string& remark = "",
             double error = kNoError) const {
    judged(quantity, "Hz", mesh_frequency, error, hertz(mesh_frequency), remark);
    out.back().rpm = fixed(mesh_frequency * rpm_per_hertz, 0);
  }
  // words(scale): of the speeds, which are mesh frequencies times a scale.
  void speeds(const std::string& quantity, const auto& words) const {
    (*this)(quantity, "Hz", words(1.0));
    out.back().rpm = words(rpm_per_hertz);
  }
};

void add_excitation(const StaticResult& s, const ErrorBudgetResult* budget, Adder add) {
  add.group = kExcitation;
  const double stiffness_error = sum_of(budget, &StaticChanges::mean_stiffness_change),
               mean = s.transmission_error.mean() * kMicro,
               swing = peak_to_peak(s.transmission_error) * kMicro;
  add.judged("static transmission error, mean", "µm", mean, stiffness_error, significant(mean, 4));
  add.judged("static transmission error, peak to peak", "µm", swing,
             sum_of(budget, &StaticChanges::peak_to_peak_change), significant(swing, 4));
  for (Index n = 1; n <= std::min<Index>(3, s.transmission_error_harmonic.size() - 1); ++n)
    add.told(text("static transmission error, harmonic ", n), "µm", s.transmission_error_harmonic[n] * kMicro,
             harmonic_error(budget, n, s.transmission_error_harmonic[1]) * kMicro,
             significant(s.transmission_error_harmonic[n] * kMicro, 3));
  const double stiffness = s.mean_stiffness * kMega, of_width = stiffness / (s.face_width() * kMilli);
  add.judged("mean mesh stiffness", "N/µm", stiffness, stiffness_error, fixed(stiffness, 1));
  add.judged("mean mesh stiffness per mm of face width", "N/µm", of_width, stiffness_error,
             fixed(of_width, 2));
  if (s.stiffness_harmonic.size() > 1 && s.mean_stiffness > 0)
    add("first harmonic of the mesh stiffness over its mean", "%",
        fixed(s.stiffness_harmonic[1] / s.stiffness_harmonic[0] * kPercent, 2));
}

void add_loads_at_rest(const StaticResult& s, Adder add) {
  add.group = kLoads;
  add("static tooth load, largest", "N", fixed(s.tooth_load.maxCoeff(), 0));
  add("load of one pair alone, " + plain_force_name(s), "N", fixed(static_force(s), 0));
}

// Not of one slice.
void add_face_at_rest(const StaticResult& s, Adder add) {
  if (s.face.none()) return;
  add.group = kFace;
  add("face load factor K_Hβ at rest, reference pair at the pitch point", "1", fixed(s.face.load_factor, 3));
  add("its error, by points along the line and degree over the face", "1",
      significant(s.face.load_factor_error, 1));
  add("largest line load at rest, inner 90 % of face and path", "N/mm",
      fixed(s.face.line_load_max * 1e-3, 1));
  if (s.gear[0].design.helical())
    add("axial force on " + s.mesh.gear[0] + ", to the viewer who sees it turn counter-clockwise", "N",
        fixed(s.face.axial_force, 0));
}

void add_bearings_at_rest(const StaticResult& s, Adder add) {
  add.group = kBearings;
  for (size_t g = 0; g < kSides; ++g) {
    if (s.bearing_force[g].size() == 0 || s.hunting_periods > 1) continue;
    const std::string of = "static force on the bearing of " + s.mesh.gear[g] + ", first order";
    const double amplitude = first_order_of_force(s.bearing_force[g]);
    add(of, "N", significant(amplitude, 3));
  }
}

void add_stress_at_rest(const StaticResult& s, const ErrorBudgetResult* budget, Adder add) {
  add.group = kStress;
  add(text("static: ", kNominalPressure), "MPa",
      fixed(hertz_contact(s, s.tooth_load.maxCoeff()).pressure * 1e-6, 0));
  const FlankPressure& pressure = s.flank_pressure;
  if (pressure.smooth > 0)
    add.judged("static contact pressure inside a flank, largest", "MPa", pressure.smooth * 1e-6,
               sum_of(budget, &StaticChanges::pressure_change), fixed(pressure.smooth * 1e-6, 0));
  if (pressure.on_ridge > pressure.smooth)
    add("the same where relief begins", "MPa", "no value: see the warnings");
  for (int g = 0; g < s.root_stress_max.size(); ++g)
    add.judged("static root stress of " + s.mesh.gear[g] + ", largest", "MPa", s.root_stress_max[g] * 1e-6,
               sum_of(budget, &StaticChanges::root_stress_change), fixed(s.root_stress_max[g] * 1e-6, 1));
}

void add_losses(const StaticResult& s, Adder add) {
  add.group = kLosses;
  if (s.loss_factor > 0)
    add("loss factor H_V at rest (power lost over power carried and coefficient of friction)", "1",
        fixed(s.loss_factor, 4));
  if (s.friction_loss.size() > 0) {
    add("coefficient of friction at rest", "1", fixed(s.friction_coefficient, 4));
    add("efficiency at rest (friction between the flanks alone)", "%", fixed(s.efficiency * kPercent, 3));
  }
}

void add_ring_down(const ContactStateDecays& a, Adder add) {
  add.group = kNatural;
  for (size_t i = 0; i < a.contact_state.size(); ++i) {
    const Index at = static_cast<Index>(i);
    const std::string state =
        at < a.mesh_phase.size()
            ? name_of(a.contact_state[i]) + (a.contact_state[i] == ContactState::one ? " pair" : " pairs")
            : "mean over the period";
    add.speed("natural frequency by ring-down, " + state, a.natural_frequency[at]);
    add("damping ratio by ring-down, " + state, "%", fixed(a.damping_ratio[at] * kPercent, 2));
  }
}

// Values over speed of a gear; empty where they are not known.
Eigen::VectorXd of_gear(const MatrixRM& values, size_t gear) {
  const auto column = static_cast<Index>(gear);
  return known_of(values, column) ? Eigen::VectorXd(values.col(column)) : Eigen::VectorXd();
}

// What a response says of one direction, each group in a function of its own.
class InMotion {
 public:
  // errors: of this direction; nullptr: not measured
  InMotion(const StaticResult& s, const ResponseResult& r, const SweepErrorsResult* errors, Adder add)
      : s_(s), r_(r), errors_(errors), add_(std::move(add)) {
    add_.way = r.direction == Direction::up ? ", speed rising" : ", speed falling";
  }

  void speeds() {
    add_.group = kSpeeds;
    add_.speeds("resonances: peaks of the vibration", [&](double scale) {
      std::string list;
      for (const Index i : resonances(r_))
        list += (list.empty() ? "" : ", ") + fixed(r_.mesh_frequency[i] * scale, 0);
      return list.empty() ? std::string("none") : list;
    });
    add_jumps();
    add_.speeds("contact lost", [&](double scale) { return loss_ranges(r_, scale); });
    if (!speeds_beyond_backlash({&r_}).empty())
      add_.speeds("motion beyond the backlash",
                  [&](double scale) { return speeds_beyond_backlash({&r_}, scale); });
  }

  void vibration() {
    add_.group = kVibration;
    Index at = 0;
    const double rms = r_.dte_rms.col(0).maxCoeff(&at);
    add_.judged("largest RMS of the dynamic transmission error", "µm", rms * kMicro,
                error(&SweepErrorsResult::dte_rms, at), significant(rms * kMicro, 3), star(at));
    add_.speed("mesh frequency of that RMS", r_.mesh_frequency[at], star(at));
    const double first = first_order_of(r_.dte_harmonic, 0).maxCoeff(&at);
    add_.judged("largest first order of the dynamic transmission error", "µm", first * kMicro,
                error(&SweepErrorsResult::dte_first_order, at), significant(first * kMicro, 3), star(at));
    add_.speed("mesh frequency of that order", r_.mesh_frequency[at], star(at));
  }

  void loads() {
    add_.group = kLoads;
    Index at = 0;
    const double load = r_.tooth_load_max.col(0).maxCoeff(&at);
    const double load_error = error(&SweepErrorsResult::tooth_load_max, at);
    add_.judged("largest tooth load", "N", load, load_error, fixed(load, 0), star(at));
    add_.speed("mesh frequency of that tooth load", r_.mesh_frequency[at], star(at));
    add_.judged("largest tooth load over " + plain_force_name(s_), "1", load / static_force(s_), load_error,
                fixed(load / static_force(s_), 2), star(at));
    add_sustained();
    const DynamicFactorPeak peak = largest_dynamic_factor(s_, r_);
    add_.judged("dynamic factor: largest mesh force over " + plain_force_name(s_), "1", peak.factor,
                error(&SweepErrorsResult::mesh_force_max, peak.row), fixed(peak.factor, 2), star(peak.row));
    add_.speed("mesh frequency of that factor", r_.mesh_frequency[peak.row], star(peak.row));
    if (peak.standard) add_("K_v of ISO 6336-1, method B, at that speed", "1", fixed(*peak.standard, 2));
    if (const Eigen::VectorXd first = first_order_of(r_.mesh_force_harmonic, 0); first.size() > 0) {
      const double most = first.maxCoeff(&at);
      add_("largest first order of the mesh force", "N", fixed(most, 0), star(at));
      if (most > 0) add_("level of the RMS of that order", "dB re 1 N", decibels(most), star(at));
      add_.speed("mesh frequency of that order of the force", r_.mesh_frequency[at], star(at));
    }
  }

  void face() {
    if (r_.face_load_factor.size() == 0) return;
    add_.group = kFace;
    Index at = 0;
    const double factor = r_.face_load_factor.col(0).maxCoeff(&at);
    add_("largest face load factor K_Hβ in motion, of the most loaded pair", "1", fixed(factor, 3), star(at));
    add_.speed("mesh frequency of that factor K_Hβ", r_.mesh_frequency[at], star(at));
    const double load = r_.line_load_max.col(0).maxCoeff(&at);
    add_("largest line load in motion, inner 90 % of face and path", "N/mm", fixed(load * 1e-3, 1), star(at));
    add_.speed("mesh frequency of that line load", r_.mesh_frequency[at], star(at));
  }

  void bearings() {
    add_.group = kBearings;
    for (size_t g = 0; g < kSides; ++g) {
      const Eigen::VectorXd rms = of_gear(r_.bearing_force_rms, g),
                            largest = of_gear(r_.bearing_force_max, g);
      if (rms.size() == 0) continue;
      Index at = 0;
      const std::string of = "force on the bearing of " + s_.mesh.gear[g];
      const double force = rms.maxCoeff(&at);
      add_("largest RMS of the oscillating " + of, "N", fixed(force, 0), star(at));
      add_.speed("mesh frequency of that RMS, " + s_.mesh.gear[g], r_.mesh_frequency[at], star(at));
      const double most = largest.maxCoeff(&at);
      add_("largest " + of, "N", fixed(most, 0), star(at));
      if (const Eigen::VectorXd first = first_order_of(r_.bearing_force_harmonic, static_cast<Index>(g));
          first.size() > 0) {
        const double order = first.maxCoeff(&at);
        add_("largest first order of the " + of, "N", fixed(order, 0), star(at));
        if (order > 0)
          add_("level of the RMS of that order, " + s_.mesh.gear[g], "dB re 1 N", decibels(order), star(at));
      }
    }
  }

  void stress() {
    add_.group = kStress;
    Index at = 0;
    const double load = r_.tooth_load_max.col(0).maxCoeff(&at);
    add_(kNominalPressure, "MPa", fixed(hertz_contact(s_, load).pressure * 1e-6, 0), star(at));
    for (int g = 0; g < s_.root_stress_max.size(); ++g)
      if (const Eigen::VectorXd sustained = of_gear(r_.root_stress_sustained, static_cast<size_t>(g));
          sustained.size() > 0) {
        const std::string of = "root stress of " + s_.mesh.gear[g] + " (sustained for 1/64 of a mesh period)";
        const double stress = sustained.maxCoeff(&at);
        add_("largest " + of, "MPa", fixed(stress * 1e-6, 1), star(at));
        add_("largest " + of + " over that at rest", "1", fixed(stress / s_.root_stress_max[g], 2), star(at));
      }
  }

 private:
  std::string star(Index row) const { return beyond_backlash(r_, row) ? kBeyond : ""; }
  double error(SweepErrorsResult::Judged SweepErrorsResult::*quantity, Index row) const {
    return error_near(errors_, quantity, r_.mesh_frequency[row]);
  }

  // One jump is a number with its error, several are words.
  void add_jumps() {
    const Eigen::VectorXd& f = r_.jump_frequency;
    add_.speeds("jumps", [&](double scale) {
      std::string list;
      for (Index j = 0; j < f.size(); ++j) {
        const double error = scale * jump_error_at(errors_, f[j]);
        const ToldNumber jump = whine::told(scale * f[j], error, kToldDigits);
        list += text(j > 0 ? ", " : "", error < 0      ? fixed(scale * f[j], 0)
                                        : f.size() > 1 ? jump.words()
                                                       : jump.value);
      }
      return list.empty() ? std::string("none") : list;
    });
    if (f.size() == 1)
      add_.out.back().error = whine::told(f[0], jump_error_at(errors_, f[0]), kToldDigits).error;
  }
  void add_sustained() {
    if (r_.tooth_load_sustained.size() == 0) return;
    Index at = 0;
    const double load = r_.tooth_load_sustained.col(0).maxCoeff(&at);
    add_.judged("largest tooth load that is sustained for 1/64 of a mesh period", "N", load,
                error(&SweepErrorsResult::tooth_load_sustained, at), fixed(load, 0), star(at));
  }

  const StaticResult& s_;
  const ResponseResult& r_;
  const SweepErrorsResult* errors_;
  Adder add_;
};

void add_motion(const ReportContent& c, const StaticResult& s,
                const std::vector<const ResponseResult*>& sweeps, Adder add) {
  if (sweeps.empty()) return;
  const ResponseResult& first = *sweeps.front();
  const GearPair pair(s);
  add.group = kSpeeds;
  for (const auto& [what, f] : {std::pair{"lowest", first.mesh_frequency.minCoeff()},
                                std::pair{"highest", first.mesh_frequency.maxCoeff()}}) {
    add.speed(text("mesh frequency, ", what), f);
    add(text("pitch-line speed, ", what), "m/s", fixed(pitch_line_speed(pair, f), 1));
  }
  const SweepErrorsResult* errors = errors_of(c, s.torque, first.direction);
  add.speed("natural frequency f_n, contact frozen, mean over the period", first.natural_frequency, "",
            errors ? errors->natural_frequency_error : kNoError);
  using Group = void (InMotion::*)();
  for (const Group group : {&InMotion::speeds, &InMotion::vibration, &InMotion::loads, &InMotion::face,
                            &InMotion::bearings, &InMotion::stress})
    for (const ResponseResult* sweep : sweeps) {
      InMotion motion(s, *sweep, errors_of(c, s.torque, sweep->direction), add);
      (motion.*group)();
    }
}

// A row of a table: its numbers by torque and direction.
struct ResultRow {
  std::string group, label, unit;
  bool speeds = false;                                      // with a line in rpm
  std::array<bool, 2> way{};                                // rising, falling
  std::vector<std::array<const ReportNumber*, 3>> numbers;  // [column] of neither, rising, falling
};

size_t way_of(const ReportNumber& n) {
  return n.way.empty() ? 0 : n.way.ends_with("rising") ? 1 : 2;
}

std::vector<ResultRow> rows_of(const Numbers& results, size_t columns) {
  std::vector<ResultRow> rows;
  for (const ReportNumber& n : results) {
    const std::string label = n.quantity.substr(0, n.quantity.size() - n.way.size());
    auto row = std::find_if(rows.begin(), rows.end(),
                            [&](const ResultRow& r) { return r.label == label && r.group == n.group; });
    if (row == rows.end()) {
      rows.push_back({n.group, label, n.unit, false, {}, {}});
      rows.back().numbers.resize(columns);
      row = rows.end() - 1;
    }
    row->speeds = row->speeds || !n.rpm.empty();
    if (const size_t way = way_of(n); way > 0) row->way[way - 1] = true;
    row->numbers[n.column][way_of(n)] = &n;
  }
  return rows;
}

// Both directions of a sweep in one cell, "2640 / 2580"; in rpm, too, in a line of its own.
std::string cell_of(const std::array<const ReportNumber*, 3>& numbers) {
  std::string words, rpm;
  const auto add = [](std::string& line, const std::string& word) {
    if (!word.empty() && line != word) line += (line.empty() ? "" : " / ") + word;
  };
  for (const ReportNumber* n : numbers) {
    if (!n) continue;
    const std::string star = n->remark.empty() ? "" : " *";
    add(words, n->value + (n->error.empty() ? "" : " ± " + n->error) + star);
    if (!n->rpm.empty()) add(rpm, n->rpm + star);
  }
  return words + (rpm.empty() || rpm == words ? "" : "\n" + rpm);
}

std::string way_words(const ResultRow& row) {
  return row.way[0] && row.way[1] ? ", rising / falling"
         : row.way[0]             ? ", speed rising"
         : row.way[1]             ? ", speed falling"
                                  : "";
}

}  // namespace

std::vector<ReportNumber> mesh_at_rest(const StaticResult& s, size_t column,
                                       const ErrorBudgetResult* budget) {
  Numbers out;
  const Adder add{s.torque, 60.0 / s.gear[0].design.teeth, out, column};
  add_excitation(s, budget, add);
  add_loads_at_rest(s, add);
  add_face_at_rest(s, add);
  add_bearings_at_rest(s, add);
  add_stress_at_rest(s, budget, add);
  add_losses(s, add);
  return out;
}

std::vector<ReportNumber> report_numbers(const ReportContent& c) {
  Numbers out;
  for (size_t column = 0; column < c.statics.size(); ++column) {
    const StaticResult& s = c.statics[column];
    const Numbers rest = mesh_at_rest(s, column, budget_of(c, s.torque));
    out.insert(out.end(), rest.begin(), rest.end());
    const Adder add{s.torque, 60.0 / s.gear[0].design.teeth, out, column};
    std::vector<const ResponseResult*> sweeps;
    for (const Direction direction : {Direction::up, Direction::down})
      if (const ResponseResult* sweep = sweep_of(c, s.torque, direction)) sweeps.push_back(sweep);
    if (const ImpactResult* a = impact_of(c, s.torque)) add_ring_down(a->states, add);
    add_motion(c, s, sweeps, add);
  }
  return out;
}

std::string results_tables(const std::vector<ReportNumber>& results,
                           const std::vector<std::string>& columns) {
  const std::vector<ResultRow> rows = rows_of(results, columns.size());
  std::vector<std::string> head{"", "unit"};
  head.insert(head.end(), columns.begin(), columns.end());
  std::string out;
  for (const char* group : kGroups) {
    html::Rows cells;
    for (const ResultRow& row : rows) {
      if (row.group != group) continue;
      cells.push_back({row.label + way_words(row),
                       text(row.unit == "1" ? html::kNoValue : row.unit, row.speeds ? "\nrpm" : "")});
      for (const auto& numbers : row.numbers) cells.back().push_back(cell_of(numbers));
    }
    if (!cells.empty()) out += html::tagged("h3", group) + "\n" + html::table("", head, cells, "results");
  }
  if (std::any_of(results.begin(), results.end(), [](const ReportNumber& n) { return !n.remark.empty(); }))
    out += html::paragraph(
        "* At this speed the motion is larger than the backlash: back flanks would touch, which is not modelled, so the number is not to be trusted.");
  return out;
}

std::string results_tables(const ReportContent& c) {
  std::vector<std::string> columns;
  columns.reserve(c.statics.size());
  for (const StaticResult& s : c.statics) columns.push_back(torque_words(s.torque));
  return html::paragraph(text(
             "By torque on the driver",
             c.sweeps.empty() ? "" : "; speeds as mesh frequency and, below, as rotation of ",
             c.sweeps.empty() ? "" : c.statics[0].mesh.gear[0], "; results.tsv holds the same numbers.")) +
         results_tables(report_numbers(c), columns);
}

}  // namespace whine
