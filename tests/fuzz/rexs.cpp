// libFuzzer: any bytes as a REXS model in XML, in JSON or in a zip archive. They are read or rejected by an Error; a stage of a
// model that is read gives a scene or an Error, and the scene is TOML in which nothing stands that a text of the model has written.
#include <cstdlib>
#include <sstream>

#include "base/error.h"
#include "file_of.h"
#include "io/rexs/rexs.h"
#include "io/rexs/scene.h"
#include "io/scene.h"

namespace {

using namespace whine;

bool begins_with_one_of(const std::string& line, std::initializer_list<const char*> beginnings) {
  for (const char* beginning : beginnings)
    if (line.starts_with(beginning)) return true;
  return false;
}

void require_scene(const std::string& scene) {
  std::istringstream lines(scene);
  for (std::string line; std::getline(lines, line);) {
    const bool key =
        line.find_first_not_of("abcdefghijklmnopqrstuvwxyzGHPaNm_0123456789") == line.find(" = ");
    if (!line.empty() && !key &&
        !begins_with_one_of(line, {"# ", "[gear.", "[material.material_", "[material.steel_", "[[mesh]]",
                                   "[[carrier]]", "[[drive]]", "[damping]", "[operation]"}))
      std::abort();
  }
  try {
    read_scene(FileOf(reinterpret_cast<const std::uint8_t*>(scene.data()), scene.size()).path());
  } catch (const Error& error) {
    const std::string said = error.what();
    // A scene of more than a megabyte is none.
    if (scene.size() < 1000000 && said.find("is not valid TOML") != std::string::npos) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const FileOf file(data, size);
  rejected_or_read([&] {
    const RexsModel model = read_rexs(file.path());
    for (const auto& [id, component] : model.components)
      if (component.type == "cylindrical_stage" || component.type == "planetary_stage")
        rejected_or_read(
            [&, &stage = id] { require_scene(scene_of_rexs(model, std::to_string(stage), 1).text); });
  });
  return 0;
}
