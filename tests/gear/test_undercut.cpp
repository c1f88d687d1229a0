// Teeth that their rack undercuts: the tooth against rolling positions of the rack, path of contact, edges, remarks.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "gear/iso6336_strength.h"
#include "gear/scene_geometry.h"
#include "gear/undercut.h"
#include "refusal.h"
#include "relative.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "solid/root_stress.h"
#include "system/drawing_remarks.h"
#include "system/statics.h"

using namespace whine;

namespace {
constexpr double kPi = std::numbers::pi, kModule = 3e-3;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

GearDesign cut(int teeth, double shift, double rack_tip = 0.38, double dedendum = 1.25, double degrees = 20) {
  GearDesign d;
  d.teeth = teeth;
  d.module = kModule;
  d.pressure_angle = degrees * kPi / 180;
  d.profile_shift = shift;
  d.rack_tip_radius = rack_tip;
  d.dedendum = dedendum;
  d.face_width = 20e-3;
  d.bore_radius = 0.4 * kModule * (0.5 * teeth - dedendum + shift);
  return d;
}

GearPair standard_pair(int z1, int z2) {
  return {cut(z1, 0), cut(z2, 0), 0.5 * kModule * (z1 + z2)};
}

// The rack's tooth, whose tip is rounded, as the disc of the rounding swept over the straight tooth that is smaller by it.
class Rack {
 public:
  explicit Rack(const GearDesign& d)
      : rolling_(0.5 * d.module * d.teeth),
        pitch_(2 * kPi / d.teeth),
        alpha_(d.pressure_angle),
        rounding_(d.rack_tip_radius * d.module) {
    const double reference =
        d.profile_shift * d.module;  // m: its reference line stands so far from the rolling line
    deep_ = d.dedendum * d.module - reference - rounding_;
    half_ = 0.25 * kPi * d.module + 0.5 * d.tooth_thinning - (deep_ + reference) * std::tan(alpha_) -
            rounding_ / std::cos(alpha_);
  }
  // m: of a point of the tooth's body frame from the rack's tooth in the space beside its driving flank, the least over all
  // rolling positions; below 0 within it. Infinite beyond 10 micrometres.
  double least(const Vec2& p) const {
    const Vec2 q = Eigen::Rotation2Dd(-0.5 * pitch_) * p;  // the middle of the space on +y
    const auto at = [&](double phi) { return distance(Eigen::Rotation2Dd(phi) * q, phi); };
    constexpr int kPlaces = 3000;
    constexpr double kFarthest = 1.5;
    const double step = 2 * kFarthest / kPlaces, golden = 0.5 * (std::sqrt(5.0) - 1);
    std::array<double, kPlaces + 1> value;
    for (int i = 0; i <= kPlaces; ++i) value[i] = at(-kFarthest + i * step);
    double best = kInfinity;
    for (int i = 1; i < kPlaces; ++i) {  // the flank and the tip of the rack may both come near
      if (value[i] > std::min(value[i - 1], value[i + 1]) || value[i] > 1e-5) continue;
      double low = -kFarthest + (i - 1) * step, high = low + 2 * step;
      while (high - low > 1e-9) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
      }
      best = std::min(best, at(0.5 * (low + high)));
    }
    return best;
  }

 private:
  double distance(const Vec2& p, double phi) const {
    const double across = std::abs(p.x() + rolling_ * phi) - half_, down = rolling_ - p.y() - deep_;
    const double off = across * std::cos(alpha_) + down * std::sin(alpha_),
                 up = across * std::sin(alpha_) - down * std::cos(alpha_);
    const double core = across <= 0 && (down > 0 || down > off) ? down
                        : up >= 0                               ? off
                                                                : std::hypot(across, down);
    return core - rounding_;
  }
  double rolling_, pitch_, alpha_, rounding_, deep_ = 0, half_ = 0;
};

// Of a pair placed at a phase: points of its working flanks.
Vec2 working(const GearPair& pair, int g, double phase, Vec2 p) {
  if (pair.internal() && g == 1) p.x() *= -1;
  return placed(pair, g, phase)(p);
}

GearDesign ring(int teeth, double addendum = 0.8) {
  GearDesign d = cut(teeth, 0);
  d.internal = true;
  d.bore_radius = 0;
  d.addendum = addendum;
  d.rim_outer_radius = 0.5 * kModule * teeth + 3 * kModule;
  return d;
}
}  // namespace

TEST_CASE("the tooth is what the rack leaves: no point inside it at any rolling position, each one touched") {
  GearDesign thin = cut(14, -0.1);
  thin.tooth_thinning = 0.1e-3;
  for (const GearDesign& d :
       {cut(17, 0), cut(12, 0.298), cut(10, 0), cut(8, 0), cut(17, 0, 0.0), cut(18, -0.1), thin,
        cut(12, 0, 0.2, 1.3, 14.5), cut(9, -0.2, 0.3, 1.2, 25), cut(24, 0.2)}) {
    CAPTURE(d.teeth);
    CAPTURE(d.profile_shift);
    const ToothGeometry tooth(d);
    const Rack rack(d);
    const auto on_boundary = [&](const Vec2& p, const Vec2& outward) {
      CHECK(std::abs(rack.least(p)) < 1e-12);
      CHECK(rack.least(p + 1e-6 * outward) < -1e-8);  // what is beyond is cut away
      CHECK(rack.least(p - 1e-6 * outward) > 1e-8);
    };
    const double form = tooth.form_roll_angle(), tip = tooth.tip_roll_angle();
    for (double s : {1e-3, 0.1, 0.3, 0.6, 0.95})
      on_boundary(tooth.flank_point(form + s * (tip - form)), tooth.flank_normal(form + s * (tip - form)));
    for (double t : {1e-3, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95}) {
      const double at = t * tooth.root_corner();
      const Vec2 along = tooth.root_point(at + 1e-7) - tooth.root_point(at - (at > 1e-7 ? 1e-7 : 0));
      on_boundary(tooth.root_point(at), Vec2(along.y(), -along.x()).normalized());
    }
    const Vec2 edge = tooth.flank_point(form);
    CHECK((edge - tooth.root_point(0)).norm() < 1e-14 * tooth.tip_radius());
    CHECK(std::abs(rack.least(edge)) < 1e-12);
    CHECK((tooth.undercut() > 0) == (d.profile_shift < shift_without_undercut(d)));
  }
}

TEST_CASE(
    "undercut: where the involute begins, by the rack alone; 17 and 12 teeth and the limit of their shift") {
  for (const GearDesign& d : {cut(17, 0), cut(10, 0), cut(12, 0), cut(14, 0, 0.25), cut(8, 0.1)}) {
    CAPTURE(d.teeth);
    const ToothGeometry tooth(d);
    const Rack rack(d);
    double low = 0, high = tooth.tip_roll_angle();
    while (high - low > 1e-9) {  // an involute point below the edge lies within the rack at some position
      const double middle = 0.5 * (low + high);
      (rack.least(tooth.flank_point(middle)) < -1e-15 ? low : high) = middle;
    }
    CHECK(std::abs(tooth.arc_length(tooth.form_roll_angle()) - tooth.arc_length(high)) < 3e-9);
  }
  // z_min = 2 (h - rho (1 - sin alpha)) / sin^2 alpha; 0.25 = 0.38 (1 - sin 20) in the handbooks, so 17.097 teeth.
  const double sine = std::sin(20 * kPi / 180);
  CHECK(shift_without_undercut(cut(17, 0)) == relative(1.25 - 0.38 * (1 - sine) - 8.5 * sine * sine, 1e-13));
  CHECK(std::abs(shift_without_undercut(cut(17, 0)) - (1 - 17 / 17.097)) < 1e-4);
  CHECK(shift_without_undercut(cut(12, 0)) == relative(0.2983, 1e-3));
  const GearDesign at = cut(12, 0);
  const double limit = shift_without_undercut(at);
  CHECK(ToothGeometry(cut(12, limit + 1e-9)).undercut() == 0);
  CHECK(ToothGeometry(cut(12, limit + 1e-9)).form_roll_angle() < 1e-8);
  CHECK(ToothGeometry(cut(12, limit - 1e-9)).form_roll_angle() < 1e-8);
  CHECK(ToothGeometry(cut(12, limit - 1e-3)).undercut() == relative(1e-3 * kModule / sine, 1e-9));
}

TEST_CASE("undercut: least width and inertia know of the neck, what leaves no tooth is rejected") {
  const ToothGeometry tooth(cut(10, 0));
  CHECK(tooth.neck() < 2 * std::abs(tooth.flank_point(tooth.form_roll_angle()).x()));
  for (double t : {0.0, 0.1, 0.3, 0.7}) {
    const Vec2 p = tooth.root_point(t);
    CHECK(2 * std::abs(p.x()) >= tooth.neck() * (1 - 1e-12));
    CHECK(tooth.half_span(p.norm()) == relative(std::atan2(-p.x(), p.y()), 1e-9));
  }
  CHECK(names(message_of_input([] { ToothGeometry(cut(5, -0.5, 0.2)); }), {"tooth", "rack"}));
  GearDesign low = cut(8, -0.3);
  std::string said;
  while (said.empty() && low.addendum > 0) {
    low.addendum -= 0.05;
    said = message_of_input([&] { ToothGeometry{low}; });
  }
  INFO(said);
  CHECK(names(said, {"profile_shift"}));
}

TEST_CASE("undercut: the path of contact begins where the flank does, contact ratio in closed form") {
  struct Case {
    int z1, z2;
    bool shortened;
  };
  for (const Case& c :
       {Case{17, 22, false}, {17, 17, false}, {10, 40, true}, {12, 60, true}, {14, 20, true}}) {
    CAPTURE(c.z1);
    const GearPair pair = standard_pair(c.z1, c.z2), turned = standard_pair(c.z2, c.z1);
    const double alpha = pair.gear(0).design().pressure_angle, rb1 = pair.gear(0).base_radius(),
                 rb2 = pair.gear(1).base_radius();
    const auto addendum = [&](const ToothGeometry& g) {
      return std::sqrt(std::pow(g.tip_radius(), 2) - std::pow(g.base_radius(), 2)) -
             g.base_radius() * std::tan(alpha);
    };
    const double edge = rb1 * std::tan(alpha) - rb1 * pair.gear(0).form_roll_angle();
    CHECK((addendum(pair.gear(1)) > edge) == c.shortened);
    const double length = addendum(pair.gear(0)) + std::min(addendum(pair.gear(1)), edge);
    CHECK(pair.contact_ratio() == relative(length / (kPi * kModule * std::cos(alpha)), 1e-12));
    CHECK(std::abs(pair.path_lost(0) - std::max(0.0, addendum(pair.gear(1)) - edge)) < 1e-14);
    CHECK(turned.contact_ratio() == relative(pair.contact_ratio(), 1e-12));
    CHECK(turned.path_end() == relative(-pair.path_start(), 1e-12));
    CHECK(std::abs(turned.path_lost(1) - pair.path_lost(0)) < 1e-14);
    if (!c.shortened) continue;
    CHECK(pair.nominal_roll(0, pair.path_start()) == relative(pair.gear(0).form_roll_angle(), 1e-10));
    CHECK(pair.gear(1).tip_roll_angle() > pair.nominal_roll(1, pair.path_start()));
    CHECK(rb2 > 0);
  }
}

TEST_CASE(
    "edges of undercut flanks: gaps and lever arms against a search over placed flanks, in either direction") {
  int edges = 0, tips = 0;
  for (const GearPair& pair :
       {standard_pair(10, 40), standard_pair(40, 10), standard_pair(12, 17),
        GearPair(cut(13, 0), ring(60, 0.7), 70.5e-3), GearPair(ring(60, 0.7), cut(13, 0), 70.5e-3)}) {
    CAPTURE(pair.gear(0).design().teeth);
    const int under = pair.gear(0).undercut() > 0 ? 0 : 1;
    const double from = (under == 0 ? pair.path_start() : pair.path_end()) / pair.base_pitch();
    for (double away = 1e-3; away < 0.6; away += 0.0173) {
      const double phase = from + (under == 0 ? -away : away);
      CAPTURE(away);
      if (!pair.in_reach(phase)) continue;
      const PairContact c = pair.contact(phase);
      REQUIRE(c.corner);
      if (!c.on_flank) continue;
      (c.undercut ? edges : tips) += 1;
      CHECK(c.gap > 0);
      const ToothGeometry &own = pair.gear(c.tip_gear), &other = pair.gear(1 - c.tip_gear);
      const Vec2 edge = working(pair, c.tip_gear, phase,
                                own.flank_point(c.undercut ? own.form_roll_angle() : own.tip_roll_angle()));
      const auto off = [&](double roll) {
        return (working(pair, 1 - c.tip_gear, phase, other.flank_point(roll)) - edge).norm();
      };
      double low = other.least_roll_angle(), high = other.largest_roll_angle();
      while (high - low > 1e-9) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (off(a) < off(b) ? high : low) = off(a) < off(b) ? b : a;
      }
      CHECK(std::abs(off(low) - c.gap) < 1e-12 + 1e-6 * c.gap);
      const Vec2 normal = contact_normal(pair, c);
      for (int g = 0; g < kSides; ++g) {
        const Vec2 at = working(pair, g, phase, pair.gear(g).flank_point(c.roll[g])) - placed(pair, g).centre;
        CHECK(std::abs(at.x() * normal.y() - at.y() * normal.x()) == relative(c.lever[g], 1e-8));
      }
      CHECK(pair.edge_distance(c, c.end()) < 1e-12);
      CHECK(pair.edge_gear(c, c.end()) == c.tip_gear);
      // From the edge on the gap opens at the angle between the normals.
      const double h = 1e-7, x = c.end() == 0 ? -h : h;
      CHECK((pair.gap_at(c, x).gap - c.gap) / h ==
            relative(std::tan(c.normal_angle) + 0.5 * h / pair.relative_curvature_radius(c), 1e-3));
    }
  }
  CHECK(edges > 40);
  CHECK(tips > 3);
}

TEST_CASE(
    "undercut roots: the other gear's tips pass them, by the rack alone; one that runs into them is rejected") {
  // m: how deep the tip edge of the mate comes into what the rack leaves of the pinion, the driver.
  const auto depth = [](const GearPair& placing, const ToothGeometry& mate) {
    const Rack rack(placing.gear(0).design());
    const double edge = placing.gear(0).flank_point(placing.gear(0).form_roll_angle()).norm();
    double deepest = -kInfinity;
    for (double phase = placing.path_start() / placing.base_pitch(); phase > -2; phase -= 2e-3) {
      const Vec2 tip = working(placing, 1, phase, mate.flank_point(mate.tip_roll_angle()));
      const Vec2 p = Eigen::Rotation2Dd(-placed(placing, 0, phase).angle) * tip;
      if (p.norm() < edge) deepest = std::max(deepest, std::min(rack.least(p), 1e-5));
    }
    return deepest;
  };
  for (const GearPair& pair : {standard_pair(10, 40), standard_pair(12, 60), standard_pair(14, 20)}) {
    CHECK(undercut_clearance(pair, 0) > 0);
    CHECK(depth(pair, pair.gear(1)) < 0);
  }
  CHECK(undercut_clearance(standard_pair(17, 17), 0) == kInfinity);
  const std::string said = message_of_input([] { GearPair(cut(10, 0), ring(30), 30e-3); });
  INFO(said);
  CHECK(names(said, {"0.00942*"}));
  const double into = depth(GearPair(cut(10, 0), ring(30, 0.6), 30e-3), ToothGeometry(ring(30)));
  CHECK(into > 5e-6);
  CHECK(into < 9.5e-6);
}

TEST_CASE(
    "undercut: the remarks name the gear, the amount, the shift that avoids it, and what the path loses") {
  const std::string words = undercut_words(cut(17, 0), "sun");
  INFO(words);
  CHECK(
      words.starts_with("[gear.sun] is undercut: the rack reaches 0.0496158 mm (0.0165386 modules) beyond"));
  CHECK(contains(words, "with profile_shift = 0.0057 or more"));
  CHECK(undercut_words(cut(17, 0.0057), "sun").empty());
  CHECK(undercut_words(cut(30, 0), "sun").empty());
  const std::string path = shortened_path_words(standard_pair(10, 40), {"pinion", "wheel"});
  INFO(path);
  CHECK(path.starts_with("the undercut of [gear.pinion] shortens the path of contact by 3.97475 mm"));
  CHECK(shortened_path_words(standard_pair(17, 22), {"pinion", "wheel"}).empty());
  // Results say both, as warnings.
  const std::vector<Remark> said = drawing_remarks(standard_pair(10, 40), {"pinion", "wheel"});
  REQUIRE(said.size() == 2);
  CHECK(said[0].warning);
  CHECK(said[0].words.starts_with("[gear.pinion] is undercut: "));
  CHECK(said[1].warning);
  CHECK(said[1].words == path);
  const std::string none = message_of_input([] { standard_pair(10, 10); });
  INFO(none);
  CHECK(names(none, {"0.815934", "0.553548", 1}));
}

TEST_CASE("undercut: the section of ISO 6336-3 lies on the root, its tangent at 30 degrees") {
  const GearPair pair = standard_pair(10, 40);
  const ToothGeometry& tooth = pair.gear(0);
  const IsoRoot root = iso_6336_root(pair, 0);
  const RootPoints points = root_points(tooth, 400);
  CHECK(points.angle[0] < 0);  // above the neck
  int at = 0;
  while (points.angle[at] < kPi / 6) ++at;
  const double share = (kPi / 6 - points.angle[at - 1]) / (points.angle[at] - points.angle[at - 1]);
  const Vec2 p =
      tooth.root_point(points.parameter[at - 1] + share * (points.parameter[at] - points.parameter[at - 1]));
  CHECK(2 * std::abs(p.x()) == relative(root.thickness, 1e-4));
}

TEST_CASE(
    "undercut: statics go on through the limit, and loads pass smoothly over the edge where a flank begins") {
  BodyDiscretisation coarse;
  coarse.element_size = 1e-3;
  const Material steel{207e9, 0.3, 7800, true};
  const auto solved = [&](const GearDesign& a, const GearDesign& b, double distance, int positions) {
    StaticParameters s;
    s.mesh.centre_distance = distance;
    s.contact.positions = positions;
    return static_transmission(reduce(make_sector_mesh(a, coarse), steel, 1),
                               reduce(make_sector_mesh(b, coarse), steel, 1), s, 40);
  };
  const double limit = shift_without_undercut(cut(12, 0));
  const auto near = [&](double off) {
    const GearDesign a = cut(12, limit + off), b = cut(30, 0);
    return solved(a, b, 21.3 * kModule, 8);
  };
  const StaticResult below = near(-1e-7), above = near(1e-7);
  for (Eigen::Index i = 0; i < 8; ++i)
    CHECK(below.transmission_error[i] == relative(above.transmission_error[i], 1e-4));
  const StaticResult s = solved(cut(10, 0), cut(40, 0), 25 * kModule, 64);
  double largest = 0;
  for (Eigen::Index i = 0; i < 64; ++i)
    largest = std::max(largest, std::abs(s.transmission_error[(i + 1) % 64] - s.transmission_error[i]));
  CHECK(largest < 0.2 * s.transmission_error.maxCoeff());
  CHECK(s.transmission_error.minCoeff() > 0);
}

TEST_CASE("few teeth, undercut or not, with crowning: edges touch only flanks that stand before them") {
  for (const GearPair& pair : {standard_pair(17, 22), standard_pair(20, 22), standard_pair(17, 61)})
    for (double phase = -3.5; phase < 3.5; phase += 7e-3) {
      const PairContact contact = pair.contact(phase);
      if (!contact.on_flank) continue;
      CAPTURE(phase);
      CHECK(contact.x_max > contact.x_min);
      CHECK(contact.normal_angle < 0.5 * kPi);
      CHECK(std::isfinite(contact.gap));
    }
  BodyDiscretisation coarse;
  coarse.element_size = 1e-3;
  const Material steel{207e9, 0.3, 7800, true};
  const ReducedBody sun = reduce(make_sector_mesh(cut(17, 0), coarse), steel, 1),
                    planet = reduce(make_sector_mesh(cut(22, 0), coarse), steel, 1);
  StaticParameters s;
  s.mesh.centre_distance = 0.5 * kModule * (17 + 22);
  s.contact.positions = 16;
  const double plain = static_transmission(sun, planet, s, 40).transmission_error.mean();
  s.mesh.modification[0].crowning = 5e-6;
  const double crowned = static_transmission(sun, planet, s, 40).transmission_error.mean();
  CHECK(crowned > plain);
  CHECK(crowned < plain + 5e-6);
}
