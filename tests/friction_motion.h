// A pair in motion, from rest, on a candidate zone that holds it: for tests of friction in motion.
#pragma once
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "paper_pair.h"

namespace whine {

// Hz: rigid gears (kg m2) on the mean mesh stiffness.
inline double natural_frequency(const StaticResult& statics, const std::array<double, kSides>& inertia) {
  const GearPair pair(statics);
  double per_mass = 0;
  for (int g = 0; g < kSides; ++g)
    per_mass += std::pow(pair.gear(g).base_radius(), 2) / inertia[static_cast<size_t>(g)];
  return std::sqrt(statics.mean_stiffness * per_mass) / (2 * std::numbers::pi);
}

// The dynamics keep a reference to the model beside them.
struct FrictionMotion {
  // eta: s, of stiffness-proportional damping.
  FrictionMotion(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& at_rest,
                 const std::array<double, kSides>& of_gears, BodyModel body, double eta)
      : statics(at_rest), model(driver, driven, statics.mesh), inertia(of_gears), dynamics(model, [&] {
          SweepParameters settings;
          settings.inertia = inertia;
          settings.damping.rayleigh_stiffness = eta;
          settings.fidelity.body = body;
          settings.fidelity.contact = statics.fidelity.contact;
          return dynamic_parameters(statics, statics.mean_stiffness, settings, 0);
        }()) {}
  FrictionMotion(const FrictionMotion&) = delete;
  FrictionMotion& operator=(const FrictionMotion&) = delete;

  void start(double mesh_frequency, int steps, int periods) {
    for (double wide = 1; wide < 50; wide *= 1.6) {
      dynamics.set_zone(candidate_zone(model, statics, MotionBounds(model, statics, wide)), steps);
      state = dynamics.rest();
      dynamics.set_speed(mesh_frequency, steps);
      int done = 0;
      while (done < periods && dynamics.integrate(state, period)) ++done;
      if (done == periods) return;
    }
    FAIL("no candidate zone holds the motion");
  }

  StaticResult statics;
  GearMeshModel model;
  std::array<double, kSides> inertia;
  RollingDynamics dynamics;
  RollingDynamics::State state;
  RollingDynamics::Period period;
};

}  // namespace whine
