#include "report/response_figures.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "gear/pair.h"
#include "report/figure_words.h"
#include "report/response_panels.h"
#include "signal/jump_cause.h"
#include "signal/response.h"

namespace whine {
namespace {

// In order of frequency. What the RMS and the mean are after a jump is read off the branch on which the sweep goes on.
FigureBlock jump_block(const std::string& name, const ResponseResult& r) {
  FigureBlock block{name,
                    {"jump_frequency [Hz]", "dte_rms before [µm]", "dte_rms after [µm]", "jump_width [Hz]",
                     "dte_mean before [µm]", "dte_mean after [µm]", "last speed before [Hz]"},
                    {},
                    "jumps",
                    name};
  const std::vector<Eigen::Index> left = rows_before_jumps(r);
  for (Eigen::Index j = 0; j < r.jump_frequency.size(); ++j) {
    const double f = r.jump_frequency[j];
    const Eigen::Index at = row_before(r.mesh_frequency, f), i = left[j];
    if (at < 0)
      fail(Failure::input, "response: a jump at ", f, " Hz lies outside the sweep, ",
           r.mesh_frequency.minCoeff(), " to ", r.mesh_frequency.maxCoeff(), " Hz");
    const double share = (f - r.mesh_frequency[at]) / (r.mesh_frequency[at + 1] - r.mesh_frequency[at]);
    const auto after = [&](const Eigen::VectorXd& v) {
      return (i == at ? v[at + 1] : (1 - share) * v[at] + share * v[at + 1]) * kMicro;
    };
    block.rows.push_back({f, r.dte_rms(i, 0) * kMicro, after(r.dte_rms.col(0)), r.jump_width[j],
                          r.dte_mean(i, 0) * kMicro, after(r.dte_mean.col(0)), r.mesh_frequency[i]});
  }
  std::sort(block.rows.begin(), block.rows.end());
  return block;
}

// Stable or unstable orbits in the order of the arc, in stretches; those of unstable ones go from stable orbit to stable orbit.
FigureBlock orbit_block(const std::string& name, const BranchResult& b, bool stable) {
  FigureBlock block{name,
                    {"mesh_frequency [Hz]", "dte_rms [µm]", "dte_mean [µm]"},
                    {},
                    stable ? "stable orbits" : "unstable orbits",
                    name};
  const auto add = [&](Eigen::Index i) {
    block.rows.push_back({b.mesh_frequency[i], b.dte_rms(i, 0) * kMicro, b.dte_mean(i, 0) * kMicro});
  };
  const auto shown = [&](Eigen::Index i) { return (b.stable[i] != 0) == stable; };
  const Eigen::Index n = b.mesh_frequency.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!shown(i)) continue;
    const bool first = i == 0 || b.part[i - 1] != b.part[i], last = i + 1 == n || b.part[i + 1] != b.part[i];
    // Unstable orbits are drawn up to the stable ones beside them.
    if (!stable && !first && !shown(i - 1)) add(i - 1);
    add(i);
    if (!last && shown(i + 1)) continue;
    if (!stable && !last) add(i + 1);
    block.rows.emplace_back();
  }
  return block;
}

FigureBlock fold_block(const std::string& name, const BranchResult& b) {
  FigureBlock block{name,
                    {"fold_frequency [Hz]", "dte_rms [µm]", "multiplier before [1]", "multiplier after [1]"},
                    {},
                    "folds",
                    name};
  for (Eigen::Index i = 0; i < b.fold_frequency.size(); ++i)
    block.rows.push_back(
        {b.fold_frequency[i], b.fold_rms(i, 0) * kMicro, b.fold_multiplier(i, 0), b.fold_multiplier(i, 1)});
  return block;
}

// " 1241, 1410" of a block of jumps; after the sixth only how many more there are.
std::string listed_jumps(const FigureBlock& jumps) {
  constexpr size_t kMostListed = 6;
  std::string list;
  for (size_t j = 0; j < std::min(jumps.rows.size(), kMostListed); ++j)
    list += (j ? ", " : " ") + fixed(jumps.rows[j][0], 0);
  return jumps.rows.size() > kMostListed ? text(list, " and ", jumps.rows.size() - kMostListed, " more")
                                         : list;
}

std::string way_word(const ResponseResult& r) {
  return r.direction == Direction::up ? "rising" : "falling";
}

// Of a panel: "contact lost at 150 N m: rising 2820 to 2980, falling 2600 to 2980 Hz".
std::string loss_words(const ChoicePanel<ResponseResult>& panel) {
  const auto& curves = panel.curves;
  const std::string first = loss_both_ways(*curves[0].up, *curves[0].down);
  std::string each;
  bool alike = true;
  for (const auto& c : curves) {
    const std::string words = loss_both_ways(*c.up, *c.down);
    alike = alike && words == first;
    const std::string label = curve_label(panel, *c.up);
    each += (each.empty() ? " " : "; ") + (label == torque_words(c.up->torque) ? "at " + label : label) +
            ": " + (words.empty() ? "nowhere" : words);
  }
  if (alike && first.empty()) return "contact is never lost";
  return alike && curves.size() > 1 ? "contact lost at every torque: " + first : "contact lost" + each;
}

// "beyond the backlash at 150 N m: rising 2880 to 2900 Hz", "" where no motion goes there.
std::string beyond_words(const ChoicePanel<ResponseResult>& panel) {
  std::string each;
  for (const auto& c : panel.curves) {
    std::string ways;
    for (const ResponseResult* r : {c.up, c.down})
      if (const std::string ranges = speeds_beyond_backlash({r}); !ranges.empty())
        ways += (ways.empty() ? "" : ", ") + way_word(*r) + " " + ranges;
    if (!ways.empty())
      each += (each.empty() ? "" : "; ") + text("at ", curve_label(panel, *c.up), ": ", ways, " Hz");
  }
  return each.empty() ? "" : "beyond the backlash, where back flanks would touch, " + each;
}

// "rising 1326.41 Hz: fold at 1326.46; ..." of both sweeps beside their branch; "" without a jump.
std::string cause_words(const ChoicePanel<ResponseResult>::Curve& curve, const BranchResult& branch) {
  std::string words;
  for (const ResponseResult* r : {curve.up, curve.down})
    for (Eigen::Index j = 0; j < r->jump_frequency.size(); ++j) {
      const CausedJump cause = cause_of_jump(branch, r->jump_frequency[j], r->jump_width[j]);
      words += (words.empty() ? "" : "; ") +
               std::string(r->direction == Direction::up ? "rising " : "falling ") +
               fixed(r->jump_frequency[j], 2) + " Hz: " + name(cause.cause);
      if (cause.cause != JumpCause::basin) words += " at " + fixed(cause.frequency, 2);
    }
  return words;
}

// RMS at the judged speeds with its discretisation error either way.
FigureBlock error_block(const std::string& name, const SweepErrorsResult& errors) {
  FigureBlock block{name,
                    {"mesh_frequency [Hz]", "dte_rms [µm]", "least [µm]", "most [µm]"},
                    {},
                    "discretisation errors",
                    name};
  for (Eigen::Index i = 0; i < errors.mesh_frequency.size(); ++i) {
    const double rms = errors.dte_rms.value(i, 0) * kMicro, off = rms * errors.dte_rms.error(i, 0);
    block.rows.push_back({errors.mesh_frequency[i], rms, std::max(0.0, rms - off), rms + off});
  }
  return block;
}

// One torque or flank of a panel: both directions, the branch beside them, its natural frequency. "150 N m: jumps rising 2645,
// falling 1819 Hz"
std::string add_curve(Figure& figure, const std::string& letter, const std::string& label,
                      const ChoicePanel<ResponseResult>::Curve& curve, const CaptionSources& background,
                      bool backlash, ResponsePanels& p) {
  const std::string& name = p.names.emplace_back(letter + " " + label + " ");
  std::string found;
  for (const ResponseResult* r : {curve.up, curve.down}) {
    figure.blocks.push_back(
        response_block(text(name, r->direction), *r, r == curve.up ? curve.down : curve.up, backlash));
    figure.blocks.push_back(jump_block(text(name, "jumps ", r->direction), *r));
    const std::string at = listed_jumps(figure.blocks.back());
    if (!at.empty()) found += (found.empty() ? " " : ", ") + way_word(*r) + at;
    p.peak = std::max(p.peak, r->dte_rms.maxCoeff() * kMicro);
    p.lost |= r->separation_fraction.maxCoeff() > 0;
    p.jumps |= r->jump_frequency.size() > 0;
    if (const SweepErrorsResult* errors = errors_of(*r, background)) {
      figure.blocks.push_back(error_block(text(name, "errors ", r->direction), *errors));
      p.errors.push_back(figure.blocks.back().name);
    }
  }
  const BranchResult* branch = branch_of(*curve.up, background);
  if (branch) {
    p.branches = true;
    for (const bool stable : {true, false})
      figure.blocks.push_back(orbit_block(name + (stable ? "stable" : "unstable"), *branch, stable));
    figure.blocks.push_back(fold_block(name + "folds", *branch));
    p.peak = std::max(p.peak, branch->dte_rms.maxCoeff() * kMicro);
    const std::string causes = cause_words(curve, *branch);
    if (!causes.empty()) figure.notes.push_back("(" + letter + ") " + label + ", jumps " + causes);
  }
  draw_response(branch != nullptr, p);
  return label + (found.empty() ? ": no jump" : ": jumps" + found + " Hz");
}

void add_panel(Figure& figure, const std::string& letter, const ChoicePanel<ResponseResult>& panel,
               const CaptionSources& background, bool backlash, bool alone, bool mean) {
  const auto& curves = panel.curves;
  if (curves.size() > kMostCurves)
    fail(Failure::input, "figure: ", curves.size(), " torques of the same choices given; ", kMostCurves,
         " curves can be told apart");
  const std::string beyond = beyond_words(panel), operating = operating_words(panel, background),
                    loss = loss_words(panel) + (beyond.empty() ? "" : "; " + beyond);
  ResponsePanels p = empty_panels(curves.size(), curves[0].up->mesh_frequency.size(), alone && !mean);
  p.beyond = !beyond.empty();
  std::vector<std::string> labels;
  std::vector<double> natural_frequency;
  labels.reserve(curves.size());
  natural_frequency.reserve(curves.size());
  std::string jumps;
  for (const auto& curve : curves) {
    labels.push_back(
        add_curve(figure, letter, curve_label(panel, *curve.up), curve, background, backlash, p));
    natural_frequency.push_back(curve.up->natural_frequency);
    jumps += (jumps.empty() ? "" : "; ") + labels.back();
  }
  finish(labels, natural_frequency, p);
  p.rms.heading = without_markup(operating) + (p.alone ? "\n" + without_markup(jumps) : "");
  figure.panels.push_back(std::move(p.rms));
  if (mean) figure.panels.push_back(std::move(p.mean));
  const std::string before = "(" + letter + ") ";
  figure.notes.push_back(before + (panel.scene.empty() ? "" : panel.scene + "; ") + operating + "; " +
                         panel.choices);
  figure.notes.push_back(before + jumps + "; " + loss);
  for (const std::string& words : {panel.scene, panel.choices, mean ? loss : ""})
    if (!words.empty())
      figure.captions.push_back((alone ? "" : "{/:Bold " + before.substr(0, 3) + "} ") +
                                without_markup(words));
}

// Whether the other sweep has the motion of a row.
bool found_again(const ResponseResult& r, Eigen::Index row, const ResponseResult& other) {
  constexpr double kAlike = 0.02;  // of the RMS
  for (Eigen::Index i = 0; i < other.mesh_frequency.size(); ++i)
    if (std::abs(other.mesh_frequency[i] / r.mesh_frequency[row] - 1) < 1e-9)
      return std::abs(other.dte_rms(i, 0) - r.dte_rms(row, 0)) < kAlike * r.dte_rms(row, 0);
  return false;
}

}  // namespace

std::vector<bool> broken_after(const ResponseResult& r, const ResponseResult* other) {
  const Eigen::Index n = r.mesh_frequency.size();
  std::vector<bool> jumps(n, false), broken;
  for (const Eigen::Index i : rows_before_jumps(r))
    if (i >= 0) jumps[i] = true;
  broken = jumps;
  const auto change = [&](Eigen::Index i) {
    return i < 0 || i + 1 >= n || jumps[i] ? 0.0 : std::abs(std::log(r.dte_rms(i + 1, 0) / r.dte_rms(i, 0)));
  };
  // Over a wider step one branch crosses a whole resonance.
  constexpr double kWidest = 0.05;  // of the speed
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    if (r.dte_rms(i, 0) > 0 && r.dte_rms(i + 1, 0) > 0 &&
        r.mesh_frequency[i + 1] - r.mesh_frequency[i] < kWidest * r.mesh_frequency[i] &&
        change(i) > std::max(std::log(1.5), 2.5 * std::max(change(i - 1), change(i + 1))) &&
        !(other && found_again(r, i, *other) && found_again(r, i + 1, *other)))
      broken[i] = true;
  return broken;
}

FigureBlock response_block(const std::string& name, const ResponseResult& r, const ResponseResult* other,
                           bool backlash) {
  FigureBlock block{name,
                    {"mesh_frequency [Hz]", "dte_rms [µm]", "dte_mean [µm]", "separation_fraction [1]",
                     "mesh_force_max [N]", "tooth_load_max [N]", "period_multiple [1]"},
                    {},
                    "responses",
                    name};
  if (backlash) block.columns.emplace_back("beyond_backlash [1]");
  const std::vector<bool> broken = broken_after(r, other);
  for (Eigen::Index i = 0; i < r.mesh_frequency.size(); ++i) {
    block.rows.push_back({r.mesh_frequency[i], r.dte_rms(i, 0) * kMicro, r.dte_mean(i, 0) * kMicro,
                          r.separation_fraction(i, 0), r.mesh_force_max(i, 0), r.tooth_load_max(i, 0),
                          static_cast<double>(r.period_multiple[i])});
    if (backlash) block.rows.back().push_back(beyond_backlash(r, i) ? 1 : 0);
    // A line across would pretend that there are states between.
    if (broken[i]) block.rows.emplace_back();
  }
  return block;
}

std::string loss_ranges(const ResponseResult& sweep, double scale, Eigen::Index mesh) {
  std::map<double, bool> lost;
  for (Eigen::Index f = 0; f < sweep.mesh_frequency.size(); ++f)
    lost[sweep.mesh_frequency[f] * scale] = sweep.separation_fraction(f, mesh) > 0;
  const std::string ranges = speed_ranges(lost);
  if (ranges.empty()) return "nowhere";
  return lost.rbegin()->second ? ranges + " or more" : ranges;  // lost at the last speed, too
}

std::string loss_both_ways(const ResponseResult& up, const ResponseResult& down) {
  const std::string rising = loss_ranges(up), falling = loss_ranges(down);
  if (rising == "nowhere" && falling == "nowhere") return "";
  return "rising " + rising + ", falling " + falling + (falling == "nowhere" ? "" : " Hz");
}

Figure response_figure(const std::vector<ResponseResult>& sweeps, const CaptionSources& background,
                       bool mean) {
  if (sweeps.empty())
    fail(Failure::input, "figure: no response.h5 given; an up and a down sweep are the least");
  const std::vector<ChoicePanel<ResponseResult>> panels = panels_of(sweeps, background);
  Figure figure;
  std::vector<double> torques;
  bool any_elastic = false, any_lumped = false;
  for (const auto& r : sweeps) {
    if (std::find(torques.begin(), torques.end(), r.torque) == torques.end()) torques.push_back(r.torque);
    (elastic(r) ? any_elastic : any_lumped) = true;
  }
  figure.title = "Dynamic transmission error (DTE) against mesh frequency, ";
  for (size_t i = 0; i < torques.size(); ++i) figure.title += (i ? ", " : "") + shown(torques[i], 6);
  figure.title += " N m";
  figure.notes.push_back(
      std::string("f_n: ") +
      (any_elastic ? "mean natural frequency over the mesh period, contact frozen under the static load"
                   : "") +
      (any_elastic && any_lumped ? "; one degree of freedom: " : "") +
      (any_lumped ? "natural frequency of the mass on the mean stiffness" : ""));
  figure.shafts = shafts_of_all(sweeps);
  figure.captions = figure.notes;
  figure.columns = mean ? 2 : 1;
  for (size_t p = 0; p < panels.size(); ++p)
    add_panel(figure, letter_of(p), panels[p], background, any_elastic, panels.size() == 1, mean);
  return figure;
}

Figure bearing_force_figure(const std::vector<ResponseResult>& sweeps, const CaptionSources& background) {
  const auto panels = panels_of(sweeps, background);
  const auto& curve = only_curve(panels, "bearing forces against speed");
  const GearMeshSpec& mesh = curve.up->mesh;
  if (!mesh.on_bearings())
    fail(Failure::input,
         "figure: no gear of this pair is on an elastic bearing; add [[bearing]] to the scene");
  Figure figure;
  figure.title = "Forces on the bearings against mesh frequency, " + torque_words(curve.up->torque);
  figure.notes = {operating_words(panels[0], background), panels[0].choices};
  figure.shafts = shafts_of_all(sweeps);
  Panel oscillating{.heading = "RMS of the oscillating part",
                    .x = {.label = "Mesh frequency (Hz)", .speed = true},
                    .y = {.label = "Force (N)", .from_zero = true},
                    .rules = {{'x', curve.up->natural_frequency, "f_n"}}},
      largest = oscillating;
  largest.heading = "largest force";
  int curves = 0;
  for (int g = 0; g < kSides; ++g) {
    const Bearing& bearing = mesh.bearing[g];
    if (!bearing.elastic()) continue;
    ++curves;
    // The second stands on the first, and lets it show where both are alike.
    PanelCurve line{.colour = curves, .width = curves == 1 ? 4.4 : 1.6};
    for (const ResponseResult* r : {curve.up, curve.down}) {
      const std::string name = text(curves, " ", r->direction);
      FigureBlock block{name,
                        {"mesh_frequency [Hz]", "bearing_force_rms [N]", "bearing_force_max [N]"},
                        {},
                        "forces",
                        text(mesh.gear[g], " ", r->direction)};
      const std::vector<bool> broken = broken_after(*r, r == curve.up ? curve.down : curve.up);
      for (Eigen::Index i = 0; i < r->mesh_frequency.size(); ++i) {
        block.rows.push_back({r->mesh_frequency[i], r->bearing_force_rms(i, g), r->bearing_force_max(i, g)});
        if (broken[i]) block.rows.emplace_back();
      }
      figure.blocks.push_back(block);
      line.block = name;
      line.dash = r == curve.up ? 1 : 3;
      line.label = r == curve.down ? ""
                                   : text(without_markup(short_name(mesh.gear[g])), ", ",
                                          shown(bearing.stiffness * 1e-6, 4), " N/µm");
      for (Panel* panel : {&oscillating, &largest}) {
        line.y = panel == &oscillating ? 2 : 3;
        panel->curves.push_back(line);
      }
    }
  }
  largest.rules.push_back(rest_rule(curve.up->gear[0].design, curve.up->torque));
  for (Panel* panel : {&oscillating, &largest}) {
    panel->curves.push_back({.colour = kDark, .label = "dashed: falling", .dash = 3});
    figure.panels.push_back(*panel);
  }
  return figure;
}

Figure face_load_figure(const std::vector<ResponseResult>& sweeps, const CaptionSources& background) {
  const auto panels = panels_of(sweeps, background);
  const auto& curve = only_curve(panels, "load over the face against speed");
  if (curve.up->face_load_factor.size() == 0 || curve.down->face_load_factor.size() == 0)
    fail(
        Failure::input,
        "face-load: these sweeps are of one slice over the face, whose load is the same all over it; write width = \"slices\" in [fidelity] of the scene");
  Figure figure;
  constexpr double kPerMillimetre = 1e-3;  // N m-1 -> N/mm
  figure.title = "Load over the face against mesh frequency, " + torque_words(curve.up->torque);
  figure.notes = {
      operating_words(panels[0], background), panels[0].choices,
      "K_{Hβ}: largest over mean line load of the tooth pair with the largest load, at that instant"};
  figure.shafts = shafts_of_all(sweeps);
  Panel factor{.heading = "face load factor K_{Hβ}",
               .x = {.label = "Mesh frequency (Hz)", .speed = true},
               .y = {.label = "Largest over mean"},
               .rules = {{'x', curve.up->natural_frequency, "f_n"}}},
      largest = factor;
  largest.heading = "largest line load, inner 90 % of face and path";
  largest.y = {.label = "Line load (N/mm)", .from_zero = true};
  for (const ResponseResult* r : {curve.up, curve.down}) {
    const std::string name = text(r->direction);
    FigureBlock block{name,
                      {"mesh_frequency [Hz]", "face_load_factor", "line_load_max [N/mm]"},
                      {},
                      "load over the face",
                      name};
    const std::vector<bool> broken = broken_after(*r, r == curve.up ? curve.down : curve.up);
    for (Eigen::Index i = 0; i < r->mesh_frequency.size(); ++i) {
      block.rows.push_back(
          {r->mesh_frequency[i], r->face_load_factor(i, 0), r->line_load_max(i, 0) * kPerMillimetre});
      if (broken[static_cast<size_t>(i)]) block.rows.emplace_back();
    }
    figure.blocks.push_back(block);
    PanelCurve line{.colour = r == curve.up ? 1 : 2, .width = r == curve.up ? 4.4 : 1.6};
    line.block = name;
    line.label = r == curve.up ? "rising speed" : "falling";
    for (Panel* panel : {&factor, &largest}) {
      line.y = panel == &factor ? 2 : 3;
      panel->curves.push_back(line);
    }
  }
  for (const Panel* panel : {&factor, &largest}) figure.panels.push_back(*panel);
  return figure;
}

}  // namespace whine
