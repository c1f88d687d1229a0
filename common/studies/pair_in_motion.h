// A pair ready for motion: on strips, or with its contact in slices over the face as a train of one mesh, on lines.
#pragma once
#include <memory>
#include <vector>

#include "dynamics/motion.h"
#include "results/motion_source.h"
#include "results/reduced_body.h"
#include "results/static.h"

namespace whine {

struct PairInMotion {
  // Speeds from settings.frequency_from to frequency_to (Hz). statics: of the same torque and contact; it gives mesh, contact
  // discretisation and torque, and stays where it is. mean_stiffness: N m-1, sets the bearing dampers. Throws Error(input) for parameters that
  // do not fit, and for what slices in motion do not take.
  PairInMotion(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
               double mean_stiffness, const SweepParameters& settings);
  MotionSource source;
  std::unique_ptr<Motion> motion;
  // Those of the motions of a pair that say them: SweepResult, RunupResult.
  template <class Result>
  void describe(Result& out) const {
    static_cast<MotionSource&>(out) = source;
    out.mean_stiffness = mean_stiffness;
    out.natural_frequency = motion->natural_frequency();
    for (size_t g = 0; g < kSides; ++g) out.bearing_damper[g] = motion->axis_damper(static_cast<int>(g));
  }
  double mean_stiffness = 0;
};

// The pair as a train of one mesh, its bodies those of the transverse sections.
SystemSweepParameters train_of_slices(const ReducedBody& driver, const ReducedBody& driven,
                                      const StaticResult& statics, double mean_stiffness,
                                      const SweepParameters& settings);

}  // namespace whine
