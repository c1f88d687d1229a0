// Speed sweeps of a pair in slices over the face, by the steps of trains (dynamics/system_dynamics.h).
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "results/reduced_body.h"
#include "results/static.h"
#include "results/sweep.h"

namespace whine {

// The pair as a train of one mesh, its bodies those of the transverse sections. Arguments as sweep(). Throws Error(input) for what
// slices in motion do not take.
SystemSweepParameters train_of_slices(const ReducedBody& driver, const ReducedBody& driven,
                                      const StaticResult& statics, double mean_stiffness,
                                      const SweepParameters& settings);

// Of these pairs: natural frequency as in sweep.h5 of pairs, and dampers of the axes.
struct SliceAxes {
  double natural_frequency = 0;                    // Hz
  std::array<double, kSides> bearing_damper = {};  // N m s
};
SliceAxes axes_of_slices(const SystemSweepParameters& train, const std::vector<ReducedBody>& bodies);

// As sweep(), which calls it where settings.fidelity.width is not `one`; without root stress, losses and flank pressure.
SweepResult face_sweep(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                       double mean_stiffness, const SweepParameters& settings, Direction direction,
                       const std::function<void(long, long, const std::string&)>& report, double jump_width);

}  // namespace whine
