// Tooth and pair geometry against closed forms: everything here is exact, tolerances are round-off.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "gear/iso6336.h"
#include "gear/pair.h"
#include "gear/path_points.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"

using namespace whine;

namespace {
constexpr double kDegree = std::numbers::pi / 180;

GearDesign fzg_c(int teeth, double shift, double tip_diameter) {
  GearDesign d;
  d.teeth = teeth;
  d.module = 4.5e-3;
  d.pressure_angle = 20 * kDegree;
  d.profile_shift = shift;
  d.addendum = (tip_diameter / 2 - 0.5 * d.module * teeth) / d.module - shift;
  d.face_width = 14e-3;
  d.bore_radius = 10e-3;
  return d;
}

std::string rejection(const GearDesign& d) {
  return message_of([&] { ToothGeometry tooth(d); });
}

std::string rejection(const GearDesign& a, const GearDesign& b, double centre) {
  return message_of([&] { GearPair pair(a, b, centre); });
}
}  // namespace

TEST_CASE("points A to E: pairs come and go at tips, and both diameters lie on the line of action") {
  const GearPair pair(fzg_c(16, 0.1817, 82.64e-3), fzg_c(24, 0.1715, 118.54e-3), 91.5e-3);
  const auto points = path_points(pair);
  const double along = pair.centre_distance() * std::sin(pair.working_pressure_angle());
  for (const PathPoint& p : points) {
    CAPTURE(p.name);
    const auto reach = [&](int g) {
      const double base = pair.gear(g).base_radius(), r = p.diameter[static_cast<size_t>(g)] / 2;
      return std::sqrt(r * r - base * base);
    };
    CHECK(reach(0) + reach(1) == relative(along, 1e-12));
  }
  CHECK(points[0].diameter[1] == relative(118.54e-3, 1e-12));  // driven tip
  CHECK(points[4].diameter[0] == relative(82.64e-3, 1e-12));   // driver's tip
  CHECK(points[2].diameter[0] + points[2].diameter[1] == relative(2 * 91.5e-3, 1e-12));
  CHECK(points[4].path - points[1].path == relative(pair.base_pitch(), 1e-12));
  CHECK(points[3].path - points[0].path == relative(pair.base_pitch(), 1e-12));
}

TEST_CASE("the paper's gear has base radius 70.4769 mm, base pitch 8.85639 mm, contact ratio 1.7547") {
  const GearPair pair(paper_gear(), paper_gear(), 0.150);
  CHECK(pair.gear(0).base_radius() == relative(70.4769466e-3, 1e-9));
  CHECK(pair.base_pitch() == relative(8.8563943e-3, 1e-8));
  CHECK(pair.contact_ratio() == relative(1.7546733, 1e-7));
  CHECK(pair.path_end() - pair.path_start() == relative(15.5400785e-3, 1e-8));
  CHECK(pair.gear(0).tip_roll_angle() / kDegree == relative(27.17, 2e-4));
  CHECK(std::abs(pair.backlash()) < 1e-15);
}

TEST_CASE("FZG type C: working pressure angle 22.439 deg and contact ratio 1.437 with profile shift") {
  const GearPair pair(fzg_c(16, 0.1817, 82.46e-3), fzg_c(24, 0.1715, 118.36e-3), 91.5e-3);
  CHECK(pair.working_pressure_angle() / kDegree == relative(22.439, 2e-5));
  CHECK(pair.contact_ratio() == relative(1.437, 5e-4));
  CHECK(std::abs(pair.backlash()) < 2e-6);  // the printed shifts have four digits: 4.5 mm * 1e-4 * sin 20
}

TEST_CASE("trochoid and involute meet, root arc and trochoid meet") {
  for (const GearDesign& d : {paper_gear(), fzg_c(16, 0.1817, 82.46e-3)}) {
    const ToothGeometry tooth(d);
    CHECK((tooth.flank_point(tooth.form_roll_angle()) - tooth.root_point(0)).norm() < 1e-15);
    const double arc = tooth.root_corner();
    CHECK((tooth.root_point(arc) - tooth.root_point(arc + 1e-12)).norm() < 1e-13);
    CHECK(tooth.root_point(1).norm() == relative(tooth.root_radius(), 1e-14));
    // Tangents agree where the trochoid meets the involute: the rack's straight flank is tangent to its
    // rounding.
    const Vec2 along = tooth.root_point(1e-7) - tooth.root_point(0);
    CHECK(std::abs(along.normalized().dot(tooth.flank_normal(tooth.form_roll_angle()))) < 1e-5);
  }
}

TEST_CASE("the flank normal is tangent to the base circle") {
  const ToothGeometry tooth(paper_gear());
  for (double xi = tooth.form_roll_angle(); xi < tooth.tip_roll_angle(); xi += 0.02) {
    const Vec2 p = tooth.flank_point(xi), n = tooth.flank_normal(xi);
    CHECK(p.x() * n.y() - p.y() * n.x() == relative(tooth.base_radius(), 1e-13));
  }
}

TEST_CASE("unloaded conjugate flanks: gap below 1e-12 m along the path, curvature 1/R, no negative gap") {
  for (const GearPair& pair :
       {GearPair(paper_gear(), paper_gear(), 0.150),
        GearPair(fzg_c(16, 0.1817, 82.46e-3), fzg_c(24, 0.1715, 118.36e-3), 91.5e-3)}) {
    for (double path = pair.path_start(); path <= pair.path_end(); path += 0.02 * pair.base_pitch()) {
      const PairContact c = pair.contact(path / pair.base_pitch());
      REQUIRE_FALSE(c.corner);
      CHECK(std::abs(pair.gap_at(c, 0).gap) < 1e-12);
      for (double x : {-3e-4, -1e-4, 1e-4, 3e-4})
        if (x > c.x_min && x < c.x_max) CHECK(pair.gap_at(c, x).gap > 0);
      // x^2 / (2 R) and x^3 / 6 (rb2 / rho2^3 - rb1 / rho1^3), an involute's curvature 1 / rho falling by rb / rho^3
      // along its arc: what is left is of fourth order, where neither coefficient may be off. (Near the base circles
      // the cubic term is a fifth of the gap at 0.3 mm.)
      const auto rest = [&](double x) {
        double cubic = 0;
        for (int g = 0; g < kSides; ++g) {
          const double rb = pair.gear(g).base_radius();
          cubic += (g == 0 ? -1 : 1) * rb / std::pow(rb * c.roll[g], 3);
        }
        return pair.gap_at(c, x).gap - x * x * (0.5 / pair.relative_curvature_radius(path) + cubic * x / 6);
      };
      for (double x : {-4e-5, 4e-5})
        if (x > c.x_min && x < c.x_max) CHECK(std::abs(std::log2(rest(x) / rest(0.5 * x)) - 4) < 0.2);
      // The second derivative itself, by a central difference: the odd term drops out.
      const double h = 8e-6;
      if (h < c.x_max && -h > c.x_min) {
        const double second = (pair.gap_at(c, h).gap + pair.gap_at(c, -h).gap) / (h * h);
        CHECK(second == relative(1 / pair.relative_curvature_radius(path), 1e-4));
      }
    }
  }
}

TEST_CASE("conjugate action: gears turned in the ratio of their teeth touch in one point, by brute force") {
  // Nothing here knows of lines of action: flank points of both bodies, turned about their centres by theta and
  // -theta z1 / z2 from the position in which the flanks touch at the pitch point.
  for (const GearPair& pair :
       {GearPair(paper_gear(), paper_gear(), 0.150),
        GearPair(fzg_c(16, 0.1817, 82.46e-3), fzg_c(24, 0.1715, 118.36e-3), 91.5e-3)}) {
    const ToothGeometry &one = pair.gear(0), &two = pair.gear(1);
    const double rw1 = one.base_radius() / std::cos(pair.working_pressure_angle());
    const Vec2 pitch_point(0, rw1);
    const auto turn_to = [&](const ToothGeometry& tooth, const Vec2& target) {
      const Vec2 p = tooth.flank_point(tooth.roll_angle_at_radius(target.norm()));
      return std::atan2(target.y(), target.x()) - std::atan2(p.y(), p.x());
    };
    const Vec2 centre(0, pair.centre_distance());
    const double start1 = turn_to(one, pitch_point), start2 = turn_to(two, pitch_point - centre);
    for (double phase : {-0.6, -0.2, 0.0, 0.35, 0.6}) {
      const double theta = phase * 2 * std::numbers::pi / one.design().teeth;
      const double ratio = static_cast<double>(one.design().teeth) / two.design().teeth;
      const Eigen::Rotation2Dd turn1(start1 + theta), turn2(start2 - theta * ratio);
      const auto point1 = [&](double xi) { return Vec2(turn1 * one.flank_point(xi)); };
      const auto point2 = [&](double xi) { return Vec2(turn2 * two.flank_point(xi) + centre); };
      // Signed distance of a point of flank 1 from flank 2, along flank 2's normal where that passes through it.
      const auto separation = [&](double xi1) {
        const Vec2 p = point1(xi1);
        double low = two.form_roll_angle() - 0.1, high = two.tip_roll_angle() + 0.1;
        for (int i = 0; i < 100; ++i) {  // the tangential offset changes sign once
          const double xi = 0.5 * (low + high);
          const Vec2 n = turn2 * two.flank_normal(xi), along(n.y(), -n.x());
          // Towards the tip the tangent has a positive radial part.
          const double sign = along.dot(point2(xi) - centre) > 0 ? 1 : -1;
          (sign * along.dot(p - point2(xi)) > 0 ? low : high) = xi;
        }
        const double xi = 0.5 * (low + high);
        return (p - point2(xi)).dot(turn2 * two.flank_normal(xi));
      };
      double least = 1, at = 0;
      double low = one.form_roll_angle(), high = one.tip_roll_angle();
      for (int i = 0; i < 200; ++i) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (separation(a) < separation(b) ? high : low) = separation(a) < separation(b) ? b : a;
      }
      at = 0.5 * (low + high);
      least = separation(at);
      CHECK(std::abs(least) < 1e-12);
      // ... and it is the point that the kinematics name, to the square root of the distance's round-off.
      CHECK(std::abs(at - pair.contact(phase).roll[0]) < 1e-5);
    }
  }
}

TEST_CASE("corner contact: gap grows from zero at the ends of the path, by two independent ways") {
  const GearPair pair(paper_gear(), paper_gear(), 0.150);
  double before = 0;
  for (double extra = 0.002; extra < 0.15; extra += 0.01) {
    const double phase = pair.path_end() / pair.base_pitch() + extra;
    const PairContact exit = pair.contact(phase), entry = pair.contact(-phase);
    REQUIRE(exit.corner);
    CHECK(exit.tip_gear == 0);
    CHECK(entry.tip_gear == 1);
    CHECK(exit.gap > before);
    before = exit.gap;
    // Equal gears: entry and exit are mirror images.
    CHECK(std::abs(exit.gap - entry.gap) < 1e-17 + 1e-12 * exit.gap);
    CHECK(exit.lever[1] == pair.gear(1).base_radius());
    CHECK(exit.lever[0] < pair.gear(0).base_radius());
    CHECK(exit.lever[0] > 0.95 * pair.gear(0).base_radius());
    CHECK(exit.lever[0] == relative(entry.lever[1], 1e-12));
    // gap_at iterates on both involutes, contact() has a closed form.
    CHECK(std::abs(pair.gap_at(exit, 0).gap - exit.gap) < 1e-15);
    // The tip edge is the nearest point of its flank: nothing inward is closer.
    CHECK(pair.gap_at(exit, -1e-4).gap > exit.gap);
  }
}

TEST_CASE("corner gap equals the separation of points found by brute force") {
  // Edge and touched flank placed in one plane through flank_point(), which knows nothing of contact(). The second phase lies past
  // the tangent point of the driven gear's base circle.
  for (const bool past : {false, true}) {
    CAPTURE(past);
    const GearPair pair(past ? paper_gear(60) : paper_gear(), past ? paper_gear(18, 10e-3) : paper_gear(),
                        past ? 0.117 : 0.150);
    const double phase = past ? 1.07 : pair.path_end() / pair.base_pitch() + 0.08;
    if (past) REQUIRE(pair.nominal_roll(1, phase * pair.base_pitch()) < 0);
    const double alpha = pair.working_pressure_angle(), path = phase * pair.base_pitch();
    const auto place = [&](int g, double xi) {
      const ToothGeometry& tooth = pair.gear(g);
      const double rb = tooth.base_radius(), nominal = std::tan(alpha) + (g == 0 ? path : -path) / rb;
      // Turn the flank so that the normal at the nominal roll angle lies along the line of action, at alpha to
      // the perpendicular of the line of centres (+y); driver at the origin, driven gear at (0, a) turned by
      // 180 deg.
      const Vec2 n = tooth.flank_normal(nominal);
      const double turn = (std::numbers::pi - alpha) - std::atan2(n.y(), n.x());
      const Vec2 p = Eigen::Rotation2Dd(turn) * tooth.flank_point(xi);
      return g == 0 ? p : Vec2(-p.x(), pair.centre_distance() - p.y());
    };
    const Vec2 edge = place(0, pair.gear(0).tip_roll_angle());
    const auto distance = [&](double xi) { return (place(1, xi) - edge).norm(); };
    double low = pair.gear(1).form_roll_angle(), high = pair.gear(1).tip_roll_angle();
    for (int i = 0; i < 200; ++i) {  // the distance has one minimum on the flank
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
    }
    CHECK(pair.contact(phase).gap == relative(distance(0.5 * (low + high)), 1e-7));
    CHECK(pair.contact(phase).roll[1] == relative(0.5 * (low + high), 1e-4));
  }
}

TEST_CASE("the gap's slope and curvature at the touching point, on the line of action and at corners") {
  const GearPair pair(fzg_c(16, 0.1817, 82.46e-3), fzg_c(24, 0.1715, 118.36e-3), 91.5e-3);
  const double start = pair.path_start() / pair.base_pitch(), end = pair.path_end() / pair.base_pitch();
  int edge_distances = 0;
  for (double phase : {start - 0.08, start - 0.02, 0.5 * start, 0.0, 0.7 * end, end - 0.03, end - 0.01,
                       end + 0.02, end + 0.08}) {
    const PairContact contact = pair.contact(phase);
    REQUIRE(contact.corner == (phase < start || phase > end));
    // Inwards from the edge that touches; differences of a gap that is exact to round-off, extrapolated.
    const double inward = contact.corner && contact.tip_gear == 0 ? -1 : 1, h = 8e-6;
    const auto gap = [&](double x) { return pair.gap_at(contact, inward * x).gap; };
    const auto second = [&](double step) { return (gap(0) - 2 * gap(step) + gap(2 * step)) / (step * step); };
    const double curvature = 2 * second(0.5 * h) - second(h);
    CHECK(1 / pair.relative_curvature_radius(contact) == relative(curvature, 1e-4));
    const double slope = (4 * gap(0.5 * h) - gap(h) - 3 * gap(0)) / h;
    if (contact.corner) CHECK(std::tan(contact.normal_angle) == relative(slope, 1e-3));
    if (!contact.corner)
      CHECK(pair.relative_curvature_radius(contact) ==
            relative(pair.relative_curvature_radius(phase * pair.base_pitch()), 1e-12));
    // The driver's tip edge in the frame of the contact, from its flank's arc: the tangent is shorter by a sixth of
    // (arc / radius of curvature)^2.
    const ToothGeometry& driver = pair.gear(0);
    const double arc = driver.arc_length(driver.tip_roll_angle()) - driver.arc_length(contact.roll[0]);
    if (std::isfinite(pair.edge_distance(contact, 0)) && !contact.corner) {
      const double bend = arc / (driver.base_radius() * contact.roll[0]);
      CHECK(pair.edge_distance(contact, 0) == relative(arc * (1 - bend * bend / 6), bend * bend * bend));
      ++edge_distances;
    }
    if (contact.corner) CHECK(pair.edge_distance(contact, contact.end()) < 1e-15);
  }
  CHECK(edge_distances >= 2);
}

TEST_CASE("gears that cannot exist are rejected with the reason") {
  GearDesign d = paper_gear();
  d.addendum = 4;
  CHECK(names(rejection(d), {"thickness", "tip"}));
  d = paper_gear();
  d.bore_radius = 72e-3;
  CHECK(names(rejection(d), {"radius", "root"}));
  d = paper_gear();
  d.rack_tip_radius = 0.6;
  CHECK(names(rejection(d), {"rack_tip_radius"}));
  CHECK(rejection(paper_gear()).empty());
}

TEST_CASE("pairs that do not reach, jam or run with a contact ratio below 1 are rejected with the reason") {
  const GearDesign d = paper_gear();
  CHECK(names(rejection(d, d, 0.160), {"reach"}));
  CHECK(names(rejection(d, d, 0.1498), {"jam"}));
  CHECK(names(rejection(d, d, 0.140), {"jam"}));
  CHECK(names(rejection(d, d, 0.1535), {"contact", "ratio"}));
  GearDesign other = d;
  other.module = 2.9e-3;
  CHECK(names(rejection(d, other, 0.150), {"pitches", "differ"}));
  CHECK(rejection(d, d, 0.150).empty());
}

TEST_CASE("ISO 6336-1 method B: tooth stiffness of 25 and 76 teeth, by hand") {
  GearDesign pinion, wheel;
  pinion.teeth = 25;
  wheel.teeth = 76;
  pinion.profile_shift = 0.2485;
  wheel.profile_shift = -0.2485;
  for (GearDesign* g : {&pinion, &wheel}) {
    g->module = 6e-3;
    g->pressure_angle = 20 * std::numbers::pi / 180;
    g->face_width = 44e-3;
  }
  const Material steel{206e9, 0.3, 7850, true};
  // q' = 0.04723 + 0.00622040 + 0.00339355 - 0.00157798 - 0.00115841 + 0.00047961 + 0.00079088
  //      + 0.00032667 + 0.00011239 = 0.05581712 mm um / N; C_B = 1 + 0.5 (1.2 - 1.25) = 0.975.
  const double single = 0.8 * 0.975 / 0.05581712;  // 13.974
  const IsoStiffness iso = iso_6336_stiffness(pinion, steel, wheel, steel, 1624.77, 1.6);
  CHECK(iso.single * 1e-9 == relative(13.974, 1e-4));
  CHECK(iso.single * 1e-9 == relative(single, 1e-6));
  CHECK(iso.mesh * 1e-9 == relative(single * 1.45, 1e-6));
  CHECK(iso.line_load == relative(1624.77 / 0.075 / 0.044, 1e-12));
  CHECK(iso.in_range);
  // The pinion is gear 1 of the formula whoever drives.
  const auto stiffness = [&](const Material& of_wheel, double torque) {
    return iso_6336_stiffness(pinion, steel, wheel, of_wheel, torque, 1.6).single;
  };
  CHECK(iso_6336_stiffness(wheel, steel, pinion, steel, 1624.77 * 76 / 25, 1.6).single ==
        relative(iso.single, 1e-12));
  // Below 100 N/mm by the power 0.25 of the load: half at 6.25 N/mm.
  CHECK(stiffness(steel, 6.25e3 * 0.044 * 0.075) == relative(0.5 * iso.single, 1e-12));
  // On iron of half the modulus: 2 E1 E2 / (E1 + E2) is two thirds.
  CHECK(stiffness({103e9, 0.3, 7200, true}, 1624.77) == relative(iso.single * 2 / 3, 1e-12));
  pinion.dedendum = wheel.dedendum = 1.4;
  CHECK(stiffness(steel, 1624.77) == relative(iso.single * 0.9 / 0.975, 1e-12));
}
