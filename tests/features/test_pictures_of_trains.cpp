// No text in the pictures of trains is cut at an edge or lies on other text, with eight meshes.
#include <doctest/doctest.h>

#include "picture_inputs.h"
#include "report/engineering_axes.h"
#include "report/figure_list.h"
#include "report/system_picture.h"
#include "small_system.h"
#include "system/natural_modes.h"

using namespace whine;
using namespace whine::pictures;
using Eigen::Index;
using Eigen::VectorXd;

TEST_CASE("pictures of trains: no text is cut or lies on other text, eight meshes and long names") {
  Scene scene = planetary_train(4);
  for (SceneGear& gear : scene.gears) gear.name += "_of_the_first_stage_01";
  for (Scene::Mesh& mesh : scene.meshes)
    for (std::string& gear : mesh.spec.gear) gear += "_of_the_first_stage_01";
  scene.carriers[0].planet += "_of_the_first_stage_01";
  scene.carriers[0].name += "_of_the_first_stage_01";
  for (Scene::Drive& drive : scene.drives) drive.gear += "_of_the_first_stage_01";
  SystemStaticResult rest = small_system(scene);
  // Numbers of five digits, which differ over the mesh period.
  for (StaticResult& mesh : rest.mesh) {
    mesh.transmission_error = 23e-6 * (Eigen::VectorXd::Random(2).array() + 2);
    mesh.tooth_load = 12345 * (MatrixRM::Random(2, 3).array() + 2);
  }
  rest.mesh_force = 12345 * (MatrixRM::Random(2, 8).array() + 2);
  rest.load_share = 0.25 * (0.2 * MatrixRM::Random(2, 8).array() + 1);
  for (MatrixRM& all : rest.bearing_force)
    all = 12345 * (MatrixRM::Random(all.rows(), all.cols()).array() + 2);
  REQUIRE(rest.settings.layout.meshes.size() == 8);
  check(system_static_figure(rest), "system-static");
  check(system_load_sharing_figure(rest), "load-sharing");
  check(system_picture(rest), "system");
  const std::vector<ResponseResult> sweeps{small_response(rest, Direction::up),
                                           small_response(rest, Direction::down)};
  check(system_sweep_figure(sweeps), "system-sweep");
  Figure turned = system_sweep_figure(sweeps);
  apply({"rpm:" + scene.gears[0].name, 1e-6}, turned);
  check(turned, "system-sweep");
  Figure orders = order_figure(sweeps);
  check(orders, "order-cuts");
  apply({"rpm:" + scene.gears[0].name, 1e-6}, orders);
  check(orders, "order-cuts");
  // One speed: two motions of forces of five digits, and one where rising and falling speed agree.
  std::vector<SweepResult> motions{small_sweep(rest, Direction::up), small_sweep(rest, Direction::down)};
  check(train_history_figure(motions, 2000), "histories");
  for (SweepResult& a : motions) {
    const double size = a.direction == Direction::up ? 1 : 2;
    a.transmission_error.assign(2, size * 23e-6 * (MatrixRM::Random(64, 8).array() + 2));
    a.mesh_force.assign(2, 12345 * (MatrixRM::Random(64, 8).array() + 2));
    for (std::vector<MatrixRM>& of : a.bearing_force) of.assign(2, 12345 * MatrixRM::Random(64, 2));
  }
  const Figure two = train_history_figure(motions, 2000);
  CHECK(two.panels.size() == 12);
  check(two, "histories");
  const ModesResult modes = natural_modes(rest.settings.layout);
  check(modes_figure(modes), "modes");
  check(campbell_figure(modes), "campbell");
  BranchResult branch;
  static_cast<MotionSource&>(branch) = sweeps[0];
  constexpr Index n = 41;
  branch.mesh_frequency = VectorXd::LinSpaced(n, 1000, 9000);
  branch.dte_rms = 123e-6 * MatrixRM::Random(n, 8).cwiseAbs();
  branch.floquet_multiplier.assign(n, MatrixRM::Constant(3, 2, 0.9));
  branch.stable = Eigen::VectorXi::Ones(n);
  branch.stable.segment(10, 12).setZero();
  branch.fold_frequency = Eigen::Vector3d(2345.67, 3456.78, 4567.89);
  branch.fold_width = Eigen::Vector3d::Constant(0.4);
  branch.part = Eigen::VectorXi::Zero(n);
  branch.fold_smooth = Eigen::Vector3i(1, 0, 1);
  branch.fold_multiplier = MatrixRM::Ones(3, 2);
  check(branch_figure(branch, sweeps), "branch");
  check(multiplier_figure(branch), "multipliers");
  ImpactResult decay;
  static_cast<MotionSource&>(decay) = sweeps[0];
  decay.mesh_phase = Eigen::Vector2d(0, 0.5);
  decay.natural_frequency = decay.eigen_frequency = MatrixRM(2, 6);
  decay.damping_ratio = decay.eigen_damping_ratio = MatrixRM::Constant(2, 6, 0.0765);
  for (Index k = 0; k < 6; ++k)
    decay.natural_frequency.col(k).setConstant(1234.5 * static_cast<double>(k + 1));
  decay.eigen_frequency = decay.natural_frequency;
  decay.rigid_frequency = decay.natural_frequency.row(0).transpose();
  check(impact_figure(decay), "ring-down");
}
