#include "system/system.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "gear/layout.h"
#include "gear/train.h"
#include "system/face_mesh.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SystemModel::SystemModel(const ReducedBody& driver, const ReducedBody& driven, const GearMeshSpec& spec)
    : layout(pair_system(spec, driver.design, driven.design)) {
  for (const ReducedBody* of : {&driver, &driven})
    body.push_back(std::make_shared<const ElasticGear>(*of, spec.contact_plane));
  mesh.emplace_back(SideGears(body[0], body[1]), spec, layout.meshes[0]);
}

SystemModel::SystemModel(const System& of, const std::vector<ReducedBody>& bodies,
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
  for (const ReducedBody& artifact : bodies)
    body.push_back(std::make_shared<const ElasticGear>(artifact, specs[0].contact_plane));
  for (size_t m = 0; m < specs.size(); ++m) {
    const System::Mesh& placed = layout.meshes[m];
    GearMeshSpec spec = specs[m];
    for (size_t s = 0; s < kSides; ++s) {
      const int b = placed.side[s].body;
      spec.bearing[s] = layout.bodies[static_cast<size_t>(b)].bearing;
    }
    mesh.emplace_back(SideGears(body[static_cast<size_t>(placed.side[0].body)],
                                body[static_cast<size_t>(placed.side[1].body)]),
                      spec, placed);
    for (int s = 0; s < kSides; ++s) mesh.back().opens_crack[static_cast<size_t>(s)] = opens_crack(placed, s);
  }
}

// The crack of a gear of several meshes is beside the flank that works in the first of them.
bool SystemModel::opens_crack(const System::Mesh& of, int side) const {
  const System::Side& own = of.side[static_cast<size_t>(side)];
  for (const System::Mesh& first : layout.meshes)
    for (const System::Side& other : first.side)
      if (other.body == own.body) return other.flank == own.flank;
  return true;
}

bool SystemModel::cracked() const {
  return std::any_of(mesh.begin(), mesh.end(),
                     [](const GearMeshModel& of) { return of.cracked(0) || of.cracked(1); });
}

double SystemModel::base_radius(int b) const {
  if (const System::Body& of = layout.bodies[static_cast<size_t>(b)]; of.kind == System::BodyKind::carrier)
    return of.radius;
  for (const GearMeshModel& of : mesh)
    for (int s = 0; s < kSides; ++s)
      if (of.layout.side[static_cast<size_t>(s)].body == b) return of.kinematics.gear(s).base_radius();
  fail(Failure::input, "[gear.", layout.bodies[static_cast<size_t>(b)].name, "] is in no mesh");
}

bool SystemModel::floats(int b) const {
  constexpr double kSoft = 1e-3,
                   kTooth = 8;  // of the stiffness of a tooth; its compliance over the half-plane's C
  const Bearing& bearing = layout.bodies[static_cast<size_t>(b)].bearing;
  if (!bearing.elastic() || mesh.size() == 1) return false;
  const ElasticGear& gear = *body[std::min(static_cast<size_t>(b), body.size() - 1)];
  return bearing.stiffness * kTooth * gear.half_plane().coefficient() < kSoft;
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
  teeth.reserve(2 * kSides * system.mesh.size());
  for (const GearMeshModel& mesh : system.mesh)
    for (int g = 0; g < kSides; ++g) {
      teeth.push_back(mesh.deviation[static_cast<size_t>(g)].repeats());
      if (mesh.cracked(g)) teeth.push_back(mesh.kinematics.gear(g).design().teeth);
    }
  return hunting_periods_of(teeth);
}

bool add_cracks(const SystemModel& system, const SystemPosition& position, int period, MatrixXd& a) {
  bool adds = false;
  for (size_t m = 0; m < system.mesh.size(); ++m) {
    const MatrixXd at_nodes =
        crack_compliance(system.mesh[m], position.mesh[m],
                         mesh_instant(system, static_cast<int>(m), position.phase, period).period);
    if (at_nodes.size() == 0) continue;
    adds = true;
    const auto own = position.strips_of(m);
    MatrixXd block = a(own, own);
    position.mesh[m].add_to_strips(at_nodes, block);
    a(own, own) = block;
  }
  return adds;
}

// The frame of a mesh may be the mirror image of that of the system.
Vec2 across(const SystemModel& system, const ContactSegment& segment) {
  const int mirrored = system.mesh[static_cast<size_t>(segment.mesh)].layout.side[0].sense;
  return mirrored * Vec2(-segment.normal.y(), segment.normal.x());
}

namespace {

double share_of_friction(const SystemModel& system, const ContactSegment& segment) {
  return system.friction[static_cast<size_t>(segment.mesh)] * segment.sliding.direction;
}

// L = D + mu s T: moments about the axes and forces across the normal, of a planet's on its carrier, too.
void add_friction(const SystemModel& system, SystemPosition& position) {
  for (const ContactSegment& segment : position.segment) {
    const GearMeshModel& model = system.mesh[static_cast<size_t>(segment.mesh)];
    const double share = share_of_friction(system, segment);
    const auto own = Eigen::seqN(segment.first_strip, segment.strips);
    const Vec2 tau = across(system, segment);
    for (int s = 0; s < kSides; ++s) {
      const auto side = static_cast<size_t>(s);
      const int b = model.layout.side[side].body;
      position.load.rotation.col(b)(own).array() +=
          closing_sign(s) * share * segment.sliding.lever[side] / model.kinematics.gear(s).base_radius();
      const auto push = [&](MatrixXd& rows) {
        if (rows.size() > 0) rows(own, Eigen::all).rowwise() += closing_sign(s) * share * tau.transpose();
      };
      push(position.load.translation[static_cast<size_t>(b)]);
      const System::Body& body = system.layout.bodies[static_cast<size_t>(b)];
      if (body.on == System::kGround) continue;
      push(position.load.translation[static_cast<size_t>(body.on)]);
      position.load.rotation.col(body.on)(own).array() +=
          closing_sign(s) * share * tau.dot(pin_direction(system.layout, body));
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
      if (j > 0 && position.face && out.segment.back().pair == strips.pair)
        segment.slice = out.segment.back().slice + 1;
      for (size_t s = 0; s < kSides; ++s)
        segment.tooth[s] = model.layout.side[s].tooth(strips.pair - at.period);
      segment.phase = at.phase + strips.pair;
      segment.gap = strips.contact.gap;
      segment.normal = position.transverse * model.outward_in_system(0, strips.contact);
      segment.lever = strips.contact.lever;
      if (model.friction.acts())
        segment.sliding = sliding_of(model.kinematics, strips.contact, model.friction.smoothing);
      segment.width = position.face
                          ? position.face->points.weight[static_cast<Index>(j)] / position.transverse
                          : model.face_width();
      segment.first_strip = first + position.first_strip[j];
      segment.strips = position.first_strip[j + 1] - position.first_strip[j];
      for (int s = 0; s < kSides; ++s) {
        const auto b = static_cast<size_t>(model.layout.side[static_cast<size_t>(s)].body);
        // A position error closes the gaps as a motion of the hub does.
        out.gap.segment(segment.first_strip, segment.strips).array() -=
            closing_sign(s) * segment.normal.dot(offset_of(system.layout.bodies[b]));
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
  if (system.slides()) add_friction(system, out);
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
  // Far from either contact: the body in its whole width.
  const ElasticGear& gear = *system.body[static_cast<size_t>(system.layout.meshes[read].side[side_r].body)];
  const FlankSide flank_r = system.layout.meshes[read].side[side_r].flank,
                  flank_l = system.layout.meshes[loaded].side[side_l].flank;
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
      const MatrixXd table =
          gear.compliance({rows[i]->tooth[side_r], flank_r}, {columns[j]->tooth[side_l], flank_l}, 0);
      const MatrixXd nodes =
          reading(to.nodes_of(i), Eigen::all) * table * loading(from.nodes_of(j), Eigen::all).transpose();
      out.block(to.first_strip[i], from.first_strip[j], rows[i]->strips, columns[j]->strips) =
          onto(to, i) * nodes * onto(from, j).transpose();
    }
  return out;
}

// add(m, side in m, n, side in n) of each two meshes that share a body.
template <class Add>
void for_each_shared(const SystemModel& system, const Add& add) {
  for (int b = 0; b < static_cast<int>(system.body.size()); ++b)
    for (size_t m = 0; m < system.mesh.size(); ++m)
      for (size_t n = 0; n < system.mesh.size(); ++n) {
        const int read = system.side_of(b, static_cast<int>(m)),
                  loaded = system.side_of(b, static_cast<int>(n));
        if (m != n && read >= 0 && loaded >= 0) add(m, read, n, loaded);
      }
}

}  // namespace

void add_uneven_between(const SystemModel& system, const SystemPosition& position, MatrixXd& a) {
  for_each_shared(system, [&](size_t m, int read, size_t n, int loaded) {
    a(position.strips_of(m), position.strips_of(n)) += uneven_between(system, position, m, read, n, loaded);
  });
}

MatrixXd contact_compliance(const SystemModel& system, const SystemPosition& position,
                            const SystemTables& tables, std::span<const double> depth) {
  MatrixXd a = MatrixXd::Zero(position.strips(), position.strips());
  for (size_t m = 0; m < position.mesh.size(); ++m) {
    const MeshPosition& mesh = position.mesh[m];
    MatrixXd own = contact_compliance(system.mesh[m], mesh, tables[m], depth[m]);
    if (mesh.face) own += mesh.face->uneven;
    a(position.strips_of(m), position.strips_of(m)) = own;
  }
  for_each_shared(system, [&](size_t m, int read, size_t n, int loaded) {
    a(position.strips_of(m), position.strips_of(n)) += between_meshes(system, position, m, read, n, loaded);
  });
  if (!system.face.empty()) add_uneven_between(system, position, a);
  for (size_t b = 0; b < system.layout.bodies.size(); ++b)
    if (const Bearing& bearing = system.layout.bodies[b].bearing;
        bearing.elastic() && !system.floats(static_cast<int>(b)))
      a += position.displacement.translation[b] * position.displacement.translation[b].transpose() /
           bearing.stiffness;
  return a;
}

MatrixXd friction_compliance(const SystemModel& system, const SystemPosition& position) {
  MatrixXd out;
  for (size_t b = 0; system.slides() && b < system.layout.bodies.size(); ++b) {
    const Bearing& bearing = system.layout.bodies[b].bearing;
    if (!bearing.elastic() || system.floats(static_cast<int>(b))) continue;
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

// From the first side's flank to the second's: the direction of a contact's force per normal force, friction included.
Vec2 pressing(const SystemModel& system, const ContactSegment& segment) {
  if (!system.slides()) return segment.normal;
  return segment.normal + share_of_friction(system, segment) * across(system, segment);
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
    out += mesh.outward_in_system(s).dot(offset_of(system.layout.bodies[static_cast<size_t>(own)]));
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
