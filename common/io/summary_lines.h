// Lines of a summary, and the summaries of systems.
//
// Private to the layer io/.
#pragma once
#include <Eigen/Core>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "model/gear.h"
#include "results/modes.h"
#include "results/static.h"
#include "results/sweep.h"

namespace whine {

using SummaryLines = std::vector<std::pair<std::string, std::string>>;

// A line, numbers with 5 digits.
template <class... Parts>
void add(SummaryLines& lines, const std::string& name, const Parts&... parts) {
  std::ostringstream out;
  out.precision(5);
  (out << ... << parts);
  lines.emplace_back(name, out.str());
}

// Speeds (Hz), the first to the last.
inline std::string range_of(const Eigen::VectorXd& frequency) {
  const Eigen::Index n = frequency.size();
  return n == 0 ? "no speeds"
                : text(n, " speeds, ", frequency[0], " to ", frequency[n - 1], " Hz mesh frequency");
}

// Class, eccentricity and the largest deviations of a gear's teeth.
std::string words_of(const ToothErrors& errors);

// Of artifacts of systems of several meshes.
void show_model(SummaryLines& lines, const MotionSource& s);
void show(SummaryLines& lines, const ModesResult& a);
void show(SummaryLines& lines, const StaticResult& a);  // of a pair
void show(SummaryLines& lines, const SystemStaticResult& a);
// Which gears have errors, and after how many mesh periods the same teeth meet.
void show_differing_teeth(SummaryLines& lines, const System& layout, const std::vector<ToothErrors>& errors,
                          int periods);

}  // namespace whine
