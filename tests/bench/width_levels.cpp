// Levels of [fidelity] width side by side: mean mesh stiffness, peak-to-peak transmission error and K_Hbeta at rest, each with the
// difference to the next level, and CPU seconds of bodies and of statics. Then what the third dimension costs a body, by size.
//
// Example: whine-bench-levels data/scenes/parker2000-misaligned.toml data/scenes/helical-17-67.toml
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/tool.h"
#include "bench/accuracy_runs.h"
#include "gear/face_width.h"
#include "model/capabilities.h"

namespace {
using namespace whine;

struct Level {
  StaticResult rest;
  double of_bodies = 0, of_statics = 0;  // s of CPU
  double peak_to_peak() const {
    return rest.transmission_error.maxCoeff() - rest.transmission_error.minCoeff();
  }
};

// Of a scene in plane strain, which all levels have.
Level at(Scene scene, WidthModel width) {
  for (SceneGear& gear : scene.gears) gear.material.plane_stress = false;
  const auto& [driver, driven] = scene.mesh.gear;
  scene.fidelity.width = width;
  scene.body.width.degree =
      width == WidthModel::body ? degree_of_width(scene.gear(driver).design, scene.gear(driven).design) : 0;
  Level out;
  const double start = cpu_seconds();
  const std::vector<ReducedBody> body =
      bodies_of({body_parameters(scene, driver), body_parameters(scene, driven)});
  const double reduced = cpu_seconds();
  out.rest =
      static_transmission(body[0], body[1], through_file(static_parameters(scene), read_static_parameters),
                          scene.operation.torques.front());
  out.of_bodies = reduced - start;
  out.of_statics = cpu_seconds() - reduced;
  return out;
}

std::string change(double own, double next) {
  char words[32];
  std::snprintf(words, sizeof words, "%+.1f %%", (next / own - 1) * 100);
  return words;
}

void print_levels(const std::string& path) {
  const Scene scene = read_scene(path);
  const bool spur =
      face_words(scene.mesh, scene.gear(scene.mesh.gear[0]).design, scene.gear(scene.mesh.gear[1]).design)
          .empty();
  std::optional<Level> next;
  std::vector<std::string> rows;
  for (const WidthModel width : {WidthModel::body, WidthModel::slices, WidthModel::one}) {
    if (width == WidthModel::one && !spur) continue;
    const Level own = at(scene, width);
    const StaticResult& s = own.rest;
    const double factor = s.face.none() ? 1 : s.face.load_factor;
    const auto to_next = [&](double value, double other) { return next ? change(value, other) : "last"; };
    char row[512];
    std::snprintf(
        row, sizeof row, "| `%s` | `%s` | %.1f; %s | %.3f; %s | %.3f; %s | %.1f, %.2f |\n",
        std::filesystem::path(path).stem().c_str(), name_of(width).c_str(), s.mean_stiffness * 1e-6,
        to_next(s.mean_stiffness, next ? next->rest.mean_stiffness : 0).c_str(), own.peak_to_peak() * 1e6,
        to_next(own.peak_to_peak(), next ? next->peak_to_peak() : 0).c_str(), factor,
        to_next(factor, next ? next->rest.face.load_factor : 0).c_str(), own.of_bodies, own.of_statics);
    rows.insert(rows.begin(), row);
    next = own;
  }
  for (const std::string& row : rows) std::fputs(row.c_str(), stdout);
  std::fflush(stdout);
}

void print_cost(int teeth, double width, int degree) {
  constexpr double kModule = 3e-3;
  std::string row = text("| ", teeth, " teeth, ", width * 1e3, " mm, degree ", degree, " |");
  for (const double beta : {0.0, 20.0}) {
    GearDesign d;
    d.teeth = teeth;
    d.module = kModule;
    d.pressure_angle = 20 * std::numbers::pi / 180;
    d.helix_angle = beta * std::numbers::pi / 180;
    d.face_width = width;
    d.bore_radius = 0.3 * teeth * kModule;
    double seconds[2];
    for (const int of : {0, degree}) {
      BodyDiscretisation body;
      body.element_size = kModule / 3;
      body.width = {of, kModule / 3};
      const double start = cpu_seconds();
      reduce(make_sector_mesh(d, body), {207e9, 0.3, 7800, false}, body.modes);
      seconds[of > 0] = cpu_seconds() - start;
    }
    char cell[64];
    std::snprintf(cell, sizeof cell, " %.1f + %.1f |", seconds[0], seconds[1] - seconds[0]);
    row += cell;
  }
  std::puts(row.c_str());
  std::fflush(stdout);
}

void body(int argc, char** argv) {
  std::puts(
      "| scene | level | mean stiffness (N/µm) | peak to peak (µm) | K_Hβ | bodies, statics (s) |\n|---|---|---|---|---|---|");
  for (int i = 1; i < argc; ++i) print_levels(argv[i]);
  std::puts("\n| gear, module 3 mm | spur (s) | helical, 20 degrees (s) |\n|---|---|---|");
  for (const int teeth : {25, 50, 150}) print_cost(teeth, 20e-3, 8);
  print_cost(50, 45e-3, 12);
}

}  // namespace

int main(int argc, char** argv) {
  return run_tool(argc, argv, body);
}
