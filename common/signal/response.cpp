#include "signal/response.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "signal/spectrum.h"

namespace whine {
namespace {

double base_radius(const GearDesign& gear) {
  return 0.5 * gear.module * gear.teeth * std::cos(gear.pressure_angle);
}

void require_length(const char* what, Eigen::Index length, Eigen::Index speeds) {
  if (length != speeds)
    fail(Failure::input, "sweep: ", what, " has ", length, " rows, mesh_frequency has ", speeds);
}

void require_shapes(const SweepArtifact& s) {
  const Eigen::Index speeds = s.mesh_frequency.size();
  if (speeds == 0) fail(Failure::input, "sweep: it holds no speed; 1 is the least");
  require_length("transmission_error", s.transmission_error.rows(), speeds);
  require_length("mesh_force", s.mesh_force.rows(), speeds);
  require_length("tooth_load", static_cast<Eigen::Index>(s.tooth_load.size()), speeds);
  require_length("period_multiple", s.period_multiple.size(), speeds);
  if (s.mesh_force.cols() != s.transmission_error.cols())
    fail(Failure::input, "sweep: mesh_force has ", s.mesh_force.cols(), " samples, transmission_error ",
         s.transmission_error.cols());
  if (s.jump_width.size() != s.jump_frequency.size())
    fail(Failure::input, "sweep: ", s.jump_frequency.size(), " jumps, but ", s.jump_width.size(), " widths");
  for (Eigen::Index f = 0; f < speeds; ++f) {
    if (s.period_multiple[f] < 1)
      fail(Failure::input, "sweep: period_multiple is ", s.period_multiple[f], " at ", s.mesh_frequency[f],
           " Hz; 1 is the least");
    const MatrixRM& load = s.tooth_load[f];
    if (load.rows() != s.transmission_error.cols() || load.cols() < 1)
      fail(Failure::input, "sweep: tooth_load is ", load.rows(), " x ", load.cols(), " at ",
           s.mesh_frequency[f], " Hz; ", s.transmission_error.cols(),
           " samples of 1 pair at least are needed");
    if (!load.allFinite())
      fail(Failure::input, "sweep: tooth_load is not finite at ", s.mesh_frequency[f], " Hz");
  }
}

}  // namespace

double natural_frequency_estimate(const SweepArtifact& s) {
  for (const auto& [what, value] : {std::pair{"driver_inertia", s.driver_inertia},
                                    {"driven_inertia", s.driven_inertia},
                                    {"mean_stiffness", s.mean_stiffness}})
    if (!(value > 0) || !std::isfinite(value))
      fail(Failure::input, "sweep: ", what, " is ", value, "; it must be above 0");
  const double r1 = base_radius(s.driver), r2 = base_radius(s.driven);
  const double inverse_mass = r1 * r1 / s.driver_inertia + r2 * r2 / s.driven_inertia;
  return std::sqrt(s.mean_stiffness * inverse_mass) / (2.0 * std::numbers::pi);
}

ResponseArtifact response(const SweepArtifact& s) {
  require_shapes(s);
  const Eigen::Index speeds = s.mesh_frequency.size();
  const int count =
      resolved_harmonics(s.transmission_error.cols(), kResponseHarmonics, s.period_multiple.maxCoeff());
  if (count < 1)
    fail(Failure::input, "sweep: ", s.transmission_error.cols(), " samples over ",
         s.period_multiple.maxCoeff(),
         " mesh periods do not resolve the mesh frequency; raise steps_per_period");

  ResponseArtifact r;
  r.torque = s.torque;
  r.direction = s.direction;
  r.model = "finite elements";
  r.mesh = s.mesh;
  r.fidelity = s.fidelity;
  r.damping = s.damping;
  r.natural_frequency = natural_frequency_estimate(s);
  r.mesh_frequency = s.mesh_frequency;
  r.jump_frequency = s.jump_frequency;
  r.jump_width = s.jump_width;
  r.period_multiple = s.period_multiple;
  r.dte_rms.resize(speeds);
  r.dte_mean.resize(speeds);
  r.dte_harmonic.resize(speeds, count);
  r.tooth_load_max.resize(speeds);
  r.mesh_force_max.resize(speeds);
  r.separation_fraction.resize(speeds);
  r.separations_per_period.resize(speeds);
  for (Eigen::Index f = 0; f < speeds; ++f) {
    const int periods = s.period_multiple[f];
    const Harmonics dte = harmonics(s.transmission_error.row(f).transpose(), count, periods);
    const Separations apart = separations(s.mesh_force.row(f).transpose());
    r.dte_rms[f] = dte.rms;
    r.dte_mean[f] = dte.mean;
    r.dte_harmonic.row(f) = dte.amplitude.transpose();
    r.tooth_load_max[f] = s.tooth_load[f].maxCoeff();
    r.mesh_force_max[f] = s.mesh_force.row(f).maxCoeff();
    r.separation_fraction[f] = apart.fraction;
    r.separations_per_period[f] = static_cast<double>(apart.intervals) / periods;
  }
  return r;
}

}  // namespace whine
