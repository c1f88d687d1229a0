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

Figure natural_frequency_table(std::vector<ImpactArtifact> impacts,
                               const std::vector<PrintedClaim>& printed) {
  if (impacts.empty()) fail(Failure::input, "table: no impact.h5 given; 1 is the least");
  std::sort(impacts.begin(), impacts.end(), [](const auto& a, const auto& b) { return a.torque < b.torque; });

  Figure table;
  table.title = "Natural frequencies by ring-down";
  const ImpactArtifact& first = impacts[0];
  table.notes.push_back("Rayleigh damping η = " + shown(first.damping.rayleigh_stiffness * kMicro, 6) +
                        " µs; " + corner_words(first.mesh.corner));
  const double ratio = GearPair(first).contact_ratio();
  const double share = ratio - std::floor(ratio);
  const std::vector<std::string> counts{"one", "two", "three", "four"};
  const size_t few = static_cast<size_t>(ratio) - 1;
  if (few + 1 >= counts.size())
    fail(Failure::input, "table: a contact ratio of ", ratio, "; below ", counts.size(), " is known");
  table.notes.push_back("phase mean: over the phases of a mesh period; contact ratio mean: " +
                        fixed(1 - share, 4) + " of it with " + counts[few] + ", " + fixed(share, 4) +
                        " with " + counts[few + 1] + " pairs, as without load");
  FigureBlock block{"natural frequencies", {"torque [N m]"}, {}};
  for (size_t i = 0; i < impacts.size(); ++i) {
    const ImpactArtifact& a = impacts[i];
    if (i > 0 && a.torque == impacts[i - 1].torque)
      fail(Failure::input, "table: two impact.h5 of the same torque, ", torque_words(a.torque),
           "; give each once");
    const auto at = [&](const std::string& state) {
      const auto found = std::find(a.contact_state.begin(), a.contact_state.end(), state);
      if (found == a.contact_state.end())
        fail(Failure::input, "table: at ", torque_words(a.torque), " the impact.h5 holds no contact state '",
             state, "'; with this load no phase has it");
      return a.natural_frequency[found - a.contact_state.begin()];
    };
    const double low = at(counts[few]), high = at(counts[few + 1]);
    std::vector<double> row{a.torque};
    for (const auto& [name, state, value] :
         {std::tuple{counts[few] + (few == 0 ? " pair" : " pairs"), counts[few], low},
          {counts[few + 1] + " pairs", counts[few + 1], high},
          {std::string("phase mean"), std::string("mean"), at("mean")},
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
