// From a sector mesh to the body that contact needs: modes with the hub fixed and the flexibility between
// flank points.
//
// Flexibility by singularity subtraction: in the tooth region D the displacement under a unit normal force at
// s_j is u = u_hs + w, u_hs the line-load field of the tangent half-plane at s_j. The unknowns are w inside D
// and on its free sides, u on the cut between D and the rest and beyond it; with t_hs the traction of u_hs on
// the sides of D,
//   K x = -(sum over sides of D of N^T t_hs) + K_D W,   W = u_hs at the nodes of the cut, 0 elsewhere.
// w is smooth, so the elements need not resolve the contact; the logarithm stays analytical. Every harmonic
// of the cyclic gear has the same load; offsets between teeth follow by the inverse discrete Fourier
// transform.
//
// Or by matching at a depth d, as Parker, Vijayakar and Imajo (J. Sound Vib. 237 (2000) 435) do: the finite
// elements carry the force itself, as consistent nodal forces on the flank, and are read at the point d below
// s_i; the half-plane gives what lies between that point and the surface. Load and reading stand at different
// places, so the table is not symmetric, and both the spread of the nodal load, (element / d)^2, and the finite
// body, d / tooth, leave their errors in it.
#pragma once
#include "gear/involute.h"
#include "solid/elements.h"
#include "solid/reduced_body.h"
#include "solid/sector_mesh.h"

namespace whine {

// Number of table points along the flank and depth to which the half-plane in the tables is relative.
constexpr int kFlankPoints = 24;
constexpr double kReferenceDepth = 1e-3;  // m
constexpr int kOffsets = 3;

// modes: elastic modes of the whole gear to keep, 0 or more, or kAllModes; the first torsional zero-diameter mode is always
// among them. The near field is that of mesh.discretisation. Throws Error(input) for a matching depth whose points are
// not all inside the tooth and for kAllModes of a mesh that is too fine for dense algebra, Error(numerical) if a
// factorisation, an eigensolution or a table does not pass its check.
BodyArtifact reduce(const MeshArtifact& mesh, const Material& material, int modes,
                    int flank_points = kFlankPoints);

// Reading of displacements on the driving flank of a sector mesh.
class FlankReader {
 public:
  explicit FlankReader(const MeshArtifact& mesh);
  // (2 points, 2 node) 1: displacement x0, y0, x1, y1 .. at roll angles xi from nodal displacements of the sector.
  SparseReal displacement(const Eigen::VectorXd& xi) const;
  // (points, 2 node) 1: its outward normal component.
  SparseReal outward(const Eigen::VectorXd& xi) const;
  // The same for the points that lie `depth` (m) below the flank along its normals. Throws Error(input) if one of them
  // is not inside the tooth.
  SparseReal outward_below(const Eigen::VectorXd& xi, double depth) const;

 private:
  // Element of the tooth region that holds p, and where; -1 if none does.
  Eigen::Index element_at(const Vec2& p, Vec2& reference) const;
  const MeshArtifact& mesh_;
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
};
FlankLoads make_flank_loads(const MeshArtifact& mesh, const Material& material, const Eigen::VectorXd& xi);
FlankLoads make_matched_loads(const MeshArtifact& mesh, const Material& material, const Eigen::VectorXd& xi,
                              double depth);

}  // namespace whine
