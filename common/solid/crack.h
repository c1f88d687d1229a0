// A tooth with a crack, the only one that leaves cyclic symmetry: its mesh, and what the crack adds to the flexibility of
// the teeth.
//
// The slit is cut into the sector mesh: elements near it give way to triangles that have nodes on it, those nodes are
// doubled, and the triangles around the tip have their mid-side nodes at a quarter of the side, so that strains may grow
// as the inverse square root of the distance (Barsoum, Int. J. Num. Meth. Eng. 10 (1976) 25). The faces are free and do
// not touch.
//
// The whole gear is solved with all teeth, each condensed to its two sector edges, which is exact: the intact ones are
// equal, so that three sectors (intact, open, closed) and two block-cyclic matrices of the edges are factorised whatever the
// number of teeth. The crack's share is the difference between the mesh with the slit open and the same mesh with the slit
// closed. So it is free of what the meshes themselves differ by, zero without a crack and never negative; it is added to
// the compliance that cyclic symmetry gives.
#pragma once
#include <vector>

#include "gear/involute.h"
#include "solid/sector_mesh.h"

namespace whine {

// Triangles around a slit, as elements of 4 or 9 nodes whose first corner stands also as fourth.
struct SlitPatch {
  // (node, 2) m: the polygon's corners in their order, the middles of its sides if there are any, new ones
  MatrixRM node_position;
  MatrixRMi element_node;  // (element, 4 or 9)
  MatrixRMi
      slit_node;  // (pair, 2): the same point on the slit's two faces, from the mouth; the tip is one node
};

// corner: m, of the polygon to fill, counter-clockwise; middle: m, of the side after each corner, or empty for elements of
// first order; the slit goes from the corner number `mouth`, where the polygon's side is free, to `tip` inside. at_mouth,
// finest, largest: m, sizes at the mouth, at the tip and elsewhere. Throws Error(numerical) if gmsh cannot.
SlitPatch slit_patch(const std::vector<Vec2>& corner, const std::vector<Vec2>& middle, std::size_t mouth,
                     const Vec2& tip, double at_mouth, double finest, double largest);

// The sector of the cracked tooth of sector.design, depth above 0. Throws Error(input) for a crack that does not fit the
// tooth (gear/crack.h), Error(numerical) if the tooth cannot be meshed around it.
MeshArtifact make_cracked_sector(const MeshArtifact& sector);

// The same mesh without a crack: the nodes of `slit_node` are one again.
MeshArtifact close_slit(const MeshArtifact& cracked);

// (tooth flank, tooth flank) m N-1: compliance between the teeth -reach .. reach (counter-clockwise) of a gear made of
// `sector` alone but for tooth 0, which is `special`; at roll angles xi (rad), less the half-plane as in
// BodyArtifact::compliance. Symmetrised. 2 reach + 1 teeth at most. The near field is by subtraction.
MatrixRM teeth_compliance(const MeshArtifact& sector, const MeshArtifact& special, const Material& material,
                          const Eigen::VectorXd& xi, int reach);

// BodyArtifact::crack_compliance of a mesh whose `cracked_tooth` is there. Throws Error(numerical) if it is not positive
// semidefinite to 1e-6 of its largest entry.
MatrixRM crack_compliance(const MeshArtifact& sector, const Material& material, const Eigen::VectorXd& xi,
                          int reach);

}  // namespace whine
