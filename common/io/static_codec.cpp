#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"

namespace whine {
namespace {

using namespace ranges;

void describe_curves(Codec& c, StaticResult& a) {
  const char* const without = a.mesh.on_bearings() ? ", without the bearings" : "";
  c(a.mesh_phase, "/mesh_phase", "1", kPhase, "mesh_phase",
    "mesh phase; 0: reference pair at the pitch point, 1: one mesh period");
  c(a.transmission_error, "/transmission_error", "m", kLength, "mesh_phase",
    "transmission error along the line of action, positive when the driver is ahead",
    "r1 theta1 + r2 theta2");
  c(a.unloaded_error, "/unloaded_transmission_error", "m", kLength, "mesh_phase",
    "transmission error without load: of what flanks deviate by");
  c(a.stiffness_secant, "/mesh_stiffness_secant", "N m-1", kSpring, "mesh_phase",
    text("secant mesh stiffness", without), "(T / r1) / (transmission_error - unloaded_transmission_error)");
  c(a.stiffness_tangent, "/mesh_stiffness_tangent", "N m-1", kSpring, "mesh_phase",
    text("tangent mesh stiffness at fixed phase, contact changes included", without),
    "d(T / r1) / d transmission_error");
  c(a.pair, "/pair", "1", kPair, "pair", "number of the tooth pair: -1 following, 0 reference, +1 preceding");
  c(a.tooth_load, "/tooth_load", "N", kForce, "mesh_phase pair", "normal force of each tooth pair");
  for (int g = 0; g < (c.lists() ? 1 : 2); ++g)
    if (c.lists() || a.mesh.bearing[g].elastic())
      c(a.bearing_force[g], of_body(c, a.mesh, g, "bearing_force"), "N", kForce, "mesh_phase xy",
        "force of the gear on its bearing; x, y: the driven gear stands above the driver, which turns counter-clockwise");
  c(a.contact_pressure, "/contact_pressure", "Pa", kPressure, "mesh_phase pair",
    "largest contact pressure of each pair inside its flanks; 0 where nothing touches (tooth_load is 0) and where a tip edge does (tooth_load is not), whose pressure is singular");
  c(a.contact_half_width, "/contact_half_width", "m", kSize, "mesh_phase pair",
    "half width of each contact inside the flanks, twice the standard deviation of its pressure");
}

void describe_root_stress(Codec& c, StaticResult& a) {
  const bool there = a.root_stress[0].size() > 0;
  for (int g = 0; g < (c.lists() ? 1 : 2); ++g)
    if (c.optional(of_body(c, a.mesh, g, "root_stress"), there))
      c(a.root_stress[g], of_body(c, a.mesh, g, "root_stress"), "Pa", kStress, "mesh_phase pair",
        "largest tangential stress along the root beside the loaded flank of each pair's tooth, tension positive",
        "sum over the pairs of root_stress/per_force of body.h5, and of root_stress/crack, times force");
  if (c.optional("/root_stress_max", there)) {
    c(a.root_stress_max, "/root_stress_max", "Pa", kStress, "gear",
      "largest root stress over the mesh cycle, beside the loaded flanks");
    c(a.root_stress_angle, "/root_stress_angle", "1", kRoll, "gear",
      "angle (rad) of the root's tangent there against the centre line of the tooth");
    c(a.root_stress_phase, "/root_stress_phase", "1", kPlace, "gear",
      "mesh phase of the tooth's pair then, 0 at the pitch point");
    if (c.optional("/root_stress_tooth", a.root_stress_tooth.size() > 0))
      c(a.root_stress_tooth, "/root_stress_tooth", "1", kTooth, "gear",
        "number of that tooth, counter-clockwise from tooth 0, where teeth differ or one is cracked");
  }
  c(a.loss_factor, "/loss_factor", "1", kPositive, "",
    "mean power lost by sliding over the power carried, per unit coefficient of friction",
    "H_V = mean of sum F |sliding per angle| / T");
}

constexpr Range kLost{0, 1e7};  // N m

// Left out of flanks without friction.
void describe_static_friction(Codec& c, StaticResult& a) {
  if (!c.lists() && !a.mesh.friction.acts()) return;
  c(a.friction_coefficient, "/friction_coefficient", "1", kShare, "", "coefficient of friction");
  c(a.friction_coupling, "/certificate/friction_coupling", "m", kSize, "",
    "largest change of a gap by what friction of the last forces moves, over all positions",
    "iteration for d = (A + E) p + e, E of friction: E times the last change of p");
  c(a.friction_loss, "/friction_loss", "N m", kLost, "mesh_phase",
    "work that friction takes per angle (rad) of the driver", "sum of mu s F (t1 - t2 z1 / z2)");
  for (int g = 0; g < (c.lists() ? 1 : 2); ++g)
    c(a.friction_moment[g], of_body(c, a.mesh, g, "friction_moment"), "N m", kMoment, "mesh_phase",
      "moment of friction about the axis of the gear, positive where it has the sense of the moment of the normal force, which brakes the driver and drives the driven gear",
      "sum of mu s F t");
  c(a.efficiency, "/efficiency", "1", {0, 1}, "",
    "of the mesh at rest: work given by the driven gear over that put into the driver",
    "1 - mean friction_loss / torque");
}

// What follows from the curves.
void describe_compliance(Codec& c, ComplianceSplit& a) {
  c(a.whole, "/compliance/mesh", "m N-1", kFlexibility, "", "of the mesh, mean over the period",
    "1 / mean_stiffness");
  c(a.body, "/compliance/body", "m N-1", kFlexibility, "gear",
    "part of it: twist of each gear's body between bore and root circle, all pairs together",
    "r_b^2 / (4 pi G b) (1 / r_bore^2 - 1 / r_root^2)");
  c(a.wider_body, "/compliance/body_of_wider_bore", "m N-1", kFlexibility, "gear",
    "the same with a bore a tenth larger, the root circle at most");
  c(a.contact, "/compliance/contact", "m N-1", kFlexibility, "",
    "part of it: Hertz's approach at the pitch point; what is left are the teeth");
  c(a.single, "/single_pair_stiffness", "N m-1", kSpring, "",
    "largest secant stiffness of a pair that carries all the load; 0: no pair ever does");
}

void describe_flank_pressure(Codec& c, FlankPressure& a) {
  c(a.smooth, "/flank_pressure_max", "Pa", kPressure, "",
    "largest contact pressure inside the flanks and clear of ridges, where a relief begins; 0: there is none");
  if (!c.optional("/ridge/cause", !a.ridge.empty())) return;
  c(a.ridge, "/ridge/cause", "",
    "what makes a ridge of the flank that contact runs over; pressure has no largest value there");
  c(a.on_ridge, "/ridge/pressure_of_strips", "Pa", kPressure, "", "what the strips show there");
  c(a.per_doubling, "/ridge/pressure_per_doubling", "Pa", kPressure, "",
    "what that grows by with each doubling of the strips");
}

void describe_rectangular_wave(Codec& c, RectangularWave& a) {
  const std::string at = "/rectangular_wave/";
  c(a.low, at + "low", "N m-1", kSpring, "",
    "secant stiffness in the middle of the zone of fewer pairs in nominal contact");
  c(a.high, at + "high", "N m-1", kSpring, "", "the same where there is one pair more");
  c(a.high_begin, at + "high_begin", "1", kSigned, "",
    "mesh phase at which a pair comes without load, and the zone of more pairs begins");
  c(a.high_end, at + "high_end", "1", kSigned, "", "mesh phase at which that zone ends");
}

void describe_reference_contact(Codec& c, ReferenceContact& a) {
  const std::string at = "/reference_contact/";
  if (!c.optional(at + "border", a.border.size() > 0)) return;
  c(a.border, at + "border", "m", kLength, "strip_border",
    "borders of the strips of the reference pair at mesh phase 0 along the flank, from the pitch point to the driver's tip");
  c(a.gap, at + "gap", "m", kLength, "strip", "gap of the unloaded flanks, mean over the strip");
  c(a.force, at + "force", "N", kForce, "strip", "normal force of each strip", "p of Eq. 18");
  c(a.separation, at + "separation", "m", kLength, "strip", "gap of the loaded flanks", "d of Eq. 18");
  c(a.approach, at + "approach", "m", kLength, "", "transmission error at this phase with strips");
}

}  // namespace

void describe(Codec& c, StaticResult& a) {
  describe_pair(c, a);
  describe_torque(c, a.torque);
  c(a.contact_ratio, "/contact_ratio", "1", {0, 100, true}, "",
    "profile contact ratio of the unloaded gears");
  describe_curves(c, a);
  describe_root_stress(c, a);
  describe_static_friction(c, a);
  c(a.transmission_error_harmonic, "/transmission_error_harmonic", "m", kLength, "harmonic",
    "mean, then amplitudes of the harmonics of the mesh frequency");
  c(a.stiffness_harmonic, "/mesh_stiffness_harmonic", "N m-1", kSpring, "harmonic",
    "mean, then amplitudes of the harmonics of the secant stiffness");
  c.numbers("harmonic", 0, "number of the harmonic of the mesh frequency; 0: the mean");
  describe_hunting(c, a.hunting_periods);
  if (c.lists() || (c.in() ? a.hunting_periods > 1 : a.transmission_error_order.size() > 0)) {
    c(a.transmission_error_order, "/transmission_error_order", "m", kLength, "order",
      "mean, then amplitudes of the harmonics of the hunting frequency");
    c.numbers("order", 0, "number of the harmonic of the hunting frequency; 0: the mean");
  }
  c(a.mean_stiffness, "/mean_stiffness", "N m-1", kStiff, "",
    "mean of the secant stiffness over a mesh period");
  describe_compliance(c, a.compliance);
  describe_flank_pressure(c, a.flank_pressure);
  describe_rectangular_wave(c, a.rectangular_wave);
  describe_reference_contact(c, a.reference_contact);
  c(a.least_gap, "/certificate/least_gap", "m", kLength, "",
    "least gap of a strip without force, over all positions", "d >= 0 where p = 0 (with Eq. 18, 20)");
  c(a.least_force, "/certificate/least_force", "N", kForce, "",
    "least force of a strip in contact, over all positions", "p >= 0 where d = 0 (with Eq. 18, 20)");
  c(a.torque_residual, "/certificate/torque_residual", "1", kPositive, "",
    "largest relative residual of the torque, over all positions", "|sum a p - T| / T");
  describe_backlash(c, a.backlash_margin);
  describe_remarks(c, a.remarks);
}

std::string title(const StaticResult& a) {
  return "Static transmission error: " + pair_title(a.mesh, a.torque);
}

template struct ArtifactFile<StaticResult>;

}  // namespace whine
