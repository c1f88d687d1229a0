#include "io/artifacts.h"

#include "io/runup_file.h"

#include "base/error.h"
#include "io/artifact_file.h"

namespace whine {
namespace {

using namespace ranges;
using Eigen::Index;

void describe_head(Codec& c, RunupResult& a) {
  describe_pair(c, a);
  describe_motion(c, a);
  describe_bearing_dampers(c, a.mean_stiffness, a.bearing_damper);
  describe_torque(c, a.torque);
  const std::string at = "/parameters/operation/";
  c(a.direction, at + "direction", "", "direction in which the speed goes");
  c(a.ramp.from, at + "ramp_from", "Hz", kSpeed, "", "mesh frequency at the start");
  c(a.ramp.to, at + "ramp_to", "Hz", kSpeed, "", "mesh frequency at the end");
  c(a.ramp.rate, at + "ramp_rate", "min-1 s-1", kSpeed, "",
    "change of the driver's rotational speed with time");
  c(a.mesh_acceleration, at + "mesh_acceleration", "Hz s-1", {-1e12, 1e12}, "",
    "change of the mesh frequency with time");
  c(a.sample_rate, at + "sample_rate", "Hz", kSpeed, "", "samples in a second");
  describe_natural_frequency(c, a.natural_frequency);
  c(a.pair, "/pair", "1", kPair, "pair", "number of the tooth pair: -1 following, 0 reference, +1 preceding");
}

void describe_samples(Codec& c, const GearMeshSpec& mesh, RunupSamples& a) {
  c(a.time, "/time", "s", kTime, "time", "time since the start of the ramp");
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, "time", "mesh frequency",
    "ramp_from + mesh_acceleration t");
  c(a.transmission_error, "/transmission_error", "m", kLength, "time",
    "dynamic transmission error, up to 5/12 of the sample rate", "r1 theta1 + r2 theta2");
  c(a.mesh_force, "/mesh_force", "N", kForce, "time",
    "normal force of all tooth pairs together, up to 5/12 of the sample rate: its low-pass filter may swing below 0");
  c(a.tooth_load, "/tooth_load", "N", kForce, "time pair",
    "normal force of each tooth pair, filtered in the same way");
  for (int g = 0; g < (c.lists() ? 1 : kSides); ++g)
    if (const auto side = static_cast<size_t>(g); c.lists() || mesh.bearing[side].elastic())
      c(a.bearing_force[side], of_body(c, mesh, g, "bearing_force"), "N", kForce, "time xy",
        "force of the gear on its bearing; x, y: the driven gear stands above the driver, which turns counter-clockwise");
}

void describe_periods(Codec& c, const GearMeshSpec& mesh, RunupPeriods& a, bool& root_stress) {
  const std::string at = "/mesh_period/";
  const char* const axis = "mesh_period/time";
  c(a.time, at + "time", "s", kTime, axis, "time at which a mesh period begins");
  c(a.mesh_frequency, at + "mesh_frequency", "Hz", kSpeed, axis, "mesh frequency there");
  c(a.dte_rms, at + "dte_rms", "m", kSize, axis,
    "RMS of the oscillating transmission error in the mesh period");
  c(a.dte_mean, at + "dte_mean", "m", kLength, axis, "its mean");
  c(a.tooth_load_max, at + "tooth_load_max", "N", kForce, axis,
    "largest load that a tooth pair sustains for 1/64 of the mesh period");
  c(a.separation_fraction, at + "separation_fraction", "1", kShare, axis,
    "share of the time steps without contact");
  const auto name = [&](int g) { return at + of_body(c, mesh, g, "root_stress_sustained").substr(1); };
  root_stress = c.optional(name(0), root_stress);
  for (int g = 0; root_stress && g < (c.lists() ? 1 : kSides); ++g)
    c(a.root_stress_sustained[static_cast<size_t>(g)], name(g), "Pa", kStress, axis,
      "largest tangential stress along the roots beside the loaded flanks that is sustained for 1/64 of the mesh period, quasi-static in the tooth loads");
}

void describe_tail(Codec& c, RunupResult& a) {
  describe_certificate(c, a.least_gap, a.least_force, a.fallbacks);
  c(a.drift_force, "/drift_force", "N", kForce, "",
    "largest force that the output must supply to hold the speed");
  describe_backlash(c, a.backlash_margin);
}

}  // namespace

void describe(Codec& c, RunupResult& a) {
  describe_head(c, a);
  describe_samples(c, a.mesh, a.samples);
  describe_periods(c, a.mesh, a.periods, a.root_stress);
  if (c.in() && (a.samples.size() < 1 || a.periods.size() < 1))
    c.in()->reject(text("has ", a.samples.size(), " samples and ", a.periods.size(),
                        " mesh periods, at least one of each is wanted"));
  describe_tail(c, a);
}

std::string title(const RunupResult& a) {
  return text("Run-", a.direction, " at ", a.ramp.rate, " rpm/s: ", pair_title(a.mesh, a.torque));
}

template struct ArtifactFile<RunupResult>;

struct RunupFile::Open {
  Open(const std::string& path, const std::string& title, const Provenance& provenance)
      : out(ArtifactWriter::on_disk(path, kind_of<RunupResult>().name, kind_of<RunupResult>().version, title,
                                    provenance)),
        codec(out) {}
  ArtifactWriter out;
  Codec codec;
  GearMeshSpec mesh;
  bool root_stress = false;
  Index samples = 0, periods = 0;            // that will come
  Index samples_here = 0, periods_here = 0;  // that have come
};

RunupFile::RunupFile(std::string path, Provenance provenance)
    : path_(std::move(path)), provenance_(std::move(provenance)) {}

RunupFile::~RunupFile() = default;

void RunupFile::begin(const RunupResult& head, Index samples, Index periods) {
  open_ = std::make_unique<Open>(path_, title(head), provenance_);
  Open& file = *open_;
  file.mesh = head.mesh;
  file.samples = samples;
  file.periods = periods;
  RunupResult a = head;
  describe_head(file.codec, a);
  a.samples.tooth_load.resize(0, head.pair.size());
  for (MatrixRM& force : a.samples.bearing_force) force.resize(0, 2);
  file.codec.record(Codec::Record::reserve, samples);
  describe_samples(file.codec, a.mesh, a.samples);
  file.codec.record(Codec::Record::reserve, periods);
  describe_periods(file.codec, a.mesh, a.periods, file.root_stress = a.root_stress);
}

void RunupFile::take(const RunupSamples& samples) {
  open_->codec.record(Codec::Record::append, open_->samples_here);
  describe_samples(open_->codec, open_->mesh,
                   const_cast<RunupSamples&>(samples));  // a writer changes no member
  open_->samples_here += samples.size();
}

void RunupFile::take(const RunupPeriods& periods) {
  open_->codec.record(Codec::Record::append, open_->periods_here);
  describe_periods(open_->codec, open_->mesh, const_cast<RunupPeriods&>(periods), open_->root_stress);
  open_->periods_here += periods.size();
}

void RunupFile::end(const RunupResult& tail) {
  if (open_->samples_here != open_->samples || open_->periods_here != open_->periods)
    fail(Failure::numerical, "the run-up ended after ", open_->samples_here, " of ", open_->samples,
         " samples and ", open_->periods_here, " of ", open_->periods, " mesh periods");
  open_->codec.record(Codec::Record::none);
  describe_tail(open_->codec, const_cast<RunupResult&>(tail));
  open_->out.publish();
  open_.reset();
}

}  // namespace whine