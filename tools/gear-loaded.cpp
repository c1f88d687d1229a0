// gear-loaded: both gears at rest in one mesh position, loaded: contact pressure, displacements and stresses.
//
// Reads      static.h5, body.h5 and mesh.h5 of driver and driven gear
// Writes     loaded_<phase>.h5   contact strips, tooth loads, root stresses, balance of moment and energy; under /VTKHDF both
//                       gears in their places for ParaView (loaded_<phase>.hdf is a link to it)
// Equations  d = A p + e >= 0, p >= 0, p . d = 0 (Eq. 18); K x = f of the whole gear, by cyclic symmetry, with the half-planes
//            of the strips in closed form
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/named_files.h"
#include "io/pair_inputs.h"
#include "io/provenance.h"
#include "results/loaded.h"
#include "results/reduced_body.h"
#include "results/sector_grid.h"
#include "results/static.h"
#include "system/flank_pressure.h"
#include "system/loaded_pair.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"Loaded and deformed gears at one mesh position, with contact pressure and stresses",
                         "gear-loaded"};
  std::string statics_path, output;
  double position = 0;
  std::vector<std::string> bodies, meshes;
  options.add("--static", statics_path, "static.h5 of the pair at the torque").required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--mesh", meshes, "mesh.h5 of a gear in the same way").required();
  options
      .add(
          "--mesh-phase", position,
          "mesh phase, from 0 (reference pair at the pitch point) up to, not including, 1; with teeth that differ up to their hunting period")
      .required();
  options.add("--output", output, "loaded_<phase>.h5 to write").required();
  options.footer(
      "Example:\n  gear-loaded --static out/parker2000/T150/static.h5 --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --mesh pinion=out/parker2000/pinion/mesh.h5 --mesh wheel=out/parker2000/wheel/mesh.h5 --mesh-phase 0.25 --output loaded.h5");
  options.parse(argc, argv);

  const whine::NamedFiles body_files("--body", bodies), mesh_files("--mesh", meshes);
  const whine::Provenance provenance =
      whine::made_by(argc, argv, mesh_files.and_inputs(body_files.and_inputs({"static=" + statics_path})));
  const whine::StaticResult statics = whine::read_pair_statics(statics_path);
  const std::vector<std::string> body_paths = body_files.of(statics.mesh),
                                 mesh_paths = mesh_files.of(statics.mesh);
  std::optional<whine::StepsShown> steps(std::in_place, "gear-loaded");
  const whine::LoadedResult result = whine::loaded_pair(
      whine::read<whine::SectorGrid>(mesh_paths[0]), whine::read<whine::SectorGrid>(mesh_paths[1]),
      whine::read<whine::ReducedBody>(body_paths[0]), whine::read<whine::ReducedBody>(body_paths[1]), statics,
      position - std::floor(position), static_cast<int>(std::floor(position)));
  steps.reset();

  whine::write(output, result, provenance);
  const whine::LoadedPressure pressure = whine::largest_pressure(result);
  Eigen::Index pair = 0, gear = 0;
  result.root_stress.maxCoeff(&pair, &gear);
  const std::string& root_gear = result.mesh.gear[gear];
  whine::log_line("gear-loaded: ", result.torque, " N m, mesh phase ", result.mesh_phase, ", ",
                  result.pair.size(), " pairs, transmission error ", result.transmission_error * 1e6,
                  " µm, largest pressure inside a flank ", pressure.inside * 1e-6, " MPa, root stress ",
                  result.root_stress.maxCoeff() * 1e-6, " MPa of ", root_gear, "; hubs hold ",
                  result.hub_torque[0], " and ", result.hub_torque[1], " N m, strain energy ",
                  result.strain_energy.sum() / result.contact_work.sum(), " of the work -> ", output);
  if (pressure.at_edge > 0)
    whine::log_line("gear-loaded: warning: pair ", pressure.edge_pair, " touches at a tip edge with ",
                    pressure.edge_force,
                    " N. The edge is sharp here and pressure there has no largest value: the strips' ",
                    pressure.at_edge * 1e-6, " MPa grow as strips get finer; the force does not");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
