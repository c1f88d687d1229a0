#include "report/figure_list.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "report/level_lines.h"

namespace whine {
namespace {

using Eigen::Index;

std::string panel_name(const JumpMapResult& a) {
  if (!elastic(a))
    return name_of(a.model) + (a.damper_acts == DamperActs::contact ? ", damper in contact" : "");
  const CornerRule& corner = a.mesh.corner;
  const std::string rule =
      !corner.enabled ? "no corner contact"
      : std::isinf(corner.largest_angle)
          ? "corner contact"
          : "corner contact up to " + rounded(corner.largest_angle * 180 / std::numbers::pi, 3) + "°";
  return a.damping.rayleigh_mass > 0 ? text(rule, ", mu ", rounded(a.damping.rayleigh_mass, 0), " 1/s")
                                     : rule;
}

bool lost(const JumpMapResult& a, Index c) {
  return a.loss_to[c] > 0;
}

// The case of a ratio; -1 if the map has none within 1e-4 of it.
Index case_of(const JumpMapResult& a, double ratio) {
  for (Index c = 0; c < a.damping_ratio.size(); ++c)
    if (std::abs(a.damping_ratio[c] - ratio) < 1e-4 * ratio) return c;
  return -1;
}

// "20 to 600", "100, 150", "none" of those that hold.
std::string torques_where(const std::vector<const JumpMapResult*>& panel,
                          const std::function<bool(const JumpMapResult&)>& holds) {
  std::string list;
  size_t count = 0;
  for (const JumpMapResult* a : panel)
    if (holds(*a)) {
      list += text(list.empty() ? "" : ", ", a->torque);
      ++count;
    }
  if (count == 0) return "no torque";
  if (count == panel.size())
    return text("every torque from ", panel[0]->torque, " to ", panel.back()->torque, " N m");
  return list + " N m";
}

// Damping ratio at which contact loss ends, between the cases beside; 0 if the map does not show it.
double ratio_of_loss(const JumpMapResult& a) {
  std::vector<Index> order(a.damping_ratio.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Index i, Index j) { return a.damping_ratio[i] < a.damping_ratio[j]; });
  for (size_t i = order.size(); i-- > 1;)
    if (lost(a, order[i - 1]) && !lost(a, order[i]))
      return 0.5 * (a.damping_ratio[order[i - 1]] + a.damping_ratio[order[i]]);
  return 0;
}

// (first harmonic / mean of the stiffness) / damping ratio: the least that loses contact, the most that keeps it.
struct Needed {
  double least_lost = 1e300, most_kept = 0;
};

Needed needed_for_loss(const std::vector<const JumpMapResult*>& maps) {
  Needed needed;
  for (const JumpMapResult* a : maps)
    for (Index c = 0; c < a->damping_ratio.size(); ++c) {
      const double times = a->first_harmonic / a->mean_stiffness / a->damping_ratio[c];
      if (lost(*a, c))
        needed.least_lost = std::min(needed.least_lost, times);
      else
        needed.most_kept = std::max(needed.most_kept, times);
    }
  return needed;
}

using MapPanel = std::pair<std::string, std::vector<const JumpMapResult*>>;

std::vector<MapPanel> map_panels(const std::vector<JumpMapResult>& maps) {
  std::vector<MapPanel> panels;
  for (const JumpMapResult& a : maps) {
    if (a.damping_ratio.size() != maps[0].damping_ratio.size() ||
        !((a.damping_ratio - maps[0].damping_ratio).cwiseAbs().maxCoeff() <
          1e-4 * maps[0].damping_ratio.minCoeff()))
      fail(Failure::input, "the maps of ", maps[0].torque, " and ", a.torque,
           " N m have other damping ratios; make all of them again");
    const std::string name = panel_name(a);
    auto panel =
        std::find_if(panels.begin(), panels.end(), [&](const MapPanel& p) { return p.first == name; });
    if (panel == panels.end()) panel = panels.insert(panels.end(), {name, {}});
    for (const JumpMapResult* other : panel->second)
      if (other->torque == a.torque) fail(Failure::input, "two maps of ", a.torque, " N m with ", name);
    panel->second.push_back(&a);
  }
  for (MapPanel& panel : panels) {
    std::sort(panel.second.begin(), panel.second.end(),
              [](const JumpMapResult* a, const JumpMapResult* b) { return a->torque < b->torque; });
    const auto same = [](const JumpMapResult* a, const JumpMapResult* b) { return a->torque == b->torque; };
    if (!std::equal(panel.second.begin(), panel.second.end(), panels[0].second.begin(),
                    panels[0].second.end(), same))
      fail(Failure::input, "the panels '", panels[0].first, "' and '", panel.first,
           "' have other torques; give one map per torque and rule");
  }
  return panels;
}

FigureBlock cells(const std::string& name, const std::vector<const JumpMapResult*>& maps) {
  FigureBlock block{name,
                    {"damping_ratio [%]",
                     "torque [N m]",
                     "ratio_low [%]",
                     "ratio_high [%]",
                     "torque_low [N m]",
                     "torque_high [N m]",
                     "class [0 contact kept, 1 lost, 2 two branches]",
                     "sustained_tooth_load [kN]",
                     "branches_from [Hz]",
                     "branches_to [Hz]",
                     "open_below [1]",
                     "loss_from [Hz]",
                     "loss_to [Hz]",
                     "sustained_there_up [kN]",
                     "sustained_there_down [kN]",
                     "sampled_there_up [kN]",
                     "sampled_there_down [kN]",
                     "sampled_peak_up [kN]",
                     "sampled_peak_down [kN]",
                     "rayleigh_stiffness [1e-6 s]",
                     "first_harmonic_over_mean [1]",
                     "excitation [1]",
                     "unsteady [1]"},
                    {},
                    "maps"};
  std::vector<double> ratio, torque;
  for (double r : maps[0]->damping_ratio) ratio.push_back(r * 100);
  for (const JumpMapResult* a : maps) torque.push_back(std::log10(a->torque));
  const std::vector<double> x = cell_edges(ratio), y = cell_edges(torque);
  for (size_t t = 0; t < maps.size(); ++t) {
    const JumpMapResult& a = *maps[t];
    if (t > 0) block.rows.emplace_back();
    for (Index c = 0; c < a.damping_ratio.size(); ++c) {
      const bool at = a.load_frequency > 0;
      block.rows.push_back({ratio[c],
                            a.torque,
                            x[c],
                            x[c + 1],
                            std::pow(10, y[t]),
                            std::pow(10, y[t + 1]),
                            a.two_branches[c] ? 2.0
                            : lost(a, c)      ? 1.0
                                              : 0.0,
                            a.sustained_tooth_load.row(c).maxCoeff() * 1e-3,
                            a.branches_from[c],
                            a.branches_to[c],
                            static_cast<double>(a.open_below[c]),
                            a.loss_from[c],
                            a.loss_to[c],
                            at ? a.sustained_load_there(c, 0) * 1e-3 : 0,
                            at ? a.sustained_load_there(c, 1) * 1e-3 : 0,
                            at ? a.tooth_load(c, 0) * 1e-3 : 0,
                            at ? a.tooth_load(c, 1) * 1e-3 : 0,
                            a.peak_tooth_load(c, 0) * 1e-3,
                            a.peak_tooth_load(c, 1) * 1e-3,
                            a.rayleigh_stiffness[c] * 1e6,
                            a.first_harmonic / a.mean_stiffness,
                            a.excitation[c],
                            static_cast<double>(a.unsteady[c])});
    }
  }
  return block;
}

std::string loads_in_words(const JumpMapResult& a, Index c) {
  const double up = a.sustained_load_there(c, 0) * 1e-3, down = a.sustained_load_there(c, 1) * 1e-3;
  const bool both =
      a.two_branches[c] && a.branches_from[c] < a.load_frequency && a.load_frequency < a.branches_to[c];
  return both ? text(rounded(up, 2), " and ", rounded(down, 2)) : rounded(up, 2);
}

// Cases ascend on the axis.
void require_ascending(const std::vector<JumpMapResult>& maps) {
  for (const JumpMapResult& a : maps)
    for (Index c = 1; c < a.damping_ratio.size(); ++c)
      if (!(a.damping_ratio[c] > a.damping_ratio[c - 1]))
        fail(Failure::input, "the damping ratios of the map at ", a.torque,
             " N m do not ascend: ", a.damping_ratio[c - 1], ", then ", a.damping_ratio[c]);
}

bool same_corner(const JumpMapResult& a, const JumpMapResult& b) {
  const CornerRule &x = a.mesh.corner, &y = b.mesh.corner;
  return x.enabled == y.enabled && (!x.enabled || x.largest_angle == y.largest_angle);
}

std::string joined_or_none(const std::vector<std::string>& words, const std::string& between) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
  return all.empty() ? "none" : all;
}

// Share of the cells, in percent, in which two maps answer alike.
double alike(const MapPanel& one, const MapPanel& other,
             const std::function<bool(const JumpMapResult&, Index)>& verdict) {
  double same = 0, cells = 0;
  for (size_t t = 0; t < one.second.size(); ++t)
    for (Index c = 0; c < one.second[t]->damping_ratio.size(); ++c, ++cells)
      same += verdict(*one.second[t], c) == verdict(*other.second[t], c);
  return 100 * same / cells;
}

// Nothing if the gears of the maps are not those of the publication.
void keep_if_of(const std::vector<JumpMapResult>& maps, PrintedJumps& printed) {
  if (!printed.of_pair || !printed.of_pair(maps[0])) printed = {};
}

// The printed damping ratio if the map has it, else that in its middle.
double shown_ratio(const JumpMapResult& a, double printed) {
  return case_of(a, printed) >= 0 ? printed : a.damping_ratio[a.damping_ratio.size() / 2];
}

// What the teeth carry at one torque in the case `at`, beside printed loads; and how far single samples go beyond sustained loads.
void add_load_notes(const std::vector<JumpMapResult>& maps, const std::vector<MapPanel>& panels, Index at,
                    double ratio, const PrintedJumps& printed, std::vector<std::string>& notes) {
  std::string loads = printed.loads.empty() ? "" : printed.source + " prints " + printed.loads;
  double torque = printed.load_torque;
  bool known = false;
  for (const MapPanel& panel : panels)
    for (const JumpMapResult* a : panel.second) {
      if (!(a->load_frequency > 0)) continue;
      if (torque == 0) torque = a->torque;
      if (a->torque != torque) continue;
      loads += text(loads.empty() ? "" : "; ", panel.first, " ", loads_in_words(*a, at));
      known = true;
    }
  if (known)
    notes.push_back(text("tooth loads in kN at ", torque_words(torque), ", ", rounded(ratio * 100, 2), " %, ",
                         maps[0].load_frequency, " Hz: ", loads));
  double spike = 1;
  std::string where = panels[0].first;
  for (const MapPanel& panel : panels)
    for (const JumpMapResult* a : panel.second)
      if (const double ratio_of = (a->peak_tooth_load.array() / a->sustained_tooth_load.array()).maxCoeff();
          ratio_of > spike) {
        spike = ratio_of;
        where = panel.first;
      }
  notes.push_back(text("tooth loads are sustained for 1/64 of a mesh period; single samples reach ",
                       rounded(spike, 2), " times as much (", where,
                       "): spikes at entry, as high as the time step lets them"));
}

void add_needed_note(const std::vector<JumpMapResult>& maps, std::vector<std::string>& notes) {
  std::vector<double> needed;
  std::vector<const JumpMapResult*> all;
  for (const JumpMapResult& a : maps) {
    all.push_back(&a);
    if (const double edge = ratio_of_loss(a); edge > 0)
      needed.push_back(a.first_harmonic / a.mean_stiffness / edge);
  }
  const auto [least_lost, most_kept] = needed_for_loss(all);
  if (!needed.empty()) {
    std::sort(needed.begin(), needed.end());
    notes.push_back(text("loss needs (first harmonic / mean of the stiffness) / damping ratio above ",
                         rounded(needed[needed.size() / 2], 2), " (median of ", needed.size(), " limits, ",
                         rounded(needed.front(), 2), " to ", rounded(needed.back(), 2), "); no cell below ",
                         rounded(least_lost, 2), " loses contact, none above ", rounded(most_kept, 2),
                         " keeps it"));
  }
}

std::vector<std::string> jump_map_notes(const std::vector<JumpMapResult>& maps,
                                        const std::vector<MapPanel>& panels, const PrintedJumps& printed) {
  std::vector<std::string> notes;
  // Which choices lose contact at every torque, and what the teeth then carry.
  const double ratio = shown_ratio(maps[0], printed.damping_ratio);
  const Index at = case_of(maps[0], ratio);
  std::string everywhere;
  for (const MapPanel& panel : panels)
    if (std::all_of(panel.second.begin(), panel.second.end(),
                    [&](const JumpMapResult* a) { return lost(*a, at); }))
      everywhere += text(everywhere.empty() ? "" : "; ", panel.first);
  notes.reserve(notes.size() + panels.size());
  for (const MapPanel& panel : panels)
    notes.push_back(
        text("at ", rounded(ratio * 100, 2), " %, ", panel.first, ": two branches at ",
             torques_where(panel.second, [&](const JumpMapResult& a) { return a.two_branches[at] == 1; }),
             ", contact lost at ",
             torques_where(panel.second, [&](const JumpMapResult& a) { return lost(a, at); })));
  notes.push_back(
      text("contact is lost at every torque with: ", everywhere.empty() ? "none of these" : everywhere,
           printed.torques.empty()
               ? ""
               : "; " + printed.source + " prints jumps at " + printed.torque_words + " (diamonds)"));
  add_load_notes(maps, panels, at, ratio, printed, notes);
  add_needed_note(maps, notes);
  const JumpMapResult& first = maps[0];
  notes.push_back(text(first.mesh_frequency.size(), " speeds from ", rounded(first.mesh_frequency[0], 0),
                       " to ", rounded(first.mesh_frequency[first.mesh_frequency.size() - 1], 0),
                       " Hz, up and down; contact = ", first.fidelity.contact, ", body = ",
                       first.fidelity.body, "; lines: largest tooth load of these speeds, any branch"));
  return notes;
}

bool two_branches(const JumpMapResult& a, Index c) {
  return a.two_branches[c] == 1;
}

const JumpMapResult* at_torque(const MapPanel& panel, double torque) {
  for (const JumpMapResult* a : panel.second)
    if (a->torque == torque) return a;
  return nullptr;
}

// Where contact is lost at the printed low torque and kept at the others.
struct LostAtLowTorque {
  std::vector<std::string> ratios;  // damping ratios (%) at which a panel does so
  bool low = false;                 // at the case `at`: lost at some torque below those others only
};

// first: the map whose damping ratios are named.
LostAtLowTorque lost_at_low_torque(const MapPanel& panel, const JumpMapResult& first, Index at,
                                   const PrintedJumps& printed) {
  const auto kept = [&](Index c) {
    return std::none_of(printed.kept_torques.begin(), printed.kept_torques.end(),
                        [&](double torque) { return lost(*at_torque(panel, torque), c); });
  };
  LostAtLowTorque found;
  for (Index c = 0; c < first.damping_ratio.size(); ++c)
    if (lost(*at_torque(panel, printed.lost_torque), c) && kept(c))
      found.ratios.push_back(rounded(100 * first.damping_ratio[c], 2));
  found.low = kept(at) && std::any_of(panel.second.begin(), panel.second.end(), [&](const JumpMapResult* a) {
                return a->torque < printed.kept_torques.front() && lost(*a, at);
              });
  return found;
}

// "kept at 200 and 300 N m"; "" where none is printed.
std::string kept_words(const PrintedJumps& printed) {
  std::string words;
  for (const double torque : printed.kept_torques)
    words += text(words.empty() ? "kept at " : " and ", torque);
  return words.empty() ? "" : words + " N m";
}

// A line for each panel, then what they have in common, then what (a), (b) and (c) mean. at: the case of the damping ratio.
std::vector<std::string> lumped_notes(const std::vector<JumpMapResult>& maps,
                                      const std::vector<MapPanel>& panels, Index at, double ratio,
                                      const JumpMapResult& reference, const PrintedJumps& printed) {
  const bool beside = elastic(*panels[0].second[0]);
  const std::string percent = text(rounded(ratio * 100, 2), " %"), kept = kept_words(printed);
  const bool low_torque = !kept.empty() && at_torque(panels[0], printed.lost_torque) &&
                          std::all_of(printed.kept_torques.begin(), printed.kept_torques.end(),
                                      [&](double torque) { return at_torque(panels[0], torque); });
  std::vector<std::string> notes, jumping, losing, low;
  for (const MapPanel& panel : panels) {
    const auto everywhere = [&](const auto& holds) {
      return std::all_of(panel.second.begin(), panel.second.end(),
                         [&](const JumpMapResult* a) { return holds(*a, at); });
    };
    if (everywhere(two_branches)) jumping.push_back(panel.first);
    if (everywhere(lost)) losing.push_back(panel.first);
    const auto [least_lost, most_kept] = needed_for_loss(panel.second);
    std::string said = text(
        panel.first, ": at ", percent, " two branches at ",
        torques_where(panel.second, [&](const JumpMapResult& a) { return two_branches(a, at); }),
        ", contact lost at ",
        torques_where(panel.second, [&](const JumpMapResult& a) { return lost(a, at); }), "; (a) ",
        least_lost < 1e300 ? rounded(least_lost, 2) : "-", "/", most_kept > 0 ? rounded(most_kept, 2) : "-");
    if (beside && &panel != &panels[0])
      said += text("; (b) ", rounded(alike(panels[0], panel, lost), 0), "/",
                   rounded(alike(panels[0], panel, two_branches), 0), " %");
    if (low_torque) {
      const LostAtLowTorque found = lost_at_low_torque(panel, maps[0], at, printed);
      said += text("; (c) ", joined_or_none(found.ratios, ", "), found.ratios.empty() ? "" : " %");
      if (found.low) low.push_back(panel.first);
    }
    notes.push_back(said);
  }
  notes.push_back(text("at ", percent, " two branches at every torque: ", joined_or_none(jumping, "; "),
                       "; contact lost at every torque: ", joined_or_none(losing, "; ")));
  if (low_torque)
    notes.push_back(
        text("at ", percent, " lost at low torque only, ", kept, ": ", joined_or_none(low, "; ")));
  notes.push_back(
      "(a) (first harmonic / mean of the stiffness) / damping ratio: lowest that loses contact / highest that keeps it");
  if (beside)
    notes.push_back(
        "(b) cells in which the model does as the elastic pair at that damping ratio: contact lost or kept / two branches or not");
  if (low_torque)
    notes.push_back(text("(c) damping ratios at which contact is lost at ", torque_words(printed.lost_torque),
                         ", ", kept, ", as of ", printed.lost_words));
  notes.push_back(text(
      "damping ratios: lumped models c / 2 sqrt(mean stiffness x mass)",
      printed.source.empty()
          ? ""
          : text(", as ", printed.source, "'s ", rounded(printed.lumped_damping_ratio * 100, 2), " %"),
      beside ? "; elastic pair: with two pairs in contact" : "", "; ", reference.mesh_frequency.size(),
      " speeds, steps of ",
      rounded(
          reference.mesh_frequency.size() > 1 ? reference.mesh_frequency[1] - reference.mesh_frequency[0] : 0,
          1),
      " Hz, up and down"));
  return notes;
}

// The highest cusps over damping of a panel's corner rule, torques ascending.
FigureBlock cusps_of(const std::string& block_name, const JumpMapResult& panel,
                     const std::vector<FoldCurvesResult>& curves) {
  FigureBlock block{block_name, {"damping_ratio [%]", "torque [N m]"}, {}};
  block.table = "cusps";
  block.curve = panel_name(panel);
  for (const FoldCurvesResult& a : curves)
    if (a.quantity == FoldQuantity::damping && a.cusp_value.size() > 0 &&
        a.mesh.corner.enabled == panel.mesh.corner.enabled &&
        a.mesh.corner.largest_angle == panel.mesh.corner.largest_angle)
      block.rows.push_back({a.cusp_damping_ratio.maxCoeff() * kPercent, a.torque});
  std::sort(block.rows.begin(), block.rows.end(), [](const auto& x, const auto& y) { return x[1] < y[1]; });
  return block;
}

struct CellClass {
  const char* words;
  int colour;
  double fill;
};
constexpr std::array<CellClass, 3> kCellClasses{
    {{"contact kept", kBlue, 0.15}, {"lost, one branch", kOrange, 0.4}, {"two branches", kVermilion, 0.6}}};

// Cells of a map by their class, over damping and torque.
Panel cells_panel(const FigureBlock& cells, double marked_ratio, bool first, int height) {
  Panel panel{.heading = cells.curve,
              .x = {.label = "Damping ratio (%)", .from = cells.rows.front()[2], .to = cells.rows.back()[3]},
              .y = {.label = first ? "Torque (N m)" : "",
                    .from = cells.rows.front()[4],
                    .to = cells.rows.back()[5],
                    .log = true},
              .rules = {{.at = marked_ratio}},
              .key = PanelKey::none,
              .height = height,
              .letter = false};
  for (size_t n = 0; n < kCellClasses.size(); ++n)
    panel.curves.push_back({.block = cells.name,
                            .style = PanelStyle::boxes,
                            .colour = kCellClasses[n].colour,
                            .where = 7,
                            .is = static_cast<double>(n),
                            .box = {3, 4, 5, 6},
                            .fill = kCellClasses[n].fill});
  return panel;
}

// What the cells mean, below the row of that panel.
void add_key(Panel& panel) {
  panel.key = PanelKey::below;
  for (size_t n = 0; n < kCellClasses.size(); ++n) panel.curves[n].label = kCellClasses[n].words;
}

// Largest tooth load (kN) over damping and torque, which stands on a logarithmic axis.
LevelLines load_lines(const FigureBlock& cells, const std::vector<const JumpMapResult*>& maps) {
  constexpr int kLines = 8;
  const Index ratios = maps[0]->damping_ratio.size(), torques = static_cast<Index>(maps.size());
  MatrixRM load(torques, ratios);
  Eigen::VectorXd torque(torques);
  for (Index t = 0; t < torques; ++t) {
    const JumpMapResult& a = *maps[static_cast<size_t>(t)];
    torque[t] = std::log10(a.torque);
    load.row(t) = 1e-3 * a.sustained_tooth_load.rowwise().maxCoeff().transpose();
  }
  LevelLines out = level_lines("load lines of " + cells.curve, {"damping_ratio [%]", "torque [N m]"},
                               maps[0]->damping_ratio * kPercent, torque, load, kLines);
  for (auto& row : out.lines.rows)
    if (!row.empty()) row[1] = std::pow(10, row[1]);
  for (PanelWords& number : out.numbers) number.y = std::pow(10, number.y);
  return out;
}

}  // namespace

Figure jump_map_figure(std::vector<JumpMapResult> maps, const std::vector<FoldCurvesResult>& curves,
                       PrintedJumps printed) {
  if (maps.empty()) fail(Failure::input, "a map of jumps needs one artifact at least");
  require_ascending(maps);
  const std::vector<MapPanel> panels = map_panels(maps);
  keep_if_of(maps, printed);
  Figure figure;
  figure.title = "Jumps, contact loss and tooth loads of the primary resonance";

  figure.notes = jump_map_notes(maps, panels, printed);

  constexpr int kHeight = 460;
  const double ratio = shown_ratio(maps[0], printed.damping_ratio) * kPercent;
  const auto add = [&](Panel& panel, FigureBlock block, PanelCurve curve, const std::string& label) {
    if (block.rows.empty()) return;
    curve.block = block.name;
    if (panel.key != PanelKey::none) curve.label = label;
    panel.curves.push_back(curve);
    figure.blocks.push_back(std::move(block));
  };
  figure.columns = panels.size();
  for (size_t p = 0; p < panels.size(); ++p) {
    const auto& [name, of] = panels[p];
    figure.blocks.push_back(cells(text("panel", p + 1), of));
    figure.blocks.back().curve = name;
    Panel panel = cells_panel(figure.blocks.back(), ratio, p == 0, kHeight);
    if (p == 0) add_key(panel);
    LevelLines loads = load_lines(FigureBlock(figure.blocks.back()), of);
    panel.words = loads.numbers;
    add(panel, std::move(loads.lines), {.colour = kBlue, .width = 1.6}, "largest tooth load, kN");
    add(panel, cusps_of(text("cusps", p + 1), *of[0], curves),
        {.style = PanelStyle::line_points, .colour = kDark, .width = 3, .mark = 6, .size = 1.6},
        "cusp of the folds: two branches to the left");
    if (!printed.torques.empty()) {
      FigureBlock marks{text("printed", p + 1), {"damping_ratio [%]", "torque [N m]"}, {}, "", "", true};
      for (double torque : printed.torques) marks.rows.push_back({printed.damping_ratio * kPercent, torque});
      add(panel, std::move(marks), {.style = PanelStyle::points, .colour = kBlack, .mark = 13, .size = 2.2},
          text(printed.source, ": jump printed at ", rounded(printed.damping_ratio * kPercent, 2), " %"));
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

Figure lumped_jump_map_figure(std::vector<JumpMapResult> maps, PrintedJumps printed) {
  const auto lumped = std::find_if(maps.begin(), maps.end(), [](const auto& a) { return !elastic(a); });
  if (lumped == maps.end())
    fail(Failure::input, "a map of lumped models needs one of their artifacts at least");
  // The elastic pair beside them has the corner rule of the statics that they are made from.
  const JumpMapResult reference = *lumped;
  std::erase_if(maps, [&](const JumpMapResult& a) { return elastic(a) && !same_corner(a, reference); });
  std::stable_partition(maps.begin(), maps.end(), elastic<JumpMapResult>);
  require_ascending(maps);
  std::vector<MapPanel> panels = map_panels(maps);
  if (elastic(*panels[0].second[0])) panels[0].first = "elastic pair, " + panels[0].first;

  Figure figure;
  figure.title = "Jumps and contact loss of lumped models";
  keep_if_of(maps, printed);
  const double ratio = shown_ratio(maps[0], printed.lumped_damping_ratio);
  const Index at = case_of(maps[0], ratio);
  figure.notes = lumped_notes(maps, panels, at, ratio, reference, printed);

  // A column per model, below it the same with the damper in contact only.
  std::vector<MotionModel> columns;
  for (const MapPanel& panel : panels)
    if (const MotionModel model = panel.second[0]->model;
        std::find(columns.begin(), columns.end(), model) == columns.end())
      columns.push_back(model);
  figure.columns = columns.size();
  figure.panels.resize(2 * columns.size(), {.height = 250});
  for (size_t p = 0; p < panels.size(); ++p) {
    const JumpMapResult& a = *panels[p].second[0];
    figure.blocks.push_back(cells(text("panel", p + 1), panels[p].second));
    figure.blocks.back().curve = panels[p].first;
    const auto column =
        static_cast<size_t>(std::find(columns.begin(), columns.end(), a.model) - columns.begin());
    const bool in_contact = a.damper_acts == DamperActs::contact;
    figure.panels[column + (in_contact ? columns.size() : 0)] =
        cells_panel(figure.blocks.back(), 100 * ratio, column == 0 || in_contact, 250);
  }
  add_key(*std::find_if(figure.panels.rbegin(), figure.panels.rend(),
                        [](const Panel& panel) { return !panel.curves.empty(); }));
  return figure;
}

}  // namespace whine
