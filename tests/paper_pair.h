// The paper's gear pair, for tests that need no scene.
#pragma once
#include <cmath>
#include <numbers>

#include "dynamics/dynamics.h"
#include "kept_body.h"
#include "results/sweep.h"
#include "signal/spectrum.h"
#include "studies/sweep.h"
#include "system/statics.h"

namespace whine {

// The paper's gear, or one of its rack with other teeth.
inline GearDesign paper_gear(int teeth = 50, double bore = 40e-3) {
  GearDesign d;
  d.teeth = teeth;
  d.module = 3e-3;
  d.pressure_angle = 20 * std::numbers::pi / 180;
  d.face_width = 25.4e-3;
  d.bore_radius = bore;
  return d;
}

inline Material paper_steel() {
  return {207e9, 0.3, 7600, true};
}

// [gear.<name>] with it.
inline SceneGear paper_scene_gear(const std::string& name) {
  SceneGear out;
  out.name = name;
  out.design = paper_gear();
  out.material = paper_steel();
  out.total_inertia = 0.0148;
  return out;
}

// The paper's gear at the default discretisation but for the number of modes, which statics do not see.
inline const ReducedBody& paper_body(double bore = 40e-3, double element = 0.4e-3, int modes = 5) {
  return kept_body(paper_gear(50, bore), paper_steel(), element, modes);
}

inline StaticParameters paper_statics(int positions) {
  StaticParameters settings;
  settings.mesh.gear[0] = "pinion";
  settings.mesh.gear[1] = "wheel";
  settings.mesh.centre_distance = 0.150;
  settings.contact.positions = positions;
  return settings;
}

inline SweepParameters paper_sweep(double from, double to, double step) {
  SweepParameters settings;
  settings.inertia[0] = settings.inertia[1] = 0.0148;
  settings.damping.rayleigh_stiffness = 7.7e-6;
  settings.reference_torque = 100;
  settings.frequency_from = from;
  settings.frequency_to = to;
  settings.frequency_step = step;
  return settings;
}

// Of the curves of stiffness and transmission error that a result has.
inline void set_harmonics(StaticResult& s) {
  const Harmonics k = harmonics(s.stiffness_secant, 10), x = harmonics(s.transmission_error, 10);
  s.stiffness_harmonic.resize(11);
  s.stiffness_harmonic << k.mean, k.amplitude;
  s.transmission_error_harmonic.resize(11);
  s.transmission_error_harmonic << x.mean, x.amplitude;
  s.mean_stiffness = k.mean;
}

inline double rms(const SweepResult& sweep, int row) {
  const Eigen::VectorXd te = sweep.transmission_error[static_cast<size_t>(row)].col(0);
  return std::sqrt((te.array() - te.mean()).square().mean());
}

inline DynamicParameters paper_parameters(double mean_stiffness, BodyModel body = BodyModel::modal,
                                          ContactModel contact = ContactModel::strips) {
  DynamicParameters p;
  p.fidelity.contact = contact;
  p.torque = 150;
  p.inertia = {0.0148, 0.0148};
  p.mean_stiffness = mean_stiffness;
  p.damping.rayleigh_stiffness = 7.7e-6;
  p.fidelity.body = body;
  return p;
}

inline constexpr auto no_report = [](auto&&...) {};

}  // namespace whine
