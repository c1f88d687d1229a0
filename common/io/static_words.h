// What gear-static and gear-harris say of their results.
#pragma once
#include <string>
#include <vector>

#include "results/error_budget.h"
#include "results/harris_map.h"
#include "results/static.h"
#include "studies/error_budget.h"
#include "studies/width_levels.h"

namespace whine {

// The summary line: of one mesh its transmission error over the period, of several their means; and how many periods teeth that differ take.
std::vector<std::string> summary_words(const SystemStaticResult& statics);

// What so many strips change at the positions that `where` names; none without such positions.
std::vector<std::string> change_words(const std::string& where, const StaticDifference& change, int strips);

// Of each gear: what each halving of the elements on the root changes, and the order at last where the changes show one. None
// without three levels of elements.
std::vector<std::string> root_stress_words(const ErrorBudgetResult& errors);

// Of another level over the face.
std::string change_words(const WidthChange& change);
// In slices over the face, of a train the first mesh of each [[mesh]]: overlap, load over the face, axial force; else nothing.
std::vector<std::string> face_load_words(const SystemStaticResult& statics);

// The size of a map, its optima, and what a finer solution of some points differs by.
std::vector<std::string> harris_words(const HarrisMapResult& map);

}  // namespace whine
