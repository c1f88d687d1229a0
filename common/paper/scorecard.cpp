#include "paper/scorecard.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

#include "base/error.h"

namespace whine {

Verdict verdict(const Claim& claim, const Finding& finding, bool is_fitted) {
  if (claim.scale == Scale::incomparable) return Verdict::incomparable;
  if (claim.scale == Scale::misprint) return Verdict::misprint;
  // NaN, a state that is not there, fails every comparison.
  const bool agrees = std::abs(finding.value - claim.printed) <= claim.tolerance;
  if (claim.scale == Scale::choice) return agrees ? Verdict::given : Verdict::incomparable;
  if (!agrees) return Verdict::differs;
  if (is_fitted) return Verdict::fitted;
  return claim.given ? Verdict::given : Verdict::agrees;
}

namespace {

// What differs between paths in one place only is put into braces: up and down first, then torques.
std::string braced(const std::set<std::string>& files) {
  std::set<std::string> both;
  for (const std::string& file : files) {
    const size_t up = file.find("/up/"), down = file.find("/down/");
    const std::string one = up == std::string::npos ? file : std::string(file).replace(up, 4, "/down/"),
                      other = down == std::string::npos ? file : std::string(file).replace(down, 6, "/up/");
    const bool pair = (up != std::string::npos && files.contains(one)) ||
                      (down != std::string::npos && files.contains(other));
    both.insert(!pair                     ? file
                : up != std::string::npos ? std::string(file).replace(up, 4, "/{up,down}/")
                                          : std::string(file).replace(down, 6, "/{up,down}/"));
  }
  std::map<std::string, std::vector<std::string>> torques;  // by what follows the first folder
  for (const std::string& file : both)
    torques[file.substr(file.find('/'))].push_back(file.substr(1, file.find('/') - 1));
  std::string out;
  for (const auto& [rest, list] : torques) {
    std::string inside;
    for (const std::string& torque : list) inside += (inside.empty() ? "" : ",") + torque;
    out += (out.empty() ? "T" : " T") + (list.size() > 1 ? "{" + inside + "}" : inside) + rest;
  }
  return out;
}

}  // namespace

Verdict verdict(const Scorecard& card, const ScoredClaim& row, size_t scene) {
  bool is_fitted = false;
  for (const FittedNumber& n : card.fitted)
    is_fitted = is_fitted || (n.scene == card.scenes[scene] &&
                              std::count(n.claims.begin(), n.claims.end(), row.claim.id) > 0);
  return verdict(row.claim, row.findings[scene], is_fitted);
}

Scorecard score(const std::vector<Claim>& claims, const std::vector<SceneResults>& scenes,
                const std::vector<FittedNumber>& fitted) {
  Scorecard card;
  card.fitted = fitted;
  for (const FittedNumber& n : fitted)
    for (const std::string& id : n.claims)
      if (std::none_of(claims.begin(), claims.end(), [&](const Claim& c) { return c.id == id; }))
        fail(Failure::input, "the number ", n.number, " of scene ", n.scene, " is fitted to the claim '", id,
             "', which does not exist; gear-scorecard --claims lists them");
  for (const SceneResults& s : scenes) card.scenes.push_back(s.name);
  for (const Claim& claim : claims) {
    ScoredClaim row{claim, {}, ""};
    std::set<std::string> asked;
    for (const SceneResults& s : scenes) {
      s.asked.clear();
      row.findings.push_back(claim.find(s));
      asked.insert(s.asked.begin(), s.asked.end());
    }
    row.sources = braced(asked);
    card.rows.push_back(row);
  }
  return card;
}

// ---- how it is shown
// ---------------------------------------------------------------------------------------------

namespace {

const char* verdict_in_words(Verdict v) {
  switch (v) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::differs:
      return "differs";
    case Verdict::given:
      return "given";
    case Verdict::fitted:
      return "fitted";
    case Verdict::misprint:
      return "misprint of P2000";
    case Verdict::incomparable:
      break;
  }
  return "cannot be compared";
}

std::string value_text(const Claim& c, double value) {
  if (std::isnan(value)) return "";
  if (c.scale == Scale::statement) return value > 0.5 ? "yes" : "no";
  return digits(value) + (c.unit == "1" ? "" : " " + c.unit);
}

std::string printed_text(const Claim& c) {
  const std::string value = value_text(c, c.printed);
  if (c.scale == Scale::statement || c.scale == Scale::incomparable || c.scale == Scale::misprint ||
      c.tolerance < 1e-6 * std::abs(c.printed))
    return value;
  return value + " ± " + digits(c.tolerance);
}

std::string deviation_text(const Claim& c, const Finding& f) {
  if (c.scale == Scale::statement || std::isnan(f.value) || std::isnan(c.printed) || c.printed == 0 ||
      std::abs(f.value - c.printed) < 1e-9 * std::abs(c.printed))
    return "";
  std::ostringstream out;
  out << std::showpos << std::fixed << std::setprecision(1);
  if (c.unit == "%")
    out << f.value - c.printed << " percentage points";
  else
    out << 100 * (f.value / c.printed - 1) << " %";
  return out.str();
}

// "2483 Hz (+0.1 %)", "2987 N (-0.4 %, sum over the teeth)", "yes", "none"
std::string found_text(const Claim& c, const Finding& f) {
  const std::string value = value_text(c, f.value);
  if (value.empty()) return c.scale == Scale::incomparable || c.scale == Scale::choice ? "" : "none";
  std::string more = c.scale == Scale::incomparable ? "" : deviation_text(c, f);
  if (!f.reading.empty()) more += (more.empty() ? "" : ", ") + f.reading;
  return more.empty() ? value : value + " (" + more + ")";
}

// What explains the verdicts: notes of the scenes, once if they are equal.
std::string notes_text(const Scorecard& card, const ScoredClaim& row) {
  std::string words, last;
  for (size_t i = 0; i < row.findings.size(); ++i) {
    const Finding& f = row.findings[i];
    const Verdict v = verdict(card, row, i);
    const bool plain = v == Verdict::agrees || v == Verdict::given || v == Verdict::fitted;
    if (f.note.empty() || f.note == last || (plain && f.reading.empty())) continue;
    const bool alike = std::all_of(row.findings.begin(), row.findings.end(),
                                   [&](const Finding& other) { return other.note == f.note; });
    words += (words.empty() ? "" : "; ") + (alike ? f.note : card.scenes[i] + ": " + f.note);
    last = f.note;
  }
  return words;
}

std::string exact(double value) {
  std::ostringstream number;
  number << std::setprecision(9) << value;
  return std::isnan(value) ? std::string("-") : number.str();
}

std::string claim_columns(const Claim& c) {
  return text(c.id, "\t", c.place, "\t", c.text, "\t", c.unit, "\t", exact(c.printed), "\t",
              exact(c.tolerance), "\t", c.basis);
}

size_t width(const std::string& utf8) {
  return static_cast<size_t>(
      std::count_if(utf8.begin(), utf8.end(), [](char b) { return (b & 0xC0) != 0x80; }));
}

std::string padded_words(const std::string& words, size_t to) {
  return words + std::string(to > width(words) ? to - width(words) : 0, ' ');
}

}  // namespace

std::vector<std::string> bottom_line(const Scorecard& card) {
  std::vector<std::string> lines;
  for (size_t i = 0; i < card.scenes.size(); ++i) {
    std::map<Verdict, int> count;
    for (const ScoredClaim& row : card.rows) ++count[verdict(card, row, i)];
    int tied = 0, chosen = 0;
    for (const FittedNumber& n : card.fitted)
      if (n.scene == card.scenes[i]) ++(n.claims.empty() ? chosen : tied);
    lines.push_back(
        text(card.scenes[i], ": ", count[Verdict::agrees], " agree, ", count[Verdict::differs], " differ, ",
             count[Verdict::given] + count[Verdict::fitted], " given or fitted, ",
             count[Verdict::incomparable], " cannot be compared, ", count[Verdict::misprint],
             " misprint of P2000; ", tied, " numbers fitted to ", count[Verdict::fitted], " claims",
             chosen > 0 ? text(", ", chosen, " chosen for the number of claims that agree") : ""));
  }
  return lines;
}

std::string scorecard_tsv(const Scorecard& card, const std::vector<std::string>& sources) {
  std::string out = "# What P2000 prints beside the results of the scenes\n";
  for (const std::string& line : bottom_line(card)) out += "# " + line + "\n";
  for (const std::string& source : sources) out += "# from " + source + "\n";
  out += "# id\tplace\tclaim\tunit\tprinted\ttolerance\tbasis";
  for (const std::string& s : card.scenes)
    for (const char* column : {"value", "deviation", "reading", "verdict", "note"})
      out += "\t" + s + " " + column;
  out += "\tartifacts of a scene\n";
  for (const ScoredClaim& row : card.rows) {
    const Claim& c = row.claim;
    out += claim_columns(c);
    for (size_t i = 0; i < row.findings.size(); ++i) {
      const Finding& f = row.findings[i];
      out += "\t" + exact(f.value) + "\t" + deviation_text(c, f) + "\t" + f.reading + "\t" +
             verdict_in_words(verdict(card, row, i)) + "\t" + f.note;
    }
    out += "\t" + row.sources + "\n";
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
    for (size_t i = 0; i < row.findings.size(); ++i) {
      cells.back().push_back(found_text(row.claim, row.findings[i]));
      cells.back().push_back(verdict_in_words(verdict(card, row, i)));
    }
  }
  std::vector<size_t> widths(cells[0].size(), 0);
  for (const auto& row : cells)
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  std::string out, home;
  for (const std::string& s : card.scenes) home += (home.empty() ? "" : ",") + s;
  home = card.scenes.size() > 1 ? "{" + home + "}" : home;
  for (size_t r = 0; r < cells.size(); ++r) {
    std::string line;
    for (size_t i = 0; i < cells[r].size(); ++i)
      line += (i ? "  " : "") + padded_words(cells[r][i], widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
    if (r == 0) continue;
    const ScoredClaim& row = card.rows[r - 1];
    const std::string reason = notes_text(card, row);
    if (!reason.empty()) out += "    why: " + reason + "\n";
    if (row.claim.scale == Scale::incomparable || row.claim.scale == Scale::choice)
      out += "    not compared: " + row.claim.basis + "\n";
    if (!row.sources.empty()) out += "    from, in out/" + home + "/: " + row.sources + "\n";
  }
  out += "\n";
  for (const std::string& line : bottom_line(card)) out += line + "\n";
  return out;
}

std::string claims_tsv(const std::vector<Claim>& claims) {
  std::string out;
  for (const Claim& c : claims) out += claim_columns(c) + "\n";
  return out;
}

}  // namespace whine
