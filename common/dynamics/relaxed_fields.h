// The fields of loads on a flank through which what the kept modes leave of its flexibility relaxes.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <vector>

#include "base/dense.h"
#include "base/error.h"

namespace whine {

// (flank, field) orthonormal, `most` of them: the loads of a flank that its own displacements, and before all those of other flanks, depend
// on most, those that others depend on first, `shared` of them. own, others: m N-1 (flank, flank), of both directions between two flanks.
// Throws Error(numerical), with the name of the gear, if they are not found or leave more than 1e-3 of `own` instantaneous.
inline Eigen::MatrixXd relaxed_fields(const Eigen::MatrixXd& own, const std::vector<Eigen::MatrixXd>& others,
                                      int most, int shared, const std::string& gear) {
  // What a tooth and all others within the body's offsets do to each other has rank 7 to 9 to 1e-8 of the tooth's own
  // flexibility (16 to 50 teeth, undamped depths up to 1 m). The weight takes it whole; the fields left over go to
  // the tooth itself.
  constexpr double kOthersWeight = 1e6;
  // What no field holds is instantaneous. With 12 fields it is 5e-5 of the whole for 50 teeth, 1e-4 for 16; a body that
  // leaves ten times that is no tooth that fields were chosen for. Between teeth 8 shared fields leave 6e-7.
  constexpr double kMostRemainder = 1e-3;
  Eigen::MatrixXd importance = own * own;
  for (const Eigen::MatrixXd& other : others) importance += kOthersWeight * other * other.transpose();
  const SymmetricEigen eigen = symmetric_eigen(importance);
  if (!eigen.converged)
    fail(Failure::numerical, "the residual fields of ", gear, " were not found: its ", own.rows(),
         " flank points have a flexibility of norm ", own.norm(), " m/N; rebuild body.h5");
  const Eigen::MatrixXd fields =
      eigen.vectors.rightCols(std::min<Eigen::Index>(most, own.rows())).rowwise().reverse();
  const auto rest = [&](const Eigen::MatrixXd& r, Eigen::Index count) {
    const auto fixed = fields.leftCols(std::min(count, fields.cols()));
    return (r - fixed * (fixed.transpose() * r * fixed) * fixed.transpose()).norm();
  };
  double worst = rest(own, most);
  for (const Eigen::MatrixXd& other : others) worst = std::max(worst, rest(other, shared));
  if (!(worst <= kMostRemainder * own.norm()))
    fail(Failure::numerical, "the ", fields.cols(), " residual fields of ", gear, " leave ",
         worst / own.norm(), " of a tooth's residual flexibility instantaneous, above ", kMostRemainder,
         "; raise modes in [fidelity] or lower element_mm in [discretisation] of the scene");
  return fields;
}

}  // namespace whine
