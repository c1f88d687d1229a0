#include "solid/sector.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/units.h"

namespace whine {

namespace {
using Complex = std::complex<double>;
}  // namespace

CyclicSector::CyclicSector(const SectorGrid& mesh, const PlaneSystem& system) : teeth_(mesh.design.teeth) {
  const Eigen::Index nodes = mesh.node_position.rows();
  if (teeth_ < 3) fail(Failure::input, "cyclic symmetry needs 3 teeth or more, the mesh says ", teeth_);
  if (system.stiffness.rows() != 2 * nodes)
    fail(Failure::input, "sector matrices have ", system.stiffness.rows(), " rows, the mesh has ", nodes,
         " nodes");
  auto checked = [&](int node) {
    if (node < 0 || node >= nodes)
      fail(Failure::input, "node ", node, " of a node set is not among the ", nodes,
           " nodes of the mesh; rebuild it");
    return node;
  };
  first_ = Eigen::VectorXi::Zero(nodes);
  high_.assign(static_cast<size_t>(nodes), 0);
  for (int node : mesh.bore_node) {
    checked(node);
    if (!mesh.design.elastic_rim()) first_[node] = -1;
  }
  for (Eigen::Index i = 0; i < mesh.side_node.rows(); ++i)
    high_[static_cast<size_t>(checked(mesh.side_node(i, 1)))] = 1;
  for (Eigen::Index i = 0; i < nodes; ++i) {
    if (first_[i] < 0 || high_[static_cast<size_t>(i)]) continue;
    first_[i] = size_;
    size_ += 2;
  }
  for (Eigen::Index i = 0; i < mesh.side_node.rows(); ++i) {
    const int low = checked(mesh.side_node(i, 0)), high = mesh.side_node(i, 1);
    if ((first_[low] < 0) != (first_[high] < 0) || high_[static_cast<size_t>(low)])
      fail(Failure::input, "side nodes ", low, " and ", high, " of the mesh do not match; rebuild the mesh");
    first_[high] = first_[low];
  }
  pitch_turn_ = Eigen::Rotation2Dd(2 * kPi / teeth_).toRotationMatrix();
  stiffness_ = split(system.stiffness);
  mass_ = split(system.mass);
}

double CyclicSector::phase(int n) const {
  return 2 * kPi * n / teeth_;
}

CyclicSector::Parts CyclicSector::split(const SparseReal& a) const {
  std::vector<Eigen::Triplet<double>> still, turning;
  // Node blocks: T_row^H A T_column, T = exp(i theta) Q on high nodes and 1 elsewhere.
  for (Eigen::Index column = 0; column < a.outerSize(); ++column) {
    const Eigen::Index column_node = column / 2;
    if (first_[column_node] < 0) continue;
    const bool column_high = high_[static_cast<size_t>(column_node)];
    for (SparseReal::InnerIterator it(a, column); it; ++it) {
      const Eigen::Index row_node = it.row() / 2;
      if (first_[row_node] < 0) continue;
      const bool row_high = high_[static_cast<size_t>(row_node)];
      if (row_high && !column_high) continue;  // the transpose of what turns forward
      auto& list = row_high == column_high ? still : turning;
      for (int r = 0; r < 2; ++r) {
        const double left = row_high ? pitch_turn_(it.row() % 2, r) : (it.row() % 2 == r);
        for (int c = 0; c < 2; ++c) {
          const double right = column_high ? pitch_turn_(column % 2, c) : (column % 2 == c);
          if (left * right != 0)
            list.emplace_back(first_[row_node] + r, first_[column_node] + c, left * it.value() * right);
        }
      }
    }
  }
  Parts parts{SparseReal(size_, size_), SparseReal(size_, size_)};
  parts.still.setFromTriplets(still.begin(), still.end());
  parts.turning.setFromTriplets(turning.begin(), turning.end());
  return parts;
}

SparseComplex CyclicSector::combine(const Parts& parts, int n) const {
  const Complex turn = std::polar(1.0, phase(n));
  const SparseComplex still = parts.still.cast<Complex>(), forward = parts.turning.cast<Complex>();
  const SparseComplex backward = parts.turning.transpose().cast<Complex>();
  SparseComplex sum = still + SparseComplex(turn * forward) + SparseComplex(std::conj(turn) * backward);
  sum.makeCompressed();
  return sum;
}

SparseComplex CyclicSector::stiffness(int n) const {
  return combine(stiffness_, n);
}
SparseComplex CyclicSector::mass(int n) const {
  return combine(mass_, n);
}

Eigen::MatrixXcd CyclicSector::gather(int n, const Eigen::MatrixXd& force) const {
  const Complex back = std::polar(1.0, -phase(n));
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(size_, force.cols());
  for (Eigen::Index i = 0; i < first_.size(); ++i) {
    if (first_[i] < 0) continue;
    if (high_[static_cast<size_t>(i)])
      result.middleRows(first_[i], 2) +=
          back * (pitch_turn_.transpose() * force.middleRows(2 * i, 2)).cast<Complex>();
    else
      result.middleRows(first_[i], 2) += force.middleRows(2 * i, 2).cast<Complex>();
  }
  return result;
}

Eigen::MatrixXcd CyclicSector::expand(int n, const Eigen::MatrixXcd& unknown) const {
  const Complex turn = std::polar(1.0, phase(n));
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(2 * first_.size(), unknown.cols());
  for (Eigen::Index i = 0; i < first_.size(); ++i) {
    if (first_[i] < 0) continue;
    if (high_[static_cast<size_t>(i)])
      result.middleRows(2 * i, 2) = turn * (pitch_turn_.cast<Complex>() * unknown.middleRows(first_[i], 2));
    else
      result.middleRows(2 * i, 2) = unknown.middleRows(first_[i], 2);
  }
  return result;
}

WholeGear replicate(const SectorGrid& mesh) {
  const Eigen::Index nodes = mesh.node_position.rows(), elements = mesh.element_node.rows();
  const int teeth = mesh.design.teeth;
  std::vector<int> partner(static_cast<size_t>(nodes), -1);  // of a high node
  for (Eigen::Index i = 0; i < mesh.side_node.rows(); ++i)
    partner[static_cast<size_t>(mesh.side_node(i, 1))] = mesh.side_node(i, 0);

  WholeGear gear;
  gear.node.resize(teeth, nodes);
  int count = 0;
  for (int j = 0; j < teeth; ++j)
    for (Eigen::Index i = 0; i < nodes; ++i)
      if (partner[static_cast<size_t>(i)] < 0) gear.node(j, i) = count++;
  for (int j = 0; j < teeth; ++j)
    for (Eigen::Index i = 0; i < nodes; ++i)
      if (const int low = partner[static_cast<size_t>(i)]; low >= 0)
        gear.node(j, i) = gear.node((j + 1) % teeth, low);

  gear.node_position.resize(count, 2);
  gear.element_node.resize(teeth * elements, mesh.element_node.cols());
  for (int j = 0; j < teeth; ++j) {
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(2 * kPi * j / teeth).toRotationMatrix();
    for (Eigen::Index i = 0; i < nodes; ++i)
      if (partner[static_cast<size_t>(i)] < 0)
        gear.node_position.row(gear.node(j, i)) = turn * mesh.node_position.row(i).transpose();
    for (Eigen::Index e = 0; e < elements; ++e)
      for (Eigen::Index k = 0; k < mesh.element_node.cols(); ++k)
        gear.element_node(j * elements + e, k) = gear.node(j, mesh.element_node(e, k));
  }
  return gear;
}

}  // namespace whine
