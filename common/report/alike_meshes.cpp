#include "report/alike_meshes.h"

#include <algorithm>

namespace whine {

std::vector<AlikeMeshes> alike_meshes(const SystemStaticParameters& settings) {
  std::vector<AlikeMeshes> out;
  out.reserve(settings.mesh.size());
  for (const GearMeshSpec& mesh : settings.mesh) out.push_back({mesh.gear[0] + "-" + mesh.gear[1], {}});
  for (size_t m = 0; m < settings.section.size(); ++m)
    out.at(static_cast<size_t>(settings.section[m])).meshes.push_back(m);
  return out;
}

std::vector<LoadSharing> load_sharing(const SystemStaticResult& a) {
  std::vector<LoadSharing> out;
  for (const AlikeMeshes& section : alike_meshes(a.settings)) {
    const auto alike = static_cast<double>(section.meshes.size());
    if (alike < 2) continue;
    LoadSharing& of = out.emplace_back(LoadSharing{section});
    for (const size_t m : of.meshes) {
      const auto share = a.load_share.col(static_cast<Eigen::Index>(m));
      of.factor = std::max(of.factor, share.maxCoeff() * alike);
      of.mean_factor = std::max(of.mean_factor, share.mean() * alike);
    }
  }
  return out;
}

}  // namespace whine
