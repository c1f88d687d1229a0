#include "io/runup_codec.h"

#include "base/error.h"
#include "io/codec.h"

namespace whine {
namespace {

using namespace ranges;
using Eigen::Index;

constexpr Schema kRunupSchema{"runup", 3};

void describe_head(Codec& c, RunupResult& a) {
  describe_pair(c, a);
  describe_motion(c, a);
  describe_bearing_dampers(c, a.mean_stiffness, a.bearing_damper);
  describe_torque(c, a.torque);
  const std::string at = "/parameters/operation/";
  c.choice({at + "direction", "1", "direction in which the speed goes", ""}, a.direction);
  c.dataset({at + "ramp_from", "Hz", "mesh frequency at the start", "", kSpeed}, &a.ramp.from);
  c.dataset({at + "ramp_to", "Hz", "mesh frequency at the end", "", kSpeed}, &a.ramp.to);
  c.dataset({at + "ramp_rate", "min-1 s-1", "change of the driver's rotational speed with time", "", kSpeed},
            &a.ramp.rate);
  c.dataset({at + "mesh_acceleration", "Hz s-1", "change of the mesh frequency with time", "", {-1e12, 1e12}},
            &a.mesh_acceleration);
  c.dataset({at + "sample_rate", "Hz", "samples in a second", "", kSpeed}, &a.sample_rate);
  describe_natural_frequency(c, a.natural_frequency);
  c.dataset(
      {"/pair", "1", "number of the tooth pair: -1 following, 0 reference, +1 preceding", "pair", kPair},
      &a.pair);
}

void describe_samples(Codec& c, const GearMeshSpec& mesh, RunupSamples& a) {
  c.dataset({"/time", "s", "time since the start of the ramp", "time", kTime}, &a.time);
  c.dataset({"/mesh_frequency", "Hz", "mesh frequency", "time", kSpeed, "ramp_from + mesh_acceleration t"},
            &a.mesh_frequency);
  c.dataset({"/transmission_error", "m", "dynamic transmission error, up to 5/12 of the sample rate", "time",
             kLength, "r1 theta1 + r2 theta2"},
            &a.transmission_error);
  c.dataset(
      {"/mesh_force", "N",
       "normal force of all tooth pairs together, up to 5/12 of the sample rate: its low-pass filter may swing below 0",
       "time", kForce},
      &a.mesh_force);
  c.dataset(
      {"/tooth_load", "N", "normal force of each tooth pair, filtered in the same way", "time pair", kForce},
      &a.tooth_load);
  for (int g = 0; g < (c.lists() ? 1 : kSides); ++g)
    if (const auto side = static_cast<size_t>(g); c.lists() || mesh.bearing[side].elastic())
      c.dataset(
          {of_body(c, mesh, g, "bearing_force"), "N",
           "force of the gear on its bearing; x, y: the driven gear stands above the driver, which turns counter-clockwise",
           "time xy", kForce},
          &a.bearing_force[side]);
}

void describe_periods(Codec& c, const GearMeshSpec& mesh, RunupPeriods& a, bool& root_stress) {
  const std::string at = "/mesh_period/";
  const char* const axis = "mesh_period/time";
  c.dataset({at + "time", "s", "time at which a mesh period begins", axis, kTime}, &a.time);
  c.dataset({at + "mesh_frequency", "Hz", "mesh frequency there", axis, kSpeed}, &a.mesh_frequency);
  c.dataset(
      {at + "dte_rms", "m", "RMS of the oscillating transmission error in the mesh period", axis, kSize},
      &a.dte_rms);
  c.dataset({at + "dte_mean", "m", "its mean", axis, kLength}, &a.dte_mean);
  c.dataset({at + "tooth_load_max", "N",
             "largest load that a tooth pair sustains for 1/64 of the mesh period", axis, kForce},
            &a.tooth_load_max);
  c.dataset({at + "separation_fraction", "1", "share of the time steps without contact", axis, kShare},
            &a.separation_fraction);
  const auto name = [&](int g) { return at + of_body(c, mesh, g, "root_stress_sustained").substr(1); };
  root_stress = c.optional(name(0), root_stress);
  for (int g = 0; root_stress && g < (c.lists() ? 1 : kSides); ++g)
    c.dataset(
        {name(g), "Pa",
         "largest tangential stress along the roots beside the loaded flanks that is sustained for 1/64 of the mesh period, quasi-static in the tooth loads",
         axis, kStress},
        &a.root_stress_sustained[static_cast<size_t>(g)]);
}

void describe_tail(Codec& c, RunupResult& a) {
  describe_certificate(c, a.least_gap, a.least_force, a.fallbacks);
  c.dataset({"/drift_force", "N", "largest force that the output must supply to hold the speed", "", kForce},
            &a.drift_force);
  describe_backlash(c, a.backlash_margin);
}

}  // namespace

void describe(Codec& c, RunupResult& a) {
  describe_head(c, a);
  describe_samples(c, a.mesh, a.samples);
  describe_periods(c, a.mesh, a.periods, a.root_stress);
  if (c.in() && (a.samples.size() < 1 || a.periods.size() < 1))
    c.in()->file().reject(text("has ", a.samples.size(), " samples and ", a.periods.size(),
                               " mesh periods, at least one of each is wanted"));
  describe_tail(c, a);
}

struct RunupFile::Open {
  Open(const std::string& path, const std::string& title, const Provenance& provenance)
      : out(ArtifactWriter::on_disk(path, kRunupSchema.kind, kRunupSchema.version, title, provenance)),
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
  open_ = std::make_unique<Open>(
      path_,
      text("Run-", head.direction, " at ", head.ramp.rate, " rpm/s: ", pair_title(head.mesh, head.torque)),
      provenance_);
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

RunupResult read_runup(const std::string& path) {
  return read_artifact<RunupResult>(path, kRunupSchema);
}

}  // namespace whine
