// Stage parameters of all scenes that ship, byte by byte: their hashes name the folders of bodies, and make redoes what changes.
//
// A line of tests/stage_texts.sha256 is of one scene: the hash of its texts, one behind the other, its name, where gear-scene --out X puts them in X/<scene>.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "io/compatibility.h"
#include "io/publish.h"
#include "io/scene.h"

using namespace whine;

TEST_CASE("stage texts of shipped scenes are what they were, byte by byte") {
  std::set<std::string> shipped, listed;
  for (const auto& file : std::filesystem::directory_iterator("data/scenes"))
    if (file.path().extension() == ".toml") shipped.insert(file.path().stem().string());
  std::ifstream list("tests/stage_texts.sha256");
  for (std::string line, hash, name, place, words; std::getline(list, line); words.clear()) {
    std::istringstream cells(line);
    cells >> hash >> name;
    CAPTURE(name);
    const std::string scene = "data/scenes/" + name + ".toml";
    listed.insert(name);
    while (cells >> place) words += parameters_for(scene, name + "/" + place);
    CHECK(sha256(words) == hash);
  }
  CHECK(listed == shipped);
}
