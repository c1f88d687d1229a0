#include "dynamics/system_dynamics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/dense.h"
#include "base/error.h"
#include "base/model_range.h"
#include "dynamics/system_energy_record.h"
#include "gear/layout.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SystemDynamics::SystemDynamics(const SystemModel& system, const SystemMotion& motion)
    : system_(system),
      motion_(motion),
      coordinates_(coordinates_of(system, motion)),
      depth_(motion.damping.undamped_depth),
      relaxation_(motion.fidelity.body == BodyModel::quasi_static ? 0 : motion.damping.rayleigh_stiffness),
      hunting_(whine::hunting_periods(system)),
      sliding_(std::any_of(system.mesh.begin(), system.mesh.end(),
                           [](const GearMeshModel& mesh) { return mesh.friction.acts(); })),
      friction_(VectorXd::Zero(static_cast<Index>(system.mesh.size()))) {
  if (system.slides())
    fail(Failure::numerical,
         "a system in motion takes its coefficients of friction from the speed; clear those of rest");
  if (!(motion.axis_frequency > 0))
    fail(Failure::input, "the axis frequency is ", motion.axis_frequency,
         " rad/s; give that of axis_frequency()");
  const VectorXd loads = mesh_loads(system);
  load_of_mesh_ = loads.cwiseMax(1e-3 * loads.maxCoeff());
  for (int b = 0; b < static_cast<int>(system.layout.bodies.size()); ++b)
    radius_.push_back(system.base_radius(b));
  for (size_t m = 0; m < system.mesh.size(); ++m) carried_.push_back(carried_mesh(system.layout, m));
  for (const GearMeshModel& mesh : system.mesh)
    outward_.push_back({mesh.outward_in_system(0), mesh.outward_in_system(1)});
  turned_.setZero(static_cast<Index>(radius_.size()));
  shifted_.setZero(2, turned_.size());
  offset_.setZero(2, turned_.size());
  for (Index b = 0; b < turned_.size(); ++b)
    offset_.col(b) = offset_of(system.layout.bodies[static_cast<size_t>(b)]);
}

double SystemDynamics::moved(const Position& position, int k, const VectorXd& z, Place of) const {
  double out = 0;
  each_part(
      position, k, [&](Index first, const auto& h) { out += h.dot(z.segment(first, h.size())); }, of);
  return out;
}

// Throws if Hertz's law does not hold for a force, or its width leaves the flanks.
void SystemDynamics::require_range(const Position& position, const Eigen::Ref<const VectorXd>& force) const {
  for (int k = 0; k < position.size(); ++k) {
    const auto at = static_cast<size_t>(k);
    if (force[k] <= position.most[at]) continue;
    const HertzLine& law = position.law[at];
    const double width = law.width(force[k]);
    fail_outside_range(Failure::numerical, "a pair of teeth of ",
                       mesh_name(system_.layout, static_cast<size_t>(position.contact[at].mesh)), " carries ",
                       force[k], " N on a width of ", width * 1e3, " mm; its flanks face each other over ",
                       position.facing[at] * 1e3, " mm, and Hertz's law holds up to ", law.largest_force(),
                       " N; lower the torque, or raise undamped_depth_mm");
  }
}

// y -= h force
void SystemDynamics::push(const Position& position, int k, double force, VectorXd& y, Place of) const {
  each_part(
      position, k, [&](Index first, const auto& h) { y.segment(first, h.size()) -= force * h; }, of);
}

// fields += V S p
void SystemDynamics::load(const Position& position, const VectorXd& p, VectorXd& fields) const {
  for (int k = 0; k < position.size(); ++k) {
    const Contact& contact = position.contact[static_cast<size_t>(k)];
    for (size_t s = 0; s < 2; ++s)
      fields.segment<kFields>(contact.load_at[s]) += p[k] * field(position, contact, s);
  }
}

VectorXd SystemDynamics::participation(const Position& position, int k, Place of) const {
  VectorXd out = VectorXd::Zero(coordinates_.size());
  push(position, k, -1, out, of);
  return out;
}

// (contact, contact) h diag(weight) h^T, on the right the rows that are pushed.
MatrixXd SystemDynamics::modal_compliance(const Position& position, const VectorXd& weight,
                                          Place pushed) const {
  MatrixXd out = MatrixXd::Zero(position.size(), position.size());
  for (size_t p = 0; p < part_.size(); ++p) {
    const Rows& rows = position.rows[p];
    const Part& part = part_[p];
    const auto of = [&](Place place) {
      return Eigen::Map<const MatrixXd, 0, Eigen::OuterStride<>>(
          stream_.data() + rows.*place, part.count, rows.contacts(), Eigen::OuterStride<>(part.length()));
    };
    const MatrixXd own =
        of(&Rows::row).transpose() * weight.segment(part.first, part.count).asDiagonal() * of(pushed);
    for (int k = 0; k < rows.contacts(); ++k)
      for (int l = 0; l < rows.contacts(); ++l)
        out(position.order.data()[rows.begin + k], position.order.data()[rows.begin + l]) += own(k, l);
  }
  return out;
}

void SystemDynamics::set_speed(double mesh_frequency, int steps) {
  const int finest = static_cast<int>(positions_.size()) - 1;
  if (steps <= 0 || finest % steps != 0)
    fail(Failure::numerical, steps, " steps per period do not divide the ", finest,
         " positions of a mesh period");
  mesh_frequency_ = mesh_frequency;
  steps_ = steps;
  stride_ = finest / steps;
  frame_ =
      TurningFrame(system_.layout, coordinates_, 2 * std::numbers::pi * mesh_frequency * motion_.frame_turns);
  set_friction(friction_at(mesh_frequency));
  propagate_by(1 / (mesh_frequency * steps));
  for (int i = 0; i <= steps_; ++i) close(positions_[static_cast<size_t>(i) * static_cast<size_t>(stride_)]);
  forces_.setZero(steps_ + 1, slots());
  if (points_ > 1) tooth_forces_.setZero(steps_ + 1, meshes() * tooth_pairs());
}

// Elastic coordinates follow their force, z = (torque - h p) / w^2, so that they are compliances; rotations carry the load. Of a frame
// that turns its forces are those of the z before, repeated.
SystemEquilibrium SystemDynamics::equilibrium_at(int i, VectorXd* z) {
  SystemEquilibrium out = equilibrium_under({}, i, z);
  if (!frame_.turns()) return out;
  constexpr int kMost = 100;
  constexpr double kReached = 1e-13, kEnough = 1e-10;  // change of the forces, of the largest
  VectorXd own, force, next = frame_.constant();
  double before = std::numeric_limits<double>::infinity();
  for (int n = 0; n < kMost; ++n) {
    force = next;
    try {
      out = equilibrium_under(force, i, &own);
    } catch (const Error& error) {
      if (error.kind() != Failure::numerical) throw;
      break;  // forces that have grown this far
    }
    next = frame_.force(own);
    const double change = (next - force).cwiseAbs().maxCoeff() / next.cwiseAbs().maxCoeff();
    if (change < kReached || (change < kEnough && !(change < 0.5 * before))) {
      if (z) *z = own;
      return out;
    }
    before = change;
  }
  fail(
      Failure::input, "at ", mesh_frequency_, " Hz the carrier turns at ",
      frame_.omega() * 30 / std::numbers::pi,
      " rpm, where centrifugal forces grow faster than what holds the bodies; stiffen the softest [[bearing]], or stay below this speed");
}

// frame: (motion) N, forces of the frame.
SystemEquilibrium SystemDynamics::equilibrium_under(const VectorXd& frame, int i, VectorXd* z) {
  const Position& position = positions_[static_cast<size_t>(i)];
  SystemPosition at = positioned(i);
  VectorXd flexibility = coordinates_.frequency.cwiseAbs2().cwiseInverse(), torque = coordinates_.torque,
           further;
  if (frame.size() > 0) {
    frame_.add(frame, torque);
    further = frame_.on_carriers(frame, coordinates_.inertia.size());
  }
  flexibility.head(coordinates_.rigid).setZero();
  MatrixXd compliance = position.instantaneous_compliance + position.relaxed + crack_at_rest(i) +
                        modal_compliance(position, flexibility);
  if (points_ > 1) compliance += position.uneven;
  const VectorXd by_torque = flexibility.cwiseProduct(torque);
  for (int k = 0; k < position.size(); ++k) at.gap[k] -= moved(position, k, by_torque);
  ComplementaritySolver solver;
  const SystemEquilibrium out =
      equilibrium(system_, at, compliance, VectorXd::Zero(coordinates_.inertia.size()), solver, further);
  require_range(position, out.p);
  if (!z) return out;
  *z = torque;
  for (int k = 0; k < position.size(); ++k) push(position, k, out.p[k], *z);
  *z = z->cwiseProduct(flexibility);
  // x_b = r_b theta_b; unit modal mass, so the shares of a rotation are its own shape times the inertias.
  for (int c = 0; c < coordinates_.rigid; ++c)
    for (int b = 0; b < static_cast<int>(coordinates_.inertia.size()); ++b)
      if (!system_.layout.held(b))
        (*z)[c] += coordinates_.rotation(b, c) * coordinates_.inertia[b] * out.x[b] / system_.base_radius(b);
  return out;
}

VectorXd SystemDynamics::rest_forces(int i) {
  const SystemEquilibrium at = equilibrium_at(i, nullptr);
  VectorXd out = VectorXd::Zero(slots());
  const Position& position = positions_[static_cast<size_t>(i)];
  for (int k = 0; k < position.size(); ++k) out[position.contact[static_cast<size_t>(k)].slot] = at.p[k];
  return out;
}

SystemDynamics::State SystemDynamics::rest(int i) {
  State state;
  const Position& position = positions_[static_cast<size_t>(i)];
  const SystemEquilibrium at = equilibrium_at(i, &state.z);
  state.v = VectorXd::Zero(state.z.size());
  state.p = VectorXd::Zero(slots());
  state.relaxed = VectorXd::Zero(relaxed_size());
  for (int k = 0; k < position.size(); ++k) state.p[position.contact[static_cast<size_t>(k)].slot] = at.p[k];
  load(position, at.p, state.relaxed);
  if (points_ > 1) {
    state.line_load = VectorXd::Zero(slots());
    for (int k = 0; k < position.size(); ++k)
      state.line_load[position.contact[static_cast<size_t>(k)].slot] = at.p[k] / position.width[k];
  }
  return state;
}

// Forces on bearings and pins, from the sums of the contact forces that stand in their places.
void SystemDynamics::record_bearings(int sample, Period& period) const {
  for (int b = 0; b < static_cast<int>(period.bearing_force.size()); ++b) {  // planets before carriers
    const System::Body& body = system_.layout.bodies[static_cast<size_t>(b)];
    auto force = period.bearing_force[static_cast<size_t>(b)].col(sample);
    if (body.bearing.elastic()) {
      const Vec2 moved = coordinates_.bearing_deflection(b, z_);
      force = body.bearing.stiffness * moved + body.bearing.damping * coordinates_.bearing_deflection(b, v_);
      if (frame_.turns() && body.on == System::kGround)
        force += body.bearing.damping * frame_.omega() * Vec2(-moved.y(), moved.x());
    } else if (coordinates_.on_rigid_pin(b)) {
      force -= coordinates_.momentum_rate(b, rate_);
      if (frame_.turns())
        force -=
            frame_.inertia_force(b, coordinates_.translation_of(b, z_), coordinates_.translation_of(b, v_));
    }
    if (body.on != System::kGround) period.bearing_force[static_cast<size_t>(body.on)].col(sample) += force;
  }
}

// False if a tip edge that was left out would touch.
bool SystemDynamics::record(const Position& position, int sample, Period& period) {
  for (int m = 0; m < meshes(); ++m) period.mesh_force(m, sample) = period.largest_tooth_force(m, sample) = 0;
  double *torque = &period.contact_torque(0, sample), *drift = period.drift.data();
  const auto bodies = static_cast<int>(radius_.size()), rollings = static_cast<int>(period.drift.size());
  std::fill_n(drift, rollings, 0.0);
  std::fill_n(torque, bodies, 0.0);
  for (Eigen::Matrix2Xd& force : period.bearing_force) force.col(sample).setZero();
  for (int k = 0, n = position.size(); k < n; ++k) {
    const double p = p_[k];
    if (!(p > 0)) continue;
    const Contact& contact = position.contact[static_cast<size_t>(k)];
    const double friction = friction_of(contact);
    double& largest = period.largest_tooth_force(contact.mesh, sample);
    largest = std::max(largest, p);
    period.mesh_force(contact.mesh, sample) += p;
    for (int c = 0; c < rollings; ++c)
      drift[c] += p * (position.drift(c, k) + friction * position.drift_slide(c, k));
    const Vec2 pressing = p * (contact.normal + friction * contact.across);
    for (size_t s = 0; s < 2; ++s) {
      const auto b = static_cast<size_t>(contact.body[s]);
      period.bearing_force[b].col(sample) -= closing_sign(static_cast<int>(s)) * pressing;
      torque[b] += lever(contact, s) * radius_[b] * p;
    }
    if (const int carrier = carried_[static_cast<size_t>(contact.mesh)].carrier; carrier >= 0)
      torque[carrier] += (contact.carrier_lever + friction * contact.carrier_slide) *
                         radius_[static_cast<size_t>(carrier)] * p;
  }
  if (slides() && motion_.output >= 0)  // torques of the drives alone are in balance
    period.drift -= motion_.loss.dot(friction_) / radius_[static_cast<size_t>(motion_.output)] *
                    coordinates_.rolling.row(motion_.output).transpose();
  if (points_ > 1) record_face(position, sample, period);
  for (Index c = 0; c < period.drift.size(); ++c)
    period.drift_force = std::max(period.drift_force, std::abs(period.drift[c]));
  record_bearings(sample, period);
  period.least_gap = std::min(period.least_gap, certificate_.least_gap);
  period.least_force = std::min(period.least_force, certificate_.least_force);
  period.friction_coupling = std::max(period.friction_coupling, certificate_.coupling);
  for (int b = 0; b < bodies; ++b) {
    turned_[b] = radius_[static_cast<size_t>(b)] * coordinates_.rotation_of(b, z_);
    shifted_.col(b) = coordinates_.translation_of(b, z_) + offset_.col(b);
  }
  bool inside = true;
  for (int m = 0; m < meshes(); ++m) {
    double error = 0, closing = 0;
    for (int s = 0; s < kSides; ++s) {
      const int b = system_.layout.meshes[static_cast<size_t>(m)].side[static_cast<size_t>(s)].body;
      error += closing_sign(s) * turned_[b];
      closing += outward_[static_cast<size_t>(m)][static_cast<size_t>(s)].dot(shifted_.col(b));
    }
    closing += error;
    if (const CarriedMesh& on = carried_[static_cast<size_t>(m)]; on.carrier >= 0)
      error += on.closing * turned_[on.carrier];
    period.transmission_error(m, sample) = error;
    period.mesh_deflection(m, sample) = closing;
    if (closing > position.lost_gap[static_cast<size_t>(m)])
      fail_outside_range(
          Failure::numerical, "at ", mesh_name(system_.layout, static_cast<size_t>(m)), " the deflection ",
          closing * 1e6, " micrometres closes the gap of ", position.lost_gap[static_cast<size_t>(m)] * 1e6,
          " micrometres of a tip edge that would touch below the involute; lower the torque or set corner_contact = false");
    inside = inside && !(closing > position.next_gap[static_cast<size_t>(m)]);
  }
  return inside;
}

void SystemDynamics::resize(Period& period, int steps) const {
  for (MatrixXd* x :
       {&period.transmission_error, &period.mesh_deflection, &period.mesh_force, &period.largest_tooth_force})
    x->resize(meshes(), steps);
  period.contact_torque.resize(coordinates_.inertia.size(), steps);
  period.bearing_force.resize(system_.layout.bodies.size());
  for (Eigen::Matrix2Xd& x : period.bearing_force) x.resize(2, steps);
  period.face.assign(points_ > 1 ? static_cast<size_t>(meshes()) : 0, {});
  period.drift.resize(coordinates_.rolling.cols());
  period.drift_force = period.least_gap = period.least_force = period.friction_coupling = 0;
}

void SystemDynamics::take_tooth_loads(Period& period) const {
  const MatrixRM& forces = tooth_forces();
  const Index pairs = tooth_pairs(), steps = forces.rows() - 1;
  period.first_pair = first_;
  period.tooth_load = forces.topRows(steps).transpose();
  // A pair that is number i in a mesh period is i + 1 in the next.
  for (int m = 0; m < meshes(); ++m) {
    period.tooth_load(m * pairs, 0) = 0;
    period.tooth_load.col(0).segment(m * pairs + 1, pairs - 1) =
        forces.row(steps).segment(m * pairs, pairs - 1).transpose();
  }
}

bool SystemDynamics::integrate(State& state, Period& period, EnergyBalance* balance) {
  if (steps_ == 0) fail(Failure::input, "a period is integrated at a speed; set it first");
  put_gap(0, state.period);
  take(state, at(0));
  resize(period, steps_);
  forces_.row(0) = p_of_slot_;
  if (points_ > 1) tooth_forces_.row(0) = p_of_tooth_;
  SystemEnergyRecord record_of(*this, balance);
  const auto find_loads = [&](const Position& position) {
    load_.setZero(relaxed_size());
    load(position, p_, load_);
  };
  int i = 0;
  try {
    if (balance) {
      find_loads(at(0));
      record_of.start(at(0));
    }
    put_gap(stride_, state.period);
    for (i = 1; i <= steps_; ++i) {
      if (i < steps_) put_gap((i + 1) * stride_, state.period);
      step(at(i), i < steps_ && !balance ? &at(i + 1) : nullptr);
      forces_.row(i) = p_of_slot_;
      if (points_ > 1) tooth_forces_.row(i) = p_of_tooth_;
      require_range(at(i), p_.head(at(i).size()));
      if (!record(at(i), i % steps_, period)) return false;
      if (!balance) continue;
      find_loads(at(i));
      record_of.step(at(i));
    }
  } catch (const Error& error) {
    fail_as(error, "at mesh phase ", static_cast<double>(i) / steps_, " ", error.what());
  }
  rename();
  if (balance) record_of.finish();
  state.z = z_.head(coordinates_.size());
  state.v = v_.head(coordinates_.size());
  state.relaxed = relaxed_;
  state.p = p_of_slot_;
  state.line_load = line_load_;
  state.period = (state.period + 1) % hunting_;
  return true;
}

bool SystemDynamics::integrate_fixed(int i, State& state, double seconds, int steps,
                                     const std::function<void(const VectorXd&, const VectorXd&)>& watch) {
  Position& position = positions_[static_cast<size_t>(i)];
  steps_ = 0;
  frame_ = {};
  set_friction(VectorXd::Zero(meshes()));  // nothing slides at a fixed phase
  propagate_by(seconds);
  close(position);
  take(state, position);
  Period period;
  resize(period, 1);
  try {
    for (int n = 0; n < steps; ++n) {
      step(position, nullptr);
      require_range(position, p_.head(position.size()));
      if (!record(position, 0, period)) return false;
      watch(z_.head(coordinates_.size()), p_of_slot_);
    }
  } catch (const Error& error) {
    fail_as(error, "in free motion at mesh phase ",
            static_cast<double>(i) / static_cast<double>(positions_.size() - 1), " ", error.what());
  }
  state = {z_.head(coordinates_.size()),
           v_.head(coordinates_.size()),
           relaxed_,
           p_of_slot_,
           line_load_,
           state.period};
  return true;
}

SystemDynamics::State SystemDynamics::fitted(const State& state, const SystemDynamics& of) const {
  State out = state;
  out.p = VectorXd::Zero(slots());
  out.line_load = VectorXd::Zero(points_ > 1 ? slots() : 0);
  out.relaxed = VectorXd::Zero(relaxed_size());
  const int blocks = relaxed_size() / (tooth_pairs() * kFields);
  for (int pair = std::max(first_, of.first_); pair <= std::min(last_, of.last_); ++pair) {
    for (int m = 0; m < meshes(); ++m) {
      const Index to = (static_cast<Index>(m) * tooth_pairs() + pair - first_) * points_,
                  from = (static_cast<Index>(m) * of.tooth_pairs() + pair - of.first_) * points_;
      out.p.segment(to, points_) = state.p.segment(from, points_);
      if (points_ > 1) out.line_load.segment(to, points_) = state.line_load.segment(from, points_);
    }
    for (int block = 0; block < blocks; ++block)
      out.relaxed.segment<kFields>((block * tooth_pairs() + pair - first_) * kFields) =
          state.relaxed.segment<kFields>((block * of.tooth_pairs() + pair - of.first_) * kFields);
  }
  return out;
}

double SystemDynamics::energy(const State& difference) const {
  double out = difference.v.squaredNorm();
  out += difference.z.cwiseProduct(coordinates_.frequency).squaredNorm();
  out += std::pow(motion_.axis_frequency, 2) * difference.z.head(coordinates_.rigid).squaredNorm();
  return 0.5 * out;
}

FixedPhaseMesh SystemDynamics::frozen(int i) {
  const Position& position = positions_[static_cast<size_t>(i)];
  const SystemEquilibrium rest = equilibrium_at(i, nullptr);
  std::vector<Index> active;
  for (Index k = 0; k < position.size(); ++k)
    if (rest.p[k] > 0) active.push_back(k);
  FixedPhaseMesh out;
  out.phase = static_cast<double>(i) / static_cast<double>(positions_.size() - 1);
  out.frequency_squared = coordinates_.frequency.cwiseAbs2();
  out.damping = coordinates_.damping;
  out.relaxation = relaxation_;
  out.torque = VectorXd::Zero(coordinates_.size());
  out.gap = VectorXd::Zero(static_cast<Index>(active.size()));
  out.local = (position.instantaneous_compliance + crack_at_rest(i))(active, active);
  out.residual = position.relaxed(active, active);
  if (points_ > 1) out.residual += position.uneven(active, active);
  out.participation.resize(static_cast<Index>(active.size()), coordinates_.size());
  for (Index a = 0; a < out.gap.size(); ++a) {
    const Index k = active[static_cast<size_t>(a)];
    out.local(a, a) += position.law[static_cast<size_t>(k)].at(rest.p[k]).slope;
    out.participation.row(a) = participation(position, static_cast<int>(k)).transpose();
  }
  return out;
}

SystemDynamics::FrozenModes SystemDynamics::frozen_modes(int i) {
  const FixedPhaseMesh mesh = frozen(i);
  MatrixXd stiffness =
      mesh.participation.transpose() * MatrixXd(mesh.local + mesh.residual).ldlt().solve(mesh.participation);
  stiffness.diagonal() += mesh.frequency_squared;
  const SymmetricEigen eigen = symmetric_eigen(stiffness);
  if (!eigen.converged) fail(Failure::numerical, "the frozen natural modes were not found");
  return {eigen.values.cwiseMax(0.0).cwiseSqrt() / (2 * std::numbers::pi), eigen.vectors};
}

}  // namespace whine
