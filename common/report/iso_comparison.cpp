#include "report/iso_comparison.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/error.h"
#include "gear/drawing_quantities.h"
#include "gear/iso6336.h"
#include "gear/pair.h"
#include "report/report_content.h"

namespace whine {

std::optional<double> IsoComparison::dynamic_factor(double mesh_frequency) const {
  if (!resonance) return std::nullopt;
  return iso_6336_dynamic_factor(dynamics, mesh_frequency / *resonance);
}

IsoComparison iso_comparison(const StaticResult& s, const std::array<double, kSides>& inertia) {
  const GearPair pair(s);
  IsoComparison out;
  const double force = s.torque / pair.gear(0).pitch_radius();
  const auto take = [&](const char* name, const std::function<void()>& formula) {
    try {
      formula();
    } catch (const Error& error) {
      if (error.kind() != Failure::input && error.kind() != Failure::numerical) throw;
      if (out.missing.find(name) == std::string::npos)
        out.missing += text(out.missing.empty() ? "" : ", ", name);
      if (out.why.empty()) out.why = error.what();
    }
  };
  const auto outside = [&out](const std::string& formula) {
    if (out.beyond.find(formula) == std::string::npos)
      out.beyond += text(out.beyond.empty() ? "" : " and ", formula);
  };
  if (pair.internal()) {
    out.missing = "Y_F, Y_S, sigma_F0, sigma_H0, K_v";
    out.why = "their formulas are for external gears";
  } else {
    for (int g = 0; g < kSides; ++g)
      take("sigma_F0", [&] {
        const auto gear = static_cast<size_t>(g);
        out.root[gear] = iso_6336_root(pair, g);
        out.root_stress[gear] = iso_6336_root_stress(pair, g, force);
        if (!out.root[gear]->in_range) outside("Y_S (1 <= q_s < 8)");
      });
    take("sigma_H0", [&] {
      out.flank_pressure = iso_6336_flank_pressure(pair, {s.gear[0].material, s.gear[1].material}, force);
    });
    // K_v has formulas for contact ratios above 2, too.
    take("K_v", [&] {
      const IsoStiffness stiffness =
          iso_6336_stiffness(s.gear[0].design, s.gear[0].material, s.gear[1].design, s.gear[1].material,
                             s.torque, s.contact_ratio);
      double inverse_mass = 0;  // kg-1
      for (size_t g = 0; g < kSides; ++g) {
        const double base = pair.gear(static_cast<int>(g)).base_radius();
        inverse_mass += base * base / inertia[g];
      }
      out.dynamics.contact_ratio = s.contact_ratio + pair.overlap_ratio();
      out.dynamics.line_load = stiffness.line_load;
      out.dynamics.single_stiffness = stiffness.single;
      out.dynamics.relief = std::min(s.mesh.modification[0].tip.amount, s.mesh.modification[1].tip.amount);
      iso_6336_dynamic_factor(out.dynamics, 1);  // throws where it has no value
      out.resonance = std::sqrt(stiffness.mesh * s.face_width() * inverse_mass) / (2 * std::numbers::pi);
      if (!stiffness.in_range)
        outside(text("c' in K_v (-0.5 <= x_1 + x_2 <= 2, contact ratio 1.2 to 1.9; here ",
                     shown(s.contact_ratio, 3), ")"));
    });
  }
  take("loss factor of rigid teeth", [&] { out.loss_factor = loss_factor_of_rigid_teeth(pair); });
  return out;
}

DynamicFactorPeak largest_dynamic_factor(const SystemStaticResult& rest, const ResponseResult& r,
                                         size_t mesh) {
  const auto column = static_cast<Eigen::Index>(mesh);
  const MatrixRM& force = r.mesh_force_sustained.size() > 0 ? r.mesh_force_sustained : r.mesh_force_max;
  const double at_rest = rest_force(rest, mesh);
  DynamicFactorPeak out;
  if (at_rest > 0) out.factor = force.col(column).maxCoeff(&out.row) / at_rest;
  if (r.of_train()) {
    out.why_none = "its formulas are of one mesh";
    return out;
  }
  const StaticResult& s = rest.mesh[mesh];
  if (!(r.inertia[0] > 0 && r.inertia[1] > 0)) {
    out.why_none = "the inertias are not known";
    return out;
  }
  const IsoComparison iso = iso_comparison(s, r.inertia);
  out.standard = iso.dynamic_factor(r.mesh_frequency[out.row]);
  if (!out.standard) out.why_none = iso.why;
  return out;
}

}  // namespace whine
