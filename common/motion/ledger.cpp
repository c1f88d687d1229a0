#include "motion/ledger.h"

#include <algorithm>
#include <cmath>

#include "motion/dynamics.h"

namespace whine {

using Eigen::VectorXd;

namespace {

// Gauss-Legendre on (0, 1).
constexpr int kPoints = 6;
constexpr double kNode[kPoints] = {0.033765242898423975, 0.16939530676686776, 0.3806904069584015,
                                   0.6193095930415985,   0.8306046932331322,  0.966234757101576};
constexpr double kWeight[kPoints] = {0.08566224618958487, 0.18038078652406947, 0.23395696728634569,
                                     0.23395696728634569, 0.18038078652406947, 0.08566224618958487};

HertzLine::Point at(const HertzLine& law, double force) {
  return force > 0 ? law.at(force) : HertzLine::Point{};
}

double stored(const HertzLine& law, double force) {  // N m
  return force * at(law, force).indentation - at(law, force).energy;
}

// N m: what a law stores from one force to another, less the mean force times the change of indentation.
double bent(double from, const HertzLine::Point& at_from, double to, const HertzLine::Point& at_to) {
  return (to * at_to.indentation - at_to.energy) - (from * at_from.indentation - at_from.energy) -
         0.5 * (from + to) * (at_to.indentation - at_from.indentation);
}
double bent(const HertzLine& law, double from, double to) {
  return bent(from, at(law, from), to, at(law, to));
}

// Calls at(t, weight) over (0, step), in panels over which nothing with the given rate (s-1) changes much.
template <class Function>
void quadrature(double step, double rate, Function at) {
  const int panels = static_cast<int>(std::clamp(std::ceil(step * rate), 1.0, 1000.0));
  for (int i = 0; i < panels; ++i)
    for (int k = 0; k < kPoints; ++k) at(step * (i + kNode[k]) / panels, step * kWeight[k] / panels);
}

// The same for what decays at that rate and then changes slowly: panels that grow from it on.
template <class Function>
void graded_quadrature(double step, double rate, Function at) {
  constexpr double kGrowth = 1.5;
  double from = 0;
  for (double width = 1 / rate; from < step; width = (kGrowth - 1) * from) {
    const double to = from + 1.01 * width < step ? from + width : step;
    for (int k = 0; k < kPoints; ++k) at(from + (to - from) * kNode[k], (to - from) * kWeight[k]);
    from = to;
  }
}

}  // namespace

RollingDynamics::DampingIntegrals RollingDynamics::damping_integrals() const {
  DampingIntegrals result;
  const int n = static_cast<int>(coordinates_.size());
  result.speed = result.mixed = result.push = VectorXd::Zero(padded(n));
  for (int c = 0; c < n; ++c) {
    const double frequency = coordinates_[c].frequency, damping = coordinates_[c].damping;
    if (c > 0 && frequency == coordinates_[c - 1].frequency && damping == coordinates_[c - 1].damping) {
      for (VectorXd* x : {&result.speed, &result.mixed, &result.push}) (*x)[c] = (*x)[c - 1];
      continue;
    }
    const auto add = [&](double t, double weight) {
      const Propagator part = exact_propagator(frequency, damping, t);
      result.speed[c] += weight * part.a22 * part.a22;
      result.mixed[c] += weight * part.a22 * part.bv;
      result.push[c] += weight * part.bv * part.bv;
    };
    // Every mode of a mesh: most of them are overdamped a thousandfold.
    if (damping > 4 * frequency)
      graded_quadrature(step_, frequency + damping, add);
    else
      quadrature(step_, frequency + damping, add);
  }
  const double eta = relaxation();
  if (eta > 0)
    quadrature(step_, 1 / eta, [&](double t, double weight) {
      const double decay = std::exp(-t / eta), growth = -(eta / step_) * std::expm1(-t / eta);
      result.decay2 += weight * decay * decay / eta;
      result.mixed2 += weight * decay * growth / eta;
      result.growth2 += weight * growth * growth / eta;
      result.decay += weight * decay / eta;
      result.growth += weight * growth / eta;
      result.late_decay += weight * t / step_ * decay / eta;
      result.late_growth += weight * t / step_ * growth / eta;
    });
  return result;
}

void RollingDynamics::displace_locally(const Position& position, const double* p, VectorXd& result) const {
  const int strips = position.mesh.strips();
  if (lines()) {
    result.head(strips).noalias() = position.at_once.lazyProduct(Eigen::Map<const VectorXd>(p, strips));
    return;
  }
  result.head(strips).setZero();
  alignas(Lanes) double nodes[kPairNodes * kMostPairs];
  strip_compliance(position, &stream_[position.frame.at_once]).add_product(p, nodes, result.data());
}

// The instant that the workspace holds; p, d: (strip). What lagged loads displace goes on from the instant before as the lag
// itself does; without one it is computed anew.
void RollingDynamics::fill(Instant& now, const Instant* before, const Position& position, const double* p,
                           const double* d) const {
  const int strips = position.mesh.strips(), of_gear = all_fields();
  now.position = &position;
  now.renamed = 0;
  now.forgotten = now.stored_forgotten = 0;
  now.z = work_.z;
  now.v = work_.v;
  now.force = work_.force;
  now.lag = work_.lag;
  now.load = work_.load;
  for (int g = 0; g < 2; ++g) displace(g, &now.load[g * of_gear], &now.moved_load[g * of_gear]);
  for (int k = 0; before && k < 2 * of_gear; k += kLanes)
    lanes(&now.field[k]) = lag_.decay * lanes(&before->field[k]) +
                           lag_.from_old * lanes(&before->moved_load[k]) +
                           lag_.from_new * lanes(&now.moved_load[k]);
  for (int g = 0; !before && g < 2; ++g) displace(g, &now.lag[g * of_gear], &now.field[g * of_gear]);
  std::copy(p, p + strips, now.p.data());
  std::copy(d, d + strips, now.d.data());
  displace_locally(position, now.p.data(), now.local);
  alignas(Lanes) double unused[2 * kFields];
  for (size_t j = 0; j < position.mesh.pairs.size(); ++j) {
    lanes(&now.moment[j * kLanes]) = collect(position, j, p + position.mesh.first_strip[j], unused);
    lanes(&now.reading[j * kLanes]) = reading(position, j, now.z.data());
  }
  now.at_once = 0.5 * now.p.head(strips).dot(now.local.head(strips));
  for (size_t j = 0; j < position.mesh.law.size(); ++j) now.at_once += stored(position.mesh.law[j], p[j]);
}

// Teeth get the names that they have in the next mesh period. One of each gear is no longer followed.
void RollingDynamics::rename(Instant& now) const {
  const int of_gear = all_fields(), of_tooth = kFields;
  for (double* y : {now.z.data(), now.v.data(), now.force.data()}) turn_doublets(y);
  now.stored_forgotten = -0.5 * now.lag.dot(now.field);
  now.forgotten = 0;
  // The load of a tooth that goes under load: a corner rule has then taken its pair out.
  for (int g = 0; g < 2; ++g) {
    const int last = (g + 1) * of_gear - of_tooth;
    now.forgotten += 0.5 * now.load.segment(last, of_tooth).dot(now.field.segment(last, of_tooth));
  }
  now.forgotten_field = now.field;
  for (double* x : {now.lag.data(), now.load.data(), now.forgotten_field.data()}) advance_fields(x);
  for (int g = 0; g < 2; ++g) {
    displace(g, &now.lag[g * of_gear], &now.field[g * of_gear]);
    displace(g, &now.load[g * of_gear], &now.moved_load[g * of_gear]);
  }
  now.stored_forgotten += 0.5 * now.lag.dot(now.field);
  now.forgotten += now.stored_forgotten;
  now.forgotten_field -= now.field;
  now.renamed = 1;
}

// With d = e - h z + U + A p and p . d = 0 at both ends, (p_n + p_n+1)/2 . (d_n+1 - d_n) is the switching line, and what
// the mean forces do on modes, lag and all that follows at once comes term by term; products of an old force with a new
// shape are the work of the rolling. A pair that a corner rule takes out under load keeps its last geometry for the
// step, one that it lets in has its first: the gap there is the cutting line.
//
// A line's law u(p) with the energy E = integral of u over p stores p u - E. While it is held, mean force times change of
// u is not the change of what it stores, because it is bent: that difference, mean over the laws of both ends, goes to
// the switching line, or to the cutting line where a pair is cut. The law's change with the phase is rolling:
// -(E_n+1 - E_n) at a held force, mean over both forces, and, as in the products above, a quarter of the change of force
// times the change of u_n+1 - u_n over it.
//
// Force on modes and on the lag goes through a pair's shape rows and fields: p . h z = moment . reading, p . U = share of p
// in the fields . their displacement.
void RollingDynamics::record_step(const Instant& a, const Instant& b, Ledger& ledger) {
  const MeshPosition &old_mesh = a.position->mesh, &new_mesh = b.position->mesh;
  const int of_gear = all_fields(), of_tooth = kFields, coordinates = static_cast<int>(a.z.size());
  double rolling = 0, switching = 0, cutting = 0, forgetting = a.forgotten;
  const bool lines = this->lines();

  const double* old_z = b.z.data();  // of the new instant, in the names of the old position
  if (a.renamed) {
    ledger_work_.turned_back = b.z;
    turn_doublets(ledger_work_.turned_back.data(), -1);
    old_z = ledger_work_.turned_back.data();
  }
  // J: shares of a force in fields (driver's, then driven gear's) on the displacement of a tooth.
  const auto shares_on = [&](const double* shares, const VectorXd& field, int slot) {
    double work = 0;
    for (int g = 0; g < 2; ++g)
      work += dot(shares + g * of_tooth, &field[g * of_gear + slot * of_tooth], 0, of_tooth);
    return work;
  };
  const auto load_on = [&](const VectorXd& load, const VectorXd& field, int slot) {
    double work = 0;
    for (int g = 0; g < 2; ++g) {
      const int at = g * of_gear + slot * of_tooth;
      work += dot(&load[at], &field[at], 0, of_tooth);
    }
    return work;
  };
  alignas(Lanes) double old_on_new[2 * kFields], new_on_old[2 * kFields];
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
    const Lanes moment00 = lanes(&a.moment[i * kLanes]), read_old_new = reading(*a.position, i, old_z);
    if (a.renamed && followed) forgetting += 0.5 * load_on(a.load, a.forgotten_field, slot);
    if (j == new_mesh.pairs.size()) {
      if (lines) cutting += bent(old_mesh.law[i], p0[0], 0);
      cutting += 0.5 * (p0.dot(gap0) - sum(moment00 * read_old_new));
      if (followed) cutting += 0.5 * load_on(a.load, b.field, slot);
      continue;
    }
    const int to = new_mesh.first_strip[j], n = new_mesh.pairs[j].size();
    const auto p1 = b.p.segment(to, n);
    const auto gap1 = new_mesh.gap.segment(to, n);
    if (lines) {
      const HertzLine &law0 = old_mesh.law[i], &law1 = new_mesh.law[j];
      const HertzLine::Point old0 = at(law0, p0[0]), old1 = at(law0, p1[0]), new0 = at(law1, p0[0]),
                             new1 = at(law1, p1[0]);
      switching += 0.5 * (bent(p0[0], old0, p1[0], old1) + bent(p0[0], new0, p1[0], new1));
      rolling -= 0.5 * (new0.energy - old0.energy + new1.energy - old1.energy) -
                 0.25 * (p1[0] - p0[0]) *
                     (new1.indentation - old1.indentation - (new0.indentation - old0.indentation));
    }
    switching += 0.5 * (p0.dot(b.d.segment(to, n)) - p1.dot(a.d.segment(from, n)));
    rolling -= 0.5 * ((p0 + p1).dot(gap1 - gap0) + p0.dot(b.local.segment(to, n)) -
                      p1.dot(a.local.segment(from, n)));
    const Lanes moment01 = collect(*b.position, j, p0.data(), old_on_new),
                moment10 = collect(*a.position, i, p1.data(), new_on_old);
    rolling += 0.5 * sum(moment01 * lanes(&b.reading[j * kLanes]) - moment10 * lanes(&a.reading[i * kLanes]) +
                         lanes(&b.moment[j * kLanes]) * reading(*b.position, j, a.z.data()) -
                         moment00 * read_old_new);
    rolling -= 0.5 * (shares_on(old_on_new, b.field, slot) - shares_on(new_on_old, a.field, slot) +
                      load_on(b.load, a.field, slot) - load_on(a.load, b.field, slot));
    if (a.renamed) forgetting += 0.5 * shares_on(new_on_old, a.forgotten_field, slot);
  }
  for (size_t j = 0; j < new_mesh.pairs.size(); ++j)
    if (!(met >> j & 1)) {
      const int to = new_mesh.first_strip[j], n = new_mesh.pairs[j].size();
      if (lines) cutting += bent(new_mesh.law[j], 0, b.p[to]);
      cutting -= 0.5 * (b.p.segment(to, n).dot(new_mesh.gap.segment(to, n)) -
                        sum(lanes(&b.moment[j * kLanes]) * reading(*b.position, j, a.z.data())) +
                        load_on(b.load, a.field, new_mesh.pairs[j].pair + reach_));
    }
  const double local = b.at_once - a.at_once;

  // Modes: force = torque - h^T p.
  Lanes torque_sum{}, kinetic_sum{}, modal_sum{}, damping_sum{};
  for (int c = 0; c < coordinates; c += kLanes) {
    const Lanes z0 = lanes(&a.z[c]), z1 = lanes(&b.z[c]), v0 = lanes(&a.v[c]), v1 = lanes(&b.v[c]),
                w2 = lanes(&ledger_work_.frequency_squared[c]), rate = lanes(&ledger_work_.damping[c]);
    torque_sum += lanes(&work_.torque[c]) * (z1 - z0);
    kinetic_sum += v1 * v1 - v0 * v0;
    modal_sum += w2 * (z1 * z1 - z0 * z0);
    if (newmark_) {
      const Lanes v = 0.5 * (v0 + v1);  // the trapezoidal rule's own velocity
      damping_sum += rate * (step_ * v * v);
    } else {
      const Lanes push = 0.5 * (lanes(&a.force[c]) + lanes(&b.force[c])) - w2 * z0;
      damping_sum += rate * (lanes(&damping_.speed[c]) * v0 * v0 + 2 * lanes(&damping_.mixed[c]) * v0 * push +
                             lanes(&damping_.push[c]) * push * push);
    }
  }
  const double torque = sum(torque_sum), kinetic = 0.5 * sum(kinetic_sum), modal = 0.5 * sum(modal_sum),
               modal_damping = sum(damping_sum);

  // Lag: eta G' + G = g, energy G R G / 2, dissipation eta G' R G', g linear in the step.
  Lanes stored1{}, stored0{}, mean{}, behind2{}, behind_change{}, change2{}, load_behind{}, load_change{},
      change_behind{}, mean_change{};
  for (int k = 0; k < 2 * of_gear; k += kLanes) {
    const Lanes load0 = lanes(&a.load[k]), load1 = lanes(&b.load[k]), lag0 = lanes(&a.lag[k]),
                field0 = lanes(&a.field[k]), field1 = lanes(&b.field[k]), moved0 = lanes(&a.moved_load[k]),
                change = load1 - load0, moved_change = lanes(&b.moved_load[k]) - moved0,
                behind = load0 - lag0, moved_behind = moved0 - field0;
    stored1 += lanes(&b.lag[k]) * field1;
    stored0 += lag0 * field0;
    mean += (load0 + load1) * (field1 - field0);
    behind2 += behind * moved_behind;
    behind_change += behind * moved_change;
    change2 += change * moved_change;
    load_behind += load0 * moved_behind;
    load_change += load0 * moved_change;
    change_behind += change * moved_behind;
    mean_change += (load0 + load1) * moved_change;
  }
  double lag_damping = 0, exact = 0.5 * sum(mean_change);
  if (relaxation() > 0) {
    lag_damping = damping_.decay2 * sum(behind2) + 2 * damping_.mixed2 * sum(behind_change) +
                  damping_.growth2 * sum(change2);
    exact = damping_.decay * sum(load_behind) + damping_.growth * sum(load_change) +
            damping_.late_decay * sum(change_behind) + damping_.late_growth * sum(change2);
  }
  const double averaging = 0.5 * sum(mean) - exact;
  const double residual = 0.5 * (sum(stored1) - sum(stored0)) + a.stored_forgotten;

  ledger.kinetic += kinetic;
  ledger.modal += modal;
  ledger.residual += residual;
  ledger.local += local;
  ledger.torque += torque;
  ledger.rolling += rolling;
  ledger.modal_damping += modal_damping;
  ledger.lag_damping += lag_damping;
  ledger.switching += switching;
  ledger.cutting += cutting;
  ledger.averaging += averaging;
  ledger.forgetting += forgetting;
  ledger.throughput += std::abs(torque) + std::abs(rolling);
  double& balance = ledger_work_.balance;
  balance += kinetic + modal + residual + local + modal_damping + lag_damping - torque - rolling - switching -
             cutting - forgetting + averaging;
  ledger.imbalance = std::max(ledger.imbalance, std::abs(balance));
}

}  // namespace whine
