#include "model/key_units.h"
#include "model/keys.h"

namespace whine {

using namespace units;

const std::array<Unit, 2> kPointUnits{kDegree, kMicrometre};

// clang-format off
KeyList title_key(std::string& title) {
  KeyList k("");
  k.add(&title, "title", kNone, "", {}, "what the scene is; stands on figures");
  return k;
}

KeyList keys(GearMeshSpec& m) {
  KeyList k("mesh");
  k.add(&m.gear[0], "driver", kNone, nullptr, {}, "name of the driving gear");
  k.add(&m.gear[1], "driven", kNone, nullptr, {}, "name of the driven gear");
  k.add(&m.centre_distance, "centre_distance_mm", kMillimetre, nullptr, {0, 1e5, true}, "distance of the two axes");
  k.add(&m.corner, "corner_contact", kCornerDegree, "true", {0, 90}, "tip edge on a flank, off the line of action: true, false, or the largest angle between the normals in degrees");
  k.begin_group(m.contact_plane != GearMeshSpec{}.contact_plane);
  k.choice(m.contact_plane, "contact_plane", "strain", "plane state of the contact alone (pressure, width, local approach): strain inside a wide face; body: as each gear's [material] plane");
  k.begin_group(m.misalignment != 0);
  k.add(&m.misalignment, "misalignment_um", kMicrometre, "0.0", {-1000, 1000}, "misalignment in the plane of action over the common face width: by so much more the flanks stand apart at the end that faces a viewer who sees the driver turn counter-clockwise than at the other. What axes deviate at right angles to the plane of action (ISO 21771) changes the gap by its square only");
  k.begin_group(m.face_offset != 0);
  k.add(&m.face_offset, "face_offset_mm", kMillimetre, "0.0", {-1000, 1000}, "of faces of unequal width: middle of the driven gear's face beyond that of the driver's, towards a viewer who sees the driver turn counter-clockwise; the narrower face stands inside the wider one");
  k.append_group(keys(m.friction), m.friction.acts(), "friction");
  const auto own = [](int g, const char* section) { return std::string(kRole[g]) + section; };
  for (int g = 0; g < kSides; ++g)
    k.append_group(keys(m.modification[g]), m.modification[g].of_profile(), own(g, "_modification"));
  for (int g = 0; g < kSides; ++g) k.append_group(keys(m.errors[g]), !m.errors[g].none(), own(g, "_error"));
  for (int g = 0; g < kSides; ++g) k.append_group(keys(m.bearing[g]), m.bearing[g].elastic(), own(g, "_bearing"));
  for (int g = 0; g < kSides; ++g)
    k.append_group(keys(m.modification[g].lead), !m.modification[g].lead.none(), own(g, "_lead"));
  return k;
}

KeyList keys(Friction& f) {
  KeyList k("friction");
  k.choice(f.law, "law", "constant", "coefficient of friction: a number, or Schlenk's formula of load, speed, oil and roughness");
  k.add(&f.coefficient, "coefficient", kNone, "0.0", {0, 0.3}, "of law = \"constant\": friction force over normal force; 0: no friction");
  k.add(&f.smoothing, "smoothing", kNone, "0.01", {1e-6, 1}, "sliding speed v0 over the speed of the pitch line. Friction is mu N v / sqrt(v^2 + v0^2): it changes its sign smoothly at the pitch point");
  k.add(&f.viscosity, "viscosity_mPas", kMillipascalSecond, "0.0", {0, 1e6}, "of law = \"schlenk\", which requires it: dynamic viscosity of the oil at the temperature of the mesh");
  k.add(&f.roughness, "roughness_um", kMicrometre, "0.0", {0, 100}, "of law = \"schlenk\", which requires it: arithmetic roughness Ra of the flanks, mean of both gears");
  k.add(&f.lubricant_factor, "lubricant_factor", kNone, "1.0", {0.1, 10}, "of law = \"schlenk\": X_L, 1 for mineral oils");
  k.add(&f.static_frequency, "static_frequency_Hz", kHertzUnit, "0.0", {0, 1e6}, "of law = \"schlenk\", which requires it: mesh frequency at which the coefficient of the pair at rest is taken");
  return k;
}

KeyList keys(Damping& d) {
  KeyList k("damping");
  k.add(&d.rayleigh_mass, "rayleigh_mass_per_s", kPerSecond, "0.0", {0, 1e6}, "mu of Eq. 21: multiplies the mass matrix");
  k.add(&d.rayleigh_stiffness, "rayleigh_stiffness_s", kSecond, "7.7e-6", {0, 1}, "eta of Eq. 21: multiplies the stiffness matrix");
  k.add(&d.undamped_depth, "undamped_depth_mm", kMillimetre, "module / 6", {0, 1000, true}, "half-plane compliance relative to this depth is instantaneous; default: of a system by its largest module");
  k.add(&d.bearing_ratio, "bearing_ratio", kNone, "0.005", {0, 1}, "damping ratio of the torque damper at each axis");
  return k;
}

KeyList torque_key(std::vector<double>& torques) {
  KeyList k("operation");
  k.add(&torques, "torque_Nm", kNewtonMetre, nullptr, {0, 999999, true, "without load nothing presses the teeth together; a small torque shows them as good as unloaded"}, "torque on the driver: a number or a list; the first sets the bearing dampers");
  return k;
}

KeyList speeds_key(MeshSpeeds& s) {
  KeyList k("operation");
  k.add(RangeSlot{&s.frequency_from, &s.frequency_to, &s.frequency_step}, "mesh_frequency_Hz", kHertzUnit, nullptr, {1, 1e6, false, "slower, a mesh period takes more than 250000 time steps at the default rate; the static stage is the limit of zero speed"}, "speeds of a sweep: { from = , to = , step = }");
  return k;
}

KeyList keys(Operation& o) {
  return torque_key(o.torques).append(speeds_key(o));
}

KeyList keys(Fidelity& f) {
  KeyList k("fidelity");
  k.choice(f.body, "body", "modal", "what of the elastic body moves by itself; rigid: of systems alone, one spring for each mesh, natural modes only");
  k.choice(f.contact, "contact", "strips", "contact of a tooth pair: one force and Hertz's closed law, or pressure on strips");
  k.choice(f.integrator, "integrator", "exact", "time integration: Newmark (Eq. 8), or modal propagators");
  k.begin_group(f.width != WidthModel::one);
  k.choice(f.width, "width", "one", "contact over the face width: one slice under even load, of spur pairs; slices: points along each contact line, which the teeth carry each by itself; body: the same points on bodies in three dimensions, in plane strain, of pairs; default: for helical gears, misalignment, face offset and lead modifications body, of systems slices, else one");
  return k;
}

KeyList keys(BodyDiscretisation& b) {
  KeyList k("fidelity");
  k.add(&b.modes, "modes", kNone, "61", {1, 100000}, "elastic modes of the whole gear; a doublet is never cut (rounded up); without meaning to body = \"full\", which takes all (-1 in its artifacts)");
  k.in_section("discretisation");
  k.add(&b.element_size, "element_mm", kMillimetre, "module / 7.5", {0, 100, true}, "element size on the flank; default: of each gear by its own module, so that the error is that of every module");
  k.add(&b.element_order, "element_order", kNone, "2", {1, 2}, "order of the elements: 1 (4 nodes) or 2 (9 nodes)");
  k.begin_group(b.near_field != BodyDiscretisation{}.near_field);
  k.choice(b.near_field, "near_field", "subtraction", "how the half-plane at the contact joins the finite elements: subtracted, or matched at a depth as in P2000");
  k.add(&b.matching_depth, "matching_depth_mm", kMillimetre, "module / 3", {0, 100, true}, "depth below the flank at which the two are matched; must stay inside the tooth; only with near_field = \"matching\"");
  k.begin_group(b.flank_points != BodyDiscretisation{}.flank_points);
  k.add(&b.flank_points, "flank_points", kNone, "24", {8, 96}, "points of a flank between which a body's flexibility is a table");
  return k;
}

KeyList keys(WidthDiscretisation& w) {
  KeyList k("discretisation");
  k.add(&w.degree, "width_degree", kNone, "0", {1, 24, false, "a body of degree 0 is the plane one; 0 stands for that", true}, "degree of the polynomials over the face width by which a body has a third dimension, its material in plane strain; 0: a plane body, or with width = \"body\" what holds smooth loads to 0.1 %: 8 up to a width of 10 modules, 12 up to 15, beyond them 0.8 widths in modules, at most 24. Contact takes P <= sqrt(b / 2a) of them");
  k.add(&w.section_size, "section_element_mm", kMillimetre, "module / 3", {0, 100, true}, "element size of the section that the third dimension is computed on, 0.4 of it on the roots, apart from element_mm: it hardly changes the result; of width_degree alone");
  return k;
}

KeyList keys(ContactDiscretisation& c) {
  KeyList k("discretisation");
  k.add(&c.strips, "strips", kNone, "8", {3, 1001}, "pressure strips across the contact width at the mean load; a candidate zone holds whole fours of them");
  k.add(&c.positions, "positions", kNone, "0", {8, 65536, false, "a mesh period in fewer points has no harmonics; 0 takes the default", true}, "positions of the static stage per mesh period; 0: as steps_per_period, 128 at least, for teeth that differ fewer (16 at least), so that there are 16384 in all");
  k.begin_group(c.face_points > 0);
  k.add(&c.face_points, "face_points", kNone, "0", {2, 64, false, "one point knows nothing of the face", true}, "Gauss points along the contact line of each tooth pair, of width = \"slices\" and \"body\"; 0: 8, with misalignment or lead modifications 12");
  return k;
}

KeyList keys(TimeDiscretisation& t) {
  KeyList k("discretisation");
  k.add(&t.steps_per_period, "steps_per_period", kNone, "128", {8, 65536}, "stored samples per mesh period; steps are doubled until min_sample_rate_kHz is reached");
  k.add(&t.min_sample_rate, "min_sample_rate_kHz", kKilohertz, "250", {0, 1e6}, "least rate of time steps");
  k.add(&t.periodicity, "periodicity", kNone, "1e-5", {1e-12, 1}, "relative change of the state over a mesh period at which a speed counts as steady; round-off is 1e-14");
  k.choice(t.steady_state, "steady_state", "extrapolate", "start where the last speeds lead and, once close, skip the rest of a transient, or integrate all of it, as a rig would run it; the same orbits but for a speed or two at the end of a branch");
  k.in_section("accuracy");
  k.begin_group(t.accepted_error > 0);
  k.add(&t.accepted_error, "rms_percent", kPercentUnit, "1.0", {0.05, 10, false, "no more is known of the laws by which settings are chosen", true}, "accepted discretisation error of the RMS of the transmission error in motion, at every speed: what [fidelity] and [discretisation] leave open of element_mm, modes, flank_points, strips, face_points, min_sample_rate_kHz, steps_per_period and periodicity is chosen by it; left out, it is 1 where it can choose; 0: these have their defaults. gear-scene --plan tells what is chosen");
  return k;
}
// clang-format on

}  // namespace whine
