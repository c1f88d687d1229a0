// Static equilibrium (Eq. 19, 20) at one position: of one mesh, of a system.
#include "gear/layout.h"
#include "system/system.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense.h"
#include "base/error.h"
#include "contact/friction.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Equilibrium equilibrium(const MatrixXd& a, const VectorXd& gap, const VectorXd& approach, double load,
                        double start, ActiveSet& active, ComplementaritySolver& solver) {
  VectorXd d(gap.size()), reduced, response;
  return equilibrium(gap, approach, approach, load, start, [&](const VectorXd& e, VectorXd& p) {
    FixedContact fixed;
    fixed.certificate = solver.solve(a, e, active, p, d);
    const int k = static_cast<int>(active.strips.size());
    reduced.resize(k);
    for (int i = 0; i < k; ++i) reduced[i] = approach[active.strips[i]];
    response = active.inverse * reduced;
    fixed.stiffness = reduced.dot(response);
    return fixed;
  });
}

Equilibrium equilibrium(const MatrixXd& c, std::span<const HertzLine> law, const VectorXd& gap,
                        const VectorXd& approach, double load, double start) {
  VectorXd d(gap.size());
  return equilibrium(gap, approach, approach, load, start, [&](const VectorXd& e, VectorXd& force) {
    const Certificate certificate = solve_line_contact(c, law, e, force, d);
    return FixedContact{certificate, line_contact_stiffness(c, law, approach, force)};
  });
}

Equilibrium equilibrium(const VectorXd& gap, const VectorXd& approach, const VectorXd& loading, double load,
                        double start, const ContactSolve& solve) {
  const int n = static_cast<int>(gap.size());
  Equilibrium result;
  result.p = VectorXd::Zero(n);
  VectorXd e(n);
  double touch = std::numeric_limits<double>::infinity();  // where the first strip touches
  for (int k = 0; k < n; ++k)
    if (approach[k] > 0) touch = std::min(touch, gap[k] / approach[k]);
  if (!std::isfinite(touch)) fail(Failure::numerical, "no pair is in reach to carry the load");
  double low = touch, high = std::numeric_limits<double>::infinity();
  double x = std::max(start, touch + 1e-3 * std::abs(touch) + 1e-9);
  for (int iteration = 0; iteration < 200; ++iteration) {
    e = gap - x * approach;
    const FixedContact fixed = solve(e, result.p);
    result.certificate = fixed.certificate;
    result.stiffness = fixed.stiffness;
    const double excess = loading.dot(result.p) - load;
    if (!std::isfinite(excess) || !std::isfinite(result.stiffness))
      fail(Failure::numerical, "static equilibrium: the contact at x = ", x, " m carries ", excess + load,
           " N with a stiffness of ", result.stiffness, " N/m: the compliance holds no number");
    result.x = x;
    result.residual = std::abs(excess) / load;
    if (result.residual < 1e-12) return result;
    (excess > 0 ? high : low) = x;
    double next = result.stiffness > 0 ? x - excess / result.stiffness : x;
    // No double between is left to try.
    if (result.residual < 1e-10 && (next == x || high - low < 4e-16 * std::abs(x))) return result;
    if (!(next > low && next < high)) next = std::isfinite(high) ? 0.5 * (low + high) : 2 * x - touch + 1e-9;
    x = next;
  }
  fail(Failure::numerical, "static equilibrium did not converge: residual ", result.residual, " of the load ",
       load, " N after 200 steps at x = ", result.x, " m");
}

namespace {

// The contact of a position whose rigid freedoms stand still, of lines or of strips, and its stiffness in these freedoms.
struct StillContact {
  Certificate certificate;
  MatrixXd stiffness;  // (freedom, freedom) N m-1
};

class Contact {
 public:
  // friction: friction_compliance(); `slides`: L is not D.
  Contact(const SystemPosition& position, const MatrixXd& compliance, const MatrixXd& friction, bool slides,
          ComplementaritySolver& solver)
      : compliance_(compliance),
        friction_(friction),
        slides_(slides),
        solver_(solver),
        d_(position.strips()) {
    for (const MeshPosition& mesh : position.mesh) law_.insert(law_.end(), mesh.law.begin(), mesh.law.end());
  }
  StillContact solve(const VectorXd& e, const MatrixXd& displacement, const MatrixXd& load, VectorXd& p) {
    const Index freedoms = displacement.cols();
    StillContact out;
    if (slides_) {
      out.certificate = sliding(e, p);
      out.stiffness = sliding_stiffness(displacement, load, p);
      return out;
    }
    if (!law_.empty()) {
      out.certificate = solve_line_contact(compliance_, law_, e, p, d_);
      // The form is quadratic: k(a, b) = (k(a + b) - k(a) - k(b)) / 2.
      const auto form = [&](const VectorXd& a) { return line_contact_stiffness(compliance_, law_, a, p); };
      out.stiffness.resize(freedoms, freedoms);
      for (Index i = 0; i < freedoms; ++i) out.stiffness(i, i) = form(displacement.col(i));
      for (Index i = 0; i < freedoms; ++i)
        for (Index j = 0; j < i; ++j)
          out.stiffness(i, j) = out.stiffness(j, i) = 0.5 * (form(displacement.col(i) + displacement.col(j)) -
                                                             out.stiffness(i, i) - out.stiffness(j, j));
      return out;
    }
    out.certificate = solver_.solve(compliance_, e, active_, p, d_);
    const auto k = static_cast<Index>(active_.strips.size());
    MatrixXd reading(k, freedoms), loading(k, freedoms);
    for (Index i = 0; i < k; ++i) {
      reading.row(i) = displacement.row(active_.strips[static_cast<size_t>(i)]);
      loading.row(i) = load.row(active_.strips[static_cast<size_t>(i)]);
    }
    out.stiffness.setZero(freedoms, freedoms);
    for (Index j = 0; j < freedoms; ++j) {
      response_ = active_.inverse * VectorXd(reading.col(j));
      for (Index i = 0; i < freedoms; ++i) out.stiffness(i, j) = loading.col(i).dot(response_);
    }
    return out;
  }

 private:
  Certificate sliding(const VectorXd& e, VectorXd& p) {
    const auto under = [&](const VectorXd& gap) {
      return law_.empty() ? solver_.solve(compliance_, gap, active_, p, d_)
                          : solve_line_contact(compliance_, law_, gap, p, d_);
    };
    if (friction_.size() == 0) return under(e);
    VectorXd shift = friction_ * p;
    return solve_with_friction(
        shift, e.cwiseAbs().maxCoeff(), [&](const VectorXd& by) { return under(e + by); },
        [&] { return VectorXd(friction_ * p); });
  }
  // L^T (A + E)^-1 D over what carries load, of lines with the slopes of their laws.
  MatrixXd sliding_stiffness(const MatrixXd& displacement, const MatrixXd& load, const VectorXd& p) const {
    std::vector<Index> active;
    for (Index i = 0; i < p.size(); ++i)
      if (p[i] > 0) active.push_back(i);
    MatrixXd a = compliance_(active, active);
    if (friction_.size() > 0) a += friction_(active, active);
    for (size_t i = 0; !law_.empty() && i < active.size(); ++i) {
      const auto row = static_cast<Index>(i);
      a(row, row) += law_[static_cast<size_t>(active[i])].at(p[active[i]]).slope;
    }
    return load(active, Eigen::all).transpose() * lu_solve(a, displacement(active, Eigen::all));
  }

  const MatrixXd &compliance_, &friction_;
  bool slides_;
  ComplementaritySolver& solver_;
  std::vector<HertzLine> law_;
  ActiveSet active_;
  VectorXd d_, response_;
};

// Where each mesh alone, its own bodies and bearings, would carry its load: a start from which all loaded meshes touch.
VectorXd first_guess(const SystemModel& system, const SystemPosition& position, const MatrixXd& compliance,
                     const std::vector<int>& free) {
  const VectorXd load = mesh_loads(system);
  const auto meshes = static_cast<Index>(system.mesh.size());
  const MatrixXd closing = closing_of(system.layout)(free, Eigen::all).transpose();
  VectorXd deflection = VectorXd::Zero(meshes);
  for (Index m = 0; m < meshes; ++m) {
    if (!(load[m] > 0)) continue;
    const auto own = position.strips_of(static_cast<size_t>(m));
    const MeshPosition& mesh = position.mesh[static_cast<size_t>(m)];
    const VectorXd gap = position.gap(own),
                   approach = position.load.rotation.col(
                       system.layout.meshes[static_cast<size_t>(m)].side[0].body)(own);
    const MatrixXd a = compliance(own, own);
    if (!mesh.law.empty()) {
      deflection[m] = equilibrium(a, mesh.law, gap, approach, load[m], 0).x;
    } else {
      ActiveSet active;
      ComplementaritySolver solver;
      deflection[m] = equilibrium(a, gap, approach, load[m], 0, active, solver).x;
    }
  }
  return least_norm(closing, deflection);
}

// (free body, free body): takes the rolling of the whole train out of a motion; empty where it cannot roll. closing: (free body, mesh).
MatrixXd without_rolling(const MatrixXd& closing) {
  constexpr double kNull = 1e-12;  // of the largest: squared approach of a rolling
  const SymmetricEigen eigen = symmetric_eigen(MatrixXd(closing * closing.transpose()));
  if (!eigen.converged) fail(Failure::numerical, "the rolling of the train was not found");
  const Index kept = (eigen.values.array() > kNull * eigen.values.tail(1)[0]).count();
  if (kept == eigen.values.size()) return {};
  return eigen.vectors.rightCols(kept) * eigen.vectors.rightCols(kept).transpose();
}

constexpr int kSteps = 200;
constexpr double kBalanced = 1e-10;  // residual, where round-off allows no less

// Newton's method with a line search on the convex energy whose gradient is `unbalance`, which stand(x) sets together with the residual
// and the stiffness; false if it does not come to 1e-12, or to 1e-10 where round-off allows no more, within `steps`.
// spring: N m-1, of the size of a mesh load over a deflection, at least.
template <class Stand>
bool balanced(const Stand& stand, VectorXd& x, const VectorXd& unbalance, const SystemEquilibrium& at,
              double spring, int steps) {
  constexpr int kCuts = 60;
  constexpr double kReached = 1e-6;  // of the unbalance
  stand(x);
  int idle = 0;  // steps since the residual fell last
  double best = std::numeric_limits<double>::infinity();
  for (int step = 0; step < steps; ++step) {
    if (at.residual < 1e-12) return true;
    idle = at.residual < best ? 0 : idle + 1;
    best = std::min(best, at.residual);
    if (at.residual < kBalanced && idle > 1) return true;
    // Bodies that carry nothing may roll freely: the least step is taken.
    VectorXd newton = -least_norm(at.stiffness, unbalance);
    // A body that carries load and whose meshes have parted has a force and no stiffness: springs bring it back.
    if (!((at.stiffness * newton + unbalance).norm() <= kReached * unbalance.norm()))
      newton = -lu_solve(at.stiffness + spring * MatrixXd::Identity(x.size(), x.size()), unbalance);
    const double slope = newton.dot(unbalance);
    // Along the step the slope of the energy grows monotonically; its root is where the energy is least.
    VectorXd next = x + newton;
    stand(next);
    double part = 1;
    for (int cut = 0; cut < kCuts && newton.dot(unbalance) > 0.5 * std::abs(slope); ++cut) {
      part *= 0.5;
      next = x + part * newton;
      stand(next);
    }
    x = next;
  }
  return false;
}

// What moves in an equilibrium: bodies that turn, then the translations of hubs that float.
struct Freedoms {
  std::vector<int> body;        // that turn
  MatrixXd displacement, load;  // (strip, freedom) 1
  VectorXd force, spring;       // (freedom) N, N m-1: of the bearing that is no part of A
  Index turns() const { return static_cast<Index>(body.size()); }
};

Freedoms freedoms_of(const SystemModel& system, const SystemPosition& position) {
  Freedoms out;
  out.body = free_bodies(system.layout);
  std::vector<int> floating;
  for (int b = 0; b < static_cast<int>(system.layout.bodies.size()); ++b)
    if (system.floats(b)) floating.push_back(b);
  const Index freedoms = out.turns() + 2 * static_cast<Index>(floating.size());
  out.displacement.resize(position.strips(), freedoms);
  out.load.resize(position.strips(), freedoms);
  out.force = out.spring = VectorXd::Zero(freedoms);
  const LoadBalance balance = load_balance(system.layout);
  for (Index i = 0; i < out.turns(); ++i) {
    const int b = out.body[static_cast<size_t>(i)];
    out.displacement.col(i) = position.displacement.rotation.col(b);
    out.load.col(i) = position.load.rotation.col(b);
    out.force[i] = balance.force[b];
  }
  for (size_t i = 0; i < floating.size(); ++i) {
    const auto b = static_cast<size_t>(floating[i]);
    const auto own = Eigen::seqN(out.turns() + 2 * static_cast<Index>(i), 2);
    out.displacement(Eigen::all, own) = position.displacement.translation[b];
    out.load(Eigen::all, own) = position.load.translation[b];
    out.spring(own).setConstant(system.layout.bodies[b].bearing.stiffness);
  }
  return out;
}

// Where Newton's method does not converge with friction: forces of friction as loads and gaps, repeated until they no longer change. Each
// problem is that without friction, whose energy is convex. x: result; false if they do not settle.
bool by_repeated_friction(const SystemPosition& position, const MatrixXd& compliance,
                          const MatrixXd& friction, const Freedoms& of, double scale,
                          ComplementaritySolver& solver, VectorXd& x) {
  constexpr double kSettled = 1e-13;  // of the largest force
  const MatrixXd none, across = of.load - of.displacement;
  Contact contact(position, compliance, none, false, solver);
  SystemEquilibrium out;
  out.p = VectorXd::Zero(position.strips());
  VectorXd unbalance, slid = out.p, gap, force;
  const auto stand = [&](const VectorXd& at) {
    const StillContact held =
        contact.solve(gap - of.displacement * at, of.displacement, of.displacement, out.p);
    out.stiffness = held.stiffness;
    out.stiffness.diagonal() += of.spring;
    unbalance = of.displacement.transpose() * out.p - force + of.spring.cwiseProduct(at);
    out.residual = unbalance.cwiseAbs().maxCoeff() / scale;
  };
  for (int step = 0; step < kMostFrictionSteps; ++step) {
    gap = position.gap;
    if (friction.size() > 0) gap += friction * slid;
    force = of.force - across.transpose() * slid;
    if (!balanced(stand, x, unbalance, out, scale / x.cwiseAbs().maxCoeff(), kSteps)) return false;
    const double change = (out.p - slid).cwiseAbs().maxCoeff();
    slid = out.p;
    if (change < kSettled * slid.maxCoeff()) return true;
  }
  return false;
}

}  // namespace

SystemEquilibrium equilibrium(const SystemModel& system, const SystemPosition& position,
                              const MatrixXd& compliance, const VectorXd& start,
                              ComplementaritySolver& solver, const VectorXd& further) {
  Freedoms of = freedoms_of(system, position);
  for (Index i = 0; further.size() > 0 && i < of.turns(); ++i)
    of.force[i] += further[of.body[static_cast<size_t>(i)]];
  const MatrixXd &displacement = of.displacement, &load = of.load;
  const VectorXd &force = of.force, &spring = of.spring;
  const Index freedoms = force.size(), turns = of.turns();
  VectorXd x = VectorXd::Zero(freedoms);
  for (Index i = 0; i < turns; ++i) x[i] = start[of.body[static_cast<size_t>(i)]];
  const MatrixXd friction = friction_compliance(system, position);
  Contact contact(position, compliance, friction, system.slides(), solver);
  SystemEquilibrium out;
  out.x = VectorXd::Zero(static_cast<Index>(system.layout.bodies.size()));
  out.p = VectorXd::Zero(position.strips());
  const auto give = [&] {
    if (turns < freedoms) {
      const auto turning = Eigen::seqN(0, turns), moving = Eigen::seq(turns, freedoms - 1);
      const MatrixXd moved = lu_solve(out.stiffness(moving, moving), out.stiffness(moving, turning));
      out.stiffness = (out.stiffness(turning, turning) - out.stiffness(turning, moving) * moved).eval();
    }
    for (Index i = 0; i < turns; ++i) out.x[of.body[static_cast<size_t>(i)]] = x[i];
    return out;
  };
  if (freedoms == 1 && force[0] > 0) {
    const Equilibrium one = equilibrium(position.gap, displacement.col(0), load.col(0), force[0], x[0],
                                        [&](const VectorXd& e, VectorXd& p) {
                                          const StillContact held = contact.solve(e, displacement, load, p);
                                          return FixedContact{held.certificate, held.stiffness(0, 0)};
                                        });
    x[0] = one.x;
    out.p = one.p;
    out.stiffness = MatrixXd::Constant(1, 1, one.stiffness);
    out.certificate = one.certificate;
    out.residual = one.residual;
    return give();
  }

  const double scale = mesh_loads(system).maxCoeff();
  MatrixXd rolls = without_rolling(closing_of(system.layout)(of.body, Eigen::all));
  if (rolls.size() > 0 && system.slides())
    fail(Failure::input, "the train can roll as a whole, and with [friction] its torques are not balanced: ",
         "hold the body where power leaves it by a [[drive]] with kind = \"held\", in place of its torque");
  if (rolls.size() > 0 && turns < freedoms) {
    const MatrixXd turning = rolls;
    rolls = MatrixXd::Identity(freedoms, freedoms);
    rolls.topLeftCorner(turns, turns) = turning;
  }
  VectorXd unbalance;
  const auto stand = [&](const VectorXd& at) {
    const StillContact held = contact.solve(position.gap - displacement * at, displacement, load, out.p);
    out.certificate = held.certificate;
    out.stiffness = held.stiffness;
    out.stiffness.diagonal() += spring;
    unbalance = load.transpose() * out.p - force + spring.cwiseProduct(at);
    if (rolls.size() > 0) {
      unbalance = (rolls * unbalance).eval();
      out.stiffness = (rolls * out.stiffness * rolls).eval();
    }
    if (!unbalance.allFinite() || !out.stiffness.allFinite())
      fail(Failure::numerical, "static equilibrium of the system: the compliance holds no number");
    out.residual = unbalance.cwiseAbs().maxCoeff() / scale;
  };
  // From where the bodies stood at the position before, if that is known.
  constexpr int kNearSteps = 20;
  const bool known = x.squaredNorm() > 0;
  if (known && balanced(stand, x, unbalance, out, scale / x.cwiseAbs().maxCoeff(), kNearSteps)) return give();
  x.setZero();
  x.head(turns) = first_guess(system, position, compliance, of.body);
  if (balanced(stand, x, unbalance, out, scale / x.cwiseAbs().maxCoeff(), kSteps)) return give();
  x.setZero();
  x.head(turns) = first_guess(system, position, compliance, of.body);
  if (system.slides() && by_repeated_friction(position, compliance, friction, of, scale, solver, x)) {
    stand(x);
    if (out.residual < kBalanced) return give();
  }
  fail(Failure::numerical, "static equilibrium of the system did not converge: residual ", out.residual,
       " of the largest mesh load ", scale, " N after ", kSteps, " steps");
}

}  // namespace whine
