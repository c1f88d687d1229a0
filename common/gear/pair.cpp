#include "gear/pair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/format.h"
#include "base/units.h"
#include "gear/helix.h"
#include "gear/internal_mesh.h"
#include "gear/undercut.h"

namespace whine {

namespace {

// A flank in its own frame at roll angle `at`: x along the tangent to the tip, y along the outward normal,
// origin at the point `at`. From T(d) + string: (r_b (cos d + xi sin d), r_b (sin d - xi cos d)) with d = xi
// - at.
Vec2 own_frame(double base_radius, double at, double roll) {
  const double d = roll - at, half = std::sin(0.5 * d);
  // cos d - 1 = -2 sin^2(d/2), and d - sin d from its series: plain differences would leave 1e-16 r_b in a
  // gap.
  const double d_minus_sin = std::abs(d) < 0.05
                                 ? d * d * d / 6 * (1 - d * d / 20 * (1 - d * d / 42 * (1 - d * d / 72)))
                                 : d - std::sin(d);
  return base_radius * Vec2(roll * std::sin(d) - 2 * half * half, d_minus_sin - 2 * roll * half * half);
}
}  // namespace

GearPair::GearPair(const GearDesign& driver, const GearDesign& driven, double centre_distance)
    : gear_{ToothGeometry(driver), ToothGeometry(driven)},
      ring_(driver.internal   ? 0
            : driven.internal ? 1
                              : -1),
      along_{1, -1},
      centre_distance_(centre_distance),
      helix_(whine::base_helix_angle(driver)) {
  if (internal()) along_ = {ring_ == 1 ? 1 : -1, ring_ == 1 ? 1 : -1};
  require_reach();
  const auto& [a, b] = gear_;
  const double rb1 = a.base_radius(), rb2 = b.base_radius();
  const double cosine = (internal() ? std::abs(rb1 - rb2) : rb1 + rb2) / centre_distance;
  alpha_ = std::acos(cosine);

  const double tangent = std::tan(alpha_);
  path_end_ = along_[0] * rb1 * (a.tip_roll_angle() - tangent);
  path_start_ = along_[1] * rb2 * (b.tip_roll_angle() - tangent);
  const double first = along_[0] * rb1 * (a.form_roll_angle() - tangent),
               last = along_[1] * rb2 * (b.form_roll_angle() - tangent);
  if (a.undercut() > 0) path_lost_[0] = std::max(0.0, first - path_start_);
  if (b.undercut() > 0) path_lost_[1] = std::max(0.0, path_end_ - last);
  if (path_lost_[0] > 0) path_start_ = first;
  if (path_lost_[1] > 0) path_end_ = last;

  // Backlash on the working pitch circles, whose arcs and pitch share the ratio of the teeth.
  const double rw1 = rb1 / cosine, rw2 = rb2 / cosine;
  backlash_ =
      cosine * (2 * kPi * rw1 / driver.teeth - a.thickness_at_radius(rw1) - b.thickness_at_radius(rw2));
  if (backlash_ < -1e-6)
    fail(Failure::input, "the gears jam: backlash on the line of action is ", shown_number(backlash_ * 1e6),
         " micrometres (limit -1); ", internal() ? "lower" : "raise",
         " centre_distance_mm or raise tooth_thinning_mm, or lower profile_shift");
  require_no_interference();
}

void GearPair::require_reach() const {
  const auto& [a, b] = gear_;
  const double rb1 = a.base_radius(), rb2 = b.base_radius();
  if (a.internal() && b.internal())
    fail(Failure::input, "both gears are internal; an internal gear meshes with an external one");
  if (const std::string fault = helix_fault(a.design(), b.design()); !fault.empty())
    fail(Failure::input, fault);
  if (std::abs(a.base_pitch() - b.base_pitch()) > 1e-9 * a.base_pitch())
    fail(Failure::input, "base pitches differ: driver ", millimetres(a.base_pitch()), ", driven gear ",
         millimetres(b.base_pitch()), "; give both gears the same module_mm and pressure_angle_deg");
  const std::string distance = text("centre_distance_mm = ", shown_number(centre_distance_ * 1e3));
  if (internal()) {
    const ToothGeometry &ring = gear_[static_cast<size_t>(ring_)],
                        &pinion = gear_[static_cast<size_t>(1 - ring_)];
    if (ring.design().teeth <= pinion.design().teeth)
      fail(Failure::input, "the internal gear has ", ring.design().teeth, " teeth and the gear in it ",
           pinion.design().teeth, ": it needs more than that");
    if (centre_distance_ + pinion.tip_radius() <= ring.tip_radius())
      fail(Failure::input, "the gears do not reach each other: with ", distance, " the tips of the ",
           kGearName[1 - ring_], " come to ", millimetres(centre_distance_ + pinion.tip_radius()),
           " from the axis of the internal gear, whose tip radius is ", millimetres(ring.tip_radius()),
           "; raise centre_distance_mm");
    if (ring.base_radius() - pinion.base_radius() >= centre_distance_)
      fail(Failure::input, "the gears jam: ", distance, " is not above the difference of the base radii ",
           millimetres(ring.base_radius() - pinion.base_radius()), "; raise centre_distance_mm");
    return;
  }
  if (a.tip_radius() + b.tip_radius() <= centre_distance_)
    fail(Failure::input, "the gears do not reach each other: tip radii add up to ",
         millimetres(a.tip_radius() + b.tip_radius()), ", centre_distance_mm is ",
         shown_number(centre_distance_ * 1e3), "; lower centre_distance_mm");
  if ((rb1 + rb2) / centre_distance_ >= 1)
    fail(Failure::input, "the gears jam: ", distance, " is not above the sum of the base radii ",
         millimetres(rb1 + rb2), "; raise centre_distance_mm");
}

void GearPair::require_no_interference() const {
  constexpr double kRoundOff = 1e-9;  // m
  const auto& [a, b] = gear_;
  for (int g = 0; g < kSides; ++g) {
    const ToothGeometry &own = gear_[g], &other = gear_[1 - g];
    const double clearance = !internal()  ? centre_distance_ - own.tip_radius() - other.root_radius()
                             : g == ring_ ? own.tip_radius() - centre_distance_ - other.root_radius()
                                          : other.root_radius() - centre_distance_ - own.tip_radius();
    if (clearance < 0)
      fail(Failure::input, "the gears jam: the tip of the ", kGearName[g],
           clearance > -kRoundOff ? " has no clearance from"
                                  : text(" stands ", millimetres(-clearance), " inside"),
           " the root of the ", kGearName[1 - g], "; lower its addendum or raise the other's dedendum");
  }
  const double lost = path_lost_[0] + path_lost_[1];
  if (contact_ratio() < 1)
    fail(Failure::input, "the contact ratio is ", shown_number(contact_ratio()),
         lost > 0 ? text(" (undercut takes ", shown_number(lost / base_pitch()), ")") : "",
         ", below 1: teeth would leave before the next ones touch; raise ",
         lost > 0 ? "profile_shift of what is undercut" : "addendum", " or ", internal() ? "raise" : "lower",
         " centre_distance_mm");
  for (int g = 0; g < kSides; ++g) {
    if (gear_[g].undercut() > 0) {
      if (const double clearance = undercut_clearance(*this, g); clearance < 0)
        fail(Failure::input, "the gears jam (fillet interference): the tip of the ", kGearName[1 - g],
             " runs ", millimetres(-clearance), " into the undercut root of the ", kGearName[g],
             "; lower its addendum or raise the other's dedendum");
      continue;
    }
    const double roll = nominal_roll(g, g == 0 ? path_start_ : path_end_), form = gear_[g].form_roll_angle();
    const bool ring = gear_[g].internal();
    if (ring ? roll <= form : roll >= form) continue;
    fail(Failure::input, "the gears jam",
         !internal() ? ""
         : roll <= 0 ? " (involute interference)"
                     : " (fillet interference)",
         ": the tip of the ", kGearName[1 - g], " reaches roll angle ", shown_number(roll * 180 / kPi),
         " deg of the ", kGearName[g],
         ring ? ", beyond its involute, which ends at " : ", below its involute, which begins at ",
         shown_number(form * 180 / kPi), " deg; lower the addendum or raise the dedendum");
  }
  if (!internal()) return;
  if (const double clearance = tip_clearance(*this); clearance < 0)
    fail(Failure::input, "trochoid interference: the tips of the ", kGearName[1 - ring_], " run ",
         millimetres(-clearance), " into those of the ", kGearName[ring_],
         " beside the mesh; raise the difference of the numbers of teeth (now ",
         std::abs(a.design().teeth - b.design().teeth), ") or lower an addendum");
}

double GearPair::nominal_roll(int g, double path) const {
  return std::tan(alpha_) +
         along_[static_cast<size_t>(g)] * path / gear_[static_cast<size_t>(g)].base_radius();
}

double GearPair::signed_curvature(int g, double radius) const {
  return gear_[static_cast<size_t>(g)].outwards() / radius;
}

double GearPair::relative_curvature_radius(double path) const {
  const double rho1 = gear_[0].base_radius() * std::tan(alpha_) + along_[0] * path;
  const double rho2 = gear_[1].base_radius() * std::tan(alpha_) + along_[1] * path;
  return internal() ? rho1 * rho2 / std::abs(rho1 - rho2) : rho1 * rho2 / (rho1 + rho2);
}

double GearPair::largest_relative_curvature_radius() const {
  // External: a parabola along the path, highest midway between the tangent points. Internal: it grows with both radii.
  if (internal()) return relative_curvature_radius(along_[0] > 0 ? path_end_ : path_start_);
  const double midway = 0.5 * std::tan(alpha_) * (gear_[1].base_radius() - gear_[0].base_radius());
  return relative_curvature_radius(std::clamp(midway, path_start_, path_end_));
}

double GearPair::sliding(double path) const {
  const double ratio = static_cast<double>(gear_[0].design().teeth) / gear_[1].design().teeth;
  return path * (internal() ? std::abs(1 - ratio) : 1 + ratio);
}

double GearPair::relative_curvature_radius(const PairContact& c) const {
  const int tip = c.tip_gear, flank = 1 - tip;
  const double cosine = std::cos(c.normal_angle);
  const double rho_tip = gear_[tip].base_radius() * c.roll[tip] * cosine * cosine * cosine;
  const double rho_flank = gear_[flank].base_radius() * c.roll[flank];
  if (internal()) return 1 / (signed_curvature(tip, rho_tip) + signed_curvature(flank, rho_flank));
  return rho_tip * rho_flank / (rho_tip + rho_flank);
}

Vec2 GearPair::flank_in_nominal_frame(int g, double nominal, double roll) const {
  const Vec2 own = own_frame(gear_[g].base_radius(), nominal, roll);
  return along_[static_cast<size_t>(g)] > 0 ? own : Vec2(-own);  // looks the other way
}

bool GearPair::in_reach(double phase) const {
  const double path = phase * base_pitch();
  return !internal() || (nominal_roll(0, path) > 0 && nominal_roll(1, path) > 0);
}

// The edge of gear `tip`, that of its tip or of its undercut flank, on the flank of the other gear, off the line of action. passing:
// where it stands just beyond that flank's tip edge, the normal is that of the flank there.
PairContact GearPair::on_edge(const std::array<double, 2>& nominal, int tip, bool undercut,
                              bool passing) const {
  constexpr double kPassing = 0.01;  // rad
  PairContact c;
  const int flank = 1 - tip;
  const double rb[2] = {gear_[0].base_radius(), gear_[1].base_radius()};
  c.nominal = c.roll = nominal;
  c.lever = {rb[0], rb[1]};
  c.corner = true;
  c.tip_gear = tip;
  c.undercut = undercut;
  c.roll[tip] = undercut ? gear_[tip].form_roll_angle() : gear_[tip].tip_roll_angle();
  // The edge as the touched gear sees it: radial and string coordinates about its centre, its own frame.
  const Vec2 own = own_frame(rb[tip], c.nominal[tip], c.roll[tip]);
  const Vec2 edge = internal() ? own : Vec2(-own);
  const double radial = rb[flank] + edge.x(), along = rb[flank] * c.nominal[flank] + edge.y();
  // The flank's normal through the edge is the tangent from it to the base circle: closed form, no
  // iteration. With the touched gear's frame turned by d: t = string length from the base circle to the
  // edge.
  const double squared = (edge.x() + 2 * rb[flank]) * edge.x() + along * along;  // r^2 - r_b^2
  if (squared <= 0) {
    c.on_flank = false;
    c.gap = std::numeric_limits<double>::infinity();
    return c;
  }
  const double string = std::sqrt(squared);
  // d = atan(t / r_b) - atan(along / radial), as one arctangent: the two are nearly equal.
  double d = std::atan2(string * radial - along * rb[flank], rb[flank] * radial + string * along);
  c.roll[flank] = c.nominal[flank] + d;
  c.gap = gear_[flank].outwards() * (string - rb[flank] * c.roll[flank]);
  if (const double beyond = gear_[flank].outwards() * (c.roll[flank] - gear_[flank].tip_roll_angle());
      passing && beyond > 0 && beyond < kPassing) {
    c.roll[flank] = gear_[flank].tip_roll_angle();
    d = c.roll[flank] - c.nominal[flank];
    c.gap = gear_[flank].outwards() *
            rotated(edge - own_frame(rb[flank], c.nominal[flank], c.roll[flank]), d).y();
  }
  c.on_flank =
      c.roll[flank] >= gear_[flank].least_roll_angle() && c.roll[flank] <= gear_[flank].largest_roll_angle();
  c.tilt = d;  // the same sign for either gear: both look along their own outward normal
  c.origin = flank_in_nominal_frame(flank, c.nominal[flank], c.roll[flank]);
  c.normal_angle = std::abs((c.roll[tip] - c.nominal[tip]) - d);
  // Lever arm of the tip gear: its centre stands at (-r_b, -r_b xi) of its own nominal frame.
  const Vec2 arm = own + Vec2(rb[tip], rb[tip] * c.nominal[tip]);
  c.lever[tip] = arm.x() * std::cos(d) - arm.y() * std::sin(d);
  return c;
}

PairContact GearPair::contact(double phase) const {
  PairContact c;
  const double path = phase * base_pitch();
  c.nominal = {nominal_roll(0, path), nominal_roll(1, path)};
  if (!in_reach(phase))
    fail(Failure::numerical, "a contact ", millimetres(path),
         " from the pitch point lies beyond the base circles");
  c.roll = c.nominal;
  c.lever = {gear_[0].base_radius(), gear_[1].base_radius()};

  const bool past_end = path > path_end_, before_start = path < path_start_;
  if (past_end || before_start) {
    const int tip = past_end ? 0 : 1;
    c = on_edge(c.nominal, tip, false);
    if (gear_[1 - tip].undercut() > 0) {
      // What touches first; for a moment, as one edge passes the other, neither stands over a flank.
      PairContact edge = on_edge(c.nominal, 1 - tip, true);
      if (!c.on_flank && !edge.on_flank) edge = on_edge(c.nominal, 1 - tip, true, true);
      if (edge.on_flank && !(c.on_flank && c.gap <= edge.gap)) c = edge;
    }
    if (!std::isfinite(c.gap)) return c;
  }

  const auto tangential = [&](int g, double roll) {
    return rotated(flank_in_nominal_frame(g, c.nominal[g], roll) - c.origin, c.tilt).x();
  };
  c.x_max = std::min(tangential(0, gear_[0].tip_roll_angle()), tangential(1, gear_[1].form_roll_angle()));
  c.x_min = std::max(tangential(0, gear_[0].form_roll_angle()), tangential(1, gear_[1].tip_roll_angle()));
  // Far from the mesh flanks stand beside each other, not face to face.
  if (c.corner && !(c.x_max > c.x_min)) {
    c.on_flank = false;
    c.gap = std::numeric_limits<double>::infinity();
  }
  return c;
}

bool GearPair::ends_at(const PairContact& c, int end, int g, double roll) const {
  return std::abs(roll_at(g, c, end == 0 ? c.x_max : c.x_min) - roll) < 1e-9;
}

double GearPair::edge_distance(const PairContact& c, int end) const {
  const ToothGeometry& other = gear_[1 - end];
  const bool edge = ends_at(c, end, end, gear_[end].tip_roll_angle()) ||
                    (other.undercut() > 0 && ends_at(c, end, 1 - end, other.form_roll_angle()));
  return edge ? std::abs(end == 0 ? c.x_max : c.x_min) : std::numeric_limits<double>::infinity();
}

int GearPair::edge_gear(const PairContact& c, int end) const {
  return ends_at(c, end, end, gear_[end].tip_roll_angle()) ? end : 1 - end;
}

Vec2 Placement::operator()(const Vec2& p) const {
  return centre + Eigen::Rotation2Dd(angle) * p;
}

// At phase 0 the flank point of roll angle tan(alpha_w) stands on the line of centres. Seen from its own centre an external
// driven gear is the same construction, turned by half a turn; a driven gear of an internal pair is its mirror image.
Placement placed(const GearPair& pair, int g, double phase) {
  const Vec2 p = pair.gear(g).flank_point(std::tan(pair.working_pressure_angle()));
  const double pitch = 2 * std::numbers::pi / pair.gear(g).design().teeth;
  const bool mirrored = pair.internal() && g == 1, turned = !pair.internal() && g == 1;
  Placement at;
  at.angle = 0.5 * std::numbers::pi - std::atan2(p.y(), mirrored ? -p.x() : p.x()) +
             (turned ? std::numbers::pi : 0.0) + (turned ? -phase : phase) * pitch;
  at.centre = Vec2(0.0, g == 1 ? pair.driven_centre_offset() : 0.0);
  return at;
}

Vec2 contact_normal(const GearPair& pair, const PairContact& contact) {
  const double a = pair.working_pressure_angle(), up = pair.ring() == 0 ? -1 : 1;
  const Vec2 along(-std::cos(a), up * std::sin(a)), to_tip(std::sin(a), up * std::cos(a));
  return std::cos(contact.tilt) * along + std::sin(contact.tilt) * to_tip;
}

}  // namespace whine
