// gear-study: what variants a study has and where they come from; afterwards, what they answered, in one file.
//
// Reads      a study (TOML) and the scene that it names; with --gather its plan and the artifact of each variant
// Writes     <out>/studies/<study>/variants/ab/ab12....toml    a slice for each variant, replaced only if it changes
//            <out>/studies/<study>/plan.toml                   the variants, their values, what is gathered
//            <out>/bodies/<hash>/body.toml                     one per distinct gear
//            --output                                          make fragment: variants by their pair of bodies
//            --gather: study.h5 instead, a row for each variant
// Equations  none; variants are scenes as gear-scene --set makes them, draws as io/study.h says
// Example    gear-study --study data/studies/damping-torque-relief.toml --output build/studies/damping-torque-relief.mk --out out
//            gear-study --gather out/studies/damping-torque-relief/plan.toml --output out/studies/damping-torque-relief/study.h5
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "gear/scene_geometry.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/scene.h"
#include "io/study.h"
#include "io/study_codec.h"
#include "io/variant.h"
#include "io/variant_codec.h"

namespace {

using namespace whine;

constexpr int kShownRefusals = 5;
constexpr const char* kUnsteady = "unsteady_";  // answers that count them begin so

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
        variants.push_back({body_hash(variant_slice(probe.scene, probe.torque, study.directions)), values});
      } catch (const Error&) {
        // The values do not go together; so the key matters.
        variants.push_back({"", values});
      }
    }
}

void plan(const std::string& path, const std::string& output, const std::string& folder,
          const std::string& ids) {
  const std::string stem = std::filesystem::path(path).stem().string();
  if (!plain_name(stem))
    fail(Failure::input, path, ": the name '", stem,
         "' becomes a folder and a make target, so it may hold letters, digits, '_' and '-' only; rename the "
         "file");
  const Study study = read_study(path);
  const std::string home = folder + "/studies/" + stem + "/";

  // The whole study is checked before anything is written.
  std::map<std::string, std::string> bodies, slices;        // by hash
  std::map<std::string, std::vector<std::string>> of_pair;  // "driver_driven" -> variants, each once
  std::vector<GatheredVariant> variants;
  std::string gears;  // driver and driven gear, the order of a pair's bodies
  for (long i = 0; i < study.variants; ++i) {
    const std::vector<std::string> values = variant_values(study, i);
    const StudyVariant variant = study_variant(study, i, values);
    const std::string own = variant.scene.mesh.driver + " " + variant.scene.mesh.driven;
    if (!gears.empty() && own != gears)
      fail(Failure::input, path, ": the study varies which gear drives which (", gears, ", ", own,
           "); make a study of each");
    gears = own;
    std::string pair;
    for (const std::string& gear : {variant.scene.mesh.driver, variant.scene.mesh.driven}) {
      const std::string body = body_slice(variant.scene, gear);
      pair += (pair.empty() ? "" : "_") + bodies.emplace(body_hash(body), body).first->first;
    }
    const std::string slice = variant_slice(variant.scene, variant.torque, study.directions);
    // One whose slice is there has been checked before.
    if (!holds(home + variant_file(body_hash(slice)) + ".toml", slice)) {
      const auto where = [&](const std::vector<std::string>&, const std::string&) {
        return path + ": " + variant_name(study, i, values);
      };
      check_geometry(variant.scene, where);
      // Where refusals are marked its stage does so.
      if (!study.directions.empty() && !study.marks_refusals) check_inertia(variant.scene, where);
    }
    variants.push_back({body_hash(slice), values});
    if (slices.emplace(variants.back().name, slice).second) of_pair[pair].push_back(variants.back().name);
  }
  if (slices.size() == 1 && study.variants > 1)
    fail(Failure::input, path, ": the study varies nothing: all ", study.variants,
         " variants are alike, because what its stage computes depends on none of the keys");

  // Together: program ids, results and slices keep their order.
  if (const int moved = bring_to_present({home, folder + "/bodies", ids}); moved > 0)
    tell("gear-study: ", home, ": ", moved, " files had times in the future and have those of now instead");
  for (const auto& [hash, text] : bodies) publish_if_changed(folder + "/bodies/" + hash + "/body.toml", text);
  for (const auto& [hash, text] : slices) publish_if_changed(home + variant_file(hash) + ".toml", text);
  publish_if_changed(home + "plan.toml", plan_text(study, variants));

  const std::string prefix = "STUDY_" + stem + "_";
  std::ostringstream out;
  out << "# Written by gear-study from " << in_comment(recorded_path(path)) << "\n" << prefix << "PAIRS :=";
  for (const auto& [pair, names] : of_pair) out << " " << pair;
  for (const auto& [pair, names] : of_pair) {
    out << "\n" << prefix << pair << " :=";
    for (const std::string& name : names) out << " " << variant_file(name);
  }
  out << "\n" << prefix << "GEARS := " << gears;
  out << "\n" << prefix << "OPTIONS :=" << (study.marks_refusals ? "--mark-refusals" : "") << "\nBODIES +=";
  for (const auto& [hash, text] : bodies) out << " " << hash;
  out << "\n";
  publish(output, out.str());
  std::vector<GatheredVariant> compared = variants;
  if (study.random) add_probes(study, compared);
  for (const std::string& key : keys_without_effect(study, compared))
    tell("gear-study: warning: ", path, ": ", key, " changes nothing that this study computes",
         study.directions.empty() ? ", the pair at rest; if it acts in motion, say stage = \"sweep\"" : "");
  tell("gear-study: ", path, ": ", study.variants, " variants, ",
       slices.size() < variants.size() ? text(slices.size(), " of them different, ") : "", bodies.size(),
       bodies.size() == 1 ? " body" : " bodies");
}

void gather(int argc, char** argv, const std::string& path, const std::string& output) {
  StudyArtifact study;
  std::tie(study.plan, study.variants) = read_plan(path);
  const std::string home = std::filesystem::path(path).parent_path().string() + "/";
  std::vector<std::string> inputs{"plan=" + path};
  std::set<std::string> listed;
  for (const GatheredVariant& variant : study.variants)
    if (listed.insert(variant.name).second)
      inputs.push_back("variant=" + home + variant_file(variant.name) + ".h5");
  const Provenance provenance = made_by(argc, argv, inputs);

  const std::vector<AnswerKind> kinds = answer_kinds(study.plan.directions);
  std::vector<Eigen::Index> column;
  for (const std::string& answer : study.plan.answers)
    column.push_back(
        std::find_if(kinds.begin(), kinds.end(), [&](const AnswerKind& k) { return k.name == answer; }) -
        kinds.begin());
  study.answer.setZero(static_cast<Eigen::Index>(study.variants.size()),
                       static_cast<Eigen::Index>(column.size()));
  study.unsteady.setZero(static_cast<Eigen::Index>(study.variants.size()));
  long refused = 0, unsteady = 0;
  for (size_t v = 0; v < study.variants.size(); ++v) {
    const std::string file = home + variant_file(study.variants[v].name) + ".h5";
    const VariantArtifact variant = read_variant(file);
    if (variant.directions != study.plan.directions)
      fail(Failure::input, file, ": is of another stage than the study; ", rebuild_advice(file));
    study.refusal.push_back(variant.refusal);
    // Marked when the study said so; its file is up to date, so nobody but this asks again.
    if (!variant.refusal.empty() && !study.plan.marks_refusals)
      fail(Failure::input, path, ": ",
           variant_name(study.plan, static_cast<long>(v), study.variants[v].values),
           " was refused: ", variant.refusal, "; take it out, or say refusals = \"mark\"");
    if (!variant.refusal.empty()) {
      if (++refused <= kShownRefusals)
        tell(
            "gear-study: warning: ", variant_name(study.plan, static_cast<long>(v), study.variants[v].values),
            " was refused: ", variant.refusal);
      continue;
    }
    for (size_t i = 0; i < column.size(); ++i)
      study.answer(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(i)) = variant.answer[column[i]];
    // Counted whether or not the study asks for it: the other answers of such a speed are those of a motion that goes on changing.
    for (size_t i = 0; i < kinds.size(); ++i)
      if (kinds[i].name.starts_with(kUnsteady))
        study.unsteady[static_cast<Eigen::Index>(v)] +=
            static_cast<int>(variant.answer[static_cast<Eigen::Index>(i)]);
    unsteady += study.unsteady[static_cast<Eigen::Index>(v)] > 0;
  }
  write(output, study, provenance);
  tell("gear-study: ", study.plan.title, ": ", study.variants.size(), " variants",
       refused > 0 ? text(", ", refused, " of them refused and marked so") : "", " -> ", output);
  if (unsteady > 0)
    tell("gear-study: warning: ", unsteady, " variants have speeds at which no periodic motion was found; ",
         "they are marked so");
}

void body(int argc, char** argv) {
  std::string path, plan_path, output, ids, folder = "out";
  whine::Options options{"Expands a study into its variants, and gathers their response quantities",
                         "gear-study"};
  Option study_option = options.add("--study", path, "study file (TOML)");
  Option gather_option = options.add("--gather", plan_path, "plan.toml of a study whose variants are there");
  options.add("--output", output, "make fragment to write; with --gather study.h5").required();
  options.add("--out", folder, "folder of the artifacts").show_default();
  options.add("--ids", ids,
              "folder of the programs' hashes, whose times in the future become those of now, too");
  study_option.excludes(gather_option);
  options.footer(
      "Example:\n"
      "  gear-study --study data/studies/damping-torque-relief.toml --output "
      "build/studies/damping-torque-relief.mk");
  options.parse(argc, argv);
  if (path.empty() == plan_path.empty()) fail(Failure::usage, "--study or --gather is needed; see --help");
  if (!path.empty())
    plan(path, output, folder, ids);
  else
    gather(argc, argv, plan_path, output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
