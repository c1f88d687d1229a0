#include "motion/ledger.h"

#include <algorithm>
#include <cmath>

#include "motion/dynamics.h"

namespace whine {

using Eigen::MatrixXd;
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
double bent(const HertzLine& law, double from, double to) {
  return stored(law, to) - stored(law, from) -
         0.5 * (from + to) * (at(law, to).indentation - at(law, from).indentation);
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
  result.speed = result.mixed = result.push = VectorXd::Zero(n);
  for (int c = 0; c < n; ++c) {
    const double frequency = coordinates_[c].frequency, damping = coordinates_[c].damping;
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

void RollingDynamics::fill(Instant& now, const Position& position, const State& state) const {
  const MeshPosition& mesh = position.mesh;
  now.position = &position;
  now.renamed = 0;
  now.state = state;
  now.modal = mesh.to_strips(position.participation * state.z);
  VectorXd nodes = VectorXd::Zero(mesh.nodes());
  for (int g = 0; g < 2; ++g) {
    now.field[g].resizeLike(state.lag[g]);
    now.field[g].reshaped() = coupling_[g] * state.lag[g].reshaped();
    for (size_t j = 0; j < mesh.pairs.size(); ++j)
      nodes(mesh.nodes_of(j)) += position.field_weight[g](mesh.nodes_of(j), Eigen::all) *
                                 now.field[g].col(mesh.pairs[j].pair + reach_);
  }
  now.lagged = mesh.to_strips(nodes);
  nodes = mesh.to_nodes(state.p);
  now.pair_force.resize(state.z.size(), mesh.pairs.size());
  for (size_t j = 0; j < mesh.pairs.size(); ++j)
    now.pair_force.col(j) =
        position.participation(mesh.nodes_of(j), Eigen::all).transpose() * nodes(mesh.nodes_of(j));
}

// Teeth get the names that they have in the next mesh period.
void RollingDynamics::rename(Instant& instant) const {
  advance_tooth(instant.state);
  for (int j = 0; j < instant.pair_force.cols(); ++j) turn_doublets(instant.pair_force.col(j));
  for (int g = 0; g < 2; ++g) instant.field[g].reshaped() = coupling_[g] * instant.state.lag[g].reshaped();
  instant.renamed = 1;
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
void RollingDynamics::record_step(const Instant& before, const Instant& after, double& balance,
                                  Ledger& ledger) const {
  const State &a = before.state, &b = after.state;
  const MeshPosition &old_mesh = before.position->mesh, &new_mesh = after.position->mesh;
  double rolling = 0, switching = 0, cutting = 0;
  const bool lines = this->lines();

  const auto under = [&](const State& loads, const std::array<MatrixXd, 2>& field, int pair) {
    double work = 0;
    for (int g = 0; g < 2; ++g) work += loads.load[g].col(pair + reach_).dot(field[g].col(pair + reach_));
    return work;
  };
  const auto strips = [](const MeshPosition& mesh, size_t j) {
    return Eigen::seqN(mesh.first_strip[j], mesh.pairs[j].size());
  };
  VectorXd old_on_new = VectorXd::Zero(new_mesh.strips()), new_on_old = VectorXd::Zero(old_mesh.strips());
  std::vector<bool> met(new_mesh.pairs.size(), false);
  for (size_t i = 0; i < old_mesh.pairs.size(); ++i) {
    const int pair = old_mesh.pairs[i].pair + before.renamed;
    const VectorXd p0 = a.p(strips(old_mesh, i));
    size_t j = 0;
    while (j < new_mesh.pairs.size() && new_mesh.pairs[j].pair != pair) ++j;
    if (j == new_mesh.pairs.size()) {
      if (lines) cutting += bent(old_mesh.law[i], p0[0], 0);
      cutting += 0.5 * (p0.dot(old_mesh.gap(strips(old_mesh, i))) - before.pair_force.col(i).dot(b.z));
      if (std::abs(pair) <= reach_) cutting += 0.5 * under(a, after.field, pair);
      continue;
    }
    met[j] = true;
    const VectorXd p1 = b.p(strips(new_mesh, j));
    old_on_new(strips(new_mesh, j)) = p0;
    new_on_old(strips(old_mesh, i)) = p1;
    if (lines) {
      const HertzLine &law0 = old_mesh.law[i], &law1 = new_mesh.law[j];
      const HertzLine::Point old0 = at(law0, p0[0]), old1 = at(law0, p1[0]), new0 = at(law1, p0[0]),
                             new1 = at(law1, p1[0]);
      switching += 0.5 * (bent(law0, p0[0], p1[0]) + bent(law1, p0[0], p1[0]));
      rolling -= 0.5 * (new0.energy - old0.energy + new1.energy - old1.energy) -
                 0.25 * (p1[0] - p0[0]) *
                     (new1.indentation - old1.indentation - (new0.indentation - old0.indentation));
    }
    switching += 0.5 * (p0.dot(b.d(strips(new_mesh, j))) - p1.dot(a.d(strips(old_mesh, i))));
    rolling -= 0.5 * (p0 + p1).dot(new_mesh.gap(strips(new_mesh, j)) - old_mesh.gap(strips(old_mesh, i)));
    rolling += 0.5 * (p0.dot(after.modal(strips(new_mesh, j))) - p1.dot(before.modal(strips(old_mesh, i))) +
                      after.pair_force.col(j).dot(a.z) - before.pair_force.col(i).dot(b.z));
    rolling -= 0.5 * (p0.dot(after.lagged(strips(new_mesh, j))) - p1.dot(before.lagged(strips(old_mesh, i))) +
                      under(b, before.field, pair) - under(a, after.field, pair));
  }
  for (size_t j = 0; j < new_mesh.pairs.size(); ++j)
    if (!met[j]) {
      if (lines) cutting += bent(new_mesh.law[j], 0, b.p[j]);
      cutting -= 0.5 * (b.p(strips(new_mesh, j)).dot(new_mesh.gap(strips(new_mesh, j))) -
                        after.pair_force.col(j).dot(a.z) + under(b, before.field, new_mesh.pairs[j].pair));
    }
  const VectorXd new_local = after.position->local * b.p, old_local = before.position->local * a.p;
  rolling -= 0.5 * (old_on_new.dot(new_local) - new_on_old.dot(old_local));
  double local = 0.5 * (b.p.dot(new_local) - a.p.dot(old_local));
  for (size_t j = 0; j < new_mesh.law.size(); ++j) local += stored(new_mesh.law[j], b.p[j]);
  for (size_t i = 0; i < old_mesh.law.size(); ++i) local -= stored(old_mesh.law[i], a.p[i]);

  // Modes: force = torque - h^T p.
  const double torque = torque_force_.dot(b.z - a.z);
  double kinetic = 0, modal = 0, modal_damping = 0;
  for (int c = 0; c < a.z.size(); ++c) {
    const double w2 = frequency_squared_[c];
    kinetic += 0.5 * (b.v[c] * b.v[c] - a.v[c] * a.v[c]);
    modal += 0.5 * w2 * (b.z[c] * b.z[c] - a.z[c] * a.z[c]);
    if (parameters_.fidelity.integrator == "newmark") {
      const double v = 0.5 * (a.v[c] + b.v[c]);  // the trapezoidal rule's own velocity
      modal_damping += coordinates_[c].damping * step_ * v * v;
    } else {
      const double push = 0.5 * (a.force[c] + b.force[c]) - w2 * a.z[c], v = a.v[c];
      modal_damping +=
          coordinates_[c].damping *
          (damping_.speed[c] * v * v + 2 * damping_.mixed[c] * v * push + damping_.push[c] * push * push);
    }
  }

  // Lag: eta G' + G = g, energy G R G / 2, dissipation eta G' R G', g linear in the step.
  double residual = 0, lag_damping = 0, averaging = 0;
  for (int g = 0; g < 2; ++g) {
    const auto load0 = a.load[g].reshaped(), load1 = b.load[g].reshaped();
    const auto field0 = before.field[g].reshaped(), field1 = after.field[g].reshaped();
    residual += 0.5 * (b.lag[g].reshaped().dot(field1) - a.lag[g].reshaped().dot(field0));
    const VectorXd change = load1 - load0, moved_change = coupling_[g] * change;
    const VectorXd behind = load0 - a.lag[g].reshaped(), moved_behind = coupling_[g] * load0 - field0;
    double exact = 0.5 * (load0 + load1).dot(moved_change);
    if (relaxation() > 0) {
      lag_damping += damping_.decay2 * behind.dot(moved_behind) +
                     2 * damping_.mixed2 * behind.dot(moved_change) +
                     damping_.growth2 * change.dot(moved_change);
      exact = damping_.decay * load0.dot(moved_behind) + damping_.growth * load0.dot(moved_change) +
              damping_.late_decay * change.dot(moved_behind) +
              damping_.late_growth * change.dot(moved_change);
    }
    averaging += 0.5 * (load0 + load1).dot(field1 - field0) - exact;
  }

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
  ledger.throughput += std::abs(torque) + std::abs(rolling);
  balance += kinetic + modal + residual + local + modal_damping + lag_damping - torque - rolling - switching -
             cutting + averaging;
  ledger.imbalance = std::max(ledger.imbalance, std::abs(balance));
}

}  // namespace whine
