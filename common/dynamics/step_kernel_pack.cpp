// What a step streams, laid side by side: positions, steps at a speed, states.
#include "dynamics/step_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const StepKernel::ShapeBasis& StepKernel::shape_basis() {
  static const ShapeBasis basis = [] {
    ShapeBasis b;
    for (int k = 0; k < kZoneNodes; ++k)
      for (int m = 0; m < kShapeRows; ++m)
        b(k, m) = std::sqrt((m > 0 ? 2.0 : 1.0) / kZoneNodes) *
                  std::cos(m * (2 * k + 1) * std::numbers::pi / (2 * kZoneNodes));
    return b;
  }();
  return basis;
}

void StepKernel::set_zone(StepSystem system, const std::vector<StepPosition>& positions) {
  system_ = std::move(system);
  coordinates_ = padded(static_cast<int>(system_.torque_force.size()));
  steps_.clear();
  step_memory_ = HugeBlock();
  stream_.clear();
  size_t most = 0;
  for (const MatrixXd& m : system_.half_plane)
    most += static_cast<size_t>(m.size()) + static_cast<size_t>(m.rows() * kPairNodes);
  for (const StepPosition& position : positions) most += numbers(position);
  stream_.reserve(most);
  frames_.assign(positions.size(), {});
  std::vector<Window> zones(system_.half_plane.size());
  for (size_t i = 0; i < positions.size(); ++i) {
    const MeshPosition& mesh = positions[i].mesh;
    Frame& frame = frames_[i];
    frame.present = static_cast<int>(mesh.pairs.size());
    frame.of_pair = frame.present > 0 ? mesh.strips() / frame.present : 0;
    frame.law = mesh.law;
    for (size_t j = 0; j < mesh.pairs.size(); ++j) {
      frame.pair[j].slot = positions[i].pair[j].slot;
      frame.pair[j].low_is_edge = mesh.pairs[j].low_is_edge;
      frame.pair[j].high_is_edge = mesh.pairs[j].high_is_edge;
    }
    if (system_.lines)
      pack_lines(positions[i], frame);
    else
      pack_strips(positions[i], frame, zones);
    pack_loads(positions[i], frame);
  }
  size_workspaces(positions);
}

void StepKernel::size_workspaces(const std::vector<StepPosition>& positions) {
  int strips = kMostPairs, pairs = 1;
  for (const StepPosition& position : positions) {
    strips = std::max(strips, position.mesh.strips());
    pairs = std::max(pairs, static_cast<int>(position.mesh.pairs.size()));
  }
  for (VectorXd* x : {&vectors_.z, &vectors_.v, &vectors_.force, &rest_}) x->setZero(coordinates_);
  for (VectorXd* x : {&vectors_.relaxed, &vectors_.load, &field_, &moved_load_})
    x->setZero(kSides * fields());
  for (VectorXd* x : {&e_, &p_, &d_}) x->setZero(strips);
  nodes_.setZero(pairs * kPairNodes);
  set_hubs();
}

void StepKernel::set_hubs() {
  const int own = static_cast<int>(system_.torque_force.size());
  const auto turns_hub = [&](int lane) {
    for (int i = lane; i < std::min(lane + kLanes, own); ++i)
      if (system_.error_weight[i] != 0 || system_.torque_force[i] != 0) return true;
    return false;
  };
  HubLanes& hub = hubs_;
  for (hub.first_end = 0; hub.first_end < coordinates_ && turns_hub(hub.first_end);) hub.first_end += kLanes;
  for (hub.second = hub.first_end; hub.second < coordinates_ && !turns_hub(hub.second);) hub.second += kLanes;
  for (hub.second_end = coordinates_; hub.second_end > hub.second && !turns_hub(hub.second_end - kLanes);)
    hub.second_end -= kLanes;
}

size_t StepKernel::place(Eigen::Index count) {
  const size_t at = stream_.size();
  stream_.resize(at + static_cast<size_t>(count), 0.0);
  return at;
}

size_t StepKernel::place_matrix(const Eigen::Ref<const MatrixXd>& m) {
  const size_t at = place(m.size());
  Eigen::Map<MatrixXd>(&stream_[at], m.rows(), m.cols()) = m;
  return at;
}

// Of a position, without candidate zones.
size_t StepKernel::numbers(const StepPosition& position) const {
  const int pairs = static_cast<int>(position.mesh.pairs.size());
  const size_t friction =
      position.friction.size() == 0
          ? 0
          : static_cast<size_t>(pairs * (system_.lines ? 2 : 1 + kShapeRows) * coordinates_);
  if (system_.lines) return friction + static_cast<size_t>(pairs) * static_cast<size_t>(record().size());
  return friction + static_cast<size_t>(position.mesh.strips()) +
         static_cast<size_t>(pairs) *
             static_cast<size_t>(kPairNodes * pairs * kZoneNodes + kShapeRows * coordinates_ +
                                 kSides * kPairNodes * kFields);
}

void StepKernel::pack_lines(const StepPosition& position, Frame& frame) {
  const MeshPosition& mesh = position.mesh;
  const LineRecord record = this->record();
  frame.line = place(static_cast<int>(mesh.pairs.size()) * record.size());
  for (size_t j = 0; j < mesh.pairs.size(); ++j) {
    double* at = &stream_[frame.line + j * static_cast<size_t>(record.size())];
    const PairContact& contact = mesh.pairs[j].contact;
    at[LineRecord::kGap] = mesh.gap[static_cast<Eigen::Index>(j)];
    at[LineRecord::kMost] =
        std::min(mesh.law[j].largest_force(), mesh.law[j].force(contact.x_max - contact.x_min));
    const auto row = [at](int offset, Eigen::Index n) {
      return Eigen::Map<Eigen::RowVectorXd>(at + offset, n);
    };
    row(LineRecord::kShape, position.participation.cols()) = position.participation.row(j);
    for (int side = 0; side < kSides; ++side) {
      const auto weight = position.field_weight[side].row(j);
      for (int tooth = 0; tooth < system_.teeth(); ++tooth) {
        const MatrixXd& block = system_.block(side, frame.pair[j].slot - tooth);
        const Eigen::RowVectorXd reading = weight.head(block.rows()) * block;
        row(record.reading(side, tooth), kSharedFields) = reading.head(kSharedFields);
        if (tooth == frame.pair[j].slot)
          row(record.own_reading(side), kFields - kSharedFields) = reading.tail(kFields - kSharedFields);
      }
      row(record.weight(side), kFields) = weight;
    }
  }
}

void StepKernel::pack_strips(const StepPosition& position, Frame& frame, std::vector<Window>& zones) {
  const MeshPosition& mesh = position.mesh;
  const int pairs = frame.present;
  frame.gap = place_matrix(mesh.gap);
  frame.instantaneous_compliance = place(pairs * kPairNodes * pairs * kZoneNodes);
  put_at_nodes(position.instantaneous_compliance, &stream_[frame.instantaneous_compliance]);
  frame.shape = place(pairs * kShapeRows * coordinates_);
  for (int j = 0; j < pairs; ++j) {
    const MatrixXd shape =
        shape_basis().transpose() * position.participation.middleRows<kZoneNodes>(j * kZoneNodes);
    double* rows = &stream_[frame.shape + static_cast<size_t>(j * kShapeRows * coordinates_)];
    for (int c = 0; c < shape.cols(); ++c)
      for (int r = 0; r < kShapeRows; ++r)
        rows[(c / kLanes * kShapeRows + r) * kLanes + c % kLanes] = shape(r, c);
    Frame::Pair& pair = frame.pair[j];
    Window& zone = zones[position.pair[j].zone];
    if (!zone) {
      const PairStrips& s = mesh.pairs[j];
      const size_t interpolation = place(s.size() * kPairNodes);
      Eigen::Map<MatrixXd>(&stream_[interpolation], s.size(), kZoneNodes) = s.interpolation;
      zone = {interpolation, place_matrix(system_.half_plane[position.pair[j].zone])};
    }
    std::tie(pair.interpolation, pair.half_plane) = *zone;
    pair.field = place(kSides * kPairNodes * kFields);
    for (int side = 0; side < kSides; ++side)
      Eigen::Map<MatrixXd>(&stream_[pair.field + static_cast<size_t>(side * kPairNodes * kFields)],
                           kPairNodes, kFields)
          .topRows<kZoneNodes>() = position.field_weight[side].middleRows<kZoneNodes>(j * kZoneNodes);
  }
}

// Rows that forces act through: those that gaps are read through, or others with friction.
void StepKernel::pack_loads(const StepPosition& position, Frame& frame) {
  const int of_pair = (system_.lines ? 1 : kShapeRows) * coordinates_;
  frame.load = system_.lines ? frame.line + LineRecord::kShape : frame.shape;
  frame.load_apart = static_cast<size_t>(system_.lines ? record().size() : of_pair);
  if (position.friction.size() == 0) return;
  frame.friction = place(frame.present * coordinates_);
  for (int j = 0; j < frame.present; ++j)
    Eigen::Map<Eigen::RowVectorXd>(&stream_[frame.friction + static_cast<size_t>(j * coordinates_)],
                                   position.friction.cols()) = position.friction.row(j);
  frame.load = place(frame.present * of_pair);
  frame.load_apart = static_cast<size_t>(of_pair);
}

// A pair's force as a whole is the first row's, over that row's norm.
void StepKernel::set_friction(double coefficient, const VectorXd& torque_force) {
  friction_ = coefficient;
  system_.torque_force = torque_force;
  const int rows = system_.lines ? 1 : kShapeRows;
  const double share = coefficient * (system_.lines ? 1.0 : std::sqrt(static_cast<double>(kZoneNodes)));
  for (const Frame& frame : frames_)
    for (int j = 0; j < frame.present; ++j) {
      const double *shape = shape_of(frame, j),
                   *friction = &stream_[frame.friction + static_cast<size_t>(j * coordinates_)];
      double* load = &stream_[frame.load + static_cast<size_t>(j) * frame.load_apart];
      for (int c = 0; c < coordinates_; c += kLanes)
        for (int r = 0; r < rows; ++r) {
          lanes(load + c * rows + r * kLanes) = lanes(shape + c * rows + r * kLanes);
          if (r == 0) lanes(load + c * rows) += share * lanes(friction + c);
        }
    }
}

void StepKernel::set_gap(int position, const VectorXd& gap) {
  const Frame& frame = this->frame(position);
  if (!system_.lines) {
    std::copy(gap.begin(), gap.end(), stream_.begin() + static_cast<std::ptrdiff_t>(frame.gap));
    return;
  }
  const LineRecord record = this->record();
  for (Eigen::Index j = 0; j < gap.size(); ++j)
    stream_[frame.line + static_cast<size_t>(j * record.size() + LineRecord::kGap)] = gap[j];
}

void StepKernel::set_crack(int position, const MatrixXd& instantaneous, const MatrixXd& crack) {
  if (!system_.lines) put_at_nodes(instantaneous, &stream_[frame(position).instantaneous_compliance]);
  if (steps_.empty() || position % stride_ != 0) return;
  Step& step = steps_[static_cast<size_t>(position) / static_cast<size_t>(stride_)];
  if (step.intact.size() == 0) step.intact = step.compliance;
  step.compliance = step.intact;
  if (crack.size() > 0) {
    MatrixXd laid = crack;
    if (!system_.lines) {
      laid.setZero(step.compliance.rows(), step.compliance.cols());
      put_at_nodes(crack, laid.data());
    }
    step.compliance += laid;
  }
  step.active.forget();
  step.start.forget();
}

// Lays (node, node) out as StripCompliance::at_nodes, whose other rows stay 0.
void StepKernel::put_at_nodes(const MatrixXd& at_nodes, double* to) {
  const auto pairs = at_nodes.cols() / kZoneNodes;
  for (Eigen::Index c = 0; c < at_nodes.cols(); ++c)
    for (Eigen::Index j = 0; j < pairs; ++j, to += kPairNodes)
      for (int k = 0; k < kZoneNodes; ++k) to[k] = at_nodes(j * kZoneNodes + k, c);
}

size_t StepKernel::Step::Size::numbers() const {
  const auto whole = static_cast<size_t>(padded(strips));
  return static_cast<size_t>(rows) * static_cast<size_t>(columns) + whole * whole;
}

StepKernel::Step::Step(Size size, std::pmr::memory_resource* memory)
    : store(static_cast<size_t>(size.rows) * static_cast<size_t>(size.columns), memory),
      compliance(store.data(), size.rows, size.columns),
      active(memory) {
  active.inverse.reserve(size.strips);
}

// Memory stays; so do the active strips, or the forces, of a step at the same phase.
void StepKernel::size_steps(int steps) {
  const int before = static_cast<int>(steps_.size());
  if (before == steps) return;
  std::vector<std::pair<std::vector<int>, PairVector>> known(steps);
  for (int i = 0; i < steps && before > 0; ++i)
    if (i * before % steps == 0) {
      Step& step = steps_[i * before / steps];
      known[i] = {std::move(step.active.strips), step.force};
    }
  steps_.clear();
  const auto size_of = [this](const Frame& frame) {
    const int pairs = frame.present;
    return system_.lines ? Step::Size{pairs, pairs, 0}
                         : Step::Size{pairs * kPairNodes, pairs * kZoneNodes, frame.present * frame.of_pair};
  };
  // Once for all speeds: only what a speed has steps for is ever touched.
  if (!step_memory_.data()) {
    size_t numbers = 0;
    for (const Frame& frame : frames_) numbers += size_of(frame).numbers();
    step_memory_ = HugeBlock(numbers * sizeof(double));
  }
  step_pool_ = std::make_unique<std::pmr::monotonic_buffer_resource>(
      step_memory_.data(), step_memory_.bytes(), std::pmr::null_memory_resource());
  steps_.reserve(steps);
  for (int i = 0; i < steps; ++i) {
    Step& step = steps_.emplace_back(size_of(frame(position_of(i))), step_pool_.get());
    std::tie(step.active.strips, step.force) = std::move(known[i]);
  }
}

void StepKernel::set_speed(std::vector<Propagator> propagators, const Relaxation& relaxed, int steps,
                           const std::vector<StepPosition>& positions) {
  propagators_ = std::move(propagators);
  relaxed_step_ = relaxed;
  stride_ = static_cast<int>(positions.size()) / steps;
  coefficients_.number.setZero(Coefficients::kCount * coordinates_);
  for (int i = 0; i < static_cast<int>(propagators_.size()); ++i) {
    const Propagator& a = propagators_[i];
    coefficients_.at(Coefficients::a11, i) = a.a11;
    coefficients_.at(Coefficients::a12, i) = a.a12;
    coefficients_.at(Coefficients::a21, i) = a.a21;
    coefficients_.at(Coefficients::a22, i) = a.a22;
    coefficients_.at(Coefficients::push_z, i) = a.push_z();
    coefficients_.at(Coefficients::push_v, i) = a.push_v();
    coefficients_.at(Coefficients::bq, i) = a.bq;
    coefficients_.at(Coefficients::torque, i) = system_.torque_force[i];
    coefficients_.at(Coefficients::weight, i) = system_.error_weight[i];
  }
  size_steps(steps);
  MatrixXd at_nodes;
  for (int i = 0; i < steps; ++i) {
    const StepPosition& position = positions[position_of(i)];
    Step& step = steps_[i];
    step.intact.resize(0, 0);
    step.active.forget();
    step.start.forget();
    at_nodes = position.instantaneous_compliance + relaxed_step_.from_new * position.relaxed;
    add_response(frame(position_of(i)), at_nodes);
    if (friction_ > 0) step.friction = friction_response(frame(position_of(i)));
    if (system_.lines)
      step.compliance = at_nodes;
    else
      put_at_nodes(at_nodes, step.compliance.data());
  }
}

namespace {

// Two pairs' rows of coordinates against each other, (row of a, row of b), each coordinate with half its coefficient.
template <int kRows>
Eigen::Matrix<double, kRows, kRows> weighted(const double* a, const double* b, const double* coefficient,
                                             int apart, int coordinates) {
  Lanes sums_of[kRows][kRows] = {};
  for (int c = 0; c < coordinates; c += kLanes) {
    const Lanes half = 0.5 * lanes(coefficient + c * apart);
    for (int r = 0; r < kRows; ++r)
      for (int m = 0; m < kRows; ++m)
        sums_of[r][m] += half * lanes(a + c * kRows + r * kLanes) * lanes(b + c * kRows + m * kLanes);
  }
  Eigen::Matrix<double, kRows, kRows> result;
  for (int r = 0; r < kRows; ++r)
    for (int m = 0; m < kRows; ++m) result(r, m) = sum(sums_of[r][m]);
  return result;
}

}  // namespace

const double* StepKernel::shape_of(const Frame& frame, int j) const {
  return system_.lines ? &stream_[frame.line + static_cast<size_t>(j * record().size() + LineRecord::kShape)]
                       : &stream_[frame.shape + static_cast<size_t>(j * kShapeRows * coordinates_)];
}

// Adds h (bq / 2) h^T, what the modes give way at the end of a step. at_nodes: (node, node) m N-1.
void StepKernel::add_response(const Frame& frame, MatrixXd& at_nodes) const {
  const double* bq = &coefficients_.number[Coefficients::place(Coefficients::bq, 0, coordinates_)];
  const auto response = [&]<int kRows>(int i, int j) {
    return weighted<kRows>(shape_of(frame, i), shape_of(frame, j), bq, Coefficients::kSeldom, coordinates_);
  };
  for (int i = 0; i < frame.present; ++i)
    for (int j = 0; j <= i; ++j) {
      if (system_.lines) {
        const double share = response.operator()<1>(i, j)(0, 0);
        at_nodes(i, j) += share;
        if (i != j) at_nodes(j, i) += share;
        continue;
      }
      const Eigen::Matrix<double, kZoneNodes, kZoneNodes> share =
          shape_basis() * response.operator()<kShapeRows>(i, j) * shape_basis().transpose();
      at_nodes.block<kZoneNodes, kZoneNodes>(i * kZoneNodes, j * kZoneNodes) += share;
      if (i != j) at_nodes.block<kZoneNodes, kZoneNodes>(j * kZoneNodes, i * kZoneNodes) += share.transpose();
    }
}

// h (bq / 2) (L - h)^T, (shape row of all pairs, pair).
MatrixXd StepKernel::friction_response(const Frame& frame) const {
  const int rows = system_.lines ? 1 : kShapeRows;
  MatrixXd out = MatrixXd::Zero(frame.present * rows, frame.present);
  for (int i = 0; i < frame.present; ++i)
    for (int j = 0; j < frame.present; ++j) {
      const double *read = shape_of(frame, i),
                   *friction = &stream_[frame.friction + static_cast<size_t>(j * coordinates_)];
      for (int c = 0; c < coordinates_; ++c) {
        const int lane = c % kLanes, first = c - lane;
        const double half =
            0.5 * friction_ *
            coefficients_.number[Coefficients::place(Coefficients::bq, first, coordinates_) + lane];
        for (int r = 0; r < rows; ++r)
          out(i * rows + r, j) += half * read[first * rows + r * kLanes + lane] * friction[c];
      }
    }
  return out;
}

StripCompliance StepKernel::strip_compliance(const Frame& frame, const double* at_nodes) const {
  StripCompliance a;
  a.pairs = frame.present;
  a.strips = frame.of_pair;
  for (int j = 0; j < a.pairs; ++j) {
    a.half_plane[j] = &stream_[frame.pair[j].half_plane];
    a.interpolation[j] = &stream_[frame.pair[j].interpolation];
  }
  a.at_nodes = at_nodes;
  return a;
}

StripCompliance StepKernel::compliance(int sample) const {
  return strip_compliance(frame(position_of(sample)), step(sample).compliance.data());
}

StripCompliance StepKernel::instantaneous_compliance(int position) const {
  return strip_compliance(frame(position), &stream_[frame(position).instantaneous_compliance]);
}

void StepKernel::load_state(const StepState& state) {
  const Eigen::Index own = state.z.size();
  vectors_.z.head(own) = state.z;
  vectors_.v.head(own) = state.v;
  vectors_.force.head(own) = state.force;
  for (int side = 0; side < kSides; ++side) {
    vectors_.relaxed.segment(side * fields(), fields()) = state.relaxed[side].reshaped();
    vectors_.load.segment(side * fields(), fields()) = state.load[side].reshaped();
  }
  followed_ = 0;
  live_ = live_teeth();
}

void StepKernel::store_state(StepState& state, int strips) const {
  const Eigen::Index own = state.z.size();
  state.z = vectors_.z.head(own);
  state.v = vectors_.v.head(own);
  state.force = vectors_.force.head(own);
  for (int side = 0; side < kSides; ++side) {
    state.relaxed[side].reshaped() = vectors_.relaxed.segment(side * fields(), fields());
    state.load[side].reshaped() = vectors_.load.segment(side * fields(), fields());
  }
  state.p = p_.head(strips);
  state.d = d_.head(strips);
}

// teeth whose relaxed loads the others' round-off swallows have none from here on.
StepKernel::LiveTeeth StepKernel::live_teeth() {
  constexpr double kForgotten = 0x1p-80;
  const auto each = [&](int tooth, const auto& function) {
    for (VectorXd* x : {&vectors_.relaxed, &vectors_.load})
      for (int side = 0; side < kSides; ++side)
        function(x->segment<kFields>(side * fields() + tooth * kFields));
  };
  const auto size = [&](int tooth) {
    double sum = 0;
    each(tooth, [&](auto own) { sum += own.cwiseAbs().sum(); });
    return sum;
  };
  double all = 0;
  for (int tooth = 0; tooth < system_.teeth(); ++tooth) all += size(tooth);
  LiveTeeth live;
  for (int tooth = 0; tooth < system_.teeth(); ++tooth)
    if (!(size(tooth) <= kForgotten * all)) live.add(tooth);
  for (int tooth = 0; tooth < system_.teeth(); ++tooth)
    if (tooth < live.first || tooth >= live.last) each(tooth, [](auto own) { own.setZero(); });
  return live;
}

}  // namespace whine
