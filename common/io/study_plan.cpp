#include "io/study.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "base/error.h"
#include "io/publish.h"
#include "io/section_reader.h"
#include "io/toml.h"
#include "model/response_quantities.h"

namespace whine {
namespace {

using Words = std::vector<std::string>;

std::string quoted(const std::string& word) {
  std::ostringstream out;
  out << toml::value<std::string>(word);
  return out.str();
}

std::string quoted(const Words& words) {
  Words all;
  for (const std::string& word : words) all.push_back(quoted(word));
  return "[" + joined(all) + "]";
}

constexpr const char* kPlanStart = "# What is gathered of a study; made by gear-study.";

}  // namespace

std::vector<std::string> keys_without_effect(const StudyPlan& study,
                                             const std::vector<GatheredVariant>& variants) {
  Words idle;
  for (size_t k = 0; k < study.keys.size(); ++k) {
    std::map<Words, const GatheredVariant*> first;  // by the values of all other keys
    bool compared = false, changes = false;
    for (const GatheredVariant& variant : variants) {
      Words others = variant.values;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      const auto [at, added] = first.emplace(others, &variant);
      if (added || at->second->values[k] == variant.values[k]) continue;
      compared = true;
      changes = changes || at->second->name != variant.name;
    }
    if (compared && !changes) idle.push_back(study.keys[k].name);
  }
  return idle;
}

std::string plan_text(const StudyPlan& study, const std::vector<GatheredVariant>& variants) {
  std::ostringstream out;
  Words names, directions;
  for (const VariedKey& key : study.keys) names.push_back(key.name);
  for (const Direction direction : study.directions) directions.push_back(name_of(direction));
  const auto of_train = [&](const char* key, const Words& list) {
    return study.train.empty() ? "" : "\n" + std::string(key) + " = " + quoted(list);
  };
  out << kPlanStart << "\ntitle = " << quoted(study.title) << "\nscene = " << quoted(study.scene)
      << of_train("train_meshes", study.train.meshes) << of_train("train_bodies", study.train.bodies)
      << of_train("train_shared", study.train.shared) << "\ndirections = " << quoted(directions)
      << "\nrandom = " << (study.random ? "true" : "false") << "\nseed = " << study.seed
      << "\nmarks_outside_model = " << (study.marks_outside ? "true" : "false")
      << "\nquantities = " << quoted(study.quantities) << "\nkeys = " << quoted(names)
      << "\nfigure_quantities = " << quoted(study.figure_quantities)
      << "\nfigure_keys = " << quoted(study.figure_keys)
      << "\nfigure_colour = " << quoted(study.figure_colour) << "\nfigure_map = " << quoted(study.figure_map)
      << "\nvariants = [\n";
  for (const GatheredVariant& variant : variants) {
    Words row{variant.name};
    row.insert(row.end(), variant.values.begin(), variant.values.end());
    out << "  " << quoted(row) << ",\n";
  }
  out << "]\n";
  return out.str();
}

std::pair<StudyPlan, std::vector<GatheredVariant>> read_plan(const std::string& path) {
  constexpr std::size_t kMostOfVariants = 1 << 28;  // bytes: a line for each
  const toml::table root = read_toml(path, "the study", kMostOfVariants);
  const auto reject = [&]() {
    fail(Failure::input, path,
         ": is no plan of a study that gear-study has written; make it again: make study STUDY=<name>");
  };
  const auto words = [&](const toml::node* node) {
    Words out;
    if (!node || !node->is_array()) reject();
    for (const toml::node& item : *node->as_array()) {
      if (!item.is_string()) reject();
      out.push_back(item.as_string()->get());
    }
    return out;
  };
  StudyPlan plan;
  plan.title = root["title"].value_or(std::string());
  plan.scene = root["scene"].value_or(std::string());
  if (const toml::node* meshes = root.get("train_meshes"))
    plan.train = {words(meshes), words(root.get("train_bodies")), words(root.get("train_shared"))};
  const auto directions = choices_in<Direction>(joined(words(root.get("directions")), " "));
  if (!directions) reject();
  plan.directions = *directions;
  plan.random = root["random"].value_or(false);
  plan.seed = root["seed"].value_or(0);
  plan.marks_outside = root["marks_outside_model"].value_or(false);
  plan.quantities = words(root.get("quantities"));
  for (const std::string& name : words(root.get("keys"))) plan.keys.push_back(varied_key(name));
  plan.figure_quantities = words(root.get("figure_quantities"));
  plan.figure_keys = words(root.get("figure_keys"));
  plan.figure_colour = root["figure_colour"].value_or(std::string());
  plan.figure_map = words(root.get("figure_map"));
  // gear-study finds response quantities and keys by their names.
  Words quantities, keys;
  const auto within = [](const Words& some, const Words& all) {
    return std::all_of(some.begin(), some.end(), [&](const std::string& word) {
      return std::find(all.begin(), all.end(), word) != all.end();
    });
  };
  for (const ResponseQuantity& kind : response_quantities(plan.directions, plan.train))
    quantities.push_back(kind.name);
  for (const VariedKey& key : plan.keys) keys.push_back(key.name);
  Words sides = keys;
  sides.insert(sides.end(), plan.quantities.begin(), plan.quantities.end());
  if (!within(plan.figure_map, sides) || (plan.figure_map.size() != 0 && plan.figure_map.size() != 2))
    reject();
  if (!within(plan.quantities, quantities) || !within(plan.figure_quantities, plan.quantities) ||
      !within(plan.figure_keys, keys) || (!plan.figure_colour.empty() && !within({plan.figure_colour}, keys)))
    reject();
  std::vector<GatheredVariant> variants;
  const toml::array* rows = root["variants"].as_array();
  if (!rows || rows->empty()) reject();
  for (const toml::node& row : *rows) {
    Words all = words(&row);
    if (all.size() != plan.keys.size() + 1 || all[0].size() < 2) reject();
    variants.push_back({all[0], Words(all.begin() + 1, all.end())});
  }
  return {plan, variants};
}

std::vector<std::string> design_changes(const Study& study, size_t which) {
  if (study.compared.empty())
    fail(Failure::input, study.path,
         ": marks no variants to compare; add compare = [0, 3], the numbers of two of them");
  Words changes;
  for (const auto& [name, value] : study.fixed) changes.push_back(name + "=" + value);
  const Words values = variant_values(study, study.compared.at(which));
  for (size_t k = 0; k < values.size(); ++k) changes.push_back(study.keys[k].name + "=" + values[k]);
  return changes;
}

std::string variant_name(const StudyPlan& study, long index, const std::vector<std::string>& values) {
  std::string out = text("variant ", index, " (");
  for (size_t k = 0; k < values.size(); ++k) out += text(k ? ", " : "", study.keys[k].name, " = ", values[k]);
  return out + ")";
}

std::string variant_file(const std::string& name) {
  return "variants/" + name.substr(0, 2) + "/" + name;
}

}  // namespace whine
