#include "report/wireframe.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "base/error.h"
#include "results/sector_grid.h"

namespace whine {

namespace {

// Marks the points between two that are kept, if one of them lies too far from the line between these.
void keep_far(const Strokes& rows, double tolerance, std::vector<bool>& kept) {
  std::vector<std::pair<size_t, size_t>> open{{0, rows.size() - 1}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    const Vec2 from(rows[a][0], rows[a][1]), way = Vec2(rows[b][0], rows[b][1]) - from;
    double most = tolerance;
    size_t farthest = a;
    for (size_t i = a + 1; i < b; ++i) {
      const Vec2 p = Vec2(rows[i][0], rows[i][1]) - from;
      const double length = way.squaredNorm(),
                   along = length > 0 ? std::clamp(p.dot(way) / length, 0.0, 1.0) : 0.0;
      if (const double apart = (p - along * way).norm(); apart > most) {
        most = apart;
        farthest = i;
      }
    }
    if (farthest == a) continue;
    kept[farthest] = true;
    open.emplace_back(a, farthest);
    open.emplace_back(farthest, b);
  }
}

}  // namespace

Strokes simplified(const Strokes& strokes, double tolerance) {
  Strokes out;
  for (size_t begin = 0; begin < strokes.size(); ++begin) {
    size_t end = begin;
    while (end < strokes.size() && !strokes[end].empty()) ++end;
    if (end > begin) {
      const Strokes line(strokes.begin() + static_cast<std::ptrdiff_t>(begin),
                         strokes.begin() + static_cast<std::ptrdiff_t>(end));
      std::vector<bool> kept(line.size(), false);
      kept.front() = kept.back() = true;
      keep_far(line, tolerance, kept);
      for (size_t i = 0; i < line.size(); ++i)
        if (kept[i]) out.push_back(line[i]);
    }
    if (end < strokes.size()) out.emplace_back();
    begin = end;
  }
  return out;
}

Wireframe::Wireframe(const SectorGrid& mesh)
    : node_(mesh.node_position), teeth_(mesh.design.teeth), bore_radius_(mesh.design.clamped_radius()) {
  const Eigen::Index per_element = mesh.element_node.cols();
  if (per_element != 4 && per_element != 9)
    fail(Failure::input, "mesh: elements of ", per_element, " nodes; 4 or 9 are known");
  std::set<int> clockwise, counter_clockwise, bore(mesh.bore_node.begin(), mesh.bore_node.end());
  for (Eigen::Index i = 0; i < mesh.side_node.rows(); ++i) {
    clockwise.insert(mesh.side_node(i, 0));
    counter_clockwise.insert(mesh.side_node(i, 1));
  }
  const auto both_in = [](const std::set<int>& set, const std::array<int, 3>& e) {
    return set.count(e[0]) && set.count(e[1]);
  };

  std::map<std::pair<int, int>, std::pair<std::array<int, 3>, int>>
      found;  // corners -> edge, elements that have it
  for (Eigen::Index e = 0; e < mesh.element_node.rows(); ++e)
    for (int k = 0; k < 4; ++k) {
      const int a = mesh.element_node(e, k), b = mesh.element_node(e, (k + 1) % 4);
      const int mid = per_element == 9 ? mesh.element_node(e, 4 + k) : -1;
      auto& entry = found.try_emplace(std::minmax(a, b), std::array<int, 3>{a, b, mid}, 0).first->second;
      ++entry.second;
    }

  std::multimap<int, std::array<int, 3>> at_corner;
  for (const auto& [corners, entry] : found) {
    const auto& [edge, elements] = entry;
    if (!both_in(clockwise, edge)) edge_.push_back(edge);
    if (elements == 1 && !both_in(clockwise, edge) && !both_in(counter_clockwise, edge) &&
        !both_in(bore, edge)) {
      at_corner.emplace(edge[0], edge);
      at_corner.emplace(edge[1], edge);
    }
  }
  // Walk the outer edge: it starts at the corner on the clockwise side that only one outer edge has.
  int here = -1;
  for (const auto& [corner, edge] : at_corner)
    if (clockwise.count(corner)) here = corner;
  if (here < 0) fail(Failure::input, "mesh: no outer edge starts at the clockwise side of the sector");
  contour_.push_back(here);
  for (int before = -1;;) {
    const auto [begin, end] = at_corner.equal_range(here);
    auto next = begin;
    while (next != end && (next->second[0] == before || next->second[1] == before)) ++next;
    if (next == end) break;
    const auto& edge = next->second;
    before = here;
    here = edge[0] == here ? edge[1] : edge[0];
    if (edge[2] >= 0) contour_.push_back(edge[2]);
    contour_.push_back(here);
    if (contour_.size() > 4 * found.size()) break;
  }
  if (!counter_clockwise.count(here))
    fail(Failure::input, "mesh: the outer edge of the sector does not end on its counter-clockwise side");
}

Vec2 Wireframe::position(int node, int tooth, const Placement& at) const {
  const double a = at.angle + 2.0 * std::numbers::pi * tooth / teeth_;
  const double x = node_(node, 0), y = node_(node, 1), c = std::cos(a), s = std::sin(a);
  return at.centre + Vec2(c * x - s * y, s * x + c * y);
}

// Strokes as long as possible: each goes on through the unused edge that is straightest ahead, which halves
// the size of the drawing against single edges.
Strokes Wireframe::strokes(const std::vector<bool>& used_edge, int tooth, const Placement& at, double scale,
                           bool with_mid) const {
  std::vector<bool> free = used_edge;
  std::multimap<int, size_t> at_corner;
  for (size_t e = 0; e < edge_.size(); ++e)
    if (free[e]) {
      at_corner.emplace(edge_[e][0], e);
      at_corner.emplace(edge_[e][1], e);
    }
  const auto corner = [&](int n) { return Vec2(node_(n, 0), node_(n, 1)); };
  // From an edge on, beyond its end `here`, as long as a free edge goes on nearly straight: the nodes after `here`.
  const auto walk = [&](int before, int here) {
    std::vector<int> nodes;
    while (true) {
      const Vec2 ahead = (corner(here) - corner(before)).normalized();
      double best = 0.5;  // cosine: turn by more than 60 degrees and it is another line
      size_t chosen = edge_.size();
      const auto [begin, end] = at_corner.equal_range(here);
      for (auto i = begin; i != end; ++i) {
        const auto& edge = edge_[i->second];
        if (!free[i->second]) continue;
        const int there = edge[0] == here ? edge[1] : edge[0];
        const double cosine = ahead.dot((corner(there) - corner(here)).normalized());
        if (cosine > best) best = cosine, chosen = i->second;
      }
      if (chosen == edge_.size()) return nodes;
      free[chosen] = false;
      if (with_mid && edge_[chosen][2] >= 0) nodes.push_back(edge_[chosen][2]);
      before = here;
      here = edge_[chosen][0] == here ? edge_[chosen][1] : edge_[chosen][0];
      nodes.push_back(here);
    }
  };
  Strokes rows;
  for (size_t first = 0; first < edge_.size(); ++first) {
    if (!free[first]) continue;
    free[first] = false;
    const auto& [from, to, mid] = edge_[first];
    // Both ways, so that a line of the mesh is one stroke wherever its first edge lies.
    std::vector<int> line = walk(to, from);
    std::reverse(line.begin(), line.end());
    line.push_back(from);
    if (with_mid && mid >= 0) line.push_back(mid);
    line.push_back(to);
    const std::vector<int> after = walk(from, to);
    line.insert(line.end(), after.begin(), after.end());
    for (const int node : line) {
      const Vec2 p = position(node, tooth, at) * scale;
      // micrometres are enough for the eye and keep the file small
      rows.push_back({std::round(p.x() * 1e3) / 1e3, std::round(p.y() * 1e3) / 1e3});
    }
    rows.emplace_back();
  }
  return rows;
}

Strokes Wireframe::whole(const Placement& at, double scale) const {
  const std::vector<bool> all(edge_.size(), true);
  Strokes rows;
  for (int tooth = 0; tooth < teeth_; ++tooth) {
    const Strokes more = strokes(all, tooth, at, scale, false);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

Strokes Wireframe::window(const Placement& at, double scale, const Vec2& point, double half) const {
  Strokes rows;
  for (int tooth = 0; tooth < teeth_; ++tooth) {
    std::vector<bool> near(edge_.size());
    for (size_t e = 0; e < edge_.size(); ++e)
      near[e] = std::any_of(edge_[e].begin(), edge_[e].begin() + 2, [&](int n) {
        return (position(n, tooth, at) - point).cwiseAbs().maxCoeff() < 1.1 * half;
      });
    const Strokes more = strokes(near, tooth, at, scale, true);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

Strokes Wireframe::outline(const Placement& at, double scale) const {
  Strokes rows;
  for (int tooth = 0; tooth <= teeth_; ++tooth)
    for (size_t i = tooth == 0 ? 0 : 1; i < contour_.size() && (tooth < teeth_ || i == 0); ++i) {
      const Vec2 p = position(contour_[i], tooth, at) * scale;
      rows.push_back({p.x(), p.y()});
    }
  return rows;
}

Strokes Wireframe::bore(const Placement& at, double scale) const {
  Strokes rows;
  for (int i = 0; i <= 180; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 180;
    rows.push_back({(at.centre.x() + bore_radius_ * std::cos(a)) * scale,
                    (at.centre.y() + bore_radius_ * std::sin(a)) * scale});
  }
  return rows;
}

}  // namespace whine
