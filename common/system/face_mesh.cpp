#include "system/face_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.h"
#include "model/capabilities.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// (point, point) m N-1: of bodies whose sections all move alike; weights: [gear] (point, flank).
MatrixXd alike(const FaceContact& contact, const FacePoints& points, const std::array<MatrixXd, 2>& weights) {
  const int n = points.per_line, lines = static_cast<int>(points.line.size());
  const double unit = contact.cosine() * contact.cosine();
  const auto own = [&](int line) { return Eigen::seqN(static_cast<Index>(line) * n, n); };
  MatrixXd out = MatrixXd::Zero(points.size(), points.size());
  for (size_t g = 0; g < kSides; ++g) {
    const std::vector<MatrixXd>& tables = contact.tables(g);
    const int most = static_cast<int>(tables.size()) / 2;
    for (int i = 0; i < lines; ++i)
      for (int j = 0; j < lines; ++j) {
        const int offset =
            GearMeshModel::tooth(static_cast<int>(g), points.line[static_cast<size_t>(i)].pair -
                                                          points.line[static_cast<size_t>(j)].pair);
        if (std::abs(offset) > most) continue;
        const int place = offset + most;
        out(own(i), own(j)) += unit * weights[g](own(i), Eigen::all) * tables[static_cast<size_t>(place)] *
                               weights[g](own(j), Eigen::all).transpose();
      }
  }
  return 0.5 * (out + out.transpose());
}

}  // namespace

MeshPosition face_mesh_position(const FaceContact& contact, double phase, double corner_gap, double load) {
  const FacePosition at = contact.at(phase, corner_gap, load);
  const int n = at.points.size();
  MeshPosition out;
  out.phase = phase;
  out.nodes_per_pair = 1;
  out.next_corner_gap = at.next_corner_gap;
  out.lost_corner_gap = at.lost_corner_gap;
  out.transverse = contact.cosine();
  out.gap = at.gap;
  out.law = at.law;
  out.first_strip = {0};
  out.first_strip.reserve(static_cast<size_t>(n) + 1);
  out.pairs.reserve(static_cast<size_t>(n));
  std::array<MatrixXd, 2> weights;
  for (size_t g = 0; g < kSides; ++g) {
    out.strip_lever[g].resize(n);
    weights[g].resize(n, contact.mesh().gear[g].table_size());
  }
  for (int q = 0; q < n; ++q) {
    PairStrips line;
    line.pair = at.points.line[static_cast<size_t>(at.points.line_of(q))].pair;
    line.contact = at.contact[static_cast<size_t>(q)];
    line.gap = VectorXd::Constant(1, at.gap[q]);
    for (size_t g = 0; g < kSides; ++g) {
      out.strip_lever[g][q] = contact.cosine() * line.contact.lever[g];
      weights[g].row(q) = contact.mesh().gear[g].table().weights(at.roll[g][q]);
    }
    out.pairs.push_back(std::move(line));
    out.first_strip.push_back(q + 1);
  }
  out.node_lever = out.strip_lever;
  for (size_t g = 0; g < kSides; ++g) out.table_weights[g] = contact.cosine() * weights[g];
  out.face = std::make_shared<const FaceMesh>(
      FaceMesh{at.points, at.roll, at.compliance - alike(contact, at.points, weights)});
  return out;
}

MatrixXd uneven_between(const SystemModel& system, const SystemPosition& position, size_t read, int read_side,
                        size_t loaded, int loaded_side) {
  const FaceMesh &to = *position.mesh[read].face, &from = *position.mesh[loaded].face;
  const auto r = static_cast<size_t>(read_side), l = static_cast<size_t>(loaded_side);
  const System::Mesh &read_mesh = system.layout.meshes[read], &loaded_mesh = system.layout.meshes[loaded];
  const ElasticGear& gear = *system.body[static_cast<size_t>(read_mesh.side[r].body)];
  const double cosines = position.mesh[read].transverse * position.mesh[loaded].transverse,
               width = std::max(system.mesh[read].face_width(), system.mesh[loaded].face_width());
  const MatrixXd &reading = position.displacement.flank[read][r], &loading = position.load.flank[loaded][l];
  MatrixXd out(to.points.size(), from.points.size());
  const int n = to.points.per_line, m = from.points.per_line;
  const auto tooth = [&](size_t mesh, size_t side, int point) {
    const int strip = position.first_strip[mesh] + point;
    return ToothFlank{position.segment[static_cast<size_t>(strip)].tooth[side],
                      system.layout.meshes[mesh].side[side].flank};
  };
  for (int i = 0; i < static_cast<int>(to.points.line.size()); ++i)
    for (int j = 0; j < static_cast<int>(from.points.line.size()); ++j) {
      const MatrixXd table = gear.compliance(tooth(read, r, i * n), tooth(loaded, l, j * m), 0);
      // A driver turns counter-clockwise where z grows towards the viewer of the system.
      const LineOnBody a{to.points, i, to.roll[r], read_mesh.side[0].sense},
          b{from.points, j, from.roll[l], loaded_mesh.side[0].sense};
      out.block(i * n, j * m, n, m) =
          cosines * width * between_sections(gear.table(), a, b, table, system.face[read]->rule()) -
          reading.middleRows(i * n, n) * table * loading.middleRows(j * m, m).transpose();
    }
  return out;
}

SystemModel sliced_system(const System& layout, const std::vector<ReducedBody>& bodies,
                          const std::vector<GearMeshSpec>& specs, const std::vector<int>& section,
                          WidthModel width, int points, double depth) {
  if (width == WidthModel::body && layout.meshes.size() != 1)
    require_able("width", {{Trait::train_of_bodies, "[fidelity] has width = \"body\""}});
  const auto gear = [&](size_t m, size_t side) -> const ReducedBody& {
    return bodies[static_cast<size_t>(layout.meshes[m].side[side].body)];
  };
  std::vector<std::shared_ptr<const FaceContact>> face;
  std::vector<GearMeshSpec> plane;
  face.reserve(specs.size());
  plane.reserve(specs.size());
  for (size_t m = 0; m < specs.size(); ++m) {
    const auto first = std::find(section.begin(), section.end(), section[m]) - section.begin();
    face.push_back(
        static_cast<size_t>(first) < m
            ? face[static_cast<size_t>(first)]
            : std::make_shared<const FaceContact>(gear(m, 0), gear(m, 1), specs[m], width, points, depth));
    plane.push_back(even(specs[m]));
  }
  std::vector<ReducedBody> sections;
  sections.reserve(bodies.size());
  for (const ReducedBody& body : bodies)
    sections.push_back(section_of(body, width, face[0]->gears().face_width()));
  SystemModel out(layout, sections, plane);
  out.face = std::move(face);
  return out;
}

SystemModel with_points(const SystemModel& system, int points, int degree) {
  SystemModel out = system;
  std::map<const FaceContact*, std::shared_ptr<const FaceContact>> made;
  for (std::shared_ptr<const FaceContact>& own : out.face) {
    std::shared_ptr<const FaceContact>& other = made[own.get()];
    if (!other) other = std::make_shared<const FaceContact>(own->with(points, degree));
    own = other;
  }
  return out;
}

}  // namespace whine
