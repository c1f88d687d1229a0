#include "motion/dynamics.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
constexpr double kTwoPi = 2 * std::numbers::pi;
}

RollingDynamics::RollingDynamics(const GearMeshModel& model, const DynamicParameters& parameters)
    : model_(model), parameters_(parameters) {
  const std::string& rung = parameters.fidelity.body;
  double inverse_mass = 0;
  for (int g = 0; g < 2; ++g) {
    if (!(parameters.inertia[g] > model.gear[g].body().inertia))
      fail(Failure::input, "total_inertia_kgm2 = ", parameters.inertia[g], " of the ",
           g ? "driven gear" : "driver", " lies below the inertia of its own body, ",
           model.gear[g].body().inertia, " kg m2; raise it");
    const double r = model.kinematics.gear(g).base_radius();
    inverse_mass += r * r / parameters.inertia[g];
  }
  // The rigid rotation that is mass-orthogonal to a common rolling of both gears: theta_g ~ r_g / I_g.
  rigid_frequency_ = std::sqrt(parameters.mean_stiffness * inverse_mass);
  Coordinate rigid;
  rigid.damping = parameters.damping.rayleigh_mass + 2 * parameters.damping.bearing_ratio * rigid_frequency_;
  for (int g = 0; g < 2; ++g) {
    const double r = model.kinematics.gear(g).base_radius();
    rigid.hub[g] = r / parameters.inertia[g] / std::sqrt(inverse_mass);
    rigid.torque += rigid.hub[g] * parameters.torque * r / model.kinematics.gear(0).base_radius();
  }
  coordinates_.push_back(rigid);

  for (int g = 0; g < 2; ++g) {
    const BodyArtifact& body = model.gear[g].body();
    int torsional = -1;  // the first zero-diameter mode with inertia coupling
    for (int i = 0; i < body.eigenfrequency.size(); ++i)
      if (body.nodal_diameter[i] == 0 &&
          (torsional < 0 || std::abs(body.inertia_coupling[i]) > std::abs(body.inertia_coupling[torsional])))
        torsional = i;
    if (rung != "rigid") {
      if (torsional < 0) fail(Failure::input, "the body holds no torsional mode; rebuild body.h5");
      for (int i = 0; i < body.eigenfrequency.size(); ++i)
        if (rung == "modal" || i == torsional) kept_[g].push_back(i);
    }
    add_modes(g, kept_[g]);
  }

  const int n = static_cast<int>(coordinates_.size());
  error_weight_ = torque_force_ = frequency_squared_ = VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) {
    for (int g = 0; g < 2; ++g)
      error_weight_[i] += model.kinematics.gear(g).base_radius() * coordinates_[i].hub[g];
    torque_force_[i] = coordinates_[i].torque;
    frequency_squared_[i] = coordinates_[i].frequency * coordinates_[i].frequency;
  }
}

void RollingDynamics::add_modes(int g, const std::vector<int>& columns) {
  const ElasticGear& gear = model_.gear[g];
  const BodyArtifact& body = gear.body();
  const double torque =
      parameters_.torque * model_.kinematics.gear(g).base_radius() / model_.kinematics.gear(0).base_radius();
  const auto damping = [&](double w) {
    return parameters_.damping.rayleigh_mass + parameters_.damping.rayleigh_stiffness * w * w;  // Eq. 21
  };

  std::vector<int> torsional, others;
  for (int column : columns) (body.nodal_diameter[column] == 0 ? torsional : others).push_back(column);

  // Zero diameters: [[I, gamma^T], [gamma, 1]] z'' + diag(0, w^2) z, the hub rotation first.
  const int k = static_cast<int>(torsional.size());
  if (k > 0) {
    MatrixXd mass = MatrixXd::Identity(k + 1, k + 1), stiffness = MatrixXd::Zero(k + 1, k + 1);
    mass(0, 0) = parameters_.inertia[g];
    for (int i = 0; i < k; ++i) {
      const double w = kTwoPi * body.eigenfrequency[torsional[i]],
                   gamma = body.inertia_coupling[torsional[i]];
      mass(0, i + 1) = mass(i + 1, 0) = gamma;
      stiffness(i + 1, i + 1) = w * w;
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(stiffness, mass);
    for (int i = 1; i <= k; ++i) {  // 0 is the rigid rotation
      Coordinate c;
      c.gear = g;
      VectorXd shape = eigen.eigenvectors().col(i);
      if (shape[0] < 0) shape = -shape;
      c.frequency = std::sqrt(eigen.eigenvalues()[i]);
      c.damping = damping(c.frequency);
      c.hub[g] = shape[0];
      c.torque = shape[0] * torque;
      for (int m = 0; m < k; ++m) c.columns.emplace_back(torsional[m], shape[m + 1]);
      coordinates_.push_back(c);
    }
  }
  for (int column : others) {
    Coordinate c;
    c.gear = g;
    c.frequency = kTwoPi * body.eigenfrequency[column];
    c.damping = damping(c.frequency);
    c.columns.emplace_back(column, 1.0);
    const int other = gear.partner(column), here = static_cast<int>(coordinates_.size());
    if (other != column) {
      c.partner = other > column ? here + 1 : here - 1;
      // The reference tooth moves on by one: clockwise on the driver, counter-clockwise on the driven gear.
      c.turn = (g == 0 ? -1 : 1) * gear.tooth_angle(column);
    } else if (body.nodal_diameter[column] > 0) {
      c.turn = std::numbers::pi;  // n = teeth / 2: neighbouring teeth move against each other
    }
    coordinates_.push_back(c);
  }
}

double RollingDynamics::bearing_damper(int g) const {
  return 2 * parameters_.damping.bearing_ratio * parameters_.inertia[g] * rigid_frequency_;
}

void RollingDynamics::set_range(const ContactRange& range, int steps) {
  const bool rigid = parameters_.fidelity.body == "rigid";
  const double depth = parameters_.damping.undamped_depth;
  positions_.assign(steps, {});
  reach_ = 1;
  for (int i = 0; i < steps; ++i) {
    positions_[i].mesh = make_position(model_, static_cast<double>(i) / steps, range);
    for (const PairStrips& s : positions_[i].mesh.pairs) reach_ = std::max(reach_, std::abs(s.pair));
  }

  std::vector<MatrixXd> tables[2];  // index pair difference + 2 reach
  for (int g = 0; g < 2; ++g)
    for (int difference = -2 * reach_; difference <= 2 * reach_; ++difference) {
      const int m = model_.gear[g].table_size();
      tables[g].push_back(
          rigid ? MatrixXd::Zero(m, m)
                : model_.gear[g].residual(GearMeshModel::tooth(g, difference), depth, kept_[g]));
    }
  const int pairs = 2 * reach_ + 1;
  for (int g = 0; g < 2; ++g) {
    const int m = model_.gear[g].table_size();
    residual_[g].resize(m * pairs, m * pairs);
    for (int i = 0; i < pairs; ++i)
      for (int j = 0; j < pairs; ++j) residual_[g].block(i * m, j * m, m, m) = tables[g][i - j + 2 * reach_];
  }
  for (Position& position : positions_) {
    const MeshPosition& mesh = position.mesh;
    position.local = local_compliance(model_, mesh, depth);
    position.participation = participation(mesh);
    position.residual = MatrixXd::Zero(mesh.nodes(), mesh.nodes());
    position.drift_lever = mesh.node_lever[0] / model_.kinematics.gear(0).base_radius() -
                           mesh.node_lever[1] / model_.kinematics.gear(1).base_radius();
    for (int g = 0; g < 2; ++g) {
      const int m = model_.gear[g].table_size();
      position.reading[g].resize(mesh.nodes(), m * pairs);
      for (size_t i = 0; i < mesh.pairs.size(); ++i) {
        const auto rows = Eigen::seqN(static_cast<int>(i) * kWindowNodes, kWindowNodes);
        const MatrixXd weights = mesh.table_weights[g](rows, Eigen::all);
        for (int pair = -reach_; pair <= reach_; ++pair)
          position.reading[g](rows, Eigen::seqN((pair + reach_) * m, m)) =
              weights * tables[g][mesh.pairs[i].pair - pair + 2 * reach_];
        for (size_t j = 0; j < mesh.pairs.size(); ++j) {
          const auto columns = Eigen::seqN(static_cast<int>(j) * kWindowNodes, kWindowNodes);
          position.residual(rows, columns) +=
              position.reading[g](rows, Eigen::seqN((mesh.pairs[j].pair + reach_) * m, m)) *
              mesh.table_weights[g](columns, Eigen::all).transpose();
        }
      }
    }
  }
  step_data_.clear();
}

MatrixXd RollingDynamics::participation(const MeshPosition& mesh) const {
  MatrixXd h = MatrixXd::Zero(mesh.nodes(), static_cast<int>(coordinates_.size()));
  for (size_t c = 0; c < coordinates_.size(); ++c) {
    for (int g = 0; g < 2; ++g) h.col(c) += coordinates_[c].hub[g] * mesh.node_lever[g];
    const int g = coordinates_[c].gear;
    for (size_t i = 0; i < mesh.pairs.size(); ++i)
      for (const auto& [column, share] : coordinates_[c].columns)
        h.col(c).segment<kWindowNodes>(i * kWindowNodes) +=
            share * mesh.table_weights[g].middleRows<kWindowNodes>(i * kWindowNodes) *
            model_.gear[g].mode_on_tooth(column, GearMeshModel::tooth(g, mesh.pairs[i].pair));
  }
  return h;
}

void RollingDynamics::set_speed(double mesh_frequency, int steps) {
  const int finest = static_cast<int>(positions_.size());
  if (steps <= 0 || finest % steps != 0)
    fail(Failure::numerical, steps, " steps per period do not divide the ", finest,
         " positions of the range");
  steps_ = steps;
  stride_ = finest / steps;
  const double h = step_ = 1 / (mesh_frequency * steps);
  propagators_.clear();
  VectorXd half_response(coordinates_.size());
  for (size_t i = 0; i < coordinates_.size(); ++i) {
    const Coordinate& c = coordinates_[i];
    propagators_.push_back(parameters_.fidelity.integrator == "newmark"
                               ? newmark_propagator(c.frequency, c.damping, h)
                               : exact_propagator(c.frequency, c.damping, h));
    half_response[i] = 0.5 * propagators_.back().bq;
  }
  lag_ =
      lag_step(parameters_.fidelity.body == "quasi-static" ? 0 : parameters_.damping.rayleigh_stiffness, h);

  std::vector<Step> fresh(steps);
  for (int i = 0; i < steps; ++i) {
    const Position& position = positions_[i * stride_];
    if (static_cast<int>(step_data_.size()) == steps) fresh[i].active.strips = step_data_[i].active.strips;
    fresh[i].compliance = position.local;
    position.mesh.add_to_strips(lag_.from_new * position.residual + position.participation *
                                                                        half_response.asDiagonal() *
                                                                        position.participation.transpose(),
                                fresh[i].compliance);
  }
  step_data_ = std::move(fresh);
}

VectorXd RollingDynamics::flexibility() const {
  VectorXd f = frequency_squared_;
  for (int i = 0; i < f.size(); ++i) f[i] = coordinates_[i].gear < 0 ? 0 : 1 / f[i];
  return f;
}

// Elastic coordinates follow their force, z = (torque - h f) / w^2; the rigid one carries the load.
MatrixXd RollingDynamics::static_compliance(const Position& position) const {
  MatrixXd a = position.local;
  position.mesh.add_to_strips(position.residual + position.participation * flexibility().asDiagonal() *
                                                      position.participation.transpose(),
                              a);
  return a;
}

double RollingDynamics::frozen_frequency(int i) {
  const Position& position = positions_[i];
  const VectorXd offset = position.participation * flexibility().cwiseProduct(torque_force_);
  ActiveSet active;
  equilibrium(static_compliance(position), position.mesh.gap - position.mesh.to_strips(offset),
              position.mesh.to_strips(position.participation.col(0)), torque_force_[0], 0, active, solver_);
  // d = 0 on the active strips: p = (A + R)^-1 h z there, and z'' + (w^2 + h^T (A + R)^-1 h) z = 0.
  MatrixXd a = position.local;
  position.mesh.add_to_strips(position.residual, a);
  const MatrixXd compliance = a(active.strips, active.strips);
  MatrixXd h(position.mesh.strips(), position.participation.cols());
  for (int c = 0; c < h.cols(); ++c) h.col(c) = position.mesh.to_strips(position.participation.col(c));
  const MatrixXd touching = h(active.strips, Eigen::all);
  MatrixXd stiffness = touching.transpose() * compliance.ldlt().solve(touching);
  stiffness.diagonal() += frequency_squared_;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(stiffness, Eigen::EigenvaluesOnly);
  return std::sqrt(eigen.eigenvalues()[0]) / kTwoPi;
}

RollingDynamics::State RollingDynamics::rest() {
  const Position& position = positions_[0];
  const MatrixXd a = static_compliance(position);
  const VectorXd follow = flexibility();
  const VectorXd offset = position.participation * follow.cwiseProduct(torque_force_);
  ActiveSet active;
  const Equilibrium e = equilibrium(a, position.mesh.gap - position.mesh.to_strips(offset),
                                    position.mesh.to_strips(position.participation.col(0)), torque_force_[0],
                                    0, active, solver_);
  const VectorXd nodes = position.mesh.to_nodes(e.p);
  State state;
  state.force = torque_force_ - position.participation.transpose() * nodes;
  state.z = follow.cwiseProduct(state.force);
  state.z[0] = e.x;
  state.v = VectorXd::Zero(state.z.size());
  state.p = e.p;
  state.d =
      a * e.p + position.mesh.gap - position.mesh.to_strips(offset + e.x * position.participation.col(0));
  for (int g = 0; g < 2; ++g) {
    state.load[g] = MatrixXd::Zero(model_.gear[g].table_size(), 2 * reach_ + 1);
    for (size_t j = 0; j < position.mesh.pairs.size(); ++j)
      state.load[g].col(position.mesh.pairs[j].pair + reach_) +=
          position.mesh.table_weights[g].middleRows<kWindowNodes>(j * kWindowNodes).transpose() *
          nodes.segment<kWindowNodes>(j * kWindowNodes);
    state.lag[g] = state.load[g];
  }
  static_deflection_ = error_weight_.dot(state.z);
  State nothing = state;
  nothing.z.setZero();
  energy_scale_ = 1;
  energy_scale_ = distance(state, nothing);
  return state;
}

double RollingDynamics::distance(const State& a, const State& b) const {
  double energy = 0;
  for (int i = 0; i < a.z.size(); ++i) {
    const double dz = a.z[i] - b.z[i], dv = a.v[i] - b.v[i];
    energy += dv * dv +
              std::max(frequency_squared_[i], i == 0 ? rigid_frequency_ * rigid_frequency_ : 0.0) * dz * dz;
  }
  return std::sqrt(energy) / energy_scale_;
}

void RollingDynamics::turn_doublets(Eigen::Ref<VectorXd> y) const {
  for (int i = 0; i < y.size(); ++i) {
    const Coordinate& c = coordinates_[i];
    if (c.turn == 0) continue;
    if (c.partner < 0) {
      y[i] = -y[i];
    } else if (c.partner > i) {
      // Z = cosine - i sine turns by exp(i turn).
      const double cosine = y[i], sine = y[c.partner];
      y[i] = std::cos(c.turn) * cosine + std::sin(c.turn) * sine;
      y[c.partner] = std::cos(c.turn) * sine - std::sin(c.turn) * cosine;
    }
  }
}

void RollingDynamics::advance_tooth(State& state) const {
  for (VectorXd* y : {&state.z, &state.v, &state.force}) turn_doublets(*y);
  for (int g = 0; g < 2; ++g)
    for (MatrixXd* field : {&state.lag[g], &state.load[g]}) {
      for (int j = static_cast<int>(field->cols()) - 1; j > 0; --j) field->col(j) = field->col(j - 1);
      field->col(0).setZero();  // a tooth that comes into reach was unloaded for longer than any lag lasts
    }
}

RollingDynamics::Instant RollingDynamics::instant(const Position& position, const State& state) const {
  const MeshPosition& mesh = position.mesh;
  Instant now{&position, 0, state, mesh.to_strips(position.participation * state.z), {}, {}};
  VectorXd nodes = VectorXd::Zero(mesh.nodes());
  for (int g = 0; g < 2; ++g) nodes += position.reading[g] * state.lag[g].reshaped();
  now.lagged = mesh.to_strips(nodes);
  nodes = mesh.to_nodes(state.p);
  now.pair_force.resize(state.z.size(), mesh.pairs.size());
  for (size_t j = 0; j < mesh.pairs.size(); ++j)
    now.pair_force.col(j) = position.participation.middleRows<kWindowNodes>(j * kWindowNodes).transpose() *
                            nodes.segment<kWindowNodes>(j * kWindowNodes);
  return now;
}

bool RollingDynamics::march(State& state, Period& period, Ledger* ledger) {
  const int pairs = 2 * reach_ + 1;
  period.transmission_error.resize(steps_);
  period.pair_load = MatrixXd::Zero(pairs, steps_);
  period.drift_force = period.least_gap = period.least_force = 0;
  period.fallbacks = 0;
  for (int g = 0; g < 2; ++g)
    if (state.lag[g].cols() < pairs) {  // the range grew: more teeth are followed
      const int more = (pairs - static_cast<int>(state.lag[g].cols())) / 2;
      for (MatrixXd* field : {&state.lag[g], &state.load[g]}) {
        MatrixXd wide = MatrixXd::Zero(field->rows(), pairs);
        wide.middleCols(more, field->cols()) = *field;
        *field = wide;
      }
    }

  VectorXd nodes, e, loads;
  Instant before;
  if (ledger) before = instant(positions_[0], state);
  double balance = 0;
  for (int i = 1; i <= steps_; ++i) {
    const int sample = i % steps_;
    if (sample == 0) {
      advance_tooth(state);
      if (ledger) {
        advance_tooth(before.state);
        for (int j = 0; j < before.pair_force.cols(); ++j) turn_doublets(before.pair_force.col(j));
        before.renamed = 1;
      }
    }
    const Position& position = positions_[sample * stride_];
    const MeshPosition& mesh = position.mesh;
    Step& step = step_data_[sample];

    // What the step would bring without new contact force.
    for (int c = 0; c < state.z.size(); ++c) {
      const Propagator& a = propagators_[c];
      const double mean = 0.5 * (state.force[c] + torque_force_[c]), z = state.z[c], v = state.v[c];
      state.z[c] = a.a11 * z + a.a12 * v + a.bq * mean;
      state.v[c] = a.a21 * z + a.a22 * v + a.bv * mean;
    }
    nodes.noalias() = -position.participation * state.z;
    for (int g = 0; g < 2; ++g) {
      state.lag[g] = lag_.decay * state.lag[g] + lag_.from_old * state.load[g];
      nodes.noalias() += position.reading[g] * state.lag[g].reshaped();
    }
    e = mesh.gap + mesh.to_strips(nodes);
    state.p.resize(mesh.strips());
    state.d.resize(mesh.strips());
    const Certificate certificate = solver_.solve(step.compliance, e, step.active, state.p, state.d);
    if (mesh.reaches_window_end(state.p)) return false;
    period.least_gap = std::min(period.least_gap, certificate.least_gap);
    period.least_force = std::min(period.least_force, certificate.least_force);
    period.fallbacks += certificate.fallback;

    // The new force's own share.
    nodes = mesh.to_nodes(state.p);
    state.force = torque_force_;
    state.force.noalias() -= position.participation.transpose() * nodes;
    for (int c = 0; c < state.z.size(); ++c) {
      const double own = 0.5 * (state.force[c] - torque_force_[c]);
      state.z[c] += propagators_[c].bq * own;
      state.v[c] += propagators_[c].bv * own;
    }
    for (int g = 0; g < 2; ++g) {
      state.load[g].setZero();
      for (size_t j = 0; j < mesh.pairs.size(); ++j)
        state.load[g].col(mesh.pairs[j].pair + reach_).noalias() +=
            mesh.table_weights[g].middleRows<kWindowNodes>(j * kWindowNodes).transpose() *
            nodes.segment<kWindowNodes>(j * kWindowNodes);
      state.lag[g] += lag_.from_new * state.load[g];
    }

    if (ledger) {
      Instant after = instant(position, state);
      record_step(before, after, balance, *ledger);
      before = std::move(after);
    }

    const double error = error_weight_.dot(state.z);
    period.transmission_error[sample] = error;
    loads = mesh.pair_loads(state.p);
    for (size_t j = 0; j < mesh.pairs.size(); ++j)
      period.pair_load(mesh.pairs[j].pair + reach_, sample) = loads[j];
    period.drift_force = std::max(period.drift_force, std::abs(position.drift_lever.dot(nodes)));
    if (error > mesh.lost_corner_gap)
      fail(Failure::numerical, "at mesh phase ", mesh.phase, " the transmission error ", error * 1e6,
           " micrometres closes the gap of a tip edge that would touch below the involute; lower the torque "
           "or set "
           "corner_contact = false");
    if (error > mesh.next_corner_gap) return false;
  }
  return true;
}

// One step of the ledger. With d = e - h z + U + A p and p . d = 0 at both ends, (p_n + p_n+1)/2 . (d_n+1 - d_n) is the
// switching line, and what the mean forces do on modes, lag and half-planes follows term by term; products of an old
// force with a new shape are the work of the rolling. A pair that a corner rule takes out under load keeps its last
// geometry for the step, one that it lets in has its first: the gap there is the cutting line.
void RollingDynamics::record_step(const Instant& before, const Instant& after, double& balance,
                                  Ledger& ledger) const {
  // Gauss-Legendre on (0, 1): six points leave 1e-12 of what decays by exp(-1) in a step.
  static constexpr int kPoints = 6;
  static constexpr double kNode[kPoints] = {0.033765242898423975, 0.16939530676686776, 0.3806904069584015,
                                            0.6193095930415985,   0.8306046932331322,  0.966234757101576};
  static constexpr double kWeight[kPoints] = {0.08566224618958487, 0.18038078652406947, 0.23395696728634569,
                                              0.23395696728634569, 0.18038078652406947, 0.08566224618958487};
  const State &a = before.state, &b = after.state;
  const MeshPosition &old_mesh = before.position->mesh, &new_mesh = after.position->mesh;
  double rolling = 0, switching = 0, cutting = 0;
  double storage = 0.5 * (b.p.dot(after.position->local * b.p) - a.p.dot(before.position->local * a.p));

  // Displacements that the lagged loads of one instant cause under the loads of a pair at the other.
  std::array<MatrixXd, 2> old_field, new_field;  // R (lagged loads), (flank, pair)
  for (int g = 0; g < 2; ++g) {
    old_field[g] = (residual_[g] * a.lag[g].reshaped()).reshaped(a.lag[g].rows(), a.lag[g].cols());
    new_field[g] = (residual_[g] * b.lag[g].reshaped()).reshaped(b.lag[g].rows(), b.lag[g].cols());
  }
  const auto under = [&](const State& loads, const std::array<MatrixXd, 2>& field, int pair) {
    double work = 0;
    for (int g = 0; g < 2; ++g) work += loads.load[g].col(pair + reach_).dot(field[g].col(pair + reach_));
    return work;
  };
  const auto strips = [](const MeshPosition& mesh, size_t j) {
    return Eigen::seqN(mesh.first_strip[j], mesh.pairs[j].size());
  };
  const auto half_plane = [&](const Instant& at, size_t j, const VectorXd& left, const VectorXd& right) {
    const auto own = strips(at.position->mesh, j);
    return left.dot(at.position->local(own, own) * right);
  };
  std::vector<bool> met(new_mesh.pairs.size(), false);
  for (size_t i = 0; i < old_mesh.pairs.size(); ++i) {
    const int pair = old_mesh.pairs[i].pair + before.renamed;
    const VectorXd p0 = a.p(strips(old_mesh, i));
    size_t j = 0;
    while (j < new_mesh.pairs.size() && new_mesh.pairs[j].pair != pair) ++j;
    if (j == new_mesh.pairs.size()) {
      cutting += 0.5 * (p0.dot(old_mesh.gap(strips(old_mesh, i))) - before.pair_force.col(i).dot(b.z));
      if (std::abs(pair) <= reach_) cutting += 0.5 * under(a, new_field, pair);
      continue;
    }
    met[j] = true;
    const VectorXd p1 = b.p(strips(new_mesh, j));
    switching += 0.5 * (p0.dot(b.d(strips(new_mesh, j))) - p1.dot(a.d(strips(old_mesh, i))));
    rolling -= 0.5 * (p0 + p1).dot(new_mesh.gap(strips(new_mesh, j)) - old_mesh.gap(strips(old_mesh, i)));
    rolling += 0.5 * (p0.dot(after.modal(strips(new_mesh, j))) - p1.dot(before.modal(strips(old_mesh, i))) +
                      after.pair_force.col(j).dot(a.z) - before.pair_force.col(i).dot(b.z));
    rolling -= 0.5 * (p0.dot(after.lagged(strips(new_mesh, j))) - p1.dot(before.lagged(strips(old_mesh, i))) +
                      under(b, old_field, pair) - under(a, new_field, pair));
    rolling -= 0.5 * (half_plane(after, j, p0, p1) - half_plane(before, i, p0, p1));
  }
  for (size_t j = 0; j < new_mesh.pairs.size(); ++j)
    if (!met[j])
      cutting -= 0.5 * (b.p(strips(new_mesh, j)).dot(new_mesh.gap(strips(new_mesh, j))) -
                        after.pair_force.col(j).dot(a.z) + under(b, old_field, new_mesh.pairs[j].pair));

  // Modes: force = torque - h^T p.
  const double torque = torque_force_.dot(b.z - a.z);
  double modal_damping = 0;
  for (int c = 0; c < a.z.size(); ++c) {
    const double w2 = frequency_squared_[c], mean = 0.5 * (a.force[c] + b.force[c]);
    storage += 0.5 * (b.v[c] * b.v[c] - a.v[c] * a.v[c] + w2 * (b.z[c] * b.z[c] - a.z[c] * a.z[c]));
    if (parameters_.fidelity.integrator == "newmark") {
      const double v = 0.5 * (a.v[c] + b.v[c]);  // the trapezoidal rule's own velocity
      modal_damping += coordinates_[c].damping * step_ * v * v;
    } else {
      for (int k = 0; k < kPoints; ++k) {
        const Propagator part =
            exact_propagator(coordinates_[c].frequency, coordinates_[c].damping, kNode[k] * step_);
        const double v = part.a21 * a.z[c] + part.a22 * a.v[c] + part.bv * mean;
        modal_damping += coordinates_[c].damping * step_ * kWeight[k] * v * v;
      }
    }
  }

  // Residual flexibility: eta G' + G = g, energy G R G / 2, dissipation eta G' R G', g linear in the step.
  const double eta = parameters_.fidelity.body == "quasi-static" ? 0 : parameters_.damping.rayleigh_stiffness;
  double lag_damping = 0, averaging = 0;
  for (int g = 0; g < 2; ++g) {
    const MatrixXd& r = residual_[g];
    const VectorXd lag0 = a.lag[g].reshaped(), lag1 = b.lag[g].reshaped();
    const VectorXd load0 = a.load[g].reshaped(), load1 = b.load[g].reshaped();
    storage += 0.5 * (lag1.dot(new_field[g].reshaped()) - lag0.dot(old_field[g].reshaped()));
    double exact = 0;
    if (eta > 0) {
      for (int k = 0; k < kPoints; ++k) {
        const Lag part = lag_step(eta, kNode[k] * step_);
        const VectorXd load = load0 + kNode[k] * (load1 - load0);
        const VectorXd rate = (load - part.decay * lag0 - part.from_old * load0 - part.from_new * load) / eta;
        const VectorXd moved = r * rate;
        exact += step_ * kWeight[k] * load.dot(moved);
        lag_damping += eta * step_ * kWeight[k] * rate.dot(moved);
      }
    } else {
      exact = 0.5 * (load0 + load1).dot(r * (load1 - load0));
    }
    averaging += 0.5 * (load0 + load1).dot((new_field[g] - old_field[g]).reshaped()) - exact;
  }

  ledger.storage += storage;
  ledger.torque += torque;
  ledger.rolling += rolling;
  ledger.modal_damping += modal_damping;
  ledger.lag_damping += lag_damping;
  ledger.switching += switching;
  ledger.cutting += cutting;
  ledger.averaging += averaging;
  ledger.throughput += std::abs(torque) + std::abs(rolling);
  balance += storage + modal_damping + lag_damping - torque - rolling - switching - cutting + averaging;
  ledger.imbalance = std::max(ledger.imbalance, std::abs(balance));
}

}  // namespace whine
