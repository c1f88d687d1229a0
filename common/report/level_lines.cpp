#include "report/level_lines.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "report/panel_layout.h"

namespace whine {

using Eigen::Index;

namespace {

struct Corner {
  double x, y, value;
};

// Where the value of an edge is `level`.
std::optional<std::array<double, 2>> crossing(const Corner& a, const Corner& b, double level) {
  if ((a.value < level) == (b.value < level)) return std::nullopt;
  const double share = (level - a.value) / (b.value - a.value);
  return std::array{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

// Pieces of one level, one in each triangle that it passes.
std::vector<std::array<std::array<double, 2>, 2>> pieces(const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                                                         const MatrixRM& value, double level) {
  std::vector<std::array<std::array<double, 2>, 2>> out;
  const auto corner = [&](Index i, Index k) { return Corner{x[k], y[i], value(i, k)}; };
  const auto add = [&](const std::array<Corner, 3>& triangle) {
    std::array<std::array<double, 2>, 2> piece{};
    size_t ends = 0;
    for (size_t e = 0; e < 3; ++e)
      if (const auto at = crossing(triangle[e], triangle[(e + 1) % 3], level)) piece[ends++] = *at;
    if (ends == 2) out.push_back(piece);
  };
  for (Index i = 0; i + 1 < y.size(); ++i)
    for (Index k = 0; k + 1 < x.size(); ++k) {
      add({corner(i, k), corner(i, k + 1), corner(i + 1, k + 1)});
      add({corner(i, k), corner(i + 1, k + 1), corner(i + 1, k)});
    }
  return out;
}

}  // namespace

std::vector<double> cell_edges(const std::vector<double>& middle) {
  std::vector<double> edge(middle.size() + 1);
  for (size_t i = 1; i < middle.size(); ++i) edge[i] = 0.5 * (middle[i - 1] + middle[i]);
  const size_t n = middle.size();
  edge[0] = n > 1 ? 2 * middle[0] - edge[1] : middle[0] - 0.5;
  edge[n] = n > 1 ? 2 * middle[n - 1] - edge[n - 1] : middle[0] + 0.5;
  return edge;
}

LevelLines level_lines(const std::string& block, const std::vector<std::string>& columns,
                       const Eigen::VectorXd& x, const Eigen::VectorXd& y, const MatrixRM& value, int count) {
  LevelLines out{{block, columns, {}, "", "", true}, {}};
  const double most = value.maxCoeff();
  if (x.size() < 2 || y.size() < 2 || !(most > 0)) return out;
  // A number at an edge would be cut in half.
  constexpr double kEdge = 0.04;
  const double step = step_of(most / count), at = x[0] + 0.75 * (x[x.size() - 1] - x[0]),
               beside = kEdge * (x[x.size() - 1] - x[0]), above = kEdge * (y[y.size() - 1] - y[0]);
  for (double level = step; level < most; level += step) {
    double nearest = std::numeric_limits<double>::infinity();
    PanelWords number{shown(level, 6), 0, 0, true};
    for (const auto& piece : pieces(x, y, value, level)) {
      for (const auto& [px, py] : piece) out.lines.rows.push_back({px, py});
      out.lines.rows.emplace_back();
      if (const double off = std::abs(piece[0][0] - at);
          off < nearest && piece[0][0] > x[0] + beside && piece[0][0] < x[x.size() - 1] - beside &&
          piece[0][1] > y[0] + above && piece[0][1] < y[y.size() - 1] - above) {
        nearest = off;
        number.x = piece[0][0];
        number.y = piece[0][1];
      }
    }
    if (std::isfinite(nearest)) out.numbers.push_back(number);
  }
  return out;
}

}  // namespace whine
