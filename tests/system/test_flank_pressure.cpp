// Pressures that a result may state: over a ridge of the flank and at a tip edge there is no largest one.
#include <doctest/doctest.h>

#include <cmath>

#include "gear/flank_kink.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "studies/error_budget.h"
#include "system/flank_pressure.h"
#include "system/loaded_pair.h"

using namespace whine;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

const ReducedBody& body() {
  return paper_body(40e-3, 0.8e-3);
}

// 10 micrometres of tip relief on both gears; from 20.9 deg on, at the pitch point, one pair carries all.
StaticParameters relieved(ReliefShape shape, int strips) {
  StaticParameters settings = paper_statics(64);
  settings.contact.strips = strips;
  for (FlankModification& m : settings.mesh.modification) {
    m.tip.amount = 10e-6;
    m.tip.start_roll = 20.9 * kDegree;
    m.tip.shape = shape;
  }
  return settings;
}

StaticResult solved(const StaticParameters& settings) {
  return static_transmission(body(), body(), settings, 150);
}

}  // namespace

TEST_CASE(
    "pressure: over the start of a linear relief it grows with every doubling of strips and is no result") {
  const FlankPressure at8 = flank_pressure(solved(relieved(ReliefShape::linear, 8))),
                      at32 = flank_pressure(solved(relieved(ReliefShape::linear, 32)));
  REQUIRE(at8.on_ridge > 0);
  CHECK(at8.on_ridge > at8.smooth);
  CHECK(at8.ridge == "the linear tip relief of [gear.pinion]");
  // A wedge: (E* delta / 2 pi) ln 2 for each doubling, delta what the slope of the flank jumps by.
  const FlankRidge ridge =
      flank_ridges(ToothGeometry(paper_gear()), relieved(ReliefShape::linear, 8).mesh.modification[0]).at(0);
  const double modulus = 207e9 / 2, grows = modulus * ridge.bend / (2 * std::numbers::pi) * std::numbers::ln2;
  CHECK(at8.per_doubling == relative(grows, 1e-12));
  CHECK((at32.on_ridge - at8.on_ridge) / 2 == relative(grows, 0.35));
  CHECK(at32.smooth == relative(at8.smooth, 0.03));
  const auto remarks_of = pressure_remarks(solved(relieved(ReliefShape::linear, 8)));
  REQUIRE(remarks_of.size() == 1);
  CHECK(remarks_of[0].warning);
  CHECK(contains(remarks_of[0].words, "no largest value"));

  const FlankPressure round8 = flank_pressure(solved(relieved(ReliefShape::parabolic, 8))),
                      round32 = flank_pressure(solved(relieved(ReliefShape::parabolic, 32)));
  CHECK(round8.on_ridge == 0);
  CHECK(round32.smooth == relative(round8.smooth, 0.04));
  CHECK(pressure_remarks(solved(relieved(ReliefShape::parabolic, 8))).empty());
}

TEST_CASE("pressure: ridges of a flank are convex kinks, with the slope that they bend by") {
  const ToothGeometry gear(paper_gear());
  FlankModification m;
  m.root = {5e-6, 0.3, 0, 0, ReliefShape::linear};
  m.crowning = 3e-6;
  m.slope = 4e-6;
  const auto ridges = flank_ridges(gear, m);
  REQUIRE(ridges.size() == 1);
  CHECK(ridges[0].roll == 0.3);
  CHECK(ridges[0].bend ==
        relative(5e-6 / (0.3 - gear.form_roll_angle()) / (gear.base_radius() * 0.3), 1e-12));
  const FlankDeviation flank(gear, m);
  const double h = 1e-9, per_arc = gear.base_radius() * 0.3;
  CHECK((flank.value_and_slope(0.3 + h, 0)[1] - flank.value_and_slope(0.3 - h, 0)[1]) / per_arc ==
        relative(ridges[0].bend, 1e-6));
  // Points that end with a slope: a ridge where material falls off outwards, none where it rises.
  m = {};
  m.points = {{0.3, 0}, {0.35, 2e-6}, {0.4, 4e-6}};
  REQUIRE(flank_ridges(gear, m).size() == 1);
  CHECK(flank_ridges(gear, m)[0].roll == 0.3);
  m.points = {{0.3, 4e-6}, {0.35, 2e-6}, {0.4, 0}};
  REQUIRE(flank_ridges(gear, m).size() == 1);
  CHECK(flank_ridges(gear, m)[0].roll == 0.4);
}

TEST_CASE("pressure: of loaded gears the tip edge's strips are told apart from contact inside the flanks") {
  BodyDiscretisation discretisation;
  discretisation.element_size = 0.8e-3;
  const SectorGrid mesh = make_sector_mesh(paper_gear(), discretisation);
  const StaticResult statics = static_transmission(body(), body(), paper_statics(16), 300);
  bool seen = false;
  for (const double phase : {0.0, 0.0625, 0.125, 0.25}) {
    CAPTURE(phase);
    const LoadedResult at = loaded_pair(mesh, mesh, body(), body(), statics, phase, 0);
    const LoadedPressure pressure = largest_pressure(at);
    const auto row = static_cast<Eigen::Index>(phase * 16);
    // Windows of strips stand elsewhere when contact is solved again: 0.2 %.
    CHECK(pressure.inside == relative(statics.contact_pressure.row(row).maxCoeff(), 0.005));
    // The statics state no pressure of a pair that touches at an edge.
    bool edge = false;
    for (Eigen::Index j = 0; j < statics.pair.size(); ++j)
      edge |= statics.tooth_load(row, j) > 0 && !(statics.contact_pressure(row, j) > 0);
    CHECK((pressure.at_edge > 0) == edge);
    if (edge)
      CHECK(pressure.edge_force ==
            relative(statics.tooth_load(row, pressure.edge_pair - statics.pair[0]), 0.01));
    seen |= edge;
  }
  CHECK(seen);
}
