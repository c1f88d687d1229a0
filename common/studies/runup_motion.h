// What a run-up has to know of a pair, and of a train, in motion: mesh period after mesh period at speeds that are passed.
#pragma once
#include <Eigen/Core>
#include <limits>
#include <vector>

#include "dynamics/dynamics.h"
#include "results/runup.h"
#include "results/static.h"
#include "studies/branch_rigs.h"
#include "studies/sustained_peaks.h"
#include "studies/zone_levels.h"
#include "system/rolling_mesh.h"

namespace whine {

// What one mesh period showed; step i at phase i / steps, step 0 that of its end.
struct RunupPeriod {
  Eigen::MatrixXd transmission_error, mesh_force;  // (step, mesh) m, N
  Eigen::MatrixXd tooth_load;                      // (pair, step) N, of a pair; pairs -reach to reach
  std::vector<Eigen::Matrix2Xd> bearing_force;     // [body] (xy, step) N; empty for what samples do not hold
  Eigen::VectorXd tooth_load_max, separation;      // (mesh) as in RunupPeriods
  Eigen::VectorXd root_stress;                     // (body) likewise, or empty
  double least_gap = 0, least_force = 0, drift_force = 0;
  int fallbacks = 0;
};

class RunupMotion {
 public:
  virtual ~RunupMotion() = default;
  // All of the head that the motion decides; returns the largest |pair| that may touch, -1: loads of pairs are not recorded.
  virtual int begin(RunupResult& head) = 0;
  // Goes to the periodic motion at a speed (Hz) into which it settles from rest; false if that does not repeat. Throws ModelRangeError
  // where contact leaves all that is looked at.
  virtual bool settle(double mesh_frequency, int steps) = 0;
  // One mesh period, number k, at a speed (Hz) which is a new one (`fresh`) or that of the period before. Throws Error(numerical).
  virtual const RunupPeriod& integrate(long k, double mesh_frequency, int steps, bool fresh) = 0;
  // m: backlash that all periods left.
  virtual double backlash_margin() const { return std::numeric_limits<double>::infinity(); }
};

// On the lowest level of candidate zones that holds the motion, as sweeps are.
class PairRunup : public RunupMotion {
 public:
  PairRunup(const GearMeshModel& model, const DynamicParameters& parameters, const StaticResult& statics,
            const SweepParameters& settings, double lowest_frequency);
  int begin(RunupResult& head) override;
  bool settle(double mesh_frequency, int steps) override;
  const RunupPeriod& integrate(long k, double mesh_frequency, int steps, bool fresh) override;
  double backlash_margin() const override { return model_.kinematics.backlash() + least_closing_; }

 private:
  bool try_period();
  void read(long k);

  const GearMeshModel& model_;
  const SweepParameters& settings_;
  ZoneLevels levels_;
  SustainedPeaks peaks_;
  Vec2 normal_;
  int level_ = 0;
  long level_since_ = 0;
  double least_closing_ = std::numeric_limits<double>::infinity();
  RollingDynamics::State state_, trial_;
  RollingDynamics::Period period_;
  RunupPeriod out_;
};

class TrainRunup : public RunupMotion {
 public:
  // of_pair: it is a pair in slices, whose head says so and whose tooth loads are recorded.
  TrainRunup(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
             bool of_pair = false)
      : settings_(settings), rig_(settings, bodies), of_pair_(of_pair) {}
  int begin(RunupResult& head) override;
  bool settle(double mesh_frequency, int steps) override;
  const RunupPeriod& integrate(long k, double mesh_frequency, int steps, bool fresh) override;

  double backlash_margin() const override {
    return of_pair_ ? rig_.train().system().mesh[0].kinematics.backlash() + least_closing_
                    : std::numeric_limits<double>::infinity();
  }

 private:
  void read();
  void read_pair();

  const SystemSweepParameters& settings_;
  TrainRig rig_;
  TrainRig::State state_, trial_;
  bool of_pair_;
  int reach_ = -1;
  double least_closing_ = std::numeric_limits<double>::infinity();
  SystemDynamics::Period period_;
  RunupPeriod out_;
};

}  // namespace whine
