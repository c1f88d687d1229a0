#include "system/load_balance.h"

#include <cmath>

#include "base/dense.h"
#include "base/error.h"
#include "gear/layout.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<int> free_bodies(const System& system) {
  std::vector<int> out;
  for (int b = 0; b < static_cast<int>(system.bodies.size()); ++b)
    if (!system.held(b)) out.push_back(b);
  return out;
}

MatrixXd closing_of(const System& layout) {
  MatrixXd out =
      MatrixXd::Zero(static_cast<Index>(layout.bodies.size()), static_cast<Index>(layout.meshes.size()));
  for (size_t m = 0; m < layout.meshes.size(); ++m) {
    const auto column = static_cast<Index>(m);
    for (int s = 0; s < kSides; ++s)
      out(layout.meshes[m].side[static_cast<size_t>(s)].body, column) = closing_sign(s);
    if (const CarriedMesh on = carried_mesh(layout, m); on.carrier >= 0) out(on.carrier, column) = on.closing;
  }
  return out;
}

bool can_roll(const System& layout) {
  constexpr double kNull = 1e-12;  // of the largest: squared approach of a rolling
  const MatrixXd closing = closing_of(layout)(free_bodies(layout), Eigen::all);
  const SymmetricEigen eigen = symmetric_eigen(MatrixXd(closing * closing.transpose()));
  return eigen.values.size() > 0 && !(eigen.values[0] > kNull * eigen.values.tail(1)[0]);
}

namespace {

// N: T / r.
VectorXd forces_of(const System& layout, const std::vector<int>& free) {
  VectorXd out(static_cast<Index>(free.size()));
  for (size_t i = 0; i < free.size(); ++i)
    out[static_cast<Index>(i)] = layout.torque(free[i]) / layout.bodies[static_cast<size_t>(free[i])].radius;
  return out;
}

}  // namespace

LoadBalance load_balance(const System& layout) {
  const std::vector<int> free = free_bodies(layout);
  if (free.empty())
    fail(Failure::input,
         "every body is held; leave one gear free to turn, and give it or another one a torque");
  const auto meshes = static_cast<Index>(layout.meshes.size());
  const MatrixXd balance = closing_of(layout)(free, Eigen::all);
  const VectorXd force = forces_of(layout, free);
  LoadBalance out;
  out.load = meshes == 1 && free.size() == 1 ? VectorXd(force / balance(0, 0)) : least_norm(balance, force);
  constexpr double kRoundOff = 1e-12;
  const double most = out.load.cwiseAbs().maxCoeff(), largest = force.cwiseAbs().maxCoeff();
  const VectorXd carried = balance * out.load;
  const double left = (carried - force).cwiseAbs().maxCoeff();
  out.balanced = left <= kTypedDigits * largest;
  out.force.setZero(static_cast<Index>(layout.bodies.size()));
  for (size_t i = 0; i < free.size(); ++i)
    out.force[free[i]] = (left <= kRoundOff * largest ? force : carried)[static_cast<Index>(i)];
  for (Index m = 0; m < meshes && out.pulled_apart < 0; ++m)
    if (out.load[m] < -1e-12 * most) out.pulled_apart = static_cast<int>(m);
  return out;
}

std::string unbalanced_words(const System& layout) {
  std::string out =
      "the torques of the drives are not balanced: hold one gear, or give the others torques that add up";
  // The last body that nothing holds, from the loads that the others ask for.
  std::vector<int> others = free_bodies(layout);
  if (others.size() < 2) return out;
  const int last = others.back();
  others.pop_back();
  const MatrixXd closing = closing_of(layout), balance = closing(others, Eigen::all);
  const VectorXd force = forces_of(layout, others), load = least_norm(balance, force);
  if (!((balance * load - force).cwiseAbs().maxCoeff() <= kTypedDigits * force.cwiseAbs().maxCoeff()))
    return out;
  const System::Body& body = layout.bodies[static_cast<size_t>(last)];
  return out + text("; that of '", body.name, "' is ", layout.torque(last), " N m, and ",
                    closing.row(last).dot(load) * body.radius, " N m would balance the others");
}

}  // namespace whine
