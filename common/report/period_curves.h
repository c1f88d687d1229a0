// Curves over the mesh period and their harmonics, as blocks of a figure at rest: of a pair one for each torque, of a train one for each mesh.
#pragma once
#include <string>
#include <vector>

#include "report/figures.h"

namespace whine {

// A curve over the mesh period, or over the hunting period of teeth that differ, and its harmonics of the mesh frequency.
struct PeriodCurve {
  std::string name;
  Eigen::VectorXd values, amplitudes;  // (phase), (harmonic 1, 2, ...), in the unit of the figure
};

// Columns: the phase, up to `end` mesh periods, then the curves. The first point again at the end, so that the period closes.
FigureBlock period_block(const std::string& name, const std::vector<std::string>& columns,
                         const Eigen::VectorXd& phase, double end, const std::vector<PeriodCurve>& curves,
                         const std::string& table = "");
// Columns "<quantity> <curve> [<unit>]".
FigureBlock period_block(const std::string& quantity, const std::string& unit, const Eigen::VectorXd& phase,
                         double end, const std::vector<PeriodCurve>& curves, const std::string& table = "");

// Of the first kShownHarmonics harmonics, as far as all curves have them.
FigureBlock spectrum_block(const std::string& quantity, const std::string& unit,
                           const std::vector<PeriodCurve>& curves, const std::string& table);

}  // namespace whine
