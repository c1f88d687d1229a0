#include "report/report_inputs.h"

#include <filesystem>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifact_kinds.h"
#include "io/artifacts.h"
#include "io/picture_sources.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/scene_words.h"
#include "report/sweep_panels.h"

namespace whine {
namespace {

ReportPicture read_picture(const std::string& path, const std::string& scene) {
  const ReportPicture picture{std::filesystem::path(path).stem().string(),
                              read_bytes(path, "make the figure first")};
  const bool whole =
      picture.bytes.rfind("\x89PNG", 0) == 0 && picture.bytes.find("IEND") != std::string::npos;
  if (!whole) fail(Failure::input, path, ": is no whole PNG; delete it and make the figure again");
  require_fresh_picture(path, picture.bytes, scene);
  return picture;
}

// Where an artifact comes from; all are of one scene.
void take_source(const std::string& path, ReportContent& content) {
  require_fresh(path);
  content.sources.push_back({recorded_path(path), sha256_of_file(path), read_origin(path)});
  const std::string scene = scene_words(path);
  if (content.scene.empty()) content.scene = scene;
  if (!scene.empty() && scene != content.scene)
    fail(Failure::input, path, ": is of the scene ", scene, ", artifacts before it are of ", content.scene,
         "; give artifacts of one scene");
}

// Artifacts that were made from different versions of one file do not belong together: modes of other statics, sweeps with
// other bodies.
void require_one_origin(const std::vector<ReportSource>& sources) {
  std::map<std::string, std::pair<std::string, std::string>>
      seen;  // [path] SHA-256, and which artifact says so
  for (const ReportSource& source : sources) seen[source.path] = {source.sha256, source.path};
  for (const ReportSource& source : sources)
    for (const InputRecord& input : source.origin.inputs) {
      const auto [at, first] = seen.try_emplace(input.path, input.sha256, source.path);
      if (!first && at->second.first != input.sha256)
        fail(Failure::input, source.path, ": was made from another ", input.path, " than ", at->second.second,
             "; make both again from one");
    }
}

}  // namespace

ReportContent read_report_content(const std::vector<std::string>& paths) {
  ReportContent content;
  std::vector<std::string> pictures;  // last: they know the scene of the artifacts
  for (const std::string& path : paths) {
    if (path.ends_with(".png")) {
      pictures.push_back(path);
      continue;
    }
    take_source(path, content);
    const std::string& schema = content.sources.back().origin.schema;
    if (schema == "whine/static")
      content.statics.push_back(read<SystemStaticResult>(path));
    else if (schema == "whine/impact")
      content.impacts.push_back(read<ImpactResult>(path));
    else if (schema == "whine/error_budget")
      content.budget = read<ErrorBudgetResult>(path);
    else if (schema == "whine/sweep_errors")
      content.errors.push_back(read<SweepErrorsResult>(path));
    else if (schema == "whine/modes" && !content.modes)
      content.modes = read<ModesResult>(path);
    else if (schema == "whine/response") {
      const ResponseResult& sweep = content.sweeps.emplace_back(read<ResponseResult>(path));
      if (!elastic(sweep))
        fail(Failure::input, path, ": is of the lumped model ", sweep.model,
             "; a report is of elastic gears: give the response.h5 in T<torque>/up or T<torque>/down");
    } else
      fail(
          Failure::usage, path, ": is ", schema == "whine/modes" ? "a second " : "", schema,
          "; a report is made of static.h5, impact.h5, response.h5, error_budget.h5, sweep_errors.h5 and one modes.h5");
  }
  for (const std::string& path : pictures) content.pictures.push_back(read_picture(path, content.scene));
  if (content.scene.empty()) content.scene = "gears";
  require_one_origin(content.sources);
  return content;
}

}  // namespace whine
