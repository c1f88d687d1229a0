#include "studies/runup_motion.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "dynamics/steady_state.h"
#include "gear/layout.h"
#include "gear/pair.h"
#include "signal/branches.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

double sustained_tooth_load(const Eigen::MatrixXd& load) {  // (pair, step)
  return sustained_load(load.transpose(), static_cast<int>(load.cols()));
}

}  // namespace

PairRunup::PairRunup(const GearMeshModel& model, const DynamicParameters& parameters,
                     const StaticResult& statics, const SweepParameters& settings, double lowest_frequency)
    : model_(model),
      settings_(settings),
      levels_(model, parameters, statics, steps_at(settings.time, lowest_frequency)),
      peaks_(model, settings.time.steps_per_period),
      normal_(contact_normal(model.kinematics)) {}

// Level 0 tells the pairs that can touch; a wider zone may reach one more on either side.
int PairRunup::begin(RunupResult& head) {
  head.root_stress = peaks_.root_stress();
  levels_.at(0);
  head.natural_frequency = levels_.natural_frequency();
  for (size_t g = 0; g < kSides; ++g)
    head.bearing_damper[g] = levels_.at(0).bearing_damper(static_cast<int>(g));
  return levels_.reach() + 1;
}

bool PairRunup::settle(double mesh_frequency, int steps) {
  for (;; ++level_) {
    levels_.require(level_, mesh_frequency);
    RollingDynamics& dynamics = levels_.at(level_);
    state_ = dynamics.rest();
    dynamics.set_speed(mesh_frequency, steps);
    if (const auto orbit =
            iterate_to_orbit(dynamics, state_, settings_.time.periodicity, settings_.time.steady_state))
      return orbit->multiple != 0;
  }
}

bool PairRunup::try_period() {
  trial_ = state_;
  if (!levels_.at(level_).integrate(trial_, period_)) return false;
  std::swap(state_, trial_);
  return true;
}

// On the level of before or a higher one; a lower one is tried now and then.
const RunupPeriod& PairRunup::integrate(long k, double mesh_frequency, int steps, bool fresh) {
  constexpr long kPatience = 64;  // mesh periods on a level before the one below it is tried
  const auto go_to = [&](int level) {
    level_ = level;
    levels_.at(level_).pass_speed(mesh_frequency, steps);
  };
  if (fresh) go_to(level_);
  bool done = false;
  if (level_ > 0 && !levels_.keeps_one() && k - level_since_ >= kPatience) {
    level_since_ = k;
    go_to(level_ - 1);
    done = try_period();
    if (!done) go_to(level_ + 1);
  }
  while (!done && !try_period()) {
    levels_.require(level_ + 1, mesh_frequency);
    level_since_ = k;
    go_to(level_ + 1);
  }
  read(k);
  return out_;
}

void PairRunup::read(long k) {
  const auto steps = period_.transmission_error.size();
  out_.transmission_error = period_.transmission_error;
  out_.tooth_load = period_.tooth_pair_load;
  out_.mesh_force.resize(steps, 1);
  int parted = 0;
  for (Index i = 0; i < steps; ++i) {
    out_.mesh_force(i, 0) = period_.tooth_pair_load.col(i).sum();
    parted += !(out_.mesh_force(i, 0) > 0);
  }
  out_.separation.setConstant(1, static_cast<double>(parted) / static_cast<double>(steps));
  out_.tooth_load_max.setConstant(1, sustained_tooth_load(period_.tooth_pair_load));
  if (peaks_.root_stress() && k >= 0)
    out_.root_stress =
        peaks_.of(period_.tooth_pair_load, static_cast<int>(k), SustainedPeaks::kNever).segment(2, kSides);
  out_.bearing_force.resize(kSides);
  VectorXd closing = period_.transmission_error;  // without what bearings give way
  for (size_t g = 0; g < kSides; ++g)
    if (const Bearing& bearing = model_.bearing[g]; bearing.elastic()) {
      out_.bearing_force[g] = period_.bearing_force[g];
      closing += (g == 0 ? 1 : -1) / bearing.stiffness * (period_.bearing_force[g].transpose() * normal_);
    }
  least_closing_ = std::min(least_closing_, closing.minCoeff());
  out_.least_gap = period_.least_gap;
  out_.least_force = period_.least_force;
  out_.fallbacks = period_.fallbacks;
  out_.drift_force = period_.drift_force;
}

int TrainRunup::begin(RunupResult& head) {
  if (of_pair_) {
    const SystemDynamics& dynamics = rig_.train().dynamics();
    return reach_ = std::max(-dynamics.first_pair(), dynamics.first_pair() + dynamics.tooth_pairs() - 1);
  }
  static_cast<MotionSource&>(head) = rig_.train().source();
  return -1;
}

bool TrainRunup::settle(double mesh_frequency, int steps) {
  for (;; rig_.widen({})) {
    state_ = rig_.rest();
    if (const auto found = rig_.settle(state_, mesh_frequency, steps, settings_.time.steady_state))
      return found->multiple != 0;
  }
}

const RunupPeriod& TrainRunup::integrate(long /*k*/, double mesh_frequency, int steps, bool fresh) {
  if (fresh) rig_.train().dynamics().set_speed(mesh_frequency, steps);
  for (;;) {
    trial_ = state_;
    if (rig_.train().dynamics().integrate(trial_, period_)) break;
    rig_.widen({&state_});
    rig_.train().dynamics().set_speed(mesh_frequency, steps);
  }
  std::swap(state_, trial_);
  read();
  return out_;
}

void TrainRunup::read() {
  const SystemDynamics& dynamics = rig_.train().dynamics();
  const Index steps = period_.mesh_force.cols(), meshes = dynamics.meshes(), pairs = dynamics.tooth_pairs();
  out_.transmission_error = period_.transmission_error.transpose();
  out_.mesh_force = period_.mesh_force.transpose();
  out_.separation.resize(meshes);
  out_.tooth_load_max.resize(meshes);
  for (Index m = 0; m < meshes; ++m) {
    out_.separation[m] = static_cast<double>((period_.largest_tooth_force.row(m).array() <= 0).count()) /
                         static_cast<double>(steps);
    out_.tooth_load_max[m] = sustained_tooth_load(
        dynamics.tooth_forces().middleCols(m * pairs, pairs).bottomRows(steps).transpose());
  }
  out_.bearing_force = period_.bearing_force;
  out_.least_gap = period_.least_gap;
  out_.least_force = period_.least_force;
  out_.drift_force = period_.drift_force;
  if (of_pair_) read_pair();
}

// Loads of tooth pairs; the mesh force of a pair is their sum.
void TrainRunup::read_pair() {
  const SystemDynamics& dynamics = rig_.train().dynamics();
  const Index steps = period_.mesh_force.cols();
  out_.tooth_load.setZero(2 * reach_ + 1, steps);
  for (Index i = 1; i <= steps; ++i)
    for (int pair = 0; pair < dynamics.tooth_pairs(); ++pair)
      if (const int row = reach_ + dynamics.first_pair() + pair; row >= 0 && row <= 2 * reach_)
        out_.tooth_load(row, i % steps) = dynamics.tooth_forces()(i, pair);
  out_.mesh_force.col(0) = out_.tooth_load.colwise().sum().transpose();
  out_.bearing_force.assign(kSides, {});
  least_closing_ = std::min(least_closing_, period_.transmission_error.minCoeff());
}

}  // namespace whine
