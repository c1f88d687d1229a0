// gear-modes: natural frequencies and mode shapes of a system of rigid gears and carriers.
//
// Reads   params (the system as laid out: bodies, bearings, meshes, what is held)
// Writes  modes.h5   natural frequencies, types, shapes, where the energy of each mode is
// Equations: K v = w^2 M v, meshes frozen at their mean stiffness (common/system/natural_modes.h)
#include <string>

#include "base/error.h"
#include "base/tool.h"
#include "io/modes_codec.h"
#include "io/provenance.h"
#include "io/system_scene.h"
#include "system/natural_modes.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"Natural frequencies and mode shapes of a system of rigid gears and carriers",
                         "gear-modes"};
  std::string params, output;
  options.add("--params", params, "stage parameters of the scene: out/<scene>/params/system.toml").required();
  options.add("--output", output, "modes.h5 to write").required();
  options.footer(
      "Example:\n"
      "  gear-modes --params out/lin-parker-planetary/params/system.toml --output modes.h5");
  options.parse(argc, argv);

  const whine::Provenance provenance = whine::made_by(argc, argv, {"params=" + params});
  const whine::ModesArtifact result = whine::natural_modes(whine::read_system_parameters(params));
  whine::write(output, result, provenance);
  std::string first;
  int still = 0;
  for (Eigen::Index i = 0; i < result.natural_frequency.size(); ++i) {
    if (result.natural_frequency[i] == 0) ++still;
    if (result.natural_frequency[i] > 0 && first.empty())
      first = whine::text(result.natural_frequency[i], " Hz (", name_of(result.type[static_cast<size_t>(i)]),
                          ")");
  }
  whine::tell("gear-modes: ", result.layout.bodies.size(), " bodies, ", result.layout.meshes.size(),
              " meshes, ", result.natural_frequency.size(), " modes, ", still,
              " of them free motions; the lowest other: ", first.empty() ? "none" : first, " -> ", output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
