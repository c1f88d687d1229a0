// gear-modes: natural frequencies and mode shapes of a system of gears and carriers.
//
// Reads   params (the system as laid out: bodies, bearings, meshes, what is held) or, of elastic gears, static.h5
// Writes  modes.h5   natural frequencies, types, shapes, where the energy of each mode is; under /VTKHDF the gears with what each mode
//                    moves them by, for ParaView (modes.hdf is a link to it)
// Equations: K v = w^2 M v, meshes frozen, at their mean stiffness (common/system/natural_modes.h); over the speed of a carrier that turns
//            with its Coriolis and centrifugal terms (common/system/turning_modes.h)
#include <string>
#include <vector>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "results/modes.h"
#include "results/static.h"
#include "system/mode_view.h"
#include "system/natural_modes.h"
#include "system/turning_modes.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"Natural frequencies and mode shapes of a system of gears and carriers",
                         "gear-modes"};
  std::string params, statics, output;
  whine::Option of_params = options.add(
      "--params", params, "of rigid gears: stage parameters of the scene, out/<scene>/params/modes.toml");
  options.add("--static", statics, "of elastic gears: static.h5, whose stiffness and masses are taken")
      .excludes(of_params);
  options.add("--output", output, "modes.h5 to write").required();
  options.footer(
      "Examples:\n"
      "  gear-modes --params out/lin-parker-planetary/params/modes.toml --output modes.h5\n"
      "  gear-modes --static out/three-in-line/T60/static.h5 --output modes.h5");
  options.parse(argc, argv);

  if (params.empty() && statics.empty())
    whine::fail(whine::Failure::usage, "give --params or --static; see --help");
  const whine::Provenance provenance =
      whine::made_by(argc, argv, {statics.empty() ? "params=" + params : "static=" + statics});
  whine::ModesResult result;
  if (statics.empty()) {
    result = whine::natural_modes(whine::read_system_parameters(params));
    whine::add_turning_frequencies(result, {});
    whine::add_mode_view(result, std::vector<const whine::GearDesign*>(result.layout.bodies.size(), nullptr));
  } else {
    const whine::SystemStaticResult rest = whine::read<whine::SystemStaticResult>(statics);
    result = whine::elastic_modes(rest);
    whine::add_mode_view(result, whine::designs_of(rest));
  }
  whine::write(output, result, provenance);
  std::string first;
  int still = 0;
  for (Eigen::Index i = 0; i < result.natural_frequency.size(); ++i) {
    if (result.natural_frequency[i] == 0) ++still;
    if (result.natural_frequency[i] > 0 && first.empty())
      first = whine::text(result.natural_frequency[i], " Hz (", name_of(result.type[static_cast<size_t>(i)]),
                          ")");
  }
  whine::log_line("gear-modes: ", result.layout.bodies.size(), " bodies, ", result.layout.meshes.size(),
                  " meshes, ", result.natural_frequency.size(), " modes, ", still,
                  " of them free motions; the lowest other: ", first.empty() ? "none" : first, " -> ",
                  output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
