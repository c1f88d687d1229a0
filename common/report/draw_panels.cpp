#include "report/draw_panels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "report/figure_words.h"
#include "report/gnuplot.h"
#include "report/text_width.h"

namespace whine {
namespace {

// Pixels. gnuplot's points are 4/3 of them.
constexpr double kWidth = 1600, kPoint = 4.0 / 3, kLetter = 14 * kPoint, kLine = 26;
constexpr double kTitle = 56, kScenes = 30, kFrameTop = 16, kNumbersBelow = 50, kLabelBelow = 38;
constexpr double kNumbersAbove = 48, kLabelAbove = 34, kLabelBeside = 46, kSample = 64, kEdge = 28;
constexpr double kNote = 24;  // as common.gp's room()

struct Range {
  double from = 0, to = 1;
  double span() const { return to - from; }
};

const FigureBlock& block_of(const Figure& figure, const std::string& name) {
  for (const FigureBlock& block : figure.blocks)
    if (block.name == name) return block;
  fail(Failure::numerical, "figure: a curve is of the block ", name, ", which it does not have");
}

// Of a curve on an axis: what it reaches there.
void widen(const Figure& figure, const PanelCurve& c, bool along_x, Range& range) {
  if (c.block.empty()) return;
  const auto take = [&](double value) {
    if (!std::isfinite(value)) return;
    range.from = std::min(range.from, value);
    range.to = std::max(range.to, value);
  };
  const FigureBlock& block = block_of(figure, c.block);
  const auto most = static_cast<size_t>(std::max({c.x, c.y, c.where}));
  if (c.x < 1 || c.y < 1 || c.where < 0 || block.columns.size() < most)
    fail(Failure::numerical, "figure: the block ", c.block, " has ", block.columns.size(),
         " columns, a curve is of ", most);
  for (const auto& row : block.rows) {
    if (row.empty() || (c.where > 0 && !(row[static_cast<size_t>(c.where - 1)] > 0))) continue;
    const double x = row[static_cast<size_t>(c.x - 1)], y = c.at ? *c.at : row[static_cast<size_t>(c.y - 1)];
    if (c.style == PanelStyle::spans) {
      if (along_x) take(x), take(y);
      continue;
    }
    const bool lies = c.style == PanelStyle::rows;
    const double half = c.style == PanelStyle::bars || lies ? 0.5 * c.width : 0;
    const double across = x + c.shift;
    if (along_x != lies) {
      take(across - half), take(across + half);
    } else {
      take(y);
      if (lies || c.style == PanelStyle::bars || c.style == PanelStyle::stems) take(0);
    }
  }
}

Range range_of(const Figure& figure, const Panel& panel, bool along_x) {
  const PanelAxis& axis = along_x ? panel.x : panel.y;
  if (!axis.names.empty() && std::isnan(axis.from))
    return {0.4, static_cast<double>(axis.names.size()) + 0.6};
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Range r{kFar, -kFar};
  for (const PanelCurve& c : panel.curves) widen(figure, c, along_x, r);
  for (const PanelRule& rule : panel.rules)
    if ((rule.axis == 'x') == along_x && !along_x) r = {std::min(r.from, rule.at), std::max(r.to, rule.at)};
  if (!(r.from <= r.to)) r = axis.log ? Range{0.1, 1} : Range{0, 1};
  if (axis.log) {
    const double to = r.to > 0 ? r.to : 1;
    const double least = to * std::pow(10, -axis.decades);
    r = {std::isnan(axis.from) ? std::max(r.from > 0 ? 0.7 * r.from : least, least) : axis.from,
         std::isnan(axis.to) ? 2 * to : axis.to};
    return r.from < r.to ? r : Range{0.5 * r.to, r.to};
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
  return r.from < r.to ? r : Range{r.from, r.from + span};
}

// 1, 2 or 5 times a power of ten and not below x > 0.
double step_of(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double times : {1.0, 2.0, 5.0})
    if (x <= times * power * (1 + 1e-9)) return times * power;
  return 10 * power;
}

// Of a logarithmic axis on which powers of ten alone would be too few: 1, 2, 5 times each.
std::vector<double> log_ticks(Range r) {
  std::vector<double> ticks;
  if (r.to / r.from > 100) return ticks;
  for (double power = std::pow(10, std::floor(std::log10(r.from))); power <= r.to; power *= 10)
    for (const double times : {1.0, 2.0, 5.0})
      if (times * power >= r.from && times * power <= r.to) ticks.push_back(times * power);
  return ticks;
}

// A tick at each multiple of `step`, or at powers of ten, or at names.
struct Ticks {
  double step = 1;
  double widest = 0;  // of their words, parts of a letter
};

// most: that find room.
Ticks ticks_of(const PanelAxis& axis, Range r, double most) {
  Ticks ticks;
  if (!axis.names.empty()) {
    for (const std::string& name : axis.names) ticks.widest = std::max(ticks.widest, text_width(name));
    return ticks;
  }
  if (axis.log) {
    const std::vector<double> own = log_ticks(r);
    if (own.empty()) ticks.widest = text_width("10") + 1.6;
    for (const double tick : own) ticks.widest = std::max(ticks.widest, text_width(shown(tick, 6)));
    return ticks;
  }
  ticks.step = step_of(r.span() / std::max(1.0, most));
  for (double k = std::ceil(r.from / ticks.step - 1e-6); k * ticks.step <= r.to; ++k)
    ticks.widest = std::max(ticks.widest, text_width(shown(k * ticks.step + 0.0, 6)));
  return ticks;
}

std::vector<std::string> lines_of(const std::string& words) {
  std::vector<std::string> lines{""};
  for (const char c : words)
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back() += c;
  return lines;
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

// Where the frame of a panel stands, and what stands about it.
struct Place {
  double left = 0, right = 0, top = 0, bottom = 0;  // of the frame, pixels from the left and from the top
  Range x, y;
  Ticks x_ticks, y_ticks;
  double above = 0, below = 0;  // pixels that headings, axes and keys take
  double key_columns = 1, key_rows = 0;
};

class Script {
 public:
  void add(const std::string& command) { commands_ += command + "; "; }
  // A variable that holds words: of names and texts nothing is ever read as a command.
  std::string word(const std::string& words) {
    const std::string name = text("text", ++words_);
    variables_ += name + " = " + gnuplot_string(words) + "; ";
    return name;
  }
  // Ends the commands of a panel.
  void end_panel() {
    variables_ += text("panel", ++panels_, " = ", gnuplot_string(commands_), "; ");
    commands_.clear();
  }
  std::string all() const { return variables_ + text("panels = ", panels_, "; "); }

 private:
  std::string commands_, variables_;
  int words_ = 0, panels_ = 0;
};

std::string number(double value) {
  return shown(value, 12);
}

std::string dash(int kind) {
  constexpr std::array kDashes{"solid", "(18, 8)", "(10, 5)", "(4, 4)", "(14, 4, 3, 4)", "(3, 6)", "(20, 6)"};
  return text(" dt ", kDashes.at(static_cast<size_t>(kind - 1)));
}

std::string rgb(int colour) {
  return text("lc rgb colour[", colour, "]");
}

// What gnuplot's `with` says of a curve.
std::string looks(const PanelCurve& c, bool line, bool marks) {
  std::string words = line && marks ? "linespoints" : line ? "lines" : "points";
  words += text(" lt 1 lw ", number(line ? c.width : std::min(c.width, 2.0)), " ", rgb(c.colour));
  if (line) words += dash(c.dash);
  if (marks) words += text(" pt ", c.mark, " ps ", number(c.size));
  return words;
}

void add_curve(const Figure& figure, const PanelCurve& c, const Place& place, Script& script,
               std::vector<std::string>& plots) {
  const auto label = [&] {
    return c.label.empty() ? std::string("notitle") : "title " + script.word(c.label);
  };
  const bool line = c.style == PanelStyle::line || c.style == PanelStyle::line_points;
  const bool marks =
      c.style == PanelStyle::points || c.style == PanelStyle::line_points || c.style == PanelStyle::stems;
  const bool filled =
      c.style == PanelStyle::bars || c.style == PanelStyle::rows || c.style == PanelStyle::spans;
  const std::string keyed =
      filled ? text("boxes fs solid 1 noborder ", rgb(c.colour)) : looks(c, line, marks);
  bool drawn = false;
  if (!c.block.empty())
    for (const auto& row : block_of(figure, c.block).rows)
      drawn = drawn || (!row.empty() && (c.where == 0 || row[static_cast<size_t>(c.where - 1)] > 0));
  if (drawn) {
    const std::string data = "tsv index " + script.word("[" + c.block + "]") + " ";
    const std::string y = c.at ? number(*c.at) : text("column(", c.y, ")");
    const std::string shown_y =
        c.where > 0 ? text("(column(", c.where, ") > 0 ? ", y, " : NaN)") : "(" + y + ")";
    const std::string x = text("(column(", c.x, ") + ", number(c.shift), ")");
    const std::string every = c.every > 1 || c.first > 0 ? text("every ", c.every, "::", c.first, " ") : "";
    const std::string using_xy = "using " + x + ":" + shown_y + " ";
    switch (c.style) {
      case PanelStyle::spans:
        plots.push_back(data + text("using (0.5 * (column(", c.x, ") + column(", c.y, "))):(",
                                    number(place.y.to), "):(column(", c.y, ") - column(", c.x, ")) with ",
                                    keyed, " notitle"));
        break;
      case PanelStyle::bars:
        plots.push_back(data + "using " + x + ":" + shown_y + ":(" + number(c.width) + ") with " + keyed +
                        " notitle");
        break;
      case PanelStyle::rows:
        plots.push_back(data + "using (0.5 * " + shown_y + "):" + x + ":(abs(0.5 * " + shown_y + ")):(" +
                        number(0.5 * c.width) + ") with boxxyerror fs solid 1 noborder " + rgb(c.colour) +
                        " notitle");
        break;
      case PanelStyle::stems:
        plots.push_back(data + using_xy +
                        text("with impulses lt 1 lw ", number(c.width), " ", rgb(c.colour), " notitle"));
        break;
      default:
        if (line) plots.push_back(data + using_xy + "with " + looks(c, true, false) + " notitle");
    }
    if (marks) plots.push_back(data + every + using_xy + "with " + looks(c, false, true) + " notitle");
  }
  if (!c.label.empty()) plots.push_back("keyentry with " + keyed + " " + label());
}

void add_rules(const Panel& panel, const Place& place, Script& script, std::vector<std::string>& plots) {
  double ends = -1e9;  // of the last label beside an upright line
  int row = 0;
  std::vector<const PanelRule*> rules;
  for (const PanelRule& rule : panel.rules) rules.push_back(&rule);
  std::stable_sort(rules.begin(), rules.end(), [](auto* a, auto* b) { return a->at < b->at; });
  for (const PanelRule* rule : rules) {
    const Range& r = rule->axis == 'x' ? place.x : place.y;
    const std::string line = text("nohead back lt 1 lw 1.4 ", rgb(rule->colour), dash(rule->dash));
    if (rule->in_key)
      plots.push_back(text("keyentry with lines lt 1 lw 1.4 ", rgb(rule->colour), dash(rule->dash), " title ",
                           script.word(rule->label)));
    if (rule->at < r.from || rule->at > r.to) continue;
    const std::string at = "first " + number(rule->at);
    if (rule->axis == 'x')
      script.add(text("set arrow from ", at, ", graph 0 to ", at, ", graph 1 ", line));
    else
      script.add(text("set arrow from graph 0, ", at, " to graph 1, ", at, " ", line));
    if (rule->label.empty() || rule->in_key) continue;
    const std::string look = " tc rgb colour[6] font \",13\" front";
    if (rule->axis == 'y') {
      script.add(
          text("set label ", script.word(rule->label), " at graph 1, ", at, " offset 0.4, 0 left", look));
      continue;
    }
    // Labels that would run into each other stand in rows.
    const double pixels = place.left + (rule->at - r.from) / r.span() * (place.right - place.left);
    const double width = text_width(rule->label) * 13 * kPoint + 12;
    row = pixels + 6 < ends ? row + 1 : 0;
    const bool fits = pixels + width < place.right;
    ends = std::max(ends, pixels + width);
    script.add(text("set label ", script.word(rule->label), " at ", at, ", graph 1 offset ",
                    fits ? "0.5" : "-0.5", ", ", number(-0.8 - 1.0 * row), fits ? " left" : " right", look));
  }
}

void add_axes(const Panel& panel, const Place& place, Script& script) {
  for (const bool along_x : {true, false}) {
    const PanelAxis& axis = along_x ? panel.x : panel.y;
    const Range& r = along_x ? place.x : place.y;
    const Ticks& ticks = along_x ? place.x_ticks : place.y_ticks;
    const std::string name = along_x ? "x" : "y";
    script.add(text("set ", name, "range [", number(r.from), ":", number(r.to), "]"));
    if (axis.log) {
      script.add("set logscale " + name);
      std::string own;
      for (const double tick : log_ticks(r)) own += (own.empty() ? "(" : ", ") + number(tick);
      script.add(text("set format ", name, own.empty() ? " \"10^{%L}\"" : " \"%g\""));
      script.add(text("set ", name, "tics scale 1 out nomirror ", own.empty() ? "autofreq" : own + ")",
                      "; set m", name, "tics ", own.empty() ? "default" : "1"));
    } else if (!axis.names.empty()) {
      script.add(text("set ", name, "tics scale 0 out nomirror (\"\" 1); set m", name, "tics 1"));
      for (size_t i = 0; i < axis.names.size(); ++i)
        script.add(text("set ", name, "tics add (", script.word(axis.names[i]), " ", i + 1, ")"));
    } else {
      const double power = std::pow(10, std::floor(std::log10(ticks.step) + 1e-9));
      script.add(text("set ", name, "tics scale 1 out nomirror ", number(ticks.step), "; set m", name,
                      "tics ", std::lround(ticks.step / power) == 2 ? 4 : 5, "; set format ", name,
                      " \"%g\""));
    }
  }
  const double middle = 0.5 * (place.top + place.bottom);
  const auto label = [&](const std::string& words, double x, double y, const char* how) {
    if (!words.empty())
      script.add(text("set label ", script.word(words), " at screen ", number(x / kWidth), ", screen (1 - ",
                      number(y), " / height) ", how));
  };
  const auto fitting = [](const std::string& words, double pixels) {
    return text("font \",", fixed(std::min(18.0, pixels / kPoint / std::max(1.0, text_width(words))), 1),
                "\"");
  };
  const double centre = 0.5 * (place.left + place.right);
  label(panel.x.label, centre, place.bottom + kNumbersBelow + 0.5 * kLabelBelow,
        text("center ", fitting(panel.x.label, place.right - place.left + 80)).c_str());
  const double numbers = place.y_ticks.widest * 18 * kPoint + 22;
  label(panel.y.label, place.left - numbers - 0.5 * kLabelBeside, middle,
        text("rotate by 90 center ", fitting(panel.y.label, place.bottom - place.top + 40)).c_str());
  if (panel.top) {
    script.add(text("set x2range [", number(place.x.from * panel.top_factor), ":",
                    number(place.x.to * panel.top_factor), "]; set x2tics out; set border 7"));
    label(panel.top->label, centre, place.top - kNumbersAbove - 0.5 * kLabelAbove, "center");
  } else {
    script.add("unset x2tics; set border 3");
  }
}

void add_panel(const Figure& figure, size_t index, const Place& place, Script& script) {
  const Panel& panel = figure.panels[index];
  script.add("unset label; unset arrow; unset logscale; unset xlabel; unset ylabel");
  script.add(text("set lmargin at screen ", number(place.left / kWidth), "; set rmargin at screen ",
                  number(place.right / kWidth), "; set tmargin at screen 1 - ", number(place.top),
                  " / height; set bmargin at screen 1 - ", number(place.bottom), " / height"));
  add_axes(panel, place, script);
  std::string heading = figure.panels.size() > 1 ? "{/:Bold (" + letter_of(index) + ")} " : "";
  heading += panel.heading;
  const auto lines = lines_of(heading);
  for (size_t i = 0; i < lines.size() && !heading.empty(); ++i)
    script.add(text("set label ", script.word(lines[i]), " at screen ", number(place.left / kWidth),
                    ", screen (1 - ",
                    number(place.top - place.above + kFrameTop + (static_cast<double>(i) + 0.5) * kLine),
                    " / height) left font \",14\""));
  std::vector<std::string> plots;
  for (const PanelCurve& c : panel.curves) add_curve(figure, c, place, script, plots);
  add_rules(panel, place, script, plots);
  if (panel.key == PanelKey::right)
    script.add(text(
        "set key at screen ", number((place.right + 24) / kWidth), ", screen (1 - ", number(place.top - 6),
        " / height) left top Left reverse vertical maxrows 99 samplen 2 spacing 1.2 font \",14\""));
  else if (panel.key == PanelKey::below)
    script.add(text("set key at screen ", number(0.5 * (place.left + place.right) / kWidth), ", screen (1 - ",
                    number(place.bottom + place.below),
                    " / height) center bottom Left reverse vertical maxrows ", number(place.key_rows),
                    " samplen 2.5 spacing 1.2 font \",14\""));
  else
    script.add("unset key");
  if (plots.empty()) plots.emplace_back("NaN notitle");
  std::string all;
  for (const std::string& plot : plots) all += (all.empty() ? "" : ", ") + plot;
  script.add("plot " + all);
  script.end_panel();
}

// Without the vertical place, which those above decide.
Place place_of(const Figure& figure, size_t index) {
  const Panel& panel = figure.panels[index];
  const auto columns = static_cast<double>(figure.columns),
             column = static_cast<double>(index % figure.columns);
  Place p;
  p.x = range_of(figure, panel, true);
  p.y = range_of(figure, panel, false);
  p.y_ticks = ticks_of(panel.y, p.y, panel.height / 62.0);
  const double share = kWidth / columns;
  p.left =
      share * column + 14 + (panel.y.label.empty() ? 0 : kLabelBeside) + p.y_ticks.widest * 18 * kPoint + 22;
  p.right = share * (column + 1) - kEdge;
  const auto labels = key_of(panel);
  double widest = 0;
  for (const std::string& label : labels) widest = std::max(widest, text_width(label) * kLetter + kSample);
  for (const PanelRule& rule : panel.rules)
    if (rule.axis == 'y' && !rule.in_key && !rule.label.empty())
      widest = std::max(widest, text_width(rule.label) * 13 * kPoint);
  if (!labels.empty() && panel.key == PanelKey::right) p.right -= std::min(widest, 0.45 * share);
  p.x_ticks = ticks_of(panel.x, p.x, 1);
  for (double most = (p.right - p.left) / 45; panel.x.names.empty() && !panel.x.log && most >= 1;
       most *= 0.7) {
    p.x_ticks = ticks_of(panel.x, p.x, most);
    const double room = (p.right - p.left) * p.x_ticks.step / p.x.span();
    if (p.x_ticks.widest * 18 * kPoint + 20 < room) break;
  }
  const std::string heading = (figure.panels.size() > 1 ? "(a)" : "") + panel.heading;
  p.above = kFrameTop + (heading.empty() ? 0 : kLine * static_cast<double>(lines_of(heading).size())) +
            (panel.top ? kNumbersAbove + kLabelAbove : 0);
  p.below = kNumbersBelow + (panel.x.label.empty() ? 0 : kLabelBelow);
  if (panel.key == PanelKey::below && !labels.empty()) {
    const double across = (p.right - p.left + 60) / (widest + 30);
    p.key_columns = std::clamp(std::floor(across), 1.0, static_cast<double>(labels.size()));
    p.key_rows = std::ceil(static_cast<double>(labels.size()) / p.key_columns);
    p.below += 12 + p.key_rows * 1.2 * kLetter * 1.25;
  }
  return p;
}

}  // namespace

PanelPicture panel_picture(const Figure& figure) {
  std::vector<Place> places;
  for (size_t i = 0; i < figure.panels.size(); ++i) places.push_back(place_of(figure, i));
  double y = kTitle + (figure.scenes.empty() ? 0 : kScenes);
  for (size_t row = 0; row < places.size(); row += figure.columns) {
    const size_t end = std::min(places.size(), row + figure.columns);
    double above = 0, below = 0, frame = 0;
    for (size_t i = row; i < end; ++i) {
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
  for (const std::string& note : figure.notes)
    y += kNote * static_cast<double>(broken_lines(note, kNoteWidth).size());
  Script script;
  for (size_t i = 0; i < places.size(); ++i) add_panel(figure, i, places[i], script);
  return {static_cast<int>(std::ceil(y / 2)) * 2 + 10, script.all()};
}

}  // namespace whine
