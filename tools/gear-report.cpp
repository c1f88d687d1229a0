// gear-report: the report of a scene as one HTML page, from the artifacts and the figures that the scene asks for.
//
// Reads      static.h5 (their order is that of the torques), impact.h5 and sweep.h5 of one scene, error_budget.h5; figures that
//            gear-plot has drawn, as .png; params/title.txt in the folder of the scene, if there is one
// Writes     --output: the page; results.tsv beside it, the numbers of its first table
// Equations  none
// Example    gear-report --output report/index.html out/parker2000/T100/static.h5
//              out/parker2000/T100/{up,down}/sweep.h5 out/parker2000/report/fig12.png
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "io/error_budget_codec.h"
#include "io/impact_codec.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/static_codec.h"
#include "io/summary.h"
#include "io/sweep_codec.h"
#include "report/report.h"
#include "signal/response.h"
#include "studies/sweep.h"

namespace {

using namespace whine;

ReportPicture read_picture(const std::string& path) {
  const ReportPicture picture{std::filesystem::path(path).stem().string(),
                              read_bytes(path, "make the figure first")};
  const bool whole =
      picture.bytes.rfind("\x89PNG", 0) == 0 && picture.bytes.find("IEND") != std::string::npos;
  if (!whole) fail(Failure::input, path, ": is no whole PNG; delete it and make the figure again");
  return picture;
}

// Of a sweep only what it says: the motions of teeth that differ are large.
ReportSweep read_sweep_of(const ReportContent& content, const std::string& path) {
  const SweepArtifact sweep = read_sweep(path);
  if (sweep.model != SweepArtifact().model)
    fail(Failure::input, path, ": is of the lumped model ", sweep.model,
         "; a report is of the elastic pair: give the sweep.h5 in T<torque>/up or T<torque>/down");
  for (const StaticArtifact& statics : content.statics)
    if (statics.torque == sweep.torque)
      return {response(sweep), remarks(sweep, statics), backlash_left(sweep)};
  fail(Failure::input, path, ": is at ", sweep.torque, " N m, at which no static.h5 is given; give it, too");
}

void body(int argc, char** argv) {
  whine::Options options{"Writes the report of a scene from its artifacts and figures", "gear-report"};
  std::vector<std::string> inputs;
  std::string output;
  options.add("inputs", inputs, "artifacts (.h5) and figures (.png) of one scene").required();
  options.add("--output", output, "page to write (.html); results.tsv stands beside it").required();
  options.footer(
      "Example:\n"
      "  gear-report --output report/index.html out/parker2000/T150/static.h5 "
      "out/parker2000/T150/up/sweep.h5 out/parker2000/T150/down/sweep.h5");
  options.parse(argc, argv);

  // 1. Pictures, and artifacts in two passes: what a sweep warns of depends on the statics at its torque.
  ReportContent content;
  std::vector<std::string> sweeps;
  for (const std::string& path : inputs) {
    if (path.ends_with(".png")) {
      content.pictures.push_back(read_picture(path));
      continue;
    }
    require_fresh(path);
    content.sources.push_back({recorded_path(path), sha256_of_file(path), read_origin(path)});
    if (content.scene.empty()) content.scene = scene_words(path);
    const std::string& schema = content.sources.back().origin.schema;
    if (schema == "whine/static") {
      content.statics.push_back(read_static(path));
    } else if (schema == "whine/impact") {
      content.impacts.push_back(read_impact(path));
    } else if (schema == "whine/error_budget") {
      content.budget = read_error_budget(path);
    } else if (schema == "whine/sweep") {
      sweeps.push_back(path);
    } else {
      fail(Failure::usage, path, ": is ", schema,
           "; a report is made of static.h5, impact.h5, sweep.h5 and error_budget.h5");
    }
  }
  for (const std::string& path : sweeps) content.sweeps.push_back(read_sweep_of(content, path));
  if (content.scene.empty()) content.scene = "gear pair";

  // 2. Write.
  const std::string page = report_html(content), table = report_tsv(content);
  publish((std::filesystem::path(output).parent_path() / "results.tsv").string(), table);
  publish(output, page);
  tell("gear-report: ", content.scene, ": ", content.statics.size(), " torques, ", content.sweeps.size(),
       " sweeps, ", content.pictures.size(), " figures, ", page.size() / 1000, " kB -> ", output);
}

}  // namespace

int main(int argc, char** argv) {
  return run_tool(argc, argv, body);
}
