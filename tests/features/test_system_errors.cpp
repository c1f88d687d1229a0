// Systems whose teeth differ: both flanks of a tooth, the hunting period at rest and in motion, which planet meets which tooth.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/system_dynamics.h"
#include "figure_block.h"
#include "gear/flank_deviation.h"
#include "gear/layout.h"
#include "gear/system_layout.h"
#include "gear/tooth_errors.h"
#include "io/artifacts.h"
#include "io/publish.h"
#include "io/scene.h"
#include "mixed_errors.h"
#include "paper_pair.h"
#include "planetary_train.h"
#include "refusal.h"
#include "relative.h"
#include "report/figure_list.h"
#include "results/static.h"
#include "results/sweep.h"
#include "scene_file.h"
#include "signal/response.h"
#include "studies/branch.h"
#include "studies/sweep.h"
#include "studies/system_impact.h"
#include "system/system_rest.h"
#include "system/system_statics.h"

using namespace whine;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi, kMicrometre = 1e-6;

// Module 2 mm: 30, 20 and 40 teeth in line, the second one on a bearing, the third one held. Each reduced once, coarsely.
const std::array<int, 3> kTeeth{30, 20, 40};

GearDesign line_gear(int teeth) {
  GearDesign d = paper_gear(teeth, teeth * 1e-3 - 6e-3);
  d.module = 2e-3;
  d.face_width = 20e-3;
  return d;
}

Scene line(ContactModel contact = ContactModel::line) {
  Scene scene;
  const std::array<std::string, 3> name{"a", "b", "c"};
  for (size_t g = 0; g < 3; ++g) {
    SceneGear gear;
    gear.name = name[g];
    gear.design = line_gear(kTeeth[g]);
    gear.material = paper_steel();
    if (g == 1) gear.bearing = {200e6, 300, 0};
    scene.gears.push_back(gear);
  }
  for (size_t m = 0; m < 2; ++m) {
    Scene::Mesh mesh;
    mesh.spec.gear = {name[m], name[m + 1]};
    mesh.spec.centre_distance = (kTeeth[m] + kTeeth[m + 1]) * 1e-3;
    mesh.spec.corner.enabled = false;
    mesh.direction = m == 0 ? 0.3 : 1.1;
    scene.meshes.push_back(mesh);
  }
  scene.drives = {{"a", System::DriveKind::torque, 60, 0}, {"c", System::DriveKind::held, 0, 0}};
  scene.fidelity = {BodyModel::modal, contact, Integrator::exact};
  scene.contact = {4, 8};
  scene.body.element_size = 1.5e-3;
  scene.body.modes = 12;
  scene.damping.rayleigh_stiffness = 3e-6;
  scene.time.steps_per_period = 64;
  scene.time.min_sample_rate = 1;
  return scene;
}

std::vector<ReducedBody> line_bodies() {
  std::vector<ReducedBody> out;
  const Scene scene = line();
  for (const SceneGear& gear : scene.gears) out.push_back(kept_body(gear.design, gear.material, scene.body));
  return out;
}

SystemStaticResult rest_of(const Scene& scene) {
  return system_at_rest(static_parameters_of(scene, layout_of(scene)), line_bodies());
}

SweepResult swept(const Scene& scene) {
  return system_sweep(sweep_parameters_of(scene, layout_of(scene)), line_bodies(), Direction::up, no_report);
}

template <class Artifact>
std::string bytes_of(const Artifact& a) {
  const SceneFile place;
  const std::string path = place.path("") + ".h5";
  write(path, a, Provenance());
  return read_bytes(path);
}

// Of the teeth that meet in a mesh at a row, those of one side, that carry load.
std::vector<int> loaded_teeth(const SystemStaticResult& a, Index row, size_t m, size_t side) {
  const System::Mesh& mesh = a.settings.layout.meshes[m];
  const int before = static_cast<int>(std::floor(a.mesh_phase[row] + mesh.phase));
  const int teeth = a.settings.layout.bodies[static_cast<size_t>(mesh.side[side].body)].teeth;
  std::vector<int> out;
  for (Index p = 0; p < a.mesh[m].pair.size(); ++p)
    if (a.mesh[m].tooth_load(row, p) > 0) {
      const int tooth = mesh.side[side].first_tooth + mesh.side[side].sense * (a.mesh[m].pair[p] - before);
      out.push_back(((tooth % teeth) + teeth) % teeth);
    }
  return out;
}

}  // namespace

TEST_CASE(
    "both flanks of an eccentric toothing: at the reference circle the pitch of a circle that is displaced") {
  // A displacement by e towards A moves flanks at the angle t by e sin(A - t) along the circle, and by e cos(A - t) outwards, where
  // teeth are thicker by tan(alpha) of it on either flank.
  constexpr int kCount = 23;
  GearDesign design = paper_gear(kCount, 10e-3);
  const ToothGeometry gear(design);
  const double e = 1e-6, towards = 2 * kPi * 5.3 / kCount, alpha = design.pressure_angle,
               roll = std::tan(alpha);
  const Vec2 point = gear.flank_point(roll);
  const double half = std::atan2(point.y(), point.x()) - kPi / 2;  // from the middle of the tooth, leading
  for (const FlankSide side : {FlankSide::leading, FlankSide::trailing}) {
    const double sign = side == FlankSide::leading ? 1 : -1;
    ToothErrors eccentric, list;
    eccentric.eccentricity = e;
    eccentric.eccentric_tooth = 5.3;
    for (int i = 0; i < kCount; ++i) {
      const double at = towards - 2 * kPi * i / kCount - sign * half;
      list.cumulative_pitch.push_back(e * (std::sin(at) + sign * std::tan(alpha) * std::cos(at)));
    }
    const FlankDeviation one(gear, {}, eccentric, side), other(gear, {}, list, side);
    for (int i = 0; i < kCount; ++i) CHECK(std::abs(one.at(roll, i) - other.at(roll, i)) < 1e-10);
  }
}

TEST_CASE(
    "errors drawn within a class: each flank has its own, the wave of one revolution is that of one displacement") {
  ToothErrors errors;
  errors.iso_class = 6;
  const GearDesign design = paper_gear(400);
  const ToothDeviations leading = tooth_deviations(design, errors),
                        trailing = tooth_deviations(design, errors, FlankSide::trailing);
  CHECK(leading.profile_slope != trailing.profile_slope);
  // Of 400 teeth scatter moves the wave by little.
  CHECK(std::arg(wave_of(trailing.cumulative_pitch) / wave_of(leading.cumulative_pitch)) ==
        relative(2 * design.pressure_angle, 0.1));
  const FlankTolerances limit = iso_1328_tolerances(design, 6);
  const auto [least, largest] =
      std::minmax_element(trailing.cumulative_pitch.begin(), trailing.cumulative_pitch.end());
  CHECK(*largest - *least <= limit.cumulative_pitch);
}

TEST_CASE("two gears as a system have the transmission errors of the pair with the same errors, at rest") {
  for (const ContactModel contact : {ContactModel::line, ContactModel::strips}) {
    CAPTURE(contact);
    Scene scene = line(contact);
    scene.gears.pop_back();
    scene.meshes.pop_back();
    scene.gears[1].bearing = {};
    scene.meshes[0].spec.corner.enabled = true;
    scene.drives[1].gear = "b";
    scene.gears[0].errors = mixed(30);
    scene.gears[1].errors = mixed(20);
    const SystemStaticResult a = rest_of(scene);
    StaticParameters settings;
    settings.mesh = scene.meshes[0].spec;
    settings.mesh.errors = {mixed(30), mixed(20)};
    settings.fidelity.contact = contact;
    settings.contact = scene.contact;
    const StaticResult pair = static_transmission(line_bodies()[0], line_bodies()[1], settings, 60);
    CHECK(a.hunting_periods == 60);
    REQUIRE(a.mesh_phase.size() == pair.mesh_phase.size());
    CHECK(a.mesh_phase == pair.mesh_phase);
    const StaticResult& mesh = a.mesh[0];
    CHECK(mesh.pair == pair.pair);
    CHECK((mesh.transmission_error - pair.transmission_error).cwiseAbs().maxCoeff() < 1e-17);
    for (Index i = 0; i < a.mesh_phase.size(); ++i)
      CHECK((mesh.tooth_load.row(i) - pair.tooth_load.row(i)).norm() < 1e-9 * 60 / 30e-3);
    // What follows from the loads of a mesh, too.
    const auto close = [](const auto& one, const auto& other) {
      return (one - other).norm() <= 1e-8 * other.norm();
    };
    CHECK(mesh.unloaded_error == pair.unloaded_error);
    CHECK(close(mesh.stiffness_secant, pair.stiffness_secant));
    CHECK(mesh.mean_stiffness == relative(pair.mean_stiffness, 1e-8));
    CHECK(mesh.loss_factor == relative(pair.loss_factor, 1e-8));
    REQUIRE(mesh.root_stress_max.size() == kSides);
    for (size_t g = 0; g < kSides; ++g) CHECK(close(mesh.root_stress[g], pair.root_stress[g]));
    CHECK(close(mesh.root_stress_max, pair.root_stress_max));
    CHECK(mesh.flank_pressure.smooth == relative(pair.flank_pressure.smooth, 1e-8));
    CHECK(close(mesh.compliance.body, pair.compliance.body));
    CHECK(mesh.rectangular_wave.high == relative(pair.rectangular_wave.high, 1e-8));
  }
}

TEST_CASE("two gears as a system move as the pair with the same errors, from tooth to tooth") {
  GearMeshSpec spec = paper_statics(16).mesh;
  spec.errors = {mixed(50), mixed(50)};
  const ReducedBody& body = paper_body(40e-3, 1.2e-3, 12);
  SystemModel system(body, body, spec);
  system.layout.drives = {{0, System::DriveKind::torque, 150}, {1, System::DriveKind::torque, -150}};
  for (System::Body& of : system.layout.bodies) of.inertia = 0.0148;
  SystemMotion motion;
  motion.damping.rayleigh_stiffness = 7.7e-6;
  motion.fidelity = {BodyModel::modal, ContactModel::line, Integrator::exact};
  motion.axis_frequency = axis_frequency(system, 463e6 * Eigen::MatrixXd::Identity(1, 1));
  SystemDynamics dynamics(system, motion);
  constexpr int kSteps = 64;
  dynamics.set_positions({80e-6}, kSteps);
  CHECK(dynamics.hunting_periods() == 50);
  SystemDynamics::State state = dynamics.rest();

  const GearMeshModel model(body, body, spec);
  RollingDynamics pair(model, paper_parameters(463e6, BodyModel::modal, ContactModel::line));
  CandidateZone zone;
  zone.corner_gap = 80e-6;
  pair.set_zone(zone, kSteps);
  RollingDynamics::State rolling = pair.rest();
  SystemDynamics::Period a;
  RollingDynamics::Period b;
  dynamics.set_speed(1300, kSteps);
  pair.set_speed(1300, kSteps);
  double worst = 0, least = 1, most = 0;
  EnergyBalance energy;
  for (int n = 0; n < 110; ++n) {
    CHECK(state.period == n % 50);
    energy = {};
    REQUIRE(dynamics.integrate(state, a, &energy));
    REQUIRE(pair.integrate(rolling, b));
    CHECK(energy.imbalance < 1e-12 * energy.throughput);
    if (n < 60) continue;
    worst = std::max(worst,
                     (a.transmission_error.row(0).transpose() - b.transmission_error).cwiseAbs().maxCoeff());
    least = std::min(least, b.transmission_error.minCoeff());
    most = std::max(most, b.transmission_error.maxCoeff());
  }
  // As without errors: residual fields of their own.
  CHECK(worst < 1e-5 * (most - least));
}

TEST_CASE("an idler whose flanks stand all alike ahead is an idler that has turned: loads do not change") {
  for (const ContactModel contact : {ContactModel::line, ContactModel::strips}) {
    CAPTURE(contact);
    const SystemStaticResult plain = rest_of(line(contact));
    Scene scene = line(contact);
    const double ahead = 3 * kMicrometre;
    scene.gears[1].errors = pitch(20, ahead, 0);
    const SystemStaticResult a = rest_of(scene);
    CHECK(a.hunting_periods == 20);
    REQUIRE(a.mesh_phase.size() == 20 * 8);
    // The first mesh is closed by leading flanks that stand ahead, the second one opened by trailing ones.
    const double turned = ahead * std::cos(20 * kPi / 180);
    for (Index i = 0; i < a.mesh_phase.size(); ++i) {
      const auto changed = [&](size_t m) {
        return a.mesh[m].transmission_error[i] - plain.mesh[m].transmission_error[i % 8];
      };
      CHECK(std::abs(changed(0) + turned) < 1e-12);
      CHECK(std::abs(changed(1) - turned) < 1e-12);
      CHECK(std::abs(a.rotation(i, 0) - plain.rotation(i % 8, 0)) < 1e-12);
      CHECK((a.mesh_force.row(i) - plain.mesh_force.row(i % 8)).norm() < 1e-6 * plain.mesh_force(0, 0));
    }
  }
}

TEST_CASE(
    "an error of one idler tooth: felt in both meshes where that tooth carries load, and nowhere else") {
  const SystemStaticResult plain = rest_of(line());
  Scene scene = line();
  scene.gears[1].errors = pitch(20, 0, 3 * kMicrometre);
  const SystemStaticResult a = rest_of(scene);
  const Index n = plain.mesh_phase.size();
  std::array<int, 2> met{};
  std::array<double, 2> shift{};
  for (Index row = 0; row < a.mesh_phase.size(); ++row)
    for (size_t m = 0; m < 2; ++m) {
      const auto mesh = static_cast<Index>(m);
      const std::vector<int> teeth = loaded_teeth(a, row, m, m == 0 ? 1 : 0);
      const bool meets = std::find(teeth.begin(), teeth.end(), 0) != teeth.end();
      const double change =
          a.mesh[m].tooth_load.row(row).maxCoeff() - plain.mesh[m].tooth_load.row(row % n).maxCoeff();
      met[m] += meets;
      if (meets) shift[m] = std::max(shift[m], std::abs(change));
      // Teeth that stand back on the trailing flank may leave the contact, and then are not among those that carry load.
      if (!meets && m == 0) CHECK(std::abs(change) < 1e-5 * plain.mesh_force(0, 0));
      CHECK(a.mesh_force(row, mesh) == relative(plain.mesh_force(row % n, mesh), 1e-9));
    }
  // One of 20 teeth, in contact for the contact ratio of a mesh period.
  CHECK(met[0] >= 8);
  CHECK(met[0] <= 17);
  for (const double each : shift) CHECK(each > 0.1 * plain.mesh_force(0, 0));
}

TEST_CASE("a tooth of the sun that stands ahead: the planet that it meets carries more, all else balances") {
  Scene scene = planetary_train(4);
  scene.fidelity = {BodyModel::modal, ContactModel::line, Integrator::exact};
  scene.contact = {4, 6};
  std::vector<ReducedBody> bodies;
  BodyDiscretisation coarse;
  coarse.element_size = 3e-3;
  coarse.modes = 1;
  const std::array stiffness{0.0, 3e8, 0.0};
  for (size_t g = 0; g < 3; ++g) {
    SceneGear& gear = scene.gears[g];
    if (!gear.design.internal) gear.design.bore_radius = (0.5 * gear.design.teeth - 5) * gear.design.module;
    gear.material = {206e9, 0.3, 7850, true};
    gear.equivalent_mass = 0;
    gear.bearing = {stiffness[g], 0, 0};
    bodies.push_back(reduce(make_sector_mesh(gear.design, coarse), gear.material, 1));
  }
  scene.carriers[0].bearing = {};
  scene.drives = {{"sun", System::DriveKind::torque, 300, 0},
                  {"ring", System::DriveKind::held, 0, 0},
                  {"carrier", System::DriveKind::held, 0, 0}};
  const auto at_rest = [&] { return system_at_rest(static_parameters_of(scene, layout_of(scene)), bodies); };
  const SystemStaticResult plain = at_rest();
  scene.gears[0].errors = pitch(28, 0, 4 * kMicrometre);
  const SystemStaticResult a = at_rest();
  REQUIRE(a.hunting_periods == 28);
  REQUIRE(a.mesh_phase.size() == 28 * 6);
  const double force = 300 / ToothGeometry(scene.gears[0].design).base_radius();
  constexpr double kTipEdges = 2e-3;  // their normals are tilted against the line of action
  std::array<int, 4> met{};
  double most = 1;
  for (Index i = 0; i < a.mesh_phase.size(); ++i) {
    const auto row = static_cast<size_t>(i);
    CHECK(a.mesh_force.row(i).head(4).sum() == relative(force, kTipEdges));
    CHECK(a.bearing_force[row].topRows(6).colwise().sum().norm() < 1e-9 * force);
    double left = 0;
    for (const Index b : {Index{0}, Index{5}, Index{6}})
      left += a.settings.layout.bodies[static_cast<size_t>(b)].sense * a.torque(i, b);
    CHECK(std::abs(left) < 1e-8 * 300);
    int planets = 0;
    for (size_t m = 0; m < 4; ++m) {
      const std::vector<int> teeth = loaded_teeth(a, i, m, 0);
      if (std::find(teeth.begin(), teeth.end(), 0) == teeth.end()) continue;
      ++planets;
      ++met[m];
      // Of two planets opposite each other, which share alike with exact teeth.
      CHECK(plain.load_share(i % 6, static_cast<Index>(m)) ==
            relative(plain.load_share(i % 6, static_cast<Index>((m + 2) % 4)), 1e-9));
      const double more =
          a.load_share(i, static_cast<Index>(m)) / a.load_share(i, static_cast<Index>((m + 2) % 4));
      CHECK(more > 1);
      most = std::max(most, more);
    }
    CHECK(planets <= 1);
    if (planets == 0) CHECK((a.load_share.row(i) - plain.load_share.row(i % 6)).cwiseAbs().maxCoeff() < 1e-9);
  }
  CHECK(most > 1.05);
  // The figure: shares over the hunting period, tooth loads of the first mesh over its first whole mesh period.
  const Figure figure = system_load_sharing_figure(a);
  const FigureBlock &shares = block(figure, "share 1"), &loads = block(figure, "loads 1");
  CHECK(shares.rows.size() == 28 * 6 + 1);
  CHECK(shares.rows.back()[0] == 28);
  CHECK(loads.rows.front()[0] == 0);
  CHECK(loads.rows.back()[0] == 1);
  for (size_t i = 0; i < loads.rows.size(); ++i) {
    if (i > 0) CHECK(loads.rows[i][0] > loads.rows[i - 1][0]);
    double sum = 0;
    for (size_t c = 1; c < loads.rows[i].size(); ++c) sum += loads.rows[i][c];
    CHECK(sum > 0.9 * a.mesh_force.col(0).minCoeff());
    CHECK(sum < 1.1 * a.mesh_force.col(0).maxCoeff());
  }
  // Each planet meets it once in a turn of the sun, for the contact ratio of mesh periods.
  for (const int each : met) {
    CHECK(each >= 6);
    CHECK(each <= 12);
  }
}

TEST_CASE(
    "a hunting period of teeth that do not differ repeats the mesh period in motion; the same bytes again") {
  Scene scene = line();
  scene.operation.frequency_from = scene.operation.frequency_to = 1500;
  scene.operation.frequency_step = 100;
  scene.time.periodicity = 1e-9;
  const SweepResult plain = swept(scene);
  CHECK(plain.hunting_periods == 1);
  scene.gears[1].errors = pitch(20, 0, 1e-30);
  const SweepResult a = swept(scene);
  CHECK(a.hunting_periods == 20);
  CHECK(a.period_multiple[0] == 20);
  CHECK(a.periods[0] % 20 == 0);
  REQUIRE(a.transmission_error[0].rows() == 20 * 64);
  for (Index i = 0; i < 20 * 64; ++i) {
    CHECK((a.transmission_error[0].row(i) - plain.transmission_error[0].row(i % 64)).norm() <
          1e-7 * kMicrometre);
    CHECK((a.bearing_force[1][0].row(i) - plain.bearing_force[1][0].row(i % 64)).norm() < 1e-2);
  }
  CHECK(response(a).dte_rms(0, 1) == relative(response(plain).dte_rms(0, 1), 1e-7));

  scene.gears[1].errors = mixed(20);
  const SweepResult differ = swept(scene);
  CHECK(differ.energy_imbalance.cwiseAbs().maxCoeff() < 1e-9);
  CHECK(differ.least_gap > -1e-13);
  CHECK(response(differ).dte_rms(0, 0) > 1.5 * response(plain).dte_rms(0, 0));
  CHECK(bytes_of(differ) == bytes_of(swept(scene)));
  CHECK(bytes_of(rest_of(scene)) == bytes_of(rest_of(scene)));
}

TEST_CASE("slow motion of teeth that differ follows their statics over the hunting period") {
  Scene scene = line();
  scene.gears[1].errors = mixed(20);
  scene.contact.positions = 64;
  for (Scene::Mesh& mesh : scene.meshes) mesh.spec.corner.enabled = true;  // without, pairs come at once
  const SystemStaticResult rest = rest_of(scene);
  scene.time.steps_per_period = 256;
  scene.operation.frequency_step = 10;
  std::array<double, 2> off{};
  double largest = 0, wrong = 0;  // N: load of a pair of teeth; difference of loads of the same number
  for (size_t k = 0; k < 2; ++k) {
    scene.operation.frequency_from = scene.operation.frequency_to = k == 0 ? 20 : 10;
    const SweepResult slow = swept(scene);
    REQUIRE(slow.transmission_error[0].rows() == 20 * 256);
    for (Index i = 0; i < rest.mesh_phase.size(); ++i)
      for (size_t m = 0; m < 2; ++m)
        off[k] = std::max(off[k], std::abs(slow.transmission_error[0](4 * i, static_cast<Index>(m)) -
                                           rest.mesh[m].transmission_error[i]));
    for (size_t m = 0; m < 2; ++m) {
      const StaticResult& at_rest = rest.mesh[m];
      const auto loads = slow.loads_of(0, static_cast<Index>(m));
      for (Index p = 0; p < at_rest.pair.size(); ++p)
        for (Index i = 0; i < rest.mesh_phase.size(); ++i) {
          const Index own = at_rest.pair[p] - slow.pair[0];
          const double moving = own >= 0 && own < slow.pair.size() ? loads(4 * i, own) : 0;
          largest = std::max(largest, at_rest.tooth_load(i, p));
          wrong = std::max(wrong, std::abs(moving - at_rest.tooth_load(i, p)));
        }
    }
  }
  INFO(wrong << " N of " << largest);
  CHECK(wrong < 0.05 * largest);
  const VectorXd& error = rest.mesh[0].transmission_error;
  const double range = error.maxCoeff() - error.minCoeff();
  CHECK(off[0] < 0.005 * range);
  CHECK(off[1] < 0.005 * range);
}

TEST_CASE(
    "errors of a system: written, read, as parameters and in artifacts; planets have draws of their own") {
  Scene scene = line();
  scene.gears[1].errors = mixed(20);
  scene.operation.frequency_from = 1000;
  scene.operation.frequency_to = 2000;
  scene.operation.frequency_step = 500;
  const SceneFile file;
  const SystemSweepParameters sweep = sweep_parameters_of(scene, layout_of(scene));
  const std::string path = file.path(system_sweep_parameters(sweep), "sweep.toml");
  const SystemSweepParameters again = read_system_sweep_parameters(path);
  REQUIRE(again.errors.size() == 3);
  CHECK(again.errors[0].none());
  CHECK(again.errors[1].cumulative_pitch == sweep.errors[1].cumulative_pitch);
  CHECK(again.errors[1].eccentric_tooth == 3.5);
  CHECK(hunting_periods(scene) == 20);
  CHECK(system_sweep_parameters(again) == system_sweep_parameters(sweep));

  const SystemStaticResult rest = rest_of(scene);
  const std::string h5 = file.path("") + ".h5";
  write(h5, rest, Provenance());
  const SystemStaticResult read = whine::read<SystemStaticResult>(h5);
  CHECK(read.hunting_periods == 20);
  CHECK(read.mesh[1].transmission_error_order == rest.mesh[1].transmission_error_order);
  CHECK(read.mesh[1].mesh.errors[0].profile_slope == rest.settings.errors[1].profile_slope);
  CHECK(read.mesh[1].mesh_phase == rest.mesh[1].mesh_phase);
  CHECK(read.mesh[1].root_stress[1] == rest.mesh[1].root_stress[1]);
  CHECK(read.settings.errors[1].profile_slope == rest.settings.errors[1].profile_slope);
  for (size_t m = 0; m < 2; ++m)
    for (size_t s = 0; s < 2; ++s)
      CHECK(read.settings.layout.meshes[m].side[s].first_tooth ==
            rest.settings.layout.meshes[m].side[s].first_tooth);
  const Figure figure = system_static_figure(read);
  CHECK(block(figure, "transmission_error").rows.size() == 20 * 8 + 1);
  CHECK(block(figure, "transmission_error").rows.back()[0] == 20);
  CHECK(block(figure, "transmission_error harmonics").rows[0][1] * kMicrometre ==
        relative(rest.mesh[0].transmission_error_harmonic[1], 1e-9));
  // Orders of the mesh frequency are its harmonics.
  CHECK(read.mesh[0].transmission_error_order[20] ==
        relative(read.mesh[0].transmission_error_harmonic[1], 1e-9));

  Scene train = planetary_train(3);
  train.fidelity.body = BodyModel::modal;
  train.gears[1].errors.iso_class = 6;
  train.gears[1].errors.seed = 2147483647;
  const SystemStaticParameters drawn = static_parameters_of(train, layout_of(train));
  CHECK(drawn.errors[0].none());
  CHECK(drawn.errors[1].seed == 2147483647);
  CHECK(drawn.errors[2].seed == 0);
  CHECK(drawn.errors[3].seed == 1);
  CHECK(hunting_periods(train) == 36);
}

TEST_CASE(
    "errors of a system that are rejected: too long a hunting period, memory, and stages of one mesh period") {
  CHECK(hunting_periods_of({}) == 1);
  CHECK(hunting_periods_of({27, 1, 35, 27}) == 945);
  CHECK(names(message_of_input([] { hunting_periods_of({27, 35, 99}); }), {10395, 27, 35, 99, 4096}));
  Scene scene = line();
  scene.gears[1].errors = mixed(20);
  scene.operation.frequency_from = 1000;
  scene.operation.frequency_to = 2000;
  scene.operation.frequency_step = 500;
  SystemSweepParameters settings = sweep_parameters_of(scene, layout_of(scene));
  CHECK(names(message_of_input([&] { system_branch(settings, line_bodies(), no_report, {}); }),
              {"[gear.b.error]"}));
  CHECK(names(message_of_input([&] { system_impact(settings, line_bodies(), {}, no_report); }),
              {"impact", "[gear.b.error]"}));
  settings.contact.positions = 1 << 20;
  CHECK(names(message_of_input([&] { system_at_rest(settings, line_bodies()); }), {"[discretisation]"}));
  settings.frequency_step = 1e-5;
  CHECK(names(message_of_input([&] { system_sweep(settings, line_bodies(), Direction::up, no_report); }),
              {20, "periods"}));
}
