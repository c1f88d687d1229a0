// A contact under every load at once: d = A p + g - x a >= 0, p >= 0, p . d = 0, a . p = load, as the load grows.
//
// A is symmetric positive definite and a > 0, so forces and gaps are piecewise linear in the rigid freedom x and the load
// rises with it: the path is followed from the first touch on by principal pivots, one wherever a strip comes or goes (the
// parametric form of Cottle's principal pivoting method; Cottle, Pang and Stone, The Linear Complementarity Problem, 1992,
// section 4.5). The whole path costs about as many pivots of n^2 operations as strips that touch at its end, however many
// loads are asked for.
#pragma once
#include <Eigen/Core>

namespace whine {

class LoadPath {
 public:
  // a: (strip, strip) m N-1; gap: (strip) m; approach: (strip) 1, above 0; load: N, above 0, ascending. x: (load) m, result.
  // Throws Error(numerical) if A is not positive definite on strips that touch, for numbers that are not finite, or if the
  // last solution leaves more than 1e-9 of its x as a residual.
  void follow(const Eigen::MatrixXd& a, const Eigen::VectorXd& gap, const Eigen::VectorXd& approach,
              const Eigen::VectorXd& load, Eigen::Ref<Eigen::VectorXd> x);

  const Eigen::VectorXd& force() const { return force_; }  // (strip) N, under the last load
  int pivots() const { return pivots_; }                   // of the last path
  double residual() const { return residual_; }            // 1: of the last solution, over its x

 private:
  void pivot(int k);
  Eigen::MatrixXd table_;             // of the pivoted problem: w = T z + t, w, z >= 0, w . z = 0
  Eigen::VectorXd constant_, slope_;  // t = constant - x slope
  Eigen::VectorXd column_, force_;
  Eigen::Array<bool, Eigen::Dynamic, 1> touches_;  // w is the strip's force, not its gap
  int pivots_ = 0;
  double residual_ = 0;
};

}  // namespace whine
