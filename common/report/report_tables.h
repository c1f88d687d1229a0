// The tables of a report as HTML; "" where there is nothing to say.
#pragma once
#include <string>

#include "io/scene_keys.h"
#include "report/report_content.h"

namespace whine {

// Of each [[mesh]] at rest: where its compliance comes from, stiffness beside ISO 6336, and what classes of ISO 1328-1 may add to the
// peak-to-peak transmission error; of gears outside of its formulas why not.
std::string rest_tables(const ReportContent& c);
// Which model level over the face the first torque has, K_Hbeta with its error, and what the next level changes; "" of one slice.
std::string face_level(const ReportContent& c);
std::string natural_frequencies_table(const ReportContent& c);  // by ring-down
std::string modes_table(const ReportContent& c);
std::string budget_table(const ErrorBudgetResult& b);
// Keys of the scene of content with statics. As a table, values of gears side by side, of what is no gear's in the first column; torques and speeds.
SceneKeys scene_keys_in(const ReportContent& c);
std::string parameters_table(const ReportContent& c);

}  // namespace whine
