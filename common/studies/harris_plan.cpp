#include "studies/harris_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "gear/pair.h"
#include "model/capabilities.h"
#include "system/statics.h"

namespace whine {

std::vector<double> default_torques(double design_torque) {
  constexpr int kTorques = 60;
  std::vector<double> torques;
  for (int t = 1; t <= kTorques; ++t) torques.push_back(2 * design_torque * t / kTorques);
  return torques;
}

std::vector<double> default_reliefs(const ReducedBody& driver, const ReducedBody& driven,
                                    StaticParameters settings, double torque) {
  constexpr int kReliefs = 40, kCoarse = 32;
  for (FlankModification& m : settings.mesh.modification) m.tip = {};
  settings.contact.positions = kCoarse;
  const double bent = static_transmission(driver, driven, settings, torque).transmission_error.maxCoeff();
  const double largest = std::ceil(1.2 * bent * 1e6) * 1e-6;
  std::vector<double> reliefs;
  reliefs.reserve(kReliefs);
  for (int r = 0; r < kReliefs; ++r) reliefs.push_back(largest * r / (kReliefs - 1));
  return reliefs;
}

namespace {

double default_relief_length(const ReducedBody& driver, const ReducedBody& driven, const GearMeshSpec& mesh) {
  const ToothGeometry gear(driver.design);
  const Relief& own = mesh.modification[0].tip;
  if (own.length > 0) return own.length;
  const double start_roll =
      own.start_radius > 0 ? gear.roll_angle_at_radius(own.start_radius) : own.start_roll;
  if (start_roll > 0) return gear.base_radius() * (gear.tip_roll_angle() - start_roll);
  return single_pair_relief_length(driver, driven, mesh);
}

std::vector<double> lengths_of(const std::vector<double>& starts, const GearDesign& driver,
                               const GearDesign& driven, Relieved relieved) {
  const double degree = std::numbers::pi / 180;
  const ToothGeometry gear(driver), other(driven);
  const auto involute = [](const ToothGeometry& g) {
    return g.base_radius() * (g.tip_roll_angle() - g.form_roll_angle());
  };
  const double longest = relieved == Relieved::driver   ? involute(gear)
                         : relieved == Relieved::driven ? involute(other)
                                                        : std::min(involute(gear), involute(other));
  const double tip = gear.tip_roll_angle() / degree, least = tip - longest / gear.base_radius() / degree;
  std::vector<double> lengths;
  double before = tip;
  for (const double start : starts) {
    if (!(start >= least && start < tip))
      fail(Failure::usage, "--start-deg is ", start, " deg; a relief starts between ", least,
           " deg, where the involute begins, and the tip edge at ", tip, " deg (roll angles of the driver)");
    if (start >= before)
      fail(Failure::usage, "--start-deg is ", start, " deg after ", before, " deg; the largest comes first");
    before = start;
    lengths.push_back(gear.base_radius() * (tip - start) * degree);
  }
  return lengths;
}

}  // namespace

std::vector<double> relief_lengths(const std::vector<double>& starts, const std::vector<double>& millimetres,
                                   const ReducedBody& first, const ReducedBody& second,
                                   const GearMeshSpec& mesh, Relieved relieved) {
  require_able("harris-map", traits(mesh, first.design, second.design));
  if (!starts.empty()) return lengths_of(starts, first.design, second.design, relieved);
  if (millimetres.empty()) return {default_relief_length(first, second, mesh)};
  std::vector<double> lengths;
  lengths.reserve(millimetres.size());
  for (const double mm : millimetres) lengths.push_back(mm * 1e-3);
  return lengths;
}

}  // namespace whine
