// Gears at rest over a mesh period, of a pair or of a train; where teeth differ, over the hunting period.
#pragma once
#include <Eigen/Core>
#include <array>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "model/stages.h"
#include "model/system_stages.h"
#include "results/remark.h"

namespace whine {

// What the compliance of the mesh, 1 / mean_stiffness, consists of (system/compliance_split.h). m N-1, along the line of action.
struct ComplianceSplit {
  double whole = 0, contact = 0;
  Eigen::Vector2d body = Eigen::Vector2d::Zero(),
                  wider_body = body;  // twist of each gear; with a bore a tenth larger
  double single = 0;  // N m-1: largest stiffness of a pair that carries all the load; 0: no pair ever does

  double bodies() const { return body[0] + body[1]; }
  double teeth() const { return whole - bodies() - contact; }  // the rest
  double body_share() const { return bodies() / whole; }
  // 1: relative change of the mean mesh stiffness if the bore of a gear were a tenth larger, by the twist alone
  double with_wider_bore(size_t gear) const {
    const auto g = static_cast<Eigen::Index>(gear);
    return whole / (whole - (body[g] - wider_body[g])) - 1;
  }
  // N m-1: `single` and the mean mesh stiffness if the bodies did not twist, as in ISO 6336
  double single_teeth() const { return single > 0 ? 1 / (1 / single - bodies()) : 0; }
  double mean_teeth() const { return 1 / (whole - bodies()); }
};

// The largest pressure that the result may state, and where there is none (system/flank_pressure.h).
struct FlankPressure {
  double smooth = 0;  // Pa: largest of all contacts inside the flanks and clear of ridges; 0: there is none
  double on_ridge =
      0;  // Pa: largest that strips show of contacts over a ridge; 0: there are none, or contact = "line"
  double per_doubling = 0;  // Pa: what the same grows by with each doubling of the strips
  std::string ridge;        // what makes the ridge, of which gear: "the linear tip relief of [gear.wheel]"
};

// The rectangular wave that approximates a mesh stiffness (system/rectangular_wave.h): one level per number of pairs in nominal
// contact.
struct RectangularWave {
  double low = 0, high = 0;             // N m-1
  double high_begin = 0, high_end = 0;  // phase; begin in [0, 1), end in (begin, begin + 1)

  double duty() const { return high_end - high_begin; }
  double mean() const { return low + (high - low) * duty(); }  // N m-1
  // N m-1, harmonic >= 1: 2 (high - low) |sin(pi n d)| / (pi n), d the duty
  double amplitude(int harmonic) const {
    const double n = std::numbers::pi * harmonic;
    return 2.0 * std::abs((high - low) * std::sin(n * duty())) / n;
  }
  double at(double phase) const {  // N m-1
    const double after = phase - high_begin;
    return after - std::floor(after) < duty() ? high : low;
  }
};

// Contact of the reference pair at mesh phase 0, cut into strips; nothing where the pair is out of reach there.
struct ReferenceContact {
  Eigen::VectorXd border;      // (strip + 1) m along the flank from the pitch point, to the driver's tip
  Eigen::VectorXd gap;         // (strip) m, unloaded
  Eigen::VectorXd force;       // (strip) N
  Eigen::VectorXd separation;  // (strip) m, of the loaded flanks (d of Eq. 18)
  double approach = 0;         // m: the transmission error
};

// Share of the face, and of the path of contact, in which largest line loads and root stresses are read.
inline constexpr double kClearOfCorners = 0.9;

// Load over the face of a mesh in slices along its contact lines (system/face_contact.h); empty of one slice. z: m, from the middle of the
// common face towards the viewer who sees the driver turn counter-clockwise.
struct FaceLoad {
  std::vector<MatrixRM> line_load;  // [phase] (pair, slice) N m-1: normal force per length of face
  std::vector<MatrixRM> position;   // [phase] (pair, slice) m: z
  std::vector<MatrixRM>
      width;  // [phase] (pair, slice) m: length of face that a slice stands for; 0: the pair does not touch
  Eigen::VectorXd contact_line_length;  // (phase) m: of all contact lines together
  double overlap_ratio = 0;
  double axial_force = 0;  // N, on the driver along z: F_t tan(beta_b) by the balance of rigid bodies
  double load_factor =
      0;  // K_Hbeta of the reference pair at phase 0: largest line load over the mean along its line
  double load_factor_error = 0;  // by half as many points more and, on bodies, two degrees less
  int degree = 0;  // of the polynomials over the face, on bodies in three dimensions; 0 of slices
  // m2 N-1: least eigenvalue of local and body compliance between line loads, of all phases; above 0
  double least_eigenvalue = 0;
  // Of bodies in three dimensions, else empty; z from the middle of the common face, over each gear's own. [gear] (station) m; [gear][phase]
  // (pair, station) Pa: largest stress across the helix along the root beside the loaded flank, tension positive.
  std::array<Eigen::VectorXd, 2> root_position;
  std::array<std::vector<MatrixRM>, 2> root_stress;
  // (gear) 1, K_Fbeta: largest over the face over the mean on the common face, of the tooth with the largest root stress. Pa: what that
  // stress changes by with half as many points more and with two degrees less.
  Eigen::VectorXd load_factor_root, root_stress_error;
  // Of all phases in the inner 90 % of face and path, N m-1 and m: largest line load, half-width of the widest contact.
  double line_load_max = 0, half_width_max = 0;

  bool none() const { return line_load.empty(); }
};

// One mesh at rest: of a pair its only one. Side 0 is the driving gear, side 1 the driven one.
struct StaticResult : GearPairParameters {
  double torque =
      0;  // N m on the driving gear, of a train the share of this mesh by the balance of rigid bodies; 0: no load
  double contact_ratio = 0;
  int hunting_periods =
      1;  // mesh periods after which the same teeth meet, as far as teeth differ; all are here
  Eigen::VectorXd mesh_phase;  // (phase) 1, 0 to hunting_periods; of a train plus the phase of the mesh
  Eigen::VectorXd transmission_error;  // (phase) m
  Eigen::VectorXd unloaded_error;      // (phase) m: the same without load, 0 for flanks as they are designed
  // (phase) N m-1, of the mesh without bearings; the secant is the load over what it adds to the transmission error; the
  // tangent of contact "line" is off by up to 0.6 % where contact comes near a tip edge; of a train it is that of frozen contact. 0
  // where the mesh carries no load
  Eigen::VectorXd stiffness_secant, stiffness_tangent;
  Eigen::VectorXi pair;  // (pair)
  MatrixRM tooth_load;   // (phase, pair) N
  // [gear] (phase, xy) N: what a gear of a pair presses its bearing with; empty for a rigid one and of trains. The driver's centre is at the
  // origin, the driven gear's above it, the driver turns counter-clockwise.
  std::array<MatrixRM, 2> bearing_force;
  // (phase, pair) Pa, m: of contacts that stay inside the flank, of helical gears in the inner 90 % of face and path; 0 elsewhere
  MatrixRM contact_pressure, contact_half_width;
  // [gear] (phase, pair) Pa: largest tangential stress along the root beside the loaded flank of each pair's tooth, tension
  // positive, under the loads of this mesh; of bodies in three dimensions across the helix, the largest over the face
  std::array<MatrixRM, 2> root_stress;
  Eigen::VectorXd root_stress_max;  // (gear) Pa: largest of these
  Eigen::VectorXd
      root_stress_angle;  // (gear) rad: of the root's tangent there against the centre line of the tooth
  Eigen::VectorXd root_stress_phase;  // (gear) 1: mesh phase of the loaded pair then, 0 at the pitch point
  Eigen::VectorXi
      root_stress_tooth;  // (gear): of which tooth, counter-clockwise from tooth 0; empty for teeth that are all alike
  double loss_factor = 0;           // H_V: mean power lost by sliding, over mu times the power carried
  double friction_coefficient = 0;  // 1; 0: no friction, and what follows is empty
  // (phase) N m: work that friction takes per angle of the driver; [gear] (phase) N m: moment of friction about its axis, positive
  // where it acts as the normal force does: against the rotation of the driver, with that of the driven gear
  Eigen::VectorXd friction_loss;
  std::array<Eigen::VectorXd, 2> friction_moment;
  double efficiency = 1;  // 1 - mean friction_loss / torque
  Eigen::VectorXd friction_work()
      const {  // (phase) J that friction takes in a mesh period with the forces of this phase
    return friction_loss * (2 * std::numbers::pi / gear[0].design.teeth);
  }
  Eigen::VectorXd transmission_error_harmonic;  // (harmonic 0..) m: mean, then amplitudes
  Eigen::VectorXd stiffness_harmonic;           // (harmonic 0..) N m-1, of the secant stiffness
  // (order 0..) m: mean, then amplitudes of the harmonics of the hunting frequency, up to those above; empty for teeth that
  // are all alike
  Eigen::VectorXd transmission_error_order;
  double mean_stiffness = 0;  // N m-1: mean over the period of the secant stiffness
  ComplianceSplit compliance;
  FlankPressure flank_pressure;
  RectangularWave rectangular_wave;
  ReferenceContact reference_contact;
  FaceLoad face;
  // certificate: worst over all positions
  double least_gap = 0;          // m, of strips without force
  double least_force = 0;        // N, of strips with force
  double torque_residual = 0;    // relative, |sum a p - T| / T
  double friction_coupling = 0;  // m, by how much gaps are off for what friction of the last forces moves
  double backlash_margin = 0;    // m left on the line of action; infinite backlash is not stored
  std::vector<Remark> remarks;
};

// static.h5: meshes, bodies and what they have in common. Frame of a train: that of the carriers, which do not turn in it. A pair has one
// mesh and the bodies driver and driven.
struct SystemStaticResult {
  // Inertias and masses of the layout of a train that the scene leaves out are those of the bodies.
  SystemStaticParameters settings;
  std::vector<BodyParameters> drawing;  // [gear] of settings.body
  bool of_train() const { return settings.layout.load == System::Load::drives; }
  std::vector<std::string> mesh_names, body_names;  // "sun-planet1"; bodies
  std::vector<StaticResult> mesh;

  int hunting_periods = 1;            // mesh periods after which the same teeth meet, as far as teeth differ
  Eigen::VectorXd mesh_phase;         // (phase) 1, of the first mesh: 0 to the hunting periods
  MatrixRM rotation;                  // (phase, body) m: r theta in the body's own sense; 0 of held ones
  std::vector<MatrixRM> translation;  // [phase] (body, xy) m, of its hub
  MatrixRM mesh_deflection;  // (phase, mesh) m: the transmission error without what bearings give way
  MatrixRM mesh_force;       // (phase, mesh) N: sum of the tooth loads
  MatrixRM load_share;       // (phase, mesh) 1: of the meshes of one [[mesh]]
  std::vector<MatrixRM> bearing_force;  // [phase] (body, xy) N: what a body presses its bearing or pin with
  MatrixRM torque;  // (phase, body) N m in the body's own sense: drives, and what holds a body
  // In slices over the face (system/axial_loads.h), else empty: (phase, body) N along z, [phase] (body, xy) N m.
  MatrixRM axial_force;
  std::vector<MatrixRM> tilting_moment;
  // [phase] (mesh, mesh) N m-1, see SystemStatics::mesh_stiffness(); of trains
  std::vector<MatrixRM> mesh_stiffness;
  // Certificate: worst over all positions, m, N and 1
  double least_gap = 0, least_force = 0, torque_residual = 0, friction_coupling = 0;
  double backlash_margin = std::numeric_limits<double>::infinity();  // m: least of the meshes that have some
  // Of trains whose flanks have friction, else none: (body) 1: power out over power in while the body is at rest, 0 of planets; of
  // trains without a carrier all are that of the train
  Eigen::VectorXd efficiency;
  std::vector<Remark> remarks;

  // Settings and drawings of a pair, of which the mesh says all but the layout.
  void take_pair(System layout) {
    const StaticResult& own = mesh[0];
    const auto& [driver, driven] = own.mesh.gear;
    settings = {std::move(layout),
                {driver, driven},
                {own.mesh},
                {0},
                own.fidelity,
                own.contact,
                {{driver, ""}, {driven, ""}},
                {own.mesh.errors[0], own.mesh.errors[1]}};
    drawing = {own.gear[0], own.gear[1]};
  }
};

// N m: that on the driver of a pair; of a train the largest on its drives that are not held, to 1e-6.
double torque_of(const SystemStaticResult& rest);

// Of the gear that a body of a train is; nullptr: of a carrier.
inline const BodyParameters* drawing_of(const SystemStaticResult& a, int body) {
  const std::string& gear = a.settings.gear[static_cast<size_t>(body)];
  for (size_t g = 0; g < a.settings.body.size() && g < a.drawing.size(); ++g)
    if (a.settings.body[g].first == gear) return &a.drawing[g];
  return nullptr;
}

// [body] nullptr: of a carrier.
inline std::vector<const GearDesign*> designs_of(const SystemStaticResult& a) {
  std::vector<const GearDesign*> out;
  out.reserve(a.settings.layout.bodies.size());
  for (size_t b = 0; b < a.settings.layout.bodies.size(); ++b) {
    const BodyParameters* drawing = drawing_of(a, static_cast<int>(b));
    out.push_back(drawing ? &drawing->design : nullptr);
  }
  return out;
}

// What mesh m of a train was computed from, as that of a pair: drawings, [[mesh]], errors of its teeth, centre distance in the layout.
inline GearPairParameters mesh_parameters(const SystemStaticResult& a, size_t m) {
  const SystemStaticParameters& s = a.settings;
  const System::Mesh& mesh = s.layout.meshes[m];
  GearPairParameters out{{}, s.mesh[static_cast<size_t>(s.section[m])], s.fidelity, s.contact};
  out.mesh.centre_distance = mesh.centre_distance;
  for (size_t g = 0; g < kSides; ++g) {
    const int body = mesh.side[g].body;
    if (const BodyParameters* drawing = drawing_of(a, body)) out.gear[g] = *drawing;
    if (s.has_errors(static_cast<size_t>(body))) out.mesh.errors[g] = s.errors[static_cast<size_t>(body)];
  }
  return out;
}

}  // namespace whine
