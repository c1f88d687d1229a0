// A scene whose motion is made anew for each value of one quantity: what fold curves follow.
#pragma once
#include <memory>
#include <vector>

#include "dynamics/motion.h"
#include "results/static.h"
#include "studies/fold_curves.h"

namespace whine {

struct MotionAt {
  StaticResult rest;  // of a pair on strips, whose motion refers to it
  std::unique_ptr<Motion> motion;
};

class FoldScene {
 public:
  virtual ~FoldScene() = default;
  // What a value of a FoldCurvesPlan stands for: s of rayleigh_stiffness for a damping ratio, else the value itself.
  virtual double raw(double value) const = 0;
  virtual double damping_ratio(double raw) const = 0;
  virtual std::unique_ptr<MotionAt> at(double raw) = 0;
  // Behind the branch: candidate contacts of all motions from now on, for folds that move more than it did.
  virtual void hold(const Motion& of_branch) = 0;
};

// Both complete the speeds of the plan; arguments but for it must live as long as the scene. Errors as those of fold_curves().
std::unique_ptr<FoldScene> fold_scene(const ReducedBody& driver, const ReducedBody& driven,
                                      const StaticParameters& statics, double torque,
                                      const SweepParameters& settings, FoldCurvesPlan& plan);
// source: what results say of the scene.
std::unique_ptr<FoldScene> fold_scene(const SystemSweepParameters& settings,
                                      const std::vector<ReducedBody>& bodies, FoldCurvesPlan& plan,
                                      MotionSource& source);

}  // namespace whine
