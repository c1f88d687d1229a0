#include "report/figure_list.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "gear/contact_lines.h"

namespace whine {

using Eigen::Index;

namespace {

constexpr double kNewtonPerMillimetre = 1e-3;  // N m-1 -> N/mm
constexpr int kRowHeight = 890,
              kNameHeight = 50;  // pixels, of each mesh beyond the first, as in flank-load.gp; of its name

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

struct PairLoads {
  std::string labels;
  int curves = 0;
  double largest = 0;  // N m-1
};

// Line load of each tooth pair at mesh phase 0, one block each.
PairLoads add_pairs(const StaticResult& s, const std::string& row, const std::string& table, Figure& figure) {
  const auto positions = static_cast<double>(s.mesh_phase.size());
  // Of a train: the position nearest to phase 0 of the mesh, whose pairs may be numbered one on.
  const double ahead = s.mesh_phase[0] - std::floor(s.mesh_phase[0]);
  const auto at = static_cast<Index>(std::lround((1 - ahead) * positions)) % static_cast<Index>(positions);
  const auto i = static_cast<size_t>(at);
  const int turn = static_cast<int>(
      std::lround(s.mesh_phase[at] - std::floor(s.mesh_phase[at])));  // 1: just before phase 0
  PairLoads out;
  for (Index k = 0; k < s.pair.size() && out.curves < static_cast<int>(kMostCurves); ++k) {
    if (!(s.face.width[i](k, 0) > 0) || !(s.tooth_load(at, k) > 0)) continue;
    FigureBlock curve{text("pair", row, " ", ++out.curves),
                      {"face [mm]", "line load [N/mm]"},
                      {},
                      table,
                      text("pair ", s.pair[k] + turn)};
    out.largest = std::max(out.largest, s.face.line_load[i].row(k).maxCoeff());
    for (Index q = 0; q < s.face.line_load[i].cols(); ++q)
      curve.rows.push_back(
          {s.face.position[i](k, q) * kMilli, s.face.line_load[i](k, q) * kNewtonPerMillimetre});
    figure.blocks.push_back(curve);
    out.labels += text("'tooth pair ", s.pair[k] + turn, "' ");
  }
  return out;
}

// Of each [[mesh]] the one with the largest line load; of those that are alike but for the phases that are computed, the first.
std::vector<size_t> shown_meshes(const SystemStaticResult& all) {
  constexpr double kClearly = 1.01;
  const auto section = [&](size_t m) { return all.of_train() ? all.settings.section[m] : 0; };
  std::vector<size_t> out;
  for (size_t m = 0; m < all.mesh.size(); ++m) {
    const auto same =
        std::find_if(out.begin(), out.end(), [&](size_t own) { return section(own) == section(m); });
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
  double most = 0, line_most = 0;  // N m-1
  std::string ranges, names, labels, curves;
  for (size_t r = 0; r < drawn.size(); ++r) {
    const StaticResult& s = all.mesh[drawn[r]];
    const GearPair pair(s);
    const std::string row = text(" ", r + 1), &name = all.mesh_names[drawn[r]];
    const std::string factor =
        text("K_{Hβ} ", rounded(s.face.load_factor, 3), " ± ", shown(s.face.load_factor_error, 1));
    figure.notes.push_back(train ? name + ": " + pair_words(s) : pair_words(s));
    if (train) names += text("'", name, ", ", rounded(s.torque, 1), " N m: ", factor, "' ");
    if (!train || r + 1 == drawn.size())
      figure.notes.push_back(text(
          train ? "K_{Hβ}" : factor, " of the reference pair at mesh phase 0, ", s.face.line_load[0].cols(),
          " points along each contact line, a quarter of a mesh period between the lines, misalignment ",
          rounded(s.mesh.misalignment * kMicro, 2), " µm"));
    most = std::max(most, add_flank(s, pair, row, figure));
    const PairLoads pairs =
        add_pairs(s, row, train ? "line load of " + name : "line load at mesh phase 0", figure);
    line_most = std::max(line_most, pairs.largest);
    labels += pairs.labels;
    curves += text(pairs.curves, " ");
    ranges += text(0.5 * pair.face_width() * kMilli, " ", pair.path_start() * kMilli, " ",
                   pair.path_end() * kMilli, " ");
  }
  const auto rows = static_cast<int>(drawn.size());
  figure.words = {{"labels", labels}, {"curves", curves}, {"names", names}, {"ranges", ranges}};
  figure.numbers = {{"largest", most * kNewtonPerMillimetre},
                    {"line_largest", line_most * kNewtonPerMillimetre},
                    {"rows", rows},
                    {"feet", static_cast<double>(figure.notes.size())}};
  figure.height = 1000 + kRowHeight * (rows - 1) + (train ? kNameHeight : 0);
  return figure;
}

}  // namespace whine
