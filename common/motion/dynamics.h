// Two elastic gears that roll at constant mean speed: modes, lagged residual flexibility, contact at every
// step.
//
// Coordinates (unit modal mass, z'' + c z' + w^2 z = force):
// - one rigid rotation of the pair, along the line of action; the other, r1 theta1 - r2 theta2, is projected
// out;
// - per gear on a bearing two translations of its hub, and the one-diameter modes that couple with them through G, diagonalised
//   together: M0 = [[m, G^T], [G, 1]], K0 = diag(k, w^2). They are kept in the fixed frame, in which the hub is; teeth roll
//   past their shapes. All other doublets turn with their gear. Of the bearing's damper only the diagonal is kept, see
//   bearing_damping();
// - per gear the elastic modes. Those with zero diameters couple with the hub rotation through gamma and are
//   diagonalised with it: M0 = [[I, gamma^T], [gamma, 1]], K0 = diag(0, w^2);
// - what the modes leave of the flanks' flexibility relaxes with the Rayleigh time: eta U' + U = R p. Every truncated
//   mode has the same time, so loads are relaxed instead and U = R (lagged loads). A tooth carries them in a few
//   fields V of its flank table, those that hold all of R that is worth a memory, and gets from other teeth what the first
//   few of them hold; R - V V^T R V V^T follows at once.
// With body = "full" the modes are all that the mesh has and nothing lags. What the half-plane adds to their flexibility
// between points of a flank, it being no finite element, follows at once: undamped_depth is then without meaning.
// Gap of a strip: d = e - h z + U + A_local p >= 0 with p >= 0, p . d = 0 at the end of each step (Eq. 18).
// With contact = "line" a pair is one strip on one node, and Hertz's law of its force stands in for the half-planes in
// A_local p. It is relative to the undamped depth and follows at once, as they do.
//
// Modes are smooth over a window: what they move there, and what force does on them, goes through kShapeRows functions
// per pair, the first Chebyshev polynomials on the window's nodes: mean and slope. What these leave out of the
// modes' flexibility, between the nodes of a position as a whole, follows at once. That puts the RMS of a sweep within 4e-5 of that with all six nodes; without it two functions are 1.2e-4
// off, three 1e-6. Residual flexibility is not that smooth near a tip edge and keeps all nodes.
//
// All that a step streams lies packed by position, in rows and columns of whole lanes; neither steps nor periods
// allocate memory, with a ledger or without, once a range, a speed and a state have been seen.
//
// dynamics.cpp says what is marched: coordinates, positions, speeds, states at rest. march.cpp marches it, and alone knows
// how the numbers of a step lie in memory. ledger.cpp keeps the books.
#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/dense.h"
#include "base/huge_pages.h"
#include "contact/lanes.h"
#include "contact/line_contact.h"
#include "contact/strip_compliance.h"
#include "motion/held_motion.h"
#include "motion/ledger.h"
#include "motion/propagator.h"
#include "motion/rolling_mesh.h"
#include "signal/static_result.h"

namespace whine {

struct DynamicParameters {
  double torque = 0;                // N m on the driver; the driven gear resists with torque r_b2 / r_b1
  std::array<double, 2> inertia{};  // kg m2, total, per gear
  double mean_stiffness = 0;        // N m-1, sets the bearing dampers
  Damping damping;
  Fidelity fidelity;
};

// What a motion at the torque of `statics` may want of its contact: 2.5 times the load and the deflection of rest, times
// `widening`, which grows where a motion wants more.
struct MotionBounds {
  MotionBounds(const GearMeshModel& model, const StaticArtifact& statics, double widening = 1);
  double force;       // N, of a pair
  double deflection;  // m; of teeth that differ beside what they are ahead or behind without load
};
ContactRange contact_range(const GearMeshModel& model, const StaticArtifact& statics,
                           const MotionBounds& bounds);

// Bytes that a contact window takes as long as it is held, of what may grow beyond a machine.
struct WindowMemory {
  double coordinates = 0;  // at nodes of all positions
  double gaps = 0;         // of teeth that differ
};

class RollingDynamics {
 public:
  // Throws Error(input) if a total inertia is not above what the body's modes carry or body = "full" finds a body that does
  // not hold every mode, Error(numerical) if the modes of a gear free to turn cannot be found.
  RollingDynamics(const GearMeshModel& model, const DynamicParameters& parameters);

  // State at the start of a mesh period; lag fields per pair -reach..reach.
  struct State {
    Eigen::VectorXd z, v;   // (coordinate) kg^1/2 m, kg^1/2 m s-1
    Eigen::VectorXd force;  // (coordinate) contact and torque at this instant
    Eigen::VectorXd p, d;   // (strip) N, m: at the phase of this instant
    std::array<Eigen::MatrixXd, 2> lag,
        load;         // (field, pair) N: lagged and present loads of the lagged fields
    double pair = 0;  // stamp of the gears and their modes that this is a state of
    int period =
        0;  // mesh periods since tooth 0 of both gears met at the pitch point, less whole hunting periods
  };
  // What one mesh period showed, sampled at each step: sample i at phase i / steps.
  struct Period {
    Eigen::VectorXd transmission_error;  // (step) m
    Eigen::MatrixXd pair_load;           // (pair, step) N, pairs -reach..reach
    // [gear] (xy, step) N: what it presses its bearing with, in the frame of placed(); empty for a rigid one
    std::array<Eigen::MatrixXd, 2> bearing_force;
    double drift_force = 0;  // N: largest force that the output must supply to hold the mean speed
    double least_gap = 0, least_force = 0;  // m, N: worst of the steps' certificates
    int fallbacks = 0;                      // steps that block pivoting alone could not solve
  };

  // Builds the strips, or the lines, at `steps` phases; keeps nothing of an earlier range. Of a range lines use the
  // corner gap alone. beside: of other dynamics that are held at the same time. Throws Error(input) if, with these, the
  // coordinates of all steps need more than 12 GB or gaps of teeth that differ more than 2 GB, Error(numerical) if the lagged fields leave more than 1e-3 of a gear's residual flexibility to follow at once.
  void set_range(const ContactRange& range, int steps, const WindowMemory& beside = {});
  const WindowMemory& memory() const { return memory_; }
  // mesh frequency: Hz; steps per period must divide the steps of the range.
  void set_speed(double mesh_frequency, int steps);
  // Static equilibrium at phase 0, at rest.
  State rest();
  // Marches one mesh period and renames teeth, so that the state can be compared with the one before.
  // False if contact wanted more than the range holds; the state is then spoiled. With a ledger a step of strips costs
  // three times as much, one of lines seven times. Throws Error(input) for a state of other gears or modes, or with a
  // ledger of another range; Error(numerical), with the mesh phase, if the contact of a step has no certified
  // solution or a line carries more than Hertz's law or its flanks hold.
  bool march(State& state, Period& period, Ledger* ledger = nullptr);
  // The contact problem of each step of a period of strips marched from `state`: what march hands to its solver.
  struct ContactProblem {
    Eigen::MatrixXd compliance;  // (strip, strip) m N-1
    Eigen::VectorXd offset;      // (strip) m: gap without new contact force
    ActiveSet active;            // of the solution
  };
  std::vector<ContactProblem> contact_problems(State& state);
  // What a step at phase i / (steps of the range) works on; whole lanes.
  struct StepSizes {
    int coordinates = 0;  // of both gears
    int pairs = 0;        // present
    int rows = 0;         // functions of a pair that modes go through
    int nodes = 0;        // of a pair
    int strips = 0;       // of a pair
    int edges = 0;        // windows that end at a tip edge, and are like no other
    int fields = 0;       // lagged, of one tooth
    int shared = 0;       // of them, those that other teeth depend on
    int teeth = 0;        // whose lag is followed, per gear
  };
  StepSizes step_sizes(int i) const;
  // Natural frequency of the mesh, Hz, with the contact frozen as the static load leaves it at phase i / (steps of
  // the range) of a mesh period: undamped, the residual flexibility follows at once. The lowest one; of gears on bearings that
  // which gives way most to a force between the flanks, statically. Throws Error(numerical) if there is none.
  double frozen_frequency(int i, int period = 0);
  // All of them (coordinate), ascending; not of body = "full".
  Eigen::VectorXd frozen_frequencies(int i, int period = 0);
  // (coordinate, coordinate) s-1: the damping of the gears' hubs and modes with all that a bearing's damper couples. Steps keep
  // its diagonal: a damper on the hub alone would be diagonal only with damping = rayleigh_stiffness x stiffness.
  Eigen::MatrixXd bearing_damping() const;
  // The pair at phase i / (steps of the range), to be moved without rolling. Throws Error(input) for lines.
  HeldMesh hold(int i) const;
  // (node, coordinate): outward displacement of the flanks, hub rotation included, per unit coordinate; h of
  // the gap d = e - h z + ...
  Eigen::MatrixXd participation(const MeshPosition& mesh) const;
  // (2 coordinate) a - b, scaled so that its norm is the distance in the energy norm relative to the static state's.
  Eigen::VectorXd difference(const State& a, const State& b) const;
  double distance(const State& a, const State& b) const { return difference(a, b).norm(); }

  int hunting_periods() const { return hunting_; }                 // see hunting_periods() of the model
  int reach() const { return reach_; }                             // largest |pair| that can touch
  double bearing_damper(int g) const;                              // N m s
  double static_deflection() const { return static_deflection_; }  // m, transmission error of rest()

 private:
  friend class RollingPeriodMap;  // replays a period for its tangent
  struct Coordinate {
    int gear = -1;                // -1: the rigid rotation
    double frequency = 0;         // rad s-1
    double damping = 0;           // s-1
    double torque = 0;            // constant force of the torques
    std::array<double, 2> hub{};  // rotation of each hub per unit, rad
    double elastic = 0;           // rad2 s-2, of a Sway: of its frequency squared, what the body holds
    Vec2 shift = Vec2::Zero();    // m: translation of its gear's hub per unit, in the frame of placed()
    std::vector<std::pair<int, double>> columns;  // body modes and their shares
    int partner = -1;                             // other half of a doublet
    double turn = 0;                              // rad: its turn per mesh period (0 if single)
  };
  // Coordinates of a gear that stand in the fixed frame: its hub's translations and the modes that couple with them.
  struct Sway {
    int first = 0, count = 0;
    double tooth_angle = 0;  // rad
    // (flank, coordinate) outward displacement per unit on a tooth where tooth 0 is at phase 0, and a quarter of a turn on
    Eigen::MatrixXd there, quarter_on;
  };
  struct Step {  // one position at one speed
    struct Size {
      int rows, columns;        // of the compliance
      int strips;               // of all pairs; 0 for lines
      size_t numbers() const {  // that a step takes of its memory
        const auto whole = static_cast<size_t>(padded(strips));
        return static_cast<size_t>(rows) * static_cast<size_t>(columns) + whole * whole;
      }
    };
    Step(Size size, std::pmr::memory_resource* memory)
        : store(static_cast<size_t>(size.rows) * static_cast<size_t>(size.columns), memory),
          compliance(store.data(), size.rows, size.columns),
          active(memory) {
      active.inverse.reserve(size.strips);
    }
    std::pmr::vector<double> store;
    // Of lines (pair, pair), of strips that between nodes: StripCompliance::at_nodes.
    Eigen::Map<Eigen::MatrixXd> compliance;
    ActiveSet active;
    PairVector force;  // (pair) N, of lines: what they carried here last; empty: not known
    LineStart start;   // of lines, at this speed
  };
  // What a step looks up of its position, side by side. Places in stream_, where columns of nodes stand 8 a pair and rows
  // of coordinates have whole lanes.
  struct Frame {
    struct Pair {
      double drift_lever = 0;    // 1: a1 / r1 - a2 / r2
      size_t interpolation = 0;  // (strip of the pair, node of the pair)
      size_t half_plane = 0;     // (strip of the pair, strip of the pair)
      size_t field = 0;          // of strips: per gear (node of the pair, field)
      int slot = 0;              // its column in lag and load
      bool low_is_edge = false, high_is_edge = false;
    };
    int present = 0, of_pair = 0;    // pairs; strips of a pair
    size_t gap = 0;                  // (strip)
    size_t at_once = 0;              // of strips: StripCompliance::at_nodes, of what follows at once
    size_t shape = 0;                // (pair, coordinate, shape row), four coordinates side by side
    size_t line = 0;                 // of lines: (pair) LineRecord
    std::span<const HertzLine> law;  // of lines: (pair)
    double next_corner_gap = 0, lost_corner_gap = 0;
    std::array<Pair, kMostPairs> pair;
  };
  struct Position {
    MeshPosition mesh;
    Eigen::MatrixXd at_once;                      // (node, node): of bodies, what follows at once
    Eigen::MatrixXd participation;                // (node, coordinate)
    Eigen::MatrixXd lagged;                       // (node, node): of both gears, when nothing moves
    std::array<Eigen::MatrixXd, 2> field_weight;  // (node, field)
    size_t hunting = 0;  // place of its gaps in each mesh period's part of hunting_gap_
    Frame frame;
  };
  using Stream = std::pmr::vector<double>;  // on huge_pages(), so lanes stand in one cache line
  struct LineRecord;
  struct ShapeLanes;
  static const ShapeLanes kShape;
  // What a rung of contact does within a step.
  struct StripContact;
  struct LineContact;
  struct RecordedContact;
  // Four coordinates in turn, so that a step runs down one array: what it takes them on with, and what they count for. Those
  // from bq on are of hubs and of the ends of periods, and stand apart.
  struct SpeedCoefficients {
    // bv is a12 in either propagator. push_z, push_v: what half a new force takes off z and v by the end of the next step.
    enum Of { a11, a12, a21, a22, push_z, push_v, kOften, bq = kOften, torque, weight, kCount };
    static constexpr int kSeldom = kCount - kOften;
    // Of four coordinates from c on, of `coordinates` in whole lanes.
    static constexpr int place(Of of, int c, int coordinates) {
      return of < kOften ? c * kOften + of * kLanes
                         : coordinates * kOften + c * kSeldom + (of - kOften) * kLanes;
    }
    Eigen::VectorXd number;
    double& at(Of of, int coordinate) {
      return number[place(of, coordinate / kLanes * kLanes, static_cast<int>(number.size()) / kCount) +
                    coordinate % kLanes];
    }
  };
  // Whole lanes of coordinates that turn a hub, 0 to first_end and second to second_end: the others see no torque and do not
  // count for the transmission error.
  struct HubLanes {
    int first_end = 0, second = 0, second_end = 0;
  } hub_lanes_;
  static constexpr int kFields = 12;       // lagged, per tooth
  static constexpr int kSharedFields = 8;  // the first of them: what teeth of a gear do to each other
  static constexpr int kPairNodes = StripCompliance::kPairNodes;  // columns of nodes
  static constexpr int kShapeRows = 2;  // per pair: what modes are read and loaded through
  static_assert(kFields == 12 && kSharedFields == 8 && kPairNodes == 8 && kPairNodes >= kWindowNodes);
  static_assert(kShapeRows <= kLanes && kShapeRows <= kWindowNodes);
  // (node, shape row) orthonormal: the first Chebyshev polynomials on the Chebyshev points of a window.
  using ShapeBasis = Eigen::Matrix<double, kWindowNodes, kShapeRows>;
  static const ShapeBasis& shape_basis();
  struct Turn {  // of a doublet, or of a single mode that changes its sign (sine < 0), per tooth
    int cosine, sine;
    double c, s;
  };
  // Vectors of a march, sized by the range; coordinates in whole lanes, fields of one gear after the other.
  struct Workspace {
    Eigen::VectorXd z, v, force, torque;  // (coordinate)
    Eigen::VectorXd rest;                 // (coordinate) halved forces of pairs beyond the first two
    Eigen::VectorXd lag,
        load;  // (field of all pairs of both gears) N: without and with the new load; the new load
    Eigen::VectorXd field, moved_load;  // as lag, m: displacement that lagged, and present, loads cause
    Eigen::VectorXd e, p, d;            // (strip)
    Eigen::VectorXd nodes;              // (node of all pairs)
  };
  // What the ledger keeps of an instant, in the order of mesh.pairs.
  struct Instant {
    const Position* position = nullptr;
    int renamed = 0;                    // added to its pair numbers since
    Eigen::VectorXd z, v, force;        // (coordinate), as in Workspace
    Eigen::VectorXd lag, load;          // as in Workspace
    Eigen::VectorXd field, moved_load;  // as lag, m: displacement that lagged, and present, loads cause
    Eigen::VectorXd forgotten_field;    // m: share of `field` that a renaming took out
    double stored_forgotten = 0;        // J: change of G R G / 2 by it
    double forgotten = 0;               // J: that, and the work of loads that went with it
    Eigen::VectorXd p, d, local;        // (strip) N, m, m: local p
    Eigen::VectorXd moment, reading;    // (pair, shape row in lanes): of p on modes; of z
    double at_once = 0;                 // J: stored by half-planes, laws and all else that follows at once
  };
  struct LedgerWorkspace {
    std::array<Instant, 2> instants;  // before and after a step, in turn
    Eigen::VectorXd turned_back;  // (coordinate) z of the instant after a renaming, in the names before it
    Eigen::VectorXd frequency_squared, damping;  // (coordinate), whole lanes
    double balance = 0;
  };
  // Integrals over one step that the ledger's dampers need, by coordinate and for the lag.
  struct DampingIntegrals {
    Eigen::VectorXd speed, mixed, push;  // of a22^2, a22 s, s^2, v = a22 v0 + s (mean force - w^2 z0)
    double decay2 = 0, mixed2 = 0,
           growth2 = 0;  // of (a, b): load - lag = a (load0 - lag0) + b (load1 - load0)
    double decay = 0, growth = 0, late_decay = 0, late_growth = 0;  // of a, b, t a, t b
  };
  void fill(Instant& now, const Instant* before, const Position& position, const double* p,
            const double* d) const;
  void rename(Instant& instant) const;
  void record_step(const Instant& before, const Instant& after, Ledger& ledger);
  void take(const State& state);
  void give(State& state) const;
  // y: (coordinate); direction -1 turns back.
  void turn_doublets(double* y, int direction = 1) const;
  void advance_fields(double* fields) const;  // as Workspace::lag
  // Of pair j of a position. m of its shape rows that z (coordinate) moves.
  Lanes reading(const Position& position, size_t j, const double* z) const;
  // Shares of p (strip of the pair) in shape rows, and in fields (driver's, then driven gear's).
  Lanes collect(const Position& position, size_t j, const double* p, double* fields) const;
  // field (of a tooth) += coupling loads (of a tooth), offset pairs away.
  void add_displacement(int g, int offset, const double* loads, double* field) const;
  void displace(int g, const double* loads, double* field) const;  // field = coupling loads, all of one gear
  DampingIntegrals damping_integrals() const;
  double relaxation() const { return relaxation_; }
  template <int kRows>
  struct Modes;
  struct LiveTeeth;
  LiveTeeth live_teeth();
  template <class Contact>
  bool march(Contact contact, State& state, Period& period, Ledger* ledger);
  const Eigen::MatrixXd& coupling(int g, int offset) const { return coupling_[g][offset + 2 * reach_]; }
  int all_fields() const { return kFields * (2 * reach_ + 1); }  // of one gear
  bool full() const { return full_; }
  void size_workspaces();
  void add_response(const Position& position, Eigen::MatrixXd& at_nodes);
  bool lines() const { return lines_; }
  // At rest; compliance: (strip, strip) of static_compliance; offset: (strip) of elastic_offset.
  Equilibrium equilibrium_at(const Position& position, const Eigen::MatrixXd& compliance,
                             const Eigen::VectorXd& offset);
  Eigen::VectorXd elastic_offset(const Position& position) const;
  void set_hunting_gaps(double beside);
  // Gives a position the gaps of the teeth that meet there in a mesh period; nothing to do for teeth that are alike.
  void set_gap(Position& position, int period) {
    if (hunting_ > 1) put_gap(position, period);
  }
  void put_gap(Position& position, int period);
  void pack();
  void pack_gap(const Position& position);
  struct Windows;
  void pack_strips(Position& position, Windows& known);
  size_t most_numbers(const Position& position) const;
  static void put_at_nodes(const Eigen::MatrixXd& at_nodes, double* to);
  // Of strips; at_nodes: StripCompliance's.
  StripCompliance strip_compliance(const Position& position, const double* at_nodes) const;
  // result: (strip) m, of all that follows at once, without laws of lines; p: (strip) N.
  void displace_locally(const Position& position, const double* p, Eigen::VectorXd& result) const;
  Eigen::MatrixXd local_compliance(const Position& position) const;  // (strip, strip) m N-1, the same
  void pack_lines(Position& position);
  void add_modes(int g, const std::vector<int>& columns);
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
  Eigen::MatrixXd static_compliance(const Position& position) const;
  double condensed_eigenvalue(const Eigen::MatrixXd& compliance, const Eigen::MatrixXd& h) const;  // s-2

  const GearMeshModel& model_;
  DynamicParameters parameters_;
  bool full_, lines_, newmark_;  // of the fidelity
  bool floating_;                // a gear is on a bearing
  double relaxation_;            // s, of the lagged flexibility
  std::array<std::vector<int>, 2> kept_;
  std::vector<Coordinate> coordinates_;  // the rigid rotation, then those of gear 0, then those of gear 1
  std::array<int, 2> first_coordinate_{};
  std::array<Sway, 2> sway_;
  // [tooth] (flank, coordinate of the gear) outward displacement per unit, hub at rest
  mutable std::array<std::map<int, Eigen::MatrixXd>, 2> shape_;
  Eigen::VectorXd error_weight_, torque_force_, frequency_squared_;
  // (coordinate) m: by how much the flanks close on the line of action, translations of the hubs included
  Eigen::VectorXd closing_weight_;
  double rigid_frequency_ = 0;  // rad s-1: sqrt(mean stiffness / reduced mass)
  int reach_ = 1, steps_ = 0, stride_ = 1;
  std::vector<Position> positions_;
  Stream stream_{&huge_pages()};
  WindowMemory memory_;
  int hunting_ = 1;
  std::vector<double> hunting_gap_;  // m: (mesh period, strip of all positions), of teeth that differ
  HugeBlock step_memory_;            // for as many steps as the range has positions
  std::unique_ptr<std::pmr::monotonic_buffer_resource> step_pool_;  // on it
  std::vector<Step> step_data_;                                     // in it
  SpeedCoefficients speed_;
  DampingIntegrals damping_;
  Lag lag_{};
  double step_ = 0;                        // s
  std::array<Eigen::MatrixXd, 2> fields_;  // (flank, field) V, orthonormal
  // By offset between pairs, -2 reach..2 reach: (field, field) m N-1, of neighbours in the shared fields.
  std::array<std::vector<Eigen::MatrixXd>, 2> coupling_;
  double static_deflection_ = 0, energy_scale_ = 0, pair_stamp_ = 0;
  int sample_ = 0;  // of the step at hand
  std::vector<Turn> turns_;
  Workspace work_;
  LedgerWorkspace ledger_work_;
  ComplementaritySolver solver_;
};

}  // namespace whine
