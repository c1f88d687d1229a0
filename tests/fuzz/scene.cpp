// libFuzzer: any bytes as a scene, and as each slice of one. They are read or refused by an Error; a scene that is read
// gives slices that are read, too, and say the same again.
#include <cstdlib>

#include "base/error.h"
#include "file_of.h"
#include "io/scene.h"
#include "io/variant.h"

namespace {

using namespace whine;

// What a slice is read from must be what a program has written.
void require_readable(const Scene& scene) {
  const auto as_file = [](const std::string& slice, const auto& read) {
    read(FileOf(reinterpret_cast<const std::uint8_t*>(slice.data()), slice.size()).path());
  };
  as_file(static_slice(scene), read_static_slice);
  as_file(impact_slice(scene), read_impact_slice);
  as_file(sweep_slice(scene), read_sweep_slice);
  as_file(map_slice(scene), read_map_slice);
  for (const SceneGear& gear : scene.gears) {
    const std::string slice = body_slice(scene, gear.name);
    as_file(slice, [&](const std::string& path) {
      if (body_slice(read_body_slice(path)) != slice) std::abort();
    });
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const FileOf file(data, size);
  const std::string path = file.path();
  Scene scene;
  bool valid = false;
  refused_or_read([&] {
    scene = read_scene(path);
    valid = true;
  });
  if (valid) require_readable(scene);
  refused_or_read([&] { read_body_slice(path); });
  refused_or_read([&] { read_static_slice(path); });
  refused_or_read([&] { read_impact_slice(path); });
  refused_or_read([&] { read_sweep_slice(path); });
  refused_or_read([&] { read_map_slice(path); });
  refused_or_read([&] { scene_variant(path, {"module_mm=2", "bore_radius_mm=35"}); });
  return 0;
}
