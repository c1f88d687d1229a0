// Apart from dense.cpp so that a compiler works on both side by side.
#include "base/dense.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace whine {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;

SingularValues singular_values(const MatrixXd& a) {
  // BDCSVD takes a third of its time and four times as long to compile.
  const Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeThinV);
  return {svd.info() == Eigen::Success, svd.singularValues(), svd.matrixV()};
}

MatrixXd least_squares(const MatrixXd& a, const MatrixXd& b, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  if (threshold > 0) qr.setThreshold(threshold);
  return qr.solve(b);
}

MatrixXcd least_squares(const MatrixXcd& a, const MatrixXcd& b) {
  return a.colPivHouseholderQr().solve(b);
}

Eigen::VectorXd least_norm(const MatrixXd& a, const Eigen::VectorXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

MatrixXd lu_solve(const MatrixXd& a, const MatrixXd& b) {
  return a.partialPivLu().solve(b);
}

}  // namespace whine
