#include "motion/jump_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "gear/pair.h"
#include "motion/impact.h"
#include "motion/statics.h"
#include "motion/sweep.h"
#include "signal/response.h"
#include "signal/spectrum.h"

namespace whine {

using Eigen::VectorXd;

namespace {

constexpr int kStatePhases = 128;
constexpr double kLeastSpeed = 0.57, kMostSpeed = 1.2;  // of the frequency between rigid gears

VectorXd speeds_of(const JumpMapPlan& plan, double natural_frequency) {
  const double from = plan.from > 0 ? plan.from : kLeastSpeed * natural_frequency,
               to = plan.to > 0 ? plan.to : kMostSpeed * natural_frequency;
  if (!(plan.step > 0) || !std::isfinite(plan.step))
    fail(Failure::input, "a step of ", plan.step, " Hz between the speeds; it must be above 0");
  if (!(to >= from) || !std::isfinite(to))
    fail(Failure::input, "the speeds from ", from, " to ", to, " Hz are no range");
  const double anchor = plan.load_frequency > 0 ? plan.load_frequency : from;
  if (anchor < from || anchor > to)
    fail(Failure::input, "the loads are wanted at ", anchor, " Hz, but the speeds run from ", from, " to ",
         to, " Hz; change --loads-at, --from or --to");
  const double first = std::ceil((from - anchor) / plan.step - 1e-9),
               last = std::floor((to - anchor) / plan.step + 1e-9);
  if (last - first > 1e5)
    fail(Failure::input, "the speeds from ", from, " to ", to, " Hz in steps of ", plan.step,
         " Hz are more than 100000; a larger step makes fewer");
  const auto count = static_cast<Eigen::Index>(last - first) + 1;
  return VectorXd::LinSpaced(count, anchor + first * plan.step, anchor + last * plan.step);
}

// eta of Eq. 21 that gives the ratio to the pair held; the ratio is nearly linear in it.
double eta_for(double ratio, const HeldMesh& mesh, const std::string& body, double frequency) {
  const double without = frozen_root(with_rayleigh_stiffness(mesh, 0, body)).damping_ratio;
  if (!(ratio > without))
    fail(Failure::input, "bearings and mass-proportional damping alone give a damping ratio of ", without,
         ", above ", ratio, "; ask for more, or lower bearing_ratio or rayleigh_mass_per_s");
  double eta = (ratio - without) / (std::numbers::pi * frequency);
  for (int i = 0; i < 60; ++i) {
    const double found = frozen_root(with_rayleigh_stiffness(mesh, eta, body)).damping_ratio;
    if (std::abs(found - ratio) < 1e-9 * ratio) return eta;
    if (!(found > without)) break;
    eta *= (ratio - without) / (found - without);
  }
  fail(Failure::input, "no rayleigh_stiffness_s gives a damping ratio of ", ratio,
       " with two pairs in contact; ask for less, or lower undamped_depth_mm");
}

// A jump of a sweep; outlived: the branch goes on beyond the last speed, its end is not known.
struct End {
  double frequency = 0;  // Hz
  bool outlived = false;
};

End nearest_to(const std::vector<End>& jumps, double frequency) {
  return *std::min_element(jumps.begin(), jumps.end(), [&](const End& a, const End& b) {
    return std::abs(a.frequency - frequency) < std::abs(b.frequency - frequency);
  });
}

// The branch at f between points of it that a sweep had left before; nothing if they do not reach that far. Points stand
// half a step of the sweep apart or less.
std::optional<BranchPoint> between(std::vector<BranchPoint> points, double f) {
  std::sort(points.begin(), points.end(),
            [](const BranchPoint& a, const BranchPoint& b) { return a.mesh_frequency < b.mesh_frequency; });
  for (size_t i = 1; i < points.size(); ++i) {
    const BranchPoint &a = points[i - 1], &b = points[i];
    if (f < a.mesh_frequency || f > b.mesh_frequency || like_a_jump(a.dte_rms, b.dte_rms)) continue;
    const double width = b.mesh_frequency - a.mesh_frequency,
                 share = width > 0 ? (f - a.mesh_frequency) / width : 0;
    const auto at = [&](double BranchPoint::*value) { return a.*value + share * (b.*value - a.*value); };
    return BranchPoint{f, at(&BranchPoint::dte_rms), at(&BranchPoint::tooth_load_max),
                       at(&BranchPoint::held_load), a.parted || b.parted};
  }
  return std::nullopt;
}

struct Branches {
  double from = 0, to = 0;
  bool open_below = false;
};

// The widest range of speeds at which the two sweeps differ as across a jump. up, down: (speed) RMS, speeds ascending. A
// range between two speeds shows by its jumps alone: rising speed jumps above the jump of falling speed.
std::optional<Branches> branches(const VectorXd& speed, const VectorXd& up, const VectorXd& down,
                                 const std::vector<End>& jumps_up, const std::vector<End>& jumps_down) {
  Eigen::Index best = -1, length = 0;
  for (Eigen::Index i = 0; i < speed.size();) {
    Eigen::Index end = i;
    while (end < speed.size() && like_a_jump(up[end], down[end])) ++end;
    if (end - i > length) {
      best = i;
      length = end - i;
    }
    i = std::max(end, i + 1);
  }
  Branches found;
  if (best >= 0) {
    found.from = speed[best];
    found.to = speed[best + length - 1];
    if (best == 0) {
      found.open_below = true;
    } else if (!jumps_down.empty()) {
      const End end = nearest_to(jumps_down, found.from);
      found.open_below = end.outlived;
      found.from = end.outlived ? speed[0] : end.frequency;
    }
    if (!jumps_up.empty()) {
      const End end = nearest_to(jumps_up, found.to);
      found.to = end.outlived ? speed[speed.size() - 1] : end.frequency;
    }
    return found;
  }
  for (const End& above : jumps_up)
    for (const End& below : jumps_down)
      if (above.frequency > below.frequency && above.frequency - below.frequency > found.to - found.from)
        found = {below.outlived ? speed[0] : below.frequency, above.frequency, below.outlived};
  if (found.to > 0) return found;
  return std::nullopt;
}

}  // namespace

JumpMapArtifact jump_map(const BodyArtifact& driver, const BodyArtifact& driven, const StaticSlice& statics,
                         double torque, const SweepSlice& slice, const JumpMapPlan& plan,
                         const std::function<void(long, long, const std::string&)>& report) {
  const size_t cases = plan.rayleigh_stiffness.size() + plan.damping_ratio.size();
  if (cases == 0)
    fail(Failure::input, "no case: give damping ratios or Rayleigh stiffness factors, one at least");
  for (const auto& [what, values] : {std::pair{"a Rayleigh stiffness factor", &plan.rayleigh_stiffness},
                                     std::pair{"a damping ratio", &plan.damping_ratio}})
    for (double value : *values)
      if (!(value > 0 && value < 1))
        fail(Failure::input, what, " of ", value, "; it must be above 0 and below 1");

  const StaticArtifact rest = static_transmission(driver, driven, statics, torque);
  const double bearing_stiffness =
      torque == slice.reference_torque
          ? rest.mean_stiffness
          : static_transmission(driver, driven, statics, slice.reference_torque).mean_stiffness;
  const GearPair kinematics(driver.design, driven.design, statics.mesh.centre_distance);
  double inverse_mass = 0;  // kg-1
  for (int g = 0; g < 2; ++g)
    inverse_mass += std::pow(kinematics.gear(g).base_radius(), 2) /
                    (g == 0 ? slice.driver_inertia : slice.driven_inertia);
  const VectorXd speed =
      speeds_of(plan, std::sqrt(rest.mean_stiffness * inverse_mass) / (2 * std::numbers::pi));

  ImpactSlice held = slice;
  held.fidelity.contact = "strips";  // the body under a held contact is read on strips
  held.damping.rayleigh_stiffness = 0;
  JumpMapArtifact result;
  const HeldState* two = nullptr;
  const std::vector<HeldState> states =
      held_states(driver, driven, rest, bearing_stiffness, held, kStatePhases);
  for (const HeldState& state : states) {
    if (state.contact_state == "one") result.one_pair_frequency = state.undamped_frequency;
    if (state.contact_state == "two") two = &state;
  }
  if (!two)
    fail(Failure::input, "at ", torque,
         " N m no mesh phase has two pairs in contact, to which the damping ratio belongs");
  result.two_pair_frequency = two->undamped_frequency;
  set_gears(result, driver, driven);
  result.driver_inertia = slice.driver_inertia;
  result.driven_inertia = slice.driven_inertia;
  result.mesh = statics.mesh;
  result.fidelity = slice.fidelity;
  result.contact = statics.contact;
  result.time = slice.time;
  result.damping = held.damping;
  result.torque = torque;
  result.bearing_stiffness = bearing_stiffness;
  result.mean_stiffness = rest.mean_stiffness;
  result.first_harmonic = harmonics(rest.stiffness_secant, 1).amplitude[0];
  result.load_frequency = plan.load_frequency;
  result.mesh_frequency = speed;

  const auto n = static_cast<Eigen::Index>(cases);
  for (VectorXd* v : {&result.rayleigh_stiffness, &result.damping_ratio, &result.branches_from,
                      &result.branches_to, &result.loss_from, &result.loss_to, &result.excitation})
    *v = VectorXd::Zero(n);
  for (Eigen::VectorXi* v : {&result.two_branches, &result.open_below, &result.unsteady})
    *v = Eigen::VectorXi::Zero(n);
  result.peak_tooth_load.resize(n, 2);
  result.held_tooth_load.resize(n, 2);
  Eigen::Index load_row = -1;
  if (plan.load_frequency > 0) {
    (speed.array() - plan.load_frequency).abs().minCoeff(&load_row);
    result.tooth_load.resize(n, 2);
    result.held_load_there.resize(n, 2);
    result.dte_rms_there.resize(n, 2);
  }
  for (int d = 0; d < 2; ++d)
    for (auto* curve : {&result.dte_rms, &result.tooth_load_max, &result.separation_fraction})
      (*curve)[d].resize(n, speed.size());

  SweepSlice own = slice;
  own.frequency_from = speed[0];
  own.frequency_to = speed[speed.size() - 1];
  own.frequency_step = plan.step;
  std::vector<double> jump_frequency, jump_width;
  std::vector<int> jump_case, jump_direction;
  for (Eigen::Index c = 0; c < n; ++c) {
    const auto given = static_cast<Eigen::Index>(plan.rayleigh_stiffness.size());
    own.damping.rayleigh_stiffness = c < given ? plan.rayleigh_stiffness[c]
                                               : eta_for(plan.damping_ratio[c - given], two->mesh,
                                                         slice.fidelity.body, two->undamped_frequency);
    result.rayleigh_stiffness[c] = own.damping.rayleigh_stiffness;
    const double ratio =
        frozen_root(with_rayleigh_stiffness(two->mesh, own.damping.rayleigh_stiffness, slice.fidelity.body))
            .damping_ratio;
    result.damping_ratio[c] = ratio;
    result.excitation[c] = result.first_harmonic / result.mean_stiffness / (2 * ratio);
    std::array<std::vector<End>, 2> jumps;
    const auto note_loss = [&](double f) {
      result.loss_from[c] = result.loss_to[c] > 0 ? std::min(result.loss_from[c], f) : f;
      result.loss_to[c] = std::max(result.loss_to[c], f);
    };
    for (int d = 0; d < 2; ++d) {
      std::vector<BranchPoint> beyond;
      const SweepArtifact swept = sweep(
          driver, driven, rest, bearing_stiffness, own, d == 0 ? "up" : "down",
          [](long, long, const std::string&) {}, &beyond);
      const ResponseArtifact r = response(swept);
      VectorXd held(speed.size());
      for (Eigen::Index i = 0; i < speed.size(); ++i)
        held[i] = held_load(swept.tooth_load[i], slice.time.steps_per_period);
      const auto ascending = [&](const VectorXd& row) { return d == 0 ? row : VectorXd(row.reverse()); };
      result.dte_rms[d].row(c) = ascending(r.dte_rms).transpose();
      result.tooth_load_max[d].row(c) = ascending(r.tooth_load_max).transpose();
      result.separation_fraction[d].row(c) = ascending(r.separation_fraction).transpose();
      result.peak_tooth_load(c, d) = r.tooth_load_max.maxCoeff();
      result.held_tooth_load(c, d) = held.maxCoeff();
      for (Eigen::Index i = 0; i < speed.size(); ++i)
        if (result.separation_fraction[d](c, i) > 0) note_loss(speed[i]);
      for (const BranchPoint& point : beyond) {
        result.peak_tooth_load(c, d) = std::max(result.peak_tooth_load(c, d), point.tooth_load_max);
        result.held_tooth_load(c, d) = std::max(result.held_tooth_load(c, d), point.held_load);
        if (point.parted) note_loss(point.mesh_frequency);
      }
      result.unsteady[c] += static_cast<int>((r.period_multiple.array() == 0).count());
      if (load_row >= 0) {
        result.tooth_load(c, d) = result.tooth_load_max[d](c, load_row);
        result.dte_rms_there(c, d) = result.dte_rms[d](c, load_row);
        result.held_load_there(c, d) = ascending(held)[load_row];
        if (const auto found = between(beyond, plan.load_frequency)) {
          result.tooth_load(c, d) = found->tooth_load_max;
          result.held_load_there(c, d) = found->held_load;
          result.dte_rms_there(c, d) = found->dte_rms;
        }
      }
      for (Eigen::Index j = 0; j < r.jump_frequency.size(); ++j) {
        jump_case.push_back(static_cast<int>(c));
        jump_direction.push_back(d);
        jump_frequency.push_back(r.jump_frequency[j]);
        jump_width.push_back(r.jump_width[j]);
        // A jump whose end was found is as wide as the finest step, one that was not as the sweep's own.
        jumps[d].push_back({r.jump_frequency[j], r.jump_width[j] > 0.75 * plan.step});
      }
      report(2 * c + d + 1, 2 * n, text("damping ratio ", ratio));
    }
    if (const auto found =
            branches(speed, result.dte_rms[0].row(c), result.dte_rms[1].row(c), jumps[0], jumps[1])) {
      result.two_branches[c] = 1;
      result.branches_from[c] = found->from;
      result.branches_to[c] = found->to;
      result.open_below[c] = found->open_below;
    }
  }
  result.jump_frequency =
      Eigen::Map<VectorXd>(jump_frequency.data(), static_cast<Eigen::Index>(jump_frequency.size()));
  result.jump_width = Eigen::Map<VectorXd>(jump_width.data(), static_cast<Eigen::Index>(jump_width.size()));
  result.jump_case =
      Eigen::Map<Eigen::VectorXi>(jump_case.data(), static_cast<Eigen::Index>(jump_case.size()));
  result.jump_direction =
      Eigen::Map<Eigen::VectorXi>(jump_direction.data(), static_cast<Eigen::Index>(jump_direction.size()));
  return result;
}

}  // namespace whine
