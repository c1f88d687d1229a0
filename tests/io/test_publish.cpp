// Files that belong together are replaced together.
#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "base/error.h"
#include "io/publish.h"

using namespace whine;
namespace fs = std::filesystem;

TEST_CASE("a page and its table are both replaced, or both stay, and nothing is left beside them") {
  const fs::path folder = fs::temp_directory_path() / ("whine-publishing-" + std::to_string(::getpid()));
  const std::string table = folder / "table.tsv", page = folder / "page.html";
  publish_all({{table, "old"}, {page, "old"}});
  CHECK(read_bytes(table) == "old");
  // A folder stands where the second belongs: nothing can be put there.
  fs::remove(page);
  fs::create_directories(fs::path(page) / "inside");
  CHECK_THROWS_AS(publish_all({{table, "new"}, {page, "new"}}), Error);
  CHECK(read_bytes(table) == "old");
  fs::remove_all(page);
  publish_all({{table, "new"}, {page, "new"}});
  CHECK(read_bytes(table) == "new");
  CHECK(read_bytes(page) == "new");
  CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 2);
  fs::remove_all(folder);
}
