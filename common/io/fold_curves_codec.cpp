#include "io/fold_curves_codec.h"

#include "io/codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kFoldCurvesSchema{"fold_curves", 1};

}  // namespace

void describe(Codec& c, FoldCurvesResult& a) {
  describe_pair(c, a);
  describe_motion(c, a);
  describe_torque(c, a.torque);
  c.choice({"/quantity", "1", "what varies beside the mesh frequency: damping, torque or tip_relief", ""},
           a.quantity);
  c.dataset({"/first_value", "1", "value at which the folds come from a branch, in SI units", "", kPositive},
            &a.first_value);
  c.dataset({"/curve", "1", "curve of the point, counted from 0; 2 i and 2 i + 1 may meet in a cusp", "point",
             kNumber},
            &a.curve);
  c.dataset(
      {"/value", "1",
       "value of the quantity in SI units: Rayleigh stiffness factor in s, torque in N m, amount of the linear tip relief of both gears in m",
       "point", kPositive},
      &a.value);
  c.dataset({"/damping_ratio", "1",
             "damping ratio of two pairs with their contact frozen under the static load", "point", kSigned},
            &a.damping_ratio);
  c.dataset({"/fold_frequency", "Hz", "mesh frequency of the fold", "point", kFrequency}, &a.fold_frequency);
  c.dataset({"/fold_multiplier", "1", "real multiplier nearest to 1 on either side of the fold", "point side",
             kMultiplier},
            &a.fold_multiplier);
  c.dataset(
      {"/highest", "1", "1: the branch turns back from rising speed, 0: from falling speed", "point", kFlag},
      &a.highest);
  c.dataset(
      {"/cusp_value", "1", "value of the quantity in SI units at which two curves meet", "cusp", kPositive},
      &a.cusp_value);
  c.dataset({"/cusp_damping_ratio", "1", "damping ratio there", "cusp", kSigned}, &a.cusp_damping_ratio);
  c.dataset({"/cusp_frequency", "Hz", "mesh frequency there", "cusp", kFrequency}, &a.cusp_frequency);
  c.dataset({"/cusp_curve", "1", "the first of the two curves that meet", "cusp", kNumber}, &a.cusp_curve);
  c.dataset({"/end", "1", "why the curves were followed no further", ""}, &a.end);
}

void write(const std::string& path, const FoldCurvesResult& a, const Provenance& provenance) {
  write_artifact(path, kFoldCurvesSchema,
                 "Folds over " + name_of(a.quantity) + ": " + pair_title(a.mesh, a.torque), a, provenance);
}

FoldCurvesResult read_fold_curves(const std::string& path) {
  return read_artifact<FoldCurvesResult>(path, kFoldCurvesSchema);
}

}  // namespace whine
