#include "io/artifacts.h"

#include <algorithm>
#include <functional>
#include <type_traits>

#include "base/error.h"
#include "io/artifact_file.h"
#include "io/static_source.h"
#include "io/system_motion_codec.h"
#include "results/width_tables.h"

namespace whine {
namespace {

using namespace ranges;
using Eigen::Index;

constexpr const char* kMeshPhases = "mesh_phase";
constexpr const char* kPhaseMesh = "mesh_phase mesh";
constexpr const char* kPhasePair = "mesh_phase mesh tooth_pair";
constexpr const char* kPhaseBody = "mesh_phase body";
constexpr const char* kMeshSide = "mesh side";
constexpr const char* kSideOf[] = {"driving", "driven"};

// Members of the meshes as datasets with an axis `mesh`, the arguments in the order of Codec's: numbers (mesh), vectors (axis, mesh) or
// (mesh, side), matrices (phase, mesh, tooth_pair). of: the member, or what gives a reference to it; one that is empty is written as zeros.
class OverMeshes {
 public:
  OverMeshes(Codec& c, SystemStaticResult& a)
      : c_(c), meshes_(a.mesh), count_(static_cast<Index>(a.mesh.size())) {}

  template <class Of>
  void operator()(const Of& of, const std::string& name, const std::string& units, const Range& range,
                  const std::string& axes, const std::string& meaning, const std::string& equation = "") {
    const Dataset d{name, units, meaning, axes, range, equation};
    using Value = std::decay_t<std::invoke_result_t<Of, StaticResult&>>;
    const auto at = [&](Index m) -> Value& { return std::invoke(of, meshes_[static_cast<size_t>(m)]); };
    if constexpr (std::is_same_v<Value, double>)
      numbers(d, at);
    else if constexpr (std::is_same_v<Value, MatrixRM>)
      matrices(d, at);
    else
      vectors(d, at);
  }

 private:
  void numbers(const Dataset& d, const auto& at) {
    Eigen::VectorXd values(count_);
    for (Index m = 0; m < count_; ++m) values[m] = at(m);
    c_.dataset(d, &values);
    for (Index m = 0; c_.in() && m < count_; ++m) at(m) = values[m];
  }
  void vectors(const Dataset& d, const auto& at) {
    const bool across = d.axes == kMeshSide;
    Index rows = 0;
    for (Index m = 0; m < count_; ++m) rows = std::max<Index>(rows, at(m).size());
    MatrixRM values = MatrixRM::Zero(rows, count_);
    for (Index m = 0; m < count_; ++m)
      if (at(m).size() > 0) values.col(m) = at(m);
    if (across) values = MatrixRM(values.transpose());
    c_.dataset(d, &values);
    if (!c_.in()) return;
    if (across) values = MatrixRM(values.transpose());
    for (Index m = 0; m < count_; ++m) at(m) = values.col(m);
  }
  void matrices(const Dataset& d, const auto& at) {
    Index rows = 0, columns = 0;
    for (Index m = 0; m < count_; ++m) {
      rows = std::max(rows, at(m).rows());
      columns = std::max(columns, at(m).cols());
    }
    std::vector<MatrixRM> values(static_cast<size_t>(rows), MatrixRM::Zero(count_, columns));
    for (Index m = 0; m < count_; ++m)
      for (Index i = 0; i < at(m).rows(); ++i) values[static_cast<size_t>(i)].row(m) = at(m).row(i);
    c_.dataset(d, &values);
    for (Index m = 0; c_.in() && m < count_ && !values.empty(); ++m) {
      at(m).resize(static_cast<Index>(values.size()), values[0].cols());
      for (size_t i = 0; i < values.size(); ++i) at(m).row(static_cast<Index>(i)) = values[i].row(m);
    }
  }

  Codec& c_;
  std::vector<StaticResult>& meshes_;
  Index count_;
};

template <class Has>
bool any_mesh(const SystemStaticResult& a, const Has& has) {
  return std::any_of(a.mesh.begin(), a.mesh.end(), has);
}

void describe_curves(Codec& c, SystemStaticResult& a) {
  OverMeshes over(c, a);
  c(a.mesh_phase, "/mesh_phase", "1", kPhase, kMeshPhases,
    "mesh phase, of trains of the first mesh; 0: reference pair at the pitch point, 1: one mesh period; up to the hunting period where teeth differ");
  over(&StaticResult::transmission_error, "/transmission_error", "m", kLength, kPhaseMesh,
       "transmission error along the line of action, positive when the driver is ahead",
       "r1 theta1 + r2 theta2");
  c(a.mesh_deflection, "/mesh_deflection", "m", kLength, kPhaseMesh,
    "the same without what bearings give way");
  over(&StaticResult::unloaded_error, "/unloaded_transmission_error", "m", kLength, kPhaseMesh,
       "transmission error without load: of what flanks deviate by");
  over(&StaticResult::stiffness_secant, "/mesh_stiffness_secant", "N m-1", kSpring, kPhaseMesh,
       "secant mesh stiffness, without the bearings; 0 where a mesh of a train carries no load",
       "(T / r1) / (mesh_deflection - unloaded_transmission_error)");
  over(
      &StaticResult::stiffness_tangent, "/mesh_stiffness_tangent", "N m-1", kSpring, kPhaseMesh,
      "tangent mesh stiffness at fixed phase, without the bearings; of a pair contact changes included, of trains that of frozen contact",
      "d(T / r1) / d mesh_deflection");
  if (c.optional("/mesh_stiffness", !a.mesh_stiffness.empty()))
    c(a.mesh_stiffness, "/mesh_stiffness", "N m-1", kSpring, "mesh_phase mesh other_mesh",
      "of trains: frozen stiffness between the approaches of the meshes, without bearings");
  over(&StaticResult::transmission_error_harmonic, "/transmission_error_harmonic", "m", kLength,
       "harmonic mesh", "mean, then amplitudes of the harmonics of the mesh frequency");
  over(&StaticResult::stiffness_harmonic, "/mesh_stiffness_harmonic", "N m-1", kSpring, "harmonic mesh",
       "mean, then amplitudes of the harmonics of the secant stiffness");
  c.numbers("harmonic", 0, "number of the harmonic of the mesh frequency; 0: the mean");
  describe_hunting(c, a.hunting_periods);
  const bool orders = any_mesh(a, [](const auto& s) { return s.transmission_error_order.size() > 0; });
  if (!c.optional("/transmission_error_order", orders)) return;
  over(&StaticResult::transmission_error_order, "/transmission_error_order", "m", kLength, "order mesh",
       "mean, then amplitudes of the harmonics of the hunting frequency");
  c.numbers("order", 0, "number of the harmonic of the hunting frequency; 0: the mean");
}

void describe_loads(Codec& c, SystemStaticResult& a) {
  OverMeshes over(c, a);
  over(&StaticResult::contact_ratio, "/contact_ratio", "1", {0, 100, true}, "mesh",
       "profile contact ratio of the unloaded gears");
  if (c.lists() || a.of_train())
    over(&StaticResult::torque, "/mesh_torque", "N m", kMoment, "mesh",
         "of trains: torque on the driving gear by the balance of rigid bodies; 0: no load");
  c(a.mesh_force, "/mesh_force", "N", kForce, kPhaseMesh,
    "sum of the loads of its tooth pairs along the flank normals");
  c(a.load_share, "/load_share", "1", {0, 1 + 1e-9}, kPhaseMesh,
    "share of the meshes that come from one [[mesh]]: of planets the load sharing; of a pair 1");
  Eigen::VectorXi pair = a.mesh.empty() ? Eigen::VectorXi() : a.mesh[0].pair;
  c(pair, "/tooth_pair", "1", kPair, "tooth_pair",
    "number of the tooth pair: -1 following, 0 reference, +1 preceding");
  for (StaticResult& mesh : a.mesh) mesh.pair = pair;
  over(&StaticResult::tooth_load, "/tooth_load", "N", kForce, kPhasePair, "normal force of each tooth pair");
  over(
      &StaticResult::contact_pressure, "/contact_pressure", "Pa", kPressure, kPhasePair,
      "largest contact pressure of each pair inside its flanks; 0 where nothing touches (tooth_load is 0) and where a tip edge does (tooth_load is not), whose pressure is singular");
  over(&StaticResult::contact_half_width, "/contact_half_width", "m", kSize, kPhasePair,
       "half width of each contact inside the flanks, twice the standard deviation of its pressure");
}

void describe_bodies(Codec& c, SystemStaticResult& a) {
  c(a.rotation, "/rotation", "m", kLength, kPhaseBody,
    "base radius times rotation in the body's sense; 0 of held bodies");
  c(a.translation, "/translation", "m", kLength, "mesh_phase body xy", "displacement of the hub");
  c(a.bearing_force, "/bearing_force", "N", kForce, "mesh_phase body xy",
    "force of a body on its bearing, of a planet on its pin, of a carrier on the ground; of a pair x, y: the driven gear stands above the driver, which turns counter-clockwise");
  c(a.torque, "/torque", "N m", kMoment, kPhaseBody,
    "torque of the drive, or of what holds the body, in its sense");
}

void describe_root_stress(Codec& c, SystemStaticResult& a) {
  OverMeshes over(c, a);
  const bool there = any_mesh(a, [](const auto& s) { return s.root_stress_max.size() > 0; });
  if (c.optional("/root_stress_max", there)) {
    for (size_t g = 0; g < kSides; ++g)
      over(
          [g](StaticResult & s) -> auto& { return s.root_stress[g]; }, text("/root_stress/", kSideOf[g]),
          "Pa", kStress, kPhasePair,
          "largest tangential stress along the root beside the loaded flank of each pair's tooth, tension positive, under the loads of this mesh; 0 of a mesh of which it is not known",
          "sum over the pairs of root_stress/per_force of body.h5, and of root_stress/crack, times force");
    over(&StaticResult::root_stress_max, "/root_stress_max", "Pa", kStress, kMeshSide,
         "largest root stress over the mesh cycle, beside the loaded flanks; 0: not known");
    over(&StaticResult::root_stress_angle, "/root_stress_angle", "1", kRoll, kMeshSide,
         "angle (rad) of the root's tangent there against the centre line of the tooth");
    over(&StaticResult::root_stress_phase, "/root_stress_phase", "1", kPlace, kMeshSide,
         "phase of the tooth's pair then, of its mesh, 0 at the pitch point");
    const bool teeth = any_mesh(a, [](const auto& s) { return s.root_stress_tooth.size() > 0; });
    if (c.optional("/root_stress_tooth", teeth)) {
      MatrixRMi tooth = MatrixRMi::Zero(static_cast<Index>(a.mesh.size()), kSides);
      for (Index m = 0; m < tooth.rows(); ++m)
        if (const auto& own = a.mesh[static_cast<size_t>(m)].root_stress_tooth; own.size() > 0)
          tooth.row(m) = own.transpose();
      c(tooth, "/root_stress_tooth", "1", kTooth, kMeshSide,
        "number of that tooth, counter-clockwise from tooth 0, where teeth differ or one is cracked");
      for (Index m = 0; c.in() && m < tooth.rows(); ++m)
        a.mesh[static_cast<size_t>(m)].root_stress_tooth = tooth.row(m).transpose();
    }
    for (StaticResult& mesh : a.mesh) {
      if (!c.in() || mesh.root_stress_max.maxCoeff() > 0) continue;
      mesh.root_stress = {};
      mesh.root_stress_max = mesh.root_stress_angle = mesh.root_stress_phase = {};
      mesh.root_stress_tooth = {};
    }
  }
  over(&StaticResult::loss_factor, "/loss_factor", "1", kPositive, "mesh",
       "mean power lost by sliding over the power carried, per unit coefficient of friction",
       "H_V = mean of sum F |sliding per angle| / T");
}

constexpr Range kLost{0, 1e7};  // N m

// Left out of flanks without friction.
void describe_static_friction(Codec& c, SystemStaticResult& a) {
  OverMeshes over(c, a);
  if (!c.optional("/friction_coefficient",
                  any_mesh(a, [](const auto& s) { return s.friction_loss.size() > 0; })))
    return;
  over(&StaticResult::friction_coefficient, "/friction_coefficient", "1", kShare, "mesh",
       "coefficient of friction");
  c(a.friction_coupling, "/certificate/friction_coupling", "m", kSize, "",
    "largest change of a gap by what friction of the last forces moves, over all positions",
    "iteration for d = (A + E) p + e, E of friction: E times the last change of p");
  over(&StaticResult::friction_loss, "/friction_loss", "N m", kLost, kPhaseMesh,
       "work that friction takes per angle (rad) of the driver", "sum of mu s F (t1 - t2 z1 / z2)");
  for (size_t g = 0; g < kSides; ++g)
    over(
        [g](StaticResult & s) -> auto& { return s.friction_moment[g]; },
        text("/friction_moment/", kSideOf[g]), "N m", kMoment, kPhaseMesh,
        "moment of friction about the axis of the gear, positive where it has the sense of the moment of the normal force, which brakes the driver and drives the driven gear",
        "sum of mu s F t");
  over(&StaticResult::efficiency, "/mesh_efficiency", "1", {-1e6, 1}, "mesh",
       "of the mesh at rest: work given by the driven gear over that put into the driver",
       "1 - mean friction_loss / torque");
  if (c.optional("/efficiency", a.efficiency.size() > 0))
    c(a.efficiency, "/efficiency", "1", {-1e6, 1}, "body",
      "of trains: power out over power in, from the mean torques, while this member is at rest; of a train without carriers the same for all, of planets 0");
}

// What follows from the curves.
void describe_compliance(Codec& c, SystemStaticResult& a) {
  OverMeshes over(c, a);
  over(&StaticResult::mean_stiffness, "/mean_stiffness", "N m-1", kStiff, "mesh",
       "mean of the secant stiffness over a mesh period");
  over(
      [](StaticResult & s) -> auto& { return s.compliance.whole; }, "/compliance/mesh", "m N-1", kFlexibility,
      "mesh", "of the mesh, mean over the period", "1 / mean_stiffness");
  over(
      [](StaticResult & s) -> auto& { return s.compliance.body; }, "/compliance/body", "m N-1", kFlexibility,
      kMeshSide, "part of it: twist of each gear's body between bore and root circle, all pairs together",
      "r_b^2 / (4 pi G b) (1 / r_bore^2 - 1 / r_root^2)");
  over(
      [](StaticResult & s) -> auto& { return s.compliance.wider_body; }, "/compliance/body_of_wider_bore",
      "m N-1", kFlexibility, kMeshSide, "the same with a bore a tenth larger, the root circle at most");
  over(
      [](StaticResult & s) -> auto& { return s.compliance.contact; }, "/compliance/contact", "m N-1",
      kFlexibility, "mesh", "part of it: Hertz's approach at the pitch point; what is left are the teeth");
  over(
      [](StaticResult & s) -> auto& { return s.compliance.single; }, "/single_pair_stiffness", "N m-1",
      kSpring, "mesh", "largest secant stiffness of a pair that carries all the load; 0: no pair ever does");
}

void describe_flank_pressure(Codec& c, SystemStaticResult& a) {
  OverMeshes over(c, a);
  over(
      [](StaticResult & s) -> auto& { return s.flank_pressure.smooth; }, "/flank_pressure_max", "Pa",
      kPressure, "mesh",
      "largest contact pressure inside the flanks and clear of ridges, where a relief begins; 0: there is none");
  if (!c.optional("/ridge/cause", any_mesh(a, [](const auto& s) { return !s.flank_pressure.ridge.empty(); })))
    return;
  std::vector<std::string> cause;
  cause.reserve(a.mesh.size());
  for (const StaticResult& mesh : a.mesh) cause.push_back(mesh.flank_pressure.ridge);
  c(cause, "/ridge/cause", "mesh",
    "what makes a ridge of the flank that contact runs over; pressure has no largest value there; empty: none");
  for (size_t m = 0; c.in() && m < a.mesh.size(); ++m) a.mesh[m].flank_pressure.ridge = cause[m];
  over(
      [](StaticResult & s) -> auto& { return s.flank_pressure.on_ridge; }, "/ridge/pressure_of_strips", "Pa",
      kPressure, "mesh", "what the strips show there");
  over(
      [](StaticResult & s) -> auto& { return s.flank_pressure.per_doubling; }, "/ridge/pressure_per_doubling",
      "Pa", kPressure, "mesh", "what that grows by with each doubling of the strips");
}

void describe_rectangular_wave(Codec& c, SystemStaticResult& a) {
  OverMeshes over(c, a);
  const std::string at = "/rectangular_wave/";
  over(
      [](StaticResult & s) -> auto& { return s.rectangular_wave.low; }, at + "low", "N m-1", kSpring, "mesh",
      "secant stiffness in the middle of the zone of fewer pairs in nominal contact");
  over(
      [](StaticResult & s) -> auto& { return s.rectangular_wave.high; }, at + "high", "N m-1", kSpring,
      "mesh", "the same where there is one pair more");
  over(
      [](StaticResult & s) -> auto& { return s.rectangular_wave.high_begin; }, at + "high_begin", "1",
      kSigned, "mesh",
      "phase of the mesh at which a pair comes without load, and the zone of more pairs begins");
  over(
      [](StaticResult & s) -> auto& { return s.rectangular_wave.high_end; }, at + "high_end", "1", kSigned,
      "mesh", "phase of the mesh at which that zone ends");
}

// Of pairs.
void describe_reference_contact(Codec& c, ReferenceContact& a) {
  const std::string at = "/reference_contact/";
  if (!c.optional(at + "border", a.border.size() > 0)) return;
  c(a.border, at + "border", "m", kLength, "strip_border",
    "of a pair: borders of the strips of the reference pair at mesh phase 0 along the flank, from the pitch point to the driver's tip");
  c(a.gap, at + "gap", "m", kLength, "strip", "gap of the unloaded flanks, mean over the strip");
  c(a.force, at + "force", "N", kForce, "strip", "normal force of each strip", "p of Eq. 18");
  c(a.separation, at + "separation", "m", kLength, "strip", "gap of the loaded flanks", "d of Eq. 18");
  c(a.approach, at + "approach", "m", kLength, "", "transmission error at this phase with strips");
}

// What of a mesh is [phase] (pair, place over the face), as [phase] (mesh, pair and place).
template <class Of>
void describe_over_face(Codec& c, SystemStaticResult& a, Of&& of, const Dataset& d) {
  const auto count = static_cast<Index>(a.mesh.size());
  std::vector<MatrixRM> values(a.mesh.empty() ? 0 : of(a.mesh[0]).size());
  for (size_t i = 0; i < values.size(); ++i) {
    values[i].resize(count, of(a.mesh[0])[i].size());
    for (Index m = 0; m < count; ++m)
      values[i].row(m) =
          of(a.mesh[static_cast<size_t>(m)])[i].template reshaped<Eigen::RowMajor>().transpose();
  }
  c.dataset(d, &values);
  for (Index m = 0; c.in() && m < count; ++m) {
    StaticResult& mesh = a.mesh[static_cast<size_t>(m)];
    std::vector<MatrixRM>& to = of(mesh);
    to.clear();
    for (const MatrixRM& from : values)
      to.emplace_back(from.row(m).reshaped<Eigen::RowMajor>(mesh.pair.size(), Eigen::AutoSize));
  }
}

// Of bodies in three dimensions.
void describe_face_roots(Codec& c, SystemStaticResult& all) {
  OverMeshes over(c, all);
  if (!c.optional("/face_load_factor_root",
                  !all.mesh.empty() && all.mesh[0].face.load_factor_root.size() > 0))
    return;
  for (size_t g = 0; g < kSides; ++g) {
    const std::string station = text(kSideOf[g], "_station");
    over(
        [g](StaticResult & s) -> auto& { return s.face.root_position[g]; },
        text("/face_root_position/", kSideOf[g]), "m", kLength, station + " mesh",
        "places over the face of a gear, from the middle of the common face as face_position");
    describe_over_face(
        c, all, [g](StaticResult & s) -> auto& { return s.face.root_stress[g]; },
        {text("/face_root_stress/", kSideOf[g]), "Pa",
         "largest stress across the helix along the root beside the loaded flank of each pair's tooth, over the face, tension positive",
         "mesh_phase mesh tooth_pair " + station, kStress, "sum of width/root_stress of body.h5 times load"});
  }
  over(
      [](StaticResult & s) -> auto& { return s.face.load_factor_root; }, "/face_load_factor_root", "1",
      kPositive, kMeshSide,
      "largest root stress over the face over its mean on the common face, of the tooth of root_stress_max",
      "K_Fbeta");
  over(
      [](StaticResult & s) -> auto& { return s.face.root_stress_error; }, "/root_stress_error", "Pa", kStress,
      kMeshSide,
      "what root_stress_max changes by with half as many points more and with polynomials of two degrees less");
}

// In slices over the face.
void describe_face(Codec& c, SystemStaticResult& all) {
  OverMeshes over(c, all);
  if (!c.optional("/line_load", !all.mesh.empty() && !all.mesh[0].face.none())) return;
  const char* const slices = "mesh_phase mesh tooth_pair slice";
  describe_over_face(
      c, all, [](StaticResult & s) -> auto& { return s.face.line_load; },
      {"/line_load", "N m-1",
       "normal force of each tooth pair per length of face, at the slices along its contact line", slices,
       kStiff});
  describe_over_face(
      c, all, [](StaticResult & s) -> auto& { return s.face.position; },
      {"/face_position", "m",
       "place of each slice along the axes, from the middle of the common face towards the viewer who sees the driver turn counter-clockwise",
       slices, kLength});
  describe_over_face(
      c, all, [](StaticResult & s) -> auto& { return s.face.width; },
      {"/slice_width", "m",
       "length of face that a slice stands for: weights of Gauss points on the contact line; 0: the pair does not touch",
       slices, kSize, "tooth_load = sum of line_load slice_width"});
  over(
      [](StaticResult & s) -> auto& { return s.face.contact_line_length; }, "/contact_line_length", "m",
      kSize, kPhaseMesh, "length of all contact lines of a mesh together", "L");
  const auto number = [&](double FaceLoad::*of, const char* name, const char* units, const Range& range,
                          const char* meaning, const char* equation = "") {
    over(
        [of](StaticResult & s) -> auto& { return s.face.*of; }, name, units, range, "mesh", meaning,
        equation);
  };
  number(&FaceLoad::overlap_ratio, "/overlap_ratio", "1", {0, 1000}, "overlap ratio",
         "b sin(beta) / (pi m_n)");
  number(&FaceLoad::axial_force, "/axial_force", "N", kForce,
         "axial force on the driver by the balance of rigid bodies, positive as face_position",
         "F_bt tan(beta_b), > 0 of a right-hand driver");
  number(&FaceLoad::load_factor, "/face_load_factor", "1", kPositive,
         "largest line load of the reference pair at mesh phase 0 over its mean, ends of the line included",
         "K_Hbeta = w_max / w_mean");
  number(
      &FaceLoad::load_factor_error, "/face_load_factor_error", "1", kPositive,
      "what face_load_factor changes by with half as many points more and, on bodies in three dimensions, with polynomials of two degrees less");
  describe_face_roots(c, all);
  int degree = all.mesh.empty() ? 0 : all.mesh[0].face.degree;
  c(degree, "/width_degree", "1", {0, kLargestDegree}, "",
    "degree of the polynomials over the face that bodies in three dimensions take part with; 0 of slices");
  for (StaticResult& mesh : all.mesh) mesh.face.degree = degree;
  number(
      &FaceLoad::least_eigenvalue, "/certificate/least_eigenvalue", "m2 N-1", kFlexibility,
      "least eigenvalue of local and body compliance between line loads over all phases: above 0, or loads have no single solution");
  number(&FaceLoad::line_load_max, "/line_load_max", "N m-1", kStiff,
         "largest line load of all phases within the inner 90 % of face and path of contact");
  number(&FaceLoad::half_width_max, "/half_width_max", "m", kSize, "half width of the widest contact there");
  c(all.axial_force, "/body_axial_force", "N", kForce, kPhaseBody,
    "axial force of a body on its bearing, of a planet on its pin, of a carrier on the ground, towards the viewer of the system, who sees the first body turn counter-clockwise",
    "sum of F_bt tan(beta_b)");
  c(all.tilting_moment, "/tilting_moment", "N m", kMoment, "mesh_phase body xy",
    "moment across its axis that a body gives to its bearing or pin, about the middle of its face: of axial forces at different places, and of loads beside the middle. Bodies do not tilt",
    "sum of r x F");
}

void describe_certificate(Codec& c, SystemStaticResult& a) {
  c(a.least_gap, "/certificate/least_gap", "m", kLength, "",
    "least gap of a strip without force, over all positions", "d >= 0 where p = 0 (with Eq. 18, 20)");
  c(a.least_force, "/certificate/least_force", "N", kForce, "",
    "least force of a strip in contact, over all positions", "p >= 0 where d = 0 (with Eq. 18, 20)");
  c(a.torque_residual, "/certificate/torque_residual", "1", kPositive, "",
    "largest unbalance of a free body's rotation over the largest mesh force, over all positions",
    "|L^T p - T / r|");
}

// What of each mesh stands in the file once, for all meshes or bodies.
void share_with_meshes(SystemStaticResult& a) {
  for (size_t m = 0; m < a.mesh.size(); ++m) {
    StaticResult& mesh = a.mesh[m];
    if (a.of_train()) static_cast<GearPairParameters&>(mesh) = mesh_parameters(a, m);
    mesh.mesh_phase = a.mesh_phase.array() + a.settings.layout.meshes[m].phase;
    mesh.hunting_periods = a.hunting_periods;
    mesh.least_gap = a.least_gap;
    mesh.least_force = a.least_force;
    mesh.torque_residual = a.torque_residual;
    mesh.friction_coupling = a.friction_coupling;
    mesh.backlash_margin = a.backlash_margin;
  }
  if (a.of_train()) return;
  a.mesh[0].remarks = a.remarks;
  for (size_t g = 0; g < kSides; ++g) {
    if (!a.mesh[0].mesh.bearing[g].elastic()) continue;
    a.mesh[0].bearing_force[g].resize(a.mesh_phase.size(), 2);
    for (Index i = 0; i < a.mesh_phase.size(); ++i)
      a.mesh[0].bearing_force[g].row(i) = a.bearing_force[static_cast<size_t>(i)].row(static_cast<Index>(g));
  }
}

void require_phases(const Codec& c, const SystemStaticResult& a) {
  if (a.mesh_phase.size() == 0) c.in()->reject("dataset /mesh_phase holds no phase");
  if (a.mesh_phase.size() % a.hunting_periods != 0)
    c.in()->reject(text("dataset /mesh_phase holds ", a.mesh_phase.size(),
                        " phases, not a multiple of /hunting_periods = ", a.hunting_periods));
  if (a.mesh[0].pair.size() == 0) c.in()->reject("dataset /tooth_pair holds no pair");
}

}  // namespace

void describe(Codec& c, SystemStaticResult& a) {
  describe_static_source(c, a);
  describe_curves(c, a);
  describe_loads(c, a);
  describe_bodies(c, a);
  describe_root_stress(c, a);
  describe_static_friction(c, a);
  describe_compliance(c, a);
  describe_flank_pressure(c, a);
  describe_rectangular_wave(c, a);
  if (!a.of_train()) {
    describe_reference_contact(c, a.mesh[0].reference_contact);
  }
  describe_face(c, a);
  describe_certificate(c, a);
  describe_backlash(c, a.backlash_margin);
  describe_remarks(c, a.remarks);
  if (!c.in()) return;
  require_phases(c, a);
  share_with_meshes(a);
}

std::string title(const SystemStaticResult& a) {
  if (a.of_train())
    return text("Static transmission error of a system: ", a.body_names.size(), " bodies, ",
                a.mesh_names.size(), " meshes");
  return "Static transmission error: " + pair_title(a.mesh[0].mesh, a.mesh[0].torque);
}

template struct ArtifactFile<SystemStaticResult>;

}  // namespace whine
