#include "report/figure_list.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>

#include "base/error.h"
#include "report/figure_words.h"
#include "report/study_axes.h"

namespace whine {
namespace {

using Eigen::Index;

constexpr size_t kFewLevels = 6;  // have a colour and a mark each

// From indigo by blue, green and yellow to dark red: as many hues as there are levels to be told apart, in the order of values.
double colour(double share) {
  static const int stops[kFewLevels][3] = {{0x33, 0x22, 0x88}, {0x00, 0x84, 0xc8}, {0x00, 0x96, 0x50},
                                           {0xc9, 0xa4, 0x00}, {0xe8, 0x62, 0x10}, {0xa0, 0x10, 0x30}};
  constexpr int kLast = static_cast<int>(kFewLevels) - 1;
  const double at = std::clamp(share, 0.0, 1.0) * kLast;
  const int i = std::min(kLast - 1, static_cast<int>(at));
  double rgb = 0;
  for (int c = 0; c < 3; ++c)
    rgb = rgb * 256 + std::round(stops[i][c] + (at - i) * (stops[i + 1][c] - stops[i][c]));
  return rgb;
}

// gnuplot's filled marks, each other in form, for those who cannot tell the colours.
double mark(size_t place) {
  constexpr int kMarks[kFewLevels] = {7, 5, 9, 13, 11, 15};
  return kMarks[place % kFewLevels];
}

// Response quantities that the figure has room for: those that do not vary at all leave their row to others that were
// gathered, if the study did not choose them itself.
struct ShownQuantities {
  std::vector<std::string> rows, constant;
};

ShownQuantities shown_quantities(const StudyResult& a) {
  const auto varies = [&](const std::string& name) {
    double least = 0, most = 0;
    bool any = false;
    for (size_t v = 0; v < a.variants.size(); ++v) {
      if (!a.rejection[v].empty()) continue;
      const double value = a.quantity(static_cast<Index>(v), quantity_of(a, name));
      least = any ? std::min(least, value) : value;
      most = any ? std::max(most, value) : value;
      any = true;
    }
    constexpr double kRoundOff = 1e-9;
    return most - least > kRoundOff * std::max(std::abs(least), std::abs(most));
  };
  const std::vector<std::string>& wanted = a.plan.figure_quantities;
  ShownQuantities out;
  for (const std::string& name : wanted) (varies(name) ? out.rows : out.constant).push_back(name);
  const bool chosen = wanted.size() > a.plan.quantities.size() ||
                      !std::equal(wanted.begin(), wanted.end(), a.plan.quantities.begin());
  for (size_t i = wanted.size(); !chosen && i < a.plan.quantities.size() && out.rows.size() < wanted.size();
       ++i)
    if (varies(a.plan.quantities[i])) out.rows.push_back(a.plan.quantities[i]);
  if (out.rows.empty()) {
    out.rows.push_back(wanted.front());
    out.constant.erase(out.constant.begin());
  }
  return out;
}

std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<size_t> order(values.size());
  std::iota(order.begin(), order.end(), size_t(0));
  std::sort(order.begin(), order.end(), [&](size_t i, size_t j) { return values[i] < values[j]; });
  std::vector<double> rank(values.size());
  for (size_t i = 0; i < order.size();) {
    size_t end = i;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    for (size_t j = i; j < end; ++j) rank[order[j]] = 0.5 * static_cast<double>(i + end - 1);
    i = end;
  }
  return rank;
}

// By linear interpolation between the sorted values.
double percentile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<size_t>(at);
  return i + 1 < sorted.size() ? sorted[i] + (at - static_cast<double>(i)) * (sorted[i + 1] - sorted[i])
                               : sorted[i];
}

FigureBlock table_of(const StudyResult& a, const std::vector<StudyAxis>& axes) {
  FigureBlock table{"variants", {"variant [1]", "outside_model [1]", "unsteady speeds [1]"}, {}};
  for (const VariedKey& key : a.plan.keys)
    table.columns.push_back(key.name +
                            (key.number ? " [" + key.scene_units + "]" : " [place in the list above]"));
  std::vector<double> scale;
  for (const std::string& name : a.plan.quantities) {
    const ShownUnit unit = shown_units(kind_of(a, name).units);
    table.columns.push_back(name + " [" + (*unit.units ? unit.units : "1") + "]");
    scale.push_back(unit.scale);
  }
  for (size_t v = 0; v < a.variants.size(); ++v) {
    std::vector<double> row{static_cast<double>(v), a.rejection[v].empty() ? 0.0 : 1.0,
                            static_cast<double>(a.unsteady[static_cast<Index>(v)])};
    for (const StudyAxis& axis : axes) row.push_back(axis.at[v]);
    for (size_t i = 0; i < scale.size(); ++i)
      row.push_back(a.quantity(static_cast<Index>(v), static_cast<Index>(i)) * scale[i]);
    table.rows.push_back(row);
  }
  return table;
}

// Response quantities that are the same in all variants, as words; "" if there are none.
std::string constant_words(const StudyResult& a, const ShownQuantities& quantities) {
  std::string words;
  if (!quantities.constant.empty()) {
    words = "the same in all variants, without a panel:";
    for (size_t i = 0; i < quantities.constant.size(); ++i) {
      const std::string& name = quantities.constant[i];
      const auto drawn = std::find(a.rejection.begin(), a.rejection.end(), "") - a.rejection.begin();
      const ShownUnit unit = shown_units(kind_of(a, name).units);
      char value[32];
      std::snprintf(value, sizeof value, "%.5g", a.quantity(drawn, quantity_of(a, name)) * unit.scale);
      words += text(i ? ", " : " ", label_of(name), " ");
      words += absent(name, a.quantity(drawn, quantity_of(a, name)))
                   ? std::string("none")
                   : text(value, *unit.units ? " " : "", unit.units);
    }
  }
  return words;
}

// What only the table says: values of keys that are no numbers, and reasons of errors, which may be long.
void add_notes_of_table(const StudyResult& a, const std::vector<StudyAxis>& axes, Figure& figure) {
  for (size_t k = 0; k < axes.size(); ++k)
    if (!a.plan.keys[k].number) {
      std::string list;
      for (const std::string& level : axes[k].levels) list += (list.empty() ? "" : ", ") + level;
      figure.notes.push_back(text("values of ", a.plan.keys[k].name, ", counted from 1: ", list));
    }
  std::map<std::string, size_t> reasons;
  for (const std::string& why : a.rejection)
    if (!why.empty()) ++reasons[why];
  constexpr size_t kMostReasons = 20;
  size_t listed = 0;
  for (const auto& [why, count] : reasons)
    if (listed++ < kMostReasons)
      figure.notes.push_back(text("outside the model's range (", count, "): ", why));
  if (reasons.size() > kMostReasons)
    figure.notes.push_back(
        text("and ", reasons.size() - kMostReasons, " other reasons; study.h5 holds them all"));
}

// How the variants are told apart by one of the keys: all alike without one.
struct Colours {
  bool coloured = false;
  size_t by = 0;                   // the key
  std::vector<double> rgb, marks;  // of each variant
  Panel legend = {};               // below all others
};

// The colour of a value between 0 and 1: by place among few levels, by value where there are many.
class ColourScale {
 public:
  explicit ColourScale(const StudyAxis& axis)
      : levels_(axis.levels.size()),
        least_(*std::min_element(axis.at.begin(), axis.at.end())),
        most_(*std::max_element(axis.at.begin(), axis.at.end())) {}
  double most() const { return most_; }
  double rgb(double value, size_t place) const { return colour(share(value, place)); }
  double shape(size_t place) const { return mark(levels_ <= kFewLevels ? place : 0); }

 private:
  double share(double value, size_t place) const {
    if (levels_ <= kFewLevels)
      return levels_ > 1 ? static_cast<double>(place) / static_cast<double>(levels_ - 1) : 0.2;
    return most_ > least_ ? (value - least_) / (most_ - least_) : 0.2;
  }
  size_t levels_;
  double least_, most_;
};

Colours colours_of(const StudyResult& a, const std::vector<StudyAxis>& axes) {
  const size_t variants = a.variants.size();
  Colours found{!a.plan.figure_colour.empty(), 0, std::vector<double>(variants, colour(0.2)),
                std::vector<double>(variants, mark(0))};
  if (!found.coloured) return found;
  found.by = key_of(a, a.plan.figure_colour);
  const StudyAxis& axis = axes[found.by];
  const ColourScale scale(axis);
  const size_t levels = axis.levels.size();
  for (size_t v = 0; v < variants; ++v) {
    const auto level = std::find(axis.levels.begin(), axis.levels.end(), a.variants[v].values[found.by]);
    const auto place = static_cast<size_t>(level - axis.levels.begin());
    found.rgb[v] = scale.rgb(axis.at[v], place);
    found.marks[v] = scale.shape(place);
  }
  const VariedKey& key = a.plan.keys[found.by];
  const AxisUnits units = axis_units(key, scale.most());
  found.legend = {.curves = {{.style = PanelStyle::points,
                              .label = with_unit(axis_name(key), units.words) + ":",
                              .size = 0}},
                  .key = PanelKey::below,
                  .height = 4,
                  .bare = true,
                  .wide = true};
  const size_t entries = std::min(levels, kFewLevels);
  for (size_t e = 0; e < entries; ++e) {
    const size_t place = entries > 1 ? e * (levels - 1) / (entries - 1) : 0;
    const std::string& level = axis.levels[place];
    const double value = key.number ? std::strtod(level.c_str(), nullptr) : static_cast<double>(place) + 1;
    char short_number[32];
    std::snprintf(short_number, sizeof short_number, "%.5g", value * units.scale);
    found.legend.curves.push_back({.style = PanelStyle::points,
                                   .colour = static_cast<int>(scale.rgb(value, place)),
                                   .label = key.number ? short_number : without_markup(level),
                                   .mark = static_cast<int>(scale.shape(place)),
                                   .size = 1.4});
  }
  return found;
}

PanelAxis axis_of_key(const StudyResult& a, const StudyAxis& axis, size_t k) {
  const VariedKey& key = a.plan.keys[k];
  const AxisUnits units = axis_units(key, *std::max_element(axis.at.begin(), axis.at.end()));
  PanelAxis out{.label = with_unit(axis_name(key), units.words)};
  for (const std::string& level : axis.levels)
    if (!key.number) out.names.push_back(without_markup(level));
  return out;
}

// What one answer is in each variant, in the unit of the figure, and which variants have it.
struct DrawnAnswer {
  std::string name;
  std::vector<double> value;
  std::vector<size_t> drawn;
};

// Row r and column c from 1: the answer against key k. y: its axis.
void add_quantity_panel(const StudyResult& a, const StudyAxis& axis, const Colours& colours,
                        const DrawnAnswer& quantity, const PanelAxis& y_axis, size_t k, size_t r, size_t c,
                        Figure& figure) {
  // What the pair does at rest does not depend on how its motion ends.
  const bool moves = of_motion(quantity.name);
  FigureBlock panel{
      text("panel", r, "_", c),
      {with_unit(a.plan.keys[k].name, ""), quantity.name, "colour [rgb]", "unsteady speeds [1]", "mark [1]"},
      {},
      "",
      "",
      true};
  std::vector<size_t> order = quantity.drawn;
  // Those that agree in all other keys come one after the other.
  const auto others = [&](size_t v) {
    std::vector<std::string> rest = a.variants[v].values;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
    return rest;
  };
  if (!a.plan.random)
    std::stable_sort(order.begin(), order.end(), [&](size_t i, size_t j) {
      const auto x = others(i), y = others(j);
      return x != y ? x < y : axis.at[i] < axis.at[j];
    });
  const double scale = axis_units(a.plan.keys[k], *std::max_element(axis.at.begin(), axis.at.end())).scale;
  bool crossed = false;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && !a.plan.random && others(order[i]) != others(order[i - 1])) panel.rows.emplace_back();
    const int own_unsteady = a.unsteady[static_cast<Index>(order[i])];
    crossed = crossed || (moves && own_unsteady > 0);
    panel.rows.push_back({axis.at[order[i]] * scale, quantity.value[order[i]], colours.rgb[order[i]],
                          moves ? static_cast<double>(own_unsteady) : 0.0, colours.marks[order[i]]});
  }
  Panel drawn{
      .x = axis_of_key(a, axis, k), .y = y_axis, .key = PanelKey::none, .height = 190, .letter = false};
  // Along the key that colours, a line between points of two colours would have the colour of neither.
  PanelCurve curve{.block = panel.name, .width = 1.8, .rgb = 3};
  if (colours.coloured && k == colours.by) curve.colour = kGrey, curve.width = 1.2, curve.rgb = 0;
  if (!a.plan.random) drawn.curves.push_back(curve);
  drawn.curves.push_back({.block = panel.name,
                          .style = PanelStyle::points,
                          .size = !a.plan.random || a.variants.size() < 100 ? 1.0 : 0.6,
                          .rgb = 3,
                          .marks = 5});
  // Where the motion did not settle at one of the speeds.
  if (crossed)
    drawn.curves.push_back({.block = panel.name,
                            .style = PanelStyle::points,
                            .colour = kVermilion,
                            .width = 1.8,
                            .mark = 2,
                            .size = 1.8,
                            .where = 4});
  // Names of quantities are too long to stand beside an axis.
  std::swap(drawn.heading, drawn.y.label);
  const auto add_words = [&](const std::string& words) {
    drawn.heading += (drawn.heading.empty() ? "" : "; ") + words;
  };
  if (order.empty()) add_words("none");
  figure.blocks.push_back(panel);
  std::vector<double> x, y;
  for (const size_t v : quantity.drawn) {
    x.push_back(axis.at[v]);
    y.push_back(quantity.value[v]);
  }
  if (a.plan.random && a.plan.keys[k].number && !order.empty())
    add_words("ρ = " + fixed(rank_correlation(x, y), 2));
  figure.panels.push_back(drawn);
}

// The distribution of an answer in a sample, and three of its percentiles.
void add_spread(const DrawnAnswer& quantity, const PanelAxis& y_axis, size_t r, Figure& figure) {
  std::vector<double> sorted;
  sorted.reserve(quantity.drawn.size());
  for (const size_t v : quantity.drawn) sorted.push_back(quantity.value[v]);
  std::sort(sorted.begin(), sorted.end());
  FigureBlock spread{text("spread", r), {"share [%]", quantity.name}, {}, "", "", true};
  for (size_t i = 0; i < sorted.size(); ++i)
    spread.rows.push_back(
        {100 * (static_cast<double>(i) + 0.5) / static_cast<double>(sorted.size()), sorted[i]});
  const std::string at = text("percentiles", r);
  figure.panels.push_back(
      {.x = {.label = "share of the variants (%)", .from = 0, .to = 100},
       .y = y_axis,
       .curves = {{.block = spread.name, .width = 2},
                  {.block = at, .style = PanelStyle::points, .colour = kVermilion, .size = 1}},
       .key = PanelKey::none,
       .height = 190,
       .letter = false});
  FigureBlock percentiles{at, spread.columns, {}, "", "", true};
  for (const int share : {5, 50, 95}) {
    if (sorted.empty()) break;
    percentiles.rows.push_back({1.0 * share, percentile(sorted, 0.01 * share)});
    figure.panels.back().heading +=
        text(share == 5 ? "" : ", ", share, " %: ", shown(percentiles.rows.back()[1], 4));
  }
  figure.blocks.push_back(spread);
  figure.blocks.push_back(percentiles);
}

}  // namespace

double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2) return 0;
  const std::vector<double> rx = ranks(x), ry = ranks(y);
  const double middle = 0.5 * static_cast<double>(x.size() - 1);
  double xy = 0, xx = 0, yy = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    xy += (rx[i] - middle) * (ry[i] - middle);
    xx += (rx[i] - middle) * (rx[i] - middle);
    yy += (ry[i] - middle) * (ry[i] - middle);
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

Figure study_figure(const StudyResult& a) {
  const size_t variants = a.variants.size();
  const auto rejected = static_cast<size_t>(std::count_if(
      a.rejection.begin(), a.rejection.end(), [](const std::string& why) { return !why.empty(); }));
  if (rejected == variants)
    fail(Failure::input, "all ", variants,
         " variants of the study lie outside the model's range, the first because: ", a.rejection.at(0));
  std::vector<StudyAxis> axes;
  for (size_t k = 0; k < a.plan.keys.size(); ++k) axes.push_back(axis_of(a, k));

  Figure figure;
  figure.title = a.plan.title;
  figure.notes.push_back(text(
      variants, " variants of ", a.plan.scene,
      a.plan.random ? text(", drawn with seed ", a.plan.seed) : ", all combinations",
      rejected > 0
          ? text("; ", rejected,
                 " lie outside the model's range (column 'outside_model' of the table) and are not drawn")
          : ""));
  const auto unsteady = (a.unsteady.array() > 0).count();
  if (unsteady > 0)
    figure.notes[0] += text("; ", unsteady, unsteady == 1 ? " has" : " have",
                            " speeds that did not settle (column 'unsteady speeds'; crossed)");
  const ShownQuantities quantities = shown_quantities(a);
  std::string second_line = constant_words(a, quantities);
  // A column of a key that does nothing would only repeat all lines as level ones.
  std::vector<std::string> columns_of = a.plan.figure_keys;
  const std::vector<std::string> idle = keys_without_effect(a.plan, a.variants);
  for (const std::string& name : idle) {
    second_line += text(second_line.empty() ? "" : "; ", name, " changes nothing that the study computes");
    if (columns_of.size() > 1) std::erase(columns_of, name);
  }
  if (!second_line.empty()) figure.notes.push_back(second_line);
  plain_captions(figure.notes.size(), figure);
  add_notes_of_table(a, axes, figure);
  figure.blocks.push_back(table_of(a, axes));

  if (!a.plan.figure_map.empty()) {
    add_study_map(a, quantities.rows, figure);
    return figure;
  }
  const Colours colours = colours_of(a, axes);
  std::vector<size_t> columns;  // their keys
  columns.reserve(columns_of.size());
  for (const std::string& name : columns_of) columns.push_back(key_of(a, name));
  figure.columns = columns.size() + (a.plan.random ? 1 : 0);
  for (size_t r = 0; r < quantities.rows.size(); ++r) {
    DrawnAnswer quantity{quantities.rows[r], std::vector<double>(variants), {}};
    const ShownUnit unit = shown_units(kind_of(a, quantity.name).units);
    // Vibration is seen from 0 on.
    PanelAxis y{.label = label_of(quantity.name) + (*unit.units ? text(" (", unit.units, ")") : "")};
    y.from_zero = y.label.find("RMS") != std::string::npos;
    for (size_t v = 0; v < variants; ++v) {
      quantity.value[v] = a.quantity(static_cast<Index>(v), quantity_of(a, quantity.name)) * unit.scale;
      if (a.rejection[v].empty() && !absent(quantity.name, quantity.value[v])) quantity.drawn.push_back(v);
    }
    for (size_t c = 0; c < columns.size(); ++c) {
      add_quantity_panel(a, axes[columns[c]], colours, quantity, y, columns[c], r + 1, c + 1, figure);
      y.label = "";  // beside the first alone
    }
    if (a.plan.random) add_spread(quantity, y, r + 1, figure);
  }
  if (colours.coloured) figure.panels.push_back(colours.legend);
  return figure;
}

}  // namespace whine
