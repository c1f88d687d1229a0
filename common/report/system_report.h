// The report of a system of several meshes as one HTML page: its picture, gears, meshes, bodies, load sharing, natural modes, motion.
//
// Elastic gears have statics, natural modes and, of scenes with speeds, sweeps; rigid ones natural modes alone; what is not there
// is left out. A figure of another stage is a row in the list of system_report_figures().
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/report_content.h"
#include "results/modes.h"
#include "results/response.h"
#include "results/static.h"

namespace whine {

struct SystemReport {
  std::string scene;  // "file: title"
  std::optional<SystemStaticResult> rest;
  std::optional<ModesResult> modes;
  std::vector<ResponseResult> sweeps = {};  // rising, falling, or none
  std::vector<ReportPicture> pictures;
  std::vector<ReportSource> sources;
};

// Throws Error(input) for content without modes, of two systems, of other torques, or with a figure that is not known or given twice.
std::string system_report_html(const SystemReport& report);

// Throws as system_report_html().
void require_whole_system(const SystemReport& report);

// Columns part (a mesh, a body, a mode), quantity, value, unit, remark. A '#' line with the scene before the line of names.
std::string system_report_tsv(const SystemReport& report);

// Names of the figures that the page has words for.
std::vector<std::string> system_report_figures();

// Of what the report holds.
const System& layout_of(const SystemReport& report);
bool has_planets(const System& system);  // on a carrier

}  // namespace whine
