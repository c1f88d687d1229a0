// The plane state of the contact, apart from that of the bodies: Hertz's numbers, and what it changes in the approach.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "contact/hertz_line.h"
#include "paper_pair.h"
#include "relative.h"
#include "system/loaded_pair.h"

using namespace whine;

namespace {

constexpr double kPi = std::numbers::pi, kNu = 0.3;

// A coarse mesh of the paper's gear and its body in plane stress or strain, once each.
struct Coarse {
  SectorGrid mesh;
  ReducedBody body;
};
const Coarse& coarse(bool plane_stress, double matching_depth = 0) {
  static std::map<std::pair<bool, double>, Coarse> made;
  const auto key = std::make_pair(plane_stress, matching_depth);
  if (!made.count(key)) {
    BodyDiscretisation discretisation;
    discretisation.element_size = 0.8e-3;
    if (matching_depth > 0) {
      discretisation.near_field = NearField::matching;
      discretisation.matching_depth = matching_depth;
    }
    Material material = paper_steel();
    material.plane_stress = plane_stress;
    const SectorGrid mesh = make_sector_mesh(paper_gear(), discretisation);
    made[key] = {mesh, reduce(mesh, material, 0)};
  }
  return made[key];
}

StaticParameters statics_with(ContactPlane contact_plane, ContactModel contact = ContactModel::strips) {
  StaticParameters settings = paper_statics(8);
  settings.mesh.contact_plane = contact_plane;
  settings.fidelity.contact = contact;
  return settings;
}

StaticResult solved(const ReducedBody& body, ContactPlane contact_plane,
                    ContactModel contact = ContactModel::strips) {
  return static_transmission(body, body, statics_with(contact_plane, contact), 150);
}

}  // namespace

TEST_CASE(
    "contact plane: strain in bodies of plane stress gives Hertz's pressure and width of plane strain") {
  const ReducedBody& body = coarse(true).body;
  const StaticResult own = solved(body, ContactPlane::body), strain = solved(body, ContactPlane::strain);
  // One pair at the pitch point carries the same load; Hertz: p ~ sqrt(E*), a ~ 1 / sqrt(E*), E* = E / 2 (1 - nu^2).
  CHECK(strain.tooth_load(0, 1) == relative(own.tooth_load(0, 1), 1e-9));
  const double ratio = std::sqrt(1 - kNu * kNu);
  CHECK(strain.contact_pressure(0, 1) / own.contact_pressure(0, 1) == relative(1 / ratio, 1e-3));
  CHECK(strain.contact_half_width(0, 1) / own.contact_half_width(0, 1) == relative(ratio, 1e-3));
  const double modulus = 207e9 / (2 * (1 - kNu * kNu)), radius = 75e-3 * std::sin(20 * kPi / 180) / 2,
               pressure = std::sqrt(strain.tooth_load(0, 1) * modulus / (25.4e-3 * kPi * radius));
  CHECK(strain.contact_pressure(0, 1) ==
        relative(pressure, 0.025));  // 8 strips; see common/contact/README.md
  // Stiffer than with a contact in plane stress, softer than all in plane strain.
  CHECK(strain.mean_stiffness > 1.001 * own.mean_stiffness);
  CHECK(strain.mean_stiffness < solved(coarse(false).body, ContactPlane::body).mean_stiffness);
}

TEST_CASE("contact plane: the approach changes by Hertz's law of both states relative to the depth between") {
  const double force = 150 / ToothGeometry(paper_gear()).base_radius(),
               radius = 75e-3 * std::sin(20 * kPi / 180) / 2;
  for (const double matching : {0.0, 1.25e-3}) {
    CAPTURE(matching);
    const ReducedBody& body = coarse(true, matching).body;
    const double depth = matching > 0 ? matching : kPi / 4 * 3e-3;  // half a tooth's thickness
    CHECK(ElasticGear(body, ContactPlane::strain).contact_depth() == relative(depth, 1e-15));
    const auto approach = [&](ContactPlane plane) {
      const HalfPlaneSurface surface(in_contact_plane(body.material, plane), 25.4e-3);
      return HertzLine(surface, surface, radius, depth).at(force).indentation;
    };
    const double expected = approach(ContactPlane::strain) - approach(ContactPlane::body);
    CHECK(expected < -0.02e-6);
    for (const auto contact : {ContactModel::strips, ContactModel::line}) {
      CAPTURE(contact);
      const double found = solved(body, ContactPlane::strain, contact).transmission_error[0] -
                           solved(body, ContactPlane::body, contact).transmission_error[0];
      CHECK(found == relative(expected, contact == ContactModel::line ? 1e-9 : 0.01));
    }
  }
}

TEST_CASE(
    "contact plane: the state of the bodies, named, changes no bit, nor does the depth of near and far field") {
  const ReducedBody &stress = coarse(true).body, &strain = coarse(false).body;
  CHECK(solved(stress, ContactPlane::stress).transmission_error ==
        solved(stress, ContactPlane::body).transmission_error);
  CHECK(solved(strain, ContactPlane::strain).transmission_error ==
        solved(strain, ContactPlane::body).transmission_error);
  CHECK(solved(strain, ContactPlane::stress).contact_pressure(0, 1) <
        0.96 * solved(strain, ContactPlane::body).contact_pressure(0, 1));
  const ElasticGear gear(stress, ContactPlane::strain);
  const auto flank = [&](double depth) {
    return gear.compliance(0, depth)(10, 12) + gear.half_plane().line(1e-4, depth);
  };
  for (const double depth : {0.1e-3, 0.5e-3, 5e-3}) CHECK(flank(depth) == relative(flank(1e-3), 1e-12));
  CHECK(gear.compliance(1, 0.1e-3) == gear.compliance(1, 1e-3));
}

TEST_CASE("contact plane: the whole field of loaded gears gives the separations of the strips") {
  const Coarse& gear = coarse(true);
  const StaticResult statics = solved(gear.body, ContactPlane::strain);
  const LoadedResult at = loaded_pair(gear.mesh, gear.mesh, gear.body, gear.body, statics, 0.25, 0);
  Eigen::Index i = 0;
  for (const ContactZone& zone : contact_zones(gear.body, gear.body, statics, 0.25, 0)) {
    if (!(zone.force.sum() > 0)) continue;
    for (int k = 0; k < zone.strips.size(); ++k, ++i) {
      const double gap = zone.strips.gap[k] + at.strip_deflection.row(i).sum() - zone.approach;
      CHECK(std::abs(gap - at.strip_separation[i]) < 0.003 * at.transmission_error);
    }
  }
  CHECK(i == at.strip_force.size());
}
