#include "paper/table1.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "base/error.h"
#include "gear/pair.h"
#include "paper/claims.h"

namespace whine {
namespace {

double printed_frequency(const std::vector<PrintedClaim>& claims, double torque, const std::string& contact) {
  for (const PrintedClaim& claim : claims)
    if (claim.value == kNaturalFrequency && claim.torque == torque && claim.contact == contact)
      return claim.printed;
  fail(Failure::input, "table: no claim prints a natural frequency for ", torque_words(torque), ", contact '",
       contact, "'");
}

}  // namespace

Figure natural_frequency_table(std::vector<ImpactResult> impacts, const std::vector<PrintedClaim>& printed) {
  if (impacts.empty()) fail(Failure::input, "table: no impact.h5 given; 1 is the least");
  std::sort(impacts.begin(), impacts.end(), [](const auto& a, const auto& b) { return a.torque < b.torque; });

  Figure table;
  table.title = "Natural frequencies by ring-down";
  const ImpactResult& first = impacts[0];
  table.notes.push_back("Rayleigh damping η = " + shown(first.damping.rayleigh_stiffness * kMicro, 6) +
                        " µs; " + corner_words(first));
  const double ratio = GearPair(first).contact_ratio();
  const double share = ratio - std::floor(ratio);
  if (ratio >= 4) fail(Failure::input, "table: a contact ratio of ", ratio, "; below 4 is known");
  const auto few = static_cast<ContactState>(ratio), many = static_cast<ContactState>(ratio + 1);
  table.notes.push_back("phase mean: over the phases of a mesh period; contact ratio mean: " +
                        fixed(1 - share, 4) + " of it with " + name_of(few) + ", " + fixed(share, 4) +
                        " with " + name_of(many) + " pairs, as without load");
  FigureBlock block{"natural frequencies", {"torque [N m]"}, {}};
  for (size_t i = 0; i < impacts.size(); ++i) {
    const ImpactResult& a = impacts[i];
    if (i > 0 && a.torque == impacts[i - 1].torque)
      fail(Failure::input, "table: two impact.h5 of the same torque, ", torque_words(a.torque),
           "; give each once");
    const auto at = [&](ContactState state) {
      const auto row = a.states.row_of(state);
      if (!row)
        fail(Failure::input, "table: at ", torque_words(a.torque), " the impact.h5 holds no contact state '",
             state, "'; with this load no phase has it");
      return a.states.natural_frequency[*row];
    };
    const double low = at(few), high = at(many);
    std::vector<double> row{a.torque};
    for (const auto& [name, state, value] :
         {std::tuple{name_of(few) + (few == ContactState::one ? " pair" : " pairs"), name_of(few), low},
          {name_of(many) + " pairs", name_of(many), high},
          {std::string("phase mean"), std::string("mean"), at(ContactState::mean)},
          {std::string("contact ratio mean"), std::string("mean"), (1 - share) * low + share * high}}) {
      if (i == 0) block.columns.push_back(name + " [Hz]");
      row.push_back(value);
      if (printed.empty()) continue;
      const double frequency = printed_frequency(printed, a.torque, state);
      if (i == 0) {
        block.columns.push_back(name + ", published [Hz]");
        block.columns.push_back(name + ", deviation [%]");
      }
      row.push_back(frequency);
      row.push_back(100 * (value / frequency - 1));
    }
    block.rows.push_back(row);
  }
  table.blocks.push_back(block);
  return table;
}

std::string natural_frequency_text(const Figure& table) {
  const FigureBlock& block = table.blocks.at(0);
  const bool compared = block.columns.size() == 13;
  std::string out = table.title + "\n";
  for (const auto& note : table.notes) out += note + "\n";
  char line[200];
  std::snprintf(line, sizeof line, "\n%-20s %10s %10s", "contact", "torque N m", "Whine Hz");
  out += line;
  if (compared) {
    std::snprintf(line, sizeof line, " %12s %12s", "published Hz", "deviation %");
    out += line;
  }
  for (size_t c = 1; c < block.columns.size(); c += compared ? 3 : 1)
    for (const auto& row : block.rows) {
      const std::string name = block.columns[c].substr(0, block.columns[c].find(" ["));
      std::snprintf(line, sizeof line, "\n%-20s %10.6g %10.1f", name.c_str(), row[0], row[c]);
      out += line;
      if (!compared) continue;
      std::snprintf(line, sizeof line, " %12.0f %+12.2f", row[c + 1], row[c + 2]);
      out += line;
    }
  return out + "\n";
}

}  // namespace whine
