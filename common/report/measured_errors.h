// Discretisation errors beside the numbers of a report: of the statics from an error budget, of motions from sweep_errors.h5.
#pragma once
#include <string>

#include "report/report_content.h"

namespace whine {

inline constexpr double kNoError = -1;  // of an error that is not known
inline constexpr int kToldDigits = 5;   // most significant digits of a number with its error

// Of the statics at the torque of the budget; nullptr: at another one, or none is given.
const ErrorBudgetResult* budget_of(const ReportContent& c, double torque);
// Of the sweep at a torque in a direction; nullptr: not measured.
const SweepErrorsResult* errors_of(const ReportContent& c, double torque, Direction direction);

// 1: sum of the errors that the changes of a budget stand for; kNoError without budget, or if they are not known.
double sum_of(const ErrorBudgetResult* budget, const Eigen::VectorXd StaticChanges::*change);
// m: of harmonic n, from 1, of the transmission error, whose first is `first` (m).
double harmonic_error(const ErrorBudgetResult* budget, Eigen::Index n, double first);

// 1, relative: the larger of those at the two judged speeds beside a mesh frequency (Hz). kNoError where they are not
// known: outside of the judged speeds, or where a refined sweep is on another branch at either of the two.
double error_near(const SweepErrorsResult* errors, SweepErrorsResult::Judged SweepErrorsResult::*quantity,
                  double mesh_frequency, size_t mesh = 0);
// Hz: of the jump at this mesh frequency (Hz); kNoError where no such jump was judged, or a refined sweep does not jump there.
double jump_error_at(const SweepErrorsResult* errors, double jump_frequency);

// What ± means on a page, what was measured, and what measures the rest.
std::string words_on_errors(const ReportContent& c);

}  // namespace whine
