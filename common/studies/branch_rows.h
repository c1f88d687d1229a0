// What artifacts of branches have in common: their points in the order of the arc, multipliers, folds and other special orbits.
#pragma once
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/matrix.h"
#include "orbits/branch.h"
#include "studies/branch_follower.h"

namespace whine {

// A row between two points of a branch: the first, the next, and the share of the way.
struct BranchPlace {
  Eigen::Index row = 0, next = 0;
  double share = 0;
  template <class Rows>
  auto of(const Rows& rows) const {
    return ((1 - share) * rows.row(row) + share * rows.row(next)).eval();
  }
};

template <class State>
Eigen::Index points_of(const std::vector<BranchSegment<State>>& segments) {
  Eigen::Index points = 0;
  for (const auto& s : segments) points += static_cast<Eigen::Index>(s.branch.points.size());
  return points;
}

// Fills the rows of `a` that every branch has. point(i, position, multiple): the others of point i, all points being filled in this
// order before folds; fold(i, place): of fold i; grazing(mesh, pair): of the next one, of the contact that comes or goes
// there.
template <class State, class Branch, class Point, class Fold, class Grazing>
void fill_branch(const std::vector<BranchSegment<State>>& segments, const std::vector<double>& mismatch,
                 const Point& point, const Fold& fold, const Grazing& grazing, Branch& a) {
  using Eigen::Index;
  const Index points = points_of(segments);
  for (Eigen::VectorXd* x : {&a.mesh_frequency, &a.residual}) x->resize(points);
  for (Eigen::VectorXi* x : {&a.stable, &a.steps, &a.period_multiple, &a.part}) x->resize(points);
  std::vector<SpecialPoint> special;
  std::vector<std::pair<int, int>> contacts;  // (special) mesh and pair
  std::vector<BranchPlace> folds;
  Index i = 0;
  for (const auto& s : segments) {
    const auto& own = s.branch.points;
    const Index first = i;
    for (const BranchPosition& p : own) {
      point(i, p, s.multiple);
      a.mesh_frequency[i] = p.parameter;
      a.residual[i] = p.residual;
      a.stable[i] = p.stable();
      a.steps[i] = s.steps;
      a.period_multiple[i] = s.multiple;
      a.part[i] = s.part;
      MatrixRM rows = MatrixRM::Zero(kKeptMultipliers, 2);
      for (Index k = 0; k < std::min<Index>(kKeptMultipliers, p.multipliers.size()); ++k)
        rows.row(k) << p.multipliers[k].real(), p.multipliers[k].imag();
      a.floquet_multiplier.push_back(rows);
      ++i;
    }
    contacts.insert(contacts.end(), s.special_place.begin(), s.special_place.end());
    for (const SpecialPoint& p : s.branch.special) {
      special.push_back(p);
      if (p.kind != Special::fold) continue;
      // Between two points a quantity goes with the arc.
      const BranchPosition& before = own[p.after_point];
      BranchPlace place{first + static_cast<Index>(p.after_point)};
      place.next = std::min(place.row + 1, points - 1);
      if (p.after_point + 1 < own.size() && own[p.after_point + 1].arc > before.arc)
        place.share = (p.arc - before.arc) / (own[p.after_point + 1].arc - before.arc);
      folds.push_back(place);
    }
  }
  a.end = ends_of(segments);
  a.segment_mismatch =
      Eigen::Map<const Eigen::VectorXd>(mismatch.data(), static_cast<Index>(mismatch.size()));
  a.fold_frequency = parameters_of(special, Special::fold);
  a.fold_width = widths_of(special, Special::fold, kStepError);
  a.flip_frequency = parameters_of(special, Special::flip);
  a.flip_width = widths_of(special, Special::flip, kStepError);
  a.torus_frequency = parameters_of(special, Special::torus);
  a.torus_width = widths_of(special, Special::torus, kStepError);
  a.grazing_frequency = parameters_of(special, Special::grazing);
  a.fold_smooth.resize(a.fold_frequency.size());
  a.fold_multiplier.resize(a.fold_frequency.size(), 2);
  a.grazing_phase.resize(a.grazing_frequency.size());
  a.grazing_closes.resize(a.grazing_frequency.size());
  Index turn = 0, graze = 0;
  for (size_t k = 0; k < special.size(); ++k)
    if (const SpecialPoint& p = special[k]; p.kind == Special::fold) {
      fold(turn, folds[static_cast<size_t>(turn)]);
      a.fold_smooth[turn] = p.smooth;
      a.fold_multiplier.row(turn++) << p.before.real(), p.after.real();
    } else if (p.kind == Special::grazing) {
      a.grazing_phase[graze] = p.event.phase - std::floor(p.event.phase);  // of the mesh period
      a.grazing_closes[graze++] = p.event.closes;
      grazing(contacts[k].first, contacts[k].second);
    }
}

}  // namespace whine
