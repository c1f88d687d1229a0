#include "plot/scorecard.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

#include "base/error.h"

namespace whine {

Verdict verdict(const Claim& claim, const Finding& finding) {
  if (claim.scale == Scale::incomparable) return Verdict::incomparable;
  // NaN, a state that is not there, fails every comparison.
  return std::abs(finding.value - claim.printed) <= claim.tolerance ? Verdict::agrees : Verdict::differs;
}

Scorecard score(const std::vector<Claim>& claims, const std::vector<SceneAnswers>& scenes) {
  Scorecard card;
  for (const SceneAnswers& s : scenes) card.scenes.push_back(s.name);
  for (const Claim& claim : claims) {
    ScoredClaim row{claim, {}};
    for (const SceneAnswers& s : scenes) row.findings.push_back(claim.find(s));
    card.rows.push_back(row);
  }
  return card;
}

// ---- how it is shown
// ---------------------------------------------------------------------------------------------

namespace {

const char* words_of(Verdict v) {
  return v == Verdict::agrees ? "agrees" : v == Verdict::differs ? "differs" : "cannot be compared";
}

std::string value_text(const Claim& c, double value) {
  if (std::isnan(value)) return "";
  if (c.scale == Scale::statement) return value > 0.5 ? "yes" : "no";
  return digits(value) + (c.unit == "1" ? "" : " " + c.unit);
}

std::string printed_text(const Claim& c) {
  const std::string value = value_text(c, c.printed);
  if (c.scale == Scale::statement || c.scale == Scale::incomparable ||
      c.tolerance < 1e-6 * std::abs(c.printed))
    return value;
  return value + " ± " + digits(c.tolerance);
}

std::string deviation_text(const Claim& c, const Finding& f) {
  if (c.scale == Scale::statement || std::isnan(f.value) || std::isnan(c.printed) || c.printed == 0 ||
      std::abs(f.value - c.printed) < 1e-9 * std::abs(c.printed))
    return "";
  std::ostringstream out;
  out << std::showpos << std::fixed << std::setprecision(1) << 100 * (f.value / c.printed - 1) << " %";
  return out.str();
}

// "2483 Hz (+0.1 %)", "yes", "none"
std::string found_text(const Claim& c, const Finding& f) {
  const std::string value = value_text(c, f.value), off = deviation_text(c, f);
  if (value.empty()) return c.scale == Scale::incomparable ? "" : "none";
  return c.scale == Scale::incomparable || off.empty() ? value : value + " (" + off + ")";
}

// What explains the verdicts: notes of the scenes, once if they are equal.
std::string notes_text(const Scorecard& card, const ScoredClaim& row, bool all) {
  std::string words, last;
  for (size_t i = 0; i < row.findings.size(); ++i) {
    const std::string& note = row.findings[i].note;
    if (note.empty() || note == last || (!all && verdict(row.claim, row.findings[i]) == Verdict::agrees))
      continue;
    const bool alike = std::all_of(row.findings.begin(), row.findings.end(),
                                   [&](const Finding& f) { return f.note == note; });
    words += (words.empty() ? "" : "; ") + (alike ? note : card.scenes[i] + ": " + note);
    last = note;
  }
  return words;
}

std::string claim_cells(const Claim& c) {
  const std::string given = c.scale == Scale::given ? " (given)" : "";
  return "| `" + c.id + "` | " + c.place + " | " + c.text + given + " | " + printed_text(c) + " | " +
         c.basis + " |";
}

size_t width(const std::string& utf8) {
  return static_cast<size_t>(
      std::count_if(utf8.begin(), utf8.end(), [](char b) { return (b & 0xC0) != 0x80; }));
}

std::string padded(const std::string& words, size_t to) {
  return words + std::string(to > width(words) ? to - width(words) : 0, ' ');
}

}  // namespace

std::vector<std::string> bottom_line(const Scorecard& card) {
  std::vector<std::string> lines;
  for (size_t i = 0; i < card.scenes.size(); ++i) {
    std::map<Verdict, int> count;
    int given = 0;
    for (const ScoredClaim& row : card.rows) {
      const Verdict v = verdict(row.claim, row.findings[i]);
      ++count[v];
      given += row.claim.scale == Scale::given && v == Verdict::agrees;
    }
    lines.push_back(text(card.scenes[i], ": ", count[Verdict::agrees], " agree (", given,
                         " of them given or fitted), ", count[Verdict::differs], " differ, ",
                         count[Verdict::incomparable], " cannot be compared"));
  }
  return lines;
}

std::string scorecard_tsv(const Scorecard& card, const std::vector<std::string>& sources) {
  std::string out = "# What P2000 prints beside what the scenes answer\n";
  for (const std::string& line : bottom_line(card)) out += "# " + line + "\n";
  for (const std::string& source : sources) out += "# from " + source + "\n";
  out += "# id\tplace\tclaim\tunit\tprinted\ttolerance\tbasis";
  for (const std::string& s : card.scenes)
    for (const char* column : {"value", "deviation", "verdict", "note"}) out += "\t" + s + " " + column;
  out += "\n";
  const auto exact = [](double value) {
    std::ostringstream number;
    number << std::setprecision(9) << value;
    return std::isnan(value) ? std::string("-") : number.str();
  };
  for (const ScoredClaim& row : card.rows) {
    const Claim& c = row.claim;
    out += c.id + "\t" + c.place + "\t" + c.text + "\t" + c.unit + "\t" + exact(c.printed) + "\t" +
           exact(c.tolerance) + "\t" + c.basis;
    for (const Finding& f : row.findings)
      out += "\t" + exact(f.value) + "\t" + deviation_text(c, f) + "\t" + words_of(verdict(c, f)) + "\t" +
             f.note;
    out += "\n";
  }
  return out;
}

std::string scorecard_markdown(const Scorecard& card) {
  std::string out = "| claim | in P2000 | it says | printed | decided by |", rule = "|---|---|---|---|---|";
  for (const std::string& s : card.scenes) {
    out += " `" + s + "` |";
    rule += "---|";
  }
  out += " reason, where it does not agree |\n" + rule + "---|\n";
  for (const ScoredClaim& row : card.rows) {
    out += claim_cells(row.claim);
    for (const Finding& f : row.findings) {
      const std::string found = found_text(row.claim, f);
      out += " " + found + (found.empty() ? "" : ": ") + words_of(verdict(row.claim, f)) + " |";
    }
    out += " " + notes_text(card, row, false) + " |\n";
  }
  return out;
}

std::string scorecard_text(const Scorecard& card) {
  std::vector<std::vector<std::string>> cells{{"claim", "in P2000", "printed"}};
  for (const std::string& s : card.scenes) {
    cells[0].push_back(s);
    cells[0].push_back("");
  }
  for (const ScoredClaim& row : card.rows) {
    cells.push_back({row.claim.id, row.claim.place, printed_text(row.claim)});
    for (const Finding& f : row.findings) {
      cells.back().push_back(found_text(row.claim, f));
      cells.back().push_back(words_of(verdict(row.claim, f)));
    }
  }
  std::vector<size_t> widths(cells[0].size(), 0);
  for (const auto& row : cells)
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  std::string out;
  for (const auto& row : cells) {
    std::string line;
    for (size_t i = 0; i < row.size(); ++i) line += (i ? "  " : "") + padded(row[i], widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  out += "\n";
  for (const std::string& line : bottom_line(card)) out += line + "\n";
  return out;
}

std::string claims_markdown(const std::vector<Claim>& claims) {
  std::string out;
  for (const Claim& c : claims) out += claim_cells(c) + "\n";
  return out;
}

}  // namespace whine
