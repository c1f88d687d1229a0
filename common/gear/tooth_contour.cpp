#include "gear/tooth_contour.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace whine {

std::vector<Vec2> tooth_contour(const ToothGeometry& gear, int points) {
  const int count = std::max(points, 2);
  // The half that leads in counter-clockwise rotation, from the tip to the middle of the space.
  std::vector<Vec2> half;
  half.reserve(2 * static_cast<size_t>(count));
  const double tip = gear.tip_roll_angle(), form = gear.form_roll_angle();
  for (int i = 0; i < count; ++i) half.push_back(gear.flank_point(tip + (form - tip) * i / (count - 1)));
  for (int i = 1; i < count; ++i) half.push_back(gear.root_point(static_cast<double>(i) / (count - 1)));
  std::vector<Vec2> out;
  out.reserve(2 * half.size() + 1);
  for (auto p = half.rbegin(); p != half.rend(); ++p) out.emplace_back(-p->x(), p->y());
  out.emplace_back(0, gear.tip_radius());
  out.insert(out.end(), half.begin(), half.end());
  return out;
}

std::vector<Vec2> gear_contour(const ToothGeometry& gear, int points) {
  const std::vector<Vec2> tooth = tooth_contour(gear, points);
  const int teeth = gear.design().teeth;
  std::vector<Vec2> out{tooth.front()};
  out.reserve(static_cast<size_t>(teeth) * tooth.size());
  for (int j = 0; j < teeth; ++j) {
    const Eigen::Rotation2Dd turn(2 * std::numbers::pi * j / teeth);
    for (size_t i = 1; i < tooth.size(); ++i) out.push_back(turn * tooth[i]);
  }
  out.back() = out.front();
  return out;
}

std::vector<Vec2> circle_contour(double radius, int points) {
  std::vector<Vec2> out;
  out.reserve(static_cast<size_t>(points) + 1);
  for (int i = 0; i <= points; ++i) {
    const double angle = 2 * std::numbers::pi * (i % points) / points;
    out.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return out;
}

}  // namespace whine
