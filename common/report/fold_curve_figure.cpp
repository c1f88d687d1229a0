#include "report/figure_list.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "report/figure_words.h"

namespace whine {
namespace {

using Eigen::Index;

bool over_damping(const FoldCurvesResult& a) {
  return a.quantity == FoldQuantity::damping;
}

// How the figure shows a quantity.
struct Shown {
  const char *axis, *column, *unit;
  double factor;  // of the value; of damping of its ratio
};
Shown shown_as(FoldQuantity quantity) {
  switch (quantity) {
    case FoldQuantity::damping:
      return {"Damping ratio (%)", "damping_ratio [%]", " %", kPercent};
    case FoldQuantity::torque:
      return {"Torque (N m)", "torque [N m]", " N m", 1};
    case FoldQuantity::tip_relief:
      return {"Linear tip relief, both gears (µm)", "tip_relief [um]", " µm", kMicro};
    case FoldQuantity::bearing_stiffness:
      return {"Stiffness of the bearings over that of the scene (1)", "bearing_stiffness [1]", "", 1};
  }
  return {};
}
double shown_value(const FoldCurvesResult& a, Index i) {
  return shown_as(a.quantity).factor * (over_damping(a) ? a.damping_ratio : a.value)[i];
}
double shown_cusp(const FoldCurvesResult& a, Index i) {
  return shown_as(a.quantity).factor * (over_damping(a) ? a.cusp_damping_ratio : a.cusp_value)[i];
}

bool same_pair(const FoldCurvesResult& a, const JumpMapResult& m) {
  return elastic(m) && m.torque == a.torque && m.mesh.corner.enabled == a.mesh.corner.enabled &&
         m.mesh.corner.largest_angle == a.mesh.corner.largest_angle &&
         m.mesh.modification == a.mesh.modification && m.fidelity.body == a.fidelity.body &&
         m.fidelity.contact == a.fidelity.contact;
}

// Hz from a jump at a damping ratio to the nearest fold curve there, which goes straight from point to point.
double distance_to_folds(const FoldCurvesResult& a, double ratio, double frequency) {
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
double last_cusp(const FoldCurvesResult& a) {
  return a.cusp_damping_ratio.size() > 0 ? a.cusp_damping_ratio.maxCoeff() : 0;
}

// Jumps and cells of the sweeps' maps beside the curves.
class Comparison {
 public:
  // A jump at a damping ratio. One beyond all curves is near none.
  void jump(const FoldCurvesResult& a, double ratio, double frequency, double width) {
    const double distance = distance_to_folds(a, ratio, frequency);
    ++jumps_;
    near_ += distance < 1 + width;
    if (std::isinf(distance))
      ++beyond_;
    else
      farthest_ = std::max(farthest_, distance);
  }
  // Below the highest cusp there are two motions. Curves that end without a cusp say nothing of a cell.
  void cell(const FoldCurvesResult& a, double ratio, bool two_branches) {
    if (a.cusp_damping_ratio.size() == 0) {
      ++without_cusp_;
      return;
    }
    ++cells_;
    if (two_branches == (ratio < last_cusp(a)))
      ++right_;
    else
      wrong_ += text(wrong_.empty() ? "" : "; ", a.torque, " N m at ", fixed(ratio * kPercent, 2), " %");
  }
  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    if (cells_ > 0)
      notes.push_back(text("cells of the jump maps: ", right_, " of ", cells_,
                           " on the right side of the cusps", wrong_.empty() ? "" : "; not: ", wrong_));
    if (without_cusp_ > 0) notes.push_back(text(without_cusp_, " cells stand beside curves without a cusp"));
    if (jumps_ > 0)
      notes.push_back(text("jumps of the sweeps: ", near_, " of ", jumps_,
                           " within 1 Hz and their width of a curve, the farthest ", fixed(farthest_, 1),
                           " Hz",
                           beyond_ > 0 ? text("; ", beyond_, " at a damping ratio without a curve") : ""));
    return notes;
  }

 private:
  int jumps_ = 0, near_ = 0, beyond_ = 0, cells_ = 0, right_ = 0, without_cusp_ = 0;
  double farthest_ = 0;  // Hz
  std::string wrong_;
};

FigureBlock folds_block(const FoldCurvesResult& a, const std::string& number, const std::string& column) {
  FigureBlock folds{
      "folds" + number, {"mesh_frequency [Hz]", column, "multiplier_before", "multiplier_after"}, {}};
  folds.table = "folds";
  for (Index i = 0; i < a.value.size(); ++i) {
    if (i > 0 && a.curve[i] != a.curve[i - 1]) folds.rows.emplace_back();
    folds.rows.push_back(
        {a.fold_frequency[i], shown_value(a, i), a.fold_multiplier(i, 0), a.fold_multiplier(i, 1)});
  }
  return folds;
}

void require_one_quantity(const std::vector<FoldCurvesResult>& curves) {
  if (curves.empty()) fail(Failure::input, "a figure of folds needs one fold_curves.h5 at least");
  if (curves.size() > kMostCurves)
    fail(Failure::input, curves.size(), " artifacts; ", kMostCurves, " can be told apart");
  for (const FoldCurvesResult& a : curves)
    if (a.quantity != curves[0].quantity)
      fail(Failure::input, "folds over ", curves[0].quantity, " and over ", a.quantity,
           "; draw one figure of each");
}

}  // namespace

Figure fold_curve_figure(const std::vector<FoldCurvesResult>& curves,
                         const std::vector<JumpMapResult>& maps) {
  require_one_quantity(curves);
  Figure figure;
  const Shown what = shown_as(curves[0].quantity);
  const std::string column = what.column;
  const bool two_pairs =
      over_damping(curves[0]) && !curves[0].of_train() && curves[0].fidelity.width == WidthModel::one;
  const std::string axis = two_pairs ? "Damping ratio, two pairs in contact (%)" : what.axis;
  figure.title = "Folds of the branches: between a pair of curves there are two stable motions";
  Panel panel{.x = {.label = "Mesh frequency (Hz)"}, .y = {.label = axis}, .height = 760};
  PanelCurve cusp_marks{.style = PanelStyle::points, .width = 2.4, .mark = 6, .size = 2.2},
      jump_marks{.style = PanelStyle::points, .width = 2, .mark = 2, .size = 1.6};
  Comparison comparison;
  for (size_t k = 0; k < curves.size(); ++k) {
    const FoldCurvesResult& a = curves[k];
    const std::string number = text(k + 1), label = a.quantity == FoldQuantity::torque || a.of_train()
                                                        ? "folds"
                                                        : torque_words(a.torque);
    FigureBlock folds = folds_block(a, number, column);
    folds.curve = label;
    FigureBlock cusps{"cusps" + number, {"mesh_frequency [Hz]", column}, {}};
    cusps.table = "cusps";
    cusps.curve = label;
    for (Index i = 0; i < a.cusp_value.size(); ++i)
      cusps.rows.push_back({a.cusp_frequency[i], shown_cusp(a, i)});
    FigureBlock jumps{"jumps" + number, {"mesh_frequency [Hz]", column}, {}};
    jumps.table = "jumps";
    jumps.curve = label;
    for (const JumpMapResult& m : maps) {
      if (!over_damping(a) || !same_pair(a, m)) continue;
      for (Index i = 0; i < m.jump_frequency.size(); ++i) {
        const double ratio = m.damping_ratio[m.jump_case[i]];
        jumps.rows.push_back({m.jump_frequency[i], ratio * kPercent});
        comparison.jump(a, ratio, m.jump_frequency[i], m.jump_width[i]);
      }
      for (Index c = 0; c < m.damping_ratio.size(); ++c)
        comparison.cell(a, m.damping_ratio[c], m.two_branches[c] != 0);
    }
    const int colour = static_cast<int>(k) + 1;
    if (!folds.rows.empty())
      panel.curves.push_back({.block = folds.name,
                              .style = PanelStyle::line_points,
                              .colour = colour,
                              .label = label,
                              .size = 0.6});
    for (const auto& [block, marks] : {std::pair{&jumps, &jump_marks}, {&cusps, &cusp_marks}}) {
      if (block->rows.empty()) continue;
      marks->colour = colour;
      marks->block = block->name;
      panel.curves.push_back(*marks);
    }
    for (FigureBlock* block : {&folds, &cusps, &jumps}) figure.blocks.push_back(std::move(*block));
    std::string words;
    for (Index i = 0; i < a.cusp_value.size(); ++i)
      words += text(words.empty() ? "" : ", ", fixed(shown_cusp(a, i), 2), what.unit, " and ",
                    fixed(a.cusp_frequency[i], 1), " Hz");
    figure.notes.push_back((label == "folds" ? "" : label + ": ") +
                           (words.empty() ? "no cusp, " + a.end : "cusp at " + words));
  }
  for (const std::string& note : comparison.notes()) figure.notes.push_back(note);
  // What the marks are, once for all curves.
  for (auto& [marks, name] : {std::pair{cusp_marks, "cusp"}, {jump_marks, "jump of a sweep"}})
    if (!marks.block.empty()) {
      PanelCurve& key = panel.curves.emplace_back(marks);
      key.block.clear();
      key.colour = kBlack;
      key.label = name;
    }
  if (panel.curves.empty()) {
    panel.heading = "no folds in the range";
    panel.curves.push_back({.block = figure.blocks[0].name});
  }
  figure.panels = {panel};
  plain_captions(figure.notes.size(), figure);
  return figure;
}

}  // namespace whine
