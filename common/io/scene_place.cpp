#include "io/scene_place.h"

#include <cctype>
#include <sstream>

#include "base/error.h"
#include "io/publish.h"
#include "io/toml.h"

namespace whine {
namespace {

// In the order in which they come.
std::vector<std::string> identifiers(const std::string& words) {
  std::vector<std::string> out{""};
  for (const unsigned char c : words)
    if (std::isalnum(c) || c == '_')
      out.back() += static_cast<char>(c);
    else if (!out.back().empty())
      out.emplace_back();
  return out;
}

// "gear.pinion.modification", or the first of a list of sections; nullptr if there is none.
const toml::table* section_of(const toml::table& root, const std::string& name) {
  const toml::table* table = &root;
  std::istringstream parts(name);
  for (std::string part; table && std::getline(parts, part, '.');) {
    const toml::node* node = table->get(part);
    const toml::array* list = node ? node->as_array() : nullptr;
    if (list) node = list->get(0);
    table = node ? node->as_table() : nullptr;
  }
  return table;
}

toml::source_index line_that_names(const toml::table& root, const std::string& section,
                                   const std::string& words) {
  std::vector<const toml::table*> places{section_of(root, section)};
  if (section.starts_with("gear.")) {
    const size_t end = section.find('.', 5);
    const toml::table* gear = section_of(root, section.substr(0, end));
    if (const auto like = gear ? (*gear)["like"].value<std::string>() : std::nullopt)
      places.push_back(
          section_of(root, "gear." + *like + (end == std::string::npos ? "" : section.substr(end))));
  }
  for (const std::string& word : identifiers(words))
    for (const toml::table* place : places)
      // Messages speak of driver and driven gear without meaning the keys.
      if (const toml::node* node =
              place && !word.empty() && word != "driver" && word != "driven" ? place->get(word) : nullptr)
        return node->source().begin.line;
  return 0;
}

}  // namespace

std::string scene_place(const std::string& path, const std::vector<std::string>& sections,
                        const std::string& words) {
  try {
    const toml::table root = parse_toml(read_bytes(path));
    for (const std::string& section : sections)
      if (const auto line = line_that_names(root, section, words)) return text(path, ":", line);
    const toml::table* first = sections.empty() ? nullptr : section_of(root, sections.front());
    if (first && first->source().begin) return text(path, ":", first->source().begin.line);
  } catch (const toml::parse_error&) {
  } catch (const Error&) {
  }
  return path;
}

bool scene_gives(const std::string& path, const std::string& section, const std::string& key) {
  return line_that_names(parse_toml(read_bytes(path)), section, key) > 0;
}

}  // namespace whine
