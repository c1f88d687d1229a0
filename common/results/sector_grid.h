// A finite element mesh of one tooth sector.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "base/matrix.h"
#include "model/scene.h"

namespace whine {

// mesh.h5: one tooth sector; the tooth points along +y, sector edges at angle 90 deg -/+ 180 deg/teeth.
// The driving flank is the one that leads when the gear turns counter-clockwise (x < 0 side of the tooth).
struct SectorGrid {
  GearDesign design;
  BodyDiscretisation discretisation;  // the file does not hold its near field: no mesh depends on it
  MatrixRM node_position;             // (node, 2) m
  MatrixRMi element_node;             // (element, 4 or 9): corners counter-clockwise, mid-sides, centre
  Eigen::VectorXi element_region;     // (element): 0 rim, 1 tooth (where the half-plane field is subtracted)
  Eigen::VectorXi bore_node;          // nodes on the rigid hub; of an internal gear on the outside of its rim
  MatrixRMi side_node;  // (pair, 2): node on the clockwise edge (angle 90 deg - 180/teeth), its image on the
                        // counter-clockwise edge
  Eigen::VectorXi flank_node;  // nodes of the driving flank, root to tip, of an internal gear tip to root
  Eigen::VectorXd flank_roll_angle;  // rad, of flank_node
  // None, or the sector of the cracked tooth, with the same node sets and sector edges. Nodes on the slit occur twice in
  // it, but for the tip; triangles are elements whose fourth corner is the first.
  std::vector<SectorGrid> cracked_tooth;
  MatrixRMi slit_node;  // (pair, 2) in the cracked tooth's sector: the same point on the slit's two faces
};

}  // namespace whine
