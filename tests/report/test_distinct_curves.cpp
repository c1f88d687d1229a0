// Curves of a panel that lie on each other, by hand.
#include "report/distinct_curves.h"

#include <doctest/doctest.h>

using namespace whine;

TEST_CASE("curves that differ by less than a line's width have one number, by the first of each") {
  const Eigen::Vector3d a(0, 50, 100), b(0, 40, 100);
  const Eigen::Vector3d near(0.9, 50, 99.1);  // of a span of 100
  const std::vector<size_t> numbers = distinct_curves({a, b, near, b, Eigen::Vector3d(0, 50, 101.1)}, 100);
  CHECK(numbers == std::vector<size_t>{0, 1, 0, 1, 2});
  CHECK(count_of_distinct(numbers) == 3);
  CHECK(is_first(numbers, 1));
  CHECK(!is_first(numbers, 2));
  CHECK(is_first(numbers, 4));
  // Constant curves of one value lie on each other whatever the span.
  CHECK(distinct_curves({b, b}, 0) == std::vector<size_t>{0, 0});
  CHECK(count_of_distinct({}) == 0);
}
