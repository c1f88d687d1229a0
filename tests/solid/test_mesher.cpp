// Every ordinary tooth has a grid, or is rejected where scenes are checked.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "base/error.h"
#include "gear/involute.h"
#include "refusal.h"
#include "solid/elements.h"
#include "solid/mesher.h"
#include "solid/root_stress.h"

using namespace whine;

namespace {
constexpr double kPi = std::numbers::pi;

double least_jacobian_of(const SectorGrid& mesh) {
  return least_jacobian(mesh.node_position, mesh.element_node);
}

// Teeth as drawings have them: 12 to 150 (a third of them below 28), every fourth gear internal, with more than 30.
class Drawings {
 public:
  GearDesign next() {
    GearDesign d;
    d.internal = between(0, 1) < 0.25;
    d.teeth =
        static_cast<int>(d.internal ? between(30, 151) : std::exp(between(std::log(12.0), std::log(151.0))));
    d.pressure_angle = between(14.5, 30) * kPi / 180;
    d.profile_shift = between(-0.5, 1);
    d.dedendum = between(1, 1.4);
    d.module = 1e-3 * std::exp(between(std::log(0.3), std::log(20.0)));
    // The tip of the rack that fits: at large pressure angles less than is usual.
    const double widest = (0.25 * kPi - d.dedendum * std::tan(d.pressure_angle)) *
                          std::cos(d.pressure_angle) / (1 - std::sin(d.pressure_angle));
    d.rack_tip_radius = between(0.2, 1) * std::min(0.38, widest);
    d.face_width = 10 * d.module;
    const double root = d.module * (0.5 * d.teeth + (d.internal ? 1 : -1) * (d.dedendum - d.profile_shift));
    const double body = between(0, 1);
    if (d.internal)
      d.rim_outer_radius = root + d.module * (1 + 3 * body);
    else
      d.bore_radius = std::max(0.15 * root, body * (root - d.module));
    return d;
  }

 private:
  // The same numbers from every standard library.
  double between(double a, double b) { return a + (b - a) * static_cast<double>(random_()) / 4294967296.0; }
  std::mt19937 random_{7};
};

// Grids of the drawings from `first` on, every `step`th of `count`.
void check_grids(int first, int step, int count) {
  constexpr double kLeast = 0.05;
  Drawings drawings;
  double least = 1;
  int made = 0, refused = 0, undercut = 0;
  for (int i = 0; i < count; ++i) {
    const GearDesign d = drawings.next();
    if (i % step != first) continue;
    CAPTURE(i);
    try {
      undercut += ToothGeometry(d).undercut() > 0 ? 1 : 0;
    } catch (const Error& error) {
      INFO(error.what());
      CHECK(error.kind() == Failure::input);
      const std::string said = error.what();
      const bool remedy = names(said, {"lower"}) || names(said, {"raise"});
      CHECK(remedy);
      ++refused;
      continue;
    }
    ++made;
    BodyDiscretisation discretisation;
    for (const int order : {1, 2}) {
      discretisation.element_order = order;
      discretisation.element_size = 0.27 * d.module;
      least = std::min(least, least_jacobian_of(make_sector_mesh(d, discretisation)));
    }
    discretisation.element_size = (i % 3 == 0 ? 0.5 : 0.13) * d.module;
    const double radius = least_root_radius(ToothGeometry(d));
    const double root = radius < 0.25 * d.module ? std::min(0.4 * radius, discretisation.element_size) : 0;
    least = std::min(least, least_jacobian_of(make_sector_mesh(d, discretisation, root)));
  }
  MESSAGE(made, " meshed, ", undercut, " of them undercut, ", refused, " refused, least Jacobian ", least);
  CHECK(least > kLeast);
  CHECK(made > 8 * refused);
  CHECK(undercut > 0);
}
}  // namespace

TEST_CASE("grids: just above and below the limit of undercut, where the involute ends on the base circle") {
  struct Case {
    int teeth;
    double shift, rack_tip;
  };
  BodyDiscretisation discretisation;
  for (const Case& c : {Case{12, 0.30, 0.38},
                        {12, 0.298, 0.38},
                        {17, 0, 0.39},
                        {17, 0, 0.38},
                        {10, 0.42, 0.38},
                        {18, -0.1, 0.38},
                        {18, -0.052, 0.38},
                        {10, 0, 0.38},
                        {8, 0, 0.3},
                        {6, 0, 0.3}}) {
    CAPTURE(c.teeth);
    CAPTURE(c.shift);
    GearDesign d;
    d.teeth = c.teeth;
    d.module = 3e-3;
    d.pressure_angle = 20 * kPi / 180;
    d.profile_shift = c.shift;
    d.rack_tip_radius = c.rack_tip;
    d.face_width = 20e-3;
    d.bore_radius = 4e-3;
    for (const double element : {0.13, 0.27, 0.5}) {
      discretisation.element_size = element * d.module;
      CHECK(least_jacobian_of(make_sector_mesh(d, discretisation)) > 0.3);
    }
  }
}

TEST_CASE("grids: every tenth of 500 random drawings") {
  check_grids(0, 10, 500);
}

TEST_CASE("grids: all of 500 random drawings") {
  check_grids(0, 1, 500);
}
