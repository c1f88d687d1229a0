// Draws a figure's TSV with gnuplot and a template.
#pragma once
#include <string>

#include "report/figures.h"

namespace whine {

enum class Picture { svg, png, gif };  // gif: of half the width, an animation if the template draws several

// A gnuplot expression whose value is `words`: single quotes, between which gnuplot expands neither commands in backticks nor
// macros; newlines stay, tabs become blanks, hidden characters have their names.
std::string gnuplot_string(const std::string& words);

// In a folder of templates: panels.gp for a figure of panels, else the one that has the figure's name.
std::string template_of(const Figure& figure, const std::string& folder, const std::string& name);

// Runs `gnuplot -d` (no user settings, locale C.UTF-8) on the template and returns the picture's bytes. The
// template finds the string variables tsv, title, heading (title and scenes, a line each), note1.. and the figure's own
// numbers and words; the terminal is set before it. Throws Error(io) if gnuplot cannot be started, Error(numerical) with its
// first complaint if it fails or draws nothing.
std::string draw(const Figure& figure, const std::string& tsv_path, const std::string& template_path,
                 Picture picture);

}  // namespace whine
