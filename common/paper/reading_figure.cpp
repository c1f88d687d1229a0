#include "paper/reading_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/units.h"

namespace whine {
namespace {

// Four kinds of corner rule can be told apart in one panel.
int kind_of(const CornerRule& rule) {
  if (!rule.enabled) return 0;
  return rule.largest_angle <= 0.5 * kOneDegree ? 1 : rule.largest_angle <= 5 * kOneDegree ? 2 : 3;
}
constexpr const char* kKinds[] = {"no corner contact", "corner contact to 0.5° at most",
                                  "corner contact to 0.5 ... 5°", "corner contact at any angle"};

}  // namespace

Figure reading_figure(const ReadingsResult& a, const Consistency& found) {
  Figure figure;
  figure.title = text(a.readings.size(), " readings of what P2000 leaves open");
  figure.notes = {text("bore, inertia and damping (7 %) fitted in each; sweeps with contact lines; at most ",
                       found.agreeing[found.order.front()], " claims agree in one reading")};
  std::map<int, FigureBlock> kinds;
  double least = 1e9, most = 0;
  for (size_t i = 0; i < a.readings.size(); ++i) {
    const Reading& r = a.readings[i];
    const int kind = kind_of(r.choices.corner);
    FigureBlock& block = kinds[kind];
    block.name = text("corner_", kind);
    block.columns = {"level_ratio [1]", "agreeing_claims [1]", "first_harmonic [1]"};
    block.rows.push_back({r.level_ratio, static_cast<double>(found.agreeing[i]), r.first_harmonic});
    least = std::min(least, r.level_ratio);
    most = std::max(most, r.level_ratio);
  }
  constexpr double kTable1 = 3040.0 / 2480.0;  // of frequencies
  FigureBlock fifteen{"Figure 15", {"from", "to"}, {{1.74, 1.77}}, "", "", true};
  Panel agreeing{
      .x = {.label = "Mesh stiffness with two pairs over that with one, 100 N m",
            .from = least - 0.03,
            .to = std::max(most, 1.77) + 0.03},
      .y = {.label = "Claims of P2000 that agree", .from_zero = true},
      .curves = {{.block = fifteen.name, .style = PanelStyle::spans, .colour = kLight, .label = "Figure 15"}},
      .rules = {{'x', kTable1 * kTable1, "Table 1"}},
      .key = PanelKey::below,
      .height = 620};
  constexpr std::array kMarks{7, 5, 9, 13};
  constexpr std::array kColours{kBlue, kGreen, kOrange, kVermilion};
  for (auto& [kind, block] : kinds) {
    const auto k = static_cast<size_t>(kind);
    agreeing.curves.push_back({.block = block.name,
                               .style = PanelStyle::points,
                               .colour = kColours.at(k),
                               .label = kKinds[k],
                               .mark = kMarks.at(k),
                               .size = 0.7});
    figure.blocks.push_back(std::move(block));
  }
  FigureBlock sets{"sets", {"place [1]", "share_satisfied [%]", "readings_with_all [1]"}, {}};
  Panel together{.x = {.label = "Satisfied in the closest reading (%)", .from = 0, .to = 100},
                 .curves = {{.block = sets.name,
                             .style = PanelStyle::rows,
                             .colour = kGrey,
                             .label = "no reading with all",
                             .width = 0.7},
                            {.block = sets.name,
                             .style = PanelStyle::rows,
                             .label = "readings with all",
                             .width = 0.7,
                             .where = 3}},
                 .key = PanelKey::below};
  double place = 0;
  for (const SetFound& s : found.sets) {
    sets.rows.push_back({++place, 100.0 * (s.size - static_cast<double>(s.failing.size())) / s.size,
                         static_cast<double>(s.readings)});
    together.y.names.push_back(
        without_markup(s.set.name) + ": " +
        (s.readings > 0 ? text(s.readings, " readings") : text(s.size - s.failing.size(), " of ", s.size)));
  }
  figure.blocks.insert(figure.blocks.end(), {sets, fifteen});
  figure.panels = {agreeing, together};
  figure.columns = 2;
  return figure;
}

}  // namespace whine
