// What gmsh does: the half sector of a tooth from its blocks, and triangles around a crack. Nothing else sees gmsh.
#pragma once
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "gear/involute.h"

namespace whine {

// Which exact curve a boundary edge lies on.
enum class Curve { none, top_land, flank, root, sector_edge, bore, centre_line };

// The mesh of the half sector as gmsh leaves it; boundary nodes lie on splines.
struct HalfGrid {
  std::vector<Vec2> node;
  std::vector<std::array<int, 4>> element;    // counter-clockwise
  std::vector<int> region;                    // per element
  std::map<std::pair<int, int>, Curve> edge;  // boundary edges, lower node number first
};

// Of elements of the size h (m), on the root of the size `root` (m). Throws Error(numerical) if gmsh cannot.
HalfGrid half_sector_mesh(const ToothGeometry& tooth, double h, double root);

// Triangles that fill a polygon and keep its edges and those of a slit in it.
struct Triangulation {
  std::vector<Vec2>
      node;  // m: the polygon's corners in their order, the slit's without its first, then new ones
  std::vector<std::array<int, 3>> triangle;  // counter-clockwise
};

// polygon: corners, counter-clockwise; slit: from a corner of the polygon to its tip inside. Edges are at most `largest` long
// and near the tip at most `finest` plus a third of the distance to it (m). Throws Error(numerical) if gmsh cannot.
Triangulation triangulate(const std::vector<Vec2>& polygon, const std::vector<Vec2>& slit, double finest,
                          double largest);

}  // namespace whine
