#include "report/draw_panels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "report/gnuplot.h"
#include "report/panel_layout.h"
#include "report/text_width.h"

namespace whine {
namespace {

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

// gnuplot reads '%' in the label of a tick as the start of a format.
std::string tick_label(const std::string& words) {
  std::string out;
  for (const char c : words) out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

std::string dash(int kind) {
  constexpr std::array kDashes{"solid", "(18, 8)", "(10, 5)", "(4, 4)", "(14, 4, 3, 4)", "(3, 6)", "(20, 6)"};
  return text(" dt ", kDashes.at(static_cast<size_t>(kind - 1)));
}

std::string rgb(int colour) {
  return colour > kLight ? text("lc rgb ", colour) : text("lc rgb colour[", colour, "]");
}

// What gnuplot's `with` says of a curve.
std::string looks(const PanelCurve& c, bool line, bool marks) {
  std::string words = line && marks ? "linespoints" : line ? "lines" : "points";
  words += text(" lt 1 lw ", number(line ? c.width : std::min(c.width, 2.0)), " ",
                c.heat > 0  ? "lc palette"
                : c.rgb > 0 ? "lc rgb variable"
                            : rgb(c.colour));
  if (line) words += dash(c.dash);
  if (marks) words += text(" pt ", c.marks > 0 ? "variable" : std::to_string(c.mark), " ps ", number(c.size));
  return words;
}

// Of a block of that many rows the ones that have marks: all, or those whose place on a grid of its values of x counts so.
std::string marked(const FigureBlock& block, const PanelCurve& c, const std::string& y) {
  if (c.every < 2) return y;
  double from = std::numeric_limits<double>::infinity(), to = -from, rows = 0;
  for (const auto& row : block.rows) {
    if (row.empty()) continue;
    from = std::min(from, row[static_cast<size_t>(c.x - 1)]);
    to = std::max(to, row[static_cast<size_t>(c.x - 1)]);
    ++rows;
  }
  const double step = rows > 1 && to > from ? (to - from) / (rows - 1) : 1;
  return text("(int(floor((column(", c.x, ") - ", number(from), ") / ", number(step), " + 0.5)) % ", c.every,
              " == ", c.first, " ? ", y, " : NaN)");
}

// gnuplot's columns of a curve.
struct Using {
  Using(const Panel& panel, const PanelCurve& c)
      : curve(c), x(text("(column(", c.x, ") + ", number(c.shift), ")")) {
    std::string value = c.at ? number(*c.at) : text("column(", c.y, ")");
    if (panel.y.log && !std::isnan(panel.y.from))
      value = text("(", value, " < 0 ? NaN : ", value, " < ", number(panel.y.from), " ? ",
                   number(panel.y.from), " : ", value, ")");
    // Without a place on the axis of colours: not drawn.
    if (panel.colours && panel.colours->log && c.heat > 0)
      value = text("(column(", c.heat, ") < colour_from ? NaN : ", value, ")");
    y = kept(value);
  }
  // Of the rows that are drawn.
  std::string kept(const std::string& value) const {
    if (curve.where == 0) return "(" + value + ")";
    return text("(column(", curve.where, ") ", curve.is ? "== " + number(*curve.is) : "> 0", " ? ", value,
                " : NaN)");
  }
  std::string edge(const PanelPlace& place, size_t k) const {
    const AxisRange& r = k < 2 ? place.x : place.y;
    return curve.box[k] > 0 ? text("(column(", curve.box[k], "))")
                            : text("(", number(k % 2 ? r.to : r.from), ")");
  }
  std::string box(const PanelPlace& place) const {
    return text(edge(place, 0), ":", edge(place, 1), ":", edge(place, 2), ":", edge(place, 3));
  }
  const PanelCurve& curve;
  std::string x, y;
};

// A style that is neither line nor points; "" for those.
std::string shape(const PanelCurve& c, const Using& of, const PanelPlace& place, const std::string& filled) {
  switch (c.style) {
    case PanelStyle::spans:
      return text("using (0.5 * (column(", c.x, ") + column(", c.y, "))):(", number(place.y.to), "):(column(",
                  c.y, ") - column(", c.x, ")) with ", filled);
    case PanelStyle::bars:
      return text("using ", of.x, ":", of.y, ":(", number(c.width), ") with ", filled);
    case PanelStyle::rows:
      return text("using (0.5 * ", of.y, "):", of.x, ":(abs(0.5 * ", of.y, ")):(", number(0.5 * c.width),
                  ") with boxxyerror fs solid 1 noborder ", rgb(c.colour));
    case PanelStyle::stems:
      return text("using ", of.x, ":", of.y, " with impulses lt 1 lw ", number(c.width), " ", rgb(c.colour));
    case PanelStyle::boxes:
      return text("using ", of.kept("0.5 * (" + of.edge(place, 0) + " + " + of.edge(place, 1) + ")"), ":",
                  of.edge(place, 2), ":", of.box(place), " with boxxyerror fs transparent solid ",
                  number(c.fill), c.box[0] > 0 ? " border rgb '#ffffff' " : " noborder ", rgb(c.colour));
    case PanelStyle::ranges:
      return text("using ", of.x, ":", of.y, ":", of.box(place), " with ", filled);
    case PanelStyle::cells:
      return text(
          "using ", of.x, ":", of.y, ":",
          c.box[0] > 0 ? of.box(place) : text("(", number(0.5 * c.width), "):(", number(0.5 * c.size), ")"),
          c.heat > 0 ? text(":", c.heat) : "", " with boxxyerror fs solid 1 noborder ",
          c.heat > 0 ? "lc palette" : rgb(c.colour));
    case PanelStyle::arrows: {
      const auto change = [&](size_t k) {
        return text("(", of.edge(place, k + 1), " - ", of.edge(place, k), ")");
      };
      return text("using ", of.edge(place, 0), ":", of.edge(place, 2), ":", change(0), ":", change(2),
                  " with vectors ", c.size > 0 ? "head filled size screen 0.008, 24 fixed" : "nohead",
                  filled.substr(filled.find(' ')));
    }
    case PanelStyle::image:
      return text("using ", of.x, ":", of.y, ":(column(", c.heat, ") > colour_from ? column(", c.heat,
                  ") : NaN) with image pixels");
    default:
      return "";
  }
}

void add_curve(const Figure& figure, const Panel& panel, const PanelCurve& c, const PanelPlace& place,
               Script& script, std::vector<std::string>& plots) {
  const bool line = c.style == PanelStyle::line || c.style == PanelStyle::line_points,
             stems = c.style == PanelStyle::stems,
             marks =
                 c.style == PanelStyle::points || c.style == PanelStyle::line_points || (stems && c.size > 0),
             filled = c.style == PanelStyle::bars || c.style == PanelStyle::rows ||
                      c.style == PanelStyle::spans || c.style == PanelStyle::boxes;
  const std::string keyed = filled ? text("boxes fs solid ", number(c.fill), " noborder ", rgb(c.colour))
                            : c.style == PanelStyle::ranges
                                ? text("xyerrorbars lt 1 lw ", number(c.width), " pt ", c.mark, " ps ",
                                       number(c.size), " ", rgb(c.colour))
                                : looks(c, line || c.style == PanelStyle::arrows || (stems && !marks), marks);
  bool drawn = false;
  if (!c.block.empty())
    for (const auto& row : block_of(figure, c.block).rows) drawn = drawn || holds(c, row);
  if (drawn) {
    const std::string data = "tsv index " + script.word("[" + c.block + "]") + " ",
                      colours = c.rgb + c.heat > 0 ? text(":", c.rgb + c.heat) : "",
                      kinds = c.marks > 0 ? text(":", c.marks) : "";
    const Using of(panel, c);
    if (const std::string own = shape(c, of, place, keyed); !own.empty())
      plots.push_back(data + own + " notitle");
    if (line)
      plots.push_back(data + "using " + of.x + ":" + of.y + colours + " with " + looks(c, true, false) +
                      " notitle");
    if (marks)
      plots.push_back(data + "using " + of.x + ":" + marked(block_of(figure, c.block), c, of.y) + kinds +
                      colours + " with " + looks(c, false, true) + " notitle");
  }
  if (!c.label.empty()) plots.push_back("keyentry with " + keyed + " title " + script.word(c.label));
}

void add_rules(const Panel& panel, const PanelPlace& place, Script& script, std::vector<std::string>& plots) {
  double ends = -1e9;  // of the last label beside an upright line
  int row = 0;
  std::string last;
  std::vector<const PanelRule*> rules;
  for (const PanelRule& rule : panel.rules) rules.push_back(&rule);
  std::stable_sort(rules.begin(), rules.end(), [](auto* a, auto* b) { return a->at < b->at; });
  for (const PanelRule* rule : rules) {
    const AxisRange& r = rule->axis == 'x' ? place.x : place.y;
    const std::string line = text("nohead ", panel.colours ? "front" : "back", " lt 1 lw 1.4 ",
                                  rgb(rule->colour), dash(rule->dash));
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
    const double width = text_width(rule->label) * 13 * pixels::kPoint + 12;
    const bool meets = pixels + 6 < ends;
    if (meets && rule->label == last) continue;  // said already
    last = rule->label;
    row = meets ? row + 1 : 0;
    const bool fits = pixels + width < place.right;
    ends = std::max(ends, pixels + width);
    script.add(text("set label ", script.word(rule->label), " at ", at, ", graph 1 offset ",
                    fits ? "0.5" : "-0.5", ", ", number(-0.8 - 1.0 * row), fits ? " left" : " right", look));
  }
}

void add_axes(const Panel& panel, const PanelPlace& place, Script& script) {
  script.add(panel.bare ? "unset border; unset tics; unset grid"
                        : "set border 3; set grid xtics ytics lt 1 lc rgb '#e4e4e4' lw 1");
  for (const bool along_x : {true, false}) {
    const PanelAxis& axis = along_x ? panel.x : panel.y;
    const AxisRange& r = along_x ? place.x : place.y;
    const AxisTicks& ticks = along_x ? place.x_ticks : place.y_ticks;
    const std::string name = along_x ? "x" : "y";
    script.add(text("set ", name, "range [", number(r.from), ":", number(r.to), "]"));
    if (panel.bare) continue;
    if (axis.log) {
      script.add("set logscale " + name);
      std::string own;
      for (const double tick : log_ticks(r)) own += (own.empty() ? "(" : ", ") + number(tick);
      script.add(text("set format ", name, own.empty() ? " \"10^{%L}\"" : " \"%g\""));
      script.add(text("set ", name, "tics scale 1 out nomirror font \",18\" ",
                      own.empty() ? "autofreq" : own + ")", "; set m", name, "tics ",
                      own.empty() ? "default" : "1"));
    } else if (!axis.names.empty()) {
      const double room = along_x ? (place.right - place.left) / static_cast<double>(axis.names.size()) : 1e9;
      script.add(text(
          "set ", name, "tics scale 0 out nomirror (\"\" 1) font \",",
          fixed(std::min(along_x ? 18.0 : 13.0, (room - 12) / pixels::kPoint / std::max(1.0, ticks.widest)),
                1),
          "\"; set m", name, "tics 1"));
      for (size_t i = 0; i < axis.names.size(); ++i)
        script.add(text("set ", name, "tics add (", script.word(tick_label(axis.names[i])), " ", i + 1, ")"));
    } else {
      const double power = std::pow(10, std::floor(std::log10(ticks.step) + 1e-9));
      script.add(text("set ", name, "tics scale 1 out nomirror font \",", fixed(ticks.size, 1), "\" ",
                      number(ticks.step), "; set m", name, "tics ",
                      std::lround(ticks.step / power) == 2 ? 4 : 5, "; set format ", name, " \"%h\""));
    }
  }
  const double middle = 0.5 * (place.top + place.bottom);
  const auto label = [&](const std::string& words, double x, double y, const char* how) {
    if (!words.empty())
      script.add(text("set label ", script.word(words), " at screen ", number(x / pixels::kWidth),
                      ", screen (1 - ", number(y), " / height) ", how));
  };
  const auto fitting = [](const std::string& words, double pixels) {
    return text("font \",",
                fixed(std::min(18.0, pixels / pixels::kPoint / std::max(1.0, text_width(words))), 1), "\"");
  };
  const double centre = 0.5 * (place.left + place.right);
  label(panel.x.label, centre, place.bottom + pixels::kNumbersBelow + 0.5 * pixels::kLabelBelow,
        text("center ", fitting(panel.x.label,
                                place.right - place.left + std::min(80.0, 0.25 * (place.right - place.left))))
            .c_str());
  const double numbers = place.y_ticks.widest * pixels::kAxisLetter + 22;
  label(panel.y.label, place.left - numbers - 0.5 * pixels::kLabelBeside, middle,
        text("rotate by 90 center ", fitting(panel.y.label, place.bottom - place.top + 40)).c_str());
  if (panel.top) {
    script.add(text("set x2range [", number(place.x.from * panel.top_factor), ":",
                    number(place.x.to * panel.top_factor), "]; set x2tics out; set border 7"));
    label(panel.top->label, centre, place.top - pixels::kNumbersAbove - 0.5 * pixels::kLabelAbove, "center");
  } else {
    script.add("unset x2tics");
  }
  if (!panel.colours) return script.add("unset colorbox");
  // White is no colour of marks.
  const bool marks = std::any_of(panel.curves.begin(), panel.curves.end(), [](const PanelCurve& c) {
    return c.heat > 0 && c.style == PanelStyle::points;
  });
  script.add(marks ? "eval(of_marks)" : "eval(of_areas)");
  if (panel.colours->log) script.add("set logscale cb");
  script.add(text("colour_from = ", number(panel.colours->from), "; set cbrange [colour_from:",
                  number(panel.colours->to), "]; set colorbox user origin screen ",
                  number((place.right + 16) / pixels::kWidth), ", screen 1 - ", number(place.bottom),
                  " / height size screen 0.012, screen ", number(place.bottom - place.top), " / height"));
  label(panel.colours->label, place.right + pixels::kColourBox - 14, middle,
        text("rotate by 90 center ", fitting(panel.colours->label, place.bottom - place.top + 40)).c_str());
}

void add_words(const Panel& panel, const PanelPlace& place, Script& script) {
  for (const PanelWords& w : panel.words) {
    const bool above = std::isnan(w.y), right = w.x > place.x.from + 0.5 * place.x.span();
    script.add(text("set label ", script.word(w.words), " at first ", number(w.x), ", ",
                    above ? "graph 1 offset 0, 0.6 center"
                          : text("first ", number(w.y),
                                 w.on    ? " center boxed"
                                 : right ? " offset -0.8, 0.8 right boxed"
                                         : " offset 0.8, 0.8 left boxed"),
                    " tc rgb colour[6] font \",13\" front"));
  }
}

void add_panel(const Figure& figure, size_t index, const PanelPlace& place, Script& script) {
  const Panel& panel = figure.panels[index];
  if (panel.curves.empty()) return;
  script.add("unset label; unset arrow; unset logscale; unset xlabel; unset ylabel");
  script.add(text("set lmargin at screen ", number(place.left / pixels::kWidth), "; set rmargin at screen ",
                  number(place.right / pixels::kWidth), "; set tmargin at screen 1 - ", number(place.top),
                  " / height; set bmargin at screen 1 - ", number(place.bottom), " / height"));
  add_axes(panel, place, script);
  for (size_t i = 0; i < place.heading.size(); ++i)
    script.add(text(
        "set label ", script.word(place.heading[i]), " at screen ", number(place.left / pixels::kWidth),
        ", screen (1 - ",
        number(place.top - place.above + pixels::kFrameTop + (static_cast<double>(i) + 0.5) * pixels::kLine),
        " / height) left font \",14\""));
  add_words(panel, place, script);
  std::vector<std::string> plots;
  for (const PanelCurve& c : panel.curves) add_curve(figure, panel, c, place, script, plots);
  add_rules(panel, place, script, plots);
  if (panel.key == PanelKey::right)
    script.add(
        text("set key at screen ", number((panel.bare ? place.left : place.right + 24) / pixels::kWidth),
             ", screen (1 - ", number(place.top - 6),
             " / height) left top Left reverse vertical maxrows 99 samplen 2 spacing 1.2 font \",14\""));
  else if (panel.key == PanelKey::below)
    script.add(text("set key at screen ", number(place.key_middle / pixels::kWidth), ", screen (1 - ",
                    number(place.bottom + place.below),
                    " / height) center bottom Left reverse vertical maxrows ", number(place.key_rows),
                    " samplen 2.5 spacing 1.2 font \",14\""));
  else
    script.add("unset key");
  if (std::all_of(plots.begin(), plots.end(), [](const auto& plot) { return plot.starts_with("key"); }))
    plots.emplace_back("NaN notitle");
  std::string all;
  for (const std::string& plot : plots) all += (all.empty() ? "" : ", ") + plot;
  script.add("plot " + all);
  script.end_panel();
}

}  // namespace

PanelPicture panel_picture(const Figure& figure) {
  const PanelLayout layout = layout_of_panels(figure);
  Script script;
  for (size_t i = 0; i < figure.panels.size(); ++i) add_panel(figure, i, layout.places[i], script);
  return {layout.height, script.all()};
}

}  // namespace whine
