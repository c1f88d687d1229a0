#include "dynamics/system_coordinates.h"

#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "base/error.h"
#include "base/units.h"
#include "system/rigid_system.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kNull = 1e-12;  // of the largest: squared approach of a rolling

std::vector<int> free_of(const SystemModel& system) {
  std::vector<int> out;
  for (int b = 0; b < static_cast<int>(system.body.size()); ++b) {
    if (system.layout.held(b)) continue;
    const System::Body& body = system.layout.bodies[static_cast<size_t>(b)];
    const double own = system.body[static_cast<size_t>(b)]->body().inertia;
    if (!(body.inertia >= own * (1 - 1e-9)))
      fail(Failure::input, "the inertia of '", body.name, "', ", body.inertia,
           " kg m2, lies below that of its own body, ", own, " kg m2; raise total_inertia_kgm2");
    out.push_back(b);
  }
  return out;
}

// (mesh, free body): approach of the mesh per unit rotation of unit modal mass.
MatrixXd approaches(const SystemModel& system, const std::vector<int>& free) {
  MatrixXd out = MatrixXd::Zero(static_cast<Index>(system.mesh.size()), static_cast<Index>(free.size()));
  for (Index m = 0; m < out.rows(); ++m)
    for (Index i = 0; i < out.cols(); ++i) {
      const int b = free[static_cast<size_t>(i)];
      if (const int side = system.side_of(b, static_cast<int>(m)); side >= 0)
        out(m, i) = closing_sign(side) * system.base_radius(b) /
                    std::sqrt(system.layout.bodies[static_cast<size_t>(b)].inertia);
    }
  return out;
}

const System::Body& placed_body(const SystemModel& system, int b) {
  return system.layout.bodies[static_cast<size_t>(b)];
}

class Builder {
 public:
  Builder(const SystemModel& system, const SystemMotion& motion) : system_(system), motion_(motion) {}

  SystemCoordinates build() {
    const Fidelity& fidelity = motion_.fidelity;
    if (fidelity.body == BodyModel::full || fidelity.body == BodyModel::rigid)
      fail(Failure::input, "body = \"", fidelity.body,
           "\" in [fidelity]: systems in motion have \"quasi-static\", \"lagged\" or \"modal\"");
    if (fidelity.contact != ContactModel::line)
      fail(Failure::input, "contact = \"", fidelity.contact, "\" in motion: systems have \"line\"");
    if (fidelity.integrator != Integrator::exact)
      fail(Failure::input, "integrator = \"newmark\" in [fidelity] is for pairs; systems have \"exact\"");
    add_rotations();
    for (int b = 0; b < static_cast<int>(system_.body.size()); ++b) add_body(b);
    const auto n = static_cast<Index>(frequency_.size());
    out_.frequency = Eigen::Map<VectorXd>(frequency_.data(), n);
    out_.damping = Eigen::Map<VectorXd>(damping_.data(), n);
    out_.of_bearing = Eigen::Map<VectorXd>(of_bearing_.data(), n);
    out_.torque = Eigen::Map<VectorXd>(torque_.data(), n);
    return out_;
  }

 private:
  void add(double frequency, double damping, double torque, double of_bearing = 0) {
    frequency_.push_back(frequency);
    damping_.push_back(damping + of_bearing);
    torque_.push_back(torque);
    of_bearing_.push_back(of_bearing);
  }
  double rayleigh(double w2) const {  // Eq. 2, Eq. 21
    return motion_.damping.rayleigh_mass + motion_.damping.rayleigh_stiffness * w2;
  }

  void add_rotations() {
    const std::vector<int> free = free_of(system_);
    const auto bodies = static_cast<Index>(system_.body.size());
    const MatrixXd approach = approaches(system_, free);
    const SymmetricEigen eigen = symmetric_eigen(MatrixXd(approach.transpose() * approach));
    if (!eigen.converged) fail(Failure::numerical, "the rigid rotations of the system were not found");
    std::vector<Index> kept, null;
    for (Index i = 0; i < eigen.values.size(); ++i)
      (eigen.values[i] > kNull * eigen.values.tail(1)[0] ? kept : null).push_back(i);
    out_.rigid = static_cast<int>(kept.size());
    out_.rotation = MatrixXd::Zero(bodies, out_.rigid);
    out_.rolling = MatrixXd::Zero(bodies, static_cast<Index>(null.size()));
    for (size_t i = 0; i < free.size(); ++i) {
      const int b = free[i];
      const double unit = 1 / std::sqrt(placed_body(system_, b).inertia);
      const auto row = static_cast<Index>(i);
      for (size_t c = 0; c < kept.size(); ++c)
        out_.rotation(b, static_cast<Index>(c)) = unit * eigen.vectors(row, kept[c]);
      for (size_t c = 0; c < null.size(); ++c)
        out_.rolling(b, static_cast<Index>(c)) = unit * system_.base_radius(b) * eigen.vectors(row, null[c]);
    }
    for (Index c = 0; c < out_.rolling.cols(); ++c)
      out_.rolling.col(c) /= out_.rolling.col(c).cwiseAbs().maxCoeff();
    for (Index c = 0; c < out_.rigid; ++c) {
      double torque = 0;
      for (const int b : free) torque += system_.layout.torque(b) * out_.rotation(b, c);
      add(0, motion_.damping.rayleigh_mass + 2 * motion_.damping.bearing_ratio * motion_.axis_frequency,
          torque);
    }
  }

  // Columns of the body's modes that move by themselves.
  std::vector<int> kept_of(int b) const {
    const BodyArtifact& body = system_.body[static_cast<size_t>(b)]->body();
    const bool turns = !system_.layout.held(b), sways = placed_body(system_, b).bearing.elastic();
    int torsional = -1, swaying = -1;
    for (int i = static_cast<int>(body.eigenfrequency.size()) - 1; i >= 0; --i) {
      if (body.nodal_diameter[i] == 0 &&
          (torsional < 0 || std::abs(body.inertia_coupling[i]) >= std::abs(body.inertia_coupling[torsional])))
        torsional = i;
      if (body.nodal_diameter[i] == 1) swaying = i;
    }
    if ((turns && torsional < 0) || (sways && swaying < 0))
      fail(Failure::input, "the body of '", placed_body(system_, b).name, "' holds ",
           body.eigenfrequency.size(), " modes and none of them has ",
           turns && torsional < 0 ? "zero" : "one", " nodal diameters, as a gear that ",
           turns && torsional < 0 ? "turns" : "stands on a bearing", " needs; raise modes in [fidelity]");
    std::vector<int> out;
    for (int i = 0; i < body.eigenfrequency.size(); ++i) {
      const bool first =
          (turns && i == torsional) ||
          (sways && (i == swaying || i == system_.body[static_cast<size_t>(b)]->partner(swaying)));
      if (motion_.fidelity.body == BodyModel::modal || first) out.push_back(i);
    }
    return out;
  }

  void add_body(int b) {
    const ElasticGear& gear = *system_.body[static_cast<size_t>(b)];
    const BodyArtifact& body = gear.body();
    SystemCoordinates::Share share;
    share.first = static_cast<int>(frequency_.size());
    share.kept = kept_of(b);
    const bool turns = !system_.layout.held(b), sways = placed_body(system_, b).bearing.elastic();
    std::vector<Index> torsional, swaying, others;  // rows of `columns`
    for (size_t i = 0; i < share.kept.size(); ++i) {
      const int diameters = body.nodal_diameter[share.kept[i]];
      (diameters == 0 && turns   ? torsional
       : diameters == 1 && sways ? swaying
                                 : others)
          .push_back(static_cast<Index>(i));
    }
    share.torsional = static_cast<int>(torsional.size());
    share.swaying = sways ? static_cast<int>(swaying.size()) + 2 : 0;
    share.count = share.torsional + share.swaying + static_cast<int>(others.size());
    share.columns = MatrixXd::Zero(static_cast<Index>(share.kept.size()), share.count);
    if (turns && !torsional.empty()) add_torsion(b, torsional, share);
    if (sways) add_sway(b, swaying, share);
    for (size_t i = 0; i < others.size(); ++i) {
      const int column = share.kept[static_cast<size_t>(others[i])], partner = gear.partner(column),
                here = static_cast<int>(frequency_.size());
      const double w = kTwoPi * body.eigenfrequency[column];
      share.columns(others[i], here - share.first) = 1;
      // Shape on tooth t: Re((q_c - i q_s) exp(i a t) phi); teeth are renamed t + sense.
      const double turn = -placed_body(system_, b).sense * gear.tooth_angle(column);
      if (partner == column + 1)
        out_.turns.push_back({here, here + 1, std::cos(turn), std::sin(turn)});
      else if (partner == column && body.nodal_diameter[column] > 0)
        out_.turns.push_back({here, -1, -1, 0});
      add(w, rayleigh(w * w), 0);
    }
    out_.body.push_back(std::move(share));
  }

  void add_torsion(int b, const std::vector<Index>& rows, SystemCoordinates::Share& share) {
    const BodyArtifact& body = system_.body[static_cast<size_t>(b)]->body();
    const System::Body& at = placed_body(system_, b);
    const auto k = static_cast<Index>(rows.size());
    MatrixXd mass = MatrixXd::Identity(k + 1, k + 1), stiffness = MatrixXd::Zero(k + 1, k + 1);
    mass(0, 0) = at.inertia;
    for (Index i = 0; i < k; ++i) {
      const int column = share.kept[static_cast<size_t>(rows[static_cast<size_t>(i)])];
      const double w = kTwoPi * body.eigenfrequency[column];
      mass(0, i + 1) = mass(i + 1, 0) = at.sense * body.inertia_coupling[column];
      stiffness(i + 1, i + 1) = w * w;
    }
    const SymmetricEigen eigen = symmetric_eigen(stiffness, mass);
    if (!eigen.converged || !(eigen.values[1] > 0))
      fail(Failure::numerical, "the ", k, " torsional modes of '", at.name,
           "' have no frequencies at an inertia of ", at.inertia, " kg m2; rebuild body.h5");
    share.hub = eigen.vectors.row(0).tail(k);
    for (Index i = 0; i < k; ++i) {
      for (Index j = 0; j < k; ++j)
        share.columns(rows[static_cast<size_t>(j)], i) = eigen.vectors(j + 1, i + 1);
      const double w2 = eigen.values[i + 1];
      add(std::sqrt(w2), rayleigh(w2), share.hub[i] * system_.layout.torque(b));
    }
  }

  void add_sway(int b, const std::vector<Index>& rows, SystemCoordinates::Share& share) {
    const BodyArtifact& body = system_.body[static_cast<size_t>(b)]->body();
    const System::Body& at = placed_body(system_, b);
    const Bearing& bearing = at.bearing;
    const double own_mass = bearing.mass > 0 ? bearing.mass : body.mass;
    if (!(own_mass >= body.mass * (1 - 1e-9)))
      fail(Failure::input, "mass_kg = ", own_mass, " in the [[bearing]] of '", at.name,
           "' lies below the mass of its own body, ", body.mass,
           " kg: it is that of all that moves with the hub; raise it");
    const auto k = static_cast<Index>(rows.size());
    MatrixXd mass = MatrixXd::Identity(k + 2, k + 2), stiffness = MatrixXd::Zero(k + 2, k + 2);
    mass.diagonal().head<2>().setConstant(own_mass);
    stiffness.diagonal().head<2>().setConstant(bearing.stiffness);
    for (Index i = 0; i < k; ++i) {
      const int column = share.kept[static_cast<size_t>(rows[static_cast<size_t>(i)])];
      const double w = kTwoPi * body.eigenfrequency[column];
      mass.row(i + 2).head<2>() = body.translation_coupling.row(column);
      mass.col(i + 2).head<2>() = body.translation_coupling.row(column).transpose();
      stiffness(i + 2, i + 2) = w * w;
    }
    const SymmetricEigen eigen = symmetric_eigen(stiffness, mass);
    if (!eigen.converged || !(eigen.values[0] > 0))
      fail(Failure::numerical, "'", at.name, "' of ", own_mass, " kg and ", k,
           " modes with one diameter has no frequencies on its bearing of ", bearing.stiffness,
           " N/m; rebuild body.h5");
    share.shift = eigen.vectors.topRows<2>();
    for (Index i = 0; i < k + 2; ++i) {
      const Index coordinate = share.torsional + i;
      for (Index j = 0; j < k; ++j)
        share.columns(rows[static_cast<size_t>(j)], coordinate) = eigen.vectors(j + 2, i);
      // Eq. 21 is of the body; the bearing has a damper of its own.
      const double hub = share.shift.col(i).squaredNorm(),
                   elastic = std::max(0.0, eigen.values[i] - bearing.stiffness * hub);
      add(std::sqrt(eigen.values[i]), rayleigh(elastic), 0, bearing.damping * hub);
    }
  }

  const SystemModel& system_;
  const SystemMotion& motion_;
  SystemCoordinates out_;
  std::vector<double> frequency_, damping_, torque_, of_bearing_;
};

}  // namespace

double axis_frequency(const SystemModel& system, const MatrixXd& mean_stiffness) {
  const MatrixXd approach = approaches(system, free_of(system));
  const SymmetricEigen eigen =
      symmetric_eigenvalues(MatrixXd(approach.transpose() * mean_stiffness * approach));
  if (!eigen.converged || !(eigen.values.tail(1)[0] > 0))
    fail(Failure::numerical, "the rigid train on its mean stiffnesses has no natural frequency");
  return std::sqrt(eigen.values.tail(1)[0]);
}

SystemCoordinates coordinates_of(const SystemModel& system, const SystemMotion& motion) {
  return Builder(system, motion).build();
}

VectorXd SystemCoordinates::participation(const SystemModel& system, int b, const ToothFlank& flank,
                                          double phase, const Eigen::RowVectorXd& weights,
                                          const Vec2& outward) const {
  const Share& own = body[static_cast<size_t>(b)];
  const ElasticGear& gear = *system.body[static_cast<size_t>(b)];
  const BodyArtifact& modes = gear.body();
  const System::Body& at = placed_body(system, b);
  const Eigen::RowVectorXd shape =
      weights * (flank.side == FlankSide::leading ? modes.flank_mode : modes.back_flank_mode);
  VectorXd on(static_cast<Index>(own.kept.size()));
  for (size_t i = 0; i < own.kept.size(); ++i) {
    const int column = own.kept[i], partner = gear.partner(column);
    const bool sways = own.swaying > 0 && modes.nodal_diameter[column] == 1;
    // Modes that sway stand in the frame of the system, in which the tooth goes round; the others go with it.
    const double angle = sways ? gear.tooth_angle(column) * (flank.tooth + at.sense * phase) + at.angle
                               : gear.tooth_angle(column) * flank.tooth;
    const double sign = partner == column ? 0 : modes.component[column] == 0 ? -1 : 1;
    on[static_cast<Index>(i)] = std::cos(angle) * shape[column] + sign * std::sin(angle) * shape[partner];
  }
  VectorXd out = own.columns.transpose() * on;
  for (int i = 0; i < own.swaying; ++i) out[own.torsional + i] += outward.dot(own.shift.col(i));
  return out;
}

}  // namespace whine
