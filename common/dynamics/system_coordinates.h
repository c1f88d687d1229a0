// Coordinates of a system of elastic bodies in motion: z" + c z' + w^2 z = force, unit modal mass.
//
// - Rigid rotations: theta_b of every body that no drive holds, of unit modal mass; planets go round with their carrier. Motions in
//   which no mesh approaches (the rolling of the whole train) are the null space of the matrix of approaches; they are projected out,
//   and the force that holds the mean speed against the contact forces is reported.
// - Bodies that turn: modes with zero diameters are diagonalised with theta, M0 = [[I, g^T], [g, 1]], K0 = diag(0, w^2).
// - Bodies on elastic bearings or pins: modes with one diameter are diagonalised with x and y in the frame of the system (of a
//   planetary train: of its carrier at the mean speed), M0 = [[m, G^T], [G, 1]], K0 = diag(k, w^2). Only the diagonal of the bearing
//   damping is kept; modes of one pair have the same one, as bearings are alike in all directions.
// - A carrier that may turn or move, and its planets: one group. With u = r theta and x, y of the carrier, x, y of each planet on an
//   elastic pin and its modes with one diameter, X_b the displacement of hub b and D_b that relative to what carries it,
//     M0 = sum m_b X_b^T X_b + (I / r^2) U^T U + modes + G_b^T X_b,   K0 = sum k_b D_b^T D_b + diag(w^2)
//   is diagonalised at once; without its null vector, the rigid rotation of the carrier.
// - All other modes turn with their gear; doublets turn back by a tooth at the end of a mesh period.
// Coriolis and centrifugal forces of a frame that turns with its carrier couple these coordinates: dynamics/turning_frame.h.
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
  double frame_turns = 0;     // 1: revolutions of the frame in a mesh period, see frame_turns(); 0: at rest
  // With friction, of a train that can roll as a whole: the body whose torque follows from the losses (-1: none), and (mesh) N m by how
  // much it rises, in its own sense, per coefficient of friction of each mesh.
  int output = -1;
  Eigen::VectorXd loss;
};

// rad s-1: the highest natural frequency of the rigid train on its mean stiffnesses (mesh, mesh; N m-1, without bearings), to which
// the dampers of the axes refer: c = 2 bearing_ratio I w. Of one pair w^2 = k (r1^2 / I1 + r2^2 / I2). Throws Error(input) if a
// free body has no inertia.
double axis_frequency(const SystemModel& system, const Eigen::MatrixXd& mean_stiffness);

struct SystemCoordinates {
  struct Share {               // of one body
    int first = 0, count = 0;  // its own elastic coordinates; none of a carrier
    int torsional = 0;         // the first of them, which turn the hub
    int swaying = 0;           // of them, which move the hub; they follow
    std::vector<int> kept;     // columns of ReducedBody::flank_mode
    Eigen::MatrixXd columns;   // (kept, coordinate): share of each mode
    Eigen::VectorXd hub;       // (torsional) rad per unit, in the body's own sense
    Eigen::MatrixXd shift;     // (xy, swaying) m per unit, in the frame of the system
    int group = -1;            // in which its hub moves; -1: none
    int member = 0;            // of the group
    Eigen::MatrixXd carried;   // (xy, rigid) m per unit: its hub with its carrier; empty: nothing
  };
  // A carrier that may move and its planets.
  struct Group {
    struct Member {
      int body = 0;
      Eigen::MatrixXd columns;  // (kept, coordinate): share of each mode
      Eigen::MatrixXd shift;    // (xy, coordinate) m per unit: of its hub
      Eigen::MatrixXd
          stretch;  // (xy, coordinate) m per unit: relative to what carries it, on an elastic bearing
      Eigen::VectorXd of_bearing;  // (coordinate) s-1: share of its bearing's damper
      // Of a planet on a rigid pin: kg, its mass, and kg per unit velocity (xy, coordinate), its momentum m X_b + G_b^T q_b; others 0.
      double mass = 0;
      Eigen::MatrixXd momentum;
    };
    int carrier = 0;             // number of the body
    int first = 0, count = 0;    // its coordinates
    std::vector<Member> member;  // the planets, then the carrier
    Eigen::VectorXd hub;         // (coordinate) rad per unit: rotation of the carrier, in its own sense
  };
  int rigid = 0;             // rotations come first
  Eigen::MatrixXd rotation;  // (body, rigid) rad per unit, in the body's own sense
  Eigen::MatrixXd rolling;   // (body, null vector) m: r theta, 1 at most; what is projected out
  Eigen::VectorXd
      inertia;  // (body) kg m2: of its rigid rotation, of a carrier with the masses of its planets
  Eigen::VectorXd
      mass;  // (body) kg: of hubs that move; of a carrier without planets on rigid pins, which have their own
  std::vector<Share> body;
  std::vector<Group> group;
  bool rigid_pins = false;     // of a carrier that may move
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
    if (own.group < 0) return out;
    const Group& joint = group[static_cast<size_t>(own.group)];
    return joint.carrier == b ? out + joint.hub.dot(z.segment(joint.first, joint.count)) : out;
  }
  // (coordinate) rad per unit, in its own sense.
  Eigen::VectorXd turning(int b) const {
    const Share& own = body[static_cast<size_t>(b)];
    Eigen::VectorXd out = Eigen::VectorXd::Zero(size());
    out.head(rigid) = rotation.row(b).transpose();
    out.segment(own.first, own.torsional) = own.hub;
    if (own.group >= 0)
      if (const Group& joint = group[static_cast<size_t>(own.group)]; joint.carrier == b)
        out.segment(joint.first, joint.count) = joint.hub;
    return out;
  }
  // m, of its hub; velocity likewise.
  Vec2 translation_of(int b, const Eigen::VectorXd& z) const {
    const Share& own = body[static_cast<size_t>(b)];
    Vec2 out = swayed(own, z);
    if (own.carried.size() > 0) out += own.carried * z.head(rigid);
    if (own.group >= 0) out += grouped(own, z, &Group::Member::shift);
    return out;
  }
  // m: by how much its elastic bearing or pin gives way; velocity likewise.
  Vec2 bearing_deflection(int b, const Eigen::VectorXd& z) const {
    const Share& own = body[static_cast<size_t>(b)];
    return own.group < 0 ? swayed(own, z) : grouped(own, z, &Group::Member::stretch);
  }
  bool on_rigid_pin(int b) const {
    const Share& own = body[static_cast<size_t>(b)];
    return own.group >= 0 &&
           group[static_cast<size_t>(own.group)].member[static_cast<size_t>(own.member)].mass > 0;
  }
  // N: rate of the momentum of a planet on a rigid pin for accelerations a of the coordinates, in the frame
  // of the carrier.
  Vec2 momentum_rate(int b, const Eigen::VectorXd& a) const {
    const Share& own = body[static_cast<size_t>(b)];
    const Group& joint = group[static_cast<size_t>(own.group)];
    const Group::Member& in = joint.member[static_cast<size_t>(own.member)];
    Vec2 out = in.momentum * a.segment(joint.first, joint.count);
    if (own.carried.size() > 0) out += in.mass * (own.carried * a.head(rigid));
    return out;
  }
  // By how much a unit of each coordinate moves a point of a flank outwards, the rotation of the hub left out.
  struct Participation {
    Eigen::VectorXd own, group;  // (coordinate) of the body's own and of its group
  };
  // weights: (flank) of the point in the flank table; outward: its normal; phase: mesh periods since tooth numbers were given.
  Participation participation(const SystemModel& system, int b, const ToothFlank& flank, double phase,
                              const Eigen::RowVectorXd& weights, const Vec2& outward) const;

 private:
  static Vec2 swayed(const Share& own, const Eigen::VectorXd& z) {
    Vec2 out(0, 0);
    for (int i = 0; i < own.swaying; ++i) out += own.shift.col(i) * z[own.first + own.torsional + i];
    return out;
  }
  Vec2 grouped(const Share& own, const Eigen::VectorXd& z, Eigen::MatrixXd Group::Member::*part) const {
    const Group& joint = group[static_cast<size_t>(own.group)];
    return joint.member[static_cast<size_t>(own.member)].*part * z.segment(joint.first, joint.count);
  }
};

// Throws Error(input) for body = "full", "rigid", contact other than "line", a gear without a mode that a freedom
// needs, and inertias and masses below those of the body, of a carrier below those of planets on rigid pins; Error(numerical) if modes
// cannot be found.
SystemCoordinates coordinates_of(const SystemModel& system, const SystemMotion& motion);

}  // namespace whine
