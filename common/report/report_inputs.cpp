#include "report/report_inputs.h"

#include <filesystem>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifact_kinds.h"
#include "io/artifacts.h"
#include "io/pair_inputs.h"
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

ResponseResult read_response_of(const ReportContent& content, const std::string& path) {
  ResponseResult out = read_pair_response(path);
  if (!elastic(out))
    fail(Failure::input, path, ": is of the lumped model ", out.model,
         "; a report is of the elastic pair: give the response.h5 in T<torque>/up or T<torque>/down");
  for (const StaticResult& statics : content.statics)
    if (statics.torque == out.torque) return out;
  fail(Failure::input, path, ": is at ", out.torque, " N m, at which no static.h5 is given; give it, too");
}

// Where an artifact comes from; all are of one scene.
template <class Content>
void take_source(const std::string& path, Content& content) {
  require_fresh(path);
  content.sources.push_back({recorded_path(path), sha256_of_file(path), read_origin(path)});
  const std::string scene = scene_words(path);
  if (content.scene.empty()) content.scene = scene;
  if (!scene.empty() && scene != content.scene)
    fail(Failure::input, path, ": is of the scene ", scene, ", artifacts before it are of ", content.scene,
         "; give artifacts of one scene");
}

// take(path, schema): of each artifact, in order. Pictures last: they know the scene of the artifacts.
template <class Content>
void read_content(const std::vector<std::string>& paths, const char* unnamed, Content& content,
                  const auto& take) {
  std::vector<std::string> pictures;
  for (const std::string& path : paths) {
    if (path.ends_with(".png")) {
      pictures.push_back(path);
      continue;
    }
    take_source(path, content);
    take(path, content.sources.back().origin.schema);
  }
  for (const std::string& path : pictures) content.pictures.push_back(read_picture(path, content.scene));
  if (content.scene.empty()) content.scene = unnamed;
}

}  // namespace

bool is_of_system(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    if (path.ends_with(".png")) continue;
    const Origin origin = read_origin(path);
    // A train has no torque of its own, its drives have.
    if (origin.schema == "whine/modes" || (origin.schema == "whine/static" && !origin.has_torque))
      return true;
  }
  return false;
}

namespace {

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

SystemReport read_system_report(const std::vector<std::string>& paths) {
  SystemReport report;
  read_content(paths, "system of gears", report, [&](const std::string& path, const std::string& schema) {
    const bool rest = schema == "whine/static";
    if (schema == "whine/response") {
      report.sweeps.push_back(read<ResponseResult>(path));
      return;
    }
    if (!rest && schema != "whine/modes")
      fail(Failure::usage, path, ": is ", schema,
           "; the report of a system is made of static.h5, modes.h5 and response.h5");
    if (rest ? report.rest.has_value() : report.modes.has_value())
      fail(Failure::usage, path, ": a second ", schema, "; give one of each");
    if (rest)
      report.rest = read<SystemStaticResult>(path);
    else
      report.modes = read<ModesResult>(path);
  });
  require_one_origin(report.sources);
  return report;
}

ReportContent read_report_content(const std::vector<std::string>& paths) {
  ReportContent content;
  std::vector<std::string> sweeps;  // last: each has its statics
  read_content(paths, "gear pair", content, [&](const std::string& path, const std::string& schema) {
    if (schema == "whine/static")
      content.statics.push_back(read_pair_statics(path));
    else if (schema == "whine/impact")
      content.impacts.push_back(read_pair_impact(path));
    else if (schema == "whine/error_budget")
      content.budget = read<ErrorBudgetResult>(path);
    else if (schema == "whine/sweep_errors")
      content.errors.push_back(read<SweepErrorsResult>(path));
    else if (schema == "whine/response")
      sweeps.push_back(path);
    else
      fail(Failure::usage, path, ": is ", schema,
           "; a report is made of static.h5, impact.h5, response.h5, error_budget.h5 and sweep_errors.h5");
  });
  for (const std::string& path : sweeps) content.sweeps.push_back(read_response_of(content, path));
  require_one_pair(content);
  return content;
}

}  // namespace whine
