// Two gears at a fixed mesh phase: the time steps of a sweep (propagators, relaxed loads, contact at every step), but
// nothing rolls. Whatever has modes, a compliance and gaps can be moved so, down to one mass on one spring.
#pragma once
#include <Eigen/Core>
#include <limits>
#include <vector>

#include "contact/complementarity.h"
#include "dynamics/newmark.h"

namespace whine {

// The pair at a fixed phase, contact on strips: z'' + damping z' + frequency_squared z = torque - participation^T p
// under contact with gap d = gap - participation z + U + local p, relaxation U' + U = residual p.
struct FixedPhaseMesh {
  double phase = 0;                   // 1: mesh phase
  Eigen::VectorXd frequency_squared;  // (coordinate) rad2 s-2; the first is the rigid rotation, 0
  Eigen::VectorXd damping;            // (coordinate) s-1
  // (coordinate) rad2 s-2: of frequency_squared, what the bodies hold and bearings do not; empty: all
  Eigen::VectorXd elastic;
  double near = 0;               // Hz: where the natural frequency is looked for; 0: the lowest one is meant
  Eigen::VectorXd torque;        // (coordinate) constant force of the torques
  Eigen::VectorXd error_weight;  // (coordinate) transmission error per unit
  // (coordinate) by how much the flanks close per unit, translations of the hubs included; empty: as error_weight
  Eigen::VectorXd closing_weight;
  Eigen::MatrixXd participation;    // (strip, coordinate)
  Eigen::MatrixXd local, residual;  // (strip, strip) m N-1
  Eigen::VectorXd gap;              // (strip) m
  std::vector<int> first_strip;     // (pair + 1)
  std::vector<int>
      zone_end;  // strips at an end of their candidate zone that is no tip edge: no force is allowed there
  double next_corner_gap = std::numeric_limits<double>::infinity();  // m, see MeshPosition
  double lost_corner_gap = std::numeric_limits<double>::infinity();  // m
  double relaxation = 0;  // s; 0: the residual flexibility is instantaneous
  bool newmark = false;

  // m: of coordinates z, what tip edges' gaps are compared with.
  double closing(const Eigen::VectorXd& z) const {
    return (closing_weight.size() > 0 ? closing_weight : error_weight).dot(z);
  }
};

class FixedPhaseMotion {
 public:
  // step: s. Begins at z = 0, at rest, with what force the gaps there ask for.
  FixedPhaseMotion(FixedPhaseMesh mesh, double step);

  // Goes on from z (coordinate) at rest under the forces p (strip, N), which are fully relaxed.
  void start(const Eigen::VectorXd& z, const Eigen::VectorXd& p);
  // Contact forces of this instant anew, from the displacements alone: after one was set, or the compliance stepped.
  void touch();
  // To the end of the next step. Throws Error(numerical) as ComplementaritySolver::solve.
  Certificate advance();

  void set_torque(const Eigen::VectorXd& torque) { mesh_.torque = torque; }
  void set_local(const Eigen::MatrixXd& local);  // (strip, strip) m N-1: what is instantaneous

  const FixedPhaseMesh& mesh() const { return mesh_; }
  // (strip, strip) m N-1: what the strips give way at the end of a step, modes and relaxed loads included.
  const Eigen::MatrixXd& compliance() const { return compliance_; }
  double transmission_error() const { return mesh_.error_weight.dot(z); }  // m

  Eigen::VectorXd z, v;     // (coordinate)
  Eigen::VectorXd force;    // (coordinate) contact and torque at this instant
  Eigen::VectorXd p, d;     // (strip) N, m
  Eigen::VectorXd relaxed;  // (strip) N: relaxed loads

 private:
  FixedPhaseMesh mesh_;
  std::vector<Propagator> steps_;  // (coordinate)
  Relaxation relaxed_step_{};
  Eigen::MatrixXd compliance_;
  Eigen::VectorXd e_, push_;
  ActiveSet active_;
  ComplementaritySolver solver_;
};

}  // namespace whine
