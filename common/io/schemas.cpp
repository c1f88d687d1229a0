#include "io/schemas.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <sstream>

#include "base/error.h"
#include "io/artifact.h"
#include "io/study.h"
#include "io/vtk.h"

namespace whine {
namespace {

// Raise a number whenever a dataset of that schema changes its name, shape or meaning.
constexpr int kMeshVersion = 1, kBodyVersion = 3, kStaticVersion = 4, kErrorBudgetVersion = 2,
              kImpactVersion = 1, kSweepVersion = 4, kResponseVersion = 3, kJumpMapVersion = 1,
              kBranchVersion = 1, kHarrisMapVersion = 1, kVariantVersion = 2, kStudyVersion = 2,
              kLoadedVersion = 1;

const char* const kPhase = "mesh_phase";
const char* const kSpeed = "mesh_frequency";
const char* const kSample = "mesh_frequency sample";

KeyValues with(const GearDesign& design) {
  KeyValues values;
  values.design = design;
  return values;
}

// Gears without a crack have no such section.
void put_crack(ArtifactWriter& out, const std::string& section, const GearDesign& design) {
  if (design.crack.depth > 0) out.parameters(section + "_crack", with(design), Part::crack);
}

void take_crack(const ArtifactReader& in, const std::string& section, GearDesign& design) {
  if (!in.file().has("/parameters/" + section + "_crack/depth")) return;
  KeyValues values = with(design);
  in.parameters(section + "_crack", values, Part::crack);
  design = values.design;
}

void put_design(ArtifactWriter& out, const std::string& section, const GearDesign& design) {
  out.parameters(section, with(design), Part::design);
  put_crack(out, section, design);
}

GearDesign take_design(const ArtifactReader& in, const std::string& section) {
  KeyValues values;
  in.parameters(section, values, Part::design);
  take_crack(in, section, values.design);
  return values.design;
}

void put_body_discretisation(ArtifactWriter& out, const BodyDiscretisation& body) {
  KeyValues values;
  values.body = body;
  out.parameters("discretisation", values, Part::body);
}

BodyDiscretisation take_body_discretisation(const ArtifactReader& in) {
  KeyValues values;
  in.parameters("discretisation", values, Part::body);
  return values.body;
}

// One gear of a pair: geometry, material and the discretisation of its body, under its role.
void put_gear(ArtifactWriter& out, const std::string& role, const GearDesign& design,
              const Material& material, const BodyDiscretisation& body) {
  KeyValues values;
  values.design = design;
  values.material = material;
  values.body = body;
  for (const Part part : {Part::design, Part::material, Part::body, Part::near_field})
    out.parameters(role, values, part);
  put_crack(out, role, design);
}

void take_gear(const ArtifactReader& in, const std::string& role, GearDesign& design, Material& material,
               BodyDiscretisation& body) {
  KeyValues values;
  for (const Part part : {Part::design, Part::material, Part::body, Part::near_field})
    in.parameters(role, values, part);
  take_crack(in, role, values.design);
  design = values.design;
  material = values.material;
  body = values.body;
}

// The same names in the three artifacts of a pair.
template <class Artifact>
void put_pair(ArtifactWriter& out, const Artifact& a) {
  put_gear(out, "driver", a.driver, a.driver_material, a.driver_body);
  put_gear(out, "driven", a.driven, a.driven_material, a.driven_body);
}

template <class Artifact>
void take_pair(const ArtifactReader& in, Artifact& a) {
  take_gear(in, "driver", a.driver, a.driver_material, a.driver_body);
  take_gear(in, "driven", a.driven, a.driven_material, a.driven_body);
}

// What an artifact of a pair says of mesh, fidelity, accuracy and damping, as keys; of a pair at rest there is less of it.
template <class Artifact>
KeyValues settings_of(const Artifact& a) {
  KeyValues values;
  values.mesh = a.mesh;
  values.contact = a.contact;
  if constexpr (requires { a.fidelity; }) values.fidelity = a.fidelity;
  if constexpr (requires { a.time.steps_per_period; }) values.time = a.time;
  if constexpr (requires { a.damping; }) values.damping = a.damping;
  return values;
}

template <class Artifact>
void take_settings(const KeyValues& values, Artifact& a) {
  a.mesh = values.mesh;
  a.contact = values.contact;
  if constexpr (requires { a.fidelity; }) a.fidelity = values.fidelity;
  if constexpr (requires { a.time.steps_per_period; }) a.time = values.time;
  if constexpr (requires { a.damping; }) a.damping = values.damping;
}

void put_inertia(ArtifactWriter& out, const std::string& role, double inertia) {
  KeyValues values;
  values.total_inertia = inertia;
  out.parameters(role, values, Part::inertia);
}

double take_inertia(const ArtifactReader& in, const std::string& role) {
  KeyValues values;
  in.parameters(role, values, Part::inertia);
  return values.total_inertia;
}

template <class Artifact>
void put_speeds(ArtifactWriter& out, const Artifact& a) {
  for (const auto& [name, value] : {std::pair{"from", a.frequency_from}, std::pair{"to", a.frequency_to},
                                    std::pair{"step", a.frequency_step}})
    out.put(text("/parameters/operation/mesh_frequency_", name), value,
            {"Hz", "speeds of the sweeps", "", ""});
}

template <class Artifact>
void take_speeds(const ArtifactReader& in, Artifact& a) {
  a.frequency_from = in.number("/parameters/operation/mesh_frequency_from");
  a.frequency_to = in.number("/parameters/operation/mesh_frequency_to");
  a.frequency_step = in.number("/parameters/operation/mesh_frequency_step");
}

// Bearing dampers and what sets them.
template <class Artifact>
void put_bearings(ArtifactWriter& out, const Artifact& a) {
  out.put("/parameters/damping/mean_stiffness", a.mean_stiffness,
          {"N m-1", "mean secant stiffness that sets the bearing dampers", "", ""});
  out.put("/parameters/damping/driver_bearing_damper", a.driver_bearing_damper,
          {"N m s", "torque damper at the axis of the driver", "", "c = 2 ratio I w"});
  out.put("/parameters/damping/driven_bearing_damper", a.driven_bearing_damper,
          {"N m s", "torque damper at the axis of the driven gear", "", "c = 2 ratio I w"});
}

template <class Artifact>
void take_bearings(const ArtifactReader& in, Artifact& a) {
  a.mean_stiffness = in.number("/parameters/damping/mean_stiffness");
  a.driver_bearing_damper = in.number("/parameters/damping/driver_bearing_damper");
  a.driven_bearing_damper = in.number("/parameters/damping/driven_bearing_damper");
}

// Of the gear that stands there, in groups by its name.
std::string of_body(const GearMeshSpec& mesh, int g, const char* dataset) {
  return "/body/" + mesh.gear(g) + "/" + dataset;
}

constexpr const char* kBearingForce =
    "force of the gear on its bearing; x, y: the driven gear stands above the driver, which turns "
    "counter-clockwise";

// Left out where back flanks are ignored: the margin is then infinite.
void put_backlash(ArtifactWriter& out, double margin) {
  if (std::isinf(margin)) return;
  out.put("/backlash_margin", margin, {"m", "least backlash left along the line of action", "", ""});
}

// Teeth that are all alike have no such entry.
void put_hunting(ArtifactWriter& out, int periods) {
  if (periods > 1)
    out.put("/hunting_periods", periods,
            {"1", "mesh periods of a hunting period, after which the same teeth meet, as far as teeth differ",
             "", ""});
}

int take_hunting(const ArtifactReader& in) {
  return in.file().has("/hunting_periods") ? in.whole("/hunting_periods") : 1;
}

void put_natural_frequency(ArtifactWriter& out, double frequency) {
  out.put("/natural_frequency", frequency,
          {"Hz", "natural frequency: mean over the period with the contact frozen under the static load", "",
           ""});
}

double take_backlash(const ArtifactReader& in) {
  return in.file().has("/backlash_margin") ? in.number("/backlash_margin")
                                           : std::numeric_limits<double>::infinity();
}

std::string gear_title(const GearDesign& design) {
  return text(design.teeth, " teeth, module ", design.module * 1e3, " mm");
}

std::string pair_title(const GearMeshSpec& mesh, double torque) {
  return text(mesh.driver, " drives ", mesh.driven, " with ", torque, " N m");
}

void want_rows(const char* name, Eigen::Index rows, Eigen::Index wanted) {
  if (rows != wanted) fail(Failure::numerical, "result ", name, " has ", rows, " rows, expected ", wanted);
}

// Left out of finite element sweeps, which have no such part.
void put_lumped(ArtifactWriter& out, const std::string& model, const LumpedParameters& a) {
  want_rows("lumped stiffness", a.stiffness.rows(), a.cell_end.size());
  want_rows("lumped gap", a.gap.rows(), a.cell_end.size());
  want_rows("lumped gap (columns)", a.gap.cols(), a.stiffness.cols());
  const std::string at = "/parameters/lumped/";
  out.put("/parameters/fidelity/model", model, {"1", "name of the lumped model", "", ""});
  out.put(at + "mass", a.mass, {"kg", "mass of the one degree of freedom", "", "m of Eq. 23"});
  out.put(at + "damping_ratio", a.damping_ratio,
          {"1", "damping ratio about the mean stiffness", "", "c / (2 sqrt(mean_stiffness m))"});
  out.put(at + "damper", a.damper, {"N s m-1", "viscous damper at the mesh", "", "c of Eq. 23"});
  out.put(at + "damper_acts", a.damper_acts, {"1", "always (Eq. 23), or in contact only", "", ""});
  out.put(at + "cell_end", a.cell_end,
          {"1", "mesh phase at which a cell of constant springs ends", "cell", ""});
  out.put(at + "stiffness", a.stiffness,
          {"N m-1", "stiffness of the springs", "cell spring", "k(t) of Eq. 23"});
  out.put(at + "gap", a.gap, {"m", "transmission error at which a spring touches", "cell spring", ""});
}

void take_lumped(const ArtifactReader& in, SweepArtifact& a) {
  if (!in.file().has("/parameters/fidelity/model")) return;
  const std::string at = "/parameters/lumped/";
  a.model = in.word("/parameters/fidelity/model");
  a.lumped.mass = in.number(at + "mass");
  a.lumped.damping_ratio = in.number(at + "damping_ratio");
  a.lumped.damper = in.number(at + "damper");
  a.lumped.damper_acts = in.word(at + "damper_acts");
  a.lumped.cell_end = in.vector(at + "cell_end");
  a.lumped.stiffness = in.matrix(at + "stiffness", a.lumped.cell_end.size());
  a.lumped.gap = in.matrix(at + "gap", a.lumped.cell_end.size(), a.lumped.stiffness.cols());
}

// Node and mode numbers come from a file here, and index arrays later: they are checked once, on reading.
void want_indices(const ArtifactReader& in, const std::string& name, const Eigen::Ref<const MatrixRMi>& index,
                  Eigen::Index count) {
  if (index.size() == 0) return;
  if (index.minCoeff() < 0 || index.maxCoeff() >= count) {
    in.file().refuse(text("dataset ", name, " holds the number ",
                          index.minCoeff() < 0 ? index.minCoeff() : index.maxCoeff(), ", allowed are 0 to ",
                          count - 1));
  }
}

void put_sector(ArtifactWriter& out, const std::string& group, const MeshArtifact& a) {
  out.put(group + "/node_position", a.node_position,
          {"m", "position of the nodes; gear centre at 0, tooth along +y", "node xy", ""});
  out.put(group + "/element_node", a.element_node,
          {"1", "nodes of the elements: corners counter-clockwise, mid-sides, centre", "element corner", ""});
  out.put(group + "/element_region", a.element_region,
          {"1", "0: rim, 1: tooth, where the half-plane field is subtracted", "element", ""});
  out.put(group + "/bore_node", a.bore_node, {"1", "nodes on the rigid hub", "bore_node", ""});
  out.put(
      group + "/side_node", a.side_node,
      {"1", "node on the clockwise edge and its image on the counter-clockwise edge", "side_node edge", ""});
  out.put(group + "/flank_node", a.flank_node,
          {"1", "nodes of the driving flank, root to tip", "flank_node", ""});
  out.put(group + "/flank_roll_angle", a.flank_roll_angle,
          {"rad", "involute roll angle of the flank nodes", "flank_node", ""});
}

void take_sector(const ArtifactReader& in, const std::string& group, MeshArtifact& a) {
  a.node_position = in.matrix(group + "/node_position", -1, 2);
  const Eigen::Index nodes = a.node_position.rows();
  a.element_node = in.whole_matrix(group + "/element_node");
  a.element_region = in.whole_vector(group + "/element_region", a.element_node.rows());
  a.bore_node = in.whole_vector(group + "/bore_node");
  a.side_node = in.whole_matrix(group + "/side_node", -1, 2);
  a.flank_node = in.whole_vector(group + "/flank_node");
  a.flank_roll_angle = in.vector(group + "/flank_roll_angle", a.flank_node.size());
  want_indices(in, group + "/element_node", a.element_node, nodes);
  want_indices(in, group + "/bore_node", a.bore_node.transpose(), nodes);
  want_indices(in, group + "/side_node", a.side_node, nodes);
  want_indices(in, group + "/flank_node", a.flank_node.transpose(), nodes);
}

}  // namespace

void write(const std::string& path, const MeshArtifact& a, const Provenance& provenance) {
  ArtifactWriter out(path, "mesh", kMeshVersion,
                     "Finite-element mesh of one tooth sector: " + gear_title(a.design), provenance);
  put_design(out, "gear", a.design);
  put_body_discretisation(out, a.discretisation);
  put_sector(out, "/sector", a);
  for (const MeshArtifact& cracked : a.cracked_tooth) {
    put_sector(out, "/cracked_tooth", cracked);
    out.put("/cracked_tooth/slit_node", cracked.slit_node,
            {"1", "the same point on the two faces of the slit, mouth to tip; the tip itself is one node",
             "slit_node face", ""});
  }
  put_vtk(out.file(), whole_gear(a));
  out.publish();
  link_for_paraview(path);
}

MeshArtifact read_mesh(const std::string& path) {
  const ArtifactReader in(path, "mesh", kMeshVersion);
  MeshArtifact a;
  a.design = take_design(in, "gear");
  a.discretisation = take_body_discretisation(in);
  take_sector(in, "/sector", a);
  if (in.file().has("/cracked_tooth/slit_node")) {
    MeshArtifact& cracked = a.cracked_tooth.emplace_back();
    cracked.design = a.design;
    cracked.discretisation = a.discretisation;
    take_sector(in, "/cracked_tooth", cracked);
    cracked.slit_node = in.whole_matrix("/cracked_tooth/slit_node", -1, 2);
    want_indices(in, "/cracked_tooth/slit_node", cracked.slit_node, cracked.node_position.rows());
  }
  return a;
}

void write(const std::string& path, const BodyArtifact& a, const Provenance& provenance) {
  const Eigen::Index modes = a.eigenfrequency.size(), points = a.flank_position.size();
  want_rows("nodal_diameter", a.nodal_diameter.size(), modes);
  want_rows("component", a.component.size(), modes);
  want_rows("inertia_coupling", a.inertia_coupling.size(), modes);
  want_rows("translation_coupling", a.translation_coupling.rows(), modes);
  want_rows("flank_mode", a.flank_mode.rows(), points);
  want_rows("compliance", static_cast<Eigen::Index>(a.compliance.size()), a.offsets + 1);
  ArtifactWriter out(path, "body", kBodyVersion,
                     "Reduced body of a gear on a rigid hub: " + gear_title(a.design), provenance);
  KeyValues values;
  values.material = a.material;
  values.body = a.discretisation;
  put_design(out, "gear", a.design);
  out.parameters("material", values, Part::material);
  for (const Part part : {Part::body, Part::near_field}) out.parameters("discretisation", values, part);
  out.put("/inertia", a.inertia,
          {"kg m2", "inertia of the meshed body about its axis, hub ring included", "", ""});
  out.put("/mass", a.mass, {"kg", "mass of the meshed body, hub ring included", "", ""});
  out.put("/eigenfrequency", a.eigenfrequency,
          {"Hz", "natural frequencies with the hub fixed", "mode", "K_ff phi = w^2 M_ff phi"});
  out.put("/nodal_diameter", a.nodal_diameter, {"1", "nodal diameters of the mode", "mode", ""});
  out.put("/component", a.component, {"1", "0: cosine or single, 1: sine of a doublet", "mode", ""});
  // UDUNITS knows whole exponents only; mass-normal modes need a half.
  out.put(
      "/inertia_coupling", a.inertia_coupling,
      {"kg^0.5 m", "coupling of the mode to the rotation of the hub", "mode", "gamma = phi^T M_fr (Eq. 3)"});
  out.put("/translation_coupling", a.translation_coupling,
          {"kg^0.5", "coupling of the mode to translations of the hub along x and y; tooth 0 points along +y",
           "mode xy", "phi^T M_fr (Eq. 3)"});
  out.put("/flank_position", a.flank_position,
          {"1", "roll angle (rad) of the points of the flank table, ascending", "flank_position", ""});
  out.put("/flank_mode", a.flank_mode,
          {"kg^-0.5", "outward normal displacement of the mass-normal modes on the flank of tooth 0",
           "flank_position mode", ""});
  for (std::size_t d = 0; d < a.compliance.size(); ++d) {
    want_rows("compliance", a.compliance[d].rows(), points);
    want_rows("compliance (columns)", a.compliance[d].cols(), points);
    out.put(text("/compliance/offset_", d), a.compliance[d],
            {"m N-1",
             text("inward normal displacement of the tooth ", d,
                  " counter-clockwise of the loaded one per unit normal force",
                  d == 0 ? ", less the half-plane relative to reference_depth" : ""),
             "flank_position flank_position", ""});
  }
  if (a.crack_compliance.size() > 0) {
    want_rows("crack_compliance", a.crack_compliance.rows(), (2 * a.offsets + 1) * points);
    want_rows("crack_compliance (columns)", a.crack_compliance.cols(), (2 * a.offsets + 1) * points);
    out.put("/compliance/crack", a.crack_compliance,
            {"m N-1",
             "what the crack adds between the teeth from `offsets` clockwise of the cracked one to `offsets` "
             "counter-clockwise of it, tooth by tooth",
             "tooth_flank_position tooth_flank_position", ""});
  }
  out.put("/compliance/offsets", a.offsets, {"1", "largest tooth offset of the tables", "", ""});
  out.put("/compliance/reference_depth", a.reference_depth,
          {"m", "depth relative to which the half-plane is taken off", "", ""});
  out.put("/compliance/asymmetry", a.asymmetry,
          {"1", "relative asymmetry of the tables before symmetrisation", "", ""});
  out.put("/compliance/least_eigenvalue", a.least_eigenvalue,
          {"m N-1", "least eigenvalue of the compliance of all offsets less the stored modes", "", ""});
  if (a.vtk_point.rows() > 0)
    put_vtk(out.file(), {a.vtk_point, a.vtk_cell, a.vtk_point_data, {}, {}, {}, {}, false});
  out.publish();
  link_for_paraview(path);
}

BodyArtifact read_body(const std::string& path) {
  const ArtifactReader in(path, "body", kBodyVersion);
  BodyArtifact a;
  KeyValues values;
  in.parameters("material", values, Part::material);
  for (const Part part : {Part::body, Part::near_field}) in.parameters("discretisation", values, part);
  a.design = take_design(in, "gear");
  a.material = values.material;
  a.discretisation = values.body;
  a.inertia = in.number("/inertia");
  a.mass = in.number("/mass");
  a.eigenfrequency = in.vector("/eigenfrequency");
  const Eigen::Index modes = a.eigenfrequency.size();
  a.nodal_diameter = in.whole_vector("/nodal_diameter", modes);
  a.component = in.whole_vector("/component", modes);
  a.inertia_coupling = in.vector("/inertia_coupling", modes);
  a.translation_coupling = in.matrix("/translation_coupling", modes, 2);
  a.flank_position = in.vector("/flank_position");
  const Eigen::Index points = a.flank_position.size();
  a.flank_mode = in.matrix("/flank_mode", points, modes);
  a.offsets = in.whole("/compliance/offsets");
  for (int d = 0; d <= a.offsets; ++d)
    a.compliance.push_back(in.matrix(text("/compliance/offset_", d), points, points));
  if (a.design.crack.depth > 0)
    a.crack_compliance =
        in.matrix("/compliance/crack", (2 * a.offsets + 1) * points, (2 * a.offsets + 1) * points);
  a.reference_depth = in.number("/compliance/reference_depth");
  a.asymmetry = in.number("/compliance/asymmetry");
  a.least_eigenvalue = in.number("/compliance/least_eigenvalue");
  return a;
}

void write(const std::string& path, const StaticArtifact& a, const Provenance& provenance) {
  const Eigen::Index phases = a.mesh_phase.size();
  want_rows("transmission_error", a.transmission_error.size(), phases);
  want_rows("unloaded_transmission_error", a.unloaded_error.size(), phases);
  want_rows("mesh_stiffness_secant", a.stiffness_secant.size(), phases);
  want_rows("mesh_stiffness_tangent", a.stiffness_tangent.size(), phases);
  want_rows("tooth_load", a.tooth_load.rows(), phases);
  want_rows("tooth_load (columns)", a.tooth_load.cols(), a.pair.size());
  ArtifactWriter out(path, "static", kStaticVersion,
                     "Static transmission error: " + pair_title(a.mesh, a.torque), provenance);
  const KeyValues values = settings_of(a);
  put_pair(out, a);
  out.parameters("mesh", values, Part::mesh);
  out.parameters("fidelity", values, Part::contact_rung);
  out.parameters("discretisation", values, Part::contact);
  out.put("/parameters/operation/torque", a.torque, {"N m", "torque on the driver", "", ""});
  out.put("/contact_ratio", a.contact_ratio, {"1", "profile contact ratio of the unloaded gears", "", ""});
  out.put("/mesh_phase", a.mesh_phase,
          {"1", "mesh phase; 0: reference pair at the pitch point, 1: one mesh period", kPhase, ""});
  out.put("/transmission_error", a.transmission_error,
          {"m", "transmission error along the line of action, positive when the driver is ahead", kPhase,
           "r1 theta1 + r2 theta2"});
  out.put("/unloaded_transmission_error", a.unloaded_error,
          {"m", "transmission error without load: of what flanks deviate by", kPhase, ""});
  out.put("/mesh_stiffness_secant", a.stiffness_secant,
          {"N m-1", text("secant mesh stiffness", a.mesh.on_bearings() ? ", without the bearings" : ""),
           kPhase, "(T / r1) / (transmission_error - unloaded_transmission_error)"});
  out.put("/mesh_stiffness_tangent", a.stiffness_tangent,
          {"N m-1",
           text("tangent mesh stiffness at fixed phase, contact changes included",
                a.mesh.on_bearings() ? ", without the bearings" : ""),
           kPhase, "d(T / r1) / d transmission_error"});
  out.put("/pair", a.pair,
          {"1", "number of the tooth pair: -1 following, 0 reference, +1 preceding", "pair", ""});
  out.put("/tooth_load", a.tooth_load, {"N", "normal force of each tooth pair", "mesh_phase pair", ""});
  for (int g = 0; g < 2; ++g)
    if (a.mesh.bearing[g].elastic()) {
      want_rows("bearing_force", a.bearing_force[g].rows(), phases);
      out.put(of_body(a.mesh, g, "bearing_force"), a.bearing_force[g],
              {"N", kBearingForce, "mesh_phase xy", ""});
    }
  out.put(
      "/contact_pressure", a.contact_pressure,
      {"Pa", "largest contact pressure of each pair inside its flanks; 0 where a corner or nothing touches",
       "mesh_phase pair", ""});
  out.put("/contact_half_width", a.contact_half_width,
          {"m", "half width of each contact inside the flanks, twice the standard deviation of its pressure",
           "mesh_phase pair", ""});
  out.put("/transmission_error_harmonic", a.transmission_error_harmonic,
          {"m", "mean, then amplitudes of the harmonics of the mesh frequency", "harmonic", ""});
  out.put("/mesh_stiffness_harmonic", a.stiffness_harmonic,
          {"N m-1", "mean, then amplitudes of the harmonics of the secant stiffness", "harmonic", ""});
  put_hunting(out, a.hunting_periods);
  if (a.transmission_error_order.size() > 0)
    out.put("/transmission_error_order", a.transmission_error_order,
            {"m", "mean, then amplitudes of the harmonics of the hunting frequency", "order", ""});
  out.put("/mean_stiffness", a.mean_stiffness,
          {"N m-1", "mean of the secant stiffness over a mesh period", "", ""});
  out.put("/certificate/least_gap", a.least_gap,
          {"m", "least gap of a strip without force, over all positions", "",
           "d >= 0 where p = 0 (with Eq. 18, 20)"});
  out.put("/certificate/least_force", a.least_force,
          {"N", "least force of a strip in contact, over all positions", "",
           "p >= 0 where d = 0 (with Eq. 18, 20)"});
  out.put("/certificate/torque_residual", a.torque_residual,
          {"1", "largest relative residual of the torque, over all positions", "", "|sum a p - T| / T"});
  put_backlash(out, a.backlash_margin);
  out.publish();
}

namespace {

void put_changes(ArtifactWriter& out, const std::string& group, const StaticChanges& a,
                 const std::string& what) {
  const Eigen::Index entries = a.mean_stiffness_change.size();
  want_rows("peak_to_peak_change", a.peak_to_peak_change.size(), entries);
  want_rows("harmonic_change", a.harmonic_change.rows(), entries);
  const std::string axis = group.substr(1) + "/entry";
  out.put(group + "/entry", a.entry, {"1", what + ", in the order of the entries", "", ""});
  out.put(group + "/mean_stiffness_change", a.mean_stiffness_change,
          {"1", "relative change of the mean secant stiffness", axis, ""});
  out.put(group + "/peak_to_peak_change", a.peak_to_peak_change,
          {"1", "relative change of the peak-to-peak transmission error", axis, ""});
  if (a.pressure_change.size() > 0) {
    want_rows("pressure_change", a.pressure_change.size(), entries);
    out.put(group + "/pressure_change", a.pressure_change,
            {"1", "relative change of the largest contact pressure inside a flank", axis, ""});
  }
  out.put(group + "/harmonic_change", a.harmonic_change,
          {"1", "change of the first harmonics of the transmission error over its first harmonic",
           axis + " harmonic", ""});
}

StaticChanges take_changes(const ArtifactReader& in, const std::string& group) {
  StaticChanges a;
  a.entry = in.word(group + "/entry");
  a.mean_stiffness_change = in.vector(group + "/mean_stiffness_change");
  const Eigen::Index entries = a.mean_stiffness_change.size();
  a.peak_to_peak_change = in.vector(group + "/peak_to_peak_change", entries);
  if (in.file().has(group + "/pressure_change"))
    a.pressure_change = in.vector(group + "/pressure_change", entries);
  a.harmonic_change = in.matrix(group + "/harmonic_change", entries, -1);
  return a;
}

}  // namespace

void write(const std::string& path, const ErrorBudgetArtifact& a, const Provenance& provenance) {
  ArtifactWriter out(path, "error_budget", kErrorBudgetVersion,
                     "Error budget of the static transmission error: " + pair_title(a.mesh, a.torque),
                     provenance);
  const KeyValues values = settings_of(a);
  put_pair(out, a);
  out.parameters("mesh", values, Part::mesh);
  out.parameters("fidelity", values, Part::contact_rung);
  out.parameters("discretisation", values, Part::contact);
  out.put("/parameters/operation/torque", a.torque, {"N m", "torque on the driver", "", ""});
  put_changes(out, "/refinement", a.refinement, "what was refined alone");
  put_changes(out, "/choice", a.choice, "what was chosen instead, for information and in no sum of errors");
  if (!a.choice_missing.empty())
    out.put("/choice/missing", a.choice_missing,
            {"1", "other choices that could not be computed, and why", "", ""});
  out.publish();
}

ErrorBudgetArtifact read_error_budget(const std::string& path) {
  const ArtifactReader in(path, "error_budget", kErrorBudgetVersion);
  ErrorBudgetArtifact a;
  KeyValues values;
  in.parameters("mesh", values, Part::mesh);
  in.parameters("fidelity", values, Part::contact_rung);
  in.parameters("discretisation", values, Part::contact);
  take_pair(in, a);
  take_settings(values, a);
  a.torque = in.number("/parameters/operation/torque");
  a.refinement = take_changes(in, "/refinement");
  a.choice = take_changes(in, "/choice");
  if (in.file().has("/choice/missing")) a.choice_missing = in.word("/choice/missing");
  return a;
}

StaticArtifact read_static(const std::string& path) {
  const ArtifactReader in(path, "static", kStaticVersion);
  StaticArtifact a;
  KeyValues values;
  in.parameters("mesh", values, Part::mesh);
  in.parameters("fidelity", values, Part::contact_rung);
  in.parameters("discretisation", values, Part::contact);
  take_pair(in, a);
  take_settings(values, a);
  a.torque = in.number("/parameters/operation/torque");
  a.contact_ratio = in.number("/contact_ratio");
  a.mesh_phase = in.vector("/mesh_phase");
  const Eigen::Index phases = a.mesh_phase.size();
  a.transmission_error = in.vector("/transmission_error", phases);
  a.unloaded_error = in.vector("/unloaded_transmission_error", phases);
  a.stiffness_secant = in.vector("/mesh_stiffness_secant", phases);
  a.stiffness_tangent = in.vector("/mesh_stiffness_tangent", phases);
  a.pair = in.whole_vector("/pair");
  a.tooth_load = in.matrix("/tooth_load", phases, a.pair.size());
  for (int g = 0; g < 2; ++g)
    if (a.mesh.bearing[g].elastic())
      a.bearing_force[g] = in.matrix(of_body(a.mesh, g, "bearing_force"), phases, 2);
  a.contact_pressure = in.matrix("/contact_pressure", phases, a.pair.size());
  a.contact_half_width = in.matrix("/contact_half_width", phases, a.pair.size());
  a.transmission_error_harmonic = in.vector("/transmission_error_harmonic");
  a.stiffness_harmonic = in.vector("/mesh_stiffness_harmonic");
  a.hunting_periods = take_hunting(in);
  if (a.hunting_periods > 1) a.transmission_error_order = in.vector("/transmission_error_order");
  a.mean_stiffness = in.number("/mean_stiffness");
  a.least_gap = in.number("/certificate/least_gap");
  a.least_force = in.number("/certificate/least_force");
  a.torque_residual = in.number("/certificate/torque_residual");
  a.backlash_margin = take_backlash(in);
  return a;
}

void write(const std::string& path, const LoadedArtifact& a, const Provenance& provenance) {
  const Eigen::Index pairs = a.pair.size(), strips = a.strip_pair.size();
  want_rows("tooth_load", a.tooth_load.size(), pairs);
  want_rows("tooth", a.tooth.rows(), pairs);
  want_rows("root_stress", a.root_stress.rows(), pairs);
  want_rows("strip/roll_angle", a.strip_roll.rows(), strips);
  want_rows("strip/deflection", a.strip_deflection.rows(), strips);
  for (const auto& [name, values] :
       {std::pair{"strip/width", &a.strip_width}, std::pair{"strip/force", &a.strip_force},
        std::pair{"strip/pressure", &a.strip_pressure}, std::pair{"strip/separation", &a.strip_separation}})
    want_rows(name, values->size(), strips);
  ArtifactWriter out(path, "loaded", kLoadedVersion, "Loaded gears: " + pair_title(a.mesh, a.torque),
                     provenance);
  const KeyValues values = settings_of(a);
  put_pair(out, a);
  out.parameters("mesh", values, Part::mesh);
  out.parameters("discretisation", values, Part::contact);
  out.put("/parameters/operation/torque", a.torque, {"N m", "torque on the driver", "", ""});
  out.put("/parameters/operation/mesh_phase", a.mesh_phase,
          {"1", "mesh phase; 0: reference pair at the pitch point, 1: one mesh period", "", ""});
  out.put("/transmission_error", a.transmission_error,
          {"m", "transmission error along the line of action, positive when the driver is ahead", "",
           "r1 theta1 + r2 theta2"});
  out.put("/pair", a.pair,
          {"1", "number of the tooth pairs that carry load: -1 following, 0 reference, +1 preceding", "pair",
           ""});
  out.put("/tooth_load", a.tooth_load, {"N", "normal force of each tooth pair", "pair", ""});
  out.put("/tooth", a.tooth, {"1", "teeth of the pairs, counter-clockwise from tooth 0", "pair gear", ""});
  out.put(
      "/root_stress", a.root_stress,
      {"Pa", "largest principal stress at the nodes of the fillet below the loaded flank", "pair gear", ""});
  const std::string at = "/strip/";
  out.put(at + "pair", a.strip_pair, {"1", "number of the tooth pair of each strip", "strip", ""});
  out.put(at + "roll_angle", a.strip_roll,
          {"rad", "roll angles of the strip's middle on both gears", "strip gear", ""});
  out.put(at + "width", a.strip_width, {"m", "width of the strips along the flank", "strip", ""});
  out.put(at + "force", a.strip_force, {"N", "normal force of the strips", "strip", "p of Eq. 18"});
  out.put(at + "pressure", a.strip_pressure, {"Pa", "force over width and face width", "strip", ""});
  out.put(at + "separation", a.strip_separation,
          {"m", "gap of the loaded flanks, by the flank tables", "strip", "d of Eq. 18"});
  out.put(at + "deflection", a.strip_deflection,
          {"m", "how far the flank of each gear gives way, mean over the strip, by the whole field",
           "strip gear", ""});
  const auto of_gears = [&](const std::string& name, const Eigen::Vector2d& of, const std::string& units,
                            const std::string& meaning) {
    out.put("/certificate/" + name, Eigen::VectorXd(of), {units, meaning, "gear", ""});
  };
  of_gears("hub_torque", a.hub_torque, "N m", "moment that holds the hub, by the elements about the bore");
  of_gears("contact_torque", a.contact_torque, "N m",
           "moment of the strips' forces along the normals of the gear's own flanks");
  of_gears("strain_energy", a.strain_energy, "J", "strain energy, by quadrature of the stresses");
  of_gears("contact_work", a.contact_work, "J", "half of the sum of forces times deflections");
  if (a.vtk_point.rows() > 0)
    put_vtk(out.file(),
            {a.vtk_point, a.vtk_cell, {}, {}, a.vtk_line, a.vtk_point_data, a.vtk_cell_data, true});
  out.publish();
  link_for_paraview(path);
}

LoadedArtifact read_loaded(const std::string& path) {
  const ArtifactReader in(path, "loaded", kLoadedVersion);
  LoadedArtifact a;
  KeyValues values;
  in.parameters("mesh", values, Part::mesh);
  in.parameters("discretisation", values, Part::contact);
  take_pair(in, a);
  take_settings(values, a);
  a.torque = in.number("/parameters/operation/torque");
  a.mesh_phase = in.number("/parameters/operation/mesh_phase");
  a.transmission_error = in.number("/transmission_error");
  a.pair = in.whole_vector("/pair");
  const Eigen::Index pairs = a.pair.size();
  a.tooth_load = in.vector("/tooth_load", pairs);
  a.tooth = in.whole_matrix("/tooth", pairs, 2);
  a.root_stress = in.matrix("/root_stress", pairs, 2);
  a.strip_pair = in.whole_vector("/strip/pair");
  const Eigen::Index strips = a.strip_pair.size();
  a.strip_roll = in.matrix("/strip/roll_angle", strips, 2);
  a.strip_width = in.vector("/strip/width", strips);
  a.strip_force = in.vector("/strip/force", strips);
  a.strip_pressure = in.vector("/strip/pressure", strips);
  a.strip_separation = in.vector("/strip/separation", strips);
  a.strip_deflection = in.matrix("/strip/deflection", strips, 2);
  a.hub_torque = in.vector("/certificate/hub_torque", 2);
  a.contact_torque = in.vector("/certificate/contact_torque", 2);
  a.strain_energy = in.vector("/certificate/strain_energy", 2);
  a.contact_work = in.vector("/certificate/contact_work", 2);
  return a;
}

void write(const std::string& path, const ImpactArtifact& a, const Provenance& provenance) {
  const auto states = static_cast<Eigen::Index>(a.contact_state.size()), phases = a.mesh_phase.size();
  for (const auto& [name, size] :
       {std::pair{"natural_frequency", a.natural_frequency.size()},
        std::pair{"damping_ratio", a.damping_ratio.size()},
        std::pair{"undamped_frequency", a.undamped_frequency.size()},
        std::pair{"ring_down/mesh_phase", a.state_phase.size() + 1},
        std::pair{"ring_down/transmission_error", a.transmission_error.rows() + 1}})
    want_rows(name, size, states);
  want_rows("ring_down/transmission_error (columns)", a.transmission_error.cols(), a.time.size());
  for (const auto& [name, size] : {std::pair{"loaded_pairs", a.loaded_pairs.size()},
                                   std::pair{"natural_frequency", a.phase_natural_frequency.size()},
                                   std::pair{"damping_ratio", a.phase_damping_ratio.size()},
                                   std::pair{"undamped_frequency", a.phase_undamped_frequency.size()},
                                   std::pair{"eigen_frequency", a.eigen_frequency.size()},
                                   std::pair{"eigen_damping_ratio", a.eigen_damping_ratio.size()},
                                   std::pair{"fit_residual", a.fit_residual.size()}})
    want_rows(text("by_phase/", name).c_str(), size, phases);
  ArtifactWriter out(path, "impact", kImpactVersion, "Ring-down: " + pair_title(a.mesh, a.torque),
                     provenance);
  const KeyValues values = settings_of(a);
  put_pair(out, a);
  put_inertia(out, "driver", a.driver_inertia);
  put_inertia(out, "driven", a.driven_inertia);
  out.parameters("mesh", values, Part::mesh);
  out.parameters("damping", values, Part::damping);
  put_bearings(out, a);
  out.parameters("fidelity", values, Part::rung);
  out.parameters("fidelity", values, Part::contact_rung);
  out.parameters("discretisation", values, Part::contact);
  out.put("/parameters/operation/torque", a.torque, {"N m", "torque on the driver", "", ""});
  out.put("/parameters/operation/torque_step", a.torque_step,
          {"1", "torque that is let go at the start of a decay, over the torque", "", ""});
  const char *const state = "contact_state", *const trace = "ring_down/mesh_phase ring_down/time";
  out.file().put("/contact_state", a.contact_state,
                 {"1",
                  "number of loaded tooth pairs, held amid the longest part of the period that has it; mean: "
                  "over the whole period",
                  state, ""});
  out.put("/natural_frequency", a.natural_frequency,
          {"Hz", "frequency Im s / 2 pi of the decaying transmission error (damped natural frequency)", state,
           ""});
  out.put("/damping_ratio", a.damping_ratio,
          {"1", "damping ratio -Re s / |s| of the decaying transmission error", state, ""});
  out.put("/undamped_frequency", a.undamped_frequency,
          {"Hz", "natural frequency with the contact frozen and no damping", state, ""});
  out.put("/ring_down/mesh_phase", a.state_phase,
          {"1", "mesh phase of the contact states, the mean left out", "contact_state", ""});
  out.put("/ring_down/time", a.time, {"s", "time since the torque step was let go", "ring_down/time", ""});
  out.put("/ring_down/transmission_error", a.transmission_error,
          {"m", "transmission error less its static value", trace, "r1 theta1 + r2 theta2"});
  out.put("/mesh_phase", a.mesh_phase, {"1", "mesh phase at which the gears are held", kPhase, ""});
  out.put("/by_phase/loaded_pairs", a.loaded_pairs,
          {"1", "tooth pairs that carry load in static equilibrium", kPhase, ""});
  out.put("/by_phase/natural_frequency", a.phase_natural_frequency,
          {"Hz", "frequency Im s / 2 pi of the decaying transmission error (damped natural frequency)",
           kPhase, ""});
  out.put("/by_phase/damping_ratio", a.phase_damping_ratio,
          {"1", "damping ratio -Re s / |s| of the decaying transmission error", kPhase, ""});
  out.put("/by_phase/undamped_frequency", a.phase_undamped_frequency,
          {"Hz", "natural frequency with the contact frozen and no damping", kPhase, ""});
  out.put("/by_phase/eigen_frequency", a.eigen_frequency,
          {"Hz", "frequency Im s / 2 pi of the eigenvalue with the contact frozen", kPhase, ""});
  out.put("/by_phase/eigen_damping_ratio", a.eigen_damping_ratio,
          {"1", "damping ratio -Re s / |s| of the eigenvalue with the contact frozen", kPhase, ""});
  out.put("/by_phase/fit_residual", a.fit_residual,
          {"1", "RMS of decay less fit over RMS of decay", kPhase, ""});
  if (a.frozen_frequency.size() > 0) {
    want_rows("by_phase/frozen_frequency", a.frozen_frequency.rows(), phases);
    out.put(
        "/by_phase/frozen_frequency", a.frozen_frequency,
        {"Hz",
         "lowest natural frequencies with the contact frozen and no damping, hubs on their bearings included",
         "mesh_phase mode", ""});
  }
  out.put("/certificate/least_mesh_force", a.least_mesh_force,
          {"1", "least mesh force of all decays over the static one; teeth part at 0", "", ""});
  out.publish();
}

ImpactArtifact read_impact(const std::string& path) {
  const ArtifactReader in(path, "impact", kImpactVersion);
  ImpactArtifact a;
  KeyValues values;
  in.parameters("mesh", values, Part::mesh);
  in.parameters("damping", values, Part::damping);
  in.parameters("fidelity", values, Part::rung);
  in.parameters("fidelity", values, Part::contact_rung);
  in.parameters("discretisation", values, Part::contact);
  take_pair(in, a);
  take_settings(values, a);
  a.driver_inertia = take_inertia(in, "driver");
  a.driven_inertia = take_inertia(in, "driven");
  take_bearings(in, a);
  a.torque = in.number("/parameters/operation/torque");
  a.torque_step = in.number("/parameters/operation/torque_step");
  a.contact_state = in.file().strings("/contact_state");
  const auto states = static_cast<Eigen::Index>(a.contact_state.size());
  if (states < 2) in.file().refuse("/contact_state names no state");
  a.natural_frequency = in.vector("/natural_frequency", states);
  a.damping_ratio = in.vector("/damping_ratio", states);
  a.undamped_frequency = in.vector("/undamped_frequency", states);
  a.state_phase = in.vector("/ring_down/mesh_phase", states - 1);
  a.time = in.vector("/ring_down/time");
  a.transmission_error = in.matrix("/ring_down/transmission_error", states - 1, a.time.size());
  a.mesh_phase = in.vector("/mesh_phase");
  const Eigen::Index phases = a.mesh_phase.size();
  a.loaded_pairs = in.whole_vector("/by_phase/loaded_pairs", phases);
  a.phase_natural_frequency = in.vector("/by_phase/natural_frequency", phases);
  a.phase_damping_ratio = in.vector("/by_phase/damping_ratio", phases);
  a.phase_undamped_frequency = in.vector("/by_phase/undamped_frequency", phases);
  a.eigen_frequency = in.vector("/by_phase/eigen_frequency", phases);
  a.eigen_damping_ratio = in.vector("/by_phase/eigen_damping_ratio", phases);
  a.fit_residual = in.vector("/by_phase/fit_residual", phases);
  if (in.file().has("/by_phase/frozen_frequency"))
    a.frozen_frequency = in.matrix("/by_phase/frozen_frequency", phases);
  a.least_mesh_force = in.number("/certificate/least_mesh_force");
  return a;
}

void write(const std::string& path, const SweepArtifact& a, const Provenance& provenance) {
  const Eigen::Index speeds = a.mesh_frequency.size(), samples = a.transmission_error.cols(),
                     pairs = a.pair.size();
  want_rows("transmission_error", a.transmission_error.rows(), speeds);
  want_rows("mesh_force", a.mesh_force.rows(), speeds);
  want_rows("mesh_force (columns)", a.mesh_force.cols(), samples);
  want_rows("tooth_load", static_cast<Eigen::Index>(a.tooth_load.size()), speeds);
  want_rows("periods", a.periods.size(), speeds);
  want_rows("residual", a.residual.size(), speeds);
  want_rows("period_multiple", a.period_multiple.size(), speeds);
  want_rows("energy_imbalance", a.energy_imbalance.size(), speeds);
  want_rows("energy", a.energy.rows(), speeds);
  if (a.energy.cols() != static_cast<Eigen::Index>(kEnergyLines.size()))
    fail(Failure::numerical, "the energy ledger has ", a.energy.cols(), " lines instead of ",
         kEnergyLines.size());
  want_rows("drift_force", a.drift_force.size(), speeds);
  want_rows("jump_width", a.jump_width.size(), a.jump_frequency.size());
  const bool lumped = a.lumped.cell_end.size() > 0;
  ArtifactWriter out(path, "sweep", kSweepVersion,
                     text("Sweep ", a.direction, lumped ? ", lumped model " + a.model : "", ": ",
                          pair_title(a.mesh, a.torque)),
                     provenance);
  const KeyValues values = settings_of(a);
  put_pair(out, a);
  put_inertia(out, "driver", a.driver_inertia);
  put_inertia(out, "driven", a.driven_inertia);
  out.parameters("mesh", values, Part::mesh);
  out.parameters("damping", values, Part::damping);
  put_bearings(out, a);
  if (lumped) put_lumped(out, a.model, a.lumped);
  out.parameters("fidelity", values, Part::rung);
  out.parameters("fidelity", values, Part::contact_rung);
  out.parameters("discretisation", values, Part::contact);
  out.parameters("discretisation", values, Part::time);
  out.put("/parameters/operation/torque", a.torque, {"N m", "torque on the driver", "", ""});
  out.put("/parameters/operation/direction", a.direction,
          {"1", "direction of marching through the speeds", "", ""});
  out.put("/mesh_frequency", a.mesh_frequency, {"Hz", "mesh frequency, in order of marching", kSpeed, ""});
  out.put("/transmission_error", a.transmission_error,
          {"m",
           "dynamic transmission error from phase 0; the first period_multiple mesh periods are one orbit; "
           "shorter orbits repeat to fill the row",
           kSample, "r1 theta1 + r2 theta2"});
  out.put("/mesh_force", a.mesh_force, {"N", "normal force of all tooth pairs together", kSample, ""});
  out.put("/pair", a.pair,
          {"1", "number of the tooth pair: -1 following, 0 reference, +1 preceding", "pair", ""});
  std::vector<double> load;
  load.reserve(static_cast<std::size_t>(speeds * samples * pairs));
  for (const MatrixRM& rows : a.tooth_load) {
    want_rows("tooth_load (samples)", rows.rows(), samples);
    want_rows("tooth_load (pairs)", rows.cols(), pairs);
    load.insert(load.end(), rows.data(), rows.data() + rows.size());
  }
  out.file().put(
      "/tooth_load", load.data(),
      {static_cast<std::size_t>(speeds), static_cast<std::size_t>(samples), static_cast<std::size_t>(pairs)},
      {"N", "normal force of each tooth pair", "mesh_frequency sample pair", ""});
  for (int g = 0; g < 2; ++g) {
    if (!a.mesh.bearing[g].elastic() || lumped) continue;
    std::vector<double> force;
    want_rows("bearing_force", static_cast<Eigen::Index>(a.bearing_force[g].size()), speeds);
    for (const MatrixRM& rows : a.bearing_force[g]) {
      want_rows("bearing_force (samples)", rows.rows(), samples);
      force.insert(force.end(), rows.data(), rows.data() + rows.size());
    }
    out.file().put(of_body(a.mesh, g, "bearing_force"), force.data(),
                   {static_cast<std::size_t>(speeds), static_cast<std::size_t>(samples), 2},
                   {"N", kBearingForce, "mesh_frequency sample xy", ""});
  }
  out.put("/periods", a.periods, {"1", "mesh periods run to steady state", kSpeed, ""});
  out.put("/residual", a.residual,
          {"1", "relative change of the state over the last mesh period", kSpeed, ""});
  out.put("/period_multiple", a.period_multiple,
          {"1", "mesh periods after which the motion repeats; 0: not periodic within the limit", kSpeed, ""});
  out.put("/energy_imbalance", a.energy_imbalance,
          {"1", "energy not accounted for, relative to the input of the stored periods", kSpeed, ""});
  for (size_t i = 0; i < kEnergyLines.size(); ++i)
    out.put(text("/energy/", kEnergyLines[i].name),
            Eigen::VectorXd(a.energy.col(static_cast<Eigen::Index>(i))),
            {"J", text(kEnergyLines[i].meaning, ", over the stored periods"), kSpeed, ""});
  put_natural_frequency(out, a.natural_frequency);
  put_hunting(out, a.hunting_periods);
  out.put("/drift_force", a.drift_force,
          {"N", "largest force that the output must supply to hold the mean speed", kSpeed, ""});
  out.put("/certificate/least_gap", a.least_gap,
          {"m", "least gap of a strip without force, over all steps", "",
           "d >= 0 where p = 0 (with Eq. 18, 20)"});
  out.put(
      "/certificate/least_force", a.least_force,
      {"N", "least force of a strip in contact, over all steps", "", "p >= 0 where d = 0 (with Eq. 18, 20)"});
  out.put("/certificate/fallbacks", a.fallbacks,
          {"1", "contact solutions that needed Lawson and Hanson's method", "", ""});
  put_backlash(out, a.backlash_margin);
  out.put("/jump_frequency", a.jump_frequency,
          {"Hz", "middle of the interval in which the response jumps", "jump", ""});
  out.put("/jump_width", a.jump_width,
          {"Hz", "width of the interval in which the response jumps", "jump", ""});
  out.publish();
}

SweepArtifact read_sweep(const std::string& path) {
  const ArtifactReader in(path, "sweep", kSweepVersion);
  SweepArtifact a;
  KeyValues values;
  in.parameters("mesh", values, Part::mesh);
  in.parameters("damping", values, Part::damping);
  in.parameters("fidelity", values, Part::rung);
  in.parameters("fidelity", values, Part::contact_rung);
  in.parameters("discretisation", values, Part::contact);
  in.parameters("discretisation", values, Part::time);
  take_pair(in, a);
  take_settings(values, a);
  a.driver_inertia = take_inertia(in, "driver");
  a.driven_inertia = take_inertia(in, "driven");
  take_bearings(in, a);
  take_lumped(in, a);
  a.torque = in.number("/parameters/operation/torque");
  a.direction = in.word("/parameters/operation/direction");
  a.mesh_frequency = in.vector("/mesh_frequency");
  const Eigen::Index speeds = a.mesh_frequency.size();
  a.transmission_error = in.matrix("/transmission_error", speeds);
  const Eigen::Index samples = a.transmission_error.cols();
  a.mesh_force = in.matrix("/mesh_force", speeds, samples);
  a.pair = in.whole_vector("/pair");
  const Eigen::Index pairs = a.pair.size();
  const h5::Shape shape = in.file().shape("/tooth_load");
  if (shape != h5::Shape{static_cast<std::size_t>(speeds), static_cast<std::size_t>(samples),
                         static_cast<std::size_t>(pairs)}) {
    in.file().refuse(
        text("dataset /tooth_load has another shape than ", speeds, " x ", samples, " x ", pairs));
  }
  const auto load = in.doubles("/tooth_load");
  for (Eigen::Index f = 0; f < speeds; ++f) {
    a.tooth_load.push_back(Eigen::Map<const MatrixRM>(load.data() + f * samples * pairs, samples, pairs));
  }
  for (int g = 0; g < 2; ++g) {
    if (!a.mesh.bearing[g].elastic() || a.lumped.cell_end.size() > 0) continue;
    const std::string name = of_body(a.mesh, g, "bearing_force");
    if (in.file().shape(name) !=
        h5::Shape{static_cast<std::size_t>(speeds), static_cast<std::size_t>(samples), 2})
      in.file().refuse(text("dataset ", name, " has another shape than ", speeds, " x ", samples, " x 2"));
    const auto force = in.doubles(name);
    for (Eigen::Index f = 0; f < speeds; ++f)
      a.bearing_force[g].push_back(Eigen::Map<const MatrixRM>(force.data() + f * samples * 2, samples, 2));
  }
  a.periods = in.whole_vector("/periods", speeds);
  a.residual = in.vector("/residual", speeds);
  a.period_multiple = in.whole_vector("/period_multiple", speeds);
  a.energy_imbalance = in.vector("/energy_imbalance", speeds);
  a.energy.resize(speeds, kEnergyLines.size());
  for (size_t i = 0; i < kEnergyLines.size(); ++i)
    a.energy.col(static_cast<Eigen::Index>(i)) = in.vector(text("/energy/", kEnergyLines[i].name), speeds);
  a.natural_frequency = in.number("/natural_frequency");
  a.hunting_periods = take_hunting(in);
  a.drift_force = in.vector("/drift_force", speeds);
  a.least_gap = in.number("/certificate/least_gap");
  a.least_force = in.number("/certificate/least_force");
  a.fallbacks = in.whole("/certificate/fallbacks");
  a.backlash_margin = take_backlash(in);
  a.jump_frequency = in.vector("/jump_frequency");
  a.jump_width = in.vector("/jump_width", a.jump_frequency.size());
  return a;
}

void write(const std::string& path, const ResponseArtifact& a, const Provenance& provenance) {
  const Eigen::Index speeds = a.mesh_frequency.size();
  want_rows("dte_rms", a.dte_rms.size(), speeds);
  want_rows("dte_mean", a.dte_mean.size(), speeds);
  want_rows("dte_harmonic", a.dte_harmonic.rows(), speeds);
  if (a.hunting_periods > 1) want_rows("dte_order", a.dte_order.rows(), speeds);
  want_rows("tooth_load_max", a.tooth_load_max.size(), speeds);
  want_rows("mesh_force_max", a.mesh_force_max.size(), speeds);
  want_rows("separation_fraction", a.separation_fraction.size(), speeds);
  want_rows("separations_per_period", a.separations_per_period.size(), speeds);
  want_rows("period_multiple", a.period_multiple.size(), speeds);
  want_rows("jump_width", a.jump_width.size(), a.jump_frequency.size());
  ArtifactWriter out(path, "response", kResponseVersion,
                     text("Response, sweep ", a.direction, ": ", pair_title(a.mesh, a.torque)), provenance);
  const KeyValues values = settings_of(a);
  put_pair(out, a);
  put_inertia(out, "driver", a.driver_inertia);
  put_inertia(out, "driven", a.driven_inertia);
  out.parameters("mesh", values, Part::mesh);
  out.parameters("fidelity", values, Part::rung);
  out.parameters("fidelity", values, Part::contact_rung);
  out.parameters("discretisation", values, Part::contact);
  out.parameters("discretisation", values, Part::time);
  out.parameters("damping", values, Part::damping);
  out.put("/parameters/operation/torque", a.torque, {"N m", "torque on the driver", "", ""});
  out.put("/parameters/operation/direction", a.direction,
          {"1", "direction of marching through the speeds", "", ""});
  out.put("/parameters/fidelity/model", a.model,
          {"1", "finite elements, or the name of a lumped model", "", ""});
  put_natural_frequency(out, a.natural_frequency);
  out.put("/mesh_frequency", a.mesh_frequency, {"Hz", "mesh frequency, in order of marching", kSpeed, ""});
  out.put("/dte_rms", a.dte_rms,
          {"m", "RMS of the oscillating part of the dynamic transmission error", kSpeed, ""});
  out.put("/dte_mean", a.dte_mean, {"m", "mean of the dynamic transmission error", kSpeed, ""});
  out.put("/dte_harmonic", a.dte_harmonic,
          {"m", "amplitude of the harmonics 1, 2, ... of the mesh frequency", "mesh_frequency harmonic", ""});
  put_hunting(out, a.hunting_periods);
  if (a.hunting_periods > 1)
    out.put(
        "/dte_order", a.dte_order,
        {"m", "amplitude of the harmonics 1, 2, ... of the hunting frequency", "mesh_frequency order", ""});
  out.put("/tooth_load_max", a.tooth_load_max, {"N", "largest normal force of one tooth pair", kSpeed, ""});
  out.put("/mesh_force_max", a.mesh_force_max,
          {"N", "largest normal force of all pairs together", kSpeed, ""});
  for (int g = 0; g < 2; ++g) {
    if (a.bearing_force_max[g].size() == 0) continue;
    want_rows("bearing_force_max", a.bearing_force_max[g].size(), speeds);
    want_rows("bearing_force_rms", a.bearing_force_rms[g].size(), speeds);
    out.put(of_body(a.mesh, g, "bearing_force_max"), a.bearing_force_max[g],
            {"N", "largest force of the gear on its bearing", kSpeed, ""});
    out.put(of_body(a.mesh, g, "bearing_force_rms"), a.bearing_force_rms[g],
            {"N", "RMS of the oscillating part of the force of the gear on its bearing, x and y together",
             kSpeed, ""});
  }
  out.put("/separation_fraction", a.separation_fraction,
          {"1", "share of the period without force", kSpeed, ""});
  out.put("/separations_per_period", a.separations_per_period,
          {"1", "losses of contact per mesh period", kSpeed, ""});
  out.put("/jump_frequency", a.jump_frequency,
          {"Hz", "middle of the interval in which the response jumps", "jump", ""});
  out.put("/jump_width", a.jump_width,
          {"Hz", "width of the interval in which the response jumps", "jump", ""});
  out.put("/period_multiple", a.period_multiple,
          {"1", "mesh periods after which the motion repeats; 0: not periodic within the limit", kSpeed, ""});
  out.publish();
}

ResponseArtifact read_response(const std::string& path) {
  const ArtifactReader in(path, "response", kResponseVersion);
  ResponseArtifact a;
  KeyValues values;
  in.parameters("mesh", values, Part::mesh);
  in.parameters("fidelity", values, Part::rung);
  in.parameters("fidelity", values, Part::contact_rung);
  in.parameters("discretisation", values, Part::contact);
  in.parameters("discretisation", values, Part::time);
  in.parameters("damping", values, Part::damping);
  take_pair(in, a);
  a.driver_inertia = take_inertia(in, "driver");
  a.driven_inertia = take_inertia(in, "driven");
  take_settings(values, a);
  a.torque = in.number("/parameters/operation/torque");
  a.direction = in.word("/parameters/operation/direction");
  a.model = in.word("/parameters/fidelity/model");
  a.natural_frequency = in.number("/natural_frequency");
  a.mesh_frequency = in.vector("/mesh_frequency");
  const Eigen::Index speeds = a.mesh_frequency.size();
  a.dte_rms = in.vector("/dte_rms", speeds);
  a.dte_mean = in.vector("/dte_mean", speeds);
  a.dte_harmonic = in.matrix("/dte_harmonic", speeds);
  a.tooth_load_max = in.vector("/tooth_load_max", speeds);
  a.mesh_force_max = in.vector("/mesh_force_max", speeds);
  for (int g = 0; g < 2; ++g)
    if (in.file().has(of_body(a.mesh, g, "bearing_force_max"))) {
      a.bearing_force_max[g] = in.vector(of_body(a.mesh, g, "bearing_force_max"), speeds);
      a.bearing_force_rms[g] = in.vector(of_body(a.mesh, g, "bearing_force_rms"), speeds);
    }
  a.separation_fraction = in.vector("/separation_fraction", speeds);
  a.separations_per_period = in.vector("/separations_per_period", speeds);
  a.jump_frequency = in.vector("/jump_frequency");
  a.jump_width = in.vector("/jump_width", a.jump_frequency.size());
  a.period_multiple = in.whole_vector("/period_multiple", speeds);
  a.hunting_periods = take_hunting(in);
  if (a.hunting_periods > 1) a.dte_order = in.matrix("/dte_order", speeds);
  return a;
}

void write(const std::string& path, const BranchArtifact& a, const Provenance& provenance) {
  const Eigen::Index points = a.mesh_frequency.size(), folds = a.fold_frequency.size(),
                     grazings = a.grazing_frequency.size();
  for (const auto& [name, rows] :
       {std::pair{"dte_rms", a.dte_rms.size()},
        {"dte_mean", a.dte_mean.size()},
        {"dte_harmonic", a.dte_harmonic.rows()},
        {"floquet_multiplier", static_cast<Eigen::Index>(a.floquet_multiplier.size())},
        {"stable", a.stable.size()},
        {"steps", a.steps.size()},
        {"residual", a.residual.size()}})
    want_rows(name, rows, points);
  want_rows("fold_rms", a.fold_rms.size(), folds);
  want_rows("fold_smooth", a.fold_smooth.size(), folds);
  want_rows("fold_multiplier", a.fold_multiplier.rows(), folds);
  want_rows("grazing_phase", a.grazing_phase.size(), grazings);
  want_rows("grazing_pair", a.grazing_pair.size(), grazings);
  want_rows("grazing_closes", a.grazing_closes.size(), grazings);
  ArtifactWriter out(path, "branch", kBranchVersion,
                     "Branch of periodic orbits: " + pair_title(a.mesh, a.torque), provenance);
  const KeyValues values = settings_of(a);
  put_pair(out, a);
  put_inertia(out, "driver", a.driver_inertia);
  put_inertia(out, "driven", a.driven_inertia);
  out.parameters("mesh", values, Part::mesh);
  out.parameters("fidelity", values, Part::rung);
  out.parameters("fidelity", values, Part::contact_rung);
  out.parameters("discretisation", values, Part::contact);
  out.parameters("discretisation", values, Part::time);
  out.parameters("damping", values, Part::damping);
  out.put("/parameters/operation/torque", a.torque, {"N m", "torque on the driver", "", ""});
  out.put("/mesh_frequency", a.mesh_frequency, {"Hz", "mesh frequency along the branch", "point", ""});
  out.put("/dte_rms", a.dte_rms,
          {"m", "RMS of the oscillating part of the dynamic transmission error", "point", ""});
  out.put("/dte_mean", a.dte_mean, {"m", "mean of the dynamic transmission error", "point", ""});
  out.put("/dte_harmonic", a.dte_harmonic,
          {"m", "amplitude of the harmonics 1, 2, ... of the mesh frequency", "point harmonic", ""});
  const Eigen::Index kept = points > 0 ? a.floquet_multiplier[0].rows() : 0;
  std::vector<double> multipliers;
  for (const MatrixRM& rows : a.floquet_multiplier) {
    want_rows("floquet_multiplier (multipliers)", rows.rows(), kept);
    multipliers.insert(multipliers.end(), rows.data(), rows.data() + rows.size());
  }
  out.file().put(
      "/floquet_multiplier", multipliers.data(),
      {static_cast<std::size_t>(points), static_cast<std::size_t>(kept), 2},
      {"1", "multipliers of the orbit over a mesh period, largest modulus first: real and imaginary part",
       "point multiplier part", ""});
  out.put("/stable", a.stable, {"1", "1: all multipliers lie inside the unit circle", "point", ""});
  out.put("/steps", a.steps, {"1", "time steps per mesh period", "point", ""});
  out.put("/residual", a.residual, {"1", "relative change of the state over a mesh period", "point", ""});
  out.put("/segment_mismatch", a.segment_mismatch,
          {"1", "relative change of the orbit where the number of steps changes", "segment", ""});
  out.put("/fold_frequency", a.fold_frequency,
          {"Hz", "mesh frequency at which the branch turns", "fold", ""});
  out.put("/fold_rms", a.fold_rms, {"m", "RMS of the oscillating transmission error there", "fold", ""});
  out.put("/fold_smooth", a.fold_smooth,
          {"1", "1: a multiplier is 1 there; 0: at a kink, where contacts of a step change", "fold", ""});
  out.put("/fold_multiplier", a.fold_multiplier,
          {"1", "real multiplier nearest to 1, before and after the fold", "fold side", ""});
  out.put("/flip_frequency", a.flip_frequency,
          {"Hz", "mesh frequency at which a multiplier passes -1", "flip", ""});
  out.put(
      "/torus_frequency", a.torus_frequency,
      {"Hz", "mesh frequency at which the modulus of a complex pair of multipliers passes 1", "torus", ""});
  out.put("/grazing_frequency", a.grazing_frequency,
          {"Hz", "mesh frequency at which the sequence of contacts changes", "grazing", ""});
  out.put("/grazing_phase", a.grazing_phase,
          {"1", "mesh phase of the contact that comes or goes", "grazing", ""});
  out.put("/grazing_pair", a.grazing_pair, {"1", "its tooth pair", "grazing", ""});
  out.put("/grazing_closes", a.grazing_closes, {"1", "1: it closes, 0: it opens", "grazing", ""});
  out.put("/end", a.end, {"1", "why the branch was followed no further", "", ""});
  out.publish();
}

BranchArtifact read_branch(const std::string& path) {
  const ArtifactReader in(path, "branch", kBranchVersion);
  BranchArtifact a;
  KeyValues values;
  in.parameters("mesh", values, Part::mesh);
  in.parameters("fidelity", values, Part::rung);
  in.parameters("fidelity", values, Part::contact_rung);
  in.parameters("discretisation", values, Part::contact);
  in.parameters("discretisation", values, Part::time);
  in.parameters("damping", values, Part::damping);
  take_pair(in, a);
  a.driver_inertia = take_inertia(in, "driver");
  a.driven_inertia = take_inertia(in, "driven");
  take_settings(values, a);
  a.torque = in.number("/parameters/operation/torque");
  a.mesh_frequency = in.vector("/mesh_frequency");
  const Eigen::Index points = a.mesh_frequency.size();
  a.dte_rms = in.vector("/dte_rms", points);
  a.dte_mean = in.vector("/dte_mean", points);
  a.dte_harmonic = in.matrix("/dte_harmonic", points);
  const h5::Shape shape = in.file().shape("/floquet_multiplier");
  if (shape.size() != 3 || shape[0] != static_cast<std::size_t>(points) || shape[2] != 2)
    in.file().refuse(
        text("dataset /floquet_multiplier has another shape than ", points, " x multipliers x 2"));
  const auto multipliers = in.doubles("/floquet_multiplier");
  const auto kept = static_cast<Eigen::Index>(shape[1]);
  for (Eigen::Index i = 0; i < points; ++i)
    a.floquet_multiplier.push_back(Eigen::Map<const MatrixRM>(multipliers.data() + i * kept * 2, kept, 2));
  a.stable = in.whole_vector("/stable", points);
  a.steps = in.whole_vector("/steps", points);
  a.residual = in.vector("/residual", points);
  a.segment_mismatch = in.vector("/segment_mismatch");
  a.fold_frequency = in.vector("/fold_frequency");
  const Eigen::Index folds = a.fold_frequency.size();
  a.fold_rms = in.vector("/fold_rms", folds);
  a.fold_smooth = in.whole_vector("/fold_smooth", folds);
  a.fold_multiplier = in.matrix("/fold_multiplier", folds, 2);
  a.flip_frequency = in.vector("/flip_frequency");
  a.torus_frequency = in.vector("/torus_frequency");
  a.grazing_frequency = in.vector("/grazing_frequency");
  const Eigen::Index grazings = a.grazing_frequency.size();
  a.grazing_phase = in.vector("/grazing_phase", grazings);
  a.grazing_pair = in.whole_vector("/grazing_pair", grazings);
  a.grazing_closes = in.whole_vector("/grazing_closes", grazings);
  a.end = in.word("/end");
  return a;
}

namespace {

// Datasets of a map that have one row per case; in this order in the file.
struct CaseVector {
  const char *name, *units, *meaning, *equation;
  Eigen::VectorXd JumpMapArtifact::*values;
};
const CaseVector kCaseVectors[] = {
    {"rayleigh_stiffness", "s", "Rayleigh stiffness factor eta", "Eq. 21",
     &JumpMapArtifact::rayleigh_stiffness},
    {"damping_ratio", "1",
     "damping ratio of two pairs with their contact frozen under the static load; of a lumped model about "
     "its mean stiffness",
     "", &JumpMapArtifact::damping_ratio},
    {"branches_from", "Hz", "least speed with two motions; 0: none", "", &JumpMapArtifact::branches_from},
    {"branches_to", "Hz", "largest speed with two motions; 0: none", "", &JumpMapArtifact::branches_to},
    {"loss_from", "Hz", "least speed at which contact is lost on any branch; 0: none", "",
     &JumpMapArtifact::loss_from},
    {"loss_to", "Hz", "largest speed at which contact is lost on any branch; 0: none", "",
     &JumpMapArtifact::loss_to},
    {"excitation", "1",
     "first harmonic of the secant mesh stiffness over its mean, over twice the damping ratio",
     "k1 / k0 / (2 zeta)", &JumpMapArtifact::excitation}};
struct CaseCount {
  const char *name, *meaning;
  Eigen::VectorXi JumpMapArtifact::*values;
};
const CaseCount kCaseCounts[] = {
    {"two_branches", "1: speeds with two motions were found", &JumpMapArtifact::two_branches},
    {"open_below", "1: the speeds with two motions go on below the least speed",
     &JumpMapArtifact::open_below},
    {"unsteady", "speeds and directions at which no steady motion was found", &JumpMapArtifact::unsteady}};
struct CaseCurve {
  const char *name, *units, *meaning;
  std::array<MatrixRM, 2> JumpMapArtifact::*values;
};
const CaseCurve kCaseCurves[] = {
    {"dte_rms", "m", "RMS of the oscillating part of the dynamic transmission error",
     &JumpMapArtifact::dte_rms},
    {"tooth_load_max", "N", "largest normal force of one tooth pair", &JumpMapArtifact::tooth_load_max},
    {"separation_fraction", "1", "share of the period without force", &JumpMapArtifact::separation_fraction}};
const char* const kDirections[] = {"up", "down"};

}  // namespace

void write(const std::string& path, const JumpMapArtifact& a, const Provenance& provenance) {
  const Eigen::Index cases = a.damping_ratio.size(), speeds = a.mesh_frequency.size();
  for (const CaseVector& v : kCaseVectors) want_rows(v.name, (a.*v.values).size(), cases);
  for (const CaseCount& v : kCaseCounts) want_rows(v.name, (a.*v.values).size(), cases);
  for (const CaseCurve& v : kCaseCurves)
    for (const MatrixRM& curve : a.*v.values) {
      want_rows(v.name, curve.rows(), cases);
      want_rows(text(v.name, " (columns)").c_str(), curve.cols(), speeds);
    }
  want_rows("peak_tooth_load", a.peak_tooth_load.rows(), cases);
  want_rows("tooth_load", a.tooth_load.rows(), a.load_frequency > 0 ? cases : 0);
  want_rows("held_load_there", a.held_load_there.rows(), a.load_frequency > 0 ? cases : 0);
  want_rows("held_tooth_load", a.held_tooth_load.rows(), cases);
  want_rows("dte_rms_there", a.dte_rms_there.rows(), a.load_frequency > 0 ? cases : 0);
  for (const auto& [name, size] :
       {std::pair{"jump_case", a.jump_case.size()}, std::pair{"jump_direction", a.jump_direction.size()},
        std::pair{"jump_width", a.jump_width.size()}})
    want_rows(name, size, a.jump_frequency.size());
  ArtifactWriter out(path, "jump_map", kJumpMapVersion,
                     "Jumps against damping: " + pair_title(a.mesh, a.torque), provenance);
  const KeyValues values = settings_of(a);
  put_pair(out, a);
  put_inertia(out, "driver", a.driver_inertia);
  put_inertia(out, "driven", a.driven_inertia);
  out.parameters("mesh", values, Part::mesh);
  out.parameters("fidelity", values, Part::rung);
  out.parameters("fidelity", values, Part::contact_rung);
  out.parameters("discretisation", values, Part::contact);
  out.parameters("discretisation", values, Part::time);
  out.parameters("damping", values, Part::damping);
  out.put("/parameters/damping/mean_stiffness", a.bearing_stiffness,
          {"N m-1", "mean secant stiffness that sets the bearing dampers", "", ""});
  out.put("/parameters/operation/torque", a.torque, {"N m", "torque on the driver", "", ""});
  out.put("/parameters/fidelity/model", a.model,
          {"1", "finite elements, or the name of a lumped model", "", ""});
  out.put("/mean_stiffness", a.mean_stiffness,
          {"N m-1", "mean of the secant stiffness over a mesh period", "", ""});
  out.put("/first_harmonic", a.first_harmonic,
          {"N m-1", "amplitude of the first harmonic of the secant stiffness", "", ""});
  out.put("/one_pair_frequency", a.one_pair_frequency,
          {"Hz", "natural frequency with one pair, contact frozen, undamped; 0: one pair never carries all",
           "", ""});
  out.put("/two_pair_frequency", a.two_pair_frequency,
          {"Hz", "natural frequency with two pairs, contact frozen, undamped", "", ""});
  for (const CaseVector& v : kCaseVectors)
    out.put(text("/", v.name), a.*v.values, {v.units, v.meaning, "case", v.equation});
  for (const CaseCount& v : kCaseCounts)
    out.put(text("/", v.name), a.*v.values, {"1", v.meaning, "case", ""});
  out.put("/peak_tooth_load", a.peak_tooth_load,
          {"N", "largest normal force of one tooth pair at any speed; directions up, down", "case direction",
           ""});
  out.put("/held_tooth_load", a.held_tooth_load,
          {"N", "largest normal force of one tooth pair held for 1/64 of a mesh period; directions up, down",
           "case direction", ""});
  out.put("/load_frequency", a.load_frequency,
          {"Hz", "speed of tooth_load, held_load_there and dte_rms_there; 0: none was asked for", "", ""});
  if (a.load_frequency > 0) {
    out.put("/tooth_load", a.tooth_load,
            {"N", "largest normal force of one tooth pair at load_frequency; directions up, down",
             "case direction", ""});
    out.put("/held_load_there", a.held_load_there,
            {"N", "the same held for 1/64 of a mesh period", "case direction", ""});
    out.put(
        "/dte_rms_there", a.dte_rms_there,
        {"m", "RMS of the transmission error at load_frequency; directions up, down", "case direction", ""});
  }
  out.put("/jump_case", a.jump_case, {"1", "case in which the response jumps, counted from 0", "jump", ""});
  out.put("/jump_direction", a.jump_direction, {"1", "0: speed rising, 1: falling", "jump", ""});
  out.put("/jump_frequency", a.jump_frequency,
          {"Hz", "middle of the interval in which the response jumps", "jump", ""});
  out.put("/jump_width", a.jump_width,
          {"Hz", "width of the interval in which the response jumps", "jump", ""});
  out.put("/mesh_frequency", a.mesh_frequency, {"Hz", "mesh frequency, ascending", kSpeed, ""});
  for (int d = 0; d < 2; ++d)
    for (const CaseCurve& v : kCaseCurves)
      out.put(
          text("/", kDirections[d], "/", v.name), (a.*v.values)[d],
          {v.units, text(v.meaning, ", speed ", d == 0 ? "rising" : "falling"), "case mesh_frequency", ""});
  out.publish();
}

JumpMapArtifact read_jump_map(const std::string& path) {
  const ArtifactReader in(path, "jump_map", kJumpMapVersion);
  JumpMapArtifact a;
  KeyValues values;
  in.parameters("mesh", values, Part::mesh);
  in.parameters("fidelity", values, Part::rung);
  in.parameters("fidelity", values, Part::contact_rung);
  in.parameters("discretisation", values, Part::contact);
  in.parameters("discretisation", values, Part::time);
  in.parameters("damping", values, Part::damping);
  take_pair(in, a);
  a.driver_inertia = take_inertia(in, "driver");
  a.driven_inertia = take_inertia(in, "driven");
  take_settings(values, a);
  a.bearing_stiffness = in.number("/parameters/damping/mean_stiffness");
  a.torque = in.number("/parameters/operation/torque");
  a.model = in.word("/parameters/fidelity/model");
  a.mean_stiffness = in.number("/mean_stiffness");
  a.first_harmonic = in.number("/first_harmonic");
  a.one_pair_frequency = in.number("/one_pair_frequency");
  a.two_pair_frequency = in.number("/two_pair_frequency");
  const Eigen::Index cases = in.vector("/damping_ratio").size();
  for (const CaseVector& v : kCaseVectors) a.*v.values = in.vector(text("/", v.name), cases);
  for (const CaseCount& v : kCaseCounts) a.*v.values = in.whole_vector(text("/", v.name), cases);
  a.peak_tooth_load = in.matrix("/peak_tooth_load", cases, 2);
  a.held_tooth_load = in.matrix("/held_tooth_load", cases, 2);
  a.load_frequency = in.number("/load_frequency");
  if (a.load_frequency > 0) {
    a.tooth_load = in.matrix("/tooth_load", cases, 2);
    a.held_load_there = in.matrix("/held_load_there", cases, 2);
    a.dte_rms_there = in.matrix("/dte_rms_there", cases, 2);
  }
  a.jump_frequency = in.vector("/jump_frequency");
  const Eigen::Index jumps = a.jump_frequency.size();
  a.jump_width = in.vector("/jump_width", jumps);
  a.jump_case = in.whole_vector("/jump_case", jumps);
  a.jump_direction = in.whole_vector("/jump_direction", jumps);
  if (jumps > 0 && (a.jump_case.minCoeff() < 0 || a.jump_case.maxCoeff() >= cases))
    in.file().refuse(text("dataset /jump_case names a case outside 0 to ", cases - 1));
  a.mesh_frequency = in.vector("/mesh_frequency");
  for (int d = 0; d < 2; ++d)
    for (const CaseCurve& v : kCaseCurves)
      (a.*v.values)[d] = in.matrix(text("/", kDirections[d], "/", v.name), cases, a.mesh_frequency.size());
  return a;
}

namespace {

struct MapCube {
  const char *name, *units, *meaning;
  std::vector<MatrixRM> HarrisMapArtifact::*values;
};
const MapCube kPeakToPeak{"peak_to_peak", "m", "peak-to-peak static transmission error",
                          &HarrisMapArtifact::peak_to_peak};
const MapCube kDynamicCubes[] = {
    {"dynamic/rms", "m",
     "RMS of the oscillating part of the transmission error at the speed where it is largest, up or down",
     &HarrisMapArtifact::dynamic_rms},
    {"dynamic/worst_frequency", "Hz", "mesh frequency at which it is largest",
     &HarrisMapArtifact::worst_frequency}};

void put_cube(ArtifactWriter& out, const HarrisMapArtifact& a, const std::string& name,
              const std::string& units, const std::string& meaning, const std::vector<MatrixRM>& values) {
  want_rows(name.c_str(), static_cast<Eigen::Index>(values.size()), a.length.size());
  std::vector<double> all;
  for (const MatrixRM& slice : values) {
    want_rows((name + " (torques)").c_str(), slice.rows(), a.torque.size());
    want_rows((name + " (reliefs)").c_str(), slice.cols(), a.relief.size());
    all.insert(all.end(), slice.data(), slice.data() + slice.size());
  }
  out.file().put("/" + name, all.data(),
                 {static_cast<std::size_t>(a.length.size()), static_cast<std::size_t>(a.torque.size()),
                  static_cast<std::size_t>(a.relief.size())},
                 {units, meaning, "relief_length torque relief", ""});
}

std::vector<MatrixRM> take_cube(const ArtifactReader& in, const HarrisMapArtifact& a,
                                const std::string& name) {
  const Eigen::Index starts = a.length.size(), torques = a.torque.size(), reliefs = a.relief.size();
  if (in.file().shape("/" + name) != h5::Shape{static_cast<std::size_t>(starts),
                                               static_cast<std::size_t>(torques),
                                               static_cast<std::size_t>(reliefs)})
    in.file().refuse(
        text("dataset /", name, " has another shape than ", starts, " x ", torques, " x ", reliefs));
  const auto all = in.doubles("/" + name);
  std::vector<MatrixRM> out;
  for (Eigen::Index s = 0; s < starts; ++s)
    out.push_back(Eigen::Map<const MatrixRM>(all.data() + s * torques * reliefs, torques, reliefs));
  return out;
}

}  // namespace

void write(const std::string& path, const HarrisMapArtifact& a, const Provenance& provenance) {
  const bool moving = !a.dynamic_rms.empty();
  want_rows("start_roll", a.start_roll.rows(), a.length.size());
  want_rows("optimum_relief", a.optimum_relief.size(), a.length.size());
  want_rows("optimum_peak_to_peak", a.optimum_peak_to_peak.size(), a.length.size());
  want_rows("cusp", a.cusp.rows(), a.length.size());
  want_rows("cusp (columns)", a.cusp.cols(), a.torque.size());
  want_rows("unrelieved", a.unrelieved.size(), a.torque.size());
  ArtifactWriter out(path, "harris_map", kHarrisMapVersion,
                     text("Harris map: ", a.mesh.driver, " drives ", a.mesh.driven), provenance);
  const KeyValues values = settings_of(a);
  put_pair(out, a);
  out.parameters("mesh", values, Part::mesh);
  out.parameters("fidelity", values, Part::contact_rung);
  out.parameters("discretisation", values, Part::contact);
  out.put("/parameters/relief/relieved", a.relieved, {"1", "gears whose tips are relieved", "", ""});
  out.put("/parameters/relief/shape", a.shape, {"1", "how the relief grows with the roll angle", "", ""});
  out.put("/parameters/operation/design_torque", a.design_torque,
          {"N m", "torque on the driver for which the optimum is sought", "", ""});
  out.put("/torque", a.torque, {"N m", "torque on the driver", "torque", ""});
  out.put("/relief", a.relief,
          {"m", "material taken off at the tip edge, normal to the flank", "relief", ""});
  out.put("/relief_length", a.length,
          {"m", "length of roll from where the relief starts to the tip edge", "relief_length",
           "r_b (tip roll angle - start roll angle)"});
  out.put(
      "/start_roll_angle", a.start_roll,
      {"rad", "roll angle at which the relief starts, on driver and driven gear", "relief_length gear", ""});
  put_cube(out, a, kPeakToPeak.name, kPeakToPeak.units, kPeakToPeak.meaning, a.*kPeakToPeak.values);
  for (int n = 0; n < 3; ++n)
    put_cube(out, a, text("harmonic_", n + 1), "m",
             text("amplitude of harmonic ", n + 1, " of the static transmission error"), a.harmonic[n]);
  out.put("/optimum_relief", a.optimum_relief,
          {"m", "relief of the least peak to peak at the design torque", "relief_length", ""});
  out.put("/optimum_peak_to_peak", a.optimum_peak_to_peak,
          {"m", "peak to peak of that relief at the design torque", "relief_length", ""});
  out.put("/cusp", a.cusp, {"m", "peak to peak of that relief against torque", "relief_length torque", ""});
  out.put("/unrelieved", a.unrelieved, {"m", "peak to peak without tip relief", "torque", ""});
  out.put("/check/points", a.checked,
          {"1", "points of the map solved again with finer strips and at more positions", "", ""});
  out.put("/check/largest_error", a.largest_error,
          {"1", "largest difference of the peak to peak from those, over it", "", ""});
  if (moving) {
    put_inertia(out, "driver", a.driver_inertia);
    put_inertia(out, "driven", a.driven_inertia);
    out.parameters("damping", values, Part::damping);
    out.parameters("fidelity", values, Part::rung);
    out.parameters("discretisation", values, Part::time);
    put_speeds(out, a);
    for (const MapCube& cube : kDynamicCubes)
      put_cube(out, a, cube.name, cube.units, cube.meaning, a.*cube.values);
  }
  out.publish();
}

HarrisMapArtifact read_harris_map(const std::string& path) {
  const ArtifactReader in(path, "harris_map", kHarrisMapVersion);
  HarrisMapArtifact a;
  const bool moving = in.file().has("/dynamic/rms");
  KeyValues values;
  in.parameters("mesh", values, Part::mesh);
  in.parameters("fidelity", values, Part::contact_rung);
  in.parameters("discretisation", values, Part::contact);
  take_pair(in, a);
  if (moving) {
    a.driver_inertia = take_inertia(in, "driver");
    a.driven_inertia = take_inertia(in, "driven");
    in.parameters("damping", values, Part::damping);
    in.parameters("fidelity", values, Part::rung);
    in.parameters("discretisation", values, Part::time);
    take_speeds(in, a);
  }
  take_settings(values, a);
  a.relieved = in.word("/parameters/relief/relieved");
  a.shape = in.word("/parameters/relief/shape");
  a.design_torque = in.number("/parameters/operation/design_torque");
  a.torque = in.vector("/torque");
  a.relief = in.vector("/relief");
  a.length = in.vector("/relief_length");
  a.start_roll = in.matrix("/start_roll_angle", a.length.size(), 2);
  a.peak_to_peak = take_cube(in, a, kPeakToPeak.name);
  for (int n = 0; n < 3; ++n) a.harmonic[n] = take_cube(in, a, text("harmonic_", n + 1));
  a.optimum_relief = in.vector("/optimum_relief", a.length.size());
  a.optimum_peak_to_peak = in.vector("/optimum_peak_to_peak", a.length.size());
  a.cusp = in.matrix("/cusp", a.length.size(), a.torque.size());
  a.unrelieved = in.vector("/unrelieved", a.torque.size());
  a.checked = in.whole("/check/points");
  a.largest_error = in.number("/check/largest_error");
  if (moving)
    for (const MapCube& cube : kDynamicCubes) a.*cube.values = take_cube(in, a, cube.name);
  return a;
}

namespace {

constexpr const char* kVariants = "variant";

std::string words(const std::vector<std::string>& list) {
  std::string out;
  for (const std::string& word : list) out += (out.empty() ? "" : " ") + word;
  return out;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

// The dataset of a key: its place without dots, its name without the unit.
std::string dataset_of(const VariedKey& key) {
  const std::string leaf = find_key(key.name).key->si_name();
  const auto dot = key.name.rfind('.');
  std::string place = dot == std::string::npos ? "" : key.name.substr(0, dot + 1);
  std::replace(place.begin(), place.end(), '.', '_');
  std::replace(place.begin(), place.end(), '-', '_');
  return "/key/" + place + leaf;
}

}  // namespace

void write(const std::string& path, const VariantArtifact& a, const Provenance& provenance) {
  const std::vector<AnswerKind> kinds = answer_kinds(a.directions);
  if (a.refusal.empty()) want_rows("answer", a.answer.size(), static_cast<Eigen::Index>(kinds.size()));
  ArtifactWriter out(path, "variant", kVariantVersion, "Variant of a study: " + pair_title(a.mesh, a.torque),
                     provenance);
  const KeyValues values = settings_of(a);
  put_pair(out, a);
  out.parameters("mesh", values, Part::mesh);
  out.parameters("fidelity", values, Part::contact_rung);
  out.parameters("discretisation", values, Part::contact);
  out.put("/parameters/operation/torque", a.torque, {"N m", "torque on the driver", "", ""});
  out.put("/parameters/operation/directions", words(a.directions),
          {"1", "directions of the sweeps; none: at rest", "", ""});
  if (!a.directions.empty()) {
    put_inertia(out, "driver", a.driver_inertia);
    put_inertia(out, "driven", a.driven_inertia);
    out.parameters("damping", values, Part::damping);
    out.parameters("fidelity", values, Part::rung);
    out.parameters("discretisation", values, Part::time);
    out.put("/parameters/operation/reference_torque", a.reference_torque,
            {"N m", "torque whose mean stiffness sets the bearing dampers", "", ""});
    put_speeds(out, a);
  }
  out.put("/refusal", a.refusal, {"1", "why a stage refused the variant; empty: none did", "", ""});
  if (a.refusal.empty())
    for (size_t i = 0; i < kinds.size(); ++i)
      out.put("/answer/" + kinds[i].name, a.answer[static_cast<Eigen::Index>(i)],
              {kinds[i].units, kinds[i].meaning, "", ""});
  out.publish();
}

VariantArtifact read_variant(const std::string& path) {
  const ArtifactReader in(path, "variant", kVariantVersion);
  VariantArtifact a;
  KeyValues values;
  in.parameters("mesh", values, Part::mesh);
  in.parameters("fidelity", values, Part::contact_rung);
  in.parameters("discretisation", values, Part::contact);
  take_pair(in, a);
  a.torque = in.number("/parameters/operation/torque");
  a.directions = split(in.word("/parameters/operation/directions"));
  for (const std::string& direction : a.directions)
    if (direction != "up" && direction != "down")
      in.file().refuse("names the direction '" + direction + "'; there are up and down");
  if (!a.directions.empty()) {
    a.driver_inertia = take_inertia(in, "driver");
    a.driven_inertia = take_inertia(in, "driven");
    in.parameters("damping", values, Part::damping);
    in.parameters("fidelity", values, Part::rung);
    in.parameters("discretisation", values, Part::time);
    a.reference_torque = in.number("/parameters/operation/reference_torque");
    take_speeds(in, a);
  }
  take_settings(values, a);
  a.refusal = in.word("/refusal");
  if (!a.refusal.empty()) return a;
  const std::vector<AnswerKind> kinds = answer_kinds(a.directions);
  a.answer.resize(static_cast<Eigen::Index>(kinds.size()));
  for (size_t i = 0; i < kinds.size(); ++i)
    a.answer[static_cast<Eigen::Index>(i)] = in.number("/answer/" + kinds[i].name);
  return a;
}

void write(const std::string& path, const StudyArtifact& a, const Provenance& provenance) {
  const auto variants = static_cast<Eigen::Index>(a.variants.size());
  want_rows("answer", a.answer.rows(), variants);
  want_rows("answer (columns)", a.answer.cols(), static_cast<Eigen::Index>(a.plan.answers.size()));
  want_rows("refusal", static_cast<Eigen::Index>(a.refusal.size()), variants);
  want_rows("unsteady", a.unsteady.size(), variants);
  ArtifactWriter out(path, "study", kStudyVersion, "Study: " + a.plan.title, provenance);
  const auto put_words = [&](const std::string& name, const std::vector<std::string>& list,
                             const std::string& meaning, const std::string& axes) {
    out.file().put(name, list, h5::Label{"1", meaning, axes, ""});
  };
  const std::string section = "/parameters/study/";
  std::vector<std::string> keys;
  for (const VariedKey& key : a.plan.keys) keys.push_back(key.name);
  out.put(section + "title", a.plan.title, {"1", "what the study is", "", ""});
  out.put(section + "scene", a.plan.scene, {"1", "scene whose variants these are", "", ""});
  out.put(section + "directions", words(a.plan.directions),
          {"1", "directions of the sweeps; none: at rest", "", ""});
  out.put(section + "plan", std::string(a.plan.random ? "sample" : "grid"),
          {"1", "all combinations, or random ones", "", ""});
  out.put(section + "seed", a.plan.seed, {"1", "of the draws of a sample", "", ""});
  put_words(section + "key", keys, "keys that vary, as the study names them", "key");
  put_words(section + "answer", a.plan.answers, "answers that are gathered", "answer");
  put_words(section + "figure_answer", a.plan.figure_answers, "answers that the figure shows",
            "figure_answer");
  put_words(section + "figure_key", a.plan.figure_keys, "keys against which it shows them", "figure_key");
  out.put(section + "figure_colour", a.plan.figure_colour, {"1", "key by which it colours them", "", ""});

  std::vector<std::string> names;
  Eigen::VectorXi refused(variants);
  for (Eigen::Index v = 0; v < variants; ++v) {
    names.push_back(a.variants[v].name);
    refused[v] = a.refusal[v].empty() ? 0 : 1;
  }
  put_words("/variant", names, "name of the variant's slice and artifact", kVariants);
  for (size_t k = 0; k < a.plan.keys.size(); ++k) {
    const VariedKey& key = a.plan.keys[k];
    Eigen::VectorXd numbers(variants);
    std::vector<std::string> texts;
    for (Eigen::Index v = 0; v < variants; ++v) {
      texts.push_back(a.variants[v].values.at(k));
      numbers[v] = key.number ? key.si(texts.back()) : 0;
    }
    const std::string meaning = key.name + ": " + key.meaning;
    if (key.number)
      out.put(dataset_of(key), numbers, {key.units, meaning, kVariants, ""});
    else
      put_words(dataset_of(key), texts, meaning, kVariants);
  }
  for (const AnswerKind& kind : answer_kinds(a.plan.directions)) {
    const auto found = std::find(a.plan.answers.begin(), a.plan.answers.end(), kind.name);
    if (found != a.plan.answers.end())
      out.put("/answer/" + kind.name, Eigen::VectorXd(a.answer.col(found - a.plan.answers.begin())),
              {kind.units, kind.meaning + "; 0 where refused is 1", kVariants, ""});
  }
  out.put("/refused", refused, {"1", "1: a stage refused the variant, it has no answers", kVariants, ""});
  put_words("/refusal", a.refusal, "why; empty where it was not refused", kVariants);
  out.put("/unsteady", a.unsteady,
          {"1", "speeds, of all sweeps, at which no periodic motion was found", kVariants, ""});
  out.publish();
}

StudyArtifact read_study_artifact(const std::string& path) {
  const ArtifactReader in(path, "study", kStudyVersion);
  const std::string section = "/parameters/study/";
  StudyArtifact a;
  a.plan.title = in.word(section + "title");
  a.plan.scene = in.word(section + "scene");
  a.plan.directions = split(in.word(section + "directions"));
  a.plan.random = in.word(section + "plan") == "sample";
  a.plan.seed = in.whole(section + "seed");
  a.plan.answers = in.file().strings(section + "answer");
  a.plan.figure_answers = in.file().strings(section + "figure_answer");
  a.plan.figure_keys = in.file().strings(section + "figure_key");
  a.plan.figure_colour = in.word(section + "figure_colour");
  for (const std::string& name : in.file().strings("/variant")) a.variants.push_back({name, {}});
  const auto variants = static_cast<Eigen::Index>(a.variants.size());
  const auto want_words = [&](const std::string& name) {
    std::vector<std::string> list = in.file().strings(name);
    if (list.size() != a.variants.size())
      in.file().refuse(
          text("dataset ", name, " holds ", list.size(), " words, there are ", variants, " variants"));
    return list;
  };
  for (const std::string& name : in.file().strings(section + "key")) {
    const VariedKey key = varied_key(name);
    if (key.number) {
      const Eigen::VectorXd si = in.vector(dataset_of(key), variants);
      for (Eigen::Index v = 0; v < variants; ++v) {
        char buffer[40];
        std::snprintf(buffer, sizeof buffer, "%.12g", si[v] * key.to_si_divide / key.to_si_multiply);
        a.variants[v].values.emplace_back(buffer);
      }
    } else {
      const std::vector<std::string> texts = want_words(dataset_of(key));
      for (Eigen::Index v = 0; v < variants; ++v) a.variants[v].values.push_back(texts[v]);
    }
    a.plan.keys.push_back(key);
  }
  a.answer.resize(variants, static_cast<Eigen::Index>(a.plan.answers.size()));
  for (size_t i = 0; i < a.plan.answers.size(); ++i)
    a.answer.col(static_cast<Eigen::Index>(i)) = in.vector("/answer/" + a.plan.answers[i], variants);
  a.refusal = want_words("/refusal");
  a.unsteady = in.whole_vector("/unsteady", variants);
  return a;
}

namespace {

// What an artifact of a pair says to the keys of a scene, from the side of one of its gears. It need not know of motion.
template <class Artifact>
KeyValues keys_of(const Artifact& a, bool driver) {
  KeyValues values = settings_of(a);
  values.design = driver ? a.driver : a.driven;
  values.material = driver ? a.driver_material : a.driven_material;
  values.body = driver ? a.driver_body : a.driven_body;
  values.modification = a.mesh.modification[driver ? 0 : 1];
  values.errors = a.mesh.errors[driver ? 0 : 1];
  values.bearing = a.mesh.bearing[driver ? 0 : 1];
  if constexpr (requires { a.damping; }) values.total_inertia = driver ? a.driver_inertia : a.driven_inertia;
  return values;
}

// As a scene would have it; "" for a list that is empty.
std::string in_scene_unit(KeyValues& values, const Key& key) {
  const auto number = [](double si, const Unit& unit) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", si * unit.divide / unit.multiply);
    return std::string(buffer);
  };
  std::string list;
  const Slot slot = key.slot(values);
  if (const auto* one = std::get_if<double*>(&slot)) return number(**one, key.unit);
  if (const auto* whole = std::get_if<int*>(&slot)) return text(**whole);
  if (const auto* word = std::get_if<std::string*>(&slot)) return **word;
  if (const auto* plane = std::get_if<PlaneSlot>(&slot)) return *plane->stress ? "stress" : "strain";
  if (const auto* corner = std::get_if<CornerRule*>(&slot)) {
    if (!(*corner)->enabled) return "false";
    return std::isinf((*corner)->largest_angle) ? "true"
                                                : text((*corner)->largest_angle * 180 / std::numbers::pi);
  }
  if (const auto* points = std::get_if<Points*>(&slot))
    for (const auto& [roll, removed] : **points)
      list += text(list.empty() ? "" : ", ", "[", number(roll, kPointUnits[0]), ", ",
                   number(removed, kPointUnits[1]), "]");
  if (const auto* teeth = std::get_if<ToothList>(&slot))
    for (const double value : *teeth->values) list += (list.empty() ? "" : ", ") + number(value, key.unit);
  return list.empty() ? "" : "[" + list + "]";
}

// Title, names of other sections, torques and speeds are no properties of what was computed.
bool of_operation(const Key& key) {
  return key.part == Part::title || key.part == Part::reference || key.part == Part::error_file ||
         key.part == Part::bearing_gear || key.part == Part::load || key.part == Part::operation;
}

template <class Artifact>
std::vector<SceneKey> scene_keys_in(const Artifact& a) {
  KeyValues driver = keys_of(a, true), driven = keys_of(a, false);
  const bool moves = requires {
    a.damping;
  };
  const auto stands = [&](Part part) {
    switch (part) {
      case Part::inertia:
      case Part::damping:
      case Part::rung:
      case Part::time:
        return moves;
      case Part::crack:
        return driver.design.crack.depth > 0 || driven.design.crack.depth > 0;
      case Part::modification:
        return driver.modification != FlankModification{} || driven.modification != FlankModification{};
      case Part::error:
        return !driver.errors.none() || !driven.errors.none();
      case Part::bearing:
        return a.mesh.on_bearings();
      default:
        return true;
    }
  };
  std::vector<SceneKey> out;
  for (const Key& key : scene_keys()) {
    if (of_operation(key) || !stands(key.part)) continue;
    const std::string section(key.section), first = in_scene_unit(driver, key),
                                            second = in_scene_unit(driven, key);
    const bool of_gears =
        section != "mesh" && section != "damping" && section != "fidelity" && section != "discretisation";
    if (!first.empty() || !second.empty())
      out.push_back({section, key.name, first, of_gears || first != second ? second : "", key.meaning});
  }
  return out;
}

}  // namespace

std::vector<SceneKey> scene_keys_of(const StaticArtifact& a) {
  return scene_keys_in(a);
}

std::vector<SceneKey> scene_keys_of(const ResponseArtifact& a) {
  return scene_keys_in(a);
}

std::string changed_keys(const JumpMapArtifact& from, const JumpMapArtifact& to) {
  const auto changes = [&](bool driver) {
    KeyValues old = keys_of(from, driver), fresh = keys_of(to, driver);
    std::string out;
    for (const Key& key : scene_keys()) {
      if (of_operation(key)) continue;
      const std::string a = in_scene_unit(old, key), b = in_scene_unit(fresh, key);
      if (a != b) out += text(out.empty() ? "" : ", ", key.name, " ", a, " → ", b);
    }
    return out;
  };
  const std::string driver = changes(true), driven = changes(false);
  if (driver == driven) return driver;
  return text("driver: ", driver, "; driven: ", driven);
}

}  // namespace whine
