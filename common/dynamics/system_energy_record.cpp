#include "dynamics/system_energy_record.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/dense.h"
#include "contact/lanes.h"
#include "dynamics/step_work.h"

namespace whine {

using namespace step_work;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SystemEnergyRecord::SystemEnergyRecord(const SystemDynamics& dynamics, EnergyBalance* balance)
    : of_(dynamics), balance_(balance) {
  if (!balance) return;
  const Index bodies = of_.coordinates_.inertia.size();
  balance->begin(of_.meshes(), bodies);
  if (of_.slides()) find_pivots();
  const SystemCoordinates& c = of_.coordinates_;
  damping_ = {c.frequency, c.damping, of_.relaxation_, of_.step_, of_.coordinates_.size()};
}

// rad s-1, in the frame of the system.
double SystemEnergyRecord::turning_speed(int gear) const {
  return 2 * std::numbers::pi * of_.mesh_frequency_ /
         of_.system_.layout.bodies[static_cast<size_t>(gear)].teeth;
}

double SystemEnergyRecord::field_at(const SystemDynamics::Position& position, int k,
                                    const VectorXd& field) const {
  const SystemDynamics::Contact& contact = position.contact[static_cast<size_t>(k)];
  double out = 0;
  for (size_t s = 0; s < 2; ++s)
    out += of_.field(position, contact, s).dot(field.segment<SystemDynamics::kFields>(contact.load_at[s]));
  return out;
}

void SystemEnergyRecord::fill(Instant& now, const SystemDynamics::Position& position) const {
  const int n = position.size();
  now.position = &position;
  now.z = of_.z_.head(of_.coordinates_.size());
  now.v = now.start = of_.v_.head(of_.coordinates_.size());
  if (of_.frame_.turns()) of_.frame_.turn(now.start);
  now.force = of_.force_.head(of_.coordinates_.size());
  now.relaxed = of_.relaxed_;
  now.load = of_.load_;
  now.live = of_.live_;
  now.rows.assign(now.live.size(), {});
  now.field.setZero(of_.relaxed_size());
  now.moved.setZero(of_.relaxed_size());
  std::vector<SystemDynamics::Live> wanted = now.live;
  for (const SystemDynamics::Contact& contact : position.contact) {
    const int pair = contact.tooth - contact.mesh * of_.tooth_pairs();
    SystemDynamics::Live& in = wanted[static_cast<size_t>(contact.mesh)];
    in = in.hull({pair, pair + 1});
  }
  displace(now, wanted);
  now.p = of_.p_.head(n);
  if (of_.slides()) fill_friction(now);
  now.local = position.instantaneous_compliance * now.p;
  if (position.crack.size() > 0) now.local += position.crack * now.p;
  now.stored = 0.5 * now.p.dot(now.local);
  if (of_.points_ > 1) {
    now.line_load = of_.line_load_;
    now.present = of_.present_line_load_;
    VectorXd own(n);
    for (int k = 0; k < n; ++k)
      own[k] = position.width[k] * now.line_load[position.contact[static_cast<size_t>(k)].slot];
    now.opening = position.uneven * own;
  }
  now.d.resize(n);
  for (int k = 0; k < n; ++k) {
    const HertzLine& law = position.law[static_cast<size_t>(k)];
    now.stored += step_work::stored(law, now.p[k]);
    now.d[k] = position.gap[k] - of_.moved(position, k, now.z) + field_at(position, k, now.field) +
               now.local[k] + step_work::at(law, now.p[k]).indentation;
    if (of_.points_ > 1) now.d[k] += now.opening[k];
  }
}

// What relaxed and present loads move, in further slots.
void SystemEnergyRecord::displace(Instant& at, const std::vector<SystemDynamics::Live>& wanted) const {
  constexpr int kFields = SystemDynamics::kFields;
  for (size_t b = 0; b < of_.coupling_.size(); ++b) {
    const Eigen::MatrixXd& c = of_.coupling_[b];
    const auto first_of = [&](size_t place, int pair) {
      return (static_cast<Index>(place) * of_.tooth_pairs() + pair) * kFields;
    };
    for (size_t place = 0; place < of_.meshes_of_[b].size(); ++place) {
      const auto m = static_cast<size_t>(of_.meshes_of_[b][place]);
      const SystemDynamics::Live known = at.rows[m], all = known.hull(wanted[m]);
      for (int pair = all.first; pair < all.last; ++pair) {
        if (pair >= known.first && pair < known.last) continue;
        const Index row = first_of(place, pair), in_all = of_.relaxed_first_[b] + row;
        for (size_t from = 0; from < of_.meshes_of_[b].size(); ++from) {
          const SystemDynamics::Live& live = at.live[static_cast<size_t>(of_.meshes_of_[b][from])];
          const Index column = first_of(from, live.first), loads = of_.relaxed_first_[b] + column;
          const int count = (live.last - live.first) * kFields;
          if (count == 0) continue;
          const auto stride = static_cast<int>(c.rows());
          add_columns_of_12(&at.field[in_all], &c(row, column), stride, &at.relaxed[loads], count);
          add_columns_of_12(&at.moved[in_all], &c(row, column), stride, &at.load[loads], count);
        }
      }
    }
  }
  for (size_t m = 0; m < wanted.size(); ++m) at.rows[m] = at.rows[m].hull(wanted[m]);
}

void SystemEnergyRecord::start(const SystemDynamics::Position& position) {
  fill(now_, position);
  first_step_ = true;
}

// Kinetic and elastic energy, dampers, drives. Result: imbalance of the modal equations under mean forces.
double SystemEnergyRecord::modes(const Instant& a, const Instant& b) {
  const SystemCoordinates& c = of_.coordinates_;
  const auto w2 = c.frequency.array().square();
  const double kinetic = 0.5 * (b.v.squaredNorm() - a.v.squaredNorm()),
               modal = 0.5 * (w2 * (b.z.array().square() - a.z.array().square())).sum();
  const auto push = 0.5 * (a.force.array() + b.force.array()) - w2 * a.z.array();
  const auto start = a.start.array();
  // Integrals of v^2; Newmark's own velocity is the mean one.
  const VectorXd squared =
      of_.motion_.fidelity.integrator == Integrator::newmark
          ? VectorXd((b.z - a.z).array().square() / of_.step_)
          : VectorXd(damping_.speed.array() * start.square() + 2 * damping_.mixed.array() * start * push +
                     damping_.push.array() * push.square());
  const double damping = (c.damping - c.of_bearing).dot(squared);
  double bearing = 0, drive = 0;
  for (Index n = 0; n < balance_->drive.size(); ++n) {
    const SystemCoordinates::Share& own = c.body[static_cast<size_t>(n)];
    double taken = c.of_bearing.segment(own.first, own.count).dot(squared.segment(own.first, own.count));
    if (own.group >= 0) {
      const SystemCoordinates::Group& group = c.group[static_cast<size_t>(own.group)];
      taken += group.member[static_cast<size_t>(own.member)].of_bearing.dot(
          squared.segment(group.first, group.count));
    }
    balance_->bearing_damping[n] += taken;
    bearing += taken;
    const int body = static_cast<int>(n);
    const double work = of_.torque(body) * (c.rotation_of(body, b.z) - c.rotation_of(body, a.z));
    if (of_.system_.layout.held(body)) continue;
    balance_->drive[n] += work;
    drive += work;
  }
  balance_->kinetic += kinetic;
  balance_->modal += modal;
  balance_->modal_damping += damping;
  balance_->throughput += std::abs(drive);
  double frame = 0;
  if (of_.frame_.turns()) {
    const TurningFrame::Work work = of_.frame_.work(a.z, b.z);
    balance_->centrifugal += work.centrifugal;
    balance_->dragging.head(work.dragging.size()) += work.dragging;
    frame = work.centrifugal + work.dragging.sum();
  }
  return kinetic + modal + damping + bearing - drive - frame;
}

// Relaxed loads F: energy F C F / 2.
double SystemEnergyRecord::relaxation(const Instant& a, const Instant& b) {
  const RelaxedWork work(damping_, of_.relaxation_ > 0, a.load, b.load, a.relaxed, a.moved, b.moved, a.field);
  return record(0.5 * (b.relaxed.dot(b.field) - a.relaxed.dot(a.field)), work.damping,
                0.5 * (a.load + b.load).dot(b.field - a.field) - work.exact);
}

double SystemEnergyRecord::record(double stored, double damping, double averaging) {
  balance_->residual += stored;
  balance_->relaxation_damping += damping;
  balance_->averaging += averaging;
  return stored + damping + averaging;
}

// Relaxed line loads g of slices, as relaxed loads: energy g E g / 2 with E = w E w between line loads p / w. In a step E is the mean of
// those at its ends; by what it differs from them the prescribed rolling works. exchange_: work of the mean line loads on what the
// relaxed ones move.
double SystemEnergyRecord::uneven(const Instant& a, const Instant& b) {
  std::vector<int> slots;
  for (const Instant* at : {&a, &b})
    for (const SystemDynamics::Contact& contact : at->position->contact)
      if (std::find(slots.begin(), slots.end(), contact.slot) == slots.end()) slots.push_back(contact.slot);
  const auto n = static_cast<Index>(slots.size());
  const auto between = [&](const Instant& at) {
    const SystemDynamics::Position& p = *at.position;
    MatrixXd out = MatrixXd::Zero(n, n);
    std::vector<Index> place;
    place.reserve(p.contact.size());
    for (const SystemDynamics::Contact& contact : p.contact)
      place.push_back(std::find(slots.begin(), slots.end(), contact.slot) - slots.begin());
    out(place, place) = p.width.asDiagonal() * p.uneven * p.width.asDiagonal();
    return out;
  };
  const MatrixXd from = between(a), to = between(b), mean = 0.5 * (from + to);
  const VectorXd old = a.line_load(slots), next = b.line_load(slots), load = a.present(slots),
                 end = b.present(slots), field = mean * old;
  const VectorXd relaxed =
      of_.relaxed_step_.decay * old + of_.relaxed_step_.from_old * load + of_.relaxed_step_.from_new * end;
  const RelaxedWork work(damping_, of_.relaxation_ > 0, load, end, old, VectorXd(mean * load),
                         VectorXd(mean * end), field);
  const VectorXd exchange = 0.5 * (load + end).cwiseProduct(mean * (relaxed - old)),
                 carried = 0.5 * (next.cwiseProduct(to * next) - old.cwiseProduct(from * old) -
                                  relaxed.cwiseProduct(mean * relaxed) + old.cwiseProduct(field));
  exchange_.setZero(of_.slots());
  carried_.setZero(of_.meshes());
  for (Index i = 0; i < n; ++i) {
    const int slot = slots[static_cast<size_t>(i)];
    exchange_[slot] = exchange[i];
    carried_[slot / (of_.tooth_pairs() * of_.points_)] += carried[i];
  }
  return record(0.5 * (next.dot(to * next) - old.dot(from * old)), work.damping, exchange.sum() - work.exact);
}

// With p . d = 0 at both ends the mean force does no work on d but where contact opens or closes within the step (switching); what
// gaps, h and W change by themselves is rolling. p . d of a solved step is booked nowhere: it is imbalance. That of the state in which
// the period starts is `dropped`. Contacts are those of one slot at both ends.
double SystemEnergyRecord::contact(const Instant& a, const Instant& b) {
  const SystemDynamics::Position &from = *a.position, &to = *b.position;
  const auto find = [](const SystemDynamics::Position& in, int slot) {
    for (int k = 0; k < in.size(); ++k)
      if (in.contact[static_cast<size_t>(k)].slot == slot) return k;
    return -1;
  };
  const bool slices = of_.points_ > 1;
  VectorXd rolled = slices ? carried_ : VectorXd::Zero(of_.meshes());
  double all = rolled.sum();
  for (int k = 0; k < from.size(); ++k) {
    const SystemDynamics::Contact& contact = from.contact[static_cast<size_t>(k)];
    const HertzLine& law = from.law[static_cast<size_t>(k)];
    const double p0 = a.p[k], old_z1 = p0 != 0 ? of_.moved(from, k, b.z) : 0;
    const int l = find(to, contact.slot);
    if (l < 0) {
      if (p0 == 0) continue;
      double cut = bent(law, p0, 0) + 0.5 * p0 * (from.gap[k] - old_z1 + field_at(from, k, b.field) - a.d[k]);
      if (slices) cut += 0.5 * p0 * a.opening[k] + exchange_[contact.slot];
      balance_->cutting[contact.mesh] += cut;
      all += cut;
      continue;
    }
    const double p1 = b.p[l];
    if (p0 == 0 && p1 == 0) continue;
    const auto [law_switching, law_rolling] = law_work(law, to.law[static_cast<size_t>(l)], p0, p1);
    const double new_z0 = of_.moved(to, l, a.z), old_z0 = of_.moved(from, k, a.z),
                 new_z1 = of_.moved(to, l, b.z), old_z1_any = of_.moved(from, k, b.z);
    double rolling = 0.5 * (p0 * (new_z1 - old_z1_any) + p1 * (new_z0 - old_z0));
    rolling -= 0.5 * (p0 * (field_at(to, l, b.field) - field_at(from, k, b.field)) +
                      p1 * (field_at(to, l, a.field) - field_at(from, k, a.field)));
    rolling -= 0.5 * (p0 + p1) * (to.gap[l] - from.gap[k]) + 0.5 * (p0 * b.local[l] - p1 * a.local[k]);
    rolling += law_rolling;
    if (slices) rolling += exchange_[contact.slot] - 0.5 * (p0 + p1) * (b.opening[l] - a.opening[k]);
    const double switching = law_switching + 0.5 * (p0 * b.d[l] - p1 * a.d[k]),
                 of_start = first_step_ ? -0.5 * p0 * a.d[k] : 0;
    rolled[contact.mesh] += rolling;
    balance_->switching[contact.mesh] += switching;
    balance_->dropped += of_start;
    all += rolling + switching + of_start;
  }
  for (int l = 0; l < to.size(); ++l) {
    const SystemDynamics::Contact& contact = to.contact[static_cast<size_t>(l)];
    const double p1 = b.p[l];
    if (p1 == 0 || find(from, contact.slot) >= 0) continue;
    double cut = bent(to.law[static_cast<size_t>(l)], 0, p1) -
                 0.5 * p1 * (to.gap[l] - of_.moved(to, l, a.z) + field_at(to, l, a.field) - b.d[l]);
    if (slices) cut += exchange_[contact.slot] - 0.5 * p1 * b.opening[l];
    balance_->cutting[contact.mesh] += cut;
    all += cut;
  }
  balance_->rolling += rolled;
  balance_->throughput += std::abs(rolled.sum());
  return all;
}

// Gears whose D the others follow from: D is along I times the rollings.
void SystemEnergyRecord::find_pivots() {
  const SystemCoordinates& c = of_.coordinates_;
  const Index rollings = c.rolling.cols();
  holding_.setZero(c.inertia.size(), rollings);
  if (rollings == 0) return;
  MatrixXd along(c.inertia.size(), rollings);
  for (Index b = 0; b < along.rows(); ++b)
    along.row(b) = c.inertia[b] / of_.radius_[static_cast<size_t>(b)] * c.rolling.row(b);
  const auto gears = static_cast<Index>(of_.system_.body.size());
  const Eigen::ColPivHouseholderQR<MatrixXd> order(along.topRows(gears).transpose());
  MatrixXd chosen(rollings, rollings);
  pivot_.reserve(static_cast<size_t>(rollings));
  for (Index i = 0; i < rollings; ++i) {
    pivot_.push_back(order.colsPermutation().indices()[i]);
    chosen.row(i) = along.row(pivot_.back());
  }
  holding_ = along * lu_solve(chosen, MatrixXd::Identity(rollings, rollings));
}

void SystemEnergyRecord::fill_friction(Instant& now) const {
  const SystemCoordinates& c = of_.coordinates_;
  now.normal = now.slide = VectorXd::Zero(c.inertia.size());
  now.sliding.setZero(of_.meshes());
  for (int k = 0; k < now.position->size(); ++k) {
    const SystemDynamics::Contact& contact = now.position->contact[static_cast<size_t>(k)];
    const double slid = of_.friction_of(contact) * now.p[k];
    for (size_t s = 0; s < 2; ++s) {
      const double radius = of_.radius_[static_cast<size_t>(contact.body[s])];
      now.normal[contact.body[s]] += now.p[k] * contact.lever[s] * radius;
      now.slide[contact.body[s]] += slid * contact.slide[s] * radius;
    }
    now.sliding[contact.mesh] += slid * contact.loss * turning_speed(contact.body[0]);
  }
  const VectorXd taken = now.v.head(c.rigid) + c.damping.head(c.rigid).cwiseProduct(now.z.head(c.rigid));
  now.momentum = c.inertia.cwiseProduct(c.rotation * taken);
}

// What friction takes, less the work of the prescribed rolling against it.
double SystemEnergyRecord::friction(const Instant& a, const Instant& b) {
  const double step = of_.step_;
  VectorXd taken = 0.5 * step * (a.sliding + b.sliding);
  for (const Instant* at : {&a, &b})
    for (int k = 0; k < at->position->size(); ++k) {
      const SystemDynamics::Contact& contact = at->position->contact[static_cast<size_t>(k)];
      if (at->p[k] == 0) continue;
      taken[contact.mesh] += 0.5 * of_.friction_of(contact) * at->p[k] *
                             of_.moved(*at->position, k, b.z - a.z, &SystemDynamics::Rows::slide);
    }
  const VectorXd slide = 0.5 * step * (a.slide + b.slide), normal = 0.5 * step * (a.normal + b.normal),
                 momentum = b.momentum - a.momentum;
  VectorXd held(static_cast<Index>(pivot_.size()));
  for (Index i = 0; i < held.size(); ++i) {
    const Index body = pivot_[static_cast<size_t>(i)];
    held[i] = momentum[body] + normal[body] + slide[body] - step * of_.torque(static_cast<int>(body));
  }
  const VectorXd holding = holding_ * held;
  double rolling = 0;
  for (int body = 0; body < static_cast<int>(of_.system_.body.size()); ++body) {
    const double against = of_.system_.layout.held(body)
                               ? slide[body]
                               : step * of_.torque(body) + holding[body] - normal[body] - momentum[body];
    rolling += turning_speed(body) * against;
  }
  balance_->friction += taken;
  balance_->friction_rolling += rolling;
  balance_->throughput += std::abs(rolling);
  return taken.sum() - rolling;
}

void SystemEnergyRecord::step(const SystemDynamics::Position& position) {
  std::swap(before_, now_);
  fill(now_, position);
  displace(now_, before_.rows);
  displace(before_, now_.rows);
  const double sections = of_.points_ > 1 ? uneven(before_, now_) : 0;  // before contact(), which needs it
  sum_ += modes(before_, now_) + relaxation(before_, now_) + sections - contact(before_, now_);
  const double local = now_.stored - before_.stored;
  balance_->local += local;
  sum_ += local;
  if (of_.slides()) sum_ += friction(before_, now_);
  first_step_ = false;
  balance_->imbalance = std::max(balance_->imbalance, std::abs(sum_));
}

// Relaxed loads of teeth that are no longer followed take their energy with them.
void SystemEnergyRecord::finish() {
  double left = 0;
  for (size_t b = 0; b < of_.coupling_.size(); ++b) {
    const int first = of_.relaxed_first_[b], size = of_.relaxed_first_[b + 1] - first;
    const auto relaxed = of_.relaxed_.segment(first, size);
    left += 0.5 * relaxed.dot(of_.coupling_[b] * relaxed);
  }
  const double lost = left - 0.5 * now_.relaxed.dot(now_.field);
  balance_->residual += lost;
  balance_->dropped += lost;
}

}  // namespace whine
