#include "io/named_files.h"

#include <algorithm>

#include "base/error.h"
#include "io/suggestion.h"

namespace whine {

namespace {

// "sun, planet and ring"
std::string listed(const std::vector<std::string>& words) {
  std::string out;
  for (size_t i = 0; i < words.size(); ++i)
    out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return out;
}

}  // namespace

NamedFiles::NamedFiles(std::string option, const std::vector<std::string>& words)
    : option_(std::move(option)) {
  for (const std::string& word : words) {
    const auto equals = word.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == word.size())
      fail(Failure::usage, option_, " ", word, ": write ", option_, " <gear>=<path>, once for each gear");
    const std::string gear = word.substr(0, equals);
    for (const auto& [name, path] : files_)
      if (name == gear) fail(Failure::usage, option_, " names the gear '", gear, "' twice");
    files_.emplace_back(gear, word.substr(equals + 1));
  }
}

std::vector<std::string> NamedFiles::of(const GearMeshSpec& mesh) const {
  return of(std::vector<std::string>(mesh.gear.begin(), mesh.gear.end()), "mesh");
}

std::vector<std::string> NamedFiles::of(const std::vector<std::string>& gears,
                                        const std::string& whole) const {
  for (const auto& [name, path] : files_)
    if (std::find(gears.begin(), gears.end(), name) == gears.end()) {
      const std::string near = nearest(name, gears);
      fail(Failure::usage, option_, " ", name, "=", path, ": no gear of this ", whole, " is called '", name,
           "'; ", near.empty() ? "they are " + listed(gears) : text("did you mean '", near, "'?"));
    }
  std::vector<std::string> paths;
  for (const std::string& gear : gears) {
    const auto file =
        std::find_if(files_.begin(), files_.end(), [&](const auto& known) { return known.first == gear; });
    if (file == files_.end())
      fail(Failure::usage, "the gear '", gear, "' has no file; give ", option_, " ", gear, "=<path>");
    paths.push_back(file->second);
  }
  return paths;
}

std::string NamedFiles::role(const std::string& gear) const {
  return option_.substr(option_.find_first_not_of('-')) + " " + gear;
}

std::vector<std::string> NamedFiles::and_inputs(std::vector<std::string> inputs) const {
  for (const auto& [name, path] : files_) inputs.push_back(role(name) + "=" + path);
  return inputs;
}

}  // namespace whine
