// Linear complementarity: find p >= 0 with d = A p + e >= 0 and p . d = 0, A symmetric positive definite (Eq.
// 18).
//
// Block principal pivoting (Judice and Pires; Portugal, Judice and Vicente, Math. Comp. 63 (1994) 625) from a
// guessed active set; when its block steps stop paying, least-index steps; if even they take too long, Lawson
// and Hanson's non-negative least squares on the same matrix, whose objective falls with every step. An
// active set that was right before is kept with the inverse of its block, so that a problem whose contact
// pattern repeats costs one matrix-vector product and a check.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace whine {

// The active set of a solve and the inverse of A on it. One per problem family (for instance: one per mesh
// position); `forget` when A changes.
struct ActiveSet {
  std::vector<int> strips;  // indices with force, ascending
  Eigen::MatrixXd inverse;  // (active, active) of A on them; valid if `known`
  bool known = false;
  void forget() { known = false; }
};

// What a solve reached. A solution is returned only if both bounds hold (tolerances in solve).
struct Certificate {
  double least_gap = 0;    // m, over strips without force (0 if there is none); >= -gap tolerance
  double least_force = 0;  // N, over strips with force (0 if there is none); >= -force tolerance
  int factorisations = 0;  // 0: the kept inverse was right
  bool fallback = false;   // Lawson-Hanson was needed
};

class ComplementaritySolver {
 public:
  // A: (n, n); e: (n); p, d: (n), results. active: start and result. Gap tolerance: 1e-12 of the largest |e|,
  // force tolerance: that over A_ii. Throws Error(numerical) if A is not positive definite on the set that is
  // tried.
  Certificate solve(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::VectorXd>& e,
                    ActiveSet& active, Eigen::Ref<Eigen::VectorXd> p, Eigen::Ref<Eigen::VectorXd> d);

 private:
  void reserve(int n);
  bool verify(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::VectorXd>& e,
              const std::vector<int>& strips, Eigen::Ref<Eigen::VectorXd> p, Eigen::Ref<Eigen::VectorXd> d,
              Certificate& certificate);
  void factorise(const Eigen::Ref<const Eigen::MatrixXd>& a, ActiveSet& active);
  void lawson_hanson(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::VectorXd>& e,
                     ActiveSet& active);
  std::vector<char> in_;    // (n) 1: in the active set
  std::vector<int> wrong_;  // indices that break a sign
  Eigen::VectorXd e_active_, p_active_;
  double gap_tolerance_ = 0;  // m
};

}  // namespace whine
