// Stage parameters of all scenes that ship, byte by byte: their hashes name the folders of bodies, and make redoes what changes.
//
// tests/stage_texts.sha256 is made by: for each data/scenes/*.toml gear-scene --scene it --out X --output X/it.mk, then in X
// find -L . -name '*.toml' ! -path './bodies/*' | sed 's#^\./##' | LC_ALL=C sort | xargs sha256sum
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "io/compatibility.h"
#include "io/publish.h"
#include "io/scene.h"
#include "io/system_scene.h"

using namespace whine;

TEST_CASE("stage texts of shipped scenes are what they were, byte by byte") {
  std::set<std::string> shipped, listed;
  for (const auto& file : std::filesystem::directory_iterator("data/scenes"))
    if (file.path().extension() == ".toml") shipped.insert(file.path().stem().string());
  std::ifstream list("tests/stage_texts.sha256");
  for (std::string hash, place; list >> hash >> place;) {
    CAPTURE(place);
    const std::string name = place.substr(0, place.find('/')), scene = "data/scenes/" + name + ".toml";
    listed.insert(name);
    const std::string words = is_system_scene(scene) ? system_parameters_for(scene, place)
                                                     : parameters_for(read_scene(scene), place);
    CHECK(!words.empty());
    CHECK(sha256(words) == hash);
  }
  CHECK(listed == shipped);
}
