#include "io/artifacts.h"

#include <algorithm>

#include "base/error.h"
#include "io/artifact_file.h"
#include "io/keys.h"
#include "io/layout_codec.h"

namespace whine {
namespace {

using namespace ranges;

// [gear.<name>.modification], of gears that have one.
void describe_modification(Codec& c, const std::string& gear, SystemStaticParameters& s) {
  const std::string section = "modification_" + gear;
  FlankModification modification = s.modification(gear);
  const bool stands = modification != FlankModification{};
  if (c.lists() || !c.optional("/parameters/" + section + "/tip_relief", stands)) return;
  c.parameters(section, keys(modification));
  if (c.in()) s.modify(gear, modification);
}

// Gears by name and what bodies and meshes are of them; [[mesh]] and [gear.<name>] of the scene as parameters.
void describe_settings(Codec& c, SystemStaticResult& a) {
  SystemStaticParameters& s = a.settings;
  describe_layout(c, s.layout);
  std::vector<std::string> gears = s.gears();
  c(s.gear, "/body/gear", "body_number", "name of its gear in the scene; empty of a carrier");
  c(gears, "/gear", "gear_number", "names of the gears of the scene");
  describe_sections(c, s.section);
  c.parameters("fidelity", keys(s.fidelity).only({"contact"}));
  c.parameters("discretisation", keys(s.contact));
  if (c.in()) {
    s.mesh.resize(s.section.empty()
                      ? 0
                      : static_cast<size_t>(*std::max_element(s.section.begin(), s.section.end())) + 1);
    a.drawing.resize(gears.size());
    for (const std::string& name : gears) s.body.emplace_back(name, "");
  }
  // Modifications are written gear by gear, errors body by body, friction, which is that of all meshes, once.
  for (size_t m = 0; m < s.mesh.size(); ++m)
    c.parameters("mesh_" + std::to_string(m), keys(s.mesh[m]).section("mesh"));
  Friction friction = s.friction();
  if (!c.lists() && c.optional("/parameters/friction/law", friction.acts())) {
    c.parameters("friction", keys(friction));
    if (c.in()) s.set_friction(friction);
  }
  for (size_t g = 0; g < gears.size(); ++g) {
    describe_gear(c, "gear_" + gears[g], a.drawing[g]);
    describe_modification(c, gears[g], s);
  }
  describe_errors(c, s);
}

void describe_motions(Codec& c, SystemStaticResult& a) {
  c(a.mesh_phase, "/mesh_phase", "1", kPhase, "mesh_phase",
    "phase of the first mesh; 0: its reference pair at the pitch point; from one mesh period to the next, up to the hunting period, where teeth differ");
  c(a.rotation, "/rotation", "m", kLength, "mesh_phase body_number",
    "base radius times rotation in the body's sense; 0 of held bodies");
  c(a.translation, "/translation", "m", kLength, "mesh_phase body_number xy", "displacement of the hub");
  c(a.transmission_error, "/transmission_error", "m", kLength, "mesh_phase mesh_number",
    "transmission error of each mesh along its line of action, positive when the driver is ahead",
    "r1 theta1 - r2 theta2, each in its own sense");
  c(a.mesh_deflection, "/mesh_deflection", "m", kLength, "mesh_phase mesh_number",
    "the same without what bearings give way");
  c(a.transmission_error_harmonic, "/transmission_error_harmonic", "m", kLength, "harmonic mesh_number",
    "mean, then amplitudes of the harmonics of the mesh frequency");
  c.numbers("harmonic", 0, "number of the harmonic of the mesh frequency; 0: the mean");
  describe_hunting(c, a.hunting_periods);
  if (!c.lists() && !(c.in() ? a.hunting_periods > 1 : a.transmission_error_order.size() > 0)) return;
  c(a.transmission_error_order, "/transmission_error_order", "m", kLength, "order mesh_number",
    "mean, then amplitudes of the harmonics of the hunting frequency");
  c.numbers("order", 0, "number of the harmonic of the hunting frequency; 0: the mean");
}

void describe_loads(Codec& c, SystemStaticResult& a) {
  c(a.mesh_force, "/mesh_force", "N", kForce, "mesh_phase mesh_number",
    "torque on the driving body over its base radius");
  c(a.load_share, "/load_share", "1", {0, 1 + 1e-9}, "mesh_phase mesh_number",
    "share of the meshes that come from one [[mesh]]: of planets the load sharing");
  c(a.pair, "/pair", "1", kPair, "pair", "number of the tooth pair: -1 following, 0 reference, +1 preceding");
  c(a.tooth_load, "/tooth_load", "N", kForce, "mesh_phase mesh_number pair",
    "normal force of each tooth pair");
  c(a.contact_pressure, "/contact_pressure", "Pa", kPressure, "mesh_phase mesh_number pair",
    "largest contact pressure of each pair inside its flanks; 0 where a corner or nothing touches");
  c(a.bearing_force, "/bearing_force", "N", kForce, "mesh_phase body_number xy",
    "force of a body on its bearing, of a planet on its pin, of a carrier on the ground");
  c(a.torque, "/torque", "N m", kMoment, "mesh_phase body_number",
    "torque of the drive, or of what holds the body, in its sense");
  c(a.mesh_stiffness, "/mesh_stiffness", "N m-1", kSpring, "mesh_phase mesh_number other_mesh",
    "frozen stiffness between the approaches of the meshes, without bearings");
}

// Left out of flanks without friction.
void describe_friction(Codec& c, SystemStaticResult& a) {
  if (!c.lists() && !a.settings.friction().acts()) return;
  c(a.friction_coefficient, "/friction_coefficient", "1", {0, 0.3}, "mesh_number", "coefficient of friction");
  c(a.friction_work, "/friction_work", "J", {0, 1e12}, "mesh_phase mesh_number",
    "work that friction takes in a mesh period with the forces of this phase",
    "sum of mu s F v, v the sliding per mesh period");
  c(a.efficiency, "/efficiency", "1", {-1e6, 1}, "body_number",
    "power out over power in, from the mean torques, while this member is at rest; of a train without carriers the same for all, of planets 0");
}

// What figures and pages take for granted: one phase, mesh and pair at least, and of each gear the drawing with its teeth.
void require_whole(const Codec& c, const SystemStaticResult& a) {
  const auto reject = [&](const auto&... words) { c.in()->reject(text(words...)); };
  const System& layout = a.settings.layout;
  if (a.mesh_phase.size() == 0) reject("dataset /mesh_phase holds no phase");
  if (a.mesh_phase.size() % a.hunting_periods != 0)
    reject("dataset /mesh_phase holds ", a.mesh_phase.size(),
           " phases, not a multiple of /hunting_periods = ", a.hunting_periods);
  if (a.pair.size() == 0) reject("dataset /pair holds no pair");
  if (layout.meshes.empty()) reject("dataset /mesh/phase holds no mesh");
  if (a.settings.gear.size() != layout.bodies.size())
    reject("dataset /body/gear has not one name for each body");
  const std::vector<std::string> gears = a.settings.gears();
  for (size_t b = 0; b < layout.bodies.size(); ++b) {
    const bool carrier = layout.bodies[b].kind == System::BodyKind::carrier;
    if (carrier ? !a.settings.gear[b].empty()
                : std::find(gears.begin(), gears.end(), a.settings.gear[b]) == gears.end())
      reject("dataset /body/gear holds '", a.settings.gear[b], "' of body ", b,
             "; it is one of /gear, or empty of a carrier");
    if (const BodyParameters* drawing = drawing_of(a, static_cast<int>(b));
        !carrier && drawing->design.teeth != layout.bodies[b].teeth)
      reject("dataset /body/teeth holds ", layout.bodies[b].teeth, " of body ", b, ", and its drawing has ",
             drawing->design.teeth);
  }
}

}  // namespace

void describe(Codec& c, SystemStaticResult& a) {
  describe_settings(c, a);
  c(a.contact_ratio, "/contact_ratio", "1", {0, 100, true}, "mesh_number",
    "profile contact ratio of the unloaded gears");
  describe_motions(c, a);
  describe_loads(c, a);
  describe_friction(c, a);
  c(a.least_gap, "/certificate/least_gap", "m", kLength, "mesh_phase", "least gap of a strip without force",
    "d >= 0 where p = 0 (with Eq. 18, 20)");
  c(a.least_force, "/certificate/least_force", "N", kForce, "mesh_phase", "least force of a strip in contact",
    "p >= 0 where d = 0 (with Eq. 18, 20)");
  c(a.torque_residual, "/certificate/torque_residual", "1", kPositive, "mesh_phase",
    "largest unbalance of a free body's rotation over the largest mesh force", "|L^T p - T / r|");
  describe_remarks(c, a.remarks);
  if (c.in()) require_whole(c, a);
}

std::string title(const SystemStaticResult& a) {
  return text("System at rest: ", a.settings.layout.bodies.size(), " bodies, ",
              a.settings.layout.meshes.size(), " meshes");
}

template struct ArtifactFile<SystemStaticResult>;

}  // namespace whine
