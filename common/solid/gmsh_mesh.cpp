#include "solid/gmsh_mesh.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "base/error.h"
#include "base/units.h"
#include "solid/sector_plan.h"

namespace whine {
namespace {

constexpr double kGmshScale = 1e3;  // gmsh works in millimetres: its tolerances are meant for numbers near 1

// A gmsh session with nothing read from the user's settings and nothing printed.
class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::option::setNumber("Mesh.ElementOrder", 1);
    gmsh::model::add("sector");
  }
  ~GmshSession() { gmsh::finalize(); }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

// Runs `work` in a gmsh session; whatever gmsh throws becomes an Error.
void with_gmsh(const std::string& what, const std::function<void()>& work) {
  try {
    const GmshSession session;
    work();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    fail(Failure::numerical, "gmsh could not mesh ", what, ": ", error.what(), "; change element_mm");
  } catch (const std::string& message) {
    fail(Failure::numerical, "gmsh could not mesh ", what, ": ", message, "; change element_mm");
  } catch (int code) {
    fail(Failure::numerical, "gmsh could not mesh ", what, " (status ", code, "); change element_mm");
  }
}

// Builds the blocks in gmsh and reads the mesh back.
class HalfSector {
 public:
  HalfSector(const ToothGeometry& tooth, const SectorPlan& plan) : tooth_(tooth), plan_(plan) { build(); }
  HalfGrid mesh();

 private:
  int point(const Vec2& p) { return gmsh::model::geo::addPoint(p.x() * kGmshScale, p.y() * kGmshScale, 0); }
  // A curve with n cells, growing by `ratio` from its start.
  int curve(int tag, int n, double ratio, Curve kind) {
    gmsh::model::geo::mesh::setTransfiniteCurve(tag, n + 1, "Progression", ratio);
    kind_[tag] = kind;
    return tag;
  }
  int line(int a, int b, int n, double ratio, Curve kind = Curve::none) {
    return curve(gmsh::model::geo::addLine(a, b), n, ratio, kind);
  }
  int arc(int a, int b, int n, double ratio, Curve kind = Curve::none) {
    return curve(gmsh::model::geo::addCircleArc(a, centre_, b), n, ratio, kind);
  }
  int spline(int a, int b, const std::function<Vec2(double)>& exact, double from, double to, int n,
             double ratio, Curve kind) {
    constexpr int kPieces = 60;
    std::vector<int> points{a};
    for (int i = 1; i < kPieces; ++i) points.push_back(point(exact(from + (to - from) * i / kPieces)));
    points.push_back(b);
    return curve(gmsh::model::geo::addSpline(points), n, ratio, kind);
  }
  void surface(const std::vector<int>& loop, const std::vector<int>& corners, int region) {
    const int tag = gmsh::model::geo::addPlaneSurface({gmsh::model::geo::addCurveLoop(loop)});
    gmsh::model::geo::mesh::setTransfiniteSurface(tag, "Left", corners);
    gmsh::model::geo::mesh::setRecombine(2, tag);
    surfaces_.emplace_back(tag, region);
  }
  void build();

  const ToothGeometry& tooth_;
  const SectorPlan& plan_;
  int centre_ = 0;
  std::map<int, Curve> kind_;
  std::vector<std::pair<int, int>> surfaces_;  // tag, region
};

void HalfSector::build() {
  const SectorPlan& p = plan_;
  const double edge = 0.5 * kPi + kPi / tooth_.design().teeth, bore = tooth_.design().clamped_radius();
  auto polar = [](double r, double angle) { return Vec2(r * std::cos(angle), r * std::sin(angle)); };
  auto flank = [this](double xi) { return tooth_.flank_point(xi); };
  auto root = [this](double t) { return tooth_.root_point(t); };

  centre_ = point({0, 0});
  const int tip_corner = point(tooth_.flank_point(tooth_.tip_roll_angle())),
            tip_centre = point({0, tooth_.tip_radius()});
  const int split = point(p.split), split_centre = point({0, p.split.y()});
  const int form = point(tooth_.flank_point(tooth_.form_roll_angle()));
  const int fillet = point(p.fillet_corner), chord_centre = point(p.chord_centre);
  const int root_end = point(tooth_.root_point(1));
  const int ring_edge = point(polar(p.ring_radius, edge)),
            ring_foot = point(polar(p.ring_radius, p.ring_angle)), ring_centre = point({0, p.ring_radius});
  const int bore_edge = point(polar(bore, edge)), bore_foot = point(polar(bore, p.ring_angle)),
            bore_centre = point({0, bore});

  // Curves run from the flank to the centre line, from the tip to the bore, from the root to the sector edge.
  const double q = p.across_ratio, q_ring = std::sqrt(q);
  const int top = arc(tip_corner, tip_centre, p.n_across, q, Curve::top_land);
  const int flank_tip = spline(tip_corner, split, flank, tooth_.tip_roll_angle(), p.xi_split, p.n_tip,
                               p.tip_ratio, Curve::flank);
  const int centre_tip = line(tip_centre, split_centre, p.n_tip, p.tip_ratio, Curve::centre_line);
  const int across = line(split, split_centre, p.n_across, q);
  const int flank_low =
      spline(split, form, flank, p.xi_split, tooth_.form_roll_angle(), p.n_flank, 1, Curve::flank);
  const int fillet_high = spline(form, fillet, root, 0, p.t_split, p.n_fillet, 1, Curve::root);
  const int centre_tooth = line(split_centre, chord_centre, p.n_flank + p.n_fillet, 1, Curve::centre_line);
  const int chord = line(fillet, chord_centre, p.n_across, q);
  // From the flank on; of a refined root the sharp part and what follows it.
  std::vector<int> fillet_low;
  if (p.t_land < 1) {
    const int land = point(tooth_.root_point(p.t_land));
    fillet_low = {spline(fillet, land, root, p.t_split, p.t_land, p.n_sharp, 1, Curve::root),
                  spline(land, root_end, root, p.t_land, 1, p.n_root - p.n_sharp, 1, Curve::root)};
  } else {
    fillet_low = {spline(fillet, root_end, root, p.t_split, 1, p.n_root, 1, Curve::root)};
  }
  const int under_edge = line(root_end, ring_edge, p.n_under, p.under_ratio, Curve::sector_edge);
  const int under_foot = line(fillet, ring_foot, p.n_under, p.under_ratio);
  const int under_centre = line(chord_centre, ring_centre, p.n_under, p.under_ratio, Curve::centre_line);
  const int ring_root = arc(ring_foot, ring_edge, p.n_root, 1);
  const int ring_tooth = arc(ring_foot, ring_centre, p.n_across, q_ring);
  const int rim_edge = line(ring_edge, bore_edge, p.n_rim, p.rim_ratio, Curve::sector_edge);
  const int rim_foot = line(ring_foot, bore_foot, p.n_rim, p.rim_ratio);
  const int rim_centre = line(ring_centre, bore_centre, p.n_rim, p.rim_ratio, Curve::centre_line);
  const int bore_root = arc(bore_foot, bore_edge, p.n_root, 1, Curve::bore);
  const int bore_tooth = arc(bore_foot, bore_centre, p.n_across, 1, Curve::bore);

  surface({flank_tip, across, -centre_tip, -top}, {tip_corner, split, split_centre, tip_centre}, 1);
  surface({flank_low, fillet_high, chord, -centre_tooth, -across},
          {split, fillet, chord_centre, split_centre}, 1);
  surface({under_foot, ring_tooth, -under_centre, -chord}, {fillet, ring_foot, ring_centre, chord_centre}, 1);
  std::vector<int> under_root{under_edge, -ring_root, -under_foot};
  under_root.insert(under_root.end(), fillet_low.begin(), fillet_low.end());
  surface(under_root, {root_end, ring_edge, ring_foot, fillet}, 1);
  surface({rim_foot, bore_tooth, -rim_centre, -ring_tooth}, {ring_foot, bore_foot, bore_centre, ring_centre},
          0);
  surface({rim_edge, -bore_root, -rim_foot, ring_root}, {ring_edge, bore_edge, bore_foot, ring_foot}, 0);
}

HalfGrid HalfSector::mesh() {
  gmsh::model::geo::synchronize();
  gmsh::model::mesh::generate(2);

  HalfGrid half;
  std::map<std::size_t, int> number;
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::map<std::size_t, Vec2> position;
  for (size_t i = 0; i < tags.size(); ++i)
    position[tags[i]] = Vec2(coordinates[3 * i], coordinates[3 * i + 1]) / kGmshScale;

  constexpr int kQuadrangle = 3;
  for (const auto& [surface, region] : surfaces_) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, 2, surface);
    if (types.size() != 1 || types[0] != kQuadrangle)
      fail(Failure::numerical,
           "gmsh left a block of the sector without quadrilaterals alone; change element_mm");
    for (size_t e = 0; e < elements[0].size(); ++e) {
      std::array<int, 4> corner{};
      for (size_t k = 0; k < 4; ++k) {
        const std::size_t tag = nodes[0][4 * e + k];
        const auto [found, added] = number.emplace(tag, static_cast<int>(half.node.size()));
        if (added) half.node.push_back(position.at(tag));
        corner[k] = found->second;
      }
      const Vec2 a = half.node[corner[2]] - half.node[corner[0]],
                 b = half.node[corner[3]] - half.node[corner[1]];
      if (a.x() * b.y() - a.y() * b.x() < 0) std::swap(corner[1], corner[3]);
      half.element.push_back(corner);
      half.region.push_back(region);
    }
  }
  for (const auto& [curve, kind] : kind_) {
    if (kind == Curve::none) continue;
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, 1, curve);
    for (size_t e = 0; e < elements.at(0).size(); ++e)
      half.edge[std::minmax(number.at(nodes[0][2 * e]), number.at(nodes[0][2 * e + 1]))] = kind;
  }
  return half;
}

// Adds to the result, whose first nodes are the points with these tags, the nodes that gmsh put into the surface and the
// triangles.
void read_triangles(const std::vector<int>& point, int surface, Triangulation& result) {
  std::map<std::size_t, int> number;
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  for (int tag : point) {
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, 0, tag);
    number[tags.at(0)] = static_cast<int>(number.size());
  }
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, 2, surface);
  for (size_t i = 0; i < tags.size(); ++i) {
    number[tags[i]] = static_cast<int>(result.node.size());
    result.node.emplace_back(coordinates[3 * i] / kGmshScale, coordinates[3 * i + 1] / kGmshScale);
  }
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, 2, surface);
  for (size_t e = 0; e < elements.at(0).size(); ++e) {
    std::array<int, 3> corner;
    for (size_t k = 0; k < 3; ++k) corner[k] = number.at(nodes[0][3 * e + k]);
    const auto at = [&](size_t k) { return result.node[static_cast<size_t>(corner[k])]; };
    const Vec2 a = at(1) - at(0), b = at(2) - at(0);
    if (a.x() * b.y() < a.y() * b.x()) std::swap(corner[1], corner[2]);
    result.triangle.push_back(corner);
  }
}

}  // namespace

HalfGrid half_sector_mesh(const ToothGeometry& tooth, double h, double root) {
  HalfGrid half;
  with_gmsh("the tooth sector", [&] {
    const SectorPlan plan = plan_sector(tooth, h, root);
    half = HalfSector(tooth, plan).mesh();
  });
  return half;
}

Triangulation triangulate(const std::vector<Vec2>& polygon, const std::vector<Vec2>& slit, double finest,
                          double largest) {
  Triangulation result;
  result.node = polygon;
  result.node.insert(result.node.end(), slit.begin() + 1, slit.end());
  with_gmsh("the tooth around its crack", [&] {
    namespace geo = gmsh::model::geo;
    std::vector<int> point;  // tags, in the order of the result's first nodes
    const auto add_point = [&](const Vec2& p) {
      point.push_back(geo::addPoint(p.x() * kGmshScale, p.y() * kGmshScale, 0));
      return point.back();
    };
    const auto edge = [&](int a, int b) {
      const int tag = geo::addLine(a, b);
      geo::mesh::setTransfiniteCurve(tag, 2);
      return tag;
    };
    for (const Vec2& p : polygon) add_point(p);
    std::vector<int> loop, inner;
    for (size_t i = 0; i < polygon.size(); ++i)
      loop.push_back(edge(point[i], point[(i + 1) % polygon.size()]));
    const size_t mouth =
        static_cast<size_t>(std::find(polygon.begin(), polygon.end(), slit.front()) - polygon.begin());
    if (mouth == polygon.size()) fail(Failure::numerical, "the slit does not start on the polygon's edge");
    int last = point[mouth];
    for (size_t i = 1; i < slit.size(); ++i) {
      const int next = add_point(slit[i]);
      inner.push_back(edge(last, next));
      last = next;
    }
    const int surface = geo::addPlaneSurface({geo::addCurveLoop(loop)});
    geo::synchronize();
    gmsh::model::mesh::embed(1, inner, 2, surface);
    const auto mm = [](double length) { return text("(", length * kGmshScale, ")"); };
    const int size = gmsh::model::mesh::field::add("MathEval");
    gmsh::model::mesh::field::setString(size, "F",
                                        text("Min(", mm(largest), ", ", mm(finest), " + sqrt((x-",
                                             mm(slit.back().x()), ")^2+(y-", mm(slit.back().y()), ")^2)/3)"));
    gmsh::model::mesh::field::setAsBackgroundMesh(size);
    gmsh::model::mesh::generate(2);
    read_triangles(point, surface, result);
  });
  return result;
}

}  // namespace whine
