#include "report/fold_curve_figure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace whine {
namespace {

using Eigen::Index;

bool over_damping(const FoldCurvesArtifact& a) {
  return a.quantity == name(FoldQuantity::damping);
}

double shown_value(const FoldCurvesArtifact& a, Index i) {
  if (over_damping(a)) return a.damping_ratio[i] * kPercent;
  return a.quantity == name(FoldQuantity::torque) ? a.value[i] : a.value[i] * kMicro;
}
double shown_cusp(const FoldCurvesArtifact& a, Index i) {
  if (over_damping(a)) return a.cusp_damping_ratio[i] * kPercent;
  return a.quantity == name(FoldQuantity::torque) ? a.cusp_value[i] : a.cusp_value[i] * kMicro;
}

std::string unit(const FoldCurvesArtifact& a) {
  if (over_damping(a)) return " %";
  return a.quantity == name(FoldQuantity::torque) ? " N m" : " µm";
}

bool same_pair(const FoldCurvesArtifact& a, const JumpMapArtifact& m) {
  return m.model == "finite elements" && m.torque == a.torque &&
         m.mesh.corner.enabled == a.mesh.corner.enabled &&
         m.mesh.corner.largest_angle == a.mesh.corner.largest_angle &&
         m.mesh.modification == a.mesh.modification && m.fidelity.body == a.fidelity.body &&
         m.fidelity.contact == a.fidelity.contact;
}

// Hz from a jump at a damping ratio to the nearest fold curve there, which goes straight from point to point.
double distance_to_folds(const FoldCurvesArtifact& a, double ratio, double frequency) {
  double nearest = std::numeric_limits<double>::infinity();
  for (Index i = 0; i + 1 < a.value.size(); ++i) {
    if (a.curve[i] != a.curve[i + 1]) continue;
    const double r0 = a.damping_ratio[i], r1 = a.damping_ratio[i + 1];
    constexpr double kRound = 1e-6;
    const double share = (ratio - r0) / (r1 - r0);
    if (!(share > -kRound && share < 1 + kRound)) continue;
    const double there = a.fold_frequency[i] + share * (a.fold_frequency[i + 1] - a.fold_frequency[i]);
    nearest = std::min(nearest, std::abs(there - frequency));
  }
  return nearest;
}

// Damping ratio of the highest cusp, to which there are two branches.
double last_cusp(const FoldCurvesArtifact& a) {
  return a.cusp_damping_ratio.size() > 0 ? a.cusp_damping_ratio.maxCoeff() : 0;
}

}  // namespace

Figure fold_curve_figure(const std::vector<FoldCurvesArtifact>& curves,
                         const std::vector<JumpMapArtifact>& maps) {
  if (curves.empty()) fail(Failure::input, "a figure of folds needs one fold_curves.h5 at least");
  if (curves.size() > kMostCurves)
    fail(Failure::input, curves.size(), " artifacts; ", kMostCurves, " can be told apart");
  for (const FoldCurvesArtifact& a : curves)
    if (a.quantity != curves[0].quantity)
      fail(Failure::input, "folds over ", curves[0].quantity, " and over ", a.quantity,
           "; draw one figure of each");
  Figure figure;
  const std::string axis = over_damping(curves[0]) ? "Damping ratio, two pairs in contact (%)"
                           : curves[0].quantity == name(FoldQuantity::torque)
                               ? "Torque (N m)"
                               : "Linear tip relief, both gears (µm)";
  const std::string column = over_damping(curves[0])                            ? "damping_ratio [%]"
                             : curves[0].quantity == name(FoldQuantity::torque) ? "torque [N m]"
                                                                                : "tip_relief [um]";
  figure.title = "Folds of the branches: between a pair of curves there are two stable motions";
  int compared = 0, near = 0, cells = 0, right = 0;
  double farthest = 0;
  std::string wrong;
  for (size_t k = 0; k < curves.size(); ++k) {
    const FoldCurvesArtifact& a = curves[k];
    const std::string number = text(k + 1),
                      label = a.quantity == name(FoldQuantity::torque) ? "folds" : torque_words(a.torque);
    FigureBlock folds{
        "folds" + number, {"mesh_frequency [Hz]", column, "multiplier_before", "multiplier_after"}, {}};
    folds.table = "folds";
    folds.curve = label;
    for (Index i = 0; i < a.value.size(); ++i) {
      if (i > 0 && a.curve[i] != a.curve[i - 1]) folds.rows.emplace_back();
      folds.rows.push_back(
          {a.fold_frequency[i], shown_value(a, i), a.fold_multiplier(i, 0), a.fold_multiplier(i, 1)});
    }
    FigureBlock cusps{"cusps" + number, {"mesh_frequency [Hz]", column}, {}};
    cusps.table = "cusps";
    cusps.curve = label;
    for (Index i = 0; i < a.cusp_value.size(); ++i)
      cusps.rows.push_back({a.cusp_frequency[i], shown_cusp(a, i)});
    FigureBlock jumps{"jumps" + number, {"mesh_frequency [Hz]", column}, {}};
    jumps.table = "jumps";
    jumps.curve = label;
    for (const JumpMapArtifact& m : maps) {
      if (!over_damping(a) || !same_pair(a, m)) continue;
      for (Index i = 0; i < m.jump_frequency.size(); ++i) {
        const double ratio = m.damping_ratio[m.jump_case[i]],
                     distance = distance_to_folds(a, ratio, m.jump_frequency[i]);
        jumps.rows.push_back({m.jump_frequency[i], ratio * kPercent});
        if (std::isinf(distance)) continue;
        ++compared;
        near += distance < 1 + m.jump_width[i];
        farthest = std::max(farthest, distance);
      }
      for (Index c = 0; c < m.damping_ratio.size(); ++c) {
        ++cells;
        const bool two = m.damping_ratio[c] < last_cusp(a);
        right += (m.two_branches[c] != 0) == two;
        if ((m.two_branches[c] != 0) != two)
          wrong += text(wrong.empty() ? "" : "; ", a.torque, " N m at ",
                        fixed(m.damping_ratio[c] * kPercent, 2), " %");
      }
    }
    figure.numbers.emplace_back("cusps_" + number, static_cast<double>(cusps.rows.size()));
    figure.numbers.emplace_back("jumps_" + number, static_cast<double>(jumps.rows.size()));
    figure.numbers.emplace_back("folds_" + number, static_cast<double>(folds.rows.size()));
    figure.words.emplace_back("label" + number, label);
    for (FigureBlock* block : {&folds, &cusps, &jumps}) figure.blocks.push_back(std::move(*block));
    std::string words;
    for (Index i = 0; i < a.cusp_value.size(); ++i)
      words += text(words.empty() ? "" : ", ", fixed(shown_cusp(a, i), 2), unit(a), " and ",
                    fixed(a.cusp_frequency[i], 1), " Hz");
    figure.notes.push_back((label == "folds" ? "" : label + ": ") +
                           (words.empty() ? "no cusp, " + a.end : "cusp at " + words));
  }
  if (cells > 0)
    figure.notes.push_back(text("cells of the jump maps: ", right, " of ", cells,
                                " on the right side of the cusps", wrong.empty() ? "" : "; not: ", wrong));
  if (compared > 0)
    figure.notes.push_back(text("jumps of the sweeps: ", near, " of ", compared,
                                " within 1 Hz and their width of a curve, the farthest ", fixed(farthest, 1),
                                " Hz"));
  figure.words.emplace_back("axis", axis);
  figure.numbers.emplace_back("curves", static_cast<double>(curves.size()));
  figure.numbers.emplace_back("notes", static_cast<double>(figure.notes.size()));
  figure.height = 1000 + 30 * static_cast<int>(figure.notes.size());
  return figure;
}

}  // namespace whine
