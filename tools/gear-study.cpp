// gear-study: what variants a study has and where they come from; afterwards, their response quantities in one file.
//
// Reads      a study (TOML) and the scene that it names; with --gather its plan and the artifact of each variant
// Writes     <out>/studies/<study>/variants/ab/ab12....toml    stage parameters of each variant, replaced only if they change
//            <out>/studies/<study>/plan.toml                   the variants, their values, what is gathered
//            <out>/bodies/<hash>/body.toml                     one per distinct gear
//            --output                                          make fragment: variants by their pair of bodies
//            --gather: study.h5 instead, a row for each variant
// Equations  none; variants are scenes as gear-scene --set makes them, draws as io/study.h says
// Example    gear-study --study data/studies/tolerances.toml --output build/studies/tolerances.mk --out out
//            gear-study --gather out/studies/tolerances/plan.toml --output out/studies/tolerances/study.h5
#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/scene.h"
#include "io/study_expansion.h"
#include "io/study_result.h"
#include "io/variant.h"

namespace {

using namespace whine;

constexpr size_t kShownOutside = 5;

void plan(const std::string& path, const std::string& output, const std::string& folder,
          const std::string& ids) {
  const std::string stem = std::filesystem::path(path).stem().string();
  if (!plain_name(stem))
    fail(
        Failure::input, path, ": the name '", stem,
        "' becomes a folder and a make target, so it may hold letters, digits, '_' and '-' only; rename the file");
  // 1. The whole study is checked before anything is written.
  const std::string home = folder + "/studies/" + stem + "/";
  const ExpandedStudy plan = expand_study(path, home);

  // 2. Together: program ids, results and stage parameters keep their order.
  if (const int moved = bring_to_present({home, folder + "/bodies", ids}); moved > 0)
    log_line("gear-study: ", home, ": ", moved,
             " files had times in the future and have those of now instead");
  for (const auto& [hash, text] : plan.bodies)
    publish_if_changed(folder + "/bodies/" + hash + "/body.toml", text);
  for (const auto& [hash, text] : plan.parameters)
    publish_if_changed(home + variant_file(hash) + ".toml", text);
  publish_if_changed(home + "plan.toml", plan_text(plan.study, plan.variants));
  publish(output, study_fragment(plan, path, stem));

  for (const std::string& key : idle_keys(plan))
    log_line("gear-study: warning: ", path, ": ", key, " changes nothing that this study computes",
             plan.study.directions.empty() ? ", the pair at rest; if it acts in motion, say stage = \"sweep\""
                                           : "");
  const size_t parameters = plan.parameters.size(), bodies = plan.bodies.size();
  log_line("gear-study: ", path, ": ", plan.study.variants, " variants, ",
           parameters < plan.variants.size() ? text(parameters, " of them different, ") : "", bodies,
           bodies == 1 ? " body" : " bodies");
}

void gather(int argc, char** argv, const std::string& path, const std::string& output) {
  // 1. Each variant is an input, once.
  const std::string home = std::filesystem::path(path).parent_path().string() + "/";
  std::vector<std::string> inputs{"plan=" + path};
  std::set<std::string> listed;
  for (const GatheredVariant& variant : read_plan(path).second)
    if (listed.insert(variant.name).second)
      inputs.push_back("variant=" + home + variant_file(variant.name) + ".h5");
  const Provenance provenance = made_by(argc, argv, inputs);

  // 2. What they answered.
  const GatheredStudy gathered = gather_study(path);
  const size_t rejected = gathered.rejected.size();
  for (size_t i = 0; i < std::min(rejected, kShownOutside); ++i)
    log_line("gear-study: warning: ", gathered.rejected[i]);
  write(output, gathered.study, provenance);
  log_line("gear-study: ", gathered.study.plan.title, ": ", gathered.study.variants.size(), " variants",
           rejected > 0 ? text(", ", rejected, " of them outside the model's range and marked so") : "",
           " -> ", output);
  if (gathered.unsteady > 0)
    log_line("gear-study: warning: ", gathered.unsteady,
             " variants have speeds at which no periodic motion was found; ", "they are marked so");
}

// A variant that the study marks, as a scene.
void write_design(const std::string& path, const std::string& which, const std::string& output) {
  const Study study = read_study(path);
  publish_if_changed(output, scene_variant(study.scene, design_changes(study, which == "first" ? 0 : 1)));
}

void body(int argc, char** argv) {
  std::string path, plan_path, output, ids, design, folder = "out";
  whine::Options options{"Expands a study into its variants, and gathers their response quantities",
                         "gear-study"};
  Option study_option = options.add("--study", path, "study file (TOML)");
  Option gather_option = options.add("--gather", plan_path, "plan.toml of a study whose variants are there");
  options
      .add(
          "--output", output,
          "file to write: one that make includes, of the variants; with --gather study.h5, with --design a scene")
      .required();
  options.add("--out", folder, "folder of the artifacts").show_default();
  options.add(
      "--ids", ids,
      "folder of the files that tell make which programs have changed: those with a time in the future get the time of now");
  options
      .add("--design", design,
           "with --study: a scene of the first or the second variant that it marks by compare = [0, 3]")
      .one_of({"first", "second"})
      .needs(study_option);
  study_option.excludes(gather_option);
  options.footer(
      "Example:\n"
      "  gear-study --study data/studies/damping-torque-relief.toml --output build/studies/damping-torque-relief.mk");
  options.parse(argc, argv);
  if (path.empty() == plan_path.empty()) fail(Failure::usage, "--study or --gather is needed; see --help");
  if (!design.empty())
    write_design(path, design, output);
  else if (!path.empty())
    plan(path, output, folder, ids);
  else
    gather(argc, argv, plan_path, output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
