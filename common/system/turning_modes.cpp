#include "system/turning_modes.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "gear/system_layout.h"
#include "system/natural_modes.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct Whirl {
  VectorXd frequency;  // (freedom) Hz
  double growth = 0;   // s-1, of the motion that grows fastest; 0: none does
};

Whirl whirl_at(const RigidSystem& system, double omega) {
  constexpr double kGrowth =
      1e-6;  // of the largest frequency: what round-off makes of a free motion is below 1e-7
  const Index n = system.freedoms();
  const Eigen::LLT<MatrixXd> mass(system.mass);
  if (mass.info() != Eigen::Success)
    fail(Failure::numerical, "the mass matrix of a system of ", n, " freedoms is not positive definite");
  const auto normal = [&](const MatrixXd& of) {  // L^-1 of L^-T
    const MatrixXd half = mass.matrixL().solve(of);
    return MatrixXd(mass.matrixL().solve(half.transpose()).transpose());
  };
  const MatrixXd stiffness = normal(system.stiffness - omega * omega * system.centrifugal);
  const double scale = std::sqrt(stiffness.cwiseAbs().maxCoeff());
  // (scale q, q')
  MatrixXd motion = MatrixXd::Zero(2 * n, 2 * n);
  motion.topRightCorner(n, n).diagonal().setConstant(scale);
  motion.bottomLeftCorner(n, n) = -stiffness / scale;
  motion.bottomRightCorner(n, n) = -2 * omega * normal(system.gyroscopic);
  const Eigen::EigenSolver<MatrixXd> eigen(motion, false);
  if (eigen.info() != Eigen::Success)
    fail(Failure::numerical, "the natural frequencies of a system of ", n, " freedoms were not found");
  const double growth = eigen.eigenvalues().real().maxCoeff();
  std::vector<double> sizes(static_cast<size_t>(2 * n));
  for (Index i = 0; i < 2 * n; ++i) sizes[static_cast<size_t>(i)] = std::abs(eigen.eigenvalues()[i].imag());
  std::sort(sizes.begin(), sizes.end());
  VectorXd out(n);
  for (Index i = 0; i < n; ++i) out[i] = sizes[static_cast<size_t>(2 * i + 1)] / kTwoPi;
  const double free = std::sqrt(kFreeMotion) * out.maxCoeff();
  return {(out.array() < free).select(0, out), growth < kGrowth * scale ? 0 : growth};
}

}  // namespace

VectorXd turning_frequencies(const RigidSystem& system, double omega) {
  const Whirl at = whirl_at(system, omega);
  if (at.growth > 0)
    fail(
        Failure::input, "at ", omega * 60 / kTwoPi, " rpm of its carrier a motion of the train grows, with ",
        at.growth,
        " 1/s: the speed is above a critical one; stiffen the softest [[bearing]], or stay below this speed");
  return at.frequency;
}

void add_turning_frequencies(ModesResult& modes, const MatrixXd& mesh_stiffness) {
  constexpr Index kSpeeds = 65;
  const double turns = frame_turns(modes.layout);
  if (turns == 0 || !(modes.natural_frequency.maxCoeff() > 0)) return;
  const RigidSystem system = rigid_system(modes.layout, mesh_stiffness);
  modes.frame_turns = turns;
  modes.turning_mesh_frequency = VectorXd::LinSpaced(kSpeeds, 0, modes.natural_frequency.maxCoeff());
  modes.turning_frequency.resize(kSpeeds, modes.natural_frequency.size());
  for (Index i = 0; i < kSpeeds; ++i) {
    const Whirl at = whirl_at(system, kTwoPi * turns * modes.turning_mesh_frequency[i]);
    if (at.growth > 0) {
      modes.turning_mesh_frequency.conservativeResize(i);
      modes.turning_frequency.conservativeResize(i, Eigen::NoChange);
      return;
    }
    modes.turning_frequency.row(i) = at.frequency.transpose();
  }
}

}  // namespace whine
