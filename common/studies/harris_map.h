// Harris maps: peak-to-peak transmission error and its first harmonics against torque and tip relief (Harris, Proc. Inst.
// Mech. Eng. 172 (1958) 87-112), from two bodies and nothing else.
//
// What the contact at a mesh position needs of the bodies does not depend on the relief, which adds to the gaps alone, nor on
// the torque: it is computed once per position and range of loads. Under one relief the contact is then followed through all
// torques at once (LoadPath).
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "results/harris_map.h"
#include "results/reduced_body.h"

namespace whine {

struct HarrisPlan {
  std::vector<double> torque;  // N m, ascending, above 0
  std::vector<double> relief;  // m, ascending, from 0 on
  std::vector<double> length;  // m, of roll, from where the relief starts to the tip edge
  Relieved relieved = Relieved::both;
  ReliefShape shape = ReliefShape::linear;
  double design_torque = 0;  // N m, within `torque`
  int positions = 256;       // in a mesh period
  int strips = 8;            // across the contact width at the least load of a range
};

// m: length of roll of a tip relief that starts at the highest point of single-pair contact, the same on both gears.
double single_pair_relief_length(const ReducedBody& driver, const ReducedBody& driven,
                                 const GearMeshSpec& mesh);

// statics: mesh and discretisation; what it says of tip reliefs is left out, all other modifications stay. Contact is that of
// strips. The check is left at 0 points. report(done, total, note) is called after each relief. Throws Error(input) for a plan
// out of order or a relief that does not fit its flank, Error(numerical) where contact leaves the flanks.
HarrisMapResult harris_map(const ReducedBody& driver, const ReducedBody& driven,
                           const StaticParameters& statics, const HarrisPlan& plan,
                           const std::function<void(long, long, const std::string&)>& report);

// Solves the optima and `points` points of the map again, one load at a time (static_transmission), with `finer` times the
// strips of the map at the same load and `finer` times the positions, and fills checked and largest_error.
void check(HarrisMapResult& map, const ReducedBody& driver, const ReducedBody& driven, int positions,
           int points, int finer = 3);

// Fills the dynamic part: sweeps up and down at every point of the map. bearing_stiffness: N m-1, as of sweep().
void add_dynamics(HarrisMapResult& map, const ReducedBody& driver, const ReducedBody& driven,
                  const SweepParameters& settings, double bearing_stiffness,
                  const std::function<void(long, long, const std::string&)>& report);

}  // namespace whine
