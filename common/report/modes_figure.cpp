#include "report/figure_list.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "gear/system_layout.h"

namespace whine {

using Eigen::Index;

namespace {

constexpr int kOutlinePoints = 72;

// 0 central gears, 1 planets, 2 carriers.
double colour_of(const System::Body& body) {
  return body.kind == System::BodyKind::carrier ? 2 : body.on == System::kGround ? 0 : 1;
}

// Adds the body, moved by (u, x, y) times scale, to a drawing in mm.
void draw_body(const System& s, int b, const Eigen::RowVector3d& motion, double scale,
               std::vector<std::vector<double>>& rows) {
  const System::Body& body = s.bodies[static_cast<size_t>(b)];
  const double turn = body.sense * scale * motion[0] / body.radius, radius = working_radius(s, b);
  const double x = body.centre[0] + scale * motion[1], y = body.centre[1] + scale * motion[2];
  const auto point = [&](double px, double py) {
    rows.push_back({(x + px) * kMilli, (y + py) * kMilli, colour_of(body)});
  };
  if (body.kind == System::BodyKind::carrier) {
    for (const System::Body& planet : s.bodies) {
      if (planet.on != b) continue;
      const double px = planet.centre[0] - body.centre[0], py = planet.centre[1] - body.centre[1];
      point(0, 0);
      // A small turn moves a pin along its tangent.
      point(px - turn * py, py + turn * px);
      rows.emplace_back();
    }
    return;
  }
  for (int i = 0; i <= kOutlinePoints; ++i)
    point(radius * std::cos(2 * kPi * i / kOutlinePoints), radius * std::sin(2 * kPi * i / kOutlinePoints));
  rows.emplace_back();
  // Of a gear with teeth inside the mark stands outside of the others.
  const bool ring = is_ring(s, b);
  const double from = ring ? radius : 0, to = ring ? 1.12 * radius : radius, angle = turn + 0.25 * kPi;
  point(from * std::cos(angle), from * std::sin(angle));
  point(to * std::cos(angle), to * std::sin(angle));
  rows.emplace_back();
}

// Share of the train's radius by which the largest displacement is drawn.
constexpr double kDrawn = 0.13;

struct SystemExtent {
  double left = 1e30, right = -1e30, low = 1e30, high = -1e30;  // mm
};

SystemExtent system_extent(const System& s) {
  SystemExtent e;
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b) {
    const auto& centre = s.bodies[static_cast<size_t>(b)].centre;
    const double r = working_radius(s, b);
    e.left = std::min(e.left, (centre[0] - r) * kMilli);
    e.right = std::max(e.right, (centre[0] + r) * kMilli);
    e.low = std::min(e.low, (centre[1] - r) * kMilli);
    e.high = std::max(e.high, (centre[1] + r) * kMilli);
  }
  return e;
}

FigureBlock frequency_block(const ModesResult& a) {
  FigureBlock block{"frequencies",
                    {"mode", "natural_frequency [Hz]", "type", "planet_harmonic", "energy in meshes [%]"},
                    {}};
  for (Index i = 0; i < a.natural_frequency.size(); ++i)
    block.rows.push_back({static_cast<double>(i + 1), a.natural_frequency[i],
                          static_cast<double>(static_cast<int>(a.type[static_cast<size_t>(i)])),
                          static_cast<double>(a.planet_harmonic[i]), a.mesh_energy.row(i).sum() * kPercent});
  return block;
}

// A row for each type.
Panel frequency_panel(const ModesResult& a) {
  Panel panel{
      .x = {.label = "Natural frequency (Hz)", .from = 0, .to = 1.04 * a.natural_frequency.maxCoeff()},
      .key = PanelKey::none,
      .height = 160,
      .wide = true};
  for (const ModeType type :
       {ModeType::rotational, ModeType::translational, ModeType::planet, ModeType::mixed, ModeType::train}) {
    if (std::count(a.type.begin(), a.type.end(), type) == 0) continue;
    panel.y.names.push_back(type == ModeType::train ? "modes" : name_of(type));
    panel.curves.push_back({.block = "frequencies",
                            .x = 2,
                            .style = PanelStyle::points,
                            .colour = type == ModeType::mixed   ? kDark
                                      : type == ModeType::train ? kBlue
                                                                : static_cast<int>(type) + 1,
                            .where = 3,
                            .is = static_cast<double>(static_cast<int>(type)),
                            .at = static_cast<double>(panel.y.names.size())});
  }
  return panel;
}

// The bodies of a mode over those at rest, in which room is for the largest motion.
Panel shape_panel(const std::string& block, const std::string& heading, const SystemExtent& e) {
  const double middle_x = 0.5 * (e.left + e.right), middle_y = 0.5 * (e.low + e.high),
               reach = (0.5 + 0.5 * kDrawn + 0.03) * std::max(e.right - e.left, e.high - e.low);
  Panel panel{.heading = heading,
              .x = {.from = middle_x - reach, .to = middle_x + reach},
              .y = {.from = middle_y - reach, .to = middle_y + reach},
              .curves = {{.block = "rest", .colour = kGrey, .width = 1}},
              .key = PanelKey::none,
              .height = 290,
              .bare = true};
  for (int colour = 0; colour < 3; ++colour)
    panel.curves.push_back(
        {.block = block, .colour = colour + 1, .width = 2, .where = 3, .is = static_cast<double>(colour)});
  return panel;
}

}  // namespace

Figure modes_figure(const ModesResult& a) {
  const System& s = a.layout;
  Figure figure;
  const bool elastic = a.frozen_frequency.size() > 0;
  figure.title = elastic ? "Natural modes of a train with the mean stiffness of its elastic gears"
                         : "Natural modes of a train of rigid bodies";
  figure.blocks = {frequency_block(a)};
  figure.panels = {frequency_panel(a)};
  figure.columns = 5;
  const SystemExtent e = system_extent(s);
  const double size = 0.5 * std::max(e.right - e.left, e.high - e.low) / kMilli;
  FigureBlock rest{"rest", {"x [mm]", "y [mm]", "colour"}, {}};
  rest.drawing = true;
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b)
    draw_body(s, b, Eigen::RowVector3d::Zero(), 0, rest.rows);
  figure.blocks.push_back(rest);
  int panels = 0, left_out = 0, still = 0;
  for (Index i = 0; i < a.natural_frequency.size(); ++i) {
    if (a.natural_frequency[i] == 0) {
      ++still;
      continue;
    }
    const auto equal = [&](Index other) {
      return other >= 0 && other < a.natural_frequency.size() &&
             std::abs(a.natural_frequency[other] - a.natural_frequency[i]) < 1e-9 * a.natural_frequency[i] &&
             a.type[static_cast<size_t>(other)] == a.type[static_cast<size_t>(i)];
    };
    if (equal(i - 1)) continue;
    if (panels == static_cast<int>(kMostShapes)) {
      ++left_out;
      continue;
    }
    const MatrixRM& shape = a.shape[static_cast<size_t>(i)];
    FigureBlock block{text("shape ", ++panels), {"x [mm]", "y [mm]", "colour"}, {}};
    block.drawing = true;
    const double scale = kDrawn * size / shape.cwiseAbs().maxCoeff();
    for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b)
      draw_body(s, b, shape.row(b), scale, block.rows);
    figure.blocks.push_back(block);
    figure.panels.push_back(
        shape_panel(block.name,
                    text(shown(a.natural_frequency[i], 5), " Hz, ", name_of(a.type[static_cast<size_t>(i)]),
                         equal(i + 1) ? " (double)" : ""),
                    e));
  }
  figure.notes.push_back(
      text(s.bodies.size(), elastic ? " bodies, " : " rigid bodies, ", s.meshes.size(),
           " meshes of mean stiffness, ", a.natural_frequency.size(), " modes, ", still,
           " of them free motions (0 Hz, not drawn)",
           left_out ? text("; the shapes of ", left_out, " higher frequencies are not drawn") : ""));
  const bool planets = std::any_of(s.bodies.begin(), s.bodies.end(),
                                   [](const System::Body& body) { return body.on != System::kGround; });
  figure.notes.push_back(text(
      planets ? "blue: central gears, orange: planets, green: carrier, grey" : "blue: moved, grey",
      ": at rest; a radius of each gear, of a ring a mark outside, shows its rotation; of a double mode one shape"));
  figure.notes.push_back(text("shapes are magnified, the largest motion of each to the same size",
                              planets ? "; in the frame of the carrier, without Coriolis terms" : ""));
  return figure;
}

}  // namespace whine
