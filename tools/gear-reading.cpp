// gear-reading: readings of P2000, compared with its claims.
//
// Reads      a plan of readings (TOML), the scene that it names and what P2000 prints (data/published/claims.toml); or
//            parts of a search; or readings.h5 and sets of claims
// Writes     readings.h5: each reading, what it is fitted to, and its verdict on every claim; with --sets <output>_sets.tsv: which
//            sets of claims hold together, <output>.tsv: all readings, and, of confirmed.h5, <output>_best.tsv
// Equations  none of its own; paper/reading.h says what is tied to which printed number
#include <cstdio>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/readings.h"
#include "io/scene.h"
#include "paper/consistency.h"
#include "paper/reading_search.h"

namespace {

using namespace whine;

void look_for_sets(const std::vector<std::string>& parts, const std::string& sets,
                   const std::string& output) {
  if (parts.size() > 2)
    fail(Failure::usage, "--sets takes readings.h5 and, if there is one, confirmed.h5; ", parts.size(),
         " are given");
  const ReadingsResult readings = read<ReadingsResult>(parts.front());
  const Consistency found = consistency(readings, read_claim_sets(sets));
  std::vector<FileBytes> files{{output + "_sets.tsv", claim_sets_tsv(readings, found)},
                               {output + ".tsv", readings_tsv(readings, found)}};
  if (parts.size() == 2)
    files.push_back({output + "_best.tsv", confirmed_tsv(read<ReadingsResult>(parts.back()))});
  for (const std::string& path : parts) require_fresh(path);
  publish_all(files);
  log_line("gear-reading: ", found.sets.size(), " sets of claims, ", found.conflicts.size(),
           " pairs of claims that never meet -> ", output, "{,_sets,_best}.tsv");
}

void body(int argc, char** argv) {
  Options options{"Readings of P2000 compared with its claims", "gear-reading"};
  std::string plan_path, printed, output, sets, confirm, scene_path, part = "1/1";
  bool list = false;
  std::vector<std::string> parts;
  options.add("inputs", parts, "parts to put together; with --sets one readings.h5");
  options.add("--plan", plan_path, "plan of the readings: data/studies/reading.toml");
  options.add("--printed", printed,
              "with --plan and --confirm: what P2000 prints, data/published/claims.toml");
  options.add("--part", part, "i/n: the i-th of n parts of its tooth forms").show_default();
  options.add("--confirm", confirm,
              "how many of the best of readings.h5 to look at again with strips, as scenes do");
  options.add("--scene", scene_path, "with --confirm: the scene that the plans of the readings name");
  options.add("--sets", sets, "sets of claims to look for: data/published/claim_sets.toml");
  options.add("--output", output, "readings.h5 to write; with --sets path of the results without extension");
  options.flag("--list", list, "with --plan: print the pairs of gears and how many readings each has");
  options.footer(
      "Example:\n"
      "  gear-reading --plan data/studies/reading.toml --list");
  options.parse(argc, argv);
  if (list && !plan_path.empty()) {
    const ReadingPlan plan = read_reading_plan(plan_path);
    for (const OpenChoices& pair : pairs_of(plan)) std::puts(pair_words(pair, plan.readings).c_str());
    return;
  }
  if (output.empty()) fail(Failure::usage, "--output is needed; see --help");
  if (plan_path.empty() == parts.empty()) fail(Failure::usage, "give --plan, or the parts to put together");
  if (!confirm.empty()) {
    const double count = number_option("--confirm", confirm);
    if (parts.size() != 1 || scene_path.empty() || printed.empty() || !(count >= 1 && count <= 1000))
      fail(Failure::usage, "--confirm takes a number from 1 to 1000, one readings.h5, --scene and --printed");
    const Provenance provenance =
        made_by(argc, argv, {"readings=" + parts.front(), "scene=" + scene_path, "claims=" + printed});
    const ReadingsResult best = confirmed(read<ReadingsResult>(parts.front()), read_pair_scene(scene_path),
                                          static_cast<int>(count), read_claims(printed));
    write(output, best, provenance);
    log_line("gear-reading: ", best.readings.size(), " readings confirmed with strips -> ", output);
    return;
  }
  if (!sets.empty()) {
    look_for_sets(parts, sets, output);
    return;
  }
  if (!parts.empty()) {
    const Provenance provenance = [&] {
      std::vector<std::string> inputs;
      for (size_t i = 0; i < parts.size(); ++i) inputs.push_back(text("part_", i + 1, "=", parts[i]));
      return made_by(argc, argv, inputs);
    }();
    const ReadingsResult all = gathered(parts);
    write(output, all, provenance);
    log_line("gear-reading: ", all.readings.size(), " readings, ", all.outside, " outside the model -> ",
             output);
    return;
  }
  int number = 0, of = 0;
  char rest = 0;
  if (std::sscanf(part.c_str(), "%d/%d%c", &number, &of, &rest) != 2 || of < 1 || number < 1 || number > of)
    fail(Failure::usage, "--part ", part, ": it is i/n, the i-th of n parts, such as 3/40");
  if (printed.empty()) fail(Failure::usage, "--plan needs --printed: data/published/claims.toml");
  const Provenance provenance = made_by(argc, argv, {"plan=" + plan_path, "claims=" + printed});
  const ReadingPlan plan = read_reading_plan(plan_path);
  const ReadingsResult result = run_part(plan, read_pair_scene(plan.scene), number, of, read_claims(printed));
  write(output, result, provenance);
  log_line("gear-reading: ", result.readings.size(), " readings, ", result.outside, " outside the model -> ",
           output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
