#include "io/ranges.h"

#include <algorithm>
#include <map>
#include <vector>

#include "base/error.h"

namespace whine {
namespace {

constexpr double kMetres = 10, kNewtons = 1e12, kStiffness = 1e15, kHertz = 1e9, kTorque = 1e7,
                 kJoules = 1e12, kPascals = 1e15, kSeconds = 1e6, kInertia = 1e9, kRatio = 1e6,
                 kCount = 1 << 30;

const Range kLength{-kMetres, kMetres}, kSize{0, kMetres}, kForce{-kNewtons, kNewtons}, kLoad{0, kNewtons},
    kSpring{-kStiffness, kStiffness}, kStiff{0, kStiffness}, kFrequency{0, kHertz}, kSpeed{0, kHertz, true},
    kMoment{-kTorque, kTorque}, kDrive{0, kTorque, true}, kEnergy{-kJoules, kJoules}, kPressure{0, kPascals},
    kStress{-kPascals, kPascals}, kTime{0, kSeconds}, kMass{0, kInertia, true}, kSigned{-kRatio, kRatio},
    kPositive{0, kRatio}, kShare{0, 1}, kRoll{-10, 10}, kNumber{0, kCount}, kFlag{0, 1}, kPhase{0, kCount},
    kPair{-1000, 1000}, kFlexibility{-1, 1}, kMode{-1e6, 1e6}, kPeriods{1, 1 << 22}, kMultiple{0, 1 << 22};

const std::map<std::string, Range>& table() {
  static const std::map<std::string, Range> all{
      // what is no key of a scene below /parameters
      {"/parameters/operation/torque", kDrive},
      {"/parameters/operation/design_torque", kDrive},
      {"/parameters/operation/reference_torque", kDrive},
      {"/parameters/operation/torque_step", kShare},
      {"/parameters/operation/mesh_phase", kPhase},
      {"/parameters/operation/mesh_frequency_from", kFrequency},
      {"/parameters/operation/mesh_frequency_to", kFrequency},
      {"/parameters/operation/mesh_frequency_step", kFrequency},
      {"/parameters/damping/mean_stiffness", kStiff},
      {"/parameters/damping/driver_bearing_damper", {0, 1e12}},
      {"/parameters/damping/driven_bearing_damper", {0, 1e12}},
      {"/parameters/lumped/mass", kMass},
      {"/parameters/lumped/damping_ratio", kPositive},
      {"/parameters/lumped/damper", {0, 1e15}},
      {"/parameters/lumped/cell_end", kShare},
      {"/parameters/lumped/stiffness", kStiff},
      {"/parameters/lumped/gap", {-1e9, 1e9}},
      {"/parameters/study/seed", {0, 2147483647.0}},
      // mesh.h5
      {"/sector/node_position", {-1000, 1000}},
      {"/sector/element_node", kNumber},
      {"/sector/element_region", kFlag},
      {"/sector/bore_node", kNumber},
      {"/sector/side_node", kNumber},
      {"/sector/flank_node", kNumber},
      {"/sector/flank_roll_angle", kRoll},
      {"/cracked_tooth/node_position", {-1000, 1000}},
      {"/cracked_tooth/element_node", kNumber},
      {"/cracked_tooth/element_region", kFlag},
      {"/cracked_tooth/bore_node", kNumber},
      {"/cracked_tooth/side_node", kNumber},
      {"/cracked_tooth/flank_node", kNumber},
      {"/cracked_tooth/flank_roll_angle", kRoll},
      {"/cracked_tooth/slit_node", kNumber},
      // body.h5
      {"/inertia", kMass},
      {"/eigenfrequency", kFrequency},
      {"/nodal_diameter", {0, 2000}},
      {"/component", kFlag},
      {"/inertia_coupling", kMode},
      {"/mass", kMass},
      {"/translation_coupling", kMode},
      {"/flank_position", kRoll},
      {"/flank_mode", kMode},
      {"/compliance/offsets", {0, 1000}},
      {"/compliance/offset_", kFlexibility},
      {"/compliance/crack", kFlexibility},
      {"/compliance/reference_depth", kSize},
      {"/compliance/asymmetry", kShare},
      {"/compliance/least_eigenvalue", kFlexibility},
      // of one of several bodies, whatever its name
      {"/body/", kForce},
      // static.h5, loaded.h5, error_budget.h5
      {"/contact_ratio", {0, 100, true}},
      {"/hunting_periods", kPeriods},
      {"/backlash_margin", kLength},
      {"/mesh_phase", kPhase},
      {"/transmission_error", kLength},
      {"/unloaded_transmission_error", kLength},
      {"/mesh_stiffness_secant", kSpring},
      {"/mesh_stiffness_tangent", kSpring},
      {"/pair", kPair},
      {"/tooth_load", kForce},
      {"/contact_pressure", kPressure},
      {"/contact_half_width", kSize},
      {"/transmission_error_harmonic", kLength},
      {"/transmission_error_order", kLength},
      {"/mesh_stiffness_harmonic", kSpring},
      {"/mean_stiffness", kStiff},
      {"/certificate/least_gap", kLength},
      {"/certificate/least_force", kForce},
      {"/certificate/torque_residual", kPositive},
      {"/tooth", {0, 2000}},
      {"/root_stress", kStress},
      {"/strip/pair", kPair},
      {"/strip/roll_angle", kRoll},
      {"/strip/width", kSize},
      {"/strip/force", kForce},
      {"/strip/pressure", kPressure},
      {"/strip/separation", kLength},
      {"/strip/deflection", kLength},
      {"/certificate/hub_torque", kMoment},
      {"/certificate/contact_torque", kMoment},
      {"/certificate/strain_energy", kEnergy},
      {"/certificate/contact_work", kEnergy},
      {"/refinement/mean_stiffness_change", kSigned},
      {"/refinement/peak_to_peak_change", kSigned},
      {"/refinement/harmonic_change", kSigned},
      {"/choice/mean_stiffness_change", kSigned},
      {"/choice/peak_to_peak_change", kSigned},
      {"/choice/harmonic_change", kSigned},
      {"/refinement/pressure_change", kSigned},
      {"/choice/pressure_change", kSigned},
      // impact.h5
      {"/natural_frequency", kFrequency},
      {"/damping_ratio", kSigned},
      {"/undamped_frequency", kFrequency},
      {"/ring_down/mesh_phase", kShare},
      {"/ring_down/time", kTime},
      {"/ring_down/transmission_error", kLength},
      {"/by_phase/loaded_pairs", {0, 1000}},
      {"/by_phase/natural_frequency", kFrequency},
      {"/by_phase/damping_ratio", kSigned},
      {"/by_phase/undamped_frequency", kFrequency},
      {"/by_phase/eigen_frequency", kFrequency},
      {"/by_phase/eigen_damping_ratio", kSigned},
      {"/by_phase/fit_residual", kPositive},
      {"/by_phase/frozen_frequency", kFrequency},
      {"/certificate/least_mesh_force", kSigned},
      // sweep.h5, response.h5
      {"/mesh_frequency", kSpeed},
      {"/mesh_force", kForce},
      {"/periods", kNumber},
      {"/residual", {0, 1e300}},
      {"/period_multiple", kMultiple},
      {"/energy_imbalance", {-1e300, 1e300}},
      {"/energy/", kEnergy},
      {"/drift_force", kForce},
      {"/certificate/fallbacks", kNumber},
      {"/jump_frequency", kFrequency},
      {"/jump_width", kFrequency},
      {"/dte_rms", kSize},
      {"/dte_mean", kLength},
      {"/dte_harmonic", kSize},
      {"/dte_order", kSize},
      {"/tooth_load_max", kLoad},
      {"/mesh_force_max", kLoad},
      {"/separation_fraction", kShare},
      {"/separations_per_period", kPositive},
      // branch.h5
      {"/floquet_multiplier", {-1e12, 1e12}},
      {"/stable", kFlag},
      {"/steps", kNumber},
      {"/segment_mismatch", kPositive},
      {"/fold_frequency", kFrequency},
      {"/fold_rms", kSize},
      {"/fold_smooth", kFlag},
      {"/fold_multiplier", {-1e12, 1e12}},
      {"/flip_frequency", kFrequency},
      {"/torus_frequency", kFrequency},
      {"/grazing_frequency", kFrequency},
      {"/grazing_phase", kShare},
      {"/grazing_pair", kPair},
      {"/grazing_closes", kFlag},
      // jump_map.h5
      {"/first_harmonic", kStiff},
      {"/one_pair_frequency", kFrequency},
      {"/two_pair_frequency", kFrequency},
      {"/rayleigh_stiffness", kTime},
      {"/branches_from", kFrequency},
      {"/branches_to", kFrequency},
      {"/loss_from", kFrequency},
      {"/loss_to", kFrequency},
      {"/excitation", kPositive},
      {"/two_branches", kFlag},
      {"/open_below", kFlag},
      {"/unsteady", kNumber},
      {"/peak_tooth_load", kLoad},
      {"/held_tooth_load", kLoad},
      {"/load_frequency", kFrequency},
      {"/held_load_there", kLoad},
      {"/dte_rms_there", kSize},
      {"/jump_case", kNumber},
      {"/jump_direction", kFlag},
      {"/up/", {0, kNewtons}},
      {"/down/", {0, kNewtons}},
      // harris_map.h5
      {"/torque", kDrive},
      {"/relief", kSize},
      {"/relief_length", kSize},
      {"/start_roll_angle", kRoll},
      {"/peak_to_peak", kSize},
      {"/harmonic_", kSize},
      {"/optimum_relief", kSize},
      {"/optimum_peak_to_peak", kSize},
      {"/cusp", kSize},
      {"/unrelieved", kSize},
      {"/check/points", kNumber},
      {"/check/largest_error", kPositive},
      {"/dynamic/rms", kSize},
      {"/dynamic/worst_frequency", kFrequency},
      // variant.h5, study.h5
      {"/answer/", {-1e30, 1e30}},
      {"/key/", {-1e30, 1e30}},
      {"/refused", kFlag},
      // readings.h5
      {"/parameters/readings/outside", kNumber},
      {"/reading/dedendum", {1, 2}},
      {"/reading/rack_tip_share", kShare},
      {"/reading/rack_tip_radius", kShare},
      {"/reading/tooth_thinning", kSize},
      {"/reading/frequency_offset", {-1, 1}},
      {"/reading/mass_share", kShare},
      {"/reading/undamped_depth", kSize},
      {"/reading/steps_per_period", {16, 4096}},
      {"/reading/bore_radius", kSize},
      {"/reading/total_inertia", kMass},
      {"/reading/rayleigh_mass", {0, 1e6}},
      {"/reading/rayleigh_stiffness", kTime},
      {"/reading/level_ratio", kPositive},
      {"/reading/first_harmonic", kPositive},
      {"/reading/jump_up", kFrequency},
      {"/reading/jump_down", kFrequency},
      {"/reading/corner_angle", {0, 3.2}},
      {"/value", {-1e30, 1e30}},
      {"/exists", kFlag},
      {"/verdict", {0, 5}},
  };
  return all;
}

}  // namespace

const Range* range_of(const std::string& dataset) {
  const auto found = table().find(dataset);
  if (found != table().end()) return &found->second;
  // Numbered datasets and groups whose members are named elsewhere.
  for (const char* start :
       {"/compliance/offset_", "/energy/", "/up/", "/down/", "/harmonic_", "/answer/", "/key/", "/body/"})
    if (dataset.starts_with(start)) return &table().at(start);
  if (dataset.starts_with("/parameters/")) return nullptr;
  fail(Failure::numerical, "dataset ", dataset, " has no range; give it one in common/io/ranges.cpp");
}

std::string outside(const Range& range, double value) {
  if (value > range.least && value <= range.most) return "";
  if (value == range.least && !range.open) return "";
  return text("holds ", value, ", allowed is ", range.open ? "more than " : "", range.least, " to ",
              range.most);
}

}  // namespace whine
