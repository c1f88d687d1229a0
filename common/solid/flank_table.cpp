#include "solid/flank_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/model_range.h"

namespace whine {
namespace {
constexpr double kTipScale = 1.0 / 60;  // in modules: 0.05 mm for a module of 3 mm
}

FlankTable::FlankTable(const ToothGeometry& tooth, int points)
    : FlankTable(tooth.base_radius(), tooth.form_roll_angle(), tooth.tip_roll_angle(),
                 kTipScale * tooth.section().module, points) {}

FlankTable::FlankTable(double base_radius, double form_roll_angle, double tip_roll_angle, double tip_scale,
                       int points)
    : base_radius_(base_radius), form_(form_roll_angle), tip_(tip_roll_angle), tip_scale_(tip_scale) {
  if (!(base_radius > 0) || !(tip_scale > 0) || !(lowest() >= 0) || form_ == tip_ || points < 2)
    fail(Failure::input, "flank table: base radius ", base_radius, " m, roll angles ", form_, " to ", tip_,
         " rad, tip scale ", tip_scale, " m, ", points,
         " points; needs positive lengths, different roll angles that are not below 0, and 2 points or more");
  points_.resize(points);
  zeta_.resize(points);
  barycentric_.resize(points);
  const double zeta_form = zeta(form_);
  for (int j = 0; j < points; ++j) {
    const double angle = std::numbers::pi * (2 * j + 1) / (2.0 * points);
    // Descends from the form point to the tip; the other way round where roll angles ascend towards the root.
    zeta_[j] = 0.5 * zeta_form * (1 + (tip_ > form_ ? 1 : -1) * std::cos(angle));
    const double delta = tip_scale_ * std::expm1(zeta_[j]);
    points_[j] = std::sqrt(tip_ * tip_ - (tip_ > form_ ? 2 : -2) * delta / base_radius_);
    barycentric_[j] = (j % 2 ? -1 : 1) * std::sin(angle);
  }
}

double FlankTable::zeta(double xi) const {
  const double delta = (tip_ > form_ ? 0.5 : -0.5) * base_radius_ * (tip_ - xi) * (tip_ + xi);
  return std::log1p(std::max(delta, 0.0) / tip_scale_);
}

Eigen::RowVectorXd FlankTable::weights(double xi) const {
  constexpr double kRoundOff = 1e-9;  // rad
  if (!(xi >= lowest() - kRoundOff && xi <= highest() + kRoundOff))
    fail_outside_range(Failure::numerical, "flank table: a flank point outside the involute: roll angle ", xi,
                       " rad, the flank goes from ", lowest(), " to ", highest(), " rad (beyond it by ",
                       xi < lowest() ? lowest() - xi : xi - highest(), " rad, ", kRoundOff,
                       " is round-off); lower the torque");
  const double z = zeta(xi);
  Eigen::RowVectorXd row(size());
  double sum = 0;
  for (int j = 0; j < size(); ++j) {
    const double distance = z - zeta_[j];
    if (std::abs(distance) < 1e-14 * (1 + z)) {
      row.setZero();
      row[j] = 1;
      return row;
    }
    row[j] = barycentric_[j] / distance;
    sum += row[j];
  }
  return row / sum;
}

}  // namespace whine
