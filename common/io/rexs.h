// A REXS model (the exchange format of FVA for gear units, versions 1.0 to 2.0) as it stands in its file: components with
// attributes, relations between components, load cases. `.rexs` is XML, `.rexsj` JSON, `.rexsz` a zip archive of one of them;
// the content says which.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace whine {

struct RexsAttribute {
  std::string unit;   // as written; empty where the file has none
  std::string value;  // of one number, word or truth value
  bool list = false;  // several values, which nobody here reads
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
// other content, damage, an archive without a model, above 64 MB unpacked, ids that occur twice or do not exist.
RexsModel read_rexs(const std::string& path);

}  // namespace whine
