// Dense decompositions of Eigen, each compiled once: a compiler takes 5 to 20 s for each.
#pragma once
#include <Eigen/Core>

namespace whine {

// Values ascending, a vector in each column (none where only values were asked for). Not converged: the values are undefined.
struct SymmetricEigen {
  bool converged;
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a);
SymmetricEigen symmetric_eigenvalues(const Eigen::MatrixXd& a);
SymmetricEigen symmetric_eigenvalues(const Eigen::MatrixXcd& a);  // Hermitian
// Of a tridiagonal matrix, by its diagonal and the entries beside it.
SymmetricEigen tridiagonal_eigen(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& beside);
// k x = value m x with m positive definite, x'm x = 1.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);

struct HermitianEigen {
  bool converged;
  Eigen::VectorXd values;
  Eigen::MatrixXcd vectors;
};
HermitianEigen hermitian_eigen(const Eigen::MatrixXcd& a);

// Of a matrix without symmetry, in no order.
struct GeneralEigenvalues {
  bool converged;
  Eigen::VectorXcd values;
};
GeneralEigenvalues general_eigenvalues(const Eigen::MatrixXd& a);

// Singular values, largest first, and the right vectors, one in each column.
struct SingularValues {
  bool converged;
  Eigen::VectorXd values;
  Eigen::MatrixXd right;
};
SingularValues singular_values(const Eigen::MatrixXd& a);

// The least squares solution of a x = b by QR with column pivots; pivots below `threshold` times the largest count as zero
// (0: as round-off does).
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double threshold = 0);
Eigen::MatrixXcd least_squares(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);

// Of all x that come nearest to a x = b, the shortest.
Eigen::VectorXd least_norm(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

// x of a x = b; a is regular.
Eigen::MatrixXd lu_solve(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace whine
