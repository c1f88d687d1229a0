// A march through mesh periods: what a step streams, laid side by side by position, and the loops that run down it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "contact/lanes.h"
#include "contact/line_contact.h"
#include "motion/dynamics.h"

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
  for (VectorXd* x : {&w.z, &w.v, &w.force, &w.torque, &w.response}) x->setZero(coordinates);
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
    for (VectorXd* x : {&instant.moment, &instant.reading}) x->setZero(pairs * kShapeRows);
  }
  for (VectorXd* x : {&l.turned_back, &l.frequency_squared, &l.damping}) x->setZero(coordinates);
  l.frequency_squared.head(own) = frequency_squared_;
  for (int i = 0; i < own; ++i) l.damping[i] = coordinates_[i].damping;
}

RollingDynamics::StepSizes RollingDynamics::step_sizes(int i) const {
  const MeshPosition& mesh = positions_[i].mesh;
  StepSizes sizes;
  sizes.coordinates = padded(static_cast<int>(coordinates_.size()));
  sizes.pairs = static_cast<int>(mesh.pairs.size());
  sizes.rows = lines() ? 1 : kShapeRows;
  sizes.nodes = lines() ? 1 : kPairNodes;
  sizes.strips = sizes.pairs > 0 ? mesh.strips() / sizes.pairs : 0;
  sizes.fields = kFields;
  sizes.shared = kSharedFields;
  sizes.teeth = 2 * reach_ + 1;
  return sizes;
}

// Lays the numbers of each position side by side.
void RollingDynamics::pack() {
  stream_.clear();
  size_t inner = std::numeric_limits<size_t>::max();  // windows without an edge are all alike
  for (Position& position : positions_)
    if (lines())
      pack_lines(position);
    else
      pack_strips(position, inner);
}

namespace {

size_t place(std::vector<double>& stream, Eigen::Index count) {
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
  int reading(int g) const { return kShape + coordinates + g * fields; }  // (field of all pairs) m N-1
  int weight(int g) const { return kShape + coordinates + 2 * fields + g * kFields; }  // (field of its own)
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
        row(record.reading(g) + tooth * kFields, block.cols()) = weight.head(block.rows()) * block;
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
  double column[kShapeRows][kPairNodes] = {}, row[kPairNodes][kShapeRows] = {};
  ShapeLanes() {
    for (int k = 0; k < kWindowNodes; ++k)
      for (int m = 0; m < kShapeRows; ++m) column[m][k] = row[k][m] = shape_basis()(k, m);
  }
  Lanes moments(const double* nodes) const {
    static_assert(kWindowNodes == 6);
    return (nodes[0] * lanes(row[0]) + nodes[1] * lanes(row[1]) + nodes[2] * lanes(row[2])) +
           (nodes[3] * lanes(row[3]) + nodes[4] * lanes(row[4]) + nodes[5] * lanes(row[5]));
  }
};
const RollingDynamics::ShapeLanes RollingDynamics::kShape;

namespace {

// result = gap + interpolation nodes; (strip), (strip), (strip, node)
void interpolate(double* result, const double* gap, const double* interpolation, int strips,
                 const double* nodes) {
  static_assert(kWindowNodes == 6);
  const double f0 = nodes[0], f1 = nodes[1], f2 = nodes[2], f3 = nodes[3], f4 = nodes[4], f5 = nodes[5];
  for (int i = 0; i < strips; i += kLanes) {
    const double* c = interpolation + i;
    lanes(result + i) =
        (lanes(gap + i) + f0 * lanes(c) + f1 * lanes(c + strips) + f2 * lanes(c + 2 * strips)) +
        (f3 * lanes(c + 3 * strips) + f4 * lanes(c + 4 * strips) + f5 * lanes(c + 5 * strips));
  }
}

}  // namespace

void RollingDynamics::pack_strips(Position& position, size_t& inner) {
  const int coordinates = padded(static_cast<int>(coordinates_.size()));
  const MeshPosition& mesh = position.mesh;
  const int pairs = static_cast<int>(mesh.pairs.size());
  position.frame.gap = place(stream_, mesh.strips());
  std::copy(mesh.gap.begin(), mesh.gap.end(),
            stream_.begin() + static_cast<std::ptrdiff_t>(position.frame.gap));
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
    if (edge || inner == std::numeric_limits<size_t>::max()) {
      const size_t at = place(stream_, s.size() * kPairNodes);
      for (int k = 0; k < kWindowNodes; ++k)
        for (int i = 0; i < s.size(); ++i) stream_[at + k * s.size() + i] = s.interpolation(i, k);
      position.frame.pair[j].interpolation = at;
      if (!edge) inner = at;
    } else {
      position.frame.pair[j].interpolation = inner;
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

// Adds h (bq / 2) h^T, what the modes give way at the end of a step. at_nodes: (node, node) m N-1.
void RollingDynamics::add_response(const Position& position, MatrixXd& at_nodes) {
  const int coordinates = padded(static_cast<int>(coordinates_.size())), present = position.frame.present;
  double* weighted = work_.response.data();
  // 0.5 bq of a row; its next numbers stand `apart` lanes behind.
  const auto weigh = [&](const double* row, int apart) {
    const double* bq = &speed_.number[SpeedCoefficients::bq * kLanes];
    for (int c = 0; c < coordinates; c += kLanes)
      lanes(weighted + c) = 0.5 * lanes(bq + c * SpeedCoefficients::kCount) * lanes(row + c * apart);
  };
  if (lines()) {
    for (int i = 0; i < present; ++i) {
      const LineRecord record{coordinates, all_fields()};
      const auto row = [&](int j) {
        return &stream_[position.frame.line + j * record.size() + LineRecord::kShape];
      };
      weigh(row(i), 1);
      for (int j = 0; j <= i; ++j) {
        const double add = dot(row(j), weighted, 0, coordinates);
        at_nodes(i, j) += add;
        if (i != j) at_nodes(j, i) += add;
      }
    }
    return;
  }
  const auto rows = [&](int j) { return &stream_[position.frame.shape + j * kShapeRows * coordinates]; };
  for (int i = 0; i < present; ++i) {
    Eigen::Matrix<double, kShapeRows, kShapeRows> share[kMostPairs];
    for (int r = 0; r < kShapeRows; ++r) {
      weigh(rows(i) + r * kLanes, kShapeRows);
      Lanes dots[kMostPairs];
      int j = 0;
      for (; j + 1 <= i; j += 2) dot_rows_twice(rows(j), rows(j + 1), coordinates, weighted, dots + j);
      if (j <= i) dots[j] = dot_rows(rows(j), coordinates, weighted);
      for (j = 0; j <= i; ++j)
        for (int m = 0; m < kShapeRows; ++m) share[j](r, m) = dots[j][m];
    }
    for (int j = 0; j <= i; ++j) {
      const Eigen::Matrix<double, kWindowNodes, kWindowNodes> block =
          shape_basis() * share[j] * shape_basis().transpose();
      at_nodes.block<kWindowNodes, kWindowNodes>(i * kWindowNodes, j * kWindowNodes) += block;
      if (i != j)
        at_nodes.block<kWindowNodes, kWindowNodes>(j * kWindowNodes, i * kWindowNodes) += block.transpose();
    }
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

void RollingDynamics::advance_tooth(State& state) const {
  for (VectorXd* y : {&state.z, &state.v, &state.force}) turn_doublets(y->data());
  state.period = (state.period + 1) % hunting_;
  for (int g = 0; g < 2; ++g)
    for (MatrixXd* field : {&state.lag[g], &state.load[g]}) {
      for (int j = static_cast<int>(field->cols()) - 1; j > 0; --j) field->col(j) = field->col(j - 1);
      field->col(0).setZero();
    }
}

Lanes RollingDynamics::reading(const Position& position, size_t j, const double* z) const {
  const int coordinates = padded(static_cast<int>(coordinates_.size()));
  if (!lines())
    return dot_rows(&stream_[position.frame.shape + j * kShapeRows * coordinates], coordinates, z);
  const LineRecord record{coordinates, all_fields()};
  return Lanes{
      dot(&stream_[position.frame.line + j * record.size() + LineRecord::kShape], z, 0, coordinates)};
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

}  // namespace

// Modal vectors of a march and what a step does to them. A pair has kRows rows.
template <int kRows>
struct RollingDynamics::Modes {
  int coordinates;
  double *z, *v, *force;
  const double* coefficients;

  // To the next instant, without new contact force.
  void propagate() const {
    for (int c = 0; c < coordinates; c += kLanes) {
      const double* k = coefficients + c * SpeedCoefficients::kCount;
      go_on(k, c, lanes(z + c), lanes(v + c), 0.5 * (lanes(force + c) + of(k, SpeedCoefficients::torque)));
    }
  }

  // The new contact force's own share. m: transmission error.
  double push(const ModalLoad& load) const {
    Lanes error{};
    for (int c = 0; c < coordinates; c += kLanes) {
      const double* k = coefficients + c * SpeedCoefficients::kCount;
      Lanes half{};
      for (int j = 0; j < load.count; ++j)
        for (int r = 0; r < kRows; ++r)
          half += load.half[j][r] * lanes(load.rows[j] + c * kRows + r * kLanes);
      const Lanes z1 = lanes(z + c) - of(k, SpeedCoefficients::bq) * half;
      lanes(v + c) -= of(k, SpeedCoefficients::a12) * half;
      lanes(z + c) = z1;
      lanes(force + c) = of(k, SpeedCoefficients::torque) - 2 * half;
      error += of(k, SpeedCoefficients::weight) * z1;
    }
    return sum(error);
  }

  // Both in one go; the force itself is not kept. rest: (coordinate), of the loads of more pairs than there are registers.
  double push_and_propagate(const ModalLoad& load, double* rest) const {
    switch (load.count) {
      case 0:
        return both<0, kRows>(load.rows, load.half);
      case 1:
        return both<1, kRows>(load.rows, load.half);
      case 2:
        return both<2, kRows>(load.rows, load.half);
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
    return both<1, 1>(&row, &one);
  }

 private:
  static const Lanes& of(const double* k, SpeedCoefficients::Of which) { return lanes(k + which * kLanes); }
  void go_on(const double* k, int c, Lanes z0, Lanes v0, Lanes mean) const {
    const Lanes bq = of(k, SpeedCoefficients::bq), a12 = of(k, SpeedCoefficients::a12);
    lanes(z + c) = of(k, SpeedCoefficients::a11) * z0 + a12 * v0 + bq * mean;
    lanes(v + c) = of(k, SpeedCoefficients::a21) * z0 + of(k, SpeedCoefficients::a22) * v0 + a12 * mean;
  }
  template <int kCount, int kRowsEach>
  double both(const double* const* rows, const Lanes* factor) const {
    const Modes here = *this;  // stores of lanes may change anything for all that the compiler knows
    const double* row[kCount + 1];
    double f[kCount + 1][kRowsEach];
    for (int j = 0; j < kCount; ++j) {
      row[j] = rows[j];
      for (int r = 0; r < kRowsEach; ++r) f[j][r] = factor[j][r];
    }
    const double* k = here.coefficients;
    Lanes error{};
    for (int c = 0; c < here.coordinates; c += kLanes, k += SpeedCoefficients::kCount * kLanes) {
      Lanes half{};
      for (int j = 0; j < kCount; ++j)
        for (int r = 0; r < kRowsEach; ++r) half += f[j][r] * lanes(row[j] + c * kRowsEach + r * kLanes);
      const Lanes z1 = lanes(here.z + c) - of(k, SpeedCoefficients::bq) * half,
                  v1 = lanes(here.v + c) - of(k, SpeedCoefficients::a12) * half;
      error += of(k, SpeedCoefficients::weight) * z1;
      here.go_on(k, c, z1, v1, of(k, SpeedCoefficients::torque) - half);
    }
    return sum(error);
  }
};

struct RollingDynamics::StripContact {
  static constexpr int kRows = kShapeRows;

  explicit StripContact(RollingDynamics& of)
      : dynamics(of),
        coordinates(padded(static_cast<int>(of.coordinates_.size()))),
        fields(of.all_fields()),
        e(of.work_.e),
        p(of.work_.p),
        d(of.work_.d),
        nodes(of.work_.nodes) {}

  void rename() { followed = 0; }

  // Fills p and d. z: (coordinate); lag: (field of all pairs) of one gear after the other; both without new contact
  // force.
  Certificate solve(const Position& position, Step& step, const double* z, const double* lag) {
    const double* stream = dynamics.stream_.data();
    const int present = position.frame.present, of_pair = position.frame.of_pair, strips = present * of_pair;
    follow(position, lag);
    Lanes read[kMostPairs];
    const double* rows = stream + position.frame.shape;
    const int of_rows = kShapeRows * coordinates;
    int j = 0;
    for (; j + 2 <= present; j += 2)
      dot_rows_twice(rows + j * of_rows, rows + (j + 1) * of_rows, coordinates, z, read + j);
    if (j < present) read[j] = dot_rows(rows + j * of_rows, coordinates, z);
    for (j = 0; j < present; ++j) {
      double moved[kShapeRows], at_node[kPairNodes] = {};
      lanes(moved) = -read[j];
      add_columns_of_8(at_node, kShape.column[0], moved, kShapeRows);
      for (int g = 0; g < 2; ++g)
        add_columns_of_8(at_node, stream + position.frame.pair[j].field + g * kPairNodes * kFields,
                         field_of(position, g, j), kFields);
      interpolate(e.data() + j * of_pair, stream + position.frame.gap + j * of_pair,
                  stream + position.frame.pair[j].interpolation, of_pair, at_node);
    }
    return dynamics.solver_.solve(step.compliance, e.head(strips), step.active, p.head(strips),
                                  d.head(strips));
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
    if (force != 0)
      dot_columns(&nodes[j * kPairNodes], &dynamics.stream_[pair.interpolation], of_pair, kPairNodes, own,
                  of_pair);
    return true;
  }

  // After `carried` of all pairs, force: (pair) N. load: as lag, of the pairs that are present.
  void spread(const Position& position, const double* force, double* load, ModalLoad& on_modes) {
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
      }
  }

  RollingDynamics& dynamics;
  int coordinates, fields;
  VectorXd &e, &p, &d;  // (strip)
  VectorXd& nodes;      // (node) forces

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
  Certificate solve(const Position& position, Step& step, const double* z, const double* lag) {
    const Certificate certificate = StripContact::solve(position, step, z, lag);
    problems.push_back({step.compliance, e.head(position.mesh.strips()), step.active});
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

  explicit LineContact(RollingDynamics& of)
      : dynamics(of),
        record{padded(static_cast<int>(of.coordinates_.size())), of.all_fields()},
        e(of.work_.e),
        p(of.work_.p),
        d(of.work_.d) {}

  void rename() {}

  // As of strips, all three.
  Certificate solve(const Position& position, Step& step, const double* z, const double* lag) {
    const int present = position.frame.present;
    const double* line = dynamics.stream_.data() + position.frame.line;
    for (int j = 0; j < present; ++j, line += record.size()) {
      const double* shape = line + LineRecord::kShape;
      Lanes modal{}, other{}, driver{}, driven{};
      int c = 0;
      for (; c + 2 * kLanes <= record.coordinates; c += 2 * kLanes) {
        modal += lanes(shape + c) * lanes(z + c);
        other += lanes(shape + c + kLanes) * lanes(z + c + kLanes);
      }
      if (c < record.coordinates) modal += lanes(shape + c) * lanes(z + c);
      for (int k = 0; k < record.fields; k += kLanes) {
        driver += lanes(line + record.reading(0) + k) * lanes(lag + k);
        driven += lanes(line + record.reading(1) + k) * lanes(lag + record.fields + k);
      }
      e[j] = line[LineRecord::kGap] + sum((driver + driven) - (modal + other));
    }
    if (step.force.size() == present)
      std::copy(step.force.begin(), step.force.end(), p.data());
    else
      p.head(present).setZero();
    const Certificate certificate = solve_line_contact(step.compliance, position.mesh.law, e.head(present),
                                                       p.head(present), d.head(present));
    step.force = p.head(present);
    return certificate;
  }

  bool carried(const Position& position, int j, double& force) const {
    force = p[j];
    if (!(force <= dynamics.stream_[position.frame.line + j * record.size() + LineRecord::kMost]))
      require_line_range(position.mesh, p.head(position.mesh.strips()));
    return true;
  }

  void spread(const Position& position, const double* force, double* load, ModalLoad& on_modes) const {
    const int present = position.frame.present;
    const double* line = dynamics.stream_.data() + position.frame.line;
    on_modes.count = 0;
    for (int j = 0; j < present; ++j, line += record.size()) {
      if (force[j] == 0) continue;
      on_modes.add(line + LineRecord::kShape, Lanes{force[j]});
      for (int g = 0; g < 2; ++g)
        for (int k = 0; k < kFields; k += kLanes)
          lanes(load + g * record.fields + position.frame.pair[j].slot * kFields + k) =
              force[j] * lanes(line + record.weight(g) + k);
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
    fail(error.kind(), start, positions_[sample_ * stride_].mesh.phase, " ", words);
  }
}

template <class Contact>
bool RollingDynamics::march(Contact contact, State& state, Period& period, Ledger* ledger) {
  const int pairs = 2 * reach_ + 1, coordinates = padded(static_cast<int>(coordinates_.size())),
            fields = kFields * pairs;
  period.transmission_error.resize(steps_);
  period.pair_load.setZero(pairs, steps_);
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
  take(state);

  const Modes<Contact::kRows> modes{coordinates, work_.z.data(), work_.v.data(), work_.force.data(),
                                    speed_.number.data()};
  // Stores of lanes may change anything for all that the compiler knows; it need not look these up again.
  double *const lag_at = work_.lag.data(), *const load_at = work_.load.data();
  const Lag lag_step = lag_;
  ModalLoad on_modes;

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
      if (ledger) rename(instants[(i - 1) % 2]);
      state.period = (state.period + 1) % hunting_;
    }
    sample_ = sample;
    set_gap(positions_[sample * stride_], state.period);
    const Position& position = positions_[sample * stride_];
    const int present = position.frame.present;

    // What the step would bring without new contact force.
    if (!propagated) modes.propagate();
    for (int k = 0; k < 2 * fields; k += kLanes) {
      lanes(lag_at + k) = lag_step.decay * lanes(lag_at + k) + lag_step.from_old * lanes(load_at + k);
      lanes(load_at + k) = Lanes{};
    }
    const Certificate certificate = contact.solve(position, step_data_[sample], modes.z, lag_at);
    period.least_gap = std::min(period.least_gap, certificate.least_gap);
    period.least_force = std::min(period.least_force, certificate.least_force);
    period.fallbacks += certificate.fallback;

    // The new force's own share, and where nobody looks at the instant the next step's beginning.
    double drift = 0, carried[kMostPairs];
    for (int j = 0; j < present; ++j) {
      if (!contact.carried(position, j, carried[j])) return false;
      period.pair_load(position.frame.pair[j].slot, sample) = carried[j];
      drift += position.frame.pair[j].drift_lever * carried[j];
    }
    period.drift_force = std::max(period.drift_force, std::abs(drift));
    contact.spread(position, carried, load_at, on_modes);
    propagated = !ledger && i + 1 < steps_;
    const double error =
        propagated ? modes.push_and_propagate(on_modes, work_.response.data()) : modes.push(on_modes);
    for (int g = 0; g < 2; ++g)
      for (int j = 0; j < present; ++j) {
        const int own_fields = g * fields + position.frame.pair[j].slot * kFields;
        for (int k = own_fields; k < own_fields + kFields; k += kLanes)
          lanes(lag_at + k) += lag_step.from_new * lanes(load_at + k);
      }

    if (ledger) {
      fill(instants[i % 2], &instants[(i - 1) % 2], position, contact.p.data(), contact.d.data());
      record_step(instants[(i - 1) % 2], instants[i % 2], *ledger);
    }

    period.transmission_error[sample] = error;
    if (error > position.frame.lost_corner_gap)
      fail(Failure::numerical, "at mesh phase ", position.mesh.phase, " the transmission error ", error * 1e6,
           " micrometres closes the gap of ", position.mesh.lost_corner_gap * 1e6,
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
