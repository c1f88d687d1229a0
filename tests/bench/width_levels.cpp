// What the third dimension costs a body, by size: CPU seconds and memory. Then levels of [fidelity] width side by side: mean mesh
// stiffness, peak-to-peak transmission error and K_Hbeta at rest, each with the difference to the next level, of bodies with what two degrees
// less change, and CPU seconds of bodies and of statics.
//
// Example: whine-bench-levels data/scenes/parker2000-misaligned.toml data/scenes/helical-17-67.toml
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/tool.h"
#include "bench/accuracy_runs.h"
#include "bench/ccx.h"
#include "gear/face_width.h"
#include "model/capabilities.h"
#include "studies/width_levels.h"

namespace {
using namespace whine;

struct Level {
  StaticResult rest, next;               // of bodies in three dimensions: two degrees less
  double of_bodies = 0, of_statics = 0;  // s of CPU
};

double peak_to_peak(const StaticResult& s) {
  return s.transmission_error.maxCoeff() - s.transmission_error.minCoeff();
}

// Of a scene in plane strain, which all levels have.
Level at(Scene scene, WidthModel width) {
  for (SceneGear& gear : scene.gears) gear.material.plane_stress = false;
  const auto& [driver, driven] = scene.mesh().gear;
  scene.fidelity.width = width;
  scene.body.width.degree =
      width == WidthModel::body ? degree_of_width(scene.gear(driver).design, scene.gear(driven).design) : 0;
  Level out;
  const double start = cpu_seconds();
  const std::vector<ReducedBody> body =
      bodies_of({body_parameters(scene, driver), body_parameters(scene, driven)});
  const double reduced = cpu_seconds();
  const StaticParameters settings = through_file(static_parameters(scene), read_static_parameters);
  out.rest = static_transmission(body[0], body[1], settings, scene.operation.torques.front());
  out.of_bodies = reduced - start;
  out.of_statics = cpu_seconds() - reduced;
  if (width == WidthModel::body) out.next = next_width_level(body[0], body[1], settings, out.rest);
  return out;
}

// In per cent of the own; where that is next to nothing, by itself.
std::string change(double own, double next, const char* unit) {
  char words[32];
  const double off = next / own - 1;
  if (std::abs(off) < 1)
    std::snprintf(words, sizeof words, "%+.1f %%", off * 100);
  else
    std::snprintf(words, sizeof words, "%+.3f%s", next - own, unit);
  return words;
}

void print_levels(const std::string& path) {
  const Scene scene = read_scene(path);
  const bool spur = face_words(scene.mesh(), scene.gear(scene.mesh().gear[0]).design,
                               scene.gear(scene.mesh().gear[1]).design)
                        .empty();
  std::optional<StaticResult> finer;
  std::vector<std::string> rows;
  for (const WidthModel width : {WidthModel::body, WidthModel::slices, WidthModel::one}) {
    if (width == WidthModel::one && !spur) continue;
    const Level own = at(scene, width);
    const StaticResult &s = own.rest, &other = finer ? *finer : own.next;
    const auto factor = [](const StaticResult& of) { return of.face.none() ? 1 : of.face.load_factor; };
    char row[512];
    std::snprintf(row, sizeof row, "| `%s` | `%s` | %.1f; %s | %.3f; %s | %.3f; %s | %.1f, %.2f |\n",
                  std::filesystem::path(path).stem().c_str(), name_of(width).c_str(), s.mean_stiffness * 1e-6,
                  change(s.mean_stiffness, other.mean_stiffness, "").c_str(), peak_to_peak(s) * 1e6,
                  change(peak_to_peak(s) * 1e6, peak_to_peak(other) * 1e6, " µm").c_str(), factor(s),
                  change(factor(s), factor(other), "").c_str(), own.of_bodies, own.of_statics);
    rows.insert(rows.begin(), row);
    finer = own.rest;
  }
  for (const std::string& row : rows) std::fputs(row.c_str(), stdout);
  std::fflush(stdout);
}

double largest_memory() {  // GB
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return double(used.ru_maxrss) / (1024 * 1024);
}

// A cell: seconds, the least of three, and memory above that of a small plane body of this gear.
void print_cost(int teeth, double beta, double width, int degree) {
  constexpr double kModule = 3e-3;
  GearDesign d;
  d.teeth = teeth;
  d.module = kModule;
  d.pressure_angle = 20 * std::numbers::pi / 180;
  d.helix_angle = beta * std::numbers::pi / 180;
  d.face_width = width;
  d.bore_radius = 0.3 * teeth * kModule;
  BodyDiscretisation plane;
  plane.element_size = kModule / 3;
  ReducedBody body = reduce(make_sector_mesh(d, plane), {207e9, 0.3, 7800, false}, 1);
  const double memory = largest_memory();
  double seconds = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double start = cpu_seconds();
    add_width({degree, kModule / 3}, body);
    seconds = std::min(seconds, cpu_seconds() - start);
  }
  std::printf(" %.1f s, %.1f GB |", seconds, largest_memory() - memory);
}

void print_costs(int teeth, double width, int degree) {
  std::printf("| %d teeth, %g mm, degree %d |", teeth, width * 1e3, degree);
  for (const double beta : {0.0, 20.0}) {
    std::fflush(stdout);
    // Each in a process of its own, whose memory is that of this gear.
    const pid_t child = fork();
    if (child == 0) {
      const int status = run_tool(0, nullptr, [&](int, char**) { print_cost(teeth, beta, width, degree); });
      std::fflush(stdout);
      _exit(status);
    }
    wait_for(child, "the body");
  }
  std::puts("");
}

void body(int argc, char** argv) {
  // First: no thread runs yet that a process would be forked beside.
  std::puts("| gear, module 3 mm | spur | helical, 20 degrees |\n|---|---|---|");
  for (const int teeth : {25, 50, 150}) print_costs(teeth, 20e-3, 8);
  print_costs(50, 45e-3, 12);
  std::puts(
      "\n| scene | level | mean stiffness (N/µm) | peak to peak (µm) | K_Hβ | bodies, statics (s) |\n|---|---|---|---|---|---|");
  for (int i = 1; i < argc; ++i) print_levels(argv[i]);
}

}  // namespace

int main(int argc, char** argv) {
  return run_tool(argc, argv, body);
}
