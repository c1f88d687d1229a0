#include "io/variant.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "io/keys.h"
#include "io/publish.h"
#include "io/suggestion.h"
#include "io/toml.h"

namespace whine {
namespace {

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

// owner "": any.
void require_member(const toml::table& members, const std::string& group, const std::string& owner,
                    const std::string& path) {
  if (owner.empty() || members.contains(owner)) return;
  std::vector<std::string> names;
  for (const auto& [label, item] : members) names.emplace_back(label.str());
  const std::string near = nearest(owner, names);
  fail(Failure::input, path, ": has no [", group, ".", owner, "]",
       near.empty() ? "" : "; did you mean '" + near + "'?");
}

// Whose a section of a list is, as the place of a key names it: "sun-planet" of a mesh.
std::string owner_of(const toml::table& item, const std::string& group) {
  const auto word = [&](const char* key) { return item[key].value_or(std::string()); };
  return group == "mesh"      ? word("driver") + "-" + word("driven")
         : group == "carrier" ? word("name")
                              : word(group == "pin" ? "planet" : "gear");
}

// A planet without [[pin]] stands where it should; one is added, and true the result.
bool add_pin(toml::table& scene, const std::string& planet) {
  toml::array* pins = scene.get_as<toml::array>("pin");
  if (!pins && scene.contains("pin")) return false;  // what it is instead is told when the scene is read
  if (!pins) pins = scene.insert("pin", toml::array{}).first->second.as_array();
  for (toml::node& item : *pins)
    if (toml::table* table = item.as_table(); table && owner_of(*table, "pin") == planet) return false;
  pins->push_back(toml::table{{"planet", planet}});
  return true;
}

// toml++ writes 17 digits, 0.29999999999999999: here the fewest that give the same number, 0.3. Texts stay as they are.
std::string in_fewest_digits(const std::string& toml) {
  std::string out;
  for (size_t i = 0; i < toml.size();) {
    const char c = toml[i];
    size_t end = i + 1;
    if (c == '"' || c == '\'') {
      while (end < toml.size() && toml[end] != c) end += c == '"' && toml[end] == '\\' ? 2 : 1;
      end = std::min(end + 1, toml.size());
    } else if (std::isdigit(static_cast<unsigned char>(c)) && i > 0 && std::strchr(" [,-+", toml[i - 1])) {
      end = std::min(toml.find_first_not_of("0123456789.eE+-", i), toml.size());
      double value = 0;
      const auto [rest, error] = std::from_chars(&toml[i], &toml[end], value);
      if (error == std::errc() && rest == &toml[end] && toml.find('.', i) < end) {
        char digits[40];
        const std::string fewest(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
        out += fewest + (fewest.find_first_of(".e") == std::string::npos ? ".0" : "");
        i = end;
        continue;
      }
    }
    out.append(toml, i, end - i);
    i = end;
  }
  return out;
}

}  // namespace

std::string scene_variant(const std::string& path, const std::vector<std::string>& changes) {
  toml::table scene = read_toml(path, "the scene");
  for (const std::string& change : changes) {
    const size_t equals = change.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == change.size())
      fail(Failure::usage, "--set ", change, ": write key=value, as in bore_radius_mm=35");
    const std::string name = change.substr(0, equals), value = change.substr(equals + 1);
    const KeyPlace place = [&] {
      try {
        return find_key(name);
      } catch (const Error& error) {
        fail(error.kind(), "--set ", change, ": ", error.what());
      }
    }();
    const std::string section = place.key->section, leaf = place.key->name, owner = place.owner;
    if (section.empty()) {
      set(scene, leaf, value);
      continue;
    }
    const bool in_gear = section == "modification" || section == "error" || section == "crack";
    const std::string group = in_gear || section == "rigid_gear" ? "gear"
                              : section == "train_mesh"          ? "mesh"
                                                                 : section;
    const bool in_list = group == "mesh" || group == "bearing" || group == "carrier" || group == "pin" ||
                         group == "drive",
               has_owner = group == "gear" || group == "material";
    toml::node* node = scene.get(group);
    if (group == "pin" && !owner.empty() && add_pin(scene, owner)) node = scene.get(group);
    if (!node && (in_list || has_owner))
      fail(Failure::input, path, ": lacks the section [", group, "] of the key '", name, "'");
    if (in_list) {
      bool found = owner.empty();
      if (toml::array* list = node->as_array())
        for (toml::node& item : *list)
          if (toml::table* table = item.as_table();
              table && (owner.empty() || owner_of(*table, group) == owner)) {
            set(*table, leaf, value);
            found = true;
          }
      if (!found) fail(Failure::input, path, ": has no [[", group, "]] of '", owner, "'");
    } else if (has_owner) {
      toml::table* members = node->as_table();
      if (!members) continue;  // what it is instead is told when the scene is read
      require_member(*members, group, owner, path);
      for (auto&& [label, item] : *members) {
        toml::table* table = item.as_table();
        if (!table || (!owner.empty() && label.str() != owner)) continue;
        const bool here = !owner.empty();
        if (!in_gear) {
          if (here || table->contains(leaf) || !table->contains("like")) set(*table, leaf, value);
          continue;
        }
        toml::table* own = table->get_as<toml::table>(section);
        if (!own && !here && (section == "crack" || (section == "modification" && table->contains("like"))))
          continue;
        if (!own) own = table->insert(section, toml::table{}).first->second.as_table();
        if (own) set(*own, leaf, value);
      }
    } else {
      if (!node) node = &scene.insert(section, toml::table{}).first->second;
      if (toml::table* table = node->as_table()) set(*table, leaf, value);
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
  out << scene << "\n";
  return "# Made by gear-scene --set from another scene; edit that one.\n" + in_fewest_digits(out.str());
}

}  // namespace whine
