// gear-system-static: a system of elastic gears at rest over one mesh period, or over the hunting period of teeth that differ.
//
// Reads   params (the system as laid out, meshes, contact discretisation), body.h5 of every gear
// Writes  system_static.h5   transmission error of each mesh, loads, load sharing, bearing forces, torques, certificate
// Equations: d = e + A p - D x >= 0, p >= 0, p . d = 0 (Eq. 18) with L^T p = T / r (Eq. 20) of every body that is not held
// (common/system/system.h)
#include <optional>
#include <string>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/named_files.h"
#include "io/provenance.h"
#include "io/system_scene.h"
#include "results/system_static.h"
#include "system/system_rest.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"A system of elastic gears at rest over one mesh period", "gear-system-static"};
  std::string params, output;
  std::vector<std::string> bodies;
  options.add("--params", params, "stage parameters of the scene: out/<scene>/params/system_static.toml")
      .required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--output", output, "system_static.h5 to write").required();
  options.footer(
      "Example:\n"
      "  gear-system-static --params out/three-in-line/params/system_static.toml --body pinion=out/three-in-line/pinion/body.h5 --body idler=out/three-in-line/idler/body.h5 --body wheel=out/three-in-line/wheel/body.h5 --output system_static.h5");
  options.parse(argc, argv);

  const whine::NamedFiles files("--body", bodies);
  const whine::Provenance provenance = whine::made_by(argc, argv, files.and_inputs({"params=" + params}));
  const whine::SystemStaticParameters settings = whine::read_system_static_parameters(params);
  const std::vector<whine::ReducedBody> gears = whine::read_bodies(files, settings);
  std::optional<whine::StepsShown> steps(std::in_place, "gear-system-static");
  const whine::SystemStaticResult result = whine::system_at_rest(settings, gears);
  steps.reset();

  whine::write(output, result, provenance);
  const auto& te = result.transmission_error_harmonic;
  double most = 0;
  for (const whine::MatrixRM& force : result.bearing_force)
    most = std::max(most, force.rowwise().norm().maxCoeff());
  if (result.hunting_periods > 1)
    whine::log_line("gear-system-static: teeth differ: ", result.hunting_periods,
                    " mesh periods, after which the same ones meet, of ", settings.contact.positions,
                    " positions each");
  whine::log_line("gear-system-static: ", settings.layout.bodies.size(), " bodies, ", te.cols(),
                  " meshes, mean transmission errors ", te.row(0).minCoeff() * 1e6, " to ",
                  te.row(0).maxCoeff() * 1e6, " µm, shares of the load up to ",
                  result.load_share.maxCoeff() * 100, " %, bearing forces up to ", most, " N -> ", output);
  for (const whine::Remark& remark : result.remarks)
    whine::log_line("gear-system-static: ", remark.warning ? "warning: " : "", remark.words);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
