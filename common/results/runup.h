// A motion while the speed changes with time.
#pragma once
#include <Eigen/Core>
#include <array>

#include "base/matrix.h"
#include "model/stages.h"

namespace whine {

// Linear ramp of the mesh frequency: f(t) = from + a t, a = +-rate / 60 x teeth of the driver, phase(t) = from t + a t^2 / 2.
struct SpeedRamp {
  double from = 0, to = 0;  // Hz, mesh frequency
  double rate = 0;          // rev min-1 s-1 of the driver, > 0
};

// Samples of one rate; (sample).
struct RunupSamples {
  Eigen::VectorXd time, mesh_frequency;            // s, Hz
  Eigen::VectorXd transmission_error, mesh_force;  // m, N
  MatrixRM tooth_load;                             // (sample, pair) N
  std::array<MatrixRM, kSides> bearing_force;      // (sample, xy) N; empty for a rigid bearing
  Eigen::Index size() const { return time.size(); }
};

// What each mesh period showed at its time steps, before any filter; (mesh period).
struct RunupPeriods {
  Eigen::VectorXd time, mesh_frequency;  // s, Hz, at its start
  Eigen::VectorXd dte_rms, dte_mean;     // m
  Eigen::VectorXd tooth_load_max;        // N: largest that a pair sustains for 1/64 of the period
  Eigen::VectorXd separation_fraction;   // 1: share of the time without contact
  // [gear] Pa: largest root stress that the teeth sustain for 1/64 of the period, quasi-static in their loads; empty where bodies
  // have no tables
  std::array<Eigen::VectorXd, kSides> root_stress_sustained = {};
  Eigen::Index size() const { return time.size(); }
};

// runup.h5
struct RunupResult : MotionParameters {
  double torque = 0;                               // N m on the driver
  double mean_stiffness = 0;                       // N m-1 that sets the bearing dampers
  std::array<double, kSides> bearing_damper = {};  // N m s
  double natural_frequency = 0;                    // Hz, as in sweep.h5
  Direction direction = Direction::up;
  SpeedRamp ramp;
  double mesh_acceleration = 0;  // Hz s-1, below 0 for falling speed
  double sample_rate = 0;        // Hz
  Eigen::VectorXi pair;          // (pair)
  RunupSamples samples;
  RunupPeriods periods;
  bool root_stress = false;  // periods have it
  // certificate: worst over all steps
  double least_gap = 0, least_force = 0;  // m, N
  int fallbacks = 0;
  double drift_force = 0;      // N: largest force that the output must supply to hold the speed
  double backlash_margin = 0;  // m left on the line of action; infinite where no backlash is counted

  // Mesh periods since the start, at t (s).
  double mesh_phase(double t) const { return t * (ramp.from + 0.5 * mesh_acceleration * t); }
};

}  // namespace whine
