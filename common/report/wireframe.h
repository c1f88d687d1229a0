// The edges of a gear's elements as pen strokes: one sector turned into the whole gear or into the teeth near
// a point.
#pragma once
#include <array>
#include <vector>

#include "gear/pair.h"
#include "results/sector_grid.h"

namespace whine {

// Strokes are rows {x, y} in m times `scale`; an empty row lifts the pen.
using Strokes = std::vector<std::vector<double>>;

// The same lines with fewer points: none that is left out lies farther than `tolerance` from what is drawn (Douglas and
// Peucker).
Strokes simplified(const Strokes& strokes, double tolerance);

class Wireframe {
 public:
  // Throws Error(input) for elements that are not of 4 or 9 nodes, or a sector whose outer edge is not one
  // line from the clockwise to the counter-clockwise side.
  explicit Wireframe(const SectorGrid& mesh);

  Strokes whole(const Placement& at, double scale) const;  // all teeth, straight edges
  // Edges of the elements that reach into the square of half width `half` about `point`, through their mid
  // nodes.
  Strokes window(const Placement& at, double scale, const Vec2& point, double half) const;
  Strokes outline(const Placement& at, double scale) const;  // closed contour of the teeth
  Strokes bore(const Placement& at,
               double scale) const;  // closed circle; of an internal gear the outside of its rim
  // Nodes of the sector's outer edge, from its clockwise side to its counter-clockwise one.
  const std::vector<int>& contour() const { return contour_; }

 private:
  Vec2 position(int node, int tooth, const Placement& at) const;
  Strokes strokes(const std::vector<bool>& used, int tooth, const Placement& at, double scale,
                  bool with_mid) const;
  MatrixRM node_;
  int teeth_;
  double bore_radius_;
  std::vector<std::array<int, 3>> edge_;  // corner, corner, mid node (-1: none); every edge once, the
                                          // clockwise side's left out: the neighbour draws it
  std::vector<int> contour_;              // nodes of the outer edge, clockwise side to counter-clockwise side
};

}  // namespace whine
