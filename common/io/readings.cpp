#include "io/readings.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <random>

#include "base/error.h"
#include "io/artifact.h"
#include "io/publish.h"
#include "io/suggestion.h"
#include "io/toml.h"

namespace whine {
namespace {

constexpr int kVersion = 1;
constexpr int kMostReadings = 1000;
constexpr double kDegree = std::numbers::pi / 180;
using Words = std::vector<std::string>;

class PlanFile {
 public:
  explicit PlanFile(const std::string& path) : path_(path) {
    try {
      root_ = parse_toml(read_bytes(path, "check the path of the plan of readings"));
    } catch (const toml::parse_error& error) {
      refuse(error.source().begin.line, text("is not valid TOML: ", error.description()));
    }
  }

  const toml::table& root() const { return root_; }

  [[noreturn]] void refuse(toml::source_index line, const std::string& what) const {
    fail(Failure::input, path_, ":", line, ": ", what);
  }

  const toml::table& section(const char* name) const {
    const toml::table* table = root_.get_as<toml::table>(name);
    if (!table) refuse(1, text("lacks the section [", name, "]"));
    return *table;
  }

  void require_known(const toml::table& table, const Words& known) const {
    for (const auto& [name, node] : table) {
      const std::string word(name.str());
      if (std::find(known.begin(), known.end(), word) != known.end()) continue;
      const std::string near = nearest(word, known);
      refuse(name.source().begin.line,
             text("unknown key '", word, "'", near.empty() ? "" : "; did you mean '" + near + "'?"));
    }
  }

  std::string word(const char* key) const {
    const toml::node* node = root_.get(key);
    if (!node || !node->is_string() || node->as_string()->get().empty())
      refuse(node ? node->source().begin.line : 1, text("'", key, "' must be text in quotes"));
    return node->as_string()->get();
  }

  int whole(const char* key, int least, int most) const {
    const toml::node* node = root_.get(key);
    const auto value = node ? node->value_exact<int64_t>() : std::nullopt;
    if (!value || *value < least || *value > most)
      refuse(node ? node->source().begin.line : 1,
             text("'", key, "' must be a whole number from ", least, " to ", most));
    return static_cast<int>(*value);
  }

  // Each item of a list as `read` takes it.
  template <class Value, class Read>
  std::vector<Value> list(const toml::table& table, const char* key, const Read& read) const {
    const toml::node* node = table.get(key);
    const toml::array* items = node ? node->as_array() : nullptr;
    if (!items || items->empty())
      refuse(node ? node->source().begin.line : table.source().begin.line,
             text("'", key, "' must be a list of one value at least"));
    std::vector<Value> out;
    for (const toml::node& item : *items) out.push_back(read(item));
    return out;
  }

  std::vector<double> numbers(const toml::table& table, const char* key, double least, double most,
                              double scale = 1) const {
    return list<double>(table, key, [&](const toml::node& item) {
      const double value = item.is_number() ? item.value<double>().value_or(NAN) : NAN;
      if (!(value >= least && value <= most))
        refuse(item.source().begin.line,
               text("'", key, "' holds ", value, "; each must be from ", least, " to ", most));
      return value * scale;
    });
  }

  Words words(const toml::table& table, const char* key, const Words& known) const {
    return list<std::string>(table, key, [&](const toml::node& item) {
      const std::string value = item.value<std::string>().value_or("");
      if (std::find(known.begin(), known.end(), value) == known.end()) {
        std::string all;
        for (const std::string& w : known) all += (all.empty() ? "" : ", ") + w;
        refuse(item.source().begin.line, text("'", key, "' holds something else than ", all));
      }
      return value;
    });
  }

 private:
  std::string path_;
  toml::table root_;
};

CornerRule corner_of(double angle) {
  CornerRule rule;
  rule.enabled = angle > 0;
  if (angle > 0 && angle < std::numbers::pi) rule.largest_angle = angle;
  return rule;
}

// rad: 0 without corner contact, pi for any angle.
double angle_of(const CornerRule& rule) {
  return !rule.enabled ? 0 : std::min(rule.largest_angle, std::numbers::pi);
}

}  // namespace

ReadingPlan read_reading_plan(const std::string& path) {
  const PlanFile file(path);
  file.require_known(file.root(), {"title", "scene", "seed", "readings", "pair", "draw"});
  ReadingPlan plan;
  plan.title = file.word("title");
  plan.scene = (std::filesystem::path(path).parent_path() / file.word("scene")).lexically_normal().string();
  plan.seed = file.whole("seed", 0, std::numeric_limits<int>::max());
  plan.readings = file.whole("readings", 1, kMostReadings);
  const toml::table &pair = file.section("pair"), &draws = file.section("draw");
  file.require_known(pair, {"dedendum", "rack_tip_share", "tooth_thinning_mm", "plane", "corner_contact"});
  file.require_known(draws, {"inertia_from", "frequency_offset_percent", "damped_state", "mass_share",
                             "undamped_depth_mm", "steps_per_period"});
  plan.dedendum = file.numbers(pair, "dedendum", 1, 2);
  plan.rack_tip_share = file.numbers(pair, "rack_tip_share", 0.05, 1);
  plan.tooth_thinning = file.numbers(pair, "tooth_thinning_mm", 0, 0.5, 1e-3);
  plan.plane = file.words(pair, "plane", {"stress", "strain"});
  plan.corner = file.list<CornerRule>(pair, "corner_contact", [&](const toml::node& item) {
    if (const auto* flag = item.as_boolean()) return corner_of(flag->get() ? std::numbers::pi : 0);
    const double degrees = item.is_number() ? item.value<double>().value_or(NAN) : NAN;
    if (!(degrees > 0 && degrees <= 90))
      file.refuse(item.source().begin.line,
                  "'corner_contact' holds something else than true, false or an "
                  "angle above 0 and up to 90 degrees");
    return corner_of(degrees * kDegree);
  });
  plan.inertia_from = file.words(draws, "inertia_from", {"one", "two", "mean", "table", "mass"});
  plan.damped_state = file.words(draws, "damped_state", {"one", "two", "mean"});
  plan.frequency_offset = file.numbers(draws, "frequency_offset_percent", -5, 5, 0.01);
  plan.mass_share = file.numbers(draws, "mass_share", 0, 0.95);
  plan.undamped_depth = file.numbers(draws, "undamped_depth_mm", 0.05, 10, 1e-3);
  for (const double steps : file.numbers(draws, "steps_per_period", 16, 4096))
    plan.steps_per_period.push_back(static_cast<int>(steps));
  return plan;
}

std::vector<OpenChoices> pairs_of(const ReadingPlan& plan) {
  std::vector<OpenChoices> pairs;
  for (const double dedendum : plan.dedendum)
    for (const double share : plan.rack_tip_share)
      for (const double thinning : plan.tooth_thinning)
        for (const std::string& plane : plan.plane)
          for (const CornerRule& corner : plan.corner) {
            OpenChoices c;
            c.dedendum = dedendum;
            c.rack_tip_share = share;
            c.tooth_thinning = thinning;
            c.plane = plane;
            c.corner = corner;
            pairs.push_back(c);
          }
  return pairs;
}

OpenChoices draw(const ReadingPlan& plan, const OpenChoices& pair, int pair_number, int index) {
  std::seed_seq seed{plan.seed, pair_number, index};
  std::mt19937 random(seed);
  // Not std::uniform_int_distribution, whose draws are those of one library only.
  const auto one_of = [&](const auto& list) { return list[random() % list.size()]; };
  OpenChoices c = pair;
  c.inertia_from = one_of(plan.inertia_from);
  c.frequency_offset = one_of(plan.frequency_offset);
  c.damped_state = one_of(plan.damped_state);
  c.mass_share = one_of(plan.mass_share);
  c.undamped_depth = one_of(plan.undamped_depth);
  c.steps_per_period = one_of(plan.steps_per_period);
  return c;
}

namespace {

// Every number of a reading, once: what is written and what is read walk this list.
struct NumberOf {
  const char *name, *units, *meaning;
  double (*get)(const Reading&);
  void (*set)(Reading&, double);
};

#define WHINE_NUMBER(name, units, meaning, member)                                  \
  {                                                                                 \
    name, units, meaning, [](const Reading& r) -> double { return r.member; },      \
        [](Reading& r, double v) { r.member = static_cast<decltype(r.member)>(v); } \
  }

const std::vector<NumberOf>& reading_numbers() {
  static const std::vector<NumberOf> numbers{
      WHINE_NUMBER("dedendum", "1", "dedendum in modules", choices.dedendum),
      WHINE_NUMBER("rack_tip_share", "1", "tip radius of the rack over the largest that its tooth holds",
                   choices.rack_tip_share),
      WHINE_NUMBER("rack_tip_radius", "1", "tip radius of the rack in modules", rack_tip_radius),
      WHINE_NUMBER("tooth_thinning", "m", "arc taken off the tooth at the pitch circle",
                   choices.tooth_thinning),
      WHINE_NUMBER("frequency_offset", "1", "of the frequency that the inertia is fitted to",
                   choices.frequency_offset),
      WHINE_NUMBER("mass_share", "1", "share of the damping ratio from mu of Eq. 21", choices.mass_share),
      WHINE_NUMBER("undamped_depth", "m", "depth above which the half-plane is undamped",
                   choices.undamped_depth),
      WHINE_NUMBER("steps_per_period", "1", "time steps per mesh period, before doubling",
                   choices.steps_per_period),
      WHINE_NUMBER("bore_radius", "m", "bore, fitted to the mean mesh stiffness", bore_radius),
      WHINE_NUMBER("total_inertia", "kg m2", "inertia of each gear, fitted", total_inertia),
      WHINE_NUMBER("rayleigh_mass", "s-1", "mu of Eq. 21, fitted", rayleigh_mass),
      WHINE_NUMBER("rayleigh_stiffness", "s", "eta of Eq. 21, fitted", rayleigh_stiffness),
      WHINE_NUMBER("level_ratio", "1", "mesh stiffness with two pairs over that with one, 100 N m",
                   level_ratio),
      WHINE_NUMBER("first_harmonic", "1", "first harmonic of the mesh stiffness over its mean, 150 N m",
                   first_harmonic),
      WHINE_NUMBER("jump_up", "Hz", "highest jump of the rising sweep near f_n, 150 N m; 0: none", jump_up),
      WHINE_NUMBER("jump_down", "Hz", "highest jump of the falling sweep near f_n, 150 N m; 0: none",
                   jump_down),
      {"corner_angle", "rad", "largest angle of corner contact; 0: none, pi: any",
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
     "what the inertia is fitted to: Table 1 at 100 N m (one, two, mean), all of it (table), or 1.4 kg "
     "(mass)",
     &OpenChoices::inertia_from},
    {"damped_state", "contact state with a damping ratio of 7 %", &OpenChoices::damped_state}};

}  // namespace

void write(const std::string& path, const ReadingsArtifact& a, const Provenance& provenance) {
  ArtifactWriter out(path, "readings", kVersion, "Readings of P2000: " + a.title, provenance);
  out.put("/parameters/readings/title", a.title, {"1", "what the search is", "", ""});
  out.put("/parameters/readings/contact", a.contact, {"1", "model level of contact in the sweeps", "", ""});
  out.put("/parameters/readings/outside", a.outside,
          {"1", "readings left out because the model of the pair cannot compute them", "", ""});
  out.file().put("/claim", a.claim, h5::Label{"1", "names of the claims", "claim", ""});
  const auto count = static_cast<Eigen::Index>(a.readings.size());
  const auto claims = static_cast<Eigen::Index>(a.claim.size());
  for (const NumberOf& n : reading_numbers()) {
    Eigen::VectorXd values(count);
    for (Eigen::Index i = 0; i < count; ++i) values[i] = n.get(a.readings[i]);
    out.put(text("/reading/", n.name), values, {n.units, n.meaning, "reading", ""});
  }
  for (const WordOf& w : kWords) {
    Words values;
    for (const Reading& r : a.readings) values.push_back(r.choices.*w.member);
    out.file().put(text("/reading/", w.name), values, h5::Label{"1", w.meaning, "reading", ""});
  }
  MatrixRM value(count, claims);
  MatrixRMi verdict(count, claims), exists(count, claims);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index c = 0; c < claims; ++c) {
      value(i, c) = a.readings[i].value.at(c);
      verdict(i, c) = a.readings[i].verdict.at(c);
      exists(i, c) = a.readings[i].exists.at(c);
    }
  out.put(
      "/value", value,
      {"1", "what the claim is about, in the claim's unit; 0 where it does not exist", "reading claim", ""});
  out.put("/exists", exists,
          {"1", "0: the state that the claim is about does not exist", "reading claim", ""});
  out.put(
      "/verdict", verdict,
      {"1", "0 agrees, 1 differs, 2 given, 3 fitted, 4 cannot be compared, 5 misprint", "reading claim", ""});
  out.publish();
}

ReadingsArtifact read_readings(const std::string& path) {
  const ArtifactReader in(path, "readings", kVersion);
  ReadingsArtifact a;
  a.title = in.word("/parameters/readings/title");
  a.contact = in.word("/parameters/readings/contact");
  a.outside = in.whole("/parameters/readings/outside");
  a.claim = in.file().strings("/claim");
  const auto claims = static_cast<Eigen::Index>(a.claim.size());
  const MatrixRM value = in.matrix("/value", -1, claims);
  const Eigen::Index count = value.rows();
  const MatrixRMi verdict = in.whole_matrix("/verdict", count, claims),
                  exists = in.whole_matrix("/exists", count, claims);
  a.readings.resize(count);
  for (const NumberOf& n : reading_numbers()) {
    const Eigen::VectorXd values = in.vector(text("/reading/", n.name), count);
    for (Eigen::Index i = 0; i < count; ++i) n.set(a.readings[i], values[i]);
  }
  for (const WordOf& w : kWords) {
    const Words values = in.file().strings(text("/reading/", w.name));
    if (values.size() != a.readings.size())
      in.file().refuse(text("dataset /reading/", w.name, " holds ", values.size(), " words, there are ",
                            count, " readings"));
    for (Eigen::Index i = 0; i < count; ++i) a.readings[i].choices.*w.member = values[i];
  }
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index c = 0; c < claims; ++c) {
      a.readings[i].value.push_back(value(i, c));
      a.readings[i].verdict.push_back(verdict(i, c));
      a.readings[i].exists.push_back(exists(i, c));
    }
  return a;
}

}  // namespace whine
