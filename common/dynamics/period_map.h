// The period map of two elastic gears, and its exact tangent.
//
// State: modes (w z, v), relaxed loads of all teeth in reach, and the contact forces at the nodes of phase 0, through which the
// last step's force acts on the first half of the next one. All are in units of the energy norm of RollingDynamics.
//
// Every step is z+ = T(z) - (b/2) h^T p with p the solution of a contact problem d = A p + e(z), so with the active strips F
// kept
//   dp_F = -A_FF^-1 de_F,
// and of lines dp = -(C + law')^-1 de over the pairs with force. The tangent replays the period integrated last with these
// sets, for all perturbations side by side. What a step needs of the contact is condensed to the nodes of its candidate zones
// first, W^T A_FF^-1 W, so a perturbation costs what the modes and the relaxed loads cost, and no contact.
//
// Cost of a tangent, 128 steps, 61 modes per gear: of strips that of 154 periods for 384 numbers of a state, of lines, whose
// steps hardly cost more than their modes, of 360 for 369; with 5 modes of 69 for 160 and of 176 for 145. Central differences
// take two periods for each number, and know no sets.
#pragma once
#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "contact/lanes.h"
#include "dynamics/motion.h"

namespace whine {

class RollingPeriodMap : public MotionMap {
 public:
  // dynamics: with its range set; nobody else may change range or speed as long as the map lives. steps: per period, a
  // divisor of those of the range. Throws Error(input) for teeth that differ, whose motion repeats after a hunting period only,
  // and for more than kMostSize numbers of a state, whose tangent is a matrix of that size.
  RollingPeriodMap(RollingDynamics& dynamics, int steps);

  static constexpr int kMostSize = 3000;
  int size() const override { return static_cast<int>(unit_.size()); }
  void set_parameter(double mesh_frequency) override;
  double parameter() const override { return mesh_frequency_; }
  // Throws ModelRangeError(numerical) if contact leaves the candidate zone (take_left_zone() says so) or Error(numerical) as
  // RollingDynamics::integrate.
  Eigen::VectorXd apply(const Eigen::VectorXd& y) override;
  Eigen::MatrixXd tangent() override { return tangent_from(0); }
  Eigen::MatrixXd tangent_times(const Eigen::MatrixXd& directions) override {
    return replayed(0, directions);
  }
  std::vector<ContactEvent> events() const override;
  Eigen::VectorXd observable() const override { return period_.transmission_error; }
  MotionPeriod shown() const override;
  Eigen::VectorXd flat_of(const MotionState& state) const override {
    return flat(std::get<RollingDynamics::State>(state));
  }
  MotionState state_of(const Eigen::VectorXd& y) const override { return state(y); }
  std::pair<int, int> place_of(int contact) const override { return {0, contact}; }

  // The same period cut at the end of step `cut` (0 to steps - 1): its tangent as if the first steps were those of the period
  // after it. Of an orbit all have the same multipliers.
  Eigen::MatrixXd tangent_from(int cut);
  const RollingDynamics::Period& period() const { return period_; }
  // (step) of the period applied last: the strips, or the pairs, that carry force.
  std::vector<std::vector<int>> active_sets() const;

  // y of a state with contact forces, and a state of y, which has none: they go through its forces on modes and relaxed loads.
  Eigen::VectorXd flat(const RollingDynamics::State& state) const;
  RollingDynamics::State state(const Eigen::VectorXd& y) const;

 private:
  using Position = RollingDynamics::Position;
  static constexpr int kWide = 8;  // perturbations that go through a period side by side
  // What a step does to perturbations. Places in numbers_; rows and nodes in whole lanes.
  struct Replay {
    int rows = 0, nodes = 0;  // shape rows of all pairs; nodes of all pairs
    int present = 0, nodes_of_pair = 0;
    size_t row = 0, load = 0;  // (coordinate, row): that gaps are read through, that forces act through
    size_t solve =
        0;  // (four nodes; residual field, then row; node): node forces of what modes and relaxed loads move
    size_t shape = 0;  // (node, row) halved: forces on shape rows of node forces
    size_t field = 0;  // (pair; gear; field, node)
    std::array<int, kMostPairs> slot{};
  };
  static constexpr int kCoefficients = 7;  // of a coordinate: a11, a12, a21, a22, push_z, push_v, bq
  const Position& position(int sample) const;
  int of_gear() const { return fields_ / dynamics_.gears(); }  // fields
  int channels(int cut) const;                                 // nodes of all pairs at a step
  Eigen::VectorXd units(int cut) const;
  // (node, node) N m-1: W^T A_FF^-1 W = S; of A + W E W^T with friction, (1 + S E)^-1 S.
  Eigen::MatrixXd node_forces(int sample) const;
  Eigen::MatrixXd node_forces_without_friction(int sample) const;
  Replay prepare(int sample);
  void prepare_replay();
  Eigen::MatrixXd replayed(int cut, const Eigen::MatrixXd& directions);
  void replay(int cut, const Eigen::Ref<const Eigen::MatrixXd>& directions, const Eigen::VectorXd& unit,
              Eigen::Ref<Eigen::MatrixXd> result);
  template <int kBefore, int kNext>
  void pass(const Replay& before, const Replay& next, int rows_next);
  void pass(const Replay& before, const Replay& next, bool reads);
  void read(const Replay& next);
  void relax(const Replay& at, double decay, double share);
  void solve(const Replay& at);
  void shape(const Replay& at);
  void push(const Replay& at, double sign);
  void rename();

  RollingDynamics& dynamics_;
  int coordinates_ = 0, fields_ = 0;  // fields of all gears; 0 without relaxation
  double mesh_frequency_ = 0;
  bool prepared_ = false;  // replay_ is of the period applied last
  Eigen::VectorXd unit_;   // (size) of phase 0
  RollingDynamics::Period period_;
  std::vector<double> coefficients_;  // (coordinate, kCoefficients)
  std::vector<Replay> replay_;        // (sample)
  std::vector<double> numbers_;       // of all steps
  // (.., kWide) of perturbations: coordinates; residual fields and then shape rows; node forces; forces on shape rows
  std::vector<double> z_, v_, moved_, nodes_, half_;
  int live_first_ = 0, live_last_ = 0;  // teeth from first to last - 1: no other has any relaxed load
};

}  // namespace whine
