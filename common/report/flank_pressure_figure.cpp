#include "report/flank_pressure_figure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/units.h"
#include "gear/pair.h"
#include "report/figure_words.h"
#include "report/response_figures.h"

namespace whine {
namespace {

using Eigen::Index;

void require_pressures(const StaticResult& s, const std::vector<ResponseResult>& sweeps) {
  if (sweeps.size() != 2 || sweeps[0].direction == sweeps[1].direction)
    fail(Failure::input, "flank-pressure: it needs two response.h5 beside static.h5, up and down; ",
         sweeps.size(), " given");
  for (const ResponseResult& r : sweeps) {
    if (r.torque != s.torque)
      fail(Failure::input, "flank-pressure: a response.h5 of ", r.torque, " N m; static.h5 is of ", s.torque,
           " N m; give both of one torque");
    if (r.flank_pressure.size() == 0 || r.flank_pressure_sustained.size() != r.mesh_frequency.size())
      fail(Failure::input, "flank-pressure: the response.h5 of the sweep ", r.direction,
           " holds no flank pressure, which lumped models do not have");
  }
}

// deg: of the driver where a pair at this phase would touch on the line of action, so that places beyond its ends, where tip edges
// touch, stand apart.
double nominal_roll(const GearPair& pair, double phase) {
  return pair.nominal_roll(0, phase * pair.base_pitch()) * kInDegrees;
}

FigureBlock map_block(const ResponseResult& r, const GearPair& pair) {
  FigureBlock block{text("map ", r.direction),
                    {"roll_" + r.mesh.gear[0] + " [deg]", "roll_" + r.mesh.gear[1] + " [deg]",
                     "pair_phase [1]", "mesh_frequency [Hz]", "pressure [MPa]", "load over a tip edge [N]",
                     "roll_" + r.mesh.gear[0] + " on the line of action [deg]"},
                    {},
                    "map",
                    name_of(r.direction)};
  for (Index f = 0; f < r.mesh_frequency.size(); ++f)
    for (Index k = 0; k < r.pair_phase.size(); ++k)
      block.rows.push_back({r.flank_roll(k, 0) * kInDegrees, r.flank_roll(k, 1) * kInDegrees, r.pair_phase[k],
                            r.mesh_frequency[f], r.flank_pressure(f, k) * kInMegapascals,
                            r.edge_load_there(f, k), nominal_roll(pair, r.pair_phase[k])});
  return block;
}

FigureBlock pressure_block(const ResponseResult& r, const ResponseResult& other) {
  FigureBlock block{text("speed ", r.direction),
                    {"mesh_frequency [Hz]", "pressure [MPa]", "edge_load_" + r.mesh.gear[0] + " [N]",
                     "edge_load_" + r.mesh.gear[1] + " [N]"},
                    {},
                    "speed",
                    name_of(r.direction)};
  const std::vector<bool> broken = broken_after(r, &other);
  for (Index f = 0; f < r.mesh_frequency.size(); ++f) {
    block.rows.push_back({r.mesh_frequency[f], r.flank_pressure_sustained[f] * kInMegapascals,
                          r.edge_load(f, 0), r.edge_load(f, 1)});
    if (broken[static_cast<size_t>(f)]) block.rows.emplace_back();
  }
  return block;
}

// 1: largest difference of the two maps over the largest pressure; infinity for other speeds.
double difference(const ResponseResult& up, const ResponseResult& down) {
  const Index speeds = up.mesh_frequency.size();
  if (down.mesh_frequency.size() != speeds || down.flank_pressure.cols() != up.flank_pressure.cols())
    return std::numeric_limits<double>::infinity();
  double off = 0;
  for (Index f = 0; f < speeds; ++f) {
    if (up.mesh_frequency[f] != down.mesh_frequency[speeds - 1 - f])
      return std::numeric_limits<double>::infinity();
    off = std::max(
        off, (up.flank_pressure.row(f) - down.flank_pressure.row(speeds - 1 - f)).cwiseAbs().maxCoeff());
  }
  const double most = std::max(up.flank_pressure.maxCoeff(), down.flank_pressure.maxCoeff());
  return most > 0 ? off / most : std::numeric_limits<double>::infinity();
}

}  // namespace

Figure flank_pressure_figure(const StaticResult& s, const std::vector<ResponseResult>& given) {
  require_pressures(s, given);
  const bool in_order = given[0].direction == Direction::up;
  const ResponseResult &up = given[in_order ? 0 : 1], &down = given[in_order ? 1 : 0];
  constexpr double kAlike = 0.01;
  const bool both = difference(up, down) > kAlike;
  Figure figure;
  figure.title = "Flank pressure (MPa) and loads over tip edges (N), " + torque_words(s.torque);
  figure.height = both ? 1200 : 900;
  figure.shafts = shafts_of(s);
  const FlankPressure& rest = s.flank_pressure;
  const GearPair pair(s);
  figure.blocks.push_back(map_block(up, pair));
  if (both) figure.blocks.push_back(map_block(down, pair));
  double largest = 0, edge = 0;
  for (const ResponseResult* r : {&up, &down}) {
    figure.blocks.push_back(pressure_block(*r, r == &up ? down : up));
    largest = std::max({largest, r->flank_pressure.maxCoeff(), r->flank_pressure_sustained.maxCoeff()});
    if (r->edge_load.size() > 0) edge = std::max(edge, r->edge_load.maxCoeff());
  }
  const std::string all[] = {
      "pressure inside the flanks, by Hertz's law of the load that a pair sustains for 1/64 of a mesh period; largest over the mesh periods" +
          (rest.smooth > 0 ? "; at rest, by strips, " + shown(rest.smooth * kInMegapascals, 4) + " MPa" : ""),
      text("grey: sustained over a tip edge, whose pressure is singular and stated as a load (",
           both ? "d" : "c", "); white: no load is sustained; grey lines: ends of the line of action"),
      both ? "the map of falling speed differs from that of rising speed"
           : "falling speed has the same map within 1 % of the largest pressure"};
  for (const std::string& note : all)
    for (std::string& line : in_lines(note)) figure.notes.push_back(std::move(line));
  add_lines(figure.notes.size(), figure);
  constexpr int kLine = 24, kUsual = 3;
  figure.height += kLine * std::max(0, static_cast<int>(figure.notes.size()) - kUsual);
  const Eigen::VectorXd roll =
      up.pair_phase.unaryExpr([&](double phase) { return nominal_roll(pair, phase); });
  const Index last = roll.size() - 1;
  // Between places side by side; beyond the line of action some may be left out.
  const double step = last > 0 ? (roll.tail(last) - roll.head(last)).minCoeff() : 1;
  figure.words.emplace_back("labels", quoted_labels({s.mesh.gear[0], s.mesh.gear[1]}));
  figure.numbers = {
      {"both", both ? 1.0 : 0.0},
      {"roll_from", roll[0]},
      {"roll_to", roll[last]},
      {"roll_step", step},
      {"path_from", nominal_roll(pair, pair.path_start() / pair.base_pitch())},
      {"path_to", nominal_roll(pair, pair.path_end() / pair.base_pitch())},
      {"speed_step",
       up.mesh_frequency.size() > 1 ? std::abs(up.mesh_frequency[1] - up.mesh_frequency[0]) : 0},
      {"pressure_max", largest > 0 ? largest * kInMegapascals : 1},
      {"pressure_rest", rest.smooth * kInMegapascals},
      {"edge_max", edge},
      {"frequency_from", up.mesh_frequency.minCoeff()},
      {"frequency_to", up.mesh_frequency.maxCoeff()},
      {"notes", static_cast<double>(figure.notes.size())},
      {"natural_frequency", up.natural_frequency}};
  return figure;
}

}  // namespace whine
