#include "paper/results.h"

#include <algorithm>
#include <tuple>

#include "base/error.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "results/impact.h"
#include "results/response.h"
#include "results/static.h"
#include "results/sweep.h"

namespace whine {
namespace {

[[noreturn]] void missing(const std::string& scene, const std::string& file, const std::string& place = "") {
  const std::string path = (place.empty() ? "out/" + scene : place) + "/" + file;
  fail(Failure::input, "scorecard: ", file, " of ", scene, " is missing; ",
       place.empty() || place.starts_with("out/") ? "make it with: make " + path : "there is no " + path);
}

template <class Artifact>
const Artifact& look_up(const std::map<std::string, Artifact>& from, const SceneResults& scene,
                        const std::string& file) {
  const auto found = from.find(file);
  if (found == from.end()) missing(scene.name, file);
  scene.asked.insert(file);
  return found->second;
}

std::string motion_folder(int torque, MotionModel model, Direction direction) {
  const std::string lumped = model == MotionModel::finite_elements ? "" : name_of(model) + "/";
  return text("T", torque, "/", lumped, direction, "/");
}

}  // namespace

const StaticResult& SceneResults::at_rest(int torque) const {
  return look_up(statics, *this, text("T", torque, "/static.h5"));
}

const ImpactResult& SceneResults::ring_down(int torque) const {
  return look_up(impacts, *this, text("T", torque, "/impact.h5"));
}

const SweepResult& SceneResults::sweep(int torque, Direction direction, MotionModel model) const {
  return look_up(sweeps, *this, motion_folder(torque, model, direction) + "sweep.h5");
}

Branches SceneResults::branches(int torque, MotionModel model) const {
  return {look_up(responses, *this, motion_folder(torque, model, Direction::up) + "response.h5"),
          look_up(responses, *this, motion_folder(torque, model, Direction::down) + "response.h5")};
}

std::vector<std::string> scorecard_files() {
  std::vector<std::string> files;
  for (int torque : kSweptTorques) {
    files.push_back(text("T", torque, "/static.h5"));
    for (const Direction direction : {Direction::up, Direction::down})
      files.push_back(motion_folder(torque, MotionModel::finite_elements, direction) + "response.h5");
  }
  for (int torque : {100, 150, 200, 300}) files.push_back(text("T", torque, "/impact.h5"));
  for (const Direction direction : {Direction::up, Direction::down}) {
    files.push_back(motion_folder(kFigureTorque, MotionModel::finite_elements, direction) + "sweep.h5");
    for (int torque : {100, 150, 200, 300})
      files.push_back(motion_folder(torque, MotionModel::rectangular, direction) + "response.h5");
    for (int torque : kTorques)
      files.push_back(motion_folder(torque, MotionModel::secant, direction) + "response.h5");
  }
  files.push_back(motion_folder(kFigureTorque, MotionModel::rectangular, Direction::up) + "sweep.h5");
  std::sort(files.begin(), files.end());
  return files;
}

namespace {

// What all artifacts of a scene share.
template <class Artifact>
auto gears_made_of(const Artifact& a) {
  const auto of = [](const GearDesign& g) {
    return std::tuple(g.teeth, g.module, g.pressure_angle, g.profile_shift, g.addendum, g.face_width,
                      g.bore_radius);
  };
  return std::tuple(of(a.gear[0].design), of(a.gear[1].design), a.mesh.centre_distance, a.mesh.corner.enabled,
                    a.mesh.corner.largest_angle, a.mesh.contact_plane, a.gear[0].material.youngs_modulus,
                    a.gear[1].material.youngs_modulus);
}

struct SceneReader {
  SceneResults results;
  std::map<std::string, std::string> paths;  // as given, by path below the scene
  std::string place;                         // the scene's folder

  template <class Artifact>
  void require_operation(const std::string& file, const Artifact& a) const {
    const std::string& path = paths.at(file);
    if (file.rfind(text("T", a.torque, "/"), 0) != 0)
      fail(Failure::input, path, ": is at ", a.torque, " N m, its path says ",
           file.substr(1, file.find('/') - 1), " N m; ", rebuild_advice(path));
  }

  template <class Artifact>
  void require_sweep(const std::string& file, const Artifact& a) const {
    require_operation(file, a);
    const std::string& path = paths.at(file);
    const std::string found = motion_folder(static_cast<int>(a.torque), a.model, a.direction);
    if (file.rfind(found, 0) != 0)
      fail(Failure::input, path, ": is the sweep ", a.direction, " of ", a.model, ", not that of its path; ",
           rebuild_advice(path));
  }

  void read(const std::string& file) {
    const std::string& path = paths.at(file);
    const std::string kind = file.substr(file.rfind('/') + 1);
    if (kind == "static.h5")
      require_operation(file, results.statics[file] = whine::read_pair_statics(path));
    else if (kind == "impact.h5")
      require_operation(file, results.impacts[file] = read_pair_impact(path));
    else if (kind == "sweep.h5")
      require_sweep(file, results.sweeps[file] = whine::read<SweepResult>(path));
    else
      require_sweep(file, results.responses[file] = whine::read<ResponseResult>(path));
  }

  // Error(input) unless all are of one pair of gears, the elastic ones of one damping, too.
  void require_one_scene() const {
    const StaticResult& first = results.at_rest(kTorques[0]);
    const auto same_gears = [&](const auto& artifacts) {
      for (const auto& [file, a] : artifacts)
        if (gears_made_of(a) != gears_made_of(first))
          fail(Failure::input, paths.at(file), ": is of other gears, another material or corner rule than ",
               paths.at(text("T", kTorques[0], "/static.h5")), "; give results of one scene");
    };
    same_gears(results.statics);
    same_gears(results.impacts);
    same_gears(results.sweeps);
    same_gears(results.responses);
    const auto damping_of = [](const auto& a) {
      return std::tuple(a.damping.rayleigh_stiffness, a.damping.rayleigh_mass, a.damping.bearing_ratio,
                        a.damping.undamped_depth);
    };
    const auto same_damping = [&](const auto& artifacts) {
      for (const auto& entry : artifacts) {
        const auto& artifact = entry.second;
        if constexpr (requires { artifact.model; })
          if (!elastic(artifact)) continue;
        if (damping_of(artifact) != damping_of(results.ring_down(kTorques[0])))
          fail(Failure::input, paths.at(entry.first), ": has another damping than ",
               paths.at(text("T", kTorques[0], "/impact.h5")), "; give results of one scene");
      }
    };
    same_damping(results.impacts);
    same_damping(results.sweeps);
    same_damping(results.responses);
  }
};

}  // namespace

std::vector<SceneResults> read_results(const std::vector<std::string>& paths) {
  const std::vector<std::string> files = scorecard_files();
  std::vector<SceneReader> readers;
  for (const std::string& path : paths) {
    const auto file = std::find_if(files.begin(), files.end(),
                                   [&](const std::string& f) { return path.ends_with("/" + f); });
    if (file == files.end())
      fail(Failure::input, path, ": no claim reads it; they read <scene>/", files.front(),
           " and so on, gear-scorecard --files lists them");
    const std::string place = path.substr(0, path.size() - file->size() - 1);
    const std::string scene = place.substr(place.rfind('/') + 1);
    auto reader = std::find_if(readers.begin(), readers.end(),
                               [&](const SceneReader& r) { return r.results.name == scene; });
    if (reader == readers.end()) {
      readers.emplace_back();
      reader = readers.end() - 1;
      reader->results.name = scene;
      reader->place = place;
    }
    const auto [at, first] = reader->paths.emplace(*file, path);
    if (!first)
      fail(Failure::input, path, ": ", *file, " of ", scene, " is given twice, before as ", at->second);
  }
  for (const SceneReader& reader : readers)
    for (const std::string& file : files)
      if (!reader.paths.contains(file)) missing(reader.results.name, file, reader.place);
  std::vector<SceneResults> scenes;
  for (SceneReader& reader : readers) {
    for (const std::string& file : files) reader.read(file);
    reader.require_one_scene();
    scenes.push_back(std::move(reader.results));
  }
  return scenes;
}

}  // namespace whine
