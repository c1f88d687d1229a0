#include "model/key_units.h"
#include "model/keys.h"

namespace whine {

using namespace units;

namespace {

ChoiceSlot plane_slot(bool& stress) {
  return {&stress, [](const void* at) { return *static_cast<const bool*>(at) ? 0 : 1; },
          [](void* at, int place) { *static_cast<bool*>(at) = place == 0; }};
}

}  // namespace

// clang-format off
KeyList keys(GearDesign& d, GearWords* words) {
  KeyList k("gear");
  if (words)
    k.add(&words->like, "like", kNone, "", {}, "another gear whose keys this one takes over, its modification too, its errors and its crack not; keys given here besides override");
  k.add(&d.teeth, "teeth", kNone, nullptr, {5, 2000}, "number of teeth");
  k.add(&d.module, "module_mm", kMillimetre, nullptr, {0.05, 200, false, "drawings have 0.05 to 50 mm; 0.003 would be 3 mm in metres"}, "module of the generating rack");
  k.add(&d.pressure_angle, "pressure_angle_deg", kDegree, nullptr, {5, 45}, "pressure angle of the generating rack");
  k.add(&d.profile_shift, "profile_shift", kNone, "0.0", {-3, 3}, "profile shift, in modules; of an internal gear towards its tips, that is inwards, with teeth that become thicker as those of an external gear do (ISO 21771)");
  k.add(&d.addendum, "addendum", kNone, "1.0", {0, 3, true}, "addendum, in modules");
  k.add(&d.dedendum, "dedendum", kNone, "1.25", {0, 3, true}, "dedendum, in modules");
  if (words) {
    k.add(&words->tip_diameter, "tip_diameter_mm", kMillimetre, "", {0, 1e6, true}, "diameter of the tip circle, in place of addendum: module (teeth + 2 profile_shift + 2 addendum), of an internal gear with - in place of +");
    k.add(&words->root_diameter, "root_diameter_mm", kMillimetre, "", {0, 1e6, true}, "diameter of the root circle, in place of dedendum: module (teeth + 2 profile_shift - 2 dedendum), of an internal gear module (teeth - 2 profile_shift + 2 dedendum)");
  }
  k.add(&d.rack_tip_radius, "rack_tip_radius", kNone, "0.38", {0, 1}, "tip radius of the rack, in modules; the root is the trochoid that this rack cuts; of an internal gear the radius of the fillet, an arc; default: cut to the largest that fits, which gear-scene then says");
  k.add(&d.tooth_thinning, "tooth_thinning_mm", kMillimetre, "0.0", {0, 50}, "arc taken off the tooth at the pitch circle, for backlash");
  k.add(&d.face_width, "face_width_mm", kMillimetre, nullptr, {0.05, 5000, false, "0.025 would be 25 mm in metres"}, "face width");
  k.add(&d.bore_radius, "bore_radius_mm", kMillimetre, nullptr, {0, 1e5, true}, "not of an internal gear: radius inside which the gear is as good as rigid: its shaft, hub or web. The body between it and the root circle twists, which all pairs in mesh share: often a fifth of the compliance, with a shaft's radius up to half").unless = &d.internal;
  k.begin_group(d.helical());
  k.add(&d.helix_angle, "helix_angle_deg", kDegree, "0.0", {0, 45, false, "which way the teeth lean says hand, \"right\" or \"left\""}, "helix angle at the reference circle; 0: a spur gear. Of a helical gear module, pressure angle, profile shift, addendum, dedendum and rack tip radius are those of the normal section, as on drawings; tooth_thinning_mm is along the reference circle");
  k.choice(d.hand, "hand", "right", "of the helix: gears in mesh have opposite hands, an internal gear that of its pinion");
  k.begin_group(d.internal, "_rim");
  k.add(&d.internal, "internal", kNone, "false", {}, "true: teeth on the inside of a ring, which meshes with an external gear of fewer teeth");
  k.add(&d.rim_outer_radius, "rim_outer_radius_mm", kMillimetre, "", {0, 1e5, true}, "of an internal gear, which needs it: radius outside which the ring is as good as rigid, its housing; what lies between it and the root circle bends and twists");
  k.begin_group(d.elastic_rim(), "_rim");
  k.add(&d.rim_radial_stiffness, "rim_radial_stiffness_N_mm2", kNewtonPerSquareMillimetre, "0.0", {0, 1e9}, "of an internal gear: stiffness along the radius of an even support of the outside of its rim, N/mm per mm of circumference, 20 or more; 0: rigid. It needs rim_tangential_stiffness_N_mm2");
  k.add(&d.rim_tangential_stiffness, "rim_tangential_stiffness_N_mm2", kNewtonPerSquareMillimetre, "0.0", {0, 1e9}, "the same along the circumference, which takes the torque");
  if (words) {
    KeyList rest("gear");
    rest.append(inertia_key(words->total_inertia));
    rest.add(&words->material, "material", kNone, nullptr, {}, "name of a [material.<name>] section");
    k.append(rest);
  }
  KeyList crack("crack");
  Crack& c = d.crack;
  crack.add(&c.tooth, "tooth", kNone, "0", {0, 1999}, "number of the cracked tooth, counter-clockwise from tooth 0");
  crack.add(&c.depth, "depth_mm", kMillimetre, nullptr, {0, 1000}, "length of a straight slit from the root of the driving flank into the tooth; 0: none; a quarter of a module must be left");
  crack.add(&c.start, "start_deg", kDegree, "30", {1, 89}, "where on the fillet: angle of the fillet's tangent there against the tooth's centre line");
  crack.add(&c.angle, "angle_deg", kDegree, "60", {5, 135}, "direction against the tooth's centre line: 0 to the axis, 90 straight across; 90 - start_deg is square to the fillet");
  k.append_group(crack, c.depth > 0, "_crack");
  return k;
}

KeyList inertia_key(double& total_inertia) {
  KeyList k("gear");
  k.add(&total_inertia, "total_inertia_kgm2", kInertia, "0.0", {0, 1e9}, "inertia of the whole gear about its axis; what the body lacks is lumped on the hub. 0: as drawn, the body between bore and tip alone; a system with body = \"rigid\" needs it, or equivalent_mass_kg");
  return k;
}

KeyList keys(FlankModification& m) {
  KeyList k("modification");
  k.add(&m.tip.amount, "tip_relief_um", kMicrometre, "0.0", {0, 1000}, "material taken off at the tip edge, normal to the driving flank");
  k.add(&m.tip.start_roll, "tip_relief_start_deg", kDegree, "0", {0, 90}, "roll angle at which it starts; 0: not given; of the three ways to say the start one is given");
  k.add(&m.tip.start_radius, "tip_relief_start_radius_mm", kMillimetre, "0", {0, 1e5}, "the same as a radius");
  k.add(&m.tip.length, "tip_relief_length_mm", kMillimetre, "0", {0, 1e5}, "the same as the length of roll (base radius times roll angle) from the start to the tip edge");
  k.choice(m.tip.shape, "tip_relief_shape", "linear", "how it grows with the roll angle");
  k.add(&m.root.amount, "root_relief_um", kMicrometre, "0.0", {0, 1000}, "material taken off at the foot of the involute, normal to the driving flank");
  k.add(&m.root.start_roll, "root_relief_start_deg", kDegree, "0", {0, 90}, "roll angle at which it starts; 0: not given; of the three ways to say the start one is given");
  k.add(&m.root.start_radius, "root_relief_start_radius_mm", kMillimetre, "0", {0, 1e5}, "the same as a radius");
  k.add(&m.root.length, "root_relief_length_mm", kMillimetre, "0", {0, 1e5}, "the same as the length of roll (base radius times roll angle) from the start to the foot of the involute");
  k.choice(m.root.shape, "root_relief_shape", "linear", "how it grows with the roll angle");
  k.add(&m.crowning, "crowning_um", kMicrometre, "0.0", {-1000, 1000}, "profile crowning: a parabola, 0 midway in the roll angle, this much taken off at both ends of the involute");
  k.add(&m.slope, "slope_um", kMicrometre, "0.0", {-1000, 1000}, "profile slope: linear in the roll angle, 0 at the foot of the involute, this much taken off at the tip");
  k.add(&m.points, "points", kNone, "", {-1000, 1000}, "[[roll angle in degrees, micrometres taken off], ...], ascending; monotone cubics between, constant outside; adds to the others");
  return k;
}

KeyList keys(LeadModification& m) {
  KeyList k("modification");
  k.add(&m.crowning, "lead_crowning_um", kMicrometre, "0.0", {-1000, 1000}, "lead crowning: a parabola over the face, 0 in its middle, this much taken off at both ends");
  k.add(&m.slope, "lead_slope_um", kMicrometre, "0.0", {-1000, 1000}, "lead slope: linear over the face, this much taken off at the end that faces a viewer who sees the driver turn counter-clockwise, 0 at the other");
  k.add(&m.end_relief, "end_relief_um", kMicrometre, "0.0", {0, 1000}, "material taken off at both ends of the face, linear; it needs end_relief_length_mm");
  k.add(&m.end_relief_length, "end_relief_length_mm", kMillimetre, "0.0", {0, 2500}, "from where the end relief starts to the end of the face; half of the face width at most");
  return k;
}

KeyList keys(ToothErrors& e) {
  KeyList k("error");
  k.add(&e.single_pitch, "single_pitch_um", kMicrometre, "", {-1000, 1000}, "a number for each tooth: deviation of the pitch from the flank before (of tooth 0 the last) to this one, along the reference circle; they sum up to 0. Teeth count counter-clockwise on all gears, the driver turns so; tooth 0 of both gears of a pair is in mesh at phase 0. Positive, here and below: material stands, contact begins early; in a system, whose gears may work with either flank, a positive pitch is counter-clockwise on both, and every planet has the list of its gear").each = "tooth";
  k.add(&e.cumulative_pitch, "cumulative_pitch_um", kMicrometre, "", {-1000, 1000}, "the same as place of each flank, along the reference circle; adds to single_pitch_um").each = "tooth";
  k.add(&e.eccentricity, "eccentricity_um", kMicrometre, "0.0", {0, 1000}, "distance of the toothing's axis from that of rotation; the run-out is about twice it");
  k.add(&e.eccentric_tooth, "eccentricity_tooth", kNone, "0.0", {-2000, 2000}, "number of the tooth towards which; between two teeth a fraction");
  k.add(&e.profile_slope, "profile_slope_um", kMicrometre, "", {-1000, 1000}, "a number for each tooth: rise of its profile from the foot of the involute to the tip edge; 0 at the reference circle").each = "tooth";
  k.add(&e.profile_form, "profile_form_um", kMicrometre, "", {-1000, 1000}, "a number for each tooth: sine waves along its profile, from peak to valley; 0 at the reference circle, where positive ones rise to the tip").each = "tooth";
  k.add(&e.profile_form_waves, "profile_form_waves", kNone, "3.0", {0.5, 100}, "number of these waves from the foot of the involute to the tip edge");
  k.add(&e.iso_class, "iso_class", kNone, "0", {0, 11}, "deviations of pitch, profile slope and form drawn at random within this class of ISO 1328-1:2013; 0: none; adds to the lists");
  k.add(&e.iso_share, "iso_share", kNone, "1.0", {0, 1, true}, "share of the class's limits that the draw takes up: of pitch, and of profile, the limit that is used most just has it");
  k.add(&e.seed, "seed", kNone, "1", {0, 2147483647}, "of the draw; two gears with one seed have errors of one kind; the planets of a gear have this seed and those that follow");
  return k;
}

KeyList error_file_key(std::string& file) {
  KeyList k("error");
  k.add(&file, "file", kNone, "", {}, "measured errors, path from the folder of the scene: a .toml with the lists above, or a .csv whose columns are named tooth and as those lists; keys given here besides override");
  return k;
}

KeyList keys(Material& m) {
  KeyList k("material");
  k.add(&m.youngs_modulus, "youngs_modulus_GPa", kGigapascal, nullptr, {0, 2000, true}, "Young's modulus");
  k.add(&m.poisson_ratio, "poisson_ratio", kNone, nullptr, {0, 0.495}, "Poisson's ratio");
  k.add(&m.density, "density_kgm3", kDensity, nullptr, {100, 30000, false, "steel has 7850; 7.85 would be its g/cm3"}, "density");
  k.add(plane_slot(m.plane_stress), "plane", kNone, nullptr, {}, "plane state of the whole body: stress for face widths up to about 5 tooth thicknesses (8 modules), strain for wider ones, 10 % stiffer (Cornell 1981); that of the contact is contact_plane in [[mesh]]").choices = "stress strain";
  return k;
}

KeyList bearing_gear_key(std::string& gear) {
  KeyList k("bearing");
  k.add(&gear, "gear", kNone, nullptr, {}, "name of the gear or carrier that it carries; without a bearing it turns on a rigid axis");
  return k;
}

KeyList keys(Bearing& b) {
  KeyList k("bearing");
  k.add(&b.stiffness, "stiffness_N_um", kNewtonPerMicrometre, nullptr, {0, 1e6, true, "nothing else holds the gear; take the section out for a rigid axis"}, "radial stiffness of all that carries the gear (bearings, shaft, housing), alike in all directions");
  k.add(&b.damping, "damping_Ns_m", kNewtonSecondPerMetre, "0.0", {0, 1e7}, "radial viscous damping of the same");
  k.add(&b.mass, "mass_kg", kKilogram, "0.0", {0, 1e6}, "mass of all that moves with the gear's hub, its body included; 0: as drawn, the body between bore and tip alone; of a carrier, and of a system with body = \"rigid\", it is required");
  return k;
}
// clang-format on

}  // namespace whine
