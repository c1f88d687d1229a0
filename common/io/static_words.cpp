#include "io/static_words.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.h"

namespace whine {

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
  for (int g = 0; g < kSides && root.order.rows() > 0; ++g) {
    std::ostringstream out;
    out << "largest root stress of " << errors.mesh.gear[static_cast<size_t>(g)] << " changes by ";
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
    if (face.none() || (all.of_train() && std::find(section.begin(), own, section[m]) != own)) continue;
    const double mean = statics.tooth_load.row(0).sum() / statics.face_width();
    std::ostringstream out;
    if (all.of_train()) out << all.mesh_names[m] << ": ";
    out << face.line_load[0].cols();
    if (face.degree > 0)
      out << " points on bodies in three dimensions (degree " << face.degree << ")";
    else
      out << " slices";
    out << " along each contact line: overlap ratio " << face.overlap_ratio << ", face load factor K_Hbeta "
        << face.load_factor << " +- " << std::round(1e3 * face.load_factor_error) / 1e3
        << " of the reference pair at the pitch point, largest line load " << face.line_load_max * 1e-3
        << " N/mm (inner 90 % of face and path; all of the load over the face: " << mean * 1e-3 << " N/mm)";
    if (face.axial_force != 0) out << ", axial force on the driver " << face.axial_force << " N";
    lines.push_back(out.str());
  }
  return lines;
}

}  // namespace whine
