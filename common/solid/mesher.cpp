#include "solid/mesher.h"

#include <gmsh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/error.h"
#include "gear/involute.h"
#include "solid/crack.h"
#include "solid/elements.h"

namespace whine {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGmshScale = 1e3;  // gmsh works in millimetres: its tolerances are meant for numbers near 1

// Which exact curve a boundary edge lies on.
enum class Curve { none, top_land, flank, root, sector_edge, bore, centre_line };

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

// q such that first (1 + q + ... + q^(n-1)) = length; at least 1, so `first` is an upper limit.
double growth_ratio(double first, double length, int n) {
  if (first * n >= length) return 1;
  double low = 1, high = 10;
  for (int i = 0; i < 100; ++i) {
    const double q = 0.5 * (low + high);
    double sum = 0, term = first;
    for (int k = 0; k < n; ++k, term *= q) sum += term;
    (sum < length ? low : high) = q;
  }
  return 0.5 * (low + high);
}

// Sizes and corner points of the six blocks of the half sector x <= 0.
struct Plan {
  double tip_size, tip_ratio;  // m, 1: along the flank from the corner
  double across_ratio;         // 1: growth from the flank to the centre line
  int n_tip, n_flank, n_fillet, n_root, n_across, n_under, n_rim;
  double rim_ratio;
  double xi_split, t_split;  // flank: end of the graded part; root curve: corner of three blocks
  double ring_radius;        // m: lower end of the tooth region
  double ring_angle;         // rad: polar angle of the foot under the corner of three blocks
  Vec2 split, fillet_corner, chord_centre;
};

double root_length(const ToothGeometry& tooth, double from, double to) {
  constexpr int kPieces = 400;
  double length = 0;
  for (int i = 0; i < kPieces; ++i)
    length += (tooth.root_point(from + (to - from) * (i + 1) / kPieces) -
               tooth.root_point(from + (to - from) * i / kPieces))
                  .norm();
  return length;
}

Plan make_plan(const ToothGeometry& tooth, double h) {
  const GearDesign& design = tooth.design();
  Plan plan{};
  const double tip = tooth.tip_roll_angle(), form = tooth.form_roll_angle();
  const double flank = tooth.arc_length(tip) - tooth.arc_length(form);
  const double half_top = 0.5 * tooth.thickness_at_radius(tooth.tip_radius());
  plan.tip_size = std::min({design.module / 600, h / 80, half_top / 3, flank / 8});

  // Along the flank: geometric growth from the corner until the wanted size is reached, then even.
  constexpr double kGrowth = 1.7;
  plan.n_tip = std::max(2, static_cast<int>(std::ceil(std::log(h / plan.tip_size) / std::log(kGrowth))));
  const double q = std::pow(h / plan.tip_size, 1.0 / plan.n_tip);
  const double graded = std::min(plan.tip_size * (std::pow(q, plan.n_tip) - 1) / (q - 1), 0.6 * flank);
  plan.tip_ratio = growth_ratio(plan.tip_size, graded, plan.n_tip);
  plan.xi_split = std::sqrt(tip * tip - 2 * graded / tooth.base_radius());
  plan.n_flank = std::max(2, static_cast<int>(std::ceil((flank - graded) / h - 0.2)));
  plan.split = tooth.flank_point(plan.xi_split);

  // The corner of three blocks sits where the root curve has turned half way from the flank to the root
  // circle.
  auto tangent = [&](double t) {
    const double step = 1e-4;
    const Vec2 d = tooth.root_point(std::min(t + step, 1.0)) - tooth.root_point(std::max(t - step, 0.0));
    return std::atan2(d.y(), d.x());
  };
  auto turned = [&](double t) { return std::remainder(tangent(t) - tangent(0), 2 * kPi); };
  const double half_turn = 0.5 * turned(1);
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.5 * (low + high);
    (std::abs(turned(t)) < std::abs(half_turn) ? low : high) = t;
  }
  plan.t_split = 0.5 * (low + high);
  plan.fillet_corner = tooth.root_point(plan.t_split);
  plan.n_fillet = std::max(3, static_cast<int>(std::ceil(root_length(tooth, 0, plan.t_split) / (0.75 * h))));
  plan.n_root = std::max(3, static_cast<int>(std::ceil(root_length(tooth, plan.t_split, 1) / h)));

  // The tooth region ends on a ring one module below the root, or half way to the bore on a thin rim.
  const double rim = tooth.root_radius() - design.bore_radius;
  const double depth = std::min(design.module, 0.5 * rim);
  plan.ring_radius = tooth.root_radius() - depth;
  plan.n_under = std::max(2, static_cast<int>(std::ceil(depth / (1.25 * h))));
  const double drop = std::min(-plan.fillet_corner.x() * std::tan(kPi / 9), 0.4 * depth);
  plan.chord_centre = {0, plan.fillet_corner.y() - drop};
  const double half_pitch = kPi / design.teeth;
  const double corner_angle = std::atan2(plan.fillet_corner.y(), plan.fillet_corner.x()) - 0.5 * kPi;
  plan.ring_angle = 0.5 * kPi + std::clamp(corner_angle - 0.2 * depth / plan.ring_radius, 0.3 * half_pitch,
                                           0.9 * half_pitch);

  // Across: the tip size at the corner, and no layer above three times the wanted size at the root.
  const double half_root = -plan.fillet_corner.x();
  for (plan.n_across = 3; plan.n_across < 200; ++plan.n_across) {
    plan.across_ratio = growth_ratio(plan.tip_size, half_top, plan.n_across);
    double sum = 0;
    for (int k = 0; k < plan.n_across; ++k) sum += std::pow(plan.across_ratio, k);
    const double largest = half_root * std::pow(plan.across_ratio, plan.n_across - 1) / sum;
    if (plan.across_ratio < 1.8 && largest < 3 * h) break;
  }

  // Towards the bore: growth from the ring.
  const double rim_length = plan.ring_radius - design.bore_radius, rim_first = std::min(2 * h, rim_length);
  for (plan.n_rim = 1; plan.n_rim < 1000; ++plan.n_rim) {
    plan.rim_ratio = growth_ratio(rim_first, rim_length, plan.n_rim);
    if (plan.rim_ratio < 1.35) break;
  }
  return plan;
}

// The mesh of the half sector as gmsh leaves it, with exact boundary nodes.
struct HalfMesh {
  std::vector<Vec2> node;
  std::vector<std::array<int, 4>> element;    // counter-clockwise
  std::vector<int> region;                    // per element
  std::map<std::pair<int, int>, Curve> edge;  // boundary edges, lower node number first
};

// Builds the blocks in gmsh and reads the mesh back.
class HalfSector {
 public:
  HalfSector(const ToothGeometry& tooth, const Plan& plan) : tooth_(tooth), plan_(plan) { build(); }
  HalfMesh mesh();

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
  const Plan& plan_;
  int centre_ = 0;
  std::map<int, Curve> kind_;
  std::vector<std::pair<int, int>> surfaces_;  // tag, region
};

void HalfSector::build() {
  const Plan& p = plan_;
  const double edge = 0.5 * kPi + kPi / tooth_.design().teeth, bore = tooth_.design().bore_radius;
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
  const int fillet_low = spline(fillet, root_end, root, p.t_split, 1, p.n_root, 1, Curve::root);
  const int under_edge = line(root_end, ring_edge, p.n_under, 1, Curve::sector_edge);
  const int under_foot = line(fillet, ring_foot, p.n_under, 1);
  const int under_centre = line(chord_centre, ring_centre, p.n_under, 1, Curve::centre_line);
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
  surface({under_edge, -ring_root, -under_foot, fillet_low}, {root_end, ring_edge, ring_foot, fillet}, 1);
  surface({rim_foot, bore_tooth, -rim_centre, -ring_tooth}, {ring_foot, bore_foot, bore_centre, ring_centre},
          0);
  surface({rim_edge, -bore_root, -rim_foot, ring_root}, {ring_edge, bore_edge, bore_foot, ring_foot}, 0);
}

HalfMesh HalfSector::mesh() {
  gmsh::model::geo::synchronize();
  gmsh::model::mesh::generate(2);

  HalfMesh half;
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

// Puts points on exact curves of the half sector.
class ExactBoundary {
 public:
  explicit ExactBoundary(const ToothGeometry& tooth) : tooth_(tooth) {
    const double angle = 0.5 * kPi + kPi / tooth.design().teeth;
    edge_ = {std::cos(angle), std::sin(angle)};
  }
  double roll_angle(const Vec2& p) const {
    const double r = std::max(p.norm(), tooth_.base_radius());
    return std::clamp(tooth_.roll_angle_at_radius(r), tooth_.form_roll_angle(), tooth_.tip_roll_angle());
  }
  Vec2 put(Curve kind, const Vec2& p) const {
    switch (kind) {
      case Curve::top_land:
        return p * (tooth_.tip_radius() / p.norm());
      case Curve::bore:
        return p * (tooth_.design().bore_radius / p.norm());
      case Curve::flank:
        return tooth_.flank_point(roll_angle(p));
      case Curve::root:
        return tooth_.root_point(
            nearest_parameter([this](double t) { return tooth_.root_point(t); }, p, 0, 1));
      case Curve::sector_edge:
        return edge_ * edge_.dot(p);
      case Curve::centre_line:
        return {0, p.y()};
      case Curve::none:
        break;
    }
    return p;
  }
  // Between two nodes of a boundary edge.
  Vec2 middle(Curve kind, const Vec2& a, const Vec2& b) const {
    if (kind == Curve::flank) return tooth_.flank_point(0.5 * (roll_angle(a) + roll_angle(b)));
    return put(kind, 0.5 * (a + b));
  }

 private:
  const ToothGeometry& tooth_;
  Vec2 edge_;
};

// Moves boundary nodes onto their curves; a corner of the sector goes onto both of its curves by taking the
// point of the geometry itself.
void make_exact(HalfMesh& half, const ToothGeometry& tooth, const ExactBoundary& exact) {
  std::map<int, std::vector<Curve>> kinds;
  for (const auto& [edge, kind] : half.edge)
    for (int node : {edge.first, edge.second}) {
      auto& list = kinds[node];
      if (std::find(list.begin(), list.end(), kind) == list.end()) list.push_back(kind);
    }
  for (const auto& [node, list] : kinds) {
    Vec2& p = half.node[static_cast<size_t>(node)];
    auto has = [&list = list](Curve kind) { return std::find(list.begin(), list.end(), kind) != list.end(); };
    if (has(Curve::flank) && has(Curve::top_land))
      p = tooth.flank_point(tooth.tip_roll_angle());
    else if (has(Curve::flank) && has(Curve::root))
      p = tooth.flank_point(tooth.form_roll_angle());
    else if (has(Curve::root) && has(Curve::sector_edge))
      p = exact.put(Curve::sector_edge, tooth.root_point(1));
    else if (has(Curve::centre_line))
      p = {0, has(Curve::top_land) ? tooth.tip_radius()
              : has(Curve::bore)   ? tooth.design().bore_radius
                                   : p.y()};
    else if (has(Curve::bore) && has(Curve::sector_edge))
      p = exact.put(Curve::bore, exact.put(Curve::sector_edge, p));
    else
      p = exact.put(list.front(), p);
  }
}

// How far the middle of each element side lies off its chord. The bulge of a curved boundary is handed on
// from layer to layer, fading out, because a thin element with one curved and one straight long side would be
// folded.
std::map<std::pair<int, int>, Vec2> side_bulges(const HalfMesh& half, const ExactBoundary& exact) {
  std::map<std::pair<int, int>, std::vector<std::pair<size_t, size_t>>>
      owners;  // side: element, number of the side
  auto side_of = [&half](size_t e, size_t k) {
    return std::pair<int, int>(std::minmax(half.element[e][k], half.element[e][(k + 1) % 4]));
  };
  for (size_t e = 0; e < half.element.size(); ++e)
    for (size_t k = 0; k < 4; ++k) owners[side_of(e, k)].emplace_back(e, k);
  std::map<std::pair<int, int>, Vec2> bulge;
  for (const auto& [side, kind] : half.edge) {
    const Vec2 a = half.node[static_cast<size_t>(side.first)],
               b = half.node[static_cast<size_t>(side.second)];
    bulge[side] = exact.middle(kind, a, b) - 0.5 * (a + b);
  }
  constexpr int kLayers = 8;
  for (const auto& [boundary, kind] : half.edge) {
    auto [element, number] = owners.at(boundary).front();
    for (int layer = 1; layer < kLayers; ++layer) {
      number = (number + 2) % 4;
      const auto side = side_of(element, number);
      if (half.edge.contains(side)) break;
      bulge.emplace(side, bulge.at(boundary) * (1 - static_cast<double>(layer) / kLayers));
      const auto& two = owners.at(side);
      std::tie(element, number) = two[0].first == element ? two[1] : two[0];
    }
  }
  return bulge;
}

// Adds mid-side and centre nodes. (element, 9)
std::vector<std::array<int, 9>> raise_order(HalfMesh& half, const ExactBoundary& exact) {
  const auto bulge = side_bulges(half, exact);
  std::map<std::pair<int, int>, int> middle;
  std::vector<std::array<int, 9>> nine;
  for (const auto& corner : half.element) {
    std::array<int, 9> element{};
    for (size_t k = 0; k < 4; ++k) {
      element[k] = corner[k];
      const std::pair<int, int> key = std::minmax(corner[k], corner[(k + 1) % 4]);
      const auto [found, added] = middle.emplace(key, static_cast<int>(half.node.size()));
      if (added) {
        const Vec2 a = half.node[static_cast<size_t>(key.first)],
                   b = half.node[static_cast<size_t>(key.second)];
        const auto edge = half.edge.find(key);
        const auto off = bulge.find(key);
        if (edge != half.edge.end())
          half.node.push_back(exact.middle(edge->second, a, b));
        else
          half.node.push_back(0.5 * (a + b) + (off == bulge.end() ? Vec2(0, 0) : off->second));
      }
      element[4 + k] = found->second;
    }
    Vec2 centre = Vec2::Zero();  // transfinite map of the boundary
    for (size_t k = 0; k < 4; ++k)
      centre += 0.5 * half.node[static_cast<size_t>(element[4 + k])] -
                0.25 * half.node[static_cast<size_t>(corner[k])];
    element[8] = static_cast<int>(half.node.size());
    half.node.push_back(centre);
    nine.push_back(element);
  }
  return nine;
}

}  // namespace

double nearest_parameter(const std::function<Vec2(double)>& curve, const Vec2& p, double from, double to) {
  constexpr int kScan = 200;
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kScan; ++i) {
    const double d = (curve(from + (to - from) * i / kScan) - p).squaredNorm();
    if (d < least) {
      least = d;
      best = i;
    }
  }
  double low = from + (to - from) * std::max(best - 1, 0) / kScan;
  double high = from + (to - from) * std::min(best + 1, kScan) / kScan;
  const double ratio = 0.5 * (std::sqrt(5.0) - 1);
  for (int i = 0; i < 80; ++i) {
    const double a = high - ratio * (high - low), b = low + ratio * (high - low);
    ((curve(a) - p).squaredNorm() < (curve(b) - p).squaredNorm() ? high : low) =
        (curve(a) - p).squaredNorm() < (curve(b) - p).squaredNorm() ? b : a;
  }
  return 0.5 * (low + high);
}

Triangulation triangulate(const std::vector<Vec2>& polygon, const std::vector<Vec2>& slit, double finest,
                          double largest) {
  Triangulation result;
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

    std::map<std::size_t, int> number;
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    for (int tag : point) {
      gmsh::model::mesh::getNodes(tags, coordinates, parameters, 0, tag);
      number[tags.at(0)] = static_cast<int>(number.size());
    }
    result.node = polygon;
    result.node.insert(result.node.end(), slit.begin() + 1, slit.end());
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
  });
  return result;
}

double exact_sector_area(const GearDesign& design) {
  const ToothGeometry tooth(design);
  const GaussRule rule = gauss_rule(8);
  // Half of the boundary integral of r^2 dangle; edges through the centre give nothing.
  auto swept = [&](const std::function<Vec2(double)>& curve, double from, double to, int pieces) {
    double sum = 0;
    for (int i = 0; i < pieces; ++i)
      for (int g = 0; g < 8; ++g) {
        const double width = (to - from) / pieces, t = from + width * (i + 0.5 + 0.5 * rule.point[g]);
        const double step = 1e-5 * width;
        const Vec2 p = curve(t), d = (curve(t + step) - curve(t - step)) / (2 * step);
        sum += 0.25 * width * rule.weight[g] * (p.x() * d.y() - p.y() * d.x());
      }
    return sum;
  };
  const double half_top = 0.5 * tooth.thickness_at_radius(tooth.tip_radius()) / tooth.tip_radius();
  double half = 0.5 * half_top * tooth.tip_radius() * tooth.tip_radius();
  half += swept([&](double xi) { return tooth.flank_point(xi); }, tooth.tip_roll_angle(),
                tooth.form_roll_angle(), 20);
  // The root curve has a corner in its curvature where the trochoid meets the root circle.
  auto root = [&](double t) { return tooth.root_point(t); };
  half += swept(root, 0, tooth.root_corner(), 40);
  if (tooth.root_corner() < 1) half += swept(root, tooth.root_corner(), 1, 1);
  half -= 0.5 * kPi / design.teeth * design.bore_radius * design.bore_radius;
  return 2 * half;
}

void check_sector_mesh(const MeshArtifact& mesh) {
  const double least = least_jacobian(mesh.node_position, mesh.element_node);
  constexpr double kLeastJacobian = 0.01;
  if (!(least > kLeastJacobian))
    fail(Failure::numerical, "sector mesh: least Jacobian determinant is ", least,
         " of the element's mean, at least ", kLeastJacobian,
         " is needed: elements are folded or taper too much; change element_mm or raise bore_radius_mm");
  const double angle = 2 * kPi / mesh.design.teeth;
  const Eigen::Rotation2Dd turn(angle);
  const double scale = mesh.node_position.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < mesh.side_node.rows(); ++i) {
    const Vec2 low = mesh.node_position.row(mesh.side_node(i, 0)),
               high = mesh.node_position.row(mesh.side_node(i, 1));
    const double gap = (turn * low - high).norm();
    if (!(gap <= 1e-14 * scale))
      fail(Failure::numerical, "sector mesh: side node ", mesh.side_node(i, 1), " lies ", gap,
           " m off the image of its partner, at most ", 1e-14 * scale, " m is allowed");
  }
  const double area = mesh_area(mesh.node_position, mesh.element_node),
               exact = exact_sector_area(mesh.design);
  const double allowed = mesh.element_node.cols() == 4 ? 5e-3 : 2e-4;  // chords cut off more than parabolas
  if (!(std::abs(area - exact) <= allowed * exact))
    fail(Failure::numerical, "sector mesh: area ", area, " m2 against ", exact,
         " m2 of the exact sector, relative difference ", area / exact - 1, ", at most ", allowed,
         " is allowed; lower element_mm");
}

MeshArtifact make_sector_mesh(const GearDesign& design, const BodyDiscretisation& discretisation) {
  const ToothGeometry tooth(design);
  const double h = discretisation.element_size;
  if (discretisation.element_order != 1 && discretisation.element_order != 2)
    fail(Failure::input, "element_order = ", discretisation.element_order, " is not 1 or 2");
  // The limits themselves are allowed, however they are rounded.
  constexpr double kRoundOff = 1e-9;
  if (!(h >= (0.01 - kRoundOff) * design.module && h <= (2 + kRoundOff) * design.module))
    fail(Failure::input, "element_mm = ", h * 1e3, " is not between 0.01 and 2 modules (",
         1e1 * design.module, " to ", 2e3 * design.module, " mm)");
  if (!(design.bore_radius > 0))
    fail(Failure::input, "bore_radius_mm = ", design.bore_radius * 1e3,
         " is not above 0: the hub on which the gear turns needs a radius");

  HalfMesh half;
  with_gmsh("the tooth sector", [&] {
    const Plan plan = make_plan(tooth, h);
    half = HalfSector(tooth, plan).mesh();
  });
  const ExactBoundary exact(tooth);
  make_exact(half, tooth, exact);

  const bool second = discretisation.element_order == 2;
  std::vector<std::array<int, 9>> elements;
  if (second) {
    elements = raise_order(half, exact);
  } else {
    for (const auto& corner : half.element) elements.push_back({corner[0], corner[1], corner[2], corner[3]});
  }

  // The mirror image; nodes on the centre line are their own.
  const int count = static_cast<int>(half.node.size()), per_element = second ? 9 : 4;
  std::vector<int> image(half.node.size());
  std::vector<Vec2> node = half.node;
  for (int i = 0; i < count; ++i) {
    const Vec2 p = half.node[static_cast<size_t>(i)];
    if (p.x() == 0) {
      image[static_cast<size_t>(i)] = i;
    } else {
      image[static_cast<size_t>(i)] = static_cast<int>(node.size());
      node.emplace_back(-p.x(), p.y());
    }
  }

  MeshArtifact mesh;
  mesh.design = design;
  mesh.discretisation = discretisation;
  mesh.node_position.resize(static_cast<Eigen::Index>(node.size()), 2);
  for (size_t i = 0; i < node.size(); ++i) mesh.node_position.row(static_cast<Eigen::Index>(i)) = node[i];
  const Eigen::Index half_elements = static_cast<Eigen::Index>(elements.size());
  mesh.element_node.resize(2 * half_elements, per_element);
  mesh.element_region.resize(2 * half_elements);
  constexpr int kMirrored[9] = {0, 3, 2, 1, 7, 6, 5, 4, 8};  // counter-clockwise again
  for (Eigen::Index e = 0; e < half_elements; ++e) {
    for (int k = 0; k < per_element; ++k) {
      mesh.element_node(e, k) = elements[static_cast<size_t>(e)][static_cast<size_t>(k)];
      mesh.element_node(half_elements + e, k) =
          image[static_cast<size_t>(elements[static_cast<size_t>(e)][static_cast<size_t>(kMirrored[k])])];
    }
    mesh.element_region[e] = mesh.element_region[half_elements + e] = half.region[static_cast<size_t>(e)];
  }

  // Node sets, from the edges of the elements that lie on a curve.
  std::map<int, double> flank, side, bore;  // node of the half sector: roll angle, radius, polar angle
  for (const auto& element : elements)
    for (size_t k = 0; k < 4; ++k) {
      const auto edge = half.edge.find(std::minmax(element[k], element[(k + 1) % 4]));
      if (edge == half.edge.end()) continue;
      std::vector<int> on{element[k], element[(k + 1) % 4]};
      if (second) on.push_back(element[4 + k]);
      for (int i : on) {
        const Vec2 p = half.node[static_cast<size_t>(i)];
        if (edge->second == Curve::flank) flank[i] = exact.roll_angle(p);
        if (edge->second == Curve::sector_edge) side[i] = p.norm();
        if (edge->second == Curve::bore) bore[i] = p.x();
      }
    }
  auto sorted = [](const std::map<int, double>& set) {
    std::vector<std::pair<double, int>> list;
    list.reserve(set.size());
    for (const auto& [i, value] : set) list.emplace_back(value, i);
    std::sort(list.begin(), list.end());
    return list;
  };
  const auto flank_list = sorted(flank), side_list = sorted(side), bore_list = sorted(bore);
  mesh.flank_node.resize(static_cast<Eigen::Index>(flank_list.size()));
  mesh.flank_roll_angle.resize(mesh.flank_node.size());
  for (size_t i = 0; i < flank_list.size(); ++i) {
    mesh.flank_node[static_cast<Eigen::Index>(i)] = flank_list[i].second;
    mesh.flank_roll_angle[static_cast<Eigen::Index>(i)] = flank_list[i].first;
  }
  mesh.side_node.resize(static_cast<Eigen::Index>(side_list.size()), 2);
  for (size_t i = 0; i < side_list.size(); ++i) {
    mesh.side_node(static_cast<Eigen::Index>(i), 0) = image[static_cast<size_t>(side_list[i].second)];
    mesh.side_node(static_cast<Eigen::Index>(i), 1) = side_list[i].second;
  }
  std::vector<int> bore_nodes;
  for (const auto& [x, i] : bore_list) {
    bore_nodes.push_back(i);
    if (image[static_cast<size_t>(i)] != i) bore_nodes.push_back(image[static_cast<size_t>(i)]);
  }
  mesh.bore_node =
      Eigen::Map<Eigen::VectorXi>(bore_nodes.data(), static_cast<Eigen::Index>(bore_nodes.size()));
  check_sector_mesh(mesh);
  if (design.crack.depth > 0) mesh.cracked_tooth.push_back(make_cracked_sector(mesh));
  return mesh;
}

}  // namespace whine
