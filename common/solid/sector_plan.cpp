#include "solid/sector_plan.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace whine {
namespace {

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

double root_length(const ToothGeometry& tooth, double from, double to) {
  constexpr int kPieces = 400;
  double length = 0;
  for (int i = 0; i < kPieces; ++i)
    length += (tooth.root_point(from + (to - from) * (i + 1) / kPieces) -
               tooth.root_point(from + (to - from) * i / kPieces))
                  .norm();
  return length;
}

// The parameter at which the root curve has turned half way from the flank to the root circle: there sits the corner of three
// blocks.
double half_turned(const ToothGeometry& tooth) {
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
  return 0.5 * (low + high);
}

}  // namespace

SectorPlan plan_sector(const ToothGeometry& tooth, double h, double root) {
  const GearDesign& design = tooth.design();
  SectorPlan plan{};
  const double tip = tooth.tip_roll_angle(), form = tooth.form_roll_angle();
  const double flank = std::abs(tooth.arc_length(tip) - tooth.arc_length(form));
  const int out = tooth.outwards();
  const double half_top = 0.5 * tooth.thickness_at_radius(tooth.tip_radius());
  plan.tip_size = std::min({design.module / 600, h / 80, half_top / 3, flank / 8});

  // Along the flank: geometric growth from the corner until the wanted size is reached, then even.
  constexpr double kGrowth = 1.7;
  plan.n_tip = std::max(2, static_cast<int>(std::ceil(std::log(h / plan.tip_size) / std::log(kGrowth))));
  const double q = std::pow(h / plan.tip_size, 1.0 / plan.n_tip);
  const double graded = std::min(plan.tip_size * (std::pow(q, plan.n_tip) - 1) / (q - 1), 0.6 * flank);
  plan.tip_ratio = growth_ratio(plan.tip_size, graded, plan.n_tip);
  plan.xi_split = std::sqrt(tip * tip - out * 2 * graded / tooth.base_radius());
  plan.n_flank = std::max(2, static_cast<int>(std::ceil((flank - graded) / h - 0.2)));
  plan.split = tooth.flank_point(plan.xi_split);

  plan.t_split = half_turned(tooth);
  plan.fillet_corner = tooth.root_point(plan.t_split);
  // Thin layers below a long curved side fold: the trochoid of an undercut tooth turns back above its neck.
  const int least_fillet = tooth.undercut() > 0 ? 6 : 3;
  plan.n_fillet =
      std::max(least_fillet, static_cast<int>(std::ceil(root_length(tooth, 0, plan.t_split) / (0.75 * h))));
  plan.n_root = std::max(3, static_cast<int>(std::ceil(root_length(tooth, plan.t_split, 1) / h)));

  plan.t_land = 1;
  // The sharp part of the root has elements of its own down to the root circle, which keeps those of size h.
  if (root < h) {
    plan.n_fillet =
        std::max(least_fillet, static_cast<int>(std::ceil(root_length(tooth, 0, plan.t_split) / root)));
    if (tooth.root_corner() < 1) plan.t_land = std::max(tooth.root_corner(), 0.5 * (plan.t_split + 1));
    plan.n_sharp =
        std::max(3, static_cast<int>(std::ceil(root_length(tooth, plan.t_split, plan.t_land) / root)));
    plan.n_root = plan.n_sharp;
    if (plan.t_land < 1) plan.n_root += static_cast<int>(std::ceil(root_length(tooth, plan.t_land, 1) / h));
  }

  // The tooth region ends on a ring one module below the root, or half way to the bore on a thin rim.
  const double rim = out * (tooth.root_radius() - design.clamped_radius());
  const double depth = std::min(design.module, 0.5 * rim);
  plan.ring_radius = tooth.root_radius() - out * depth;
  plan.n_under = std::max(2, static_cast<int>(std::ceil(depth / (1.25 * h))));
  const double drop = std::min(-plan.fillet_corner.x() * std::tan(kPi / 9), 0.4 * depth);
  plan.under_ratio = 1;
  if (root < h)  // from the size on the root inwards
    for (plan.n_under = 2; plan.n_under < 1000; ++plan.n_under) {
      plan.under_ratio = growth_ratio(root, depth, plan.n_under);
      if (plan.under_ratio < 1.3) break;
    }
  plan.chord_centre = {0, plan.fillet_corner.y() - out * drop};
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
  const double rim_length = out * (plan.ring_radius - design.clamped_radius()),
               rim_first = std::min(2 * h, rim_length);
  for (plan.n_rim = 1; plan.n_rim < 1000; ++plan.n_rim) {
    plan.rim_ratio = growth_ratio(rim_first, rim_length, plan.n_rim);
    if (plan.rim_ratio < 1.35) break;
  }
  return plan;
}

}  // namespace whine
