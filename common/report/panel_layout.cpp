#include "report/panel_layout.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "report/figure_words.h"
#include "report/text_width.h"

namespace whine {

const FigureBlock& block_of(const Figure& figure, const std::string& name) {
  for (const FigureBlock& block : figure.blocks)
    if (block.name == name) return block;
  fail(Failure::numerical, "figure: a curve is of the block ", name, ", which it does not have");
}

bool holds(const PanelCurve& c, const std::vector<double>& row) {
  if (row.empty() || c.where == 0) return !row.empty();
  const double value = row[static_cast<size_t>(c.where - 1)];
  return c.is ? value == *c.is : value > 0;
}

double step_of(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double times : {1.0, 2.0, 5.0})
    if (x <= times * power * (1 + 1e-9)) return times * power;
  return 10 * power;
}

std::vector<double> log_ticks(AxisRange r) {
  std::vector<double> ticks;
  if (r.to / r.from > 100) return ticks;
  for (double power = std::pow(10, std::floor(std::log10(r.from))); power <= r.to; power *= 10)
    for (const double times : {1.0, 2.0, 5.0})
      if (times * power >= r.from && times * power <= r.to) ticks.push_back(times * power);
  return ticks;
}

namespace {

constexpr double kTitle = 56, kScenes = 30, kSample = 72, kEdge = 28;
constexpr double kNote = 24;  // as common.gp's room()

// Of words with '\n' between lines, in a width in parts of their letters.
std::vector<std::string> lines_of(const std::string& words, double width = 1e9) {
  std::vector<std::string> lines;
  for (size_t from = 0; from <= words.size();) {
    const size_t end = std::min(words.find('\n', from), words.size());
    const std::vector<std::string> broken = broken_lines(words.substr(from, end - from), width);
    lines.insert(lines.end(), broken.begin(), broken.end());
    from = end + 1;
  }
  return lines;
}

// Of a curve on an axis: what it reaches there.
void widen(const Figure& figure, const PanelCurve& c, bool along_x, AxisRange& range) {
  if (c.block.empty()) return;
  const auto take = [&](double value) {
    if (!std::isfinite(value)) return;
    range.from = std::min(range.from, value);
    range.to = std::max(range.to, value);
  };
  const FigureBlock& block = block_of(figure, c.block);
  const auto most = static_cast<size_t>(
      std::max({c.x, c.y, c.where, c.rgb, c.marks, c.heat, c.box[0], c.box[1], c.box[2], c.box[3]}));
  if (c.x < 1 || c.y < 1 || c.where < 0 || block.columns.size() < most)
    fail(Failure::numerical, "figure: the block ", c.block, " has ", block.columns.size(),
         " columns, a curve is of ", most);
  for (const auto& row : block.rows) {
    if (!holds(c, row)) continue;
    if (c.style == PanelStyle::boxes || c.style == PanelStyle::ranges || c.style == PanelStyle::arrows) {
      for (const size_t end : {0, 1})
        if (const int column = c.box[end + (along_x ? 0 : 2)]; column > 0)
          take(row[static_cast<size_t>(column - 1)]);
      continue;
    }
    const double x = row[static_cast<size_t>(c.x - 1)], y = c.at ? *c.at : row[static_cast<size_t>(c.y - 1)];
    if (c.style == PanelStyle::spans) {
      if (along_x) take(x), take(y);
      continue;
    }
    const bool lies = c.style == PanelStyle::rows;
    const bool cells = c.style == PanelStyle::cells;
    const double half = c.style == PanelStyle::bars || lies || cells ? 0.5 * c.width : 0;
    const double across = x + c.shift;
    if (along_x != lies) {
      take(across - half), take(across + half);
    } else if (cells) {
      take(y - 0.5 * c.size), take(y + 0.5 * c.size);
    } else {
      take(y);
      if (lies || c.style == PanelStyle::bars || c.style == PanelStyle::stems) take(0);
    }
  }
}

AxisRange range_of(const Figure& figure, const Panel& panel, bool along_x) {
  const PanelAxis& axis = along_x ? panel.x : panel.y;
  if (!axis.names.empty()) {
    const double first = 0.4, last = static_cast<double>(axis.names.size()) + 0.6;
    return along_x ? AxisRange{first, last} : AxisRange{last, first};
  }
  constexpr double kFar = std::numeric_limits<double>::infinity();
  AxisRange r{kFar, -kFar};
  for (const PanelCurve& c : panel.curves) widen(figure, c, along_x, r);
  for (const PanelRule& rule : panel.rules)
    if ((rule.axis == 'x') == along_x && !along_x) r = {std::min(r.from, rule.at), std::max(r.to, rule.at)};
  if (!(r.from <= r.to)) r = axis.log ? AxisRange{0.1, 1} : AxisRange{0, 1};
  if (axis.log) {
    const double to = r.to > 0 ? r.to : 1;
    const double least = to * std::pow(10, -axis.decades);
    r = {std::isnan(axis.from) ? std::max(r.from > 0 ? 0.7 * r.from : least, least) : axis.from,
         std::isnan(axis.to) ? 2 * to : axis.to};
    return r.from < r.to ? r : AxisRange{0.5 * r.to, r.to};
  }
  const bool zero = axis.from_zero && r.from >= 0;
  if (zero) r.from = 0;
  const double span = r.span() > 1e-12 * std::abs(r.to) && r.span() > 0 ? r.span()
                      : r.to != 0                                       ? 0.2 * std::abs(r.to)
                                                                        : 1;
  const double pad = (along_x ? 0.02 : 0.07) * span;
  const bool same = r.span() < span;
  if (std::isnan(axis.from) && !zero) r.from -= same ? 0.5 * span : pad;
  if (std::isnan(axis.to)) r.to += same ? 0.5 * span : pad;
  if (!std::isnan(axis.from)) r.from = axis.from;
  if (!std::isnan(axis.to)) r.to = axis.to;
  return r.from < r.to ? r : AxisRange{r.from, r.from + span};
}

// As gnuplot writes a number: 1.5×10^{-5} where it needs a power of ten.
double width_of_tick(double value) {
  const std::string words = shown(value, 6);
  const size_t power = words.find('e');
  if (power == std::string::npos) return text_width(words);
  constexpr double kRaised = 0.8;  // of the size of the letters
  return text_width(words.substr(0, power) + "×10") +
         kRaised * text_width(std::to_string(std::stoi(words.substr(power + 1))));
}

// most: that find room.
AxisTicks ticks_of(const PanelAxis& axis, AxisRange r, double most) {
  AxisTicks ticks;
  if (!axis.names.empty()) {
    for (const std::string& name : axis.names)
      for (const std::string& line : lines_of(name)) ticks.widest = std::max(ticks.widest, text_width(line));
    return ticks;
  }
  if (axis.log) {
    const std::vector<double> own = log_ticks(r);
    if (own.empty()) ticks.widest = text_width("10") + 1.6;
    for (const double tick : own) ticks.widest = std::max(ticks.widest, width_of_tick(tick));
    return ticks;
  }
  ticks.step = step_of(r.span() / std::max(1.0, most));
  for (double k = std::ceil(r.from / ticks.step - 1e-6); k * ticks.step <= r.to; ++k)
    ticks.widest = std::max(ticks.widest, width_of_tick(k * ticks.step + 0.0));
  return ticks;
}

// Words of the key, in their order.
std::vector<std::string> key_of(const Panel& panel) {
  std::vector<std::string> labels;
  for (const PanelCurve& c : panel.curves)
    if (!c.label.empty()) labels.push_back(c.label);
  for (const PanelRule& rule : panel.rules)
    if (rule.in_key && !rule.label.empty()) labels.push_back(rule.label);
  return labels;
}

// Pixels: gnuplot makes the columns of a key as wide as digits in place of the longest label, and draws none that begin outside the picture.
double columns_of_key(const Panel& panel) {
  constexpr double kDigit = 0.64;
  std::ptrdiff_t longest = 0;
  for (const std::string& label : key_of(panel))
    longest = std::max(longest, std::count_if(label.begin(), label.end(), [](char c) {
                         return (static_cast<unsigned char>(c) & 0xc0) != 0x80;  // one for each character
                       }));
  return kDigit * static_cast<double>(longest) * pixels::kLetter + kSample;
}

bool has_letter(const Panel& panel) {
  return panel.letter && !panel.bare && !panel.curves.empty();
}

// "(a) " of a panel, if it and others have letters.
std::string letter_before(const Figure& figure, size_t index) {
  const auto letters = [&](size_t to) {
    return static_cast<size_t>(std::count_if(
        figure.panels.begin(), figure.panels.begin() + static_cast<std::ptrdiff_t>(to), has_letter));
  };
  if (!has_letter(figure.panels[index]) || letters(figure.panels.size()) < 2) return "";
  return "{/:Bold (" + letter_of(letters(index)) + ")} ";
}

// What a panel needs beside its frame, and its ranges.
PanelPlace measured(const Figure& figure, const Panel& panel) {
  PanelPlace p;
  p.x = range_of(figure, panel, true);
  p.y = range_of(figure, panel, false);
  p.y_ticks = ticks_of(panel.y, p.y, panel.height / 44.0);
  const double letters = panel.y.names.empty() ? pixels::kAxisLetter : pixels::kNameLetter;
  p.left = 14 + (panel.y.label.empty() ? 0 : pixels::kLabelBeside) + p.y_ticks.widest * letters + 22;
  // The last number of the x axis stands in the middle below the end of the frame.
  p.right = std::max(kEdge, 0.5 * ticks_of(panel.x, p.x, 8).widest * pixels::kAxisLetter + 8);
  for (const std::string& label : key_of(panel))
    p.key_width = std::max(p.key_width, text_width(label) * pixels::kLetter + kSample);
  double beside = panel.key == PanelKey::right ? p.key_width : 0;
  for (const PanelRule& rule : panel.rules)
    if (rule.axis == 'y' && !rule.in_key && !rule.label.empty())
      beside = std::max(beside, text_width(rule.label) * 13 * pixels::kPoint);
  p.right += std::min(beside, 0.6 * pixels::kWidth / static_cast<double>(figure.columns));
  if (panel.colours) p.right += pixels::kColourBox;
  if (panel.bare) p.left = p.right = 12;
  return p;
}

// Frames of a column stand below each other, and all are equally wide: needs are those of their neighbours.
void set_frames(const Figure& figure, std::vector<PanelPlace>& places) {
  std::vector<double> before(figure.columns, 0), after(figure.columns, 0);
  double taken = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    if (figure.panels[i].wide) continue;
    before[places[i].column] = std::max(before[places[i].column], places[i].left);
    after[places[i].column] = std::max(after[places[i].column], places[i].right);
  }
  for (size_t c = 0; c < figure.columns; ++c) taken += before[c] + after[c];
  const double frame = std::max(80.0, (pixels::kWidth - taken) / static_cast<double>(figure.columns));
  for (size_t i = 0; i < places.size(); ++i) {
    PanelPlace& p = places[i];
    const Panel& panel = figure.panels[i];
    if (panel.wide) {
      p.right = pixels::kWidth - p.right;
    } else {
      p.left = before[p.column];
      for (size_t c = 0; c < p.column; ++c) p.left += before[c] + frame + after[c];
      p.right = p.left + (panel.square ? std::min<double>(frame, panel.height) : frame);
    }
    if (!panel.bare) continue;
    const double unit = std::max(p.x.span() / (p.right - p.left), p.y.span() / panel.height);
    const auto about_middle = [](AxisRange r, double half) {
      const double middle = 0.5 * (r.from + r.to);
      return AxisRange{middle - half, middle + half};
    };
    p.x = about_middle(p.x, 0.5 * unit * (p.right - p.left));
    p.y = about_middle(p.y, 0.5 * unit * panel.height);
  }
}

// What stands above the frame.
void set_above(const Figure& figure, size_t index, PanelPlace& p) {
  const Panel& panel = figure.panels[index];
  if (const std::string words = letter_before(figure, index) + panel.heading; !words.empty())
    p.heading = lines_of(words, (p.right - p.left) / pixels::kLetter);
  const bool words =
      std::any_of(panel.words.begin(), panel.words.end(), [](const auto& w) { return std::isnan(w.y); });
  p.above = pixels::kFrameTop + pixels::kLine * (static_cast<double>(p.heading.size()) + words) +
            (panel.top ? pixels::kNumbersAbove + pixels::kLabelAbove : 0);
}

// What stands below the frame, in a row of panels from `first` to `end`.
void set_below(const Figure& figure, size_t index, size_t first, size_t end, PanelPlace& p) {
  const Panel& panel = figure.panels[index];
  p.x_ticks = ticks_of(panel.x, p.x, 1);
  for (double most = (p.right - p.left) / 45; panel.x.names.empty() && !panel.x.log && most >= 1;
       most *= 0.7) {
    p.x_ticks = ticks_of(panel.x, p.x, most);
    const double room = (p.right - p.left) * p.x_ticks.step / p.x.span();
    if (p.x_ticks.widest * pixels::kAxisLetter + 20 < room) break;
  }
  // One number alone says no scale: more of them in smaller letters.
  if (panel.x.names.empty() && !panel.x.log && p.x_ticks.step > 0.5 * p.x.span()) {
    for (double most = 3; p.x_ticks.step > 0.5 * p.x.span(); ++most) p.x_ticks = ticks_of(panel.x, p.x, most);
    const double room = (p.right - p.left) * p.x_ticks.step / p.x.span() - 12;
    p.x_ticks.size = std::min(18.0, room / pixels::kPoint / std::max(1.0, p.x_ticks.widest));
  }
  size_t lines = 1;
  for (const std::string& name : panel.x.names) lines = std::max(lines, lines_of(name).size());
  p.below = panel.bare ? 0
                       : pixels::kNumbersBelow + pixels::kLine * static_cast<double>(lines - 1) +
                             (panel.x.label.empty() ? 0 : pixels::kLabelBelow);
  const auto labels = static_cast<double>(key_of(panel).size());
  if (panel.key != PanelKey::below || labels == 0) return;
  // Across its row, if no other panel of it has a key.
  bool alone = true;
  for (size_t i = first; i < end; ++i)
    alone = alone && (i == index || figure.panels[i].key == PanelKey::none);
  p.key_middle = alone ? 0.5 * pixels::kWidth : 0.5 * (p.left + p.right);
  const double width = std::max(p.key_width, columns_of_key(panel));
  const double across = ((alone ? pixels::kWidth : p.right - p.left) - 2 * kEdge) / (width + 30);
  p.key_columns = std::clamp(std::floor(across), 1.0, labels);
  p.key_rows = std::ceil(labels / p.key_columns);
  p.below += 12 + p.key_rows * 1.2 * pixels::kLetter * 1.25;
}

}  // namespace

PanelLayout layout_of_panels(const Figure& figure) {
  std::vector<PanelPlace> places;
  size_t row_now = 0, column_now = 0;
  for (const Panel& panel : figure.panels) {
    if (column_now > 0 && (panel.wide || column_now == figure.columns)) ++row_now, column_now = 0;
    places.push_back(measured(figure, panel));
    places.back().row = row_now;
    places.back().column = column_now;
    column_now = panel.wide ? figure.columns : column_now + 1;
  }
  set_frames(figure, places);
  double y = kTitle + (figure.scenes.empty() ? 0 : kScenes);
  for (size_t row = 0, end; row < places.size(); row = end) {
    end = row;
    while (end < places.size() && places[end].row == places[row].row) ++end;
    double above = 0, below = 0, frame = 0;
    for (size_t i = row; i < end; ++i) {
      set_above(figure, i, places[i]);
      set_below(figure, i, row, end, places[i]);
      above = std::max(above, places[i].above);
      below = std::max(below, places[i].below);
      frame = std::max(frame, static_cast<double>(figure.panels[i].height));
    }
    // Beside each other all frames begin and end alike.
    for (size_t i = row; i < end; ++i) {
      places[i].above = above;
      places[i].below = below;
      places[i].top = y + above;
      places[i].bottom = y + above + frame;
    }
    y += above + frame + below + 14;
  }
  for (const std::string& note : figure.captions.empty() ? figure.notes : figure.captions)
    y += kNote * static_cast<double>(broken_lines(note, kNoteWidth).size());
  return {std::move(places), static_cast<int>(std::ceil(y / 2)) * 2 + 10};
}

}  // namespace whine
