// Supernodal Cholesky factorisation of complex Hermitian matrices, and condensation of real ones, by CHOLMOD (Chen, Davis, Hager and
// Rajamanickam, ACM TOMS 35 (2008) 22), which stays behind this wall.
#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>
#include <memory>
#include <string>
#include <vector>

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

// The order in which the nodes of a graph are eliminated, least fill first, those with `last` after all others: (place) node.
// graph: symmetric, compressed, its values without meaning.
std::vector<int> elimination_order(const Eigen::SparseMatrix<double>& graph, const std::vector<char>& last);

// What is left of a real symmetric positive definite system K u = F when all but its last unknowns, the kept ones, are eliminated:
// F^T u = D + R^T S^-1 R with S = K_kk - K_ki K_ii^-1 K_ik, R = F_k - K_ki K_ii^-1 F_i, D = F_i^T K_ii^-1 F_i.
struct CondensedSystem {
  Eigen::MatrixXd stiffness;    // (kept, kept): S
  Eigen::MatrixXd load;         // (kept, column): R
  Eigen::MatrixXd flexibility;  // (column, column): D
};
// stiffness: upper triangle, unknowns in their order of elimination; load: (unknown, column), 0 on kept unknowns. `what` names the matrix
// in the message. Throws Error(numerical) if it is not positive definite.
CondensedSystem condensed_system(const Eigen::SparseMatrix<double>& stiffness, Eigen::Index kept,
                                 const Eigen::MatrixXd& load, const std::string& what);

}  // namespace whine
