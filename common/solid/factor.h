// Supernodal Cholesky factorisation of complex Hermitian matrices by CHOLMOD (Chen, Davis, Hager and
// Rajamanickam, ACM TOMS 35 (2008) 22), which stays behind this wall.
#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>
#include <memory>
#include <string>

namespace whine {

using SparseComplex = Eigen::SparseMatrix<std::complex<double>>;

class HermitianFactor {
 public:
  // Analyses the pattern of `a` (compressed, all entries stored or the upper triangle): once for all matrices
  // of it.
  explicit HermitianFactor(const SparseComplex& a);
  ~HermitianFactor();
  HermitianFactor(const HermitianFactor&) = delete;
  HermitianFactor& operator=(const HermitianFactor&) = delete;

  // a: pattern as analysed. `what` names the matrix in the message. Throws Error(numerical) if it is not
  // positive definite.
  void factorise(const SparseComplex& a, const std::string& what);

  // right: (row, column); solves a x = right. Throws Error(numerical) if the result is not finite.
  Eigen::MatrixXcd solve(const Eigen::MatrixXcd& right) const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace whine
