#include "report/multiplier_figure.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "report/figure_words.h"
#include "signal/jump_words.h"

namespace whine {

using Eigen::Index;

Figure multiplier_figure(const BranchResult& b) {
  constexpr double kLeast = 0.05;  // modulus that is shown
  const Index n = b.mesh_frequency.size();
  if (n == 0) fail(Failure::input, "a figure of multipliers needs a branch with one orbit at least");
  Figure figure;
  figure.title = "Floquet multipliers along the branch of periodic orbits, " + torque_words(b.torque);
  FigureBlock plane{"multipliers", {"real", "imaginary", "mesh_frequency [Hz]", "stable"}, {}};
  FigureBlock modulus{"modulus", {"mesh_frequency [Hz]", "largest modulus", "stable"}, {}};
  double largest = 1;
  for (Index i = 0; i < n; ++i) {
    const MatrixRM& all = b.floquet_multiplier[static_cast<size_t>(i)];
    for (Index k = 0; k < all.rows(); ++k)
      if (all.row(k).norm() > kLeast)
        plane.rows.push_back({all(k, 0), all(k, 1), b.mesh_frequency[i], static_cast<double>(b.stable[i])});
    modulus.rows.push_back({b.mesh_frequency[i], all.row(0).norm(), static_cast<double>(b.stable[i])});
    largest = std::max(largest, all.row(0).norm());
  }
  figure.blocks = {std::move(plane), std::move(modulus)};
  for (Index i = 0; i < b.fold_frequency.size(); ++i)
    figure.notes.push_back(text("fold at ",
                                jump_words(b.fold_frequency.segment(i, 1), b.fold_width.segment(i, 1)), ", ",
                                b.fold_smooth[i] ? "smooth" : "at a kink",
                                ": real multiplier nearest to 1: ", fixed(b.fold_multiplier(i, 0), 5),
                                " before the fold, ", fixed(b.fold_multiplier(i, 1), 5), " after it"));
  figure.notes.push_back(text(n, " orbits, ", n - b.stable.sum(), " unstable; ", b.flip_frequency.size(),
                              " period doublings, ", b.torus_frequency.size(), " tori"));
  figure.numbers = {{"largest", largest}, {"notes", static_cast<double>(figure.notes.size())}};
  add_lines(figure.notes.size(), figure);
  figure.height = 900 + 24 * static_cast<int>(figure.notes.size());
  return figure;
}

}  // namespace whine
