// The equations of step_kernel.h in plain matrices, as they read: what the kernel on lanes is compared with. Nothing is packed,
// pipelined, left out as too small or remembered from step to step; contact is solved by methods of its own, for a few pairs
// and some tens of strips.
#pragma once
#include <Eigen/LU>
#include <cmath>
#include <span>
#include <vector>

#include "base/dense.h"
#include "base/error.h"
#include "dynamics/step_kernel.h"

namespace whine {

// Eq. 18, d = A p + e >= 0, p >= 0, p . d = 0 of an A that is positive definite, or nearly so with friction: all strips of wrong
// sign change sides, after some rounds of that the first of them alone, with which no set comes back (Murty, Opsearch 5 (1968) 23).
inline Eigen::VectorXd strip_forces(const Eigen::MatrixXd& a, const Eigen::VectorXd& e) {
  constexpr int kRounds = 30, kMostPivots = 100000;
  std::vector<bool> carries(static_cast<size_t>(e.size()));
  for (int pivot = 0; pivot < kMostPivots; ++pivot) {
    std::vector<int> set, wrong;
    for (int i = 0; i < e.size(); ++i)
      if (carries[static_cast<size_t>(i)]) set.push_back(i);
    Eigen::VectorXd p = Eigen::VectorXd::Zero(e.size());
    if (!set.empty()) p(set) = -lu_solve(a(set, set), e(set));
    const Eigen::VectorXd d = a * p + e;
    for (int i = 0; i < e.size(); ++i)
      if ((carries[static_cast<size_t>(i)] ? p[i] : d[i]) < 0) wrong.push_back(i);
    if (wrong.empty()) return p;
    if (pivot >= kRounds) wrong.resize(1);
    for (const int i : wrong) carries[static_cast<size_t>(i)] = !carries[static_cast<size_t>(i)];
  }
  fail(Failure::numerical, "no forces of ", e.size(), " strips were found in ", kMostPivots, " pivots");
}

// d = C p + law(p) + e >= 0, p >= 0, p . d = 0: every set of pairs in turn, Newton's method on each.
inline Eigen::VectorXd line_forces(const Eigen::MatrixXd& c, std::span<const HertzLine> law,
                                   const Eigen::VectorXd& e) {
  constexpr int kMostSteps = 100;
  const auto pairs = static_cast<int>(e.size());
  for (unsigned members = 0; members < 1u << pairs; ++members) {
    std::vector<int> set;
    for (int j = 0; j < pairs; ++j)
      if (members >> j & 1) set.push_back(j);
    Eigen::VectorXd p = Eigen::VectorXd::Zero(pairs);
    // Small forces, from which Newton's method on the concave law rises to the solution.
    for (const int j : set) p[j] = 1e-6 * std::abs(e[j]) / c(j, j);
    double before = 0;
    for (int n = 0; n < kMostSteps && !set.empty(); ++n) {
      Eigen::MatrixXd slope = c(set, set);
      Eigen::VectorXd gap = (c * p + e)(set);
      for (size_t k = 0; k < set.size(); ++k) {
        const HertzLine::Point at = law[static_cast<size_t>(set[k])].at(p[set[k]]);
        slope(static_cast<int>(k), static_cast<int>(k)) += at.slope;
        gap[static_cast<int>(k)] += at.indentation;
      }
      const Eigen::VectorXd change = lu_solve(slope, gap);
      Eigen::VectorXd next = p;
      next(set) -= change;
      // A force that would change its sign goes half way.
      for (const int j : set)
        if (!(next[j] > 0)) next[j] = 0.5 * p[j];
      p = next;
      const double size = change.norm();
      if (n > 3 && size <= 1e-12 * p.norm() && !(size < 0.5 * before)) break;
      before = size;
    }
    Eigen::VectorXd d = c * p + e;
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

inline Eigen::VectorXd coefficients(const std::vector<Propagator>& propagators, double Propagator::*which) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(propagators.size()));
  for (Eigen::Index i = 0; i < all.size(); ++i) all[i] = propagators[static_cast<size_t>(i)].*which;
  return all;
}

class StepReference {
 public:
  // friction: 1, coefficient.
  StepReference(const StepSystem& system, const std::vector<Propagator>& propagators,
                const Relaxation& relaxed, double friction = 0);

  // Takes a state by one step to `position`. Result: transmission error, m. Throws Error(numerical) if contact finds no
  // solution.
  double step(StepState& state, const StepPosition& position) const;
  // Gives teeth the names that they have in the next mesh period: doublets turn by a tooth, loads move on by one.
  void rename(StepState& state) const;

 private:
  Eigen::MatrixXd compliance(
      const StepPosition& position) const;  // (strip, strip) m N-1: A without laws of lines
  Eigen::MatrixXd loading(const StepPosition& position) const;                         // (node, coordinate) L
  Eigen::VectorXd offset(const StepState& state, const StepPosition& position) const;  // (strip) m: e

  const StepSystem& system_;
  Eigen::VectorXd a11_, a12_, a21_, a22_, bq_, bv_;  // (coordinate)
  Relaxation relaxed_step_;
  double friction_;
};

inline StepReference::StepReference(const StepSystem& system, const std::vector<Propagator>& propagators,
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
inline Eigen::MatrixXd StepReference::loading(const StepPosition& position) const {
  Eigen::MatrixXd l = position.participation;
  for (size_t j = 0; friction_ > 0 && j < position.mesh.pairs.size(); ++j)
    l(position.mesh.nodes_of(j), Eigen::all).rowwise() +=
        friction_ * position.friction.row(static_cast<Eigen::Index>(j));
  return l;
}

// A = H + W (B + from_new R + h (bq / 2) L^T) W^T.
inline Eigen::MatrixXd StepReference::compliance(const StepPosition& position) const {
  const MeshPosition& mesh = position.mesh;
  const Eigen::MatrixXd& h = position.participation;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(mesh.strips(), mesh.strips());
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
inline Eigen::VectorXd StepReference::offset(const StepState& state, const StepPosition& position) const {
  const MeshPosition& mesh = position.mesh;
  Eigen::VectorXd moved = -position.participation * state.z;
  for (int side = 0; side < StepKernel::kSides; ++side)
    for (size_t j = 0; j < mesh.pairs.size(); ++j)
      for (int tooth = 0; tooth < system_.teeth(); ++tooth) {
        const Eigen::MatrixXd& block = system_.block(side, position.pair[j].slot - tooth);
        moved(mesh.nodes_of(j)) +=
            position.field_weight[static_cast<size_t>(side)](mesh.nodes_of(j), Eigen::seqN(0, block.rows())) *
            block * state.relaxed[static_cast<size_t>(side)].col(tooth).head(block.cols());
      }
  return mesh.gap + mesh.to_strips(moved);
}

inline double StepReference::step(StepState& state, const StepPosition& position) const {
  const MeshPosition& mesh = position.mesh;
  // Without new contact force.
  const Eigen::VectorXd mean = 0.5 * (state.force + system_.torque_force), z0 = state.z, v0 = state.v;
  state.z = a11_.cwiseProduct(z0) + a12_.cwiseProduct(v0) + bq_.cwiseProduct(mean);
  state.v = a21_.cwiseProduct(z0) + a22_.cwiseProduct(v0) + bv_.cwiseProduct(mean);
  for (size_t side = 0; side < state.relaxed.size(); ++side)
    state.relaxed[side] =
        relaxed_step_.decay * state.relaxed[side] + relaxed_step_.from_old * state.load[side];
  // Contact.
  const Eigen::MatrixXd a = compliance(position);
  const Eigen::VectorXd e = offset(state, position);
  state.p = system_.lines ? line_forces(a, mesh.law, e) : strip_forces(a, e);
  state.d = a * state.p + e;
  for (size_t j = 0; j < mesh.law.size(); ++j)
    if (const auto i = static_cast<Eigen::Index>(j); state.p[i] > 0)
      state.d[i] += mesh.law[j].at(state.p[i]).indentation;
  // Its share of all else.
  const Eigen::VectorXd nodes = mesh.to_nodes(state.p), on_modes = loading(position).transpose() * nodes;
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

inline void StepReference::rename(StepState& state) const {
  for (Eigen::VectorXd* y : {&state.z, &state.v, &state.force})
    for (const StepSystem::Turn& turn : system_.turns) {
      if (turn.sine < 0) {
        (*y)[turn.cosine] *= -1;
        continue;
      }
      const double cosine = (*y)[turn.cosine], sine = (*y)[turn.sine];
      (*y)[turn.cosine] = turn.c * cosine + turn.s * sine;
      (*y)[turn.sine] = turn.c * sine - turn.s * cosine;
    }
  for (std::vector<Eigen::MatrixXd>* fields : {&state.relaxed, &state.load})
    for (Eigen::MatrixXd& field : *fields) {
      field.rightCols(field.cols() - 1) = field.leftCols(field.cols() - 1).eval();
      field.col(0).setZero();
    }
}

}  // namespace whine
