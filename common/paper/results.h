// Results of scenes, as far as the scorecard asks: their artifacts, found and checked by their paths.
#pragma once
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "results/impact.h"
#include "results/response.h"
#include "results/static.h"
#include "results/sweep.h"

namespace whine {

inline constexpr std::array<int, 3> kTorques{100, 200,
                                             300};  // N m: P2000's Table 1 and Figs 7, 12 to 14 and 16
inline constexpr int kFigureTorque = 150;           // N m: its Figs 5, 8 to 11 and 15
inline constexpr std::array<int, 5> kSweptTorques{100, 150, 200, 300, 600};  // N m: all at which it moves

// Both directions of a sweep at a torque.
struct Branches {
  const ResponseResult& up;
  const ResponseResult& down;
};

// Artifacts by their paths below the scene's folder: "T150/up/response.h5", "T150/rectangular/up/sweep.h5". What is asked
// for and is not there: Error(input) that names it.
struct SceneResults {
  std::string name;
  std::map<std::string, StaticResult> statics;
  std::map<std::string, ImpactResult> impacts;
  std::map<std::string, SweepResult> sweeps;
  std::map<std::string, ResponseResult> responses;

  const StaticResult& at_rest(int torque) const;
  const ImpactResult& ring_down(int torque) const;
  const SweepResult& sweep(int torque, Direction direction,
                           MotionModel model = MotionModel::finite_elements) const;
  Branches branches(int torque, MotionModel model = MotionModel::finite_elements) const;

  mutable std::set<std::string> asked = {};  // paths that these four were asked for
};

// All paths below a scene's folder that the claims read.
std::vector<std::string> scorecard_files();

// paths: <folders>/<scene>/<one of scorecard_files()>, each of them for each scene, in any order. Scenes in order of their
// first path. Throws Error(input), naming the file, for one that is missing, that no claim reads, that is given twice, whose
// torque, direction or model is not that of its path, or that is of other gears or another damping than the rest of its
// scene.
std::vector<SceneResults> read_results(const std::vector<std::string>& paths);

}  // namespace whine
