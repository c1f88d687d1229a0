#include "system/mode_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "gear/pair.h"
#include "gear/system_layout.h"
#include "gear/tooth_contour.h"

namespace whine {
namespace {

using Eigen::Index;

constexpr int kOutlineFlankPoints = 6;

// Contour of the teeth and the other edge of the body, point by point at one angle each; closed.
struct Outline {
  std::vector<Vec2> teeth, edge;
};

Outline outline_of(const GearDesign& design) {
  Outline out{gear_contour(ToothGeometry(design), kOutlineFlankPoints), {}};
  out.edge.reserve(out.teeth.size());
  for (const Vec2& p : out.teeth) out.edge.push_back(p.normalized() * design.clamped_radius());
  return out;
}

// Of a rigid gear of `teeth` teeth, on the pitch circle of radius r.
Outline plain_outline(int teeth, double r, bool ring) {
  Outline out;
  const double module = 2 * r / teeth, tip = ring ? -0.9 : 0.9, root = ring ? 1.1 : -1.1;
  for (int j = 0; j < teeth; ++j)
    for (const auto& [share, height] :
         {std::pair{-0.30, root}, std::pair{-0.13, tip}, std::pair{0.13, tip}, std::pair{0.30, root}}) {
      const double angle = 0.5 * kPi + 2 * kPi * (j + share) / teeth;
      const Vec2 towards(std::cos(angle), std::sin(angle));
      out.teeth.push_back((r + height * module) * towards);
      out.edge.push_back((ring ? r + 3 * module : 0.6 * r) * towards);
    }
  out.teeth.push_back(out.teeth.front());
  out.edge.push_back(out.edge.front());
  return out;
}

// Points, cells and lines of all bodies, and which body each is of.
struct Drawing {
  std::vector<Vec2> point;
  std::vector<int> point_body, cell_body, line_body;
  std::vector<std::array<int, 4>> cell;
  std::vector<std::array<int, 2>> line;

  int add(const Vec2& p, int b) {
    point.push_back(p);
    point_body.push_back(b);
    return static_cast<int>(point.size()) - 1;
  }
};

void add_gear(const System& s, int b, const GearDesign* design, Drawing& out) {
  const System::Body& body = s.bodies[static_cast<size_t>(b)];
  const Outline outline =
      design ? outline_of(*design) : plain_outline(body.teeth, working_radius(s, b), is_ring(s, b));
  const Placement at{body.angle, Vec2(body.centre[0], body.centre[1])};
  const int first = static_cast<int>(out.point.size());
  const int count = static_cast<int>(outline.teeth.size()) - 1;  // the last point is the first one
  for (int i = 0; i < count; ++i) {
    out.add(at(outline.teeth[static_cast<size_t>(i)]), b);
    out.add(at(outline.edge[static_cast<size_t>(i)]), b);
  }
  for (int i = 0; i < count; ++i) {
    const int here = first + 2 * i, next = first + 2 * ((i + 1) % count);
    out.cell.push_back({here, next, next + 1, here + 1});
    out.cell_body.push_back(b);
  }
}

void add_carrier(const System& s, int b, Drawing& out) {
  const auto place = [](const System::Body& body) { return Vec2(body.centre[0], body.centre[1]); };
  const int hub = out.add(place(s.bodies[static_cast<size_t>(b)]), b);
  for (const System::Body& planet : s.bodies) {
    if (planet.on != b) continue;
    out.line.push_back({hub, out.add(place(planet), b)});
    out.line_body.push_back(b);
  }
}

double kind_of(const System::Body& body) {
  return body.kind == System::BodyKind::carrier ? 2 : body.on == System::kGround ? 0 : 1;
}

// m: half of the longer side of the drawing's box.
double half_width(const MatrixRM& point) {
  return 0.5 * (point.colwise().maxCoeff() - point.colwise().minCoeff()).maxCoeff();
}

// Hz, to six digits: frequencies of a torsional train may lie below 1 Hz.
double in_digits(double f) {
  if (f == 0) return 0;
  const double unit = std::pow(10, std::floor(std::log10(f)) - 5);
  return unit < 1 ? std::round(f / unit) / std::round(1 / unit) : std::round(f);
}

std::string mode_name(const ModesResult& a, Index i) {
  const double f = a.natural_frequency[i];
  return text("mode_", i < 9 ? "0" : "", i + 1, "_",
              f == 0 ? std::string("free") : name_of(a.type[static_cast<size_t>(i)]), "_", in_digits(f),
              "_Hz");
}

}  // namespace

void add_mode_view(ModesResult& a, const std::vector<const GearDesign*>& design) {
  const System& s = a.layout;
  if (design.size() != s.bodies.size())
    fail(Failure::input, "a view of ", s.bodies.size(), " bodies needs a drawing, or none, of each; ",
         design.size(), " given");
  Drawing drawing;
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b)
    if (s.bodies[static_cast<size_t>(b)].kind == System::BodyKind::carrier)
      add_carrier(s, b, drawing);
    else
      add_gear(s, b, design[static_cast<size_t>(b)], drawing);
  const auto points = static_cast<Index>(drawing.point.size()),
             cells = static_cast<Index>(drawing.cell.size()), lines = static_cast<Index>(drawing.line.size());
  ModesResult::View& view = a.view;
  view = {};
  if (points == 0) return;
  view.point.resize(points, 2);
  for (Index i = 0; i < points; ++i) view.point.row(i) = drawing.point[static_cast<size_t>(i)].transpose();
  view.cell.resize(cells, 4);
  view.line.resize(lines, 2);
  LoadedResult::Field number{"body", "1", MatrixRM(cells + lines, 1)}, kind = number;
  kind.name = "kind";
  const auto take = [&](Index row, int body) {
    number.values(row, 0) = body;
    kind.values(row, 0) = kind_of(s.bodies[static_cast<size_t>(body)]);
  };
  for (Index e = 0; e < cells; ++e) {
    for (Index k = 0; k < 4; ++k)
      view.cell(e, k) = drawing.cell[static_cast<size_t>(e)][static_cast<size_t>(k)];
    take(e, drawing.cell_body[static_cast<size_t>(e)]);
  }
  for (Index e = 0; e < lines; ++e) {
    for (Index k = 0; k < 2; ++k)
      view.line(e, k) = drawing.line[static_cast<size_t>(e)][static_cast<size_t>(k)];
    take(cells + e, drawing.line_body[static_cast<size_t>(e)]);
  }
  view.cell_data = {number, kind};
  const double half = half_width(view.point);
  for (Index mode = 0; mode < a.natural_frequency.size(); ++mode) {
    const MatrixRM& shape = a.shape[static_cast<size_t>(mode)];
    MatrixRM moved(points, 2);
    for (Index i = 0; i < points; ++i) {
      const int b = drawing.point_body[static_cast<size_t>(i)];
      const System::Body& body = s.bodies[static_cast<size_t>(b)];
      const double turn = body.sense * shape(b, 0) / body.radius;
      moved(i, 0) = shape(b, 1) - turn * (view.point(i, 1) - body.centre[1]);
      moved(i, 1) = shape(b, 2) + turn * (view.point(i, 0) - body.centre[0]);
    }
    if (const double most = moved.rowwise().norm().maxCoeff(); most > 0) moved *= kShownMotion * half / most;
    view.point_data.push_back({mode_name(a, mode), "m", moved});
  }
}

}  // namespace whine
