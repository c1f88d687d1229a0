// What the coordinates of a system feel where its frame turns with the carrier at Omega (rad s-1, counter-clockwise): inertia forces of
// the rigid motions of the bodies, and dampers on the ground, which see the frame go by.
//
// With y = W z the displacements X_b of hubs and u_c = r theta of the carrier, P_b the place of b from its axis, J = [[0, -1], [1, 0]],
//   force on z = W^T (g + kappa y - gamma W v),
//   X_b:  g = m Omega^2 P_b,  kappa = m Omega^2 - c Omega J,  gamma = 2 m Omega J,   c the damper of a bearing on the ground, else 0;
// kappa of a planet on a carrier is m Omega^2 N, with N of system/rigid_system.h: X_b - d u_c in place of X_b, and X_c with d u_c.
// m is the mass of body and hub as one: the same terms of elastic modes are left out.
//
// A step: Coriolis forces turn v for half of it before and after all else, v <- (I + a)^-1 (I - a) v with a = seconds / 4 W^T gamma W,
// which keeps |v|. g and kappa y are part of the force at both ends, so that the centrifugal work is the change of its potential and a
// static equilibrium stays; as motions are few, what they need at the end of a step follows from them:
//   f = kappa' W z of z without f,  kappa' = kappa (I - W diag(bq) W^T kappa / 2)^-1,  z += bq / 2 W^T f,  v += bv / 2 W^T f.
// Both are of second order in the step, as the mean of contact forces is.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "dynamics/system_coordinates.h"

namespace whine {

class TurningFrame {
 public:
  TurningFrame() = default;  // at rest
  TurningFrame(const System& layout, const SystemCoordinates& coordinates, double omega);
  bool turns() const { return !body_.empty(); }
  double omega() const { return omega_; }

  // Of steps of `seconds` with the propagators bq.
  void set_step(double seconds, const Eigen::Ref<const Eigen::VectorXd>& bq);
  // v, (coordinate, column), half a step on by Coriolis forces.
  void turn(Eigen::Ref<Eigen::MatrixXd> v) const { add(half_turn_ * motions(v), v); }
  // (motion, column): f above, of coordinates without it.
  Eigen::MatrixXd closing(const Eigen::Ref<const Eigen::MatrixXd>& y) const { return closing_ * y; }
  // (contact, contact) m N-1: what closing() adds to the compliance of contacts at the end of a step, for the rows (motion, contact)
  // W diag(bq) h^T that gaps are read by and forces act through. Of closing() the antisymmetric part, of dampers alone and below 1e-9 of
  // the compliance, is left out.
  Eigen::MatrixXd compliance(const Eigen::MatrixXd& read, const Eigen::MatrixXd& pushed) const {
    return 0.125 * read.transpose() * (closing_ + closing_.transpose()) * pushed;
  }

  // (motion, column) W z
  Eigen::MatrixXd motions(const Eigen::Ref<const Eigen::MatrixXd>& z) const;
  // z += weight W^T f, coordinate by coordinate; without weight z += W^T f.
  void add(const Eigen::Ref<const Eigen::MatrixXd>& f, Eigen::Ref<Eigen::MatrixXd> z) const;
  void add(const Eigen::Ref<const Eigen::MatrixXd>& f, const Eigen::Ref<const Eigen::VectorXd>& weight,
           Eigen::Ref<Eigen::MatrixXd> z) const;
  Eigen::VectorXd constant() const { return constant_; }                  // (motion) g
  Eigen::MatrixXd stiffness() const { return centrifugal_ + dragging_; }  // (motion, motion) kappa
  Eigen::VectorXd force(const Eigen::VectorXd& z) const {                 // (motion) g + kappa W z
    return constant_ + stiffness() * motions(z);
  }
  Eigen::VectorXd coriolis(const Eigen::Ref<const Eigen::VectorXd>& v) const {  // (motion) gamma W v
    return coriolis_ * motions(v);
  }
  // N: inertia force of a body that moves by x at the velocity v in the frame, m (2 Omega J v - Omega^2 (P + x)), minus that on it.
  Vec2 inertia_force(int b, const Vec2& x, const Vec2& v) const;
  // (body) N: what the forces on z push the rigid rotation u = r theta of each carrier by.
  Eigen::VectorXd on_carriers(const Eigen::VectorXd& force, Eigen::Index bodies) const;
  // J: work on the way from z0 to z1 of the mean of the forces at both ends; of centrifugal ones, and (body) of dampers on the ground.
  struct Work {
    double centrifugal = 0;
    Eigen::VectorXd dragging;
  };
  Work work(const Eigen::VectorXd& z0, const Eigen::VectorXd& z1) const;

 private:
  // Coordinates side by side that motions have, from number `at` of all these on.
  struct Touched {
    int first = 0, count = 0, at = 0;
  };
  // Rows of motions on the coordinates from `first` on.
  struct Block {
    int row = 0, first = 0;
    Eigen::MatrixXd w;  // (row, coordinate)
  };
  void gather(const std::vector<Block>& blocks);
  void take(const System& layout, const SystemCoordinates& coordinates, int b, int row,
            std::vector<Block>& blocks);

  double omega_ = 0;
  std::vector<Touched> touched_;
  Eigen::MatrixXd w_;         // (motion, touched coordinate) W
  std::vector<int> body_;     // [motion] number of the body
  std::vector<int> carrier_;  // [motion] that moves it as it turns, by `carried_`; -1: none
  Eigen::VectorXd carried_;   // (motion) 1
  Eigen::VectorXd constant_;  // (motion)
  Eigen::MatrixXd centrifugal_, dragging_, coriolis_, half_turn_, closing_;  // (motion, motion)
};

}  // namespace whine
