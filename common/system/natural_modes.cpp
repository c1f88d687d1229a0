#include "system/natural_modes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "base/dense.h"
#include "base/error.h"
#include "base/units.h"
#include "system/turning_modes.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kAtRest = 1e-8;

// [planet] of the only carrier, by angle about its axis; empty if there is none or more than one.
std::vector<int> planets_of(const System& layout) {
  std::vector<int> planets;
  int carrier = System::kGround;
  for (int b = 0; b < static_cast<int>(layout.bodies.size()); ++b) {
    const int on = layout.bodies[static_cast<size_t>(b)].on;
    if (on == System::kGround) continue;
    if (carrier != System::kGround && on != carrier) return {};
    carrier = on;
    planets.push_back(b);
  }
  if (planets.empty()) return planets;
  const auto& centre = layout.bodies[static_cast<size_t>(carrier)].centre;
  const auto angle = [&](int b) {
    const auto& at = layout.bodies[static_cast<size_t>(b)].centre;
    const double a = std::atan2(at[1] - centre[1], at[0] - centre[0]);
    return a < -1e-9 ? a + 2 * kPi : a;
  };
  std::stable_sort(planets.begin(), planets.end(), [&](int a, int b) { return angle(a) < angle(b); });
  return planets;
}

// (freedom, freedom) The turn by 2 pi / N; empty if a planet has other freedoms than the next one.
MatrixXd turn_of(const RigidSystem& system, const std::vector<int>& planets) {
  const auto planet_count = static_cast<double>(planets.size());
  const Eigen::Matrix2d turned = Eigen::Rotation2Dd(2 * kPi / planet_count).toRotationMatrix();
  MatrixXd out = MatrixXd::Zero(system.freedoms(), system.freedoms());
  for (size_t b = 0; b < system.layout.bodies.size(); ++b) {
    const auto at = std::find(planets.begin(), planets.end(), static_cast<int>(b));
    size_t to = b;
    if (at != planets.end()) to = static_cast<size_t>(at + 1 == planets.end() ? planets.front() : *(at + 1));
    const bool moves = system.layout.bodies[b].bearing.elastic();
    if (moves != system.layout.bodies[to].bearing.elastic() ||
        system.rotation[b].isZero(0) != system.rotation[to].isZero(0))
      return {};
    out += system.rotation[to].transpose() * system.rotation[b];
    if (moves) out += system.translation[to].transpose() * turned * system.translation[b];
  }
  return out;
}

struct Solved {
  VectorXd squared;  // s-2
  MatrixXd shape;    // (freedom, mode), unit modal mass
};

Solved solve(const MatrixXd& k, const MatrixXd& m) {
  const SymmetricEigen eigen = symmetric_eigen(k, m);
  if (!eigen.converged)
    fail(Failure::numerical, "the natural modes of a system of ", k.rows(),
         " freedoms were not found: its mass matrix is not positive definite, or a number is not finite");
  return {eigen.values, eigen.vectors};
}

// (freedom, n) An orthonormal basis of the motions of harmonic k.
MatrixXd harmonic_basis(const MatrixXd& turn, int k, int planets) {
  const Index n = turn.rows();
  const bool single = k == 0 || 2 * k == planets;
  MatrixXd power = MatrixXd::Identity(n, n), projector = MatrixXd::Zero(n, n);
  for (int j = 0; j < planets; ++j) {
    projector += (single ? 1.0 : 2.0) / planets * std::cos(2 * kPi * j * k / planets) * power;
    power = turn * power;
  }
  // The projector is symmetric, with eigenvalues 0 and 1.
  const SymmetricEigen eigen = symmetric_eigen(0.5 * (projector + projector.transpose()));
  const Index count = (eigen.values.array() > 0.5).count();
  return eigen.vectors.rightCols(count);
}

// The coordinate that moves most in the modes of `shape`, the first of those that move alike.
Index leading_coordinate(const MatrixXd& shape) {
  const VectorXd size = shape.rowwise().norm();
  Index at = 0;
  while (size[at] < (1 - 1e-6) * size.maxCoeff()) ++at;
  return at;
}

// The largest motion is positive; of two modes of one frequency the first holds all of it.
void fix_direction(Eigen::Ref<MatrixXd> pair) {
  const Index at = leading_coordinate(pair);
  if (pair.cols() == 2) {
    const double c = pair(at, 0), s = pair(at, 1), norm = std::hypot(c, s);
    const VectorXd first = (c * pair.col(0) + s * pair.col(1)) / norm,
                   second = (c * pair.col(1) - s * pair.col(0)) / norm;
    pair.col(0) = first;
    pair.col(1) = second;
  }
  for (Index j = 0; j < pair.cols(); ++j) {
    const Index own = j == 0 ? at : leading_coordinate(pair.col(j));
    if (pair(own, j) < 0) pair.col(j) *= -1;
  }
}

struct Mode {
  double squared;  // s-2
  ModeType type;
  int harmonic;
  VectorXd shape;
};

bool central_translates(const System& layout, const std::vector<int>& planets) {
  for (int b = 0; b < static_cast<int>(layout.bodies.size()); ++b)
    if (layout.bodies[static_cast<size_t>(b)].bearing.elastic() &&
        std::find(planets.begin(), planets.end(), b) == planets.end())
      return true;
  return false;
}

std::vector<Mode> symmetric_modes(const RigidSystem& system, const MatrixXd& turn,
                                  const std::vector<int>& planets) {
  const int count = static_cast<int>(planets.size());
  std::vector<Mode> out;
  for (int k = 0; 2 * k <= count; ++k) {
    const MatrixXd basis = harmonic_basis(turn, k, count);
    if (basis.cols() == 0) continue;
    Solved solved =
        solve(basis.transpose() * system.stiffness * basis, basis.transpose() * system.mass * basis);
    solved.shape = basis * solved.shape;
    const bool pairs = k > 0 && 2 * k < count;
    const ModeType type = k == 0                                                 ? ModeType::rotational
                          : k == 1 && central_translates(system.layout, planets) ? ModeType::translational
                                                                                 : ModeType::planet;
    const Index width = pairs ? 2 : 1;
    for (Index i = 0; i + width <= solved.squared.size(); i += width) {
      fix_direction(solved.shape.middleCols(i, width));
      const double mean = solved.squared.segment(i, width).mean();
      for (Index j = i; j < i + width; ++j) out.push_back({mean, type, k, solved.shape.col(j)});
    }
  }
  return out;
}

ModeType type_by_motion(const ModesResult& a, Index mode, const std::vector<int>& planets,
                        const RigidSystem& system) {
  if (planets.empty()) return ModeType::train;
  double turns = 0, moves = 0;
  for (size_t b = 0; b < a.layout.bodies.size(); ++b) {
    if (std::find(planets.begin(), planets.end(), static_cast<int>(b)) != planets.end()) continue;
    const MatrixRM& shape = a.shape[static_cast<size_t>(mode)];
    const auto row = static_cast<Index>(b);
    const System::Body& body = system.layout.bodies[b];
    turns += body.inertia / (body.radius * body.radius) * shape(row, 0) * shape(row, 0);
    moves += body.bearing.mass * shape.row(row).tail(2).squaredNorm();
  }
  if (turns < kAtRest && moves < kAtRest) return ModeType::planet;
  if (moves < kAtRest) return ModeType::rotational;
  return turns < kAtRest ? ModeType::translational : ModeType::mixed;
}

void fill_energies(const RigidSystem& system, Index mode, const VectorXd& q, ModesResult& a) {
  double potential = 0, kinetic = 0;
  const VectorXd closing = system.closing * q, force = system.mesh_stiffness * closing;
  for (const RigidSystem::Spring& spring : system.springs) {
    const VectorXd way = spring.row * q;
    const double energy = spring.kind == RigidSystem::Spring::Kind::mesh
                              ? closing[spring.number] * force[spring.number]
                              : spring.stiffness * way.squaredNorm();
    potential += energy;
    if (spring.kind == RigidSystem::Spring::Kind::mesh) {
      a.mesh_deflection(mode, spring.number) = closing[spring.number];
      a.mesh_energy(mode, spring.number) += energy;
    } else {
      a.bearing_energy(mode, spring.number) += energy;
    }
  }
  for (size_t b = 0; b < system.layout.bodies.size(); ++b) {
    const System::Body& body = system.layout.bodies[b];
    const auto row = static_cast<Index>(b);
    const VectorXd u = system.rotation[b] * q, x = system.translation[b] * q;
    a.shape[static_cast<size_t>(mode)].row(row) << u[0], x[0], x[1];
    a.kinetic_energy(mode, row) =
        body.inertia / (body.radius * body.radius) * u.squaredNorm() + body.bearing.mass * x.squaredNorm();
    kinetic += a.kinetic_energy(mode, row);
  }
  a.kinetic_energy.row(mode) /= kinetic;
  const bool free = a.natural_frequency[mode] == 0;
  a.mesh_energy.row(mode) *= free ? 0 : 1 / potential;
  a.bearing_energy.row(mode) *= free ? 0 : 1 / potential;
  if (free) a.mesh_deflection.row(mode).setZero();
}

std::vector<Mode> modes_of(const RigidSystem& system, const std::vector<int>& planets) {
  constexpr double kAlike = 1e-9;
  if (planets.size() > 1)
    if (const MatrixXd turn = turn_of(system, planets); turn.size() > 0) {
      const auto differs = [&](const MatrixXd& of) {
        return (turn.transpose() * of * turn - of).norm() > kAlike * of.norm();
      };
      if (!differs(system.mass) && !differs(system.stiffness)) return symmetric_modes(system, turn, planets);
    }
  std::vector<Mode> out;
  Solved solved = solve(system.stiffness, system.mass);
  for (Index i = 0; i < solved.squared.size(); ++i) {
    fix_direction(solved.shape.col(i));
    out.push_back({solved.squared[i], ModeType::mixed, -1, solved.shape.col(i)});
  }
  return out;
}

}  // namespace

ModesResult natural_modes(const System& layout, const MatrixXd& mesh_stiffness) {
  const RigidSystem system = rigid_system(layout, mesh_stiffness);
  const std::vector<int> planets = planets_of(layout);
  std::vector<Mode> modes = modes_of(system, planets);
  double largest = 0;
  for (const Mode& mode : modes) largest = std::max(largest, mode.squared);
  for (Mode& mode : modes)
    if (mode.squared < kFreeMotion * largest) mode.squared = 0;
  // Equal frequencies of several harmonics stay in the order of these.
  std::stable_sort(modes.begin(), modes.end(),
                   [](const Mode& a, const Mode& b) { return a.squared < b.squared; });
  const auto count = static_cast<Index>(modes.size()), bodies = static_cast<Index>(layout.bodies.size()),
             meshes = static_cast<Index>(layout.meshes.size());
  ModesResult out;
  out.layout = system.layout;
  out.rigid_frequency = std::sqrt(kFreeMotion * largest) / (2 * kPi);
  out.natural_frequency.resize(count);
  out.planet_harmonic.resize(count);
  out.mesh_deflection = out.mesh_energy = MatrixRM::Zero(count, meshes);
  out.bearing_energy = out.kinetic_energy = MatrixRM::Zero(count, bodies);
  out.shape.assign(modes.size(), MatrixRM::Zero(bodies, 3));
  for (Index i = 0; i < count; ++i) {
    const Mode& mode = modes[static_cast<size_t>(i)];
    out.natural_frequency[i] = std::sqrt(mode.squared) / (2 * kPi);
    out.planet_harmonic[i] = mode.harmonic;
    fill_energies(system, i, mode.shape, out);
    out.type.push_back(mode.harmonic >= 0 ? mode.type : type_by_motion(out, i, planets, system));
  }
  return out;
}

namespace {

// (mesh, mesh) N m-1: entries of alike meshes at their common mean, which are those of one [[mesh]] by itself, of two with a body in
// common that is a planet, and of two without.
MatrixXd of_alike_planets(const SystemStaticParameters& settings, const MatrixXd& stiffness) {
  const System& s = settings.layout;
  const Index n = stiffness.rows();
  if (static_cast<Index>(settings.section.size()) != n) return stiffness;
  const auto planet_of = [&](Index m) {
    for (const System::Side& side : s.meshes[static_cast<size_t>(m)].side)
      if (s.bodies[static_cast<size_t>(side.body)].on != System::kGround) return side.body;
    return -1;
  };
  const auto kind_of = [&](Index m, Index k) {
    const int first = settings.section[static_cast<size_t>(m)],
              second = settings.section[static_cast<size_t>(k)];
    const int relation = m == k ? 0 : planet_of(m) >= 0 && planet_of(m) == planet_of(k) ? 1 : 2;
    return std::array{std::min(first, second), std::max(first, second), relation};
  };
  std::map<std::array<int, 3>, std::pair<double, int>> sums;
  for (Index m = 0; m < n; ++m)
    for (Index k = 0; k < n; ++k) {
      auto& [sum, count] = sums[kind_of(m, k)];
      sum += stiffness(m, k);
      ++count;
    }
  MatrixXd out(n, n);
  for (Index m = 0; m < n; ++m)
    for (Index k = 0; k < n; ++k) {
      const auto& [sum, count] = sums[kind_of(m, k)];
      out(m, k) = sum / count;
    }
  return out;
}

// Modes of meshes that differ a little are near combinations of those of alike ones: the type of a mode is the one whose modes of
// alike meshes hold most of its kinetic energy, sum (v_type^T M v)^2. It so does not depend on how much the meshes differ.
void take_types(const ModesResult& alike, ModesResult& out) {
  const auto product = [&](size_t i, size_t j) {
    double sum = 0;
    for (size_t b = 0; b < out.layout.bodies.size(); ++b) {
      const System::Body& body = out.layout.bodies[b];
      const auto row = static_cast<Index>(b);
      sum += body.inertia / (body.radius * body.radius) * alike.shape[i](row, 0) * out.shape[j](row, 0) +
             body.bearing.mass * alike.shape[i].row(row).tail(2).dot(out.shape[j].row(row).tail(2));
    }
    return sum;
  };
  for (size_t j = 0; j < out.type.size(); ++j) {
    std::map<ModeType, double> share;
    for (size_t i = 0; i < alike.type.size(); ++i) share[alike.type[i]] += std::pow(product(i, j), 2);
    out.type[j] = std::max_element(share.begin(), share.end(), [](const auto& a, const auto& b) {
                    return a.second < b.second;
                  })->first;
  }
}

}  // namespace

Eigen::VectorXd rigid_frequencies(const System& layout, const MatrixXd& mesh_stiffness) {
  const Eigen::VectorXd all = natural_modes(layout, mesh_stiffness).natural_frequency;
  return all.tail((all.array() > 0).count());  // free motions come first
}

ModesResult elastic_modes(const SystemStaticResult& at_rest) {
  if (at_rest.mesh_stiffness.empty()) fail(Failure::input, "the statics hold no phase");
  const auto meshes = static_cast<Index>(at_rest.settings.layout.meshes.size());
  MatrixXd mean = MatrixXd::Zero(meshes, meshes);
  for (const MatrixRM& frozen : at_rest.mesh_stiffness) mean += frozen;
  mean /= static_cast<double>(at_rest.mesh_stiffness.size());
  ModesResult out = natural_modes(at_rest.settings.layout, mean);
  take_types(natural_modes(at_rest.settings.layout, of_alike_planets(at_rest.settings, mean)), out);
  add_turning_frequencies(out, mean);
  out.mesh_phase = at_rest.mesh_phase;
  out.frozen_frequency.resize(out.mesh_phase.size(), out.natural_frequency.size());
  for (Index i = 0; i < out.mesh_phase.size(); ++i)
    out.frozen_frequency.row(i) =
        natural_modes(at_rest.settings.layout, at_rest.mesh_stiffness[static_cast<size_t>(i)])
            .natural_frequency.transpose();
  return out;
}

}  // namespace whine
