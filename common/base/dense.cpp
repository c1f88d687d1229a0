#include "base/dense.h"

#include <Eigen/Eigenvalues>

namespace whine {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;

SymmetricEigen symmetric_eigen(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a);
  return {solver.info() == Eigen::Success, solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigen symmetric_eigenvalues(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a, Eigen::EigenvaluesOnly);
  return {solver.info() == Eigen::Success, solver.eigenvalues(), {}};
}

SymmetricEigen symmetric_eigenvalues(const MatrixXcd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXcd> solver(a, Eigen::EigenvaluesOnly);
  return {solver.info() == Eigen::Success, solver.eigenvalues(), {}};
}

SymmetricEigen tridiagonal_eigen(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& beside) {
  Eigen::SelfAdjointEigenSolver<MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside);
  return {solver.info() == Eigen::Success, solver.eigenvalues(), solver.eigenvectors()};
}

HermitianEigen hermitian_eigen(const MatrixXcd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXcd> solver(a);
  return {solver.info() == Eigen::Success, solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigen symmetric_eigen(const MatrixXd& k, const MatrixXd& m) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(k, m);
  return {solver.info() == Eigen::Success, solver.eigenvalues(), solver.eigenvectors()};
}

GeneralEigenvalues general_eigenvalues(const MatrixXd& a) {
  const Eigen::EigenSolver<MatrixXd> solver(a, false);
  const bool converged = solver.info() == Eigen::Success;
  return {converged, converged ? Eigen::VectorXcd(solver.eigenvalues()) : Eigen::VectorXcd()};
}

}  // namespace whine
