#include "system/face_mesh.h"

#include <cmath>
#include <utility>

#include "base/error.h"

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
      weights[g].row(q) = contact.mesh().gear[g].table().weights(at.roll[g](q, 0));
    }
    out.pairs.push_back(std::move(line));
    out.first_strip.push_back(q + 1);
  }
  out.node_lever = out.strip_lever;
  for (size_t g = 0; g < kSides; ++g) out.table_weights[g] = contact.cosine() * weights[g];
  out.face = std::make_shared<const FaceMesh>(
      FaceMesh{at.points, at.compliance - alike(contact, at.points, weights)});
  return out;
}

SystemModel sliced_system(const System& layout, const ReducedBody& driver, const ReducedBody& driven,
                          const GearMeshSpec& mesh, WidthModel width, int points, double depth) {
  if (width != WidthModel::slices)
    fail(
        Failure::input, "width = \"", width,
        "\" in [fidelity]: what sections of a body in three dimensions hold each other by has no inertia yet, and motion is computed in "
        "slices; write width = \"slices\"");
  if (layout.meshes.size() != 1)
    fail(Failure::input, "width = \"", width, "\" of ", layout.meshes.size(),
         " meshes: a train in motion has one slice over the face; write width = \"one\" in [fidelity]");
  auto face = std::make_shared<const FaceContact>(driver, driven, mesh, width, points, depth);
  SystemModel out(layout, {section_of(driver), section_of(driven)}, {even(mesh)});
  out.face = {std::move(face)};
  return out;
}

}  // namespace whine
