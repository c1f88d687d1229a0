// What one mesh period of a motion showed.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace whine {

// Load over the face of a mesh period in slices.
struct FacePeak {
  double tooth_load = 0;   // N: largest of a pair of teeth
  double load_factor = 0;  // K_Hbeta there: face_load_factor() of its line loads at that instant
  double line_load = 0;    // N m-1: largest in the inner 90 % of face and path
};

// Sample i at phase i / steps, sample 0 that of its end.
struct MotionPeriod {
  Eigen::MatrixXd transmission_error;  // (mesh, step) m: of rotations
  Eigen::MatrixXd
      mesh_deflection;         // (mesh, step) m: what flanks close by, motion of the hubs included; of lines
  Eigen::MatrixXd mesh_force;  // (mesh, step) N: sum of the tooth loads
  Eigen::MatrixXd largest_tooth_force;  // (mesh, step) N
  // (mesh and within it pair, step) N, pairs from first_pair on; sample 0 by the names of the next period. Filled by Motion and MotionMap.
  Eigen::MatrixXd tooth_load;
  int first_pair = 0;
  std::vector<FacePeak> face;  // [mesh] in slices, over the period; else empty
  // [body] (xy, step) N, of the body on what carries it: k x + c x' of an elastic bearing, on the ground k x + c (x' + Omega J x); of
  // a planet on a rigid pin of a carrier that moves F = sum of the contact forces - (P' + mu P), P = m X' + G^T q' its momentum in the
  // frame of the carrier and mu the damping by mass, less the inertia forces of the frame; on other rigid axes the sum of the contact
  // forces, without the inertia of the body's own modes. Of a carrier on a rigid axis the sum of those of its planets. Of strips no columns
  // for a rigid bearing.
  std::vector<Eigen::Matrix2Xd> bearing_force;
  // (body, step) N m, of lines, in the body's sense: what balances its contact forces. Of a held body its mean over a periodic motion is
  // that of the torque that holds it, the inertia of the body's own modes being 0 in the mean.
  Eigen::MatrixXd contact_torque;
  Eigen::VectorXd drift;                  // (null vector) N: of the last sample; of lines
  double drift_force = 0;                 // N: largest force that must be supplied to hold the mean speed
  double least_gap = 0, least_force = 0;  // m, N: worst of the steps' certificates
  int fallbacks = 0;                      // steps that block pivoting alone could not solve
  double friction_coupling = 0;           // m: of their certificates, largest

  int steps() const { return static_cast<int>(transmission_error.cols()); }
  int pairs() const { return static_cast<int>(tooth_load.rows() / transmission_error.rows()); }
  // (pair, step) N
  auto loads_of(Eigen::Index mesh) const { return tooth_load.middleRows(mesh * pairs(), pairs()); }
  // Sample 0 becomes that of its own start, the end of the period before.
  void begin_with_end_of(const MotionPeriod& before);
};

}  // namespace whine
