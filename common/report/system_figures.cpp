#include "report/system_figures.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "signal/spectrum.h"
#include "system/rigid_system.h"

namespace whine {

using Eigen::Index;

namespace {

constexpr size_t kMostLines = 12;  // colours and dashes of the template

std::string system_words(const SystemStaticArtifact& a) {
  const System& s = a.settings.layout;
  std::string out;
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    const auto column = static_cast<Index>(b);
    const System::Body& body = s.bodies[b];
    if (body.on != System::kGround) continue;
    out += text(out.empty() ? "" : ", ", body.name, body.teeth > 0 ? text(" (", body.teeth, " teeth) ") : " ",
                fixed(a.torque.col(column).mean(), 1), " N m", s.held(static_cast<int>(b)) ? " held" : "");
  }
  return out;
}

struct Curve {
  std::string name;
  Eigen::VectorXd values;  // (phase)
};

// One row of the figure: curves over the mesh period and their harmonics.
void add_row(const SystemStaticArtifact& a, const std::string& quantity, const std::string& axis,
             const std::string& unit, std::vector<Curve> curves, Figure& figure) {
  if (curves.size() > kMostLines) {
    figure.notes.push_back(text(axis, ": the first ", kMostLines, " of ", curves.size(), " curves"));
    curves.resize(kMostLines);
  }
  FigureBlock period{quantity, {"mesh_phase [1]"}, {}, "period " + quantity},
      spectrum{quantity + " harmonics", {"harmonic [1]"}, {}, "harmonics " + quantity};
  std::string labels;
  std::vector<Harmonics> of;
  const Index n = a.mesh_phase.size();
  const int count = resolved_harmonics(n, kShownHarmonics);
  double low = curves[0].values.minCoeff(), high = curves[0].values.maxCoeff(), most = 0;
  for (const Curve& curve : curves) {
    period.columns.push_back(text(quantity, " ", curve.name, " [", unit, "]"));
    spectrum.columns.push_back(text("amplitude ", curve.name, " [", unit, "]"));
    labels += "'" + curve.name + "' ";
    of.push_back(harmonics(curve.values, count));
    low = std::min(low, curve.values.minCoeff());
    high = std::max(high, curve.values.maxCoeff());
    if (count > 0) most = std::max(most, of.back().amplitude.maxCoeff());
  }
  // The first point again at phase 1, so that the period closes.
  for (Index i = 0; i <= n; ++i) {
    std::vector<double> row{i < n ? a.mesh_phase[i] : 1.0};
    for (const Curve& curve : curves) row.push_back(curve.values[i < n ? i : 0]);
    period.rows.push_back(row);
  }
  for (int k = 1; k <= count; ++k) {
    std::vector<double> row{static_cast<double>(k)};
    for (const Harmonics& h : of) row.push_back(h.amplitude[k - 1]);
    spectrum.rows.push_back(row);
  }
  // Curves that are constant but for round-off are drawn as a line, not as their noise.
  const double size = std::max({std::abs(low), std::abs(high), 1e-12}),
               room = std::max(0.06 * (high - low), 1e-3 * size);
  figure.blocks.push_back(period);
  figure.blocks.push_back(spectrum);
  const std::string row = std::to_string(figure.blocks.size() / 2);
  for (const auto& [name, value] :
       {std::pair{"curves", static_cast<double>(curves.size())}, std::pair{"low", low - room},
        std::pair{"high", high + room}, std::pair{"most", std::max(1.08 * most, 1e-4 * size)}})
    figure.numbers.emplace_back(name + row, value);
  for (const auto& [name, word] : {std::pair{"quantity", quantity}, std::pair{"axis", axis},
                                   std::pair{"unit", unit}, std::pair{"labels", labels}})
    figure.words.emplace_back(name + row, word);
}

// How far the meshes of one [[mesh]] are from sharing the load equally; "" where none has several.
std::string sharing_words(const SystemStaticArtifact& a) {
  std::string out;
  const std::vector<int>& section = a.settings.section;
  for (size_t m = 0; m < section.size(); ++m) {
    const auto alike = std::count(section.begin(), section.end(), section[m]);
    if (alike < 2 ||
        std::find(section.begin(), section.end(), section[m]) != section.begin() + static_cast<Index>(m))
      continue;
    double most = 0, mean = 0;
    for (size_t other = 0; other < section.size(); ++other)
      if (section[other] == section[m]) {
        most = std::max(most, a.load_share.col(static_cast<Index>(other)).maxCoeff());
        mean = std::max(mean, a.load_share.col(static_cast<Index>(other)).mean());
      }
    const auto& gears = a.settings.mesh[static_cast<size_t>(section[m])].gear;
    out += text(out.empty() ? "load sharing factor (largest share times number of planets): " : ", ",
                gears[0], "-", gears[1], " ", fixed(most * static_cast<double>(alike), 3), " at most, ",
                fixed(mean * static_cast<double>(alike), 3), " in the mean of the most loaded");
  }
  return out;
}

}  // namespace

Figure system_static_figure(const SystemStaticArtifact& a) {
  const System& s = a.settings.layout;
  Figure figure;
  figure.title = "A system at rest: transmission errors, mesh forces, bearing forces";
  figure.notes.push_back(system_words(a));
  if (const std::string sharing = sharing_words(a); !sharing.empty()) figure.notes.push_back(sharing);
  figure.notes.emplace_back(
      "transmission error along the line of action, what bearings give way included; mesh force: torque on "
      "the driving gear "
      "over its base radius; bearing force: its size, of rigid axes, too");
  std::vector<Curve> errors, forces, bearings;
  for (size_t m = 0; m < s.meshes.size(); ++m) {
    errors.push_back({mesh_name(s, m), a.transmission_error.col(static_cast<Index>(m)) * kMicro});
    forces.push_back({mesh_name(s, m), a.mesh_force.col(static_cast<Index>(m))});
  }
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    Eigen::VectorXd size(a.mesh_phase.size());
    for (Index i = 0; i < size.size(); ++i)
      size[i] = a.bearing_force[static_cast<size_t>(i)].row(static_cast<Index>(b)).norm();
    bearings.push_back({s.bodies[b].name + (s.bodies[b].on != System::kGround ? " (pin)" : ""), size});
  }
  add_row(a, "transmission_error", "Transmission error", "µm", std::move(errors), figure);
  add_row(a, "mesh_force", "Mesh force", "N", std::move(forces), figure);
  add_row(a, "bearing_force", "Bearing force", "N", std::move(bearings), figure);
  figure.numbers.emplace_back("harmonics",
                              static_cast<double>(resolved_harmonics(a.mesh_phase.size(), kShownHarmonics)));
  figure.numbers.emplace_back("notes", static_cast<double>(figure.notes.size()));
  figure.height = 1640;
  return figure;
}

}  // namespace whine
