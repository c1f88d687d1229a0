#pragma once
#include "report/figures.h"
#include "results/error_budget.h"

namespace whine {

// Changes of the static answer by each refinement, as bars, in per cent; apart from them those by another choice of near field or
// contact.
Figure error_budget_figure(const ErrorBudgetResult& budget);

}  // namespace whine
