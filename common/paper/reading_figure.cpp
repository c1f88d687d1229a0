#include "paper/reading_figure.h"

#include <algorithm>
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
constexpr const char* kKinds[] = {"none", "to 0.5° at most", "to 0.5 ... 5°", "any angle"};

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
  for (auto& [kind, block] : kinds) figure.blocks.push_back(std::move(block));
  for (int kind = 0; kind < 4; ++kind) {
    figure.numbers.emplace_back(text("drawn_", kind), kinds.contains(kind) ? 1 : 0);
    figure.words.emplace_back(text("kind_", kind), kKinds[kind]);
  }
  FigureBlock sets{"sets", {"place [1]", "share_satisfied [%]", "readings_with_all [1]"}, {}};
  double place = 0;
  for (const SetFound& s : found.sets) {
    sets.rows.push_back({++place, 100.0 * (s.size - static_cast<double>(s.failing.size())) / s.size,
                         static_cast<double>(s.readings)});
    figure.words.emplace_back(text("set_", static_cast<int>(place)), s.set.name);
    figure.words.emplace_back(text("held_", static_cast<int>(place)),
                              s.readings > 0 ? text(s.readings, " readings")
                                             : text("none: ", s.size - s.failing.size(), " of ", s.size));
  }
  figure.blocks.push_back(sets);
  figure.numbers.emplace_back("sets", place);
  figure.numbers.emplace_back("ratio_from", least - 0.03);
  figure.numbers.emplace_back("ratio_to", std::max(most, 1.77) + 0.03);
  figure.numbers.emplace_back("table1_ratio", std::pow(3040.0 / 2480.0, 2));
  figure.numbers.emplace_back("fig15_from", 1.74);
  figure.numbers.emplace_back("fig15_to", 1.77);
  return figure;
}

}  // namespace whine
