#include "io/scene_words.h"

#include <filesystem>

#include "base/visible.h"
#include "io/publish.h"

namespace whine {

std::string scene_words(const std::string& path) {
  constexpr size_t kMostBytes = 160;
  namespace fs = std::filesystem;
  for (fs::path folder = fs::path(path).lexically_normal().parent_path(); folder.has_filename();
       folder = folder.parent_path()) {
    const fs::path file = folder / "params" / "title.txt";
    if (std::error_code none; !fs::exists(file, none)) continue;
    std::string title = read_bytes(file.string());
    title = visible(title.substr(0, title.find('\n')));
    const std::string name = folder.filename().string();
    std::string words = title.empty() || title == name ? name : name + ": " + title;
    if (words.size() > kMostBytes) {
      size_t end = kMostBytes;
      while (end > 0 && (static_cast<unsigned char>(words[end]) & 0xC0) == 0x80) --end;  // amid a character
      words = words.substr(0, end) + "...";
    }
    return words;
  }
  return "";
}

std::string design_name(const std::string& path) {
  const std::string scene = scene_words(path);
  if (scene.empty())
    fail(Failure::input, path,
         ": lies in no folder of a scene, so its design has no name; give out/<scene>/...");
  return scene.substr(0, scene.find(": "));
}

}  // namespace whine
