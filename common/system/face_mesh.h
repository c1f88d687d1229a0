// A mesh in slices as a system takes it: each point of a contact line is a contact (mesh, tooth pair, slice) of its own.
//
// Plane modes and plane tables move all sections of a body alike. What sections give way each by itself is the rest of the compliance C of
// system/face_contact.h between the points q and r:
//   C_qr = sum over gears cos^2 beta_b S_q T S_r^T + E_qr,   T the plane table of both teeth on the whole face b, S its weights at the roll of a point.
// E is 0 for a load that is even over the face and at one roll, as one slice has it, and of slices positive semidefinite: the work of a load
// that is spread over the sections is at least that of its mean (Jensen's inequality over z). A body of several meshes has E between the
// points of all of them: its sections turn and bend under what each of them carries.
#pragma once
#include <Eigen/Core>

#include "system/face_contact.h"
#include "system/system.h"

namespace whine {

struct FaceMesh {
  FacePoints points;
  std::array<Eigen::VectorXd, 2> roll;  // [side] (point) rad: where the tables are read
  Eigen::MatrixXd uneven;               // (point, point) m N-1: E
};

// phase: of the mesh, 0 to 1; corner_gap (m), load (N, transverse) as FaceContact::at().
MeshPosition face_mesh_position(const FaceContact& contact, double phase, double corner_gap, double load);

// (point, point) m N-1: E between the points of two meshes, by way of the body that both share and from the plane table between its
// flanks; b the larger of the common faces. A body in the middle plane of whose face all others have theirs.
Eigen::MatrixXd uneven_between(const SystemModel& system, const SystemPosition& position, size_t read,
                               int read_side, size_t loaded, int loaded_side);

// The transverse sections of a train with its contact in slices. bodies: of the gears of the layout, specs, section: of each mesh of it,
// section its number in the scene; meshes of one section share their contact. points: of each contact line of all meshes; depth: as
// FaceContact, which says what it throws. Throws Error(input) for width = body of more than one mesh.
SystemModel sliced_system(const System& layout, const std::vector<ReducedBody>& bodies,
                          const std::vector<GearMeshSpec>& specs, const std::vector<int>& section,
                          WidthModel width, int points, double depth = 0);
// The same with this number of points, and with polynomials to `degree` at most.
SystemModel with_points(const SystemModel& system, int points, int degree);

}  // namespace whine
