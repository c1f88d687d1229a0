#include <algorithm>
#include <array>
#include <tuple>

#include "base/error.h"
#include "report/alike_meshes.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/report_results.h"
#include "report/result_groups.h"

namespace whine {
namespace {

using Eigen::Index;
using namespace groups;

// A row of a table: its numbers by torque and direction.
struct ResultRow {
  std::string group, label, unit;
  bool speeds = false;                                      // with a line in rpm
  std::array<bool, 2> way{};                                // rising, falling
  std::vector<std::array<const ReportNumber*, 3>> numbers;  // [column] of neither, rising, falling
};

size_t way_of(const ReportNumber& n) {
  return n.way.empty() ? 0 : n.way.ends_with("rising") ? 1 : 2;
}

std::vector<ResultRow> rows_of(const std::vector<const ReportNumber*>& results, size_t columns) {
  std::vector<ResultRow> rows;
  for (const ReportNumber* number : results) {
    const ReportNumber& n = *number;
    std::string label = n.quantity.substr(0, n.quantity.size() - n.way.size());
    if (n.of == ReportNumber::Of::whole && !n.part.empty()) label += ", " + n.part;
    auto row = std::find_if(rows.begin(), rows.end(),
                            [&](const ResultRow& r) { return r.label == label && r.group == n.group; });
    if (row == rows.end()) {
      rows.push_back({n.group, label, n.unit, false, {}, {}});
      rows.back().numbers.resize(columns);
      row = rows.end() - 1;
    }
    row->speeds = row->speeds || !n.rpm.empty();
    if (const size_t way = way_of(n); way > 0) row->way[way - 1] = true;
    row->numbers[n.column][way_of(n)] = &n;
  }
  return rows;
}

// Both directions of a sweep in one cell, "2640 / 2580"; in rpm, too, in a line of its own.
std::string cell_of(const std::array<const ReportNumber*, 3>& numbers) {
  std::string words, rpm;
  const auto add = [](std::string& line, const std::string& word) {
    if (!word.empty() && line != word) line += (line.empty() ? "" : " / ") + word;
  };
  for (const ReportNumber* n : numbers) {
    if (!n) continue;
    const std::string star = n->remark.empty() ? "" : n->remark == kBeyond ? " *" : " (" + n->remark + ")";
    add(words, n->value + (n->error.empty() ? "" : " ± " + n->error) + star);
    if (!n->rpm.empty()) add(rpm, n->rpm + star);
  }
  return words + (rpm.empty() || rpm == words ? "" : "\n" + rpm);
}

std::string way_words(const ResultRow& row) {
  return row.way[0] && row.way[1] ? ", rising / falling"
         : row.way[0]             ? ", speed rising"
         : row.way[1]             ? ", speed falling"
                                  : "";
}

// Of one kind, under their headings; `of`: ", each mesh" behind these.
std::string tables_of(const std::vector<const ReportNumber*>& results,
                      const std::vector<std::string>& columns, const std::string& of) {
  const std::vector<ResultRow> rows = rows_of(results, columns.size());
  std::vector<std::string> head{"", "unit"};
  head.insert(head.end(), columns.begin(), columns.end());
  std::string out;
  for (const char* group : kGroups) {
    html::Rows cells;
    for (const ResultRow& row : rows) {
      if (row.group != group) continue;
      cells.push_back({row.label + way_words(row),
                       text(row.unit == "1" ? html::kNoValue : row.unit, row.speeds ? "\nrpm" : "")});
      for (const auto& numbers : row.numbers) cells.back().push_back(cell_of(numbers));
    }
    if (!cells.empty())
      out += html::tagged("h3", group + of) + "\n" + html::table("", head, cells, "results");
  }
  return out;
}

}  // namespace

std::string results_tables(const ReportContent& c) {
  if (c.statics.empty()) return "";
  const SystemStaticResult& first = c.statics[0];
  const std::vector<ReportNumber> numbers = report_numbers(c);
  const bool several = first.mesh.size() > 1;
  const std::string driver = driver_of(c).name;
  std::string out = html::paragraph(text(
      "By torque on ", driver,
      c.sweeps.empty() ? "" : "; speeds as mesh frequency and, below, as rotation of ",
      c.sweeps.empty() ? "" : driver, "; results.tsv holds the same numbers.",
      first.hunting_periods > 1 ? text(" At rest: over the ", first.hunting_periods,
                                       " mesh periods after which the same teeth meet.")
                                : "",
      load_sharing(first).empty() ? "" : " Share: at one instant, of the load of the meshes of one [[mesh]].",
      first.of_train()
          ? " A torque is positive where it acts in the sense in which its body rotates (The gears)."
          : "",
      " Forces on bearings: on a rigid axis the sum of the contact forces; what oscillates acts on the housing."));
  using Of = ReportNumber::Of;
  for (const auto& [of, names, heading] : {std::tuple{Of::whole, std::vector<std::string>{""}, ""},
                                           std::tuple{Of::mesh, first.mesh_names, ", each mesh"},
                                           std::tuple{Of::body, first.body_names, ", each body"}}) {
    if (of == Of::mesh && !several) continue;
    std::vector<std::string> columns;
    for (const SystemStaticResult& rest : c.statics)
      for (const std::string& name : names)
        columns.push_back(text(name, name.empty() || c.statics.size() == 1 ? "" : ", ",
                               name.empty() || c.statics.size() > 1 ? torque_words(torque_of(rest)) : ""));
    std::vector<const ReportNumber*> own;
    for (const ReportNumber& n : numbers)
      if (n.of == of || (n.of == Of::mesh && of == Of::whole && !several)) own.push_back(&n);
    out += tables_of(own, columns, several || of == Of::body ? heading : "");
  }
  if (std::any_of(numbers.begin(), numbers.end(), [](const ReportNumber& n) { return n.remark == kBeyond; }))
    out += html::paragraph(
        "* At this speed the motion is larger than the backlash: back flanks would touch, which is not modelled, so the number is not to be trusted.");
  return out;
}

std::string motion_words(const ReportContent& c) {
  const ResponseResult* of = nullptr;
  double most = 0, loss = 0;
  Index at = 0, mesh = 0;
  for (const ResponseResult& a : c.sweeps) {
    loss = std::max(loss, a.separation_fraction.maxCoeff());
    Index row = 0, column = 0;
    if (const double rms = a.dte_rms.maxCoeff(&row, &column); rms > most)
      std::tie(most, at, mesh, of) = std::tuple{rms, row, column, &a};
  }
  if (!of) return "";
  return text("The largest vibration is an RMS of ", significant(most * kMicro, 3), " µm",
              of->meshes() > 1 ? " of " + of->mesh_names[static_cast<size_t>(mesh)] : "", " at ",
              shown(of->mesh_frequency[at], 6), " Hz, ", way_words(*of), "; ",
              loss > 0
                  ? text("teeth are without contact for up to ", fixed(loss * kPercent, 1), " % of the time.")
                  : "no mesh loses contact.");
}

}  // namespace whine
