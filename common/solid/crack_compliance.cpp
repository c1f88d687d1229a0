// What a crack adds to the flexibility of a gear and to the stress of its roots: the cracked tooth among intact ones.
#include "solid/crack.h"

#include <Eigen/Geometry>
#include <complex>
#include <numbers>
#include <vector>

#include "base/dense.h"
#include "base/error.h"
#include "solid/elements.h"
#include "solid/factor.h"
#include "solid/root_stress.h"

namespace whine {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Complex = std::complex<double>;

// One sector with all its nodes but those of its two edges eliminated. Unknowns: nodes of the clockwise edge in the frame
// of the sector's tooth, then nodes of the other edge in the frame of the next tooth; bore nodes are fixed.
struct Condensed {
  MatrixXd stiffness;   // (edge unknown, edge unknown) N m-1
  MatrixXd force;       // (edge unknown, load) 1
  MatrixXd reading;     // (point, edge unknown) 1: outward displacement by the edges
  MatrixXd own;         // (point, load) m N-1: outward displacement with the edges held
  MatrixRM subtracted;  // (point, load) m N-1, see FlankLoads
  MatrixXd root;        // (root, edge unknown) Pa m-1: stress along the driving flank's root by the edges
  MatrixXd own_root;    // (root, load) Pa N-1: the same with the edges held, near field included
  Index edge = 0;       // unknowns of one edge
};

// Displacements of a sector by what becomes of them; those of bore nodes are neither.
struct Unknowns {
  explicit Unknowns(const SectorGrid& mesh);
  static constexpr int kNone = -1;
  std::vector<int> edge, inner;     // (2 node): number of the unknown, or kNone
  int of_one_edge = 0, inside = 0;  // how many
};

Unknowns::Unknowns(const SectorGrid& mesh)
    : edge(2 * static_cast<size_t>(mesh.node_position.rows()), kNone), inner(edge) {
  std::vector<char> held(edge.size() / 2, 0);
  for (int node : mesh.bore_node) held[static_cast<size_t>(node)] = 1;
  for (Index i = 0; i < mesh.side_node.rows(); ++i)
    if (!held[static_cast<size_t>(mesh.side_node(i, 0))]) of_one_edge += 2;
  int at = 0;
  for (Index i = 0; i < mesh.side_node.rows(); ++i) {
    const int low = mesh.side_node(i, 0), high = mesh.side_node(i, 1);
    if (held[static_cast<size_t>(low)]) continue;
    held[static_cast<size_t>(low)] = held[static_cast<size_t>(high)] = 1;
    for (int c = 0; c < 2; ++c) {
      edge[2 * static_cast<size_t>(low) + static_cast<size_t>(c)] = at + c;
      edge[2 * static_cast<size_t>(high) + static_cast<size_t>(c)] = of_one_edge + at + c;
    }
    at += 2;
  }
  for (size_t i = 0; i < inner.size(); ++i)
    if (!held[i / 2]) inner[i] = inside++;
}

Condensed condense(const SectorGrid& mesh, const Material& material, const Eigen::VectorXd& xi,
                   const std::string& what) {
  const SparseReal stiffness =
      assemble(mesh.node_position, mesh.element_node, material, mesh.design.face_width).stiffness;
  const FlankLoads loads = make_flank_loads(mesh, material, xi);
  const RootReader roots(mesh, material, Roots::driving);
  // Displacements at the flank, then stress along the root.
  const MatrixXd outward = FlankReader(mesh).outward(xi), stress = roots.stress();
  MatrixXd reading(outward.rows() + stress.rows(), outward.cols());
  reading << outward, stress;

  const Unknowns number(mesh);
  const std::vector<int>&edge_unknown = number.edge, &inner = number.inner;
  const Index size = stiffness.rows(), edge = number.of_one_edge, inner_size = number.inside;
  const Index points = xi.size(), unknowns = 2 * edge;
  std::vector<Eigen::Triplet<Complex>> entries;
  MatrixXd right = MatrixXd::Zero(inner_size, unknowns + points),
           edge_force = MatrixXd::Zero(unknowns, points),
           inner_reading = MatrixXd::Zero(reading.rows(), inner_size),
           edge_reading = MatrixXd::Zero(reading.rows(), unknowns),
           edge_stiffness = MatrixXd::Zero(unknowns, unknowns);
  for (Index column = 0; column < size; ++column)
    for (SparseReal::InnerIterator it(stiffness, column); it; ++it) {
      const int row_inner = inner[static_cast<size_t>(it.row())],
                column_inner = inner[static_cast<size_t>(column)],
                row_edge = edge_unknown[static_cast<size_t>(it.row())],
                column_edge = edge_unknown[static_cast<size_t>(column)];
      if (row_inner >= 0 && column_inner >= 0) entries.emplace_back(row_inner, column_inner, it.value());
      if (row_inner >= 0 && column_edge >= 0) right(row_inner, column_edge) = it.value();
      if (row_edge >= 0 && column_edge >= 0) edge_stiffness(row_edge, column_edge) = it.value();
    }
  for (Index i = 0; i < size; ++i) {
    if (const int k = inner[static_cast<size_t>(i)]; k >= 0) {
      right.row(k).tail(points) = loads.force.row(i);
      inner_reading.col(k) = reading.col(i);
    }
    if (const int k = edge_unknown[static_cast<size_t>(i)]; k >= 0) {
      edge_force.row(k) = loads.force.row(i);
      edge_reading.col(k) = reading.col(i);
    }
  }
  SparseComplex inside(inner_size, inner_size);
  inside.setFromTriplets(entries.begin(), entries.end());
  HermitianFactor factor(inside);
  factor.factorise(inside, what);
  const MatrixXd solution = factor.solve(right.cast<Complex>()).real();
  const auto by_edge = solution.leftCols(unknowns), by_load = solution.rightCols(points);
  const auto coupling = right.leftCols(unknowns);

  Condensed out;
  out.edge = edge;
  out.stiffness = edge_stiffness - coupling.transpose() * by_edge;
  out.force = edge_force - coupling.transpose() * by_load;
  const MatrixXd read_by_edge = edge_reading - inner_reading * by_edge,
                 read_by_load = inner_reading * by_load;
  out.reading = read_by_edge.topRows(points);
  out.own = read_by_load.topRows(points);
  out.root = read_by_edge.bottomRows(stress.rows());
  out.own_root = read_by_load.bottomRows(stress.rows()) + roots.near_field(loads, xi);
  out.subtracted = loads.subtracted;
  const Eigen::Matrix2d turn =
      Eigen::Rotation2Dd(2 * std::numbers::pi / mesh.design.teeth).toRotationMatrix();
  for (Index k = edge; k < unknowns; k += 2) {
    out.stiffness.middleRows(k, 2) = (turn.transpose() * out.stiffness.middleRows(k, 2)).eval();
    out.stiffness.middleCols(k, 2) = (out.stiffness.middleCols(k, 2) * turn).eval();
    out.force.middleRows(k, 2) = (turn.transpose() * out.force.middleRows(k, 2)).eval();
    out.reading.middleCols(k, 2) = (out.reading.middleCols(k, 2) * turn).eval();
    out.root.middleCols(k, 2) = (out.root.middleCols(k, 2) * turn).eval();
  }
  return out;
}

TeethTables assemble_teeth(const Condensed& plain, const Condensed& special, int teeth, int reach) {
  const Index edge = plain.edge, size = edge * teeth, points = plain.own.rows();
  const int window = 2 * reach + 1;
  if (window > teeth)
    fail(Failure::input, "compliance between ", window, " teeth of a gear that has ", teeth);
  if (special.edge != edge) fail(Failure::input, "the sector edges of the two meshes do not match");
  const auto of = [&](int tooth) -> const Condensed& { return tooth == 0 ? special : plain; };
  const auto wrapped = [teeth](int k) { return (k % teeth + teeth) % teeth; };
  // Unknowns of edge k stand between the teeth k - 1 and k.
  std::vector<Eigen::Triplet<Complex>> entries;
  for (int tooth = 0; tooth < teeth; ++tooth) {
    const Index place[2] = {edge * tooth, edge * wrapped(tooth + 1)};
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        for (Index i = 0; i < edge; ++i)
          for (Index j = 0; j < edge; ++j)
            entries.emplace_back(place[a] + i, place[b] + j, of(tooth).stiffness(a * edge + i, b * edge + j));
  }
  SparseComplex whole(size, size);
  whole.setFromTriplets(entries.begin(), entries.end());
  whole = (0.5 * (whole + SparseComplex(whole.adjoint()))).eval();
  whole.makeCompressed();
  Eigen::MatrixXcd right = Eigen::MatrixXcd::Zero(size, window * points);
  for (int j = -reach; j <= reach; ++j) {
    auto columns = right.middleCols((j + reach) * points, points);
    columns.middleRows(edge * wrapped(j), edge) += of(j).force.topRows(edge).cast<Complex>();
    columns.middleRows(edge * wrapped(j + 1), edge) += of(j).force.bottomRows(edge).cast<Complex>();
  }
  HermitianFactor factor(whole);
  factor.factorise(whole, text("the stiffness of ", teeth, " teeth at their sector edges"));
  const MatrixXd solution = factor.solve(right).real();
  const Index root = plain.root.rows();
  TeethTables out{MatrixRM(window * points, window * points), MatrixRM(window * root, window * points)};
  for (int i = -reach; i <= reach; ++i) {
    const Condensed& tooth = of(i);
    const Index at = i + reach;
    const auto by_edges = [&](const MatrixXd& read) -> MatrixXd {
      return read.leftCols(edge) * solution.middleRows(edge * wrapped(i), edge) +
             read.rightCols(edge) * solution.middleRows(edge * wrapped(i + 1), edge);
    };
    out.compliance.middleRows(at * points, points) = -by_edges(tooth.reading);
    out.compliance.block(at * points, at * points, points, points) += tooth.subtracted - tooth.own;
    out.root_stress.middleRows(at * root, root) = by_edges(tooth.root);
    out.root_stress.block(at * root, at * points, root, points) += tooth.own_root;
  }
  out.compliance = (0.5 * (out.compliance + out.compliance.transpose())).eval();
  return out;
}

}  // namespace

TeethTables teeth_tables(const SectorGrid& sector, const SectorGrid& special, const Material& material,
                         const Eigen::VectorXd& xi, int reach) {
  return assemble_teeth(condense(sector, material, xi, "an intact sector"),
                        condense(special, material, xi, "the sector of tooth 0"), sector.design.teeth, reach);
}

TeethTables crack_tables(const SectorGrid& sector, const Material& material, const Eigen::VectorXd& xi,
                         int reach) {
  if (sector.cracked_tooth.size() != 1) fail(Failure::input, "the mesh has no cracked tooth");
  const SectorGrid& open = sector.cracked_tooth[0];
  const Condensed plain = condense(sector, material, xi, "an intact sector");
  const int teeth = sector.design.teeth;
  TeethTables share =
      assemble_teeth(plain, condense(open, material, xi, "the sector with the crack"), teeth, reach);
  const TeethTables closed = assemble_teeth(
      plain, condense(close_slit(open), material, xi, "the sector with its crack closed"), teeth, reach);
  share.compliance -= closed.compliance;
  share.root_stress -= closed.root_stress;
  const double largest = share.compliance.cwiseAbs().maxCoeff();
  const SymmetricEigen eigen = symmetric_eigenvalues(MatrixXd(share.compliance));
  // Flanks are loaded through the elements' edges and read at points: 1e-4 of the largest at 0.8 mm, 1e-6 at 0.4 mm.
  if (!(eigen.values[0] >= -1e-3 * largest))
    fail(Failure::numerical,
         "what the crack adds to the compliance is not positive semidefinite: least eigenvalue ",
         eigen.values[0], " m/N, largest entry ", largest, " m/N; lower element_mm");
  return share;
}

}  // namespace whine
