#include "io/study_expansion.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <tuple>

#include "base/error.h"
#include "base/tool.h"
#include "gear/scene_geometry.h"
#include "io/artifacts.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/scene.h"
#include "results/variant.h"
#include "system/system_rest.h"

namespace whine {
namespace {

constexpr const char* kUnsteady = "unsteady_";  // quantities that count them begin so

bool holds(const std::string& path, const std::string& bytes) {
  std::error_code code;
  return std::filesystem::is_regular_file(path, code) && read_bytes(path) == bytes;
}

// Variants of a sample with the value of one key taken from another variant: with them, keys without effect show.
void add_probes(const Study& study, std::vector<GatheredVariant>& variants) {
  constexpr size_t kProbes = 8;  // a key may act with some values of the others only
  const size_t count = variants.size();
  for (size_t k = 0; k < study.keys.size(); ++k)
    for (size_t i = 0; i < std::min(count, kProbes); ++i) {
      std::vector<std::string> values = variants[i].values;
      for (size_t j = 1; j < count && values[k] == variants[i].values[k]; ++j)
        values[k] = variants[(i + j) % count].values[k];
      try {
        const StudyVariant probe = study_variant(study, static_cast<long>(i), values);
        variants.push_back({body_hash(variant_stage_parameters(probe, study.directions)), values});
      } catch (const Error&) {
        // The values do not go together; so the key matters.
        variants.push_back({"", values});
      }
    }
}

// Gears and the stage parameters of their bodies; of a pair the driver first.
BodySettings bodies_of(const StudyVariant& variant) {
  if (!variant.scene.pair()) return body_parameters_of(variant.scene);
  BodySettings out;
  for (const std::string& gear : variant.scene.mesh().gear)
    out.emplace_back(gear, body_parameters(variant.scene, gear));
  return out;
}

// Where variants outside the model's range are marked their stage checks the inertias.
void check_variant(const StudyVariant& variant, const Study& study, const ScenePlace& where) {
  const bool inertia = !study.directions.empty() && !study.marks_outside;
  check_geometry(variant.scene, where);
  if (inertia) check_inertia(variant.scene, where);
  if (variant.scene.pair()) return;
  try {
    check_at_rest(variant.scene, variant.layout);
  } catch (const SectionError& error) {
    fail(Failure::input, where({}, ""), ": ", error.what());
  }
}

void require_one_train(const StudyVariant& variant, const Study& study, const std::string& where) {
  if (!variant.scene.pair() &&
      train_names(static_parameters_of(variant.scene, variant.layout)) != study.train)
    fail(
        Failure::input, where,
        ": the study varies which gears mesh; its quantities are of the meshes of the scene, so make a study of each");
}

}  // namespace

ExpandedStudy expand_study(const std::string& path, const std::string& home) {
  ExpandedStudy plan;
  const Study& study = plan.study = read_study(path);
  for (long i = 0; i < study.variants; ++i) {
    const std::vector<std::string> values = variant_values(study, i);
    const StudyVariant variant = study_variant(study, i, values);
    const std::string name = path + ": " + variant_name(study, i, values);
    require_one_train(variant, study, name);
    std::string own, pair;
    for (const auto& [gear, body] : bodies_of(variant)) {
      own += (own.empty() ? "" : " ") + gear;
      pair += (pair.empty() ? "" : "_") + plan.bodies.emplace(body_hash(body), body).first->first;
    }
    if (!plan.gears.empty() && own != plan.gears)
      fail(Failure::input, path, ": the study varies which gear drives which (", plan.gears, ", ", own,
           "); make a study of each");
    plan.gears = own;
    const std::string settings = variant_stage_parameters(variant, study.directions);
    // One whose stage parameters are there has been checked before.
    if (!holds(home + variant_file(body_hash(settings)) + ".toml", settings))
      check_variant(variant, study,
                    [&](const std::vector<std::string>&, const std::string&) { return name; });
    plan.variants.push_back({body_hash(settings), values});
    if (plan.parameters.emplace(plan.variants.back().name, settings).second)
      plan.of_pair[pair].push_back(plan.variants.back().name);
  }
  if (plan.parameters.size() == 1 && study.variants > 1)
    fail(Failure::input, path, ": the study varies nothing: all ", study.variants,
         " variants are alike, because what its stage computes depends on none of the keys");
  return plan;
}

std::string study_fragment(const ExpandedStudy& plan, const std::string& path, const std::string& stem) {
  const std::string prefix = "STUDY_" + stem + "_";
  std::ostringstream out;
  out << "# Written by gear-study from " << in_comment(recorded_path(path)) << "\n" << prefix << "PAIRS :=";
  for (const auto& [pair, names] : plan.of_pair) out << " " << pair;
  for (const auto& [pair, names] : plan.of_pair) {
    out << "\n" << prefix << pair << " :=";
    for (const std::string& name : names) out << " " << variant_file(name);
  }
  out << "\n" << prefix << "GEARS := " << plan.gears;
  out << "\n"
      << prefix << "OPTIONS :=" << (plan.study.marks_outside ? "--mark-outside-model" : "") << "\nBODIES +=";
  for (const auto& [hash, text] : plan.bodies) out << " " << hash;
  out << "\n";
  for (const auto& [pair, names] : plan.of_pair) {
    std::string hashes = pair;
    std::replace(hashes.begin(), hashes.end(), '_', ' ');
    out << "$(" << prefix << pair << ":%=out/studies/" << stem
        << "/%.h5): %.h5: %.toml $(patsubst %,out/bodies/%/body.h5,$(sort " << hashes
        << ")) $(call id,gear-variant) | $(B)/bin/gear-variant\n\t$(call of_variant," << stem << "," << hashes
        << ")\n";
  }
  return out.str();
}

std::vector<std::string> idle_keys(const ExpandedStudy& plan) {
  std::vector<GatheredVariant> compared = plan.variants;
  if (plan.study.random) add_probes(plan.study, compared);
  return keys_without_effect(plan.study, compared);
}

GatheredStudy gather_study(const std::string& path) {
  GatheredStudy gathered;
  StudyResult& study = gathered.study;
  std::tie(study.plan, study.variants) = read_plan(path);
  const std::string home = std::filesystem::path(path).parent_path().string() + "/";
  const std::vector<ResponseQuantity> kinds = response_quantities(study.plan.directions, study.plan.train);
  std::vector<Eigen::Index> column;
  for (const std::string& quantity : study.plan.quantities)
    column.push_back(std::find_if(kinds.begin(), kinds.end(),
                                  [&](const ResponseQuantity& k) { return k.name == quantity; }) -
                     kinds.begin());
  study.quantity.setZero(static_cast<Eigen::Index>(study.variants.size()),
                         static_cast<Eigen::Index>(column.size()));
  study.unsteady.setZero(static_cast<Eigen::Index>(study.variants.size()));
  for (size_t v = 0; v < study.variants.size(); ++v) {
    const std::string file = home + variant_file(study.variants[v].name) + ".h5";
    const VariantResult variant = read<VariantResult>(file);
    if (variant.directions != study.plan.directions || variant.names != study.plan.train)
      fail(Failure::input, file, ": is of another stage than the study; ", rebuild_advice(file));
    study.rejection.push_back(variant.rejection);
    // Marked when the study said so; its file is up to date, so nobody but this asks again.
    if (!variant.rejection.empty() && !study.plan.marks_outside)
      fail(Failure::input, path, ": ",
           variant_name(study.plan, static_cast<long>(v), study.variants[v].values),
           " lies outside the model's range: ", variant.rejection,
           "; take it out, or say outside_model = \"mark\"");
    if (!variant.rejection.empty()) {
      gathered.rejected.push_back(
          text(variant_name(study.plan, static_cast<long>(v), study.variants[v].values),
               " lies outside the model's range: ", variant.rejection));
      continue;
    }
    for (size_t i = 0; i < column.size(); ++i)
      study.quantity(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(i)) =
          variant.quantity[column[i]];
    // Counted whether or not the study asks for it: the other quantities of such a speed are those of a motion that goes on
    // changing.
    for (size_t i = 0; i < kinds.size(); ++i)
      if (kinds[i].name.starts_with(kUnsteady))
        study.unsteady[static_cast<Eigen::Index>(v)] +=
            static_cast<int>(variant.quantity[static_cast<Eigen::Index>(i)]);
    gathered.unsteady += study.unsteady[static_cast<Eigen::Index>(v)] > 0;
  }
  return gathered;
}

}  // namespace whine
