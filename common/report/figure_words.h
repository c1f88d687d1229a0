// Words of a picture that come from names and numbers: keys, labels, notes.
#pragma once
#include <string>
#include <vector>

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

// Notes as a template with foot_name = "line%d" has them: the first `plain` as they stand, behind them notes with the marks of gnuplot.
void add_lines(size_t plain, Figure& figure);

}  // namespace whine
