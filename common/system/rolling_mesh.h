// Two elastic gears in mesh at given positions: strips, gaps and compliance, ready for statics and dynamics.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "contact/complementarity.h"
#include "contact/half_plane_strip.h"
#include "contact/line_contact.h"
#include "contact/strips.h"
#include "gear/face_width.h"
#include "gear/friction.h"
#include "gear/pair.h"
#include "model/system.h"
#include "results/reduced_body.h"
#include "solid/flank_table.h"

namespace whine {

// One of a gear's flanks.
struct ToothFlank {
  int tooth = 0;  // its number, counter-clockwise, any whole one
  FlankSide side = FlankSide::leading;
};

// A gear's solid as contact sees it.
//
// The body's table R is what the finite elements say less the half-plane H_b(x; D_0) in the body's plane state, relative to the
// reference depth D_0. The displacement of the flank is u = R + H_b(x; D_0). Where the contact has a plane state c of its own,
// the half-plane between the surface and the depth D is in that state, and all below D stays the body's:
//   u = R + [H_b(x; D_0) - H_b(x; D)] + H_c(x; D) = R + C_b ln(D_0 / D) + H_c(x; D),
// H(x; D) = C (ln(D / |x|) - 1 / (2 (1 - nu))). Assumption: a sharp change at D. Inside a wide face the strain along the line
// is prevented near the line load only. With near_field = "subtraction" D is half the tooth thickness at the reference circle,
// pi m / 4, the depth that Weber and Banaschek (1953) give the local approach; with "matching" it is the matching depth, since
// just what lies above it is a half-plane there. Another depth f D would change u by (C_b - C_c) ln f: 0.5 % of the
// deflection of one pair of the paper's for f = 2.
//
// In a mesh with a narrower gear (gear/face_width.h) the half-plane above D has the width b_c of the contact, and the tooth below
// it carries on b_e of its width b:
//   u = T + (b / b_e - 1) (T - (R_1 + R_1^T) / 2) + H_c(x; D),   T = R + C_b ln(D_0 / D).
// R_1 is what the next tooth does, so that T - (R_1 + R_1^T) / 2 is half of what two neighbouring teeth open when they are pressed
// against each other: the tooth without the body under it, whose twist, rim and support have the whole width. It is positive
// semidefinite. The modes are those of the whole width; what is added is part of the residual flexibility.
class ElasticGear {
 public:
  // Throws Error(input) for numbers that are not finite, by the name of their array, and for a flank table with other
  // points than this program's.
  explicit ElasticGear(const ReducedBody& body, ContactPlane contact_plane = ContactPlane::body);
  // The same gear as a mesh whose contact is `contact_width` (m) wide sees it.
  ElasticGear in_mesh(double contact_width) const;
  const ReducedBody& body() const { return *body_; }
  // 1: b / b_e, by which the stress of a tooth is larger than on the whole width; 1 where it is carried by all of it.
  double concentration() const { return concentration_; }
  // (flank, flank) m N-1: what a contact narrower than the gear adds to the inward displacement of the loaded tooth below the depth of
  // the half-plane; zero on the whole width.
  Eigen::MatrixXd narrow_change() const;
  // In the plane state and of the width of the contact.
  const HalfPlaneSurface& half_plane() const { return half_plane_; }
  // m: down to which the half-plane of the contact takes the place of that of the body.
  double contact_depth() const;
  // m N-1: what the plane state and the width of the contact add to the half-plane's inward displacement, averaged over a strip of half width `reading`
  // (m) at distance x (m), of a unit force spread evenly over a strip of half width `half_width` (m).
  double plane_change(double x, double half_width, double reading) const;
  const FlankTable& table() const { return table_; }
  int table_size() const { return table_.size(); }
  // (flank, flank) m N-1: inward displacement read on tooth `offset` counter-clockwise of the loaded one,
  // less the half-plane relative to `depth` (m) on the loaded tooth itself. Zero beyond half of the teeth.
  Eigen::MatrixXd compliance(int offset, double depth) const;
  // The same between any two flanks of the gear, however far apart; of one flank relative to `depth`. Without cracks.
  Eigen::MatrixXd compliance(const ToothFlank& read, const ToothFlank& loaded, double depth) const;
  // The first less the part that the modes listed (columns of ReducedBody::flank_mode) carry: residual flexibility. Zero
  // beyond ReducedBody::offsets, where the modes have nearly all of it.
  Eigen::MatrixXd residual(int offset, double depth, const std::vector<int>& kept) const;
  bool cracked() const { return body_->crack_compliance.size() > 0; }
  // (flank, flank) m N-1: what the crack adds to the inward displacement of tooth `read` by a force on tooth `loaded`: numbers
  // of GearMeshModel::tooth_at_crack(), any whole ones. Empty where it adds nothing: without a crack, and further than the stored
  // offsets from the cracked tooth.
  Eigen::MatrixXd crack_compliance(int read, int loaded) const;
  // (root, flank) Pa N-1: the same of the stress along the root beside the driving flank.
  Eigen::MatrixXd crack_root_stress(int read, int loaded) const;
  // (flank) kg^-1/2: outward normal displacement of mode `column` on the tooth `tooth` places
  // counter-clockwise.
  Eigen::VectorXd mode_on_tooth(int column, int tooth) const;
  // The other component of a doublet; the column itself if the mode is single.
  int partner(int column) const;
  double tooth_angle(int column) const;  // rad: 2 pi n / teeth, the turn of a doublet per tooth

 private:
  // The block (rows, flank) of a table of the teeth about the crack.
  Eigen::MatrixXd of_crack(const MatrixRM& table, Eigen::Index rows, int read, int loaded) const;
  std::shared_ptr<const ReducedBody> body_;
  HalfPlaneSurface half_plane_, body_half_plane_;
  Material contact_material_;
  bool own_surface_;  // the contact has another plane state or width than the body
  double concentration_ = 1;
  FlankTable table_;
};

// The bodies on the two sides of a mesh; other meshes may hold the same ones.
class SideGears {
 public:
  using Shared = std::shared_ptr<const ElasticGear>;
  SideGears(Shared first, Shared second) : gear_{std::move(first), std::move(second)} {}
  const ElasticGear& operator[](size_t side) const { return *gear_[side]; }
  const Shared& shared(size_t side) const { return gear_[side]; }
  static constexpr size_t size() { return 2; }

 private:
  std::array<Shared, 2> gear_;
};

// One mesh: two bodies, each of which it sees from one side. All that it computes is in its own image: side 0 pushes, turns
// counter-clockwise and is at the origin, side 1 above it. `layout` says how the mesh lies in its system: turned by its
// direction, and mirrored where side 0 turns clockwise, which changes no length, no gap and, teeth being their own mirror
// images, no compliance.
struct GearMeshModel {
  // Of a system of one pair.
  GearMeshModel(const ReducedBody& driver, const ReducedBody& driven, const GearMeshSpec& mesh);
  GearMeshModel(const SideGears& gears, const GearMeshSpec& mesh, const System::Mesh& layout);
  GearPair kinematics;
  SideGears gear;  // [side] as this mesh sees them
  CornerRule corner;
  std::array<FlankDeviation, 2> deviation;  // [side]
  std::array<Bearing, 2> bearing;           // [side]
  Friction friction;
  System::Mesh layout;
  // [side] whether this mesh works on the flank of the gear beside whose fillet its crack is: forces on the other one close it, and the
  // tooth is then as an intact one.
  std::array<bool, 2> opens_crack{true, true};

  bool cracked(int g) const {
    const auto side = static_cast<size_t>(g);
    return opens_crack[side] && gear[side].cracked();
  }
  // Number of the tooth of side g in a pair, as its crack counts them: away from the cracked one in the direction in which the flank
  // that works leads.
  int tooth_at_crack(int g, int pair) const {
    const System::Side& side = layout.side[static_cast<size_t>(g)];
    const int crack = gear[static_cast<size_t>(g)].body().design.crack.tooth,
              ahead = side.tooth(pair) - crack;
    return crack + (side.flank == FlankSide::leading ? ahead : -ahead);
  }
  bool on_bearings() const { return bearing[0].elastic() || bearing[1].elastic(); }
  double face_width() const {  // m, on which teeth meet
    return contact_width(kinematics.gear(0).design(), kinematics.gear(1).design());
  }
  // 1: mu of the friction under `torque` (N m, on side 0) at a mesh frequency (Hz); 0 without.
  double coefficient_of_friction(double torque, double mesh_frequency) const {
    if (!friction.acts()) return 0;
    return friction_coefficient(kinematics, face_width(), friction, torque, mesh_frequency);
  }
  // Of gear g: outward displacement of its flank per unit translation of its hub, in the frame of placed().
  Vec2 outward(int g, const PairContact& contact = {}) const {
    return (g == 0 ? 1.0 : -1.0) * contact_normal(kinematics, contact);
  }
  // The direction of gear g in which friction acts as its contact normal does: outward() turned by 90 degrees, so that forces
  // p move its hub by -p (outward + mu s across).
  Vec2 across(int g, const PairContact& contact = {}) const {
    const Vec2 n = outward(g, contact);
    return {-n.y(), n.x()};
  }
  // The same in the frame of the system.
  Vec2 outward_in_system(int g, const PairContact& contact = {}) const;
  // Tooth of side g that works in pair `pair`, in the mesh's own image: pairs count in the sense of motion, teeth
  // counter-clockwise. Numbers in the system: layout.side[g].tooth(pair).
  static int tooth(int g, int pair) { return g == 0 ? pair : -pair; }
  // Flanks of a pair `period` mesh periods after tooth 0 of both gears met at the pitch point: the reference pair is then that
  // of the teeth `period` places behind.
  PairDeviation flanks(int pair = 0, int period = 0) const {
    return {{&deviation[0], &deviation[1]},
            {layout.side[0].tooth(pair - period), layout.side[1].tooth(pair - period)}};
  }
  // What all pairs have in common.
  PairDeviation common_flanks() const { return {{&deviation[0], &deviation[1]}, {kEveryTooth, kEveryTooth}}; }
};

// Which pairs may touch at one phase, in the order of their numbers.
struct PairsInReach {
  std::vector<int> pair;
  std::vector<PairContact> contact;
  double next_corner_gap =
      std::numeric_limits<double>::infinity();  // m, least gap of a tip edge left out as too far
  double lost_corner_gap =
      std::numeric_limits<double>::infinity();  // m, least gap of one that has no flank to touch

  int size() const { return static_cast<int>(pair.size()); }
};

// Mesh periods after which the same teeth meet, as far as teeth differ; 1 if they are all alike.
int hunting_periods(const GearMeshModel& model);

// corner_gap: m, tip edges with a larger gap than this are left out; where flanks deviate it is the least gap of the two
// flanks that counts, wherever near the edge it is, and of whichever teeth come nearest: pairs are the same in every mesh
// period.
PairsInReach pairs_in_reach(const GearMeshModel& model, double phase, double corner_gap);

// m: how far the driver turns ahead, along the line of action, until the first of its unloaded flanks touches: the least of
// all pairs' gaps, each over its driving lever. 0 for flanks that do not deviate. Exact to 1e-13 m.
double unloaded_transmission_error(const GearMeshModel& model, double phase, int period = 0);

struct FaceMesh;

// All that contact needs at one phase; strips and nodes of all pairs in one row, pair after pair. With one contact line
// per pair a line is a pair's only strip and only node.
struct MeshPosition {
  double phase = 0;
  std::vector<PairStrips> pairs;  // of a line: number, kinematics and gap
  std::vector<HertzLine> law;     // (pair) of lines; empty: strips
  int nodes_per_pair = kZoneNodes;
  std::vector<int> first_strip;                  // (pair + 1)
  Eigen::VectorXd gap;                           // (strip) m, of the teeth that meet in one mesh period
  std::array<Eigen::VectorXd, 2> strip_lever;    // (strip) m
  std::array<Eigen::VectorXd, 2> node_lever;     // (node) m
  std::array<Eigen::MatrixXd, 2> table_weights;  // (node, flank) 1: the S of load and reading
  double transverse =
      1;  // cos beta_b: of a force along the normal in the transverse section, where levers and normals are
  // Of a mesh in slices (system/face_mesh.h), each point of which is a line in `pairs`; null: one slice.
  std::shared_ptr<const FaceMesh> face;
  double next_corner_gap =
      std::numeric_limits<double>::infinity();  // m, least gap of a tip edge left out as too far
  double lost_corner_gap =
      std::numeric_limits<double>::infinity();  // m, least gap of one that has no flank to touch

  int strips() const { return static_cast<int>(gap.size()); }
  int nodes() const { return static_cast<int>(pairs.size()) * nodes_per_pair; }
  auto nodes_of(size_t pair) const {  // as rows of a matrix
    return Eigen::seqN(static_cast<Eigen::Index>(pair) * nodes_per_pair, nodes_per_pair);
  }
  // delta = G x (Eq. 16): (strip) m, of what the bodies move at the nodes.
  Eigen::VectorXd to_strips(const Eigen::Ref<const Eigen::VectorXd>& at_nodes) const;
  // f = E p (Eq. 14): (node) N, of the forces on the strips.
  Eigen::VectorXd to_nodes(const Eigen::Ref<const Eigen::VectorXd>& on_strips) const;
  // a += L C L^T, C (node, node), a (strip, strip).
  void add_to_strips(const Eigen::MatrixXd& at_nodes, Eigen::MatrixXd& a) const;
  // True if there is force at a candidate zone's end that is no tip edge: the candidate zone is too narrow.
  bool reaches_zone_end(const Eigen::Ref<const Eigen::VectorXd>& p) const;
};

// m: (strip) gaps of the teeth that meet in a mesh period; all else at a position is the same in every one.
Eigen::VectorXd flank_gaps(const GearMeshModel& model, const MeshPosition& position, int period);

// phase: within a mesh period, 0 to 1; period: which one, for teeth that differ.
MeshPosition make_position(const GearMeshModel& model, double phase, const CandidateZone& range,
                           int period = 0);

// The same with one contact line per pair. depth: m, of the Hertz laws. The tables are read at the middle of the
// pressure that pair_force (N) makes, which moves inwards from the touching point where contact ends at a tip edge; held
// there, whatever force the pair carries. So is the parabola that the law takes in place of flanks that deviate: the one
// that a contact under pair_force feels of what all teeth have in common. What sets teeth apart changes the gap where these
// touch, and nothing else: a slope s of one tooth leaves out R s^2 / 2, 4 nm for 10 micrometres over a flank of 7 mm.
MeshPosition make_line_position(const GearMeshModel& model, double phase, double corner_gap, double depth,
                                double pair_force, int period = 0);

// A contact line, or a piece of it as long as the half-planes `surface` are wide: its law, its gap, where the tables are read.
struct LinePoint {
  double gap = 0;    // m, along the flanks' normal
  double touch = 0;  // m: tangential coordinate of the touching point, of the edge if that touches
  HertzLine law;
  std::array<double, 2> roll{};  // rad
};
// depth, pair_force: of the piece, as make_line_position; cosine: of the base helix angle, by which the normal leaves the transverse section.
LinePoint make_line_point(const GearMeshModel& model, const PairContact& contact,
                          const std::array<HalfPlaneSurface, 2>& surface, double depth, double pair_force,
                          double cosine = 1);

// The pair_force of statics and dynamics under a mean `load` (N): where a contact comes to a tip edge, two pairs share it.
inline double shared_force(double load) {
  return 0.5 * load;
}

// p: (strip) N m-1. Throws ModelRangeError for force on the last strip before the end of the involute near a root, which no
// wider candidate zone moves.
void require_above_roots(const GearMeshModel& model, const MeshPosition& position,
                         const Eigen::Ref<const Eigen::VectorXd>& p);

// force: (pair) N. Throws Error(numerical) if a pair is beyond what Hertz's law holds for, or wider than its flanks face
// each other.
void require_line_range(const MeshPosition& position, const Eigen::Ref<const Eigen::VectorXd>& force);

// A_local of Eq. 17. (strip, strip) m N-1: half-planes of both gears, block diagonal; of lines 0, their laws are the
// half-planes.
Eigen::MatrixXd local_compliance(const GearMeshModel& model, const MeshPosition& position, double depth);

// (node, node) m N-1: tables[offset + max] (flank, flank) of gear g between all nodes.
Eigen::MatrixXd body_compliance(const MeshPosition& position, int g,
                                const std::vector<Eigen::MatrixXd>& tables);

// m N-1: ElasticGear::compliance for every tooth offset within a mesh, from the most negative on, as body_compliance takes them.
std::vector<Eigen::MatrixXd> compliance_tables(const ElasticGear& gear, double depth);

// (strip, strip) m N-1: half-planes and bodies, `tables` of both gears relative to `depth`; of lines without their laws.
Eigen::MatrixXd contact_compliance(const GearMeshModel& model, const MeshPosition& position,
                                   const std::array<std::vector<Eigen::MatrixXd>, 2>& tables, double depth);

// (node, node) m N-1: what cracks in the teeth of both gears add between all nodes in a mesh period; empty if no tooth near a
// cracked one is in reach.
Eigen::MatrixXd crack_compliance(const GearMeshModel& model, const MeshPosition& position, int period);

// Equilibrium of a contact with one rigid freedom x: d = A p + gap - approach x >= 0, p >= 0, p . d = 0,
// loading . p = load (Eq. 18, Eq. 19, Eq. 20); without friction loading = approach.
struct Equilibrium {
  double x = 0;          // m if approach is 1: the rigid freedom
  double stiffness = 0;  // d load / d x at this position, contact changes included
  Eigen::VectorXd p;     // (strip) N
  Certificate certificate;
  double residual = 0;  // |loading . p - load| / load
};

// A contact whose rigid freedom is held, so that its gaps are e (m): fills the forces p (N), start and result.
struct FixedContact {
  Certificate certificate;
  double stiffness = 0;  // d (loading . p) / d x
};
using ContactSolve = std::function<FixedContact(const Eigen::VectorXd& e, Eigen::VectorXd& p)>;

// load > 0. Newton on a monotone function between brackets, until the load is met to 1e-12. Where neighbouring doubles x
// already carry loads that differ by more (loads so small that the gaps are round-off), the nearest one is taken if it
// meets the load to 1e-10; `residual` says what was reached. Throws Error(numerical) with the residual otherwise.
Equilibrium equilibrium(const Eigen::VectorXd& gap, const Eigen::VectorXd& approach,
                        const Eigen::VectorXd& loading, double load, double start, const ContactSolve& solve);

// The same for d = A p + e.
Equilibrium equilibrium(const Eigen::MatrixXd& a, const Eigen::VectorXd& gap, const Eigen::VectorXd& approach,
                        double load, double start, ActiveSet& active, ComplementaritySolver& solver);

// The same for lines, d = C p + law(p) + e.
Equilibrium equilibrium(const Eigen::MatrixXd& c, std::span<const HertzLine> law, const Eigen::VectorXd& gap,
                        const Eigen::VectorXd& approach, double load, double start);

}  // namespace whine
