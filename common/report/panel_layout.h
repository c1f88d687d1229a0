// Where the panels of a figure stand, in pixels, so that no text meets another: widths of the numbers beside an axis, of keys and of
// headings are measured (text_width.h).
#pragma once
#include <string>
#include <vector>

#include "report/figures.h"

namespace whine {

// Pixels. gnuplot's points are 4/3 of them; letters of axes, of names in place of numbers, of keys and headings.
namespace pixels {
inline constexpr double kWidth = 1600, kPoint = 4.0 / 3, kAxisLetter = 18 * kPoint, kNameLetter = 13 * kPoint,
                        kLetter = 14 * kPoint, kLine = 26;
inline constexpr double kFrameTop = 16, kNumbersBelow = 50, kLabelBelow = 38, kNumbersAbove = 48,
                        kLabelAbove = 34, kLabelBeside = 46, kColourBox = 164;
}  // namespace pixels

// Of an axis; upside down where a y axis has names.
struct AxisRange {
  double from = 0, to = 1;
  double span() const { return to - from; }
};

// A tick at each multiple of `step`, or at powers of ten, or at names.
struct AxisTicks {
  double step = 1;
  double widest = 0;  // of their words, parts of a letter
  double size = 18;   // of their letters, points
};

// Where the frame of a panel stands, and what stands about it.
struct PanelPlace {
  double left = 0, right = 0, top = 0, bottom = 0;  // of the frame, pixels from the left and from the top
  AxisRange x = {}, y = {};
  AxisTicks x_ticks = {}, y_ticks = {};
  double above = 0, below = 0;  // pixels that headings, axes and keys take
  size_t row = 0, column = 0;
  std::vector<std::string> heading = {};  // lines
  double key_width = 0, key_columns = 1, key_rows = 0, key_middle = 0;
};

struct PanelLayout {
  std::vector<PanelPlace> places;  // of each panel
  int height = 0;                  // of the picture
};

// Throws Error(numerical) for a curve whose block or column the figure does not have.
PanelLayout layout_of_panels(const Figure& figure);

const FigureBlock& block_of(const Figure& figure, const std::string& name);

// Whether a curve shows a row of its block.
bool holds(const PanelCurve& c, const std::vector<double>& row);

// 1, 2 or 5 times a power of ten and not below x > 0.
double step_of(double x);

// Of a logarithmic axis on which powers of ten alone would be too few: 1, 2, 5 times each; else none.
std::vector<double> log_ticks(AxisRange r);

}  // namespace whine
