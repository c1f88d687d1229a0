#include "dynamics/system_period_map.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/dense.h"
#include "base/error.h"
#include "base/model_range.h"
#include "base/progress.h"
#include "model/capabilities.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SystemPeriodMap::SystemPeriodMap(SystemDynamics& dynamics, int steps)
    : MotionMap(steps), dynamics_(dynamics) {
  const SystemDynamics::State rest = dynamics.rest();
  const Index n = rest.z.size(), loads = rest.relaxed.size(), slots = rest.p.size();
  const double scale = std::sqrt(2 * dynamics.energy(rest));
  unit_.resize(2 * n + loads + slots + rest.line_load.size());
  const SystemCoordinates& coordinates = dynamics.coordinates();
  for (Index i = 0; i < n; ++i)
    unit_[i] = scale / (i < coordinates.rigid ? dynamics.motion_.axis_frequency : coordinates.frequency[i]);
  unit_.segment(n, n).setConstant(scale);
  constexpr double kLeast = 1e-10;  // of the largest: fields that hardly move anything
  for (size_t b = 0; b < dynamics.coupling_.size(); ++b) {
    const VectorXd own = dynamics.coupling_[b].diagonal();
    if (own.size() == 0) continue;
    const double most = own.maxCoeff();
    unit_.segment(2 * n + dynamics.relaxed_first_[b], own.size()) =
        scale * own.cwiseMax(most > 0 ? kLeast * most : 1).cwiseSqrt().cwiseInverse();
  }
  unit_.segment(2 * n + loads, slots).setConstant(rest.p.maxCoeff());
  if (rest.line_load.size() > 0) unit_.tail(slots).setConstant(rest.line_load.maxCoeff());
  rest_ = flat(rest);
}

void SystemPeriodMap::set_parameter(double mesh_frequency) {
  dynamics_.set_speed(mesh_frequency, steps_);
  applied_ = false;
}

VectorXd SystemPeriodMap::flat(const SystemDynamics::State& state) const {
  VectorXd y(unit_.size());
  y << state.z, state.v, state.relaxed, state.p, state.line_load;
  return y.cwiseQuotient(unit_);
}

SystemDynamics::State SystemPeriodMap::state(const VectorXd& y) const {
  if (y.size() != unit_.size())
    fail(Failure::numerical, "a state of ", y.size(), " numbers does not fit positions with ", unit_.size());
  const VectorXd own = y.cwiseProduct(unit_);
  const Index n = dynamics_.coordinates().size(), loads = dynamics_.relaxed_size(), slots = dynamics_.slots();
  return {own.head(n), own.segment(n, n), own.segment(2 * n, loads), own.segment(2 * n + loads, slots),
          own.tail(own.size() - 2 * n - loads - slots)};
}

VectorXd SystemPeriodMap::apply(const VectorXd& y) {
  SystemDynamics::State state = this->state(y);
  applied_ = left_last_ = false;
  const int hunting = dynamics_.hunting_periods();
  for (int k = 0; k < hunting; ++k) {
    if (hunting > 1) report_step("mesh period of a hunting period,", k, hunting);
    if (!dynamics_.integrate(state, period_)) {
      left_zone_ = left_last_ = true;
      fail_outside_range(
          Failure::numerical, "at ", parameter(),
          " Hz a mesh deflects beyond the tip edges that are looked at; lower the torque or raise the damping");
    }
  }
  applied_ = true;
  return flat(state);
}

MatrixXd SystemPeriodMap::tangent() {
  return tangent_times(MatrixXd::Identity(size(), size()));
}

// Changes of the contact forces (slot, direction) at the end of step i, of coordinates and relaxed loads without them.
void SystemPeriodMap::solve_contacts(int i, const MatrixXd& z, const MatrixXd& relaxed,
                                     const MatrixXd& line_load, MatrixXd& p) const {
  const SystemDynamics& of = dynamics_;
  const SystemDynamics::Position& position = of.at(i);
  std::vector<Index> active;
  for (int k = 0; k < position.size(); ++k)
    if (of.forces()(i, position.contact[static_cast<size_t>(k)].slot) > 0) active.push_back(k);
  MatrixXd tangent = position.compliance(active, active), e(static_cast<Index>(active.size()), z.cols());
  for (size_t a = 0; a < active.size(); ++a) {
    const auto k = static_cast<int>(active[a]);
    const SystemDynamics::Contact& contact = position.contact[static_cast<size_t>(k)];
    const auto row = static_cast<Index>(a);
    tangent(row, row) += position.law[static_cast<size_t>(k)].at(of.forces()(i, contact.slot)).slope;
    e.row(row).setZero();
    of.each_part(position, k, [&](Index first, const auto& h) {
      e.row(row) -= h.transpose() * z.middleRows(first, h.size());
    });
    for (size_t s = 0; s < 2; ++s) {
      const auto b = static_cast<size_t>(contact.body[s]);
      for (int at = of.relaxed_first_[b], slot = 0; at < of.relaxed_first_[b + 1];
           at += SystemDynamics::kFields, ++slot)
        e.row(row) += of.reading(position, contact, s, slot).transpose() *
                      relaxed.middleRows<SystemDynamics::kFields>(at);
    }
  }
  if (of.points() > 1)
    for (int l = 0; l < position.size(); ++l)
      e += position.uneven_reading(active, l) * line_load.row(position.contact[static_cast<size_t>(l)].slot);
  p.setZero();
  if (!active.empty()) {
    const MatrixXd forces = of.slides() ? MatrixXd(-lu_solve(tangent, e)) : MatrixXd(-tangent.llt().solve(e));
    for (size_t a = 0; a < active.size(); ++a)
      p.row(position.contact[static_cast<size_t>(active[a])].slot) = forces.row(static_cast<Index>(a));
  }
}

void SystemPeriodMap::require_tangent() const {
  if (!applied_)
    fail(Failure::numerical, "the tangent at ", parameter(),
         " Hz is asked for before a period was integrated at this speed");
  if (const int periods = dynamics_.hunting_periods(); periods > 1)
    require_able("branches", {{Trait::differing, text("of ", periods, " mesh periods")}});
}

// Relaxed line loads after a step; of lines that have gone nothing is left.
MatrixXd SystemPeriodMap::moved_on(const SystemDynamics::Position& position, const MatrixXd& line_load,
                                   const MatrixXd& present) const {
  MatrixXd next = MatrixXd::Zero(dynamics_.slots(), line_load.cols());
  for (const SystemDynamics::Contact& contact : position.contact)
    next.row(contact.slot) =
        line_load.row(contact.slot) + dynamics_.relaxed_step_.from_new * present.row(contact.slot);
  return next;
}

// The equations of SystemDynamics::step, linear in what moves.
MatrixXd SystemPeriodMap::tangent_times(const MatrixXd& directions) {
  require_tangent();
  SystemDynamics& of = dynamics_;
  const Index n = of.coordinates().size(), loads = of.relaxed_size(), slots = of.slots(),
              many = directions.cols();
  const MatrixXd start = unit_.asDiagonal() * directions;
  MatrixXd z = start.topRows(n), v = start.middleRows(n, n), relaxed = start.middleRows(2 * n, loads),
           force = MatrixXd::Zero(n, many), load = MatrixXd::Zero(loads, many),
           p = start.middleRows(2 * n + loads, slots),
           line_load = start.bottomRows(start.rows() - 2 * n - loads - slots),
           present = MatrixXd::Zero(line_load.rows(), many);
  const auto spread = [&](const SystemDynamics::Position& position) {  // of p
    force.setZero();
    load.setZero();
    present.setZero();
    for (int k = 0; k < position.size(); ++k) {
      const SystemDynamics::Contact& contact = position.contact[static_cast<size_t>(k)];
      if (p.row(contact.slot).isZero(0)) continue;
      if (of.points() > 1) present.row(contact.slot) = p.row(contact.slot) / position.width[k];
      of.each_part(
          position, k,
          [&](Index first, const auto& h) { force.middleRows(first, h.size()) -= h * p.row(contact.slot); },
          of.pushing());
      for (size_t s = 0; s < 2; ++s)
        load.middleRows<SystemDynamics::kFields>(contact.load_at[s]) +=
            of.field(position, contact, s) * p.row(contact.slot);
    }
  };
  const auto a11 = of.a11_.head(n), a12 = of.a12_.head(n), a21 = of.a21_.head(n), a22 = of.a22_.head(n),
             bq = of.bq_.head(n);
  const TurningFrame& frame = of.frame_;
  const bool turns = frame.turns();
  const auto close = [&](const MatrixXd& without) {
    const MatrixXd own = frame.closing(without), half = 0.5 * own;
    frame.add(half, bq, z);
    frame.add(half, a12, v);
    return own;
  };
  MatrixXd of_frame, before;
  spread(of.at(0));
  if (turns) frame.add(frame.stiffness() * frame.motions(z), force);
  for (int i = 1; i <= steps_; ++i) {
    const SystemDynamics::Position& position = of.at(i);
    if (turns) frame.turn(v);
    const MatrixXd old = z;
    z = a11.asDiagonal() * old + a12.asDiagonal() * v + (0.5 * bq).asDiagonal() * force;
    v = (a21.asDiagonal() * old + a22.asDiagonal() * v + (0.5 * a12).asDiagonal() * force).eval();
    relaxed = of.relaxed_step_.decay * relaxed + of.relaxed_step_.from_old * load;
    line_load = of.relaxed_step_.decay * line_load + of.relaxed_step_.from_old * present;
    if (turns) {
      of_frame = close(frame.motions(z));
      before = frame.motions(z);
    }
    solve_contacts(i, z, relaxed, line_load, p);
    spread(position);
    z += (0.5 * bq).asDiagonal() * force;
    v += (0.5 * a12).asDiagonal() * force;
    if (turns) {
      of_frame += close(frame.motions(z) - before);
      frame.add(of_frame, force);
      frame.turn(v);
    }
    relaxed += of.relaxed_step_.from_new * load;
    if (of.points() > 1) line_load = moved_on(position, line_load, present);
  }
  MatrixXd out(directions.rows(), many);
  for (Index c = 0; c < many; ++c) {
    of.z_.head(n) = z.col(c);
    of.v_.head(n) = v.col(c);
    of.relaxed_ = relaxed.col(c);
    of.p_of_slot_ = p.col(c);
    of.line_load_ = line_load.col(c);
    of.rename();
    out.col(c) = flat({of.z_.head(n), of.v_.head(n), of.relaxed_, of.p_of_slot_, of.line_load_});
  }
  return out;
}

std::vector<ContactEvent> SystemPeriodMap::events() const {
  std::vector<ContactEvent> out;  // in the names of this period, its end included
  const MatrixRM& force = dynamics_.forces();
  for (int i = 1; i <= steps_; ++i)
    for (Index slot = 0; slot < force.cols(); ++slot) {
      const double before = force(i - 1, slot), now = force(i, slot);
      if ((before > 0) != (now > 0))
        out.push_back({static_cast<int>(slot), now > 0, static_cast<double>(i) / steps_});
    }
  return out;
}

MotionPeriod SystemPeriodMap::shown() const {
  MotionPeriod out = period_;
  dynamics_.take_tooth_loads(out);
  return out;
}

std::pair<int, int> SystemPeriodMap::place_of(int slot) const {
  const int tooth = slot / dynamics_.points(), pairs = dynamics_.tooth_pairs();
  return {tooth / pairs, tooth % pairs + dynamics_.first_pair()};
}

VectorXd SystemPeriodMap::observable() const {
  return period_.transmission_error.row(0);
}

}  // namespace whine
