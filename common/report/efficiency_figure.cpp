#include "report/figure_list.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/error.h"
#include "gear/friction.h"
#include "gear/iso6336_strength.h"
#include "report/figure_words.h"
#include "report/response_figures.h"
#include "signal/response.h"

namespace whine {
namespace {

const ResponseResult& sweep_at(const std::vector<ResponseResult>& sweeps, double torque,
                               Direction direction) {
  const ResponseResult* found = nullptr;
  for (const ResponseResult& r : sweeps) {
    if (r.torque != torque || r.direction != direction) continue;
    if (found) fail(Failure::input, "efficiency: two sweeps ", direction, " at ", torque, " N m; give one");
    found = &r;
  }
  if (!found)
    fail(Failure::input, "efficiency: no response.h5 of the sweep ", direction, " at ", torque,
         " N m, of which there is a static.h5; give both sweeps of each torque");
  if (found->friction.power.size() != found->mesh_frequency.size() || found->friction.power.size() == 0)
    fail(Failure::input, "efficiency: the response.h5 of the sweep ", direction, " at ", torque,
         " N m holds no losses by friction; the scene needs a section [friction]");
  return *found;
}

// rest: of the same torque. Its loss goes with the coefficient at each speed: what a motion without vibration would lose.
FigureBlock efficiency_block(const std::string& name, const ResponseResult& r, const ResponseResult& other,
                             const StaticResult& rest) {
  FigureBlock block{
      name,
      {"mesh_frequency [Hz]", "efficiency [%]", "friction_power [W]", "friction_coefficient [1]",
       "loss_factor [1]", "efficiency_without_vibration [%]", "beyond_backlash [1]"},
      {},
      text("speed-T", shown(r.torque, 6)),
      name_of(r.direction)};
  const std::vector<bool> broken = broken_after(r, &other);
  const double loss = (1 - rest.efficiency) / rest.friction_coefficient;
  for (Eigen::Index i = 0; i < r.mesh_frequency.size(); ++i) {
    block.rows.push_back({r.mesh_frequency[i], r.friction.efficiency[i] * 100, r.friction.power[i],
                          r.friction.coefficient[i], r.loss_factor.size() > 0 ? r.loss_factor[i] : 0,
                          (1 - loss * r.friction.coefficient[i]) * 100, beyond_backlash(r, i) ? 1.0 : 0.0});
    if (broken[static_cast<size_t>(i)]) block.rows.emplace_back();
  }
  return block;
}

// Drawn only: the efficiency at rest is the same on all branches, so that its curve has no gap where a sweep jumps.
FigureBlock unbroken_rest(const std::string& name, const FigureBlock& speeds) {
  constexpr size_t kAtRest = 5;
  FigureBlock block{name, {speeds.columns.front(), speeds.columns[kAtRest]}, {}, "", "", true};
  block.rows.reserve(speeds.rows.size());
  for (const std::vector<double>& row : speeds.rows)
    if (!row.empty()) block.rows.push_back({row.front(), row[kAtRest]});
  return block;
}

std::optional<double> rigid_loss_factor(const GearPair& pair) {
  try {
    return loss_factor_of_rigid_teeth(pair);
  } catch (const Error& error) {
    if (error.kind() != Failure::input && error.kind() != Failure::numerical) throw;
  }
  return {};
}

// Where Schlenk's formula is beyond its tests.
std::vector<std::string> beyond_schlenk(const GearPair& pair, const std::vector<StaticResult>& statics,
                                        const Eigen::VectorXd& mesh_frequency) {
  std::vector<std::string> out;
  const double per_frequency = pitch_line_speed(pair, 1);
  const auto say = [&](const char* beyond, double speed, const char* which) {
    out.push_back(text(beyond, speed, " m/s on the pitch line, a mesh frequency of ",
                       fixed(speed / per_frequency, 0), " Hz, the coefficient is that at ", speed,
                       " m/s, where the tests of Schlenk's formula ", which));
  };
  if (mesh_frequency.minCoeff() * per_frequency < kSchlenkSpeeds[0])
    say("below ", kSchlenkSpeeds[0], "begin");
  if (mesh_frequency.maxCoeff() * per_frequency > kSchlenkSpeeds[1]) say("above ", kSchlenkSpeeds[1], "end");
  std::string light;
  for (const StaticResult& s : statics)
    if (line_load(pair, s.face_width(), s.torque) < kSchlenkLoad)
      light += text(light.empty() ? "" : ", ", torque_words(s.torque));
  if (!light.empty())
    out.push_back(text("at ", light, " the coefficient is that of ", kSchlenkLoad,
                       " N/mm, where the tests of Schlenk's formula begin"));
  return out;
}

// Moments and loss of friction at rest over the first mesh period, closed.
FigureBlock friction_cycle(const StaticResult& first) {
  FigureBlock cycle{"cycle",
                    {"mesh_phase [1]", "friction_moment_driver [N m]", "friction_moment_driven [N m]",
                     "friction_loss [N m]"},
                    {},
                    "cycle",
                    ""};
  const Eigen::Index positions = std::min<Eigen::Index>(first.contact.positions, first.friction_loss.size());
  for (Eigen::Index i = 0; i <= positions; ++i) {
    const Eigen::Index at = i % positions;
    cycle.rows.push_back({first.mesh_phase[at] + (i == positions ? 1.0 : 0.0), first.friction_moment[0][at],
                          first.friction_moment[1][at], first.friction_loss[at]});
  }
  return cycle;
}

// The efficiency or the power lost over speed at each torque.
Panel loss_panel(const std::vector<StaticResult>& statics, double natural_frequency, bool efficiency,
                 bool beyond) {
  Panel panel{.heading = efficiency ? "efficiency of the mesh, friction alone; dotted: without vibration"
                                    : "mean power that friction takes",
              .x = {.label = "Mesh frequency (Hz)", .speed = true},
              .y = {.label = efficiency ? "Efficiency (%)" : "Power lost (W)", .from_zero = !efficiency},
              .rules = {{'x', natural_frequency, "f_n"}},
              .height = 270};
  for (size_t t = 0; t < statics.size(); ++t) {
    const auto name = [&](const char* what) { return text(t + 1, " ", what); };
    const int colour = curve_colour(t), y = efficiency ? 2 : 3;
    panel.curves.push_back({.block = name("up"),
                            .y = y,
                            .colour = colour,
                            .label = torque_words(statics[t].torque),
                            .width = 2});
    panel.curves.push_back({.block = name("down"), .y = y, .colour = colour, .width = 2, .dash = 3});
    if (efficiency)
      panel.curves.push_back({.block = name("rest"), .colour = colour, .width = 2.2, .dash = 4});
    for (const char* way : {"up", "down"})
      if (beyond)
        panel.curves.push_back({.block = name(way),
                                .y = y,
                                .style = PanelStyle::points,
                                .colour = kBlack,
                                .mark = 6,
                                .where = 7});
  }
  panel.curves.push_back({.colour = kDark, .label = "dashed: falling", .dash = 3});
  if (beyond)
    panel.curves.push_back(
        {.style = PanelStyle::points, .colour = kBlack, .label = "beyond backlash", .mark = 6});
  return panel;
}

Panel friction_panel(const StaticResult& first) {
  Panel panel{.heading = text(
                  "at rest, ", torque_words(first.torque),
                  ": moments of friction about the axes, positive where they act as the normal force does"),
              .x = {.label = "Mesh phase (mesh periods)", .from = 0, .to = 1},
              .y = {.label = "Moment (N m)"},
              .rules = {{.axis = 'y', .dash = 1}},
              .height = 230};
  for (int g = 0; g < kSides; ++g)
    panel.curves.push_back({.block = "cycle",
                            .y = g + 2,
                            .colour = curve_colour(g),
                            .label = without_markup(short_name(first.mesh.gear[g]))});
  panel.curves.push_back(
      {.block = "cycle", .y = 4, .colour = kDark, .label = "work lost per angle", .dash = 4});
  return panel;
}

}  // namespace

Figure efficiency_figure(const std::vector<StaticResult>& statics,
                         const std::vector<ResponseResult>& sweeps) {
  constexpr size_t kMostTorques = 6;
  if (statics.empty() || statics.size() > kMostTorques || sweeps.size() != 2 * statics.size())
    fail(Failure::input, "efficiency: it needs static.h5 and two response.h5, up and down, at each of 1 to ",
         kMostTorques, " torques; given are ", statics.size(), " and ", sweeps.size());
  const StaticResult& first = statics[0];
  if (first.friction_loss.size() == 0)
    fail(Failure::input, "efficiency: static.h5 holds no friction; the scene needs a section [friction]");
  const GearPair pair(first);
  const std::optional<double> rigid = rigid_loss_factor(pair);
  Figure figure;
  figure.title = "Losses by friction";
  FigureBlock rest{"rest",
                   {"torque [N m]", "friction_coefficient [1]", "efficiency [%]", "loss_factor [1]"},
                   {},
                   "rest",
                   ""};
  if (rigid) rest.columns.emplace_back("loss_factor_rigid [1]");
  std::string at_rest, factors, beyond;
  for (size_t t = 0; t < statics.size(); ++t) {
    const StaticResult& s = statics[t];
    const std::array<const ResponseResult*, 2> both{&sweep_at(sweeps, s.torque, Direction::up),
                                                    &sweep_at(sweeps, s.torque, Direction::down)};
    if (const std::string speeds = speeds_beyond_backlash({both[0], both[1]}); !speeds.empty())
      beyond += text(beyond.empty() ? "" : "; ", "at ", torque_words(s.torque), ": ", speeds, " Hz");
    for (const size_t way : {0, 1}) {
      const ResponseResult& r = *both[way];
      figure.blocks.push_back(efficiency_block(text(t + 1, " ", r.direction), r, *both[1 - way], s));
    }
    figure.blocks.push_back(unbroken_rest(text(t + 1, " rest"), figure.blocks.back()));
    rest.rows.push_back({s.torque, s.friction_coefficient, s.efficiency * 100, s.loss_factor});
    if (rigid) rest.rows.back().push_back(*rigid);
    at_rest += text(t ? ", " : "", fixed(s.efficiency * 100, 3), " % at ", torque_words(s.torque),
                    " (coefficient ", fixed(s.friction_coefficient, 4), ")");
    factors += text(t ? ", " : "", fixed(s.loss_factor, 4));
  }
  figure.blocks.push_back(friction_cycle(first));
  figure.blocks.push_back(rest);
  figure.notes = {"friction between the flanks alone: " + in_words(first.mesh.friction),
                  text("at rest (kinematics",
                       first.mesh.friction.law == FrictionLaw::schlenk
                           ? text(", coefficient at ", shown(first.mesh.friction.static_frequency, 6), " Hz")
                           : "",
                       "): ", at_rest),
                  text("loss factor H_V at rest, without the coefficient: ", factors,
                       rigid ? text("; of rigid teeth ", fixed(*rigid, 4)) : "")};
  if (!beyond.empty())
    for (std::string& line : in_lines(
             "rings: the motion goes beyond the backlash, friction of back flanks is left out; " + beyond))
      figure.notes.push_back(std::move(line));
  const ResponseResult& up = sweep_at(sweeps, first.torque, Direction::up);
  if (first.mesh.friction.law == FrictionLaw::schlenk) {
    const std::vector<std::string> untested = beyond_schlenk(pair, statics, up.mesh_frequency);
    figure.notes.insert(figure.notes.end(), untested.begin(), untested.end());
  }
  figure.shafts = shafts_of(first);
  figure.panels = {loss_panel(statics, up.natural_frequency, true, !beyond.empty()),
                   loss_panel(statics, up.natural_frequency, false, !beyond.empty()), friction_panel(first)};
  return figure;
}

}  // namespace whine
