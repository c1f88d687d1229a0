#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"

namespace whine {
namespace {

using namespace ranges;

void describe_pair_at_rest(Codec& c, JumpMapResult& a) {
  c(a.mean_stiffness, "/mean_stiffness", "N m-1", kStiff, "",
    "mean of the secant stiffness over a mesh period");
  c(a.first_harmonic, "/first_harmonic", "N m-1", kStiff, "",
    "amplitude of the first harmonic of the secant stiffness");
  c(a.one_pair_frequency, "/one_pair_frequency", "Hz", kFrequency, "",
    "natural frequency with one pair, contact frozen, undamped; 0: one pair never carries all");
  c(a.two_pair_frequency, "/two_pair_frequency", "Hz", kFrequency, "",
    "natural frequency with two pairs, contact frozen, undamped");
}

void describe_cases(Codec& c, JumpMapResult& a) {
  c(a.rayleigh_stiffness, "/rayleigh_stiffness", "s", kTime, "case", "Rayleigh stiffness factor eta",
    "Eq. 21");
  c(a.damping_ratio, "/damping_ratio", "1", kSigned, "case",
    "damping ratio of two pairs with their contact frozen under the static load; of a lumped model about its mean stiffness");
  c(a.branches_from, "/branches_from", "Hz", kFrequency, "case", "least speed with two motions; 0: none");
  c(a.branches_to, "/branches_to", "Hz", kFrequency, "case", "largest speed with two motions; 0: none");
  c(a.loss_from, "/loss_from", "Hz", kFrequency, "case",
    "least speed at which contact is lost on any branch; 0: none");
  c(a.loss_to, "/loss_to", "Hz", kFrequency, "case",
    "largest speed at which contact is lost on any branch; 0: none");
  c(a.excitation, "/excitation", "1", kPositive, "case",
    "first harmonic of the secant mesh stiffness over its mean, over twice the damping ratio",
    "k1 / k0 / (2 zeta)");
  c(a.two_branches, "/two_branches", "1", kFlag, "case", "1: speeds with two motions were found");
  c(a.open_below, "/open_below", "1", kFlag, "case",
    "1: the speeds with two motions go on below the least speed");
  c(a.unsteady, "/unsteady", "1", kNumber, "case",
    "speeds and directions at which no steady motion was found");
}

void describe_loads(Codec& c, JumpMapResult& a) {
  const char* const axes = "case direction";
  c(a.peak_tooth_load, "/peak_tooth_load", "N", kLoad, axes,
    "largest normal force of one tooth pair at any speed; directions up, down");
  c(a.sustained_tooth_load, "/sustained_tooth_load", "N", kLoad, axes,
    "largest normal force of one tooth pair sustained for 1/64 of a mesh period; directions up, down");
  c(a.load_frequency, "/load_frequency", "Hz", kFrequency, "",
    "speed of tooth_load, sustained_load_there and dte_rms_there; 0: none was asked for");
  if (!c.lists() && !(a.load_frequency > 0)) return;
  c(a.tooth_load, "/tooth_load", "N", kForce, axes,
    "largest normal force of one tooth pair at load_frequency; directions up, down");
  c(a.sustained_load_there, "/sustained_load_there", "N", kLoad, axes,
    "the same sustained for 1/64 of a mesh period");
  c(a.dte_rms_there, "/dte_rms_there", "m", kSize, axes,
    "RMS of the transmission error at load_frequency; directions up, down");
}

void describe_jumps(Codec& c, JumpMapResult& a) {
  c(a.jump_case, "/jump_case", "1", kNumber, "jump", "case in which the response jumps, counted from 0");
  require_indices(c, "/jump_case", a.jump_case.transpose(), c.length("case"));
  c(a.jump_direction, "/jump_direction", "1", kFlag, "jump", "0: speed rising, 1: falling");
  c(a.jump_frequency, "/jump_frequency", "Hz", kFrequency, "jump",
    "middle of the interval in which the response jumps");
  c(a.jump_width, "/jump_width", "Hz", kFrequency, "jump",
    "width of the interval in which the response jumps");
}

void describe_curves(Codec& c, JumpMapResult& a) {
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, "mesh_frequency", "mesh frequency, ascending");
  for (int d = 0; d < 2; ++d) {
    const std::string at = d == 0 ? "/up/" : "/down/", speed = d == 0 ? ", speed rising" : ", speed falling";
    const char* const axes = "case mesh_frequency";
    c(a.dte_rms[d], at + "dte_rms", "m", kLoad, axes,
      "RMS of the oscillating part of the dynamic transmission error" + speed);
    c(a.tooth_load_max[d], at + "tooth_load_max", "N", kLoad, axes,
      "largest normal force of one tooth pair" + speed);
    c(a.separation_fraction[d], at + "separation_fraction", "1", kLoad, axes,
      "share of the period without force" + speed);
  }
}

}  // namespace

void describe(Codec& c, JumpMapResult& a) {
  if (c.out() && !(a.load_frequency > 0) &&
      a.tooth_load.size() + a.sustained_load_there.size() + a.dte_rms_there.size() > 0)
    fail(Failure::numerical, "result tooth_load has ", a.tooth_load.rows(), " rows, expected 0");
  describe_pair(c, a);
  describe_motion(c, a);
  c(a.bearing_stiffness, "/parameters/damping/mean_stiffness", "N m-1", kStiff, "",
    "mean secant stiffness that sets the bearing dampers");
  describe_torque(c, a.torque);
  describe_model(c, a.model, "finite elements, or the name of a lumped model", &a.damper_acts);
  describe_pair_at_rest(c, a);
  describe_cases(c, a);
  describe_loads(c, a);
  describe_jumps(c, a);
  describe_curves(c, a);
}

std::string title(const JumpMapResult& a) {
  return "Jumps against damping: " + pair_title(a.mesh, a.torque);
}

template struct ArtifactFile<JumpMapResult>;

}  // namespace whine
