// A motion while the speed changes with time, of a pair or of a train.
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "results/motion_source.h"

namespace whine {

// Linear ramp of the mesh frequency: f(t) = from + a t, a = +-rate x mesh periods in a revolution of the input / 60, phase(t) = from t +
// a t^2 / 2.
struct SpeedRamp {
  double from = 0, to = 0;  // Hz, mesh frequency
  double rate = 0;          // rev min-1 s-1 of the input, > 0
};

// Samples of one rate; (sample).
struct RunupSamples {
  Eigen::VectorXd time, mesh_frequency;     // s, Hz
  MatrixRM transmission_error, mesh_force;  // (sample, mesh) m, N
  MatrixRM tooth_load;                      // (sample, pair) N, of a pair; empty of trains
  std::vector<MatrixRM> bearing_force;      // [body] (sample, xy) N; empty for a rigid bearing of a pair
  Eigen::Index size() const { return time.size(); }
};

// What each mesh period showed at its time steps, before any filter; (mesh period).
struct RunupPeriods {
  Eigen::VectorXd time, mesh_frequency;  // s, Hz, at its start
  MatrixRM dte_rms, dte_mean;            // (mesh period, mesh) m
  MatrixRM tooth_load_max;       // (mesh period, mesh) N: largest that a pair sustains for 1/64 of the period
  MatrixRM separation_fraction;  // (mesh period, mesh) 1: share of the time without contact
  // (mesh period, mesh and within it side) Pa: largest root stress that the teeth sustain for 1/64 of the period, quasi-static in their
  // loads; 0 of a mesh of which it is not known, empty if it is of none
  MatrixRM root_stress_sustained;
  Eigen::Index size() const { return time.size(); }
};

// runup.h5
struct RunupResult : MotionSource {
  std::string input;  // the body of whose speed ramp.rate is

  double mean_stiffness = 0;                       // N m-1 that sets the bearing dampers of a pair
  std::array<double, kSides> bearing_damper = {};  // N m s
  double natural_frequency = 0;                    // Hz, as in sweep.h5, of a pair
  Direction direction = Direction::up;
  SpeedRamp ramp;
  double mesh_acceleration = 0;  // Hz s-1, below 0 for falling speed
  double sample_rate = 0;        // Hz
  Eigen::VectorXi pair;          // (pair) of tooth_load
  RunupSamples samples;
  RunupPeriods periods;
  bool root_stress = false;  // periods have it
  // certificate: worst over all steps
  double least_gap = 0, least_force = 0;  // m, N
  int fallbacks = 0;
  double drift_force = 0;  // N: largest force that the output must supply to hold the speed
  double backlash_margin =
      0;  // m left on the line of action; infinite where no backlash is counted, and of trains

  // Whether samples hold the force of a body on its bearing.
  bool has_bearing(size_t body) const { return of_train() || mesh.bearing[body].elastic(); }
  // Mesh periods since the start, at t (s).
  double mesh_phase(double t) const { return t * (ramp.from + 0.5 * mesh_acceleration * t); }
};

}  // namespace whine
