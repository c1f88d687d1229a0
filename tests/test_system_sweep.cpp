// Sweeps of a planetary train: contact loss, energy, both ways, and the same bytes again.
#include <doctest/doctest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "gear/system_layout.h"
#include "io/system_scene.h"
#include "io/system_sweep_codec.h"
#include "planetary_train.h"
#include "relative.h"
#include "scene_file.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "studies/system_sweep.h"

using namespace whine;
using Eigen::Index;

namespace {

constexpr double kModule = 2.776e-3;

// Three planets, 26, 37 and 100 teeth, lightly damped; coarse bodies, each reduced once.
struct Train {
  SystemSweepParameters settings;
  std::vector<BodyArtifact> bodies;
};

const Train& train() {
  static const Train out = [] {
    SystemScene scene = planetary_train(3);
    const std::array teeth{26, 37, 100};
    const std::array stiffness{2e7, 3e8, 0.0};
    scene.fidelity = {BodyModel::modal, ContactModel::strips, Integrator::exact};
    scene.contact = {4, 12};
    scene.body.element_size = 3e-3;
    scene.body.modes = 15;
    Train train;
    for (size_t g = 0; g < 3; ++g) {
      SystemScene::Gear& gear = scene.gears[g];
      gear.design = rigid_gear(teeth[g], g == 2);
      if (g < 2) gear.design.bore_radius = (0.5 * teeth[g] - 5) * kModule;
      gear.material = {206e9, 0.3, 7850, true};
      gear.equivalent_mass = 0;
      gear.bearing = {stiffness[g], stiffness[g] > 0 ? 500.0 : 0.0, 0};
      train.bodies.push_back(
          reduce(make_sector_mesh(gear.design, scene.body), gear.material, scene.body.modes));
    }
    scene.carriers[0].bearing = {};
    for (SystemScene::Mesh& mesh : scene.meshes) mesh.spec.centre_distance = 0.5 * 63 * kModule;
    scene.drives = {{"sun", System::DriveKind::torque, 300, 0},
                    {"ring", System::DriveKind::held, 0, 0},
                    {"carrier", System::DriveKind::held, 0, 0}};
    scene.operation.frequency_from = 6600;
    scene.operation.frequency_to = 7200;
    scene.operation.frequency_step = 200;
    scene.damping.rayleigh_stiffness = 1e-6;
    scene.time.steps_per_period = 48;
    scene.time.min_sample_rate = 1;
    train.settings = sweep_parameters_of(scene, layout_of(scene));
    return train;
  }();
  return out;
}

std::string bytes_of(const SystemSweepArtifact& a) {
  const SceneFile place;
  const std::string path = place.path("") + ".h5";
  write(path, a, Provenance());
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

SystemSweepArtifact swept(Direction direction) {
  return system_sweep(train().settings, train().bodies, direction, [](auto&&...) {});
}

}  // namespace

TEST_CASE(
    "sweep of a planetary train: contact is lost, energy closes, both ways meet, two runs are identical") {
  const SystemSweepArtifact up = swept(Direction::up), down = swept(Direction::down);
  REQUIRE(up.mesh_frequency.size() == 4);
  CHECK(up.separation_fraction.maxCoeff() > 0.01);
  for (const SystemSweepArtifact* a : {&up, &down}) {
    CHECK(a->energy_imbalance.maxCoeff() < 1e-9);
    CHECK(a->least_gap > -1e-12);
    CHECK(a->energy.col(4).minCoeff() > 0);  // what bearings take
  }
  for (Index i = 0; i < 4; ++i) {
    CHECK(up.mesh_frequency[i] == down.mesh_frequency[3 - i]);
    if (up.period_multiple[i] == 0) continue;
    CHECK(up.residual[i] < 1e-5);
    // The sun is driven by its torque, in the mean of the vibration, too; sharing is equal in the mean.
    CHECK(up.mesh_force[static_cast<size_t>(i)].leftCols(3).rowwise().sum().mean() ==
          relative(300 / up.settings.layout.bodies[0].radius, 0.01));
    // Pins and sun and ring: the carrier has the sum of its pins.
    CHECK(up.bearing_force[5][static_cast<size_t>(i)] == up.bearing_force[1][static_cast<size_t>(i)] +
                                                             up.bearing_force[2][static_cast<size_t>(i)] +
                                                             up.bearing_force[3][static_cast<size_t>(i)]);
  }
  CHECK(bytes_of(up) == bytes_of(swept(Direction::up)));
}
