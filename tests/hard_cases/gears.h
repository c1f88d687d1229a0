// The gears of P2000 with elements of 0.8 mm, whose flank flexibility differs by 0.1 % from finer ones, for hard cases.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/dense.h"
#include "dynamics/dynamics.h"
#include "paper_pair.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "studies/sweep.h"
#include "system/statics.h"

namespace whine::hard_cases {

inline double rms(const Eigen::VectorXd& samples) {
  return std::sqrt((samples.array() - samples.mean()).square().mean());
}

inline const double kBaseRadius = 75e-3 * std::cos(20 * std::numbers::pi / 180);
inline constexpr double kFaceWidth = 25.4e-3, kYoung = 207e9, kPoisson = 0.3;

inline const SectorGrid& coarse_mesh() {
  static const SectorGrid mesh = [] {
    BodyDiscretisation discretisation;
    discretisation.element_size = 0.8e-3;
    return make_sector_mesh(paper_gear(), discretisation);
  }();
  return mesh;
}
inline Material steel(bool plane_stress) {
  return {kYoung, kPoisson, 7600, plane_stress};
}
inline const ReducedBody& coarse_body() {
  static const ReducedBody body = reduce(coarse_mesh(), steel(true), 5);
  return body;
}

inline StaticParameters static_parameters(int positions, bool corner) {
  StaticParameters settings;
  settings.mesh.gear[0] = "pinion";
  settings.mesh.gear[1] = "wheel";
  settings.mesh.centre_distance = 0.150;
  settings.mesh.corner.enabled = corner;
  settings.contact.positions = positions;
  return settings;
}
inline StaticResult statics(double torque, int positions = 128, bool corner = true) {
  return static_transmission(coarse_body(), coarse_body(), static_parameters(positions, corner), torque);
}

inline SweepParameters sweep_parameters(double from, double to, double step, double rayleigh_stiffness) {
  SweepParameters settings;
  settings.inertia[0] = settings.inertia[1] = 0.0148;
  settings.damping.rayleigh_stiffness = rayleigh_stiffness;
  settings.reference_torque = 100;
  settings.frequency_from = from;
  settings.frequency_to = to;
  settings.frequency_step = step;
  return settings;
}
inline SweepResult run_sweep(const SweepParameters& settings, double torque,
                             Direction direction = Direction::up, const ReducedBody& body = coarse_body()) {
  const StaticResult at = static_transmission(body, body, static_parameters(128, true), torque);
  return sweep(body, body, at, 463e6, settings, direction, [](long, long, const std::string&) {});
}

struct Rolling {
  Rolling(double torque, int steps, double rayleigh_stiffness = 7.7e-6, double bearing_ratio = 0.005)
      : model(coarse_body(), coarse_body(), static_parameters(1, true).mesh), dynamics(model, [&] {
          DynamicParameters p;
          p.torque = torque;
          p.inertia = {0.0148, 0.0148};
          p.mean_stiffness = 463e6;
          p.damping.rayleigh_stiffness = rayleigh_stiffness;
          p.damping.bearing_ratio = bearing_ratio;
          return p;
        }()) {
    const double load = 150 / kBaseRadius;  // the strips are the same at any torque
    dynamics.set_zone(candidate_zone(model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(),
                                     15, load / model.kinematics.contact_ratio(), 2.5 * load, 2e-5),
                      steps);
  }
  GearMeshModel model;
  RollingDynamics dynamics;
};

inline RollingDynamics::State after(Rolling& pair, RollingDynamics::State state, int periods,
                                    RollingDynamics::Period& period) {
  for (int i = 0; i < periods; ++i) pair.dynamics.integrate(state, period);
  return state;
}

// All that a step starts from.
inline std::vector<Eigen::Map<Eigen::VectorXd>> blocks(RollingDynamics::State& s) {
  std::vector<Eigen::Map<Eigen::VectorXd>> all;
  for (Eigen::VectorXd* v : {&s.z, &s.v, &s.force}) all.emplace_back(v->data(), v->size());
  for (int g = 0; g < kSides; ++g)
    for (Eigen::MatrixXd* m : {&s.relaxed[g], &s.load[g]}) all.emplace_back(m->data(), m->size());
  return all;
}

// Largest modulus of the multipliers of a motion, by differences of `increment` of each block's size.
inline double largest_multiplier(Rolling& pair, RollingDynamics::State steady, double increment) {
  auto base = blocks(steady);
  Eigen::Index size = 0;
  for (const auto& block : base) size += block.size();
  Eigen::MatrixXd monodromy(size, size);
  RollingDynamics::Period period;
  RollingDynamics::State image = after(pair, steady, 1, period);
  const auto image_blocks = blocks(image);
  Eigen::Index column = 0;
  for (size_t b = 0; b < base.size(); ++b)
    for (Eigen::Index i = 0; i < base[b].size(); ++i, ++column) {
      RollingDynamics::State moved = steady;
      blocks(moved)[b][i] += increment * base[b].norm();
      moved = after(pair, moved, 1, period);
      const auto moved_blocks = blocks(moved);
      Eigen::Index row = 0;
      for (size_t k = 0; k < base.size(); ++k) {
        monodromy.col(column).segment(row, base[k].size()) =
            (moved_blocks[k] - image_blocks[k]) / (increment * base[k].norm());
        row += base[k].size();
      }
    }
  return general_eigenvalues(monodromy).values.cwiseAbs().maxCoeff();
}

}  // namespace whine::hard_cases
