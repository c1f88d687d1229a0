#include "solid/crack.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "base/error.h"
#include "gear/crack.h"
#include "solid/elements.h"
#include "solid/exact_boundary.h"
#include "solid/gmsh_mesh.h"
#include "solid/mesher.h"

namespace whine {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kGrowth = 1.0 / 3;  // of an element's size with the distance from a smaller one

using Edge = std::pair<int, int>;  // lower node first

Edge edge_of(int a, int b) {
  return std::minmax(a, b);
}

// A side of an element, counter-clockwise around it.
struct DirectedSide {
  int from = 0, to = 0, middle = -1;
};

std::vector<DirectedSide> sides(const SectorGrid& mesh, Index e) {
  std::vector<DirectedSide> four(4);
  for (int k = 0; k < 4; ++k)
    four[static_cast<size_t>(k)] = {mesh.element_node(e, k), mesh.element_node(e, (k + 1) % 4),
                                    mesh.element_node.cols() == 9 ? mesh.element_node(e, 4 + k) : -1};
  return four;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - along * (b - a)).norm();
}

// Places in [0, length], ends included, whose spacing follows a wanted size (m) of the place.
template <class Size>
std::vector<double> graded_places(double length, const Size& size) {
  constexpr int kPieces = 2000;
  std::vector<double> sum(kPieces + 1, 0.0);
  for (int i = 0; i < kPieces; ++i)
    sum[static_cast<size_t>(i) + 1] =
        sum[static_cast<size_t>(i)] + length / kPieces / size(length * (i + 0.5) / kPieces);
  const int cells = std::max(1, static_cast<int>(std::ceil(sum.back() - 1e-9)));
  std::vector<double> places{0};
  int at = 0;
  for (int k = 1; k < cells; ++k) {
    const double wanted = sum.back() * k / cells;
    while (sum[static_cast<size_t>(at) + 1] < wanted) ++at;
    const double low = sum[static_cast<size_t>(at)], high = sum[static_cast<size_t>(at) + 1];
    places.push_back(length * (at + (wanted - low) / (high - low)) / kPieces);
  }
  places.push_back(length);
  return places;
}

// The elements that give way, and the loop of sides around them.
struct Hole {
  std::vector<char> taken;         // (element)
  std::vector<DirectedSide> loop;  // counter-clockwise; starts where the cracked side's root curve begins
  size_t root_sides = 0;  // the first so many lie on that root curve, from the flank to the tooth space
};

Hole find_hole(const SectorGrid& mesh, const Slit& slit, double reach) {
  std::map<Edge, int> owners;
  for (Index e = 0; e < mesh.element_node.rows(); ++e)
    for (const DirectedSide& side : sides(mesh, e)) ++owners[edge_of(side.from, side.to)];
  const std::set<int> flank(mesh.flank_node.begin(), mesh.flank_node.end()),
      bore(mesh.bore_node.begin(), mesh.bore_node.end());
  std::set<int> edge;
  for (Index i = 0; i < mesh.side_node.size(); ++i) edge.insert(mesh.side_node.data()[i]);
  const double form = mesh.node_position.row(mesh.flank_node[0]).norm();
  const auto at = [&](int node) -> Vec2 { return mesh.node_position.row(node); };
  const auto both_in = [](const DirectedSide& s, const std::set<int>& set) {
    return set.contains(s.from) && set.contains(s.to);
  };
  const auto on_boundary = [&](const DirectedSide& s) { return owners.at(edge_of(s.from, s.to)) == 1; };
  const auto on_root = [&](const DirectedSide& s) {
    const Vec2 middle = 0.5 * (at(s.from) + at(s.to));
    return on_boundary(s) && middle.x() < 0 && middle.norm() < form && !both_in(s, flank) &&
           !both_in(s, edge) && !both_in(s, bore);
  };

  Hole hole;
  hole.taken.assign(static_cast<size_t>(mesh.element_node.rows()), 0);
  std::map<int, DirectedSide> next;  // by the node where the side starts
  std::map<Edge, int> taken_owners;
  for (Index e = 0; e < mesh.element_node.rows(); ++e) {
    double distance = std::numeric_limits<double>::infinity();
    Vec2 centre = Vec2::Zero();
    bool other_boundary = false;
    for (const DirectedSide& side : sides(mesh, e)) {
      distance = std::min(distance, distance_to_segment(at(side.from), slit.mouth, slit.tip));
      centre += 0.25 * at(side.from);
      other_boundary = other_boundary || (on_boundary(side) && !on_root(side));
    }
    distance = std::min(distance, distance_to_segment(centre, slit.mouth, slit.tip));
    if (distance > reach || other_boundary) continue;
    hole.taken[static_cast<size_t>(e)] = 1;
    for (const DirectedSide& side : sides(mesh, e)) ++taken_owners[edge_of(side.from, side.to)];
  }
  for (Index e = 0; e < mesh.element_node.rows(); ++e) {
    if (!hole.taken[static_cast<size_t>(e)]) continue;
    for (const DirectedSide& side : sides(mesh, e))
      if (taken_owners.at(edge_of(side.from, side.to)) == 1 && !next.emplace(side.from, side).second)
        fail(Failure::numerical, "the elements around the crack do not form one patch; change element_mm");
  }
  // Counter-clockwise around the material the root curve of the leading flank runs from the tip to the tooth space.
  std::vector<const DirectedSide*> first;
  for (const auto& [node, side] : next)
    if (on_root(side)) {
      const auto before =
          std::find_if(next.begin(), next.end(), [at = node](const auto& s) { return s.second.to == at; });
      if (before == next.end() || !on_root(before->second)) first.push_back(&side);
    }
  if (first.size() != 1)
    fail(Failure::numerical, "the elements around the crack meet the fillet ", first.size(),
         " times, once is needed; change element_mm");
  DirectedSide side = *first[0];
  for (size_t i = 0; i < next.size(); ++i) {
    hole.loop.push_back(side);
    if (on_root(side)) ++hole.root_sides;
    side = next.at(side.to);
  }
  if (hole.loop.back().to != hole.loop[0].from)
    fail(Failure::numerical, "the elements around the crack have more than one border; change element_mm");
  return hole;
}

// Numbers and positions of nodes while a mesh is being built.
class NodeList {
 public:
  int add(const Vec2& p) {
    position_.push_back(p);
    return static_cast<int>(position_.size()) - 1;
  }
  const Vec2& at(int node) const { return position_[static_cast<size_t>(node)]; }
  MatrixRM matrix() const {
    MatrixRM out(static_cast<Index>(position_.size()), 2);
    for (size_t i = 0; i < position_.size(); ++i) out.row(static_cast<Index>(i)) = position_[i];
    return out;
  }

 private:
  std::vector<Vec2> position_;
};

// Makes elements of triangles: the first corner is the fourth, too. The biquadratic element then spans all quadratic
// polynomials and is continuous with its neighbours.
class TriangleElements {
 public:
  TriangleElements(NodeList& nodes, bool second, std::map<Edge, int> middle, int tip)
      : nodes_(nodes), second_(second), middle_(std::move(middle)), tip_(tip) {}

  std::vector<int> element(std::array<int, 3> corner) {
    while (corner[0] != tip_ && (corner[1] == tip_ || corner[2] == tip_))
      std::rotate(corner.begin(), corner.begin() + 1, corner.end());
    const auto [a, b, c] = corner;
    if (!second_) return {a, b, c, a};
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    const int centre = nodes_.add(0.5 * (nodes_.at(ab) + nodes_.at(bc) + nodes_.at(ca)) -
                                  0.25 * (nodes_.at(b) + nodes_.at(c)));  // transfinite map of the boundary
    return {a, b, c, a, ab, bc, ca, a, centre};
  }
  int middle(int a, int b) {
    const auto [found, added] = middle_.emplace(edge_of(a, b), -1);
    if (!added) return found->second;
    const double share = a == tip_ ? 0.25 : b == tip_ ? 0.75 : 0.5;
    return found->second = nodes_.add((1 - share) * nodes_.at(a) + share * nodes_.at(b));
  }

 private:
  NodeList& nodes_;
  bool second_;
  std::map<Edge, int> middle_;
  int tip_;
};

}  // namespace

SlitPatch slit_patch(const std::vector<Vec2>& corner, const std::vector<Vec2>& middle, size_t mouth,
                     const Vec2& tip, double at_mouth, double finest, double largest) {
  const bool second = !middle.empty();
  const Vec2 along = tip - corner[mouth];
  const double depth = along.norm();
  std::vector<Vec2> line;
  for (double place : graded_places(depth, [&](double s) {
         return std::min({largest, at_mouth + kGrowth * s, finest + kGrowth * (depth - s)});
       }))
    line.push_back(corner[mouth] + place / depth * along);
  line.back() = tip;
  const Triangulation filling = triangulate(corner, line, finest, largest);

  NodeList nodes;
  for (const Vec2& p : corner) nodes.add(p);
  for (const Vec2& p : middle) nodes.add(p);
  std::vector<int> number;  // of the triangulation's nodes
  for (size_t i = 0; i < filling.node.size(); ++i)
    number.push_back(i < corner.size() ? static_cast<int>(i) : nodes.add(filling.node[i]));
  std::vector<int> face{static_cast<int>(mouth)};
  for (size_t i = 1; i < line.size(); ++i) face.push_back(number[corner.size() + i - 1]);
  const int end = face.back();
  // What lies to the right of the slit's direction has second nodes of its own.
  std::map<int, int> other;
  for (size_t i = 0; i + 1 < face.size(); ++i) other[face[i]] = nodes.add(nodes.at(face[i]));
  const auto facing = [&](int node, const Vec2& at) {
    const Vec2 q = at - corner[mouth];
    const auto twin = other.find(node);
    return twin != other.end() && along.x() * q.y() < along.y() * q.x() ? twin->second : node;
  };
  std::map<Edge, int> middles;
  for (size_t i = 0; i < middle.size(); ++i)
    middles[edge_of(facing(static_cast<int>(i), middle[i]),
                    facing(static_cast<int>((i + 1) % corner.size()), middle[i]))] =
        static_cast<int>(corner.size() + i);
  TriangleElements triangles(nodes, second, middles, end);
  std::vector<std::vector<int>> elements;
  for (const auto& triangle : filling.triangle) {
    std::array<int, 3> node;
    Vec2 centre = Vec2::Zero();
    for (size_t k = 0; k < 3; ++k) {
      node[k] = number[static_cast<size_t>(triangle[k])];
      centre += nodes.at(node[k]) / 3;
    }
    for (int& n : node) n = facing(n, centre);
    elements.push_back(triangles.element(node));
  }

  SlitPatch patch;
  std::vector<std::array<int, 2>> pairs;
  for (size_t i = 0; i + 1 < face.size(); ++i) {
    pairs.push_back({face[i], other.at(face[i])});
    const int next = face[i + 1], next_other = next == end ? end : other.at(next);
    if (second)
      pairs.push_back({triangles.middle(face[i], next), triangles.middle(other.at(face[i]), next_other)});
  }
  patch.slit_node.resize(static_cast<Index>(pairs.size()), 2);
  for (size_t i = 0; i < pairs.size(); ++i)
    patch.slit_node.row(static_cast<Index>(i)) << pairs[i][0], pairs[i][1];
  patch.element_node.resize(static_cast<Index>(elements.size()), second ? 9 : 4);
  for (size_t e = 0; e < elements.size(); ++e)
    for (size_t k = 0; k < elements[e].size(); ++k)
      patch.element_node(static_cast<Index>(e), static_cast<Index>(k)) = elements[e][k];
  patch.node_position = nodes.matrix();
  return patch;
}

namespace {

// The mesh of the cracked sector while it grows.
struct Growing {
  explicit Growing(const SectorGrid& of)
      : sector(of), renumbered(static_cast<size_t>(of.node_position.rows()), -1) {}
  // The number of a node of the sector that stays.
  int kept(int node) {
    int& number = renumbered[static_cast<size_t>(node)];
    if (number < 0) number = nodes.add(sector.node_position.row(node));
    return number;
  }

  const SectorGrid& sector;
  std::vector<int> renumbered;
  NodeList nodes;
  std::vector<std::vector<int>> elements;
  std::vector<int> region;
};

// The boundary of the patch: nodes along the root curve, which come first, with their parameters, then the loop as it is.
struct Polygon {
  std::vector<int> node;
  std::vector<double> parameter;
  size_t mouth = 0, root_nodes = 0;  // place of the mouth; how many are on the root curve
};

// Adds nodes along the root curve from t0 to t1, whose sides have about the lengths `first` and `last` at the ends and at most
// 0.75 h (m) between. end: number of the node at t1; -1: a new one.
void divide(const ToothGeometry& tooth, double t0, double t1, double first, double last, double h, int end,
            NodeList& nodes, Polygon& polygon) {
  const auto root = [&tooth](double t) { return tooth.root_point(t); };
  constexpr int kPieces = 500;
  std::vector<double> length(kPieces + 1, 0.0);
  for (int i = 0; i < kPieces; ++i)
    length[static_cast<size_t>(i) + 1] =
        length[static_cast<size_t>(i)] +
        (root(t0 + (t1 - t0) * (i + 1) / kPieces) - root(t0 + (t1 - t0) * i / kPieces)).norm();
  const double whole = length.back();
  const std::vector<double> places = graded_places(whole, [&](double s) {
    return std::min({0.75 * h, first + kGrowth * s, last + kGrowth * (whole - s)});
  });
  size_t piece = 0;
  for (size_t k = 1; k + 1 < places.size(); ++k) {
    while (length[piece + 1] < places[k]) ++piece;
    const double share = (places[k] - length[piece]) / (length[piece + 1] - length[piece]);
    polygon.parameter.push_back(t0 + (t1 - t0) * (static_cast<double>(piece) + share) / kPieces);
    polygon.node.push_back(nodes.add(root(polygon.parameter.back())));
  }
  polygon.parameter.push_back(t1);
  polygon.node.push_back(end >= 0 ? end : nodes.add(root(t1)));
}

// The root curve anew with a node at the mouth, then the loop as it is.
Polygon polygon_of(const ToothGeometry& tooth, const Slit& slit, const Hole& hole, double at_mouth,
                   Growing& mesh) {
  const SectorGrid& sector = mesh.sector;
  const double h = sector.discretisation.element_size;
  const auto root = [&tooth](double t) { return tooth.root_point(t); };
  const auto length_of = [&](const DirectedSide& s) -> double {
    return (sector.node_position.row(s.from) - sector.node_position.row(s.to)).norm();
  };
  const auto root_parameter = [&](int node) {
    return nearest_parameter(root, sector.node_position.row(node), 0, 1);
  };
  const double from = root_parameter(hole.loop[0].from),
               to = root_parameter(hole.loop[hole.root_sides - 1].to);
  if (!(from < slit.mouth_at && slit.mouth_at < to))
    fail(Failure::numerical,
         "the elements around the crack do not reach both sides of its mouth; lower element_mm");
  Polygon polygon{{mesh.kept(hole.loop[0].from)}, {from}};
  divide(tooth, from, slit.mouth_at, length_of(hole.loop.back()), at_mouth, h, -1, mesh.nodes, polygon);
  polygon.mouth = polygon.node.size() - 1;
  const int end = mesh.kept(hole.loop[hole.root_sides - 1].to);
  divide(tooth, slit.mouth_at, to, at_mouth, length_of(hole.loop[hole.root_sides % hole.loop.size()]), h, end,
         mesh.nodes, polygon);
  polygon.root_nodes = polygon.node.size();
  for (size_t i = hole.root_sides + 1; i < hole.loop.size(); ++i)
    polygon.node.push_back(mesh.kept(hole.loop[i].from));
  return polygon;
}

// Puts the patch in place of the hole. (pair, 2) nodes of the slit.
MatrixRMi add_patch(const ToothGeometry& tooth, const Slit& slit, const Hole& hole, const Polygon& polygon,
                    double at_mouth, double finest, Growing& mesh) {
  const bool second = mesh.sector.element_node.cols() == 9;
  std::vector<Vec2> corner, middle;
  for (int node : polygon.node) corner.push_back(mesh.nodes.at(node));
  std::vector<int> number(polygon.node);  // of the patch's nodes
  if (second) {
    for (size_t i = 0; i + 1 < polygon.root_nodes; ++i)
      number.push_back(
          mesh.nodes.add(tooth.root_point(0.5 * (polygon.parameter[i] + polygon.parameter[i + 1]))));
    for (size_t i = hole.root_sides; i < hole.loop.size(); ++i)
      number.push_back(mesh.kept(hole.loop[i].middle));
    for (size_t i = polygon.node.size(); i < number.size(); ++i) middle.push_back(mesh.nodes.at(number[i]));
  }
  const SlitPatch patch = slit_patch(corner, middle, polygon.mouth, slit.tip, at_mouth, finest,
                                     mesh.sector.discretisation.element_size);
  for (Index i = static_cast<Index>(number.size()); i < patch.node_position.rows(); ++i)
    number.push_back(mesh.nodes.add(patch.node_position.row(i)));
  const auto numbered = [&number](int node) { return number[static_cast<size_t>(node)]; };
  for (Index e = 0; e < patch.element_node.rows(); ++e) {
    std::vector<int> element;
    for (Index k = 0; k < patch.element_node.cols(); ++k)
      element.push_back(numbered(patch.element_node(e, k)));
    mesh.elements.push_back(element);
    mesh.region.push_back(1);
  }
  return patch.slit_node.unaryExpr(numbered);
}

// Nodes, elements and node sets.
SectorGrid assembled(Growing& growing) {
  const SectorGrid& sector = growing.sector;
  SectorGrid mesh;
  mesh.design = sector.design;
  mesh.discretisation = sector.discretisation;
  mesh.element_node.resize(static_cast<Index>(growing.elements.size()), sector.element_node.cols());
  mesh.element_region =
      Eigen::Map<Eigen::VectorXi>(growing.region.data(), static_cast<Index>(growing.region.size()));
  for (size_t e = 0; e < growing.elements.size(); ++e)
    for (size_t k = 0; k < growing.elements[e].size(); ++k)
      mesh.element_node(static_cast<Index>(e), static_cast<Index>(k)) = growing.elements[e][k];
  mesh.node_position = growing.nodes.matrix();
  const auto all_kept = [&](auto set) {
    for (Index i = 0; i < set.size(); ++i) set.data()[i] = growing.kept(set.data()[i]);
    return set;
  };
  const Index before = mesh.node_position.rows();
  mesh.bore_node = all_kept(sector.bore_node);
  mesh.side_node = all_kept(sector.side_node);
  mesh.flank_node = all_kept(sector.flank_node);
  mesh.flank_roll_angle = sector.flank_roll_angle;
  if (growing.nodes.matrix().rows() != before)
    fail(Failure::numerical,
         "the crack takes elements on the flank, the bore or a sector edge; lower element_mm");
  return mesh;
}

}  // namespace

SectorGrid make_cracked_sector(const SectorGrid& sector) {
  const ToothGeometry tooth(sector.design);
  const Slit slit = crack_slit(tooth);
  const double h = sector.discretisation.element_size, depth = sector.design.crack.depth;
  if (!(depth > 0))
    fail(Failure::input, "crack: depth_mm = ", depth * 1e3, " is not above 0: there is no slit");
  const bool second = sector.element_node.cols() == 9;
  const Hole hole = find_hole(sector, slit, 2 * h);
  const double finest = std::min(h / 6, depth / 10), at_mouth = std::min(h / 2, depth / 4);

  // 1. Nodes that stay: those of elements that stay.
  Growing growing(sector);
  for (Index e = 0; e < sector.element_node.rows(); ++e) {
    if (hole.taken[static_cast<size_t>(e)]) continue;
    std::vector<int> element;
    for (Index k = 0; k < sector.element_node.cols(); ++k)
      element.push_back(growing.kept(sector.element_node(e, k)));
    growing.elements.push_back(element);
    growing.region.push_back(sector.element_region[e]);
  }

  // 2. The patch in place of the hole, within its boundary.
  const Polygon polygon = polygon_of(tooth, slit, hole, at_mouth, growing);
  const auto slit_node = add_patch(tooth, slit, hole, polygon, at_mouth, finest, growing);
  SectorGrid mesh = assembled(growing);
  mesh.slit_node = slit_node;

  const double area = mesh_area(mesh.node_position, mesh.element_node),
               intact = mesh_area(sector.node_position, sector.element_node);
  const double allowed = second ? 2e-4 : 5e-3;
  if (!(std::abs(area - intact) <= allowed * intact))
    fail(Failure::numerical, "the sector with the crack has an area of ", area, " m2, without it ", intact,
         " m2; the triangles do not fill it; change element_mm");
  return mesh;
}

SectorGrid close_slit(const SectorGrid& cracked) {
  std::vector<int> number(static_cast<size_t>(cracked.node_position.rows()), 0);
  for (Index i = 0; i < cracked.slit_node.rows(); ++i)
    number[static_cast<size_t>(cracked.slit_node(i, 1))] = -1;
  int count = 0;
  SectorGrid mesh = cracked;
  for (size_t i = 0; i < number.size(); ++i)
    if (number[i] == 0) {
      mesh.node_position.row(count) = cracked.node_position.row(static_cast<Index>(i));
      number[i] = count++;
    }
  for (Index i = 0; i < cracked.slit_node.rows(); ++i)
    number[static_cast<size_t>(cracked.slit_node(i, 1))] =
        number[static_cast<size_t>(cracked.slit_node(i, 0))];
  mesh.node_position.conservativeResize(count, 2);
  const auto renumber = [&](auto& set) {
    for (Index i = 0; i < set.size(); ++i) set.data()[i] = number[static_cast<size_t>(set.data()[i])];
  };
  renumber(mesh.element_node);
  renumber(mesh.bore_node);
  renumber(mesh.side_node);
  renumber(mesh.flank_node);
  mesh.slit_node.resize(0, 2);
  return mesh;
}

}  // namespace whine
