#include "model/scene.h"

#include <numbers>

#include "base/error.h"

namespace whine {

const SceneGear& Scene::gear(const std::string& name) const {
  for (const SceneGear& candidate : gears) {
    if (candidate.name == name) return candidate;
  }
  fail(Failure::input, "the scene has no gear '", name, "'");
}

void require_like_teeth(const GearMeshSpec& mesh, const GearDesign& driver, const GearDesign& driven,
                        const std::string& stage) {
  for (int g = 0; g < kSides; ++g)
    if ((g ? driven : driver).crack.depth > 0)
      fail(Failure::input, stage, " does not take a cracked tooth: [gear.", mesh.gear[g],
           ".crack]; use a scene without this section, or a sweep, which covers the turn of the gear");
  for (int g = 0; g < kSides; ++g)
    if (!mesh.errors[g].none())
      fail(Failure::input, stage, " does not take teeth that differ: [gear.", mesh.gear[g],
           ".error] gives the ", g ? "driven gear" : "driver",
           " deviations tooth by tooth; use a scene without this section");
}

void require_rigid_bearings(const GearMeshSpec& mesh, const std::string& stage) {
  for (int g = 0; g < kSides; ++g)
    if (mesh.bearing[g].elastic())
      fail(Failure::input, stage, " is of gears on rigid axes, and [gear.", mesh.gear[g],
           "] is on a bearing of ", mesh.bearing[g].stiffness * 1e-6,
           " N/µm; take a scene without [[bearing]]");
}

void require_no_friction(const GearMeshSpec& mesh, const std::string& stage) {
  if (mesh.friction.acts())
    fail(Failure::input, stage, " knows no friction, and the scene has [friction]; take the section out");
}

void require_external(const GearMeshSpec& mesh, const GearDesign& driver, const GearDesign& driven,
                      const std::string& stage) {
  for (int g = 0; g < 2; ++g)
    if ((g ? driven : driver).internal)
      fail(Failure::input, stage, " is of external gears, and [gear.", mesh.gear[g],
           "] is internal; take a scene without internal gears");
}

std::string face_words(const GearMeshSpec& mesh, const GearDesign& driver, const GearDesign& driven) {
  for (int g = 0; g < kSides; ++g)
    if (const GearDesign& design = g ? driven : driver; design.helical())
      return text("[gear.", mesh.gear[g],
                  "] is helical (helix_angle_deg = ", design.helix_angle * 180 / std::numbers::pi, ")");
  if (mesh.misalignment != 0) return text("[[mesh]] has misalignment_um = ", mesh.misalignment * 1e6);
  if (mesh.face_offset != 0) return text("[[mesh]] has face_offset_mm = ", mesh.face_offset * 1e3);
  for (int g = 0; g < kSides; ++g)
    if (!mesh.modification[g].lead.none())
      return text("[gear.", mesh.gear[g], ".modification] takes material off along the face");
  return "";
}

void require_one_slice(const GearMeshSpec& mesh, const GearDesign& driver, const GearDesign& driven) {
  if (const std::string words = face_words(mesh, driver, driven); !words.empty())
    fail(
        Failure::input, words,
        ", and what is asked for is computed in one slice over the face, of spur gears under even load; the pair at rest, its sweeps, branches and run-ups are computed with width = \"slices\" in [fidelity]");
}

}  // namespace whine
