// gear-runup: the motion of a pair or a train while its speed changes with time, through jumps, contact loss and transients.
//
// Reads   params (stage parameters of sweeps of a scene: damping, inertia, speeds, fidelity, time), body.h5 of all gears;
//         of a pair also static.h5 of the torque (mesh, contact discretisation) and static.h5 of the reference torque (mean stiffness
//         of the dampers)
// Writes  runup.h5    transmission errors, mesh and bearing forces, tooth loads over time, and per mesh period RMS, largest
//         tooth load and loss of contact of each mesh; written as it comes
// Equations: those of gear-sweep; mesh frequency f(t) = from + a t, a = rate / 60 x mesh periods in a revolution of the input
#include <string>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/pair_inputs.h"
#include "io/runup_file.h"
#include "io/scene.h"
#include "io/stage_command.h"
#include "studies/runup.h"

namespace {

using namespace whine;

// runup.h5; at its end it prints the torques of acceleration and whether back flanks would touch.
class RunupFileWithNotes : public RunupFile {
 public:
  using RunupFile::RunupFile;
  void end(const RunupResult& tail) override {
    RunupFile::end(tail);
    if (!tail.of_train()) log_torques(tail);
    if (tail.backlash_margin <= 0)
      log_line("gear-runup: warning: the motion goes up to ", -tail.backlash_margin * 1e6,
               " µm beyond the backlash; back flanks would touch there, which is not modelled");
  }

 private:
  static void log_torques(const RunupResult& tail) {
    const auto torque = acceleration_torque(tail);
    for (size_t g = 0; g < kSides; ++g)
      if (const double own =
              tail.torque *
              (g == 0 ? 1.0 : static_cast<double>(tail.gear[1].design.teeth) / tail.gear[0].design.teeth);
          torque[g] > 0.01 * own)
        log_line("gear-runup: accelerating ", tail.mesh.gear[g], " takes ", torque[g], " N m, ",
                 100 * torque[g] / own,
                 " % of its torque; its own shaft is taken to supply this, so the mesh does not carry it");
  }
};

// Ends of the ramp that are not given are those of the scene's speeds.
template <class Settings>
void complete_ramp(SpeedRamp& ramp, const Settings& scene, const std::string& way) {
  const bool up = way == "up";
  if (ramp.from == 0) ramp.from = up ? scene.frequency_from : scene.frequency_to;
  if (ramp.to == 0) ramp.to = up ? scene.frequency_to : scene.frequency_from;
  if ((ramp.to > ramp.from) != up)
    fail(Failure::usage, "--direction ", way, ": the ramp goes from ", ramp.from, " to ", ramp.to,
         " Hz; exchange --from and --to, or give the other direction");
}

void body(int argc, char** argv) {
  Options options{"Motion of a pair or a train while its speed changes with time", "gear-runup"};
  StageCommand stage(options, "sweep.toml", StageCommand::Reads::bodies_and_rest);
  RunupSettings wanted;
  options
      .add("--rate", wanted.ramp.rate,
           "rpm/s by which the speed of the driver, of a train of its input, changes, above 0")
      .required();
  options.add("--from", wanted.ramp.from, "mesh frequency at the start in Hz; 0: an end of the scene's");
  options.add("--to", wanted.ramp.to, "mesh frequency at the end in Hz; 0: the other end");
  std::string way = "up";
  options.add("--direction", way, "up or down; with --from and --to it must be theirs")
      .one_of({"up", "down"});
  options.add("--sample-rate", wanted.sample_rate, "Hz of the samples").show_default();
  stage.add_output("runup.h5").required();
  options.footer(
      "Example:\n"
      "  gear-runup --params out/parker2000/params/sweep.toml --body pinion=out/parker2000/pinion/body.h5 --body wheel=out/parker2000/wheel/body.h5 --static out/parker2000/T150/static.h5 --reference-static out/parker2000/T100/static.h5 --rate 1000 --output runup.h5");
  options.parse(argc, argv);
  if (!(wanted.sample_rate >= 1000 && wanted.sample_rate <= 1e6))
    fail(Failure::usage, "--sample-rate ", wanted.sample_rate, ": 1000 to 1000000 Hz");

  const bool of_train = stage.of_train();
  RunupFileWithNotes file(stage.output(), stage.made_by(argc, argv));
  const StepsDone report(text("gear-runup ", way));
  std::string operating_point;
  if (of_train) {
    const SystemSweepParameters settings = read_system_sweep_parameters(stage.params());
    complete_ramp(wanted.ramp, settings, way);
    runup(settings, read_bodies(stage.bodies(), settings), wanted, file, report);
  } else {
    SweepParameters settings = read_sweep_parameters(stage.params());
    const PairInputs inputs = read_pair_inputs(stage.bodies(), stage.statics(), stage.reference(), settings);
    complete_ramp(wanted.ramp, settings, way);
    operating_point = text(inputs.at_torque.torque, " N m, ");
    runup(inputs.body[0], inputs.body[1], inputs.at_torque, inputs.at_reference.mean_stiffness, settings,
          wanted, file, report);
  }
  log_line("gear-runup: ", operating_point, wanted.ramp.from, " to ", wanted.ramp.to, " Hz at ",
           wanted.ramp.rate, " rpm/s -> ", stage.output());
}

}  // namespace

int main(int argc, char** argv) {
  return run_tool(argc, argv, body);
}
