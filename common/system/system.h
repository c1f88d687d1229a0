// Any number of elastic bodies and meshes at one phase: contact segments, maps, compliance, equilibrium.
//
// Contact forces p (N) and gaps d (m) of all meshes form one row of strips, mesh after mesh. With x_b = r_b theta_b (m),
// the rotation of body b in its own sense times its base radius,
//   d = e + A p - D x,   d >= 0, p >= 0, d . p = 0 (Eq. 18),   L^T p = f (Eq. 20),
// e the gaps of the unloaded flanks, D the displacement map (by how much a motion closes them), L the load map (what forces do
// to a motion), f_b = T_b / r_b. A holds the half-planes, the bodies (between all strips that touch one body, of whatever mesh
// and flank) and the bearings. Without friction L = D; with it L = D + mu s T (gear/friction.h), of which A takes what the
// bearings give way. What tangential forces do to the elastic bodies is left out.
#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "system/load_balance.h"
#include "system/rolling_mesh.h"

namespace whine {

class FaceContact;

struct SystemModel {
  System layout;                        // gears before carriers
  std::vector<double> friction;         // [mesh] 1: coefficients of friction; empty: none acts
  std::vector<SideGears::Shared> body;  // the gears in their whole width
  std::vector<GearMeshModel> mesh;
  // [mesh] Contact in slices over the face, of which `mesh` and `body` are the transverse sections; empty: in one slice.
  std::vector<std::shared_ptr<const FaceContact>> face;

  // The one pair of a scene.
  SystemModel(const ReducedBody& driver, const ReducedBody& driven, const GearMeshSpec& mesh);
  // bodies: of the gears of the layout; specs: of each mesh of it; of its bearings those of the layout count. Throws Error(input) for a
  // number of gears or meshes that is not the layout's, and for a carrier before a gear or on a carrier. The crack of a gear is beside the
  // flank that works in the first of its meshes; forces on the other one close it.
  SystemModel(const System& layout, const std::vector<ReducedBody>& bodies,
              const std::vector<GearMeshSpec>& specs);

  bool slides() const { return !friction.empty(); }
  bool cracked() const;             // a crack that a mesh opens
  double base_radius(int b) const;  // m; of a carrier the radius of its pins
  // Whether body b of several meshes is on a bearing so soft that the compliance of its teeth would be lost to round-off beside it: the
  // translations of its hub are then freedoms of the equilibrium, and no part of A.
  bool floats(int b) const;
  // The side of mesh m that body b is; -1: none.
  int side_of(int b, int m) const;

 private:
  bool opens_crack(const System::Mesh& mesh, int side) const;
};

// The unit of contact: one slice of one pair of teeth on one side of their flanks.
struct ContactSegment {
  int mesh = 0;
  int pair = 0;                     // -1 following, 0 reference, 1 preceding
  int slice = 0;                    // along the face width; spur gears have one
  std::array<int, 2> tooth{};       // [side] number, counter-clockwise
  double phase = 0;                 // mesh periods from the pitch point
  double gap = 0;                   // m, at the nominal point
  Vec2 normal = Vec2::Zero();       // from the first side's flank to the second's, in the frame of the system
  std::array<double, 2> lever{};    // [side] m
  double width = 0;                 // m along the face
  PairSliding sliding;              // of meshes with [friction], else 0
  int first_strip = 0, strips = 0;  // in the row of all strips
};

// Between the strips and the motions of the bodies.
struct ContactMap {
  Eigen::MatrixXd
      rotation;  // (strip, body) 1: of x; of a carrier by what its planets' axes move along the normals
  std::vector<Eigen::MatrixXd>
      translation;  // [body] (strip, xy) 1: outward normal of its flank, of a carrier those of its planets; no rows for a rigid bearing
  std::vector<std::array<Eigen::MatrixXd, 2>>
      flank;  // [mesh][side] (node of the mesh, flank) 1: in the flank table
};

struct SystemPosition {
  double phase = 0;  // mesh periods since the first mesh's reference pair met at the pitch point
  std::vector<MeshPosition> mesh;  // each at its own phase
  std::vector<ContactSegment> segment;
  std::vector<int> first_strip;   // (mesh + 1)
  Eigen::VectorXd gap;            // (strip) m
  ContactMap displacement, load;  // of motions on gaps; of forces on motions

  int strips() const { return static_cast<int>(gap.size()); }
  auto strips_of(size_t m) const { return Eigen::seqN(first_strip[m], first_strip[m + 1] - first_strip[m]); }
};

// Phase, 0 to 1, and number of the mesh period of mesh m, when the system is at `phase`, 0 to 1, of its own mesh period.
struct MeshInstant {
  double phase;
  int period;
};
MeshInstant mesh_instant(const SystemModel& system, int m, double phase, int period);

// Mesh periods after which the same teeth of all meshes meet, as far as teeth differ: the least common multiple of the numbers of teeth
// of the gears that have errors or cracks; 1 if teeth are all alike. In each mesh period every gear turns by one tooth, those on
// a carrier relative to it. Throws Error(input) above kMostHuntingPeriods.
int hunting_periods(const SystemModel& system);

// a: (strip, strip) m N-1, to which is added what cracks add in a mesh period. False if no tooth near a cracked one is in reach.
bool add_cracks(const SystemModel& system, const SystemPosition& position, int period, Eigen::MatrixXd& a);

// tau of gear/friction.h of a contact per unit of mu s, in the frame of the system: friction pushes the first side's body along -tau.
Vec2 across(const SystemModel& system, const ContactSegment& segment);

// positions: of each mesh, at its mesh_instant.
SystemPosition join(const SystemModel& system, double phase, int period, std::vector<MeshPosition> positions);

// [mesh][side], as compliance_tables, each relative to the depth (m) of its mesh.
using SystemTables = std::vector<std::array<std::vector<Eigen::MatrixXd>, 2>>;
SystemTables compliance_tables(const SystemModel& system, std::span<const double> depth);

// a: (strip, strip) m N-1, to which is added what bodies of several meshes in slices give way unevenly between these.
void add_uneven_between(const SystemModel& system, const SystemPosition& position, Eigen::MatrixXd& a);

// (strip, strip) m N-1: A above, its symmetric part without friction; without cracks and bearings of bodies that float. Of lines their
// laws are not in it.
Eigen::MatrixXd contact_compliance(const SystemModel& system, const SystemPosition& position,
                                   const SystemTables& tables, std::span<const double> depth);

// (strip, strip) m N-1: what friction adds to A by way of elastic bearings, not symmetric; empty where it adds nothing.
Eigen::MatrixXd friction_compliance(const SystemModel& system, const SystemPosition& position);

// (mesh) N: the loads of load_balance(). Throws Error(input) if a mesh would be pulled apart, if torques are not balanced, and if no
// mesh carries load.
Eigen::VectorXd mesh_loads(const SystemModel& system);

struct SystemEquilibrium {
  Eigen::VectorXd x;          // (body) m; 0 of held ones
  Eigen::VectorXd p;          // (strip) N
  Eigen::MatrixXd stiffness;  // (free body, free body) N m-1: d (L^T p) / d x, contact changes included
  Certificate certificate;
  double residual =
      0;  // largest |L^T p - f| of free bodies over the largest mesh load; rotation of a train that can roll left out

  // m: sum of the sides' rotations along the line of action, positive where the first side is ahead; of a mesh on a carrier
  // relative to the carrier.
  double transmission_error(const SystemModel& system, int m) const;
};

// If the train can roll freely, its rigid-body rotation is projected out (orthogonal to the closing of all meshes): tip-edge contacts, whose
// lever arms are not the base radii, would otherwise turn it. In motion the force that holds the mean speed does the same.
// Free bodies: those that no drive holds, one at least; start: (body) m, a solution nearby; 0: not known. With one free body it is
// the monotone search of equilibrium(); with more Newton's method with a line search on the convex energy whose gradient L^T p - f is,
// to 1e-12, or to 1e-10 where round-off allows no more. laws: of lines, else empty. Throws Error(numerical) with the residual if that
// is not reached. further: (body) N on x beside those of the drives; empty: none.
SystemEquilibrium equilibrium(const SystemModel& system, const SystemPosition& position,
                              const Eigen::MatrixXd& compliance, const Eigen::VectorXd& start,
                              ComplementaritySolver& solver, const Eigen::VectorXd& further = {});

// N, in the frame of the system: what body b presses its bearing with, elastic or rigid; the sum of its contact forces, of a carrier
// that of its planets.
Vec2 bearing_force(const SystemModel& system, const SystemPosition& position, int b,
                   const Eigen::Ref<const Eigen::VectorXd>& p);

// m: what mesh m alone gives way, the transmission error less what its bearings, and that of its carrier, give way along the line of
// action.
double mesh_deflection(const SystemModel& system, const SystemPosition& position, const SystemEquilibrium& at,
                       int m);

}  // namespace whine
