// A whole gear under pressure on its driving flanks, its hub held: what it looks like and where it is stressed.
//
// The flexibility of the flanks (solid/reduce.h) says how far loaded flanks move; this is the whole field behind it, by the
// same split: in a loaded tooth the half-plane's field of each strip, in closed form, plus a smooth rest w from the elements;
// elsewhere the elements alone. One right-hand side per loaded tooth, all harmonics of the cyclic gear. Near the contact,
// stresses are those of pressure that is even over each strip, at the nodes: what peaks between two nodes is not seen.
#pragma once
#include "results/sector_grid.h"
#include "solid/sector.h"

namespace whine {

// A strip of a driving flank that a force presses on, against the outward normal and even over the width.
struct StripLoad {
  int tooth = 0;     // counter-clockwise from tooth 0, any whole number
  double roll = 0;   // rad, of the strip's middle
  double width = 0;  // m along the flank
  double force = 0;  // N
};

struct LoadedGear {
  WholeGear gear;
  MatrixRM displacement;        // (node, 2) m, tooth 0 along +y
  MatrixRM stress;              // (node, 3) Pa: xx, yy, xy; mean of the elements about the node
  MatrixRM strip_displacement;  // (strip, 2) m: of the loaded flank, mean over the strip
  Eigen::VectorXd deflection;   // (strip) m: its inward component
  double hub_torque = 0;        // N m, counter-clockwise: what holds the hub, by the elements about the bore
  double strain_energy =
      0;  // J, by quadrature of the stresses; half of sum force x deflection, but for its error
};

// What forces on tooth 0 do to other teeth: [offset] (2 node, column) m, the unknowns x of FlankLoads on the tooth `offset`
// counter-clockwise of the loaded one (0 .. teeth - 1), in its own frame. force: (2 node, column) as FlankLoads::force.
// Throws Error(numerical) if a factorisation fails.
std::vector<Eigen::MatrixXd> teeth_under(const SectorGrid& mesh, const Material& material,
                                         const Eigen::MatrixXd& force);

// Throws Error(input) for a gear with a crack, no loads or a strip beyond the flank, Error(numerical) if a factorisation
// fails.
LoadedGear loaded_gear(const SectorGrid& mesh, const Material& material, const std::vector<StripLoad>& loads);

// Of plane stresses xx, yy, xy (Pa): the principal ones, larger first, and von Mises' equivalent. The stress across the
// plane, which plane strain has, counts in the latter.
struct StressMeasures {
  double largest = 0, least = 0, von_mises = 0;  // Pa
};
StressMeasures stress_measures(const Eigen::Vector3d& stress, const Material& material);

}  // namespace whine
