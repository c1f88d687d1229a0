// Lines of equal value of functions whose lines are known.
#include <doctest/doctest.h>

#include <cmath>

#include "report/level_lines.h"

using namespace whine;
using Eigen::VectorXd;

namespace {

MatrixRM sampled(const VectorXd& x, const VectorXd& y, double (*of)(double, double)) {
  MatrixRM value(y.size(), x.size());
  for (Eigen::Index i = 0; i < y.size(); ++i)
    for (Eigen::Index k = 0; k < x.size(); ++k) value(i, k) = of(x[k], y[i]);
  return value;
}

// Largest distance of the lines of x² + y² from the circles that they stand for.
double off_circles(int cells) {
  const VectorXd x = VectorXd::LinSpaced(cells + 1, 0, 2);
  const LevelLines found = level_lines("circles", {"x", "y"}, x, x,
                                       sampled(x, x, [](double a, double b) { return a * a + b * b; }), 8);
  double most = 0;
  for (const auto& row : found.lines.rows)
    if (!row.empty()) {
      const double r = std::hypot(row[0], row[1]), level = std::round(r * r);
      most = std::max(most, std::abs(r - std::sqrt(level)));
    }
  return most;
}

}  // namespace

TEST_CASE("lines of equal value: those of a plane are exact, on its round levels") {
  const VectorXd x = VectorXd::LinSpaced(7, -1, 2), y = VectorXd::LinSpaced(5, 0.5, 3);
  const auto plane = [](double a, double b) { return 2 + a + 0.5 * b; };
  const LevelLines found = level_lines("plane", {"x", "y"}, x, y, sampled(x, y, plane), 6);
  std::vector<int> points(6, 0);
  for (const auto& row : found.lines.rows) {
    if (row.empty()) continue;
    const double level = plane(row[0], row[1]);
    CHECK(std::abs(level - std::round(level)) < 1e-12);
    ++points[static_cast<size_t>(std::lround(level))];
  }
  CHECK(points[1] == 0);  // below the least value, 1.25
  for (size_t level = 2; level < points.size(); ++level) CHECK(points[level] > 0);
  REQUIRE(found.numbers.size() == 4);
  for (size_t n = 0; n < 4; ++n) CHECK(found.numbers[n].words == std::to_string(n + 2));
}

TEST_CASE("lines of equal value: circles, to second order in the cells; none without a grid or above 0") {
  const double coarse = off_circles(16), fine = off_circles(32);
  CHECK(coarse < 0.01);
  CHECK(coarse / fine > 3);
  const VectorXd one = VectorXd::Ones(1), two = VectorXd::LinSpaced(2, 0, 1);
  CHECK(level_lines("row", {"x", "y"}, two, one, MatrixRM::Ones(1, 2), 4).numbers.empty());
  CHECK(level_lines("zero", {"x", "y"}, two, two, MatrixRM::Zero(2, 2), 4).lines.rows.empty());
}
