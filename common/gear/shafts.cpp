#include "gear/shafts.h"

#include "base/error.h"
#include "base/tool.h"
#include "gear/system_layout.h"

namespace whine {

std::vector<Shaft> shafts_of(const System& system) {
  const TrainSpeeds speeds = train_speeds(system);
  std::vector<Shaft> out;
  out.reserve(system.bodies.size());
  for (size_t b = 0; b < system.bodies.size(); ++b) {
    const System::Body& body = system.bodies[b];
    const std::string with = body.on != System::kGround ? "on its pin"
                             : speeds.at_rest.empty()   ? ""
                                                        : speeds.at_rest + " at rest";
    out.push_back({body.name, speeds.turns[b], "", with});
  }
  return out;
}

std::vector<Shaft> shafts_of(const std::array<std::string, kSides>& gears,
                             const std::array<int, kSides>& teeth) {
  return {{gears[0], 1.0 / teeth[0], kRole[0]}, {gears[1], 1.0 / teeth[1], kRole[1]}};
}

const Shaft& shaft_called(const std::string& axis, const std::vector<Shaft>& shafts,
                          const std::string& said) {
  constexpr std::string_view kKind = "rpm:";
  if (!axis.starts_with(kKind)) fail(Failure::usage, said, ": it is rpm:<gear>, such as rpm:driver");
  const std::string name = axis.substr(kKind.size());
  std::string known, roles;
  for (const Shaft& shaft : shafts) {
    if (name != shaft.gear && (shaft.role.empty() || name != shaft.role)) {
      known += (known.empty() ? "" : ", ") + shaft.gear;
      if (!shaft.role.empty()) roles += (roles.empty() ? ", also called " : " and ") + shaft.role;
      continue;
    }
    if (shaft.turns == 0)
      fail(Failure::usage, said, ": ", shaft.gear, " stands still; take a gear or carrier that turns");
    return shaft;
  }
  fail(Failure::usage, said, ": there is no gear ", printable(name, 80), "; there are ", known, roles);
}

}  // namespace whine
