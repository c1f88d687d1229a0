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
// the compliance that cyclic symmetry gives. The stress along the roots is treated alike: beside the mouth of the slit the crack
// takes away what the intact tooth has there, for the surface ends. At the tip of the slit stress is singular and not looked at.
#pragma once
#include <vector>

#include "gear/involute.h"
#include "results/sector_grid.h"

namespace whine {

// Triangles around a slit, as elements of 4 or 9 nodes whose fourth corner is the first.
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
SectorGrid make_cracked_sector(const SectorGrid& sector);

// The same mesh without a crack: the nodes of `slit_node` are one again.
SectorGrid close_slit(const SectorGrid& cracked);

// Between the teeth -reach .. reach (counter-clockwise) of a gear, tooth by tooth; under unit normal forces at roll angles xi.
struct TeethTables {
  MatrixRM
      compliance;  // (tooth flank, tooth flank) m N-1: less the half-plane as in ReducedBody::compliance, symmetrised
  MatrixRM
      root_stress;  // (tooth root, tooth flank) Pa N-1: along the driving flank's root, as in ReducedBody::root_stress
};

// Of a gear made of `sector` alone but for tooth 0, which is `special`; xi in rad. 2 reach + 1 teeth at most. The near field is by
// subtraction.
TeethTables teeth_tables(const SectorGrid& sector, const SectorGrid& special, const Material& material,
                         const Eigen::VectorXd& xi, int reach);

// ReducedBody::crack_compliance and crack_root_stress of a mesh whose `cracked_tooth` is there. Throws Error(numerical) if the
// compliance is not positive semidefinite to 1e-3 of its largest entry.
TeethTables crack_tables(const SectorGrid& sector, const Material& material, const Eigen::VectorXd& xi,
                         int reach);

}  // namespace whine
