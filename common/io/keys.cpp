#include "io/keys.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <sstream>

#include "base/error.h"
#include "io/ranges.h"
#include "io/suggestion.h"
#include "io/system_keys.h"

namespace whine {
namespace {

using namespace units;
constexpr Unit kMillimetre{"_mm", "m", 1, 1000};
constexpr Unit kMicrometre{"_um", "m", 1, 1e6};
constexpr Unit kCornerDegree{"", "rad", std::numbers::pi, 180};
constexpr Unit kGigapascal{"_GPa", "Pa", 1e9};
constexpr Unit kDensity{"_kgm3", "kg m-3"};
constexpr Unit kNewtonPerSquareMillimetre{"_N_mm2", "N m-2", 1e6};
constexpr Unit kPerSecond{"_per_s", "s-1"};
constexpr Unit kSecond{"_s", "s"};
constexpr Unit kHertzUnit{"_Hz", "Hz"};
constexpr Unit kKilohertz{"_kHz", "Hz", 1000};
constexpr Unit kNewtonSecondPerMetre{"_Ns_m", "N s m-1"};
constexpr Unit kMillipascalSecond{"_mPas", "Pa s", 1, 1000};

// NOLINTNEXTLINE(readability-function-size): a table of data
std::vector<Key> make_keys() {
  using V = SceneParameters;
  // clang-format off
  return {
    {KeyGroup::title, "", "title", kNone, "", 0, 0, false, "",
     "what the scene is; stands on figures",
     [](V& v) -> Slot { return &v.title; }},

    {KeyGroup::reference, "gear", "like", kNone, "", 0, 0, false, "",
     "another gear whose keys this one takes over, its modification too, its errors and its crack not; keys given here besides override",
     [](V& v) -> Slot { return &v.like; }},
    {KeyGroup::design, "gear", "teeth", kNone, nullptr, 5, 2000, false, "",
     "number of teeth",
     [](V& v) -> Slot { return &v.design.teeth; }},
    {KeyGroup::design, "gear", "module_mm", kMillimetre, nullptr, 0.05, 200, false, "",
     "module of the generating rack",
     [](V& v) -> Slot { return &v.design.module; },
     "drawings have 0.05 to 50 mm; 0.003 would be 3 mm in metres"},
    {KeyGroup::design, "gear", "pressure_angle_deg", kDegree, nullptr, 5, 45, false, "",
     "pressure angle of the generating rack",
     [](V& v) -> Slot { return &v.design.pressure_angle; }},
    {KeyGroup::design, "gear", "profile_shift", kNone, "0.0", -3, 3, false, "",
     "profile shift, in modules; of an internal gear towards its tips, that is inwards, with teeth that become thicker as those of an external gear do (ISO 21771)",
     [](V& v) -> Slot { return &v.design.profile_shift; }},
    {KeyGroup::design, "gear", "addendum", kNone, "1.0", 0, 3, true, "",
     "addendum, in modules",
     [](V& v) -> Slot { return &v.design.addendum; }},
    {KeyGroup::design, "gear", "dedendum", kNone, "1.25", 0, 3, true, "",
     "dedendum, in modules",
     [](V& v) -> Slot { return &v.design.dedendum; }},
    {KeyGroup::diameter, "gear", "tip_diameter_mm", kMillimetre, "", 0, 1e6, true, "",
     "diameter of the tip circle, in place of addendum: module (teeth + 2 profile_shift + 2 addendum), of an internal gear with - in place of +",
     [](V& v) -> Slot { return &v.tip_diameter; }},
    {KeyGroup::diameter, "gear", "root_diameter_mm", kMillimetre, "", 0, 1e6, true, "",
     "diameter of the root circle, in place of dedendum: module (teeth + 2 profile_shift - 2 dedendum), of an internal gear module (teeth - 2 profile_shift + 2 dedendum)",
     [](V& v) -> Slot { return &v.root_diameter; }},
    {KeyGroup::design, "gear", "rack_tip_radius", kNone, "0.38", 0, 1, false, "",
     "tip radius of the rack, in modules; the root is the trochoid that this rack cuts; of an internal gear the radius of the fillet, an arc; default: cut to the largest that fits, which gear-scene then says",
     [](V& v) -> Slot { return &v.design.rack_tip_radius; }},
    {KeyGroup::design, "gear", "tooth_thinning_mm", kMillimetre, "0.0", 0, 50, false, "",
     "arc taken off the tooth at the pitch circle, for backlash",
     [](V& v) -> Slot { return &v.design.tooth_thinning; }},
    {KeyGroup::design, "gear", "face_width_mm", kMillimetre, nullptr, 0.05, 5000, false, "",
     "face width",
     [](V& v) -> Slot { return &v.design.face_width; },
     "0.025 would be 25 mm in metres"},
    {KeyGroup::bore, "gear", "bore_radius_mm", kMillimetre, nullptr, 0, 1e5, true, "",
     "not of an internal gear: radius inside which the gear is as good as rigid: its shaft, hub or web. The body between it and the root circle twists, which all pairs in mesh share: often a fifth of the compliance, with a shaft's radius up to half",
     [](V& v) -> Slot { return &v.design.bore_radius; }},
    {KeyGroup::rim, "gear", "internal", kNone, "false", 0, 0, false, "",
     "true: teeth on the inside of a ring, which meshes with an external gear of fewer teeth",
     [](V& v) -> Slot { return &v.design.internal; }},
    {KeyGroup::rim, "gear", "rim_outer_radius_mm", kMillimetre, "", 0, 1e5, true, "",
     "of an internal gear, which needs it: radius outside which the ring is as good as rigid, its housing; what lies between it and the root circle bends and twists",
     [](V& v) -> Slot { return &v.design.rim_outer_radius; }},
    {KeyGroup::rim_support, "gear", "rim_radial_stiffness_N_mm2", kNewtonPerSquareMillimetre, "0.0", 0, 1e9, false, "",
     "of an internal gear: stiffness along the radius of an even support of the outside of its rim, N/mm per mm of circumference, 20 or more; 0: rigid. It needs rim_tangential_stiffness_N_mm2",
     [](V& v) -> Slot { return &v.design.rim_radial_stiffness; }},
    {KeyGroup::rim_support, "gear", "rim_tangential_stiffness_N_mm2", kNewtonPerSquareMillimetre, "0.0", 0, 1e9, false, "",
     "the same along the circumference, which takes the torque",
     [](V& v) -> Slot { return &v.design.rim_tangential_stiffness; }},
    {KeyGroup::inertia, "gear", "total_inertia_kgm2", kInertia, "0.0", 0, 1e9, false, "",
     "inertia of the whole gear about its axis; what the body lacks is lumped on the hub. 0: as drawn, the body between bore and tip alone; a system with body = \"rigid\" needs it, or equivalent_mass_kg",
     [](V& v) -> Slot { return &v.total_inertia; }},
    {KeyGroup::reference, "gear", "material", kNone, nullptr, 0, 0, false, "",
     "name of a [material.<name>] section",
     [](V& v) -> Slot { return &v.material_name; }},

    {KeyGroup::modification, "modification", "tip_relief_um", kMicrometre, "0.0", 0, 1000, false, "",
     "material taken off at the tip edge, normal to the driving flank",
     [](V& v) -> Slot { return &v.modification.tip.amount; }},
    {KeyGroup::modification, "modification", "tip_relief_start_deg", kDegree, "0", 0, 90, false, "",
     "roll angle at which it starts; 0: not given; of the three ways to say the start one is given",
     [](V& v) -> Slot { return &v.modification.tip.start_roll; }},
    {KeyGroup::modification, "modification", "tip_relief_start_radius_mm", kMillimetre, "0", 0, 1e5, false, "",
     "the same as a radius",
     [](V& v) -> Slot { return &v.modification.tip.start_radius; }},
    {KeyGroup::modification, "modification", "tip_relief_length_mm", kMillimetre, "0", 0, 1e5, false, "",
     "the same as the length of roll (base radius times roll angle) from the start to the tip edge",
     [](V& v) -> Slot { return &v.modification.tip.length; }},
    {KeyGroup::modification, "modification", "tip_relief_shape", kNone, "linear", 0, 0, false, kWordsOf<ReliefShape>,
     "how it grows with the roll angle",
     [](V& v) -> Slot { return choice_slot(v.modification.tip.shape); }},
    {KeyGroup::modification, "modification", "root_relief_um", kMicrometre, "0.0", 0, 1000, false, "",
     "material taken off at the foot of the involute, normal to the driving flank",
     [](V& v) -> Slot { return &v.modification.root.amount; }},
    {KeyGroup::modification, "modification", "root_relief_start_deg", kDegree, "0", 0, 90, false, "",
     "roll angle at which it starts; 0: not given; of the three ways to say the start one is given",
     [](V& v) -> Slot { return &v.modification.root.start_roll; }},
    {KeyGroup::modification, "modification", "root_relief_start_radius_mm", kMillimetre, "0", 0, 1e5, false, "",
     "the same as a radius",
     [](V& v) -> Slot { return &v.modification.root.start_radius; }},
    {KeyGroup::modification, "modification", "root_relief_length_mm", kMillimetre, "0", 0, 1e5, false, "",
     "the same as the length of roll (base radius times roll angle) from the start to the foot of the involute",
     [](V& v) -> Slot { return &v.modification.root.length; }},
    {KeyGroup::modification, "modification", "root_relief_shape", kNone, "linear", 0, 0, false, kWordsOf<ReliefShape>,
     "how it grows with the roll angle",
     [](V& v) -> Slot { return choice_slot(v.modification.root.shape); }},
    {KeyGroup::modification, "modification", "crowning_um", kMicrometre, "0.0", -1000, 1000, false, "",
     "profile crowning: a parabola, 0 midway in the roll angle, this much taken off at both ends of the involute",
     [](V& v) -> Slot { return &v.modification.crowning; }},
    {KeyGroup::modification, "modification", "slope_um", kMicrometre, "0.0", -1000, 1000, false, "",
     "profile slope: linear in the roll angle, 0 at the foot of the involute, this much taken off at the tip",
     [](V& v) -> Slot { return &v.modification.slope; }},
    {KeyGroup::modification, "modification", "points", kNone, "", -1000, 1000, false, "",
     "[[roll angle in degrees, micrometres taken off], ...], ascending; monotone cubics between, constant outside; adds to the others",
     [](V& v) -> Slot { return &v.modification.points; }},

    {KeyGroup::error, "error", "single_pitch_um", kMicrometre, "", -1000, 1000, false, "",
     "a number for each tooth: deviation of the pitch from the flank before (of tooth 0 the last) to this one, along the reference circle; they sum up to 0. Teeth count counter-clockwise on all gears, the driver turns so; tooth 0 of both gears of a pair is in mesh at phase 0. Positive, here and below: material stands, contact begins early; in a system, whose gears may work with either flank, a positive pitch is counter-clockwise on both, and every planet has the list of its gear",
     [](V& v) -> Slot { return ToothList{&v.errors.single_pitch}; }},
    {KeyGroup::error, "error", "cumulative_pitch_um", kMicrometre, "", -1000, 1000, false, "",
     "the same as place of each flank, along the reference circle; adds to single_pitch_um",
     [](V& v) -> Slot { return ToothList{&v.errors.cumulative_pitch}; }},
    {KeyGroup::error, "error", "eccentricity_um", kMicrometre, "0.0", 0, 1000, false, "",
     "distance of the toothing's axis from that of rotation; the run-out is about twice it",
     [](V& v) -> Slot { return &v.errors.eccentricity; }},
    {KeyGroup::error, "error", "eccentricity_tooth", kNone, "0.0", -2000, 2000, false, "",
     "number of the tooth towards which; between two teeth a fraction",
     [](V& v) -> Slot { return &v.errors.eccentric_tooth; }},
    {KeyGroup::error, "error", "profile_slope_um", kMicrometre, "", -1000, 1000, false, "",
     "a number for each tooth: rise of its profile from the foot of the involute to the tip edge; 0 at the reference circle",
     [](V& v) -> Slot { return ToothList{&v.errors.profile_slope}; }},
    {KeyGroup::error, "error", "profile_form_um", kMicrometre, "", -1000, 1000, false, "",
     "a number for each tooth: sine waves along its profile, from peak to valley; 0 at the reference circle, where positive ones rise to the tip",
     [](V& v) -> Slot { return ToothList{&v.errors.profile_form}; }},
    {KeyGroup::error, "error", "profile_form_waves", kNone, "3.0", 0.5, 100, false, "",
     "number of these waves from the foot of the involute to the tip edge",
     [](V& v) -> Slot { return &v.errors.profile_form_waves; }},
    {KeyGroup::error, "error", "iso_class", kNone, "0", 0, 11, false, "",
     "deviations of pitch, profile slope and form drawn at random within this class of ISO 1328-1:2013; 0: none; adds to the lists",
     [](V& v) -> Slot { return &v.errors.iso_class; }},
    {KeyGroup::error, "error", "iso_share", kNone, "1.0", 0, 1, true, "",
     "share of the class's limits that the draw takes up: of pitch, and of profile, the limit that is used most just has it",
     [](V& v) -> Slot { return &v.errors.iso_share; }},
    {KeyGroup::error, "error", "seed", kNone, "1", 0, 2147483647, false, "",
     "of the draw; two gears with one seed have errors of one kind; the planets of a gear have this seed and those that follow",
     [](V& v) -> Slot { return &v.errors.seed; }},
    {KeyGroup::error_file, "error", "file", kNone, "", 0, 0, false, "",
     "measured errors, path from the folder of the scene: a .toml with the lists above, or a .csv whose columns are named tooth and as those lists; keys given here besides override",
     [](V& v) -> Slot { return &v.error_file; }},

    {KeyGroup::crack, "crack", "tooth", kNone, "0", 0, 1999, false, "",
     "number of the cracked tooth, counter-clockwise from tooth 0",
     [](V& v) -> Slot { return &v.design.crack.tooth; }},
    {KeyGroup::crack, "crack", "depth_mm", kMillimetre, nullptr, 0, 1000, false, "",
     "length of a straight slit from the root of the driving flank into the tooth; 0: none; a quarter of a module must be left",
     [](V& v) -> Slot { return &v.design.crack.depth; }},
    {KeyGroup::crack, "crack", "start_deg", kDegree, "30", 1, 89, false, "",
     "where on the fillet: angle of the fillet's tangent there against the tooth's centre line",
     [](V& v) -> Slot { return &v.design.crack.start; }},
    {KeyGroup::crack, "crack", "angle_deg", kDegree, "60", 5, 135, false, "",
     "direction against the tooth's centre line: 0 to the axis, 90 straight across; 90 - start_deg is square to the fillet",
     [](V& v) -> Slot { return &v.design.crack.angle; }},

    {KeyGroup::material, "material", "youngs_modulus_GPa", kGigapascal, nullptr, 0, 2000, true, "",
     "Young's modulus",
     [](V& v) -> Slot { return &v.material.youngs_modulus; }},
    {KeyGroup::material, "material", "poisson_ratio", kNone, nullptr, 0, 0.495, false, "",
     "Poisson's ratio",
     [](V& v) -> Slot { return &v.material.poisson_ratio; }},
    {KeyGroup::material, "material", "density_kgm3", kDensity, nullptr, 100, 30000, false, "",
     "density",
     [](V& v) -> Slot { return &v.material.density; },
     "steel has 7850; 7.85 would be its g/cm3"},
    {KeyGroup::material, "material", "plane", kNone, nullptr, 0, 0, false, "stress strain",
     "plane state of the whole body: stress for face widths up to about 5 tooth thicknesses (8 modules), strain for wider ones, 10 % stiffer (Cornell 1981); that of the contact is contact_plane in [[mesh]]",
     [](V& v) -> Slot { return PlaneSlot{&v.material.plane_stress}; }},

    {KeyGroup::mesh, "mesh", "driver", kNone, nullptr, 0, 0, false, "",
     "name of the driving gear",
     [](V& v) -> Slot { return &v.mesh.gear[0]; }},
    {KeyGroup::mesh, "mesh", "driven", kNone, nullptr, 0, 0, false, "",
     "name of the driven gear",
     [](V& v) -> Slot { return &v.mesh.gear[1]; }},
    {KeyGroup::mesh, "mesh", "centre_distance_mm", kMillimetre, nullptr, 0, 1e5, true, "",
     "distance of the two axes",
     [](V& v) -> Slot { return &v.mesh.centre_distance; }},
    {KeyGroup::mesh, "mesh", "corner_contact", kCornerDegree, "true", 0, 90, false, "",
     "tip edge on a flank, off the line of action: true, false, or the largest angle between the normals in degrees",
     [](V& v) -> Slot { return &v.mesh.corner; }},
    {KeyGroup::contact_plane, "mesh", "contact_plane", kNone, "strain", 0, 0, false, kWordsOf<ContactPlane>,
     "plane state of the contact alone (pressure, width, local approach): strain inside a wide face; body: as each gear's [material] plane",
     [](V& v) -> Slot { return choice_slot(v.mesh.contact_plane); }},

    {KeyGroup::bearing_gear, "bearing", "gear", kNone, nullptr, 0, 0, false, "",
     "name of the gear or carrier that it carries; without a bearing it turns on a rigid axis",
     [](V& v) -> Slot { return &v.bearing_gear; }},
    {KeyGroup::bearing, "bearing", "stiffness_N_um", kNewtonPerMicrometre, nullptr, 0, 1e6, true, "",
     "radial stiffness of all that carries the gear (bearings, shaft, housing), alike in all directions",
     [](V& v) -> Slot { return &v.bearing.stiffness; },
     "nothing else holds the gear; take the section out for a rigid axis"},
    {KeyGroup::bearing, "bearing", "damping_Ns_m", kNewtonSecondPerMetre, "0.0", 0, 1e7, false, "",
     "radial viscous damping of the same",
     [](V& v) -> Slot { return &v.bearing.damping; }},
    {KeyGroup::bearing, "bearing", "mass_kg", kKilogram, "0.0", 0, 1e6, false, "",
     "mass of all that moves with the gear's hub, its body included; 0: as drawn, the body between bore and tip alone; of a carrier, and of a system with body = \"rigid\", it is required",
     [](V& v) -> Slot { return &v.bearing.mass; }},

    {KeyGroup::friction, "friction", "law", kNone, "constant", 0, 0, false, kWordsOf<FrictionLaw>,
     "coefficient of friction: a number, or Schlenk's formula of load, speed, oil and roughness",
     [](V& v) -> Slot { return choice_slot(v.mesh.friction.law); }},
    {KeyGroup::friction, "friction", "coefficient", kNone, "0.0", 0, 0.3, false, "",
     "of law = \"constant\": friction force over normal force; 0: no friction",
     [](V& v) -> Slot { return &v.mesh.friction.coefficient; }},
    {KeyGroup::friction, "friction", "smoothing", kNone, "0.01", 1e-6, 1, false, "",
     "sliding speed v0 over the speed of the pitch line. Friction is mu N v / sqrt(v^2 + v0^2): it changes its sign smoothly at the pitch point",
     [](V& v) -> Slot { return &v.mesh.friction.smoothing; }},
    {KeyGroup::friction, "friction", "viscosity_mPas", kMillipascalSecond, "0.0", 0, 1e6, false, "",
     "of law = \"schlenk\", which requires it: dynamic viscosity of the oil at the temperature of the mesh",
     [](V& v) -> Slot { return &v.mesh.friction.viscosity; }},
    {KeyGroup::friction, "friction", "roughness_um", kMicrometre, "0.0", 0, 100, false, "",
     "of law = \"schlenk\", which requires it: arithmetic roughness Ra of the flanks, mean of both gears",
     [](V& v) -> Slot { return &v.mesh.friction.roughness; }},
    {KeyGroup::friction, "friction", "lubricant_factor", kNone, "1.0", 0.1, 10, false, "",
     "of law = \"schlenk\": X_L, 1 for mineral oils",
     [](V& v) -> Slot { return &v.mesh.friction.lubricant_factor; }},
    {KeyGroup::friction, "friction", "static_frequency_Hz", kHertzUnit, "0.0", 0, 1e6, false, "",
     "of law = \"schlenk\", which requires it: mesh frequency at which the coefficient of the pair at rest is taken",
     [](V& v) -> Slot { return &v.mesh.friction.static_frequency; }},

    {KeyGroup::damping, "damping", "rayleigh_mass_per_s", kPerSecond, "0.0", 0, 1e6, false, "",
     "mu of Eq. 21: multiplies the mass matrix",
     [](V& v) -> Slot { return &v.damping.rayleigh_mass; }},
    {KeyGroup::damping, "damping", "rayleigh_stiffness_s", kSecond, "7.7e-6", 0, 1, false, "",
     "eta of Eq. 21: multiplies the stiffness matrix",
     [](V& v) -> Slot { return &v.damping.rayleigh_stiffness; }},
    {KeyGroup::damping, "damping", "undamped_depth_mm", kMillimetre, "module / 6", 0, 1000, true, "",
     "half-plane compliance relative to this depth is instantaneous; default: of a system by its largest module",
     [](V& v) -> Slot { return &v.damping.undamped_depth; }},
    {KeyGroup::damping, "damping", "bearing_ratio", kNone, "0.005", 0, 1, false, "",
     "damping ratio of the torque damper at each axis",
     [](V& v) -> Slot { return &v.damping.bearing_ratio; }},

    {KeyGroup::load, "operation", "torque_Nm", kNewtonMetre, nullptr, 0, 999999, true, "",
     "torque on the driver: a number or a list; the first sets the bearing dampers",
     [](V& v) -> Slot { return &v.operation.torques; },
     "without load nothing presses the teeth together; a small torque shows them as good as unloaded"},
    {KeyGroup::operation, "operation", "mesh_frequency_Hz", kHertzUnit, nullptr, 1, 1e6, false, "",
     "speeds of a sweep: { from = , to = , step = }",
     [](V& v) -> Slot {
       return RangeSlot{&v.operation.frequency_from, &v.operation.frequency_to, &v.operation.frequency_step};
     },
     "slower, a mesh period takes more than 250000 time steps at the default rate; the static stage is the limit of zero speed"},

    {KeyGroup::level, "fidelity", "body", kNone, "modal", 0, 0, false, kWordsOf<BodyModel>,
     "what of the elastic body moves by itself; rigid: of systems alone, one spring for each mesh, natural modes only",
     [](V& v) -> Slot { return choice_slot(v.fidelity.body); }},
    {KeyGroup::contact_level, "fidelity", "contact", kNone, "strips", 0, 0, false, kWordsOf<ContactModel>,
     "contact of a tooth pair: one force and Hertz's closed law, or pressure on strips",
     [](V& v) -> Slot { return choice_slot(v.fidelity.contact); }},
    {KeyGroup::level, "fidelity", "integrator", kNone, "exact", 0, 0, false, kWordsOf<Integrator>,
     "time integration: Newmark (Eq. 8), or modal propagators",
     [](V& v) -> Slot { return choice_slot(v.fidelity.integrator); }},
    {KeyGroup::body, "fidelity", "modes", kNone, "61", 1, 100000, false, "",
     "elastic modes of the whole gear; a doublet is never cut (rounded up); without meaning to body = \"full\", which takes all (-1 in its artifacts)",
     [](V& v) -> Slot { return &v.body.modes; }},

    {KeyGroup::body, "discretisation", "element_mm", kMillimetre, "module / 7.5", 0, 100, true, "",
     "element size on the flank; default: of each gear by its own module, so that the error is that of every module",
     [](V& v) -> Slot { return &v.body.element_size; }},
    {KeyGroup::body, "discretisation", "element_order", kNone, "2", 1, 2, false, "",
     "order of the elements: 1 (4 nodes) or 2 (9 nodes)",
     [](V& v) -> Slot { return &v.body.element_order; }},
    {KeyGroup::near_field, "discretisation", "near_field", kNone, "subtraction", 0, 0, false, kWordsOf<NearField>,
     "how the half-plane at the contact joins the finite elements: subtracted, or matched at a depth as in P2000",
     [](V& v) -> Slot { return choice_slot(v.body.near_field); }},
    {KeyGroup::near_field, "discretisation", "matching_depth_mm", kMillimetre, "module / 3", 0, 100, true, "",
     "depth below the flank at which the two are matched; must stay inside the tooth; only with near_field = \"matching\"",
     [](V& v) -> Slot { return &v.body.matching_depth; }},
    {KeyGroup::contact, "discretisation", "strips", kNone, "8", 3, 1001, false, "",
     "pressure strips across the contact width at the mean load; a candidate zone holds whole fours of them",
     [](V& v) -> Slot { return &v.contact.strips; }},
    {KeyGroup::contact, "discretisation", "positions", kNone, "0", 8, 65536, false, "",
     "positions of the static stage per mesh period; 0: as steps_per_period, 128 at least, for teeth that differ fewer (16 at least), so that there are 16384 in all",
     [](V& v) -> Slot { return &v.contact.positions; },
     "a mesh period in fewer points has no harmonics; 0 takes the default", true},
    {KeyGroup::time, "discretisation", "steps_per_period", kNone, "128", 8, 65536, false, "",
     "stored samples per mesh period; steps are doubled until min_sample_rate_kHz is reached",
     [](V& v) -> Slot { return &v.time.steps_per_period; }},
    {KeyGroup::time, "discretisation", "min_sample_rate_kHz", kKilohertz, "250", 0, 1e6, false, "",
     "least rate of time steps",
     [](V& v) -> Slot { return &v.time.min_sample_rate; }},
    {KeyGroup::time, "discretisation", "periodicity", kNone, "1e-5", 1e-12, 1, false, "",
     "relative change of the state over a mesh period at which a speed counts as steady; round-off is 1e-14",
     [](V& v) -> Slot { return &v.time.periodicity; }},
    {KeyGroup::time, "discretisation", "steady_state", kNone, "extrapolate", 0, 0, false, kWordsOf<SteadyState>,
     "start where the last speeds lead and, once close, skip the rest of a transient, or integrate all of it, as a rig would run it; the same orbits but for a speed or two at the end of a branch",
     [](V& v) -> Slot { return choice_slot(v.time.steady_state); }},
  };
  // clang-format on
}

constexpr const char* kLargestAngle = "_largest_angle";

}  // namespace

std::string Key::si_name() const {
  const std::string whole(name), suffix(unit.suffix);
  return whole.substr(0, whole.size() - suffix.size());
}

const std::vector<Key>& scene_keys() {
  static const std::vector<Key> keys = [] {
    std::vector<Key> all = make_keys();
    const std::vector<Key> of_systems = system_keys();
    all.insert(all.end(), of_systems.begin(), of_systems.end());
    return all;
  }();
  return keys;
}

namespace {

std::string scene_place_of(const Key& key, const std::string& owner) {
  const std::string section(key.section), name(key.name);
  if (section.empty()) return name;
  if (section == "gear" || section == "material") return section + "." + owner + "." + name;
  if (section == "rigid_gear") return "gear." + owner + "." + name;
  if (section == "train_mesh") return "mesh." + name;
  if (section == "modification" || section == "error" || section == "crack")
    return "gear." + owner + "." + section + "." + name;
  if (section == "bearing" && !owner.empty()) return section + "." + owner + "." + name;
  return section + "." + name;
}

}  // namespace

KeyPlace find_key(const std::string& name) {
  std::string owner;
  for (const char* group : {"gear.", "material.", "bearing."})
    if (name.rfind(group, 0) == 0) {
      const auto from = std::string(group).size(), to = name.find('.', from);
      if (to != std::string::npos) owner = name.substr(from, to - from);
    }
  const bool placed = name.find('.') != std::string::npos;
  std::vector<std::string> known;
  for (const Key& key : scene_keys()) {
    const std::string candidate = placed ? scene_place_of(key, owner) : key.name;
    if (candidate == name) return {&key, placed ? owner : ""};
    known.push_back(candidate);
  }
  // A right key in a wrong place, or a word for one, is nearer than any key that is spelt alike there.
  const std::string last = name.substr(name.rfind('.') + 1);
  std::string note, near;
  const Key* meant = meant_key(last, note);
  if (!meant && !note.empty()) fail(Failure::usage, "no scene has the key '", name, "': ", note);
  if (meant && (!placed || last == meant->name || !note.empty() || nearest(name, known).empty()))
    near = placed ? scene_place_of(*meant, owner.empty() ? "<name>" : owner) : meant->name;
  if (near.empty()) near = nearest(name, known);
  fail(Failure::usage, "no scene has the key '", name, "'",
       near.empty()   ? "; gear-scene --keys lists them"
       : note.empty() ? "; did you mean '" + near + "'?"
                      : "; did you mean '" + near + "' (" + note + ")?");
}

std::string exact_text(double value) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  std::string out(buffer, end);
  if (out.find_first_of(".en") == std::string::npos) out += ".0";
  return out;
}

std::string exact_text(const std::vector<double>& values) {
  std::string out;
  for (const double value : values) out += (out.empty() ? "" : ", ") + exact_text(value);
  return "[" + out + "]";
}

std::string exact_text(const Points& points) {
  std::string out;
  for (const auto& [roll, removed] : points)
    out += (out.empty() ? "[" : ", [") + exact_text(roll) + ", " + exact_text(removed) + "]";
  return "[" + out + "]";
}

const std::array<Unit, 2> kPointUnits{kDegree, kMicrometre};

std::vector<Parameter> parameters_of(const SceneParameters& values, KeyGroup part) {
  SceneParameters copy = values;  // slots point at what may be changed
  std::vector<Parameter> out;
  for (const Key& key : scene_keys()) {
    if (key.part != part) continue;
    const std::string name = key.si_name();
    const auto add = [&](const std::string& label, const auto& value) {
      out.push_back({label, key.unit.si, key.meaning, value});
    };
    const Slot slot = key.slot(copy);
    if (const auto* number = std::get_if<double*>(&slot)) {
      add(name, **number);
    } else if (const auto* whole = std::get_if<int*>(&slot)) {
      add(name, **whole);
    } else if (const auto* flag = std::get_if<bool*>(&slot)) {
      add(name, **flag ? 1 : 0);
    } else if (const auto* word = std::get_if<std::string*>(&slot)) {
      add(name, **word);
    } else if (const auto* choice = std::get_if<ChoiceSlot>(&slot)) {
      add(name, key.word_in(*choice));
    } else if (const auto* plane = std::get_if<PlaneSlot>(&slot)) {
      add(name, std::string(*plane->stress ? "stress" : "strain"));
    } else if (const auto* corner = std::get_if<CornerRule*>(&slot)) {
      out.push_back(
          {name, "1", "1: a tip edge may touch a flank off the line of action", (*corner)->enabled ? 1 : 0});
      if (std::isfinite((*corner)->largest_angle)) {
        out.push_back(
            {name + kLargestAngle, "rad", "largest angle between the two normals", (*corner)->largest_angle});
      }
    } else if (const auto* range = std::get_if<RangeSlot>(&slot)) {
      add(name + "_from", *range->from);
      add(name + "_to", *range->to);
      add(name + "_step", *range->step);
    } else if (const auto* points = std::get_if<Points*>(&slot)) {
      if (!(*points)->empty()) add(name, exact_text(**points));
    } else if (const auto* list = std::get_if<ToothList>(&slot)) {
      if (!list->values->empty()) add(name, exact_text(*list->values));
    } else {
      fail(Failure::numerical, "the key ", name, " is a list, which /parameters does not hold");
    }
  }
  return out;
}

namespace {

// Of a list that is kept as text; none if it is not there.
std::vector<double> numbers_in(const ParameterSource& source, const std::string& name) {
  std::vector<double> numbers;
  const std::string word = source.has(name) ? source.word(name) : "";
  for (const char* at = word.c_str(); *at;) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end != at) numbers.push_back(number);
    at = end != at ? end : at + 1;
  }
  return numbers;
}

}  // namespace

namespace {

// A limit of a key, to the rounding of its unit, as a limit in SI.
Range si_range(const Key& key) {
  constexpr double kRoundOff = 1e-9;
  const double least = key.or_zero ? 0 : key.to_si(key.least), most = key.to_si(key.most);
  return {least - kRoundOff * std::abs(least), most + kRoundOff * std::abs(most), key.open};
}

double in_range(const Key& key, const ParameterSource& source, const std::string& name, double value) {
  // body = "full" takes every mode; a body that only statics use may have none.
  if (std::string(key.name) == "modes" && (value == kAllModes || value == 0)) return value;
  if (key.most > key.least)
    if (const std::string why = outside(si_range(key), value); !why.empty()) source.reject(name, why);
  return value;
}

std::string one_of(const std::string& choices, const ParameterSource& source, const std::string& name) {
  const std::string word = source.word(name);
  std::istringstream all(choices);
  for (std::string choice; all >> choice;)
    if (choice == word) return word;
  if (!choices.empty()) source.reject(name, "is '" + word + "', which is none of: " + choices);
  return word;
}

}  // namespace

void set_parameters(SceneParameters& values, KeyGroup part, const ParameterSource& source) {
  for (const Key& key : scene_keys()) {
    if (key.part != part) continue;
    const std::string name = key.si_name();
    const Slot slot = key.slot(values);
    if (const auto* number = std::get_if<double*>(&slot)) {
      **number = in_range(key, source, name, source.number(name));
    } else if (const auto* whole = std::get_if<int*>(&slot)) {
      **whole = static_cast<int>(in_range(key, source, name, source.whole(name)));
    } else if (const auto* flag = std::get_if<bool*>(&slot)) {
      **flag = source.whole(name) != 0;
    } else if (const auto* word = std::get_if<std::string*>(&slot)) {
      **word = one_of(key.choices, source, name);
    } else if (const auto* choice = std::get_if<ChoiceSlot>(&slot)) {
      key.assign(*choice, one_of(key.choices, source, name));
    } else if (const auto* plane = std::get_if<PlaneSlot>(&slot)) {
      *plane->stress = one_of(key.choices, source, name) == "stress";
    } else if (const auto* corner = std::get_if<CornerRule*>(&slot)) {
      (*corner)->enabled = source.whole(name) != 0;
      (*corner)->largest_angle =
          source.has(name + kLargestAngle)
              ? in_range(key, source, name + kLargestAngle, source.number(name + kLargestAngle))
              : std::numeric_limits<double>::infinity();
    } else if (const auto* range = std::get_if<RangeSlot>(&slot)) {
      *range->from = source.number(name + "_from");
      *range->to = source.number(name + "_to");
      *range->step = source.number(name + "_step");
    } else if (const auto* points = std::get_if<Points*>(&slot)) {
      (*points)->clear();
      const std::vector<double> numbers = numbers_in(source, name);
      for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
        (*points)->push_back({numbers[i], numbers[i + 1]});
    } else if (const auto* list = std::get_if<ToothList>(&slot)) {
      *list->values = numbers_in(source, name);
      for (const double item : *list->values) in_range(key, source, name, item);
    } else {
      fail(Failure::numerical, "the key ", name, " is a list, which /parameters does not hold");
    }
  }
}

std::string scene_key_table() {
  const auto shown = [](double value) { return text(value); };
  std::ostringstream out;
  out << "| section | key | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const Key& key : scene_keys()) {
    const std::string section(key.section);
    std::string label = "[" + section + "]";
    if (section.empty()) label = "(top)";
    if (section == "gear" || section == "material") label = "[" + section + ".<name>]";
    if (section == "rigid_gear") label = "[gear.<name>]";
    if (section == "train_mesh") label = "[[mesh]]";
    if (section == "modification" || section == "error" || section == "crack")
      label = "[gear.<name>." + section + "]";
    if (section == "mesh" || section == "bearing" || section == "carrier" || section == "drive")
      label = "[[" + section + "]]";
    std::string range = "text";
    SceneParameters values;
    if (std::holds_alternative<bool*>(key.slot(values))) {
      range = "true/false";
    } else if (*key.choices) {
      range = key.choices;
      std::replace(range.begin(), range.end(), ' ', '/');
    } else if (key.most > key.least) {
      range = key.open ? "> " + shown(key.least) + ", <= " + shown(key.most)
                       : (key.or_zero ? "0, " : "") + shown(key.least) + " to " + shown(key.most);
    }
    if (std::holds_alternative<CornerRule*>(key.slot(values)))
      range = "true, false, or " + range + " (degrees)";
    const std::string fallback = !key.fallback ? "required" : *key.fallback ? key.fallback : "none";
    out << "| `" << label << "` | `" << key.name << "` | " << fallback << " | " << range << " | "
        << (of_pairs(key.part) ? "of pairs alone: " : "") << key.meaning << " |\n";
  }
  return out.str();
}

const std::array<GearSection, 3> kGearSections{
    {{"modification", KeyGroup::modification, "tip_relief",
      [](const SceneParameters& v) { return v.modification != FlankModification{}; }},
     {"error", KeyGroup::error, "iso_class", [](const SceneParameters& v) { return !v.errors.none(); }},
     {"bearing", KeyGroup::bearing, "stiffness",
      [](const SceneParameters& v) { return v.bearing.elastic(); }}}};

void take_gear(SceneParameters& values, const GearMeshSpec& mesh, int g) {
  values.modification = mesh.modification[g];
  values.errors = mesh.errors[g];
  values.bearing = mesh.bearing[g];
}

void put_gear(const SceneParameters& values, GearMeshSpec& mesh, int g) {
  mesh.modification[g] = values.modification;
  mesh.errors[g] = values.errors;
  mesh.bearing[g] = values.bearing;
}

}  // namespace whine
