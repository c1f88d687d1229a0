// Designs side by side on common axes: at rest and in motion, at one torque.
#pragma once
#include <string>
#include <vector>

#include "report/figures.h"
#include "results/response.h"
#include "results/static.h"

namespace whine {

template <class Artifact>
struct OfDesign {
  std::string design;  // the name of its scene
  Artifact artifact;
};

// A mesh at rest as a curve.
struct RestCurve {
  std::string design, mesh;  // mesh: of a train by its gears; "": of a pair
  std::string words;         // of a note
  double torque = 0;         // N m, of a pair; trains have that of their drives
  int hunting_periods = 1;
  Eigen::VectorXd mesh_phase, transmission_error, stiffness, harmonic;  // 1, m, N m-1, m from harmonic 0
};
RestCurve rest_curve(const std::string& design, const StaticResult& rest);
// Of a pair its mesh, of a train the first mesh of each [[mesh]].
std::vector<RestCurve> rest_curves(const std::string& design, const SystemStaticResult& rest);

// Two to six curves in the order of the designs, of pairs at the torque of the first, of trains the first mesh of each [[mesh]]. Throw
// Error(input) for fewer than two designs or more curves, for another torque or a direction missing or given twice.

// Static transmission error (a) and secant mesh stiffness (b) over the mesh period, amplitudes of the error's harmonics (c).
Figure compared_rest_figure(const std::vector<RestCurve>& curves);

// Against mesh frequency, both directions: RMS of the dynamic transmission error (a), its first harmonic (b), the largest tooth
// load over that of rigid gears with one pair, T / r_b (c), with a train among the designs in kN.
Figure compared_motion_figure(const std::vector<OfDesign<ResponseResult>>& sweeps);

}  // namespace whine
