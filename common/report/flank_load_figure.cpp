#include "report/figure_list.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "gear/contact_lines.h"

namespace whine {

using Eigen::Index;

namespace {

constexpr double kNewtonPerMillimetre = 1e-3;  // N m-1 -> N/mm

// N m-1: of a pair at one phase, between its slices; 0 where it does not touch.
double load_at(const FaceLoad& face, Index phase, Index pair, double z) {
  const auto i = static_cast<size_t>(phase);
  if (pair < 0 || pair >= face.line_load[i].rows()) return 0;
  const auto at = face.position[i].row(pair), load = face.line_load[i].row(pair);
  const Index n = at.size();
  if (!(face.width[i](pair, 0) > 0)) return 0;
  if (z <= at[0]) return load[0];
  for (Index k = 1; k < n; ++k)
    if (z <= at[k]) return load[k - 1] + (load[k] - load[k - 1]) * (z - at[k - 1]) / (at[k] - at[k - 1]);
  return load[n - 1];
}

// N m-1: on the tooth of the reference pair where its contact line passes a place of the plane of action (m). Positions of a mesh of a train
// begin at a phase of its own.
double load_on_flank(const StaticResult& s, const GearPair& pair, double z, double path) {
  const double total = (path - std::tan(pair.base_helix_angle()) * z) / pair.base_pitch(),
               period = std::floor(total);
  const Index positions = s.mesh_phase.size();
  const auto n = static_cast<double>(positions);
  const double ahead = (s.mesh_phase[0] - std::floor(s.mesh_phase[0])) * n, first = std::floor(ahead),
               place = (total - period) * n - (ahead - first), before = std::floor(place);
  // k: number of the position by the phase of the mesh, -1 to `positions`.
  const auto load = [&](Index k) {
    const Index turn = k < 0 ? -1 : k >= positions ? 1 : 0, own = k - turn * positions;
    return load_at(s.face, (own - static_cast<Index>(first) + positions) % positions,
                   static_cast<Index>(period) + turn - s.pair[0], z);
  };
  const auto k = static_cast<Index>(before);
  return (1 - (place - before)) * load(k) + (place - before) * load(k + 1);
}

// Line load over face and path of contact as colours, with lines of contact a quarter of a mesh period apart. Returns the largest (N m-1).
double add_flank(const StaticResult& s, const GearPair& pair, const std::string& row, Figure& figure) {
  constexpr int kAcross = 61, kAlong = 81;
  FigureBlock flank{"flank" + row, {"face [mm]", "path of contact [mm]", "line load [N/mm]"}, {}};
  flank.rows.reserve(static_cast<size_t>(kAcross) * kAlong);
  const double half = 0.5 * pair.face_width();
  double most = 0;
  for (int i = 0; i < kAlong; ++i) {
    const double path = pair.path_start() + (pair.path_end() - pair.path_start()) * (i + 0.5) / kAlong;
    for (int k = 0; k < kAcross; ++k) {
      const double z = half * (2 * (k + 0.5) / kAcross - 1), load = load_on_flank(s, pair, z, path);
      most = std::max(most, load);
      flank.rows.push_back({z * kMilli, path * kMilli, load * kNewtonPerMillimetre});
    }
  }
  figure.blocks.push_back(flank);
  FigureBlock lines{"lines" + row, {"face [mm]", "path of contact [mm]"}, {}, "", "", true};
  for (int quarter = 0; quarter < 4; ++quarter)
    for (const ContactLine& line : contact_lines(pair, 0.25 * quarter)) {
      for (const double z : {line.from, line.to})
        lines.rows.push_back({z * kMilli, path_at(pair, 0.25 * quarter + line.pair, z) * kMilli});
      lines.rows.push_back({});
    }
  figure.blocks.push_back(lines);
  return most;
}

// Line load of each tooth pair at mesh phase 0, one block each.
Panel pairs_panel(const StaticResult& s, const std::string& row, const std::string& table, Figure& figure) {
  const auto positions = static_cast<double>(s.mesh_phase.size());
  // Of a train: the position nearest to phase 0 of the mesh, whose pairs may be numbered one on.
  const double ahead = s.mesh_phase[0] - std::floor(s.mesh_phase[0]);
  const auto at = static_cast<Index>(std::lround((1 - ahead) * positions)) % static_cast<Index>(positions);
  const auto i = static_cast<size_t>(at);
  const int turn = static_cast<int>(
      std::lround(s.mesh_phase[at] - std::floor(s.mesh_phase[at])));  // 1: just before phase 0
  Panel panel{.heading = "at mesh phase 0",
              .x = {.label = "Along the face, from its middle (mm)"},
              .y = {.label = "Line load (N/mm of face)", .from_zero = true}};
  for (Index k = 0; k < s.pair.size() && panel.curves.size() < kMostCurves; ++k) {
    if (!(s.face.width[i](k, 0) > 0) || !(s.tooth_load(at, k) > 0)) continue;
    const size_t curve = panel.curves.size();
    FigureBlock block{text("pair", row, " ", curve + 1),
                      {"face [mm]", "line load [N/mm]"},
                      {},
                      table,
                      text("pair ", s.pair[k] + turn)};
    for (Index q = 0; q < s.face.line_load[i].cols(); ++q)
      block.rows.push_back(
          {s.face.position[i](k, q) * kMilli, s.face.line_load[i](k, q) * kNewtonPerMillimetre});
    panel.curves.push_back({.block = block.name,
                            .style = PanelStyle::line_points,
                            .colour = curve_colour(curve),
                            .label = "tooth " + block.curve,
                            .size = 0.8});
    figure.blocks.push_back(std::move(block));
  }
  return panel;
}

Panel flank_panel(const StaticResult& s, const GearPair& pair, const std::string& row, Figure& figure) {
  const double half = 0.5 * pair.face_width() * kMilli, largest = add_flank(s, pair, row, figure);
  return {
      .heading = "line load and lines of contact",
      .x = {.label = "Along the face, from its middle (mm)", .from = -half, .to = half},
      .y = {.label = "Path of contact, driver's root to tip (mm)",
            .from = pair.path_start() * kMilli,
            .to = pair.path_end() * kMilli},
      .curves = {{.block = "flank" + row, .style = PanelStyle::image, .heat = 3},
                 {.block = "lines" + row, .colour = kDark, .width = 1.4, .dash = 3}},
      .key = PanelKey::none,
      .height = 560,
      .colours = PanelAxis{
          .label = "Line load (N/mm)", .from = 0, .to = largest > 0 ? largest * kNewtonPerMillimetre : 1}};
}

// Of a gear at each place over its face: the largest root stress of all phases and teeth, all of it and the inner 90 %.
void add_roots(const StaticResult& s, size_t g, const std::string& row, Panel& panel, Figure& figure) {
  const FaceLoad& face = s.face;
  const Eigen::VectorXd& z = face.root_position[g];
  Eigen::VectorXd most = Eigen::VectorXd::Zero(z.size());
  for (const MatrixRM& phase : face.root_stress[g])
    most = most.cwiseMax(phase.colwise().maxCoeff().transpose());
  const std::vector<std::string> columns{"face [mm]", "root_stress [MPa]"};
  FigureBlock whole{text("root", row, " ", g + 1), columns, {}, "root stress" + row, s.mesh.gear[g]},
      inner{text("inner root", row, " ", g + 1), columns, {}};
  const double middle = 0.5 * (z[0] + z[z.size() - 1]), half = kClearOfCorners * (z[z.size() - 1] - middle);
  for (Index k = 0; k < z.size(); ++k) {
    whole.rows.push_back({z[k] * kMilli, most[k] * kInMegapascals});
    if (std::abs(z[k] - middle) <= half * (1 + 1e-9)) inner.rows.push_back(whole.rows.back());
  }
  const auto i = static_cast<Index>(g);
  panel.curves.push_back({.block = whole.name, .colour = curve_colour(g), .width = 1.4, .dash = 2});
  panel.curves.push_back({.block = inner.name,
                          .colour = curve_colour(g),
                          .label = text(without_markup(short_name(s.mesh.gear[g])), ": ",
                                        rounded(s.root_stress_max[i] * kInMegapascals, 1), " ± ",
                                        shown(face.root_stress_error[i] * kInMegapascals, 1), " MPa, K_{Fβ} ",
                                        rounded(face.load_factor_root[i], 2)),
                          .width = g == 0 ? 4.4 : 2.2});
  figure.blocks.push_back(std::move(whole));
  figure.blocks.push_back(std::move(inner));
}

Panel roots_panel(const StaticResult& s, const std::string& row, Figure& figure) {
  Panel panel{
      .heading = "root stress across the helix, largest of all mesh phases; broken: the ends of the face",
      .x = {.label = "Along the face, from its middle (mm)"},
      .y = {.label = "Root stress (MPa)", .from_zero = true},
      .key = PanelKey::below,
      .height = 300,
      .wide = true};
  for (size_t g = 0; g < kSides; ++g) add_roots(s, g, row, panel, figure);
  return panel;
}

// Of each [[mesh]] the one with the largest line load; of those that are alike but for the phases that are computed, the first.
std::vector<size_t> shown_meshes(const SystemStaticResult& all) {
  constexpr double kClearly = 1.01;
  const std::vector<int>& section = all.settings.section;
  std::vector<size_t> out;
  for (size_t m = 0; m < all.mesh.size(); ++m) {
    const auto same =
        std::find_if(out.begin(), out.end(), [&](size_t own) { return section[own] == section[m]; });
    if (same == out.end())
      out.push_back(m);
    else if (all.mesh[m].face.line_load_max > kClearly * all.mesh[*same].face.line_load_max)
      *same = m;
  }
  return out;
}

}  // namespace

Figure flank_load_figure(const SystemStaticResult& all) {
  if (all.mesh[0].face.none())
    fail(
        Failure::input,
        "flank-load: this static.h5 is of one slice over the face, whose load is the same all over it; write width = \"slices\" in [fidelity] of the scene");
  const std::vector<size_t> drawn = shown_meshes(all);
  const bool train = all.of_train();
  Figure figure;
  figure.title =
      train ? "Load over the flanks" : text("Load over the flank, ", torque_words(all.mesh[0].torque));
  figure.columns = 2;
  for (size_t r = 0; r < drawn.size(); ++r) {
    const StaticResult& s = all.mesh[drawn[r]];
    const GearPair pair(s);
    const std::string row = text(" ", r + 1), &name = all.mesh_names[drawn[r]];
    const std::string factor =
        text("K_{Hβ} ", rounded(s.face.load_factor, 3), " ± ", shown(s.face.load_factor_error, 1));
    figure.notes.push_back(train ? name + ": " + pair_words(s) : pair_words(s));
    if (!train || r + 1 == drawn.size())
      figure.notes.push_back(text(
          train ? "K_{Hβ}" : factor, " of the reference pair at mesh phase 0, ", s.face.line_load[0].cols(),
          " points along each contact line, a quarter of a mesh period between the lines, misalignment ",
          rounded(s.mesh.misalignment * kMicro, 2), " µm"));
    figure.panels.push_back(flank_panel(s, pair, row, figure));
    if (train)
      figure.panels.back().heading =
          without_markup(name) + text(", ", rounded(s.torque, 1), " N m: ") + factor;
    figure.panels.push_back(
        pairs_panel(s, row, train ? "line load of " + name : "line load at mesh phase 0", figure));
    if (s.face.load_factor_root.size() > 0) figure.panels.push_back(roots_panel(s, row, figure));
  }
  // One scale for all flanks.
  double most = 0;
  for (const Panel& panel : figure.panels)
    if (panel.colours) most = std::max(most, panel.colours->to);
  for (Panel& panel : figure.panels)
    if (panel.colours) panel.colours->to = most;
  return figure;
}

}  // namespace whine
