#include "paper/claim_values.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/error.h"
#include "lumped/stiffness.h"
#include "paper/findings.h"

namespace whine::paper {
namespace {

using Named = std::vector<std::pair<std::string, ClaimValue>>;

Finding yes_or_no(bool yes, std::string note) {
  return {yes ? 1.0 : 0.0, std::move(note)};
}

// ---- what a value needs

ClaimValue plain(const std::function<Finding(const SceneResults&)>& find) {
  return {{}, [=](const SceneResults& s, const PrintedClaim&) { return find(s); }};
}

ClaimValue at_torque(const std::function<Finding(const SceneResults&, int)>& find) {
  return {{.torque = true}, [=](const SceneResults& s, const PrintedClaim& c) { return find(s, c.torque); }};
}

ClaimValue at_speed(const std::function<Finding(const SceneResults&, double)>& find) {
  return {{.mesh_frequency = true},
          [=](const SceneResults& s, const PrintedClaim& c) { return find(s, c.mesh_frequency); }};
}

ClaimValue of_order(const std::function<Finding(const SceneResults&, int)>& find) {
  return {{.order = true}, [=](const SceneResults& s, const PrintedClaim& c) { return find(s, c.order); }};
}

ClaimValue of_order_at_speed(const std::function<Finding(const SceneResults&, double, int)>& find) {
  return {{.mesh_frequency = true, .order = true},
          [=](const SceneResults& s, const PrintedClaim& c) { return find(s, c.mesh_frequency, c.order); }};
}

// Of the statics at 100 N m.
ClaimValue at_rest(const std::function<double(const StaticResult&)>& number) {
  return plain([=](const SceneResults& s) { return Finding{number(s.at_rest(100)), ""}; });
}

ClaimValue nothing() {
  return plain([](const SceneResults&) { return Finding{kNone, ""}; });
}

// Of the model with the rectangular wave, whose parameters gear-lumped takes from P2000.
ClaimValue of_lumped(const std::function<double(const SweepResult&)>& number) {
  return plain([=](const SceneResults& s) {
    return Finding{number(s.sweep(kFigureTorque, Direction::up, MotionModel::rectangular)), ""};
  });
}

// ---- gears, integrator, damping

Finding other_periods(const SceneResults& s) {
  Index other = 0;
  for (int torque : kSweptTorques)
    for (const ResponseResult* r : {&s.branches(torque).up, &s.branches(torque).down})
      other += (r->period_multiple.array() != 1).count();
  return {kNone, text("here ", other, " speeds, of all sweeps, that do not repeat with the mesh period")};
}

// A constant of Newmark's scheme: the printed one where the scene uses that scheme.
Finding newmark(const SceneResults& s, const PrintedClaim& claim) {
  const Integrator integrator = s.branches(kFigureTorque).up.fidelity.integrator;
  if (integrator == Integrator::newmark) return {claim.printed, ""};
  return {kNone, text("integrator = \"", integrator, "\" has no such number")};
}

Finding base_radius(const SceneResults& s) {
  const StaticResult& a = s.at_rest(100);
  const double r =
      a.gear[0].design.module * a.gear[0].design.teeth * std::cos(a.gear[0].design.pressure_angle) / 2;
  return {1e3 * r, text(a.gear[0].design.teeth, " teeth of module ", digits(1e3 * a.gear[0].design.module),
                        " mm have ", digits(1e3 * r, 5),
                        " mm, and only with it k = (T / r) / STE gives the printed mean stiffness")};
}

Finding bearing_damping(const SceneResults& s) {
  const double ratio = s.branches(kFigureTorque).up.damping.bearing_ratio;
  return yes_or_no(ratio < 0.01, text(digits(100 * ratio, 2), " %"));
}

Named of_the_gears() {
  return {{"other-periods", plain(other_periods)},
          {"newmark", {{}, newmark}},
          {"teeth", at_rest([](const StaticResult& a) { return double(a.gear[0].design.teeth); })},
          {"module", at_rest([](const StaticResult& a) { return 1e3 * a.gear[0].design.module; })},
          {"pressure-angle", at_rest([](const StaticResult& a) {
             return a.gear[0].design.pressure_angle * 180 / std::numbers::pi;
           })},
          {"base-radius", plain(base_radius)},
          {"contact-ratio", at_rest([](const StaticResult& a) { return a.contact_ratio; })},
          {"face-width", at_rest([](const StaticResult& a) { return 1e3 * a.gear[0].design.face_width; })},
          {"youngs-modulus",
           at_rest([](const StaticResult& a) { return 1e-9 * a.gear[0].material.youngs_modulus; })},
          {"density", at_rest([](const StaticResult& a) { return a.gear[0].material.density; })},
          {"damping", plain(damping)},
          {"bearing-damping", plain(bearing_damping)},
          {"nothing", nothing()}};
}

// ---- impact tests

Finding impact_torque(const SceneResults& s) {
  const double step = s.ring_down(100).torque_step;
  return {1 + step,
          text("here a step of ", digits(step, 2), " is let go: so small that the decay is linear")};
}

// The natural frequency of the rig, whose gears are 20 mm wide, taken to the width of the model.
Finding within_5_percent(const SceneResults& s, int torque) {
  const double scaled_rig = 2700 * std::sqrt(25.4 / 20);
  const double off = table_frequency(s, torque, ContactState::mean).value / scaled_rig - 1;
  return yes_or_no(std::abs(off) <= 0.05, text(digits(100 * off, 2), " %"));
}

Finding weak_function_of_load(const SceneResults& s) {
  bool weak = true;
  std::string note;
  for (const ContactState state : {ContactState::one, ContactState::two, ContactState::mean}) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (int torque : kTorques) {
      const double f = table_frequency(s, torque, state).value;
      low = std::min(low, f);
      high = std::max(high, f);
    }
    weak = weak && high <= 1.05 * low;
    note += text(note.empty() ? "" : ", ", name_of(state), " ", digits(100 * (high / low - 1), 2), " %");
  }
  return yes_or_no(weak, note);
}

Named of_impact_tests() {
  return {{"mean-natural-frequency", plain([](const SceneResults& s) {
             return Finding{table_frequency(s, 100, ContactState::mean).value, "25.4 mm wide, 100 N m"};
           })},
          {"impact-torque", plain(impact_torque)},
          {"within-5-percent", at_torque(within_5_percent)},
          {kNaturalFrequency,
           {{.torque = true, .contact = true},
            [](const SceneResults& s, const PrintedClaim& c) {
              return table_frequency(s, c.torque, choice_of<ContactState>(c.contact).value());
            }}},
          {"weak-function-of-load", plain(weak_function_of_load)}};
}

// ---- sweeps and motions of the elastic pair

// Largest RMS of all speeds at each torque of a model.
ClaimValue amplitudes(MotionModel model) {
  return plain([=](const SceneResults& s) {
    std::string note;
    for (int torque : kTorques)
      note += text(note.empty() ? "" : ", ", digits(largest_rms(s.branches(torque, model)) * kMicro, 3));
    return Finding{kNone, "here largest RMS at 100, 200, 300 N m: " + note + " µm"};
  });
}

Finding level_difference(const SceneResults& s, double f) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) return no_second_branch(s, kFigureTorque, at, f);
  return {kNone, text("RMS of the DTE ", digits(20 * std::log10(at.upper.rms() / at.lower.rms()), 3),
                      " dB apart at ", digits(at.upper.speed()), " Hz")};
}

Finding upper_loses_contact(const SceneResults& s, double f) {
  Finding losses = upper_losses(s, f);
  if (!std::isnan(losses.value)) losses.value = losses.value >= 1;
  return losses;
}

Finding upper_larger(const SceneResults& s, double f) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) return no_second_branch(s, kFigureTorque, at, f);
  const double ratio = at.upper.rms() / at.lower.rms();
  return yes_or_no(ratio >= 1.5, text(digits(ratio, 3), " times"));
}

Finding smooth_transition(const SceneResults& s, double f) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) return no_second_branch(s, kFigureTorque, at, f);
  return force_step(s.sweep(kFigureTorque, at.lower.sweep->direction), at.lower.speed(), true, true);
}

Finding upper_load_larger(const SceneResults& s, double f) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) return no_second_branch(s, kFigureTorque, at, f);
  const double upper = largest_load(s, at.upper, LoadOf::tooth),
               lower = largest_load(s, at.lower, LoadOf::tooth);
  return yes_or_no(upper >= 1.2 * lower, text(digits(upper), " and ", digits(lower), " N"));
}

Finding amplitude_600(const SceneResults& s) {
  const double ratio = largest_rms(s.branches(600)) / largest_rms(s.branches(300));
  return yes_or_no(ratio >= 1.5, text(digits(ratio, 3), " times; at 600 N m ", loss_text(s.branches(600)),
                                      ", ", excitation(s, 600)));
}

Named of_sweeps() {
  return {{"resonance", of_order([](const SceneResults& s, int order) { return resonance(s, order); })},
          {"driven-by-harmonic", of_order(driven_by_harmonic)},
          {"softening", plain(softening)},
          {"superharmonic-weaker", plain(superharmonic_weaker)},
          {"two-states", at_torque(width_at)},
          {"two-states-below-2500",
           {{.torque = true, .mesh_frequency = true},
            [](const SceneResults& s, const PrintedClaim& c) {
              return two_states_below(s, c.torque, c.mesh_frequency);
            }}},
          {"jump-frequencies", at_torque([](const SceneResults& s, int torque) {
             return Finding{kNone, jumps_text(s.branches(torque))};
           })},
          {"amplitudes", amplitudes(MotionModel::finite_elements)},
          {"jumps", at_torque(jumps_at)},
          {"amplitude-grows", plain(grows_with_torque)},
          {"loses-contact", at_torque(loses_contact)},
          {"amplitude-600", plain(amplitude_600)},
          {"kink", at_torque(kink)},
          {"loss-down-to-jump", plain(loss_down_to_the_jump)},
          {"loss-beyond-jumps", plain(loss_beyond_two_branches)},
          {"lower-never-loses", plain(lower_never_loses)}};
}

Named of_branches_at_a_speed() {
  return {{"level-difference", at_speed(level_difference)},
          {"two-branches", at_speed(two_at)},
          {"lower-keeps-contact", at_speed(lower_keeps_contact)},
          {"upper-loses-contact", at_speed(upper_loses_contact)},
          {"upper-losses", at_speed(upper_losses)},
          {"upper-nearly-harmonic", of_order_at_speed(nearly_harmonic)},
          {"lower-more-distorted", of_order_at_speed(lower_more_distorted)},
          {"upper-larger", at_speed(upper_larger)},
          {"smooth-transition", at_speed(smooth_transition)},
          {"load-lower", plain([](const SceneResults& s) { return load(s, Load::lower); })},
          {"load-upper", plain([](const SceneResults& s) { return load(s, Load::upper); })},
          {"load-increase", plain([](const SceneResults& s) { return load(s, Load::increase); })},
          {"upper-load-larger", at_speed(upper_load_larger)}};
}

// ---- statics and models with one degree of freedom

Finding lumped_natural_frequency(const SceneResults& s) {
  const SweepResult& a = s.sweep(kFigureTorque, Direction::up, MotionModel::rectangular);
  return {std::sqrt(s.at_rest(100).mean_stiffness / a.lumped.mass) / (2 * std::numbers::pi),
          "secant stiffness at 100 N m"};
}

Finding mean_transmission_errors(const SceneResults& s) {
  std::string note;
  for (int torque : kTorques)
    note += text(note.empty() ? "" : ", ", digits(s.at_rest(torque).transmission_error_harmonic[0] * kMicro));
  return {kNone, "mean at 100, 200, 300 N m: " + note + " µm"};
}

Finding levels_of_wave(const SceneResults& s) {
  const RectangularWave& wave = s.at_rest(100).rectangular_wave;
  return {kNone,
          text("rectangular wave ", digits(wave.low * kMega), " and ", digits(wave.high * kMega), " N/µm")};
}

Finding mean_stiffness_torque(const SceneResults& s) {
  const double low = s.at_rest(100).mean_stiffness, high = s.at_rest(300).mean_stiffness;
  return yes_or_no(std::abs(high / low - 1) <= 0.028,
                   text("by ", digits(100 * (high / low - 1), 2), " %: ", digits(low * kMega), ", ",
                        digits(s.at_rest(200).mean_stiffness * kMega), ", ", digits(high * kMega), " N/µm"));
}

Finding lumped_kink(const SceneResults& s) {
  const std::vector<double> lost = speeds_with_loss(s.branches(kFigureTorque, MotionModel::rectangular));
  if (lost.empty()) return {kNone, "contact never lost"};
  const double f_n = s.branches(kFigureTorque, MotionModel::rectangular).up.natural_frequency;
  return {lost.back(), text(digits(lost.back() / f_n, 3), " f_n")};
}

Finding secant_loses_contact(const SceneResults& s, int torque) {
  const Branches b = s.branches(torque, MotionModel::secant);
  return yes_or_no(!speeds_with_loss(b).empty(),
                   text(loss_text(b), "; first harmonic of k ",
                        digits(100 * first_harmonic_share(s.at_rest(torque)), 3), " % of its mean"));
}

Named of_stiffness() {
  return {{"mean-stiffness", at_rest([](const StaticResult& a) { return a.mean_stiffness * kMega; })},
          {"mean-transmission-errors", plain(mean_transmission_errors)},
          {"rectangular-wave", plain(levels_of_wave)},
          {"mean-stiffness-torque", plain(mean_stiffness_torque)},
          {"stiffness-spectrum", plain(stiffness_spectrum)},
          {"stiffness-modest", plain(modest_difference)},
          {"spectrum-lost", plain(spectrum_lost)}};
}

Named of_lumped_models() {
  return {{"sdof-damping", of_lumped([](const SweepResult& a) { return 100 * a.lumped.damping_ratio; })},
          {"sdof-mass", of_lumped([](const SweepResult& a) { return a.lumped.mass; })},
          {"sdof-natural-frequency", plain(lumped_natural_frequency)},
          {"sdof-amplitudes", amplitudes(MotionModel::rectangular)},
          {"sdof-jumps", at_torque(lumped_jumps)},
          {"sdof-resonance", of_order([](const SceneResults& s, int order) {
             return resonance(s, order, MotionModel::rectangular);
           })},
          {"sdof-torque-independent", plain(torque_independent)},
          {"sdof-mean-opposite", plain([](const SceneResults& s) { return mean_jumps(s, false); })},
          {"sdof-mean-less", plain([](const SceneResults& s) { return mean_jumps(s, true); })},
          {"sdof-kink", plain(lumped_kink)},
          {"sdof-two-branches", at_speed(lumped_two)},
          {"sdof-upper-loses-contact",
           at_speed([](const SceneResults& s, double f) { return lumped_loss(s, f, true); })},
          {"sdof-lower-keeps-contact",
           at_speed([](const SceneResults& s, double f) { return lumped_loss(s, f, false); })},
          {"sdof-force-step", at_speed([](const SceneResults& s, double f) {
             return force_step(s.sweep(kFigureTorque, Direction::up, MotionModel::rectangular), f, false,
                               false);
           })},
          {"secant-reduced", plain(secant_reduced)},
          {"secant-loses-contact", at_torque(secant_loses_contact)},
          {"secant-linear", at_torque(secant_linear)},
          {"secant-amplitudes", amplitudes(MotionModel::secant)}};
}

}  // namespace

const std::map<std::string, ClaimValue>& claim_values() {
  static const std::map<std::string, ClaimValue> all = [] {
    std::map<std::string, ClaimValue> values;
    for (const Named& part : {of_the_gears(), of_impact_tests(), of_sweeps(), of_branches_at_a_speed(),
                              of_stiffness(), of_lumped_models()})
      values.insert(part.begin(), part.end());
    return values;
  }();
  return all;
}

}  // namespace whine::paper
