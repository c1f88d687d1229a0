// Errors of the teeth of internal gears: a ring whose flanks stand ahead or behind, whose toothing is displaced, alone and in a train.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "elastic_train.h"
#include "gear/flank_deviation.h"
#include "gear/tooth_errors.h"
#include "internal_pair.h"
#include "mixed_errors.h"
#include "relative.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "system/rolling_mesh.h"
#include "system/statics.h"
#include "system/system_statics.h"

using namespace whine;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi, kMicro = 1e-6;
constexpr int kPlanet = 35, kRing = 99;

const ReducedBody& coarse(const GearDesign& design) {
  return kept_body(design, {206e9, 0.3, 7850, true}, 3e-3, 3);
}

GearMeshSpec spec_of(const ToothErrors& of_planet, const ToothErrors& of_ring, bool ring_drives = false) {
  GearMeshSpec spec;
  spec.centre_distance = kInternalDistance;
  spec.errors = {of_planet, of_ring};
  if (ring_drives) std::swap(spec.errors[0], spec.errors[1]);
  return spec;
}

GearMeshModel model_of(const ToothErrors& of_planet, const ToothErrors& of_ring, bool ring_drives = false) {
  const ReducedBody &planet = coarse(planet_gear()), &ring = coarse(ring_gear());
  const GearMeshSpec spec = spec_of(of_planet, of_ring, ring_drives);
  return ring_drives ? GearMeshModel(ring, planet, spec) : GearMeshModel(planet, ring, spec);
}

// The same gear seen from behind.
ToothErrors mirrored(const ToothErrors& errors) {
  ToothErrors out = errors;
  const size_t teeth = errors.cumulative_pitch.size();
  for (size_t i = 0; i < teeth; ++i) {
    const size_t from = (teeth - i) % teeth;
    out.cumulative_pitch[i] = -errors.cumulative_pitch[from];
    out.profile_slope[i] = errors.profile_slope[from];
    out.profile_form[i] = errors.profile_form[from];
  }
  out.eccentric_tooth = -errors.eccentric_tooth;
  return out;
}

size_t of(int tooth, int teeth) {
  return static_cast<size_t>(((tooth % teeth) + teeth) % teeth);
}

double cosine() {
  return std::cos(planet_gear().pressure_angle);
}

// Transmission error of exact involutes of which the driven one's axis is displaced by (along, across) the line of action: with the
// distance D of the axes the common tangent has the length |L| = sqrt(D^2 - s^2), s = r1 - r2 of an internal pair; L counts from the
// driver's base circle to the other along the driver's normal, against which a planet's flank has its centre of curvature, a ring's not.
double displaced(const GearPair& gears, double along, double across) {
  const double s = gears.gear(0).base_radius() - gears.gear(1).base_radius();
  const double length = (gears.ring() == 0 ? -s : s) * std::tan(gears.working_pressure_angle());
  const auto tangent = [&](double x, double y) {
    const double own = std::copysign(std::sqrt(x * x + y * y - s * s), length);
    return std::pair{own, std::atan2(y, x) - std::atan2(s, own)};
  };
  const auto [own, beta] = tangent(length + along, s + across);
  return own - length - s * beta;
}

}  // namespace

TEST_CASE("pitch errors of planet and ring without load: the flank that is ahead, closed form") {
  ToothErrors planet, ring;
  for (int i = 0; i < kPlanet; ++i) planet.cumulative_pitch.push_back(((i * 37) % 11 - 5) * kMicro);
  for (int i = 0; i < kRing; ++i) ring.cumulative_pitch.push_back(((i * 23) % 7 - 3) * kMicro);
  const GearMeshModel model = model_of(planet, ring);
  CHECK(hunting_periods(model) == kPlanet * kRing);
  const GearPair& gears = model.kinematics;
  double worst = 0;
  for (int period = 0; period < kPlanet * kRing; period += 13)
    for (double phase : {0.31, 0.4, 0.5, 0.69}) {
      // Both turn counter-clockwise. Leading flanks of the planet that stand ahead come early, trailing ones of the ring late.
      double least = 1;
      for (int pair = -2; pair <= 2; ++pair) {
        const double path = (phase + pair) * gears.base_pitch();
        if (path < gears.path_start() || path > gears.path_end()) continue;
        least = std::min(least, cosine() * (ring.cumulative_pitch[of(pair - period, kRing)] -
                                            planet.cumulative_pitch[of(pair - period, kPlanet)]));
      }
      worst = std::max(worst, std::abs(unloaded_transmission_error(model, phase, period) - least));
    }
  CHECK(worst < 1e-12);
}

TEST_CASE(
    "a ring whose flanks all stand alike ahead has turned; an error of the planet is the opposite one of the ring") {
  const double ahead = 3 * kMicro;
  for (const double phase : {0.0, 0.2, 0.5, 0.8}) {
    CAPTURE(phase);
    const GearMeshModel turned = model_of({}, pitch(kRing, ahead));
    CHECK(std::abs(unloaded_transmission_error(turned, phase, 5) - ahead * cosine()) < 1e-12);
    const GearMeshModel of_ring = model_of({}, pitch(kRing, 0, -ahead)),
                        of_planet = model_of(pitch(kPlanet, 0, ahead), {});
    for (const int period : {-2, -1, 0, 1, 2})  // where tooth 0 of both meet
      CHECK(std::abs(unloaded_transmission_error(of_ring, phase, period) -
                     unloaded_transmission_error(of_planet, phase, period)) < 1e-15);
    const double met = unloaded_transmission_error(of_ring, phase, 0);
    CHECK((std::abs(met + ahead * cosine()) < 1e-12) == (std::abs(met) > 1e-12));
  }
}

TEST_CASE("run-out of a ring without load: exact involutes whose axis is displaced, planet or ring driving") {
  for (const bool ring_drives : {false, true})
    for (const double e : {5e-6, 1e-7}) {
      CAPTURE(ring_drives);
      ToothErrors eccentric;
      eccentric.eccentricity = e;
      eccentric.eccentric_tooth = 7.25;
      const GearMeshModel model = model_of({}, eccentric, ring_drives);
      const GearPair& gears = model.kinematics;
      const int ring = ring_drives ? 0 : 1;
      const Vec2 normal = model.outward(0);  // of the driver's flank
      const Vec2 between(0, gears.driven_centre_offset());
      const double s = gears.gear(0).base_radius() - gears.gear(1).base_radius();
      const Vec2 side = (between - between.dot(normal) * normal) / s;
      CHECK(std::abs(between.dot(normal)) ==
            relative(std::abs(s) * std::tan(gears.working_pressure_angle()), 1e-12));
      CHECK(side.norm() == relative(1, 1e-12));
      double worst = 0;
      for (int i = 0; i < kRing * 4; ++i) {
        const int period = i / 4;
        const double phase = i % 4 / 4.0;
        // Tooth 0 stands on +y of the ring itself.
        const double angle = placed(gears, ring, period + phase).angle + kPi / 2 + 2 * kPi * 7.25 / kRing;
        const Vec2 moved =
            (ring_drives ? -e : e) * Vec2(std::cos(angle), std::sin(angle));  // driven against driver
        worst = std::max(worst, std::abs(unloaded_transmission_error(model, phase, period) -
                                         displaced(gears, moved.dot(normal), moved.dot(side))));
      }
      CHECK(worst < 1e-12);
    }
}

TEST_CASE("every kind of error: the ring drives a planet as that drives it, seen from behind and backwards") {
  const ToothErrors planet = mixed(kPlanet), ring = mixed(kRing);
  GearMeshModel forth = model_of(planet, ring), back = model_of(mirrored(planet), mirrored(ring), true);
  forth.corner.enabled = back.corner.enabled =
      false;  // rotations are those of the driver, by the lever of its edge
  double worst = 0, range = 0;
  for (int period = 0; period < 200; ++period)
    for (const double phase : {0.1, 0.45, 0.7}) {
      const double one = unloaded_transmission_error(forth, phase, period);
      worst = std::max(worst, std::abs(unloaded_transmission_error(back, -phase, -period) - one));
      range = std::max(range, std::abs(one));
    }
  CHECK(worst < 1e-12);
  CHECK(range > 5 * kMicro);
}

TEST_CASE(
    "deviations of a ring: slopes are derivatives; eccentric flanks have the pitch of a displaced circle; a class has its limits") {
  const ToothGeometry gear(ring_gear());
  ToothErrors errors = mixed(kRing);
  errors.eccentricity = 20 * kMicro;
  for (const FlankSide side : {FlankSide::leading, FlankSide::trailing}) {
    const FlankDeviation flank(gear, {}, errors, side);
    constexpr double kStep = 1e-5;
    for (const int tooth : {-57, 0, 3, 98})
      for (double roll = gear.tip_roll_angle() + 0.01; roll < gear.form_roll_angle() - 0.01; roll += 0.013)
        CHECK(std::abs(flank.value_and_slope(roll, tooth)[1] -
                       (flank.at(roll + kStep, tooth) - flank.at(roll - kStep, tooth)) / (2 * kStep)) < 1e-9);
    // Material that stands at the tip closes the gap there.
    ToothErrors slope;
    slope.profile_slope.assign(kRing, 5 * kMicro);
    const FlankDeviation steep(gear, {}, slope, side);
    CHECK(steep.at(gear.tip_roll_angle(), 0) - steep.at(gear.form_roll_angle(), 0) == relative(-5e-6, 1e-9));
    // A displacement by e towards A moves flanks at the angle t by e sin(A - t) along the circle, and by e cos(A - t) outwards, where
    // the teeth of a ring are thicker by tan(alpha) of it on either flank.
    const double e = 1e-6, towards = 2 * kPi * 5.3 / kRing, alpha = ring_gear().pressure_angle,
                 roll = std::tan(alpha), sign = side == FlankSide::leading ? 1 : -1;
    const Vec2 point = gear.flank_point(roll);
    const double half = std::atan2(point.y(), point.x()) - kPi / 2;
    ToothErrors eccentric, list;
    eccentric.eccentricity = e;
    eccentric.eccentric_tooth = 5.3;
    for (int i = 0; i < kRing; ++i) {
      const double at = towards - 2 * kPi * i / kRing - sign * half;
      list.cumulative_pitch.push_back(e * (std::sin(at) - sign * std::tan(alpha) * std::cos(at)));
    }
    const FlankDeviation one(gear, {}, eccentric, side), other(gear, {}, list, side);
    for (int i = 0; i < kRing; ++i) CHECK(std::abs(one.at(roll, i) - other.at(roll, i)) < 1e-10);
  }
  // Drawn: the wave of one revolution is that of one displacement.
  GearDesign many = ring_gear();
  many.teeth = 400;
  many.rim_outer_radius = 1;
  ToothErrors drawn;
  drawn.iso_class = 6;
  CHECK(std::arg(wave_of(tooth_deviations(many, drawn, FlankSide::trailing).cumulative_pitch) /
                 wave_of(tooth_deviations(many, drawn).cumulative_pitch)) ==
        relative(-2 * many.pressure_angle, 0.1));
}

TEST_CASE(
    "a train whose ring stands ahead: all of it has turned; one tooth is felt by the planet that it meets, and torques balance") {
  constexpr std::array<int, 3> kTeeth{26, 37, 100};
  const auto with = [&](const ToothErrors& of_ring) {
    SystemModel exact = train(kTeeth);
    std::vector<ReducedBody> bodies;
    std::vector<GearMeshSpec> specs;
    for (const System::Body& body : exact.layout.bodies)
      if (body.kind == System::BodyKind::gear)
        bodies.push_back(train_body(body.teeth, body.teeth == kTeeth[2]));
    for (size_t m = 0; m < 6; ++m) {
      GearMeshSpec spec;
      spec.centre_distance = exact.layout.meshes[m].centre_distance;
      spec.corner.enabled = false;
      if (m >= 3) spec.errors[1] = of_ring;
      specs.push_back(spec);
    }
    return SystemModel(exact.layout, bodies, specs);
  };
  const auto solve = [](const SystemModel& system, int periods) {
    std::vector<SystemSolution> out;
    SystemStatics statics(system, ContactModel::line, static_zones(system, 8, 1, 1));
    VectorXd start = VectorXd::Zero(6);
    for (int i = 0; i < 4; ++i)
      for (int period = 0; period < periods; ++period) {
        out.push_back(statics.solve(i / 4.0, period, start));
        start = out.back().equilibrium.x;
      }
    return out;
  };
  const std::vector<SystemSolution> plain = solve(with({}), 1);
  const double force = kTrainTorque / ToothGeometry(rigid_gear(kTeeth[0])).base_radius(), ahead = 3 * kMicro;
  const SystemModel turned = with(pitch(kTeeth[2], ahead)), one = with(pitch(kTeeth[2], 0, ahead));
  CHECK(hunting_periods(one) == kTeeth[2]);
  const double alpha = rigid_gear(26).pressure_angle;
  const std::vector<SystemSolution> all = solve(turned, 3);
  for (size_t n = 0; n < all.size(); ++n)
    for (size_t m = 0; m < 6; ++m) {
      const bool closes = turned.layout.meshes[m].side[1].flank == FlankSide::leading;
      const double shift = m < 3 ? 0 : (closes ? -1 : 1) * ahead * std::cos(alpha);
      CHECK(std::abs(all[n].transmission_error[m] - plain[n / 3].transmission_error[m] - shift) < 1e-12);
      CHECK(all[n].driving_force[m] == relative(plain[n / 3].driving_force[m], 1e-6));
    }
  std::array<int, 3> met{};
  std::array<double, 3> more{};
  const auto periods = static_cast<size_t>(kTeeth[2]);
  const std::vector<SystemSolution> each = solve(one, kTeeth[2]);
  for (size_t n = 0; n < each.size(); ++n) {
    const SystemSolution &at = each[n], &exact = plain[n / periods];
    CHECK(at.driving_force[0] + at.driving_force[1] + at.driving_force[2] == relative(force, 1e-9));
    Vec2 sum(0, 0);
    for (size_t b = 0; b < 5; ++b) sum += at.bearing_force[b];
    CHECK(sum.norm() < 1e-9 * force);
    bool meets = false;
    for (const LoadedSegment& load : at.loads) {
      const System::Side& side = one.layout.meshes[static_cast<size_t>(load.mesh)].side[1];
      const int before =
          mesh_instant(one, load.mesh, static_cast<double>(n / periods) / 4, static_cast<int>(n % periods))
              .period;
      if (load.mesh < 3 || !(load.force > 0) || of(side.tooth(load.pair - before), kTeeth[2]) != 0) continue;
      meets = true;
      const auto planet = static_cast<size_t>(load.mesh - 3);
      ++met[planet];
      const double sign = side.flank == FlankSide::leading ? 1 : -1;
      more[planet] =
          std::max(more[planet], sign * (at.driving_force[planet + 3] / exact.driving_force[planet + 3] - 1));
    }
    if (!meets)
      for (size_t m = 0; m < 6; ++m) CHECK(at.driving_force[m] == relative(exact.driving_force[m], 1e-9));
  }
  // In motion: the same forces at rest; the balance of energy closes as the tooth comes round.
  SystemDynamics dynamics(one, motion_of(one, 4e8, 2e-6));
  constexpr int kSteps = 48;
  dynamics.set_positions(std::vector<double>(6, 60e-6), kSteps);
  CHECK(dynamics.hunting_periods() == kTeeth[2]);
  for (int i = 0; i < 4; ++i) {
    const VectorXd p = dynamics.rest_forces(i * kSteps / 4);
    for (int m = 0; m < 6; ++m) {
      double own = 0;
      for (const LoadedSegment& load : each[static_cast<size_t>(i) * periods].loads)
        own += load.mesh == m ? load.force : 0;
      CHECK(p.segment(m * dynamics.tooth_pairs(), dynamics.tooth_pairs()).sum() == relative(own, 1e-9));
    }
  }
  SystemDynamics::State state = dynamics.rest();
  SystemDynamics::Period period;
  EnergyBalance energy;
  dynamics.set_speed(1000, kSteps);
  for (int n = 0; n < kTeeth[2]; ++n) {
    energy = {};
    REQUIRE(dynamics.integrate(state, period, &energy));
    CHECK(energy.imbalance < 1e-12 * energy.throughput);
  }
  for (size_t planet = 0; planet < 3; ++planet) {
    CAPTURE(planet);
    CHECK(met[planet] >= 4);  // for the contact ratio of mesh periods
    CHECK(met[planet] <= 9);
    CHECK(more[planet] > 0.004);  // the sun floats, which shares loads out
  }
}

TEST_CASE(
    "internal pairs: a line of contact lies where flanks that are modified touch, on either gear's slope") {
  for (const bool ring_drives : {false, true})
    for (const size_t modified : {0, 1}) {
      CAPTURE(ring_drives);
      CAPTURE(modified);
      GearMeshSpec spec;
      spec.centre_distance = kInternalDistance;
      spec.modification[modified].slope = 5e-6;
      const ReducedBody &planet = coarse(planet_gear()), &ring = coarse(ring_gear());
      const GearMeshModel model(ring_drives ? ring : planet, ring_drives ? planet : ring, spec);
      const MeshPosition at = make_line_position(model, 0, 1e-6, 1e-3, 300);
      int seen = 0;
      for (size_t j = 0; j < at.pairs.size(); ++j) {
        const PairContact& contact = at.pairs[j].contact;
        if (contact.corner) continue;
        const double x = model.kinematics.nearest(contact, model.common_flanks());
        if (std::abs(x) < 1e-6 || x == contact.x_min || x == contact.x_max) continue;
        ++seen;
        const auto weights = [&](double place) {
          return VectorXd(model.gear[1].table().weights(model.kinematics.gap_at(contact, place).roll[1]));
        };
        const VectorXd found = at.table_weights[1].row(static_cast<Index>(j));
        CHECK((found - weights(x)).norm() < 0.05 * (weights(-x) - weights(x)).norm());
      }
      CHECK(seen > 0);
    }
}
