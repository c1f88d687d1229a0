// Contact of a few tooth pairs, one unknown force each: find F >= 0 with d = C F + law(F) + e >= 0 and F . d = 0.
//
// C is symmetric and positive semidefinite and the law of each pair rises, so the problem has one solution: the least
// value of the strictly convex energy 1/2 F C F + sum of the laws' energies + e . F over F >= 0. Newton's method on
// the pairs that carry force, cut where a force would fall below zero and by Armijo's rule where the energy would not
// fall; a pair comes in only at the least energy of the others, so that no set of pairs comes back (as in Lawson and
// Hanson, Solving Least Squares Problems, 1974, chapter 23). Up to three pairs that carry at the start are first followed
// by themselves by plain Newton steps, each of n laws and an n x n inverse: enough while no pair comes or goes, and
// the last step needs no look back, for the slope of a law changes by less than C / F. Up to kMostContacts take no memory.
#pragma once
#include <Eigen/Core>
#include <span>

#include "contact/complementarity.h"
#include "contact/hertz_line.h"

namespace whine {

inline constexpr int kMostPairs = 8;      // of one mesh in motion; at rest there may be more
inline constexpr int kMostContacts = 64;  // of all meshes of a system in motion: more take memory
using PairVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostPairs, 1>;
using PairMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostPairs, kMostPairs>;

// Newton's step from the forces `at`, before e is known. It holds for every e of the same C and laws, so a solution whose
// forces are near these needs no law. Arrays: (pair that carries), the first `count` of them.
struct LineStart {
  // From force: (pair) N.
  void look(const Eigen::Ref<const Eigen::MatrixXd>& c, std::span<const HertzLine> law,
            const Eigen::Ref<const Eigen::VectorXd>& force);
  void forget() { count = -1; }
  bool known() const { return count >= 0; }

  static constexpr int kMost = 3;
  int count = -1;            // -1: not looked at, too many pairs, or no tangent that is positive definite
  int carrying[kMost] = {};  // which of all pairs
  double at[kMost] = {};     // N
  double d[kMost] = {};      // m, without e
  double size[kMost] = {};   // m: sum of the sizes of its terms
  double bend[kMost] = {};   // m N-1: half the laws' coefficients
  double inverse[kMost][kMost] = {};  // N m-1: of C + slopes
};

// c: (pair, pair) m N-1; law: (pair); e: (pair) m; force: (pair) N, start and result; d: (pair) m, result. Values of
// force that are not above 0 are no start. Beyond HertzLine::largest_force the law is a straight line, and whoever
// uses the result asks require_hertz_range. Certificate as ComplementaritySolver's: gap tolerance the round-off of
// each pair's own terms; forces are never negative; `factorisations` counts Newton steps; where the start is followed, d
// of a pair with force is 0 and the residual is the bound of the last step's error, below that tolerance. Throws
// Error(numerical) for a number that is not finite, a C that is not semidefinite where it
// is tried, an energy that does not fall within 30 halvings of a step, no convergence within 200 steps and 8 for each pair, or by
// require_residual.
Certificate solve_line_contact(const Eigen::Ref<const Eigen::MatrixXd>& c, std::span<const HertzLine> law,
                               const Eigen::Ref<const Eigen::VectorXd>& e, Eigen::Ref<Eigen::VectorXd> force,
                               Eigen::Ref<Eigen::VectorXd> d);

// The same from a start that is known, for the same C and laws; it is moved along, or forgotten where it was not followed.
Certificate solve_line_contact(const Eigen::Ref<const Eigen::MatrixXd>& c, std::span<const HertzLine> law,
                               const Eigen::Ref<const Eigen::VectorXd>& e, LineStart& start,
                               Eigen::Ref<Eigen::VectorXd> force, Eigen::Ref<Eigen::VectorXd> d);

// d (approach . F) / d x for e = gap - x approach at a solution: approach^T (C + slopes)^-1 approach over the pairs with
// force. N m-1 if approach is 1; 0 without force.
double line_contact_stiffness(const Eigen::Ref<const Eigen::MatrixXd>& c, std::span<const HertzLine> law,
                              const Eigen::Ref<const Eigen::VectorXd>& approach,
                              const Eigen::Ref<const Eigen::VectorXd>& force);

// Throws Error(numerical) if a force is above the largest for which the law holds.
void require_hertz_range(std::span<const HertzLine> law, const Eigen::Ref<const Eigen::VectorXd>& force);

}  // namespace whine
