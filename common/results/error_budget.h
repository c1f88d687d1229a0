// What refining, and what choosing another model, changes in the static answer.
#pragma once
#include <Eigen/Core>
#include <string>

#include "base/matrix.h"
#include "model/stages.h"

namespace whine {

// The order p of an error c h^p, from the changes of r h to h and of h to h / r, r the ratio of refinement. 0 where none shows: outside
// 0.5 to 6, or where the finer change is 0.
double order_of(double coarser_change, double finer_change, double ratio = 2);

// The error of h that a change from h to h / r stands for, |change| / (1 - r^-p); order 0: |change|.
double error_of(double change, double order, double ratio = 2);

// What changing one thing alone changes in the static answer.
struct StaticChanges {
  std::string entry;                      // names of the entries, separated by ", "
  Eigen::VectorXd mean_stiffness_change;  // (entry) 1, relative
  Eigen::VectorXd peak_to_peak_change;    // (entry) 1, relative, of the transmission error
  // (entry) 1, relative, of the largest pressure inside a flank; empty: not known, or no contact stays inside
  Eigen::VectorXd pressure_change;
  // (entry, harmonic 1..) 1, of the transmission error, over its first harmonic; five, or what the positions resolve
  MatrixRM harmonic_change;
  // (entry) 1, relative, of the largest root stress of both gears of a mesh: the change that is larger; empty: not known
  Eigen::VectorXd root_stress_change = {};
  // (entry) 1, relative, of K_Hbeta of the reference pair at mesh phase 0; empty: of one slice over the face
  Eigen::VectorXd load_factor_change = {};
  // (entry) 1, with which its errors of stiffness and transmission error fall; 0: none shows; empty: no errors
  Eigen::VectorXd order = {};

  // 1: sum of the errors that the changes stand for; of harmonic n over the first.
  double error(const Eigen::VectorXd StaticChanges::*change) const;
  double harmonic_error(Eigen::Index n) const;
};

// Largest root stress at rest, read from meshes with elements of several sizes on the roots; from coarse, those of the result, to fine.
struct RootRefinement {
  Eigen::VectorXd element_size;  // (level) m, on the root of the first gear; empty: not known
  MatrixRM stress;               // (level, gear) Pa: the largest of all meshes of a gear
};

// Of the stress: smaller changes go with where the elements lie, and have no order worth a word.
inline constexpr double kOrderlessChange = 2e-4;

// What refining changes, as the error of its elements would: c h^p leaves change(k) / change(k + 1) = (h_k / h_(k+1))^p.
struct RootConvergence {
  MatrixRM change;  // (level - 1, gear) 1: of the stress, from one level to the next, over that of the last
  MatrixRM order;   // (level - 2, gear) 1: p; NaN where a change is 0
};
// Both without rows for fewer than two levels.
RootConvergence convergence(const RootRefinement& root);
// 1: order(k, gear) where both changes that it is of exceed kOrderlessChange; else NaN: such changes go with where the elements lie.
double resolved_order(const RootConvergence& root, Eigen::Index k, Eigen::Index gear);

// error_budget.h5; of a train the parameters are those of its first mesh, changes the largest of all meshes.
struct ErrorBudgetResult : GearPairParameters {
  double torque = 0;                    // N m on the driver, of a train that of torque_of()
  std::vector<std::string> gear_names;  // [gear]
  StaticChanges refinement;             // discretisations: their changes are errors and add up
  StaticChanges choice;  // models that could be chosen instead: for information, no errors and in no sum
  std::string choice_missing;  // which of them could not be computed, and why; "" if all were
  RootRefinement root;         // elements on the roots once, half, a quarter and an eighth as large
};

}  // namespace whine
