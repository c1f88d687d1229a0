#include "report/figures.h"

#include <cctype>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/visible.h"
#include "gear/pair.h"
#include "results/static.h"

namespace whine {

std::string rounded(double value, int decimals) {
  const double scale = std::pow(10, decimals);
  return text(std::round(value * scale) / scale + 0.0);  // no -0
}

std::string letter_of(size_t i) {
  return std::string(1, static_cast<char>('a' + i));
}

std::string torque_words(double torque) {
  return shown(torque, 6) + " N m";
}

std::string corner_words(const GearPairParameters& of) {
  const CornerRule& corner = of.mesh.corner;
  if (of.gear[0].design.helical()) return "tip edges count on the line of action alone";
  if (!corner.enabled) return "corner contact off";
  if (!std::isfinite(corner.largest_angle)) return "corner contact on";
  return "corner contact up to " + shown(corner.largest_angle * 180.0 / std::numbers::pi, 4) + "°";
}

std::string pair_words(const StaticResult& s) {
  const GearDesign& driver = s.gear[0].design;
  const bool helical = driver.helical();
  return text(
      driver.teeth, "/", s.gear[1].design.teeth, " teeth, ", helical ? "normal " : "", "module ",
      shown(driver.module * kMilli, 4), " mm, ",
      helical ? text("helix angle ", shown(driver.helix_angle * 180 / std::numbers::pi, 4), "°, ") : "",
      "centre distance ", shown(s.mesh.centre_distance * kMilli, 6), " mm, ", helical ? "transverse " : "",
      "contact ratio ", fixed(s.contact_ratio, 4), ", ",
      helical ? text("overlap ratio ", fixed(GearPair(s).overlap_ratio(), 3), ", ") : "", corner_words(s));
}

std::string without_markup(const std::string& words) {
  std::string out;
  for (char c : words) {
    if (std::string("_^{}@&~\\").find(c) != std::string::npos) out += '\\';
    out += c;
  }
  return out;
}

namespace {

std::string cell(const FigureBlock& block, const std::vector<double>& row, size_t c) {
  if (!std::isfinite(row[c]))
    fail(Failure::numerical, "figure: ", block.name, " holds a value that is not finite in column ", c);
  return shown(row[c], 9);
}

// A text that cannot end a cell, a line, or the line for those who take '#' for the start of a comment.
std::string in_cell(std::string words) {
  for (char& c : words)
    if (c == '\t' || c == '\n' || c == '\r' || c == '#') c = ' ';
  return words;
}

std::string head_of(const Figure& figure) {
  std::string out = "# " + figure.title + "\n";
  for (const auto& scene : figure.scenes) out += "# scene " + scene + "\n";
  for (const auto& note : figure.notes) out += "# " + note + "\n";
  return visible(out);
}

// As the end of a file's name: "rectangular wave" is fig13-rectangular-wave.tsv.
std::string in_path(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') c = '-';
  return name;
}

}  // namespace

std::string plot_data(const Figure& figure) {
  std::string out = head_of(figure);
  for (const auto& block : figure.blocks) {
    // gnuplot's `index "[name]"` looks for the comments that begin with it: the brackets keep titles and
    // names that begin alike apart.
    out += "\n\n# [" + block.name + "]\n# ";
    for (size_t c = 0; c < block.columns.size(); ++c) out += (c ? "\t" : "") + block.columns[c];
    out += "\n";
    for (const auto& row : block.rows) {
      for (size_t c = 0; c < row.size(); ++c) out += (c ? "\t" : "") + cell(block, row, c);
      out += "\n";
    }
  }
  return out;
}

std::vector<FigureTable> tables(const Figure& figure, const std::vector<std::string>& sources) {
  std::string head = head_of(figure);
  for (const auto& source : sources) head += "# from " + source + "\n";
  std::vector<FigureTable> out;
  std::vector<const FigureBlock*> first;  // of each table
  for (const auto& block : figure.blocks) {
    if (block.drawing) continue;
    const std::string name = block.table.empty() ? block.name : block.table;
    size_t t = 0;
    while (t < out.size() && out[t].name != name) ++t;
    if (t == out.size()) {
      std::string line = head + (block.curve.empty() ? "" : "curve\t");
      for (size_t c = 0; c < block.columns.size(); ++c) line += (c ? "\t" : "") + in_cell(block.columns[c]);
      out.push_back({name, line + "\n"});
      first.push_back(&block);
    } else if (block.columns != first[t]->columns || block.curve.empty() || first[t]->curve.empty()) {
      fail(Failure::numerical, "figure: the blocks ", first[t]->name, " and ", block.name,
           " do not fit into one table, ", name);
    }
    for (const auto& row : block.rows) {
      if (row.empty()) continue;
      if (!block.curve.empty()) out[t].text += in_cell(block.curve) + "\t";
      for (size_t c = 0; c < row.size(); ++c) out[t].text += (c ? "\t" : "") + cell(block, row, c);
      out[t].text += "\n";
    }
  }
  for (size_t t = 0; t < out.size(); ++t) out[t].name = t ? in_path(out[t].name) : "";
  return out;
}

std::vector<FileBytes> table_files(const Figure& figure, const std::string& output,
                                   const std::vector<std::string>& sources) {
  std::vector<FileBytes> files;
  for (const FigureTable& table : tables(figure, sources))
    files.push_back({output + (table.name.empty() ? "" : "-" + table.name) + ".tsv", table.text});
  return files;
}

}  // namespace whine
