#include "report/measured_errors.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "report/figures.h"

namespace whine {

using Eigen::Index;

const ErrorBudgetResult* budget_of(const ReportContent& c, double torque) {
  return c.budget && one_torque(c.budget->torque, torque) ? &*c.budget : nullptr;
}

const SweepErrorsResult* errors_of(const ReportContent& c, double torque, Direction direction) {
  for (const SweepErrorsResult& errors : c.errors)
    if (one_torque(torque_of(errors), torque) && errors.direction == direction) return &errors;
  return nullptr;
}

double sum_of(const ErrorBudgetResult* budget, const Eigen::VectorXd StaticChanges::*change) {
  if (!budget || (budget->refinement.*change).size() == 0) return kNoError;
  return budget->refinement.error(change);
}

double harmonic_error(const ErrorBudgetResult* budget, Index n, double first) {
  if (!budget || n > budget->refinement.harmonic_change.cols()) return kNoError;
  return budget->refinement.harmonic_error(n) * first;
}

double error_near(const SweepErrorsResult* errors, SweepErrorsResult::Judged SweepErrorsResult::*quantity,
                  double mesh_frequency, size_t mesh) {
  if (!errors) return kNoError;
  const Eigen::VectorXd& f = errors->mesh_frequency;
  Index below = -1, above = -1;
  for (Index i = 0; i < f.size(); ++i) {
    if (f[i] <= mesh_frequency && (below < 0 || f[i] > f[below])) below = i;
    if (f[i] >= mesh_frequency && (above < 0 || f[i] < f[above])) above = i;
  }
  if (below < 0 || above < 0) return kNoError;
  double most = 0;
  for (const Index i : {below, above}) {
    if (errors->compared.col(i).minCoeff() == 0) return kNoError;
    most = std::max(most, (errors->*quantity).error(i, static_cast<Index>(mesh)));
  }
  return most;
}

double jump_error_at(const SweepErrorsResult* errors, double jump_frequency) {
  constexpr double kSame = 1e-3;  // of the speed: both sweeps enclose a jump far more closely
  if (!errors) return kNoError;
  for (Index j = 0; j < errors->jump_frequency.size(); ++j)
    if (std::abs(errors->jump_frequency[j] - jump_frequency) < kSame * jump_frequency)
      return errors->jump_found.col(j).minCoeff() > 0 ? errors->jump_error[j] : kNoError;
  return kNoError;
}

std::string words_on_errors(const ReportContent& c) {
  if (!c.budget && c.errors.empty()) return "";
  std::string out =
      "Behind ± stands the discretisation error: each discretisation is refined alone, its error follows from the change and the order with which errors fall, and the errors are added up. Where no order shows, the change itself counts. ";
  if (c.budget)
    out += text("Numbers at rest have it at ", torque_words(c.budget->torque),
                c.of_train() ? ", the largest of all meshes. " : ". ");
  if (!c.errors.empty())
    return out + text("Numbers in motion have it at ", torque_words(torque_of(c.errors[0])), ", measured at ",
                      c.errors[0].mesh_frequency.size(),
                      " speeds; there is none where a refined sweep is on another branch.");
  return c.sweeps.empty()
             ? out
             : out +
                   "Errors of the motion are not measured: `make motion-errors` measures them at "
                   "the first torque, and `make ERRORS=yes report` states them here; it takes "
                   "about as long as ten sweeps.";
}

}  // namespace whine
