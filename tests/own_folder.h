// Folders of a case's own, removed at the end.
#pragma once
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "whine-test-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  // The path of a file in it with these bytes.
  std::string file(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return *this / name;
  }

 private:
  std::filesystem::path path_;
};

// The working folder of the case; WHINE_KEEP=folder keeps a copy.
class OwnFolder : public TemporaryFolder {
 public:
  OwnFolder() { std::filesystem::current_path(path()); }
  ~OwnFolder() {
    std::filesystem::current_path(before_);
    std::error_code ignored;
    using std::filesystem::copy_options;
    if (const char* place = std::getenv("WHINE_KEEP"))
      std::filesystem::copy(path(), place, copy_options::recursive | copy_options::overwrite_existing,
                            ignored);
  }
  std::vector<std::string> names(const std::filesystem::path& where = ".") const {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(where))
      out.push_back(entry.path().filename().string());
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  std::filesystem::path before_ = std::filesystem::current_path();
};
