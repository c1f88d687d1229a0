// A mesh in slices as a system takes it: each point of a contact line is a contact (mesh, tooth pair, slice) of its own.
//
// Plane modes and plane tables move all sections of a body alike. What sections give way each by itself is the rest of the compliance C of
// system/face_contact.h between the points q and r:
//   C_qr = sum over gears cos^2 beta_b S_q T S_r^T + E_qr,   T the plane table of both teeth on the whole face b, S its weights at the roll of a point.
// E is 0 for a load that is even over the face and at one roll, as one slice has it, and of slices positive semidefinite: the work of a load
// that is spread over the sections is at least that of its mean (Jensen's inequality over z).
#pragma once
#include <Eigen/Core>

#include "system/face_contact.h"
#include "system/system.h"

namespace whine {

struct FaceMesh {
  FacePoints points;
  Eigen::MatrixXd uneven;  // (point, point) m N-1: E
};

// phase: of the mesh, 0 to 1; corner_gap (m), load (N, transverse) as FaceContact::at().
MeshPosition face_mesh_position(const FaceContact& contact, double phase, double corner_gap, double load);

// The transverse sections of a pair as a system with its contact in slices. layout: of two gears in one mesh, its bodies those of the
// transverse sections. points, depth: as FaceContact, which says
// what it throws.
SystemModel sliced_system(const System& layout, const ReducedBody& driver, const ReducedBody& driven,
                          const GearMeshSpec& mesh, WidthModel width, int points, double depth);

}  // namespace whine
