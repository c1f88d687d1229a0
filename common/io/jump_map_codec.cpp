#include "io/jump_map_codec.h"

#include "base/error.h"
#include "io/codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kJumpMapSchema{"jump_map", 2};

void describe_pair_at_rest(Codec& c, JumpMapResult& a) {
  c.dataset({"/mean_stiffness", "N m-1", "mean of the secant stiffness over a mesh period", "", kStiff},
            &a.mean_stiffness);
  c.dataset(
      {"/first_harmonic", "N m-1", "amplitude of the first harmonic of the secant stiffness", "", kStiff},
      &a.first_harmonic);
  c.dataset({"/one_pair_frequency", "Hz",
             "natural frequency with one pair, contact frozen, undamped; 0: one pair never carries all", "",
             kFrequency},
            &a.one_pair_frequency);
  c.dataset({"/two_pair_frequency", "Hz", "natural frequency with two pairs, contact frozen, undamped", "",
             kFrequency},
            &a.two_pair_frequency);
}

void describe_cases(Codec& c, JumpMapResult& a) {
  c.dataset({"/rayleigh_stiffness", "s", "Rayleigh stiffness factor eta", "case", kTime, "Eq. 21"},
            &a.rayleigh_stiffness);
  c.dataset(
      {"/damping_ratio", "1",
       "damping ratio of two pairs with their contact frozen under the static load; of a lumped model about its mean stiffness",
       "case", kSigned},
      &a.damping_ratio);
  c.dataset({"/branches_from", "Hz", "least speed with two motions; 0: none", "case", kFrequency},
            &a.branches_from);
  c.dataset({"/branches_to", "Hz", "largest speed with two motions; 0: none", "case", kFrequency},
            &a.branches_to);
  c.dataset(
      {"/loss_from", "Hz", "least speed at which contact is lost on any branch; 0: none", "case", kFrequency},
      &a.loss_from);
  c.dataset(
      {"/loss_to", "Hz", "largest speed at which contact is lost on any branch; 0: none", "case", kFrequency},
      &a.loss_to);
  c.dataset({"/excitation", "1",
             "first harmonic of the secant mesh stiffness over its mean, over twice the damping ratio",
             "case", kPositive, "k1 / k0 / (2 zeta)"},
            &a.excitation);
  c.dataset({"/two_branches", "1", "1: speeds with two motions were found", "case", kFlag}, &a.two_branches);
  c.dataset({"/open_below", "1", "1: the speeds with two motions go on below the least speed", "case", kFlag},
            &a.open_below);
  c.dataset({"/unsteady", "1", "speeds and directions at which no steady motion was found", "case", kNumber},
            &a.unsteady);
}

void describe_loads(Codec& c, JumpMapResult& a) {
  const char* const axes = "case direction";
  c.dataset({"/peak_tooth_load", "N",
             "largest normal force of one tooth pair at any speed; directions up, down", axes, kLoad},
            &a.peak_tooth_load);
  c.dataset(
      {"/sustained_tooth_load", "N",
       "largest normal force of one tooth pair sustained for 1/64 of a mesh period; directions up, down",
       axes, kLoad},
      &a.sustained_tooth_load);
  c.dataset(
      {"/load_frequency", "Hz",
       "speed of tooth_load, sustained_load_there and dte_rms_there; 0: none was asked for", "", kFrequency},
      &a.load_frequency);
  if (!c.lists() && !(a.load_frequency > 0)) return;
  c.dataset({"/tooth_load", "N",
             "largest normal force of one tooth pair at load_frequency; directions up, down", axes, kForce},
            &a.tooth_load);
  c.dataset({"/sustained_load_there", "N", "the same sustained for 1/64 of a mesh period", axes, kLoad},
            &a.sustained_load_there);
  c.dataset({"/dte_rms_there", "m", "RMS of the transmission error at load_frequency; directions up, down",
             axes, kSize},
            &a.dte_rms_there);
}

void describe_jumps(Codec& c, JumpMapResult& a) {
  c.dataset({"/jump_case", "1", "case in which the response jumps, counted from 0", "jump", kNumber},
            &a.jump_case);
  require_indices(c, "/jump_case", a.jump_case.transpose(), c.length("case"));
  c.dataset({"/jump_direction", "1", "0: speed rising, 1: falling", "jump", kFlag}, &a.jump_direction);
  c.dataset(
      {"/jump_frequency", "Hz", "middle of the interval in which the response jumps", "jump", kFrequency},
      &a.jump_frequency);
  c.dataset({"/jump_width", "Hz", "width of the interval in which the response jumps", "jump", kFrequency},
            &a.jump_width);
}

void describe_curves(Codec& c, JumpMapResult& a) {
  c.dataset({"/mesh_frequency", "Hz", "mesh frequency, ascending", "mesh_frequency", kSpeed},
            &a.mesh_frequency);
  for (int d = 0; d < 2; ++d) {
    const std::string at = d == 0 ? "/up/" : "/down/", speed = d == 0 ? ", speed rising" : ", speed falling";
    const char* const axes = "case mesh_frequency";
    c.dataset({at + "dte_rms", "m", "RMS of the oscillating part of the dynamic transmission error" + speed,
               axes, kLoad},
              &a.dte_rms[d]);
    c.dataset({at + "tooth_load_max", "N", "largest normal force of one tooth pair" + speed, axes, kLoad},
              &a.tooth_load_max[d]);
    c.dataset({at + "separation_fraction", "1", "share of the period without force" + speed, axes, kLoad},
              &a.separation_fraction[d]);
  }
}

}  // namespace

void describe(Codec& c, JumpMapResult& a) {
  describe_pair(c, a);
  describe_motion(c, a);
  c.dataset({"/parameters/damping/mean_stiffness", "N m-1",
             "mean secant stiffness that sets the bearing dampers", "", kStiff},
            &a.bearing_stiffness);
  describe_torque(c, a.torque);
  c.dataset({"/parameters/fidelity/model", "1", "finite elements, or the name of a lumped model", ""},
            &a.model);
  describe_pair_at_rest(c, a);
  describe_cases(c, a);
  describe_loads(c, a);
  describe_jumps(c, a);
  describe_curves(c, a);
}

void write(const std::string& path, const JumpMapResult& a, const Provenance& provenance) {
  if (!(a.load_frequency > 0) &&
      a.tooth_load.size() + a.sustained_load_there.size() + a.dte_rms_there.size() > 0)
    fail(Failure::numerical, "result tooth_load has ", a.tooth_load.rows(), " rows, expected 0");
  write_artifact(path, kJumpMapSchema, "Jumps against damping: " + pair_title(a.mesh, a.torque), a,
                 provenance);
}

JumpMapResult read_jump_map(const std::string& path) {
  return read_artifact<JumpMapResult>(path, kJumpMapSchema);
}

}  // namespace whine
