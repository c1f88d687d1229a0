// A pair at rest over its mesh phase.
#pragma once
#include <Eigen/Core>
#include <array>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "model/stages.h"
#include "results/remark.h"

namespace whine {

// What the compliance of the mesh, 1 / mean_stiffness, consists of (system/compliance_split.h). m N-1, along the line of action.
struct ComplianceSplit {
  double whole = 0, contact = 0;
  Eigen::Vector2d body = Eigen::Vector2d::Zero(),
                  wider_body = body;  // twist of each gear; with a bore a tenth larger
  double single = 0;  // N m-1: largest stiffness of a pair that carries all the load; 0: no pair ever does

  double bodies() const { return body[0] + body[1]; }
  double teeth() const { return whole - bodies() - contact; }  // the rest
  double body_share() const { return bodies() / whole; }
  // 1: relative change of the mean mesh stiffness if the bore of a gear were a tenth larger, by the twist alone
  double with_wider_bore(size_t gear) const {
    const auto g = static_cast<Eigen::Index>(gear);
    return whole / (whole - (body[g] - wider_body[g])) - 1;
  }
  // N m-1: `single` and the mean mesh stiffness if the bodies did not twist, as in ISO 6336
  double single_teeth() const { return single > 0 ? 1 / (1 / single - bodies()) : 0; }
  double mean_teeth() const { return 1 / (whole - bodies()); }
};

// The largest pressure that the result may state, and where there is none (system/flank_pressure.h).
struct FlankPressure {
  double smooth = 0;  // Pa: largest of all contacts inside the flanks and clear of ridges; 0: there is none
  double on_ridge =
      0;  // Pa: largest that strips show of contacts over a ridge; 0: there are none, or contact = "line"
  double per_doubling = 0;  // Pa: what the same grows by with each doubling of the strips
  std::string ridge;        // what makes the ridge, of which gear: "the linear tip relief of [gear.wheel]"
};

// The rectangular wave that approximates a mesh stiffness (system/rectangular_wave.h): one level per number of pairs in nominal
// contact.
struct RectangularWave {
  double low = 0, high = 0;             // N m-1
  double high_begin = 0, high_end = 0;  // phase; begin in [0, 1), end in (begin, begin + 1)

  double duty() const { return high_end - high_begin; }
  double mean() const { return low + (high - low) * duty(); }  // N m-1
  // N m-1, harmonic >= 1: 2 (high - low) |sin(pi n d)| / (pi n), d the duty
  double amplitude(int harmonic) const {
    const double n = std::numbers::pi * harmonic;
    return 2.0 * std::abs((high - low) * std::sin(n * duty())) / n;
  }
  double at(double phase) const {  // N m-1
    const double after = phase - high_begin;
    return after - std::floor(after) < duty() ? high : low;
  }
};

// Contact of the reference pair at mesh phase 0, cut into strips; nothing where the pair is out of reach there.
struct ReferenceContact {
  Eigen::VectorXd border;      // (strip + 1) m along the flank from the pitch point, to the driver's tip
  Eigen::VectorXd gap;         // (strip) m, unloaded
  Eigen::VectorXd force;       // (strip) N
  Eigen::VectorXd separation;  // (strip) m, of the loaded flanks (d of Eq. 18)
  double approach = 0;         // m: the transmission error
};

// static.h5
struct StaticResult : GearPairParameters {
  double torque = 0;  // N m on the driver
  double contact_ratio = 0;
  int hunting_periods =
      1;  // mesh periods after which the same teeth meet, as far as teeth differ; all are here
  Eigen::VectorXd mesh_phase;          // (phase) 1, 0 to hunting_periods
  Eigen::VectorXd transmission_error;  // (phase) m
  Eigen::VectorXd unloaded_error;      // (phase) m: the same without load, 0 for flanks as they are designed
  // (phase) N m-1, of the mesh without bearings; the secant is the load over what it adds to the transmission error; the
  // tangent of contact "line" is off by up to 0.6 % where contact comes near a tip edge
  Eigen::VectorXd stiffness_secant, stiffness_tangent;
  Eigen::VectorXi pair;  // (pair)
  MatrixRM tooth_load;   // (phase, pair) N
  // [gear] (phase, xy) N: what a gear presses its bearing with; empty for a rigid one. The driver's centre is at the
  // origin, the driven gear's above it, the driver turns counter-clockwise.
  std::array<MatrixRM, 2> bearing_force;
  // (phase, pair) Pa, m: of contacts that stay inside the flank, 0 elsewhere
  MatrixRM contact_pressure, contact_half_width;
  // [gear] (phase, pair) Pa: largest tangential stress along the root beside the loaded flank of each pair's tooth, tension
  // positive
  std::array<MatrixRM, 2> root_stress;
  Eigen::VectorXd root_stress_max;  // (gear) Pa: largest of these
  Eigen::VectorXd
      root_stress_angle;  // (gear) rad: of the root's tangent there against the centre line of the tooth
  Eigen::VectorXd root_stress_phase;  // (gear) 1: mesh phase of the loaded pair then, 0 at the pitch point
  Eigen::VectorXi
      root_stress_tooth;  // (gear): of which tooth, counter-clockwise from tooth 0; empty for teeth that are all alike
  double loss_factor = 0;           // H_V: mean power lost by sliding, over mu times the power carried
  double friction_coefficient = 0;  // 1; 0: no friction, and what follows is empty
  // (phase) N m: work that friction takes per angle of the driver; [gear] (phase) N m: moment of friction about its axis, positive
  // where it acts as the normal force does: against the rotation of the driver, with that of the driven gear
  Eigen::VectorXd friction_loss;
  std::array<Eigen::VectorXd, 2> friction_moment;
  double efficiency = 1;                        // 1 - mean friction_loss / torque
  Eigen::VectorXd transmission_error_harmonic;  // (harmonic 0..) m: mean, then amplitudes
  Eigen::VectorXd stiffness_harmonic;           // (harmonic 0..) N m-1, of the secant stiffness
  // (order 0..) m: mean, then amplitudes of the harmonics of the hunting frequency, up to those above; empty for teeth that
  // are all alike
  Eigen::VectorXd transmission_error_order;
  double mean_stiffness = 0;  // N m-1: mean over the period of the secant stiffness
  ComplianceSplit compliance;
  FlankPressure flank_pressure;
  RectangularWave rectangular_wave;
  ReferenceContact reference_contact;
  // certificate: worst over all positions
  double least_gap = 0;          // m, of strips without force
  double least_force = 0;        // N, of strips with force
  double torque_residual = 0;    // relative, |sum a p - T| / T
  double friction_coupling = 0;  // m, by how much gaps are off for what friction of the last forces moves
  double backlash_margin = 0;    // m left on the line of action; infinite backlash is not stored
  std::vector<Remark> remarks;
};

}  // namespace whine
