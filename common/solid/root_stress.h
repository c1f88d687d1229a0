// Stress at the roots of the teeth under unit forces on the flanks.
//
// A root surface carries no load, so that of its stress only the tangential part is not zero. With e_t the strain along it
//   sigma_t = E' e_t,   e_t = t . du/ds,   E' = E in plane stress, E / (1 - nu^2) in plane strain.
// The strain is that of the sides of the elements, taken where it is best: at the Gauss points of the side, two for sides of
// three nodes, one for sides of two (Barlow, Int. J. Numer. Methods Eng. 10 (1976) 243), and fitted by least squares with
// polynomials of degree 8 or less along the root: that evens out what elements at the corner of three blocks, in the middle of
// the fillet, are off by (6 % beside it with elements of 0.8 mm at a module of 3 mm, with changing sign).
//
// Over the face width of a prism that turns with z by helix z, the free surface has two tangents: t along the root and h along the helix,
// (-helix y, helix x, 1) in turned axes. Read is the stress across the helix, along p = t less its part along h, that of a spur gear along t:
//   sigma_p = E' (e_p + nu e_h),   e_p = p . grad u . p,   e_h = h . grad u . h.
//
// In a loaded tooth with the near field subtracted the nodes hold w = u - u_hs (solid/flank_loads.h). What u_hs adds is in closed
// form, with s_n and s_t its stresses normal to and along the root: sigma_t = E' e_t(w) + s_t - nu / (1 - nu) s_n (moduli of plane
// strain).
#pragma once
#include <vector>

#include "solid/flank_loads.h"

namespace whine {

// Points on a root from the flank to the middle of the space, as many on the other side of the tooth. They are spaced evenly in the
// mean of arc length and turn of the tangent, each over its whole, so that a sharp fillet has enough of them.
constexpr int kRootPoints = 24;

struct RootPoints {
  Eigen::VectorXd parameter;   // (root) 1: t of ToothGeometry::root_point
  Eigen::VectorXd arc_length;  // (root) m from the flank
  Eigen::VectorXd
      angle;  // (root) rad: of the tangent against the centre line of the tooth; grows from the flank on
  double length = 0;  // m: of the whole root curve
  // 0 to 1: the mean of arc length and turn at the arc length s (m); points are at (k + 0.5) / points.
  double place(double s) const;
  std::vector<double> lengths, places;  // m, 1: of the root curve in small steps
};
RootPoints root_points(const ToothGeometry& tooth, int points = kRootPoints);

// m: least radius of curvature of the root curve, over steps of 1 % of its parameter.
double least_root_radius(const ToothGeometry& tooth);

// Which roots of a tooth are read: a mesh with a slit in one of them is not its own mirror image.
enum class Roots { both, driving };

// Reading of the stress along the roots of a tooth sector: rows are the points of the driving flank's side, then those of the
// other side if both are read. Where a slit opens in the root, the two sides of its mouth are fitted apart, and vanish there: a corner between two
// free surfaces that is less than straight has no stress. What vanishes is the whole stress: there the half-plane is read from the
// nodes as well.
class RootReader {
 public:
  // Throws Error(input) for a mesh whose free boundary is not that of a tooth or, of both roots, that is not its own mirror image.
  RootReader(const SectorGrid& mesh, const Material& material, Roots roots = Roots::both,
             int points = kRootPoints);
  // (root, 2 node) Pa m-1: of displacements of the nodes.
  const SparseReal& stress() const { return stress_; }
  // The same over the face width, of the driving root of a sector whose sections turn by helix (rad m-1) in elements without half-planes:
  // (3 node, root) Pa m-1 and Pa. The material in plane strain.
  FaceFunctional over_face(double helix) const;
  // (root, load) Pa N-1: what the half-planes of `loads` at roll angles xi (rad) add in the loaded tooth, whose nodes hold
  // what holds_rest says.
  MatrixRM near_field(const FlankLoads& loads, const Eigen::VectorXd& xi) const;

 private:
  struct Side;
  // The strain along the root at one place of a side: e_t = sum over k of slope[k] tangent . u_k.
  struct Strain {
    double arc_length = 0;  // m from the flank
    double weight = 0;      // m: share of the arc length, up to a factor
    Vec2 place = Vec2::Zero(), tangent = Vec2::Zero();
    std::vector<int> node;
    std::vector<double> value, slope;  // 1, m-1
  };
  struct Curve;
  Curve curve() const;
  // (root, strain) 1
  Eigen::MatrixXd fit(const std::vector<Strain>& strains, double length, double mouth) const;
  const SectorGrid& mesh_;
  int sides_;            // how many roots are read
  bool parted_ = false;  // by the mouth of a slit
  ToothGeometry tooth_;
  RootPoints points_;
  PlaneModuli moduli_;
  std::vector<Strain> strains_;
  Eigen::MatrixXd fitting_;  // (root, strain) 1
  SparseReal stress_;
};

}  // namespace whine
