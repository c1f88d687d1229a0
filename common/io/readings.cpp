#include "io/readings.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <random>

#include "base/error.h"
#include "base/units.h"
#include "io/publish.h"
#include "io/suggestion.h"
#include "io/toml.h"

namespace whine {

CornerRule corner_of(double angle) {
  CornerRule rule;
  rule.enabled = angle > 0;
  if (angle > 0 && angle < std::numbers::pi) rule.largest_angle = angle;
  return rule;
}

double angle_of(const CornerRule& rule) {
  return !rule.enabled ? 0 : std::min(rule.largest_angle, std::numbers::pi);
}

namespace {

constexpr int kMostReadings = 1000;
using Words = std::vector<std::string>;

class PlanFile {
 public:
  explicit PlanFile(const std::string& path) : path_(path), root_(read_toml(path, "the plan of readings")) {}

  const toml::table& root() const { return root_; }

  [[noreturn]] void reject(toml::source_index line, const std::string& what) const {
    fail(Failure::input, path_, ":", line, ": ", what);
  }

  const toml::table& section(const char* name) const {
    const toml::table* table = root_.get_as<toml::table>(name);
    if (!table) reject(1, text("lacks the section [", name, "]"));
    return *table;
  }

  void require_known(const toml::table& table, const Words& known) const {
    for (const auto& [name, node] : table) {
      const std::string word(name.str());
      if (std::find(known.begin(), known.end(), word) != known.end()) continue;
      const std::string near = nearest(word, known);
      reject(name.source().begin.line,
             text("unknown key '", word, "'", near.empty() ? "" : "; did you mean '" + near + "'?"));
    }
  }

  std::string word(const char* key) const {
    const toml::node* node = root_.get(key);
    if (!node || !node->is_string() || node->as_string()->get().empty())
      reject(node ? node->source().begin.line : 1, text("'", key, "' must be text in quotes"));
    return node->as_string()->get();
  }

  int whole(const char* key, int least, int most) const {
    const toml::node* node = root_.get(key);
    const auto value = node ? node->value_exact<int64_t>() : std::nullopt;
    if (!value || *value < least || *value > most)
      reject(node ? node->source().begin.line : 1,
             text("'", key, "' must be a whole number from ", least, " to ", most));
    return static_cast<int>(*value);
  }

  // Each item of a list as `read` takes it.
  template <class Value, class Read>
  std::vector<Value> list(const toml::table& table, const char* key, const Read& read) const {
    const toml::node* node = table.get(key);
    const toml::array* items = node ? node->as_array() : nullptr;
    if (!items || items->empty())
      reject(node ? node->source().begin.line : table.source().begin.line,
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
        reject(item.source().begin.line,
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
        reject(item.source().begin.line, text("'", key, "' holds something else than ", all));
      }
      return value;
    });
  }

 private:
  std::string path_;
  toml::table root_;
};

// rad: 0 without corner contact, pi for any angle.
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
      file.reject(
          item.source().begin.line,
          "'corner_contact' holds something else than true, false or an angle above 0 and up to 90 degrees");
    return corner_of(degrees * kOneDegree);
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

}  // namespace whine
