#include "report/engineering_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <regex>

#include "base/error.h"
#include "base/tool.h"

namespace whine {
namespace {

constexpr double kDepth = 80;     // dB below the largest level: the foot of an axis of levels
constexpr double kSilence = 300;  // dB below it: what stands for a level of nothing

// Columns against which figures of motions are drawn; other frequencies stay.
bool is_speed_column(const std::string& column) {
  constexpr std::array kSpeeds{"mesh_frequency [Hz]", "jump_frequency [Hz]", "jump_width [Hz]",
                               "last speed before [Hz]", "fold_frequency [Hz]"};
  return std::find(kSpeeds.begin(), kSpeeds.end(), column) != kSpeeds.end();
}

const Shaft& shaft_of(const std::string& wanted, const Figure& figure) {
  const std::string said = "--axis " + printable(wanted, 80);
  if (wanted.starts_with("rpm:") && figure.shafts.empty())
    fail(Failure::usage, said, ": ",
         figure.no_shafts.empty()
             ? "this figure is not against the speed of one pair of gears or train: its axis stays as it is"
             : figure.no_shafts);
  return shaft_called(wanted, figure.shafts, said);
}

// "at 5600 ± 2 Hz" as "at 13440 rpm (5600 ± 2 Hz)"; lists in rpm alone: "rising 5757, falling 5529 Hz" as "rising 13817, falling 13270 rpm".
std::string speeds_in_rpm(const std::string& words, double scale) {
  static const std::regex kSpeeds(
      R"((\d+(\.\d+)?( and \d+ more)?((, | to | and )(rising |falling )?\d+(\.\d+)?( and \d+ more)?)*)(?: ± \d+(?:\.\d+)?)? Hz)"),
      kNumber(R"(\d+(\.\d+)?(?! more)(?![\d.]))");
  std::string out;
  auto from = words.cbegin();
  for (std::sregex_iterator list(words.begin(), words.end(), kSpeeds), end; list != end; ++list) {
    out.append(from, (*list)[0].first);
    const std::string speeds = (*list)[1], whole = list->str();
    auto rest = speeds.cbegin();
    size_t count = 0;
    for (std::sregex_iterator one(speeds.begin(), speeds.end(), kNumber); one != end; ++one, ++count) {
      out.append(rest, (*one)[0].first);
      out += fixed(std::stod(one->str()) * scale, 0);
      rest = (*one)[0].second;
    }
    out.append(rest, speeds.cend());
    out += count == 1 ? " rpm (" + whole + ")" : " rpm";
    from = (*list)[0].second;
  }
  return out.append(from, words.cend());
}

void in_rpm(const Shaft& shaft, Figure& figure) {
  const double scale = 60 * std::abs(shaft.turns);
  const std::string whose = shaft.gear + (shaft.with.empty() ? "" : ", " + shaft.with);
  for (FigureBlock& block : figure.blocks)
    for (size_t c = 0; c < block.columns.size(); ++c) {
      if (!is_speed_column(block.columns[c])) continue;
      std::string& column = block.columns[c];
      column = column.substr(0, column.find(" [")) + " [rpm of " + whose + "]";
      for (auto& row : block.rows)
        if (!row.empty()) row[c] *= scale;
    }
  for (std::string& words : figure.captions) words = speeds_in_rpm(words, scale);
  constexpr std::string_view against = "against mesh frequency";
  if (const size_t at = figure.title.find(against); at != std::string::npos)
    figure.title.replace(at, against.size(), "against the speed of " + shaft.gear);
  const std::string label = "Speed of " + without_markup(whose) + " (rpm)";
  for (Panel& panel : figure.panels) {
    panel.heading = speeds_in_rpm(panel.heading, scale);
    for (PanelCurve& curve : panel.curves) curve.label = speeds_in_rpm(curve.label, scale);
    for (PanelRule& rule : panel.rules) rule.label = speeds_in_rpm(rule.label, scale);
    if (panel.y.speed) {
      panel.y.label = label;
      panel.y.from *= scale;
      panel.y.to *= scale;
      for (PanelCurve& curve : panel.curves)
        if (curve.style == PanelStyle::cells) curve.size *= scale;
      for (PanelWords& words : panel.words) words.y *= scale;
    }
    if (!panel.x.speed) continue;
    // The axis above has the unit that the one below had.
    if (panel.top) panel.top->label = panel.x.label, panel.top_factor = 1 / scale;
    if (!panel.x.label.empty()) panel.x.label = label;
    panel.x.from *= scale;
    panel.x.to *= scale;
    for (PanelRule& rule : panel.rules)
      if (rule.axis == 'x') rule.at *= scale;
    for (PanelWords& words : panel.words) words.x *= scale;
  }
}

// "dB re 1e-06 m" reads as "dB re 1 µm".
std::string reference_words(double reference) {
  const double exponent = std::floor(std::log10(reference) / 3 + 1e-9) * 3;
  const int index = static_cast<int>(std::lround(exponent / 3)) + 4;
  constexpr std::array kUnits{"pm", "nm", "µm", "mm", "m"};
  if (index < 0 || index >= static_cast<int>(kUnits.size())) return shown(reference, 6) + " m";
  return shown(reference / std::pow(10, exponent), 6) + " " + kUnits[static_cast<size_t>(index)];
}

void in_levels(double reference, Figure& figure) {
  // A level is of the RMS: that of a harmonic is its amplitude over sqrt(2). nullptr: no level.
  const auto level_of = [&](const std::string& column) {
    const auto found = std::find_if(figure.levels.begin(), figure.levels.end(),
                                    [&](const LevelColumn& level) { return level.column == column; });
    return found == figure.levels.end() ? nullptr : &*found;
  };
  const std::string label = "dB re " + reference_words(reference) + " RMS";
  const auto level = [&](const LevelColumn& of, double micrometres) {
    const double rms = of.amplitude ? micrometres / std::numbers::sqrt2 : micrometres;
    return 20 * std::log10(std::max(rms, 1e-300) / (reference * kMicro));
  };
  double highest = -1e300, lowest = 1e300;
  for (const FigureBlock& block : figure.blocks)
    for (size_t c = 0; c < block.columns.size(); ++c)
      if (const LevelColumn* of = level_of(block.columns[c]))
        for (const auto& row : block.rows)
          if (!row.empty() && row[c] > 0) {
            highest = std::max(highest, level(*of, row[c]));
            lowest = std::min(lowest, level(*of, row[c]));
          }
  const double foot = std::floor((std::max(lowest, highest - kDepth) - 2) / 10) * 10;
  for (FigureBlock& block : figure.blocks)
    for (size_t c = 0; c < block.columns.size(); ++c) {
      const LevelColumn* of = level_of(block.columns[c]);
      if (!of) continue;
      for (auto& row : block.rows)
        if (!row.empty()) row[c] = std::max(highest - kSilence, level(*of, row[c]));
      block.columns[c] = block.columns[c].substr(0, block.columns[c].find(" [")) + " [" + label + "]";
    }
  const auto to_levels = [&](PanelAxis& axis) {
    axis = {.label = axis.label.substr(0, axis.label.rfind(" (")) + " (" + label + ")",
            .from = foot,
            .to = std::ceil((highest + 4) / 10) * 10};
  };
  for (Panel& panel : figure.panels) {
    if (panel.y.level) to_levels(panel.y);
    if (panel.colours && panel.colours->level) to_levels(*panel.colours);
  }
}

}  // namespace

void apply(const EngineeringAxes& axes, Figure& figure) {
  if (!axes.speed.empty()) in_rpm(shaft_of(axes.speed, figure), figure);
  if (!axes.level_reference) return;
  const double reference = *axes.level_reference;
  if (!(reference > 0) || !std::isfinite(reference))
    fail(Failure::usage, "--db ", reference, ": it is a length in m above 0, such as 1e-6");
  if (figure.levels.empty())
    fail(
        Failure::usage, "--db ", reference,
        ": this figure has no amplitudes of the transmission error; it is for order-cuts, waterfall, system-sweep, branch, compare-motion and runup");
  in_levels(reference, figure);
}

}  // namespace whine
