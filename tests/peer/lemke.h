// Lemke's method of Siconos (libsiconos-numerics-dev): a solver of the same problem by other people.
#pragma once
#include <siconos/numerics/LinearComplementarityProblem.h>
#include <siconos/numerics/NonSmoothDrivers.h>
#include <siconos/numerics/NumericsMatrix.h>
#include <siconos/numerics/SolverOptions.h>
#include <siconos/numerics/lcp_cst.h>

#include <Eigen/Core>
#include <stdexcept>
#include <string>

namespace whine {

class Lemke {
 public:
  Lemke() : options_(solver_options_create(SICONOS_LCP_LEMKE)) {
    options_->iparam[SICONOS_IPARAM_MAX_ITER] = 10000;
  }
  ~Lemke() { solver_options_delete(options_); }
  Lemke(const Lemke&) = delete;
  Lemke& operator=(const Lemke&) = delete;

  // As ComplementaritySolver: A (n, n), e (n) -> p, d (n). Its tolerances are absolute, so A and e are scaled to 1.
  // Throws std::runtime_error with the status if it gives up.
  void solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& e, Eigen::VectorXd& p, Eigen::VectorXd& d) {
    const double a_scale = a.diagonal().maxCoeff(), e_scale = e.cwiseAbs().maxCoeff();
    scaled_a_ = a / a_scale;
    scaled_e_ = e / e_scale;
    solve_scaled(scaled_a_, scaled_e_, p, d);
    p *= e_scale / a_scale;
    d *= e_scale;
  }

  // The same for a problem whose numbers are about 1. Does not change A and e.
  void solve_scaled(Eigen::MatrixXd& a, Eigen::VectorXd& e, Eigen::VectorXd& p, Eigen::VectorXd& d) {
    const int n = static_cast<int>(e.size());
    p.setZero(n);
    d.setZero(n);
    NumericsMatrix* matrix = NM_create_from_data(NM_DENSE, n, n, a.data());
    LinearComplementarityProblem problem{};
    problem.size = n;
    problem.M = matrix;
    problem.q = e.data();
    const int status = linearComplementarity_driver(&problem, p.data(), d.data(), options_);
    matrix->matrix0 = nullptr;  // it is a's
    NM_free(matrix);
    if (status != 0) throw std::runtime_error("Siconos' Lemke ends with status " + std::to_string(status));
  }

 private:
  SolverOptions* options_;
  Eigen::MatrixXd scaled_a_;
  Eigen::VectorXd scaled_e_;
};

}  // namespace whine
