// gear-static: transmission error, mesh stiffness and tooth loads of two gears at rest, over one mesh period.
//
// Reads   params (slice of a scene: mesh, contact discretisation), body.h5 of driver and driven gear
// Writes  static.h5   transmission error, secant and tangent stiffness, load of each pair, harmonics, certificate
// Equations: d = A p + C q + e >= 0, p >= 0, p . d = 0 (Eq. 18) with B p = lambda (Eq. 20); k = (T / r_b) / STE.
// Example: gear-static --params out/parker2000/params/static.toml --driver out/parker2000/pinion/body.h5
//            --driven out/parker2000/wheel/body.h5 --torque 150 --output out/parker2000/T150/static.h5
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "base/error.h"
#include "base/tool.h"
#include "files/fit.h"
#include "files/scene.h"
#include "files/schemas.h"
#include "motion/statics.h"
#include "signal/spectrum.h"

namespace {

Eigen::VectorXd mean_and_harmonics(const Eigen::VectorXd& samples) {
  const int count = whine::resolved_harmonics(samples.size(), 40);
  const whine::Harmonics h = whine::harmonics(samples, count);
  Eigen::VectorXd out(count + 1);
  out << h.mean, h.amplitude;
  return out;
}

void body(int argc, char** argv) {
  CLI::App app{"Static transmission error, mesh stiffness and tooth loads over a mesh period", "gear-static"};
  std::string params, driver, driven, output;
  std::string torque_word;
  app.add_option("--params", params, "slice of the scene: out/<scene>/params/static.toml")->required();
  app.add_option("--driver", driver, "body.h5 of the driving gear")->required();
  app.add_option("--driven", driven, "body.h5 of the driven gear")->required();
  app.add_option("--torque", torque_word, "torque on the driver in N m, above 0")->required();
  app.add_option("--output", output, "static.h5 to write")->required();
  whine::parse(app, argc, argv);

  const double torque = whine::number_option("--torque", torque_word);
  const whine::StaticSlice slice = whine::read_static_slice(params);
  const whine::BodyArtifact driver_body = whine::read_body(driver), driven_body = whine::read_body(driven);
  whine::require_body(driver_body, slice.driver_body, "driver", driver);
  whine::require_body(driven_body, slice.driven_body, "driven", driven);
  whine::StaticArtifact result = whine::static_transmission(driver_body, driven_body, slice, torque);
  result.transmission_error_harmonic = mean_and_harmonics(result.transmission_error);
  result.stiffness_harmonic = mean_and_harmonics(result.stiffness_secant);

  whine::Provenance provenance;
  provenance.tool = whine::program_name(argv[0]);
  provenance.command = whine::command_line(argc, argv);
  provenance.inputs = {"params=" + params, "driver=" + driver, "driven=" + driven};
  whine::write(output, result, provenance);
  const auto& te = result.transmission_error;
  std::cerr << whine::text("gear-static: ", torque, " N m, contact ratio ", result.contact_ratio,
                           ", mean stiffness ", result.mean_stiffness * 1e-6, "e6 N/m, transmission error ",
                           te.minCoeff() * 1e6, " to ", te.maxCoeff() * 1e6, " um -> ", output)
            << '\n';
  if (slice.mesh.corner.enabled == false)
    std::cerr << "gear-static: corner contact is off: only pairs on the line of action carry load\n";
  if (result.driver.tooth_thinning + result.driven.tooth_thinning > 0 && result.backlash_margin <= 0)
    std::cerr << whine::text("gear-static: warning: the backlash is used up by ",
                             -result.backlash_margin * 1e6,
                             " um; back flanks would touch, which is not modelled\n");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
