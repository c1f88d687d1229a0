// The time step of two elastic bodies in mesh, on lanes: all that knows how the numbers of a step lie in memory.
//
// Modes z'' + c z' + w^2 z = force, relaxed loads g of each tooth (eta g' + g = l), contact (Eq. 18) at the end of the step. Per step
// of length h, with the force f = t - h^T n of its start (t: torques, n: node forces, h: participation) and the propagator of
// each coordinate:
//   z* = a11 z + a12 v + (bq / 2) (f + t),  v* = a21 z + a22 v + (a12 / 2) (f + t),  g* = decay g + from_old l
//   e  = gap - W (h z* - sum over sides of V C g*)                          gap without new contact force
//   A  = H + W (B + from_new R + h (bq / 2) h^T) W^T                        H: half-planes, B: instantaneous_compliance, R: relaxed
//   d  = A p + e >= 0,  p >= 0,  d . p = 0                                  of lines with Hertz's law of p in place of H
//   n  = W^T p,  l = V^T n,  z = z* - (bq / 2) h^T n,  v = v* - (a12 / 2) h^T n,  g = g* + from_new l.
// With friction forces act on modes through L = h + mu s T in place of h (T of a pair's force as a whole, gear/friction.h), and
// gaps are still read through h: A + h (bq / 2) (L - h)^T is not symmetric. Such a step is solved by solve_with_friction().
// W: (strip, node) interpolation; V: (node, field) of a pair; C: coupling of the fields of two teeth of a gear; lines have a
// node per pair and W = 1. tests/step_kernel_reference.h has the same equations in plain matrices; tests/dynamics/test_step_kernel.cpp
// compares them.
//
// Layout: positions one after the other in one stream, rows and columns of whole lanes (contact/lanes.h), four coordinates in
// turn. Neither steps nor periods allocate memory once positions, speed and a state are set.
#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/huge_pages.h"
#include "contact/complementarity.h"
#include "contact/lanes.h"
#include "contact/line_contact.h"
#include "contact/strip_compliance.h"
#include "dynamics/newmark.h"
#include "system/rolling_mesh.h"

namespace whine {

// One mesh phase in plain matrices; strips and nodes of all pairs one after the other.
struct StepPosition {
  struct Pair {
    int slot = 0;  // column of its teeth in relaxed and present loads
    int zone =
        0;  // of strips: which of StepSystem::half_plane is its own; candidate zones that are alike share one
  };
  MeshPosition mesh;
  std::vector<Pair> pair;                     // of mesh.pairs
  Eigen::MatrixXd instantaneous_compliance;   // (node, node) m N-1: of bodies, what is instantaneous
  Eigen::MatrixXd participation;              // (node, coordinate) h
  Eigen::MatrixXd relaxed;                    // (node, node) m N-1: of both gears, when nothing moves
  std::vector<Eigen::MatrixXd> field_weight;  // [side] (node, field) V
  Eigen::MatrixXd friction;  // (pair, coordinate) s T: per mu and force of the pair; empty without friction
  Eigen::VectorXd sliding_loss;  // (pair) m rad-1: s v per angle of the driver, as `friction`
};

// What all positions share.
struct StepSystem {
  struct Turn {  // of a doublet, or of a single mode that changes its sign (sine < 0), per tooth
    int cosine, sine;
    double c, s;
  };
  bool lines = false;                                  // Hertz's law of one force per pair in place of strips
  int reach = 1;                                       // largest |pair|; slot = pair + reach
  Eigen::VectorXd torque_force, error_weight;          // (coordinate): t; transmission error per unit
  std::vector<Turn> turns;                             // of the coordinates that turn with their gear
  std::vector<std::vector<Eigen::MatrixXd>> coupling;  // [side][offset + 2 reach] (field, field) m N-1
  std::vector<Eigen::MatrixXd> half_plane;             // [candidate zone] (strip, strip) m N-1

  const Eigen::MatrixXd& block(int side, int offset) const {
    const int place = offset + 2 * reach;
    return coupling[static_cast<size_t>(side)][static_cast<size_t>(place)];
  }
  int teeth() const { return 2 * reach + 1; }
};

// At an instant.
struct StepState {
  Eigen::VectorXd z, v;                        // (coordinate) kg^1/2 m, kg^1/2 m s-1
  Eigen::VectorXd force;                       // (coordinate) contact and torque
  Eigen::VectorXd p, d;                        // (strip) N, m
  std::vector<Eigen::MatrixXd> relaxed, load;  // [side] (field, tooth) N: relaxed and present loads
};

class StepKernel {
 public:
  static constexpr int kStripsAtOnce = kLanes;  // candidate zones have a multiple of it
  static constexpr int kSides = 2;              // of a mesh
  static constexpr int kFields = 12;            // relaxed, per tooth
  static constexpr int kSharedFields = 8;       // the first of them: what teeth of a gear do to each other
  static constexpr int kPairNodes = StripCompliance::kPairNodes;  // columns of nodes
  static constexpr int kShapeRows = 2;  // per pair: what modes are read and loaded through
  static_assert(kFields == 12 && kSharedFields == 8 && kPairNodes == 8 && kPairNodes >= kZoneNodes);
  static_assert(kShapeRows <= kLanes && kShapeRows <= kZoneNodes);
  // (node, shape row) orthonormal: the first Chebyshev polynomials on the Chebyshev points of a candidate zone.
  using ShapeBasis = Eigen::Matrix<double, kZoneNodes, kShapeRows>;
  static const ShapeBasis& shape_basis();

  // What a step looks up of its position, side by side. Places in the stream, where columns of nodes are 8 a pair and rows of
  // coordinates have whole lanes.
  struct Frame {
    struct Pair {
      size_t interpolation = 0;  // (strip of the pair, node of the pair)
      size_t half_plane = 0;     // (strip of the pair, strip of the pair)
      size_t field = 0;          // of strips: per side (node of the pair, field)
      int slot = 0;
      bool low_is_edge = false, high_is_edge = false;
    };
    int present = 0, of_pair = 0;         // pairs; strips of a pair
    size_t gap = 0;                       // (strip)
    size_t instantaneous_compliance = 0;  // of strips: StripCompliance::at_nodes, of what is instantaneous
    size_t shape = 0;                     // (pair, coordinate, shape row), four coordinates side by side
    size_t line = 0;                      // of lines: (pair) LineRecord
    size_t load = 0,
           load_apart = 0;           // rows that forces act through, of a pair and the next: as shape, L of h
    size_t friction = 0;             // (pair, coordinate) StepPosition::friction
    std::span<const HertzLine> law;  // of lines: (pair)
    std::array<Pair, kMostPairs> pair;
  };
  // One position at one speed.
  struct Step {
    struct Size {
      int rows, columns;  // of the compliance
      int strips;         // of all pairs; 0 for lines
      size_t numbers() const;
    };
    Step(Size size, std::pmr::memory_resource* memory);
    std::pmr::vector<double> store;
    // Of lines (pair, pair), of strips that between nodes: StripCompliance::at_nodes.
    Eigen::Map<Eigen::MatrixXd> compliance;
    Eigen::MatrixXd intact;  // the same without cracks, once there was one here at this speed
    ActiveSet active;
    PairVector force;  // (pair) N, of lines: what they carried here last; empty: not known
    LineStart start;   // of lines, at this speed
    // (shape row of all pairs, pair) what friction of a pair's force moves at the end of a step, per N; empty without
    Eigen::MatrixXd friction;
  };
  // State vectors in whole lanes; fields of all teeth of one side after the other.
  struct Vectors {
    Eigen::VectorXd z, v, force;    // (coordinate)
    Eigen::VectorXd relaxed, load;  // (field of all teeth of all sides) N
  };
  // How a step ended. After zone_end, force on a candidate zone's end that is no tip edge, the state means nothing.
  enum class Contact { solved, zone_end, beyond_law };
  struct End {
    Contact contact = Contact::solved;
    Certificate certificate;
    double error = 0;                 // m: transmission error
    double carried[kMostPairs] = {};  // (pair) N
  };

  // Packs all positions; they and their laws stay where they are as long as steps are taken.
  void set_zone(StepSystem system, const std::vector<StepPosition>& positions);
  // (strip) m: of the teeth that meet there now.
  void set_gap(int position, const Eigen::VectorXd& gap);
  // (node, node) m N-1: what is instantaneous there now, and what of it a crack adds to the position's own; empty: nothing.
  void set_crack(int position, const Eigen::MatrixXd& instantaneous, const Eigen::MatrixXd& crack);
  // 1: coefficient of friction from the next set_speed on; torque_force: as in StepSystem. For positions with friction.
  void set_friction(double coefficient, const Eigen::VectorXd& torque_force);
  // `steps` a divisor of the number of positions. Active strips, or forces, of a step at the same phase stay as a first guess.
  void set_speed(std::vector<Propagator> propagators, const Relaxation& relaxed, int steps,
                 const std::vector<StepPosition>& positions);

  // A state of these coordinates and teeth.
  void load_state(const StepState& state);
  void store_state(StepState& state, int strips) const;
  // Takes modes and relaxed loads to step `sample` and reads its gaps, without new contact force.
  void predict(int sample);
  // Contact at `sample` and its share of all else. next: the step that is begun in the same pass, or -1.
  End correct(int sample, int next);
  // Gives teeth the names that they have in the next mesh period.
  void rename();

  const StepSystem& system() const { return system_; }
  const Frame& frame(int position) const { return frames_[static_cast<size_t>(position)]; }
  const Step& step(int sample) const { return steps_[static_cast<size_t>(sample)]; }
  const std::vector<Propagator>& propagators() const { return propagators_; }
  const Relaxation& relaxed() const { return relaxed_step_; }
  const Vectors& vectors() const { return vectors_; }
  const Eigen::VectorXd& p() const { return p_; }           // (strip) N
  const Eigen::VectorXd& d() const { return d_; }           // (strip) m
  const Eigen::VectorXd& e() const { return e_; }           // (strip) m: gaps without new contact force
  int coordinates() const { return coordinates_; }          // in whole lanes
  int fields() const { return kFields * system_.teeth(); }  // of one side
  // Of strips: A of a step; what is instantaneous at a position.
  StripCompliance compliance(int sample) const;
  StripCompliance instantaneous_compliance(int position) const;

  // For the energy balance. y: (coordinate), direction -1 turns back; fields: as Vectors::relaxed, one tooth on.
  void turn_doublets(double* y, int direction = 1) const;
  void advance_fields(double* fields) const;
  // Of pair j of a position, (shape row, then 0): m that z (coordinate) moves; shares of p (strip of the pair) in shape rows,
  // and in fields, side by side.
  Eigen::Vector4d reading(int position, int j, const double* z) const;
  Eigen::Vector4d collect(int position, int j, const double* p, double* fields) const;
  void displace(int side, const double* loads,
                double* field) const;  // field = coupling loads, all of one side

 private:
  // Coefficients of four coordinates in turn, so that a step runs down one array: what it takes them on with, and what they
  // count for. Those from bq on are of hubs and of the ends of periods, and are kept apart.
  struct Coefficients {
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
  };
  // Columns of relaxed and load, first to last - 1, outside which no tooth has any.
  struct LiveTeeth {
    int first = 0, last = 0;
    void add(int slot);
  };
  // Contact forces on the modes: h^T n as a sum over pairs, of each some rows of coordinates side by side. Factors
  // are halved: the mean force over a step is that of the torques less half of what comes new at its end, and half of what
  // went before.
  struct ModalLoad {
    int count = 0;
    const double* rows[kMostPairs];
    Lanes half[kMostPairs];
    void add(const double* rows_of, Lanes factor) {
      rows[count] = rows_of;
      half[count++] = 0.5 * factor;
    }
  };
  // What modes move pairs by: rows as above, and m.
  struct ModalReading {
    int count = 0;
    const double* rows[kMostPairs];
    double moved[kMostPairs][kShapeRows];
  };
  // Places of the numbers of one line; all lengths are whole lanes.
  struct LineRecord {
    int coordinates, fields;               // of all teeth of a side
    static constexpr int kGap = 0;         // m
    static constexpr int kMost = 1;        // N: beyond it neither Hertz's law nor the flanks hold
    static constexpr int kShape = kLanes;  // (coordinate)
    // m N-1: (shared field) of a tooth, one side after the other so that live teeth are adjacent; (other field) of its own
    int reading(int side, int tooth) const {
      return kShape + coordinates + (kSides * tooth + side) * kSharedFields;
    }
    int own_reading(int side) const {
      return reading(0, fields / kFields) + side * (kFields - kSharedFields);
    }
    int weight(int side) const { return own_reading(kSides) + side * kFields; }  // (field of its own)
    int size() const { return weight(kSides); }
  };
  LineRecord record() const { return {coordinates_, fields()}; }
  struct ShapeLanes;
  static const ShapeLanes kShape;
  template <int kRows>
  struct Modes;
  struct StripContact;
  struct LineContact;
  template <class Model>
  Certificate solve_sliding(Model& model, const Frame& frame, Step& step);
  Eigen::MatrixXd friction_response(const Frame& frame) const;
  template <class Model>
  void begin_with(Model model, int sample);
  template <class Model>
  End finish_with(Model model, int sample, int next);

  int position_of(int sample) const { return sample * stride_; }
  void set_hubs();
  void size_workspaces(const std::vector<StepPosition>& positions);
  size_t numbers(const StepPosition& position) const;
  size_t place(Eigen::Index count);
  size_t place_matrix(const Eigen::Ref<const Eigen::MatrixXd>& m);
  void pack_lines(const StepPosition& position, Frame& frame);
  using Window =
      std::optional<std::pair<size_t, size_t>>;  // places of interpolation and half-plane, once laid down
  void pack_strips(const StepPosition& position, Frame& frame, std::vector<Window>& zones);
  void pack_loads(const StepPosition& position, Frame& frame);
  static void put_at_nodes(const Eigen::MatrixXd& at_nodes, double* to);
  void size_steps(int steps);
  void add_response(const Frame& frame, Eigen::MatrixXd& at_nodes) const;
  StripCompliance strip_compliance(const Frame& frame, const double* at_nodes) const;
  const double* shape_of(const Frame& frame, int j) const;
  // field (of a tooth) += coupling loads (of a tooth), offset pairs away.
  void add_displacement(int side, int offset, const double* loads, double* field) const;
  LiveTeeth live_teeth();
  void relax(bool loaded);

  StepSystem system_;
  int coordinates_ = 0, stride_ = 1;
  double friction_ = 0;  // 1: coefficient
  HubLanes hubs_;
  std::vector<Frame> frames_;
  std::pmr::vector<double> stream_{&huge_pages()};  // so lanes lie in one cache line
  HugeBlock step_memory_;                           // for as many steps as there are positions
  std::unique_ptr<std::pmr::monotonic_buffer_resource> step_pool_;  // on it
  std::vector<Step> steps_;                                         // in it
  std::vector<Propagator> propagators_;
  Coefficients coefficients_;
  Relaxation relaxed_step_{};
  Vectors vectors_;
  Eigen::VectorXd rest_;                // (coordinate) halved forces of pairs beyond the first two
  Eigen::VectorXd field_, moved_load_;  // as relaxed, m: displacement that relaxed, and present, loads cause
  Eigen::VectorXd e_, p_, d_;           // (strip)
  Eigen::VectorXd nodes_;               // (node of all pairs) forces
  LiveTeeth live_;
  unsigned long followed_ = 0;  // bit: slot, whose displacement is that of the step before
  ModalReading reading_;
  ModalLoad load_;
  ComplementaritySolver solver_;
};

}  // namespace whine
