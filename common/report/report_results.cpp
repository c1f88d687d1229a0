#include "report/report_results.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/format.h"
#include "base/units.h"
#include "gear/friction.h"
#include "gear/hertz.h"
#include "gear/pair.h"
#include "report/alike_meshes.h"
#include "report/figures.h"
#include "report/iso_comparison.h"
#include "report/measured_errors.h"
#include "report/report_gears.h"
#include "report/response_figures.h"
#include "report/result_groups.h"
#include "report/sweep_panels.h"
#include "signal/response.h"

namespace whine {
namespace {

using Eigen::Index;
using Numbers = std::vector<ReportNumber>;
using namespace groups;

// One definition at rest and in motion, so that the two can be compared.
const std::string kNominalPressure =
    "nominal contact pressure of the largest tooth load (Hertz, at the pitch point)";

constexpr double kNothing = 1e-3;  // N: what is left of a first order that cancels

// Adds numbers of the whole, of a mesh or of a body at one torque to a group.
struct Adder {
  double torque;  // N m
  TurningMember driver;
  Numbers* out;
  ReportNumber::Of of = ReportNumber::Of::whole;
  size_t column = 0;
  std::string part = "";
  const char* group = "";
  std::string way = "";

  // Of mesh or body i of `count`, the names of which are given.
  Adder at(ReportNumber::Of what, const std::vector<std::string>& names, size_t i) const {
    Adder out_of_part = *this;
    out_of_part.of = what;
    out_of_part.column = column * names.size() + i;
    if (names.size() > 1) out_of_part.part = names[i];
    return out_of_part;
  }
  void operator()(const std::string& quantity, const std::string& unit, const std::string& value,
                  const std::string& remark = "") const {
    out->push_back({group, torque, quantity + way, unit, value, remark, way, "", "", part, of, column});
  }
  // With an absolute error in this unit or, below 0, without and as `plain`.
  void told(const std::string& quantity, const std::string& unit, double value, double error,
            const std::string& plain, const std::string& remark = "") const {
    const ToldNumber with = whine::told(value, error, kToldDigits);
    (*this)(quantity, unit, with.error.empty() ? plain : with.value, remark);
    out->back().error = with.error;
  }
  // With a relative error, below 0 without: the value may be 0.
  void judged(const std::string& quantity, const std::string& unit, double value, double error,
              const std::string& plain, const std::string& remark = "") const {
    told(quantity, unit, value, error < 0 ? error : error * value, plain, remark);
  }
  // error: relative
  void speed(const std::string& quantity, double mesh_frequency, const std::string& remark = "",
             double error = kNoError) const {
    judged(quantity, "Hz", mesh_frequency, error, hertz(mesh_frequency), remark);
    if (driver.turns > 0) out->back().rpm = fixed(driver.rpm(mesh_frequency), 0);
  }
  // words(scale): of the speeds, which are mesh frequencies times a scale.
  void speeds(const std::string& quantity, const auto& words) const {
    (*this)(quantity, "Hz", words(1.0));
    if (driver.turns > 0) out->back().rpm = words(driver.rpm(1));
  }
  // N: amplitude of a first order, and the level of its RMS where it is more than what rounding leaves.
  void first_order(const std::string& of_what, double amplitude, const std::string& remark = "") const {
    (*this)(of_what, "N", fixed(amplitude, 2), remark);
    if (amplitude > kNothing)
      (*this)("level of the RMS of that order", "dB re 1 N", decibels(amplitude), remark);
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

void add_loads_at_rest(const SystemStaticResult& rest, size_t m, Adder add) {
  const StaticResult& s = rest.mesh[m];
  const auto column = static_cast<Index>(m);
  add.group = kLoads;
  add("static tooth load, largest", "N", fixed(s.tooth_load.maxCoeff(), 1));
  add("load of one pair alone, " + plain_force_name(s), "N", fixed(static_force(s), 1));
  add.group = kForce;
  add("mesh force at rest, mean", "N", fixed(rest.mesh_force.col(column).mean(), 1));
  add("mesh force at rest, largest", "N", fixed(rest.mesh_force.col(column).maxCoeff(), 1));
  add.group = kSharing;
  if (!shares_load(rest, m)) return;
  add("share of the load at rest, mean", "%", fixed(rest.load_share.col(column).mean() * kPercent, 2));
  add("share of the load at rest, largest", "%", fixed(rest.load_share.col(column).maxCoeff() * kPercent, 2));
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
  for (Index g = 0; g < s.face.load_factor_root.size(); ++g) {
    const std::string& gear = s.mesh.gear[static_cast<size_t>(g)];
    add("root stress of " + gear + " over its mean over the face (K_Fβ), largest at rest", "1",
        fixed(s.face.load_factor_root[g], 3));
    add("error of that stress, by points along the line and degree over the face", "MPa",
        significant(s.face.root_stress_error[g] * 1e-6, 1));
  }
  if (s.gear[0].design.helical())
    add("axial force on " + s.mesh.gear[0] + ", to the viewer who sees it turn counter-clockwise", "N",
        fixed(s.face.axial_force, 0));
}

// Of trains in slices.
void add_thrust(const SystemStaticResult& rest, Index body, Adder add) {
  if (rest.axial_force.size() == 0) return;
  add.group = kBearings;
  add("axial force, mean, towards the viewer of the picture", "N",
      fixed(rest.axial_force.col(body).mean(), 1));
  double tilting = 0;
  for (const MatrixRM& at : rest.tilting_moment) tilting = std::max(tilting, at.row(body).norm());
  add("tilting moment about the middle of the face, which bearings or shafts hold, largest", "N m",
      fixed(tilting, 2));
}

void add_body_at_rest(const ReportContent& c, const SystemStaticResult& rest, size_t b, Adder add) {
  const auto column = static_cast<Index>(b);
  add.group = kTorques;
  add("torque, mean", "N m", fixed(rest.torque.col(column).mean(), 2), held_words(c, b));
  add("torque, peak to peak", "N m", fixed(peak_to_peak(rest.torque.col(column)), 2));
  add_thrust(rest, column, add);
  const auto phases = static_cast<Index>(rest.bearing_force.size());
  if (phases == 0) return;
  MatrixRM force(phases, 2);
  for (Index i = 0; i < phases; ++i) force.row(i) = rest.bearing_force[static_cast<size_t>(i)].row(column);
  if (!rest.of_train())  // its driven gear stands above the driver there, beside it on the page
    force = (MatrixRM(phases, 2) << force.col(1), -force.col(0)).finished();
  const Eigen::RowVector2d mean = force.colwise().mean();
  add.group = kBearings;
  add("force on the bearing, mean", "N", fixed(mean.norm(), 1));
  add("its mean along x, to the right", "N", fixed(mean.x(), 1));
  add("its mean along y, upwards", "N", fixed(mean.y(), 1));
  add("force on the bearing, largest", "N", fixed(force.rowwise().norm().maxCoeff(), 1));
  add("force on the bearing, RMS of the oscillating part", "N",
      fixed((force.rowwise() - mean).rowwise().norm().norm() / std::sqrt(phases), 2));
  add.first_order("force on the bearing, first order", first_order_of_force(force, rest.hunting_periods));
}

void add_stress_at_rest(const StaticResult& s, const ErrorBudgetResult* budget, Adder add) {
  add.group = kStress;
  add(text("static: ", kNominalPressure), "MPa",
      fixed(hertz_contact(s, s.tooth_load.maxCoeff()).pressure * kInMegapascals, 0));
  const FlankPressure& pressure = s.flank_pressure;
  if (pressure.smooth > 0)
    add.judged("static contact pressure inside a flank, largest", "MPa", pressure.smooth * 1e-6,
               sum_of(budget, &StaticChanges::pressure_change), fixed(pressure.smooth * kInMegapascals, 0));
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

auto decimals(int digits) {
  return [digits](double value) { return fixed(value, digits); };
}

// What a response says of one direction, each group in a function of its own; `add` of the whole.
class InMotion {
 public:
  // errors: of this direction; nullptr: not measured
  InMotion(const SystemStaticResult& rest, const ResponseResult& r, const SweepErrorsResult* errors,
           Adder add)
      : rest_(rest), r_(r), errors_(errors), add_(std::move(add)) {
    add_.way = r.direction == Direction::up ? ", speed rising" : ", speed falling";
  }
  // What follows is of this mesh.
  void of_mesh(size_t m) {
    mesh_ = static_cast<Index>(m);
    add_ = add_.at(ReportNumber::Of::mesh, r_.mesh_names, m);
  }

  void whole() {
    add_.group = kSpeeds;
    add_.speeds("resonances: peaks of the vibration", [&](double scale) {
      std::string list;
      for (const Index i : resonances(r_.mesh_frequency, r_.dte_rms.rowwise().maxCoeff()))
        list += (list.empty() ? "" : ", ") + fixed(r_.mesh_frequency[i] * scale, 0);
      return list.empty() ? std::string("none") : list;
    });
    add_jumps();
    if (!speeds_beyond_backlash({&r_}).empty())
      add_.speeds("motion beyond the backlash",
                  [&](double scale) { return speeds_beyond_backlash({&r_}, scale); });
    losses();
    add_.group = kSweeps;
    add_("speeds", "1", text(r_.mesh_frequency.size()));
    for (const auto& [what, is] : {std::pair{"speeds whose motion is not periodic", 0},
                                   std::pair{"speeds whose motion repeats after several mesh periods", 1}}) {
      std::map<double, bool> marked;
      for (Index i = 0; i < r_.mesh_frequency.size(); ++i)
        marked[r_.mesh_frequency[i]] =
            is == 0 ? r_.period_multiple[i] == 0 : r_.period_multiple[i] > r_.hunting_periods;
      add_(what, "1",
           text(std::count_if(marked.begin(), marked.end(), [](const auto& f) { return f.second; })),
           speed_ranges(marked));
    }
    add_("mesh periods run, most", "1", text(r_.periods.maxCoeff()));
    add_("energy that is not accounted for, over that which goes through, largest", "1",
         shown(r_.energy_imbalance.maxCoeff(), 3));
  }

  void contact() {
    add_.group = kSpeeds;
    add_.speeds("contact lost", [&](double scale) { return loss_ranges(r_, scale, mesh_); });
    peak(add_, {"time without contact, largest", "%", "time"}, r_.separation_fraction.col(mesh_) * kPercent,
         decimals(2));
  }

  void vibration() {
    add_.group = kVibration;
    const auto four = [](double value) { return significant(value, 4); };
    peak(add_, {"largest RMS of the dynamic transmission error", "µm", "RMS"}, r_.dte_rms.col(mesh_) * kMicro,
         four, &SweepErrorsResult::dte_rms);
    peak(add_, {"largest first order of the dynamic transmission error", "µm", "order"},
         first_order_of(r_.dte_harmonic, mesh_) * kMicro, four, &SweepErrorsResult::dte_first_order);
  }

  void loads() {
    add_.group = kLoads;
    const Eigen::VectorXd load = r_.tooth_load_max.col(mesh_);
    peak(add_, {"largest tooth load", "N", "tooth load"}, load, decimals(1),
         &SweepErrorsResult::tooth_load_max);
    if (const double alone = static_force(mesh()); alone > 0)
      peak(add_, {"largest tooth load over " + plain_force_name(mesh()), "1", ""}, load / alone, decimals(2),
           &SweepErrorsResult::tooth_load_max);
    if (r_.tooth_load_sustained.size() > 0)
      peak(add_, {"largest tooth load that is sustained for 1/64 of a mesh period", "N", ""},
           r_.tooth_load_sustained.col(mesh_), decimals(1), &SweepErrorsResult::tooth_load_sustained);
    if (!shares_load(rest_, static_cast<size_t>(mesh_)) || r_.load_share_max.size() == 0) return;
    add_.group = kSharing;
    peak(add_, {"share of the load in motion, largest", "%", "share"},
         r_.load_share_max.col(mesh_) * kPercent, decimals(2));
  }

  void force() {
    add_.group = kForce;
    const Eigen::VectorXd force = r_.mesh_force_max.col(mesh_);
    const double at_rest = rest_force(rest_, static_cast<size_t>(mesh_));
    peak(add_, {"largest mesh force", "N", "mesh force"}, force, decimals(1));
    if (at_rest > 0)
      peak(add_, {"largest mesh force over its mean at rest", "1", ""}, force / at_rest, decimals(2));
    if (const DynamicFactorPeak top = largest_dynamic_factor(rest_, r_, static_cast<size_t>(mesh_));
        top.factor > 0) {
      add_.judged(
          "dynamic factor: largest mesh force, sustained for 1/64 of a mesh period, over its mean at rest",
          "1", top.factor, error(&SweepErrorsResult::mesh_force_max, top.row), fixed(top.factor, 2),
          star(top.row));
      add_.speed("mesh frequency of that factor", r_.mesh_frequency[top.row], star(top.row));
      if (top.standard) add_("K_v of ISO 6336-1, method B, at that speed", "1", fixed(*top.standard, 2));
    }
    first_order(add_, "mesh force", first_order_of(r_.mesh_force_harmonic, mesh_));
  }

  void face() {
    if (r_.face_load_factor.size() == 0) return;
    add_.group = kFace;
    peak(add_, {"largest face load factor K_Hβ in motion, of the most loaded pair", "1", "factor K_Hβ"},
         r_.face_load_factor.col(mesh_), decimals(3));
    peak(add_, {"largest line load in motion, inner 90 % of face and path", "N/mm", "line load"},
         r_.line_load_max.col(mesh_) * 1e-3, decimals(1));
  }

  void stress() {
    add_.group = kStress;
    Index at = 0;
    const double load = r_.tooth_load_max.col(mesh_).maxCoeff(&at);
    add_(kNominalPressure, "MPa", fixed(hertz_contact(mesh(), load).pressure * kInMegapascals, 0), star(at));
    for (Index g = 0; g < mesh().root_stress_max.size(); ++g) {
      const Index side = kSides * mesh_ + g;
      if (!known_of(r_.root_stress_sustained, side)) continue;
      const Eigen::VectorXd stress = r_.root_stress_sustained.col(side);
      const std::string of =
          "largest root stress of " + r_.name_of_side(side) + " (sustained for 1/64 of a mesh period)";
      peak(add_, {of, "MPa", ""}, stress * kInMegapascals, decimals(1));
      peak(add_, {of + " over that at rest", "1", ""}, stress / mesh().root_stress_max[g], decimals(2));
    }
  }

  void body(size_t b) {
    const auto column = static_cast<Index>(b);
    if (r_.bearing_force_max.size() == 0 || (!r_.of_train() && !known_of(r_.bearing_force_max, column)))
      return;
    Adder add = add_.at(ReportNumber::Of::body, r_.body_names, b);
    add.group = kMovingBearings;
    peak(add, {"largest RMS of the oscillating force on the bearing", "N", "RMS"},
         r_.bearing_force_rms.col(column), decimals(2));
    peak(add, {"largest force on the bearing", "N", "force"}, r_.bearing_force_max.col(column), decimals(1));
    first_order(add, "force on the bearing", first_order_of(r_.bearing_force_harmonic, column));
  }

 private:
  const StaticResult& mesh() const { return rest_.mesh[static_cast<size_t>(mesh_)]; }
  std::string star(Index row) const { return beyond_backlash(r_, row) ? kBeyond : ""; }
  double error(SweepErrorsResult::Judged SweepErrorsResult::*quantity, Index row) const {
    return error_near(errors_, quantity, r_.mesh_frequency[row], static_cast<size_t>(mesh_));
  }

  // that: what "mesh frequency of that ..." calls it, "" without that row.
  struct Named {
    std::string quantity, unit, that;
  };
  // The largest of the values over speed and, unless it is 0, where it is.
  void peak(const Adder& add, const Named& what, const Eigen::VectorXd& values, const auto& words,
            SweepErrorsResult::Judged SweepErrorsResult::*judged = nullptr) const {
    Index at = 0;
    const double most = values.maxCoeff(&at);
    add.judged(what.quantity, what.unit, most, judged ? error(judged, at) : kNoError, words(most), star(at));
    if (!what.that.empty() && most > 0)
      add.speed("mesh frequency of that " + what.that, r_.mesh_frequency[at], star(at));
  }
  void first_order(const Adder& add, const std::string& of, const Eigen::VectorXd& first) const {
    if (first.size() == 0) return;
    Index at = 0;
    const double most = first.maxCoeff(&at);
    add.first_order("largest first order of the " + of, most, star(at));
    add.speed("mesh frequency of that order of the force", r_.mesh_frequency[at], star(at));
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
      add_.out->back().error = whine::told(f[0], jump_error_at(errors_, f[0]), kToldDigits).error;
  }
  void losses() {
    if (r_.friction.efficiency.size() == 0) return;
    add_.group = kLosses;
    const Eigen::VectorXd percent = r_.friction.efficiency * kPercent;
    Index at = 0;
    add_("least efficiency in motion (friction between the flanks alone)", "%",
         fixed(percent.minCoeff(&at), 3), star(at));
    add_.speed("mesh frequency of that efficiency", r_.mesh_frequency[at], star(at));
    peak(add_, {"largest efficiency in motion", "%", ""}, percent, decimals(3));
    peak(add_, {"largest power that friction takes", "W", "power"}, r_.friction.power,
         [](double value) { return shown(value, 4); });
  }

  const SystemStaticResult& rest_;
  const ResponseResult& r_;
  const SweepErrorsResult* errors_;
  Adder add_;
  Index mesh_ = 0;
};

void add_motion(const ReportContent& c, const SystemStaticResult& rest, Adder add) {
  std::vector<const ResponseResult*> sweeps;
  for (const Direction direction : {Direction::up, Direction::down})
    if (const ResponseResult* sweep = sweep_of(c, add.torque, direction)) sweeps.push_back(sweep);
  if (sweeps.empty()) return;
  const auto moving = [&](const ResponseResult* sweep) {
    return InMotion(rest, *sweep, errors_of(c, add.torque, sweep->direction), add);
  };
  const ResponseResult& first = *sweeps.front();
  add.group = kSpeeds;
  const std::array ends{std::pair{"lowest", first.mesh_frequency.minCoeff()},
                        std::pair{"highest", first.mesh_frequency.maxCoeff()}};
  for (const auto& [what, f] : ends) add.speed(text("mesh frequency, ", what), f);
  const SweepErrorsResult* errors = errors_of(c, add.torque, first.direction);
  if (first.natural_frequency > 0)
    add.speed("natural frequency f_n, contact frozen, mean over the period", first.natural_frequency, "",
              errors ? errors->natural_frequency_error : kNoError);
  for (const ResponseResult* sweep : sweeps) moving(sweep).whole();
  using Group = void (InMotion::*)();
  for (size_t m = 0; m < rest.mesh.size(); ++m) {
    Adder of_mesh = add.at(ReportNumber::Of::mesh, rest.mesh_names, m);
    for (const auto& [what, f] : ends)
      of_mesh(text("pitch-line speed, ", what), "m/s", fixed(pitch_line_speed(GearPair(rest.mesh[m]), f), 1));
    for (const Group group : {&InMotion::contact, &InMotion::vibration, &InMotion::loads, &InMotion::force,
                              &InMotion::face, &InMotion::stress})
      for (const ResponseResult* sweep : sweeps) {
        InMotion motion = moving(sweep);
        motion.of_mesh(m);
        (motion.*group)();
      }
  }
  for (size_t b = 0; b < rest.body_names.size(); ++b)
    for (const ResponseResult* sweep : sweeps) moving(sweep).body(b);
}

void add_mesh_at_rest(const SystemStaticResult& rest, size_t m, const ErrorBudgetResult* budget, Adder add) {
  const StaticResult& s = rest.mesh[m];
  add_excitation(s, budget, add);
  if (rest.of_train()) {
    add.group = kExcitation;
    add("mean mesh stiffness, contact frozen", "N/µm", shown(s.stiffness_tangent.mean() * 1e-6, 5));
    add("contact ratio", "1", fixed(s.contact_ratio, 3));
    add("mesh phase", "1", fixed(rest.settings.layout.meshes[m].phase, 4));
  }
  add_loads_at_rest(rest, m, add);
  add_face_at_rest(s, add);
  add_stress_at_rest(s, budget, add);
  add_losses(s, add);
}

void add_modes(const ModesResult& a, const Adder& add) {
  for (Index i = 0; i < a.natural_frequency.size(); ++i) {
    const double f = a.natural_frequency[i];
    add("natural frequency", "Hz", shown(f, 7),
        f == 0 ? "free motion" : name_of(a.type[static_cast<size_t>(i)]));
    add.out->back().part = text("mode ", i + 1);
  }
}

}  // namespace

std::vector<ReportNumber> report_numbers(const ReportContent& c) {
  Numbers out;
  const TurningMember driver = driver_of(c);
  for (size_t column = 0; column < c.statics.size(); ++column) {
    const SystemStaticResult& rest = c.statics[column];
    const double torque = torque_of(rest);
    Adder add{torque, driver, &out, ReportNumber::Of::whole, column};
    for (size_t m = 0; m < rest.mesh.size(); ++m)
      add_mesh_at_rest(rest, m, budget_of(c, torque), add.at(ReportNumber::Of::mesh, rest.mesh_names, m));
    add.group = kSharing;
    for (const LoadSharing& of : load_sharing(rest))
      for (const auto& [what, factor] : {std::pair{"load sharing factor", of.factor},
                                         std::pair{"the same of mean shares, K_γ", of.mean_factor}}) {
        add(what, "1", fixed(factor, 3));
        out.back().part = of.name;
      }
    for (size_t b = 0; b < rest.body_names.size() && rest.torque.size() > 0; ++b)
      add_body_at_rest(c, rest, b, add.at(ReportNumber::Of::body, rest.body_names, b));
    if (const ImpactResult* a = impact_of(c, torque)) add_ring_down(a->states, add);
    add_motion(c, rest, add);
  }
  if (c.modes) add_modes(*c.modes, {0, driver, &out, ReportNumber::Of::mode, 0, "", kNatural});
  return out;
}

}  // namespace whine
