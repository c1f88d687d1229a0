#include "studies/system_impact.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "base/model_range.h"
#include "base/units.h"
#include "dynamics/impact.h"
#include "dynamics/lines_motion.h"
#include "system/natural_modes.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// Per oscillation of the mode: the averaged force lengthens it by (2 pi / steps)^2 / 12, 5e-5 here.
constexpr int kSteps = 256, kSamples = 32, kOscillations = 8;
constexpr int kMostExponentials = 12;  // where contact changes, as of pairs (dynamics/impact.cpp)
constexpr double kReal = 1e-5;         // Im s / |s| below which a root counts as real

void measure(SystemDynamics& dynamics, int i, const SystemImpactPlan& plan, ImpactResult& out) {
  const SystemDynamics::State rest = dynamics.rest(i);
  const SystemDynamics::FrozenModes modes = dynamics.frozen_modes(i);
  const Index count = out.undamped_frequency.cols();
  const VectorXd undamped = modes.frequency.head(count);
  const std::vector<DampedRoot> roots = damped_roots(dynamics, i, undamped);
  const double speed = plan.impulse * std::sqrt(2 * dynamics.energy(rest));
  out.mesh_phase[i] = static_cast<double>(i) / plan.phases;
  for (int m = 0; m < dynamics.meshes(); ++m)
    out.loaded_pairs(i, m) = static_cast<int>(
        (rest.p.segment(m * dynamics.tooth_pairs(), dynamics.tooth_pairs()).array() > 0).count());
  out.undamped_frequency.row(i) = undamped.transpose();
  for (Index k = 0; k < count; ++k) {
    out.rayleigh_damping_ratio(i, k) = rayleigh_ratio(out.train.damping, undamped[k]);
    const DampedRoot& root = roots[static_cast<size_t>(k)];
    out.eigen_frequency(i, k) = root.frequency;
    out.eigen_damping_ratio(i, k) = root.damping_ratio;
    if (root.frequency == 0) {
      out.damping_ratio(i, k) = 1;
      continue;
    }
    const double seconds = 1 / (undamped[k] * kSteps);
    const SystemRingDown trace = ring_down(dynamics, i, modes.shape.col(k), speed, seconds,
                                           kSamples * kOscillations, kSteps / kSamples);
    const double modulus = root.frequency / std::sqrt(1 - root.damping_ratio * root.damping_ratio);
    const int most = trace.contact_changes > 0 ? kMostExponentials : std::numeric_limits<int>::max();
    const Decay fit = [&] {
      try {
        return fit_decay(trace.samples, seconds * kSteps / kSamples, modulus, most);
      } catch (const Error& error) {
        fail_as(error, "at mesh phase ", out.mesh_phase[i], ", mode at ", undamped[k], " Hz: ", error.what());
      }
    }();
    out.natural_frequency(i, k) = fit.root.frequency;
    out.damping_ratio(i, k) = fit.root.damping_ratio;
    out.fit_residual(i, k) = fit.residual;
    out.contact_changes(i, k) = trace.contact_changes;
  }
}

}  // namespace

SystemRingDown ring_down(SystemDynamics& dynamics, int i, const VectorXd& shape, double speed, double seconds,
                         int samples, int stride) {
  SystemDynamics::State state = dynamics.rest(i);
  const double still = shape.dot(state.z);
  Eigen::Array<bool, Eigen::Dynamic, 1> loaded = state.p.array() > 0;
  state.v += speed * shape;
  SystemRingDown out;
  out.samples.setZero(samples);
  int step = 0;
  const bool inside = dynamics.integrate_fixed(i, state, seconds, (samples - 1) * stride,
                                               [&](const VectorXd& z, const VectorXd& p) {
                                                 if (((p.array() > 0) != loaded).any()) {
                                                   ++out.contact_changes;
                                                   loaded = p.array() > 0;
                                                 }
                                                 if (++step % stride == 0)
                                                   out.samples[step / stride] = shape.dot(z) - still;
                                               });
  if (!inside)
    fail(
        Failure::numerical,
        "the ring-down reaches a tip edge that is left out as too far; take a smaller impulse or lower the torque");
  return out;
}

std::vector<DampedRoot> damped_roots(SystemDynamics& dynamics, int i, const VectorXd& frequency) {
  constexpr double kNear = 1.0 / 3;  // of the undamped frequency
  const FixedPhaseMesh mesh = dynamics.frozen(i);
  std::vector<int> all(static_cast<size_t>(mesh.gap.size()));
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::complex<double>> roots;
  const Eigen::VectorXcd found = frozen_roots(mesh, all);
  roots.reserve(static_cast<size_t>(found.size()));
  for (const std::complex<double>& s : found)
    if (s.imag() > kReal * std::abs(s)) roots.push_back(s);
  std::vector<DampedRoot> out;
  out.reserve(static_cast<size_t>(frequency.size()));
  for (const double f : frequency) {
    const auto away = [&](const std::complex<double>& s) { return std::abs(std::abs(s) - kTwoPi * f); };
    const auto nearest = std::min_element(roots.begin(), roots.end(),
                                          [&](const auto& a, const auto& b) { return away(a) < away(b); });
    if (nearest == roots.end() || away(*nearest) > kNear * kTwoPi * f) {
      out.push_back({0, 1});
      continue;
    }
    out.push_back({nearest->imag() / kTwoPi, -nearest->real() / std::abs(*nearest)});
    roots.erase(nearest);
  }
  return out;
}

ImpactResult system_impact(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                           const SystemImpactPlan& plan, const std::function<void(long, long)>& report) {
  if (plan.modes < 1 || plan.phases < 1 || !(plan.impulse > 0 && plan.impulse <= 0.1))
    fail(Failure::input, "a ring-down of ", plan.modes, " modes at ", plan.phases,
         " phases with an impulse of ", plan.impulse,
         "; give at least one mode and phase, and an impulse in (0, 0.1]");
  require_like_teeth(settings, bodies, "a ring-down of a system");
  LinesMotion rig(settings, bodies, plan.phases);
  SystemDynamics& dynamics = rig.dynamics();
  ImpactResult out;
  static_cast<MotionSource&>(out) = rig.source();
  out.impulse = plan.impulse;
  out.rigid_frequency = rigid_frequencies(out.train.layout, rig.mean_stiffness());
  const Index phases = plan.phases, modes = std::min<Index>(plan.modes, dynamics.coordinates().size());
  out.mesh_phase.setZero(phases);
  out.loaded_pairs.setZero(phases, dynamics.meshes());
  out.size_modes(phases, modes);
  for (int i = 0; i < plan.phases; ++i) {
    measure(dynamics, i, plan, out);
    report(i + 1, plan.phases);
  }
  return out;
}

}  // namespace whine
