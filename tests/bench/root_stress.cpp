// Root stress of a pair at one position beside CalculiX (calculix.h): both gears whole, quadratic triangles, contact of their own,
// at the rotation that Whine finds for the torque. Plane strain: elements of CalculiX in plane stress change their thickness.
// The position is that with the largest root stress of the driver among those at which CalculiX can be set up: the others, where the
// pair touches off the line of action, are named. Tip edges are in contact whatever the scene says.
//
// Reads   params and two body.h5 (their design, material and discretisation); writes a table on standard output.
// Exit status 1: a root stress differs by more than 2 %, the torque at the same rotation by more than 0.5 %.
// Example: whine-bench-stress --params out/fzg-c/params/static.toml --body pinion=out/fzg-c/pinion/body.h5
//            --body wheel=out/fzg-c/wheel/body.h5 --torque 200
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "base/tool.h"
#include "calculix.h"
#include "io/artifacts.h"
#include "io/named_files.h"
#include "io/scene.h"
#include "results/reduced_body.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "studies/sweep.h"
#include "system/root_stress.h"
#include "system/statics.h"

namespace {

constexpr double kContactElement = 0.06e-3;  // m, CalculiX's where the flanks touch
constexpr double kRootElement = 0.06;        // the same on the roots, over the radius of the rack's tip
constexpr double kStressLimit = 0.02, kTorqueLimit = 0.005;
constexpr double kDegrees = 180 / std::numbers::pi;

// deg: of the root's tangent at t against the centre line of the tooth.
double tangent_angle(const whine::ToothGeometry& tooth, double t) {
  constexpr double kStep = 1e-3;
  const whine::Vec2 step =
      tooth.root_point(std::min(t + kStep, 1.0)) - tooth.root_point(std::max(t - kStep, 0.0));
  return std::atan2(-step.x(), -tooth.outwards() * step.y()) * kDegrees;
}

struct Position {
  Eigen::Index row, pair;
};

// By falling root stress of the driver, the first one that touches on the line of action.
Position position_to_compare(const whine::StaticResult& s, const whine::GearPair& gears) {
  std::vector<Position> all;
  for (Eigen::Index row = 0; row < s.root_stress[0].rows(); ++row)
    for (Eigen::Index pair = 0; pair < s.root_stress[0].cols(); ++pair)
      if (s.tooth_load(row, pair) > 0) all.push_back({row, pair});
  std::sort(all.begin(), all.end(), [&](const Position& a, const Position& b) {
    return s.root_stress[0](a.row, a.pair) > s.root_stress[0](b.row, b.pair);
  });
  for (const Position& p : all) {
    const double phase = s.mesh_phase[p.row] + s.pair[p.pair];
    if (!gears.contact(phase).corner) return p;
    std::printf("  refused: phase of the pair %.4f, %.2f MPa: a tip edge touches off the line of action\n",
                phase, s.root_stress[0](p.row, p.pair) * 1e-6);
  }
  whine::fail(whine::Failure::input, "no position at which a pair touches on the line of action");
}

whine::ReducedBody in_plane_strain(const whine::ReducedBody& body) {
  whine::Material material = body.material;
  material.plane_stress = false;
  return whine::reduce(whine::make_sector_mesh(body.design, body.discretisation), material, 1);
}

void compare(const whine::ReducedBody& driver, const whine::ReducedBody& driven,
             whine::StaticParameters settings, double torque) {
  using namespace whine;
  settings.mesh.corner = CornerRule();  // CalculiX leaves no tip edge out
  const std::array strained{in_plane_strain(driver), in_plane_strain(driven)};
  const StaticResult s = static_transmission(strained[0], strained[1], settings, torque);
  const GearPair gears(driver.design, driven.design, settings.mesh.centre_distance);
  const auto [row, pair] = position_to_compare(s, gears);
  const double phase = s.mesh_phase[row] + s.pair[pair];
  std::printf(
      "  %g N m, plane strain, phase of the pair %.4f, elements of %g and %g mm, load of the pair %.1f N of %.1f N\n",
      torque, phase, driver.discretisation.element_size * 1e3, driven.discretisation.element_size * 1e3,
      s.tooth_load(row, pair), torque / gears.gear(0).base_radius());
  if (!calculix_installed()) {
    std::printf("  (no CalculiX to compare with: make deps-bench)\n");
    return;
  }
  const double radius = std::min(driver.design.rack_tip_radius * driver.design.module,
                                 driven.design.rack_tip_radius * driven.design.module);
  const double element = std::clamp(kRootElement * radius, 0.01e-3, kContactElement);
  const CalculixPosition peer = CalculixPair(gears, driver.material, phase, kContactElement, element)
                                    .solve(s.transmission_error[row] / gears.gear(0).base_radius());
  // Of the driver, by the reaction of the driven gear: friction takes none.
  const double their_torque = peer.torque * gears.gear(0).base_radius() / gears.gear(1).base_radius();
  std::printf("  CalculiX: %d nodes, %.4f mm on the roots, CPU %.1f s, torque %+.3f %%\n", peer.nodes,
              element * 1e3, peer.usage.seconds, 100 * (their_torque / torque - 1));
  const GearMeshModel model(strained[0], strained[1], settings.mesh);
  RootStresses roots(model, {s.mesh_phase[row]});
  double worst = 0;
  for (int g = 0; g < kSides; ++g) {
    const auto side = static_cast<size_t>(g);
    const auto& stress = peer.root_stress[side];
    const auto top = std::max_element(stress.begin(), stress.end());
    // To the torque of Whine, in proportion.
    const double theirs = *top * torque / their_torque;
    const RootStress ours = roots.of_tooth(g, 0, s.pair[pair], s.pair, s.tooth_load.row(row).transpose());
    const double difference = ours.stress / theirs - 1;
    worst = std::max(worst, std::abs(difference));
    std::printf(
        "    %-8s largest root stress: Whine %.2f MPa at a tangent of %.1f deg, CalculiX %.2f MPa at %.1f deg, difference %+.2f %%\n",
        settings.mesh.gear[side].c_str(), ours.stress * 1e-6, ours.angle * kDegrees, theirs * 1e-6,
        tangent_angle(gears.gear(g), peer.root_parameter[side][static_cast<size_t>(top - stress.begin())]),
        100 * difference);
  }
  if (worst > kStressLimit)
    fail(Failure::numerical, "root stress differs from CalculiX's by ", 100 * worst, " %, at most ",
         100 * kStressLimit, " % is allowed");
  if (const double off = std::abs(their_torque / torque - 1); off > kTorqueLimit)
    fail(Failure::numerical, "the torque at the same rotation differs from CalculiX's by ", 100 * off,
         " %, at most ", 100 * kTorqueLimit, " % is allowed");
}

// CPU of a sweep up with root stress, over that of bodies without tables; the two in turn, the least of each.
void time_of_sweeps(const whine::ReducedBody& driver, const whine::ReducedBody& driven,
                    const whine::StaticParameters& settings, const whine::SweepParameters& sweeps,
                    double torque) {
  using namespace whine;
  constexpr int kTurns = 5;
  const StaticResult s = static_transmission(driver, driven, settings, torque);
  std::array<ReducedBody, 2> plain{driver, driven};
  for (ReducedBody& body : plain) body.root_stress.clear();
  double least[2] = {1e30, 1e30};  // s
  for (int turn = 0; turn < 2 * kTurns; ++turn) {
    const bool with = turn % 2 == 0;
    const std::clock_t start = std::clock();
    const SweepResult swept = sweep(with ? driver : plain[0], with ? driven : plain[1], s, s.mean_stiffness,
                                    sweeps, Direction::up, [](long, long, const std::string&) {});
    least[turn % 2] = std::min(least[turn % 2], double(std::clock() - start) / CLOCKS_PER_SEC);
    if (with == swept.root_stress.empty()) fail(Failure::numerical, "root stress where there is none");
  }
  std::printf("  sweep up with root stress: CPU %.3f s, %.3f times that without\n", least[0],
              least[0] / least[1]);
}

void body(int argc, char** argv) {
  whine::Options options{"Root stress at one position beside CalculiX", "whine-bench-stress"};
  std::string params, sweep_params, torque;
  std::vector<std::string> bodies;
  options.add("--params", params, "stage parameters of the scene: out/<scene>/params/static.toml").required();
  options.add("--body", bodies, "body.h5 of a gear as <gear>=<path>, once for each").required();
  options.add("--torque", torque, "torque on the driver in N m, above 0").required();
  options.add("--sweep-params", sweep_params, "stage parameters of the scene, to time a sweep as well");
  options.parse(argc, argv);
  const double load = whine::number_option("--torque", torque);
  const whine::StaticParameters read = whine::read_static_parameters(params);
  const std::vector<std::string> paths = whine::NamedFiles("--body", bodies).of(read.mesh);
  std::printf("%s\n", params.c_str());
  const whine::ReducedBody driver = whine::read<whine::ReducedBody>(paths[0]),
                           driven = whine::read<whine::ReducedBody>(paths[1]);
  if (!sweep_params.empty())
    time_of_sweeps(driver, driven, read, whine::read_sweep_parameters(sweep_params), load);
  compare(driver, driven, read, load);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
