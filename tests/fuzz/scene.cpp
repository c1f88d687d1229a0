// libFuzzer: any bytes as a scene, and as the stage parameters of one. They are read or rejected by an Error; a scene that is
// read gives stage parameters that are read, too, and say the same again.
#include <cstdlib>

#include "base/error.h"
#include "file_of.h"
#include "io/scene.h"
#include "io/variant.h"

namespace {

using namespace whine;

// What stage parameters are read from must be what a program has written.
void require_readable(const Scene& scene) {
  const auto as_file = [](const std::string& settings, const auto& read) {
    read(FileOf(reinterpret_cast<const std::uint8_t*>(settings.data()), settings.size()).path());
  };
  as_file(static_parameters(scene), read_static_parameters);
  as_file(impact_parameters(scene), read_impact_parameters);
  as_file(sweep_parameters(scene), read_sweep_parameters);
  as_file(map_parameters(scene), read_map_parameters);
  for (const SceneGear& gear : scene.gears) {
    const std::string settings = body_parameters(scene, gear.name);
    as_file(settings, [&](const std::string& path) {
      if (body_parameters(read_body_parameters(path)) != settings) std::abort();
    });
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const FileOf file(data, size);
  const std::string path = file.path();
  Scene scene;
  bool valid = false;
  rejected_or_read([&] {
    scene = read_pair_scene(path);
    valid = true;
  });
  if (valid) require_readable(scene);
  rejected_or_read([&] { read_body_parameters(path); });
  rejected_or_read([&] { read_static_parameters(path); });
  rejected_or_read([&] { read_impact_parameters(path); });
  rejected_or_read([&] { read_sweep_parameters(path); });
  rejected_or_read([&] { read_map_parameters(path); });
  rejected_or_read([&] { read_system_parameters(path); });
  rejected_or_read([&] {
    const std::string settings = system_parameters(layout_in(read_scene(path), path));
    const FileOf again(reinterpret_cast<const std::uint8_t*>(settings.data()), settings.size());
    if (system_parameters(read_system_parameters(again.path())) != settings) std::abort();
  });
  rejected_or_read([&] { scene_variant(path, {"module_mm=2", "bore_radius_mm=35"}); });
  return 0;
}
