#include "report/figure_registry.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "io/artifact_kinds.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "io/scene_words.h"
#include "report/branch_figure.h"
#include "report/campbell_figure.h"
#include "report/compare_figures.h"
#include "report/efficiency_figure.h"
#include "report/error_budget_figure.h"
#include "report/flank_load_figure.h"
#include "report/flank_pressure_figure.h"
#include "report/fold_curve_figure.h"
#include "report/gear_figures.h"
#include "report/harris_figure.h"
#include "report/impact_figure.h"
#include "report/jump_map_figures.h"
#include "report/modes_figure.h"
#include "report/motion_figures.h"
#include "report/multiplier_figure.h"
#include "report/order_figure.h"
#include "report/residual_figure.h"
#include "report/response_figures.h"
#include "report/root_stress_figure.h"
#include "report/runup_figure.h"
#include "report/sensitivity_figure.h"
#include "report/static_figures.h"
#include "report/study_figure.h"
#include "report/sweep_errors_figure.h"
#include "report/system_figures.h"
#include "report/system_picture.h"
#include "report/system_sweep_figure.h"
#include "signal/response.h"

namespace whine {
namespace {

using Paths = std::vector<std::string>;
using Frequencies = std::vector<double>;
using Drawings = std::map<std::string, Drawing>;

template <class Artifact>
std::vector<Artifact> read_all(const Paths& inputs, Artifact (*read)(const std::string&)) {
  std::vector<Artifact> artifacts;
  for (const std::string& path : inputs) artifacts.push_back(read(path));
  return artifacts;
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

bool is_a(const char* schema, const std::string& path) {
  return read_origin(path).schema == schema;
}

// Of a lumped model a sweep.h5 says its mass and damper, too.
Captioned<ResponseResult> read_responses(const Paths& inputs) {
  Captioned<ResponseResult> captions;
  CaptionSources& background = captions.background;
  for (const std::string& path : inputs) {
    if (is_a("whine/impact", path)) {
      background.impacts.push_back(read_pair_impact(path));
    } else if (is_a("whine/branch", path)) {
      background.branches.push_back(read_pair_branch(path));
    } else if (is_a("whine/sweep", path)) {
      const SweepResult sweep = read_pair_sweep(path);
      captions.add(path, response(sweep), sweep.lumped);
    } else {
      captions.add(path, read_pair_response(path), {});
    }
  }
  return captions;
}

Captioned<SweepResult> read_sweeps(const Paths& inputs) {
  Captioned<SweepResult> captions;
  for (const std::string& path : inputs) {
    if (is_a("whine/impact", path)) {
      captions.background.impacts.push_back(read_pair_impact(path));
    } else {
      const SweepResult sweep = read_pair_sweep(path);
      captions.add(path, sweep, sweep.lumped);
    }
  }
  return captions;
}

Figure draw_responses(const Paths& inputs, const Frequencies&) {
  const auto captions = read_responses(inputs);
  return response_figure(captions.sweeps, captions.background);
}

Figure draw_means(const Paths& inputs, const Frequencies&) {
  const auto captions = read_responses(inputs);
  return response_figure(captions.sweeps, captions.background, true);
}

Figure draw_root_stress(const Paths& inputs, const Frequencies&) {
  std::vector<StaticResult> statics;
  std::vector<ResponseResult> sweeps;
  std::vector<BranchResult> branches;
  for (const std::string& path : inputs)
    if (is_a("whine/static", path))
      statics.push_back(read_pair_statics(path));
    else if (is_a("whine/branch", path))
      branches.push_back(read_pair_branch(path));
    else
      sweeps.push_back(read_pair_response(path));
  if (statics.size() != 1)
    fail(Failure::usage, "root-stress needs one static.h5; ", statics.size(), " given");
  return root_stress_figure(statics[0], sweeps, branches);
}

Figure draw_efficiency(const Paths& inputs, const Frequencies&) {
  std::vector<StaticResult> statics;
  std::vector<ResponseResult> sweeps;
  for (const std::string& path : inputs)
    if (is_a("whine/static", path))
      statics.push_back(read_pair_statics(path));
    else
      sweeps.push_back(read_pair_response(path));
  return efficiency_figure(statics, sweeps);
}

Drawings drawings_at_rest() {
  return {
      {"fig01",
       {"finite element mesh", "mesh.h5 of driver and driven gear, static.h5", 3, 0,
        [](const Paths& in, const Frequencies&) {
          return mesh_figure(read<SectorGrid>(in[0]), read<SectorGrid>(in[1]), read_pair_statics(in[2]));
        }}},
      {"fig03",
       {"contact zone: candidate pairs, inner and outer region, pressure", "what fig01 takes", 3, 0,
        [](const Paths& in, const Frequencies&) {
          return contact_zone_figure(read<SectorGrid>(in[0]), read<SectorGrid>(in[1]),
                                     read_pair_statics(in[2]));
        }}},
      {"fig12",
       {"static transmission error and its spectrum", "static.h5, one per torque", 0, 0,
        [](const Paths& in, const Frequencies&) {
          return transmission_error_figure(read_all(in, read_pair_statics));
        }}},
      {"fig13",
       {"mesh stiffness and its spectrum", "what fig12 takes", 0, 0,
        [](const Paths& in, const Frequencies&) {
          return mesh_stiffness_figure(read_all(in, read_pair_statics));
        }}},
      {"load-sharing",
       {"the share of the load that a tooth pair carries on its way through the mesh", "what fig12 takes", 0,
        0,
        [](const Paths& in, const Frequencies&) {
          return load_sharing_figure(read_all(in, read_pair_statics));
        }}},
      {"profile",
       {"profile charts of the driving flanks, as an inspection sheet shows them", "static.h5", 1, 0,
        [](const Paths& in, const Frequencies&) { return profile_figure(read_pair_statics(in[0])); }}},
      {"error-budget",
       {"what refining each discretisation alone changes, and what other choices change", "error_budget.h5",
        1, 0,
        [](const Paths& in, const Frequencies&) {
          return error_budget_figure(read<ErrorBudgetResult>(in[0]));
        }}},
      {"motion-errors",
       {"errors of the motions over speed: what refining each discretisation alone changes",
        "sweep_errors.h5 of the sweeps up and down, of one torque", 0, 0,
        [](const Paths& in, const Frequencies&) {
          return sweep_errors_figure(read_all(in, read<SweepErrorsResult>));
        }}},
      {"crack",
       {"the mark of a cracked tooth in the static transmission error, its orders, and the root stress of the teeth about it",
        "static.h5 of a pair with a crack", 1, 0,
        [](const Paths& in, const Frequencies&) { return crack_figure(read_pair_statics(in[0])); }}},
      {"efficiency",
       {"losses and efficiency over speed, moments of friction over a mesh period",
        "static.h5, then response.h5 of the sweeps up and down, of each torque, of a scene with [friction]",
        0, 0, draw_efficiency}},
      {"root-stress",
       {"root stress over the mesh cycle and over speed, dynamic factors beside K_v",
        "static.h5, response.h5 of the sweeps up and down, all of one torque; branch.h5, for orbits that no sweep finds",
        0, 0, draw_root_stress}},
      {"flank-pressure",
       {"flank pressure over roll angle and speed, loads over tip edges",
        "static.h5, response.h5 of the sweeps up and down, all of one torque", 3, 0,
        [](const Paths& in, const Frequencies&) {
          return flank_pressure_figure(read_pair_statics(in[0]),
                                       {read_pair_response(in[1]), read_pair_response(in[2])});
        }}},
      {"sidebands",
       {"teeth that differ: transmission error over the hunting period, shaft orders and sidebands",
        "static.h5 and response.h5 of one torque", 2, 0,
        [](const Paths& in, const Frequencies&) {
          return sidebands_figure(read_pair_statics(in[0]), read_pair_response(in[1]));
        }}},
  };
}

template <class Artifact>
std::vector<OfDesign<Artifact>> read_designs(const Paths& inputs, Artifact (*read)(const std::string&)) {
  std::vector<OfDesign<Artifact>> designs;
  for (const std::string& path : inputs) designs.push_back({design_name(path), read(path)});
  return designs;
}

Drawings drawings_of_designs() {
  return {
      {"compare-rest",
       {"designs at rest: transmission error, mesh stiffness, harmonics",
        "static.h5 of each scene, at one torque", 0, 0,
        [](const Paths& in, const Frequencies&) {
          std::vector<RestCurve> curves;
          for (const std::string& path : in)
            for (RestCurve& own : rest_curves(design_name(path), read<SystemStaticResult>(path)))
              curves.push_back(std::move(own));
          return compared_rest_figure(curves);
        }}},
      {"compare-motion",
       {"designs in motion: RMS, first order and tooth load against speed",
        "response.h5 of sweeps up and down of each scene, at one torque", 0, 0,
        [](const Paths& in, const Frequencies&) {
          return compared_motion_figure(read_designs(in, read<ResponseResult>));
        }}},
  };
}

Figure draw_runup(const Paths& inputs, const Frequencies&) {
  std::vector<RunupResult> runs;
  std::vector<ResponseResult> sweeps;
  for (const std::string& path : inputs) {
    if (is_a("whine/runup", path))
      runs.push_back(read<RunupResult>(path));
    else
      sweeps.push_back(read<ResponseResult>(path));
  }
  if (runs.size() != 1) fail(Failure::usage, "runup needs one runup.h5; ", runs.size(), " given");
  return runup_figure(runs[0], sweeps);
}

Drawings drawings_of_motions() {
  return {
      {"ring-down",
       {"damping ratios and natural frequencies by ring-down, of the mesh of a pair or the modes of a train",
        "impact.h5", 1, 0,
        [](const Paths& in, const Frequencies&) { return impact_figure(read<ImpactResult>(in[0])); }}},
      {"branch",
       {"the branch of periodic motions, stable and unstable, over the sweeps",
        "branch.h5, and response.h5 of the same pair or train if you like", 0, 0,
        [](const Paths& in, const Frequencies&) {
          const Paths sweeps(in.begin() + 1, in.end());
          return branch_figure(read<BranchResult>(in[0]), read_all(sweeps, read<ResponseResult>));
        }}},
      {"runup",
       {"a run-up: spectrogram of the mesh force, orders of the transmission error, tooth loads",
        "runup.h5; response.h5 of sweeps at the same torque, to compare", 0, 0, draw_runup}},
      {"order-cuts",
       {"order cuts: the first orders of the dynamic transmission error against speed, both ways",
        "response.h5 of sweeps up and down of one pair and torque, or of one system", 0, 0,
        [](const Paths& in, const Frequencies&) {
          return order_figure(read_all(in, read<ResponseResult>));
        }}},
      {"fig05",
       {"RMS of the dynamic transmission error against mesh frequency",
        "response.h5 of sweeps up and down, any torques, or their sweep.h5 (lumped models: with mass and damping ratio); a panel for each set of choices; impact.h5 of the same torques, for damping ratios; branch.h5, for orbits, stable or not, and folds",
        0, 0, draw_responses}},
      {"fig08",
       {"dynamic transmission error over time and its spectrum, both branches at one speed",
        "sweep.h5 of sweeps up and down of one torque, any choices; impact.h5 of that torque, for damping ratios",
        0, 1,
        [](const Paths& in, const Frequencies& f) {
          const auto captions = read_sweeps(in);
          return vibration_figure(captions.sweeps, f[0], captions.background);
        }}},
      {"fig10",
       {"tooth loads over the mesh phase, both branches at one speed", "what fig08 takes", 0, 1,
        [](const Paths& in, const Frequencies& f) {
          const auto captions = read_sweeps(in);
          return tooth_load_figure(captions.sweeps, f[0], captions.background);
        }}},
      {"fig15",
       {"net mesh force of lumped models at one or two speeds", "sweep.h5 of lumped models at one torque", 0,
        2,
        [](const Paths& in, const Frequencies& f) {
          return mesh_force_figure(read_all(in, read_pair_sweep), f);
        }}},
      {"fig16", {"RMS and mean of the dynamic transmission error", "what fig05 takes", 0, 0, draw_means}},
      {"waterfall",
       {"spectra of the dynamic transmission error against mesh frequency, and its first orders",
        "sweep.h5 of a sweep, or of those up and down of one torque", 0, 0,
        [](const Paths& in, const Frequencies&) { return waterfall_figure(read_all(in, read_pair_sweep)); }}},
      {"tooth-loads",
       {"tooth loads against mesh frequency, and over the mesh period at the speed with the largest RMS",
        "sweep.h5 of sweeps up and down of one torque; impact.h5 of that torque, for damping ratios", 0, 0,
        [](const Paths& in, const Frequencies&) {
          const auto captions = read_sweeps(in);
          return dynamic_load_figure(captions.sweeps, captions.background);
        }}},
      {"bearing-forces",
       {"forces on elastic bearings against mesh frequency",
        "response.h5 of sweeps up and down of one torque; impact.h5 of that torque, for damping ratios", 0, 0,
        [](const Paths& in, const Frequencies&) {
          const auto captions = read_responses(in);
          return bearing_force_figure(captions.sweeps, captions.background);
        }}},
      {"face-load",
       {"face load factor and line load of a pair in slices against mesh frequency",
        "response.h5 of sweeps up and down of one torque", 0, 0,
        [](const Paths& in, const Frequencies&) {
          const auto captions = read_responses(in);
          return face_load_figure(captions.sweeps, captions.background);
        }}},
  };
}

std::pair<std::vector<FoldCurvesResult>, std::vector<JumpMapResult>> folds_and_maps(const Paths& in) {
  std::pair<std::vector<FoldCurvesResult>, std::vector<JumpMapResult>> maps;
  for (const std::string& path : in)
    if (is_a("whine/fold_curves", path))
      maps.first.push_back(read<FoldCurvesResult>(path));
    else
      maps.second.push_back(read<JumpMapResult>(path));
  return maps;
}

Drawings drawings_of_maps() {
  return {
      {"flank-load",
       {"line load over face and path of contact, as a contact pattern", "static.h5", 1, 0,
        [](const Paths& in, const Frequencies&) { return flank_load_figure(read_pair_statics(in[0])); }}},
      {"harris-map",
       {"peak-to-peak transmission error against torque and tip relief, and the Harris cusp", "harris_map.h5",
        1, 0,
        [](const Paths& in, const Frequencies&) { return harris_map_figure(read<HarrisMapResult>(in[0])); }}},
      {"jump-map",
       {"two branches, contact loss and tooth loads against torque, damping and corner rule",
        "jump_map.h5, one per torque and corner rule; fold_curves.h5 over damping, for the cusps", 0, 0,
        nullptr,
        [](const Paths& in, const PrintedJumps& printed) {
          const auto [curves, maps] = folds_and_maps(in);
          return jump_map_figure(maps, curves, printed);
        }}},
      {"multipliers",
       {"Floquet multipliers of a branch in the complex plane, and their largest modulus", "branch.h5", 1, 0,
        [](const Paths& in, const Frequencies&) { return multiplier_figure(read<BranchResult>(in[0])); }}},
      {"fold-curves",
       {"mesh frequencies of folds against damping, torque or tip relief, with their cusps",
        "fold_curves.h5 of one quantity, one per torque; jump_map.h5 beside them, for the jumps of sweeps", 0,
        0,
        [](const Paths& in, const Frequencies&) {
          const auto [curves, maps] = folds_and_maps(in);
          return fold_curve_figure(curves, maps);
        }}},
      {"jump-map-lumped",
       {"the same of lumped models, and in how much they agree with the elastic pair",
        "jump_map.h5 of lumped models and of the elastic pair, one per torque and model or corner rule", 0, 0,
        nullptr,
        [](const Paths& in, const PrintedJumps& printed) {
          return lumped_jump_map_figure(read_all(in, read<JumpMapResult>), printed);
        }}},
      {"sensitivity",
       {"what each variant of a scene changes", "jump_map.h5 of the scene, then of each variant", 0, 0,
        [](const Paths& in, const Frequencies&) {
          std::vector<JumpMapResult> maps = read_all(in, read<JumpMapResult>);
          const JumpMapResult base = maps.front();
          maps.erase(maps.begin());
          return sensitivity_figure(base, maps);
        }}},
      {"study",
       {"response quantities of the variants of a study against the keys that vary", "study.h5", 1, 0,
        [](const Paths& in, const Frequencies&) { return study_figure(read<StudyResult>(in[0])); }}},
  };
}

Drawings drawings_of_systems() {
  return {
      {"modes",
       {"natural frequencies of a system by type, and its mode shapes", "modes.h5", 1, 0,
        [](const Paths& in, const Frequencies&) { return modes_figure(read<ModesResult>(in[0])); }}},
      {"campbell",
       {"natural frequencies of a system and the harmonics of the mesh frequency that excite them",
        "modes.h5", 1, 0,
        [](const Paths& in, const Frequencies&) { return campbell_figure(read<ModesResult>(in[0])); }}},
      {"system-static",
       {"a system at rest: transmission errors, forces of meshes, forces on bearings",
        "static.h5 of a system", 1, 0,
        [](const Paths& in, const Frequencies&) {
          return system_static_figure(read<SystemStaticResult>(in[0]));
        }}},
      {"system-load-sharing",
       {"how the planets of a system share the load over the mesh period, and the loads of its tooth pairs",
        "static.h5 of a system", 1, 0,
        [](const Paths& in, const Frequencies&) {
          return system_load_sharing_figure(read<SystemStaticResult>(in[0]));
        }}},
      {"system",
       {"a system as it stands: gears at their places, teeth in mesh, senses of rotation",
        "static.h5, of rigid gears modes.h5", 1, 0,
        [](const Paths& in, const Frequencies&) {
          return is_a("whine/modes", in[0]) ? system_picture(read<ModesResult>(in[0]))
                                            : system_picture(read<SystemStaticResult>(in[0]));
        }}},
      {"residual-signal",
       {"teeth that differ or are cracked, in motion: transmission error and residual signal over the hunting period, sidebands, kurtosis over speed",
        "sweep.h5 and response.h5 of one sweep", 2, 0,
        [](const Paths& in, const Frequencies&) {
          return residual_figure(read<SweepResult>(in[0]), read<ResponseResult>(in[1]));
        }}},
      {"system-sweep",
       {"a system over its speeds: vibration and contact loss of meshes, forces on bearings, root stress, efficiency",
        "response.h5 of one system, rising, falling or both", 0, 0,
        [](const Paths& in, const Frequencies&) {
          return system_sweep_figure(read_all(in, read<ResponseResult>));
        }}},
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

Figure figure_of(const std::string& name, const Paths& inputs, const Frequencies& mesh_frequencies,
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
  Figure figure =
      drawing.draw ? drawing.draw(inputs, mesh_frequencies) : drawing.draw_beside(inputs, printed);
  figure.scenes = scenes_of(name, inputs, figure);
  return figure;
}

}  // namespace whine
