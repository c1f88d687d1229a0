#include "io/claim_sets.h"

#include <algorithm>

#include "base/error.h"
#include "io/toml.h"

namespace whine {
namespace {

using Words = std::vector<std::string>;

// Each alternative of one with each of the other.
std::vector<Words> both(const std::vector<Words>& one, const std::vector<Words>& other) {
  std::vector<Words> out;
  for (const Words& a : one)
    for (const Words& b : other) {
      out.push_back(a);
      out.back().insert(out.back().end(), b.begin(), b.end());
    }
  return out;
}

}  // namespace

std::vector<ClaimSet> read_claim_sets(const std::string& path) {
  const toml::table root = read_toml(path, "the sets of claims");
  std::vector<ClaimSet> out;
  for (const toml::table* row : rows_of(root, path, "set", {"name", "says", "claims", "any", "with"})) {
    ClaimSet set;
    set.alternatives = {{}};
    for (const auto& [label, value] : *row) {
      const std::string key(label.str());
      if (key == "name") {
        set.name = value.value<std::string>().value_or("");
      } else if (key == "says") {
        set.says = value.value<std::string>().value_or("");
      } else if (key == "claims") {
        set.alternatives = both(set.alternatives, {words_of(value)});
      } else if (key == "any") {
        std::vector<Words> any;
        if (const toml::array* lists = value.as_array())
          for (const toml::node& list : *lists) any.push_back(words_of(list));
        set.alternatives = both(set.alternatives, any);
      } else if (key == "with") {
        for (const std::string& name : words_of(value)) {
          const auto earlier =
              std::find_if(out.begin(), out.end(), [&](const ClaimSet& s) { return s.name == name; });
          if (earlier == out.end())
            reject_at(path, *row, text("'with' names '", name, "', which no earlier set is called"));
          set.alternatives = both(set.alternatives, earlier->alternatives);
        }
      }
    }
    if (set.name.empty() || set.alternatives.empty() || set.alternatives.front().empty())
      reject_at(path, *row, "a set needs a name and claims");
    out.push_back(set);
  }
  return out;
}

}  // namespace whine
