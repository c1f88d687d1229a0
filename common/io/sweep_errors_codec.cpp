#include "io/artifact_file.h"
#include "io/artifacts.h"
#include "io/system_motion_codec.h"

namespace whine {

using namespace ranges;

namespace {

constexpr const char* kSum = "sum |change| / (1 - 2^-p)";

void describe_judged(Codec& c, SweepErrorsResult::Judged& a, const std::string& name, const char* units,
                     const std::string& meaning) {
  const std::string over = "mesh_frequency mesh";
  c(a.value, "/" + name, units, *units == 'm' ? kSize : kLoad, over, meaning);
  c(a.error, "/error/" + name, "1", kPositive, over,
    "relative discretisation error of " + name +
        ": sum over the refinements of the change, with the order where one shows",
    kSum);
  c(a.change, "/change/" + name, "1", kSigned, "refinement " + over,
    name + " over that of the refined sweep, less 1; 0 where nothing is compared");
}

}  // namespace

void describe(Codec& c, SweepErrorsResult& a) {
  constexpr const char* kSpeeds = "mesh_frequency";
  describe_source(c, a);
  if (!a.of_train()) describe_natural_frequency(c, a.natural_frequency);
  c(a.direction, "/parameters/operation/direction", "", "direction in which the speeds are run through");
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, kSpeeds,
    "mesh frequencies at which errors were measured, in the order in which they were computed");
  c(a.jump_frequency, "/jump_frequency", "Hz", kFrequency, "jump",
    "middle of the interval in which the response jumps");
  c(a.jump_error, "/error/jump_frequency", "Hz", kFrequency, "jump",
    "discretisation error of jump_frequency, as that of dte_rms", kSum);
  if (!a.of_train()) {
    c(a.natural_frequency_error, "/error/natural_frequency", "1", kPositive, "",
      "relative discretisation error of the natural frequency, as that of dte_rms", kSum);
    c(a.natural_frequency_change, "/change/natural_frequency", "1", kSigned, "refinement",
      "natural frequency over that of the refined pair, less 1");
  }
  c(a.entry, "/refinement", "refinement", "what was refined alone, from which value to which");
  c(a.order, "/refinement_order", "1", kPositive, "refinement",
    "p, if the change of dte_rms goes with the power p of the size that is refined; 0: none shows, and the change itself is the error");
  c(a.compared, "/compared", "1", kFlag, "refinement mesh_frequency",
    "1: both motions repeat after as many periods and are on one branch; 0: there is no change to tell");
  describe_judged(c, a.dte_rms, "dte_rms", "m",
                  "RMS of the oscillating part of the dynamic transmission error");
  describe_judged(c, a.dte_first_order, "dte_first_order", "m",
                  "amplitude of the first harmonic of the dynamic transmission error");
  describe_judged(c, a.tooth_load_max, "tooth_load_max", "N", "largest normal force of one tooth pair");
  describe_judged(c, a.tooth_load_sustained, "tooth_load_sustained", "N",
                  "the same, sustained for 1/64 of a mesh period; 0 where it is not known");
  describe_judged(c, a.mesh_force_max, "mesh_force_max", "N",
                  "largest normal force of all tooth pairs of a mesh");
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
