#include "io/artifact_file.h"
#include "io/artifacts.h"
#include "io/system_motion_codec.h"

namespace whine {

using namespace ranges;

void describe(Codec& c, SweepErrorsResult& a) {
  constexpr const char* kSpeeds = "mesh_frequency";
  constexpr const char* kOfMesh = "mesh_frequency mesh";
  describe_source(c, a);
  if (!a.of_train()) describe_natural_frequency(c, a.natural_frequency);
  describe_names(c, a.of_train(), a.mesh_names, a.body_names);
  c(a.direction, "/parameters/operation/direction", "", "direction in which the speeds are run through");
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, kSpeeds,
    "mesh frequencies at which errors were measured, in the order in which they were computed");
  c(a.dte_rms, "/dte_rms", "m", kSize, kOfMesh,
    "RMS of the oscillating part of the dynamic transmission error");
  c(a.tooth_load_max, "/tooth_load_max", "N", kLoad, kOfMesh, "largest normal force of one tooth pair");
  c(a.jump_frequency, "/jump_frequency", "Hz", kFrequency, "jump",
    "middle of the interval in which the response jumps");
  c(a.dte_rms_error, "/error/dte_rms", "1", kPositive, kOfMesh,
    "discretisation error of dte_rms, relative: sum over the refinements of the change, with the order where one shows",
    "sum |change| / (1 - 2^-p)");
  c(a.tooth_load_error, "/error/tooth_load_max", "1", kPositive, kOfMesh, "the same of tooth_load_max",
    "sum |change| / (1 - 2^-p)");
  c(a.jump_error, "/error/jump_frequency", "Hz", kFrequency, "jump", "the same of jump_frequency",
    "sum |change| / (1 - 2^-p)");
  c(a.entry, "/refinement", "refinement", "what was refined alone, from which value to which");
  c(a.order, "/refinement_order", "1", kPositive, "refinement",
    "p, if the change of dte_rms goes with the power p of the size that is refined; 0: none shows, and the change itself is the error");
  c(a.compared, "/compared", "1", kFlag, "refinement mesh_frequency",
    "1: both motions repeat after as many periods and are on one branch; 0: there is no change to tell");
  c(a.dte_rms_change, "/change/dte_rms", "1", kSigned, "refinement mesh_frequency mesh",
    "dte_rms over that of the refined sweep, less 1; 0 where nothing is compared");
  c(a.tooth_load_change, "/change/tooth_load_max", "1", kSigned, "refinement mesh_frequency mesh",
    "the same of tooth_load_max");
  c(a.jump_found, "/jump_found", "1", kFlag, "refinement jump",
    "1: the refined sweep jumps within two steps of the speed; 0: it does not");
  c(a.jump_change, "/change/jump_frequency", "Hz", {-1e9, 1e9}, "refinement jump",
    "jump_frequency less that of the refined sweep; 0 where none is found");
  if (c.in() && a.mesh_frequency.size() == 0) c.in()->reject("dataset /mesh_frequency holds no speed");
}

std::string title(const SweepErrorsResult& a) {
  if (a.of_train())
    return text("Errors of the sweep ", a.direction, " of a system: ", a.body_names.size(), " bodies, ",
                a.mesh_names.size(), " meshes");
  return text("Errors of the sweep ", a.direction, ": ", pair_title(a.mesh, a.torque));
}

template struct ArtifactFile<SweepErrorsResult>;

}  // namespace whine
