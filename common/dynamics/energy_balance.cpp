#include "dynamics/energy_balance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "dynamics/dynamics.h"
#include "dynamics/step_work.h"
#include "results/sweep.h"

namespace whine {

using namespace step_work;

using Eigen::Index;
using Eigen::Matrix4Xd;
using Eigen::Vector4d;
using Eigen::VectorXd;

void EnergyBalance::begin(Index meshes, Index bodies) {
  if (rolling.size() == meshes && drive.size() == bodies) return;
  *this = {};
  for (VectorXd* x : {&drive, &dragging, &bearing_damping}) x->setZero(bodies);
  for (VectorXd* x : {&rolling, &switching, &cutting, &friction}) x->setZero(meshes);
}

double EnergyBalance::left_over() const {
  return storage() + modal_damping + bearing_damping.sum() + relaxation_damping + friction.sum() -
         drive.sum() - rolling.sum() - friction_rolling - centrifugal - dragging.sum() - switching.sum() -
         cutting.sum() - dropped + averaging;
}

Eigen::RowVectorXd EnergyBalance::lines() const {
  Eigen::RowVectorXd out(static_cast<Index>(kEnergyLines.size()));
  out << kinetic, modal, residual, local, drive.sum(), rolling.sum(), friction_rolling,
      centrifugal + dragging.sum(), modal_damping, bearing_damping.sum(), relaxation_damping, friction.sum(),
      switching.sum(), cutting.sum(), averaging, dropped, throughput;  // kEnergyLines
  return out;
}

step_work::DampingIntegrals RollingDynamics::damping_integrals() const {
  const auto n = static_cast<Index>(coordinates_.size());
  VectorXd frequency(n), damping(n);
  for (Index c = 0; c < n; ++c) {
    frequency[c] = coordinates_[static_cast<size_t>(c)].frequency;
    damping[c] = coordinates_[static_cast<size_t>(c)].damping;
  }
  return {frequency, damping, relaxation(), step_, padded(static_cast<int>(n))};
}

void RollingDynamics::size_energy_balance() {
  const int coordinates = kernel_.coordinates(), fields = StepKernel::kSides * kernel_.fields(),
            own = static_cast<int>(coordinates_.size());
  int strips = kMostPairs, pairs = 1;
  for (const Position& position : positions_) {
    strips = std::max(strips, position.mesh.strips());
    pairs = std::max(pairs, static_cast<int>(position.mesh.pairs.size()));
  }
  EnergyBalanceWorkspace& l = balance_work_;
  for (Instant& instant : l.instants) {
    for (VectorXd* x : {&instant.at.z, &instant.at.v, &instant.at.force, &instant.friction})
      x->setZero(coordinates);
    for (VectorXd* x :
         {&instant.at.relaxed, &instant.at.load, &instant.field, &instant.moved_load, &instant.dropped_field})
      x->setZero(fields);
    for (VectorXd* x : {&instant.p, &instant.d, &instant.local}) x->setZero(strips);
    for (Matrix4Xd* x : {&instant.shape_force, &instant.shape_displacement}) x->setZero(4, pairs);
  }
  for (VectorXd* x : {&l.turned_back, &l.frequency_squared, &l.damping, &l.torque}) x->setZero(coordinates);
  l.frequency_squared.head(own) = frequency_squared_;
  l.torque.head(own) = torque_force_;
  for (int i = 0; i < own; ++i) l.damping[i] = coordinates_[i].damping;
}

void RollingDynamics::displace_locally(int i, const double* p, VectorXd& result) const {
  const Position& position = positions_[i];
  const int strips = position.mesh.strips();
  if (lines()) {
    result.head(strips).noalias() =
        position.instantaneous_compliance.lazyProduct(Eigen::Map<const VectorXd>(p, strips));
    return;
  }
  result.head(strips).setZero();
  double nodes[StepKernel::kPairNodes * kMostPairs];
  kernel_.instantaneous_compliance(i).add_product(p, nodes, result.data());
}

// The instant that the workspace holds; p, d: (strip). What relaxed loads displace goes on from the instant before as the
// relaxed load itself
//  does; without one it is computed anew.
void RollingDynamics::fill(Instant& now, const Instant* before, int position, const double* p,
                           const double* d) const {
  const MeshPosition& mesh = positions_[position].mesh;
  const int strips = mesh.strips(), of_gear = kernel_.fields();
  const Relaxation& relaxed = kernel_.relaxed();
  now.position = position;
  now.renamed = 0;
  now.dropped = now.stored_dropped = 0;
  now.at = kernel_.vectors();
  for (int g = 0; g < StepKernel::kSides; ++g)
    kernel_.displace(g, &now.at.load[g * of_gear], &now.moved_load[g * of_gear]);
  if (before)
    now.field = relaxed.decay * before->field + relaxed.from_old * before->moved_load +
                relaxed.from_new * now.moved_load;
  for (int g = 0; !before && g < StepKernel::kSides; ++g)
    kernel_.displace(g, &now.at.relaxed[g * of_gear], &now.field[g * of_gear]);
  std::copy(p, p + strips, now.p.data());
  std::copy(d, d + strips, now.d.data());
  displace_locally(position, now.p.data(), now.local);
  double unused[StepKernel::kSides * StepKernel::kFields];
  for (size_t j = 0; j < mesh.pairs.size(); ++j) {
    const auto pair = static_cast<int>(j);
    now.shape_force.col(pair) = kernel_.collect(position, pair, p + mesh.first_strip[j], unused);
    now.shape_displacement.col(pair) = kernel_.reading(position, pair, now.at.z.data());
  }
  if (friction_ > 0) fill_friction(now);
  now.instantaneous_energy = 0.5 * now.p.head(strips).dot(now.local.head(strips));
  for (size_t j = 0; j < mesh.law.size(); ++j) now.instantaneous_energy += stored(mesh.law[j], p[j]);
}

double RollingDynamics::driver_speed() const {
  return 2 * std::numbers::pi / (step_ * steps_ * model_.kinematics.gear(0).design().teeth);
}

// rename() leaves these alone: doublets, which turn with their gear, have neither hub nor friction.
void RollingDynamics::fill_friction(Instant& now) const {
  const Position& position = positions_[now.position];
  const PositionLevers& corners = corners_[now.position];
  now.friction.setZero();
  now.sliding_power = now.driver_moment = now.corner_power = 0;
  const double speed = driver_speed(), radius = model_.kinematics.gear(0).base_radius();
  for (size_t j = 0; j < position.mesh.pairs.size(); ++j) {
    const auto pair = static_cast<Eigen::Index>(j);
    const int first = position.mesh.first_strip[j];
    const double force = now.p.segment(first, position.mesh.first_strip[j + 1] - first).sum();
    now.friction.head(position.friction.cols()) +=
        friction_ * force * position.friction.row(pair).transpose();
    now.sliding_power += friction_ * force * position.sliding_loss[pair] * speed;
    now.driver_moment += force * (corners.driver_lever[j] + friction_ * corners.driver_across[j]);
    now.corner_power += force * corners.drift_lever[j] * radius * speed;
  }
}

// Of the nominal rolling against friction, from torques and angular momentum; see energy_balance.h. Elastic modes have no
// angular momentum of their own: it is that of the rigid rotation, whose damper takes c z off it.
double RollingDynamics::torque_on_rolling(const Instant& a, const Instant& b) const {
  const Coordinate& rigid = coordinates_[0];
  const double ratio = model_.kinematics.gear(0).base_radius() / model_.kinematics.gear(1).base_radius(),
               speed = driver_speed(), torque = parameters_.torque,
               momentum = parameters_.inertia[0] * rigid.hub[0] *
                          (b.at.v[0] - a.at.v[0] + rigid.damping * (b.at.z[0] - a.at.z[0])),
               held = momentum + step_ * (0.5 * (a.driver_moment + b.driver_moment) - torque),
               both = 1 + parameters_.inertia[1] / parameters_.inertia[0] * ratio * ratio;
  const double between = step_ * torque * parameters_.loss_per_friction * friction_;  // T_1 - T_2 r_b1 / r_b2
  return speed * (between + held * both) - 0.5 * step_ * (a.corner_power + b.corner_power);
}

double RollingDynamics::record_friction(const Instant& a, const Instant& b,
                                        EnergyBalance& energy_balance) const {
  const double sliding = 0.5 * step_ * (a.sliding_power + b.sliding_power),
               vibration = 0.5 * (a.friction + b.friction).dot(b.at.z - a.at.z),
               rolling = torque_on_rolling(a, b);
  energy_balance.friction[0] += sliding + vibration;
  energy_balance.friction_rolling += rolling;
  energy_balance.throughput += std::abs(rolling);
  return sliding + vibration - rolling;
}

// Teeth get the names that they have in the next mesh period. One of each gear is no longer followed.
void RollingDynamics::rename(Instant& now) const {
  const int of_gear = kernel_.fields(), of_tooth = StepKernel::kFields;
  StepKernel::Vectors& at = now.at;
  for (double* y : {at.z.data(), at.v.data(), at.force.data()}) kernel_.turn_doublets(y);
  now.stored_dropped = -0.5 * at.relaxed.dot(now.field);
  now.dropped = 0;
  // The load of a tooth that goes under load: a corner rule has then taken its pair out.
  for (int g = 0; g < StepKernel::kSides; ++g) {
    const int last = (g + 1) * of_gear - of_tooth;
    now.dropped += 0.5 * at.load.segment(last, of_tooth).dot(now.field.segment(last, of_tooth));
  }
  now.dropped_field = now.field;
  for (double* x : {at.relaxed.data(), at.load.data(), now.dropped_field.data()}) kernel_.advance_fields(x);
  for (int g = 0; g < StepKernel::kSides; ++g) {
    kernel_.displace(g, &at.relaxed[g * of_gear], &now.field[g * of_gear]);
    kernel_.displace(g, &at.load[g * of_gear], &now.moved_load[g * of_gear]);
  }
  now.stored_dropped += 0.5 * at.relaxed.dot(now.field);
  now.dropped += now.stored_dropped;
  now.dropped_field -= now.field;
  now.renamed = 1;
}

// With d = e - h z + U + A p and p . d = 0 at both ends, (p_n + p_n+1)/2 . (d_n+1 - d_n) is the switching line, and what
// the mean forces do on modes, relaxed loads and all that is instantaneous comes term by term; products of an old force with a
// new shape are the work of the rolling. A pair that a corner rule takes out under load keeps its last geometry for the
// step, one that it lets in has its first: the gap there is the cutting line.
//
// A line's law u(p) with the energy E = integral of u over p stores p u - E. While it is held, mean force times change of
// u is not the change of what it stores, because it is bent: that difference, mean over the laws of both ends, goes to
// the switching line, or to the cutting line where a pair is cut. The law's change with the phase is rolling:
// -(E_n+1 - E_n) at a held force, mean over both forces, and, as in the products above, a quarter of the change of force
// times the change of u_n+1 - u_n over it.
//
// Force on modes and on the relaxed loads goes through a pair's shape rows and fields: p . h z = shape_force . shape_displacement, p . U =
// share of p in the fields . their displacement.
double RollingDynamics::field_work(const double* shares, int apart, const VectorXd& field, int slot) const {
  constexpr int kFields = StepKernel::kFields;
  double work = 0;
  for (int g = 0; g < StepKernel::kSides; ++g)
    work += Eigen::Matrix<double, kFields, 1>::Map(shares + g * apart)
                .dot(field.segment<kFields>(g * kernel_.fields() + slot * kFields));
  return work;
}

RollingDynamics::ContactWork RollingDynamics::contact_work(const Instant& a, const Instant& b) {
  const MeshPosition &old_mesh = positions_[a.position].mesh, &new_mesh = positions_[b.position].mesh;
  constexpr int of_tooth = StepKernel::kFields;
  ContactWork work;
  work.dropped = a.dropped;
  const bool lines = this->lines();
  const double* old_z = b.at.z.data();  // of the new instant, in the names of the old position
  if (a.renamed) {
    balance_work_.turned_back = b.at.z;
    kernel_.turn_doublets(balance_work_.turned_back.data(), -1);
    old_z = balance_work_.turned_back.data();
  }
  const auto shares_on = [&](const double* shares, const VectorXd& field, int slot) {
    return field_work(shares, of_tooth, field, slot);
  };
  const auto load_on = [&](const VectorXd& load, const VectorXd& field, int slot) {
    return field_work(&load[slot * of_tooth], kernel_.fields(), field, slot);
  };
  double old_on_new[StepKernel::kSides * of_tooth], new_on_old[StepKernel::kSides * of_tooth];
  unsigned met = 0;
  for (size_t i = 0; i < old_mesh.pairs.size(); ++i) {
    const int pair = old_mesh.pairs[i].pair + a.renamed, slot = pair + reach_, from = old_mesh.first_strip[i];
    const bool followed = slot <= 2 * reach_;
    const auto p0 = a.p.segment(from, old_mesh.pairs[i].size());
    const auto gap0 = old_mesh.gap.segment(from, old_mesh.pairs[i].size());
    size_t j = 0;
    while (j < new_mesh.pairs.size() && new_mesh.pairs[j].pair != pair) ++j;
    if (j < new_mesh.pairs.size()) {
      met |= 1u << j;
      const int to = new_mesh.first_strip[j];
      if (p0.isZero(0) && b.p.segment(to, new_mesh.pairs[j].size()).isZero(0)) continue;  // no force, no work
    }
    const auto old_pair = static_cast<int>(i), new_pair = static_cast<int>(j);
    const Vector4d force00 = a.shape_force.col(old_pair),
                   read_old_new = kernel_.reading(a.position, old_pair, old_z);
    if (a.renamed && followed) work.dropped += 0.5 * load_on(a.at.load, a.dropped_field, slot);
    if (j == new_mesh.pairs.size()) {
      if (lines) work.cutting += bent(old_mesh.law[i], p0[0], 0);
      work.cutting += 0.5 * (p0.dot(gap0) - force00.dot(read_old_new));
      if (followed) work.cutting += 0.5 * load_on(a.at.load, b.field, slot);
      continue;
    }
    const int to = new_mesh.first_strip[j], n = new_mesh.pairs[j].size();
    const auto p1 = b.p.segment(to, n);
    const auto gap1 = new_mesh.gap.segment(to, n);
    if (lines) {
      const auto [switching, rolling] = law_work(old_mesh.law[i], new_mesh.law[j], p0[0], p1[0]);
      work.switching += switching;
      work.rolling += rolling;
    }
    work.switching += 0.5 * (p0.dot(b.d.segment(to, n)) - p1.dot(a.d.segment(from, n)));
    work.rolling -= 0.5 * ((p0 + p1).dot(gap1 - gap0) + p0.dot(b.local.segment(to, n)) -
                           p1.dot(a.local.segment(from, n)));
    const Vector4d moment01 = kernel_.collect(b.position, new_pair, p0.data(), old_on_new),
                   moment10 = kernel_.collect(a.position, old_pair, p1.data(), new_on_old),
                   read_new_old = kernel_.reading(b.position, new_pair, a.at.z.data());
    work.rolling +=
        0.5 * (moment01.cwiseProduct(b.shape_displacement.col(new_pair)) -
               moment10.cwiseProduct(a.shape_displacement.col(old_pair)) +
               b.shape_force.col(new_pair).cwiseProduct(read_new_old) - force00.cwiseProduct(read_old_new))
                  .sum();
    work.rolling -= 0.5 * (shares_on(old_on_new, b.field, slot) - shares_on(new_on_old, a.field, slot) +
                           load_on(b.at.load, a.field, slot) - load_on(a.at.load, b.field, slot));
    if (a.renamed) work.dropped += 0.5 * shares_on(new_on_old, a.dropped_field, slot);
  }
  for (size_t j = 0; j < new_mesh.pairs.size(); ++j)
    if (!(met >> j & 1)) {
      const int to = new_mesh.first_strip[j], n = new_mesh.pairs[j].size(), new_pair = static_cast<int>(j);
      if (lines) work.cutting += bent(new_mesh.law[j], 0, b.p[to]);
      work.cutting -=
          0.5 * (b.p.segment(to, n).dot(new_mesh.gap.segment(to, n)) -
                 b.shape_force.col(new_pair).dot(kernel_.reading(b.position, new_pair, a.at.z.data())) +
                 load_on(b.at.load, a.field, new_mesh.pairs[j].pair + reach_));
    }
  return work;
}

// Force = torque - h^T p.
RollingDynamics::ModalWork RollingDynamics::modal_work(const Instant& a, const Instant& b) const {
  const auto z0 = a.at.z.array(), z1 = b.at.z.array(), v0 = a.at.v.array(), v1 = b.at.v.array(),
             w2 = balance_work_.frequency_squared.array(), rate = balance_work_.damping.array();
  ModalWork work;
  work.torque = (balance_work_.torque.array() * (z1 - z0)).sum();
  work.kinetic = 0.5 * (v1 * v1 - v0 * v0).sum();
  work.modal = 0.5 * (w2 * (z1 * z1 - z0 * z0)).sum();
  if (newmark_) {  // the trapezoidal rule's own velocity
    work.damping = step_ * (rate * (0.5 * (v0 + v1)).square()).sum();
  } else {
    const auto push = 0.5 * (a.at.force.array() + b.at.force.array()) - w2 * z0;
    work.damping = (rate * (damping_.speed.array() * v0 * v0 + 2 * damping_.mixed.array() * v0 * push +
                            damping_.push.array() * push * push))
                       .sum();
  }
  return work;
}

// Energy G R G / 2 of the relaxed loads G.
RollingDynamics::RelaxationWork RollingDynamics::relaxation_work(const Instant& a, const Instant& b) const {
  const RelaxedWork work(damping_, relaxation() > 0, a.at.load, b.at.load, a.at.relaxed, a.moved_load,
                         b.moved_load, a.field);
  return {0.5 * (b.at.relaxed.dot(b.field) - a.at.relaxed.dot(a.field)) + a.stored_dropped, work.damping,
          0.5 * (a.at.load + b.at.load).dot(b.field - a.field) - work.exact};
}

void RollingDynamics::record_step(const Instant& a, const Instant& b, EnergyBalance& energy_balance) {
  const ContactWork contact = contact_work(a, b);
  const ModalWork modes = modal_work(a, b);
  const RelaxationWork relaxed = relaxation_work(a, b);
  const double local = b.instantaneous_energy - a.instantaneous_energy;
  energy_balance.kinetic += modes.kinetic;
  energy_balance.modal += modes.modal;
  energy_balance.residual += relaxed.residual;
  energy_balance.local += local;
  energy_balance.drive[0] += modes.torque;
  energy_balance.rolling[0] += contact.rolling;
  energy_balance.modal_damping += modes.damping;
  energy_balance.relaxation_damping += relaxed.damping;
  energy_balance.switching[0] += contact.switching;
  energy_balance.cutting[0] += contact.cutting;
  energy_balance.averaging += relaxed.averaging;
  energy_balance.dropped += contact.dropped;
  energy_balance.throughput += std::abs(modes.torque) + std::abs(contact.rolling);
  double& balance = balance_work_.balance;
  if (friction_ > 0) balance += record_friction(a, b, energy_balance);
  balance += modes.kinetic + modes.modal + relaxed.residual + local + modes.damping + relaxed.damping -
             modes.torque - contact.rolling - contact.switching - contact.cutting - contact.dropped +
             relaxed.averaging;
  energy_balance.imbalance = std::max(energy_balance.imbalance, std::abs(balance));
}

}  // namespace whine
