#include "system/drawing_remarks.h"

#include <algorithm>

#include "gear/face_width.h"
#include "gear/undercut.h"

namespace whine {

std::vector<Remark> drawing_remarks(const GearPair& pair, const std::array<std::string, 2>& name) {
  std::vector<Remark> out;
  const auto add = [&](bool warning, const std::string& words) {
    if (!words.empty()) out.push_back({warning, words});
  };
  const GearDesign &first = pair.gear(0).design(), &second = pair.gear(1).design();
  add(false, width_words(first, name[0], second, name[1]));
  add(true, undercut_words(first, name[0]));
  add(true, undercut_words(second, name[1]));
  add(true, shortened_path_words(pair, name));
  return out;
}

std::vector<Remark> drawing_remarks(const SystemStaticResult& system) {
  std::vector<Remark> out;
  for (size_t m = 0; m < system.settings.layout.meshes.size(); ++m) {
    const GearPairParameters mesh = mesh_parameters(system, m);
    for (const Remark& of_mesh : drawing_remarks(GearPair(mesh), mesh.mesh.gear))
      if (std::none_of(out.begin(), out.end(), [&](const Remark& r) { return r.words == of_mesh.words; }))
        out.push_back(of_mesh);
  }
  return out;
}

}  // namespace whine
