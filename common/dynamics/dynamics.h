// Two elastic gears that roll at constant mean speed: modes, relaxed residual flexibility, contact at every
// step.
//
// The system of both gears (Eq. 4, Eq. 5, Eq. 6) in these coordinates (unit modal mass, z'' + c z' + w^2 z = force):
// - one rigid rotation of the pair, along the line of action; the other, r1 theta1 - r2 theta2, is projected
// out;
// - per gear on a bearing two translations of its hub, and the one-diameter modes that couple with them through G, diagonalised
//   together: M0 = [[m, G^T], [G, 1]], K0 = diag(k, w^2). They are kept in the fixed frame, in which the hub is; teeth roll
//   past their shapes. All other doublets turn with their gear. Of the bearing's damper only the diagonal is kept, see
//   bearing_damping();
// - per gear the elastic modes. Those with zero diameters couple with the hub rotation through gamma and are
//   diagonalised with it: M0 = [[I, gamma^T], [gamma, 1]], K0 = diag(0, w^2);
// - what the modes leave of the flanks' flexibility relaxes with the Rayleigh time: eta U' + U = R p. Every truncated
//   mode has the same time, so loads are relaxed instead and U = R (relaxed loads). Relaxed loads are
//   stored as kFields coefficients per tooth in the basis V (the leading part of R on its flank table); the first kSharedFields
//   also couple neighbouring teeth. The rest, R - V V^T R V V^T, is instantaneous.
// With body = "full" the modes are all that the mesh has and nothing relaxes. What the half-plane adds to their flexibility
// between points of a flank, it being no finite element, is instantaneous: undamped_depth is then without meaning.
// With friction forces act on hubs along L = h + mu s T (gear/friction.h), its direction s and T of the nominal kinematics; what
// tangential forces do to the elastic bodies is left out. Torques are then T on the driver and T r_b2 / r_b1 (1 - loss) on the
// driven gear, the loss that at rest. Natural frequencies are without friction, rest() but for its torques and `force`.
// Gap of a strip: d = e - h z + U + A_local p >= 0 with p >= 0, p . d = 0 at the end of each step (Eq. 18).
// With contact = "line" a pair is one strip on one node, and Hertz's law of its force replaces the half-planes in
// A_local p. Like these it is relative to the undamped depth and instantaneous.
//
// Modes are smooth over a candidate zone: what they move there, and what force does on them, goes through kShapeRows functions
// per pair, the first Chebyshev polynomials on the candidate zone's nodes: mean and slope. What these leave out of the
// modes' flexibility, between the nodes of a position as a whole, is instantaneous. That puts the RMS of a sweep within 4e-5
// of that with all six nodes; without it two functions are 1.2e-4 off, three 1e-6. Residual flexibility is not that smooth
// near a tip edge and keeps all nodes.
//
// dynamics.cpp says what is integrated: positions, speeds, states at rest; dynamics_coordinates.cpp: coordinates of gears and
// what they move; dynamics_frozen.cpp: the pair at a phase that does not roll. integrate.cpp integrates a mesh period over the
// steps of step_kernel.h, energy_balance.cpp computes its energy balance. After a range, a speed and a state have been seen no
// period allocates memory.
#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "base/dense.h"
#include "dynamics/energy_balance.h"
#include "dynamics/fixed_phase_motion.h"
#include "dynamics/motion_period.h"
#include "dynamics/newmark.h"
#include "dynamics/step_kernel.h"
#include "dynamics/step_work.h"
#include "results/static.h"
#include "system/rolling_mesh.h"

namespace whine {

struct DynamicParameters {
  double torque = 0;            // N m on the driver; the driven gear resists with torque r_b2 / r_b1
  std::vector<double> inertia;  // (gear) kg m2, total
  double mean_stiffness = 0;    // N m-1, sets the bearing dampers
  Damping damping;
  Fidelity fidelity;
  // 1: share of the power that friction takes at rest over the coefficient of friction; the driven gear's torque is less by it
  double loss_per_friction = 0;
};

// Those of the pair of `statics` at its torque, in motion; mean_stiffness: N m-1, sets the bearing dampers.
// Throws as require_relaxation_range(); highest_frequency: Hz, largest mesh frequency of the motions, 0 of gears that do not roll.
DynamicParameters dynamic_parameters(const StaticResult& statics, double mean_stiffness,
                                     const SweepParameters& settings, double highest_frequency);
// Throws Error(input) for bodies whose residual flexibility relaxes, if the Rayleigh time is more than kMostRelaxation of a mesh period:
// a pair that comes in then meets the undamped compliance alone, which the motion depends on more than on all else.
inline constexpr double kMostRelaxation = 0.25;
void require_relaxation_range(const Damping& damping, BodyModel body, double highest_frequency);
// The same in words; "" within the range.
std::string beyond_relaxation_range(const Damping& damping, BodyModel body, double highest_frequency);

// Limits of load and deflection in a motion at the torque of `statics`: 2.5 times those at rest, times `widening`, which grows
// where a motion exceeds them.
struct MotionBounds {
  MotionBounds(const GearMeshModel& model, const StaticResult& statics, double widening = 1);
  double force;       // N, of a pair
  double deflection;  // m; of teeth that differ beside what they are ahead or behind without load
};
CandidateZone candidate_zone(const GearMeshModel& model, const StaticResult& statics,
                             const MotionBounds& bounds);

// Bytes of a candidate contact zone in memory, as far as they may grow beyond a machine.
struct ZoneMemory {
  double coordinates = 0;  // at nodes of all positions
  double gaps = 0;         // of teeth that differ
};

class RollingDynamics {
 public:
  // Throws Error(input) if a total inertia is not above what the body's modes carry or body = "full" finds a body that does
  // not hold every mode, Error(numerical) if the modes of a gear free to turn cannot be found.
  RollingDynamics(const GearMeshModel& model, const DynamicParameters& parameters);

  // State at the start of a mesh period; relaxed fields per pair -reach..reach.
  struct State : StepState {
    double owner_id = 0;  // stamp of the gears and their modes that this is a state of
    int period =
        0;  // mesh periods since tooth 0 of both gears met at the pitch point, less whole hunting periods
  };
  // What one mesh period showed, sampled at each step: sample i at phase i / steps.
  struct Period {
    Eigen::VectorXd transmission_error;  // (step) m
    Eigen::MatrixXd tooth_pair_load;     // (pair, step) N, pairs -reach..reach
    // [gear] (xy, step) N: what it presses its bearing with, in the frame of placed(); empty for a rigid one
    std::vector<Eigen::MatrixXd> bearing_force;
    double drift_force = 0;  // N: largest force that the output must supply to hold the mean speed
    double least_gap = 0, least_force = 0;  // m, N: worst of the steps' certificates
    int fallbacks = 0;                      // steps that block pivoting alone could not solve
    double friction_coupling = 0;           // m: of their certificates, largest
    void show(MotionPeriod& out) const;
  };

  // Builds the strips, or the lines, at `steps` phases; keeps nothing of an earlier range. Of a range lines use the
  // corner gap alone. beside: of other dynamics in memory at the same time. Throws Error(input) if, with these, the
  // coordinates of all steps need more than 12 GB or gaps of teeth that differ more than 2 GB, Error(numerical) if the
  // residual fields leave more than 1e-3 of a gear's residual flexibility instantaneous.
  void set_zone(const CandidateZone& range, int steps, const ZoneMemory& beside = {});
  const ZoneMemory& memory() const { return memory_; }
  // mesh frequency: Hz; steps per period must divide the steps of the range.
  void set_speed(double mesh_frequency, int steps);
  // The same for a speed that is left after a few periods, without what an energy balance needs: none may be recorded.
  void pass_speed(double mesh_frequency, int steps);
  // Static equilibrium at phase 0, at rest.
  State rest();
  // Integrates one mesh period and renames teeth, so that the state can be compared with the one before.
  // False if contact leaves the candidate zone; the state is then undefined. With an energy balance a step of strips costs
  // three times as much, one of lines seven times. Throws Error(input) for a state of other gears or modes, or with an energy
  // balance of another zone; Error(numerical), with the mesh phase, if the contact of a step has no certified solution or a line
  // carries more than Hertz's law or its flanks hold.
  bool integrate(State& state, Period& period, EnergyBalance* energy_balance = nullptr);
  // The contact problem of each step of a period of strips integrated from `state`: what integrate() hands to its solver.
  struct ContactProblem {
    Eigen::MatrixXd compliance;  // (strip, strip) m N-1
    Eigen::MatrixXd friction;  // (strip, strip) m N-1: what friction adds to it, not symmetric; empty without
    Eigen::VectorXd offset;    // (strip) m: gap without new contact force
    ActiveSet active;          // of the solution
  };
  std::vector<ContactProblem> contact_problems(State& state);
  // Natural frequency of the mesh, Hz, contact frozen as the static load leaves it at phase i / (steps of the range) of a period: undamped,
  // the residual flexibility is instantaneous. The lowest that holds a tenth of the strongest one's energy after a step of the torque; on
  // bearings that which gives way most to a force between the flanks, statically. Throws Error(numerical) if there is none.
  double frozen_frequency(int i, int period = 0);
  // All of them (coordinate), ascending; not of body = "full".
  Eigen::VectorXd frozen_frequencies(int i, int period = 0);
  // (coordinate, coordinate) s-1: the damping of the gears' hubs and modes with all that a bearing's damper couples. Steps keep
  // its diagonal: a damper on the hub alone would be diagonal only with damping = rayleigh_stiffness x stiffness.
  Eigen::MatrixXd bearing_damping() const;
  // The pair at phase i / (steps of the range), to be moved without rolling. Throws Error(input) for lines.
  FixedPhaseMesh hold(int i) const;
  // (node, coordinate): outward displacement of the flanks, hub rotation included, per unit coordinate; h of
  // the gap d = e - h z + ...
  Eigen::MatrixXd participation(const MeshPosition& mesh) const;
  // (2 coordinate) a - b, scaled so that its norm is the distance in the energy norm relative to the static state's.
  Eigen::VectorXd difference(const State& a, const State& b) const;
  double distance(const State& a, const State& b) const { return difference(a, b).norm(); }

  int hunting_periods() const { return hunting_; }  // see hunting_periods() of the model
  int reach() const { return reach_; }              // largest |pair| that can touch
  double bearing_damper(int g) const;               // N m s
  double friction() const { return friction_; }     // 1: coefficient at this speed
  const StepKernel& kernel() const { return kernel_; }
  const std::vector<StepPosition>& positions() const { return positions_; }
  double static_deflection() const { return static_deflection_; }  // m, transmission error of rest()

 private:
  friend class RollingPeriodMap;  // replays a period for its tangent
  struct Coordinate {
    explicit Coordinate(size_t gears, int own = -1) : gear(own), hub(gears) {}
    int gear = -1;            // -1: the rigid rotation
    double frequency = 0;     // rad s-1
    double damping = 0;       // s-1
    double torque = 0;        // constant force of the torques
    std::vector<double> hub;  // (gear) rad: rotation of its hub per unit
    double elastic =
        0;  // rad2 s-2, of TranslationalModes: part of its frequency squared that is due to the body
    Vec2 shift = Vec2::Zero();  // m: translation of its gear's hub per unit, in the frame of placed()
    std::vector<std::pair<int, double>> columns;  // body modes and their shares
    int partner = -1;                             // other half of a doublet
    double turn = 0;                              // rad: its turn per mesh period (0 if single)
  };
  // Coordinates of a gear in the fixed frame: its hub's translations and the modes that couple with them.
  struct TranslationalModes {
    int first = 0, count = 0;
    double tooth_angle = 0;  // rad
    // (flank, coordinate) outward displacement per unit on a tooth where tooth 0 is at phase 0, and a quarter of a turn on
    Eigen::MatrixXd there, quarter_on;
  };
  using Position = StepPosition;
  // What the energy balance keeps of an instant, in the order of mesh.pairs.
  struct Instant {
    int position = 0;
    int renamed = 0;  // added to its pair numbers since
    StepKernel::Vectors at;
    Eigen::VectorXd field, moved_load;  // as relaxed, m: displacement that relaxed, and present, loads cause
    Eigen::VectorXd dropped_field;      // m: share of `field` that a renaming took out
    double stored_dropped = 0;          // J: change of G R G / 2 by it
    double dropped = 0;                 // J: that, and the work of loads that went with it
    Eigen::VectorXd p, d, local;        // (strip) N, m, m: local p
    Eigen::VectorXd friction;  // (coordinate) of friction, less what contact_work has of the same forces
    double sliding_power = 0;  // W: mu s N v of the nominal rolling
    double driver_moment = 0;  // N m: of all contact forces on the driver, friction included
    double corner_power = 0;   // W: of normal forces off the line of action at nominal speed
    Eigen::Matrix4Xd shape_force, shape_displacement;  // (shape row and zeros, pair): of p on modes; of z
    double instantaneous_energy = 0;  // J: stored by half-planes, laws and all else that is instantaneous
  };
  struct EnergyBalanceWorkspace {
    std::array<Instant, 2> instants;  // before and after a step, in turn
    Eigen::VectorXd turned_back;  // (coordinate) z of the instant after a renaming, in the names before it
    Eigen::VectorXd frequency_squared, damping, torque;  // (coordinate), as in StepKernel::Vectors
    double balance = 0;
  };
  void size_energy_balance();
  void fill(Instant& now, const Instant* before, int position, const double* p, const double* d) const;
  void rename(Instant& instant) const;
  struct ContactWork {  // J, as the lines of the energy balance
    double rolling = 0, switching = 0, cutting = 0, dropped = 0;
  };
  struct ModalWork {
    double torque = 0, kinetic = 0, modal = 0, damping = 0;
  };
  struct RelaxationWork {
    double residual = 0, damping = 0, averaging = 0;
  };
  // J: shares of a force in fields, those of one side `apart` from those of the other, on the displacement of a tooth.
  double field_work(const double* shares, int apart, const Eigen::VectorXd& field, int slot) const;
  ContactWork contact_work(const Instant& before, const Instant& after);
  ModalWork modal_work(const Instant& before, const Instant& after) const;
  RelaxationWork relaxation_work(const Instant& before, const Instant& after) const;
  void fill_friction(Instant& now) const;
  // J: friction - friction_rolling of the step, whose vibration the other lines have.
  double record_friction(const Instant& before, const Instant& after, EnergyBalance& energy_balance) const;
  double torque_on_rolling(const Instant& before, const Instant& after) const;  // J
  double driver_speed() const;                                                  // rad s-1, mean
  void record_step(const Instant& before, const Instant& after, EnergyBalance& energy_balance);
  step_work::DampingIntegrals damping_integrals() const;
  double relaxation() const { return relaxation_; }
  // Resizes the loads of a state of another range, whose candidate zone may reach more or fewer teeth.
  void fit_teeth(State& state) const;
  bool integrate(State& state, Period& period, EnergyBalance* energy_balance,
                 std::vector<ContactProblem>* problems);
  bool keeps_corners(int position, double error) const;
  bool record_contact(const StepKernel::End& end, int position, Period& period) const;
  ContactProblem contact_problem() const;
  bool full() const { return full_; }
  bool lines() const { return lines_; }
  // At rest; compliance: (strip, strip) of static_compliance; offset: (strip) of elastic_offset.
  Equilibrium equilibrium_at(const Position& position, const Eigen::MatrixXd& compliance,
                             const Eigen::VectorXd& offset);
  Eigen::VectorXd elastic_offset(const Position& position) const;
  void set_hunting_gaps(double beside);
  // Gives a position the gaps of the teeth that meet there in a mesh period; nothing to do for teeth that are alike.
  void set_gap(int position, int period) {
    if (hunting_ > 1) put_gap(position, period);
  }
  void put_gap(int position, int period);
  // What cracks add to the compliance at a position in a mesh period; period -1: nothing.
  void set_cracks();
  void put_crack(int position, int period);
  // result: (strip) m, of all that is instantaneous, without laws of lines; p: (strip) N.
  void displace_locally(int position, const double* p, Eigen::VectorXd& result) const;
  Eigen::MatrixXd local_compliance(int position) const;  // (strip, strip) m N-1, the same
  // Of the constructor.
  int gears() const { return static_cast<int>(model_.gear.size()); }
  void require_bodies() const;
  void add_rigid_rotation();
  std::vector<int> modes_of(int g) const;
  void weigh_coordinates();
  double rayleigh_damping(double frequency) const;    // s-1 of rad s-1
  void fill_friction_rows(Position& position) const;  // fills what friction needs
  void set_friction(double mesh_frequency);
  Eigen::VectorXd force_of(const Position& position, const Eigen::VectorXd& nodes) const;  // (coordinate)
  // Of set_zone.
  void place_positions(const CandidateZone& range, int steps);
  void require_zone_memory(int steps, const ZoneMemory& beside);
  std::vector<std::vector<Eigen::MatrixXd>> couple_fields(StepSystem& system);
  void fill_position(Position& position, const StepSystem& system,
                     const std::vector<std::vector<Eigen::MatrixXd>>& tables) const;
  void share_zones(StepSystem& system);
  std::vector<StepSystem::Turn> turns() const;
  void add_modes(int g, const std::vector<int>& columns);
  void add_torsion(int g, const std::vector<int>& columns);
  void add_sway(int g, const std::vector<int>& columns);
  struct Frozen {  // the contact of the static load
    Eigen::MatrixXd compliance,
        participation;  // (touching strip, touching strip), (touching strip, coordinate)
  };
  Frozen frozen(int i, int period);
  SymmetricEigen frozen_modes(int i, const Frozen& contact, bool vectors) const;
  void take_bearing_force(Period& period, int sample) const;
  const Eigen::MatrixXd& shape_on_tooth(int g, int tooth) const;
  Eigen::VectorXd flexibility() const;  // (coordinate) s2: 1 / w^2, 0 for the rigid rotation
  Eigen::MatrixXd modal_flexibility(
      const Position& position) const;  // (node, node) m N-1, of its participation
  Eigen::MatrixXd static_compliance(int position) const;
  double condensed_eigenvalue(const Eigen::MatrixXd& compliance, const Eigen::MatrixXd& h) const;  // s-2

  const GearMeshModel& model_;
  DynamicParameters parameters_;
  std::string
      beyond_depth_;  // why a failing contact of this range fails; "" where the undamped half-plane holds it
  bool full_, lines_, newmark_;         // of the fidelity
  bool floating_;                       // a gear is on a bearing
  double relaxation_;                   // s, of the residual flexibility
  std::vector<std::vector<int>> kept_;  // [gear]: body modes
  std::vector<Coordinate>
      coordinates_;                    // the rigid rotation, then those of gear 0, then those of gear 1, ...
  std::vector<int> first_coordinate_;  // (gear), and the end
  std::vector<TranslationalModes> sway_;  // (gear)
  // [gear][tooth] (flank, coordinate of the gear) outward displacement per unit, hub at rest
  mutable std::vector<std::map<int, Eigen::MatrixXd>> shape_;
  Eigen::VectorXd error_weight_, torque_force_, frequency_squared_;
  // (coordinate) m: by how much the flanks close on the line of action, translations of the hubs included
  Eigen::VectorXd closing_weight_;
  double friction_ = 0;         // 1: coefficient at this speed
  double rigid_frequency_ = 0;  // rad s-1: sqrt(mean stiffness / reduced mass)
  int reach_ = 1, steps_ = 0, stride_ = 1;
  std::vector<Position> positions_;
  ZoneMemory memory_;
  int hunting_ = 1;
  std::vector<size_t> hunting_place_;  // (position) of its gaps in each mesh period's part of hunting_gap_
  std::vector<double> hunting_gap_;    // m: (mesh period, strip of all positions), of teeth that differ
  // (node, node) m N-1 of a mesh period and position at which a tooth near a cracked one is in reach
  std::map<std::pair<int, int>, Eigen::MatrixXd> crack_;
  std::vector<Eigen::MatrixXd> intact_;  // [position] what is instantaneous without cracks
  std::vector<char> crack_is_put_;       // [position]
  step_work::DampingIntegrals damping_;
  double step_ = 0;                      // s
  std::vector<Eigen::MatrixXd> fields_;  // [gear] (flank, field) V, orthonormal
  // By position: what a pair's force does on the rigid rotation that is projected out; gaps of tip edges.
  struct PositionLevers {
    double drift_lever[kMostPairs] = {};    // 1: a1 / r1 - a2 / r2
    double slide_lever[kMostPairs] = {};    // 1: s (t1 / r1 - t2 / r2), per coefficient of friction
    double driver_lever[kMostPairs] = {};   // m: a1
    double driver_across[kMostPairs] = {};  // m: s t1, of pairs with friction
    double next_gap = 0, lost_gap = 0;      // m
  };
  std::vector<PositionLevers> corners_;
  double static_deflection_ = 0, energy_scale_ = 0, owner_id_ = 0;
  int sample_ = 0;  // of the step at hand
  StepKernel kernel_;
  EnergyBalanceWorkspace balance_work_;
  ComplementaritySolver solver_;
};

}  // namespace whine
