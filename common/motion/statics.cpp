#include "motion/statics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "base/progress.h"
#include "base/refusal.h"
#include "motion/compliance_split.h"
#include "motion/flank_pressure.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct Loaded {
  int pair;
  double force;
  ContactPatch patch;
};

// One mesh position, as either contact rung answers it.
struct PositionAnswer {
  Equilibrium equilibrium;
  std::vector<Loaded> loads;
  std::array<Vec2, 2> bearing_force;                // N, see bearing_force(); of gears on bearings
  double deflection = 0;                            // m: what the mesh alone gives way, without bearings
  double next_corner_gap = 0, lost_corner_gap = 0;  // m, see PairsInReach
  bool leaves_window = false;                       // a wider range may do
};

// A rung of contact at one load: the equilibrium at a phase of a mesh period, looked for from `start` (m). One phase after the
// other: what all mesh periods have in common there is kept.
using ContactRung = std::function<PositionAnswer(double phase, int period, double start)>;

struct LoadedStrips {
  MeshPosition position;
  MatrixXd compliance;  // (strip, strip) m N-1
  VectorXd approach;    // (strip) 1
};

constexpr double kStripsDepth = 1e-3;  // m: statics do not depend on it, near field and far field cancel it

LoadedStrips loaded_strips(const GearMeshModel& model, const ContactRange& range,
                           const std::array<std::vector<MatrixXd>, 2>& tables, double phase) {
  LoadedStrips s;
  s.position = make_position(model, phase, range);
  const MatrixXd& a = s.compliance = contact_compliance(model, s.position, tables, kStripsDepth);
  // A contact that happens to end on a sound part of a broken table would look right.
  const double least =
      a.allFinite() ? a.ldlt().vectorD().minCoeff() : std::numeric_limits<double>::quiet_NaN();
  if (!(least > 0))
    fail(Failure::numerical, "at mesh phase ", phase, " the compliance of ", s.position.strips(),
         " strips is not positive definite: pivot ", least,
         " m/N; the body's table is wrong, rebuild body.h5");
  s.approach = s.position.strip_lever[0] / model.kinematics.gear(0).base_radius();
  return s;
}

// With what cracks add to the compliance of a position.
LoadedStrips with_cracks(const LoadedStrips& intact, const MatrixXd& at_nodes) {
  LoadedStrips s = intact;
  s.position.add_to_strips(at_nodes, s.compliance);
  return s;
}

Equilibrium equilibrium(const LoadedStrips& s, double load, double start, ComplementaritySolver& solver) {
  ActiveSet active;
  return equilibrium(s.compliance, s.position.gap, s.approach, load, start, active, solver);
}

std::array<std::vector<MatrixXd>, 2> strips_tables(const GearMeshModel& model) {
  return {compliance_tables(model.gear[0], kStripsDepth), compliance_tables(model.gear[1], kStripsDepth)};
}

// From the equilibrium: the bearings' forces, and what is left of the transmission error for the mesh.
void take_bearings(const GearMeshModel& model, const MeshPosition& position, PositionAnswer& answer) {
  answer.deflection = answer.equilibrium.x;
  for (int g = 0; g < 2; ++g) {
    if (!model.bearing[g].elastic()) continue;
    answer.bearing_force[g] = bearing_force(model, position, g, answer.equilibrium.p);
    answer.deflection += model.outward(g).dot(answer.bearing_force[g]) / model.bearing[g].stiffness;
  }
}

ContactRung strips_rung(const GearMeshModel& model, const ContactRange& range, double load,
                        double face_width) {
  return [&model, range, load, face_width, tables = strips_tables(model), solver = ComplementaritySolver(),
          s = std::optional<LoadedStrips>(), same = std::optional<PositionAnswer>(),
          alike = model.deviation[0].repeats() == 1 && model.deviation[1].repeats() == 1](
             double phase, int period, double start) mutable {
    if (!s || s->position.phase != phase) {
      s = loaded_strips(model, range, tables, phase);
      same.reset();
    }
    if (period > 0) s->position.gap = flank_gaps(model, s->position, period);
    const MeshPosition& position = s->position;
    const MatrixXd cracks = crack_compliance(model, position, period);
    const bool intact = cracks.size() == 0;
    if (intact && same) return *same;
    PositionAnswer answer;
    answer.equilibrium = equilibrium(intact ? *s : with_cracks(*s, cracks), load, start, solver);
    answer.next_corner_gap = position.next_corner_gap;
    answer.lost_corner_gap = position.lost_corner_gap;
    const VectorXd& p = answer.equilibrium.p;
    answer.leaves_window = position.reaches_window_end(p);
    const VectorXd pair_loads = position.pair_loads(p);
    take_bearings(model, position, answer);
    for (size_t j = 0; j < position.pairs.size(); ++j)
      answer.loads.push_back(
          {position.pairs[j].pair, pair_loads[j],
           contact_patch(position.pairs[j], p.segment(position.first_strip[j], position.pairs[j].size()),
                         face_width)});
    if (intact && alike) same = answer;
    return answer;
  };
}

ContactRung line_rung(const GearMeshModel& model, const ContactRange& range, double load, double face_width) {
  // The half window is Hertz's half-width under the whole load: the laws rise over all of it, and the tables keep what
  // lies deeper.
  const double depth = 3 * range.half_window;
  return
      [&model, range, load, face_width, depth,
       tables = std::array{compliance_tables(model.gear[0], depth), compliance_tables(model.gear[1], depth)}](
          double phase, int period, double start) {
        const MeshPosition position =
            make_line_position(model, phase, range.corner_gap, depth, shared_force(load), period);
        MatrixXd c = body_compliance(position, 0, tables[0]) + body_compliance(position, 1, tables[1]);
        if (const MatrixXd cracks = crack_compliance(model, position, period); cracks.size() > 0) c += cracks;
        add_bearings(model, position, c);
        const VectorXd approach = position.strip_lever[0] / model.kinematics.gear(0).base_radius();
        PositionAnswer answer;
        answer.equilibrium = equilibrium(c, position.law, position.gap, approach, load, start);
        answer.next_corner_gap = position.next_corner_gap;
        answer.lost_corner_gap = position.lost_corner_gap;
        take_bearings(model, position, answer);
        const VectorXd& force = answer.equilibrium.p;
        require_line_range(position, force);
        for (size_t j = 0; j < position.pairs.size(); ++j) {
          const double width = position.law[j].width(force[j]);
          ContactPatch patch;
          if (force[j] > 0 && !position.law[j].at_edge(force[j]))
            patch = {4 * force[j] / (std::numbers::pi * width * face_width), 0.5 * width};
          answer.loads.push_back({position.pairs[j].pair, force[j], patch});
        }
        return answer;
      };
}

constexpr int kWidenings = 6;
constexpr double kWidening = 1.6;

// m: what teeth that differ may add to the transmission error.
double largest_error(const GearMeshModel& model) {
  double sum = 0;
  for (const FlankDeviation& flank : model.deviation)
    if (flank.repeats() > 1) sum += std::max(0.0, flank.largest());
  return sum;
}

// How far contact is looked for under a load; widening: 1 unless contact has left it.
ContactRange static_range(const GearMeshModel& model, int strips, double load, double window,
                          double widening) {
  return contact_range(model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(), strips,
                       load / model.kinematics.contact_ratio(), 1.1 * load * window * window * widening,
                       (1e-6 + 8e-9 * load) * widening + largest_error(model), model.flanks());
}

// One whole hunting period; where and how contact wants more than the range holds, if it does.
std::string solve_period(const GearMeshModel& model, const ContactRange& range, double load, int positions,
                         StaticArtifact& result) {
  const double face_width =
      std::min(model.kinematics.gear(0).design().face_width, model.kinematics.gear(1).design().face_width);
  const ContactRung solve = (result.fidelity.contact == ContactModel::line ? line_rung : strips_rung)(
      model, range, load, face_width);
  const int rows = positions * result.hunting_periods;
  std::vector<std::pair<int, Loaded>> loads;  // row and what a pair carries there
  int lowest = 0, highest = 0;
  std::vector<double> start(static_cast<size_t>(result.hunting_periods), 0.0);
  result.least_gap = result.least_force = std::numeric_limits<double>::infinity();
  result.torque_residual = 0;
  for (int row = 0; row < rows; ++row) {
    report_step("mesh positions", row, rows);
    const int period = row % result.hunting_periods, position = row / result.hunting_periods,
              i = period * positions + position;
    const double phase = static_cast<double>(position) / positions;
    const PositionAnswer answer = solve(phase, period, start[period]);
    const Equilibrium& e = answer.equilibrium;
    start[period] = e.x;
    if (answer.leaves_window) return text("at mesh phase ", phase, " the pressure reaches the window's end");
    const double deflection = answer.deflection;
    if (deflection > answer.lost_corner_gap)
      refuse(Failure::numerical, "at mesh phase ", phase, " the deflection ", deflection * 1e6,
             " micrometres closes the gap of a tip edge that would touch below the involute (gap ",
             answer.lost_corner_gap * 1e6, " micrometres); lower the torque or set corner_contact = false");
    if (deflection > answer.next_corner_gap)
      return text("at mesh phase ", phase, " the deflection ", deflection * 1e6,
                  " micrometres closes a tip edge's gap of ", answer.next_corner_gap * 1e6, " micrometres");
    result.mesh_phase[i] = period + phase;
    result.transmission_error[i] = e.x;
    result.unloaded_error[i] = unloaded_transmission_error(model, phase, period);
    result.stiffness_secant[i] = load / (deflection - result.unloaded_error[i]);
    result.stiffness_tangent[i] = e.stiffness;
    for (int g = 0; g < 2; ++g) {
      const Bearing& bearing = model.bearing[g];
      if (!bearing.elastic()) continue;
      result.bearing_force[g].row(i) = answer.bearing_force[g].transpose();
      // In series on the line of action; that a corner's normal is tilted against it is left out here.
      result.stiffness_tangent[i] = 1 / (1 / result.stiffness_tangent[i] - 1 / bearing.stiffness);
    }
    result.torque_residual = std::max(result.torque_residual, e.residual);
    result.least_gap = std::min(result.least_gap, e.certificate.least_gap);
    result.least_force = std::min(result.least_force, e.certificate.least_force);
    for (const Loaded& at : answer.loads)
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

}  // namespace

StaticArtifact static_transmission(const BodyArtifact& driver, const BodyArtifact& driven,
                                   const StaticSlice& slice, double torque, double window) {
  constexpr double kLeastTorque = 1e-9;  // N m: gaps are round-off below
  if (!(torque >= kLeastTorque) || !std::isfinite(torque))
    fail(Failure::input, "torque_Nm = ", torque, " must be finite and at least ", kLeastTorque,
         ": static transmission needs a load");
  const GearMeshModel model(driver, driven, slice.mesh);
  const double load = torque / model.kinematics.gear(0).base_radius();
  const int positions = slice.contact.positions;

  StaticArtifact result;
  set_gears(result, driver, driven);
  result.mesh = slice.mesh;
  result.fidelity = slice.fidelity;
  result.contact = slice.contact;
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
  for (int g = 0; g < 2; ++g)
    if (model.bearing[g].elastic()) result.bearing_force[g].resize(positions * result.hunting_periods, 2);

  double widening = 1;
  for (int attempt = 0;; ++attempt) {
    const ContactRange range = static_range(model, slice.contact.strips, load, window, widening);
    const std::string beyond = solve_period(model, range, load, positions, result);
    if (beyond.empty()) break;
    if (attempt == kWidenings)
      refuse(Failure::numerical, "at ", torque, " N m contact leaves the flanks: window ",
             range.half_window * 1e3, " mm either side",
             // Beyond, no tip edge is that far from a flank.
             range.corner_gap < 1e-3 ? text(", tip edges up to ", range.corner_gap * 1e6, " micrometres away")
                                     : "",
             ", and still ", beyond, "; lower the torque",
             result.hunting_periods > 1 ? " or the errors of the teeth" : "");
    widening *= kWidening;
  }
  result.mean_stiffness = result.stiffness_secant.mean();
  result.backlash_margin =
      driver.design.tooth_thinning + driven.design.tooth_thinning > 0
          ? model.kinematics.backlash() +
                (model.on_bearings()
                     ? (load / result.stiffness_secant.array() + result.unloaded_error.array()).minCoeff()
                     : result.transmission_error.minCoeff())
          : std::numeric_limits<double>::infinity();
  return result;
}

std::vector<Remark> remarks(const StaticArtifact& s) {
  std::vector<Remark> out;
  const auto add = [&](bool warning, const auto&... parts) { out.push_back(remark(warning, parts...)); };
  if (s.hunting_periods > 1)
    add(false, "teeth differ: ", s.hunting_periods, " mesh periods, after which the same ones meet, of ",
        s.contact.positions, " positions each");
  if (!s.mesh.corner.enabled)
    add(false, "corner contact is off: only pairs on the line of action carry load");
  if (s.driver.tooth_thinning + s.driven.tooth_thinning > 0 && s.backlash_margin <= 0)
    add(true, "the backlash is used up by ", -s.backlash_margin * 1e6,
        " µm; back flanks would touch, which is not modelled");
  const double pressure = flank_pressure(s).smooth;
  if (pressure > kHardenedSteelPressure)
    add(true, "the contact pressure of ", std::round(pressure * 1e-7) / 100, kBeyondSteel);
  for (const std::vector<Remark>& more : {pressure_remarks(s), body_remarks(s)})
    out.insert(out.end(), more.begin(), more.end());
  return out;
}

std::vector<ContactZone> contact_zones(const BodyArtifact& driver, const BodyArtifact& driven,
                                       const StaticArtifact& statics, double phase, int period) {
  const GearMeshModel model(driver, driven, statics.mesh);
  if (!(phase >= 0 && phase < 1))
    fail(Failure::input, "mesh phase ", phase, " is not within a mesh period: 0 up to, not including, 1");
  if (period < 0 || period >= statics.hunting_periods)
    fail(Failure::input, "mesh phase ", phase + period, " is outside the range: 0 up to, not including, ",
         statics.hunting_periods,
         statics.hunting_periods == 1 ? " (all teeth are alike, so that every mesh period is the same)"
                                      : " (mesh periods after which the same teeth meet)");
  const double load = statics.torque / model.kinematics.gear(0).base_radius();
  const auto tables = strips_tables(model);
  ComplementaritySolver solver;
  double widening = 1;
  for (int attempt = 0; attempt < kWidenings; ++attempt, widening *= kWidening) {
    const ContactRange range = static_range(model, statics.contact.strips, load, 1, widening);
    LoadedStrips s = loaded_strips(model, range, tables, phase);
    if (period > 0) s.position.gap = flank_gaps(model, s.position, period);
    if (const MatrixXd cracks = crack_compliance(model, s.position, period); cracks.size() > 0)
      s = with_cracks(s, cracks);
    const Equilibrium e = equilibrium(s, load, 0.0, solver);
    PositionAnswer answer;
    answer.equilibrium = e;
    take_bearings(model, s.position, answer);
    if (s.position.reaches_window_end(e.p) || answer.deflection > s.position.next_corner_gap) continue;
    const VectorXd separation = s.compliance * e.p + s.position.gap - e.x * s.approach;
    std::vector<ContactZone> zones;
    for (size_t j = 0; j < s.position.pairs.size(); ++j) {
      const auto own = Eigen::seqN(s.position.first_strip[j], s.position.pairs[j].size());
      zones.push_back({s.position.pairs[j], e.p(own), separation(own), e.x});
    }
    return zones;
  }
  fail(Failure::numerical, "at mesh phase ", phase, " and ", statics.torque,
       " N m contact leaves the flanks; lower the torque");
}

ContactZone contact_zone(const BodyArtifact& driver, const BodyArtifact& driven,
                         const StaticArtifact& statics) {
  for (ContactZone& zone : contact_zones(driver, driven, statics, 0.0, 0))
    if (zone.strips.pair == 0) return zone;
  fail(Failure::numerical, "at mesh phase 0 the reference pair is out of reach");
}

}  // namespace whine
