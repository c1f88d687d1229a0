// Internal gears and meshes: closed forms, exact curves, and tips that run into each other by brute force.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "gear/body_inertia.h"
#include "gear/internal_mesh.h"
#include "gear/path_points.h"
#include "gear/train.h"
#include "internal_pair.h"
#include "refusal.h"
#include "relative.h"

using namespace whine;

namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180;

double inv(double angle) {
  return std::tan(angle) - angle;
}

GearPair planet_in_ring() {
  return {planet_gear(), ring_gear(), kInternalDistance};
}

// The same two, the ring drives.
GearPair ring_about_planet() {
  return {ring_gear(), planet_gear(), kInternalDistance};
}

Vec2 turned(double angle, const Vec2& v) {
  return Eigen::Rotation2Dd(angle) * v;
}

// Of gear g in the frame of placed(): its working flank of tooth `tooth` at a roll angle.
Vec2 working_flank(const GearPair& pair, int g, double phase, int tooth, double roll) {
  Vec2 own = pair.gear(g).flank_point(roll);
  if (g == 1) own.x() = -own.x();  // driven: what trails
  return placed(pair, g, phase)(turned(2 * kPi * tooth / pair.gear(g).design().teeth, own));
}

}  // namespace

TEST_CASE(
    "tooth of a ring: tips inside, thickness and spaces of one pitch, flank and normal of an involute") {
  GearDesign design = ring_gear();
  for (const double shift : {0.0, 0.3, -0.2}) {
    CAPTURE(shift);
    design.profile_shift = shift;
    const ToothGeometry ring(design);
    const double m = design.module, r = 0.5 * m * design.teeth, alpha = design.pressure_angle;
    CHECK(ring.tip_radius() == relative(r - m * (0.8 + shift), 1e-14));
    CHECK(ring.root_radius() == relative(r + m * (1.25 - shift), 1e-14));
    CHECK(ring.tip_roll_angle() < ring.form_roll_angle());
    CHECK(ring.thickness_at_radius(r) ==
          relative(m * (0.5 * kPi + 2 * shift * std::tan(alpha)) - design.tooth_thinning, 1e-13));
    CHECK(ring.thickness_at_radius(ring.tip_radius()) < ring.thickness_at_radius(r));
    // Tooth and space fill the pitch, the space being the tooth of an external gear on the same base circle.
    for (double xi = ring.tip_roll_angle(); xi < ring.form_roll_angle(); xi += 0.01) {
      const Vec2 p = ring.flank_point(xi), n = ring.flank_normal(xi);
      const double radius = p.norm(), pitch = 2 * kPi * radius / design.teeth;
      const double filler = m * (0.5 * kPi - 2 * shift * std::tan(alpha)) + design.tooth_thinning;
      const double space =
          2 * radius * (filler / (2 * r) + inv(alpha) - inv(std::acos(ring.base_radius() / radius)));
      CHECK(ring.thickness_at_radius(radius) + space == relative(pitch, 1e-13));
      CHECK(radius * (std::atan2(p.y(), p.x()) - 0.5 * kPi) ==
            relative(0.5 * ring.thickness_at_radius(radius), 1e-11));
      // A turn by one radian moves every flank point by the base radius along its normal.
      CHECK(n.dot(Vec2(-p.y(), p.x())) == relative(ring.base_radius(), 1e-13));
      const Vec2 along = (ring.flank_point(xi + 1e-6) - ring.flank_point(xi - 1e-6)).normalized();
      CHECK(std::abs(n.dot(along)) < 1e-9);
      CHECK(n.x() < 0);  // out of the material of the tooth, whose middle is x = 0
    }
  }
}

TEST_CASE("root of a ring: the fillet touches involute and root circle, whatever its radius") {
  GearDesign design = ring_gear();
  for (const double radius : {0.05, 0.2, 0.35}) {
    CAPTURE(radius);
    design.rack_tip_radius = radius;
    const ToothGeometry ring(design);
    const double rho = radius * design.module;
    const Vec2 start = ring.root_point(0), end = ring.root_point(ring.root_corner());
    CHECK((start - ring.flank_point(ring.form_roll_angle())).norm() < 1e-15);
    const auto tangent = [&](double t) {
      const double step = 1e-6;
      return (ring.root_point(t + step) - ring.root_point(t - step)).normalized();
    };
    CHECK(std::abs(tangent(2e-6).dot(ring.flank_normal(ring.form_roll_angle()))) < 1e-4);
    CHECK(end.norm() == relative(ring.root_radius(), 1e-14));
    CHECK(std::abs(tangent(ring.root_corner() - 2e-6).dot(end.normalized())) < 1e-4);
    const Vec2 centre = end * (1 - rho / end.norm());
    for (double t = 0; t < ring.root_corner(); t += 0.05)
      CHECK((ring.root_point(t) - centre).norm() == relative(rho, 1e-12));
    const Vec2 middle = ring.root_point(1);
    CHECK(std::atan2(middle.y(), middle.x()) == relative(0.5 * kPi + kPi / design.teeth, 1e-14));
    CHECK(middle.norm() == relative(ring.root_radius(), 1e-14));
  }
}

TEST_CASE("internal mesh: working pressure angle, contact ratio, points of the path by their closed forms") {
  const GearPair pair = planet_in_ring();
  const ToothGeometry &planet = pair.gear(0), &ring = pair.gear(1);
  CHECK(pair.working_pressure_angle() == relative(20.19 * kDegree, 1e-12));
  const auto string = [](double tip, double base) { return std::sqrt(tip * tip - base * base); };
  const double expected =
      (string(planet.tip_radius(), planet.base_radius()) - string(ring.tip_radius(), ring.base_radius()) +
       kInternalDistance * std::sin(pair.working_pressure_angle())) /
      pair.base_pitch();
  CHECK(pair.contact_ratio() == relative(expected, 1e-12));
  CHECK(pair.contact_ratio() == relative(1.8, 0.1));
  CHECK(pair.backlash() == relative(2 * 0.03e-3 * std::cos(20.19 * kDegree), 1e-9));

  const auto points = path_points(pair);
  CHECK(points[0].diameter[1] == relative(2 * ring.tip_radius(), 1e-12));
  CHECK(points[4].diameter[0] == relative(2 * planet.tip_radius(), 1e-12));
  CHECK(points[2].diameter[1] - points[2].diameter[0] == relative(2 * kInternalDistance, 1e-12));

  // The reverse: what was the end is the beginning.
  const GearPair back = ring_about_planet();
  CHECK(back.contact_ratio() == relative(pair.contact_ratio(), 1e-13));
  CHECK(back.path_start() == relative(-pair.path_end(), 1e-13));
  CHECK(back.backlash() == relative(pair.backlash(), 1e-12));

  // A distance that is not the reference one, with shifts that keep the backlash at nothing: inv alpha_w = inv alpha +
  // 2 tan alpha (-x2 - x1) / (z2 - z1).
  GearDesign a = planet_gear(), b = ring_gear();
  a.tooth_thinning = b.tooth_thinning = 0;
  a.profile_shift = 0.2;
  b.profile_shift = -0.4;
  const double alpha = a.pressure_angle, wanted = inv(alpha) + 2 * std::tan(alpha) * 0.2 / 64;
  double working = alpha;
  for (int i = 0; i < 50; ++i) working -= (inv(working) - wanted) / std::pow(std::tan(working), 2);
  const GearPair shifted(a, b, kInternalDistance * std::cos(alpha) / std::cos(working));
  CHECK(std::abs(shifted.backlash()) < 1e-15);
}

TEST_CASE("internal mesh: relative curvature is the difference, and the second derivative of the exact gap") {
  for (const GearPair& pair : {planet_in_ring(), ring_about_planet()}) {
    CAPTURE(pair.ring());
    double largest = 0;
    for (double f = -0.7; f < 0.71; f += 0.1) {
      CAPTURE(f);
      const double path = f * pair.base_pitch();
      if (path < pair.path_start() || path > pair.path_end()) continue;
      const double rho0 = pair.gear(0).base_radius() * pair.nominal_roll(0, path),
                   rho1 = pair.gear(1).base_radius() * pair.nominal_roll(1, path);
      const double radius = pair.relative_curvature_radius(path);
      CHECK(1 / radius == relative(std::abs(1 / rho0 - 1 / rho1), 1e-12));
      CHECK(std::abs(rho0 - rho1) ==
            relative(kInternalDistance * std::sin(pair.working_pressure_angle()), 1e-12));
      largest = std::max(largest, radius);
      const PairContact contact = pair.contact(f);
      CHECK_FALSE(contact.corner);
      CHECK(pair.relative_curvature_radius(contact) == relative(radius, 1e-12));
      const double h = 2e-5;
      const double second = (pair.gap_at(contact, h).gap + pair.gap_at(contact, -h).gap) / (h * h);
      CHECK(second == relative(1 / radius, 1e-3));
      CHECK(std::abs(pair.gap_at(contact, 0).gap) < 1e-18);
    }
    CHECK(pair.largest_relative_curvature_radius() >= largest);
    CHECK(std::isfinite(pair.edge_distance(pair.contact(0.8), 0)));
  }
}

TEST_CASE(
    "placed gears of an internal pair touch without load at every phase, each pair on the path of contact") {
  for (const GearPair& pair : {planet_in_ring(), ring_about_planet()}) {
    CAPTURE(pair.ring());
    const int pinion = 1 - pair.ring(), ring = pair.ring();
    const double rb = pair.gear(pinion).base_radius();
    for (double phase = 0; phase < 1; phase += 0.0625)
      for (int number = -1; number <= 1; ++number) {
        const double path = (phase + number) * pair.base_pitch();
        if (path < pair.path_start() || path > pair.path_end()) continue;
        // Both nominal points are one point, on the line of action.
        const Vec2 p = working_flank(pair, 0, phase, number, pair.nominal_roll(0, path)),
                   q = working_flank(pair, 1, phase, number, pair.nominal_roll(1, path));
        CHECK((p - q).norm() < 1e-15);
        const Vec2 pitch_point(0, pair.gear(0).base_radius() / std::cos(pair.working_pressure_angle()));
        CHECK(std::abs((p - pitch_point).dot(contact_normal(pair)) - path) < 1e-15);
        // And nowhere does the ring's flank enter the pinion's: the string to the pinion's base circle says how far off it is.
        double least = std::numeric_limits<double>::infinity();
        const Vec2 axis = placed(pair, pinion).centre;
        const double nominal = pair.nominal_roll(pinion, path);
        const double angle_at_nominal = std::atan2(p.y() - axis.y(), p.x() - axis.x());
        const double sign = pinion == 0 ? 1 : -1;  // the working flank runs this way round from its tip
        for (int i = 0; i <= 400; ++i) {
          const double xi = pair.gear(ring).tip_roll_angle() +
                            (pair.gear(ring).form_roll_angle() - pair.gear(ring).tip_roll_angle()) * i / 400;
          const Vec2 at = working_flank(pair, ring, phase, number, xi) - axis;
          if (at.norm() < rb * (1 + 1e-9) || at.norm() > pair.gear(pinion).tip_radius()) continue;
          const double string = std::sqrt(at.squaredNorm() - rb * rb), t = string / rb;
          const double turn = sign * (std::atan2(at.y(), at.x()) - angle_at_nominal);
          const double roll = t - std::atan(t) + turn - (nominal - std::atan(nominal));
          least = std::min(least, rb * roll);
        }
        CHECK(least > -1e-14);
        CHECK(least < 1e-6);
      }
  }
}

TEST_CASE("tip edges of an internal pair: gaps against a search over both flanks") {
  for (const GearPair& pair : {planet_in_ring(), ring_about_planet()}) {
    CAPTURE(pair.ring());
    for (double f = -2.4; f <= 2.41; f += 0.2) {
      CAPTURE(f);
      const double path = f * pair.base_pitch();
      if (pair.nominal_roll(0, path) <= 0 || pair.nominal_roll(1, path) <= 0) continue;
      const PairContact contact = pair.contact(f);
      if (!contact.corner || !contact.on_flank) continue;
      CHECK(contact.gap > 0);
      // The edge against a fine walk along the other flank, tooth 0 at phase f.
      const int tip = contact.tip_gear, flank = 1 - tip;
      const Vec2 edge = working_flank(pair, tip, f, 0, pair.gear(tip).tip_roll_angle());
      double least = std::numeric_limits<double>::infinity();
      const ToothGeometry& other = pair.gear(flank);
      for (int i = 0; i <= 40000; ++i)
        least = std::min(least,
                         (working_flank(pair, flank, f, 0,
                                        other.tip_roll_angle() +
                                            (other.form_roll_angle() - other.tip_roll_angle()) * i / 40000) -
                          edge)
                             .norm());
      CHECK(contact.gap == relative(least, 1e-4));
      // The lever arm is the moment of the contact's normal about the axis.
      const Vec2 normal = contact_normal(pair, contact);
      for (int g = 0; g < kSides; ++g) {
        const Vec2 at =
            working_flank(pair, g, f, 0, contact.roll[static_cast<size_t>(g)]) - placed(pair, g).centre;
        const double moment = at.x() * normal.y() - at.y() * normal.x();
        CHECK(moment ==
              relative(contact.lever[static_cast<size_t>(g)] * (pair.internal() || g == 0 ? 1 : -1), 1e-9));
      }
      // No two points of the flanks are nearer to each other.
      double nearest = std::numeric_limits<double>::infinity();
      for (int i = 0; i <= 300; ++i) {
        const ToothGeometry& own = pair.gear(tip);
        const Vec2 p = working_flank(
            pair, tip, f, 0, own.tip_roll_angle() + (own.form_roll_angle() - own.tip_roll_angle()) * i / 300);
        for (int j = 0; j <= 300; ++j)
          nearest = std::min(
              nearest, (p - working_flank(pair, flank, f, 0,
                                          other.tip_roll_angle() +
                                              (other.form_roll_angle() - other.tip_roll_angle()) * j / 300))
                           .norm());
      }
      CHECK(contact.gap < nearest * (1 + 1e-3));
    }
  }
}

TEST_CASE("what cannot mesh inside a ring is rejected by name") {
  const auto pair_of = [](const GearDesign& a, const GearDesign& b, double distance) {
    return message_of_input([&] { GearPair(a, b, distance); });
  };
  const GearDesign planet = planet_gear(), ring = ring_gear();
  CHECK(pair_of(planet, ring, kInternalDistance).empty());
  CHECK(names(pair_of(ring, ring, kInternalDistance), {"both", "internal"}));
  GearDesign many = planet;
  many.teeth = 99;
  CHECK(names(pair_of(many, ring, kInternalDistance), {99, "more"}));
  CHECK(names(pair_of(planet, ring, 82e-3), {"reach"}));
  CHECK(names(pair_of(planet, ring, 80e-3), {"reach"}));
  CHECK(names(pair_of(planet, ring, 90e-3), {"jam"}));
  GearDesign high = planet;
  high.addendum = 1.3;
  CHECK(names(pair_of(high, ring, kInternalDistance), {"inside", "root"}));
  // The ring's tip below the pinion's base tangent point.
  GearDesign few = planet;
  few.teeth = 17;
  few.bore_radius = 10e-3;
  GearDesign deep = ring;
  deep.addendum = 1.22;
  CHECK(names(pair_of(few, deep, 41 * planet.module), {"involute interference"}));
  // A pinion with almost the ring's number of teeth: their tips meet beside the mesh.
  GearDesign large = planet;
  large.teeth = 95;
  large.addendum = 0.8;
  GearDesign wide = ring;
  wide.addendum = 0.8;
  CHECK(names(pair_of(large, wide, 2 * planet.module), {"trochoid interference"}));
  GearDesign hollow = ring;
  hollow.rim_outer_radius = 140e-3;
  CHECK(names(message_of_input([&] { ToothGeometry t(hollow); }), {"rim_outer_radius_mm"}));
  GearDesign low = ring;
  low.teeth = 22;
  CHECK(names(message_of_input([&] { ToothGeometry t(low); }), {"internal", "involute"}));
  GearDesign round = ring;
  round.rack_tip_radius = 0.6;
  CHECK(names(message_of_input([&] { ToothGeometry t(round); }), {"between", "space"}));
}

TEST_CASE("trochoid and trimming interference: where the closed forms set in, tips begin to overlap") {
  // Ring of 60, pinions of growing number of teeth: tips of the touching flanks against each other as the gears turn.
  GearDesign ring = ring_gear();
  ring.teeth = 60;
  ring.addendum = 0.6;
  int clear = 0, not_clear = 0;
  for (int teeth = 30; teeth <= 58; ++teeth) {
    GearDesign pinion = planet_gear();
    pinion.teeth = teeth;
    pinion.addendum = 0.6;
    pinion.bore_radius = 20e-3;
    const double distance = 0.5 * (60 - teeth) * ring.module;
    bool interferes = false;
    double clearance = 0, radial = 0;
    try {
      const GearPair pair(pinion, ring, distance);
      clearance = tip_clearance(pair);
      radial = radial_assembly_clearance(pair);
      // The pinion's edge as it crosses the ring's tip circle on its way out, angle by bisection on its radius.
      const auto edge = [&](double phase) {
        return working_flank(pair, 0, phase, 0, pair.gear(0).tip_roll_angle());
      };
      const Vec2 axis = placed(pair, 1).centre;
      double low = pair.path_end() / pair.base_pitch(), high = low;
      while ((edge(high) - axis).norm() > pair.gear(1).tip_radius()) high += 0.01;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        ((edge(middle) - axis).norm() > pair.gear(1).tip_radius() ? low : high) = middle;
      }
      const Vec2 p = edge(low) - axis,
                 q = working_flank(pair, 1, low, 0, pair.gear(1).tip_roll_angle()) - axis;
      const double ahead = std::atan2(q.y(), q.x()) - std::atan2(p.y(), p.x());
      CHECK(pair.gear(1).tip_radius() * ahead == relative(clearance, 1e-8));
    } catch (const Error& error) {
      interferes = names(error.what(), {"trochoid interference"});
      CHECK(interferes);
    }
    ++(interferes ? not_clear : clear);
    if (interferes) continue;
    // Closed form of the trimming condition (as gear handbooks have it): theta1 + inv aa1 - inv aw >= z2 / z1 (theta2 + inv aa2
    // - inv aw).
    const GearPair pair(pinion, ring, distance);
    const double aw = pair.working_pressure_angle(), aa1 = std::atan(pair.gear(0).tip_roll_angle()),
                 aa2 = std::atan(pair.gear(1).tip_roll_angle()), u = 60.0 / teeth;
    const double ratio = std::cos(aa1) / std::cos(aa2);
    const double theta1 = std::asin(std::sqrt((1 - ratio * ratio) / (1 - 1 / (u * u)))),
                 theta2 = std::asin(std::sqrt((1 / (ratio * ratio) - 1) / (u * u - 1)));
    const double margin = theta1 + inv(aa1) - inv(aw) - u * (theta2 + inv(aa2) - inv(aw));
    CAPTURE(teeth);
    CAPTURE(radial);
    CAPTURE(margin);
    if (std::isfinite(margin)) CHECK((radial > 0) == (margin > 0));
  }
  CHECK(clear > 5);
  CHECK(not_clear > 0);
}

TEST_CASE("sliding is the relative speed of the flanks at the touching point") {
  for (const GearPair& pair : {planet_in_ring(), ring_about_planet()}) {
    for (const double f : {-0.4, 0.3, 0.6}) {
      const double path = f * pair.base_pitch();
      const Vec2 p = working_flank(pair, 0, 0, 0, pair.nominal_roll(0, 0));
      const Vec2 touch = p + path * contact_normal(pair);
      const double ratio = static_cast<double>(pair.gear(0).design().teeth) / pair.gear(1).design().teeth;
      const auto velocity = [&](int g, double speed) {
        const Vec2 arm = touch - placed(pair, g).centre;
        return Vec2(speed * Vec2(-arm.y(), arm.x()));
      };
      const Vec2 slip = velocity(1, ratio) - velocity(0, 1);
      CHECK(std::abs(slip.dot(contact_normal(pair))) < 1e-14);
      const Vec2 n = contact_normal(pair);
      const double up = pair.ring() == 0 ? -1 : 1;
      const Vec2 to_tip = up * Vec2(n.y(), -n.x());
      CHECK(slip.dot(to_tip) == relative(pair.sliding(path), 1e-11));
    }
  }
}

TEST_CASE("system of an internal pair: teeth meet where the mesh says, both senses, either driver") {
  for (const bool ring_drives : {false, true}) {
    const GearDesign a = ring_drives ? ring_gear() : planet_gear(),
                     b = ring_drives ? planet_gear() : ring_gear();
    const GearPair pair(a, b, kInternalDistance);
    for (const double direction : {0.5 * kPi, 0.3, -2.0}) {
      System system;
      add_input_gear(system, "a", a);
      add_driven_gear(system, 0, a, "b", b, kInternalDistance, direction);
      const System::Mesh& mesh = system.meshes[0];
      CHECK(system.bodies[1].sense == system.bodies[0].sense);
      CHECK(mesh.side[0].flank != mesh.side[1].flank);
      for (const double phase : {0.0, 0.3, 0.9})
        for (int number = -1; number <= 1; ++number) {
          Vec2 at[2];
          for (int s = 0; s < kSides; ++s) {
            const System::Side& side = mesh.side[static_cast<size_t>(s)];
            const System::Body& body = system.bodies[static_cast<size_t>(side.body)];
            Vec2 own = pair.gear(s).flank_point(pair.nominal_roll(s, (phase + number) * pair.base_pitch()));
            if (side.flank == FlankSide::trailing) own.x() = -own.x();
            const double angle =
                body.angle + (body.sense * phase + side.tooth(number)) * 2 * kPi / body.teeth;
            at[s] = Vec2(body.centre[0], body.centre[1]) + turned(angle, own);
          }
          CHECK((at[0] - at[1]).norm() < 1e-14);
        }
    }
  }
}

TEST_CASE("inertia of a ring as outlined: between that of its rim and that of all to its tips") {
  const GearDesign design = ring_gear();
  const ToothGeometry ring(design);
  const Material steel{206e9, 0.3, 7850, true};
  const double disc = 0.5 * kPi * steel.density * design.face_width,
               outer = std::pow(design.rim_outer_radius, 4);
  CHECK(least_body_inertia(ring, steel) > 0.99 * disc * (outer - std::pow(ring.root_radius(), 4)));
  CHECK(least_body_inertia(ring, steel) < disc * (outer - std::pow(ring.tip_radius(), 4)));
}
