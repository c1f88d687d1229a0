#include "io/static_words.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "base/error.h"

namespace whine {
namespace {

std::string range(double least, double most) {
  return least == most ? text(least) : text(least, " to ", most);
}

}  // namespace

std::vector<std::string> summary_words(const SystemStaticResult& a) {
  double least = 1e30, most = -1e30, soft = 1e30, stiff = 0, force = 0;
  for (const StaticResult& mesh : a.mesh) {
    const auto& te = mesh.transmission_error;
    least = std::min(least, a.of_train() ? te.mean() : te.minCoeff());
    most = std::max(most, a.of_train() ? te.mean() : te.maxCoeff());
    soft = std::min(soft, mesh.mean_stiffness);
    stiff = std::max(stiff, mesh.mean_stiffness);
  }
  for (const MatrixRM& at : a.bearing_force) force = std::max(force, at.rowwise().norm().maxCoeff());
  std::vector<std::string> lines;
  if (a.of_train() && a.hunting_periods > 1)
    lines.push_back(text("teeth differ: ", a.hunting_periods,
                         " mesh periods, after which the same ones meet, of ", a.settings.contact.positions,
                         " positions each"));
  const std::string stiffness = text(", mean stiffness ", range(soft * 1e-6, stiff * 1e-6), " N/µm, ");
  const std::string error = text(least * 1e6, " to ", most * 1e6, " µm");
  lines.push_back(a.of_train() ? text(a.body_names.size(), " bodies, ", a.mesh.size(), " meshes", stiffness,
                                      "mean transmission errors ", error, ", shares of the load up to ",
                                      a.load_share.maxCoeff() * 100, " %, bearing forces up to ", force, " N")
                               : text(a.mesh[0].torque, " N m, contact ratio ", a.mesh[0].contact_ratio,
                                      stiffness, "transmission error ", error));
  return lines;
}

std::vector<std::string> change_words(const std::string& where, const StaticDifference& change, int strips) {
  if (change.positions == 0) return {};
  std::ostringstream out;
  out << strips << " strips change, " << where << " (" << change.positions
      << " positions): transmission error by " << change.error_largest * 100 << " % at most, "
      << change.error_rms * 100 << " % RMS; pair loads by " << change.load_largest * 100 << " % at most, "
      << change.load_rms * 100 << " % RMS of the load";
  return {out.str()};
}

std::string change_words(const WidthChange& change) {
  const auto percent = [](double share) { return text(std::round(share * 1e4) / 1e2, " %"); };
  return text(change.level, " against ", change.other, ": transmission error off by ",
              percent(change.transmission_error), " of its mean at most, peak to peak ",
              percent(change.peak_to_peak), ", first harmonic ", percent(change.first_harmonic),
              ", mean stiffness ", percent(change.mean_stiffness), ", K_Hbeta ", change.load_factor[0],
              " against ", change.load_factor[1]);
}

std::vector<std::string> root_stress_words(const ErrorBudgetResult& errors) {
  std::vector<std::string> lines;
  const RootConvergence root = convergence(errors.root);
  for (Eigen::Index g = 0; root.order.rows() > 0 && g < root.order.cols(); ++g) {
    std::ostringstream out;
    out << "largest root stress of " << errors.gear_names[static_cast<size_t>(g)] << " changes by ";
    for (Eigen::Index k = 0; k < root.change.rows(); ++k)
      out << (k > 0 ? ", " : "") << std::round(1e5 * root.change(k, g)) / 1e3 + 0.0;
    out << " % each time the elements on the root are halved";
    const double order = resolved_order(root, root.order.rows() - 1, g);
    if (std::isfinite(order) && order > 0) out << "; order at last " << std::round(10 * order) / 10;
    if (std::isfinite(order) && order <= 0) out << "; the last changes do not shrink";
    lines.push_back(out.str());
  }
  return lines;
}

std::vector<std::string> face_load_words(const SystemStaticResult& all) {
  std::vector<std::string> lines;
  const std::vector<int>& section = all.settings.section;
  for (size_t m = 0; m < all.mesh.size(); ++m) {
    const StaticResult& statics = all.mesh[m];
    const FaceLoad& face = statics.face;
    const auto own = section.begin() + static_cast<std::ptrdiff_t>(m);
    if (face.none() || std::find(section.begin(), own, section[m]) != own) continue;
    const double mean = statics.tooth_load.row(0).sum() / statics.face_width();
    std::ostringstream out;
    if (all.of_train()) out << all.mesh_names[m] << ": ";
    out << face.line_load[0].cols();
    if (face.degree > 0)
      out << " points on bodies in three dimensions (degree " << face.degree << ")";
    else
      out << " slices";
    out << " along each contact line: overlap ratio " << face.overlap_ratio << ", face load factor K_Hbeta "
        << face.load_factor << " ± " << std::round(1e3 * face.load_factor_error) / 1e3
        << " of the reference pair at the pitch point, largest line load " << face.line_load_max * 1e-3
        << " N/mm (inner 90 % of face and path; all of the load over the face: " << mean * 1e-3 << " N/mm)";
    if (face.axial_force != 0) out << ", axial force on the driver " << face.axial_force << " N";
    lines.push_back(out.str());
  }
  return lines;
}

std::vector<std::string> harris_words(const HarrisMapResult& map) {
  std::vector<std::string> lines{
      text(map.torque.size(), " torques x ", map.relief.size(), " reliefs x ", map.length.size(), " starts")};
  const double widest = map.relief.tail<1>()[0];
  for (Eigen::Index s = 0; s < map.length.size(); ++s) {
    const bool at_edge = map.relief.size() > 1 && map.optimum_relief[s] >= widest;
    lines.push_back(
        text("start ", map.start_roll(s, 0) * 180 / std::numbers::pi, " deg: at ", map.design_torque, " N m ",
             map.optimum_relief[s] * 1e6, " µm leave ", map.optimum_peak_to_peak[s] * 1e6, " µm peak to peak",
             at_edge ? "; that is the edge of the map: more relief may leave less, widen --relief-um" : ""));
  }
  if (map.checked > 0)
    lines.push_back(text(map.checked, " points solved again with 3 times the strips and positions differ by ",
                         map.largest_error * 100, " % of the peak to peak at most"));
  return lines;
}

}  // namespace whine
