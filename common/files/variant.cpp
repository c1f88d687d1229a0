#include "files/variant.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "files/keys.h"
#include "files/publish.h"
#include "files/toml.h"

namespace whine {
namespace {

toml::table parsed(const std::string& bytes, const std::string& path) {
  try {
    return parse_toml(bytes);
  } catch (const toml::parse_error& error) {
    fail(Failure::input, path, ":", error.source().begin.line, ": is not valid TOML: ", error.description());
  }
}

// What the right side of "key=value" would be in a scene; a bare word is text.
void set(toml::table& section, const std::string& key, const std::string& value) {
  try {
    const toml::table line = parse_toml("value = " + value);
    if (line.size() == 1) {
      line.get("value")->visit([&](const auto& node) { section.insert_or_assign(key, node); });
      return;
    }
  } catch (const toml::parse_error&) {
  }
  section.insert_or_assign(key, value);
}

}  // namespace

std::string scene_variant(const std::string& path, const std::vector<std::string>& changes) {
  toml::table scene = parsed(read_bytes(path, "check the path of the scene"), path);
  std::vector<std::string> known;
  for (const Key& key : scene_keys()) known.push_back(key.name);
  for (const std::string& change : changes) {
    const size_t equals = change.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == change.size())
      fail(Failure::usage, "--set ", change, ": write key=value, as in bore_radius_mm=35");
    const std::string name = change.substr(0, equals), value = change.substr(equals + 1);
    const auto key =
        std::find_if(scene_keys().begin(), scene_keys().end(), [&](const Key& k) { return name == k.name; });
    if (key == scene_keys().end()) {
      const std::string near = nearest(name, known);
      fail(Failure::usage, "--set ", change, ": no scene has the key '", name, "'",
           near.empty() ? "; gear-scene --keys lists them" : "; did you mean '" + near + "'?");
    }
    const std::string section = key->section;
    if (section.empty()) {
      set(scene, name, value);
      continue;
    }
    toml::node* node = scene.get(section);
    if (!node && (section == "gear" || section == "material" || section == "mesh"))
      fail(Failure::input, path, ": lacks the section [", section, "] of the key '", name, "'");
    if (section == "mesh") {
      if (toml::array* list = node->as_array())
        for (toml::node& mesh : *list)
          if (toml::table* table = mesh.as_table()) set(*table, name, value);
    } else if (section == "modification" || section == "error") {
      toml::node* gears = scene.get("gear");
      if (toml::table* group = gears ? gears->as_table() : nullptr)
        for (auto&& [label, item] : *group)
          if (toml::table* gear = item.as_table()) {
            toml::table* own = gear->get_as<toml::table>(section);
            if (!own && section == "modification" && gear->contains("like")) continue;
            if (!own) own = gear->insert(section, toml::table{}).first->second.as_table();
            set(*own, name, value);
          }
    } else if (section == "crack") {
      toml::node* gears = scene.get("gear");
      if (toml::table* group = gears ? gears->as_table() : nullptr)
        for (auto&& [label, item] : *group)
          if (toml::table* gear = item.as_table())
            if (toml::table* own = gear->get_as<toml::table>("crack")) set(*own, name, value);
    } else if (section == "gear" || section == "material") {
      if (toml::table* group = node->as_table())
        for (auto&& [label, item] : *group)
          if (toml::table* table = item.as_table();
              table && (table->contains(name) || !table->contains("like")))
            set(*table, name, value);
    } else {
      if (!node) node = &scene.insert(section, toml::table{}).first->second;
      if (toml::table* table = node->as_table()) set(*table, name, value);
    }
  }
  // Paths start from the folder of the scene, and the variant has another.
  if (toml::table* gears = scene.get_as<toml::table>("gear"))
    for (auto&& [label, item] : *gears)
      if (toml::node* file = toml::node_view(item)["error"]["file"].node(); file && file->is_string())
        toml::node_view(item)["error"].as_table()->insert_or_assign(
            "file", (std::filesystem::absolute(path).parent_path() / *file->value<std::string>())
                        .lexically_normal()
                        .string());
  std::ostringstream out;
  out << "# Made by gear-scene --set from another scene; edit that one.\n" << scene << "\n";
  return out.str();
}

}  // namespace whine
