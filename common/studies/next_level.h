// What the next model level of contact or body would change in a speed sweep.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "results/reduced_body.h"
#include "results/response.h"
#include "results/static.h"
#include "results/sweep.h"

namespace whine {

// A sweep one model level up in one key of [fidelity], as sweep() takes it.
struct NextSweep {
  std::string key, from, to;  // key "contact" or "body"; its model levels
  std::array<ReducedBody, kSides> body;
  StaticResult statics;
  double mean_stiffness = 0;  // N m-1
  SweepParameters settings;
  std::string missing;  // why this model level cannot be had here; the rest is then not filled
};

// The next model levels of a sweep with these inputs, contact before body. Another contact has statics of its own, at the
// torques of `statics` and `reference`; body = "full" has bodies of its own, of the same meshes: they are reduced again. What
// has no next model level is left out. Throws Error(input), with the reasons, if nothing is left or all of it is missing;
// other errors as static_transmission.
std::vector<NextSweep> next_sweeps(const ReducedBody& driver, const ReducedBody& driven,
                                   const StaticResult& statics, const StaticResult& reference,
                                   const SweepParameters& settings);

// Largest and RMS over the speeds, relative to the next model level.
struct LevelChange {
  double largest = 0, rms = 0;
  double at = 0;  // Hz: speed of the largest
};
struct SweepChange {
  int compared = 0;  // speeds
  int apart = 0;     // speeds at which one sweep has left a branch that the other is on
  int uneven = 0;    // speeds at which a sweep is not periodic, or the two have orbits of other lengths
  LevelChange dte_rms, dte_mean, tooth_load;
};

// Whether two motions at a speed can be compared: not where one sweep has left a branch that the other is on, nor where one is not
// periodic or they have orbits of other lengths.
enum class SpeedCompared { yes, apart, uneven };
// (speed) Both of the same speeds in the same order; throws Error(input) otherwise. After a jump of either sweep speeds count as
// apart for as long as the RMS of the two over the meshes differ as across a jump.
std::vector<SpeedCompared> compared_speeds(const ResponseResult& a, const ResponseResult& b);

// Of mesh 0 at the speeds that compared_speeds() lets compare.
SweepChange sweep_change(const SweepResult& here, const SweepResult& next);

}  // namespace whine
