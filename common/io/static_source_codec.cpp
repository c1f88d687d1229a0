#include "io/static_source.h"

#include <algorithm>

#include "base/error.h"
#include "io/codec.h"
#include "io/keys.h"
#include "io/system_motion_codec.h"

namespace whine {
namespace {

using namespace ranges;

const LayoutPlace kPlaceOfLayout{"/layout", ""};

// [gear.<name>.modification], of gears that have one.
void describe_modification(Codec& c, const std::string& gear, SystemStaticParameters& s) {
  if (c.lists()) return;
  FlankModification modification = s.modification(gear);
  if (c.optional("/parameters/modification_" + gear + "/tip_relief", modification.of_profile()))
    c.parameters("modification_" + gear, keys(modification));
  if (c.optional("/parameters/lead_" + gear + "/lead_crowning", !modification.lead.none()))
    c.parameters("lead_" + gear, keys(modification.lead));
  if (c.in()) s.modify(gear, modification);
}

// Gears by name and what bodies and meshes are of them; [[mesh]] and [gear.<name>] of the scene as parameters.
void describe_settings(Codec& c, SystemStaticResult& a) {
  SystemStaticParameters& s = a.settings;
  std::vector<std::string> gears = s.gears();
  c(s.gear, "/layout/body/gear", "body", "name of its gear in the scene; empty of a carrier");
  c(gears, "/gear", "gear_number", "names of the gears of the scene, of a train");
  describe_sections(c, s.section, kPlaceOfLayout);
  c.parameters("fidelity", keys(s.fidelity).only({"contact", "width"}));
  c.parameters("discretisation", keys(s.contact));
  if (c.in()) {
    s.mesh.resize(s.section.empty()
                      ? 0
                      : static_cast<size_t>(*std::max_element(s.section.begin(), s.section.end())) + 1);
    a.drawing.resize(gears.size());
    for (const std::string& name : gears) s.body.emplace_back(name, "");
  }
  // Modifications are written gear by gear, errors body by body, friction, which is that of all meshes, once.
  for (size_t m = 0; m < s.mesh.size(); ++m)
    c.parameters("mesh_" + std::to_string(m), keys(s.mesh[m]).section("mesh"));
  Friction friction = s.friction();
  if (!c.lists() && c.optional("/parameters/friction/law", friction.acts())) {
    c.parameters("friction", keys(friction));
    if (c.in()) s.set_friction(friction);
  }
  for (size_t g = 0; g < gears.size(); ++g) {
    describe_gear(c, "gear_" + gears[g], a.drawing[g]);
    describe_modification(c, gears[g], s);
  }
  describe_errors(c, s.layout, s.errors, kPlaceOfLayout);
}

// What figures and pages take for granted: at least one mesh, and of each gear the drawing with its teeth.
void require_drawings(const Codec& c, const SystemStaticResult& a) {
  const auto reject = [&](const auto&... words) { c.in()->reject(text(words...)); };
  const System& layout = a.settings.layout;
  if (layout.meshes.empty()) reject("dataset /layout/mesh/phase holds no mesh");
  if (a.settings.gear.size() != layout.bodies.size())
    reject("dataset /layout/body/gear has not one name for each body");
  const std::vector<std::string> gears = a.settings.gears();
  for (size_t b = 0; b < layout.bodies.size(); ++b) {
    const bool carrier = layout.bodies[b].kind == System::BodyKind::carrier;
    if (carrier ? !a.settings.gear[b].empty()
                : std::find(gears.begin(), gears.end(), a.settings.gear[b]) == gears.end())
      reject("dataset /layout/body/gear holds '", a.settings.gear[b], "' of body ", b,
             "; it is one of /gear, or empty of a carrier");
    if (const BodyParameters* drawing = drawing_of(a, static_cast<int>(b));
        !carrier && drawing->design.teeth != layout.bodies[b].teeth)
      reject("dataset /layout/body/teeth holds ", layout.bodies[b].teeth, " of body ", b,
             ", and its drawing has ", drawing->design.teeth);
  }
}

}  // namespace

void describe_static_source(Codec& c, SystemStaticResult& a) {
  describe_layout(c, a.settings.layout, kPlaceOfLayout);
  describe_names(c, a.mesh_names, a.body_names);
  if (!c.out()) a.mesh.resize(c.in() ? a.mesh_names.size() : 1);
  if (c.lists() || a.of_train()) describe_settings(c, a);
  if (c.in() && a.of_train()) require_drawings(c, a);
  if (a.of_train()) return;
  describe_pair(c, a.mesh[0]);
  describe_torque(c, a.mesh[0].torque);
  if (c.in()) a.take_pair(a.settings.layout);
}

}  // namespace whine
