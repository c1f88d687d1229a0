// Sound: the Fourier series against closed forms, transfer functions, levels, the WAV file as another library reads it.
#include <doctest/doctest.h>
#include <sndfile.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

#include "base/error.h"
#include "gear/train.h"
#include "io/artifacts.h"
#include "io/runup_file.h"
#include "io/transfer_function.h"
#include "io/wav.h"
#include "own_folder.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "report/sounds.h"
#include "signal/sound.h"
#include "signal/spectrum.h"
#include "studies/runup.h"

using namespace whine;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

class Temporary : public TemporaryFolder {
 public:
  explicit Temporary(const std::string& bytes) : path_(file("sound", bytes)) {}
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

double rms(const VectorXd& y) {
  return std::sqrt(y.squaredNorm() / static_cast<double>(y.size()));
}

}  // namespace

TEST_CASE("sound: three cosines of a record are three cosines at the rate of the sound") {
  constexpr int n = 256;
  constexpr double f = 1234.5, rate = 48000;
  const auto force = [](double turns) {
    return 700 + 30 * std::cos(kTwoPi * turns + 0.3) + 5 * std::cos(2 * kTwoPi * turns - 1) +
           std::cos(3 * kTwoPi * turns);
  };
  VectorXd record(n);
  for (int j = 0; j < n; ++j) record[j] = force(j / static_cast<double>(n));
  const VectorXd y = sound(record, f, nullptr, rate, 4800);
  for (int j = 0; j < y.size(); ++j) CHECK(std::abs(y[j] - (force(f * j / rate) - 700)) < 1e-8);
  // A gain of 2 and a delay of 1 ms
  constexpr double delay = 1e-3;
  TransferFunction late{VectorXd::LinSpaced(2001, 0, 10000), VectorXd::Constant(2001, 2), VectorXd(2001)};
  late.phase = -kTwoPi * delay * late.frequency;
  const VectorXd z = sound(record, f, std::make_unique<Transfer>(late).get(), rate, 4800);
  for (int j = 0; j < z.size(); ++j) CHECK(std::abs(z[j] - 2 * (force(f * (j / rate - delay)) - 700)) < 1e-6);
}

TEST_CASE(
    "sound: nothing is folded back from above half the rate, and nothing comes from outside the transfer function") {
  VectorXd record(64);
  for (int j = 0; j < 64; ++j) record[j] = std::cos(kTwoPi * 3 * j / 64.0);
  CHECK(sound(record, 9000, nullptr, 48000, 480).cwiseAbs().maxCoeff() < 1e-12);  // 27 kHz
  CHECK(rms(sound(record, 7000, nullptr, 48000, 48000)) == relative(std::sqrt(0.5), 1e-9));
  const Transfer narrow({VectorXd::LinSpaced(2, 100, 200), VectorXd::Ones(2), VectorXd::Zero(2)});
  CHECK(sound(record, 1000, &narrow, 48000, 480).cwiseAbs().maxCoeff() == 0);
  CHECK(level(10, 1) == relative(20, 1e-14));
  CHECK(std::isinf(level(0, 1)));
}

TEST_CASE("sound: a phase meter's jumps are undone") {
  // A delay of 1 ms, measured modulo a turn every 300 Hz
  TransferFunction rows{VectorXd::LinSpaced(11, 0, 3000), VectorXd::Ones(11), VectorXd(11)};
  for (int i = 0; i < 11; ++i) rows.phase[i] = std::remainder(-kTwoPi * 1e-3 * rows.frequency[i], kTwoPi);
  const Transfer transfer(rows);
  for (double f : {150.0, 450.0, 1350.0, 2999.0})
    CHECK(std::abs(transfer.at(f) - std::polar(1.0, -kTwoPi * 1e-3 * f)) < 1e-9);
}

TEST_CASE("sound: transfer functions from files, and what is wrong with them") {
  const Temporary good("# hammer test\nmagnitude, frequency_Hz, phase_deg\n0.5, 100, 90\n1.5, 300, 180\r\n");
  const TransferFunction rows = read_transfer_function(good.path());
  CHECK(rows.frequency[1] == 300);
  CHECK(rows.magnitude[0] == 0.5);
  CHECK(rows.phase[1] == relative(std::numbers::pi, 1e-14));
  CHECK(std::abs(Transfer(rows).at(200) - std::polar(1.0, 0.75 * std::numbers::pi)) < 1e-12);
  // As spreadsheets and analysers write: a byte order mark, a sign in front, lines that end in CR LF.
  const Temporary marked(
      "\xef\xbb\xbf"
      "frequency_Hz, magnitude, phase_deg\r\n+100, +5e-1, -90\r\n3e+2, 1.5, +180\r\n");
  const TransferFunction of_marked = read_transfer_function(marked.path());
  CHECK(of_marked.frequency[0] == 100);
  CHECK(of_marked.frequency[1] == 300);
  CHECK(of_marked.magnitude[0] == 0.5);
  CHECK(of_marked.phase[0] == relative(-std::numbers::pi / 2, 1e-14));
  CHECK(of_marked.phase[1] == relative(std::numbers::pi, 1e-14));
  for (const char* bad : {"", "frequency_Hz, magnitude\n1, 2\n", "frequency_Hz, magnitude, phase\n1, 2, 3\n",
                          "frequency_Hz, magnitude, phase_deg\n1, 2, 3\n",
                          "frequency_Hz, magnitude, phase_deg\n2, 1, 0\n1, 1, 0\n",
                          "frequency_Hz, magnitude, phase_deg\n1, x, 0\n2, 1, 0\n",
                          "frequency_Hz, magnitude, phase_deg\n1, -1, 0\n2, 1, 0\n",
                          "frequency_Hz, magnitude, phase_deg\n1, 1, inf\n2, 1, 0\n",
                          "frequency_Hz, magnitude, phase_deg\n1, 1, 1e300\n2, 1, -1e300\n",
                          "frequency_Hz, magnitude, phase_deg\n1, 1e300, 0\n2, 1, 0\n",
                          "frequency_Hz, magnitude, phase_deg\n-1, 1, 0\n2, 1, 0\n",
                          "frequency_Hz, magnitude, phase_deg\n1, 1, 0,\n2, 1, 0\n",
                          "frequency_Hz, magnitude, phase_deg,\n1, 1, 0\n2, 1, 0\n",
                          "frequency_Hz, magnitude, phase_deg\n1, 1,\n2, 1, 0\n",
                          "frequency_Hz, magnitude, phase_deg\n1, 1, +-5\n2, 1, 0\n",
                          "frequency_Hz, magnitude, phase_deg\n1, 1, +\n2, 1, 0\n",
                          "frequency_Hz, magnitude, phase_deg\n1, 1, ++5\n2, 1, 0\n"}) {
    CAPTURE(bad);
    const Temporary file(bad);
    CHECK(failure_of([&] { read_transfer_function(file.path()); }) == Failure::input);
  }
  CHECK(failure_of([&] {
          Transfer({VectorXd::Ones(2), VectorXd::Ones(2), VectorXd::Zero(2)});
        }) == Failure::input);
}

TEST_CASE("sound: a WAV file holds the samples to its last bit, and the same bytes twice") {
  VectorXd y(1000);
  for (int j = 0; j < 1000; ++j) y[j] = 0.9 * std::sin(0.1 * j);
  const std::string bytes = wav_bytes(y, 48000);
  CHECK(bytes == wav_bytes(y, 48000));
  CHECK(bytes.size() == 44 + 3 * 1000);
  const Temporary file(bytes);
  SF_INFO info{};
  SNDFILE* in = sf_open(file.path().c_str(), SFM_READ, &info);
  REQUIRE(in != nullptr);
  CHECK(info.samplerate == 48000);
  CHECK(info.channels == 1);
  CHECK(info.format == (SF_FORMAT_WAV | SF_FORMAT_PCM_24));
  VectorXd back(1000);
  CHECK(sf_read_double(in, back.data(), 1000) == 1000);
  sf_close(in);
  // Rounding is half of a bit; written with 2^23 - 1 steps to the full scale, read with 2^23.
  CHECK((back - y).cwiseAbs().maxCoeff() <= 1.5 / (1 << 23));
  y[3] = 1.2;
  CHECK(failure_of([&] { wav_bytes(y, 48000); }) == Failure::input);
}

TEST_CASE("sound of a run-up: a tone behind a transfer function has its gain and delay, whatever its speed") {
  constexpr double kRate = 48000;
  constexpr int kSamples = 24000, kDelay = 120;
  // A chirp of known amplitude from 400 to 1600 Hz; a transfer function of gain 3 that delays by 120 samples.
  VectorXd record(kSamples);
  const auto phase = [&](double t) { return kTwoPi * (400 * t + 1200 * t * t); };
  for (int n = 0; n < kSamples; ++n) record[n] = 7 + 2 * std::cos(phase(n / kRate));
  constexpr int kRows = 481;
  TransferFunction rows;
  rows.frequency = VectorXd::LinSpaced(kRows, 0, 24000);
  rows.magnitude = VectorXd::Constant(kRows, 3);
  rows.phase = -kTwoPi * kDelay / kRate * rows.frequency;
  const Transfer transfer(rows);
  const VectorXd heard = filtered(record, kRate, &transfer);
  REQUIRE(heard.size() == kSamples);
  double worst = 0;
  for (int n = kDelay; n < kSamples; ++n)
    worst = std::max(worst, std::abs(heard[n] - 3 * (record[n - kDelay] - record.mean())));
  CHECK(worst < 1e-9);
  CHECK(heard.head(kDelay).cwiseAbs().maxCoeff() < 1e-9);  // nothing comes back round
  CHECK(
      (filtered(record, kRate, nullptr) - (record.array() - record.mean()).matrix()).cwiseAbs().maxCoeff() ==
      0);
  CHECK(failure_of([&] { filtered(VectorXd::Ones(1), kRate, nullptr); }) == Failure::input);

  // Levels in bands of the speed: that of the tone in each, and the factor 3 everywhere.
  const VectorXd speed =
      VectorXd::NullaryExpr(kSamples, [&](Index n) { return 400 + 2400 * static_cast<double>(n) / kRate; });
  const VectorXd edges = VectorXd::LinSpaced(5, 400, 1600);
  const VectorXd before = band_rms(filtered(record, kRate, nullptr), speed, edges, 100);
  for (const double rms : before) CHECK(rms == relative(std::sqrt(2.0), 0.02));
  CHECK(level(band_rms(3 * record, speed, edges, 100)[2], band_rms(record, speed, edges, 100)[2]) ==
        relative(20 * std::log10(3.0), 1e-12));
  CHECK(std::isnan(band_rms(record, speed, VectorXd::LinSpaced(3, 4000, 5000), 1)[0]));
}

TEST_CASE("sound of a run-up in a WAV file: RMS, peak and spectrum are those of the force") {
  constexpr int kRate = 48000, kSamples = 48000;
  VectorXd force(kSamples);
  for (int n = 0; n < kSamples; ++n)
    force[n] = 5000 + 300 * std::sin(kTwoPi * 1000 * n / kRate) + 40 * std::cos(kTwoPi * 2000 * n / kRate);
  constexpr double kFullScale = 500;  // N
  const Temporary file(wav_bytes(filtered(force, kRate, nullptr) / kFullScale, kRate));
  SF_INFO info{};
  SNDFILE* in = sf_open(file.path().c_str(), SFM_READ, &info);
  REQUIRE(in != nullptr);
  VectorXd back(kSamples);
  CHECK(sf_read_double(in, back.data(), kSamples) == kSamples);
  sf_close(in);
  back *= kFullScale;
  CHECK(std::sqrt(back.squaredNorm() / kSamples) == relative(std::hypot(300, 40) / std::sqrt(2.0), 1e-6));
  CHECK(back.maxCoeff() == relative(260, 1e-6));
  CHECK(back.minCoeff() == relative(-340, 1e-6));
  const Harmonics spectrum = harmonics(back, 2500);
  CHECK(spectrum.amplitude[999] == relative(300, 1e-6));
  CHECK(spectrum.amplitude[1999] == relative(40, 1e-6));
  CHECK(spectrum.amplitude.head(999).maxCoeff() < 1e-4);
}

namespace {

constexpr double kFrom = 1000, kTo = 1400;  // Hz

// A run-up whose mesh force is a cosine of the mesh phase above a mean.
RunupResult some_runup(double seconds, double amplitude, Direction direction = Direction::up) {
  RunupResult a;
  for (auto& gear : a.gear) {
    gear.design = paper_gear(50);
    gear.material = {206e9, 0.3, 7850, true};
    gear.discretisation = {0.8e-3, 1, 8};
  }
  a.mesh = {"pinion", "wheel", 0.15, {false, std::numeric_limits<double>::infinity()}};
  a.contact = {16, 64};
  a.time = {64, 250e3, 1e-6};
  a.damping = {0, 7.7e-6, 0.5e-3, 0};
  a.inertia[0] = a.inertia[1] = 0.0148;
  a.torque = 150;
  a.mean_stiffness = 4e8;
  a.bearing_damper = {1, 1};
  a.natural_frequency = 2900;
  a.direction = direction;
  const bool up = direction == Direction::up;
  a.ramp = {up ? kFrom : kTo, up ? kTo : kFrom, (kTo - kFrom) / seconds * 60 / 50};
  a.mesh_acceleration = (a.ramp.to - a.ramp.from) / seconds;
  a.sample_rate = 48000;
  a.pair = Eigen::VectorXi{{0}};
  a.place_pair(pair_system(a));
  a.input = "pinion";
  const auto n = static_cast<Index>(std::lround(seconds * a.sample_rate));
  RunupSamples& s = a.samples;
  s.time = VectorXd::NullaryExpr(n, [&](Index i) { return static_cast<double>(i) / a.sample_rate; });
  s.mesh_frequency = a.ramp.from + a.mesh_acceleration * s.time.array();
  s.mesh_force =
      s.time.unaryExpr([&](double t) { return 2000 + amplitude * std::cos(kTwoPi * a.mesh_phase(t)); });
  s.transmission_error = MatrixRM::Zero(n, 1);
  s.tooth_load = MatrixRM::Zero(n, 1);
  RunupPeriods& p = a.periods;
  p.time = VectorXd{{0}};
  p.mesh_frequency = VectorXd{{a.ramp.from}};
  p.dte_rms = p.dte_mean = p.separation_fraction = MatrixRM{{0}};
  p.tooth_load_max = MatrixRM{{2000}};
  a.backlash_margin = std::numeric_limits<double>::infinity();
  return a;
}

std::string written(const Temporary& at, const RunupResult& a) {
  RunupFile file(at.path(), Provenance{"gear-test", "gear-test --output x.h5", {}});
  file.begin(a, a.samples.size(), a.periods.size());
  file.take(a.samples);
  file.take(a.periods);
  file.end(a);
  return at.path();
}

std::vector<std::vector<std::string>> lines_of(const std::string& table) {
  std::vector<std::vector<std::string>> out;
  std::istringstream in(table);
  for (std::string line, cell; std::getline(in, line);) {
    std::istringstream cells(line);
    out.emplace_back();
    while (std::getline(cells, cell, '\t')) out.back().push_back(cell);
  }
  return out;
}

}  // namespace

TEST_CASE(
    "sounds of run-ups: levels in bands of two of known amplitude, up and down; short ones have fewer bands") {
  const Temporary quiet(""), loud(""), brief(""), tiny("");
  // 0.1 of the force of the first: -20 dB in every band, whatever the direction.
  const std::string first = written(loud, some_runup(1, 100)),
                    second = written(quiet, some_runup(1, 10, Direction::down));
  const Sounds both = sounds_of_runups({first, second}, {}, nullptr);
  CHECK(both.rate == 48000);
  const auto lines = lines_of(both.table);
  REQUIRE(lines.size() == 102);
  CHECK(lines[1] == std::vector<std::string>{"mesh_frequency_Hz", "up_dB", "down_dB", "down_above_first_dB"});
  for (size_t i = 2; i < lines.size(); ++i) {
    CHECK(std::stod(lines[i][0]) == relative(kFrom + (i - 1.5) * (kTo - kFrom) / 100, 1e-3));
    // A band has ten periods, and a share of one.
    CHECK(std::abs(std::stod(lines[i][1]) - 20 * std::log10(100 / std::sqrt(2))) < 0.5);
    CHECK(std::abs(std::stod(lines[i][3]) + 20) < 0.5);
  }

  const std::string short_one = written(brief, some_runup(0.05, 100));
  const auto few = lines_of(sounds_of_runups({short_one}, {}, nullptr).table);
  CHECK(few.size() == 2 + 25);  // 2 ms each
  const std::string too_short = written(tiny, some_runup(1.5e-3, 100));
  CHECK(names(message_of_input([&] { sounds_of_runups({first, too_short}, {}, nullptr); }), {2, "least"}));
}

TEST_CASE("sounds of run-ups: none in common, other rates and silence are rejected by name") {
  const Temporary one(""), other("");
  const std::string first = written(one, some_runup(0.1, 100));
  const auto said = [&](const auto& change) {
    RunupResult a = some_runup(0.1, 100);
    change(a);
    const std::string path = written(other, a);
    return message_of([&] { sounds_of_runups({first, path}, {}, nullptr); });
  };
  CHECK(names(said([](RunupResult&) {}), {"already", "heard"}));
  CHECK(
      names(said([](RunupResult& a) { a.samples.mesh_frequency.array() += 1000; }), {"frequency", "common"}));
  CHECK(names(said([](RunupResult& a) { a.sample_rate = 44100; }), {44100, "samples"}));
  CHECK(names(said([](RunupResult& a) { a.sample_rate = 44100.5; }), {"number", "sound"}));
  CHECK(names(said([](RunupResult& a) { a.samples.mesh_force.setConstant(2000); }), {"up_2"}));
  VectorXd broken = VectorXd::Ones(10);
  broken[7] = std::numeric_limits<double>::infinity();
  CHECK(names(message_of([&] { filtered(broken, 48000, nullptr); }), {7, 10, "inf"}));
}
