#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"

namespace whine {
namespace {

using namespace ranges;

const char* const kCube = "relief_length torque relief";

void describe_axes(Codec& c, HarrisMapResult& a) {
  c(a.torque, "/torque", "N m", kDrive, "torque", "torque on the driver");
  c(a.relief, "/relief", "m", kSize, "relief", "material taken off at the tip edge, normal to the flank");
  c(a.length, "/relief_length", "m", kSize, "relief_length",
    "length of roll from where the relief starts to the tip edge", "r_b (tip roll angle - start roll angle)");
  c(a.start_roll, "/start_roll_angle", "rad", kRoll, "relief_length gear",
    "roll angle at which the relief starts, on driver and driven gear");
}

void describe_optima(Codec& c, HarrisMapResult& a) {
  c(a.optimum_relief, "/optimum_relief", "m", kSize, "relief_length",
    "relief of the least peak to peak at the design torque");
  c(a.optimum_peak_to_peak, "/optimum_peak_to_peak", "m", kSize, "relief_length",
    "peak to peak of that relief at the design torque");
  c(a.cusp, "/cusp", "m", kSize, "relief_length torque", "peak to peak of that relief against torque");
  c(a.unrelieved, "/unrelieved", "m", kSize, "torque", "peak to peak without tip relief");
  c(a.checked, "/check/points", "1", kNumber, "",
    "points of the map solved again with finer strips and at more positions");
  c(a.largest_error, "/check/largest_error", "1", kPositive, "",
    "largest difference of the peak to peak from those, over it");
}

void describe_dynamics(Codec& c, HarrisMapResult& a) {
  describe_motion(c, a);
  describe_speeds(c, a);
  c(a.dynamic_rms, "/dynamic/rms", "m", kSize, kCube,
    "RMS of the oscillating part of the transmission error at the speed where it is largest, up or down");
  c(a.worst_frequency, "/dynamic/worst_frequency", "Hz", kFrequency, kCube,
    "mesh frequency at which it is largest");
}

}  // namespace

void describe(Codec& c, HarrisMapResult& a) {
  describe_pair(c, a);
  c(a.relieved, "/parameters/relief/relieved", "", "gears whose tips are relieved");
  c(a.shape, "/parameters/relief/shape", "", "how the relief grows with the roll angle");
  c(a.design_torque, "/parameters/operation/design_torque", "N m", kDrive, "",
    "torque on the driver for which the optimum is sought");
  describe_axes(c, a);
  c(a.peak_to_peak, "/peak_to_peak", "m", kSize, kCube, "peak-to-peak static transmission error");
  for (int n = 0; n < 3; ++n)
    c(a.harmonic[n], text("/harmonic_", n + 1), "m", kSize, kCube,
      text("amplitude of harmonic ", n + 1, " of the static transmission error"));
  describe_optima(c, a);
  if (c.optional("/dynamic/rms", !a.dynamic_rms.empty())) describe_dynamics(c, a);
}

std::string title(const HarrisMapResult& a) {
  return text("Harris map: ", a.mesh.gear[0], " drives ", a.mesh.gear[1]);
}

template struct ArtifactFile<HarrisMapResult>;

}  // namespace whine
