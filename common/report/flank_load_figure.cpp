#include "report/figure_list.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
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

}  // namespace

Figure flank_load_figure(const SystemStaticResult& all) {
  if (all.mesh[0].face.none())
    fail(
        Failure::input,
        "flank-load: this static.h5 is of one slice over the face, whose load is the same all over it; write width = \"slices\" in [fidelity] of the scene");
  // Of a train the mesh with the largest line load; of those of one [[mesh]], which are alike but for the phases that are computed, the first.
  constexpr double kClearly = 1.01;
  size_t most_loaded = 0;
  for (size_t m = 1; m < all.mesh.size(); ++m)
    if (all.mesh[m].face.line_load_max > kClearly * all.mesh[most_loaded].face.line_load_max) most_loaded = m;
  const StaticResult& s = all.mesh[most_loaded];
  const GearPair pair(s);
  Figure figure;
  figure.title = text("Load over the flank", all.of_train() ? " of " + all.mesh_names[most_loaded] : "", ", ",
                      torque_words(s.torque));
  figure.notes.push_back(pair_words(s));
  figure.notes.push_back(
      text("K_{Hβ} ", rounded(s.face.load_factor, 3), " ± ", shown(s.face.load_factor_error, 1),
           " of the reference pair at mesh phase 0, ", s.face.line_load[0].cols(),
           " points along each contact line, a quarter of a mesh period between the lines, misalignment ",
           rounded(s.mesh.misalignment * kMicro, 2), " µm"));
  constexpr int kAcross = 61, kAlong = 81;
  FigureBlock flank{"flank", {"face [mm]", "path of contact [mm]", "line load [N/mm]"}, {}};
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
  // Lines of contact a quarter of a mesh period apart.
  FigureBlock lines{"lines", {"face [mm]", "path of contact [mm]"}, {}, "", "", true};
  for (int quarter = 0; quarter < 4; ++quarter)
    for (const ContactLine& line : contact_lines(pair, 0.25 * quarter)) {
      for (const double z : {line.from, line.to})
        lines.rows.push_back({z * kMilli, path_at(pair, 0.25 * quarter + line.pair, z) * kMilli});
      lines.rows.push_back({});
    }
  figure.blocks.push_back(lines);
  const auto positions = static_cast<double>(s.mesh_phase.size());
  std::string labels;
  double line_most = 0;  // N m-1
  int curves = 0;
  // Of a train: the position nearest to phase 0 of the mesh, whose pairs may be numbered one on.
  const double ahead = s.mesh_phase[0] - std::floor(s.mesh_phase[0]);
  const auto row = static_cast<Index>(std::lround((1 - ahead) * positions)) % static_cast<Index>(positions);
  const auto at = static_cast<size_t>(row);
  const double phase = s.mesh_phase[row] - std::floor(s.mesh_phase[row]);
  const int turn = static_cast<int>(std::lround(phase));  // 1: just before phase 0
  for (Index k = 0; k < s.pair.size() && curves < static_cast<int>(kMostCurves); ++k) {
    if (!(s.face.width[at](k, 0) > 0) || !(s.tooth_load(row, k) > 0)) continue;
    FigureBlock curve{text("pair ", ++curves),
                      {"face [mm]", "line load [N/mm]"},
                      {},
                      "line load at mesh phase 0",
                      text("pair ", s.pair[k] + turn)};
    line_most = std::max(line_most, s.face.line_load[at].row(k).maxCoeff());
    for (Index q = 0; q < s.face.line_load[at].cols(); ++q)
      curve.rows.push_back(
          {s.face.position[at](k, q) * kMilli, s.face.line_load[at](k, q) * kNewtonPerMillimetre});
    figure.blocks.push_back(curve);
    labels += text("'tooth pair ", s.pair[k] + turn, "' ");
  }
  figure.words.emplace_back("labels", labels);
  figure.numbers.emplace_back("curves", curves);
  figure.numbers.emplace_back("half_face", half * kMilli);
  figure.numbers.emplace_back("path_start", pair.path_start() * kMilli);
  figure.numbers.emplace_back("path_end", pair.path_end() * kMilli);
  figure.numbers.emplace_back("largest", most * kNewtonPerMillimetre);
  figure.numbers.emplace_back("line_largest", line_most * kNewtonPerMillimetre);
  return figure;
}

}  // namespace whine
