// Sweeps of whole scenes, from the drawing to the RMS of the transmission error, at chosen settings and at far finer ones.
//
// Of a scene its gears, torque, damping and levels are taken; of its speeds a few from end to end, rising.
#pragma once
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "gear/accuracy.h"
#include "gear/body_inertia.h"
#include "gear/system_layout.h"
#include "io/scene.h"
#include "signal/response.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "studies/next_level.h"
#include "studies/sweep.h"
#include "system/statics.h"

namespace whine {

inline constexpr int kJudgedSpeedsOfScene = 48;

struct SceneRun {
  ResponseResult response;
  double seconds = 0;  // of CPU: meshes, reductions, statics, sweep
};

inline double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

template <class Read>
auto through_file(const std::string& words, const Read& read) {
  const std::string path = std::filesystem::temp_directory_path() / "whine-accuracy-run.toml";
  std::ofstream(path) << words;
  return read(path);
}

// Bodies of these stage parameters, alike ones once.
inline std::vector<ReducedBody> bodies_of(const std::vector<std::string>& texts) {
  std::vector<ReducedBody> out;
  out.reserve(texts.size());
  for (size_t i = 0; i < texts.size(); ++i) {
    const auto same = static_cast<size_t>(std::find(texts.begin(), texts.end(), texts[i]) - texts.begin());
    if (same < i) {
      out.push_back(out[same]);
      continue;
    }
    const BodyParameters p = through_file(texts[i], read_body_parameters);
    out.push_back(reduce(make_sector_mesh(p.design, p.discretisation), p.material, p.discretisation.modes));
  }
  return out;
}

inline void no_report(long /*done*/, long /*total*/, const std::string& /*note*/) {}

inline SceneRun run_train(const Scene& scene) {
  const double start = cpu_seconds();
  std::vector<std::string> texts;
  for (const auto& [gear, words] : body_parameters_of(scene)) texts.push_back(words);
  const SystemSweepParameters settings = sweep_parameters_of(scene, layout_of(scene));
  return {response(system_sweep(settings, bodies_of(texts), Direction::up, no_report)),
          cpu_seconds() - start};
}

inline SceneRun run_scene(const Scene& scene) {
  if (!scene.pair()) return run_train(scene);
  const double start = cpu_seconds();
  const std::vector<ReducedBody> body =
      bodies_of({body_parameters(scene, scene.mesh().gear[0]), body_parameters(scene, scene.mesh().gear[1])});
  const StaticResult rest =
      static_transmission(body[0], body[1], through_file(static_parameters(scene), read_static_parameters),
                          scene.operation.torques.front());
  SweepParameters settings = through_file(sweep_parameters(scene), read_sweep_parameters);
  as_drawn(settings, {body[0].inertia, body[1].inertia});
  const SweepResult swept =
      sweep(body[0], body[1], rest, rest.mean_stiffness, settings, Direction::up, no_report);
  return {response(swept), cpu_seconds() - start};
}

inline Scene at_few_speeds(Scene scene) {
  Operation& speeds = scene.operation;
  speeds.frequency_step = (speeds.frequency_to - speeds.frequency_from) / (kJudgedSpeedsOfScene - 1);
  return scene;
}

inline bool no_key(const std::string& /*key*/) {
  return false;
}

// All settings left open, then chosen as by a scene that says nothing of accuracy.
inline Scene unasked(Scene scene) {
  const Scene none;
  scene.body = none.body;
  scene.contact = none.contact;
  scene.time = none.time;
  choose_by_default(scene, no_key);
  return scene;
}

// The same for an accepted error.
inline Scene accepting(const Scene& of, double error) {
  const Scene none;
  Scene scene = of;
  scene.body = none.body;
  scene.contact = none.contact;
  scene.time = none.time;
  scene.time.accepted_error = error;
  choose_discretisation(scene, no_key);
  return scene;
}

// Settings of which the laws of gear/accuracy.h say a quarter of an accepted error, 0.2 % at most, periodicity a thousandth of its own.
inline Scene reference_of(const Scene& of, double least_accepted) {
  constexpr double kFarFiner = 0.25, kFine = 0.002, kPeriodicity = 1e-3;
  Scene scene = accepting(of, std::min(kFine, kFarFiner * least_accepted));
  scene.time.periodicity *= kPeriodicity;
  return scene;
}

// 1: largest relative difference of the RMS at the speeds where both are on one branch; where.
struct RmsDifference {
  double most = 0, mesh_frequency = 0;  // 1, Hz
  int compared = 0;                     // speeds
};
inline RmsDifference difference(const ResponseResult& a, const ResponseResult& b) {
  const std::vector<SpeedCompared> speeds = compared_speeds(a, b);
  RmsDifference out;
  for (Eigen::Index i = 0; i < a.dte_rms.rows(); ++i) {
    if (speeds[static_cast<size_t>(i)] != SpeedCompared::yes) continue;
    ++out.compared;
    const double off = std::abs(a.dte_rms.row(i).norm() / b.dte_rms.row(i).norm() - 1);
    if (off > out.most) out = {off, a.mesh_frequency[i], out.compared};
  }
  return out;
}

}  // namespace whine
