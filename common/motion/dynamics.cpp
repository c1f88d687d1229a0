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
        if (rung == "modal" || full() || i == torsional) kept_[g].push_back(i);
    }
    if (full() && body.discretisation.modes != kAllModes)
      fail(Failure::input, "body = \"full\" needs a body with every mode of its mesh, that of the ",
           g ? "driven gear" : "driver", " holds ", body.eigenfrequency.size(), " modes; rebuild body.h5");
    first_coordinate_[g] = static_cast<int>(coordinates_.size());
    add_modes(g, kept_[g]);
  }

  const int n = static_cast<int>(coordinates_.size());
  error_weight_ = torque_force_ = frequency_squared_ = VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) {
    for (int g = 0; g < 2; ++g)
      error_weight_[i] += model.kinematics.gear(g).base_radius() * coordinates_[i].hub[g];
    torque_force_[i] = coordinates_[i].torque;
    frequency_squared_[i] = coordinates_[i].frequency * coordinates_[i].frequency;
    // The factor keeps gears apart that have changed places.
    pair_stamp_ += (i + 1) * (coordinates_[i].frequency + error_weight_[i]);
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
constexpr int kShapeRows = 4;  // per pair: what modes are read and loaded through
static_assert(kFields % kLanes == 0 && kPairNodes % kLanes == 0 && kPairNodes >= kWindowNodes);
static_assert(kShapeRows == kLanes && kShapeRows <= kWindowNodes && kPairNodes == 8 && kFields == 12);

// (node, shape row) orthonormal: the first Chebyshev polynomials on the Chebyshev points of a window.
using ShapeBasis = Eigen::Matrix<double, kWindowNodes, kShapeRows>;
ShapeBasis make_shape_basis() {
  ShapeBasis basis;
  for (int k = 0; k < kWindowNodes; ++k)
    for (int m = 0; m < kShapeRows; ++m)
      basis(k, m) = std::sqrt((m > 0 ? 2.0 : 1.0) / kWindowNodes) *
                    std::cos(m * (2 * k + 1) * std::numbers::pi / (2 * kWindowNodes));
  return basis;
}
const ShapeBasis& shape_basis() {
  static const ShapeBasis basis = make_shape_basis();
  return basis;
}

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
  if (!lines() && range.strips % kLanes != 0)
    fail(Failure::numerical, range.strips, " strips in a window are no multiple of ", kLanes);
  const double depth = parameters_.damping.undamped_depth;
  const double load = parameters_.torque / model_.kinematics.gear(0).base_radius();
  positions_.assign(steps, {});
  reach_ = 1;
  for (int i = 0; i < steps; ++i) {
    const double phase = static_cast<double>(i) / steps;
    positions_[i].mesh = lines()
                             ? make_line_position(model_, phase, range.corner_gap, depth, shared_force(load))
                             : make_position(model_, phase, range);
    for (const PairStrips& s : positions_[i].mesh.pairs) reach_ = std::max(reach_, std::abs(s.pair));
  }

  // Participation of every coordinate at the nodes of every position, once to look at and once packed for the steps.
  constexpr double kMostMemory = 12e9;  // bytes
  double memory = 0;
  for (const Position& position : positions_)
    memory += 8.0 * static_cast<double>(coordinates_.size()) *
              (position.mesh.nodes() + (lines() ? 1.0 : static_cast<double>(kPairNodes)) *
                                           static_cast<double>(position.mesh.pairs.size()));
  if (memory > kMostMemory)
    fail(Failure::input, coordinates_.size(), " coordinates at ", steps, " positions of a mesh period need ",
         memory * 1e-9, " GB, at most ", kMostMemory * 1e-9,
         " are allowed; set contact = \"line\", lower min_sample_rate_kHz or raise the lowest speed, or take "
         "body = \"modal\"");

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
    fields_[g] = full() ? MatrixXd::Zero(m, kFields) : lagged_fields(known, g);
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
    if (!lines())
      for (size_t i = 0; i < mesh.pairs.size(); ++i) {
        auto rows = position.participation.middleRows<kWindowNodes>(i * kWindowNodes);
        rows = (shape_basis() * (shape_basis().transpose() * rows)).eval();
      }
    position.lagged = MatrixXd::Zero(mesh.nodes(), mesh.nodes());
    MatrixXd whole = position.lagged;
    for (int g = 0; g < 2; ++g) {
      whole += body_compliance(mesh, g, tables[g]);
      position.field_weight[g] = MatrixXd::Zero(mesh.nodes(), kFields);
      position.field_weight[g].leftCols(fields_[g].cols()) = mesh.table_weights[g] * fields_[g];
      const auto rows = [&](size_t i) { return position.field_weight[g](mesh.nodes_of(i), Eigen::all); };
      for (size_t i = 0; i < mesh.pairs.size(); ++i)
        for (size_t j = 0; j < mesh.pairs.size(); ++j)
          position.lagged(mesh.nodes_of(i), mesh.nodes_of(j)) +=
              rows(i) *
              coupling_[g].block<kFields, kFields>((mesh.pairs[i].pair + reach_) * kFields,
                                                   (mesh.pairs[j].pair + reach_) * kFields) *
              rows(j).transpose();
    }
    position.local = local_compliance(model_, mesh, depth);
    mesh.add_to_strips(whole - position.lagged, position.local);
    for (const PairStrips& s : mesh.pairs) {
      position.slot.push_back(s.pair + reach_);
      position.drift_lever.push_back(s.contact.lever[0] / model_.kinematics.gear(0).base_radius() -
                                     s.contact.lever[1] / model_.kinematics.gear(1).base_radius());
    }
  }
  step_data_.clear();
  pack();
  turns_.clear();
  for (int i = 0; i < static_cast<int>(coordinates_.size()); ++i) {
    const Coordinate& c = coordinates_[i];
    if (c.turn == 0) continue;
    if (c.partner < 0)
      turns_.push_back({i, -1, -1, 0});
    else if (c.partner > i)
      turns_.push_back({i, c.partner, std::cos(c.turn), std::sin(c.turn)});
  }
  size_workspaces();
}

void RollingDynamics::size_workspaces() {
  static_assert(kFields <= kMostFields);
  const int own = static_cast<int>(coordinates_.size()), coordinates = padded(own),
            fields = kFields * (2 * reach_ + 1);
  int strips = kMostPairs, pairs = 1;
  for (const Position& position : positions_) {
    strips = std::max(strips, position.mesh.strips());
    pairs = std::max(pairs, static_cast<int>(position.mesh.pairs.size()));
  }
  Workspace& w = work_;
  for (VectorXd* x : {&w.z, &w.v, &w.force, &w.torque, &w.weight, &w.response}) x->setZero(coordinates);
  w.torque.head(own) = torque_force_;
  w.weight.head(own) = error_weight_;
  for (VectorXd* x : {&w.lag, &w.load}) x->setZero(2 * fields);
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

// Where the numbers of one line stand, all lengths whole lanes.
struct LineRecord {
  int coordinates, fields;               // of all pairs
  static constexpr int kGap = 0;         // m
  static constexpr int kMost = 1;        // N: beyond it neither Hertz's law nor the flanks hold
  static constexpr int kShape = kLanes;  // (coordinate)
  int reading(int g) const { return kShape + coordinates + g * fields; }  // (field of all pairs) m N-1
  int weight(int g) const { return kShape + coordinates + 2 * fields + g * kFields; }  // (field of its own)
  int size() const { return weight(2); }
};

}  // namespace

void RollingDynamics::pack_lines(Position& position) {
  const MeshPosition& mesh = position.mesh;
  const LineRecord record{padded(static_cast<int>(coordinates_.size())), kFields * (2 * reach_ + 1)};
  position.line = place(stream_, static_cast<int>(mesh.pairs.size()) * record.size());
  for (size_t j = 0; j < mesh.pairs.size(); ++j) {
    double* at = &stream_[position.line + j * record.size()];
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
      row(record.reading(g), record.fields) =
          weight * coupling_[g].middleRows<kFields>(position.slot[j] * kFields);
      row(record.weight(g), kFields) = weight;
    }
  }
}

namespace {

// A window's basis in lanes: what a pair's shape rows move its nodes by, and what its nodes' forces are in them.
struct ShapeLanes {
  double column[kShapeRows][kPairNodes] = {}, row[kPairNodes][kShapeRows] = {};
  ShapeLanes() {
    for (int k = 0; k < kWindowNodes; ++k)
      for (int m = 0; m < kShapeRows; ++m) column[m][k] = row[k][m] = shape_basis()(k, m);
  }
};
const ShapeLanes kShape;

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

Lanes moments_of(const double* nodes) {
  static_assert(kWindowNodes == 6);
  return (nodes[0] * lanes(kShape.row[0]) + nodes[1] * lanes(kShape.row[1]) +
          nodes[2] * lanes(kShape.row[2])) +
         (nodes[3] * lanes(kShape.row[3]) + nodes[4] * lanes(kShape.row[4]) +
          nodes[5] * lanes(kShape.row[5]));
}

}  // namespace

void RollingDynamics::pack_strips(Position& position, size_t& inner) {
  const int coordinates = padded(static_cast<int>(coordinates_.size()));
  const MeshPosition& mesh = position.mesh;
  const int pairs = static_cast<int>(mesh.pairs.size());
  position.gap = place(stream_, mesh.strips());
  std::copy(mesh.gap.begin(), mesh.gap.end(), stream_.begin() + static_cast<std::ptrdiff_t>(position.gap));
  position.shape = place(stream_, pairs * kShapeRows * coordinates);
  for (int j = 0; j < pairs; ++j) {
    const MatrixXd shape =
        shape_basis().transpose() * position.participation.middleRows<kWindowNodes>(j * kWindowNodes);
    for (int r = 0; r < kShapeRows; ++r)
      std::copy(
          shape.row(r).begin(), shape.row(r).end(),
          stream_.begin() + static_cast<std::ptrdiff_t>(position.shape + (j * kShapeRows + r) * coordinates));
    const PairStrips& s = mesh.pairs[j];
    const bool edge = s.low_is_edge || s.high_is_edge;
    if (edge || inner == std::numeric_limits<size_t>::max()) {
      const size_t at = place(stream_, s.size() * kPairNodes);
      for (int k = 0; k < kWindowNodes; ++k)
        for (int i = 0; i < s.size(); ++i) stream_[at + k * s.size() + i] = s.interpolation(i, k);
      position.interpolation.push_back(at);
      if (!edge) inner = at;
    } else {
      position.interpolation.push_back(inner);
    }
    for (int g = 0; g < 2; ++g) {
      const size_t at = place(stream_, kPairNodes * kFields);
      for (int r = 0; r < kFields; ++r)
        for (int k = 0; k < kWindowNodes; ++k)
          stream_[at + r * kPairNodes + k] = position.field_weight[g](j * kWindowNodes + k, r);
      position.field[g].push_back(at);
    }
  }
}

const MatrixXd& RollingDynamics::shape_on_tooth(int g, int tooth) const {
  const auto [at, fresh] = shape_[g].try_emplace(tooth);
  if (fresh) {
    const int count =
        (g == 0 ? first_coordinate_[1] : static_cast<int>(coordinates_.size())) - first_coordinate_[g];
    std::map<int, VectorXd> mode;  // of columns that several coordinates share
    at->second = MatrixXd::Zero(model_.gear[g].table_size(), count);
    for (int c = 0; c < count; ++c)
      for (const auto& [column, share] : coordinates_[first_coordinate_[g] + c].columns) {
        VectorXd& shape = mode[column];
        if (shape.size() == 0) shape = model_.gear[g].mode_on_tooth(column, tooth);
        at->second.col(c) += share * shape;
      }
  }
  return at->second;
}

MatrixXd RollingDynamics::participation(const MeshPosition& mesh) const {
  MatrixXd h = MatrixXd::Zero(mesh.nodes(), static_cast<int>(coordinates_.size()));
  for (size_t c = 0; c < coordinates_.size(); ++c) {
    for (int g = 0; g < 2; ++g) h.col(c) += coordinates_[c].hub[g] * mesh.node_lever[g];
    if (full()) continue;
    const int g = coordinates_[c].gear;
    for (size_t i = 0; i < mesh.pairs.size(); ++i)
      for (const auto& [column, share] : coordinates_[c].columns)
        h.col(c)(mesh.nodes_of(i)) +=
            share * mesh.table_weights[g](mesh.nodes_of(i), Eigen::all) *
            model_.gear[g].mode_on_tooth(column, GearMeshModel::tooth(g, mesh.pairs[i].pair));
  }
  // Every mode: one product with a matrix that is kept per tooth.
  for (int g = 0; full() && g < 2; ++g)
    for (size_t i = 0; i < mesh.pairs.size(); ++i) {
      const MatrixXd& shape = shape_on_tooth(g, GearMeshModel::tooth(g, mesh.pairs[i].pair));
      h.middleCols(first_coordinate_[g], shape.cols())(mesh.nodes_of(i), Eigen::all) +=
          mesh.table_weights[g](mesh.nodes_of(i), Eigen::all) * shape;
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
  const bool newmark = parameters_.fidelity.integrator == "newmark";
  Propagator a{};  // the halves of a doublet have one
  for (int i = 0; i < n; ++i) {
    const Coordinate& c = coordinates_[i];
    if (i == 0 || c.frequency != coordinates_[i - 1].frequency || c.damping != coordinates_[i - 1].damping)
      a = newmark ? newmark_propagator(c.frequency, c.damping, h)
                  : exact_propagator(c.frequency, c.damping, h);
    speed_.a11[i] = a.a11;
    speed_.a12[i] = a.a12;
    speed_.a21[i] = a.a21;
    speed_.a22[i] = a.a22;
    speed_.bq[i] = a.bq;
    speed_.bv[i] = a.bv;
  }
  lag_ = lag_step(relaxation(), h);
  damping_ = damping_integrals();

  // Memory stays; so do the active strips, or the forces, of a step at the same phase, as a first guess.
  const int before = static_cast<int>(step_data_.size());
  if (before != steps) {
    std::vector<Step> other(steps);
    for (int i = 0; i < steps && before > 0; ++i)
      if (i * before % steps == 0) {
        other[i].active.strips = step_data_[i * before / steps].active.strips;
        other[i].force = step_data_[i * before / steps].force;
      }
    step_data_ = std::move(other);
  }
  MatrixXd at_nodes;
  for (int i = 0; i < steps; ++i) {
    const Position& position = positions_[i * stride_];
    step_data_[i].active.forget();
    step_data_[i].compliance = position.local;
    at_nodes = lag_.from_new * position.lagged;
    add_response(position, at_nodes);
    position.mesh.add_to_strips(at_nodes, step_data_[i].compliance);
  }
}

// Adds h (bq / 2) h^T, what the modes give way at the end of a step. at_nodes: (node, node) m N-1.
void RollingDynamics::add_response(const Position& position, MatrixXd& at_nodes) {
  const int coordinates = padded(static_cast<int>(coordinates_.size())),
            present = static_cast<int>(position.slot.size());
  double *weighted = work_.response.data(), *const bq = speed_.bq.data();
  if (lines()) {
    for (int i = 0; i < present; ++i) {
      const LineRecord record{coordinates, kFields * (2 * reach_ + 1)};
      const auto row = [&](int j) {
        return &stream_[position.line + j * record.size() + LineRecord::kShape];
      };
      for (int c = 0; c < coordinates; c += kLanes)
        lanes(weighted + c) = 0.5 * lanes(bq + c) * lanes(row(i) + c);
      for (int j = 0; j <= i; ++j) {
        const double add = dot(row(j), weighted, 0, coordinates);
        at_nodes(i, j) += add;
        if (i != j) at_nodes(j, i) += add;
      }
    }
    return;
  }
  const auto rows = [&](int j) { return &stream_[position.shape + j * kShapeRows * coordinates]; };
  for (int i = 0; i < present; ++i) {
    Eigen::Matrix<double, kShapeRows, kShapeRows> share[kMostPairs];
    for (int r = 0; r < kShapeRows; ++r) {
      const double* row = rows(i) + r * coordinates;
      for (int c = 0; c < coordinates; c += kLanes)
        lanes(weighted + c) = 0.5 * lanes(bq + c) * lanes(row + c);
      for (int j = 0; j <= i; ++j) {
        const Lanes dots = dot_rows(rows(j), coordinates, weighted);
        for (int m = 0; m < kShapeRows; ++m) share[j](r, m) = dots[m];
      }
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

Equilibrium RollingDynamics::equilibrium_at(const Position& position, const MatrixXd& compliance,
                                            const VectorXd& offset) {
  const MeshPosition& mesh = position.mesh;
  const VectorXd approach = mesh.to_strips(position.participation.col(0));
  if (lines()) {
    const Equilibrium e = equilibrium(compliance, mesh.law, offset, approach, torque_force_[0], 0);
    require_line_range(mesh, e.p);
    return e;
  }
  ActiveSet active;
  return equilibrium(compliance, offset, approach, torque_force_[0], 0, active, solver_);
}

// (strip) m: gap with the elastic coordinates where the torques alone put them.
VectorXd RollingDynamics::elastic_offset(const Position& position) const {
  return position.mesh.gap -
         position.mesh.to_strips(position.participation * flexibility().cwiseProduct(torque_force_));
}

// Least w^2 of z'' + (diag(frequency^2) + h^T c^-1 h) z = 0 below the first elastic frequency, without a matrix over the
// coordinates: elastic ones answer at w^2 by F = sum of h h^T / (frequency^2 - w^2), which leaves
// w^2 = h_0^T (c + F(w^2))^-1 h_0 of the rigid rotation. The right side falls with w^2.
double RollingDynamics::condensed_eigenvalue(const MatrixXd& compliance, const MatrixXd& h) const {
  const Eigen::Index n = h.cols() - 1;
  const auto elastic = h.rightCols(n);
  const double pole = frequency_squared_.tail(n).minCoeff();
  double below = 0, above = pole, at = 0;
  constexpr int kMost = 100;
  for (int k = 0; k < kMost; ++k) {
    const VectorXd response = (frequency_squared_.tail(n).array() - at).inverse();
    const MatrixXd whole = compliance + elastic * response.asDiagonal() * elastic.transpose();
    const double next = h.col(0).dot(whole.ldlt().solve(h.col(0)));
    if (std::abs(next - at) < 1e-13 * at) return next;
    (next > at ? below : above) = at;
    at = next > below && next < above ? next : 0.5 * (below + above);
  }
  fail(Failure::numerical, "no natural frequency was found below the first elastic one of ",
       std::sqrt(pole) / kTwoPi, " Hz in ", kMost,
       " steps; raise total_inertia_kgm2 or set body = \"modal\"");
}

double RollingDynamics::frozen_frequency(int i) {
  const Position& position = positions_[i];
  const VectorXd p = equilibrium_at(position, static_compliance(position), elastic_offset(position)).p;
  std::vector<int> touch;
  for (int k = 0; k < p.size(); ++k)
    if (p[k] > 0) touch.push_back(k);
  // d = 0 on the active strips: p = (A + R)^-1 h z there, and z'' + (w^2 + h^T (A + R)^-1 h) z = 0.
  MatrixXd a = position.local;
  position.mesh.add_to_strips(position.lagged, a);
  for (size_t j = 0; j < position.mesh.law.size(); ++j) a(j, j) += position.mesh.law[j].at(p[j]).slope;
  const MatrixXd compliance = a(touch, touch);
  MatrixXd h(position.mesh.strips(), position.participation.cols());
  for (int c = 0; c < h.cols(); ++c) h.col(c) = position.mesh.to_strips(position.participation.col(c));
  const MatrixXd touching = h(touch, Eigen::all);
  if (full()) return std::sqrt(condensed_eigenvalue(compliance, touching)) / kTwoPi;
  MatrixXd stiffness = touching.transpose() * compliance.ldlt().solve(touching);
  stiffness.diagonal() += frequency_squared_;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(stiffness, Eigen::EigenvaluesOnly);
  if (eigen.info() != Eigen::Success || !(eigen.eigenvalues()[0] > 0))
    fail(Failure::numerical, "at mesh phase ", position.mesh.phase, " the pair with ", touch.size(),
         " strips in contact has no natural frequency: least eigenvalue ", eigen.eigenvalues()[0],
         " rad2/s2 of a stiffness of norm ", stiffness.norm());
  return std::sqrt(eigen.eigenvalues()[0]) / kTwoPi;
}

HeldMesh RollingDynamics::hold(int i) const {
  if (lines())
    fail(Failure::input,
         "contact = \"line\" in [fidelity] is not available for a pair that is held at a mesh phase ",
         "(gear-impact); set contact = \"strips\"");
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
  const VectorXd offset = elastic_offset(position);
  const Equilibrium e = equilibrium_at(position, a, offset);
  const VectorXd nodes = position.mesh.to_nodes(e.p);
  State state;
  state.pair = pair_stamp_;
  state.force = torque_force_ - position.participation.transpose() * nodes;
  state.z = flexibility().cwiseProduct(state.force);
  state.z[0] = e.x;
  state.v = VectorXd::Zero(state.z.size());
  state.p = e.p;
  state.d = a * e.p + offset - position.mesh.to_strips(e.x * position.participation.col(0));
  for (size_t j = 0; j < position.mesh.law.size(); ++j)
    if (e.p[j] > 0) state.d[j] += position.mesh.law[j].at(e.p[j]).indentation;
  for (int g = 0; g < 2; ++g) {
    state.load[g] = MatrixXd::Zero(kFields, 2 * reach_ + 1);
    for (size_t j = 0; j < position.mesh.pairs.size(); ++j)
      state.load[g].col(position.mesh.pairs[j].pair + reach_) +=
          position.field_weight[g](position.mesh.nodes_of(j), Eigen::all).transpose() *
          nodes(position.mesh.nodes_of(j));
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
  const int of_gear = kFields * (2 * reach_ + 1);
  for (int g = 0; g < 2; ++g) {
    double* own = fields + g * of_gear;
    std::copy_backward(own, own + of_gear - kFields, own + of_gear);
    std::fill(own, own + kFields,
              0.0);  // a tooth that comes into reach was unloaded for longer than any lag lasts
  }
}

void RollingDynamics::advance_tooth(State& state) const {
  for (VectorXd* y : {&state.z, &state.v, &state.force}) turn_doublets(y->data());
  for (int g = 0; g < 2; ++g)
    for (MatrixXd* field : {&state.lag[g], &state.load[g]}) {
      for (int j = static_cast<int>(field->cols()) - 1; j > 0; --j) field->col(j) = field->col(j - 1);
      field->col(0).setZero();
    }
}

Lanes RollingDynamics::reading(const Position& position, size_t j, const double* z) const {
  const int coordinates = padded(static_cast<int>(coordinates_.size()));
  if (!lines()) return dot_rows(&stream_[position.shape + j * kShapeRows * coordinates], coordinates, z);
  const LineRecord record{coordinates, kFields * (2 * reach_ + 1)};
  return Lanes{dot(&stream_[position.line + j * record.size() + LineRecord::kShape], z, 0, coordinates)};
}

Lanes RollingDynamics::collect(const Position& position, size_t j, const double* p, double* fields) const {
  const int coordinates = padded(static_cast<int>(coordinates_.size()));
  if (lines()) {
    const LineRecord record{coordinates, kFields * (2 * reach_ + 1)};
    const double* line = &stream_[position.line + j * record.size()];
    for (int g = 0; g < 2; ++g)
      for (int k = 0; k < kFields; k += kLanes)
        lanes(fields + g * kFields + k) = p[0] * lanes(line + record.weight(g) + k);
    return Lanes{p[0]};
  }
  const int of_pair = position.mesh.pairs[j].size();
  double nodes[kPairNodes];
  dot_columns(nodes, &stream_[position.interpolation[j]], of_pair, kPairNodes, p, of_pair);
  for (int g = 0; g < 2; ++g)
    dot_columns(fields + g * kFields, &stream_[position.field[g][j]], kPairNodes, kFields, nodes, kPairNodes);
  return moments_of(nodes);
}

void RollingDynamics::displace(int g, const double* loads, double* field) const {
  const int fields = kFields * (2 * reach_ + 1);
  std::fill(field, field + fields, 0.0);
  for (int k = 0; k < fields; k += kFields)
    add_columns_of_12(field + k, coupling_[g].data() + k, fields, loads, fields);
}

struct RollingDynamics::StripContact {
  explicit StripContact(RollingDynamics& of)
      : dynamics(of),
        coordinates(padded(static_cast<int>(of.coordinates_.size()))),
        fields(kFields * (2 * of.reach_ + 1)),
        e(of.work_.e),
        p(of.work_.p),
        d(of.work_.d),
        nodes(of.work_.nodes) {}

  // Fills p and d. z: (coordinate); lag: (field of all pairs) of one gear after the other; both without new contact
  // force.
  Certificate solve(const Position& position, Step& step, const double* z, const double* lag) {
    const MeshPosition& mesh = position.mesh;
    const double* stream = dynamics.stream_.data();
    const int strips = mesh.strips(), present = static_cast<int>(mesh.pairs.size()),
              of_pair = present > 0 ? strips / present : 0;
    for (int j = 0; j < present; ++j) {
      double moved[kShapeRows], at_node[kPairNodes] = {};
      lanes(moved) = -dot_rows(stream + position.shape + j * kShapeRows * coordinates, coordinates, z);
      add_columns_of_8(at_node, kShape.column[0], moved, kShapeRows);
      for (int g = 0; g < 2; ++g) {
        double displacement[kFields] = {};
        add_columns_of_12(displacement, dynamics.coupling_[g].data() + position.slot[j] * kFields, fields,
                          lag + g * fields, fields);
        add_columns_of_8(at_node, stream + position.field[g][j], displacement, kFields);
      }
      interpolate(e.data() + j * of_pair, stream + position.gap + j * of_pair,
                  stream + position.interpolation[j], of_pair, at_node);
    }
    return dynamics.solver_.solve(step.compliance, e.head(strips), step.active, p.head(strips),
                                  d.head(strips));
  }

  // N, of pair j. False if force stands on a window's end that is no tip edge.
  bool carried(const Position& position, int j, double& force) {
    const PairStrips& pair = position.mesh.pairs[j];
    const int of_pair = pair.size();
    const double* own = &p[j * of_pair];
    if ((!pair.low_is_edge && own[0] > 0) || (!pair.high_is_edge && own[of_pair - 1] > 0)) return false;
    dot_columns(&nodes[j * kPairNodes], &dynamics.stream_[position.interpolation[j]], of_pair, kPairNodes,
                own, of_pair);
    Lanes total{};
    for (int k = 0; k < of_pair; k += kLanes) total += lanes(own + k);
    force = sum(total);
    return true;
  }

  // After `carried` of all pairs. force: (coordinate) h^T p; load: as lag, of the pairs that are present.
  void spread(const Position& position, double* force, double* load) const {
    const double* stream = dynamics.stream_.data();
    const int present = static_cast<int>(position.mesh.pairs.size());
    std::fill(force, force + coordinates, 0.0);
    for (int j = 0; j < present; ++j) {
      const double* own = &nodes[j * kPairNodes];
      add_rows(force, stream + position.shape + j * kShapeRows * coordinates, coordinates, moments_of(own));
      for (int g = 0; g < 2; ++g)
        dot_columns(load + g * fields + position.slot[j] * kFields, stream + position.field[g][j], kPairNodes,
                    kFields, own, kPairNodes);
    }
  }

  RollingDynamics& dynamics;
  int coordinates, fields;
  VectorXd &e, &p, &d;  // (strip)
  VectorXd& nodes;      // (node) forces
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
  explicit LineContact(RollingDynamics& of)
      : dynamics(of),
        record{padded(static_cast<int>(of.coordinates_.size())), kFields * (2 * of.reach_ + 1)},
        e(of.work_.e),
        p(of.work_.p),
        d(of.work_.d) {}

  // As of strips, all three.
  Certificate solve(const Position& position, Step& step, const double* z, const double* lag) {
    const int present = static_cast<int>(position.slot.size());
    const double* line = dynamics.stream_.data() + position.line;
    for (int j = 0; j < present; ++j, line += record.size()) {
      Lanes modal{}, driver{}, driven{};
      for (int c = 0; c < record.coordinates; c += kLanes)
        modal += lanes(line + LineRecord::kShape + c) * lanes(z + c);
      for (int k = 0; k < record.fields; k += kLanes) {
        driver += lanes(line + record.reading(0) + k) * lanes(lag + k);
        driven += lanes(line + record.reading(1) + k) * lanes(lag + record.fields + k);
      }
      e[j] = line[LineRecord::kGap] + sum((driver + driven) - modal);
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
    if (!(force <= dynamics.stream_[position.line + j * record.size() + LineRecord::kMost]))
      require_line_range(position.mesh, p.head(position.mesh.strips()));
    return true;
  }

  void spread(const Position& position, double* force, double* load) const {
    const int present = static_cast<int>(position.slot.size());
    const double* line = dynamics.stream_.data() + position.line;
    std::fill(force, force + record.coordinates, 0.0);
    for (int j = 0; j < present; ++j, line += record.size()) {
      for (int c = 0; c < record.coordinates; c += kLanes)
        lanes(force + c) += p[j] * lanes(line + LineRecord::kShape + c);
      for (int g = 0; g < 2; ++g)
        for (int k = 0; k < kFields; k += kLanes)
          lanes(load + g * record.fields + position.slot[j] * kFields + k) =
              p[j] * lanes(line + record.weight(g) + k);
    }
  }

  RollingDynamics& dynamics;
  LineRecord record;
  VectorXd &e, &p, &d;  // (pair)
};

void RollingDynamics::take(const State& state) {
  const int own = static_cast<int>(coordinates_.size()), fields = kFields * (2 * reach_ + 1);
  work_.z.head(own) = state.z;
  work_.v.head(own) = state.v;
  work_.force.head(own) = state.force;
  for (int g = 0; g < 2; ++g) {
    work_.lag.segment(g * fields, fields) = state.lag[g].reshaped();
    work_.load.segment(g * fields, fields) = state.load[g].reshaped();
  }
}

void RollingDynamics::give(State& state) const {
  const int own = static_cast<int>(coordinates_.size()), fields = kFields * (2 * reach_ + 1);
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
  try {
    return lines() ? march(LineContact(*this), state, period, ledger)
                   : march(StripContact(*this), state, period, ledger);
  } catch (const Error& error) {
    const std::string words = error.what(), start = "at mesh phase ";
    if (words.rfind(start, 0) == 0) throw;
    fail(error.kind(), start, phase_, " ", words);
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

  // Stores of lanes may change anything for all that the compiler knows; it need not look these up again.
  double *const z_at = work_.z.data(), *const v_at = work_.v.data(), *const force_at = work_.force.data(),
                *const response_at = work_.response.data(), *const lag_at = work_.lag.data(),
                *const load_at = work_.load.data();
  const VectorXd &torque = work_.torque, &weight = work_.weight;
  const double *const torque_at = torque.data(), *const weight_at = weight.data(),
                      *const a11 = speed_.a11.data(), *const a12 = speed_.a12.data(),
                      *const a21 = speed_.a21.data(), *const a22 = speed_.a22.data(),
                      *const bq = speed_.bq.data(), *const bv = speed_.bv.data();
  const Lag lag_step = lag_;

  std::array<Instant, 2>& instants = ledger_work_.instants;
  ledger_work_.balance = 0;
  if (ledger) fill(instants[0], positions_[0], state.p.data(), state.d.data());
  for (int i = 1; i <= steps_; ++i) {
    const int sample = i == steps_ ? 0 : i;
    if (sample == 0) {
      for (double* y : {z_at, v_at, force_at}) turn_doublets(y);
      for (double* x : {lag_at, load_at}) advance_fields(x);
      if (ledger) rename(instants[(i - 1) % 2]);
    }
    const Position& position = positions_[sample * stride_];
    const int present = static_cast<int>(position.slot.size());
    phase_ = position.mesh.phase;

    // What the step would bring without new contact force.
    for (int c = 0; c < coordinates; c += kLanes) {
      const Lanes mean = 0.5 * (lanes(force_at + c) + lanes(torque_at + c)), z0 = lanes(z_at + c),
                  v0 = lanes(v_at + c);
      const Lanes z1 = lanes(a11 + c) * z0 + lanes(a12 + c) * v0 + lanes(bq + c) * mean;
      lanes(v_at + c) = lanes(a21 + c) * z0 + lanes(a22 + c) * v0 + lanes(bv + c) * mean;
      lanes(z_at + c) = z1;
    }
    for (int k = 0; k < 2 * fields; k += kLanes) {
      lanes(lag_at + k) = lag_step.decay * lanes(lag_at + k) + lag_step.from_old * lanes(load_at + k);
      lanes(load_at + k) = Lanes{};
    }
    const Certificate certificate = contact.solve(position, step_data_[sample], z_at, lag_at);
    period.least_gap = std::min(period.least_gap, certificate.least_gap);
    period.least_force = std::min(period.least_force, certificate.least_force);
    period.fallbacks += certificate.fallback;

    // The new force's own share.
    double drift = 0;
    for (int j = 0; j < present; ++j) {
      double carried;
      if (!contact.carried(position, j, carried)) return false;
      period.pair_load(position.slot[j], sample) = carried;
      drift += position.drift_lever[j] * carried;
    }
    period.drift_force = std::max(period.drift_force, std::abs(drift));
    contact.spread(position, response_at, load_at);
    Lanes error_sum{};
    for (int c = 0; c < coordinates; c += kLanes) {
      const Lanes push = lanes(response_at + c);
      const Lanes z1 = lanes(z_at + c) - 0.5 * lanes(bq + c) * push;
      lanes(force_at + c) = lanes(torque_at + c) - push;
      lanes(v_at + c) -= 0.5 * lanes(bv + c) * push;
      lanes(z_at + c) = z1;
      error_sum += lanes(weight_at + c) * z1;
    }
    for (int g = 0; g < 2; ++g)
      for (int j = 0; j < present; ++j) {
        const int own_fields = g * fields + position.slot[j] * kFields;
        for (int k = own_fields; k < own_fields + kFields; k += kLanes)
          lanes(lag_at + k) += lag_step.from_new * lanes(load_at + k);
      }

    if (ledger) {
      fill(instants[i % 2], position, contact.p.data(), contact.d.data());
      record_step(instants[(i - 1) % 2], instants[i % 2], *ledger);
    }

    const double error = sum(error_sum);
    period.transmission_error[sample] = error;
    if (error > position.mesh.lost_corner_gap)
      fail(Failure::numerical, "at mesh phase ", position.mesh.phase, " the transmission error ", error * 1e6,
           " micrometres closes the gap of ", position.mesh.lost_corner_gap * 1e6,
           " micrometres of a tip edge that would touch below the involute; lower the torque or set "
           "corner_contact = false");
    if (error > position.mesh.next_corner_gap) return false;
  }
  give(state);
  const int strips = positions_[0].mesh.strips();
  state.p = contact.p.head(strips);
  state.d = contact.d.head(strips);
  return true;
}

}  // namespace whine
