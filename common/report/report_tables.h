// The tables of a report as HTML.
#pragma once
#include <vector>

#include "gear/pair.h"
#include "io/scene_keys.h"
#include "report/html.h"
#include "report/report_content.h"

namespace whine {

// Quantity, unit, and the value of each gear as it is drawn; of each mesh by its drawings.
html::Rows drawing_rows(const std::vector<ToothGeometry>& gears);
html::Rows mesh_rows(const std::vector<GearPair>& meshes);
std::string gears_table(const ReportContent& c);
std::string stiffness_tables(const ReportContent& c);
// What classes of ISO 1328-1 may add to the peak-to-peak transmission error; of gears outside of its formulas why not.
std::string class_table(const ReportContent& c);
// Which model level over the face the first torque has, K_Hbeta with its error, and what the next level changes; "" of one slice.
std::string face_level(const ReportContent& c);
std::string natural_frequencies_table(const ReportContent& c);
std::string budget_table(const ErrorBudgetResult& b);
// Values of gears side by side, of what is no gear's in the first column; then what stands in no artifact's keys; of sweeps their speeds.
html::Rows speed_rows(const std::vector<ResponseResult>& sweeps);
std::string scene_table(const std::string& caption, const SceneKeys& keys, const html::Rows& more);
std::string parameters_table(const ReportContent& c);

}  // namespace whine
