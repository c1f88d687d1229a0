#include "system/compliance_split.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/format.h"
#include "contact/hertz_line.h"
#include "gear/pair.h"
#include "gear/scene_geometry.h"

namespace whine {

double body_twist(const GearDesign& gear, const Material& material, double bore) {
  const ToothGeometry tooth(gear);
  const double shear = material.youngs_modulus / (2 * (1 + material.poisson_ratio)),
               root = tooth.root_radius();
  return std::pow(tooth.base_radius(), 2) / (4 * std::numbers::pi * shear * gear.face_width) *
             std::abs(1 / (bore * bore) - 1 / (root * root)) +
         (gear.elastic_rim() ? std::pow(tooth.base_radius(), 2) /
                                   (2 * std::numbers::pi * std::pow(bore, 3) * gear.rim_tangential_stiffness)
                             : 0);
}

ComplianceSplit compliance_split(const StaticResult& s) {
  const GearPair pair(s);
  ComplianceSplit out;
  out.whole = 1 / s.mean_stiffness;
  constexpr double kWider = 1.1;
  for (int g = 0; g < kSides; ++g) {
    const auto& [design, material, discretisation] = s.gear[static_cast<size_t>(g)];
    const double bore = design.clamped_radius(), root = pair.gear(g).root_radius();
    out.body[g] = body_twist(design, material, bore);
    // A bore cannot grow beyond the root circle, nor can the outside of a rim shrink.
    out.wider_body[g] = body_twist(
        design, material, design.internal ? std::max(bore / kWider, root) : std::min(kWider * bore, root));
  }
  const double force = s.torque / pair.gear(0).base_radius(), of_pair = force / pair.contact_ratio();
  const double cosine = std::cos(pair.base_helix_angle());
  const auto surface = [&](size_t g) {
    return HalfPlaneSurface(in_contact_plane(s.gear[g].material, s.mesh.contact_plane),
                            s.face_width() / cosine);
  };
  const double depth = 0.25 * std::numbers::pi * s.gear[0].design.module;
  out.contact = HertzLine(surface(0), surface(1), pair.relative_curvature_radius(0.0) / cosine, depth)
                    .at(of_pair / cosine)
                    .indentation /
                (cosine * force);
  for (Eigen::Index i = 0; i < s.tooth_load.rows(); ++i)
    if ((s.tooth_load.row(i).array() > 0).count() == 1)
      out.single = std::max(out.single, s.stiffness_secant[i]);
  return out;
}

std::vector<Remark> body_remarks(const StaticResult& s) {
  constexpr double kMuch = 0.2;
  std::vector<Remark> out;
  for (int g = 0; g < kSides; ++g) {
    const std::string words = thin_rim(s.gear[g].design, s.mesh.gear[g]);
    if (!words.empty()) out.push_back(remark(true, words));
  }
  constexpr double kWide = 10;  // modules: more than six tooth thicknesses
  for (int g = 0; g < kSides; ++g) {
    const GearDesign& design = s.gear[g].design;
    if (!s.gear[g].material.plane_stress || design.face_width <= kWide * design.module) continue;
    out.push_back(remark(
        true, "the face of ", s.mesh.gear[g], " is ", shown_number(design.face_width / design.module),
        " modules wide and plane = \"stress\" is for faces up to about 8: plane = \"strain\" is right for it, 10 % stiffer"));
  }
  const ComplianceSplit& split = s.compliance;
  if (!(split.body_share() > kMuch)) return out;
  const auto percent = [](double share) { return std::round(share * 100); };
  const bool supported = s.gear[0].design.elastic_rim() || s.gear[1].design.elastic_rim();
  out.push_back(remark(
      true, "the bodies between bore and root circle twist: ", percent(split.body_share()),
      " % of the compliance of the mesh (", s.mesh.gear[0], " ", percent(split.body[0] / split.whole), " %, ",
      s.mesh.gear[1], " ", percent(split.body[1] / split.whole),
      supported
          ? " %), which bore_radius_mm and rim_tangential_stiffness_N_mm2 decide: give those of the drawing and of the housing"
          : " %), which bore_radius_mm decides: give the radius inside which the gear is as good as rigid (shaft, hub, web)"));
  return out;
}

}  // namespace whine
