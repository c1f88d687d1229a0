#include "report/figure_list.h"

#include <algorithm>

#include "base/error.h"
#include "report/one_system.h"

namespace whine {

using Eigen::Index;

namespace {

// Where harmonic l of the mesh frequency meets mode i, as the carrier turns.
void meet(const ModesResult& a, Index i, int l, FigureBlock& crossings) {
  for (Index n = 1; n < a.turning_mesh_frequency.size(); ++n) {
    const auto above = [&](Index at) {
      return a.turning_frequency(at, i) - l * a.turning_mesh_frequency[at];
    };
    if (!(above(n - 1) > 0) || above(n) > 0) continue;
    const double share = above(n - 1) / (above(n - 1) - above(n)),
                 at = (1 - share) * a.turning_mesh_frequency[n - 1] + share * a.turning_mesh_frequency[n];
    crossings.rows.push_back({static_cast<double>(i + 1), static_cast<double>(l), at, l * at});
  }
}

Panel campbell_panel(const ModesResult& a, const FigureBlock& modes, double top) {
  Panel panel{.x = {.label = "Mesh frequency (Hz)", .from = 0, .to = top, .speed = true},
              .y = {.label = "Frequency (Hz)", .from = 0, .to = top},
              .height = 720};
  for (const ModeType type :
       {ModeType::rotational, ModeType::translational, ModeType::planet, ModeType::mixed, ModeType::train}) {
    if (std::count(a.type.begin(), a.type.end(), type) == 0) continue;
    const int colour = type == ModeType::mixed   ? kDark
                       : type == ModeType::train ? kBlue
                                                 : static_cast<int>(type) + 1;
    panel.curves.push_back({.colour = colour, .label = type == ModeType::train ? "modes" : name_of(type)});
    if (a.frozen_frequency.size() > 0)
      panel.curves.push_back({.block = modes.name,
                              .style = PanelStyle::boxes,
                              .colour = colour,
                              .where = 5,
                              .is = static_cast<double>(static_cast<int>(type)),
                              .box = {0, 0, 3, 4},
                              .fill = 0.22});
    for (const auto& row : modes.rows)
      if (row[4] == static_cast<double>(static_cast<int>(type)))
        panel.rules.push_back({'y', row[1], "", colour, 1});
  }
  if (a.turning_frequency.size() > 0)
    panel.curves.push_back({.block = "turning", .colour = kDark, .label = "carrier turning", .width = 1.2});
  panel.curves.push_back(
      {.block = "harmonics", .colour = kGrey, .label = "harmonics", .width = 1.2, .dash = 2});
  panel.curves.push_back({.block = "crossings",
                          .x = 3,
                          .y = 4,
                          .style = PanelStyle::points,
                          .colour = kBlack,
                          .label = "crossings",
                          .size = 0.8});
  for (int l = 1; l <= kCampbellHarmonics; ++l) panel.words.push_back({text(l, " f_m"), top / l});
  return panel;
}

}  // namespace

Figure campbell_figure(const ModesResult& a) {
  Figure figure;
  figure.title = "Campbell diagram: natural frequencies and harmonics of the mesh frequency";
  FigureBlock modes{"frequencies",
                    {"mode", "natural_frequency [Hz]", "least over the mesh phases [Hz]",
                     "largest over the mesh phases [Hz]", "type"},
                    {}},
      crossings{"crossings",
                {"mode", "harmonic", "mesh_frequency [Hz]", "natural_frequency [Hz]"},
                {},
                "crossings"};
  const bool bands = a.frozen_frequency.size() > 0;
  double highest = 0;
  bool outside = false;  // a line that lies outside of its band
  for (Index i = 0; i < a.natural_frequency.size(); ++i) {
    const double f = a.natural_frequency[i];
    if (f == 0) continue;
    const double number = static_cast<double>(i + 1);
    outside =
        outside ||
        (bands && (f < a.frozen_frequency.col(i).minCoeff() || f > a.frozen_frequency.col(i).maxCoeff()));
    highest = std::max({highest, f, bands ? a.frozen_frequency.col(i).maxCoeff() : f});
    modes.rows.push_back({number, f, bands ? a.frozen_frequency.col(i).minCoeff() : f,
                          bands ? a.frozen_frequency.col(i).maxCoeff() : f,
                          static_cast<double>(static_cast<int>(a.type[static_cast<size_t>(i)]))});
    for (int l = 1; l <= kCampbellHarmonics; ++l) {
      if (a.turning_frequency.size() > 0)
        meet(a, i, l, crossings);
      else
        crossings.rows.push_back({number, static_cast<double>(l), f / l, f});
    }
  }
  if (modes.rows.empty())
    fail(Failure::input, "figure: all motions of the system are free; there is no natural frequency");
  FigureBlock rays{"harmonics", {"mesh_frequency [Hz]", "frequency [Hz]"}, {}, "", "", true};
  const double top = 1.06 * highest;
  for (int l = 1; l <= kCampbellHarmonics; ++l)
    rays.rows.insert(rays.rows.end(), {{0, 0}, {top / l, top}, {}});
  figure.blocks = {modes, crossings, rays};
  if (a.turning_frequency.size() > 0) {
    FigureBlock turning{"turning", {"mesh_frequency [Hz]", "natural_frequency [Hz]"}, {}, "", "", true};
    for (Index i = 0; i < a.turning_frequency.cols(); ++i) {
      if (a.turning_frequency.col(i).isZero(0)) continue;
      for (Index n = 0; n < a.turning_mesh_frequency.size(); ++n)
        turning.rows.push_back({a.turning_mesh_frequency[n], a.turning_frequency(n, i)});
      turning.rows.emplace_back();
    }
    figure.blocks.push_back(turning);
  }
  figure.panels = {campbell_panel(a, modes, top)};
  figure.notes.push_back(
      text(a.layout.bodies.size(), " bodies, ", a.layout.meshes.size(), " meshes; ",
           bands ? "lines: mean stiffness of the meshes, bands: frozen contact at all mesh phases"
                 : "meshes at their mean stiffness"));
  if (outside)
    figure.notes.emplace_back(
        text("bands by rank: a line may lie outside of its own, because at one phase the meshes differ ",
             "from planet to planet, which parts near frequencies"));
  const bool planets = std::any_of(a.layout.bodies.begin(), a.layout.bodies.end(),
                                   [](const System::Body& body) { return body.on != System::kGround; });
  figure.notes.push_back(text(
      "points: mesh frequencies at which a harmonic of the meshes meets a natural frequency",
      !planets                         ? ""
      : a.turning_frequency.size() > 0 ? "; in the frame of the carrier, with Coriolis and centrifugal terms"
                                       : "; in the frame of the carrier, without Coriolis terms"));
  add_shafts(a.layout, figure);
  return figure;
}

}  // namespace whine
