// A figure that is panels of curves, marks and bars over two axes: what it shows, free of how gnuplot says it.
//
// Words here are text in which gnuplot reads marks such as '_' (subscript): names of files and gears go through without_markup().
#pragma once
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace whine {

inline constexpr double kAutomatic =
    std::numeric_limits<double>::quiet_NaN();  // an end of an axis that the data decide

// Places of common.gp's `colour`: the first six tell curves apart.
enum PanelColour {
  kBlue = 1,
  kVermilion,
  kGreen,
  kPurple,
  kOrange,
  kDark,
  kBlack,
  kGrey,
  kPale,
  kShade,
  kMedium,
  kLight
};

// Of curve number `i`, from 0: more than six begin again.
inline int curve_colour(size_t i) {
  return static_cast<int>(i % 6) + kBlue;
}

enum class PanelStyle {
  line,
  points,
  line_points,
  stems,   // from 0 to y, with a mark on top (size 0: none)
  bars,    // upright, `width` on the x axis
  rows,    // lying, from 0 to y; x is the row
  spans,   // shaded from column x to column y over all of the panel
  boxes,   // rectangles over `box`
  ranges,  // points with bars over `box`
  cells,   // rectangles about x and y over `box`, without one `width` by `size` in units of the axes
  arrows,  // from and to columns of `box`; size 0: lines without a head
  image    // pixels at x and y on an even grid in the colours of column `heat`, on the axis Panel::colours
};

// Of line_points the line has all rows, the marks stand at every `every`th place along x from `first` on, counted from the least x of the
// block, so that those of two sweeps over the same speeds stand apart.
struct PanelCurve {
  std::string block = {};  // of figure.blocks, by its name; "": of the key alone
  int x = 1, y = 2;        // columns, the first is 1
  PanelStyle style = PanelStyle::line;
  int colour = kBlue;      // of PanelColour; beyond it red, green and blue as one number
  std::string label = {};  // in the key; "": not there
  double width = 2.4;      // of the line; of bars in units of x, of rows in rows
  int dash = 1;            // 1: solid, 2 to 7: others
  int mark = 7;            // gnuplot's pt
  double size = 1.2;       // of a mark
  int every = 1, first = 0;
  double shift = 0;  // along x
  int where = 0;     // a column: only rows in which it is above 0, or is `is`; 0: all
  std::optional<double> is = {};
  std::optional<double> at = {};  // y of all rows, in place of the column
  std::array<int, 4> box = {};    // columns: x from, x to, y from, y to; 0: to the edge of the panel
  double fill = 1;                // of boxes, 0 to 1
  int rgb = 0, marks = 0;         // columns of colours and of marks; 0: all have `colour`, `mark`
  int heat = 0;  // column of points, lines and cells in the colours of Panel::colours; 0: all have `colour`
};

// A straight line across a panel: at a value of x or of y.
struct PanelRule {
  char axis = 'x';
  double at = 0;
  std::string label = {};  // beside it, at its upper end; of a line at y at the right end
  int colour = kGrey, dash = 2;
  bool in_key = false;  // its label stands in the key
};

struct PanelAxis {
  std::string label = {};
  double from = kAutomatic, to = kAutomatic;
  bool log = false;
  double decades =
      6;  // most that an automatic logarithmic axis shows; below a given `from` curves stand on it
  bool from_zero = false;  // an automatic one begins at 0
  bool speed = false;  // mesh frequency in Hz, which engineering_axes can turn into rpm; of y without rules
  bool level = false;  // amplitudes in µm that it can turn into dB
  std::vector<std::string> names =
      {};  // at 1, 2, ... in place of numbers, from the left or from the top; lines apart by '\n'
};

// Words at a place of the axes, or above the frame.
struct PanelWords {
  std::string words;
  double x, y = kAutomatic;
  bool on = false;  // centred on their place, not beside it
};

enum class PanelKey { right, below, none };  // below: across its row, if no other panel of it has a key

// One without curves keeps its place free.
struct Panel {
  std::string heading = {};  // above it, behind its letter; lines apart by '\n'
  PanelAxis x = {}, y = {};
  std::optional<PanelAxis> top = {};  // the x axis in another unit: label alone
  double top_factor = 1;              // value of the axis above over that of x
  std::vector<PanelCurve> curves = {};
  std::vector<PanelRule> rules = {};
  PanelKey key = PanelKey::right;
  int height = 360;     // pixels of its frame; of panels side by side the largest counts
  bool bare = false;    // without axes, of one scale in x and y
  bool square = false;  // its frame
  bool wide = false;    // over all columns
  bool letter = true;   // (a) before its heading
  std::optional<PanelAxis> colours =
      {};  // of `heat`, from and to given; what is below a logarithmic one is not drawn
  std::vector<PanelWords> words = {};
};

}  // namespace whine
