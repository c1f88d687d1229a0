// What make has to be told to make an artifact again.
#include "io/provenance.h"

#include <filesystem>

#include "base/tool.h"
#include "io/compatibility.h"

namespace whine {

std::string rebuild_advice(const std::string& path) {
  const std::string target = recorded_path(path);
  // make has no targets outside its own folder.
  if (target.rfind("...", 0) == 0 || target.rfind("../", 0) == 0) {
    return "it lies outside the working folder: make it again where it was made";
  }
  if (target.rfind("out/", 0) != 0)
    return "make has targets below out/ only, such as out/<scene>/T150/static.h5: give one of these, or make it again as it was made";
  // make takes what stands there for made, whatever it is.
  std::error_code code;
  const auto found = std::filesystem::symlink_status(path, code);
  const std::string remove = !std::filesystem::exists(found)        ? ""
                             : std::filesystem::is_directory(found) ? "remove this folder; "
                                                                    : "delete it; ";
  // Of a scene or a study that is none of the project's make has to be told where it is.
  const std::string scene = target.substr(4, target.find('/', 4) - 4);
  if (const std::string studies = "out/studies/"; target.rfind(studies, 0) == 0) {
    const std::string study =
        target.substr(studies.size(), target.find('/', studies.size()) - studies.size());
    const bool own = !std::filesystem::is_regular_file("data/studies/" + study + ".toml");
    return remove + "rebuild it with: make " + (own ? "STUDY=path/to/" + study + ".toml " : "") + target;
  }
  std::string file = recorded_scene("out/" + scene);
  if (!std::filesystem::is_regular_file(file)) file = "data/scenes/" + scene + ".toml";
  const bool of_none = scene == "bodies" || scene == "figures" || scene.find('.') != std::string::npos;
  std::string told;
  if (!of_none && !std::filesystem::is_regular_file(file))
    told = "SCENE=path/to/" + scene + ".toml ";
  else if (!of_none && file.rfind("data/scenes/", 0) != 0)
    told = "SCENE=" + file + " ";
  return remove + "rebuild it with: make " + told + target;
}

}  // namespace whine
