// Numbers, tables and remarks of the report of a system.
#pragma once
#include <string>
#include <vector>

#include "report/system_report.h"

namespace whine {

struct SystemNumber {
  std::string part, quantity, unit, value, remark;
};

// What results.tsv holds: of each mesh, each body, each mode and each sweep.
std::vector<SystemNumber> system_numbers(const SystemReport& r);

// Whether it is one of several meshes of a [[mesh]], which share its load.
bool shares_load(const SystemStaticResult& a, size_t m);

// Tables as HTML; "" where there is nothing to say. gear_tables: of elastic gears their drawings, of rigid ones what is known.
std::string gear_tables(const SystemReport& r);
std::string mesh_tables(const SystemReport& r);  // data of the meshes, and what they do at rest
std::string force_table(const SystemReport& r);  // torques, forces on bearings and pins
std::string modes_table(const SystemReport& r);
std::string settings_table(const SystemReport& r);
std::string system_remarks(const SystemReport& r);

}  // namespace whine
