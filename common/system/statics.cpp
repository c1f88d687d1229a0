#include "system/statics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "base/format.h"
#include "base/model_range.h"
#include "base/progress.h"
#include "gear/internal_mesh.h"
#include "gear/losses.h"
#include "system/compliance_split.h"
#include "system/drawing_remarks.h"
#include "system/flank_pressure.h"
#include "system/rectangular_wave.h"
#include "system/root_stress.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// The system of a scene under a torque (N m) on its first body; all others but the held one are free of torque.
SystemModel loaded_system(const ReducedBody& driver, const ReducedBody& driven, const GearMeshSpec& mesh,
                          double torque) {
  SystemModel system(driver, driven, mesh);
  system.layout.drives.push_back({0, System::DriveKind::torque, torque});
  if (mesh.friction.acts())
    system.friction = {system.mesh[0].coefficient_of_friction(torque, mesh.friction.static_frequency)};
  return system;
}

// What friction takes at a position, and its moments about the axes.
void store_friction(const SystemModel& system, const SystemSolution& solution, const SystemPosition& position,
                    int row, StaticResult& result) {
  if (!system.slides()) return;
  for (VectorXd* v : {&result.friction_loss, &result.friction_moment[0], &result.friction_moment[1]})
    (*v)[row] = 0;
  for (const ContactSegment& segment : position.segment) {
    const double force =
        system.friction[0] * solution.equilibrium.p.segment(segment.first_strip, segment.strips).sum();
    result.friction_loss[row] += force * segment.sliding.loss();
    for (size_t s = 0; s < kSides; ++s)
      result.friction_moment[s][row] += force * segment.sliding.direction * segment.sliding.lever[s];
  }
}

// Of the only mesh, one whole hunting period; where and how contact wants more than the range holds, if it does.
std::string solve_period(const SystemModel& system, const std::vector<CandidateZone>& range, int positions,
                         StaticResult& result) {
  const GearMeshModel& model = system.mesh[0];
  const double load = mesh_loads(system)[0];
  SystemStatics statics(system, result.fidelity.contact, range);
  const int rows = positions * result.hunting_periods;
  std::vector<std::pair<int, LoadedSegment>> loads;  // row and what a pair carries there
  int lowest = 0, highest = 0;
  std::vector<VectorXd> start(static_cast<size_t>(result.hunting_periods), VectorXd::Zero(2));
  result.least_gap = result.least_force = std::numeric_limits<double>::infinity();
  result.torque_residual = result.friction_coupling = 0;
  for (int row = 0; row < rows; ++row) {
    report_step("mesh positions", row, rows);
    const int period = row % result.hunting_periods, position = row / result.hunting_periods,
              i = period * positions + position;
    const double phase = static_cast<double>(position) / positions;
    const SystemSolution& solution = statics.solve(phase, period, start[static_cast<size_t>(period)]);
    const SystemEquilibrium& e = solution.equilibrium;
    start[static_cast<size_t>(period)] = e.x;
    if (const std::string beyond = outside_zone(solution, phase); !beyond.empty()) return beyond;
    const double deflection = solution.deflection[0];
    result.mesh_phase[i] = period + phase;
    result.transmission_error[i] = solution.transmission_error[0];
    result.unloaded_error[i] = unloaded_transmission_error(model, phase, period);
    result.stiffness_secant[i] = load / (deflection - result.unloaded_error[i]);
    result.stiffness_tangent[i] = e.stiffness(0, 0);
    for (size_t b = 0; b < system.body.size(); ++b) {
      const Bearing& bearing = system.layout.bodies[b].bearing;
      if (!bearing.elastic()) continue;
      result.bearing_force[b].row(i) = solution.bearing_force[b].transpose();
      // In series on the line of action; that a corner's normal is tilted against it is left out here.
      result.stiffness_tangent[i] = 1 / (1 / result.stiffness_tangent[i] - 1 / bearing.stiffness);
    }
    // With friction forces do not act along what they are read along, and bearings are not in series with the mesh.
    if (system.slides() && model.on_bearings()) result.stiffness_tangent[i] = statics.mesh_stiffness()(0, 0);
    store_friction(system, solution, statics.position(), i, result);
    result.torque_residual = std::max(result.torque_residual, e.residual);
    result.friction_coupling = std::max(result.friction_coupling, e.certificate.coupling);
    result.least_gap = std::min(result.least_gap, e.certificate.least_gap);
    result.least_force = std::min(result.least_force, e.certificate.least_force);
    for (const LoadedSegment& at : solution.loads)
      if (at.force > 0) {
        lowest = std::min(lowest, at.pair);
        highest = std::max(highest, at.pair);
        loads.emplace_back(i, at);
      }
  }
  lowest = std::min(lowest, -1);
  highest = std::max(highest, 1);
  result.pair = Eigen::VectorXi::LinSpaced(highest - lowest + 1, lowest, highest);
  result.tooth_load = MatrixRM::Zero(rows, result.pair.size());
  result.contact_pressure = result.contact_half_width = result.tooth_load;
  for (const auto& [i, at] : loads) {
    result.tooth_load(i, at.pair - lowest) = at.force;
    result.contact_pressure(i, at.pair - lowest) = at.patch.pressure;
    result.contact_half_width(i, at.pair - lowest) = at.patch.half_width;
  }
  return "";
}

// Root stresses at all positions, and where they are largest.
void store_root_stress(const GearMeshModel& model, StaticResult& s) {
  const auto positions = static_cast<size_t>(s.contact.positions);
  std::vector<double> phases;
  for (size_t i = 0; i < positions; ++i)
    phases.push_back(static_cast<double>(i) / static_cast<double>(positions));
  RootStresses roots(model, phases);
  if (!roots.known()) return;
  for (VectorXd* v : {&s.root_stress_max, &s.root_stress_angle, &s.root_stress_phase}) v->setZero(kSides);
  if (s.hunting_periods > 1) s.root_stress_tooth.setZero(kSides);
  // Of teeth that differ by round-off alone the first one is named.
  const double clearly = s.hunting_periods > 1 ? 1 + 1e-9 : 1;
  for (int g = 0; g < kSides; ++g) {
    const int teeth = s.gear[static_cast<size_t>(g)].design.teeth;
    MatrixRM& out = s.root_stress[static_cast<size_t>(g)];
    out.resize(s.tooth_load.rows(), s.tooth_load.cols());
    for (Eigen::Index i = 0; i < out.rows(); ++i) {
      const size_t phase = static_cast<size_t>(i) % positions;
      const int period = static_cast<int>(i) / s.contact.positions;
      for (Eigen::Index k = 0; k < out.cols(); ++k) {
        const RootStress tooth =
            roots.of_tooth(g, phase, s.pair[k], s.pair, s.tooth_load.row(i).transpose(), period);
        out(i, k) = tooth.stress;
        if (tooth.stress <= clearly * s.root_stress_max[g]) continue;
        s.root_stress_max[g] = tooth.stress;
        s.root_stress_angle[g] = tooth.angle;
        s.root_stress_phase[g] = phases[phase] + tooth.pair;
        if (s.hunting_periods > 1)
          s.root_stress_tooth[g] = (GearMeshModel::tooth(g, tooth.pair - period) % teeth + teeth) % teeth;
      }
    }
  }
}

}  // namespace

StaticResult static_transmission(const ReducedBody& driver, const ReducedBody& driven,
                                 const StaticParameters& settings, double torque, double zone_factor) {
  constexpr double kLeastTorque = 1e-9;  // N m: gaps are round-off below
  if (!(torque >= kLeastTorque) || !std::isfinite(torque))
    fail(Failure::input, "torque_Nm = ", torque, " must be finite and at least ", kLeastTorque,
         ": static transmission needs a load");
  const SystemModel system = loaded_system(driver, driven, settings.mesh, torque);
  const GearMeshModel& model = system.mesh[0];
  const double load = mesh_loads(system)[0];
  const int positions = settings.contact.positions;

  StaticResult result;
  set_pair(result, {driver, driven}, settings);
  result.torque = torque;
  result.contact_ratio = model.kinematics.contact_ratio();
  result.hunting_periods = hunting_periods(model);
  constexpr int kMostRows = 1 << 21;
  if (positions > kMostRows / result.hunting_periods)
    fail(Failure::input, "teeth that differ meet again after ", result.hunting_periods,
         " mesh periods; with positions = ", positions, " these are ",
         static_cast<double>(positions) * result.hunting_periods, " positions, at most ", kMostRows,
         " are allowed; lower positions");
  for (VectorXd* v : {&result.mesh_phase, &result.transmission_error, &result.unloaded_error,
                      &result.stiffness_secant, &result.stiffness_tangent})
    v->resize(positions * result.hunting_periods);
  if (system.slides()) result.friction_coefficient = system.friction[0];
  if (system.slides())
    for (VectorXd* v : {&result.friction_loss, &result.friction_moment[0], &result.friction_moment[1]})
      v->resize(positions * result.hunting_periods);
  for (size_t b = 0; b < system.body.size(); ++b)
    if (system.layout.bodies[b].bearing.elastic())
      result.bearing_force[b].resize(positions * result.hunting_periods, 2);

  double widening = 1;
  for (int attempt = 0;; ++attempt) {
    const std::vector<CandidateZone> ranges =
        static_zones(system, settings.contact.strips, zone_factor, widening);
    const CandidateZone& range = ranges[0];
    const std::string beyond = solve_period(system, ranges, positions, result);
    if (beyond.empty()) break;
    if (attempt == kWidenings)
      fail_outside_range(Failure::numerical, "at ", torque, " N m contact leaves the flanks: candidate zone ",
                         range.half_zone * 1e3, " mm either side",
                         // Beyond, no tip edge is that far from a flank.
                         range.corner_gap < 1e-3
                             ? text(", tip edges up to ", range.corner_gap * 1e6, " micrometres away")
                             : "",
                         ", and still ", beyond, "; lower the torque",
                         result.hunting_periods > 1 ? " or the errors of the teeth" : "");
    widening *= kWidening;
  }
  result.mean_stiffness = result.stiffness_secant.mean();
  store_root_stress(model, result);
  result.loss_factor =
      loss_factor(model.kinematics, result.pair, result.mesh_phase, result.tooth_load, torque);
  if (system.slides()) result.efficiency = 1 - result.friction_loss.mean() / torque;
  result.backlash_margin =
      driver.design.tooth_thinning + driven.design.tooth_thinning > 0
          ? model.kinematics.backlash() +
                (model.on_bearings()
                     ? (load / result.stiffness_secant.array() + result.unloaded_error.array()).minCoeff()
                     : result.transmission_error.minCoeff())
          : std::numeric_limits<double>::infinity();
  result.compliance = compliance_split(result);
  result.flank_pressure = flank_pressure(result);
  result.rectangular_wave = rectangular_wave(result);
  result.remarks = remarks(result);
  return result;
}

std::vector<Remark> remarks(const StaticResult& s) {
  std::vector<Remark> out;
  const auto add = [&](bool warning, const auto&... parts) { out.push_back(remark(warning, parts...)); };
  if (s.hunting_periods > 1)
    add(false, "teeth differ: ", s.hunting_periods, " mesh periods, after which the same ones meet, of ",
        s.contact.positions, " positions each");
  const std::vector<Remark> drawn = drawing_remarks(GearPair(s), s.mesh.gear);
  out.insert(out.end(), drawn.begin(), drawn.end());
  if (!s.mesh.corner.enabled)
    add(false, "corner contact is off: only pairs on the line of action carry load");
  if (s.gear[0].design.internal || s.gear[1].design.internal) {
    const double radial = radial_assembly_clearance(GearPair(s));
    if (radial < 0)
      add(true, "trimming interference: the tips overlap by ", -radial * 1e3,
          " mm when the pinion is put into the ring by a radial movement; it has to come in along its axis");
  }
  if (s.tooth_thinning() > 0 && s.backlash_margin <= 0)
    add(true, "the backlash is used up by ", -s.backlash_margin * 1e6,
        " µm; back flanks would touch, which is not modelled");
  if (const double pressure = s.flank_pressure.smooth; pressure > kHardenedSteelPressure)
    add(true, "the contact pressure of ", std::round(pressure * 1e-7) / 100, kBeyondSteel);
  for (const std::vector<Remark>& more :
       {pressure_remarks(s), body_remarks(s), friction_remarks(s, s.torque)})
    out.insert(out.end(), more.begin(), more.end());
  return out;
}

std::vector<Remark> schlenk_speed_remarks(const GearPairParameters& pair, double from, double to) {
  std::vector<Remark> out;
  if (pair.mesh.friction.law != FrictionLaw::schlenk) return out;
  const double per_frequency = pitch_line_speed(GearPair(pair), 1), slow = kSchlenkSpeeds[0] / per_frequency,
               fast = kSchlenkSpeeds[1] / per_frequency;
  if (from < slow)
    out.push_back(remark(false, "below ", shown_number(slow), " Hz the coefficient of friction is that at ",
                         kSchlenkSpeeds[0],
                         " m/s on the pitch line, where the tests of Schlenk's formula begin"));
  if (to > fast)
    out.push_back(remark(false, "above ", shown_number(fast), " Hz the coefficient of friction is that at ",
                         kSchlenkSpeeds[1],
                         " m/s on the pitch line, where the tests of Schlenk's formula end"));
  return out;
}

std::vector<Remark> friction_remarks(const GearPairParameters& pair, double torque) {
  std::vector<Remark> out;
  if (!pair.mesh.friction.acts()) return out;
  out.push_back(remark(
      false,
      "friction acts by its moments and forces on the hubs; it bends no teeth here, which may change the transmission error as much as it does (common/system/README.md, Friction at rest). Losses do not depend on that to first order"));
  if (pair.mesh.friction.law != FrictionLaw::schlenk) return out;
  const GearPair gears(pair);
  if (gears.internal())
    out.push_back(remark(
        true,
        "Schlenk's formula is fit to tests of external gears; of an internal pair its coefficient of friction is an extrapolation. Give a number in [friction]: law = \"constant\""));
  if (const double load = line_load(gears, pair.face_width(), torque); load < kSchlenkLoad)
    out.push_back(remark(false, "the coefficient of friction is that of ", kSchlenkLoad,
                         " N/mm, where the tests of Schlenk's formula begin: the line load is ",
                         shown_number(load), " N/mm"));
  const double frequency = pair.mesh.friction.static_frequency;
  const std::vector<Remark> of_speed = schlenk_speed_remarks(pair, frequency, frequency);
  out.insert(out.end(), of_speed.begin(), of_speed.end());
  return out;
}

std::vector<ContactZone> contact_zones(const ReducedBody& driver, const ReducedBody& driven,
                                       const StaticResult& statics, double phase, int period) {
  if (!(phase >= 0 && phase < 1))
    fail(Failure::input, "mesh phase ", phase, " is not within a mesh period: 0 up to, not including, 1");
  if (period < 0 || period >= statics.hunting_periods)
    fail(Failure::input, "mesh phase ", phase + period, " is outside the range: 0 up to, not including, ",
         statics.hunting_periods,
         statics.hunting_periods == 1 ? " (all teeth are alike, so that every mesh period is the same)"
                                      : " (mesh periods after which the same teeth meet)");
  const SystemModel system = loaded_system(driver, driven, statics.mesh, statics.torque);
  double widening = 1;
  for (int attempt = 0; attempt < kWidenings; ++attempt, widening *= kWidening) {
    SystemStatics solver(system, ContactModel::strips,
                         static_zones(system, statics.contact.strips, 1, widening));
    const SystemSolution& solution = solver.solve(phase, period, VectorXd::Zero(2));
    if (!solution.leaves_zone && solution.deflection[0] <= solution.next_corner_gap[0])
      return solver.zones()[0];
  }
  fail(Failure::numerical, "at mesh phase ", phase, " and ", statics.torque,
       " N m contact leaves the flanks; lower the torque");
}

ReferenceContact reference_contact(const ReducedBody& driver, const ReducedBody& driven,
                                   const StaticResult& statics) try {
  for (const ContactZone& zone : contact_zones(driver, driven, statics, 0.0, 0))
    if (zone.strips.pair == 0)
      return {zone.strips.border, zone.strips.gap, zone.force, zone.separation, zone.approach};
  return {};
} catch (const Error& error) {
  if (error.kind() != Failure::numerical) throw;
  return {};
}

}  // namespace whine
