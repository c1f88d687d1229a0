#include "io/scene_fragment.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "base/error.h"
#include "base/tool.h"
#include "io/compatibility.h"
#include "io/publish.h"
#include "io/scene_goals.h"
#include "io/variant.h"

namespace whine {

std::vector<std::string> different(const BodyHashes& bodies) {
  std::vector<std::string> hashes;
  for (const auto& [gear, hash] : bodies)
    if (std::find(hashes.begin(), hashes.end(), hash) == hashes.end()) hashes.push_back(hash);
  return hashes;
}

BodyHashes publish_bodies(const std::string& home, const std::string& folder, const BodySettings& settings) {
  BodyHashes bodies;
  for (const auto& [gear, text] : settings) {
    const std::string hash = body_hash(text);
    publish_if_changed(folder + "/bodies/" + hash + "/body.toml", text);
    publish_link(home + "/" + gear, "../bodies/" + hash);
    bodies.emplace_back(gear, hash);
  }
  return bodies;
}

std::string checked_scene_stem(const std::string& path) {
  const std::string stem = std::filesystem::path(path).stem().string();
  if (!plain_name(stem)) {
    fail(
        Failure::input, path, ": the name '", stem,
        "' becomes a folder and a make target, so it may hold letters, digits, '_' and '-' only; rename the file");
  }
  if (stem.size() > kLongestName)
    fail(Failure::input, path.size() > 200 ? "..." + path.substr(path.size() - 200) : path, ": the name has ",
         stem.size(), " letters; it becomes a folder and a make target, so it may have ", kLongestName,
         " at most; rename the file");
  static const std::set<std::string> others{"bodies", "figures", "studies", "compare", "reading"};
  if (others.contains(stem)) {
    fail(Failure::input, path, ": a scene cannot be called '", stem,
         "', a folder of results is; rename the file");
  }
  return stem;
}

std::string system_fragment(const std::string& path, const std::string& stem, const BodyHashes& bodies,
                            bool planets, bool moves) {
  std::ostringstream out;
  out << "# Written by gear-scene from " << in_comment(recorded_path(path)) << "\nSCENE_" << stem
      << "_SYSTEM := " << (bodies.empty() ? "rigid" : "elastic") << "\nSCENE_" << stem
      << "_PLANETS := " << (planets ? "yes" : "no") << "\n";
  if (bodies.empty()) return out.str();
  if (moves) out << "SCENE_" << stem << "_SYSTEM_MOVES := yes\n";
  out << "SCENE_" << stem << "_SYSTEM_GEARS :=";
  for (const auto& [gear, hash] : bodies) out << " " << gear;
  out << "\n";
  for (const auto& [gear, hash] : bodies)
    out << "SCENE_" << stem << "_BODY_" << gear << " := " << hash << "\n";
  out << "BODIES +=";
  for (const auto& hash : different(bodies)) out << " " << hash;
  out << "\n";
  return out.str();
}

std::string scene_fragment(const Scene& scene, const std::string& path, const std::string& stem,
                           const BodyHashes& bodies) {
  const auto name = [&](const std::string& key) { return "SCENE_" + stem + "_" + key; };
  std::ostringstream out;
  out << "# Written by gear-scene from " << in_comment(recorded_path(path)) << "\n" << name("GEARS") << " :=";
  for (const auto& [gear, hash] : bodies) out << " " << gear;
  out << "\n" << name("DRIVER") << " := " << scene.mesh.gear[0] << "\n";
  out << name("DRIVEN") << " := " << scene.mesh.gear[1] << "\n";
  for (const auto& [gear, hash] : bodies) out << name("BODY_" + gear) << " := " << hash << "\n";
  out << name("TORQUES") << " :=";
  for (double torque : scene.operation.torques) out << " " << torque;
  out << "\n" << name("REFERENCE_TORQUE") << " := " << scene.operation.torques.front() << "\n";
  const SceneAbilities able = abilities(scene);
  const bool differ = able.teeth_differ, cracked = able.cracked;
  bool modified = false;
  for (const std::string& gear : scene.mesh.gear)
    modified |= scene.gear(gear).modification != FlankModification{};
  const bool rings_down = scene.fidelity.contact == ContactModel::strips &&
                          scene.fidelity.body != BodyModel::full && !differ && !cracked;
  out << name("RINGS_DOWN") << " := " << (rings_down ? "yes" : "no") << "\n";
  out << name("TEETH") << " := "
      << (differ    ? "differ"
          : cracked ? ""
                    : "alike")
      << (cracked ? " cracked" : "") << "\n";
  out << name("MODIFIED") << " := " << (modified ? "yes" : "no") << "\n";
  out << name("FRICTION") << " := " << (scene.mesh.friction.acts() ? "yes" : "no") << "\n";
  out << name("BEARINGS") << " := " << (scene.mesh.on_bearings() ? "elastic" : "rigid") << "\n";
  out << "BODIES +=";
  for (const auto& hash : different(bodies)) out << " " << hash;
  out << "\n";
  return out.str();
}

}  // namespace whine
