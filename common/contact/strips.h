// Contact of one tooth pair cut into strips: exact gaps of the two flanks, and the half-plane's part of the
// compliance.
//
// The candidate zone of strips moves with the nominal contact point and ends at a tip edge when it reaches one; off
// the line of action it begins at the edge. Its number of strips never changes, so nothing jumps while the
// gears roll. Strips are of one width, and ever narrower towards a tip edge (or both) as the contact comes near it: there the
// pressure goes with the inverse root of the distance, and the first touch is at the edge itself. A strip's gap
// and displacement are means over the strip, which makes the compliance symmetric for any widths.
//
// The candidate zone is shifted by a quarter strip from the contact point. The force is a piecewise linear function of the approach,
// its pieces begin where a strip is added; strips that are added in turn at either end halve the pieces.
// All that is smooth in the candidate zone (body compliance, modes, relaxed loads) is carried by a few nodes and
// interpolated to the strips; the same weights collect strip forces on the nodes.
#pragma once
#include <Eigen/Core>
#include <array>

#include "contact/half_plane_strip.h"
#include "gear/pair.h"

namespace whine {

// How far contact is looked for.
struct CandidateZone {
  double half_zone = 0;   // m along the flank, either side of the nominal contact point
  int strips = 0;         // in a candidate zone
  double corner_gap = 0;  // m: tip edges with a larger gap than this are left out
  // The candidate zone lies about the place where unloaded flanks come nearest to each other instead.
  bool follows = false;
};

inline constexpr int kZoneNodes = 6;

struct PairStrips {
  int pair = 0;  // number of the pair: 0 reference, +1 preceding, -1 following
  PairContact contact;
  Eigen::VectorXd border;  // (strip + 1) m along the flank from the nominal contact point
  bool low_is_edge = false,
       high_is_edge = false;  // the candidate zone ends at a tip edge, where force is allowed
  Eigen::VectorXd gap;        // (strip) m, unloaded, of what all teeth have in common
  Eigen::Matrix<double, Eigen::Dynamic, kZoneNodes> interpolation;  // (strip, node) 1
  std::array<Eigen::VectorXd, 2> node_roll;                         // (node) rad, on driver and driven gear
  // (place) rad, on driver and driven gear: where a strip's gap is read, two places a strip, of lines one; empty for teeth that
  // are all alike
  std::array<Eigen::VectorXd, 2> gap_roll;

  int size() const { return static_cast<int>(gap.size()); }
  double width(int i) const { return border[i + 1] - border[i]; }           // m
  double middle(int i) const { return 0.5 * (border[i] + border[i + 1]); }  // m
};

// Size of a contact that stays inside its flank, as Hertz's theory names it.
struct ContactPatch {
  double pressure = 0;    // Pa, largest; 0 where no patch is reported
  double half_width = 0;  // m: twice the standard deviation of the pressure, exact for Hertz's semi-ellipse
};

// p: (strip) N; face_width: m. Zeros for a pair without force, for a corner contact, and for force on a tip edge:
// there the surface is no half-plane.
ContactPatch contact_patch(const PairStrips& strips, const Eigen::Ref<const Eigen::VectorXd>& p,
                           double face_width);

// pair: number of the pair; contact: its kinematics at this phase. Throws Error(numerical) if the flanks do not face each
// other about the contact point.
PairStrips make_strips(const GearPair& gears, int pair, const PairContact& contact,
                       const CandidateZone& range, const PairDeviation& deviation = {});

// (strip) m: what the two flanks deviate by, mean over each strip as in PairStrips::gap.
Eigen::VectorXd mean_deviation(const GearPair& gears, const PairStrips& strips,
                               const PairDeviation& deviation);

// (strip, strip) m N-1: both half-planes' surface displacement relative to `depth` of a strip for a unit force spread
// over another, mean over the strip.
Eigen::MatrixXd half_plane_compliance(const PairStrips& strips, const HalfPlaneSurface& driver,
                                      const HalfPlaneSurface& driven, double depth);

// Number of strips and half candidate zone for a force per pair (N): `across` strips over the Hertz contact width at
// `mean_force` or a little more (a multiple of 4 in all), a candidate zone for `largest_force`, both with the largest relative
// curvature radius on the path of contact. What flanks deviate by moves the place where they touch: the candidate zone is
// wider by the largest such move, or follows it where that is more than the contact is wide and all teeth
// are alike.
CandidateZone candidate_zone(const GearPair& gears, const HalfPlaneSurface& driver,
                             const HalfPlaneSurface& driven, int across, double mean_force,
                             double largest_force, double corner_gap, const PairDeviation& deviation = {});

}  // namespace whine
