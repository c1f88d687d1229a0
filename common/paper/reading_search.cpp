#include "paper/reading_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "paper/consistency.h"

namespace whine {
namespace {

// Pairs that share a tooth form and a plane state stand together.
bool same_family(const OpenChoices& a, const OpenChoices& b) {
  return a.dedendum == b.dedendum && a.rack_tip_share == b.rack_tip_share &&
         a.tooth_thinning == b.tooth_thinning && a.plane == b.plane;
}

}  // namespace

std::string pair_words(const OpenChoices& pair, int readings) {
  const std::string corner =
      !pair.corner.enabled ? "no corner contact"
      : std::isinf(pair.corner.largest_angle)
          ? "corner contact at any angle"
          : text("corner contact to ", pair.corner.largest_angle * 180 / std::numbers::pi, " deg");
  return text("dedendum ", pair.dedendum, ", rack tip ", pair.rack_tip_share, " of the largest, plane ",
              pair.plane, ", ", corner, ": ", readings, " readings");
}

ReadingsResult run_part(const ReadingPlan& plan, const Scene& scene, int part, int parts,
                        const std::vector<Claim>& claims) {
  ReadingsResult out;
  out.title = plan.title;
  for (const Claim& claim : claims) out.claim.push_back(claim.id);
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
      log_line("gear-reading: outside the model: dedendum ", pairs[i].dedendum, ", pair ", i, ": ",
               error.what());
      out.outside += count;
    };
    try {
      if (!family) family.emplace(scene, pairs[i]);
      PaperPair pair(*family, family->tied_bore(pairs[i].corner), scene, pairs[i], {}, claims);
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

ReadingsResult confirmed(const ReadingsResult& readings, const Scene& scene, int count,
                         const std::vector<Claim>& claims) {
  const Consistency found = consistency(readings, {});
  ReadingsResult out;
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
      PaperPair pair(family, reading.bore_radius, scene, reading.choices, kConfirming, claims);
      out.readings.push_back(pair.judge(reading));
      const auto& verdict = out.readings.back().verdict;
      log_line("gear-reading: ", found.agreeing[i], " -> ", std::count(verdict.begin(), verdict.end(), 0),
               " claims agree: ", words_of(reading));
    } catch (const Error& error) {
      log_line("gear-reading: outside the model: ", words_of(reading), ": ", error.what());
      ++out.outside;
    }
    progress.update(static_cast<long>(out.readings.size()) + out.outside);
    if (static_cast<int>(out.readings.size()) + out.outside == count) break;
  }
  return out;
}

ReadingsResult gathered(const std::vector<std::string>& parts) {
  ReadingsResult out;
  for (const std::string& path : parts) {
    ReadingsResult part = read<ReadingsResult>(path);
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

}  // namespace whine
