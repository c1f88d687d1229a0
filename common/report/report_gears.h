// What a report says of the gears as they are drawn, of the bodies and of their meshes.
#pragma once
#include <string>
#include <vector>

#include "report/report_content.h"

namespace whine {

struct GeometryNumber {
  std::string part, quantity, unit, value;
};

// What the tables of drawings and of meshes hold, for the table of results: of each gear, and of each [[mesh]], "" of a pair, with those of
// either of its gears, "..., <name> (driver)". Of elastic gears.
std::vector<GeometryNumber> geometry_numbers(const ReportContent& c);

// What holds or drives the rotation of a body: "driver", "held", "loaded". Natural modes do not know of torques, the statics do.
std::string held_words(const ReportContent& c, size_t body);

// Tables as HTML: bodies with places, senses, speeds, inertias and bearings; of elastic gears their drawings; their meshes.
std::string bodies_table(const ReportContent& c);
std::string drawings_table(const ReportContent& c);
std::string meshes_table(const ReportContent& c);

}  // namespace whine
