#include "io/artifacts.h"

#include "io/runup_file.h"

#include "base/error.h"
#include "io/artifact_file.h"
#include "io/keys.h"
#include "io/system_motion_codec.h"

namespace whine {
namespace {

using namespace ranges;
using Eigen::Index;

void describe_head(Codec& c, RunupResult& a) {
  describe_source(c, a);
  if (!a.of_train()) {
    describe_bearing_dampers(c, a.mean_stiffness, a.bearing_damper);
    describe_natural_frequency(c, a.natural_frequency);
    c(a.pair, "/tooth_pair", "1", kPair, "tooth_pair",
      "number of the tooth pair: -1 following, 0 reference, +1 preceding");
  }
  const std::string at = "/parameters/operation/";
  c(a.input, at + "input", "", "body whose rotational speed ramp_rate is of");
  c(a.direction, at + "direction", "", "direction in which the speed goes");
  c(a.ramp.from, at + "ramp_from", "Hz", kSpeed, "", "mesh frequency at the start");
  c(a.ramp.to, at + "ramp_to", "Hz", kSpeed, "", "mesh frequency at the end");
  c(a.ramp.rate, at + "ramp_rate", "min-1 s-1", kSpeed, "",
    "change of the input's rotational speed with time");
  c(a.mesh_acceleration, at + "mesh_acceleration", "Hz s-1", {-1e12, 1e12}, "",
    "change of the mesh frequency with time");
  c(a.sample_rate, at + "sample_rate", "Hz", kSpeed, "", "samples in a second");
}

void describe_samples(Codec& c, const RunupResult& head, RunupSamples& a) {
  c(a.time, "/time", "s", kTime, "time", "time since the start of the ramp");
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, "time", "mesh frequency",
    "ramp_from + mesh_acceleration t");
  c(a.transmission_error, "/transmission_error", "m", kLength, "time mesh",
    "dynamic transmission error, up to 5/12 of the sample rate", "r1 theta1 + r2 theta2");
  c(a.mesh_force, "/mesh_force", "N", kForce, "time mesh",
    "normal force of all tooth pairs together, of trains torque on the driving body over its base radius, up to 5/12 of the sample rate: its low-pass filter may swing below 0");
  if (!head.of_train())
    c(a.tooth_load, "/tooth_load", "N", kForce, "time tooth_pair",
      "normal force of each tooth pair, filtered in the same way; left out of trains");
  a.bearing_force.resize(c.lists() ? 1 : head.body_names.size());
  for (size_t b = 0; b < a.bearing_force.size(); ++b)
    if (c.lists() || head.has_bearing(b))
      c(a.bearing_force[b], "/bearing_force/" + (c.lists() ? "<body>" : head.body_names[b]), "N", kForce,
        "time xy",
        "force of the body on its bearing or pin, as in the sweep; x, y: of a pair the driven gear stands above the driver, which turns counter-clockwise");
}

void describe_periods(Codec& c, RunupPeriods& a, bool& root_stress) {
  const std::string at = "/mesh_period/";
  const char* const axis = "mesh_period/time";
  const std::string of_mesh = "mesh_period/time mesh";
  c(a.time, at + "time", "s", kTime, axis, "time at which a mesh period begins");
  c(a.mesh_frequency, at + "mesh_frequency", "Hz", kSpeed, axis, "mesh frequency there");
  c(a.dte_rms, at + "dte_rms", "m", kSize, of_mesh,
    "RMS of the oscillating transmission error in the mesh period");
  c(a.dte_mean, at + "dte_mean", "m", kLength, of_mesh, "its mean");
  c(a.tooth_load_max, at + "tooth_load_max", "N", kForce, of_mesh,
    "largest load that a tooth pair sustains for 1/64 of the mesh period");
  c(a.separation_fraction, at + "separation_fraction", "1", kShare, of_mesh,
    "share of the time steps without contact");
  const std::string name = at + "root_stress_sustained";
  root_stress = c.optional(name, root_stress);
  if (root_stress)
    c(a.root_stress_sustained, name, "Pa", kStress, "mesh_period/time mesh side",
      "largest tangential stress along the roots beside the loaded flanks that is sustained for 1/64 of the mesh period, quasi-static in the tooth loads; 0 of a mesh of which it is not known");
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
  describe_samples(c, a, a.samples);
  describe_periods(c, a.periods, a.root_stress);
  if (c.in() && (a.samples.size() < 1 || a.periods.size() < 1))
    c.in()->reject(text("has ", a.samples.size(), " samples and ", a.periods.size(),
                        " mesh periods, at least one of each is wanted"));
  describe_tail(c, a);
}

std::string title(const RunupResult& a) {
  return text("Run-", a.direction, " at ", a.ramp.rate, " rpm/s",
              a.of_train()
                  ? text(" of a system: ", a.body_names.size(), " bodies, ", a.mesh_names.size(), " meshes")
                  : ": " + pair_title(a.mesh, a.torque));
}

template struct ArtifactFile<RunupResult>;

struct RunupFile::Open {
  Open(const std::string& path, const std::string& title, const Provenance& provenance)
      : out(ArtifactWriter::on_disk(path, kind_of<RunupResult>().name, kind_of<RunupResult>().version, title,
                                    provenance)),
        codec(out) {}
  ArtifactWriter out;
  Codec codec;
  RunupResult head;                          // without samples and periods
  Index samples = 0, periods = 0;            // that will come
  Index samples_here = 0, periods_here = 0;  // that have come
};

RunupFile::RunupFile(std::string path, Provenance provenance)
    : path_(std::move(path)), provenance_(std::move(provenance)) {}

RunupFile::~RunupFile() = default;

void RunupFile::begin(const RunupResult& head, Index samples, Index periods) {
  open_ = std::make_unique<Open>(path_, title(head), provenance_);
  Open& file = *open_;
  file.head = head;
  file.samples = samples;
  file.periods = periods;
  RunupResult a = head;
  describe_head(file.codec, a);
  const Index meshes = head.meshes();
  a.samples.transmission_error.resize(0, meshes);
  a.samples.mesh_force.resize(0, meshes);
  a.samples.tooth_load.resize(0, head.pair.size());
  a.samples.bearing_force.assign(head.body_names.size(), MatrixRM(0, 2));
  for (MatrixRM* x :
       {&a.periods.dte_rms, &a.periods.dte_mean, &a.periods.tooth_load_max, &a.periods.separation_fraction})
    x->resize(0, meshes);
  a.periods.root_stress_sustained.resize(0, kSides * meshes);
  file.codec.record(Codec::Record::reserve, samples);
  describe_samples(file.codec, a, a.samples);
  file.codec.record(Codec::Record::reserve, periods);
  describe_periods(file.codec, a.periods, file.head.root_stress);
}

void RunupFile::take(const RunupSamples& samples) {
  open_->codec.record(Codec::Record::append, open_->samples_here);
  describe_samples(open_->codec, open_->head,
                   const_cast<RunupSamples&>(samples));  // a writer changes no member
  open_->samples_here += samples.size();
}

void RunupFile::take(const RunupPeriods& periods) {
  open_->codec.record(Codec::Record::append, open_->periods_here);
  describe_periods(open_->codec, const_cast<RunupPeriods&>(periods), open_->head.root_stress);
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