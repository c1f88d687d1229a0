// Times the steps of trains: of a pair on strips, of the same pair on lines as a pair and as a train of two gears, and of a train with
// several meshes. All take turns within each repeat, so that a slow spell of the machine hits all of them. Times are of CPU.
//
// Reads   stage parameters and body.h5 of a pair, the same of a train; writes a table on standard output.
// Example: make bench-train, make SCENE=data/scenes/oh58-planetary-carrier.toml bench-train
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/tool.h"
#include "dynamics/lines_motion.h"
#include "gear/system_layout.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/named_files.h"
#include "io/scene.h"
#include "rolling.h"
#include "signal/rms.h"
#include "system/rolling_mesh.h"

namespace {

using namespace whine;

constexpr int kRepeats = 31, kSettling = 300;  // mesh periods before the first time is taken
constexpr double kTurn = 5e-3;                 // s of CPU that a method takes in a repeat, at least

struct Row {
  std::string name;
  int meshes = 1, coordinates = 0, steps = 0;
  double carrying = 0, dte_rms = 0;  // contacts with force in the mean; m, of the first mesh
  std::function<void()> period;
  int periods = 1;              // in a turn
  std::vector<double> seconds;  // per step
};

double rms_of(const Eigen::VectorXd& x) {
  return std::sqrt((x.array() - x.mean()).square().mean());
}

double carrying(const Eigen::MatrixXd& forces, int steps) {
  return static_cast<double>((forces.array() > 0).count()) / steps;
}

// The pair, two gears and a mesh, in the words of trains.
SystemSweepParameters as_train(const std::array<ReducedBody, kSides>& body, const StaticParameters& statics,
                               const SweepParameters& pair, double torque) {
  Scene scene;
  for (size_t g = 0; g < kSides; ++g) {
    SceneGear gear;
    gear.name = statics.mesh.gear[g];
    gear.design = body[g].design;
    gear.material = body[g].material;
    gear.total_inertia = pair.inertia[g];
    scene.gears.push_back(gear);
  }
  scene.meshes.resize(1);
  scene.meshes[0].spec = statics.mesh;
  const double ratio = static_cast<double>(body[1].design.teeth) / body[0].design.teeth;
  scene.drives = {{scene.gears[0].name, System::DriveKind::torque, torque, 0},
                  {scene.gears[1].name, System::DriveKind::torque, -torque * ratio, 0}};
  scene.operation.frequency_from = pair.frequency_from;
  scene.operation.frequency_to = pair.frequency_to;
  scene.operation.frequency_step = pair.frequency_step;
  scene.fidelity = pair.fidelity;
  scene.fidelity.contact = ContactModel::line;
  scene.contact = statics.contact;
  scene.damping = pair.damping;
  scene.time = pair.time;
  return sweep_parameters_of(scene, layout_of(scene));
}

// A train that has settled at a speed (Hz).
Row train_row(const std::string& name, LinesMotion& train, SystemDynamics::State& state,
              SystemDynamics::Period& period, const TimeDiscretisation& time, double frequency) {
  SystemDynamics& dynamics = train.dynamics();
  Row row{name, dynamics.meshes(), dynamics.coordinates().size(), steps_at(time, frequency), 0, 0, {}, 1, {}};
  dynamics.set_speed(frequency, row.steps);
  state = dynamics.rest();
  row.period = [&] {
    if (!dynamics.integrate(state, period))
      fail(Failure::numerical, "the contact of the bench leaves the tip edges that are looked at");
  };
  for (int i = 0; i < kSettling; ++i) row.period();
  row.carrying = carrying(dynamics.forces().bottomRows(row.steps), row.steps);
  row.dte_rms = rms_of(period.transmission_error.row(0).transpose());
  return row;
}

Row pair_row(const std::string& name, RollingRig& rig, double frequency) {
  rig.run_to_orbit(frequency);
  Row row{name, 1, rig.sizes(0).coordinates, rig.steps, 0, 0, [&] { rig.integrate(nullptr); }, 1, {}};
  for (int i = 0; i < kSettling; ++i) row.period();
  row.carrying = carrying(rig.period.tooth_pair_load, row.steps);
  row.dte_rms = rms_of(rig.period.transmission_error);
  return row;
}

void take_times(std::vector<Row>& rows) {
  for (Row& row : rows) {
    const double start = cpu_now();
    row.period();
    row.periods = std::max(1, static_cast<int>(kTurn / std::max(cpu_now() - start, 1e-6)));
  }
  for (int repeat = 0; repeat < kRepeats; ++repeat)
    for (Row& row : rows) {
      const double start = cpu_now();
      for (int i = 0; i < row.periods; ++i) row.period();
      row.seconds.push_back((cpu_now() - start) / row.periods / row.steps);
    }
}

// Median over the repeats of the time over that of `other` in the same repeat.
double ratio_to(const Row& row, const Row& other) {
  std::vector<double> ratio(row.seconds.size());
  for (size_t i = 0; i < ratio.size(); ++i) ratio[i] = row.seconds[i] / other.seconds[i];
  std::nth_element(ratio.begin(), ratio.begin() + static_cast<long>(ratio.size() / 2), ratio.end());
  return ratio[ratio.size() / 2];
}

void body(int argc, char** argv) {
  Options options{"Times the steps of a pair, of the pair told as a train, and of a train",
                  "whine-bench-train"};
  std::string params, sweep_params, train_params;
  std::vector<std::string> bodies, train_bodies;
  double torque = 150, frequency = 3300;
  options.add("--params", params, "stage parameters of the pair: out/<scene>/params/static.toml").required();
  options.add("--sweep-params", sweep_params, "out/<scene>/params/sweep.toml of the pair").required();
  options.add("--body", bodies, "body.h5 of a gear of the pair as <gear>=<path>, once for each").required();
  options.add("--train-params", train_params, "stage parameters of sweeps of the train").required();
  options.add("--train-body", train_bodies, "body.h5 of a gear of the train as <gear>=<path>, once for each")
      .required();
  options.add("--torque", torque, "torque on the driver of the pair in N m").show_default();
  options.add("--frequency", frequency, "mesh frequency of the pair in Hz").show_default();
  options.parse(argc, argv);

  StaticParameters settings = read_static_parameters(params);
  SweepParameters motion = read_sweep_parameters(sweep_params);
  const std::vector<std::string> paths = NamedFiles("--body", bodies).of(settings.mesh);
  const std::array<ReducedBody, kSides> pair{read<ReducedBody>(paths[0]), read<ReducedBody>(paths[1])};
  motion.frequency_from = motion.frequency_to = frequency;
  const GearMeshModel model(pair[0], pair[1], settings.mesh);
  std::vector<Row> rows;
  std::vector<SweepParameters> of_contact;
  std::vector<std::unique_ptr<RollingRig>> rigs;
  of_contact.reserve(2);
  for (const ContactModel contact : {ContactModel::strips, ContactModel::line}) {
    of_contact.push_back(motion);
    settings.fidelity.contact = of_contact.back().fidelity.contact = contact;
    rigs.push_back(std::make_unique<RollingRig>(
        model, static_transmission(pair[0], pair[1], settings, torque), of_contact.back()));
    rows.push_back(
        pair_row(contact == ContactModel::strips ? "pair, strips" : "pair, lines", *rigs.back(), frequency));
  }
  LinesMotion told(as_train(pair, settings, motion, torque), {pair[0], pair[1]},
                   steps_at(motion.time, frequency));
  SystemDynamics::State told_state;
  SystemDynamics::Period told_period;
  rows.push_back(train_row("the pair as a train", told, told_state, told_period, motion.time, frequency));

  const SystemSweepParameters of_train = read_system_sweep_parameters(train_params);
  const double middle = 0.5 * (of_train.frequency_from + of_train.frequency_to);
  LinesMotion train(of_train, read_bodies(NamedFiles("--train-body", train_bodies), of_train),
                    steps_at(of_train.time, middle));
  SystemDynamics::State state;
  SystemDynamics::Period period;
  rows.push_back(train_row("train", train, state, period, of_train.time, middle));

  take_times(rows);
  std::printf("Steps in motion: the pair at %g N m and %g Hz, the train at %g Hz; %d repeats in turn\n",
              torque, frequency, middle, kRepeats);
  std::printf("  %-20s %6s %11s %8s %6s %8s %8s %11s %10s\n", "", "meshes", "coordinates", "carrying",
              "steps", "ns", "median", "over lines", "RMS um");
  for (Row& row : rows) {
    const double ratio = ratio_to(row, rows[1]);
    std::vector<double> seconds = row.seconds;
    std::sort(seconds.begin(), seconds.end());
    std::printf("  %-20s %6d %11d %8.2f %6d %8.0f %8.0f %11.2f %10.4f\n", row.name.c_str(), row.meshes,
                row.coordinates, row.carrying, row.steps, seconds.front() * 1e9,
                seconds[seconds.size() / 2] * 1e9, ratio, row.dte_rms * 1e6);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
