// The report of a scene: what its artifacts and figures say, as one HTML page that needs nothing beside it, neither network nor
// script, and the same numbers as a table. The page is made of what is there: sections without content are left out.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/provenance.h"
#include "motion/error_budget_result.h"
#include "motion/impact_result.h"
#include "motion/statics.h"
#include "signal/response_result.h"

namespace whine {

// A figure as gear-plot draws it; its name says what it shows.
struct ReportPicture {
  std::string name;   // file name without extension: "fig12"
  std::string bytes;  // of a PNG
};

// One sweep, without its motions.
struct ReportSweep {
  ResponseArtifact response;
  std::vector<Remark> remarks;
  Eigen::VectorXd backlash_left = {};  // (speed) m, of backlash_left(); none: not known
};

struct ReportSource {
  std::string path, sha256;
  Origin origin;
};

// Artifacts in the order in which the scene lists its torques.
struct ReportContent {
  std::string scene;  // "file: title"
  std::vector<StaticArtifact> statics;
  std::vector<ImpactArtifact> impacts;
  std::vector<ReportSweep> sweeps;
  std::optional<ErrorBudgetArtifact> budget;
  std::vector<ReportPicture> pictures;
  std::vector<ReportSource> sources;
};

// Names of the figures that a report knows how to explain, in its order.
std::vector<std::string> report_figures();

// Throws Error(input) for content without statics, of two pairs, or with a figure that is not known or given twice.
std::string report_html(const ReportContent& content);

// Columns torque [N m], quantity, value, unit, remark: geometry of the pair, which has no torque, then the numbers of the page's
// first table. A '#' line with the scene before the line of names.
std::string report_tsv(const ReportContent& content);

// Speeds (rows) at which the RMS of a response has a peak: higher than its surroundings by a fifth, ascending in frequency;
// the ends of the sweep are none.
std::vector<Eigen::Index> resonances(const ResponseArtifact& response);

}  // namespace whine
