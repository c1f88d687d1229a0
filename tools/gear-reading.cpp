// gear-reading: readings of P2000, compared with its claims.
//
// Reads      a plan of readings (TOML) and the scene that it names; or parts of a search; or readings.h5 and sets of claims
// Writes     readings.h5: each reading, what it is fitted to, and its verdict on every claim; with --sets <output>.md and
//            <output>.tsv: which sets of claims hold together
// Equations  none of its own; paper/reading.h says what is tied to which printed number
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/readings.h"
#include "io/scene.h"
#include "paper/consistency.h"
#include "paper/reading.h"

namespace {

using namespace whine;

// Pairs that share a tooth form and a plane state stand together; a part takes whole families.
bool same_family(const OpenChoices& a, const OpenChoices& b) {
  return a.dedendum == b.dedendum && a.rack_tip_share == b.rack_tip_share &&
         a.tooth_thinning == b.tooth_thinning && a.plane == b.plane;
}

std::string pair_words(const OpenChoices& pair, int readings) {
  const std::string corner =
      !pair.corner.enabled ? "no corner contact"
      : std::isinf(pair.corner.largest_angle)
          ? "corner contact at any angle"
          : text("corner contact to ", pair.corner.largest_angle * 180 / std::numbers::pi, " deg");
  return text("dedendum ", pair.dedendum, ", rack tip ", pair.rack_tip_share, " of the largest, plane ",
              pair.plane, ", ", corner, ": ", readings, " readings");
}

ReadingsArtifact run_part(const ReadingPlan& plan, const Scene& scene, int part, int parts) {
  ReadingsArtifact out;
  out.title = plan.title;
  for (const Claim& claim : paper_claims()) out.claim.push_back(claim.id);
  const std::vector<OpenChoices> pairs = pairs_of(plan);
  std::optional<BoreFamily> family;
  int number = -1;
  Progress progress("gear-reading", static_cast<long>(pairs.size()));
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (i == 0 || !same_family(pairs[i], pairs[i - 1])) {
      ++number;
      family.reset();
    }
    if (number % parts != part - 1) continue;
    const auto left_out = [&](const Error& error, int count) {
      tell("gear-reading: outside the model: dedendum ", pairs[i].dedendum, ", pair ", i, ": ", error.what());
      out.outside += count;
    };
    try {
      if (!family) family.emplace(scene, pairs[i]);
      PaperPair pair(*family, family->tied_bore(pairs[i].corner), scene, pairs[i], {});
      for (int r = 0; r < plan.readings; ++r) try {
          out.readings.push_back(pair.evaluate(draw(plan, pairs[i], static_cast<int>(i), r)));
        } catch (const Error& error) {
          left_out(error, 1);
        }
    } catch (const Error& error) {
      left_out(error, plan.readings);
    }
    progress.update(static_cast<long>(i) + 1);
  }
  return out;
}

// The best readings once more, with strips and finer steps of the speed.
ReadingsArtifact confirmed(const ReadingsArtifact& readings, const Scene& scene, int count) {
  const Consistency found = consistency(readings, {});
  ReadingsArtifact out;
  out.title = readings.title + ", the best confirmed";
  out.contact = kConfirming.contact;
  out.claim = readings.claim;
  Progress progress("gear-reading", count);
  for (const size_t i : found.order) {
    const Reading& reading = readings.readings[i];
    const bool known = std::any_of(out.readings.begin(), out.readings.end(), [&](const Reading& r) {
      return words_of(r) == words_of(reading);  // draws repeat
    });
    if (known) continue;
    try {
      BoreFamily family(scene, reading.choices);
      PaperPair pair(family, reading.bore_radius, scene, reading.choices, kConfirming);
      out.readings.push_back(pair.judge(reading));
      const auto& verdict = out.readings.back().verdict;
      tell("gear-reading: ", found.agreeing[i], " -> ", std::count(verdict.begin(), verdict.end(), 0),
           " claims agree: ", words_of(reading));
    } catch (const Error& error) {
      tell("gear-reading: outside the model: ", words_of(reading), ": ", error.what());
      ++out.outside;
    }
    progress.update(static_cast<long>(out.readings.size()) + out.outside);
    if (static_cast<int>(out.readings.size()) + out.outside == count) break;
  }
  return out;
}

ReadingsArtifact gathered(const std::vector<std::string>& parts) {
  ReadingsArtifact out;
  for (const std::string& path : parts) {
    ReadingsArtifact part = read_readings(path);
    if (out.claim.empty()) {
      out = std::move(part);
      continue;
    }
    if (part.claim != out.claim)
      fail(Failure::input, path, ": is of other claims than ", parts.front(), "; make it again");
    out.readings.insert(out.readings.end(), part.readings.begin(), part.readings.end());
    out.outside += part.outside;
  }
  return out;
}

void body(int argc, char** argv) {
  Options options{"Readings of P2000 compared with its claims", "gear-reading"};
  std::string plan_path, output, sets, confirm, scene_path, part = "1/1";
  bool list = false;
  std::vector<std::string> parts;
  options.add("inputs", parts, "parts to put together; with --sets one readings.h5");
  options.add("--plan", plan_path, "plan of the readings: data/studies/reading.toml");
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
    if (parts.size() != 1 || scene_path.empty() || !(count >= 1 && count <= 1000))
      fail(Failure::usage, "--confirm takes a number from 1 to 1000, one readings.h5 and --scene");
    const Provenance provenance = made_by(argc, argv, {"readings=" + parts.front(), "scene=" + scene_path});
    const ReadingsArtifact best =
        confirmed(read_readings(parts.front()), read_scene(scene_path), static_cast<int>(count));
    write(output, best, provenance);
    tell("gear-reading: ", best.readings.size(), " readings confirmed with strips -> ", output);
    return;
  }
  if (!sets.empty()) {
    if (parts.size() > 2)
      fail(Failure::usage, "--sets takes readings.h5 and, if there is one, confirmed.h5; ", parts.size(),
           " are given");
    const ReadingsArtifact readings = read_readings(parts.front());
    const Consistency found = consistency(readings, read_claim_sets(sets));
    std::string page = consistency_markdown(readings, found);
    if (parts.size() == 2) page += confirmed_markdown(read_readings(parts.back()));
    for (const std::string& path : parts) require_fresh(path);
    publish(output + ".md", page);
    publish(output + ".tsv", readings_tsv(readings, found));
    tell("gear-reading: ", found.sets.size(), " sets of claims, ", found.conflicts.size(),
         " pairs of claims that never meet -> ", output, ".{md,tsv}");
    return;
  }
  if (!parts.empty()) {
    const Provenance provenance = [&] {
      std::vector<std::string> inputs;
      for (size_t i = 0; i < parts.size(); ++i) inputs.push_back(text("part_", i + 1, "=", parts[i]));
      return made_by(argc, argv, inputs);
    }();
    const ReadingsArtifact all = gathered(parts);
    write(output, all, provenance);
    tell("gear-reading: ", all.readings.size(), " readings, ", all.outside, " outside the model -> ", output);
    return;
  }
  int number = 0, of = 0;
  char rest = 0;
  if (std::sscanf(part.c_str(), "%d/%d%c", &number, &of, &rest) != 2 || of < 1 || number < 1 || number > of)
    fail(Failure::usage, "--part ", part, ": it is i/n, the i-th of n parts, such as 3/40");
  const Provenance provenance = made_by(argc, argv, {"plan=" + plan_path});
  const ReadingPlan plan = read_reading_plan(plan_path);
  const ReadingsArtifact result = run_part(plan, read_scene(plan.scene), number, of);
  write(output, result, provenance);
  tell("gear-reading: ", result.readings.size(), " readings, ", result.outside, " outside the model -> ",
       output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
