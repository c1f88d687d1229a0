// A REXS model (the exchange format of FVA for gear units, versions 1.0 to 2.0) as it stands in its file: components with
// attributes, relations between components, load cases. `.rexs` is XML, `.rexsj` JSON, `.rexsz` a zip archive of one of them;
// the content says which.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace whine {

// Bounds of what is read, so that no file takes gigabytes or overflows the stack. A whole gearbox has less than 100,000 nodes in 10
// levels.
inline constexpr size_t kMostRexsNodes = 2'000'000, kMostRexsDepth = 64;

struct RexsAttribute {
  std::string unit;                      // as written; empty where the file has none
  std::string value;                     // of one number, word or truth value
  bool list = false;                     // several values
  std::vector<std::string> values = {};  // of a plain list; none of a matrix and of a list in base64
};

struct RexsComponent {
  int id = 0;
  std::string type, name;
  std::map<std::string, RexsAttribute> attributes;
};

struct RexsRelation {
  struct Reference {
    std::string role;
    int component = 0;
  };
  std::string type;
  std::vector<Reference> references;
  int id = -1;  // -1: none

  // The component in a role; -1: none.
  int in_role(const std::string& role) const;
  bool holds(int component) const;
};

struct RexsModel {
  std::string path, version;
  std::map<int, RexsComponent> components;  // by id
  std::vector<RexsRelation> relations;
  std::vector<std::map<int, RexsComponent>> load_cases;  // of each, what it says of components
};

// Throws Error(io) if the file cannot be read, Error(input) with path and reason if it is no REXS model of a known version:
// other content, damage, an archive without a model, above 64 MB unpacked, more than kMostRexsNodes or kMostRexsDepth, what is said
// twice (components, attributes, relations, roles; both are named), gears paired with themselves, ids that do not exist.
RexsModel read_rexs(const std::string& path);

}  // namespace whine
