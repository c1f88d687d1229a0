#include "io/fitted_numbers.h"

#include "base/error.h"
#include "io/publish.h"
#include "io/toml.h"

namespace whine {

std::vector<FittedNumber> read_fitted_numbers(const std::string& path) {
  toml::table root;
  try {
    root = parse_toml(read_bytes(path, "check the path of the table of fitted numbers"));
  } catch (const toml::parse_error& error) {
    fail(Failure::input, path, ":", error.source().begin.line, ": is not valid TOML: ", error.description());
  }
  const toml::array* rows = root.get_as<toml::array>("fitted");
  if (!rows) fail(Failure::input, path, ":1: lacks [[fitted]]");
  std::vector<FittedNumber> out;
  for (const toml::node& node : *rows) {
    const auto reject = [&](const std::string& what) {
      fail(Failure::input, path, ":", node.source().begin.line, ": ", what);
    };
    const toml::table* row = node.as_table();
    if (!row) reject("[[fitted]] must be tables");
    FittedNumber number;
    for (const auto& [label, value] : *row) {
      const std::string key(label.str());
      if (key == "scene" || key == "number") {
        (key == "scene" ? number.scene : number.number) = value.value<std::string>().value_or("");
      } else if (key == "to" && value.is_array()) {
        for (const toml::node& claim : *value.as_array())
          number.claims.push_back(claim.value<std::string>().value_or(""));
      } else {
        reject(text("unknown key '", key, "'; known are scene, number and the list 'to'"));
      }
    }
    if (number.scene.empty() || number.number.empty())
      reject("[[fitted]] needs 'scene' and 'number' as text");
    out.push_back(number);
  }
  return out;
}

}  // namespace whine
