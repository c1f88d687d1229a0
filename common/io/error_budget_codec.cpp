#include "io/error_budget_codec.h"

#include "io/codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kErrorBudgetSchema{"error_budget", 4};

void describe_changes(Codec& c, const std::string& group, StaticChanges& a, const std::string& what) {
  const std::string axis = group.substr(1) + "/change";  // `entry` names them in one text
  c.dataset({group + "/entry", "1", what + ", in the order of the entries", ""}, &a.entry);
  c.dataset(
      {group + "/mean_stiffness_change", "1", "relative change of the mean secant stiffness", axis, kSigned},
      &a.mean_stiffness_change);
  c.dataset({group + "/peak_to_peak_change", "1", "relative change of the peak-to-peak transmission error",
             axis, kSigned},
            &a.peak_to_peak_change);
  if (c.optional(group + "/pressure_change", a.pressure_change.size() > 0))
    c.dataset({group + "/pressure_change", "1",
               "relative change of the largest contact pressure inside a flank", axis, kSigned},
              &a.pressure_change);
  if (c.optional(group + "/root_stress_change", a.root_stress_change.size() > 0))
    c.dataset({group + "/root_stress_change", "1",
               "relative change of the largest root stress, of the gear where it is larger", axis, kSigned},
              &a.root_stress_change);
  c.dataset({group + "/harmonic_change", "1",
             "change of the first harmonics of the transmission error over its first harmonic",
             axis + " harmonic", kSigned},
            &a.harmonic_change);
}

}  // namespace

void describe(Codec& c, ErrorBudgetResult& a) {
  describe_pair(c, a);
  describe_torque(c, a.torque);
  describe_changes(c, "/refinement", a.refinement, "what was refined alone");
  c.numbers("harmonic", 1, "number of the harmonic of the mesh frequency");
  describe_changes(c, "/choice", a.choice,
                   "what was chosen instead, for information and in no sum of errors");
  if (c.optional("/choice/missing", !a.choice_missing.empty()))
    c.dataset({"/choice/missing", "1", "other choices that could not be computed, and why", ""},
              &a.choice_missing);
  if (c.optional("/root/element_size", a.root.element_size.size() > 0)) {
    c.dataset({"/root/element_size", "m",
               "size of the elements on the root of the driver; those of the driven gear in proportion",
               "root/level", kSize},
              &a.root.element_size);
    c.dataset({"/root/stress", "Pa", "largest root stress at rest with elements of that size on the roots",
               "root/level gear", kStress},
              &a.root.stress);
  }
}

void write(const std::string& path, const ErrorBudgetResult& a, const Provenance& provenance) {
  write_artifact(path, kErrorBudgetSchema,
                 "Error budget of the static transmission error: " + pair_title(a.mesh, a.torque), a,
                 provenance);
}

ErrorBudgetResult read_error_budget(const std::string& path) {
  return read_artifact<ErrorBudgetResult>(path, kErrorBudgetSchema);
}

}  // namespace whine
