#include "io/artifacts.h"

#include "io/artifact_file.h"

namespace whine {
namespace {

using namespace ranges;

void describe_changes(Codec& c, const std::string& group, StaticChanges& a, const std::string& what) {
  const std::string axis = group.substr(1) + "/change";  // `entry` names them in one text
  c(a.entry, group + "/entry", "", what + ", in the order of the entries");
  c(a.mean_stiffness_change, group + "/mean_stiffness_change", "1", kSigned, axis,
    "relative change of the mean secant stiffness; in a train every change is that of the mesh where it is largest");
  c(a.peak_to_peak_change, group + "/peak_to_peak_change", "1", kSigned, axis,
    "relative change of the peak-to-peak transmission error");
  if (c.optional(group + "/pressure_change", a.pressure_change.size() > 0))
    c(a.pressure_change, group + "/pressure_change", "1", kSigned, axis,
      "relative change of the largest contact pressure inside a flank");
  if (c.optional(group + "/root_stress_change", a.root_stress_change.size() > 0))
    c(a.root_stress_change, group + "/root_stress_change", "1", kSigned, axis,
      "relative change of the largest root stress, of the gear where it is larger");
  if (c.optional(group + "/load_factor_change", a.load_factor_change.size() > 0))
    c(a.load_factor_change, group + "/load_factor_change", "1", kSigned, axis,
      "relative change of the face load factor K_Hbeta of the reference pair at mesh phase 0");
  if (c.optional(group + "/order", a.order.size() > 0))
    c(a.order, group + "/order", "1", kSigned, axis,
      "power of the step with which the error falls; 0: none shows, and the change itself is the error");
  c(a.harmonic_change, group + "/harmonic_change", "1", kSigned, axis + " harmonic",
    "change of the first harmonics of the transmission error over its first harmonic");
}

}  // namespace

void describe(Codec& c, ErrorBudgetResult& a) {
  describe_pair(c, a);
  describe_torque(c, a.torque);
  c(a.gear_names, "/gear_name", "gear_name", "names of the gears");
  describe_changes(c, "/refinement", a.refinement, "what was refined alone");
  c.numbers("harmonic", 1, "number of the harmonic of the mesh frequency");
  describe_changes(c, "/choice", a.choice,
                   "what was chosen instead, for information and in no sum of errors");
  if (c.optional("/choice/missing", !a.choice_missing.empty()))
    c(a.choice_missing, "/choice/missing", "", "other choices that could not be computed, and why");
  if (c.optional("/root/element_size", a.root.element_size.size() > 0)) {
    c(a.root.element_size, "/root/element_size", "m", kSize, "root/level",
      "size of the elements on the root of the first gear; those of the others in proportion");
    c(a.root.stress, "/root/stress", "Pa", kStress, "root/level gear_name",
      "largest root stress at rest with elements of that size on the roots");
  }
}

std::string title(const ErrorBudgetResult& a) {
  const std::string what = "Error budget of the static transmission error";
  return a.gear_names.size() == kSides
             ? what + ": " + pair_title(a.mesh, a.torque)
             : text(what, " of ", a.gear_names.size(), " gears with ", a.torque, " N m");
}

template struct ArtifactFile<ErrorBudgetResult>;

}  // namespace whine
