// A system of elastic bodies and meshes in motion at constant mean speed: one force per pair of teeth and slice of the face, Hertz's law.
//
// With z of system_coordinates.h, h_k what z moves at contact k, p_k its force, F_b the relaxed loads of body b in kFields fields
// of each flank that may touch, W_k what a contact reads of them,
//   z" + c z' + w^2 z = torque - sum_k h_k p_k
//   eta F' + F = sum_k V S_k p_k
//   d_k = e_k - h_k z + W_k F + sum_l A_kl p_l + law_k(p_k) >= 0, p >= 0, p . d = 0 at the end of each step (Eq. 18)
// W_k = S_k V C_b, C_b = V^T R V between all flanks of a body that may touch, of whatever mesh; R is the flexibility of the body less
// that of its kept modes. A is what V leaves out of R (1e-4 of it), instantaneous as Hertz's law relative to the undamped depth is.
// Steps are exact for a mean force and for relaxed loads that are linear in the step; with Newmark's method (Eq. 8) the mean force is that
// of both ends as well. With friction forces act along L_k = h_k + mu s T_k (gear/friction.h) on the rotations and translations of hubs
// in place of h_k; mu of each mesh is that of the speed, s and T those of the nominal kinematics. The matrix of a step's contact,
// A + h (bq / 2) L^T, is then not symmetric; Newton's method takes it as it is. rest() is without friction. Where the frame turns, the forces of
// turning_frame.h come in addition, at rest too.
//
// In slices (system/face_mesh.h) the points of a contact line are contacts of their own, and sections give way each by itself in addition:
//   d_k += sum_l E_kl w_l g_l,   eta g' + g = p / w
// over the points of its mesh, g the relaxed line loads (N m-1) and w the lengths of face that the points stand for. Points move with the
// ends of their line; g moves with them, and begins at 0 where a line comes in. A slot is then (mesh, pair, point).
//
// Pairs of a mesh are numbered by the mesh period of the system: a pair that is number i in one is i + 1 in the next. At the end
// of a mesh period relaxed loads move on by one tooth, and doublets that turn with their gear turn back by one. A slot is
// (mesh, pair). Where teeth differ, gaps are those of the mesh period of the hunting period in which a state is, and so is what a crack
// adds to A, at once as Hertz's law; all else is the same in each. All that depends on the position is computed once for the steps of a
// period. Modes that no hub feels are taken from the end of a step without its new forces to that of the next in one pass, which reads the
// gaps there; with an energy balance, at the end of a period and at a fixed phase each step ends with all of them. A step takes no memory
// where at most 64 pairs are in reach, no energy balance is kept and the frame stands still.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory_resource>
#include <utility>
#include <vector>

#include "base/huge_pages.h"
#include "base/matrix.h"
#include "contact/lanes.h"
#include "dynamics/energy_balance.h"
#include "dynamics/fixed_phase_motion.h"
#include "dynamics/motion_period.h"
#include "dynamics/newmark.h"
#include "dynamics/system_contact.h"
#include "dynamics/system_coordinates.h"
#include "dynamics/turning_frame.h"
#include "gear/layout.h"
#include "system/face_mesh.h"
#include "system/system_statics.h"

namespace whine {

class SystemDynamics {
 public:
  static constexpr int kFields = 12;  // of a flank, as of pairs

  // Throws as coordinates_of() and hunting_periods(), and Error(input) without a positive axis_frequency. What `system` says of friction at
  // rest has to be cleared: coefficients are those of the speed, of [friction] of the meshes.
  SystemDynamics(const SystemModel& system, const SystemMotion& motion);

  struct State {
    Eigen::VectorXd z, v;       // (coordinate)
    Eigen::VectorXd relaxed;    // (body, slot, field): relaxed loads
    Eigen::VectorXd p;          // (slot) N
    Eigen::VectorXd line_load;  // (slot) N m-1: relaxed, in slices; else empty
    int period = 0;             // mesh periods since the start of a hunting period
  };
  using Period = MotionPeriod;

  // corner_gap: [mesh] m, tip edges that are farther off are left out; steps: positions of a mesh period. Throws Error(input)
  // if the positions take more than 12 GB or the gaps of teeth that differ more than 2 GB, Error(numerical) if the fields leave more than 1e-3 of a residual flexibility.
  void set_positions(const std::vector<double>& corner_gap, int steps);
  // mesh frequency: Hz; steps per period must divide those of the positions.
  void set_speed(double mesh_frequency, int steps);
  // Static equilibrium at phase i / positions of the first mesh period: in the frame as it turns at the speed that is set, at rest before
  // one is. There the same forces as those of SystemStatics. Throws Error(input) if bearings do not hold their bodies in the frame.
  State rest(int i = 0);
  // Forces (slot) of equilibrium at phase i / positions; statics of this model.
  Eigen::VectorXd rest_forces(int i);
  // Integrates one mesh period and renames the teeth, so that the state can be compared with the one before. False if a mesh
  // deflects so far that a tip edge which was left out would touch; the state is then undefined. Throws Error(numerical), with the mesh
  // phase, if the contact of a step has no certified solution or is beyond Hertz's law.
  bool integrate(State& state, Period& period, EnergyBalance* balance = nullptr);
  // Free motion at phase i / positions, at which the gears stay: `steps` steps of `seconds` with contact solved at each, as in
  // integrate(). watch(z, p): coordinates, and forces (slot) N, after each. Returns and throws as integrate(); needs no speed, and
  // afterwards none is set.
  bool integrate_fixed(int i, State& state, double seconds, int steps,
                       const std::function<void(const Eigen::VectorXd& z, const Eigen::VectorXd& p)>& watch);
  // A state of other positions, whose slots may be others.
  State fitted(const State& state, const SystemDynamics& of) const;

  const SystemModel& system() const { return system_; }
  const SystemCoordinates& coordinates() const { return coordinates_; }
  int meshes() const { return static_cast<int>(system_.mesh.size()); }
  int slots() const { return meshes() * tooth_pairs() * points_; }
  int points() const { return points_; }                  // of a contact line; 1: one slice
  int tooth_pairs() const { return last_ - first_ + 1; }  // of a mesh
  int first_pair() const { return first_; }
  int relaxed_size() const { return relaxed_first_.back(); }
  int steps() const { return steps_; }
  int hunting_periods() const { return hunting_; }  // see hunting_periods() of the system
  double mesh_frequency() const { return mesh_frequency_; }
  const TurningFrame& frame() const { return frame_; }  // at the speed that is set
  const Eigen::VectorXd& friction() const {
    return friction_;
  }                             // (mesh) 1: coefficients at the speed that is set
  double torque(int b) const {  // N m, in its own sense: with friction the output's follows from the losses
    return system_.layout.torque(b) + (b == motion_.output ? motion_.loss.dot(friction_) : 0.0);
  }
  int most_contacts() const { return most_contacts_; }
  // (step + 1, slot) N: forces at the ends of the steps of the period integrated last, in its names; row 0: at its start.
  const MatrixRM& forces() const { return forces_; }
  // (step + 1, mesh and within it pair) N: the same of pairs of teeth, summed over their slices.
  const MatrixRM& tooth_forces() const { return points_ > 1 ? tooth_forces_ : forces_; }
  // Those forces as tooth_load of that period.
  void take_tooth_loads(Period& period) const;
  // J: what the coordinates of a state store, kinetic energy included, rigid rotations as at the axis frequency; of a difference
  // of states a squared distance. Relaxed loads are not in it.
  double energy(const State& difference) const;
  // Contact frozen as it is at rest at phase i / positions: the pairs that carry force, Hertz's laws by their slopes. The
  // coordinates, damping and relaxation are those of the motion; no gaps and no torques.
  FixedPhaseMesh frozen(int i);
  // Undamped natural modes of frozen(i), residual flexibility instantaneous: frequencies (coordinate, Hz, ascending).
  struct FrozenModes {
    Eigen::VectorXd frequency;
    Eigen::MatrixXd shape;  // (coordinate, mode), unit modal mass
  };
  FrozenModes frozen_modes(int i);
  Eigen::VectorXd frozen_frequencies(int i) { return frozen_modes(i).frequency; }

 private:
  friend class SystemPeriodMap;
  friend class SystemEnergyRecord;
  // Coordinates side by side of which a contact moves all or none: the rotations, a body's own, a group's.
  struct Part {
    int first = 0, count = 0;
    int hub = 0;  // whole lanes of the first ones, which hubs feel; the others only the contacts of the body
    size_t run = 0;                               // place of the coefficients of the others
    int length() const { return padded(count); }  // of a row
  };
  struct Contact {
    int mesh = 0, slot = 0;         // slot of all
    int tooth = 0;                  // (mesh, pair) of all
    std::array<int, 2> body{};      // [side]
    std::array<int, 2> load_at{};   // [side] place of its fields among all relaxed loads
    std::array<double, 2> lever{};  // [side] closing per r theta of its body
    Vec2 normal = Vec2::Zero();     // from the first side's flank to the second's
    double carrier_lever = 0;       // closing per r theta of the carrier that carries one of the bodies
    // Of friction, per mu: what it adds to these levers, s tau, and the work per angle of the first side (m rad-1)
    std::array<double, 2> slide{};
    double carrier_slide = 0;
    Vec2 across = Vec2::Zero();
    double loss = 0;
    std::array<int, 4> part{};     // rotations, those of both sides' bodies, a group or -1
    std::array<int, 4> in_part{};  // number among the contacts of the part
  };
  // Pairs of a mesh outside which neither side has a relaxed load: first to last - 1, in slots of the mesh.
  struct Live {
    int first = 0, last = 0;
    Live hull(const Live& other) const {
      if (last <= first) return other;
      if (other.last <= other.first) return *this;
      return {std::min(first, other.first), std::max(last, other.last)};
    }
  };
  // What a step reads of a part, one after the other in stream_: places, and the contacts from `begin` to `end` in Position::order.
  struct Rows {
    int begin = 0, end = 0;
    size_t row = 0;      // (contact, coordinate in whole lanes): h
    size_t push = 0;     // as row: L, with friction
    size_t slide = 0;    // as row: s T, with friction
    size_t field = 0;    // of a body: (contact, field): V^T S^T
    size_t reading = 0;  // of a body: (slot of the body, contact, field) m N-1: W^T
    int contacts() const { return end - begin; }
  };
  struct Position {
    std::vector<Contact> contact;
    std::vector<HertzLine> law;  // (contact)
    std::vector<double> facing;  // (contact) m: width over which its flanks face each other
    std::vector<double> most;    // (contact) N: neither Hertz's law nor the flanks hold beyond it
    Eigen::VectorXd gap;         // (contact) m
    std::vector<Rows> rows;      // [part]
    std::vector<int> order;      // contacts of all parts, one part after the other
    Eigen::MatrixXd instantaneous_compliance, relaxed;  // (contact, contact) m N-1: A, and W V S
    Eigen::MatrixXd compliance;  // (contact in whole lanes, contact) m N-1: of a step at the speed
    // (contact, contact) m N-1: what cracks add in the mesh period that is put, empty: nothing; `compliance` without it
    Eigen::MatrixXd crack, intact;
    Eigen::MatrixXd
        friction;  // (contact, contact) m N-1: what friction adds to it, not symmetric; empty without
    Eigen::MatrixXd drift, drift_slide;      // (null vector, contact): of normal forces; of friction per mu
    std::vector<double> next_gap, lost_gap;  // (mesh) m, see PairsInReach
    // In slices: (contact) m, w; [mesh] points; (contact, contact) m N-1, E, and (contact in whole lanes, contact) m2 N-1, E w.
    Eigen::VectorXd width;
    std::vector<std::shared_ptr<const FaceMesh>> face;
    Eigen::MatrixXd uneven, uneven_reading;
    FollowedContact followed;
    int size() const { return static_cast<int>(contact.size()); }
  };
  SystemPosition positioned(int i) const;
  void require_range(const Position& position, const Eigen::Ref<const Eigen::VectorXd>& force) const;
  void set_hunting_gaps(const std::vector<SystemPosition>& placed);
  void put_gap(int position, int period);  // of its mesh period
  void set_cracks(const std::vector<SystemPosition>& placed);
  void put_crack(Position& position, int place, int period);
  // (contact, contact) at rest at phase i / positions, of the first mesh period; of teeth without cracks zeros.
  Eigen::MatrixXd crack_at_rest(int i) const;
  void find_slots(const std::vector<SystemPosition>& placed);
  void list_parts();
  double numbers(const std::vector<SystemPosition>& placed) const;
  void couple();
  Position filled(const SystemPosition& at, int shift);
  void put_contacts(const SystemPosition& at, int shift, Position& position) const;
  void put_rows(Position& position);
  size_t place(int numbers);
  void relate(Position& position, const SystemPosition& at) const;
  void put_uneven(const SystemPosition& at, Position& position) const;
  Eigen::MatrixXd residual(int b, const ElasticGear& gear, const ToothFlank& read,
                           const ToothFlank& loaded) const;
  void put_slide(const ContactSegment& segment, const Contact& contact, Position& position);
  // Rows that forces act through, for coefficients of friction (mesh).
  void set_friction(const Eigen::VectorXd& coefficient);
  Eigen::VectorXd friction_at(double mesh_frequency) const;
  bool slides() const { return friction_.size() > 0 && friction_.maxCoeff() > 0; }
  double friction_of(const Contact& contact) const { return friction_[contact.mesh]; }
  double lever(const Contact& contact, size_t side) const {  // of forces
    return contact.lever[side] + friction_of(contact) * contact.slide[side];
  }
  using Place = size_t Rows::*;
  Place pushing() const { return slides() ? &Rows::push : &Rows::row; }
  Eigen::MatrixXd modal_compliance(const Position& position, const Eigen::VectorXd& weight,
                                   Place pushed = &Rows::row) const;
  // (coordinate) h of contact k, in full, or another row of it
  Eigen::VectorXd participation(const Position& position, int k, Place of = &Rows::row) const;
  using Row = Eigen::Map<const Eigen::VectorXd>;
  using FieldRow = Eigen::Map<const Eigen::Matrix<double, kFields, 1>>;
  size_t row_place(const Position& position, const Contact& contact, size_t which,
                   Place of = &Rows::row) const {
    const auto p = static_cast<size_t>(contact.part[which]);
    return position.rows[p].*of + static_cast<size_t>(contact.in_part[which] * part_[p].length());
  }
  // visit(first, h): h of contact k, or another row of it, by what coordinates it moves, from number `first` on.
  template <class Visit>
  void each_part(const Position& position, int k, const Visit& visit, Place of = &Rows::row) const {
    const Contact& contact = position.contact[static_cast<size_t>(k)];
    for (size_t which = 0; which < 4; ++which) {
      if (contact.part[which] < 0) continue;
      const Part& part = part_[static_cast<size_t>(contact.part[which])];
      visit(static_cast<Eigen::Index>(part.first),
            Row(&stream_[row_place(position, contact, which, of)], part.count));
    }
  }
  const Rows& rows_of(const Position& position, const Contact& contact, size_t side) const {
    return position.rows[static_cast<size_t>(contact.part[1 + side])];
  }
  // V^T S^T of a side.
  FieldRow field(const Position& position, const Contact& contact, size_t side) const {
    return FieldRow(&stream_[rows_of(position, contact, side).field +
                             static_cast<size_t>(contact.in_part[1 + side] * kFields)]);
  }
  // W^T of a side, of the relaxed loads of slot `slot` of its body.
  FieldRow reading(const Position& position, const Contact& contact, size_t side, int slot) const {
    const Rows& rows = rows_of(position, contact, side);
    return FieldRow(
        &stream_[rows.reading +
                 static_cast<size_t>((slot * rows.contacts() + contact.in_part[1 + side]) * kFields)]);
  }
  double moved(const Position& position, int k, const Eigen::VectorXd& z, Place of = &Rows::row) const;
  void push(const Position& position, int k, double force, Eigen::VectorXd& y, Place of = &Rows::row) const;
  void load(const Position& position, const Eigen::VectorXd& p, Eigen::VectorXd& fields) const;
  void propagate_by(double seconds);
  void set_run();
  void close(Position& position) const;
  void resize(Period& period, int steps) const;
  void take(const State& state, const Position& position);
  void step(Position& position, const Position* next);
  void propagate();
  void relax();
  void start_gaps(const Position& position);
  void read_gaps(const Position& position);
  void subtract(const Position& position, size_t p, int first, int from, int end);
  void solve(Position& position);
  void push_all(const Position& position, const Position* next);
  void run_ahead(size_t p, int carrying, const Position& next);
  Eigen::VectorXd close_frame(const Eigen::VectorXd& without);
  void note_loads(const Position& position);
  void add_loads(double share);
  void find_live();
  void keep_live();
  void drop(int m, const Live& before, const Live& now);
  bool record(const Position& position, int sample, Period& period);
  void record_face(const Position& position, int sample, Period& period) const;
  void read_uneven(const Position& position);
  void load_uneven(const Position& position);
  void sum_teeth();
  void record_bearings(int sample, Period& period) const;
  void rename();
  const Position& at(int step) const {  // of the speed's steps
    return positions_[static_cast<size_t>(step) * static_cast<size_t>(stride_)];
  }
  Position& at(int step) { return positions_[static_cast<size_t>(step) * static_cast<size_t>(stride_)]; }
  SystemEquilibrium equilibrium_at(int i, Eigen::VectorXd* z);
  SystemEquilibrium equilibrium_under(const Eigen::VectorXd& frame, int i, Eigen::VectorXd* z);

  const SystemModel& system_;
  SystemMotion motion_;
  SystemCoordinates coordinates_;
  double depth_, relaxation_;
  Eigen::VectorXd load_of_mesh_;
  std::vector<double> radius_;                // [body] m; of a carrier that of its pins
  std::vector<CarriedMesh> carried_;          // [mesh]
  std::vector<std::array<Vec2, 2>> outward_;  // [mesh][side]
  std::vector<Position>
      positions_;  // (step + 1): the last one is the first one in the names of the period before
  std::vector<double> corner_gap_;  // [mesh] m
  int hunting_ = 1;
  bool sliding_;                     // [friction] of a mesh acts
  Eigen::VectorXd friction_;         // (mesh) 1, at the speed that is set
  std::vector<int> hunting_place_;   // (position + 1) of its gaps in each mesh period's part of hunting_gap_
  std::vector<double> hunting_gap_;  // m: (mesh period, contact of all positions), of teeth that differ
  // (contact, contact) m N-1 of a mesh period and position at which a tooth near a cracked one is in reach
  std::map<std::pair<int, int>, Eigen::MatrixXd> crack_;
  int first_ = 0, last_ = 0;                 // pairs that may touch
  int points_ = 1;                           // of a contact line
  std::vector<std::vector<int>> meshes_of_;  // [body]
  std::vector<int> relaxed_first_;           // (body + 1)
  std::vector<Eigen::MatrixXd> fields_;      // [body] (flank, field) V
  std::vector<std::vector<Eigen::MatrixXd>>
      tables_;  // [body][slot of it times their number + slot] (flank, flank) m N-1: R
  std::vector<Eigen::MatrixXd> coupling_;  // [body] (relaxed load, relaxed load) m N-1: C
  int most_contacts_ = 0;

  std::vector<Part> part_;  // rotations, of each body, of each group
  std::pmr::vector<double> stream_{&huge_pages()};

  double mesh_frequency_ = 0, step_ = 0;
  TurningFrame frame_;
  int steps_ = 0, stride_ = 1;
  // (coordinate, then zeros for whole lanes of the last part), see Propagator; bv is a12.
  Eigen::VectorXd a11_, a12_, a21_, a22_, bq_, torque_;
  std::vector<double> run_;     // (part, four coordinates, coefficient, lane) of those that no hub feels
  bool ahead_ = false;          // these, and what they move of the gaps, are those of the next step's end
  std::vector<double> summed_;  // (coordinate of a part)
  Relaxation relaxed_step_{};

  // The state of a step; coordinates as those of the propagators.
  Eigen::VectorXd z_, v_, force_, relaxed_;
  Eigen::VectorXd load_;  // as relaxed_: the present ones, where an energy balance is kept
  // Present loads, of a contact and a side: place among all relaxed loads, V^T S^T, N.
  struct Loaded {
    int at;
    const double* field;
    double force;
  };
  std::vector<Loaded> loaded_;
  // [mesh]; (mesh, pair) N: as large as relaxed loads can be there, below a share of the load of the meshes they are dropped.
  std::vector<Live> live_;
  Eigen::VectorXd remembered_;
  Eigen::VectorXd p_of_tooth_;  // (mesh, pair) N, of slices
  const Eigen::VectorXd& tooth_force() const { return points_ > 1 ? p_of_tooth_ : p_of_slot_; }
  // (slot) N m-1, in slices: relaxed and present line loads, and room for the next; (contact in whole lanes) N m-1
  Eigen::VectorXd line_load_, present_line_load_, next_line_load_, read_line_load_;
  std::vector<double> sums_;  // (contact, lane)
  Eigen::VectorXd rate_;      // (coordinate) z" + mu z', mu the damping by mass; of trains with rigid pins
  Eigen::VectorXd e_, p_, d_, p_of_slot_;  // e_, p_, d_: (contact)
  // (contact) of a part, those that carry: their rows and forces
  std::vector<const double*> carrying_rows_;
  std::vector<double> carrying_forces_;
  Eigen::VectorXd turned_;             // (body) m: r theta
  Eigen::Matrix2Xd shifted_, offset_;  // (xy, body) m: of its hub; its position error
  Certificate certificate_;
  MatrixRM forces_, tooth_forces_;
};

}  // namespace whine
