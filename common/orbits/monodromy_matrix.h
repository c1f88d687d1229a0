// The tangent of a period map on the few directions that a period does not forget: dP^m/dy ~ W V^T with V orthonormal and
// W = dP^m/dy V.
//
// V spans the eigenvectors of the largest multipliers (subspace iteration), so the multipliers are the eigenvalues of V^T W
// and what is left out contracts: Newton's method with W V^T in place of the tangent converges linearly with the largest
// multiplier left out (Newton and Picard; Lust, Roose, Spence and Champneys, SIAM J. Sci. Comput. 19 (1998) 1188-1209). A
// state of 8 numbers or fewer has all of its directions in V: W is the tangent.
#pragma once
#include <Eigen/Core>
#include <functional>

namespace whine {

struct MonodromyMatrix {
  Eigen::MatrixXd basis, image;  // (size, direction) V, W
  bool empty() const { return basis.cols() == 0; }
  Eigen::MatrixXd matrix() const { return image * basis.transpose(); }  // (size, size) W V^T
  bool whole() const { return basis.cols() == basis.rows(); }
  // (direction) eigenvalues of V^T W, descending modulus; those of the smallest are rough. Throws Error(numerical) if they cannot be found.
  Eigen::VectorXcd multipliers() const;
};

// From the directions of a tangent nearby, or from none, until the residual of the largest multipliers' eigenvectors is below
// `tolerance`; as many directions as leave no multiplier above 0.2 out, and all where these do not stand apart from the rest. times(directions): the
// tangent times directions. also: (size) a direction that V shall hold as well; empty: none.
MonodromyMatrix slow_tangent(int size, const MonodromyMatrix& nearby, const Eigen::VectorXd& also,
                             double tolerance,
                             const std::function<Eigen::MatrixXd(const Eigen::MatrixXd& directions)>& times);

}  // namespace whine
