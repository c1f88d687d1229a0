// gear-report: the report of a scene as one HTML page, from the artifacts and the figures that the scene asks for.
//
// Reads      static.h5 (their order is that of the torques), impact.h5, response.h5 and sweep_errors.h5 of one scene, error_budget.h5,
//            modes.h5, of rigid gears this alone; figures that gear-plot has drawn, as .png; params/title.txt in the folder of the
//            scene, if there is one
// Writes     --output: the page; results.tsv beside it, the numbers of its first tables; with --teeth the page alone
// Equations  none
// Example    gear-report --output report/index.html out/parker2000/T100/static.h5
//              out/parker2000/T100/{up,down}/response.h5 out/parker2000/report/fig12.png
//            gear-report --output report/index.html out/three-in-line/T60/static.h5 out/three-in-line/modes.h5
#include <filesystem>
#include <string>
#include <vector>

#include "base/tool.h"
#include "io/publish.h"
#include "paper/beside.h"
#include "report/report.h"
#include "report/report_inputs.h"
#include "report/teeth_page.h"

namespace {

using namespace whine;

void body(int argc, char** argv) {
  whine::Options options{"Writes the report of a scene from its artifacts and figures", "gear-report"};
  std::vector<std::string> inputs;
  std::string output;
  bool teeth = false;
  options.add("inputs", inputs, "artifacts (.h5) and figures (.png) of one scene").required();
  options.add("--output", output, "page to write (.html); results.tsv stands beside it").required();
  options.flag(
      "--teeth", teeth,
      "what the teeth suffer at the first torque: root stress, flank pressure, dynamic factors; figures in ../report/ of the page, no results.tsv");
  options.footer(
      "Examples:\n"
      "  gear-report --output report/index.html out/parker2000/T150/static.h5 out/parker2000/T150/up/response.h5 out/parker2000/T150/down/response.h5\n"
      "  gear-report --output report/index.html out/three-in-line/T60/static.h5 out/three-in-line/modes.h5");
  options.parse(argc, argv);

  ReportContent content = read_report_content(inputs);
  name_figures_of_paper(content);
  if (teeth) {
    content.figure_folder = "../report/";
    publish(output, teeth_html(content));
    log_line("gear-report: teeth of ", content.scene, ": ", content.pictures.size(), " figures -> ", output);
    return;
  }
  const std::string page = report_html(content), table = report_tsv(content);
  publish_all(
      {{(std::filesystem::path(output).parent_path() / "results.tsv").string(), table}, {output, page}});
  log_line("gear-report: ", content.scene, ": ", content.statics.size(), " torques, ", content.sweeps.size(),
           " sweeps, ", content.pictures.size(), " figures, ", page.size() / 1000, " kB -> ", output);
}

}  // namespace

int main(int argc, char** argv) {
  return run_tool(argc, argv, body);
}
