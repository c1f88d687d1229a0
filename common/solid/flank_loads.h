// Unit forces on the flank of a sector mesh as right-hand sides (solid/reduce.h says how), and reading of displacements there.
#pragma once
#include <vector>

#include "gear/involute.h"
#include "results/sector_grid.h"
#include "solid/elements.h"

namespace whine {

// Depth to which the half-plane in the tables is relative.
constexpr double kReferenceDepth = 1e-3;  // m

// Reading of displacements on the driving flank of a sector mesh.
class FlankReader {
 public:
  explicit FlankReader(const SectorGrid& mesh);
  // (2 points, 2 node) 1: displacement x0, y0, x1, y1 .. at roll angles xi from nodal displacements of the sector.
  SparseReal displacement(const Eigen::VectorXd& xi) const;
  // (points, 2 node) 1: its outward normal component.
  SparseReal outward(const Eigen::VectorXd& xi) const;
  // The same for the points that lie `depth` (m) below the flank along its normals. Throws Error(input) if one of them
  // is not inside the tooth.
  SparseReal outward_below(const Eigen::VectorXd& xi, double depth) const;
  // The same as outward() of the other flank of the tooth, which is the mirror image of the driving flank: a displacement read
  // there is that of the mirrored field read on the driving flank. Throws Error(input) for a mesh that is not its own mirror
  // image.
  SparseReal back_outward(const Eigen::VectorXd& xi) const;

 private:
  // Element of the tooth region that holds p, and where; -1 if none does.
  Eigen::Index element_at(const Vec2& p, Vec2& reference) const;
  const SectorGrid& mesh_;
  ToothGeometry tooth_;
};

// Right-hand sides for unit normal forces at roll angles xi of tooth 0, and what they are made of.
struct FlankLoads {
  Eigen::MatrixXd force;       // (2 node, load) 1: the right-hand side K x = force
  Eigen::MatrixXd half_plane;  // (2 node, load) m N-1: u_hs at the nodes where x holds w, 0 where it holds u
  std::vector<char> holds_rest;  // (node) whether x holds w there; of matched loads nowhere
  // (point, load) m N-1: inward u_hs at the points xi, less the flat surface displacement; of matched loads also less
  // u_hs at the depth
  MatrixRM subtracted;
  // (point, load) m N-1: inward u_hs at the points xi of the other flank of the loaded tooth; of matched loads 0
  MatrixRM across;
};
FlankLoads make_flank_loads(const SectorGrid& mesh, const Material& material, const Eigen::VectorXd& xi);
FlankLoads make_matched_loads(const SectorGrid& mesh, const Material& material, const Eigen::VectorXd& xi,
                              double depth);

}  // namespace whine
