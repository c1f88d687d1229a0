// gear-sound: a force as sound: of a periodic motion at one speed, or of a run-up; one branch after the other.
//
// Reads      sweep.h5 or runup.h5 of one or several directions or designs; --transfer: a transfer function (CSV)
// Writes     <output>.wav (48 kHz or the rate of the run-up, 24 bits, one channel) and <output>.tsv: levels of each branch, of
//            run-ups in bands of the mesh frequency
// Equations  y = sum over k of Re(2 c_k H(k f) exp(2 pi i k f t)), c_k the Fourier coefficients of the force; of a run-up Y = H F
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/tool.h"
#include "io/publish.h"
#include "io/transfer_function.h"
#include "io/wav.h"
#include "report/sounds.h"

namespace {

using namespace whine;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double kPause = 0.25;    // s, between two branches
constexpr double kFade = 0.02;     // s
constexpr double kHeadroom = 1.1;  // of a full scale that nobody has chosen, above the loudest sample

void body(int argc, char** argv) {
  Options options{"Writes a force of a periodic motion as sound, one branch after the other", "gear-sound"};
  std::vector<std::string> sweeps, runups;
  HeardForce force;
  std::string output, transfer_path;
  double frequency = 0, seconds = 3, full_scale = 0;
  Option sweep = options.add("--sweep", sweeps, "sweep.h5 of a pair or a train, once for each branch");
  Option speed = options.add("--mesh-frequency", frequency, "speed in Hz, one of the sweep's");
  Option runup = options.add("--runup", runups, "runup.h5 in place of sweeps, once for each branch");
  speed.needs(sweep);
  runup.excludes(sweep);
  options.add("--output", output, "path without extension").required();
  Option bearing = options.add("--bearing", force.bearing,
                               "<body>:x or <body>:y: the force on its bearing; else a mesh force");
  options.add("--mesh", force.mesh, "mesh of a train, as sun-planet1, whose force is heard; else the first")
      .excludes(bearing);
  options.add("--transfer", transfer_path, "CSV: frequency_Hz, magnitude, phase_deg");
  options.add("--seconds", seconds, "of each branch of a sweep").show_default().needs(sweep);
  options
      .add("--full-scale", full_scale,
           "N (or unit of the transfer function's output) of a full scale; 0: a tenth above the loudest")
      .show_default();
  options.footer(
      "Example:\n"
      "  gear-sound --sweep out/parker2000/T150/up/sweep.h5 --sweep out/parker2000/T150/down/sweep.h5 --mesh-frequency 2400 --output sound");
  options.parse(argc, argv);
  if (runups.empty() && !(frequency > 0))
    fail(Failure::usage, "wanted is --sweep with --mesh-frequency above 0, or --runup");
  if (!(seconds >= 0.1 && seconds <= 600)) fail(Failure::usage, "--seconds ", seconds, ": 0.1 to 600");
  if (!(full_scale >= 0)) fail(Failure::usage, "--full-scale ", full_scale, ": above 0, or 0");

  std::unique_ptr<Transfer> transfer;
  if (!transfer_path.empty()) transfer = std::make_unique<Transfer>(read_transfer_function(transfer_path));
  Sounds heard = runups.empty() ? sounds_of_motions(sweeps, frequency, force, transfer.get(), seconds)
                                : sounds_of_runups(runups, force, transfer.get());
  double loudest = 0;
  for (const VectorXd& y : heard.sounds) loudest = std::max(loudest, y.cwiseAbs().maxCoeff());
  if (full_scale == 0) full_scale = kHeadroom * loudest;
  if (loudest > full_scale)
    fail(Failure::usage, "--full-scale ", full_scale, ": the loudest sample is ", loudest, "; choose more");

  const Index pause = std::lround(kPause * heard.rate);
  Index samples = -pause;
  for (const VectorXd& y : heard.sounds) samples += y.size() + pause;
  VectorXd all = VectorXd::Zero(samples);
  Index at = 0;
  for (VectorXd& y : heard.sounds) {
    fade(y, std::lround(kFade * heard.rate));
    all.segment(at, y.size()) = y / full_scale;
    at += y.size() + pause;
  }
  publish_all({{output + ".wav", wav_bytes(all, heard.rate)}, {output + ".tsv", heard.table}});
  log_line("gear-sound: ", runups.empty() ? text(frequency, " Hz") : "run-up", ", ", heard.sounds.size(),
           " branches, full scale ", full_scale, " -> ", output, ".{wav,tsv}");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
