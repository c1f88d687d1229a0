// A folder of its own for each case, in which the case works, removed at the end; WHINE_KEEP=folder keeps a copy.
#pragma once
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

class OwnFolder {
 public:
  OwnFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "whine-files-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
    std::filesystem::current_path(path_);
  }
  ~OwnFolder() {
    std::filesystem::current_path(before_);
    std::error_code ignored;
    using std::filesystem::copy_options;
    if (const char* place = std::getenv("WHINE_KEEP"))
      std::filesystem::copy(path_, place, copy_options::recursive | copy_options::overwrite_existing,
                            ignored);
    std::filesystem::remove_all(path_);
  }
  std::vector<std::string> names(const std::filesystem::path& where = ".") const {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(where))
      out.push_back(entry.path().filename().string());
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  std::filesystem::path before_ = std::filesystem::current_path(), path_;
};
