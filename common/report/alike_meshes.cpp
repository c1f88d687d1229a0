#include "report/alike_meshes.h"

#include <algorithm>

namespace whine {

std::vector<AlikeMeshes> alike_meshes(const SystemStaticResult& a) {
  if (!a.of_train()) return {{"", {0}}};
  std::vector<AlikeMeshes> out;
  out.reserve(a.settings.mesh.size());
  for (const GearMeshSpec& mesh : a.settings.mesh) out.push_back({mesh.gear[0] + "-" + mesh.gear[1], {}});
  for (size_t m = 0; m < a.settings.section.size(); ++m)
    out.at(static_cast<size_t>(a.settings.section[m])).meshes.push_back(m);
  return out;
}

bool shares_load(const SystemStaticResult& a, size_t m) {
  const std::vector<int>& section = a.settings.section;
  return m < section.size() && std::count(section.begin(), section.end(), section[m]) > 1;
}

std::vector<LoadSharing> load_sharing(const SystemStaticResult& a) {
  std::vector<LoadSharing> out;
  for (const AlikeMeshes& section : alike_meshes(a)) {
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
