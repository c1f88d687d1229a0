#include <algorithm>
#include <numbers>

#include "base/error.h"
#include "base/units.h"
#include "report/figure_list.h"
#include "report/figure_words.h"
#include "signal/spectrum.h"

namespace whine {

Figure sidebands_figure(const StaticResult& s, const ResponseResult& r) {
  const int periods = s.hunting_periods;
  if (periods < 2)
    fail(
        Failure::input,
        "figure: the teeth are all alike and have no sidebands; give a gear of the scene a section [gear.<name>.error]");
  if (r.hunting_periods != periods || r.torque != s.torque)
    fail(Failure::input, "figure: the sweep is of ", r.hunting_periods, " mesh periods at ", r.torque,
         " N m, the statics are of ", periods, " at ", s.torque, " N m; give those of one scene and torque");
  constexpr double kLastOrder = 3.5, kFloor = 1e-12;  // m: below, nothing but round-off
  Eigen::Index peak = 0;
  r.dte_rms.col(0).maxCoeff(&peak);
  Figure figure;
  figure.title = "Sidebands of teeth that differ";
  figure.notes.push_back(text(pair_words(s), ", ", torque_words(s.torque)));
  figure.notes.push_back(text(
      "the same teeth meet after ", periods, " mesh periods; orders of the mesh frequency, of the shafts ",
      shown(1.0 / s.gear[0].design.teeth, 4), " (driver) and ", shown(1.0 / s.gear[1].design.teeth, 4)));
  FigureBlock error{"transmission_error", {"mesh_phase [1]", "transmission_error [µm]"}, {}};
  for (Eigen::Index i = 0; i < s.mesh_phase.size(); ++i)
    error.rows.push_back({s.mesh_phase[i], s.transmission_error[i] * kMicro});
  const auto orders = [&](const std::string& name, Eigen::Index count, const auto& amplitude) {
    FigureBlock block{"orders " + name, {"order [1]", "amplitude [µm]"}, {}, "orders", name};
    for (Eigen::Index k = 1; k <= count && k <= kLastOrder * periods; ++k)
      block.rows.push_back({static_cast<double>(k) / periods, std::max(kFloor, amplitude(k)) * kMicro});
    return block;
  };
  figure.blocks = {error,
                   orders("at rest", s.transmission_error_order.size() - 1,
                          [&](Eigen::Index k) { return s.transmission_error_order[k]; }),
                   orders("in motion", r.dte_order[static_cast<size_t>(peak)].rows(),
                          [&](Eigen::Index k) { return r.dte_order[static_cast<size_t>(peak)](k - 1, 0); })};
  figure.panels = {{.x = {.label = "Mesh periods", .from = 0, .to = static_cast<double>(periods)},
                    .y = {.label = "Static transmission error (µm)"},
                    .curves = {{.block = "transmission_error", .width = 1.4}},
                    .height = 230}};
  for (const auto& [name, heading] :
       {std::pair{"orders at rest", std::string("at rest")},
        std::pair{"orders in motion", "in motion at " + fixed(r.mesh_frequency[peak], 0) + " Hz"}})
    figure.panels.push_back({.heading = heading,
                             .x = {.label = "Order of the mesh frequency", .from = 0, .to = kLastOrder},
                             .y = {.label = "Amplitude (µm)", .log = true},
                             .curves = {{.block = name,
                                         .style = PanelStyle::stems,
                                         .colour = heading == "at rest" ? kBlue : kVermilion,
                                         .width = 1.8,
                                         .size = 0}},
                             .height = 230});
  return figure;
}

namespace {

// Largest root stress of each tooth of a cracked gear while it is in mesh, about the cracked one; an intact tooth is the farthest
// from it. Nothing of a result without root stress.
void add_root_stress_of_teeth(const StaticResult& s, int g, int around, Figure& figure) {
  const MatrixRM& stress = s.root_stress[static_cast<size_t>(g)];
  const GearDesign& design = s.gear[static_cast<size_t>(g)].design;
  if (stress.size() == 0 || design.crack.depth == 0) return;
  const Eigen::Index positions = s.mesh_phase.size() / s.hunting_periods;
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(design.teeth);
  for (Eigen::Index i = 0; i < stress.rows(); ++i)
    for (Eigen::Index k = 0; k < stress.cols(); ++k) {
      if (!(s.tooth_load(i, k) > 0)) continue;
      // Pairs count in the sense of motion, teeth counter-clockwise, which is that of the driver.
      const int pair = s.pair[k] - static_cast<int>(i / positions), tooth = g == 0 ? pair : -pair;
      double& most = largest[((tooth % design.teeth) + design.teeth) % design.teeth];
      most = std::max(most, stress(i, k));
    }
  const auto of = [&](int from_crack) {
    return largest[((design.crack.tooth + from_crack) % design.teeth + design.teeth) % design.teeth];
  };
  const double intact = of(design.teeth / 2);
  const std::string of_gear = s.mesh.gear[static_cast<size_t>(g)];
  FigureBlock teeth{
      text("teeth ", figure.blocks.size() - 2),
      {"tooth from the cracked one [1]", "largest root stress [MPa]", "of an intact tooth [MPa]"},
      {},
      "teeth",
      of_gear};
  for (int k = -around; k <= around; ++k)
    teeth.rows.push_back({static_cast<double>(k), of(k) * kInMegapascals, intact * kInMegapascals});
  figure.blocks.push_back(teeth);
  figure.notes.push_back(text(
      "largest root stress of ", without_markup(of_gear), " ", shown(largest.maxCoeff() * kInMegapascals, 4),
      " MPa, ", shown(100 * (largest.maxCoeff() / intact - 1), 2),
      " % above that of an intact tooth; beside the slit ", shown(of(0) * kInMegapascals, 4),
      " MPa, not counting its tip, where stress is singular"));
}

// The fourth block and those behind it are root stresses of the teeth of a gear.
std::vector<Panel> crack_panels(const std::vector<FigureBlock>& blocks, double around, double last_order) {
  const PanelCurve with{.colour = kVermilion, .label = "with the crack", .width = 1.8, .size = 0},
      without{.colour = kDark, .label = "without", .width = 1.6, .dash = 3, .mark = 6};
  const PanelAxis periods{
      .label = "Mesh periods from the one with the largest mark", .from = -around, .to = around + 1};
  const auto of = [](PanelCurve curve, const char* block, int y, PanelStyle style = PanelStyle::line) {
    curve.block = block;
    curve.y = y;
    curve.style = style;
    return curve;
  };
  std::vector<Panel> panels{
      {.heading = "static transmission error",
       .x = periods,
       .y = {.label = "Error (µm)"},
       .curves = {of(without, "transmission_error", 3), of(with, "transmission_error", 2)}},
      {.heading = "what the crack adds",
       .x = periods,
       .y = {.label = "Added (µm)"},
       .curves = {of(with, "transmission_error", 4)},
       .key = PanelKey::none},
      {.heading = "orders of the mesh frequency",
       .x = {.label = "Order", .from = 0, .to = last_order},
       .y = {.label = "Amplitude (µm)", .log = true},
       .curves = {of(with, "orders", 2, PanelStyle::stems),
                  of(without, "orders without", 2, PanelStyle::points)}}};
  Panel stress{.heading = "largest root stress of each tooth about the cracked one",
               .x = {.label = "Tooth, counter-clockwise from the cracked one",
                     .from = -around - 0.5,
                     .to = around + 0.5},
               .y = {.label = "Stress (MPa)", .from_zero = true}};
  for (size_t k = 3; k < blocks.size(); ++k) {
    stress.curves.push_back({.block = blocks[k].name,
                             .y = 3,
                             .colour = kDark,
                             .label = k > 3 ? "" : "intact tooth",
                             .width = 1.6,
                             .dash = 3});
    stress.curves.push_back({.block = blocks[k].name,
                             .style = PanelStyle::points,
                             .colour = curve_colour(k - 3),
                             .label = without_markup(short_name(blocks[k].curve)),
                             .size = 1.6});
  }
  if (!stress.curves.empty()) panels.push_back(stress);
  for (Panel& panel : panels) panel.height = 180;
  return panels;
}

}  // namespace

Figure crack_figure(const StaticResult& s) {
  std::string cracks;
  for (size_t g = 0; g < kSides; ++g)
    if (const Crack& crack = s.gear[g].design.crack; crack.depth > 0)
      cracks += text(cracks.empty() ? "" : "; ", "tooth ", crack.tooth, " of the ", kGearName[g],
                     ": a slit of ", shown(crack.depth * 1e3, 4), " mm from the fillet, ",
                     shown(crack.angle * 180 / std::numbers::pi, 4), "° to the tooth's centre line");
  if (cracks.empty())
    fail(Failure::input,
         "figure: no tooth has a crack; give a gear of the scene a section [gear.<name>.crack]");
  for (const ToothErrors& errors : s.mesh.errors)
    if (!errors.none())
      fail(
          Failure::input,
          "figure: teeth have errors of their own beside the crack; use a scene without [gear.<name>.error]");
  const Eigen::Index positions = s.mesh_phase.size() / s.hunting_periods;
  const auto period = [&](Eigen::Index k) { return s.transmission_error.segment(k * positions, positions); };
  Eigen::Index stiffest = 0, most = 0;
  double largest = 0;
  for (Eigen::Index k = 0; k < s.hunting_periods; ++k)
    if (period(k).mean() < period(stiffest).mean()) stiffest = k;
  const Eigen::VectorXd intact = period(stiffest);
  for (Eigen::Index k = 0; k < s.hunting_periods; ++k)
    if (const double here = (period(k) - intact).maxCoeff(); here > largest) {
      largest = here;
      most = k;
    }
  constexpr int kAround = 5;  // mesh periods either side
  constexpr double kLastOrder = 3.5, kFloor = 1e-12;
  Figure figure;
  figure.title = "A cracked tooth: static transmission error and root stress";
  figure.notes.push_back(text(pair_words(s), ", ", torque_words(s.torque)));
  figure.notes.push_back(text(cracks, "; adds up to ", shown(largest * kMicro, 3), " µm, ",
                              shown(100 * largest / intact.mean(), 3), " % of the mean"));
  FigureBlock error{"transmission_error",
                    {"mesh periods [1]", "with the crack [µm]", "without [µm]", "difference [µm]"},
                    {}};
  for (Eigen::Index k = -kAround; k <= kAround; ++k) {
    const Eigen::Index at = ((most + k) % s.hunting_periods + s.hunting_periods) % s.hunting_periods;
    for (Eigen::Index i = 0; i < positions; ++i)
      error.rows.push_back({static_cast<double>(k) + static_cast<double>(i) / static_cast<double>(positions),
                            period(at)[i] * kMicro, intact[i] * kMicro,
                            (period(at)[i] - intact[i]) * kMicro});
  }
  FigureBlock orders{"orders", {"order [1]", "amplitude [µm]"}, {}, "orders", "with the crack"};
  for (Eigen::Index k = 1; k < s.transmission_error_order.size() && k <= kLastOrder * s.hunting_periods; ++k)
    orders.rows.push_back({static_cast<double>(k) / s.hunting_periods,
                           std::max(kFloor, s.transmission_error_order[k]) * kMicro});
  FigureBlock without{"orders without", {"order [1]", "amplitude [µm]"}, {}, "orders", "without"};
  const Harmonics of_intact = harmonics(intact, static_cast<int>(kLastOrder));
  for (Eigen::Index k = 0; k < of_intact.amplitude.size(); ++k)
    without.rows.push_back({static_cast<double>(k + 1), of_intact.amplitude[k] * kMicro});
  figure.blocks = {error, orders, without};
  for (int g = 0; g < kSides; ++g) add_root_stress_of_teeth(s, g, kAround, figure);
  figure.panels = crack_panels(figure.blocks, kAround, kLastOrder);
  return figure;
}

}  // namespace whine
