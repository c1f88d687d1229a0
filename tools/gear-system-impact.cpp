// gear-system-impact: natural frequencies and damping of a system of elastic gears by ring-down, at a series of fixed mesh phases.
//
// Reads   params (those of sweeps: the system as laid out, meshes, damping, fidelity), body.h5 of every gear
// Writes  system_impact.h5   frequency and damping ratio of the lowest modes by decay and by eigenvalue, at each phase; beside them
//                            the natural frequencies of rigid gears on the mean stiffnesses of the meshes
// Equations: common/dynamics/system_dynamics.h (Eq. 1-6 in modes of the hub-fixed bodies, Eq. 18 at the end of each step), Eq. 21
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/named_files.h"
#include "io/provenance.h"
#include "io/system_scene.h"
#include "results/system_impact.h"
#include "studies/system_impact.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"Natural frequencies and damping of a system at fixed mesh phases by ring-down",
                         "gear-system-impact"};
  std::string params, output;
  std::vector<std::string> bodies;
  whine::SystemImpactPlan plan;
  std::string impulse = whine::text(plan.impulse);
  options.add("--params", params, "stage parameters of the scene: out/<scene>/params/system_sweep.toml")
      .required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--modes", plan.modes, "modes of the lowest frequencies").show_default();
  options.add("--phases", plan.phases, "mesh phases at which the gears stay").show_default();
  options
      .add("--impulse", impulse,
           "size of the vibration over the deflection at rest, by the roots of their energies, up to 0.1")
      .show_default();
  options.add("--output", output, "system_impact.h5 to write").required();
  options.footer(
      "Example:\n"
      "  gear-system-impact --params out/three-in-line/params/system_sweep.toml --body pinion=out/three-in-line/pinion/body.h5 --body idler=out/three-in-line/idler/body.h5 --body wheel=out/three-in-line/wheel/body.h5 --output system_impact.h5");
  options.parse(argc, argv);
  plan.impulse = whine::number_option("--impulse", impulse);

  const whine::NamedFiles files("--body", bodies);
  const whine::Provenance provenance = whine::made_by(argc, argv, files.and_inputs({"params=" + params}));
  const whine::SystemSweepParameters settings = whine::read_system_sweep_parameters(params);
  const std::vector<whine::ReducedBody> gears = whine::read_bodies(files, settings);
  std::optional<whine::Progress> progress;
  const whine::SystemImpactResult result =
      whine::system_impact(settings, gears, plan, [&](long done, long total) {
        if (!progress) progress.emplace("gear-system-impact", total);
        progress->update(done, "");
      });
  progress.reset();

  whine::write(output, result, provenance);
  const Eigen::VectorXd lowest = result.natural_frequency.col(0), ratio = result.damping_ratio.col(0);
  whine::log_line("gear-system-impact: ", result.mesh_phase.size(), " phases, ", result.damping_ratio.cols(),
                  " modes, the lowest at ", lowest.minCoeff(), " to ", lowest.maxCoeff(), " Hz with ",
                  ratio.minCoeff() * 100, " to ", ratio.maxCoeff() * 100, " % -> ", output);
  constexpr double kUnresolved = 1e-4;  // a ratio is then off by some of its digits
  if (const auto rough = (result.fit_residual.array() > kUnresolved).count(); rough > 0)
    whine::log_line(
        "gear-system-impact: warning: ", rough, " of ", result.fit_residual.size(),
        " decays are no sum of exponentials (/fit_residual); take a smaller --impulse, or the eigenvalues (/eigen_damping_ratio)");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
