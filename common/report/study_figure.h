// The figure of a study: its response quantities against the keys that vary.
#pragma once
#include "io/artifacts.h"
#include "io/study.h"
#include "io/study_result.h"
#include "report/figures.h"

namespace whine {

// A row of panels for each response quantity of the plan's figure, a column for each of its keys; the block [variants] is the
// table of all response quantities that were gathered. In a grid lines join the variants that differ in the panel's key alone;
// of a sample there are points, the rank correlation (Spearman) of response quantity and key, and the distribution with its
// 5th, 50th and 95th percentile. Variants outside the model's range are in the table, marked, and in no panel. Throws
// Error(input) if all lie outside the model's range.
Figure study_figure(const StudyResult& study);

// Spearman's rank correlation, ties at their mean rank; 0 if one of the two does not vary.
double rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace whine
