#include "solid/exact_boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "base/units.h"

namespace whine {
namespace {

// How far the middle of each element side lies off its chord. The bulge of a curved boundary is handed on
// from layer to layer, fading out, because a thin element with one curved and one straight long side would be
// folded.
std::map<std::pair<int, int>, Vec2> side_bulges(const HalfGrid& half, const ExactBoundary& exact) {
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

}  // namespace

ExactBoundary::ExactBoundary(const ToothGeometry& tooth) : tooth_(tooth) {
  const double angle = 0.5 * kPi + kPi / tooth.design().teeth;
  edge_ = {std::cos(angle), std::sin(angle)};
}

double ExactBoundary::roll_angle(const Vec2& p) const {
  const double r = std::max(p.norm(), tooth_.base_radius());
  return std::clamp(tooth_.roll_angle_at_radius(r), tooth_.least_roll_angle(), tooth_.largest_roll_angle());
}

Vec2 ExactBoundary::put(Curve kind, const Vec2& p) const {
  switch (kind) {
    case Curve::top_land:
      return p * (tooth_.tip_radius() / p.norm());
    case Curve::bore:
      return p * (tooth_.design().clamped_radius() / p.norm());
    case Curve::flank:
      return tooth_.flank_point(roll_angle(p));
    case Curve::root:
      return tooth_.root_point(nearest_parameter([this](double t) { return tooth_.root_point(t); }, p, 0, 1));
    case Curve::sector_edge:
      return edge_ * edge_.dot(p);
    case Curve::centre_line:
      return {0, p.y()};
    case Curve::none:
      break;
  }
  return p;
}

Vec2 ExactBoundary::middle(Curve kind, const Vec2& a, const Vec2& b) const {
  if (kind == Curve::flank) {
    const double from = roll_angle(a), to = roll_angle(b);
    return tooth_.flank_point(roll_angle_between(from, to, 0));
  }
  return put(kind, 0.5 * (a + b));
}

double roll_angle_between(double from, double to, double a) {
  return std::sqrt(0.5 * ((1 - a) * from * from + (1 + a) * to * to));
}

void make_exact(HalfGrid& half, const ToothGeometry& tooth, const ExactBoundary& exact) {
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
              : has(Curve::bore)   ? tooth.design().clamped_radius()
                                   : p.y()};
    else if (has(Curve::bore) && has(Curve::sector_edge))
      p = exact.put(Curve::bore, exact.put(Curve::sector_edge, p));
    else
      p = exact.put(list.front(), p);
  }
}

std::vector<std::array<int, 9>> raise_order(HalfGrid& half, const ExactBoundary& exact) {
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

}  // namespace whine
