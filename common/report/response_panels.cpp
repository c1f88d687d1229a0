#include "report/response_panels.h"

#include <algorithm>
#include <array>

#include "base/error.h"

namespace whine {
namespace {

// What a panel shows of a sweep: columns of its response, and of its jumps before and after them.
struct Quantity {
  int column, before, after;
};
constexpr Quantity kRms{2, 2, 3}, kMean{3, 5, 6};

int colour_of(const ResponsePanels& p, size_t c, bool up) {
  return !p.alone ? curve_colour(c) : up ? kBlue : kVermilion;
}

// P2000's marks of torques, + o square, for falling speed; filled ones, and x for +, for rising speed.
int mark_of(const ResponsePanels& p, size_t c, bool up) {
  constexpr std::array<int, kMostCurves> kFilled{2, 7, 5, 9, 13, 11}, kOpen{1, 6, 4, 8, 12, 10};
  return p.alone ? (up ? 9 : 10) : (up ? kFilled : kOpen).at(c);
}

std::string block_name(const ResponsePanels& p, size_t c, bool up, const char* what = "") {
  return p.names[c] + what + name_of(up ? Direction::up : Direction::down);
}

// One direction of the curve c. It stops at a jump; an arrow leads to the branch on which the sweep goes on. Where the branch was
// followed past the last speed of the sweep on it, dots lead from there to its end.
void draw_sweep(const ResponsePanels& p, size_t c, bool up, const Quantity& q, Panel& panel) {
  PanelCurve curve{.block = block_name(p, c, up),
                   .y = q.column,
                   .style = PanelStyle::line_points,
                   .colour = colour_of(p, c, up),
                   .width = 1.8,
                   .size = 0.3};
  panel.curves.push_back(curve);
  // Marks of rising and of falling speed stand at speeds of their own, so that both show where the directions agree.
  curve.style = PanelStyle::points;
  curve.mark = mark_of(p, c, up);
  curve.size = up ? 1.4 : 1.8;
  curve.every = 2 * p.stride;
  curve.first = up ? 0 : p.stride;
  panel.curves.push_back(curve);
  if (p.beyond)
    panel.curves.push_back({.block = curve.block,
                            .y = q.column,
                            .style = PanelStyle::points,
                            .colour = kBlack,
                            .mark = 6,
                            .size = 1.3,
                            .where = 8});
  PanelCurve jump{.block = block_name(p, c, up, "jumps "),
                  .style = PanelStyle::arrows,
                  .colour = curve.colour,
                  .dash = 2,
                  .box = {1, 1, q.before, q.after}};
  panel.curves.push_back(jump);
  jump.width = 1.8;
  jump.dash = 6;
  jump.size = 0;
  jump.box = {7, 1, q.before, q.before};
  panel.curves.push_back(jump);
}

// Orbits that no sweep can show, and where they meet the others; the RMS alone is known of folds.
void draw_branch(const ResponsePanels& p, size_t c, const Quantity& q, Panel& panel) {
  const int colour = p.alone ? kGreen : curve_colour(c);
  panel.curves.push_back({.block = p.names[c] + "stable", .y = q.column, .colour = colour, .width = 1.4});
  panel.curves.push_back(
      {.block = p.names[c] + "unstable", .y = q.column, .colour = colour, .width = 2.2, .dash = 3});
  if (q.column == kRms.column)
    panel.curves.push_back({.block = p.names[c] + "folds",
                            .style = PanelStyle::points,
                            .colour = colour,
                            .mark = 3,
                            .size = 2.2});
}

// Speeds at which the teeth part during the period, in a strip below 0, narrower than a step of the axis.
void draw_losses(ResponsePanels& p) {
  const double rows = 2 * static_cast<double>(p.names.size()) + 1, high = std::min(0.016, 0.1 / rows);
  p.rms.y.to = 1.1 * (p.peak > 0 ? p.peak : 1);
  p.rms.y.from = p.lost ? -high * rows * p.rms.y.to : 0;
  if (!p.lost) return;
  p.rms.rules.push_back({.axis = 'y', .at = 0, .colour = kBlack, .dash = 1});
  double row = 0.8;
  for (size_t c = 0; c < p.names.size(); ++c)
    for (const bool up : {true, false})
      p.rms.curves.push_back({.block = block_name(p, c, up),
                              .style = PanelStyle::points,
                              .colour = colour_of(p, c, up),
                              .mark = 5,
                              .size = 0.6,
                              .where = 4,
                              .at = -high * row++ * p.rms.y.to});
}

// What marks and lines mean. labels: of the curves
void add_key(const std::vector<std::string>& labels, ResponsePanels& p) {
  const auto entry = [&](PanelStyle style, const std::string& label, int colour, int dash, int mark,
                         double size = 1.4) {
    p.rms.curves.push_back(
        {.style = style, .colour = colour, .label = label, .dash = dash, .mark = mark, .size = size});
  };
  const PanelStyle both = PanelStyle::line_points, line = PanelStyle::line, points = PanelStyle::points;
  for (size_t c = 0; !p.alone && c < labels.size(); ++c)
    entry(both, without_markup(labels[c]), curve_colour(c), 1, mark_of(p, c, false));
  for (const bool up : {true, false})
    entry(p.alone ? both : points,
          (p.alone ? ""
           : up    ? "filled, or ×: "
                   : "open, or +: ") +
              text("speed ", up ? "rising" : "falling"),
          p.alone ? colour_of(p, 0, up) : kDark, 1,
          p.alone ? mark_of(p, 0, up)
          : up    ? 5
                  : 4);
  if (p.jumps) entry(line, "jump", kDark, 2, 0), entry(line, "to the end of the branch", kDark, 6, 0);
  if (p.lost) entry(points, "contact lost", kDark, 1, 5, 0.8);
  if (p.beyond) entry(points, "beyond the backlash, where back flanks would touch", kBlack, 1, 6);
  if (!p.errors.empty()) entry(PanelStyle::ranges, "discretisation error", kBlack, 1, 0, 0);
  if (!p.branches) return;
  const int colour = p.alone ? kGreen : kDark;
  entry(line, "stable orbits", colour, 1, 0);
  entry(line, "unstable orbits", colour, 3, 0);
  entry(points, "fold", colour, 1, 3, 2);
}

void add_resonances(const std::vector<double>& natural_frequency, ResponsePanels& p) {
  const size_t curves = natural_frequency.size();
  for (size_t c = 0; c < curves; ++c)
    for (const int n : {1, 2, 3}) {
      const bool named = c == (curves - 1) / 2;
      const PanelRule rule{.at = natural_frequency[c] / n,
                           .label = !named   ? ""
                                    : n == 1 ? "f_n"
                                             : text("f_n/", n),
                           .colour = p.alone ? kGrey : curve_colour(c)};
      p.rms.rules.push_back(rule);
      if (n == 1) p.mean.rules.push_back(rule);
    }
}

}  // namespace

ResponsePanels empty_panels(size_t curves, Eigen::Index speeds, bool tall) {
  ResponsePanels p;
  p.rms.x = {.label = "Mesh frequency (Hz)", .speed = true};
  p.rms.y.label = "RMS of oscillating DTE (µm)";
  p.rms.key = PanelKey::below;
  p.rms.height = tall ? 560 : 420;
  p.mean = p.rms;
  p.mean.y.label = "Mean DTE (µm)";
  p.mean.key = PanelKey::none;
  p.mean.letter = false;
  p.alone = curves == 1;
  // At most 60 marks.
  p.stride = std::max(static_cast<int>((speeds + 59) / 60), speeds > 30 ? 2 : 1);
  return p;
}

void draw_response(bool with_branch, ResponsePanels& p) {
  const size_t c = p.names.size() - 1;
  for (Panel* panel : {&p.rms, &p.mean}) {
    const Quantity& q = panel == &p.rms ? kRms : kMean;
    if (with_branch) draw_branch(p, c, q, *panel);
    for (const bool up : {false, true}) draw_sweep(p, c, up, q, *panel);
  }
}

void finish(const std::vector<std::string>& labels, const std::vector<double>& natural_frequency,
            ResponsePanels& p) {
  for (const std::string& block : p.errors)
    p.rms.curves.push_back({.block = block,
                            .style = PanelStyle::ranges,
                            .colour = kBlack,
                            .width = 1.6,
                            .mark = 0,
                            .size = 0,
                            .box = {1, 1, 3, 4}});
  draw_losses(p);
  add_key(labels, p);
  add_resonances(natural_frequency, p);
}

}  // namespace whine
