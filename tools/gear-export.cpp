// gear-export: results of a pair beside the REXS model that its scene was imported from.
//
// Reads      a REXS model (.rexs, .rexsj, .rexsz); static.h5, impact.h5, response.h5 of one scene
// Writes     --output: the model in the same form, its stage with the results as custom attributes (custom_whine_...); over an
//            earlier export, never over another file
// Equations  none; SI to units of REXS
#include <filesystem>

#include "base/error.h"
#include "base/tool.h"
#include "io/publish.h"
#include "io/rexs/results.h"
#include "report/exported_results.h"
#include "report/report_inputs.h"

namespace {

using namespace whine;

void require_replaceable(const std::string& output) {
  if (!std::filesystem::exists(output)) return;
  bool ours = false;
  try {
    ours = holds_results(output);
  } catch (const Error&) {
    // No model: another file, which stays.
  }
  if (!ours)
    fail(Failure::usage, output,
         " exists and holds no results of Whine; an export replaces no model: name another --output");
}

void body(int argc, char** argv) {
  Options options{"Writes the results of a pair beside its REXS model", "gear-export"};
  std::vector<std::string> inputs;
  std::string model, output, stage;
  options.add("inputs", inputs, "artifacts (.h5) of one scene, as gear-report takes them").required();
  options.add("--model", model, "REXS model that the scene was imported from: .rexs, .rexsj or .rexsz")
      .required();
  options.add("--stage", stage, "id or name of the stage, where the model has several");
  options.add("--output", output, "model with the results, of the same form").required();
  options.footer(
      "Example:\n"
      "  gear-export --model data/examples/parker2000.rexsj --output with-results.rexsj out/parker2000/T150/static.h5 out/parker2000/T150/up/response.h5 out/parker2000/T150/down/response.h5");
  options.parse(argc, argv);
  require_replaceable(output);

  const ReportContent content = read_report_content(inputs);
  const RexsPair pair = exported_pair(content);
  const std::vector<RexsResult> results = exported_results(content);
  publish(output, with_results(model, read_bytes(model), stage, pair, results));
  log_line("gear-export: ", content.scene, ": ", results.size(), " results at ", content.statics.size(),
           " torques beside ", model, " -> ", output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
