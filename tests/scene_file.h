// Scenes for tests: a small one, edits of it, and what it is rejected with.
#pragma once
#include <doctest/doctest.h>

#include <string>

#include "io/scene.h"
#include "own_folder.h"
#include "refusal.h"

// A complete scene with required keys only; line numbers are relied on below.
inline const char* const kScene = R"([gear.pinion]
teeth = 50
module_mm = 3
pressure_angle_deg = 20
face_width_mm = 25.4
bore_radius_mm = 40
total_inertia_kgm2 = 0.0148
material = "steel"
[gear.wheel]
like = "pinion"
[material.steel]
youngs_modulus_GPa = 207
poisson_ratio = 0.3
density_kgm3 = 7600
plane = "stress"
[[mesh]]
driver = "pinion"
driven = "wheel"
centre_distance_mm = 150
[operation]
torque_Nm = [100, 150]
mesh_frequency_Hz = { from = 600, to = 4000, step = 20 }
)";

class SceneFile : public TemporaryFolder {
 public:
  std::string path(const std::string& text, const std::string& name = "x.toml") const {
    return file(name, text);
  }
  whine::Scene read(const std::string& text) const { return whine::read_scene(path(text)); }

  // The message with which a scene is rejected, from the file name on; "" if it is not.
  std::string rejection(const std::string& text) const {
    const std::string message = whine::message_of_input([&] { whine::read_scene(path(text)); });
    const auto start = message.find("x.toml");
    return start == std::string::npos ? message : message.substr(start);
  }
};

// kScene with one text replaced; the text must be there once.
inline std::string scene_with(const std::string& old, const std::string& now) {
  std::string out = kScene;
  const auto at = out.find(old);
  REQUIRE(at != std::string::npos);
  REQUIRE(out.find(old, at + 1) == std::string::npos);
  return out.replace(at, old.size(), now);
}

inline std::string with_section(const std::string& section) {
  return kScene + section;
}
