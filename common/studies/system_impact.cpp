#include "studies/system_impact.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/model_range.h"
#include "dynamics/lines_motion.h"
#include "dynamics/ring_down.h"
#include "system/natural_modes.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// Per oscillation of the mode: the averaged force lengthens it by (2 pi / steps)^2 / 12, 5e-5 here.
constexpr int kSteps = 256, kSamples = 32, kOscillations = 8;

void measure(SystemDynamics& dynamics, int i, const SystemImpactPlan& plan, ImpactResult& out) {
  const SystemDynamics::State rest = dynamics.rest(i);
  const SystemDynamics::FrozenModes modes = dynamics.frozen_modes(i);
  const Index count = out.undamped_frequency.cols();
  const VectorXd undamped = modes.frequency.head(count);
  const std::vector<DampedRoot> roots = damped_roots(dynamics.frozen(i), undamped);
  const double speed = plan.impulse * std::sqrt(2 * dynamics.energy(rest));
  out.mesh_phase[i] = static_cast<double>(i) / plan.phases;
  for (int m = 0; m < dynamics.meshes(); ++m)
    out.loaded_pairs(i, m) = static_cast<int>(
        (rest.p.segment(m * dynamics.tooth_pairs(), dynamics.tooth_pairs()).array() > 0).count());
  out.undamped_frequency.row(i) = undamped.transpose();
  for (Index k = 0; k < count; ++k) {
    const DampedRoot& root = roots[static_cast<size_t>(k)];
    set_root(root, i, k, out);
    if (root.frequency == 0) {
      out.damping_ratio(i, k) = 1;
      continue;
    }
    const double seconds = 1 / (undamped[k] * kSteps);
    const SystemRingDown trace = ring_down(dynamics, i, modes.shape.col(k), speed, seconds,
                                           kSamples * kOscillations, kSteps / kSamples);
    const double modulus = root.frequency / std::sqrt(1 - root.damping_ratio * root.damping_ratio);
    try {
      set_decay(fit_ring_down(trace.samples, seconds * kSteps / kSamples, modulus, trace.contact_changes),
                trace.contact_changes, i, k, out);
    } catch (const Error& error) {
      fail_as(error, "at mesh phase ", out.mesh_phase[i], ", mode at ", undamped[k], " Hz: ", error.what());
    }
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

ImpactResult system_impact(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                           const SystemImpactPlan& plan, const std::function<void(long, long)>& report) {
  if (plan.modes < 1 || plan.phases < 1 || !(plan.impulse > 0 && plan.impulse <= 0.1))
    fail(Failure::input, "a ring-down of ", plan.modes, " modes at ", plan.phases,
         " phases with an impulse of ", plan.impulse,
         "; give at least one mode and phase, and an impulse in (0, 0.1]");
  require_able("impact", traits(settings, bodies));
  LinesMotion rig(settings, bodies, plan.phases);
  SystemDynamics& dynamics = rig.dynamics();
  ImpactResult out;
  static_cast<MotionSource&>(out) = rig.source();
  out.impulse = plan.impulse;
  out.rigid_frequency = rigid_frequencies(out.layout, rig.mean_stiffness());
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
