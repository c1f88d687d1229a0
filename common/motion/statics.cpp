#include "motion/statics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kTableDepth = 1e-3;  // m: statics do not depend on it, near field and far field cancel it

std::vector<MatrixXd> compliance_tables(const ElasticGear& gear) {
  std::vector<MatrixXd> tables;
  for (int offset = -gear.body().offsets; offset <= gear.body().offsets; ++offset)
    tables.push_back(gear.compliance(offset, kTableDepth));
  return tables;
}

// One whole period; false if contact wants more than the range holds.
bool solve_period(const GearMeshModel& model, const ContactRange& range, double load, int positions,
                  StaticArtifact& result) {
  const std::vector<MatrixXd> tables[2] = {compliance_tables(model.gear[0]),
                                           compliance_tables(model.gear[1])};
  const double rb1 = model.kinematics.gear(0).base_radius();
  ComplementaritySolver solver;
  struct Loaded {
    int pair;
    double force;
    ContactPatch patch;
  };
  std::vector<std::vector<Loaded>> loads(positions);
  const double face_width =
      std::min(model.kinematics.gear(0).design().face_width, model.kinematics.gear(1).design().face_width);
  int lowest = 0, highest = 0;
  double start = 0;
  result.least_gap = result.least_force = std::numeric_limits<double>::infinity();
  result.torque_residual = 0;
  for (int i = 0; i < positions; ++i) {
    const MeshPosition position = make_position(model, static_cast<double>(i) / positions, range);
    MatrixXd a = local_compliance(model, position, kTableDepth);
    position.add_to_strips(body_compliance(position, 0, tables[0]) + body_compliance(position, 1, tables[1]),
                           a);
    const VectorXd approach = position.strip_lever[0] / rb1;
    ActiveSet active;
    const Equilibrium e = equilibrium(a, position.gap, approach, load, start, active, solver);
    start = e.x;
    if (position.reaches_window_end(e.p)) return false;
    if (e.x > position.lost_corner_gap)
      fail(Failure::numerical, "at mesh phase ", position.phase, " the deflection ", e.x * 1e6,
           " micrometres closes the gap of a tip edge that would touch below the involute (gap ",
           position.lost_corner_gap * 1e6, " micrometres); lower the torque or set corner_contact = false");
    if (e.x > position.next_corner_gap) return false;
    result.mesh_phase[i] = position.phase;
    result.transmission_error[i] = e.x;
    result.stiffness_secant[i] = load / e.x;
    result.stiffness_tangent[i] = e.stiffness;
    result.torque_residual = std::max(result.torque_residual, e.residual);
    result.least_gap = std::min(result.least_gap, e.certificate.least_gap);
    result.least_force = std::min(result.least_force, e.certificate.least_force);
    const VectorXd pair_loads = position.pair_loads(e.p);
    for (size_t j = 0; j < position.pairs.size(); ++j) {
      loads[i].push_back(
          {position.pairs[j].pair, pair_loads[j],
           contact_patch(position.pairs[j], e.p.segment(position.first_strip[j], position.pairs[j].size()),
                         face_width)});
      if (pair_loads[j] > 0) {
        lowest = std::min(lowest, position.pairs[j].pair);
        highest = std::max(highest, position.pairs[j].pair);
      }
    }
  }
  lowest = std::min(lowest, -1);
  highest = std::max(highest, 1);
  result.pair = Eigen::VectorXi::LinSpaced(highest - lowest + 1, lowest, highest);
  result.tooth_load = MatrixRM::Zero(positions, result.pair.size());
  result.contact_pressure = result.contact_half_width = result.tooth_load;
  for (int i = 0; i < positions; ++i)
    for (const Loaded& at : loads[i]) {
      if (!(at.force > 0)) continue;
      result.tooth_load(i, at.pair - lowest) = at.force;
      result.contact_pressure(i, at.pair - lowest) = at.patch.pressure;
      result.contact_half_width(i, at.pair - lowest) = at.patch.half_width;
    }
  return true;
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
  for (VectorXd* v :
       {&result.mesh_phase, &result.transmission_error, &result.stiffness_secant, &result.stiffness_tangent})
    v->resize(positions);

  double largest_force = 1.1 * load * window * window, corner_gap = 1e-6 + 8e-9 * load;
  for (int attempt = 0;; ++attempt) {
    const ContactRange range = contact_range(
        model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(), slice.contact.strips,
        load / model.kinematics.contact_ratio(), largest_force, corner_gap);
    if (solve_period(model, range, load, positions, result)) break;
    if (attempt == 6)
      fail(Failure::numerical, "at ", torque, " N m contact leaves the flanks: window ",
           range.half_window * 1e3, " mm either side, tip edges up to ", corner_gap * 1e6,
           " micrometres away; lower the torque");
    largest_force *= 1.6;
    corner_gap *= 1.6;
  }
  result.mean_stiffness = result.stiffness_secant.mean();
  result.backlash_margin = driver.design.tooth_thinning + driven.design.tooth_thinning > 0
                               ? model.kinematics.backlash() + result.transmission_error.minCoeff()
                               : std::numeric_limits<double>::infinity();
  return result;
}

}  // namespace whine
