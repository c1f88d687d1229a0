// The six four-sided blocks of a half sector: their corner points, and how many elements of which growth go along their edges.
#pragma once
#include "gear/involute.h"

namespace whine {

// Sizes and corner points of the six blocks of the half sector x <= 0. Of an internal gear they are the other way round: the
// tips inside, the rim, which takes the place of the bore, outside.
struct SectorPlan {
  double tip_size, tip_ratio;  // m, 1: along the flank from the corner
  double across_ratio;         // 1: growth from the flank to the centre line
  int n_tip, n_flank, n_fillet, n_root, n_across, n_under, n_rim;
  int n_sharp = 0;                // of n_root, from the corner of three blocks to t_land
  double rim_ratio, under_ratio;  // 1: growth towards the bore; from the root to the end of the tooth region
  double t_land = 1;              // root curve: end of its sharp part, if that has elements of its own
  double xi_split, t_split;       // flank: end of the graded part; root curve: corner of three blocks
  double ring_radius;             // m: where the tooth region ends
  double ring_angle;              // rad: polar angle of the foot under the corner of three blocks
  Vec2 split, fillet_corner, chord_centre;
};

// h: m, the wanted element size; root: m, that on the root and below it, h at most.
SectorPlan plan_sector(const ToothGeometry& tooth, double h, double root);

}  // namespace whine
