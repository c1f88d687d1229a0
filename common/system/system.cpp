#include "system/system.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dense.h"
#include "base/error.h"
#include "contact/friction.h"
#include "gear/train.h"
#include "system/rigid_system.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SystemModel::SystemModel(const BodyArtifact& driver, const BodyArtifact& driven, const GearMeshSpec& spec)
    : layout(pair_system(spec, driver.design, driven.design)) {
  for (const BodyArtifact* of : {&driver, &driven})
    body.push_back(std::make_shared<const ElasticGear>(*of, spec.contact_plane));
  mesh.emplace_back(SideGears(body[0], body[1]), spec, layout.meshes[0]);
}

SystemModel::SystemModel(const System& of, const std::vector<BodyArtifact>& bodies,
                         const std::vector<GearMeshSpec>& specs)
    : layout(of) {
  const auto gears = static_cast<size_t>(
      std::count_if(layout.bodies.begin(), layout.bodies.end(),
                    [](const System::Body& b) { return b.kind == System::BodyKind::gear; }));
  if (bodies.size() != gears || specs.size() != layout.meshes.size() || specs.empty())
    fail(Failure::input, "a system of ", gears, " gears and ", layout.meshes.size(), " meshes is given ",
         bodies.size(), " and ", specs.size());
  for (size_t b = 0; b < layout.bodies.size(); ++b)
    if ((layout.bodies[b].kind == System::BodyKind::gear) != (b < gears) ||
        !has_place(layout, layout.bodies[b]))
      fail(Failure::input, "'", layout.bodies[b].name,
           "': gears stand before carriers, on the ground or on a carrier that stands there");
  for (const GearMeshSpec& spec : specs)
    if (spec.contact_plane != specs[0].contact_plane)
      fail(Failure::input, "the meshes of a system have contact_plane = \"", specs[0].contact_plane,
           "\" and \"", spec.contact_plane,
           "\": bodies that take part in both have one; give all meshes the same");
  for (const BodyArtifact& artifact : bodies)
    body.push_back(std::make_shared<const ElasticGear>(artifact, specs[0].contact_plane));
  for (size_t m = 0; m < specs.size(); ++m) {
    const System::Mesh& placed = layout.meshes[m];
    GearMeshSpec spec = specs[m];
    for (size_t s = 0; s < kSides; ++s) {
      const int b = placed.side[s].body;
      spec.bearing[s] = layout.bodies[static_cast<size_t>(b)].bearing;
      if (specs.size() > 1 && body[static_cast<size_t>(b)]->cracked())
        fail(Failure::input, "[gear.", layout.bodies[static_cast<size_t>(b)].name,
             "] has a crack; a cracked gear is computed in a single pair only");
    }
    mesh.emplace_back(SideGears(body[static_cast<size_t>(placed.side[0].body)],
                                body[static_cast<size_t>(placed.side[1].body)]),
                      spec, placed);
  }
}

double SystemModel::base_radius(int b) const {
  if (const System::Body& of = layout.bodies[static_cast<size_t>(b)]; of.kind == System::BodyKind::carrier)
    return of.radius;
  for (const GearMeshModel& of : mesh)
    for (int s = 0; s < kSides; ++s)
      if (of.layout.side[static_cast<size_t>(s)].body == b) return of.kinematics.gear(s).base_radius();
  fail(Failure::input, "[gear.", layout.bodies[static_cast<size_t>(b)].name, "] is in no mesh");
}

int SystemModel::side_of(int b, int m) const {
  const auto& side = layout.meshes[static_cast<size_t>(m)].side;
  return side[0].body == b ? 0 : side[1].body == b ? 1 : -1;
}

MeshInstant mesh_instant(const SystemModel& system, int m, double phase, int period) {
  const double ahead = system.layout.meshes[static_cast<size_t>(m)].phase + phase, whole = std::floor(ahead);
  return {ahead - whole, period + static_cast<int>(whole)};
}

int hunting_periods(const SystemModel& system) {
  if (system.mesh.size() == 1) return hunting_periods(system.mesh[0]);
  std::vector<int> teeth;
  teeth.reserve(kSides * system.mesh.size());
  for (const GearMeshModel& mesh : system.mesh)
    for (const FlankDeviation& flank : mesh.deviation) teeth.push_back(flank.repeats());
  return hunting_periods_of(teeth);
}

namespace {

// L = D + mu s T: moments about the axes and forces across the normal.
void add_friction(const SystemModel& system, SystemPosition& position) {
  for (const ContactSegment& segment : position.segment) {
    const GearMeshModel& model = system.mesh[static_cast<size_t>(segment.mesh)];
    const double share = system.friction * segment.sliding.direction;
    const auto own = Eigen::seqN(segment.first_strip, segment.strips);
    const Vec2 across(-segment.normal.y(), segment.normal.x());
    for (int s = 0; s < kSides; ++s) {
      const auto side = static_cast<size_t>(s);
      const int b = model.layout.side[side].body;
      position.load.rotation.col(b)(own).array() +=
          closing_sign(s) * share * segment.sliding.lever[side] / model.kinematics.gear(s).base_radius();
      MatrixXd& rows = position.load.translation[static_cast<size_t>(b)];
      if (rows.size() > 0) rows(own, Eigen::all).rowwise() += closing_sign(s) * share * across.transpose();
    }
  }
}

}  // namespace

SystemPosition join(const SystemModel& system, double phase, int period,
                    std::vector<MeshPosition> positions) {
  SystemPosition out;
  out.phase = phase;
  out.mesh = std::move(positions);
  out.first_strip = {0};
  for (const MeshPosition& mesh : out.mesh) out.first_strip.push_back(out.first_strip.back() + mesh.strips());
  const auto bodies = static_cast<Index>(system.layout.bodies.size());
  out.gap.resize(out.first_strip.back());
  ContactMap map;
  map.rotation = MatrixXd::Zero(out.strips(), bodies);
  map.translation.resize(static_cast<size_t>(bodies));
  for (Index b = 0; b < bodies; ++b)
    if (system.layout.bodies[static_cast<size_t>(b)].bearing.elastic())
      map.translation[static_cast<size_t>(b)] = MatrixXd::Zero(out.strips(), 2);
  for (size_t m = 0; m < out.mesh.size(); ++m) {
    const MeshPosition& position = out.mesh[m];
    const GearMeshModel& model = system.mesh[m];
    const int first = out.first_strip[m];
    out.gap(out.strips_of(m)) = position.gap;
    for (int s = 0; s < kSides; ++s) {
      const int b = model.layout.side[static_cast<size_t>(s)].body;
      map.rotation(out.strips_of(m), b) = closing_sign(s) * (position.strip_lever[static_cast<size_t>(s)] /
                                                             model.kinematics.gear(s).base_radius());
    }
    map.flank.push_back({position.table_weights[0], position.table_weights[1]});
    const MeshInstant at = mesh_instant(system, static_cast<int>(m), phase, period);
    for (size_t j = 0; j < position.pairs.size(); ++j) {
      const PairStrips& strips = position.pairs[j];
      ContactSegment segment;
      segment.mesh = static_cast<int>(m);
      segment.pair = strips.pair;
      for (size_t s = 0; s < kSides; ++s)
        segment.tooth[s] = model.layout.side[s].tooth(strips.pair - at.period);
      segment.flank = model.layout.side[0].flank;
      segment.phase = at.phase + strips.pair;
      segment.gap = strips.contact.gap;
      segment.normal = model.outward_in_system(0, strips.contact);
      segment.lever = strips.contact.lever;
      if (system.friction > 0)
        segment.sliding = sliding_of(model.kinematics, strips.contact, model.friction.smoothing);
      segment.width = std::min(model.kinematics.gear(0).design().face_width,
                               model.kinematics.gear(1).design().face_width);
      segment.first_strip = first + position.first_strip[j];
      segment.strips = position.first_strip[j + 1] - position.first_strip[j];
      for (int s = 0; s < kSides; ++s) {
        const auto b = static_cast<size_t>(model.layout.side[static_cast<size_t>(s)].body);
        const auto move = [&](MatrixXd& rows) {
          if (rows.size() > 0)
            rows.middleRows(segment.first_strip, segment.strips).rowwise() =
                closing_sign(s) * segment.normal.transpose();
        };
        move(map.translation[b]);
        const System::Body& body = system.layout.bodies[b];
        if (body.on == System::kGround) continue;
        move(map.translation[static_cast<size_t>(body.on)]);
        map.rotation.col(body.on).segment(segment.first_strip, segment.strips).array() =
            closing_sign(s) * segment.normal.dot(pin_direction(system.layout, body));
      }
      out.segment.push_back(segment);
    }
  }
  out.displacement = map;
  out.load = std::move(map);
  if (system.friction > 0) add_friction(system, out);
  return out;
}

SystemTables compliance_tables(const SystemModel& system, std::span<const double> depth) {
  SystemTables out;
  for (size_t m = 0; m < system.mesh.size(); ++m)
    out.push_back({compliance_tables(system.mesh[m].gear[0], depth[m]),
                   compliance_tables(system.mesh[m].gear[1], depth[m])});
  return out;
}

namespace {

// (strip, strip) m N-1: how the strips of mesh `read` open under the forces of mesh `loaded` by way of the body that both
// share.
MatrixXd between_meshes(const SystemModel& system, const SystemPosition& position, size_t read, int read_side,
                        size_t loaded, int loaded_side) {
  const MeshPosition &to = position.mesh[read], &from = position.mesh[loaded];
  const auto side_r = static_cast<size_t>(read_side), side_l = static_cast<size_t>(loaded_side);
  const ElasticGear& gear = system.mesh[read].gear[side_r];
  const MatrixXd &reading = position.displacement.flank[read][side_r],
                 &loading = position.load.flank[loaded][side_l];
  const auto segments_of = [&](size_t m) {
    std::vector<const ContactSegment*> out;
    for (const ContactSegment& segment : position.segment)
      if (segment.mesh == static_cast<int>(m)) out.push_back(&segment);
    return out;
  };
  const auto onto = [](const MeshPosition& mesh, size_t j) -> MatrixXd {
    if (!mesh.law.empty()) return MatrixXd::Identity(1, 1);
    return mesh.pairs[j].interpolation;
  };
  MatrixXd out(to.strips(), from.strips());
  const auto rows = segments_of(read), columns = segments_of(loaded);
  for (size_t i = 0; i < rows.size(); ++i)
    for (size_t j = 0; j < columns.size(); ++j) {
      const MatrixXd table = gear.compliance({rows[i]->tooth[side_r], rows[i]->flank},
                                             {columns[j]->tooth[side_l], columns[j]->flank}, 0);
      const MatrixXd nodes =
          reading(to.nodes_of(i), Eigen::all) * table * loading(from.nodes_of(j), Eigen::all).transpose();
      out.block(to.first_strip[i], from.first_strip[j], rows[i]->strips, columns[j]->strips) =
          onto(to, i) * nodes * onto(from, j).transpose();
    }
  return out;
}

}  // namespace

MatrixXd contact_compliance(const SystemModel& system, const SystemPosition& position,
                            const SystemTables& tables, std::span<const double> depth) {
  MatrixXd a = MatrixXd::Zero(position.strips(), position.strips());
  for (size_t m = 0; m < position.mesh.size(); ++m) {
    const MeshPosition& mesh = position.mesh[m];
    MatrixXd own = local_compliance(system.mesh[m], mesh, depth[m]);
    mesh.add_to_strips(body_compliance(mesh, 0, tables[m][0]) + body_compliance(mesh, 1, tables[m][1]), own);
    a(position.strips_of(m), position.strips_of(m)) = own;
  }
  for (int b = 0; b < static_cast<int>(system.body.size()); ++b)
    for (size_t m = 0; m < position.mesh.size(); ++m)
      for (size_t n = 0; n < position.mesh.size(); ++n) {
        const int read = system.side_of(b, static_cast<int>(m)),
                  loaded = system.side_of(b, static_cast<int>(n));
        if (m == n || read < 0 || loaded < 0) continue;
        a(position.strips_of(m), position.strips_of(n)) +=
            between_meshes(system, position, m, read, n, loaded);
      }
  for (size_t b = 0; b < system.layout.bodies.size(); ++b)
    if (const Bearing& bearing = system.layout.bodies[b].bearing; bearing.elastic())
      a += position.displacement.translation[b] * position.displacement.translation[b].transpose() /
           bearing.stiffness;
  return a;
}

MatrixXd friction_compliance(const SystemModel& system, const SystemPosition& position) {
  MatrixXd out;
  for (size_t b = 0; system.friction > 0 && b < system.layout.bodies.size(); ++b) {
    const Bearing& bearing = system.layout.bodies[b].bearing;
    if (!bearing.elastic()) continue;
    const MatrixXd &read = position.displacement.translation[b], &pushed = position.load.translation[b];
    if (out.size() == 0) out.setZero(position.strips(), position.strips());
    out += read * (pushed - read).transpose() / bearing.stiffness;
  }
  return out;
}

VectorXd mesh_loads(const SystemModel& system) {
  const LoadBalance out = load_balance(system.layout);
  if (!out.balanced) fail(Failure::input, unbalanced_words(system.layout));
  if (out.pulled_apart >= 0) {
    const System::Mesh& mesh = system.layout.meshes[static_cast<size_t>(out.pulled_apart)];
    fail(Failure::input, "the torques pull the mesh of '",
         system.layout.bodies[static_cast<size_t>(mesh.side[0].body)].name, "' and '",
         system.layout.bodies[static_cast<size_t>(mesh.side[1].body)].name, "' apart (",
         out.load[out.pulled_apart], " N); ", kFlowOfPower);
  }
  if (!(out.load.maxCoeff() > 0)) fail(Failure::input, kNoTorque);
  // A mesh that carries nothing has a load of round-off.
  return (out.load.array() > 1e-12 * out.load.maxCoeff()).select(out.load, 0.0);
}

double SystemEquilibrium::transmission_error(const SystemModel& system, int m) const {
  const auto& side = system.layout.meshes[static_cast<size_t>(m)].side;
  const double of_gears = x[side[0].body] - x[side[1].body];
  const CarriedMesh on = carried_mesh(system.layout, static_cast<size_t>(m));
  return on.carrier < 0 ? of_gears : of_gears + on.closing * x[on.carrier];
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
    if (at.residual < 1e-10 && idle > 1) return true;
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

}  // namespace

SystemEquilibrium equilibrium(const SystemModel& system, const SystemPosition& position,
                              const MatrixXd& compliance, const VectorXd& start,
                              ComplementaritySolver& solver) {
  const std::vector<int> free = free_bodies(system.layout);
  const auto freedoms = static_cast<Index>(free.size());
  const LoadBalance balance = load_balance(system.layout);
  MatrixXd displacement(position.strips(), freedoms), load(position.strips(), freedoms);
  VectorXd force(freedoms), x(freedoms);
  for (Index i = 0; i < freedoms; ++i) {
    const int b = free[static_cast<size_t>(i)];
    displacement.col(i) = position.displacement.rotation.col(b);
    load.col(i) = position.load.rotation.col(b);
    force[i] = balance.force[b];
    x[i] = start[b];
  }
  const MatrixXd friction = friction_compliance(system, position);
  Contact contact(position, compliance, friction, system.friction > 0, solver);
  SystemEquilibrium out;
  out.x = VectorXd::Zero(static_cast<Index>(system.layout.bodies.size()));
  out.p = VectorXd::Zero(position.strips());
  const auto give = [&] {
    for (Index i = 0; i < freedoms; ++i) out.x[free[static_cast<size_t>(i)]] = x[i];
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
  const MatrixXd rolls = without_rolling(closing_of(system.layout)(free, Eigen::all));
  VectorXd unbalance;
  const auto stand = [&](const VectorXd& at) {
    const StillContact held = contact.solve(position.gap - displacement * at, displacement, load, out.p);
    out.certificate = held.certificate;
    out.stiffness = held.stiffness;
    unbalance = load.transpose() * out.p - force;
    if (rolls.size() > 0) {
      unbalance = (rolls * unbalance).eval();
      out.stiffness = (rolls * out.stiffness * rolls).eval();
    }
    if (!unbalance.allFinite() || !out.stiffness.allFinite())
      fail(Failure::numerical, "static equilibrium of the system: the compliance holds no number");
    out.residual = unbalance.cwiseAbs().maxCoeff() / scale;
  };
  // From where the bodies stood at the position before, if that is known.
  constexpr int kNearSteps = 20, kSteps = 200;
  const bool known = x.squaredNorm() > 0;
  if (known && balanced(stand, x, unbalance, out, scale / x.cwiseAbs().maxCoeff(), kNearSteps)) return give();
  x = first_guess(system, position, compliance, free);
  if (balanced(stand, x, unbalance, out, scale / x.cwiseAbs().maxCoeff(), kSteps)) return give();
  fail(Failure::numerical, "static equilibrium of the system did not converge: residual ", out.residual,
       " of the largest mesh load ", scale, " N after ", kSteps, " steps");
}

namespace {

// From the first side's flank to the second's: the direction of a contact's force per normal force, friction included.
Vec2 pressing(const SystemModel& system, const ContactSegment& segment) {
  if (!(system.friction > 0)) return segment.normal;
  return segment.normal +
         system.friction * segment.sliding.direction * Vec2(-segment.normal.y(), segment.normal.x());
}

}  // namespace

Vec2 bearing_force(const SystemModel& system, const SystemPosition& position, int b,
                   const Eigen::Ref<const VectorXd>& p) {
  Vec2 sum(0, 0);
  if (system.layout.bodies[static_cast<size_t>(b)].kind == System::BodyKind::carrier) {
    for (int planet = 0; planet < static_cast<int>(system.body.size()); ++planet)
      if (system.layout.bodies[static_cast<size_t>(planet)].on == b)
        sum += bearing_force(system, position, planet, p);
    return sum;
  }
  for (const ContactSegment& segment : position.segment)
    if (const int side = system.side_of(b, segment.mesh); side >= 0)
      sum -= closing_sign(side) * p.segment(segment.first_strip, segment.strips).sum() *
             pressing(system, segment);
  return sum;
}

double mesh_deflection(const SystemModel& system, const SystemPosition& position, const SystemEquilibrium& at,
                       int m) {
  const GearMeshModel& mesh = system.mesh[static_cast<size_t>(m)];
  double out = at.transmission_error(system, m);
  for (int s = 0; s < kSides; ++s) {
    const int own = mesh.layout.side[static_cast<size_t>(s)].body;
    for (const int b : {own, system.layout.bodies[static_cast<size_t>(own)].on}) {
      if (b == System::kGround) continue;
      const Bearing& bearing = system.layout.bodies[static_cast<size_t>(b)].bearing;
      if (bearing.elastic())
        out += mesh.outward_in_system(s).dot(bearing_force(system, position, b, at.p)) / bearing.stiffness;
    }
  }
  return out;
}

}  // namespace whine
