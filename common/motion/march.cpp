// A march through mesh periods: what a step streams, laid side by side by position, and the loops that run down it.
#include "motion/dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/refusal.h"
#include "contact/lanes.h"
#include "contact/line_contact.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const RollingDynamics::ShapeBasis& RollingDynamics::shape_basis() {
  static const ShapeBasis basis = [] {
    ShapeBasis b;
    for (int k = 0; k < kWindowNodes; ++k)
      for (int m = 0; m < kShapeRows; ++m)
        b(k, m) = std::sqrt((m > 0 ? 2.0 : 1.0) / kWindowNodes) *
                  std::cos(m * (2 * k + 1) * std::numbers::pi / (2 * kWindowNodes));
    return b;
  }();
  return basis;
}

void RollingDynamics::size_workspaces() {
  const int own = static_cast<int>(coordinates_.size()), coordinates = padded(own), fields = all_fields();
  int strips = kMostPairs, pairs = 1;
  for (const Position& position : positions_) {
    strips = std::max(strips, position.mesh.strips());
    pairs = std::max(pairs, static_cast<int>(position.mesh.pairs.size()));
  }
  Workspace& w = work_;
  for (VectorXd* x : {&w.z, &w.v, &w.force, &w.torque, &w.rest}) x->setZero(coordinates);
  w.torque.head(own) = torque_force_;
  for (VectorXd* x : {&w.lag, &w.load, &w.field, &w.moved_load}) x->setZero(2 * fields);
  for (VectorXd* x : {&w.e, &w.p, &w.d}) x->setZero(strips);
  w.nodes.setZero(pairs * kPairNodes);
  LedgerWorkspace& l = ledger_work_;
  for (Instant& instant : l.instants) {
    for (VectorXd* x : {&instant.z, &instant.v, &instant.force}) x->setZero(coordinates);
    for (VectorXd* x :
         {&instant.lag, &instant.load, &instant.field, &instant.moved_load, &instant.forgotten_field})
      x->setZero(2 * fields);
    for (VectorXd* x : {&instant.p, &instant.d, &instant.local}) x->setZero(strips);
    for (VectorXd* x : {&instant.moment, &instant.reading}) x->setZero(pairs * kLanes);
  }
  for (VectorXd* x : {&l.turned_back, &l.frequency_squared, &l.damping}) x->setZero(coordinates);
  l.frequency_squared.head(own) = frequency_squared_;
  for (int i = 0; i < own; ++i) l.damping[i] = coordinates_[i].damping;
  const auto turns_hub = [&](int lane) {
    for (int i = lane; i < std::min(lane + kLanes, own); ++i)
      if (error_weight_[i] != 0 || torque_force_[i] != 0) return true;
    return false;
  };
  HubLanes& hub = hub_lanes_;
  for (hub.first_end = 0; hub.first_end < coordinates && turns_hub(hub.first_end);) hub.first_end += kLanes;
  for (hub.second = hub.first_end; hub.second < coordinates && !turns_hub(hub.second);) hub.second += kLanes;
  for (hub.second_end = coordinates; hub.second_end > hub.second && !turns_hub(hub.second_end - kLanes);)
    hub.second_end -= kLanes;
}

RollingDynamics::StepSizes RollingDynamics::step_sizes(int i) const {
  const MeshPosition& mesh = positions_[i].mesh;
  StepSizes sizes;
  sizes.coordinates = padded(static_cast<int>(coordinates_.size()));
  sizes.pairs = static_cast<int>(mesh.pairs.size());
  sizes.rows = lines() ? 1 : kShapeRows;
  sizes.nodes = lines() ? 1 : kPairNodes;
  sizes.strips = sizes.pairs > 0 ? mesh.strips() / sizes.pairs : 0;
  for (int j = 0; !lines() && j < sizes.pairs; ++j)
    sizes.edges += mesh.pairs[j].low_is_edge || mesh.pairs[j].high_is_edge;
  sizes.fields = kFields;
  sizes.shared = kSharedFields;
  sizes.teeth = 2 * reach_ + 1;
  return sizes;
}

// Windows without an edge are alike if they are of one width; near a root they are narrower.
struct RollingDynamics::Windows {
  struct Place {
    double width;  // m
    size_t interpolation, half_plane;
  };
  std::vector<Place> inner;
  const Place* find(const PairStrips& s) const {
    constexpr double kSame = 1e-12;
    const double width = s.border[s.size()] - s.border[0];
    for (const Place& place : inner)
      if (std::abs(width - place.width) <= kSame * width) return &place;
    return nullptr;
  }
};

// Lays the numbers of each position side by side.
void RollingDynamics::pack() {
  stream_.clear();
  size_t most = 0;
  for (const Position& position : positions_) most += most_numbers(position);
  stream_.reserve(most);
  Windows known;
  for (Position& position : positions_)
    if (lines())
      pack_lines(position);
    else
      pack_strips(position, known);
}

namespace {

template <class Stream>
size_t place(Stream& stream, Eigen::Index count) {
  const size_t at = stream.size();
  stream.resize(at + static_cast<size_t>(count), 0.0);
  return at;
}

}  // namespace

// Where the numbers of one line stand, all lengths whole lanes.
struct RollingDynamics::LineRecord {
  int coordinates, fields;               // of all pairs
  static constexpr int kGap = 0;         // m
  static constexpr int kMost = 1;        // N: beyond it neither Hertz's law nor the flanks hold
  static constexpr int kShape = kLanes;  // (coordinate)
  // m N-1: (shared field) of a tooth, one gear after the other so that live teeth stand together; (other field) of its own
  int reading(int g, int tooth) const { return kShape + coordinates + (2 * tooth + g) * kSharedFields; }
  int own_reading(int g) const { return reading(0, fields / kFields) + g * (kFields - kSharedFields); }
  int weight(int g) const { return own_reading(2) + g * kFields; }  // (field of its own)
  int size() const { return weight(2); }
};

void RollingDynamics::pack_lines(Position& position) {
  const MeshPosition& mesh = position.mesh;
  const LineRecord record{padded(static_cast<int>(coordinates_.size())), all_fields()};
  position.frame.line = place(stream_, static_cast<int>(mesh.pairs.size()) * record.size());
  for (size_t j = 0; j < mesh.pairs.size(); ++j) {
    double* at = &stream_[position.frame.line + j * record.size()];
    const PairContact& contact = mesh.pairs[j].contact;
    at[LineRecord::kGap] = mesh.gap[j];
    at[LineRecord::kMost] =
        std::min(mesh.law[j].largest_force(), mesh.law[j].force(contact.x_max - contact.x_min));
    const auto row = [at](int offset, Eigen::Index n) {
      return Eigen::Map<Eigen::RowVectorXd>(at + offset, n);
    };
    row(LineRecord::kShape, position.participation.cols()) = position.participation.row(j);
    for (int g = 0; g < 2; ++g) {
      const auto weight = position.field_weight[g].row(j);
      for (int tooth = 0; tooth <= 2 * reach_; ++tooth) {
        const MatrixXd& block = coupling(g, position.frame.pair[j].slot - tooth);
        const Eigen::RowVectorXd reading = weight.head(block.rows()) * block;
        row(record.reading(g, tooth), kSharedFields) = reading.head(kSharedFields);
        if (tooth == position.frame.pair[j].slot)
          row(record.own_reading(g), kFields - kSharedFields) = reading.tail(kFields - kSharedFields);
      }
      row(record.weight(g), kFields) = weight;
    }
  }
}

void RollingDynamics::pack_gap(const Position& position) {
  const MeshPosition& mesh = position.mesh;
  if (!lines()) {
    std::copy(mesh.gap.begin(), mesh.gap.end(),
              stream_.begin() + static_cast<std::ptrdiff_t>(position.frame.gap));
    return;
  }
  const LineRecord record{padded(static_cast<int>(coordinates_.size())), all_fields()};
  for (size_t j = 0; j < mesh.pairs.size(); ++j)
    stream_[position.frame.line + j * record.size() + LineRecord::kGap] = mesh.gap[j];
}

// A window's basis in lanes: what a pair's shape rows move its nodes by, and what its nodes' forces are in them.
struct RollingDynamics::ShapeLanes {
  double column[kShapeRows][kPairNodes] = {}, row[kPairNodes][kLanes] = {};
  ShapeLanes() {
    for (int k = 0; k < kWindowNodes; ++k)
      for (int m = 0; m < kShapeRows; ++m) column[m][k] = row[k][m] = shape_basis()(k, m);
  }
  // m: (kPairNodes) of nodes that are moved by -moved (shape row).
  void put_moved(const double* moved, double* at_node) const {
    static_assert(kShapeRows == 2 && kPairNodes == 2 * kLanes);
    lanes(at_node) = -(moved[0] * lanes(column[0]) + moved[1] * lanes(column[1]));
    lanes(at_node + kLanes) = -(moved[0] * lanes(column[0] + kLanes) + moved[1] * lanes(column[1] + kLanes));
  }
  Lanes moments(const double* nodes) const {
    static_assert(kWindowNodes == 6);
    return (nodes[0] * lanes(row[0]) + nodes[1] * lanes(row[1]) + nodes[2] * lanes(row[2])) +
           (nodes[3] * lanes(row[3]) + nodes[4] * lanes(row[4]) + nodes[5] * lanes(row[5]));
  }
};
const RollingDynamics::ShapeLanes RollingDynamics::kShape;

void RollingDynamics::pack_strips(Position& position, Windows& known) {
  const int coordinates = padded(static_cast<int>(coordinates_.size()));
  const MeshPosition& mesh = position.mesh;
  const int pairs = static_cast<int>(mesh.pairs.size());
  position.frame.gap = place(stream_, mesh.strips());
  std::copy(mesh.gap.begin(), mesh.gap.end(),
            stream_.begin() + static_cast<std::ptrdiff_t>(position.frame.gap));
  position.frame.at_once = place(stream_, pairs * kPairNodes * pairs * kWindowNodes);
  put_at_nodes(position.at_once, &stream_[position.frame.at_once]);
  position.frame.shape = place(stream_, pairs * kShapeRows * coordinates);
  for (int j = 0; j < pairs; ++j) {
    const MatrixXd shape =
        shape_basis().transpose() * position.participation.middleRows<kWindowNodes>(j * kWindowNodes);
    double* rows = &stream_[position.frame.shape + j * kShapeRows * coordinates];
    for (int c = 0; c < shape.cols(); ++c)
      for (int r = 0; r < kShapeRows; ++r)
        rows[(c / kLanes * kShapeRows + r) * kLanes + c % kLanes] = shape(r, c);
    const PairStrips& s = mesh.pairs[j];
    const bool edge = s.low_is_edge || s.high_is_edge;
    Frame::Pair& pair = position.frame.pair[j];
    const Windows::Place* alike = edge ? nullptr : known.find(s);
    if (alike) {
      pair.interpolation = alike->interpolation;
      pair.half_plane = alike->half_plane;
    } else {
      pair.interpolation = place(stream_, s.size() * kPairNodes);
      for (int k = 0; k < kWindowNodes; ++k)
        for (int i = 0; i < s.size(); ++i)
          stream_[pair.interpolation + k * s.size() + i] = s.interpolation(i, k);
      const MatrixXd half_plane = half_plane_compliance(
          s, model_.gear[0].half_plane(), model_.gear[1].half_plane(), parameters_.damping.undamped_depth);
      pair.half_plane = place(stream_, half_plane.size());
      std::copy(half_plane.data(), half_plane.data() + half_plane.size(),
                stream_.begin() + static_cast<std::ptrdiff_t>(pair.half_plane));
      if (!edge)
        known.inner.push_back({s.border[s.size()] - s.border[0], pair.interpolation, pair.half_plane});
    }
    position.frame.pair[j].field = place(stream_, 2 * kPairNodes * kFields);
    for (int g = 0; g < 2; ++g) {
      const size_t at = position.frame.pair[j].field + g * kPairNodes * kFields;
      for (int r = 0; r < kFields; ++r)
        for (int k = 0; k < kWindowNodes; ++k)
          stream_[at + r * kPairNodes + k] = position.field_weight[g](j * kWindowNodes + k, r);
    }
  }
}

// That a position may take of the stream, if no other has a window like its own.
size_t RollingDynamics::most_numbers(const Position& position) const {
  const int coordinates = padded(static_cast<int>(coordinates_.size())), pairs = position.frame.present,
            strips = position.frame.of_pair;
  if (lines()) return static_cast<size_t>(pairs * LineRecord{coordinates, all_fields()}.size());
  return static_cast<size_t>(pairs) *
         static_cast<size_t>(strips + kPairNodes * pairs * kWindowNodes + kShapeRows * coordinates +
                             strips * kPairNodes + strips * strips + 2 * kPairNodes * kFields);
}

// Lays (node, node) out as StripCompliance::at_nodes, whose other rows stay 0.
void RollingDynamics::put_at_nodes(const MatrixXd& at_nodes, double* to) {
  const auto pairs = at_nodes.cols() / kWindowNodes;
  for (Eigen::Index c = 0; c < at_nodes.cols(); ++c)
    for (Eigen::Index j = 0; j < pairs; ++j, to += kPairNodes)
      for (int k = 0; k < kWindowNodes; ++k) to[k] = at_nodes(j * kWindowNodes + k, c);
}

StripCompliance RollingDynamics::strip_compliance(const Position& position, const double* at_nodes) const {
  StripCompliance a;
  a.pairs = position.frame.present;
  a.strips = position.frame.of_pair;
  for (int j = 0; j < a.pairs; ++j) {
    a.half_plane[j] = &stream_[position.frame.pair[j].half_plane];
    a.interpolation[j] = &stream_[position.frame.pair[j].interpolation];
  }
  a.at_nodes = at_nodes;
  return a;
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

// Adds h (bq / 2) h^T, what the modes give way at the end of a step. at_nodes: (node, node) m N-1.
void RollingDynamics::add_response(const Position& position, MatrixXd& at_nodes) {
  const int coordinates = padded(static_cast<int>(coordinates_.size())), present = position.frame.present;
  const double* bq = &speed_.number[SpeedCoefficients::place(SpeedCoefficients::bq, 0, coordinates)];
  const LineRecord record{coordinates, all_fields()};
  const auto row = [&](int j) {
    return lines() ? &stream_[position.frame.line + j * record.size() + LineRecord::kShape]
                   : &stream_[position.frame.shape + j * kShapeRows * coordinates];
  };
  for (int i = 0; i < present; ++i)
    for (int j = 0; j <= i; ++j) {
      if (lines()) {
        const double share = weighted<1>(row(i), row(j), bq, SpeedCoefficients::kSeldom, coordinates)(0, 0);
        at_nodes(i, j) += share;
        if (i != j) at_nodes(j, i) += share;
        continue;
      }
      const Eigen::Matrix<double, kWindowNodes, kWindowNodes> share =
          shape_basis() * weighted<kShapeRows>(row(i), row(j), bq, SpeedCoefficients::kSeldom, coordinates) *
          shape_basis().transpose();
      at_nodes.block<kWindowNodes, kWindowNodes>(i * kWindowNodes, j * kWindowNodes) += share;
      if (i != j)
        at_nodes.block<kWindowNodes, kWindowNodes>(j * kWindowNodes, i * kWindowNodes) += share.transpose();
    }
}

void RollingDynamics::turn_doublets(double* y, int direction) const {
  for (const Turn& turn : turns_) {
    if (turn.sine < 0) {
      y[turn.cosine] = -y[turn.cosine];
    } else {
      // Z = cosine - i sine turns by exp(i turn).
      const double cosine = y[turn.cosine], sine = y[turn.sine], s = direction * turn.s;
      y[turn.cosine] = turn.c * cosine + s * sine;
      y[turn.sine] = turn.c * sine - s * cosine;
    }
  }
}

void RollingDynamics::advance_fields(double* fields) const {
  const int of_gear = all_fields();
  for (int g = 0; g < 2; ++g) {
    double* own = fields + g * of_gear;
    std::copy_backward(own, own + of_gear - kFields, own + of_gear);
    std::fill(own, own + kFields,
              0.0);  // a tooth that comes into reach was unloaded for longer than any lag lasts
  }
}

Lanes RollingDynamics::reading(const Position& position, size_t j, const double* z) const {
  const int coordinates = padded(static_cast<int>(coordinates_.size()));
  if (!lines())
    return dot_rows<kShapeRows>(&stream_[position.frame.shape + j * kShapeRows * coordinates], coordinates,
                                z);
  const LineRecord record{coordinates, all_fields()};
  return dot_rows<1>(&stream_[position.frame.line + j * record.size() + LineRecord::kShape], coordinates, z);
}

Lanes RollingDynamics::collect(const Position& position, size_t j, const double* p, double* fields) const {
  const int coordinates = padded(static_cast<int>(coordinates_.size()));
  if (lines()) {
    const LineRecord record{coordinates, all_fields()};
    const double* line = &stream_[position.frame.line + j * record.size()];
    for (int g = 0; g < 2; ++g)
      for (int k = 0; k < kFields; k += kLanes)
        lanes(fields + g * kFields + k) = p[0] * lanes(line + record.weight(g) + k);
    return Lanes{p[0]};
  }
  const int of_pair = position.frame.of_pair;
  double nodes[kPairNodes];
  dot_columns(nodes, &stream_[position.frame.pair[j].interpolation], of_pair, kPairNodes, p, of_pair);
  for (int g = 0; g < 2; ++g)
    dot_columns(fields + g * kFields, &stream_[position.frame.pair[j].field + g * kPairNodes * kFields],
                kPairNodes, kFields, nodes, kPairNodes);
  return kShape.moments(nodes);
}

void RollingDynamics::add_displacement(int g, int offset, const double* loads, double* field) const {
  const double* columns = coupling(g, offset).data();
  if (offset == 0)
    add_columns_of_12(field, columns, kFields, loads, kFields);
  else
    add_columns_of_8(field, columns, loads, kSharedFields);
}

void RollingDynamics::displace(int g, const double* loads, double* field) const {
  std::fill(field, field + all_fields(), 0.0);
  for (int from = 0; from <= 2 * reach_; ++from, loads += kFields) {
    if (std::all_of(loads, loads + kFields, [](double x) { return x == 0; })) continue;
    for (int tooth = 0; tooth <= 2 * reach_; ++tooth)
      add_displacement(g, tooth - from, loads, field + tooth * kFields);
  }
}

namespace {

// Contact forces on the modes: h^T p as a sum over pairs, of each some rows of coordinates that stand side by side. Factors
// are halved: the mean force over a step is that of the torques less half of what comes new at its end, and half of what
// went before.
struct ModalLoad {
  int count = 0;
  const double* rows[kMostPairs];
  Lanes half[kMostPairs];
  void add(const double* rows_of, Lanes factor) {
    rows[count] = rows_of;
    half[count++] = 0.5 * factor;
  }
};

// What modes move pairs by: rows as above, and m.
template <int kRows>
struct ModalReading {
  int count = 0;
  const double* rows[kMostPairs];
  double moved[kMostPairs][kRows];
};

}  // namespace

// Columns of lag and load, first to last - 1, outside which no tooth has any.
struct RollingDynamics::LiveTeeth {
  int first = 0, last = 0;
  void add(int slot) {
    if (first == last) first = last = slot;
    first = std::min(first, slot);
    last = std::max(last, slot + 1);
  }
};

// Teeth whose lag the others' round-off swallows have none from here on.
RollingDynamics::LiveTeeth RollingDynamics::live_teeth() {
  constexpr double kForgotten = 0x1p-80;
  const int teeth = 2 * reach_ + 1;
  const auto size = [&](int tooth) {
    double sum = 0;
    for (const VectorXd* x : {&work_.lag, &work_.load})
      for (int g = 0; g < 2; ++g)
        sum += x->segment<kFields>(g * all_fields() + tooth * kFields).cwiseAbs().sum();
    return sum;
  };
  double all = 0;
  for (int tooth = 0; tooth < teeth; ++tooth) all += size(tooth);
  LiveTeeth live;
  for (int tooth = 0; tooth < teeth; ++tooth)
    if (!(size(tooth) <= kForgotten * all)) live.add(tooth);
  for (int tooth = 0; tooth < teeth; ++tooth)
    if (tooth < live.first || tooth >= live.last)
      for (VectorXd* x : {&work_.lag, &work_.load})
        for (int g = 0; g < 2; ++g) x->segment<kFields>(g * all_fields() + tooth * kFields).setZero();
  return live;
}

// Modal vectors of a march and what a step does to them. A pair has kRows rows.
template <int kRows>
struct RollingDynamics::Modes {
  using Reading = ModalReading<kRows>;
  int coordinates;
  double *z, *v, *force;
  const double* coefficients;
  HubLanes hub;

  // To the next instant, without new contact force.
  void propagate() const {
    for (int c = 0; c < coordinates; c += kLanes) {
      go_on(c, lanes(z + c), lanes(v + c), 0.5 * (lanes(force + c) + of(c, SpeedCoefficients::torque)));
    }
  }

  // The new contact force's own share. m: transmission error.
  double push(const ModalLoad& load) const {
    Lanes error{};
    for (int c = 0; c < coordinates; c += kLanes) {
      Lanes half{};
      for (int j = 0; j < load.count; ++j)
        for (int r = 0; r < kRows; ++r)
          half += load.half[j][r] * lanes(load.rows[j] + c * kRows + r * kLanes);
      const Lanes z1 = lanes(z + c) - of(c, SpeedCoefficients::bq) * half;
      lanes(v + c) -= of(c, SpeedCoefficients::a12) * half;
      lanes(z + c) = z1;
      lanes(force + c) = of(c, SpeedCoefficients::torque) - 2 * half;
      error += of(c, SpeedCoefficients::weight) * z1;
    }
    return sum(error);
  }

  // Both in one go, and `next` read off what comes out while it is in registers; the force itself is not kept.
  // rest: (coordinate), of the loads of more pairs than there are registers.
  double push_and_propagate(const ModalLoad& load, Reading& next, double* rest) const {
    switch (load.count) {
      case 0:
        return both<0, kRows>(load.rows, load.half, next);
      case 1:
        return both<1, kRows>(load.rows, load.half, next);
      case 2:
        return both<2, kRows>(load.rows, load.half, next);
      default:
        break;
    }
    std::fill(rest, rest + coordinates, 0.0);
    for (int j = 0; j < load.count; ++j)
      for (int c = 0; c < coordinates; c += kLanes)
        for (int r = 0; r < kRows; ++r)
          lanes(rest + c) += load.half[j][r] * lanes(load.rows[j] + c * kRows + r * kLanes);
    const double* row = rest;
    const Lanes one{1};
    return both<1, 1>(&row, &one, next);
  }

  void read(Reading& reading) const {
    for (int j = 0; j < reading.count; ++j) {
      const Lanes moved = dot_rows<kRows>(reading.rows[j], coordinates, z);
      for (int r = 0; r < kRows; ++r) reading.moved[j][r] = moved[r];
    }
  }

 private:
  const Lanes& of(int c, SpeedCoefficients::Of which) const {
    return lanes(coefficients + SpeedCoefficients::place(which, c, coordinates));
  }
  Lanes go_on(int c, Lanes z0, Lanes v0, Lanes mean) const {
    const Lanes bq = of(c, SpeedCoefficients::bq), a12 = of(c, SpeedCoefficients::a12),
                z1 = of(c, SpeedCoefficients::a11) * z0 + a12 * v0 + bq * mean;
    lanes(z + c) = z1;
    lanes(v + c) = of(c, SpeedCoefficients::a21) * z0 + of(c, SpeedCoefficients::a22) * v0 + a12 * mean;
    return z1;
  }
  template <int kCount, int kRowsEach>
  double both(const double* const* rows, const Lanes* factor, Reading& next) const {
    switch (next.count) {
      case 0:
        return both<kCount, kRowsEach, 0>(rows, factor, next);
      case 2:
        return both<kCount, kRowsEach, 2>(rows, factor, next);
      case 3:
        return both<kCount, kRowsEach, 3>(rows, factor, next);
      default:
        break;
    }
    const double error = both<kCount, kRowsEach, 0>(rows, factor, next);
    read(next);
    return error;
  }
  template <int kCount, int kRowsEach, int kRead>
  double both(const double* const* rows, const Lanes* factor, Reading& next) const {
    const Modes here = *this;  // stores of lanes may change anything for all that the compiler knows
    const double *row[kCount + 1], *read_row[kRead + 1];
    double f[kCount + 1][kRowsEach];
    for (int j = 0; j < kCount; ++j) {
      row[j] = rows[j];
      for (int r = 0; r < kRowsEach; ++r) f[j][r] = factor[j][r];
    }
    for (int j = 0; j < kRead; ++j) read_row[j] = next.rows[j];
    Lanes error{}, moved[kRead + 1][kRows] = {};
    const auto run = [&](auto with_hub, int from, int to) __attribute__((always_inline)) {
      for (int c = from; c < to; c += kLanes) {
        Lanes half{};
        for (int j = 0; j < kCount; ++j)
          for (int r = 0; r < kRowsEach; ++r) half += f[j][r] * lanes(row[j] + c * kRowsEach + r * kLanes);
        const Lanes z0 = lanes(here.z + c), v0 = lanes(here.v + c);
        Lanes z2;
        if constexpr (with_hub) {
          const Lanes z1 = z0 - here.of(c, SpeedCoefficients::bq) * half;
          error += here.of(c, SpeedCoefficients::weight) * z1;
          z2 = here.go_on(c, z1, v0 - here.of(c, SpeedCoefficients::a12) * half,
                          here.of(c, SpeedCoefficients::torque) - half);
        } else {
          z2 = here.of(c, SpeedCoefficients::a11) * z0 + here.of(c, SpeedCoefficients::a12) * v0 -
               here.of(c, SpeedCoefficients::push_z) * half;
          lanes(here.z + c) = z2;
          lanes(here.v + c) = here.of(c, SpeedCoefficients::a21) * z0 +
                              here.of(c, SpeedCoefficients::a22) * v0 -
                              here.of(c, SpeedCoefficients::push_v) * half;
        }
        for (int j = 0; j < kRead; ++j)
          for (int r = 0; r < kRows; ++r) moved[j][r] += z2 * lanes(read_row[j] + c * kRows + r * kLanes);
      }
    };
    run(std::true_type{}, 0, here.hub.first_end);
    run(std::false_type{}, here.hub.first_end, here.hub.second);
    run(std::true_type{}, here.hub.second, here.hub.second_end);
    run(std::false_type{}, here.hub.second_end, here.coordinates);
    for (int j = 0; j < kRead; ++j)
      for (int r = 0; r < kRows; ++r) next.moved[j][r] = sum(moved[j][r]);
    return sum(error);
  }
};

struct RollingDynamics::StripContact {
  static constexpr int kRows = kShapeRows;
  using Reading = ModalReading<kRows>;

  explicit StripContact(RollingDynamics& of)
      : dynamics(of),
        coordinates(padded(static_cast<int>(of.coordinates_.size()))),
        fields(of.all_fields()),
        e(of.work_.e),
        p(of.work_.p),
        d(of.work_.d),
        nodes(of.work_.nodes) {}

  void rename() { followed = 0; }

  // All that can be known of a position before its modes are: its lag, and a start; and which rows of the modes to read. lag:
  // (field of all pairs) of one gear after the other, without new contact force; no tooth but the live ones has any.
  void read_ahead(const Position& position, Step&, const double* lag, LiveTeeth, Reading& modal) {
    follow(position, lag);
    const double* rows = dynamics.stream_.data() + position.frame.shape;
    modal.count = position.frame.present;
    for (int j = 0; j < modal.count; ++j) modal.rows[j] = rows + j * kShapeRows * coordinates;
  }

  // Fills p and d. modal: the rows of read_ahead, without new contact force.
  Certificate solve(const Position& position, Step& step, const Reading& modal) {
    const double* stream = dynamics.stream_.data();
    const int present = position.frame.present, of_pair = position.frame.of_pair, strips = present * of_pair;
    for (int j = 0; j < present; ++j) {
      double at_node[kPairNodes];
      kShape.put_moved(modal.moved[j], at_node);
      for (int g = 0; g < 2; ++g)
        add_columns_of_8(at_node, stream + position.frame.pair[j].field + g * kPairNodes * kFields,
                         field_of(position, g, j), kFields);
      add_six_columns(e.data() + j * of_pair, stream + position.frame.gap + j * of_pair,
                      stream + position.frame.pair[j].interpolation, of_pair, at_node, 1, of_pair);
    }
    const StripCompliance a = dynamics.strip_compliance(position, step.compliance.data());
    return dynamics.solver_.solve(a, e.head(strips), step.active, p.head(strips), d.head(strips),
                                  nodes.data());
  }

  // N, of pair j. False if force stands on a window's end that is no tip edge.
  bool carried(const Position& position, int j, double& force) {
    const Frame::Pair& pair = position.frame.pair[j];
    const int of_pair = position.frame.of_pair;
    const double* own = &p[j * of_pair];
    if ((!pair.low_is_edge && own[0] > 0) || (!pair.high_is_edge && own[of_pair - 1] > 0)) return false;
    Lanes total{};
    for (int k = 0; k < of_pair; k += kLanes) total += lanes(own + k);
    force = sum(total);
    return true;
  }

  // After `carried` of all pairs, force: (pair) N. load: as lag, of the pairs that have force; `share` of it goes to the lag.
  void spread(const Position& position, const double* force, double* load, double share, double* lag,
              ModalLoad& on_modes) {
    const double* stream = dynamics.stream_.data();
    const int present = position.frame.present;
    on_modes.count = 0;
    for (int j = 0; j < present; ++j) {
      if (force[j] == 0) continue;
      const double* own = &nodes[j * kPairNodes];
      on_modes.add(stream + position.frame.shape + j * kShapeRows * coordinates, kShape.moments(own));
      for (int g = 0; g < 2; ++g)
        dot_columns(load + g * fields + position.frame.pair[j].slot * kFields,
                    stream + position.frame.pair[j].field + g * kPairNodes * kFields, kPairNodes, kFields,
                    own, kPairNodes);
    }
    for (int g = 0; g < 2; ++g)
      for (int i = 0; i < present; ++i) {
        double* moved = moved_of(position, g, i);
        for (int k = 0; k < kFields; k += kLanes) lanes(moved + k) = Lanes{};
        for (int j = 0; j < present; ++j)
          if (force[j] != 0)
            dynamics.add_displacement(g, position.frame.pair[i].slot - position.frame.pair[j].slot,
                                      load + g * fields + position.frame.pair[j].slot * kFields, moved);
        const int at = g * fields + position.frame.pair[i].slot * kFields;
        for (int k = at; force[i] != 0 && k < at + kFields; k += kLanes)
          lanes(lag + k) += share * lanes(load + k);
      }
  }

  RollingDynamics& dynamics;
  int coordinates, fields;
  VectorXd &e, &p, &d;  // (strip)
  VectorXd& nodes;      // (node) forces, filled with p

 private:
  double* field_of(const Position& position, int g, int j) const {
    return &dynamics.work_.field[g * fields + position.frame.pair[j].slot * kFields];
  }
  double* moved_of(const Position& position, int g, int j) const {
    return &dynamics.work_.moved_load[g * fields + position.frame.pair[j].slot * kFields];
  }
  // The displacement of the teeth that are present by all lagged loads: as the lag itself goes on, or anew.
  void follow(const Position& position, const double* lag) {
    const Lag step = dynamics.lag_;
    unsigned long now = 0;
    for (int j = 0; j < position.frame.present; ++j) {
      const int slot = position.frame.pair[j].slot;
      now |= 1ul << slot;
      for (int g = 0; g < 2; ++g) {
        double* field = field_of(position, g, j);
        if (followed >> slot & 1) {
          const double* moved = moved_of(position, g, j);
          for (int k = 0; k < kFields; k += kLanes)
            lanes(field + k) = step.decay * lanes(field + k) +
                               (step.from_new * step.decay + step.from_old) * lanes(moved + k);
          continue;
        }
        for (int k = 0; k < kFields; k += kLanes) lanes(field + k) = Lanes{};
        for (int tooth = 0; tooth <= 2 * dynamics.reach_; ++tooth)
          dynamics.add_displacement(g, slot - tooth, lag + g * fields + tooth * kFields, field);
      }
    }
    followed = now;
  }
  unsigned long followed = 0;  // bit: pair + reach, whose displacement is that of the step before
};

// Strips whose problems are kept.
struct RollingDynamics::RecordedContact : StripContact {
  RecordedContact(RollingDynamics& of, std::vector<ContactProblem>& to) : StripContact(of), problems(to) {}
  Certificate solve(const Position& position, Step& step, const Reading& modal) {
    const Certificate certificate = StripContact::solve(position, step, modal);
    const StripCompliance a = dynamics.strip_compliance(position, step.compliance.data());
    problems.push_back({MatrixXd(a.size(), a.size()), e.head(a.size()), step.active});
    a.assemble(problems.back().compliance.data());
    return certificate;
  }
  std::vector<ContactProblem>& problems;
};

std::vector<RollingDynamics::ContactProblem> RollingDynamics::contact_problems(State& state) {
  std::vector<ContactProblem> problems;
  Period period;
  if (lines() || !march(RecordedContact(*this, problems), state, period, nullptr))
    fail(Failure::numerical, "no period of strips to take contact problems from");
  return problems;
}

struct RollingDynamics::LineContact {
  static constexpr int kRows = 1;
  using Reading = ModalReading<kRows>;

  explicit LineContact(RollingDynamics& of)
      : dynamics(of),
        record{padded(static_cast<int>(of.coordinates_.size())), of.all_fields()},
        e(of.work_.e),
        p(of.work_.p),
        d(of.work_.d) {}

  void rename() {}

  // As of strips, all four.
  void read_ahead(const Position& position, Step& step, const double* lag, LiveTeeth live, Reading& modal) {
    const double* line = dynamics.stream_.data() + position.frame.line;
    modal.count = position.frame.present;
    for (int j = 0; j < modal.count; ++j, line += record.size()) {
      modal.rows[j] = line + LineRecord::kShape;
      const double *driver_lag = lag + position.frame.pair[j].slot * kFields + kSharedFields,
                   *driven_lag = driver_lag + record.fields;
      static_assert(kFields - kSharedFields == kLanes);
      Lanes driver = lanes(line + record.own_reading(0)) * lanes(driver_lag),
            driven = lanes(line + record.own_reading(1)) * lanes(driven_lag);
      for (int tooth = live.first; tooth < live.last; ++tooth) {
        const double *driver_row = line + record.reading(0, tooth), *driven_row = driver_row + kSharedFields;
        driver_lag = lag + tooth * kFields;
        driven_lag = driver_lag + record.fields;
        for (int k = 0; k < kSharedFields; k += kLanes) {
          driver += lanes(driver_row + k) * lanes(driver_lag + k);
          driven += lanes(driven_row + k) * lanes(driven_lag + k);
        }
      }
      e[j] = line[LineRecord::kGap] + sum(driver + driven);
    }
    if (step.start.known()) return;
    if (step.force.size() != modal.count) step.force.setZero(modal.count);
    step.start.look(step.compliance, position.frame.law, step.force);
  }

  Certificate solve(const Position& position, Step& step, const Reading& modal) {
    const int present = position.frame.present;
    for (int j = 0; j < present; ++j) e[j] -= modal.moved[j][0];
    const Certificate certificate = solve_line_contact(step.compliance, position.frame.law, e.head(present),
                                                       step.start, step.force, d.head(present));
    for (int j = 0; j < present; ++j) p[j] = step.force[j];
    return certificate;
  }

  bool carried(const Position& position, int j, double& force) const {
    force = p[j];
    if (!(force <= dynamics.stream_[position.frame.line + j * record.size() + LineRecord::kMost]))
      require_line_range(position.mesh, p.head(position.mesh.strips()));
    return true;
  }

  void spread(const Position& position, const double* force, double* load, double share, double* lag,
              ModalLoad& on_modes) const {
    const int present = position.frame.present;
    const double* line = dynamics.stream_.data() + position.frame.line;
    on_modes.count = 0;
    for (int j = 0; j < present; ++j, line += record.size()) {
      if (force[j] == 0) continue;
      on_modes.add(line + LineRecord::kShape, Lanes{force[j]});
      for (int g = 0; g < 2; ++g) {
        const int at = g * record.fields + position.frame.pair[j].slot * kFields;
        for (int k = 0; k < kFields; k += kLanes) {
          const Lanes own = force[j] * lanes(line + record.weight(g) + k);
          lanes(load + at + k) = own;
          lanes(lag + at + k) += share * own;
        }
      }
    }
  }

  RollingDynamics& dynamics;
  LineRecord record;
  VectorXd &e, &p, &d;  // (pair)
};

void RollingDynamics::take(const State& state) {
  const int own = static_cast<int>(coordinates_.size()), fields = all_fields();
  work_.z.head(own) = state.z;
  work_.v.head(own) = state.v;
  work_.force.head(own) = state.force;
  for (int g = 0; g < 2; ++g) {
    work_.lag.segment(g * fields, fields) = state.lag[g].reshaped();
    work_.load.segment(g * fields, fields) = state.load[g].reshaped();
  }
}

void RollingDynamics::give(State& state) const {
  const int own = static_cast<int>(coordinates_.size()), fields = all_fields();
  state.z = work_.z.head(own);
  state.v = work_.v.head(own);
  state.force = work_.force.head(own);
  for (int g = 0; g < 2; ++g) {
    state.lag[g].reshaped() = work_.lag.segment(g * fields, fields);
    state.load[g].reshaped() = work_.load.segment(g * fields, fields);
  }
}

bool RollingDynamics::march(State& state, Period& period, Ledger* ledger) {
  if (state.z.size() != frequency_squared_.size() || state.pair != pair_stamp_)
    fail(Failure::input, "the start state, of ", state.z.size(),
         " coordinates, is of other gears or modes: ", "these have ", frequency_squared_.size(),
         "; start from rest or from a state of the same pair");
  if (ledger && state.p.size() != positions_[0].mesh.strips())
    fail(Failure::input,
         "the ledger needs the contact forces of the start state at each strip: it has those of ",
         state.p.size(), " strips, the range has ", positions_[0].mesh.strips(),
         "; march a period without a ledger first");
  try {
    return lines() ? march(LineContact(*this), state, period, ledger)
                   : march(StripContact(*this), state, period, ledger);
  } catch (const Error& error) {
    const std::string words = error.what(), start = "at mesh phase ";
    if (words.rfind(start, 0) == 0) throw;
    fail_as(error, start, positions_[sample_ * stride_].mesh.phase, " ", words);
  }
}

template <class Contact>
bool RollingDynamics::march(Contact contact, State& state, Period& period, Ledger* ledger) {
  const int pairs = 2 * reach_ + 1, coordinates = padded(static_cast<int>(coordinates_.size())),
            fields = kFields * pairs;
  period.transmission_error.resize(steps_);
  period.pair_load.setZero(pairs, steps_);
  for (int g = 0; g < 2; ++g)
    if (sway_[g].count > 0) period.bearing_force[g].resize(2, steps_);
  period.drift_force = period.least_gap = period.least_force = 0;
  period.fallbacks = 0;
  for (int g = 0; g < 2; ++g)
    if (const int known = static_cast<int>(state.lag[g].cols()); known != pairs)  // of another range
      for (MatrixXd* field : {&state.lag[g], &state.load[g]}) {
        const int kept = std::min(known, pairs);
        MatrixXd other = MatrixXd::Zero(field->rows(), pairs);
        other.middleCols((pairs - kept) / 2, kept) = field->middleCols((known - kept) / 2, kept);
        *field = other;
      }
  take(state);

  const Modes<Contact::kRows> modes{coordinates,        work_.z.data(),       work_.v.data(),
                                    work_.force.data(), speed_.number.data(), hub_lanes_};
  // Stores of lanes may change anything for all that the compiler knows; it need not look these up again.
  double *const lag_at = work_.lag.data(), *const load_at = work_.load.data();
  const Lag lag_step = lag_;
  const double share_ahead = lag_step.decay * lag_step.from_new + lag_step.from_old;
  ModalLoad on_modes;
  ModalReading<Contact::kRows> modal;
  LiveTeeth live = live_teeth();
  const auto relax = [&](bool loaded) {
    for (int g = 0; g < 2; ++g)
      for (int k = g * fields + live.first * kFields; k < g * fields + live.last * kFields; k += kLanes) {
        lanes(lag_at + k) *= lag_step.decay;
        if (loaded) lanes(lag_at + k) += lag_step.from_old * lanes(load_at + k);
      }
  };

  set_gap(positions_[0], state.period);
  std::array<Instant, 2>& instants = ledger_work_.instants;
  ledger_work_.balance = 0;
  if (ledger) fill(instants[0], nullptr, positions_[0], state.p.data(), state.d.data());
  bool propagated = false;
  for (int i = 1; i <= steps_; ++i) {
    const int sample = i == steps_ ? 0 : i;
    if (sample == 0) {
      for (double* y : {modes.z, modes.v, modes.force}) turn_doublets(y);
      for (double* x : {lag_at, load_at}) advance_fields(x);
      contact.rename();
      live = {live.first + (live.first < live.last), std::min(live.last + 1, pairs)};
      if (ledger) rename(instants[(i - 1) % 2]);
      state.period = (state.period + 1) % hunting_;
    }
    sample_ = sample;
    Position& position = positions_[sample * stride_];
    const int present = position.frame.present;
    // Where nobody looks at the instant that this step ends at, the next one begins before its contact is known.
    const bool ahead = !ledger && !floating_ && i + 1 < steps_;

    // What the step would bring without new contact force.
    if (!propagated) {
      set_gap(position, state.period);
      modes.propagate();
      relax(true);
      contact.read_ahead(position, step_data_[sample], lag_at, live, modal);
      modes.read(modal);
    }
    if (ahead) relax(false);
    const Certificate certificate = contact.solve(position, step_data_[sample], modal);
    period.least_gap = std::min(period.least_gap, certificate.least_gap);
    period.least_force = std::min(period.least_force, certificate.least_force);
    period.fallbacks += certificate.fallback;

    // The new force's own share.
    double drift = 0, carried[kMostPairs];
    for (int j = 0; j < present; ++j) {
      if (!contact.carried(position, j, carried[j])) return false;
      period.pair_load(position.frame.pair[j].slot, sample) = carried[j];
      drift += position.frame.pair[j].drift_lever * carried[j];
      if (carried[j] != 0) live.add(position.frame.pair[j].slot);
    }
    period.drift_force = std::max(period.drift_force, std::abs(drift));
    if (!ahead) std::fill(load_at, load_at + 2 * fields, 0.0);  // of pairs that have no force now
    contact.spread(position, carried, load_at, ahead ? share_ahead : lag_step.from_new, lag_at, on_modes);
    propagated = ahead;
    double error;
    if (ahead) {
      Position& next = positions_[(i + 1) * stride_];
      set_gap(next, state.period);
      contact.read_ahead(next, step_data_[i + 1], lag_at, live, modal);
      error = modes.push_and_propagate(on_modes, modal, work_.rest.data());
    } else {
      error = modes.push(on_modes);
    }

    if (ledger) {
      fill(instants[i % 2], &instants[(i - 1) % 2], position, contact.p.data(), contact.d.data());
      record_step(instants[(i - 1) % 2], instants[i % 2], *ledger);
    }

    period.transmission_error[sample] = error;
    if (floating_) {
      take_bearing_force(period, sample);
      error = closing_weight_.dot(work_.z.head(closing_weight_.size()));
    }
    if (error > position.frame.lost_corner_gap)
      refuse(Failure::numerical, "at mesh phase ", position.mesh.phase, " the transmission error ",
             error * 1e6, " micrometres closes the gap of ", position.mesh.lost_corner_gap * 1e6,
             " micrometres of a tip edge that would touch below the involute; lower the torque or set "
             "corner_contact = false");
    if (error > position.frame.next_corner_gap) return false;
  }
  give(state);
  const int strips = positions_[0].mesh.strips();
  state.p = contact.p.head(strips);
  state.d = contact.d.head(strips);
  return true;
}

}  // namespace whine
