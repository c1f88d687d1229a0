#include "dynamics/step_kernel_reference.h"

#include <Eigen/LU>
#include <cmath>

#include "base/dense.h"
#include "base/error.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Eq. 18, d = A p + e >= 0, p >= 0, p . d = 0 of an A that is positive definite, or nearly so with friction: all strips of wrong
// sign change sides, after some rounds of that the first of them alone, with which no set comes back (Murty, Opsearch 5 (1968) 23).
VectorXd strip_forces(const MatrixXd& a, const VectorXd& e) {
  constexpr int kRounds = 30, kMostPivots = 100000;
  std::vector<bool> carries(static_cast<size_t>(e.size()));
  for (int pivot = 0; pivot < kMostPivots; ++pivot) {
    std::vector<int> set, wrong;
    for (int i = 0; i < e.size(); ++i)
      if (carries[static_cast<size_t>(i)]) set.push_back(i);
    VectorXd p = VectorXd::Zero(e.size());
    if (!set.empty()) p(set) = -lu_solve(a(set, set), e(set));
    const VectorXd d = a * p + e;
    for (int i = 0; i < e.size(); ++i)
      if ((carries[static_cast<size_t>(i)] ? p[i] : d[i]) < 0) wrong.push_back(i);
    if (wrong.empty()) return p;
    if (pivot >= kRounds) wrong.resize(1);
    for (const int i : wrong) carries[static_cast<size_t>(i)] = !carries[static_cast<size_t>(i)];
  }
  fail(Failure::numerical, "no forces of ", e.size(), " strips were found in ", kMostPivots, " pivots");
}

// d = C p + law(p) + e >= 0, p >= 0, p . d = 0: every set of pairs in turn, Newton's method on each.
VectorXd line_forces(const MatrixXd& c, std::span<const HertzLine> law, const VectorXd& e) {
  constexpr int kMostSteps = 100;
  const auto pairs = static_cast<int>(e.size());
  for (unsigned members = 0; members < 1u << pairs; ++members) {
    std::vector<int> set;
    for (int j = 0; j < pairs; ++j)
      if (members >> j & 1) set.push_back(j);
    VectorXd p = VectorXd::Zero(pairs);
    // Small forces, from which Newton's method on the concave law rises to the solution.
    for (const int j : set) p[j] = 1e-6 * std::abs(e[j]) / c(j, j);
    double before = 0;
    for (int n = 0; n < kMostSteps && !set.empty(); ++n) {
      MatrixXd slope = c(set, set);
      VectorXd gap = (c * p + e)(set);
      for (size_t k = 0; k < set.size(); ++k) {
        const HertzLine::Point at = law[static_cast<size_t>(set[k])].at(p[set[k]]);
        slope(static_cast<int>(k), static_cast<int>(k)) += at.slope;
        gap[static_cast<int>(k)] += at.indentation;
      }
      const VectorXd change = lu_solve(slope, gap);
      VectorXd next = p;
      next(set) -= change;
      // A force that would change its sign goes half way.
      for (const int j : set)
        if (!(next[j] > 0)) next[j] = 0.5 * p[j];
      p = next;
      const double size = change.norm();
      if (n > 3 && size <= 1e-12 * p.norm() && !(size < 0.5 * before)) break;
      before = size;
    }
    VectorXd d = c * p + e;
    double scale = 0;
    for (int j = 0; j < pairs; ++j) scale = std::max(scale, std::abs(e[j]));
    bool solved = true;
    for (int j = 0; j < pairs; ++j)
      solved =
          solved && (members >> j & 1
                         ? std::abs(d[j] + law[static_cast<size_t>(j)].at(p[j]).indentation) < 1e-10 * scale
                         : d[j] >= 0);
    if (solved) return p;
  }
  fail(Failure::numerical, "no forces of ", pairs, " lines were found");
}

VectorXd coefficients(const std::vector<Propagator>& propagators, double Propagator::*which) {
  VectorXd all(static_cast<Eigen::Index>(propagators.size()));
  for (Eigen::Index i = 0; i < all.size(); ++i) all[i] = propagators[static_cast<size_t>(i)].*which;
  return all;
}

}  // namespace

StepReference::StepReference(const StepSystem& system, const std::vector<Propagator>& propagators,
                             const Relaxation& relaxed, double friction)
    : system_(system),
      a11_(coefficients(propagators, &Propagator::a11)),
      a12_(coefficients(propagators, &Propagator::a12)),
      a21_(coefficients(propagators, &Propagator::a21)),
      a22_(coefficients(propagators, &Propagator::a22)),
      bq_(coefficients(propagators, &Propagator::bq)),
      bv_(coefficients(propagators, &Propagator::bv)),
      relaxed_step_(relaxed),
      friction_(friction) {}

// L = h + mu s T, T the same at all nodes of a pair.
MatrixXd StepReference::loading(const StepPosition& position) const {
  MatrixXd l = position.participation;
  for (size_t j = 0; friction_ > 0 && j < position.mesh.pairs.size(); ++j)
    l(position.mesh.nodes_of(j), Eigen::all).rowwise() +=
        friction_ * position.friction.row(static_cast<Eigen::Index>(j));
  return l;
}

// A = H + W (B + from_new R + h (bq / 2) L^T) W^T.
MatrixXd StepReference::compliance(const StepPosition& position) const {
  const MeshPosition& mesh = position.mesh;
  const MatrixXd& h = position.participation;
  MatrixXd a = MatrixXd::Zero(mesh.strips(), mesh.strips());
  mesh.add_to_strips(position.instantaneous_compliance + relaxed_step_.from_new * position.relaxed +
                         h * (0.5 * bq_).asDiagonal() * loading(position).transpose(),
                     a);
  for (size_t j = 0; !system_.lines && j < mesh.pairs.size(); ++j) {
    const int first = mesh.first_strip[j], strips = mesh.pairs[j].size();
    a.block(first, first, strips, strips) += system_.half_plane[static_cast<size_t>(position.pair[j].zone)];
  }
  return a;
}

// e = gap - W (h z - sum over sides and teeth of V C g).
VectorXd StepReference::offset(const StepState& state, const StepPosition& position) const {
  const MeshPosition& mesh = position.mesh;
  VectorXd moved = -position.participation * state.z;
  for (int side = 0; side < StepKernel::kSides; ++side)
    for (size_t j = 0; j < mesh.pairs.size(); ++j)
      for (int tooth = 0; tooth < system_.teeth(); ++tooth) {
        const MatrixXd& block = system_.block(side, position.pair[j].slot - tooth);
        moved(mesh.nodes_of(j)) +=
            position.field_weight[static_cast<size_t>(side)](mesh.nodes_of(j), Eigen::seqN(0, block.rows())) *
            block * state.relaxed[static_cast<size_t>(side)].col(tooth).head(block.cols());
      }
  return mesh.gap + mesh.to_strips(moved);
}

double StepReference::step(StepState& state, const StepPosition& position) const {
  const MeshPosition& mesh = position.mesh;
  // Without new contact force.
  const VectorXd mean = 0.5 * (state.force + system_.torque_force), z0 = state.z, v0 = state.v;
  state.z = a11_.cwiseProduct(z0) + a12_.cwiseProduct(v0) + bq_.cwiseProduct(mean);
  state.v = a21_.cwiseProduct(z0) + a22_.cwiseProduct(v0) + bv_.cwiseProduct(mean);
  for (size_t side = 0; side < state.relaxed.size(); ++side)
    state.relaxed[side] =
        relaxed_step_.decay * state.relaxed[side] + relaxed_step_.from_old * state.load[side];
  // Contact.
  const MatrixXd a = compliance(position);
  const VectorXd e = offset(state, position);
  state.p = system_.lines ? line_forces(a, mesh.law, e) : strip_forces(a, e);
  state.d = a * state.p + e;
  for (size_t j = 0; j < mesh.law.size(); ++j)
    if (const auto i = static_cast<Eigen::Index>(j); state.p[i] > 0)
      state.d[i] += mesh.law[j].at(state.p[i]).indentation;
  // Its share of all else.
  const VectorXd nodes = mesh.to_nodes(state.p), on_modes = loading(position).transpose() * nodes;
  state.z -= 0.5 * bq_.cwiseProduct(on_modes);
  state.v -= 0.5 * bv_.cwiseProduct(on_modes);
  state.force = system_.torque_force - on_modes;
  for (size_t side = 0; side < state.load.size(); ++side) {
    state.load[side].setZero();
    for (size_t j = 0; j < mesh.pairs.size(); ++j)
      state.load[side].col(position.pair[j].slot) =
          position.field_weight[side](mesh.nodes_of(j), Eigen::all).transpose() * nodes(mesh.nodes_of(j));
    state.relaxed[side] += relaxed_step_.from_new * state.load[side];
  }
  return system_.error_weight.dot(state.z);
}

void StepReference::rename(StepState& state) const {
  for (VectorXd* y : {&state.z, &state.v, &state.force})
    for (const StepSystem::Turn& turn : system_.turns) {
      if (turn.sine < 0) {
        (*y)[turn.cosine] *= -1;
        continue;
      }
      const double cosine = (*y)[turn.cosine], sine = (*y)[turn.sine];
      (*y)[turn.cosine] = turn.c * cosine + turn.s * sine;
      (*y)[turn.sine] = turn.c * sine - turn.s * cosine;
    }
  for (std::vector<MatrixXd>* fields : {&state.relaxed, &state.load})
    for (MatrixXd& field : *fields) {
      field.rightCols(field.cols() - 1) = field.leftCols(field.cols() - 1).eval();
      field.col(0).setZero();
    }
}

}  // namespace whine
