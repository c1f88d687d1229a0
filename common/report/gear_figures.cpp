#include "report/figure_list.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "gear/hertz.h"
#include "gear/pair.h"
#include "io/summary.h"
#include "report/wireframe.h"
#include "results/sector_grid.h"

namespace whine {
namespace {

void require_same_gear(const char* role, const GearDesign& mesh, const GearDesign& pair) {
  if (mesh.teeth != pair.teeth || mesh.module != pair.module || mesh.profile_shift != pair.profile_shift ||
      mesh.internal != pair.internal || mesh.clamped_radius() != pair.clamped_radius())
    fail(Failure::input, "figure: the mesh.h5 of the ", role, " (", mesh.teeth, " teeth, module ",
         mesh.module, " m, bore ", mesh.clamped_radius(), " m) is not that of the static.h5 (", pair.teeth,
         " teeth, module ", pair.module, " m, bore ", pair.clamped_radius(),
         " m); give driver, driven, static in this order");
}

// Closed outlines of the elements of tooth 0 in which the half-plane field is subtracted.
Strokes tooth_elements(const SectorGrid& mesh, const Placement& at, double scale) {
  Strokes rows;
  const int sides = mesh.element_node.cols() == 9 ? 2 : 1;
  for (Eigen::Index e = 0; e < mesh.element_node.rows(); ++e) {
    if (mesh.element_region[e] != 1) continue;
    for (int k = 0; k <= 4 * sides; ++k) {
      const int corner = k / sides % 4, node = mesh.element_node(e, k % sides ? 4 + corner : corner);
      const Vec2 p = at(mesh.node_position.row(node).transpose()) * scale;
      rows.push_back({p.x(), p.y()});
    }
    rows.emplace_back();
  }
  return rows;
}

// m: of the whole gear, its tips or its rim.
double outer_radius(const ToothGeometry& gear) {
  return gear.internal() ? gear.design().rim_outer_radius : gear.tip_radius();
}

}  // namespace

Figure mesh_figure(const SectorGrid& driver, const SectorGrid& driven, const StaticResult& s) {
  require_same_gear("driver", driver.design, s.gear[0].design);
  require_same_gear("driven gear", driven.design, s.gear[1].design);
  const GearPair pair(s);
  const double alpha = pair.working_pressure_angle();

  const Vec2 pitch_point(0.0, pair.gear(0).base_radius() / std::cos(alpha));
  const double pitch = std::numbers::pi * s.gear[0].design.module;
  const double half_zone = 1.45 * pitch;

  Figure figure;
  figure.title = "Finite element mesh of the gear pair";
  long elements = 0, nodes = 0;
  for (int g = 0; g < kSides; ++g) {
    const SectorGrid& mesh = g == 0 ? driver : driven;
    const std::string name = kRole[g];
    const Wireframe wire(mesh);
    const Placement at = placed(pair, g);
    const std::vector<std::string> columns{"x [mm]", "y [mm]"};
    const auto lines = [&](const char* what, const Strokes& strokes, bool drawing) {
      figure.blocks.push_back({name + what, columns, strokes, "lines", name + what, drawing});
    };
    lines(" outline", wire.outline(at, kMilli), false);
    lines(" bore", wire.bore(at, kMilli), false);
    // Of the elements mesh.h5 holds the numbers.
    // A twentieth of a pixel of the picture of both gears.
    const double hair =
        1e-4 * (s.mesh.centre_distance + pair.gear(0).tip_radius() + pair.gear(1).tip_radius()) * kMilli;
    lines(" gear", simplified(wire.whole(at, kMilli), hair), true);
    // The same of the teeth in mesh, whose window is 770 pixels wide.
    lines(" teeth", simplified(wire.window(at, kMilli, pitch_point, half_zone), 1.3e-4 * half_zone * kMilli),
          true);
    elements += static_cast<long>(mesh.element_node.rows()) * mesh.design.teeth;
    nodes += static_cast<long>(mesh.node_position.rows() - mesh.side_node.rows()) * mesh.design.teeth;
  }
  // The driver turns counter-clockwise: contact moves along the outward normal of its flank.
  const Vec2 along = contact_normal(pair);
  FigureBlock path{"path of contact", {"x [mm]", "y [mm]"}, {}, "lines", "path of contact"};
  for (double x : {pair.path_start(), 0.0, pair.path_end()}) {
    const Vec2 p = (pitch_point + x * along) * kMilli;
    path.rows.push_back({p.x(), p.y()});
  }
  figure.blocks.push_back(path);
  figure.blocks.push_back(
      {"pitch point", {"x [mm]", "y [mm]"}, {{0.0, pitch_point.y() * kMilli}}, "lines", "pitch point"});

  figure.notes.push_back(pair_words(s));
  const GearDesign &first = s.gear[0].design, &second = s.gear[1].design;
  figure.notes.push_back(
      text(elements, driver.discretisation.element_order == 2 ? " nine" : " four", "-node elements, ", nodes,
           " nodes; ", shown(driver.discretisation.element_size * kMilli, 4), " mm on the flank; rigid ",
           first.internal ? "rim" : "hub", " of ", shown(first.clamped_radius() * kMilli, 4), " mm radius",
           second.clamped_radius() == first.clamped_radius()
               ? std::string()
               : text(" (driven: ", second.internal ? "rim, " : "",
                      shown(second.clamped_radius() * kMilli, 4), " mm)")));
  figure.notes.push_back("unloaded, mesh phase 0: the reference pair touches at the pitch point");
  figure.numbers = {{"pitch_y", pitch_point.y() * kMilli},
                    {"half_window", half_zone * kMilli},
                    {"driver_radius", outer_radius(pair.gear(0)) * kMilli},
                    {"driven_radius", outer_radius(pair.gear(1)) * kMilli},
                    {"driven_y", pair.driven_centre_offset() * kMilli},
                    {"ring", pair.ring() + 1.0}};
  return figure;
}

namespace {

// m: point of the working flank of tooth 0 of gear g in its body frame, `below` (m) under the surface. A driven gear of an
// internal pair works with the flank that trails.
Vec2 working_point(const GearPair& pair, int g, double roll, double below) {
  const ToothGeometry& tooth = pair.gear(g);
  Vec2 p = tooth.flank_point(roll) - below * tooth.flank_normal(roll);
  if (pair.internal() && g == 1) p.x() = -p.x();
  return p;
}

// Outline, teeth in the window about `touch`, and the inner region of one gear.
void add_body(const SectorGrid& mesh, const StaticResult& s, const GearPair& pair, int g, const Vec2& touch,
              double half_zone, Figure& figure) {
  const std::string name = kRole[g];
  const Wireframe wire(mesh);
  const Placement at = placed(pair, g);
  const std::vector<std::string> columns{"x [mm]", "y [mm]"};
  figure.blocks.push_back({name + " outline", columns, wire.outline(at, kMilli), "", "", true});
  figure.blocks.push_back(
      {name + " teeth", columns, wire.window(at, kMilli, touch, half_zone), "", "", true});
  const BodyDiscretisation& body = s.gear[g].discretisation;
  FigureBlock inner{name + " inner region", columns, {}, "", "", true};
  if (body.near_field == NearField::matching) {
    const ToothGeometry& tooth = pair.gear(g);
    for (double t = 0; t <= 1.0001; t += 0.02) {
      const double roll = tooth.form_roll_angle() + t * (tooth.tip_roll_angle() - tooth.form_roll_angle());
      const Vec2 p = at(working_point(pair, g, roll, body.matching_depth)) * kMilli;
      inner.rows.push_back({p.x(), p.y()});
    }
  } else {
    inner.rows = tooth_elements(mesh, at, kMilli);
  }
  figure.blocks.push_back(inner);
}

FigureBlock hertz_block(const HertzContact& contact) {
  FigureBlock hertz{"Hertz", {"along flank [mm]", "pressure [MPa]"}, {}};
  for (int k = 0; k <= 120; ++k) {
    const double x = -std::cos(std::numbers::pi * k / 120);
    hertz.rows.push_back(
        {x * contact.half_width * kMilli, 1e-6 * contact.pressure * std::sqrt(std::max(0.0, 1 - x * x))});
  }
  return hertz;
}

std::string inner_region(const StaticResult& s) {
  return s.gear[0].discretisation.near_field == NearField::matching
             ? "matched to the finite elements at " +
                   shown(s.gear[0].discretisation.matching_depth * kMilli, 4) + " mm depth"
             : "the half-plane's field is subtracted there, finite elements carry the smooth rest";
}

}  // namespace

Figure contact_zone_figure(const SectorGrid& driver, const SectorGrid& driven, const StaticResult& s) {
  const ReferenceContact& zone = s.reference_contact;
  if (zone.gap.size() == 0)
    fail(Failure::input, "figure: the static.h5 holds no contact of the reference pair; make it again");
  require_same_gear("driver", driver.design, s.gear[0].design);
  require_same_gear("driven gear", driven.design, s.gear[1].design);
  const GearPair pair(s);
  const double alpha = pair.working_pressure_angle();
  const PairContact contact = pair.contact(0);
  const Vec2 touch(0.0, pair.gear(0).base_radius() / std::cos(alpha));
  // Out of the driver's flank along the line of action; along the flank to the driver's tip.
  const Vec2 normal = contact_normal(pair);
  const double up = pair.ring() == 0 ? -1 : 1;
  const Vec2 tangent = up * Vec2(normal.y(), -normal.x());  // to the driver's tip
  const double half_zone = 2 * s.gear[0].design.module;

  Figure figure;
  figure.title = text("Contact zone of the reference pair at the pitch point, ", torque_words(s.torque));
  for (int g = 0; g < kSides; ++g) add_body(g == 0 ? driver : driven, s, pair, g, touch, half_zone, figure);
  FigureBlock action{"line of action", {"x [mm]", "y [mm]"}, {}, "", "", true};
  for (double side : {-1.0, 1.0}) {
    const Vec2 p = (touch + side * half_zone * normal) * kMilli;
    action.rows.push_back({p.x(), p.y()});
  }
  figure.blocks.push_back(action);

  const FlankDeviation deviation[2] = {{pair.gear(0), s.mesh.modification[0]},
                                       {pair.gear(1), s.mesh.modification[1]}};
  const auto on_flanks = [&](double x) {
    const FlankGap at = pair.gap_at(contact, x);
    std::array<Vec2, 2> local;  // along the flank, out of the driver
    for (int g = 0; g < kSides; ++g) {
      const Vec2 p =
          placed(pair, g)(working_point(pair, g, at.roll[g], deviation[g].at(at.roll[g], 0))) - touch;
      local[g] = Vec2(p.dot(tangent), p.dot(normal));
    }
    return local;
  };
  FigureBlock flanks{"flanks", {"along flank [mm]", "driver [µm]", "driven [µm]"}, {}};
  const Eigen::Index n = zone.gap.size();
  const double reach = 0.5 * (zone.border[n] - zone.border[0]);
  for (int k = -60; k <= 60; ++k) {
    const double x = std::clamp(reach * 1.3 * k / 60, contact.x_min, contact.x_max);
    const auto local = on_flanks(x);
    flanks.rows.push_back({x * kMilli, local[0].y() * kMicro, local[1].y() * kMicro});
  }
  FigureBlock candidates{
      "candidate pairs",
      {"along flank [mm]", "P on driver [µm]", "G on driven gear [µm]", "strip from [mm]", "strip to [mm]",
       "gap of strip [µm]", "separation under load [µm]", "pressure [MPa]"},
      {}};
  const double face_width = s.face_width();
  for (Eigen::Index i = 0; i < n; ++i) {
    const double low = zone.border[i], high = zone.border[i + 1], middle = 0.5 * (low + high);
    const auto local = on_flanks(middle);
    candidates.rows.push_back({middle * kMilli, local[0].y() * kMicro, local[1].y() * kMicro, low * kMilli,
                               high * kMilli, zone.gap[i] * kMicro, zone.separation[i] * kMicro,
                               1e-6 * zone.force[i] / ((high - low) * face_width)});
  }
  const double force = zone.force.sum();
  const HertzContact hertz = hertz_contact(s, force);
  figure.blocks.insert(figure.blocks.end(), {candidates, flanks, hertz_block(hertz)});

  figure.notes.push_back(pair_words(s));
  figure.notes.push_back("inner region: " + inner_region(s) + "; outer region: finite elements");
  figure.notes.push_back(text(n, " strips in the candidate zone; tooth force ", fixed(force, 0),
                              " N; approach of the gears ", shown(zone.approach * kMicro, 4),
                              " µm; Hertz: half-width ", shown(hertz.half_width * kMicro, 4), " µm, peak ",
                              shown(hertz.pressure * 1e-6, 4), " MPa"));
  figure.numbers = {{"matching", s.gear[0].discretisation.near_field == NearField::matching},
                    {"touch_y", touch.y() * kMilli},
                    {"half_window", half_zone * kMilli},
                    {"reach", 1.3 * reach * kMilli},
                    {"peak", hertz.pressure * 1e-6},
                    {"strips", static_cast<double>(n)},
                    {"ring", pair.ring() + 1.0}};
  return figure;
}

Figure profile_figure(const StaticResult& s) {
  const GearPair pair(s);
  const double degree = std::numbers::pi / 180, pitch = pair.base_pitch();
  Figure figure;
  figure.title = "Profile charts of the driving flanks";
  figure.captions = {
      "thin line: the involute without modification; form: where the involute begins; SAP: start of the active profile",
      "LPSTC, HPSTC: lowest and highest point of single tooth contact (B, D of the driver; D, B of the driven gear)"};
  double low = 0, high = 0;
  for (int g = 0; g < kSides; ++g) {
    const std::string name = kRole[g];
    const ToothGeometry& gear = pair.gear(g);
    const FlankDeviation deviation(gear, s.mesh.modification[g]);
    figure.notes.push_back(s.mesh.gear[g] + ", " + name + ": " + in_words(s.mesh.modification[g]));
    FigureBlock trace{name, {"roll angle [deg]", "length of roll [mm]", "material [µm]"}, {}, "flanks", name};
    const double form = gear.form_roll_angle(), tip = gear.tip_roll_angle();
    constexpr int kPlaces = 400;
    for (int i = 0; i <= kPlaces; ++i) {
      // subtracted: the negative of nothing would be printed as -0
      const double roll = form + (tip - form) * i / kPlaces, material = 0 - deviation.at(roll, 0) * kMicro;
      trace.rows.push_back({roll / degree, gear.base_radius() * roll * kMilli, material});
      low = std::min(low, material);
      high = std::max(high, material);
    }
    figure.blocks.push_back(trace);
    Panel panel{.heading = without_markup(figure.notes.back()),
                .x = {.label = "Roll angle (deg)"},
                .y = {.label = "Material (µm)"},
                .curves = {{.block = name, .y = 3, .width = 3}},
                .rules = {{'y', 0, "", kGreen, 1}, {'x', form / degree, "form"}, {'x', tip / degree, "tip"}},
                .key = PanelKey::none,
                .height = 260};
    // Start of the active profile, lowest and highest point of single-pair contact: where along the path of contact.
    const double first = g == 0 ? pair.path_start() : pair.path_end(),
                 last = g == 0 ? pair.path_end() : pair.path_start(), step = g == 0 ? pitch : -pitch;
    for (const auto& [mark, path] :
         {std::pair{"SAP", first}, {"LPSTC", last - step}, {"pitch", 0.0}, {"HPSTC", first + step}})
      panel.rules.push_back({'x', pair.nominal_roll(g, path) / degree, mark});
    figure.panels.push_back(panel);
  }
  // Room for the names of the marks above the traces.
  const double span = high > low ? high - low : 1;
  for (Panel& panel : figure.panels) {
    panel.y.from = low - 0.12 * span;
    panel.y.to = high + 0.42 * span;
  }
  return figure;
}

}  // namespace whine
