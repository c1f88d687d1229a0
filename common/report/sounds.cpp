#include "report/sounds.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "base/tool.h"
#include "io/sound_inputs.h"

namespace whine {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kMostBands = 100;
constexpr double kLeastTime = 1e-3;  // s of a run-up in a band; its samples are spread evenly over the bands

std::string unit_of(const Transfer* transfer) {
  return transfer ? "unit of the transfer function" : "N";
}

// A branch without sound has no level.
void require_heard(const std::string& name, const VectorXd& sound, int rate) {
  if (!(sound.squaredNorm() > 0))
    fail(Failure::input, "nothing is heard of ", name, ": no harmonic below ", rate / 2,
         " Hz within the transfer function");
}

double rms_of(const VectorXd& y) {
  return std::sqrt(y.squaredNorm() / static_cast<double>(y.size()));
}

std::string tones(const std::vector<HeardMotion>& branches, const std::vector<VectorXd>& sounds,
                  const std::string& unit) {
  std::ostringstream out;
  out.precision(9);
  out << "# " << branches[0].force << ", RMS of each branch; level re 1 " << unit
      << "\nbranch\tfundamental_Hz\trms\tlevel_dB\tabove_first_dB\n";
  for (size_t b = 0; b < branches.size(); ++b) {
    const double rms = rms_of(sounds[b]), here = level(rms, 1), above = here - level(rms_of(sounds[0]), 1);
    out << branches[b].name << '\t' << branches[b].fundamental << '\t' << rms << '\t' << here << '\t' << above
        << '\n';
    log_line("gear-sound: ", branches[b].name, ": ", rms, " ", unit, " RMS, ", here, " dB, ", above,
             " dB above the first");
  }
  return out.str();
}

// Levels in bands of the mesh frequency that all run-ups pass.
std::string bands(const std::vector<HeardRunup>& runs, const std::vector<VectorXd>& sounds,
                  const std::string& unit) {
  double low = 0, high = 1e300;
  for (const HeardRunup& run : runs) {
    low = std::max(low, run.mesh_frequency.minCoeff());
    high = std::min(high, run.mesh_frequency.maxCoeff());
  }
  if (!(high > low))
    fail(Failure::input, "the run-ups have no mesh frequency in common; give ramps over the same speeds");
  // Short run-ups have fewer bands.
  const auto least = static_cast<Index>(std::ceil(kLeastTime * runs[0].rate));
  Index shared = runs[0].mesh_frequency.size();
  for (const HeardRunup& run : runs)
    shared = std::min<Index>(
        shared, (run.mesh_frequency.array() >= low && run.mesh_frequency.array() <= high).count());
  const Index count = std::min(kMostBands, shared / (2 * least));
  if (count < 1)
    fail(Failure::input, "the run-ups have ", 1e3 * static_cast<double>(shared) / runs[0].rate,
         " ms between the mesh frequencies ", low, " and ", high, " Hz, which all of them pass; ",
         2e3 * kLeastTime, " ms are the least for a level: give a wider range of speeds or a lower rate");
  const VectorXd edges = VectorXd::LinSpaced(count + 1, low, high);
  std::ostringstream out;
  out.precision(9);
  out << "# " << runs[0].force << ", level re 1 " << unit
      << " in bands of the mesh frequency\nmesh_frequency_Hz";
  std::vector<VectorXd> rms;
  for (size_t b = 0; b < runs.size(); ++b) {
    rms.push_back(band_rms(sounds[b], runs[b].mesh_frequency, edges, least));
    out << '\t' << runs[b].name << "_dB" << (b > 0 ? "\t" + runs[b].name + "_above_first_dB" : "");
  }
  double most = 0, at = 0;
  size_t of = 0;
  for (Index band = 0; band < count; ++band) {
    const double f = 0.5 * (edges[band] + edges[band + 1]);
    const bool heard = std::all_of(rms.begin(), rms.end(), [&](const VectorXd& r) { return r[band] > 0; });
    if (!heard) continue;
    out << '\n' << f;
    for (size_t b = 0; b < runs.size(); ++b) {
      const double above = level(rms[b][band], rms[0][band]);
      out << '\t' << level(rms[b][band], 1);
      if (b > 0) out << '\t' << above;
      if (std::abs(above) > std::abs(most)) most = above, at = f, of = b;
    }
  }
  out << '\n';
  if (of > 0)
    log_line("gear-sound: ", runs[of].name, " differs most from the first at a mesh frequency of ", at,
             " Hz, by ", most > 0 ? "+" : "", most, " dB");
  else if (runs.size() > 1)
    log_line("gear-sound: all run-ups have the level of the first");
  return out.str();
}

}  // namespace

Sounds sounds_of_motions(const std::vector<std::string>& paths, double frequency, const HeardForce& force,
                         const Transfer* transfer, double seconds) {
  Sounds out;
  std::vector<HeardMotion> branches;
  require_sound_inputs(paths);
  for (const std::string& path : paths) {
    branches.push_back(heard_motion(path, frequency, force));
    const HeardMotion& heard = branches.back();
    out.sounds.push_back(
        sound(heard.record, heard.fundamental, transfer, kSoundRate, std::lround(seconds * kSoundRate)));
  }
  std::vector<std::string*> names;
  names.reserve(branches.size());
  for (HeardMotion& branch : branches) names.push_back(&branch.name);
  number_names(names);
  for (size_t b = 0; b < branches.size(); ++b) require_heard(branches[b].name, out.sounds[b], out.rate);
  out.table = tones(branches, out.sounds, unit_of(transfer));
  return out;
}

Sounds sounds_of_runups(const std::vector<std::string>& paths, const HeardForce& force,
                        const Transfer* transfer) {
  Sounds out;
  std::vector<HeardRunup> runs;
  require_sound_inputs(paths);
  for (const std::string& path : paths) {
    runs.push_back(heard_runup(path, force));
    if (runs.back().rate != runs[0].rate)
      fail(Failure::input, path, ": has ", runs.back().rate, " samples a second, ", paths[0], " ",
           runs[0].rate);
    out.sounds.push_back(filtered(runs.back().record, runs.back().rate, transfer));
  }
  std::vector<std::string*> names;
  names.reserve(runs.size());
  for (HeardRunup& run : runs) names.push_back(&run.name);
  number_names(names);
  out.rate = runs[0].rate;
  for (size_t b = 0; b < runs.size(); ++b) require_heard(runs[b].name, out.sounds[b], out.rate);
  out.table = bands(runs, out.sounds, unit_of(transfer));
  return out;
}

}  // namespace whine
