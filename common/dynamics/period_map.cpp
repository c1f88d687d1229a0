#include "dynamics/period_map.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "base/error.h"
#include "base/model_range.h"
#include "model/capabilities.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using State = RollingDynamics::State;

RollingPeriodMap::RollingPeriodMap(RollingDynamics& dynamics, int steps)
    : MotionMap(steps), dynamics_(dynamics) {
  if (dynamics.hunting_periods() > 1)
    require_able("branches", {{Trait::differing, text("of ", dynamics.hunting_periods(), " mesh periods")}});
  dynamics.rest();  // sets the scale of distances
  coordinates_ = static_cast<int>(dynamics.coordinates_.size());
  double largest = 0;
  for (int g = 0; g < dynamics_.gears(); ++g)
    largest = std::max(largest, dynamics.kernel_.system().block(g, 0).diagonal().maxCoeff());
  if (dynamics.relaxation() > 0 && largest > 0) fields_ = dynamics.gears() * dynamics.kernel_.fields();
  unit_ = units(0);
  if (size() > kMostSize)
    fail(Failure::input, "a state of ", size(), " numbers has a tangent with the square of that, at most ",
         kMostSize, " are allowed; lower modes in [fidelity] or set body = \"relaxed\"");
}

const RollingPeriodMap::Position& RollingPeriodMap::position(int sample) const {
  return dynamics_.positions_[sample * (static_cast<int>(dynamics_.positions_.size()) / steps_)];
}

int RollingPeriodMap::channels(int cut) const {
  return position(cut).mesh.nodes();
}

// Modes in the energy norm relative to rest; a relaxed load in that of what it stores by itself; forces in that of rest.
VectorXd RollingPeriodMap::units(int cut) const {
  const int n = coordinates_, nodes = channels(cut);
  VectorXd unit(2 * n + fields_ + nodes);
  const double scale = dynamics_.energy_scale_;
  unit.head(n) = scale * dynamics_.frequency_squared_.cwiseSqrt().cwiseInverse();
  unit[0] = scale / dynamics_.rigid_frequency_;
  unit.segment(n, n).setConstant(scale);
  constexpr int kFields = StepKernel::kFields;
  for (int g = 0; g < dynamics_.gears() && fields_ > 0; ++g) {
    const VectorXd own = dynamics_.kernel_.system().block(g, 0).diagonal();
    constexpr double kLeast = 1e-10;  // of the largest: fields that hardly move anything
    const VectorXd stored = own.cwiseMax(kLeast * own.maxCoeff());
    for (int tooth = 0; tooth < of_gear() / kFields; ++tooth)
      unit.segment<kFields>(2 * n + g * of_gear() + tooth * kFields) =
          scale * stored.cwiseSqrt().cwiseInverse();
  }
  const double load = dynamics_.parameters_.torque / dynamics_.model_.kinematics.gear(0).base_radius();
  unit.tail(nodes).setConstant(load);
  return unit;
}

void RollingPeriodMap::set_parameter(double mesh_frequency) {
  dynamics_.set_speed(mesh_frequency, steps_);
  mesh_frequency_ = mesh_frequency;
  coefficients_.resize(static_cast<size_t>(coordinates_) * kCoefficients);
  double* to = coefficients_.data();
  for (const Propagator& a : dynamics_.kernel_.propagators())
    for (const double coefficient : {a.a11, a.a12, a.a21, a.a22, a.push_z(), a.push_v(), a.bq})
      *to++ = coefficient;
}

VectorXd RollingPeriodMap::flat(const State& state) const {
  const int n = coordinates_, fields = dynamics_.kernel_.fields();
  VectorXd y(size());
  y.head(n) = state.z;
  y.segment(n, n) = state.v;
  for (int g = 0; g < dynamics_.gears() && fields_ > 0; ++g)
    y.segment(2 * n + g * fields, fields) = state.relaxed[g].reshaped();
  y.tail(channels(0)) = position(0).mesh.to_nodes(state.p);
  return y.cwiseQuotient(unit_);
}

State RollingPeriodMap::state(const VectorXd& y) const {
  const int n = coordinates_, fields = dynamics_.kernel_.fields();
  if (const Eigen::Index own = 2 * n + (fields_ > 0 ? dynamics_.gears() * fields : 0) + channels(0);
      y.size() != size() || own != size())
    fail(Failure::numerical, "a state of ", y.size(), " numbers does not fit a candidate zone with ", own,
         ", of a map with ", size());
  const VectorXd own = y.cwiseProduct(unit_), nodes = own.tail(channels(0));
  const Position& position = this->position(0);
  State state;
  state.owner_id = dynamics_.owner_id_;
  state.z = own.head(n);
  state.v = own.segment(n, n);
  state.force = dynamics_.force_of(position, nodes);
  state.load.assign(position.field_weight.size(),
                    MatrixXd::Zero(StepKernel::kFields, 2 * dynamics_.reach_ + 1));
  state.relaxed = state.load;
  for (int g = 0; g < dynamics_.gears(); ++g) {
    for (size_t j = 0; j < position.mesh.pairs.size(); ++j)
      state.load[g].col(position.pair[j].slot) =
          position.field_weight[g](position.mesh.nodes_of(j), Eigen::all).transpose() *
          nodes(position.mesh.nodes_of(j));
    if (fields_ > 0) state.relaxed[g].reshaped() = own.segment(2 * n + g * fields, fields);
  }
  return state;
}

VectorXd RollingPeriodMap::apply(const VectorXd& y) {
  State state = this->state(y);
  prepared_ = false;
  if (!dynamics_.integrate(state, period_)) {
    left_zone_ = true;
    fail_outside_range(Failure::numerical, "at ", mesh_frequency_,
                       " Hz contact leaves the candidate contact zone; take a wider one");
  }
  return flat(state);
}

MotionPeriod RollingPeriodMap::shown() const {
  MotionPeriod out;
  period_.show(out);
  return out;
}

std::vector<std::vector<int>> RollingPeriodMap::active_sets() const {
  std::vector<std::vector<int>> sets(steps_);
  for (int i = 0; i < steps_; ++i) {
    const StepKernel::Step& step = dynamics_.kernel_.step(i);
    if (!dynamics_.lines())
      sets[i] = step.active.strips;
    else
      for (int j = 0; j < step.force.size(); ++j)
        if (step.force[j] > 0) sets[i].push_back(j);
  }
  return sets;
}

// Sample 0 of a period is its end, in the names of the period after it: on an orbit that is its start.
std::vector<ContactEvent> RollingPeriodMap::events() const {
  std::vector<ContactEvent> events;
  const MatrixXd& load = period_.tooth_pair_load;
  const int reach = dynamics_.reach();
  for (int i = 1; i <= steps_; ++i)
    for (int slot = 0; slot < load.rows(); ++slot) {
      // The last step ends in the names of the period after it.
      const int before = i == steps_ ? slot - 1 : slot;
      const bool had = before >= 0 && load(before, i - 1) > 0, has = load(slot, i % steps_) > 0;
      if (had != has) events.push_back({before - reach, has, static_cast<double>(i) / steps_});
    }
  return events;
}

MatrixXd RollingPeriodMap::node_forces(int sample) const {
  const MatrixXd without = node_forces_without_friction(sample);
  if (!(dynamics_.friction() > 0)) return without;
  const MatrixXd& response = dynamics_.kernel_.step(sample).friction;  // (shape row, pair)
  const Eigen::Index pairs = response.cols(), of_pair = without.rows() / std::max<Eigen::Index>(pairs, 1);
  MatrixXd added = MatrixXd::Zero(without.rows(), without.rows());
  for (Eigen::Index i = 0; i < pairs; ++i)
    for (Eigen::Index j = 0; j < pairs; ++j) {
      auto block = added.block(i * of_pair, j * of_pair, of_pair, of_pair);
      if (dynamics_.lines())
        block.setConstant(response(i, j));
      else
        block.colwise() = StepKernel::shape_basis() *
                          response.block<StepKernel::kShapeRows, 1>(i * StepKernel::kShapeRows, j);
    }
  MatrixXd whole = without * added;
  whole.diagonal().array() += 1;
  return lu_solve(whole, without);
}

MatrixXd RollingPeriodMap::node_forces_without_friction(int sample) const {
  const Position& position = this->position(sample);
  const StepKernel::Step& step = dynamics_.kernel_.step(sample);
  const MeshPosition& mesh = position.mesh;
  const int nodes = mesh.nodes();
  MatrixXd result = MatrixXd::Zero(nodes, nodes);
  if (dynamics_.lines()) {
    std::vector<int> carrying;
    for (int j = 0; j < step.force.size(); ++j)
      if (step.force[j] > 0) carrying.push_back(j);
    if (carrying.empty()) return result;
    MatrixXd a = MatrixXd(step.compliance)(carrying, carrying);
    for (size_t k = 0; k < carrying.size(); ++k)
      a(k, k) += mesh.law[carrying[k]].at(step.force[carrying[k]]).slope;
    const MatrixXd inverse = a.llt().solve(MatrixXd::Identity(a.rows(), a.cols()));
    result(carrying, carrying) = inverse;
    return result;
  }
  const std::vector<int>& active = step.active.strips;
  if (active.empty()) return result;
  const int strips = mesh.strips() / static_cast<int>(mesh.pairs.size());
  MatrixXd weights = MatrixXd::Zero(static_cast<Eigen::Index>(active.size()), nodes);
  for (size_t k = 0; k < active.size(); ++k) {
    const int j = active[k] / strips, i = active[k] % strips;
    weights.row(static_cast<Eigen::Index>(k))(mesh.nodes_of(j)) = mesh.pairs[j].interpolation.row(i);
  }
  // The step solved with this inverse.
  if (step.active.known && !step.active.shifted) {
    result = weights.transpose() * (step.active.inverse.block() * weights);
    return result;
  }
  const StripCompliance compliance = dynamics_.kernel_.compliance(sample);
  MatrixXd whole(compliance.size(), compliance.size());
  compliance.assemble_columns(active, active, whole.data());
  const MatrixXd a = whole(active, active);
  const Eigen::LLT<MatrixXd> factor(a);
  if (factor.info() != Eigen::Success)
    fail(Failure::numerical, "at mesh phase ", mesh.phase, " the compliance of the ", active.size(),
         " active strips is not positive definite");
  result = weights.transpose() * factor.solve(weights);
  return result;
}

RollingPeriodMap::Replay RollingPeriodMap::prepare(int sample) {
  constexpr int kFields = StepKernel::kFields;
  const Position& position = this->position(sample);
  const MeshPosition& mesh = position.mesh;
  const bool lines = dynamics_.lines();
  const int rows_of_pair = lines ? 1 : StepKernel::kShapeRows, n = coordinates_;
  Replay r;
  r.present = static_cast<int>(mesh.pairs.size());
  r.nodes_of_pair = mesh.nodes_per_pair;
  r.rows = (r.present * rows_of_pair + 1) / 2 * 2;
  r.nodes = padded(mesh.nodes());
  for (int j = 0; j < r.present; ++j) r.slot[j] = position.pair[j].slot;

  MatrixXd basis = MatrixXd::Zero(r.nodes, r.rows);  // (node, row)
  for (int j = 0; j < r.present; ++j)
    if (lines)
      basis(j, j) = 1;
    else
      basis.block<kZoneNodes, StepKernel::kShapeRows>(j * kZoneNodes, j * StepKernel::kShapeRows) =
          StepKernel::shape_basis();
  const auto place = [&](Eigen::Index count) {
    const size_t at = numbers_.size();
    numbers_.resize(at + static_cast<size_t>(count));
    return at;
  };
  r.row = r.load = place(static_cast<Eigen::Index>(n) * r.rows);
  const MatrixXd rows = basis.topRows(mesh.nodes()).transpose() * position.participation;
  Eigen::Map<MatrixXd>(&numbers_[r.row], r.rows, n) = rows;
  if (dynamics_.friction() >
      0) {  // of a pair's force as a whole, which is its first row's over that row's norm
    r.load = place(static_cast<Eigen::Index>(n) * r.rows);
    Eigen::Map<MatrixXd> load(&numbers_[r.load], r.rows, n);
    load = rows;
    for (int j = 0; j < r.present; ++j)
      load.row(j * rows_of_pair) +=
          dynamics_.friction() * std::sqrt(static_cast<double>(r.nodes_of_pair)) * position.friction.row(j);
  }

  MatrixXd reading = MatrixXd::Zero(r.nodes, fields_);  // (node, residual field) m N-1
  for (int g = 0; g < dynamics_.gears() && fields_ > 0; ++g)
    for (int j = 0; j < r.present; ++j)
      for (int tooth = 0; tooth <= 2 * dynamics_.reach_; ++tooth) {
        const MatrixXd& block = dynamics_.kernel_.system().block(g, r.slot[j] - tooth);
        reading.block(j * r.nodes_of_pair, g * of_gear() + tooth * kFields, r.nodes_of_pair, block.cols()) +=
            position.field_weight[g](mesh.nodes_of(j), Eigen::seqN(0, block.rows())) * block;
      }
  MatrixXd forces = MatrixXd::Zero(r.nodes, r.nodes);
  forces.topLeftCorner(mesh.nodes(), mesh.nodes()) = node_forces(sample);
  MatrixXd solve(r.nodes, fields_ + r.rows);
  solve << -forces * reading, forces * basis;
  r.solve = place(solve.size());
  for (int k = 0; k < r.nodes; k += kLanes)
    Eigen::Map<MatrixXd>(&numbers_[r.solve + static_cast<size_t>(k) * solve.cols()], kLanes, solve.cols()) =
        solve.middleRows(k, kLanes);
  r.shape = place(basis.size());
  Eigen::Map<MatrixXd>(&numbers_[r.shape], r.nodes, r.rows) = 0.5 * basis;
  if (fields_ > 0) {
    r.field = place(static_cast<Eigen::Index>(r.present) * dynamics_.gears() * kFields * r.nodes_of_pair);
    for (int j = 0; j < r.present; ++j)
      for (int g = 0; g < dynamics_.gears(); ++g)
        Eigen::Map<MatrixXd>(
            &numbers_[r.field + static_cast<size_t>((dynamics_.gears() * j + g) * kFields * r.nodes_of_pair)],
            r.nodes_of_pair, kFields) = position.field_weight[g](mesh.nodes_of(j), Eigen::all);
  }
  return r;
}

namespace {

// Loads and stores of a row of perturbations.
template <int kWide>
struct Row {
  Lanes x[kWide / kLanes];
  static Row at(const double* from) {
    Row r;
    for (int k = 0; k < kWide / kLanes; ++k) r.x[k] = lanes(from + k * kLanes);
    return r;
  }
  void put(double* to) const {
    for (int k = 0; k < kWide / kLanes; ++k) lanes(to + k * kLanes) = x[k];
  }
  void add(double factor, const Row& other) {
    for (int k = 0; k < kWide / kLanes; ++k) x[k] += factor * other.x[k];
  }
};

}  // namespace

// Pushes modes by the node forces of the step before, takes them to the next instant and reads the rows of the next position:
// kBefore and kNext rows, or as many as there are if below 0.
template <int kBefore, int kNext>
void RollingPeriodMap::pass(const Replay& before, const Replay& next, int rows_next) {
  using R = Row<kWide>;
  constexpr int kMost = 2 * kMostPairs;
  const int rows_before = kBefore < 0 ? before.rows : kBefore;
  if (kNext >= 0) rows_next = kNext;
  const double *row = numbers_.data() + before.load, *read = numbers_.data() + next.row,
               *coefficient = coefficients_.data();
  double *z = z_.data(), *v = v_.data();
  R half[kBefore < 0 ? kMost : kBefore], sum[kNext < 0 ? kMost : kNext + 1] = {};
  for (int r = 0; r < rows_before; ++r) half[r] = R::at(half_.data() + r * kWide);
  for (int c = 0; c < coordinates_;
       ++c, row += rows_before, read += next.rows, coefficient += kCoefficients, z += kWide, v += kWide) {
    R push{};
#pragma GCC unroll 6
    for (int r = 0; r < rows_before; ++r) push.add(row[r], half[r]);
    const R z0 = R::at(z), v0 = R::at(v);
    R z1{}, v1{};
    z1.add(coefficient[0], z0);
    z1.add(coefficient[1], v0);
    z1.add(-coefficient[4], push);
    v1.add(coefficient[2], z0);
    v1.add(coefficient[3], v0);
    v1.add(-coefficient[5], push);
    z1.put(z);
    v1.put(v);
#pragma GCC unroll 6
    for (int r = 0; r < rows_next; ++r) sum[r].add(read[r], z1);
  }
  for (int r = 0; r < rows_next; ++r) sum[r].put(moved_.data() + (fields_ + r) * kWide);
}

void RollingPeriodMap::pass(const Replay& before, const Replay& next, bool reads) {
  const auto with = [&]<int kBefore>() {
    switch (reads ? next.rows : 0) {
      case 0:
        return pass<kBefore, 0>(before, next, 0);
      case 2:
        return pass<kBefore, 2>(before, next, 2);
      case 4:
        return pass<kBefore, 4>(before, next, 4);
      case 6:
        return pass<kBefore, 6>(before, next, 6);
      default:
        return pass<-1, -1>(before, next, next.rows);
    }
  };
  switch (before.rows) {
    case 2:
      return with.operator()<2>();
    case 4:
      return with.operator()<4>();
    case 6:
      return with.operator()<6>();
    default:
      return pass<-1, -1>(before, next, reads ? next.rows : 0);
  }
}

void RollingPeriodMap::read(const Replay& next) {
  using R = Row<kWide>;
  for (int r = 0; r < next.rows; ++r) {
    R sum{};
    for (int c = 0; c < coordinates_; ++c)
      sum.add(numbers_[next.row + static_cast<size_t>(c * next.rows + r)], R::at(&z_[c * kWide]));
    sum.put(&moved_[(fields_ + r) * kWide]);
  }
}

// relaxed = decay relaxed + share loads of the node forces, of the teeth that carry them.
void RollingPeriodMap::relax(const Replay& at, double decay, double share) {
  using R = Row<kWide>;
  constexpr int kFields = StepKernel::kFields;
  double* relaxed = moved_.data();
  if (fields_ == 0) return;
  for (int g = 0; g < dynamics_.gears(); ++g)
    for (int k = (g * of_gear() + live_first_ * kFields) * kWide;
         k < (g * of_gear() + live_last_ * kFields) * kWide; k += kLanes)
      lanes(relaxed + k) *= decay;
  for (int j = 0; j < at.present; ++j) {
    live_first_ = std::min(live_first_, at.slot[j]);
    live_last_ = std::max(live_last_, at.slot[j] + 1);
  }
  const double* weight = numbers_.data() + at.field;
  for (int j = 0; j < at.present; ++j)
    for (int g = 0; g < dynamics_.gears(); ++g) {
      double* own = relaxed + (g * of_gear() + at.slot[j] * kFields) * kWide;
      for (int k = 0; k < kFields; ++k, own += kWide, weight += at.nodes_of_pair) {
        R load{};
        for (int i = 0; i < at.nodes_of_pair; ++i)
          load.add(weight[i], R::at(&nodes_[(j * at.nodes_of_pair + i) * kWide]));
        R sum = R::at(own);
        sum.add(share, load);
        sum.put(own);
      }
    }
}

// Node forces of what modes and relaxed loads move, and forces on shape rows of those.
void RollingPeriodMap::solve(const Replay& at) {
  using R = Row<kWide>;
  const int columns = fields_ + at.rows;
  const int first = live_first_ * StepKernel::kFields, last = live_last_ * StepKernel::kFields;
  const double* solve = numbers_.data() + at.solve;
  for (int i = 0; i < at.nodes; i += kLanes, solve += static_cast<size_t>(columns) * kLanes) {
    R sum[kLanes] = {};
    const auto add = [&](int from, int to) {
      const double *own = solve + static_cast<size_t>(from) * kLanes, *moved = &moved_[from * kWide];
      for (int k = from; k < to; ++k, own += kLanes, moved += kWide) {
        const R x = R::at(moved);
#pragma GCC unroll 4
        for (int l = 0; l < kLanes; ++l) sum[l].add(own[l], x);
      }
    };
    for (int g = 0; g < dynamics_.gears() && fields_ > 0; ++g)
      add(g * of_gear() + first, g * of_gear() + last);
    add(fields_, columns);
    for (int l = 0; l < kLanes; ++l) sum[l].put(&nodes_[(i + l) * kWide]);
  }
  shape(at);
}

void RollingPeriodMap::shape(const Replay& at) {
  using R = Row<kWide>;
  for (int r = 0; r < at.rows; ++r) {
    R sum{};
    for (int i = 0; i < at.nodes; ++i)
      sum.add(numbers_[at.shape + static_cast<size_t>(r * at.nodes + i)], R::at(&nodes_[i * kWide]));
    sum.put(&half_[r * kWide]);
  }
}

// z and v of a push by the node forces; sign -1 takes it back.
void RollingPeriodMap::push(const Replay& at, double sign) {
  using R = Row<kWide>;
  for (int c = 0; c < coordinates_; ++c) {
    R push{}, z = R::at(&z_[c * kWide]), v = R::at(&v_[c * kWide]);
    for (int r = 0; r < at.rows; ++r)
      push.add(numbers_[at.load + static_cast<size_t>(c * at.rows + r)], R::at(&half_[r * kWide]));
    const double* coefficient = &coefficients_[c * kCoefficients];
    z.add(-sign * coefficient[6], push);
    v.add(-sign * coefficient[1], push);
    z.put(&z_[c * kWide]);
    v.put(&v_[c * kWide]);
  }
}

void RollingPeriodMap::rename() {
  using R = Row<kWide>;
  for (double* y : {z_.data(), v_.data()})
    for (const StepSystem::Turn& turn : dynamics_.kernel_.system().turns) {
      double* at = y + turn.cosine * kWide;
      R cosine{}, sine{};
      if (turn.sine < 0) {
        cosine.add(-1, R::at(at));
        cosine.put(at);
        continue;
      }
      double* other = y + turn.sine * kWide;
      cosine.add(turn.c, R::at(at));
      cosine.add(turn.s, R::at(other));
      sine.add(turn.c, R::at(other));
      sine.add(-turn.s, R::at(at));
      cosine.put(at);
      sine.put(other);
    }
  live_first_ = std::min(live_first_ + 1, live_last_);
  live_last_ = std::min(live_last_ + 1, 2 * dynamics_.reach_ + 1);
  constexpr int kTooth = StepKernel::kFields * kWide;
  const int numbers = of_gear() * kWide;
  for (int g = 0; g < dynamics_.gears() && fields_ > 0; ++g) {
    double* own = moved_.data() + g * numbers;
    std::copy_backward(own, own + numbers - kTooth, own + numbers);
    std::fill(own, own + kTooth, 0.0);
  }
}

// Takes kWide directions or fewer, (size, direction) in units, through the period. The state of a replay is that before its
// node forces act: z, v and relaxed loads go without them, and are pushed in the pass that takes them to the next step.
void RollingPeriodMap::replay(int cut, const Eigen::Ref<const MatrixXd>& directions, const VectorXd& unit,
                              Eigen::Ref<MatrixXd> result) {
  const int n = coordinates_, size = static_cast<int>(unit.size()), end = 2 * n + fields_;
  const Relaxation relaxed = dynamics_.kernel_.relaxed();
  for (std::vector<double>* x : {&z_, &v_, &moved_, &nodes_}) std::fill(x->begin(), x->end(), 0.0);
  const auto row = [&](int i) {
    return i < n       ? &z_[i * kWide]
           : i < 2 * n ? &v_[(i - n) * kWide]
           : i < end   ? &moved_[(i - 2 * n) * kWide]
                       : &nodes_[(i - end) * kWide];
  };
  const int count = static_cast<int>(directions.cols());
  live_first_ = 2 * dynamics_.reach_ + 1;
  live_last_ = 0;
  for (int i = 0; i < size; ++i) {
    bool moves = false;
    for (int k = 0; k < count; ++k) {
      row(i)[k] = unit[i] * directions(i, k);
      moves |= directions(i, k) != 0;
    }
    if (!moves || i < 2 * n || i >= end) continue;
    const int tooth = (i - 2 * n) % of_gear() / StepKernel::kFields;
    live_first_ = std::min(live_first_, tooth);
    live_last_ = std::max(live_last_, tooth + 1);
  }
  shape(replay_[cut]);
  push(replay_[cut], -1);
  relax(replay_[cut], 1, -relaxed.from_new);
  const double share = relaxed.decay * relaxed.from_new + relaxed.from_old;
  for (int i = 1, before = cut; i <= steps_; ++i) {
    const int sample = (cut + i) % steps_;
    pass(replay_[before], replay_[sample], sample != 0);
    relax(replay_[before], relaxed.decay, share);
    if (sample == 0) {
      rename();
      read(replay_[sample]);
    }
    solve(replay_[sample]);
    before = sample;
  }
  push(replay_[cut], 1);
  relax(replay_[cut], 1, relaxed.from_new);
  for (int i = 0; i < size; ++i)
    for (int k = 0; k < count; ++k) result(i, k) = row(i)[k] / unit[i];
}

// What the steps of the period applied last do to perturbations.
void RollingPeriodMap::prepare_replay() {
  if (prepared_) return;
  numbers_.clear();
  replay_.clear();
  size_t rows = 0, nodes = 0;
  for (int i = 0; i < steps_; ++i) {
    replay_.push_back(prepare(i));
    rows = std::max(rows, static_cast<size_t>(replay_.back().rows));
    nodes = std::max(nodes, static_cast<size_t>(replay_.back().nodes));
  }
  const auto n = static_cast<size_t>(coordinates_), fields = static_cast<size_t>(fields_);
  z_.resize(n * kWide);
  v_.resize(n * kWide);
  moved_.resize((fields + rows) * kWide);
  nodes_.resize(nodes * kWide);
  half_.resize(rows * kWide);
  prepared_ = true;
}

MatrixXd RollingPeriodMap::replayed(int cut, const MatrixXd& directions) {
  prepare_replay();
  const VectorXd unit = units(cut);
  MatrixXd result(unit.size(), directions.cols());
  for (Eigen::Index first = 0; first < directions.cols(); first += kWide) {
    const Eigen::Index count = std::min<Eigen::Index>(kWide, directions.cols() - first);
    replay(cut, directions.middleCols(first, count), unit, result.middleCols(first, count));
  }
  return result;
}

MatrixXd RollingPeriodMap::tangent_from(int cut) {
  const int all = 2 * coordinates_ + fields_ + channels(cut);
  return replayed(cut, MatrixXd::Identity(all, all));
}

}  // namespace whine
