#include "system/statics.h"

#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/format.h"
#include "base/model_range.h"
#include "gear/helix.h"
#include "gear/hertz.h"
#include "gear/internal_mesh.h"
#include "gear/train.h"
#include "system/compliance_split.h"
#include "system/drawing_remarks.h"
#include "system/face_mesh.h"
#include "system/flank_pressure.h"
#include "system/rest_record.h"

namespace whine {

using Eigen::VectorXd;

namespace {

SystemModel pair_model(const ReducedBody& driver, const ReducedBody& driven,
                       const StaticParameters& settings) {
  if (settings.fidelity.width == WidthModel::one) return {driver, driven, settings.mesh};
  const System layout =
      pair_system(even(settings.mesh), transverse_section(driver.design), transverse_section(driven.design));
  return sliced_system(layout, {driver, driven}, {settings.mesh}, {0}, settings.fidelity.width,
                       face_points_of(settings.mesh, settings.contact));
}

// All others but the held one are free of torque.
SystemModel loaded_system(const ReducedBody& driver, const ReducedBody& driven,
                          const StaticParameters& settings, double torque) {
  SystemModel system = pair_model(driver, driven, settings);
  system.layout.drives.push_back({0, System::DriveKind::torque, torque});
  if (settings.mesh.friction.acts())
    system.friction = {
        system.mesh[0].coefficient_of_friction(torque, settings.mesh.friction.static_frequency)};
  return system;
}

// Degree that a contact of this half-width (m) allows on the common face.
int allowed_degree(const GearPairParameters& pair, double half_width, double torque) {
  constexpr int kLeast = 2;
  const int degree = degree_of_contact(pair.face_width(), half_width);
  if (degree < kLeast)
    fail_outside_range(
        Failure::input, "at ", torque, " N m the contact is ", millimetres(2 * half_width),
        " wide, and the common face ", millimetres(pair.face_width()), ": polynomials to degree ", degree,
        " alone, by P <= sqrt(b / 2a), hold no load over the face; lower the torque or write width = \"slices\"");
  return degree;
}

// On bodies in three dimensions the degree is that which the widest contact allows: guessed from Hertz's of the whole load, then of the
// result.
SystemStaticResult record_pair(SystemModel system, const GearPairParameters& of, double torque,
                               double zone_factor) {
  const auto cut = [&](double half_width) {
    const FaceContact& contact = *system.face[0];
    const int degree = allowed_degree(of, half_width, torque);
    if (contact.degree() <= degree) return false;
    system = with_points(system, contact.points(), degree);
    return true;
  };
  const bool solid = of.fidelity.width == WidthModel::body;
  if (solid) cut(hertz_contact(of, torque / system.base_radius(0)).half_width);
  for (;;) {
    SystemStaticResult out = record_rest(system, {0}, {of}, zone_factor, false);
    if (!solid || !cut(out.mesh[0].face.half_width_max)) return out;
  }
}

}  // namespace

SystemStaticResult pair_at_rest(const ReducedBody& driver, const ReducedBody& driven,
                                const StaticParameters& settings, double torque, double zone_factor) {
  constexpr double kLeastTorque = 1e-9;  // N m: gaps are round-off below
  if (!(torque >= kLeastTorque) || !std::isfinite(torque))
    fail(Failure::input, "torque_Nm = ", torque, " must be finite and at least ", kLeastTorque,
         ": static transmission needs a load");
  GearPairParameters of;
  set_pair(of, {driver, driven}, settings);
  if (settings.fidelity.width != WidthModel::one) of.fidelity.contact = ContactModel::line;
  const SystemModel system = loaded_system(driver, driven, settings, torque);
  SystemStaticResult out = record_pair(system, of, torque, zone_factor);
  out.take_pair(system.layout);
  out.body_names = body_names_of(system.layout);
  out.mesh_names = mesh_names_of(system.layout);
  out.remarks = out.mesh[0].remarks = remarks(out.mesh[0]);
  return out;
}

StaticResult static_transmission(const ReducedBody& driver, const ReducedBody& driven,
                                 const StaticParameters& settings, double torque, double zone_factor) {
  return std::move(pair_at_rest(driver, driven, settings, torque, zone_factor).mesh[0]);
}

Remark remark_on_slices() {
  return remark(
      false,
      "width = \"slices\": the teeth carry each section by itself, and axial forces bend no body. Bodies in three dimensions are less stiff, spur by 3 %, with a helix of 11 degrees by 7 %, of 22 degrees by 24 % (pairs of make bench-levels), of 30 degrees by 40 % (a pinion of 23 teeth); K_Hbeta - 1 of misaligned spur gears is 1.7 to 2.1 times as large in them");
}

std::vector<Remark> remarks(const StaticResult& s) {
  std::vector<Remark> out;
  const auto add = [&](bool warning, const auto&... parts) { out.push_back(remark(warning, parts...)); };
  if (s.hunting_periods > 1)
    add(false, "teeth differ: ", s.hunting_periods, " mesh periods, after which the same ones meet, of ",
        s.contact.positions, " positions each");
  const std::vector<Remark> drawn = drawing_remarks(GearPair(s), s.mesh.gear);
  out.insert(out.end(), drawn.begin(), drawn.end());
  if (!s.mesh.corner.enabled)
    add(false, "corner contact is off: only pairs on the line of action carry load");
  if (s.fidelity.width == WidthModel::slices) out.push_back(remark_on_slices());
  if (s.fidelity.width == WidthModel::body) {
    const int most = std::max(s.gear[0].discretisation.width.degree, s.gear[1].discretisation.width.degree);
    if (s.face.degree < most)
      add(false, "polynomials over the face to degree ", s.face.degree, " of ", most,
          " of the bodies: P <= sqrt(b / 2a), a the half-width of the contact, beyond which they resolve less than the contact is wide");
  }
  if (s.gear[0].design.internal || s.gear[1].design.internal) {
    const double radial = radial_assembly_clearance(GearPair(s));
    if (radial < 0)
      add(true, "trimming interference: the tips overlap by ", -radial * 1e3,
          " mm when the pinion is put into the ring by a radial movement; it has to come in along its axis");
  }
  if (s.tooth_thinning() > 0 && s.backlash_margin <= 0)
    add(true, "the backlash is used up by ", -s.backlash_margin * 1e6,
        " µm; back flanks would touch, which is not modelled");
  if (const double pressure = s.flank_pressure.smooth; pressure > kHardenedSteelPressure)
    add(true, "the contact pressure of ", std::round(pressure * 1e-7) / 100, kBeyondSteel);
  for (const std::vector<Remark>& more :
       {pressure_remarks(s), body_remarks(s), friction_remarks(s, s.torque)})
    out.insert(out.end(), more.begin(), more.end());
  return out;
}

std::vector<Remark> schlenk_speed_remarks(const GearPairParameters& pair, double from, double to) {
  std::vector<Remark> out;
  if (pair.mesh.friction.law != FrictionLaw::schlenk) return out;
  const double per_frequency = pitch_line_speed(GearPair(pair), 1), slow = kSchlenkSpeeds[0] / per_frequency,
               fast = kSchlenkSpeeds[1] / per_frequency;
  if (from < slow)
    out.push_back(remark(false, "below ", shown_number(slow), " Hz the coefficient of friction is that at ",
                         kSchlenkSpeeds[0],
                         " m/s on the pitch line, where the tests of Schlenk's formula begin"));
  if (to > fast)
    out.push_back(remark(false, "above ", shown_number(fast), " Hz the coefficient of friction is that at ",
                         kSchlenkSpeeds[1],
                         " m/s on the pitch line, where the tests of Schlenk's formula end"));
  return out;
}

std::vector<Remark> friction_remarks(const GearPairParameters& pair, double torque) {
  std::vector<Remark> out;
  if (!pair.mesh.friction.acts()) return out;
  out.push_back(remark(
      false,
      "friction acts by its moments and forces on the hubs; it bends no teeth here, which may change the transmission error as much as it does (common/system/README.md, Friction at rest). Losses do not depend on that to first order"));
  if (pair.mesh.friction.law != FrictionLaw::schlenk) return out;
  const GearPair gears(pair);
  if (gears.internal())
    out.push_back(remark(
        true,
        "Schlenk's formula is fit to tests of external gears; of an internal pair its coefficient of friction is an extrapolation. Give a number in [friction]: law = \"constant\""));
  if (const double load = line_load(gears, pair.face_width(), torque); load < kSchlenkLoad)
    out.push_back(remark(false, "the coefficient of friction is that of ", kSchlenkLoad,
                         " N/mm, where the tests of Schlenk's formula begin: the line load is ",
                         shown_number(load), " N/mm"));
  const double frequency = pair.mesh.friction.static_frequency;
  const std::vector<Remark> of_speed = schlenk_speed_remarks(pair, frequency, frequency);
  out.insert(out.end(), of_speed.begin(), of_speed.end());
  return out;
}

std::vector<ContactZone> contact_zones(const ReducedBody& driver, const ReducedBody& driven,
                                       const StaticResult& statics, double phase, int period) {
  if (!(phase >= 0 && phase < 1))
    fail(Failure::input, "mesh phase ", phase, " is not within a mesh period: 0 up to, not including, 1");
  if (period < 0 || period >= statics.hunting_periods)
    fail(Failure::input, "mesh phase ", phase + period, " is outside the range: 0 up to, not including, ",
         statics.hunting_periods,
         statics.hunting_periods == 1 ? " (all teeth are alike, so that every mesh period is the same)"
                                      : " (mesh periods after which the same teeth meet)");
  const SystemModel system =
      loaded_system(driver, driven, {statics.mesh, {}, statics.contact}, statics.torque);
  double widening = 1;
  for (int attempt = 0; attempt < kWidenings; ++attempt, widening *= kWidening) {
    SystemStatics solver(system, ContactModel::strips,
                         static_zones(system, statics.contact.strips, 1, widening));
    const SystemSolution& solution = solver.solve(phase, period, VectorXd::Zero(2));
    if (!solution.leaves_zone && solution.deflection[0] <= solution.next_corner_gap[0])
      return solver.zones()[0];
  }
  fail(Failure::numerical, "at mesh phase ", phase, " and ", statics.torque,
       " N m contact leaves the flanks; lower the torque");
}

ReferenceContact reference_contact(const ReducedBody& driver, const ReducedBody& driven,
                                   const StaticResult& statics) try {
  for (const ContactZone& zone : contact_zones(driver, driven, statics, 0.0, 0))
    if (zone.strips.pair == 0)
      return {zone.strips.border, zone.strips.gap, zone.force, zone.separation, zone.approach};
  return {};
} catch (const Error& error) {
  if (error.kind() != Failure::numerical) throw;
  return {};
}

}  // namespace whine
