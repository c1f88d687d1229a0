#include "io/harris_map_codec.h"

#include "base/error.h"
#include "io/codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kHarrisMapSchema{"harris_map", 1};
const char* const kCube = "relief_length torque relief";

void describe_axes(Codec& c, HarrisMapResult& a) {
  c.dataset({"/torque", "N m", "torque on the driver", "torque", kDrive}, &a.torque);
  c.dataset({"/relief", "m", "material taken off at the tip edge, normal to the flank", "relief", kSize},
            &a.relief);
  c.dataset({"/relief_length", "m", "length of roll from where the relief starts to the tip edge",
             "relief_length", kSize, "r_b (tip roll angle - start roll angle)"},
            &a.length);
  c.dataset({"/start_roll_angle", "rad", "roll angle at which the relief starts, on driver and driven gear",
             "relief_length gear", kRoll},
            &a.start_roll);
}

void describe_optima(Codec& c, HarrisMapResult& a) {
  c.dataset({"/optimum_relief", "m", "relief of the least peak to peak at the design torque", "relief_length",
             kSize},
            &a.optimum_relief);
  c.dataset({"/optimum_peak_to_peak", "m", "peak to peak of that relief at the design torque",
             "relief_length", kSize},
            &a.optimum_peak_to_peak);
  c.dataset({"/cusp", "m", "peak to peak of that relief against torque", "relief_length torque", kSize},
            &a.cusp);
  c.dataset({"/unrelieved", "m", "peak to peak without tip relief", "torque", kSize}, &a.unrelieved);
  c.dataset({"/check/points", "1", "points of the map solved again with finer strips and at more positions",
             "", kNumber},
            &a.checked);
  c.dataset({"/check/largest_error", "1", "largest difference of the peak to peak from those, over it", "",
             kPositive},
            &a.largest_error);
}

void describe_dynamics(Codec& c, HarrisMapResult& a) {
  describe_motion(c, a);
  describe_speeds(c, a.frequency_from, a.frequency_to, a.frequency_step);
  c.dataset(
      {"/dynamic/rms", "m",
       "RMS of the oscillating part of the transmission error at the speed where it is largest, up or down",
       kCube, kSize},
      &a.dynamic_rms);
  c.dataset({"/dynamic/worst_frequency", "Hz", "mesh frequency at which it is largest", kCube, kFrequency},
            &a.worst_frequency);
}

}  // namespace

void describe(Codec& c, HarrisMapResult& a) {
  describe_pair(c, a);
  c.choice({"/parameters/relief/relieved", "1", "gears whose tips are relieved", ""}, a.relieved);
  c.choice({"/parameters/relief/shape", "1", "how the relief grows with the roll angle", ""}, a.shape);
  c.dataset({"/parameters/operation/design_torque", "N m",
             "torque on the driver for which the optimum is sought", "", kDrive},
            &a.design_torque);
  describe_axes(c, a);
  c.dataset({"/peak_to_peak", "m", "peak-to-peak static transmission error", kCube, kSize}, &a.peak_to_peak);
  for (int n = 0; n < 3; ++n)
    c.dataset({text("/harmonic_", n + 1), "m",
               text("amplitude of harmonic ", n + 1, " of the static transmission error"), kCube, kSize},
              &a.harmonic[n]);
  describe_optima(c, a);
  if (c.optional("/dynamic/rms", !a.dynamic_rms.empty())) describe_dynamics(c, a);
}

void write(const std::string& path, const HarrisMapResult& a, const Provenance& provenance) {
  write_artifact(path, kHarrisMapSchema, text("Harris map: ", a.mesh.gear[0], " drives ", a.mesh.gear[1]), a,
                 provenance);
}

HarrisMapResult read_harris_map(const std::string& path) {
  return read_artifact<HarrisMapResult>(path, kHarrisMapSchema);
}

}  // namespace whine
