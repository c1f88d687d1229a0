#include "dynamics/system_coordinates.h"

#include <algorithm>
#include <cmath>

#include "base/dense.h"
#include "base/error.h"
#include "base/units.h"
#include "gear/layout.h"
#include "model/capabilities.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kNull = 1e-12;  // of the largest: squared approach of a rolling

const System::Body& placed_body(const SystemModel& system, int b) {
  return system.layout.bodies[static_cast<size_t>(b)];
}

// kg: of all that moves with a gear's hub, as drawn where the layout does not say it.
double mass_on_bearing(const SystemModel& system, int b) {
  const System::Body& at = placed_body(system, b);
  const double body = system.body[static_cast<size_t>(b)]->body().mass,
               own = at.bearing.mass > 0 ? at.bearing.mass : body;
  if (!(own >= body * (1 - 1e-9)))
    fail(Failure::input, "mass_kg = ", own, " in the [[bearing]] of '", at.name,
         "' lies below the mass of its own body, ", body,
         " kg: it is that of all that moves with the hub; raise it");
  return own;
}

// kg m2: of a carrier about its axis with all that goes round with it. Planets on rigid pins are in its own inertia.
double turning_inertia(const SystemModel& system, int carrier) {
  const System::Body& own = placed_body(system, carrier);
  double out = own.inertia, on_rigid_pins = 0;
  for (int b = 0; b < static_cast<int>(system.body.size()); ++b) {
    const System::Body& planet = placed_body(system, b);
    if (planet.on != carrier) continue;
    const double of_planet = mass_on_bearing(system, b) * own.radius * own.radius;
    (planet.bearing.elastic() ? out : on_rigid_pins) += of_planet;
  }
  if (!(own.inertia > 0) || !(own.inertia >= on_rigid_pins * (1 - 1e-9)))
    fail(Failure::input, "the inertia of carrier '", own.name, "', ", own.inertia, " kg m2, ",
         on_rigid_pins > 0 ? text("lies below that of its planets on rigid pins, ", on_rigid_pins, " kg m2")
                           : text("is not above 0"),
         "; raise inertia_kgm2, or hold the carrier by a [[drive]]");
  return out;
}

std::vector<int> free_of(const SystemModel& system) {
  std::vector<int> out;
  for (int b = 0; b < static_cast<int>(system.layout.bodies.size()); ++b) {
    if (system.layout.held(b)) continue;
    out.push_back(b);
    if (placed_body(system, b).kind == System::BodyKind::carrier) continue;
    const System::Body& body = placed_body(system, b);
    const double own = system.body[static_cast<size_t>(b)]->body().inertia;
    if (!(body.inertia >= own * (1 - 1e-9)))
      fail(Failure::input, "the inertia of '", body.name, "', ", body.inertia,
           " kg m2, lies below that of its own body, ", own, " kg m2; raise total_inertia_kgm2");
  }
  return out;
}

// (body) kg m2: of rigid rotations.
VectorXd inertias(const SystemModel& system) {
  VectorXd out(static_cast<Index>(system.layout.bodies.size()));
  for (int b = 0; b < out.size(); ++b) {
    const System::Body& body = placed_body(system, b);
    out[b] = body.kind == System::BodyKind::carrier && !system.layout.held(b) ? turning_inertia(system, b)
                                                                              : body.inertia;
  }
  return out;
}

// (mesh, free body): approach of the mesh per unit rotation of unit modal mass.
MatrixXd approaches(const SystemModel& system, const std::vector<int>& free, const VectorXd& inertia) {
  VectorXd unit(static_cast<Index>(free.size()));
  for (Index i = 0; i < unit.size(); ++i) {
    const int b = free[static_cast<size_t>(i)];
    unit[i] = system.base_radius(b) / std::sqrt(inertia[b]);
  }
  return closing_of(system.layout)(free, Eigen::all).transpose() * unit.asDiagonal();
}

class Builder {
 public:
  Builder(const SystemModel& system, const SystemMotion& motion) : system_(system), motion_(motion) {}

  SystemCoordinates build() {
    const Fidelity& fidelity = motion_.fidelity;
    Traits of = traits(fidelity);
    if (fidelity.body == BodyModel::rigid) of.emplace_back(Trait::rigid_gears, "");
    require_able("motion", of);
    if (fidelity.contact != ContactModel::line)
      fail(Failure::input, "contact = \"", fidelity.contact, "\" in motion: systems have \"line\"");
    const auto bodies = static_cast<int>(system_.layout.bodies.size());
    out_.inertia = inertias(system_);
    out_.mass = VectorXd::Zero(bodies);
    out_.body.resize(static_cast<size_t>(bodies));
    add_rotations();
    for (int b = 0; b < static_cast<int>(system_.body.size()); ++b) add_body(b);
    for (int b = 0; b < bodies; ++b)
      if (moving_carrier(system_.layout, b)) add_group(b);
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
    const auto bodies = static_cast<Index>(system_.layout.bodies.size());
    const MatrixXd approach = approaches(system_, free, out_.inertia);
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
      const double unit = 1 / std::sqrt(out_.inertia[b]);
      const auto row = static_cast<Index>(i);
      for (size_t c = 0; c < kept.size(); ++c)
        out_.rotation(b, static_cast<Index>(c)) = unit * eigen.vectors(row, kept[c]);
      for (size_t c = 0; c < null.size(); ++c)
        out_.rolling(b, static_cast<Index>(c)) = unit * system_.base_radius(b) * eigen.vectors(row, null[c]);
    }
    for (Index c = 0; c < out_.rolling.cols(); ++c)
      out_.rolling.col(c) /= out_.rolling.col(c).cwiseAbs().maxCoeff();
    for (size_t b = 0; b < system_.body.size(); ++b)
      if (const System::Body& planet = system_.layout.bodies[b];
          planet.on != System::kGround && !system_.layout.held(planet.on))
        out_.body[b].carried = system_.base_radius(planet.on) * pin_direction(system_.layout, planet) *
                               out_.rotation.row(planet.on);
    for (Index c = 0; c < out_.rigid; ++c) {
      double torque = 0;
      for (const int b : free) torque += system_.layout.torque(b) * out_.rotation(b, c);
      add(0, motion_.damping.rayleigh_mass + 2 * motion_.damping.bearing_ratio * motion_.axis_frequency,
          torque);
    }
  }

  // Columns of the body's modes that move by themselves.
  std::vector<int> kept_of(int b) const {
    const ReducedBody& body = system_.body[static_cast<size_t>(b)]->body();
    const bool turns = !system_.layout.held(b), sways = sways_alone(b) || in_group(b);
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
           turns && torsional < 0 ? "turns" : "stands on a bearing or a carrier that moves",
           " needs; raise modes in [fidelity]");
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
    const ReducedBody& body = gear.body();
    SystemCoordinates::Share& share = out_.body[static_cast<size_t>(b)];
    share.first = static_cast<int>(frequency_.size());
    share.kept = kept_of(b);
    const bool turns = !system_.layout.held(b), sways = sways_alone(b), grouped = in_group(b);
    std::vector<Index> torsional, swaying, others;  // rows of `columns`
    for (size_t i = 0; i < share.kept.size(); ++i) {
      const int diameters = body.nodal_diameter[share.kept[i]];
      if (diameters == 1 && grouped) continue;
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
  }

  // x and y of a body with its own coordinates, or with those of the carrier that moves with it.
  bool sways_alone(int b) const { return placed_body(system_, b).bearing.elastic() && !in_group(b); }
  bool in_group(int b) const {
    const int on = placed_body(system_, b).on;
    return on != System::kGround && moving_carrier(system_.layout, on);
  }

  void add_torsion(int b, const std::vector<Index>& rows, SystemCoordinates::Share& share) {
    const ReducedBody& body = system_.body[static_cast<size_t>(b)]->body();
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
    const ReducedBody& body = system_.body[static_cast<size_t>(b)]->body();
    const System::Body& at = placed_body(system_, b);
    const Bearing& bearing = at.bearing;
    const double own_mass = out_.mass[b] = mass_on_bearing(system_, b);
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

  // The freedoms of a group before they are diagonalised: u of the carrier, x and y of hubs on elastic bearings, modes.
  struct Freedoms {
    Index turn = -1, count = 0;
    std::vector<MatrixXd> shift, stretch;           // [member] (xy, freedom) X, D
    std::vector<std::pair<size_t, Index>> mode_of;  // [mode] member and row of its kept modes
    Index first_mode = 0;
  };
  Freedoms freedoms_of(const SystemCoordinates::Group& group) const {
    Freedoms out;
    const size_t members = group.member.size();
    std::vector<Index> move(members, -1);
    if (!system_.layout.held(group.carrier)) out.turn = out.count++;
    for (size_t i = 0; i < members; ++i) {
      const int b = group.member[i].body;
      if (placed_body(system_, b).bearing.elastic()) {
        move[i] = out.count;
        out.count += 2;
      }
    }
    out.first_mode = out.count;
    for (size_t i = 0; i + 1 < members; ++i) {
      const int b = group.member[i].body;
      const std::vector<int>& kept = out_.body[static_cast<size_t>(b)].kept;
      const ReducedBody& body = system_.body[static_cast<size_t>(b)]->body();
      for (size_t row = 0; row < kept.size(); ++row)
        if (body.nodal_diameter[kept[row]] == 1) out.mode_of.emplace_back(i, static_cast<Index>(row));
    }
    out.count += static_cast<Index>(out.mode_of.size());
    out.shift.assign(members, MatrixXd::Zero(2, out.count));
    out.stretch = out.shift;
    for (size_t i = members; i-- > 0;) {  // the carrier first
      MatrixXd carried = MatrixXd::Zero(2, out.count);
      if (i + 1 < members) {
        carried = out.shift.back();
        if (out.turn >= 0)
          carried.col(out.turn) += pin_direction(system_.layout, placed_body(system_, group.member[i].body));
      }
      out.shift[i] = carried;
      if (move[i] < 0) continue;
      out.shift[i].setZero();
      out.shift[i].middleCols(move[i], 2).setIdentity();
      out.stretch[i] = out.shift[i] - carried;
    }
    return out;
  }

  // M0 and K0 of a group.
  std::pair<MatrixXd, MatrixXd> matrices_of(const SystemCoordinates::Group& group, const Freedoms& of) const {
    MatrixXd mass = MatrixXd::Zero(of.count, of.count), stiffness = mass;
    const System::Body& carrier = placed_body(system_, group.carrier);
    if (of.turn >= 0) mass(of.turn, of.turn) = carrier.inertia / (carrier.radius * carrier.radius);
    for (size_t i = 0; i < group.member.size(); ++i) {
      const int b = group.member[i].body;
      const Bearing& bearing = placed_body(system_, b).bearing;
      if (!bearing.elastic()) continue;  // the mass of a planet on a rigid pin is in that of the carrier
      const double moved = b == group.carrier ? bearing.mass : mass_on_bearing(system_, b);
      mass += moved * of.shift[i].transpose() * of.shift[i];
      stiffness += bearing.stiffness * of.stretch[i].transpose() * of.stretch[i];
    }
    for (size_t m = 0; m < of.mode_of.size(); ++m) {
      const auto [i, row] = of.mode_of[m];
      const auto b = static_cast<size_t>(group.member[i].body);
      const ReducedBody& body = system_.body[b]->body();
      const int column = out_.body[b].kept[static_cast<size_t>(row)];
      const Index at = of.first_mode + static_cast<Index>(m);
      const double w = kTwoPi * body.eigenfrequency[column];
      const VectorXd coupling = of.shift[i].transpose() * body.translation_coupling.row(column).transpose();
      mass.col(at) += coupling;
      mass.row(at) += coupling.transpose();
      mass(at, at) += 1;
      stiffness(at, at) += w * w;
    }
    return {mass, stiffness};
  }

  void add_group(int carrier) {
    SystemCoordinates::Group group;
    group.carrier = carrier;
    group.first = static_cast<int>(frequency_.size());
    for (int b = 0; b < static_cast<int>(system_.body.size()); ++b)
      if (placed_body(system_, b).on == carrier) group.member.emplace_back().body = b;
    group.member.emplace_back().body = carrier;
    out_.mass[carrier] =
        placed_body(system_, carrier).bearing.elastic() ? placed_body(system_, carrier).bearing.mass : 0;
    for (size_t i = 0; i < group.member.size(); ++i) {
      const int b = group.member[i].body;
      if (b != carrier) {
        out_.mass[b] = mass_on_bearing(system_, b);
        if (placed_body(system_, carrier).bearing.elastic() && !placed_body(system_, b).bearing.elastic())
          out_.mass[carrier] -= out_.mass[b];
      }
      SystemCoordinates::Share& share = out_.body[static_cast<size_t>(b)];
      share.group = static_cast<int>(out_.group.size());
      share.member = static_cast<int>(i);
    }
    const Freedoms of = freedoms_of(group);
    const auto [mass, stiffness] = matrices_of(group, of);
    const SymmetricEigen eigen = symmetric_eigen(stiffness, mass);
    const Index null = of.turn >= 0 ? 1 : 0;  // the rigid rotation, which is among the rotations
    if (!eigen.converged || (of.count > null && !(eigen.values[null] > kNull * eigen.values.tail(1)[0])))
      fail(Failure::numerical, "carrier '", placed_body(system_, carrier).name, "' and its planets, ",
           of.count,
           " freedoms, have no frequencies: masses or bearings are missing, or body.h5 is to be rebuilt");
    const MatrixXd shape = eigen.vectors.rightCols(of.count - null);
    group.count = static_cast<int>(shape.cols());
    group.hub = VectorXd::Zero(shape.cols());
    if (of.turn >= 0) group.hub = shape.row(of.turn).transpose() / placed_body(system_, carrier).radius;
    VectorXd elastic = eigen.values.tail(shape.cols()), of_bearing = VectorXd::Zero(shape.cols());
    for (size_t i = 0; i < group.member.size(); ++i) {
      SystemCoordinates::Group::Member& member = group.member[i];
      const auto b = static_cast<size_t>(member.body);
      const Bearing& bearing = system_.layout.bodies[b].bearing;
      member.shift = of.shift[i] * shape;
      member.stretch = of.stretch[i] * shape;
      const VectorXd squares = member.stretch.colwise().squaredNorm();
      elastic -= bearing.stiffness * squares;
      member.of_bearing = bearing.damping * squares;
      of_bearing += member.of_bearing;
      member.columns = MatrixXd::Zero(static_cast<Index>(out_.body[b].kept.size()), shape.cols());
    }
    for (size_t m = 0; m < of.mode_of.size(); ++m)
      group.member[of.mode_of[m].first].columns.row(of.mode_of[m].second) =
          shape.row(of.first_mode + static_cast<Index>(m));
    for (size_t i = 0; i + 1 < group.member.size(); ++i) add_momentum(group.member[i]);
    for (Index i = 0; i < shape.cols(); ++i)
      add(std::sqrt(eigen.values[null + i]), rayleigh(std::max(0.0, elastic[i])),
          group.hub[i] * system_.layout.torque(carrier), of_bearing[i]);
    out_.group.push_back(std::move(group));
  }

  void add_momentum(SystemCoordinates::Group::Member& planet) {
    if (placed_body(system_, planet.body).bearing.elastic()) return;
    const std::vector<int>& kept = out_.body[static_cast<size_t>(planet.body)].kept;
    const ReducedBody& body = system_.body[static_cast<size_t>(planet.body)]->body();
    planet.mass = mass_on_bearing(system_, planet.body);
    out_.rigid_pins = true;
    planet.momentum = planet.mass * planet.shift;
    for (size_t row = 0; row < kept.size(); ++row)
      if (body.nodal_diameter[kept[row]] == 1)
        planet.momentum += body.translation_coupling.row(kept[row]).transpose() *
                           planet.columns.row(static_cast<Index>(row));
  }

  const SystemModel& system_;
  const SystemMotion& motion_;
  SystemCoordinates out_;
  std::vector<double> frequency_, damping_, torque_, of_bearing_;
};

}  // namespace

double axis_frequency(const SystemModel& system, const MatrixXd& mean_stiffness) {
  const MatrixXd approach = approaches(system, free_of(system), inertias(system));
  const SymmetricEigen eigen =
      symmetric_eigenvalues(MatrixXd(approach.transpose() * mean_stiffness * approach));
  if (!eigen.converged || !(eigen.values.tail(1)[0] > 0))
    fail(Failure::numerical, "the rigid train on its mean stiffnesses has no natural frequency");
  return std::sqrt(eigen.values.tail(1)[0]);
}

SystemCoordinates coordinates_of(const SystemModel& system, const SystemMotion& motion) {
  return Builder(system, motion).build();
}

SystemCoordinates::Participation SystemCoordinates::participation(const SystemModel& system, int b,
                                                                  const ToothFlank& flank, double phase,
                                                                  const Eigen::RowVectorXd& weights,
                                                                  const Vec2& outward) const {
  const Share& own = body[static_cast<size_t>(b)];
  const ElasticGear& gear = *system.body[static_cast<size_t>(b)];
  const ReducedBody& modes = gear.body();
  const System::Body& at = placed_body(system, b);
  const Eigen::RowVectorXd shape =
      weights * (flank.side == FlankSide::leading ? modes.flank_mode : modes.back_flank_mode);
  VectorXd on(static_cast<Index>(own.kept.size()));
  for (size_t i = 0; i < own.kept.size(); ++i) {
    const int column = own.kept[i], partner = gear.partner(column);
    const bool sways = (own.swaying > 0 || own.group >= 0) && modes.nodal_diameter[column] == 1;
    // Modes that sway stand in the frame of the system, in which the tooth goes round; the others go with it.
    const double angle = sways ? gear.tooth_angle(column) * (flank.tooth + at.sense * phase) + at.angle
                               : gear.tooth_angle(column) * flank.tooth;
    const double sign = partner == column ? 0 : modes.component[column] == 0 ? -1 : 1;
    on[static_cast<Index>(i)] = std::cos(angle) * shape[column] + sign * std::sin(angle) * shape[partner];
  }
  Participation out{own.columns.transpose() * on, {}};
  for (int i = 0; i < own.swaying; ++i) out.own[own.torsional + i] += outward.dot(own.shift.col(i));
  if (own.group >= 0) {
    const Group::Member& in = group[static_cast<size_t>(own.group)].member[static_cast<size_t>(own.member)];
    out.group = in.columns.transpose() * on + in.shift.transpose() * outward;
  }
  return out;
}

}  // namespace whine
