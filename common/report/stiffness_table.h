// The tables of a report that say where the mesh's compliance comes from, and how it stands to ISO 6336.
#pragma once
#include <string>
#include <vector>

#include "results/static.h"

namespace whine {

struct WordTable {
  std::string caption;
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

WordTable compliance_table(const StaticResult& statics);
WordTable iso_table(const StaticResult& statics);

}  // namespace whine
