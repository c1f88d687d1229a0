#include "report/figure_registry.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <type_traits>

#include "base/error.h"
#include "io/artifact_kinds.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "io/scene_words.h"
#include "report/compare_figures.h"
#include "report/figure_list.h"
#include "report/response_figures.h"
#include "report/system_picture.h"
#include "signal/response.h"

namespace whine {
namespace {

using Paths = std::vector<std::string>;
using Drawings = std::map<std::string, Drawing>;

// Results at rest are those of a pair; of responses some figures take a train's, too.
template <class A>
A read_input(const std::string& path) {
  if constexpr (std::is_same_v<A, StaticResult>)
    return read_pair_statics(path);
  else if constexpr (std::is_same_v<A, SweepResult>)
    return read_pair_sweep(path);
  else
    return read<A>(path);
}

// Of branches and ring-downs those of a pair, too.
template <class A>
A read_of_pair(const std::string& path) {
  if constexpr (std::is_same_v<A, ImpactResult>)
    return read_pair_impact(path);
  else if constexpr (std::is_same_v<A, BranchResult>)
    return read_pair_branch(path);
  else
    return read_input<A>(path);
}

template <class A>
std::vector<A> read_all(const Paths& inputs, A (*read)(const std::string&) = read_input<A>) {
  std::vector<A> artifacts;
  for (const std::string& path : inputs) artifacts.push_back(read(path));
  return artifacts;
}

// A figure of one artifact, and of any number of one kind.
template <class A>
Drawing of_one(const char* shows, const char* inputs, Figure (*figure)(const A&)) {
  return {shows, inputs, [figure](const DrawnFrom& from) { return figure(read_input<A>(from.inputs[0])); },
          1};
}
template <class A>
Drawing of_all(const char* shows, const char* inputs, Figure (*figure)(const std::vector<A>&)) {
  return {shows, inputs, [figure](const DrawnFrom& from) { return figure(read_all<A>(from.inputs)); }};
}

// Inputs by their kinds: a list of each, then the paths of all others.
template <class... A>
std::tuple<std::vector<A>..., Paths> by_kind(const Paths& inputs) {
  std::tuple<std::vector<A>..., Paths> out;
  for (const std::string& path : inputs) {
    const std::string schema = read_origin(path).schema;
    const auto take = [&]<class B>(std::vector<B>& list) {
      using Stored = std::conditional_t<std::is_same_v<B, StaticResult>, SystemStaticResult, B>;
      if (schema != kind_of<Stored>().schema()) return false;
      list.push_back(read_of_pair<B>(path));
      return true;
    };
    if (!(take(std::get<std::vector<A>>(out)) || ...)) std::get<Paths>(out).push_back(path);
  }
  return out;
}

// Sweeps of one kind among the inputs, with what other inputs and their scenes tell of them.
template <class Sweep>
struct Captioned {
  std::vector<Sweep> sweeps;
  CaptionSources background;

  void add(const std::string& path, Sweep sweep, const LumpedParameters& lumped) {
    sweeps.push_back(std::move(sweep));
    background.scenes.push_back(scene_words(path));
    background.lumped.push_back(lumped);
  }
};

// Of a lumped model a sweep.h5 says its mass and damper, too.
Captioned<ResponseResult> read_responses(const Paths& inputs) {
  Captioned<ResponseResult> captions;
  Paths others;
  std::tie(captions.background.impacts, captions.background.branches, captions.background.errors, others) =
      by_kind<ImpactResult, BranchResult, SweepErrorsResult>(inputs);
  for (const std::string& path : others)
    if (read_origin(path).schema == kind_of<SweepResult>().schema()) {
      const SweepResult sweep = read_pair_sweep(path);
      captions.add(path, response(sweep), sweep.lumped);
    } else {
      captions.add(path, read_pair_response(path), {});
    }
  return captions;
}

Captioned<SweepResult> read_sweeps(const Paths& inputs) {
  Captioned<SweepResult> captions;
  Paths others;
  std::tie(captions.background.impacts, others) = by_kind<ImpactResult>(inputs);
  for (const std::string& path : others) {
    const SweepResult sweep = read_pair_sweep(path);
    captions.add(path, sweep, sweep.lumped);
  }
  return captions;
}

// Where the first input is one; else none.
std::vector<SweepResult> sweeps_of_train(const Paths& inputs) {
  std::vector<SweepResult> out;
  for (const std::string& path : inputs) {
    if (out.empty() && read_origin(path).schema != kind_of<SweepResult>().schema()) break;
    out.push_back(read<SweepResult>(path));
    if (!out[0].of_train()) return {};
  }
  return out;
}

// Of a pair among its teeth, one curve per torque; of a train among its planets.
Figure draw_load_sharing(const DrawnFrom& from) {
  if (const auto first = read<SystemStaticResult>(from.inputs.front()); first.of_train()) {
    if (from.inputs.size() > 1)
      fail(Failure::usage, "load-sharing of a train needs one static.h5; ", from.inputs.size(), " given");
    return system_load_sharing_figure(first);
  }
  return load_sharing_figure(read_all<StaticResult>(from.inputs));
}

Figure draw_root_stress(const DrawnFrom& from) {
  const auto [statics, branches, sweeps] = by_kind<StaticResult, BranchResult>(from.inputs);
  if (statics.size() != 1)
    fail(Failure::usage, "root-stress needs one static.h5; ", statics.size(), " given");
  return root_stress_figure(statics[0], read_all(sweeps, read_pair_response), branches);
}

Drawings drawings_at_rest() {
  return {
      {"fig01",
       {"finite element mesh", "mesh.h5 of driver and driven gear, static.h5",
        [](const DrawnFrom& from) {
          return mesh_figure(read<SectorGrid>(from.inputs[0]), read<SectorGrid>(from.inputs[1]),
                             read_pair_statics(from.inputs[2]));
        },
        3}},
      {"fig03",
       {"contact zone: candidate pairs, inner and outer region, pressure", "what fig01 takes",
        [](const DrawnFrom& from) {
          return contact_zone_figure(read<SectorGrid>(from.inputs[0]), read<SectorGrid>(from.inputs[1]),
                                     read_pair_statics(from.inputs[2]));
        },
        3}},
      {"fig12", of_all("static transmission error and its spectrum", "static.h5, one per torque",
                       transmission_error_figure)},
      {"fig13", of_all("mesh stiffness and its spectrum", "what fig12 takes", mesh_stiffness_figure)},
      {"load-sharing",
       {"the share of the load that a tooth pair carries on its way through the mesh; of a train how its planets share it",
        "what fig12 takes, or static.h5 of a train", draw_load_sharing}},
      {"profile", of_one("profile charts of the driving flanks, as an inspection sheet shows them",
                         "static.h5", profile_figure)},
      {"error-budget",
       of_one("what refining each discretisation alone changes, and what other choices change",
              "error_budget.h5", error_budget_figure)},
      {"motion-errors",
       of_all("errors of the motions over speed: what refining each discretisation alone changes",
              "sweep_errors.h5 of the sweeps up and down, of one torque", sweep_errors_figure)},
      {"crack",
       of_one(
           "the mark of a cracked tooth in the static transmission error, its orders, and the root stress of the teeth about it",
           "static.h5 of a pair with a crack", crack_figure)},
      {"efficiency",
       {"losses and efficiency over speed, moments of friction over a mesh period",
        "static.h5, then response.h5 of the sweeps up and down, of each torque, of a scene with [friction]",
        [](const DrawnFrom& from) {
          const auto [statics, sweeps] = by_kind<StaticResult>(from.inputs);
          return efficiency_figure(statics, read_all(sweeps, read_pair_response));
        }}},
      {"root-stress",
       {"root stress over the mesh cycle and over speed, dynamic factors beside K_v",
        "static.h5, response.h5 of the sweeps up and down, all of one torque; branch.h5, for orbits that no sweep finds",
        draw_root_stress}},
      {"flank-pressure",
       {"flank pressure over roll angle and speed, loads over tip edges",
        "static.h5, response.h5 of the sweeps up and down, all of one torque",
        [](const DrawnFrom& from) {
          return flank_pressure_figure(
              read_pair_statics(from.inputs[0]),
              {read_pair_response(from.inputs[1]), read_pair_response(from.inputs[2])});
        },
        3}},
      {"sidebands",
       {"teeth that differ: transmission error over the hunting period, shaft orders and sidebands",
        "static.h5 and response.h5 of one torque",
        [](const DrawnFrom& from) {
          return sidebands_figure(read_pair_statics(from.inputs[0]), read_pair_response(from.inputs[1]));
        },
        2}},
  };
}

Drawings drawings_of_designs() {
  return {
      {"compare-rest",
       {"designs at rest: transmission error, mesh stiffness, harmonics",
        "static.h5 of each scene, at one torque",
        [](const DrawnFrom& from) {
          std::vector<RestCurve> curves;
          for (const std::string& path : from.inputs)
            for (RestCurve& own : rest_curves(design_name(path), read<SystemStaticResult>(path)))
              curves.push_back(std::move(own));
          return compared_rest_figure(curves);
        }}},
      {"compare-motion",
       {"designs in motion: RMS, first order and tooth load against speed",
        "response.h5 of sweeps up and down of each scene, at one torque",
        [](const DrawnFrom& from) {
          std::vector<OfDesign<ResponseResult>> designs;
          for (const std::string& path : from.inputs)
            designs.push_back({design_name(path), read<ResponseResult>(path)});
          return compared_motion_figure(designs);
        }}},
  };
}

Drawings drawings_of_motions() {
  return {
      {"ring-down",
       of_one(
           "damping ratios and natural frequencies by ring-down, of the mesh of a pair or the modes of a train",
           "impact.h5", impact_figure)},
      {"branch",
       {"the branch of periodic motions, stable and unstable, over the sweeps",
        "branch.h5, and response.h5 of the same pair or train if you like",
        [](const DrawnFrom& from) {
          return branch_figure(read<BranchResult>(from.inputs[0]),
                               read_all<ResponseResult>({from.inputs.begin() + 1, from.inputs.end()}));
        }}},
      {"runup",
       {"a run-up: spectrogram of the mesh force, orders of the transmission error, tooth loads",
        "runup.h5; response.h5 of sweeps at the same torque, to compare",
        [](const DrawnFrom& from) {
          const auto [runs, sweeps] = by_kind<RunupResult>(from.inputs);
          if (runs.size() != 1) fail(Failure::usage, "runup needs one runup.h5; ", runs.size(), " given");
          return runup_figure(runs[0], read_all<ResponseResult>(sweeps));
        }}},
      {"order-cuts",
       of_all("order cuts: the first orders of the dynamic transmission error against speed, both ways",
              "response.h5 of sweeps up and down of one pair and torque, or of one system", order_figure)},
      {"fig05",
       {"RMS of the dynamic transmission error against mesh frequency",
        "response.h5 of sweeps up and down, any torques, or their sweep.h5 (lumped models: with mass and damping ratio); a panel for each set of choices; impact.h5 of the same torques, for damping ratios; branch.h5, for orbits, stable or not, and folds",
        [](const DrawnFrom& from) {
          const auto captions = read_responses(from.inputs);
          return response_figure(captions.sweeps, captions.background);
        }}},
      {"fig08",
       {"dynamic transmission error over time and its spectrum, both branches at one speed; of a train also forces",
        "sweep.h5 of sweeps up and down of one torque, any choices; impact.h5 of that torque, for damping ratios; sweep.h5 of one train",
        [](const DrawnFrom& from) {
          if (const std::vector<SweepResult> train = sweeps_of_train(from.inputs); !train.empty())
            return train_history_figure(train, from.mesh_frequencies[0]);
          const auto captions = read_sweeps(from.inputs);
          return vibration_figure(captions.sweeps, from.mesh_frequencies[0], captions.background);
        },
        0, 1}},
      {"fig10",
       {"tooth loads over the mesh phase, both branches at one speed", "what fig08 takes",
        [](const DrawnFrom& from) {
          const auto captions = read_sweeps(from.inputs);
          return tooth_load_figure(captions.sweeps, from.mesh_frequencies[0], captions.background);
        },
        0, 1}},
      {"fig15",
       {"net mesh force of lumped models at one or two speeds", "sweep.h5 of lumped models at one torque",
        [](const DrawnFrom& from) {
          return mesh_force_figure(read_all<SweepResult>(from.inputs), from.mesh_frequencies);
        },
        0, 2}},
      {"fig16",
       {"RMS and mean of the dynamic transmission error", "what fig05 takes",
        [](const DrawnFrom& from) {
          const auto captions = read_responses(from.inputs);
          return response_figure(captions.sweeps, captions.background, true);
        }}},
      {"waterfall", of_all("spectra of the dynamic transmission error against mesh frequency",
                           "sweep.h5 of a sweep, or of those up and down of one torque", waterfall_figure)},
      {"tooth-loads",
       {"tooth loads against mesh frequency, and over the mesh period at the speed with the largest RMS",
        "sweep.h5 of sweeps up and down of one torque; impact.h5 of that torque, for damping ratios",
        [](const DrawnFrom& from) {
          const auto captions = read_sweeps(from.inputs);
          return dynamic_load_figure(captions.sweeps, captions.background);
        }}},
  };
}

Drawings drawings_of_forces() {
  return {
      {"bearing-forces",
       {"forces on elastic bearings against mesh frequency",
        "response.h5 of sweeps up and down of one torque; impact.h5 of that torque, for damping ratios",
        [](const DrawnFrom& from) {
          const auto captions = read_responses(from.inputs);
          return bearing_force_figure(captions.sweeps, captions.background);
        }}},
      {"face-load",
       {"face load factor and line load of a pair in slices against mesh frequency",
        "response.h5 of sweeps up and down of one torque",
        [](const DrawnFrom& from) {
          const auto captions = read_responses(from.inputs);
          return face_load_figure(captions.sweeps, captions.background);
        }}},
  };
}

Drawings drawings_of_maps() {
  return {
      {"flank-load", of_one("line load over face and path of contact, as a contact pattern", "static.h5",
                            flank_load_figure)},
      {"harris-map",
       of_one("peak-to-peak transmission error against torque and tip relief, and the Harris cusp",
              "harris_map.h5", harris_map_figure)},
      {"jump-map",
       {"two branches, contact loss and tooth loads against torque, damping and corner rule",
        "jump_map.h5, one per torque and corner rule; fold_curves.h5 over damping, for the cusps",
        [](const DrawnFrom& from) {
          const auto [curves, maps] = by_kind<FoldCurvesResult>(from.inputs);
          return jump_map_figure(read_all<JumpMapResult>(maps), curves, from.printed);
        }}},
      {"multipliers",
       of_one("Floquet multipliers of a branch in the complex plane, and their largest modulus", "branch.h5",
              multiplier_figure)},
      {"fold-curves",
       {"mesh frequencies of folds against damping, torque, tip relief or bearing stiffness, with their cusps",
        "fold_curves.h5 of one quantity, one per torque; jump_map.h5 beside them, for the jumps of sweeps",
        [](const DrawnFrom& from) {
          const auto [curves, maps] = by_kind<FoldCurvesResult>(from.inputs);
          return fold_curve_figure(curves, read_all<JumpMapResult>(maps));
        }}},
      {"jump-map-lumped",
       {"the same of lumped models, and in how much they agree with the elastic pair",
        "jump_map.h5 of lumped models and of the elastic pair, one per torque and model or corner rule",
        [](const DrawnFrom& from) {
          return lumped_jump_map_figure(read_all<JumpMapResult>(from.inputs), from.printed);
        }}},
      {"sensitivity",
       {"what each variant of a scene changes", "jump_map.h5 of the scene, then of each variant",
        [](const DrawnFrom& from) {
          const auto maps = read_all<JumpMapResult>(from.inputs);
          return sensitivity_figure(maps.front(), {maps.begin() + 1, maps.end()});
        }}},
      {"study", of_one("response quantities of the variants of a study against the keys that vary",
                       "study.h5", study_figure)},
  };
}

Drawings drawings_of_systems() {
  return {
      {"modes",
       of_one("natural frequencies of a system by type, and its mode shapes", "modes.h5", modes_figure)},
      {"campbell",
       of_one("natural frequencies of a system and the harmonics of the mesh frequency that excite them",
              "modes.h5", campbell_figure)},
      {"system-static", of_one("a system at rest: transmission errors, forces of meshes, forces on bearings",
                               "static.h5 of a system", system_static_figure)},
      {"system",
       {"a system as it stands: gears at their places, teeth in mesh, senses of rotation",
        "static.h5, of rigid gears modes.h5",
        [](const DrawnFrom& from) {
          const auto [modes, statics] = by_kind<ModesResult>(from.inputs);
          return modes.empty() ? system_picture(read<SystemStaticResult>(statics[0]))
                               : system_picture(modes[0]);
        },
        1}},
      {"system-sweep",
       of_all(
           "a system over its speeds: vibration and contact loss of meshes, forces on bearings, root stress, efficiency",
           "response.h5 of one system, rising, falling or both", system_sweep_figure)},
      {"residual-signal",
       {"teeth that differ or are cracked, in motion: transmission error and residual signal over the hunting period, sidebands, kurtosis over speed",
        "sweep.h5 and response.h5 of one sweep",
        [](const DrawnFrom& from) {
          return residual_figure(read<SweepResult>(from.inputs[0]), read<ResponseResult>(from.inputs[1]));
        },
        2}},
  };
}

// Scenes that all of a figure shows: not those that stand at their panels, nor variants of the first.
Paths scenes_of(const std::string& name, const Paths& inputs, const Figure& figure) {
  Paths scenes;
  if (name.starts_with("compare-")) return scenes;  // its curves bear the names of theirs
  for (const std::string& path : inputs) {
    const std::string words = scene_words(path);
    bool at_panel = words.empty() || (name == "sensitivity" && !scenes.empty());
    for (const std::string& note : figure.notes) at_panel = at_panel || note.find(words) != std::string::npos;
    if (!at_panel && std::find(scenes.begin(), scenes.end(), words) == scenes.end()) scenes.push_back(words);
  }
  return scenes;
}

}  // namespace

const std::map<std::string, Drawing>& drawings() {
  static const std::map<std::string, Drawing> all = [] {
    Drawings drawings = drawings_at_rest();
    drawings.merge(drawings_of_motions());
    drawings.merge(drawings_of_forces());
    drawings.merge(drawings_of_designs());
    drawings.merge(drawings_of_maps());
    drawings.merge(drawings_of_systems());
    return drawings;
  }();
  return all;
}

std::string figure_names() {
  std::string names;
  for (const auto& [name, drawing] : drawings()) names += name + ", ";
  return names;
}

Figure figure_of(const std::string& name, const Paths& inputs, const std::vector<double>& mesh_frequencies,
                 const std::string& others, const PrintedJumps& printed) {
  const auto found = drawings().find(name);
  if (found == drawings().end())
    fail(Failure::usage, "unknown figure '", name, "'; known are ", figure_names() + others);
  const Drawing& drawing = found->second;
  if (drawing.count != 0 && inputs.size() != drawing.count)
    fail(Failure::usage, name, " needs ", drawing.count, " inputs, ", drawing.inputs, "; ", inputs.size(),
         " given");
  if (drawing.frequencies == 0 && !mesh_frequencies.empty())
    fail(Failure::usage, name, " takes no --mesh-frequency: it is not of single speeds");
  if (drawing.frequencies > 0 && (mesh_frequencies.empty() || mesh_frequencies.size() > drawing.frequencies))
    fail(Failure::usage, name, " needs --mesh-frequency, in Hz, ",
         drawing.frequencies == 1 ? "one" : "one or two; two as in 2200,2150", "; ", mesh_frequencies.size(),
         " given");
  for (double f : mesh_frequencies)
    if (!(f > 0) || !std::isfinite(f))
      fail(Failure::usage, name, ": --mesh-frequency ", f, "; it is in Hz, above 0");
  Figure figure = drawing.draw({inputs, mesh_frequencies, printed});
  figure.scenes = scenes_of(name, inputs, figure);
  return figure;
}

}  // namespace whine
