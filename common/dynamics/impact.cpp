#include "dynamics/impact.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "gear/body_inertia.h"
#include "gear/train.h"
#include "model/capabilities.h"
#include "system/natural_modes.h"
#include "system/rolling_mesh.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Per oscillation at the mean undamped frequency: the averaged force lengthens it by (2 pi / steps)^2 / 12, 1e-5 here.
constexpr int kSteps = 512, kSamples = 32, kOscillations = 8;
// RMS of what no damped exponentials explain, over the RMS of the decay. Where contact stays as it is, the pair is linear and leaves
// 5e-9, as many exponentials as its samples show; below this bound the damping ratio is that of the eigenvalue to 3e-5 of itself,
// above it round-off in the samples (a torque step below 1e-9) moves it.
constexpr double kMostFitResidual = 1e-5;

struct Rest {
  double x = 0;  // of the rigid rotation
  VectorXd p;    // (strip) N
  ActiveSet active;
};

// Contact wants more than the mesh holds.
void require_in_reach(const FixedPhaseMesh& mesh, double transmission_error, const VectorXd& p) {
  for (int strip : mesh.zone_end)
    if (p[strip] > 0)
      fail(Failure::numerical, "at mesh phase ", mesh.phase,
           " contact reaches the end of its candidate zone: strip ", strip, " of ", p.size(), " carries ",
           p[strip], " N of ", p.sum(), " N; lower the torque or the torque step");
  const auto closes = [&](double gap, const char* edge) {
    if (transmission_error > gap)
      fail(Failure::numerical, "at mesh phase ", mesh.phase, " the transmission error ",
           transmission_error * 1e6, " micrometres closes the gap of ", gap * 1e6,
           " micrometres of a tip edge ", edge, "; lower the torque or the torque step");
  };
  closes(mesh.lost_corner_gap, "that would touch below the involute");
  closes(mesh.next_corner_gap, "that was left out as too far");
}

VectorXd coordinates(const FixedPhaseMesh& mesh, const Rest& at, double share) {
  VectorXd z = share * mesh.torque - mesh.participation.transpose() * at.p;
  for (int c = 1; c < z.size(); ++c) z[c] /= mesh.frequency_squared[c];
  z[0] = at.x;
  return z;
}

// Static equilibrium under `share` of the torque: elastic coordinates follow their force, the rigid one carries the
// load.
Rest rest(const FixedPhaseMesh& mesh, double share, ComplementaritySolver& solver) {
  VectorXd follow = mesh.frequency_squared;
  for (double& f : follow) f = f > 0 ? 1 / f : 0;
  const MatrixXd a =
      mesh.local + mesh.residual + mesh.participation * follow.asDiagonal() * mesh.participation.transpose();
  const VectorXd offset = share * mesh.participation * follow.cwiseProduct(mesh.torque);
  Rest at;
  const Equilibrium e = equilibrium(a, mesh.gap - offset, mesh.participation.col(0), share * mesh.torque[0],
                                    0, at.active, solver);
  at.x = e.x;
  at.p = e.p;
  require_in_reach(mesh, mesh.closing(coordinates(mesh, at, share)), at.p);
  return at;
}

int loaded_pairs(const FixedPhaseMesh& mesh, const VectorXd& p) {
  int loaded = 0;
  for (size_t j = 0; j + 1 < mesh.first_strip.size(); ++j)
    loaded += p.segment(mesh.first_strip[j], mesh.first_strip[j + 1] - mesh.first_strip[j]).sum() > 0;
  return loaded;
}

// Over the phases; summed as a vector.
double mean_of(const MatrixRM& values) {
  return VectorXd(values.col(0)).mean();
}

ContactState state_of(int pairs) {
  if (pairs < 0 || pairs >= static_cast<int>(ContactState::mean))
    fail(Failure::numerical, pairs, " tooth pairs carry load; ring-downs know up to seven");
  return static_cast<ContactState>(pairs);
}

// The pair at all phases, for any Rayleigh stiffness factor.
class FixedPhasePair {
 public:
  FixedPhasePair(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                 double mean_stiffness, const SweepParameters& settings, const ImpactPlan& plan)
      : plan_(plan) {
    Traits of = traits(statics.mesh, driver.design, driven.design);
    for (auto& level : traits(settings.fidelity)) of.push_back(std::move(level));
    require_able("impact", of);
    if (plan.phases < 2 || plan.phases % 2)
      fail(Failure::input, plan.phases, " phases: an even number above 0 is needed");
    require_inertia(statics.mesh, {driver.inertia, driven.inertia}, settings.inertia);
    GearMeshSpec still = statics.mesh;
    still.friction = {};  // nothing slides at a fixed phase
    const GearMeshModel model(driver, driven, still);
    DynamicParameters parameters = dynamic_parameters(statics, mean_stiffness, settings, 0);
    parameters.loss_per_friction = 0;
    parameters.damping.rayleigh_stiffness = 0;
    RollingDynamics dynamics(model, parameters);
    // As a sweep begins, so that the strips are the same.
    dynamics.set_zone(candidate_zone(model, statics, MotionBounds(model, statics)), plan_.phases);
    set_motion(blank_, {driver, driven}, statics, settings);
    blank_.torque = statics.torque;
    blank_.place_pair(pair_system(blank_));
    blank_.torque_step = plan.torque_step;
    blank_.mean_stiffness = mean_stiffness;
    for (int g = 0; g < kSides; ++g) blank_.bearing_damper[g] = dynamics.bearing_damper(g);
    blank_.mesh_phase = VectorXd::LinSpaced(plan_.phases, 0, 1 - 1.0 / plan_.phases);
    blank_.size_modes(plan_.phases, 1);
    blank_.loaded_pairs.resize(plan_.phases, 1);
    ComplementaritySolver solver;
    for (int i = 0; i < plan_.phases; ++i) {
      meshes_.push_back(dynamics.hold(i));
      blank_.undamped_frequency(i, 0) = dynamics.frozen_frequency(i);
      // Modes of a body that do not move the mesh lie below it.
      if (blank_.undamped_frequency(i, 0) > 1.0001 * dynamics.frozen_frequencies(i)[0])
        meshes_.back().near = blank_.undamped_frequency(i, 0);
      if (model.on_bearings()) {
        meshes_.back().near = blank_.undamped_frequency(i, 0);
        // The mesh, and each gear on a bearing along the line of action and across.
        const int shown = 1 + 2 * (model.bearing[0].elastic() + model.bearing[1].elastic());
        if (i == 0) blank_.frozen_frequency.resize(plan_.phases, shown);
        blank_.frozen_frequency.row(i) = dynamics.frozen_frequencies(i).head(shown).transpose();
      }
      blank_.loaded_pairs(i, 0) = loaded_pairs(meshes_[i], rest(meshes_[i], 1, solver).p);
    }
    const double mean_period = 1 / mean_of(blank_.undamped_frequency);
    step_ = mean_period / kSteps;
    blank_.states.time = VectorXd::LinSpaced(kSamples * kOscillations + 1, 0, kOscillations * mean_period);
    find_states();
  }

  // The phases of a contact state; Error(input) if it does not occur.
  std::vector<int> phases_of(ContactState contact_state) const {
    std::vector<int> phases;
    std::string known;
    for (const auto& [pairs, phase] : state_phase_) {
      known += name_of(state_of(pairs)) + ", ";
      if (state_of(pairs) == contact_state) return {phase};
    }
    if (contact_state != ContactState::mean)
      fail(Failure::input, "the contact state '", contact_state, "' does not occur at ", blank_.torque,
           " N m; choose one of: ", known, "mean");
    phases.resize(static_cast<size_t>(plan_.phases));
    std::iota(phases.begin(), phases.end(), 0);
    return phases;
  }

  double damping_ratio(const std::vector<int>& phases, double rayleigh_stiffness) const {
    double sum = 0;
    for (int i : phases) sum += decay(at(i, rayleigh_stiffness)).second.root.damping_ratio;
    return sum / static_cast<double>(phases.size());
  }

  // The same by eigenvalues of the frozen contact.
  double frozen_damping_ratio(const std::vector<int>& phases, double rayleigh_stiffness) const {
    double sum = 0;
    for (int i : phases) sum += frozen_root(at(i, rayleigh_stiffness)).damping_ratio;
    return sum / static_cast<double>(phases.size());
  }

  double mean_frequency() const { return mean_of(blank_.undamped_frequency); }

  std::vector<FixedPhaseState> states() const {
    std::vector<FixedPhaseState> states;
    for (const auto& [pairs, phase] : state_phase_)
      states.push_back({state_of(pairs), blank_.undamped_frequency(phase, 0), meshes_[phase]});
    return states;
  }

  ImpactResult run(double rayleigh_stiffness, const std::function<void(long, long)>& report) const {
    ImpactResult result = blank_;
    result.damping.rayleigh_stiffness = rayleigh_stiffness;
    ContactStateDecays& states = result.states;
    states.transmission_error.resize(static_cast<Eigen::Index>(state_phase_.size()), states.time.size());
    result.least_mesh_force = 1;
    for (int i = 0; i < plan_.phases; ++i) {
      const FixedPhaseMesh mesh = at(i, rayleigh_stiffness);
      const auto [trace, fit] = decay(mesh);
      set_decay(fit, trace.contact_changes, i, 0, result);
      result.least_mesh_force = std::min(result.least_mesh_force, trace.least_mesh_force);
      set_root(frozen_root(mesh), i, 0, result);
      Eigen::Index row = 0;
      for (const auto& state : state_phase_) {
        if (state.second == i) states.transmission_error.row(row) = trace.transmission_error.transpose();
        ++row;
      }
      report(i + 1, plan_.phases);
    }
    fill_states(result, [&](int phase) {
      return DampedRoot{result.natural_frequency(phase, 0), result.damping_ratio(phase, 0)};
    });
    const Eigen::Index mean = states.natural_frequency.size() - 1;
    states.natural_frequency[mean] = mean_of(result.natural_frequency);
    states.damping_ratio[mean] = mean_of(result.damping_ratio);
    return result;
  }

  // By eigenvalues alone; the mean is that of the undamped frequencies, each changed as amid its contact state.
  ImpactResult frozen(double rayleigh_stiffness) const {
    ImpactResult result = blank_;
    result.damping.rayleigh_stiffness = rayleigh_stiffness;
    std::map<int, DampedRoot> roots;
    for (const auto& [pairs, phase] : state_phase_) roots[pairs] = frozen_root(at(phase, rayleigh_stiffness));
    fill_states(result, [&](int phase) { return roots[result.loaded_pairs(phase, 0)]; });
    ContactStateDecays& states = result.states;
    const Eigen::Index mean = states.natural_frequency.size() - 1;
    std::map<int, double> change;
    for (const auto& [pairs, phase] : state_phase_)
      change[pairs] = roots[pairs].frequency / result.undamped_frequency(phase, 0);
    for (int i = 0; i < plan_.phases; ++i) {
      const int pairs = result.loaded_pairs(i, 0);
      states.natural_frequency[mean] += result.undamped_frequency(i, 0) * change[pairs] / plan_.phases;
      states.damping_ratio[mean] += roots[pairs].damping_ratio / plan_.phases;
    }
    return result;
  }

 private:
  // The states but for their mean frequency and damping, which are 0; root(phase): amid a state.
  template <class Root>
  void fill_states(ImpactResult& result, const Root& root) const {
    ContactStateDecays& states = result.states;
    const auto count = static_cast<Eigen::Index>(state_phase_.size());
    for (VectorXd* v : {&states.natural_frequency, &states.damping_ratio, &states.undamped_frequency})
      v->setZero(count + 1);
    states.mesh_phase.resize(count);
    states.contact_state.reserve(state_phase_.size() + 1);
    Eigen::Index row = 0;
    for (const auto& [pairs, phase] : state_phase_) {
      const DampedRoot amid = root(phase);
      states.contact_state.push_back(state_of(pairs));
      states.mesh_phase[row] = result.mesh_phase[phase];
      states.natural_frequency[row] = amid.frequency;
      states.damping_ratio[row] = amid.damping_ratio;
      states.undamped_frequency[row] = result.undamped_frequency(phase, 0);
      ++row;
    }
    states.contact_state.push_back(ContactState::mean);
    states.undamped_frequency[count] = mean_of(result.undamped_frequency);
  }

  FixedPhaseMesh at(int i, double rayleigh_stiffness) const {
    return with_rayleigh_stiffness(meshes_[i], rayleigh_stiffness, blank_.fidelity.body);
  }

  std::pair<RingDown, Decay> decay(const FixedPhaseMesh& mesh) const {
    RingDown trace = ring_down(mesh, plan_.torque_step, step_, static_cast<int>(blank_.states.time.size()),
                               kSteps / kSamples);
    const Decay fit =
        fit_ring_down(trace.transmission_error, step_ * kSteps / kSamples, mesh.near, trace.contact_changes);
    if (!(fit.residual <= kMostFitResidual)) fail_unresolved(mesh, trace, fit);
    return {std::move(trace), fit};
  }

  [[noreturn]] void fail_unresolved(const FixedPhaseMesh& mesh, const RingDown& trace,
                                    const Decay& fit) const {
    const std::string found =
        text("at mesh phase ", mesh.phase, " ", fit.exponentials, " damped exponentials leave ", fit.residual,
             " of the decay, above ", kMostFitResidual,
             ", and its damping ratio is not certain (the fit's is ", fit.root.damping_ratio, "): ");
    if (trace.contact_changes > 0)
      fail(Failure::numerical, found, "contact comes and goes in it, strips open or close in ",
           trace.contact_changes, " of its steps; take a torque step smaller than ", plan_.torque_step);
    fail(Failure::numerical, found, "contact stays as it is, but the other modes in the decay of ",
         trace.transmission_error.size(),
         " samples are not resolved above its round-off; take a torque step larger than ", plan_.torque_step,
         " or fewer modes in [fidelity]");
  }

  // Amid the longest run of phases with as many loaded pairs; the period is cyclic.
  void find_states() {
    const Eigen::VectorXi loaded = blank_.loaded_pairs.col(0);
    std::map<int, int> longest;
    for (int start = 0; start < plan_.phases; ++start) {
      const int pairs = loaded[start];
      if (start > 0 && loaded[start - 1] == pairs) continue;
      int before = 0, after = 0;  // the run that begins here goes on across the ends of the period
      while (start == 0 && before < plan_.phases - 1 && loaded[plan_.phases - 1 - before] == pairs) ++before;
      while (after < plan_.phases - before && loaded[(start + after) % plan_.phases] == pairs) ++after;
      const int length = before + after;
      if (length <= longest[pairs]) continue;
      longest[pairs] = length;
      state_phase_[pairs] = (start - before + (length - 1) / 2 + plan_.phases) % plan_.phases;
    }
  }

  ImpactPlan plan_;
  double step_ = 0;
  ImpactResult blank_;  // all that does not depend on the Rayleigh stiffness factor
  std::vector<FixedPhaseMesh> meshes_;
  std::map<int, int> state_phase_;  // loaded pairs -> phase
};

}  // namespace

RingDown ring_down(const FixedPhaseMesh& mesh, double torque_step, double step, int samples, int stride) {
  if (!(torque_step > 0 && torque_step <= 0.5))
    fail(Failure::input, "a torque step of ", torque_step,
         " of the torque is outside (0, 0.5]; decays are to stay in the linear regime");
  ComplementaritySolver solver;
  const Rest before = rest(mesh, 1 + torque_step, solver), end = rest(mesh, 1, solver);
  const VectorXd target = coordinates(mesh, end, 1);
  const double mesh_force = end.p.sum();

  FixedPhaseMotion motion(mesh, step);
  motion.start(coordinates(mesh, before, 1 + torque_step), before.p);
  RingDown result;
  result.transmission_error.resize(samples);
  result.least_mesh_force = 1;
  result.transmission_error[0] = mesh.error_weight.dot(motion.z - target);
  using Loaded = Eigen::Array<bool, Eigen::Dynamic, 1>;
  Loaded loaded = end.p.array() > 0;
  for (int i = 1; i <= (samples - 1) * stride; ++i) {
    motion.advance();
    if (((motion.p.array() > 0) != loaded).any()) {
      ++result.contact_changes;
      loaded = motion.p.array() > 0;
    }
    result.least_mesh_force = std::min(result.least_mesh_force, motion.p.sum() / mesh_force);
    require_in_reach(mesh, mesh.closing(motion.z), motion.p);
    if (i % stride == 0) result.transmission_error[i / stride] = mesh.error_weight.dot(motion.z - target);
  }
  if (!(result.least_mesh_force > 0))
    fail(Failure::input, "a torque step of ", torque_step,
         " of the torque parts the teeth; take a smaller one");
  return result;
}

DampedRoot frozen_root(const FixedPhaseMesh& mesh) {
  ComplementaritySolver solver;
  std::vector<std::complex<double>> roots = oscillating_roots(mesh, rest(mesh, 1, solver).active.strips);
  if (roots.empty())
    fail(Failure::numerical,
         "no eigenvalue of the pair at a fixed phase oscillates: it is damped above critical");
  // The slowest by its modulus, or the nearest: a high mode near critical damping has a small imaginary part, too.
  return damped_root(*nearest_root(roots, mesh.near));
}

FixedPhaseMesh with_rayleigh_stiffness(FixedPhaseMesh mesh, double eta, BodyModel body) {
  mesh.damping += eta * (mesh.elastic.size() > 0 ? mesh.elastic : mesh.frequency_squared);  // Eq. 21
  mesh.relaxation = body == BodyModel::quasi_static ? 0 : eta;
  return mesh;
}

std::vector<FixedPhaseState> fixed_phase_states(const ReducedBody& driver, const ReducedBody& driven,
                                                const StaticResult& statics, double mean_stiffness,
                                                const SweepParameters& settings, int phases) {
  ImpactPlan plan;
  plan.phases = phases;
  return FixedPhasePair(driver, driven, statics, mean_stiffness, settings, plan).states();
}

ImpactResult frozen_impact(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                           double mean_stiffness, const SweepParameters& settings, int phases) {
  ImpactPlan plan;
  plan.phases = phases;
  return FixedPhasePair(driver, driven, statics, mean_stiffness, settings, plan)
      .frozen(settings.damping.rayleigh_stiffness);
}

ImpactResult impact(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                    double mean_stiffness, const SweepParameters& settings, const ImpactPlan& plan,
                    const std::function<void(long, long)>& report) {
  ImpactResult out = FixedPhasePair(driver, driven, statics, mean_stiffness, settings, plan)
                         .run(settings.damping.rayleigh_stiffness, report);
  System rigid = pair_system(statics.mesh, driver.design, driven.design);
  rigid.drives.clear();  // both gears are free to turn
  for (size_t g = 0; g < kSides; ++g) {
    rigid.bodies[g].inertia = settings.inertia[g];
    double& mass = rigid.bodies[g].bearing.mass;
    if (!(mass > 0)) mass = (g == 0 ? driver : driven).mass;
  }
  out.rigid_frequency = rigid_frequencies(rigid, MatrixXd::Constant(1, 1, statics.mean_stiffness));
  return out;
}

ImpactResult calibrate(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                       double mean_stiffness, const SweepParameters& settings, const ImpactPlan& plan,
                       double damping_ratio, ContactState contact_state,
                       const std::function<void(long, long)>& report) {
  if (!(damping_ratio > 0 && damping_ratio < 1))
    fail(
        Failure::input, "a damping ratio of ", damping_ratio, " is outside (0, 1)",
        damping_ratio >= 1 && damping_ratio < 100
            ? text("; it is a share of critical damping: ", damping_ratio / 100, " for ", damping_ratio, " %")
            : "; it is a share of critical damping, such as 0.05 for 5 %");
  report(0, plan.phases);  // the search comes before the phases
  const FixedPhasePair pair(driver, driven, statics, mean_stiffness, settings, plan);
  const std::vector<int> phases = pair.phases_of(contact_state);
  const auto excess = [&](double eta) { return pair.damping_ratio(phases, eta) - damping_ratio; };
  // Bracketed by eigenvalues: with hardly any damping the higher modes never leave a decay.
  const auto frozen = [&](double eta) { return pair.frozen_damping_ratio(phases, eta) - damping_ratio; };
  double low = 0, below = frozen(low);
  if (below > 0)
    fail(Failure::input, "bearings and mass-proportional damping alone give a damping ratio of ",
         below + damping_ratio, " in the contact state '", contact_state, "', above ", damping_ratio,
         "; lower bearing_ratio or rayleigh_mass_per_s");
  // All of the compliance relaxing, the ratio is half of eta w; it is less for the undamped part.
  double high = damping_ratio / (std::numbers::pi * pair.mean_frequency()), above = frozen(high);
  while (above < 0) {
    const double next = frozen(2 * high);
    if (!(next > above))
      fail(Failure::input, "no rayleigh_stiffness_s gives a damping ratio of ", damping_ratio,
           " in the contact state '", contact_state, "': the largest is near ", above + damping_ratio,
           ", at ", high, " s; ask for less, or lower undamped_depth_mm");
    low = high;
    below = above;
    high *= 2;
    above = next;
  }
  // The decay's own ratio is a little off the eigenvalue's.
  constexpr int kMostRaises = 20;
  for (int raises = 0; (above = excess(high)) < 0; ++raises, high *= 1.01)
    if (raises == kMostRaises)
      fail(Failure::numerical, "at ", high, " s the decay has a damping ratio of ", above + damping_ratio,
           ", its eigenvalue one of ", frozen(high) + damping_ratio, ", and ", damping_ratio,
           " is asked for");
  // Regula falsi, Illinois: an end that stays counts half.
  double eta = high, off = above;
  for (int side = 0, i = 0; std::abs(off) > 1e-7 * damping_ratio; ++i) {
    if (i == 60)
      fail(Failure::numerical, "the damping ratio stays ", off, " away from ", damping_ratio, " at ", eta,
           " s");
    eta = high - above * (high - low) / (above - below);
    off = excess(eta);
    if (off > 0) {
      high = eta;
      above = off;
      if (side == 1) below *= 0.5;
      side = 1;
    } else {
      low = eta;
      below = off;
      if (side == -1) above *= 0.5;
      side = -1;
    }
  }
  return pair.run(eta, report);
}

}  // namespace whine
