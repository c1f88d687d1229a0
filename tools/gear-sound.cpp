// gear-sound: a force of a periodic motion as sound, at one speed, one branch after the other.
//
// Reads      sweep.h5 of one or several directions or designs; --transfer: a transfer function (CSV)
// Writes     <output>.wav (48 kHz, 24 bits, one channel) and <output>.tsv: tones of each branch
// Equations  y = sum over k of Re(2 c_k H(k f) exp(2 pi i k f t)), c_k the Fourier coefficients of the force
#include <cmath>
#include <map>
#include <memory>
#include <sstream>

#include "base/error.h"
#include "base/tool.h"
#include "io/publish.h"
#include "io/sweep_codec.h"
#include "io/transfer_function.h"
#include "io/wav.h"
#include "signal/sound.h"

namespace {

using namespace whine;
using Eigen::Index;
using Eigen::VectorXd;

constexpr int kRate = 48000;       // Hz
constexpr double kPause = 0.25;    // s, between two branches
constexpr double kFade = 0.02;     // s
constexpr double kHeadroom = 1.1;  // of a full scale that nobody has chosen, above the loudest sample

struct Heard {
  std::string name;
  double fundamental;  // Hz
  VectorXd record;     // (sample) N
};

Heard heard_at(const std::string& path, double frequency, const std::string& bearing) {
  const SweepArtifact sweep = read_sweep(path);
  Index row = 0;
  const double off = (sweep.mesh_frequency.array() - frequency).abs().minCoeff(&row);
  if (!(off <= 1e-9 * frequency))
    fail(Failure::input, path, ": holds no speed of ", frequency, " Hz; the nearest is ",
         sweep.mesh_frequency[row], " Hz");
  if (sweep.period_multiple[row] == 0)
    fail(Failure::input, path, ": the motion at ", frequency, " Hz is not periodic; choose another speed");
  // One orbit; behind it the row repeats.
  const Index periods = sweep.period_multiple[row], samples = periods * sweep.time.steps_per_period;
  Heard out{name_of(sweep.direction), sweep.mesh_frequency[row] / static_cast<double>(periods),
            sweep.mesh_force.row(row).head(samples)};
  if (bearing.empty()) return out;
  for (size_t g = 0; g < kSides; ++g)
    for (const int axis : {0, 1}) {
      const auto& force = sweep.bearing_force[g];
      if (force.empty() || bearing != sweep.mesh.gear[g] + (axis == 0 ? ":x" : ":y")) continue;
      out.record = force[static_cast<size_t>(row)].col(axis).head(samples);
      return out;
    }
  fail(Failure::usage, "--bearing ", printable(bearing, 80),
       ": wanted is <gear>:x or <gear>:y of a gear on an elastic bearing; ", path, " is of ",
       sweep.mesh.gear[0], " and ", sweep.mesh.gear[1]);
}

// Designs of one direction: up_1, up_2 in the order of the command line.
void number_names(std::vector<Heard>& branches) {
  std::map<std::string, std::vector<Heard*>> named;
  for (Heard& branch : branches) named[branch.name].push_back(&branch);
  for (const auto& [name, same] : named)
    for (size_t i = 0; same.size() > 1 && i < same.size(); ++i) same[i]->name += text("_", i + 1);
}

// A branch without sound has no level.
std::string tones(const std::vector<Heard>& branches, const std::vector<VectorXd>& sounds,
                  const std::string& unit) {
  std::vector<double> rms;
  for (const VectorXd& y : sounds) {
    rms.push_back(std::sqrt(y.squaredNorm() / static_cast<double>(y.size())));
    if (!(rms.back() > 0))
      fail(Failure::input, "nothing is heard of ", branches[rms.size() - 1].name, ": no harmonic below ",
           kRate / 2, " Hz within the transfer function");
  }
  std::ostringstream out;
  out.precision(9);
  out << "# RMS of each branch; level re 1 " << unit
      << "\nbranch\tfundamental_Hz\trms\tlevel_dB\tabove_first_dB\n";
  for (size_t b = 0; b < branches.size(); ++b) {
    const auto& [name, fundamental, record] = branches[b];
    const double here = level(rms[b], 1), above = here - level(rms[0], 1);
    out << name << '\t' << fundamental << '\t' << rms[b] << '\t' << here << '\t' << above << '\n';
    tell("gear-sound: ", name, ": ", rms[b], " ", unit, " RMS, ", here, " dB, ", above,
         " dB above the first");
  }
  return out.str();
}

void body(int argc, char** argv) {
  Options options{"Writes a force of a periodic motion as sound, one branch after the other", "gear-sound"};
  std::vector<std::string> inputs;
  std::string output, transfer_path, bearing;
  double frequency = 0, seconds = 3, full_scale = 0;
  options.add("--sweep", inputs, "sweep.h5, once for each branch").required();
  options.add("--mesh-frequency", frequency, "speed in Hz, one of the sweep's").required();
  options.add("--output", output, "path without extension").required();
  options.add("--bearing", bearing, "<gear>:x or <gear>:y: the force on its bearing; else the mesh force");
  options.add("--transfer", transfer_path, "CSV: frequency_Hz, magnitude, phase_deg");
  options.add("--seconds", seconds, "of each branch").show_default();
  options
      .add("--full-scale", full_scale,
           "N (or unit of the transfer function's output) of a full scale; 0: a tenth above the loudest")
      .show_default();
  options.footer(
      "Example:\n"
      "  gear-sound --sweep out/parker2000/T150/up/sweep.h5 --sweep out/parker2000/T150/down/sweep.h5 "
      "--mesh-frequency 2400 --output sound");
  options.parse(argc, argv);
  if (!(seconds >= 0.1 && seconds <= 600)) fail(Failure::usage, "--seconds ", seconds, ": 0.1 to 600");
  if (!(full_scale >= 0)) fail(Failure::usage, "--full-scale ", full_scale, ": above 0, or 0");

  std::unique_ptr<Transfer> transfer;
  if (!transfer_path.empty()) transfer = std::make_unique<Transfer>(read_transfer_function(transfer_path));
  std::vector<Heard> branches;
  std::vector<VectorXd> sounds;
  const Index length = std::lround(seconds * kRate), pause = std::lround(kPause * kRate);
  for (const std::string& path : inputs) {
    branches.push_back(heard_at(path, frequency, bearing));
    sounds.push_back(
        sound(branches.back().record, branches.back().fundamental, transfer.get(), kRate, length));
  }
  number_names(branches);
  const std::string table = tones(branches, sounds, transfer ? "unit of the transfer function" : "N");
  double loudest = 0;
  for (const VectorXd& y : sounds) loudest = std::max(loudest, y.cwiseAbs().maxCoeff());
  if (full_scale == 0) full_scale = kHeadroom * loudest;
  if (loudest > full_scale)
    fail(Failure::usage, "--full-scale ", full_scale, ": the loudest sample is ", loudest, "; choose more");

  VectorXd all = VectorXd::Zero(static_cast<Index>(sounds.size()) * (length + pause) - pause);
  for (size_t b = 0; b < sounds.size(); ++b) {
    fade(sounds[b], std::lround(kFade * kRate));
    all.segment(static_cast<Index>(b) * (length + pause), length) = sounds[b] / full_scale;
  }
  publish(output + ".wav", wav_bytes(all, kRate));
  publish(output + ".tsv", table);
  tell("gear-sound: ", frequency, " Hz, ", inputs.size(), " branches, full scale ", full_scale, " -> ",
       output, ".{wav,tsv}");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
