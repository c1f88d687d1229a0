#include "signal/result_quantities.h"

#include <algorithm>

#include "base/error.h"
#include "results/impact.h"
#include "signal/spectrum.h"

namespace whine {

using Eigen::Index;

namespace {

constexpr int kHarmonics = 3;

// Of one mesh; end: what stands behind the names of quantities of a train, ".sun-planet1".
void add_mesh(Quantities& quantities, const ResponseResult& motion, Index mesh, const std::string& end) {
  const std::string d = name_of(motion.direction) + end;
  Index worst = 0;
  quantities["rms_max_" + d] = motion.dte_rms.col(mesh).maxCoeff(&worst);
  quantities["rms_max_speed_" + d] = motion.mesh_frequency[worst];
  quantities["tooth_load_max_" + d] = motion.tooth_load_max.col(mesh).maxCoeff();
  quantities["separation_max_" + d] = motion.separation_fraction.col(mesh).maxCoeff();
  double from = 0, to = 0;
  for (Index i = 0; i < motion.mesh_frequency.size(); ++i) {
    if (!(motion.separation_fraction(i, mesh) > 0)) continue;
    const double f = motion.mesh_frequency[i];
    from = from > 0 ? std::min(from, f) : f;
    to = std::max(to, f);
  }
  quantities["loss_from_" + d] = from;
  quantities["loss_to_" + d] = to;
}

void add_sweep(Quantities& quantities, const ResponseResult& motion) {
  const std::string d = name_of(motion.direction);
  quantities["jumps_" + d] = static_cast<double>(motion.jump_frequency.size());
  quantities["jump_frequency_" + d] = motion.jump_frequency.size() > 0 ? motion.jump_frequency.maxCoeff() : 0;
  quantities["unsteady_" + d] = static_cast<double>((motion.period_multiple.array() == 0).count());
}

void add_harmonics(Quantities& quantities, const Eigen::VectorXd& te, int periods, const std::string& end) {
  const int count = resolved_harmonics(te.size(), kHarmonics, periods);
  if (count < kHarmonics)
    fail(Failure::input, te.size() / periods, " positions per mesh period do not resolve harmonic ",
         count + 1, " of the transmission error; raise 'positions'");
  const Harmonics spectrum = harmonics(te, count, periods);
  quantities["te_mean" + end] = spectrum.mean;
  quantities["te_peak_to_peak" + end] = te.maxCoeff() - te.minCoeff();
  for (int h = 1; h <= count; ++h) quantities[text("te_harmonic_", h, end)] = spectrum.amplitude[h - 1];
}

// Of one mesh at rest; end: as of add_mesh().
void add_at_rest(Quantities& quantities, const StaticResult& rest, const std::string& end) {
  const Eigen::VectorXd& te = rest.transmission_error;
  quantities["contact_ratio" + end] = rest.contact_ratio;
  quantities["overlap_ratio" + end] = rest.face.overlap_ratio;
  quantities["mean_stiffness" + end] = rest.mean_stiffness;
  add_harmonics(quantities, te, rest.hunting_periods, end);
  const Index positions = te.size() / rest.hunting_periods;
  double largest = 0;
  for (int period = 0; period < rest.hunting_periods; ++period) {
    const auto own = te.segment(period * positions, positions);
    largest = std::max(largest, own.maxCoeff() - own.minCoeff());
  }
  quantities["te_peak_to_peak_mesh" + end] = largest;
  quantities["tooth_load_static" + end] = rest.tooth_load.maxCoeff();
}

// Load sharing of the planets of each [[mesh]] that stands for several.
void add_sharing(Quantities& quantities, const SystemStaticResult& rest) {
  const Eigen::RowVectorXd mean = rest.mesh_force.colwise().mean();
  for (size_t s = 0; s < rest.settings.mesh.size(); ++s) {
    double planets = 0, sum = 0, largest = 0, peak = 0;
    std::vector<Index> own;
    for (Index m = 0; m < mean.size(); ++m)
      if (rest.settings.section[static_cast<size_t>(m)] == static_cast<int>(s)) {
        ++planets;
        sum += mean[m];
        largest = std::max(largest, mean[m]);
        peak = std::max(peak, rest.load_share.col(m).maxCoeff());
        own.push_back(m);
      }
    const auto& gear = rest.settings.mesh[s].gear;
    const std::string end = "." + gear[0] + "-" + gear[1];
    quantities["load_sharing_factor" + end] = sum > 0 ? largest * planets / sum : 0;
    quantities["load_sharing_peak" + end] = peak * planets;
    for (const Index m : own)
      quantities["load_share_mean." + mesh_name(rest.settings.layout, static_cast<size_t>(m))] =
          sum > 0 ? mean[m] / sum : 0;
  }
}

}  // namespace

Quantities quantities_of(const StaticResult& rest) {
  Quantities out;
  add_at_rest(out, rest, "");
  return out;
}

Quantities quantities_of(const SystemStaticResult& rest) {
  if (!rest.of_train()) return quantities_of(rest.mesh[0]);
  Quantities out;
  add_sharing(out, rest);
  for (size_t m = 0; m < rest.mesh.size(); ++m) {
    const std::string end = "." + rest.mesh_names[m];
    add_at_rest(out, rest.mesh[m], end);
    out["mesh_force_static" + end] = rest.mesh_force.col(static_cast<Index>(m)).maxCoeff();
  }
  for (size_t b = 0; b < rest.body_names.size(); ++b) {
    double& force = out["bearing_force_static." + rest.body_names[b]];
    for (const MatrixRM& forces : rest.bearing_force)
      force = std::max(force, forces.row(static_cast<Index>(b)).norm());
  }
  return out;
}

Quantities quantities_of(const ResponseResult& motion, const SystemStaticParameters* settings) {
  Quantities out;
  const std::string d = name_of(motion.direction);
  add_sweep(out, motion);
  if (!motion.of_train()) {
    add_mesh(out, motion, 0, "");
    out["natural_frequency"] = motion.natural_frequency;
    out["rayleigh_damping_ratio"] = rayleigh_ratio(motion.damping, motion.natural_frequency);
    return out;
  }
  for (size_t m = 0; m < motion.mesh_names.size(); ++m)
    add_mesh(out, motion, static_cast<Index>(m), "." + motion.mesh_names[m]);
  for (size_t b = 0; b < motion.body_names.size(); ++b) {
    const auto column = static_cast<Index>(b);
    const std::string end = d + "." + motion.body_names[b];
    out["bearing_force_max_" + end] = motion.bearing_force_max.col(column).maxCoeff();
    out["bearing_force_rms_max_" + end] = motion.bearing_force_rms.col(column).maxCoeff();
  }
  for (Index m = 0; settings && motion.load_share_max.size() > 0 && m < motion.load_share_max.cols(); ++m) {
    const auto& gear = settings->mesh[static_cast<size_t>(settings->section[static_cast<size_t>(m)])].gear;
    double& most = out["load_share_max_" + d + "." + gear[0] + "-" + gear[1]];
    most = std::max(most, motion.load_share_max.col(m).maxCoeff());
  }
  return out;
}

}  // namespace whine
