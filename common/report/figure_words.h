// Words of a picture that come from names and numbers: keys, labels, notes.
#pragma once
#include <string>
#include <vector>

#include "gear/pair.h"
#include "report/figures.h"

namespace whine {

// What gnuplot's word() finds one by one: 'a' 'b'.
std::string quoted_labels(const std::vector<std::string>& names);

// A name that fits into a key or a label: its first and last letters, "…" between, where it is wider than a legend; of a mesh, "a-b",
// those of either gear, so that meshes of planets stay apart.
std::string short_name(const std::string& name);

// Of a line of notes, in parts of the size of its letters: 1580 pixels at 16.
inline constexpr double kNoteWidth = 98;

// Words in lines of a picture's width, broken at blanks; '_' and '^' are letters of them.
std::vector<std::string> in_lines(const std::string& words);

// The unit in which figures and tables show a quantity in SI, "" of numbers without: µm for "m".
struct ShownUnit {
  const char* units;
  double scale;
};
ShownUnit shown_units(const std::string& units);

// The force at which the torque (N m) is carried at rest: "T / r_b = 2128 N" in the key.
PanelRule rest_rule(const GearDesign& driver, double torque);
// "T / r_b", of helical gears "T / (r_b cos β_b)".
std::string rest_force_name(const GearDesign& driver);

// Captions of notes: the first `plain` as they stand, behind them notes with the marks of gnuplot.
void plain_captions(size_t plain, Figure& figure);

// Of curves of this many points each how many marks are left out between two of them, so that neighbours do not run into each other.
int mark_stride(Eigen::Index points);

// Notes as a template with foot_name = "line%d" has them: the first `plain` as they stand, behind them notes with the marks of gnuplot.
void add_lines(size_t plain, Figure& figure);

}  // namespace whine
