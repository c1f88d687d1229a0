#include "io/scene_fragment.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "base/error.h"
#include "base/tool.h"
#include "io/compatibility.h"
#include "io/make_request.h"
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

double input_torque(const System& layout) {
  double first = 0;
  for (const System::Drive& drive : layout.drives) {
    if (drive.kind != System::DriveKind::torque) continue;
    if (drive.torque > 0) return drive.torque;
    if (first == 0) first = -drive.torque;
  }
  return first;
}

namespace {

// Lines "SCENE_<stem>_<key> := <value>".
class Fragment {
 public:
  Fragment(const std::string& path, const std::string& stem) : stem_(stem) {
    out_ << "# Written by gear-scene from " << in_comment(recorded_path(path)) << "\n";
  }
  template <class Value>
  void operator()(const std::string& key, const Value& value) {
    out_ << "SCENE_" << stem_ << "_" << key << " := " << value << "\n";
  }
  void yes_or_no(const std::string& key, bool value) { (*this)(key, value ? "yes" : "no"); }
  // What there is of elastic gears, beside DRIVER and DRIVEN of a pair.
  void gears(const BodyHashes& bodies, const std::vector<double>& torques) {
    std::ostringstream names, values;
    for (const auto& [gear, hash] : bodies) {
      names << (names.view().empty() ? "" : " ") << gear;
      (*this)("BODY_" + gear, hash);
    }
    for (const double torque : torques) values << (values.view().empty() ? "" : " ") << torque;  // as by %g
    (*this)("GEARS", names.str());
    (*this)("TORQUES", values.str());
    (*this)("REFERENCE_TORQUE", torques.front());
    out_ << "BODIES += " << joined_by(" ", different(bodies)) << "\n";
  }
  std::string words() const { return out_.str(); }

 private:
  std::string stem_;
  std::ostringstream out_;
};

std::string teeth_words(const Traits& of) {
  const bool cracked = has(of, Trait::cracked);
  return text(has(of, Trait::differing) ? "differ" : cracked ? "" : "alike", cracked ? " cracked" : "");
}

// What makefiles ask of pairs alone.
void add_pair(Fragment& out, const Scene& scene, Traits able) {
  const GearMeshSpec& mesh = scene.mesh();
  out("DRIVER", mesh.gear[0]);
  out("DRIVEN", mesh.gear[1]);
  const auto modified = [&](size_t g) {
    return scene.gear(mesh.gear[g]).modification != FlankModification{};
  };
  out.yes_or_no("MODIFIED", modified(0) || modified(1));
  out.yes_or_no("FRICTION", mesh.friction.acts());
  out("BEARINGS", mesh.on_bearings() ? "elastic" : "rigid");
  for (auto& level : traits(scene.fidelity)) able.push_back(std::move(level));
  out.yes_or_no("RINGS_DOWN", not_taken("impact", able).empty());
}

}  // namespace

std::string scene_fragment(const Scene& scene, const System& layout, const std::string& path,
                           const std::string& stem, const BodyHashes& bodies) {
  const Traits able = traits(scene, layout);
  Fragment out(path, stem);
  out("KIND", scene.pair() ? "pair" : scene.rigid() ? "rigid" : "train");
  if (!scene.pair()) out.yes_or_no("PLANETS", !has(able, Trait::no_planets));
  if (scene.rigid()) return out.words();
  out.gears(bodies, scene.pair() ? scene.operation.torques : std::vector{input_torque(layout)});
  out.yes_or_no("MOVES", scene.pair() ? not_taken("sweep", able).empty() : !has(able, Trait::no_speeds));
  out("WIDTH", has(able, Trait::pair) ? WidthModel::one : scene.fidelity.width);
  out("TEETH", teeth_words(able));
  if (scene.pair()) {
    add_pair(out, scene, able);
  } else {
    std::string meshes;
    for (size_t m = 0; m < layout.meshes.size(); ++m) meshes += (m > 0 ? " " : "") + mesh_name(layout, m);
    out("MESHES", meshes);
  }
  return out.words();
}

}  // namespace whine
