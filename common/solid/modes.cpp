#include "solid/modes.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/dense.h"
#include "base/error.h"

namespace whine {

ComplexModes lowest_modes(const SparseComplex& stiffness, const SparseComplex& mass,
                          const HermitianFactor& factor, int count, const std::string& what) {
  const Eigen::Index n = stiffness.rows();
  if (count < 1 || count > n / 2)
    fail(Failure::input, what, ": ", count, " modes asked of ", n, " unknowns; lower modes or element_mm");
  const Eigen::Index most = std::min<Eigen::Index>(n, 40 + 10 * count);
  constexpr double kConverged = 1e-12;  // error bound of a Ritz vector, relative to its eigenvalue

  // A fixed start without symmetry: identical runs, and no mode is orthogonal to it.
  Eigen::VectorXcd next(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double golden = std::fmod(std::numbers::phi * static_cast<double>(i + 1), 1.0);
    next[i] = {0.5 + golden, 1.5 - golden * golden};
  }
  Eigen::MatrixXcd basis(n, most), weighted(n, most);  // weighted: M basis
  Eigen::VectorXd diagonal(most), off(most);
  Eigen::MatrixXd ritz;  // (step, wanted) Ritz vectors in the basis
  Eigen::Index steps = 0;
  Eigen::VectorXcd next_weighted = mass * next;
  double length = std::sqrt(next.dot(next_weighted).real());
  for (bool converged = false; !converged;) {
    if (steps == most)
      fail(Failure::numerical, what, ": ", count, " modes of ", n, " unknowns did not converge in ", steps,
           " Lanczos steps; lower modes");
    basis.col(steps) = next / length;
    weighted.col(steps) = next_weighted / length;
    next = factor.solve(weighted.col(steps)).col(0);
    diagonal[steps] = weighted.col(steps).dot(next).real();
    ++steps;
    for (int pass = 0; pass < 2; ++pass)  // twice is enough
      next -= basis.leftCols(steps) * (weighted.leftCols(steps).adjoint() * next);
    next_weighted = mass * next;
    length = std::sqrt(std::max(next.dot(next_weighted).real(), 0.0));
    off[steps - 1] = length;
    if (steps < count) continue;
    // Eigen drops an off-diagonal entry below epsilon times the square root of its neighbours on the diagonal: in s2 that
    // would leave residuals that grow with the frequency, 1e-8 at 5 MHz.
    const double unit = diagonal.head(steps).maxCoeff();
    const SymmetricEigen small = tridiagonal_eigen(diagonal.head(steps) / unit, off.head(steps - 1) / unit);
    ritz = small.vectors.rightCols(count).rowwise().reverse();  // largest 1 / omega^2 first
    const Eigen::VectorXd value = small.values.tail(count).reverse() * unit;
    converged =
        (length * ritz.row(steps - 1).transpose().cwiseAbs().array() <= kConverged * value.array()).all();
  }

  ComplexModes modes{Eigen::VectorXd(count), basis.leftCols(steps) * ritz, 0};
  for (int k = 0; k < count; ++k) {
    auto u = modes.shape.col(k);
    Eigen::VectorXcd mu = mass * u;
    const double norm = std::sqrt(u.dot(mu).real());
    u /= norm;
    mu /= norm;
    // Seen through K^-1, because K itself magnifies the round-off of u by (highest / this frequency)^2.
    const Eigen::VectorXcd back = factor.solve(mu).col(0);
    modes.omega_squared[k] = 1 / mu.dot(back).real();
    const Eigen::VectorXcd rest = u - modes.omega_squared[k] * back;
    const double residual = std::sqrt(std::max(rest.dot(mass * rest).real(), 0.0));
    if (!(residual <= 1e-8))
      fail(Failure::numerical, what, ": mode ", k + 1, " at ",
           std::sqrt(modes.omega_squared[k]) / (2 * std::numbers::pi), " Hz has a relative residual of ",
           residual, ", at most 1e-8 is allowed; raise element_mm");
    modes.residual = std::max(modes.residual, residual);
  }
  return modes;
}

namespace {

SymmetricEigen eigen_of(const Eigen::MatrixXd& a) {
  return symmetric_eigen(a);
}
HermitianEigen eigen_of(const Eigen::MatrixXcd& a) {
  return hermitian_eigen(a);
}

template <class Matrix>
ComplexModes all_modes_of(const Matrix& stiffness, const Matrix& mass, const std::string& what) {
  const Eigen::LLT<Matrix> factor(stiffness);
  if (factor.info() != Eigen::Success) fail(Failure::numerical, what, " is not positive definite");
  // C = L^-1 M L^-H, C y = y / omega^2, u = omega L^-H y
  Matrix half = factor.matrixL().solve(mass);
  const Matrix c = factor.matrixL().solve(half.adjoint().eval());
  const auto eigen = eigen_of(c);
  const Eigen::Index n = c.rows();
  if (!eigen.converged || !(eigen.values[0] > 0))
    fail(Failure::numerical, what, ": of ", n, " modes the least 1 / omega^2 is ", eigen.values[0],
         " s2, not above 0; the mesh's mass is wrong, rebuild it");
  ComplexModes modes;
  modes.omega_squared = eigen.values.reverse().cwiseInverse();
  half = factor.matrixU().solve(eigen.vectors);
  modes.shape = half.rowwise().reverse().template cast<std::complex<double>>() *
                modes.omega_squared.cwiseSqrt().asDiagonal();
  return modes;
}

}  // namespace

ComplexModes all_modes(const SparseComplex& stiffness, const SparseComplex& mass, bool real,
                       const std::string& what) {
  const Eigen::MatrixXcd k = stiffness, m = mass;
  return real ? all_modes_of<Eigen::MatrixXd>(k.real(), m.real(), what)
              : all_modes_of<Eigen::MatrixXcd>(k, m, what);
}

}  // namespace whine
