#include "report/system_picture.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "gear/layout.h"
#include "gear/pair.h"
#include "gear/system_layout.h"
#include "gear/tooth_contour.h"
#include "gear/train.h"
#include "report/figure_words.h"

namespace whine {
namespace {

using Eigen::Index;

constexpr int kPictureFlankPoints = 10, kCirclePoints = 180;
constexpr size_t kMostCloseUps = 3;
constexpr double kSmallTorque = 10;  // N m: torques below it are shown with three digits

// What is drawn, and of which bodies the drawing is known.
struct Train {
  const System& layout;
  std::vector<const GearDesign*> design;  // [body] nullptr: not known
  std::vector<int> section;               // [mesh] number of its [[mesh]]; empty: not known
  std::vector<bool> second = {};          // [body] whether it has the second of the two colours
};

const System::Body& body_of(const System& s, int b) {
  return s.bodies[static_cast<size_t>(b)];
}

Vec2 centre_of(const System::Body& body) {
  return {body.centre[0], body.centre[1]};
}

double radius_in(const System::Body& body, const System::Mesh& mesh) {
  return body.radius / std::cos(mesh.pressure_angle);
}

Vec2 pitch_point(const System& s, const System::Mesh& mesh) {
  const System::Body& first = body_of(s, mesh.side[0].body);
  return centre_of(first) + radius_in(first, mesh) * Vec2(std::cos(mesh.direction), std::sin(mesh.direction));
}

// m: of all that is drawn of a gear.
double drawn_radius(const Train& t, int b) {
  if (const GearDesign* design = t.design[static_cast<size_t>(b)])
    return design->internal ? design->rim_outer_radius : ToothGeometry(*design).tip_radius();
  double out = 0;
  for (const System::Mesh& mesh : t.layout.meshes)
    for (const System::Side& side : mesh.side)
      if (side.body == b) out = std::max(out, radius_in(body_of(t.layout, b), mesh));
  return 1.04 * out;
}

struct Blocks {
  FigureBlock rim{"rim", {"x [mm]", "y [mm]"}, {}}, second_rim{"second_rim", {"x [mm]", "y [mm]"}, {}},
      hollow{"hollow", {"x [mm]", "y [mm]"}, {}}, second_hollow{"second_hollow", {"x [mm]", "y [mm]"}, {}},
      central{"central", {"x [mm]", "y [mm]"}, {}}, planets{"planets", {"x [mm]", "y [mm]"}, {}},
      bores{"bores", {"x [mm]", "y [mm]"}, {}}, circles{"circles", {"x [mm]", "y [mm]"}, {}},
      planet_circles{"planet_circles", {"x [mm]", "y [mm]"}, {}},
      carrier{"carrier", {"x [mm]", "y [mm]"}, {}}, arcs{"arcs", {"x [mm]", "y [mm]"}, {}},
      heads{"heads", {"x [mm]", "y [mm]", "dx [mm]", "dy [mm]"}, {}},
      paths{"paths", {"x [mm]", "y [mm]"}, {}};

  // What there is; the template knows by has_<name>.
  void put(Figure& figure) {
    for (FigureBlock* block : {&rim, &second_rim, &hollow, &second_hollow, &central, &planets, &bores,
                               &circles, &planet_circles, &carrier, &arcs, &heads, &paths}) {
      figure.numbers.emplace_back("has_" + block->name, block->rows.empty() ? 0 : 1);
      if (block->rows.empty()) continue;
      block->drawing = true;
      figure.blocks.push_back(*block);
    }
  }
};

void add_point(FigureBlock& block, const Vec2& p) {
  block.rows.push_back({p.x() * kMilli, p.y() * kMilli});
}

void add_closed(FigureBlock& block, const std::vector<Vec2>& contour, const Placement& at) {
  for (const Vec2& p : contour) add_point(block, at(p));
  block.rows.emplace_back();
}

// The sense of rotation as an arc with a head, at the radius r.
void add_arrow(Blocks& out, const System::Body& body, double r) {
  constexpr double kFrom = 25, kTo = 95;  // degrees
  constexpr int kSteps = 16;
  std::vector<Vec2> arc;
  arc.reserve(kSteps + 1);
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = (kFrom + (kTo - kFrom) * (body.sense > 0 ? i : kSteps - i) / kSteps) * kPi / 180;
    arc.push_back(centre_of(body) + r * Vec2(std::cos(angle), std::sin(angle)));
  }
  for (const Vec2& p : arc) add_point(out.arcs, p);
  out.arcs.rows.emplace_back();
  const Vec2 from = arc[kSteps - 1] * kMilli, way = (arc[kSteps] - arc[kSteps - 1]) * kMilli;
  out.heads.rows.push_back({from.x(), from.y(), way.x(), way.y()});
}

void add_gear(const Train& t, int b, Blocks& out) {
  const System::Body& body = body_of(t.layout, b);
  const Placement at{body.angle, centre_of(body)};
  const bool second = t.second[static_cast<size_t>(b)];
  if (const GearDesign* design = t.design[static_cast<size_t>(b)]) {
    const ToothGeometry tooth(*design);
    const std::vector<Vec2> contour = gear_contour(tooth, kPictureFlankPoints);
    const auto held = circle_contour(design->clamped_radius(), kCirclePoints);
    // The body of a ring lies between two areas.
    FigureBlock &rim = second ? out.second_rim : out.rim, &hollow = second ? out.second_hollow : out.hollow,
                &whole = second ? out.planets : out.central;
    add_closed(design->internal ? hollow : whole, contour, at);
    add_closed(design->internal ? rim : out.bores, held, at);
    add_arrow(out, body, 0.5 * (design->clamped_radius() + tooth.root_radius()));
    return;
  }
  FigureBlock& circles = second ? out.planet_circles : out.circles;
  double radius = 0;
  for (const System::Mesh& mesh : t.layout.meshes)
    for (const System::Side& side : mesh.side)
      if (side.body == b) {
        radius = radius_in(body, mesh);
        add_closed(circles, circle_contour(radius, kCirclePoints), at);
      }
  const double tick = 0.5 * radius / body.teeth;  // a quarter of a module
  for (int j = 0; j < body.teeth; ++j) {
    const double angle = 0.5 * kPi + 2 * kPi * j / body.teeth;
    const Vec2 towards(std::cos(angle), std::sin(angle));
    add_point(circles, at((radius - tick) * towards));
    add_point(circles, at((radius + tick) * towards));
    circles.rows.emplace_back();
  }
  add_arrow(out, body, (is_ring(t.layout, b) ? 1.07 : 0.75) * radius);
}

void add_carrier(const System& s, int b, Blocks& out) {
  for (const System::Body& planet : s.bodies) {
    if (planet.on != b) continue;
    add_point(out.carrier, centre_of(body_of(s, b)));
    add_point(out.carrier, centre_of(planet));
    out.carrier.rows.emplace_back();
  }
}

void add_path(const Train& t, const System::Mesh& mesh, Blocks& out) {
  const Vec2 at = pitch_point(t.layout, mesh), along = line_of_action(mesh);
  const GearDesign *first = t.design[static_cast<size_t>(mesh.side[0].body)],
                   *second = t.design[static_cast<size_t>(mesh.side[1].body)];
  const System::Body& driver = body_of(t.layout, mesh.side[0].body);
  double from = -kPi * driver.radius / driver.teeth, to = -from;  // half a base pitch each way
  if (first && second) {
    const GearPair pair(*first, *second, mesh.centre_distance);
    from = pair.path_start();
    to = pair.path_end();
  }
  add_point(out.paths, at + from * along);
  add_point(out.paths, at + to * along);
  out.paths.rows.emplace_back();
}

struct Box {
  double left = 1e30, right = -1e30, low = 1e30, high = -1e30;  // mm
};

Box extent_of(const Train& t) {
  Box e;
  for (int b = 0; b < static_cast<int>(t.layout.bodies.size()); ++b) {
    const System::Body& body = body_of(t.layout, b);
    if (body.kind == System::BodyKind::carrier) continue;
    const double r = (is_ring(t.layout, b) ? 1.1 : 1.04) * drawn_radius(t, b);
    e.left = std::min(e.left, (body.centre[0] - r) * kMilli);
    e.right = std::max(e.right, (body.centre[0] + r) * kMilli);
    e.low = std::min(e.low, (body.centre[1] - r) * kMilli);
    e.high = std::max(e.high, (body.centre[1] + r) * kMilli);
  }
  if (!(e.right > e.left)) fail(Failure::input, "figure: the system has no gears that could be drawn");
  return e;
}

// Names stand on the gears' axes, that of a ring on its rim.
void add_labels(const Train& t, Figure& figure) {
  int count = 0;
  for (int b = 0; b < static_cast<int>(t.layout.bodies.size()); ++b) {
    const System::Body& body = body_of(t.layout, b);
    if (body.kind == System::BodyKind::carrier) continue;
    const bool ring = is_ring(t.layout, b);
    const std::string number = std::to_string(++count);
    double x = body.centre[0], y = body.centre[1];
    if (ring) {
      const GearDesign* design = t.design[static_cast<size_t>(b)];
      const double r = design ? 0.5 * (design->rim_outer_radius + ToothGeometry(*design).root_radius())
                              : 1.04 * drawn_radius(t, b);
      x += r * std::cos(1.25 * kPi);
      y += r * std::sin(1.25 * kPi);
    }
    figure.numbers.emplace_back("label_x" + number, x * kMilli);
    figure.numbers.emplace_back("label_y" + number, y * kMilli);
    figure.words.emplace_back("label" + number, text(short_name(body.name), "\n", body.teeth));
  }
  figure.numbers.emplace_back("labels", count);
}

// The first mesh of each [[mesh]], about its pitch point.
size_t add_close_ups(const Train& t, Figure& figure) {
  std::vector<int> seen;
  for (size_t m = 0; m < t.section.size(); ++m) {
    if (std::find(seen.begin(), seen.end(), t.section[m]) != seen.end()) continue;
    seen.push_back(t.section[m]);
    if (seen.size() > kMostCloseUps) continue;
    const System::Mesh& mesh = t.layout.meshes[m];
    const GearDesign* design = t.design[static_cast<size_t>(mesh.side[0].body)];
    if (!design)
      fail(Failure::input, "figure: no drawing is known of '", body_of(t.layout, mesh.side[0].body).name,
           "', which has a mesh");
    const Vec2 at = pitch_point(t.layout, mesh);
    const std::string number = std::to_string(seen.size());
    figure.numbers.emplace_back("close_x" + number, at.x() * kMilli);
    figure.numbers.emplace_back("close_y" + number, at.y() * kMilli);
    figure.numbers.emplace_back("close_half" + number, 1.5 * kPi * design->module * kMilli);
    figure.words.emplace_back(
        "close" + number, text(short_name(mesh_name(t.layout, m)), ", mesh phase ", fixed(mesh.phase, 3)));
  }
  const size_t drawn = std::min(seen.size(), kMostCloseUps);
  if (drawn < seen.size())
    figure.notes.push_back(text("close-ups: the first ", drawn, " of ", seen.size(), " [[mesh]]"));
  return drawn;
}

// Places of the panels on the picture in pixels from its top left; its height.
void place_panels(const Box& e, size_t close_ups, Figure& figure) {
  constexpr double kTop = 120, kLeft = 150, kWidth = 1600, kClose = 400, kGap = 70,
                   kTallest = 3 * kClose + 2 * kGap;
  constexpr int kLine = 24;
  const double aspect = (e.right - e.left) / (e.high - e.low);
  const bool beside = aspect < 1.5 || close_ups == 1;
  // A tall train is bounded by the height of the three close-ups beside it.
  const double width = close_ups == 0 ? std::min(1300.0, 940 * aspect)
                       : beside       ? std::min(910.0, kTallest * aspect)
                                      : 1400,
               high = width / aspect;
  const auto count = static_cast<double>(close_ups);
  double left = kLeft, bottom = kTop + high;
  if (close_ups == 0) left = 0.5 * (kWidth - width);
  for (size_t k = 0; k < close_ups; ++k) {
    const auto n = static_cast<double>(k);
    const double x = beside ? kLeft + width + 80 : kLeft + n * (kClose + kGap),
                 y = beside ? kTop + n * (kClose + kGap) : kTop + high + 130;
    figure.numbers.emplace_back(text("close_left", k + 1), x);
    figure.numbers.emplace_back(text("close_top", k + 1), y);
    bottom = std::max(bottom, y + kClose);
  }
  figure.numbers.insert(figure.numbers.end(), {{"main_left", left},
                                               {"main_top", kTop},
                                               {"main_width", width},
                                               {"main_height", high},
                                               {"close_size", kClose},
                                               {"close_ups", count},
                                               {"left", e.left},
                                               {"right", e.right},
                                               {"low", e.low},
                                               {"high", e.high},
                                               {"notes", static_cast<double>(figure.notes.size())}});
  figure.height = static_cast<int>(bottom) + 105 + kLine * static_cast<int>(figure.notes.size());
  add_lines(figure.notes.size(), figure);
}

FigureBlock bodies_block(const System& s) {
  FigureBlock block{"bodies",
                    {"body", "teeth (0: carrier)", "x [mm]", "y [mm]", "sense (1: counter-clockwise)",
                     "angle of tooth 0 from +y [deg]", "base radius, of a carrier of its pins [mm]"},
                    {}};
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    const System::Body& body = s.bodies[b];
    block.rows.push_back({static_cast<double>(b), static_cast<double>(body.teeth), body.centre[0] * kMilli,
                          body.centre[1] * kMilli, static_cast<double>(body.sense),
                          std::remainder(body.angle, 2 * kPi) * 180 / kPi, body.radius * kMilli});
  }
  return block;
}

// Gears in mesh have the two colours in turn.
std::vector<bool> second_colours(const System& s) {
  std::vector<bool> second(s.bodies.size(), false);
  for (const System::Mesh& mesh : s.meshes)
    second[static_cast<size_t>(mesh.side[1].body)] = !second[static_cast<size_t>(mesh.side[0].body)];
  return second;
}

Figure picture_of(Train t, const Eigen::VectorXd& torque) {
  t.second = second_colours(t.layout);
  Figure figure;
  figure.title = t.layout.bodies.size() > 2 ? "A system of gears" : "The gears";
  Blocks blocks;
  for (int b = 0; b < static_cast<int>(t.layout.bodies.size()); ++b)
    if (body_of(t.layout, b).kind == System::BodyKind::carrier)
      add_carrier(t.layout, b, blocks);
    else
      add_gear(t, b, blocks);
  for (const System::Mesh& mesh : t.layout.meshes) add_path(t, mesh, blocks);
  figure.blocks = {bodies_block(t.layout)};
  blocks.put(figure);
  std::string numbers = "bodies of the table:";
  for (size_t b = 0; b < t.layout.bodies.size(); ++b)
    numbers += text(b == 0 ? " " : ", ", b, " ", short_name(t.layout.bodies[b].name));
  figure.notes = in_lines(bodies_words(t.layout, torque));
  const bool carriers = std::any_of(t.layout.bodies.begin(), t.layout.bodies.end(),
                                    [](const auto& body) { return body.kind == System::BodyKind::carrier; });
  figure.notes.push_back(
      torque.size() > 0
          ? "unloaded at mesh phase 0; black: paths of contact; below a name its number of teeth"
          : "rigid gears: a working pitch circle for each mesh, a tick at each tooth; black: lines of action, one base pitch long; below a name its number of teeth");
  figure.notes.push_back(text("arrows: senses of rotation", carriers ? " relative to the carrier" : "",
                              ", in which torques are positive", carriers ? "; green: its arms" : ""));
  for (const std::string& line : in_lines(numbers)) figure.notes.push_back(line);
  add_labels(t, figure);
  const size_t close_ups = add_close_ups(t, figure);
  place_panels(extent_of(t), close_ups, figure);
  return figure;
}

}  // namespace

std::string bodies_words(const System& s, const Eigen::VectorXd& torque) {
  std::string out;
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    const System::Body& body = s.bodies[b];
    if (body.on != System::kGround) continue;
    const auto column = static_cast<Index>(b);
    const bool carrier = body.kind == System::BodyKind::carrier;
    const double own = torque.size() > 0 ? torque[column] : 0;
    out +=
        text(out.empty() ? "" : ", ", short_name(body.name), carrier ? "" : text(" (", body.teeth, " teeth)"),
             own == 0                        ? ""
             : std::abs(own) >= kSmallTorque ? text(" ", fixed(own, 1), " N m")
                                             : text(" ", shown(own, 3), " N m"),
             !s.held(static_cast<int>(b)) ? ""
             : carrier                    ? " held (the frame)"
                                          : " held");
  }
  return out;
}

Figure system_picture(const SystemStaticResult& a) {
  if (!a.of_train()) return system_picture(a.mesh[0]);
  const SystemStaticParameters& settings = a.settings;
  return picture_of({settings.layout, designs_of(a), settings.section},
                    a.torque.colwise().mean().transpose());
}

System layout_of_pair(const GearPairParameters& a) {
  System s;
  add_input_gear(s, a.mesh.gear[0], a.gear[0].design, a.mesh.bearing[0]);
  add_driven_gear(s, 0, a.gear[0].design, a.mesh.gear[1], a.gear[1].design, a.mesh.centre_distance, 0,
                  a.mesh.bearing[1]);
  return s;
}

Figure system_picture(const StaticResult& a) {
  const System layout = layout_of_pair(a);
  const Eigen::Vector2d torque(a.torque, -a.torque * layout.bodies[1].radius / layout.bodies[0].radius);
  return picture_of({layout, {&a.gear[0].design, &a.gear[1].design}, {0}}, torque);
}

Figure system_picture(const ModesResult& a) {
  return picture_of({a.layout, std::vector<const GearDesign*>(a.layout.bodies.size(), nullptr), {}}, {});
}

}  // namespace whine
