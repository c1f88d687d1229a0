#include "io/artifacts.h"

#include "io/artifact_file.h"
#include "io/system_motion_codec.h"

namespace whine {

using namespace ranges;

void describe(Codec& c, FoldCurvesResult& a) {
  describe_source(c, a);
  c(a.quantity, "/quantity", "",
    "what varies beside the mesh frequency: damping, torque, tip_relief or bearing_stiffness");
  c(a.first_value, "/first_value", "1", kPositive, "",
    "value at which the folds come from a branch, in SI units");
  c(a.curve, "/curve", "1", kNumber, "point",
    "curve of the point, counted from 0; 2 i and 2 i + 1 may meet in a cusp");
  c(a.value, "/value", "1", kPositive, "point",
    "value of the quantity in SI units: Rayleigh stiffness factor in s, torque in N m (of a train on the body whose torque drives it, the others in proportion), amount of the linear tip relief of both gears in m, stiffness of the elastic bearings over that of the scene");
  c(a.damping_ratio, "/damping_ratio", "1", kSigned, "point",
    "damping ratio of two pairs with their contact frozen under the static load; of slices and trains Rayleigh's, of the mode that gives way most to the driving torque");
  c(a.fold_frequency, "/fold_frequency", "Hz", kFrequency, "point", "mesh frequency of the fold");
  c(a.fold_multiplier, "/fold_multiplier", "1", kMultiplier, "point side",
    "real multiplier nearest to 1 on either side of the fold");
  c(a.highest, "/highest", "1", kFlag, "point",
    "1: the branch turns back from rising speed, 0: from falling speed");
  c(a.cusp_value, "/cusp_value", "1", kPositive, "cusp",
    "value of the quantity in SI units at which two curves meet");
  c(a.cusp_damping_ratio, "/cusp_damping_ratio", "1", kSigned, "cusp", "damping ratio there");
  c(a.cusp_frequency, "/cusp_frequency", "Hz", kFrequency, "cusp", "mesh frequency there");
  c(a.cusp_curve, "/cusp_curve", "1", kNumber, "cusp", "the first of the two curves that meet");
  c(a.end, "/end", "", "why the curves were followed no further");
}

std::string title(const FoldCurvesResult& a) {
  return "Folds over " + name_of(a.quantity) + ": " +
         (a.of_train() ? text("a system of ", a.bodies(), " bodies, ", a.meshes(), " meshes")
                       : pair_title(a.mesh, a.torque));
}

template struct ArtifactFile<FoldCurvesResult>;

}  // namespace whine
