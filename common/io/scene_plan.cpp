#include "io/scene_plan.h"

#include <algorithm>
#include <sstream>

#include "base/error.h"
#include "base/format.h"
#include "gear/accuracy.h"
#include "gear/scene_cost.h"
#include "io/scene.h"
#include "io/scene_sections.h"

namespace whine {
namespace {

void add_row(std::ostringstream& out, const std::string& first, const std::string& second,
             const std::string& third, const std::string& fourth) {
  constexpr int kWide = 24, kNarrow = 14;
  const auto padded = [](const std::string& word, size_t width) {
    return word + std::string(word.size() < width ? width - word.size() : 1, ' ');
  };
  out << padded(first, kWide) << padded(second, kNarrow) << padded(third, kNarrow) << fourth << "\n";
}

std::string words_of(const Scene& scene, const KeyGiven& given) {
  constexpr double kPercent = 100, kMegabyte = 1e6;
  const DiscretisationPlan plan = discretisation_plan(scene, given);
  const double accepted = scene.time.accepted_error;
  std::ostringstream out;
  add_row(out, "setting", "value", "from", "error of the RMS in motion: a bound");
  for (const SettingError& one : plan.settings)
    add_row(out, one.key, shown(one.value, 4),
            one.given                   ? "scene"
            : accepted > 0 && one.known ? "accuracy"
                                        : "default",
            one.known ? shown(one.error * kPercent, 2) + " %" : "no law");
  const bool known = std::all_of(plan.settings.begin(), plan.settings.end(),
                                 [](const SettingError& one) { return one.known; });
  add_row(out, "root of their squares", "", "",
          shown(plan.error() * kPercent, 2) + (known ? " %" : " % of what has a law") +
              (accepted > 0
                   ? text("; accepted: ", shown(accepted * kPercent, 3), " %",
                          plan.error() > accepted * (1 + 1e-9)
                              ? ", which the settings that the scene gives do not allow"
                              : "")
                   : std::string("; [accuracy] rms_percent would choose settings by an accepted error")));
  out << "mesh resonance " << (scene.pair() ? "" : "of two gears alone, the highest, ") << "expected near "
      << fixed(plan.natural_frequency, 0) << " Hz, of 20 N/(mm um) and the inertias\n\n";
  add_row(out, "stage", "runs", "CPU (s) each", "memory (MB)");
  double all = 0;
  for (const StageCost& cost : stage_costs(scene)) {
    add_row(out, cost.stage, text(cost.runs), shown(cost.seconds, 2), fixed(cost.memory / kMegabyte, 0));
    all += cost.seconds * cost.runs;
  }
  add_row(out, "all", "", shown(all, 2),
          "within a factor of 3 where motions repeat soon; what is there already is not computed again");
  return out.str();
}

}  // namespace

std::string plan_words(const std::string& path) {
  const Source source(path);
  const Scene scene = read_scene(path);
  if (scene.rigid())
    fail(Failure::input, path,
         ": gears of body = \"rigid\" have no discretisation; there is nothing to plan");
  return words_of(scene, keys_given(source));
}

}  // namespace whine
