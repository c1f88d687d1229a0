#include "dynamics/dynamics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/dense.h"
#include "base/error.h"
#include "base/memory.h"
#include "dynamics/relaxed_fields.h"
#include "model/capabilities.h"
#include "system/undamped_depth.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Throws Error(input) if a range, with those beside it, takes more memory than a scene may.
template <class... Words>
void require_memory(double own, double beside, double most, const char* remedy, const Words&... what) {
  if (own + beside <= most) return;
  constexpr double kGB = 1e9;  // bytes
  const std::string others =
      beside > 0 ? text(" beside the ", beside / kGB, " GB of narrower candidate contact zones, which stay")
                 : "";
  fail(Failure::input, what..., " need ", own / kGB, " GB", others, ", at most ", most / kGB, " are allowed",
       beside > 0 ? " for all candidate zones together" : "", "; ", remedy);
}

}  // namespace

DynamicParameters dynamic_parameters(const StaticResult& statics, double mean_stiffness,
                                     const SweepParameters& settings, double highest_frequency) {
  require_able("one-slice", traits(settings.fidelity));
  require_relaxation_range(settings.damping, settings.fidelity.body, highest_frequency);
  return {statics.torque,
          {settings.inertia.begin(), settings.inertia.end()},
          mean_stiffness,
          settings.damping,
          settings.fidelity,
          statics.friction_coefficient > 0 ? (1 - statics.efficiency) / statics.friction_coefficient : 0};
}

std::string beyond_relaxation_range(const Damping& damping, BodyModel body, double highest_frequency) {
  const double eta = damping.rayleigh_stiffness;
  if ((body != BodyModel::modal && body != BodyModel::relaxed) || eta * highest_frequency <= kMostRelaxation)
    return "";
  return text("rayleigh_stiffness_s = ", eta, " in [damping] is ", eta * highest_frequency,
              " of a mesh period at ", highest_frequency, " Hz, at most ", kMostRelaxation,
              " is computed: the damping ratio of a mode at the mesh frequency is then ",
              std::numbers::pi * eta * highest_frequency, "; lower it to ",
              kMostRelaxation / highest_frequency,
              " (make calibrate finds that of a damping ratio), or the largest mesh_frequency_Hz to ",
              kMostRelaxation / eta, " Hz");
}

void require_relaxation_range(const Damping& damping, BodyModel body, double highest_frequency) {
  const std::string words = beyond_relaxation_range(damping, body, highest_frequency);
  if (!words.empty()) fail(Failure::input, words);
}

MotionBounds::MotionBounds(const GearMeshModel& model, const StaticResult& statics, double widening) {
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

CandidateZone candidate_zone(const GearMeshModel& model, const StaticResult& statics,
                             const MotionBounds& bounds) {
  const double load = statics.torque / model.kinematics.gear(0).base_radius();
  return candidate_zone(model.kinematics, model.gear[0].half_plane(), model.gear[1].half_plane(),
                        statics.contact.strips, load / model.kinematics.contact_ratio(), bounds.force,
                        bounds.deflection, model.flanks());
}

void RollingDynamics::set_zone(const CandidateZone& range, int steps, const ZoneMemory& beside) {
  if (!lines() && range.strips % StepKernel::kStripsAtOnce != 0)
    fail(Failure::numerical, range.strips, " strips in a candidate zone are no multiple of ",
         StepKernel::kStripsAtOnce);
  const double depth = parameters_.damping.undamped_depth,
               widest = widest_half_width(model_.gear[0].half_plane(), model_.gear[1].half_plane(), depth);
  beyond_depth_ =
      !lines() && range.half_zone > widest ? beyond_undamped_depth(range.half_zone, widest, depth) : "";
  place_positions(range, steps);
  require_zone_memory(steps, beside);
  StepSystem system;
  system.lines = lines();
  system.reach = reach_;
  system.torque_force = torque_force_;
  system.error_weight = error_weight_;
  system.turns = turns();
  const auto tables = couple_fields(system);
  for (Position& position : positions_) fill_position(position, system, tables);
  set_hunting_gaps(beside.gaps);
  set_cracks();
  share_zones(system);
  kernel_.set_zone(std::move(system), positions_);
  if (model_.friction.acts()) kernel_.set_friction(friction_, torque_force_);
  size_energy_balance();
}

void RollingDynamics::place_positions(const CandidateZone& range, int steps) {
  const double load = parameters_.torque / model_.kinematics.gear(0).base_radius();
  positions_.assign(steps, {});
  corners_.assign(steps, {});
  reach_ = 1;
  for (int i = 0; i < steps; ++i) {
    const double phase = static_cast<double>(i) / steps;
    MeshPosition& mesh = positions_[i].mesh;
    mesh = lines() ? make_line_position(model_, phase, range.corner_gap, parameters_.damping.undamped_depth,
                                        shared_force(load))
                   : make_position(model_, phase, range);
    for (const PairStrips& s : mesh.pairs) reach_ = std::max(reach_, std::abs(s.pair));
    if (mesh.pairs.size() > kMostPairs)
      fail(Failure::numerical, "at mesh phase ", mesh.phase, " ", mesh.pairs.size(),
           " pairs are in reach, at most ", kMostPairs, " are foreseen");
    corners_[i].next_gap = mesh.next_corner_gap;
    corners_[i].lost_gap = mesh.lost_corner_gap;
    for (size_t j = 0; j < mesh.pairs.size(); ++j) {
      const PairContact& contact = mesh.pairs[j].contact;
      corners_[i].drift_lever[j] = contact.lever[0] / model_.kinematics.gear(0).base_radius() -
                                   contact.lever[1] / model_.kinematics.gear(1).base_radius();
      corners_[i].driver_lever[j] = contact.lever[0];
      if (!model_.friction.acts()) continue;
      const PairSliding sliding = sliding_of(model_.kinematics, contact, model_.friction.smoothing);
      corners_[i].driver_across[j] = sliding.direction * sliding.lever[0];
      corners_[i].slide_lever[j] = sliding.loss() / model_.kinematics.gear(0).base_radius();
    }
  }
  for (Position& position : positions_)
    for (const PairStrips& s : position.mesh.pairs) position.pair.push_back({s.pair + reach_, 0});
}

// Participation of every coordinate at the nodes of every position, once to look at and once packed for the steps.
void RollingDynamics::require_zone_memory(int steps, const ZoneMemory& beside) {
  constexpr double kMostMemory = 12e9;  // bytes
  memory_ = {};
  int most_strips = 0;
  for (const Position& position : positions_) {
    memory_.coordinates +=
        8.0 * static_cast<double>(coordinates_.size()) *
        (position.mesh.nodes() + (lines() ? 1.0 : static_cast<double>(StepKernel::kShapeRows)) *
                                     static_cast<double>(position.mesh.pairs.size()));
    if (lines()) continue;
    // Each step has a place for the inverse of its active strips.
    const double strips = position.mesh.strips();
    memory_.coordinates += 8 * strips * strips;
    most_strips = std::max(most_strips, position.mesh.strips());
  }
  require_memory(
      memory_.coordinates, beside.coordinates, kMostMemory,
      "set contact = \"line\", lower min_sample_rate_kHz or raise the lowest speed, or take body = \"modal\"",
      coordinates_.size(), " coordinates and ", most_strips, " strips at ", steps,
      " positions of a mesh period");
  log_memory(text(coordinates_.size(), " coordinates and ", most_strips, " strips at ", steps,
                  " positions of a mesh period"),
             memory_.coordinates);
}

// The fields of all gears and what they do to each other. Result: [gear] residual flexibility (flank, flank) by offset between
// teeth, -2 reach..2 reach.
std::vector<std::vector<MatrixXd>> RollingDynamics::couple_fields(StepSystem& system) {
  constexpr int kFields = StepKernel::kFields, kSharedFields = StepKernel::kSharedFields;
  const double depth = parameters_.damping.undamped_depth;
  const bool rigid = parameters_.fidelity.body == BodyModel::rigid;
  std::vector<std::vector<MatrixXd>> tables(model_.gear.size());
  fields_.clear();
  system.coupling.resize(model_.gear.size());
  for (int g = 0; g < gears(); ++g) {
    const int m = model_.gear[g].table_size();
    const auto residual = [&](int offset) {
      return rigid ? MatrixXd::Zero(m, m) : model_.gear[g].residual(offset, depth, kept_[g]);
    };
    for (int offset = -2 * reach_; offset <= 2 * reach_; ++offset) tables[g].push_back(residual(offset));
    // Of all offsets that the body holds, so that the state keeps its meaning when a wider range reaches more teeth.
    std::vector<MatrixXd> others;
    const int offsets = model_.gear[g].body().offsets;
    others.reserve(2 * static_cast<size_t>(offsets));
    for (int offset = -offsets; offset <= offsets; ++offset)
      if (offset != 0) others.push_back(residual(offset));
    fields_.push_back(full() ? MatrixXd::Zero(m, kFields)
                             : relaxed_fields(residual(0), others, kFields, kSharedFields,
                                              g ? "the driven gear" : "the driver"));
    for (int offset = -2 * reach_; offset <= 2 * reach_; ++offset) {
      const int n = offset == 0 ? kFields : kSharedFields,
                own = std::min(n, static_cast<int>(fields_[g].cols()));
      const auto fields = fields_[g].leftCols(own);
      MatrixXd block = MatrixXd::Zero(n, n);
      block.topLeftCorner(own, own) =
          fields.transpose() * tables[g][GearMeshModel::tooth(g, offset) + 2 * reach_] * fields;
      system.coupling[g].push_back(block);
    }
  }
  return tables;
}

void RollingDynamics::fill_position(Position& position, const StepSystem& system,
                                    const std::vector<std::vector<MatrixXd>>& tables) const {
  const MeshPosition& mesh = position.mesh;
  position.participation = participation(mesh);
  fill_friction_rows(position);
  MatrixXd left_out = MatrixXd::Zero(mesh.nodes(), mesh.nodes());
  if (!lines()) {
    const StepKernel::ShapeBasis& basis = StepKernel::shape_basis();
    left_out = modal_flexibility(position);
    for (size_t i = 0; i < mesh.pairs.size(); ++i) {
      auto rows = position.participation.middleRows<kZoneNodes>(i * kZoneNodes);
      rows = (basis * (basis.transpose() * rows)).eval();
    }
    left_out -= modal_flexibility(position);
  }
  position.relaxed = MatrixXd::Zero(mesh.nodes(), mesh.nodes());
  MatrixXd whole = position.relaxed;
  for (int g = 0; g < gears(); ++g) {
    whole += body_compliance(mesh, g, tables[g]);
    MatrixXd& weight = position.field_weight.emplace_back(MatrixXd::Zero(mesh.nodes(), StepKernel::kFields));
    weight.leftCols(fields_[g].cols()) = mesh.table_weights[g] * fields_[g];
    for (size_t i = 0; i < mesh.pairs.size(); ++i)
      for (size_t j = 0; j < mesh.pairs.size(); ++j) {
        const MatrixXd& block = system.block(g, mesh.pairs[i].pair - mesh.pairs[j].pair);
        const auto rows = [&](size_t pair) {
          return weight(mesh.nodes_of(pair), Eigen::seqN(0, block.cols()));
        };
        position.relaxed(mesh.nodes_of(i), mesh.nodes_of(j)) += rows(i) * block * rows(j).transpose();
      }
  }
  position.instantaneous_compliance = whole - position.relaxed + left_out;
}

// Candidate zones without an edge are alike if they are of one width; near a root they are narrower.
void RollingDynamics::share_zones(StepSystem& system) {
  if (lines()) return;
  constexpr double kSame = 1e-12;
  std::vector<std::pair<double, int>> inner;  // m: width; which
  for (Position& position : positions_)
    for (size_t j = 0; j < position.mesh.pairs.size(); ++j) {
      const PairStrips& s = position.mesh.pairs[j];
      const bool edge = s.low_is_edge || s.high_is_edge;
      const double width = s.border[s.size()] - s.border[0];
      const auto alike =
          edge ? inner.end() : std::find_if(inner.begin(), inner.end(), [&](const auto& known) {
            return std::abs(width - known.first) <= kSame * width;
          });
      if (alike != inner.end()) {
        position.pair[j].zone = alike->second;
        continue;
      }
      position.pair[j].zone = static_cast<int>(system.half_plane.size());
      system.half_plane.push_back(half_plane_compliance(
          s, model_.gear[0].half_plane(), model_.gear[1].half_plane(), parameters_.damping.undamped_depth));
      if (!edge) inner.emplace_back(width, position.pair[j].zone);
    }
}

std::vector<StepSystem::Turn> RollingDynamics::turns() const {
  std::vector<StepSystem::Turn> turns;
  for (int i = 0; i < static_cast<int>(coordinates_.size()); ++i) {
    const Coordinate& c = coordinates_[i];
    if (c.turn == 0) continue;
    if (c.partner < 0)
      turns.push_back({i, -1, -1, 0});
    else if (c.partner > i)
      turns.push_back({i, c.partner, std::cos(c.turn), std::sin(c.turn)});
  }
  return turns;
}

void RollingDynamics::set_hunting_gaps(double beside) {
  hunting_ = whine::hunting_periods(model_);
  hunting_gap_.clear();
  if (hunting_ == 1) return;
  size_t strips = 0;
  hunting_place_.clear();
  for (const Position& position : positions_) {
    hunting_place_.push_back(strips);
    strips += static_cast<size_t>(position.mesh.strips());
  }
  constexpr double kMostMemory = 2e9;  // bytes
  memory_.gaps = 8.0 * static_cast<double>(strips) * hunting_;
  require_memory(
      memory_.gaps, beside, kMostMemory,
      "set contact = \"line\", lower min_sample_rate_kHz and steps_per_period, or raise the lowest speed",
      "teeth that differ meet again after ", hunting_, " mesh periods, whose gaps at ", positions_.size(),
      " positions each");
  log_memory(text("gaps of teeth that differ, over ", hunting_, " mesh periods,"), memory_.gaps);
  hunting_gap_.resize(strips * static_cast<size_t>(hunting_));
  for (int period = 0; period < hunting_; ++period)
    for (size_t i = 0; i < positions_.size(); ++i)
      Eigen::Map<VectorXd>(&hunting_gap_[static_cast<size_t>(period) * strips + hunting_place_[i]],
                           positions_[i].mesh.strips()) = flank_gaps(model_, positions_[i].mesh, period);
}

void RollingDynamics::put_gap(int position, int period) {
  VectorXd& gap = positions_[position].mesh.gap;
  gap = Eigen::Map<const VectorXd>(
      &hunting_gap_[hunting_gap_.size() / static_cast<size_t>(hunting_) * static_cast<size_t>(period) +
                    hunting_place_[position]],
      gap.size());
  kernel_.set_gap(position, gap);
  if (!crack_.empty()) put_crack(position, period);
}

// A crack has no inertia of its own and no damping: what it adds follows the forces at once, as the half-planes do.
void RollingDynamics::set_cracks() {
  crack_.clear();
  intact_.clear();
  crack_is_put_.assign(positions_.size(), 0);
  if (parameters_.fidelity.body == BodyModel::rigid) return;
  for (int period = 0; period < hunting_; ++period)
    for (size_t i = 0; i < positions_.size(); ++i)
      if (MatrixXd adds = crack_compliance(model_, positions_[i].mesh, period); adds.size() > 0)
        crack_.emplace(std::pair{period, static_cast<int>(i)}, std::move(adds));
  if (crack_.empty()) return;
  intact_.reserve(positions_.size());
  for (const Position& position : positions_) intact_.push_back(position.instantaneous_compliance);
}

void RollingDynamics::put_crack(int position, int period) {
  const auto i = static_cast<size_t>(position);
  const auto found = crack_.find({period, position});
  const bool adds = found != crack_.end();
  if (!adds && !crack_is_put_[i]) return;
  crack_is_put_[i] = adds;
  MatrixXd& instantaneous = positions_[i].instantaneous_compliance;
  instantaneous = intact_[i];
  if (adds) instantaneous += found->second;
  kernel_.set_crack(position, instantaneous, adds ? found->second : MatrixXd());
}

void RollingDynamics::pass_speed(double mesh_frequency, int steps) {
  const int finest = static_cast<int>(positions_.size());
  if (steps <= 0 || finest % steps != 0)
    fail(Failure::numerical, steps, " steps per period do not divide the ", finest,
         " positions of the range");
  steps_ = steps;
  stride_ = finest / steps;
  const double h = step_ = 1 / (mesh_frequency * steps);
  for (size_t i = 0; i < crack_is_put_.size(); ++i) put_crack(static_cast<int>(i), -1);
  if (model_.friction.acts()) set_friction(mesh_frequency);
  std::vector<Propagator> propagators;
  for (size_t i = 0; i < coordinates_.size(); ++i) {
    const Coordinate& c = coordinates_[i];
    // The halves of a doublet have one.
    if (i > 0 && c.frequency == coordinates_[i - 1].frequency && c.damping == coordinates_[i - 1].damping)
      propagators.push_back(propagators.back());
    else
      propagators.push_back(newmark_ ? newmark_propagator(c.frequency, c.damping, h)
                                     : exact_propagator(c.frequency, c.damping, h));
  }
  kernel_.set_speed(std::move(propagators), relaxation_step(relaxation(), h), steps, positions_);
  damping_.speed.resize(0);
}

void RollingDynamics::set_speed(double mesh_frequency, int steps) {
  pass_speed(mesh_frequency, steps);
  damping_ = damping_integrals();
}

MatrixXd RollingDynamics::local_compliance(int i) const {
  const Position& position = positions_[i];
  if (lines()) return position.instantaneous_compliance;
  MatrixXd a(position.mesh.strips(), position.mesh.strips());
  kernel_.instantaneous_compliance(i).assemble(a.data());
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
MatrixXd RollingDynamics::static_compliance(int i) const {
  const Position& position = positions_[i];
  MatrixXd a = local_compliance(i);
  position.mesh.add_to_strips(position.relaxed + modal_flexibility(position), a);
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

RollingDynamics::State RollingDynamics::rest() {
  set_gap(0, 0);
  const Position& position = positions_[0];
  const MatrixXd a = static_compliance(0);
  const VectorXd offset = elastic_offset(position);
  const Equilibrium e = equilibrium_at(position, a, offset);
  const VectorXd nodes = position.mesh.to_nodes(e.p);
  State state;
  state.owner_id = owner_id_;
  state.force = torque_force_ - position.participation.transpose() * nodes;
  state.z = flexibility().cwiseProduct(state.force);
  if (friction_ > 0) state.force = force_of(position, nodes);
  state.z[0] = e.x;
  state.v = VectorXd::Zero(state.z.size());
  state.p = e.p;
  state.d = a * e.p + offset - position.mesh.to_strips(e.x * position.participation.col(0));
  for (size_t j = 0; j < position.mesh.law.size(); ++j)
    if (e.p[j] > 0) state.d[j] += position.mesh.law[j].at(e.p[j]).indentation;
  for (const MatrixXd& weight : position.field_weight) {
    MatrixXd& load = state.load.emplace_back(MatrixXd::Zero(StepKernel::kFields, 2 * reach_ + 1));
    for (size_t j = 0; j < position.mesh.pairs.size(); ++j)
      load.col(position.pair[j].slot) +=
          weight(position.mesh.nodes_of(j), Eigen::all).transpose() * nodes(position.mesh.nodes_of(j));
  }
  state.relaxed = state.load;
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
    fail(Failure::input, "states are compared on the scale of rest(); call it once after set_zone()");
  const Eigen::Index n = a.z.size();
  VectorXd both(2 * n);
  both << (a.z - b.z).cwiseProduct(frequency_squared_.cwiseSqrt()), a.v - b.v;
  both[0] = rigid_frequency_ * (a.z[0] - b.z[0]);
  return both / energy_scale_;
}

}  // namespace whine
