#include "motion/dynamics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/dense.h"
#include "base/error.h"
#include "base/refusal.h"
#include "contact/lanes.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

// Throws Error(input) if a range, with those beside it, takes more memory than a scene may.
template <class... Words>
void require_memory(double own, double beside, double most, const char* remedy, const Words&... what) {
  if (own + beside <= most) return;
  constexpr double kGB = 1e9;  // bytes
  const std::string others =
      beside > 0 ? text(" beside the ", beside / kGB, " GB of narrower contact windows, which stay") : "";
  fail(Failure::input, what..., " need ", own / kGB, " GB", others, ", at most ", most / kGB, " are allowed",
       beside > 0 ? " for all windows together" : "", "; ", remedy);
}

}  // namespace

MotionBounds::MotionBounds(const GearMeshModel& model, const StaticArtifact& statics, double widening) {
  constexpr double kBeyondStatics = 2.5;
  force = kBeyondStatics * (statics.torque / model.kinematics.gear(0).base_radius()) * widening;
  // Beside what load adds: teeth that differ are near or far as they are.
  const VectorXd& without_load = statics.unloaded_error;
  if (statics.mesh.on_bearings())  // what the mesh gives way, without the bearings
    deflection = kBeyondStatics * (statics.torque / model.kinematics.gear(0).base_radius()) /
                 statics.stiffness_secant.minCoeff();
  else
    deflection = kBeyondStatics * (statics.hunting_periods == 1
                                       ? statics.transmission_error.maxCoeff()
                                       : (statics.transmission_error - without_load).maxCoeff());
  if (statics.hunting_periods > 1) deflection += std::max(0.0, without_load.maxCoeff());
  deflection *= widening;
}

ContactRange contact_range(const GearMeshModel& model, const StaticArtifact& statics,
                           const MotionBounds& bounds) {
  const double load = statics.torque / model.kinematics.gear(0).base_radius();
  return contact_range(model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(),
                       statics.contact.strips, load / model.kinematics.contact_ratio(), bounds.force,
                       bounds.deflection, model.flanks());
}

RollingDynamics::RollingDynamics(const GearMeshModel& model, const DynamicParameters& parameters)
    : model_(model),
      parameters_(parameters),
      full_(parameters.fidelity.body == BodyModel::full),
      lines_(parameters.fidelity.contact == ContactModel::line),
      newmark_(parameters.fidelity.integrator == Integrator::newmark),
      floating_(model.on_bearings()),
      relaxation_(full_ || parameters.fidelity.body == BodyModel::quasi_static
                      ? 0
                      : parameters.damping.rayleigh_stiffness) {
  const BodyModel rung = parameters.fidelity.body;
  if (full_ && floating_)
    fail(Failure::input,
         "body = \"full\" in [fidelity] has no bearings: set body = \"modal\" or take the [[bearing]] "
         "sections out");
  double inverse_mass = 0;
  for (int g = 0; g < 2; ++g) {
    if (model.gear[g].cracked())
      fail(Failure::input, "the ", g ? "driven gear" : "driver", " has a crack in tooth ",
           model.gear[g].body().design.crack.tooth,
           ": motion does not yet follow a tooth that is softer than the others; statics do (make static), "
           "or take the "
           "section [gear.<name>.crack] out");
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
    if (rung != BodyModel::rigid) {
      if (torsional < 0) fail(Failure::input, "the body holds no torsional mode; rebuild body.h5");
      for (int i = 0; i < body.eigenfrequency.size(); ++i)
        if (rung == BodyModel::modal || full() || i == torsional) kept_[g].push_back(i);
      if (model.bearing[g].elastic()) {
        int swaying = -1;  // the first with one diameter; modes ascend
        for (int i = static_cast<int>(body.eigenfrequency.size()) - 1; i >= 0; --i)
          if (body.nodal_diameter[i] == 1) swaying = i;
        if (swaying < 0)
          fail(Failure::input, "the body of the ", g ? "driven gear" : "driver", " holds ",
               body.eigenfrequency.size(),
               " modes and none of them has one nodal diameter, as a gear on a bearing needs; raise modes in "
               "[fidelity]");
        if (rung != BodyModel::modal)
          for (const int half : {swaying, model.gear[g].partner(swaying)}) kept_[g].push_back(half);
        std::sort(kept_[g].begin(), kept_[g].end());
      }
    }
    if (full() && body.discretisation.modes != kAllModes)
      fail(Failure::input, "body = \"full\" needs a body with every mode of its mesh, that of the ",
           g ? "driven gear" : "driver", " holds ", body.eigenfrequency.size(), " modes; rebuild body.h5");
    first_coordinate_[g] = static_cast<int>(coordinates_.size());
    add_modes(g, kept_[g]);
  }

  const int n = static_cast<int>(coordinates_.size());
  error_weight_ = torque_force_ = frequency_squared_ = closing_weight_ = VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) {
    for (int g = 0; g < 2; ++g)
      error_weight_[i] += model.kinematics.gear(g).base_radius() * coordinates_[i].hub[g];
    closing_weight_[i] = error_weight_[i];
    if (const int g = coordinates_[i].gear; g >= 0)
      closing_weight_[i] += model.outward(g).dot(coordinates_[i].shift);
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

  std::vector<int> torsional, swaying, others;
  for (int column : columns) {
    const int diameters = body.nodal_diameter[column];
    const bool sways = diameters == 1 && model_.bearing[g].elastic();
    (diameters == 0 ? torsional : sways ? swaying : others).push_back(column);
  }

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
    const SymmetricEigen eigen = symmetric_eigen(stiffness, mass);
    if (!eigen.converged || !(eigen.values[1] > 0))
      fail(Failure::numerical, "the ", k, " torsional modes of the ", g ? "driven gear" : "driver", ", from ",
           body.eigenfrequency[torsional[0]], " Hz with the hub fixed, have no frequencies at an inertia of ",
           parameters_.inertia[g], " kg m2, of which they couple ", mass.row(0).tail(k).squaredNorm(),
           "; rebuild body.h5");
    for (int i = 1; i <= k; ++i) {  // 0 is the rigid rotation
      Coordinate c;
      c.gear = g;
      VectorXd shape = eigen.vectors.col(i);
      if (shape[0] < 0) shape = -shape;
      c.frequency = std::sqrt(eigen.values[i]);
      c.damping = damping(c.frequency);
      c.hub[g] = shape[0];
      c.torque = shape[0] * torque;
      for (int m = 0; m < k; ++m) c.columns.emplace_back(torsional[m], shape[m + 1]);
      coordinates_.push_back(c);
    }
  }
  if (model_.bearing[g].elastic()) add_sway(g, swaying);
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

// Translation t = (x, y) and modes q with one diameter: with x + i y = Z and q_cosine + i q_sine = Q of each doublet the hub
// moves by Re(conj(Z) T), T the translation along x plus i times that along y, and the body by Re(conj(Q) Phi). The coupling
// c = Phi^H M T of a doublet is then one complex number, whose angle goes into the doublet's own: what is left is one real
// problem [[m, |c|], [|c|, 1]] v'' + diag(k, w^2) v = 0 of half the size with two equal coordinates for each of its modes,
// here along the line of action and across.
void RollingDynamics::add_sway(int g, const std::vector<int>& columns) {
  const ElasticGear& gear = model_.gear[g];
  const BodyArtifact& body = gear.body();
  const Bearing& bearing = model_.bearing[g];
  const Damping& damping = parameters_.damping;
  std::vector<int> cosine;
  for (const int column : columns)
    if (body.component[column] == 0) cosine.push_back(column);
  const int k = static_cast<int>(cosine.size());
  MatrixXd mass = MatrixXd::Identity(k + 1, k + 1), stiffness = MatrixXd::Zero(k + 1, k + 1);
  VectorXd angle(k);  // rad, of c
  mass(0, 0) = bearing.mass > 0 ? bearing.mass : body.mass;
  stiffness(0, 0) = bearing.stiffness;
  for (int i = 0; i < k; ++i) {
    const double w = kTwoPi * body.eigenfrequency[cosine[i]];
    const Vec2 c = body.translation_coupling.row(cosine[i]);
    mass(0, i + 1) = mass(i + 1, 0) = c.norm();
    angle[i] = std::atan2(c.y(), c.x());
    stiffness(i + 1, i + 1) = w * w;
  }
  if (!(mass(0, 0) >= body.mass))
    fail(Failure::input, "mass_kg = ", bearing.mass, " in the [[bearing]] of the ",
         g ? "driven gear" : "driver", " lies below the mass of its own body, ", body.mass,
         " kg: it is that of all that moves with the hub; raise it");
  const SymmetricEigen eigen = symmetric_eigen(stiffness, mass);
  if (!eigen.converged || !(eigen.values[0] > 0))
    fail(Failure::numerical, "the ", g ? "driven gear" : "driver", " of ", mass(0, 0), " kg and ", k,
         " modes with one diameter, which couple ", mass.row(0).tail(k).squaredNorm(),
         " kg of it, has no frequencies on its bearing of ", bearing.stiffness, " N/m; rebuild body.h5");

  const Vec2 along = model_.outward(g), across(-along.y(), along.x());
  // Of the line of action in the frame of the mesh of the body at phase 0.
  const double direction = std::atan2(along.y(), along.x()) - placed(model_.kinematics, g).angle;
  Sway& sway = sway_[g];
  sway.first = static_cast<int>(coordinates_.size());
  sway.count = 2 * (k + 1);
  sway.tooth_angle = kTwoPi / body.design.teeth;
  sway.there = sway.quarter_on = MatrixXd::Zero(gear.table_size(), sway.count);
  for (int i = 0; i <= k; ++i) {
    VectorXd shape = eigen.vectors.col(i);
    if (shape[0] < 0) shape = -shape;
    for (const bool second : {false, true}) {
      Coordinate c;
      c.gear = g;
      c.frequency = std::sqrt(eigen.values[i]);
      c.shift = shape[0] * (second ? across : along);
      // Eq. 21 of the body; the bearing is no part of its stiffness matrix and has a damper of its own.
      c.elastic = std::max(0.0, eigen.values[i] - bearing.stiffness * shape[0] * shape[0]);
      c.damping = damping.rayleigh_mass + damping.rayleigh_stiffness * c.elastic +
                  bearing.damping * shape[0] * shape[0];
      const int column = static_cast<int>(coordinates_.size()) - sway.first;
      for (int m = 0; m < k; ++m) {
        const double turned = direction - angle[m] + (second ? 0.25 * kTwoPi : 0);
        const int here = cosine[m], other = gear.partner(here);
        const VectorXd real = body.flank_mode.col(here), imaginary = body.flank_mode.col(other);
        const double on_cosine = shape[m + 1] * std::cos(turned), on_sine = shape[m + 1] * std::sin(turned);
        sway.there.col(column) += on_cosine * real + on_sine * imaginary;
        sway.quarter_on.col(column) += on_sine * real - on_cosine * imaginary;
      }
      coordinates_.push_back(c);
    }
  }
}

double RollingDynamics::bearing_damper(int g) const {
  return 2 * parameters_.damping.bearing_ratio * parameters_.inertia[g] * rigid_frequency_;
}

namespace {

// (flank, field) orthonormal: the loads of a flank that its own displacements, and before all those of its neighbours,
// depend on most, those that neighbours depend on first, `shared` of them. tables: flexibility of gear g by offset between
// teeth, -max..max.
MatrixXd lagged_fields(const std::vector<MatrixXd>& tables, int g, int most, int shared) {
  const int max = static_cast<int>(tables.size()) / 2, m = static_cast<int>(tables[max].rows());
  // What a tooth and all others within the body's offsets do to each other has rank 7 to 9 to 1e-8 of the tooth's own
  // flexibility (16 to 50 teeth, undamped depths up to 1 m). The weight takes it whole; the fields left over go to
  // the tooth itself.
  constexpr double kNeighbourWeight = 1e6;
  // What no field holds follows at once. With 12 fields it is 5e-5 of the whole for 50 teeth, 1e-4 for 16; a body that
  // leaves ten times that is no tooth that fields were chosen for. Between teeth the 8 shared fields leave 6e-7.
  constexpr double kMostRemainder = 1e-3;
  MatrixXd importance = tables[max] * tables[max];
  for (int offset = -max; offset <= max; ++offset)
    if (offset != 0) importance += kNeighbourWeight * tables[offset + max] * tables[offset + max].transpose();
  const SymmetricEigen eigen = symmetric_eigen(importance);
  if (!eigen.converged)
    fail(Failure::numerical, "the lagged fields of the ", g ? "driven gear" : "driver",
         " were not found: its ", m, " flank points have a flexibility of norm ", tables[max].norm(),
         " m/N; rebuild body.h5");
  const MatrixXd fields = eigen.vectors.rightCols(std::min(most, m)).rowwise().reverse();
  const double whole = tables[max].norm();
  for (int offset = -max; offset <= max; ++offset) {
    const MatrixXd& r = tables[offset + max];
    const auto held =
        fields.leftCols(offset == 0 ? fields.cols() : std::min<Eigen::Index>(shared, fields.cols()));
    const double rest = (r - held * (held.transpose() * r * held) * held.transpose()).norm();
    if (!(rest <= kMostRemainder * whole))
      fail(Failure::numerical, "the ", held.cols(), " lagged fields of the ", g ? "driven gear" : "driver",
           " leave ", rest / whole, " of a tooth's residual flexibility to follow at once (between teeth ",
           offset, " apart), above ", kMostRemainder, "; rebuild body.h5 with more modes or finer elements");
  }
  return fields;
}

}  // namespace

void RollingDynamics::set_range(const ContactRange& range, int steps, const WindowMemory& beside) {
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
  memory_ = {};
  for (const Position& position : positions_)
    memory_.coordinates += 8.0 * static_cast<double>(coordinates_.size()) *
                           (position.mesh.nodes() + (lines() ? 1.0 : static_cast<double>(kShapeRows)) *
                                                        static_cast<double>(position.mesh.pairs.size()));
  require_memory(
      memory_.coordinates, beside.coordinates, kMostMemory,
      "set contact = \"line\", lower min_sample_rate_kHz or raise the lowest speed, or take body = "
      "\"modal\"",
      coordinates_.size(), " coordinates at ", steps, " positions of a mesh period");

  std::array<std::vector<MatrixXd>, 2> tables;  // by offset between teeth, -2 reach..2 reach
  for (int g = 0; g < 2; ++g) {
    const int m = model_.gear[g].table_size();
    const bool rigid = parameters_.fidelity.body == BodyModel::rigid;
    for (int offset = -2 * reach_; offset <= 2 * reach_; ++offset)
      tables[g].push_back(rigid ? MatrixXd::Zero(m, m) : model_.gear[g].residual(offset, depth, kept_[g]));
    // Of all offsets that the body holds, so that the state keeps its meaning when a wider range reaches more teeth.
    std::vector<MatrixXd> known;
    const int offsets = model_.gear[g].body().offsets;
    for (int offset = -offsets; offset <= offsets; ++offset)
      known.push_back(rigid ? MatrixXd::Zero(m, m) : model_.gear[g].residual(offset, depth, kept_[g]));
    fields_[g] = full() ? MatrixXd::Zero(m, kFields) : lagged_fields(known, g, kFields, kSharedFields);
    coupling_[g].clear();
    for (int offset = -2 * reach_; offset <= 2 * reach_; ++offset) {
      const int n = offset == 0 ? kFields : kSharedFields,
                own = std::min(n, static_cast<int>(fields_[g].cols()));
      const auto fields = fields_[g].leftCols(own);
      MatrixXd block = MatrixXd::Zero(n, n);
      block.topLeftCorner(own, own) =
          fields.transpose() * tables[g][GearMeshModel::tooth(g, offset) + 2 * reach_] * fields;
      coupling_[g].push_back(block);
    }
  }
  for (Position& position : positions_) {
    const MeshPosition& mesh = position.mesh;
    position.participation = participation(mesh);
    MatrixXd left_out = MatrixXd::Zero(mesh.nodes(), mesh.nodes());
    if (!lines()) {
      left_out = modal_flexibility(position);
      for (size_t i = 0; i < mesh.pairs.size(); ++i) {
        auto rows = position.participation.middleRows<kWindowNodes>(i * kWindowNodes);
        rows = (shape_basis() * (shape_basis().transpose() * rows)).eval();
      }
      left_out -= modal_flexibility(position);
    }
    position.lagged = MatrixXd::Zero(mesh.nodes(), mesh.nodes());
    MatrixXd whole = position.lagged;
    for (int g = 0; g < 2; ++g) {
      whole += body_compliance(mesh, g, tables[g]);
      position.field_weight[g] = MatrixXd::Zero(mesh.nodes(), kFields);
      position.field_weight[g].leftCols(fields_[g].cols()) = mesh.table_weights[g] * fields_[g];
      for (size_t i = 0; i < mesh.pairs.size(); ++i)
        for (size_t j = 0; j < mesh.pairs.size(); ++j) {
          const MatrixXd& block = coupling(g, mesh.pairs[i].pair - mesh.pairs[j].pair);
          const auto rows = [&](size_t pair) {
            return position.field_weight[g](mesh.nodes_of(pair), Eigen::seqN(0, block.cols()));
          };
          position.lagged(mesh.nodes_of(i), mesh.nodes_of(j)) += rows(i) * block * rows(j).transpose();
        }
    }
    position.at_once = whole - position.lagged + left_out;
    if (mesh.pairs.size() > kMostPairs)
      fail(Failure::numerical, "at mesh phase ", mesh.phase, " ", mesh.pairs.size(),
           " pairs are in reach, at most ", kMostPairs, " are foreseen");
    Frame& frame = position.frame;
    frame.present = static_cast<int>(mesh.pairs.size());
    frame.of_pair = frame.present > 0 ? mesh.strips() / frame.present : 0;
    frame.law = mesh.law;
    frame.next_corner_gap = mesh.next_corner_gap;
    frame.lost_corner_gap = mesh.lost_corner_gap;
    for (int j = 0; j < frame.present; ++j) {
      const PairStrips& s = mesh.pairs[j];
      frame.pair[j].slot = s.pair + reach_;
      frame.pair[j].low_is_edge = s.low_is_edge;
      frame.pair[j].high_is_edge = s.high_is_edge;
      frame.pair[j].drift_lever = s.contact.lever[0] / model_.kinematics.gear(0).base_radius() -
                                  s.contact.lever[1] / model_.kinematics.gear(1).base_radius();
    }
  }
  step_data_.clear();
  step_memory_ = HugeBlock();
  set_hunting_gaps(beside.gaps);
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

void RollingDynamics::set_hunting_gaps(double beside) {
  hunting_ = whine::hunting_periods(model_);
  hunting_gap_.clear();
  if (hunting_ == 1) return;
  size_t strips = 0;
  for (Position& position : positions_) {
    position.hunting = strips;
    strips += static_cast<size_t>(position.mesh.strips());
  }
  constexpr double kMostMemory = 2e9;  // bytes
  memory_.gaps = 8.0 * static_cast<double>(strips) * hunting_;
  require_memory(
      memory_.gaps, beside, kMostMemory,
      "set contact = \"line\", lower min_sample_rate_kHz and steps_per_period, or raise the lowest speed",
      "teeth that differ meet again after ", hunting_, " mesh periods, whose gaps at ", positions_.size(),
      " positions each");
  hunting_gap_.resize(strips * static_cast<size_t>(hunting_));
  for (int period = 0; period < hunting_; ++period)
    for (const Position& position : positions_)
      Eigen::Map<VectorXd>(&hunting_gap_[static_cast<size_t>(period) * strips + position.hunting],
                           position.mesh.strips()) = flank_gaps(model_, position.mesh, period);
}

void RollingDynamics::put_gap(Position& position, int period) {
  const double* gap =
      &hunting_gap_[hunting_gap_.size() / static_cast<size_t>(hunting_) * static_cast<size_t>(period) +
                    position.hunting];
  const int strips = position.mesh.strips();
  std::copy(gap, gap + strips, position.mesh.gap.data());
  pack_gap(position);
}

const MatrixXd& RollingDynamics::shape_on_tooth(int g, int tooth) const {
  const auto [at, fresh] = shape_[g].try_emplace(tooth);
  if (fresh) {
    const int count =
        (g == 0 ? first_coordinate_[1] : static_cast<int>(coordinates_.size())) - first_coordinate_[g];
    std::map<int, VectorXd> mode;  // of columns that several coordinates share
    at->second = MatrixXd::Zero(model_.gear[g].table_size(), count);
    for (int c = 0; c < count; ++c)  // those of a Sway have no columns: they see the phase, too
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
  for (size_t c = 0; c < coordinates_.size(); ++c)
    for (int g = 0; g < 2; ++g) h.col(c) += coordinates_[c].hub[g] * mesh.node_lever[g];
  for (int g = 0; g < 2; ++g)
    for (size_t i = 0; i < mesh.pairs.size(); ++i) {
      const MatrixXd& shape = shape_on_tooth(g, GearMeshModel::tooth(g, mesh.pairs[i].pair));
      h.middleCols(first_coordinate_[g], shape.cols())(mesh.nodes_of(i), Eigen::all) +=
          mesh.table_weights[g](mesh.nodes_of(i), Eigen::all) * shape;
      const Sway& sway = sway_[g];
      if (sway.count == 0) continue;
      const double angle = sway.tooth_angle * (GearMeshModel::tooth(g, mesh.pairs[i].pair) +
                                               (g == 0 ? mesh.phase : -mesh.phase));
      const Vec2 outward = model_.outward(g, mesh.pairs[i].contact);
      auto rows = h.middleCols(sway.first, sway.count)(mesh.nodes_of(i), Eigen::all);
      rows += mesh.table_weights[g](mesh.nodes_of(i), Eigen::all) *
              (std::cos(angle) * sway.there + std::sin(angle) * sway.quarter_on);
      for (int c = 0; c < sway.count; ++c) {
        const int coordinate = sway.first + c;
        rows.col(c).array() += outward.dot(coordinates_[static_cast<size_t>(coordinate)].shift);
      }
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
  speed_.number.setZero(SpeedCoefficients::kCount * padded(n));
  Propagator a{};  // the halves of a doublet have one
  for (int i = 0; i < n; ++i) {
    const Coordinate& c = coordinates_[i];
    if (i == 0 || c.frequency != coordinates_[i - 1].frequency || c.damping != coordinates_[i - 1].damping)
      a = newmark_ ? newmark_propagator(c.frequency, c.damping, h)
                   : exact_propagator(c.frequency, c.damping, h);
    speed_.at(SpeedCoefficients::a11, i) = a.a11;
    speed_.at(SpeedCoefficients::a12, i) = a.a12;
    speed_.at(SpeedCoefficients::a21, i) = a.a21;
    speed_.at(SpeedCoefficients::a22, i) = a.a22;
    speed_.at(SpeedCoefficients::push_z, i) = a.a11 * a.bq + a.a12 * a.a12 + a.bq;
    speed_.at(SpeedCoefficients::push_v, i) = a.a21 * a.bq + a.a22 * a.a12 + a.a12;
    speed_.at(SpeedCoefficients::bq, i) = a.bq;
    speed_.at(SpeedCoefficients::torque, i) = torque_force_[i];
    speed_.at(SpeedCoefficients::weight, i) = error_weight_[i];
  }
  lag_ = lag_step(relaxation(), h);
  damping_ = damping_integrals();

  // Memory stays; so do the active strips, or the forces, of a step at the same phase, as a first guess.
  const int before = static_cast<int>(step_data_.size());
  if (before != steps) {
    std::vector<std::pair<std::vector<int>, PairVector>> known(steps);
    for (int i = 0; i < steps && before > 0; ++i)
      if (i * before % steps == 0) {
        Step& step = step_data_[i * before / steps];
        known[i] = {std::move(step.active.strips), step.force};
      }
    step_data_.clear();
    const auto size_of = [this](const Position& position) {
      const int pairs = position.frame.present;
      return lines() ? Step::Size{pairs, pairs, 0}
                     : Step::Size{pairs * kPairNodes, pairs * kWindowNodes, position.mesh.strips()};
    };
    // Once for all speeds: only what a speed has steps for is ever touched.
    if (!step_memory_.data()) {
      size_t numbers = 0;
      for (const Position& position : positions_) numbers += size_of(position).numbers();
      step_memory_ = HugeBlock(numbers * sizeof(double));
    }
    step_pool_ = std::make_unique<std::pmr::monotonic_buffer_resource>(
        step_memory_.data(), step_memory_.bytes(), std::pmr::null_memory_resource());
    step_data_.reserve(steps);
    for (int i = 0; i < steps; ++i) {
      Step& step = step_data_.emplace_back(size_of(positions_[i * stride_]), step_pool_.get());
      std::tie(step.active.strips, step.force) = std::move(known[i]);
    }
  }
  MatrixXd at_nodes;
  for (int i = 0; i < steps; ++i) {
    const Position& position = positions_[i * stride_];
    step_data_[i].active.forget();
    step_data_[i].start.forget();
    at_nodes = position.at_once + lag_.from_new * position.lagged;
    add_response(position, at_nodes);
    if (lines())
      step_data_[i].compliance = at_nodes;
    else
      put_at_nodes(at_nodes, step_data_[i].compliance.data());
  }
}

MatrixXd RollingDynamics::local_compliance(const Position& position) const {
  if (lines()) return position.at_once;
  MatrixXd a(position.mesh.strips(), position.mesh.strips());
  strip_compliance(position, &stream_[position.frame.at_once]).assemble(a.data());
  return a;
}

VectorXd RollingDynamics::flexibility() const {
  VectorXd f = frequency_squared_;
  for (int i = 0; i < f.size(); ++i) f[i] = coordinates_[i].gear < 0 ? 0 : 1 / f[i];
  return f;
}

MatrixXd RollingDynamics::modal_flexibility(const Position& position) const {
  return position.participation * flexibility().asDiagonal() * position.participation.transpose();
}

// Elastic coordinates follow their force, z = (torque - h f) / w^2; the rigid one carries the load.
MatrixXd RollingDynamics::static_compliance(const Position& position) const {
  MatrixXd a = local_compliance(position);
  position.mesh.add_to_strips(position.lagged + modal_flexibility(position), a);
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

RollingDynamics::Frozen RollingDynamics::frozen(int i, int period) {
  set_gap(positions_[i], period);
  const Position& position = positions_[i];
  const VectorXd p = equilibrium_at(position, static_compliance(position), elastic_offset(position)).p;
  std::vector<int> touch;
  for (int k = 0; k < p.size(); ++k)
    if (p[k] > 0) touch.push_back(k);
  // d = 0 on the active strips: p = (A + R)^-1 h z there, and z'' + (w^2 + h^T (A + R)^-1 h) z = 0.
  MatrixXd a = local_compliance(position);
  position.mesh.add_to_strips(position.lagged, a);
  for (size_t j = 0; j < position.mesh.law.size(); ++j) a(j, j) += position.mesh.law[j].at(p[j]).slope;
  MatrixXd h(position.mesh.strips(), position.participation.cols());
  for (int c = 0; c < h.cols(); ++c) h.col(c) = position.mesh.to_strips(position.participation.col(c));
  return {a(touch, touch), h(touch, Eigen::all)};
}

SymmetricEigen RollingDynamics::frozen_modes(int i, const Frozen& contact, bool vectors) const {
  const MatrixXd& h = contact.participation;
  MatrixXd stiffness = h.transpose() * contact.compliance.ldlt().solve(h);
  stiffness.diagonal() += frequency_squared_;
  SymmetricEigen eigen = vectors ? symmetric_eigen(stiffness) : symmetric_eigenvalues(stiffness);
  if (!eigen.converged || !(eigen.values[0] > 0))
    fail(Failure::numerical, "at mesh phase ", positions_[i].mesh.phase, " the pair with ", h.rows(),
         " strips in contact has no natural frequency: least eigenvalue ", eigen.values[0],
         " rad2/s2 of a stiffness of norm ", stiffness.norm());
  return eigen;
}

double RollingDynamics::frozen_frequency(int i, int period) {
  const Frozen contact = frozen(i, period);
  if (full()) return std::sqrt(condensed_eigenvalue(contact.compliance, contact.participation)) / kTwoPi;
  const SymmetricEigen eigen = frozen_modes(i, contact, floating_);
  Eigen::Index mode = 0;
  if (floating_)
    (eigen.vectors.transpose() * closing_weight_).cwiseAbs2().cwiseQuotient(eigen.values).maxCoeff(&mode);
  return std::sqrt(eigen.values[mode]) / kTwoPi;
}

VectorXd RollingDynamics::frozen_frequencies(int i, int period) {
  return frozen_modes(i, frozen(i, period), false).values.cwiseSqrt() / kTwoPi;
}

MatrixXd RollingDynamics::bearing_damping() const {
  MatrixXd all = MatrixXd::Zero(frequency_squared_.size(), frequency_squared_.size());
  for (int i = 0; i < all.rows(); ++i) all(i, i) = coordinates_[i].damping;
  for (int g = 0; g < 2; ++g) {
    const Bearing& bearing = model_.bearing[g];
    const double beside = bearing.damping - parameters_.damping.rayleigh_stiffness * bearing.stiffness;
    for (int i = sway_[g].first; i < sway_[g].first + sway_[g].count; ++i)
      for (int j = sway_[g].first; j < sway_[g].first + sway_[g].count; ++j)
        if (i != j) all(i, j) = beside * coordinates_[i].shift.dot(coordinates_[j].shift);
  }
  return all;
}

void RollingDynamics::take_bearing_force(Period& period, int sample) const {
  for (int g = 0; g < 2; ++g) {
    const Bearing& bearing = model_.bearing[g];
    if (!bearing.elastic()) continue;
    Vec2 force = Vec2::Zero();
    for (int c = sway_[g].first; c < sway_[g].first + sway_[g].count; ++c)
      force += coordinates_[c].shift * (bearing.stiffness * work_.z[c] + bearing.damping * work_.v[c]);
    period.bearing_force[g].col(sample) = force;
  }
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
  if (floating_) {
    held.closing_weight = closing_weight_;
    held.elastic = frequency_squared_;
    for (const Sway& sway : sway_)
      for (int c = sway.first; c < sway.first + sway.count; ++c) held.elastic[c] = coordinates_[c].elastic;
  }
  held.torque = torque_force_;
  held.error_weight = error_weight_;
  held.local = local_compliance(position);
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
  held.newmark = newmark_;
  return held;
}

RollingDynamics::State RollingDynamics::rest() {
  set_gap(positions_[0], 0);
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
  // Teeth that differ are ahead or behind without load, too.
  if (hunting_ > 1)
    nothing.z[0] = unloaded_transmission_error(model_, position.mesh.phase) / error_weight_[0];
  energy_scale_ = 1;
  energy_scale_ = distance(state, nothing);
  return state;
}

VectorXd RollingDynamics::difference(const State& a, const State& b) const {
  if (!(energy_scale_ > 0))
    fail(Failure::input, "states are compared on the scale of rest(); call it once after set_range()");
  const Eigen::Index n = a.z.size();
  VectorXd both(2 * n);
  both << (a.z - b.z).cwiseProduct(frequency_squared_.cwiseSqrt()), a.v - b.v;
  both[0] = rigid_frequency_ * (a.z[0] - b.z[0]);
  return both / energy_scale_;
}

}  // namespace whine
