#include "io/artifacts.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "base/error.h"
#include "io/artifact_file.h"
#include "model/response_quantities.h"

namespace whine {
namespace {

using namespace ranges;

// The dataset of a key: its place without dots, its name without the unit.
std::string dataset_of(const VariedKey& key) {
  const std::string leaf = find_key(key.name).key->si_name();
  const auto dot = key.name.rfind('.');
  std::string place = dot == std::string::npos ? "" : key.name.substr(0, dot + 1);
  std::replace(place.begin(), place.end(), '.', '_');
  std::replace(place.begin(), place.end(), '-', '_');
  return "/key/" + place + leaf;
}

void describe_plan(Codec& c, StudyPlan& plan) {
  const std::string at = "/parameters/study/";
  c(plan.title, at + "title", "", "what the study is");
  c(plan.scene, at + "scene", "", "scene whose variants these are");
  if (c.optional(at + "train_mesh", !plan.train.empty())) {
    c(plan.train.meshes, at + "train_mesh", "train_mesh", "meshes of the train");
    c(plan.train.bodies, at + "train_body", "train_body", "its bodies");
    if (c.optional(at + "train_shared", !plan.train.shared.empty()))
      c(plan.train.shared, at + "train_shared", "train_shared", "its [[mesh]] of several planets");
  }
  c(plan.directions, at + "directions", "", "directions of the sweeps; none: at rest");
  std::string kind = plan.random ? "sample" : "grid";
  c(kind, at + "plan", "", "all combinations, or random ones");
  c(plan.seed, at + "seed", "1", {0, 2147483647.0}, "", "of the draws of a sample");
  std::vector<std::string> keys;
  for (const VariedKey& key : plan.keys) keys.push_back(key.name);
  c(keys, at + "key", "key", "keys that vary, as the study names them");
  c(plan.quantities, at + "quantity", "quantity", "response quantities that are gathered");
  c(plan.figure_quantities, at + "figure_quantity", "figure_quantity",
    "response quantities that the figure shows");
  c(plan.figure_keys, at + "figure_key", "figure_key", "keys against which it shows them");
  c(plan.figure_colour, at + "figure_colour", "", "key by which it colours them");
  if (c.optional(at + "figure_map", !plan.figure_map.empty()))
    c(plan.figure_map, at + "figure_map", "figure_side", "what runs along x and y of its cells");
  if (!c.in()) return;
  plan.random = kind == "sample";
  plan.keys.clear();
  for (const std::string& name : keys) plan.keys.push_back(varied_key(name));
}

// Values of one key in all variants: numbers in SI, others as a scene has them.
void describe_values(Codec& c, StudyResult& a, std::size_t k) {
  const VariedKey& key = a.plan.keys[k];
  const std::string meaning = key.name + ": " + key.meaning;
  const auto variants = static_cast<Eigen::Index>(a.variants.size());
  std::vector<std::string> texts;
  if (c.out())
    for (const GatheredVariant& variant : a.variants) texts.push_back(variant.values.at(k));
  if (key.number) {
    Eigen::VectorXd si(c.out() ? variants : 0);
    for (Eigen::Index v = 0; v < si.size(); ++v) si[v] = key.si(texts[v]);
    c(si, dataset_of(key), key.units, kQuantity, "variant", meaning);
    for (Eigen::Index v = 0; c.in() && v < variants; ++v) {
      char buffer[40];
      std::snprintf(buffer, sizeof buffer, "%.12g", si[v] * key.to_si_divide / key.to_si_multiply);
      texts.emplace_back(buffer);
    }
  } else {
    c(texts, dataset_of(key), "variant", meaning);
  }
  for (std::size_t v = 0; c.in() && v < a.variants.size(); ++v) a.variants[v].values.push_back(texts[v]);
}

}  // namespace

void describe(Codec& c, StudyResult& a) {
  if (c.out() && a.quantity.rows() != static_cast<Eigen::Index>(a.variants.size()))
    fail(Failure::numerical, "result has ", a.quantity.rows(), " rows, expected ", a.variants.size());
  describe_plan(c, a.plan);
  std::vector<std::string> names;
  for (const GatheredVariant& variant : a.variants) names.push_back(variant.name);
  c(names, "/variant", "variant", "name of the variant's stage parameters and artifact");
  if (c.in())
    for (const std::string& name : names) a.variants.push_back({name, {}});
  for (std::size_t k = 0; k < a.plan.keys.size(); ++k) describe_values(c, a, k);
  const std::vector<ResponseQuantity> kinds = response_quantities(a.plan.directions, a.plan.train);
  const auto quantities = static_cast<Eigen::Index>(a.plan.quantities.size());
  for (const ResponseQuantity& kind : kinds) {
    const auto found = std::find(a.plan.quantities.begin(), a.plan.quantities.end(), kind.name);
    if (found != a.plan.quantities.end())
      c.column({"/quantity/" + kind.name, kind.units, kind.meaning + "; 0 where outside_model is 1",
                "variant", kQuantity},
               a.quantity, found - a.plan.quantities.begin(), quantities);
  }
  if (c.lists()) {
    c(a.unsteady, "/key/<key>", "its own", kQuantity, "variant", "value in each variant");
    c(a.unsteady, "/quantity/<quantity>", "its own", kQuantity, "variant",
      "response quantity of each variant");
  }
  for (std::size_t q = 1; c.in() && q < a.plan.quantities.size(); ++q)
    if (std::find(a.plan.quantities.begin(), a.plan.quantities.begin() + static_cast<std::ptrdiff_t>(q),
                  a.plan.quantities[q]) != a.plan.quantities.begin() + static_cast<std::ptrdiff_t>(q))
      c.in()->reject("names the response quantity '" + a.plan.quantities[q] + "' twice");
  std::string known;
  for (const ResponseQuantity& kind : kinds) known += " " + kind.name;
  if (c.in())
    for (const std::string& name : a.plan.quantities)
      if (std::none_of(kinds.begin(), kinds.end(), [&](const ResponseQuantity& k) { return k.name == name; }))
        c.in()->reject(text("dataset /parameters/study/quantity holds '", name,
                            "', which no variant gives; it is one of:", known));
  Eigen::VectorXi rejected(static_cast<Eigen::Index>(a.rejection.size()));
  for (Eigen::Index v = 0; v < rejected.size(); ++v) rejected[v] = a.rejection[v].empty() ? 0 : 1;
  c(rejected, "/outside_model", "1", kFlag, "variant",
    "1: the variant lies outside the model's range and has no response quantities");
  c(a.rejection, "/outside_model_reason", "variant", "why; empty where it was not rejected");
  c(a.unsteady, "/unsteady", "1", kNumber, "variant",
    "speeds, of all sweeps, at which no periodic motion was found");
}

std::string title(const StudyResult& a) {
  return "Study: " + a.plan.title;
}

template struct ArtifactFile<StudyResult>;

}  // namespace whine
