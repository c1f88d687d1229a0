// A system of elastic gears in motion on lines: statics for the mean stiffnesses and the losses by friction come first, and tip edges are
// looked for as far as motions need them.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/motion.h"
#include "model/capabilities.h"
#include "model/system_stages.h"
#include "results/motion_source.h"
#include "results/reduced_body.h"

namespace whine {

// Mesh periods per speed before a motion counts as not periodic, and so many hunting periods at least.
inline constexpr int kMostSystemPeriods = 3000, kLeastSystemTurns = 100;

// Teeth that differ or are cracked.
Traits traits(const SystemStaticParameters& settings, const std::vector<ReducedBody>& bodies);

class LinesMotion : public Motion {
 public:
  static constexpr int kMostWidenings = 5;
  // bodies: [gear] of settings.body; positions: of a mesh period, those of set_positions(). Contact is on lines whatever
  // settings.fidelity.contact says. Throws as rest_over_period() and SystemDynamics.
  LinesMotion(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies, int positions);

  const SystemModel& system() const override { return system_; }
  const SystemMotion& motion() const { return motion_; }
  SystemDynamics& dynamics() { return *dynamics_; }
  const Eigen::MatrixXd& mean_stiffness() const { return stiffness_; }  // (mesh, mesh) N m-1, at rest
  // The settings with the masses, inertias and the contact level that are used, and what else results say of them.
  MotionSource source() const;
  int hunting_periods() const override { return dynamics_->hunting_periods(); }
  int reach() const override {
    return std::max(-dynamics_->first_pair(), dynamics_->first_pair() + dynamics_->tooth_pairs() - 1);
  }
  // Throws Error(input) where nothing turns.
  double natural_frequency() override;
  double axis_damper(int g) override;

  State rest() override { return dynamics_->rest(); }
  std::optional<MotionRecord> settle(State& state, double mesh_frequency, int steps, const Settling& how,
                                     MotionAcceleration* shared = nullptr) override;
  State predicted(const std::vector<KnownOrbit<State>>& branch, double mesh_frequency, int steps) override;
  void pass_speed(double mesh_frequency, int steps) override { dynamics_->set_speed(mesh_frequency, steps); }
  bool integrate(State& state, MotionPeriod& period) override;
  std::unique_ptr<MotionMap> map(int steps) override;
  // Looks for tip edges that are 1.6 times as far off as before, for which dynamics() is made anew. Throws ModelRangeError after 5 times.
  void widen(const std::vector<State*>& states) override;
  int level() const override { return widenings_; }
  int most_level() const override { return kMostWidenings; }

 private:
  bool record(State& state, MotionRecord& out);
  void take_holding(MotionRecord& out) const;
  void take_rest();
  void take_losses(const SystemModel& still, const std::vector<SystemSolution>& rest);
  std::unique_ptr<SystemDynamics> placed() const;  // with the tip edges that `widenings_` asks for
  SystemModel system_;
  SystemSweepParameters settings_;
  SystemMotion motion_;
  Eigen::MatrixXd stiffness_;
  std::vector<double> deflection_;  // [mesh] m, largest at rest
  std::unique_ptr<SystemDynamics> dynamics_;
  int positions_, widenings_ = 0;
};

}  // namespace whine
