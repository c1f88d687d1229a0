// Coupling over the face width from the tables of a body: interpolation along the flank, and completion beyond the degree.
//
// The inward displacement of the flank under the line load q on the same tooth is
//   u(xi, z) = plane tables and half-plane, slice by slice + sum_ij P_i(z) dC_ij(xi, xi') q_j
//              + c(xi, xi') (q(z) - sum_j P_j(z) q_j),     q_j = integral of P_j q,
// c = (dC_PP + dC_P-1,P-1) / 2: what of q lies above degree P is not to be left to the tooth of each slice alone, which would
// be 2.5 to 6 times too soft. The plane tables are those of the transverse section in plane strain (m N-1 times their face
// width: m2 N-1), of a helical gear times plane_share() of both points. Neighbouring teeth have C_ij itself, without a plane table and
// without completion.
#pragma once
#include "results/width_tables.h"
#include "solid/flank_table.h"

namespace whine {

// (point) 1: cos beta at the roll angles xi (rad), tan beta = helix r, r = base_radius sqrt(1 + xi^2). A force on a unit of face width lies along so
// much more of the helix, so the flexibility beside it, and in it the logarithm of the distance, is cos beta times that of the transverse
// section in plane strain. Between two points: the geometric mean. 1 of a spur gear.
Eigen::VectorXd plane_share(double base_radius, double helix, const Eigen::VectorXd& xi);

// Largest degree under a contact of this half-width (m) on a face of this width (m): P <= sqrt(b / (2 a)). The last of P + 1 Gauss points
// is 1.4 b / (P + 1)^2 from the end of the face; where that comes near a, local compliance, tables and completion have no positive
// definite sum.
int degree_of_contact(double face_width, double half_width);

// The tables of the polynomials 0 .. degree alone; `degree` at most that of the tables.
WidthTables cut_to_degree(const WidthTables& tables, int degree);

class WidthKernel {
 public:
  // Throws Error(input) where the tables are not of this tooth.
  WidthKernel(const ToothGeometry& tooth, WidthTables tables);

  int degree() const { return tables_.degree; }
  const WidthTables& tables() const { return tables_; }
  // Largest |tooth_offset| of the tables.
  int offsets() const { return static_cast<int>(tables_.flexibility.size()) - 1; }

  // (P + 1, P + 1) m2 N-1: of reading i at roll angle xi_read under load j at xi_load (rad), on the tooth `tooth_offset` counter-clockwise
  // of the loaded one: dC_ij for 0, C_ij for neighbours. Throws Error(input) beyond offsets().
  Eigen::MatrixXd coupling(double xi_read, double xi_load, int tooth_offset) const;
  // m2 N-1: c at two roll angles of the same tooth.
  double completion(double xi_read, double xi_load) const;

  // (root degree + 1, flank degree + 1) Pa m N-1: stress at the root of the tooth `tooth_offset` counter-clockwise of the loaded one.
  const MatrixRM& root_stress(int tooth_offset) const {
    const int place = tooth_offset + offsets();
    return tables_.root_stress[static_cast<size_t>(place)];
  }

  // (flank degree + 1) m^-1/2: load on or reading of the point (xi, z) as functional of the tables, z in m.
  Eigen::VectorXd point(double xi, double z) const;
  // m N-1: displacement of the points of `read` on the tooth `tooth_offset` counter-clockwise under unit forces at those of `load` (columns:
  // point()), read^T C load. Offset 0: of dC_ij - delta_ij c, to which completion(xi, xi) times the force per face width of a point itself
  // has to be added.
  Eigen::MatrixXd between(const Eigen::MatrixXd& read, const Eigen::MatrixXd& load, int tooth_offset) const;

 private:
  WidthTables tables_;
  FlankTable flank_;
  MatrixRM completion_;  // (flank, flank) m2 N-1
  MatrixRM completed_;   // (flank degree + 1, flank degree + 1) m2 N-1: dC_ij - delta_ij c
};

}  // namespace whine
