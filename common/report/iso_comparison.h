// What ISO 6336, method B, says of a pair at one torque, for the figures and pages that set it beside what is computed. A formula that
// has no value for these gears is left out by name; nothing stands in its place.
#pragma once
#include <array>
#include <optional>
#include <string>

#include "gear/dynamic_factor.h"
#include "gear/iso6336_strength.h"
#include "results/response.h"
#include "results/static.h"

namespace whine {

struct IsoComparison {
  std::array<std::optional<IsoRoot>, kSides> root;        // [gear] Y_F, Y_S
  std::array<std::optional<double>, kSides> root_stress;  // [gear] Pa: sigma_F0
  std::optional<double> flank_pressure;                   // Pa: sigma_H0
  std::optional<double> loss_factor;  // 1: H_V of rigid teeth, which is of Niemann and Winter
  std::string missing, why;           // what has no value, and the first reason; "" if all have one
  std::string beyond;                 // which formulas are used outside of their range; "": none
  std::optional<double> resonance;    // Hz: mesh frequency at which N = 1; none without K_v
  // K_v of gears without deviations at a mesh frequency (Hz); none where resonance has none. It is a factor of forces.
  std::optional<double> dynamic_factor(double mesh_frequency) const;
  IsoDynamics dynamics;  // what K_v is computed from; its relief is the smaller one of the two gears' tips
};

// inertia: [gear] kg m2 of all that turns with it, for K_v.
IsoComparison iso_comparison(const StaticResult& statics, const std::array<double, kSides>& inertia);

// The largest force of a mesh in a sweep, sustained for 1/64 of a mesh period where that is known, over rest_force().
struct DynamicFactorPeak {
  Eigen::Index row = 0;            // its speed
  double factor = 0;               // 1
  std::optional<double> standard;  // K_v at that speed
  std::string why_none;            // of K_v
};
DynamicFactorPeak largest_dynamic_factor(const SystemStaticResult& rest, const ResponseResult& response,
                                         size_t mesh);

}  // namespace whine
