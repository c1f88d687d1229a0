// Coordinates of a system of elastic bodies in motion: z" + c z' + w^2 z = force, unit modal mass.
//
// - Rigid rotations: theta_b of every body that no drive holds, of unit modal mass. Motions in which no mesh approaches (the
//   rolling of the whole train) are the null space of the matrix of approaches; they are projected out, and the force that holds
//   the mean speed against the contact forces is reported.
// - Bodies that turn: modes with zero diameters are diagonalised with theta, M0 = [[I, g^T], [g, 1]], K0 = diag(0, w^2).
// - Bodies on elastic bearings or pins: modes with one diameter are diagonalised with x and y in the frame of the system (of a
//   planetary train: of its carrier, which is held), M0 = [[m, G^T], [G, 1]], K0 = diag(k, w^2). Only the diagonal of the bearing
//   damping is kept; modes of one pair have the same one, as bearings are alike in all directions.
// - All other modes turn with their gear; doublets turn back by a tooth at the end of a mesh period.
// Coriolis and centrifugal terms are left out: nothing where the carrier stands still, see README.md where it turns.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "dynamics/step_kernel.h"
#include "system/system.h"

namespace whine {

struct SystemMotion {
  Damping damping;
  Fidelity fidelity;
  double axis_frequency = 0;  // rad s-1, see axis_frequency()
};

// rad s-1: the highest natural frequency of the rigid train on its mean stiffnesses (mesh, mesh; N m-1, without bearings), to which
// the dampers of the axes refer: c = 2 bearing_ratio I w. Of one pair w^2 = k (r1^2 / I1 + r2^2 / I2). Throws Error(input) if a
// free body has no inertia.
double axis_frequency(const SystemModel& system, const Eigen::MatrixXd& mean_stiffness);

struct SystemCoordinates {
  struct Share {               // of one body
    int first = 0, count = 0;  // its elastic coordinates
    int torsional = 0;         // the first of them, which turn the hub
    int swaying = 0;           // of them, which move the hub; they follow
    std::vector<int> kept;     // columns of BodyArtifact::flank_mode
    Eigen::MatrixXd columns;   // (kept, coordinate): share of each mode
    Eigen::VectorXd hub;       // (torsional) rad per unit, in the body's own sense
    Eigen::MatrixXd shift;     // (xy, swaying) m per unit, in the frame of the system
  };
  int rigid = 0;             // rotations come first
  Eigen::MatrixXd rotation;  // (body, rigid) rad per unit, in the body's own sense
  Eigen::MatrixXd rolling;   // (body, null vector) m: r theta, 1 at most; what is projected out
  std::vector<Share> body;
  Eigen::VectorXd frequency;   // (coordinate) rad s-1
  Eigen::VectorXd damping;     // (coordinate) s-1
  Eigen::VectorXd of_bearing;  // (coordinate) s-1: share of a bearing's damper in it
  Eigen::VectorXd torque;      // (coordinate): constant force of the drives
  std::vector<StepSystem::Turn> turns;

  int size() const { return static_cast<int>(frequency.size()); }
  // rad, in its own sense; velocity likewise.
  double rotation_of(int b, const Eigen::VectorXd& z) const {
    const Share& own = body[static_cast<size_t>(b)];
    double out = 0;
    for (int i = 0; i < rigid; ++i) out += rotation(b, i) * z[i];
    for (int i = 0; i < own.torsional; ++i) out += own.hub[i] * z[own.first + i];
    return out;
  }
  // m, of its hub; velocity likewise.
  Vec2 translation_of(int b, const Eigen::VectorXd& z) const {
    const Share& own = body[static_cast<size_t>(b)];
    Vec2 out(0, 0);
    for (int i = 0; i < own.swaying; ++i) out += own.shift.col(i) * z[own.first + own.torsional + i];
    return out;
  }
  // (coordinate of body b) by how much a unit of each moves flank `flank` of tooth `tooth` outwards, the rotation of the hub left
  // out. weights: (flank) of the point in the flank table; outward: its normal; phase: mesh periods since tooth numbers were given.
  Eigen::VectorXd participation(const SystemModel& system, int b, const ToothFlank& flank, double phase,
                                const Eigen::RowVectorXd& weights, const Vec2& outward) const;
};

// Throws Error(input) for body = "full", "rigid", contact other than "line", Newmark's method, a gear without a mode that a freedom
// needs, and inertias and masses below those of the body; Error(numerical) if modes cannot be found.
SystemCoordinates coordinates_of(const SystemModel& system, const SystemMotion& motion);

}  // namespace whine
