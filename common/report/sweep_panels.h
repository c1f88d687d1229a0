// Sweeps that belong together in a figure, and what is said of them: torques, damping, model and other choices.
#pragma once
#include "report/figures.h"
#include "results/branch.h"
#include "results/impact.h"
#include "results/response.h"
#include "results/sweep.h"
#include "results/sweep_errors.h"

namespace whine {

// What figures of sweeps say about them that is in other artifacts.
struct CaptionSources {
  std::vector<std::string> scenes = {};       // of each sweep, "file: title"; or none
  std::vector<LumpedParameters> lumped = {};  // of each sweep, empty for elastic gears; or none
  std::vector<ImpactResult> impacts =
      {};  // for damping ratios, of any gears and torques; found by what they were made from
  std::vector<BranchResult> branches = {};     // for unstable orbits and folds; found likewise
  std::vector<SweepErrorsResult> errors = {};  // for bars of the RMS; found likewise
};

// Sweeps of the same choices, both directions of each curve. Curves, of other torques or flanks, stand in the order in which they
// come: that of the scene, so that a torque has one colour in all figures.
template <class Sweep>
struct ChoicePanel {
  struct Curve {
    const Sweep *up = nullptr, *down = nullptr;
  };
  std::string choices, scene;
  LumpedParameters lumped;
  std::vector<Curve> curves;
};

// Whether the motion at a row of the sweep goes beyond the backlash, so that back flanks would touch.
bool beyond_backlash(const ResponseResult& r, Eigen::Index row);
// All such speeds of these sweeps, "2400 to 2600, 3100" (Hz times a scale); "" if there are none.
std::string speeds_beyond_backlash(std::initializer_list<const ResponseResult*> sweeps, double scale = 1);

// Functions on Sweep are there for ResponseResult and SweepResult.

// In the order in which the choices come. Throws Error(input) where a direction is missing or given twice.
template <class Sweep>
std::vector<ChoicePanel<Sweep>> panels_of(const std::vector<Sweep>& sweeps, const CaptionSources& background);

// The one curve that figures of one torque and one set of choices are of. what: "order cuts", in the Error(input) for more or none.
template <class Sweep>
const typename ChoicePanel<Sweep>::Curve& only_curve(const std::vector<ChoicePanel<Sweep>>& panels,
                                                     const std::string& what);

// Damping, corner rule and fidelity of elastic gears; stiffness and integrator of a lumped model.
template <class Sweep>
std::string choice_words(const Sweep& s);

// "mass 1.4 kg, damping ratio 8 %, damper always on"
std::string lumped_words(const LumpedParameters& lumped);

// Torques and damping of a panel: "150 N m; damping ratio 5.81 % with one pair, 6.95 % with two pairs in contact, by
// ring-down". Without the impact.h5 of its sweeps the torques alone.
template <class Sweep>
std::string operating_words(const ChoicePanel<Sweep>& panel, const CaptionSources& background);

// What tells the curves of a panel apart: their torques, or their flanks where those differ at one torque.
template <class Sweep>
std::string curve_label(const ChoicePanel<Sweep>& panel, const Sweep& s);

// The branch of a sweep's pair at its torque; none if it is not among them. Its errors, likewise.
const SweepErrorsResult* errors_of(const ResponseResult& r, const CaptionSources& background);
const BranchResult* branch_of(const ResponseResult& r, const CaptionSources& background);

}  // namespace whine
