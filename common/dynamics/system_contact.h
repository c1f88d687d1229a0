// Contact of many pairs of teeth at one position, followed from the forces that they carried there last.
//
// The problem of contact/line_contact.h: F >= 0, d = C F + law(F) + e >= 0, F . d = 0. Newton's step from there holds for every e, so a
// visit whose forces are near those of the last one needs neither a law nor a factorisation. Further steps keep the inverse
// T^-1 of `at` and take the change D of the laws' slopes in to the first order, T^-1 - T^-1 D T^-1; what this leaves of d is
// D T^-1 D T^-1 r, the laws' curvature leaves at most C change^2 / (2 F) (hertz_line.h). A solution is accepted where both are below
// the round-off of each pair's terms. Pairs that come or go change the set, at most four times; what is not solved then is left to
// solve_line_contact(). The solution is unique, so the start decides on round-off alone. With friction C is not symmetric: the tangent
// is inverted as it is, and what is left to solve_line_contact() goes by solve_with_friction().
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "contact/complementarity.h"
#include "contact/hertz_line.h"
#include "contact/lanes.h"

namespace whine {

class FollowedContact {
 public:
  static constexpr int kMost = 64;  // pairs that carry; more are left to solve_line_contact()

  // Memory for so many pairs in reach, of which any may carry.
  void reserve(int pairs);
  // The compliance has changed; the forces stay as a guess.
  void forget() { linear_ = false; }
  // Nothing is known, not even forces.
  void restart() { count_ = -1; }

  // c: (pair in whole lanes, pair) m N-1, zero below the pairs; e, d: (pair in whole lanes) m; force: (pair) N, a guess where nothing
  // is known, and the result. friction: (pair, pair) what of c is of friction, empty without. Throws as solve_line_contact() and
  // solve_with_friction().
  Certificate solve(const Eigen::MatrixXd& c, std::span<const HertzLine> law, const Eigen::VectorXd& e,
                    Eigen::Ref<Eigen::VectorXd> force, Eigen::VectorXd& d,
                    const Eigen::MatrixXd& friction = {});

 private:
  struct Work;
  void take(const Eigen::Ref<const Eigen::VectorXd>& force);
  bool linearise(const Eigen::MatrixXd& c, std::span<const HertzLine> law);
  bool invert();
  void start_from(const Work& work);
  bool approach(const Eigen::MatrixXd& c, std::span<const HertzLine> law, const Eigen::VectorXd& e,
                Work& work);
  bool look_at_others(const Eigen::MatrixXd& c, std::span<const HertzLine> law, const Eigen::VectorXd& e,
                      Work& work, Certificate& certificate);
  int stride() const { return padded(count_); }

  struct Tangent {
    double at = 0;           // N
    double d = 0, size = 0;  // m, without e: d, sum of the sizes of its terms
    double slope = 0;        // m N-1: of the law
    double bend = 0;         // m N-1: half the law's coefficient
  };
  int count_ = -1;               // pairs that carry; -1: not known
  bool linear_ = false;          // what follows but `at` is of the forces `at`
  int bent_ = 0;                 // visits since then that took a law
  int carrying_[kMost] = {};     // which of all, ascending
  Tangent of_[kMost];            // (carrying)
  std::vector<double> inverse_;  // (carrying in whole lanes, carrying) N m-1: of C + slopes
};

}  // namespace whine
