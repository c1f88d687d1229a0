// Power lost by sliding, from the loads that the pairs of teeth carry.
//
//   P_loss = mu mean(sum over the pairs of F v_s),   H_V = P_loss / (mu T omega) = mean(sum of F |sliding(path)|) / T
// sliding(path) (m rad-1) is that of GearPair, path that of the nominal point; a tip edge that touches off the line of action is
// taken at the end of the path. H_V does not depend on mu: losses are linear in mu as long as friction changes no load.
#pragma once
#include "base/matrix.h"
#include "gear/pair.h"

namespace whine {

// load: (sample, pair) N of the pairs `number`, at sample i of the phases `phase` (sample) of mesh periods, from the pitch point;
// evenly over whole periods. torque: N m, on the driver, mean.
double loss_factor(const GearPair& pair, const Eigen::VectorXi& number, const Eigen::VectorXd& phase,
                   const Eigen::Ref<const MatrixRM>& load, double torque);

}  // namespace whine
