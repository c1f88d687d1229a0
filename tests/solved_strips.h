// A contact problem solved from a set of strips that touch at first.
#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

#include "contact/complementarity.h"

namespace whine {

struct Solved {
  Eigen::VectorXd p, d;
  Certificate certificate;
  ActiveSet active;
};

inline Solved solved(const Eigen::MatrixXd& a, const Eigen::VectorXd& e, std::vector<int> start = {},
                     Singular singular = Singular::reject) {
  Solved s;
  s.p.resize(e.size());
  s.d.resize(e.size());
  s.active.strips = std::move(start);
  ComplementaritySolver solver(singular);
  s.certificate = solver.solve(a, e, s.active, s.p, s.d);
  return s;
}

}  // namespace whine
