// Gauss points along the contact lines of a pair, and what they say of the load over the face.
//
// Each tooth pair has n points z_q of Gauss and Legendre on its contact line, clipped at the tips and at the ends of the face
// (gear/contact_lines.h), of weights w_q: the length of face that a point stands for. As a pair comes in or leaves, its points move with
// the ends of its line and their weights go to 0, so that no force steps. A point has the gap along the flanks' normal and the approach
//   e_q = lead modifications + misalignment z_q / b,   a_q = cos beta_b,
// by which the flanks come nearer to each other per motion along the transverse line of action.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "gear/contact_lines.h"
#include "model/scene.h"
#include "solid/elements.h"

namespace whine {

// n of a scene that leaves face_points open: alike of all its meshes.
int face_points_of(const std::vector<GearMeshSpec>& meshes, const ContactDiscretisation& contact);
inline int face_points_of(const GearMeshSpec& mesh, const ContactDiscretisation& contact) {
  return face_points_of(std::vector{mesh}, contact);
}

// Lead modifications of both gears and misalignment.
class FaceGap {
 public:
  FaceGap(const GearPair& pair, const GearMeshSpec& mesh);
  // m; z: from the middle of the common face.
  double at(double z) const { return lead_[0].at(z + middle_[0]) + lead_[1].at(z + middle_[1]) + slope_ * z; }
  bool none() const { return none_; }

 private:
  std::array<LeadDeviation, 2> lead_;
  std::array<double, 2> middle_;  // m: contact_middle()
  double slope_ = 0;
  bool none_ = true;
};

struct FacePoints {
  std::vector<ContactLine> line;
  int per_line = 0;           // points of a line, in a row, in the order of z
  Eigen::VectorXd z, weight;  // (point) m
  Eigen::VectorXd path;       // (point) m, from the pitch point
  Eigen::VectorXd gap;        // (point) m, along the normal, of what depends on z alone

  int size() const { return static_cast<int>(z.size()); }
  int line_of(int point) const { return point / per_line; }
};

// The points of these lines, those of the rule on each. phase: mesh periods.
FacePoints face_points(const GearPair& pair, const FaceGap& gap, const std::vector<ContactLine>& lines,
                       double phase, const GaussRule& rule);

// 1 (point of `line`, a): value at z of the polynomial that is 1 at the point a of the line and 0 at its others.
Eigen::RowVectorXd interpolation(const FacePoints& points, int line, double z);

// Of bodies in three dimensions K_Hbeta is read from this part of the line: at the very end of a face the load of teeth in three
// dimensions falls off, which no polynomial holds.
inline constexpr double kInnerFace = 0.8;

// K_Hbeta = w_max / w_mean of the loads w (N m-1) at points z (m, ascending) with these weights: the largest of the points in the inner part
// `inner` of the line and of both ends of the line. To these leads a parabola through the three outermost points of the whole line; of an
// inner part, where polynomials of the body ripple by a per cent, which three points carry to the end five to ten times as large, the
// cubic of least squares through all its points with load.
double face_load_factor(const Eigen::Ref<const Eigen::VectorXd>& z,
                        const Eigen::Ref<const Eigen::VectorXd>& weight,
                        const Eigen::Ref<const Eigen::VectorXd>& load, const ContactLine& line,
                        double inner = 1);

}  // namespace whine
