// gear-scorecard: what P2000 prints, claim by claim, beside the results of scenes.
//
// Reads      the artifacts that `gear-scorecard --files` lists, of each scene; what P2000 prints (data/published/claims.toml)
// Writes     <output>.tsv, <output>.txt: every claim with its value in each scene, its deviation and its verdict, for programs and
//            for a terminal
#include <cstdio>

#include "base/error.h"
#include "base/tool.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "paper/scorecard.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"What P2000 prints beside the results of scenes", "gear-scorecard"};
  std::string output, printed, fitted;
  std::vector<std::string> inputs;
  bool files = false, claims = false;
  options.add("inputs", inputs, "artifacts: <scene>/<file> for each file that --files lists");
  options.add("--output", output, "path of the results without extension");
  options.add("--printed", printed, "what P2000 prints, claim by claim: data/published/claims.toml");
  options.add("--fitted", fitted,
              "which numbers of scenes were fitted to which claims: data/published/fitted.toml");
  options.flag("--files", files, "print which artifacts of a scene are read");
  options.flag(
      "--claims", claims,
      "print the claims, columns between tabs: id, place, text, unit, printed value, tolerance, what decides");
  options.footer(
      "Example:\n"
      "  gear-scorecard --claims --printed data/published/claims.toml");
  options.parse(argc, argv);

  if (files)
    for (const std::string& file : whine::scorecard_files()) std::puts(file.c_str());
  if (files && !claims) return;
  if (printed.empty()) whine::fail(whine::Failure::usage, "--printed is needed: data/published/claims.toml");
  const std::vector<whine::Claim> all = whine::read_claims(printed);
  if (claims) std::fputs(whine::claims_tsv(all).c_str(), stdout);
  if (claims) return;
  if (output.empty()) whine::fail(whine::Failure::usage, "--output is needed");
  if (inputs.empty())
    whine::fail(whine::Failure::usage, "artifacts of a scene are needed; --files lists them");

  const whine::Scorecard card =
      whine::score(all, whine::read_results(inputs),
                   fitted.empty() ? std::vector<whine::FittedNumber>{} : whine::read_fitted_numbers(fitted));
  for (const std::string& path : inputs) whine::require_fresh(path);
  std::vector<std::string> sources;
  sources.reserve(inputs.size());
  for (const std::string& path : inputs) sources.push_back(whine::recorded_path(path));
  whine::publish_all({{output + ".tsv", whine::scorecard_tsv(card, sources)},
                      {output + ".txt", whine::scorecard_text(card)}});
  for (const std::string& line : whine::bottom_line(card)) whine::log_line("gear-scorecard: ", line);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
