// Lowest eigenpairs of K u = omega^2 M u for complex Hermitian positive definite K and M, by shift-invert at
// zero.
//
// Lanczos iteration on K^-1 M in the inner product of M, complex, with full reorthogonalisation (Parlett, The
// Symmetric Eigenvalue Problem, chapter 13). Complex arithmetic keeps each eigenvalue of a harmonic simple;
// libraries for real symmetric matrices see it twice and spend most of their steps on the copies. An
// eigenvalue that is truly multiple within one harmonic would be found once.
#pragma once
#include <string>

#include "solid/factor.h"

namespace whine {

struct ComplexModes {
  Eigen::VectorXd omega_squared;  // (mode) s-2, ascending
  Eigen::MatrixXcd shape;         // (unknown, mode) kg^-1/2: u^H M u = 1
  double residual = 0;            // 1: largest ||u - omega^2 K^-1 M u|| in the norm of M
};

// factor: of K. `what` names the problem in messages. Throws Error(input) if there are not so many modes and
// Error(numerical) if they do not converge or a residual is above 1e-8.
ComplexModes lowest_modes(const SparseComplex& stiffness, const SparseComplex& mass,
                          const HermitianFactor& factor, int count, const std::string& what);

// Every mode, by a dense eigensolution of the size of the matrices: in memory a few times 16 bytes times size^2, in time
// some size^3. real: both matrices are real. Eigenvalues of K^-1 M, so that the sum of u u^H / omega^2 is K^-1 to round-off.
// Throws Error(numerical) if K or M is not positive definite.
ComplexModes all_modes(const SparseComplex& stiffness, const SparseComplex& mass, bool real,
                       const std::string& what);

}  // namespace whine
