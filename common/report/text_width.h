// How wide words are in a picture, whose letters are those of DejaVu Sans.
#pragma once
#include <string>
#include <vector>

namespace whine {

// Width of words in parts of the size of their letters; a number of pixels over it is the largest size that fits. Marks of gnuplot
// (braces with what selects a font, '_' and '^', backslashes) have none. Beyond ASCII an average.
double text_width(const std::string& words);

// In lines of at most `width`, broken at blanks that stand outside of braces; a word that is wider stands alone.
// measure: how wide words are.
std::vector<std::string> broken_lines(const std::string& words, double width,
                                      double (*measure)(const std::string&) = text_width);

}  // namespace whine
