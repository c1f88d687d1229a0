#include "paper/reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "dynamics/impact.h"
#include "gear/rack_tip.h"
#include "lumped/stiffness.h"
#include "lumped/sweep.h"
#include "signal/response.h"
#include "signal/spectrum.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "studies/sweep.h"
#include "system/statics.h"

namespace whine {

using Eigen::Index;

namespace {

// The settings of the search: mean stiffness 0.03 % and natural frequencies 0.1 % off those of the scene's own mesh.
constexpr double kCoarseElement = 0.8e-3;  // m
constexpr int kCoarseModes = 21;
constexpr int kPositions = 128;
constexpr int kFixedPhases = 64;
constexpr double kBoreStep = 1e-3;  // m
constexpr int kLeastBore = 20;      // steps

const auto kNoReport = [](auto&&...) {};

std::string path_at(int torque, const std::string& rest) {
  return text("T", torque, "/", rest);
}

StaticParameters statics_of_reading(const Scene& scene, const CornerRule& corner, ContactModel contact) {
  StaticParameters settings;
  settings.mesh = scene.mesh();
  settings.mesh.corner = corner;
  settings.contact = scene.contact;
  settings.contact.positions = kPositions;
  settings.fidelity = scene.fidelity;
  settings.fidelity.contact = contact;
  return settings;
}

StaticResult with_harmonics(StaticResult statics) {
  const int count = resolved_harmonics(statics.stiffness_secant.size(), 40, 1);
  for (auto [samples, out] : {std::pair{&statics.transmission_error, &statics.transmission_error_harmonic},
                              std::pair{&statics.stiffness_secant, &statics.stiffness_harmonic}}) {
    const Harmonics h = harmonics(*samples, count, 1);
    out->resize(count + 1);
    *out << h.mean, h.amplitude;
  }
  return statics;
}

// Root of an increasing function by regula falsi (Illinois) between low and high, where it is below and above 0.
template <class Function>
double root(const Function& excess, double low, double high, double tolerance) {
  double below = excess(low), above = excess(high);
  if (!(below <= 0 && above >= 0)) return std::numeric_limits<double>::quiet_NaN();
  double x = high;
  for (int i = 0, side = 0; i < 60; ++i) {
    x = high - above * (high - low) / (above - below);
    const double off = excess(x);
    if (std::abs(off) <= tolerance) return x;
    if (off > 0) {
      high = x;
      above = off;
      if (side == 1) below *= 0.5;
      side = 1;
    } else {
      low = x;
      below = off;
      if (side == -1) above *= 0.5;
      side = -1;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// What damping as printed makes of a natural frequency.
const double kDamped = std::sqrt(1 - kPaperDampingRatio * kPaperDampingRatio);

Index row_of(const ImpactResult& impact, const std::string& state) {
  const auto wanted = choice_of<ContactState>(state);
  const auto row = wanted ? impact.states.row_of(*wanted) : std::nullopt;
  if (!row)
    fail(Failure::input, "at ", impact.torque, " N m no mesh phase has the contact state '", state, "'");
  return *row;
}

}  // namespace

BoreFamily::BoreFamily(const Scene& scene, const OpenChoices& choices)
    : scene_(scene), gear_(scene.gear(scene.mesh().gear[0])) {
  gear_.design.dedendum = choices.dedendum;
  gear_.design.tooth_thinning = choices.tooth_thinning;
  gear_.design.rack_tip_radius = choices.rack_tip_share * largest_rack_tip_radius(gear_.design);
  gear_.material.plane_stress = choices.plane == "stress";
  scene_.body.element_size = kCoarseElement;
  scene_.body.modes = kCoarseModes;
}

const ReducedBody& BoreFamily::body(double bore) {
  const int key = static_cast<int>(std::lround(bore / kBoreStep));
  const auto found = bodies_.find(key);
  if (found != bodies_.end()) return found->second;
  GearDesign design = gear_.design;
  design.bore_radius = key * kBoreStep;
  return bodies_[key] = reduce(make_sector_mesh(design, scene_.body), gear_.material, scene_.body.modes);
}

double BoreFamily::mean_stiffness(int steps, const CornerRule& corner) {
  const ReducedBody& gear = body(steps * kBoreStep);
  return static_transmission(gear, gear, statics_of_reading(scene_, corner, ContactModel::line), kTorques[0])
      .mean_stiffness;
}

double BoreFamily::tied_bore(const CornerRule& corner) {
  const double root_radius = gear_.design.module * (0.5 * gear_.design.teeth - gear_.design.dedendum);
  // The stiffness grows with the bore. Secants on its logarithm, which is nearly straight, between whole steps.
  int low = kLeastBore, high = static_cast<int>((root_radius - gear_.design.module) / kBoreStep);
  const auto off = [&](int bore) { return std::log(mean_stiffness(bore, corner) / kPaperMeanStiffness); };
  int guess = std::clamp(45, low, high);
  std::map<int, double> tried;
  for (int i = 0; i < 12; ++i) {
    if (!tried.contains(guess)) tried[guess] = off(guess);
    const double at = tried[guess];
    (at < 0 ? low : high) = guess;
    if (high - low <= 1 && tried.contains(low) && tried.contains(high)) break;
    // From the tried bore nearest to the target along the slope between it and another, or 1.5 % a step.
    double slope = 0.015;
    for (const auto& [bore, value] : tried)
      if (bore != guess) slope = std::max(1e-3, (value - at) / (bore - guess));
    int next = std::clamp(static_cast<int>(std::lround(guess - at / slope)), low, high);
    if (tried.contains(next)) next = at < 0 ? std::min(next + 1, high) : std::max(next - 1, low);
    if (tried.contains(next)) break;
    guess = next;
  }
  const auto best = std::min_element(tried.begin(), tried.end(), [](const auto& a, const auto& b) {
    return std::abs(a.second) < std::abs(b.second);
  });
  if (std::abs(best->second) > 0.02)
    fail(Failure::input, "no bore gives a mean mesh stiffness of ", kPaperMeanStiffness, " N/m at ",
         kTorques[0], " N m: ", best->first * kBoreStep * 1e3, " mm is ", 100 * best->second, " % off");
  return best->first * kBoreStep;
}

PaperPair::PaperPair(BoreFamily& family, double bore, const Scene& scene, const OpenChoices& choices,
                     const ReadingLevel& level, std::vector<Claim> claims)
    : claims_(std::move(claims)),
      body_(family.body(bore)),
      bore_(body_.design.bore_radius),
      level_(level),
      time_(scene.time) {
  for (int torque : kSweptTorques) {
    pair_.statics[path_at(torque, "static.h5")] = with_harmonics(static_transmission(
        body_, body_, statics_of_reading(scene, choices.corner, ContactModel::strips), torque));
    rest_[torque] =
        static_transmission(body_, body_, statics_of_reading(scene, choices.corner, level_.contact), torque);
  }
  add_lumped(scene);
}

void PaperPair::add_lumped(const Scene& scene) {
  LumpedOptions o;
  o.mass = kPaperMass;
  o.frequency_from = level_.from;
  o.frequency_to = level_.to;
  o.frequency_step = level_.step;
  o.time = scene.time;
  const Eigen::VectorXi numbers = Eigen::VectorXi::Zero(1);
  const auto run = [&](MotionModel model, int torque, const LumpedParameters& springs) {
    for (const Direction direction : {Direction::up, Direction::down}) {
      o.model = model;
      o.direction = direction;
      const SweepResult sweep = lumped_sweep(pair_.at_rest(torque), springs, numbers, o, kNoReport);
      const std::string place = path_at(torque, text(model, "/", direction, "/"));
      pair_.responses[place + "response.h5"] = response(sweep);
      if (torque == kFigureTorque && model == MotionModel::rectangular)
        pair_.sweeps[place + "sweep.h5"] = sweep;
    }
  };
  const LumpedParameters wave = cells_of(pair_.at_rest(kTorques[0]).rectangular_wave);
  for (int torque : {100, 150, 200, 300}) run(MotionModel::rectangular, torque, wave);
  for (int torque : kTorques) {
    const StaticResult& rest = pair_.at_rest(torque);
    run(MotionModel::secant, torque, cells_of(rest.stiffness_secant, 8 * kPositions, rest.unloaded_error));
  }
}

SweepParameters PaperPair::impact_parameters(const OpenChoices& choices, double inertia) const {
  SweepParameters settings;
  settings.inertia[0] = settings.inertia[1] = inertia;
  settings.damping.undamped_depth = choices.undamped_depth;
  settings.damping.rayleigh_stiffness = 0;
  settings.reference_torque = kTorques[0];
  return settings;
}

double PaperPair::tied_inertia(const std::string& from) {
  const auto known = inertia_.find(from);
  if (known != inertia_.end()) return known->second;
  const GearDesign& d = body_.design;
  const double base = 0.5 * d.module * d.teeth * std::cos(d.pressure_angle);
  const double by_mass = 2 * base * base * kPaperMass;
  if (from == "mass") return inertia_[from] = by_mass;
  const double reference_stiffness = pair_.at_rest(kTorques[0]).mean_stiffness;
  // 1: printed over computed frequencies, the mean of the rows and torques that are fitted
  const auto off = [&](double inertia) {
    double sum = 0;
    int count = 0;
    for (size_t t = 0; t < (from == "table" ? kTorques.size() : 1); ++t) {
      const ImpactResult at_phase =
          frozen_impact(body_, body_, pair_.at_rest(kTorques[t]), reference_stiffness,
                        impact_parameters({}, inertia), kFixedPhases);
      for (const Claim& row : claims_) {
        if (row.value != kNaturalFrequency || row.torque != kTorques[t]) continue;
        if (from != "table" && from != row.contact) continue;
        sum += row.printed / (kDamped * at_phase.states.undamped_frequency[row_of(at_phase, row.contact)]);
        ++count;
      }
    }
    return sum / count;
  };
  // Most of the inertia is rigid: frequencies go as 1 / sqrt(inertia) but for the part in the bodies' modes.
  double inertia = by_mass;
  for (int i = 0; i < 20; ++i) {
    const double ratio = off(inertia);
    inertia /= ratio * ratio;
    if (!(inertia > 1.02 * body_.inertia && inertia < 2 * by_mass))
      fail(
          Failure::input,
          "no inertia between that of the body and twice that of 1.4 kg gives the natural frequencies of Table 1 (",
          from, ")");
    if (std::abs(ratio - 1) < 1e-4) return inertia_[from] = inertia;
  }
  fail(Failure::numerical, "the inertia fitted to Table 1 (", from, ") does not converge: ", inertia,
       " kg m2");
}

double PaperPair::tied_rayleigh_stiffness(const OpenChoices& choices, double inertia,
                                          double rayleigh_mass) const {
  SweepParameters settings = impact_parameters(choices, inertia);
  settings.damping.rayleigh_mass = rayleigh_mass;
  const StaticResult& rest = pair_.at_rest(kFigureTorque);
  const std::vector<FixedPhaseState> states = fixed_phase_states(
      body_, body_, rest, pair_.at_rest(kTorques[0]).mean_stiffness, settings, kFixedPhases);
  // The mean over the period: pairs in mesh by the contact ratio, one pair for the rest.
  const double two = rest.contact_ratio - 1;
  const auto excess = [&](double eta) {
    double ratio = 0, weight = 0;
    for (const FixedPhaseState& s : states) {
      const double share = choices.damped_state == name_of(s.contact_state) ? 1
                           : choices.damped_state != "mean"                 ? 0
                           : s.contact_state == ContactState::one           ? 1 - two
                           : s.contact_state == ContactState::two           ? two
                                                                            : 0;
      if (share == 0) continue;
      ratio +=
          share * frozen_root(with_rayleigh_stiffness(s.mesh, eta, settings.fidelity.body)).damping_ratio;
      weight += share;
    }
    if (weight == 0)
      fail(Failure::input, "the contact state '", choices.damped_state, "' does not occur at ", kFigureTorque,
           " N m");
    return ratio / weight - kPaperDampingRatio;
  };
  const double eta = root(excess, 1e-9, 3e-5, 1e-5);
  if (std::isnan(eta))
    fail(Failure::input, "no rayleigh_stiffness_s below 3e-5 s gives a damping ratio of ", kPaperDampingRatio,
         " in the contact state '", choices.damped_state, "' with a share of ", choices.mass_share,
         " from mass and an undamped depth of ", choices.undamped_depth * 1e3, " mm");
  return eta;
}

Reading PaperPair::evaluate(const OpenChoices& choices) {
  Reading out;
  out.choices = choices;
  out.rack_tip_radius = body_.design.rack_tip_radius;
  out.bore_radius = bore_;
  // Frequencies go as 1 / sqrt(inertia), but for the part of it in the bodies' modes.
  out.total_inertia = tied_inertia(choices.inertia_from) / std::pow(1 + choices.frequency_offset, 2);
  const double bearing_stiffness = pair_.at_rest(kTorques[0]).mean_stiffness;
  const SweepParameters at_phase = impact_parameters(choices, out.total_inertia);
  {
    // mu = 2 zeta w with w of the contact state that has the printed ratio.
    const StaticResult& rest = pair_.at_rest(kFigureTorque);
    const ImpactResult at = frozen_impact(body_, body_, rest, bearing_stiffness, at_phase, kFixedPhases);
    out.rayleigh_mass = choices.mass_share * 2 * kPaperDampingRatio * 2 * std::numbers::pi *
                        at.states.undamped_frequency[row_of(at, choices.damped_state)];
  }
  out.rayleigh_stiffness = tied_rayleigh_stiffness(choices, out.total_inertia, out.rayleigh_mass);
  return judge(std::move(out));
}

Reading PaperPair::judge(Reading out) const {
  const OpenChoices& choices = out.choices;
  const double bearing_stiffness = pair_.at_rest(kTorques[0]).mean_stiffness;
  SweepParameters at_phase = impact_parameters(choices, out.total_inertia);
  at_phase.damping.rayleigh_mass = out.rayleigh_mass;
  at_phase.damping.rayleigh_stiffness = out.rayleigh_stiffness;
  out.verdict.clear();
  out.exists.clear();
  out.value.clear();

  SceneResults results = pair_;
  for (int torque : {100, 150, 200, 300})
    results.impacts[path_at(torque, "impact.h5")] =
        frozen_impact(body_, body_, pair_.at_rest(torque), bearing_stiffness, at_phase, kFixedPhases);
  SweepParameters settings = at_phase;
  settings.fidelity.contact = level_.contact;
  settings.frequency_from = level_.from;
  settings.frequency_to = level_.to;
  settings.frequency_step = level_.step;
  settings.time = time_;
  settings.time.steps_per_period = choices.steps_per_period;
  if (choices.steps_per_period != time_.steps_per_period) settings.time.min_sample_rate = 1;
  for (int torque : kSweptTorques)
    for (const Direction direction : {Direction::up, Direction::down}) {
      SweepResult motion =
          sweep(body_, body_, rest_.at(torque), bearing_stiffness, settings, direction, kNoReport);
      const std::string place = path_at(torque, text(direction, "/"));
      results.responses[place + "response.h5"] = response(motion);
      if (torque == kFigureTorque) results.sweeps[place + "sweep.h5"] = std::move(motion);
    }

  const RectangularWave& wave = pair_.at_rest(kTorques[0]).rectangular_wave;
  out.level_ratio = wave.high / wave.low;
  const StaticResult& rest = pair_.at_rest(kFigureTorque);
  out.first_harmonic = rest.stiffness_harmonic[1] / rest.stiffness_harmonic[0];
  const Branches figure = results.branches(kFigureTorque);
  const auto primary = [](const ResponseResult& r) {
    const double largest = r.jump_frequency.size() > 0 ? r.jump_frequency.maxCoeff() : 0;
    return largest > 0.575 * r.natural_frequency ? largest : 0;
  };
  out.jump_up = primary(figure.up);
  out.jump_down = primary(figure.down);
  const std::set<std::string> fitted = fitted_claims(choices);
  for (const Claim& claim : claims_) {
    const Finding finding = claim.find(results);
    const bool exists = std::isfinite(finding.value);
    out.verdict.push_back(static_cast<int>(verdict(claim, finding, fitted.contains(claim.id))));
    out.exists.push_back(exists);
    out.value.push_back(exists ? finding.value : 0);
  }
  return out;
}

std::set<std::string> fitted_claims(const OpenChoices& choices) {
  std::set<std::string> out{"mean-stiffness", "sdof-natural-frequency", "damping"};
  // One number cannot make all nine frequencies of Table 1 agree: with "table" none does by construction.
  if (choices.inertia_from != "mass" && choices.inertia_from != "table")
    out.insert("table1-" + choices.inertia_from + "-100");
  return out;
}

}  // namespace whine
