// Cyclic symmetry: a gear of N equal teeth by one sector.
//
// Displacements are written as a sum over harmonics n of u_j = exp(i theta_n j) u_0, theta_n = 2 pi n / N,
// tooth j counted counter-clockwise, vectors turned with their tooth. A sector then obeys u_high = exp(i
// theta_n) Q u_low on its two edges (Q: rotation by one pitch), and the gear falls into N/2 + 1 Hermitian
// problems of the size of one sector: Olson, Shaw, Shi, Pierre and Parker, Applied Mechanics Reviews 66
// (2014) 040803. Nodes at the bore are fixed, those on the outside of a ring unless it is on an elastic support (rim_support.h).
#pragma once
#include "results/sector_grid.h"
#include "solid/elements.h"
#include "solid/factor.h"

namespace whine {

class CyclicSector {
 public:
  // system: of the sector alone, all nodes. Throws Error(input) if the mesh's node sets do not fit together.
  CyclicSector(const SectorGrid& mesh, const PlaneSystem& system);

  int size() const { return size_; }  // complex unknowns of a harmonic
  int teeth() const { return teeth_; }
  int harmonics() const { return teeth_ / 2 + 1; }                // 0 .. N/2 are enough
  bool single(int n) const { return n == 0 || 2 * n == teeth_; }  // modes are not doublets
  double phase(int n) const;                                      // rad: theta_n

  SparseComplex stiffness(int n) const;  // (unknown, unknown) N m-1; the same pattern for every n
  SparseComplex mass(int n) const;       // (unknown, unknown) kg

  // Forces on the nodes of one sector (2 node, k) to right-hand sides (unknown, k), and unknowns back to
  // displacements of the sector's nodes (2 node, k).
  Eigen::MatrixXcd gather(int n, const Eigen::MatrixXd& force) const;
  Eigen::MatrixXcd expand(int n, const Eigen::MatrixXcd& unknown) const;

 private:
  // Sum of a matrix's parts that do not turn with the phase, and of those that turn by exp(i theta).
  struct Parts {
    SparseReal still, turning;
  };
  Parts split(const SparseReal& a) const;
  SparseComplex combine(const Parts& parts, int n) const;

  int teeth_ = 0, size_ = 0;
  Eigen::VectorXi first_;       // (node) first unknown of the node or of its low partner; -1 if fixed
  std::vector<char> high_;      // (node) whether it follows its low partner
  Eigen::Matrix2d pitch_turn_;  // Q
  Parts stiffness_, mass_;
};

// All teeth of a sector mesh, nodes on sector edges merged. Sector node i of tooth j is node(j, i).
struct WholeGear {
  MatrixRM node_position;  // (node, 2) m
  MatrixRMi element_node;  // (element, 4 or 9), tooth by tooth
  MatrixRMi node;          // (tooth, sector node)
};
WholeGear replicate(const SectorGrid& mesh);

}  // namespace whine
