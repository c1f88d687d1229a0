// A study: a scene, the keys that vary in it, and what is gathered from its variants; read from TOML with checked keys.
//
//   title = "..."                             # stands on the figure; default: the file's name
//   scene = "../scenes/parker2000.toml"       # from the folder of the study
//   stage = "static"                          # the pair at rest; "sweep": and in motion
//   directions = ["up", "down"]               # of the sweeps; default: both
//   plan = "grid"                             # all combinations; "sample": random ones, with samples = 1000, seed = 1
//   quantities = ["rms_max_up"]                  # what the table holds; default: all of the stage
//   outside_model = "stop"                         # a variant outside the model's range is an error; "mark": a marked line of the
// table
//   compare = [0, 3]                          # two variants, by their numbers, that `make compare` shows side by side
//   [set]                                     # values that all variants have instead of the scene's
//   "fidelity.contact" = "line"
//   [[vary]]                                  # one for each key that varies
//   key = "damping.rayleigh_stiffness_s"      # alone in all gears, or by its place, as in variant.h; of trains also
//                                             # drive.sun.torque_Nm, pin.planet2.tangential_um, mesh.sun-planet.corner_contact
//   values = [4.0e-6, 5.5e-6]                 # or from, to with step or count; in a sample also from, to alone (uniform), or
//                                             # mean, deviation (normal), redrawn outside `least` and `most`
//   [figure]                                  # default: the first response quantities against the first keys
//   quantities = ["rms_max_up"]                  # one row of panels each, 4 at most
//   keys = ["damping.rayleigh_stiffness_s"]   # one column of panels each, 4 at most
//   colour = "operation.torque_Nm"
//   map = ["overlap_ratio", "damping.rayleigh_stiffness_s"]  # in place of keys and colour, of a grid of two keys: cells over x and y
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "model/response_quantities.h"
#include "model/stages.h"

namespace whine {

inline constexpr long kMostVariants = 200000;

struct VariedKey {
  std::string name;                // as the study writes it
  bool number = true;              // else a word, a truth value or a list
  bool whole = false;              // a number without a fraction
  std::string units, meaning;      // of scene_keys(): SI, one line
  std::string label, scene_units;  // "pinion, tip relief", "µm"
  double to_si_multiply = 1, to_si_divide = 1;
  std::vector<std::string> values;  // as a scene has them; empty: drawn by the next
  bool normal = false;              // else uniform
  double first = 0, second = 0;     // mean and deviation, or from and to, in the scene's unit
  double least = 0, most = 0;       // a draw outside is drawn again
  unsigned line = 0;                // of the study

  double si(const std::string& value) const;  // of a number
};

// What the table of scene keys says of a key that varies; no values yet. Error(usage) for a key that no scene has.
VariedKey varied_key(const std::string& name);

// What all of a study's stages know of it.
struct StudyPlan {
  std::string title, scene;           // scene: its path
  TrainNames train;                   // what the quantities are of; empty: the scene is a pair
  std::vector<Direction> directions;  // of sweeps; none: the pair at rest
  bool random = false;                // a sample, else a grid
  int seed = 1;
  bool marks_outside = false;  // else a variant outside the model's range is an error
  std::vector<VariedKey> keys;
  std::vector<std::string> quantities;  // gathered
  std::vector<std::string> figure_quantities, figure_keys;
  std::string figure_colour;  // one of the keys, or ""
  // What runs along x and y of a map of cells, keys or gathered quantities; empty: lines against figure_keys
  std::vector<std::string> figure_map;
};

struct Study : StudyPlan {
  std::string path;
  long variants = 0;
  std::vector<std::pair<std::string, std::string>> fixed;  // of [set]: key and value as a scene has them
  std::vector<long> compared;  // numbers of the two variants to be compared, from 0 on; or none
};

// Reads and checks a study; of a train also its scene, with [set], whose meshes the quantities are of. Error(input) names file:line, key, value and limit, for an unknown key,
// section or answer the nearest known one; so for a study that varies nothing, an empty range, a key or a value given twice, a
// torque that no path can hold, more than kMostVariants variants.
Study read_study(const std::string& path);

// What makes a scene of the first (0) or the second (1) variant to be compared: changes of scene_variant(). Throws Error(input) if
// the study marks none.
std::vector<std::string> design_changes(const Study& study, size_t which);

// Values of the keys in variant `index`, as a scene has them. Drawn ones depend on seed, index and key alone, so that a longer
// sample begins with a shorter one, and have 6 significant digits, so that tables show what was used.
std::vector<std::string> variant_values(const Study& study, long index);

struct StudyVariant {
  Scene scene;
  double torque =
      0;  // N m, of a pair: the one that varies, else the scene's first, which sets the bearing dampers anyway
  System layout;  // of a train
};

// The scene of variant `index`, whose values these are. Error(input) names study, variant and values, for whatever
// read_scene rejects.
StudyVariant study_variant(const Study& study, long index, const std::vector<std::string>& values);

// "variant 17 (damping.rayleigh_stiffness_s = 5.5e-06, operation.torque_Nm = 150)"
std::string variant_name(const StudyPlan& study, long index, const std::vector<std::string>& values);

// A study without what its variants do not depend on, and the variants by name: what is gathered from where.
struct GatheredVariant {
  std::string
      name;  // of its stage parameters and its artifact: the first 16 digits of the stage parameters' SHA-256
  std::vector<std::string> values;  // of the keys
};

// Keys of which the variants show that they change nothing: those that differ in one of them alone have the same stage
// parameters, and there are such. In a sample hardly any two differ in one key alone; the caller adds some that do.
std::vector<std::string> keys_without_effect(const StudyPlan& study,
                                             const std::vector<GatheredVariant>& variants);

std::string plan_text(const StudyPlan& study, const std::vector<GatheredVariant>& variants);

// Reads what plan_text wrote. Error(input) for anything else.
std::pair<StudyPlan, std::vector<GatheredVariant>> read_plan(const std::string& path);

// "variants/ab/ab12....": stage parameters and artifact of a variant below the study's folder, without extension. In 256
// folders, because a folder with all of them would be slow.
std::string variant_file(const std::string& name);

// As the stage parameters of scene.h.
std::string variant_stage_parameters(const Scene& scene, double torque,
                                     const std::vector<Direction>& directions);
std::string variant_stage_parameters(const StudyVariant& variant, const std::vector<Direction>& directions);
VariantParameters read_variant_parameters(const std::string& path);

}  // namespace whine
