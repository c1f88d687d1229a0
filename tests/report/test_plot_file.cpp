// The numbers of figures as files: one table a file with one line of names, and what gnuplot reads.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/error.h"
#include "io/publish.h"
#include "own_folder.h"
#include "refusal.h"
#include "relative.h"
#include "report/figure_list.h"
#include "report/figures.h"
#include "report/gnuplot.h"
#include "report/plot_file.h"
#include "report/wireframe.h"

using namespace whine;

namespace {

Figure some_figure() {
  Figure figure;
  figure.title = "Title";
  figure.scenes = {"pair: a # in a title"};
  figure.blocks = {{"outline", {"x [mm]", "y [mm]"}, {{0, 0}, {}, {1, 1}}, "", "", true},
                   {"a up", {"x [m]", "y [N]"}, {{1, 2}, {}, {3, 0.1}}, "curves", "up # 1"},
                   {"a up marks", {"x [m]"}, {{5}}, "marks", "up"},
                   {"a down", {"x [m]", "y [N]"}, {{1, 3}}, "curves", "down"},
                   {"a down marks", {"x [m]"}, {}, "marks", "down"},
                   {"two words", {"z [1]"}, {{7}}}};
  return figure;
}

}  // namespace

TEST_CASE("numbers of tables: what rounds to 0 has no sign") {
  CHECK(fixed(-4e-5, 4) == "0.0000");
  CHECK(fixed(-6e-5, 4) == "-0.0001");
  CHECK(fixed(-0.0, 1) == "0.0");
  CHECK(fixed(-10.04, 1) == "-10.0");
  CHECK(fixed(-0.2, 0) == "0");
  CHECK(rounded(-0.004, 2) == "0");
  CHECK(rounded(-0.006, 2) == "-0.01");
}

TEST_CASE("plot data: blocks stand two empty lines apart under their names; what is not finite is rejected") {
  Figure figure;
  figure.title = "Title";
  figure.blocks = {{"a", {"x [m]", "y [N]"}, {{1, 2}, {}, {3, 0.1}}}, {"b", {"x [m]"}, {{5}}}};
  CHECK(plot_data(figure) == "# Title\n\n\n# [a]\n# x [m]\ty [N]\n1\t2\n\n3\t0.1\n\n\n# [b]\n# x [m]\n5\n");
  figure.blocks[1].rows[0][0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(failure_of([&] { plot_data(figure); }) == Failure::numerical);
  CHECK(failure_of([&] { tables(figure, {}); }) == Failure::numerical);
}

TEST_CASE("tables: one a file, one line of names, as many cells in each line; drawings are in none") {
  const std::vector<FigureTable> found = tables(some_figure(), {"out/x.h5"});
  const std::string head = "# Title\n# scene pair: a # in a title\n# from out/x.h5\n";
  REQUIRE(found.size() == 3);
  CHECK(found[0].name == "");
  CHECK(found[0].text == head + "curve\tx [m]\ty [N]\nup   1\t1\t2\nup   1\t3\t0.1\ndown\t1\t3\n");
  CHECK(found[1].name == "marks");
  CHECK(found[1].text == head + "curve\tx [m]\nup\t5\n");
  CHECK(found[2].name == "two-words");
  CHECK(found[2].text == head + "z [1]\n7\n");
  // As pandas.read_csv(sep="\t", comment="#") sees it: '#' begins a comment wherever it stands.
  for (const FigureTable& table : found) {
    std::istringstream lines(table.text);
    std::ptrdiff_t tabs = -1;
    for (std::string line; std::getline(lines, line);) {
      if (line[0] == '#') continue;
      CHECK(!contains(line, "#"));
      const auto here = std::count(line.begin(), line.end(), '\t');
      if (tabs < 0) tabs = here;
      CHECK(here == tabs);
    }
  }
  Figure figure = some_figure();
  figure.blocks[3].columns[1] = "y [kN]";
  CHECK(failure_of([&] { tables(figure, {}); }) == Failure::numerical);
}

TEST_CASE(
    "Harris map: the best relief follows the cusp between the reliefs of the map; its table is one for all maps") {
  HarrisMapResult map;
  map.torque =
      Eigen::VectorXd::LinSpaced(12, 20, 160);  // the best relief of 20 N m is beside an end of the grid
  map.relief = Eigen::VectorXd::LinSpaced(30, 0, 15e-6);
  map.relieved = Relieved::both;
  map.shape = ReliefShape::linear;
  map.design_torque = 100;
  map.length = map.optimum_relief = map.optimum_peak_to_peak = Eigen::VectorXd::Constant(1, 3e-6);
  map.start_roll = map.cusp = MatrixRM::Zero(1, map.torque.size());
  map.unrelieved = Eigen::VectorXd::Zero(map.torque.size());
  // Less steep above the best relief than below it, which is 70 nm for each N m.
  MatrixRM values(map.torque.size(), map.relief.size());
  for (Eigen::Index t = 0; t < values.rows(); ++t)
    for (Eigen::Index r = 0; r < values.cols(); ++r) {
      const double beyond = map.relief[r] - 70e-9 * map.torque[t];
      values(t, r) = 1e-7 + (beyond > 0 ? 0.5 : -1.0) * beyond;
    }
  map.peak_to_peak = {values};
  for (auto& harmonic : map.harmonic) harmonic = {values};
  const Figure figure = harris_map_figure(map);
  for (const FigureBlock& block : figure.blocks)
    if (block.name == "best relief")
      for (const auto& row : block.rows) CHECK(row[0] == relative(0.07 * row[1], 1e-9));
  const auto found = tables(figure, {});
  REQUIRE(found.size() == 4);
  CHECK(contains(
      found[0].text,
      "\nrelief [µm]\ttorque [N m]\tpeak to peak [µm]\tharmonic 1 [µm]\tharmonic 2 [µm]\tharmonic 3 [µm]\trelief_low [µm]\trelief_high [µm]\ttorque_low [N m]\ttorque_high [N m]\n0\t20\t"));
  CHECK(std::count(found[0].text.begin(), found[0].text.end(), '\n') ==
        static_cast<std::ptrdiff_t>(figure.notes.size() + 2) + map.torque.size() * map.relief.size());
  // A relief that hardly helps: values within half a per cent over a range of places, the least of them by chance.
  HarrisMapResult flat = map;
  for (Eigen::Index t = 0; t < values.rows(); ++t)
    for (Eigen::Index r = 0; r < values.cols(); ++r) {
      const double beyond =
          std::abs(static_cast<double>(r) - 14.5) - 5;  // places 10 to 19 are within the range
      values(t, r) =
          1e-5 * (1 + (beyond > 0 ? 0.02 * beyond : 1e-3 * static_cast<double>((7 * t + 3 * r) % 4)));
    }
  flat.peak_to_peak = {values};
  for (const FigureBlock& block : harris_map_figure(flat).blocks)
    if (block.name == "best relief")
      for (const auto& row : block.rows) CHECK(row[0] == relative(7.5, 0.02));
}

TEST_CASE(
    "simplified strokes: ends stay, no point is farther off than the tolerance, the pen lifts as before") {
  Strokes arc;
  for (int i = 0; i <= 1000; ++i) arc.push_back({std::cos(1e-3 * i), std::sin(1e-3 * i)});
  arc.emplace_back();
  arc.push_back({0, 0});
  arc.push_back({1, 0});
  arc.push_back({2, 0});
  const double tolerance = 1e-3;
  const Strokes few = simplified(arc, tolerance);
  const auto lift = std::find_if(few.begin(), few.end(), [](const auto& row) { return row.empty(); });
  REQUIRE(few.end() - lift == 3);
  CHECK(lift[1] == std::vector<double>{0, 0});
  CHECK(lift[2] == std::vector<double>{2, 0});
  CHECK(few.front() == arc.front());
  CHECK(lift[-1] == arc[1000]);
  // A chord of an arc stands off by 1 - cos of half its angle: 12 chords of 1/12 rad by 0.9e-3; halving makes a power of two.
  CHECK(lift - few.begin() == 17);
  CHECK(simplified(arc, 0.0).size() >= arc.size() - 1);
  CHECK(simplified({}, tolerance).empty());
}

TEST_CASE("plot file: gnuplot reads the data of a figure from no disk, again and again") {
  const TemporaryFolder folder;
  const std::string recipe = folder / "a.gp";
  std::ofstream(recipe) << "set datafile separator tab\nstats tsv index \"[a up]\" using 1:2 nooutput\n"
                           "if (STATS_max_y != 2) { exit status 1 }\n"
                           "plot tsv index \"[a up]\" using 1:2, tsv index \"[a down]\" using 1:2\n";
  const Figure figure = some_figure();
  const PlotFile data(figure);
  CHECK(contains(draw(figure, data.path(), recipe, Picture::svg), "</svg>"));
  CHECK(draw(figure, data.path(), recipe, Picture::svg) == draw(figure, data.path(), recipe, Picture::svg));
  publish_all(table_files(figure, folder / "figure", {}));
  for (const char* name : {"figure.tsv", "figure-marks.tsv", "figure-two-words.tsv"})
    CHECK(std::filesystem::exists(folder / name));
}
