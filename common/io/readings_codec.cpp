#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"

namespace whine {
namespace {

using namespace ranges;

// Every number of a reading, once: what is written and what is read walk this list.
struct NumberOf {
  const char *name, *units, *meaning;
  Range range;
  double (*get)(const Reading&);
  void (*set)(Reading&, double);
};

#define WHINE_NUMBER(name, units, meaning, member, ...)                                     \
  {                                                                                         \
    name, units, meaning, __VA_ARGS__, [](const Reading& r) -> double { return r.member; }, \
        [](Reading& r, double v) { r.member = static_cast<decltype(r.member)>(v); }         \
  }

const std::vector<NumberOf>& reading_numbers() {
  static const std::vector<NumberOf> numbers{
      WHINE_NUMBER("dedendum", "1", "dedendum in modules", choices.dedendum, Range{1, 2}),
      WHINE_NUMBER("rack_tip_share", "1", "tip radius of the rack over the largest that its tooth holds",
                   choices.rack_tip_share, Range{kShare}),
      WHINE_NUMBER("rack_tip_radius", "1", "tip radius of the rack in modules", rack_tip_radius,
                   Range{kShare}),
      WHINE_NUMBER("tooth_thinning", "m", "arc taken off the tooth at the pitch circle",
                   choices.tooth_thinning, Range{kSize}),
      WHINE_NUMBER("frequency_offset", "1", "of the frequency that the inertia is fitted to",
                   choices.frequency_offset, Range{-1, 1}),
      WHINE_NUMBER("mass_share", "1", "share of the damping ratio from mu of Eq. 21", choices.mass_share,
                   Range{kShare}),
      WHINE_NUMBER("undamped_depth", "m", "depth above which the half-plane is undamped",
                   choices.undamped_depth, Range{kSize}),
      WHINE_NUMBER("steps_per_period", "1", "time steps per mesh period, before doubling",
                   choices.steps_per_period, Range{16, 4096}),
      WHINE_NUMBER("bore_radius", "m", "bore, fitted to the mean mesh stiffness", bore_radius, Range{kSize}),
      WHINE_NUMBER("total_inertia", "kg m2", "inertia of each gear, fitted", total_inertia, Range{kMass}),
      WHINE_NUMBER("rayleigh_mass", "s-1", "mu of Eq. 21, fitted", rayleigh_mass, Range{kPositive}),
      WHINE_NUMBER("rayleigh_stiffness", "s", "eta of Eq. 21, fitted", rayleigh_stiffness, Range{kTime}),
      WHINE_NUMBER("level_ratio", "1", "mesh stiffness with two pairs over that with one, 100 N m",
                   level_ratio, Range{kPositive}),
      WHINE_NUMBER("first_harmonic", "1", "first harmonic of the mesh stiffness over its mean, 150 N m",
                   first_harmonic, Range{kPositive}),
      WHINE_NUMBER("jump_up", "Hz", "highest jump of the rising sweep near f_n, 150 N m; 0: none", jump_up,
                   Range{kFrequency}),
      WHINE_NUMBER("jump_down", "Hz", "highest jump of the falling sweep near f_n, 150 N m; 0: none",
                   jump_down, Range{kFrequency}),
      {"corner_angle", "rad", "largest angle of corner contact; 0: none, pi: any", Range{0, 3.2},
       [](const Reading& r) { return angle_of(r.choices.corner); },
       [](Reading& r, double v) { r.choices.corner = corner_of(v); }}};
  return numbers;
}
#undef WHINE_NUMBER

struct WordOf {
  const char *name, *meaning;
  std::string OpenChoices::*member;
};
constexpr WordOf kWords[] = {
    {"plane", "plane state of the bodies: stress or strain", &OpenChoices::plane},
    {"inertia_from",
     "what the inertia is fitted to: Table 1 at 100 N m (one, two, mean), all of it (table), or 1.4 kg (mass)",
     &OpenChoices::inertia_from},
    {"damped_state", "contact state with a damping ratio of 7 %", &OpenChoices::damped_state}};

// (reading, claim): what each reading says of each claim.
void describe_claims(Codec& c, ReadingsResult& a) {
  const auto count = static_cast<Eigen::Index>(a.readings.size()),
             claims = static_cast<Eigen::Index>(a.claim.size());
  MatrixRM value;
  MatrixRMi verdict, exists;
  if (c.out()) {
    value.resize(count, claims);
    verdict.resize(count, claims);
    exists.resize(count, claims);
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index j = 0; j < claims; ++j) {
        value(i, j) = a.readings[i].value.at(j);
        verdict(i, j) = a.readings[i].verdict.at(j);
        exists(i, j) = a.readings[i].exists.at(j);
      }
  }
  const char* const axes = "draw claim";
  c(value, "/value", "1", kQuantity, axes,
    "what the claim is about, in the claim's unit; 0 where it does not exist");
  c(exists, "/exists", "1", kFlag, axes, "0: the state that the claim is about does not exist");
  c(verdict, "/verdict", "1", {0, 5}, axes,
    "0 agrees, 1 differs, 2 given, 3 fitted, 4 cannot be compared, 5 misprint");
  if (!c.in()) return;
  a.readings.resize(value.rows());
  for (Eigen::Index i = 0; i < value.rows(); ++i)
    for (Eigen::Index j = 0; j < claims; ++j) {
      a.readings[i].value.push_back(value(i, j));
      a.readings[i].verdict.push_back(verdict(i, j));
      a.readings[i].exists.push_back(exists(i, j));
    }
}

}  // namespace

void describe(Codec& c, ReadingsResult& a) {
  const std::string at = "/parameters/readings/";
  c(a.title, at + "title", "", "what the search is");
  c(a.contact, at + "contact", "", "model level of contact in the sweeps");
  c(a.outside, at + "outside", "1", kNumber, "",
    "readings left out because the model of the pair cannot compute them");
  c(a.claim, "/claim", "claim", "names of the claims");
  describe_claims(c, a);
  for (const NumberOf& n : reading_numbers()) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(a.readings.size()));
    for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = n.get(a.readings[i]);
    c(values, text("/reading/", n.name), n.units, n.range, "draw", n.meaning);
    for (Eigen::Index i = 0; c.in() && i < values.size(); ++i) n.set(a.readings[i], values[i]);
  }
  for (const WordOf& w : kWords) {
    std::vector<std::string> values;
    for (const Reading& r : a.readings) values.push_back(r.choices.*w.member);
    c(values, text("/reading/", w.name), "draw", w.meaning);
    for (std::size_t i = 0; c.in() && i < values.size(); ++i) a.readings[i].choices.*w.member = values[i];
  }
}

std::string title(const ReadingsResult& a) {
  return "Readings of P2000: " + a.title;
}

template struct ArtifactFile<ReadingsResult>;

}  // namespace whine
