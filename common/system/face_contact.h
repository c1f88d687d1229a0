// Contact of one pair at rest in slices along its contact lines: what each point gives way, and the equilibrium of all of them.
//
// Gap, force and line load of a point q are d_q = e_q - a_q x + law_q(F_q) + sum C_qr F_r >= 0, F_q >= 0, d_q F_q = 0 (Eq. 18), with
// sum a_q F_q = T / r_b (Eq. 20), x the transmission error along the transverse line of action and F_q the force along the normal. The
// teeth of each section carry its load by themselves, by the tables of the bodies T (per force on the whole common face b); with
// w_q the weight of a point
//   C_qq = b cos^2 beta_b T(s_q, s_q) / w_q,   law_q: Hertz's line on half-planes of width w_q / cos beta_b, radius R_t / cos beta_b,
// since the transverse part of a normal force is cos beta_b of it, and so is the normal part of a transverse displacement, while near the
// contact the half-planes lie across the inclined line. Neighbouring teeth of the same section take part:
//   C_qr = b cos^2 beta_b integral of l_q l_r T(s, s') dz / (w_q w_r),   q and r on different lines, over the z that both have,
// l_q the polynomials of interpolation on the points of a line. A gear is rigid between its sections: x is common to all of them.
//
// On bodies in three dimensions (width = "body") what the sections do to each other is added to the points of a line, and takes the place of
// C_qr on different lines (solid/width_tables.h):
//   C_qr += sum_ij P_i(z_q) (dC_ij - delta_ij c)(s_q, s_r) P_j(z_r),   C_qq += c(s_q, s_q) / w_q,
// z from the middle of each gear's own face, beyond whose contact a wider gear goes on. The tables T then count with plane_share() in
// place of cos^2 beta_b, as what the tables over the width were taken from.
// The sum of local compliance, tables and this is positive definite where the polynomials are not finer than the contact is wide: degree P
// at most sqrt(b / 2a); its least eigenvalue is part of the result.
#pragma once
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "results/reduced_body.h"
#include "solid/width_tables.h"
#include "system/face_points.h"
#include "system/rolling_mesh.h"

namespace whine {

// All that contact in slices needs at one phase.
struct FacePosition {
  double phase = 0;  // mesh periods
  FacePoints points;
  Eigen::VectorXd gap;                  // (point) m, along the normal
  std::vector<HertzLine> law;           // (point)
  Eigen::MatrixXd compliance;           // (point, point) m N-1
  std::vector<PairContact> contact;     // (point) of the transverse section
  std::array<Eigen::VectorXd, 2> roll;  // [gear] (point) rad: where the tables are read
  double next_corner_gap = 0;           // m, see PairsInReach
  double lost_corner_gap = 0;
};

// The points of one contact line as its body sees them.
struct LineOnBody {
  const FacePoints& points;
  int line;
  const Eigen::Ref<const Eigen::VectorXd> roll;  // (point) rad, of all lines
  int sense = 1;  // of z along the axis that both lines count from the middle of the body
};
// (point of a, point of b) m N-1 m-1, by the rule that both lines have their points of: integral of l_q l_r T(s, s') dz / (w_q w_r) over the z that both lines have; T: m N-1, (flank, flank).
Eigen::MatrixXd between_sections(const FlankTable& table, const LineOnBody& a, const LineOnBody& b,
                                 const Eigen::MatrixXd& between, const GaussRule& rule);

// The body as the spur gear of its transverse section. On bodies in three dimensions it is as wide as the common face (m), and what
// stands beyond it is in the tables over the width.
ReducedBody section_of(const ReducedBody& body, WidthModel width = WidthModel::slices, double common = 0);
// The mesh under a load that is even over the face: without misalignment and lead modifications.
GearMeshSpec even(GearMeshSpec mesh);

class FaceContact {
 public:
  // width: slices or body; points: of each contact line; depth: m, to which the half-planes of the laws go, of motions that of what is not
  // damped; 0: as ElasticGear::contact_depth(). Below it the half-planes down to there are part of the tables' term, with cos beta_b as those
  // of the laws, so that the sum does not depend on it. Throws Error(input) for what slices do not take: friction, teeth that differ, cracks,
  // and helical gears whose bodies are in plane stress; of width = body also for internal gears, bodies in plane stress or without tables
  // over the width.
  FaceContact(const ReducedBody& driver, const ReducedBody& driven, const GearMeshSpec& mesh,
              WidthModel width, int points, double depth = 0);

  const GearPair& gears() const { return gears_; }  // with their helix
  const GaussRule& rule() const { return rule_; }   // of each contact line
  int points() const { return static_cast<int>(rule_.point.size()); }
  double depth() const { return depth_; }  // m
  // Of the polynomials over the face width: the larger one of both gears, 0 of slices.
  int degree() const { return kernel_[0] ? std::max(kernel_[0]->degree(), kernel_[1]->degree()) : 0; }
  // Of gear g, nullptr of slices; m: the middle of the common face from that of gear g.
  const WidthKernel* kernel(size_t g) const { return kernel_[g].get(); }
  double middle(size_t g) const { return middle_[g]; }
  // The same contact with this number of points, and with polynomials to `degree` at most.
  FaceContact with(int points, int degree) const;
  // The spur pair of the transverse section, under even load.
  const GearMeshModel& mesh() const { return section_; }

  // phase: mesh periods; corner_gap: m, of tip edges of spur pairs that are left out as too far; load: N, transverse.
  FacePosition at(double phase, double corner_gap, double load) const;
  // Whether a point lies in the inner 90 % of face and path: in the corners where a line comes in, the load of a line model has no limit.
  bool inside(double path, double z) const;
  double cosine() const { return cosine_; }  // 1: cos beta_b
  // m N-1, of gear g: tables[offset + max] (flank, flank) of the section, see compliance_tables().
  const std::vector<Eigen::MatrixXd>& tables(size_t g) const { return table_[g]; }
  // m: transmission error without load, 0 for flanks as they are designed.
  double unloaded_transmission_error(double phase, double corner_gap) const;

 private:
  std::vector<ContactLine> lines(double phase, double corner_gap, PairsInReach& reach) const;
  PairContact contact(const PairsInReach& reach, const ContactLine& line, double path) const;
  void add_sections(FacePosition& position) const;
  void add_width(FacePosition& position) const;
  GearPair gears_;
  GearMeshModel section_;
  FaceGap gap_;
  std::array<double, 2> middle_;  // m: of the common face from that of each gear
  GaussRule rule_;
  double cosine_, depth_;  // 1: cos beta_b; m: of the laws
  std::array<double, 2>
      shallow_{};  // [gear] m N-1: of the half-plane of the whole face from depth_ to contact_depth()
  std::array<std::vector<Eigen::MatrixXd>, 2> table_;
  std::array<std::shared_ptr<const WidthKernel>, 2> kernel_;  // of width = body
};

}  // namespace whine
