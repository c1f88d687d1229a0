#include "motion/dynamics.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "contact/lanes.h"

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
    if (eigen.info() != Eigen::Success || !(eigen.eigenvalues()[1] > 0))
      fail(Failure::numerical, "the ", k, " torsional modes of the ", g ? "driven gear" : "driver", ", from ",
           body.eigenfrequency[torsional[0]], " Hz with the hub fixed, have no frequencies at an inertia of ",
           parameters_.inertia[g], " kg m2, of which they couple ", mass.row(0).tail(k).squaredNorm(),
           "; rebuild body.h5");
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

namespace {

constexpr int kFields = 12;    // per tooth; a multiple of kLanes
constexpr int kPairNodes = 8;  // columns of nodes: kWindowNodes and zeros up to whole lanes
static_assert(kFields % kLanes == 0 && kPairNodes % kLanes == 0 && kPairNodes >= kWindowNodes);

// (flank, field) orthonormal: the loads of a flank that its own displacements, and before all those of its neighbours,
// depend on most. tables: flexibility of gear g by offset between teeth, -max..max.
MatrixXd lagged_fields(const std::vector<MatrixXd>& tables, int g) {
  const int max = static_cast<int>(tables.size()) / 2, m = static_cast<int>(tables[max].rows());
  // What a tooth and all others within the body's offsets do to each other has rank 7 to 9 to 1e-8 of the tooth's own
  // flexibility (16 to 50 teeth, undamped depths up to 1 m). The weight takes it whole; the fields left over go to
  // the tooth itself.
  constexpr double kNeighbourWeight = 1e6;
  // What no field holds follows at once. With 12 fields it is 5e-5 of the whole for 50 teeth, 1e-4 for 16; a body that
  // leaves ten times that is no tooth that fields were chosen for.
  constexpr double kMostRemainder = 1e-3;
  MatrixXd importance = tables[max] * tables[max];
  for (int offset = -max; offset <= max; ++offset)
    if (offset != 0) importance += kNeighbourWeight * tables[offset + max] * tables[offset + max].transpose();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(importance);
  if (eigen.info() != Eigen::Success)
    fail(Failure::numerical, "the lagged fields of the ", g ? "driven gear" : "driver",
         " were not found: its ", m, " flank points have a flexibility of norm ", tables[max].norm(),
         " m/N; rebuild body.h5");
  const MatrixXd fields = eigen.eigenvectors().rightCols(std::min(kFields, m));
  const double whole = tables[max].norm();
  for (int offset = -max; offset <= max; ++offset) {
    const MatrixXd& r = tables[offset + max];
    const double rest = (r - fields * (fields.transpose() * r * fields) * fields.transpose()).norm();
    if (!(rest <= kMostRemainder * whole))
      fail(Failure::numerical, "the ", fields.cols(), " lagged fields of the ", g ? "driven gear" : "driver",
           " leave ", rest / whole, " of a tooth's residual flexibility to follow at once (between teeth ",
           offset, " apart), above ", kMostRemainder, "; rebuild body.h5 with more modes or finer elements");
  }
  return fields;
}

}  // namespace

void RollingDynamics::set_range(const ContactRange& range, int steps) {
  if (range.strips % kLanes != 0)
    fail(Failure::numerical, range.strips, " strips in a window are no multiple of ", kLanes);
  const double depth = parameters_.damping.undamped_depth;
  positions_.assign(steps, {});
  reach_ = 1;
  for (int i = 0; i < steps; ++i) {
    positions_[i].mesh = make_position(model_, static_cast<double>(i) / steps, range);
    for (const PairStrips& s : positions_[i].mesh.pairs) reach_ = std::max(reach_, std::abs(s.pair));
  }

  const int pairs = 2 * reach_ + 1;
  std::array<std::vector<MatrixXd>, 2> tables;  // by offset between teeth, -2 reach..2 reach
  for (int g = 0; g < 2; ++g) {
    const int m = model_.gear[g].table_size();
    const bool rigid = parameters_.fidelity.body == "rigid";
    for (int offset = -2 * reach_; offset <= 2 * reach_; ++offset)
      tables[g].push_back(rigid ? MatrixXd::Zero(m, m) : model_.gear[g].residual(offset, depth, kept_[g]));
    // Of all offsets that the body holds, so that the state keeps its meaning when a wider range reaches more teeth.
    std::vector<MatrixXd> known;
    const int offsets = model_.gear[g].body().offsets;
    for (int offset = -offsets; offset <= offsets; ++offset)
      known.push_back(rigid ? MatrixXd::Zero(m, m) : model_.gear[g].residual(offset, depth, kept_[g]));
    fields_[g] = lagged_fields(known, g);
    coupling_[g] = MatrixXd::Zero(kFields * pairs, kFields * pairs);
    const int own = static_cast<int>(fields_[g].cols());
    for (int i = 0; i < pairs; ++i)
      for (int j = 0; j < pairs; ++j)
        coupling_[g].block(i * kFields, j * kFields, own, own) =
            fields_[g].transpose() * tables[g][GearMeshModel::tooth(g, i - j) + 2 * reach_] * fields_[g];
  }
  for (Position& position : positions_) {
    const MeshPosition& mesh = position.mesh;
    position.participation = participation(mesh);
    position.lagged = MatrixXd::Zero(mesh.nodes(), mesh.nodes());
    MatrixXd whole = position.lagged;
    for (int g = 0; g < 2; ++g) {
      whole += body_compliance(mesh, g, tables[g]);
      position.field_weight[g] = MatrixXd::Zero(mesh.nodes(), kFields);
      position.field_weight[g].leftCols(fields_[g].cols()) = mesh.table_weights[g] * fields_[g];
      const auto rows = [&](size_t i) {
        return position.field_weight[g].middleRows<kWindowNodes>(static_cast<int>(i) * kWindowNodes);
      };
      for (size_t i = 0; i < mesh.pairs.size(); ++i)
        for (size_t j = 0; j < mesh.pairs.size(); ++j)
          position.lagged.block<kWindowNodes, kWindowNodes>(i * kWindowNodes, j * kWindowNodes) +=
              rows(i) *
              coupling_[g].block<kFields, kFields>((mesh.pairs[i].pair + reach_) * kFields,
                                                   (mesh.pairs[j].pair + reach_) * kFields) *
              rows(j).transpose();
    }
    position.local = local_compliance(model_, mesh, depth);
    mesh.add_to_strips(whole - position.lagged, position.local);
    for (const PairStrips& s : mesh.pairs)
      position.drift_lever.push_back(s.contact.lever[0] / model_.kinematics.gear(0).base_radius() -
                                     s.contact.lever[1] / model_.kinematics.gear(1).base_radius());
  }
  step_data_.clear();
  pack();
}

// Lays the numbers of each position side by side.
void RollingDynamics::pack() {
  stream_.clear();
  const auto place = [this](Eigen::Index count) {
    const size_t at = stream_.size();
    stream_.resize(at + static_cast<size_t>(count), 0.0);
    return at;
  };
  const int coordinates = padded(static_cast<int>(coordinates_.size()));
  size_t inner = std::numeric_limits<size_t>::max();  // windows without an edge are all alike
  for (Position& position : positions_) {
    const MeshPosition& mesh = position.mesh;
    const int pairs = static_cast<int>(mesh.pairs.size()), nodes = pairs * kPairNodes;
    position.gap = place(mesh.strips());
    std::copy(mesh.gap.begin(), mesh.gap.end(), stream_.begin() + static_cast<std::ptrdiff_t>(position.gap));
    position.shape = place(nodes * coordinates);
    for (int j = 0; j < pairs; ++j) {
      for (int c = 0; c < static_cast<int>(coordinates_.size()); ++c)
        for (int k = 0; k < kWindowNodes; ++k)
          stream_[position.shape + c * nodes + j * kPairNodes + k] =
              position.participation(j * kWindowNodes + k, c);
      const PairStrips& s = mesh.pairs[j];
      const bool edge = s.low_is_edge || s.high_is_edge;
      if (edge || inner == std::numeric_limits<size_t>::max()) {
        const size_t at = place(s.size() * kPairNodes);
        for (int k = 0; k < kWindowNodes; ++k)
          for (int i = 0; i < s.size(); ++i) stream_[at + k * s.size() + i] = s.interpolation(i, k);
        position.interpolation.push_back(at);
        if (!edge) inner = at;
      } else {
        position.interpolation.push_back(inner);
      }
      for (int g = 0; g < 2; ++g) {
        const size_t at = place(kPairNodes * kFields);
        for (int r = 0; r < kFields; ++r)
          for (int k = 0; k < kWindowNodes; ++k)
            stream_[at + r * kPairNodes + k] = position.field_weight[g](j * kWindowNodes + k, r);
        position.field[g].push_back(at);
      }
    }
  }
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
  const int n = static_cast<int>(coordinates_.size());
  for (VectorXd* x : {&speed_.a11, &speed_.a12, &speed_.a21, &speed_.a22, &speed_.bq, &speed_.bv})
    x->setZero(padded(n));
  for (int i = 0; i < n; ++i) {
    const Coordinate& c = coordinates_[i];
    const Propagator a = parameters_.fidelity.integrator == "newmark"
                             ? newmark_propagator(c.frequency, c.damping, h)
                             : exact_propagator(c.frequency, c.damping, h);
    speed_.a11[i] = a.a11;
    speed_.a12[i] = a.a12;
    speed_.a21[i] = a.a21;
    speed_.a22[i] = a.a22;
    speed_.bq[i] = a.bq;
    speed_.bv[i] = a.bv;
  }
  const VectorXd half_response = 0.5 * speed_.bq.head(n);
  lag_ = lag_step(relaxation(), h);
  damping_ = damping_integrals();

  // Memory stays; so do the active strips of a step at the same phase, as a first guess.
  const int before = static_cast<int>(step_data_.size());
  if (before != steps) {
    std::vector<Step> other(steps);
    for (int i = 0; i < steps && before > 0; ++i)
      if (i * before % steps == 0) other[i].active.strips = step_data_[i * before / steps].active.strips;
    step_data_ = std::move(other);
  }
  for (int i = 0; i < steps; ++i) {
    const Position& position = positions_[i * stride_];
    step_data_[i].active.forget();
    step_data_[i].compliance = position.local;
    position.mesh.add_to_strips(lag_.from_new * position.lagged + position.participation *
                                                                      half_response.asDiagonal() *
                                                                      position.participation.transpose(),
                                step_data_[i].compliance);
  }
}

VectorXd RollingDynamics::flexibility() const {
  VectorXd f = frequency_squared_;
  for (int i = 0; i < f.size(); ++i) f[i] = coordinates_[i].gear < 0 ? 0 : 1 / f[i];
  return f;
}

// Elastic coordinates follow their force, z = (torque - h f) / w^2; the rigid one carries the load.
MatrixXd RollingDynamics::static_compliance(const Position& position) const {
  MatrixXd a = position.local;
  position.mesh.add_to_strips(position.lagged + position.participation * flexibility().asDiagonal() *
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
  position.mesh.add_to_strips(position.lagged, a);
  const MatrixXd compliance = a(active.strips, active.strips);
  MatrixXd h(position.mesh.strips(), position.participation.cols());
  for (int c = 0; c < h.cols(); ++c) h.col(c) = position.mesh.to_strips(position.participation.col(c));
  const MatrixXd touching = h(active.strips, Eigen::all);
  MatrixXd stiffness = touching.transpose() * compliance.ldlt().solve(touching);
  stiffness.diagonal() += frequency_squared_;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(stiffness, Eigen::EigenvaluesOnly);
  if (eigen.info() != Eigen::Success || !(eigen.eigenvalues()[0] > 0))
    fail(Failure::numerical, "at mesh phase ", position.mesh.phase, " the pair with ", active.strips.size(),
         " strips in contact has no natural frequency: least eigenvalue ", eigen.eigenvalues()[0],
         " rad2/s2 of a stiffness of norm ", stiffness.norm());
  return std::sqrt(eigen.eigenvalues()[0]) / kTwoPi;
}

HeldMesh RollingDynamics::hold(int i) const {
  const Position& position = positions_[i];
  const MeshPosition& mesh = position.mesh;
  HeldMesh held;
  held.phase = mesh.phase;
  held.frequency_squared = frequency_squared_;
  held.damping.resize(frequency_squared_.size());
  held.participation.resize(mesh.strips(), frequency_squared_.size());
  for (int c = 0; c < held.damping.size(); ++c) {
    held.damping[c] = coordinates_[c].damping;
    held.participation.col(c) = mesh.to_strips(position.participation.col(c));
  }
  held.torque = torque_force_;
  held.error_weight = error_weight_;
  held.local = position.local;
  held.residual = MatrixXd::Zero(mesh.strips(), mesh.strips());
  mesh.add_to_strips(position.lagged, held.residual);
  held.gap = mesh.gap;
  held.first_strip = mesh.first_strip;
  for (size_t j = 0; j < mesh.pairs.size(); ++j) {
    if (!mesh.pairs[j].low_is_edge) held.window_end.push_back(mesh.first_strip[j]);
    if (!mesh.pairs[j].high_is_edge) held.window_end.push_back(mesh.first_strip[j + 1] - 1);
  }
  held.next_corner_gap = mesh.next_corner_gap;
  held.lost_corner_gap = mesh.lost_corner_gap;
  held.relaxation = relaxation();
  held.newmark = parameters_.fidelity.integrator == "newmark";
  return held;
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
    state.load[g] = MatrixXd::Zero(kFields, 2 * reach_ + 1);
    for (size_t j = 0; j < position.mesh.pairs.size(); ++j)
      state.load[g].col(position.mesh.pairs[j].pair + reach_) +=
          position.field_weight[g].middleRows<kWindowNodes>(j * kWindowNodes).transpose() *
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

VectorXd RollingDynamics::difference(const State& a, const State& b) const {
  const Eigen::Index n = a.z.size();
  VectorXd both(2 * n);
  both << (a.z - b.z).cwiseProduct(frequency_squared_.cwiseSqrt()), a.v - b.v;
  both[0] = rigid_frequency_ * (a.z[0] - b.z[0]);
  return both / energy_scale_;
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

bool RollingDynamics::march(State& state, Period& period, Ledger* ledger) {
  const int pairs = 2 * reach_ + 1, own = static_cast<int>(coordinates_.size()), coordinates = padded(own),
            fields = kFields * pairs;
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

  // All vectors of a step, each a whole number of lanes.
  VectorXd z(coordinates), v(coordinates), force(coordinates), torque = VectorXd::Zero(coordinates),
                                                               weight = torque, response(coordinates);
  torque.head(own) = torque_force_;
  weight.head(own) = error_weight_;
  std::array<VectorXd, 2> lag, load;
  const auto take = [&] {
    z.setZero();
    v.setZero();
    force.setZero();
    z.head(own) = state.z;
    v.head(own) = state.v;
    force.head(own) = state.force;
    for (int g = 0; g < 2; ++g) {
      lag[g] = state.lag[g].reshaped();
      load[g] = state.load[g].reshaped();
    }
  };
  const auto give = [&] {
    state.z = z.head(own);
    state.v = v.head(own);
    state.force = force.head(own);
    for (int g = 0; g < 2; ++g) {
      state.lag[g].reshaped() = lag[g];
      state.load[g].reshaped() = load[g];
    }
  };
  take();
  int most_strips = 0;
  size_t most_pairs = 0;
  for (const Position& position : positions_) {
    most_strips = std::max(most_strips, position.mesh.strips());
    most_pairs = std::max(most_pairs, position.mesh.pairs.size());
  }
  VectorXd e(most_strips), p(most_strips), d(most_strips);
  VectorXd nodes(most_pairs * kPairNodes), displacement(kFields);

  std::array<Instant, 2> instants;  // before and after a step, in turn
  if (ledger) fill(instants[0], positions_[0], state);
  double balance = 0;
  for (int i = 1; i <= steps_; ++i) {
    const int sample = i == steps_ ? 0 : i;
    if (sample == 0) {
      give();
      advance_tooth(state);
      take();
      if (ledger) rename(instants[(i - 1) % 2]);
    }
    const Position& position = positions_[sample * stride_];
    const MeshPosition& mesh = position.mesh;
    Step& step = step_data_[sample];
    const int strips = mesh.strips(), present = static_cast<int>(mesh.pairs.size()),
              rows = present * kPairNodes, of_pair = present > 0 ? strips / present : 0;

    // What the step would bring without new contact force.
    for (int c = 0; c < coordinates; c += kLanes) {
      const Lanes mean = 0.5 * (lanes(&force[c]) + lanes(&torque[c])), z0 = lanes(&z[c]), v0 = lanes(&v[c]);
      lanes(&z[c]) = lanes(&speed_.a11[c]) * z0 + lanes(&speed_.a12[c]) * v0 + lanes(&speed_.bq[c]) * mean;
      lanes(&v[c]) = lanes(&speed_.a21[c]) * z0 + lanes(&speed_.a22[c]) * v0 + lanes(&speed_.bv[c]) * mean;
      lanes(&response[c]) = -lanes(&z[c]);
    }
    std::fill(nodes.data(), nodes.data() + rows, 0.0);
    add_columns(nodes.data(), &stream_[position.shape], rows, response.data(), coordinates, 0, rows);
    for (int g = 0; g < 2; ++g) {
      double *moved = lag[g].data(), *old = load[g].data();
      for (int k = 0; k < fields; k += kLanes)
        lanes(moved + k) = lag_.decay * lanes(moved + k) + lag_.from_old * lanes(old + k);
      for (int j = 0; j < present; ++j) {
        const int slot = (mesh.pairs[j].pair + reach_) * kFields;
        displacement.setZero();
        add_columns(displacement.data(), coupling_[g].data() + slot, fields, moved, fields, 0, kFields);
        add_columns(&nodes[j * kPairNodes], &stream_[position.field[g][j]], kPairNodes, displacement.data(),
                    kFields, 0, kPairNodes);
      }
    }
    std::copy(&stream_[position.gap], &stream_[position.gap] + strips, e.data());
    for (int j = 0; j < present; ++j)
      add_columns(&e[j * of_pair], &stream_[position.interpolation[j]], of_pair, &nodes[j * kPairNodes],
                  kWindowNodes, 0, of_pair);
    const Certificate certificate =
        solver_.solve(step.compliance, e.head(strips), step.active, p.head(strips), d.head(strips));
    period.least_gap = std::min(period.least_gap, certificate.least_gap);
    period.least_force = std::min(period.least_force, certificate.least_force);
    period.fallbacks += certificate.fallback;

    // The new force's own share.
    double drift = 0;
    for (int j = 0; j < present; ++j) {
      const PairStrips& pair = mesh.pairs[j];
      const double* own_p = &p[j * of_pair];
      if ((!pair.low_is_edge && own_p[0] > 0) || (!pair.high_is_edge && own_p[of_pair - 1] > 0)) return false;
      dot_columns(&nodes[j * kPairNodes], &stream_[position.interpolation[j]], of_pair, kPairNodes, own_p,
                  of_pair);
      Lanes total{};
      for (int k = 0; k < of_pair; k += kLanes) total += lanes(own_p + k);
      const double carried = sum(total);
      period.pair_load(pair.pair + reach_, sample) = carried;
      drift += position.drift_lever[j] * carried;
    }
    period.drift_force = std::max(period.drift_force, std::abs(drift));
    dot_columns(response.data(), &stream_[position.shape], rows, coordinates, nodes.data(), rows);
    Lanes error_sum{};
    for (int c = 0; c < coordinates; c += kLanes) {
      const Lanes contact = lanes(&response[c]);
      lanes(&force[c]) = lanes(&torque[c]) - contact;
      lanes(&z[c]) -= 0.5 * lanes(&speed_.bq[c]) * contact;
      lanes(&v[c]) -= 0.5 * lanes(&speed_.bv[c]) * contact;
      error_sum += lanes(&weight[c]) * lanes(&z[c]);
    }
    for (int g = 0; g < 2; ++g) {
      load[g].setZero();
      for (int j = 0; j < present; ++j)
        dot_columns(&load[g][(mesh.pairs[j].pair + reach_) * kFields], &stream_[position.field[g][j]],
                    kPairNodes, kFields, &nodes[j * kPairNodes], kPairNodes);
      for (int k = 0; k < fields; k += kLanes) lanes(&lag[g][k]) += lag_.from_new * lanes(&load[g][k]);
    }

    if (ledger) {
      give();
      state.p = p.head(strips);
      state.d = d.head(strips);
      fill(instants[i % 2], position, state);
      record_step(instants[(i - 1) % 2], instants[i % 2], balance, *ledger);
    }

    const double error = sum(error_sum);
    period.transmission_error[sample] = error;
    if (error > mesh.lost_corner_gap)
      fail(Failure::numerical, "at mesh phase ", mesh.phase, " the transmission error ", error * 1e6,
           " micrometres closes the gap of ", mesh.lost_corner_gap * 1e6,
           " micrometres of a tip edge that would touch below the involute; lower the torque or set "
           "corner_contact = false");
    if (error > mesh.next_corner_gap) return false;
  }
  give();
  const int strips = positions_[0].mesh.strips();
  state.p = p.head(strips);
  state.d = d.head(strips);
  return true;
}

}  // namespace whine
