#include "report/system_branch_figure.h"

#include <algorithm>

#include "base/error.h"
#include "report/figure_words.h"
#include "report/one_system.h"
#include "signal/jump_words.h"
#include "system/rigid_system.h"

namespace whine {

using Eigen::Index;

namespace {

constexpr size_t kMostMeshes = 8;  // colours and dashes of the template

std::string rms_column(const System& s, size_t mesh) {
  return text("dte_rms ", mesh_name(s, mesh), " [µm]");
}

// Where stability changes the curve of the other kind begins with the last point of this one.
FigureBlock system_branch_block(const SystemBranchResult& b, size_t meshes, bool stable) {
  FigureBlock block{stable ? "stable" : "unstable",
                    {"mesh_frequency [Hz]", "largest multiplier"},
                    {},
                    stable ? "stable" : "unstable"};
  for (size_t m = 0; m < meshes; ++m) block.columns.push_back(rms_column(b.settings.layout, m));
  for (Index i = 0; i < b.mesh_frequency.size(); ++i) {
    const bool own = (b.stable[i] != 0) == stable, before = i > 0 && (b.stable[i - 1] != 0) == stable;
    if (!own && !before) continue;
    std::vector<double> row{b.mesh_frequency[i], b.floquet_multiplier[static_cast<size_t>(i)].row(0).norm()};
    row.reserve(meshes + 2);
    for (size_t m = 0; m < meshes; ++m) row.push_back(b.dte_rms(i, static_cast<Index>(m)) * kMicro);
    block.rows.push_back(row);
    if (!own) block.rows.emplace_back();  // lifts the pen
  }
  return block;
}

FigureBlock sweep_block(const SystemSweepResult& s, size_t meshes) {
  const std::string way = text("sweep ", name_of(s.direction));
  FigureBlock block{way, {"mesh_frequency [Hz]"}, {}, text("sweep_", name_of(s.direction))};
  for (size_t m = 0; m < meshes; ++m) block.columns.push_back(rms_column(s.settings.layout, m));
  for (Index i = 0; i < s.mesh_frequency.size(); ++i) {
    std::vector<double> row{s.mesh_frequency[i]};
    row.reserve(meshes + 1);
    for (size_t m = 0; m < meshes; ++m) row.push_back(s.dte_rms(i, static_cast<Index>(m)) * kMicro);
    block.rows.push_back(row);
  }
  return block;
}

}  // namespace

Figure system_branch_figure(const SystemBranchResult& b, const std::vector<SystemSweepResult>& sweeps) {
  if (b.mesh_frequency.size() == 0) fail(Failure::input, "figure: the branch holds no orbit");
  const System& s = b.settings.layout;
  require_one_system("the branch", b.settings, b.torque, sweeps);
  const size_t meshes = std::min(s.meshes.size(), kMostMeshes);
  Figure figure;
  figure.title = "Branch of periodic motions of a system";
  double most = b.dte_rms.leftCols(static_cast<Index>(meshes)).maxCoeff(), up = 0, down = 0;
  double from = b.mesh_frequency.minCoeff(), to = b.mesh_frequency.maxCoeff();
  const bool unstable = b.stable.minCoeff() == 0, stable = b.stable.maxCoeff() == 1;
  if (stable) figure.blocks.push_back(system_branch_block(b, meshes, true));
  if (unstable) figure.blocks.push_back(system_branch_block(b, meshes, false));
  for (const SystemSweepResult& sweep : sweeps) {
    figure.blocks.push_back(sweep_block(sweep, meshes));
    (sweep.direction == Direction::up ? up : down) = 1;
    most = std::max(most, sweep.dte_rms.leftCols(static_cast<Index>(meshes)).maxCoeff());
    from = std::min(from, sweep.mesh_frequency.minCoeff());
    to = std::max(to, sweep.mesh_frequency.maxCoeff());
  }
  double largest = 1;
  for (const MatrixRM& all : b.floquet_multiplier) largest = std::max(largest, all.row(0).norm());
  std::string labels;
  for (size_t m = 0; m < meshes; ++m) {
    labels += "'" + short_name(mesh_name(s, m)) + "' ";
    figure.levels.push_back({rms_column(s, m), false});
  }
  figure.notes.push_back(text(b.mesh_frequency.size(), " orbits, ", b.mesh_frequency.size() - b.stable.sum(),
                              " unstable, ", b.fold_frequency.size(), " folds, ", b.flip_frequency.size(),
                              " period doublings, ", b.torus_frequency.size(), " tori; body \"",
                              b.settings.fidelity.body, "\", contact \"", b.settings.fidelity.contact, "\""));
  for (Index i = 0; i < std::min<Index>(b.fold_frequency.size(), 6); ++i)
    figure.notes.push_back(text("fold at ",
                                jump_words(b.fold_frequency.segment(i, 1), b.fold_width.segment(i, 1)), ", ",
                                b.fold_smooth[i] ? "smooth" : "at a kink"));
  if (s.meshes.size() > meshes)
    figure.notes.push_back(text("the first ", meshes, " of ", s.meshes.size(), " meshes"));
  figure.numbers = {{"meshes", static_cast<double>(meshes)},
                    {"stable", stable ? 1.0 : 0.0},
                    {"unstable", unstable ? 1.0 : 0.0},
                    {"up", up},
                    {"down", down},
                    {"most", most > 0 ? 1.06 * most * kMicro : 1.0},
                    {"largest", 1.1 * largest},
                    {"frequency_from", from},
                    {"frequency_to", to},
                    {"notes", static_cast<double>(figure.notes.size())}};
  figure.words = {{"labels", labels}};
  add_shafts(s, figure);
  figure.height = 1300;
  return figure;
}

}  // namespace whine
