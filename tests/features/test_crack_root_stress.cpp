// Root stress of a gear with a cracked tooth: convergence of its tables, and the turn in which the tooth comes round.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cracked_gear.h"
#include "paper_pair.h"
#include "relative.h"
#include "solid/crack.h"
#include "solid/flank_table.h"
#include "solid/reduce.h"
#include "system/statics.h"

namespace {

using namespace whine;
using Eigen::Index;

constexpr double kTorque = 150;

// Pa N-1: largest along the root of the cracked tooth (0) or of one beside it, under a force at the middle of its own flank.
double largest(double element, double depth, int tooth) {
  const ReducedBody body = reduce(sector_of(cracked_gear(depth), element), kSteel, 0);
  const Index n = body.flank_position.size(), roots = body.root_angle.size(), place = body.offsets + tooth;
  return (body.root_stress[static_cast<size_t>(body.offsets)].topRows(roots) +
          body.crack_root_stress.block(place * roots, place * n, roots, n))
      .col(n / 2)
      .maxCoeff();
}

}  // namespace

TEST_CASE(
    "root stress of a cracked gear: it converges with the elements, on the cracked tooth and beside it") {
  // Within 3 % of what an intact tooth has, and as near as that tooth itself.
  const double intact = largest(0.8e-3, 2e-3, 3);
  CHECK(std::abs(largest(0.8e-3, 2e-3, 0) - largest(0.4e-3, 2e-3, 0)) < 0.03 * intact);
  CHECK(largest(0.8e-3, 2e-3, 1) == relative(largest(0.4e-3, 2e-3, 1), 1e-2));
}

TEST_CASE(
    "root stress of a cracked gear: over a turn the cracked tooth has less, its neighbours little more, the others the same") {
  constexpr int kPositions = 8, kTeeth = 50;
  const StaticParameters settings = paper_statics(kPositions);
  const StaticResult intact = static_transmission(cracked_body(0), cracked_body(0), settings, kTorque);
  CHECK(intact.root_stress_tooth.size() == 0);
  double beside = 0;
  for (const int gear : {0, 1})
    for (const int tooth : {0, 3}) {
      CAPTURE(gear);
      CAPTURE(tooth);
      const ReducedBody& cracked = cracked_body(2e-3, tooth);
      const StaticResult s = gear == 0 ? static_transmission(cracked, cracked_body(0), settings, kTorque)
                                       : static_transmission(cracked_body(0), cracked, settings, kTorque);
      const auto g = static_cast<size_t>(gear);
      REQUIRE(s.root_stress[g].rows() == kTeeth * kPositions);
      const auto of_tooth = [&](int number) {
        double most = 0;
        for (Index i = 0; i < s.root_stress[g].rows(); ++i)
          for (Index k = 0; k < s.pair.size(); ++k) {
            const int pair = s.pair[k] - static_cast<int>(i) / kPositions, at = gear == 0 ? pair : -pair;
            if (s.tooth_load(i, k) > 0 && ((at - number) % kTeeth + kTeeth) % kTeeth == 0)
              most = std::max(most, s.root_stress[g](i, k));
          }
        return most;
      };
      const double whole = intact.root_stress_max[gear];
      for (int k = 6; k < kTeeth - 6; ++k) CHECK(of_tooth(tooth + k) == whole);
      CHECK(of_tooth(tooth) < 0.4 * whole);
      CHECK(of_tooth(tooth) > 0.02 * whole);
      const double next = std::max(of_tooth(tooth + 1), of_tooth(tooth - 1));
      CHECK(next > whole);
      CHECK(next < 1.02 * whole);
      CHECK(s.root_stress_max[gear] == next);
      const int named = ((s.root_stress_tooth[gear] - tooth) % kTeeth + kTeeth) % kTeeth;
      CHECK((named == 1 || named == kTeeth - 1));
      // Both gears are alike, and so are all places of the crack.
      if (beside > 0) CHECK(next == relative(beside, 1e-6));
      beside = next;
    }
}

TEST_CASE(
    "root stress of a cracked gear: the deeper the slit, the less is left beside it and the more its neighbours bear") {
  const StaticParameters settings = paper_statics(8);
  double last = 0;
  for (const double depth : {1e-3, 2e-3, 3e-3}) {
    const StaticResult s = static_transmission(cracked_body(depth), cracked_body(0), settings, kTorque);
    CHECK(s.root_stress_max[0] > last);
    last = s.root_stress_max[0];
  }
}

TEST_CASE("root stress of a cracked gear: no crack, no table; without its table none is given") {
  CHECK(cracked_body(0).crack_root_stress.size() == 0);
  ReducedBody lacking = cracked_body(2e-3);
  lacking.crack_root_stress.resize(0, 0);
  const StaticResult s = static_transmission(lacking, cracked_body(0), paper_statics(8), kTorque);
  CHECK(s.root_stress_max.size() == 0);
  CHECK(s.root_stress[0].size() == 0);
}
