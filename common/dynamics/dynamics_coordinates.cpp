// The coordinates of gears, and what flanks move by them.
#include "dynamics/dynamics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/dense.h"
#include "base/error.h"
#include "base/units.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

RollingDynamics::RollingDynamics(const GearMeshModel& model, const DynamicParameters& parameters)
    : model_(model),
      parameters_(parameters),
      full_(parameters.fidelity.body == BodyModel::full),
      lines_(parameters.fidelity.contact == ContactModel::line),
      newmark_(parameters.fidelity.integrator == Integrator::newmark),
      floating_(model.on_bearings()),
      relaxation_(full_ || parameters.fidelity.body == BodyModel::quasi_static
                      ? 0
                      : parameters.damping.rayleigh_stiffness),
      sway_(model.gear.size()),
      shape_(model.gear.size()) {
  require_bodies();
  add_rigid_rotation();
  for (int g = 0; g < gears(); ++g) {
    kept_.push_back(modes_of(g));
    first_coordinate_.push_back(static_cast<int>(coordinates_.size()));
    add_modes(g, kept_[g]);
  }
  first_coordinate_.push_back(static_cast<int>(coordinates_.size()));
  weigh_coordinates();
  if (model_.friction.acts()) set_friction(model_.friction.static_frequency);
}

void RollingDynamics::require_bodies() const {
  if (full_ && floating_)
    fail(
        Failure::input,
        "body = \"full\" in [fidelity] has no bearings: set body = \"modal\" or take the [[bearing]] sections out");
  if (parameters_.inertia.size() != model_.gear.size())
    fail(Failure::input, parameters_.inertia.size(), " total inertias are given for ", gears(), " gears");
  for (int g = 0; g < gears(); ++g) {
    if (!(parameters_.inertia[g] > model_.gear[g].body().inertia))
      fail(Failure::input, "total_inertia_kgm2 = ", parameters_.inertia[g], " of the ",
           g ? "driven gear" : "driver", " lies below the inertia of its own body, ",
           model_.gear[g].body().inertia, " kg m2; raise it");
  }
}

// The rigid rotation that is mass-orthogonal to a common rolling of all gears: theta_g ~ r_g / I_g.
void RollingDynamics::add_rigid_rotation() {
  double inverse_mass = 0;
  for (int g = 0; g < gears(); ++g) {
    const double r = model_.kinematics.gear(g).base_radius();
    inverse_mass += r * r / parameters_.inertia[g];
  }
  rigid_frequency_ = std::sqrt(parameters_.mean_stiffness * inverse_mass);
  Coordinate rigid(model_.gear.size());
  rigid.damping =
      parameters_.damping.rayleigh_mass + 2 * parameters_.damping.bearing_ratio * rigid_frequency_;
  for (int g = 0; g < gears(); ++g) {
    const double r = model_.kinematics.gear(g).base_radius();
    rigid.hub[g] = r / parameters_.inertia[g] / std::sqrt(inverse_mass);
    rigid.torque += rigid.hub[g] * parameters_.torque * r / model_.kinematics.gear(0).base_radius();
  }
  coordinates_.push_back(rigid);
}

// The body's modes that are kept.
std::vector<int> RollingDynamics::modes_of(int g) const {
  const BodyModel level = parameters_.fidelity.body;
  const ReducedBody& body = model_.gear[g].body();
  std::vector<int> kept;
  if (level != BodyModel::rigid) {
    int torsional = -1;  // the first zero-diameter mode with inertia coupling
    for (int i = 0; i < body.eigenfrequency.size(); ++i)
      if (body.nodal_diameter[i] == 0 &&
          (torsional < 0 || std::abs(body.inertia_coupling[i]) > std::abs(body.inertia_coupling[torsional])))
        torsional = i;
    if (torsional < 0) fail(Failure::input, "the body holds no torsional mode; rebuild body.h5");
    for (int i = 0; i < body.eigenfrequency.size(); ++i)
      if (level == BodyModel::modal || full() || i == torsional) kept.push_back(i);
    if (model_.bearing[g].elastic()) {
      int swaying = -1;  // the first with one diameter; modes ascend
      for (int i = static_cast<int>(body.eigenfrequency.size()) - 1; i >= 0; --i)
        if (body.nodal_diameter[i] == 1) swaying = i;
      if (swaying < 0)
        fail(
            Failure::input, "the body of the ", g ? "driven gear" : "driver", " holds ",
            body.eigenfrequency.size(),
            " modes and none of them has one nodal diameter, as a gear on a bearing needs; raise modes in [fidelity]");
      if (level != BodyModel::modal)
        for (const int half : {swaying, model_.gear[g].partner(swaying)}) kept.push_back(half);
      std::sort(kept.begin(), kept.end());
    }
  }
  if (full() && body.discretisation.modes != kAllModes)
    fail(Failure::input, "body = \"full\" needs a body with every mode of its mesh, that of the ",
         g ? "driven gear" : "driver", " holds ", body.eigenfrequency.size(), " modes; rebuild body.h5");
  return kept;
}

void RollingDynamics::weigh_coordinates() {
  const int n = static_cast<int>(coordinates_.size());
  error_weight_ = torque_force_ = frequency_squared_ = closing_weight_ = VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) {
    for (int g = 0; g < gears(); ++g)
      error_weight_[i] += model_.kinematics.gear(g).base_radius() * coordinates_[i].hub[g];
    closing_weight_[i] = error_weight_[i];
    if (const int g = coordinates_[i].gear; g >= 0)
      closing_weight_[i] += model_.outward(g).dot(coordinates_[i].shift);
    torque_force_[i] = coordinates_[i].torque;
    frequency_squared_[i] = coordinates_[i].frequency * coordinates_[i].frequency;
    // The factor keeps gears apart that have changed places.
    owner_id_ += (i + 1) * (coordinates_[i].frequency + error_weight_[i]);
  }
}

void RollingDynamics::add_modes(int g, const std::vector<int>& columns) {
  const ElasticGear& gear = model_.gear[g];
  const ReducedBody& body = gear.body();
  std::vector<int> torsional, swaying, others;
  for (int column : columns) {
    const int diameters = body.nodal_diameter[column];
    const bool sways = diameters == 1 && model_.bearing[g].elastic();
    (diameters == 0 ? torsional : sways ? swaying : others).push_back(column);
  }
  if (!torsional.empty()) add_torsion(g, torsional);
  if (model_.bearing[g].elastic()) add_sway(g, swaying);
  for (int column : others) {
    Coordinate c(model_.gear.size(), g);
    c.frequency = kTwoPi * body.eigenfrequency[column];
    c.damping = rayleigh_damping(c.frequency);
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

double RollingDynamics::rayleigh_damping(double w) const {
  return parameters_.damping.rayleigh_mass + parameters_.damping.rayleigh_stiffness * w * w;  // Eq. 2, Eq. 21
}

// Zero diameters: [[I, gamma^T], [gamma, 1]] z'' + diag(0, w^2) z, the hub rotation first.
void RollingDynamics::add_torsion(int g, const std::vector<int>& torsional) {
  const ReducedBody& body = model_.gear[g].body();
  const double torque =
      parameters_.torque * model_.kinematics.gear(g).base_radius() / model_.kinematics.gear(0).base_radius();
  const int k = static_cast<int>(torsional.size());
  MatrixXd mass = MatrixXd::Identity(k + 1, k + 1), stiffness = MatrixXd::Zero(k + 1, k + 1);
  mass(0, 0) = parameters_.inertia[g];
  for (int i = 0; i < k; ++i) {
    const double w = kTwoPi * body.eigenfrequency[torsional[i]], gamma = body.inertia_coupling[torsional[i]];
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
    Coordinate c(model_.gear.size(), g);
    VectorXd shape = eigen.vectors.col(i);
    if (shape[0] < 0) shape = -shape;
    c.frequency = std::sqrt(eigen.values[i]);
    c.damping = rayleigh_damping(c.frequency);
    c.hub[g] = shape[0];
    c.torque = shape[0] * torque;
    for (int m = 0; m < k; ++m) c.columns.emplace_back(torsional[m], shape[m + 1]);
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
  const ReducedBody& body = gear.body();
  const Bearing& bearing = model_.bearing[g];
  if (model_.kinematics.internal())
    fail(
        Failure::input, "a pair in motion on elastic bearings has external gears, and the ",
        model_.kinematics.ring() ? "driven gear" : "driver",
        " is internal; take the [[bearing]] out, or give both gears a [[drive]]: as a system they move on bearings");
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
  TranslationalModes& sway = sway_[g];
  sway.first = static_cast<int>(coordinates_.size());
  sway.count = 2 * (k + 1);
  sway.tooth_angle = kTwoPi / body.design.teeth;
  sway.there = sway.quarter_on = MatrixXd::Zero(gear.table_size(), sway.count);
  for (int i = 0; i <= k; ++i) {
    VectorXd shape = eigen.vectors.col(i);
    if (shape[0] < 0) shape = -shape;
    for (const bool second : {false, true}) {
      Coordinate c(model_.gear.size(), g);
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

// Of the moments of friction about the axes and, on bearings, of its force across the normal.
void RollingDynamics::fill_friction_rows(Position& position) const {
  if (!model_.friction.acts()) return;
  const auto pairs = static_cast<Eigen::Index>(position.mesh.pairs.size());
  position.friction = MatrixXd::Zero(pairs, static_cast<Eigen::Index>(coordinates_.size()));
  position.sliding_loss.resize(pairs);
  for (Eigen::Index j = 0; j < pairs; ++j) {
    const PairContact& contact = position.mesh.pairs[static_cast<size_t>(j)].contact;
    const PairSliding sliding = sliding_of(model_.kinematics, contact, model_.friction.smoothing);
    position.sliding_loss[j] = sliding.loss();
    for (size_t c = 0; c < coordinates_.size(); ++c) {
      double along = 0;
      for (size_t g = 0; g < kSides; ++g) along += coordinates_[c].hub[g] * sliding.lever[g];
      if (const int g = coordinates_[c].gear; g >= 0)
        along += model_.across(g, contact).dot(coordinates_[c].shift);
      position.friction(j, static_cast<Eigen::Index>(c)) = sliding.direction * along;
    }
  }
}

// The coefficient at a speed and the torques that go with it, here, in the kernel and in the energy balance. Before set_zone,
// which hands them on, here only.
void RollingDynamics::set_friction(double mesh_frequency) {
  const double before = friction_;
  friction_ = model_.coefficient_of_friction(parameters_.torque, mesh_frequency);
  const double kept = 1 - parameters_.loss_per_friction * friction_;
  for (Eigen::Index i = 0; i < torque_force_.size(); ++i) {
    const Coordinate& c = coordinates_[static_cast<size_t>(i)];
    torque_force_[i] =
        parameters_.torque * (c.hub[0] + kept * c.hub[1] * model_.kinematics.gear(1).base_radius() /
                                             model_.kinematics.gear(0).base_radius());
  }
  if (positions_.empty() || friction_ == before) return;
  kernel_.set_friction(friction_, torque_force_);
  balance_work_.torque.head(torque_force_.size()) = torque_force_;
}

VectorXd RollingDynamics::force_of(const Position& position, const VectorXd& nodes) const {
  VectorXd out = torque_force_ - position.participation.transpose() * nodes;
  for (size_t j = 0; friction_ > 0 && j < position.mesh.pairs.size(); ++j)
    out -= friction_ * nodes(position.mesh.nodes_of(j)).sum() *
           position.friction.row(static_cast<Eigen::Index>(j)).transpose();
  return out;
}

double RollingDynamics::bearing_damper(int g) const {
  return 2 * parameters_.damping.bearing_ratio * parameters_.inertia[g] * rigid_frequency_;
}

const MatrixXd& RollingDynamics::shape_on_tooth(int g, int tooth) const {
  const auto [at, fresh] = shape_[g].try_emplace(tooth);
  if (fresh) {
    const int count = first_coordinate_[g + 1] - first_coordinate_[g];
    std::map<int, VectorXd> mode;  // of columns that several coordinates share
    at->second = MatrixXd::Zero(model_.gear[g].table_size(), count);
    for (int c = 0; c < count; ++c)  // those of a TranslationalModes have no columns: they see the phase, too
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
    for (int g = 0; g < gears(); ++g) h.col(c) += coordinates_[c].hub[g] * mesh.node_lever[g];
  for (int g = 0; g < gears(); ++g)
    for (size_t i = 0; i < mesh.pairs.size(); ++i) {
      const MatrixXd& shape = shape_on_tooth(g, GearMeshModel::tooth(g, mesh.pairs[i].pair));
      h.middleCols(first_coordinate_[g], shape.cols())(mesh.nodes_of(i), Eigen::all) +=
          mesh.table_weights[g](mesh.nodes_of(i), Eigen::all) * shape;
      const TranslationalModes& sway = sway_[g];
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

}  // namespace whine
