// Integrates a mesh period over the steps of step_kernel.h.
#include "dynamics/dynamics.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/model_range.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void RollingDynamics::Period::show(MotionPeriod& out) const {
  out.transmission_error = transmission_error.transpose();
  out.mesh_force = tooth_pair_load.colwise().sum();
  out.largest_tooth_force = tooth_pair_load.colwise().maxCoeff();
  out.tooth_load = tooth_pair_load;
  out.first_pair = -static_cast<int>(tooth_pair_load.rows()) / 2;
  out.bearing_force.resize(bearing_force.size());
  for (size_t g = 0; g < bearing_force.size(); ++g)
    if (bearing_force[g].size() > 0) out.bearing_force[g] = bearing_force[g];
  out.drift_force = drift_force;
  out.least_gap = least_gap;
  out.least_force = least_force;
  out.fallbacks = fallbacks;
  out.friction_coupling = friction_coupling;
}

void MotionPeriod::begin_with_end_of(const MotionPeriod& before) {
  const auto put = [](const auto& from, auto& to) {
    if (to.cols() > 0 && from.cols() > 0 && from.rows() == to.rows()) to.col(0) = from.col(0);
  };
  put(before.transmission_error, transmission_error);
  put(before.mesh_deflection, mesh_deflection);
  put(before.mesh_force, mesh_force);
  put(before.largest_tooth_force, largest_tooth_force);
  put(before.tooth_load, tooth_load);
  for (size_t b = 0; b < bearing_force.size(); ++b) put(before.bearing_force[b], bearing_force[b]);
}

std::vector<RollingDynamics::ContactProblem> RollingDynamics::contact_problems(State& state) {
  std::vector<ContactProblem> problems;
  Period period;
  if (lines() || !integrate(state, period, nullptr, &problems))
    fail(Failure::numerical, "no period of strips to take contact problems from");
  return problems;
}

bool RollingDynamics::integrate(State& state, Period& period, EnergyBalance* energy_balance) {
  if (state.z.size() != frequency_squared_.size() || state.owner_id != owner_id_)
    fail(Failure::input, "the start state, of ", state.z.size(),
         " coordinates, is of other gears or modes: ", "these have ", frequency_squared_.size(),
         "; start from rest or from a state of the same pair");
  if (energy_balance && state.p.size() != positions_[0].mesh.strips())
    fail(Failure::input,
         "the energy balance needs the contact forces of the start state at each strip: it has those of ",
         state.p.size(), " strips, the range has ", positions_[0].mesh.strips(),
         "; integrate a period without an energy balance first");
  if (energy_balance && damping_.speed.size() == 0)
    fail(Failure::input, "no energy balance is recorded at a speed that is passed; set the speed");
  try {
    return integrate(state, period, energy_balance, nullptr);
  } catch (const Error& error) {
    // Where contact fails on a range that the undamped half-plane does not hold, that is the cause.
    const bool in_range = dynamic_cast<const ModelRangeError*>(&error) == nullptr;
    if (!beyond_depth_.empty() && in_range && error.kind() == Failure::numerical)
      fail_outside_range(error.kind(), "at mesh phase ", positions_[sample_ * stride_].mesh.phase, " ",
                         beyond_depth_);
    fail_as(error, "at mesh phase ", positions_[sample_ * stride_].mesh.phase, " ", error.what());
  }
}

void RollingDynamics::fit_teeth(State& state) const {
  const int teeth = 2 * reach_ + 1;
  for (std::vector<MatrixXd>* fields : {&state.relaxed, &state.load})
    for (MatrixXd& field : *fields) {
      const int known = static_cast<int>(field.cols()), kept = std::min(known, teeth);
      if (known == teeth) continue;
      MatrixXd other = MatrixXd::Zero(field.rows(), teeth);
      other.middleCols((teeth - kept) / 2, kept) = field.middleCols((known - kept) / 2, kept);
      field = other;
    }
}

void RollingDynamics::take_bearing_force(Period& period, int sample) const {
  for (int g = 0; g < gears(); ++g) {
    const Bearing& bearing = model_.bearing[g];
    if (!bearing.elastic()) continue;
    Vec2 force = Vec2::Zero();
    for (int c = sway_[g].first; c < sway_[g].first + sway_[g].count; ++c)
      force += coordinates_[c].shift *
               (bearing.stiffness * kernel_.vectors().z[c] + bearing.damping * kernel_.vectors().v[c]);
    period.bearing_force[g].col(sample) = force;
  }
}

// At the end of a step with this transmission error (m). False if a tip edge that the range leaves out would touch.
bool RollingDynamics::keeps_corners(int position, double error) const {
  const PositionLevers& corners = corners_[position];
  if (error > corners.lost_gap)
    fail_outside_range(
        Failure::numerical, "the transmission error ", error * 1e6, " micrometres closes the gap of ",
        corners.lost_gap * 1e6,
        " micrometres of a tip edge that would touch below the involute; lower the torque or set corner_contact = false");
  return !(error > corners.next_gap);
}

// Contact of a step into the period. False if force stands on the end of a candidate zone.
bool RollingDynamics::record_contact(const StepKernel::End& end, int position, Period& period) const {
  const MeshPosition& mesh = positions_[position].mesh;
  period.least_gap = std::min(period.least_gap, end.certificate.least_gap);
  period.least_force = std::min(period.least_force, end.certificate.least_force);
  period.fallbacks += end.certificate.fallback;
  period.friction_coupling = std::max(period.friction_coupling, end.certificate.coupling);
  if (end.contact == StepKernel::Contact::beyond_law)
    require_line_range(mesh, kernel_.p().head(mesh.strips()));
  if (end.contact == StepKernel::Contact::zone_end) {
    // Where a tip edge that the range leaves out would touch, it may take the load off the root.
    if (!(end.error > corners_[position].next_gap))
      require_above_roots(model_, mesh, kernel_.p().head(mesh.strips()));
    return false;
  }
  const StepKernel::Frame& frame = kernel_.frame(position);
  double drift = 0;
  for (int j = 0; j < frame.present; ++j) {
    period.tooth_pair_load(frame.pair[j].slot, sample_) = end.carried[j];
    drift += corners_[position].drift_lever[j] * end.carried[j];
  }
  if (friction_ > 0) {  // beside the difference of the torques
    for (int j = 0; j < frame.present; ++j)
      drift += friction_ * corners_[position].slide_lever[j] * end.carried[j];
    drift -= parameters_.torque / model_.kinematics.gear(0).base_radius() * parameters_.loss_per_friction *
             friction_;
  }
  period.drift_force = std::max(period.drift_force, std::abs(drift));
  return true;
}

bool RollingDynamics::integrate(State& state, Period& period, EnergyBalance* energy_balance,
                                std::vector<ContactProblem>* problems) {
  period.transmission_error.resize(steps_);
  period.tooth_pair_load.setZero(2 * reach_ + 1, steps_);
  period.bearing_force.resize(model_.gear.size());
  for (int g = 0; g < gears(); ++g)
    if (sway_[g].count > 0) period.bearing_force[g].resize(2, steps_);
  period.drift_force = period.least_gap = period.least_force = 0;
  period.fallbacks = 0;
  period.friction_coupling = 0;
  fit_teeth(state);
  kernel_.load_state(state);
  set_gap(0, state.period);
  std::array<Instant, 2>& instants = balance_work_.instants;
  balance_work_.balance = 0;
  if (energy_balance) energy_balance->begin(1, kSides);
  if (energy_balance) fill(instants[0], nullptr, 0, state.p.data(), state.d.data());
  bool begun = false;
  for (int i = 1; i <= steps_; ++i) {
    sample_ = i == steps_ ? 0 : i;
    if (sample_ == 0) {
      kernel_.rename();
      if (energy_balance) rename(instants[(i - 1) % 2]);
      state.period = (state.period + 1) % hunting_;
    }
    const int position = sample_ * stride_;
    if (!begun) {
      set_gap(position, state.period);
      kernel_.predict(sample_);
    }
    // Pipelining: unless somebody looks at the instant that this step ends at, the next one is begun in the same pass that
    // applies the contact forces of this one.
    begun = !energy_balance && !floating_ && i + 1 < steps_;
    if (begun) set_gap(position + stride_, state.period);
    const StepKernel::End end = kernel_.correct(sample_, begun ? i + 1 : -1);
    if (!record_contact(end, position, period)) return false;
    if (problems) problems->push_back(contact_problem());
    if (energy_balance) {
      fill(instants[i % 2], &instants[(i - 1) % 2], position, kernel_.p().data(), kernel_.d().data());
      record_step(instants[(i - 1) % 2], instants[i % 2], *energy_balance);
    }
    period.transmission_error[sample_] = end.error;
    double closing = end.error;
    if (floating_) {
      take_bearing_force(period, sample_);
      closing = closing_weight_.dot(kernel_.vectors().z.head(closing_weight_.size()));
    }
    if (!keeps_corners(position, closing)) return false;
  }
  kernel_.store_state(state, positions_[0].mesh.strips());
  return true;
}

// Of the step at hand.
RollingDynamics::ContactProblem RollingDynamics::contact_problem() const {
  const StripCompliance a = kernel_.compliance(sample_);
  ContactProblem problem{MatrixXd(a.size(), a.size()), MatrixXd(), kernel_.e().head(a.size()),
                         kernel_.step(sample_).active};
  a.assemble(problem.compliance.data());
  if (!(friction_ > 0)) return problem;
  const MeshPosition& mesh = positions_[sample_ * stride_].mesh;
  const MatrixXd& response = kernel_.step(sample_).friction;
  problem.friction.resize(a.size(), a.size());
  for (size_t i = 0; i < mesh.pairs.size(); ++i)
    for (size_t j = 0; j < mesh.pairs.size(); ++j)
      problem.friction
          .block(mesh.first_strip[i], mesh.first_strip[j], mesh.pairs[i].size(), mesh.pairs[j].size())
          .colwise() = mesh.pairs[i].interpolation *
                       (StepKernel::shape_basis() * response.block<StepKernel::kShapeRows, 1>(
                                                        static_cast<Eigen::Index>(i) * StepKernel::kShapeRows,
                                                        static_cast<Eigen::Index>(j)));
  problem.offset -= problem.friction * kernel_.p().head(a.size());
  return problem;
}

}  // namespace whine
