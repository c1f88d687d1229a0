#include "report/report_opening.h"

#include <map>

#include "report/figures.h"
#include "report/iso_comparison.h"
#include "report/measured_errors.h"
#include "report/opening.h"

namespace whine {
namespace {

using Eigen::Index;

struct FirstTorque {
  const StaticResult& rest;
  const ResponseResult *up, *down;  // nullptr: none
  const ImpactResult* ring_down;    // likewise
  TurningMember driver;
  const SweepErrorsResult *up_errors, *down_errors;  // likewise

  const SweepErrorsResult* errors_of(const ResponseResult* r) const {
    return r == up ? up_errors : down_errors;
  }
  const ResponseResult* sweep() const { return up ? up : down; }
  std::optional<SpeedRange> speeds() const {
    if (!sweep()) return std::nullopt;
    return SpeedRange{sweep()->mesh_frequency.minCoeff(), sweep()->mesh_frequency.maxCoeff()};
  }
};

// Speeds, and whether teeth part there.
std::map<double, bool> speeds_apart(const ResponseResult* r) {
  std::map<double, bool> apart;
  if (r)
    for (Index i = 0; i < r->mesh_frequency.size(); ++i)
      apart[r->mesh_frequency[i]] = r->separation_fraction(i, 0) > 0;
  return apart;
}

std::optional<Parting::Sweep> parting_sweep(const ResponseResult* r) {
  if (!r) return std::nullopt;
  return Parting::Sweep{marked_ranges(speeds_apart(r)), {r->jump_frequency.begin(), r->jump_frequency.end()}};
}

bool parts_at_torque(const ReportContent& c, double torque) {
  for (const Direction direction : {Direction::up, Direction::down})
    if (const ResponseResult* r = sweep_of(c, torque, direction))
      if (r->separation_fraction.maxCoeff() > 0) return true;
  return false;
}

std::string pair_excitation(const StaticResult& s, const ErrorBudgetResult* budget) {
  const double swing = peak_to_peak(s.transmission_error),
               first = s.transmission_error_harmonic.size() > 1 ? s.transmission_error_harmonic[1] : 0;
  return excitation_line(torque_words(s.torque),
                         {{"",
                           {swing, swing, swing * sum_of(budget, &StaticChanges::peak_to_peak_change)},
                           {first, first, harmonic_error(budget, 1, first)}}});
}

std::string pair_critical_speeds(const FirstTorque& t) {
  CriticalSpeeds out{t.driver, t.speeds(), {}, {}};
  const ResponseResult* r = t.sweep();
  if (r && r->natural_frequency > 0)
    out.natural.push_back(
        {r->natural_frequency, "the natural frequency of the mesh",
         t.errors_of(r) ? t.errors_of(r)->natural_frequency_error * r->natural_frequency : kNoError});
  else if (t.ring_down && t.ring_down->states.natural_frequency.size() > 0)
    out.natural.push_back(
        {t.ring_down->states.natural_frequency[t.ring_down->states.natural_frequency.size() - 1],
         "the natural frequency of the mesh"});
  if (r)
    for (const Index i : resonances(*r)) out.peaks.push_back(r->mesh_frequency[i]);
  return critical_speed_line(out);
}

std::string pair_parting(const ReportContent& c, const FirstTorque& t) {
  Parting out;
  out.member = t.driver;
  out.speeds = t.speeds();
  out.rising = parting_sweep(t.up);
  out.falling = parting_sweep(t.down);
  if (t.up && t.down) out.only_falling = marked_ranges(but_not(speeds_apart(t.down), speeds_apart(t.up)));
  for (const StaticResult& other : c.statics) {
    if (other.torque == t.rest.torque ||
        !(sweep_of(c, other.torque, Direction::up) || sweep_of(c, other.torque, Direction::down)))
      continue;
    (parts_at_torque(c, other.torque) ? out.parts_at : out.holds_at).push_back(torque_words(other.torque));
  }
  return parting_line(out);
}

std::string pair_dynamic_factor(const FirstTorque& t) {
  std::optional<DynamicFactorPeak> most;
  const ResponseResult* of = nullptr;
  for (const ResponseResult* r : {t.up, t.down}) {
    if (!r) continue;
    const DynamicFactorPeak peak = largest_dynamic_factor(t.rest, *r);
    if (most && most->factor >= peak.factor) continue;
    most = peak;
    of = r;
  }
  if (!most) return dynamic_factor_line(t.driver, {}, "");
  const double at = of->mesh_frequency[most->row],
               error = error_near(t.errors_of(of), &SweepErrorsResult::mesh_force_max, at);
  return dynamic_factor_line(t.driver, {{"", most->factor, at, most->standard, error * most->factor}},
                             most->why_none);
}

// N: largest load at rest of a pair that touches over a tip edge, where no pressure is stated.
double largest_edge_load(const StaticResult& s) {
  return s.contact_pressure.size() == 0
             ? 0
             : (s.contact_pressure.array() == 0).select(s.tooth_load.array(), 0.0).maxCoeff();
}

// Where teeth part or, if they do not, where the vibration is above this part of its largest.
std::vector<SpeedRange> pair_speeds_to_avoid(const FirstTorque& t, bool parts) {
  constexpr double kNearPeak = 0.7;
  std::map<double, bool> marked;
  for (const ResponseResult* r : {t.up, t.down}) {
    if (!r || (!parts && resonances(*r).empty())) continue;
    const double most = r->dte_rms.maxCoeff();
    for (Index i = 0; i < r->mesh_frequency.size(); ++i)
      marked[r->mesh_frequency[i]] |=
          parts ? r->separation_fraction(i, 0) > 0 : r->dte_rms(i, 0) > kNearPeak * most;
  }
  return marked_ranges(marked);
}

std::string pair_advice(const FirstTorque& t) {
  const StaticResult& s = t.rest;
  constexpr double kSmall = 0.01;  // of the largest load of a pair
  Advice out;
  out.member = t.driver;
  const double edge = largest_edge_load(s),
               least = s.stiffness_secant.size() > 0 ? s.stiffness_secant.minCoeff() : 0;
  const bool relieved = s.mesh.modification[0].tip.amount > 0 && s.mesh.modification[1].tip.amount > 0;
  if (edge > kSmall * s.tooth_load.maxCoeff() && least > 0 && !relieved)
    out.relief.push_back({"both gears", static_force(s) / least, edge});
  if (relieved || !out.relief.empty())
    out.more.emplace_back("See make harris-map for the relief that suits a torque.");
  for (const ResponseResult* r : {t.up, t.down})
    out.parts = out.parts || (r && r->separation_fraction.maxCoeff() > 0);
  out.avoid = pair_speeds_to_avoid(t, out.parts);
  if (s.stiffness_harmonic.size() > 1)
    out.stiffness_swing = s.stiffness_harmonic[1] / s.stiffness_harmonic[0];
  if (t.ring_down && t.ring_down->states.damping_ratio.size() > 0)
    out.damping_ratio = t.ring_down->states.damping_ratio[t.ring_down->states.damping_ratio.size() - 1];
  return advice_line(out);
}

}  // namespace

std::vector<std::string> opening_lines(const ReportContent& c) {
  const StaticResult& s = c.statics.front();
  const FirstTorque t{s,
                      sweep_of(c, s.torque, Direction::up),
                      sweep_of(c, s.torque, Direction::down),
                      impact_of(c, s.torque),
                      driver_of(c),
                      errors_of(c, s.torque, Direction::up),
                      errors_of(c, s.torque, Direction::down)};
  return {pair_excitation(s, budget_of(c, s.torque)), pair_critical_speeds(t), pair_parting(c, t),
          pair_dynamic_factor(t), pair_advice(t)};
}

}  // namespace whine
