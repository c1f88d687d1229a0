// The tables behind the figures: what is plotted, in the units that an engineer reads, before any drawing.
//
// A figure is a list of blocks of numbers (one curve or one set of marks each) and a list of words and
// numbers for its gnuplot template. Templates only draw: every conversion, selection and derived curve is
// made here and is in the TSV.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "base/format.h"
#include "gear/shafts.h"
#include "io/publish.h"
#include "report/panels.h"
#include "results/static.h"

namespace whine {

inline constexpr double kMicro = 1e6;  // m -> micrometre
inline constexpr double kMilli = 1e3;  // m -> mm
inline constexpr double kMega = 1e-6;  // N m-1 -> N/µm
inline constexpr double kPercent = 100;
inline constexpr int kShownHarmonics = 10;
inline constexpr size_t kMostCurves = 6;  // colours, dashes and marks of the templates
inline constexpr size_t kMostLines = 12;  // colours and dashes of those of systems

struct FigureBlock {
  std::string name;                       // gnuplot finds it by `index "[name]"`
  std::vector<std::string> columns;       // with their unit: "mesh_frequency [Hz]"
  std::vector<std::vector<double>> rows;  // an empty row lifts the pen
  std::string table = {};  // of the tables of numbers the one that it stands in; "": one of its own
  std::string curve =
      {};                // which rows of that table are its, in its first column; "": the table has no other
  bool drawing = false;  // lines and areas of a drawing, which are in no table
};

// A column (µm) that can be drawn as levels in dB.
struct LevelColumn {
  std::string column;
  bool amplitude;  // of a harmonic; else an RMS
};

struct Figure {
  std::string title;
  std::vector<std::string> scenes;  // "file: title" of those that all of it shows; filled by the caller
  std::vector<std::string> notes;   // one line each: operating point, choices, model level
  std::vector<std::string> captions = {};  // below the picture in place of the notes, if there are any
  std::vector<FigureBlock> blocks;
  std::vector<std::pair<std::string, double>> numbers;     // variables of the template
  std::vector<std::pair<std::string, std::string>> words;  // string variables of the template
  std::vector<Shaft> shafts =
      {};  // gears and carriers, where the figure is against speed and all of it is of one pair or train
  std::string no_shafts = {};  // why there are none, where that is no matter of the figure
  std::vector<LevelColumn> levels = {};
  std::vector<Panel> panels = {};  // drawn by panels.gp; none: the figure has a template of its own
  size_t columns = 1;              // panels beside each other
  int height =
      1000;  // of the picture beside a width of 1600; also a variable; of panels their layout decides
};

// To these decimals, without zeros at the end.
std::string rounded(double value, int decimals);

// 0: "a", the letter of a panel.
std::string letter_of(size_t i);

// Driver and driven gear of an artifact with gears and a mesh.
template <class Artifact>
std::vector<Shaft> shafts_of(const Artifact& a) {
  return shafts_of(a.mesh.gear, {a.gear[0].design.teeth, a.gear[1].design.teeth});
}
// Of several: none where their gears differ in number of teeth; gears of other names are called by their role.
template <class Artifacts>
std::vector<Shaft> shafts_of_all(const Artifacts& all) {
  std::vector<Shaft> first;
  for (const auto& a : all) {
    const std::vector<Shaft> own = shafts_of(a);
    if (first.empty()) first = own;
    for (size_t g = 0; g < own.size(); ++g)
      if (own[g].turns != first[g].turns)
        return {};
      else if (own[g].gear != first[g].gear)
        first[g].gear = kRole[g];
  }
  return first;
}

// "150 N m"; "corner contact on"; teeth, module, centre distance, contact ratio and corner rule of a pair.
std::string torque_words(double torque);
std::string corner_words(const GearPairParameters& of);
std::string pair_words(const StaticResult& s);

// Words as they stand, in a text in which gnuplot reads marks such as '_' (subscript).
std::string without_markup(const std::string& words);

// What gnuplot reads: '#' lines with title, notes and columns, then the blocks, two empty lines between them.
std::string plot_data(const Figure& figure);

// The numbers of a figure: what a table says is its own file for pandas.read_csv(sep="\t", comment="#") and others: '#' lines
// with title, scenes, notes and sources, one line of column names, one line for each row. The first has no name and is the
// figure's main one.
struct FigureTable {
  std::string name, text;
};
std::vector<FigureTable> tables(const Figure& figure, const std::vector<std::string>& sources);

// As files: <output>.tsv, and <output>-<name>.tsv for those after the first.
std::vector<FileBytes> table_files(const Figure& figure, const std::string& output,
                                   const std::vector<std::string>& sources);

}  // namespace whine
